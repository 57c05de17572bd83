/* The skin's motion for programs that play it back: FILE.pc2 (point_cache.h) a sample a frame,
 * and FILE.ply, the mesh that it moves, as it is at the first of them; each triangle has points
 * of its own (skin_mesh.h). */
#ifndef SIM_MOTION_CACHE_H
#define SIM_MOTION_CACHE_H

#include "sim/sim.h"

struct motion_cache;

/* What FILE.ply is called beside `path`, FILE.pc2; free() it. NULL: no memory. */
char *motion_cache_mesh_name(const char *path);

/* Whether both files could be written. Errors: STATUS_FILE, STATUS_NO_MEMORY. */
enum status motion_cache_check(const char *path, struct error *err);

/* `path` ends in .pc2; first: number of the first frame. `sim` is borrowed. Errors: STATUS_FILE,
 * STATUS_NO_MEMORY, STATUS_RANGE. */
enum status motion_cache_open(struct sim *sim, const char *path, uint64_t first, struct motion_cache **cache,
                              struct error *err);

/* Adds the state as it is. What fails is told by close. */
void motion_cache_add(struct motion_cache *cache);

/* Ends it; without a sample the older files stay. Frees the cache, whatever it returns. NULL is fine. Errors:
 * STATUS_FILE. */
enum status motion_cache_close(struct motion_cache *cache, struct error *err);
void motion_cache_abandon(struct motion_cache *cache); /* the older file stays; NULL is fine */

#endif
