/*
 * The off-screen context of Mesa's OSMesa library: nothing but memory is needed. It brings a compiler with it
 * and is large: the first context loads it, so that programs that draw nothing start without.
 */
#include "render/context.h"

#include <dlfcn.h>
#include <GL/osmesa.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

/* The calls that are used, as the header declares them. The library stays loaded. */
static struct {
    __typeof__(&OSMesaCreateContextAttribs) create;
    __typeof__(&OSMesaMakeCurrent) make_current;
    __typeof__(&OSMesaGetCurrentContext) current;
    __typeof__(&OSMesaDestroyContext) destroy;
    __typeof__(&OSMesaGetProcAddress) function;
    char missing[200]; /* why they are not there, or "" */
} mesa;
static pthread_once_t loaded = PTHREAD_ONCE_INIT;

struct osmesa {
    OSMesaContext context;
    unsigned char pixel[4]; /* OSMesa insists on a picture of its own */
};

/* Functions are found as if the library were linked, so that one that is loaded before it can stand in for
 * them. POSIX has dlsym() return them as void *; C would not cast them. */
static void load(void)
{
    const bool found = dlopen(OSMESA_LIBRARY, RTLD_NOW | RTLD_GLOBAL) &&
                       (*(void **)&mesa.create = dlsym(RTLD_DEFAULT, "OSMesaCreateContextAttribs")) &&
                       (*(void **)&mesa.make_current = dlsym(RTLD_DEFAULT, "OSMesaMakeCurrent")) &&
                       (*(void **)&mesa.current = dlsym(RTLD_DEFAULT, "OSMesaGetCurrentContext")) &&
                       (*(void **)&mesa.destroy = dlsym(RTLD_DEFAULT, "OSMesaDestroyContext")) &&
                       (*(void **)&mesa.function = dlsym(RTLD_DEFAULT, "OSMesaGetProcAddress"));
    if (!found)
        snprintf(mesa.missing, sizeof mesa.missing, "%s", dlerror());
}

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
    pthread_once(&loaded, load);
    if (*mesa.missing)
        return error_set(err, STATUS_RESOURCE,
                         "OSMesa, Mesa 13 or later, is not there (%s); on Debian: apt install libosmesa6",
                         mesa.missing);
    struct osmesa *own = calloc(1, sizeof *own);
    if (!own)
        return error_no_memory(err, "the OpenGL context");
    own->context = mesa.create(wanted, NULL);
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
    if (!mesa.make_current(own->context, own->pixel, GL_UNSIGNED_BYTE, 1, 1))
        return error_set(err, STATUS_RESOURCE, "OSMesa cannot make its context current");
    return STATUS_OK;
}

static bool osmesa_is_current(const void *context)
{
    const struct osmesa *own = context;
    return mesa.current() == own->context;
}

static void leave_osmesa(void *context)
{
    (void)context;
    mesa.make_current(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
}

static void close_osmesa(void *context)
{
    struct osmesa *own = context;
    mesa.destroy(own->context);
    free(own);
}

static void (*osmesa_function(const char *name))(void)
{
    return mesa.function(name);
}

const struct context_backend context_osmesa = {
    "osmesa", open_osmesa, use_osmesa, osmesa_is_current, leave_osmesa, close_osmesa, osmesa_function,
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

/* Where a library's thread-local block begins 16 bytes into a page, GCC 12's sanitizer takes what lies
 * before it for a header that old C libraries wrote, and ends as it looks for leaks there: it is not to note
 * such blocks. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "intercept_tls_get_addr=0";
}

const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa\n";
}
#endif
