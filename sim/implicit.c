#include "sim/implicit.h"
#include "sim/bodies.h"
#include "sim/guard.h"
#include "sim/jacobian.h"
#include "sim/ledger.h"
#include "sim/reorder.h"
#include "sim/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rounding of places, by forces that a whole skin adds up, moves them by so many times as much: corrections
 * of stiff skins that no longer shrink, and are no larger, are noise. */
enum { NEWTON_ITERATIONS_MAX = 12, NOISE = 64 };

/* Parts of a step that are so short may turn edges: of those that go through themselves they always do. */
enum { TURN_PARTS = 1024 };

/* The residual that a linear solve leaves, and what of the first correction may be left when
 * Newton's method stops. With 1e-3 or 1e-5 for the former, a step took a tenth less or more time, on
 * balloons of 2562 points. */
static const double linear_tolerance = 1e-4, newton_tolerance = 1e-6;

enum status implicit_open(struct sim *sim, struct error *err)
{
    struct implicit *m = calloc(1, sizeof *m);
    sim->method = m;
    if (!m)
        return error_no_memory(err, "the integrator");
    m->turned = calloc(sim->part_count, sizeof *m->turned);
    enum status status = m->turned ? sim_jacobian_open(sim, err) : error_no_memory(err, "the integrator");
    return status ? status : solver_open(sim, &m->solver, err);
}

void implicit_close(struct sim *sim)
{
    struct implicit *m = sim->method;
    if (m) {
        solver_close(&m->solver);
        free(m->turned);
    }
    sim_jacobian_close(sim);
    free(m);
    sim->method = NULL;
}

void implicit_base(struct sim *sim, double ahead)
{
    double(**row)[4] = sim->scratch;
    double(*acceleration)[4] = row[IMPLICIT_BASE_VELOCITY],
    *scalar = sim->scalar_scratch[IMPLICIT_BASE_VELOCITY];
    vector_combine(sim, row[IMPLICIT_BASE_POSITION], sim->position,
                   (struct vector_term[]){{ahead, sim->velocity}}, 1);
    if (ahead != 0)
        vector_over_mass(sim, acceleration, sim->force);
    vector_combine(sim, acceleration, sim->velocity, (struct vector_term[]){{ahead, acceleration}}, 1);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        scalar[i] = sim->scalar[i] + ahead * sim->scalar_rate[i];
}

/* As y + w (y - start), so that what has not moved does not move. */
static void extrapolate_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double w = *(double *)context;
    double(*x)[4] = sim->scratch[IMPLICIT_START_POSITION], (*v)[4] = sim->scratch[IMPLICIT_START_VELOCITY];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++) {
            sim->position[p][i] += w * (sim->position[p][i] - x[p][i]);
            sim->velocity[p][i] += w * (sim->velocity[p][i] - v[p][i]);
        }
}

void implicit_extrapolate(struct sim *sim, double w)
{
    const double *start = sim->scalar_scratch[IMPLICIT_START_VELOCITY];
    sim_each_part(sim, extrapolate_part, &w);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] += w * (sim->scalar[i] - start[i]);
}

static void place_points(struct sim *sim, double c)
{
    vector_combine(sim, sim->position, sim->scratch[IMPLICIT_BASE_POSITION],
                   (struct vector_term[]){{c, sim->velocity}}, 1);
}

/* Speeds by their rates, and places by those speeds: so a body that swings settles in the square of what it
 * takes where places go by speeds of before. Returns how far the farthest moved, beyond rounding. */
static double follow_bodies(struct sim *sim, double c, const double *base)
{
    double farthest = 0;
    for (uint32_t n = 0; n < sim->body_count; n++) {
        const uint32_t first = sim->body[n].first;
        double moved = 0, size = 0;
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t at = first + SIM_BODY_PLACE + i, going = first + SIM_BODY_SPEED + i;
            double *place = &sim->scalar[at], *speed = &sim->scalar[going];
            const double before = *place;
            *speed = base[going] + c * sim->scalar_rate[going];
            *place = base[at] + c * *speed;
            moved += (*place - before) * (*place - before);
            size += *place * *place;
        }
        if (!(moved <= 0x1p-100 * size))
            farthest = fmax(farthest, sqrt(moved));
    }
    return farthest;
}

struct change {
    double scalar; /* the largest of one against its size, of those that are of no body */
    double body;   /* the farthest way of one */
};

/* Scalars by their rates. */
static struct change follow_scalars(struct sim *sim, double c)
{
    const double *base = sim->scalar_scratch[IMPLICIT_BASE_VELOCITY];
    double change = 0;
    const double way = follow_bodies(sim, c, base);
    for (uint32_t i = 0; i < sim->scalar_count; i++) {
        if (sim_body_of(sim, i))
            continue;
        const double scalar = base[i] + c * sim->scalar_rate[i];
        if (i < sim_state_scalars(sim)) /* what only records must not decide when the iteration ends */
            change = fmax(change, fabs(scalar - sim->scalar[i]) / fmax(fabs(scalar), fabs(base[i])));
        sim->scalar[i] = scalar;
    }
    return (struct change){change, way};
}

/* Forces at the present guess, and scalars by their rates there. */
static struct change evaluate(struct sim *sim, double c)
{
    sim_forces(sim);
    return follow_scalars(sim, c);
}

/* The same at the solution, for scalars alone: forces that only the accounts need leave no trace. */
static void evaluate_scalars(struct sim *sim, double c)
{
    if (sim_state_scalars(sim) > 0)
        sim_forces(sim);
    else if (sim->ledger.on)
        ledger_forces(sim);
    follow_scalars(sim, c);
}

/* rhs = M (V - v) + c f. */
static void residual_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const double c = *(double *)context;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS], (*base)[4] = sim->scratch[IMPLICIT_BASE_VELOCITY];
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            rhs[p][i] = sim->mass[p] * (base[p][i] - sim->velocity[p][i]) + c * sim->force[p][i];
}

static double rms(struct sim *sim, double (*x)[4])
{
    return sqrt(vector_dot(sim, x, x) / sim->point_count);
}

/* The change of places that rounding alone makes: a few units in the last place of the RMS position. */
static double rounding(struct sim *sim, double c)
{
    return 4 * 0x1p-52 * (rms(sim, sim->position) + c * rms(sim, sim->velocity));
}

/* Remembers which point is furthest from a solution, for the message. */
static void note_worst(struct sim *sim, bool is_linear)
{
    struct implicit *m = sim->method;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS];
    m->is_linear = is_linear;
    m->worst = -1;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double size = sqrt(rhs[p][0] * rhs[p][0] + rhs[p][1] * rhs[p][1] + rhs[p][2] * rhs[p][2]);
        if (!(size / sim->mass[p] <= m->worst)) {
            m->worst = size / sim->mass[p];
            m->worst_point = p;
        }
        if (!isfinite(m->worst))
            return;
    }
}

bool implicit_correct(struct sim *sim, double c, double tolerance)
{
    struct implicit *m = sim->method;
    double(*rhs)[4] = sim->scratch[IMPLICIT_RHS], (*change)[4] = sim->scratch[IMPLICIT_CHANGE];
    if (solver_solve(sim, &m->solver, rhs, change, tolerance))
        return true;
    vector_combine(sim, change, NULL, NULL, 0);
    if (c * solver_size(sim, &m->solver, rhs) <= NOISE * rounding(sim, c))
        return true;
    note_worst(sim, true);
    return false;
}

/* One of Newton's steps; *size becomes the RMS change of place. */
static bool newton(struct sim *sim, double c, double *size)
{
    struct implicit *m = sim->method;
    double(*change)[4] = sim->scratch[IMPLICIT_CHANGE];
    sim_each_part(sim, residual_part, &c);
    sim_linearise(sim);
    solver_prepare(sim, &m->solver, c * c, c);
    if (!implicit_correct(sim, c, linear_tolerance))
        return false;
    vector_add(sim, sim->velocity, 1, change);
    place_points(sim, c);
    *size = c * rms(sim, change);
    return isfinite(*size);
}

bool implicit_solve(struct sim *sim, double c)
{
    double first = 0, first_way = 0, before = INFINITY, size;
    place_points(sim, c);
    for (int i = 0; i < NEWTON_ITERATIONS_MAX; i++, before = size) {
        const struct change change = evaluate(sim, c);
        if (!newton(sim, c, &size))
            return false;
        const bool grows = i > 1 && size > before, is_noise = grows && size <= NOISE * rounding(sim, c);
        if (grows && !is_noise)
            break;
        first = fmax(first, size);
        const double left = i == 0 ? linear_tolerance * size : size * (size / before);
        const bool is_small = is_noise || (i > 0 && left <= newton_tolerance * first);
        first_way = fmax(first_way, change.body);
        const bool is_still = change.body <= newton_tolerance * first_way;
        if (is_still && ((is_small && change.scalar <= newton_tolerance) || size <= rounding(sim, c))) {
            evaluate_scalars(sim, c);
            return true;
        }
    }
    note_worst(sim, false);
    return false;
}

/* Whose equations were furthest from solved. */
static const struct sim_balloon *worst_balloon(const struct sim *sim)
{
    const struct implicit *m = sim->method;
    const struct sim_balloon *b = sim->balloons;
    while (b + 1 < sim->balloons + sim->balloon_count && m->worst_point >= b->point_end)
        b++;
    return b;
}

static enum status give_up(struct sim *sim, double dt, struct error *err)
{
    const struct implicit *m = sim->method;
    const struct sim_balloon *b = worst_balloon(sim);
    const double *x = sim->position[m->worst_point];
    const bool chosen = sim->acting != sim->integrator;
    return error_set(
        err, STATUS_DIVERGED,
        "%s: diverged at time %g (step %llu): %s%s%s%s finds no solution even over %.3g s, a millionth "
        "of the step of %g; furthest from one is point %u of balloons[%zu] at (%g, %g, %g), by an "
        "acceleration of %.3g; %s",
        sim->scene->path, sim->time, (unsigned long long)sim->steps, sim->acting->name,
        chosen ? " (chosen by " : "", chosen ? sim->integrator->name : "", chosen ? ")" : "",
        dt / GUARD_PARTS_MAX, dt, reorder_name(b, m->worst_point), (size_t)(b - sim->balloons), x[0], x[1],
        x[2], m->worst * GUARD_PARTS_MAX / dt,
        m->is_linear
            ? "what is stiff there is too stiff for 16 digits: softer, heavier or shorter steps will do"
            : "forces that change this fast want another integrator, or other springs, masses or pressure");
}

static void turning_part(struct sim *sim, const struct sim_part *part, void *context)
{
    double(*x)[4] = sim->position, (*start)[4] = sim->scratch[IMPLICIT_START_POSITION];
    bool turned = false;
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++) {
        const uint32_t a = sim->edge_point[e][0], b = sim->edge_point[e][1];
        double along = 0, squares = 0;
        for (int i = 0; i < 3; i++) {
            const double l = start[a][i] - start[b][i];
            along += l * (x[a][i] - x[b][i]);
            squares += l * l;
        }
        turned |= sim->edge_active[e] && !(along >= -0.1 * squares);
    }
    ((bool *)context)[part - sim->parts] = turned;
}

/* Whether an edge points backwards after a step: equations of long steps have more solutions than the one
 * that is the end of a way, with triangles inside out and springs through themselves. */
static bool has_turned(struct sim *sim)
{
    struct implicit *m = sim->method;
    bool turned = false;
    sim_each_part(sim, turning_part, m->turned);
    for (size_t i = 0; i < sim->part_count; i++)
        turned |= m->turned[i];
    return turned;
}

/* Whether a trial has had enough of this method. */
static bool is_too_dear(const struct sim *sim)
{
    const struct implicit *m = sim->method;
    return m->iterations_most && m->solver.iterations > m->iterations_most;
}

/* The step is taken in parts from here on: what it began with is kept for whoever ends it half-way. */
static void begin_parts(struct sim *sim)
{
    struct implicit *m = sim->method;
    m->in_parts++;
    vector_keep_state(sim, IMPLICIT_WHOLE_POSITION);
    if (!m->iterations_most && !m->told)
        sim_tell(sim, worst_balloon(sim), sim->acting->name,
                 "finds no solution over a whole step, which it takes in halves, or halves of those");
    m->told |= !m->iterations_most;
}

static enum status end_half_way(struct sim *sim, struct error *err)
{
    vector_return_to(sim, IMPLICIT_WHOLE_POSITION);
    return error_set(err, STATUS_INTERRUPTED, "interrupted at %g s", sim->time);
}

enum status implicit_step(struct sim *sim, double dt, bool (*take)(struct sim *sim, double h),
                          struct error *err)
{
    const unsigned whole = GUARD_PARTS_MAX; /* in parts of dt that are not halved any more */
    unsigned place = 0, size = whole;
    while (place < whole) {
        vector_keep_state(sim, IMPLICIT_START_POSITION);
        if (!is_too_dear(sim) && take(sim, dt * size / whole) &&
            (size <= whole / TURN_PARTS || !has_turned(sim))) {
            place += size;
            while (place % (2 * size) == 0 && place < whole)
                size *= 2; /* what was difficult is over */
        } else {
            vector_return_to(sim, IMPLICIT_START_POSITION);
            if (size == 1 || is_too_dear(sim))
                return give_up(sim, dt, err);
            if (size == whole)
                begin_parts(sim);
            size /= 2;
        }
        if (place < whole && !sim_goes_on(sim))
            return end_half_way(sim, err);
    }
    return STATUS_OK;
}
