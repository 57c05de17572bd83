#include "sim/pricing.h"

#include <time.h>

static enum status interrupted(struct error *err)
{
    return error_set(err, STATUS_INTERRUPTED, "interrupted; no table was made");
}

enum status pricing_ask(const struct pricing_options *options, double done, struct error *err)
{
    return !options->go_on || options->go_on(options->context, done) ? STATUS_OK : interrupted(err);
}

enum status pricing_step(const struct pricing_options *options, struct sim *sim, struct error *err)
{
    sim->goes_on = options->goes_on;
    const enum status status = sim_step(sim, err);
    return status == STATUS_INTERRUPTED ? interrupted(err) : status;
}

double pricing_now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}
