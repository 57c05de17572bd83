#include "surface/grid.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int floor_divide(double value, int by)
{
    return (int)floor(value / by);
}

/* Bricks around all corners that the field reaches, with at least one corner to spare on each side. */
static void find_bounds(struct grid *grid)
{
    struct octree_info info = octree_measure(grid->field->tree);
    for (int axis = 0; axis < 3; axis++) {
        double low = (info.low[axis] - grid->field->reach) / grid->cube - 0.5;
        double high = (info.high[axis] + 1 + grid->field->reach) / grid->cube - 0.5;
        grid->brick_low[axis] = floor_divide(floor(low) - 1, BRICK);
        grid->brick_high[axis] = floor_divide(ceil(high) + 1, BRICK);
    }
}

static bool tabulate(struct grid *grid)
{
    size_t count = (size_t)grid->line_count, room = (size_t)grid->field->profile_room;
    grid->first = array_new(count, sizeof *grid->first);
    grid->last = array_new(count, sizeof *grid->last);
    if (!grid->first || !grid->last)
        return false;
    for (int track = 0; track < FIELD_TRACKS; track++)
        if (grid->field->lattice[track].used) {
            grid->sum[track] = array_new(count, room * sizeof *grid->sum[track]);
            if (!grid->sum[track])
                return false;
        }
    for (size_t line = 0; line < count; line++) {
        struct profile profile = {0};
        for (int track = 0; track < FIELD_TRACKS; track++)
            profile.sum[track] = grid->sum[track] ? grid->sum[track] + line * room : NULL;
        profile_fill(grid->field, grid_coordinate(grid, grid->line_first + (int)line), &profile);
        grid->first[line] = profile.first;
        grid->last[line] = profile.last;
    }
    return true;
}

enum status grid_init(struct grid *grid, const struct field *field, double cube, struct error *err)
{
    *grid = (struct grid){.field = field, .cube = cube};
    if ((field->side + 2 * field->reach) / cube > GRID_LINES_MAX - 4 * BRICK)
        return error_set(err, STATUS_RANGE,
                         "a cube size of %g is too small: more than %d cubes in a row; %.3g works",
                         cube / field->side, GRID_LINES_MAX,
                         1.01 * (field->side + 2 * field->reach) / GRID_LINES_MAX / field->side);
    find_bounds(grid);
    int low = grid->brick_low[0], high = grid->brick_high[0];
    for (int axis = 1; axis < 3; axis++) {
        low = grid->brick_low[axis] < low ? grid->brick_low[axis] : low;
        high = grid->brick_high[axis] > high ? grid->brick_high[axis] : high;
    }
    grid->line_first = low * BRICK;
    grid->line_count = (high - low + 1) * BRICK + 1;
    if (tabulate(grid))
        return STATUS_OK;
    grid_clear(grid);
    return error_no_memory(err, "the grid's lines");
}

void grid_clear(struct grid *grid)
{
    free(grid->first);
    free(grid->last);
    for (int track = 0; track < FIELD_TRACKS; track++)
        free(grid->sum[track]);
    *grid = (struct grid){0};
}

/* An item's one-dimensional sums at `count` lines from `corner` on, and which of them are not 0. */
struct factors {
    double value[BRICK_CORNERS];
    int begin, end;
};

static void find_factors(const struct grid *grid, const struct field_item *item, int axis, int corner,
                         int count, struct factors *out)
{
    size_t room = (size_t)grid->field->profile_room, line = (size_t)(corner - grid->line_first);
    const double *sum = grid->sum[item->track[axis]] + line * room;
    out->begin = count;
    out->end = 0;
    for (int i = 0; i < count; i++, line++, sum += room) {
        int first = grid->first[line], last = grid->last[line];
        out->value[i] = sum[profile_index(first, last, item->high[axis])] -
                        sum[profile_index(first, last, item->low[axis])];
        if (out->value[i] == 0)
            continue;
        out->begin = i < out->begin ? i : out->begin;
        out->end = i + 1;
    }
}

static void add_item(const struct factors factors[3], double weight, int count, double *values)
{
    for (int z = factors[2].begin; z < factors[2].end; z++)
        for (int y = factors[1].begin; y < factors[1].end; y++) {
            double scale = weight * factors[2].value[z] * factors[1].value[y];
            double *row = values + (z * count + y) * count;
            for (int x = factors[0].begin; x < factors[0].end; x++)
                row[x] += scale * factors[0].value[x];
        }
}

bool grid_sample(const struct grid *grid, const int corner[3], int count, struct field_items *scratch,
                 double *values)
{
    double low[3], high[3];
    int cell_low[3], cell_high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = grid_coordinate(grid, corner[axis]);
        high[axis] = grid_coordinate(grid, corner[axis] + count - 1);
    }
    memset(values, 0, (size_t)(count * count * count) * sizeof *values);
    field_reach(grid->field, low, high, cell_low, cell_high);
    scratch->count = 0;
    if (!field_gather(grid->field, cell_low, cell_high, scratch))
        return false;
    for (size_t i = 0; i < scratch->count; i++) {
        struct factors factors[3];
        bool reaches = true;
        for (int axis = 0; axis < 3 && reaches; axis++) {
            find_factors(grid, &scratch->items[i], axis, corner[axis], count, &factors[axis]);
            reaches = factors[axis].begin < factors[axis].end;
        }
        if (reaches)
            add_item(factors, scratch->items[i].weight, count, values);
    }
    return true;
}
