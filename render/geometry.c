#include "render/geometry.h"

#include "common/array.h"
#include "common/vec3.h"

#include <stdlib.h>
#include <string.h>

/* Corners further than this (in units of eye to target) are not drawn: a projection's floats end there. */
static const double limit = 1e9;
static const double nearest_drawn = 0.004, farthest_drawn = 1e4;
static const float opaque_from = 0.999f; /* less than half of 1/255 shows through */

/* Mesa's software finds a vertex in its buffer by 32 bits with a sign. */
static const size_t most_vertices = INT32_MAX / sizeof(struct geometry_vertex);
static const uint32_t no_vertex = UINT32_MAX;

/* What building one skin needs to hand around. */
struct building {
    struct geometry *geometry;
    const struct camera_space *space;
    const struct render_skin *skin;
    size_t skin_number;
    uint32_t first_vertex; /* of the points' shared vertices */
    bool shared;           /* points have vertices of their own: smooth normals, no facets */
    bool alike;            /* corners of facets with the same normal have one vertex */
    bool is_latex;
    struct geometry_latex latex;
    double closed; /* 1: nothing of the skin is torn; as latex measures it, or by its triangles */
    uint16_t colour[4];
};

static float clamp(float value, float least, float most)
{
    return value < least ? least : value > most ? most : value;
}

static float stretch_of(const struct render_skin *skin, uint32_t t)
{
    return skin->stretch ? skin->stretch[t] : 1;
}

static float film_of(const struct building *b, uint32_t t)
{
    const struct render_skin *skin = b->skin;
    if (b->is_latex)
        return latex_film(&b->latex, stretch_of(skin, t));
    return skin->opacity ? clamp(skin->opacity[t], 0, 1) : 1;
}

static float gloss_of(const struct building *b, uint32_t t)
{
    const struct render_skin *skin = b->skin;
    if (b->is_latex)
        return latex_roughness(&b->latex, stretch_of(skin, t));
    return skin->shininess ? clamp(skin->shininess[t], 0, 10000) : 0;
}

static bool is_drawn(const struct render_skin *skin, uint32_t t)
{
    return !skin->active || skin->active[t];
}

static enum status check_triangle(const struct building *b, uint32_t t, struct error *err)
{
    const struct render_skin *skin = b->skin;
    const struct mesh *mesh = skin->mesh;
    for (int k = 0; k < 3; k++) {
        uint32_t point = mesh->triangle[t][k];
        if (point >= mesh->point_count)
            return error_set(err, STATUS_RANGE,
                             "skin %zu, triangle %u has the corner %u, but there are %u points",
                             b->skin_number, t, point, mesh->point_count);
        const double *at = mesh->position[point];
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]))
            return error_set(err, STATUS_RANGE, "skin %zu, point %u of triangle %u is at no finite place",
                             b->skin_number, point, t);
    }
    if ((skin->opacity && isnan(skin->opacity[t])) || (skin->shininess && isnan(skin->shininess[t])))
        return error_set(err, STATUS_RANGE,
                         "skin %zu, triangle %u has an opacity or shininess that is no number",
                         b->skin_number, t);
    if (skin->stretch && isnan(skin->stretch[t]))
        return error_set(err, STATUS_RANGE, "skin %zu, triangle %u has a stretch that is no number",
                         b->skin_number, t);
    return STATUS_OK;
}

static enum status check_triangles(const struct building *b, struct error *err)
{
    enum status status = STATUS_OK;
    for (uint32_t t = 0; t < b->skin->mesh->triangle_count && !status; t++)
        if (is_drawn(b->skin, t))
            status = check_triangle(b, t, err);
    return status;
}

/* Averages the triangles' film and gloss at the points: sums[3 p ..] becomes film, gloss and the number of
 * triangles. Latex is thicker at its rims. */
static void average_at_points(const struct building *b)
{
    const struct mesh *mesh = b->skin->mesh;
    float *sums = b->geometry->sums.items;
    memset(sums, 0, 3 * (size_t)mesh->point_count * sizeof *sums);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!is_drawn(b->skin, t))
            continue;
        const float film = film_of(b, t), gloss = gloss_of(b, t);
        for (int k = 0; k < 3; k++) {
            float *sum = sums + 3 * (size_t)mesh->triangle[t][k];
            sum[0] += film;
            sum[1] += gloss;
            sum[2] += 1;
        }
    }
    for (size_t p = 0; p < mesh->point_count; p++) {
        float *sum = sums + 3 * p;
        if (sum[2] > 0) {
            sum[0] /= sum[2];
            sum[1] /= sum[2];
        }
        if (b->is_latex && latex_is_rim(&b->geometry->fans.items[p]))
            sum[0] *= latex_rim;
    }
}

static void set_vertex(const struct building *b, struct geometry_vertex *vertex, uint32_t point,
                       const double normal[3], float film, float gloss)
{
    double at[3], turned[3];
    camera_to_space(b->space, b->skin->mesh->position[point], at);
    camera_turn(b->space, normal, turned);
    for (int i = 0; i < 3; i++) {
        vertex->position[i] = (float)at[i];
        vertex->normal[i] = (float)turned[i];
    }
    vertex->film = film;
    vertex->gloss = gloss;
    memcpy(vertex->colour, b->colour, sizeof b->colour);
}

/* A vertex for each point. Those of points without a triangle are never drawn, whatever they hold. */
static void add_points(struct building *b)
{
    const struct mesh *mesh = b->skin->mesh;
    const float *sums = b->geometry->sums.items;
    for (uint32_t p = 0; p < mesh->point_count; p++)
        set_vertex(b, &b->geometry->vertices.items[b->first_vertex + p], p, mesh->normal[p],
                   sums[3 * (size_t)p], sums[3 * (size_t)p + 1]);
    b->geometry->vertices.count += mesh->point_count;
}

static bool is_direction(const double normal[3])
{
    double square = vec3_dot(normal, normal);
    return square > 1e-12 && square < 1e12;
}

/* Where a skin is torn or folded sharply its points' normals may say nothing of the triangle at hand: more
 * than 70 degrees away they are not taken. */
static bool is_crease(const struct building *b, const double normal[3], const double facet[3])
{
    return b->is_latex && vec3_dot(normal, facet) < 0.34 * vec3_length(normal);
}

/* The vertex of this point that is the same as the one behind the last, which is added where there is none: a
 * list for each point leads from one to the next. */
static uint32_t add_vertex_once(const struct building *b, uint32_t point)
{
    struct geometry *g = b->geometry;
    const struct geometry_vertex *vertices = g->vertices.items;
    uint32_t *link = &g->links.items[point];
    while (*link != no_vertex &&
           memcmp(&vertices[*link], &vertices[g->vertices.count], sizeof *vertices) != 0)
        link = &g->links.items[b->skin->mesh->point_count + (*link - b->first_vertex)];
    if (*link == no_vertex) {
        *link = (uint32_t)g->vertices.count++;
        g->links.items[g->links.count++] = no_vertex;
    }
    return *link;
}

/* The vertex of a triangle's corner: the point's own, or one added for this corner. */
static uint32_t corner_vertex(struct building *b, uint32_t t, int k, const double facet[3])
{
    const struct mesh *mesh = b->skin->mesh;
    uint32_t point = mesh->triangle[t][k];
    bool smooth = mesh->normal && is_direction(mesh->normal[point]) &&
                  !is_crease(b, mesh->normal[point], facet);
    if (b->shared && smooth)
        return b->first_vertex + point;
    const float *mean = b->geometry->sums.items + 3 * (size_t)point;
    bool own = b->skin->facets;
    set_vertex(b, &b->geometry->vertices.items[b->geometry->vertices.count], point,
               smooth ? mesh->normal[point] : facet, own ? film_of(b, t) : mean[0],
               own ? gloss_of(b, t) : mean[1]);
    return b->alike ? add_vertex_once(b, point) : (uint32_t)b->geometry->vertices.count++;
}

/* The normal of the triangle itself; any direction where it has no area. False where it is too far. */
static bool facet_normal(const struct building *b, uint32_t t, double facet[3])
{
    const struct mesh *mesh = b->skin->mesh;
    const uint32_t *p = mesh->triangle[t];
    double at[3][3];
    for (int k = 0; k < 3; k++) {
        camera_to_space(b->space, mesh->position[p[k]], at[k]);
        if (!(fabs(at[k][0]) < limit && fabs(at[k][1]) < limit && fabs(at[k][2]) < limit))
            return false;
    }
    double d[3];
    vec3_triangle(mesh->position[p[0]], mesh->position[p[1]], mesh->position[p[2]], d);
    double length = vec3_length(d);
    for (int i = 0; i < 3; i++)
        facet[i] = length > 0 ? d[i] / length : i == 2;
    return true;
}

/* Widens what is in sight by a corner; one beside or behind the eye may be seen anywhere. */
static void see_corner(struct geometry *g, const float position[3])
{
    double distance = -position[2];
    g->nearest = fmin(g->nearest, distance);
    g->farthest = fmax(g->farthest, distance);
    for (int i = 0; i < 2; i++) {
        double at = position[i] / distance;
        g->low[i] = distance > nearest_drawn ? fmin(g->low[i], at) : -INFINITY;
        g->high[i] = distance > nearest_drawn ? fmax(g->high[i], at) : INFINITY;
    }
}

static void add_triangle(struct building *b, uint32_t t)
{
    struct geometry *g = b->geometry;
    double facet[3];
    if (!facet_normal(b, t, facet))
        return;
    struct order_triangle triangle;
    double corner[3][3];
    bool opaque = true;
    for (int k = 0; k < 3; k++) {
        triangle.vertex[k] = corner_vertex(b, t, k, facet);
        const struct geometry_vertex *vertex = &g->vertices.items[triangle.vertex[k]];
        opaque = opaque && vertex->film >= (b->is_latex ? latex_opaque : opaque_from);
        for (int i = 0; i < 3; i++)
            corner[k][i] = (double)vertex->position[i];
        see_corner(g, vertex->position);
    }
    triangle.nearness = order_nearness(corner, b->closed);
    if (opaque)
        memcpy(&g->indices.items[3 * g->opaque++], triangle.vertex, sizeof triangle.vertex);
    else
        g->translucent.items[g->translucent.count++] = triangle;
}

/* The lists of vertices of the skin's points, all empty. */
static bool begin_lists(struct geometry *g, uint32_t points)
{
    g->links.count = 0;
    if (!ARRAY_RESERVE(&g->links, points))
        return false;
    memset(g->links.items, 0xff, points * sizeof *g->links.items);
    g->links.count = points;
    return true;
}

static enum status add_triangles(struct building *b, struct error *err)
{
    struct geometry *g = b->geometry;
    for (uint32_t t = 0; t < b->skin->mesh->triangle_count; t++) {
        if (!is_drawn(b->skin, t))
            continue;
        if (g->vertices.count + 3 > most_vertices)
            return error_set(err, STATUS_RANGE,
                             "skin %zu: triangles with more than %zu corners cannot be drawn at once",
                             b->skin_number, most_vertices);
        if (!ARRAY_RESERVE(&g->vertices, 3) || (b->alike && !ARRAY_RESERVE(&g->links, 3)))
            return error_no_memory(err, "the triangles to draw");
        add_triangle(b, t);
    }
    return STATUS_OK;
}

static enum status add_skin(struct building *b, struct error *err)
{
    struct geometry *g = b->geometry;
    const struct render_skin *skin = b->skin;
    const struct mesh *mesh = skin->mesh;
    const size_t triangles = mesh->triangle_count, points = mesh->point_count;
    b->shared = mesh->normal && !skin->facets;
    b->alike = skin->facets && !skin->opacity && !skin->shininess && !skin->stretch;
    for (int i = 0; i < 3; i++)
        b->colour[i] = (uint16_t)lrintf(clamp(skin->colour[i], 0, 1) * 65535);
    enum status status = check_triangles(b, err);
    if (status || !triangles)
        return status;
    g->sums.count = g->fans.count = 0;
    g->indices.count = 3 * g->opaque;
    if (!ARRAY_RESERVE(&g->vertices, (b->alike ? 0 : 3 * triangles) + (b->shared ? points : 0)) ||
        !ARRAY_RESERVE(&g->indices, 3 * triangles) || !ARRAY_RESERVE(&g->translucent, triangles) ||
        !ARRAY_RESERVE(&g->sums, 3 * points) || (b->is_latex && !ARRAY_RESERVE(&g->fans, points)) ||
        (b->alike && !begin_lists(g, mesh->point_count)))
        return error_no_memory(err, "the triangles to draw");
    if (b->is_latex)
        latex_measure(&b->latex, skin, g->fans.items);
    b->closed = b->is_latex ? (double)b->latex.closed : order_is_whole(skin);
    b->colour[3] = (uint16_t)lrintf(b->latex.closed * 65535);
    b->first_vertex = (uint32_t)g->vertices.count;
    average_at_points(b);
    if (b->shared)
        add_points(b);
    return add_triangles(b, err);
}

/* Points of what others draw, so that the projection and the box in sight hold it too. */
static void see_points(struct geometry *g, const struct camera_space *space, const double (*points)[3],
                       size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double at[3];
        camera_to_space(space, points[i], at);
        see_corner(g, (const float[3]){(float)at[0], (float)at[1], (float)at[2]});
    }
}

static void add_shadow(struct geometry *g, const struct camera_space *space, double height,
                       const struct render_skin *skin)
{
    struct geometry_shadow *shadow = &g->shadows.items[g->shadows.count];
    if (!geometry_cast_shadow(shadow, space, height, skin))
        return;
    g->shadows.count++;
    for (int k = 0; k < 4; k++) {
        g->nearest = fmin(g->nearest, -shadow->corner[k][2]);
        g->farthest = fmax(g->farthest, -shadow->corner[k][2]);
    }
}

enum status geometry_build(struct geometry *g, const struct render_view *view,
                           const struct render_skin *skins, size_t skin_count, const double (*others)[3],
                           size_t other_count, struct error *err)
{
    struct camera_space space;
    camera_space_of(&view->camera, &space);
    g->vertices.count = g->opaque = g->translucent.count = 0;
    g->nearest = INFINITY;
    g->farthest = 0;
    for (int i = 0; i < 2; i++) {
        g->low[i] = INFINITY;
        g->high[i] = -INFINITY;
    }
    for (size_t i = 0; i < skin_count; i++) {
        struct building b = {.geometry = g,
                             .space = &space,
                             .skin = &skins[i],
                             .skin_number = i,
                             .is_latex = view->style == RENDER_LATEX};
        enum status status = add_skin(&b, err);
        if (status)
            return status;
    }
    see_points(g, &space, others, other_count);
    g->shadows.count = 0;
    if (view->floor && !ARRAY_RESERVE(&g->shadows, skin_count))
        return error_no_memory(err, "the shadows to draw");
    for (size_t i = 0; i < skin_count && view->floor; i++)
        add_shadow(g, &space, view->floor_height, &skins[i]);
    g->farthest = fmin(fmax(g->farthest * 1.01, 2 * nearest_drawn), farthest_drawn);
    g->nearest = fmin(fmax(g->nearest * 0.99, nearest_drawn), g->farthest / 2);
    return order_indices(g, view->order == RENDER_SORT, err);
}

void geometry_clear(struct geometry *g)
{
    free(g->vertices.items);
    free(g->translucent.items);
    free(g->spare.items);
    free(g->indices.items);
    free(g->links.items);
    free(g->sums.items);
    free(g->fans.items);
    free(g->shadows.items);
    *g = (struct geometry){0};
}
