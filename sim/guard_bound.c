#include "sim/guard_bound.h"
#include "sim/membrane.h"

#include <math.h>
#include <string.h>

/* What a point's sums count for: damping h + growth h + stiffness h^2 must not pass 1. */
struct limits {
    double damping;   /* 1/d */
    double stiffness; /* 1/w^2 */
    double growth;    /* end/2 in its place, where no step is stable */
};

/* Springs and dampers are stable at any step, and left out. */
static bool is_outer_only(const struct sim *sim)
{
    return sim->acting->outer_limit > 0;
}

static struct limits limits_of(const struct sim *sim)
{
    const struct integrator *method = sim->acting;
    const double w = is_outer_only(sim) ? method->outer_limit : method->oscillation_limit;
    struct limits l = {.damping = 1 / (is_outer_only(sim) ? method->outer_limit : method->decay_limit)};
    if (w > 0)
        l.stiffness = 1 / (w * w);
    else
        l.growth = sim->scene->time.end / 2;
    return l;
}

static double largest_step(const struct limits *l, double stiffness, double damping)
{
    const double a = l->stiffness * stiffness, b = l->damping * damping + l->growth * stiffness;
    return 2 / (b + sqrt(b * b + 4 * a)); /* the positive root, in the form that does not cancel */
}

/* Where springs are left out pressure is too: it makes a point tremble, but no more (guard.h). */
static void find_pressure(const struct sim *sim, const struct guard_rows *rows)
{
    double *all[] = {rows->stiffness, rows->damping, rows->push};
    for (int i = 0; i < 3; i++) /* also of points to come, where torn skin has room for some */
        memset(all[i], 0, sim->point_count * sizeof *all[i]);
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const double pressure = fabs(sim_point_pressure(b)), trembling = b->mean_rest_length / 10;
        for (uint32_t p = b->point_begin; p < b->point_end; p++) {
            rows->stiffness[p] = trembling > 0 && !is_outer_only(sim) ? 2 * pressure / trembling : 0;
            rows->push[p] = pressure;
        }
    }
}

/* How much of a step h a point's rows take, for largest_step(). */
static double ask_of(const struct guard *guard, const struct limits *l, double h, uint32_t p)
{
    return (h * l->stiffness + l->growth) * guard->rows.stiffness[p] + l->damping * guard->rows.damping[p];
}

/* Who asks for most of a point's row, at the step h. */
struct asker {
    const struct limits *limits;
    double h, most, before;
    uint32_t point, cause;
};

/* What the row has grown by since the last call is the cause's; NULL: nobody wants to know. */
static void note_asker(const struct guard *guard, struct asker *a, uint32_t cause)
{
    if (!a)
        return;
    const double now = ask_of(guard, a->limits, a->h, a->point), more = now - a->before;
    a->before = now;
    if (more > a->most) {
        a->most = more;
        a->cause = cause;
    }
}

/* What acts on single points: pressure and effects. */
static void find_rows(struct sim *sim, struct asker *asker)
{
    const struct guard_rows rows = sim->guard->rows;
    find_pressure(sim, &rows);
    note_asker(sim->guard, asker, GUARD_PRESSURE);
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        if (hook->effect->bound)
            hook->effect->bound(sim, hook->balloon, &rows);
        note_asker(sim->guard, asker, GUARD_EFFECTS + (uint32_t)i);
    }
    double push = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t p = b->point_begin; p < b->point_end; p++)
            push += rows.push[p] * rows.push[p] / sim->mass[p];
    sim->guard->memory.push = sqrt(push);
}

/* The unsigned Laplacians of springs and of dampers, times x. */
static void find_springs(const struct sim *sim, const struct sim_balloon *b)
{
    const struct guard *guard = sim->guard;
    const double damping = b->now->damping;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
        if (!sim->edge_active[e])
            continue;
        const uint32_t *p = sim->edge_point[e];
        const double x = guard->x[p[0]] + guard->x[p[1]];
        for (int k = 0; k < 2; k++) {
            guard->springs[p[k]] += sim->current_spring_const[e] * x;
            guard->dampers[p[k]] += damping * x;
        }
    }
}

/* A membrane's are multiples of one of weights. */
static void find_weights(const struct sim *sim, const struct sim_balloon *b)
{
    const struct guard *guard = sim->guard;
    const double *weight = b->membrane->edge_weight, stiffness = b->now->membrane_stiffness,
                 damping = b->membrane->damping;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
        if (!sim->edge_active[e])
            continue;
        const uint32_t *p = sim->edge_point[e];
        const double given = weight[e - b->edge_begin] * (guard->x[p[0]] + guard->x[p[1]]);
        guard->springs[p[0]] += given;
        guard->springs[p[1]] += given;
    }
    for (uint32_t p = b->point_begin; p < b->point_end; p++) {
        guard->dampers[p] = damping * guard->springs[p];
        guard->springs[p] *= stiffness;
    }
}

static void find_edges(const struct sim *sim)
{
    struct guard *guard = sim->guard;
    memset(guard->springs, 0, sim->point_count * sizeof *guard->springs);
    memset(guard->dampers, 0, sim->point_count * sizeof *guard->dampers);
    if (is_outer_only(sim))
        return;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->membrane)
            find_weights(sim, b);
        else
            find_springs(sim, b);
}

/* Whether the point may ask for a shorter step than h, without the root and the divisions that take most of
 * the time of a look at all points: few ask for less than all before them. Anything for an infinite h. */
static bool may_ask_for_less(const struct sim *sim, const struct limits *l, double h, uint32_t p)
{
    const struct guard *guard = sim->guard;
    const double x = guard->x[p];
    const double asked = (guard->springs[p] + guard->rows.stiffness[p] * x) *
                             ((l->stiffness * h + l->growth) * h) +
                         (guard->dampers[p] + guard->rows.damping[p] * x) * (l->damping * h);
    return !(asked < (1 - 1e-12) * (x * sim->mass[p]));
}

/* The bound that x gives; *tightest becomes the point that it comes from. */
static double bound_of(const struct sim *sim, const struct limits *l, uint32_t *tightest)
{
    const struct guard *guard = sim->guard;
    double best = INFINITY;
    find_edges(sim);
    for (uint32_t p = 0; p < sim->point_count; p++) {
        if (!may_ask_for_less(sim, l, best, p))
            continue;
        const double stiffness = guard->springs[p] / guard->x[p] + guard->rows.stiffness[p],
                     damping = guard->dampers[p] / guard->x[p] + guard->rows.damping[p];
        const double h = largest_step(l, stiffness / sim->mass[p], damping / sim->mass[p]);
        if (h < best) {
            best = h;
            *tightest = p;
        }
    }
    return best;
}

/* A power iteration at the step h: x becomes the matrix times x, its largest number 1. None may become 0:
 * where little happens, far from the tightest point, numbers shrink as long as one iterates. */
static void sharpen(const struct sim *sim, const struct limits *l, double h)
{
    struct guard *guard = sim->guard;
    const double stiffness = h * h * l->stiffness + h * l->growth, damping = h * l->damping;
    double largest = 0;
    for (uint32_t p = 0; p < sim->point_count; p++) {
        const double springs = guard->springs[p] + guard->rows.stiffness[p] * guard->x[p],
                     dampers = guard->dampers[p] + guard->rows.damping[p] * guard->x[p];
        guard->x[p] = (stiffness * springs + damping * dampers) / sim->mass[p];
        largest = fmax(largest, guard->x[p]);
    }
    for (uint32_t p = 0; p < sim->point_count; p++)
        guard->x[p] = fmax(guard->x[p] / largest, 1e-100);
}

/* GUARD_PRESSURE: that or an effect. */
static enum guard_cause cause_at(const struct sim *sim, const struct limits *l, double h, uint32_t p)
{
    const struct guard *guard = sim->guard;
    const double stiffness = h * l->stiffness + l->growth;
    const double springs = stiffness * guard->springs[p] / guard->x[p],
                 dampers = l->damping * guard->dampers[p] / guard->x[p], points = ask_of(guard, l, h, p);
    if (points > springs && points > dampers)
        return GUARD_PRESSURE;
    return dampers > springs ? GUARD_DAMPERS : GUARD_SPRINGS;
}

/* Cuts may bring the bound down to this share of the sharpest: looking at all points finds more mostly. */
static const double worth_a_look = 0.9;

void guard_cut(struct sim *sim, const struct sim_balloon *b, uint32_t point, uint32_t like,
               const uint32_t *edges, uint32_t edge_count)
{
    struct guard *guard = sim->guard;
    const struct limits l = limits_of(sim);
    const struct membrane *m = b->membrane;
    double springs = 0, dampers = 0;
    if (guard->memory.is_known != GUARD_KNOWN)
        return;
    guard->x[point] = guard->x[like];
    guard->rows.stiffness[point] = guard->rows.stiffness[like];
    guard->rows.damping[point] = guard->rows.damping[like];
    for (uint32_t i = 0; i < edge_count && !is_outer_only(sim); i++) {
        const uint32_t e = edges[i];
        const double x = guard->x[sim->edge_point[e][0]] + guard->x[sim->edge_point[e][1]];
        const double weight = m ? m->edge_weight[e - b->edge_begin] : 1;
        springs += (m ? weight * b->now->membrane_stiffness : sim->current_spring_const[e]) * x;
        dampers += (m ? weight * m->damping : b->now->damping) * x;
    }
    const double stiffness = springs / guard->x[point] + guard->rows.stiffness[point],
                 damping = dampers / guard->x[point] + guard->rows.damping[point];
    const double h = largest_step(&l, stiffness / sim->mass[point], damping / sim->mass[point]);
    if (h >= guard->memory.stable)
        return;
    guard->memory.stable = h;
    guard->memory.point = point;
    guard->memory.cause = l.damping * dampers > (h * l.stiffness + l.growth) * springs ? GUARD_DAMPERS
                                                                                       : GUARD_SPRINGS;
    if (h < sim->step || h < worth_a_look * guard->memory.sharp)
        guard->memory.is_known = GUARD_KNOWN_BUT_FOR_CUTS;
}

/* Cuts change little: mostly one iteration makes x as good as they were. What has become less stiff elsewhere
 * does not show by that: x that are stiffest motions give all points the same bound. */
static bool is_as_good(const struct guard_memory *memory, double h)
{
    return memory->is_known == GUARD_KNOWN_BUT_FOR_CUTS && h > 0.998 * memory->sharp;
}

/* Iterates until the bound grows no more. It never falls: what x become at a step h, all of them bear at that
 * h (Collatz and Wielandt), so that the last x are those that it comes from. */
static void find_sharpest(struct sim *sim, const struct limits *l)
{
    enum { ITERATIONS_MAX = 40 };
    struct guard_memory *memory = &sim->guard->memory;
    bool good = false, ends = false;
    memory->stable = 0;
    for (int i = 0; i < ITERATIONS_MAX && !ends; i++) {
        uint32_t point = 0;
        const double before = memory->stable, h = bound_of(sim, l, &point);
        if (h > before) {
            memory->stable = h;
            memory->point = point;
            memory->cause = cause_at(sim, l, h, point);
        }
        good = is_as_good(memory, h);
        ends = good || isinf(h) || h == 0 || is_outer_only(sim) ||
               (i % 4 == 3 && memory->stable < 1.002 * before);
        if (!ends)
            sharpen(sim, l, h);
    }
    memory->sharp = good ? fmax(memory->sharp, memory->stable) : memory->stable;
}

struct guard_follow guard_following(const struct sim *sim)
{
    struct guard_follow follow = {INFINITY, NULL, NULL};
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++) {
        const struct effect_hook *hook = &sim->hooks[EFFECT_FORCES][i];
        const double step = hook->effect->follow ? hook->effect->follow(sim, hook->balloon) : INFINITY;
        if (step < follow.step)
            follow = (struct guard_follow){step, hook->effect, hook->balloon};
    }
    return follow;
}

void guard_find_bound(struct sim *sim)
{
    struct guard_memory *memory = &sim->guard->memory;
    const struct limits l = limits_of(sim);
    find_rows(sim, NULL);
    const struct guard_follow follow = guard_following(sim);
    find_sharpest(sim, &l);
    if (memory->cause == GUARD_PRESSURE) {
        struct asker asker = {
            .limits = &l, .h = memory->stable, .point = memory->point, .cause = GUARD_PRESSURE};
        find_rows(sim, &asker);
        memory->cause = asker.cause;
    }
    if (follow.step < memory->stable) {
        memory->stable = follow.step;
        memory->point = follow.balloon->point_begin;
        memory->cause = GUARD_FOLLOW;
    }
    memory->broken = sim->broken;
    memory->is_known = GUARD_KNOWN;
}
