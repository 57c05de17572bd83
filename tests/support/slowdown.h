/* How many times slower a test is than by itself, where that matters to what there is time for: valgrind's
 * set-up says so (tests/meson.build). */
#ifndef TESTS_SUPPORT_SLOWDOWN_H
#define TESTS_SUPPORT_SLOWDOWN_H

#include <stdlib.h>

static inline double slowdown(void)
{
    const char *text = getenv("SLOWDOWN");
    return text ? atof(text) : 1;
}

#endif
