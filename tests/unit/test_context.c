/* Without a display, whichever library gives the context: the picture is the same. */
#include "check.h"
#include "render/context.h"
#include "render/render.h"
#include "sphere.h"

#include <stdlib.h>

static struct image drawn_by(const char *name)
{
    struct error err;
    struct render *render;
    struct image image = {0};
    struct mesh mesh = sphere_new(20, 20);
    const struct render_skin skin = {
        .mesh = &mesh, .rest_opacity = 0.9f, .rest_shininess = 12, .colour = {0.7f, 0.05f, 0.05f}};
    const struct render_view view = {.width = 200,
                                     .height = 100,
                                     .stereo = RENDER_PARALLEL,
                                     .style = RENDER_LATEX,
                                     .order = RENDER_LIST,
                                     .samples = 2,
                                     .camera = {.eye = {0, 0, 5},
                                                .up = {0, 1, 0},
                                                .field_of_view_deg = 30,
                                                .eye_distance = 0.1,
                                                .screen_distance = 5}};
    setenv("BALLOON_CONTEXT", name, 1);
    assert_ok(render_open(200, 100, &render, &err), &err);
    assert_ok(render_draw(render, &view, &skin, 1, &image, &err), &err);
    render_close(render);
    unsetenv("BALLOON_CONTEXT");
    sphere_free(&mesh);
    return image;
}

static void every_library_draws_the_same_within_a_255th(void **state)
{
    (void)state;
    struct error err;
    struct context *egl;
    setenv("BALLOON_CONTEXT", "egl", 1);
    if (context_open(&egl, &err)) {
        print_message("# skipped, nothing was compared: EGL is not there: %s\n", err.text);
        unsetenv("BALLOON_CONTEXT");
        return;
    }
    assert_string_equal(context_name(egl), "egl");
    context_close(egl);
    struct image one = drawn_by("osmesa"), other = drawn_by("egl"), again = drawn_by("osmesa");
    for (int i = 0; i < 3 * 200 * 100; i++) {
        assert_near(one.rgb[i], other.rgb[i], 1);
        assert_int_equal(one.rgb[i], again.rgb[i]);
    }
    image_clear(&one);
    image_clear(&other);
    image_clear(&again);
}

static void a_library_that_is_not_known_is_refused_by_name(void **state)
{
    (void)state;
    struct error err;
    struct context *none;
    setenv("BALLOON_CONTEXT", "voodoo", 1);
    assert_refused(context_open(&none, &err), STATUS_RESOURCE, "BALLOON_CONTEXT is voodoo", &err);
    unsetenv("BALLOON_CONTEXT");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_library_draws_the_same_within_a_255th),
        cmocka_unit_test(a_library_that_is_not_known_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
