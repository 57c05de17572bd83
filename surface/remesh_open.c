/* From a mesh to one that can be changed, and back. */
#include "common/array.h"
#include "surface/remesh.h"

#include <stdlib.h>
#include <string.h>

/*
 * Each side waits in a list of its edge's smaller point until the edge's other side comes. Until
 * then `across` holds the next of the list, so the lists need no room of their own. On a closed
 * mesh all lists end empty.
 */
static bool match_sides(struct remesh *r, uint32_t *first)
{
    memset(first, 0xff, r->point_count * sizeof *first);
    uint32_t waiting = 0;
    for (uint32_t side = 0; side < 3 * r->triangle_count; side++) {
        uint32_t from = side_point(r, side), to = side_point(r, side_next(side));
        uint32_t *link = &first[from < to ? from : to];
        while (*link != MESH_NONE && (side_point(r, *link) != to || side_point(r, side_next(*link)) != from))
            link = &r->across[*link / 3][*link % 3];
        uint32_t found = *link;
        if (found == MESH_NONE) {
            uint32_t *start = &first[from < to ? from : to];
            r->across[side / 3][side % 3] = *start;
            *start = side;
            waiting++;
            continue;
        }
        *link = side_across(r, found);
        r->across[found / 3][found % 3] = side;
        r->across[side / 3][side % 3] = found;
        waiting--;
    }
    return waiting == 0;
}

static void note_corner(struct remesh *r, uint32_t corner)
{
    uint32_t point = side_point(r, corner);
    r->corner[point] = corner;
    if (r->degree[point] < DEGREE_MAX)
        r->degree[point]++;
}

enum status remesh_open(struct remesh *r, struct mesh *mesh, struct error *err)
{
    *r = (struct remesh){.point_count = mesh->point_count,
                         .triangle_count = mesh->triangle_count,
                         .point_room = mesh->point_count,
                         .triangle_room = mesh->triangle_count,
                         .points_alive = mesh->point_count,
                         .triangles_alive = mesh->triangle_count,
                         .first_new = mesh->point_count,
                         .triangle = mesh->triangle,
                         .degree = calloc(mesh->point_count, sizeof(uint8_t)),
                         .corner = array_new(mesh->point_count, sizeof(uint32_t)),
                         .across = array_new(mesh->triangle_count, sizeof(uint32_t[3]))};
    bool room = r->corner && r->across && r->degree;
    if (!room || mesh->triangle_count > MESH_NONE / 3 || !match_sides(r, r->corner)) {
        free(r->corner);
        free(r->degree);
        free(r->across);
        *r = (struct remesh){0};
        return room ? error_set(err, STATUS_INPUT, "the mesh is not closed, or too large")
                    : error_no_memory(err, "relaxing the mesh");
    }
    r->position = mesh->position;
    r->normal = mesh->normal;
    for (uint32_t corner = 0; corner < 3 * r->triangle_count; corner++)
        note_corner(r, corner);
    free(mesh->edge);
    free(mesh->triangle_edge);
    *mesh = (struct mesh){0};
    return STATUS_OK;
}

/* Numbers the points that are left: number[p], MESH_NONE for the others, by counting how many come before
 * each old point's place. */
static bool number_points(const struct remesh *r, uint32_t *number)
{
    uint32_t *place = calloc((size_t)r->first_new + 1, sizeof *place);
    if (!place)
        return false;
    for (uint32_t p = 0; p < r->point_count; p++)
        if (r->corner[p] != MESH_NONE)
            place[(p < r->first_new ? p : r->beside[p - r->first_new]) + 1]++;
    for (uint32_t p = 0; p < r->first_new; p++)
        place[p + 1] += place[p];
    for (uint32_t p = 0; p < r->point_count; p++)
        number[p] = r->corner[p] == MESH_NONE ? MESH_NONE
                                              : place[p < r->first_new ? p : r->beside[p - r->first_new]]++;
    free(place);
    return true;
}

static void put_points(const struct remesh *r, const uint32_t *number, struct mesh *mesh)
{
    for (uint32_t p = 0; p < r->point_count; p++) {
        if (number[p] == MESH_NONE)
            continue;
        memcpy(mesh->position[number[p]], r->position[p], sizeof *mesh->position);
        memcpy(mesh->normal[number[p]], r->normal[p], sizeof *mesh->normal);
    }
}

static uint32_t lowest(const uint32_t t[3])
{
    uint32_t least = t[0] < t[1] ? t[0] : t[1];
    return least < t[2] ? least : t[2];
}

/* Triangles in the order of their lowest point, which they begin with; `first` is
 * room for point_count + 1. */
static void put_triangles(const struct remesh *r, const uint32_t *number, uint32_t *first, struct mesh *mesh)
{
    memset(first, 0, ((size_t)mesh->point_count + 1) * sizeof *first);
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t t = 0; t < r->triangle_count; t++) {
            if (r->triangle[t][0] == MESH_NONE)
                continue;
            uint32_t points[3];
            for (int k = 0; k < 3; k++)
                points[k] = number[r->triangle[t][k]];
            uint32_t least = lowest(points);
            if (pass == 0) {
                first[least + 1]++;
                continue;
            }
            int start = points[0] == least ? 0 : points[1] == least ? 1 : 2;
            uint32_t *target = mesh->triangle[first[least]++];
            for (int k = 0; k < 3; k++)
                target[k] = points[(start + k) % 3];
        }
        for (uint32_t p = 0; pass == 0 && p < mesh->point_count; p++)
            first[p + 1] += first[p];
    }
}

enum status remesh_close(struct remesh *r, struct mesh *mesh, struct error *err)
{
    uint32_t *number = array_new(r->point_count, sizeof *number);
    uint32_t *first = array_new((size_t)r->points_alive + 1, sizeof *first);
    enum status status = STATUS_OK;
    if (!number || !first || !number_points(r, number))
        status = error_no_memory(err, "relaxing the mesh");
    else
        status = mesh_init(mesh, r->points_alive, r->triangles_alive, true, err);
    if (status == STATUS_OK) {
        put_points(r, number, mesh);
        put_triangles(r, number, first, mesh);
    }
    free(number);
    free(first);
    return status;
}

void remesh_clear(struct remesh *r)
{
    free(r->position);
    free(r->normal);
    free(r->degree);
    free(r->corner);
    free(r->beside);
    free(r->triangle);
    free(r->across);
    *r = (struct remesh){0};
}
