/* What the octree's walks and figures say, against a dense grid of cells. */
#include "grids.h"

struct visited {
    struct grid grid;
    int leaves;
    uint64_t last; /* Morton code of the leaf before */
};

static uint64_t morton(int x, int y, int z)
{
    uint64_t code = 0;
    for (int bit = 0; bit < DEPTH; bit++)
        code |= (uint64_t)((x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2) << (3 * bit);
    return code;
}

static bool paint_leaf(void *context, const struct octree_leaf *leaf)
{
    struct visited *visited = context;
    uint64_t code = morton(leaf->x, leaf->y, leaf->z);
    assert_true(visited->leaves == 0 || code > visited->last);
    visited->last = code;
    visited->leaves++;
    const struct cells cells = {
        {leaf->x, leaf->y, leaf->z},
        {leaf->x + leaf->side - 1, leaf->y + leaf->side - 1, leaf->z + leaf->side - 1},
        false};
    set_grid(&visited->grid, &cells, leaf->material);
    return true;
}

static void a_visit_meets_every_full_leaf_in_morton_order(void **state)
{
    (void)state;
    struct grid grid;
    struct octree tree = random_tree(6, 40, &grid);
    struct visited visited = {0};
    octree_visit_all(&tree, paint_leaf, &visited);
    assert_memory_equal(&visited.grid, &grid, sizeof grid);
    assert_int_equal(visited.leaves, octree_measure(&tree).full_leaves);
    octree_clear(&tree);
}

static void a_visit_of_some_cells_meets_the_leaves_that_touch_them(void **state)
{
    (void)state;
    struct grid grid;
    struct octree tree = random_tree(7, 40, &grid);
    uint64_t seed = 8;
    for (int i = 0; i < 100; i++) {
        struct cells range = random_cells(&seed);
        struct visited visited = {0};
        octree_visit(&tree, range.low, range.high, paint_leaf, &visited);
        for (int z = range.low[2]; z <= range.high[2]; z++)
            for (int y = range.low[1]; y <= range.high[1]; y++)
                for (int x = range.low[0]; x <= range.high[0]; x++)
                    assert_int_equal(visited.grid.cell[z][y][x], grid.cell[z][y][x]);
    }
    octree_clear(&tree);
}

static bool stop_at_once(void *context, const struct octree_leaf *leaf)
{
    (void)leaf;
    ++*(int *)context;
    return false;
}

static void a_visitor_can_end_the_walk(void **state)
{
    (void)state;
    struct grid grid;
    struct octree tree = random_tree(9, 40, &grid);
    int calls = 0;
    octree_visit_all(&tree, stop_at_once, &calls);
    assert_int_equal(calls, 1);
    octree_clear(&tree);
}

static int at_or_outside(const struct grid *grid, int x, int y, int z)
{
    bool within = x >= 0 && y >= 0 && z >= 0 && x < SIDE && y < SIDE && z < SIDE;
    return within ? grid->cell[z][y][x] : 0;
}

/* [cell][axis][0 down, 1 up] */
static unsigned char exposed[CELLS][3][2];

static bool mark_face(void *context, const struct octree_face *face)
{
    const struct grid *grid = context;
    const int first = (face->axis + 1) % 3, second = (face->axis + 2) % 3;
    for (int a = 0; a < face->side; a++)
        for (int b = 0; b < face->side; b++) {
            int at[3] = {face->corner[0], face->corner[1], face->corner[2]};
            at[first] += a;
            at[second] += b;
            at[face->axis] -= face->outward > 0; /* the cell behind the face */
            assert_int_equal(at_or_outside(grid, at[0], at[1], at[2]), face->material);
            exposed[(at[2] * SIDE + at[1]) * SIDE + at[0]][face->axis][face->outward > 0]++;
        }
    return true;
}

static void every_exposed_face_is_met_once_and_looks_out(void **state)
{
    (void)state;
    struct grid grid;
    struct octree tree = random_tree(10, 25, &grid);
    memset(exposed, 0, sizeof exposed);
    octree_visit_faces(&tree, mark_face, &grid);
    uint64_t faces = 0;
    for (int i = 0; i < CELLS; i++)
        for (int axis = 0; axis < 3; axis++)
            for (int up = 0; up < 2; up++) {
                int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
                bool full = at_or_outside(&grid, at[0], at[1], at[2]);
                at[axis] += up ? 1 : -1;
                bool bare = full && !at_or_outside(&grid, at[0], at[1], at[2]);
                assert_int_equal(exposed[i][axis][up], bare);
                faces += bare;
            }
    assert_int_equal(octree_measure(&tree).exposed_faces, faces);
    octree_clear(&tree);
}

/* A cube with holes of up to 5 cells a side, some of which meet each other or the outside. */
static struct octree holey_tree(uint64_t seed, struct grid *grid)
{
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 1);
    memset(grid, 1, sizeof *grid);
    for (int i = 0; i < 40; i++) {
        struct cells hole = {.vague = false};
        for (int k = 0; k < 3; k++) {
            hole.low[k] = (int)(random_bits(&seed) % SIDE);
            hole.high[k] = hole.low[k] + (int)(random_bits(&seed) % 5);
            hole.high[k] = hole.high[k] < SIDE ? hole.high[k] : SIDE - 1;
        }
        assert_ok(octree_apply(&tree, cells_cover, &hole, 0, &err), &err);
        set_grid(grid, &hole, 0);
    }
    return tree;
}

/* Spreads 255 over the empty cells that are joined to the outside, until nothing changes. */
static void flood_grid(struct grid *grid)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < CELLS; i++) {
            int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
            bool at_border = !x || !y || !z || x == SIDE - 1 || y == SIDE - 1 || z == SIDE - 1;
            if (grid->cell[z][y][x] != 0)
                continue;
            if (at_border || at_or_outside(grid, x - 1, y, z) == 255 ||
                at_or_outside(grid, x + 1, y, z) == 255 || at_or_outside(grid, x, y - 1, z) == 255 ||
                at_or_outside(grid, x, y + 1, z) == 255 || at_or_outside(grid, x, y, z - 1) == 255 ||
                at_or_outside(grid, x, y, z + 1) == 255) {
                grid->cell[z][y][x] = 255;
                changed = true;
            }
        }
    }
}

static void hollows_are_what_a_flood_of_the_grid_does_not_reach(void **state)
{
    (void)state;
    uint64_t hollows = 0;
    for (uint64_t seed = 20; seed < 40; seed++) {
        struct grid grid;
        struct error err = {0};
        struct octree tree = holey_tree(seed, &grid);
        uint64_t cells = 0, expected = 0;
        flood_grid(&grid);
        for (int i = 0; i < CELLS; i++) {
            unsigned char *cell = &grid.cell[0][0][0] + i;
            expected += *cell == 0;
            *cell = *cell == 0 ? 7 : *cell == 255 ? 0 : *cell;
        }
        assert_ok(octree_fill_hollows(&tree, 7, &cells, &err), &err);
        assert_int_equal(cells, expected);
        assert_same_cells(&tree, &grid);
        assert_sound(&tree);
        hollows += cells;
        octree_clear(&tree);
    }
    assert_true(hollows > 100);
}

static void cubes_of_one_leaf_have_no_hollows(void **state)
{
    (void)state;
    for (unsigned material = 0; material < 2; material++) {
        struct error err = {0};
        struct octree tree = new_tree(DEPTH, material);
        uint64_t cells = 1;
        assert_ok(octree_fill_hollows(&tree, 7, &cells, &err), &err);
        assert_int_equal(cells, 0);
        assert_int_equal(tree.root, material);
    }
}

static void bounds_and_cells_are_those_of_the_grid(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = new_tree(DEPTH, 0);
    assert_true(octree_measure(&tree).high[0] < octree_measure(&tree).low[0]);
    assert_ok(octree_set(&tree, 3, 5, 9, 1, &err), &err);
    assert_ok(octree_set(&tree, 7, 2, 9, 2, &err), &err);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.cells, 2);
    assert_int_equal(info.exposed_faces, 12);
    assert_int_equal(info.smallest_side, 1);
    const int low[3] = {3, 2, 9}, high[3] = {7, 5, 9};
    assert_memory_equal(info.low, low, sizeof low);
    assert_memory_equal(info.high, high, sizeof high);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_visit_meets_every_full_leaf_in_morton_order),
        cmocka_unit_test(a_visit_of_some_cells_meets_the_leaves_that_touch_them),
        cmocka_unit_test(a_visitor_can_end_the_walk),
        cmocka_unit_test(every_exposed_face_is_met_once_and_looks_out),
        cmocka_unit_test(hollows_are_what_a_flood_of_the_grid_does_not_reach),
        cmocka_unit_test(cubes_of_one_leaf_have_no_hollows),
        cmocka_unit_test(bounds_and_cells_are_those_of_the_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
