#include "snapshot.h"

#include <errno.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct snapshot *taking; /* ftw() has no room for it */

static void give_up(const char *path)
{
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    exit(1);
}

static void *need(void *block)
{
    if (!block)
        give_up("the files of the case");
    return block;
}

static int add_file(const char *path, const struct stat *info, int type)
{
    if (type != FTW_F || !strcmp(path, "./.stderr"))
        return 0;
    struct snapshot_file file = {need(strdup(path)), need(malloc((size_t)info->st_size + 1)),
                                 (size_t)info->st_size};
    FILE *stream = fopen(path, "rb");
    if (!stream || fread(file.data, 1, file.size, stream) != file.size)
        give_up(path);
    fclose(stream);
    taking->files = need(realloc(taking->files, (taking->count + 1) * sizeof *taking->files));
    taking->files[taking->count++] = file;
    return 0;
}

struct snapshot snapshot_take(void)
{
    struct snapshot snapshot = {0};
    taking = &snapshot;
    if (ftw(".", add_file, 8))
        give_up(".");
    taking = NULL;
    return snapshot;
}

void snapshot_clear(struct snapshot *snapshot)
{
    for (size_t i = 0; i < snapshot->count; i++) {
        free(snapshot->files[i].path);
        free(snapshot->files[i].data);
    }
    free(snapshot->files);
    *snapshot = (struct snapshot){0};
}

void snapshot_restore(const struct snapshot *wanted, const struct snapshot *now)
{
    for (size_t i = 0; i < now->count; i++)
        if (!snapshot_find(wanted, now->files[i].path))
            unlink(now->files[i].path);
    for (size_t i = 0; i < wanted->count; i++) {
        const struct snapshot_file *file = &wanted->files[i];
        if (snapshot_same(file, snapshot_find(now, file->path)))
            continue;
        FILE *stream = fopen(file->path, "wb");
        if (!stream || fwrite(file->data, 1, file->size, stream) != file->size || fclose(stream))
            give_up(file->path);
    }
}

const struct snapshot_file *snapshot_find(const struct snapshot *snapshot, const char *path)
{
    for (size_t i = 0; i < snapshot->count; i++)
        if (!strcmp(snapshot->files[i].path, path))
            return &snapshot->files[i];
    return NULL;
}

bool snapshot_same(const struct snapshot_file *a, const struct snapshot_file *b)
{
    return a && b ? a->size == b->size && !memcmp(a->data, b->data, a->size) : a == b;
}
