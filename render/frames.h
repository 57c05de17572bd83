/*
 * Where a run's pictures go: numbered PNG files, a movie, a contact sheet, each of them if asked for.
 *
 *     struct frames_options options = {.folder = "frames", .movie = "fox.mp4", .rate = 30};
 *     struct frames *frames;
 *     if (frames_open(&options, &frames, err)) ...
 *     if (frames_add(frames, &image, time, err)) ...       for each picture, in order
 *     if (frames_close(frames, err)) ...                   always, also after frames_add() failed
 *
 * Pictures are copied in; PNGs are encoded and the movie is fed by threads of its own, through a queue that
 * holds a few pictures and then makes frames_add() wait. What goes wrong there comes back from the next call.
 */
#ifndef RENDER_FRAMES_H
#define RENDER_FRAMES_H

#include "common/status.h"
#include "render/image.h"

struct frames_options {
    const char *folder;  /* frame_0000.png, frame_0001.png, ... are written here; made if missing; or NULL */
    const char *movie;   /* .mp4, .webm or .gif, through the program ffmpeg; or NULL */
    const char *sheet;   /* PNG of twelve moments (sheet.h); or NULL */
    const char *counted; /* what frames_count() counts for the sheet, as "edges broken", borrowed; or NULL */
    const char *counted_one; /* the same of a single one, as "edge broken" */
    /* "left" or "right": every name ends in -left or -right, before its extension; or NULL. */
    const char *eye;
    size_t first;      /* number of the first PNG */
    double rate;       /* pictures a second in the movie; 0: 30 */
    int width, height; /* of the pictures: what no movie can have is refused at once; 0: not known yet */
    int workers;       /* threads that encode PNGs; 0: one for each processor */
    /* [text_count] for every PNG, borrowed until frames_close(); "Time" is added. */
    const struct image_text *texts;
    size_t text_count;
};

struct frames;

/* Begins. frame_files.h tells what an earlier run has left in the folder. Errors: STATUS_FILE (the folder
 * cannot be made, is a file or cannot be written), STATUS_USAGE (the movie's extension), STATUS_RANGE (its
 * size), STATUS_RESOURCE (ffmpeg is not installed or lacks an encoder), STATUS_NO_MEMORY. Nothing is left
 * behind. */
enum status frames_open(const struct frames_options *options, struct frames **frames, struct error *err);

/* So much of what is counted has happened in the pictures that follow: the sheet shows most of its moments
 * while that grows. */
void frames_count(struct frames *frames, double count);

/* Adds a copy of the next picture, shown at `time` (seconds, for the sheet's labels and the PNGs' text). All
 * pictures have the first one's size (else STATUS_RANGE). Errors are those of writing; after one no more are
 * taken; PNGs that are queued are still written where none failed. */
enum status frames_add(struct frames *frames, const struct image *image, double time, struct error *err);

/* Waits for what is queued, ends the movie, writes the sheet and frees `frames`. Returns the first error of
 * the whole run, also when frames_add() returned it before. PNGs that were complete stay; after an error
 * there is no movie that was not complete and no sheet, and an older file of its name is untouched. */
enum status frames_close(struct frames *frames, struct error *err);

/* The same where the run failed elsewhere: PNGs stay, the movie and the sheet are thrown away. */
void frames_abandon(struct frames *frames);

#endif
