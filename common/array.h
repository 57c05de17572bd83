/*
 * Growable arrays: any struct with the members `items`, `count` and `capacity` is one, and `{0}` is an empty
 * one.
 *
 *     struct { uint32_t *items; size_t count, capacity; } list = {0};
 *     if (!ARRAY_RESERVE(&list, 1))
 *         return error_no_memory(err, "the list");
 *     list.items[list.count++] = 7;
 *     free(list.items);
 */
#ifndef COMMON_ARRAY_H
#define COMMON_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* True when `extra` more items fit behind the first a->count. On false the array is as it was. */
#define ARRAY_RESERVE(a, extra)               \
    ((extra) <= (a)->capacity - (a)->count || \
     array_grow(&(a)->items, (a)->count, (extra), sizeof *(a)->items, &(a)->capacity))

/* Makes room for count + extra items of item_size bytes behind the pointer that `items_address` points to, at
 * least doubling the capacity. False when memory, or size_t, is not enough. Call it through ARRAY_RESERVE. */
bool array_grow(void *items_address, size_t count, size_t extra, size_t item_size, size_t *capacity);

/* Makes room for `count` items, whose old values are not kept, behind the pointer that `items_address` points
 * to; *room is how much there is. False when memory, or size_t, is not enough: then there is none. */
bool array_renew(void *items_address, size_t count, size_t item_size, size_t *room);

/* malloc(count * size) that returns NULL on overflow, and for nothing a pointer that can be freed. */
void *array_new(size_t count, size_t size);

#endif
