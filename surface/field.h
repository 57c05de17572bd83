/*
 * The Gaussian field of a sculpture (paper 3.4): f(p) = sum over its fields of b_k exp(-r^2 / (2 s^2)), and
 * its limit of infinitely many fields.
 *
 *     struct field field;
 *     if (field_init(&field, &tree, &settings, err)) ...
 *
 * Values at single points are found with a probe (surface/probe.h), on a regular grid by blocks
 * (surface/block.h).
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
 * The value at a point is a pure function of the point: sums run along x, then y, then z, within a row in
 * the octree's Morton order, and what is out of reach adds exactly 0. So any two ways to gather the
 * leaves give the same bits.
 */
#ifndef SURFACE_FIELD_H
#define SURFACE_FIELD_H

#include "common/octree.h"
#include "common/status.h"
#include "surface/distribution.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FIELDS_EXACT = -1, FIELDS_SIDE_MAX = 16 };

struct field_settings {
    long fields_per_cube;   /* FIELDS_EXACT, 0, or n^3 with n from 1 to FIELDS_SIDE_MAX */
    double fields_per_area; /* A, 0 .. 1e7; 0: none */
    double sigma;           /* s, 0.01 .. 1e5 */
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

/* Boxes of fields are sums over these lattices along x, y and z. */
struct field_layer {
    enum field_track track[3];
};

enum { FIELD_LAYERS = 4 }; /* the volume's, and those of the faces across x, y and z */

struct field {
    const struct octree *tree;   /* borrowed */
    int side;                    /* cells along an axis */
    double sigma, cutoff, reach; /* reach = cutoff * sigma */
    struct field_lattice lattice[FIELD_TRACKS];
    struct field_layer layer[FIELD_LAYERS];
    int layers; /* in use */
    double coefficient[OCTREE_MATERIALS];
    double steepness;                 /* no gradient is longer */
    int profile_room;                 /* planes that a profile may have */
    struct distribution distribution; /* of the continuum */
};

/* Errors: STATUS_RANGE, naming the setting and what would be right. */
enum status field_init(struct field *field, const struct octree *tree, const struct field_settings *settings,
                       struct error *err);

/* *cut becomes the same field with its Gaussians ending at `cutoff` (in s, 2 .. 8) where that is less:
 * quicker, and off by at most what is said above. Its steepness stays that of `field`. */
void field_cut_earlier(struct field *cut, const struct field *field, double cutoff);

/* One-dimensional sums at a coordinate x. sum[track][i - first] is that over all lattice points below plane
 * i, for first <= i <= last; below and above it is constant. slope is its derivative by x. */
struct profile {
    int first, last;
    double *sum[FIELD_TRACKS], *slope[FIELD_TRACKS]; /* [field.profile_room] */
};

void profile_fill(const struct field *field, double x, struct profile *profile);

static inline int profile_index(int first, int last, int plane)
{
    return (plane < first ? first : plane > last ? last : plane) - first;
}

/* The profiles of a point. */
struct profiles {
    struct profile axis[3];
    double *storage;
};

/* False when there is no memory. */
bool profiles_init(struct profiles *profiles, const struct field *field);
void profiles_clear(struct profiles *profiles);

/* The box of cells whose fields reach a point of low .. high. */
void field_reach(const struct field *field, const double low[3], const double high[3], int cell_low[3],
                 int cell_high[3]);

#endif
