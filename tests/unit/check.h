/* What the unit tests share: cmocka with its includes in the order it needs, and comparisons of doubles. */
#ifndef TESTS_UNIT_CHECK_H
#define TESTS_UNIT_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* |value - expected| <= tolerance, as doubles; NaN fails. */
#define assert_near(value, expected, tolerance) \
    check_near((value), (expected), (tolerance), #value, __FILE__, __LINE__)

static inline void check_near(double value, double expected, double tolerance, const char *what,
                              const char *file, int line)
{
    if (!(fabs(value - expected) <= tolerance)) {
        print_error("%s is %.17g, expected %.17g within %g\n", what, value, expected, tolerance);
        _fail(file, line);
    }
}

/* A call that must succeed: on failure its message is shown. */
#define assert_ok(call, err)                  \
    do {                                      \
        if ((call) != STATUS_OK) {            \
            print_error("%s\n", (err)->text); \
            _fail(__FILE__, __LINE__);        \
        }                                     \
    } while (0)

/* A call that must fail with this status and a message that contains `part`. */
#define assert_refused(call, wanted, part, err)                                       \
    do {                                                                              \
        if ((call) != (wanted) || !strstr((err)->text, (part))) {                     \
            print_error("status %d, message: %s\n", (int)(err)->status, (err)->text); \
            _fail(__FILE__, __LINE__);                                                \
        }                                                                             \
    } while (0)

#endif
