/* MagicaVoxel files: the scene graph, which says where each model stands and how it is turned. */
#include "common/array.h"
#include "sculpt/vox.h"

#include <stdlib.h>
#include <string.h>

static const struct vox_pose at_rest = {{0, 1, 2}, {1, 1, 1}, {0}};

/* Translations are checked against this, so that sums over VOX_NESTING_MAX of them stay far from overflow. */
enum { SHIFT_MAX = 1 << 24 };

/* First `inner`, then `outer`. */
static struct vox_pose compose(const struct vox_pose *outer, const struct vox_pose *inner)
{
    struct vox_pose both;
    for (int k = 0; k < 3; k++) {
        int from = outer->axis[k];
        both.axis[k] = inner->axis[from];
        both.sign[k] = outer->sign[k] * inner->sign[from];
        both.shift[k] = outer->sign[k] * inner->shift[from] + outer->shift[k];
    }
    return both;
}

/* A voxel's middle is half a cell off its corner, so this counts in half cells: an odd number of them, which
 * a shift to the right rounds down to the cell. */
void vox_voxel_place(const struct vox_model *model, const struct vox_pose *pose, const unsigned char voxel[3],
                     int64_t place[3])
{
    for (int k = 0; k < 3; k++) {
        int axis = pose->axis[k];
        int halves = pose->sign[k] * (2 * (voxel[axis] - model->size[axis] / 2) + 1);
        place[k] = (halves >> 1) + pose->shift[k];
    }
}

/* What a DICT can say here; strings are kept as they lie in the file. */
struct attributes {
    struct vox_cursor rotation, translation, hidden; /* at == NULL: not there */
};

static struct vox_cursor read_string(struct vox_cursor *cursor)
{
    size_t size = vox_number(cursor);
    return (struct vox_cursor){vox_skip(cursor, size), size, false};
}

static bool string_is(struct vox_cursor string, const char *text)
{
    return string.at && string.left == strlen(text) && !memcmp(string.at, text, string.left);
}

static struct attributes read_attributes(struct vox_cursor *cursor)
{
    struct attributes found = {0};
    for (uint32_t count = vox_number(cursor); count > 0 && !cursor->cut_short; count--) {
        struct vox_cursor key = read_string(cursor), value = read_string(cursor);
        if (string_is(key, "_r"))
            found.rotation = value;
        else if (string_is(key, "_t"))
            found.translation = value;
        else if (string_is(key, "_hidden"))
            found.hidden = value;
    }
    return found;
}

/* Exactly `count` whole numbers within +-SHIFT_MAX, parted by spaces. */
static bool parse_numbers(struct vox_cursor string, int count, long *numbers)
{
    char text[64];
    if (string.left >= sizeof text)
        return false;
    memcpy(text, string.at, string.left);
    text[string.left] = '\0';
    char *at = text;
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtol(at, &end, 10);
        if (end == at || numbers[i] < -SHIFT_MAX || numbers[i] > SHIFT_MAX)
            return false;
        at = end;
    }
    return at == text + string.left;
}

/* Bits 0-1 and 2-3: the column of the 1 or -1 in the first and second row of the matrix; the third row has
 * the column that is left. Bits 4 to 6: a row's sign is minus. */
static bool parse_rotation(struct vox_cursor string, struct vox_pose *pose)
{
    long bits;
    if (!parse_numbers(string, 1, &bits) || bits < 0 || bits > 0x7f)
        return false;
    int first = bits & 3, second = bits >> 2 & 3;
    if (first == 3 || second == 3 || first == second)
        return false;
    const int axis[3] = {first, second, 3 - first - second};
    for (int k = 0; k < 3; k++) {
        pose->axis[k] = axis[k];
        pose->sign[k] = bits >> (4 + k) & 1 ? -1 : 1;
    }
    return true;
}

static struct vox_node *find_node(struct vox_scene *scene, bool layer, int32_t id)
{
    size_t low = 0, high = scene->nodes.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        struct vox_node *node = &scene->nodes.items[middle];
        const int layers = (node->kind == VOX_LAYER) - layer;
        if (!layers && node->id == id)
            return node;
        if (layers < 0 || (!layers && node->id < id))
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

struct walk {
    struct vox_scene *scene;
    struct error *err;
};

static enum status refuse(const struct walk *walk, const struct vox_node *node, const char *what)
{
    return error_set(walk->err, STATUS_INPUT, "%s %d at byte %zu: %s", vox_node_name(node), node->id,
                     node->place, what);
}

/* A layer that the file does not tell of is shown. */
static enum status find_hidden(const struct walk *walk, int32_t layer, bool *hidden)
{
    const struct vox_node *node = find_node(walk->scene, true, layer);
    *hidden = false;
    if (!node)
        return STATUS_OK;
    struct vox_cursor cursor = {node->contents, node->size, false};
    *hidden = string_is(read_attributes(&cursor).hidden, "1");
    return cursor.cut_short ? refuse(walk, node, "LAYR is cut short") : STATUS_OK;
}

static enum status walk_node(const struct walk *walk, int32_t id, const struct vox_pose *pose, int level);

static enum status walk_transform(const struct walk *walk, const struct vox_node *node,
                                  const struct vox_pose *pose, int level)
{
    struct vox_cursor cursor = {node->contents, node->size, false};
    struct attributes node_says = read_attributes(&cursor);
    int32_t child = (int32_t)vox_number(&cursor);
    vox_skip(&cursor, 4); /* reserved */
    int32_t layer = (int32_t)vox_number(&cursor);
    uint32_t frames = vox_number(&cursor);
    struct attributes frame = {0};
    if (frames > 0)
        frame = read_attributes(&cursor);
    if (cursor.cut_short)
        return refuse(walk, node, "nTRN is cut short");
    bool hidden;
    enum status status = find_hidden(walk, layer, &hidden);
    if (status || hidden || string_is(node_says.hidden, "1"))
        return status;
    struct vox_pose own = at_rest;
    long shift[3] = {0};
    if (frame.rotation.at && !parse_rotation(frame.rotation, &own))
        return refuse(walk, node, "_r is no rotation");
    if (frame.translation.at && !parse_numbers(frame.translation, 3, shift))
        return refuse(walk, node, "_t must be three whole numbers within +-16777216");
    for (int k = 0; k < 3; k++)
        own.shift[k] = shift[k];
    struct vox_pose both = compose(pose, &own);
    return walk_node(walk, child, &both, level + 1);
}

static enum status walk_group(const struct walk *walk, const struct vox_node *node,
                              const struct vox_pose *pose, int level)
{
    struct vox_cursor cursor = {node->contents, node->size, false};
    read_attributes(&cursor);
    uint32_t count = vox_number(&cursor);
    if (cursor.cut_short || count > cursor.left / 4)
        return refuse(walk, node, "nGRP is cut short");
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < count && !status; i++)
        status = walk_node(walk, (int32_t)vox_number(&cursor), pose, level + 1);
    return status;
}

/* Several models in one shape are the frames of an animation: the first counts. */
static enum status walk_shape(const struct walk *walk, const struct vox_node *node,
                              const struct vox_pose *pose)
{
    struct vox_cursor cursor = {node->contents, node->size, false};
    read_attributes(&cursor);
    uint32_t count = vox_number(&cursor), model = vox_number(&cursor);
    if (cursor.cut_short || count == 0)
        return refuse(walk, node, "nSHP names no model");
    if (model >= walk->scene->models.count)
        return refuse(walk, node, "nSHP names a model that is not in the file");
    if (!ARRAY_RESERVE(&walk->scene->placements, 1))
        return error_no_memory(walk->err, "the scene");
    walk->scene->placements.items[walk->scene->placements.count++] = (struct vox_placement){model, *pose};
    return STATUS_OK;
}

/* A node may be reached once only: the graph is a tree, or it could be endless. */
static enum status walk_node(const struct walk *walk, int32_t id, const struct vox_pose *pose, int level)
{
    struct vox_node *node = find_node(walk->scene, false, id);
    if (!node)
        return error_set(walk->err, STATUS_INPUT, "scene graph node %d is missing", id);
    if (node->used)
        return refuse(walk, node, "is reached twice; the scene graph must be a tree");
    if (level > VOX_NESTING_MAX)
        return refuse(walk, node, "the scene graph is nested more than 256 deep");
    node->used = true;
    switch (node->kind) {
    case VOX_TRANSFORM:
        return walk_transform(walk, node, pose, level);
    case VOX_GROUP:
        return walk_group(walk, node, pose, level);
    case VOX_SHAPE:
    case VOX_LAYER:
        break;
    }
    return walk_shape(walk, node, pose);
}

/* Without a scene graph all models begin at the same corner. */
static enum status place_all(struct vox_scene *scene, struct error *err)
{
    if (!ARRAY_RESERVE(&scene->placements, scene->models.count))
        return error_no_memory(err, "the scene");
    for (size_t i = 0; i < scene->models.count; i++) {
        struct vox_placement placement = {i, at_rest};
        for (int k = 0; k < 3; k++)
            placement.pose.shift[k] = scene->models.items[i].size[k] / 2;
        scene->placements.items[scene->placements.count++] = placement;
    }
    return STATUS_OK;
}

enum status vox_place_models(struct vox_scene *scene, struct error *err)
{
    if (scene->nodes.count == 0 || scene->nodes.items[0].kind == VOX_LAYER)
        return place_all(scene, err);
    const struct walk walk = {scene, err};
    return walk_node(&walk, 0, &at_rest, 0);
}
