/*
 * The Gaussian field of a sculpture (paper 3.4): f(p) = sum over its fields of b_k exp(-r^2 / (2 s^2)), and
 * its limit of infinitely many fields.
 *
 *     struct field field;
 *     if (field_init(&field, &tree, &settings, err)) ...
 *     struct probe probe;
 *     if (probe_init(&probe, &field, err)) ...          one for each thread: it keeps what it found near by
 *     value = probe_value(&probe, point, gradient);
 *     if (probe.failed) ...                             memory ran out in one of the calls so far
 *     probe_clear(&probe);
 *
 * Unit of length, unless said otherwise: the side of the octree's finest cell, with the sculpture at
 * 0 .. 2^depth on each axis. A bigger leaf is only a short way to write many cells.
 *
 * Kinds of fields. Each is a regular lattice, so the sum over a box of it is a product over the axes of
 * one-dimensional sums, and a leaf of any size costs the same few terms.
 *
 * - In the volume, N = n^3 fields a cell, at the centres of its n x n x n sub-cells, each of weight
 *   (1/n)^3 / ((2 pi)^(3/2) s^3): the field tends to 1 deep inside as N or s grows.
 * - `exact`, the limit of that for large N: the convolution of the sculpture with the normalised Gaussian.
 *   Over a box it is the product over the axes of (erf((b-x)/(s sqrt 2)) - erf((a-x)/(s sqrt 2))) / 2.
 * - On the surface, A fields per unit of area (of which the first cube's face has 1) on each face between
 *   material and emptiness, at the points of a square lattice of spacing 1/sqrt(A) that is the same for all
 *   faces in a plane and begins half a spacing from the first cube's edge, each of weight 1/(A 2 pi s^2),
 *   s in units of the first cube: on a large flat face they add up to 1, and add to the volume's fields.
 *
 * All are multiplied by their material's coefficient b_k (octree.coefficient).
 *
 * Cut-off. A one-dimensional Gaussian ends at R s: for lattices it is (exp(-t^2/2s^2) - e)/(1 - e), e =
 * exp(-R^2/2), and for `exact` the normal distribution cut off at R and normalised again. So the field is
 * continuous, which lets roots be found to the last digit, and a leaf further away than R s along any axis
 * contributes exactly nothing. The error of an `exact` field is at most 3 erfc(R/sqrt 2) times the range of
 * the b_k, 0 among them: the mass of the Gaussian outside the cube of half side R s (1.7e-6 at R = 5, 5.9e-9
 * at R = 6).
 *
 * The value at a point is a pure function of the point: sums run in the octree's Morton order, and what is
 * out of reach adds exactly 0, so any two ways to gather the leaves give the same bits.
 */
#ifndef SURFACE_FIELD_H
#define SURFACE_FIELD_H

#include "common/octree.h"
#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FIELDS_EXACT = -1, FIELDS_SIDE_MAX = 16, FIELD_WINDOWS = 64 };

struct field_settings {
    long fields_per_cube;   /* FIELDS_EXACT, 0, or n^3 with n from 1 to FIELDS_SIDE_MAX */
    double fields_per_area; /* A, 0 .. 1e7; 0: none */
    double sigma;           /* s, at least 0.01 */
    double cutoff;          /* R, in s: 2 .. 8 */
};

/* The lattices that one-dimensional sums run over. */
enum field_track {
    TRACK_VOLUME, /* n points a cell, or the continuum */
    TRACK_AREA,   /* along a face */
    TRACK_PLANE,  /* across it: the planes between cells */
    FIELD_TRACKS
};

struct field_lattice {
    bool used;
    double spacing, offset; /* points at (j + offset) spacing; spacing 0: the continuum */
    double weight;          /* of each point; for the continuum the sum is normalised to 1 */
};

struct field {
    const struct octree *tree;   /* borrowed */
    int side;                    /* cells along an axis */
    double sigma, cutoff, reach; /* reach = cutoff * sigma */
    struct field_lattice lattice[FIELD_TRACKS];
    double coefficient[OCTREE_MATERIALS];
    double steepness; /* no gradient is longer */
    int profile_room; /* planes that a profile may have */
};

/* Errors: STATUS_RANGE, naming the setting and what would be right. */
enum status field_init(struct field *field, const struct octree *tree, const struct field_settings *settings,
                       struct error *err);

/* One-dimensional sums at a coordinate x. sum[track][i - first] is that over all lattice points below plane
 * i, for first <= i <= last; below and above it is constant. slope is its derivative by x. */
struct profile {
    int first, last;
    double *sum[FIELD_TRACKS], *slope[FIELD_TRACKS]; /* [field.profile_room]; slope NULL: not wanted */
};

void profile_fill(const struct field *field, double x, struct profile *profile);

static inline int profile_index(int first, int last, int plane)
{
    return (plane < first ? first : plane > last ? last : plane) - first;
}

/* A box of fields: along axis a those of lattice track[a] from plane low[a] to plane high[a]. */
struct field_item {
    int16_t low[3], high[3];
    uint8_t track[3];
    double weight;
};

struct field_items {
    struct field_item *items;
    size_t count, capacity;
};

/* All boxes of fields that have a part in the cells low .. high (both included), in Morton order of their
 * leaves. False when there is no memory. */
bool field_gather(const struct field *field, const int low[3], const int high[3], struct field_items *out);

/* The box of cells whose fields reach a point of low .. high. */
void field_reach(const struct field *field, const double low[3], const double high[3], int cell_low[3],
                 int cell_high[3]);

/* What one thread needs to evaluate the field: scratch, and the boxes of fields around the last few cells. */
struct probe {
    const struct field *field; /* borrowed */
    struct {
        bool valid;
        int cell[3];
        struct field_items near;
    } window[FIELD_WINDOWS];
    struct profile axis[3];
    double *storage;
    bool failed;          /* memory ran out: values since then are 0 */
    uint64_t evaluations; /* so far */
};

enum status probe_init(struct probe *probe, const struct field *field, struct error *err);
void probe_clear(struct probe *probe);

/* The field at a point, and its gradient. */
double probe_value(struct probe *probe, const double point[3], double gradient[3]);

#endif
