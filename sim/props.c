#include "sim/props.h"
#include "common/vec3.h"
#include "sim/effect_string.h"

#include <math.h>
#include <string.h>

enum { CIRCLES = 3, CIRCLE_SIDES = 48 }; /* of a ball: more lines than the 12 of a box */

static const float string_colour[3] = {0.16f, 0.12f, 0.09f}, iron[3] = {0.06f, 0.065f, 0.075f},
                   wall[3] = {0.12f, 0.12f, 0.13f};

struct drawing {
    struct render_line *lines;
    size_t count;
    float thin; /* pixels */
};

static void draw(struct drawing *d, const double from[3], const double to[3], const float colour[3],
                 double width)
{
    struct render_line *line = &d->lines[d->count++];
    *line = (struct render_line){.opacity = 1, .width = (float)fmax(width * (double)d->thin, 0.5)};
    memcpy(line->from, from, sizeof line->from);
    memcpy(line->to, to, sizeof line->to);
    memcpy(line->colour, colour, sizeof line->colour);
}

static const double rod = 0.2; /* how long a weight is, in radii */

/* A weight hangs as a short rod. */
static void draw_string(struct drawing *d, const struct sim *sim, const struct sim_balloon *b)
{
    double skin[3], end[3], foot[3];
    if (!string_ends(sim, b, skin, end))
        return;
    draw(d, skin, end, string_colour, 1);
    memcpy(foot, end, sizeof foot);
    foot[1] -= rod * b->radius;
    if (b->scene->string.weight > 0)
        draw(d, end, foot, iron, 5);
}

/* As long as most of a radius, behind its point; one that stands still points at the first balloon. */
static void draw_needle(struct drawing *d, const struct sim *sim, const struct scene_needles *needle)
{
    const struct sim_balloon *b = sim->balloons;
    double tip[3], back[3];
    if (sim->time < needle->at)
        return;
    for (int i = 0; i < 3; i++) {
        tip[i] = needle->from[i] + needle->velocity[i] * (sim->time - needle->at);
        back[i] = -needle->velocity[i];
    }
    if (vec3_length(back) == 0)
        vec3_sub(tip, b->centre, back);
    const double length = vec3_length(back), scale = length > 0 ? 0.8 * b->radius / length : 0;
    for (int i = 0; i < 3; i++)
        back[i] = tip[i] + scale * back[i];
    draw(d, tip, back, iron, 1.5);
}

/* The edges along each axis, from the four corners where they begin. */
static void draw_box(struct drawing *d, const struct scene_obstacles *box)
{
    for (int axis = 0; axis < 3; axis++)
        for (int corner = 0; corner < 4; corner++) {
            double from[3], to[3];
            for (int i = 0; i < 3; i++) {
                const bool upper = i == (axis + 1) % 3 ? corner & 1 : corner & 2;
                from[i] = to[i] = box->place[i] + (upper ? 0.5 : -0.5) * box->size[i];
            }
            from[axis] = box->place[axis] - 0.5 * box->size[axis];
            to[axis] = box->place[axis] + 0.5 * box->size[axis];
            draw(d, from, to, wall, 1);
        }
}

static void place_on_circle(const struct scene_obstacles *ball, int across, int side, double x[3])
{
    const double angle = 2 * M_PI * side / CIRCLE_SIDES;
    memcpy(x, ball->place, sizeof ball->place);
    x[(across + 1) % 3] += ball->radius * cos(angle);
    x[(across + 2) % 3] += ball->radius * sin(angle);
}

static void draw_ball(struct drawing *d, const struct scene_obstacles *ball)
{
    for (int across = 0; across < CIRCLES; across++)
        for (int side = 0; side < CIRCLE_SIDES; side++) {
            double from[3], to[3];
            place_on_circle(ball, across, side, from);
            place_on_circle(ball, across, side + 1, to);
            draw(d, from, to, wall, 1);
        }
}

double props_foot(const struct sim *sim)
{
    double foot = INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const struct scene_string *string = &b->scene->string;
        const double end = string->to[1] - (string->weight > 0 ? rod : 0);
        if (string->on)
            foot = fmin(foot, b->centre[1] + end * b->radius);
    }
    return foot;
}

size_t props_room(const struct sim *sim)
{
    const struct scene *scene = sim->scene;
    return 2 * sim->balloon_count + scene->needles_count +
           scene->obstacles_count * (size_t)(CIRCLES * CIRCLE_SIDES);
}

size_t props_draw(const struct sim *sim, const struct render_view *view, struct render_line *lines)
{
    const struct scene *scene = sim->scene;
    struct drawing d = {.lines = lines, .thin = (float)fmax(view->height / 300.0, 1)};
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        draw_string(&d, sim, b);
    for (size_t i = 0; i < scene->needles_count; i++)
        draw_needle(&d, sim, &scene->needles[i]);
    for (size_t i = 0; i < scene->obstacles_count; i++)
        if (scene->obstacles[i].shape == SCENE_BOX)
            draw_box(&d, &scene->obstacles[i]);
        else
            draw_ball(&d, &scene->obstacles[i]);
    return d.count;
}
