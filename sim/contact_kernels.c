/* Four pairs at once (lanes.h). SIM_CONTACT is the name of the table at the end. */
#include "sim/contact_kernels.h"
#include "sim/lanes.h"

/* The four points of four pairs. */
struct four {
    struct lanes3 x[4];
};

static inline struct lanes3 sub(struct lanes3 a, struct lanes3 b)
{
    return (struct lanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct lanes3 scale(lanes s, struct lanes3 a)
{
    return (struct lanes3){s * a.x, s * a.y, s * a.z};
}

static inline struct lanes3 select3(lane_mask mask, struct lanes3 a, struct lanes3 b)
{
    return (struct lanes3){lanes_select(mask, a.x, b.x), lanes_select(mask, a.y, b.y),
                           lanes_select(mask, a.z, b.z)};
}

static inline lanes clamp(lanes value)
{
    return lanes_min(lanes_max(value, lanes_all(0)), lanes_all(1));
}

/* 0 where there is nothing to divide by. */
static inline lanes divide(lanes a, lanes b)
{
    const lane_mask some = b > 0;
    return lanes_select(some, a, lanes_all(0)) / lanes_select(some, b, lanes_all(1));
}

/* From the nearest place on the line from 0 to `side` to `place`. */
static inline struct lanes3 from_side(struct lanes3 side, struct lanes3 place)
{
    const lanes along = clamp(divide(lanes_dot(place, side), lanes_dot(side, side)));
    return lanes_sum(lanes_all(1), place, -along, side);
}

static inline struct lanes3 shorter(struct lanes3 a, struct lanes3 b)
{
    return select3(lanes_dot(a, a) < lanes_dot(b, b), a, b);
}

/* From the nearest place of the triangle 1 2 3 to the point 0: across its plane where the point is over it, else from the nearest side. */
static inline struct lanes3 from_triangle(const struct four *f)
{
    const struct lanes3 ab = sub(f->x[2], f->x[1]), ac = sub(f->x[3], f->x[1]), ap = sub(f->x[0], f->x[1]),
                        normal = lanes_cross(ab, ac);
    const lanes square = lanes_dot(normal, normal), c = lanes_dot(lanes_cross(ab, ap), normal),
                b = lanes_dot(lanes_cross(ap, ac), normal);
    const struct lanes3 across = scale(divide(lanes_dot(ap, normal), square), normal),
                        side = shorter(shorter(from_side(ab, ap), from_side(ac, ap)),
                                       from_side(sub(f->x[3], f->x[2]), sub(f->x[0], f->x[2])));
    return select3((b >= 0) & (c >= 0) & (b + c <= square) & (square > 0), across, side);
}

/* From the nearest place of the edge 2 3 to that of the edge 0 1 (ccd.c). */
static inline struct lanes3 from_edge(const struct four *f)
{
    const struct lanes3 d1 = sub(f->x[1], f->x[0]), d2 = sub(f->x[3], f->x[2]), r = sub(f->x[0], f->x[2]);
    const lanes a = lanes_dot(d1, d1), e = lanes_dot(d2, d2), g = lanes_dot(d2, r), c = lanes_dot(d1, r),
                b = lanes_dot(d1, d2);
    const lanes free_s = clamp(divide(b * g - c * e, a * e - b * b)), free_t = divide(b * free_s + g, e),
                t = clamp(free_t);
    const lanes s = lanes_select(t == free_t, free_s, clamp(divide(b * t - c, a)));
    return lanes_sum(lanes_all(1), lanes_sum(lanes_all(1), r, s, d1), -t, d2);
}

static inline lanes apart_along(const struct four *f, enum ccd_kind kind, struct lanes3 n)
{
    const lanes x0 = lanes_dot(n, f->x[0]), x1 = lanes_dot(n, f->x[1]), x2 = lanes_dot(n, f->x[2]),
                x3 = lanes_dot(n, f->x[3]), high = lanes_max(x2, x3);
    return kind == CCD_EDGES ? lanes_min(x0, x1) - high : x0 - lanes_max(x1, high);
}

static inline void four_apart(const struct contact_flock *flock, enum ccd_kind kind,
                              const uint32_t (*points)[4], double (*apart)[2])
{
    struct four first, last;
    const row *from = (const row *)flock->from, *to = (const row *)flock->to;
    for (int k = 0; k < 4; k++) {
        row at[4], end[4];
        for (int i = 0; i < 4; i++) {
            end[i] = to[points[i][k]];
            at[i] = from[points[i][k]];
            at[i] += flock->gone * (end[i] - at[i]);
        }
        first.x[k] = lanes_of_rows(at);
        last.x[k] = lanes_of_rows(end);
    }
    const struct lanes3 way = kind == CCD_EDGES ? from_edge(&first) : from_triangle(&first),
                        n = scale(divide(lanes_all(1), lanes_sqrt(lanes_dot(way, way))), way);
    const lanes begin = apart_along(&first, kind, n), end = apart_along(&last, kind, n);
    for (int i = 0; i < 4; i++) {
        apart[i][0] = begin[i];
        apart[i][1] = end[i];
    }
}

static void apart(const struct contact_flock *flock, uint32_t (*points)[4], uint32_t count,
                  double (*apart)[2])
{
    for (uint32_t i = count; i % 4 != 0; i++)
        for (int k = 0; k < 4; k++)
            points[i][k] = points[count - 1][k];
    if (flock->kind == CCD_EDGES)
        for (uint32_t i = 0; i < count; i += 4)
            four_apart(flock, CCD_EDGES, (const uint32_t(*)[4]) & points[i], &apart[i]);
    else
        for (uint32_t i = 0; i < count; i += 4)
            four_apart(flock, CCD_POINT_TRIANGLE, (const uint32_t(*)[4]) & points[i], &apart[i]);
}

extern const struct contact_kernels SIM_CONTACT;
const struct contact_kernels SIM_CONTACT = {apart};
