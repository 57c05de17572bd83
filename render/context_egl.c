/* The off-screen context of EGL on Mesa's surfaceless platform: no display server, no window, no surface. */
#include "render/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stddef.h>

/* EGL's display is one for the process and stays open: its contexts come and go. */
static enum status open_display(EGLDisplay *display, struct error *err)
{
    *display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (*display == EGL_NO_DISPLAY || !eglInitialize(*display, NULL, NULL))
        return error_set(err, STATUS_RESOURCE, "EGL has no surfaceless display; Mesa's is needed");
    return STATUS_OK;
}

static enum status open_egl(void **result, struct error *err)
{
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
    EGLDisplay display;
    enum status status = open_display(&display, err);
    if (status)
        return status;
    eglBindAPI(EGL_OPENGL_API);
    *result = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (*result == EGL_NO_CONTEXT)
        return error_set(err, STATUS_RESOURCE, "EGL gives no OpenGL 3.3 context (error 0x%x)",
                         (unsigned)eglGetError());
    return STATUS_OK;
}

static EGLDisplay the_display(void)
{
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
}

static enum status use_egl(void *context, struct error *err)
{
    eglBindAPI(EGL_OPENGL_API);
    if (!eglMakeCurrent(the_display(), EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return error_set(err, STATUS_RESOURCE, "EGL cannot make its context current (error 0x%x)",
                         (unsigned)eglGetError());
    return STATUS_OK;
}

static bool egl_is_current(const void *context)
{
    return eglGetCurrentContext() == context;
}

static void leave_egl(void *context)
{
    (void)context;
    eglMakeCurrent(the_display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static void close_egl(void *context)
{
    eglDestroyContext(the_display(), context);
}

const struct context_backend context_egl = {
    "egl", open_egl, use_egl, egl_is_current, leave_egl, close_egl, eglGetProcAddress,
};
