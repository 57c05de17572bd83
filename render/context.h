/*
 * An OpenGL context without a display. Its own framebuffer is a single pixel or none: draw into a target. It
 * comes from the first of the backends below that this machine has: OSMesa, which needs nothing but memory,
 * or EGL without a surface, which Mesa keeps where OSMesa is gone. The environment variable BALLOON_CONTEXT
 * ("osmesa", "egl") allows only that one.
 */
#ifndef RENDER_CONTEXT_H
#define RENDER_CONTEXT_H

#include "common/status.h"

#include <stdbool.h>

/* What one library has to offer; contexts are its own. Errors as below. */
struct context_backend {
    const char *name;
    enum status (*open)(void **context, struct error *err); /* does not make it current */
    enum status (*use)(void *context, struct error *err);
    bool (*is_current)(const void *context);
    void (*leave)(void *context);
    void (*close)(void *context);
    void (*(*function)(const char *name))(void);
};
extern const struct context_backend context_osmesa;
extern const struct context_backend context_egl; /* where built with EGL */

struct context;

/* Opens a context of version 3.3 or later and makes it current in this thread. Errors: STATUS_RESOURCE,
 * STATUS_NO_MEMORY. */
enum status context_open(struct context **context, struct error *err);

/* Where it comes from: "osmesa" or "egl". */
const char *context_name(const struct context *context);

/* Makes it current in this thread again, where a window's context may have been meanwhile. */
enum status context_use(struct context *context, struct error *err);

/* No off-screen context is current in this thread any more; true when one was. */
bool context_leave(void);

/* NULL is fine. */
void context_close(struct context *context);

/* The function of this name in the off-screen context that is current, or NULL. */
void (*context_function(const char *name))(void);

#endif
