/* Pieces that fall off, and the rims of holes in what still holds the gas. */
#include "common/vec3.h"
#include "sim/cracks.h"

/* Where the side's edge is in the triangle across it. */
static int across(const struct sim *sim, const struct sim_balloon *b, uint32_t triangle, int side,
                  uint32_t *other)
{
    const uint32_t edge = sim->triangle_edge[triangle][side];
    *other = b->topology->neighbour[triangle - b->triangle_begin][side];
    int k = 0;
    while (sim->triangle_edge[*other][k] != edge)
        k++;
    return k;
}

/* Triangles of the piece that would fall off if the side were cut between two points of a rim, from
 * `triangle` on and no more than `most` of them, in fracture->list; their area at rest is added up. Returns
 * their count, or UINT32_MAX when there are more. */
static uint32_t piece_beside(struct sim_balloon *b, uint32_t triangle, int side, uint32_t most, double *area)
{
    const uint32_t first = b->triangle_begin, barrier = b->topology->neighbour[triangle - first][side];
    uint32_t *list = b->fracture->list;
    unsigned char *seen = b->fracture->seen;
    uint32_t count = 1, done = 0;
    *area = 0;
    list[0] = triangle;
    seen[triangle - first] = 1;
    while (done < count && count != UINT32_MAX) {
        const uint32_t t = list[done++];
        *area += b->topology->rest_area[t - first];
        for (int k = 0; k < 3; k++) {
            const uint32_t n = b->topology->neighbour[t - first][k];
            if (n == MESH_NONE || seen[n - first] || (t == triangle && n == barrier))
                continue;
            if (count == most) {
                done = count;
                count = UINT32_MAX;
                break;
            }
            seen[n - first] = 1;
            list[count++] = n;
        }
    }
    const uint32_t marked = count == UINT32_MAX ? most : count;
    for (uint32_t i = 0; i < marked; i++)
        seen[list[i] - first] = 0;
    return count;
}

bool fracture_leaves_pieces(struct sim *sim, struct sim_balloon *b, uint32_t triangle, int side)
{
    const struct fracture *f = b->fracture;
    uint32_t other;
    const int other_side = across(sim, b, triangle, side, &other);
    const uint32_t at[2] = {triangle, other};
    const int sides[2] = {side, other_side};
    for (int i = 0; i < 2; i++) {
        double area;
        const uint32_t count = piece_beside(b, at[i], sides[i], f->list_room, &area);
        if (count != UINT32_MAX && (count < 4 || area < b->scene->fracture.smallest * b->topology->area))
            return false;
    }
    return true;
}

uint32_t fracture_falls_off(struct sim *sim, struct sim_balloon *b, uint32_t triangle, int side)
{
    struct fracture *f = b->fracture;
    const uint32_t triangles = b->triangle_end - b->triangle_begin;
    uint32_t other;
    const int other_side = across(sim, b, triangle, side, &other);
    const struct {
        uint32_t triangle, beyond;
        int side;
    } ways[2] = {{triangle, other, side}, {other, triangle, other_side}};
    for (uint32_t most = 64;; most = most < triangles / 4 ? 4 * most : triangles)
        for (int i = 0; i < 2; i++) {
            double area;
            const uint32_t count = piece_beside(b, ways[i].triangle, ways[i].side, most, &area);
            if (count == UINT32_MAX)
                continue;
            for (uint32_t k = 0; k < count; k++)
                if (f->list[k] == ways[i].beyond)
                    return 0; /* a handle, or a ring: it still hangs together elsewhere */
            return count;
        }
}

void fracture_let_fall(struct sim *sim, struct sim_balloon *b, uint32_t count)
{
    struct fracture *f = b->fracture;
    f->now.pieces++;
    if (f->lost[f->list[0] - b->triangle_begin])
        return;
    for (uint32_t i = 0; i < count; i++) {
        f->lost[f->list[i] - b->triangle_begin] = 1;
        gas_let_go(sim, b, sim->triangle_point[f->list[i]], 3);
    }
}

/* From the end of a side of a rim to the next side. */
static void follow_rim(const struct sim *sim, const struct sim_balloon *b, uint32_t *triangle, uint32_t *side)
{
    struct fan fan = {*triangle, (int)(*side + 1) % 3};
    uint32_t next;
    while ((next = b->topology->neighbour[fan.triangle - b->triangle_begin][fan.corner]) != MESH_NONE) {
        const uint32_t point = sim->triangle_point[fan.triangle][fan.corner];
        int corner = 0;
        while (sim->triangle_point[next][corner] != point)
            corner++;
        fan = (struct fan){next, corner};
    }
    *triangle = fan.triangle;
    *side = (uint32_t)fan.corner;
}

void fracture_tell_gas(struct sim *sim, struct sim_balloon *b)
{
    struct fracture *f = b->fracture;
    struct gas_rims *rims = &f->rims;
    const struct topology *top = b->topology;
    if (!b->gas)
        return;
    rims->side_count = rims->hole_count = 0;
    for (uint32_t i = 0; i < top->now.rims; i++)
        f->hole_of[3 * (top->rim[i][0] - b->triangle_begin) + top->rim[i][1]] = MESH_NONE;
    for (uint32_t i = 0; i < top->now.rims; i++) {
        uint32_t t = top->rim[i][0], k = top->rim[i][1];
        if (f->lost[t - b->triangle_begin])
            continue;
        uint32_t *hole = &f->hole_of[3 * (t - b->triangle_begin) + k];
        if (*hole != MESH_NONE)
            continue;
        for (; *hole == MESH_NONE; hole = &f->hole_of[3 * (t - b->triangle_begin) + k]) {
            *hole = rims->hole_count;
            rims->side[rims->side_count][0] = sim->triangle_point[t][k];
            rims->side[rims->side_count][1] = sim->triangle_point[t][(k + 1) % 3];
            rims->hole[rims->side_count++] = rims->hole_count;
            follow_rim(sim, b, &t, &k);
        }
        rims->hole_count++;
    }
}
