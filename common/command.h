/*
 * What the three programs' main() have in common: how they name themselves, complain, note and show progress.
 * Only the program layer (main.c, window.c) includes this; libraries never print.
 *
 *     command_begin("balloon-surface");         first: --version, and argp's exit code 2
 *     command_parse(&argp, argc, argv, &options);
 *     if (surface_make(..., &err)) return command_fail(&err);
 */
#ifndef COMMON_COMMAND_H
#define COMMON_COMMAND_H

#include "common/status.h"

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

/* Names the program. A file that may not grow is an error from then on, like a full disk: the system would
 * end the program. How a child ended is told also where whoever began the program did not want to know. */
void command_begin(const char *program);

/* A flag of options that all count when they are given several times (none of argp's); keys are below. */
enum { OPTION_REPEATS = 0x1000, COMMAND_KEYS = 512 };

/* argp_parse(), which ends the program with a message and exit code 2 where the command line is
 * wrong; of an option that there is not the message names the nearest that there is. Of an option that is
 * given several times, and has not the flag OPTION_REPEATS, the last counts, and a note says so. Every option
 * of `argp` has a long name and a key below COMMAND_KEYS. */
void command_parse(const struct argp *argp, int argc, char **argv, void *input);

/* Memory that is freed stays with the program: the software renderer asks for the same tens of megabytes for
 * each picture, and to have them mapped anew takes longer than to sort its triangles. */
void command_keep_memory(void);

/* -q: notes and progress are not shown. */
void command_set_quiet(bool quiet);
bool command_is_quiet(void);

/* A line on stderr, unless quiet. */
void command_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "PROGRAM: text" on stderr; returns the exit code that belongs to err->status. */
int command_fail(const struct error *err);

/* Flushes stdout; returns 0, or 1 with a message when it could not be written (a full disk, a closed pipe).
 */
int command_end(void);

/* The number in an option's argument, within least .. most (both allowed); else argp's usage error: exit 2.
 */
double command_number(struct argp_state *state, const char *option, const char *argument, double least,
                      double most);
long command_whole(struct argp_state *state, const char *option, const char *argument, long least, long most);

/* An option's file must be named after what is written to it, "png" say, or have no extension, as devices
 * have none; else argp's usage error: exit 2. */
void command_extension(struct argp_state *state, const char *option, const char *argument,
                       const char *extension);

/* A number that fills its whole text ("1e-3", not "1e-3x", not ""). nan and inf are refused. */
bool number_parse(const char *text, double *value);

/* A bar with rate and time left on stderr, at least once and at most ten times a second, where stderr is a
 * terminal. Elsewhere work that takes long is not done without a word: after 5 s, of which 3 s were work, a
 * note says what is done (`what`, as "meshing"), how large it is (`size`, in words, as "42 chips"), how much
 * of it is done and how long the rest takes at that pace; others follow at some of its tenths, or after twice
 * the time. None in the first 10 s is about a rest of less than 5. The first update says where the work
 * begins. The texts are the caller's until progress_end(). */
void progress_begin(const char *what, const char *size, const char *unit, double total);
void progress_update(double done);

/* What it is at where that cannot be measured, as "auto tries methods", for the bar and for notes that have no
 * share to tell; NULL: no more. The text is the caller's until the next call. */
void progress_say(const char *at);
void progress_end(void);

/* For a line of text on stderr: takes the bar out of its way, until the next update. */
void progress_make_way(void);

#endif
