#include "sim/price_effects.h"
#include "common/plot.h"
#include "sim/price_file.h"

#include <inttypes.h>
#include <math.h>

static void print_row(const char *name, double share, double seconds, double bytes, const double change[3],
                      double first_break, uint32_t pieces, uint64_t steps, FILE *stream)
{
    fprintf(stream, "%s\t%.4g\t%.4g\t%.0f\t%.3e\t%.3e\t%.3e\t%.4g\t%" PRIu32 "\t%" PRIu64 "\n", name, share,
            seconds, bytes, change[0], change[1], change[2], first_break, pieces, steps);
}

static void print_table(const void *context, FILE *stream)
{
    const struct effect_cost_table *table = context;
    fputs("without\tshare\tseconds\tbytes\tposition\tvolume\tpressure\tfirst_break\tpieces\tsteps\n", stream);
    print_row("-", 1, table->seconds, (double)table->bytes, (double[3]){0}, table->first_break, table->pieces,
              table->steps, stream);
    for (size_t i = 0; i < table->count; i++) {
        const struct effect_cost_row *r = &table->rows[i];
        print_row(r->effect->name, r->share, r->seconds, r->bytes,
                  (double[3]){r->position, r->volume, r->pressure}, r->first_break, r->pieces, r->steps,
                  stream);
    }
    fprintf(
        stream,
        "# until %.4g s of %.4g; share: of the whole's time that the effect takes, or, below 0, of the time without it that it saves; "
        "seconds: a step on one core, the least of %d goes; bytes: that it takes\n"
        "# position (RMS, in radii), volume and pressure (relative, with the air's where there is gas): by how much the answer is another without it, "
        "at the most, until something breaks\n",
        table->span, table->end, table->goes);
    for (size_t i = 0; i < table->count; i++) {
        char text[1280];
        effect_cost_say(table, &table->rows[i], text, sizeof text);
        fprintf(stream, "# %s\n", text);
    }
}

/* Where the bars of changes stand, a decade below the least: there what changes nothing, but by rounding, has
 * none. */
static double least_change(const struct effect_cost_table *table)
{
    static const double rounding = 1e-12;
    double least = INFINITY;
    for (size_t i = 0; i < table->count; i++)
        if (!*table->rows[i].refused && table->rows[i].position > rounding)
            least = fmin(least, table->rows[i].position);
    return isfinite(least) ? pow(10, floor(log10(least)) - 1) : rounding;
}

/* Its name below a bar, with a star where the skin breaks otherwise without it: true there. */
static bool write_label(const struct effect_cost_table *table, const struct effect_cost_row *row,
                        char text[40])
{
    const bool otherwise = effect_cost_breaks_otherwise(table, row);
    snprintf(text, 40, "%s%s", row->effect->name, otherwise ? "*" : "");
    return otherwise;
}

/* Shares of the time, and beside them how much the answer changes. */
static enum status draw(const void *context, const char *scene, const char *path, struct error *err)
{
    const struct effect_cost_table *table = context;
    double share[EFFECT_COST_ROWS_MAX], change[EFFECT_COST_ROWS_MAX];
    char text[EFFECT_COST_ROWS_MAX][40];
    const char *name[EFFECT_COST_ROWS_MAX];
    const double least = least_change(table);
    bool starred = false, saved = false;
    size_t count = 0;
    for (size_t i = 0; i < table->count; i++)
        if (!*table->rows[i].refused) {
            starred |= write_label(table, &table->rows[i], text[count]);
            saved |= table->rows[i].share < 0;
            name[count] = text[count];
            share[count] = 100 * table->rows[i].share;
            change[count++] = fmax(table->rows[i].position, least);
        }
    const struct plot_series of_time = {
        .style = PLOT_BARS, .y = share, .label = name, .count = count, .colour = 1};
    const struct plot_series of_places = {
        .style = PLOT_BARS, .y = change, .label = name, .count = count, .colour = 2};
    const struct plot_panel panels[] = {
        {.title = "What each effect costs",
         .y_label = saved ? "% of the time; below 0: that it saves" : "% of the time",
         .from_zero = true,
         .series = &of_time,
         .series_count = 1},
        {.title = starred                        ? "What changes until it breaks; *: it breaks otherwise"
                  : isfinite(table->first_break) ? "What changes without it until the skin breaks"
                                                 : "What changes without it",
         .y_label = "RMS change of positions, in radii",
         .log_y = true,
         .series = &of_places,
         .series_count = 1}};
    const struct plot plot = {
        .title = scene, .panels = panels, .panel_count = 2, .columns = 2, .width = 500, .height = 420};
    return plot_save(&plot, path, err);
}

static enum status measure(const struct scene *scene, const struct mesh *meshes, void *table,
                           struct error *err)
{
    const struct pricing_options options = {
        .seconds = PRICE_SECONDS, .go_on = price_go_on, .goes_on = price_goes_on};
    return effect_cost_measure(scene, meshes, &options, table, err);
}

enum status price_effects_check(const struct scene *scene, const char *path, struct error *err)
{
    if (effects_count(scene) == 0)
        return error_set(err, STATUS_INPUT, "%s: has no effects: there is nothing to leave out", scene->path);
    return price_check(path, err);
}

enum status price_effects(const struct scene *scene, const struct mesh *meshes, const char *path,
                          struct error *err)
{
    static const struct price_kind kind = {sizeof(struct effect_cost_table), measure, print_table, draw};
    const enum status status = price_effects_check(scene, path, err);
    return status ? status : price_make(&kind, scene, meshes, path, err);
}
