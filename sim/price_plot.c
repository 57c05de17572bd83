#include "sim/price_plot.h"
#include "common/array.h"
#include "common/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One colour a family: numbers of the plot's colours. */
static const struct {
    const char *method;
    int colour;
} families[] = {{"symplectic-euler", 1},
                {"explicit-euler", 1},
                {"verlet", 6},
                {"rk4", 3},
                {"rkn4", 3},
                {"rk-adaptive", 5},
                {"cvode-adams", 5},
                {"backward-euler", 2},
                {"bdf2", 2},
                {"cvode-bdf", 2},
                {"implicit-midpoint", 2},
                {"xpbd", 4}};

static int colour_of(const struct integrator *method)
{
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++)
        if (!strcmp(families[i].method, method->name))
            return families[i].colour;
    return PLOT_BLACK;
}

/* Everything that a picture of the table needs room for. */
struct picture {
    double *error, *seconds;           /* [count] */
    double *best_error, *best_seconds; /* [best_count] from the smallest error up */
    const char **choice;               /* [count] */
    struct plot_series *series;        /* [methods + 1] */
    size_t best_count, series_count;
};

static void clear(struct picture *p)
{
    free(p->error);
    free(p->seconds);
    free(p->best_error);
    free(p->best_seconds);
    free(p->choice);
    free(p->series);
}

static bool make(struct picture *p, size_t count, size_t methods)
{
    p->error = array_new(count, sizeof *p->error);
    p->seconds = array_new(count, sizeof *p->seconds);
    p->best_error = array_new(count, sizeof *p->best_error);
    p->best_seconds = array_new(count, sizeof *p->best_seconds);
    p->choice = array_new(count, sizeof *p->choice);
    p->series = array_new(methods + 1, sizeof *p->series);
    return p->error && p->seconds && p->best_error && p->best_seconds && p->choice && p->series;
}

/* The rows that nothing beats, in the order of their errors. */
static void add_best(struct picture *p, const struct accuracy_table *table)
{
    double after = 0;
    for (;;) {
        const struct accuracy_row *next = NULL;
        for (size_t i = 0; i < table->count; i++) {
            const struct accuracy_row *row = &table->rows[i];
            if (row->best && row->error > after && (!next || row->error < next->error))
                next = row;
        }
        if (!next)
            break;
        p->best_error[p->best_count] = next->error;
        p->best_seconds[p->best_count++] = next->seconds;
        after = next->error;
    }
    p->series[p->series_count++] = (struct plot_series){.name = "the best",
                                                        .style = PLOT_UNDERLAY,
                                                        .x = p->best_error,
                                                        .y = p->best_seconds,
                                                        .count = p->best_count};
}

/* A method's rows stand one after the other. What auto has chosen is written where it changes. */
static void add_methods(struct picture *p, const struct accuracy_table *table)
{
    size_t end;
    for (size_t begin = 0; begin < table->count; begin = end) {
        const struct integrator *method = table->rows[begin].method;
        int mark = 1;
        for (size_t i = 1; i < p->series_count; i++)
            mark += p->series[i].colour == colour_of(method);
        for (end = begin; end < table->count && table->rows[end].method == method; end++) {
            const struct accuracy_row *row = &table->rows[end];
            p->error[end] = row->error;
            p->seconds[end] = row->seconds;
            p->choice[end] = end > begin && !strcmp(row->chose, (row - 1)->chose) ? "" : row->chose;
        }
        p->series[p->series_count++] = (struct plot_series){
            .name = method->name,
            .style = method->choose ? PLOT_POINTS : PLOT_CURVE,
            .colour = colour_of(method),
            .mark = method->choose ? PLOT_RING : mark,
            .x = p->error + begin,
            .y = p->seconds + begin,
            .label = method->choose ? p->choice + begin : NULL,
            .count = end - begin};
    }
}

/* Series and numbers of the pictures: a curve for each order. What is the reference has no error,
 * and no place on the axis. */
struct pictures {
    double mean[PRICE_PICTURES_MAX], seconds[PRICE_PICTURES_MAX];
    char name[PRICE_PICTURES_MAX][16];
    const char *label[PRICE_PICTURES_MAX];
    struct plot_series series[SCENE_ORDER_LIST + 1];
    size_t count; /* of series */
};

static void add_pictures(struct pictures *p, const struct price_pictures *pictures)
{
    for (size_t i = 0; i < pictures->count; i++) {
        const struct price_picture *row = &pictures->rows[i];
        p->mean[i] = row->mean;
        p->seconds[i] = row->seconds;
        snprintf(p->name[i], sizeof p->name[i], "%d x %d", row->samples, row->samples);
        p->label[i] = p->name[i];
        if (i % (size_t)pictures->samples == 0)
            p->series[p->count++] = (struct plot_series){.name = scene_order_names[row->order],
                                                         .style = PLOT_CURVE,
                                                         .x = p->mean + i,
                                                         .y = p->seconds + i,
                                                         .label = p->label + i,
                                                         .count = (size_t)pictures->samples,
                                                         .labels_below = row->order == SCENE_ORDER_NONE ||
                                                                         row->order == SCENE_ORDER_SORT};
    }
}

static enum status save(struct picture *picture, const struct price_table *table, const char *scene,
                        const char *path, struct error *err)
{
    char titles[2][128], errors[96];
    struct pictures pictures = {.count = 0};
    add_best(picture, &table->accuracy);
    add_methods(picture, &table->accuracy);
    add_pictures(&pictures, &table->pictures);
    snprintf(titles[0], sizeof titles[0], "What accuracy costs, until %.4g s", table->accuracy.span);
    snprintf(titles[1], sizeof titles[1], "What view.order and view.samples cost, in the picture at %.4g s",
             table->pictures.time);
    snprintf(errors, sizeof errors, "mean error of the channels, of 255, against list, %d x %d",
             table->pictures.samples, table->pictures.samples);
    const struct plot_panel panels[] = {{.title = titles[0],
                                         .x_label = "RMS error of positions, in mean radii",
                                         .y_label = "seconds on one core",
                                         .log_x = true,
                                         .log_y = true,
                                         .key_outside = true,
                                         .series = picture->series,
                                         .series_count = picture->series_count},
                                        {.title = titles[1],
                                         .x_label = errors,
                                         .y_label = "seconds a frame, of all threads",
                                         .log_x = true,
                                         .log_y = true,
                                         .key_outside = true,
                                         .series = pictures.series,
                                         .series_count = pictures.count}};
    const struct plot plot = {.title = scene,
                              .panels = panels,
                              .panel_count = pictures.count ? 2 : 1,
                              .columns = 1,
                              .width = 1000,
                              .height = 560};
    return plot_save(&plot, path, err);
}

enum status price_plot(const struct price_table *table, const char *scene, const char *path,
                       struct error *err)
{
    size_t methods = 0;
    while (integrators[methods])
        methods++;
    struct picture picture = {0};
    enum status status = make(&picture, table->accuracy.count + 1, methods)
                             ? save(&picture, table, scene, path, err)
                             : error_no_memory(err, path);
    clear(&picture);
    return status;
}
