/* The balloons' meshes, from file to something that can hold air. */
#include "common/vec3.h"
#include "sim/reorder.h"

#include <string.h>

/* Air leaks through a boundary, and an edge of three triangles has no inside: say where. */
static enum status check_surface(const char *path, const struct mesh *mesh, const struct mesh_report *report,
                                 struct error *err)
{
    const char *wrong = NULL, *right = NULL;
    const uint32_t *edge = NULL;
    size_t count = 0;
    if (report->overfull_edges) {
        wrong = "has more than two triangles";
        right = "a balloon must be one surface";
        edge = report->first_overfull;
        count = report->overfull_edges;
    } else if (report->boundary_edges) {
        wrong = "has one triangle only";
        right = "a balloon must be closed to hold air";
        edge = report->first_boundary;
        count = report->boundary_edges;
    } else if (report->inconsistent_edges) {
        wrong = "is run along in the same sense by both its triangles";
        right = "the triangles must all be wound the same way round";
        edge = report->first_inconsistent;
        count = report->inconsistent_edges;
    }
    if (!wrong)
        return STATUS_OK;
    const double *a = mesh->position[edge[0]], *b = mesh->position[edge[1]];
    char others[40] = "";
    if (count > 1)
        snprintf(others, sizeof others, ", as %zu edges do", count);
    return error_set(err, STATUS_INPUT, "%s: the edge from (%g, %g, %g) to (%g, %g, %g) %s%s; %s", path, a[0],
                     a[1], a[2], b[0], b[1], b[2], wrong, others, right);
}

static void turn_inside_out(struct mesh *mesh)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *p = mesh->triangle[t], *e = mesh->triangle_edge[t];
        const uint32_t point = p[1], edge = e[0];
        p[1] = p[2];
        p[2] = point;
        e[0] = e[2];
        e[2] = edge;
    }
}

static enum status load_mesh(const char *path, struct mesh *mesh, struct mesh_report *report,
                             struct error *err)
{
    enum status status = mesh_load(path, mesh, err);
    if (status)
        return status;
    if (mesh_repair(mesh, report, err))
        return error_prefix(err, path);
    status = check_surface(path, mesh, report, err);
    if (!status && report->volume < 0)
        turn_inside_out(mesh);
    return status ? status : mesh_order(mesh, err);
}

enum status sim_load_meshes(const struct scene *scene, struct mesh *meshes, struct mesh_report *reports,
                            struct error *err)
{
    for (size_t i = 0; i < scene->balloon_count; i++) {
        const unsigned line = scene->balloons[i].line;
        enum status status = load_mesh(scene->balloons[i].mesh, &meshes[i], &reports[i], err);
        if (status && line > 0) {
            char place[512];
            snprintf(place, sizeof place, "%.400s:%u: balloons[%zu].mesh", scene->path, line, i);
            return error_prefix(err, place);
        }
        if (status)
            return status;
    }
    return STATUS_OK;
}

enum status sim_skin(const struct sim *sim, struct mesh *mesh, struct error *err)
{
    struct mesh skin = {0};
    uint32_t active = 0;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        active += sim->triangle_active[t];
    enum status status = mesh_init(&skin, sim->point_count, active, false, err);
    if (status)
        return status;
    const struct sim_balloon *b = sim->balloons;
    for (; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t name = 0; name < b->point_room - b->point_begin; name++)
            memcpy(skin.position[b->point_begin + name], sim->position[reorder_point(b, name)],
                   sizeof *skin.position);
    uint32_t to = 0;
    for (b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
            for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
                skin.triangle[to][k] = b->point_begin + reorder_name(b, sim->triangle_point[t][k]);
            to += sim->triangle_active[t];
        }
    *mesh = skin;
    return STATUS_OK;
}
