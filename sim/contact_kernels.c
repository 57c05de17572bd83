/* Four triangles at once (lanes.h), and eight pairs (contact_apart.h). SIM_CONTACT is the name
 * of the table at the end. */
#include "sim/contact_apart.h"
#include "sim/contact_sift.h"
#include "sim/lanes.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

/* One end of a box: its low and its high corner side by side. */
typedef float extent __attribute__((vector_size(8 * sizeof(float)), aligned(4 * sizeof(float)), may_alias));
typedef int32_t extent_mask __attribute__((vector_size(8 * sizeof(int32_t))));

static inline bool any_negative(extent_mask mask)
{
#ifdef __AVX__
    return _mm256_movemask_ps((__m256)mask) != 0;
#else
    const struct {
        box_mask half[2];
    } *halves = (const void *)&mask;
    return box_any_negative(halves->half[0] | halves->half[1]);
#endif
}

/* A box with its corners changed round, so that sums with another box's are of a low
 * one and a high one each. */
struct turned {
    extent at[2];
};

static inline struct turned turn(const struct contact_box *box)
{
    const extent *at = (const extent *)box->at;
    return (struct turned){{__builtin_shufflevector(at[0], at[0], 4, 5, 6, 7, 0, 1, 2, 3),
                            __builtin_shufflevector(at[1], at[1], 4, 5, 6, 7, 0, 1, 2, 3)}};
}

/* contact_boxes_meet() */
static inline bool meets(const struct turned *a, const struct contact_box *b)
{
    const extent *at = (const extent *)b->at;
    return !any_negative((extent_mask)(a->at[0] + at[0]) & (extent_mask)(a->at[1] + at[1]));
}

/* Those of a group that meet the box that another is in. */
static inline uint32_t near_of(const struct contact_group *group, const struct contact_box *all,
                               uint8_t *kept)
{
    const struct turned turned = turn(all);
    uint32_t count = 0;
    for (uint32_t i = 0; i < group->count; i++) {
        kept[count] = (uint8_t)i;
        count += meets(&turned, &group->box[i]);
    }
    return count;
}

static uint32_t meet(const struct contact_group *a, const struct contact_group *b, uint8_t (*couples)[2])
{
    uint8_t first[UINT8_MAX], second[UINT8_MAX];
    const uint32_t firsts = near_of(a, b->all, first), seconds = firsts ? near_of(b, a->all, second) : 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < firsts; i++) {
        const struct turned turned = turn(&a->box[first[i]]);
        for (uint32_t j = a->box == b->box ? i + 1 : 0; j < seconds; j++) {
            couples[count][0] = first[i];
            couples[count][1] = second[j];
            count += meets(&turned, &b->box[second[j]]);
        }
    }
    return count;
}

/* Makes the number a multiple of eight, by the last one again. */
static void fill_up(uint32_t (*points)[4], uint32_t count)
{
    for (uint32_t i = count; i % 8 != 0; i++)
        for (int k = 0; k < 4; k++)
            points[i][k] = points[count - 1][k];
}

static void apart(const struct contact_flock *flock, uint32_t (*points)[4], uint32_t count, float (*apart)[2])
{
    fill_up(points, count);
    for (uint32_t i = 0; i < count; i += 8) {
        const uint32_t(*eight)[4] = (const uint32_t(*)[4]) & points[i];
        if (flock->kind == CCD_EDGES)
            apart_eight(flock, CCD_EDGES, eight, &apart[i]);
        else
            apart_eight(flock, CCD_POINT_TRIANGLE, eight, &apart[i]);
    }
}

static uint32_t open(const struct contact_flock *flock, double thickness, uint32_t (*points)[4],
                     uint32_t count, uint32_t *open, float *clear)
{
    const float least = (float)(1.000001 * thickness);
    uint32_t found = 0;
    fill_up(points, count);
    for (uint32_t i = 0; i < count; i += 8) {
        const uint32_t(*eight)[4] = (const uint32_t(*)[4]) & points[i];
        unsigned bits = flock->kind == CCD_EDGES
                            ? apart_open(flock, least, CCD_EDGES, eight, &clear[i])
                            : apart_open(flock, least, CCD_POINT_TRIANGLE, eight, &clear[i]);
        for (uint32_t j = i; bits && j < count; j++, bits >>= 1)
            if (bits & 1)
                open[found++] = j;
    }
    return found;
}

static void round_places(const struct contact_rounding *job, uint32_t begin, uint32_t end)
{
    typedef float half __attribute__((vector_size(4 * sizeof(float)), may_alias));
    const row origin = {job->origin[0], job->origin[1], job->origin[2], 0};
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t p = job->points ? job->points[i] : i;
        const row first = *(const row *)job->from[p] - origin, last = *(const row *)job->to[p] - origin;
        ((half *)job->ends[p])[0] = __builtin_convertvector(first, half);
        ((half *)job->ends[p])[1] = __builtin_convertvector(last, half);
    }
}

static inline struct lanes3 sub(struct lanes3 a, struct lanes3 b)
{
    return (struct lanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct lanes3 scale(lanes s, struct lanes3 a)
{
    return (struct lanes3){s * a.x, s * a.y, s * a.z};
}

/* Half of the directions to the middles of a cube's faces, edges and corners; the
 * others are their opposites. */
enum { SIDES = 13 };

static inline void along_sides(struct lanes3 n, lanes along[SIDES])
{
    const lanes sum = n.x + n.y, difference = n.x - n.y;
    const lanes of[SIDES] = {
        n.x,       n.y,       n.z,       sum,       difference,       n.x + n.z,       n.x - n.z,
        n.y + n.z, n.y - n.z, sum + n.z, sum - n.z, difference + n.z, difference - n.z};
    for (int i = 0; i < SIDES; i++)
        along[i] = of[i];
}

/* A triangle with its corners in one place, and the sum of its sides' squares. */
static inline struct lanes3 normal_of(const struct lanes3 x[3], lanes *squares)
{
    const struct lanes3 ab = sub(x[1], x[0]), ac = sub(x[2], x[0]), bc = sub(x[2], x[1]);
    *squares = lanes_dot(ab, ab) + lanes_dot(ac, ac) + lanes_dot(bc, bc);
    return lanes_cross(ab, ac);
}

/* How far the normal is at least along each direction, and at most, on the way: it is made of three
 * vectors (contact_tree.h). */
static inline void span_sides(const struct lanes3 from[3], const struct lanes3 to[3], lanes least[SIDES],
                              lanes most[SIDES], lanes *squares)
{
    lanes at_to, ignored, along[3][SIDES];
    const struct lanes3 way[3] = {sub(to[0], from[0]), sub(to[1], from[1]), sub(to[2], from[2])},
                        n0 = normal_of(from, squares), n1 = normal_of(to, &at_to),
                        turn = normal_of(way, &ignored), sum = lanes_sum(lanes_all(1), n0, lanes_all(1), n1);
    *squares = lanes_max(*squares, at_to);
    along_sides(n0, along[0]);
    along_sides(n1, along[1]);
    along_sides(scale(lanes_all(0.5), sub(sum, turn)), along[2]);
    for (int i = 0; i < SIDES; i++) {
        least[i] = lanes_min(lanes_min(along[0][i], along[1][i]), along[2][i]);
        most[i] = lanes_max(lanes_max(along[0][i], along[1][i]), along[2][i]);
    }
}

/*
 * The normal is a x b + b x c + c x a. With the corners off by `stray` each it is off by up to stray times
 * the sides' sum, which is no more than the root of three times their squares' sum, and by twice the area
 * of a triangle in a sphere of that radius: no more than 3 sqrt(3)/2 stray^2. Rounding adds far less than
 * 1e-9 of those squares.
 */
static inline lane_mask four_sides(const struct lanes3 from[3], const struct lanes3 to[3], lanes stray)
{
    static const double length[SIDES] = {1,      1,      1,      1.4143, 1.4143, 1.4143, 1.4143,
                                         1.4143, 1.4143, 1.7321, 1.7321, 1.7321, 1.7321};
    lanes least[SIDES], most[SIDES], squares;
    span_sides(from, to, least, most, &squares);
    const lanes slack = stray * lanes_sqrt(3 * squares) + 2.6 * stray * stray + 1e-9 * squares;
    lane_mask bits = {0};
    for (int i = 0; i < SIDES; i++) {
        const int64_t front = (int64_t)1 << i, back = (int64_t)1 << (i + SIDES);
        bits |= ((least[i] > length[i] * slack) & front) | ((most[i] < -length[i] * slack) & back);
    }
    return bits;
}

static void sides(const struct contact_ways *ways, uint32_t (*triangle_point)[3], const uint32_t *triangles,
                  uint32_t count, uint32_t *sides)
{
    const row *from = (const row *)ways->from, *to = (const row *)ways->to;
    for (uint32_t i = 0; i < count; i += 4) {
        const uint32_t some = count - i < 4 ? count - i : 4;
        struct lanes3 x[3], y[3];
        lanes stray = {0};
        for (int k = 0; k < 3; k++) {
            row at[4], end[4];
            for (uint32_t j = 0; j < 4; j++) {
                const uint32_t p = triangle_point[triangles[i + (j < some ? j : 0)]][k];
                at[j] = from[p];
                end[j] = to[p];
                stray[j] = fmax(stray[j], (double)ways->reach[p]);
            }
            x[k] = lanes_of_rows(at);
            y[k] = lanes_of_rows(end);
        }
        const lane_mask bits = four_sides(x, y, stray);
        for (uint32_t j = 0; j < some; j++)
            sides[triangles[i + j]] = (uint32_t)bits[j];
    }
}

extern const struct contact_kernels SIM_CONTACT;
const struct contact_kernels SIM_CONTACT = {meet, round_places, apart, open, sift, sides};
