#include "common/status.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *meaning;
    int exit_code;
} status_table[] = {
#define STATUS_ROW(name, meaning, exit_code) {meaning, exit_code},
    STATUS_LIST(STATUS_ROW)
#undef STATUS_ROW
};

enum status error_set(struct error *err, enum status status, const char *format, ...)
{
    if (err) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(err->text, sizeof err->text, format, arguments);
        va_end(arguments);
        err->status = status;
    }
    return status;
}

enum status error_set_errno(struct error *err, const char *path, const char *what)
{
    return error_set(err, STATUS_FILE, "%s: cannot %s: %s", *path ? path : "\"\"", what, strerror(errno));
}

enum status error_no_memory(struct error *err, const char *what)
{
    return error_set(err, STATUS_NO_MEMORY, "not enough memory for %s", what);
}

enum status error_prefix(struct error *err, const char *prefix)
{
    char text[ERROR_TEXT_SIZE];
    memcpy(text, err->text, sizeof text);
    size_t length = (size_t)snprintf(err->text, sizeof err->text, "%s: ", prefix);
    if (length < sizeof err->text) {
        size_t room = sizeof err->text - length - 1;
        size_t kept = strnlen(text, room);
        memcpy(err->text + length, text, kept);
        err->text[length + kept] = '\0';
    }
    return err->status;
}

const char *status_meaning(enum status status)
{
    return status_table[status].meaning;
}

int status_exit_code(enum status status)
{
    return status_table[status].exit_code;
}
