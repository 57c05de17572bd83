#include "sim/solver.h"
#include "common/threads.h"
#include "sim/jacobian.h"
#include "sim/jacobian_kernels.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESIDUAL, SHADOW, DIRECTION, MAPPED_DIRECTION, MAPPED_RESIDUAL, SCRATCH };

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
    solver->group_count = sim->point_count / SOLVER_GROUP + 1;
    solver->link = sim_table(sim, sim->edge_count, sizeof *solver->link);
    solver->first_link = sim_table(sim, sim->point_count + (size_t)1, sizeof *solver->first_link);
    solver->inverse = sim_table(sim, sim->point_count, sizeof *solver->inverse);
    bool room = solver->link && solver->first_link && solver->inverse;
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
    free(solver->inverse);
    for (int i = 0; i < SOLVER_ROWS; i++)
        free(solver->rows[i]);
    *solver = (struct solver){0};
}

/* By its adjugate. A block that has no inverse in numbers becomes the unit matrix over the mass: any
 * preconditioner is right, only not as fast. */
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

struct group_job {
    struct sim *sim;
    struct solver *solver;
    double (*x)[4], (*y)[4];
};

/* Edges as the preconditioner sees them: y += B x, where -B is the system's block between an edge's ends,
 * either way, without pressure's share. */
static inline void add_coupling(const struct solver *s, const double edge[8], const double x[4], double y[4])
{
    const double *u = edge, *g = edge + 4, t = s->a * edge[3];
    const double along = s->a * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]) +
                         s->b * g[3] * (u[0] * x[0] + u[1] * x[1] + u[2] * x[2]);
    for (int i = 0; i < 3; i++)
        y[i] += along * u[i] + t * x[i];
}

static inline void multiply(const double block[3][4], const double x[4], double y[4])
{
    for (int i = 0; i < 3; i++)
        y[i] = block[i][0] * x[0] + block[i][1] * x[1] + block[i][2] * x[2];
}

/* What eliminating an edge's lower point does to the block of the upper one: block -= B
 * inverse B, column by column. */
static void eliminate(const struct solver *s, const double edge[8], const double inverse[3][4],
                      double block[3][4])
{
    for (int j = 0; j < 3; j++) {
        double unit[4] = {0}, column[4] = {0}, solved[4], change[4] = {0};
        unit[j] = 1;
        add_coupling(s, edge, unit, column);
        multiply(inverse, column, solved);
        add_coupling(s, edge, solved, change);
        for (int i = 0; i < 3; i++)
            block[i][j] -= change[i];
    }
}

static uint32_t group_end(const struct sim *sim, size_t group)
{
    const uint64_t end = (uint64_t)(group + 1) * SOLVER_GROUP;
    return end < sim->point_count ? (uint32_t)end : sim->point_count;
}

static void factor_group(void *context, size_t group, unsigned worker)
{
    (void)worker;
    const struct group_job *job = context;
    const struct sim *sim = job->sim;
    const struct solver *s = job->solver;
    double(*block)[3][4] = s->inverse;
    const uint32_t end = group_end(sim, group);
    for (uint32_t p = (uint32_t)group * SOLVER_GROUP; p < end; p++) {
        invert(block[p], sim->mass[p]);
        for (const struct solver_link *l = s->link + s->first_link[p]; l < s->link + s->first_link[p + 1];
             l++)
            if (l->upper < end && sim->edge_active[l->edge])
                eliminate(s, sim->jacobian->edge[l->edge], (const double(*)[4])block[p], block[l->upper]);
    }
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

/* y = P x, on one group: down through the points as they are numbered, and up again. */
static void precondition_group(void *context, size_t group, unsigned worker)
{
    (void)worker;
    const struct group_job *job = context;
    const struct sim *sim = job->sim;
    const struct solver *s = job->solver;
    const struct solver_link *link = s->link;
    const double(*inverse)[3][4] = (const double(*)[3][4])s->inverse,
          (*edge)[8] = (const double(*)[8])sim->jacobian->edge;
    double(*y)[4] = job->y;
    const uint32_t begin = (uint32_t)group * SOLVER_GROUP, end = group_end(sim, group),
                   *first = s->first_link;
    for (uint32_t p = begin; p < end; p++)
        memcpy(y[p], job->x[p], sizeof y[p]);
    for (uint32_t p = begin; p < end; p++) {
        const double sum[4] = {y[p][0], y[p][1], y[p][2]};
        multiply(inverse[p], sum, y[p]);
        for (uint32_t i = first[p]; i < first[p + 1]; i++)
            if (link[i].upper < end)
                add_coupling(s, edge[link[i].edge], y[p], y[link[i].upper]);
    }
    for (uint32_t p = end; p-- > begin;) {
        double sum[4] = {0}, change[4];
        for (uint32_t i = first[p + 1]; i-- > first[p];)
            if (link[i].upper < end)
                add_coupling(s, edge[link[i].edge], y[link[i].upper], sum);
        multiply(inverse[p], sum, change);
        for (int i = 0; i < 3; i++)
            y[p][i] += change[i];
    }
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
