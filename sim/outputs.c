#include "sim/outputs.h"
#include "common/command.h"
#include "common/file.h"
#include "sim/interrupt.h"
#include "sim/log_plot.h"
#include "sim/skins.h"

#include <math.h>

void outputs_find_rest(struct outputs *outputs, const struct sim *sim)
{
    outputs->radius = skins_ball(sim, outputs->centre);
}

static enum status open_log(struct outputs *outputs, const struct options *options,
                            const struct checkpoint_run *past, struct error *err)
{
    struct sim_log_options log = {.position_error = options->estimate,
                                  .keep = options->checkpoint || options->plot};
    if (past) {
        log.rows = past->rows;
        log.row_bytes = past->row_bytes;
        log.seconds = past->seconds;
    }
    return sim_log_open(options->log, &log, &outputs->log, err);
}

static enum status open_meshes(struct outputs *outputs, const struct options *options, struct sim *sim,
                               struct error *err)
{
    const struct mesh_series_options series = {.folder = options->series,
                                               .vtp = options->series_vtp,
                                               .apart = options->series_constant,
                                               .first = outputs->shown};
    enum status status = STATUS_OK;
    if (options->series)
        status = mesh_series_open(sim, &series, &outputs->series, err);
    if (!status && options->cache)
        status = motion_cache_open(sim, options->cache, outputs->shown, &outputs->cache, err);
    return status;
}

enum status outputs_check(const struct options *options, struct sim *sim, struct error *err)
{
    const char *const folders[] = {options->frames, options->series};
    const struct frames_options frames = {
        .movie = options->movie, .sheet = options->sheet, .rate = sim->scene->view.playback};
    struct film *film = NULL;
    double centre[3];
    const double radius = skins_ball(sim, centre);
    enum status status = film_check(sim, centre, radius, err);
    for (size_t i = 0; i < sizeof folders / sizeof *folders && !status; i++)
        status = folders[i] ? file_check_folder(folders[i], err) : STATUS_OK;
    if (!status && (options->frames || options->movie || options->sheet))
        status = film_open(sim, centre, radius, &frames, &film, err);
    film_close(film, false, NULL);
    return status;
}

enum status outputs_open(struct outputs *outputs, const struct options *options, struct sim *sim,
                         const struct checkpoint_run *past, struct error *err)
{
    enum status status = STATUS_OK;
    outputs->plot = options->plot;
    outputs->title = options->scene;
    outputs->turntable = options->turntable;
    outputs->turntable_frames = options->turntable_frames;
    if (past) {
        outputs->shown = past->shown;
        outputs->next = floor(sim->time * sim->scene->view.rate + 1e-6) + 1;
    }
    if (options->log || options->plot)
        status = open_log(outputs, options, past, err);
    if (!status)
        status = open_meshes(outputs, options, sim, err);
    if (status || (!options->frames && !options->movie && !options->sheet))
        return status;
    struct frames_options frames = {.folder = options->frames,
                                    .movie = options->movie,
                                    .sheet = options->sheet,
                                    .first = options->turntable_frames ? 0 : outputs->shown,
                                    .rate = sim->scene->view.playback};
    return film_open(sim, outputs->centre, outputs->radius, &frames, &outputs->film, err);
}

static enum status show_state(struct outputs *outputs, struct sim *sim, struct error *err)
{
    double error = NAN;
    enum status status = STATUS_OK;
    if (outputs->estimate)
        status = estimate_compare(outputs->estimate, sim, &error, err);
    if (status)
        return status;
    outputs->shown++;
    if (outputs->log)
        sim_log_row(outputs->log, sim, error);
    if (outputs->series)
        status = mesh_series_add(outputs->series, err);
    if (outputs->cache && !status)
        motion_cache_add(outputs->cache);
    if (status || !outputs->film || outputs->turntable_frames)
        return status;
    const double end = sim->scene->time.end;
    if (outputs->turntable)
        film_turn(outputs->film, end > 0 ? sim->time / end : 0);
    return film_frame(outputs->film, err);
}

enum status outputs_finish(struct outputs *outputs, struct error *err)
{
    const long count = outputs->turntable_frames;
    enum status status = STATUS_OK;
    if (count > 0)
        progress_begin("drawing", "the last state from all sides", "pictures", (double)count);
    for (long i = 0; i < count && !status; i++) {
        const enum status caught = interrupt_caught();
        film_turn(outputs->film, (double)i / (double)count);
        status = caught ? error_set(err, caught, "interrupted after %ld of %ld pictures of the last state", i,
                                    count)
                        : film_frame(outputs->film, err);
        progress_update((double)(i + 1));
    }
    if (count > 0)
        progress_end();
    return status;
}

bool outputs_are_there(const struct outputs *outputs)
{
    return outputs->film || outputs->log || outputs->series || outputs->cache;
}

/* At their own times where the method can tell what was inside a step, else one of the state as it is now. */
enum status outputs_show(struct outputs *outputs, struct sim *sim, struct error *err)
{
    const double rate = sim->scene->view.rate,
                 number = sim->time * rate + 1e-6; /* rounding must not put a frame off */
    enum status status = STATUS_OK;
    if (!sim->integrator->look && number >= outputs->next) {
        outputs->missed += floor(number) - outputs->next;
        outputs->next = floor(number);
    }
    for (; !status && number >= outputs->next; outputs->next++) {
        sim_look(sim, outputs->next / rate);
        status = show_state(outputs, sim, err);
        sim_look_end(sim);
    }
    return status;
}

static enum status draw_plot(struct outputs *outputs, struct error *err)
{
    size_t bytes = 0;
    const char *rows = sim_log_rows(outputs->log, &bytes);
    return rows ? log_plot_save(rows, bytes, outputs->title, outputs->plot, err)
                : error_no_memory(err, "the plot");
}

/* The log's and the cache's older files stay where the run is not to be kept. */
static enum status close_files(struct outputs *outputs, bool keep, struct error *err)
{
    if (!keep) {
        sim_log_abandon(outputs->log);
        motion_cache_abandon(outputs->cache);
        return STATUS_OK;
    }
    enum status status = motion_cache_close(outputs->cache, err);
    enum status closed = sim_log_close(outputs->log, status ? NULL : err);
    return status ? status : closed;
}

enum status outputs_close(struct outputs *outputs, enum status status, struct error *err)
{
    const bool keep = !status || status == STATUS_DIVERGED || status == interrupt_caught();
    struct error other = {0};
    enum status closed = film_close(outputs->film, keep, &other);
    if (keep && outputs->plot && outputs->log && draw_plot(outputs, closed ? NULL : &other) && !closed)
        closed = other.status;
    if (mesh_series_close(outputs->series, &outputs->removed, closed ? NULL : &other) && !closed)
        closed = other.status;
    if (close_files(outputs, keep, closed ? NULL : &other) && !closed)
        closed = other.status;
    if (status && closed) {
        const struct error first = *err;
        return error_set(err, status, "%.600s; what was logged and drawn could not be kept: %.300s",
                         first.text, other.text);
    }
    if (closed)
        *err = other;
    return status ? status : closed;
}
