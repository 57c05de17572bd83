#include "surface/block.h"

#include "common/array.h"

#include <stdlib.h>
#include <string.h>

bool block_init(struct block *block, const struct grid *grid)
{
    memset(block, 0, sizeof *block);
    block->grid = grid;
    return profiles_init(&block->profiles, grid->field);
}

void block_clear(struct block *block)
{
    window_clear(&block->window);
    profiles_clear(&block->profiles);
    free(block->row);
    free(block->line);
    memset(block, 0, sizeof *block);
}

/* Room for `count` doubles, whose old values are not kept. */
static bool make_room(double **items, size_t count, size_t *room)
{
    if (count <= *room)
        return true;
    free(*items);
    *items = array_new(count, sizeof **items);
    *room = *items ? count : 0;
    return *items;
}

bool block_move(struct block *block, const int corner[3])
{
    const struct grid *grid = block->grid;
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        block->corner[axis] = corner[axis];
        low[axis] = corner[axis] * grid->cube;
        high[axis] = (corner[axis] + BRICK + 1) * grid->cube;
        for (int i = 0; i < BRICK_CORNERS; i++)
            block->profile[axis][i] = grid_profile(grid, corner[axis] + i);
    }
    return window_fill(&block->window, grid->field, low, high);
}

/* The sums of one row along x at all places of the block, and their slopes. */
static void sum_row(const struct block *block, enum field_track track, size_t row, double *sum, double *slope)
{
    const struct window *w = &block->window;
    for (int i = 0; i < BLOCK_ROW; i++)
        sum[i] = slope[i] = 0;
    for (uint32_t k = w->start[row]; k < w->start[row + 1]; k++) {
        const struct window_run *run = &w->run[k];
        for (int i = 0; i < BRICK_CORNERS; i++) {
            const struct profile *x = &block->profile[0][i];
            int begin = profile_index(x->first, x->last, run->begin);
            int end = profile_index(x->first, x->last, run->end);
            sum[i] += run->weight * (x->sum[track][end] - x->sum[track][begin]);
            slope[i] += run->weight * (x->slope[track][end] - x->slope[track][begin]);
        }
    }
}

/* plane[y]: what the rows of one plane add up to at the block's 9 places along y. */
static void sum_plane(const struct block *block, enum field_track track, size_t first_row,
                      double plane[BRICK_CORNERS][BLOCK_ROW])
{
    const struct window *w = &block->window;
    for (int i = 0; i < BRICK_CORNERS; i++) {
        const struct profile *y = &block->profile[1][i];
        const double *sum = y->sum[track];
        int first = y->first > w->low[1] ? y->first : w->low[1];
        int end = y->last < w->low[1] + w->size[1] ? y->last : w->low[1] + w->size[1];
        memset(plane[i], 0, sizeof plane[i]);
        for (int k = first; k < end; k++) {
            size_t row = first_row + (size_t)(k - w->low[1]);
            if (w->start[row] == w->start[row + 1])
                continue;
            double share = sum[k - y->first + 1] - sum[k - y->first];
            const double *along = block->row + row * BLOCK_ROW;
            for (int x = 0; x < BLOCK_ROW; x++)
                plane[i][x] += share * along[x];
        }
    }
}

/* Adds a plane to all corners that it reaches. */
static void add_plane(struct block *block, enum field_track track, int k,
                      double plane[BRICK_CORNERS][BLOCK_ROW])
{
    for (int i = 0; i < BRICK_CORNERS; i++) {
        const struct profile *z = &block->profile[2][i];
        if (k < z->first || k >= z->last)
            continue;
        double share = z->sum[track][k - z->first + 1] - z->sum[track][k - z->first];
        double *value = block->values + i * BRICK_CORNERS * BRICK_CORNERS;
        for (int y = 0; y < BRICK_CORNERS; y++)
            for (int x = 0; x < BRICK_CORNERS; x++)
                *value++ += share * plane[y][x];
    }
}

bool block_sample(struct block *block)
{
    const struct window *w = &block->window;
    const struct field *field = block->grid->field;
    int longest = 0;
    for (int axis = 0; axis < 3; axis++)
        longest = w->size[axis] > longest ? w->size[axis] : longest;
    if (!make_room(&block->row, 2 * w->rows * BLOCK_ROW, &block->row_room) ||
        !make_room(&block->line, (size_t)(FIELD_LAYERS * 3 * longest), &block->line_room))
        return false;
    memset(block->values, 0, sizeof block->values);
    size_t row = 0;
    for (int layer = 0; layer < field->layers; layer++)
        for (int z = 0; z < w->size[2]; z++) {
            size_t first = row;
            double plane[BRICK_CORNERS][BLOCK_ROW];
            for (int y = 0; y < w->size[1]; y++, row++)
                sum_row(block, field->layer[layer].track[0], row, block->row + row * BLOCK_ROW,
                        block->row + (w->rows + row) * BLOCK_ROW);
            if (w->start[first] == w->start[row])
                continue;
            sum_plane(block, field->layer[layer].track[1], first, plane);
            add_plane(block, field->layer[layer].track[2], w->low[2] + z, plane);
        }
    return true;
}

double block_value(struct block *block, const double point[3], double gradient[3])
{
    return window_value(&block->window, point, &block->profiles, gradient);
}
