/* How cracks run: tips, the edges they take, forks. */
#include "common/vec3.h"
#include "sim/fracture.h"

#include <math.h>
#include <string.h>

enum { FAN_MAX = 64 };

/* The triangles around a point of a rim, against the clock; spoke i lies between triangles i - 1 and i. */
struct ring {
    struct fan fan[FAN_MAX];
    struct membrane_state state[FAN_MAX];
    int count;
    bool closed;
};

static bool take_ring(const struct sim *sim, const struct sim_balloon *b, uint32_t point, struct ring *ring)
{
    struct fan fan;
    ring->closed = topology_first(sim, b, point, &fan);
    const uint32_t first = fan.triangle;
    ring->count = 0;
    do {
        if (ring->count == FAN_MAX)
            return false;
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
static uint32_t spoke_end(const struct sim *sim, const struct ring *ring, int spoke)
{
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    return sim->triangle_point[f.triangle][(f.corner + 2) % 3];
}

static double *rest_of(const struct sim_balloon *b, uint32_t point)
{
    return b->topology->rest[point - b->point_begin];
}

static void unit(double v[3])
{
    const double length = vec3_length(v);
    for (int i = 0; i < 3; i++)
        v[i] = length > 0 ? v[i] / length : 0;
}

static double rest_direction(const struct sim_balloon *b, uint32_t from, uint32_t to, double direction[3])
{
    vec3_sub(rest_of(b, to), rest_of(b, from), direction);
    const double length = vec3_length(direction);
    unit(direction);
    return length;
}

/* Nominal stress across the direction d in a triangle: with c = d . d1, s1 (1 - c^2) + s2 c^2. */
static double stress_across(const struct membrane_state *s, const double d[3])
{
    const double c = vec3_dot(s->direction, d), c2 = fmin(c * c, 1);
    return s->stress[0] * (1 - c2) + s->stress[1] * c2;
}

static double spoke_stress(const struct sim *sim, const struct ring *ring, uint32_t point, int spoke)
{
    double d[3];
    vec3_sub(sim->position[spoke_end(sim, ring, spoke)], sim->position[point], d);
    unit(d);
    const int before = (spoke + ring->count - 1) % ring->count;
    return (stress_across(&ring->state[before], d) + stress_across(&ring->state[spoke % ring->count], d)) / 2;
}

/* How many triangles a cut between two rims would leave to either side at its far end, at least. */
static int far_side(const struct sim *sim, const struct sim_balloon *b, uint32_t end, uint32_t triangle)
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
    return before < after ? before : after;
}

/* A piece falls off only if it is worth it: 4 triangles, and its share of the skin. */
static bool leaves_pieces(struct sim *sim, struct sim_balloon *b, uint32_t triangle, int side)
{
    struct fracture *f = b->fracture;
    const uint32_t other = b->topology->neighbour[triangle - b->triangle_begin][side];
    const uint32_t edge = sim->triangle_edge[triangle][side];
    int other_side = 0;
    while (sim->triangle_edge[other][other_side] != edge)
        other_side++;
    const uint32_t at[2] = {triangle, other};
    const int sides[2] = {side, other_side};
    for (int i = 0; i < 2; i++) {
        double area;
        const uint32_t count = topology_piece(sim, b, at[i], sides[i], f->list_room, f->list, f->seen, &area);
        if (count != UINT32_MAX && (count < 4 || area < b->scene->fracture.smallest * b->topology->area))
            return false;
    }
    return true;
}

/* A point of a rim keeps `least` triangles to either side of a cut. */
static bool may_cut(struct sim *sim, struct sim_balloon *b, const struct ring *ring, int spoke, int least)
{
    if (!ring->closed && (spoke < least || spoke > ring->count - least))
        return false;
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    const int side = (f.corner + 2) % 3;
    const uint32_t end = spoke_end(sim, ring, spoke);
    if (b->topology->neighbour[f.triangle - b->triangle_begin][side] == MESH_NONE)
        return false;
    if (!fracture_is_rim(sim, b, end))
        return true;
    /* its triangle before the spoke, seen from the far end, comes after it */
    const struct fan g = ring->fan[spoke % ring->count];
    if (far_side(sim, b, end, g.triangle) < least)
        return false;
    return ring->closed || leaves_pieces(sim, b, f.triangle, side);
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
    const uint32_t point = sim->triangle_point[f.triangle][f.corner], end = spoke_end(sim, ring, spoke);
    const int side = (f.corner + 2) % 3;
    const bool joins = fracture_is_rim(sim, b, point) && fracture_is_rim(sim, b, end);
    const uint32_t other = b->topology->neighbour[f.triangle - b->triangle_begin][side];
    const uint32_t falls = joins ? fracture_falls_off(sim, b, f.triangle, side) : 0;
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

static void add_tip(struct sim *sim, struct sim_balloon *b, uint32_t from, uint32_t point, double run)
{
    struct fracture *f = b->fracture;
    uint32_t i = 0;
    while (i < f->now.tips && f->tips[i].alive)
        i++;
    if (i == TIPS_MAX)
        return;
    struct crack_tip *tip = &f->tips[i];
    const double length = rest_direction(b, from, point, tip->heading);
    tip->ready = sim->time + length / (b->scene->fracture.tip_speed * f->wave_speed);
    tip->run = run + length;
    tip->point = point;
    tip->alive = 1;
    if (i == f->now.tips)
        f->now.tips++;
}

/* Cuts a spoke; its end becomes a tip unless it lay on a rim. */
static void run_along(struct sim *sim, struct sim_balloon *b, const struct ring *ring, int spoke, double run)
{
    const struct fan f = ring->fan[(spoke + ring->count - 1) % ring->count];
    const uint32_t point = sim->triangle_point[f.triangle][f.corner], end = spoke_end(sim, ring, spoke);
    const bool ends = fracture_is_rim(sim, b, end);
    cut_spoke(sim, b, ring, spoke);
    if (!ends)
        add_tip(sim, b, point, end, run);
}

/* The spoke that goes most nearly along a direction at rest, of those within a right angle of it; -1: none may be cut. */
static int aligned_spoke(struct sim *sim, struct sim_balloon *b, uint32_t point, const struct ring *ring,
                         const double direction[3])
{
    int best = -1;
    double most = 0;
    for (int i = ring->closed ? 0 : 1; i < ring->count; i++) {
        double d[3];
        rest_direction(b, point, spoke_end(sim, ring, i), d);
        const double along = vec3_dot(d, direction);
        if (along > most && may_cut(sim, b, ring, i, 2)) {
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
    while (left > 0 && topology_can_cut(sim, b) && take_ring(sim, b, point, &ring)) {
        const int spoke = aligned_spoke(sim, b, point, &ring, direction);
        if (spoke < 0)
            break;
        const uint32_t end = spoke_end(sim, &ring, spoke);
        double d[3];
        left -= rest_direction(b, point, end, d);
        const bool ends = fracture_is_rim(sim, b, end);
        cut_spoke(sim, b, &ring, spoke);
        cuts++;
        if (ends)
            break;
        if (left <= 0)
            add_tip(sim, b, point, end, 0);
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
    unit(forth);
    for (int i = 0; i < 3; i++)
        back[i] = -forth[i];
    const uint32_t cuts = slit_one_way(sim, b, point, forth, half_length);
    return cuts + slit_one_way(sim, b, point, back, half_length);
}

/* W of the skin that the tip runs into: of the patch 0.2 R ahead. */
static double energy_ahead(const struct sim_balloon *b, const struct crack_tip *tip, uint32_t triangle)
{
    const struct topology *top = b->topology;
    const struct fracture *f = b->fracture;
    double target[3];
    for (int i = 0; i < 3; i++)
        target[i] = rest_of(b, tip->point)[i] + 0.2 * f->radius * tip->heading[i];
    double nearest = INFINITY;
    for (int steps = 0; steps < 256; steps++) {
        uint32_t next = MESH_NONE;
        for (int k = 0; k < 3; k++) {
            const uint32_t n = top->neighbour[triangle - b->triangle_begin][k];
            if (n == MESH_NONE)
                continue;
            const double d = vec3_distance(f->middle[n - b->triangle_begin], target);
            if (d < nearest) {
                nearest = d;
                next = n;
            }
        }
        if (next == MESH_NONE)
            break;
        triangle = next;
    }
    const uint32_t patch = f->patch[triangle - b->triangle_begin];
    return f->patch_sum[patch] / f->patch_area[patch];
}

/* Angle of a spoke from the heading, against the clock. */
static double angle_of(const struct sim *sim, const struct sim_balloon *b, const struct crack_tip *tip,
                       const struct ring *ring, int spoke, const double normal[3])
{
    double d[3], turned[3];
    rest_direction(b, tip->point, spoke_end(sim, ring, spoke), d);
    vec3_cross(normal, tip->heading, turned);
    return atan2(vec3_dot(d, turned), vec3_dot(d, tip->heading));
}

static void rest_normal(const struct sim *sim, const struct sim_balloon *b, const struct ring *ring,
                        double normal[3])
{
    for (int i = 0; i < 3; i++)
        normal[i] = 0;
    for (int i = 0; i < ring->count; i++) {
        const uint32_t *p = sim->triangle_point[ring->fan[i].triangle];
        double twice[3];
        vec3_triangle(rest_of(b, p[0]), rest_of(b, p[1]), rest_of(b, p[2]), twice);
        for (int k = 0; k < 3; k++)
            normal[k] += twice[k];
    }
    unit(normal);
}

/* Two ways at once, each near `FORK` from the heading. Points of a rim between them keep a triangle at least. */
static bool fork(struct sim *sim, struct sim_balloon *b, struct crack_tip *tip, const struct ring *ring)
{
    const double wanted = 0.6; /* 34 degrees */
    double normal[3], best[2] = {0.6, 0.6};
    int spoke[2] = {-1, -1};
    rest_normal(sim, b, ring, normal);
    for (int i = 2; i <= ring->count - 2; i++) {
        const double angle = angle_of(sim, b, tip, ring, i, normal);
        const int side = angle > 0;
        const double off = fabs(fabs(angle) - wanted);
        if (off < best[side] && may_cut(sim, b, ring, i, 2)) {
            best[side] = off;
            spoke[side] = i;
        }
    }
    if (spoke[0] < 0 || spoke[1] < 0 || !topology_can_cut(sim, b))
        return false;
    const uint32_t point = tip->point, end = spoke_end(sim, ring, spoke[1]);
    tip->alive = 0;
    run_along(sim, b, ring, spoke[0], 0);
    /* what is left of the ring: one of the two points has the other spoke */
    struct ring rest;
    const struct fan f = ring->fan[(spoke[1] + ring->count - 1) % ring->count];
    const uint32_t now = sim->triangle_point[f.triangle][f.corner];
    (void)point;
    if (topology_can_cut(sim, b) && take_ring(sim, b, now, &rest))
        for (int i = 1; i < rest.count; i++)
            if (spoke_end(sim, &rest, i) == end) {
                run_along(sim, b, &rest, i, 0);
                break;
            }
    return true;
}

/* The edge with the largest tension across, forwards. */
static int best_spoke(struct sim *sim, struct sim_balloon *b, const struct crack_tip *tip,
                      const struct ring *ring)
{
    int best = -1;
    double most = 0;
    for (int i = 2; i <= ring->count - 2; i++) {
        double d[3];
        rest_direction(b, tip->point, spoke_end(sim, ring, i), d);
        const double along = vec3_dot(d, tip->heading);
        if (along < 0.17) /* cos 80 degrees */
            continue;
        const double stress = spoke_stress(sim, ring, tip->point, i);
        if (stress > most && may_cut(sim, b, ring, i, 2)) {
            most = stress;
            best = i;
        }
    }
    return best;
}

struct candidate {
    double strength;
    uint32_t tip;
};

/* What its triangles would release, over what it takes. */
static double tip_strength(const struct sim *sim, const struct sim_balloon *b, const struct crack_tip *tip,
                           const struct ring *ring)
{
    const struct fracture *f = b->fracture;
    double energy = 0, area = 0, noise = 0;
    (void)sim, (void)tip;
    for (int i = 0; i < ring->count; i++) {
        const uint32_t t = ring->fan[i].triangle - b->triangle_begin;
        energy += ring->state[i].energy * b->topology->rest_area[t];
        area += b->topology->rest_area[t];
        noise += f->noise[t] / ring->count;
    }
    if (!(area > 0))
        return 0;
    return energy / area * sqrt(area / 3.141592653589793) /
           (b->scene->fracture.toughness * f->radius * (1 + b->scene->fracture.weakness * noise));
}

static void advance(struct sim *sim, struct sim_balloon *b, struct crack_tip *tip)
{
    struct fracture *f = b->fracture;
    struct ring ring;
    if (f->stamp[tip->point - b->point_begin] == f->stamps || !take_ring(sim, b, tip->point, &ring))
        return;
    if (ring.closed || !topology_can_cut(sim, b)) {
        tip->alive = 0;
        return;
    }
    const double ahead = energy_ahead(b, tip, ring.fan[ring.count / 2].triangle);
    const double run = b->scene->fracture.spacing * f->radius * sqrt(fmin(1, f->branch_energy / ahead));
    if (ahead >= f->branch_energy && tip->run >= run && fork(sim, b, tip, &ring))
        return;
    const int spoke = best_spoke(sim, b, tip, &ring);
    if (spoke < 0) { /* blunted: another time, perhaps */
        tip->ready = sim->time + 0.05 * f->radius / f->wave_speed;
        return;
    }
    tip->alive = 0;
    run_along(sim, b, &ring, spoke, tip->run);
}

/* A strand, stretched past all bearing, is cut across: at a corner on a rim, along the spoke with the largest tension across. */
void fracture_snap(struct sim *sim, struct sim_balloon *b, uint32_t triangle)
{
    const struct fracture *f = b->fracture;
    struct ring ring;
    double most = 0;
    uint32_t point = MESH_NONE;
    int spoke = -1;
    for (int k = 0; k < 3; k++) {
        const uint32_t p = sim->triangle_point[triangle][k];
        if (f->stamp[p - b->point_begin] == f->stamps)
            return;
        if (!take_ring(sim, b, p, &ring) || ring.closed)
            continue;
        for (int i = 1; i < ring.count; i++) {
            const double stress = spoke_stress(sim, &ring, p, i);
            if (stress > most && may_cut(sim, b, &ring, i, 1)) {
                most = stress;
                point = p;
                spoke = i;
            }
        }
    }
    if (spoke >= 0 && topology_can_cut(sim, b) && take_ring(sim, b, point, &ring))
        run_along(sim, b, &ring, spoke, 0);
}

void fracture_tips(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    struct candidate list[TIPS_MAX];
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->now.tips; i++) {
        struct crack_tip *tip = &f->tips[i];
        struct ring ring;
        if (!tip->alive || sim->time < tip->ready || !take_ring(sim, b, tip->point, &ring))
            continue;
        const double strength = tip_strength(sim, b, tip, &ring);
        if (!(strength >= 1))
            continue;
        uint32_t at = count++;
        for (; at > 0 && list[at - 1].strength < strength; at--)
            list[at] = list[at - 1];
        list[at] = (struct candidate){strength, i};
    }
    for (uint32_t i = 0; i < count; i++)
        advance(sim, b, &f->tips[list[i].tip]);
}
