/* The sculpting window: the program layer's bridge between session, surface, sim and render. */
#ifndef SCULPT_WINDOW_H
#define SCULPT_WINDOW_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>

struct sculpt_window_options {
    const char *path;
    unsigned depth;     /* of a new cube, where there is no such file */
    bool recover;       /* take up the work that a killed program left; else it is offered */
    size_t undo_memory; /* bytes of steps that can be undone */
};

/* Opens a window on the sculpture and returns when it has been closed. Errors: those of session_open(), and
 * STATUS_RESOURCE without a display. */
enum status sculpt_window(const struct sculpt_window_options *options, struct error *err);

#endif
