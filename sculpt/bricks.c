#include "sculpt/bricks.h"

#include "common/array.h"
#include "sculpt/rows.h"

/* A brick's cells and one more to each side, a bit a cell: bit x + 1 of row [z + 1][y + 1]. */
enum { ROWS = BRICK_SIDE + 2 };

struct brick_cells {
    const struct octree *tree;
    int first[3]; /* cell of bit 0, row 0 */
    uint64_t row[ROWS][ROWS];
    bool mixed; /* of more than one material */
    unsigned material;
};

int bricks_along(const struct octree *tree)
{
    return ((1 << tree->depth) + BRICK_SIDE - 1) / BRICK_SIDE;
}

static bool mark_leaf(void *context, const struct octree_leaf *leaf)
{
    struct brick_cells *cells = context;
    rows_mark(&cells->row[0][0], ROWS, cells->first, leaf);
    cells->mixed |= cells->material && cells->material != leaf->material;
    cells->material = leaf->material;
    return true;
}

static void mark_cells(struct brick_cells *cells, const struct octree *tree, const int brick[3])
{
    *cells = (struct brick_cells){.tree = tree};
    int last[3];
    for (int i = 0; i < 3; i++) {
        cells->first[i] = brick[i] * BRICK_SIDE - 1;
        last[i] = cells->first[i] + ROWS - 1;
    }
    octree_visit(tree, cells->first, last, mark_leaf, cells);
}

/* The exposed cells of a brick on one side, layer by layer along the side's axis: a bit a cell of a row. Rows
 * of bits are along x, but along y where the side looks along x; the rows follow each other along z, but
 * along y where it looks along z. */
struct brick_layers {
    int side, along, across; /* the axes of bits and of rows */
    uint32_t row[BRICK_SIDE][BRICK_SIDE];
    uint32_t used; /* layers that have any */
};

static void add_to_layer(struct brick_layers *layers, int layer, int row, uint32_t bits)
{
    layers->row[layer][row] |= bits;
    layers->used |= (uint32_t)1 << layer;
}

static void find_layers(struct brick_layers *layers, const struct brick_cells *cells, int side)
{
    *layers = (struct brick_layers){.side = side, .along = side / 2 == 0, .across = side / 2 == 2 ? 1 : 2};
    const int way = side & 1 ? 1 : -1;
    for (int z = 0; z < BRICK_SIDE; z++)
        for (int y = 0; y < BRICK_SIDE; y++) {
            const uint64_t row = cells->row[z + 1][y + 1];
            const uint64_t beside = side / 2 == 0   ? (side & 1 ? row >> 1 : row << 1)
                                    : side / 2 == 1 ? cells->row[z + 1][y + 1 + way]
                                                    : cells->row[z + 1 + way][y + 1];
            uint32_t exposed = (uint32_t)((row & ~beside) >> 1); /* the borders belong to other bricks */
            if (exposed && side / 2 > 0)
                add_to_layer(layers, side / 2 == 1 ? y : z, side / 2 == 1 ? z : y, exposed);
            for (; exposed && side / 2 == 0; exposed &= exposed - 1)
                add_to_layer(layers, __builtin_ctz(exposed), z, (uint32_t)1 << y);
        }
}

/* The material of the cell of a layer. */
static unsigned material_at(const struct brick_cells *cells, const struct brick_layers *layers, int layer,
                            int row, int bit)
{
    if (!cells->mixed)
        return cells->material;
    int cell[3];
    cell[layers->side / 2] = layer;
    cell[layers->along] = bit;
    cell[layers->across] = row;
    for (int i = 0; i < 3; i++)
        cell[i] += cells->first[i] + 1;
    return octree_at(cells->tree, cell[0], cell[1], cell[2]);
}

/* How many of the cells of a row from `bit` on belong together. */
static int run_length(const struct brick_cells *cells, const struct brick_layers *layers, int layer, int row,
                      int bit, unsigned material)
{
    const uint32_t bits = layers->row[layer][row] >> bit;
    const int most = ~bits ? __builtin_ctz(~bits) : BRICK_SIDE;
    int length = 1;
    while (length < most && material_at(cells, layers, layer, row, bit + length) == material)
        length++;
    return length;
}

/* Takes the rectangle that begins with the first cell of a row: as long as it can be, then as high. */
static struct brick_face take_rectangle(const struct brick_cells *cells, struct brick_layers *layers,
                                        int layer, int row)
{
    const int bit = __builtin_ctz(layers->row[layer][row]), axis = layers->side / 2;
    const unsigned material = material_at(cells, layers, layer, row, bit);
    const int length = run_length(cells, layers, layer, row, bit, material);
    const uint32_t mask = (uint32_t)(((uint64_t)1 << length) - 1) << bit;
    int height = 0;
    do
        layers->row[layer][row + height++] &= ~mask;
    while (row + height < BRICK_SIDE && (layers->row[layer][row + height] & mask) == mask &&
           material_at(cells, layers, layer, row + height, bit) == material &&
           run_length(cells, layers, layer, row + height, bit, material) >= length);
    struct brick_face face = {.side = (uint8_t)layers->side, .material = (uint8_t)material};
    int corner[3];
    corner[axis] = layer + (layers->side & 1);
    corner[layers->along] = bit;
    corner[layers->across] = row;
    for (int i = 0; i < 3; i++)
        face.corner[i] = (uint16_t)(cells->first[i] + 1 + corner[i]);
    face.size[layers->along != (axis + 1) % 3] = (uint8_t)length;
    face.size[layers->along == (axis + 1) % 3] = (uint8_t)height;
    return face;
}

static bool add_layer(struct brick_faces *faces, const struct brick_cells *cells, struct brick_layers *layers,
                      int layer)
{
    for (int row = 0; row < BRICK_SIDE; row++)
        while (layers->row[layer][row]) {
            if (!ARRAY_RESERVE(faces, 1))
                return false;
            faces->items[faces->count++] = take_rectangle(cells, layers, layer, row);
        }
    return true;
}

enum status brick_find_faces(const struct octree *tree, const int brick[3], struct brick_faces *faces,
                             struct error *err)
{
    struct brick_cells cells;
    struct brick_layers layers;
    mark_cells(&cells, tree, brick);
    faces->count = 0;
    for (int side = 0; side < 6 && cells.material; side++) {
        find_layers(&layers, &cells, side);
        for (; layers.used; layers.used &= layers.used - 1)
            if (!add_layer(faces, &cells, &layers, __builtin_ctz(layers.used)))
                return error_no_memory(err, "the faces of a brick");
    }
    return STATUS_OK;
}

void bricks_of_region(const struct octree *tree, const struct octree_region *region, int first[3],
                      int last[3])
{
    const int along = bricks_along(tree);
    for (int i = 0; i < 3; i++) {
        first[i] = (region->low[i] - 1 < 0 ? 0 : region->low[i] - 1) / BRICK_SIDE;
        last[i] = (region->high[i] + 1) / BRICK_SIDE;
        last[i] = last[i] >= along ? along - 1 : last[i];
    }
}
