/* From followed bricks to a mesh. */
#include "common/array.h"
#include "common/vec3.h"
#include "surface/mesher.h"

#include <stdlib.h>
#include <string.h>

/* What is known while the triangles of one brick are made. */
struct assembly {
    struct mesher *m;
    const struct brick *brick;
    const struct brick *around[8]; /* the brick and its upper neighbours, x + 2 y + 4 z; NULL: not there */
    struct {
        uint32_t (*items)[3];
        size_t count, capacity;
    } triangles;
    struct {
        struct vertex *items;
        size_t count, capacity;
    } middles; /* vertices in the middle of cells, numbered after all others */
    struct mesh *mesh;
};

/* Puts the vertices into the mesh in the order of the sorted bricks and numbers them so. */
static void place_vertices(struct mesher *m, struct mesh *mesh)
{
    size_t next = 0;
    bricks_sort(m);
    for (size_t i = 0; i < m->bricks.count; i++) {
        struct brick *brick = &m->bricks.items[i];
        const struct vertex *vertex = &m->vertices.items[brick->vertex_first];
        brick->vertex_first = next;
        for (uint32_t k = 0; k < brick->vertex_count; k++, vertex++, next++) {
            memcpy(mesh->position[next], vertex->position, sizeof vertex->position);
            memcpy(mesh->normal[next], vertex->normal, sizeof vertex->normal);
        }
    }
}

static void find_neighbours(struct assembly *a, const struct brick *brick)
{
    a->brick = a->around[0] = brick;
    for (int k = 1; k < 8; k++) {
        int at[3] = {brick->at[0] + (k & 1), brick->at[1] + (k >> 1 & 1), brick->at[2] + (k >> 2)};
        uint32_t found = brick_find(a->m, brick_code(&a->m->grid, at));
        a->around[k] = found != MESH_NONE ? &a->m->bricks.items[found] : NULL;
    }
}

/* The number of the vertex on an edge of the cell at x, y, z. The brick that owns it is there: the cells
 * around a crossed edge have all been followed. */
static uint32_t vertex_number(const struct assembly *a, const int at[3], int edge)
{
    int base = a->m->cells.ends[edge][0], axis = edge / 4;
    int place[3] = {at[0] + (base & 1), at[1] + (base >> 1 & 1), at[2] + (base >> 2)};
    int owner = (place[0] >> 3) | (place[1] >> 3) << 1 | (place[2] >> 3) << 2;
    const struct brick *brick = a->around[owner];
    int z = place[2] & 7, bit = (place[1] & 7) * BRICK + (place[0] & 7);
    uint64_t before = brick->crossed[axis][z] & (((uint64_t)1 << bit) - 1);
    return (uint32_t)(brick->vertex_first + brick->rank[z][axis] + (size_t)__builtin_popcountll(before));
}

static bool add_triangle(struct assembly *a, uint32_t p, uint32_t q, uint32_t r)
{
    if (!ARRAY_RESERVE(&a->triangles, 1))
        return false;
    memcpy(a->triangles.items[a->triangles.count++], (uint32_t[3]){p, q, r}, sizeof(uint32_t[3]));
    return true;
}

/* A point of the surface near the loop's middle: from there towards the corner of the cell on the other
 * side of the surface where it is met first. */
static void find_middle(const struct assembly *a, const int at[3], unsigned inside, const double middle[3],
                        struct vertex *vertex)
{
    struct mesher *m = a->m;
    double gradient[3], outwards[3] = {1, 0, 0}, nearest = INFINITY;
    double excess = probe_value(&m->probe, middle, gradient) - m->threshold;
    for (int corner = 0; corner < 8; corner++) {
        double place[3], point[3], slope[3];
        if ((inside >> corner & 1) == !signbit(excess))
            continue;
        for (int axis = 0; axis < 3; axis++)
            place[axis] = grid_coordinate(&m->grid,
                                          a->brick->at[axis] * BRICK + at[axis] + (corner >> axis & 1));
        double there = probe_value(&m->probe, place, slope) - m->threshold;
        if (signbit(there) == signbit(excess))
            continue;
        if (signbit(excess))
            find_crossing(m, place, there, middle, excess, point, slope);
        else
            find_crossing(m, middle, excess, place, there, point, slope);
        double distance = vec3_distance(point, middle);
        if (distance >= nearest)
            continue;
        nearest = distance;
        vertex_set(m, point, slope, outwards, vertex);
    }
}

/* A fan from a vertex in the middle, for the few loops that need one. */
static bool add_fan(struct assembly *a, const int at[3], unsigned inside, const uint32_t *number, int length)
{
    struct vertex vertex = {0};
    double middle[3] = {0, 0, 0};
    for (int i = 0; i < length; i++)
        for (int axis = 0; axis < 3; axis++)
            middle[axis] += a->mesh->position[number[i]][axis] * a->m->field->side / length;
    find_middle(a, at, inside, middle, &vertex);
    if (!ARRAY_RESERVE(&a->middles, 1))
        return false;
    uint32_t centre = (uint32_t)(a->m->vertices.count + a->middles.count);
    a->middles.items[a->middles.count++] = vertex;
    for (int i = 0; i < length; i++)
        if (!add_triangle(a, centre, number[i], number[(i + 1) % length]))
            return false;
    return true;
}

static bool add_loop(struct assembly *a, const int at[3], unsigned inside, const uint8_t *edges, int length)
{
    uint32_t number[CELL_EDGES];
    double place[CELL_EDGES][3];
    uint8_t triangles[CELL_EDGES][3];
    for (int i = 0; i < length; i++) {
        number[i] = vertex_number(a, at, edges[i]);
        memcpy(place[i], a->mesh->position[number[i]], sizeof place[i]);
    }
    int count = cell_triangulate(&a->m->cells, edges, length, place, triangles);
    if (count == 0)
        return add_fan(a, at, inside, number, length);
    for (int i = 0; i < count; i++)
        if (!add_triangle(a, number[triangles[i][0]], number[triangles[i][1]], number[triangles[i][2]]))
            return false;
    return true;
}

static bool add_brick(struct assembly *a, const struct brick *brick)
{
    find_neighbours(a, brick);
    for (int cell = 0; cell < BRICK * BRICK * BRICK; cell++) {
        int at[3] = {cell % BRICK, cell / BRICK % BRICK, cell / 64};
        unsigned inside = cell_inside(brick, at[0], at[1], at[2]);
        if (inside == 0 || inside == 255)
            continue;
        struct cell_loops loops;
        unsigned ambiguous = a->m->cells.ambiguous[inside];
        cell_find_loops(&a->m->cells, inside, ambiguous ? faces_joined(a->m, brick, at, ambiguous) : 0,
                        &loops);
        for (int i = 0; i < loops.count; i++)
            if (!add_loop(a, at, inside, loops.edge[i], loops.length[i]))
                return false;
    }
    return !a->m->probe.failed;
}

/* Moves what was assembled into the mesh. */
static bool finish(struct assembly *a)
{
    struct mesh *mesh = a->mesh;
    size_t points = a->m->vertices.count + a->middles.count;
    if (a->middles.count) {
        double(*position)[3] = realloc(mesh->position, points * sizeof *position);
        mesh->position = position ? position : mesh->position;
        double(*normal)[3] = realloc(mesh->normal, points * sizeof *normal);
        mesh->normal = normal ? normal : mesh->normal;
        if (!position || !normal)
            return false;
    }
    for (size_t i = 0; i < a->middles.count; i++) {
        memcpy(mesh->position[a->m->vertices.count + i], a->middles.items[i].position, sizeof(double[3]));
        memcpy(mesh->normal[a->m->vertices.count + i], a->middles.items[i].normal, sizeof(double[3]));
    }
    mesh->point_count = (uint32_t)points;
    uint32_t(*exact)[3] = realloc(a->triangles.items, a->triangles.count * sizeof *exact);
    free(mesh->triangle);
    mesh->triangle = exact ? exact : a->triangles.items;
    mesh->triangle_count = (uint32_t)a->triangles.count;
    a->triangles.items = NULL;
    return true;
}

enum status mesher_assemble(struct mesher *m, struct mesh *mesh, struct error *err)
{
    struct assembly a = {.m = m, .mesh = mesh};
    if (mesh_init(mesh, m->vertices.count, 0, true, err))
        return err->status;
    place_vertices(m, mesh);
    free(m->vertices.items);
    m->vertices.items = NULL;
    m->vertices.capacity = 0;
    /* A closed surface has twice as many triangles as points, less 2 for each sphere. */
    bool done = ARRAY_RESERVE(&a.triangles, 2 * m->vertices.count + 64);
    for (size_t i = 0; i < m->bricks.count && done; i++)
        done = add_brick(&a, &m->bricks.items[i]);
    done = done && finish(&a);
    free(a.triangles.items);
    free(a.middles.items);
    if (done)
        return STATUS_OK;
    mesh_clear(mesh);
    return error_no_memory(err, "the triangles");
}
