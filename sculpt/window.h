/* The sculpting window: the program layer's bridge between session, surface, sim and render. */
#ifndef SCULPT_WINDOW_H
#define SCULPT_WINDOW_H

#include "common/status.h"

#include <stdbool.h>

/* Opens a window on the sculpture `path` (a new cube of this depth where there is no such file) and returns when it has
 * been closed. Work that a killed program left is taken up with `recover`, and offered without. Errors: those of
 * session_open(), and STATUS_RESOURCE without a display. */
enum status sculpt_window(const char *path, unsigned depth, bool recover, struct error *err);

#endif
