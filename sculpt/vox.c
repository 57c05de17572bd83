/* MagicaVoxel models as octrees. */
#include "sculpt/vox.h"

#include "common/file.h"
#include "sculpt/sculpt.h"

/* Scenes that put the same model in very many places are refused above this many voxels: some 20 seconds. */
#define VOXELS_MAX (UINT64_C(1) << 27)

struct bounds {
    int64_t low[3], high[3];
    bool any; /* voxel that is not empty */
};

static enum status check_size(const struct vox_scene *scene, struct error *err)
{
    uint64_t voxels = 0;
    for (size_t p = 0; p < scene->placements.count && voxels <= VOXELS_MAX; p++)
        voxels += scene->models.items[scene->placements.items[p].model].count;
    if (voxels <= VOXELS_MAX)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE, "the scene has more than %llu voxels",
                     (unsigned long long)VOXELS_MAX);
}

/* Calls for every voxel that is not empty, as it lies in the scene, turned upright: z up becomes y up. */
typedef enum status voxel_visitor(void *context, const int64_t place[3], unsigned colour, struct error *err);

static enum status visit_voxels(const struct vox_scene *scene, voxel_visitor *visit, void *context,
                                struct error *err)
{
    for (size_t p = 0; p < scene->placements.count; p++) {
        const struct vox_placement *placement = &scene->placements.items[p];
        const struct vox_model *model = &scene->models.items[placement->model];
        for (size_t i = 0; i < model->count; i++) {
            const unsigned char *voxel = model->voxels + 4 * i;
            int64_t in_file[3];
            if (voxel[3] == 0)
                continue;
            vox_voxel_place(model, &placement->pose, voxel, in_file);
            const int64_t place[3] = {in_file[0], in_file[2], -in_file[1]};
            enum status status = visit(context, place, voxel[3], err);
            if (status)
                return status;
        }
    }
    return STATUS_OK;
}

static enum status widen(void *context, const int64_t place[3], unsigned colour, struct error *err)
{
    (void)colour, (void)err;
    struct bounds *bounds = context;
    for (int k = 0; k < 3; k++) {
        if (!bounds->any || place[k] < bounds->low[k])
            bounds->low[k] = place[k];
        if (!bounds->any || place[k] > bounds->high[k])
            bounds->high[k] = place[k];
    }
    bounds->any = true;
    return STATUS_OK;
}

struct target {
    struct octree *tree;
    int64_t shift[3]; /* to be added to a place for its cell */
};

static enum status set_cell(void *context, const int64_t place[3], unsigned colour, struct error *err)
{
    const struct target *target = context;
    return octree_set(target->tree, (int)(place[0] + target->shift[0]), (int)(place[1] + target->shift[1]),
                      (int)(place[2] + target->shift[2]), colour, err);
}

/* The smallest cube with a cell free on each side, and the shift that puts the model in its middle. */
static enum status fit(const struct bounds *bounds, struct target *target, struct error *err)
{
    int64_t largest = 0;
    unsigned depth = 0;
    for (int k = 0; k < 3; k++) {
        int64_t extent = bounds->high[k] - bounds->low[k] + 1;
        largest = extent > largest ? extent : largest;
    }
    while (depth <= OCTREE_DEPTH_MAX && (INT64_C(1) << depth) < largest + 2)
        depth++;
    if (depth > OCTREE_DEPTH_MAX)
        return error_set(err, STATUS_RANGE,
                         "the model is %lld cells long; at most %d fit with a cell free around it",
                         (long long)largest, (1 << OCTREE_DEPTH_MAX) - 2);
    for (int k = 0; k < 3; k++)
        target->shift[k] = ((1 << depth) - (bounds->high[k] - bounds->low[k] + 1)) / 2 - bounds->low[k];
    return octree_init(target->tree, depth, 0, err);
}

static enum status build(struct vox_scene *scene, const struct bytes *file, struct octree *tree,
                         struct error *err)
{
    struct bounds bounds = {0};
    struct target target = {.tree = tree};
    enum status status = vox_parse(file->data, file->size, scene, err);
    if (!status)
        status = vox_place_models(scene, err);
    if (!status)
        status = check_size(scene, err);
    if (!status)
        status = visit_voxels(scene, widen, &bounds, err);
    if (!status && !bounds.any)
        status = error_set(err, STATUS_INPUT, "the model is empty: no voxel has a colour, or all are hidden");
    if (!status)
        status = fit(&bounds, &target, err);
    if (!status)
        status = visit_voxels(scene, set_cell, &target, err);
    return status;
}

enum status vox_load(const char *path, struct octree *tree, struct error *err)
{
    struct bytes file = {0};
    struct vox_scene scene = {0};
    struct octree made = {0};
    enum status status = file_read_signed(path, "VOX ", 4, &file, err);
    if (status)
        return status;
    status = build(&scene, &file, &made, err);
    vox_scene_clear(&scene);
    bytes_clear(&file);
    if (status) {
        octree_clear(&made);
        if (err)
            error_prefix(err, path);
        return status;
    }
    octree_clear(tree);
    *tree = made;
    return STATUS_OK;
}
