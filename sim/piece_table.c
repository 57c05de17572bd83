#include "sim/piece_table.h"
#include "common/array.h"
#include "common/file.h"
#include "common/vec3.h"
#include "sim/measure.h"

#include <stdlib.h>
#include <string.h>

/* What is added up about a piece, about its centre: angular momentum, and mass x products of the
 * places (its second moments). */
struct sums {
    double angular[3], moment[3][3];
};

struct making {
    struct sim *sim;
    struct piece_table table;
    uint32_t *at;   /* [edge_count] at a piece's edge (sim_piece_of()): its place in the table */
    double *around; /* [point_count] area at rest of the point's active triangles */
    struct sums *sums;
};

static struct piece *piece_at(struct making *m, uint32_t triangle)
{
    return &m->table.items[m->at[sim_piece_of(m->sim, triangle)]];
}

/* Counts the pieces, in the order of their first triangles; where there is a table, begins their rows. */
static void number_pieces(struct making *m)
{
    struct sim *sim = m->sim;
    size_t balloon = 0;
    memset(m->at, 0xff, sim->edge_count * sizeof *m->at);
    m->table.count = 0;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        while (t >= sim->balloons[balloon].triangle_end)
            balloon++;
        if (!sim->triangle_active[t])
            continue;
        uint32_t *at = &m->at[sim_piece_of(sim, t)];
        if (*at != MESH_NONE)
            continue;
        *at = m->table.count++;
        if (m->table.items)
            m->table.items[*at] = (struct piece){.number = t, .balloon = balloon};
    }
}

static void measure_areas(struct making *m)
{
    const struct sim *sim = m->sim;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        if (!sim->triangle_active[t])
            continue;
        struct piece *piece = piece_at(m, t);
        const double rest = sim_rest_area(sim, t);
        piece->triangles++;
        piece->rest_area += rest;
        piece->area += sim_area(sim, t);
        for (int k = 0; k < 3; k++)
            m->around[sim->triangle_point[t][k]] += rest;
    }
}

/* The mass that a corner brings to its triangle's piece. */
static double mass_of(const struct making *m, uint32_t triangle, int corner)
{
    const uint32_t p = m->sim->triangle_point[triangle][corner];
    return m->around[p] > 0 ? m->sim->mass[p] * (sim_rest_area(m->sim, triangle) / m->around[p]) : 0;
}

static void measure_motion(struct making *m)
{
    const struct sim *sim = m->sim;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++) {
            struct piece *piece = piece_at(m, t);
            const uint32_t p = sim->triangle_point[t][k];
            const double mass = mass_of(m, t, k);
            piece->mass += mass;
            for (int i = 0; i < 3; i++) {
                piece->centre[i] += mass * sim->position[p][i];
                piece->velocity[i] += mass * sim->velocity[p][i];
            }
        }
    for (struct piece *piece = m->table.items; piece < m->table.items + m->table.count; piece++)
        for (int i = 0; i < 3 && piece->mass > 0; i++) {
            piece->centre[i] /= piece->mass;
            piece->velocity[i] /= piece->mass;
        }
}

static void measure_turning(struct making *m)
{
    const struct sim *sim = m->sim;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++) {
            const struct piece *piece = piece_at(m, t);
            struct sums *sums = &m->sums[piece - m->table.items];
            const uint32_t p = sim->triangle_point[t][k];
            const double mass = mass_of(m, t, k);
            double arm[3], way[3], cross[3];
            vec3_sub(sim->position[p], piece->centre, arm);
            vec3_sub(sim->velocity[p], piece->velocity, way);
            vec3_cross(arm, way, cross);
            for (int i = 0; i < 3; i++) {
                sums->angular[i] += mass * cross[i];
                for (int j = 0; j < 3; j++)
                    sums->moment[i][j] += mass * arm[i] * arm[j];
            }
        }
}

/* I = tr M - M, M the sum of m x x^T. On a line along u, M = s u u^T and I is s across it and 0 along it: I w
 * = L with w across is w = L/s, s = tr I/2. */
static void turn(struct piece *piece, const struct sums *sums)
{
    double inertia[3][3], across[3][3];
    const double trace = sums->moment[0][0] + sums->moment[1][1] + sums->moment[2][2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inertia[i][j] = (i == j ? trace : 0) - sums->moment[i][j];
    for (int i = 0; i < 3; i++)
        vec3_cross(inertia[(i + 1) % 3], inertia[(i + 2) % 3], across[i]);
    const double determinant = vec3_dot(inertia[0], across[0]);
    const bool line = !(determinant > 1e-12 * trace * trace * trace);
    for (int i = 0; i < 3 && trace > 0; i++)
        if (line)
            piece->spin[i] = sums->angular[i] / trace;
        else
            for (int j = 0; j < 3; j++)
                piece->spin[i] += across[j][i] * sums->angular[j] / determinant;
}

static int larger_first(const void *one, const void *other)
{
    const struct piece *a = one, *b = other;
    if (a->rest_area != b->rest_area)
        return a->rest_area < b->rest_area ? 1 : -1;
    return a->number < b->number ? -1 : 1;
}

static enum status make_rows(struct making *m, struct error *err)
{
    sim_find_pieces(m->sim);
    number_pieces(m);
    m->table.items = array_new(m->table.count, sizeof *m->table.items);
    m->sums = calloc(m->table.count + 1, sizeof *m->sums);
    if (!m->table.items || !m->sums)
        return error_no_memory(err, "the table of pieces");
    number_pieces(m);
    measure_areas(m);
    measure_motion(m);
    measure_turning(m);
    for (uint32_t i = 0; i < m->table.count; i++)
        turn(&m->table.items[i], &m->sums[i]);
    qsort(m->table.items, m->table.count, sizeof *m->table.items, larger_first);
    return STATUS_OK;
}

enum status piece_table_make(struct sim *sim, struct piece_table *table, struct error *err)
{
    struct making m = {.sim = sim,
                       .at = array_new(sim->edge_count, sizeof *m.at),
                       .around = calloc(sim->point_count, sizeof *m.around)};
    enum status status = m.at && m.around ? make_rows(&m, err) : error_no_memory(err, "the table of pieces");
    free(m.at);
    free(m.around);
    free(m.sums);
    if (status)
        piece_table_clear(&m.table);
    else
        *table = m.table;
    return status;
}

void piece_table_clear(struct piece_table *table)
{
    free(table->items);
    *table = (struct piece_table){0};
}

enum status piece_table_save(const struct piece_table *table, const char *path, struct error *err)
{
    struct file_out *out = NULL;
    enum status status = file_out_open(path, &out, err);
    if (status)
        return status;
    FILE *stream = file_out_stream(out);
    fputs("piece\tballoon\ttriangles\trest_area\tarea\tmass\tcentre_x\tcentre_y\tcentre_z\t"
          "velocity_x\tvelocity_y\tvelocity_z\tspin_x\tspin_y\tspin_z\n",
          stream);
    for (const struct piece *p = table->items; p < table->items + table->count; p++) {
        fprintf(stream, "%u\t%zu\t%u\t%.9g\t%.9g\t%.9g", p->number, p->balloon, p->triangles, p->rest_area,
                p->area, p->mass);
        const double *const vectors[] = {p->centre, p->velocity, p->spin};
        for (int v = 0; v < 3; v++)
            for (int i = 0; i < 3; i++)
                fprintf(stream, "\t%.9g", vectors[v][i]);
        fputc('\n', stream);
    }
    return file_out_commit(out, err);
}
