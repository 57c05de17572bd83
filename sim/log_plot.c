#include "sim/log_plot.h"
#include "common/array.h"
#include "common/plot.h"

#include <stdlib.h>
#include <string.h>

/* What is plotted, by the log's names. */
enum { TIME, PRESSURE, RADIUS, KINETIC, ELASTIC, GAS, PIECES, SERIES };
static const char *const names[SERIES] = {"time",           "gauge_pressure", "mean_radius", "kinetic_energy",
                                          "elastic_energy", "gas_energy",     "pieces"};

struct table {
    double *values[SERIES]; /* [rows] */
    size_t rows;
};

static size_t count_lines(const char *text, const char *end)
{
    size_t lines = 0;
    for (; text < end; text++)
        lines += *text == '\n';
    return lines;
}

/* Which of the names a column of the header has; SERIES: none. */
static int series_of(const char *word, size_t length)
{
    int i = 0;
    while (i < SERIES && (strlen(names[i]) != length || memcmp(names[i], word, length) != 0))
        i++;
    return i;
}

static const char *word_end(const char *at, const char *end)
{
    while (at < end && *at != '\t' && *at != '\n')
        at++;
    return at;
}

/* Calls use(context, column, word, length) for each word of a line; returns where the next line begins. */
static const char *read_line(const char *at, const char *end,
                             void (*use)(void *context, size_t column, const char *word, size_t length),
                             void *context)
{
    for (size_t column = 0; at < end; column++) {
        const char *stop = word_end(at, end);
        use(context, column, at, (size_t)(stop - at));
        at = stop + 1;
        if (stop == end || *stop == '\n')
            break;
    }
    return at < end ? at : end;
}

enum { COLUMNS_MAX = 64 };
struct reading {
    struct table table;
    int series[COLUMNS_MAX]; /* of each column */
};

static void read_name(void *context, size_t column, const char *word, size_t length)
{
    struct reading *reading = context;
    if (column < COLUMNS_MAX)
        reading->series[column] = series_of(word, length);
}

static void read_value(void *context, size_t column, const char *word, size_t length)
{
    struct reading *reading = context;
    char text[40];
    if (column >= COLUMNS_MAX || reading->series[column] == SERIES || length >= sizeof text)
        return;
    memcpy(text, word, length);
    text[length] = '\0';
    reading->table.values[reading->series[column]][reading->table.rows] = strtod(text, NULL);
}

static bool read_rows(struct reading *reading, const char *rows, size_t bytes)
{
    const char *end = rows + bytes;
    const size_t lines = count_lines(rows, end);
    for (int i = 0; i < SERIES; i++) {
        reading->table.values[i] = calloc(lines + 1, sizeof *reading->table.values[i]);
        if (!reading->table.values[i])
            return false;
    }
    const char *at = read_line(rows, end, read_name, reading);
    for (; at < end; reading->table.rows++)
        at = read_line(at, end, read_value, reading);
    return true;
}

static struct plot_series curve(const struct table *table, const char *name, size_t column)
{
    return (struct plot_series){.name = name,
                                .style = PLOT_LINE,
                                .x = table->values[TIME],
                                .y = table->values[column],
                                .count = table->rows};
}

static enum status draw(const struct table *table, const char *title, const char *path, struct error *err)
{
    bool gas = false;
    for (size_t i = 0; i < table->rows; i++)
        gas = gas || table->values[GAS][i] != 0;
    const struct plot_series pressure = curve(table, NULL, PRESSURE), radius = curve(table, NULL, RADIUS),
                             pieces = curve(table, NULL, PIECES);
    const struct plot_series energy[] = {curve(table, "kinetic", KINETIC), curve(table, "elastic", ELASTIC),
                                         curve(table, "gas", GAS)};
    const struct plot_panel panels[] = {
        {"Pressure", "time, s", "gauge pressure", .from_zero = true, .series = &pressure, .series_count = 1},
        {"Radius", "time, s", "mean radius", .series = &radius, .series_count = 1},
        {"Energy", "time, s", "energy", .from_zero = true, .series = energy, .series_count = gas ? 3 : 2},
        {"Pieces", "time, s", "pieces", .from_zero = true, .whole = true, .series = &pieces,
         .series_count = 1}};
    return plot_save(&(struct plot){.title = title, .panels = panels, .panel_count = 4, .columns = 2}, path,
                     err);
}

enum status log_plot_save(const char *rows, size_t bytes, const char *title, const char *path,
                          struct error *err)
{
    struct reading reading = {0};
    enum status status = read_rows(&reading, rows, bytes) ? draw(&reading.table, title, path, err)
                                                          : error_no_memory(err, "the plot");
    for (int i = 0; i < SERIES; i++)
        free(reading.table.values[i]);
    return status;
}
