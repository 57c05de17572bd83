/*
 * every_call LIBRARY MOST files|memory|starts[,lasting] PROGRAM ARGUMENT...
 *
 * Runs a command in the current folder once as it is, which tells how many calls it makes and what it leaves;
 * then once for each call, with that call failing (all after it too: lasting), the folder put back each time.
 * Where there are more than MOST, that many, evenly spread. What must hold:
 *   - it ends with 0 and has done all, or with 1 and one message on one line, with the program's name in front;
 *   - every file is as it was or as it must become, and there is no other; after a 0 with a note in place of a message a
 *     file may differ from what it would have been, as the note tells.
 * LIBRARY is failing.so. 77: the kernel does not let us.
 */
#include "snapshot.h"
#include "supervise.h"

#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { PROBLEMS_MAX = 10, SKIPPED = 77 };

struct every {
    char **command;
    const char *program; /* its name in messages */
    char *library, shared_path[64];
    struct failing *failing;
    struct snapshot before, after;
    long problems;
};

static void complain(struct every *every, int exit_status, const char *what, const char *where)
{
    char line[400] = "";
    FILE *stream = fopen(".stderr", "r");
    if (every->problems++ >= PROBLEMS_MAX)
        return;
    printf("call %ld, %s: exit %d: %s %s\n", every->failing->number, every->failing->failed, exit_status,
           what, where);
    for (int i = 0; stream && i < 12 && fgets(line, sizeof line, stream); i++)
        printf("    %s", line);
    if (stream)
        fclose(stream);
}

/* What the program said: a line with its name in front, nothing, or something else. */
enum words { WORDS_NONE, WORDS_ONE, WORDS_WRONG };

static enum words read_words(const struct every *every)
{
    char line[4096];
    FILE *stream = fopen(".stderr", "r");
    const char *first = stream ? fgets(line, sizeof line, stream) : NULL;
    const size_t length = strlen(every->program);
    enum words words = !first ? WORDS_NONE
                       : !strncmp(line, every->program, length) && !strncmp(line + length, ": ", 2) &&
                               strlen(line) > length + 10
                           ? WORDS_ONE
                           : WORDS_WRONG;
    if (first && fgets(line, sizeof line, stream))
        words = WORDS_WRONG;
    if (stream)
        fclose(stream);
    return words;
}

/* Each file is old or new; new they all are after a success, or at least there where there was a note. */
static void check_files(struct every *every, const struct snapshot *now, int exit_status, bool noted)
{
    for (size_t i = 0; i < now->count; i++) {
        const char *path = now->files[i].path;
        const struct snapshot_file *old = snapshot_find(&every->before, path),
                                   *new = snapshot_find(&every->after, path);
        if (exit_status && !strcmp(path, "./.stdout"))
            continue;
        if (!old && !new)
            complain(every, exit_status, "left behind:", path);
        else if (!(noted && !exit_status) && !snapshot_same(&now->files[i], new) &&
                 (!exit_status || !snapshot_same(&now->files[i], old)))
            complain(every, exit_status, "neither old nor new:", path);
    }
    for (size_t i = 0; i < every->after.count; i++) {
        const char *path = every->after.files[i].path;
        if (!snapshot_find(now, path) && (!exit_status || snapshot_find(&every->before, path)))
            complain(every, exit_status, "is not there:", path);
    }
}

static int run(struct every *every, long number)
{
    every->failing->number = number;
    every->failing->count = 0;
    every->failing->failed[0] = '\0';
    return supervise(every->command, every->failing, every->shared_path, every->library);
}

static void fail_call(struct every *every, long number)
{
    const int exit_status = run(every, number);
    const enum words words = read_words(every);
    struct snapshot now = snapshot_take();
    if (exit_status != 0 && exit_status != 1)
        complain(every, exit_status, "wanted 0 or 1", "");
    else if (!*every->failing->failed && exit_status)
        complain(every, exit_status, "though nothing failed", "");
    else if (words == WORDS_WRONG || (exit_status && words == WORDS_NONE))
        complain(every, exit_status, "wanted one message, with the program's name in front", "");
    else
        check_files(every, &now, exit_status, words == WORDS_ONE);
    snapshot_restore(&every->before, &now);
    snapshot_clear(&now);
}

/* `limit` of those that the undisturbed run counted, which ended with that status. */
static void fail_calls(struct every *every, int undisturbed, const char *kinds, long limit)
{
    const long count = every->failing->count, most = limit < count ? limit : count;
    if (undisturbed || read_words(every) != WORDS_NONE)
        complain(every, undisturbed, "undisturbed, wanted 0 and no message", "");
    snapshot_restore(&every->before, &every->after);
    for (long i = 0; i < most && every->problems < PROBLEMS_MAX; i++)
        fail_call(every, 1 + i * count / most);
    printf("%s: %ld of %ld calls failed in turn (%s), %ld problems\n", every->program, most, count, kinds,
           every->problems);
}

static void share(struct every *every)
{
    const int file = memfd_create("failing", 0);
    snprintf(every->shared_path, sizeof every->shared_path, "/proc/%d/fd/%d", (int)getpid(), file);
    if (file < 0 || ftruncate(file, sizeof *every->failing))
        exit(1);
    every->failing = mmap(NULL, sizeof *every->failing, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (every->failing == MAP_FAILED)
        exit(1);
}

static unsigned kind_of(const char *name)
{
    return !strncmp(name, "files", 5)    ? FAILING_FILES
           : !strncmp(name, "memory", 6) ? FAILING_MEMORY
                                         : FAILING_STARTS;
}

int main(int argc, char **argv)
{
    if (argc < 5) {
        fprintf(stderr, "usage: every_call LIBRARY MOST files|memory|starts[,lasting] PROGRAM ARGUMENT...\n");
        return 2;
    }
    char *path = strdup(argv[4]);
    struct every every = {.command = argv + 4, .program = basename(path), .library = argv[1]};
    share(&every);
    every.failing->kinds = kind_of(argv[3]);
    every.failing->lasting = strstr(argv[3], "lasting");
    fclose(fopen(".stdout", "w"));
    every.before = snapshot_take();
    const int undisturbed = run(&every, 0);
    every.after = snapshot_take();
    if (undisturbed == SUPERVISE_UNABLE)
        printf("the kernel does not let a test decide on a program's system calls\n");
    else
        fail_calls(&every, undisturbed, argv[3], atol(argv[2]));
    snapshot_clear(&every.before);
    snapshot_clear(&every.after);
    free(path);
    return undisturbed == SUPERVISE_UNABLE ? SKIPPED : every.problems > 0;
}
