/* Films and pictures out of the live window: of the skin alone, a picture a frame of the scene however
 * long that takes to draw. */
#include "common/mesh.h"
#include "render/movie.h"
#include "sim/window_app.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { NAMES_MAX = 10000 };

/* What was done, or what went wrong with it. */
static void tell(struct app *app, enum status status, const struct error *err, const char *done)
{
    if (status)
        app_complain(app, err->text);
    else
        app_say(app, done);
}

/* "sphere-1.mp4" for sphere.cfg: the first number that is free, in the current folder. */
static bool find_name(const struct app *app, const char *extension, char *name, size_t size)
{
    const char *path = app->live.sim->scene->path, *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    const int length = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    for (int i = 1; i < NAMES_MAX; i++) {
        snprintf(name, size, "%.*s-%d%s", length < 200 ? length : 200, base, i, extension);
        if (access(name, F_OK) != 0)
            return true;
    }
    return false;
}

static enum status begin(struct app *app, struct error *err)
{
    struct frames_options options = {.rate = app->live.sim->scene->view.playback};
    struct error no_movie = {0};
    /* else its pictures, in a folder */
    const bool movie = movie_check("a.mp4", &no_movie) != STATUS_RESOURCE;
    if (!find_name(app, movie ? ".mp4" : "", app->recording, sizeof app->recording))
        return error_set(err, STATUS_FILE, "%s is there: this folder holds enough films", app->recording);
    if (movie)
        options.movie = app->recording;
    else
        options.folder = app->recording;
    return frames_open(&options, &app->film, err);
}

void app_record(struct app *app)
{
    struct error err = {0};
    char text[700];
    if (app->film) {
        app_end_recording(app);
        return;
    }
    enum status status = begin(app, &err);
    snprintf(text, sizeof text, "recording %s", app->recording);
    tell(app, status, &err, text);
    app->live.each_frame = !status;
    app->recorded = -1;
    app_show_title(app);
    app_record_frame(app);
}

void app_record_frame(struct app *app)
{
    struct error err = {0};
    const double time = app->live.past.items[app->live.shown].marks.time;
    if (!app->film || time == app->recorded)
        return;
    app->recorded = time;
    enum status status = app_draw_image(app, &err);
    if (!status)
        status = frames_add(app->film, &app->image, time, &err);
    if (!status)
        return;
    app_end_recording(app);
    app_complain(app, err.text);
}

void app_end_recording(struct app *app)
{
    struct error err = {0};
    char text[700];
    if (!app->film)
        return;
    enum status status = frames_close(app->film, &err);
    app->film = NULL;
    app->live.each_frame = false;
    snprintf(text, sizeof text, "%s is written", app->recording);
    tell(app, status, &err, text);
    app_show_title(app);
}

void app_save_picture(struct app *app)
{
    struct error err = {0};
    char name[512], text[700];
    enum status status = STATUS_OK;
    if (!find_name(app, ".png", name, sizeof name))
        status = error_set(&err, STATUS_FILE, "%s is there: this folder holds enough pictures", name);
    if (!status)
        status = app_draw_image(app, &err);
    if (!status)
        status = image_save_png(&app->image, name, NULL, 0, &err);
    snprintf(text, sizeof text, "%s is written", name);
    tell(app, status, &err, text);
}
