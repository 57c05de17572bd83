/* Steps that are too large, springs, dampers and masses that are far from each other: the guard splits the
 * step, and what must not grow does not. Textbook Euler without a guard fails each of them, and says so. */
#include "hard.h"

static const double multiples[] = {0.5, 0.99, 1.01, 10, 1000};
enum { MULTIPLES = sizeof multiples / sizeof multiples[0] };

/* What symplectic Euler keeps exactly in an undamped linear system is E minus (dt w)^2/4 of a share of E:
 * within the bound E itself stays between E/2 and 2 E of its mean, and what is not linear in small
 * shakings adds a few per cent. */
static void undamped_energy_stays_within_bounds_at_any_step(void **state)
{
    (void)state;
    for (int i = 0; i < MULTIPLES; i++) {
        struct balloon b;
        open_balloon(&b, 1, HARD("balloons[0].pressure=0", "balloons[0].damping=0"));
        b.sim.whole_step = b.sim.step = multiples[i] * guard_stable_step(&b.sim);
        disturb(&b, 0.1);
        const double begin = energy_of(&b);
        for (int whole = 0; whole < 20; whole++) {
            steps(&b, (int)ceil(multiples[i]));
            assert_in_range(energy_of(&b) / begin * 1000, 200, 4000);
        }
        assert_int_equal(b.sim.substeps, ceil(multiples[i]));
        close_balloon(&b);
    }
}

static void damped_energy_falls_at_any_step(void **state)
{
    (void)state;
    for (int i = 0; i < MULTIPLES; i++) {
        struct balloon b;
        open_balloon(&b, 1, HARD("balloons[0].pressure=0"));
        b.sim.whole_step = b.sim.step = multiples[i] * guard_stable_step(&b.sim);
        disturb(&b, 0.1);
        double before = energy_of(&b);
        for (int tenth = 0; tenth < 10; tenth++) {
            steps(&b, 100);
            assert_true(energy_of(&b) < before);
            before = energy_of(&b);
        }
        close_balloon(&b);
    }
}

/* At half the other's bound it multiplies the fastest oscillation by 1.4 in each step, and
 * from there on by more. */
static void textbook_euler_diverges_at_any_of_these_steps(void **state)
{
    (void)state;
    for (int i = 0; i < MULTIPLES; i++) {
        struct balloon b;
        open_balloon(&b, 1, EULER("balloons[0].pressure=0", "balloons[0].damping=0"));
        b.sim.whole_step = b.sim.step = multiples[i] * 0.026; /* symplectic Euler's bound here */
        disturb(&b, 0.1);
        assert_diverges(&b, 1000);
        close_balloon(&b);
    }
}

/* Guarded, its oscillations grow e-fold at most until the end: e^2 in energy, and a few per cent
 * of what is not linear. */
static void textbook_euler_guarded_grows_no_more_than_it_says(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 HARD("time.integrator=explicit-euler", "time.end=1", "balloons[0].pressure=0",
                      "balloons[0].damping=0"));
    disturb(&b, 0.1);
    const double begin = energy_of(&b);
    while (b.sim.time < 1)
        steps(&b, 1);
    assert_true(b.sim.substeps > 10);
    assert_true(energy_of(&b) < 7.4 * 1.05 * begin);
    close_balloon(&b);
}

/* Every fifth spring is `contrast` times as stiff as the others. */
static void stiffen(struct balloon *b, double contrast)
{
    for (uint32_t e = 0; e < b->sim.edge_count; e += 5)
        b->sim.init_spring_const[e] = b->sim.current_spring_const[e] *= contrast;
    guard_outdated(&b->sim);
}

static void springs_a_thousand_and_a_million_times_as_stiff_stay_bounded(void **state)
{
    (void)state;
    for (double contrast = 1e3; contrast <= 1e6; contrast *= 1e3) {
        struct balloon b;
        open_balloon(&b, 1, HARD("balloons[0].pressure=0", "balloons[0].damping=0"));
        stiffen(&b, contrast);
        disturb(&b, 0.01);
        const double begin = energy_of(&b);
        for (int i = 0; i < 10; i++) {
            steps(&b, 2000);
            assert_true(energy_of(&b) < 4 * begin);
        }
        close_balloon(&b);

        open_balloon(&b, 1, EULER("balloons[0].pressure=0", "balloons[0].damping=0"));
        stiffen(&b, contrast);
        disturb(&b, 0.01);
        assert_diverges(&b, 1000);
        close_balloon(&b);
    }
}

static void make_heavy(struct balloon *b)
{
    for (uint32_t p = 0; p < b->sim.point_count; p += 10)
        b->sim.mass[p] *= 1e6;
    guard_outdated(&b->sim);
}

/* Springs and dampers give to one what they take from the other: rounding of 2000 steps of forces up
 * to 1e2 is all there is. */
static void masses_a_million_times_as_large_keep_momentum_to_1e_12(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, HARD("balloons[0].pressure=0", "time.step=0.1"));
    make_heavy(&b);
    disturb(&b, 1);
    const double begin = energy_of(&b);
    double largest = 0, momentum[3];
    for (int i = 0; i < 2000; i++) {
        steps(&b, 1);
        largest = fmax(largest, impulse_of(&b.sim));
    }
    momentum_of(&b.sim, momentum);
    assert_near(vec3_length(momentum) / largest, 0, 1e-12);
    assert_true(energy_of(&b) < begin);
    close_balloon(&b);

    open_balloon(&b, 1, EULER("balloons[0].pressure=0", "balloons[0].damping=0", "time.step=0.1"));
    make_heavy(&b);
    disturb(&b, 1);
    assert_diverges(&b, 1000);
    close_balloon(&b);
}

static void dampers_a_hundred_times_past_critical_only_calm(void **state)
{
    (void)state;
    const double critical = 2 * sqrt(20 * 0.11);
    char damping[64];
    snprintf(damping, sizeof damping, "balloons[0].damping=%g", 100 * critical);
    struct balloon b;
    open_balloon(&b, 1, HARD("balloons[0].pressure=0", damping));
    disturb(&b, 1);
    double before = energy_of(&b);
    for (int i = 0; i < 10; i++) {
        steps(&b, 1000);
        assert_true(energy_of(&b) < before);
        before = energy_of(&b);
    }
    close_balloon(&b);

    open_balloon(&b, 1, EULER("balloons[0].pressure=0", damping));
    disturb(&b, 1);
    assert_diverges(&b, 1000);
    close_balloon(&b);
}

/* One at a time, and all together. */
static const char *const wild[5][5] = {
    {"balloons[0].spring=200", NULL},
    {"balloons[0].damping=10", NULL},
    {"time.step=0.25", NULL},
    {"balloons[0].pressure=1000", NULL},
    {"balloons[0].spring=200", "balloons[0].damping=10", "time.step=0.25", "balloons[0].pressure=1000", NULL},
};

static void open_wild(struct balloon *b, int row, const char *const *with)
{
    const char *changes[16];
    int count = 0;
    for (; *with; with++)
        changes[count++] = *with;
    for (int i = 0; wild[row][i]; i++)
        changes[count++] = wild[row][i];
    changes[count] = NULL;
    open_balloon(b, 2, changes);
}

/* Within its bound symplectic Euler keeps E to a factor of 2. */
static void ten_times_the_paper_s_numbers_make_no_energy(void **state)
{
    (void)state;
    for (int row = 0; row < 5; row++)
        for (int breaking = 0; breaking < 2; breaking++) {
            struct balloon b;
            open_wild(&b, row, breaking ? SETTINGS("time.guard=substep") : HARD());
            while (b.sim.time < 5) {
                steps(&b, 1);
                assert_true(energy_of(&b) < 2 * reachable(&b, b.sim.settings[0].pressure));
            }
            assert_finite(&b.sim);
            close_balloon(&b);
        }
}

static void textbook_euler_diverges_at_ten_times_the_paper_s_numbers(void **state)
{
    (void)state;
    for (int row = 0; row < 5; row++) {
        struct balloon b;
        open_wild(&b, row, EULER());
        assert_diverges(&b, 1000);
        close_balloon(&b);
    }
}

static void refused_steps_name_the_largest_that_is_stable(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS("time.guard=refuse", "time.step=0.25"));
    assert_refused(sim_step(&b.sim, &err), STATUS_DIVERGED,
                   "refused at time 0: time.step 0.25 is too large: steps up to", &err);
    const double stable = guard_stable_step(&b.sim);
    close_balloon(&b);

    char step[64];
    snprintf(step, sizeof step, "time.step=%.17g", stable);
    open_balloon(&b, 1, SETTINGS("time.guard=refuse", step));
    steps(&b, 10);
    close_balloon(&b);
}

/* One step of .1 in n parts is n steps of .1/n, to the bit. */
static void a_step_in_parts_is_as_many_smaller_steps(void **state)
{
    (void)state;
    struct balloon split, small;
    open_balloon(&split, 2, SETTINGS("time.guard=substep", "time.step=0.125"));
    steps(&split, 1);
    const int parts = (int)split.sim.substeps;
    assert_true(parts > 1);
    steps(&split, 10 * parts - 1);
    open_balloon(&small, 2, SETTINGS("time.guard=off"));
    small.sim.whole_step = small.sim.step = 0.125 / parts;
    steps(&small, 10 * parts);
    assert_memory_equal(split.sim.position, small.sim.position,
                        small.sim.point_count * sizeof *small.sim.position);
    assert_near(split.sim.time, 1.25, 0);
    close_balloon(&split);
    close_balloon(&small);
}

/* The schedule stiffens the springs a hundredfold at .5 s, and later takes that back. */
static void the_split_follows_the_schedule(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1,
                 HARD("balloons[0].damping=0", "schedule[0].at=0.5", "schedule[0].spring_factor=100",
                      "schedule[1].at=1", "schedule[1].spring_factor=1"));
    steps(&b, 20);
    assert_int_equal(b.sim.substeps, 1);
    while (b.sim.time < 0.75)
        steps(&b, 1);
    assert_in_range(b.sim.substeps, 5, 20); /* ten times the frequency */
    while (b.sim.time < 1.25)
        steps(&b, 1);
    assert_int_equal(b.sim.substeps, 1);
    assert_near(b.sim.time, 1.25, 0.025);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_energy_stays_within_bounds_at_any_step),
        cmocka_unit_test(damped_energy_falls_at_any_step),
        cmocka_unit_test(textbook_euler_diverges_at_any_of_these_steps),
        cmocka_unit_test(textbook_euler_guarded_grows_no_more_than_it_says),
        cmocka_unit_test(springs_a_thousand_and_a_million_times_as_stiff_stay_bounded),
        cmocka_unit_test(masses_a_million_times_as_large_keep_momentum_to_1e_12),
        cmocka_unit_test(dampers_a_hundred_times_past_critical_only_calm),
        cmocka_unit_test(ten_times_the_paper_s_numbers_make_no_energy),
        cmocka_unit_test(textbook_euler_diverges_at_ten_times_the_paper_s_numbers),
        cmocka_unit_test(refused_steps_name_the_largest_that_is_stable),
        cmocka_unit_test(a_step_in_parts_is_as_many_smaller_steps),
        cmocka_unit_test(the_split_follows_the_schedule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
