#include "common/array.h"
#include "common/mesh.h"
#include "common/mesh_measure.h"
#include "common/triple_set.h"
#include "common/vec3.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum status check_values(const struct mesh *mesh, struct error *err)
{
    if (mesh->triangle_count == 0)
        return error_set(err, STATUS_INPUT, "the mesh has no triangles");
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        for (int i = 0; i < 3; i++) {
            const double at = mesh->position[p][i];
            if (!(fabs(at) <= MESH_COORDINATE_MAX))
                return error_set(err, STATUS_INPUT, "%c of point %u is %g; must be a number of at most %g",
                                 "xyz"[i], p, at, MESH_COORDINATE_MAX);
        }
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++) {
            if (mesh->triangle[t][k] >= mesh->point_count)
                return error_set(err, STATUS_INPUT,
                                 "corner %d of triangle %u is point %u; there are %u points", k, t,
                                 mesh->triangle[t][k], mesh->point_count);
        }
    }
    return STATUS_OK;
}

/* Point p becomes point new_number[p], or goes where that is MESH_NONE. New numbers grow with the old ones,
 * but for the copies of an earlier point, which lose their place and normal to it. */
static void renumber(struct mesh *mesh, const uint32_t *new_number)
{
    uint32_t kept = 0;
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        if (new_number[p] != kept)
            continue;
        memmove(mesh->position[kept], mesh->position[p], sizeof *mesh->position);
        if (mesh->normal)
            memmove(mesh->normal[kept], mesh->normal[p], sizeof *mesh->normal);
        kept++;
    }
    mesh->point_count = kept;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++)
            mesh->triangle[t][k] = new_number[mesh->triangle[t][k]];
    }
}

static enum status weld(struct mesh *mesh, uint32_t *number, struct mesh_report *report, struct error *err)
{
    struct triple_set places = {0};
    uint32_t before = mesh->point_count;
    for (uint32_t p = 0; p < before; p++) {
        number[p] = triple_set_add(&places, mesh->position[p]);
        if (number[p] == TRIPLE_NONE) {
            triple_set_clear(&places);
            return error_no_memory(err, "welding the points");
        }
    }
    triple_set_clear(&places);
    renumber(mesh, number);
    report->welded_points = before - mesh->point_count;
    return STATUS_OK;
}

static bool is_flat(const struct mesh *mesh, const uint32_t corner[3])
{
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
        return true;
    double across[3];
    vec3_triangle(mesh->position[corner[0]], mesh->position[corner[1]], mesh->position[corner[2]], across);
    return across[0] == 0 && across[1] == 0 && across[2] == 0;
}

static void drop_flat(struct mesh *mesh, struct mesh_report *report)
{
    uint32_t kept = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!is_flat(mesh, mesh->triangle[t]))
            memmove(mesh->triangle[kept++], mesh->triangle[t], sizeof *mesh->triangle);
    }
    report->flat_triangles = mesh->triangle_count - kept;
    mesh->triangle_count = kept;
}

/* The corners from the smallest to the largest, as a triple. */
static void sorted_corners(const uint32_t corner[3], double sorted[3])
{
    for (int i = 0; i < 3; i++) {
        int place = 0;
        for (int k = 0; k < 3; k++)
            place += corner[k] < corner[i];
        sorted[place] = corner[i];
    }
}

static enum status drop_repeated(struct mesh *mesh, struct mesh_report *report, struct error *err)
{
    struct triple_set seen = {0};
    enum status status = STATUS_OK;
    uint32_t kept = 0;
    for (uint32_t t = 0; t < mesh->triangle_count && !status; t++) {
        double sorted[3];
        sorted_corners(mesh->triangle[t], sorted);
        uint32_t number = triple_set_add(&seen, sorted);
        if (number == TRIPLE_NONE)
            status = error_no_memory(err, "the search for repeated triangles");
        else if (number == kept)
            memmove(mesh->triangle[kept++], mesh->triangle[t], sizeof *mesh->triangle);
    }
    triple_set_clear(&seen);
    if (!status) {
        report->repeated_triangles = mesh->triangle_count - kept;
        mesh->triangle_count = kept;
    }
    return status;
}

static void drop_unused(struct mesh *mesh, uint32_t *number, struct mesh_report *report)
{
    uint32_t before = mesh->point_count, kept = 0;
    memset(number, 0xff, before * sizeof *number);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++)
            number[mesh->triangle[t][k]] = 0;
    }
    for (uint32_t p = 0; p < before; p++) {
        if (number[p] != MESH_NONE)
            number[p] = kept++;
    }
    renumber(mesh, number);
    report->unused_points = before - kept;
}

static enum status drop_all(struct mesh *mesh, struct mesh_report *report, struct error *err)
{
    uint32_t *number = array_new(mesh->point_count, sizeof *number);
    if (!number)
        return error_no_memory(err, "the repair of the mesh");
    enum status status = weld(mesh, number, report, err);
    if (!status) {
        drop_flat(mesh, report);
        status = drop_repeated(mesh, report, err);
    }
    if (!status)
        drop_unused(mesh, number, report);
    free(number);
    return status;
}

enum status mesh_repair(struct mesh *mesh, struct mesh_report *report, struct error *err)
{
    *report = (struct mesh_report){0};
    enum status status = check_values(mesh, err);
    if (status)
        return status;
    mesh_disconnect(mesh); /* edges of the mesh as it was */
    status = drop_all(mesh, report, err);
    if (!status && mesh->triangle_count == 0)
        status = error_set(err, STATUS_INPUT, "every triangle of the mesh is flat: it has no area");
    if (!status)
        status = mesh_connect(mesh, err);
    return status ? status : mesh_measure(mesh, report, err);
}

const char *mesh_report_repairs(const struct mesh_report *report, char *text, size_t size)
{
    const struct {
        size_t count;
        const char *one, *many, *done;
    } repairs[] = {
        {report->welded_points, "repeated point", "repeated points", "welded"},
        {report->flat_triangles, "flat triangle", "flat triangles", "dropped"},
        {report->repeated_triangles, "repeated triangle", "repeated triangles", "dropped"},
        {report->unused_points, "unused point", "unused points", "dropped"},
    };
    size_t length = 0;
    if (size > 0)
        text[0] = '\0';
    for (size_t i = 0; i < sizeof repairs / sizeof *repairs; i++) {
        if (repairs[i].count > 0 && length < size)
            length += (size_t)snprintf(
                text + length, size - length, "%s%zu %s %s", length > 0 ? ", " : "", repairs[i].count,
                repairs[i].count == 1 ? repairs[i].one : repairs[i].many, repairs[i].done);
    }
    return text;
}
