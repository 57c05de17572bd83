/* The scale of the colours by stretch. */
#include "sim/window_app.h"

#include <math.h>
#include <string.h>

enum { SCALE_COLOURS = 5 };

/* From slack to taut, evenly spaced: dark blue, teal, green, yellow, red. Lightness rises up to the yellow,
 * so that the order can be read without its hues. */
static const float hues[SCALE_COLOURS][3] = {{0.02f, 0.03f, 0.20f},
                                             {0.01f, 0.17f, 0.30f},
                                             {0.03f, 0.38f, 0.12f},
                                             {0.80f, 0.62f, 0.03f},
                                             {0.62f, 0.01f, 0.01f}};

/* In the same places, for glasses that show each eye the hues of its own: lightness of 15, 35, 55, 75 and 95
 * (CIE L*). */
static const float greys[SCALE_COLOURS] = {0.0196f, 0.0852f, 0.2289f, 0.4828f, 0.8763f};

/* Where neither threshold nor strength says which stretch is the last, the scale ends here. */
static const double longest_scale = 6;

double app_stretch_most(const struct app *app)
{
    const struct sim *sim = app->live.sim;
    const struct sim_balloon *first = sim->balloons;
    const double last = first->fracture ? first->scene->fracture.strength
                                        : first->now->threshold_length /
                                              (first->own_thresholds ? 1 : first->mean_rest_length);
    return fmin(fmax(last, 1.01), longest_scale);
}

double app_stretch_part(const struct app *app, double stretch)
{
    const double part = (stretch - 1) / (app_stretch_most(app) - 1);
    return part > 0 ? fmin(part, 1) : 0;
}

bool app_scale_is_grey(const struct app *app)
{
    return app->view.stereo == RENDER_RED_CYAN;
}

void app_scale_colour(const struct app *app, double part, float colour[3])
{
    const int below = part < 1 ? (int)(part * (SCALE_COLOURS - 1)) : SCALE_COLOURS - 2;
    const float t = (float)(part * (SCALE_COLOURS - 1) - below);
    for (int i = 0; i < 3; i++)
        colour[i] = app_scale_is_grey(app) ? greys[below] + t * (greys[below + 1] - greys[below])
                                           : hues[below][i] + t * (hues[below + 1][i] - hues[below][i]);
}
