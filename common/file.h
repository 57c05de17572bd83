/*
 * Whole files in, and files out that are either complete or not there.
 *
 *     struct file_out *out;
 *     if (file_out_open("fox.ply", &out, err))
 *         return err->status;
 *     fprintf(file_out_stream(out), ...);      ferror() need not be asked: commit does
 *     return file_out_commit(out, err);        or file_out_abandon(out)
 *
 * The bytes go to a temporary file in the same folder; commit flushes, syncs and renames it over the target,
 * so the file that was there stays whole until the new one is. Until then it has no name, where the file
 * system knows such files, and is gone when the program is killed; elsewhere NAME.XXXXXX is left then. A
 * target that is no regular file (/dev/stdout, /dev/full, a pipe) is written in place. A symbolic link is
 * followed, not replaced; one that leads nowhere is refused.
 */
#ifndef COMMON_FILE_H
#define COMMON_FILE_H

#include "common/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The contents of a file. Free with bytes_clear(). data[size] is a NUL that does not count. */
struct bytes {
    unsigned char *data;
    size_t size;
};

/* Reads all of path. On failure *out is as it was. Errors: STATUS_FILE, also of a device, which need not end,
 * and of a pipe that gives more than half a gigabyte; STATUS_NO_MEMORY. */
enum status file_read(const char *path, struct bytes *out, struct error *err);

/* The same of a format that begins with a signature. What does not is read no further than its first block,
 * since it need not end: the caller, who looks at the signature, refuses it. */
enum status file_read_signed(const char *path, const void *signature, size_t signature_size,
                             struct bytes *out, struct error *err);
void bytes_clear(struct bytes *bytes);

struct file_out;

/* Begins to replace path. Errors: STATUS_FILE (the folder is missing or cannot be written), STATUS_NO_MEMORY.
 */
enum status file_out_open(const char *path, struct file_out **out, struct error *err);

/* Whether it could be replaced, for who would know before long work. Of a pipe that is not asked: who reads
 * from it would meet its end. Errors: those of file_out_open(). */
enum status file_out_check(const char *path, struct error *err);

/* The stream to write to; it belongs to `out`. */
FILE *file_out_stream(struct file_out *out);

/* Ends the replacement and frees `out`, whatever it returns. On failure nothing is left behind and the old
 * file is untouched. Errors: STATUS_FILE with the first write, flush, sync or rename that failed. */
enum status file_out_commit(struct file_out *out, struct error *err);

/* Throws away what was written and frees `out`. NULL is fine. */
void file_out_abandon(struct file_out *out);

/* Makes the entry of a file that was renamed durable. A folder that cannot be synced (some file systems) is
 * no failure. */
void file_sync_folder_of(const char *path);

/* Makes the folder `path` if it is not there (its parent must be). Errors: STATUS_FILE, also where path is
 * there but is no folder. */
enum status file_make_folder(const char *path, struct error *err);

/* Whether files could be written into the folder, which need not be there; nothing is made. Errors: those of
 * file_make_folder() and of file_out_open(). */
enum status file_check_folder(const char *path, struct error *err);

/* True when both names lead to the same existing file. */
bool file_same(const char *a, const char *b);

/* Whether each of the files that are to be written (a NULL is none) is no other one of them, and none that is
 * read, under whatever name; devices and pipes may be several. Errors: STATUS_FILE for one that is read,
 * STATUS_USAGE for one that would be written twice. */
enum status file_check_clash(const char *const *read, size_t read_count, const char *const *written,
                             size_t written_count, struct error *err);

/* Whether the path, links followed, leads into the folder, to a name that is one of some. False also where
 * the folder is not there. */
bool file_lies_in(const char *path, const char *folder, bool (*is_name)(const char *name));

/* True when a folder of PATH has a program of that name. */
bool file_program_exists(const char *program);

/* True when path ends in ".EXTENSION", upper or lower case. */
bool file_has_extension(const char *path, const char *extension);

#endif
