/*
 * The simulator: points, springs and dampers under pressure, until they burst. The paper's section 3.5.
 *
 *     if (sim_load_meshes(&scene, meshes, reports, err)) ...
 *     struct sim sim = {0};
 *     if (sim_open(&sim, &scene, meshes, err)) ...     allocates; the scene must outlive the sim
 *     while (sim.time < scene.time.end)
 *         if (sim_step(&sim, err)) ...                 never allocates; STATUS_DIVERGED names the point
 *     sim_clear(&sim);
 *
 * step.c is the method; open.c builds the tables that it works on; integrators.c and effects.c list what can be plugged
 * into it; measure.c and material.c look at the result.
 */
#ifndef SIM_SIM_H
#define SIM_SIM_H

#include "common/mesh.h"
#include "common/scene.h"
#include "common/status.h"

#include <stdbool.h>
#include <stdint.h>

struct sim;

/* One balloon's share of the tables, and the numbers that all its points and edges have in common. */
struct sim_balloon {
    const struct scene_balloon *scene;
    uint32_t point_begin, point_end;
    uint32_t edge_begin, edge_end;
    uint32_t triangle_begin, triangle_end;
    double centre[3];                        /* of its points, at rest */
    double radius;                           /* mean distance of its points from that centre, at rest */
    double mean_rest_length;                 /* of its edges */
    double spring_factor, damping, pressure; /* as the schedule has them now */
    double threshold_length;                 /* at which an edge lets go */
    bool ripped;                             /* the scene's rip has opened */
};

/* A method that moves the points (integrators.c). */
struct integrator {
    const char *name;
    int order; /* of the error in position at a fixed time */
    void (*advance)(struct sim *sim);
    const char *source;
};
extern const struct integrator *const integrators[]; /* NULL-terminated */
const struct integrator *integrator_find(const char *name);

/* When an effect's hook runs. */
enum effect_phase {
    EFFECT_OPEN,       /* once, when the tables are complete */
    EFFECT_AFTER_STEP, /* at the end of each accepted step */
    EFFECT_PHASES,
};

/* Something that a scene can call for, beyond springs and pressure (effects.c). */
struct effect {
    const char *name; /* of the scene's block that calls for it */
    enum effect_phase phase;
    bool (*wanted)(const struct scene_balloon *balloon);
    void (*apply)(struct sim *sim, struct sim_balloon *balloon);
    const char *source;
};
extern const struct effect *const effects[]; /* NULL-terminated */

/* An effect that this scene calls for, on one balloon. */
struct effect_hook {
    const struct effect *effect;
    struct sim_balloon *balloon;
};

struct sim {
    /* Points: the paper's table 1. Its acceleration is force / mass. */
    uint32_t point_count;
    double (
        *normal)[3]; /* [point_count] unit, outward; 0 where no triangle is left; by the last sim_forces() */
    double (*position)[3]; /* [point_count] length */
    double (*velocity)[3]; /* [point_count] length/s */
    double (*force)[3];    /* [point_count] by sim_forces() */
    double *mass;          /* [point_count] */

    /* Edges: table 2. */
    uint32_t edge_count;
    uint32_t (*edge_point)[2];    /* [edge_count] point1, point2 */
    double *rest_length;          /* [edge_count] */
    double *length;               /* [edge_count] by break_edges(); of a broken edge, when it broke */
    double *init_spring_const;    /* [edge_count] */
    double *current_spring_const; /* [edge_count] init_spring_const x the balloon's spring_factor */
    unsigned char *edge_active;   /* [edge_count] */

    /* Triangles: table 3, an array instead of a linked list. Opacity and shininess are sim_material()'s, for frames
     * that are drawn. */
    uint32_t triangle_count;
    uint32_t (*triangle_point)[3];  /* [triangle_count] counter-clockwise from outside */
    uint32_t (*triangle_edge)[3];   /* [triangle_count] */
    unsigned char *triangle_active; /* [triangle_count] */

    const struct scene *scene;
    struct sim_balloon *balloons; /* [balloon_count] */
    size_t balloon_count;

    const struct integrator *integrator;
    struct effect_hook
        *hooks[EFFECT_PHASES]; /* [hook_count[phase]] what this scene calls for, nothing else */
    size_t hook_count[EFFECT_PHASES];

    double time;          /* s: time_base + steps_since x step, so that it does not drift */
    double step;          /* s, as the schedule has it now */
    double time_base;     /* when the step last changed */
    uint64_t steps_since; /* steps taken since then */
    uint64_t steps;       /* in all */
    size_t next_change;   /* first entry of the schedule that is still to come */
    bool edges_broke;     /* since the triangles were last asked */
    uint32_t broken;      /* edges that have let go, in all */

    uint32_t *piece;    /* [edge_count] for sim_measure(): an edge of the same piece */
    double *piece_area; /* [edge_count] likewise: of the piece, at its root */
    size_t bytes;       /* of all the arrays here */
};

/* Reads the mesh of each balloon of a checked scene, repairs and connects it. meshes and reports have balloon_count
 * elements, empty; on failure they may be partly filled. Refuses (STATUS_INPUT, with the file's name) what cannot be
 * inflated: meshes that are open, no surface, or not consistently wound. An inside-out mesh is turned. */
enum status sim_load_meshes(const struct scene *scene, struct mesh *meshes, struct mesh_report *reports,
                            struct error *err);

/* Builds the tables for a checked scene; meshes[i] is balloon i's, connected (common/mesh.h). Errors: STATUS_NO_MEMORY,
 * STATUS_RANGE when all balloons together have more than 2^32 - 2 edges. On failure *sim is empty. */
enum status sim_open(struct sim *sim, const struct scene *scene, const struct mesh *meshes,
                     struct error *err);
void sim_clear(struct sim *sim);

/* One time step (step.c). Errors: STATUS_DIVERGED with point, time and what is likely to blame; the state is left as it
 * is, for a look. */
enum status sim_step(struct sim *sim, struct error *err);

/* Forces on every point at the current positions and velocities; for the integrators. */
void sim_forces(struct sim *sim);

/* Makes one edge let go; for break_edges() and for effects. */
static inline void sim_break_edge(struct sim *sim, uint32_t edge)
{
    sim->edge_active[edge] = 0;
    sim->edges_broke = true;
    sim->broken++;
}

/* What there is to say about a state: a row of the log. */
struct sim_measures {
    double mean_radius;    /* mean distance of the points that carry skin from their mean */
    double volume;         /* by the divergence theorem, over the active triangles, about that mean */
    double kinetic_energy; /* of all points */
    double elastic_energy; /* of the active edges */
    double max_stretch;    /* largest length over rest length of an active edge */
    double area;           /* of the active triangles */
    double largest_piece_area;
    uint32_t edges_active, triangles_active;
    uint32_t pieces; /* of active triangles, joined where they share an edge */
};
struct sim_measures sim_measure(struct sim *sim);

/* The log: tab-separated, a header, a row a call. It replaces path when it is closed, and not before. */
struct sim_log;
enum status sim_log_open(const char *path, struct sim_log **log, struct error *err);
void sim_log_row(struct sim_log *log, struct sim *sim);
enum status sim_log_close(struct sim_log *log,
                          struct error *err); /* frees it, whatever it returns; NULL is fine */
void sim_log_abandon(struct sim_log *log);    /* NULL is fine */

/* The skin that is left, as a mesh of its own. */
enum status sim_skin(const struct sim *sim, struct mesh *mesh, struct error *err);

/* Opacity and highlight exponent of each triangle from its stretch (material.c). Arrays of triangle_count, the
 * caller's. */
void sim_material(const struct sim *sim, float *opacity, float *shininess);

/* A fingerprint of the whole state: equal states, equal numbers. */
uint64_t sim_hash(const struct sim *sim);

/* Applies one entry of the schedule (schedule.c). */
void sim_change(struct sim *sim, const struct scene_schedule *entry);

/* STATUS_DIVERGED, with the first point that is nowhere and what is likely to blame (diverged.c). */
enum status sim_diverged(const struct sim *sim, struct error *err);

/* The largest step that is surely stable for a balloon's springs and dampers: mu dt (2 k_d + k dt) < 4 m, with mu, the
 * largest eigenvalue of the spring graph, bounded by twice the largest number of edges at a point. 0: there is none. */
double sim_stable_step(const struct sim *sim, const struct sim_balloon *balloon);

/* Fills sim->hooks with what the scene calls for (STATUS_NO_MEMORY); runs the hooks of one phase. */
enum status effects_resolve(struct sim *sim, struct error *err);
void effects_run(struct sim *sim, enum effect_phase phase);

#endif
