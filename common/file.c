#include "common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

struct file_out {
    FILE *stream;
    char *target;    /* the file to be replaced, links resolved */
    char *temporary; /* NULL where the target is written in place */
    bool nameless;   /* there is no file of that name yet: it is a pattern */
};

/* What has no size beforehand, a pipe mostly, need not end either. */
static const size_t unknown_size_max = (size_t)1 << 29;

struct signature {
    const void *bytes;
    size_t size;
};

static bool is_something_else(const unsigned char *data, size_t size, const struct signature *signature)
{
    return size >= signature->size && memcmp(data, signature->bytes, signature->size) != 0;
}

static enum status read_stream(FILE *stream, const char *path, const struct signature *signature,
                               struct bytes *out, struct error *err)
{
    size_t size = 0, capacity = 1 << 16;
    struct stat info;
    if (!fstat(fileno(stream), &info) && S_ISREG(info.st_mode) && info.st_size > 0)
        capacity = (size_t)info.st_size + 2; /* one to meet the end with, one for the NUL */
    unsigned char *data = malloc(capacity);
    while (data) {
        size_t got = fread(data + size, 1, capacity - 1 - size, stream);
        size += got;
        if (got == 0 || size < capacity - 1 || is_something_else(data, size, signature))
            break;
        if (capacity > unknown_size_max / 2) {
            free(data);
            return error_set(
                err, STATUS_FILE,
                "%s: has no end within %zu MB, and no more is read of a pipe; save what is larger "
                "as a file",
                path, unknown_size_max >> 20);
        }
        unsigned char *larger = capacity <= SIZE_MAX / 2 ? realloc(data, 2 * capacity) : NULL;
        if (!larger)
            free(data);
        data = larger;
        capacity *= 2;
    }
    if (!data)
        return error_no_memory(err, path);
    if (ferror(stream)) {
        free(data);
        return error_set_errno(err, path, "read");
    }
    data[size] = '\0';
    *out = (struct bytes){data, size};
    return STATUS_OK;
}

/* A terminal's text ends where the user ends it, and nothing at once. */
static bool may_not_end(FILE *stream, const char *path)
{
    struct stat info;
    if (fstat(fileno(stream), &info) || !(S_ISCHR(info.st_mode) || S_ISBLK(info.st_mode)))
        return false;
    return !isatty(fileno(stream)) && !file_same(path, "/dev/null");
}

enum status file_read(const char *path, struct bytes *out, struct error *err)
{
    return file_read_signed(path, "", 0, out, err);
}

enum status file_read_signed(const char *path, const void *signature, size_t signature_size,
                             struct bytes *out, struct error *err)
{
    FILE *stream = fopen(path, "rbe");
    if (!stream)
        return error_set_errno(err, path, "open");
    enum status status = may_not_end(stream, path)
                             ? error_set(err, STATUS_FILE, "%s: is a device; give a file or a pipe", path)
                             : read_stream(stream, path, &(struct signature){signature, signature_size}, out,
                                           err);
    fclose(stream);
    return status;
}

void bytes_clear(struct bytes *bytes)
{
    free(bytes->data);
    *bytes = (struct bytes){0};
}

/* The permissions of the new file: those of the old one, or what the user's mask leaves. */
static mode_t new_file_mode(const struct stat *old, bool exists)
{
    if (exists)
        return old->st_mode & 07777;
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* two at once would leave the mask at 0 */
    pthread_mutex_lock(&lock);
    mode_t mask = umask(0);
    umask(mask);
    pthread_mutex_unlock(&lock);
    return 0666 & ~mask;
}

/* The folder that a path leads into; free() it. NULL when memory is not enough. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return !slash ? strdup(".") : strndup(path, slash == path ? 1 : (size_t)(slash - path));
}

/* The name by which a file that has none can be linked. */
static void name_by_descriptor(int descriptor, char name[40])
{
    snprintf(name, 40, "/proc/self/fd/%d", descriptor);
}

/* Opens a file without a name in a folder, which is gone with the program however that ends. -1 with errno
 * where it fails; EOPNOTSUPP where there are none (some file systems), or they could not be given a name (no
 * /proc). */
static int open_nameless(const char *folder)
{
    char name[40];
    int descriptor = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (descriptor < 0) {
        if (errno == EISDIR || errno == EINVAL) /* what a kernel answers that does not know the flag */
            errno = EOPNOTSUPP;
        return -1;
    }
    name_by_descriptor(descriptor, name);
    if (access(name, F_OK)) {
        close(descriptor);
        errno = EOPNOTSUPP;
        return -1;
    }
    return descriptor;
}

/* Gives what has no name the first free one of its pattern. */
static bool give_name(struct file_out *out)
{
    char name[40], *end = out->temporary + strlen(out->temporary) - 6;
    name_by_descriptor(fileno(out->stream), name);
    unsigned number = (unsigned)getpid();
    do {
        snprintf(end, 7, "%06x", number++ & 0xffffffU);
        out->nameless = linkat(AT_FDCWD, name, AT_FDCWD, out->temporary, AT_SYMLINK_FOLLOW) != 0;
    } while (out->nameless && errno == EEXIST);
    return !out->nameless;
}

/* Opens what is written first; -1 with errno where it fails. A name that is too long is refused now, not when
 * the work is done. */
static int open_first(struct file_out *out, const char *folder)
{
    struct stat info;
    if (lstat(out->temporary, &info) && errno == ENAMETOOLONG)
        return -1;
    int descriptor = open_nameless(folder);
    if (descriptor < 0 && errno == EOPNOTSUPP) {
        descriptor = mkostemp(out->temporary, O_CLOEXEC);
        out->nameless = descriptor < 0;
    }
    return descriptor;
}

static enum status open_temporary(struct file_out *out, mode_t mode, struct error *err)
{
    size_t length = strlen(out->target);
    char *folder = folder_of(out->target);
    out->temporary = malloc(length + sizeof ".XXXXXX");
    out->nameless = true;
    if (!out->temporary || !folder) {
        free(folder);
        return error_no_memory(err, out->target);
    }
    memcpy(out->temporary, out->target, length);
    memcpy(out->temporary + length, ".XXXXXX", sizeof ".XXXXXX");
    int descriptor = open_first(out, folder);
    free(folder);
    if (descriptor < 0)
        return error_set_errno(err, out->target, "create");
    fchmod(descriptor, mode);
    out->stream = fdopen(descriptor, "wb");
    if (!out->stream) {
        error_set_errno(err, out->target, "create");
        close(descriptor);
        return STATUS_FILE;
    }
    return STATUS_OK;
}

enum status file_out_open(const char *path, struct file_out **result, struct error *err)
{
    struct file_out *out = calloc(1, sizeof *out);
    if (!out)
        return error_no_memory(err, path);
    struct stat old, link;
    bool exists = !stat(path, &old), is_link = !lstat(path, &link) && S_ISLNK(link.st_mode);
    bool replaced = !exists || S_ISREG(old.st_mode); /* a pipe's resolved name leads nowhere */
    out->target = exists && replaced && is_link ? realpath(path, NULL) : strdup(path);
    enum status status = STATUS_OK;
    if (!exists && is_link) {
        status = error_set(err, STATUS_FILE,
                           "%s: is a link that leads nowhere; make what it leads to, or remove it", path);
    } else if (exists && S_ISDIR(old.st_mode)) {
        status = error_set(err, STATUS_FILE, "%s: is a folder; give the name of a file in it", path);
    } else if (!*path) {
        errno = ENOENT;
        status = error_set_errno(err, path, "create");
    } else if (!out->target) {
        status = errno == ENOMEM ? error_no_memory(err, path) : error_set_errno(err, path, "follow the link");
    } else if (!replaced) {
        out->stream = fopen(path, "wbe");
        if (!out->stream)
            status = error_set_errno(err, path, "open");
    } else {
        status = open_temporary(out, new_file_mode(&old, exists), err);
    }
    if (status) {
        file_out_abandon(out);
        return status;
    }
    *result = out;
    return STATUS_OK;
}

enum status file_out_check(const char *path, struct error *err)
{
    struct stat info;
    struct file_out *trial;
    if (!stat(path, &info) && S_ISFIFO(info.st_mode))
        return STATUS_OK;
    enum status status = file_out_open(path, &trial, err);
    if (!status)
        file_out_abandon(trial);
    return status;
}

FILE *file_out_stream(struct file_out *out)
{
    return out->stream;
}

void file_sync_folder_of(const char *path)
{
    char *folder = folder_of(path);
    int descriptor = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
    free(folder);
}

/* Writes what is still in the buffer; errno tells why not. Where a write has failed before, errno has been
 * another's since: one more byte, to a file that is lost anyhow, fails likewise and says why. */
static bool flush(FILE *stream)
{
    const bool failed = ferror(stream);
    if (failed)
        fputc('\n', stream);
    if (fflush(stream))
        return false;
    if (failed)
        errno = EIO; /* there is room again, but something is lost */
    return !failed;
}

enum status file_out_commit(struct file_out *out, struct error *err)
{
    enum status status = STATUS_OK;
    bool wrote = flush(out->stream);
    if (wrote && out->temporary)
        wrote = !fsync(fileno(out->stream));
    if (!wrote)
        status = error_set_errno(err, out->target, "write");
    else if (out->nameless && !give_name(out))
        status = error_set_errno(err, out->target, "replace");
    FILE *stream = out->stream;
    out->stream = NULL;
    if (fclose(stream) && !status)
        status = error_set_errno(err, out->target, "write");
    if (!status && out->temporary) {
        if (rename(out->temporary, out->target)) {
            status = error_set_errno(err, out->target, "replace");
        } else {
            free(out->temporary);
            out->temporary = NULL;
            file_sync_folder_of(out->target);
        }
    }
    file_out_abandon(out);
    return status;
}

void file_out_abandon(struct file_out *out)
{
    if (!out)
        return;
    if (out->stream)
        fclose(out->stream);
    if (out->temporary && !out->nameless)
        unlink(out->temporary);
    free(out->temporary);
    free(out->target);
    free(out);
}

static enum status is_no_folder(const char *path, struct error *err)
{
    return error_set(err, STATUS_FILE, "%s: is a file; give the name of a folder", path);
}

enum status file_make_folder(const char *path, struct error *err)
{
    struct stat info;
    if (!mkdir(path, 0777))
        return STATUS_OK;
    if (errno == EEXIST && !stat(path, &info) && S_ISDIR(info.st_mode))
        return STATUS_OK;
    if (errno == EEXIST)
        return is_no_folder(path, err);
    return error_set_errno(err, path, "make the folder");
}

enum status file_check_folder(const char *path, struct error *err)
{
    struct stat info;
    size_t length = strlen(path);
    const bool exists = !stat(path, &info);
    if (exists && !S_ISDIR(info.st_mode))
        return is_no_folder(path, err);
    if (exists)
        return access(path, W_OK) ? error_set_errno(err, path, "write into the folder") : STATUS_OK;
    while (length > 1 && path[length - 1] == '/')
        length--;
    char *name = strndup(path, length);
    enum status status = name ? file_out_check(name, err) : error_no_memory(err, path);
    free(name);
    return status;
}

bool file_same(const char *a, const char *b)
{
    struct stat one, other;
    return !stat(a, &one) && !stat(b, &other) && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool file_program_exists(const char *program)
{
    char path[4096];
    const char *folders = getenv("PATH");
    for (const char *folder = folders ? folders : "/usr/bin:/bin"; *folder;) {
        int length = (int)strcspn(folder, ":");
        int used = snprintf(path, sizeof path, "%.*s/%s", length, folder, program);
        if (used > 0 && (size_t)used < sizeof path && !access(path, X_OK))
            return true;
        folder += length + (folder[length] == ':');
    }
    return false;
}

bool file_has_extension(const char *path, const char *extension)
{
    const char *dot = strrchr(path, '.');
    return dot && !strcasecmp(dot + 1, extension);
}
