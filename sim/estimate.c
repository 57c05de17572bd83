#include "sim/estimate.h"
#include "common/vec3.h"

#include <math.h>
#include <stdlib.h>

enum { COMPANIONS = 2 };

struct companion {
    struct scene scene; /* the run's, with another tolerance; what it points to is the run's */
    struct sim sim;
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
        status = sim_open(&c->sim, &c->scene, meshes, workers, err);
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
    for (int i = 0; i < COMPANIONS; i++)
        sim_clear(&estimate->companion[i].sim);
    free(estimate);
}

/* To `time`, or to the step that is nearest to it where the method cannot look inside its steps. */
static enum status catch_up(struct companion *c, double time, struct error *err)
{
    enum status status = STATUS_OK;
    while (!status && c->sim.time + (c->sim.integrator->look ? 0 : c->sim.step / 2) < time)
        status = sim_step(&c->sim, err);
    if (status && err)
        error_prefix(err, "--estimate, with a finer step or tolerance");
    return status;
}

/* RMS distance of the points. */
static double distance(const struct sim *a, const struct sim *b)
{
    double squares = 0;
    for (uint32_t p = 0; p < a->point_count; p++) {
        double d[3];
        vec3_sub(a->position[p], b->position[p], d);
        squares += vec3_dot(d, d);
    }
    return sqrt(squares / a->point_count);
}

enum status estimate_compare(struct estimate *e, const struct sim *sim, double *error, struct error *err)
{
    struct companion *c = e->companion;
    enum status status = STATUS_OK;
    *error = NAN;
    for (int i = 0; i < COMPANIONS && !e->over && !status; i++) {
        status = catch_up(&c[i], sim->time, err);
        e->over = sim->broken || c[i].sim.broken;
    }
    if (status || e->over)
        return status;
    for (int i = 0; i < COMPANIONS; i++)
        sim_look(&c[i].sim, sim->time);
    e->work[0] = work_of(sim);
    e->work[1] = work_of(&c[0].sim);
    const double d1 = distance(sim, &c[0].sim), d2 = distance(&c[0].sim, &c[1].sim);
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
