/*
 * Calls that fail when a test says so: memory that ends, a disk that is full. Each in turn:
 *
 *     for (struct fault fault = {.kinds = FAULT_FILES}; fault_next(&fault);) {
 *         fault_begin(&fault);
 *         enum status status = octree_save(&tree, "shape.oct", &err);
 *         fault_end(&fault);
 *         ...                                    fault.failed: "rename", say; NULL when all calls succeeded
 *     }
 *
 * The first round lets the first call fail, the second the second, and so on; one more round, the
 * last, is without a failure. Then it all happens again with every later call failing too, as it is
 * when a disk stays full.
 *
 * A program that includes this is given the dependency `fault` (tests/support/meson.build), which leads the
 * calls made in the project's own code here; what the C library and others call among themselves is as ever.
 *
 * What fails: FAULT_MEMORY malloc, calloc, realloc, strdup, strndup, asprintf, open_memstream, and fflush and
 * fclose of a stream in memory; FAULT_FILES opening (fopen, open, mkostemp, fdopen), writing (fwrite, fflush,
 * write: the device is full, the write done in part), fsync, fclose, rename, link, linkat, ftruncate;
 * FAULT_STARTS pthread_create.
 */
#ifndef TESTS_SUPPORT_FAULT_H
#define TESTS_SUPPORT_FAULT_H

#include <stdbool.h>

enum { FAULT_MEMORY = 1, FAULT_FILES = 2, FAULT_STARTS = 4 };

struct fault {
    unsigned kinds;     /* of calls that may fail */
    long number;        /* of the call that fails, from 1 on */
    bool lasting;       /* all calls after it fail too */
    bool all_named;     /* the file system knows no files without a name (O_TMPFILE) */
    const char *failed; /* the function that did first */
};

/* True when there is a round to be done. */
bool fault_next(struct fault *fault);

/* Between these two a call fails. One at a time; calls of all threads count. */
void fault_begin(struct fault *fault);
void fault_end(struct fault *fault);

#endif
