#include "common/octree_tape.h"

#include "common/array.h"
#include "common/octree_blocks.h"

static struct octree_head head_of(const struct octree *tree)
{
    return (struct octree_head){tree->root, tree->block_count, tree->free_block, tree->free_count};
}

static void set_head(struct octree *tree, const struct octree_head *head)
{
    tree->root = head->root;
    tree->block_count = head->block_count;
    tree->free_block = head->free_block;
    tree->free_count = head->free_count;
}

void octree_tape_begin(struct octree_tape *tape, struct octree *tree)
{
    tape->count = 0;
    tape->lost = false;
    tape->regions.count = 0;
    tape->before = tape->after = head_of(tree);
    tree->tape = tape;
}

void octree_tape_end(struct octree_tape *tape, struct octree *tree)
{
    tape->after = head_of(tree);
    tree->tape = NULL;
}

bool octree_tape_grow(struct octree_tape *tape)
{
    if (tape->lost || tape->count >= tape->limit || !ARRAY_RESERVE(tape, 1)) {
        tape->lost = true;
        return false;
    }
    if (tape->capacity > tape->limit)
        tape->capacity = tape->limit;
    return true;
}

void octree_tape_region(struct octree_tape *tape, const int corner[3], int side)
{
    struct octree_region region;
    for (int k = 0; k < 3; k++) {
        region.low[k] = corner[k];
        region.high[k] = corner[k] + side - 1;
    }
    octree_regions_add(&tape->regions, &region);
}

/* What is there changes places with what is on the tape. */
static void exchange(struct octree *tree, struct octree_write *write)
{
    octree_node *node = tree->blocks + write->at, now = *node;
    *node = write->node;
    write->node = now;
}

void octree_undo(struct octree *tree, struct octree_write *writes, size_t count,
                 const struct octree_head *before)
{
    while (count-- > 0)
        exchange(tree, &writes[count]);
    set_head(tree, before);
}

void octree_redo(struct octree *tree, struct octree_write *writes, size_t count,
                 const struct octree_head *after)
{
    for (size_t i = 0; i < count; i++)
        exchange(tree, &writes[i]);
    set_head(tree, after);
}

static struct octree_region around(const struct octree_region *a, const struct octree_region *b)
{
    struct octree_region both = *a;
    for (int k = 0; k < 3; k++) {
        if (b->low[k] < both.low[k])
            both.low[k] = b->low[k];
        if (b->high[k] > both.high[k])
            both.high[k] = b->high[k];
    }
    return both;
}

static int64_t cells_of(const struct octree_region *region)
{
    int64_t cells = 1;
    for (int k = 0; k < 3; k++)
        cells *= region->high[k] - region->low[k] + 1;
    return cells;
}

void octree_regions_add(struct octree_regions *regions, const struct octree_region *region)
{
    int nearest = -1;
    int64_t least = INT64_MAX; /* cells that belong to neither, were the two made one */
    for (int i = 0; i < regions->count; i++) {
        struct octree_region both = around(&regions->items[i], region);
        int64_t waste = cells_of(&both) - cells_of(&regions->items[i]) - cells_of(region);
        if (waste < least) {
            least = waste;
            nearest = i;
        }
    }
    if (least > 0 && regions->count < OCTREE_REGIONS_MAX)
        regions->items[regions->count++] = *region;
    else
        regions->items[nearest] = around(&regions->items[nearest], region);
}
