#include "sculpt/voxelise.h"

#include "common/array.h"
#include "sculpt/voxelise_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh is too open when its undecided cells are more than this part of those inside; see struct
 * voxelise_report. A ball with a tenth of its triangles missing has 0.006, with a fifth 0.03; half a ball
 * without its cut has 0.5. */
#define UNDECIDED_MAX 0.2

/* Cells as bits in Morton order, so that any node of the octree is a run of them. */
struct grid {
    unsigned depth;
    int side;
    uint64_t *bits;
    uint32_t *spread; /* [side] the bits of a coordinate, each with two places after it */
};

/* Lines along x and y of one slab of cells with the same z, and the state of the
 * lines along z that pass it. */
struct slab {
    const struct crossings *along; /* [3] */
    int side;
    signed char *votes; /* [side * side] by y and x: how many of the six rays say "inside" */
    int *windings;      /* [side * side + side] scratch: of lines along z, then of one line */
    int *totals;        /* [side * side] what all crossings of each line along z sum up to */
    uint32_t *next;     /* [side * side] the first crossing of each line along z that lies ahead */
    bool parity;        /* crossings count without their sense */
    bool closed;        /* the mesh has no open edges */
};

struct job {
    const struct mesh *mesh; /* in cells */
    struct crossings along[3];
    struct grid grid;
    struct winding *winding; /* made when it is first needed */
    struct voxelise_report *report;
};

static uint64_t cell_index(const struct grid *grid, int x, int y, int z)
{
    return (uint64_t)grid->spread[x] | (uint64_t)grid->spread[y] << 1 | (uint64_t)grid->spread[z] << 2;
}

static void set_cell(struct grid *grid, int x, int y, int z)
{
    uint64_t index = cell_index(grid, x, y, z);
    grid->bits[index / 64] |= UINT64_C(1) << index % 64;
}

static uint64_t grid_words(unsigned depth)
{
    return depth < 2 ? 1 : UINT64_C(1) << (3 * depth - 6);
}

static bool grid_init(struct grid *grid, unsigned depth)
{
    grid->depth = depth;
    grid->side = 1 << depth;
    grid->bits = calloc(grid_words(depth), sizeof *grid->bits);
    grid->spread = calloc((size_t)grid->side, sizeof *grid->spread);
    if (!grid->bits || !grid->spread)
        return false;
    for (int i = 0; i < grid->side; i++)
        for (unsigned bit = 0; bit < depth; bit++)
            grid->spread[i] |= (uint32_t)(i >> bit & 1) << 3 * bit;
    return true;
}

static void grid_clear(struct grid *grid)
{
    free(grid->bits);
    free(grid->spread);
}

/* How a cube of 2^level cells a side at a run of bits is filled: 1 wholly, 0 not at all, -1 in part. */
static int run_fill(const struct grid *grid, uint64_t index, unsigned level)
{
    uint64_t count = UINT64_C(1) << 3 * level;
    if (count < 64) {
        uint64_t mask = (UINT64_C(1) << count) - 1, bits = grid->bits[index / 64] >> index % 64 & mask;
        return bits == 0 ? 0 : bits == mask ? 1 : -1;
    }
    const uint64_t *word = grid->bits + index / 64;
    if (word[0] != 0 && word[0] != UINT64_MAX)
        return -1;
    for (uint64_t i = 1; i < count / 64; i++)
        if (word[i] != word[0])
            return -1;
    return word[0] != 0;
}

/* An octree_shape: the cells that are set. */
static struct octree_cover grid_covers(const void *shape, const double corner[3], double side, bool cells)
{
    (void)cells;
    const struct grid *grid = shape;
    const unsigned level = grid->depth + (unsigned)ilogb(side);
    struct octree_cover cover = {0, 0};
    for (int i = 0; i < (side < 1 ? 8 : 1); i++) { /* of eight roots there is one */
        int at[3];
        for (int k = 0; k < 3; k++)
            at[k] = (int)((corner[k] + (i >> k & 1 ? side : 0)) * grid->side);
        int fill = run_fill(grid, cell_index(grid, at[0], at[1], at[2]), level);
        cover.inside |= (unsigned)(fill == 1) << i;
        cover.outside |= (unsigned)(fill == 0) << i;
    }
    return cover;
}

/* How many of the two rays along a line, backwards and forwards, say "inside": `behind` is what the crossings
 * behind sum up to and `total` all of them. Each is +1 on the way in. Less than 0 is outside of an open mesh,
 * seen through a hole; in a closed one it is a part that is inside out. */
static int line_votes(const struct slab *slab, int behind, int total)
{
    if (slab->parity)
        return (behind & 1) + ((total - behind) & 1);
    if (slab->closed && total == 0)
        return behind != 0 ? 2 : 0;
    return (behind > 0) + (behind - total > 0);
}

static int crossing_sign(const struct slab *slab, uint32_t crossing)
{
    return !slab->parity && crossing & 1 ? -1 : 1;
}

/* Adds the votes of the line whose crossings are items[from .. to), for cells at votes[i * stride]. */
static void vote_along(struct slab *slab, const uint32_t *items, uint32_t from, uint32_t to,
                       signed char *votes, int stride)
{
    int *change = slab->windings + (size_t)slab->side * (size_t)slab->side;
    int total = 0, behind = 0;
    if (from == to)
        return;
    memset(change, 0, (size_t)slab->side * sizeof *change);
    for (uint32_t i = from; i < to; i++) {
        uint32_t cell = items[i] / 2;
        int sign = crossing_sign(slab, items[i]);
        total += sign;
        if (cell < (uint32_t)slab->side)
            change[cell] += sign;
    }
    for (int i = 0; i < slab->side; i++) {
        behind += change[i];
        votes[(ptrdiff_t)i * stride] = (signed char)(votes[(ptrdiff_t)i * stride] +
                                                     line_votes(slab, behind, total));
    }
}

static int compare_crossings(const void *a, const void *b)
{
    uint32_t one = *(const uint32_t *)a, other = *(const uint32_t *)b;
    return (one > other) - (one < other);
}

/* Sorts each line's crossings along z, so that the slabs can meet them in turn. */
static void sort_lines(struct crossings *crossings, int side)
{
    for (size_t i = 0; i < (size_t)side * (size_t)side; i++) {
        size_t count = crossings->begin[i + 1] - crossings->begin[i];
        if (count > 1)
            qsort(crossings->items + crossings->begin[i], count, sizeof *crossings->items, compare_crossings);
    }
}

static void begin_lines_along_z(struct slab *slab)
{
    const struct crossings *along = &slab->along[2];
    for (size_t i = 0; i < (size_t)slab->side * (size_t)slab->side; i++) {
        slab->next[i] = along->begin[i];
        for (uint32_t k = along->begin[i]; k < along->begin[i + 1]; k++)
            slab->totals[i] += crossing_sign(slab, along->items[k]);
    }
}

static void vote_along_z(struct slab *slab, int z)
{
    const struct crossings *along = &slab->along[2];
    for (size_t i = 0; i < (size_t)slab->side * (size_t)slab->side; i++) { /* column v = y, u = x */
        if (along->begin[i] == along->begin[i + 1])
            continue;
        while (slab->next[i] < along->begin[i + 1] && along->items[slab->next[i]] / 2 <= (uint32_t)z)
            slab->windings[i] += crossing_sign(slab, along->items[slab->next[i]++]);
        slab->votes[i] = (signed char)(slab->votes[i] + line_votes(slab, slab->windings[i], slab->totals[i]));
    }
}

static void vote(struct slab *slab, int z)
{
    const int side = slab->side;
    memset(slab->votes, 0, (size_t)side * (size_t)side);
    for (int i = 0; i < side; i++) {
        size_t along_x = (size_t)z * (size_t)side + (size_t)i; /* u = y, v = z */
        size_t along_y = (size_t)i * (size_t)side + (size_t)z; /* u = z, v = x */
        const struct crossings *x = &slab->along[0], *y = &slab->along[1];
        vote_along(slab, x->items, x->begin[along_x], x->begin[along_x + 1],
                   slab->votes + (size_t)i * (size_t)side, 1);
        vote_along(slab, y->items, y->begin[along_y], y->begin[along_y + 1], slab->votes + i, side);
    }
    vote_along_z(slab, z);
}

/* What the rays leave open, the solid angle decides; without a sense there is none,
 * and half of the rays do. */
static enum status decide(struct job *job, int votes, bool parity, const int cell[3], bool *inside,
                          struct error *err)
{
    *inside = votes >= 5;
    if (votes == 0 || *inside)
        return STATUS_OK;
    job->report->doubtful++;
    if (parity) {
        *inside = votes > 3;
        job->report->undecided += votes == 3;
        return STATUS_OK;
    }
    if (!job->winding) {
        enum status status = winding_new(job->mesh, &job->winding, err);
        if (status)
            return status;
    }
    const double point[3] = {cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
    double part = winding_at(job->winding, point);
    *inside = part > 0.5;
    job->report->undecided += part > 0.25 && part < 0.75;
    return STATUS_OK;
}

static enum status fill_slab(struct job *job, const struct slab *slab, int z, struct error *err)
{
    for (int y = 0; y < slab->side; y++)
        for (int x = 0; x < slab->side; x++) {
            int votes = slab->votes[(size_t)y * (size_t)slab->side + (size_t)x];
            bool inside = false;
            if (votes == 0)
                continue;
            enum status status = decide(job, votes, slab->parity, (const int[3]){x, y, z}, &inside, err);
            if (status)
                return status;
            if (inside) {
                set_cell(&job->grid, x, y, z);
                job->report->inside++;
            }
        }
    return STATUS_OK;
}

static enum status fill_grid(struct job *job, struct error *err)
{
    const size_t side = (size_t)job->grid.side;
    struct slab slab = {.along = job->along,
                        .side = job->grid.side,
                        .votes = array_new(side * side, 1),
                        .windings = calloc(side * side + side, sizeof *slab.windings),
                        .totals = calloc(side * side, sizeof *slab.totals),
                        .next = array_new(side * side, sizeof *slab.next),
                        .parity = job->report->mesh.inconsistent_edges > 0,
                        .closed = job->report->mesh.boundary_edges == 0};
    enum status status = slab.votes && slab.windings && slab.totals && slab.next
                             ? STATUS_OK
                             : error_no_memory(err, "the slabs");
    if (!status)
        begin_lines_along_z(&slab);
    for (int z = 0; z < slab.side && !status; z++) {
        vote(&slab, z);
        status = fill_slab(job, &slab, z, err);
    }
    free(slab.votes);
    free(slab.windings);
    free(slab.totals);
    free(slab.next);
    return status;
}

static enum status check_result(const struct job *job, struct error *err)
{
    const struct voxelise_report *report = job->report;
    if (report->inside == 0)
        return error_set(
            err, STATUS_INPUT,
            "the mesh encloses none of the cells (%zu of its edges are open); a closed surface is "
            "wanted",
            report->mesh.boundary_edges);
    if ((double)report->undecided > UNDECIDED_MAX * (double)report->inside)
        return error_set(
            err, STATUS_INPUT,
            "the mesh is too open to tell inside from outside: %llu cells are undecided where %llu "
            "are inside, %zu edges are open; close its holes",
            (unsigned long long)report->undecided, (unsigned long long)report->inside,
            report->mesh.boundary_edges);
    return STATUS_OK;
}

/* The mesh in cells, as large as leaves one free on each side, turned outwards. */
static enum status fit(const struct mesh *mesh, bool inside_out, int side, struct mesh *fitted,
                       struct error *err)
{
    double low[3], high[3], extent = 0;
    enum status status = mesh_init(fitted, mesh->point_count, mesh->triangle_count, false, err);
    if (status)
        return status;
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (uint32_t p = 0; p < mesh->point_count; p++) {
            low[k] = fmin(low[k], mesh->position[p][k]);
            high[k] = fmax(high[k], mesh->position[p][k]);
        }
        extent = fmax(extent, high[k] - low[k]);
    }
    for (uint32_t p = 0; p < mesh->point_count; p++)
        for (int k = 0; k < 3; k++)
            fitted->position[p][k] = side / 2.0 + (mesh->position[p][k] - low[k] - (high[k] - low[k]) / 2) /
                                                      extent * (side - 2);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            fitted->triangle[t][k] = mesh->triangle[t][inside_out ? 2 - k : k];
    return STATUS_OK;
}

static enum status run(struct job *job, unsigned depth, struct octree *tree, struct error *err)
{
    enum status status = STATUS_OK;
    if (!grid_init(&job->grid, depth))
        status = error_no_memory(err, "the cells");
    for (int axis = 0; axis < 3 && !status; axis++)
        status = crossings_find(job->mesh, axis, job->grid.side, &job->along[axis], err);
    if (!status) {
        sort_lines(&job->along[2], job->grid.side);
        status = fill_grid(job, err);
    }
    if (!status)
        status = check_result(job, err);
    if (!status)
        status = octree_init(tree, depth, 0, err);
    if (!status)
        status = octree_apply(tree, grid_covers, &job->grid, 1, err);
    for (int axis = 0; axis < 3; axis++)
        crossings_clear(&job->along[axis]);
    winding_free(job->winding);
    grid_clear(&job->grid);
    return status;
}

enum status voxelise(const struct mesh *mesh, unsigned depth, struct octree *tree,
                     struct voxelise_report *report, struct error *err)
{
    struct mesh fitted = {0};
    struct octree made = {0};
    if (depth < VOXELISE_DEPTH_MIN || depth > OCTREE_DEPTH_MAX)
        return error_set(err, STATUS_RANGE, "depth %u: a mesh needs one from %d to %d", depth,
                         VOXELISE_DEPTH_MIN, OCTREE_DEPTH_MAX);
    report->inside = report->doubtful = report->undecided = 0;
    enum status status = fit(mesh, report->mesh.volume < 0, 1 << depth, &fitted, err);
    struct job job = {.mesh = &fitted, .report = report};
    if (!status)
        status = run(&job, depth, &made, err);
    mesh_clear(&fitted);
    if (status) {
        octree_clear(&made);
        return status;
    }
    octree_clear(tree);
    *tree = made;
    return STATUS_OK;
}

enum status voxelise_load(const char *path, unsigned depth, struct octree *tree,
                          struct voxelise_report *report, struct error *err)
{
    struct mesh mesh = {0};
    *report = (struct voxelise_report){0};
    enum status status = mesh_load(path, &mesh, err);
    if (status)
        return status;
    status = mesh_repair(&mesh, &report->mesh, err);
    if (!status)
        status = voxelise(&mesh, depth, tree, report, err);
    mesh_clear(&mesh);
    return status && err ? error_prefix(err, path) : status;
}
