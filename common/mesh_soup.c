#include "common/array.h"
#include "common/mesh.h"
#include "common/triple_set.h"

#include <stdlib.h>

enum status mesh_from_soup(const double (*corner)[3], size_t triangle_count, struct mesh *mesh,
                           struct error *err)
{
    struct mesh made;
    struct triple_set points = {0};
    enum status status = mesh_init(&made, 0, triangle_count, false, err);
    if (status)
        return status;
    for (size_t i = 0; i < 3 * triangle_count && !status; i++) {
        uint32_t point = triple_set_add(&points, corner[i]);
        made.triangle[i / 3][i % 3] = point;
        if (point == TRIPLE_NONE && points.count >= TRIPLE_NONE - 1)
            status = error_set(err, STATUS_RANGE, "more than %u different points", TRIPLE_NONE - 1);
        else if (point == TRIPLE_NONE)
            status = error_no_memory(err, "the points");
    }
    if (status) {
        mesh_clear(&made);
        triple_set_clear(&points);
        return status;
    }
    if (points.count > 0) {
        double(*fitting)[3] = realloc(points.items, points.count * sizeof *points.items);
        free(made.position);
        made.position = fitting ? fitting : points.items;
        made.point_count = (uint32_t)points.count;
        points.items = NULL;
    }
    triple_set_clear(&points);
    mesh_clear(mesh);
    *mesh = made;
    return STATUS_OK;
}
