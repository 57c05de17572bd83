/* Loaded into a program: lets calls that its own code or libpng make fail, one by number (failing.h), and
 * stops the clock that they see, so that what is written is the same each time. */
#include "failing.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <spawn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { RANGES_MAX = 16 };

static struct failing *shared;
static struct {
    uintptr_t begin, end;
} ranges[RANGES_MAX]; /* where the code lies whose calls count */
static int range_count;

static int note_ranges(struct dl_phdr_info *info, size_t size, void *context)
{
    (void)size;
    (void)context;
    const bool program = !*info->dlpi_name;
    if (!program && !strstr(info->dlpi_name, "/libpng"))
        return 0;
    for (int i = 0; i < info->dlpi_phnum && range_count < RANGES_MAX; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && info->dlpi_phdr[i].p_flags & PF_X) {
            const uintptr_t begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            ranges[range_count].begin = begin;
            ranges[range_count++].end = begin + info->dlpi_phdr[i].p_memsz;
        }
    return 0;
}

/* The programs that this one starts are left alone. */
__attribute__((constructor)) static void begin(void)
{
    const char *path = getenv("FAILING");
    const int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    unsetenv("LD_PRELOAD");
    unsetenv("FAILING");
    if (file < 0)
        return;
    dl_iterate_phdr(note_ranges, NULL);
    void *mapped = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    shared = mapped == MAP_FAILED ? NULL : mapped;
}

static bool is_ours(const void *caller)
{
    for (int i = 0; i < range_count; i++)
        if ((uintptr_t)caller >= ranges[i].begin && (uintptr_t)caller < ranges[i].end)
            return true;
    return false;
}

static pthread_once_t once = PTHREAD_ONCE_INIT;
static atomic_bool ended;

static void note_end(void)
{
    ended = true;
}

/* Once main() is begun, so that it comes before what gcov does at the end, which is the program's
 * code and not its doing. */
static void ask_for_end(void)
{
    atexit(note_end);
}

static bool fails(unsigned kind, const char *name, const void *caller)
{
    if (!shared || ended || !is_ours(caller))
        return false;
    pthread_once(&once, ask_for_end);
    if (!failing_counts(shared, kind))
        return false;
    if (!*shared->failed)
        snprintf(shared->failed, sizeof shared->failed, "%s", name);
    errno = ENOMEM;
    return true;
}

/* Until the real functions are found the C library may itself need memory. */
static char early[4096];
static size_t early_used;

static void *early_calloc(size_t size)
{
    void *block = early + early_used;
    early_used += (size + 15) & ~(size_t)15;
    if (early_used > sizeof early)
        abort();
    return block;
}

static bool is_early(const void *block)
{
    return (const char *)block >= early && (const char *)block < early + sizeof early;
}

/* volatile: <dlfcn.h> promises that dlsym() does not come back here, which it does for memory */
static _Thread_local volatile bool looking __attribute__((tls_model("initial-exec")));

static void *find(const char *name)
{
    looking = true;
    void *function = dlsym(RTLD_NEXT, name);
    looking = false;
    if (!function)
        abort();
    return function;
}

#define REAL(name)                     \
    static __typeof__(&name) real;     \
    if (!real) {                       \
        *(void **)&real = find(#name); \
    }

void *malloc(size_t size)
{
    static __typeof__(&malloc) real;
    if (!real && looking)
        return early_calloc(size);
    if (!real)
        *(void **)&real = find("malloc");
    return fails(FAILING_MEMORY, "malloc", __builtin_return_address(0)) ? NULL : real(size);
}

void *calloc(size_t count, size_t size)
{
    static __typeof__(&calloc) real;
    if (!real && looking)
        return early_calloc(count * size);
    if (!real)
        *(void **)&real = find("calloc");
    return fails(FAILING_MEMORY, "calloc", __builtin_return_address(0)) ? NULL : real(count, size);
}

void *realloc(void *block, size_t size)
{
    REAL(realloc)
    return fails(FAILING_MEMORY, "realloc", __builtin_return_address(0)) ? NULL : real(block, size);
}

/* What is freed while free() itself is looked up is an old message about a function that
 * was not found: it stays. */
void free(void *block)
{
    static __typeof__(&free) real;
    if (is_early(block) || (!real && looking))
        return;
    if (!real)
        *(void **)&real = find("free");
    real(block);
}

/* A function that only has to be counted. */
#define WRAP(kind, type, name, parameters, arguments, failure)                             \
    type name parameters                                                                   \
    {                                                                                      \
        REAL(name)                                                                         \
        return fails(kind, #name, __builtin_return_address(0)) ? failure : real arguments; \
    }

WRAP(FAILING_MEMORY, void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size), NULL)
WRAP(FAILING_MEMORY, char *, strdup, (const char *text), (text), NULL)
WRAP(FAILING_MEMORY, char *, strndup, (const char *text, size_t size), (text, size), NULL)
WRAP(FAILING_MEMORY, FILE *, open_memstream, (char **text, size_t *size), (text, size), NULL)
WRAP(FAILING_MEMORY, char *, realpath, (const char *path, char *resolved), (path, resolved), NULL)
WRAP(FAILING_STARTS, int, pthread_create,
     (pthread_t * thread, const pthread_attr_t *attributes, void *(*run)(void *), void *context),
     (thread, attributes, run, context), EAGAIN)
WRAP(FAILING_STARTS, int, posix_spawnp,
     (pid_t * process, const char *file, const posix_spawn_file_actions_t *actions,
      const posix_spawnattr_t *attributes, char *const arguments[], char *const environment[]),
     (process, file, actions, attributes, arguments, environment), EAGAIN)
WRAP(FAILING_STARTS, int, pipe2, (int ends[2], int flags), (ends, flags), -1)
WRAP(FAILING_STARTS, int, memfd_create, (const char *name, unsigned flags), (name, flags), -1)

int asprintf(char **text, const char *format, ...)
{
    if (fails(FAILING_MEMORY, "asprintf", __builtin_return_address(0)))
        return -1;
    va_list rest;
    va_start(rest, format);
    const int length = vasprintf(text, format, rest);
    va_end(rest);
    return length;
}

/* As in <GL/osmesa.h>, which need not be here. */
typedef void *create_context(const int *attributes, void *shared_with);
typedef unsigned char make_current(void *context, void *pixels, unsigned type, int width, int height);
create_context OSMesaCreateContextAttribs;
make_current OSMesaMakeCurrent;

WRAP(FAILING_STARTS, void *, OSMesaCreateContextAttribs, (const int *attributes, void *shared_with),
     (attributes, shared_with), NULL)
WRAP(FAILING_STARTS, unsigned char, OSMesaMakeCurrent,
     (void *context, void *pixels, unsigned type, int width, int height),
     (context, pixels, type, width, height), 0)

int clock_gettime(clockid_t clock, struct timespec *time)
{
    REAL(clock_gettime)
    if (!shared || !is_ours(__builtin_return_address(0)))
        return real(clock, time);
    *time = (struct timespec){.tv_sec = 1000};
    return 0;
}
