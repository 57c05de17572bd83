/* Where the brush is, and what it looks like. */
#include "sculpt/session.h"

#include "common/vec3.h"

#include <string.h>

const char *const session_tool_names[TOOLS] = {
    [TOOL_SPHERE] = "sphere", [TOOL_BOX] = "box", [TOOL_CYLINDER] = "cylinder",
    [TOOL_STROKE] = "stroke", [TOOL_CUT] = "cut", [TOOL_SANDPAPER] = "sandpaper",
    [TOOL_HEAT] = "heat",
};

static void along(const struct session_ray *ray, double distance, double place[3])
{
    for (int i = 0; i < 3; i++)
        place[i] = ray->origin[i] + distance * ray->direction[i];
}

static void snap(const struct session *session, double place[3])
{
    const double side = 1 << session->tree.depth;
    for (int i = 0; i < 3; i++)
        place[i] = (floor(place[i] * side) + 0.5) / side;
}

/* Under the point that is hit, and out of the face there. Snapped, it begins from the middle of the cell that
 * is hit or, to fill, of the one before it: on the face between them rounding would choose. */
static void place_brush(struct session *session)
{
    const double half_cell = 0.5 / (1 << session->tree.depth);
    double sunk = session->depth * session->radius;
    if (session->snap)
        sunk += session->fill ? -half_cell : half_cell;
    along(&session->ray, session->hit.distance, session->middle);
    for (int i = 0; i < 3; i++) {
        session->normal[i] = session->hit.outward ? (i == session->hit.axis) * session->hit.outward
                                                  : -session->ray.direction[i];
        session->middle[i] -= sunk * session->normal[i];
    }
    if (session->snap)
        snap(session, session->middle);
}

/* A stroke keeps to the plane through its beginning that faces the eye: it sweeps, and
 * does not dig itself in. */
static void move_stroke(struct session *session)
{
    double to_plane[3];
    vec3_sub(session->last, session->ray.origin, to_plane);
    const double across = vec3_dot(session->ray.direction, session->pressed.direction);
    const double distance = vec3_dot(to_plane, session->pressed.direction);
    if (across > 0.01 && distance > 0)
        along(&session->ray, distance / across, session->middle);
    if (session->snap)
        snap(session, session->middle);
}

void session_aim(struct session *session, const double origin[3], const double direction[3])
{
    memcpy(session->ray.origin, origin, sizeof session->ray.origin);
    memcpy(session->ray.direction, direction, sizeof session->ray.direction);
    if (session->dragging && session->tool == TOOL_STROKE) {
        move_stroke(session);
        return;
    }
    session->aimed = octree_ray(&session->tree, origin, direction, &session->hit);
    if (session->aimed)
        place_brush(session);
}

void session_aim_nowhere(struct session *session)
{
    session->aimed = false;
}

static double between(double value, double least, double most)
{
    return fmin(fmax(value, least), most);
}

void session_resize_brush(struct session *session, int steps)
{
    const double cell = 1.0 / (1 << session->tree.depth);
    session->radius = between(session->radius * pow(1.1, steps), cell / 2, 0.5);
    if (session->aimed && !session->dragging)
        place_brush(session);
}

void session_sink_brush(struct session *session, int steps)
{
    session->depth = between(session->depth + 0.1 * steps, -1, 1);
    if (session->aimed && !session->dragging)
        place_brush(session);
}

struct outline {
    double (*segments)[2][3];
    size_t count, most;
    unsigned images; /* mirror: bit k turns axis k */
};

static void add_segment(struct outline *outline, const double from[3], const double to[3])
{
    if (outline->count == outline->most)
        return;
    double(*segment)[3] = outline->segments[outline->count++];
    for (int i = 0; i < 3; i++) {
        const bool turned = outline->images >> i & 1;
        segment[0][i] = turned ? 1 - from[i] : from[i];
        segment[1][i] = turned ? 1 - to[i] : to[i];
    }
}

/* A circle around `middle`, square to an axis. */
static void add_circle(struct outline *outline, const double middle[3], int axis, double radius)
{
    enum { SIDES = 32 };
    double last[3];
    for (int k = 0; k <= SIDES; k++) {
        const double angle = 2 * M_PI * k / SIDES;
        double place[3] = {middle[0], middle[1], middle[2]};
        place[(axis + 1) % 3] += radius * cos(angle);
        place[(axis + 2) % 3] += radius * sin(angle);
        if (k > 0)
            add_segment(outline, last, place);
        memcpy(last, place, sizeof last);
    }
}

static void add_box(struct outline *outline, const double middle[3], double half)
{
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++) {
            double from[3], to[3];
            if (corner >> axis & 1)
                continue;
            for (int i = 0; i < 3; i++)
                from[i] = to[i] = middle[i] + (corner >> i & 1 ? half : -half);
            to[axis] = middle[axis] + half;
            add_segment(outline, from, to);
        }
}

static void add_cylinder(struct outline *outline, const struct session *session)
{
    const double r = session->radius;
    double ends[2][3];
    const int axis = session->hit.axis;
    for (int i = 0; i < 3; i++)
        for (int end = 0; end < 2; end++)
            ends[end][i] = session->middle[i] + (end ? r : -r) * session->normal[i];
    for (int end = 0; end < 2; end++)
        add_circle(outline, ends[end], axis, r);
    for (int k = 0; k < 4; k++) {
        double offset[3] = {0}, from[3], to[3];
        offset[(axis + 1 + k / 2) % 3] = k % 2 ? r : -r;
        for (int i = 0; i < 3; i++) {
            from[i] = ends[0][i] + offset[i];
            to[i] = ends[1][i] + offset[i];
        }
        add_segment(outline, from, to);
    }
}

static void add_brush(struct outline *outline, const struct session *session)
{
    if (session->tool == TOOL_BOX) {
        add_box(outline, session->middle, session->radius);
    } else if (session->tool == TOOL_CYLINDER) {
        add_cylinder(outline, session);
    } else {
        for (int axis = 0; axis < 3; axis++)
            add_circle(outline, session->middle, axis, session->radius);
    }
}

/* The line that is dragged, a little before the eye, with strokes into the side that goes. */
static void add_cut(struct outline *outline, const struct session *session)
{
    enum { STROKES = 12 };
    const double stroke = 0.012; /* some pixels, at that distance */
    double from[3], to[3], side[3];
    along(&session->pressed, 1, from);
    along(&session->ray, 1, to);
    add_segment(outline, from, to);
    vec3_cross(session->pressed.direction, session->ray.direction, side);
    const double length = vec3_length(side);
    for (int k = 0; k <= STROKES && length > 0; k++) {
        double root[3], tip[3];
        for (int i = 0; i < 3; i++) {
            root[i] = from[i] + (to[i] - from[i]) * k / STROKES;
            tip[i] = root[i] + stroke * side[i] / length;
        }
        add_segment(outline, root, tip);
    }
}

size_t session_outline(const struct session *session, double segments[][2][3], size_t most)
{
    struct outline outline = {segments, 0, most, 0};
    if (session->tool == TOOL_CUT) {
        if (session->dragging)
            add_cut(&outline, session);
    } else if (session->aimed || session->dragging) {
        for (outline.images = 0; outline.images < 8; outline.images++)
            if (!(outline.images & ~session->mirror))
                add_brush(&outline, session);
    }
    return outline.count;
}
