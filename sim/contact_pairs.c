/* The list of pairs that can come near each other: of points and triangles and of edges, from the triangles whose boxes meet. */
#include "common/vec3.h"
#include "sim/contact.h"

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

static void take_pair(const struct finder *f, struct contact_pair pair)
{
    struct contact *c = f->contact;
    uint32_t p[4];
    double from[4][3], to[4][3];
    struct ccd_touch touch;
    const double room = 2 * c->memory.stray + c->thickness;
    contact_points(f->sim, &pair, p);
    if (shares_point(&pair, p))
        return;
    contact_gather(c->from, p, from);
    contact_gather(c->to, p, to);
    const double distance = ccd_distance((enum ccd_kind)pair.kind, from, &touch),
                 approach = ccd_approach((enum ccd_kind)pair.kind, from, to);
    if (distance - approach > room)
        return;
    pair.distance = (float)(distance * (1 - 1e-6)); /* rounded down */
    pair.approach = (float)(approach * (1 + 1e-6));
    const uint32_t place = __atomic_fetch_add(&c->pair_count, 1, __ATOMIC_RELAXED);
    if (place < c->pair_capacity)
        c->pairs[place] = pair;
}

static void take_points(const struct finder *f, uint32_t t, uint32_t u)
{
    const struct contact_tree *tree = &f->contact->tree;
    for (int k = 0; k < 3; k++) {
        const uint32_t p = f->sim->triangle_point[t][k];
        if (f->contact->owned[t] >> k & 1 && contact_boxes_meet(&tree->point[p], &tree->box[u]))
            take_pair(f, (struct contact_pair){p, u, CCD_POINT_TRIANGLE, 0, 0});
    }
}

/* Of a triangle's own edges those that come near a box; returns how many. */
static int own_edges(const struct finder *f, uint32_t t, const struct contact_box *near, uint32_t edges[3],
                     struct contact_box boxes[3])
{
    const struct contact_box *point = f->contact->tree.point;
    int count = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t edge = f->sim->triangle_edge[t][i], *ends = f->sim->edge_point[edge];
        if (!(f->contact->owned[t] >> (i + 3) & 1))
            continue;
        boxes[count] = point[ends[0]];
        contact_box_join(&boxes[count], &point[ends[1]]);
        edges[count] = edge;
        count += contact_boxes_meet(&boxes[count], near);
    }
    return count;
}

static void take_edges(const struct finder *f, uint32_t t, uint32_t u)
{
    const struct contact_tree *tree = &f->contact->tree;
    uint32_t a[3], b[3];
    struct contact_box of_a[3], of_b[3];
    const int first = own_edges(f, t, &tree->box[u], a, of_a);
    const int second = first ? own_edges(f, u, &tree->box[t], b, of_b) : 0;
    for (int i = 0; i < first; i++)
        for (int j = 0; j < second; j++)
            if (contact_boxes_meet(&of_a[i], &of_b[j]))
                take_pair(f, (struct contact_pair){a[i] < b[j] ? a[i] : b[j], a[i] < b[j] ? b[j] : a[i],
                                                   CCD_EDGES, 0, 0});
}

/* The only point that two triangles share; MESH_NONE: there are none or more. */
static uint32_t shared_point(const uint32_t t[3], const uint32_t u[3])
{
    uint32_t shared = MESH_NONE, count = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (t[i] == u[j]) {
                shared = t[i];
                count++;
            }
    return count == 1 ? shared : MESH_NONE;
}

/* Triangles t and u that share a point, as they stand at one end of the lines: whether there is room between a plane across the
 * direction n at that point and all other points, of t on one side and of u on the other. */
static bool is_room_at(double (*x)[4], const uint32_t t[3], const uint32_t u[3], uint32_t shared,
                       const double n[3], double room)
{
    const double middle = vec3_dot(x[shared], n);
    for (int i = 0; i < 3; i++)
        if ((t[i] != shared && vec3_dot(x[t[i]], n) - middle < room) ||
            (u[i] != shared && middle - vec3_dot(x[u[i]], n) < room))
            return false;
    return true;
}

/* Such triangles as they nearly always are in a sheet: all that they do not share is apart, on both sides of a plane, all the way. */
static bool is_sheet(const struct contact *c, const uint32_t t[3], const uint32_t u[3])
{
    const uint32_t shared = shared_point(t, u);
    double n[3];
    if (shared == MESH_NONE)
        return false;
    for (int k = 0; k < 3; k++)
        n[k] = c->from[t[0]][k] + c->from[t[1]][k] + c->from[t[2]][k] - c->from[u[0]][k] - c->from[u[1]][k] -
               c->from[u[2]][k];
    const double room = (2 * c->memory.stray + c->thickness) * vec3_length(n);
    return room > 0 && is_room_at(c->from, t, u, shared, n, room) && is_room_at(c->to, t, u, shared, n, room);
}

static void take_triangles(void *context, uint32_t t, uint32_t u)
{
    const struct finder *f = context;
    if (is_sheet(f->contact, f->sim->triangle_point[t], f->sim->triangle_point[u]))
        return;
    take_points(f, t, u);
    take_points(f, u, t);
    take_edges(f, t, u);
}

enum status contact_list_find(struct sim *sim, struct error *err)
{
    struct contact *c = sim->contact;
    struct contact_ways ways = {c->from, c->to, c->memory.stray, c->thickness};
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
