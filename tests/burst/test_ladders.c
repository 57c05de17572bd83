/* Bursts over ladders of stretches, meshes, rotations, seeds and steps: minutes. */
#include "burst/inflated.h"

static struct shreds burst(const struct inflation *how, bool pricked)
{
    struct inflated it;
    inflate(&it, how);
    if (pricked)
        prick(&it);
    run_until(&it, 2.5);
    const struct shreds s = count_shreds(&it);
    print_message("# level %u, stretch %g, turned %g, step %g, %s: %u pieces, the largest %.3f\n", how->level,
                  how->stretch, how->turned, how->step, how->keys[0] ? how->keys[0] : "", s.count, s.largest);
    deflate(&it);
    return s;
}

static void pieces_grow_with_the_stretch(void **unused)
{
    (void)unused;
    uint32_t before = 0;
    for (int i = 0; i < 8; i++) {
        const struct shreds s = burst(&(struct inflation){.level = 4, .stretch = 1.3 + 0.13 * i}, true);
        assert_true(s.count >= before);
        before = s.count;
    }
}

/* Counts within a factor of 2, and no dust. */
struct spread {
    uint32_t least, most;
};

static void take(struct spread *spread, const struct inflation *how)
{
    const struct shreds s = burst(how, false);
    assert_true(s.largest > 0.08 && s.fewest >= 4);
    spread->least = s.count < spread->least ? s.count : spread->least;
    spread->most = s.count > spread->most ? s.count : spread->most;
}

static void bursts_are_alike_whatever_the_mesh_the_seed_and_the_step(void **unused)
{
    (void)unused;
    struct spread spread = {UINT32_MAX, 0};
    const char *seeds[] = {"balloons[0].fracture.seed=2", "balloons[0].fracture.seed=3",
                           "balloons[0].fracture.seed=4", "balloons[0].fracture.seed=5"};
    for (unsigned level = 4; level <= 6; level++)
        take(&spread, &(struct inflation){.level = level, .stretch = 2.36, .workers = 2});
    for (int i = 1; i <= 5; i++)
        take(&spread, &(struct inflation){.level = 4, .stretch = 2.36, .turned = i});
    for (int i = 0; i < 4; i++)
        take(&spread, &(struct inflation){.level = 4, .stretch = 2.36, .keys = {seeds[i]}});
    take(&spread, &(struct inflation){.level = 4, .stretch = 2.36, .step = 0.5});
    take(&spread, &(struct inflation){.level = 4, .stretch = 2.36, .step = 2});
    print_message("# %u to %u pieces\n", spread.least, spread.most);
    assert_true(spread.most <= 2 * spread.least);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_grow_with_the_stretch),
        cmocka_unit_test(bursts_are_alike_whatever_the_mesh_the_seed_and_the_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
