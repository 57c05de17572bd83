/* The scene of a thin sphere of rubber and its gas, in units of its radius, shear modulus,
 * density and thickness. */
#ifndef TESTS_SUPPORT_RUBBER_H
#define TESTS_SUPPORT_RUBBER_H

#include "common/scene.h"

#include <math.h>
#include <stdio.h>

static inline enum status rubber_key(struct scene *scene, const char *key, double value, struct error *err)
{
    char text[128];
    snprintf(text, sizeof text, "%s=%.17g", key, value);
    return scene_set(scene, text, err);
}

/* What a thin neo-Hookean sphere of radius 1 holds at this stretch: p = 2 (1/L - 1/L^7). */
static inline double rubber_pressure(double stretch)
{
    return 2 * (1 / stretch - pow(stretch, -7));
}

/* A membrane with the gas that holds it at this stretch. An ambient pressure of 30 and a gas of
 * density .15 are those of a toy balloon of latex (1e5 over 3e3 Pa, 1.2 over 8 kg/m^3 with its
 * thickness counted as 1). */
static inline enum status rubber_keys(struct scene *scene, double stretch, double viscosity,
                                      struct error *err)
{
    const struct {
        const char *key;
        double value;
    } keys[] = {{"radius", 1},
                {"pressure", 0},
                {"membrane.shear_modulus", 1},
                {"membrane.thickness", 1},
                {"membrane.density", 1},
                {"membrane.viscosity", viscosity},
                {"gas.ambient", 30},
                {"gas.density", 0.15},
                {"gas.fill", stretch * stretch * stretch * (1 + rubber_pressure(stretch) / 30)}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        char path[64];
        snprintf(path, sizeof path, "balloons[0].%s", keys[i].key);
        if (rubber_key(scene, path, keys[i].value, err))
            return err->status;
    }
    return STATUS_OK;
}

#endif
