/* What a folder holds, to be put back and to be compared with. */
#ifndef TESTS_FAULT_SNAPSHOT_H
#define TESTS_FAULT_SNAPSHOT_H

#include <stdbool.h>
#include <stddef.h>

struct snapshot_file {
    char *path;
    unsigned char *data;
    size_t size;
};

struct snapshot {
    struct snapshot_file *files; /* [count] */
    size_t count;
};

/* All files of the current folder and the folders in it, but .stderr. Ends the program where it cannot. */
struct snapshot snapshot_take(void);
void snapshot_clear(struct snapshot *snapshot);

/* Makes the folder hold these files again, and no others. `now` is what it holds. */
void snapshot_restore(const struct snapshot *wanted, const struct snapshot *now);

/* The file of that name; NULL: there is none. */
const struct snapshot_file *snapshot_find(const struct snapshot *snapshot, const char *path);

/* Both may be NULL. */
bool snapshot_same(const struct snapshot_file *a, const struct snapshot_file *b);

#endif
