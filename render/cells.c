#include "render/cells.h"

#include "common/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell has about so many triangles: few enough for what they are drawn from to stay near the processor. */
static const double triangles_wanted = 1000;
enum { TRIANGLES_LEAST = 6000 }; /* of all: fewer are near enough as they are */

/* Pixels: software draws tiles of this side, and part of one costs as much as all of it. */
enum { TILE = 64 };

/* Where float and double may differ, and more. */
static const float margin_pixels = 0.5f;

/* The cells that hold what this eye sees of the geometry. */
static void lay_out(struct cells *cells, const struct geometry *g, const struct camera_eye *eye)
{
    int box[4];
    camera_pixels(eye, g->low, g->high, g->nearest, g->farthest, box);
    const double area = (double)box[2] * box[3], count = (double)g->translucent.count;
    const int longer = box[2] > box[3] ? box[2] : box[3];
    const double side = fmax(sqrt(area * triangles_wanted / fmax(count, 1)),
                             (double)longer / CELLS_ACROSS_MAX);
    cells->side = (int)ceil(fmax(side, 1) / TILE) * TILE;
    cells->corner[0] = box[0] - eye->left;
    cells->corner[1] = box[1] - eye->bottom;
    cells->columns = (box[2] + cells->side - 1) / cells->side;
    cells->rows = (box[3] + cells->side - 1) / cells->side;
}

/* As camera_projection() has it. */
static void place_vertices(struct cells *cells, const struct geometry *g, const struct camera_eye *eye)
{
    const int size[2] = {eye->width, eye->height};
    const float offset[2] = {(float)eye->offset, 0}, shear[2] = {(float)eye->shear, 0};
    const float nearest = (float)g->nearest;
    float factor[2], shift[2];
    for (int i = 0; i < 2; i++) {
        const double half = size[i] / 2.0;
        factor[i] = (float)(half / eye->half_width[i] / cells->side);
        shift[i] = (float)((half - cells->corner[i]) / cells->side);
    }
    for (size_t v = 0; v < g->vertices.count; v++) {
        const float *at = g->vertices.items[v].position, distance = -at[2];
        for (int i = 0; i < 2; i++)
            cells->places.items[v][i] =
                distance > nearest ? ((at[i] - offset[i]) / distance - shear[i]) * factor[i] + shift[i] : NAN;
    }
}

static float smallest(float a, float b, float c)
{
    const float least = a < b ? a : b;
    return least < c ? least : c;
}

static struct cells_range range_of(const struct cells *cells, const uint32_t vertex[3])
{
    const int count[2] = {cells->columns, cells->rows};
    const float margin = margin_pixels / (float)cells->side;
    struct cells_range range;
    for (int i = 0; i < 2; i++) {
        const float a = cells->places.items[vertex[0]][i], b = cells->places.items[vertex[1]][i],
                    c = cells->places.items[vertex[2]][i];
        const float from = smallest(a, b, c) - margin, to = -smallest(-a, -b, -c) + margin;
        const bool known = isfinite(a + b + c);
        range.from[i] = known && from > 0 ? (uint8_t)(from < (float)count[i] ? (int)from : count[i]) : 0;
        range.to[i] = (uint8_t)(known && to < (float)count[i] ? (to < 0 ? 0 : (int)to + 1) : count[i]);
    }
    return range;
}

static void count_triangles(struct cells *cells, const struct geometry *g)
{
    memset(cells->begin, 0, sizeof cells->begin);
    for (size_t t = 0; t < g->translucent.count; t++) {
        const struct cells_range r = cells->ranges.items[t] = range_of(cells, g->translucent.items[t].vertex);
        for (int y = r.from[1]; y < r.to[1]; y++)
            for (int x = r.from[0]; x < r.to[0]; x++)
                cells->begin[y * cells->columns + x + 1]++;
    }
    for (int i = 0; i < cells->columns * cells->rows; i++)
        cells->begin[i + 1] += cells->begin[i];
}

static void fill(struct cells *cells, const struct geometry *g)
{
    size_t next[CELLS_ACROSS_MAX * CELLS_ACROSS_MAX];
    memcpy(next, cells->begin, sizeof next);
    for (size_t t = 0; t < g->translucent.count; t++) {
        const struct cells_range r = cells->ranges.items[t];
        for (int y = r.from[1]; y < r.to[1]; y++)
            for (int x = r.from[0]; x < r.to[0]; x++) {
                const size_t at = next[y * cells->columns + x]++;
                memcpy(cells->indices.items + 3 * at, g->translucent.items[t].vertex, 3 * sizeof(uint32_t));
            }
    }
}

bool cells_are_worth_it(const struct geometry *g, const struct render_view *view)
{
    const bool smooth = view->outlines == RENDER_SAMPLED && view->samples <= 1;
    return view->order == RENDER_SORT && !smooth && g->translucent.count >= TRIANGLES_LEAST;
}

enum status cells_build(struct cells *cells, const struct geometry *g, const struct camera_eye *eye,
                        struct error *err)
{
    cells->places.count = cells->ranges.count = cells->indices.count = 0;
    lay_out(cells, g, eye);
    if (!ARRAY_RESERVE(&cells->places, g->vertices.count) ||
        !ARRAY_RESERVE(&cells->ranges, g->translucent.count))
        return error_no_memory(err, "the triangles' cells");
    place_vertices(cells, g, eye);
    count_triangles(cells, g);
    const size_t all = 3 * cells->begin[cells->columns * cells->rows];
    if (!ARRAY_RESERVE(&cells->indices, all))
        return error_no_memory(err, "the triangles' cells");
    fill(cells, g);
    cells->indices.count = all;
    return STATUS_OK;
}

void cells_clear(struct cells *cells)
{
    free(cells->places.items);
    free(cells->ranges.items);
    free(cells->indices.items);
    *cells = (struct cells){0};
}
