/*
 * A run kept in a file, to be gone on with later: to the bit as if it had never stopped.
 *
 *     if (checkpoint_save(&sim, &run, "run.ck", err)) ...           between two steps; replaces the file when all is written
 *
 *     if (sim_open(&sim, &scene, ...)) ...                          in another process: the same scene and mesh
 *     if (checkpoint_load("run.ck", &sim, &run, err)) ...           and any number of threads
 *     free(run.rows);
 *
 * What goes into the file is what sim_blocks() lists, integrators' and effects' state included, and the
 * scene's keys and a fingerprint of what its meshes became, by which another scene is refused. checkpoint.c
 * says how the file is made up.
 */
#ifndef SIM_CHECKPOINT_H
#define SIM_CHECKPOINT_H

#include "sim/sim.h"

enum { CHECKPOINT_VERSION = 1 };

/* What a run is besides its state. */
struct checkpoint_run {
    double first_break; /* s; -1: nothing has broken */
    double seconds;     /* that it took so far */
    uint64_t shown;     /* states that became frames */
    char *rows;         /* [row_bytes] of the log so far; owned by whoever has the struct */
    size_t row_bytes;
};

/* Writes the run and its state. Errors: STATUS_FILE; the file that was there is then as it
 * was. STATUS_NO_MEMORY. */
enum status checkpoint_save(struct sim *sim, const struct checkpoint_run *run, const char *path,
                            struct error *err);

/* Puts the state of a file into a sim that is open for the same scene. Fills *run, whose rows are then the
 * caller's to free. A ledger that is open here and was not there begins at the state that was loaded. Errors:
 * STATUS_FILE, STATUS_NO_MEMORY, STATUS_INPUT: which chunk is damaged, or what about scene or mesh differs;
 * sim is then only good for sim_clear(). */
enum status checkpoint_load(const char *path, struct sim *sim, struct checkpoint_run *run, struct error *err);

/* The scene's keys, as a text to be freed; NULL: not enough memory. And a fingerprint of all that sim_open()
 * made of the meshes and that never changes. Both are for the two above. */
char *checkpoint_keys(const struct sim *sim);
uint64_t checkpoint_fingerprint(const struct sim *sim);

#endif
