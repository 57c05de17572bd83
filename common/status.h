/*
 * How a call says that it failed.
 *
 * Whatever can fail returns an enum status and takes a struct error last. The status is for the program to
 * act on, the text is for a person: it names the file and line (or element), what is wrong, and what would be
 * right. Nothing here prints; main() does, through common/command.h.
 *
 *     struct error err = {0};
 *     if (mesh_load("fox.ply", &mesh, &err))
 *         return command_fail(&err);
 */
#ifndef COMMON_STATUS_H
#define COMMON_STATUS_H

/* name, what it means in general (err->text says it in particular), exit code of a program that ends with it
 */
#define STATUS_LIST(X)                                                   \
    X(STATUS_OK, "done", 0)                                              \
    X(STATUS_NO_MEMORY, "not enough memory", 1)                          \
    X(STATUS_FILE, "a file cannot be opened, read or written", 1)        \
    X(STATUS_INPUT, "the contents of a file are not as they must be", 1) \
    X(STATUS_RANGE, "a value is out of its range", 1)                    \
    X(STATUS_RESOURCE, "a program, library or device is missing", 1)     \
    X(STATUS_USAGE, "wrong usage", 2)                                    \
    X(STATUS_DIVERGED, "the simulation diverged", 3)                     \
    X(STATUS_HUNG_UP, "the terminal was closed (SIGHUP)", 129)           \
    X(STATUS_INTERRUPTED, "interrupted (SIGINT)", 130)                   \
    X(STATUS_TERMINATED, "told to end (SIGTERM)", 143)

enum status {
#define STATUS_ENUM(name, meaning, exit_code) name,
    STATUS_LIST(STATUS_ENUM)
#undef STATUS_ENUM
};

enum { ERROR_TEXT_SIZE = 1024 };

/* The first thing that went wrong. `{0}` is "nothing yet". */
struct error {
    enum status status;
    char text[ERROR_TEXT_SIZE];
};

/* Records status and text in err (which may be NULL) and returns status. A later call overwrites. */
enum status error_set(struct error *err, enum status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for a failed system call on `path`: "PATH: cannot WHAT: strerror(errno)", status STATUS_FILE. */
enum status error_set_errno(struct error *err, const char *path, const char *what);

/* "not enough memory for WHAT", status STATUS_NO_MEMORY. */
enum status error_no_memory(struct error *err, const char *what);

/* Puts "PREFIX: " in front of the text, for a caller that knows the file's name where the callee did not.
 * Returns err's status, so that it can end a function. err may be NULL only where status is given by hand. */
enum status error_prefix(struct error *err, const char *prefix);

/* A few words on what the status means. */
const char *status_meaning(enum status status);

/* The exit code of a program that ends with this status: 0 done, 1 failed, 2 wrong usage, 3 diverged,
 * 128 + the signal that ended it. */
int status_exit_code(enum status status);

#endif
