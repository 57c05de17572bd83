/* The log: tab-separated, a header, a row a call. It replaces its file when it is closed, and not before. */
#ifndef SIM_LOG_H
#define SIM_LOG_H

#include "sim/sim.h"

struct sim_log;

struct sim_log_options {
    bool position_error; /* a column for --estimate */
    bool keep;           /* the rows, for sim_log_rows() */
    /* [row_bytes] of an earlier part of the run: these come first; the header is among them. */
    const char *rows;
    size_t row_bytes;
    double seconds; /* that it took */
};

/* Begins, in a file, or, where path is NULL, for sim_log_rows() alone. Errors: STATUS_FILE, STATUS_NO_MEMORY,
 * STATUS_INPUT when the earlier rows have other columns. */
enum status sim_log_open(const char *path, const struct sim_log_options *options, struct sim_log **log,
                         struct error *err);

/* position_error is only written where there is a column for it. */
void sim_log_row(struct sim_log *log, struct sim *sim, double position_error);

/* Header and rows so far, where they are kept; the log's, until the next row. NULL: not enough memory. */
const char *sim_log_rows(struct sim_log *log, size_t *bytes);

enum status sim_log_close(struct sim_log *log,
                          struct error *err); /* frees it, whatever it returns; NULL is fine */
void sim_log_abandon(struct sim_log *log);    /* NULL is fine */

#endif
