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
        "largest_piece\tlargest_piece_spread\n",
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
        fputc('\n', stream);
    }
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
    fprintf(stream, ", %.3g times better than the best row\n", best / table->agreement);
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
    if (isfinite(table->burst_end))
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
    const struct accuracy_table *table = context;
    print_rows(table, stream);
    print_span(table, stream);
    print_burst(table, stream);
    print_auto(table, stream);
    for (size_t i = 0; i < table->failure_count; i++)
        print_failure(&table->failures[i], stream);
}

static enum status measure(const struct scene *scene, const struct mesh *meshes, void *table,
                           struct error *err)
{
    const struct accuracy_options options = {.seconds = PRICE_SECONDS, .go_on = price_go_on};
    return accuracy_measure(scene, meshes, &options, table, err);
}

static enum status draw(const void *table, const char *scene, const char *path, struct error *err)
{
    return price_plot(table, scene, path, err);
}

enum status price_accuracy(const struct scene *scene, const struct mesh *meshes, const char *path,
                           struct error *err)
{
    static const struct price_kind kind = {sizeof(struct accuracy_table), measure, print_table, draw};
    return price_make(&kind, scene, meshes, path, err);
}
