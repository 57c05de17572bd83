/* What motion must keep, whatever method moves the points: rest, rigid motion, momentum, the stated order,
 * and the way on from any state. */
#include "hard.h"

/* Without pressure a balloon at rest has no force on any point, to the bit: 10^5
 * steps of it change nothing. */
static void at_rest_nothing_moves_by_a_bit_in_1e5_steps(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, HARD("balloons[0].pressure=0"));
    double(*before)[4] = malloc(b.sim.point_count * sizeof *before);
    assert_non_null(before);
    memcpy(before, b.sim.position, b.sim.point_count * sizeof *before);
    steps(&b, 100000);
    assert_memory_equal(before, b.sim.position, b.sim.point_count * sizeof *before);
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        assert_near(vec3_length(b.sim.velocity[p]), 0, 0);
    free(before);
    close_balloon(&b);
}

/* A stiff membrane's forces at rest are rounding, a millionth of which no Newton's method finds: a step is as
 * good as it gets then. Nothing moves by more than a part in 1e10. */
static void at_rest_a_stiff_membrane_is_no_riddle_for_implicit_methods(void **state)
{
    (void)state;
    static const char *const methods[] = {"time.integrator=backward-euler", "time.integrator=bdf2",
                                          "time.integrator=implicit-midpoint"};
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++) {
        struct balloon b;
        open_balloon(&b, 2,
                     HARD("balloons[0].pressure=0", "time.step=1", "balloons[0].membrane.thickness=0.5",
                          "balloons[0].membrane.shear_modulus=1e6", methods[i]));
        steps(&b, 3);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            assert_near(vec3_length(b.sim.position[p]) / 45, 1, 1e-10);
        close_balloon(&b);
    }
}

/* Speeds and distances up to 1e3, rounded to 1e-13, whose elastic energy is k times the square of that. */
static void a_balloon_that_only_flies_feels_no_force(void **state)
{
    (void)state;
    for (const struct integrator *const *method = integrators; *method; method++) {
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
        struct balloon b;
        open_balloon(&b, 1, HARD("balloons[0].pressure=0", name));
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            memcpy(b.sim.velocity[p], (double[4]){10, -20, 30, 0}, sizeof *b.sim.velocity);
        guard_outdated(&b.sim);
        const double begin = sim_measure(&b.sim).kinetic_energy;
        steps(&b, 1000);
        const struct sim_measures m = sim_measure(&b.sim);
        /* methods that choose their steps may err by 1e-5 radii in each place: k (45e-5)^2/2 on each of 120
         * edges, and by 1e-5 of the speed */
        const bool chooses = (*method)->flags & INTEGRATOR_ADAPTIVE;
        assert_near(m.kinetic_energy / begin, 1, chooses ? 2e-5 : 1e-9);
        assert_near(m.elastic_energy, 0, chooses ? 3e-4 : 1e-15);
        close_balloon(&b);
    }
}

static void angular_momentum_of(const struct sim *sim, double sum[3])
{
    for (int i = 0; i < 3; i++)
        sum[i] = 0;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        double l[3];
        vec3_cross(sim->position[p], sim->velocity[p], l);
        for (int i = 0; i < 3; i++)
            sum[i] += sim->mass[p] * l[i];
    }
}

/* Forces along edges have no torque, and x += v dt with the same v none either: kept to rounding by both
 * orders of Euler's update and by Verlet. */
static void a_spinning_balloon_keeps_its_angular_momentum(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, HARD("balloons[0].pressure=0"));
    for (uint32_t p = 0; p < b.sim.point_count; p++) {
        b.sim.velocity[p][0] = -b.sim.position[p][1];
        b.sim.velocity[p][1] = b.sim.position[p][0];
    }
    guard_outdated(&b.sim);
    double before[3], after[3];
    angular_momentum_of(&b.sim, before);
    steps(&b, 2000);
    angular_momentum_of(&b.sim, after);
    for (int i = 0; i < 3; i++)
        assert_near((after[i] - before[i]) / before[2], 0, 1e-12);
    assert_true(sim_measure(&b.sim).mean_radius > 45); /* it spins, and bulges */
    close_balloon(&b);
}

/* At half the bound of the springs a method multiplies no oscillation, and at the bound of the dampers no
 * decay: whatever limits a method states, the guard's split by them must hold. */
static void every_method_calms_a_shaken_balloon_within_its_bound(void **state)
{
    (void)state;
    for (const struct integrator *const *method = integrators; *method; method++)
        for (int damping = 0; damping < 3; damping++) {
            static const char *const dampings[] = {"balloons[0].damping=0.1", "balloons[0].damping=1",
                                                   "balloons[0].damping=30"};
            char name[64];
            snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
            struct balloon b;
            open_balloon(&b, 1, HARD("balloons[0].pressure=0", name, dampings[damping]));
            const double stable = guard_stable_step(&b.sim);
            if (stable < 0.1)
                b.sim.whole_step = b.sim.step = 0.999 * stable;
            disturb(&b, 0.1);
            const double begin = energy_of(&b);
            steps(&b, 300);
            assert_true(energy_of(&b) < ((*method)->oscillation_limit > 0 ? begin : 7.4 * begin));
            close_balloon(&b);
        }
}

/* All that the future depends on is in sim_blocks(): put into another sim at any step, it goes on to the bit,
 * in substeps, over changes by the schedule, while edges let go, and with every method. */
static void a_state_taken_over_at_every_step_goes_on_to_the_bit(void **state)
{
    (void)state;
    struct error err = {0};
    for (const struct integrator *const *method = integrators; *method; method++) {
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
        struct balloon b;
        struct sim other;
        open_balloon(&b, 1,
                     SETTINGS("time.guard=substep", "time.step=0.05", "balloons[0].pressure=300",
                              "balloons[0].threshold=1.2", name, "schedule[0].at=0.2",
                              "schedule[0].pressure=900", "time.end=3"));
        for (int i = 0; i < 40 || (!b.sim.broken && i < 4000); i++) {
            size_t count, same;
            assert_ok(sim_open(&other, &b.scene, &b.mesh, 1, &err), &err);
            const struct sim_block *from = sim_blocks(&b.sim, &count), *to = sim_blocks(&other, &same);
            assert_int_equal(same, count);
            for (size_t k = 0; k < count; k++)
                if (from[k].size > 0) /* an empty block has no address */
                    memcpy(to[k].data, from[k].data, from[k].size);
            steps(&b, 1);
            assert_ok(sim_step(&other, &err), &err);
            if (sim_hash(&other) != sim_hash(&b.sim))
                print_error("%s, step %d\n", (*method)->name, i);
            assert_true(sim_hash(&other) == sim_hash(&b.sim));
            sim_clear(&other);
        }
        assert_true(b.sim.broken > 0);
        close_balloon(&b);
    }
}

/* Mean radius at .8 s by steps of `step`. */
static double radius_by(const char *method, double step)
{
    char name[64], size[64];
    snprintf(name, sizeof name, "time.integrator=%s", method);
    snprintf(size, sizeof size, "time.step=%.17g", step);
    struct balloon b;
    open_balloon(&b, 1,
                 SETTINGS("time.guard=off", "balloons[0].threshold=1e300", "balloons[0].pressure=60",
                          "balloons[0].damping=0.2", name, size));
    steps(&b, (int)lround(0.8 / step));
    const double radius = sim_measure(&b.sim).mean_radius;
    close_balloon(&b);
    return radius;
}

/* dt halved three times: the differences between one step and the next smaller
 * shrink by 2^order each time. */
static void every_method_has_the_order_that_it_states(void **state)
{
    (void)state;
    for (const struct integrator *const *method = integrators; *method; method++) {
        if ((*method)->flags & INTEGRATOR_ADAPTIVE || (*method)->choose)
            continue; /* it is not the step that decides */
        const double step = (*method)->order > 2 ? 0.02 : 0.0025;
        double radius[4];
        for (int i = 0; i < 4; i++)
            radius[i] = radius_by((*method)->name, ldexp(step, -i));
        const double order = log2((radius[2] - radius[1]) / (radius[3] - radius[2]));
        if (fabs(order - (*method)->order) > 0.2)
            print_error("%s\n", (*method)->name);
        assert_near(order, (*method)->order, 0.2);
    }
}

/* Springs and pressure per area stay as points become more: a hexagonal net of springs k is a sheet of the
 * stiffness k whatever the length of its edges, and each point gets its share of the same push. The balloon
 * at rest under pressure converges. */
static void the_radius_at_rest_converges_as_the_mesh_is_refined(void **state)
{
    (void)state;
    double radius[4];
    for (unsigned level = 1; level <= 4; level++) {
        const double points = 10 * pow(4, level) + 2;
        char pressure[64], damping[64];
        snprintf(pressure, sizeof pressure, "balloons[0].pressure=%g", 5000 / points);
        snprintf(damping, sizeof damping, "balloons[0].damping=%g", 2.0);
        struct balloon b;
        open_balloon(&b, level, HARD(pressure, damping));
        while (b.sim.time < 40)
            steps(&b, 1);
        radius[level - 1] = sim_measure(&b.sim).mean_radius;
        close_balloon(&b);
    }
    for (int i = 0; i < 2; i++)
        assert_true(fabs(radius[i + 2] - radius[i + 1]) < 0.5 * fabs(radius[i + 1] - radius[i]));
}

/* A weight that bounces on a string, tied to skin that is held: some hundred bounces, by which no method
 * makes more energy than there was. */
static void a_weight_that_bounces_gains_nothing(void **state)
{
    (void)state;
    static const char *const stiff[] = {"balloons[0].string.stiffness=1000",
                                        "balloons[0].string.stiffness=1e5"};
    for (const struct integrator *const *method = integrators; *method; method++)
        for (int i = 0; i < 2; i++) {
            struct balloon b;
            char name[64];
            snprintf(name, sizeof name, "time.integrator=%s", (*method)->name);
            open_balloon(&b, 0,
                         HARD(name, "time.step=0.02", "balloons[0].pressure=0", "balloons[0].pins.reach=180",
                              "balloons[0].string.weight=1", "balloons[0].string.damping=0",
                              "balloons[0].string.slack=0.9", stiff[i]));
            const struct effect *string = NULL;
            for (size_t k = 0; k < b.sim.hook_count[EFFECT_FORCES]; k++)
                if (!strcmp(b.sim.hooks[EFFECT_FORCES][k].effect->name, "string"))
                    string = b.sim.hooks[EFFECT_FORCES][k].effect;
            assert_non_null(string);
            const double first = string->energy(&b.sim, &b.sim.balloons[0]);
            steps(&b, 1000);
            const double now = string->energy(&b.sim, &b.sim.balloons[0]);
            print_message("# %s: %.3g of the energy is left\n", name, now / first);
            assert_true(now < 1.1 * first);
            close_balloon(&b);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_rest_nothing_moves_by_a_bit_in_1e5_steps),
        cmocka_unit_test(at_rest_a_stiff_membrane_is_no_riddle_for_implicit_methods),
        cmocka_unit_test(a_balloon_that_only_flies_feels_no_force),
        cmocka_unit_test(a_spinning_balloon_keeps_its_angular_momentum),
        cmocka_unit_test(every_method_calms_a_shaken_balloon_within_its_bound),
        cmocka_unit_test(a_state_taken_over_at_every_step_goes_on_to_the_bit),
        cmocka_unit_test(every_method_has_the_order_that_it_states),
        cmocka_unit_test(the_radius_at_rest_converges_as_the_mesh_is_refined),
        cmocka_unit_test(a_weight_that_bounces_gains_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
