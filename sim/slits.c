/* How cracks are cut: rings of triangles around points, cuts along their spokes, slits. */
#include "common/vec3.h"
#include "sim/cracks.h"

#include <math.h>

static void tell_fan(struct sim *sim, const struct sim_balloon *b)
{
    if (!b->fracture->told_fan)
        sim_tell(sim, b, "fracture",
                 "a crack has come to a point where more than 64 triangles meet: it goes no further there");
    b->fracture->told_fan = true;
}

bool crack_take_ring(struct sim *sim, const struct sim_balloon *b, uint32_t point, struct ring *ring)
{
    struct fan fan;
    ring->closed = topology_first(sim, b, point, &fan);
    const uint32_t first = fan.triangle;
    ring->count = 0;
    do {
        if (ring->count == FAN_MAX) {
            tell_fan(sim, b);
            return false;
        }
        ring->fan[ring->count++] = fan;
    } while (topology_next(sim, b, &fan) && fan.triangle != first);
    for (int i = 0; i < ring->count; i++)
        fracture_look(sim, b, ring->fan[i].triangle, &ring->state[i]);
    return true;
}

bool fracture_is_rim(const struct sim *sim, const struct sim_balloon *b, uint32_t point)
{
    struct fan fan;
    return !topology_first(sim, b, point, &fan);
}

/* The far end of the side before the corner: of spoke i that of triangle i - 1. */
uint32_t crack_spoke_end(const struct sim *sim, const struct ring *ring, int spoke)
{
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    return sim->triangle_point[f.triangle][(f.corner + 2) % 3];
}

double *crack_rest(const struct sim_balloon *b, uint32_t point)
{
    return b->topology->rest[point - b->point_begin];
}

double crack_rest_direction(const struct sim_balloon *b, uint32_t from, uint32_t to, double direction[3])
{
    vec3_sub(crack_rest(b, to), crack_rest(b, from), direction);
    const double length = vec3_length(direction);
    vec3_unit(direction);
    return length;
}

/* Nominal stress across the direction d in a triangle: with c = d . d1, s1 (1 - c^2) + s2 c^2. */
static double stress_across(const struct membrane_state *s, const double d[3])
{
    const double c = vec3_dot(s->direction, d), c2 = fmin(c * c, 1);
    return s->stress[0] * (1 - c2) + s->stress[1] * c2;
}

double crack_spoke_stress(const struct sim *sim, const struct ring *ring, uint32_t point, int spoke)
{
    double d[3];
    vec3_sub(sim->position[crack_spoke_end(sim, ring, spoke)], sim->position[point], d);
    vec3_unit(d);
    const int before = (spoke + ring->count - 1) % ring->count;
    return (stress_across(&ring->state[before], d) + stress_across(&ring->state[spoke % ring->count], d)) / 2;
}

/* How many triangles a cut between two rims would leave to either side at its far end, at least; 0 where
 * there are too many to be cut apart. */
static int far_side(struct sim *sim, const struct sim_balloon *b, uint32_t end, uint32_t triangle)
{
    struct fan fan;
    if (topology_first(sim, b, end, &fan))
        return FAN_MAX;
    int before = 1, after = 0;
    bool passed = fan.triangle == triangle;
    while (topology_next(sim, b, &fan)) {
        if (passed)
            after++;
        else
            before++;
        passed |= fan.triangle == triangle;
    }
    if (before + after > FAN_MAX) {
        tell_fan(sim, b);
        return 0;
    }
    return before < after ? before : after;
}

bool crack_may_cut(struct sim *sim, struct sim_balloon *b, const struct ring *ring, int spoke, int least)
{
    if (!ring->closed && (spoke < least || spoke > ring->count - least))
        return false;
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    const int side = (f.corner + 2) % 3;
    const uint32_t end = crack_spoke_end(sim, ring, spoke);
    if (b->topology->neighbour[f.triangle - b->triangle_begin][side] == MESH_NONE)
        return false;
    if (!fracture_is_rim(sim, b, end))
        return true;
    /* its triangle before the spoke, seen from the far end, comes after it */
    const struct fan g = ring->fan[spoke % ring->count];
    if (far_side(sim, b, end, g.triangle) < 1)
        return false;
    return ring->closed || fracture_leaves_pieces(sim, b, f.triangle, side);
}

static void mark(struct sim *sim, struct sim_balloon *b, uint32_t point)
{
    struct fan fan;
    topology_first(sim, b, point, &fan);
    const uint32_t first = fan.triangle;
    do {
        for (int k = 0; k < 3; k++)
            b->fracture->stamp[sim->triangle_point[fan.triangle][k] - b->point_begin] = b->fracture->stamps;
    } while (topology_next(sim, b, &fan) && fan.triangle != first);
}

static void cut_spoke(struct sim *sim, struct sim_balloon *b, const struct ring *ring, int spoke)
{
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    const uint32_t point = sim->triangle_point[f.triangle][f.corner], end = crack_spoke_end(sim, ring, spoke);
    const int side = (f.corner + 2) % 3;
    const bool joins = fracture_is_rim(sim, b, point) && fracture_is_rim(sim, b, end);
    const uint32_t other = b->topology->neighbour[f.triangle - b->triangle_begin][side];
    const uint32_t falls = joins ? fracture_falls_off(sim, b, f.triangle, side) : 0;
    if (b->topology->now.edges == 0)
        sim_tell(sim, b, "fracture", "the skin tears");
    topology_cut(sim, b, f.triangle, side);
    b->fracture->now.events++;
    if (b->fracture->lost[f.triangle - b->triangle_begin]) { /* new points are as free of the gas */
        gas_let_go(sim, b, sim->triangle_point[f.triangle], 3);
        gas_let_go(sim, b, sim->triangle_point[other], 3);
    }
    if (falls)
        fracture_let_fall(sim, b, falls);
    mark(sim, b, point);
    mark(sim, b, end);
}

/* `from` is the tip that got there, NULL for a new crack. It rests as long as it takes to go there from when
 * it was last ready, but for the step that it had to wait for. */
static void add_tip(struct sim *sim, struct sim_balloon *b, const struct crack_tip *from, uint32_t start,
                    uint32_t point)
{
    struct fracture *f = b->fracture;
    struct crack_tip tip = {.point = point, .alive = 1, .since = sim->time};
    const double length = crack_rest_direction(b, start, point, tip.heading);
    const double began = from ? fmax(from->ready, sim->time - sim->step) : sim->time;
    const double speed = b->scene->fracture.tip_speed * fracture_wave_speed(b);
    tip.ready = began + (speed > 0 ? length / speed : 0); /* what has no speed waits until it has one */
    tip.run = length + (from ? from->run : 0);
    uint32_t i = 0;
    while (i < f->now.tips && f->tips[i].alive)
        i++;
    if (i == TIPS_MAX) {
        if (f->now.refused_tips++ == 0)
            sim_tell(sim, b, "fracture", "has 512 cracks that run at once: further arms stop");
        return;
    }
    f->tips[i] = tip;
    if (i == f->now.tips)
        f->now.tips++;
}

void crack_run_along(struct sim *sim, struct sim_balloon *b, const struct ring *ring, int spoke,
                     const struct crack_tip *tip)
{
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    const uint32_t point = sim->triangle_point[f.triangle][f.corner], end = crack_spoke_end(sim, ring, spoke);
    const bool ends = fracture_is_rim(sim, b, end);
    cut_spoke(sim, b, ring, spoke);
    if (!ends)
        add_tip(sim, b, tip, point, end);
}

/* The spoke that goes most nearly along a direction at rest, of those within a right angle of
 * it; -1: none may be cut. */
static int aligned_spoke(struct sim *sim, struct sim_balloon *b, uint32_t point, const struct ring *ring,
                         const double direction[3])
{
    int best = -1;
    double most = 0;
    for (int i = ring->closed ? 0 : 1; i < ring->count; i++) {
        double d[3];
        crack_rest_direction(b, point, crack_spoke_end(sim, ring, i), d);
        const double along = vec3_dot(d, direction);
        if (along > most && crack_may_cut(sim, b, ring, i, 2)) {
            most = along;
            best = i;
        }
    }
    return best;
}

/* Goes on from a point, a spoke at a time. */
static uint32_t slit_one_way(struct sim *sim, struct sim_balloon *b, uint32_t point,
                             const double direction[3], double length)
{
    uint32_t cuts = 0;
    double left = length;
    struct ring ring;
    while (left > 0 && topology_can_cut(sim, b) && crack_take_ring(sim, b, point, &ring)) {
        const int spoke = aligned_spoke(sim, b, point, &ring, direction);
        if (spoke < 0)
            break;
        const uint32_t end = crack_spoke_end(sim, &ring, spoke);
        double d[3];
        left -= crack_rest_direction(b, point, end, d);
        const bool ends = fracture_is_rim(sim, b, end);
        cut_spoke(sim, b, &ring, spoke);
        cuts++;
        if (ends)
            break;
        if (left <= 0)
            add_tip(sim, b, NULL, point, end);
        point = end;
    }
    return cuts;
}

uint32_t fracture_slit(struct sim *sim, struct sim_balloon *b, uint32_t point, const double direction[3],
                       double half_length)
{
    double forth[3], back[3];
    for (int i = 0; i < 3; i++)
        forth[i] = direction[i];
    vec3_unit(forth);
    for (int i = 0; i < 3; i++)
        back[i] = -forth[i];
    const uint32_t cuts = slit_one_way(sim, b, point, forth, half_length);
    return cuts + slit_one_way(sim, b, point, back, half_length);
}
