/* Saving that is waited for, in the folder of a test. */
#ifndef TESTS_UNIT_SAVING_H
#define TESTS_UNIT_SAVING_H

#include "sculpt/session.h"

/* Under this name, NULL: its own. */
static inline enum status save_now(struct session *session, const char *path, struct error *err)
{
    enum status status = session_save_begin(session, path, NULL, err);
    if (!status)
        (void)session_write_ended(session, true, &status, err);
    return status;
}

#endif
