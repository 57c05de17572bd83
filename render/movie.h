/*
 * A movie, encoded by the program `ffmpeg` that is fed through a pipe.
 *
 *     struct movie *movie;
 *     if (movie_check("fox.mp4", err)) ...                         before a long run
 *     if (movie_open("fox.mp4", 1280, 480, 30, &movie, err)) ...
 *     if (movie_add(movie, &image, err)) ...                       for each picture
 *     return movie_commit(movie, err);                             or movie_abandon(movie)
 *
 * It is written under another name in the same folder, so the file that was there stays whole until the end.
 * Should this program be killed, ffmpeg meets the end of its pipe and completes that other file; should
 * ffmpeg be killed with it, all but the last second can still be played.
 */
#ifndef RENDER_MOVIE_H
#define RENDER_MOVIE_H

#include "common/status.h"
#include "render/image.h"

struct movie;

/* Errors: STATUS_USAGE where the extension is not .mp4, .webm or .gif, STATUS_RESOURCE where ffmpeg is not
 * installed or lacks the encoder, STATUS_FILE where path cannot be written, as in file_out_check(). */
enum status movie_check(const char *path, struct error *err);

/* Errors: STATUS_RANGE for pictures, of sides up to IMAGE_SIDE_MAX, that are smaller than a movie's
 * or larger than ffmpeg's can be. */
enum status movie_check_size(const char *path, int width, int height, struct error *err);

/* Starts ffmpeg for pictures of this size, `rate` of them a second (above 0, at most 1000). Odd sizes
 * lose their last column or row, since movies halve their colours' resolution (.gif does not). The path
 * is one that movie_check() took. Errors: STATUS_RANGE as above, and for a rate out of range;
 * STATUS_FILE, STATUS_NO_MEMORY. */
enum status movie_open(const char *path, int width, int height, double rate, struct movie **movie,
                       struct error *err);

/* Adds the next picture, of the movie's size. Waits while ffmpeg is busy. Errors: STATUS_FILE with ffmpeg's
 * own message; movie_abandon() is the only thing to do then. */
enum status movie_add(struct movie *movie, const struct image *image, struct error *err);

/* Ends the movie, puts it in its place and frees `movie`, whatever it returns. Errors: STATUS_FILE; then
 * nothing is left behind and the old file is untouched. */
enum status movie_commit(struct movie *movie, struct error *err);

/* Throws away what was made and frees `movie`. NULL is fine. */
void movie_abandon(struct movie *movie);

#endif
