/* The window of freeglut, which has no way back from two things: it ends the program on errors, and destroys
 * a window as soon as it is asked to close. Both call us first, and we leave by longjmp(): nothing has been
 * changed at either place. */
#include "render/gl.h"
#include "render/window.h"

#include <GL/freeglut.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct window {
    int id; /* freeglut's */
    int width, height;
    const struct window_events *events;
    void *self;
    struct gl gl;
    bool quad;           /* the screen shows two buffers, an eye's each */
    int timer;           /* number of the timer call that is waited for */
    bool leaving, going; /* window_run() ends; the window is being destroyed */
    jmp_buf out;         /* of freeglut's main loop */
};

/* freeglut knows one set of windows a process, and tells its callbacks nothing of whose they are. */
static struct window *the_window;
static jmp_buf failed;
static char failure[256];
/* The process ends: Xlib does that when the display is gone, and freeglut closes windows then. */
static bool exiting;

static void note_exit(void)
{
    exiting = true;
}

static void on_error(const char *format, va_list arguments)
{
    vsnprintf(failure, sizeof failure, format, arguments);
    longjmp(failed, 1);
}

static void on_warning(const char *format, va_list arguments)
{
    (void)format, (void)arguments;
}

/* Ends every event: the way out of the main loop. */
static void end_event(void)
{
    if (the_window->leaving)
        longjmp(the_window->out, 1);
}

static void on_display(void)
{
    if (the_window->events->draw)
        the_window->events->draw(the_window->self);
    if (the_window->events->meanwhile) {
        the_window->gl.Flush();
        the_window->events->meanwhile(the_window->self);
    }
    glutSwapBuffers();
    end_event();
}

static void on_reshape(int width, int height)
{
    the_window->width = width > 0 ? width : 1;
    the_window->height = height > 0 ? height : 1;
    if (the_window->events->resize)
        the_window->events->resize(the_window->self, the_window->width, the_window->height);
    window_redraw(the_window);
    end_event();
}

/* X turns what is typed with ctrl into control characters: back to what is on the key. */
static int without_ctrl(int key)
{
    static const struct {
        int code, key;
    } others[] = {{0, '2'}, {27, '3'}, {28, '4'}, {29, '5'}, {30, '6'}, {31, '7'}, {127, '8'}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (others[i].code == key)
            return others[i].key;
    return key < 27 ? key + 'a' - 1 : key >= 'A' && key <= 'Z' ? key - 'A' + 'a' : key;
}

static void send_key(int key)
{
    int modifiers = glutGetModifiers();
    if (key < WINDOW_F1 && modifiers & WINDOW_CTRL)
        key = without_ctrl(key);
    if (the_window->events->key)
        the_window->events->key(the_window->self, key, modifiers);
    end_event();
}

static void on_keyboard(unsigned char key, int x, int y)
{
    (void)x, (void)y;
    send_key(key);
}

static void on_special(int key, int x, int y)
{
    static const struct {
        int glut, key;
    } keys[] = {
        {GLUT_KEY_LEFT, WINDOW_LEFT_ARROW}, {GLUT_KEY_RIGHT, WINDOW_RIGHT_ARROW},
        {GLUT_KEY_UP, WINDOW_UP_ARROW},     {GLUT_KEY_DOWN, WINDOW_DOWN_ARROW},
        {GLUT_KEY_PAGE_UP, WINDOW_PAGE_UP}, {GLUT_KEY_PAGE_DOWN, WINDOW_PAGE_DOWN},
        {GLUT_KEY_HOME, WINDOW_HOME},       {GLUT_KEY_END, WINDOW_END},
        {GLUT_KEY_INSERT, WINDOW_INSERT},
    };
    (void)x, (void)y;
    if (key >= GLUT_KEY_F1 && key <= GLUT_KEY_F12)
        send_key(WINDOW_F1 + key - GLUT_KEY_F1);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i].glut == key)
            send_key(keys[i].key);
}

static void on_mouse(int button, int state, int x, int y)
{
    if (the_window->events->button && button <= GLUT_RIGHT_BUTTON)
        the_window->events->button(the_window->self, (enum window_button)button, state == GLUT_DOWN, x, y,
                                   glutGetModifiers());
    end_event();
}

static void on_wheel(int wheel, int direction, int x, int y)
{
    if (the_window->events->wheel && wheel == 0)
        the_window->events->wheel(the_window->self, direction, x, y, glutGetModifiers());
    end_event();
}

static void on_motion(int x, int y)
{
    if (the_window->events->motion)
        the_window->events->motion(the_window->self, x, y, glutGetModifiers());
    end_event();
}

static void on_entry(int state)
{
    if (the_window->events->leave && state == GLUT_LEFT)
        the_window->events->leave(the_window->self);
    end_event();
}

static void on_timer(int number)
{
    if (!the_window || number != the_window->timer)
        return;
    the_window->timer++;
    if (the_window->events->timer)
        the_window->events->timer(the_window->self);
    end_event();
}

/* Called before anything is destroyed, on the request of the window manager or in window_free(). */
static void on_close(void)
{
    if (exiting || the_window->going)
        return;
    if (!the_window->events->close || the_window->events->close(the_window->self))
        the_window->leaving = true;
    longjmp(the_window->out, 1);
}

static void register_events(void)
{
    glutDisplayFunc(on_display);
    glutReshapeFunc(on_reshape);
    glutKeyboardFunc(on_keyboard);
    glutSpecialFunc(on_special);
    glutMouseFunc(on_mouse);
    glutMouseWheelFunc(on_wheel);
    glutMotionFunc(on_motion);
    glutPassiveMotionFunc(on_motion);
    glutEntryFunc(on_entry);
    glutCloseFunc(on_close);
}

/* No larger than the screen, where its size is known. */
static void fit_screen(struct window *window)
{
    const int width = glutGet(GLUT_SCREEN_WIDTH), height = glutGet(GLUT_SCREEN_HEIGHT);
    if (width > 0 && width < window->width)
        window->width = width;
    if (height > 0 && height < window->height)
        window->height = height;
}

static enum status open_glut(struct window *window, const char *title, struct error *err)
{
    char name[] = "balloon", *words[] = {name, NULL};
    int count = 1;
    const char *display = getenv("DISPLAY");
    const unsigned plain = GLUT_RGBA | GLUT_DOUBLE; /* depth and samples are the target's */
    glutInitErrorFunc(on_error);
    glutInitWarningFunc(on_warning);
    if (setjmp(failed)) {
        glutInitErrorFunc(NULL);
        return error_set(err, STATUS_RESOURCE, "no window can be opened on the display \"%s\": %s",
                         display ? display : "", failure);
    }
    signal(SIGPIPE, SIG_IGN); /* where the display goes away, Xlib answers the failed write: exit 1 */
    glutInit(&count, words);
    glutInitDisplayMode(plain | GLUT_STEREO);
    if (!glutGet(GLUT_DISPLAY_MODE_POSSIBLE))
        glutInitDisplayMode(plain);
    glutInitContextVersion(3, 3);
    glutInitContextProfile(GLUT_CORE_PROFILE);
    fit_screen(window);
    glutInitWindowSize(window->width, window->height);
    window->id = glutCreateWindow(title);
    window->quad = glutGet(GLUT_WINDOW_STEREO);
    glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_CONTINUE_EXECUTION);
    glutInitErrorFunc(NULL);
    return STATUS_OK;
}

enum status window_open(const char *title, int width, int height, const struct window_events *events,
                        void *self, struct window **result, struct error *err)
{
    struct window *window = calloc(1, sizeof *window);
    if (!window)
        return error_no_memory(err, "the window");
    *window = (struct window){.width = width, .height = height, .events = events, .self = self};
    enum status status = open_glut(window, title, err);
    if (status) {
        free(window);
        return status;
    }
    the_window = window;
    atexit(note_exit); /* called before freeglut's own, which is older */
    register_events();
    status = gl_load(&window->gl, window_function, err);
    if (status) {
        window_free(window);
        return status;
    }
    *result = window;
    return STATUS_OK;
}

void window_run(struct window *window)
{
    window->leaving = false;
    setjmp(window->out); /* back here after a close request, and from the last event */
    if (!window->leaving)
        glutMainLoop();
}

void window_close(struct window *window)
{
    window->leaving = true;
}

void window_free(struct window *window)
{
    if (!window)
        return;
    window->going = true;
    glutExit();
    the_window = NULL;
    free(window);
}

void window_redraw(struct window *window)
{
    glutSetWindow(window->id);
    glutPostRedisplay();
}

void window_timer(struct window *window, int milliseconds)
{
    window->timer++;
    if (milliseconds >= 0)
        glutTimerFunc((unsigned)milliseconds, on_timer, window->timer);
}

void window_title(struct window *window, const char *title)
{
    glutSetWindow(window->id);
    glutSetWindowTitle(title);
}

bool window_has_quad(const struct window *window)
{
    return window->quad;
}

static void copy_rows(const struct window *window, const unsigned char *pixels, struct image *image)
{
    size_t width = (size_t)window->width, height = (size_t)window->height;
    for (size_t y = 0; y < height; y++)
        memcpy(image->rgb + 3 * width * y, pixels + 3 * width * (height - 1 - y), 3 * width);
}

enum status window_screenshot(struct window *window, struct image *image, struct error *err)
{
    enum status status = image_resize(image, window->width, window->height, err);
    unsigned char *pixels = status ? NULL : malloc(3 * (size_t)window->width * (size_t)window->height);
    if (!status && !pixels)
        status = error_no_memory(err, "the picture of the window");
    if (status)
        return status;
    glutSetWindow(window->id);
    if (window->events->draw)
        window->events->draw(window->self);
    window->gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    window->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    window->gl.ReadPixels(0, 0, window->width, window->height, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    copy_rows(window, pixels, image);
    free(pixels);
    glutSwapBuffers();
    return STATUS_OK;
}

/* GLX, and so freeglut, believe that the window's context is current still and would do nothing: it is let go
 * and taken again. The types are those of glx.h, which would bring all of X with it. */
static void make_current_anew(void)
{
    void *(*display_of)(void) = (void *(*)(void))window_function("glXGetCurrentDisplay");
    unsigned long (*drawable_of)(void) = (unsigned long (*)(void))window_function("glXGetCurrentDrawable");
    void *(*context_of)(void) = (void *(*)(void))window_function("glXGetCurrentContext");
    int (*make_current)(void *, unsigned long,
                        void *) = (int (*)(void *, unsigned long, void *))window_function("glXMakeCurrent");
    if (!display_of || !drawable_of || !context_of || !make_current || !display_of())
        return; /* no GLX: nothing that could be confused */
    void *display = display_of(), *context = context_of();
    unsigned long drawable = drawable_of();
    make_current(display, 0, NULL);
    make_current(display, drawable, context);
}

void window_use(struct window *window, bool anew)
{
    glutSetWindow(window->id);
    if (anew)
        make_current_anew();
}

void (*window_function(const char *name))(void)
{
    return glutGetProcAddress(name);
}
