#include "sim/solver.h"
#include "common/threads.h"
#include "sim/instructions.h"
#include "sim/jacobian.h"
#include "sim/solver_kernels.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESIDUAL, SHADOW, DIRECTION, MAPPED_DIRECTION, MAPPED_RESIDUAL, SCRATCH };

extern const struct solver_kernels solver_plain, solver_avx2;

static uint32_t lower_end(const struct sim *sim, uint32_t edge)
{
    const uint32_t *p = sim->edge_point[edge];
    return p[0] < p[1] ? p[0] : p[1];
}

/* A counting sort. Edges are made in this order, but cuts give them new points. */
static void find_links(const struct sim *sim, const struct solver *solver)
{
    uint32_t *first = solver->first_link, sum = 0;
    memset(first, 0, (sim->point_count + (size_t)1) * sizeof *first);
    for (size_t i = 0; i < sim->balloon_count; i++)
        for (uint32_t e = sim->balloons[i].edge_begin; e < sim->balloons[i].edge_end; e++)
            first[lower_end(sim, e)]++;
    for (uint32_t p = 0; p < sim->point_count; p++)
        first[p] = sum += first[p];
    first[sim->point_count] = sum;
    for (size_t i = sim->balloon_count; i-- > 0;)
        for (uint32_t e = sim->balloons[i].edge_end; e-- > sim->balloons[i].edge_begin;) {
            const uint32_t lower = lower_end(sim, e), *p = sim->edge_point[e];
            solver->link[--first[lower]] = (struct solver_link){e, p[0] == lower ? p[1] : p[0]};
        }
}

enum status solver_open(struct sim *sim, struct solver *solver, struct error *err)
{
    solver->kernels = FOR_THIS_MACHINE(solver);
    solver->group_count = sim->point_count / SOLVER_GROUP + 1;
    solver->link = sim_table(sim, sim->edge_count, sizeof *solver->link);
    solver->coupling = sim_table(sim, sim->edge_count, sizeof *solver->coupling);
    solver->first_link = sim_table(sim, sim->point_count + (size_t)1, sizeof *solver->first_link);
    solver->inverse = sim_table(sim, sim->point_count, sizeof *solver->inverse);
    bool room = solver->link && solver->first_link && solver->coupling && solver->inverse;
    for (int i = 0; i < SOLVER_ROWS; i++)
        room &= (solver->rows[i] = sim_table(sim, sim->point_count, sizeof *solver->rows[i])) != NULL;
    if (!room)
        return error_no_memory(err, "the linear solver");
    find_links(sim, solver);
    return STATUS_OK;
}

void solver_close(struct solver *solver)
{
    free(solver->link);
    free(solver->first_link);
    free(solver->coupling);
    free(solver->inverse);
    for (int i = 0; i < SOLVER_ROWS; i++)
        free(solver->rows[i]);
    *solver = (struct solver){0};
}

struct group_job {
    struct sim *sim;
    struct solver *solver;
    double (*x)[4], (*y)[4];
};

static uint32_t group_end(const struct sim *sim, size_t group)
{
    const uint64_t end = (uint64_t)(group + 1) * SOLVER_GROUP;
    return end < sim->point_count ? (uint32_t)end : sim->point_count;
}

static void factor_group(void *context, size_t group, unsigned worker)
{
    (void)worker;
    const struct group_job *job = context;
    const uint32_t begin = (uint32_t)group * SOLVER_GROUP, end = group_end(job->sim, group);
    job->solver->kernels->couple(job->sim, job->solver, begin, end);
    job->solver->kernels->factor(job->sim, job->solver, begin, end);
}

static bool tears(const struct sim *sim)
{
    bool tears = false;
    for (size_t i = 0; i < sim->balloon_count; i++)
        tears |= sim->balloons[i].topology != NULL;
    return tears;
}

void solver_prepare(struct sim *sim, struct solver *solver, double a, double b)
{
    solver->a = a;
    solver->b = b;
    if (tears(sim))
        find_links(sim, solver);
    sim_diagonal_blocks(sim, a, b, solver->inverse);
    threads_run(sim->pool, solver->group_count, factor_group, &(struct group_job){sim, solver, NULL, NULL});
}

static void precondition_group(void *context, size_t group, unsigned worker)
{
    (void)worker;
    const struct group_job *job = context;
    job->solver->kernels->precondition(job->solver, (uint32_t)group * SOLVER_GROUP,
                                       group_end(job->sim, group), job->x, job->y);
}

void solver_precondition(struct sim *sim, struct solver *solver, double (*x)[4], double (*y)[4])
{
    threads_run(sim->pool, solver->group_count, precondition_group, &(struct group_job){sim, solver, x, y});
}

static void finish_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct group_job *job = context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            job->y[p][i] = sim->mass[p] * job->x[p][i] - job->y[p][i];
}

/* y = P (M - a K - b D) x. */
static void apply(struct sim *sim, struct solver *solver, double (*x)[4], double (*y)[4])
{
    sim_force_product(sim, solver->a, x, solver->b, x, y);
    sim_each_part(sim, finish_part, &(struct group_job){sim, solver, x, y});
    solver_precondition(sim, solver, y, y);
}

struct addition {
    double (*y)[4], (*x)[4];
    double alpha;
};

/* y += alpha x; the sum of y . y. */
static double add_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    (void)sim;
    const struct addition o = *(struct addition *)context;
    double sum[4] = {0};
    for (uint32_t p = begin; p < end; p++)
        for (int i = 0; i < 4; i++) {
            o.y[p][i] += o.alpha * o.x[p][i];
            sum[i] += o.y[p][i] * o.y[p][i];
        }
    return sum[0] + sum[1] + sum[2];
}

static double add(struct sim *sim, double (*y)[4], double alpha, double (*x)[4])
{
    return vector_sum(sim, add_block, &(struct addition){y, x, alpha});
}

double solver_size(struct sim *sim, struct solver *solver, double (*x)[4])
{
    double(*y)[4] = solver->rows[SCRATCH];
    solver_precondition(sim, solver, x, y);
    return sqrt(vector_dot(sim, y, y) / sim->point_count);
}

/* One iteration: a step along the direction, and one that makes the residual least along its own image. rho
 * is the residual . shadow, before and after; returns the residual's square. */
static double iterate(struct sim *sim, struct solver *solver, double (*x)[4], double *rho)
{
    double(**row)[4] = solver->rows;
    apply(sim, solver, row[DIRECTION], row[MAPPED_DIRECTION]);
    const double alpha = *rho / vector_dot(sim, row[MAPPED_DIRECTION], row[SHADOW]);
    add(sim, row[RESIDUAL], -alpha, row[MAPPED_DIRECTION]);
    apply(sim, solver, row[RESIDUAL], row[MAPPED_RESIDUAL]);
    const double along = vector_dot(sim, row[MAPPED_RESIDUAL], row[RESIDUAL]);
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
    solver_precondition(sim, solver, rhs, row[RESIDUAL]);
    double rho = vector_dot(sim, row[RESIDUAL], row[RESIDUAL]), left = rho;
    const double enough = tolerance * tolerance * rho;
    vector_combine(sim, x, NULL, NULL, 0);
    vector_copy(sim, row[SHADOW], row[RESIDUAL]);
    vector_copy(sim, row[DIRECTION], row[RESIDUAL]);
    for (int i = 0; i < SOLVER_ITERATIONS_MAX && left > enough; i++)
        left = iterate(sim, solver, x, &rho);
    return left <= enough; /* false for NaN, too: BiCGSTAB breaks down when rho or omega becomes 0 */
}
