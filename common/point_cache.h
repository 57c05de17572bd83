/*
 * A cache of a mesh's moving points, as Blender's modifier Mesh Cache and others read it (.pc2,
 * "PointCache2"): for each sample the places of all points as floats. After "POINTCACHE2" and a zero byte
 * stand the version (1) and the number of points as whole numbers of 4 bytes, number of the first frame and
 * frames a sample as floats, and the number of samples; all lowest byte first.
 *
 *     if (point_cache_open("burst.pc2", points, first, &cache, err)) ...
 *     point_cache_add(cache, position);        for each sample
 *     if (point_cache_close(cache, err)) ...   or point_cache_abandon(cache)
 */
#ifndef COMMON_POINT_CACHE_H
#define COMMON_POINT_CACHE_H

#include "common/status.h"

#include <stdint.h>

struct point_cache;

/* Begins to replace the file. Errors: STATUS_FILE, also where it is no file that can be gone back in (a
 * pipe); STATUS_NO_MEMORY. */
enum status point_cache_open(const char *path, uint32_t point_count, double first_frame,
                             struct point_cache **cache, struct error *err);

/* position is [point_count]. What fails is told by close. */
void point_cache_add(struct point_cache *cache, double (*position)[3]);

/* Ends the replacement; frees the cache, whatever it returns. Errors: STATUS_FILE. */
enum status point_cache_close(struct point_cache *cache, struct error *err);
void point_cache_abandon(struct point_cache *cache); /* NULL is fine */

#endif
