/* Rays against a march from cell to cell. */
#include "check.h"
#include "common/octree.h"
#include "common/random.h"

struct ray {
    double origin[3], direction[3];
};

static struct octree new_tree(unsigned depth, unsigned material)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

/* Cells here and there, and some boxes of cells, so that leaves are of all sizes. */
static struct octree random_tree(unsigned depth, uint64_t *seed)
{
    struct error err = {0};
    struct octree tree = new_tree(depth, 0);
    const unsigned side = 1u << depth;
    for (int i = 0; i < 12; i++) {
        unsigned edge = 1u << random_bits(seed) % (depth + 1), start[3];
        if (edge > side / 4 && side > 4)
            edge = 1;
        for (int k = 0; k < 3; k++)
            start[k] = (unsigned)(random_bits(seed) % side) / edge * edge;
        unsigned material = (unsigned)(random_bits(seed) % 3);
        for (unsigned x = 0; x < edge; x++)
            for (unsigned y = 0; y < edge; y++)
                for (unsigned z = 0; z < edge; z++)
                    assert_ok(octree_set(&tree, (int)(start[0] + x), (int)(start[1] + y), (int)(start[2] + z),
                                         material, &err),
                              &err);
    }
    return tree;
}

/* The definition, one plane at a time, from wherever the ray begins; the planes' times as octree_ray() has
 * them, so that both agree on what comes first to the bit. */
static bool march(const struct octree *tree, const struct ray *ray, struct octree_hit *hit)
{
    const int side = 1 << tree->depth;
    double origin[3], inverse[3], largest = 0;
    int cell[3];
    bool down[3];
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fabs(ray->direction[k]));
    for (int k = 0; k < 3; k++) {
        origin[k] = ray->origin[k] * side;
        inverse[k] = 1 / (ray->direction[k] / largest);
        down[k] = isfinite(inverse[k]) && inverse[k] < 0;
        cell[k] = down[k] ? (int)ceil(origin[k]) - 1 : (int)floor(origin[k]);
    }
    *hit = (struct octree_hit){0};
    while (octree_at(tree, cell[0], cell[1], cell[2]) == 0) {
        int axis = -1;
        double time = HUGE_VAL;
        for (int k = 0; k < 3; k++) {
            if ((down[k] && cell[k] < 0) || (!down[k] && cell[k] >= side))
                return false;
            double next = ((down[k] ? cell[k] : cell[k] + 1) - origin[k]) * inverse[k];
            if (isfinite(inverse[k]) && next < time) {
                time = next;
                axis = k;
            }
            if (!isfinite(inverse[k]) && cell[k] < 0)
                return false;
        }
        cell[axis] += down[axis] ? -1 : 1;
        hit->axis = axis;
        hit->outward = down[axis] ? 1 : -1;
        hit->distance = time / side / largest;
    }
    for (int k = 0; k < 3; k++)
        hit->cell[k] = cell[k];
    hit->material = octree_at(tree, cell[0], cell[1], cell[2]);
    return true;
}

static bool shoot(const struct octree *tree, const struct ray *ray, struct octree_hit *hit)
{
    return octree_ray(tree, ray->origin, ray->direction, hit);
}

static void assert_same_hit(const struct octree *tree, const struct ray *ray)
{
    struct octree_hit hit = {0}, expected;
    bool found = shoot(tree, ray, &hit), wanted = march(tree, ray, &expected);
    bool same = found == wanted;
    if (same && found)
        same = hit.axis == expected.axis && hit.outward == expected.outward &&
               hit.distance == expected.distance && hit.material == expected.material &&
               memcmp(hit.cell, expected.cell, sizeof hit.cell) == 0;
    if (!same)
        fail_msg("depth %u, ray from %.17g %.17g %.17g towards %.17g %.17g %.17g: %d at %d %d %d by %d, "
                 "must be %d at %d %d %d by %d",
                 tree->depth, ray->origin[0], ray->origin[1], ray->origin[2], ray->direction[0],
                 ray->direction[1], ray->direction[2], found, hit.cell[0], hit.cell[1], hit.cell[2], hit.axis,
                 wanted, expected.cell[0], expected.cell[1], expected.cell[2], expected.axis);
}

/* From within and around the cube, some on planes between cells, some along them, some through edges. */
static struct ray random_ray(unsigned depth, uint64_t *seed)
{
    struct ray ray;
    const double side = 1 << depth;
    uint64_t bits = random_bits(seed);
    for (int k = 0; k < 3; k++, bits >>= 8) {
        ray.origin[k] = 2 * random_unit(seed) - 0.5;
        ray.direction[k] = 2 * random_unit(seed) - 1;
        if (bits % 4 == 0)
            ray.origin[k] = round(ray.origin[k] * side) / side;
        if (bits / 4 % 4 == 0)
            ray.direction[k] = bits / 16 % 2 ? 1 : -1;
        if (bits / 4 % 4 == 1)
            ray.direction[k] = bits / 16 % 2 ? 0.0 : -0.0;
        if (bits / 32 % 8 == 0)
            ray.direction[k] *= 1e-300;
    }
    if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0)
        ray.direction[bits % 3] = -0.3;
    return ray;
}

static void random_rays_hit_what_a_march_from_cell_to_cell_does(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 120; i++) {
        struct octree tree = random_tree((unsigned)i % 6, &seed);
        for (int r = 0; r < 1000; r++) {
            const struct ray ray = random_ray(tree.depth, &seed);
            assert_same_hit(&tree, &ray);
        }
        octree_clear(&tree);
    }
}

/* Whatever is met, edges and corners too, a fill in front of the face has a place to go. */
static void the_face_entered_borders_on_an_empty_cell(void **state)
{
    (void)state;
    uint64_t seed = 2;
    struct octree tree = random_tree(3, &seed);
    int hits = 0;
    for (int r = 0; r < 20000; r++) {
        const struct ray ray = random_ray(tree.depth, &seed);
        struct octree_hit hit;
        if (!shoot(&tree, &ray, &hit) || hit.outward == 0)
            continue;
        hits++;
        hit.cell[hit.axis] += hit.outward;
        assert_int_equal(octree_at(&tree, hit.cell[0], hit.cell[1], hit.cell[2]), 0);
    }
    assert_true(hits > 1000);
    octree_clear(&tree);
}

static void a_ray_from_the_viewer_meets_the_front_face(void **state)
{
    (void)state;
    struct octree tree = new_tree(8, 5);
    const struct ray ray = {{0.25, 0.5, 3}, {0, 0, -2}};
    struct octree_hit hit;
    assert_true(shoot(&tree, &ray, &hit));
    assert_int_equal(hit.cell[0], 64);
    assert_int_equal(hit.cell[1], 128);
    assert_int_equal(hit.cell[2], 255);
    assert_int_equal(hit.axis, 2);
    assert_int_equal(hit.outward, 1);
    assert_int_equal(hit.material, 5);
    assert_near(hit.distance, 1, 0);
}

static void a_ray_that_begins_in_material_ends_there(void **state)
{
    (void)state;
    struct octree tree = new_tree(4, 1);
    const struct ray ray = {{0.5, 0.99, 0}, {0, 1, 1}};
    struct octree_hit hit;
    assert_true(shoot(&tree, &ray, &hit));
    assert_int_equal(hit.cell[0], 8);
    assert_int_equal(hit.cell[1], 15);
    assert_int_equal(hit.cell[2], 0);
    assert_int_equal(hit.outward, 0);
    assert_near(hit.distance, 0, 0);
}

static void rays_along_the_cubes_faces_graze_inside_below_and_outside_above(void **state)
{
    (void)state;
    struct octree tree = new_tree(4, 1);
    const struct ray below = {{0, 0, -1}, {0, 0, 1}}, above = {{1, 1, -1}, {0, 0, 1}};
    struct octree_hit hit;
    assert_true(shoot(&tree, &below, &hit));
    assert_int_equal(hit.cell[0], 0);
    assert_false(shoot(&tree, &above, &hit));
}

static void what_is_no_ray_or_misses_hits_nothing(void **state)
{
    (void)state;
    struct octree full = new_tree(10, 1), empty = new_tree(10, 0);
    const struct ray none[] = {
        {{0.5, 0.5, 0.5}, {0, 0, 0}},        {{NAN, 0.5, 0.5}, {1, 0, 0}},
        {{0.5, 0.5, 0.5}, {1, INFINITY, 0}}, {{0.5, 0.5, 0.5}, {1, 0, NAN}},
        {{2, 0.5, 0.5}, {1, 0, 0}},          {{2, 0.5, 0.5}, {0, 1, 0}},
        {{-1, -1, 0.5}, {1, 3, 0}},          {{1e308, 1e308, 1e308}, {-1, -1, -1}},
        {{0.5, 0.5, 1e307}, {0, 0, -1}},     {{-1e300, 0.5, 0.5}, {1, 1e-3, 0}},
    };
    const struct ray far = {{0.5, 0.5, 1e300}, {0, 0, -1e-300}};
    struct octree_hit hit;
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_false(shoot(&full, &none[i], &hit));
    assert_true(shoot(&full, &far, &hit));
    assert_int_equal(hit.cell[2], 1023);
    assert_false(shoot(&empty, &far, &hit));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rays_hit_what_a_march_from_cell_to_cell_does),
        cmocka_unit_test(the_face_entered_borders_on_an_empty_cell),
        cmocka_unit_test(a_ray_from_the_viewer_meets_the_front_face),
        cmocka_unit_test(a_ray_that_begins_in_material_ends_there),
        cmocka_unit_test(rays_along_the_cubes_faces_graze_inside_below_and_outside_above),
        cmocka_unit_test(what_is_no_ray_or_misses_hits_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
