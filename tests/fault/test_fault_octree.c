/* Octrees where memory ends and files fail: they stay whole, and so does what was there. */
#include "../unit/trees.h"
#include "common/octree_chunks.h"
#include "faulty.h"
#include "sculpt/history.h"

/* One recorded operation on a copy of `start` with a call failing. What could not be done is taken back to
 * the byte where the tape is whole; what was done can be undone where it was kept. */
static void check_recorded(const struct octree *start, const struct octree *done, const struct chip *chip,
                           struct fault *fault)
{
    struct error err = {0};
    struct history history;
    struct octree tree = {0};
    history_init(&history, SIZE_MAX);
    assert_ok(octree_copy(&tree, start, &err), &err);
    fault_begin(fault);
    history_begin(&history, &tree);
    enum status status = sculpt_chip(&tree, chip, &err);
    bool kept = status ? history_cancel(&history, &tree) : history_end(&history, &tree, NULL);
    fault_end(fault);
    assert_true(fault->failed || (!status && kept));
    assert_says(status, &err, FAULT_MEMORY);
    assert_sound(&tree);
    if (!status)
        assert_true(octree_equal(&tree, done));
    if (!status && kept && history.count > 0)
        assert_true(history_undo(&history, &tree, NULL));
    if (kept)
        assert_int_equal(fingerprint(&tree), fingerprint(start));
    if (!status && kept && history_redo(&history, &tree, NULL))
        assert_true(octree_equal(&tree, done));
    history_clear(&history);
    octree_clear(&tree);
}

/* The same without a history: the tree may have changed in part, but it is a tree. */
static void check_unrecorded(const struct octree *start, const struct chip *chip, struct fault *fault)
{
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_copy(&tree, start, &err), &err);
    fault_begin(fault);
    enum status status = sculpt_chip(&tree, chip, &err);
    fault_end(fault);
    assert_says(status, &err, FAULT_MEMORY);
    assert_sound(&tree);
    octree_clear(&tree);
}

static void memory_that_ends_in_a_chip_leaves_the_tree_whole(void **state)
{
    (void)state;
    uint64_t seed = 12;
    struct error err = {0};
    struct octree start = new_tree(6, 1), done = {0};
    for (int i = 0; i < 60; i++) {
        const struct chip chip = random_operation(0.4, &seed);
        assert_ok(octree_copy(&done, &start, &err), &err);
        assert_ok(sculpt_chip(&done, &chip, &err), &err);
        for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);)
            check_recorded(&start, &done, &chip, &fault);
        for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);)
            check_unrecorded(&start, &chip, &fault);
        assert_ok(octree_copy(&start, &done, &err), &err);
    }
    octree_clear(&start);
    octree_clear(&done);
}

static void memory_that_ends_in_single_cells_and_hollows_leaves_the_tree_whole(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree start = random_sculpture(5, 20, 4), tree = {0};
    uint64_t cells = 0, filled = 0;
    assert_ok(octree_copy(&tree, &start, &err), &err);
    assert_ok(octree_fill_hollows(&tree, 3, &filled, &err), &err);
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        assert_ok(octree_copy(&tree, &start, &err), &err);
        fault_begin(&fault);
        enum status status = octree_set(&tree, 1, 2, 3, 9, &err);
        if (!status)
            status = octree_fill_hollows(&tree, 3, &cells, &err);
        fault_end(&fault);
        assert_says(status, &err, FAULT_MEMORY);
        assert_sound(&tree);
        assert_true(status || cells == filled);
    }
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        struct octree copy = new_tree(2, 7);
        fault_begin(&fault);
        enum status status = octree_copy(&copy, &start, &err);
        fault_end(&fault);
        assert_says(status, &err, FAULT_MEMORY);
        assert_true(status ? copy.root == 7 && copy.depth == 2 : octree_equal(&copy, &start));
        octree_clear(&copy);
    }
    octree_clear(&tree);
    octree_clear(&start);
}

/* A sculpture with a chunk of its own. */
struct sculpture {
    struct octree tree;
    struct octree_chunks chunks;
};

static struct sculpture new_sculpture(void)
{
    struct error err = {0};
    struct sculpture sculpture = {.tree = random_sculpture(5, 20, 8)};
    struct bytes note = {(unsigned char *)strdup("a note"), 6};
    sculpture.tree.coefficient[2] = 0.5f;
    assert_ok(octree_chunks_put(&sculpture.chunks, "NOTE", &note, &err), &err);
    return sculpture;
}

static void clear_sculpture(struct sculpture *sculpture)
{
    octree_clear(&sculpture->tree);
    octree_chunks_clear(&sculpture->chunks);
}

static enum status save_sculpture(const void *thing, const char *path, struct error *err)
{
    const struct sculpture *sculpture = thing;
    return octree_save_with(&sculpture->tree, &sculpture->chunks, path, err);
}

static void a_sculpture_is_saved_whole_or_not_at_all(void **state)
{
    (void)state;
    struct sculpture sculpture = new_sculpture();
    check_save(save_sculpture, &sculpture, "a.oct");
    clear_sculpture(&sculpture);
}

static void a_sculpture_that_cannot_be_loaded_leaves_the_old_one(void **state)
{
    (void)state;
    struct error err = {0};
    struct sculpture good = new_sculpture();
    assert_ok(save_sculpture(&good, "a.oct", &err), &err);
    for (int i = 0; i < 2; i++)
        for (struct fault fault = {.kinds = fault_kinds[i]}; fault_next(&fault);) {
            struct octree tree = new_tree(2, 7);
            struct octree_chunks chunks = {0};
            fault_begin(&fault);
            enum status status = octree_load_with("a.oct", &tree, &chunks, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_int_equal(chunks.count, status ? 0 : 1);
            assert_true(status ? tree.root == 7 && tree.depth == 2 : octree_equal(&tree, &good.tree));
            octree_clear(&tree);
            octree_chunks_clear(&chunks);
        }
    clear_sculpture(&good);
    unlink("a.oct");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_that_ends_in_a_chip_leaves_the_tree_whole),
        cmocka_unit_test(memory_that_ends_in_single_cells_and_hollows_leaves_the_tree_whole),
        cmocka_unit_test(a_sculpture_is_saved_whole_or_not_at_all),
        cmocka_unit_test(a_sculpture_that_cannot_be_loaded_leaves_the_old_one),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
