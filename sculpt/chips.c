/* Single operations: what they are called, what they must be, their mirror images, and doing them. */
#include "sculpt/sculpt.h"

#include "common/vec3.h"
#include "sculpt/shapes.h"
#include "sculpt/smooth.h"

#include <math.h>
#include <string.h>

const struct chip_shape_name chip_shape_names[CHIP_SHAPES] = {
    [CHIP_BOX] = {"box", "X0 Y0 Z0 X1 Y1 Z1", 6},
    [CHIP_SPHERE] = {"sphere", "X Y Z R", 4},
    [CHIP_ELLIPSOID] = {"ellipsoid", "X Y Z RX RY RZ", 6},
    [CHIP_HALF_SPACE] = {"half-space", "X Y Z NX NY NZ", 6},
    [CHIP_CYLINDER] = {"cylinder", "X0 Y0 Z0 X1 Y1 Z1 R", 7},
    [CHIP_CONE] = {"cone", "X0 Y0 Z0 X1 Y1 Z1 R0 R1", 8},
    [CHIP_CAPSULE] = {"capsule", "X0 Y0 Z0 X1 Y1 Z1 R0 R1", 8},
};

const struct chip_shape_name chip_kind_names[CHIP_KINDS] = {
    [CHIP_CARVE] = {"chip", "SHAPE VALUES", 0},
    [CHIP_SANDPAPER] = {"sandpaper", "X Y Z R", 4},
    [CHIP_HEAT] = {"heat", "X Y Z R", 4},
    [CHIP_STEP] = {"step", "", 0},
    [CHIP_UNDO] = {"undo", "", 0},
    [CHIP_REDO] = {"redo", "", 0},
};

static const struct chip_shape_name *name_of(const struct chip *chip)
{
    return chip->kind == CHIP_CARVE ? &chip_shape_names[chip->shape] : &chip_kind_names[chip->kind];
}

static enum status check_values(const struct chip *chip, struct error *err)
{
    for (int i = 0; i < name_of(chip)->count; i++)
        if (!(fabs(chip->value[i]) <= CHIP_VALUE_MAX))
            return error_set(err, STATUS_RANGE, "number %d of the %s is %g; must be within +-%g", i + 1,
                             name_of(chip)->name, chip->value[i], CHIP_VALUE_MAX);
    return STATUS_OK;
}

static enum status check_radius(const struct chip *chip, int i, struct error *err)
{
    if (chip->value[i] >= CHIP_LENGTH_MIN)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE, "a radius of the %s is %g; must be at least %g", name_of(chip)->name,
                     chip->value[i], CHIP_LENGTH_MIN);
}

static enum status check_box(const double *value, struct error *err)
{
    for (int k = 0; k < 3; k++)
        if (!(fabs(value[k] - value[k + 3]) >= CHIP_LENGTH_MIN))
            return error_set(err, STATUS_RANGE,
                             "the box is flat along %c; its corners must differ there, by at least %g",
                             "xyz"[k], CHIP_LENGTH_MIN);
    return STATUS_OK;
}

static enum status check_axis(const struct chip *chip, struct error *err)
{
    if (vec3_distance(chip->value, chip->value + 3) >= CHIP_LENGTH_MIN)
        return STATUS_OK;
    return error_set(err, STATUS_RANGE,
                     "the axis of the %s has no length; its ends must differ, by at least %g",
                     chip_shape_names[chip->shape].name, CHIP_LENGTH_MIN);
}

static enum status check_cone(const struct chip *chip, struct error *err)
{
    const double *radius = chip->value + 6;
    for (int i = 6; i < 8; i++)
        if (chip->value[i] != 0 && check_radius(chip, i, err))
            return STATUS_RANGE;
    if (radius[0] == 0 && radius[1] == 0)
        return error_set(err, STATUS_RANGE, "both radii of the cone are 0; one must be at least %g",
                         CHIP_LENGTH_MIN);
    return check_axis(chip, err);
}

static enum status check_shape(const struct chip *chip, struct error *err)
{
    enum status status = STATUS_OK;
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
        return error_set(err, STATUS_RANGE, "the half-space's normal has no length; must have at least %g",
                         CHIP_LENGTH_MIN);
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

enum status chip_check(const struct chip *chip, struct error *err)
{
    enum status status = check_values(chip, err);
    if (status)
        return status;
    if (chip->kind == CHIP_CARVE)
        return check_shape(chip, err);
    return name_of(chip)->count > 0 ? check_radius(chip, 3, err) : STATUS_OK;
}

struct chip chip_image(const struct chip *chip, unsigned axes)
{
    struct chip image = *chip;
    bool carves = chip->kind == CHIP_CARVE;
    bool two_points = carves && chip->shape != CHIP_SPHERE && chip->shape != CHIP_ELLIPSOID;
    for (int k = 0; k < 3; k++) {
        if (!(axes >> k & 1))
            continue;
        image.value[k] = 1 - chip->value[k];
        if (two_points)
            image.value[k + 3] = (chip->shape == CHIP_HALF_SPACE ? 0 : 1) - chip->value[k + 3];
    }
    image.mirror = 0;
    return image;
}

/* A box holds its lower borders and not its upper ones; its image about the middle planes of these axes holds
 * the upper ones, as if both lay at the next number. */
static enum status carve(struct octree *tree, const struct chip *chip, unsigned axes, struct error *err)
{
    struct shape shape;
    shape_init(&shape, chip, tree->depth);
    for (int k = 0; k < 3; k++)
        if (chip->shape == CHIP_BOX && axes >> k & 1) {
            shape.low[k] = nextafter(shape.low[k], HUGE_VAL);
            shape.high[k] = nextafter(shape.high[k], HUGE_VAL);
        }
    return octree_apply(tree, shape.covers, &shape, chip->material, err);
}

enum status sculpt_chip(struct octree *tree, const struct chip *chip, struct error *err)
{
    enum status status = STATUS_OK;
    struct smooth_balls balls = {.radius = chip->value[3]};
    if (chip->kind >= CHIP_STEP)
        return STATUS_OK;
    for (unsigned axes = 0; axes < 8 && !status; axes++) {
        if (axes & ~chip->mirror)
            continue;
        const struct chip image = chip_image(chip, axes);
        if (chip->kind == CHIP_CARVE)
            status = carve(tree, &image, axes, err);
        else
            memcpy(balls.centre[balls.count++], image.value, sizeof *balls.centre);
    }
    return chip->kind == CHIP_CARVE ? status : smooth(tree, chip->kind, &balls, err);
}
