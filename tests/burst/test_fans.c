/* Points where more triangles meet than a cut goes through, as at the poles of a globe of many meridians. */
#include "sim/fracture.h"
#include "unit/check.h"

#include <math.h>
#include <string.h>

struct lantern {
    struct scene scene;
    struct sim sim;
    struct sim_balloon *balloon;
};

/* Two pyramids, base to base: all triangles meet at the poles, the last two points. */
static void make_pyramids(struct mesh *mesh, uint32_t sides)
{
    struct error err = {0};
    assert_ok(mesh_init(mesh, sides + 2, 2 * sides, false, &err), &err);
    for (uint32_t i = 0; i < sides; i++) {
        const uint32_t next = (i + 1) % sides;
        const double angle = 2 * M_PI * i / sides;
        memcpy(mesh->position[i], (double[3]){cos(angle), sin(angle)}, sizeof *mesh->position);
        memcpy(mesh->triangle[2 * i], (uint32_t[3]){i, next, sides}, sizeof *mesh->triangle);
        memcpy(mesh->triangle[2 * i + 1], (uint32_t[3]){next, i, sides + 1}, sizeof *mesh->triangle);
    }
    memcpy(mesh->position[sides], (double[3]){0, 0, 1}, sizeof *mesh->position);
    memcpy(mesh->position[sides + 1], (double[3]){0, 0, -1}, sizeof *mesh->position);
    assert_ok(mesh_connect(mesh, &err), &err);
}

static void open_lantern(struct lantern *it, uint32_t sides)
{
    static const char *const keys[] = {"balloons[0].fracture.mode=tear", "balloons[0].fracture.reserve=1",
                                       "balloons[0].damping=1", "time.guard=substep"};
    struct mesh mesh = {0};
    struct error err = {0};
    make_pyramids(&mesh, sides);
    *it = (struct lantern){0};
    assert_ok(scene_from_mesh("lantern.ply", &it->scene, &err), &err);
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        assert_ok(scene_set(&it->scene, keys[i], &err), &err);
    assert_ok(scene_check(&it->scene, &err), &err);
    assert_ok(sim_open(&it->sim, &it->scene, &mesh, 1, &err), &err);
    it->balloon = it->sim.balloons;
    mesh_clear(&mesh);
}

static void close_lantern(struct lantern *it)
{
    sim_clear(&it->sim);
    scene_clear(&it->scene);
}

static void slit_to_the_pole(struct lantern *it, uint32_t point)
{
    it->balloon->fracture->stamps++;
    fracture_slit(&it->sim, it->balloon, point, (const double[3]){0, 0, 1}, 0.1 * it->balloon->radius);
}

/* The first ends there; the second would cut the pole in two, and the lists of what is new have no room for
 * a thousand triangles at once. */
static void slits_meet_at_a_pole_and_it_is_told(void **unused)
{
    (void)unused;
    struct lantern it;
    open_lantern(&it, 2000);
    slit_to_the_pole(&it, 0);
    slit_to_the_pole(&it, 1000);
    const struct sim_part *tail = it.balloon->topology->tail;
    assert_true(tail->triangle_in_count <= tail->triangle_in_room);
    assert_true(tail->edge_in_count <= tail->edge_in_room);
    assert_true(topology_is_sound(&it.sim, it.balloon));
    assert_int_equal(it.sim.news_count, 2);
    assert_string_equal(it.sim.news[0].text, "the skin tears");
    assert_non_null(strstr(it.sim.news[1].text, "more than 64 triangles meet"));
    close_lantern(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slits_meet_at_a_pole_and_it_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
