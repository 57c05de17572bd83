/* Scripts of chips: reading .chips files. */
#include "common/array.h"
#include "common/file.h"
#include "common/text.h"
#include "sculpt/sculpt.h"

#include <math.h>
#include <stdlib.h>

struct parser {
    struct text text;
    struct chips chips;
    struct chip_state state; /* of the next operation */
    struct error *err;
};

/* The next word of the line that is no comment. */
static bool next_word(struct parser *parser, struct word *word)
{
    return text_word(&parser->text, word) && word->start[0] != '#';
}

static enum status end_line(struct parser *parser, const char *usage)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (!next_word(parser, &word))
        return STATUS_OK;
    return text_fail(&parser->text, parser->err, "\"%s\" is one word too many; the line is: %s",
                     word_show(word, shown), usage);
}

static enum status read_whole(struct parser *parser, const char *usage, int least, int most, int *value)
{
    struct word word;
    long long number;
    char shown[WORD_SHOWN_SIZE];
    if (!next_word(parser, &word))
        return text_fail(&parser->text, parser->err, "the line ends early; it is: %s", usage);
    if (!word_whole(word, &number) || number < least || number > most)
        return text_fail(&parser->text, parser->err,
                         "\"%s\" must be a whole number from %d to %d; the line is: %s",
                         word_show(word, shown), least, most, usage);
    *value = (int)number;
    return STATUS_OK;
}

static enum status read_number(struct parser *parser, const char *usage, double *value)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (!next_word(parser, &word))
        return text_fail(&parser->text, parser->err, "the line ends early; it is: %s", usage);
    if (!word_number(word, value) || !isfinite(*value))
        return text_fail(&parser->text, parser->err, "\"%s\" must be a finite number; the line is: %s",
                         word_show(word, shown), usage);
    return STATUS_OK;
}

/* depth and start say what is carved: once, and before it is. */
static enum status check_header(struct parser *parser, const char *name, int seen_at)
{
    if (seen_at)
        return text_fail(&parser->text, parser->err, "%s a second time; line %d has it already", name,
                         seen_at);
    if (parser->chips.count > 0)
        return text_fail(&parser->text, parser->err, "%s must come before the first operation", name);
    return STATUS_OK;
}

static enum status read_depth(struct parser *parser)
{
    static const char usage[] = "depth N";
    struct chips *chips = &parser->chips;
    enum status status = check_header(parser, "depth", chips->depth_line);
    if (!status)
        status = read_whole(parser, usage, 0, OCTREE_DEPTH_MAX, &chips->depth);
    chips->depth_line = (int)parser->text.line;
    return status ? status : end_line(parser, usage);
}

static enum status read_start(struct parser *parser)
{
    static const char usage[] = "start full, or: start empty";
    struct chips *chips = &parser->chips;
    struct word word = {0};
    enum status status = check_header(parser, "start", chips->start_line);
    if (status)
        return status;
    if (!next_word(parser, &word) || (!word_is(word, "full") && !word_is(word, "empty")))
        return text_fail(&parser->text, parser->err, "full or empty is missing; the line is: %s", usage);
    chips->start_material = word_is(word, "full") ? parser->state.material : 0;
    chips->start_line = (int)parser->text.line;
    return end_line(parser, usage);
}

static enum status read_material(struct parser *parser)
{
    static const char usage[] = "material N";
    int material = 0;
    enum status status = read_whole(parser, usage, 1, OCTREE_MATERIALS - 1, &material);
    parser->state.material = (unsigned)material;
    return status ? status : end_line(parser, usage);
}

static enum status read_coefficient(struct parser *parser)
{
    static const char usage[] = "coefficient N B";
    int material = 0;
    double value = 0;
    enum status status = read_whole(parser, usage, 1, OCTREE_MATERIALS - 1, &material);
    if (!status)
        status = read_number(parser, usage, &value);
    if (!status && !(fabs(value) <= OCTREE_COEFFICIENT_MAX))
        status = text_fail(&parser->text, parser->err, "coefficient %g; must be within +-%g", value,
                           OCTREE_COEFFICIENT_MAX);
    parser->chips.coefficient[material] = (float)value;
    parser->chips.has_coefficient[material] = true;
    return status ? status : end_line(parser, usage);
}

static enum status read_mirror(struct parser *parser)
{
    static const char usage[] = "mirror none, or some of the letters x, y and z";
    static const char *const names[8] = {"none", "x", "y", "xy", "z", "xz", "yz", "xyz"};
    struct word word = {0};
    char shown[WORD_SHOWN_SIZE];
    if (!next_word(parser, &word))
        return text_fail(&parser->text, parser->err, "the line ends early; it is: %s", usage);
    for (unsigned axes = 0; axes < 8; axes++)
        if (word_is(word, names[axes])) {
            parser->state.mirror = axes;
            return end_line(parser, usage);
        }
    return text_fail(&parser->text, parser->err,
                     "\"%s\" is no mirror; there are none, x, y, z, xy, xz, yz and xyz",
                     word_show(word, shown));
}

static enum status find_shape(struct parser *parser, enum chip_shape *shape)
{
    struct word word = {0};
    char shown[WORD_SHOWN_SIZE];
    bool given = next_word(parser, &word);
    for (int i = 0; i < CHIP_SHAPES && given; i++)
        if (word_is(word, chip_shape_names[i].name)) {
            *shape = (enum chip_shape)i;
            return STATUS_OK;
        }
    static const char shapes[] = "box, sphere, ellipsoid, half-space, cylinder, cone and capsule";
    if (!given)
        return text_fail(&parser->text, parser->err, "the shape is missing; there are %s", shapes);
    return text_fail(&parser->text, parser->err, "\"%s\" is no shape; there are %s", word_show(word, shown),
                     shapes);
}

/* The values of an operation whose name has been read, and the end of its line. */
static enum status read_values(struct parser *parser, struct chip *chip, const char *usage, int count)
{
    struct error why = {0};
    enum status status = STATUS_OK;
    for (int i = 0; i < count && !status; i++)
        status = read_number(parser, usage, &chip->value[i]);
    if (!status)
        status = end_line(parser, usage);
    if (status)
        return status;
    if (chip_check(chip, &why))
        return text_fail(&parser->text, parser->err, "%s", why.text);
    if (!ARRAY_RESERVE(&parser->chips, 1))
        return error_no_memory(parser->err, "the chips");
    parser->chips.items[parser->chips.count++] = *chip;
    return STATUS_OK;
}

static enum status read_chip(struct parser *parser, unsigned material)
{
    struct chip chip = {.material = material, .mirror = parser->state.mirror};
    enum status status = find_shape(parser, &chip.shape);
    if (status)
        return status;
    const struct chip_shape_name *name = &chip_shape_names[chip.shape];
    char usage[64];
    snprintf(usage, sizeof usage, "%s %s %s", material ? "fill" : "chip", name->name, name->values);
    return read_values(parser, &chip, usage, name->count);
}

static enum status read_tool(struct parser *parser, enum chip_kind kind)
{
    const struct chip_shape_name *name = &chip_kind_names[kind];
    struct chip chip = {.kind = kind, .mirror = name->count > 0 ? parser->state.mirror : 0};
    char usage[64];
    snprintf(usage, sizeof usage, "%s%s%s", name->name, name->count > 0 ? " " : "", name->values);
    return read_values(parser, &chip, usage, name->count);
}

static enum status read_line(struct parser *parser)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (!next_word(parser, &word))
        return STATUS_OK;
    if (word_is(word, "chip"))
        return read_chip(parser, 0);
    if (word_is(word, "fill"))
        return read_chip(parser, parser->state.material);
    for (int kind = CHIP_SANDPAPER; kind < CHIP_KINDS; kind++)
        if (word_is(word, chip_kind_names[kind].name))
            return read_tool(parser, (enum chip_kind)kind);
    if (word_is(word, "mirror"))
        return read_mirror(parser);
    if (word_is(word, "material"))
        return read_material(parser);
    if (word_is(word, "coefficient"))
        return read_coefficient(parser);
    if (word_is(word, "depth"))
        return read_depth(parser);
    if (word_is(word, "start"))
        return read_start(parser);
    return text_fail(
        &parser->text, parser->err,
        "\"%s\" is unknown; a line begins with chip, fill, sandpaper, heat, mirror, material, coefficient, step, "
        "undo, redo, depth or start",
        word_show(word, shown));
}

enum status chips_parse(const char *name, const void *text, size_t size, struct chips *chips,
                        struct error *err)
{
    struct parser parser = {
        .text = text_of(name, text, size), .chips.start_material = 1, .state = {1, 0}, .err = err};
    enum status status = STATUS_OK;
    if (size == 0)
        status = error_set(err, STATUS_INPUT,
                           "%s: the file is empty; a line such as \"chip sphere %s\" is wanted", name,
                           "0.5 0.5 0.5 0.2");
    for (; !status && !text_ended(&parser.text); text_next_line(&parser.text))
        status = read_line(&parser);
    if (status) {
        chips_clear(&parser.chips);
        return status;
    }
    chips_clear(chips);
    *chips = parser.chips;
    return STATUS_OK;
}

enum status chips_load(const char *path, struct chips *chips, struct error *err)
{
    struct bytes file = {0};
    enum status status = file_read(path, &file, err);
    if (!status)
        status = chips_parse(path, file.data, file.size, chips, err);
    bytes_clear(&file);
    return status;
}

void chips_clear(struct chips *chips)
{
    free(chips->items);
    *chips = (struct chips){0};
}

void chips_set_coefficients(const struct chips *chips, struct octree *tree)
{
    for (int m = 0; m < OCTREE_MATERIALS; m++)
        if (chips->has_coefficient[m])
            tree->coefficient[m] = chips->coefficient[m];
}

enum status chips_begin(const struct chips *chips, unsigned depth, struct octree *tree, struct error *err)
{
    struct octree cube = {0};
    enum status status = octree_init(&cube, chips->depth_line ? (unsigned)chips->depth : depth,
                                     chips->start_material, err);
    if (status)
        return status;
    chips_set_coefficients(chips, &cube);
    octree_clear(tree);
    *tree = cube;
    return STATUS_OK;
}
