#include "sim/log.h"
#include "common/file.h"
#include "sim/effect_gas.h"
#include "sim/ledger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct sim_log {
    struct file_out *out;
    bool position_error;
    double seconds; /* before it was opened */
    struct timespec began;
    FILE *kept; /* the same once more; NULL: nobody wants it */
    char *rows;
    size_t row_bytes;
};

static const char *const columns =
    "time\tmean_radius\tvolume\tgauge_pressure\tkinetic_energy\telastic_energy\tmax_stretch\tedges_active\t"
    "triangles_active\tarea\tpieces\tlargest_piece_area\tstep\tseconds\tgas_energy\tdissipated_energy\t"
    "fracture_energy\tpressure_work\tuser_work\tbalance_error\tcrack_tips\ttorn_length\thole_area\tcrack_energy";

static void put(struct sim_log *log, const char *text, size_t bytes)
{
    if (log->out)
        fwrite(text, 1, bytes, file_out_stream(log->out));
    if (log->kept)
        fwrite(text, 1, bytes, log->kept);
}

/* The header, or the rows of the earlier part of the run, which begin with it. */
static enum status begin(struct sim_log *log, const struct sim_log_options *options, struct error *err)
{
    char header[512];
    const int length = snprintf(header, sizeof header, "%s%s\n", columns,
                                log->position_error ? "\tposition_error" : "");
    if (options->row_bytes == 0) {
        put(log, header, (size_t)length);
        return STATUS_OK;
    }
    if (options->row_bytes < (size_t)length || memcmp(options->rows, header, (size_t)length) != 0)
        return error_set(err, STATUS_INPUT,
                         "the log of the run so far has other columns; resume without --log");
    put(log, options->rows, options->row_bytes);
    return STATUS_OK;
}

enum status sim_log_open(const char *path, const struct sim_log_options *options, struct sim_log **result,
                         struct error *err)
{
    struct sim_log *log = calloc(1, sizeof *log);
    if (!log)
        return error_no_memory(err, "the log");
    log->position_error = options->position_error;
    log->seconds = options->seconds;
    clock_gettime(CLOCK_MONOTONIC, &log->began);
    if (options->keep)
        log->kept = open_memstream(&log->rows, &log->row_bytes);
    enum status status = options->keep && !log->kept ? error_no_memory(err, "the log") : STATUS_OK;
    if (!status && path)
        status = file_out_open(path, &log->out, err);
    if (!status)
        status = begin(log, options, err);
    if (status)
        sim_log_abandon(log);
    else
        *result = log;
    return status;
}

void sim_log_row(struct sim_log *log, struct sim *sim, double position_error)
{
    const struct sim_measures m = sim_measure(sim);
    const struct ledger_balance b = ledger_balance(sim, &m);
    char row[1024], error[32] = "";
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double seconds = log->seconds + (double)(now.tv_sec - log->began.tv_sec) +
                           1e-9 * (double)(now.tv_nsec - log->began.tv_nsec);
    if (log->position_error)
        snprintf(error, sizeof error, isnan(position_error) ? "\tnan" : "\t%.3g", position_error);
    const int length = snprintf(
        row, sizeof row,
        "%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%u\t%u\t%.9g\t%u\t%.9g\t%.9g\t%.3f\t%.9g\t%.9g\t%.9g\t%.9g\t"
        "%.9g\t%.3g\t%u\t%.9g\t%.9g\t%.9g%s\n",
        sim->time, m.mean_radius, m.volume, gas_gauge_pressure(sim, &sim->balloons[0]), m.kinetic_energy,
        m.elastic_energy, m.max_stretch, m.edges_active, m.triangles_active, m.area, m.pieces,
        m.largest_piece_area, sim->taken > 0 ? sim->taken : sim->step, seconds, b.gas, b.dissipated,
        b.fracture, b.pressure_work, b.user_work, b.error, m.crack_tips, m.torn_length, m.hole_area,
        m.crack_energy, error);
    put(log, row, (size_t)length);
}

const char *sim_log_rows(struct sim_log *log, size_t *bytes)
{
    if (fflush(log->kept) || ferror(log->kept))
        return NULL;
    *bytes = log->row_bytes;
    return log->rows;
}

/* All but the file. */
static void drop(struct sim_log *log)
{
    if (log->kept)
        fclose(log->kept);
    free(log->rows);
    free(log);
}

enum status sim_log_close(struct sim_log *log, struct error *err)
{
    if (!log)
        return STATUS_OK;
    enum status status = log->out ? file_out_commit(log->out, err) : STATUS_OK;
    drop(log);
    return status;
}

void sim_log_abandon(struct sim_log *log)
{
    if (!log)
        return;
    file_out_abandon(log->out);
    drop(log);
}
