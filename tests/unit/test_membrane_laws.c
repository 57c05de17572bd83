/* What a triangle of rubber answers by each law: pulled, slack, hardly strained, and by Ogden's powers. */
#include "membranes.h"
#include "sim/membrane_kernels.h"

enum { LAWS = 4 };
static const char *const laws[LAWS] = {"balloons[0].membrane.law=neo-hookean",
                                       "balloons[0].membrane.law=mooney-rivlin",
                                       "balloons[0].membrane.law=gent", "balloons[0].membrane.law=ogden"};

/* Uniaxial: pulled to 2 along x while y and z shrink far below 2^-1/2, a triangle holds what neo-Hookean
 * rubber does when pulled: W = (4 + 2/2 - 3)/2 = 1, and pulls along x alone with 2 - 1/4. */
static void a_wrinkled_triangle_holds_what_a_pulled_strip_does(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2, RUBBER("balloons[0].membrane.compression=0"));
    struct sim *sim = &b.sim;
    /* The first triangle's own frame: its points to 2 x along its first side, 0.5 across. */
    const uint32_t *p = sim->triangle_point[0];
    double u[3], v[3], along = 0, length = 0;
    for (int i = 0; i < 3; i++) {
        u[i] = sim->position[p[1]][i] - sim->position[p[0]][i];
        v[i] = sim->position[p[2]][i] - sim->position[p[0]][i];
        length += u[i] * u[i];
    }
    for (int i = 0; i < 3; i++)
        along += u[i] * v[i] / length;
    for (int i = 0; i < 3; i++) {
        sim->position[p[1]][i] = sim->position[p[0]][i] + 2 * u[i];
        sim->position[p[2]][i] = sim->position[p[0]][i] + 2 * along * u[i] + 0.5 * (v[i] - along * u[i]);
    }
    struct membrane_state look;
    membrane_look(sim, sim->balloons, 0, &look);
    assert_near(look.stretch[0], 2, 1e-12);
    assert_near(look.stretch[1], 0.5, 1e-12);
    assert_near(look.energy, 1, 1e-12);
    assert_near(look.stress[0], 1.75, 1e-12);
    assert_near(look.stress[1], 0, 1e-12);
    for (int i = 0; i < 3; i++)
        assert_near(fabs(look.direction[i]), fabs(u[i]) / sqrt(length), 1e-12);
    double *each = malloc(sim->triangle_count * sizeof *each);
    membrane_energies(sim, sim->balloons, each);
    assert_near(each[0], look.energy, 1e-14);
    free(each);
    close_balloon(&b);
}

/* Shrunk alike both ways, where which of two equal stretches is the larger is a matter of rounding. */
static void slack_skin_pushes_by_no_law(void **state)
{
    (void)state;
    for (int i = 0; i < LAWS; i++) {
        struct balloon b;
        open_balloon(&b, 1, RUBBER(laws[i], "balloons[0].membrane.compression=0"));
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                b.sim.position[p][k] *= 0.8;
        sim_forces(&b.sim);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                assert_near(b.sim.force[p][k], 0, 0);
        /* Nor does it at rest, by more than the rounding of strains, times 6 triangles and edges of .6. */
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                b.sim.position[p][k] /= 0.8;
        sim_forces(&b.sim);
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                assert_near(b.sim.force[p][k], 0, 1e-14);
        assert_in_range(membrane_stiffness(&b.sim.balloons->membrane->law, (double[]){2.5, 0.8}), 1, 100);
        close_balloon(&b);
    }
}

/* At small strain every law is the same: 12 mu e^2/2 when stretched alike both ways,
 * to e itself in relation. */
static void all_laws_agree_at_small_strain(void **state)
{
    (void)state;
    for (int i = 0; i < LAWS; i++) {
        struct balloon b;
        open_balloon(&b, 1, RUBBER(laws[i]));
        const double e = 1e-4, factor[3] = {1 + e, 1 + e, 1 + e};
        for (uint32_t p = 0; p < b.sim.point_count; p++)
            for (int k = 0; k < 3; k++)
                b.sim.position[p][k] *= factor[k];
        struct membrane_state look;
        membrane_look(&b.sim, b.sim.balloons, 5, &look);
        assert_near(look.energy, 6 * e * e, 10 * 6 * e * e * e + 1e-15);
        close_balloon(&b);
    }
}

/* |W - V| of two responses and their derivatives, over what each is made of: E = L1^n + L2^n + L3^n,
 * by a and D as powers go. */
static double largest_difference(const struct membrane_response *w, const struct membrane_response *v,
                                 const double scale[2], double e, bool second)
{
    const double by_a = e / scale[0], by_d = e / scale[1];
    if (!second)
        return fmax(fabs(w->energy - v->energy) / e,
                    fmax(fabs(w->a - v->a) / by_a, fabs(w->d - v->d) / by_d));
    return fmax(fabs(w->aa - v->aa) * scale[0] / by_a,
                fmax(fabs(w->ad - v->ad) * scale[0] / by_d, fabs(w->dd - v->dd) * scale[1] / by_d));
}

/* The way of any power is the oracle of that of whole ones. It is the less exact of the two: its D^h loses |h
 * ln D| <= 13 roundings of 4e-16, and where x - 1 is just past 1e-3 its second derivatives are differences
 * over 2e-3, in which some 4 roundings of 1 become 4e-13. */
static void whole_powers_are_multiplied_out_to_what_they_are(void **state)
{
    (void)state;
    static const double larger[] = {0.6, 1, 1.5, 5}, ratio[] = {1, 1.0005, 1.05, 1.1, 2};
    double first = 0, second = 0;
    for (int n = -8; n <= 8; n++) {
        char law[64];
        struct balloon b;
        snprintf(law, sizeof law, "balloons[0].membrane.ogden=((%d,%d))", n < 0 ? -1 : 1, n == 0 ? 1 : n);
        open_balloon(&b, 1, RUBBER("balloons[0].membrane.law=ogden", law));
        const struct membrane *m = b.sim.balloons->membrane;
        struct membrane_law any = m->law;
        assert_int_equal(any.whole, 1);
        any.whole = 0;
        for (int i = 0; i < 20; i++) {
            const double l1 = larger[i / 5], l2 = l1 / ratio[i % 5], q1 = l1 * l1, q2 = l2 * l2,
                         power = any.power[0];
            const double e = fabs(any.weight[0]) * (pow(l1, power) + pow(l2, power) + pow(l1 * l2, -power)),
                         scale[2] = {(q1 + q2) / fabs(power), q1 * q2 / fabs(power)};
            const struct membrane_response w = m->kernels->respond(&m->law, q1 + q2, q1 * q2,
                                                                   (q1 - q2) * (q1 - q2)),
                                           v = m->kernels->respond(&any, q1 + q2, q1 * q2,
                                                                   (q1 - q2) * (q1 - q2));
            first = fmax(first, largest_difference(&w, &v, scale, e, false));
            second = fmax(second, largest_difference(&w, &v, scale, e, true));
        }
        close_balloon(&b);
    }
    print_message("# whole powers: %.2g, second derivatives %.2g\n", first, second);
    assert_true(first < 1e-14);
    assert_true(second < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wrinkled_triangle_holds_what_a_pulled_strip_does),
        cmocka_unit_test(slack_skin_pushes_by_no_law),
        cmocka_unit_test(all_laws_agree_at_small_strain),
        cmocka_unit_test(whole_powers_are_multiplied_out_to_what_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
