/*
 * Edges of a mesh. A triangle's three sides, written 3 t + k, are sorted into bins by their smaller point
 * with one counting pass. Within a bin a table by the larger point tells the sides of one edge apart. Each
 * side so learns the first side of its edge, and numbering follows the triangles' order. Every step is a
 * walk over an array: nothing is sorted, searched or allocated edge by edge, and no shape of mesh makes it
 * slower.
 */
#include "common/array.h"
#include "common/mesh.h"

#include <stdlib.h>
#include <string.h>

/* The two points of side k of triangle t, where side = 3 t + k: the smaller first. */
static void side_points(const struct mesh *mesh, uint32_t side, uint32_t points[2])
{
    const uint32_t *corner = mesh->triangle[side / 3];
    uint32_t a = corner[side % 3], b = corner[(side % 3 + 1) % 3];
    points[0] = a < b ? a : b;
    points[1] = a < b ? b : a;
}

static enum status check_corners(const struct mesh *mesh, struct error *err)
{
    if (mesh->triangle_count > MESH_NONE / 3)
        return error_set(err, STATUS_RANGE, "%u triangles are too many to find their edges; at most %u",
                         mesh->triangle_count, MESH_NONE / 3);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++) {
            if (mesh->triangle[t][k] >= mesh->point_count)
                return error_set(err, STATUS_INPUT, "triangle %u has point %u; the last one is %u", t,
                                 mesh->triangle[t][k], mesh->point_count - 1);
        }
    }
    return STATUS_OK;
}

/* The sides in the order of their smaller point, and within one point in the triangles' order: binned[3
 * triangle_count]. bin_end[point_count + 1], zeros on entry, ends as the place behind each point's bin. */
static void bin_sides(const struct mesh *mesh, uint32_t *bin_end, uint32_t *binned)
{
    uint32_t side_count = 3 * mesh->triangle_count, points[2];
    for (uint32_t side = 0; side < side_count; side++) {
        side_points(mesh, side, points);
        bin_end[points[0] + 1]++;
    }
    for (uint32_t p = 0; p < mesh->point_count; p++)
        bin_end[p + 1] += bin_end[p];
    for (uint32_t side = 0; side < side_count; side++) {
        side_points(mesh, side, points);
        binned[bin_end[points[0]]++] = side;
    }
}

/* first[side] = the first side, in the triangles' order, of the same edge. seen[point_count] is room to
 * work. A side that `seen` kept from an earlier bin is recognised by its smaller point. */
static void find_first_sides(const struct mesh *mesh, const uint32_t *binned, uint32_t *seen, uint32_t *first)
{
    memset(seen, 0xff, mesh->point_count * sizeof *seen);
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        uint32_t side = binned[i], points[2], other[2];
        side_points(mesh, side, points);
        uint32_t *last = &seen[points[1]];
        if (*last != MESH_NONE)
            side_points(mesh, *last, other);
        if (*last == MESH_NONE || other[0] != points[0])
            *last = side;
        first[side] = *last;
    }
}

/* Turns each side's first side into the edge's number, in place, and returns how many edges there are. A
 * first side comes before the others of its edge, so its number is known when they ask. */
static uint32_t number_edges(uint32_t *side_edge, uint32_t side_count)
{
    uint32_t edge_count = 0;
    for (uint32_t side = 0; side < side_count; side++)
        side_edge[side] = side_edge[side] == side ? edge_count++ : side_edge[side_edge[side]];
    return edge_count;
}

static void list_edges(const struct mesh *mesh, const uint32_t *side_edge, uint32_t (*edge)[2])
{
    uint32_t known = 0;
    for (uint32_t side = 0; side < 3 * mesh->triangle_count; side++) {
        if (side_edge[side] == known)
            side_points(mesh, side, edge[known++]);
    }
}

enum status mesh_connect(struct mesh *mesh, struct error *err)
{
    enum status status = check_corners(mesh, err);
    if (status)
        return status;
    size_t side_count = 3 * (size_t)mesh->triangle_count;
    uint32_t *side_edge = array_new(side_count, sizeof *side_edge);
    uint32_t *binned = array_new(side_count, sizeof *binned);
    uint32_t *by_point = calloc((size_t)mesh->point_count + 1, sizeof *by_point);
    uint32_t(*edge)[2] = NULL;
    if (side_edge && binned && by_point) {
        bin_sides(mesh, by_point, binned);
        find_first_sides(mesh, binned, by_point, side_edge);
        uint32_t edge_count = number_edges(side_edge, (uint32_t)side_count);
        free(binned);
        binned = NULL;
        edge = array_new(edge_count, sizeof *edge);
        if (edge) {
            list_edges(mesh, side_edge, edge);
            mesh_disconnect(mesh);
            mesh->edge = edge;
            mesh->edge_count = edge_count;
            mesh->triangle_edge = (uint32_t(*)[3])side_edge;
        }
    }
    free(binned);
    free(by_point);
    if (!edge) {
        free(side_edge);
        return error_no_memory(err, "the edges");
    }
    return STATUS_OK;
}

void mesh_disconnect(struct mesh *mesh)
{
    free(mesh->edge);
    free(mesh->triangle_edge);
    mesh->edge = NULL;
    mesh->triangle_edge = NULL;
    mesh->edge_count = 0;
}
