#include "sim/run.h"
#include "common/command.h"
#include "common/file.h"
#include "common/plot.h"
#include "common/vec3.h"
#include "sim/guard.h"
#include "sim/interrupt.h"
#include "sim/ledger.h"
#include "sim/nearest_break.h"
#include "sim/news.h"
#include "sim/outputs.h"
#include "sim/piece_table.h"
#include "sim/price_effects.h"
#include "sim/price_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

struct run {
    const struct options *options;
    struct sim *sim;
    struct outputs outputs;
    struct checkpoint_run past;   /* before the run was resumed; all 0 without */
    double first_break;           /* s; -1: nothing has broken */
    struct nearest_break nearest; /* until then, in what was shown */
    bool looked;                  /* anything was */
    double began, kept;           /* now() at the start, and at the last checkpoint */
    struct news news;
    bool said_missed; /* that frames are left out */
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Says beforehand that what moves beside the points is too fast for any method, since trials of each take
 * long then. */
static void note_follow(const struct sim *sim)
{
    const struct guard_follow follow = guard_following(sim);
    const double parts = ceil(sim->whole_step / follow.step);
    char text[256];
    if (!sim->integrator->choose || sim->scene->time.guard != SCENE_GUARD_SUBSTEP || parts < 100 ||
        parts > GUARD_PARTS_MAX)
        return;
    guard_describe_follow(sim, &follow, text, sizeof text);
    command_note("time.step %g is split in %.0f or more: %s", sim->whole_step, parts, text);
}

static enum status keep(struct run *run, struct error *err)
{
    struct checkpoint_run whole = {.first_break = run->first_break,
                                   .seconds = run->past.seconds + now() - run->began,
                                   .shown = run->outputs.shown,
                                   .rows = run->past.rows,
                                   .row_bytes = run->past.row_bytes};
    if (run->outputs.log)
        whole.rows = (char *)sim_log_rows(run->outputs.log, &whole.row_bytes);
    if (run->outputs.log && !whole.rows)
        return error_no_memory(err, "the checkpoint");
    enum status status = mesh_series_list(run->outputs.series, err);
    if (!status)
        status = checkpoint_save(run->sim, &whole, run->options->checkpoint, err);
    run->kept = now();
    return status;
}

/* Between two steps: keeps the run when that is due, ends it when somebody wants it to. */
static enum status look_up(struct run *run, struct error *err)
{
    const struct options *options = run->options;
    const enum status caught = interrupt_caught();
    enum status status = STATUS_OK;
    if (options->checkpoint && (caught || now() - run->kept >= options->checkpoint_every))
        status = keep(run, err);
    if (status || !caught)
        return status;
    return error_set(err, caught, "interrupted at %g s, after %" PRIu64 " steps; %s%s", run->sim->time,
                     run->sim->steps,
                     options->checkpoint ? "to go on: the same command with --resume "
                                         : "--checkpoint FILE would have kept the run",
                     options->checkpoint ? options->checkpoint : "");
}

/* Says once that steps are too long for the frames that are wanted: a film is faster than it should be, a log
 * has fewer rows. */
static void note_missed(struct run *run)
{
    const struct outputs *outputs = &run->outputs;
    const bool films = outputs->film || outputs->series || outputs->cache;
    if (run->said_missed || outputs->missed == 0 || (!films && !outputs->log))
        return;
    const double rate = run->sim->scene->view.rate;
    command_note("at %.4g s: view.rate is %g %s a second, and steps are longer: each is one %s; take "
                 "time.step=%.3g or less",
                 run->sim->time, rate, films ? "frames" : "rows",
                 films ? "frame, and the film is faster than it should be" : "row, and the log has fewer",
                 1 / rate);
    run->said_missed = true;
}

/* Who draws or measures this state has time for another look at it. */
static enum status show(struct run *run, struct error *err)
{
    const uint64_t shown = run->outputs.shown;
    enum status status = outputs_show(&run->outputs, run->sim, err);
    note_missed(run);
    if (run->first_break < 0 && run->outputs.shown > shown && outputs_are_there(&run->outputs)) {
        nearest_break_look(run->sim, &run->nearest);
        run->looked = true;
    }
    return status;
}

static enum status step(struct run *run, struct error *err)
{
    struct sim *sim = run->sim;
    enum status status = sim_step(sim, err);
    news_note(&run->news, sim);
    if (sim->broken && run->first_break < 0)
        run->first_break = sim->time;
    return status ? status : show(run, err);
}

static enum status step_to_end(struct run *run, struct error *err)
{
    struct sim *sim = run->sim;
    const double end = sim->scene->time.end, steps = end / sim->step;
    enum status status = outputs_show(&run->outputs, sim, err);
    if (!status)
        note_follow(sim);
    run->began = run->kept = now();
    char size[96];
    snprintf(size, sizeof size, "%u triangles, to %g s in %.3g steps", sim->triangle_count, end, steps);
    progress_begin("inflating", size, "steps", steps);
    progress_update(sim->time / end * steps);
    while (!status && !sim_at_end(sim)) {
        status = step(run, err);
        if (!status || status == STATUS_INTERRUPTED)
            status = look_up(run, err);
        progress_update(sim->time / end * steps);
    }
    progress_end();
    return !status && run->options->checkpoint ? keep(run, err) : status;
}

/* Asked within a long step, also for word of what it is at. */
static bool goes_on(const struct sim *sim)
{
    progress_say(sim->is_trying ? "auto tries methods on the scene as it is now" : NULL);
    return !interrupt_caught();
}

/* What cannot be written is found out before the work, not after it. */
static enum status check_files(const struct options *options, struct error *err)
{
    const char *const paths[] = {options->checkpoint, options->pieces, options->mesh, options->plot,
                                 options->log};
    enum status status = options->plot ? plot_check(options->plot, err) : STATUS_OK;
    if (!status && options->cache)
        status = motion_cache_check(options->cache, err);
    for (size_t i = 0; i < sizeof paths / sizeof *paths && !status; i++)
        status = paths[i] ? file_out_check(paths[i], err) : STATUS_OK;
    return status;
}

static enum status begin(struct run *run, struct error *err)
{
    const struct options *options = run->options;
    enum status status = check_files(options, err);
    outputs_find_rest(&run->outputs, run->sim);
    if (!status && (options->log || options->plot))
        status = ledger_open(run->sim, err);
    if (!status && options->resume) {
        status = checkpoint_load(options->resume, run->sim, &run->past, err);
        run->first_break = run->past.first_break;
    }
    if (!status)
        status = outputs_open(&run->outputs, options, run->sim, options->resume ? &run->past : NULL, err);
    if (!status && options->sheet && run->sim->scene->view.stereo == SCENE_INTERLACED)
        command_note("%s: rows for either eye run together in a sheet's small pictures: it is not in stereo",
                     options->sheet);
    return status;
}

static enum status check_pricing(const struct options *options, const struct sim *sim, struct error *err)
{
    const bool accuracy = options->accuracy_cost;
    const struct scene_time *time = &sim->scene->time;
    enum status status = accuracy ? price_check(options->accuracy_cost, err)
                                  : price_effects_check(sim->scene, options->effect_cost, err);
    if (!status && (accuracy ? time->step / 2 >= time->end : sim_at_end(sim)))
        status = error_set(err, STATUS_INPUT, "%s: time.end = %g is over before a step of time.step = %g",
                           accuracy ? "--accuracy-cost" : "--effect-cost", time->end, time->step);
    return status;
}

enum status run_check(const struct options *options, struct sim *sim, struct error *err)
{
    struct checkpoint_run past = {0};
    enum status status = outputs_check(options, sim, err);
    if (!status)
        status = check_files(options, err);
    if (!status && (options->accuracy_cost || options->effect_cost))
        status = check_pricing(options, sim, err);
    if (!status && options->resume)
        status = checkpoint_load(options->resume, sim, &past, err);
    free(past.rows);
    if (!status && !options->accuracy_cost) /* which lets all steps go */
        status = guard_may_step(sim, err);
    return status;
}

static void note_removed(const struct run *run)
{
    const size_t removed = film_removed(run->outputs.film);
    if (removed)
        command_note("%s: %zu frame%s of an earlier run removed", run->options->frames, removed,
                     removed == 1 ? "" : "s");
}

static enum status save_skin(const struct sim *sim, const char *path, struct error *err)
{
    struct mesh mesh = {0};
    struct mesh_report report;
    enum status status = sim_skin(sim, &mesh, err);
    if (!status && mesh.triangle_count == 0)
        status = error_set(
            err, STATUS_INPUT,
            "%s: no skin is left to be written at %g s; give an earlier time.end, or --mesh-series", path,
            sim->time);
    if (!status)
        status = mesh_repair(&mesh, &report, err);
    if (!status)
        status = mesh_save(&mesh, path, err);
    mesh_clear(&mesh);
    return status;
}

static enum status save_pieces(struct sim *sim, const char *path, struct error *err)
{
    struct piece_table table = {0};
    enum status status = piece_table_make(sim, &table, err);
    if (!status)
        status = piece_table_save(&table, path, err);
    piece_table_clear(&table);
    return status;
}

/* Says why there is no film and no mesh: gone on with was what is at its end. */
static void note_none(const struct run *run)
{
    const struct outputs *outputs = &run->outputs;
    if (run->options->resume && outputs->shown == run->past.shown && !outputs->turntable_frames &&
        (outputs->film || outputs->series || outputs->cache))
        command_note("%s is of the end, %g s: nothing more is drawn, and no film or mesh is written",
                     run->options->resume, run->sim->time);
}

/* How far the point is from the nearest one of all skin. */
static double distance_of_skin(const struct sim *sim, const double place[3])
{
    double least = INFINITY;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            least = fmin(least, vec3_distance(place, sim->position[sim->triangle_point[t][k]]));
    return least;
}

/* Where nothing broke: how near it came. */
static void note_nearest(struct run *run)
{
    const struct nearest_break *nearest = &run->nearest;
    nearest_break_look(run->sim, &run->nearest);
    if (nearest->share > 0)
        command_note(
            "nearest to breaking %s balloons[%zu] at %.4g s, to %.0f %%: %s %.3g times%s, which %s at %.3g",
            run->looked ? "came" : "at the end is", nearest->balloon, nearest->time, 100 * nearest->share,
            nearest->tears ? "skin as if stretched" : "an edge stretched", nearest->stretch,
            nearest->tears ? " both ways" : "", nearest->tears ? "tears" : "lets go", nearest->most);
}

/* Where nothing broke: where the needles were. */
static void note_needles(const struct sim *sim)
{
    for (size_t i = 0; i < sim->scene->needles_count; i++) {
        const struct scene_needles *needle = &sim->scene->needles[i];
        if (needle->at >= sim->time) {
            command_note("needles[%zu] comes at %g s only", i, needle->at);
            continue;
        }
        double place[3];
        for (int k = 0; k < 3; k++)
            place[k] = needle->from[k] + needle->velocity[k] * (sim->time - needle->at);
        command_note(
            "needles[%zu] met no skin: at the end it is at (%.4g, %.4g, %.4g), %.3g from the nearest", i,
            place[0], place[1], place[2], distance_of_skin(sim, place));
    }
}

/* Rips that have not opened, and what they wait for. */
static void note_rips(const struct sim *sim)
{
    for (size_t i = 0; i < sim->balloon_count; i++) {
        const struct scene_rip *rip = &sim->balloons[i].scene->rip;
        if (rip->on && !sim->balloons[i].now->ripped)
            command_note(
                "balloons[%zu].rip has not opened: it waits for %g s, and until the mean edge is %g times "
                "as long as at rest",
                i, rip->at, rip->stretch);
    }
}

static void print_summary(struct run *run)
{
    struct sim *sim = run->sim;
    const struct sim_measures m = sim_measure(sim);
    uint32_t edges = 0;
    for (size_t i = 0; i < sim->balloon_count; i++)
        edges += sim->balloons[i].edge_end - sim->balloons[i].edge_begin;
    printf("%g s in %" PRIu64 " steps: %u of %u edges and %u of %u triangles are left, in %u piece%s; ",
           sim->time, sim->steps, m.edges_active, edges, m.triangles_active, sim->triangle_count, m.pieces,
           m.pieces == 1 ? "" : "s");
    const uint32_t lost = edges - m.edges_active;
    if (sim->broken > lost) /* a tear leaves both sides their edges */
        printf("%u edge%s torn in two; ", sim->broken - lost, sim->broken - lost == 1 ? " is" : "s are");
    if (run->first_break < 0)
        printf("nothing broke\n");
    else
        printf("the first edge broke at %g s\n", run->first_break);
    if (run->outputs.estimate)
        estimate_print(run->outputs.estimate, stdout);
    if (run->options->hash)
        printf("%016" PRIx64 "\n", sim_hash(sim));
}

enum status run(const struct options *options, struct sim *sim, struct estimate *estimate, struct error *err)
{
    struct run run = {.options = options, .sim = sim, .outputs = {.estimate = estimate}, .first_break = -1};
    interrupt_watch();
    sim->goes_on = goes_on;
    enum status status = begin(&run, err);
    if (!status)
        status = step_to_end(&run, err);
    if (!status)
        status = outputs_finish(&run.outputs, err);
    if (!status)
        note_none(&run);
    note_removed(&run);
    status = outputs_close(&run.outputs, status, err);
    const size_t removed = run.outputs.removed;
    if (removed)
        command_note("%s: %zu mesh%s of an earlier run %s removed", options->series, removed,
                     removed == 1 ? "" : "es", removed == 1 ? "was" : "were");
    if (!status && options->mesh)
        status = save_skin(sim, options->mesh, err);
    if (!status && options->pieces)
        status = save_pieces(sim, options->pieces, err);
    if (!status) {
        print_summary(&run);
        note_rips(sim);
    }
    if (!status && run.first_break < 0) {
        note_nearest(&run);
        note_needles(sim);
    }
    free(run.past.rows);
    return status;
}
