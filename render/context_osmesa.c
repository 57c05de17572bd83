/* The off-screen context of Mesa's OSMesa library: nothing but memory is needed. */
#include "render/context.h"

#include <GL/osmesa.h>
#include <stdlib.h>

struct osmesa {
    OSMesaContext context;
    unsigned char pixel[4]; /* OSMesa insists on a picture of its own */
};

static enum status open_osmesa(void **result, struct error *err)
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
    struct osmesa *own = calloc(1, sizeof *own);
    if (!own)
        return error_no_memory(err, "the OpenGL context");
    own->context = OSMesaCreateContextAttribs(wanted, NULL);
    if (!own->context) {
        free(own);
        return error_set(err, STATUS_RESOURCE,
                         "OSMesa gives no OpenGL 3.3 context; Mesa 13 or later is needed");
    }
    *result = own;
    return STATUS_OK;
}

static enum status use_osmesa(void *context, struct error *err)
{
    struct osmesa *own = context;
    if (!OSMesaMakeCurrent(own->context, own->pixel, GL_UNSIGNED_BYTE, 1, 1))
        return error_set(err, STATUS_RESOURCE, "OSMesa cannot make its context current");
    return STATUS_OK;
}

static bool osmesa_is_current(const void *context)
{
    const struct osmesa *own = context;
    return OSMesaGetCurrentContext() == own->context;
}

static void leave_osmesa(void *context)
{
    (void)context;
    OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
}

static void close_osmesa(void *context)
{
    struct osmesa *own = context;
    OSMesaDestroyContext(own->context);
    free(own);
}

const struct context_backend context_osmesa = {
    "osmesa", open_osmesa, use_osmesa, osmesa_is_current, leave_osmesa, close_osmesa, OSMesaGetProcAddress,
};

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
