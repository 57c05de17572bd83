/* The faces that a window draws: each exposed face of a cell once, in rectangles. */
#include "sculpt/bricks.h"
#include "trees.h"

enum { SIDE_MAX = 64 };

/* Faces of cells that a rectangle told of, by the cell that has them. */
static unsigned char met[SIDE_MAX][SIDE_MAX][SIDE_MAX][6];

static void meet_face(const struct octree *tree, const struct brick_face *face)
{
    const int axis = face->side / 2;
    assert_true(face->size[0] > 0 && face->size[1] > 0);
    for (int i = 0; i < face->size[0]; i++)
        for (int j = 0; j < face->size[1]; j++) {
            int cell[3] = {face->corner[0], face->corner[1], face->corner[2]};
            cell[(axis + 1) % 3] += i;
            cell[(axis + 2) % 3] += j;
            cell[axis] -= face->side & 1;
            assert_int_equal(octree_at(tree, cell[0], cell[1], cell[2]), face->material);
            met[cell[2]][cell[1]][cell[0]][face->side]++;
        }
}

static size_t meet_all(const struct octree *tree)
{
    struct error err = {0};
    struct brick_faces faces = {0};
    size_t count = 0;
    const int along = bricks_along(tree);
    memset(met, 0, sizeof met);
    for (int i = 0; i < along * along * along; i++) {
        const int brick[3] = {i % along, i / along % along, i / along / along};
        assert_ok(brick_find_faces(tree, brick, &faces, &err), &err);
        count += faces.count;
        for (size_t k = 0; k < faces.count; k++)
            meet_face(tree, &faces.items[k]);
    }
    free(faces.items);
    return count;
}

static void check(const struct octree *tree)
{
    const int side = 1 << tree->depth;
    meet_all(tree);
    for (int z = 0; z < side; z++)
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++)
                for (int s = 0; s < 6; s++) {
                    int beside[3] = {x, y, z};
                    beside[s / 2] += s & 1 ? 1 : -1;
                    const bool exposed = octree_at(tree, x, y, z) &&
                                         !octree_at(tree, beside[0], beside[1], beside[2]);
                    if (met[z][y][x][s] != exposed)
                        fail_msg("side %d of cell %d %d %d: met %d times", s, x, y, z, met[z][y][x][s]);
                }
}

static void every_exposed_face_is_in_one_rectangle_of_its_material(void **state)
{
    (void)state;
    for (unsigned depth = 0; depth <= 6; depth++) {
        struct octree tree = random_sculpture(depth, 12, depth + 1);
        check(&tree);
        octree_clear(&tree);
    }
}

/* Two bricks along each axis: four rectangles a side of the cube, of one material; twice as many where two
 * meet in the middle of each brick. */
static void a_flat_side_is_one_rectangle_a_brick_and_material(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = new_tree(6, 1);
    assert_int_equal(meet_all(&tree), 6 * 4);
    for (int k = 0; k < 2; k++) {
        const struct chip slab = {
            .material = 2, .shape = CHIP_BOX, .value = {0.25 + 0.5 * k, 0, 0, 0.5 + 0.5 * k, 1, 1}};
        assert_ok(sculpt_chip(&tree, &slab, &err), &err);
    }
    assert_int_equal(meet_all(&tree), 2 * 4 + 4 * 8);
    octree_clear(&tree);
}

static void an_empty_brick_has_no_faces(void **state)
{
    (void)state;
    struct octree tree = new_tree(6, 0);
    assert_int_equal(meet_all(&tree), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_exposed_face_is_in_one_rectangle_of_its_material),
        cmocka_unit_test(a_flat_side_is_one_rectangle_a_brick_and_material),
        cmocka_unit_test(an_empty_brick_has_no_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
