/* The sculpture's faces on their way to the graphics card: brick by brick, and only those that changed. */
#include "common/array.h"
#include "sculpt/normals.h"
#include "sculpt/window_app.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Material 1 is clay; the others go round the circle of hues by the golden ratio, so that neighbours differ. */
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

static enum status convert(struct app *app, const int brick[3], struct error *err)
{
    struct brick_normals normals;
    size_t cells = 0;
    for (size_t i = 0; i < app->found.count; i++)
        cells += (size_t)app->found.items[i].size[0] * app->found.items[i].size[1];
    app->faces.count = 0;
    if (!ARRAY_RESERVE(&app->faces, app->smooth_light ? cells : app->found.count))
        return error_no_memory(err, "the faces of a brick");
    if (app->smooth_light && cells > 0)
        brick_normals_begin(&normals, &app->session.tree, brick);
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

static enum status update_brick(struct app *app, const int brick[3], struct error *err)
{
    const uint64_t key = ((uint64_t)brick[2] << 20) + ((uint64_t)brick[1] << 10) + (uint64_t)brick[0];
    enum status status = brick_find_faces(&app->session.tree, brick, &app->found, err);
    if (!status)
        status = convert(app, brick, err);
    return status ? status : render_solid_set(app->solid, key, app->faces.items, app->faces.count, err);
}

/* A brick that waits, and how far it is from the eye. */
struct window_brick {
    uint16_t at[3];
    float distance;
};

static int farthest_first(const void *a, const void *b)
{
    const float one = ((const struct window_brick *)a)->distance,
                other = ((const struct window_brick *)b)->distance;
    return (one < other) - (one > other);
}

/* The nearest to the eye is the last, and the next to be made. */
static void sort_waiting(struct app *app)
{
    const double brick = (double)BRICK_SIDE / (1 << app->session.tree.depth);
    for (size_t i = 0; i < app->waiting.count; i++) {
        struct window_brick *item = &app->waiting.items[i];
        double sum = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double d = (item->at[axis] + 0.5) * brick - app->view.camera.eye[axis];
            sum += d * d;
        }
        item->distance = (float)sum;
    }
    qsort(app->waiting.items, app->waiting.count, sizeof *app->waiting.items, farthest_first);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Puts the bricks of a region behind those that wait: they come first. One that waits twice is made twice, which does no
 * harm. */
static enum status add_region(struct app *app, const struct octree_region *region, struct error *err)
{
    int first[3], last[3], at[3];
    size_t count = 1;
    bricks_of_region(&app->session.tree, region, first, last);
    for (int i = 0; i < 3; i++)
        count *= (size_t)(last[i] - first[i] + 1);
    if (!ARRAY_RESERVE(&app->waiting, count))
        return error_no_memory(err, "the bricks to be drawn");
    for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
        for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
            for (at[0] = first[0]; at[0] <= last[0]; at[0]++)
                app->waiting.items[app->waiting.count++] = (struct window_brick){
                    .at = {(uint16_t)at[0], (uint16_t)at[1], (uint16_t)at[2]}};
    return STATUS_OK;
}

void app_see_anew(struct app *app)
{
    const int last = (1 << app->session.tree.depth) - 1;
    app->waiting.count = 0;
    octree_regions_add(&app->session.changed, &(struct octree_region){{0, 0, 0}, {last, last, last}});
}

enum status app_update_solid(struct app *app, double most_seconds, struct error *err)
{
    enum { MANY = 64 }; /* more than a chip touches: then the order counts */
    struct octree_regions regions;
    const double end = seconds() + most_seconds;
    enum status status = STATUS_OK;
    session_take_changes(&app->session, &regions);
    const size_t before = app->waiting.count;
    for (int i = 0; i < regions.count && !status; i++)
        status = add_region(app, &regions.items[i], err);
    if (app->waiting.count > before + MANY)
        sort_waiting(app);
    while (!status && app->waiting.count > 0 && seconds() < end) {
        const struct window_brick *next = &app->waiting.items[app->waiting.count - 1];
        const int at[3] = {next->at[0], next->at[1], next->at[2]};
        app->waiting.count--;
        status = update_brick(app, at, err);
    }
    return status;
}
