/* Single chips: what they are called, what they must be, and carving them. */
#include "sculpt/sculpt.h"

#include "common/vec3.h"
#include "sculpt/shapes.h"

#include <math.h>

const struct chip_shape_name chip_shape_names[CHIP_SHAPES] = {
    [CHIP_BOX] = {"box", "X0 Y0 Z0 X1 Y1 Z1", 6},
    [CHIP_SPHERE] = {"sphere", "X Y Z R", 4},
    [CHIP_ELLIPSOID] = {"ellipsoid", "X Y Z RX RY RZ", 6},
    [CHIP_HALF_SPACE] = {"half-space", "X Y Z NX NY NZ", 6},
    [CHIP_CYLINDER] = {"cylinder", "X0 Y0 Z0 X1 Y1 Z1 R", 7},
    [CHIP_CONE] = {"cone", "X0 Y0 Z0 X1 Y1 Z1 R0 R1", 8},
    [CHIP_CAPSULE] = {"capsule", "X0 Y0 Z0 X1 Y1 Z1 R0 R1", 8},
};

static enum status check_values(const struct chip *chip, struct error *err)
{
    for (int i = 0; i < chip_shape_names[chip->shape].count; i++)
        if (!(fabs(chip->value[i]) <= CHIP_VALUE_MAX))
            return error_set(err, STATUS_RANGE, "number %d of the %s is %g; must be within +-%g", i + 1,
                             chip_shape_names[chip->shape].name, chip->value[i], CHIP_VALUE_MAX);
    return STATUS_OK;
}

static enum status check_radius(const struct chip *chip, int i, struct error *err)
{
    if (chip->value[i] >= CHIP_LENGTH_MIN)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE, "a radius of the %s is %g; must be above 0",
                     chip_shape_names[chip->shape].name, chip->value[i]);
}

static enum status check_box(const double *value, struct error *err)
{
    for (int k = 0; k < 3; k++)
        if (!(fabs(value[k] - value[k + 3]) >= CHIP_LENGTH_MIN))
            return error_set(err, STATUS_RANGE, "the box is flat along %c; its corners must differ there",
                             "xyz"[k]);
    return STATUS_OK;
}

static enum status check_axis(const struct chip *chip, struct error *err)
{
    if (vec3_distance(chip->value, chip->value + 3) >= CHIP_LENGTH_MIN)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE, "the axis of the %s has no length; its ends must differ",
                     chip_shape_names[chip->shape].name);
}

static enum status check_cone(const struct chip *chip, struct error *err)
{
    const double *radius = chip->value + 6;
    for (int i = 6; i < 8; i++)
        if (chip->value[i] != 0 && check_radius(chip, i, err))
            return STATUS_RANGE;
    if (radius[0] == 0 && radius[1] == 0)
        return error_set(err, STATUS_RANGE, "both radii of the cone are 0; one must be above 0");
    return check_axis(chip, err);
}

enum status chip_check(const struct chip *chip, struct error *err)
{
    enum status status = check_values(chip, err);
    if (status)
        return status;
    switch (chip->shape) {
    case CHIP_BOX:
        return check_box(chip->value, err);
    case CHIP_SPHERE:
        return check_radius(chip, 3, err);
    case CHIP_ELLIPSOID:
        for (int i = 3; i < 6 && !status; i++)
            status = check_radius(chip, i, err);
        return status;
    case CHIP_HALF_SPACE:
        if (vec3_length(chip->value + 3) >= CHIP_LENGTH_MIN)
            return STATUS_OK;
        return error_set(err, STATUS_RANGE, "the half-space's normal has no length; must point somewhere");
    case CHIP_CYLINDER:
        status = check_radius(chip, 6, err);
        return status ? status : check_axis(chip, err);
    case CHIP_CONE:
        return check_cone(chip, err);
    case CHIP_CAPSULE:
    case CHIP_SHAPES:
        status = check_radius(chip, 6, err);
        return status ? status : check_radius(chip, 7, err);
    }
    return STATUS_OK;
}

enum status sculpt_chip(struct octree *tree, const struct chip *chip, struct error *err)
{
    struct shape shape;
    shape_init(&shape, chip, tree->depth);
    return octree_apply(tree, shape.covers, &shape, chip->material, err);
}
