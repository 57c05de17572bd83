#include "sim/ledger.h"
#include "common/array.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/membrane.h"

#include <stdlib.h>
#include <string.h>

/* Sums are over this many shares of the points or edges, whoever works on them: equal to the bit for
 * any number of threads. */
enum { SHARES = 64 };

struct sum {
    const struct sim *sim;
    double (*power)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t index);
    const struct sim_balloon *balloon;
    uint32_t begin, end;
    double share[SHARES];
};

static void sum_share(void *context, size_t index, unsigned worker)
{
    (void)worker;
    struct sum *sum = context;
    const uint64_t count = sum->end - sum->begin;
    const uint32_t end = sum->begin + (uint32_t)(count * (index + 1) / SHARES);
    double power = 0;
    for (uint32_t i = sum->begin + (uint32_t)(count * index / SHARES); i < end; i++)
        power += sum->power(sum->sim, sum->balloon, i);
    sum->share[index] = power;
}

static double total(struct sim *sim, struct sum sum)
{
    double whole = 0;
    sum.sim = sim;
    threads_run(sim->pool, SHARES, sum_share, &sum);
    for (int i = 0; i < SHARES; i++)
        whole += sum.share[i];
    return whole;
}

/* Of the force P along the normal n: P n . v. */
static double pressure_power(const struct sim *sim, const struct sim_balloon *balloon, uint32_t p)
{
    return sim_point_pressure(balloon) * vec3_dot(sim->normal[p], sim->velocity[p]);
}

/* A damper's force k_d v . l/|l| along the edge, against the closing speed v . l/|l|: what it
 * takes is never negative. */
static double damper_power(const struct sim *sim, const struct sim_balloon *balloon, uint32_t e)
{
    if (!sim->edge_active[e])
        return 0;
    double l[3], v[3];
    vec3_sub(sim->position[sim->edge_point[e][0]], sim->position[sim->edge_point[e][1]], l);
    vec3_sub(sim->velocity[sim->edge_point[e][0]], sim->velocity[sim->edge_point[e][1]], v);
    const double along = vec3_dot(v, l), squared = vec3_dot(l, l);
    return squared > 0 ? balloon->now->damping * along * along / squared : 0;
}

void ledger_rates(struct sim *sim)
{
    double *rate = &sim->scalar_rate[sim->ledger.first];
    rate[LEDGER_PRESSURE] = rate[LEDGER_DISSIPATED] = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        rate[LEDGER_PRESSURE] += total(
            sim, (struct sum){
                     .power = pressure_power, .balloon = b, .begin = b->point_begin, .end = b->point_end});
        rate[LEDGER_DISSIPATED] += total(
            sim,
            (struct sum){.power = damper_power, .balloon = b, .begin = b->edge_begin, .end = b->edge_end});
    }
    effects_power(sim, &rate[LEDGER_DISSIPATED], &rate[LEDGER_PRESSURE]);
}

double ledger_elastic(const struct sim *sim, uint32_t begin, uint32_t end)
{
    double energy = 0;
    for (uint32_t e = begin; e < end; e++)
        if (sim->edge_active[e])
            energy += sim_spring_energy(sim, e);
    return energy;
}

static double kinetic(const struct sim *sim)
{
    double energy = 0;
    for (uint32_t p = 0; p < sim->point_count; p++)
        energy += sim->mass[p] * vec3_dot(sim->velocity[p], sim->velocity[p]) / 2;
    return energy;
}

/* What all points move with and what holds them: kinetic and elastic energy of the present state. */
static double energy_of(struct sim *sim)
{
    double energy = kinetic(sim) + ledger_elastic(sim, 0, sim->edge_count) + effects_energy(sim);
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (b->membrane)
            energy += membrane_elastic(sim, b);
    return energy;
}

void ledger_note(struct sim *sim)
{
    if (!sim->ledger.on || sim->ledger.noted)
        return;
    sim->ledger.before = energy_of(sim);
    sim->ledger.noted = true;
}

void ledger_book(struct sim *sim, bool moved)
{
    if (sim->ledger.noted && moved)
        sim->ledger.account.contact += sim->ledger.before - energy_of(sim);
    sim->ledger.noted = false;
}

void ledger_begin(struct sim *sim)
{
    sim->ledger.account = (struct sim_account){.begin = energy_of(sim)};
    for (uint32_t i = 0; i < LEDGER_SCALARS; i++)
        sim->scalar[sim->ledger.first + i] = 0;
}

/* To where what effects have left is kept, or back. */
static void copy_left(struct sim *sim, bool back)
{
    struct sim_ledger *ledger = &sim->ledger;
    const size_t count = effects_left(sim, ledger->left);
    unsigned char *kept = ledger->kept;
    for (size_t i = 0; i < count; i++) {
        void *left = ledger->left[i].data;
        memcpy(back ? left : kept, back ? kept : left, ledger->left[i].size);
        kept += ledger->left[i].size;
    }
}

void ledger_forces(struct sim *sim)
{
    const uint64_t evaluations = sim->evaluations; /* by which auto chooses */
    copy_left(sim, false);
    sim_forces(sim);
    copy_left(sim, true);
    sim->evaluations = evaluations;
}

static enum status make_room(struct sim *sim, struct error *err)
{
    struct sim_ledger *ledger = &sim->ledger;
    size_t size = 0;
    ledger->left = array_new(sim->hook_count[EFFECT_FORCES] * EFFECT_BLOCKS_MAX, sizeof *ledger->left);
    const size_t count = ledger->left ? effects_left(sim, ledger->left) : 0;
    for (size_t i = 0; i < count; i++)
        size += ledger->left[i].size;
    ledger->kept = ledger->left ? array_new(size, 1) : NULL;
    return ledger->kept ? STATUS_OK : error_no_memory(err, "the accounts of energy");
}

void ledger_close(struct sim *sim)
{
    free(sim->ledger.left);
    free(sim->ledger.kept);
    sim->ledger = (struct sim_ledger){0};
}

enum status ledger_open(struct sim *sim, struct error *err)
{
    if (sim->ledger.on)
        return STATUS_OK;
    ledger_close(sim); /* of an attempt that failed */
    enum status status = make_room(sim, err);
    if (!status)
        status = sim_add_scalars(sim, LEDGER_SCALARS, &sim->ledger.first, err);
    if (status)
        return status;
    sim->ledger.on = true;
    ledger_begin(sim);
    return STATUS_OK;
}

struct ledger_balance ledger_balance(struct sim *sim, const struct sim_measures *m)
{
    const struct sim_ledger *ledger = &sim->ledger;
    struct ledger_balance b = {0};
    if (!ledger->on)
        return b;
    b.gas = effects_energy(sim);
    b.dissipated = sim->scalar[ledger->first + LEDGER_DISSIPATED] + ledger->account.contact +
                   ledger->account.let_go;
    b.fracture = ledger->account.fracture;
    b.pressure_work = sim->scalar[ledger->first + LEDGER_PRESSURE];
    b.user_work = ledger->account.user;
    b.error = m->kinetic_energy + m->elastic_energy + b.gas + b.dissipated + b.fracture -
              ledger->account.begin - b.pressure_work - b.user_work;
    return b;
}
