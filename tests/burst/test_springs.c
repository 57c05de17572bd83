/* Skins of springs that tear: waves, and cracks with them, go by the springs that there are. */
#include "burst/inflated.h"

/* Pricked, with these springs. */
static uint64_t hash_of_burst(const char *spring, const char *other)
{
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 2.2, .springs = true, .keys = {spring, other}});
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
    assert_true(hash_of_burst("balloons[0].spring=0.5", by_height) ==
                hash_of_burst("balloons[0].spring=2", NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_by_height_tear_as_those_said_outright),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
