/*
 * How a value written in a scene file, or behind --set, becomes the member of a struct. Inside of
 * scene_load.c; these two files are the only ones that know libconfig.
 */
#ifndef COMMON_SCENE_VALUE_H
#define COMMON_SCENE_VALUE_H

#include "common/scene_fields.h"
#include "common/scene_text.h"
#include "common/status.h"

#include <libconfig.h>

/* Where values come from: a file, or one assignment on the command line. */
struct scene_source {
    const struct scene_text *text; /* NULL: --set */
    const char *folder;            /* what relative paths are relative to; "" or ending in a slash */
};

/* "FILE:LINE: ..." or "--set: ...", STATUS_INPUT. */
enum status scene_refuse(const struct scene_source *source, const config_setting_t *at, struct error *err,
                         const char *format, ...) __attribute__((format(printf, 4, 5)));

/* "unknown key `presure` in balloons (did you mean `pressure`?)". block NULL: the scene itself. */
enum status scene_refuse_name(const struct scene_source *source, const config_setting_t *at, const char *name,
                              const struct scene_block *block, struct error *err);

/* The number of a LIVE field, checked against its range. */
enum status scene_read_number(const struct scene_field *field, const config_setting_t *value,
                              const struct scene_source *source, double *out, struct error *err);

/* Puts a value into the member of `block` that belongs to the field. */
enum status scene_read_value(const struct scene_field *field, const config_setting_t *value,
                             const struct scene_source *source, void *block, struct error *err);

/* Lets libconfig read a scene, but for what it would misread. STATUS_INPUT: "FILE:LINE: ...", with what would
 * be right. */
enum status scene_parse_text(config_t *config, const struct scene_text *text, struct error *err);

/* The value written in `text`, as libconfig reads it; bare words are taken as if in quotes. It belongs to
 * config, which must be initialised. NULL when it is no value. */
config_setting_t *scene_parse_value(config_t *config, const char *text);

#endif
