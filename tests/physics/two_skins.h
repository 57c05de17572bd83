/* Scenes of skins that meet. */
#ifndef TESTS_TWO_SKINS_H
#define TESTS_TWO_SKINS_H

#include "../unit/balloon.h"
#include "common/random.h"

/* One or two balloons (the second NULL), icospheres of this level. */
struct scene_of_two {
    struct scene scene;
    struct mesh mesh[2];
    struct sim sim;
};

static inline void open_scene(struct scene_of_two *s, unsigned level, unsigned workers,
                              const char *const *changes)
{
    struct error err = {0};
    *s = (struct scene_of_two){0};
    assert_ok(scene_from_mesh("sphere", &s->scene, &err), &err);
    for (; *changes; changes++)
        assert_ok(scene_set(&s->scene, *changes, &err), &err);
    assert_ok(scene_check(&s->scene, &err), &err);
    for (size_t i = 0; i < s->scene.balloon_count; i++)
        shape_icosphere(level, &s->mesh[i]);
    assert_ok(sim_open(&s->sim, &s->scene, s->mesh, workers, &err), &err);
}

static inline void close_scene(struct scene_of_two *s)
{
    sim_clear(&s->sim);
    for (int i = 0; i < 2; i++)
        mesh_clear(&s->mesh[i]);
    scene_clear(&s->scene);
}

/* Sucked empty, with a swirl that breaks its symmetry. */
#define FOLDING                                                                               \
    SETTINGS("contact.thickness=0.5", "balloons[0].pressure=-4", "balloons[0].threshold=100", \
             "time.guard=substep", "time.step=0.0125")
/* Thrown at each other. */
#define COLLIDING                                                                                  \
    SETTINGS("contact.thickness=0.5", "balloons[1].mesh=sphere", "balloons[0].position=[-60,0,0]", \
             "balloons[1].position=[60,3,2]", "balloons[0].pressure=0", "balloons[1].pressure=0",  \
             "balloons[0].threshold=100", "balloons[1].threshold=100", "time.guard=substep",       \
             "time.step=0.0125")
/* Between two boxes that leave it less room than it wants. */
#define SQUEEZED                                                                                         \
    SETTINGS("contact.thickness=0.5", "balloons[0].threshold=100", "balloons[0].pressure=6",             \
             "time.guard=substep", "obstacles[0].shape=box", "obstacles[0].size=[400,40,400]",           \
             "obstacles[0].place=[0,-70,0]", "obstacles[1].shape=box", "obstacles[1].size=[400,40,400]", \
             "obstacles[1].place=[0,70,0]", "time.step=0.0125")

static inline void swirl(struct sim *sim, double speed)
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3; i++)
            sim->velocity[p][i] = speed * sin(sim->position[p][(i + 1) % 3] / 8 + i);
}

static inline void throw(struct sim * sim, double speed)
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        sim->velocity[p][0] = sim->position[p][0] < 0 ? speed : -speed;
}

#endif
