/*
 * Every key that a scene can have: the one place where its type, range, unit, default, meaning and
 * source are said. A row is
 *     X(key, TYPE, least, most, default, unit, flags, "meaning", "source")
 * The member of the struct in scene.h has the key's name. Defaults are written as in a scene file. Ranges of
 * a vector hold for each of its numbers. LIVE keys may stand in the schedule; FREE ones may be others when a
 * run is resumed. Units are the scene's own (the paper gives none): length, mass and time are whatever the
 * user takes them for, as long as they agree.
 */
#ifndef COMMON_SCENE_FIELDS_H
#define COMMON_SCENE_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

#define SCENE_TIME_FIELDS(X)                                                                              \
    X(step, NUMBER, 1e-9, 1e6, "0.025", "s", LIVE,                                                        \
      "from one step to the next; the longest one where a method chooses for itself", "paper 4")          \
    X(end, NUMBER, 0, 1e9, "10", "s", FREE, "when the simulation ends", "paper 4: about 400 frames")      \
    X(integrator, CHOICE, 0, 0, "\"auto\"", "", 0, "method that moves the points", "paper 3.1")           \
    X(tolerance, NUMBER, 1e-12, 0.1, "1e-5", "radii", 0,                                                  \
      "error in places that a method which chooses its steps, or what auto chooses, allows in each; not " \
      "what ground, obstacles and contact add by turning skin back at their ends, nor what a pump that "  \
      "ends within a step adds to what auto chooses",                                                     \
      "")                                                                                                 \
    X(guard, CHOICE, 0, 0, "\"substep\"", "", 0,                                                          \
      "steps that are not surely stable: split them, refuse them, or let them go and say so", "")

#define SCENE_VIEW_FIELDS(X)                                                                                 \
    X(size, SIZE, 16, 16384, "[1280, 480]", "pixels", FREE, "width and height of the whole picture", "")     \
    X(camera, VECTOR, -1e3, 1e3, "[0.0, 1.2, 8.0]", "radii", FREE, "the eye, seen from the target", "")      \
    X(target, VECTOR, -1e3, 1e3, "[0.0, 0.0, 0.0]", "radii", FREE,                                           \
      "what the eye looks at, from the balloons' centre", "")                                                \
    X(field_of_view, NUMBER, 1, 150, "30", "degrees", FREE, "vertical angle of the picture", "")             \
    X(stereo, CHOICE, 0, 0, "\"parallel\"", "", FREE,                                                        \
      "one eye, both in halves or on one another, one of the two alone, or each in files of its own",        \
      "paper 3.7")                                                                                           \
    X(squeezed, CHOICE, 0, 0, "\"no\"", "", FREE,                                                            \
      "halves hold the whole's proportions, for screens that stretch them", "")                              \
    X(eye_distance, NUMBER, 0, 1, "0.05", "", FREE, "between the eyes, over the distance to the target", "") \
    X(style, CHOICE, 0, 0, "\"latex\"", "", FREE, "rubber by its stretch, or the plain skin of the paper",   \
      "paper 3.3")                                                                                           \
    X(order, CHOICE, 0, 0, "\"sort\"", "", FREE,                                                             \
      "of translucent triangles: as they come, sorted, or exact by peeling layers or a list for each pixel", \
      "paper 3.3")                                                                                           \
    X(samples, WHOLE, 1, 4, "1", "", FREE,                                                                   \
      "along each side of a pixel, of whose squares it is the mean; 1: smooth outlines", "")                 \
    X(rate, NUMBER, 1e-6, 1e6, "40", "1/s", FREE, "frames drawn and rows logged a simulated second",         \
      "paper 4: one a step")                                                                                 \
    X(playback, NUMBER, 1, 240, "25", "1/s", FREE, "frames a second in the movie", "")

#define SCENE_BALLOON_FIELDS(X)                                                                              \
    X(mesh, TEXT, 0, 0, "", "file", 0, ".ply, .stl, .obj, or what assimp reads; relative to the scene file", \
      "paper 3.4")                                                                                           \
    X(radius, NUMBER, 0, 1e6, "45", "length", 0,                                                             \
      "mean distance of points from their centre; 0: as in the mesh", "")                                    \
    X(position, VECTOR, -1e6, 1e6, "[0.0, 0.0, 0.0]", "length", 0, "of that centre", "")                     \
    X(point_mass, NUMBER, 1e-9, 1e9, "0.11", "mass", 0, "of each point", "paper 3.1")                        \
    X(mass_by, CHOICE, 0, 0, "\"points\"", "", 0,                                                            \
      "points: all have point_mass; areas: so in the mean, and each by the skin around it, as in a sheet",   \
      "")                                                                                                    \
    X(spring, NUMBER, 0, 1e9, "20", "force/length", 0, "spring constant of each edge", "paper 4")            \
    X(stiffness, CHOICE, 0, 0, "\"uniform\"", "", 0,                                                         \
      "of the springs: all alike, or as a uniform sheet has it", "Pinkall and Polthier 1993")                \
    X(spring_factor, NUMBER, 0, 1e6, "1", "", LIVE, "the spring constants' weight", "paper 3.5")             \
    X(damping, NUMBER, 0, 1e9, "1", "force s/length", LIVE, "against the speed of closing along an edge",    \
      "paper 2")                                                                                             \
    X(threshold_of, CHOICE, 0, 0, "\"mean\"", "", 0,                                                         \
      "whose rest length the threshold is over: that of the mean edge, or each edge's own", "paper 3.5")     \
    X(threshold, NUMBER, 1.001, 1e300, "2", "", LIVE, "an edge lets go at this length over the rest length", \
      "paper 4")                                                                                             \
    X(pressure, NUMBER, -1e9, 1e9, "10", "force", LIVE, "on each point, along its normal", "paper 3.2")      \
    X(pressure_on, CHOICE, 0, 0, "\"points\"", "", 0,                                                        \
      "points: it pushes each alike, along its normal; areas: it is a force/length^2", "paper 3.2")          \
    X(colour, VECTOR, 0, 1, "[0.85, 0.09, 0.12]", "", FREE,                                                  \
      "red, green and blue (sRGB) of the skin at rest", "")                                                  \
    X(opacity, NUMBER, 0.01, 1, "0.97", "", FREE, "of the skin at rest; it thins with the stretch",          \
      "paper 3.3")                                                                                           \
    X(shininess, NUMBER, 1, 1000, "12", "", FREE,                                                            \
      "exponent of the highlight at rest; it grows with the stretch", "paper 3.3")

#define SCENE_SPRING_BY_HEIGHT_FIELDS(X)                                                             \
    X(profile, PAIRS, 0, 1e6, "", "", 0, "rows (height, factor): 0 the lowest point, 1 the highest", \
      "paper 3.1")

#define SCENE_RIP_FIELDS(X)                                                                      \
    X(at, NUMBER, 0, 1e9, "0", "s", 0, "opens no earlier than this", "paper 4.1")                \
    X(stretch, NUMBER, 0, 1e6, "1", "", 0,                                                       \
      "and not before the mean edge is this long, over the mean rest length", "paper 4.1")       \
    X(place, VECTOR, -1e6, 1e6, "[0.0, 0.0, 1.0]", "", 0,                                        \
      "middle of the cut: a direction from the balloon's centre", "")                            \
    X(direction, VECTOR, -1e6, 1e6, "[0.0, 1.0, 0.0]", "", 0, "in which the cut runs there", "") \
    X(length, NUMBER, 0, 6.2832, "1", "radii", 0, "of the cut along the skin; 2 pi is once around", "")

#define SCENE_GROUND_FIELDS(X)                                                                           \
    X(height, NUMBER, -1e6, 1e6, "-100", "length", 0, "at which it passes the middle of the scene", "")  \
    X(normal, VECTOR, -1e6, 1e6, "[0.0, 1.0, 0.0]", "", 0, "out of it: any direction makes a slope", "") \
    X(friction, NUMBER, 0, 100, "0.5", "", 0,                                                            \
      "largest force along the ground over that into it: skin sticks on slopes up to that tangent",      \
      "Coulomb 1785")                                                                                    \
    X(bounce, NUMBER, 0, 1, "0", "", 0, "speed after a hit over that before", "Newton 1687")

#define SCENE_OBSTACLES_FIELDS(X)                                                                         \
    X(shape, CHOICE, 0, 0, "\"sphere\"", "", 0, "what stands in the way", "")                             \
    X(place, VECTOR, -1e6, 1e6, "[0.0, 0.0, 0.0]", "length", 0, "of its middle", "")                      \
    X(radius, NUMBER, 1e-9, 1e6, "10", "length", 0, "of a sphere", "")                                    \
    X(size, VECTOR, 1e-9, 1e6, "[20.0, 20.0, 20.0]", "length", 0, "of a box, which stands upright", "")   \
    X(friction, NUMBER, 0, 100, "0.5", "", 0, "largest force along it over that into it", "Coulomb 1785") \
    X(bounce, NUMBER, 0, 1, "0", "", 0, "speed after a hit over that before", "Newton 1687")

#define SCENE_NEEDLES_FIELDS(X)                                                             \
    X(at, NUMBER, 0, 1e9, "0", "s", 0, "it is there from then on", "")                      \
    X(from, VECTOR, -1e6, 1e6, "", "length", 0, "where its point is then; to be given", "") \
    X(velocity, VECTOR, -1e9, 1e9, "[0.0, 0.0, 0.0]", "length/s", 0, "of its point", "")

#define SCENE_CONTACT_FIELDS(X)                                                                       \
    X(thickness, NUMBER, 0, 1e6, "0", "length", 0,                                                    \
      "how far apart skins are kept; 0: a tenth of the mean edge", "Bridson, Fedkiw & Anderson 2002") \
    X(friction, NUMBER, 0, 100, "0.3", "", 0, "largest force along the skin over that into it",       \
      "Coulomb 1785")

#define SCENE_GAS_FIELDS(X)                                                                                 \
    X(ambient, NUMBER, 0, 1e12, "0", "force/length^2", 0, "pressure of the air outside; to be given", "")   \
    X(fill, NUMBER, 1e-6, 1e6, "1", "", 0,                                                                  \
      "amount at the start, over what fills the rest volume at ambient pressure", "")                       \
    X(process, CHOICE, 0, 0, "\"isothermal\"", "", 0, "whether heat comes through the skin, or stays",      \
      "ideal gas")                                                                                          \
    X(gamma, NUMBER, 1.01, 2, "1.4", "", 0, "ratio of specific heats", "1.4 air, 5/3 helium")               \
    X(density, NUMBER, 1e-15, 1e9, "1.2", "mass/length^3", 0, "of the gas at ambient pressure",             \
      "1.2 kg/m^3 air, 0.17 helium, at 20 degrees")                                                         \
    X(discharge, NUMBER, 0.01, 1, "0.6", "", 0, "width of the jet over that of the opening",                \
      "sharp edges: pi/(pi + 2) = .611, Kirchhoff 1869")                                                    \
    X(pump, NUMBER, -1e9, 1e9, "0", "1/s", LIVE,                                                            \
      "by how much the fill rises a second; below 0: gas is drawn out, down to the pressure outside", "")   \
    X(pump_until, NUMBER, 0, 1e6, "1e6", "", LIVE,                                                          \
      "fill at which the pump stops, slowing down over the last thousandth; an open neck stops it too", "") \
    X(leak, NUMBER, 0, 1e12, "0", "length^5/force s", 0,                                                    \
      "volume, at ambient pressure, that seeps out a second, over the gauge pressure", "")                  \
    X(neck, NUMBER, 0, 1e12, "0", "length^2", 0, "area of an open neck", "")                                \
    X(neck_at, NUMBER, 0, 1e9, "0", "s", 0, "when the neck opens", "")                                      \
    X(neck_place, VECTOR, -1e6, 1e6, "[0.0, -1.0, 0.0]", "", 0,                                             \
      "where the neck is: a direction from the balloon's centre", "")

#define SCENE_TUBE_FIELDS(X)                                                               \
    X(to, WHOLE, 0, 1e6, "0", "", 0, "number of the balloon at the other end, from 0", "") \
    X(area, NUMBER, 0, 1e12, "0", "length^2", 0, "of the tube, inside; to be given", "")   \
    X(discharge, NUMBER, 0.01, 1, "0.6", "", 0, "width of the jet over that of the tube", "")

#define SCENE_GRAVITY_FIELDS(X)                                                                       \
    X(acceleration, VECTOR, -1e9, 1e9, "[0.0, -9.81, 0.0]", "length/s^2", 0, "of all that falls", "") \
    X(air_density, NUMBER, 0, 1e9, "0", "mass/length^3", 0,                                           \
      "of the air, in which gas of another density rises or sinks; 0: none", "1.2 kg/m^3 at 20 degrees")

#define SCENE_DRAG_FIELDS(X)                                                                            \
    X(air_density, NUMBER, 0, 1e9, "1.2", "mass/length^3", 0, "of the air", "1.2 kg/m^3 at 20 degrees") \
    X(coefficient, NUMBER, 0, 100, "0.47", "", 0, "of drag", "Hoerner 1965: sphere .47, plate 1.1")     \
    X(wind, VECTOR, -1e6, 1e6, "[0.0, 0.0, 0.0]", "length/s", 0, "speed of the air", "")

#define SCENE_PINS_FIELDS(X)                                                                                 \
    X(place, VECTOR, -1e6, 1e6, "[0.0, -1.0, 0.0]", "", 0,                                                   \
      "middle of the patch that is held: a direction from the balloon's centre", "")                         \
    X(reach, NUMBER, 0, 180, "0", "degrees", 0, "how far the patch reaches; 0: its nearest point alone", "") \
    X(until, NUMBER, 0, 1e9, "1e9", "s", 0, "when they let go", "")

#define SCENE_STRING_FIELDS(X)                                                                      \
    X(place, VECTOR, -1e6, 1e6, "[0.0, -1.0, 0.0]", "", 0,                                          \
      "where it is tied on: a direction from the balloon's centre", "")                             \
    X(reach, NUMBER, 0, 180, "0", "degrees", 0, "how far the tied patch reaches; 0: one point", "") \
    X(to, VECTOR, -1e6, 1e6, "[0.0, -2.0, 0.0]", "radii", 0,                                        \
      "the other end, from the balloon's centre: held there, or where the weight hangs", "")        \
    X(slack, NUMBER, 0, 100, "1", "", 0, "its length over the distance that it spans at first", "") \
    X(stiffness, NUMBER, 0, 1e12, "1000", "force/length", 0, "against being longer", "")            \
    X(damping, NUMBER, 0, 1e12, "1", "force s/length", 0, "while it is taut", "")                   \
    X(weight, NUMBER, 0, 1e9, "0", "mass", 0, "at the other end; 0: that end is held", "")

#define SCENE_VISCOSITY_FIELDS(X)                                                                  \
    X(ratio, NUMBER, 0, 1e6, "1", "", 0, "of the second spring's constant to that of the edge's",  \
      "paper, figure 1")                                                                           \
    X(time, NUMBER, 1e-9, 1e9, "1", "s", 0, "in which its pull falls to 1/e; steps are no longer", \
      "paper, figure 1")

#define SCENE_PLASTICITY_FIELDS(X)                                                                           \
    X(yield, NUMBER, 0, 1e12, "40", "force", 0, "at which a spring begins to slip", "paper, figure 1")       \
    X(hardening, NUMBER, 0, 1e12, "0", "force/length", 0, "by which that rises with the way it has slipped", \
      "paper, figure 1")

#define SCENE_BENDING_FIELDS(X)                                                                            \
    X(stiffness, NUMBER, 0, 1e12, "1", "force length", 0,                                                  \
      "energy of bent skin is half of it x curvature^2 x area; rubber has shear_modulus thickness^3 / 3",  \
      "Grinspun et al. 2003")                                                                              \
    X(rest, CHOICE, 0, 0, "\"as_meshed\"", "", 0, "the shape in which no skin is bent: the mesh, or flat", \
      "")                                                                                                  \
    X(damping, NUMBER, 0, 1e6, "0", "s", 0,                                                                \
      "against the speed of bending: in that time an overdamped bend goes back to 1/e", "Kelvin and Voigt")

#define SCENE_MEMBRANE_FIELDS(X)                                                                          \
    X(law, CHOICE, 0, 0, "\"neo-hookean\"", "", 0, "how stress follows stretch", "Ogden 1972")            \
    X(shear_modulus, NUMBER, 1e-9, 1e15, "20", "force/length^2", 0, "of the rubber, at small strain", "") \
    X(thickness, NUMBER, 0, 1e6, "0", "length", 0, "of the skin at rest; to be given", "")                \
    X(density, NUMBER, 1e-15, 1e9, "0.0144", "mass/length^3", 0,                                          \
      "of the rubber, which gives the points their masses in place of point_mass", "")                    \
    X(mooney_ratio, NUMBER, 0, 100, "0.1", "", 0, "C2 over C1 of the Mooney-Rivlin law", "Mooney 1940")   \
    X(gent_limit, NUMBER, 0.1, 1e6, "30", "", 0, "I1 - 3 at which the Gent law locks", "Gent 1996")       \
    X(ogden, PAIRS, -1e12, 1e12, "( (6.3e5, 1.3), (1.2e3, 5.0), (-1e4, -2.0) )", "", 0,                   \
      "rows (m, alpha) of the Ogden law, made to agree with shear_modulus", "Ogden 1972")                 \
    X(compression, NUMBER, 0, 1, "0.05", "", 0,                                                           \
      "share of the stress that is kept where the skin wrinkles; 1: it never wrinkles", "Pipkin 1986")    \
    X(viscosity, NUMBER, 0, 1e12, "0.5", "force s/length^2", 0,                                           \
      "stress over rate of stretch, in the skin's plane", "Kelvin and Voigt")

#define SCENE_FRACTURE_FIELDS(X)                                                                             \
    X(mode, CHOICE, 0, 0, "\"tear\"", "", 0,                                                                 \
      "tear: the skin splits along cracks; paper: edges let go at the threshold", "paper 3.5")               \
    X(strength, NUMBER, 1.01, 100, "2.3", "", 0, "whole skin tears where it is stretched so much both ways", \
      "Petersan et al., Phys. Rev. Lett. 93 (2004) 015504: rubber cracks near 2")                            \
    X(toughness, NUMBER, 0, 1e6, "0.015", "radii", 0,                                                        \
      "energy that an area of crack takes, over the shear modulus", "Griffith 1921")                         \
    X(weakness, NUMBER, 0, 0.99, "0.05", "", 0, "scatter of the strength from place to place", "")           \
    X(seed, WHOLE, 0, 2147483647, "1", "", 0, "of that scatter: same seed, same burst", "")                  \
    X(tip_speed, NUMBER, 0.01, 1e3, "2.5", "", 0, "of a crack's tip at the most, over that of shear waves",  \
      "Petersan et al. 2004: cracks in rubber outrun shear waves")                                           \
    X(branching, NUMBER, 1, 100, "1.68", "", 0, "cracks fork where skin is stretched so much both ways",     \
      "Moulinet & Adda-Bedia, Phys. Rev. Lett. 115 (2015) 184301")                                           \
    X(spacing, NUMBER, 0, 10, "0.9", "radii", 0, "that a crack runs before it forks again, there", "")       \
    X(smallest, NUMBER, 0, 0.5, "0.002", "", 0, "no piece is cut off with less than this share of the skin", \
      "")                                                                                                    \
    X(reserve, NUMBER, 1, 1e4, "100", "radii", 0, "length of all cracks that memory is set aside for", "")

#define SCENE_SCHEDULE_FIELDS(X)                                                                \
    X(at, NUMBER, 0, 1e9, "0", "s", 0, "when the other keys of this entry change", "paper 3.5") \
    X(balloon, WHOLE, -1, 1e6, "-1", "", 0, "number of the balloon, from 0; -1: all", "")

enum scene_type {
    SCENE_NUMBER, /* double */
    SCENE_WHOLE,  /* int */
    SCENE_TEXT,   /* char *, owned; a path */
    SCENE_CHOICE, /* int: index into the field's choices */
    SCENE_VECTOR, /* double[3] */
    SCENE_SIZE,   /* int[2] */
    SCENE_PAIRS,  /* struct scene_profile, owned */
};

enum {
    SCENE_LIVE = 1,
    SCENE_FREE = 2, /* no state depends on it: pictures, the end */
};

struct scene;

struct scene_field {
    const char *key;
    enum scene_type type;
    size_t offset; /* of the member in its block's struct */
    double least, most;
    const char *standard, *unit; /* the default as it would be written; "" for none */
    int flags;
    const char *meaning, *source;
    const char *const *choices; /* NULL-terminated, for SCENE_CHOICE */
};

/* How many digits its range is told with: whole numbers' with all. */
static inline int scene_range_digits(const struct scene_field *field)
{
    return field->type == SCENE_WHOLE ? 10 : 6;
}

/* A block of keys: the scene's own, a list's (balloons, schedule), or an effect's inside a balloon. */
struct scene_block {
    const char *name;   /* "time", "balloons", "rip", ... */
    const char *parent; /* "" or "balloons" */
    bool list;          /* a list of blocks: balloons, schedule */
    const struct scene_field *fields;
    size_t field_count;
    size_t offset;         /* of the block in its parent's struct (not of a list) */
    size_t on_offset;      /* of its `bool on` in the block's struct; SIZE_MAX: always on */
    size_t line_offset;    /* of its `unsigned line`, likewise */
    size_t written_offset; /* of its `struct scene_written` */
    const char *meaning;
};

extern const struct scene_block scene_blocks[];
extern const size_t scene_block_count;

/* The block of that name in that parent, or NULL. */
const struct scene_block *scene_find_block(const char *parent, const char *name);
const struct scene_field *scene_find_field(const struct scene_block *block, const char *key);

/* Where in the scene's file this key of `target`, a block's struct, was written (struct scene_written). */
int scene_line_of(const struct scene_block *block, const void *target, const struct scene_field *field);

/* Where a scene keeps a list of blocks. */
struct scene_list {
    const char *name;
    size_t items, count, capacity; /* offsets in struct scene */
    size_t size;                   /* of an item */
};

const struct scene_list *scene_find_list(const struct scene_block *block); /* a list's; it has one */
void *scene_list_item(const struct scene *scene, const struct scene_list *list, size_t index);

#endif
