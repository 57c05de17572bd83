/*
 * The pieces of torn skin as they are, with what moves them: a table for the end of a run.
 *
 *     struct piece_table table = {0};
 *     if (piece_table_make(&sim, &table, err)) ...
 *     if (piece_table_save(&table, "pieces.tsv", err)) ...
 *     piece_table_clear(&table);
 *
 * A piece is what hangs together by edges. Where skin is only dropped, as in the paper, two pieces may
 * still touch at a point: its mass is then shared out by their areas at rest around it. Points that carry
 * no skin belong to no piece.
 */
#ifndef SIM_PIECE_TABLE_H
#define SIM_PIECE_TABLE_H

#include "sim/sim.h"

struct piece {
    uint32_t number; /* of its first triangle: it stays as long as that one is there */
    uint32_t triangles;
    size_t balloon;
    double rest_area, area; /* length^2; at rest, and now */
    double mass;
    double centre[3];   /* of mass */
    double velocity[3]; /* of that centre, length/s: momentum over mass */
    /* Angular velocity, 1/s: w with I w = L, of angular momentum and moments of inertia about the centre.
     * What lies on one line has no moment around it, and there no spin. */
    double spin[3];
};

struct piece_table {
    struct piece *items; /* [count] the largest at rest first */
    uint32_t count;
};

/* Fills an empty table. Errors: STATUS_NO_MEMORY; then it stays empty. */
enum status piece_table_make(struct sim *sim, struct piece_table *table, struct error *err);
void piece_table_clear(struct piece_table *table);

/* Writes it as text: tabs between columns, a header, a line a piece. Errors: those of file_out. */
enum status piece_table_save(const struct piece_table *table, const char *path, struct error *err);

#endif
