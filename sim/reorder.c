#include "sim/reorder.h"
#include "sim/fracture.h"
#include "sim/guard_bound.h"

#include <string.h>

/* What putting things in order takes, in what its triangles lose in a step when all are slowed. */
enum { PRICE = 3 };

/* A shear wave at rest has gone a radius without a cut. */
static bool has_rested(const struct sim *sim, const struct sim_balloon *b)
{
    return sim->time >= b->topology->now.last_cut + b->fracture->radius / fracture_wave_speed(b);
}

static uint32_t room_of(const struct sim_balloon *b)
{
    return b->point_room - b->point_begin;
}

void reorder_points(const struct reorder *reorder, uint32_t *points, size_t count)
{
    const struct sim_balloon *b = reorder->balloon;
    for (size_t i = 0; i < count; i++)
        if (points[i] - b->point_begin < room_of(b))
            points[i] = reorder->place[points[i] - b->point_begin];
}

void reorder_rows(const struct reorder *reorder, void *rows, size_t size)
{
    const struct sim_balloon *b = reorder->balloon;
    char *from = rows, *to = reorder->spare;
    if (!to)
        return;
    for (size_t p = 0; p < room_of(b); p++)
        memcpy(to + (reorder->place[p] - b->point_begin) * size, from + p * size, size);
    memcpy(from, to, room_of(b) * size);
}

/* By families, and otherwise as they are: a counting sort. What is not there yet stays. */
static void find_places(const struct sim_balloon *b)
{
    struct topology *top = b->topology;
    uint32_t *count = top->spare_numbers;
    const uint32_t points = b->point_end - b->point_begin, families = top->old_points - b->point_begin;
    memset(count, 0, families * sizeof *count);
    for (uint32_t p = 0; p < points; p++)
        count[top->family[top->name[p]]]++;
    for (uint32_t f = 0, sum = b->point_begin; f < families; f++) {
        const uint32_t here = count[f];
        count[f] = sum;
        sum += here;
    }
    for (uint32_t p = 0; p < room_of(b); p++)
        top->place[p] = p < points ? count[top->family[top->name[p]]]++ : b->point_begin + p;
}

/* Rows of all that points have, but for what the next forces are. */
static void move_rows(struct sim *sim, const struct sim_balloon *b, const struct reorder *r)
{
    const uint32_t first = b->point_begin;
    struct topology *top = b->topology;
    reorder_rows(r, sim->position + first, sizeof *sim->position);
    reorder_rows(r, sim->velocity + first, sizeof *sim->velocity);
    reorder_rows(r, sim->mass + first, sizeof *sim->mass);
    for (int i = 0; i < sim->integrator->vectors; i++)
        reorder_rows(r, sim->scratch[i] + first, sizeof *sim->scratch[i]);
    reorder_rows(r, sim->guard->x + first, sizeof *sim->guard->x);
    reorder_rows(r, sim->guard->rows.stiffness + first, sizeof *sim->guard->rows.stiffness);
    reorder_rows(r, sim->guard->rows.damping + first, sizeof *sim->guard->rows.damping);
    reorder_rows(r, top->rest, sizeof *top->rest);
    reorder_rows(r, top->triangle_at, sizeof *top->triangle_at);
    reorder_rows(r, top->name, sizeof *top->name);
}

/* What the state tells points by. */
static void move_numbers(struct sim *sim, const struct sim_balloon *b, const struct reorder *r)
{
    reorder_points(r, sim->edge_point[b->edge_begin], 2 * (size_t)(b->edge_end - b->edge_begin));
    reorder_points(r, sim->triangle_point[b->triangle_begin],
                   3 * (size_t)(b->triangle_end - b->triangle_begin));
    reorder_points(r, &sim->guard->memory.point, 1);
    for (uint32_t i = 0; i < b->fracture->now.tips; i++)
        reorder_points(r, &b->fracture->tips[i].point, 1);
    reorder_points(r, b->fracture->rims.side[0], 2 * (size_t)b->fracture->rims.side_count);
}

static void find_named(const struct sim_balloon *b)
{
    for (uint32_t p = 0; p < room_of(b); p++)
        b->topology->named[b->topology->name[p]] = p;
}

/* What is no state, once names, edges and triangles are those that are to be. */
static void follow(struct sim *sim, struct sim_balloon *b, const struct reorder *r)
{
    struct topology *top = b->topology;
    find_named(b);
    topology_nothing_slow(b);
    parts_renumber(sim, b, r->place, top->old_points + top->now.settled);
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        for (size_t i = 0; i < sim->hook_count[phase]; i++) {
            const struct effect_hook *hook = &sim->hooks[phase][i];
            if (hook->effect->reorder)
                hook->effect->reorder(sim, hook->balloon, r);
        }
}

static void put_in_order(struct sim *sim, struct sim_balloon *b)
{
    struct topology *top = b->topology;
    const struct reorder r = {b, top->place, top->spare};
    find_places(b);
    move_rows(sim, b, &r);
    move_numbers(sim, b, &r);
    top->now.settled = top->now.points;
    top->now.late_edges = top->now.late_triangles = 0;
    top->now.slowed = 0;
    top->now.orders++;
    follow(sim, b, &r);
    sim->changed = true; /* methods may remember points and forces in their own manner */
}

void reorder_wake(const struct sim *sim, struct sim_balloon *b)
{
    struct topology_counts *now = &b->topology->now;
    now->last_cut = sim->time;
    if (now->awake == REORDER_SLEEPS)
        now->awake = REORDER_STIRS;
}

static void go_to_sleep(struct sim *sim, struct sim_balloon *b)
{
    b->topology->now.awake = REORDER_SLEEPS;
    sim_tell(sim, b, "reordering", "sleeps: all points are in their places");
}

/* What a step with the points as they are loses. */
static uint64_t loss_of(const struct topology *top)
{
    return top->now.late_triangles + top->slow;
}

void reorder_step(struct sim *sim)
{
    for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        struct topology_counts *now = b->topology ? &b->topology->now : NULL;
        if (!now || now->awake == REORDER_SLEEPS)
            continue;
        if (now->awake == REORDER_STIRS)
            sim_tell(sim, b, "reordering", "wakes: new points wait for their places");
        now->awake = REORDER_AWAKE;
        const uint64_t price = (uint64_t)PRICE * (b->triangle_end - b->triangle_begin);
        const bool rested = has_rested(sim, b);
        if (now->settled < now->points && (rested || now->slowed + loss_of(b->topology) >= price))
            put_in_order(sim, b);
        if (rested)
            go_to_sleep(sim, b);
    }
}

void reorder_moved(struct sim *sim)
{
    for (struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->topology && b->topology->now.awake != REORDER_SLEEPS)
            b->topology->now.slowed += loss_of(b->topology);
}

void reorder_restored(struct sim *sim, struct sim_balloon *b)
{
    struct topology *top = b->topology;
    uint32_t *now = top->spare_numbers;
    for (uint32_t p = 0; p < room_of(b); p++)
        now[top->name[p]] = p;
    for (uint32_t name = 0; name < room_of(b); name++)
        top->place[top->named[name]] = b->point_begin + now[name];
    follow(sim, b, &(struct reorder){b, top->place, NULL});
}

bool reorder_is_sound(const struct sim_balloon *b)
{
    const struct topology *top = b->topology;
    const uint32_t old = top->old_points - b->point_begin, settled = old + top->now.settled;
    unsigned char *seen = top->spare;
    bool sound = top->now.settled <= top->now.points && top->now.awake <= REORDER_AWAKE;
    for (uint32_t name = 0; name < room_of(b); name++)
        sound &= name < old ? top->family[name] == name : top->family[name] < old;
    memset(seen, 0, room_of(b));
    for (uint32_t p = 0; p < room_of(b) && sound; p++) {
        const uint32_t name = top->name[p];
        sound = p < settled ? name < settled : name == p;
        if (!sound || p >= settled)
            continue;
        const uint32_t family = top->family[name], before = p ? top->family[top->name[p - 1]] : 0;
        sound = !seen[name] && (name == family ? p == 0 || before < family : p > 0 && before == family);
        seen[name] = 1;
    }
    return sound;
}
