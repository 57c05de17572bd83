#include "fault.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>
#include <unistd.h>

static struct {
    atomic_uint kinds; /* 0: nothing fails */
    atomic_long left;  /* calls up to the one that fails, itself included */
    atomic_bool lasting, all_named;
    _Atomic(const char *) failed;
} now;

bool fault_next(struct fault *fault)
{
    if (fault->number > 0 && !fault->failed) {
        if (fault->lasting)
            return false;
        fault->lasting = true;
        fault->number = 0;
    }
    fault->number++;
    return true;
}

void fault_begin(struct fault *fault)
{
    now.left = fault->number;
    now.lasting = fault->lasting;
    now.all_named = fault->all_named;
    now.failed = NULL;
    now.kinds = fault->kinds;
}

void fault_end(struct fault *fault)
{
    now.kinds = 0;
    fault->failed = now.failed;
}

static bool fails(unsigned kind, const char *name)
{
    if (!(now.kinds & kind))
        return false;
    const long left = --now.left;
    if (left > 0 || (left < 0 && !now.lasting))
        return false;
    const char *none = NULL;
    atomic_compare_exchange_strong(&now.failed, &none, name);
    errno = kind == FAULT_MEMORY ? ENOMEM : ENOSPC;
    return true;
}

/* A function, its wrapper and what it returns when it fails. */
#define WRAP(kind, type, name, parameters, arguments, failure)         \
    type __real_##name parameters;                                     \
    type __wrap_##name parameters;                                     \
    type __wrap_##name parameters                                      \
    {                                                                  \
        return fails(kind, #name) ? failure : __real_##name arguments; \
    }

WRAP(FAULT_MEMORY, void *, malloc, (size_t size), (size), NULL)
WRAP(FAULT_MEMORY, void *, calloc, (size_t count, size_t size), (count, size), NULL)
WRAP(FAULT_MEMORY, void *, realloc, (void *old, size_t size), (old, size), NULL)
WRAP(FAULT_MEMORY, char *, strdup, (const char *text), (text), NULL)
WRAP(FAULT_MEMORY, char *, strndup, (const char *text, size_t size), (text, size), NULL)
WRAP(FAULT_MEMORY, FILE *, open_memstream, (char **text, size_t *size), (text, size), NULL)

int __wrap_asprintf(char **text, const char *format, ...) __attribute__((format(printf, 2, 3)));

int __wrap_asprintf(char **text, const char *format, ...)
{
    if (fails(FAULT_MEMORY, "asprintf"))
        return -1;
    va_list rest;
    va_start(rest, format);
    const int length = vasprintf(text, format, rest);
    va_end(rest);
    return length;
}

WRAP(FAULT_STARTS, int, pthread_create,
     (pthread_t * thread, const pthread_attr_t *attributes, void *(*function)(void *), void *argument),
     (thread, attributes, function, argument), EAGAIN)

WRAP(FAULT_FILES, FILE *, fopen64, (const char *path, const char *mode), (path, mode), NULL)
WRAP(FAULT_FILES, FILE *, fdopen, (int file, const char *mode), (file, mode), NULL)
WRAP(FAULT_FILES, int, mkostemp64, (char *path, int flags), (path, flags), -1)
WRAP(FAULT_FILES, int, fsync, (int file), (file), -1)
WRAP(FAULT_FILES, int, rename, (const char *from, const char *to), (from, to), -1)
WRAP(FAULT_FILES, int, link, (const char *from, const char *to), (from, to), -1)
WRAP(FAULT_FILES, int, linkat, (int from_folder, const char *from, int to_folder, const char *to, int flags),
     (from_folder, from, to_folder, to, flags), -1)
WRAP(FAULT_FILES, int, ftruncate64, (int file, off_t size), (file, size), -1)

int __real_open64(const char *path, int flags, mode_t mode);
int __wrap_open64(const char *path, int flags, ...);

int __wrap_open64(const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    if (now.kinds && now.all_named && (flags & O_TMPFILE) == O_TMPFILE) {
        errno = EOPNOTSUPP;
        return -1;
    }
    return fails(FAULT_FILES, "open64") ? -1 : __real_open64(path, flags, mode);
}

ssize_t __real_write(int file, const void *bytes, size_t size);
ssize_t __wrap_write(int file, const void *bytes, size_t size);

ssize_t __wrap_write(int file, const void *bytes, size_t size)
{
    if (!fails(FAULT_FILES, "write"))
        return __real_write(file, bytes, size);
    return size > 1 ? __real_write(file, bytes, size / 2) : -1;
}

int __real_fflush(FILE *stream);
int __wrap_fflush(FILE *stream);

/* The stream meets a full device, as the C library itself finds out: its error indicator is set. */
static int flush_to_full(FILE *stream)
{
    const int file = fileno(stream), kept = dup(file),
              full = __real_open64("/dev/full", O_WRONLY | O_CLOEXEC, 0);
    dup2(full, file);
    const int result = __real_fflush(stream);
    const int reason = errno;
    dup2(kept, file);
    close(kept);
    close(full);
    errno = reason;
    return result;
}

/* A stream in memory has no file: it fails for want of memory. */
static unsigned kind_of(FILE *stream)
{
    return fileno(stream) < 0 ? FAULT_MEMORY : FAULT_FILES;
}

int __wrap_fflush(FILE *stream)
{
    const unsigned kind = kind_of(stream);
    if (!fails(kind, "fflush"))
        return __real_fflush(stream);
    return kind == FAULT_MEMORY ? EOF : flush_to_full(stream);
}

size_t __real_fwrite(const void *items, size_t size, size_t count, FILE *stream);
size_t __wrap_fwrite(const void *items, size_t size, size_t count, FILE *stream);

size_t __wrap_fwrite(const void *items, size_t size, size_t count, FILE *stream)
{
    const bool failing = kind_of(stream) == FAULT_FILES && fails(FAULT_FILES, "fwrite");
    const size_t wrote = __real_fwrite(items, size, count, stream);
    return failing && flush_to_full(stream) ? 0 : wrote;
}

int __real_fclose(FILE *stream);
int __wrap_fclose(FILE *stream);

int __wrap_fclose(FILE *stream)
{
    const unsigned kind = kind_of(stream);
    const bool failing = fails(kind, "fclose");
    const int result = __real_fclose(stream);
    if (failing)
        errno = kind == FAULT_MEMORY ? ENOMEM : EIO;
    return failing ? EOF : result;
}
