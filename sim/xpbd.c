/*
 * Position-based dynamics with compliant constraints: each spring with its damper is a constraint, solved by
 * itself, implicitly, one after the other, once in each of a few substeps. Never unstable with springs and
 * dampers however stiff, at the cost of an explicit method, and of first order. Its error: what all springs
 * do together (a balloon that swells) is not what one by one they do. There a spring acts as if softer, by 1
 * + (k h^2 + d h) (1/m_a + 1/m_b) in a substep of h: a few springs of any stiffness are as good as rigid, but
 * when it is most of them, there are more substeps. Pressure and what effects add are forces from outside, as
 * they are where a substep begins: these the guard looks after.
 *
 * Edges that meet cannot be solved at the same time. They are coloured so that no two of a colour
 * meet: those of a colour can be solved in any order, by any number of threads, to the same bits; the
 * colours follow each other.
 */
#include "common/array.h"
#include "common/threads.h"
#include "sim/bodies.h"
#include "sim/guard.h"
#include "sim/kernels.h"
#include "sim/methods.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>

enum {
    SUBSTEPS = 8,
    COLOURS = 64,
};

/* What is where in sim->scratch. */
enum {
    BEFORE, /* the positions where a substep begins */
    START_POSITION,
    START_VELOCITY, /* of the step, with its scalars */
    VECTORS
};

struct xpbd {
    uint32_t *edge;              /* [edge_count] by colour, in each in the tables' order */
    uint32_t begin[COLOURS + 1]; /* first of each colour in edge; those of the last may meet */
};

static uint32_t lowest_free(uint64_t used)
{
    uint32_t colour = 0;
    while (colour < COLOURS - 1 && used >> colour & 1)
        colour++;
    return colour;
}

/* Each edge in turn takes the first colour that none of those it meets has; with more than
 * COLOURS - 1, the last. */
static void colour_edges(const struct sim *sim, unsigned char *colour, uint64_t *used)
{
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        uint64_t *a = &used[sim->edge_point[e][0]], *b = &used[sim->edge_point[e][1]];
        colour[e] = (unsigned char)lowest_free(*a | *b);
        *a |= UINT64_C(1) << colour[e];
        *b |= UINT64_C(1) << colour[e];
    }
}

static void sort_edges(const struct sim *sim, struct xpbd *m, const unsigned char *colour)
{
    uint32_t place[COLOURS] = {0};
    for (uint32_t e = 0; e < sim->edge_count; e++)
        m->begin[colour[e] + 1]++;
    for (int c = 0; c < COLOURS; c++) {
        m->begin[c + 1] += m->begin[c];
        place[c] = m->begin[c];
    }
    for (uint32_t e = 0; e < sim->edge_count; e++)
        m->edge[place[colour[e]]++] = e;
}

static enum status open_xpbd(struct sim *sim, struct error *err)
{
    struct xpbd *m = calloc(1, sizeof *m);
    sim->method = m;
    unsigned char *colour = array_new(sim->edge_count, 1);
    uint64_t *used = calloc(sim->point_count, sizeof *used);
    if (m)
        m->edge = sim_table(sim, sim->edge_count, sizeof *m->edge);
    const bool room = m && m->edge && colour && used;
    if (room) {
        colour_edges(sim, colour, used);
        sort_edges(sim, m, colour);
    }
    free(colour);
    free(used);
    return room ? STATUS_OK : error_no_memory(err, "the integrator");
}

static void close_xpbd(struct sim *sim)
{
    struct xpbd *m = sim->method;
    if (m)
        free(m->edge);
    free(m);
    sim->method = NULL;
}

/* What acts on the points beside springs and dampers. */
static void outer_part(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)context;
    const struct sim_kernels *k = sim->kernels;
    const struct sim_chunk *next = part->chunks;
    for (const struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
        for (; kernels_skin_is_due(sim, part, next, c); next++) {
            k->clear_points(sim, next);
            if (part->balloon->arm_count > 0)
                k->arm_forces(sim, part, next);
        }
        kernels_press(k, sim, part, c);
    }
}

static void predict_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double h = *(double *)context;
    double(*before)[4] = sim->scratch[BEFORE];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++) {
            before[p][i] = sim->position[p][i];
            sim->velocity[p][i] += h / sim->mass[p] * sim->force[p][i];
            sim->position[p][i] += h * sim->velocity[p][i];
        }
}

/*
 * With C = |l| - r, its gradient u at a and -u at b, the stiffness k and the damping d,
 *     -s = (k h^2 C + d h u . (dx_a - dx_b)) / (1 + (k h^2 + d h) (1/m_a + 1/m_b)),    x_a += s u / m_a,   x_b -= s u / m_b
 * dx being the way since the substep began: equation 26 there, multiplied by the
 * stiffness so that it may be 0.
 */
static void solve_edge(struct sim *sim, uint32_t e, double damping, double h)
{
    double *a = sim->position[sim->edge_point[e][0]], *b = sim->position[sim->edge_point[e][1]];
    const double *a0 = sim->scratch[BEFORE][sim->edge_point[e][0]],
                 *b0 = sim->scratch[BEFORE][sim->edge_point[e][1]];
    const double wa = 1 / sim->mass[sim->edge_point[e][0]], wb = 1 / sim->mass[sim->edge_point[e][1]];
    const double l[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const double length = sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    if (!(length > 0))
        return;
    double way = 0; /* along l */
    for (int i = 0; i < 3; i++)
        way += l[i] * (l[i] - (a0[i] - b0[i]));
    const double kh2 = sim->current_spring_const[e] * h * h, dh = damping * h;
    const double s = (kh2 * (length - sim->rest_length[e]) + dh * way / length) /
                     (1 + (kh2 + dh) * (wa + wb)) / length;
    for (int i = 0; i < 3; i++) {
        a[i] -= s * wa * l[i];
        b[i] += s * wb * l[i];
    }
}

struct colour_job {
    struct sim *sim;
    double h;
    uint32_t begin, end;
};

static void solve_colour(void *context, unsigned worker, unsigned workers)
{
    const struct colour_job *job = context;
    const struct xpbd *m = job->sim->method;
    const struct sim_balloon *balloon = job->sim->balloons;
    const uint64_t count = job->end - job->begin;
    const uint32_t end = job->begin + (uint32_t)(count * (worker + 1) / workers);
    for (uint32_t i = job->begin + (uint32_t)(count * worker / workers); i < end; i++) {
        const uint32_t e = m->edge[i];
        while (e >= balloon->edge_end)
            balloon++;
        if (job->sim->edge_active[e])
            solve_edge(job->sim, e, balloon->now->damping, job->h);
    }
}

static void solve_edges(struct sim *sim, double h)
{
    const struct xpbd *m = sim->method;
    for (int c = 0; c < COLOURS; c++) {
        struct colour_job job = {sim, h, m->begin[c], m->begin[c + 1]};
        if (job.begin == job.end)
            continue;
        if (c < COLOURS - 1)
            threads_each(sim->pool, solve_colour, &job);
        else
            solve_colour(&job, 0, 1);
    }
}

static void velocity_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double h = *(double *)context;
    double(*before)[4] = sim->scratch[BEFORE];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            sim->velocity[p][i] = (sim->position[p][i] - before[p][i]) / h;
}

static void advance_scalars(struct sim *sim, double h)
{
    if (sim->scalar_count == 0)
        return;
    sim_forces(sim);
    sim_advance_scalars(sim, h);
}

/* The part of their stiffness that springs keep in substeps of h, the mean over the active ones. */
static double stiffness_kept(const struct sim *sim, double h)
{
    double kept = 0;
    uint32_t active = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
            const uint32_t *p = sim->edge_point[e];
            const double stiffness = (sim->current_spring_const[e] * h + b->now->damping) * h;
            if (sim->edge_active[e])
                kept += 1 / (1 + stiffness * (1 / sim->mass[p[0]] + 1 / sim->mass[p[1]]));
            active += sim->edge_active[e];
        }
    return active > 0 ? kept / active : 1;
}

/* The fewest substeps in which springs keep half of their stiffness; 0: there would be too many. */
static int count_substeps(const struct sim *sim, double dt)
{
    int count = SUBSTEPS;
    while (stiffness_kept(sim, dt / count) < 0.5)
        if ((count *= 2) > GUARD_PARTS_MAX)
            return 0;
    return count;
}

/* The largest step, by halves of dt, that GUARD_PARTS_MAX are enough for. */
static double largest_step(const struct sim *sim, double dt)
{
    while (stiffness_kept(sim, dt / GUARD_PARTS_MAX) < 0.5)
        dt /= 2;
    return dt;
}

static void substep(struct sim *sim, double h)
{
    advance_scalars(sim, h);
    sim_each_part(sim, outer_part, NULL);
    effects_run(sim, EFFECT_FORCES);
    sim->evaluations++;
    sim_each_part(sim, predict_part, &h);
    solve_edges(sim, h);
    sim_each_part(sim, velocity_part, &h);
}

static enum status xpbd(struct sim *sim, double dt, struct error *err)
{
    const int count = count_substeps(sim, dt);
    if (count == 0)
        return error_set(
            err, STATUS_DIVERGED,
            "%s: at time %g xpbd would need more than %d substeps in a step of %g for these springs, "
            "dampers and masses; a time.step of %.3g would do, or backward-euler",
            sim->scene->path, sim->time, GUARD_PARTS_MAX, dt, largest_step(sim, dt));
    const bool is_long = count > SUBSTEPS;
    if (is_long)
        vector_keep_state(sim, START_POSITION);
    for (int i = 0; i < count; i++) {
        if (is_long && !sim_goes_on(sim)) {
            vector_return_to(sim, START_POSITION);
            return error_set(err, STATUS_INTERRUPTED, "interrupted at %g s", sim->time);
        }
        substep(sim, dt / count);
    }
    return STATUS_OK;
}

const struct integrator integrator_xpbd = {
    .name = "xpbd",
    .order = 1,
    .flags = INTEGRATOR_IMPLICIT | INTEGRATOR_SPRINGS_ONLY,
    .vectors = VECTORS,
    .oscillation_limit = INFINITY,
    .decay_limit = INFINITY,
    .outer_limit = 2 * SUBSTEPS, /* of symplectic Euler, in each substep */
    .open = open_xpbd,
    .close = close_xpbd,
    .advance = xpbd,
    .source = "Macklin, Mueller and Chentanez, MIG 2016, 49; substeps: Macklin et al., SCA 2019, 2"};
