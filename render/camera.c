#include "render/camera.h"

#include "common/vec3.h"

#include <string.h>

static const double field_of_view_deg = 30; /* of fitted cameras: a short telephoto's, little distortion */
static const double eye_ratio = 1.0 / 30;   /* fitted eye distance over screen distance, the 1/30 rule */

static bool finite3(const double a[3])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

static double radians(double deg)
{
    return deg * (M_PI / 180);
}

/* x right, y up, z towards the viewer. False where up is along the line of sight, or a number is none. */
static bool find_axes(const double towards_viewer[3], const double up[3], double axis[3][3])
{
    double length = vec3_length(towards_viewer);
    for (int i = 0; i < 3; i++)
        axis[2][i] = towards_viewer[i] / length;
    vec3_cross(up, axis[2], axis[0]);
    double across = vec3_length(axis[0]);
    if (!(length > 0) || !isfinite(length) || !(across > 1e-9 * vec3_length(up)) || !isfinite(across))
        return false;
    for (int i = 0; i < 3; i++)
        axis[0][i] /= across;
    vec3_cross(axis[2], axis[0], axis[1]);
    return true;
}

static enum status check_size(const struct render_view *view, struct error *err)
{
    if (view->width < 1 || view->height < 1 || view->width > IMAGE_SIDE_MAX || view->height > IMAGE_SIDE_MAX)
        return error_set(err, STATUS_RANGE, "a picture of %d x %d cannot be drawn; each side must be 1 to %d",
                         view->width, view->height, IMAGE_SIDE_MAX);
    int parts[2];
    camera_parts(view->stereo, parts);
    if (view->width % parts[0] || view->height % parts[1])
        return error_set(err, STATUS_RANGE, "a stereo picture %d %s cannot be halved; that must be even",
                         parts[0] == 2 ? view->width : view->height, parts[0] == 2 ? "wide" : "high");
    return STATUS_OK;
}

enum status camera_check(const struct render_view *view, struct error *err)
{
    const struct render_camera *camera = &view->camera;
    enum status status = check_size(view, err);
    if (status)
        return status;
    if (!finite3(camera->eye) || !finite3(camera->target) || !finite3(camera->up))
        return error_set(err, STATUS_RANGE, "the camera's eye, target or up is not a finite number");
    if (!(camera->field_of_view_deg > 0) || !(camera->field_of_view_deg < 180))
        return error_set(err, STATUS_RANGE,
                         "the camera's field of view is %g degrees; it must lie between 0 and 180",
                         camera->field_of_view_deg);
    double back[3], axis[3][3];
    vec3_sub(camera->eye, camera->target, back);
    if (!find_axes(back, camera->up, axis))
        return error_set(err, STATUS_RANGE,
                         "the camera sees nothing: its eye must differ from its target, and up from the line "
                         "between them");
    if (view->stereo == RENDER_MONO)
        return STATUS_OK;
    if (!(camera->eye_distance >= 0) || !isfinite(camera->eye_distance))
        return error_set(err, STATUS_RANGE, "the eyes are %g apart; 0 or more is possible",
                         camera->eye_distance);
    if (!(camera->screen_distance > 0) || !isfinite(camera->screen_distance))
        return error_set(err, STATUS_RANGE, "the screen plane is %g away; it must be more than 0",
                         camera->screen_distance);
    return STATUS_OK;
}

void camera_space_of(const struct render_camera *camera, struct camera_space *space)
{
    double back[3];
    vec3_sub(camera->eye, camera->target, back);
    find_axes(back, camera->up, space->axis);
    memcpy(space->origin, camera->eye, sizeof space->origin);
    space->scale = 1 / vec3_length(back);
}

void camera_turn(const struct camera_space *space, const double direction[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = vec3_dot(space->axis[i], direction);
}

void camera_to_space(const struct camera_space *space, const double point[3], double out[3])
{
    double from_eye[3];
    vec3_sub(point, space->origin, from_eye);
    camera_turn(space, from_eye, out);
    for (int i = 0; i < 3; i++)
        out[i] *= space->scale;
}

void camera_parts(enum render_stereo stereo, int parts[2])
{
    parts[0] = stereo == RENDER_PARALLEL || stereo == RENDER_CROSSED ? 2 : 1;
    parts[1] = stereo == RENDER_OVER_UNDER ? 2 : 1;
}

double camera_aspect(const struct render_view *view)
{
    int parts[2];
    camera_parts(view->stereo, parts);
    if (view->squeezed)
        return (double)view->width / view->height;
    return (double)(view->width / parts[0]) / (view->height / parts[1]);
}

/* -0.5 for the left eye, 0.5 for the right one, 0 between them. */
static double side_of(enum render_stereo stereo, int number)
{
    if (stereo == RENDER_MONO)
        return 0;
    bool right = stereo == RENDER_CROSSED ? number == 0 : stereo == RENDER_RIGHT || number == 1;
    return right ? 0.5 : -0.5;
}

int camera_eyes(const struct render_view *view, struct camera_eye eyes[2])
{
    const struct render_camera *camera = &view->camera;
    const bool alone = view->stereo == RENDER_MONO || view->stereo >= RENDER_LEFT;
    int count = alone ? 1 : 2, parts[2];
    double half_height = tan(radians(camera->field_of_view_deg) / 2);
    camera_parts(view->stereo, parts);
    int width = view->width / parts[0], height = view->height / parts[1];
    for (int i = 0; i < count; i++) {
        double side = side_of(view->stereo, i);
        eyes[i] = (struct camera_eye){
            .left = parts[0] == 2 ? i * width : 0,
            .width = width,
            .bottom = parts[1] == 2 ? view->height - (i + 1) * height : 0,
            .height = height,
            .offset = side * camera->eye_distance / vec3_distance(camera->eye, camera->target),
            .half_width = {half_height * camera_aspect(view), half_height},
            .shear = side == 0 ? 0 : -side * camera->eye_distance / camera->screen_distance,
        };
    }
    return count;
}

/* glFrustum() of a window that both eyes share at the screen distance, after moving the eye to the origin:
 * Lipton, "Foundations of the Stereoscopic Cinema" (1982), the parallel-axes camera. */
void camera_projection(const struct camera_eye *eye, double nearest, double farthest, float matrix[16])
{
    double depth = farthest - nearest;
    const double m[16] = {
        [0] = 1 / eye->half_width[0],
        [5] = 1 / eye->half_width[1],
        [8] = eye->shear / eye->half_width[0],
        [10] = -(farthest + nearest) / depth,
        [11] = -1,
        [12] = -eye->offset / eye->half_width[0],
        [14] = -2 * farthest * nearest / depth,
    };
    for (int i = 0; i < 16; i++)
        matrix[i] = (float)m[i];
}

static int pixel(double at, int size)
{
    return !(at > 0) ? 0 : at < size ? (int)at : size;
}

void camera_pixels(const struct camera_eye *eye, const double low[2], const double high[2], double nearest,
                   double farthest, int box[4])
{
    const int size[2] = {eye->width, eye->height};
    const double shift[2] = {eye->shear, 0}, offset[2] = {eye->offset, 0};
    for (int i = 0; i < 2; i++) {
        double near_shift = offset[i] / nearest, far_shift = offset[i] / farthest;
        double from = low[i] - fmax(near_shift, far_shift) - shift[i];
        double to = high[i] - fmin(near_shift, far_shift) - shift[i];
        int first = pixel((from / eye->half_width[i] + 1) / 2 * size[i] - 1, size[i]);
        int last = pixel((to / eye->half_width[i] + 1) / 2 * size[i] + 2, size[i]);
        box[i] = first;
        box[2 + i] = last > first ? last - first : 0;
    }
    box[0] += eye->left;
    box[1] += eye->bottom;
}

/* The distance from the box's middle at which its corners are within the tangents `half`. Seen from an eye at
 * k d beside the axis through a window shared at distance d, the corner a beside and c before the middle
 * appears at (a + k c) / (d - c): so d >= c + |a + k c| / half for either eye. */
static double fitting_distance(const double axis[3][3], const double half_size[3], const double half[2],
                               double k)
{
    double distance = 0;
    for (int corner = 0; corner < 8; corner++) {
        double p[3], at[3];
        for (int i = 0; i < 3; i++)
            p[i] = corner >> i & 1 ? half_size[i] : -half_size[i];
        for (int i = 0; i < 3; i++)
            at[i] = vec3_dot(axis[i], p);
        double wide = (fabs(at[0]) + k * fabs(at[2])) / half[0], high = fabs(at[1]) / half[1];
        distance = fmax(distance, at[2] + fmax(fmax(wide, high), 0.1 * fabs(at[2])));
    }
    return distance;
}

enum status render_fit_camera(struct render_view *view, const double lower[3], const double upper[3],
                              const double direction[3], double margin, struct error *err)
{
    enum status status = check_size(view, err);
    if (status)
        return status;
    if (!(margin >= 0) || !(margin < 1))
        return error_set(err, STATUS_RANGE, "the margin is %g of the picture; 0 to below 1 is possible",
                         margin);
    double middle[3], half_size[3], axis[3][3];
    for (int i = 0; i < 3; i++) {
        middle[i] = lower[i] / 2 + upper[i] / 2;
        half_size[i] = upper[i] / 2 - lower[i] / 2;
        if (!isfinite(middle[i]) || !(half_size[i] >= 0) || !isfinite(half_size[i]))
            return error_set(err, STATUS_RANGE, "the bounds %g .. %g along axis %d hold nothing to look at",
                             lower[i], upper[i], i);
    }
    bool along_y = fabs(direction[1]) > 1e3 * hypot(direction[0], direction[2]);
    const double up[3] = {0, !along_y, along_y ? -1 : 0};
    if (!find_axes(direction, up, axis))
        return error_set(err, STATUS_RANGE, "the direction to look from has no length");

    double half_height = tan(radians(field_of_view_deg) / 2) * (1 - margin);
    const double half[2] = {half_height * camera_aspect(view), half_height};
    double distance = fitting_distance(axis, half_size, half,
                                       view->stereo == RENDER_MONO ? 0 : eye_ratio / 2);
    if (!(distance > 0))
        distance = 1; /* a single point is seen from anywhere */
    struct render_camera camera = {
        .up = {up[0], up[1], up[2]},
        .field_of_view_deg = field_of_view_deg,
        .eye_distance = distance * eye_ratio,
        .screen_distance = distance,
    };
    for (int i = 0; i < 3; i++) {
        camera.target[i] = middle[i];
        camera.eye[i] = middle[i] + distance * axis[2][i];
    }
    if (!finite3(camera.eye))
        return error_set(err, STATUS_RANGE, "the bounds are too large to be looked at");
    view->camera = camera;
    return STATUS_OK;
}
