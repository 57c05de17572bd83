/* Skins that keep apart: against a look at all pairs, at the end of every step of scenes that
 * fold, squeeze and collide. */
#include "common/vec3.h"
#include "crossings.h"
#include "sim/contact.h"
#include "sim/sweep.h"
#include "two_skins.h"

static void check_steps(struct sim *sim, int steps)
{
    struct error err = {0};
    for (int i = 0; i < steps; i++) {
        assert_ok(sim_step(sim, &err), &err);
        assert_int_equal(crossings_count(sim), 0);
    }
}

static void test_a_folding_balloon_never_crosses_itself(void **state)
{
    (void)state;
    struct scene_of_two s;
    open_scene(&s, 2, 1, FOLDING);
    swirl(&s.sim, 3);
    check_steps(&s.sim, 200);
    assert_true(s.sim.contact->memory.wakes > 0);
    close_scene(&s);
}

/* Or else the tests that find no crossing would prove nothing. */
static void test_without_contact_it_crosses_itself(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    open_scene(&s, 2, 1, FOLDING + 1);
    swirl(&s.sim, 3);
    for (int i = 0; i < 200; i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    assert_true(crossings_count(&s.sim) > 0);
    assert_null(s.sim.contact);
    close_scene(&s);
}

static void test_a_squeezed_balloon_never_crosses_itself_nor_enters_the_boxes(void **state)
{
    (void)state;
    struct scene_of_two s;
    open_scene(&s, 2, 1, SQUEEZED);
    check_steps(&s.sim, 150);
    close_scene(&s);
}

/* No force acts from outside: what the two have together stays, to the rounding of some 1e5 impulses. */
static void test_two_balloons_thrown_together_keep_apart_and_keep_their_momentum(void **state)
{
    (void)state;
    struct scene_of_two s;
    double before[3] = {0}, after[3] = {0}, most = 0;
    open_scene(&s, 2, 1, COLLIDING);
    throw(&s.sim, 60);
    for (uint32_t p = 0; p < s.sim.point_count; p++)
        for (int i = 0; i < 3; i++) {
            before[i] += s.sim.mass[p] * s.sim.velocity[p][i];
            most += s.sim.mass[p] * fabs(s.sim.velocity[p][i]);
        }
    check_steps(&s.sim, 120);
    for (uint32_t p = 0; p < s.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            after[i] += s.sim.mass[p] * s.sim.velocity[p][i];
    for (int i = 0; i < 3; i++)
        assert_near(after[i], before[i], 1e-11 * most);
    assert_true(s.sim.contact->memory.wakes > 0);
    assert_int_equal(s.sim.contact->memory.zones, 0);
    close_scene(&s);
}

/* Thrown against a balloon that is pinned at the side that is hit: what is held stays to the
 * bit, and nothing crosses. */
static void test_contact_does_not_move_what_pins_hold(void **state)
{
    (void)state;
    struct scene_of_two s;
    open_scene(&s, 2, 1,
               SETTINGS("contact.thickness=0.5", "balloons[1].mesh=sphere", "balloons[0].position=[-60,0,0]",
                        "balloons[1].position=[60,3,2]", "balloons[0].pressure=0", "balloons[1].pressure=0",
                        "balloons[0].threshold=100", "balloons[1].threshold=100", "time.guard=substep",
                        "time.step=0.0125", "balloons[0].pins.place=[1,0,0]", "balloons[0].pins.reach=40"));
    const uint32_t end = s.sim.balloons[0].point_end;
    double(*at)[4] = calloc(end, sizeof *at);
    memcpy(at, s.sim.position, end * sizeof *at);
    for (uint32_t p = end; p < s.sim.point_count; p++)
        s.sim.velocity[p][0] = -60;
    check_steps(&s.sim, 120);
    assert_true(s.sim.contact->memory.wakes > 0);
    for (uint32_t p = 0; p < end; p++)
        if (at[p][0] + 60 > 45 * cos(39 * 3.14159265 / 180))
            assert_memory_equal(at[p], s.sim.position[p], sizeof *at);
    free(at);
    close_scene(&s);
}

/* Edges through triangles, but for those that meet at one place, as the two lips of
 * a cut do when it opens. */
static size_t crossings_but_at_new_cuts(const struct sim *sim)
{
    size_t count = 0;
    double(*extent)[2][3] = crossings_extents(sim);
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (uint32_t u = 0; u < sim->triangle_count; u++)
            for (int k = 0; k < 3 && !crossings_apart(extent[t], extent[u]); k++) {
                const uint32_t *e = sim->edge_point[sim->triangle_edge[u][k]], *p = sim->triangle_point[t];
                bool meet = false;
                for (int i = 0; i < 6; i++)
                    meet |= vec3_distance(sim->position[e[i % 2]], sim->position[p[i / 2]]) == 0;
                count += !meet && crossings_of(sim, e, p);
            }
    free(extent);
    return count;
}

static void check_torn(const char *const *changes, int steps)
{
    struct scene_of_two s;
    struct error err = {0};
    open_scene(&s, 3, 1, changes);
    swirl(&s.sim, 3);
    for (int i = 0; i < steps; i++) {
        assert_ok(sim_step(&s.sim, &err), &err);
        if (s.sim.broken > 0)
            assert_int_equal(crossings_but_at_new_cuts(&s.sim), 0);
    }
    assert_true(s.sim.broken > 0);
    assert_true(s.sim.contact->memory.wakes > 0);
    assert_int_equal(crossings_count(&s.sim), 0); /* by now nothing is new */
    close_scene(&s);
}

/* Sucked together as it is cut, so that the lips want through each other. */
static void test_a_skin_that_is_cut_keeps_apart_at_its_cuts_too(void **state)
{
    (void)state;
    check_torn(SETTINGS("contact.thickness=0.2", "balloons[0].pressure=-4",
                        "balloons[0].fracture.strength=100", "balloons[0].rip.at=0.3",
                        "balloons[0].rip.stretch=0", "balloons[0].rip.length=2", "time.guard=substep",
                        "time.step=0.0125"),
               100);
}

static void test_the_pieces_of_a_balloon_that_bursts_keep_apart(void **state)
{
    (void)state;
    check_torn(SETTINGS("contact.thickness=0.2", "balloons[0].pressure=10",
                        "balloons[0].fracture.strength=1.2", "time.guard=substep", "time.step=0.0125"),
               120);
}

static uint64_t hash_after(unsigned workers, const char *const *changes, int steps)
{
    struct scene_of_two s;
    struct error err = {0};
    open_scene(&s, 3, workers, changes);
    swirl(&s.sim, 3);
    for (int i = 0; i < steps; i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    const uint64_t hash = sim_hash(&s.sim);
    close_scene(&s);
    return hash;
}

static void test_any_number_of_threads_comes_to_the_same_bits(void **state)
{
    (void)state;
    const uint64_t one = hash_after(1, FOLDING, 130);
    assert_int_equal(hash_after(2, FOLDING, 130), one);
    assert_int_equal(hash_after(5, FOLDING, 130), one);
}

/* The list is made anew from the blocks where a state comes back: it goes on with the same bits. */
static void test_a_state_that_is_put_back_goes_on_the_same(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    unsigned char *kept[64];
    size_t count;
    open_scene(&s, 2, 1, FOLDING);
    swirl(&s.sim, 3);
    check_steps(&s.sim, 120);
    const struct sim_block *blocks = sim_blocks(&s.sim, &count);
    assert_true(count <= sizeof kept / sizeof kept[0]);
    for (size_t i = 0; i < count; i++) {
        kept[i] = malloc(blocks[i].size + 1);
        if (blocks[i].size)
            memcpy(kept[i], blocks[i].data, blocks[i].size);
    }
    for (int i = 0; i < 30; i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    const uint64_t hash = sim_hash(&s.sim);
    for (size_t i = 0; i < count; i++) {
        if (blocks[i].size)
            memcpy(blocks[i].data, kept[i], blocks[i].size);
        free(kept[i]);
    }
    for (int i = 0; i < 30; i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    assert_int_equal(sim_hash(&s.sim), hash);
    close_scene(&s);
}

static void test_nothing_near_changes_no_bit_and_sleeps(void **state)
{
    (void)state;
    struct scene_of_two with, without;
    open_scene(&with, 3, 1, SETTINGS("contact.friction=0.3"));
    open_scene(&without, 3, 1, SETTINGS());
    check_steps(&with.sim, 1);
    struct error err = {0};
    for (int i = 0; i < 30; i++)
        assert_ok(sim_step(&with.sim, &err), &err);
    for (int i = 0; i < 31; i++)
        assert_ok(sim_step(&without.sim, &err), &err);
    assert_memory_equal(with.sim.position, without.sim.position,
                        with.sim.point_count * sizeof *with.sim.position);
    assert_int_equal(with.sim.contact->memory.wakes, 0);
    assert_int_equal(with.sim.contact->pair_count, 0);
    close_scene(&with);
    close_scene(&without);
}

static void test_balloons_that_cross_at_first_are_refused(void **state)
{
    (void)state;
    struct scene_of_two s = {0};
    struct error err = {0};
    assert_ok(scene_from_mesh("sphere", &s.scene, &err), &err);
    for (const char *const *change = COLLIDING; *change; change++)
        assert_ok(scene_set(&s.scene, *change, &err), &err);
    assert_ok(scene_set(&s.scene, "balloons[1].position=[0,3,2]", &err), &err);
    assert_ok(scene_check(&s.scene, &err), &err);
    for (int i = 0; i < 2; i++)
        shape_icosphere(2, &s.mesh[i]);
    assert_refused(sim_open(&s.sim, &s.scene, s.mesh, 1, &err), STATUS_INPUT, "cross before the first step",
                   &err);
    close_scene(&s);
}

/* The sweep is told of every push (sweep.h), so that most steps need no look at all edges. */
static void test_no_push_takes_a_point_further_than_the_sweep_knows(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    int pushed = 0;
    open_scene(&s, 3, 1, FOLDING);
    swirl(&s.sim, 3);
    for (int i = 0; i < 200; i++) {
        double farthest = 0;
        assert_ok(sim_step(&s.sim, &err), &err);
        for (uint32_t p = 0; p < s.sim.point_count; p++)
            farthest = fmax(farthest, vec3_distance(s.sim.position[p], s.sim.before[p]));
        assert_true(farthest <= (1 + 1e-12) * sweep_saw_farthest(&s.sim));
        pushed += s.sim.pushed && sweep_saw_none_overlong(&s.sim);
    }
    assert_true(pushed > 10);
    close_scene(&s);
}

#define THROWN(...)                                                                                \
    SETTINGS("contact.thickness=0.5", "balloons[1].mesh=sphere", "balloons[0].position=[-60,0,0]", \
             "balloons[0].pressure=0", "balloons[1].pressure=0", "balloons[0].threshold=100",      \
             "balloons[1].threshold=100", "time.step=0.0125", __VA_ARGS__)
#define BREAKING \
    THROWN("balloons[1].position=[60,3,2]", "balloons[0].threshold=1.25", "balloons[1].threshold=1.25")

/* What pushes make too long lets go in the same step. */
static void test_no_step_of_skins_that_break_on_each_other_ends_with_an_overlong_edge(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    int sure = 0, broke = 0;
    open_scene(&s, 3, 1, BREAKING);
    throw(&s.sim, 30);
    for (int i = 0; i < 200; i++) {
        const uint32_t broken = s.sim.broken;
        assert_ok(sim_step(&s.sim, &err), &err);
        for (uint32_t e = 0; e < s.sim.edge_count; e++) {
            const struct sim_balloon *balloon = &s.sim.balloons[e >= s.sim.balloons[1].edge_begin];
            assert_true(!s.sim.edge_active[e] ||
                        sim_edge_length(&s.sim, e) <= sim_threshold(&s.sim, balloon, e));
        }
        sure += s.sim.pushed && sweep_saw_none_overlong(&s.sim);
        broke += s.sim.pushed && s.sim.broken > broken;
    }
    assert_true(sure > 10 && broke > 10);
    close_scene(&s);
}

/* Pairs with a triangle that is no longer there. */
static size_t count_vanished(const struct sim *sim, const unsigned char *active)
{
    const struct contact *c = sim->contact;
    size_t count = 0;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (uint32_t i = 0; !active[t] && i < c->pair_count; i++)
            count += c->pairs[i].kind == CCD_POINT_TRIANGLE && isfinite(c->pairs[i].distance) &&
                     memcmp(&c->pairs[i].point[1], sim->triangle_point[t], 3 * sizeof(uint32_t)) == 0;
    return count;
}

/* Patches with a hole that are taken not to cross themselves, since all that is left of them looks to one
 * side. */
static size_t count_holes_passed_over(const struct contact_tree *tree, const unsigned char *active)
{
    size_t count = 0;
    for (const struct contact_node *n = tree->nodes; n < tree->nodes + tree->node_count; n++)
        for (uint32_t i = n->begin; i < n->end; i++)
            count += !active[tree->order[i]] && n->sides != 0;
    return count;
}

/* After each of 200 steps; whether some has vanished, and pairs were found again around points. */
static void check_vanished(const char *const *settings, uint32_t vanish, uint64_t mend)
{
    struct scene_of_two s;
    struct error err = {0};
    uint32_t vanished = 0;
    uint64_t mended = 0;
    open_scene(&s, 3, 1, settings);
    throw(&s.sim, 30);
    unsigned char *active = malloc(s.sim.triangle_count);
    for (int i = 0; i < 200; i++) {
        memcpy(active, s.sim.triangle_active, s.sim.triangle_count);
        assert_ok(sim_step(&s.sim, &err), &err);
        assert_int_equal(count_vanished(&s.sim, active), 0);
        assert_int_equal(count_holes_passed_over(&s.sim.contact->tree, active), 0);
        mended += s.sim.contact->memory.again > 0;
    }
    for (uint32_t t = 0; t < s.sim.triangle_count; t++)
        vanished += !active[t];
    assert_true(vanished > vanish && mended > mend);
    free(active);
    close_scene(&s);
}

static void test_skin_that_has_vanished_stands_in_nobodys_way(void **state)
{
    (void)state;
    check_vanished(BREAKING, 10, 10);
}

/* A rip cuts its edges when the step's triangles have been asked: they vanish in the next. */
static void test_nor_does_skin_that_a_rip_lets_vanish(void **state)
{
    (void)state;
    check_vanished(THROWN("balloons[1].position=[60,3,2]", "balloons[0].rip.stretch=0",
                          "balloons[0].rip.at=0.8", "balloons[0].rip.place=[1,0,0]"),
                   2, 0);
}

/* As where a run is resumed, in each step: also when all that was near has gone apart. */
static void test_a_list_that_is_found_anew_changes_nothing(void **state)
{
    (void)state;
    struct scene_of_two s[2];
    for (int k = 0; k < 2; k++) {
        open_scene(&s[k], 2, 1, THROWN("balloons[1].position=[60,88,2]")); /* past each other */
        throw(&s[k].sim, 60);
    }
    for (int i = 0; i < 200; i++) {
        s[1].sim.contact->listed = UINT32_MAX;
        for (int k = 0; k < 2; k++)
            check_steps(&s[k].sim, 1);
        assert_int_equal(sim_hash(&s[0].sim), sim_hash(&s[1].sim));
    }
    close_scene(&s[0]), close_scene(&s[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_folding_balloon_never_crosses_itself),
        cmocka_unit_test(test_without_contact_it_crosses_itself),
        cmocka_unit_test(test_a_squeezed_balloon_never_crosses_itself_nor_enters_the_boxes),
        cmocka_unit_test(test_two_balloons_thrown_together_keep_apart_and_keep_their_momentum),
        cmocka_unit_test(test_no_push_takes_a_point_further_than_the_sweep_knows),
        cmocka_unit_test(test_no_step_of_skins_that_break_on_each_other_ends_with_an_overlong_edge),
        cmocka_unit_test(test_skin_that_has_vanished_stands_in_nobodys_way),
        cmocka_unit_test(test_a_list_that_is_found_anew_changes_nothing),
        cmocka_unit_test(test_nor_does_skin_that_a_rip_lets_vanish),
        cmocka_unit_test(test_contact_does_not_move_what_pins_hold),
        cmocka_unit_test(test_a_skin_that_is_cut_keeps_apart_at_its_cuts_too),
        cmocka_unit_test(test_the_pieces_of_a_balloon_that_bursts_keep_apart),
        cmocka_unit_test(test_any_number_of_threads_comes_to_the_same_bits),
        cmocka_unit_test(test_a_state_that_is_put_back_goes_on_the_same),
        cmocka_unit_test(test_nothing_near_changes_no_bit_and_sleeps),
        cmocka_unit_test(test_balloons_that_cross_at_first_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
