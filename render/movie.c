#include "render/movie.h"

#include "common/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { TEMPORARY_TRIES = 100, ARGUMENTS_MAX = 40 };

struct movie {
    char *target, *temporary; /* names of the movie and of the file that ffmpeg writes */
    pid_t ffmpeg;             /* 0: not running */
    int pipe;                 /* to ffmpeg's standard input; -1: closed */
    int messages;             /* a file in memory with what ffmpeg has to say; -1: none */
    int width, height;
};

/* How each kind is encoded: for mp4 and webm 4:2:0 colour, which every player takes, marked as BT.709 so that
 * red stays red; for gif a palette of its own for every picture, so that none has to be kept. What is written
 * can be played from its start however soon it ends: mp4 and webm in fragments of a second. */
struct kind {
    const char *extension, *encoder, *filter;
    const char *options[16];
};

#define EVEN_BT709 "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"
#define FRAGMENTS  "+frag_keyframe+empty_moov+default_base_moof"
#define MARK_BT709 "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"

static const struct kind kinds[] = {
    {"mp4",
     "libx264",
     EVEN_BT709,
     {"-preset", "veryfast", "-crf", "18", "-movflags", FRAGMENTS, "-frag_duration", "1000000", MARK_BT709}},
    {"webm",
     "libvpx-vp9",
     EVEN_BT709,
     {"-deadline", "realtime", "-cpu-used", "8", "-crf", "24", "-b:v", "0", "-cluster_time_limit", "1000",
      MARK_BT709}},
    {"gif",
     "gif",
     "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=sierra2_4a",
     {"-loop", "0"}},
};

static const struct kind *kind_of(const char *path)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (file_has_extension(path, kinds[i].extension))
            return &kinds[i];
    return NULL;
}

/* Makes an empty file NAME.N.EXTENSION beside NAME.EXTENSION. open() gives it the user's usual permissions,
 * which mkstemps() would not. */
static enum status make_temporary(struct movie *movie, struct error *err)
{
    size_t size = strlen(movie->target) + 32;
    int stem = (int)(strrchr(movie->target, '.') - movie->target);
    movie->temporary = malloc(size);
    if (!movie->temporary)
        return error_no_memory(err, movie->target);
    for (int i = 0; i < TEMPORARY_TRIES; i++) {
        snprintf(movie->temporary, size, "%.*s.%d-%d%s", stem, movie->target, (int)getpid(), i,
                 movie->target + stem);
        int descriptor = open(movie->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            close(descriptor);
            return STATUS_OK;
        }
        if (errno != EEXIST)
            break;
    }
    error_set_errno(err, movie->target, "create");
    free(movie->temporary);
    movie->temporary = NULL;
    return STATUS_FILE;
}

/* The arguments; texts that are made here lie in `size`, `rate` and `output`. No shell reads them, and the
 * prefix keeps ffmpeg from taking a file's name for an option or an address. Without -xerror it is content
 * with what a full disk has room for. */
static void list_arguments(const struct kind *kind, const char *size, const char *rate, const char *output,
                           const char *list[ARGUMENTS_MAX])
{
    const char *const begin[] = {
        "ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin",   "-xerror", "-y",
        "-f",     "rawvideo",     "-pix_fmt",  "rgb24", "-s",         size,      "-framerate",
        rate,     "-i",           "pipe:0",    "-vf",   kind->filter, "-c:v",    kind->encoder};
    size_t count = sizeof begin / sizeof *begin;
    memcpy(list, begin, sizeof begin);
    for (size_t i = 0; i < sizeof kind->options / sizeof *kind->options && kind->options[i]; i++)
        list[count++] = kind->options[i];
    list[count++] = output;
    list[count] = NULL;
}

/* Runs ffmpeg with `input` as standard input, what it says going to `output`, and signals as usual even
 * where this thread blocks them. It gets a process group of its own: Ctrl-C is ours to answer, and ffmpeg
 * completes its file when the pipe ends. Returns an errno; *child is 0 then. */
static int spawn(const char *const *arguments, int input, int output, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, pipe_only;
    sigemptyset(&none);
    sigemptyset(&pipe_only);
    sigaddset(&pipe_only, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &pipe_only);
    int problem = posix_spawnp(child, "ffmpeg", &actions, &attributes, (char *const *)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (problem)
        *child = 0;
    return problem;
}

/* True when it was content. */
static bool wait_for(pid_t child)
{
    int result = 0;
    pid_t ended;
    do
        ended = waitpid(child, &result, 0);
    while (ended < 0 && errno == EINTR);
    return ended == child && WIFEXITED(result) && WEXITSTATUS(result) == 0;
}

/* What ffmpeg says of its encoders, for free(); NULL where it says nothing. */
static char *list_encoders(void)
{
    static const char *const arguments[] = {"ffmpeg", "-hide_banner", "-encoders", NULL};
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC), said = memfd_create("ffmpeg", MFD_CLOEXEC);
    char *text = NULL;
    pid_t child;
    if (nothing >= 0 && said >= 0 && !spawn(arguments, nothing, said, &child) && wait_for(child)) {
        const off_t size = lseek(said, 0, SEEK_END);
        text = malloc((size_t)size + 1);
        const ssize_t got = text ? pread(said, text, (size_t)size, 0) : 0;
        if (text)
            text[got > 0 ? got : 0] = '\0';
    }
    if (nothing >= 0)
        close(nothing);
    if (said >= 0)
        close(said);
    return text;
}

/* False only where ffmpeg lists its encoders and this one is not among them. */
static bool may_encode(const struct kind *kind)
{
    char *list = list_encoders(), word[32];
    snprintf(word, sizeof word, " %s ", kind->encoder);
    const bool lacks = list && strstr(list, "Encoders:") && !strstr(list, word);
    free(list);
    return !lacks;
}

enum status movie_check(const char *path, struct error *err)
{
    if (!kind_of(path))
        return error_set(err, STATUS_USAGE, "%s: a movie's name must end in .mp4, .webm or .gif", path);
    const enum status status = file_out_check(path, err);
    if (status)
        return status;
    if (!file_program_exists("ffmpeg"))
        return error_set(err, STATUS_RESOURCE,
                         "%s: the program ffmpeg is needed for movies and is not installed; on Debian: "
                         "apt install ffmpeg",
                         path);
    if (!may_encode(kind_of(path)))
        return error_set(err, STATUS_RESOURCE,
                         "%s: the ffmpeg that is installed lacks the encoder %s; take another ending of "
                         ".mp4, .webm and .gif, or an ffmpeg with it",
                         path, kind_of(path)->encoder);
    return STATUS_OK;
}

enum status movie_check_size(const char *path, int width, int height, struct error *err)
{
    /* libavutil/imgutils.c, av_image_check_size2(): room for 8 bytes a pixel and a margin */
    const int most = INT_MAX / (8 * (width + 128)) - 128;
    if (width < 2 || height < 2)
        return error_set(err, STATUS_RANGE, "%s: a movie needs pictures of at least 2 x 2, not %d x %d", path,
                         width, height);
    if (height > most)
        return error_set(err, STATUS_RANGE, "%s: ffmpeg takes pictures of %d x %d at most, not %d x %d", path,
                         width, most, width, height);
    return STATUS_OK;
}

static enum status start_ffmpeg(struct movie *movie, double rate, struct error *err)
{
    char size[32], rate_text[32];
    const char *arguments[ARGUMENTS_MAX];
    int ends[2];
    char *output = NULL;
    movie->messages = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (movie->messages < 0 || asprintf(&output, "file:%s", movie->temporary) < 0)
        return error_no_memory(err, movie->target);
    if (pipe2(ends, O_CLOEXEC)) {
        free(output);
        return error_set_errno(err, movie->target, "open a pipe for");
    }
    snprintf(size, sizeof size, "%dx%d", movie->width, movie->height);
    snprintf(rate_text, sizeof rate_text, "%.6f", rate);
    list_arguments(kind_of(movie->target), size, rate_text, output, arguments);
    int problem = spawn(arguments, ends[0], movie->messages, &movie->ffmpeg);
    free(output);
    close(ends[0]);
    movie->pipe = ends[1];
    if (!problem)
        return STATUS_OK;
    errno = problem;
    return error_set_errno(err, movie->target, "start ffmpeg for");
}

enum status movie_open(const char *path, int width, int height, double rate, struct movie **result,
                       struct error *err)
{
    enum status status = movie_check_size(path, width, height, err);
    if (status)
        return status;
    if (!(rate > 0) || !(rate <= 1000))
        return error_set(err, STATUS_RANGE, "%s: %g pictures a second are not possible; 0 to 1000 are", path,
                         rate);
    struct movie *movie = calloc(1, sizeof *movie);
    if (!movie)
        return error_no_memory(err, path);
    *movie = (struct movie){.pipe = -1, .messages = -1, .width = width, .height = height};
    char *resolved = realpath(path, NULL); /* a link is followed, if what it leads to has the extension too */
    if (resolved && !kind_of(resolved)) {
        free(resolved);
        resolved = NULL;
    }
    movie->target = resolved ? resolved : strdup(path);
    status = movie->target ? make_temporary(movie, err) : error_no_memory(err, path);
    if (!status)
        status = start_ffmpeg(movie, rate, err);
    if (status) {
        movie_abandon(movie);
        return status;
    }
    *result = movie;
    return STATUS_OK;
}

/* The first line that ffmpeg wrote, of which all others came, without the "[part @ address]" that say so; or
 * "no reason given". */
static const char *first_message(const struct movie *movie, char *text, size_t size)
{
    const ssize_t got = pread(movie->messages, text, size - 1, 0);
    text[got > 0 ? got : 0] = '\0';
    char *line = text + strspn(text, "\r\n");
    while (*line == '[' && strstr(line, "] "))
        line = strstr(line, "] ") + 2;
    line[strcspn(line, "\r\n")] = '\0';
    return *line ? line : "no reason given";
}

/* Closes the pipe and waits. True when ffmpeg was content. */
static bool finish_ffmpeg(struct movie *movie)
{
    const pid_t child = movie->ffmpeg;
    if (movie->pipe >= 0)
        close(movie->pipe);
    movie->pipe = -1;
    movie->ffmpeg = 0;
    return child && wait_for(child);
}

static enum status ffmpeg_failed(const struct movie *movie, struct error *err)
{
    char text[512];
    return error_set(err, STATUS_FILE, "%s: ffmpeg failed: %s", movie->target,
                     first_message(movie, text, sizeof text));
}

/* write() of everything, without the signal that a closed pipe sends. */
static bool write_all(int descriptor, const unsigned char *data, size_t size)
{
    sigset_t pipe_only, before;
    sigemptyset(&pipe_only);
    sigaddset(&pipe_only, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_only, &before);
    bool good = true;
    while (size && good) {
        ssize_t wrote = write(descriptor, data, size);
        good = wrote >= 0 || errno == EINTR;
        if (wrote > 0) {
            data += wrote;
            size -= (size_t)wrote;
        }
    }
    if (!good && errno == EPIPE && !sigismember(&before, SIGPIPE)) {
        const struct timespec at_once = {0};
        sigtimedwait(&pipe_only, NULL, &at_once);
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return good;
}

enum status movie_add(struct movie *movie, const struct image *image, struct error *err)
{
    if (image->width != movie->width || image->height != movie->height)
        return error_set(err, STATUS_RANGE, "%s: a picture of %d x %d in a movie of %d x %d", movie->target,
                         image->width, image->height, movie->width, movie->height);
    if (write_all(movie->pipe, image->rgb, 3 * (size_t)image->width * (size_t)image->height))
        return STATUS_OK;
    finish_ffmpeg(movie);
    return ffmpeg_failed(movie, err);
}

static enum status put_in_place(struct movie *movie, struct error *err)
{
    int descriptor = open(movie->temporary, O_RDONLY | O_CLOEXEC);
    bool synced = descriptor >= 0 && !fsync(descriptor);
    if (!synced)
        error_set_errno(err, movie->target, "write");
    if (descriptor >= 0)
        close(descriptor);
    if (!synced)
        return STATUS_FILE;
    if (rename(movie->temporary, movie->target))
        return error_set_errno(err, movie->target, "replace");
    file_sync_folder_of(movie->target);
    free(movie->temporary);
    movie->temporary = NULL;
    return STATUS_OK;
}

enum status movie_commit(struct movie *movie, struct error *err)
{
    enum status status = finish_ffmpeg(movie) ? put_in_place(movie, err) : ffmpeg_failed(movie, err);
    movie_abandon(movie);
    return status;
}

void movie_abandon(struct movie *movie)
{
    if (!movie)
        return;
    if (movie->ffmpeg)
        kill(movie->ffmpeg, SIGKILL);
    finish_ffmpeg(movie);
    if (movie->temporary)
        unlink(movie->temporary);
    if (movie->messages >= 0)
        close(movie->messages);
    free(movie->temporary);
    free(movie->target);
    free(movie);
}
