#include "sim/obstacles.h"
#include "common/vec3.h"
#include "sim/kernels.h"
#include "sim/ledger.h"
#include "sim/sweep.h"

#include <string.h>

static double height_above(const struct obstacle *o, const double x[3])
{
    double from[3];
    vec3_sub(x, o->place, from);
    return vec3_dot(from, o->normal);
}

bool obstacle_holds(const struct obstacle *o, const double x[3])
{
    switch (o->kind) {
    case OBSTACLE_PLANE:
        return height_above(o, x) < 0;
    case OBSTACLE_SPHERE:
        return vec3_distance(x, o->place) < o->radius;
    case OBSTACLE_BOX:
        return fabs(x[0] - o->place[0]) < o->half[0] && fabs(x[1] - o->place[1]) < o->half[1] &&
               fabs(x[2] - o->place[2]) < o->half[2];
    }
    return false;
}

/* Ten digits of the largest number there is in it are enough for any rounding. */
static double rounding(const struct obstacle *o, double box[2][4])
{
    double largest = o->radius;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fmax(fabs(box[0][i]), fabs(box[1][i])) + fabs(o->place[i]) + o->half[i]);
    return 1e-10 * largest;
}

double obstacle_gap(const struct obstacle *o, double box[2][4])
{
    double height = 0, squared = 0, widest = 0;
    for (int i = 0; i < 3; i++) {
        const double low = box[0][i] - o->place[i], high = box[1][i] - o->place[i],
                     beside = fmax(fmax(low, -high), 0);
        height += fmin(o->normal[i] * low, o->normal[i] * high);
        squared += beside * beside;
        widest = fmax(widest, beside - o->half[i]);
    }
    const double gap[] = {
        [OBSTACLE_PLANE] = height, [OBSTACLE_SPHERE] = sqrt(squared) - o->radius, [OBSTACLE_BOX] = widest};
    return gap[o->kind] - rounding(o, box);
}

static double enter_plane(const struct obstacle *o, const double a[3], const double b[3], double normal[3])
{
    const double above = fmax(height_above(o, a), 0), below = height_above(o, b);
    memcpy(normal, o->normal, sizeof o->normal);
    return below < 0 ? above / (above - below) : INFINITY;
}

/* |a + t d - c| = r, the smaller root, in the form that does not cancel. */
static double enter_sphere(const struct obstacle *o, const double a[3], const double b[3], double normal[3])
{
    double d[3], from[3];
    vec3_sub(b, a, d);
    vec3_sub(a, o->place, from);
    const double along = vec3_dot(d, from), squared = vec3_dot(d, d),
                 outside = fmax(vec3_dot(from, from) - o->radius * o->radius, 0),
                 root = along * along - squared * outside;
    if (along >= 0 || root < 0)
        return INFINITY;
    const double t = outside / (-along + sqrt(root));
    for (int i = 0; i < 3; i++)
        normal[i] = from[i] + t * d[i];
    const double length = vec3_length(normal);
    for (int i = 0; i < 3; i++)
        normal[i] /= length;
    return t <= 1 ? t : INFINITY;
}

/* Between the last of the three slabs that is entered and the first that is left. */
static double enter_box(const struct obstacle *o, const double a[3], const double b[3], double normal[3])
{
    double enter = -INFINITY, leave = INFINITY;
    int axis = 0;
    for (int i = 0; i < 3; i++) {
        const double way = b[i] - a[i], side = way > 0 ? -o->half[i] : o->half[i];
        if (way == 0 && fabs(a[i] - o->place[i]) >= o->half[i])
            return INFINITY;
        if (way == 0)
            continue;
        const double in = (o->place[i] + side - a[i]) / way, out = (o->place[i] - side - a[i]) / way;
        if (in > enter) {
            enter = in;
            axis = i;
        }
        leave = fmin(leave, out);
    }
    if (!(enter < leave) || enter > 1 || leave <= 0 || enter == -INFINITY)
        return INFINITY;
    for (int i = 0; i < 3; i++)
        normal[i] = i != axis ? 0 : b[i] > a[i] ? -1 : 1;
    return fmax(enter, 0);
}

double obstacle_entry(const struct obstacle *o, const double a[3], const double b[3], double normal[3])
{
    switch (o->kind) {
    case OBSTACLE_PLANE:
        return enter_plane(o, a, b, normal);
    case OBSTACLE_SPHERE:
        return enter_sphere(o, a, b, normal);
    case OBSTACLE_BOX:
        return enter_box(o, a, b, normal);
    }
    return INFINITY;
}

/* The first on the way. */
static const struct obstacle *first_entry(const struct obstacles *obstacles, const double a[3],
                                          const double b[3], double *time, double normal[3])
{
    const struct obstacle *first = NULL;
    *time = INFINITY;
    for (size_t i = 0; i < obstacles->count; i++) {
        double n[3];
        const double t = obstacle_entry(&obstacles->items[i], a, b, n);
        if (t < *time) {
            *time = t;
            first = &obstacles->items[i];
            memcpy(normal, n, sizeof n);
        }
    }
    return first;
}

/* What goes into the surface is taken, or thrown back; what goes along it loses friction times that. */
static void turn(const struct obstacle *o, const double normal[3], double v[3])
{
    const double into = -vec3_dot(v, normal);
    if (into <= 0)
        return;
    for (int i = 0; i < 3; i++)
        v[i] += into * normal[i];
    const double along = vec3_length(v), taken = o->friction * (1 + o->bounce) * into,
                 left = taken < along ? 1 - taken / along : 0;
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * left + o->bounce * into * normal[i];
}

static bool is_inside_any(const struct obstacles *obstacles, const double x[3])
{
    for (size_t i = 0; i < obstacles->count; i++)
        if (obstacle_holds(&obstacles->items[i], x))
            return true;
    return false;
}

/* Puts the point in front of the surface, further and further until rounding agrees; between two surfaces
 * that leave no room for it, back to where it was. */
static void put_outside(const struct obstacles *obstacles, const double normal[3], const double last[3],
                        double x[3])
{
    enum { TRIES = 10 };
    double margin = obstacles->margin;
    for (int i = 0; i < TRIES; i++, margin *= 2) {
        double out[3];
        for (int k = 0; k < 3; k++)
            out[k] = x[k] + margin * normal[k];
        if (!is_inside_any(obstacles, out)) {
            memcpy(x, out, sizeof out);
            return;
        }
    }
    memcpy(x, last, 3 * sizeof *x);
}

bool obstacles_turn(const struct obstacles *obstacles, const double from[3], double x[3], double velocity[3])
{
    enum { TURNS_MAX = 8 };
    double here[3] = {from[0], from[1], from[2]};
    for (int turns = 0; turns < TURNS_MAX; turns++) {
        double time, normal[3], rest[3], hit[3];
        const struct obstacle *o = first_entry(obstacles, here, x, &time, normal);
        if (!o)
            return turns > 0;
        for (int i = 0; i < 3; i++) {
            rest[i] = (x[i] - here[i]) * (1 - time);
            hit[i] = here[i] + (x[i] - here[i]) * time;
        }
        put_outside(obstacles, normal, here, hit);
        turn(o, normal, rest);
        turn(o, normal, velocity);
        for (int i = 0; i < 3; i++) {
            here[i] = hit[i];
            x[i] = hit[i] + rest[i];
        }
    }
    memcpy(x, here, sizeof here);
    return true;
}

static double least_gap(const struct obstacles *obstacles, double box[2][4])
{
    double least = INFINITY;
    for (size_t i = 0; i < obstacles->count; i++)
        least = fmin(least, obstacle_gap(&obstacles->items[i], box));
    return least;
}

static void add_box(double box[2][4], double more[2][4])
{
    for (int i = 0; i < 3; i++) {
        box[0][i] = fmin(box[0][i], more[0][i]);
        box[1][i] = fmax(box[1][i], more[1][i]);
    }
}

static const struct obstacles_found nothing = {
    0, {{INFINITY, INFINITY, INFINITY, 0}, {-INFINITY, -INFINITY, -INFINITY, 0}}};

/* Block by block: most are nowhere near anything. */
static void settle_part(struct sim *sim, const struct sim_part *part, void *context)
{
    enum { BLOCK = 64 };
    const struct obstacles *obstacles = context;
    struct obstacles_found found = nothing;
    for (uint32_t begin = part->point_begin; begin < part->point_end;) {
        const uint32_t left = part->point_end - begin, end = begin + (left < BLOCK ? left : BLOCK);
        double box[2][4];
        sim->kernels->box_ways(sim, begin, end, box);
        const bool near = !(least_gap(obstacles, box) > 0);
        for (uint32_t p = begin; p < end && near; p++) {
            if (!obstacles_turn(obstacles, sim->before[p], sim->position[p], sim->velocity[p]))
                continue;
            sweep_see_pushed(sim, (size_t)(part - sim->parts), p);
            found.touched++;
        }
        add_box(found.box, box);
        begin = end;
    }
    obstacles->found[part - sim->parts] = found;
}

/* From each balloon's box as a whole: which does not depend on how its points are shared out. What was turned
 * stays in it, or at the surface. */
static double find_room(const struct sim *sim, const struct sim_balloon *b)
{
    struct obstacles_found all = nothing;
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == b)
            add_box(all.box, sim->obstacles->found[i].box);
    return least_gap(sim->obstacles, all.box);
}

bool obstacles_settle(struct sim *sim)
{
    struct obstacles *obstacles = sim->obstacles;
    const double moved = sweep_saw_farthest(sim) * (1 + 1e-9);
    if (moved < obstacles->room && !sim->contact) { /* which moves points afterwards */
        obstacles->room -= moved;
        return false;
    }
    const bool told = sweep_sees_pushes(sim);
    uint32_t touched = 0;
    ledger_note(sim);
    sim_each_part(sim, settle_part, obstacles);
    for (size_t i = 0; i < sim->part_count; i++)
        touched += obstacles->found[i].touched;
    sim->pushed = touched > 0 && told;
    obstacles->room = touched > 0 ? 0 : INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        obstacles->room = fmin(obstacles->room, find_room(sim, b));
    return touched > 0;
}
