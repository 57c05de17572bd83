/*
 * A mesh a frame, for other programs: mesh_0000.ply, mesh_0001.ply, ... in a folder (or .vtp), each with its
 * points' stretch, opacity and piece, and mesh.ply.series, which tells ParaView their times.
 *
 *     struct mesh_series_options options = {.folder = "meshes"};
 *     if (mesh_series_open(&sim, &options, &series, err)) ...
 *     if (mesh_series_add(series, err)) ...        for each frame
 *     if (mesh_series_list(series, err)) ...       with each checkpoint
 *     if (mesh_series_close(series, &removed, err)) ...   always
 *
 * A mesh is whole or not there. With the first one those go that an earlier run has left there under the same
 * kind of name, from that number on, and its list: so that no meshes of two runs are ever together.
 */
#ifndef SIM_MESH_SERIES_H
#define SIM_MESH_SERIES_H

#include "sim/sim.h"

struct mesh_series;

struct mesh_series_options {
    const char *folder; /* made if missing */
    bool vtp;           /* in place of .ply */
    bool apart;         /* points are numbered alike in all frames (skin_mesh.h) */
    uint64_t first; /* number of the first mesh: those before it are of the same run, and stay in the list */
};

/* Whether a file of the folder that is called so may be of a series, and go with the next one. */
bool mesh_series_is_ply_name(const char *name);
bool mesh_series_is_vtp_name(const char *name);

/* `sim` is borrowed. Errors: STATUS_FILE, STATUS_NO_MEMORY, STATUS_RANGE. */
enum status mesh_series_open(struct sim *sim, const struct mesh_series_options *options,
                             struct mesh_series **series, struct error *err);

/* Writes the state as it is. Errors: STATUS_FILE, STATUS_NO_MEMORY. */
enum status mesh_series_add(struct mesh_series *series, struct error *err);

/* Writes the list of all meshes that are there so far, where there are any: with each checkpoint, so that a
 * run that is killed can be gone on with. NULL is fine. Errors: STATUS_FILE, STATUS_NO_MEMORY. */
enum status mesh_series_list(const struct mesh_series *series, struct error *err);

/* Writes the list of all meshes that are there, where there are any, and frees the series, whatever it
 * returns. *removed becomes the number of an earlier run's meshes that are gone. NULL is fine. Errors:
 * STATUS_FILE, STATUS_NO_MEMORY. */
enum status mesh_series_close(struct mesh_series *series, size_t *removed, struct error *err);

#endif
