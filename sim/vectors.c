#include "sim/vectors.h"

#include "common/threads.h"

#include <string.h>

struct operands {
    double (*y)[4], (*x)[4];
    double factor;
    const struct vector_term *terms;
    size_t count;
};

static void copy_part(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)sim;
    const struct operands o = *(struct operands *)context;
    memcpy(o.y[part->point_begin], o.x[part->point_begin],
           (part->point_end - part->point_begin) * sizeof *o.x);
}

void vector_copy(struct sim *sim, double (*to)[4], double (*from)[4])
{
    sim_each_part(sim, copy_part, &(struct operands){.y = to, .x = from});
}

void vector_keep_state(struct sim *sim, int row)
{
    vector_copy(sim, sim->scratch[row], sim->position);
    vector_copy(sim, sim->scratch[row + 1], sim->velocity);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar_scratch[row + 1][i] = sim->scalar[i];
}

void vector_return_to(struct sim *sim, int row)
{
    vector_copy(sim, sim->position, sim->scratch[row]);
    vector_copy(sim, sim->velocity, sim->scratch[row + 1]);
    for (uint32_t i = 0; i < sim->scalar_count; i++)
        sim->scalar[i] = sim->scalar_scratch[row + 1][i];
}

static void add_part(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)sim;
    const struct operands o = *(struct operands *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        for (int i = 0; i < 4; i++)
            o.y[p][i] += o.factor * o.x[p][i];
}

void vector_add(struct sim *sim, double (*y)[4], double factor, double (*x)[4])
{
    sim_each_part(sim, add_part, &(struct operands){.y = y, .x = x, .factor = factor});
}

static void combine_part(struct sim *sim, const struct sim_part *part, void *context)
{
    (void)sim;
    const struct operands o = *(struct operands *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        double sum[4] = {0};
        for (int i = 0; i < 4 && o.x; i++)
            sum[i] = o.x[p][i];
        for (size_t k = 0; k < o.count; k++)
            for (int i = 0; i < 4; i++)
                sum[i] += o.terms[k].factor * o.terms[k].rows[p][i];
        for (int i = 0; i < 4; i++)
            o.y[p][i] = sum[i];
    }
}

void vector_combine(struct sim *sim, double (*y)[4], double (*base)[4], const struct vector_term *terms,
                    size_t count)
{
    struct vector_term used[SIM_VECTORS_MAX];
    size_t used_count = 0;
    for (size_t k = 0; k < count && used_count < SIM_VECTORS_MAX; k++)
        if (terms[k].factor != 0)
            used[used_count++] = terms[k];
    sim_each_part(sim, combine_part,
                  &(struct operands){.y = y, .x = base, .terms = used, .count = used_count});
}

static void over_mass_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct operands o = *(struct operands *)context;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const double inverse = 1 / sim->mass[p];
        for (int i = 0; i < 4; i++)
            o.y[p][i] = o.x[p][i] * inverse;
    }
}

void vector_over_mass(struct sim *sim, double (*y)[4], double (*x)[4])
{
    sim_each_part(sim, over_mass_part, &(struct operands){.y = y, .x = x});
}

struct sum {
    struct sim *sim;
    double (*function)(const struct sim *sim, uint32_t begin, uint32_t end, void *context);
    void *context;
    uint32_t blocks;
};

static void sum_blocks(void *context, unsigned worker, unsigned workers)
{
    const struct sum *sum = context;
    const uint32_t points = sum->sim->point_count;
    const uint32_t first = (uint32_t)((uint64_t)sum->blocks * worker / workers),
                   last = (uint32_t)((uint64_t)sum->blocks * (worker + 1) / workers);
    for (uint32_t b = first; b < last; b++) {
        const uint32_t begin = b * VECTOR_BLOCK, left = points - begin;
        sum->sim->block_sum[b] = sum->function(
            sum->sim, begin, begin + (left < VECTOR_BLOCK ? left : VECTOR_BLOCK), sum->context);
    }
}

double vector_sum(struct sim *sim,
                  double (*function)(const struct sim *sim, uint32_t begin, uint32_t end, void *context),
                  void *context)
{
    struct sum sum = {sim, function, context, sim->point_count / VECTOR_BLOCK};
    sum.blocks += sim->point_count % VECTOR_BLOCK != 0;
    threads_each(sim->pool, sum_blocks, &sum);
    double total = 0;
    for (uint32_t b = 0; b < sum.blocks; b++)
        total += sim->block_sum[b];
    return total;
}

static double dot_block(const struct sim *sim, uint32_t begin, uint32_t end, void *context)
{
    (void)sim;
    const struct operands o = *(struct operands *)context;
    double sum[4] = {0};
    for (uint32_t p = begin; p < end; p++)
        for (int i = 0; i < 4; i++)
            sum[i] += o.y[p][i] * o.x[p][i];
    return sum[0] + sum[1] + sum[2];
}

double vector_dot(struct sim *sim, double (*a)[4], double (*b)[4])
{
    return vector_sum(sim, dot_block, &(struct operands){.y = a, .x = b});
}
