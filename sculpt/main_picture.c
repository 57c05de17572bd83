#include "sculpt/main_picture.h"

#include "render/render.h"
#include "sculpt/coarse.h"
#include "sculpt/sculpt.h"

enum {
    PREVIEW_WIDTH = 256,
    PREVIEW_HEIGHT = 192,
    PREVIEW_DEPTH = 7, /* more cells than pixels show nothing more */
};

static const struct render_skin clay = {.colour = {0.62f, 0.42f, 0.26f}, .facets = true};

enum status picture_draw(const struct octree *tree, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    struct render_skin skin = clay;
    skin.mesh = &mesh;
    enum status status = sculpt_faces(tree, &mesh, err);
    status = status ? error_prefix(err, path) : render_still(&skin, path, "balloon-sculpt", err);
    mesh_clear(&mesh);
    return status;
}

enum status picture_preview(const struct octree *tree, struct octree_chunks *chunks, struct error *err)
{
    struct octree coarse = {0};
    struct mesh mesh = {0};
    struct render_skin skin = clay;
    struct bytes png = {0};
    skin.mesh = &mesh;
    octree_chunks_drop(chunks, OCTREE_CHUNK_PREVIEW);
    enum status status = sculpt_coarsen(tree, PREVIEW_DEPTH, &coarse, err);
    if (!status)
        status = sculpt_faces(&coarse, &mesh, err);
    if (!status)
        status = render_still_png(&skin, PREVIEW_WIDTH, PREVIEW_HEIGHT, "balloon-sculpt", &png, err);
    if (!status)
        status = octree_chunks_put(chunks, OCTREE_CHUNK_PREVIEW, &png, err);
    bytes_clear(&png);
    mesh_clear(&mesh);
    octree_clear(&coarse);
    return status == STATUS_RANGE ? STATUS_OK : status; /* nothing is left to be seen */
}
