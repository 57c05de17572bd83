#include "sim/price.h"
#include "sim/price_file.h"
#include "sim/price_plot.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static void print_rows(const struct accuracy_table *table, FILE *stream)
{
    fputs(
        "method\tsetting\tsteps\tevaluations\tseconds\terror\torder\tlinear_iterations\tvolume_error\t"
        "pressure_error\tenergy_error\tbest\tchose\tmembers\tburst_time\tburst_time_spread\tpieces\tpieces_spread\t"
        "largest_piece\tlargest_piece_spread\tpicture_mean\tpicture_worst\n",
        stream);
    for (size_t i = 0; i < table->count; i++) {
        const struct accuracy_row *r = &table->rows[i];
        const struct accuracy_burst *b = &r->burst;
        fprintf(stream,
                "%s\t%s\t%" PRIu64 "\t%" PRIu64 "\t%.4g\t%.3e\t%.2f\t%.0f\t%.3e\t%.3e\t%.3e\t%s\t%s\t%d",
                r->method->name, r->setting, r->steps, r->evaluations, r->seconds, r->error, r->order,
                r->linear_iterations, r->volume, r->pressure, r->energy, r->best ? "yes" : "no",
                *r->chose ? r->chose : "-", b->members);
        const double numbers[] = {b->time.mean,     b->time.spread,  b->pieces.mean,
                                  b->pieces.spread, b->largest.mean, b->largest.spread};
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
            fprintf(stream, b->members ? "\t%.4g" : "\tnan", numbers[k]);
        fputs("\tnan\tnan\n", stream);
    }
}

/* A picture has no steps; its error is the mean one, over 255. */
static void print_pictures(const struct price_pictures *pictures, FILE *stream)
{
    for (size_t i = 0; i < pictures->count; i++) {
        const struct price_picture *r = &pictures->rows[i];
        fprintf(stream, "picture\tview.order=%s view.samples=%d\t0\t0\t%.4g\t%.3e",
                scene_order_names[r->order], r->samples, r->seconds, r->mean / 255);
        fprintf(stream, "\tnan\t0\tnan\tnan\tnan\t%s\t-\t0\tnan\tnan\tnan\tnan\tnan\tnan\t%.4g\t%.0f\n",
                r->best ? "yes" : "no", r->mean, r->worst);
    }
}

static const struct price_picture *find_picture(const struct price_pictures *pictures, int order, int samples)
{
    const struct price_picture *row = pictures->rows;
    while (row->order != order || row->samples != samples)
        row++;
    return row;
}

static void say_picture(const char *before, const struct price_picture *r, FILE *stream)
{
    fprintf(stream, "%s%s, %d x %d: %.3g of 255 in the mean, %.0f at worst, %.3g ms", before,
            scene_order_names[r->order], r->samples, r->samples, r->mean, r->worst, 1e3 * r->seconds);
}

static void print_picture_prices(const struct price_pictures *pictures, FILE *stream)
{
    if (!pictures->count) {
        fprintf(stream, "# pictures: none was priced: %s\n", pictures->reason);
        return;
    }
    fprintf(
        stream,
        "# pictures: %d x %d at %.4g s; errors: of the channels of all pixels, against lists with %d x %d samples, "
        "exact in their order and the finest there are; seconds: a frame, of all threads\n",
        pictures->size[0], pictures->size[1], pictures->time, pictures->samples, pictures->samples);
    const int samples = pictures->own_samples < pictures->samples ? pictures->own_samples : pictures->samples;
    say_picture("# pictures: as the scene has it, ", find_picture(pictures, pictures->own_order, samples),
                stream);
    say_picture("; in exact order, ", find_picture(pictures, SCENE_ORDER_LIST, samples), stream);
    if (samples < 2 && pictures->samples >= 2)
        say_picture("; and smoother, ", find_picture(pictures, SCENE_ORDER_LIST, 2), stream);
    fputc('\n', stream);
}

static void print_span(const struct accuracy_table *table, FILE *stream)
{
    fprintf(
        stream,
        "# errors: the largest at %d times up to %.6g s (%s), positions in mean radii (RMS), others relative\n",
        ACCURACY_TIMES, table->span, table->span_reason);
    fputs("# all in double precision: single was measured, and made no step faster\n", stream);
    fprintf(stream, "# references: %s; %s: they agree to %.1e", table->reference[0], table->reference[1],
            table->agreement);
    double best = INFINITY;
    for (size_t i = 0; i < table->count; i++)
        best = fmin(best, table->rows[i].error);
    if (isfinite(best) && table->agreement > 0)
        fprintf(stream, ", %.3g times better than the best row", best / table->agreement);
    fputc('\n', stream);
    if (isfinite(table->met))
        fprintf(
            stream,
            "# skin is turned back from %.4g s on, at the ends of steps: what that is off goes with the step, "
            "by any method, and time.tolerance does not reach it; references agree on it but roughly\n",
            table->met);
    if (table->left_out)
        fprintf(stream, "# left out: %zu rows with errors below what the references or rounding can tell\n",
                table->left_out);
}

static void print_burst(const struct accuracy_table *table, FILE *stream)
{
    if (!isfinite(table->first_break))
        return;
    fprintf(stream, "# the first edge lets go at %.4g s: from there on single runs mean nothing\n",
            table->first_break);
    bool compared = false;
    for (size_t i = 0; i < table->count; i++)
        compared |= table->rows[i].burst.members > 0;
    if (!isfinite(table->burst_end))
        fprintf(stream, "# no burst is compared: fewer than one edge in a hundred let go in the first run\n");
    else if (!compared)
        fprintf(stream, "# no burst is compared: there is no time for %d runs by any method up to %.4g s\n",
                ACCURACY_MEMBERS_LEAST, table->burst_end);
    else
        fprintf(
            stream,
            "# burst: means over members that differ by 1e-9 radii at the start; its time is when one edge in a hundred "
            "had let go, pieces are counted at %.4g s\n",
            table->burst_end);
}

static void print_auto(const struct accuracy_table *table, FILE *stream)
{
    for (size_t i = 0; i < table->count; i++) {
        const struct accuracy_row *row = &table->rows[i];
        const struct integrator *fastest = NULL;
        if (!row->method->choose)
            continue;
        const double seconds = accuracy_fastest(table, row->error, &fastest);
        if (fastest)
            fprintf(
                stream,
                "# auto at %s (%s): %.2f x the time of the fastest that is as good in steps up to time.step, %s\n",
                row->setting, row->chose, row->seconds / seconds, fastest->name);
    }
}

static void print_failure(const struct accuracy_failure *f, FILE *stream)
{
    fprintf(stream, "# failed: %s at %s%s%s: %s\n", f->method->name, f->first,
            strcmp(f->first, f->last) ? " to " : "", strcmp(f->first, f->last) ? f->last : "", f->reason);
}

static void print_table(const void *context, FILE *stream)
{
    const struct price_table *prices = context;
    const struct accuracy_table *table = &prices->accuracy;
    print_rows(table, stream);
    print_pictures(&prices->pictures, stream);
    print_span(table, stream);
    print_burst(table, stream);
    print_auto(table, stream);
    print_picture_prices(&prices->pictures, stream);
    for (size_t i = 0; i < table->failure_count; i++)
        print_failure(&table->failures[i], stream);
}

static enum status measure(const struct scene *scene, const struct mesh *meshes, void *context,
                           struct error *err)
{
    struct price_table *prices = context;
    struct price_part runs = {0, 0.9}, pictures = {0.9, 1};
    struct pricing_options options = {
        .seconds = PRICE_SECONDS, .go_on = price_go_on, .context = &runs, .goes_on = price_goes_on};
    enum status status = accuracy_measure(scene, meshes, &options, &prices->accuracy, err);
    options.context = &pictures;
    if (!status)
        status = price_pictures_measure(scene, meshes, prices->accuracy.span, &options, &prices->pictures,
                                        err);
    return status;
}

static enum status draw(const void *table, const char *scene, const char *path, struct error *err)
{
    return price_plot(table, scene, path, err);
}

enum status price_accuracy(const struct scene *scene, const struct mesh *meshes, const char *path,
                           struct error *err)
{
    static const struct price_kind kind = {sizeof(struct price_table), measure, print_table, draw};
    return price_make(&kind, scene, meshes, path, err);
}
