/* The list of pairs that can come near each other, and how long it holds. */
#include "common/vec3.h"
#include "sim/contact.h"
#include "sim/rows.h"

#include <string.h>

void contact_points(const struct sim *sim, const struct contact_pair *pair, uint32_t points[4])
{
    if (pair->kind == CCD_POINT_TRIANGLE) {
        points[0] = pair->a;
        memcpy(points + 1, sim->triangle_point[pair->b], 3 * sizeof *points);
    } else {
        memcpy(points, sim->edge_point[pair->a], 2 * sizeof *points);
        memcpy(points + 2, sim->edge_point[pair->b], 2 * sizeof *points);
    }
}

void contact_gather(double (*x)[4], const uint32_t points[4], double places[4][3])
{
    for (int i = 0; i < 4; i++)
        memcpy(places[i], x[points[i]], 3 * sizeof(double));
}

/* A pair of triangles shares points and edges with its neighbours: each belongs to the first active triangle that has it. */
static void find_owned(const struct sim *sim, struct contact *c)
{
    memset(c->point_taken, 0, sim->point_count);
    memset(c->edge_taken, 0, sim->edge_count);
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        unsigned char bits = 0;
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++) {
            unsigned char *point = &c->point_taken[sim->triangle_point[t][k]],
                          *edge = &c->edge_taken[sim->triangle_edge[t][k]];
            bits |= (unsigned char)(!*point << k | !*edge << (k + 3));
            *point = *edge = 1;
        }
        c->owned[t] = bits;
    }
}

struct finder {
    const struct sim *sim;
    struct contact *contact;
};

static bool shares_point(const struct contact_pair *pair, const uint32_t p[4])
{
    if (pair->kind == CCD_POINT_TRIANGLE)
        return p[0] == p[1] || p[0] == p[2] || p[0] == p[3];
    return p[0] == p[2] || p[0] == p[3] || p[1] == p[2] || p[1] == p[3];
}

/* Whether boxes around the ways of the two are apart. */
static bool is_apart(const struct contact *c, const struct contact_pair *pair, const uint32_t p[4],
                     double room)
{
    const int first = pair->kind == CCD_POINT_TRIANGLE ? 1 : 2;
    for (int k = 0; k < 3; k++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (int i = 0; i < 4; i++) {
            const double a = c->from[p[i]][k], b = c->to[p[i]][k], least = a < b ? a : b,
                         most = a < b ? b : a;
            const int of = i >= first;
            low[of] = least < low[of] ? least : low[of];
            high[of] = most > high[of] ? most : high[of];
        }
        if (low[0] - high[1] > room || low[1] - high[0] > room)
            return true;
    }
    return false;
}

static void take_pair(const struct finder *f, struct contact_pair pair)
{
    struct contact *c = f->contact;
    uint32_t p[4];
    double from[4][3], to[4][3];
    struct ccd_touch touch;
    const double room = 2 * c->memory.stray + c->thickness;
    contact_points(f->sim, &pair, p);
    if (shares_point(&pair, p) || is_apart(c, &pair, p, room))
        return;
    contact_gather(c->from, p, from);
    contact_gather(c->to, p, to);
    const double near = ccd_distance((enum ccd_kind)pair.kind, from, &touch) -
                        ccd_approach((enum ccd_kind)pair.kind, from, to);
    if (near > room)
        return;
    pair.near = (float)(near - 1e-6 * fabs(near)); /* rounded down */
    const uint32_t place = __atomic_fetch_add(&c->pair_count, 1, __ATOMIC_RELAXED);
    if (place < c->pair_capacity)
        c->pairs[place] = pair;
}

static void take_points(const struct finder *f, uint32_t t, uint32_t u)
{
    for (int k = 0; k < 3; k++)
        if (f->contact->owned[t] >> k & 1)
            take_pair(f, (struct contact_pair){f->sim->triangle_point[t][k], u, CCD_POINT_TRIANGLE, 0});
}

static void take_triangles(void *context, uint32_t t, uint32_t u)
{
    const struct finder *f = context;
    take_points(f, t, u);
    take_points(f, u, t);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (f->contact->owned[t] >> (i + 3) & f->contact->owned[u] >> (j + 3) & 1) {
                const uint32_t a = f->sim->triangle_edge[t][i], b = f->sim->triangle_edge[u][j];
                take_pair(f, (struct contact_pair){a < b ? a : b, a < b ? b : a, CCD_EDGES, 0});
            }
}

enum status contact_list_find(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    struct contact_ways ways = {c->memory.is_at_rest ? c->to : c->from, c->to, c->memory.stray, c->thickness};
    struct finder finder = {sim, c};
    if (c->owned_broken != sim->broken || c->listed + 1 != c->memory.made)
        find_owned(sim, c);
    c->owned_broken = sim->broken;
    c->pair_count = 0;
    contact_tree_fit(&c->tree, sim, &ways);
    contact_tree_pairs(&c->tree, sim, take_triangles, &finder);
    c->listed = c->memory.made;
    if (c->pair_count <= c->pair_capacity)
        return STATUS_OK;
    return error_set(
        err, STATUS_RANGE,
        "%s: contact at time %g: %u pairs of points, edges and triangles are near each other, and there is "
        "room for %u; contact.thickness = %g is too much for edges of this length, or the skin is crushed",
        sim->scene->path, sim->time, c->pair_count, c->pair_capacity, c->thickness);
}

/* A tenth of the mean edge as it is now: more, and neighbours in a sheet come onto the list; less, and it is made more often. Of a sample. */
static double choose_stray(const struct sim *sim)
{
    enum { SAMPLE = 512 };
    double least = INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const uint32_t stride = (b->edge_end - b->edge_begin) / SAMPLE + 1;
        double sum = 0, count = 0;
        for (uint32_t e = b->edge_begin; e < b->edge_end; e += stride, count++)
            sum += vec3_distance(sim->position[sim->edge_point[e][0]], sim->position[sim->edge_point[e][1]]);
        least = fmin(least, fmin(sum / count, 4 * b->mean_rest_length));
    }
    return least / 10;
}

static enum status make(struct sim *sim, double (*from)[4], struct error *err)
{
    struct contact *c = sim->contact;
    memcpy(c->from, from, sim->point_count * sizeof *c->from);
    memcpy(c->to, sim->position, sim->point_count * sizeof *c->to);
    c->memory.made++;
    c->memory.stray = choose_stray(sim);
    c->memory.is_at_rest = from == sim->position;
    c->memory.began = c->now = (struct contact_drift){.growth = 1};
    c->used = 0;
    return contact_list_find(sim, err);
}

enum status contact_list_make(struct sim *sim, struct error *err)
{
    sim->contact->memory.made_in = sim->steps;
    return make(sim, sim->before, err);
}

enum status contact_list_make_ahead(struct sim *sim, struct error *err)
{
    return make(sim, sim->position, err);
}

/* A balloon that moves and grows as a whole brings nothing nearer to itself: x = middle + growth (to - its middle). Of a sample of points,
 * since any such motion will do. */
struct motion {
    double middle[3], from[3], growth;
};

static struct motion motion_of(const struct sim *sim, const struct sim_balloon *b)
{
    enum { SAMPLE = 256 };
    double(*x)[4] = sim->position, (*to)[4] = sim->contact->to;
    struct motion m = {.growth = 1};
    const uint32_t count = b->point_end - b->point_begin, stride = count / SAMPLE + 1;
    double sampled = 0, along = 0, square = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride, sampled++)
        for (int i = 0; i < 3; i++) {
            m.middle[i] += x[p][i];
            m.from[i] += to[p][i];
        }
    for (int i = 0; i < 3; i++) {
        m.middle[i] /= sampled;
        m.from[i] /= sampled;
    }
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride)
        for (int i = 0; i < 3; i++) {
            along += (x[p][i] - m.middle[i]) * (to[p][i] - m.from[i]);
            square += (to[p][i] - m.from[i]) * (to[p][i] - m.from[i]);
        }
    if (square > 0 && along > 0)
        m.growth = along / square;
    return m;
}

struct stray_job {
    struct motion *motion; /* of the balloon that the part is of; the same for all its parts */
    const struct sim_balloon *balloon;
};

static void stray_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct stray_job *job = context;
    const struct motion *m = job->motion;
    const row *position = (const row *)sim->position, *to = (const row *)sim->contact->to;
    const row shift = {m->middle[0] - m->growth * m->from[0], m->middle[1] - m->growth * m->from[1],
                       m->middle[2] - m->growth * m->from[2], 0};
    double largest = 0;
    if (part->balloon != job->balloon)
        return;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const row off = position[p] - m->growth * to[p] - shift, squares = off * off;
        const double square = squares[0] + squares[1] + squares[2];
        largest = square > largest ? square : largest;
    }
    sim->contact->strayed[part - sim->parts] = largest;
}

/* Another balloon near it is brought nearer by such a motion. */
static bool is_alone(const struct sim *sim)
{
    return sim->balloon_count == 1;
}

/* Distances between images of points under a motion grow with it, but the room that is wanted does not: what shrinks has less to stray. */
static bool balloon_holds(struct sim *sim, const struct sim_balloon *b)
{
    struct contact *c = sim->contact;
    struct motion motion = {.growth = 1};
    if (is_alone(sim) && c->memory.made_in != sim->steps)
        motion = motion_of(sim, b);
    const double growth = motion.growth < 1 ? motion.growth : 1,
                 allowed = growth * c->memory.stray - (1 - growth) * c->thickness / 2;
    double largest = 0;
    sim_each_part(sim, stray_part, &(struct stray_job){&motion, b});
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == b)
            largest = fmax(largest, c->strayed[i]);
    c->now.growth = fmin(c->now.growth, growth);
    c->now.stray = fmax(c->now.stray, sqrt(largest));
    c->used = fmax(c->used, sqrt(largest) / allowed);
    return allowed > 0 && largest <= allowed * allowed;
}

bool contact_list_holds(struct sim *sim)
{
    sim->contact->now = (struct contact_drift){.growth = 1};
    sim->contact->used = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (!balloon_holds(sim, b))
            return false;
    return true;
}
