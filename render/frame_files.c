#include "render/frame_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const endings[] = {".png", "-left.png", "-right.png"};

char *frame_file(const char *folder, size_t number, const char *eye)
{
    char *path;
    const int length = asprintf(&path, "%s/frame_%04zu%s%s.png", folder, number, eye ? "-" : "",
                                eye ? eye : "");
    return length < 0 ? NULL : path;
}

char *frame_eye_file(const char *path, const char *eye)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    const int stem = dot ? (int)(dot - path) : (int)strlen(path);
    char *result;
    if (!eye)
        return strdup(path);
    return asprintf(&result, "%.*s-%s%s", stem, path, eye, path + stem) < 0 ? NULL : result;
}

/* True for a name that frame_file() gives; its number. */
static bool is_frame(const char *name, size_t *number)
{
    if (strncmp(name, "frame_", 6) || name[6] < '0' || name[6] > '9')
        return false;
    *number = strtoull(name + 6, NULL, 10);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char again[64];
        snprintf(again, sizeof again, "frame_%04zu%s", *number, endings[i]);
        if (!strcmp(name, again))
            return true;
    }
    return false;
}

bool frame_file_is_name(const char *name)
{
    return is_frame(name, &(size_t){0});
}

static enum status remove_from(DIR *open, const char *folder, size_t first, size_t *removed,
                               struct error *err)
{
    size_t number;
    struct stat info;
    for (struct dirent *entry; (entry = readdir(open));) {
        if (!is_frame(entry->d_name, &number) || number < first ||
            fstatat(dirfd(open), entry->d_name, &info, AT_SYMLINK_NOFOLLOW) || !S_ISREG(info.st_mode))
            continue;
        if (unlinkat(dirfd(open), entry->d_name, 0)) {
            char path[1024];
            snprintf(path, sizeof path, "%.500s/%s", folder, entry->d_name);
            return error_set_errno(err, path, "remove the earlier run's");
        }
        ++*removed;
    }
    return STATUS_OK;
}

enum status frame_files_remove(const char *folder, size_t first, size_t *removed, struct error *err)
{
    DIR *open = opendir(folder);
    *removed = 0;
    if (!open)
        return STATUS_OK;
    enum status status = remove_from(open, folder, first, removed, err);
    closedir(open);
    return status;
}
