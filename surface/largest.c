#include "surface/largest.h"

#include "common/vec3.h"
#include "surface/probe.h"

#include <math.h>
#include <string.h>

struct search {
    struct probe probe;
    double enough, value, point[3];
    int apart;     /* the side of aligned cubes, a power of 2, in each of which one leaf is looked at */
    int latest[3]; /* that of the leaf before, in such sides */
};

static void look(struct search *search, const double point[3])
{
    double gradient[3], value = probe_value(&search->probe, point, gradient);
    if (value <= search->value)
        return;
    search->value = value;
    memcpy(search->point, point, sizeof search->point);
}

/* Leaves come in Morton order: those of an aligned cube one after the other. */
static bool is_same_cube(struct search *search, const struct octree_leaf *leaf)
{
    const int cube[3] = {leaf->x / search->apart, leaf->y / search->apart, leaf->z / search->apart};
    const bool same = !memcmp(cube, search->latest, sizeof cube);
    memcpy(search->latest, cube, sizeof cube);
    return same;
}

static bool look_at_leaf(void *context, const struct octree_leaf *leaf)
{
    struct search *search = context;
    if (is_same_cube(search, leaf))
        return true;
    double half = leaf->side / 2.0, spacing = search->probe.field->lattice[TRACK_VOLUME].spacing;
    double middle[3] = {leaf->x + half, leaf->y + half, leaf->z + half};
    double first[3] = {leaf->x + spacing / 2, leaf->y + spacing / 2, leaf->z + spacing / 2};
    look(search, middle);
    look(search, first);
    for (int face = 0; face < 6; face++) {
        double point[3] = {middle[0], middle[1], middle[2]};
        point[face / 2] += face % 2 ? half : -half;
        look(search, point);
    }
    return !search->probe.failed && search->value < search->enough;
}

static void climb(struct search *search)
{
    for (double step = 0.5; step > 1e-6; step /= 2) {
        double gradient[3], before = search->value, point[3];
        probe_value(&search->probe, search->point, gradient);
        double length = vec3_length(gradient);
        if (!(length > 0))
            return;
        for (int axis = 0; axis < 3; axis++)
            point[axis] = search->point[axis] + step * gradient[axis] / length;
        look(search, point);
        step *= search->value > before ? 2 : 1;
    }
}

/* Over a sigma the field changes little, and the climb does the rest: more places cost only time. */
static int cubes_apart(const struct field *field)
{
    int apart = 1;
    while (2 * apart <= field->side && 2 * apart <= field->sigma)
        apart *= 2;
    return apart;
}

enum status field_largest(const struct field *field, double enough, double *value, double point[3],
                          struct error *err)
{
    struct search search = {
        .enough = enough, .value = -INFINITY, .apart = cubes_apart(field), .latest = {-1, -1, -1}};
    enum status status = probe_init(&search.probe, field, err);
    if (status)
        return status;
    probe_expect(&search.probe, 1);
    octree_visit_all(field->tree, look_at_leaf, &search);
    if (search.value < enough)
        climb(&search);
    bool failed = search.probe.failed;
    probe_clear(&search.probe);
    if (failed)
        return error_no_memory(err, "the field");
    *value = search.value;
    memcpy(point, search.point, sizeof search.point);
    return STATUS_OK;
}
