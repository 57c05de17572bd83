/* The whole program: balloon-sim on the paper's sphere, by what it is asked to write. The paper's machine took about
 * one second a frame: 400 s. bench_burst BALLOON-SIM SCENE */
#include "support/bench.h"

#include <fcntl.h>
#include <ftw.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static int remove_entry(const char *path, const struct stat *info, int type, struct FTW *where)
{
    (void)info, (void)type, (void)where;
    return remove(path);
}

/* Runs the program with these arguments in a folder of its own; one row of the table. */
static void run(const char *name, char *const *arguments)
{
    char folder[] = "/tmp/balloon-bench-XXXXXX";
    if (!mkdtemp(folder))
        exit(1);
    struct rusage usage;
    int status = 0;
    const double began = bench_seconds();
    pid_t child = fork();
    if (child == 0) {
        int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDOUT_FILENO);
        if (chdir(folder) || execv(arguments[0], arguments))
            _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &usage) != child)
        exit(1);
    const double spent = bench_seconds() - began;
    const double cpu = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                       1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    printf("%-40s  %4d  %7.2f  %7.2f  %9.1f  %6.1f\n", name, WEXITSTATUS(status), spent, cpu,
           (double)usage.ru_maxrss / 1024, 400 / spent);
    fflush(stdout);
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        exit(1);
}

int main(int argc, char **argv)
{
    char *program = argc == 3 ? realpath(argv[1], NULL) : NULL;
    if (!program)
        return 2;
    printf("400 stereo frames of 1280 x 480            exit     wall      cpu    peak MB  frames/s\n");
    run("simulated", (char *[]){program, "-q", argv[2], NULL});
    run("simulated, log", (char *[]){program, "-q", argv[2], "--log", "log.tsv", NULL});
    run("simulated, drawn, PNGs", (char *[]){program, "-q", argv[2], "--frames", "frames", NULL});
    run("simulated, drawn, PNGs, movie and sheet",
        (char *[]){program, "-q", argv[2], "--frames", "frames", "--movie", "burst.mp4", "--contact-sheet",
                   "sheet.png", NULL});
    free(program);
    return 0;
}
