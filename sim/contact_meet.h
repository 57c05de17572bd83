/* Which boxes meet, for contact_kernels.c: eight numbers at once. */
#ifndef SIM_CONTACT_MEET_H
#define SIM_CONTACT_MEET_H

#include "sim/contact_kernels.h"
#include "sim/lanes.h"
#include "sim/lanes8.h"

/* A box by its two ends, the low and the high corner of each side by side; wherever one is stored. */
struct meet_box {
    lanes8 at[2];
};
typedef float meet_stored
    __attribute__((vector_size(8 * sizeof(float)), aligned(4 * sizeof(float)), may_alias));

INLINE struct meet_box meet_load(const struct contact_box *box)
{
    const meet_stored *at = (const meet_stored *)box->at;
    return (struct meet_box){{(lanes8)at[0], (lanes8)at[1]}};
}

INLINE void meet_store(const struct meet_box *box, struct contact_box *to)
{
    ((meet_stored *)to->at)[0] = (meet_stored)box->at[0];
    ((meet_stored *)to->at)[1] = (meet_stored)box->at[1];
}

/* With its corners changed round, so that sums with another box are of a low one and a high one each. */
INLINE struct meet_box meet_turn(const struct contact_box *box)
{
    const struct meet_box b = meet_load(box);
    return (struct meet_box){{__builtin_shufflevector(b.at[0], b.at[0], 4, 5, 6, 7, 0, 1, 2, 3),
                              __builtin_shufflevector(b.at[1], b.at[1], 4, 5, 6, 7, 0, 1, 2, 3)}};
}

/* contact_boxes_meet(), of a turned one and another: no sum is negative at both ends. */
INLINE bool meet_is(const struct meet_box *turned, const struct meet_box *box)
{
    const lanes8_mask apart = (lanes8_mask)(turned->at[0] + box->at[0]) &
                              (lanes8_mask)(turned->at[1] + box->at[1]);
    return lanes8_bits(apart < 0) == 0;
}

/* The box of a feature: both corners of each end are the larger ones of its points'. */
INLINE struct meet_box meet_join(const struct contact_box *point, const uint32_t *p, int corners)
{
    struct meet_box box = meet_load(&point[p[0]]);
    for (int k = 1; k < corners; k++) {
        const struct meet_box other = meet_load(&point[p[k]]);
        box.at[0] = lanes8_max(box.at[0], other.at[0]);
        box.at[1] = lanes8_max(box.at[1], other.at[1]);
    }
    return box;
}

INLINE void meet_gather(const struct contact_box *point, const struct contact_features *f, int corners,
                        const struct contact_box *other, struct contact_group *group)
{
    const struct meet_box turned = meet_turn(other);
    uint32_t count = 0;
    for (uint32_t i = 0; i < f->count; i++) {
        const uint32_t number = f->number[i];
        const uint32_t *p = corners == 1 ? &f->number[i] : f->corner + (size_t)corners * number;
        const struct meet_box box = meet_join(point, p, corners);
        meet_store(&box, &group->box[count]);
        group->number[count] = number;
        count += meet_is(&turned, &box) && (!f->active || f->active[number]);
    }
    group->count = count;
    for (const struct contact_box none = contact_box_empty(); count % 8 != 0; count++)
        group->box[count] = none;
}

static void gather(const struct contact_box *point, const struct contact_features *features,
                   const struct contact_box *other, struct contact_group *group)
{
    if (features->corners == 1)
        meet_gather(point, features, 1, other, group);
    else if (features->corners == 2)
        meet_gather(point, features, 2, other, group);
    else
        meet_gather(point, features, 3, other, group);
}

/* Eight boxes of a group, turned so that each number of theirs is in one vector. */
struct meet_eight {
    struct lanes8_vec low[2], high[2];
};

INLINE struct meet_eight meet_eight(const struct contact_box *box)
{
    struct meet_eight eight;
    for (int e = 0; e < 2; e++) {
        lanes8 rows[8];
        for (int i = 0; i < 8; i++)
            rows[i] = meet_load(&box[i]).at[e];
        lanes8_turn(rows, &eight.low[e], &eight.high[e]);
    }
    return eight;
}

/* Along one axis: negative where a box is apart from one at both ends, on the same side. */
INLINE lanes8_mask meet_apart(const struct contact_box *box, int axis, const lanes8 low[2],
                              const lanes8 high[2])
{
    lanes8_mask above = lanes8_true(), below = lanes8_true();
    for (int e = 0; e < 2; e++) {
        above &= (lanes8_mask)(lanes8_all(box->at[e].low[axis]) + high[e]);
        below &= (lanes8_mask)(lanes8_all(box->at[e].high[axis]) + low[e]);
    }
    return above | below;
}

/* A bit for each of the eight that meets the box. */
INLINE unsigned meet_bits(const struct contact_box *box, const struct meet_eight *eight)
{
    const struct lanes8_vec *low = eight->low, *high = eight->high;
    const lanes8_mask apart =
        meet_apart(box, 0, (lanes8[]){low[0].x, low[1].x}, (lanes8[]){high[0].x, high[1].x}) |
        meet_apart(box, 1, (lanes8[]){low[0].y, low[1].y}, (lanes8[]){high[0].y, high[1].y}) |
        meet_apart(box, 2, (lanes8[]){low[0].z, low[1].z}, (lanes8[]){high[0].z, high[1].z});
    return 0xff & ~lanes8_bits(apart < 0);
}

static uint32_t meet(const struct contact_group *a, const struct contact_group *b, uint32_t (*couples)[2])
{
    uint32_t count = 0;
    for (uint32_t j = 0; j < b->count; j += 8) {
        const struct meet_eight eight = meet_eight(&b->box[j]);
        for (uint32_t i = 0; i < a->count; i++)
            for (unsigned bits = meet_bits(&a->box[i], &eight); bits; bits &= bits - 1) {
                couples[count][0] = a->number[i];
                couples[count++][1] = b->number[j + (uint32_t)__builtin_ctz(bits)];
            }
    }
    return count;
}

#endif
