/* New points that come to their places are state: whoever works on them, and wherever a run is taken up. */
#include "burst/ordered.h"

static uint64_t hash_of_torn(const struct inflation *how, unsigned workers)
{
    struct inflated it;
    struct inflation one = *how;
    one.workers = workers;
    inflate(&it, &one);
    for (uint64_t round = 0; round < 3; round++) {
        tear(&it, 11 + round, 100);
        steps(&it, 3);
        put_in_order(&it);
        steps(&it, 3);
    }
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void any_number_of_workers_gives_the_same_bits(void **unused)
{
    (void)unused;
    static const struct inflation *const scenes[] = {&all_of_rubber, &all_of_springs, &touching};
    for (int s = 0; s < 3; s++) {
        const uint64_t alone = hash_of_torn(scenes[s], 1);
        assert_true(hash_of_torn(scenes[s], 2) == alone);
        assert_true(hash_of_torn(scenes[s], 5) == alone);
    }
}

static void put_back(struct inflated *it, const struct kept *kept)
{
    size_t count;
    const struct sim_block *blocks = sim_blocks(&it->sim, &count);
    assert_int_equal(count, kept->count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(blocks[i].size, kept->block[i].size);
        if (blocks[i].size)
            memcpy(blocks[i].data, kept->block[i].data, blocks[i].size);
    }
    assert_true(sim_restored(&it->sim));
}

/* Before, between and behind: whole, torn, in order, torn again, in order again. */
enum { MOMENTS = 5, AHEAD = 4 };

static void run_through(struct inflated *it, struct kept kept[MOMENTS])
{
    for (int moment = 0; moment < MOMENTS; moment++) {
        if (moment % 2 == 1)
            tear(it, (uint64_t)moment, 80);
        else if (moment > 0)
            put_in_order(it);
        keep(it, &kept[moment]);
        steps(it, AHEAD);
        kept[moment].hash = sim_hash(&it->sim);
    }
}

static void states_are_put_back_across_it_in_any_order(void **unused)
{
    (void)unused;
    static const struct inflation *const scenes[] = {&all_of_rubber, &all_of_springs, &touching};
    static const int way[] = {4, 0, 3, 1, 2, 2, 4, 3};
    for (int s = 0; s < 3; s++) {
        struct inflated it;
        struct kept kept[MOMENTS];
        inflate(&it, scenes[s]);
        run_through(&it, kept);
        deflate(&it);
        inflate(&it, scenes[s]); /* one that was never torn */
        for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
            put_back(&it, &kept[way[i]]);
            steps(&it, AHEAD);
            assert_true(sim_hash(&it.sim) == kept[way[i]].hash);
        }
        for (int moment = 0; moment < MOMENTS; moment++)
            forget(&kept[moment]);
        deflate(&it);
    }
}

/* By a sim that has not seen how it began. */
static void a_burst_is_taken_up_in_its_middle(void **unused)
{
    (void)unused;
    const struct inflation how = {.level = 4, .stretch = 2.2};
    struct inflated it, other;
    struct kept kept[3];
    inflate(&it, &how);
    prick(&it);
    for (int i = 0; i < 3; i++) {
        run_until(&it, 0.2 * (i + 1));
        keep(&it, &kept[i]);
    }
    run_until(&it, 0.8);
    const uint64_t hash = sim_hash(&it.sim);
    assert_true(it.balloon->topology->now.points > 100);
    for (int i = 0; i < 3; i++) {
        inflate(&other, &how);
        put_back(&other, &kept[i]);
        run_until(&other, 0.8);
        assert_true(sim_hash(&other.sim) == hash);
        forget(&kept[i]);
        deflate(&other);
    }
    deflate(&it);
}

static bool no(const struct sim *sim)
{
    (void)sim;
    return false;
}

/* A step that was ended half-way has cost nothing as yet: it was counted twice. */
static void who_ends_a_step_and_goes_on_comes_to_the_same_bits(void **unused)
{
    (void)unused;
    static const struct inflation chosen = {
        .level = 2, .stretch = 1.5, .keys = {"time.integrator=auto", "time.tolerance=1e-3"}};
    struct error err = {0};
    struct inflated it, whole;
    inflate(&it, &chosen);
    inflate(&whole, &chosen);
    tear(&it, 11, 20);
    tear(&whole, 11, 20);
    it.sim.goes_on = no;
    assert_refused(sim_step(&it.sim, &err), STATUS_INTERRUPTED, "interrupted", &err);
    it.sim.goes_on = NULL;
    steps(&it, 1);
    steps(&whole, 1);
    assert_true(whole.balloon->topology->now.slowed > 0);
    assert_true(sim_hash(&it.sim) == sim_hash(&whole.sim));
    deflate(&it);
    deflate(&whole);
}

static void names_that_are_none_are_refused(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    cut_anywhere(&it, 11, 50);
    put_in_order(&it);
    cut_anywhere(&it, 12, 5);
    struct topology *top = it.balloon->topology;
    assert_true(sim_restored(&it.sim));
    uint32_t *const places[] = {&top->name[0],
                                &top->name[100],
                                &top->name[it.balloon->point_end],
                                &top->family[7],
                                &top->family[top->old_points],
                                &top->now.settled};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const uint32_t was = *places[i], wrong[] = {was + 1, UINT32_MAX, 1u << 30};
        for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
            *places[i] = wrong[k];
            if (sim_restored(&it.sim))
                fail_msg("place %zu: %u is taken for %u", i, wrong[k], was);
        }
        *places[i] = was;
    }
    assert_true(sim_restored(&it.sim));
    top->now.awake = REORDER_AWAKE + 1;
    assert_false(sim_restored(&it.sim));
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_workers_gives_the_same_bits),
        cmocka_unit_test(states_are_put_back_across_it_in_any_order),
        cmocka_unit_test(a_burst_is_taken_up_in_its_middle),
        cmocka_unit_test(who_ends_a_step_and_goes_on_comes_to_the_same_bits),
        cmocka_unit_test(names_that_are_none_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
