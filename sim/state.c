/* What the future depends on: the one list that checkpoints, rewinding, trial steps and the hash go by. */
#include "common/array.h"
#include "common/hash.h"
#include "common/vec3.h"
#include "sim/fracture.h"
#include "sim/guard.h"
#include "sim/integrators.h"

double sim_edge_length(const struct sim *sim, uint32_t edge)
{
    const uint32_t *p = sim->edge_point[edge];
    return sim->edge_active[edge] ? vec3_distance(sim->position[p[0]], sim->position[p[1]])
                                  : sim->broken_length[edge];
}

uint32_t sim_state_scalars(const struct sim *sim)
{
    return sim->ledger.on ? sim->ledger.first : sim->scalar_count;
}

static size_t state_blocks(struct sim *sim, struct sim_block *blocks)
{
    const size_t points = sim->point_count, edges = sim->edge_count;
    const struct sim_block own[] = {
        {"time", &sim->time, sizeof sim->time},
        {"whole step", &sim->whole_step, sizeof sim->whole_step},
        {"substeps", &sim->substeps, sizeof sim->substeps},
        {"step", &sim->step, sizeof sim->step},
        {"time base", &sim->time_base, sizeof sim->time_base},
        {"steps since", &sim->steps_since, sizeof sim->steps_since},
        {"steps", &sim->steps, sizeof sim->steps},
        {"next change", &sim->next_change, sizeof sim->next_change},
        {"edges broke", &sim->edges_broke, sizeof sim->edges_broke},
        {"broken", &sim->broken, sizeof sim->broken},
        {"changed", &sim->changed, sizeof sim->changed},
        {"position", sim->position, points * sizeof *sim->position},
        {"velocity", sim->velocity, points * sizeof *sim->velocity},
        {"spring constant", sim->current_spring_const, edges * sizeof *sim->current_spring_const},
        {"broken length", sim->broken_length, edges * sizeof *sim->broken_length},
        {"edge active", sim->edge_active, edges * sizeof *sim->edge_active},
        {"triangle active", sim->triangle_active, sim->triangle_count * sizeof *sim->triangle_active},
        {"scalar", sim->scalar, sim_state_scalars(sim) * sizeof *sim->scalar},
        {"settings", sim->settings, sim->balloon_count * sizeof *sim->settings},
    };
    size_t count = 0;
    for (; count < sizeof own / sizeof own[0]; count++)
        blocks[count] = own[count];
    count += guard_blocks(sim, &blocks[count]);
    count += effects_blocks(sim, &blocks[count]);
    if (sim->integrator->blocks)
        count += sim->integrator->blocks(sim, &blocks[count]);
    return count;
}

enum status state_open(struct sim *sim, struct error *err)
{
    enum { OWN_BLOCKS_MAX = 64 }; /* the method's among them */
    size_t room = OWN_BLOCKS_MAX;
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        room += sim->hook_count[phase] * EFFECT_BLOCKS_MAX;
    sim->blocks = array_new(room, sizeof *sim->blocks);
    return sim->blocks ? STATUS_OK : error_no_memory(err, "the list of the state");
}

const struct sim_block *sim_blocks(struct sim *sim, size_t *number)
{
    struct sim_block *blocks = sim->blocks;
    size_t count = *number = state_blocks(sim, blocks);
    if (!sim->ledger.on)
        return blocks;
    const uint32_t first = sim->ledger.first;
    blocks[count++] = (struct sim_block){"ledger", &sim->ledger.account, sizeof sim->ledger.account};
    blocks[count++] = (struct sim_block){"ledger's scalars", &sim->scalar[first],
                                         (sim->scalar_count - first) * sizeof *sim->scalar};
    if (sim->integrator->vectors > 0) /* a method may remember their rates */
        blocks[count++] = (struct sim_block){"ledger's rates", &sim->scalar_scratch[0][first],
                                             (sim->scalar_count - first) * sizeof *sim->scalar};
    *number = count;
    return blocks;
}

bool sim_restored(struct sim *sim)
{
    sim->edge_room = -INFINITY;
    if (sim->integrator->is_sound && !sim->integrator->is_sound(sim))
        return false;
    for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->fracture && !fracture_is_sound(sim, b))
            return false;
    for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->fracture)
            fracture_restored(sim, b);
    return true;
}

uint64_t sim_hash(struct sim *sim)
{
    const size_t count = state_blocks(sim, sim->blocks); /* whether it is watched makes no difference */
    uint64_t hash = HASH_START;
    for (size_t i = 0; i < count; i++)
        hash = hash_bytes(hash, sim->blocks[i].data, sim->blocks[i].size);
    return hash;
}
