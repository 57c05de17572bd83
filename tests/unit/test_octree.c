/* The octree against a dense grid of cells, and what its walks and figures say. */
#include "check.h"
#include "common/octree.h"
#include "common/octree_blocks.h"
#include "common/random.h"

enum { DEPTH = 4, SIDE = 1 << DEPTH, CELLS = SIDE * SIDE * SIDE };

struct grid {
    unsigned char cell[SIDE][SIDE][SIDE]; /* [z][y][x] */
};

/* A box of cells, as a shape. A vague one says nothing about cubes that can be split, which is allowed and
 * gives splitting and merging more to do. */
struct cells {
    int low[3], high[3];
    bool vague;
};

/* Cells from first to last along each axis: are all of them in the box, is none? */
static void compare(const struct cells *cells, const int first[3], int side, bool *inside, bool *outside)
{
    *inside = true;
    *outside = false;
    for (int k = 0; k < 3; k++) {
        int last = first[k] + side - 1;
        *inside = *inside && first[k] >= cells->low[k] && last <= cells->high[k];
        *outside = *outside || last < cells->low[k] || first[k] > cells->high[k];
    }
}

static struct octree_cover cells_cover(const void *shape, const double corner[3], double side, bool cells)
{
    struct octree_cover cover = {0};
    for (int i = 0; i < 8; i++) {
        const struct cells *box = shape;
        int first[3];
        bool inside, outside;
        for (int k = 0; k < 3; k++)
            first[k] = (int)lround((corner[k] + (i >> k & 1) * side) * SIDE);
        compare(box, first, (int)lround(side * SIDE), &inside, &outside);
        cover.inside |= (unsigned)(inside && (cells || !box->vague)) << i;
        cover.outside |= (unsigned)(outside && !box->vague) << i;
    }
    return cover;
}

static struct cells random_cells(uint64_t *seed)
{
    struct cells cells = {.vague = random_bits(seed) % 2};
    for (int k = 0; k < 3; k++) {
        int a = (int)(random_bits(seed) % SIDE), b = (int)(random_bits(seed) % SIDE);
        cells.low[k] = a < b ? a : b;
        cells.high[k] = a < b ? b : a;
    }
    return cells;
}

static void set_grid(struct grid *grid, const struct cells *cells, unsigned material)
{
    for (int z = cells->low[2]; z <= cells->high[2]; z++)
        for (int y = cells->low[1]; y <= cells->high[1]; y++)
            for (int x = cells->low[0]; x <= cells->high[0]; x++)
                grid->cell[z][y][x] = (unsigned char)material;
}

static void assert_same_cells(const struct octree *tree, const struct grid *grid)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                if (octree_at(tree, x, y, z) != grid->cell[z][y][x])
                    fail_msg("cell %d %d %d is %u, must be %u", x, y, z, octree_at(tree, x, y, z),
                             grid->cell[z][y][x]);
}

/* Leaves at and below a node; fails where eight equal ones were not merged. */
static size_t count_leaves(const struct octree *tree, octree_node node)
{
    if (!node_is_split(node))
        return 1;
    const octree_node *child = tree->blocks + node_children(node);
    size_t leaves = 0;
    bool equal = !node_is_split(child[0]);
    for (int i = 0; i < 8; i++) {
        leaves += count_leaves(tree, child[i]);
        equal = equal && child[i] == child[0];
    }
    assert_false(equal);
    return leaves;
}

/* Merged throughout, and every block is in the tree or on the free list. */
static void assert_sound(const struct octree *tree)
{
    assert_int_equal(count_leaves(tree, tree->root), octree_leaf_count(tree));
    uint32_t block = tree->free_block;
    for (uint32_t i = 0; i < tree->free_count; i++) {
        assert_true(block < tree->block_count);
        block = tree->blocks[8 * (size_t)block];
    }
}

static struct octree new_tree(unsigned material)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, DEPTH, material, &err), &err);
    return tree;
}

/* A tree and its grid after some random boxes of 0, 1, 2 or 3. */
static struct octree random_tree(uint64_t seed, int boxes, struct grid *grid)
{
    struct error err = {0};
    struct octree tree = new_tree(0);
    memset(grid, 0, sizeof *grid);
    for (int i = 0; i < boxes; i++) {
        struct cells cells = random_cells(&seed);
        unsigned material = (unsigned)(random_bits(&seed) % 4);
        assert_ok(octree_apply(&tree, cells_cover, &cells, material, &err), &err);
        set_grid(grid, &cells, material);
    }
    return tree;
}

static void a_new_cube_is_one_leaf(void **state)
{
    (void)state;
    struct octree tree = new_tree(1);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.leaves, 1);
    assert_int_equal(info.nodes, 1);
    assert_int_equal(info.cells, CELLS);
    assert_int_equal(info.exposed_faces, 6 * SIDE * SIDE);
    assert_int_equal(info.smallest_side, SIDE);
    assert_int_equal(octree_at(&tree, SIDE - 1, 0, 0), 1);
    assert_int_equal(octree_at(&tree, SIDE, 0, 0), 0);
    assert_int_equal(octree_at(&tree, 0, -1, 0), 0);
    octree_clear(&tree);
}

static void depths_and_materials_out_of_range_are_refused(void **state)
{
    (void)state;
    struct octree tree = {0};
    struct error err = {0};
    assert_refused(octree_init(&tree, 11, 1, &err), STATUS_RANGE, "depth 11: must be from 0 to 10", &err);
    assert_refused(octree_init(&tree, 3, 256, &err), STATUS_RANGE, "material 256", &err);
}

static void random_boxes_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    uint64_t seed = 1;
    struct grid grid = {0};
    struct error err = {0};
    struct octree tree = new_tree(0);
    for (int i = 0; i < 2000; i++) {
        struct cells cells = random_cells(&seed);
        unsigned material = (unsigned)(random_bits(&seed) % 3);
        assert_ok(octree_apply(&tree, cells_cover, &cells, material, &err), &err);
        set_grid(&grid, &cells, material);
        if (i % 20 == 0) {
            assert_same_cells(&tree, &grid);
            assert_sound(&tree);
        }
    }
    octree_clear(&tree);
}

static void random_single_cells_give_the_cells_of_a_dense_grid(void **state)
{
    (void)state;
    uint64_t seed = 2;
    struct error err = {0};
    struct grid grid = {0};
    struct octree tree = new_tree(0);
    for (int i = 0; i < 40000; i++) {
        uint64_t bits = random_bits(&seed);
        int x = (int)(bits % 8), y = (int)(bits / 8 % 8), z = (int)(bits / 64 % 8);
        unsigned material = (unsigned)(bits / 512 % 2);
        assert_ok(octree_set(&tree, x, y, z, material, &err), &err);
        grid.cell[z][y][x] = (unsigned char)material;
        if (i % 1000 == 0) {
            assert_same_cells(&tree, &grid);
            assert_sound(&tree);
        }
    }
    octree_clear(&tree);
}

static void a_sculpture_carved_away_leaves_every_block_free(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree tree = random_tree(3, 50, &grid);
    const struct cells all = {{0, 0, 0}, {SIDE, SIDE, SIDE}, false};
    assert_true(tree.block_count > 1);
    assert_ok(octree_apply(&tree, cells_cover, &all, 0, &err), &err);
    assert_int_equal(tree.root, 0);
    assert_int_equal(tree.free_count, tree.block_count);
    assert_sound(&tree);
    octree_clear(&tree);
}

static void the_order_of_work_does_not_show(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree carved = random_tree(4, 50, &grid), built = new_tree(0);
    for (int x = SIDE - 1; x >= 0; x--)
        for (int y = 0; y < SIDE; y++)
            for (int z = 0; z < SIDE; z++)
                assert_ok(octree_set(&built, x, y, z, grid.cell[z][y][x], &err), &err);
    assert_true(octree_equal(&carved, &built));
    assert_ok(octree_set(&built, 5, 6, 7, 9, &err), &err);
    assert_false(octree_equal(&carved, &built));
    octree_clear(&carved);
    octree_clear(&built);
}

static void a_copy_goes_its_own_way(void **state)
{
    (void)state;
    struct grid grid;
    struct error err = {0};
    struct octree tree = random_tree(5, 30, &grid), copy = new_tree(2);
    assert_ok(octree_copy(&copy, &tree, &err), &err);
    assert_true(octree_equal(&tree, &copy));
    assert_ok(octree_set(&copy, 1, 1, 1, 9, &err), &err);
    assert_same_cells(&tree, &grid);
    assert_sound(&copy);
    octree_clear(&tree);
    octree_clear(&copy);
}

static void coefficients_count_only_where_the_material_is_in_use(void **state)
{
    (void)state;
    struct octree a = new_tree(1), b = new_tree(1);
    b.coefficient[2] = 5;
    assert_true(octree_equal(&a, &b));
    b.coefficient[1] = 5;
    assert_false(octree_equal(&a, &b));
}

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
    struct octree tree = new_tree(1);
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
        struct octree tree = new_tree(material);
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
    struct octree tree = new_tree(0);
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
        cmocka_unit_test(a_new_cube_is_one_leaf),
        cmocka_unit_test(depths_and_materials_out_of_range_are_refused),
        cmocka_unit_test(random_boxes_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(random_single_cells_give_the_cells_of_a_dense_grid),
        cmocka_unit_test(a_sculpture_carved_away_leaves_every_block_free),
        cmocka_unit_test(the_order_of_work_does_not_show),
        cmocka_unit_test(a_copy_goes_its_own_way),
        cmocka_unit_test(coefficients_count_only_where_the_material_is_in_use),
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
