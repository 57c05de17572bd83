/* The small balloon of rubber that the tests of membranes begin with. */
#ifndef TESTS_UNIT_MEMBRANES_H
#define TESTS_UNIT_MEMBRANES_H

#include "balloon.h"
#include "sim/membrane.h"

/* A small stiff balloon of radius 1, mu = h = 1 but for what a test changes. */
#define RUBBER(...)                                                                           \
    SETTINGS("balloons[0].radius=1", "balloons[0].pressure=0", "balloons[0].threshold=1e300", \
             "balloons[0].membrane.thickness=1", "balloons[0].membrane.shear_modulus=1",      \
             "balloons[0].membrane.density=1",                                                \
             "balloons[0].membrane.viscosity=0" __VA_OPT__(, ) __VA_ARGS__)

#endif
