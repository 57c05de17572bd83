#include "surface/cost.h"

#include "surface/census.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* No finer cubes are tried once a mesh took so long: the next would take twice as long. */
#define SECONDS_MOST 4.0

/* A setting is tried so often, unless that would take longer. */
enum { TURNS = 5 };
#define TURNS_SECONDS 0.3

static const int field_sides[] = {1, 2, 3, 4, 6, 8};
static const double cutoffs[] = {2, 2.5, 3, 4, 5, 6, 7};
static const unsigned relaxations[] = {0, 1, 2, 4, 10, 20, 40};
enum {
    CUBES = 8, /* from four times the options' size down, by the square root of two */
    FIELDS = sizeof field_sides / sizeof *field_sides,
    CUTOFFS = sizeof cutoffs / sizeof *cutoffs,
    RELAXATIONS = sizeof relaxations / sizeof *relaxations,
    STEPS = CUBES + FIELDS + CUTOFFS + RELAXATIONS + 1
};

const char *const cost_dial_names[COST_DIALS] = {"cube-size", "fields-per-cube", "cutoff", "relax"};

struct walk {
    const struct octree *tree;
    struct surface_options base;  /* with a cube size */
    struct surface_options exact; /* and with the exact field, cut off as far as can be */
    struct cost_table *table;
    bool own;                        /* the exact field has no surface: `exact` has the options' own fields */
    double area, volume;             /* of an infinitely fine mesh */
    double exact_area, exact_volume; /* of the exact field's mesh */
    int done;
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void tell(struct walk *w)
{
    w->done++;
    if (w->base.progress)
        w->base.progress(w->base.progress_context, (double)w->done / STEPS);
}

/* Makes a mesh and notes its price, the best of some turns where they are short: a machine that does
 * something else meanwhile bends the curves. Area and volume are still as they are, not errors. */
static enum status make(struct walk *w, const struct surface_options *options, struct mesh *mesh,
                        struct cost_row *row, struct error *err)
{
    struct surface_stats stats;
    struct surface_options quiet = *options;
    double begun = now();
    quiet.progress = NULL;
    row->seconds = INFINITY;
    for (int turn = 0; turn == 0 || (turn < TURNS && now() - begun < TURNS_SECONDS); turn++) {
        mesh_clear(mesh);
        double begin = now();
        if (surface_make(w->tree, &quiet, mesh, &stats, err))
            return err->status;
        row->seconds = fmin(row->seconds, now() - begin);
    }
    row->evaluations = stats.evaluations + stats.samples;
    row->bytes = stats.bytes;
    row->area = mesh_area(mesh);
    row->volume = mesh_volume(mesh);
    return STATUS_OK;
}

/* Adds a row for these options; none where they give no surface. */
static enum status add_row(struct walk *w, struct cost_row *row, const struct surface_options *options,
                           struct error *err)
{
    bool moves_surface = row->dial == COST_FIELDS || row->dial == COST_CUTOFF;
    struct mesh mesh = {0};
    struct surface_distance distance;
    tell(w);
    enum status status = make(w, options, &mesh, row, err);
    if (status == STATUS_INPUT || status == STATUS_RANGE)
        return STATUS_OK;
    if (status == STATUS_OK)
        status = surface_compare(w->tree, moves_surface ? &w->exact : options, &mesh, &distance, err);
    mesh_clear(&mesh);
    if (status != STATUS_OK)
        return status;
    row->rms = (moves_surface ? distance.point_rms : distance.rms) / w->table->extent;
    row->largest = (moves_surface ? distance.point_largest : distance.largest) / w->table->extent;
    w->table->rows[w->table->count++] = *row;
    return STATUS_OK;
}

static enum status walk_cubes(struct walk *w, struct error *err)
{
    struct cost_table *table = w->table;
    for (int i = 0; i < CUBES; i++) {
        struct surface_options options = w->base;
        struct cost_row row = {.dial = COST_CUBE_SIZE};
        options.cube_size *= exp2(2 - 0.5 * i);
        row.step = options.cube_size;
        snprintf(row.setting, sizeof row.setting, "%.4g", options.cube_size);
        if (add_row(w, &row, &options, err))
            return err->status;
        if (table->count >= 3 && table->rows[table->count - 1].seconds > SECONDS_MOST)
            break;
    }
    return STATUS_OK;
}

/* With second order an octave leaves a quarter of the error: what is left is a third of the difference. */
static void extrapolate(struct walk *w)
{
    const struct cost_table *table = w->table;
    const struct cost_row *fine = &table->rows[table->count - 1], *coarse = fine;
    for (size_t i = 0; i < table->count; i++)
        if (fabs(table->rows[i].step / fine->step - 2) < 0.01)
            coarse = &table->rows[i];
    w->area = fine->area + (fine->area - coarse->area) / 3;
    w->volume = fine->volume + (fine->volume - coarse->volume) / 3;
}

static enum status walk_fields(struct walk *w, struct error *err)
{
    for (int i = 0; i < FIELDS && !w->own; i++) {
        struct surface_options options = w->exact;
        struct cost_row row = {.dial = COST_FIELDS, .step = 1.0 / field_sides[i]};
        options.field.fields_per_cube = (long)field_sides[i] * field_sides[i] * field_sides[i];
        snprintf(row.setting, sizeof row.setting, "%ld", options.field.fields_per_cube);
        if (add_row(w, &row, &options, err))
            return err->status;
    }
    return STATUS_OK;
}

static enum status walk_cutoffs(struct walk *w, struct error *err)
{
    for (int i = 0; i < CUTOFFS; i++) {
        struct surface_options options = w->exact;
        struct cost_row row = {.dial = COST_CUTOFF};
        options.field.cutoff = cutoffs[i];
        snprintf(row.setting, sizeof row.setting, "%g", cutoffs[i]);
        if (add_row(w, &row, &options, err))
            return err->status;
    }
    return STATUS_OK;
}

static enum status walk_relaxations(struct walk *w, struct error *err)
{
    for (int i = 0; i < RELAXATIONS; i++) {
        struct surface_options options = w->base;
        struct cost_row row = {.dial = COST_RELAX};
        options.relax = relaxations[i];
        snprintf(row.setting, sizeof row.setting, "%u", relaxations[i]);
        if (add_row(w, &row, &options, err))
            return err->status;
    }
    return STATUS_OK;
}

/* From areas and volumes to their errors. */
static void compare(const struct walk *w)
{
    for (size_t i = 0; i < w->table->count; i++) {
        struct cost_row *row = &w->table->rows[i];
        bool moves_surface = row->dial == COST_FIELDS || row->dial == COST_CUTOFF;
        row->area = fabs(row->area / (moves_surface ? w->exact_area : w->area) - 1);
        row->volume = fabs(row->volume / (moves_surface ? w->exact_volume : w->volume) - 1);
    }
}

static double fit_order(const struct cost_table *table, enum cost_dial dial)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < table->count; i++) {
        const struct cost_row *row = &table->rows[i];
        if (row->dial != dial || !(row->step > 0) || !(row->rms > 0))
            continue;
        double u = log(row->step), v = log(row->rms);
        n++;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    double spread = n * xx - x * x;
    return n > 1 && spread > 0 ? (n * xy - x * y) / spread : (double)NAN;
}

/* The options' own mesh says which cube size they mean; the exact field's what there is to compare with. */
static enum status begin(struct walk *w, const struct surface_options *options, struct error *err)
{
    struct mesh mesh = {0};
    struct surface_stats stats;
    struct cost_row row = {0};
    w->base = *options;
    w->base.progress = NULL;
    if (surface_make(w->tree, &w->base, &mesh, &stats, err))
        return err->status;
    mesh_clear(&mesh);
    w->base.progress = options->progress;
    w->base.triangles = 0;
    w->base.cube_size = stats.cube_size;
    w->exact = w->base;
    w->exact.field.fields_per_cube = FIELDS_EXACT;
    w->exact.field.cutoff = 8;
    enum status status = make(w, &w->exact, &mesh, &row, err);
    if (status == STATUS_INPUT || status == STATUS_RANGE) {
        w->own = true;
        w->exact.field.fields_per_cube = options->field.fields_per_cube;
        status = make(w, &w->exact, &mesh, &row, err);
    }
    w->exact_area = row.area;
    w->exact_volume = row.volume;
    mesh_clear(&mesh);
    tell(w);
    return status;
}

enum status surface_cost(const struct octree *tree, const struct surface_options *options,
                         struct cost_table *table, struct error *err)
{
    struct walk w = {.tree = tree, .table = table};
    *table = (struct cost_table){.extent = ldexp(octree_measure(tree).extent, -(int)tree->depth)};
    if (begin(&w, options, err) || walk_cubes(&w, err))
        return err->status;
    extrapolate(&w);
    if (walk_fields(&w, err) || walk_cutoffs(&w, err) || walk_relaxations(&w, err))
        return err->status;
    compare(&w);
    for (int dial = 0; dial < COST_DIALS; dial++)
        table->order[dial] = fit_order(table, (enum cost_dial)dial);
    return STATUS_OK;
}

bool cost_recommend(const struct cost_table *table, enum cost_dial dial, double error, char setting[32])
{
    const struct cost_row *best = NULL, *finest = NULL;
    for (size_t i = 0; i < table->count; i++) {
        const struct cost_row *row = &table->rows[i];
        if (row->dial != dial)
            continue;
        finest = row;
        if (row->rms <= error && (!best || row->seconds < best->seconds))
            best = row;
    }
    if (best) {
        memcpy(setting, best->setting, sizeof best->setting);
        return true;
    }
    if (dial == COST_FIELDS && finest) /* else the exact field has no surface */
        strcpy(setting, "exact");
    else if (dial == COST_CUBE_SIZE && finest && table->order[dial] > 0)
        snprintf(setting, 32, "%.4g", finest->step * pow(error / finest->rms, 1 / table->order[dial]));
    else
        return false;
    return true;
}
