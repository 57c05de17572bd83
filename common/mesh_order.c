/*
 * Neighbours in the mesh become neighbours in memory: points in the order of a walk in breadth from one
 * end of the mesh (Cuthill & McKee 1969), so that a loop over edges or triangles runs along a front that
 * stays in the cache. Compared with the order along a Morton curve, a step over 1.3 million triangles
 * takes two thirds of the time.
 */
#include "common/array.h"
#include "common/mesh.h"

#include <stdlib.h>
#include <string.h>

/* The neighbours of point p are neighbour[begin[p]] ... neighbour[begin[p + 1] - 1], in
 * the order of the edges. */
struct graph {
    uint32_t *begin, *neighbour;
};

static bool make_graph(const struct mesh *mesh, struct graph *graph)
{
    graph->begin = calloc((size_t)mesh->point_count + 2, sizeof *graph->begin);
    graph->neighbour = array_new(mesh->edge_count, 2 * sizeof *graph->neighbour);
    if (!graph->begin || !graph->neighbour)
        return false;
    uint32_t *next = graph->begin + 1; /* once filled, next[p] is where p's end: begin[p + 1] */
    for (uint32_t e = 0; e < mesh->edge_count; e++)
        for (int k = 0; k < 2; k++)
            next[mesh->edge[e][k] + 1]++;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        next[p + 1] += next[p];
    for (uint32_t e = 0; e < mesh->edge_count; e++)
        for (int k = 0; k < 2; k++)
            graph->neighbour[next[mesh->edge[e][k]]++] = mesh->edge[e][1 - k];
    return true;
}

/* Where the mesh begins along its longest side: the fronts of the walk are short from there. */
static uint32_t find_end(const struct mesh *mesh)
{
    uint32_t best = 0;
    double longest = -1;
    for (int i = 0; i < 3; i++) {
        uint32_t low = 0, high = 0;
        for (uint32_t p = 1; p < mesh->point_count; p++) {
            low = mesh->position[p][i] < mesh->position[low][i] ? p : low;
            high = mesh->position[p][i] > mesh->position[high][i] ? p : high;
        }
        if (mesh->position[high][i] - mesh->position[low][i] > longest) {
            longest = mesh->position[high][i] - mesh->position[low][i];
            best = low;
        }
    }
    return best;
}

/* order[i] becomes the point that comes i-th, number[p] the place of point p; one
 * component after the other. */
static void walk(const struct mesh *mesh, const struct graph *graph, uint32_t *order, uint32_t *number)
{
    uint32_t found = 0, looked = 0;
    memset(number, 0xff, mesh->point_count * sizeof *number);
    for (uint32_t i = 0; i <= mesh->point_count; i++) {
        const uint32_t start = i == 0 ? find_end(mesh) : i - 1;
        if (number[start] == MESH_NONE) {
            number[start] = found;
            order[found++] = start;
        }
        for (; looked < found; looked++)
            for (uint32_t k = graph->begin[order[looked]]; k < graph->begin[order[looked] + 1]; k++) {
                const uint32_t q = graph->neighbour[k];
                if (number[q] == MESH_NONE) {
                    number[q] = found;
                    order[found++] = q;
                }
            }
    }
}

static uint32_t lowest(const uint32_t p[3])
{
    const uint32_t low = p[0] < p[1] ? p[0] : p[1];
    return low < p[2] ? low : p[2];
}

/* order[i] becomes the triangle that comes i-th: by their lowest points, which count
 * has one more place than. */
static void sort_triangles(const struct mesh *mesh, uint32_t *count, uint32_t *order)
{
    memset(count, 0, (mesh->point_count + 1) * sizeof *count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        count[lowest(mesh->triangle[t]) + 1]++;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        count[p + 1] += count[p];
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        order[count[lowest(mesh->triangle[t])]++] = t;
}

/* Puts the rows into that order; room holds as many. */
static void move_rows(void *rows, size_t size, const uint32_t *order, uint32_t count, void *room)
{
    unsigned char *to = room;
    for (uint32_t i = 0; i < count; i++)
        memcpy(to + i * size, (const unsigned char *)rows + order[i] * size, size);
    memcpy(rows, room, count * size);
}

static void renumber(struct mesh *mesh, const struct graph *graph, uint32_t *order, uint32_t *number,
                     void *room)
{
    walk(mesh, graph, order, number);
    move_rows(mesh->position, sizeof *mesh->position, order, mesh->point_count, room);
    if (mesh->normal)
        move_rows(mesh->normal, sizeof *mesh->normal, order, mesh->point_count, room);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            mesh->triangle[t][k] = number[mesh->triangle[t][k]];
    sort_triangles(mesh, number, order);
    move_rows(mesh->triangle, sizeof *mesh->triangle, order, mesh->triangle_count, room);
    mesh_disconnect(mesh); /* edges of the points as they were */
}

enum status mesh_order(struct mesh *mesh, struct error *err)
{
    const uint32_t points = mesh->point_count, triangles = mesh->triangle_count;
    const size_t most = points > triangles ? points : triangles;
    struct graph graph = {0};
    uint32_t *order = array_new(most, sizeof *order), *number = array_new((size_t)points + 1, sizeof *number);
    double(*room)[3] = array_new(most, sizeof *room);
    const bool fits = order && number && room && make_graph(mesh, &graph);
    if (fits)
        renumber(mesh, &graph, order, number, room);
    free(graph.begin);
    free(graph.neighbour);
    free(order);
    free(number);
    free(room);
    return fits ? mesh_connect(mesh, err) : error_no_memory(err, "the order of the points");
}
