/* The whole program: balloon-sim on the paper's sphere, by what it is asked to write. The paper's machine
 * took about one second a frame: 400 s. bench_burst BALLOON-SIM SCENE */
#include "support/bench_program.h"

/* Runs the program with these arguments in a folder of its own; one row of the table. */
static void run(const char *name, char *const *arguments)
{
    char folder[] = "/tmp/balloon-bench-XXXXXX";
    if (!mkdtemp(folder))
        exit(1);
    const struct bench_run r = bench_run(folder, arguments);
    printf("%-40s  %7.2f  %7.2f  %9.1f  %6.1f\n", name, r.seconds, r.cpu_seconds, r.peak_bytes / 1048576,
           400 / r.seconds);
    fflush(stdout);
    bench_remove_folder(folder);
}

int main(int argc, char **argv)
{
    char *program = argc == 3 ? realpath(argv[1], NULL) : NULL;
    if (!program)
        return 2;
    printf("400 stereo frames of 1280 x 480              wall      cpu    peak MB  frames/s\n");
    run("simulated, hash", (char *[]){program, "-q", argv[2], "--hash", NULL});
    run("simulated, log", (char *[]){program, "-q", argv[2], "--log", "log.tsv", NULL});
    run("simulated, drawn, PNGs", (char *[]){program, "-q", argv[2], "--frames", "frames", NULL});
    run("simulated, drawn, PNGs, movie and sheet",
        (char *[]){program, "-q", argv[2], "--frames", "frames", "--movie", "burst.mp4", "--contact-sheet",
                   "sheet.png", NULL});
    free(program);
    return 0;
}
