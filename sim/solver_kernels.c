/*
 * An edge couples its two ends in the system by the block -B, either way and without pressure's share:
 *     B = u h^T + t 1,    h = a g + b d u,    t = a T/|l|,
 * of u, g, d and the pull's share T/|l| as jacobian_kernels.c keeps them. SIM_SOLVER is the name of the table
 * at the end.
 */
#include "sim/solver_kernels.h"
#include "sim/forces_math.h"
#include "sim/jacobian_kernels.h"

/* What is kept of each: h and t; u and 0. */
static void couple(const struct sim *sim, struct solver *solver, uint32_t begin, uint32_t end)
{
    const row(*edge)[2] = (const row(*)[2])sim->jacobian->edge;
    row(*kept)[2] = (row(*)[2])solver->coupling;
    for (uint32_t i = solver->first_link[begin]; i < solver->first_link[end]; i++) {
        const row *of = edge[solver->link[i].edge];
        const row u = {of[0][0], of[0][1], of[0][2], 0};
        kept[i][0] = solver->a * of[1] + solver->b * of[1][3] * u;
        kept[i][0][3] = solver->a * of[0][3];
        kept[i][1] = u;
    }
}

/* M x of a block that is kept by columns. */
static inline row times(const row column[3], row x)
{
    return x[0] * column[0] + x[1] * column[1] + x[2] * column[2];
}

/* Its rows to the columns of its inverse. A block that has no inverse in numbers becomes the unit matrix over
 * the mass: any preconditioner is right, only not as fast. */
static void invert(row block[3], double mass)
{
    const row c[3] = {cross(block[1], block[2]), cross(block[2], block[0]), cross(block[0], block[1])};
    const double det = dot(block[0], c[0]);
    const bool regular = isfinite(1 / det) && isfinite(det);
    for (int i = 0; i < 3; i++)
        if (regular)
            block[i] = c[i] / det;
        else
            block[i] = (row){(i == 0) / mass, (i == 1) / mass, (i == 2) / mass, 0};
}

/* What eliminating an edge's lower point, with the inverse N, does to the upper one's block: block -= B N B,
 *     B N B = u (h . N u) h^T + t (u h^T N + N u h^T + t N). */
static inline void eliminate(const row coupling[2], const row column[3], const row line[3], row block[3])
{
    const double t = coupling[0][3];
    const row h = {coupling[0][0], coupling[0][1], coupling[0][2], 0}, u = coupling[1];
    const row w = times(column, u), s = dot(h, w) * h + t * times(line, h);
    for (int i = 0; i < 3; i++)
        block[i] -= u[i] * s + t * (w[i] * h + t * line[i]);
}

static void factor(const struct sim *sim, struct solver *solver, uint32_t begin, uint32_t end)
{
    row(*block)[3] = (row(*)[3])solver->inverse;
    const row(*coupling)[2] = (const row(*)[2])solver->coupling;
    const uint32_t *first = solver->first_link;
    for (uint32_t p = begin; p < end; p++) {
        row *n = block[p], line[3];
        invert(n, sim->mass[p]);
        for (int i = 0; i < 3; i++)
            line[i] = (row){n[0][i], n[1][i], n[2][i], 0};
        for (uint32_t i = first[p]; i < first[p + 1]; i++)
            if (solver->link[i].upper < end)
                eliminate(coupling[i], n, line, block[solver->link[i].upper]);
    }
}

/* B x. */
static inline row coupled(const row coupling[2], row x)
{
    return dot(coupling[0], x) * coupling[1] + coupling[0][3] * x;
}

/* Down through the points as they are numbered, and up again. */
static void precondition(const struct solver *solver, uint32_t begin, uint32_t end, double (*x)[4],
                         double (*to)[4])
{
    const row(*inverse)[3] = (const row(*)[3])solver->inverse;
    const row(*coupling)[2] = (const row(*)[2])solver->coupling;
    const struct solver_link *link = solver->link;
    const uint32_t *first = solver->first_link;
    row *y = (row *)to;
    for (uint32_t p = begin; p < end; p++)
        y[p] = *(row *)x[p];
    for (uint32_t p = begin; p < end; p++) {
        const row solved = y[p] = times(inverse[p], y[p]);
        for (uint32_t i = first[p]; i < first[p + 1]; i++)
            if (link[i].upper < end)
                y[link[i].upper] += coupled(coupling[i], solved);
    }
    for (uint32_t p = end; p-- > begin;) {
        row sum = {0};
        for (uint32_t i = first[p]; i < first[p + 1]; i++)
            if (link[i].upper < end)
                sum += coupled(coupling[i], y[link[i].upper]);
        y[p] += times(inverse[p], sum);
    }
}

extern const struct solver_kernels SIM_SOLVER;
const struct solver_kernels SIM_SOLVER = {couple, factor, precondition};
