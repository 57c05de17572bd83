#include "common/plot.h"

#include "common/file.h"
#include "common/plot_script.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

bool plot_is_file_name(const char *path)
{
    return file_has_extension(path, "png") || file_has_extension(path, "svg");
}

char *plot_table_name(const char *path)
{
    char *name = strdup(path);
    if (name && plot_is_file_name(path))
        memcpy(name + strlen(name) - 3, "tsv", 3);
    return name;
}

enum status plot_check(const char *path, struct error *err)
{
    if (!plot_is_file_name(path))
        return error_set(err, STATUS_USAGE, "%s: a plot's name must end in .png or .svg", path);
    if (!file_program_exists("gnuplot"))
        return error_set(err, STATUS_RESOURCE,
                         "%s: the program gnuplot is needed for plots and is not installed; on Debian: "
                         "apt install gnuplot-nox",
                         path);
    return STATUS_OK;
}

/* The script as a file in memory, ready to be read: neither side can wait for the other. -1: errno says
 * why. */
static int new_script(const struct plot *plot, bool svg)
{
    int descriptor = memfd_create("plot", MFD_CLOEXEC);
    int copy = descriptor >= 0 ? fcntl(descriptor, F_DUPFD_CLOEXEC, 0) : -1;
    FILE *script = copy >= 0 ? fdopen(copy, "w") : NULL;
    bool good = script;
    if (script) {
        plot_write_script(plot, svg, script);
        good = !ferror(script);
        good = !fclose(script) && good && lseek(descriptor, 0, SEEK_SET) == 0;
    } else if (copy >= 0) {
        close(copy);
    }
    if (!good && descriptor >= 0)
        close(descriptor);
    return good ? descriptor : -1;
}

/* Runs gnuplot, without the user's start-up file, and waits for it. False, with errno set, when it could not
 * be started; *exit_status as of waitpid(). */
static bool run_gnuplot(int script, int picture, int messages, int *exit_status)
{
    static const char *const arguments[] = {"gnuplot", "-d", NULL};
    posix_spawn_file_actions_t actions;
    pid_t gnuplot;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, script, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, picture, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
    int problem = posix_spawnp(&gnuplot, "gnuplot", &actions, NULL, (char *const *)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem) {
        errno = problem;
        return false;
    }
    while (waitpid(gnuplot, exit_status, 0) < 0)
        if (errno != EINTR)
            return false;
    return true;
}

/* What gnuplot said that begins with a letter: it draws the place of an error with blanks and arrows. */
static void read_complaint(int messages, char *text, size_t size)
{
    char said[2048];
    ssize_t length = pread(messages, said, sizeof said - 1, 0);
    said[length > 0 ? length : 0] = 0;
    const char *line = said;
    while (*line && (*line <= ' ' || strchr("^\"$", *line)))
        line += strcspn(line, "\n") + (line[strcspn(line, "\n")] != 0);
    snprintf(text, size, "%.*s", (int)strcspn(line, "\n"), *line ? line : "no reason given");
}

/* Errors are kept by the stream. */
static void copy(int from, FILE *to)
{
    char part[4096];
    ssize_t got = 0;
    for (off_t at = 0; (got = pread(from, part, sizeof part, at)) > 0; at += got)
        fwrite(part, 1, (size_t)got, to);
}

/* Whether a limit on the size of files, which those in memory have too, has cut this one: gnuplot does not
 * say so. */
static bool is_cut(int file)
{
    struct stat info;
    struct rlimit most;
    return !fstat(file, &info) && !getrlimit(RLIMIT_FSIZE, &most) && (rlim_t)info.st_size >= most.rlim_cur;
}

/* By way of a file in memory: gnuplot says nothing of a full disk. */
static enum status draw(const char *path, int script, int picture, int messages, struct file_out *out,
                        struct error *err)
{
    int exit_status = 0;
    char complaint[256];
    if (!run_gnuplot(script, picture, messages, &exit_status))
        return error_set_errno(err, path, "start gnuplot for");
    if (is_cut(picture)) {
        errno = EFBIG;
        return error_set_errno(err, path, "write");
    }
    if (!WIFEXITED(exit_status) || WEXITSTATUS(exit_status) != 0) {
        read_complaint(messages, complaint, sizeof complaint);
        return error_set(err, STATUS_RESOURCE, "%s: gnuplot failed: %s", path, complaint);
    }
    copy(picture, file_out_stream(out));
    return STATUS_OK;
}

enum status plot_save(const struct plot *plot, const char *path, struct error *err)
{
    struct file_out *out;
    if (plot_check(path, err) || file_out_open(path, &out, err))
        return err->status;
    int script = new_script(plot, file_has_extension(path, "svg"));
    int picture = memfd_create("picture", MFD_CLOEXEC), messages = memfd_create("gnuplot", MFD_CLOEXEC);
    enum status status = script >= 0 && picture >= 0 && messages >= 0
                             ? draw(path, script, picture, messages, out, err)
                         : errno == EFBIG ? error_set_errno(err, path, "write")
                                          : error_no_memory(err, path);
    if (script >= 0)
        close(script);
    if (picture >= 0)
        close(picture);
    if (messages >= 0)
        close(messages);
    if (status == STATUS_OK)
        return file_out_commit(out, err);
    file_out_abandon(out);
    return status;
}
