#include "render/orbit.h"

#include "render/camera.h"

#include "common/vec3.h"

static const double degrees_per_pixel = 0.5;
static const double nearer_per_step = 0.9;
static const double eye_ratio = 1.0 / 30; /* the usual rule for comfortable pairs */

static double radians(double deg)
{
    return deg * (M_PI / 180);
}

struct orbit orbit_start(void)
{
    return (struct orbit){.target = {0.5, 0.5, 0.5},
                          .distance = 3.6,
                          .azimuth_deg = 30,
                          .elevation_deg = 25,
                          .field_of_view_deg = 30};
}

/* x right, y up, z towards the eye, also where it looks straight down. */
static void find_axes(const struct orbit *orbit, double axis[3][3])
{
    double a = radians(orbit->azimuth_deg), e = radians(orbit->elevation_deg);
    const double axes[3][3] = {
        {cos(a), 0, -sin(a)},
        {-sin(e) * sin(a), cos(e), -sin(e) * cos(a)},
        {cos(e) * sin(a), sin(e), cos(e) * cos(a)},
    };
    for (int i = 0; i < 9; i++)
        axis[i / 3][i % 3] = axes[i / 3][i % 3];
}

void orbit_turn(struct orbit *orbit, double dx, double dy)
{
    orbit->azimuth_deg = fmod(orbit->azimuth_deg - degrees_per_pixel * dx, 360);
    orbit->elevation_deg = fmin(fmax(orbit->elevation_deg + degrees_per_pixel * dy, -90), 90);
}

void orbit_pan(struct orbit *orbit, const struct render_view *view, double dx, double dy)
{
    double axis[3][3];
    double pixel = 2 * orbit->distance * tan(radians(orbit->field_of_view_deg) / 2) / view->height;
    find_axes(orbit, axis);
    for (int i = 0; i < 3; i++)
        orbit->target[i] += pixel * (dy * axis[1][i] - dx * axis[0][i]);
}

void orbit_zoom(struct orbit *orbit, double steps)
{
    orbit->distance = fmin(fmax(orbit->distance * pow(nearer_per_step, steps), 1e-6), 1e6);
}

void orbit_look(struct orbit *orbit, enum orbit_side side)
{
    static const double angle[][2] = {
        [ORBIT_FRONT] = {0, 0},  [ORBIT_BACK] = {180, 0}, [ORBIT_RIGHT] = {90, 0},
        [ORBIT_LEFT] = {-90, 0}, [ORBIT_TOP] = {0, 90},   [ORBIT_BOTTOM] = {0, -90}};
    orbit->azimuth_deg = angle[side][0];
    orbit->elevation_deg = angle[side][1];
}

void orbit_frame(struct orbit *orbit, const struct render_view *view, const double lower[3],
                 const double upper[3])
{
    double radius = vec3_distance(lower, upper) / 2;
    if (!(radius > 0) || !isfinite(radius))
        return;
    double half = tan(radians(orbit->field_of_view_deg) / 2);
    double narrower = fmin(1, camera_aspect(view));
    for (int i = 0; i < 3; i++)
        orbit->target[i] = lower[i] / 2 + upper[i] / 2;
    orbit->distance = radius / sin(atan(half * narrower));
}

void orbit_camera(const struct orbit *orbit, struct render_camera *camera)
{
    double axis[3][3];
    find_axes(orbit, axis);
    *camera = (struct render_camera){.field_of_view_deg = orbit->field_of_view_deg,
                                     .eye_distance = orbit->distance * eye_ratio,
                                     .screen_distance = orbit->distance};
    for (int i = 0; i < 3; i++) {
        camera->target[i] = orbit->target[i];
        camera->eye[i] = orbit->target[i] + orbit->distance * axis[2][i];
        camera->up[i] = axis[1][i];
    }
}

/* The eye whose pixel it is; where that is both, one between them. */
static struct camera_eye eye_at(const struct render_view *view, double x, double y)
{
    struct camera_eye eyes[2];
    const int count = camera_eyes(view, eyes), below = view->height - eyes[count - 1].height;
    if (count == 2 && !eyes[1].left && !below)
        eyes[0].offset = eyes[0].shear = 0;
    else if (count == 2 && (eyes[1].left ? x >= eyes[1].left : y >= below))
        return eyes[1];
    return eyes[0];
}

bool orbit_ray(const struct render_view *view, double x, double y, double origin[3], double direction[3])
{
    struct camera_space space;
    struct error ignored;
    if (camera_check(view, &ignored))
        return false;
    camera_space_of(&view->camera, &space);
    const struct camera_eye eye = eye_at(view, x, y);
    int top = view->height - eye.bottom - eye.height;
    double across = (2 * (x - eye.left) / eye.width - 1) * eye.half_width[0] + eye.shear;
    double up = (1 - 2 * (y - top) / eye.height) * eye.half_width[1];
    double length = sqrt(across * across + up * up + 1);
    for (int i = 0; i < 3; i++) {
        origin[i] = space.origin[i] + space.axis[0][i] * eye.offset / space.scale;
        direction[i] = (across * space.axis[0][i] + up * space.axis[1][i] - space.axis[2][i]) / length;
    }
    return true;
}

bool orbit_key(struct orbit *orbit, int key, bool other)
{
    switch (key) {
    case '1':
        orbit_look(orbit, other ? ORBIT_BACK : ORBIT_FRONT);
        return true;
    case '3':
        orbit_look(orbit, other ? ORBIT_LEFT : ORBIT_RIGHT);
        return true;
    case '7':
        orbit_look(orbit, other ? ORBIT_BOTTOM : ORBIT_TOP);
        return true;
    default:
        return false;
    }
}

/* How much further away than a picture as wide as high one needs to be. */
static double narrowness(const struct render_view *view)
{
    return fmax(1, 1 / camera_aspect(view));
}

const char *orbit_change_stereo(struct orbit *orbit, struct render_view *view, bool quad)
{
    static const struct {
        enum render_stereo next;
        const char *text;
    } layouts[] = {
        [RENDER_MONO] = {RENDER_PARALLEL, "stereo: one eye"},
        [RENDER_PARALLEL] = {RENDER_CROSSED, "stereo: side by side, for a viewer or parallel eyes"},
        [RENDER_CROSSED] = {RENDER_OVER_UNDER, "stereo: side by side, for crossed eyes"},
        [RENDER_OVER_UNDER] = {RENDER_RED_CYAN, "stereo: the left eye's picture above the right one's"},
        [RENDER_RED_CYAN] = {RENDER_INTERLACED, "stereo: for red and cyan glasses"},
        [RENDER_INTERLACED] = {RENDER_QUAD, "stereo: row by row, the left eye's first"},
        [RENDER_QUAD] = {RENDER_MONO, "stereo: in the screen's two buffers"},
        [RENDER_LEFT] = {RENDER_MONO, "stereo: the left eye"},
        [RENDER_RIGHT] = {RENDER_MONO, "stereo: the right eye"},
    };
    const double before = narrowness(view);
    view->stereo = layouts[view->stereo].next;
    if (view->stereo == RENDER_QUAD && !quad)
        view->stereo = RENDER_MONO;
    orbit->distance *= narrowness(view) / before;
    return layouts[view->stereo].text;
}

void orbit_make_even(struct render_view *view)
{
    int parts[2];
    camera_parts(view->stereo, parts);
    view->width -= view->width > 1 ? view->width % parts[0] : 0;
    view->height -= view->height > 1 ? view->height % parts[1] : 0;
}

void orbit_eye_size(const struct render_view *view, int size[2])
{
    struct render_view even = *view;
    int parts[2];
    orbit_make_even(&even);
    camera_parts(view->stereo, parts);
    size[0] = even.width > parts[0] ? even.width / parts[0] : 1;
    size[1] = even.height > parts[1] ? even.height / parts[1] : 1;
}

void orbit_eye_place(const struct render_view *view, int place[2])
{
    int size[2];
    orbit_eye_size(view, size);
    for (int i = 0; i < 2; i++)
        place[i] = place[i] >= 0 ? place[i] % size[i] : place[i];
}
