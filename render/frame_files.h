/* The names of a run's pictures, and what an earlier run has left under such names. */
#ifndef RENDER_FRAME_FILES_H
#define RENDER_FRAME_FILES_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>

/* FOLDER/frame_0007.png; with an eye ("left" or "right", else NULL) FOLDER/frame_0007-left.png.
 * Free it; NULL: no memory. */
char *frame_file(const char *folder, size_t number, const char *eye);

/* NAME.mp4, with an eye NAME-left.mp4. Free it; NULL: no memory. */
char *frame_eye_file(const char *path, const char *eye);

/* Whether frame_file() gives such names. */
bool frame_file_is_name(const char *name);

/* Removes the folder's frames, of either eye or of no one, from number `first` on; *removed of them. What is
 * no regular file stays, and a folder that is not there holds none. Errors: STATUS_FILE naming the frame that
 * stays, STATUS_NO_MEMORY. */
enum status frame_files_remove(const char *folder, size_t first, size_t *removed, struct error *err);

#endif
