/* Scene files and --set: which value goes to which block. */
#include "common/array.h"
#include "common/file.h"
#include "common/scene.h"
#include "common/scene_syntax.h"
#include "common/scene_value.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static enum status read_written(const struct scene_field *field, const char *text, void *block,
                                struct error *err)
{
    const struct scene_source source = {NULL, ""};
    config_t config;
    config_init(&config);
    config_setting_t *value = scene_parse_value(&config, text);
    enum status status = value
                             ? scene_read_value(field, value, &source, block, err)
                             : error_set(err, STATUS_INPUT, "--set: %s: `%s` is no value", field->key, text);
    config_destroy(&config);
    return status;
}

static enum status set_defaults(const struct scene_block *block, void *target, struct error *err)
{
    for (size_t i = 0; i < block->field_count; i++)
        if (*block->fields[i].standard) {
            enum status status = read_written(&block->fields[i], block->fields[i].standard, target, err);
            if (status)
                return status;
        }
    return STATUS_OK;
}

static enum status set_scene_defaults(struct scene *scene, struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; i < scene_block_count && !status; i++)
        if (!*scene_blocks[i].parent && !scene_blocks[i].list)
            status = set_defaults(&scene_blocks[i], (char *)scene + scene_blocks[i].offset, err);
    return status;
}

static enum status set_effects_defaults(struct scene_balloon *balloon, struct error *err)
{
    enum status status = STATUS_OK;
    for (size_t i = 0; i < scene_block_count && !status; i++)
        if (!strcmp(scene_blocks[i].parent, "balloons"))
            status = set_defaults(&scene_blocks[i], (char *)balloon + scene_blocks[i].offset, err);
    return status;
}

/* One more block at the end of its list, with the defaults. */
static enum status add_item(struct scene *scene, const struct scene_block *block, void **item,
                            struct error *err)
{
    const struct scene_list *list = scene_find_list(block);
    char *base = (char *)scene;
    size_t *count = (size_t *)(base + list->count), *capacity = (size_t *)(base + list->capacity);
    if (*count == *capacity && !array_grow(base + list->items, *count, 1, list->size, capacity))
        return error_no_memory(err, block->name);
    *item = scene_list_item(scene, list, (*count)++);
    memset(*item, 0, list->size);
    if (!strcmp(block->name, "balloons")) {
        enum status status = set_effects_defaults(*item, err);
        if (status)
            return status;
    } else if (!strcmp(block->name, "needles")) {
        ((struct scene_needles *)*item)->from[0] = NAN; /* nobody has said where */
    }
    return set_defaults(block, *item, err);
}

/* group NULL: not by a file. */
static void call_for(const struct scene_block *block, void *target, const config_setting_t *group,
                     const struct scene_source *source)
{
    if (block->on_offset != SIZE_MAX)
        *(bool *)((char *)target + block->on_offset) = true;
    if (block->line_offset != SIZE_MAX && group && source->text)
        *(unsigned *)((char *)target + block->line_offset) = scene_text_own_line(
            source->text, config_setting_source_line(group));
}

/* Reads one key, and keeps that and where it was written. */
static enum status read_field(const struct scene_block *block, const struct scene_field *field, void *target,
                              const config_setting_t *value, const struct scene_source *source,
                              struct error *err)
{
    const enum status status = scene_read_value(field, value, source, target, err);
    struct scene_written *written = (struct scene_written *)((char *)target + block->written_offset);
    const unsigned line = source->text ? scene_text_own_line(source->text, config_setting_source_line(value))
                                       : 0;
    if (!status)
        written->line[field - block->fields] = line > 0 ? (int)line : SCENE_NOT_IN_FILE;
    return status;
}

/* Where a key is looked for that changes at a time. */
static const struct scene_field *find_live(const char *key)
{
    static const char *const blocks[][2] = {{"", "time"}, {"", "balloons"}, {"balloons", "gas"}};
    const struct scene_field *field = NULL;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks && !field; i++)
        field = scene_find_field(scene_find_block(blocks[i][0], blocks[i][1]), key);
    return field;
}

/* A key that changes at a time: the step, or a LIVE key of the balloons or of their gas. */
static enum status read_change(const config_setting_t *value, const char *key,
                               const struct scene_source *source, struct scene_schedule *entry,
                               struct error *err)
{
    const struct scene_field *field = find_live(key);
    if (!field)
        return scene_refuse_name(source, value, key, scene_find_block("", "schedule"), err);
    if (!(field->flags & SCENE_LIVE))
        return scene_refuse(source, value, err,
                            "%s cannot change during the simulation; --help-scene marks what can", key);
    size_t i = 0;
    while (i < entry->change_count && entry->change[i].field != field)
        i++;
    assert(i < SCENE_CHANGES_MAX); /* no more keys than that may change */
    enum status status = scene_read_number(field, value, source, &entry->change[i].value, err);
    if (!status) {
        entry->change[i].field = field;
        entry->change_count = i < entry->change_count ? entry->change_count : i + 1;
    }
    return status;
}

/* Gives one key, or one effect's block, of a block its value. */
static enum status read_key(const struct scene_block *block, void *target, const config_setting_t *value,
                            const char *key, const struct scene_source *source, struct error *err);

static enum status read_block(const struct scene_block *block, void *target, const config_setting_t *group,
                              const struct scene_source *source, struct error *err)
{
    if (!config_setting_is_group(group))
        return scene_refuse(source, group, err, "%s must be a block: { key = value; ... }", block->name);
    call_for(block, target, group, source);
    for (int i = 0; i < config_setting_length(group); i++) {
        const config_setting_t *value = config_setting_get_elem(group, (unsigned)i);
        enum status status = read_key(block, target, value, config_setting_name(value), source, err);
        if (status)
            return status;
    }
    return STATUS_OK;
}

static enum status read_key(const struct scene_block *block, void *target, const config_setting_t *value,
                            const char *key, const struct scene_source *source, struct error *err)
{
    const struct scene_field *field = scene_find_field(block, key);
    if (field)
        return read_field(block, field, target, value, source, err);
    if (!strcmp(block->name, "schedule"))
        return read_change(value, key, source, target, err);
    const struct scene_block *effect = scene_find_block(block->name, key);
    if (effect)
        return read_block(effect, (char *)target + effect->offset, value, source, err);
    return scene_refuse_name(source, value, key, block, err);
}

static enum status read_list(const struct scene_block *block, struct scene *scene,
                             const config_setting_t *list, const struct scene_source *source,
                             struct error *err)
{
    if (!config_setting_is_list(list))
        return scene_refuse(source, list, err, "%s must be a list of blocks: ( { ... }, { ... } )",
                            block->name);
    for (int i = 0; i < config_setting_length(list); i++) {
        const config_setting_t *group = config_setting_get_elem(list, (unsigned)i);
        void *target = NULL;
        enum status status = add_item(scene, block, &target, err);
        if (!status)
            status = read_block(block, target, group, source, err);
        if (status)
            return status;
    }
    return STATUS_OK;
}

static enum status read_scene(config_t *config, const struct scene_source *source, struct scene *scene,
                              struct error *err)
{
    const config_setting_t *root = config_root_setting(config);
    for (int i = 0; i < config_setting_length(root); i++) {
        const config_setting_t *value = config_setting_get_elem(root, (unsigned)i);
        const struct scene_block *block = scene_find_block("", config_setting_name(value));
        enum status status = !block ? scene_refuse_name(source, value, config_setting_name(value), NULL, err)
                             : block->list
                                 ? read_list(block, scene, value, source, err)
                                 : read_block(block, (char *)scene + block->offset, value, source, err);
        if (status)
            return status;
    }
    return STATUS_OK;
}

static enum status parse_file(const char *path, const struct bytes *text, struct scene *scene,
                              struct error *err)
{
    const char *slash = strrchr(path, '/');
    char *folder = strndup(path, slash ? (size_t)(slash - path) + 1 : 0);
    scene->path = strdup(path);
    if (!folder || !scene->path) {
        free(folder);
        return error_no_memory(err, path);
    }
    struct scene_text whole = {0};
    const struct scene_source source = {&whole, folder};
    config_t config;
    config_init(&config);
    enum status status;
    if (strlen((const char *)text->data) != text->size)
        status = error_set(
            err, STATUS_INPUT,
            "%s: is not a scene file: it is %s; a scene (.cfg) or a mesh (.ply, .stl, .obj) is wanted", path,
            file_has_extension(path, "oct") ? "a sculpture, of which balloon-surface makes a mesh"
                                            : "not text");
    else
        status = scene_text_read(path, folder, text, &whole, err);
    if (!status)
        status = scene_parse_text(&config, &whole, err);
    if (!status)
        status = read_scene(&config, &source, scene, err);
    config_destroy(&config);
    scene_text_clear(&whole);
    free(folder);
    return status;
}

enum status scene_load(const char *path, struct scene *scene, struct error *err)
{
    struct bytes text = {0};
    enum status status = file_read(path, &text, err);
    if (!status)
        status = set_scene_defaults(scene, err);
    if (!status)
        status = parse_file(path, &text, scene, err);
    bytes_clear(&text);
    if (status)
        scene_clear(scene);
    return status;
}

enum status scene_from_mesh(const char *mesh_path, struct scene *scene, struct error *err)
{
    enum status status = set_scene_defaults(scene, err);
    void *balloon;
    if (!status)
        status = add_item(scene, scene_find_block("", "balloons"), &balloon, err);
    if (!status) {
        scene->time.integrator = SCENE_SYMPLECTIC_EULER;
        scene->time.guard = SCENE_GUARD_OFF;
        scene->path = strdup(mesh_path);
        scene->balloons[0].mesh = strdup(mesh_path);
        if (!scene->path || !scene->balloons[0].mesh)
            status = error_no_memory(err, "the scene");
    }
    if (status)
        scene_clear(scene);
    return status;
}

/* Takes "NAME", "NAME[3]" off the front of *path, and the dot behind it. False when it is neither. */
static bool take_name(const char **path, char *name, size_t size, long *index)
{
    size_t length = strcspn(*path, "[.");
    if (length == 0 || length >= size)
        return false;
    memcpy(name, *path, length);
    name[length] = '\0';
    *path += length;
    *index = -1;
    if (**path == '[') {
        char *end;
        *index = strtol(*path + 1, &end, 10);
        if (end == *path + 1 || *end != ']' || *index < 0)
            return false;
        *path = end + 1;
    }
    if (**path == '.')
        return *++*path != '\0';
    return **path == '\0';
}

/* Finds the block in a list that the path names by its index; one past the last adds one. */
static enum status list_item(struct scene *scene, const struct scene_block *block, long index, void **item,
                             struct error *err)
{
    const struct scene_list *list = scene_find_list(block);
    const size_t count = *(const size_t *)((const char *)scene + list->count);
    if (index < 0 || (size_t)index > count)
        return error_set(err, STATUS_INPUT,
                         "--set: %s has %zu %s; write %s[0] to %s[%zu], the last to add one", block->name,
                         count, count == 1 ? "entry" : "entries", block->name, block->name, count);
    if ((size_t)index == count)
        return add_item(scene, block, item, err);
    *item = scene_list_item(scene, list, (size_t)index);
    return STATUS_OK;
}

/* Sets one key by its path, with the value already parsed. */
static enum status set_by_path(struct scene *scene, const char *path, const config_setting_t *value,
                               struct error *err)
{
    const struct scene_source source = {NULL, ""};
    const char *whole = path;
    char name[64];
    long index;
    const struct scene_block *block = NULL;
    void *target = scene;
    while (take_name(&path, name, sizeof name, &index)) {
        const struct scene_block *inner = scene_find_block(block ? block->name : "", name);
        if (index >= 0 && !(inner && inner->list))
            return error_set(err, STATUS_INPUT, "--set: %s is no list; leave out [%ld]", name, index);
        if (!*path && block && !inner)
            return read_key(block, target, value, name, &source, err);
        if (!inner)
            return scene_refuse_name(&source, value, name, block, err);
        enum status status = STATUS_OK;
        if (inner->list)
            status = list_item(scene, inner, index, &target, err);
        else
            target = (char *)target + inner->offset;
        if (status)
            return status;
        block = inner;
        call_for(block, target, NULL, &source);
        if (!*path)
            return error_set(err, STATUS_INPUT, "--set: %s is a block; set one of its keys: %s.KEY=VALUE",
                             whole, whole);
    }
    return error_set(err, STATUS_INPUT,
                     "--set: `%s` is no key; write balloons[0].pressure=12 or time.step=0.01", whole);
}

enum status scene_set(struct scene *scene, const char *assignment, struct error *err)
{
    const char *equals = strchr(assignment, '=');
    struct scene_slip slip;
    if (!equals)
        return error_set(err, STATUS_INPUT, "--set: `%s` has no value; write KEY=VALUE", assignment);
    if (scene_find_cut_number(equals + 1, &slip))
        return error_set(err, STATUS_INPUT, "--set: %.*s: %s", (int)(equals - assignment), assignment,
                         slip.text);
    char *path = strndup(assignment, (size_t)(equals - assignment));
    if (!path)
        return error_no_memory(err, "--set");
    config_t config;
    config_init(&config);
    config_setting_t *value = scene_parse_value(&config, equals + 1);
    enum status status = value
                             ? set_by_path(scene, path, value, err)
                             : error_set(err, STATUS_INPUT, "--set: %s: `%s` is no value", path, equals + 1);
    config_destroy(&config);
    free(path);
    return status;
}
