/* Cuts by themselves: a skin stays a manifold with boundary, and nothing is lost. */
#include "burst/cuts.h"
#include "sim/gas.h"
#include "sim/guard_bound.h"

struct sums {
    double mass, momentum[3], area;
};

static struct sums sums_of(const struct inflated *it)
{
    const struct sim_balloon *b = it->balloon;
    struct sums s = {0};
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        s.mass += it->sim.mass[p];
        for (int i = 0; i < 3; i++)
            s.momentum[i] += it->sim.mass[p] * it->sim.velocity[p][i];
    }
    for (uint32_t t = 0; t < b->triangle_end; t++)
        s.area += b->topology->rest_area[t];
    return s;
}

static void cuts_keep_mass_area_and_momentum(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    give_speeds(&it);
    const struct sums before = sums_of(&it);
    cut_anywhere(&it, 11, 500);
    const struct sums after = sums_of(&it);
    /* each point's mass is split in two with a rounding of 2^-53 of it, and a sum over
     * n points rounds n times */
    const double rounding = 2000 * 0x1p-53 * before.mass;
    assert_near(after.mass, before.mass, rounding);
    for (int i = 0; i < 3; i++)
        assert_near(after.momentum[i], before.momentum[i], rounding);
    assert_true(after.area == before.area);
    deflate(&it);
}

/* Around each point its triangles are one fan, and every triangle is in the fans of its corners. */
static void every_point_keeps_one_fan(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    cut_anywhere(&it, 11, 600);
    const struct sim_balloon *b = it.balloon;
    uint32_t corners = 0;
    for (uint32_t p = 0; p < b->point_end; p++) {
        struct fan fan;
        topology_first(&it.sim, b, p, &fan);
        const uint32_t first = fan.triangle;
        do {
            assert_int_equal(it.sim.triangle_point[fan.triangle][fan.corner], p);
            corners++;
        } while (topology_next(&it.sim, b, &fan) && fan.triangle != first);
    }
    assert_int_equal(corners, 3 * b->triangle_end);
    assert_true(topology_is_sound(&it.sim, b));
    deflate(&it);
}

/* Each triangle's edges join its corners, at the length that they had at rest. */
static void edges_follow_their_triangles(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    cut_anywhere(&it, 11, 600);
    for (uint32_t t = 0; t < it.balloon->triangle_end; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *p = it.sim.triangle_point[t], *e = it.sim.edge_point[it.sim.triangle_edge[t][k]];
            const uint32_t a = p[k], b = p[(k + 1) % 3];
            assert_true((e[0] == a && e[1] == b) || (e[0] == b && e[1] == a));
        }
    deflate(&it);
}

static uint64_t hash_after_cuts(bool springs, unsigned workers)
{
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 4, .stretch = 1.5, .springs = springs, .workers = workers});
    cut_anywhere(&it, 11, 400);
    run_until(&it, 0.1);
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void any_number_of_workers_gives_the_same_bits(void **unused)
{
    (void)unused;
    for (int springs = 0; springs < 2; springs++) {
        const uint64_t alone = hash_after_cuts(springs, 1);
        assert_true(hash_after_cuts(springs, 2) == alone);
        assert_true(hash_after_cuts(springs, 5) == alone);
    }
}

/* Of a piece that fell off the gas presses on no point, nor on any that further cuts make of it. */
static void the_gas_lets_go_of_copies_too(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5});
    gas_let_go(&it.sim, it.balloon, it.sim.triangle_point[0], 3 * it.balloon->triangle_end);
    cut_anywhere(&it, 11, 400);
    assert_true(it.balloon->topology->now.points > 50);
    for (uint32_t p = 0; p < it.balloon->point_end; p++)
        assert_false(it.balloon->gas->held[p]);
    deflate(&it);
}

/* What a cut leaves of it is no more than a look at all points finds, but for rounding. */
static void the_guards_bound_holds_through_cuts(void **unused)
{
    (void)unused;
    for (int springs = 0; springs < 2; springs++) {
        struct inflated it;
        int lowered = 0;
        inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = springs});
        it.sim.step = 0; /* none that a cut could ask to be shorter */
        for (uint64_t seed = 1; seed < 200; seed++) {
            const double before = guard_stable_step(&it.sim);
            cut_anywhere(&it, seed, 2);
            const bool known = it.sim.guard->memory.is_known == GUARD_KNOWN;
            const double by_cuts = it.sim.guard->memory.stable;
            guard_outdated(&it.sim);
            const double anew = guard_stable_step(&it.sim);
            assert_true(!known || by_cuts <= (1 + 1e-12) * anew);
            lowered += known && by_cuts < before;
        }
        assert_true(lowered >= 20);
        deflate(&it);
    }
}

/* Another look by the same x finds the same, to the bit. */
static void the_guards_bound_is_that_of_its_x(void **unused)
{
    (void)unused;
    for (int cuts = 0; cuts < 40; cuts++) {
        struct inflated it;
        inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = cuts % 2});
        cut_anywhere(&it, 7, 5 * cuts);
        const double bound = guard_stable_step(&it.sim);
        it.sim.guard->memory.is_known = GUARD_KNOWN_BUT_FOR_CUTS;
        assert_true(guard_stable_step(&it.sim) == bound);
        deflate(&it);
    }
}

static void a_full_reserve_is_told_and_cuts_nothing_more(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 2.4, .keys = {"balloons[0].fracture.reserve=1"}});
    run_until(&it, 1.5);
    const struct topology_counts *now = &it.balloon->topology->now;
    assert_true(now->refused > 0);
    assert_true(it.balloon->point_end <= it.balloon->point_room &&
                it.balloon->edge_end <= it.balloon->edge_room);
    deflate(&it);
}

/* What is late is so once: lists that have room for all have it for any cut. */
static void a_skin_of_few_triangles_can_be_cut(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.stretch = 1.5, .springs = true});
    cut_anywhere(&it, 11, 25);
    const struct topology_counts *now = &it.balloon->topology->now;
    assert_int_equal(now->refused, 0);
    assert_true(now->late_edges <= 30 && now->late_triangles <= 20);
    deflate(&it);
}

static void a_state_that_is_no_skin_is_refused(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    cut_anywhere(&it, 11, 50);
    assert_true(sim_restored(&it.sim));
    uint32_t *number = &it.balloon->topology->neighbour[100][1];
    const uint32_t was = *number;
    *number = it.balloon->triangle_end + 7;
    assert_false(sim_restored(&it.sim));
    *number = was == 3 ? 4 : 3;
    assert_false(sim_restored(&it.sim));
    *number = was;
    it.balloon->topology->now.points = UINT32_MAX;
    assert_false(sim_restored(&it.sim));
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_keep_mass_area_and_momentum),
        cmocka_unit_test(every_point_keeps_one_fan),
        cmocka_unit_test(edges_follow_their_triangles),
        cmocka_unit_test(any_number_of_workers_gives_the_same_bits),
        cmocka_unit_test(the_gas_lets_go_of_copies_too),
        cmocka_unit_test(the_guards_bound_holds_through_cuts),
        cmocka_unit_test(the_guards_bound_is_that_of_its_x),
        cmocka_unit_test(a_full_reserve_is_told_and_cuts_nothing_more),
        cmocka_unit_test(a_skin_of_few_triangles_can_be_cut),
        cmocka_unit_test(a_state_that_is_no_skin_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
