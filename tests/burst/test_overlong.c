/* Edges that are far from their thresholds are not looked at; and nothing depends on who was. */
#include "sim/sim.h"
#include "support/shapes.h"
#include "unit/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KEYS_MAX = 8, STEPS = 400 };

struct ball {
    struct scene scene;
    struct sim sim;
};

/* Of so few triangles that edges grow about as fast as their ends move. */
static void open_ball(struct ball *ball, const char *const keys[KEYS_MAX])
{
    static const char *const all[] = {"balloons[0].radius=1", "balloons[0].pressure=0",
                                      "time.guard=substep",   "time.integrator=symplectic-euler",
                                      "time.step=0.005",      "time.end=2"};
    struct error err = {0};
    struct mesh mesh = {0};
    *ball = (struct ball){0};
    shape_icosphere(0, &mesh);
    assert_ok(mesh_order(&mesh, &err), &err);
    assert_ok(scene_from_mesh("sphere", &ball->scene, &err), &err);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        assert_ok(scene_set(&ball->scene, all[i], &err), &err);
    for (int i = 0; i < KEYS_MAX && keys[i]; i++)
        assert_ok(scene_set(&ball->scene, keys[i], &err), &err);
    assert_ok(scene_check(&ball->scene, &err), &err);
    assert_ok(sim_open(&ball->sim, &ball->scene, &mesh, 1, &err), &err);
    mesh_clear(&mesh);
}

static void close_ball(struct ball *ball)
{
    sim_clear(&ball->sim);
    scene_clear(&ball->scene);
}

/* A step, and whether edges were looked at in it. */
static bool looks(struct sim *sim)
{
    struct error err = {0};
    sim->edge_rooms[0] = NAN;
    assert_ok(sim_step(sim, &err), &err);
    return !isnan(sim->edge_rooms[0]);
}

/* Beside one that looks in each step. This one looks in no more than `most`, by how near edges come. */
static void check_the_same_breaks(int most, const char *const keys[KEYS_MAX])
{
    struct ball lazy, watchful;
    int count = 0;
    open_ball(&lazy, keys);
    open_ball(&watchful, keys);
    for (int i = 0; i < STEPS; i++) {
        count += looks(&lazy.sim);
        watchful.sim.edge_room = -INFINITY;
        assert_true(looks(&watchful.sim));
        assert_int_equal(lazy.sim.broken, watchful.sim.broken);
    }
    assert_true(sim_hash(&lazy.sim) == sim_hash(&watchful.sim));
    assert_true(lazy.sim.broken > 0);
    assert_in_range(count, 2, most);
    close_ball(&lazy);
    close_ball(&watchful);
}

#define RUBBER                                                                      \
    "balloons[0].membrane.shear_modulus=10", "balloons[0].membrane.thickness=0.02", \
        "balloons[0].membrane.density=2"

static void rubber_that_swells(void **state)
{
    (void)state;
    check_the_same_breaks(200,
                          (const char *[KEYS_MAX]){RUBBER, "balloons[0].pressure_on=areas",
                                                   "balloons[0].pressure=0.5", "balloons[0].threshold=1.5"});
}

/* What auto has chosen moves points by one sweep. */
static void rubber_that_swells_by_the_method_that_is_chosen(void **state)
{
    (void)state;
    check_the_same_breaks(200, (const char *[KEYS_MAX]){RUBBER, "balloons[0].pressure_on=areas",
                                                        "balloons[0].pressure=0.5",
                                                        "balloons[0].threshold=1.5", "time.integrator=auto"});
}

static void a_threshold_that_falls(void **state)
{
    (void)state;
    check_the_same_breaks(200, (const char *[KEYS_MAX]){RUBBER, "balloons[0].pressure_on=areas",
                                                        "balloons[0].pressure=0.2", "schedule[0].at=1",
                                                        "schedule[0].threshold=1.1"});
}

/* It asks for forces four times a step, and nobody knows how far points have gone by all of them. */
static void rubber_that_swells_by_another_method(void **state)
{
    (void)state;
    check_the_same_breaks(
        STEPS, (const char *[KEYS_MAX]){RUBBER, "balloons[0].pressure_on=areas", "balloons[0].pressure=0.5",
                                        "balloons[0].threshold=1.5", "time.integrator=rk4"});
}

/* Each edge's threshold is its own rest length's, and that changes. */
static void edges_that_slip(void **state)
{
    (void)state;
    struct ball ball;
    int slips = 0;
    open_ball(&ball, (const char *[KEYS_MAX]){"balloons[0].pressure=-1", "balloons[0].threshold_of=edge",
                                              "balloons[0].threshold=5", "balloons[0].plasticity.yield=0.2",
                                              "balloons[0].plasticity.hardening=20"});
    double *rest = malloc(ball.sim.edge_count * sizeof *rest);
    for (int i = 0; i < 100; i++) {
        memcpy(rest, ball.sim.rest_length, ball.sim.edge_count * sizeof *rest);
        ball.sim.edge_room = 1;
        looks(&ball.sim);
        const bool slipped = memcmp(rest, ball.sim.rest_length, ball.sim.edge_count * sizeof *rest) != 0;
        slips += slipped;
        assert_true(slipped == (ball.sim.edge_room < 0));
    }
    assert_in_range(slips, 1, 99);
    free(rest);
    close_ball(&ball);
}

/* The state just before an edge lets go, put back into one that begins: what it knew of its edges is not
 * known of these. */
static void a_state_that_is_put_back(void **state)
{
    (void)state;
    static const char *const keys[KEYS_MAX] = {RUBBER, "balloons[0].pressure_on=areas",
                                               "balloons[0].pressure=0.5", "balloons[0].threshold=1.5"};
    struct ball late, early;
    size_t count;
    int steps = -1;
    open_ball(&early, keys);
    for (; early.sim.broken == 0 && steps < STEPS; steps++)
        looks(&early.sim);
    close_ball(&early);
    open_ball(&early, keys);
    open_ball(&late, keys);
    looks(&early.sim);
    for (int i = 0; i < steps; i++)
        looks(&late.sim);
    assert_int_equal(late.sim.broken, 0);
    const struct sim_block *from = sim_blocks(&late.sim, &count);
    const struct sim_block *to = sim_blocks(&early.sim, &count);
    for (size_t i = 0; i < count; i++)
        if (from[i].size > 0) /* some are of what is not there */
            memcpy(to[i].data, from[i].data, from[i].size);
    assert_true(sim_restored(&early.sim));
    looks(&early.sim);
    assert_true(early.sim.broken > 0);
    close_ball(&late);
    close_ball(&early);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rubber_that_swells),
        cmocka_unit_test(rubber_that_swells_by_the_method_that_is_chosen),
        cmocka_unit_test(a_threshold_that_falls),
        cmocka_unit_test(rubber_that_swells_by_another_method),
        cmocka_unit_test(edges_that_slip),
        cmocka_unit_test(a_state_that_is_put_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
