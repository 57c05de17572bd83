/* What the targets share. */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include "common/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* The entry point that libFuzzer, or replay.c in its place, calls. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void must(bool holds)
{
    if (!holds)
        abort();
}

/* A call fails with a message, and only then. */
static inline void must_say(enum status status, const struct error *err)
{
    must(status == err->status && (status == STATUS_OK) == (err->text[0] == '\0'));
}

#endif
