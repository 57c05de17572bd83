/* Bursts of rubber balloons, at about 5000 triangles: two ways, as with latex. */
#include "burst/inflated.h"

static struct shreds burst(const struct inflation *how, bool pricked)
{
    struct inflated it;
    inflate(&it, how);
    if (pricked)
        prick(&it);
    run_until(
        &it,
        2.5); /* in radii over the speed of shear waves: all pieces are free, and at rest in themselves */
    const struct shreds shreds = count_shreds(&it);
    print_message("# stretch %g: %u pieces, the largest %.3f, the smallest of %u triangles, slender %.1f\n",
                  how->stretch, shreds.count, shreds.largest, shreds.fewest, shreds.slenderness);
    assert_int_equal(it.balloon->fracture->now.pieces + 1, shreds.count);
    assert_int_equal(it.balloon->topology->now.refused, 0);
    deflate(&it);
    return shreds;
}

static void pricked_at_low_stretch_one_crack_runs(void **unused)
{
    (void)unused;
    const double stretches[] = {1.3, 1.5};
    for (int i = 0; i < 2; i++) {
        const struct shreds s = burst(&(struct inflation){.level = 4, .stretch = stretches[i]}, true);
        assert_true(s.count <= 4 && s.largest > 1.0 / 3);
    }
}

static void pricked_at_high_stretch_it_goes_to_shreds(void **unused)
{
    (void)unused;
    const struct shreds s = burst(&(struct inflation){.level = 4, .stretch = 2.2}, true);
    assert_true(s.count >= 8 && s.fewest >= 4);
    assert_true(s.slenderness >= 3);
}

/* A crack that a prick starts goes both ways. At high stretch it divides again and again, and all of it comes
 * from that one point; below, the two tips are all there are. */
static void pricked_at_high_stretch_many_cracks_run_from_one_point(void **unused)
{
    (void)unused;
    const double stretches[] = {1.3, 1.5, 2.2};
    const unsigned at_least[] = {2, 2, 8}, at_most[] = {2, 2, UINT32_MAX};
    for (int i = 0; i < 3; i++) {
        struct inflated it;
        inflate(&it, &(struct inflation){.level = 4, .stretch = stretches[i]});
        prick(&it);
        run_until(&it, 0.8);
        const struct fracture *f = it.balloon->fracture;
        unsigned running = 0;
        for (uint32_t tip = 0; tip < f->now.tips; tip++)
            running += f->tips[tip].alive != 0;
        assert_int_equal(f->now.births, 1);
        assert_in_range(running, at_least[i], at_most[i]);
        deflate(&it);
    }
}

static void a_regular_sphere_bursts_by_itself_without_dust(void **unused)
{
    (void)unused;
    const struct shreds s = burst(&(struct inflation){.level = 4, .stretch = 2.36}, false);
    assert_true(s.count >= 2 && s.largest > 0.08 && s.fewest >= 4);
    assert_true(s.slenderness >= 3);
}

static void below_its_strength_nothing_tears(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 4, .stretch = 2.1});
    run_until(&it, 0.5);
    assert_int_equal(it.balloon->topology->now.edges, 0);
    deflate(&it);
}

static uint64_t hash_of_burst(unsigned workers, const char *seed)
{
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 4, .stretch = 2.36, .workers = workers, .keys = {seed}});
    run_until(&it, 1);
    assert_true(it.balloon->topology->now.edges > 100);
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void one_seed_is_one_burst_for_any_number_of_workers(void **unused)
{
    (void)unused;
    const char *seed = "balloons[0].fracture.seed=7";
    const uint64_t alone = hash_of_burst(1, seed);
    assert_true(hash_of_burst(2, seed) == alone);
    assert_true(hash_of_burst(3, seed) == alone);
    assert_true(hash_of_burst(1, "balloons[0].fracture.seed=8") != alone);
}

/* Of itself at the second stretch, or where a needle or a click has pricked it. */
static void that_the_skin_tears_is_told_once(void **unused)
{
    (void)unused;
    for (int pricked = 0; pricked < 2; pricked++) {
        struct inflated it;
        size_t told = 0;
        inflate(&it, &(struct inflation){.level = 3, .stretch = pricked ? 1.5 : 2.5});
        if (pricked)
            prick(&it);
        run_until(&it, 0.5);
        assert_true(it.sim.broken > 0);
        for (size_t i = 0; i < it.sim.news_count; i++)
            told += !strcmp(it.sim.news[i].text, "the skin tears");
        assert_int_equal(told, 1);
        deflate(&it);
    }
}

/* A second click beside the first one's hole cuts nothing, and says why; one that is far away does. */
static void a_click_that_cuts_nothing_says_why(void **unused)
{
    (void)unused;
    struct inflated it;
    const double place[] = {0, 0, 1.5}, beside[] = {0.1, 0, 1.5}, away[] = {0, 1.5, 0};
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5});
    assert_null(sim_prick(&it.sim, 0, place));
    const uint32_t cuts = it.balloon->topology->now.edges;
    assert_true(cuts > 0);
    assert_non_null(strstr(sim_prick(&it.sim, 0, beside), "0.15 radii"));
    assert_int_equal(it.balloon->topology->now.edges, cuts);
    assert_null(sim_prick(&it.sim, 0, away));
    assert_true(it.balloon->topology->now.edges > cuts);
    deflate(&it);
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .keys = {"balloons[0].fracture.reserve=1"}});
    for (uint32_t t = 0; topology_can_cut(&it.sim, it.balloon); t++)
        if (it.balloon->topology->neighbour[t][0] != MESH_NONE)
            topology_cut(&it.sim, it.balloon, t, 0);
    assert_non_null(strstr(sim_prick(&it.sim, 0, place), "fracture.reserve"));
    deflate(&it);
}

/* A state in the middle of a burst, put back after the burst has gone on. */
static void a_burst_goes_on_from_its_blocks(void **unused)
{
    (void)unused;
    struct inflated it;
    void *kept[64];
    size_t count;
    inflate(&it, &(struct inflation){.level = 4, .stretch = 2.2, .workers = 2});
    prick(&it);
    run_until(&it, 0.5);
    const struct sim_block *blocks = sim_blocks(&it.sim, &count);
    assert_true(count <= sizeof kept / sizeof kept[0]);
    for (size_t i = 0; i < count; i++) {
        kept[i] = malloc(blocks[i].size + 1);
        memcpy(kept[i], blocks[i].data, blocks[i].size);
    }
    run_until(&it, 1);
    const uint64_t hash = sim_hash(&it.sim);
    for (size_t i = 0; i < count; i++) {
        memcpy(blocks[i].data, kept[i], blocks[i].size);
        free(kept[i]);
    }
    assert_true(sim_restored(&it.sim));
    run_until(&it, 1);
    assert_true(sim_hash(&it.sim) == hash);
    deflate(&it);
}

/* No force from outside but the gas's: without gas and pressure, momentum stays what it was through a burst.
 * Rounding: some 1000 steps over 2600 points of 4 pi together, each to 2^-53 of about 1. */
static void momentum_and_mass_are_kept_through_a_burst(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){
                     .level = 4, .stretch = 2.2, .springs = true, .keys = {"balloons[0].pressure=0"}});
    assert_a_burst_keeps_bulk(&it, 1, 1e-10);
    assert_true(it.balloon->topology->now.edges > 20);
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pricked_at_low_stretch_one_crack_runs),
        cmocka_unit_test(pricked_at_high_stretch_it_goes_to_shreds),
        cmocka_unit_test(pricked_at_high_stretch_many_cracks_run_from_one_point),
        cmocka_unit_test(a_regular_sphere_bursts_by_itself_without_dust),
        cmocka_unit_test(below_its_strength_nothing_tears),
        cmocka_unit_test(one_seed_is_one_burst_for_any_number_of_workers),
        cmocka_unit_test(that_the_skin_tears_is_told_once),
        cmocka_unit_test(a_click_that_cuts_nothing_says_why),
        cmocka_unit_test(a_burst_goes_on_from_its_blocks),
        cmocka_unit_test(momentum_and_mass_are_kept_through_a_burst),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
