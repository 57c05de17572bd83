/* balloon-sim's command line. */
#ifndef SIM_OPTIONS_H
#define SIM_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

struct options {
    const char *scene;
    const char **set; /* [set_count] KEY=VALUE, in order */
    size_t set_count;
    const char *frames, *movie, *sheet, *log, *plot, *mesh, *pieces;
    const char *series, *cache; /* DIR; FILE.pc2 */
    bool series_vtp, series_constant;
    const char *checkpoint, *resume;
    double checkpoint_every;                 /* s */
    const char *accuracy_cost, *effect_cost; /* FILE.tsv, .png or .svg */
    bool turntable;                          /* the camera goes round over the film ... */
    long turntable_frames;                   /* ... or, above 0, over so many pictures of the last state */
    bool estimate;
    unsigned threads; /* 0: as many as the machine has */
    bool hash, check, explain, help_scene;
    bool window; /* asked for, or no output is */
};

/* Reads the command line; texts are borrowed from argv. Wrong usage ends the program with 2, --help and
 * --version with 0. False: not enough memory. */
bool options_parse(struct options *options, int argc, char **argv);
void options_clear(struct options *options);

#endif
