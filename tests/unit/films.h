/* A folder for films, and a program that stands in for ffmpeg there: a group's setup and teardown, and each
 * test's setup. */
#ifndef TESTS_UNIT_FILMS_H
#define TESTS_UNIT_FILMS_H

#include "common/file.h"
#include "pictures.h"

#include <ftw.h>
#include <glob.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/balloon-frames-XXXXXX";
static char *usual_path;

static inline int enter_folder(void **state)
{
    (void)state;
    usual_path = strdup(getenv("PATH"));
    return !mkdtemp(folder) || chdir(folder);
}

static inline int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info, (void)kind;
    return walk->level ? remove(path) : 0;
}

/* Each test begins in an empty folder, with the user's programs. */
static inline int empty_folder(void **state)
{
    (void)state;
    setenv("PATH", usual_path, 1);
    return nftw(".", remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

static inline int leave_folder(void **state)
{
    empty_folder(state);
    free(usual_path);
    return rmdir(folder);
}

static inline size_t names_like(const char *pattern)
{
    glob_t found;
    size_t count = glob(pattern, 0, NULL, &found) ? 0 : found.gl_pathc;
    globfree(&found);
    return count;
}

static inline void write_text(const char *path, const char *text, mode_t mode)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    chmod(path, mode);
}

static inline void assert_contents(const char *path, const char *text)
{
    struct error err;
    struct bytes bytes = {0};
    assert_ok(file_read(path, &bytes, &err), &err);
    assert_string_equal((const char *)bytes.data, text);
    bytes_clear(&bytes);
}

/* Stands in for ffmpeg: a shell script at the front of PATH. "$output" is the name that it should write. */
static inline void pretend_ffmpeg(const char *script)
{
    char *text, *path;
    mkdir("bin", 0777);
    assert_true(asprintf(&text, "#!/bin/sh\nfor output; do :; done\noutput=${output#file:}\n%s\n", script) >
                0);
    write_text("bin/ffmpeg", text, 0755);
    assert_true(asprintf(&path, "%s/bin:%s", folder, usual_path) > 0);
    setenv("PATH", path, 1);
    free(text);
    free(path);
}

#endif
