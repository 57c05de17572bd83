/*
 * The regular grid that marching cubes looks at, in bricks of BRICK x BRICK x BRICK cells.
 *
 *     struct grid grid;
 *     if (grid_init(&grid, &field, cube_size, err)) ...
 *     x = grid_coordinate(&grid, line);                 values at corners: surface/block.h
 *     grid_clear(&grid);
 *
 * Corner (i, j, k) lies at ((i + 1/2) h, (j + 1/2) h, (k + 1/2) h), h the cube size, so that the faces of
 * the sculpture's cells, where an exact field is half the inside's, fall between corners whenever h divides
 * a cell's side. Cell (i, j, k) has that corner as its lowest. The one-dimensional sums of the field are
 * tabulated once for each coordinate; all three axes share the table.
 */
#ifndef SURFACE_GRID_H
#define SURFACE_GRID_H

#include "surface/field.h"

enum {
    BRICK = 8,
    BRICK_CORNERS = BRICK + 1,
    GRID_GROUP = 4,           /* bricks along an axis that are worked on together: a power of 2 */
    GRID_LINES_MAX = 1 << 20, /* along an axis; keeps a brick's Morton code below 64 bits */
};

struct grid {
    const struct field *field;       /* borrowed */
    double cube;                     /* h in cells of the octree */
    int brick_low[3], brick_high[3]; /* bricks with some corner that the field reaches, both included */
    int line_first, line_count;
    int *first, *last;                               /* [line_count] as in struct profile */
    double *sum[FIELD_TRACKS], *slope[FIELD_TRACKS]; /* [line_count][field.profile_room] */
};

/* cube: the cube size in the octree's cells. Errors: STATUS_RANGE when there would be too many lines,
 * STATUS_NO_MEMORY. */
enum status grid_init(struct grid *grid, const struct field *field, double cube, struct error *err);
void grid_clear(struct grid *grid);

/* Where a corner is, in the octree's cells. */
static inline double grid_coordinate(const struct grid *grid, int line)
{
    return (line + 0.5) * grid->cube;
}

/* The profile at a line; its sums belong to the grid. */
static inline struct profile grid_profile(const struct grid *grid, int line)
{
    size_t index = (size_t)(line - grid->line_first), room = (size_t)grid->field->profile_room;
    struct profile profile = {.first = grid->first[index], .last = grid->last[index]};
    for (int track = 0; track < FIELD_TRACKS; track++)
        if (grid->sum[track]) {
            profile.sum[track] = grid->sum[track] + index * room;
            profile.slope[track] = grid->slope[track] + index * room;
        }
    return profile;
}

#endif
