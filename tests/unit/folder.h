/* A fresh folder for the files of a test program: the group's setup and teardown, and files made of text. */
#ifndef TESTS_UNIT_FOLDER_H
#define TESTS_UNIT_FOLDER_H

#include "check.h"

#include <dirent.h>
#include <unistd.h>

static char test_folder[] = "/tmp/balloon-test-XXXXXX";

static inline int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(test_folder) || chdir(test_folder);
}

static inline int leave_folder(void **state)
{
    (void)state;
    DIR *entries = opendir(".");
    for (struct dirent *entry; (entry = readdir(entries));)
        unlink(entry->d_name);
    closedir(entries);
    return rmdir(test_folder);
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
