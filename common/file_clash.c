/* Names that lead to one file, also where it is not there yet. */
#include "common/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char *last_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The folder that a name is in, without links; false: it is not there. */
static bool find_folder(const char *path, struct stat *folder)
{
    char name[4096];
    const int length = snprintf(name, sizeof name, "%.*s.", (int)(last_of(path) - path), path);
    return length > 0 && (size_t)length < sizeof name && !stat(name, folder);
}

/* The same file, which is there; devices and pipes take what comes from several. */
static bool is_one_file(const char *a, const char *b)
{
    struct stat info;
    return file_same(a, b) && !stat(a, &info) && S_ISREG(info.st_mode);
}

/* The same place for a file, which is not there yet. */
static bool is_one_place(const char *a, const char *b)
{
    struct stat one, other;
    return !strcmp(last_of(a), last_of(b)) && stat(a, &one) && find_folder(a, &one) &&
           find_folder(b, &other) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool file_lies_in(const char *path, const char *folder, bool (*is_name)(const char *name))
{
    struct stat one, other;
    char *resolved = realpath(path, NULL);
    const char *whole = resolved ? resolved : path;
    const bool lies = is_name(last_of(whole)) && find_folder(whole, &one) && !stat(folder, &other) &&
                      one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    free(resolved);
    return lies;
}

enum status file_check_clash(const char *const *read, size_t read_count, const char *const *written,
                             size_t written_count, struct error *err)
{
    for (size_t i = 0; i < written_count; i++) {
        for (size_t k = 0; k < read_count && written[i]; k++)
            if (read[k] && is_one_file(written[i], read[k]))
                return error_set(err, STATUS_FILE,
                                 "%s: is read here, and would be replaced; write to another file",
                                 written[i]);
        for (size_t k = 0; k < i && written[i]; k++)
            if (written[k] && (is_one_file(written[i], written[k]) || is_one_place(written[i], written[k])))
                return error_set(err, STATUS_USAGE,
                                 "%s: two outputs would go there, and one be lost; give each a file",
                                 written[i]);
    }
    return STATUS_OK;
}
