/*
 * The simulator: points, springs and dampers under pressure, until they burst. The paper's section 3.5.
 *
 *     if (sim_load_meshes(&scene, meshes, reports, err)) ...
 *     struct sim sim = {0};
 *     if (sim_open(&sim, &scene, meshes, 0, err)) ...  allocates; the scene must outlive the sim
 *     while (!sim_at_end(&sim))
 *         if (sim_step(&sim, err)) ...                 never allocates; STATUS_DIVERGED names the point
 *     sim_clear(&sim);
 *
 * step.c is the method, and forces.c its formulas; open.c and parts.c build the tables that they work on;
 * integrators.c and effects.c list what can be plugged in; look.c shows moments inside a step; state.c says
 * what the future depends on; measure.c and material.c look at the result.
 */
#ifndef SIM_SIM_H
#define SIM_SIM_H

#include "common/mesh.h"
#include "common/scene.h"
#include "common/status.h"
#include "sim/effect.h"
#include "sim/integrators.h"
#include "sim/parts.h"

#include <stdbool.h>
#include <stdint.h>

struct sim;
struct sim_jacobian;
struct sim_kernels;
struct sim_seen;
struct guard;
struct hand;
struct gas;
struct pins;
struct string;
struct obstacles;
struct needles;
struct contact;
struct air_drag;
struct limit_point;
struct gas_rims;
struct topology;
struct fracture;
struct membrane;
struct bending;
struct threads;

/* A piece of the state: bytes that belong to sim. */
struct sim_block {
    const char *name;
    void *data;
    size_t size; /* bytes */
};
enum { SIM_VECTORS_MAX = 16 };

/* One balloon's share of the tables, and the numbers that all its points and edges have in common. */
struct sim_balloon {
    const struct scene_balloon *scene;
    uint32_t point_begin, point_end;
    uint32_t edge_begin, edge_end;
    uint32_t triangle_begin, triangle_end;
    uint32_t point_room, edge_room; /* point_end and edge_end may grow to these where the skin tears */
    double centre[3];               /* of its points, at rest */
    double radius;                  /* mean distance of its points from that centre, at rest */
    double mean_rest_length;        /* of its edges */
    /* An edge's threshold is over its own rest length: the settings' is that of an edge of length 1. */
    bool own_thresholds;
    double breathing_rate;    /* 1/s, for errors of speeds (weights.h) */
    struct sim_settings *now; /* one of sim->settings */
    bool by_area;             /* pressure acts on areas, not on each point alike */
    /* Its edges' scalars where springs are viscous (effect_viscosity.c): the first; how many. */
    uint32_t arms, arm_count;
    double *slip; /* [slip_count] of its edges, where springs slip (effect_plasticity.c); owned */
    uint32_t slip_count;
    struct membrane *membrane; /* what acts in place of the springs (membrane.h); NULL: the springs */
    struct bending *bending;   /* what resists being bent (bending.h); NULL: nothing */
    struct fracture *fracture; /* where and when the skin tears (fracture.h); NULL: as the paper has it */
    struct topology *topology; /* and how (topology.h) */
    struct gas *gas;           /* what is sealed in (effect_gas.h); NULL: nothing, the pressure is given */
    struct pins *pins;         /* likewise what holds it (effect_pins.c), */
    struct string *string;     /* and what it is tied to (effect_string.c) */
    struct limit_point *limit; /* of pressure that is given, on areas (limit_point.h) */
    struct gas_rims *rims;     /* of its holes, by whoever cuts the skin; NULL: there are none */
};

/* What changes about a balloon as a whole while time goes on. */
struct sim_settings {
    double spring_factor, damping, pressure; /* as the schedule has them now */
    double threshold_length;                 /* at which an edge lets go */
    double pump, pump_until;                 /* likewise, where there is gas */
    uint64_t ripped;                         /* 1: the scene's rip has opened */
    double membrane_range[2];  /* what the guard takes a membrane's stiffness for (membrane.h), */
    double membrane_stiffness; /* and that, on an edge whose weight is 1 */
};

/* The paper's pressure, a force on each point along its unit normal: 0 where pressure acts on areas. */
static inline double sim_point_pressure(const struct sim_balloon *balloon)
{
    return balloon->by_area ? 0 : balloon->now->pressure;
}

/* What an outsider may want to know as it happens, such as an effect that wakes: kept
 * until somebody reads it. */
struct sim_news {
    double time;
    const char *effect, *text; /* "gas", "the neck is open" */
    size_t balloon;
};
enum { SIM_NEWS_EACH = 16 }; /* of a balloon, mostly */

/* The energy's accounts (ledger.h). */
struct sim_ledger {
    bool on;
    uint32_t first; /* of its own scalars, the last ones: they only record; the state are those before */
    struct sim_account {
        double begin;    /* kinetic and elastic energy when the accounts were opened */
        double fracture; /* what springs held when they let go, and the skin where it was cut */
        double user;     /* what changes of springs added */
        double contact;  /* what obstacles and contact took */
        double let_go;   /* what gas lost at once, as holes met, pieces fell off, or all of it was gone */
    } account;
    bool noted; /* what there was before obstacles or contact moved points in this step: */
    double before;
    struct sim_block *left; /* for ledger_forces(): [hooks x EFFECT_BLOCKS_MAX] owned */
    unsigned char *kept;    /* as many bytes as those blocks have; owned */
};

/* What the last step began with, and what is put back after a look inside it; empty where
 * nobody can look (look.c). */
struct sim_past {
    unsigned char *edge_active, *triangle_active; /* [edge_count], [triangle_count] */
    double (*position)[4], (*velocity)[4];        /* [point_count] */
    double *scalar;                               /* [scalar_count] */
    struct sim_account account;
    double time;
    bool looking;
};

struct sim {
    /* Points: the paper's table 1. Its acceleration is force / mass. Rows are x, y, z and
     * 0, aligned to 32 bytes. */
    uint32_t point_count;
    /* [point_count] unit, outward; 0 where no skin is left; by the last sim_forces(). Of balloons that are
     * pressed by area: the sum of twice the area vectors of the point's triangles. */
    double (*normal)[4];
    double (*position)[4]; /* [point_count] length */
    double (*velocity)[4]; /* [point_count] length/s */
    double (*force)[4];    /* [point_count] by sim_forces() */
    double *mass;          /* [point_count] */

    /* Edges: table 2, in the order of their points. */
    uint32_t edge_count;
    uint32_t (*edge_point)[2];    /* [edge_count] point1 < point2 */
    double *rest_length;          /* [edge_count] */
    double *broken_length;        /* [edge_count] of a broken edge: its length when it broke */
    double *init_spring_const;    /* [edge_count] */
    double *current_spring_const; /* [edge_count] init_spring_const x the balloon's spring_factor */
    unsigned char *edge_active;   /* [edge_count] */

    /* Triangles: table 3, an array instead of a linked list, in the order of their lowest points. Opacity and
     * shininess are sim_material()'s, for frames that are drawn. */
    uint32_t triangle_count;
    uint32_t (*triangle_point)[3];  /* [triangle_count] counter-clockwise from outside */
    uint32_t (*triangle_edge)[3];   /* [triangle_count] */
    unsigned char *triangle_active; /* [triangle_count] */

    /* What no point carries, each with its rate of change: integrated along with the positions. */
    uint32_t scalar_count, body_count;
    double *scalar, *scalar_rate; /* [scalar_count] the rates by sim_forces() */
    struct sim_body *body;        /* [body_count] those that move as points do; owned */

    const struct scene *scene;
    struct sim_balloon *balloons;  /* [balloon_count] */
    struct sim_settings *settings; /* [balloon_count] */
    size_t balloon_count;

    /* Who works on what: worker w of the pool on parts w, w + workers, ... */
    struct threads *pool;   /* NULL: the caller alone */
    struct sim_part *parts; /* [part_count] of each balloon one a worker */
    size_t part_count;
    double *edge_rooms; /* [part_count] by how much edges may grow before one lets go, by the last look, */
    double edge_room;   /*    and the least of them, less what points have moved since; below 0: not known */
    struct sim_seen *seen; /* [part_count] by the last sweep (sweep.h), */
    bool swept;            /*    with which this step ended, and nothing has moved a point since, */
    bool pushed;           /*    or obstacles and contact have, and shown each such point to it */
    double met;            /* when they first did in these steps; INFINITY: not yet */
    const struct sim_kernels *kernels;
    struct {
        void *position, *velocity, *force, *normal; /* [point_count] what the kernels work on */
    } rows;

    const struct integrator *integrator;
    const struct integrator *acting;         /* whose limits hold: what "auto" has chosen, or else the same */
    uint32_t wanted_substeps;                /* that it has chosen; 0: one is as good as many */
    void *method;                            /* the integrator's own */
    struct sim_jacobian *jacobian;           /* likewise, of implicit methods (jacobian.h) */
    double (*scratch[SIM_VECTORS_MAX])[4];   /* [point_count] the integrator's, as many as it asked for */
    double *scalar_scratch[SIM_VECTORS_MAX]; /* [scalar_count] likewise, one to each of scratch */
    double *block_sum;                       /* [point_count / VECTOR_BLOCK + 1] for vector_sum() */
    /* [hook_count[phase]] what this scene calls for, nothing else. */
    struct effect_hook *hooks[EFFECT_PHASES];
    size_t hook_count[EFFECT_PHASES];

    /* In fixed steps the time is time_base + steps_since x step, so that it does not drift;
     * else the sum of the steps. */
    double time;       /* s */
    double whole_step; /* s, as the schedule has it now; the longest one where a method chooses for itself */
    uint32_t substeps; /* in which the guard splits it (guard.h) */
    uint32_t finer;    /* parts of what would be a substep: 1, but more for an estimate's companions */
    double step;       /* s: whole_step / substeps, a step of the method */
    double time_base;  /* when the step last changed */
    uint64_t steps_since; /* steps taken since then */
    uint64_t steps;       /* in all */
    size_t next_change;   /* first entry of the schedule that is still to come */
    bool edges_broke;     /* since the triangles were last asked */
    uint32_t broken;      /* edges that have let go, in all */
    /* Since the last step an edge let go, the schedule changed something, forces jumped: methods
     * that remember begin anew. */
    bool changed;

    /* Asked within what may be long in a step, the trials of auto and what a method takes in parts; false
     * ends it with STATUS_INTERRUPTED, as it was before. NULL: nobody asks. */
    bool (*goes_on)(const struct sim *sim);
    bool is_trying; /* it is auto's trials that ask */

    /* What a method that chooses its own steps goes by and leaves. */
    double due;           /* s: where it must stop, at a change or the end; or INFINITY */
    double taken;         /* s: how far the last advance() moved; it comes in as the longest that it may be */
    struct sim_past past; /* for sim_look() */
    struct guard *guard;
    /* [point_count] places when the step began; NULL: nothing that the scene calls for asks for them. */
    double (*before)[4];
    struct obstacles *obstacles; /* what stands in the way (obstacles.h); NULL: nothing */
    struct needles *needles;     /* how near they are (effect_needles.c); NULL: there are none */
    struct contact *contact;     /* what keeps skins apart (contact.h); NULL: nothing */
    double *hinge_pull; /* [edge_count] of skin that resists being bent (bending_passes.h); NULL: none does */
    struct air_drag *drag; /* what the air's resistance remembers (effect_drag.c); NULL: there is none */
    struct hand *hand;     /* that pulls at it (live_hand.h); NULL: none */
    uint64_t fingerprint;  /* checkpoint_fingerprint() before anything was cut or slipped; 0: nothing can */
    /* Of sim_forces() since sim_open(), also of those for a look; nothing depends on it. */
    uint64_t evaluations;
    uint64_t products; /* of sim_force_product(), likewise */

    struct sim_ledger ledger;

    /* [news_count] since somebody set it to 0; later ones than SIM_NEWS_EACH x balloon_count are lost. */
    struct sim_news *news;
    size_t news_count;

    uint32_t *piece;          /* [edge_count] for sim_measure(): an edge of the same piece */
    double *piece_area;       /* [edge_count] likewise: of the piece, at its root */
    size_t bytes;             /* of all the arrays here */
    struct sim_block *blocks; /* for sim_blocks() */
};

/* Reads the mesh of each balloon of a checked scene, repairs and connects it. meshes and reports have
 * balloon_count elements, empty; on failure they may be partly filled. Refuses (STATUS_INPUT, with the file's
 * name) what cannot be inflated: meshes that are open, no surface, or not consistently wound. An inside-out
 * mesh is turned. Points and triangles are renumbered so that neighbours are near in memory (mesh_order). */
enum status sim_load_meshes(const struct scene *scene, struct mesh *meshes, struct mesh_report *reports,
                            struct error *err);

/* Builds the tables for a checked scene; meshes[i] is balloon i's, connected (common/mesh.h). `workers`
 * threads work on a step (0: as many as the machine has, but one for a small balloon); the results do not
 * depend on it. Errors: STATUS_NO_MEMORY, STATUS_RESOURCE without threads, STATUS_RANGE when all balloons
 * together have more than 2^32 - 2 edges. On failure *sim is empty. */
enum status sim_open(struct sim *sim, const struct scene *scene, const struct mesh *meshes, unsigned workers,
                     struct error *err);
void sim_clear(struct sim *sim);

/* One time step (step.c). Errors: STATUS_DIVERGED with point, time and what is likely to blame; the state is
 * left as it is, for a look; STATUS_INTERRUPTED by goes_on, the state as before the step. */
enum status sim_step(struct sim *sim, struct error *err);

/* Forces on every point at the current positions and velocities; for the integrators. */
void sim_forces(struct sim *sim);

/* Room for `count` more scalars, all 0; *first becomes the number of the first. Between sim_open() and the
 * first step, or by an effect's hook as the sim is opened. Error: STATUS_NO_MEMORY. */
enum status sim_add_scalars(struct sim *sim, uint32_t count, uint32_t *first, struct error *err);

/* The balloon that a triangle is of. */
static inline struct sim_balloon *sim_balloon_of(const struct sim *sim, uint32_t triangle)
{
    struct sim_balloon *b = sim->balloons;
    while (triangle >= b->triangle_end)
        b++;
    return b;
}

/* Zeroed memory on a line of the cache, free()d by whoever asked, which adds to sim->bytes.
 * NULL: there is not enough. */
void *sim_table(struct sim *sim, size_t count, size_t size);

/* Makes sim->before, if there is none: for an effect's open. Error: STATUS_NO_MEMORY. */
enum status sim_keep_before(struct sim *sim, struct error *err);

/* Of an active edge its length now; of a broken one that when it broke. */
double sim_edge_length(const struct sim *sim, uint32_t edge);

/* The length at which it lets go. */
static inline double sim_threshold(const struct sim *sim, const struct sim_balloon *balloon, uint32_t edge)
{
    return balloon->now->threshold_length * (balloon->own_thresholds ? sim->rest_length[edge] : 1);
}

/* What an edge's spring holds: k_s (|l| - r)^2 / 2. */
static inline double sim_spring_energy(const struct sim *sim, uint32_t edge)
{
    const double stretched = sim_edge_length(sim, edge) - sim->rest_length[edge];
    return sim->current_spring_const[edge] * stretched * stretched / 2;
}

/* Lists all that the future depends on (state.c): equal blocks, equal futures. The list is sim's, made anew
 * by each call; the blocks' addresses stay until sim_clear(). */
const struct sim_block *sim_blocks(struct sim *sim, size_t *count);

/* Makes room for that list, once everything else is there. STATUS_NO_MEMORY. */
enum status state_open(struct sim *sim, struct error *err);

/* What follows from blocks that were put back (sim_blocks()): false, and nothing done, where they are
 * no state of a torn skin. */
bool sim_restored(struct sim *sim);

/* What a needle's point does to a triangle that it meets at a place: a slit, or in the paper's
 * skin its edges let go. NULL, or why nothing came of it, a sentence for whoever clicked. */
const char *sim_prick(struct sim *sim, uint32_t triangle, const double place[3]);

/* How many of the scalars are the state's own: those after them only record, and are not hashed. */
uint32_t sim_state_scalars(const struct sim *sim);

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
    uint32_t pieces;     /* of active triangles, joined where they share an edge */
    uint32_t crack_tips; /* that may still run */
    double torn_length;  /* of all cuts, at rest */
    /* What their toughness asks for: toughness x mean radius x shear modulus x thickness x torn length. */
    double crack_energy;
    double hole_area; /* of what holds gas */
};
struct sim_measures sim_measure(struct sim *sim);

/* The skin that is left, as a mesh of its own. */
enum status sim_skin(const struct sim *sim, struct mesh *mesh, struct error *err);

/* A fingerprint of the whole state: equal states, equal numbers. */
uint64_t sim_hash(struct sim *sim);

static inline bool sim_goes_on(const struct sim *sim)
{
    return !sim->goes_on || sim->goes_on(sim);
}

/* Applies one entry of the schedule (schedule.c); all whose time has come. */
void sim_change(struct sim *sim, const struct scene_schedule *entry);
void sim_change_due(struct sim *sim);

/* STATUS_DIVERGED, with the first point that is nowhere or the one that moves most, its longest edge, the
 * time, the kinetic energy and what is likely to blame (diverged.c). */
enum status sim_diverged(struct sim *sim, double energy, struct error *err);

/* Whether scene.time.end has been reached: exactly where a method chooses its own steps,
 * else to the nearest step. */
bool sim_at_end(const struct sim *sim);

/* Shows the state at `time`, later than before the last step and no later than now, to whoever draws or
 * measures; sim_look_end() puts everything back, to the bit. Where the method cannot say what was between two
 * steps, the state stays as it is now. Of edges and triangles those are active that were so during the step:
 * what let go did so at its end. */
void sim_look(struct sim *sim, double time);
void sim_look_end(struct sim *sim);

/* Makes sim->past where the method can look into its steps (STATUS_NO_MEMORY); remembers how
 * a step begins (look.c). */
enum status look_open(struct sim *sim, struct error *err);
void look_close(struct sim *sim);
void look_remember(struct sim *sim);

/* Tells it to whoever reads the news; text is static. */
void sim_tell(struct sim *sim, const struct sim_balloon *balloon, const char *effect, const char *text);

#endif
