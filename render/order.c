#include "render/order.h"

#include "common/array.h"
#include "common/vec3.h"
#include "render/geometry.h"

#include <string.h>

bool order_is_whole(const struct render_skin *skin)
{
    uint32_t t = 0;
    while (t < skin->mesh->triangle_count && (!skin->active || skin->active[t]))
        t++;
    return t == skin->mesh->triangle_count;
}

/* Distances are positive floats, whose bits sort like the numbers. */
static uint32_t nearness_of(double square)
{
    float key = (float)square;
    uint32_t bits;
    memcpy(&bits, &key, sizeof bits);
    return ~bits;
}

static double square_distance(double corner[3][3], double closed)
{
    double normal[3], middle[3];
    vec3_triangle(corner[0], corner[1], corner[2], normal);
    const bool outside = vec3_dot(normal, corner[0]) < 0;
    double end = vec3_dot(corner[0], corner[0]);
    for (int k = 1; k < 3; k++) {
        const double square = vec3_dot(corner[k], corner[k]);
        end = outside ? fmin(end, square) : fmax(end, square);
    }
    for (int i = 0; i < 3; i++)
        middle[i] = (corner[0][i] + corner[1][i] + corner[2][i]) / 3;
    return closed * end + (1 - closed) * vec3_dot(middle, middle);
}

uint32_t order_nearness(double corner[3][3], double closed)
{
    return nearness_of(square_distance(corner, closed));
}

/* Least significant digit first, 11 bits at a time. */
void order_sort(struct order_triangle *triangles, struct order_triangle *spare, size_t count)
{
    struct order_triangle *from = triangles, *to = spare;
    for (int shift = 0; shift < 33; shift += 11) {
        size_t start[2049] = {0};
        for (size_t i = 0; i < count; i++)
            start[(from[i].nearness >> shift & 2047) + 1]++;
        for (int digit = 0; digit < 2048; digit++)
            start[digit + 1] += start[digit];
        for (size_t i = 0; i < count; i++)
            to[start[from[i].nearness >> shift & 2047]++] = from[i];
        struct order_triangle *swap = from;
        from = to;
        to = swap;
    }
    if (count)
        memcpy(triangles, spare, count * sizeof *triangles);
}

enum status order_indices(struct geometry *g, bool sorted, struct error *err)
{
    const size_t translucent = g->translucent.count;
    g->spare.count = 0;
    g->indices.count = 3 * g->opaque;
    if (!ARRAY_RESERVE(&g->spare, translucent) || !ARRAY_RESERVE(&g->indices, 3 * translucent))
        return error_no_memory(err, "the triangles' order");
    if (sorted)
        order_sort(g->translucent.items, g->spare.items, translucent);
    for (size_t i = 0; i < translucent; i++, g->indices.count += 3)
        memcpy(g->indices.items + g->indices.count, g->translucent.items[i].vertex, 3 * sizeof(uint32_t));
    return STATUS_OK;
}
