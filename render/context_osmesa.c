/* The off-screen context of Mesa's OSMesa library: nothing but memory is needed. */
#include "render/context.h"

#include <GL/osmesa.h>
#include <stdlib.h>

struct context {
    OSMesaContext osmesa;
    unsigned char pixel[4]; /* OSMesa insists on a picture of its own */
};

/* OSMesaGetCurrentContext() also gives those of others: OSMesa and the GLX of windows share what is current. */
static _Thread_local bool in_use;

enum status context_open(struct context **result, struct error *err)
{
    const int wanted[] = {OSMESA_FORMAT,
                          OSMESA_RGBA,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          3,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          3,
                          0};
    struct context *context = calloc(1, sizeof *context);
    if (!context)
        return error_no_memory(err, "the OpenGL context");
    context->osmesa = OSMesaCreateContextAttribs(wanted, NULL);
    if (!context->osmesa) {
        free(context);
        return error_set(err, STATUS_RESOURCE,
                         "OSMesa gives no OpenGL 3.3 context; Mesa 13 or later is needed");
    }
    enum status status = context_use(context, err);
    if (status) {
        context_close(context);
        return status;
    }
    *result = context;
    return STATUS_OK;
}

enum status context_use(struct context *context, struct error *err)
{
    if (OSMesaGetCurrentContext() == context->osmesa)
        return STATUS_OK;
    if (!OSMesaMakeCurrent(context->osmesa, context->pixel, GL_UNSIGNED_BYTE, 1, 1))
        return error_set(err, STATUS_RESOURCE, "OSMesa cannot make its context current");
    in_use = true;
    return STATUS_OK;
}

bool context_leave(void)
{
    bool was_in_use = in_use;
    if (in_use)
        OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
    in_use = false;
    return was_in_use;
}

void context_close(struct context *context)
{
    if (!context)
        return;
    if (OSMesaGetCurrentContext() == context->osmesa)
        context_leave();
    OSMesaDestroyContext(context->osmesa);
    free(context);
}

void (*context_function(const char *name))(void)
{
    return OSMesaGetProcAddress(name);
}

/* OSMesa keeps a few hundred bytes for each context that it never frees. A build with the address sanitizer
 * is told not to count them; our own leaks it still reports. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1 /* as gcc says it */
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
const char *__lsan_default_options(void);
const char *__lsan_default_options(void)
{
    return "print_suppressions=0";
}

const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa\n";
}
#endif
