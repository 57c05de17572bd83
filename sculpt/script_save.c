/* Scripts of chips: writing single operations, and a script that makes an octree. */
#include "common/file.h"
#include "sculpt/sculpt.h"

#include <math.h>
#include <stdlib.h>

/* As few digits as read back to the same number. */
static void write_number(FILE *stream, double value)
{
    char text[32];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fprintf(stream, " %s", text);
}

static void write_material(FILE *stream, unsigned material, struct chip_state *state)
{
    if (material != state->material)
        fprintf(stream, "material %u\n", material);
    state->material = material;
}

static void write_mirror(FILE *stream, unsigned mirror, struct chip_state *state)
{
    if (mirror != state->mirror)
        fprintf(stream, "mirror %s%s%s%s\n", mirror ? "" : "none", mirror & CHIP_MIRROR_X ? "x" : "",
                mirror & CHIP_MIRROR_Y ? "y" : "", mirror & CHIP_MIRROR_Z ? "z" : "");
    state->mirror = mirror;
}

void chip_write(FILE *stream, const struct chip *chip, struct chip_state *state)
{
    const struct chip_shape_name *name = &chip_kind_names[chip->kind];
    if (chip->kind < CHIP_STEP)
        write_mirror(stream, chip->mirror, state);
    if (chip->kind == CHIP_CARVE) {
        name = &chip_shape_names[chip->shape];
        if (chip->material)
            write_material(stream, chip->material, state);
        fputs(chip->material ? "fill " : "chip ", stream);
    }
    fputs(name->name, stream);
    for (int i = 0; i < name->count; i++)
        write_number(stream, chip->value[i]);
    fputc('\n', stream);
}

struct leaf_writer {
    FILE *stream;
    double cell; /* its side */
    struct chip_state state;
};

/* Coordinates are whole numbers over 2^10 at most, which ten digits hold exactly. */
static bool write_leaf(void *context, const struct octree_leaf *leaf)
{
    struct leaf_writer *writer = context;
    double cell = writer->cell;
    write_material(writer->stream, leaf->material, &writer->state);
    fprintf(writer->stream, "fill box %.10g %.10g %.10g %.10g %.10g %.10g\n", leaf->x * cell, leaf->y * cell,
            leaf->z * cell, (leaf->x + leaf->side) * cell, (leaf->y + leaf->side) * cell,
            (leaf->z + leaf->side) * cell);
    return true;
}

enum status chips_save(const struct octree *tree, const char *path, struct error *err)
{
    struct file_out *out;
    enum status status = file_out_open(path, &out, err);
    if (status)
        return status;
    struct leaf_writer writer = {file_out_stream(out), ldexp(1, -(int)tree->depth), {1, 0}};
    fprintf(writer.stream, "# %zu leaves\ndepth %u\n", octree_leaf_count(tree), tree->depth);
    fputs("start empty\n", writer.stream);
    for (int m = 1; m < OCTREE_MATERIALS; m++)
        if (tree->coefficient[m] != 1)
            fprintf(writer.stream, "coefficient %d %.9g\n", m, (double)tree->coefficient[m]);
    octree_visit_all(tree, write_leaf, &writer);
    return file_out_commit(out, err);
}
