/* Two rubber balloons joined by a tube, both blown up past the limit point: the smaller one has the higher pressure and empties into the larger
 * (for instance Mueller and Strehlow, Rubber and Rubber Balloons, 2004). */
#include "common/vec3.h"
#include "sim/effect_gas.h"
#include "sim/sim.h"
#include "unit/balloon.h"

/* Of the balloon's points, from their middle. */
static double stretch_of(const struct sim *sim, const struct sim_balloon *b)
{
    double sum = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        sum += vec3_distance(sim->position[p], b->centre);
    return sum / (b->point_end - b->point_begin);
}

static double neo_hookean(double stretch)
{
    return 2 * (1 / stretch - pow(stretch, -7));
}

static const char *const settings[] = {
    "radius=1",           "threshold=1e300",         "membrane.thickness=0.01", "membrane.shear_modulus=1",
    "membrane.density=1", "membrane.viscosity=0.05", "gas.ambient=1",           "gas.density=0.001",
};

static void make_scene(struct scene *scene)
{
    struct error err = {0};
    char text[96];
    assert_ok(scene_from_mesh("sphere", scene, &err), &err);
    assert_ok(scene_set(scene, "balloons[1].mesh=sphere", &err), &err);
    for (int b = 0; b < 2; b++)
        for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++) {
            snprintf(text, sizeof text, "balloons[%d].%s", b, settings[i]);
            assert_ok(scene_set(scene, text, &err), &err);
        }
    const char *const more[] = {"balloons[1].position=[10,0,0]",
                                "balloons[0].gas.fill=4.14",
                                "balloons[1].gas.fill=10.74",
                                "balloons[0].tube.to=1",
                                "balloons[0].tube.area=0.1",
                                "time.guard=substep",
                                "time.step=0.02",
                                "time.end=1e6"};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        assert_ok(scene_set(scene, more[i], &err), &err);
    assert_ok(scene_check(scene, &err), &err);
}

static void the_smaller_shrinks_and_the_larger_grows(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene scene = {0};
    struct mesh meshes[2] = {0};
    struct sim sim;
    make_scene(&scene);
    for (int i = 0; i < 2; i++)
        shape_icosphere(2, &meshes[i]);
    assert_ok(sim_open(&sim, &scene, meshes, 1, &err), &err);
    const double start[2] = {1.6, 2.2};
    double first = 0;
    for (int b = 0; b < 2; b++)
        for (uint32_t p = sim.balloons[b].point_begin; p < sim.balloons[b].point_end; p++)
            for (int i = 0; i < 3; i++) {
                const double centre = sim.balloons[b].centre[i];
                sim.position[p][i] = centre + start[b] * (sim.position[p][i] - centre);
            }
    sim_forces(&sim);
    for (int b = 0; b < 2; b++)
        first += gas_look(&sim, &sim.balloons[b]).amount;
    for (int i = 0; i < 5000; i++)
        assert_ok(sim_step(&sim, &err), &err);
    sim_forces(&sim);
    const struct gas_look small = gas_look(&sim, &sim.balloons[0]), large = gas_look(&sim, &sim.balloons[1]);
    const double stretch[2] = {stretch_of(&sim, &sim.balloons[0]), stretch_of(&sim, &sim.balloons[1])};
    print_message("# stretch %.3f and %.3f, pressures %.5f and %.5f, p* %.4f and %.4f\n", stretch[0],
                  stretch[1], small.gauge_pressure, large.gauge_pressure, neo_hookean(stretch[0]),
                  neo_hookean(stretch[1]));
    assert_true(stretch[0] < 1.38 && stretch[1] > start[1]);
    assert_near(small.gauge_pressure / large.gauge_pressure, 1, 0.01);
    assert_near(small.gauge_pressure / 0.01 / neo_hookean(stretch[0]), 1, 0.02); /* 320 triangles: 1.55 % */
    assert_near(small.amount + large.amount, first, 1e-12 * first);
    sim_clear(&sim);
    for (int i = 0; i < 2; i++)
        mesh_clear(&meshes[i]);
    scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_smaller_shrinks_and_the_larger_grows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
