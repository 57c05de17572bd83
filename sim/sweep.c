#include "sim/sweep.h"

#include <math.h>

/* Of a membrane's edges the forces know nothing. */
void sweep_begin(struct sim *sim, const struct sim_part *part)
{
    const bool springs = !part->balloon->membrane;
    sim->seen[part - sim->parts] = (struct sim_seen){.over = springs ? -INFINITY : INFINITY};
}

static void move_points(struct sim *sim, const struct sim_part *part, uint32_t begin, uint32_t end,
                        const struct sim_move *move)
{
    if (begin < end)
        move->points(sim, begin, end, move->dt, &sim->seen[part - sim->parts]);
}

void sweep_chunk(struct sim *sim, const struct sim_part *part, const struct sim_chunk *c,
                 const struct sim_move *move)
{
    move_points(sim, part, c->point_begin > part->inner_begin ? c->point_begin : part->inner_begin,
                c->point_end < part->inner_end ? c->point_end : part->inner_end, move);
}

void sweep_border(struct sim *sim, const struct sim_part *part, void *move)
{
    move_points(sim, part, part->point_begin, part->inner_begin, move);
    move_points(sim, part, part->inner_end, part->point_end, move);
}

void sweep_part(struct sim *sim, const struct sim_part *part, void *move)
{
    move_points(sim, part, part->point_begin, part->point_end, move);
}

bool sweep_sees_pushes(const struct sim *sim)
{
    return sim->swept && (!sim->changed || sim->pushed) && sim->acting->flags & INTEGRATOR_ONE_SWEEP;
}

void sweep_see_pushed(struct sim *sim, size_t part, uint32_t point)
{
    struct sim_seen *seen = &sim->seen[part];
    const row way = ((const row *)sim->position)[point] - ((const row *)sim->before)[point];
    seen->moved = fmax(seen->moved, way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
}

static double farthest(const struct sim *sim)
{
    double moved = 0;
    for (size_t i = 0; i < sim->part_count; i++)
        moved = fmax(moved, sim->seen[i].moved);
    return sqrt(moved);
}

/* An edge is no longer than it was before its two ends moved, and they by as much. The
 * margin is for rounding. */
bool sweep_saw_none_overlong(const struct sim *sim)
{
    bool none = sim->swept;
    const double longer = (2 + 1e-9) * farthest(sim);
    for (size_t i = 0; i < sim->part_count && none; i++)
        none = sim->seen[i].over + longer < 0;
    return none;
}

/* Likewise. */
double sweep_saw_hardest(const struct sim *sim, const struct sim_balloon *balloon)
{
    double hardest = sim->swept ? 0 : INFINITY;
    const double longer = (2 + 1e-9) * farthest(sim);
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == balloon)
            hardest = fmax(hardest, sim->seen[i].hardest + sim->seen[i].stiffest * longer);
    return hardest;
}

double sweep_saw_farthest(const struct sim *sim)
{
    return sim->swept && sim->acting->flags & INTEGRATOR_ONE_SWEEP ? farthest(sim) : INFINITY;
}

double sweep_saw_energy(const struct sim *sim)
{
    double energy = 0;
    for (size_t i = 0; i < sim->part_count; i++)
        energy += sim->seen[i].energy[0] + sim->seen[i].energy[1] + sim->seen[i].energy[2];
    return sim->swept ? energy / 2 : INFINITY;
}
