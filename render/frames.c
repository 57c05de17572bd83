#include "render/frames.h"

#include "common/array.h"
#include "common/file.h"
#include "render/frame_files.h"
#include "render/movie.h"
#include "render/sheet.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { QUEUE_MAX = 16, WORKERS_MAX = 64, QUEUE_BYTES = 256 << 20 };

/* A picture in the queue. */
struct slot {
    struct image image;
    double time;
    int users; /* a worker, the movie: who is not done with it yet */
};

struct frames {
    struct frames_options options;
    char *folder, *movie_path, *sheet_path;
    struct movie *movie;
    struct sheet sheet;

    pthread_mutex_t lock;  /* guards what follows */
    pthread_cond_t change; /* of any of it */
    struct slot slots[QUEUE_MAX];
    size_t capacity;                   /* slots in use: picture n lies in slot n % capacity */
    size_t added, next_png, next_shot; /* pictures so far; the next for a worker, for the movie */
    bool ending;
    struct error first; /* what went wrong first */

    pthread_t workers[WORKERS_MAX], movie_thread;
    int worker_count;
    bool movie_running;
    atomic_bool png_failed, movie_failed; /* what is still queued is not written to it */
};

static void note_failure(struct frames *frames, const struct error *err)
{
    pthread_mutex_lock(&frames->lock);
    if (!frames->first.status)
        frames->first = *err;
    pthread_mutex_unlock(&frames->lock);
}

static struct error failure_so_far(struct frames *frames)
{
    pthread_mutex_lock(&frames->lock);
    struct error first = frames->first;
    pthread_mutex_unlock(&frames->lock);
    return first;
}

/* Waits for picture *next, counts it as taken, and returns its slot; NULL when there are no more. *number
 * becomes its number. */
static struct slot *take(struct frames *frames, size_t *next, size_t *number)
{
    struct slot *slot = NULL;
    pthread_mutex_lock(&frames->lock);
    while (*next == frames->added && !frames->ending)
        pthread_cond_wait(&frames->change, &frames->lock);
    if (*next < frames->added) {
        *number = (*next)++;
        slot = &frames->slots[*number % frames->capacity];
    }
    pthread_mutex_unlock(&frames->lock);
    return slot;
}

static void release(struct frames *frames, struct slot *slot)
{
    pthread_mutex_lock(&frames->lock);
    slot->users--;
    pthread_cond_broadcast(&frames->change);
    pthread_mutex_unlock(&frames->lock);
}

static enum status write_frame(const struct frames *frames, const struct slot *slot, size_t number,
                               struct error *err)
{
    char time[32];
    char *path = frame_file(frames->folder, frames->options.first + number, frames->options.eye);
    size_t count = frames->options.text_count;
    struct image_text *texts = array_new(count + 1, sizeof *texts);
    if (!texts || !path) {
        free(path);
        free(texts);
        return error_no_memory(err, "a frame");
    }
    snprintf(time, sizeof time, "%.9g", slot->time);
    if (count)
        memcpy(texts, frames->options.texts, count * sizeof *texts);
    texts[count] = (struct image_text){"Time", time};
    enum status status = image_save_png(&slot->image, path, texts, count + 1, err);
    free(path);
    free(texts);
    return status;
}

static void *run_worker(void *context)
{
    struct frames *frames = context;
    size_t number;
    for (struct slot *slot; (slot = take(frames, &frames->next_png, &number)); release(frames, slot)) {
        struct error err = {0};
        if (!frames->png_failed && write_frame(frames, slot, number, &err)) {
            frames->png_failed = true;
            note_failure(frames, &err);
        }
    }
    return NULL;
}

static void *run_movie(void *context)
{
    struct frames *frames = context;
    size_t number;
    for (struct slot *slot; (slot = take(frames, &frames->next_shot, &number)); release(frames, slot)) {
        struct error err = {0};
        if (!frames->movie_failed && movie_add(frames->movie, &slot->image, &err)) {
            frames->movie_failed = true;
            note_failure(frames, &err);
        }
    }
    return NULL;
}

/* Threads that are started here leave signals to the program's own. Returns an errno. */
static int start_thread(pthread_t *thread, void *(*run)(void *), struct frames *frames)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    int problem = pthread_create(thread, NULL, run, frames);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return problem;
}

static int wanted_workers(const struct frames_options *options)
{
    long count = options->workers > 0 ? options->workers : sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > WORKERS_MAX ? WORKERS_MAX : (int)count;
}

static enum status start_workers(struct frames *frames, struct error *err)
{
    int wanted = frames->folder ? wanted_workers(&frames->options) : 0;
    while (frames->worker_count < wanted) {
        if (start_thread(&frames->workers[frames->worker_count], run_worker, frames))
            return error_set(err, STATUS_NO_MEMORY, "cannot start a thread that writes frames");
        frames->worker_count++;
    }
    return STATUS_OK;
}

/* The folder must be there and take files, the movie and the sheet must have a chance. */
static enum status check_outputs(const struct frames *frames, struct error *err)
{
    enum status status = STATUS_OK;
    if (frames->movie_path)
        status = movie_check(frames->movie_path, err);
    if (!status && frames->movie_path && frames->options.width > 0)
        status = movie_check_size(frames->movie_path, frames->options.width, frames->options.height, err);
    if (!status && frames->sheet_path)
        status = file_out_check(frames->sheet_path, err);
    if (!status && frames->folder)
        status = file_make_folder(frames->folder, err);
    if (!status && frames->folder && access(frames->folder, W_OK))
        status = error_set_errno(err, frames->folder, "write into the folder");
    return status;
}

static bool copy_name(char **copy, const char *name, const char *eye)
{
    *copy = name ? frame_eye_file(name, eye) : NULL;
    return *copy || !name;
}

static void free_frames(struct frames *frames)
{
    for (size_t i = 0; i < QUEUE_MAX; i++)
        image_clear(&frames->slots[i].image);
    sheet_clear(&frames->sheet);
    pthread_mutex_destroy(&frames->lock);
    pthread_cond_destroy(&frames->change);
    free(frames->folder);
    free(frames->movie_path);
    free(frames->sheet_path);
    free(frames);
}

static void stop_threads(struct frames *frames)
{
    pthread_mutex_lock(&frames->lock);
    frames->ending = true;
    pthread_cond_broadcast(&frames->change);
    pthread_mutex_unlock(&frames->lock);
    for (int i = 0; i < frames->worker_count; i++)
        pthread_join(frames->workers[i], NULL);
    if (frames->movie_running)
        pthread_join(frames->movie_thread, NULL);
}

enum status frames_open(const struct frames_options *options, struct frames **result, struct error *err)
{
    enum status status = STATUS_OK;
    struct frames *frames = calloc(1, sizeof *frames);
    if (!frames)
        return error_no_memory(err, "the frames");
    frames->options = *options;
    frames->sheet.counted = options->counted;
    frames->sheet.counted_one = options->counted_one;
    pthread_mutex_init(&frames->lock, NULL);
    pthread_cond_init(&frames->change, NULL);
    if (!copy_name(&frames->folder, options->folder, NULL) ||
        !copy_name(&frames->movie_path, options->movie, options->eye) ||
        !copy_name(&frames->sheet_path, options->sheet, options->eye))
        status = error_no_memory(err, "the frames");
    if (!status)
        status = check_outputs(frames, err);
    if (!status)
        status = start_workers(frames, err);
    if (status) {
        stop_threads(frames);
        free_frames(frames);
        return status;
    }
    *result = frames;
    return STATUS_OK;
}

/* With the first picture its size is known: how many can wait, and what the movie's must be. */
static enum status begin(struct frames *frames, const struct image *image, struct error *err)
{
    size_t bytes = 3 * (size_t)image->width * (size_t)image->height, room = QUEUE_BYTES / bytes;
    frames->capacity = room < 2 ? 2 : room > QUEUE_MAX ? QUEUE_MAX : room;
    for (size_t i = 0; i < frames->capacity; i++) {
        enum status status = image_init(&frames->slots[i].image, image->width, image->height, err);
        if (status)
            return status;
    }
    if (!frames->movie_path)
        return STATUS_OK;
    double rate = frames->options.rate > 0 ? frames->options.rate : 30;
    enum status status = movie_open(frames->movie_path, image->width, image->height, rate, &frames->movie,
                                    err);
    if (status)
        return status;
    if (start_thread(&frames->movie_thread, run_movie, frames))
        return error_set(err, STATUS_NO_MEMORY, "cannot start a thread that feeds the movie");
    frames->movie_running = true;
    return STATUS_OK;
}

/* Puts a copy into the queue as soon as there is room. */
static void enqueue(struct frames *frames, const struct image *image, double time)
{
    struct slot *slot = &frames->slots[frames->added % frames->capacity];
    pthread_mutex_lock(&frames->lock);
    while (slot->users)
        pthread_cond_wait(&frames->change, &frames->lock);
    pthread_mutex_unlock(&frames->lock);
    memcpy(slot->image.rgb, image->rgb, 3 * (size_t)image->width * (size_t)image->height);
    slot->time = time;
    pthread_mutex_lock(&frames->lock);
    slot->users = (frames->worker_count > 0) + frames->movie_running;
    frames->added++;
    pthread_cond_broadcast(&frames->change);
    pthread_mutex_unlock(&frames->lock);
}

void frames_count(struct frames *frames, double count)
{
    frames->sheet.count_now = count;
}

enum status frames_add(struct frames *frames, const struct image *image, double time, struct error *err)
{
    struct error problem = failure_so_far(frames);
    enum status status = problem.status;
    const struct image *first = &frames->slots[0].image;
    if (status)
        return error_set(err, status, "%s", problem.text);
    if (!frames->capacity)
        status = begin(frames, image, &problem);
    else if (image->width != first->width || image->height != first->height)
        status = error_set(&problem, STATUS_RANGE, "a frame of %d x %d follows one of %d x %d", image->width,
                           image->height, first->width, first->height);
    if (!status && frames->sheet_path)
        status = sheet_add(&frames->sheet, image, time, &problem);
    if (!status) {
        enqueue(frames, image, time);
        return STATUS_OK;
    }
    note_failure(frames, &problem);
    return error_set(err, status, "%s", problem.text);
}

static enum status write_sheet(const struct frames *frames, struct error *err)
{
    struct image image = {0};
    enum status status = sheet_draw(&frames->sheet, &image, err);
    if (!status)
        status = image_save_png(&image, frames->sheet_path, frames->options.texts, frames->options.text_count,
                                err);
    image_clear(&image);
    return status;
}

void frames_abandon(struct frames *frames)
{
    stop_threads(frames);
    movie_abandon(frames->movie);
    free_frames(frames);
}

enum status frames_close(struct frames *frames, struct error *err)
{
    struct error problem = {0};
    stop_threads(frames);
    if (!frames->movie_running || frames->first.status)
        movie_abandon(frames->movie);
    else if (movie_commit(frames->movie, &problem))
        note_failure(frames, &problem);
    if (frames->sheet.count && !frames->first.status && write_sheet(frames, &problem))
        note_failure(frames, &problem);
    problem = frames->first;
    free_frames(frames);
    return problem.status ? error_set(err, problem.status, "%s", problem.text) : STATUS_OK;
}
