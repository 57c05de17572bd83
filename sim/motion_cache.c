#include "sim/motion_cache.h"
#include "common/point_cache.h"
#include "sim/skin_mesh.h"

#include <stdlib.h>
#include <string.h>

struct motion_cache {
    struct skin_mesh skin;
    struct point_cache *points;
    char *mesh; /* file of the mesh; NULL once it is written */
};

char *motion_cache_mesh_name(const char *path)
{
    char *mesh = strdup(path);
    if (mesh)
        memcpy(mesh + strlen(mesh) - 3, "ply", 3);
    return mesh;
}

enum status motion_cache_open(struct sim *sim, const char *path, uint64_t first, struct motion_cache **result,
                              struct error *err)
{
    struct motion_cache *cache = calloc(1, sizeof *cache);
    if (!cache)
        return error_no_memory(err, path);
    cache->mesh = motion_cache_mesh_name(path);
    enum status status = cache->mesh ? skin_mesh_init(&cache->skin, sim, true, err)
                                     : error_no_memory(err, path);
    if (!status)
        status = point_cache_open(path, cache->skin.mesh.point_count, (double)first, &cache->points, err);
    if (status)
        motion_cache_abandon(cache);
    else
        *result = cache;
    return status;
}

enum status motion_cache_add(struct motion_cache *cache, struct error *err)
{
    skin_mesh_take(&cache->skin);
    point_cache_add(cache->points, cache->skin.mesh.position);
    if (!cache->mesh)
        return STATUS_OK;
    enum status status = mesh_save_values(&cache->skin.mesh, cache->skin.values, SKIN_VALUES, cache->mesh,
                                          err);
    free(cache->mesh);
    cache->mesh = NULL;
    return status;
}

enum status motion_cache_close(struct motion_cache *cache, struct error *err)
{
    if (!cache)
        return STATUS_OK;
    enum status status = point_cache_close(cache->points, err);
    cache->points = NULL;
    motion_cache_abandon(cache);
    return status;
}

void motion_cache_abandon(struct motion_cache *cache)
{
    if (!cache)
        return;
    point_cache_abandon(cache->points);
    skin_mesh_clear(&cache->skin);
    free(cache->mesh);
    free(cache);
}
