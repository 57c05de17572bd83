/*
 * The text of a scene with that of the files that it includes in their places, and where each of its lines
 * stands:
 *
 *     gravity = { };
 *     @include "rubber.cfg"
 *
 * libconfig would read them by itself, but cuts whole numbers in them, refuses [0, 1, 2.5] (scene_syntax.h),
 * and tells no file of what is wrong with a value. As with libconfig a line begins with the word, names are
 * relative to the scene's folder, and files include others, ten deep at the most.
 *
 *     struct scene_text text = {0};
 *     enum status status = scene_text_read("fox.cfg", "", &bytes, &text, err);
 *     ...
 *     scene_text_clear(&text);
 */
#ifndef COMMON_SCENE_TEXT_H
#define COMMON_SCENE_TEXT_H

#include "common/file.h"

/* A line in its file, from 1. */
struct scene_place {
    const char *file; /* belongs to the text */
    unsigned line;
};

/* What stands in one file without a break. */
struct scene_stretch {
    unsigned first; /* its first line in the whole */
    struct scene_place place;
};

struct scene_text {
    char *whole; /* owned */
    struct {
        struct scene_stretch *items; /* [count] by lines; the first is the scene's own; owned */
        size_t count, capacity;
    } stretches;
    struct {
        char **items; /* [count] names; the first is the scene's; all owned */
        size_t count, capacity;
    } files;
};

/* Puts the files that `bytes`, the scene of that path, includes into their places; relative names are looked
 * for in `folder`, which is "" or ends in a slash. Errors: STATUS_INPUT (no text, or includes without end),
 * STATUS_FILE, STATUS_NO_MEMORY; *text can be cleared also then. */
enum status scene_text_read(const char *path, const char *folder, const struct bytes *bytes,
                            struct scene_text *text, struct error *err);

/* Where a line of the whole stands. */
struct scene_place scene_text_place(const struct scene_text *text, unsigned line);

/* The line in the scene's own file; 0: it was included. */
unsigned scene_text_own_line(const struct scene_text *text, unsigned line);

void scene_text_clear(struct scene_text *text);

#endif
