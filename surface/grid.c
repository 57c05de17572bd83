#include "surface/grid.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int floor_divide(double value, int by)
{
    return (int)floor(value / by);
}

/* Bricks around all corners that the field reaches, with at least one corner to spare on each side, in groups
 * of GRID_GROUP along each axis. */
static void find_bounds(struct grid *grid)
{
    struct octree_info info = octree_measure(grid->field->tree);
    for (int axis = 0; axis < 3; axis++) {
        double low = (info.low[axis] - grid->field->reach) / grid->cube - 0.5;
        double high = (info.high[axis] + 1 + grid->field->reach) / grid->cube - 0.5;
        grid->brick_low[axis] = floor_divide(floor(low) - 1, BRICK * GRID_GROUP) * GRID_GROUP;
        grid->brick_high[axis] = floor_divide(ceil(high) + 1, BRICK * GRID_GROUP) * GRID_GROUP + GRID_GROUP -
                                 1;
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
            grid->slope[track] = array_new(count, room * sizeof *grid->slope[track]);
            if (!grid->sum[track] || !grid->slope[track])
                return false;
        }
    for (size_t line = 0; line < count; line++) {
        struct profile profile = grid_profile(grid, grid->line_first + (int)line);
        profile_fill(grid->field, grid_coordinate(grid, grid->line_first + (int)line), &profile);
        grid->first[line] = profile.first;
        grid->last[line] = profile.last;
    }
    return true;
}

enum status grid_init(struct grid *grid, const struct field *field, double cube, struct error *err)
{
    *grid = (struct grid){.field = field, .cube = cube};
    if ((field->side + 2 * field->reach) / cube > GRID_LINES_MAX - 4 * BRICK * GRID_GROUP)
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
    for (int track = 0; track < FIELD_TRACKS; track++) {
        free(grid->sum[track]);
        free(grid->slope[track]);
    }
    *grid = (struct grid){0};
}
