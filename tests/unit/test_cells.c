/* Triangles that are sorted and many are drawn cell by cell: nobody sees that. */
#include "render/cells.h"
#include "renderer.h"
#include "sphere.h"

/* A sphere, and two more behind the eye, which nobody sees: with the first of these there are a few triangles
 * too few for cells, with the second enough. */
struct spheres {
    struct mesh mesh[3];
    struct render_skin skin[3];
    float opacity[2 * 50 * 60];
};

static void make_spheres(struct spheres *s)
{
    for (size_t t = 0; t < sizeof s->opacity / sizeof *s->opacity; t++)
        s->opacity[t] = (float)(t % 7) / 10;
    s->mesh[0] = sphere_new(50, 60);
    s->mesh[1] = sphere_new(10, 4);
    s->mesh[2] = sphere_new(10, 20);
    for (int i = 1; i < 3; i++)
        for (uint32_t p = 0; p < s->mesh[i].point_count; p++)
            s->mesh[i].position[p][2] += 30; /* the eye is at 10 */
    for (int i = 0; i < 3; i++)
        s->skin[i] = (struct render_skin){.mesh = &s->mesh[i],
                                          .opacity = s->opacity,
                                          .rest_opacity = 0.6f,
                                          .rest_shininess = 12,
                                          .colour = {0.7f, 0.1f, 0.05f}};
}

static void free_spheres(struct spheres *s)
{
    for (int i = 0; i < 3; i++)
        sphere_free(&s->mesh[i]);
}

static void check_same(const struct render_view *view, const struct spheres *s)
{
    const struct render_skin enough[2] = {s->skin[0], s->skin[2]};
    struct image few = drawn(view, s->skin, 2), many = drawn(view, enough, 2);
    assert_memory_equal(few.rgb, many.rgb, 3 * (size_t)view->width * (size_t)view->height);
    image_clear(&few);
    image_clear(&many);
}

static void cells_make_the_same_picture_to_the_bit(void **state)
{
    (void)state;
    static struct spheres s;
    make_spheres(&s);
    for (enum render_style style = RENDER_PAPER; style <= RENDER_LATEX; style++)
        for (enum render_stereo stereo = RENDER_MONO; stereo <= RENDER_PARALLEL; stereo++)
            for (int samples = 1; samples <= 2; samples++)
                for (int nearer = 0; nearer < 2; nearer++) {
                    struct render_view view = {.width = 500,
                                               .height = 330,
                                               .stereo = stereo,
                                               .order = RENDER_SORT,
                                               .style = style,
                                               .samples = samples,
                                               .camera = front_camera()};
                    if (nearer) /* it is larger than the picture */
                        view.camera.field_of_view_deg /= 3;
                    check_same(&view, &s);
                }
    free_spheres(&s);
}

/* Builds the cells of the picture's first eye. */
static void build(const struct render_view *view, const struct spheres *s, struct geometry *g,
                  struct camera_eye eyes[2], struct cells *cells)
{
    struct error err;
    camera_eyes(view, eyes);
    assert_ok(geometry_build(g, view, s->skin, 3, NULL, 0, &err), &err);
    assert_true(cells_are_worth_it(g, view));
    assert_ok(cells_build(cells, g, &eyes[0], &err), &err);
}

/* Each cell has its triangles in the order of all, and each triangle in sight is in all cells
 * that its corners are in. */
static void cells_hold_what_reaches_into_them_in_order(void **state)
{
    (void)state;
    static struct spheres s;
    static struct cells cells;
    struct geometry g = {0};
    struct camera_eye eyes[2];
    const struct render_view view = {
        .width = 500, .height = 330, .order = RENDER_SORT, .camera = front_camera()};
    make_spheres(&s);
    build(&view, &s, &g, eyes, &cells);
    const int count = cells.columns * cells.rows;
    assert_true(count > 3);
    size_t found = 0;
    for (int i = 0; i < count; i++) {
        size_t t = 0; /* in the order of all */
        for (size_t k = cells.begin[i]; k < cells.begin[i + 1]; k++, t++) {
            while (t < g.translucent.count &&
                   memcmp(g.translucent.items[t].vertex, cells.indices.items + 3 * k, sizeof(uint32_t[3])))
                t++;
            assert_true(t < g.translucent.count);
            for (int c = 0; c < 3; c++) {
                const float *at = cells.places.items[cells.indices.items[3 * k + c]];
                /* as numbers: what is behind the eye is at no place */
                found += floorf(at[0]) == (float)(i % cells.columns) &&
                         floorf(at[1]) == (float)(i / cells.columns);
            }
        }
    }
    /* every corner of the sphere in sight, once */
    assert_int_equal(found, 3 * s.mesh[0].triangle_count);
    cells_clear(&cells);
    geometry_clear(&g);
    free_spheres(&s);
}

static void where_samples_would_be_lost_there_are_none(void **state)
{
    (void)state;
    struct geometry g = {.translucent = {.count = 100000}};
    struct render_view view = {.order = RENDER_SORT};
    assert_true(cells_are_worth_it(&g, &view));
    view.outlines = RENDER_SAMPLED;
    assert_false(cells_are_worth_it(&g, &view));
    view.samples = 2; /* these are several pixels, and nothing is lost */
    assert_true(cells_are_worth_it(&g, &view));
    view.order = RENDER_LIST;
    assert_false(cells_are_worth_it(&g, &view));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_make_the_same_picture_to_the_bit),
        cmocka_unit_test(cells_hold_what_reaches_into_them_in_order),
        cmocka_unit_test(where_samples_would_be_lost_there_are_none),
    };
    return cmocka_run_group_tests(tests, open_renderer, close_renderer);
}
