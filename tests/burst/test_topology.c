/* Cuts by themselves: a skin stays a manifold with boundary, and nothing is lost. */
#include "burst/inflated.h"
#include "common/random.h"
#include "sim/guard.h"

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

static void give_speeds(struct inflated *it)
{
    uint64_t state = 5;
    for (uint32_t p = 0; p < it->balloon->point_end; p++)
        for (int i = 0; i < 3; i++)
            it->sim.velocity[p][i] = random_unit(&state) - 0.5;
}

/* Cuts `count` sides of triangles that come as they may. */
static void cut_anywhere(struct inflated *it, int count)
{
    uint64_t state = 11;
    for (int done = 0; done < count;) {
        const uint32_t t = (uint32_t)(random_unit(&state) * it->balloon->triangle_end);
        const int side = (int)(random_unit(&state) * 3);
        if (it->balloon->topology->neighbour[t][side] == MESH_NONE)
            continue;
        assert_true(topology_can_cut(&it->sim, it->balloon));
        topology_cut(&it->sim, it->balloon, t, side);
        done++;
    }
}

static void cuts_keep_mass_area_and_momentum(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    give_speeds(&it);
    const struct sums before = sums_of(&it);
    cut_anywhere(&it, 500);
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
    cut_anywhere(&it, 600);
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
    cut_anywhere(&it, 600);
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
    cut_anywhere(&it, 400);
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

static void a_state_that_is_no_skin_is_refused(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .springs = true});
    cut_anywhere(&it, 50);
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
        cmocka_unit_test(a_full_reserve_is_told_and_cuts_nothing_more),
        cmocka_unit_test(a_state_that_is_no_skin_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
