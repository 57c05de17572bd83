/* What effects cost: every one that a scene calls for is left out once, and what that changes is found. */
#include "balloon.h"
#include "sim/effect_cost.h"

#define CALM "balloons[0].point_mass=1", "balloons[0].pressure=4", "balloons[0].threshold=100", "time.end=0.4"

static struct effect_cost_table *measure(const char *const *settings)
{
    struct balloon b;
    struct error err = {0};
    struct effect_cost_table *table = calloc(1, sizeof *table);
    open_balloon(&b, 1, settings);
    assert_ok(effect_cost_measure(&b.scene, &b.mesh, &(struct pricing_options){.seconds = 0.2}, table, &err),
              &err);
    close_balloon(&b);
    return table;
}

static void say(const struct effect_cost_table *table, size_t row, char text[1280])
{
    effect_cost_say(table, &table->rows[row], text, 1280);
}

/* Free fall, which moves everything by g t^2/2 = 0.24 at the end and is no more than
 * rounding in any other way. */
static void what_gravity_does_is_found_to_the_letter(void **state)
{
    (void)state;
    struct effect_cost_table *table = measure(
        SETTINGS(CALM, "gravity.acceleration=[0,-3,0]", "time.integrator=verlet"));
    assert_int_equal(table->count, 1);
    assert_string_equal(table->rows[0].effect->name, "gravity");
    assert_near(table->span, 0.4, 1e-12);
    assert_near(table->rows[0].position, 0.24 / 45, 1e-9);
    assert_true(table->rows[0].volume < 1e-12);
    assert_true(table->rows[0].seconds > 0 && table->seconds > 0);
    free(table);
}

/* Of skin in free fall, which nothing bends, bending changes nothing but in how many parts steps are split:
 * what lay between the ends of a part and of a whole step was told to be its doing, 0.1 radii. */
static void runs_are_compared_at_the_same_moment(void **state)
{
    (void)state;
    struct effect_cost_table *table = measure(
        SETTINGS("balloons[0].pressure=0", "balloons[0].damping=0.1", "balloons[0].bending.stiffness=3e5",
                 "gravity.acceleration=[0,-1000,0]", "time.integrator=verlet", "time.guard=substep",
                 "time.step=0.02", "time.end=0.86"));
    assert_string_equal(table->rows[0].effect->name, "bending");
    assert_true(table->steps > 2 * table->rows[0].steps);
    assert_true(table->rows[0].position < 1e-12);
    free(table);
}

static void what_changes_no_bit_is_not_needed(void **state)
{
    (void)state;
    char text[1280];
    struct effect_cost_table *table = measure(SETTINGS(CALM, "ground.height=-1000", "drag.air_density=0"));
    assert_int_equal(table->count, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_true(table->rows[i].position == 0);
        say(table, i, text);
        assert_non_null(strstr(text, "changes nothing: you do not need it"));
    }
    assert_true(table->rows[0].bytes > 0);
    free(table);
}

/* Skin that meets the ground only when it has burst: "changes nothing until then: you may not need it" was
 * said of what all that comes after hangs on. */
static void what_is_needed_after_a_burst_is_told(void **state)
{
    (void)state;
    char text[1280];
    struct effect_cost_table *table = measure(
        SETTINGS("balloons[0].pressure=200", "balloons[0].threshold=1.2", "ground.height=-90", "time.end=1"));
    const struct effect_cost_row *row = &table->rows[0];
    assert_true(table->first_break < 2 && row->first_break == table->first_break);
    assert_true(row->position == 0 && row->position_after > 0.1);
    say(table, 0, text);
    assert_non_null(strstr(text, " changes the answer by 0, from then on positions by "));
    assert_null(strstr(text, "need it"));
    free(table);
}

static void a_run_that_diverges_without_it_says_so(void **state)
{
    (void)state;
    char text[1280];
    struct effect_cost_table *table = measure(
        SETTINGS("balloons[0].pressure=0", "balloons[0].spring=0", "time.guard=off", "time.end=200",
                 "time.step=0.5", "balloons[0].damping=0", "balloons[0].pressure_on=areas",
                 "balloons[0].pressure=1e6", "balloons[0].threshold=1e9", "balloons[0].pins.reach=180"));
    for (size_t i = 0; i < table->count; i++)
        if (!strcmp(table->rows[i].effect->name, "pins")) {
            say(table, i, text);
            assert_true(table->rows[i].failed);
            assert_non_null(strstr(text, "pins: you need it; without it: "));
        } else {
            assert_string_equal(table->rows[i].effect->name, "pressure_on");
            assert_non_null(strstr(table->rows[i].refused, "how the pressure acts"));
        }
    free(table);
}

static bool never(void *context, double done)
{
    (void)context;
    (void)done;
    return false;
}

static bool never_within(const struct sim *sim)
{
    (void)sim;
    return false;
}

static void whoever_asks_can_end_it(void **state)
{
    (void)state;
    static struct effect_cost_table table;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS(CALM, "drag.air_density=1"));
    const struct pricing_options options = {.seconds = 1, .go_on = never};
    assert_refused(effect_cost_measure(&b.scene, &b.mesh, &options, &table, &err), STATUS_INTERRUPTED,
                   "no table was made", &err);
    close_balloon(&b);
    open_balloon(&b, 1, SETTINGS(CALM, "drag.air_density=1", "time.integrator=auto"));
    const struct pricing_options within = {.seconds = 1, .goes_on = never_within}; /* auto's trials ask */
    assert_refused(effect_cost_measure(&b.scene, &b.mesh, &within, &table, &err), STATUS_INTERRUPTED,
                   "no table was made", &err);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_gravity_does_is_found_to_the_letter),
        cmocka_unit_test(runs_are_compared_at_the_same_moment),
        cmocka_unit_test(what_changes_no_bit_is_not_needed),
        cmocka_unit_test(what_is_needed_after_a_burst_is_told),
        cmocka_unit_test(a_run_that_diverges_without_it_says_so),
        cmocka_unit_test(whoever_asks_can_end_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
