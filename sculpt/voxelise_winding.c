/* Generalised winding numbers over a tree of triangles: Barill et al. 2018, with the
 * first term of their series. */
#include "sculpt/voxelise_parts.h"

#include "common/array.h"
#include "common/vec3.h"

#include <math.h>
#include <stdlib.h>

/* A node is seen as one triangle from further away than so many times its radius. Barill et al. take 2 with
 * two more terms; with one alone the error of a node falls with the square of this. */
#define FAR 3.0

enum { LEAF_TRIANGLES = 8 };

/* 0 is the root; the children of an inner node are `child` and child + 1. */
struct node {
    double centre[3];      /* mean of its triangles' centroids, weighted by their areas */
    double area[3];        /* sum of their vector areas */
    double radius;         /* of a ball around centre that holds them all */
    uint32_t begin, count; /* its triangles, in `order` */
    uint32_t child;        /* 0: a leaf */
};

struct winding {
    const struct mesh *mesh;
    uint32_t *order;    /* [triangle_count] */
    float (*middle)[3]; /* [triangle_count] centroids */
    struct node *nodes;
    uint32_t count;
};

static void measure(const struct winding *winding, struct node *node)
{
    const struct mesh *mesh = winding->mesh;
    double weight = 0;
    for (uint32_t i = 0; i < node->count; i++) {
        uint32_t t = winding->order[node->begin + i];
        const uint32_t *corner = mesh->triangle[t];
        double area[3];
        vec3_triangle(mesh->position[corner[0]], mesh->position[corner[1]], mesh->position[corner[2]], area);
        double size = vec3_length(area);
        weight += size;
        for (int k = 0; k < 3; k++) {
            node->area[k] += area[k] / 2;
            node->centre[k] += size * (double)winding->middle[t][k];
        }
    }
    for (int k = 0; k < 3; k++)
        node->centre[k] = weight > 0 ? node->centre[k] / weight
                                     : (double)winding->middle[winding->order[node->begin]][k];
    for (uint32_t i = 0; i < node->count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *corner = mesh->triangle[winding->order[node->begin + i]];
            node->radius = fmax(node->radius, vec3_distance(mesh->position[corner[k]], node->centre));
        }
}

/* Parts the node's triangles by the middle of their centroids' longest extent; false
 * when that parts nothing. */
static bool part(const struct winding *winding, const struct node *node, uint32_t *first_count)
{
    uint32_t *order = winding->order + node->begin;
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int axis = 0;
    for (uint32_t i = 0; i < node->count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], winding->middle[order[i]][k]);
            high[k] = fmaxf(high[k], winding->middle[order[i]][k]);
        }
    for (int k = 1; k < 3; k++)
        axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
    float split = (low[axis] + high[axis]) / 2;
    uint32_t first = 0;
    for (uint32_t i = 0; i < node->count; i++)
        if (winding->middle[order[i]][axis] < split) {
            uint32_t swap = order[i];
            order[i] = order[first];
            order[first++] = swap;
        }
    *first_count = first;
    return first > 0 && first < node->count;
}

/* Nodes are parted in the order in which they are made: no recursion, however uneven the mesh. */
static void build(struct winding *winding)
{
    winding->nodes[0] = (struct node){.count = winding->mesh->triangle_count};
    winding->count = 1;
    for (uint32_t n = 0; n < winding->count; n++) {
        struct node *node = &winding->nodes[n];
        uint32_t first;
        measure(winding, node);
        if (node->count <= LEAF_TRIANGLES || !part(winding, node, &first))
            continue;
        node->child = winding->count;
        winding->nodes[winding->count++] = (struct node){.begin = node->begin, .count = first};
        winding->nodes[winding->count++] = (struct node){.begin = node->begin + first,
                                                         .count = node->count - first};
    }
}

enum status winding_new(const struct mesh *mesh, struct winding **result, struct error *err)
{
    struct winding *winding = calloc(1, sizeof *winding);
    size_t count = mesh->triangle_count;
    if (!winding)
        return error_no_memory(err, "the triangles' tree");
    winding->mesh = mesh;
    winding->order = array_new(count, sizeof *winding->order);
    winding->middle = array_new(count, sizeof *winding->middle);
    winding->nodes = array_new(2 * count, sizeof *winding->nodes); /* leaves hold one triangle or more */
    if (!winding->order || !winding->middle || !winding->nodes) {
        winding_free(winding);
        return error_no_memory(err, "the triangles' tree");
    }
    for (uint32_t t = 0; t < count; t++) {
        const uint32_t *corner = mesh->triangle[t];
        winding->order[t] = t;
        for (int k = 0; k < 3; k++)
            winding->middle[t][k] = (float)((mesh->position[corner[0]][k] + mesh->position[corner[1]][k] +
                                             mesh->position[corner[2]][k]) /
                                            3);
    }
    build(winding);
    *result = winding;
    return STATUS_OK;
}

void winding_free(struct winding *winding)
{
    if (!winding)
        return;
    free(winding->order);
    free(winding->middle);
    free(winding->nodes);
    free(winding);
}

double winding_of_triangle(const struct mesh *mesh, uint32_t t, const double point[3])
{
    double a[3], b[3], c[3], cross[3];
    vec3_sub(mesh->position[mesh->triangle[t][0]], point, a);
    vec3_sub(mesh->position[mesh->triangle[t][1]], point, b);
    vec3_sub(mesh->position[mesh->triangle[t][2]], point, c);
    vec3_cross(b, c, cross);
    double la = vec3_length(a), lb = vec3_length(b), lc = vec3_length(c);
    double below = la * lb * lc + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb;
    return atan2(vec3_dot(a, cross), below) / (2 * M_PI);
}

static double leaf_winding(const struct winding *winding, const struct node *node, const double point[3])
{
    double sum = 0;
    for (uint32_t i = 0; i < node->count; i++)
        sum += winding_of_triangle(winding->mesh, winding->order[node->begin + i], point);
    return sum;
}

static double node_winding(const struct winding *winding, uint32_t n, const double point[3])
{
    const struct node *node = &winding->nodes[n];
    double away[3];
    vec3_sub(node->centre, point, away);
    double distance = vec3_length(away);
    if (distance > FAR * node->radius)
        return vec3_dot(node->area, away) / (4 * M_PI * distance * distance * distance);
    if (!node->child)
        return leaf_winding(winding, node, point);
    return node_winding(winding, node->child, point) + node_winding(winding, node->child + 1, point);
}

double winding_at(const struct winding *winding, const double point[3])
{
    return node_winding(winding, 0, point);
}
