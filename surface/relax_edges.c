#include "surface/relax_edges.h"

#include "common/vec3.h"

#include <math.h>
#include <string.h>

/* A triangle's worth. */
struct worth {
    double angle;  /* sine of the smallest angle, squared */
    double facing; /* smallest cosine between its normal and a point's */
};

/* No change may turn a triangle further from its points' normals than this cosine, or than it was. */
#define FACING_LEAST 0.35

/* sin^2 of 13 degrees: narrower than this no change may make a triangle, unless it was. */
#define ANGLE_LEAST 0.05

static const struct worth best_worth = {1, 1};

static double least_of(double a, double b, double c)
{
    double least = a < b ? a : b;
    return least < c ? least : c;
}

/* The smallest angle lies between the two longer sides: its sine is twice the area over their product. 0
 * where there is no area. */
static double angle_of(const double *const place[3], double across[3])
{
    vec3_triangle(place[0], place[1], place[2], across);
    double a = vec3_square_distance(place[0], place[1]), b = vec3_square_distance(place[1], place[2]),
           c = vec3_square_distance(place[2], place[0]), area = vec3_dot(across, across);
    double shortest = least_of(a, b, c), longer = shortest > 0 ? a * b * c / shortest : 0;
    return area > 0 && longer > 0 ? area / longer : 0;
}

static struct worth worth_of(const double *const place[3], const double *const normal[3])
{
    double across[3], angle = angle_of(place, across);
    if (!(angle > 0))
        return (struct worth){0, -1};
    double facing = least_of(vec3_dot(across, normal[0]), vec3_dot(across, normal[1]),
                             vec3_dot(across, normal[2]));
    return (struct worth){angle, facing / vec3_length(across)};
}

static struct worth worse(struct worth a, struct worth b)
{
    return (struct worth){fmin(a.angle, b.angle), fmin(a.facing, b.facing)};
}

static bool acceptable(struct worth now, struct worth before)
{
    return now.facing >= fmin(FACING_LEAST, before.facing) && now.angle >= fmin(ANGLE_LEAST, before.angle);
}

static struct worth worth_of_points(const struct remesh *r, uint32_t a, uint32_t b, uint32_t c)
{
    return worth_of((const double *const[]){r->position[a], r->position[b], r->position[c]},
                    (const double *const[]){r->normal[a], r->normal[b], r->normal[c]});
}

static struct worth worth_of_triangle(const struct remesh *r, uint32_t t)
{
    return worth_of_points(r, r->triangle[t][0], r->triangle[t][1], r->triangle[t][2]);
}

static double side_square(const struct remesh *r, uint32_t side)
{
    return vec3_square_distance(r->position[side_point(r, side)],
                                r->position[side_point(r, side_next(side))]);
}

static bool alive(const struct remesh *r, uint32_t side)
{
    return r->triangle[side / 3][0] != MESH_NONE;
}

/* Once for both sides of an edge. */
static bool is_first(const struct remesh *r, uint32_t side)
{
    return alive(r, side) && side < side_across(r, side);
}

/* Halfway along an edge, on the arc that leaves its ends at right angles to their normals: with e the edge, a
 * circle's arc rises (n_b . e - n_a . e) / 8 above the chord. */
static void halfway(const struct remesh *r, uint32_t side, double place[3], double normal[3])
{
    uint32_t a = side_point(r, side), b = side_point(r, side_next(side));
    double edge[3];
    vec3_sub(r->position[b], r->position[a], edge);
    double rise = (vec3_dot(r->normal[b], edge) - vec3_dot(r->normal[a], edge)) / 8;
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = r->normal[a][axis] + r->normal[b][axis];
    double length = vec3_length(normal);
    rise = length > 1 ? rise : 0; /* ends that face apart tell nothing about what is between them */
    for (int axis = 0; axis < 3; axis++) {
        normal[axis] = length > 0 ? normal[axis] / length : r->normal[a][axis];
        place[axis] = r->position[a][axis] + edge[axis] / 2 + rise * normal[axis];
    }
}

/* The worst of the triangles round a point but those of the edge's two sides, as they are and with the point
 * at another place; false where one of their edges from there would be longer than sqrt(most_square). */
static bool try_moved(const struct remesh *r, uint32_t point, uint32_t side, const double place[3],
                      const double normal[3], double most_square, struct worth *before, struct worth *after)
{
    uint32_t ring[RING_MAX];
    int count = remesh_ring(r, point, ring);
    for (int i = 0; i < count; i++) {
        uint32_t t = ring[i] / 3, p = side_point(r, side_next(ring[i])),
                 q = side_point(r, side_next(side_next(ring[i])));
        *before = worse(*before, worth_of_triangle(r, t));
        if (t == side / 3 || t == side_across(r, side) / 3)
            continue;
        if (vec3_square_distance(place, r->position[p]) > most_square)
            return false;
        *after = worse(*after, worth_of((const double *const[]){place, r->position[p], r->position[q]},
                                        (const double *const[]){normal, r->normal[p], r->normal[q]}));
    }
    return true;
}

struct change {
    double place[3], normal[3];
    struct worth before, after;
};

/* Merging an edge's ends halfway, or at either. */
static bool try_collapse(const struct remesh *r, uint32_t side, int where, double most_square,
                         struct change *change)
{
    uint32_t a = side_point(r, side), b = side_point(r, side_next(side));
    change->before = change->after = best_worth;
    if (where == 0) {
        halfway(r, side, change->place, change->normal);
    } else {
        memcpy(change->place, r->position[where == 1 ? a : b], sizeof change->place);
        memcpy(change->normal, r->normal[where == 1 ? a : b], sizeof change->normal);
    }
    return try_moved(r, a, side, change->place, change->normal, most_square, &change->before,
                     &change->after) &&
           try_moved(r, b, side, change->place, change->normal, most_square, &change->before, &change->after);
}

void edges_collapse(struct remesh *r, double least, double most, uint32_t count)
{
    for (uint32_t side = 0; side < 3 * r->triangle_count && count; side++) {
        if (!is_first(r, side) || side_square(r, side) >= least * least || !remesh_collapse_allowed(r, side))
            continue;
        struct change change;
        for (int where = 0; where < 3; where++) {
            if (!try_collapse(r, side, where, most * most, &change) ||
                !acceptable(change.after, change.before))
                continue;
            remesh_collapse(r, side, change.place, change.normal);
            count--;
            break;
        }
    }
}

bool edges_merge(struct remesh *r, uint32_t point)
{
    uint32_t ring[RING_MAX], best_side = MESH_NONE;
    struct change change, best = {.after = {.facing = -2}};
    const int count = remesh_ring(r, point, ring);
    for (int i = 0; i < count; i++)
        if (remesh_collapse_allowed(r, ring[i]) && try_collapse(r, ring[i], 2, INFINITY, &change) &&
            change.after.facing > best.after.facing) {
            best = change;
            best_side = ring[i];
        }
    if (best_side != MESH_NONE)
        remesh_collapse(r, best_side, best.place, best.normal);
    return best_side != MESH_NONE;
}

static struct worth worth_of_halves(const struct remesh *r, uint32_t side, const struct change *change)
{
    struct worth worth = best_worth;
    const uint32_t sides[] = {side, side_across(r, side)};
    for (int i = 0; i < 2; i++) {
        uint32_t a = side_point(r, sides[i]), b = side_point(r, side_next(sides[i])),
                 c = side_point(r, side_next(side_next(sides[i])));
        worth = worse(worth, worth_of((const double *const[]){r->position[a], change->place, r->position[c]},
                                      (const double *const[]){r->normal[a], change->normal, r->normal[c]}));
        worth = worse(worth, worth_of((const double *const[]){change->place, r->position[b], r->position[c]},
                                      (const double *const[]){change->normal, r->normal[b], r->normal[c]}));
    }
    return worth;
}

static void try_split(const struct remesh *r, uint32_t side, struct change *change)
{
    halfway(r, side, change->place, change->normal);
    change->before = worse(worth_of_triangle(r, side / 3), worth_of_triangle(r, side_across(r, side) / 3));
    change->after = worth_of_halves(r, side, change);
}

bool edges_split(struct remesh *r, double most, uint32_t count)
{
    uint32_t sides = 3 * r->triangle_count;
    for (uint32_t side = 0; side < sides && count; side++) {
        if (!is_first(r, side) || side_square(r, side) <= most * most)
            continue;
        struct change change;
        try_split(r, side, &change);
        if (change.after.facing < fmin(FACING_LEAST, change.before.facing))
            continue;
        if (!remesh_split(r, side, change.place, change.normal))
            return false;
        count--;
    }
    return true;
}

static int off_six(int degree)
{
    return (degree - 6) * (degree - 6);
}

/* How much nearer to six neighbours a flip brings the four points: the fall of their squared differences. */
static int flip_gain(const struct remesh *r, uint32_t side)
{
    uint32_t other = side_across(r, side);
    int a = r->degree[side_point(r, side)], b = r->degree[side_point(r, other)];
    int c = r->degree[side_point(r, side_next(side_next(side)))];
    int d = r->degree[side_point(r, side_next(side_next(other)))];
    return off_six(a) + off_six(b) + off_six(c) + off_six(d) - off_six(a - 1) - off_six(b - 1) -
           off_six(c + 1) - off_six(d + 1);
}

static bool try_flip(const struct remesh *r, uint32_t side, double most_square, struct change *change)
{
    uint32_t other = side_across(r, side);
    uint32_t a = side_point(r, side), b = side_point(r, other);
    uint32_t c = side_point(r, side_next(side_next(side))), d = side_point(r, side_next(side_next(other)));
    if (vec3_square_distance(r->position[c], r->position[d]) > most_square)
        return false;
    change->before = worse(worth_of_triangle(r, side / 3), worth_of_triangle(r, other / 3));
    change->after = worse(worth_of_points(r, a, d, c), worth_of_points(r, d, b, c));
    return change->after.facing >= fmin(FACING_LEAST, change->before.facing);
}

/* sin^2 of 30 degrees: below this a flip that opens the angle is worth a point with seven neighbours. */
#define ANGLE_NARROW 0.25

static bool is_narrow(const struct remesh *r, uint32_t t)
{
    const uint32_t *p = r->triangle[t];
    double across[3];
    return angle_of((const double *const[]){r->position[p[0]], r->position[p[1]], r->position[p[2]]},
                    across) < ANGLE_NARROW;
}

void edges_flip(struct remesh *r, double most)
{
    for (uint32_t side = 0; side < 3 * r->triangle_count; side++) {
        if (!is_first(r, side))
            continue;
        int gain = flip_gain(r, side);
        struct change change;
        if (gain < -4 || (gain <= 0 && !is_narrow(r, side / 3) && !is_narrow(r, side_across(r, side) / 3)))
            continue;
        if (!try_flip(r, side, most * most, &change))
            continue;
        bool regular = gain > 0 && change.after.angle > fmin(0.5 * change.before.angle, ANGLE_LEAST);
        bool wider = change.before.angle < ANGLE_NARROW && change.after.angle > 1.3 * change.before.angle;
        if ((regular || wider) && remesh_flip_allowed(r, side))
            remesh_flip(r, side);
    }
}

double edges_mean(const struct remesh *r)
{
    double total = 0;
    for (uint32_t side = 0; side < 3 * r->triangle_count; side++)
        if (is_first(r, side))
            total += sqrt(side_square(r, side));
    return total / (1.5 * r->triangles_alive);
}

enum { BINS = 400 };

double edges_quantile(const struct remesh *r, double mean, uint32_t count, bool below)
{
    uint32_t bins[BINS] = {0}, so_far = 0;
    double width = 4 * mean / BINS;
    for (uint32_t side = 0; side < 3 * r->triangle_count; side++)
        if (is_first(r, side))
            bins[(int)fmin(sqrt(side_square(r, side)) / width, BINS - 1)]++;
    for (int i = 0; i < BINS; i++) {
        int bin = below ? i : BINS - 1 - i;
        so_far += bins[bin];
        if (so_far >= count)
            return width * (below ? bin + 1 : bin);
    }
    return below ? INFINITY : 0;
}

enum cure { CURE_NONE, CURE_FLIP, CURE_COLLAPSE, CURE_SPLIT };

struct best_cure {
    enum cure cure;
    uint32_t side;
    double angle;
    struct change change;
};

static void consider(struct best_cure *best, enum cure cure, uint32_t side, const struct change *change)
{
    if (change->after.facing < fmin(FACING_LEAST, change->before.facing) ||
        change->after.angle <= best->angle)
        return;
    *best = (struct best_cure){cure, side, change->after.angle, *change};
}

static struct best_cure find_cure(const struct remesh *r, uint32_t t, double mean)
{
    double before = worth_of_triangle(r, t).angle, most = 2.4 * mean * mean; /* (1.55 mean)^2 */
    struct best_cure best = {.angle = 1.05 * before};
    for (uint32_t side = 3 * t; side < 3 * t + 3; side++) {
        struct change change;
        if (try_flip(r, side, most, &change) && remesh_flip_allowed(r, side))
            consider(&best, CURE_FLIP, side, &change);
        for (int where = 0; where < 3 && remesh_collapse_allowed(r, side); where++)
            if (try_collapse(r, side, where, most, &change))
                consider(&best, CURE_COLLAPSE, side, &change);
        if (side_square(r, side) < mean * mean)
            continue;
        try_split(r, side, &change);
        consider(&best, CURE_SPLIT, side, &change);
    }
    return best;
}

size_t edges_cure(struct remesh *r, double mean, double angle_deg, bool *good)
{
    double least = pow(sin(angle_deg * M_PI / 180), 2);
    size_t found = 0;
    uint32_t triangles = r->triangle_count;
    for (uint32_t t = 0; t < triangles && *good; t++) {
        if (!alive(r, 3 * t) || worth_of_triangle(r, t).angle >= least)
            continue;
        found++;
        struct best_cure best = find_cure(r, t, mean);
        if (best.cure == CURE_FLIP)
            remesh_flip(r, best.side);
        else if (best.cure == CURE_COLLAPSE)
            remesh_collapse(r, best.side, best.change.place, best.change.normal);
        else if (best.cure == CURE_SPLIT)
            *good = remesh_split(r, best.side, best.change.place, best.change.normal);
    }
    return found;
}
