#include "sim/skin_mesh.h"
#include "common/array.h"
#include "sim/material.h"
#include "sim/measure.h"
#include "sim/reorder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool allocate(struct skin_mesh *skin, size_t points)
{
    const struct sim *sim = skin->sim;
    skin->stretch = array_new(points, sizeof *skin->stretch);
    skin->opacity = array_new(points, sizeof *skin->opacity);
    skin->piece = array_new(points, sizeof *skin->piece);
    skin->number = array_new(sim->point_count, sizeof *skin->number);
    skin->first = array_new(sim->edge_count, sizeof *skin->first);
    skin->clearness = array_new(sim->triangle_count, sizeof *skin->clearness);
    skin->shine = array_new(sim->triangle_count, sizeof *skin->shine);
    skin->around = array_new(sim->point_count, sizeof *skin->around);
    skin->piece_of = array_new(sim->point_count, sizeof *skin->piece_of);
    return skin->stretch && skin->opacity && skin->piece && skin->number && skin->first && skin->clearness &&
           skin->shine && skin->around && skin->piece_of;
}

enum status skin_mesh_init(struct skin_mesh *skin, struct sim *sim, bool apart, struct error *err)
{
    const size_t points = apart ? 3 * (size_t)sim->triangle_count : sim->point_count;
    *skin = (struct skin_mesh){.sim = sim, .apart = apart};
    if (sim->triangle_count > INT32_MAX)
        return error_set(err, STATUS_RANGE, "%u triangles; pieces are numbered up to %d", sim->triangle_count,
                         INT32_MAX);
    enum status status = mesh_init(&skin->mesh, points, sim->triangle_count, false, err);
    if (!status && !allocate(skin, points))
        status = error_no_memory(err, "the skin's mesh");
    if (status) {
        skin_mesh_clear(skin);
        return status;
    }
    const struct mesh_value values[SKIN_VALUES] = {{.name = "stretch", .number = skin->stretch},
                                                   {.name = "opacity", .number = skin->opacity},
                                                   {.name = "piece", .whole = skin->piece}};
    memcpy(skin->values, values, sizeof values);
    return STATUS_OK;
}

void skin_mesh_clear(struct skin_mesh *skin)
{
    void *arrays[] = {skin->stretch,   skin->opacity, skin->piece,  skin->number,  skin->first,
                      skin->clearness, skin->shine,   skin->around, skin->piece_of};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    mesh_clear(&skin->mesh);
    *skin = (struct skin_mesh){0};
}

/* What is around each point. */
static void look_around(struct skin_mesh *skin)
{
    struct sim *sim = skin->sim;
    sim_material(sim, skin->clearness, skin->shine);
    sim_find_pieces(sim);
    memset(skin->first, 0xff, sim->edge_count * sizeof *skin->first);
    memset(skin->around, 0, sim->point_count * sizeof *skin->around);
    memset(skin->number, 0xff, sim->point_count * sizeof *skin->number);
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        int32_t *first = &skin->first[sim_piece_of(sim, t)];
        const double area = sim_area(sim, t), rest = sim_rest_area(sim, t);
        if (*first < 0)
            *first = (int32_t)t;
        for (int k = 0; k < 3; k++) {
            const uint32_t p = sim->triangle_point[t][k];
            skin->around[p][0] += area;
            skin->around[p][1] += rest;
            skin->around[p][2] += rest * (double)skin->clearness[t];
            skin->piece_of[p] = *first;
            skin->number[p] = 0;
        }
    }
}

/* Point p of the sim as point `to` of the mesh. */
static void take_point(struct skin_mesh *skin, uint32_t p, uint32_t to)
{
    const double *around = skin->around[p];
    memcpy(skin->mesh.position[to], skin->sim->position[p], sizeof *skin->mesh.position);
    skin->stretch[to] = around[1] > 0 ? (float)fmin(around[0] / around[1], 1e30) : 1;
    skin->opacity[to] = around[1] > 0 ? (float)(around[2] / around[1]) : 1;
    skin->piece[to] = skin->piece_of[p];
}

static void take_joined(struct skin_mesh *skin)
{
    const struct sim *sim = skin->sim;
    struct mesh *mesh = &skin->mesh;
    mesh->point_count = mesh->triangle_count = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t name = 0; name < b->point_end - b->point_begin; name++) {
            const uint32_t p = reorder_point(b, name);
            if (skin->number[p] != MESH_NONE)
                take_point(skin, p, skin->number[p] = mesh->point_count++);
        }
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            mesh->triangle[mesh->triangle_count][k] = skin->number[sim->triangle_point[t][k]];
        mesh->triangle_count += sim->triangle_active[t];
    }
}

/* A triangle that is gone: a point, so that nothing is seen of it. */
static void draw_together(struct skin_mesh *skin, uint32_t t)
{
    const uint32_t *p = skin->sim->triangle_point[t];
    double(*at)[4] = skin->sim->position;
    for (uint32_t to = 3 * t; to < 3 * t + 3; to++) {
        for (int i = 0; i < 3; i++)
            skin->mesh.position[to][i] = (at[p[0]][i] + at[p[1]][i] + at[p[2]][i]) / 3;
        skin->stretch[to] = skin->opacity[to] = 0;
        skin->piece[to] = -1;
    }
}

static void take_apart(struct skin_mesh *skin)
{
    const struct sim *sim = skin->sim;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            skin->mesh.triangle[t][k] = 3 * t + k;
            if (sim->triangle_active[t])
                take_point(skin, sim->triangle_point[t][k], 3 * t + k);
        }
        if (!sim->triangle_active[t])
            draw_together(skin, t);
    }
}

void skin_mesh_take(struct skin_mesh *skin)
{
    look_around(skin);
    if (skin->apart)
        take_apart(skin);
    else
        take_joined(skin);
}
