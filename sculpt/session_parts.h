/* Inside of a sculpting session: what its files share. */
#ifndef SCULPT_SESSION_PARTS_H
#define SCULPT_SESSION_PARTS_H

#include "sculpt/session.h"

/* session_files.c: begins the journal of session->path. A sculpture can be carved without one (in a folder
 * that is read-only), but not without being told: session->warning. Errors: STATUS_RESOURCE when another
 * program has it open, STATUS_INPUT, STATUS_NO_MEMORY. */
enum status session_begin_journal(struct session *session, struct error *err);

#endif
