/*
 * The shape of a mesh's triangles: rounds of smoothing along the surface, and collapsing, splitting and
 * flipping of edges, all of which keep the surface what it is.
 *
 *     if (relax_mesh(&mesh, &settings, &stats, err)) ...
 *
 * A round moves each point towards the mean of its triangles' centres, weighted by their areas, within its
 * tangent plane, and then back to the field's surface by a step of Newton's method along the gradient; the
 * first rounds change edges too (Botsch, Kobbelt, "A remeshing approach to multiresolution modeling", SGP
 * 2004, with the tangent plane and the normals of the field instead of the mesh). At the end Newton's method
 * runs until |f - T| < 1e-9.
 *
 * No move or change is made that would turn a triangle's normal away from its points' normals further than it
 * was, or than about 70 degrees, so that the two skins of a thin wall stay apart.
 *
 * All points move at once, from the places of the round before, and changes of edges run in the order of the
 * triangles: the result depends neither on threads nor on seeds.
 */
#ifndef SURFACE_RELAX_H
#define SURFACE_RELAX_H

#include "common/mesh.h"
#include "common/threads.h"
#include "surface/field.h"

struct relax_settings {
    const struct field *field;
    double threshold;
    unsigned rounds;
    uint32_t triangles;   /* 0, or how many to end with, about */
    struct threads *pool; /* NULL: one */
    void (*progress)(void *context, double done);
    void *progress_context;
};

struct relax_stats {
    uint64_t evaluations;
    double worst_residual; /* largest |f - T| at a point */
    size_t bytes;          /* at the peak, the mesh included */
};

/* The mesh, which must be closed, oriented and have normals, is replaced. Errors: STATUS_NO_MEMORY;
 * the mesh is then empty. */
enum status relax_mesh(struct mesh *mesh, const struct relax_settings *settings, struct relax_stats *stats,
                       struct error *err);

#endif
