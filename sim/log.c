#include "common/file.h"
#include "sim/ledger.h"

#include <stdlib.h>
#include <time.h>

struct sim_log {
    struct file_out *out;
    struct timespec began;
};

enum status sim_log_open(const char *path, struct sim_log **result, struct error *err)
{
    struct sim_log *log = calloc(1, sizeof *log);
    if (!log)
        return error_no_memory(err, "the log");
    enum status status = file_out_open(path, &log->out, err);
    if (status) {
        free(log);
        return status;
    }
    clock_gettime(CLOCK_MONOTONIC, &log->began);
    fputs(
        "time\tmean_radius\tvolume\tgauge_pressure\tkinetic_energy\telastic_energy\tmax_stretch\tedges_active\t"
        "triangles_active\tarea\tpieces\tlargest_piece_area\tstep\tseconds\tgas_energy\tdissipated_energy\t"
        "fracture_energy\tpressure_work\tuser_work\tbalance_error\n",
        file_out_stream(log->out));
    *result = log;
    return STATUS_OK;
}

void sim_log_row(struct sim_log *log, struct sim *sim)
{
    const struct sim_measures m = sim_measure(sim);
    const struct ledger_balance b = ledger_balance(sim, &m);
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double seconds = (double)(now.tv_sec - log->began.tv_sec) +
                           1e-9 * (double)(now.tv_nsec - log->began.tv_nsec);
    fprintf(file_out_stream(log->out),
            "%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%u\t%u\t%.9g\t%u\t%.9g\t%.9g\t%.3f", sim->time,
            m.mean_radius, m.volume, sim->settings[0].pressure, m.kinetic_energy, m.elastic_energy,
            m.max_stretch, m.edges_active, m.triangles_active, m.area, m.pieces, m.largest_piece_area,
            sim->step, seconds);
    fprintf(file_out_stream(log->out), "\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.3g\n", b.gas, b.dissipated,
            b.fracture, b.pressure_work, b.user_work, b.error);
}

enum status sim_log_close(struct sim_log *log, struct error *err)
{
    if (!log)
        return STATUS_OK;
    enum status status = file_out_commit(log->out, err);
    free(log);
    return status;
}

void sim_log_abandon(struct sim_log *log)
{
    if (!log)
        return;
    file_out_abandon(log->out);
    free(log);
}
