/* What the benchmarks of whole programs share: a program is run to its end, and what it took is known. */
#ifndef TESTS_SUPPORT_BENCH_PROGRAM_H
#define TESTS_SUPPORT_BENCH_PROGRAM_H

#include "support/bench.h"

#include <fcntl.h>
#include <ftw.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

struct bench_run {
    double seconds, cpu_seconds, peak_bytes;
};

/* A program that fails is nothing to measure. Its standard output goes nowhere. */
static inline struct bench_run bench_run(const char *folder, char *const *arguments)
{
    struct rusage usage;
    int status = 0;
    const double began = bench_seconds();
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        if (!chdir(folder))
            execv(arguments[0], arguments);
        _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status)
        exit(1);
    return (struct bench_run){
        .seconds = bench_seconds() - began,
        .cpu_seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                       1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
        .peak_bytes = 1024.0 * (double)usage.ru_maxrss,
    };
}

static inline int bench_remove_entry(const char *path, const struct stat *info, int type, struct FTW *where)
{
    (void)info, (void)type, (void)where;
    return remove(path);
}

static inline void bench_remove_folder(const char *folder)
{
    nftw(folder, bench_remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

#endif
