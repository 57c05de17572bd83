/*
 * The slip unit of the paper's figure 1, in series with each spring: it holds until the spring pulls or
 * pushes with more than y + H s, and then slips, by s in all, until it holds again (perfectly plastic at H =
 * 0, else with linear hardening). What has slipped is part of the edge's length at rest for good. It slips at
 * the end of a step, at once: rate-independent.
 */
#include "sim/checkpoint.h"
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/kernels.h"
#include "sim/ledger.h"
#include "sim/sweep.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->plasticity.on;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    b->slip_count = b->edge_end - b->edge_begin;
    b->slip = sim_table(sim, b->slip_count, sizeof *b->slip);
    sim->fingerprint = checkpoint_fingerprint(sim);
    return b->slip ? STATUS_OK : error_no_memory(err, "the slip of the springs");
}

static void close(struct sim *sim, struct sim_balloon *b)
{
    (void)sim;
    free(b->slip);
    b->slip = NULL;
}

static size_t blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *blocks)
{
    blocks[0] = (struct sim_block){"slip", b->slip, b->slip_count * sizeof *b->slip};
    blocks[1] = (struct sim_block){"rest length", &sim->rest_length[b->edge_begin],
                                   b->slip_count * sizeof *sim->rest_length};
    return 2;
}

/* Any number of a balloon's parts slip at once. */
struct slide {
    const struct sim_balloon *balloon;
    atomic_bool any;
};

/* In an edge's spring, and in an arm beside it (effect_viscosity.c), which slips along. */
static double held_by_edge(const struct sim *sim, uint32_t e)
{
    return sim_spring_energy(sim, e) + effects_edge_energy(sim, e);
}

/* k (e - ds) = y + H (s + ds) for the way ds that is still to go, e the spring's elongation; no edge
 * slips to less than nothing. */
static bool slip_edge(struct sim *sim, struct sim_balloon *b, uint32_t e)
{
    if (!sim->edge_active[e])
        return false;
    const struct scene_plasticity *block = &b->scene->plasticity;
    const double k = sim->current_spring_const[e], elongation = sim_edge_length(sim, e) - sim->rest_length[e];
    double *slipped = &b->slip[e - b->edge_begin];
    const double over = k * fabs(elongation) - block->yield - block->hardening * *slipped;
    if (!(over > 0) || !(k > 0))
        return false;
    const double way = over / (k + block->hardening);
    const double signed_way = fmax(copysign(way, elongation), -sim->rest_length[e] / 2);
    const double before = sim->ledger.on ? held_by_edge(sim, e) : 0;
    *slipped += fabs(signed_way);
    sim->rest_length[e] += signed_way;
    if (sim->ledger.on)
        sim->scalar[sim->ledger.first + LEDGER_DISSIPATED] += before - held_by_edge(sim, e);
    return true;
}

static void slip_part(struct sim *sim, const struct sim_part *part, void *context)
{
    struct slide *slide = context;
    if (part->balloon == slide->balloon && sim->kernels->slip_edges(sim, part, slip_edge) > 0)
        atomic_store(&slide->any, true);
}

/* Where accounts are kept, part by part: what is added to them comes in the same order for
 * any number of workers. */
static void apply(struct sim *sim, struct sim_balloon *b)
{
    struct slide slide = {.balloon = b};
    if (sweep_saw_hardest(sim, b) < (1 - 1e-9) * b->scene->plasticity.yield)
        return;
    if (sim->ledger.on)
        for (const struct sim_part *part = sim->parts; part < sim->parts + sim->part_count; part++)
            slip_part(sim, part, &slide);
    else
        sim_each_part(sim, slip_part, &slide);
    sim->changed |= slide.any;
    if (slide.any && b->own_thresholds)
        sim->edge_room = -INFINITY; /* thresholds go by rest lengths */
}

const struct effect effect_plasticity = {.name = "plasticity",
                                         .phase = EFFECT_AFTER_STEP,
                                         .wanted = wanted,
                                         .open = open,
                                         .close = close,
                                         .blocks = blocks,
                                         .apply = apply,
                                         .source = "paper, figure 1; Terzopoulos and Fleischer 1988"};
