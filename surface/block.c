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
    free(block->share);
    free(block->beam);
    free(block->line);
    memset(block, 0, sizeof *block);
}

/* How many bricks along an axis share a window: gathering is paid for once for all of them, while a window
 * much wider than the fields reach would be longer to look through for each. */
static int bricks_that_share(const struct grid *grid)
{
    double side = BRICK * grid->cube, reach = grid->field->reach;
    return side <= reach + 1 ? GRID_GROUP : side <= 2 * (reach + 1) ? GRID_GROUP / 2 : 1;
}

static bool move_window(struct block *block, const int at[3])
{
    int bricks = bricks_that_share(block->grid), first[3];
    double low[3], high[3], cube = block->grid->cube;
    bool same = block->window_bricks == bricks;
    for (int axis = 0; axis < 3; axis++) {
        first[axis] = at[axis] & -bricks; /* a power of 2: rounds down, also below 0 */
        same &= first[axis] == block->window_at[axis];
        low[axis] = first[axis] * BRICK * cube;
        high[axis] = ((first[axis] + bricks) * BRICK + 1) * cube;
    }
    if (same)
        return true;
    memcpy(block->window_at, first, sizeof first);
    bool filled = window_fill(&block->window, block->grid->field, low, high);
    block->window_bricks = filled ? bricks : 0;
    return filled;
}

bool block_move(struct block *block, const int at[3])
{
    const struct window *w = &block->window;
    if (!move_window(block, at))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        block->corner[axis] = at[axis] * BRICK;
        for (int i = 0; i < BRICK_CORNERS; i++)
            block->profile[axis][i] = grid_profile(block->grid, block->corner[axis] + i);
        int first = block->profile[axis][0].first, last = block->profile[axis][BRICK].last;
        int end = last < w->low[axis] + w->size[axis] ? last : w->low[axis] + w->size[axis];
        block->low[axis] = first > w->low[axis] ? first : w->low[axis];
        block->size[axis] = end > block->low[axis] ? end - block->low[axis] : 0;
    }
    block->rows = (size_t)block->grid->field->layers * (size_t)block->size[1] * (size_t)block->size[2];
    return true;
}

/* The sums of one row of the window along x at all places of the block, and their slopes; to
 * number `row` of the block. */
static void sum_row(struct block *block, enum field_track track, size_t window_row_number, size_t row)
{
    const struct window *w = &block->window;
    int low = block->low[0], high = low + block->size[0];
    double sum[BRICK_CORNERS] = {0}, slope[BRICK_CORNERS] = {0};
    for (uint32_t k = w->start[window_row_number]; k < w->start[window_row_number + 1]; k++) {
        const struct window_run *run = &w->run[k];
        if (run->end <= low || run->begin >= high)
            continue;
        for (int i = 0; i < BRICK_CORNERS; i++) {
            const struct profile *x = &block->profile[0][i];
            int begin = profile_index(x->first, x->last, run->begin);
            int end = profile_index(x->first, x->last, run->end);
            sum[i] += run->weight * (x->sum[track][end] - x->sum[track][begin]);
            slope[i] += run->weight * (x->slope[track][end] - x->slope[track][begin]);
        }
    }
    double *out = block->row + row;
    for (int i = 0; i < BRICK_CORNERS; i++, out += 2 * block->rows) {
        out[0] = sum[i];
        out[block->rows] = slope[i];
    }
}

static void find_shares(struct block *block, enum field_track track)
{
    memset(block->share, 0, (size_t)(block->size[1] * BLOCK_ROW) * sizeof *block->share);
    for (int i = 0; i < BRICK_CORNERS; i++) {
        const struct profile *y = &block->profile[1][i];
        const double *sum = y->sum[track];
        for (int k = 0; k < block->size[1]; k++) {
            int plane = block->low[1] + k - y->first;
            if (plane >= 0 && plane < y->last - y->first)
                block->share[k * BLOCK_ROW + i] = sum[plane + 1] - sum[plane];
        }
    }
}

/* plane[y]: what the block's rows of one plane, from number `row` on, add up to at its 9 places along y. */
static void sum_plane(const struct block *block, size_t row, double plane[BRICK_CORNERS][BLOCK_ROW])
{
    for (int x = 0; x < BRICK_CORNERS; x++) {
        const double *along = block->row + (size_t)x * 2 * block->rows + row;
        double total[BLOCK_ROW] = {0};
        for (int k = 0; k < block->size[1]; k++)
            for (int y = 0; y < BLOCK_ROW; y++)
                total[y] += block->share[k * BLOCK_ROW + y] * along[k];
        for (int y = 0; y < BRICK_CORNERS; y++)
            plane[y][x] = total[y];
    }
}

/* Adds a plane to all corners that it reaches. */
static void add_plane(struct block *block, enum field_track track, int cell,
                      double plane[BRICK_CORNERS][BLOCK_ROW])
{
    for (int i = 0; i < BRICK_CORNERS; i++) {
        const struct profile *z = &block->profile[2][i];
        if (cell < z->first || cell >= z->last)
            continue;
        double share = z->sum[track][cell - z->first + 1] - z->sum[track][cell - z->first];
        double *value = block->values + i * BRICK_CORNERS * BRICK_CORNERS;
        for (int y = 0; y < BRICK_CORNERS; y++)
            for (int x = 0; x < BRICK_CORNERS; x++)
                *value++ += share * plane[y][x];
    }
}

static bool make_rooms(struct block *block)
{
    int longest = 0;
    for (int axis = 0; axis < 3; axis++)
        longest = block->size[axis] > longest ? block->size[axis] : longest;
    return array_renew(&block->row, 2 * block->rows * BRICK_CORNERS, sizeof(double), &block->row_room) &&
           array_renew(&block->share, (size_t)(block->size[1] * BLOCK_ROW), sizeof(double),
                       &block->share_room) &&
           array_renew(&block->beam, 2 * BRICK_CORNERS * block_beam(block), sizeof(double),
                       &block->beam_room) &&
           array_renew(&block->line, (size_t)(FIELD_LAYERS * 3 * longest), sizeof(double), &block->line_room);
}

bool block_sample(struct block *block)
{
    const struct window *w = &block->window;
    const struct field *field = block->grid->field;
    if (!make_rooms(block))
        return false;
    memset(block->values, 0, sizeof block->values);
    block->beams = 0;
    double plane[BRICK_CORNERS][BLOCK_ROW];
    size_t row = 0;
    for (int layer = 0; layer < field->layers; layer++) {
        const enum field_track *track = field->layer[layer].track;
        find_shares(block, track[1]);
        for (int z = 0; z < block->size[2]; z++) {
            size_t first = row, begin = window_row(w, layer, block->low[1], block->low[2] + z);
            for (int y = 0; y < block->size[1]; y++)
                sum_row(block, track[0], begin + (size_t)y, row++);
            if (w->start[begin] == w->start[begin + (size_t)block->size[1]])
                continue;
            sum_plane(block, first, plane);
            add_plane(block, track[2], block->low[2] + z, plane);
        }
    }
    return true;
}

double block_value(struct block *block, const double point[3], double gradient[3])
{
    return window_value(&block->window, point, &block->profiles, gradient);
}

double block_corner(const struct block *block, const int at[3], double gradient[3])
{
    return window_sum(&block->window,
                      (const struct profile *const[3]){&block->profile[0][at[0]], &block->profile[1][at[1]],
                                                       &block->profile[2][at[2]]},
                      gradient);
}
