/*
 * What accuracy costs on the user's own scene: every integrator over a ladder of steps or tolerances,
 * its error and its price.
 *
 *     struct accuracy_table table;
 *     if (accuracy_measure(&scene, meshes, &options, &table, err)) ...
 *     accuracy_fastest(&table, error, &method)
 *
 * A first run, by "auto", finds when the first edge lets go. Until shortly before, over the span, runs can be
 * compared point by point: with each other, and with two references of different families that know nothing
 * of each other. Afterwards only the mean of many runs says anything: an ensemble, which differs by 1e-9 of
 * the radius at the start, for each method at the scene's own step or tolerance.
 *
 * Errors are the largest of ACCURACY_TIMES moments, evenly spread over the span. Steps are 2^k times the
 * scene's, so that all of them meet these moments. Methods that choose their own steps are held by nothing
 * but their tolerance; the guard lets unstable steps go, so that the table shows where they are. Work
 * precision diagrams as these: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.10.
 *
 * Seconds are the thread's own time on a processor: other programs hardly add to them.
 */
#ifndef SIM_ACCURACY_H
#define SIM_ACCURACY_H

#include "sim/pricing.h"

enum {
    ACCURACY_TIMES = 4,
    ACCURACY_ROWS_MAX = 256,
    ACCURACY_LADDER_ROWS = 10,  /* of one method, at most */
    ACCURACY_FAILURES_MAX = 16, /* a line a method; a test holds that there are no more methods */
    ACCURACY_MEMBERS_LEAST = 4, /* of an ensemble */
    ACCURACY_MEMBERS = 8        /* at most */
};

/* Mean and standard deviation over an ensemble; NAN where there is none. */
struct accuracy_statistic {
    double mean, spread;
};

/* What an ensemble did. */
struct accuracy_burst {
    int members;                    /* 0: there was none */
    struct accuracy_statistic time, /* s: when one edge in a hundred had let go */
        pieces, largest; /* at table.burst_end: how many, and the largest's share of the area that is left */
};

struct accuracy_row {
    const struct integrator *method;
    char setting[64];            /* "time.step=0.0125", as --set takes it */
    double dial;                 /* that step or tolerance */
    uint64_t steps, evaluations; /* of sim_forces() */
    double linear_iterations;    /* each two products with the forces' derivatives */
    double seconds;              /* for the span */
    double error;                /* RMS over the points, in mean radii at rest */
    double
        order; /* by which it fell since the row before when steps became a tenth more; NAN: they did not */
    double volume, pressure, energy; /* relative errors; NAN: of nothing */
    bool best;                       /* no other row but one of auto has less of both error and seconds */
    char chose[48];                  /* auto: the method, and in how many substeps; else "" */
    struct accuracy_burst burst;
};

/* What a method did not manage. */
struct accuracy_failure {
    const struct integrator *method;
    char first[64], last[64]; /* of its settings that led to it */
    char reason[256];
};

struct accuracy_table {
    struct accuracy_row rows[ACCURACY_ROWS_MAX];
    size_t count;
    struct accuracy_failure failures[ACCURACY_FAILURES_MAX];
    size_t failure_count;
    double span;          /* s */
    char span_reason[64]; /* why no longer */
    double step;          /* s, the scene's */
    double longest_step;  /* s, of methods that choose their own */
    char reference[2][96];
    double agreement;   /* RMS distance of the references, in mean radii: no row is below ten times that */
    size_t left_out;    /* rows that would have been */
    double met;         /* s; when anything first turned skin back; INFINITY: nothing did */
    double first_break; /* s; INFINITY: nothing broke */
    double burst,
        burst_end; /* s: one edge in a hundred had let go; when pieces are counted; INFINITY: no ensembles */
};

/* meshes as for sim_open(). Errors: those of sim_open() and sim_step() for the first run and the
 * references, STATUS_INPUT where the scene ends before a step, STATUS_INTERRUPTED, STATUS_NO_MEMORY; what an
 * integrator of the table fails in is no error but a line of the table. */
enum status accuracy_measure(const struct scene *scene, const struct mesh *meshes,
                             const struct pricing_options *options, struct accuracy_table *table,
                             struct error *err);

/* How many seconds the fastest method but auto takes for an error, by straight lines between its rows on
 * logarithmic axes; *method becomes that one. Of rows whose steps are longer than the scene's none counts:
 * auto takes none, since edges let go at the ends of steps. INFINITY where nothing is that good. */
double accuracy_fastest(const struct accuracy_table *table, double error, const struct integrator **method);

#endif
