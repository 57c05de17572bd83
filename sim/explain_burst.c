/* Whether a balloon can burst by itself, as an estimate: it swells as a whole and nothing is lost on the way,
 * so that its pressure brings it to the stretch at which it bursts if nowhere before that the skin holds more
 * than the pressure has given. */
#include "common/scene_fields.h"
#include "common/vec3.h"
#include "sim/explain.h"
#include "sim/fracture.h"
#include "sim/ledger.h"

#include <math.h>
#include <string.h>

/* Of the whole skin when all is stretched alike. */
static double energy_at(struct sim *sim, const struct sim_balloon *b, double stretch, double now)
{
    for (uint32_t p = b->point_begin; p < b->point_end; p++)
        for (int i = 0; i < 3; i++)
            sim->position[p][i] = b->centre[i] + (sim->position[p][i] - b->centre[i]) * (stretch / now);
    return b->membrane ? membrane_elastic(sim, b) : ledger_elastic(sim, b->edge_begin, b->edge_end);
}

/* Whole skin tears, or one edge in a hundred lets go: single ones may be longer than all others,
 * and do not open the skin. */
static bool bursts_at(const struct sim *sim, const struct sim_balloon *b, double stretch)
{
    if (b->fracture)
        return fracture_equal_energy(stretch) >=
               (1 - b->scene->fracture.weakness) * b->fracture->whole_energy;
    uint32_t overlong = 0;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++)
        overlong += stretch * sim->rest_length[e] >= sim_threshold(sim, b, e);
    return overlong > (b->edge_end - b->edge_begin) / 100;
}

/* The work of a unit of pressure from rest to the stretch, with the volume at rest. */
static double work_at(const struct sim_balloon *b, double stretch, double volume)
{
    return b->by_area ? volume * (pow(stretch, 3) - 1)
                      : (double)(b->point_end - b->point_begin) * b->radius * (stretch - 1);
}

/* The filling whose work, pa V0 (N ln L^3 - L^3 + 1) at constant temperature, is the skin's energy; of a
 * pump, which is slow, that in balance: (1 + p/pa) L^3. */
static double filling_at(const struct sim_balloon *b, double stretch, double volume, double energy,
                         double pressure)
{
    const double ambient = b->scene->gas.ambient, swollen = pow(stretch, 3);
    if (b->scene->gas.pump > 0)
        return (1 + pressure / ambient) * swollen;
    return (energy + ambient * volume * (swollen - 1)) / (ambient * volume * 3 * log(stretch));
}

/* The least pressure, or filling, that will do; *stretch becomes that at which it bursts. */
static double needed(struct sim *sim, const struct sim_balloon *b, double *stretch)
{
    enum { LADDER_MAX = 2000 };
    const double volume = 4 * M_PI / 3 * pow(b->radius, 3);
    double most = 0, held = energy_at(sim, b, 1, 1), before = 1;
    for (int i = 1; i <= LADDER_MAX; i++) {
        *stretch = before * 1.005;
        const double energy = energy_at(sim, b, *stretch, before),
                     pressure = (energy - held) / (volume * (pow(*stretch, 3) - pow(before, 3)));
        most = fmax(most, b->gas ? filling_at(b, *stretch, volume, energy, pressure)
                                 : energy / work_at(b, *stretch, volume));
        if (bursts_at(sim, b, *stretch))
            return most;
        held = energy;
        before = *stretch;
    }
    return INFINITY;
}

/* Gives *value what an entry of the schedule makes of that key of the balloon. */
static void follow(const struct sim *sim, const struct sim_balloon *b, const struct scene_schedule *entry,
                   const char *key, double *value)
{
    for (size_t k = 0; k < entry->change_count; k++)
        if ((entry->balloon < 0 || sim->balloons + entry->balloon == b) &&
            !strcmp(entry->change[k].field->key, key))
            *value = entry->change[k].value;
}

static double largest_pressure(const struct sim *sim, const struct sim_balloon *b)
{
    const struct scene *scene = sim->scene;
    double pressure = b->scene->pressure, most = pressure;
    for (size_t i = 0; i < scene->schedule_count && scene->schedule[i].at < scene->time.end; i++) {
        follow(sim, b, &scene->schedule[i], "pressure", &pressure);
        most = fmax(most, pressure);
    }
    return most;
}

/* The pump has so long as the run goes on and no neck is open. */
static double largest_filling(const struct sim *sim, const struct sim_balloon *b)
{
    const struct scene *scene = sim->scene;
    const struct scene_gas *gas = &b->scene->gas;
    const double end = gas->neck > 0 ? fmin(scene->time.end, gas->neck_at) : scene->time.end;
    double fill = gas->fill, most = fill, pump = gas->pump, until = gas->pump_until, time = 0;
    for (size_t i = 0; i <= scene->schedule_count; i++) {
        const struct scene_schedule *entry = i < scene->schedule_count ? &scene->schedule[i] : NULL;
        const double next = entry ? fmin(entry->at, end) : end, brought = fill + pump * (next - time);
        fill = pump > 0 ? fmax(fill, fmin(brought, until)) : fmax(brought, fmin(fill, 1));
        most = fmax(most, fill);
        time = next;
        if (entry) {
            follow(sim, b, entry, "pump", &pump);
            follow(sim, b, entry, "pump_until", &until);
        }
    }
    return most;
}

/* Whether it encloses much less than a ball of as much skin would, 36 pi V^2 < A^3: then it does not swell
 * evenly, since the flatter a place is the more the same pressure stretches it. */
static bool is_uneven(const struct sim *sim, const struct sim_balloon *b)
{
    static const double round_enough = 0.8;
    double volume = 0, area = 0;
    for (uint32_t t = b->triangle_begin; t < b->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t];
        double corner[3], normal[3]; /* twice the area long */
        vec3_triangle(sim->position[p[0]], sim->position[p[1]], sim->position[p[2]], normal);
        vec3_sub(sim->position[p[0]], b->centre, corner);
        volume += vec3_dot(corner, normal) / 6;
        area += vec3_length(normal) / 2;
    }
    return 36 * M_PI * volume * volume < round_enough * pow(area, 3);
}

void explain_bursts(struct sim *sim, FILE *stream)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const char *what = b->gas ? "gas filling" : "pressure";
        double stretch = 1;
        const bool uneven = is_uneven(sim, b);
        const double need = needed(sim, b, &stretch),
                     most = b->gas ? largest_filling(sim, b) : largest_pressure(sim, b);
        fprintf(stream, "%s\tburst\tballoons[%zu]: ", most >= need ? "on" : "off",
                (size_t)(b - sim->balloons));
        if (isinf(need))
            fprintf(stream, "no %s bursts it: its skin bears any stretch\n", what);
        else if (most >= need)
            fprintf(stream, "%s %g may burst it by itself, as from about %.3g on", what, most, need);
        else
            fprintf(stream, "%s %g is too low to burst it by itself; it takes about %.3g or more", what, most,
                    need);
        if (!isinf(need))
            fprintf(stream, " (an estimate: it swells evenly to a stretch of %.3g, and nothing is lost%s)\n",
                    stretch, uneven ? "; this shape swells unevenly, and may tear long before" : "");
    }
}
