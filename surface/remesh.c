#include "surface/remesh.h"

#include <stdlib.h>
#include <string.h>

static void glue(struct remesh *r, uint32_t side, uint32_t other)
{
    r->across[side / 3][side % 3] = other;
    r->across[other / 3][other % 3] = side;
}

static void set_triangle(struct remesh *r, uint32_t t, uint32_t a, uint32_t b, uint32_t c)
{
    memcpy(r->triangle[t], (uint32_t[3]){a, b, c}, sizeof r->triangle[t]);
    r->corner[a] = 3 * t;
    r->corner[b] = 3 * t + 1;
    r->corner[c] = 3 * t + 2;
}

int remesh_ring(const struct remesh *r, uint32_t point, uint32_t corners[RING_MAX])
{
    uint32_t corner = r->corner[point];
    int count = 0;
    do {
        if (count == RING_MAX)
            return 0;
        corners[count++] = corner;
        corner = corner_around(r, corner);
    } while (corner != corners[0]);
    return count;
}

static bool in_ring(const struct remesh *r, const uint32_t *corners, int count, uint32_t point)
{
    for (int i = 0; i < count; i++)
        if (side_point(r, side_next(corners[i])) == point)
            return true;
    return false;
}

/* Of the two points across, which lose a neighbour each, none may keep fewer than three. */
bool remesh_collapse_allowed(const struct remesh *r, uint32_t side)
{
    uint32_t ring_a[RING_MAX], ring_b[RING_MAX];
    uint32_t other = side_across(r, side), a = side_point(r, side), b = side_point(r, other);
    int left = r->degree[a] + r->degree[b] - 4;
    if (r->degree[side_point(r, side_next(side_next(side)))] < 4 ||
        r->degree[side_point(r, side_next(side_next(other)))] < 4 || left < 3 || left > RING_MAX)
        return false;
    int count_a = remesh_ring(r, a, ring_a), count_b = remesh_ring(r, b, ring_b), common = 0;
    for (int i = 0; i < count_b; i++)
        common += in_ring(r, ring_a, count_a, side_point(r, side_next(ring_b[i])));
    return count_a && count_b && common == 2;
}

void remesh_collapse(struct remesh *r, uint32_t side, const double place[3], const double normal[3])
{
    uint32_t ring[RING_MAX], other = side_across(r, side);
    uint32_t a = side_point(r, side), b = side_point(r, other);
    int count = remesh_ring(r, b, ring);
    for (int i = 0; i < count; i++)
        r->triangle[ring[i] / 3][ring[i] % 3] = a;
    const uint32_t sides[] = {side, other};
    for (int i = 0; i < 2; i++) {
        uint32_t next = side_next(sides[i]), last = side_next(next);
        uint32_t n = side_across(r, next), l = side_across(r, last);
        glue(r, n, l);
        r->corner[side_point(r, last)] = n;
        r->degree[side_point(r, last)]--;
        r->corner[a] = l;
        r->triangle[sides[i] / 3][0] = MESH_NONE;
    }
    r->corner[b] = MESH_NONE;
    r->degree[a] = (uint8_t)(r->degree[a] + r->degree[b] - 4);
    memcpy(r->position[a], place, sizeof r->position[a]);
    memcpy(r->normal[a], normal, sizeof r->normal[a]);
    r->points_alive--;
    r->triangles_alive -= 2;
}

bool remesh_flip_allowed(const struct remesh *r, uint32_t side)
{
    uint32_t ring[RING_MAX], other = side_across(r, side), c = side_point(r, side_next(side_next(side)));
    uint32_t d = side_point(r, side_next(side_next(other)));
    if (r->degree[side_point(r, side)] < 4 || r->degree[side_point(r, other)] < 4 ||
        r->degree[c] >= RING_MAX || r->degree[d] >= RING_MAX)
        return false;
    return !in_ring(r, ring, remesh_ring(r, c, ring), d);
}

/* (a, b, c) and (b, a, d) become (a, d, c) and (d, b, c). */
void remesh_flip(struct remesh *r, uint32_t side)
{
    uint32_t other = side_across(r, side), t = side / 3, u = other / 3;
    uint32_t bc = side_next(side), ca = side_next(bc), ad = side_next(other), db = side_next(ad);
    uint32_t a = side_point(r, side), b = side_point(r, other), c = side_point(r, ca), d = side_point(r, db);
    uint32_t far_bc = side_across(r, bc), far_ca = side_across(r, ca);
    uint32_t far_ad = side_across(r, ad), far_db = side_across(r, db);
    r->degree[a]--;
    r->degree[b]--;
    r->degree[c]++;
    r->degree[d]++;
    set_triangle(r, t, a, d, c);
    set_triangle(r, u, d, b, c);
    glue(r, 3 * t, far_ad);
    glue(r, 3 * t + 2, far_ca);
    glue(r, 3 * u, far_db);
    glue(r, 3 * u + 1, far_bc);
    glue(r, 3 * t + 1, 3 * u + 2);
}

static bool grow(void *address, size_t count, size_t size)
{
    void **items = address, *grown = realloc(*items, count * size);
    *items = grown ? grown : *items;
    return grown;
}

static bool make_room(struct remesh *r)
{
    if (r->triangle_count > MESH_NONE / 6)
        return false;
    if (r->point_count == r->point_room || !r->beside) {
        uint32_t room = r->point_count + r->point_count / 8 + 16;
        if (!grow(&r->position, room, sizeof *r->position) || !grow(&r->normal, room, sizeof *r->normal) ||
            !grow(&r->corner, room, sizeof *r->corner) || !grow(&r->degree, room, sizeof *r->degree) ||
            !grow(&r->beside, room - r->first_new, sizeof *r->beside))
            return false;
        r->point_room = room;
    }
    if (r->triangle_count + 2 > r->triangle_room) {
        uint32_t room = r->triangle_count + r->triangle_count / 8 + 16;
        if (!grow(&r->triangle, room, sizeof *r->triangle) || !grow(&r->across, room, sizeof *r->across))
            return false;
        r->triangle_room = room;
    }
    return true;
}

/* (a, b, c) and (b, a, d) become (a, p, c), (p, b, c), (b, p, d) and (p, a, d). */
bool remesh_split(struct remesh *r, uint32_t side, const double place[3], const double normal[3])
{
    if (!make_room(r))
        return false;
    uint32_t other = side_across(r, side), t = side / 3, u = other / 3;
    uint32_t bc = side_next(side), ca = side_next(bc), ad = side_next(other), db = side_next(ad);
    uint32_t a = side_point(r, side), b = side_point(r, other), c = side_point(r, ca), d = side_point(r, db);
    uint32_t far_bc = side_across(r, bc), far_ca = side_across(r, ca);
    uint32_t far_ad = side_across(r, ad), far_db = side_across(r, db);
    uint32_t p = r->point_count++, v = r->triangle_count++, w = r->triangle_count++;
    memcpy(r->position[p], place, sizeof r->position[p]);
    memcpy(r->normal[p], normal, sizeof r->normal[p]);
    r->beside[p - r->first_new] = a < r->first_new ? a : r->beside[a - r->first_new];
    r->degree[p] = 4;
    if (r->degree[c] < DEGREE_MAX)
        r->degree[c]++;
    if (r->degree[d] < DEGREE_MAX)
        r->degree[d]++;
    set_triangle(r, t, a, p, c);
    set_triangle(r, v, p, b, c);
    set_triangle(r, u, b, p, d);
    set_triangle(r, w, p, a, d);
    glue(r, 3 * t + 2, far_ca);
    glue(r, 3 * v + 1, far_bc);
    glue(r, 3 * u + 2, far_db);
    glue(r, 3 * w + 1, far_ad);
    glue(r, 3 * t, 3 * w);
    glue(r, 3 * v, 3 * u);
    glue(r, 3 * t + 1, 3 * v + 2);
    glue(r, 3 * u + 1, 3 * w + 2);
    r->points_alive++;
    r->triangles_alive += 2;
    return true;
}
