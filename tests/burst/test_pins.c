/* Skin that is held and tears. */
#include "burst/ordered.h"

static const struct inflation held = {
    .level = 3,
    .stretch = 2.2,
    .keys = {"balloons[0].pins.place=[2, 1.7, 2.3]", "balloons[0].pins.reach=60"}};

/* How many points were made of those that pins hold. Each is where the point was that it was made from. */
static uint32_t assert_all_are_held(const struct inflated *it)
{
    const struct sim_balloon *b = it->balloon;
    const double place[3] = {2, 1.7, 2.3};
    uint32_t copies = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        const double *rest = b->topology->rest[p - b->point_begin];
        if (vec3_dot(rest, place) < cos(59 * M_PI / 180) * vec3_length(rest) * vec3_length(place))
            continue;
        assert_near(vec3_distance(it->sim.position[p], rest), 0, 1e-12);
        copies += reorder_name(b, p) >= b->topology->old_points;
    }
    return copies;
}

static void what_pins_hold_stays_on_both_sides_of_a_crack(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &held);
    run_until(&it, 0.1);
    prick(&it);
    run_until(&it, 1);
    assert_true(assert_all_are_held(&it) > 2);
    put_in_order(&it);
    steps(&it, 3);
    assert_true(assert_all_are_held(&it) > 2);
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_pins_hold_stays_on_both_sides_of_a_crack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
