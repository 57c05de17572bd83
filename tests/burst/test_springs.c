/* Skins of springs that tear: waves, and cracks with them, go by the springs that there are. */
#include "burst/inflated.h"
#include "common/scene_fields.h"

static void turn_springs(struct inflated *it, double factor)
{
    struct scene_schedule change = {.balloon = -1, .change_count = 1};
    change.change[0].field = scene_find_field(scene_find_block("", "balloons"), "spring_factor");
    change.change[0].value = factor;
    sim_change(&it->sim, &change);
}

/* Pricked, with these springs; turned to `factor` before the first step. */
static uint64_t hash_of_burst(const char *spring, const char *other, double factor)
{
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 2.2, .springs = true, .keys = {spring, other}});
    turn_springs(&it, factor);
    prick(&it);
    run_until(&it, 1);
    assert_true(it.balloon->topology->now.edges > 10);
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void springs_by_height_tear_as_those_said_outright(void **unused)
{
    (void)unused;
    const char *by_height = "balloons[0].spring_by_height.profile=((0, 4), (1, 4))";
    assert_true(hash_of_burst("balloons[0].spring=0.5", by_height, 1) ==
                hash_of_burst("balloons[0].spring=2", NULL, 1));
}

/* Whatever they were at first: where that is nothing, waves stood still. */
static void springs_that_are_turned_tear_as_those_said_outright(void **unused)
{
    (void)unused;
    const char *spring = "balloons[0].spring=2";
    const uint64_t said = hash_of_burst(spring, "balloons[0].spring_factor=1", 1);
    assert_true(hash_of_burst(spring, "balloons[0].spring_factor=0.25", 1) == said);
    assert_true(hash_of_burst(spring, "balloons[0].spring_factor=0", 1) == said);
}

static void skin_tears_once_springs_are_turned_on(const char *before)
{
    struct inflated it;
    inflate(&it, &(struct inflation){
                     .level = 3, .stretch = 3, .springs = true, .keys = {before, "balloons[0].pressure=0"}});
    run_until(&it, 0.2);
    prick(&it);
    run_until(&it, 0.4);
    const uint32_t pricked = it.balloon->topology->now.edges;
    assert_true(pricked > 0);
    run_until(&it, 0.6);
    assert_int_equal(it.balloon->topology->now.edges, pricked);
    turn_springs(&it, 1);
    run_until(&it, 0.8);
    assert_true(it.balloon->topology->now.edges > pricked + 10);
    deflate(&it);
}

/* Skin that nothing holds is not torn by being stretched; what hardly holds waits long to be looked at. */
static void springs_of_nothing_tear_once_they_are_turned_on(void **unused)
{
    (void)unused;
    skin_tears_once_springs_are_turned_on("balloons[0].spring_factor=0");
    skin_tears_once_springs_are_turned_on("balloons[0].spring_factor=1e-8");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_by_height_tear_as_those_said_outright),
        cmocka_unit_test(springs_that_are_turned_tear_as_those_said_outright),
        cmocka_unit_test(springs_of_nothing_tear_once_they_are_turned_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
