/*
 * Fans and components are found by joining neighbours: the two triangles at an edge are joined, and so are
 * their corners at either of its ends. Each join that is news makes one group of two, so the groups left over
 * are the count of things less the count of such joins.
 */
#include "common/mesh_measure.h"

#include "common/array.h"
#include "common/disjoint_sets.h"

#include <stdlib.h>

struct edge_use {
    uint32_t first_side; /* 3 t + k of the first triangle that has the edge */
    uint8_t up, down;    /* sides that run from the smaller point to the larger, or back; at most 3 each */
};

struct groups {
    struct edge_use *edge;     /* [edge_count] */
    uint32_t *corner_parent;   /* [3 triangle_count] */
    uint32_t *triangle_parent; /* [triangle_count] */
    uint32_t *fans;            /* [point_count] */
    size_t components;
};

/* The corner of triangle t at point p, as 3 t + k. */
static uint32_t corner_at(const struct mesh *mesh, uint32_t t, uint32_t p)
{
    return 3 * t + (mesh->triangle[t][0] == p ? 0 : mesh->triangle[t][1] == p ? 1 : 2);
}

static void join_neighbours(const struct mesh *mesh, struct groups *groups, uint32_t t, uint32_t other,
                            const uint32_t points[2])
{
    groups->components -= sets_unite(groups->triangle_parent, t, other);
    for (int i = 0; i < 2; i++)
        groups->fans[points[i]] -= sets_unite(groups->corner_parent, corner_at(mesh, t, points[i]),
                                              corner_at(mesh, other, points[i]));
}

static void walk_sides(const struct mesh *mesh, struct groups *groups)
{
    for (uint32_t side = 0; side < 3 * mesh->triangle_count; side++) {
        uint32_t t = side / 3, e = mesh->triangle_edge[t][side % 3];
        struct edge_use *use = &groups->edge[e];
        bool up = mesh->triangle[t][side % 3] == mesh->edge[e][0];
        if (use->up + use->down == 0)
            use->first_side = side;
        else
            join_neighbours(mesh, groups, t, use->first_side / 3, mesh->edge[e]);
        uint8_t *uses = up ? &use->up : &use->down;
        if (*uses < 3)
            (*uses)++;
    }
}

static void note_edge(size_t *count, uint32_t first[2], const uint32_t edge[2])
{
    if ((*count)++ == 0) {
        first[0] = edge[0];
        first[1] = edge[1];
    }
}

static void count_edges(const struct mesh *mesh, const struct groups *groups, struct mesh_report *report)
{
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        const struct edge_use *use = &groups->edge[e];
        const uint32_t *edge = mesh->edge[e];
        int sides = use->up + use->down;
        if (sides == 1)
            note_edge(&report->boundary_edges, report->first_boundary, edge);
        else if (sides > 2)
            note_edge(&report->overfull_edges, report->first_overfull, edge);
        else if (use->up != use->down)
            note_edge(&report->inconsistent_edges, report->first_inconsistent, edge);
    }
}

/* Every triangle a component, every corner a fan. */
static void start_groups(const struct mesh *mesh, struct groups *groups)
{
    groups->components = mesh->triangle_count;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        groups->triangle_parent[t] = t;
        for (uint32_t k = 0; k < 3; k++) {
            groups->corner_parent[3 * t + k] = 3 * t + k;
            groups->fans[mesh->triangle[t][k]]++;
        }
    }
}

enum status mesh_measure(const struct mesh *mesh, struct mesh_report *report, struct error *err)
{
    struct groups groups = {
        .edge = calloc((size_t)mesh->edge_count + 1, sizeof *groups.edge),
        .corner_parent = array_new(3 * (size_t)mesh->triangle_count, sizeof *groups.corner_parent),
        .triangle_parent = array_new(mesh->triangle_count, sizeof *groups.triangle_parent),
        .fans = calloc((size_t)mesh->point_count + 1, sizeof *groups.fans),
    };
    bool room = groups.edge && groups.corner_parent && groups.triangle_parent && groups.fans;
    if (room) {
        for (int i = 0; i < 2; i++)
            report->first_boundary[i] = report->first_overfull[i] = report->first_inconsistent[i] = MESH_NONE;
        report->boundary_edges = report->overfull_edges = report->inconsistent_edges = 0;
        report->pinched_points = 0;
        start_groups(mesh, &groups);
        walk_sides(mesh, &groups);
        count_edges(mesh, &groups, report);
        for (uint32_t p = 0; p < mesh->point_count; p++)
            report->pinched_points += groups.fans[p] > 1;
        report->components = groups.components;
        report->volume = mesh_volume(mesh);
    }
    free(groups.edge);
    free(groups.corner_parent);
    free(groups.triangle_parent);
    free(groups.fans);
    return room ? STATUS_OK : error_no_memory(err, "the check of the mesh");
}
