#include "common/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool array_grow(void *items_address, size_t count, size_t extra, size_t item_size, size_t *capacity)
{
    size_t most = PTRDIFF_MAX / item_size;
    if (extra > most || count > most - extra)
        return false;
    size_t wanted = count + extra;
    if (wanted < 2 * *capacity)
        wanted = 2 * *capacity < most ? 2 * *capacity : most;
    if (wanted < 8)
        wanted = 8;
    void *items; /* copied as bytes: the pointer may be to any type */
    memcpy(&items, items_address, sizeof items);
    items = realloc(items, wanted * item_size);
    if (!items)
        return false;
    memcpy(items_address, &items, sizeof items);
    *capacity = wanted;
    return true;
}

bool array_renew(void *items_address, size_t count, size_t item_size, size_t *room)
{
    void *items;
    memcpy(&items, items_address, sizeof items);
    if (items && count <= *room)
        return true;
    free(items);
    items = array_new(count, item_size);
    memcpy(items_address, &items, sizeof items);
    *room = items ? count : 0;
    return items;
}

void *array_new(size_t count, size_t size)
{
    if (size && count > PTRDIFF_MAX / size)
        return NULL;
    size_t bytes = count * size;
    return malloc(bytes > 0 ? bytes : 1);
}
