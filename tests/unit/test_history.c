/* Undo and redo, to the byte. */
#include "sculpt/history.h"
#include "trees.h"

static void do_step(struct history *history, struct octree *tree, const struct chip *chip, int chips)
{
    struct error err = {0};
    history_begin(history, tree);
    for (int i = 0; i < chips; i++)
        assert_ok(sculpt_chip(tree, &chip[i], &err), &err);
    assert_true(history_end(history, tree, NULL));
}

/* Steps of one to three random chips, undone to the start and done again to the end, hash by hash. Steps that
 * change nothing are no steps. */
static void check_there_and_back(unsigned depth, double size, int operations, uint64_t seed)
{
    struct history history;
    struct octree tree = new_tree(depth, 1);
    uint64_t *hash = calloc((size_t)operations + 1, sizeof *hash);
    history_init(&history, SIZE_MAX);
    hash[0] = fingerprint(&tree);
    for (int i = 0; i < operations; i++) {
        const struct chip chips[3] = {random_operation(size, &seed), random_operation(size, &seed),
                                      random_operation(size, &seed)};
        do_step(&history, &tree, chips, 1 + (int)(random_bits(&seed) % 3));
        hash[history.count] = fingerprint(&tree);
    }
    size_t steps = history.count;
    assert_false(history_can_redo(&history));
    for (int times = 0; times < 2; times++) {
        for (size_t i = steps; i-- > 0;) {
            assert_true(history_undo(&history, &tree, NULL));
            assert_int_equal(fingerprint(&tree), hash[i]);
        }
        assert_false(history_undo(&history, &tree, NULL));
        for (size_t i = 1; i <= steps; i++) {
            assert_true(history_redo(&history, &tree, NULL));
            assert_int_equal(fingerprint(&tree), hash[i]);
        }
        assert_false(history_redo(&history, &tree, NULL));
    }
    assert_sound(&tree);
    free(hash);
    history_clear(&history);
    octree_clear(&tree);
}

static void all_is_undone_to_the_start_and_redone_to_the_end_hash_by_hash(void **state)
{
    (void)state;
    check_there_and_back(0, 0.5, 100, 1);
    check_there_and_back(1, 0.5, 300, 2);
    check_there_and_back(4, 0.4, 2000, 3);
    check_there_and_back(6, 0.2, 700, 4);
    check_there_and_back(8, 0.04, 200, 5);
    check_there_and_back(10, 0.01, 60, 6);
}

/* At random forwards and backwards, with new steps in between, which end what could be redone. */
static void wandering_through_the_history_meets_the_same_trees(void **state)
{
    (void)state;
    enum { STEPS = 3000 };
    static uint64_t hash[STEPS + 1];
    uint64_t seed = 7;
    struct history history;
    struct octree tree = new_tree(5, 0);
    history_init(&history, SIZE_MAX);
    hash[0] = fingerprint(&tree);
    for (int i = 0; i < STEPS; i++) {
        uint64_t way = random_bits(&seed) % 8;
        if (way < 3) {
            const struct chip chip = random_operation(0.3, &seed);
            do_step(&history, &tree, &chip, 1);
            hash[history.done] = fingerprint(&tree);
        } else if (way < 6) {
            const bool can = history_can_undo(&history);
            assert_int_equal(history_undo(&history, &tree, NULL), can);
        } else {
            const bool can = history_can_redo(&history);
            assert_int_equal(history_redo(&history, &tree, NULL), can);
        }
        assert_int_equal(fingerprint(&tree), hash[history.done]);
    }
    assert_sound(&tree);
    history_clear(&history);
    octree_clear(&tree);
}

/* Recording changes nothing about what is done. */
static void a_recorded_tree_is_made_of_the_same_bytes(void **state)
{
    (void)state;
    uint64_t seed = 8;
    struct error err = {0};
    struct history history;
    struct octree recorded = new_tree(6, 1), plain = new_tree(6, 1);
    history_init(&history, SIZE_MAX);
    for (int i = 0; i < 300; i++) {
        const struct chip chip = random_operation(0.3, &seed);
        do_step(&history, &recorded, &chip, 1);
        assert_ok(sculpt_chip(&plain, &chip, &err), &err);
        assert_int_equal(fingerprint(&recorded), fingerprint(&plain));
    }
    history_clear(&history);
    octree_clear(&recorded);
    octree_clear(&plain);
}

static void single_cells_and_filled_hollows_can_be_undone_too(void **state)
{
    (void)state;
    struct error err = {0};
    struct history history;
    uint64_t filled;
    struct octree tree = new_tree(4, 1);
    history_init(&history, SIZE_MAX);
    const uint64_t start = fingerprint(&tree);
    history_begin(&history, &tree);
    assert_ok(octree_set(&tree, 5, 6, 7, 0, &err), &err);
    assert_true(history_end(&history, &tree, NULL));
    const uint64_t with_hole = fingerprint(&tree);
    struct octree_regions regions;
    history_begin(&history, &tree);
    assert_ok(octree_fill_hollows(&tree, 2, &filled, &err), &err);
    assert_true(history_end(&history, &tree, &regions));
    assert_int_equal(filled, 1);
    assert_int_equal(regions.count, 1);
    assert_true(history_undo(&history, &tree, &regions));
    assert_int_equal(fingerprint(&tree), with_hole);
    assert_true(history_undo(&history, &tree, &regions));
    assert_int_equal(fingerprint(&tree), start);
    assert_int_equal(regions.count, 1);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(regions.items[0].low[k], 5 + k);
        assert_int_equal(regions.items[0].high[k], 5 + k);
    }
    history_clear(&history);
    octree_clear(&tree);
}

static bool in_regions(const struct octree_regions *regions, int x, int y, int z)
{
    const int cell[3] = {x, y, z};
    for (int i = 0; i < regions->count; i++) {
        bool inside = true;
        for (int k = 0; k < 3; k++)
            inside = inside && cell[k] >= regions->items[i].low[k] && cell[k] <= regions->items[i].high[k];
        if (inside)
            return true;
    }
    return false;
}

static uint64_t cells_in(const struct octree_regions *regions)
{
    uint64_t cells = 0;
    for (int i = 0; i < regions->count; i++) {
        const struct octree_region *region = &regions->items[i];
        cells += (uint64_t)(region->high[0] - region->low[0] + 1) * (region->high[1] - region->low[1] + 1) *
                 (region->high[2] - region->low[2] + 1);
    }
    return cells;
}

static void every_cell_that_changes_lies_in_a_region(void **state)
{
    (void)state;
    enum { DEPTH = 5, SIDE = 1 << DEPTH };
    uint64_t seed = 9;
    struct error err = {0};
    struct history history;
    struct octree tree = new_tree(DEPTH, 1), before = {0};
    history_init(&history, SIZE_MAX);
    for (int i = 0; i < 200; i++) {
        struct octree_regions regions;
        const struct chip chip = random_operation(0.3, &seed);
        assert_ok(octree_copy(&before, &tree, &err), &err);
        history_begin(&history, &tree);
        assert_ok(sculpt_chip(&tree, &chip, &err), &err);
        assert_true(history_end(&history, &tree, &regions));
        for (int x = 0; x < SIDE; x++)
            for (int y = 0; y < SIDE; y++)
                for (int z = 0; z < SIDE; z++)
                    if (octree_at(&tree, x, y, z) != octree_at(&before, x, y, z))
                        assert_true(in_regions(&regions, x, y, z));
    }
    history_clear(&history);
    octree_clear(&tree);
    octree_clear(&before);
}

/* Two balls of 10 cells across, 100 apart: what is to be drawn anew is around them, not all between. */
static void mirror_images_have_regions_of_their_own(void **state)
{
    (void)state;
    struct error err = {0};
    struct history history;
    struct octree_regions regions;
    struct octree tree = new_tree(7, 1);
    const struct chip chip = {.shape = CHIP_SPHERE, .value = {0.1, 0.5, 0.5, 5 / 128.0}, .mirror = 1};
    history_init(&history, SIZE_MAX);
    history_begin(&history, &tree);
    assert_ok(sculpt_chip(&tree, &chip, &err), &err);
    assert_true(history_end(&history, &tree, &regions));
    assert_int_equal(regions.count, 2);
    assert_true(cells_in(&regions) <= 2 * 12 * 12 * 12);
    history_clear(&history);
    octree_clear(&tree);
}

static void a_step_that_changes_nothing_is_no_step(void **state)
{
    (void)state;
    struct history history;
    struct octree tree = new_tree(5, 1);
    const struct chip away = {.shape = CHIP_SPHERE, .value = {0.3, 0.3, 0.3, 0.1}},
                      again = {.shape = CHIP_SPHERE, .value = {0.3, 0.3, 0.3, 0.05}},
                      all = {.shape = CHIP_BOX, .material = 2, .value = {0, 0, 0, 1, 1, 1}};
    history_init(&history, SIZE_MAX);
    do_step(&history, &tree, &away, 1);
    assert_true(history_undo(&history, &tree, NULL));
    assert_true(history_redo(&history, &tree, NULL));
    do_step(&history, &tree, &again, 1);
    assert_int_equal(history.count, 1);
    do_step(&history, &tree, &all, 1);
    assert_int_equal(history.count, 2);
    do_step(&history, &tree, &all, 1);
    assert_int_equal(history.count, 2);
    history_clear(&history);
    octree_clear(&tree);
}

static void the_oldest_steps_are_dropped_at_the_limit(void **state)
{
    (void)state;
    enum { STEPS = 500 };
    static uint64_t hash[STEPS + 1];
    uint64_t seed = 10;
    struct history history;
    struct octree tree = new_tree(5, 1);
    history_init(&history, 100000);
    int made = 0;
    for (int i = 0; i < STEPS; i++) {
        const struct chip chip = {.shape = CHIP_SPHERE,
                                  .material = (unsigned)i % 2,
                                  .value = {random_unit(&seed), random_unit(&seed), random_unit(&seed), 0.1}};
        size_t before = fingerprint(&tree);
        do_step(&history, &tree, &chip, 1);
        assert_true(history.bytes <= history.byte_limit);
        if (fingerprint(&tree) != before)
            hash[++made] = fingerprint(&tree);
    }
    /* a step is a few kilobytes */
    assert_true(history.count >= 5 && history.count < (size_t)made);
    size_t kept = history.count, undone = 0;
    for (; history_undo(&history, &tree, NULL); undone++)
        assert_int_equal(fingerprint(&tree), hash[(size_t)made - undone - 1]);
    assert_int_equal(undone, kept);
    history_clear(&history);
    octree_clear(&tree);
}

static void a_step_larger_than_the_limit_is_done_but_ends_the_history(void **state)
{
    (void)state;
    struct error err = {0};
    struct history history;
    struct octree tree = new_tree(7, 1), plain = new_tree(7, 1);
    const struct chip small = {.shape = CHIP_SPHERE, .value = {0.1, 0.1, 0.1, 0.02}},
                      hollow = {.shape = CHIP_SPHERE, .value = {0.5, 0.5, 0.5, 0.4}},
                      large = {.shape = CHIP_SPHERE, .value = {0.5, 0.5, 0.5, 0.41}};
    assert_ok(sculpt_chip(&tree, &hollow, &err), &err);
    assert_ok(sculpt_chip(&plain, &hollow, &err), &err);
    history_init(&history,
                 50000); /* the ball has 33,000 cells at its skin, most of them written at 8 bytes each */
    do_step(&history, &tree, &small, 1);
    history_begin(&history, &tree);
    assert_ok(sculpt_chip(&tree, &large, &err), &err);
    assert_false(history_end(&history, &tree, NULL));
    assert_false(history_can_undo(&history) || history_can_redo(&history));
    assert_ok(sculpt_chip(&plain, &small, &err), &err);
    assert_ok(sculpt_chip(&plain, &large, &err), &err);
    assert_true(octree_equal(&tree, &plain));
    do_step(&history, &tree, &small, 1); /* nothing is left there */
    const struct chip fill = {.shape = CHIP_SPHERE, .material = 1, .value = {0.1, 0.1, 0.1, 0.02}};
    do_step(&history, &tree, &fill, 1);
    assert_true(history_undo(&history, &tree, NULL));
    assert_true(octree_equal(&tree, &plain));
    history_clear(&history);
    octree_clear(&tree);
    octree_clear(&plain);
}

static void a_step_that_is_cancelled_leaves_no_trace(void **state)
{
    (void)state;
    uint64_t seed = 11;
    struct error err = {0};
    struct history history;
    struct octree tree = new_tree(5, 1);
    history_init(&history, SIZE_MAX);
    for (int i = 0; i < 100; i++) {
        const struct chip chips[2] = {random_operation(0.4, &seed), random_operation(0.4, &seed)};
        const uint64_t before = fingerprint(&tree);
        history_begin(&history, &tree);
        assert_ok(sculpt_chip(&tree, &chips[0], &err), &err);
        assert_true(history_cancel(&history, &tree));
        assert_int_equal(fingerprint(&tree), before);
        do_step(&history, &tree, &chips[1], 1);
    }
    history_clear(&history);
    octree_clear(&tree);
}

/* Its blocks may be those that a redo would go back to. */
static void what_was_undone_before_a_cancelled_step_is_not_redone(void **state)
{
    (void)state;
    struct error err = {0};
    struct history history;
    struct octree tree = new_tree(5, 1);
    history_init(&history, SIZE_MAX);
    const struct chip large = {.shape = CHIP_SPHERE, .value = {0.5, 0.5, 0.5, 0.4}};
    const struct chip small = {.shape = CHIP_SPHERE, .value = {0.2, 0.2, 0.2, 0.1}};
    const uint64_t before = fingerprint(&tree);
    do_step(&history, &tree, &large, 1);
    assert_true(history_undo(&history, &tree, NULL));
    history_begin(&history, &tree);
    assert_ok(sculpt_chip(&tree, &small, &err), &err);
    assert_true(history_cancel(&history, &tree));
    assert_false(history_redo(&history, &tree, NULL));
    assert_int_equal(fingerprint(&tree), before);
    history_clear(&history);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_is_undone_to_the_start_and_redone_to_the_end_hash_by_hash),
        cmocka_unit_test(wandering_through_the_history_meets_the_same_trees),
        cmocka_unit_test(a_recorded_tree_is_made_of_the_same_bytes),
        cmocka_unit_test(single_cells_and_filled_hollows_can_be_undone_too),
        cmocka_unit_test(every_cell_that_changes_lies_in_a_region),
        cmocka_unit_test(mirror_images_have_regions_of_their_own),
        cmocka_unit_test(a_step_that_changes_nothing_is_no_step),
        cmocka_unit_test(the_oldest_steps_are_dropped_at_the_limit),
        cmocka_unit_test(a_step_larger_than_the_limit_is_done_but_ends_the_history),
        cmocka_unit_test(a_step_that_is_cancelled_leaves_no_trace),
        cmocka_unit_test(what_was_undone_before_a_cancelled_step_is_not_redone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
