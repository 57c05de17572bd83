#include "common/command.h"
#include "common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *command_name = "balloon";
static bool command_quiet;

static void print_version(FILE *stream, struct argp_state *state)
{
    (void)state;
    fprintf(stream, "%s %s\n", command_name, BALLOON_VERSION);
}

/* A file that is opened while one of them is closed would take its place, and get what is told. What holds
 * the place instead cannot be read or written either. */
static void hold_standard_streams(void)
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        if (fcntl(stream, F_GETFD) < 0)
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); /* the lowest that is free */
}

void command_begin(const char *program)
{
    hold_standard_streams();
    command_name = program;
    argp_program_version_hook = print_version;
    argp_err_exit_status = 2;
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGCHLD, SIG_DFL);
}

void command_keep_memory(void)
{
    mallopt(M_MMAP_THRESHOLD, 32 << 20); /* more is not possible */
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

void command_set_quiet(bool quiet)
{
    command_quiet = quiet;
}

bool command_is_quiet(void)
{
    return command_quiet;
}

void command_note(const char *format, ...)
{
    if (command_quiet)
        return;
    va_list arguments;
    va_start(arguments, format);
    flockfile(stderr); /* the thread that watches over long work has its own to say */
    progress_make_way();
    fprintf(stderr, "%s: ", command_name);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    funlockfile(stderr);
    va_end(arguments);
}

int command_fail(const struct error *err)
{
    fprintf(stderr, "%s: %s\n", command_name, err->text[0] ? err->text : status_meaning(err->status));
    return status_exit_code(err->status);
}

int command_end(void)
{
    if (fflush(stdout) || ferror(stdout)) {
        fprintf(stderr, "%s: cannot write the results to stdout: %s\n", command_name, strerror(errno));
        return 1;
    }
    return 0;
}

bool number_parse(const char *text, double *value)
{
    char *end;
    double parsed = strtod(text, &end);
    if (end == text || *end || !isfinite(parsed))
        return false;
    *value = parsed;
    return true;
}

double command_number(struct argp_state *state, const char *option, const char *argument, double least,
                      double most)
{
    double value = 0;
    if (!number_parse(argument, &value) || !(value >= least && value <= most))
        argp_error(state, "%s %s: must be a number from %g to %g", option, argument, least, most);
    return value;
}

long command_whole(struct argp_state *state, const char *option, const char *argument, long least, long most)
{
    char *end;
    errno = 0;
    long value = strtol(argument, &end, 10);
    if (end == argument || *end || errno || value < least || value > most)
        argp_error(state, "%s %s: must be a whole number from %ld to %ld", option, argument, least, most);
    return value;
}

void command_extension(struct argp_state *state, const char *option, const char *argument,
                       const char *extension)
{
    const char *slash = strrchr(argument, '/');
    if (strchr(slash ? slash : argument, '.') && !file_has_extension(argument, extension))
        argp_error(state, "%s %s: the name must end in .%s", option, argument, extension);
}
