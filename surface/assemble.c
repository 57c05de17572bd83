/* From bricks to a mesh. */
#include "common/vec3.h"
#include "surface/mesher.h"

#include <stdlib.h>
#include <string.h>

/* What is known while the triangles of one brick are made. */
struct assembly {
    const struct mesher *m;
    struct worker *worker;
    struct mesh *mesh;
    const struct brick *brick;
    const struct brick *around[8]; /* the brick and its upper neighbours, x + 2 y + 4 z; NULL: not there */
    uint32_t (*triangle)[3];       /* the next one */
    size_t middle;                 /* the next one's number; they come after all other points */
};

static void find_neighbours(struct assembly *a)
{
    const struct brick *brick = a->around[0] = a->brick;
    for (int k = 1; k < 8; k++) {
        int at[3] = {brick->at[0] + (k & 1), brick->at[1] + (k >> 1 & 1), brick->at[2] + (k >> 2)};
        uint32_t found = brick_find(a->m, brick_code(&a->m->grid, at));
        a->around[k] = found != MESH_NONE ? &a->m->bricks.items[found] : NULL;
    }
}

/* The number of the vertex on an edge of the cell at x, y, z. The brick that owns it is there: it has that
 * edge's ends on different sides. */
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

static void add_triangle(struct assembly *a, uint32_t p, uint32_t q, uint32_t r)
{
    (*a->triangle)[0] = p;
    (*a->triangle)[1] = q;
    (*a->triangle)[2] = r;
    a->triangle++;
}

/* A point of the surface near the loop's middle: from there towards the corner of the cell on the other
 * side of the surface where it is met first. */
static void find_middle(const struct assembly *a, const int at[3], unsigned inside, const double middle[3],
                        struct vertex *vertex)
{
    const struct mesher *m = a->m;
    double gradient[3], outwards[3] = {1, 0, 0}, nearest = INFINITY;
    double excess = worker_value(a->worker, middle, gradient) - m->threshold;
    for (int corner = 0; corner < 8; corner++) {
        double place[3], point[3], slope[3];
        if ((inside >> corner & 1) == !signbit(excess))
            continue;
        for (int axis = 0; axis < 3; axis++)
            place[axis] = grid_coordinate(&m->grid,
                                          a->brick->at[axis] * BRICK + at[axis] + (corner >> axis & 1));
        double there = worker_value(a->worker, place, slope) - m->threshold;
        if (signbit(there) == signbit(excess))
            continue;
        if (signbit(excess))
            find_crossing(m, a->worker, place, there, middle, excess, point, slope);
        else
            find_crossing(m, a->worker, middle, excess, place, there, point, slope);
        double distance = vec3_distance(point, middle);
        if (distance >= nearest)
            continue;
        nearest = distance;
        vertex_set(m, point, slope, outwards, vertex);
    }
}

static void put_point(struct mesh *mesh, size_t number, const struct vertex *vertex)
{
    memcpy(mesh->position[number], vertex->position, sizeof vertex->position);
    memcpy(mesh->normal[number], vertex->normal, sizeof vertex->normal);
}

/* A fan from a vertex in the middle, for the few loops that need one. */
static void add_fan(struct assembly *a, const int at[3], unsigned inside, const uint32_t *number, int length)
{
    struct vertex vertex = {0};
    double middle[3] = {0, 0, 0};
    for (int i = 0; i < length; i++)
        for (int axis = 0; axis < 3; axis++)
            middle[axis] += a->mesh->position[number[i]][axis] * a->m->field->side / length;
    find_middle(a, at, inside, middle, &vertex);
    put_point(a->mesh, a->middle, &vertex);
    for (int i = 0; i < length; i++)
        add_triangle(a, (uint32_t)a->middle, number[i], number[(i + 1) % length]);
    a->middle++;
}

static void add_loop(struct assembly *a, const int at[3], unsigned inside, const uint8_t *edges, int length)
{
    uint32_t number[CELL_EDGES];
    double place[CELL_EDGES][3];
    uint8_t triangles[CELL_EDGES][3];
    for (int i = 0; i < length; i++)
        number[i] = vertex_number(a, at, edges[i]);
    if (length == 3) {
        add_triangle(a, number[0], number[1], number[2]);
        return;
    }
    for (int i = 0; i < length; i++)
        memcpy(place[i], a->mesh->position[number[i]], sizeof place[i]);
    int count = cell_triangulate(&a->m->cells, edges, length, place, triangles);
    if (count == 0)
        add_fan(a, at, inside, number, length);
    for (int i = 0; i < count; i++)
        add_triangle(a, number[triangles[i][0]], number[triangles[i][1]], number[triangles[i][2]]);
}

static void add_brick(struct assembly *a)
{
    find_neighbours(a);
    for (int row = 0; row < BRICK * BRICK; row++)
        for (unsigned cells = cells_crossed(a->brick, row % BRICK, row / BRICK); cells; cells &= cells - 1) {
            int at[3] = {__builtin_ctz(cells), row % BRICK, row / BRICK};
            unsigned inside = cell_inside(a->brick, at[0], at[1], at[2]);
            struct cell_loops own;
            const struct cell_loops *loops = cell_loops_of(a->m, a->worker, a->brick, at, inside, &own);
            for (int i = 0; i < loops->count; i++)
                add_loop(a, at, inside, loops->edge[i], loops->length[i]);
        }
}

/* Jobs are some bricks each: one is too little to be handed out by itself. */
enum { JOB = 16 };

struct assembling {
    const struct mesher *m;
    struct mesh *mesh;
};

static size_t job_end(const struct mesher *m, size_t job)
{
    size_t end = (job + 1) * JOB;
    return end < m->bricks.count ? end : m->bricks.count;
}

static void place_vertices(void *context, size_t job, unsigned worker)
{
    const struct assembling *all = context;
    (void)worker;
    for (size_t i = job * JOB; i < job_end(all->m, job); i++) {
        const struct brick *brick = &all->m->bricks.items[i];
        for (uint32_t k = 0; k < brick->vertex_count; k++)
            put_point(all->mesh, brick->vertex_first + k, &brick->vertices[k]);
    }
}

static void make_triangles(void *context, size_t job, unsigned worker)
{
    const struct assembling *all = context;
    const struct mesher *m = all->m;
    for (size_t i = job * JOB; i < job_end(m, job); i++) {
        struct assembly a = {
            .m = m, .worker = m->worker[worker], .mesh = all->mesh, .brick = &m->bricks.items[i]};
        a.triangle = all->mesh->triangle + a.brick->triangle_first;
        a.middle = m->vertex_count + a.brick->middle_first;
        add_brick(&a);
    }
}

static void count_bytes(struct mesher *m)
{
    size_t bytes = m->slot_count * sizeof *m->slots + m->stack.capacity * sizeof *m->stack.items +
                   m->bricks.capacity * sizeof *m->bricks.items;
    for (unsigned i = 0; i < threads_workers(m->pool); i++)
        bytes += m->worker[i]->bytes + sizeof *m->worker[i];
    m->bytes = bytes + (m->vertex_count + m->middle_count) * 2 * sizeof(double[3]) +
               m->triangle_count * sizeof(uint32_t[3]);
}

enum status mesher_assemble(struct mesher *m, struct mesh *mesh, struct error *err)
{
    struct assembling all = {m, mesh};
    size_t jobs = (m->bricks.count + JOB - 1) / JOB;
    count_bytes(m);
    if (mesh_init(mesh, m->vertex_count + m->middle_count, m->triangle_count, true, err))
        return err->status;
    threads_run(m->pool, jobs, place_vertices, &all);
    threads_run(m->pool, jobs, make_triangles, &all);
    if (!mesher_failed(m))
        return STATUS_OK;
    mesh_clear(mesh);
    return error_no_memory(err, "the triangles");
}
