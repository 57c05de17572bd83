/*
 * What accuracy costs, on the user's own sculpture: each dial is walked through a ladder, the others staying
 * where the options have them.
 *
 *     struct cost_table table;
 *     if (surface_cost(&tree, &options, &table, err)) ...
 *
 * All errors are shares of the sculpture's longest extent, of the reference's area, or of its volume.
 *
 * Cube size and relaxation: the triangles' distance from the surface of the options' own field
 * (surface_compare(); points lie on it, so it is the flat triangles between them that are off). Area and
 * volume against those of an infinitely fine mesh, by Richardson's extrapolation from the two finest that are
 * an octave apart, of second order.
 *
 * Fields per cube and cut-off move the surface itself: the distance of the mesh's points from the surface of
 * the exact field with the widest cut-off, and area and volume against a mesh of that one with the same
 * cubes. Where the exact field does not reach the threshold (one wide Gaussian a cube does), the fields per
 * cube are not walked, and cut-offs are compared with the options' own fields.
 */
#ifndef SURFACE_COST_H
#define SURFACE_COST_H

#include "surface/surface.h"

enum cost_dial { COST_CUBE_SIZE, COST_FIELDS, COST_CUTOFF, COST_RELAX, COST_DIALS };
enum { COST_ROWS_MAX = 40 };

extern const char *const cost_dial_names[COST_DIALS]; /* as the options are called */

struct cost_row {
    enum cost_dial dial;
    char setting[32]; /* as the option takes it */
    double step;      /* what the error is a power of: cube size, or spacing of the fields in cells; else 0 */
    double seconds;
    uint64_t evaluations; /* of the field, at points and on the grid */
    size_t bytes;
    double rms, largest, area, volume; /* errors */
};

struct cost_table {
    struct cost_row rows[COST_ROWS_MAX];
    size_t count;
    double order[COST_DIALS]; /* fitted to rms against step by least squares of logarithms; NAN: no power */
    double extent;            /* the sculpture's longest, in units of the first cube */
};

/* Settings at which there is no surface are left out. Errors: those of surface_make() at
 * the options themselves. */
enum status surface_cost(const struct octree *tree, const struct surface_options *options,
                         struct cost_table *table, struct error *err);

/* The cheapest setting of a dial found to keep the RMS error below `error`; for cube sizes beyond the ladder
 * it is extrapolated by the fitted order. False where there is none. */
bool cost_recommend(const struct cost_table *table, enum cost_dial dial, double error, char setting[32]);

#endif
