#include "common/scene_value.h"
#include "common/array.h"
#include "common/scene.h"
#include "common/scene_syntax.h"
#include "common/spelling.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum status scene_refuse(const struct scene_source *source, const config_setting_t *at, struct error *err,
                         const char *format, ...)
{
    char text[ERROR_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (source->text) {
        const struct scene_place place = scene_text_place(source->text, config_setting_source_line(at));
        return error_set(err, STATUS_INPUT, "%s:%u: %s", place.file, place.line, text);
    }
    return error_set(err, STATUS_INPUT, "--set: %s", text);
}

/* Where a block of that name belongs that does not belong here; NULL: there is none. */
static const char *place_of(const char *name)
{
    for (size_t i = 0; i < scene_block_count; i++)
        if (!strcmp(scene_blocks[i].name, name))
            return scene_blocks[i].parent[0] ? "stands inside a balloon: balloons = ( { ... } )"
                                             : "stands outside of balloons, on its own";
    return NULL;
}

struct path {
    char text[128];
};

/* "gravity", "gravity.acceleration", "balloons[0].gas", "needles[0].from" */
static struct path path_of(const struct scene_block *block, const char *key)
{
    struct path path;
    snprintf(path.text, sizeof path.text, "%s%s%s%s%s%s", block->parent, block->parent[0] ? "[0]." : "",
             block->name, key && block->list ? "[0]" : "", key ? "." : "", key ? key : "");
    return path;
}

/* The path of a name anywhere in a scene that is alike in four of five letters, since there are many; "" where
 * there is none. */
static struct path find_elsewhere(const char *name)
{
    struct spelling close = {name, NULL, strlen(name) / 5 + 1};
    struct path path = {""};
    for (size_t i = 0; i < scene_block_count; i++) {
        const struct scene_block *block = &scene_blocks[i];
        for (size_t k = 0; k <= block->field_count; k++) {
            const char *key = k < block->field_count ? block->fields[k].key : NULL, *was = close.nearest;
            spelling_consider(&close, key ? key : block->name);
            if (close.nearest != was)
                path = path_of(block, key);
        }
    }
    return path;
}

enum status scene_refuse_name(const struct scene_source *source, const config_setting_t *at, const char *name,
                              const struct scene_block *block, struct error *err)
{
    enum { SLIP = 2 };
    const char *owner = block ? block->name : "", *place = place_of(name);
    if (place && !strcmp(owner, "schedule"))
        return scene_refuse(
            source, at, err,
            "`%s` is a block, which no schedule changes; --help-scene marks the keys that can "
            "change, as in { at = 1; threshold = 3; }",
            name);
    if (place)
        return scene_refuse(source, at, err, "the block `%s` %s", name, place);
    struct spelling guess = spelling_of(name);
    for (size_t i = 0; block && i < block->field_count; i++)
        spelling_consider(&guess, block->fields[i].key);
    for (size_t i = 0; i < scene_block_count; i++)
        if (!strcmp(scene_blocks[i].parent, owner))
            spelling_consider(&guess, scene_blocks[i].name);
    struct path elsewhere = {""};
    if (!guess.nearest || guess.distance > SLIP)
        elsewhere = find_elsewhere(name);
    const char *meant = elsewhere.text[0] ? elsewhere.text : guess.nearest;
    return scene_refuse(source, at, err, "unknown key `%s`%s%s%s%s%s; --help-scene lists all keys", name,
                        block ? " in " : "", owner, meant ? " (did you mean `" : "", meant ? meant : "",
                        meant ? "`?)" : "");
}

static bool to_number(const config_setting_t *value, double *number)
{
    switch (config_setting_type(value)) {
    case CONFIG_TYPE_INT:
        *number = config_setting_get_int(value);
        return true;
    case CONFIG_TYPE_INT64:
        *number = (double)config_setting_get_int64(value);
        return true;
    case CONFIG_TYPE_FLOAT:
        *number = config_setting_get_float(value);
        return true;
    default:
        return false;
    }
}

enum status scene_read_number(const struct scene_field *field, const config_setting_t *value,
                              const struct scene_source *source, double *out, struct error *err)
{
    double number;
    if (!to_number(value, &number))
        return scene_refuse(source, value, err, "%s must be a number%s%s%s", field->key,
                            *field->unit ? " in " : "", field->unit,
                            config_setting_type(value) == CONFIG_TYPE_STRING ? ", without quotes" : "");
    if (!(number >= field->least && number <= field->most))
        return scene_refuse(source, value, err, "%s is %.15g; it must be from %g to %.*g%s%s", field->key,
                            number, field->least, scene_range_digits(field), field->most,
                            *field->unit ? " " : "", field->unit);
    *out = number;
    return STATUS_OK;
}

static enum status read_whole(const struct scene_field *field, const config_setting_t *value,
                              const struct scene_source *source, int *out, struct error *err)
{
    double number;
    enum status status = scene_read_number(field, value, source, &number, err);
    if (!status && number != floor(number))
        status = scene_refuse(source, value, err, "%s is %g; it must be a whole number", field->key, number);
    if (!status)
        *out = (int)number;
    return status;
}

static enum status read_row(const struct scene_field *field, const config_setting_t *value, int count,
                            const char *form, const struct scene_source *source, double *out,
                            struct error *err)
{
    if (!config_setting_is_aggregate(value) || config_setting_is_group(value) ||
        config_setting_length(value) != count)
        return scene_refuse(source, value, err, "%s must be %d numbers: %s", field->key, count, form);
    for (int i = 0; i < count; i++) {
        enum status status = scene_read_number(field, config_setting_get_elem(value, (unsigned)i), source,
                                               &out[i], err);
        if (status)
            return status;
    }
    return STATUS_OK;
}

static enum status read_size(const struct scene_field *field, const config_setting_t *value,
                             const struct scene_source *source, int out[2], struct error *err)
{
    double size[2];
    enum status status = read_row(field, value, 2, "[width, height]", source, size, err);
    for (int i = 0; i < 2 && !status; i++) {
        if (size[i] != floor(size[i]))
            return scene_refuse(source, value, err, "%s is %g; it must be a whole number", field->key,
                                size[i]);
        out[i] = (int)size[i];
    }
    return status;
}

static enum status read_pairs(const struct scene_field *field, const config_setting_t *value,
                              const struct scene_source *source, struct scene_profile *out, struct error *err)
{
    int count = config_setting_is_list(value) ? config_setting_length(value) : 0;
    if (count == 0)
        return scene_refuse(source, value, err, "%s must be rows of two numbers: ( (0.0, 2.0), (1.0, 1.0) )",
                            field->key);
    double(*row)[2] = array_new((size_t)count, sizeof *row);
    if (!row)
        return error_no_memory(err, field->key);
    for (int i = 0; i < count; i++) {
        enum status status = read_row(field, config_setting_get_elem(value, (unsigned)i), 2, "(a, b)", source,
                                      row[i], err);
        if (status) {
            free(row);
            return status;
        }
    }
    free(out->row);
    *out = (struct scene_profile){row, (size_t)count};
    return STATUS_OK;
}

static enum status read_text(const struct scene_field *field, const config_setting_t *value,
                             const struct scene_source *source, char **out, struct error *err)
{
    const char *text = config_setting_get_string(value);
    if (!text || !*text)
        return scene_refuse(source, value, err, "%s must be a name in quotes: %s = \"...\"", field->key,
                            field->key);
    size_t folder = *text == '/' ? 0 : strlen(source->folder), length = strlen(text) + 1;
    char *path = malloc(folder + length);
    if (!path)
        return error_no_memory(err, field->key);
    memcpy(path, source->folder, folder);
    memcpy(path + folder, text, length);
    free(*out);
    *out = path;
    return STATUS_OK;
}

static enum status read_choice(const struct scene_field *field, const config_setting_t *value,
                               const struct scene_source *source, int *out, struct error *err)
{
    const char *text = config_setting_get_string(value);
    char list[256] = "";
    for (int i = 0; field->choices[i]; i++) {
        if (text && !strcmp(field->choices[i], text)) {
            *out = i;
            return STATUS_OK;
        }
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s\"%s\"", i ? ", " : "", field->choices[i]);
    }
    return scene_refuse(source, value, err, "%s%s%s%s must be one of %s", field->key, text ? " is \"" : "",
                        text ? text : "", text ? "\"; it" : "", list);
}

enum status scene_read_value(const struct scene_field *field, const config_setting_t *value,
                             const struct scene_source *source, void *block, struct error *err)
{
    void *member = (char *)block + field->offset;
    switch (field->type) {
    case SCENE_NUMBER:
        return scene_read_number(field, value, source, member, err);
    case SCENE_WHOLE:
        return read_whole(field, value, source, member, err);
    case SCENE_TEXT:
        return read_text(field, value, source, member, err);
    case SCENE_CHOICE:
        return read_choice(field, value, source, member, err);
    case SCENE_VECTOR:
        return read_row(field, value, 3, "[x, y, z]", source, member, err);
    case SCENE_PAIRS:
        return read_pairs(field, value, source, member, err);
    case SCENE_SIZE:
        return read_size(field, value, source, member, err);
    }
    return STATUS_OK;
}

config_setting_t *scene_parse_value(config_t *config, const char *text)
{
    size_t room = strlen(text) + sizeof "v = \"\";";
    char *line = malloc(room);
    if (!line)
        return NULL;
    snprintf(line, room, "v = %s;", text);
    scene_loosen_arrays(line);
    bool good = config_read_string(config, line);
    if (!good && !strpbrk(text, "\"\\\n")) {
        snprintf(line, room, "v = \"%s\";", text);
        good = config_read_string(config, line);
    }
    free(line);
    config_setting_t *root = config_root_setting(config);
    return good && config_setting_length(root) == 1 ? config_setting_get_elem(root, 0) : NULL;
}

/* Where the file is not libconfig's grammar, with what would be right. */
static enum status refuse_grammar(const config_t *config, const struct scene_text *text, struct error *err)
{
    const char *wrong = config_error_text(config);
    struct scene_slip slip = {.line = (unsigned)config_error_line(config)};
    char of[32] = "";
    if (strstr(wrong, "duplicate"))
        snprintf(slip.text, sizeof slip.text, "a key stands twice in its block");
    else if (scene_find_slip(text->whole, &slip))
        wrong = "syntax error";
    else if (strstr(wrong, "mismatched element"))
        snprintf(slip.text, sizeof slip.text, "write [0, 1, 2.5], numbers alone");
    else
        snprintf(slip.text, sizeof slip.text,
                 "a scene is made of lines like key = value; with text in quotes");
    if (slip.open > 0)
        snprintf(of, sizeof of, " of line %u", scene_text_place(text, slip.open).line);
    const struct scene_place place = scene_text_place(text, slip.line);
    return error_set(err, STATUS_INPUT, "%s:%u: %s; %s%s", place.file, place.line, wrong, slip.text, of);
}

enum status scene_parse_text(config_t *config, const struct scene_text *text, struct error *err)
{
    struct scene_slip slip;
    if (scene_find_cut_number(text->whole, &slip)) {
        const struct scene_place place = scene_text_place(text, slip.line);
        return error_set(err, STATUS_INPUT, "%s:%u: %s", place.file, place.line, slip.text);
    }
    char *loose = strdup(text->whole);
    if (!loose)
        return error_no_memory(err, text->files.items[0]);
    scene_loosen_arrays(loose);
    const bool good = config_read_string(config, loose);
    free(loose);
    return good ? STATUS_OK : refuse_grammar(config, text, err);
}
