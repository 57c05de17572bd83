/* The linear systems of implicit methods, on one core: what each solver takes to come within 1e-4 of the
 * solution of Newton's first step. bench_linear MESH
 *
 * bicgstab and gmres (restarted after 30) are preconditioned by the DILU of solver.h; cholesky is gmres
 * preconditioned by the exact factors of the system's symmetric part without pressure off the diagonal, by
 * CHOLMOD, of which preparing is factoring alone: finding where its factors have numbers is needed once a
 * mesh. Without pressure and dampers the system is symmetric, and cg is there too. */
#include "sim/jacobian.h"
#include "sim/jacobian_kernels.h"
#include "sim/solver.h"
#include "sim/vectors.h"
#include "stiff_sphere.h"
#include "support/shapes.h"

#include <math.h>
#include <string.h>
#ifdef BENCH_CHOLMOD
#include <suitesparse/cholmod.h>
#endif

enum { RESTART = 30, BASIS = RESTART + 1 };

struct system {
    struct sim sim;
    struct scene scene;
    struct solver solver;
    double a, b;
    double (*rhs)[4], (*exact)[4], (*x)[4], (*residual)[4], (*basis[BASIS])[4]; /* [point_count] */
    void (*precondition)(struct system *s, double (*x)[4], double (*y)[4]);
    unsigned products;
#ifdef BENCH_CHOLMOD
    cholmod_common common;
    cholmod_sparse *matrix;
    cholmod_factor *factor;
    cholmod_dense *dense, *solution, *work[2];
#endif
};

static void dilu(struct system *s, double (*x)[4], double (*y)[4])
{
    solver_precondition(&s->sim, &s->solver, x, y);
}

/* y = (M - a K - b D) x. */
static void multiply(struct system *s, double (*x)[4], double (*y)[4])
{
    sim_force_product(&s->sim, s->a, x, s->b, x, y);
    for (uint32_t p = 0; p < s->sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            y[p][i] = s->sim.mass[p] * x[p][i] - y[p][i];
    s->products++;
}

static double norm(struct system *s, double (*x)[4])
{
    return sqrt(vector_dot(&s->sim, x, x));
}

static bool bicgstab(struct system *s, double tolerance)
{
    const uint64_t before = s->sim.products;
    const bool good = solver_solve(&s->sim, &s->solver, s->rhs, s->x, tolerance);
    s->products += (unsigned)(s->sim.products - before);
    return good;
}

/* Turns column k of the triangle by the rotations before it, and by a new one that makes its last number 0;
 * and the right-hand side. */
static void rotate(double column[BASIS], int k, double turn[RESTART][2], double side[BASIS])
{
    for (int i = 0; i < k; i++) {
        const double upper = column[i], lower = column[i + 1];
        column[i] = turn[i][0] * upper + turn[i][1] * lower;
        column[i + 1] = turn[i][0] * lower - turn[i][1] * upper;
    }
    const double length = hypot(column[k], column[k + 1]);
    turn[k][0] = column[k] / length;
    turn[k][1] = column[k + 1] / length;
    column[k] = length;
    side[k + 1] = -turn[k][1] * side[k];
    side[k] *= turn[k][0];
}

/* One round: x becomes what makes the preconditioned residual least among x + its Krylov space.
 * Returns that residual. */
static double gmres_round(struct system *s, double enough)
{
    double triangle[RESTART][BASIS] = {0}, turn[RESTART][2], side[BASIS] = {norm(s, s->basis[0])};
    int k = 0;
    vector_combine(&s->sim, s->basis[0], NULL, (struct vector_term[]){{1 / side[0], s->basis[0]}}, 1);
    while (k < RESTART && fabs(side[k]) > enough) {
        double(*next)[4] = s->basis[k + 1];
        multiply(s, s->basis[k], s->residual);
        s->precondition(s, s->residual, next);
        for (int i = 0; i <= k; i++) {
            triangle[k][i] = vector_dot(&s->sim, next, s->basis[i]);
            vector_add(&s->sim, next, -triangle[k][i], s->basis[i]);
        }
        triangle[k][k + 1] = norm(s, next);
        vector_combine(&s->sim, next, NULL, (struct vector_term[]){{1 / triangle[k][k + 1], next}}, 1);
        rotate(triangle[k], k, turn, side);
        k++;
    }
    const double left = fabs(side[k]);
    for (int i = k; i-- > 0;) {
        for (int j = i + 1; j < k; j++)
            side[i] -= triangle[j][i] * side[j];
        side[i] /= triangle[i][i];
        vector_add(&s->sim, s->x, side[i], s->basis[i]);
    }
    return left;
}

/* Saad & Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856. */
static bool gmres(struct system *s, double tolerance)
{
    vector_combine(&s->sim, s->x, NULL, NULL, 0);
    s->precondition(s, s->rhs, s->basis[0]);
    const double enough = tolerance * norm(s, s->basis[0]);
    double left = INFINITY;
    while (s->products < 2 * SOLVER_ITERATIONS_MAX) {
        left = gmres_round(s, enough);
        if (!(left > enough))
            break;
        multiply(s, s->x, s->residual);
        vector_combine(&s->sim, s->residual, s->rhs, (struct vector_term[]){{-1, s->residual}}, 1);
        s->precondition(s, s->residual, s->basis[0]);
    }
    return left <= enough;
}

/* Hestenes & Stiefel, with the same preconditioner, which is as symmetric as the system. */
static bool cg(struct system *s, double tolerance)
{
    double(*direction)[4] = s->basis[0], (*mapped)[4] = s->basis[1], (*solved)[4] = s->basis[2];
    vector_combine(&s->sim, s->x, NULL, NULL, 0);
    vector_copy(&s->sim, s->residual, s->rhs);
    s->precondition(s, s->residual, solved);
    vector_copy(&s->sim, direction, solved);
    double rho = vector_dot(&s->sim, s->residual, solved);
    const double enough = tolerance * norm(s, solved);
    while (s->products < 2 * SOLVER_ITERATIONS_MAX && norm(s, solved) > enough) {
        multiply(s, direction, mapped);
        const double alpha = rho / vector_dot(&s->sim, direction, mapped), before = rho;
        vector_add(&s->sim, s->x, alpha, direction);
        vector_add(&s->sim, s->residual, -alpha, mapped);
        s->precondition(s, s->residual, solved);
        rho = vector_dot(&s->sim, s->residual, solved);
        vector_combine(&s->sim, direction, solved, (struct vector_term[]){{rho / before, direction}}, 1);
    }
    return norm(s, solved) <= enough;
}

static bool prepare_dilu(struct system *s)
{
    s->precondition = dilu;
    solver_prepare(&s->sim, &s->solver, s->a, s->b);
    return true;
}

#ifdef BENCH_CHOLMOD
static void cholesky(struct system *s, double (*x)[4], double (*y)[4])
{
    double *in = s->dense->x;
    for (uint32_t p = 0; p < s->sim.point_count; p++)
        memcpy(&in[3 * p], x[p], 3 * sizeof *in);
    cholmod_solve2(CHOLMOD_A, s->factor, s->dense, NULL, &s->solution, NULL, &s->work[0], &s->work[1],
                   &s->common);
    const double *out = s->solution->x;
    for (uint32_t p = 0; p < s->sim.point_count; p++)
        memcpy(y[p], &out[3 * p], 3 * sizeof *out);
}

/* The lower triangle's part of a block; numbers are added up where a place comes twice. */
static void put(cholmod_triplet *t, uint32_t row, uint32_t column, int i, int j, double number)
{
    ((int *)t->i)[t->nnz] = (int)(3 * row) + i;
    ((int *)t->j)[t->nnz] = (int)(3 * column) + j;
    ((double *)t->x)[t->nnz++] = number;
}

/* An edge's block is -B, B = u (a g + b d u)^T + a t (jacobian_kernels.h). */
static void put_edge(const struct system *s, cholmod_triplet *t, uint32_t e)
{
    const double *u = s->sim.jacobian->edge[e], *g = u + 4;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            put(t, s->sim.edge_point[e][1], s->sim.edge_point[e][0], i, j,
                -(s->a * (u[i] * g[j] + u[j] * g[i]) / 2 + s->b * g[3] * u[i] * u[j] +
                  (i == j ? s->a * u[3] : 0)));
}

static cholmod_sparse *make_matrix(struct system *s)
{
    const size_t points = s->sim.point_count, most = 6 * points + 9 * (size_t)s->sim.edge_count;
    cholmod_triplet *t = cholmod_allocate_triplet(3 * points, 3 * points, most, -1, CHOLMOD_REAL, &s->common);
    double(*block)[3][4] = sim_table(&s->sim, points, sizeof *block);
    if (!t || !block)
        return NULL;
    sim_diagonal_blocks(&s->sim, s->a, s->b, block);
    for (uint32_t p = 0; p < points; p++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j <= i; j++)
                put(t, p, p, i, j, (block[p][i][j] + block[p][j][i]) / 2);
    for (uint32_t e = 0; e < s->sim.edge_count; e++)
        put_edge(s, t, e);
    cholmod_sparse *matrix = cholmod_triplet_to_sparse(t, most, &s->common);
    cholmod_free_triplet(&t, &s->common);
    free(block);
    return matrix;
}

static bool prepare_cholesky(struct system *s)
{
    s->precondition = cholesky;
    cholmod_free_sparse(&s->matrix, &s->common);
    s->matrix = make_matrix(s);
    if (s->matrix && !s->factor)
        s->factor = cholmod_analyze(s->matrix, &s->common);
    return s->factor && cholmod_factorize(s->matrix, s->factor, &s->common) &&
           s->factor->minor == s->matrix->nrow;
}

static void open_cholesky(struct system *s)
{
    const size_t rows = 3 * (size_t)s->sim.point_count;
    cholmod_start(&s->common);
    s->common.print = 0;
    s->dense = cholmod_allocate_dense(rows, 1, rows, CHOLMOD_REAL, &s->common);
}

static void close_cholesky(struct system *s)
{
    cholmod_free_sparse(&s->matrix, &s->common);
    cholmod_free_factor(&s->factor, &s->common);
    cholmod_dense **all[] = {&s->dense, &s->solution, &s->work[0], &s->work[1]};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        cholmod_free_dense(all[i], &s->common);
    cholmod_finish(&s->common);
}
#endif

struct method {
    const char *name;
    bool (*prepare)(struct system *s);
    bool (*solve)(struct system *s, double tolerance);
    bool symmetric; /* for symmetric systems only */
};
static const struct method methods[] = {{"bicgstab", prepare_dilu, bicgstab, false},
                                        {"gmres", prepare_dilu, gmres, false},
#ifdef BENCH_CHOLMOD
                                        {"cholesky", prepare_cholesky, gmres, false},
#endif
                                        {"cg", prepare_dilu, cg, true}};

static void open_system(struct system *s, const struct mesh *mesh, double contrast, double step,
                        bool symmetric)
{
    struct error err = {0};
    stiff_sphere_open("backward-euler", contrast, mesh, &s->scene, &s->sim);
    bench_check(solver_open(&s->sim, &s->solver, &err), &err);
    double(**rows[])[4] = {&s->rhs, &s->exact, &s->x, &s->residual};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        *rows[i] = sim_table(&s->sim, s->sim.point_count, sizeof **rows[i]);
    for (int i = 0; i < BASIS; i++)
        s->basis[i] = sim_table(&s->sim, s->sim.point_count, sizeof *s->basis[i]);
    for (int i = 0; i < 2; i++) /* away from rest */
        bench_check(sim_step(&s->sim, &err), &err);
    if (symmetric)
        s->sim.settings->pressure = s->sim.settings->damping = 0;
    s->a = step * step;
    s->b = step;
    sim_forces(&s->sim);
    vector_combine(&s->sim, s->rhs, NULL, (struct vector_term[]){{step, s->sim.force}}, 1);
    sim_linearise(&s->sim);
#ifdef BENCH_CHOLMOD
    open_cholesky(s);
#endif
}

static void close_system(struct system *s)
{
#ifdef BENCH_CHOLMOD
    close_cholesky(s);
#endif
    double(*rows[])[4] = {s->rhs, s->exact, s->x, s->residual};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        free(rows[i]);
    for (int i = 0; i < BASIS; i++)
        free(s->basis[i]);
    solver_close(&s->solver);
    sim_clear(&s->sim);
    scene_clear(&s->scene);
}

static double error_of(struct system *s)
{
    vector_combine(&s->sim, s->residual, s->x, (struct vector_term[]){{-1, s->exact}}, 1);
    return norm(s, s->residual) / norm(s, s->exact);
}

/* The loosest tolerance that comes near enough, and what it costs then. */
static void bench_method(struct system *s, const struct method *m)
{
    double began = bench_thread_seconds();
    bool good = m->prepare(s); /* and what is made but once */
    if (good) {
        began = bench_thread_seconds();
        good = m->prepare(s);
    }
    const double prepared = bench_thread_seconds();
    double error = INFINITY, spent = 0;
    for (double tolerance = 1e-2; good && error > 1e-4 && tolerance > 1e-13; tolerance /= 10) {
        s->products = 0;
        const double start = bench_thread_seconds();
        good = m->solve(s, tolerance);
        spent = bench_thread_seconds() - start;
        error = error_of(s);
    }
    printf("  %-8s", m->name);
    if (good && error <= 1e-4)
        printf("  %8u  %10.2f  %8.2f  %8.2f  %7.0e\n", s->products, 1e3 * (prepared - began), 1e3 * spent,
               1e3 * (prepared - began + spent), error);
    else
        printf("  finds no solution\n");
}

static void bench(const struct mesh *mesh, double contrast, double step, bool symmetric)
{
    struct system s = {0};
    open_system(&s, mesh, contrast, step, symmetric);
    prepare_dilu(&s);
    bool known = gmres(&s, 1e-11);
    vector_copy(&s.sim, s.exact, s.x);
    known &= bicgstab(&s, 1e-11) && error_of(&s) < 1e-6; /* two that agree */
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++)
        if (symmetric || !methods[i].symmetric) {
            printf("%9u  %8.0e  %6g  %-9s", mesh->triangle_count, contrast, step, symmetric ? "yes" : "no");
            if (known)
                bench_method(&s, &methods[i]);
            else
                printf("  %-8s  the solution is not known well enough\n", methods[i].name);
        }
    close_system(&s);
}

static void bench_mesh(struct mesh *mesh)
{
    static const double contrast[] = {1, 1e3, 1e6}, step[] = {.025, .25, 2.5};
    for (size_t c = 0; c < 3; c++)
        for (size_t t = 0; t < 3; t++)
            for (int symmetric = 0; symmetric < 2; symmetric++)
                bench(mesh, contrast[c], step[t], symmetric);
    mesh_clear(mesh);
}

int main(int argc, char **argv)
{
    struct error err = {0};
    struct mesh mesh = {0};
    printf(
        "triangles  contrast  step/s  symmetric  solver    products  prepare/ms  solve/ms    all/ms    error\n");
    if (argc > 1) {
        bench_check(mesh_load(argv[1], &mesh, &err), &err);
        bench_check(mesh_connect(&mesh, &err), &err);
        bench_check(mesh_order(&mesh, &err), &err);
        bench_mesh(&mesh);
    }
    for (unsigned level = 4; level <= 6; level += 2) { /* 5 and 82 thousand triangles */
        shape_icosphere(level, &mesh);
        bench_check(mesh_order(&mesh, &err), &err);
        bench_mesh(&mesh);
    }
    return 0;
}
