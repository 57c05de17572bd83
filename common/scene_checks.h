/* Contradictions between the blocks of a scene, for scene_check(). Each scene_check_...() returns
 * STATUS_INPUT with the block's line, or STATUS_OK. */
#ifndef COMMON_SCENE_CHECKS_H
#define COMMON_SCENE_CHECKS_H

#include "common/scene.h"

/* "FILE:LINE: balloons[NUMBER].NAME: ..."; without the line where the block came by scene_set(). */
enum status scene_contradiction(const struct scene *scene, size_t number, const char *name, unsigned line,
                                struct error *err, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* Whether an entry of the schedule changes this key of this balloon. */
bool scene_changes(const struct scene_schedule *entry, const char *key, size_t number);

/* Whether any balloon has gas. */
bool scene_has_gas(const struct scene *scene);

/* Gas and tube of one balloon: what is missing, what cannot be had together, a pump without
 * gas, a tube to nowhere. */
enum status scene_check_gas(const struct scene *scene, size_t number, struct error *err);

/* Directions of pins, string and neck that are none. */
enum status scene_check_places(const struct scene *scene, size_t number, struct error *err);

/* Ground, needles and schedule: a slope without direction, a needle that is nowhere, a change of a balloon
 * that is not there. */
enum status scene_check_surroundings(const struct scene *scene, struct error *err);

/* A skin that tears by a method, or with springs, that cannot follow it (scene_checks_skin.c). */
enum status scene_check_fracture(const struct scene *scene, size_t number, struct error *err);

/* A membrane without thickness, with springs' settings or springs' methods, or of no rubber; bending by a
 * method that cannot follow it (scene_checks_skin.c). */
enum status scene_check_skin(const struct scene *scene, size_t number, struct error *err);

#endif
