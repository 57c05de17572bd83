/* The chip log: the script, kept in the .oct's chunk OCTREE_CHUNK_LOG, that makes the
 * sculpture from the start. */
#ifndef SCULPT_CHIP_LOG_H
#define SCULPT_CHIP_LOG_H

#include "common/file.h"
#include "sculpt/sculpt.h"

/* Writes into *log (overwritten; free it with bytes_clear()) the log `before` and, behind it, those of the
 * chips that were not taken back. NULL for `before` is a new cube: of chips->start_material, and of this
 * depth where the script names none. Equal operations are equal bytes, however they are parted. Where
 * `before` is no script the result does not hold. Errors: STATUS_NO_MEMORY. */
enum status chip_log_write(const struct bytes *before, const struct chips *chips, unsigned depth,
                           struct bytes *log, struct error *err);

/* Whether replaying the log makes an octree equal to the tree. A log that is no script does not. Errors:
 * STATUS_NO_MEMORY. */
enum status chip_log_holds(const struct bytes *log, const struct octree *tree, bool *holds,
                           struct error *err);

#endif
