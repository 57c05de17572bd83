/* Writes down what a window tells it. It refuses to close once, then agrees. */
#include "render/orbit.h"
#include "render/overlay.h"
#include "render/solid.h"
#include "render/window.h"

#include <stdio.h>
#include <string.h>

struct events {
    struct window *window;
    struct render *render, *other; /* in the window, and off-screen */
    struct render_view view;
    int closes;
    bool compared;
};

static void fail(const struct error *err)
{
    fprintf(stderr, "%s\n", err->text);
}

static const struct render_line line = {
    .from = {0, 0, 0}, .to = {1, 1, 1}, .colour = {0, 0.5f, 0}, .opacity = 1, .width = 3, .on_top = true};
static const struct render_text text = {
    .text = "window", .x = 8, .y = 8, .scale = 2, .colour = {1, 1, 1}, .boxed = true};
static const struct render_scene scene = {.lines = &line, .line_count = 1, .texts = &text, .text_count = 1};

static void draw(void *self)
{
    struct events *e = self;
    struct error err;
    if (render_show(e->render, &e->view, &scene, &err))
        fail(&err);
}

/* The window's pixels against those of another context, which is in use in between. */
static bool pictures_agree(struct events *e)
{
    struct error err;
    struct image shown = {0}, drawn = {0}, again = {0};
    bool same = !window_screenshot(e->window, &shown, &err) &&
                !render_draw_scene(e->other, &e->view, &scene, &drawn, &err) &&
                !render_draw_scene(e->render, &e->view, &scene, &again, &err) && shown.width == drawn.width &&
                shown.height == drawn.height;
    size_t size = same ? 3 * (size_t)shown.width * (size_t)shown.height : 0;
    same = same && !memcmp(shown.rgb, drawn.rgb, size) && !memcmp(again.rgb, drawn.rgb, size);
    image_clear(&shown);
    image_clear(&drawn);
    image_clear(&again);
    return same;
}

static void timer(void *self)
{
    struct events *e = self;
    if (e->compared)
        puts("timer");
    else
        puts(pictures_agree(e) ? "same" : "different");
    e->compared = true;
}

static void resize(void *self, int width, int height)
{
    struct events *e = self;
    e->view.width = width;
    e->view.height = height;
    printf("resize %d %d\n", width, height);
    if (!e->compared)
        window_timer(e->window, 0);
}

static void key(void *self, int code, int modifiers)
{
    struct events *e = self;
    printf("key %d %d\n", code, modifiers);
    if (code == 'q')
        window_close(e->window);
    if (code == 's')
        printf("%s %d %d\n", pictures_agree(e) ? "same" : "different", e->view.width, e->view.height);
    for (int i = 0; i < 3 && code == 't'; i++)
        window_timer(e->window, 20);
}

static void button(void *self, enum window_button number, bool pressed, int x, int y, int modifiers)
{
    (void)self;
    printf("button %d %d %d %d %d\n", (int)number, pressed, x, y, modifiers);
}

static void wheel(void *self, int steps, int x, int y, int modifiers)
{
    (void)self;
    printf("wheel %d %d %d %d\n", steps, x, y, modifiers);
}

static void motion(void *self, int x, int y, int modifiers)
{
    (void)self;
    printf("motion %d %d %d\n", x, y, modifiers);
}

static bool may_close(void *self)
{
    struct events *e = self;
    puts(e->closes ? "close agreed" : "close refused");
    return e->closes++;
}

int main(void)
{
    static const struct window_events events = {.draw = draw,
                                                .resize = resize,
                                                .key = key,
                                                .button = button,
                                                .wheel = wheel,
                                                .motion = motion,
                                                .timer = timer,
                                                .close = may_close};
    struct events e = {.view = {.width = 320, .height = 240, .outlines = RENDER_SAMPLED}};
    struct orbit orbit = orbit_start();
    struct error err;
    setvbuf(stdout, NULL, _IOLBF, 0);
    orbit_camera(&orbit, &e.view.camera);
    enum status status = window_open("events", 320, 240, &events, &e, &e.window, &err);
    if (!status)
        status = render_open_window(e.window, &e.render, &err);
    if (!status)
        status = render_open(320, 240, &e.other, &err);
    if (!status)
        window_run(e.window);
    render_close(e.other);
    render_close(e.render);
    window_free(e.window);
    if (status)
        fail(&err);
    return status ? 3 : 0;
}
