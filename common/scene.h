/*
 * A scene: what a simulation is asked for. Read from a .cfg file (libconfig's grammar), or made from a mesh
 * with the paper's settings, then adjusted key by key.
 *
 *     struct scene scene = {0};
 *     if (scene_load("burst.cfg", &scene, err)) ...          or scene_from_mesh("fox.ply", &scene, err)
 *     if (scene_set(&scene, "time.step=0.01", err)) ...      any key by its path
 *     if (scene_check(&scene, err)) ...                      what no single key can say
 *     scene_clear(&scene);
 *
 * Every key stands in one table, scene_fields.h, with its type, unit, range, default and meaning; the reader,
 * scene_set and scene_write_help all go by it. A block that the scene does not name has `on` false: its
 * effect does not exist.
 */
#ifndef COMMON_SCENE_H
#define COMMON_SCENE_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Which keys of a block somebody wrote down, in the order of scene_fields.h: the key's line in the
 * scene's own file, or SCENE_NOT_IN_FILE where it came by scene_set() or an @include; 0: nobody did. */
enum { SCENE_KEYS_MAX = 16, SCENE_NOT_IN_FILE = -1 };
struct scene_written {
    int line[SCENE_KEYS_MAX];
};

struct scene_time {
    struct scene_written written;
    double step, end; /* s */
    int integrator;   /* index into scene_integrator_names */
    int guard;        /* enum scene_guard */
    double tolerance; /* in mean radii, a step */
};

struct scene_view {
    struct scene_written written;
    int size[2];           /* pixels of the whole picture */
    double camera[3];      /* the eye, from the target, in radii of what is seen at rest */
    double target[3];      /* from the centre of the balloons at rest, in the same radii */
    double field_of_view;  /* degrees, vertical */
    int stereo;            /* index into scene_stereo_names */
    int style, order;      /* indices into scene_style_names, scene_order_names */
    int samples;           /* along a pixel's side */
    int squeezed;          /* index into scene_squeezed_names: 0 no, 1 yes */
    double eye_distance;   /* over the distance from eye to target */
    double rate, playback; /* frames a simulated second; frames a second in the movie */
};

/* A function given by a table: straight lines between the rows, constant beyond the first and the last. */
struct scene_profile {
    double (*row)[2]; /* [count] */
    size_t count;
};

/* Of every block that calls for an effect: whether it is there, and its line in the file (0:
 * it came by scene_set). */
struct scene_spring_by_height {
    bool on;
    unsigned line;
    struct scene_written written;
    struct scene_profile profile; /* height, 0 lowest to 1 highest -> factor */
};

struct scene_rip {
    bool on;
    unsigned line;
    struct scene_written written;
    double at, stretch;  /* opens once both are reached */
    double place[3];     /* direction from the balloon's centre */
    double direction[3]; /* of the cut, as seen there */
    double length;       /* of the cut, in mean radii */
};

struct scene_fracture {
    bool on;
    unsigned line;
    struct scene_written written;
    int mode; /* enum scene_fracture_mode */
    double strength, toughness, weakness;
    int seed;
    double tip_speed; /* over the speed of shear waves */
    double branching; /* a stretch */
    double spacing;   /* in mean radii, as toughness and reserve are */
    double smallest;  /* share of the skin at rest */
    double reserve;
};

struct scene_gas {
    bool on;
    unsigned line;
    struct scene_written written;
    double ambient, fill; /* force/length^2; over what fills the rest volume */
    int process;          /* enum scene_process */
    double gamma, density, discharge;
    double pump, pump_until; /* fills a second; a fill */
    double leak;             /* volume a second and gauge pressure */
    double neck, neck_at;    /* area; s */
    double neck_place[3];    /* direction from the balloon's centre */
};

struct scene_tube {
    bool on;
    unsigned line;
    struct scene_written written;
    int to;
    double area, discharge;
};

struct scene_pins {
    bool on;
    unsigned line;
    struct scene_written written;
    double place[3], reach; /* direction from the balloon's centre; degrees */
    double until;           /* s */
};

struct scene_string {
    bool on;
    unsigned line;
    struct scene_written written;
    double place[3], reach; /* likewise */
    double to[3], slack;    /* in radii from the balloon's centre; over the first distance */
    double stiffness, damping, weight;
};

struct scene_gravity {
    bool on;
    unsigned line;
    struct scene_written written;
    double acceleration[3], air_density;
};

struct scene_drag {
    bool on;
    unsigned line;
    struct scene_written written;
    double air_density, coefficient, wind[3];
};

struct scene_viscosity {
    bool on;
    unsigned line;
    struct scene_written written;
    double ratio, time; /* of the arm's spring to the edge's; s */
};

struct scene_plasticity {
    bool on;
    unsigned line;
    struct scene_written written;
    double yield, hardening; /* force; force/length */
};

struct scene_bending {
    bool on;
    unsigned line;
    struct scene_written written;
    double stiffness, damping; /* force length; s */
    int rest;                  /* enum scene_rest */
};

struct scene_membrane {
    bool on;
    unsigned line;
    struct scene_written written;
    int law; /* enum scene_law */
    double shear_modulus, thickness, density;
    double mooney_ratio, gent_limit;
    struct scene_profile ogden; /* m_p, alpha_p */
    double compression, viscosity;
};

struct scene_balloon {
    unsigned line; /* in the file; 0: not by it */
    struct scene_written written;
    char *mesh;         /* path; relative ones already joined to the scene's folder */
    double radius;      /* mean distance of the points from their centre; 0: as the mesh has it */
    double position[3]; /* of that centre */
    double point_mass, spring, spring_factor, damping;
    int mass_by;               /* enum scene_mass_by */
    int stiffness;             /* enum scene_stiffness */
    int threshold_of;          /* enum scene_threshold_of */
    double threshold;          /* an edge lets go at this length over the mean rest length */
    double pressure;           /* force on each point, or on each unit of area */
    int pressure_on;           /* enum scene_pressure_on */
    double colour[3];          /* sRGB, 0 to 1 */
    double opacity, shininess; /* at rest */
    struct scene_spring_by_height spring_by_height;
    struct scene_rip rip;
    struct scene_viscosity viscosity;
    struct scene_plasticity plasticity;
    struct scene_fracture fracture;
    struct scene_membrane membrane;
    struct scene_bending bending;
    struct scene_gas gas;
    struct scene_tube tube;
    struct scene_pins pins;
    struct scene_string string;
};

struct scene_ground {
    bool on;
    unsigned line;
    struct scene_written written;
    double height, normal[3], friction, bounce; /* a plane through (0, height, 0) */
};

/* Something firm that skin cannot enter. */
struct scene_obstacles {
    unsigned line;
    struct scene_written written;
    int shape; /* enum scene_shape */
    double place[3], radius, size[3], friction, bounce;
};

/* A point that moves, and starts a tear where it meets skin. */
struct scene_needles {
    unsigned line;
    struct scene_written written;
    double at, from[3], velocity[3];
};

struct scene_contact {
    bool on;
    unsigned line;
    struct scene_written written;
    double thickness, friction;
};

enum { SCENE_CHANGES_MAX = 8 };

/* Keys that change between two steps, as the paper's user changes them by hand (3.5). */
struct scene_schedule {
    unsigned line; /* as above */
    struct scene_written written;
    double at;   /* s */
    int balloon; /* which one; -1: all */
    size_t change_count;
    struct {
        const struct scene_field *field;
        double value;
    } change[SCENE_CHANGES_MAX];
};

struct scene {
    char *path; /* of the file, for messages; NULL without one */
    struct scene_time time;
    struct scene_view view;
    struct scene_gravity gravity;
    struct scene_drag drag;
    struct scene_balloon *balloons; /* [balloon_count] */
    size_t balloon_count, balloon_capacity;
    struct scene_ground ground;
    struct scene_obstacles *obstacles; /* [obstacles_count] */
    size_t obstacles_count, obstacles_capacity;
    struct scene_needles *needles; /* [needles_count] */
    size_t needles_count, needles_capacity;
    struct scene_contact contact;
    struct scene_schedule *schedule; /* [schedule_count], by time once scene_check() has passed */
    size_t schedule_count, schedule_capacity;
};

extern const char *const scene_integrator_names[]; /* NULL-terminated, like all lists of choices */
extern const char *const scene_guard_names[];
extern const char *const scene_pressure_on_names[];
extern const char *const scene_process_names[];
extern const char *const scene_stereo_names[];
extern const char *const scene_mode_names[];
extern const char *const scene_squeezed_names[];
extern const char *const scene_style_names[];
extern const char *const scene_order_names[];
extern const char *const scene_shape_names[];
extern const char *const scene_mass_by_names[];
extern const char *const scene_stiffness_names[];
extern const char *const scene_threshold_of_names[];
extern const char *const scene_law_names[];
extern const char *const scene_rest_names[];
enum { SCENE_SYMPLECTIC_EULER }; /* the first of the integrators: the paper's */
enum scene_guard { SCENE_GUARD_SUBSTEP, SCENE_GUARD_REFUSE, SCENE_GUARD_OFF };
enum scene_shape { SCENE_SPHERE, SCENE_BOX };
enum scene_pressure_on { SCENE_ON_POINTS, SCENE_ON_AREAS };
enum scene_process { SCENE_ISOTHERMAL, SCENE_ADIABATIC };
enum scene_style { SCENE_LATEX, SCENE_PAPER };
enum scene_order { SCENE_ORDER_NONE, SCENE_ORDER_SORT, SCENE_ORDER_PEEL, SCENE_ORDER_LIST };
enum scene_mass_by { SCENE_BY_POINTS, SCENE_BY_AREAS };
enum scene_stiffness { SCENE_UNIFORM, SCENE_COTANGENT };
enum scene_threshold_of { SCENE_OF_MEAN, SCENE_OF_EDGE };
enum scene_rest { SCENE_AS_MESHED, SCENE_FLAT };
enum scene_law { SCENE_NEO_HOOKEAN, SCENE_MOONEY_RIVLIN, SCENE_GENT, SCENE_OGDEN };
enum scene_fracture_mode { SCENE_FRACTURE_TEAR, SCENE_FRACTURE_PAPER };
enum scene_stereo {
    SCENE_MONO,
    SCENE_PARALLEL,
    SCENE_CROSSED,
    SCENE_OVER_UNDER,
    SCENE_RED_CYAN,
    SCENE_INTERLACED,
    SCENE_QUAD,
    SCENE_LEFT,
    SCENE_RIGHT,
    SCENE_SEPARATE
};

/* Reads a scene file. *scene must be empty ({0}) and is so again after a failure. Errors: STATUS_FILE,
 * STATUS_INPUT with FILE:LINE, the key, and what would be right. */
enum status scene_load(const char *path, struct scene *scene, struct error *err);

/* The paper's settings around one mesh: as in the paper, nobody guards its step, which is a
 * twentieth past what is stable. */
enum status scene_from_mesh(const char *mesh_path, struct scene *scene, struct error *err);

/* Takes "PATH=VALUE", for example "balloons[0].pressure=12", "view.size=[640,480]",
 * "view.stereo=crossed". A key of a block that was not there calls for the block. Relative paths are
 * relative to the current folder. */
enum status scene_set(struct scene *scene, const char *assignment, struct error *err);

/* What only the whole scene can tell: balloons without a mesh, blocks that contradict each other, a schedule
 * for a balloon that is not there. Puts the schedule in the order of time. Errors: STATUS_NO_MEMORY, and
 * STATUS_INPUT with FILE:LINE and the block. */
enum status scene_check(struct scene *scene, struct error *err);

/* What somebody wrote down, in the file or by scene_set(), and nothing goes by as the rest of the scene is:
 * calls `say` with a line for each block and reason, "FILE:LINE: balloons[0]: spring, damping do nothing: a
 * membrane stands in for the springs". For a scene that scene_check() has passed. */
void scene_tell_idle(const struct scene *scene, void (*say)(const char *text, void *context), void *context);

void scene_clear(struct scene *scene);

/* The profile's value at x; 1 for an empty one. */
double scene_profile_at(const struct scene_profile *profile, double x);

/* Every key that a state depends on, as it is, a line PATH=VALUE each: equal lines, equal runs. Left out are
 * what only pictures depend on, the end, and where files lie. */
void scene_write_keys(const struct scene *scene, FILE *stream);

/* Compares two such texts. False when they are equal; else says in text what differs first:
 * "balloons[0].pressure is 12, and was 10". */
bool scene_keys_differ(const char *was, const char *is, char *text, size_t size);

/* Every key with its type, unit, range, default and meaning, as text (`--help-scene`), or as
 * mdoc for the man page. */
void scene_write_help(FILE *stream);
void scene_write_mdoc(FILE *stream);

#endif
