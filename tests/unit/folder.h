/* A fresh folder for the files of a test program: the group's setup and teardown, and files made of text. */
#ifndef TESTS_UNIT_FOLDER_H
#define TESTS_UNIT_FOLDER_H

#include "check.h"

#include <dirent.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <unistd.h>

static char test_folder[] = "/tmp/balloon-test-XXXXXX";

static inline int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(test_folder) || chdir(test_folder);
}

/* Hundreds of files that are synced: in memory, where the machine has room there. */
static inline int enter_memory(void **state)
{
    if (!access("/dev/shm", W_OK))
        strcpy(test_folder, "/dev/shm/balloon-XXXXXX");
    return enter_folder(state);
}

static inline void clear_folder(void)
{
    DIR *entries = opendir(".");
    for (struct dirent *entry; (entry = readdir(entries));)
        unlink(entry->d_name);
    closedir(entries);
}

static inline int leave_folder(void **state)
{
    (void)state;
    clear_folder();
    return rmdir(test_folder);
}

/* Up to allow_writing() nothing is made in the folder nor removed from it: root becomes somebody else. False
 * where that cannot be. */
static inline bool deny_writing(void)
{
    assert_int_equal(chmod(test_folder, 0555), 0);
    return geteuid() != 0 || !setresuid(65534, 65534, 0);
}

static inline void allow_writing(void)
{
    uid_t real, effective, saved;
    assert_int_equal(getresuid(&real, &effective, &saved), 0);
    assert_int_equal(setresuid(saved, saved, saved), 0);
    assert_int_equal(chmod(test_folder, 0755), 0);
}

static inline void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    assert_int_equal(fclose(stream), 0);
}

static inline void write_text(const char *path, const char *text)
{
    write_bytes(path, text, strlen(text));
}

#endif
