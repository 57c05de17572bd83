#include "common/scene_text.h"
#include "common/array.h"
#include "common/scene_syntax.h"
#include "common/text.h"

#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 10, MOST_FILES = 1000 };

struct reading {
    struct scene_text *text;
    const char *folder;
    FILE *out;
    unsigned line; /* of the whole, that is being written */
};

static enum status add_file(struct scene_text *text, const char *path, struct error *err)
{
    char *copy = strdup(path);
    if (!copy || !ARRAY_RESERVE(&text->files, 1)) {
        free(copy);
        return error_no_memory(err, path);
    }
    text->files.items[text->files.count++] = copy;
    return STATUS_OK;
}

/* What comes now stands there. */
static enum status add_stretch(struct reading *r, struct scene_place place, struct error *err)
{
    if (!ARRAY_RESERVE(&r->text->stretches, 1))
        return error_no_memory(err, place.file);
    r->text->stretches.items[r->text->stretches.count++] = (struct scene_stretch){r->line, place};
    return STATUS_OK;
}

static void put(struct reading *r, const char *from, const char *end)
{
    fwrite(from, 1, (size_t)(end - from), r->out);
    for (; from < end; from++)
        r->line += *from == '\n';
}

static enum status put_text(struct reading *r, const char *path, const struct bytes *bytes, int depth,
                            struct error *err);

/* The path of the file that is included there, whose name stands between the quotes; free() it. NULL: no
 * memory. */
static char *path_of(const struct reading *r, const struct scene_include *include)
{
    const size_t folder = *include->name == '/' ? 0 : strlen(r->folder);
    char *path = malloc(folder + (size_t)(include->name_end - include->name) + 1);
    if (!path)
        return NULL;
    char *end = mempcpy(path, r->folder, folder);
    for (const char *c = include->name; c < include->name_end; c++) {
        c += *c == '\\'; /* the character behind it is meant */
        *end++ = *c;
    }
    *end = '\0';
    return path;
}

static enum status put_included(struct reading *r, struct scene_place place,
                                const struct scene_include *include, int depth, struct error *err)
{
    if (depth == DEEPEST || r->text->files.count == MOST_FILES)
        return error_set(err, STATUS_INPUT, "%s:%u: files include one another more than %d deep, or %d times",
                         place.file, place.line, DEEPEST, MOST_FILES);
    static const char line_end[] = "\n";
    char *path = path_of(r, include);
    if (!path)
        return error_no_memory(err, place.file);
    struct bytes bytes = {0};
    struct error why = {0};
    enum status status = file_read(path, &bytes, &why);
    if (status) {
        error_set(err, status, "%s:%u: cannot include a file: %s", place.file, place.line, why.text);
    } else {
        put(r, line_end, line_end + 1);
        status = put_text(r, path, &bytes, depth + 1, err);
        put(r, line_end, line_end + 1);
    }
    bytes_clear(&bytes);
    free(path);
    return status;
}

static enum status put_text(struct reading *r, const char *path, const struct bytes *bytes, int depth,
                            struct error *err)
{
    const char *text = (const char *)bytes->data + text_mark_length(bytes->data, bytes->size);
    if (text + strlen(text) != (const char *)bytes->data + bytes->size)
        return error_set(err, STATUS_INPUT, "%s: is not text", path);
    enum status status = add_file(r->text, path, err);
    const char *file = status ? NULL : r->text->files.items[r->text->files.count - 1], *from = text;
    struct scene_include include = {.end = text, .line = 1};
    if (!status)
        status = add_stretch(r, (struct scene_place){file, 1}, err);
    while (!status && scene_find_include(text, &include)) {
        const struct scene_place place = {file, include.line};
        put(r, from, include.begin);
        status = put_included(r, place, &include, depth, err);
        if (!status)
            status = add_stretch(r, place, err);
        from = include.end;
    }
    if (!status)
        put(r, from, text + strlen(text));
    return status;
}

enum status scene_text_read(const char *path, const char *folder, const struct bytes *bytes,
                            struct scene_text *text, struct error *err)
{
    size_t size = 0;
    struct reading r = {.text = text, .folder = folder, .line = 1};
    r.out = open_memstream(&text->whole, &size);
    if (!r.out)
        return error_no_memory(err, path);
    const enum status status = put_text(&r, path, bytes, 0, err);
    const bool written = !ferror(r.out);
    return fclose(r.out) || !written ? error_no_memory(err, path) : status;
}

struct scene_place scene_text_place(const struct scene_text *text, unsigned line)
{
    const struct scene_stretch *s = &text->stretches.items[text->stretches.count - 1];
    while (s > text->stretches.items && s->first > line)
        s--;
    return (struct scene_place){s->place.file, s->place.line + (line > s->first ? line - s->first : 0)};
}

unsigned scene_text_own_line(const struct scene_text *text, unsigned line)
{
    const struct scene_place place = scene_text_place(text, line);
    return place.file == text->files.items[0] ? place.line : 0;
}

void scene_text_clear(struct scene_text *text)
{
    for (size_t i = 0; i < text->files.count; i++)
        free(text->files.items[i]);
    free(text->files.items);
    free(text->stretches.items);
    free(text->whole);
    *text = (struct scene_text){0};
}
