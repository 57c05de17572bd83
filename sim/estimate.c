#include "sim/estimate.h"
#include "common/array.h"
#include "common/vec3.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMPANIONS = 2 };

/* Its rows are those as its last step began, where the method cannot look into its steps: [point_count],
 * owned; else NULL. */
struct companion {
    struct scene scene; /* the run's, with another tolerance; what it points to is the run's */
    struct sim sim;
    double (*position)[4], (*velocity)[4];
    double began; /* s */
};

struct estimate {
    struct companion companion[COMPANIONS];
    double radius;      /* mean distance of the points from the centre of their balloon, at rest */
    double work[2];     /* of the run and the first companion, until the first break */
    double worst;       /* error, in radii */
    double worst_at;    /* s */
    double worst_ratio; /* there: of the differences d1/d2 */
    bool over;          /* something broke */
};

/* So far. A product of the forces' derivatives takes about as long as the forces. */
static double work_of(const struct sim *sim)
{
    return (double)sim->evaluations + (double)sim->products;
}

static double mean_radius(const struct sim *sim)
{
    double sum = 0;
    for (size_t i = 0; i < sim->balloon_count; i++)
        sum += sim->balloons[i].radius * (sim->balloons[i].point_end - sim->balloons[i].point_begin);
    return sum / sim->point_count;
}

static enum status open_companion(struct companion *c, const struct mesh *meshes, unsigned workers,
                                  struct error *err)
{
    enum status status = sim_open(&c->sim, &c->scene, meshes, workers, err);
    if (status || c->sim.integrator->look)
        return status;
    c->position = array_new(c->sim.point_count, sizeof *c->position);
    c->velocity = array_new(c->sim.point_count, sizeof *c->velocity);
    return c->position && c->velocity ? STATUS_OK : error_no_memory(err, "the estimate");
}

enum status estimate_open(const struct sim *sim, const struct mesh *meshes, unsigned workers,
                          struct estimate **result, struct error *err)
{
    struct estimate *estimate = calloc(1, sizeof *estimate);
    if (!estimate)
        return error_no_memory(err, "the estimate");
    estimate->radius = mean_radius(sim);
    enum status status = STATUS_OK;
    for (int i = 0; i < COMPANIONS && !status; i++) {
        struct companion *c = &estimate->companion[i];
        c->scene = *sim->scene;
        c->scene.time.tolerance /= i == 0 ? 10 : 100;
        status = open_companion(c, meshes, workers, err);
        c->sim.finer = 2 << i;
    }
    if (status) {
        estimate_close(estimate);
        if (err)
            error_prefix(err, "--estimate");
        return status;
    }
    *result = estimate;
    return STATUS_OK;
}

void estimate_close(struct estimate *estimate)
{
    if (!estimate)
        return;
    for (struct companion *c = estimate->companion; c < estimate->companion + COMPANIONS; c++) {
        sim_clear(&c->sim);
        free(c->position);
        free(c->velocity);
    }
    free(estimate);
}

/* To `time`, or past it within a step: its steps may be split otherwise than the run's. */
static enum status catch_up(struct companion *c, double time, struct error *err)
{
    const size_t size = c->sim.point_count * sizeof *c->position;
    enum status status = STATUS_OK;
    while (!status && c->sim.time + (c->position ? 1e-6 * c->sim.step : 0) < time) {
        if (c->position) {
            memcpy(c->position, c->sim.position, size);
            memcpy(c->velocity, c->sim.velocity, size);
            c->began = c->sim.time;
        }
        status = sim_step(&c->sim, err);
    }
    if (status && err)
        error_prefix(err, "--estimate, with a finer step or tolerance");
    return status;
}

/* Places at `time`, by the cubic (Hermite's) through those at both ends of the companion's last step with the
 * speeds there: off by a 384th of the step's fourth power times the fourth derivative at the most, which a
 * method of fourth order is, too. */
static void place_at(const struct companion *c, double time, uint32_t p, double place[3])
{
    const double *x1 = c->sim.position[p], *v1 = c->sim.velocity[p], left = c->sim.time - time;
    memcpy(place, x1, 3 * sizeof *place);
    if (!c->position || left <= 1e-6 * c->sim.step)
        return;
    const double step = c->sim.time - c->began, s = 1 - left / step;
    for (int i = 0; i < 3; i++)
        place[i] += (1 + 2 * s) * (1 - s) * (1 - s) * (c->position[p][i] - x1[i]) +
                    step * s * (1 - s) * ((1 - s) * c->velocity[p][i] - s * v1[i]);
}

/* RMS distance of the points of two companions at `time`; or, without a first, of the run. */
static double distance(const struct sim *run, const struct companion *a, const struct companion *b,
                       double time)
{
    double squares = 0;
    for (uint32_t p = 0; p < b->sim.point_count; p++) {
        double x[3], y[3], d[3];
        place_at(b, time, p, y);
        if (a)
            place_at(a, time, p, x);
        vec3_sub(a ? x : run->position[p], y, d);
        squares += vec3_dot(d, d);
    }
    return sqrt(squares / b->sim.point_count);
}

enum status estimate_compare(struct estimate *e, const struct sim *sim, double *error, struct error *err)
{
    struct companion *c = e->companion;
    enum status status = STATUS_OK;
    *error = NAN;
    for (int i = 0; i < COMPANIONS && !e->over && !status; i++) {
        c[i].sim.goes_on = sim->goes_on;
        status = catch_up(&c[i], sim->time, err);
        e->over = sim->broken || c[i].sim.broken;
    }
    if (status || e->over)
        return status;
    for (int i = 0; i < COMPANIONS; i++)
        sim_look(&c[i].sim, sim->time);
    e->work[0] = work_of(sim);
    e->work[1] = work_of(&c[0].sim);
    const double d1 = distance(sim, NULL, &c[0], sim->time), d2 = distance(sim, &c[0], &c[1], sim->time);
    for (int i = 0; i < COMPANIONS; i++)
        sim_look_end(&c[i].sim);
    const double slowest = sqrt(2); /* half an order: what falls more slowly is round-off or chance */
    const double ratio = d2 > 0 ? fmax(d1 / d2, slowest) : INFINITY;
    *error = d1 / (1 - 1 / ratio) / e->radius;
    if (*error >= e->worst) {
        e->worst = *error;
        e->worst_at = sim->time;
        e->worst_ratio = d2 > 0 ? d1 / d2 : INFINITY;
    }
    return STATUS_OK;
}

/* An error that falls by the ratio when the work grows from the run's to the companion's falls with
 * that power of the work. */
void estimate_print(const struct estimate *e, FILE *stream)
{
    const double work = fmax(e->work[1] / e->work[0], 1); /* finer and yet quicker: solvers may be lucky */
    fprintf(stream, "position error %.2g of the radius", e->worst);
    if (e->worst == 0)
        fputs(": finer steps move no point by a bit", stream);
    else if (!(e->worst_ratio > 1.05) || !isfinite(e->worst_ratio))
        fputs("; finer steps do not bring it down", stream);
    else
        fprintf(stream, "; halving it would take %.1f x the time", pow(work, log(2) / log(e->worst_ratio)));
    if (e->worst > 0)
        fprintf(stream, " (at %g s%s)", e->worst_at, e->over ? ", its largest until the first break" : "");
    fputc('\n', stream);
}
