#include "sim/explain.h"
#include "sim/sim.h"

#include <string.h>

/* What tests/bench/bench_effects measures at 20 thousand triangles on one thread, in % of a step of springs with
 * constant pressure; "none" for what acts once or on single points. */
static const struct {
    const char *name, *needs, *share;
} costs[] = {
    {"spring_by_height", "a factor an edge, once", "none"},
    {"rip", "a look at the mean stretch a step, until it opens", "none"},
    {"pressure_on", "a second pass over the points; no roots", "-9 %"},
    {"gas", "the volume, then a second pass over the points; no roots", "-6 %"},
    {"tube", "two pressures", "none"},
    {"pins", "a byte for each held point", "none"},
    {"string", "a patch of points; six numbers where a weight hangs on it", "none"},
    {"gravity", "a pass over the points", "4 %"},
    {"drag", "a pass over the triangles", "40 %"},
    {"bending", "a pass over the edges; 33 bytes a triangle and more", "105 %"},
    {"membrane", "44 bytes a triangle", "30 %"},
};

static void write_cost(const char *name, FILE *stream)
{
    for (size_t i = 0; i < sizeof costs / sizeof costs[0]; i++)
        if (!strcmp(costs[i].name, name)) {
            fprintf(stream, "\tneeds %s; adds to a step: %s", costs[i].needs, costs[i].share);
            return;
        }
}

static void write_effect(const struct scene *scene, const struct effect *effect, FILE *stream)
{
    size_t wanted = 0;
    for (size_t i = 0; i < scene->balloon_count && effect->wanted; i++)
        wanted += effect->wanted(&scene->balloons[i]);
    const bool on = effect->scene_wanted ? effect->scene_wanted(scene) : wanted > 0;
    fprintf(stream, "%s\t%s\t", on ? "on" : "off", effect->name);
    if (effect->scene_wanted)
        fprintf(stream, on ? "the scene has the block" : "the scene has no such block");
    else if (on)
        fprintf(stream, "%zu of %zu balloons have the block", wanted, scene->balloon_count);
    else
        fprintf(stream, "no balloon has the block");
    if (on)
        fprintf(stream, " (%s)", effect->source);
    if (on)
        write_cost(effect->name, stream);
    fputc('\n', stream);
}

void explain_effects(const struct scene *scene, FILE *stream)
{
    for (const struct effect *const *effect = effects; *effect; effect++)
        write_effect(scene, *effect, stream);
}
