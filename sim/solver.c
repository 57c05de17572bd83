#include "sim/solver.h"
#include "sim/jacobian.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESIDUAL, SHADOW, DIRECTION, MAPPED_DIRECTION, MAPPED_RESIDUAL, PRODUCT };

enum status solver_open(struct sim *sim, struct solver *solver, struct error *err)
{
    bool room = (solver->inverse = sim_table(sim, sim->point_count, sizeof *solver->inverse)) != NULL;
    for (int i = 0; i < SOLVER_ROWS; i++)
        room &= (solver->rows[i] = sim_table(sim, sim->point_count, sizeof *solver->rows[i])) != NULL;
    return room ? STATUS_OK : error_no_memory(err, "the linear solver");
}

void solver_close(struct solver *solver)
{
    free(solver->inverse);
    for (int i = 0; i < SOLVER_ROWS; i++)
        free(solver->rows[i]);
    *solver = (struct solver){0};
}

/* By its adjugate. A block that has no inverse in numbers becomes the unit matrix over the mass: any preconditioner is right,
 * only not as fast. */
static void invert(double block[3][4], double mass)
{
    double c[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
            c[i][j] = block[p][r] * block[q][s] - block[p][s] * block[q][r];
        }
    const double det = block[0][0] * c[0][0] + block[0][1] * c[1][0] + block[0][2] * c[2][0];
    const bool regular = isfinite(1 / det) && isfinite(det);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            block[i][j] = regular ? c[i][j] / det : (i == j) / mass;
}

static void invert_part(struct sim *sim, const struct sim_part *part, void *context)
{
    struct solver *solver = context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        invert(solver->inverse[p], sim->mass[p]);
}

void solver_prepare(struct sim *sim, struct solver *solver, double a, double b)
{
    solver->a = a;
    solver->b = b;
    sim_diagonal_blocks(sim, a, b, solver->inverse);
    sim_each_part(sim, invert_part, solver);
}

static inline void precondition(const struct solver *solver, uint32_t p, const double x[4], double y[4])
{
    const double(*block)[4] = (const double(*)[4])solver->inverse[p];
    for (int i = 0; i < 3; i++)
        y[i] = block[i][0] * x[0] + block[i][1] * x[1] + block[i][2] * x[2];
    y[3] = 0;
}

struct operation {
    const struct solver *solver;
    double (*x)[4], (*y)[4], (*with)[4];
    double alpha, beta;
};

static double dot(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* y = P x; the sum of y . with. */
static double precondition_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    (void)sim;
    const struct operation o = *(struct operation *)context;
    double sum = 0;
    for (uint32_t p = begin; p < end; p++) {
        precondition(o.solver, p, o.x[p], o.y[p]);
        sum += dot(o.y[p], o.with[p]);
    }
    return sum;
}

/* y = P (M x - y), y being (a K + b D) x; the sum of y . with. */
static double finish_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    const struct operation o = *(struct operation *)context;
    double sum = 0;
    for (uint32_t p = begin; p < end; p++) {
        double mapped[4];
        for (int i = 0; i < 4; i++)
            mapped[i] = sim->mass[p] * o.x[p][i] - o.y[p][i];
        precondition(o.solver, p, mapped, o.y[p]);
        sum += dot(o.y[p], o.with[p]);
    }
    return sum;
}

/* y = P (M - a K - b D) x; returns y . with. */
static double apply(struct sim *sim, struct solver *s, double (*x)[4], double (*y)[4], double (*with)[4])
{
    sim_force_product(sim, s->a, x, s->b, x, y);
    return vector_sum(sim, finish_block, &(struct operation){.solver = s, .x = x, .y = y, .with = with});
}

/* y += alpha x; the sum of y . y. */
static double add_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    (void)sim;
    const struct operation o = *(struct operation *)context;
    double sum = 0;
    for (uint32_t p = begin; p < end; p++) {
        for (int i = 0; i < 4; i++)
            o.y[p][i] += o.alpha * o.x[p][i];
        sum += dot(o.y[p], o.y[p]);
    }
    return sum;
}

static double add(struct sim *sim, double (*y)[4], double alpha, double (*x)[4])
{
    return vector_sum(sim, add_block, &(struct operation){.x = x, .y = y, .alpha = alpha});
}

double solver_size(struct sim *sim, struct solver *solver, double (*x)[4])
{
    struct operation o = {
        .solver = solver, .x = x, .y = solver->rows[PRODUCT], .with = solver->rows[PRODUCT]};
    return sqrt(vector_sum(sim, precondition_block, &o) / sim->point_count);
}

/* One iteration: a step along the direction, and one that makes the residual least along its own image. rho is the residual
 * . shadow, before and after; returns the residual's square. */
static double iterate(struct sim *sim, struct solver *solver, double (*x)[4], double *rho)
{
    double(**row)[4] = solver->rows;
    const double alpha = *rho / apply(sim, solver, row[DIRECTION], row[MAPPED_DIRECTION], row[SHADOW]);
    add(sim, row[RESIDUAL], -alpha, row[MAPPED_DIRECTION]);
    const double along = apply(sim, solver, row[RESIDUAL], row[MAPPED_RESIDUAL], row[RESIDUAL]);
    const double squares = vector_dot(sim, row[MAPPED_RESIDUAL], row[MAPPED_RESIDUAL]);
    const double omega = squares > 0 ? along / squares : 0;
    vector_combine(sim, x, x, (struct vector_term[]){{alpha, row[DIRECTION]}, {omega, row[RESIDUAL]}}, 2);
    const double left = add(sim, row[RESIDUAL], -omega, row[MAPPED_RESIDUAL]);
    const double before = *rho;
    *rho = vector_dot(sim, row[RESIDUAL], row[SHADOW]);
    const double beta = *rho / before * (alpha / omega);
    if (left > 0)
        vector_combine(sim, row[DIRECTION], row[RESIDUAL],
                       (struct vector_term[]){{beta, row[DIRECTION]}, {-beta * omega, row[MAPPED_DIRECTION]}},
                       2);
    solver->iterations++;
    return left;
}

bool solver_solve(struct sim *sim, struct solver *solver, double (*rhs)[4], double (*x)[4], double tolerance)
{
    double(**row)[4] = solver->rows;
    struct operation start = {.solver = solver, .x = rhs, .y = row[RESIDUAL], .with = row[RESIDUAL]};
    double rho = vector_sum(sim, precondition_block, &start), left = rho;
    const double enough = tolerance * tolerance * rho;
    vector_combine(sim, x, NULL, NULL, 0);
    vector_copy(sim, row[SHADOW], row[RESIDUAL]);
    vector_copy(sim, row[DIRECTION], row[RESIDUAL]);
    for (int i = 0; i < SOLVER_ITERATIONS_MAX && left > enough; i++)
        left = iterate(sim, solver, x, &rho);
    return left <= enough; /* false for NaN, too: BiCGSTAB breaks down when rho or omega becomes 0 */
}
