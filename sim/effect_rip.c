/* "An artificial rip is introduced after the balloon expands to the point where other rips start to occur.
 * [It] allows the surface to break up into larger pieces" (paper 4.1). The rip cuts the edges that cross a
 * stretch of a great circle around the balloon's centre. */
#include "common/vec3.h"
#include "sim/effects.h"
#include "sim/fracture.h"
#include "sim/let_go.h"

static bool wanted(const struct scene_balloon *balloon)
{
    return balloon->rip.on;
}

/* The mean length of the balloon's active edges over their mean rest length. */
static double mean_stretch(const struct sim *sim, const struct sim_balloon *balloon)
{
    double length = 0, rest = 0;
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++)
        if (sim->edge_active[e]) {
            length += sim_edge_length(sim, e);
            rest += sim->rest_length[e];
        }
    return rest > 0 ? length / rest : 0;
}

/* The mean of the balloon's points: where the cut is centred. */
static void centre_now(const struct sim *sim, const struct sim_balloon *balloon, double centre[3])
{
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (uint32_t p = balloon->point_begin; p < balloon->point_end; p++)
            sum += sim->position[p][i];
        centre[i] = sum / (balloon->point_end - balloon->point_begin);
    }
}

/* Cuts the active edges whose ends lie on two sides of the plane through the centre, spanned by place and
 * direction, and whose middle is within half an arc of place: the angle is the cut's length in mean radii.
 * Returns how many. */
static uint32_t cut(struct sim *sim, const struct sim_balloon *balloon)
{
    const struct scene_rip *rip = &balloon->scene->rip;
    double centre[3], place[3], across[3], along[3];
    uint32_t cuts = 0;
    centre_now(sim, balloon, centre);
    for (int i = 0; i < 3; i++)
        place[i] = rip->place[i];
    vec3_unit(place);
    vec3_cross(place, rip->direction, across);
    vec3_unit(across);
    vec3_cross(across, place, along);
    for (uint32_t e = balloon->edge_begin; e < balloon->edge_end; e++) {
        double a[3], b[3], middle[3];
        vec3_sub(sim->position[sim->edge_point[e][0]], centre, a);
        vec3_sub(sim->position[sim->edge_point[e][1]], centre, b);
        for (int i = 0; i < 3; i++)
            middle[i] = a[i] + b[i];
        bool crosses = (vec3_dot(a, across) < 0) != (vec3_dot(b, across) < 0);
        double angle = atan2(vec3_dot(middle, along), vec3_dot(middle, place));
        if (sim->edge_active[e] && crosses && fabs(angle) <= rip->length / 2) {
            sim_break_edge(sim, e);
            cuts++;
        }
    }
    return cuts;
}

static void apply(struct sim *sim, struct sim_balloon *balloon)
{
    const struct scene_rip *rip = &balloon->scene->rip;
    if (balloon->now->ripped || sim->time < rip->at || mean_stretch(sim, balloon) < rip->stretch)
        return;
    balloon->now->ripped = 1;
    if ((balloon->fracture ? fracture_rip(sim, balloon) : cut(sim, balloon)) == 0)
        sim_tell(sim, balloon, "rip", "has cut nothing: no edge crosses it; give rip.length more");
}

static double due(const struct sim_balloon *balloon)
{
    return balloon->scene->rip.at;
}

const struct effect effect_rip = {.name = "rip",
                                  .phase = EFFECT_AFTER_STEP,
                                  .wanted = wanted,
                                  .apply = apply,
                                  .due = due,
                                  .source = "paper 4.1"};
