/* A scene as it is, key by key: what tells whether two runs are the same. */
#include "common/scene.h"
#include "common/scene_fields.h"

#include <stdint.h>
#include <string.h>

/* Numbers with all their digits. */
static void write_row(FILE *stream, const double *numbers, int count)
{
    for (int i = 0; i < count; i++)
        fprintf(stream, "%s%.17g", i ? ", " : "[", numbers[i]);
    fputc(']', stream);
}

static void write_value(FILE *stream, const struct scene_field *field, const void *member)
{
    const struct scene_profile *profile = member;
    const int *whole = member;
    switch (field->type) {
    case SCENE_NUMBER:
        fprintf(stream, "%.17g", *(const double *)member);
        break;
    case SCENE_WHOLE:
        fprintf(stream, "%d", *whole);
        break;
    case SCENE_CHOICE:
        fputs(field->choices[*whole], stream);
        break;
    case SCENE_VECTOR:
        write_row(stream, member, 3);
        break;
    case SCENE_SIZE:
        fprintf(stream, "[%d, %d]", whole[0], whole[1]);
        break;
    case SCENE_PAIRS:
        for (size_t i = 0; i < profile->count; i++)
            write_row(stream, profile->row[i], 2);
        break;
    case SCENE_TEXT: /* where a file lies matters to nobody */
        break;
    }
}

/* path is that of the block, with the dot. */
static void write_fields(FILE *stream, const char *path, const struct scene_block *block, const void *target)
{
    for (size_t i = 0; i < block->field_count; i++) {
        const struct scene_field *field = &block->fields[i];
        if (field->type == SCENE_TEXT || field->flags & SCENE_FREE)
            continue;
        fprintf(stream, "%s%s=", path, field->key);
        write_value(stream, field, (const char *)target + field->offset);
        fputc('\n', stream);
    }
}

static bool is_called(const struct scene_block *block, const char *target)
{
    return block->on_offset == SIZE_MAX || *(const bool *)(target + block->on_offset);
}

static void write_balloon(FILE *stream, size_t number, const struct scene_balloon *balloon)
{
    char path[128];
    snprintf(path, sizeof path, "balloons[%zu].", number);
    write_fields(stream, path, scene_find_block("", "balloons"), balloon);
    for (size_t i = 0; i < scene_block_count; i++) {
        const struct scene_block *effect = &scene_blocks[i];
        const char *block = (const char *)balloon + effect->offset;
        if (strcmp(effect->parent, "balloons") || !is_called(effect, block))
            continue;
        snprintf(path, sizeof path, "balloons[%zu].%s.", number, effect->name);
        write_fields(stream, path, effect, block);
    }
}

static void write_schedule(FILE *stream, size_t number, const struct scene_schedule *entry)
{
    char path[64];
    snprintf(path, sizeof path, "schedule[%zu].", number);
    write_fields(stream, path, scene_find_block("", "schedule"), entry);
    for (size_t i = 0; i < entry->change_count; i++)
        fprintf(stream, "%s%s=%.17g\n", path, entry->change[i].field->key, entry->change[i].value);
}

static void write_item(FILE *stream, const char *list, size_t number, const void *item)
{
    char path[64];
    snprintf(path, sizeof path, "%s[%zu].", list, number);
    write_fields(stream, path, scene_find_block("", list), item);
}

void scene_write_keys(const struct scene *scene, FILE *stream)
{
    for (size_t i = 0; i < scene_block_count; i++) {
        const struct scene_block *block = &scene_blocks[i];
        char path[64];
        const char *target = (const char *)scene + block->offset;
        snprintf(path, sizeof path, "%s.", block->name);
        if (!*block->parent && !block->list && is_called(block, target))
            write_fields(stream, path, block, target);
    }
    for (size_t i = 0; i < scene->balloon_count; i++)
        write_balloon(stream, i, &scene->balloons[i]);
    for (size_t i = 0; i < scene->obstacles_count; i++)
        write_item(stream, "obstacles", i, &scene->obstacles[i]);
    for (size_t i = 0; i < scene->needles_count; i++)
        write_item(stream, "needles", i, &scene->needles[i]);
    for (size_t i = 0; i < scene->schedule_count; i++)
        write_schedule(stream, i, &scene->schedule[i]);
}

/* A line PATH=VALUE inside of a text; `text` is NULL where there is none. */
struct line {
    const char *text, *value;
    int key_length, value_length;
};

static struct line line_at(const char *text)
{
    const int key = (int)strcspn(text, "=\n");
    const char *value = text + key + (text[key] == '=');
    return (struct line){text, value, key, (int)strcspn(value, "\n")};
}

static const char *next_line(const char *text)
{
    text += strcspn(text, "\n");
    return *text ? text + 1 : text;
}

/* The line of this key in another text. The search begins at `from`, a line of it, and goes round; it leaves
 * `from` after what it finds, since keys come in one order: with many balloons, to begin at the first would
 * take as long as all their pairs. */
static struct line find_key(const char *text, const char **from, struct line key)
{
    const char *at = *from;
    do {
        const struct line line = line_at(at);
        at = next_line(at);
        if (!*at)
            at = text;
        if (line.key_length == key.key_length && !memcmp(line.text, key.text, (size_t)key.key_length)) {
            *from = at;
            return line;
        }
    } while (at != *from);
    return (struct line){0};
}

static bool same_value(struct line a, struct line b)
{
    return a.value_length == b.value_length && !memcmp(a.value, b.value, (size_t)a.value_length);
}

static int quoted(int length) /* a profile may be long */
{
    return length < 100 ? length : 100;
}

bool scene_keys_differ(const char *was, const char *is, char *text, size_t size)
{
    const char *from = was;
    for (const char *at = is; *at; at = next_line(at)) {
        const struct line now = line_at(at), then = find_key(was, &from, now);
        if (then.text && same_value(now, then))
            continue;
        const int length = snprintf(text, size, "%.*s is %.*s, and was ", quoted(now.key_length), now.text,
                                    quoted(now.value_length), now.value);
        if (length >= 0 && (size_t)length < size)
            snprintf(text + length, size - (size_t)length, "%.*s", then.text ? quoted(then.value_length) : 9,
                     then.text ? then.value : "not there");
        return true;
    }
    from = is;
    for (const char *at = was; *at; at = next_line(at)) {
        const struct line then = line_at(at);
        if (find_key(is, &from, then).text)
            continue;
        snprintf(text, size, "%.*s was %.*s, and is not there any more", quoted(then.key_length), then.text,
                 quoted(then.value_length), then.value);
        return true;
    }
    return false;
}
