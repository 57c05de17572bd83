#include "render/context.h"

#include <stdlib.h>
#include <string.h>

struct context {
    const struct context_backend *backend;
    void *own;
};

static const struct context_backend *const backends[] = {
    &context_osmesa,
#ifdef RENDER_HAS_EGL
    &context_egl,
#endif
};

/* What a library says is current may be a window's: both share it. */
static _Thread_local struct context *in_use;

static enum status open_one(struct context *context, const struct context_backend *backend, struct error *err)
{
    context->backend = backend;
    enum status status = backend->open(&context->own, err);
    if (status)
        return status;
    status = context_use(context, err);
    if (status)
        backend->close(context->own);
    return status;
}

/* The reasons of those that did not open are told together when none does. */
static enum status open_first(struct context *context, struct error *err)
{
    const char *only = getenv("BALLOON_CONTEXT");
    struct error reason = {0};
    bool tried = false;
    for (size_t i = 0; i < sizeof backends / sizeof *backends; i++) {
        if (only && *only && strcmp(only, backends[i]->name) != 0)
            continue;
        enum status status = open_one(context, backends[i], &reason);
        if (!status || status == STATUS_NO_MEMORY) {
            *err = reason;
            return status;
        }
        const struct error before = *err;
        *err = reason;
        if (tried)
            error_set(err, STATUS_RESOURCE, "%.400s; %.400s", before.text, reason.text);
        tried = true;
    }
    if (!tried)
        return error_set(err, STATUS_RESOURCE,
                         "BALLOON_CONTEXT is %.100s; osmesa or, where built in, egl is possible", only);
    return STATUS_RESOURCE;
}

enum status context_open(struct context **result, struct error *err)
{
    struct context *context = calloc(1, sizeof *context);
    if (!context)
        return error_no_memory(err, "the OpenGL context");
    enum status status = open_first(context, err);
    if (status)
        free(context);
    else
        *result = context;
    return status;
}

const char *context_name(const struct context *context)
{
    return context->backend->name;
}

enum status context_use(struct context *context, struct error *err)
{
    if (in_use == context && context->backend->is_current(context->own))
        return STATUS_OK;
    if (in_use && in_use->backend != context->backend)
        context_leave();
    enum status status = context->backend->use(context->own, err);
    in_use = status ? NULL : context;
    return status;
}

bool context_leave(void)
{
    bool was_in_use = in_use != NULL;
    if (in_use)
        in_use->backend->leave(in_use->own);
    in_use = NULL;
    return was_in_use;
}

void context_close(struct context *context)
{
    if (!context)
        return;
    if (in_use == context)
        context_leave();
    context->backend->close(context->own);
    free(context);
}

void (*context_function(const char *name))(void)
{
    return in_use ? in_use->backend->function(name) : NULL;
}
