/* What the graphics card gets of a skin: no more than it needs, and nobody sees that. */
#include "render/geometry.h"
#include "renderer.h"
#include "sphere.h"

enum { SIDE = 8, POINTS = (SIDE + 1) * (2 * SIDE + 1), TRIANGLES = 4 * SIDE * SIDE };

/* A sheet of SIDE x 2 SIDE squares, bent in its middle towards the eye: two planes. */
struct sheet {
    double position[POINTS][3];
    uint32_t triangle[TRIANGLES][3];
    float opacity[TRIANGLES]; /* 1 */
    struct mesh mesh;
};

static void make_sheet(struct sheet *s)
{
    uint32_t p = 0, t = 0;
    for (uint32_t row = 0; row <= 2 * SIDE; row++)
        for (uint32_t column = 0; column <= SIDE; column++, p++) {
            const double down = (double)row / SIDE - 1;
            s->position[p][0] = (double)column / SIDE - 0.5 - 0.7 * fabs(down);
            s->position[p][1] = -down;
            s->position[p][2] = -fabs(down);
            if (row == 2 * SIDE || column == SIDE)
                continue;
            const uint32_t below = p + SIDE + 1;
            memcpy(s->triangle[t++], (const uint32_t[3]){p, below, below + 1}, sizeof *s->triangle);
            memcpy(s->triangle[t++], (const uint32_t[3]){p, below + 1, p + 1}, sizeof *s->triangle);
        }
    for (t = 0; t < TRIANGLES; t++)
        s->opacity[t] = 1;
    s->mesh = (struct mesh){
        .point_count = POINTS, .triangle_count = TRIANGLES, .position = s->position, .triangle = s->triangle};
}

static const struct render_view view = {.width = 300, .height = 200, .outlines = RENDER_SAMPLED};

static size_t vertices_of(const struct render_skin *skin)
{
    struct error err;
    struct geometry g = {0};
    struct render_view front = view;
    front.camera = front_camera();
    assert_ok(geometry_build(&g, &front, skin, 1, NULL, 0, &err), &err);
    const size_t count = g.vertices.count;
    assert_int_equal(g.opaque, TRIANGLES);
    assert_int_equal(g.indices.count, 3 * TRIANGLES);
    geometry_clear(&g);
    return count;
}

/* True when both make the same picture, to the bit. */
static bool look_alike(const struct render_skin *a, size_t a_count, const struct render_skin *b,
                       size_t b_count)
{
    struct render_view front = view;
    front.camera = front_camera();
    struct image one = drawn(&front, a, a_count), other = drawn(&front, b, b_count);
    const bool same = !memcmp(one.rgb, other.rgb, 3 * (size_t)view.width * (size_t)view.height);
    image_clear(&one);
    image_clear(&other);
    return same;
}

/* A sculpture has millions of squares that lie in a plane: each point of it has one vertex then. */
static void facets_that_lie_in_a_plane_share_vertices(void **state)
{
    (void)state;
    static struct sheet sheet;
    make_sheet(&sheet);
    const struct render_skin alike = {.mesh = &sheet.mesh, .colour = {0.6f, 0.4f, 0.2f}, .facets = true};
    struct render_skin own = alike;
    own.opacity = sheet.opacity;
    const size_t shared = vertices_of(&alike);
    assert_int_equal(vertices_of(&own), 3 * TRIANGLES);
    assert_in_range(shared, POINTS + SIDE + 1, TRIANGLES);
    assert_true(look_alike(&alike, 1, &own, 1));
    own.colour[0] = 0.5f;
    assert_false(look_alike(&alike, 1, &own, 1));
}

/* Many triangles are drawn some at a time: first a fine sphere within a coarse one, which hides it. */
static void of_many_triangles_all_are_drawn(void **state)
{
    (void)state;
    struct mesh outer = sphere_new(20, 20), inner = sphere_new(300, 600);
    for (uint32_t p = 0; p < inner.point_count; p++)
        for (int i = 0; i < 3; i++)
            inner.position[p][i] *= 0.5;
    const struct render_skin outside = {.mesh = &outer, .colour = {0.6f, 0.4f, 0.2f}};
    const struct render_skin both[2] = {{.mesh = &inner, .colour = {0.1f, 0.4f, 0.9f}}, outside};
    assert_true(look_alike(both, 2, &outside, 1));
    assert_false(look_alike(both, 1, &outside, 1));
    sphere_free(&outer);
    sphere_free(&inner);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_that_lie_in_a_plane_share_vertices),
        cmocka_unit_test(of_many_triangles_all_are_drawn),
    };
    return cmocka_run_group_tests_name("geometry", tests, open_renderer, close_renderer);
}
