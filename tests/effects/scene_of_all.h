/* A scene that calls for every effect there is, and the same with effects left out: three balloons that
 * nothing brings near each other. */
#ifndef TESTS_EFFECTS_SCENE_OF_ALL_H
#define TESTS_EFFECTS_SCENE_OF_ALL_H

#include "sim/sim.h"
#include "support/shapes.h"

#include <string.h>

enum { BALLOONS = 3 };

/* What calls for an effect; those that would have no work without another, or no meaning, are named. */
struct call {
    const char *name, *keys[4], *needs;
};

static const struct call calls[] = {
    {"spring_by_height", {"balloons[0].spring_by_height.profile=((0.0, 1.0), (1.0, 2.0))"}, NULL},
    {"rip", {"balloons[0].rip.at=0.1"}, NULL},
    {"membrane", {"balloons[1].membrane.thickness=0.45"}, NULL},
    {"bending", {"balloons[1].bending.stiffness=1", "balloons[2].bending.damping=0.1"}, NULL},
    {"viscosity", {"balloons[0].viscosity.ratio=0.5"}, NULL},
    {"plasticity", {"balloons[0].plasticity.yield=1"}, NULL},
    {"pressure_on", {"balloons[0].pressure_on=areas", "balloons[0].pressure=0.5"}, NULL},
    {"gas",
     {"balloons[1].gas.ambient=10", "balloons[1].gas.fill=1.1", "balloons[2].gas.ambient=10",
      "balloons[2].gas.fill=1.4"},
     NULL},
    {"tube", {"balloons[1].tube.to=2", "balloons[1].tube.area=1"}, "gas"},
    {"needles", {"needles[0].from=[0, 200, 0]", "needles[0].velocity=[0, -2000, 0]"}, NULL},
    {"ground", {"ground.height=-46"}, NULL},
    {"obstacles", {"obstacles[0].shape=sphere", "obstacles[0].place=[0, 60, 0]"}, NULL},
    {"contact", {"contact.friction=0.2"}, NULL},
    {"gravity", {"gravity.acceleration=[0, -20, 0]"}, NULL},
    {"drag", {"drag.air_density=1e-6"}, NULL},
    {"string", {"balloons[2].string.weight=1"}, NULL},
    {"pins", {"balloons[0].pins.reach=20"}, NULL},
    {"fracture", {"balloons[2].fracture.strength=1.5"}, NULL},
};

static const char *const common_keys[] = {"time.integrator=symplectic-euler",
                                          "time.step=0.0125",
                                          "balloons[0].threshold=1.4",
                                          "balloons[0].pressure=0",
                                          "balloons[1].mesh=sphere",
                                          "balloons[1].position=[200, 0, 0]",
                                          "balloons[1].pressure=0",
                                          "balloons[2].mesh=sphere",
                                          "balloons[2].position=[-200, 0, 0]",
                                          "balloons[2].pressure=0"};

struct scene_of_all {
    struct scene scene;
    struct mesh mesh[BALLOONS];
    struct sim sim;
};

/* All but `without`, and what needs that one; "all": none at all. */
static inline enum status scene_of_all_open(struct scene_of_all *s, unsigned level, const char *without,
                                            struct error *err)
{
    *s = (struct scene_of_all){0};
    enum status status = scene_from_mesh("sphere", &s->scene, err);
    for (size_t i = 0; i < sizeof common_keys / sizeof common_keys[0] && !status; i++)
        status = scene_set(&s->scene, common_keys[i], err);
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++)
        for (size_t k = 0; k < 4 && calls[i].keys[k] && !status; k++)
            if (strcmp(without, "all") && strcmp(without, calls[i].name) &&
                (!calls[i].needs || strcmp(without, calls[i].needs)))
                status = scene_set(&s->scene, calls[i].keys[k], err);
    if (!status)
        status = scene_check(&s->scene, err);
    for (int i = 0; i < BALLOONS; i++)
        shape_icosphere(level, &s->mesh[i]);
    return status ? status : sim_open(&s->sim, &s->scene, s->mesh, 1, err);
}

static inline void scene_of_all_close(struct scene_of_all *s)
{
    sim_clear(&s->sim);
    for (int i = 0; i < BALLOONS; i++)
        mesh_clear(&s->mesh[i]);
    scene_clear(&s->scene);
}

#endif
