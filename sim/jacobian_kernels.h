/* The inner loops of the forces' derivatives (jacobian.h), compiled once for each set of instructions like
 * those of the forces (kernels.h). */
#ifndef SIM_JACOBIAN_KERNELS_H
#define SIM_JACOBIAN_KERNELS_H

#include "sim/areas.h"

/* What sim_linearise() keeps. Rows are four doubles, aligned to 32 bytes. */
struct sim_jacobian {
    /* [edge_count] u, t and g, d: see edges(); all 0 for a broken one; a membrane's stand-ins. */
    double (*edge)[8];
    double (*triangle)[4]; /* [triangle_count] unit normal, 1 / (2 area); all 0 for a torn one */
    double (*point)[4];    /* [point_count] unit normal, pressure / length of the sum of normals */
    double (*turn)[4];     /* [point_count] change of that sum, within a product */
    const struct jacobian_kernels *kernels;
};

/* A product's operands: out = a K dx + b D dv. */
struct jacobian_product {
    double a, b;
    double (*dx)[4], (*dv)[4], (*out)[4];
};

/* The same of pressure on areas: df += a times the change of the forces as points move by dx and the
 * pressure changes by `change`. */
struct areas_product {
    const struct sim_balloon *balloon;
    struct areas_pressure pressure, change;
    const unsigned char *held; /* as in areas.h */
    double a;
    double (*dx)[4], (*df)[4];
};

/* Each sets the rows of its part's own points, edges or triangles, and reads whatever it needs. */
struct jacobian_kernels {
    void (*edges)(struct sim *sim, const struct sim_part *part);
    void (*triangles)(struct sim *sim, const struct sim_part *part);
    void (*points)(struct sim *sim, const struct sim_part *part); /* after all parts' triangles */
    void (*product)(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product);
    void (*areas)(struct sim *sim, const struct sim_part *part, const struct areas_product *product);
    void (*diagonal)(struct sim *sim, const struct sim_part *part, double a, double b, double (*block)[3][4]);
};

#endif
