#include "surface/cell.h"

#include "common/vec3.h"

#include <string.h>

static int edge_between(int p, int q)
{
    int axis = (p ^ q) >> 1, base = p & q; /* 1, 2, 4 -> 0, 1, 2 */
    return 4 * axis + (base >> (axis + 1) % 3 & 1) + 2 * (base >> (axis + 2) % 3 & 1);
}

static void make_face(struct cell_table *table, int face)
{
    static const uint8_t turn[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int axis = face / 2, upper = face % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < 4; i++) {
        int first = turn[i][!upper], second = turn[i][upper];
        table->corner[face][i] = (uint8_t)(upper << axis | first << u | second << v);
    }
    for (int i = 0; i < 4; i++) {
        int edge = edge_between(table->corner[face][i], table->corner[face][(i + 1) % 4]);
        table->edge[face][i] = (uint8_t)edge;
        table->faces[edge] |= (uint8_t)(1 << face);
        int p = table->corner[face][i], q = table->corner[face][(i + 1) % 4];
        table->ends[edge][0] = (uint8_t)(p & q);
        table->ends[edge][1] = (uint8_t)(p | q);
    }
}

/* The arcs of one face: next[edge where the walk enters] = edge where it leaves. */
static void link_face(const struct cell_table *table, int face, unsigned inside, bool joined,
                      uint8_t next[CELL_EDGES])
{
    const uint8_t *corner = table->corner[face], *edge = table->edge[face];
    for (int i = 0; i < 4; i++) {
        if (inside >> corner[i] & 1 || !(inside >> corner[(i + 1) % 4] & 1))
            continue;
        /* Leaves after the run of inside corners, or, where those belong together, before the run of
         * outside ones. */
        int leave = (i + 1) % 4;
        if (joined)
            leave = (i + 3) % 4;
        else
            while (inside >> corner[(leave + 1) % 4] & 1)
                leave = (leave + 1) % 4;
        next[edge[i]] = edge[leave];
    }
}

void cell_find_loops(const struct cell_table *table, unsigned inside, unsigned joined,
                     struct cell_loops *loops)
{
    enum { NONE = 255 };
    uint8_t next[CELL_EDGES];
    memset(next, NONE, sizeof next);
    for (int face = 0; face < CELL_FACES; face++)
        if (table->crossed[inside] >> face & 1)
            link_face(table, face, inside, table->ambiguous[inside] >> face & joined >> face & 1, next);
    loops->count = 0;
    for (int start = 0; start < CELL_EDGES; start++) {
        if (next[start] == NONE)
            continue;
        int length = 0, loop = loops->count++;
        for (uint8_t edge = (uint8_t)start; next[edge] != NONE;) {
            loops->edge[loop][length++] = edge;
            uint8_t following = next[edge];
            next[edge] = NONE;
            edge = following;
        }
        loops->length[loop] = (uint8_t)length;
    }
}

void cell_table_make(struct cell_table *table)
{
    memset(table, 0, sizeof *table);
    for (int face = 0; face < CELL_FACES; face++)
        make_face(table, face);
    for (int mask = 0; mask < 256; mask++)
        for (int face = 0; face < CELL_FACES; face++) {
            const uint8_t *c = table->corner[face];
            int a = mask >> c[0] & 1, b = mask >> c[1] & 1, d = mask >> c[2] & 1, e = mask >> c[3] & 1;
            if (a != b || b != d || d != e)
                table->crossed[mask] |= (uint8_t)(1 << face);
            if (a == d && b == e && a != b)
                table->ambiguous[mask] |= (uint8_t)(1 << face);
        }
    for (unsigned mask = 0; mask < 256; mask++) {
        struct cell_loops *loops = &table->loops[mask];
        cell_find_loops(table, mask, 0, loops);
        for (int i = 0; i < loops->count; i++)
            table->triangles[mask] += (uint8_t)(loops->length[i] - 2);
    }
}

/* The squared cosine of a triangle's smallest angle, that opposite its shortest side, from the squares of its
 * sides: below 60 degrees a sharper angle's is larger. */
static double sharpness(double p, double q, double r)
{
    double swap = r;
    if (p < r && p <= q) {
        r = p;
        p = swap;
    } else if (q < r) {
        r = q;
        q = swap;
    }
    double twice = p + q - r;
    return p * q > 0 ? twice * twice / (4 * p * q) : 1;
}

static double sharper(double a, double b)
{
    return a > b ? a : b;
}

/* best[i][j]: the sharpest angle's measure in the best triangulation of the part of the loop from i to j;
 * apex[i][j]: the corner of the triangle on its chord. Klincsek's dynamic programme ("Minimal
 * triangulations of polygonal domains", 1980) with the smallest angle for a measure. */
struct plan {
    double best[CELL_EDGES][CELL_EDGES];
    uint8_t apex[CELL_EDGES][CELL_EDGES];
};

static void plan_chord(struct plan *plan, const double place[][3], int i, int j)
{
    for (int k = i + 1; k < j; k++) {
        double worse = sharper(plan->best[i][k], plan->best[k][j]);
        if (worse >= plan->best[i][j])
            continue;
        double cost = sharper(worse, sharpness(vec3_square_distance(place[i], place[k]),
                                               vec3_square_distance(place[k], place[j]),
                                               vec3_square_distance(place[j], place[i])));
        if (cost < plan->best[i][j]) {
            plan->best[i][j] = cost;
            plan->apex[i][j] = (uint8_t)k;
        }
    }
}

static int read_plan(const struct plan *plan, int i, int j, uint8_t triangles[][3], int count)
{
    if (j < i + 2)
        return count;
    int k = plan->apex[i][j];
    triangles[count][0] = (uint8_t)i;
    triangles[count][1] = (uint8_t)k;
    triangles[count][2] = (uint8_t)j;
    count = read_plan(plan, i, k, triangles, count + 1);
    return read_plan(plan, k, j, triangles, count);
}

/* The same for four vertices, which most loops have: a choice between two chords. */
static int triangulate_four(const struct cell_table *table, const uint8_t *edges, const double place[][3],
                            uint8_t triangles[][3])
{
    static const uint8_t cuts[2][2][3] = {{{0, 1, 3}, {1, 2, 3}}, {{0, 2, 3}, {0, 1, 2}}};
    double side[4], odd = vec3_square_distance(place[1], place[3]),
                    even = vec3_square_distance(place[0], place[2]);
    for (int i = 0; i < 4; i++)
        side[i] = vec3_square_distance(place[i], place[(i + 1) % 4]);
    bool odd_ok = !(table->faces[edges[1]] & table->faces[edges[3]]);
    bool even_ok = !(table->faces[edges[0]] & table->faces[edges[2]]);
    double by_odd = sharper(sharpness(side[3], side[0], odd), sharpness(side[1], side[2], odd));
    double by_even = sharper(sharpness(side[0], side[1], even), sharpness(side[2], side[3], even));
    memcpy(triangles, cuts[!odd_ok || (even_ok && by_even < by_odd)], sizeof cuts[0]);
    return 2;
}

int cell_triangulate(const struct cell_table *table, const uint8_t *edges, int length,
                     const double place[][3], uint8_t triangles[][3])
{
    /* Above any squared cosine, so that a flat triangle is still better than none. */
    const double allowed = 2, forbidden = 3;
    struct plan plan;
    if (length == 3) {
        memcpy(triangles[0], (uint8_t[3]){0, 1, 2}, 3);
        return 1;
    }
    if (length == 4)
        return triangulate_four(table, edges, place, triangles);
    for (int i = 0; i + 1 < length; i++)
        plan.best[i][i + 1] = -1;
    for (int span = 2; span < length; span++)
        for (int i = 0; i + span < length; i++) {
            int j = i + span;
            bool arc = span == length - 1,
                 chord_ok = arc || !(table->faces[edges[i]] & table->faces[edges[j]]);
            plan.best[i][j] = chord_ok ? allowed : forbidden;
            if (chord_ok)
                plan_chord(&plan, place, i, j);
            if (plan.best[i][j] == allowed)
                plan.best[i][j] = forbidden;
        }
    if (plan.best[0][length - 1] >= allowed)
        return 0;
    return read_plan(&plan, 0, length - 1, triangles, 0);
}

bool cell_needs_middle(const struct cell_table *table, const uint8_t *edges, int length)
{
    double place[CELL_EDGES][3];
    uint8_t triangles[CELL_EDGES][3];
    if (length < 8)
        return false;
    /* Wherever the vertices are: no choice is worse than a forbidden one. */
    for (int i = 0; i < length; i++)
        for (int axis = 0; axis < 3; axis++)
            place[i][axis] = axis == 0 ? i : axis == 1 ? i * i : 0;
    return cell_triangulate(table, edges, length, place, triangles) == 0;
}
