/* Fields for tests: around full cubes and cells at random, asked through a probe. */
#ifndef TESTS_UNIT_FIELDS_H
#define TESTS_UNIT_FIELDS_H

#include "check.h"
#include "common/random.h"
#include "surface/probe.h"

static const struct field_settings exact = {FIELDS_EXACT, 0, 0.35, 6};

static inline struct octree full_cube(unsigned depth)
{
    struct error err = {0};
    struct octree tree;
    assert_ok(octree_init(&tree, depth, 1, &err), &err);
    return tree;
}

/* Each cell is material 1 or 2 with this probability. */
static inline struct octree random_cells(unsigned depth, double share, uint64_t seed)
{
    struct error err = {0};
    struct octree tree;
    assert_ok(octree_init(&tree, depth, 0, &err), &err);
    for (int i = 0; i < 1 << 3 * depth; i++) {
        int mask = (1 << depth) - 1, x = i & mask, y = i >> depth & mask, z = i >> 2 * depth;
        unsigned material = random_unit(&seed) < share ? 1 + (unsigned)(random_unit(&seed) * 2) : 0;
        assert_ok(octree_set(&tree, x, y, z, material, &err), &err);
    }
    return tree;
}

static inline void open_field(struct field *field, struct probe *probe, const struct octree *tree,
                              struct field_settings settings)
{
    struct error err = {0};
    assert_ok(field_init(field, tree, &settings, &err), &err);
    assert_ok(probe_init(probe, field, &err), &err);
}

#endif
