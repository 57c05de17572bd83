#include "sim/jacobian.h"
#include "sim/instructions.h"
#include "sim/jacobian_kernels.h"
#include "sim/membrane.h"

#include <stdlib.h>
#include <string.h>

extern const struct jacobian_kernels jacobian_plain, jacobian_avx2;

enum status sim_jacobian_open(struct sim *sim, struct error *err)
{
    struct sim_jacobian *j = calloc(1, sizeof *j);
    sim->jacobian = j;
    if (!j)
        return error_no_memory(err, "the derivatives of the forces");
    j->kernels = FOR_THIS_MACHINE(jacobian);
    j->edge = sim_table(sim, sim->edge_count, sizeof *j->edge);
    j->triangle = sim_table(sim, sim->triangle_count, sizeof *j->triangle);
    j->point = sim_table(sim, sim->point_count, sizeof *j->point);
    j->turn = sim_table(sim, sim->point_count, sizeof *j->turn);
    if (!j->edge || !j->triangle || !j->point || !j->turn)
        return error_no_memory(err, "the derivatives of the forces");
    return STATUS_OK;
}

void sim_jacobian_close(struct sim *sim)
{
    struct sim_jacobian *j = sim->jacobian;
    if (!j)
        return;
    free(j->edge);
    free(j->triangle);
    free(j->point);
    free(j->turn);
    free(j);
    sim->jacobian = NULL;
}

static void linearise_part(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)context;
    if (part->balloon->membrane) /* which has products of its own: its edges serve the preconditioner */
        membrane_stand_in(sim, part, sim->jacobian->edge);
    else
        sim->jacobian->kernels->edges(sim, part);
    if (sim_point_pressure(part->balloon) != 0)
        sim->jacobian->kernels->triangles(sim, part);
}

static void linearise_points(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)context;
    if (sim_point_pressure(part->balloon) != 0)
        sim->jacobian->kernels->points(sim, part);
}

void sim_linearise(struct sim *sim)
{
    sim_each_part(sim, linearise_part, NULL);
    sim_each_part(sim, linearise_points, NULL);
}

static void product_part(struct sim *sim, const struct sim_part *part, void *context)
{
    sim->jacobian->kernels->product(sim, part, context);
}

void sim_force_product(struct sim *sim, double a, double (*dx)[4], double b, double (*dv)[4], double (*df)[4])
{
    sim->products++;
    sim_each_part(sim, product_part, &(struct jacobian_product){a, b, dx, dv, df});
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->product)
            hook->effect->product(sim, hook->balloon, a, dx, b, dv, df);
    }
}

struct blocks {
    double a, b;
    double (*block)[3][4];
};

static void diagonal_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct blocks *blocks = context;
    sim->jacobian->kernels->diagonal(sim, part, blocks->a, blocks->b, blocks->block);
}

void sim_diagonal_blocks(struct sim *sim, double a, double b, double (*block)[3][4])
{
    sim_each_part(sim, diagonal_part, &(struct blocks){a, b, block});
}
