/* What a scene can call for beyond springs and pressure (effects.c). */
#ifndef SIM_EFFECT_H
#define SIM_EFFECT_H

#include "common/scene.h"
#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sim;
struct sim_balloon;
struct sim_block;
struct sim_part;
struct guard_rows;
struct reorder;

/* When an effect's hook runs. */
enum effect_phase {
    EFFECT_OPEN,       /* nothing but `open`, ahead of all others, which go by what it makes of the tables */
    EFFECT_FORCES,     /* adds to sim->force and sim->scalar_rate at the current state */
    EFFECT_MOVED,      /* once the points have moved, before anything breaks: corrects how they did */
    EFFECT_AFTER_STEP, /* at the end of each accepted step */
    EFFECT_PHASES,
};

/* Something that a scene can call for, beyond springs and pressure (effects.c). */
struct effect {
    const char *name; /* of the scene's block, or key, that calls for it */
    enum effect_phase phase;
    /* One of them: whether a balloon's block calls for it, which makes a hook a balloon; or the scene's,
     * which makes one hook whose balloon is the first. */
    bool (*wanted)(const struct scene_balloon *balloon);
    bool (*scene_wanted)(const struct scene *scene);
    /* Makes what the effect keeps for a balloon, when the tables are complete and before any hook; frees it,
     * also where that failed. NULL: nothing. */
    enum status (*open)(struct sim *sim, struct sim_balloon *balloon, struct error *err);
    void (*close)(struct sim *sim, struct sim_balloon *balloon);
    void (*apply)(struct sim *sim, struct sim_balloon *balloon); /* NULL: nothing that a kernel does not do */
    /* EFFECT_FORCES, after apply: adds to the forces on a part's points, on that part's worker, and
     * looks at nothing of other parts that moves: their points may be on their way already. Once for
     * each hook. NULL: nothing. */
    void (*finish)(struct sim *sim, const struct sim_balloon *balloon, const struct sim_part *part);
    /* EFFECT_MOVED: corrects sim->position and velocity after a step from sim->before;
     * says so by sim->changed. */
    enum status (*settle)(struct sim *sim, struct error *err);
    /* EFFECT_FORCES: at the end of each accepted step too. NULL: nothing. */
    void (*after)(struct sim *sim, struct sim_balloon *balloon);
    /* The moment, s, at which it changes by itself, and a step must end of a method that chooses its steps.
     * NULL, or what is over: none. */
    double (*due)(const struct sim_balloon *balloon);
    /* What it remembers from step to step beyond sim->scalar, as blocks; returns how many. NULL: nothing. */
    size_t (*blocks)(struct sim *sim, struct sim_balloon *balloon, struct sim_block *blocks);
    /* EFFECT_FORCES: what apply leaves for `after` to go by, as blocks; returns how many. NULL: nothing. */
    size_t (*left)(struct sim *sim, struct sim_balloon *balloon, struct sim_block *blocks);
    /* EFFECT_FORCES: a cut has made a copy of a point of the balloon, which has taken the part `share` of
     * its mass: what acts on the one acts on both. NULL: nothing is kept by points, or it is found anew. */
    void (*copied)(struct sim *sim, struct sim_balloon *balloon, uint32_t point, uint32_t copy, double share);
    /* Points of a balloon get other numbers (reorder.h): what it keeps by them follows. NULL: nothing. */
    void (*reorder)(struct sim *sim, struct sim_balloon *balloon, const struct reorder *reorder);
    /* After a step, whether it can go on: STATUS_DIVERGED with the reason. NULL: always. */
    enum status (*check)(struct sim *sim, struct sim_balloon *balloon, struct error *err);
    /* For the ledger: what it holds now; and what it takes a second for good (dissipated) and brings from
     * outside (work), at the current state, each added. NULL: nothing. */
    double (*energy)(struct sim *sim, struct sim_balloon *balloon);
    /* The same as the step had it before anything let go in it. NULL: letting go took none of it. */
    double (*energy_before)(struct sim *sim, struct sim_balloon *balloon);
    void (*power)(struct sim *sim, struct sim_balloon *balloon, double *dissipated, double *work);
    /* Likewise: what goes for good as an active edge lets go or is cut, or an active
     * triangle goes. NULL: nothing. */
    double (*edge_energy)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t edge);
    double (*triangle_energy)(const struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle);
    /* EFFECT_FORCES: adds to df a K dx + b D dv (jacobian.h), the derivatives of its own forces at the
     * current state. NULL: its forces depend on neither positions nor velocities. */
    void (*product)(struct sim *sim, struct sim_balloon *balloon, double a, double (*dx)[4], double b,
                    double (*dv)[4], double (*df)[4]);
    /* EFFECT_FORCES: adds to rows (guard.h) by how much its forces on each point can change; guard_outdated()
     * when that is no longer true. NULL: they are constant, and do no work. */
    void (*bound)(const struct sim *sim, const struct sim_balloon *balloon, const struct guard_rows *rows);
    /* EFFECT_FORCES: the longest step, s, that follows what it moves beside the points, by what bounds have
     * just found: what flows between balloons, a weight, or the creep of viscous springs. NULL: any step
     * does. What that is, and why it is fast. */
    double (*follow)(const struct sim *sim, const struct sim_balloon *balloon);
    const char *follows, *follows_why;
    bool damps; /* EFFECT_FORCES: its forces depend on velocities */
    const char *source;
};
extern const struct effect *const effects[]; /* NULL-terminated */
enum { EFFECT_BLOCKS_MAX = 24 };             /* of one hook */

/* Whether the scene, or a balloon of it, calls for it; how many it calls for. */
bool effect_is_wanted(const struct effect *effect, const struct scene *scene);
size_t effects_count(const struct scene *scene);

/* An effect that this scene calls for, on one balloon. */
struct effect_hook {
    const struct effect *effect;
    struct sim_balloon *balloon;
};

/* Fills sim->hooks with what the scene calls for and opens it (STATUS_NO_MEMORY, or what an effect's open
 * says); closes it; runs the hooks of one phase. */
enum status effects_resolve(struct sim *sim, struct error *err);
void effects_close(struct sim *sim);
void effects_run(struct sim *sim, enum effect_phase phase);
enum status effects_settle(struct sim *sim, struct error *err); /* EFFECT_MOVED */

/* EFFECT_FORCES in two goes: all but what is left to finish, by hooks from the returned one on;
 * and that, of one part. */
size_t effects_begin_forces(struct sim *sim);
void effects_finish_forces(struct sim *sim, const struct sim_part *part, size_t first);

/* A cut has made a copy of a point of the balloon: all hooks of that balloon are told. */
void effects_copied(struct sim *sim, const struct sim_balloon *balloon, uint32_t point, uint32_t copy,
                    double share);

/* When the next of them changes by itself, s; INFINITY: none does. */
double effects_due(const struct sim *sim);

/* Of all effects together (struct effect): whether all can go on, their blocks, what forces have left (no
 * more than EFFECT_BLOCKS_MAX a hook), the energy that they hold, their powers, which are added, and what
 * goes with an edge or a triangle. */
enum status effects_check(struct sim *sim, struct error *err);
size_t effects_blocks(struct sim *sim, struct sim_block *blocks);
size_t effects_left(struct sim *sim, struct sim_block *blocks);
double effects_energy(struct sim *sim);
void effects_power(struct sim *sim, double *dissipated, double *work);
double effects_edge_energy(const struct sim *sim, uint32_t edge);
double effects_triangle_energy(const struct sim *sim, uint32_t triangle);

#endif
