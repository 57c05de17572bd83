/* What pulls at a patch of skin that tears: a string, the thrust at a neck, the hand. */
#include "burst/cuts.h"
#include "sim/effects.h"
#include "sim/gas.h"
#include "sim/live_hand.h"
#include "sim/reorder.h"

#include <string.h>

static const struct inflation tied = {
    .level = 3,
    .stretch = 1.5,
    .springs = true,
    .keys = {"balloons[0].string.place=[0,-1,0]", "balloons[0].string.reach=40",
             "balloons[0].string.to=[0,-3,0]", "balloons[0].string.slack=0.5",
             "balloons[0].string.stiffness=5"}};
static const struct inflation open_neck = {
    .level = 3, .stretch = 1.5, .keys = {"balloons[0].gas.neck=0.6", "balloons[0].gas.neck_at=0"}};

typedef void (*puller)(struct inflated *it);

static void pull_by_effects(struct inflated *it, const char *name)
{
    for (size_t i = 0; i < it->sim.hook_count[EFFECT_FORCES]; i++)
        if (!strcmp(it->sim.hooks[EFFECT_FORCES][i].effect->name, name))
            it->sim.hooks[EFFECT_FORCES][i].effect->apply(&it->sim, it->balloon);
}

static void pull_by_string(struct inflated *it)
{
    pull_by_effects(it, "string");
}

static void pull_by_hand(struct inflated *it)
{
    pull_by_effects(it, "hand");
}

/* The gas has not been told of the cuts: its neck is all that it streams out of. */
static void push_by_neck(struct inflated *it)
{
    gas_let_out(&it->sim, it->balloon);
}

/* What it does to each point, by names, with one for those that were not there yet. */
static void find_pulls(struct inflated *it, puller pull, double (*of)[3])
{
    memset(it->sim.force, 0, it->sim.point_count * sizeof *it->sim.force);
    pull(it);
    for (uint32_t p = 0; p < it->balloon->point_end; p++)
        memcpy(of[reorder_name(it->balloon, p)], it->sim.force[p], sizeof *of);
}

/* All points of a family together are pulled at as the one that they were, and each by its share of the mass:
 * none is pulled away from the others. `pulled`: so many at the least. */
static void assert_cuts_change_no_pull(struct inflated *it, puller pull, uint32_t pulled)
{
    const struct topology *top = it->balloon->topology;
    double(*before)[3] = calloc(it->sim.point_count, sizeof *before),
    (*after)[3] = calloc(it->sim.point_count, sizeof *after),
    *mass = calloc(it->sim.point_count, sizeof *mass);
    sim_forces(&it->sim);
    find_pulls(it, pull, before);
    memcpy(mass, it->sim.mass, it->sim.point_count * sizeof *mass);
    double most = 0;
    for (uint32_t p = 0; p < it->balloon->point_end; p++)
        most = fmax(most, vec3_length(before[p]));
    assert_true(most > 0);
    cut_anywhere(it, 3, 300);
    sim_forces(&it->sim); /* its normals */
    find_pulls(it, pull, after);
    uint32_t shares = 0;
    for (uint32_t name = 0; name < it->balloon->point_end; name++) {
        const uint32_t family = top->family[name];
        const double share = it->sim.mass[name] / mass[family];
        for (int i = 0; i < 3; i++)
            assert_near(after[name][i], before[family][i] * share, 1e-12 * most);
        shares += name >= top->old_points && vec3_length(after[name]) > 0;
    }
    assert_true(shares >= pulled);
    free(before);
    free(after);
    free(mass);
}

static void a_string_holds_both_sides_of_a_crack(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &tied);
    assert_cuts_change_no_pull(&it, pull_by_string, 10);
    deflate(&it);
}

static void a_neck_pushes_both_sides_of_a_crack(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &open_neck);
    assert_cuts_change_no_pull(&it, push_by_neck, 5);
    deflate(&it);
}

static void the_hand_holds_both_sides_of_a_crack(void **unused)
{
    (void)unused;
    struct inflated it;
    struct hand hand;
    struct hand_hit hit;
    struct error err = {0};
    inflate(&it, &tied);
    assert_ok(hand_open(&hand, &it.sim, &err), &err);
    assert_true(hand_find(&it.sim, (const double[3]){0.1, 0.2, 9}, (const double[3]){0, 0, -1}, &hit));
    hand_take(&hand, &it.sim, &hit);
    hand_move(&hand, &it.sim, (const double[3]){hit.place[0], hit.place[1], hit.place[2] + 0.3});
    const double energy = hand_energy(&hand, &it.sim);
    assert_cuts_change_no_pull(&it, pull_by_hand, 3);
    assert_near(hand_energy(&hand, &it.sim), energy, 1e-12 * energy);
    hand_close(&hand, &it.sim);
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_string_holds_both_sides_of_a_crack),
        cmocka_unit_test(a_neck_pushes_both_sides_of_a_crack),
        cmocka_unit_test(the_hand_holds_both_sides_of_a_crack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
