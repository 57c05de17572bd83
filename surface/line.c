/* The field along the edges of the grid. */
#include "surface/block.h"

#include "common/array.h"

#include <stdlib.h>
#include <string.h>

/* The cells of a block that a profile has sums for, along one axis. */
struct band {
    int first, end;
};

static struct band band_of(const struct block *block, const struct profile *profile, int axis)
{
    int first = block->low[axis], end = first + block->size[axis];
    return (struct band){profile->first > first ? profile->first : first,
                         profile->last < end ? profile->last : end};
}

static double step(const double *sum, const struct profile *profile, int cell)
{
    return sum[cell - profile->first + 1] - sum[cell - profile->first];
}

/* Along z: rows are added up along y. */
static void sum_along_z(const struct block *block, const int at[3], int layer, double *out)
{
    const struct profile *y = &block->profile[1][at[1]];
    enum field_track track = block->grid->field->layer[layer].track[1];
    struct band band = band_of(block, y, 1);
    size_t size = (size_t)block->size[2], width = (size_t)block->size[1], slopes = block->rows;
    for (int j = band.first; j < band.end; j++) {
        double share = step(y->sum[track], y, j), slope = step(y->slope[track], y, j);
        size_t first = (size_t)layer * size * width + (size_t)(j - block->low[1]);
        const double *row = block->row + (size_t)at[0] * 2 * slopes + first;
        for (size_t k = 0; k < size; k++, row += width) {
            out[k] += share * *row;
            out[size + k] += share * row[slopes];
            out[2 * size + k] += slope * *row;
        }
    }
}

/* Along y: rows are added up along z. */
static void sum_along_y(const struct block *block, const int at[3], int layer, double *out)
{
    const struct profile *z = &block->profile[2][at[2]];
    enum field_track track = block->grid->field->layer[layer].track[2];
    struct band band = band_of(block, z, 2);
    size_t size = (size_t)block->size[1], slopes = block->rows;
    for (int k = band.first; k < band.end; k++) {
        double share = step(z->sum[track], z, k), slope = step(z->slope[track], z, k);
        size_t first = (size_t)(layer * block->size[2] + k - block->low[2]) * size;
        const double *row = block->row + (size_t)at[0] * 2 * slopes + first;
        for (size_t j = 0; j < size; j++) {
            out[j] += share * row[j];
            out[size + j] += slope * row[j];
            out[2 * size + j] += share * row[slopes + j];
        }
    }
}

/* Adds a row's runs, times a share and its slope, as what changes at their ends. */
static void add_row(const struct block *block, size_t row, double share, double slope, double *sum,
                    double *slopes)
{
    const struct window *w = &block->window;
    int size = block->size[0];
    for (uint32_t i = w->start[row]; i < w->start[row + 1]; i++) {
        const struct window_run *run = &w->run[i];
        int begin = run->begin - block->low[0], end = run->end - block->low[0];
        begin = begin < 0 ? 0 : begin;
        if (begin >= size || end <= 0)
            continue;
        sum[begin] += share * run->weight;
        slopes[begin] += slope * run->weight;
        if (end < size) {
            sum[end] -= share * run->weight;
            slopes[end] -= slope * run->weight;
        }
    }
}

/* Whole rows added up along z at one place of it: as changes from cell to cell along x first. All edges along
 * x at that place share this. */
static void fill_beam(struct block *block, int place, double *sum, double *slopes)
{
    const struct profile *z = &block->profile[2][place];
    struct band band = band_of(block, z, 2);
    size_t size = (size_t)block->size[0], beam = block_beam(block), first = 0;
    memset(sum, 0, 2 * beam * sizeof *sum);
    for (int layer = 0; layer < block->grid->field->layers; layer++, first += size * (size_t)block->size[1]) {
        enum field_track track = block->grid->field->layer[layer].track[2];
        for (int k = band.first; k < band.end; k++) {
            double share = step(z->sum[track], z, k), slope = step(z->slope[track], z, k);
            size_t row = window_row(&block->window, layer, block->low[1], k);
            for (size_t j = 0; j < (size_t)block->size[1]; j++)
                add_row(block, row + j, share, slope, sum + first + j * size, slopes + first + j * size);
        }
    }
    for (size_t i = 1; i < beam; i++)
        if (i % size) {
            sum[i] += sum[i - 1];
            slopes[i] += slopes[i - 1];
        }
    block->beams |= 1u << place;
}

/* Along x: beams are added up along y. */
static void sum_along_x(struct block *block, const int at[3], int layer, double *out)
{
    const struct profile *y = &block->profile[1][at[1]];
    enum field_track track = block->grid->field->layer[layer].track[1];
    struct band band = band_of(block, y, 1);
    size_t size = (size_t)block->size[0], beam = block_beam(block);
    double *sum = block->beam + (size_t)at[2] * 2 * beam;
    if (!(block->beams >> at[2] & 1))
        fill_beam(block, at[2], sum, sum + beam);
    for (int j = band.first; j < band.end; j++) {
        double share = step(y->sum[track], y, j), slope = step(y->slope[track], y, j);
        const double *row = sum + ((size_t)(layer * block->size[1] + j - block->low[1])) * size;
        for (size_t i = 0; i < size; i++) {
            out[i] += share * row[i];
            out[size + i] += slope * row[i];
            out[2 * size + i] += share * row[beam + i];
        }
    }
}

struct line block_line(struct block *block, int axis, const int at[3])
{
    struct line line = {block, axis, block->size[axis], block->line};
    int layers = block->grid->field->layers;
    memset(line.sum, 0, (size_t)(layers * 3 * line.size) * sizeof *line.sum);
    for (int layer = 0; layer < layers; layer++) {
        double *out = line.sum + layer * 3 * line.size;
        if (axis == 0)
            sum_along_x(block, at, layer, out);
        else if (axis == 1)
            sum_along_y(block, at, layer, out);
        else
            sum_along_z(block, at, layer, out);
    }
    return line;
}

static double derivative(const struct line *line, const struct profile *profile)
{
    const struct block *block = line->block;
    struct band band = band_of(block, profile, line->axis);
    double slope = 0;
    for (int layer = 0; layer < block->grid->field->layers; layer++) {
        enum field_track track = block->grid->field->layer[layer].track[line->axis];
        const double *sum = line->sum + layer * 3 * line->size;
        for (int i = band.first; i < band.end; i++)
            slope += sum[i - block->low[line->axis]] * step(profile->slope[track], profile, i);
    }
    return slope;
}

double line_value(const struct line *line, double x, double *slope)
{
    const struct block *block = line->block;
    struct profile *profile = &line->block->profiles.axis[line->axis];
    profile_fill(block->grid->field, x, profile);
    struct band band = band_of(block, profile, line->axis);
    double value = 0;
    *slope = 0;
    for (int layer = 0; layer < block->grid->field->layers; layer++) {
        enum field_track track = block->grid->field->layer[layer].track[line->axis];
        const double *sum = line->sum + layer * 3 * line->size;
        for (int i = band.first; i < band.end; i++) {
            value += sum[i - block->low[line->axis]] * step(profile->sum[track], profile, i);
            *slope += sum[i - block->low[line->axis]] * step(profile->slope[track], profile, i);
        }
    }
    return value;
}

void line_gradient(const struct line *line, double slope, double gradient[3])
{
    const struct block *block = line->block;
    const struct profile *profile = &block->profiles.axis[line->axis];
    struct band band = band_of(block, profile, line->axis);
    double across[2] = {0, 0};
    for (int layer = 0; layer < block->grid->field->layers; layer++) {
        enum field_track track = block->grid->field->layer[layer].track[line->axis];
        const double *sum = line->sum + (layer * 3 + 1) * line->size;
        for (int i = band.first; i < band.end; i++) {
            double share = step(profile->sum[track], profile, i);
            across[0] += sum[i - block->low[line->axis]] * share;
            across[1] += sum[line->size + i - block->low[line->axis]] * share;
        }
    }
    gradient[line->axis] = slope;
    gradient[(line->axis + 1) % 3] = across[0];
    gradient[(line->axis + 2) % 3] = across[1];
}

void line_slopes(const struct line *line, const int at[3], double slope[2])
{
    for (int end = 0; end < 2; end++)
        slope[end] = derivative(line, &line->block->profile[line->axis][at[line->axis] + end]);
}
