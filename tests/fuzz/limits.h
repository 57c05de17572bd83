/*
 * What a reader may take of the machine, whatever it is given: memory of 16 times the input and 64 MB, a
 * second of its thread's time and one for each megabyte.
 *
 *     limits_begin();
 *     enum status status = octree_load(path, &tree, &err);
 *     limits_end(size);                                       aborts where it was more
 *
 * Counted is what the project's own code allocates: the linker leads those calls here
 * (tests/fuzz/meson.build).
 */
#ifndef TESTS_FUZZ_LIMITS_H
#define TESTS_FUZZ_LIMITS_H

#include <stddef.h>

void limits_begin(void);
void limits_end(size_t size);

#endif
