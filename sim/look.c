/* A look at a moment inside the last step, for pictures and logs that want their own times:
 * the run does not notice. */
#include "common/array.h"
#include "sim/sim.h"
#include "sim/vectors.h"

#include <stdlib.h>
#include <string.h>

enum status look_open(struct sim *sim, struct error *err)
{
    struct sim_past *past = &sim->past;
    if (!sim->integrator->look)
        return STATUS_OK;
    past->edge_active = array_new(sim->edge_count, sizeof *past->edge_active);
    past->triangle_active = array_new(sim->triangle_count, sizeof *past->triangle_active);
    past->position = array_new(sim->point_count, sizeof *past->position);
    past->velocity = array_new(sim->point_count, sizeof *past->velocity);
    sim->bytes += sim->edge_count + sim->triangle_count + sim->point_count * 2 * sizeof *past->position;
    const bool room = past->edge_active && past->triangle_active && past->position && past->velocity;
    return room ? STATUS_OK : error_no_memory(err, "the states between steps");
}

void look_close(struct sim *sim)
{
    struct sim_past *past = &sim->past;
    free(past->edge_active);
    free(past->triangle_active);
    free(past->position);
    free(past->velocity);
    free(past->scalar);
}

void look_remember(struct sim *sim)
{
    if (!sim->integrator->look)
        return;
    memcpy(sim->past.edge_active, sim->edge_active, sim->edge_count);
    memcpy(sim->past.triangle_active, sim->triangle_active, sim->triangle_count);
    sim->past.account = sim->ledger.account;
}

/* Breaking comes after the step: what is shown from inside it has not broken yet. */
static void swap_active(struct sim *sim)
{
    struct sim_past *past = &sim->past;
    unsigned char *edges = sim->edge_active, *triangles = sim->triangle_active;
    sim->edge_active = past->edge_active;
    sim->triangle_active = past->triangle_active;
    past->edge_active = edges;
    past->triangle_active = triangles;
    const struct sim_account account = sim->ledger.account;
    sim->ledger.account = past->account;
    past->account = account;
}

void sim_look(struct sim *sim, double time)
{
    struct sim_past *past = &sim->past;
    if (!sim->integrator->look || time >= sim->time)
        return;
    const double back = sim->time - time;
    past->looking = true;
    past->time = sim->time;
    vector_copy(sim, past->position, sim->position);
    vector_copy(sim, past->velocity, sim->velocity);
    if (sim->scalar_count)
        memcpy(past->scalar, sim->scalar, sim->scalar_count * sizeof *past->scalar);
    swap_active(sim);
    sim->integrator->look(sim, back < sim->taken ? back : sim->taken);
    sim->time = time;
    sim_forces(sim); /* for the normals */
}

void sim_look_end(struct sim *sim)
{
    struct sim_past *past = &sim->past;
    if (!past->looking)
        return;
    past->looking = false;
    sim->time = past->time;
    vector_copy(sim, sim->position, past->position);
    vector_copy(sim, sim->velocity, past->velocity);
    if (sim->scalar_count)
        memcpy(sim->scalar, past->scalar, sim->scalar_count * sizeof *past->scalar);
    swap_active(sim);
    sim_forces(sim);
}
