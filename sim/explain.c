#include "sim/explain.h"
#include "sim/sim.h"

#include <math.h>
#include <string.h>

/* Work on one point, edge or triangle: rows (or as many bytes) read and written, operations on four numbers
 * at once, and roots and divisions; with what a step saves by going through memory once (sweep.h), and what a
 * rare pass comes to for each step. */
struct work {
    double rows, operations, roots;
};

/* What they take, a row being 1. tests/bench/bench_effects prints what comes of it
 * beside what it measures. */
static double price(const struct work *work, double count)
{
    return count * (work->rows + 0.5 * work->operations + 2 * work->roots);
}

/* Of a closed skin, for each triangle. */
static const double points = 0.5, edges = 1.5;

/* The paper's step with symplectic Euler (forces.c). */
static const struct work step_point = {10, 4, 2}, step_edge = {9, 12, 2}, step_triangle = {9, 8, 2};

/* What an effect adds for a point, an edge and a triangle; nothing worth counting: it acts
 * once, or on single points. */
static const struct cost {
    const char *name, *needs;
    struct work point, edge, triangle;
} costs[] = {
    {"spring_by_height", "a factor an edge, once", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"rip", "a look at the mean stretch a step, until it opens", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"membrane", "44 bytes a triangle, in place of the springs", {0, 0, 0}, {-9, -12, -2}, {14, 62, 2}},
    {"bending",
     "three passes over triangles and edges, the first with the normals; 166 bytes a triangle",
     {0, 0, 0},
     {8, 22, 1},
     {8, 16, 0}},
    {"viscosity",
     "a length an edge, which is integrated: 24 bytes an edge, and more for most methods",
     {0, 0, 0},
     {3, 4, 0},
     {0, 0, 0}},
    {"plasticity", "a length an edge; a look at each while any slips", {0, 0, 0}, {0, 2, 0}, {0, 0, 0}},
    {"pressure_on", "a second pass over the points; no roots", {4, 4, -1}, {0, 0, 0}, {0, -1, -2}},
    {"gas",
     "the volume, then a second pass over the points, no roots; up to 25 bytes a triangle to find holes",
     {6, 6, -1},
     {0, 0, 0},
     {0, -1, -2}},
    {"tube", "two pressures", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"needles",
     "where points were; a look at all triangles while it is near",
     {4, 0, 0},
     {0, 0, 0},
     {0, 0, 0}},
    {"ground", "where points were; a look at those that are near", {4, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"obstacles", "where points were; a look at those that are near", {4, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"contact",
     "1150 bytes a triangle, and where points were; while nothing is near anything a look at each point, and now and then at all "
     "triangles (folded skin takes many times that)",
     {4, 4, 0},
     {0, 0, 0},
     {0, 0, 0}},
    {"gravity", "a pass over the points", {5, 4, 0}, {0, 0, 0}, {0, 0, 0}},
    {"drag", "the points' speeds, and more work on each triangle", {0, 0, 0}, {0, 0, 0}, {6, 6, 0}},
    {"string", "a patch of points; six numbers where a weight hangs on it", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"pins", "the place of each held point", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    {"fracture",
     "a row a triangle and room for cracks; a look at each triangle, and work where one comes near its strength; "
     "new points come to their places when it rests",
     {0, 0, 0},
     {0, 0, 0},
     {1, 2, 0}},
};

/* What a law of rubber takes of a triangle beyond the neo-Hookean one; Ogden's each of its rows. */
static const struct work laws[] = {[SCENE_NEO_HOOKEAN] = {0, 0, 0},
                                   [SCENE_MOONEY_RIVLIN] = {0, 4, 0},
                                   [SCENE_GENT] = {0, 12, 2},
                                   [SCENE_OGDEN] = {0, 12, 6}};

static double price_of_law(const struct scene_balloon *balloon)
{
    const struct scene_membrane *m = &balloon->membrane;
    const double rows = m->law == SCENE_OGDEN ? (double)m->ogden.count : 1;
    return m->on ? rows * price(&laws[m->law], 1) : 0;
}

static const struct cost *cost_of(const struct effect *effect)
{
    for (size_t i = 0; i < sizeof costs / sizeof costs[0]; i++)
        if (!strcmp(costs[i].name, effect->name))
            return &costs[i];
    return NULL;
}

/* How many of the balloons call for it. */
static size_t count_wanted(const struct effect *effect, const struct scene *scene)
{
    size_t wanted = 0;
    for (size_t i = 0; i < scene->balloon_count && effect->wanted; i++)
        wanted += effect->wanted(&scene->balloons[i]);
    return wanted;
}

double explain_share(const struct effect *effect, const struct scene *scene)
{
    const struct cost *cost = cost_of(effect);
    const double step = price(&step_point, points) + price(&step_edge, edges) + price(&step_triangle, 1);
    const double part = effect->scene_wanted
                            ? effect->scene_wanted(scene)
                            : (double)count_wanted(effect, scene) / (double)scene->balloon_count;
    double law = 0;
    if (!cost)
        return 0;
    for (size_t i = 0; i < scene->balloon_count && !strcmp(effect->name, "membrane"); i++)
        law += price_of_law(&scene->balloons[i]) / (double)scene->balloon_count;
    return (law +
            part * (price(&cost->point, points) + price(&cost->edge, edges) + price(&cost->triangle, 1))) /
           step;
}

static void write_cost(const struct effect *effect, const struct scene *scene, FILE *stream)
{
    const struct cost *cost = cost_of(effect);
    const double share = explain_share(effect, scene);
    if (!cost)
        return;
    fprintf(stream, "\tneeds %s; adds to a step: ", cost->needs);
    if (fabs(share) < 0.005)
        fputs("none", stream);
    else if (share < 0)
        fprintf(stream, "none; it takes %.0f %% off, in place of the paper's pressure", -100 * share);
    else
        fprintf(stream, "%.0f %%", 100 * share);
}

static void write_effect(const struct scene *scene, const struct effect *effect, FILE *stream)
{
    const size_t wanted = count_wanted(effect, scene);
    const bool on = effect_is_wanted(effect, scene);
    fprintf(stream, "%s\t%s\t", on ? "on" : "off", effect->name);
    if (effect->scene_wanted)
        fprintf(stream, on ? "the scene has the block" : "the scene has no such block");
    else if (on)
        fprintf(stream, "%zu of %zu balloons call for it", wanted, scene->balloon_count);
    else
        fprintf(stream, "no balloon calls for it");
    if (on)
        fprintf(stream, " (%s)", effect->source);
    if (on)
        write_cost(effect, scene, stream);
    fputc('\n', stream);
}

void explain_effects(const struct scene *scene, FILE *stream)
{
    for (const struct effect *const *effect = effects; *effect; effect++)
        write_effect(scene, *effect, stream);
}
