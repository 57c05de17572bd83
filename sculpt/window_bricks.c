/* The sculpture's faces on their way to the graphics card: brick by brick, and only those that changed. */
#include "common/array.h"
#include "sculpt/normals.h"
#include "sculpt/window_app.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a cell at the nearest place of the cube: smaller ones are drawn as larger ones. */
#define PIXELS_LEAST 0.7

/* While the hand moves a frame slower than this is drawn with larger cells; quicker ones, four times as
 * many faces, fit again. */
#define SECONDS_SLOW  0.07
#define SECONDS_QUICK 0.014

/* Material 1 is clay; the others go round the circle of hues by the golden ratio, so
 * that neighbours differ. */
static void colour_of(unsigned material, uint8_t colour[3])
{
    static const uint8_t clay[3] = {205, 172, 139};
    for (int i = 0; i < 3; i++) {
        const double hue = material * 0.618034 + i / 3.0;
        const double wave = 0.5 + 0.5 * cos(2 * M_PI * hue);
        colour[i] = material == 1 ? clay[i] : (uint8_t)(90 + 140 * wave);
    }
}

/* A row of cells of a rectangle, parted where their normals differ. `face` is that of its first cell. */
static void light_row(struct app *app, const struct brick_normals *normals, struct render_face face,
                      int length)
{
    const int axis = face.side / 2, along = (axis + 1) % 3;
    int cell[3] = {face.corner[0], face.corner[1], face.corner[2]};
    cell[axis] -= face.side & 1;
    face.size[0] = 0;
    for (int i = 0; i < length; i++, cell[along]++) {
        int8_t normal[3] = {0};
        brick_normal(normals, cell, face.side, normal);
        if (i > 0 && memcmp(normal, face.normal, sizeof normal) != 0) {
            app->faces.items[app->faces.count++] = face;
            face.corner[along] = (uint16_t)cell[along];
            face.size[0] = 0;
        }
        memcpy(face.normal, normal, sizeof normal);
        face.size[0]++;
    }
    app->faces.items[app->faces.count++] = face;
}

static void light_face(struct app *app, const struct brick_normals *normals, struct render_face face)
{
    const int length = face.size[0], rows = face.size[1], across = (face.side / 2 + 2) % 3;
    face.size[1] = 1;
    for (int row = 0; row < rows; row++, face.corner[across]++)
        light_row(app, normals, face, length);
}

static enum status convert(struct app *app, const struct octree *tree, const int brick[3], struct error *err)
{
    struct brick_normals normals;
    size_t cells = 0;
    for (size_t i = 0; i < app->found.count; i++)
        cells += (size_t)app->found.items[i].size[0] * app->found.items[i].size[1];
    app->faces.count = 0;
    if (!ARRAY_RESERVE(&app->faces, app->smooth_light ? cells : app->found.count))
        return error_no_memory(err, "the faces of a brick");
    if (app->smooth_light && cells > 0)
        brick_normals_begin(&normals, tree, brick);
    for (size_t i = 0; i < app->found.count; i++) {
        const struct brick_face *from = &app->found.items[i];
        struct render_face face = {.side = from->side, .size = {from->size[0], from->size[1]}};
        memcpy(face.corner, from->corner, sizeof face.corner);
        colour_of(from->material, face.colour);
        if (app->smooth_light)
            light_face(app, &normals, face);
        else
            app->faces.items[app->faces.count++] = face;
    }
    return STATUS_OK;
}

static const struct octree *level_tree(const struct app *app, const struct window_level *level)
{
    return level == app->levels ? &app->session.tree : &level->tree;
}

static enum status update_brick(struct app *app, struct window_level *level, const int brick[3],
                                struct error *err)
{
    const uint64_t key = ((uint64_t)brick[2] << 20) + ((uint64_t)brick[1] << 10) + (uint64_t)brick[0];
    const struct octree *tree = level_tree(app, level);
    enum status status = brick_find_faces(tree, brick, &app->found, err);
    if (!status)
        status = convert(app, tree, brick, err);
    return status ? status : render_solid_set(level->solid, key, app->faces.items, app->faces.count, err);
}

/* A brick that waits, and how far it is from the eye. */
struct window_brick {
    uint16_t at[3];
    float distance;
};

static int farthest_first(const void *a, const void *b)
{
    const float one = ((const struct window_brick *)a)->distance;
    const float other = ((const struct window_brick *)b)->distance;
    return (one < other) - (one > other);
}

/* The nearest to the eye is the last, and the next to be made. */
static void sort_waiting(const struct app *app, struct window_level *level)
{
    const double brick = (double)BRICK_SIDE / (1 << level_tree(app, level)->depth);
    for (size_t i = 0; i < level->waiting.count; i++) {
        struct window_brick *item = &level->waiting.items[i];
        double sum = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double d = (item->at[axis] + 0.5) * brick - app->view.camera.eye[axis];
            sum += d * d;
        }
        item->distance = (float)sum;
    }
    qsort(level->waiting.items, level->waiting.count, sizeof *level->waiting.items, farthest_first);
}

/* Puts the bricks of a region, in cells of the level, behind those that wait: they come first. One that waits
 * twice is made twice, which does no harm. */
static enum status add_region(const struct octree *tree, struct window_level *level,
                              const struct octree_region *region, struct error *err)
{
    int first[3], last[3], at[3];
    size_t count = 1;
    bricks_of_region(tree, region, first, last);
    for (int i = 0; i < 3; i++)
        count *= (size_t)(last[i] - first[i] + 1);
    if (!ARRAY_RESERVE(&level->waiting, count))
        return error_no_memory(err, "the bricks to be drawn");
    for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
        for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
            for (at[0] = first[0]; at[0] <= last[0]; at[0]++)
                level->waiting.items[level->waiting.count++] = (struct window_brick){
                    .at = {(uint16_t)at[0], (uint16_t)at[1], (uint16_t)at[2]}};
    return STATUS_OK;
}

/* The changes of the session since this level was looked at last become bricks that wait. */
static enum status take_changes(struct app *app, struct window_level *level, struct error *err)
{
    enum { MANY = 64 }; /* more than a chip touches: then the order counts */
    const int shift = (int)(level - app->levels);
    const int around = app->smooth_light ? NORMALS_REACH : 0; /* so far a cell turns normals */
    const size_t before = level->waiting.count;
    enum status status = STATUS_OK;
    if (level->changed.count > 0 && shift > 0)
        status = octree_cut(&app->session.tree, app->session.tree.depth - (unsigned)shift, &level->tree, err);
    for (int i = 0; i < level->changed.count && !status; i++) {
        struct octree_region region = level->changed.items[i];
        for (int axis = 0; axis < 3; axis++) {
            region.low[axis] = (region.low[axis] >> shift) - around;
            region.high[axis] = (region.high[axis] >> shift) + around;
        }
        status = add_region(level_tree(app, level), level, &region, err);
    }
    level->changed = (struct octree_regions){0};
    if (level->waiting.count > before + MANY)
        sort_waiting(app, level);
    return status;
}

static enum status begin_level(struct app *app, struct window_level *level, struct error *err)
{
    const int last = (1 << app->session.tree.depth) - 1;
    const double cell = ldexp(1, (int)(level - app->levels) - (int)app->session.tree.depth);
    octree_regions_add(&level->changed, &(struct octree_region){{0, 0, 0}, {last, last, last}});
    return render_solid_new(app->render, (const double[3]){0, 0, 0}, cell, &level->solid, err);
}

/* Until nothing waits or the clock says so. */
static enum status update_level(struct app *app, struct window_level *level, double end, struct error *err)
{
    enum status status = level->solid ? STATUS_OK : begin_level(app, level, err);
    if (!status)
        status = take_changes(app, level, err);
    while (!status && level->waiting.count > 0 && app_seconds() < end) {
        const struct window_brick *next = &level->waiting.items[--level->waiting.count];
        const int at[3] = {next->at[0], next->at[1], next->at[2]};
        status = update_brick(app, level, at, err);
    }
    return status;
}

static void share_changes(struct app *app)
{
    struct octree_regions regions;
    session_take_changes(&app->session, &regions);
    for (int l = 0; l < app->level_count; l++)
        for (int i = 0; i < regions.count && app->levels[l].solid; i++)
            octree_regions_add(&app->levels[l].changed, &regions.items[i]);
}

enum status app_update_solid(struct app *app, int level, double most_seconds, struct error *err)
{
    const double end = app_seconds() + most_seconds;
    enum status status = STATUS_OK;
    share_changes(app);
    for (; level < app->level_count && !status; level++) {
        app->shown = &app->levels[level];
        status = update_level(app, app->shown, level + 1 < app->level_count ? end : INFINITY, err);
        if (!app->shown->waiting.count)
            break;
    }
    return status;
}

void app_forget_faces(struct app *app)
{
    for (int i = 0; i < WINDOW_LEVELS_MAX; i++) {
        render_solid_free(app->levels[i].solid);
        octree_clear(&app->levels[i].tree);
        free(app->levels[i].waiting.items);
        app->levels[i] = (struct window_level){0};
    }
    app->shown = NULL;
    app->coarser = 0;
    app->level_count = 1;
    if (app->session.tree.depth > WINDOW_COARSEST)
        app->level_count += (int)(app->session.tree.depth - WINDOW_COARSEST);
}

int app_rest_level(const struct app *app)
{
    const struct render_camera *camera = &app->view.camera;
    double nearest = 0;
    for (int i = 0; i < 3; i++) { /* from the eye to the cube */
        const double d = fmax(fmax(-camera->eye[i], camera->eye[i] - 1), 0);
        nearest += d * d;
    }
    const double high = 2 * sqrt(nearest) *
                        tan(camera->field_of_view_deg * M_PI / 360); /* of the picture, there */
    const double cell = app->view.height / fmax(high, 1e-9) / (1 << app->session.tree.depth); /* in pixels */
    const int level = cell < PIXELS_LEAST ? (int)ceil(log2(PIXELS_LEAST / cell)) : 0;
    return level < app->level_count ? level : app->level_count - 1;
}

void app_adapt(struct app *app, int rest, double seconds)
{
    if (seconds > SECONDS_SLOW && rest + app->coarser + 1 < app->level_count)
        app->coarser++;
    else if (seconds < SECONDS_QUICK && app->coarser > 0)
        app->coarser--;
}
