#include "surface/main_cost.h"

#include "common/file.h"
#include "common/plot.h"

#include <math.h>
#include <stdlib.h>

static void print_advice(const struct cost_table *table, FILE *stream)
{
    for (double error = 1e-2; error > 5e-5; error /= 10) {
        fprintf(stream, "# for errors of %g:", error);
        for (int dial = 0; dial < COST_RELAX; dial++) {
            char setting[32];
            if (cost_recommend(table, (enum cost_dial)dial, error, setting))
                fprintf(stream, " --%s %s", cost_dial_names[dial], setting);
        }
        fputc('\n', stream);
    }
}

void cost_print(const struct cost_table *table, FILE *stream)
{
    fprintf(stream,
            "dial\tsetting\tseconds\tevaluations\tbytes\trms_error\tmax_error\tarea_error\tvolume_error\n");
    for (size_t i = 0; i < table->count; i++) {
        const struct cost_row *row = &table->rows[i];
        fprintf(stream, "%s\t%s\t%.4g\t%llu\t%zu\t%.3e\t%.3e\t%.3e\t%.3e\n", cost_dial_names[row->dial],
                row->setting, row->seconds, (unsigned long long)row->evaluations, row->bytes, row->rms,
                row->largest, row->area, row->volume);
    }
    fprintf(stream,
            "# errors are shares of the sculpture's longest extent, %.4g, of its area and of its volume\n",
            table->extent);
    double order = table->order[COST_CUBE_SIZE];
    fprintf(stream, "# order in the cube size: %.2f%s\n", order,
            order > 1.8 ? ""
                        : " (2 in the limit: the coarse cubes do not resolve the sculpture's detail yet)");
    if (isfinite(table->order[COST_FIELDS]))
        fprintf(stream, "# order in the fields' spacing: %.2f", table->order[COST_FIELDS]);
    else
        fprintf(stream,
                "# order in the fields' spacing: not walked, the exact field does not reach the threshold");
    fprintf(stream, "; cut-off: faster than any power; relaxation: none\n");
    print_advice(table, stream);
}

static enum status save_table(const struct cost_table *table, const char *path, struct error *err)
{
    struct file_out *out;
    if (file_out_open(path, &out, err))
        return err->status;
    cost_print(table, file_out_stream(out));
    return file_out_commit(out, err);
}

/* Where labels of a panel were put, by logarithms, in shares of the panel. */
struct labels {
    double x[COST_ROWS_MAX], y[COST_ROWS_MAX];
    size_t count;
    double low[2], width[2];
};

static double share_of(const struct labels *labels, int axis, double value)
{
    return (log(value) - labels->low[axis]) / labels->width[axis];
}

static void measure_axis(struct labels *labels, int axis, const double *values, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++)
        if (values[i] > 0) {
            low = fmin(low, log(values[i]));
            high = fmax(high, log(values[i]));
        }
    labels->low[axis] = low;
    labels->width[axis] = high > low ? high - low : 1;
}

/* Whether a label there would not lie on one that was put before; then it is put. */
static bool put_label(struct labels *labels, double error, double seconds)
{
    const double wide = 0.15, high = 0.07; /* a label's size, as a share of what is drawn */
    if (!(error > 0 && seconds > 0))
        return false;
    double x = share_of(labels, 0, error), y = share_of(labels, 1, seconds);
    for (size_t i = 0; i < labels->count; i++)
        if (fabs(x - labels->x[i]) < wide && fabs(y - labels->y[i]) < high)
            return false;
    labels->x[labels->count] = x;
    labels->y[labels->count++] = y;
    return true;
}

/* The curves of one panel; labels that would lie on others are left out. */
static void make_series(const struct cost_table *table, const double *error, const double *seconds,
                        const char **label, struct plot_series series[COST_DIALS])
{
    struct labels labels = {0};
    measure_axis(&labels, 0, error, table->count);
    measure_axis(&labels, 1, seconds, table->count);
    size_t row = 0;
    for (int dial = 0; dial < COST_DIALS; dial++) {
        size_t first = row;
        for (; row < table->count && table->rows[row].dial == (enum cost_dial)dial; row++)
            label[row] = put_label(&labels, error[row], seconds[row]) ? table->rows[row].setting : "";
        series[dial] = (struct plot_series){.name = cost_dial_names[dial],
                                            .style = PLOT_CURVE,
                                            .x = error + first,
                                            .y = seconds + first,
                                            .label = label + first,
                                            .count = row - first};
    }
}

static enum status draw(const struct cost_table *table, const char *sculpture, const char *path,
                        struct error *err)
{
    double error[2][COST_ROWS_MAX], seconds[COST_ROWS_MAX];
    const char *label[2][COST_ROWS_MAX];
    struct plot_series series[2][COST_DIALS];
    for (size_t row = 0; row < table->count; row++) {
        error[0][row] = table->rows[row].rms;
        error[1][row] = table->rows[row].volume;
        seconds[row] = table->rows[row].seconds;
    }
    for (int i = 0; i < 2; i++)
        make_series(table, error[i], seconds, label[i], series[i]);
    const struct plot_panel panels[] = {{.title = "distance from the surface",
                                         .x_label = "RMS error, share of the extent",
                                         .y_label = "seconds",
                                         .log_x = true,
                                         .log_y = true,
                                         .series = series[0],
                                         .series_count = COST_DIALS},
                                        {.title = "volume",
                                         .x_label = "relative error",
                                         .y_label = "seconds",
                                         .log_x = true,
                                         .log_y = true,
                                         .series = series[1],
                                         .series_count = COST_DIALS}};
    const struct plot plot = {.title = sculpture, .panels = panels, .panel_count = 2, .columns = 2};
    return plot_save(&plot, path, err);
}

enum status cost_save(const struct cost_table *table, const char *sculpture, const char *path,
                      struct error *err)
{
    char *name = plot_table_name(path);
    if (!name)
        return error_no_memory(err, path);
    enum status status = save_table(table, name, err);
    free(name);
    return status == STATUS_OK && plot_is_file_name(path) ? draw(table, sculpture, path, err) : status;
}
