#include "sculpt/normals.h"

#include "sculpt/rows.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum { SPAN = 2 * NORMALS_REACH + 1 };

/* Of a row of SPAN cells, by its bits: the sum of the weights of those that are full, and
 * of weight times place. */
struct row_sums {
    float weight, moment;
};

static struct row_sums sums[1 << SPAN];
static float weights[SPAN]; /* exp(-(d / 1.5)^2 / 2): three deviations reach a little beyond the last cell */
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void make_tables(void)
{
    for (int i = 0; i < SPAN; i++) {
        const double d = (i - NORMALS_REACH) / 1.5;
        weights[i] = (float)exp(-d * d / 2);
    }
    for (int bits = 0; bits < 1 << SPAN; bits++)
        for (int i = 0; i < SPAN; i++)
            if (bits >> i & 1) {
                sums[bits].weight += weights[i];
                sums[bits].moment += weights[i] * (float)(i - NORMALS_REACH);
            }
}

static bool mark_leaf(void *context, const struct octree_leaf *leaf)
{
    struct brick_normals *normals = context;
    rows_mark(&normals->row[0][0], NORMALS_ROWS, normals->first, leaf);
    return true;
}

void brick_normals_begin(struct brick_normals *normals, const struct octree *tree, const int brick[3])
{
    int last[3];
    pthread_once(&once, make_tables);
    memset(normals->row, 0, sizeof normals->row);
    for (int i = 0; i < 3; i++) {
        normals->first[i] = brick[i] * BRICK_SIDE - NORMALS_REACH;
        last[i] = normals->first[i] + NORMALS_ROWS - 1;
    }
    octree_visit(tree, normals->first, last, mark_leaf, normals);
}

void brick_normal(const struct brick_normals *normals, const int cell[3], int side, int8_t normal[3])
{
    float out[3] = {0}; /* minus the gradient */
    const int x = cell[0] - normals->first[0] - NORMALS_REACH;
    const int y = cell[1] - normals->first[1] - NORMALS_REACH,
              z = cell[2] - normals->first[2] - NORMALS_REACH;
    for (int k = 0; k < SPAN; k++)
        for (int j = 0; j < SPAN; j++) {
            const struct row_sums *row = &sums[normals->row[z + k][y + j] >> x & ((1 << SPAN) - 1)];
            const float weight = weights[j] * weights[k];
            out[0] -= weight * row->moment;
            out[1] -= weight * row->weight * (float)(j - NORMALS_REACH);
            out[2] -= weight * row->weight * (float)(k - NORMALS_REACH);
        }
    float *ahead = &out[side / 2];
    *ahead = side & 1 ? fmaxf(*ahead, 0) : fminf(*ahead, 0);
    const float longest = fmaxf(fabsf(out[0]), fmaxf(fabsf(out[1]), fabsf(out[2])));
    for (int i = 0; i < 3; i++)
        if (longest > 0.5f)
            normal[i] = (int8_t)lrintf(100 * out[i] / longest);
        else
            normal[i] = (int8_t)(i != side / 2 ? 0 : side & 1 ? 100 : -100);
}
