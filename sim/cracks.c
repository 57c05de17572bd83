/* How cracks run: tips, the edges they take, forks; and strands that snap. */
#include "sim/cracks.h"
#include "common/vec3.h"

#include <math.h>

/* W of the skin that the tip runs into: of the patch 0.2 R ahead. */
static double energy_ahead(const struct sim_balloon *b, const struct crack_tip *tip, uint32_t triangle)
{
    const struct topology *top = b->topology;
    const struct fracture *f = b->fracture;
    double target[3];
    for (int i = 0; i < 3; i++)
        target[i] = crack_rest(b, tip->point)[i] + 0.2 * f->radius * tip->heading[i];
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
    crack_rest_direction(b, tip->point, crack_spoke_end(sim, ring, spoke), d);
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
        vec3_triangle(crack_rest(b, p[0]), crack_rest(b, p[1]), crack_rest(b, p[2]), twice);
        for (int k = 0; k < 3; k++)
            normal[k] += twice[k];
    }
    vec3_unit(normal);
}

/* The spokes into whole skin that are nearest to 34 degrees off the heading, to either side;
 * false: there are none. */
static bool find_fork(struct sim *sim, struct sim_balloon *b, const struct crack_tip *tip,
                      const struct ring *ring, int spoke[2])
{
    const double wanted = 0.6; /* 34 degrees */
    double normal[3], best[2] = {0.6, 0.6};
    spoke[0] = spoke[1] = -1;
    rest_normal(sim, b, ring, normal);
    for (int i = 2; i <= ring->count - 2; i++) {
        const double angle = angle_of(sim, b, tip, ring, i, normal);
        const int side = angle > 0;
        const double off = fabs(fabs(angle) - wanted);
        if (off < best[side] && !fracture_is_rim(sim, b, crack_spoke_end(sim, ring, i)) &&
            crack_may_cut(sim, b, ring, i, 2)) {
            best[side] = off;
            spoke[side] = i;
        }
    }
    return spoke[0] >= 0 && spoke[1] >= 0;
}

/* Two ways at once. Between them is a triangle at least. */
static bool fork(struct sim *sim, struct sim_balloon *b, struct crack_tip *tip, const struct ring *ring)
{
    int spoke[2];
    if (!find_fork(sim, b, tip, ring, spoke))
        return false;
    const uint32_t end = crack_spoke_end(sim, ring, spoke[1]);
    const struct fan beside = ring->fan[(spoke[1] + ring->count - 1) % ring->count];
    const struct crack_tip forked = {.ready = tip->ready};
    tip->alive = 0;
    crack_run_along(sim, b, ring, spoke[0], &forked);
    /* what is left of the ring: one of the two points has the other spoke */
    struct ring rest;
    const uint32_t point = sim->triangle_point[beside.triangle][beside.corner];
    if (topology_can_cut(sim, b) && crack_take_ring(sim, b, point, &rest))
        for (int i = 1; i < rest.count; i++)
            if (crack_spoke_end(sim, &rest, i) == end) {
                crack_run_along(sim, b, &rest, i, &forked);
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
        crack_rest_direction(b, tip->point, crack_spoke_end(sim, ring, i), d);
        const double along = vec3_dot(d, tip->heading);
        if (along < 0.17) /* cos 80 degrees */
            continue;
        const double stress = crack_spoke_stress(sim, ring, tip->point, i);
        if (stress > most && crack_may_cut(sim, b, ring, i, 2)) {
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
static double tip_strength(const struct sim_balloon *b, const struct ring *ring)
{
    const struct fracture *f = b->fracture;
    double energy = 0, area = 0, noise = 0;
    for (int i = 0; i < ring->count; i++) {
        const uint32_t t = ring->fan[i].triangle - b->triangle_begin;
        energy += ring->state[i].energy * b->topology->rest_area[t];
        area += b->topology->rest_area[t];
        noise += f->noise[t] / ring->count;
    }
    if (!(area > 0))
        return 0;
    return energy / area * sqrt(area / M_PI) /
           (b->scene->fracture.toughness * f->radius * (1 + b->scene->fracture.weakness * noise));
}

static void advance(struct sim *sim, struct sim_balloon *b, struct crack_tip *tip)
{
    struct fracture *f = b->fracture;
    struct ring ring;
    if (f->stamp[tip->point - b->point_begin] == f->stamps || !crack_take_ring(sim, b, tip->point, &ring))
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
        tip->ready = sim->time + 0.05 * f->radius / fracture_wave_speed(b);
        return;
    }
    tip->alive = 0;
    crack_run_along(sim, b, &ring, spoke, &(struct crack_tip){.ready = tip->ready, .run = tip->run});
}

/* At a corner on a rim, along the spoke with the largest tension across. */
bool fracture_snap(struct sim *sim, struct sim_balloon *b, uint32_t triangle)
{
    const struct fracture *f = b->fracture;
    struct ring ring;
    double most = 0;
    uint32_t point = MESH_NONE;
    int spoke = -1;
    for (int k = 0; k < 3; k++) {
        const uint32_t p = sim->triangle_point[triangle][k];
        if (f->stamp[p - b->point_begin] == f->stamps)
            return false;
        if (!crack_take_ring(sim, b, p, &ring) || ring.closed)
            continue;
        for (int i = 1; i < ring.count; i++) {
            const double stress = crack_spoke_stress(sim, &ring, p, i);
            if (stress > most && crack_may_cut(sim, b, &ring, i, 1)) {
                most = stress;
                point = p;
                spoke = i;
            }
        }
    }
    if (spoke < 0 || !topology_can_cut(sim, b) || !crack_take_ring(sim, b, point, &ring))
        return false;
    crack_run_along(sim, b, &ring, spoke, NULL);
    return true;
}

void fracture_tips(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    struct candidate list[TIPS_MAX];
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->now.tips; i++) {
        struct crack_tip *tip = &f->tips[i];
        struct ring ring;
        if (!tip->alive || sim->time < tip->ready || !crack_take_ring(sim, b, tip->point, &ring))
            continue;
        const double strength = tip_strength(b, &ring);
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
