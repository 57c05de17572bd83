#include "limits.h"
#include "../support/slowdown.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MEMORY_TIMES = 16, MEMORY_BASE = 64 << 20, MEGABYTE = 1 << 20 };

static atomic_llong live, peak; /* bytes since limits_begin() */
static double began;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void limits_begin(void)
{
    live = peak = 0;
    began = now();
}

void limits_end(size_t size)
{
    const double seconds = now() - began, megabytes = (double)size / MEGABYTE;
    const long long allowed = MEMORY_TIMES * (long long)size + MEMORY_BASE;
    if (peak <= allowed && seconds <= (1 + megabytes) * slowdown())
        return;
    fprintf(stderr, "%zu bytes took %lld bytes of memory, %lld are allowed, and %.3g s\n", size,
            (long long)peak, allowed, seconds);
    abort();
}

static void *count(void *block)
{
    if (block) {
        const long long size = (long long)malloc_usable_size(block),
                        sum = atomic_fetch_add(&live, size) + size;
        if (sum > peak)
            peak = sum;
    }
    return block;
}

static void discount(void *block)
{
    if (block)
        live -= (long long)malloc_usable_size(block);
}

#define WRAP(name, parameters, arguments)      \
    void *__real_##name parameters;            \
    void *__wrap_##name parameters;            \
    void *__wrap_##name parameters             \
    {                                          \
        return count(__real_##name arguments); \
    }

WRAP(malloc, (size_t size), (size))
WRAP(calloc, (size_t items, size_t size), (items, size))
WRAP(aligned_alloc, (size_t alignment, size_t size), (alignment, size))
WRAP(strdup, (const char *text), (text))
WRAP(strndup, (const char *text, size_t size), (text, size))

void __real_free(void *block);
void __wrap_free(void *block);
void __wrap_free(void *block)
{
    discount(block);
    __real_free(block);
}

void *__real_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size);

/* For a moment there may be both. */
void *__wrap_realloc(void *block, size_t size)
{
    const long long before = block ? (long long)malloc_usable_size(block) : 0;
    void *moved = count(__real_realloc(block, size));
    if (moved)
        live -= before;
    return moved;
}
