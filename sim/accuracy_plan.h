/* What accuracy_measure() goes by, in the order in which it comes to know it. */
#ifndef SIM_ACCURACY_PLAN_H
#define SIM_ACCURACY_PLAN_H

#include "sim/accuracy_run.h"

/* Shares of options->seconds: for the first run, each reference, all ladders, all ensembles. */
#define ACCURACY_FIRST_SHARE     0.1
#define ACCURACY_REFERENCE_SHARE 0.1
#define ACCURACY_LADDERS_SHARE   0.4
#define ACCURACY_BURSTS_SHARE    0.3

/* What progress tells when the first run is over, and when the references are there. */
#define ACCURACY_FIRST_DONE      0.1
#define ACCURACY_REFERENCES_DONE 0.3

struct accuracy_plan {
    struct accuracy_subject subject;
    struct accuracy_table *table;
    size_t methods;    /* in the table of integrators */
    double evaluation; /* s: what one takes */
    double stable;     /* s: the largest step that is surely stable for symplectic-euler */
    double reach;      /* s: until when runs can be compared at all */
    double tightest;   /* tolerance that has worked for a reference; 0: none has been tried yet */
    /* Steps of the scene's from one of the subject's times to the next; 0: it is a part of one. */
    uint32_t quarter;
    double step; /* s: the scene's, or a little less when quarter is 0 */
    struct accuracy_states reference;
};

/* The first run: when something breaks, and what an evaluation takes (accuracy_span.c). */
enum status accuracy_find_reach(struct accuracy_plan *plan, struct error *err);

/* The span: as much of `reach` as whole steps and the time that there is allow. */
void accuracy_set_span(struct accuracy_plan *plan);

/* Makes plan->reference by two methods of different families (accuracy_reference.c); shortens the span
 * when something breaks. */
enum status accuracy_find_reference(struct accuracy_plan *plan, struct error *err);

/* An ensemble for each method that has rows (accuracy_burst.c). */
enum status accuracy_find_bursts(struct accuracy_plan *plan, struct error *err);

/* How one of the methods is run with a step or a tolerance, whichever it goes by. */
struct accuracy_dials accuracy_dials_of(const struct accuracy_plan *plan, const struct integrator *method,
                                        double dial);
bool accuracy_goes_by_tolerance(const struct integrator *method);

#endif
