/* "Once the triangles of the surface are created, they are loaded into the simulation application and are uniquely
 * sorted into data structures for points, edges, and triangles" (paper 3.5). */
#include "common/array.h"
#include "common/vec3.h"
#include "sim/sim.h"

#include <stdlib.h>
#include <string.h>

void sim_clear(struct sim *sim)
{
    void *arrays[] = {
        sim->normal,         sim->position,      sim->velocity,          sim->force,
        sim->mass,           sim->edge_point,    sim->rest_length,       sim->length,
        sim->edge_active,    sim->triangle_edge, sim->init_spring_const, sim->current_spring_const,
        sim->triangle_point, sim->piece,         sim->triangle_active,   sim->balloons,
        sim->piece_area};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        free(arrays[i]);
    for (int phase = 0; phase < EFFECT_PHASES; phase++)
        free(sim->hooks[phase]);
    *sim = (struct sim){0};
}

/* calloc that adds to sim->bytes, and remembers in *failed that there was not enough. */
static void *table(struct sim *sim, size_t count, size_t size, bool *failed)
{
    void *items = calloc(count ? count : 1, size);
    sim->bytes += count * size;
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
    sim->length = table(sim, edges, sizeof *sim->length, &failed);
    sim->init_spring_const = table(sim, edges, sizeof *sim->init_spring_const, &failed);
    sim->current_spring_const = table(sim, edges, sizeof *sim->current_spring_const, &failed);
    sim->edge_active = table(sim, edges, sizeof *sim->edge_active, &failed);
    sim->piece = table(sim, edges, sizeof *sim->piece, &failed);
    sim->piece_area = table(sim, edges, sizeof *sim->piece_area, &failed);
    sim->triangle_point = table(sim, triangles, sizeof *sim->triangle_point, &failed);
    sim->triangle_edge = table(sim, triangles, sizeof *sim->triangle_edge, &failed);
    sim->triangle_active = table(sim, triangles, sizeof *sim->triangle_active, &failed);
    sim->balloons = table(sim, sim->balloon_count, sizeof *sim->balloons, &failed);
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

static void make_springs(struct sim *sim, struct sim_balloon *b, const struct mesh *mesh)
{
    for (uint32_t i = 0, e = b->edge_begin; e < b->edge_end; i++, e++) {
        for (int k = 0; k < 2; k++)
            sim->edge_point[e][k] = b->point_begin + mesh->edge[i][k];
        sim->length[e] = vec3_distance(sim->position[sim->edge_point[e][0]],
                                       sim->position[sim->edge_point[e][1]]);
        sim->rest_length[e] = sim->length[e];
        sim->init_spring_const[e] = b->scene->spring;
        sim->current_spring_const[e] = b->scene->spring * b->scene->spring_factor;
        sim->edge_active[e] = 1;
        b->mean_rest_length += sim->length[e];
    }
    b->mean_rest_length /= b->edge_end - b->edge_begin;
}

static void copy_triangles(struct sim *sim, const struct sim_balloon *b, const struct mesh *mesh)
{
    for (uint32_t i = 0, t = b->triangle_begin; t < b->triangle_end; i++, t++) {
        for (int k = 0; k < 3; k++) {
            sim->triangle_point[t][k] = b->point_begin + mesh->triangle[i][k];
            sim->triangle_edge[t][k] = b->edge_begin + mesh->triangle_edge[i][k];
        }
        sim->triangle_active[t] = 1;
    }
}

static void fill_balloon(struct sim *sim, struct sim_balloon *b, const struct mesh *mesh)
{
    place_points(sim, b, mesh);
    make_springs(sim, b, mesh);
    copy_triangles(sim, b, mesh);
    b->spring_factor = b->scene->spring_factor;
    b->damping = b->scene->damping;
    b->pressure = b->scene->pressure;
    b->threshold_length = b->scene->threshold * b->mean_rest_length;
}

static enum status count(struct sim *sim, const struct mesh *meshes, struct error *err)
{
    size_t points = 0, edges = 0, triangles = 0;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        points += meshes[i].point_count;
        edges += meshes[i].edge_count;
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

static void fill(struct sim *sim, const struct mesh *meshes)
{
    uint32_t point = 0, edge = 0, triangle = 0;
    for (size_t i = 0; i < sim->balloon_count; i++) {
        struct sim_balloon *b = &sim->balloons[i];
        b->scene = &sim->scene->balloons[i];
        b->point_begin = point;
        b->edge_begin = edge;
        b->triangle_begin = triangle;
        b->point_end = point += meshes[i].point_count;
        b->edge_end = edge += meshes[i].edge_count;
        b->triangle_end = triangle += meshes[i].triangle_count;
        fill_balloon(sim, b, &meshes[i]);
    }
}

enum status sim_open(struct sim *sim, const struct scene *scene, const struct mesh *meshes, struct error *err)
{
    *sim = (struct sim){.scene = scene, .balloon_count = scene->balloon_count, .step = scene->time.step};
    sim->integrator = integrator_find(scene_integrator_names[scene->time.integrator]);
    enum status status = count(sim, meshes, err);
    if (!status)
        status = allocate(sim, err);
    if (!status) {
        fill(sim, meshes);
        status = effects_resolve(sim, err);
    }
    if (status) {
        sim_clear(sim);
        return status;
    }
    effects_run(sim, EFFECT_OPEN);
    sim_forces(sim); /* so that a look at the first state finds its normals */
    return STATUS_OK;
}
