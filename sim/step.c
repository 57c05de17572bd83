/*
 * One time step, as the paper's section 3.5 lists it: 1 points, 2 edges, 3 triangles, 4 pressure. The
 * formulas are in forces.c; part 5, drawing, is the renderer's.
 */
#include "sim/guard.h"
#include "sim/kernels.h"
#include "sim/ledger.h"
#include "sim/let_go.h"
#include "sim/membrane_kernels.h"
#include "sim/reorder.h"
#include "sim/sweep.h"
#include "sim/vectors.h"

#include <math.h>

/* What resists being stretched: springs and dampers, as in the paper, or the triangles themselves. */
static void coming_skin(struct sim *sim, const struct sim_part *part)
{
    if (part->balloon->membrane)
        part->balloon->membrane->kernels->coming_forces(sim, part);
    else
        sim->kernels->coming_forces(sim, part);
}

static void skin_forces(struct sim *sim, const struct sim_part *part, const struct sim_chunk *chunk)
{
    if (part->balloon->membrane)
        part->balloon->membrane->kernels->forces(sim, part, chunk);
    else
        sim->kernels->edge_forces(sim, part, chunk);
}

/* Chunk by chunk, so that a large balloon goes through the caches once. Where air drags, the skin's forces
 * are ahead of the triangles that reach into them: kernels_skin_is_due(). */
static void part_forces(struct sim *sim, const struct sim_part *part, void *move)
{
    const struct sim_kernels *k = sim->kernels;
    const struct sim_chunk *next = part->chunks;
    sweep_begin(sim, part);
    for (const struct sim_chunk *c = part->chunks; c < part->chunks + part->chunk_count; c++) {
        for (; kernels_skin_is_due(sim, part, next, c); next++) {
            k->clear_points(sim, next); /* 1  forces and normals are 0             */
            if (next == part->chunks)
                coming_skin(sim, part);
            skin_forces(sim, part, next); /* 2  springs and dampers, or a membrane   */
        }
        kernels_press(k, sim, part, c); /* 3  face normals, added to the points    */
                                        /* 4  pressure along each point's normal   */
        if (move)
            sweep_chunk(sim, part, c, move); /*    these are all: points move on          */
    }
}

void sim_forces(struct sim *sim)
{
    sim->evaluations++;
    sim_each_part(sim, part_forces, NULL);
    effects_run(sim, EFFECT_FORCES); /* whatever else this scene calls for */
    if (sim->ledger.on)
        ledger_rates(sim); /* what all this does to the energy, where accounts are kept */
}

/* Whether forces are complete with the parts: no effect adds to them once all parts are done. */
static bool are_complete(const struct sim *sim)
{
    for (size_t i = 0; i < sim->hook_count[EFFECT_FORCES]; i++)
        if (sim->hooks[EFFECT_FORCES][i].effect->apply || sim->hooks[EFFECT_FORCES][i].effect->finish)
            return false;
    return true;
}

/* The end of a sweep, where effects have begun to add to the forces. */
struct rest {
    size_t first; /* that is left to finish */
    struct sim_move *move;
};

static void finish_and_sweep(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct rest *rest = context;
    effects_finish_forces(sim, part, rest->first);
    sweep_part(sim, part, rest->move);
}

void sim_forces_then(struct sim *sim, struct sim_move *move)
{
    if (sim->ledger.on) {
        sim_forces(sim);
        sim_each_part(sim, sweep_part, move);
    } else if (are_complete(sim)) {
        sim->evaluations++;
        sim_each_part(sim, part_forces, move);
        sim_each_part(sim, sweep_border, move);
    } else {
        sim->evaluations++;
        sim_each_part(sim, part_forces, NULL);
        sim_each_part(sim, finish_and_sweep, &(struct rest){effects_begin_forces(sim), move});
    }
    sim->swept = true;
}

static void find_room(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)context;
    const bool tears = part->balloon->fracture; /* its skin gives way in another manner */
    sim->edge_rooms[part - sim->parts] = tears ? INFINITY : sim->kernels->edge_room(sim, part);
}

/* An edge grows by no more than its two ends move, so that most steps need no look. The margin is for
 * rounding. */
static bool are_short(struct sim *sim)
{
    sim->edge_room -= (2 + 1e-9) * sweep_saw_farthest(sim);
    return sim->edge_room > 0 || sweep_saw_none_overlong(sim);
}

/* Part 2: edges longer than the threshold let go. Most steps have none. */
static void break_edges(struct sim *sim)
{
    if (are_short(sim))
        return;
    sim_each_part(sim, find_room, NULL);
    sim->edge_room = INFINITY;
    for (size_t i = 0; i < sim->part_count; i++) {
        const struct sim_part *part = &sim->parts[i];
        sim->edge_room = fmin(sim->edge_room, sim->edge_rooms[i]);
        for (uint32_t e = part->edge_begin; e < part->edge_end && sim->edge_rooms[i] <= 0; e++)
            if (sim->edge_active[e] && sim_edge_length(sim, e) > sim_threshold(sim, part->balloon, e))
                sim_break_edge(sim, e);
    }
}

/* Part 3: "if more than one edge is inactive, set triangle inactive". */
static void tear_triangles(struct sim *sim)
{
    if (!sim->edges_broke)
        return;
    sim->edges_broke = false;
    sim->changed = true; /* also where an effect cut the edges after the step before */
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const uint32_t *e = sim->triangle_edge[t];
        const int left = sim->edge_active[e[0]] + sim->edge_active[e[1]] + sim->edge_active[e[2]];
        if (left < 2 && sim->triangle_active[t])
            sim_drop_triangle(sim, t);
    }
}

/* Where one of the scene's steps begins; the guard may split it in several of the method's. */
static enum status begin_step(struct sim *sim, struct error *err)
{
    const bool first = sim->steps_since % sim->substeps == 0;
    reorder_step(sim); /* where skin is torn */
    if (first)
        sim_change_due(sim);
    if (sim->integrator->choose && !sim->integrator->choose(sim, first))
        return error_set(err, STATUS_INTERRUPTED, "interrupted at %g s", sim->time);
    return guard_step(sim, first, err);
}

/* When a method that chooses its own steps must stop: at the next change, by the user or of what lets go or
 * opens, or at the end. */
static double next_due(const struct sim *sim)
{
    const struct scene *scene = sim->scene;
    double due = fmin(effects_due(sim), scene->time.end > sim->time ? scene->time.end : INFINITY);
    if (sim->next_change < scene->schedule_count)
        due = fmin(due, scene->schedule[sim->next_change].at);
    return due;
}

static bool is_adaptive(const struct sim *sim)
{
    return sim->integrator->flags & INTEGRATOR_ADAPTIVE;
}

/* Part 1: positions and velocities, by a method that asks sim_forces() as often as its order needs. */
static enum status advance(struct sim *sim, struct error *err)
{
    sim->due = is_adaptive(sim) ? next_due(sim) : INFINITY;
    const double left = sim->due - sim->time;
    sim->taken = left <= sim->step * (1 + 1e-9) ? left : sim->step; /* no sliver of a step is left behind */
    sim->swept = sim->pushed = false;
    enum status status = sim->integrator->advance(sim, sim->taken, err);
    if (status)
        return status;
    sim->changed = false;
    sim->steps++;
    sim->steps_since++;
    if (!is_adaptive(sim))
        sim->time = sim->time_base + (double)sim->steps_since / sim->substeps * sim->whole_step;
    else
        sim->time = sim->taken == left ? sim->due : sim->time + sim->taken;
    return STATUS_OK;
}

enum status sim_step(struct sim *sim, struct error *err)
{
    enum status status = begin_step(sim, err); /* what the user or the guard changes */
    if (status)
        return status;
    if (sim->before)
        vector_copy(sim, sim->before, sim->position); /* for what watches the points' ways */
    look_remember(sim);                               /*    for pictures of a moment within the step */
    status = advance(sim, err);                       /* 1  positions, velocities                    */
    if (status)
        return status;
    reorder_moved(sim);
    status = effects_settle(sim, err); /* what stands in the way */
    if (status)
        return status;
    break_edges(sim);    /* 2  edges past the threshold let go   } once, at the end of a step, so that */
    tear_triangles(sim); /* 3  triangles that lost two edges     } no trial state breaks anything      */
    effects_run(sim, EFFECT_AFTER_STEP);
    status = effects_check(sim, err);
    return status ? status : guard_check(sim, err);
}

bool sim_at_end(const struct sim *sim)
{
    const double end = sim->scene->time.end;
    return is_adaptive(sim) ? sim->time >= end : sim->time + sim->step / 2 >= end;
}
