/* Octrees for tests: made, chipped at random, looked at to the byte. */
#ifndef TESTS_UNIT_TREES_H
#define TESTS_UNIT_TREES_H

#include "check.h"
#include "common/hash.h"
#include "common/octree_blocks.h"
#include "common/random.h"
#include "sculpt/sculpt.h"

static inline struct octree new_tree(unsigned depth, unsigned material)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

/* Every byte that an octree is made of. */
static inline uint64_t fingerprint(const struct octree *tree)
{
    const uint32_t head[] = {tree->root, tree->block_count, tree->free_count,
                             tree->free_count ? tree->free_block : 0};
    uint64_t hash = hash_bytes(HASH_START, head, sizeof head);
    return tree->block_count ? hash_bytes(hash, tree->blocks, 32 * (size_t)tree->block_count) : hash;
}

/* Blocks in the tree; fails where eight equal leaves were not merged. */
static inline size_t count_blocks(const struct octree *tree, octree_node node)
{
    if (!node_is_split(node))
        return 0;
    const octree_node *child = tree->blocks + node_children(node);
    size_t blocks = 1;
    bool equal = !node_is_split(child[0]);
    for (int i = 0; i < 8; i++) {
        blocks += count_blocks(tree, child[i]);
        equal = equal && child[i] == child[0];
    }
    assert_false(equal);
    return blocks;
}

/* Equal leaves are merged, and every block is in the tree or on the free list. */
static inline void assert_sound(const struct octree *tree)
{
    assert_int_equal(count_blocks(tree, tree->root), tree->block_count - tree->free_count);
    uint32_t block = tree->free_block;
    for (uint32_t i = 0; i < tree->free_count; i++) {
        assert_true(block < tree->block_count);
        block = tree->blocks[8 * (size_t)block];
    }
}

/* An operation about as large as `size`: a ball, a box, sandpaper or heat, mirrored or
 * not, of material 0 to 2. */
static inline struct chip random_operation(double size, uint64_t *seed)
{
    static const enum chip_kind kinds[8] = {CHIP_CARVE, CHIP_CARVE, CHIP_CARVE,     CHIP_CARVE,
                                            CHIP_CARVE, CHIP_CARVE, CHIP_SANDPAPER, CHIP_HEAT};
    uint64_t bits = random_bits(seed);
    struct chip chip = {.kind = kinds[bits % 8], .material = (unsigned)(bits >> 8) % 3};
    chip.shape = bits >> 16 & 1 ? CHIP_SPHERE : CHIP_BOX;
    chip.mirror = bits >> 24 & 1 ? (unsigned)(bits >> 32) % 8 : 0;
    for (int k = 0; k < 3; k++) {
        chip.value[k] = 1.2 * random_unit(seed) - 0.1;
        chip.value[k + 3] = chip.value[k] + size * (0.1 + random_unit(seed));
    }
    if (chip.shape == CHIP_SPHERE || chip.kind != CHIP_CARVE)
        chip.value[3] = size * (0.1 + random_unit(seed));
    return chip;
}

/* A full cube after that many of them. */
static inline struct octree random_sculpture(unsigned depth, int operations, uint64_t seed)
{
    struct octree tree = new_tree(depth, 1);
    struct error err = {0};
    for (int i = 0; i < operations; i++) {
        const struct chip chip = random_operation(0.4, &seed);
        assert_ok(sculpt_chip(&tree, &chip, &err), &err);
    }
    return tree;
}

#endif
