#include "sim/run.h"
#include "common/command.h"
#include "sim/film.h"
#include "sim/guard.h"
#include "sim/ledger.h"

#include <inttypes.h>
#include <math.h>

/* What becomes of the states: pictures, and rows in the log. */
struct outputs {
    struct film *film;
    struct sim_log *log;
    double next; /* number of the next frame, in frames of view.rate */
};

static enum status show_state(struct outputs *outputs, struct sim *sim, struct error *err)
{
    if (outputs->log)
        sim_log_row(outputs->log, sim);
    return outputs->film ? film_frame(outputs->film, err) : STATUS_OK;
}

/* All frames that are due: at their own times where the method can tell what was inside a step, else one of the state as it is
 * now. */
static enum status show_frames(struct outputs *outputs, struct sim *sim, struct error *err)
{
    const double rate = sim->scene->view.rate,
                 number = sim->time * rate + 1e-6; /* rounding must not put a frame off */
    enum status status = STATUS_OK;
    if (!sim->integrator->look && number >= outputs->next)
        outputs->next = floor(number);
    for (; !status && number >= outputs->next; outputs->next++) {
        sim_look(sim, outputs->next / rate);
        status = show_state(outputs, sim, err);
        sim_look_end(sim);
    }
    return status;
}

/* Says once that steps are split, and why. */
static void note_guard(struct sim *sim, bool *said)
{
    char text[256];
    if (*said || sim->substeps == 1)
        return;
    *said = true;
    guard_describe(sim, text, sizeof text);
    command_note("%s", text);
}

/* Steps to the end. *first_break becomes the time at which the first edge broke; it stays as it was when none did. */
static enum status step_to_end(struct sim *sim, struct outputs *outputs, double *first_break,
                               struct error *err)
{
    const double end = sim->scene->time.end;
    enum status status = show_frames(outputs, sim, err);
    const double steps = end / sim->step;
    bool said = false;
    progress_begin("inflating", "steps", steps);
    while (!status && !sim_at_end(sim)) {
        status = sim_step(sim, err);
        note_guard(sim, &said);
        if (!status)
            status = show_frames(outputs, sim, err);
        if (sim->broken && *first_break < 0)
            *first_break = sim->time;
        progress_update(sim->time / end * steps);
    }
    progress_end();
    return status;
}

static enum status open_outputs(struct outputs *outputs, const struct options *options, struct sim *sim,
                                struct error *err)
{
    if (options->log) {
        enum status status = ledger_open(sim, err);
        if (!status)
            status = sim_log_open(options->log, &outputs->log, err);
        if (status)
            return status;
    }
    if (!options->frames && !options->movie && !options->sheet)
        return STATUS_OK;
    struct frames_options frames = {.folder = options->frames,
                                    .movie = options->movie,
                                    .sheet = options->sheet,
                                    .rate = sim->scene->view.playback};
    return film_open(sim, &frames, &outputs->film, err);
}

/* A run that diverged keeps what it has shown so far; any other failure leaves the old log. */
static enum status close_outputs(struct outputs *outputs, enum status status, struct error *err)
{
    const bool keep = !status || status == STATUS_DIVERGED;
    struct error other = {0};
    enum status closed = film_close(outputs->film, &other);
    if (!keep)
        sim_log_abandon(outputs->log);
    else if (sim_log_close(outputs->log, closed ? NULL : &other) && !closed)
        closed = other.status;
    if (status || !closed)
        return status;
    *err = other;
    return closed;
}

static enum status save_skin(const struct sim *sim, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    struct mesh_report report;
    enum status status = sim_skin(sim, &mesh, err);
    if (!status && mesh.triangle_count == 0)
        status = error_set(err, STATUS_INPUT, "%s: no skin is left to be written", path);
    if (!status)
        status = mesh_repair(&mesh, &report, err);
    if (!status)
        status = mesh_save(&mesh, path, err);
    mesh_clear(&mesh);
    return status;
}

static void print_summary(struct sim *sim, double first_break)
{
    const struct sim_measures m = sim_measure(sim);
    printf("%g s in %" PRIu64 " steps: %u of %u edges and %u of %u triangles are left, in %u pieces; ",
           sim->time, sim->steps, m.edges_active, sim->edge_count, m.triangles_active, sim->triangle_count,
           m.pieces);
    if (first_break < 0)
        printf("nothing broke\n");
    else
        printf("the first edge broke at %g s\n", first_break);
}

enum status run(const struct options *options, struct sim *sim, struct error *err)
{
    struct outputs outputs = {0};
    double first_break = -1;
    enum status status = open_outputs(&outputs, options, sim, err);
    if (!status)
        status = step_to_end(sim, &outputs, &first_break, err);
    status = close_outputs(&outputs, status, err);
    if (!status && options->mesh)
        status = save_skin(sim, options->mesh, err);
    if (status)
        return status;
    print_summary(sim, first_break);
    if (options->hash)
        printf("%016" PRIx64 "\n", sim_hash(sim));
    return STATUS_OK;
}
