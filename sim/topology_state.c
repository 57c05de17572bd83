/* What of a torn skin is state; and whether blocks that came from a file are a skin: every walk that
 * topology.c takes ends, and stays within the tables. */
#include "sim/membrane.h"
#include "sim/reorder.h"

#include <string.h>

size_t topology_blocks(struct sim *sim, struct sim_balloon *b, struct sim_block *blocks)
{
    struct topology *top = b->topology;
    const size_t triangles = b->triangle_end - b->triangle_begin, points = b->point_room - b->point_begin,
                 edges = b->edge_room - b->edge_begin, new_edges = b->edge_room - top->old_edges;
    const struct sim_block own[] = {
        {"cuts", &top->now, sizeof top->now},
        {"edge points", sim->edge_point + b->edge_begin, edges * sizeof *sim->edge_point},
        {"triangle points", sim->triangle_point + b->triangle_begin, triangles * sizeof *sim->triangle_point},
        {"triangle edges", sim->triangle_edge + b->triangle_begin, triangles * sizeof *sim->triangle_edge},
        {"masses", sim->mass + b->point_begin, points * sizeof *sim->mass},
        {"rest lengths", sim->rest_length + top->old_edges, new_edges * sizeof *sim->rest_length},
        {"springs", sim->init_spring_const + b->edge_begin, edges * sizeof *sim->init_spring_const},
        {"neighbours", top->neighbour, triangles * sizeof *top->neighbour},
        {"rest", top->rest, points * sizeof *top->rest},
        {"names", top->name, points * sizeof *top->name},
        {"families", top->family, points * sizeof *top->family},
        {"triangle at", top->triangle_at, points * sizeof *top->triangle_at},
        {"rims", top->rim, top->rim_room * sizeof *top->rim},
        {"late edges", top->tail->edge_in, top->tail->edge_in_room * sizeof(uint32_t)},
        {"late triangles", top->tail->triangle_in, top->tail->triangle_in_room * sizeof(uint32_t)},
    };
    size_t count = sizeof own / sizeof own[0];
    memcpy(blocks, own, sizeof own);
    if (b->membrane)
        blocks[count++] = (struct sim_block){"weights", b->membrane->edge_weight,
                                             edges * sizeof *b->membrane->edge_weight};
    return count;
}

static bool within(uint32_t number, uint32_t begin, uint32_t end)
{
    return number >= begin && number < end;
}

static bool has_corner(const struct sim *sim, uint32_t triangle, uint32_t point)
{
    const uint32_t *p = sim->triangle_point[triangle];
    return p[0] == point || p[1] == point || p[2] == point;
}

static bool counts_fit(const struct sim_balloon *b)
{
    const struct topology *top = b->topology;
    const struct topology_counts *now = &top->now;
    return now->points <= b->point_room - top->old_points && now->edges <= b->edge_room - top->old_edges &&
           now->late_edges <= top->tail->edge_in_room && now->late_triangles <= top->tail->triangle_in_room &&
           now->rims == 2 * now->edges && now->rims <= top->rim_room;
}

static bool numbers_fit(const struct sim *sim, const struct sim_balloon *b, uint32_t points, uint32_t edges)
{
    bool fit = true;
    for (uint32_t e = b->edge_begin; e < edges; e++)
        for (int k = 0; k < 2; k++)
            fit &= within(sim->edge_point[e][k], b->point_begin, points);
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t];
        for (int k = 0; k < 3; k++)
            fit &= within(p[k], b->point_begin, points) &&
                   within(sim->triangle_edge[t][k], b->edge_begin, edges);
        fit &= p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
    }
    for (uint32_t p = b->point_begin; p < points; p++) {
        const uint32_t t = b->topology->triangle_at[p - b->point_begin];
        fit &= within(t, b->triangle_begin, b->triangle_end) && sim->mass[p] > 0;
    }
    return fit;
}

/* Each side's neighbour has the same edge, runs along it in the other sense and leads back, so that a turn
 * around a point comes to its start again. */
static bool is_mutual(const struct sim *sim, const struct sim_balloon *b, uint32_t t, int k)
{
    const uint32_t n = b->topology->neighbour[t - b->triangle_begin][k], *p = sim->triangle_point[t];
    if (n == MESH_NONE)
        return true;
    if (!within(n, b->triangle_begin, b->triangle_end))
        return false;
    const uint32_t *q = sim->triangle_point[n];
    int same = 0, back = 0;
    for (int j = 0; j < 3; j++) {
        same += sim->triangle_edge[n][j] == sim->triangle_edge[t][k];
        back += sim->triangle_edge[n][j] == sim->triangle_edge[t][k] &&
                b->topology->neighbour[n - b->triangle_begin][j] == t && q[j] == p[(k + 1) % 3] &&
                q[(j + 1) % 3] == p[k];
    }
    return same == 1 && back == 1;
}

static bool lists_fit(const struct sim_balloon *b)
{
    const struct topology *top = b->topology;
    bool fit = true;
    for (uint32_t i = 0; i < top->now.late_edges; i++)
        fit &= within(top->tail->edge_in[i], b->edge_begin, top->old_edges);
    for (uint32_t i = 0; i < top->now.late_triangles; i++)
        fit &= within(top->tail->triangle_in[i], b->triangle_begin, b->triangle_end);
    for (uint32_t i = 0; i < top->now.rims; i++)
        fit &= within(top->rim[i][0], b->triangle_begin, b->triangle_end) && top->rim[i][1] < 3 &&
               top->neighbour[top->rim[i][0] - b->triangle_begin][top->rim[i][1]] == MESH_NONE;
    return fit;
}

bool topology_is_sound(const struct sim *sim, const struct sim_balloon *b)
{
    const struct topology *top = b->topology;
    if (!counts_fit(b) || !reorder_is_sound(b))
        return false;
    const uint32_t points = top->old_points + top->now.points, edges = top->old_edges + top->now.edges;
    bool sound = numbers_fit(sim, b, points, edges);
    for (uint32_t t = b->triangle_begin; sound && t < b->triangle_end; t++)
        for (int k = 0; k < 3; k++)
            sound &= is_mutual(sim, b, t, k);
    for (uint32_t p = b->point_begin; sound && p < points; p++)
        sound = has_corner(sim, top->triangle_at[p - b->point_begin], p);
    return sound && lists_fit(b);
}

void topology_restored(struct sim *sim, struct sim_balloon *b)
{
    struct topology *top = b->topology;
    b->point_end = top->old_points + top->now.points;
    b->edge_end = top->old_edges + top->now.edges;
    reorder_restored(sim, b);
    top->tail->edge_in_count = top->now.late_edges;
    top->tail->triangle_in_count = top->now.late_triangles;
    for (uint32_t i = 0; i < top->now.late_edges; i++) {
        top->late_edge[top->tail->edge_in[i] - b->edge_begin] = 1;
        parts_loosen_edge(sim, b, top->tail->edge_in[i]);
    }
    for (uint32_t i = 0; i < top->now.late_triangles; i++)
        topology_slow(sim, b, top->tail->triangle_in[i]);
}
