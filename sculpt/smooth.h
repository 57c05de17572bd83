/* Inside the sculptor: sandpaper and heat. */
#ifndef SCULPT_SMOOTH_H
#define SCULPT_SMOOTH_H

#include "sculpt/sculpt.h"

enum { SMOOTH_BALLS_MAX = 8 };

/* Where to smooth: the cells whose centres lie in one of the balls. */
struct smooth_balls {
    double centre[SMOOTH_BALLS_MAX][3];
    double radius;
    int count;
};

/* Takes away the cells in the balls that stand out (CHIP_SANDPAPER) or are exposed (CHIP_HEAT), as they are
 * before the call. Errors: STATUS_NO_MEMORY, with the tree whole but perhaps smoothed in part. */
enum status smooth(struct octree *tree, enum chip_kind kind, const struct smooth_balls *balls,
                   struct error *err);

#endif
