/* "Once the triangles of the surface are created, they are loaded into the simulation application and are
 * uniquely sorted into data structures for points, edges, and triangles" (paper 3.5). */
#include "common/array.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/kernels.h"
#include "sim/ledger.h"
#include "sim/springs.h"
#include "sim/topology.h"
#include "sim/vectors.h"

#include <stdlib.h>
#include <string.h>

void sim_clear(struct sim *sim)
{
    if (sim->integrator && sim->integrator->close)
        sim->integrator->close(sim);
    effects_close(sim);
    parts_close(sim);
    look_close(sim);
    guard_close(sim);
    ledger_close(sim);
    void *arrays[] = {sim->normal,
                      sim->position,
                      sim->velocity,
                      sim->force,
                      sim->before,
                      sim->mass,
                      sim->edge_point,
                      sim->rest_length,
                      sim->broken_length,
                      sim->edge_active,
                      sim->triangle_edge,
                      sim->init_spring_const,
                      sim->current_spring_const,
                      sim->piece,
                      sim->piece_area,
                      sim->blocks,
                      sim->triangle_point,
                      sim->triangle_active,
                      sim->balloons,
                      sim->settings,
                      sim->news,
                      sim->scalar,
                      sim->scalar_rate,
                      sim->body,
                      sim->block_sum};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    for (int i = 0; i < SIM_VECTORS_MAX; i++) {
        free(sim->scratch[i]);
        free(sim->scalar_scratch[i]);
    }
    *sim = (struct sim){0};
}

void *sim_table(struct sim *sim, size_t count, size_t size)
{
    const size_t line = 64, bytes = (count * size + line) / line * line;
    void *items = aligned_alloc(line, bytes);
    if (items)
        memset(items, 0, bytes);
    sim->bytes += count * size;
    return items;
}

enum status sim_keep_before(struct sim *sim, struct error *err)
{
    if (!sim->before)
        sim->before = sim_table(sim, sim->point_count, sizeof *sim->before);
    return sim->before ? STATUS_OK : error_no_memory(err, "the places before a step");
}

/* *failed remembers that there was not enough. */
static void *table(struct sim *sim, size_t count, size_t size, bool *failed)
{
    void *items = sim_table(sim, count, size);
    *failed |= !items;
    return items;
}

static enum status allocate(struct sim *sim, struct error *err)
{
    const size_t points = sim->point_count, edges = sim->edge_count, triangles = sim->triangle_count;
    bool failed = false;
    sim->normal = table(sim, points, sizeof *sim->normal, &failed);
    sim->position = table(sim, points, sizeof *sim->position, &failed);
    sim->velocity = table(sim, points, sizeof *sim->velocity, &failed);
    sim->force = table(sim, points, sizeof *sim->force, &failed);
    sim->mass = table(sim, points, sizeof *sim->mass, &failed);
    sim->edge_point = table(sim, edges, sizeof *sim->edge_point, &failed);
    sim->rest_length = table(sim, edges, sizeof *sim->rest_length, &failed);
    sim->broken_length = table(sim, edges, sizeof *sim->broken_length, &failed);
    sim->init_spring_const = table(sim, edges, sizeof *sim->init_spring_const, &failed);
    sim->current_spring_const = table(sim, edges, sizeof *sim->current_spring_const, &failed);
    sim->edge_active = table(sim, edges, sizeof *sim->edge_active, &failed);
    sim->piece = table(sim, edges, sizeof *sim->piece, &failed);
    sim->piece_area = table(sim, edges, sizeof *sim->piece_area, &failed);
    sim->triangle_point = table(sim, triangles, sizeof *sim->triangle_point, &failed);
    sim->triangle_edge = table(sim, triangles, sizeof *sim->triangle_edge, &failed);
    sim->triangle_active = table(sim, triangles, sizeof *sim->triangle_active, &failed);
    sim->balloons = table(sim, sim->balloon_count, sizeof *sim->balloons, &failed);
    sim->settings = table(sim, sim->balloon_count, sizeof *sim->settings, &failed);
    sim->news = table(sim, SIM_NEWS_EACH * sim->balloon_count, sizeof *sim->news, &failed);
    for (int i = 0; i < sim->integrator->vectors; i++)
        sim->scratch[i] = table(sim, points, sizeof *sim->scratch[i], &failed);
    sim->block_sum = table(sim, points / VECTOR_BLOCK + 1, sizeof *sim->block_sum, &failed);
    sim->rows.position = sim->position;
    sim->rows.velocity = sim->velocity;
    sim->rows.force = sim->force;
    sim->rows.normal = sim->normal;
    return failed ? error_no_memory(err, "the points, edges and triangles") : STATUS_OK;
}

/* Scales and moves the mesh to the scene's radius and position: the mean of its points becomes the centre. */
static void place_points(struct sim *sim, struct sim_balloon *b, const struct mesh *mesh)
{
    double mean[3] = {0}, radius = 0;
    for (int i = 0; i < 3; i++) {
        for (uint32_t p = 0; p < mesh->point_count; p++)
            mean[i] += mesh->position[p][i];
        mean[i] /= mesh->point_count;
        b->centre[i] = b->scene->position[i];
    }
    for (uint32_t p = 0; p < mesh->point_count; p++)
        radius += vec3_distance(mesh->position[p], mean);
    radius /= mesh->point_count;
    const double scale = b->scene->radius > 0 ? b->scene->radius / radius : 1;
    b->radius = radius * scale;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        for (int i = 0; i < 3; i++)
            sim->position[b->point_begin + p][i] = b->centre[i] + (mesh->position[p][i] - mean[i]) * scale;
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        sim->mass[p] = b->scene->point_mass;
}

/* Where edges and triangles of a mesh go in the tables. */
struct places {
    uint32_t *edge, *triangle, *count;
};

static void make_springs(struct sim *sim, struct sim_balloon *b, const struct mesh *mesh,
                         const struct places *places)
{
    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        const uint32_t e = b->edge_begin + places->edge[i];
        for (int k = 0; k < 2; k++)
            sim->edge_point[e][k] = b->point_begin + mesh->edge[i][k];
        sim->edge_active[e] = 1;
        sim->rest_length[e] = sim_edge_length(sim, e);
        sim->init_spring_const[e] = b->scene->spring;
        sim->current_spring_const[e] = b->scene->spring * b->scene->spring_factor;
    }
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        b->mean_rest_length += sim->rest_length[e];
    b->mean_rest_length /= b->edge_end - b->edge_begin;
}

static void copy_triangles(struct sim *sim, const struct sim_balloon *b, const struct mesh *mesh,
                           const struct places *places)
{
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t t = b->triangle_begin + places->triangle[i];
        for (int k = 0; k < 3; k++) {
            sim->triangle_point[t][k] = b->point_begin + mesh->triangle[i][k];
            sim->triangle_edge[t][k] = b->edge_begin + places->edge[mesh->triangle_edge[i][k]];
        }
        sim->triangle_active[t] = 1;
    }
}

static enum status fill_balloon(struct sim *sim, struct sim_balloon *b, const struct mesh *mesh,
                                struct error *err)
{
    struct places places = {array_new(mesh->edge_count, sizeof(uint32_t)),
                            array_new(mesh->triangle_count, sizeof(uint32_t)),
                            array_new(mesh->point_count, sizeof(uint32_t))};
    const bool room = places.edge && places.triangle && places.count;
    if (room) {
        parts_order(mesh, places.edge, places.triangle, places.count);
        place_points(sim, b, mesh);
        make_springs(sim, b, mesh, &places);
        copy_triangles(sim, b, mesh, &places);
        if (b->scene->stiffness == SCENE_COTANGENT)
            springs_by_cotangent(sim, b);
        if (b->scene->mass_by == SCENE_BY_AREAS)
            springs_mass_by_area(sim, b);
        b->own_thresholds = b->scene->threshold_of == SCENE_OF_EDGE;
        *b->now = (struct sim_settings){.spring_factor = b->scene->spring_factor,
                                        .damping = b->scene->damping,
                                        .pressure = b->scene->pressure,
                                        .threshold_length = b->scene->threshold *
                                                            (b->own_thresholds ? 1 : b->mean_rest_length),
                                        .pump = b->scene->gas.pump,
                                        .pump_until = b->scene->gas.pump_until};
    }
    free(places.edge);
    free(places.triangle);
    free(places.count);
    return room ? STATUS_OK : error_no_memory(err, "the points, edges and triangles");
}

static enum status count(struct sim *sim, const struct mesh *meshes, struct error *err)
{
    size_t points = 0, edges = 0, triangles = 0;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const uint32_t room = topology_room(&sim->scene->balloons[i].fracture, meshes[i].point_count);
        points += meshes[i].point_count + (size_t)room;
        edges += meshes[i].edge_count + (size_t)room;
        triangles += meshes[i].triangle_count;
    }
    if (edges >= MESH_NONE)
        return error_set(err, STATUS_RANGE, "the balloons have %zu edges; at most %u fit", edges,
                         MESH_NONE - 1);
    sim->point_count = (uint32_t)points;
    sim->edge_count = (uint32_t)edges;
    sim->triangle_count = (uint32_t)triangles;
    return STATUS_OK;
}

static enum status fill(struct sim *sim, const struct mesh *meshes, struct error *err)
{
    uint32_t point = 0, edge = 0, triangle = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < sim->balloon_count && !status; i++) {
        struct sim_balloon *b = &sim->balloons[i];
        b->scene = &sim->scene->balloons[i];
        b->now = &sim->settings[i];
        b->by_area = b->scene->gas.on || b->scene->pressure_on == SCENE_ON_AREAS;
        b->point_begin = point;
        b->edge_begin = edge;
        b->triangle_begin = triangle;
        b->point_end = point += meshes[i].point_count;
        b->edge_end = edge += meshes[i].edge_count;
        const uint32_t room = topology_room(&b->scene->fracture, meshes[i].point_count);
        b->point_room = point += room;
        b->edge_room = edge += room;
        for (uint32_t p = b->point_end; p < b->point_room; p++)
            sim->mass[p] = 1; /* of what is not there yet: any that can be divided by */
        b->triangle_end = triangle += meshes[i].triangle_count;
        status = fill_balloon(sim, b, &meshes[i], err);
    }
    return status;
}

/* An array of `count` numbers more than it has; the new ones are 0. */
static bool lengthen(double **numbers, uint32_t count, uint32_t more)
{
    double *longer = realloc(*numbers, ((size_t)count + more) * sizeof *longer);
    if (!longer)
        return false;
    memset(longer + count, 0, more * sizeof *longer);
    *numbers = longer;
    return true;
}

enum status sim_add_scalars(struct sim *sim, uint32_t count, uint32_t *first, struct error *err)
{
    bool room = lengthen(&sim->scalar, sim->scalar_count, count) &&
                lengthen(&sim->scalar_rate, sim->scalar_count, count);
    for (int i = 0; i < sim->integrator->vectors && room; i++)
        room = lengthen(&sim->scalar_scratch[i], sim->scalar_count, count);
    room = room && lengthen(&sim->past.scalar, sim->scalar_count, count);
    if (!room)
        return error_no_memory(err, "the quantities that are integrated");
    *first = sim->scalar_count;
    sim->scalar_count += count;
    sim->bytes += (3 + (size_t)sim->integrator->vectors) * count * sizeof *sim->scalar;
    return STATUS_OK;
}

/* Two workers that wait for each other several times a step gain nothing on a small balloon, and lose much
 * where the machine has other things to do. */
static unsigned useful_workers(const struct sim *sim)
{
    enum { POINTS_TO_SHARE = 8192 };
    return sim->point_count < POINTS_TO_SHARE ? 1 : 0;
}

static enum status build(struct sim *sim, const struct mesh *meshes, unsigned workers, struct error *err)
{
    enum status status = count(sim, meshes, err);
    if (!status)
        status = allocate(sim, err);
    if (!status)
        status = fill(sim, meshes, err);
    if (!status)
        status = threads_open(&sim->pool, workers ? workers : useful_workers(sim), err);
    if (!status)
        status = parts_open(sim, err);
    if (!status)
        status = effects_resolve(sim, err);
    if (!status)
        status = look_open(sim, err);
    if (!status)
        status = guard_open(sim, err);
    if (!status && sim->integrator->open)
        status = sim->integrator->open(sim, err);
    if (!status)
        status = state_open(sim, err);
    return status;
}

enum status sim_open(struct sim *sim, const struct scene *scene, const struct mesh *meshes, unsigned workers,
                     struct error *err)
{
    *sim = (struct sim){.scene = scene,
                        .balloon_count = scene->balloon_count,
                        .step = scene->time.step,
                        .finer = 1,
                        .met = INFINITY};
    sim->integrator = integrator_find(scene_integrator_names[scene->time.integrator]);
    sim->acting = sim->integrator;
    sim->kernels = kernels_find();
    enum status status = build(sim, meshes, workers, err);
    if (status) {
        sim_clear(sim);
        return status;
    }
    sim_forces(sim); /* so that a look at the first state finds its normals */
    return STATUS_OK;
}
