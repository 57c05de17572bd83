/* Octrees cut off higher up: a cell is full when any part of it is. */
#include "check.h"
#include "sculpt/sculpt.h"

static struct error err;

static void make(const char *script, struct octree *tree)
{
    struct chips chips = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_begin(&chips, 0, tree, &err), &err);
    assert_ok(chips_run(tree, &chips, &err), &err);
    chips_clear(&chips);
}

static unsigned first_material(const struct octree *tree, int x, int y, int z, int side)
{
    for (int i = 0; i < side * side * side; i++) {
        const unsigned material = octree_at(tree, x * side + i % side, y * side + i / side % side,
                                            z * side + i / side / side);
        if (material)
            return material;
    }
    return 0;
}

static void assert_cut(const struct octree *tree, unsigned depth, struct octree *cut)
{
    const int count = 1 << depth, side = 1 << (tree->depth - depth);
    struct octree want = {0};
    assert_ok(octree_cut(tree, depth, cut, &err), &err);
    assert_ok(octree_init(&want, depth, 0, &err), &err);
    for (int i = 0; i < count * count * count; i++) {
        const int x = i % count, y = i / count % count, z = i / count / count;
        assert_ok(octree_set(&want, x, y, z, first_material(tree, x, y, z, side), &err), &err);
    }
    assert_true(octree_equal(cut, &want));
    octree_clear(&want);
}

static void a_cell_is_full_when_any_part_of_it_is(void **state)
{
    (void)state;
    struct octree tree = {0}, cut = {0};
    make("depth 5\nstart empty\nfill sphere 0.4 0.5 0.5 0.3\nchip sphere 0.4 0.5 0.7 0.15\n"
         "fill box 0.97 0.97 0.97 1 1 1\n",
         &tree);
    for (unsigned depth = 0; depth <= 5; depth++) /* the same tree again and again */
        assert_cut(&tree, depth, &cut);
    octree_clear(&tree);
    make("depth 3\n", &tree);
    assert_cut(&tree, 2, &cut);
    assert_int_equal(cut.root, 1);
    octree_clear(&tree);
    octree_clear(&cut);
}

static void deeper_than_it_is_it_is_a_copy(void **state)
{
    (void)state;
    struct octree tree = {0}, cut = {0};
    make("depth 4\nmaterial 3\nfill sphere 0.5 0.5 0.5 0.3\ncoefficient 3 2\n", &tree);
    assert_ok(octree_cut(&tree, 9, &cut, &err), &err);
    assert_int_equal(cut.depth, 4);
    assert_true(octree_equal(&tree, &cut));
    octree_clear(&tree);
    octree_clear(&cut);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_is_full_when_any_part_of_it_is),
        cmocka_unit_test(deeper_than_it_is_it_is_a_copy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
