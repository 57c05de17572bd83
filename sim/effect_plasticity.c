/*
 * The slip unit of the paper's figure 1, in series with each spring: it holds until the spring pulls or pushes with more than
 * y + H s, and then slips, by s in all, until it holds again (perfectly plastic at H = 0, else with linear hardening). What has slipped is
 * part of the edge's length at rest for good. It slips at the end of a step, at once: rate-independent.
 */
#include "sim/effects.h"
#include "sim/guard.h"
#include "sim/ledger.h"

#include <math.h>
#include <stdlib.h>

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->plasticity.on;
}

static enum status open(struct sim *sim, struct sim_balloon *b, struct error *err)
{
    b->slip_count = b->edge_end - b->edge_begin;
    b->slip = sim_table(sim, b->slip_count, sizeof *b->slip);
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

/* k (e - ds) = y + H (s + ds) for the way ds that is still to go, e the spring's elongation; no edge slips to less than nothing. */
static void slip_edge(struct sim *sim, struct sim_balloon *b, uint32_t e)
{
    const struct scene_plasticity *block = &b->scene->plasticity;
    const double k = sim->current_spring_const[e], elongation = sim_edge_length(sim, e) - sim->rest_length[e];
    double *slipped = &b->slip[e - b->edge_begin];
    const double over = k * fabs(elongation) - block->yield - block->hardening * *slipped;
    if (!(over > 0) || !(k > 0))
        return;
    const double way = over / (k + block->hardening);
    const double signed_way = fmax(copysign(way, elongation), -sim->rest_length[e] / 2);
    const double before = sim_spring_energy(sim, e);
    *slipped += fabs(signed_way);
    sim->rest_length[e] += signed_way;
    if (sim->ledger.on)
        sim->scalar[sim->ledger.first + LEDGER_DISSIPATED] += before - sim_spring_energy(sim, e);
    sim->changed = true;
}

static void apply(struct sim *sim, struct sim_balloon *b)
{
    for (uint32_t e = b->edge_begin; e < b->edge_begin + b->slip_count; e++)
        if (sim->edge_active[e])
            slip_edge(sim, b, e);
}

const struct effect effect_plasticity = {.name = "plasticity",
                                         .phase = EFFECT_AFTER_STEP,
                                         .wanted = wanted,
                                         .open = open,
                                         .close = close,
                                         .blocks = blocks,
                                         .apply = apply,
                                         .source = "paper, figure 1; Terzopoulos and Fleischer 1988"};
