#include "sim/motion_cache.h"
#include "common/file.h"
#include "common/mesh_files.h"
#include "common/point_cache.h"
#include "sim/skin_mesh.h"

#include <stdlib.h>
#include <string.h>

struct motion_cache {
    struct skin_mesh skin;
    struct point_cache *points;
    struct file_out *mesh;
    bool begun; /* the mesh is written */
};

char *motion_cache_mesh_name(const char *path)
{
    char *mesh = strdup(path);
    if (mesh)
        memcpy(mesh + strlen(mesh) - 3, "ply", 3);
    return mesh;
}

enum status motion_cache_check(const char *path, struct error *err)
{
    char *mesh = motion_cache_mesh_name(path);
    enum status status = mesh ? file_out_check(path, err) : error_no_memory(err, path);
    if (!status)
        status = file_out_check(mesh, err);
    free(mesh);
    return status;
}

static enum status open_files(struct motion_cache *cache, const char *path, uint64_t first, struct error *err)
{
    char *mesh = motion_cache_mesh_name(path);
    if (!mesh)
        return error_no_memory(err, path);
    enum status status = point_cache_open(path, cache->skin.mesh.point_count, (double)first, &cache->points,
                                          err);
    if (!status)
        status = file_out_open(mesh, &cache->mesh, err);
    free(mesh);
    return status;
}

enum status motion_cache_open(struct sim *sim, const char *path, uint64_t first, struct motion_cache **result,
                              struct error *err)
{
    struct motion_cache *cache = calloc(1, sizeof *cache);
    if (!cache)
        return error_no_memory(err, path);
    enum status status = skin_mesh_init(&cache->skin, sim, true, err);
    if (!status)
        status = open_files(cache, path, first, err);
    if (status)
        motion_cache_abandon(cache);
    else
        *result = cache;
    return status;
}

void motion_cache_add(struct motion_cache *cache)
{
    skin_mesh_take(&cache->skin);
    point_cache_add(cache->points, cache->skin.mesh.position);
    if (!cache->begun)
        mesh_write_ply_values(&cache->skin.mesh, cache->skin.values, SKIN_VALUES,
                              file_out_stream(cache->mesh));
    cache->begun = true;
}

/* The larger file first: where it finds no room the mesh stays that of the older one. */
enum status motion_cache_close(struct motion_cache *cache, struct error *err)
{
    enum status status = STATUS_OK;
    if (cache && cache->begun) {
        status = point_cache_close(cache->points, err);
        cache->points = NULL;
    }
    if (cache && cache->begun && !status) {
        status = file_out_commit(cache->mesh, err);
        cache->mesh = NULL;
    }
    motion_cache_abandon(cache);
    return status;
}

void motion_cache_abandon(struct motion_cache *cache)
{
    if (!cache)
        return;
    point_cache_abandon(cache->points);
    file_out_abandon(cache->mesh);
    skin_mesh_clear(&cache->skin);
    free(cache);
}
