/* An OpenGL context without a display. Its own framebuffer is a single pixel: draw into a target. */
#ifndef RENDER_CONTEXT_H
#define RENDER_CONTEXT_H

#include "common/status.h"

#include <stdbool.h>

struct context;

/* Opens a context of version 3.3 or later and makes it current in this thread. Errors: STATUS_RESOURCE,
 * STATUS_NO_MEMORY. */
enum status context_open(struct context **context, struct error *err);

/* Makes it current in this thread again, where a window's context may have been meanwhile. */
enum status context_use(struct context *context, struct error *err);

/* No off-screen context is current in this thread any more; true when one was. */
bool context_leave(void);

/* NULL is fine. */
void context_close(struct context *context);

/* The function of this name in the current context, or NULL. */
void (*context_function(const char *name))(void);

#endif
