/* Faces lit as parts of the smooth surface that the cells approximate. */
#include "check.h"
#include "sculpt/normals.h"
#include "sculpt/sculpt.h"

#include <math.h>

static struct error err;

static void make(const char *script, struct octree *tree)
{
    struct chips chips = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_begin(&chips, 0, tree, &err), &err);
    assert_ok(chips_run(tree, &chips, &err), &err);
    chips_clear(&chips);
}

static void flat_faces_and_thin_walls_look_along_their_axis(void **state)
{
    (void)state;
    struct octree tree = {0};
    struct brick_normals normals;
    int8_t normal[3];
    make("depth 5\nchip half-space 0.5 0.5 0.5 0 1 0\nfill box 0 0.8125 0 1 0.84375 1\n", &tree);
    brick_normals_begin(&normals, &tree, (int[3]){0, 0, 0});
    const struct {
        int y, side, up;
    } faces[] = {
        {15, 3, 100}, {26, 3, 100}, {26, 2, -100}}; /* the floor, and both sides of a wall of one cell */
    for (int i = 0; i < 3; i++) {
        brick_normal(&normals, (int[3]){16, faces[i].y, 16}, faces[i].side, normal);
        assert_int_equal(normal[0], 0);
        assert_int_equal(normal[1], faces[i].up);
        assert_int_equal(normal[2], 0);
    }
    octree_clear(&tree);
}

struct ball {
    struct brick_normals normals;
    double worst, sum; /* degrees */
    int count;
};

static void measure(struct ball *ball, const int cell[3], int side)
{
    int8_t normal[3];
    double along = 0, length = 0, radius = 0;
    brick_normal(&ball->normals, cell, side, normal);
    for (int i = 0; i < 3; i++) {
        const double out = cell[i] + 0.5 - 16;
        along += out * normal[i];
        length += (double)normal[i] * normal[i];
        radius += out * out;
    }
    const double angle = acos(fmin(along / sqrt(length * radius), 1)) * 180 / M_PI;
    ball->worst = fmax(ball->worst, angle);
    ball->sum += angle;
    ball->count++;
}

/* The Gaussian has a deviation of 1.5 cells and a cell is in or out: a third of a cell at a lever of two,
 * some ten degrees at worst; a face's own direction would be wrong by up to 55 degrees. */
static void a_ball_of_cells_is_lit_as_a_ball(void **state)
{
    (void)state;
    struct octree tree = {0};
    struct ball ball = {.worst = 0};
    make("depth 5\nstart empty\nfill sphere 0.5 0.5 0.5 0.375\n", &tree);
    brick_normals_begin(&ball.normals, &tree, (int[3]){0, 0, 0});
    int cell[3];
    for (cell[0] = 0; cell[0] < 32; cell[0]++)
        for (cell[1] = 0; cell[1] < 32; cell[1]++)
            for (cell[2] = 0; cell[2] < 32; cell[2]++)
                for (int side = 0; side < 6; side++) {
                    int beside[3] = {cell[0], cell[1], cell[2]};
                    beside[side / 2] += side & 1 ? 1 : -1;
                    if (octree_at(&tree, cell[0], cell[1], cell[2]) &&
                        !octree_at(&tree, beside[0], beside[1], beside[2]))
                        measure(&ball, cell, side);
                }
    assert_true(ball.count > 1000);
    assert_true(ball.worst < 12);
    assert_true(ball.sum / ball.count < 5);
    octree_clear(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_faces_and_thin_walls_look_along_their_axis),
        cmocka_unit_test(a_ball_of_cells_is_lit_as_a_ball),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
