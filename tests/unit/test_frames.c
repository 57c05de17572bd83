/* What becomes of a run's pictures: PNGs, movies, and what is said when they cannot be. */
#include "films.h"
#include "render/frames.h"

#include <png.h>

/* Picture n: n red, x green, y blue. */
static void paint(struct image *image, int n)
{
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            unsigned char *rgb = image->rgb + 3 * (y * image->width + x);
            rgb[0] = (unsigned char)n;
            rgb[1] = (unsigned char)x;
            rgb[2] = (unsigned char)y;
        }
}

static void assert_png_shows(const char *path, const struct image *image)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&png, path));
    png.format = PNG_FORMAT_RGB;
    assert_int_equal(png.width, image->width);
    assert_int_equal(png.height, image->height);
    unsigned char *rgb = malloc(PNG_IMAGE_SIZE(png));
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
    assert_memory_equal(rgb, image->rgb, PNG_IMAGE_SIZE(png));
    free(rgb);
}

static void assert_file_has(const char *path, const char *bytes, size_t size)
{
    struct error err;
    struct bytes file = {0};
    assert_ok(file_read(path, &file, &err), &err);
    assert_non_null(memmem(file.data, file.size, bytes, size));
    bytes_clear(&file);
}

static void run(const struct frames_options *options, int width, int height, int count)
{
    struct error err = {0};
    struct frames *frames;
    struct image image = a_picture(width, height);
    assert_ok(frames_open(options, &frames, &err), &err);
    for (int n = 0; n < count; n++) {
        paint(&image, n);
        assert_ok(frames_add(frames, &image, n / 8.0, &err), &err);
    }
    assert_ok(frames_close(frames, &err), &err);
    image_clear(&image);
}

static void a_png_holds_the_picture_and_its_texts(void **state)
{
    (void)state;
    struct error err;
    struct image image = a_picture(70, 50);
    const struct image_text texts[] = {{"Title", "fox"}, {"Comment", "caf\xc3\xa9"}};
    paint(&image, 9);
    assert_ok(image_save_png(&image, "a.png", texts, 2, &err), &err);
    assert_png_shows("a.png", &image);
    assert_file_has("a.png", "tEXtTitle\0fox", 13);
    assert_file_has("a.png", "iTXtComment\0", 12);
    assert_file_has("a.png", "caf\xc3\xa9", 5);
    image_clear(&image);
}

static void a_png_that_cannot_be_written_says_why(void **state)
{
    (void)state;
    struct error err;
    struct image image = a_picture(300, 300);
    assert_refused(image_save_png(&image, "/dev/full", NULL, 0, &err), STATUS_FILE,
                   "/dev/full: cannot write: No space left", &err);
    assert_refused(image_save_png(&image, "no/a.png", NULL, 0, &err), STATUS_FILE, "no/a.png: cannot create",
                   &err);
    const struct image_text empty = {"", "a key must not be empty"};
    assert_refused(image_save_png(&image, "b.png", &empty, 1, &err), STATUS_FILE, "b.png: ", &err);
    assert_int_equal(names_like("*"), 0);
    image_clear(&image);
}

static void frames_are_numbered_in_order_and_carry_their_time(void **state)
{
    (void)state;
    for (int workers = 1; workers < 4; workers += 2) {
        run(&(struct frames_options){.folder = "f", .workers = workers}, 40, 30, 60);
        struct image wanted = a_picture(40, 30);
        for (int n = 0; n < 60; n++) {
            char path[64];
            snprintf(path, sizeof path, "f/frame_%04d.png", n);
            paint(&wanted, n);
            assert_png_shows(path, &wanted);
        }
        assert_file_has("f/frame_0003.png", "tEXtTime\0000.375", 14);
        assert_int_equal(names_like("f/*"), 60);
        image_clear(&wanted);
    }
}

static void a_folder_that_cannot_be_is_refused_at_once(void **state)
{
    (void)state;
    struct error err;
    struct frames *frames;
    write_text("f", "a file", 0644);
    struct frames_options options = {.folder = "f"};
    assert_refused(frames_open(&options, &frames, &err), STATUS_FILE, "f: is a file", &err);
    assert_contents("f", "a file");
    options.folder = "no/such";
    assert_refused(frames_open(&options, &frames, &err), STATUS_FILE, "no/such: cannot make the folder",
                   &err);
    options = (struct frames_options){.sheet = "no/sheet.png"};
    assert_refused(frames_open(&options, &frames, &err), STATUS_FILE, "no/sheet.png: cannot create", &err);
    assert_int_equal(names_like("*"), 1);
}

static void a_failure_while_writing_comes_back_and_ends_the_writing(void **state)
{
    (void)state;
    struct error err = {0};
    struct frames *frames;
    struct image image = a_picture(20, 20);
    assert_ok(frames_open(&(struct frames_options){.folder = "f"}, &frames, &err), &err);
    rmdir("f");
    enum status status = STATUS_OK;
    for (int n = 0; n < 1000 && !status; n++)
        status = frames_add(frames, &image, n, &err);
    assert_int_equal(status, STATUS_FILE);
    mkdir("f", 0777);
    assert_refused(frames_add(frames, &image, 1001, &err), STATUS_FILE, "f/frame_0", &err);
    assert_refused(frames_close(frames, &err), STATUS_FILE, "cannot create: No such file", &err);
    assert_int_equal(names_like("f/*"), 0);
    image_clear(&image);
}

static void frames_of_another_size_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct frames *frames;
    struct image one = a_picture(20, 20), other = a_picture(20, 21);
    assert_ok(frames_open(&(struct frames_options){.folder = "f"}, &frames, &err), &err);
    assert_ok(frames_add(frames, &one, 0, &err), &err);
    assert_refused(frames_add(frames, &other, 1, &err), STATUS_RANGE, "20 x 21 follows one of 20 x 20", &err);
    assert_refused(frames_close(frames, &err), STATUS_RANGE, "20 x 21", &err);
    assert_png_shows("f/frame_0000.png", &one);
    image_clear(&one);
    image_clear(&other);
}

static void nothing_asked_for_and_nothing_added_is_fine(void **state)
{
    (void)state;
    run(&(struct frames_options){0}, 8, 8, 40);
    run(&(struct frames_options){.folder = "f", .sheet = "s.png"}, 8, 8, 0);
    assert_int_equal(names_like("*"), 1);
}

/* An ffmpeg that is slow to begin: what fits neither the pipe (64 KiB) nor the queue must wait for it, though
 * the PNGs are long written. */
static void ffmpeg_gets_every_picture_in_order(void **state)
{
    (void)state;
    enum { WIDTH = 60, HEIGHT = 40, SIZE = 3 * WIDTH * HEIGHT };
    pretend_ffmpeg("sleep 0.2; cat >\"$output\"; echo \"$@\" >arguments");
    run(&(struct frames_options){.movie = "a movie.mp4", .folder = "f", .rate = 12.5}, WIDTH, HEIGHT, 50);
    struct error err;
    struct bytes movie = {0};
    struct image wanted = a_picture(WIDTH, HEIGHT);
    assert_ok(file_read("a movie.mp4", &movie, &err), &err);
    assert_int_equal(movie.size, 50 * SIZE);
    for (int n = 0; n < 50; n++) {
        paint(&wanted, n);
        assert_memory_equal(movie.data + SIZE * n, wanted.rgb, SIZE);
    }
    assert_file_has("arguments", "-s 60x40 -framerate 12.500000 ", 30);
    assert_int_equal(names_like("f/*"), 50);
    assert_int_equal(names_like("*.mp4"), 1);
    bytes_clear(&movie);
    image_clear(&wanted);
}

/* Enough pictures to fill a pipe (64 KiB) many times over: the writer meets its closed end. */
static void a_movie_that_fails_leaves_the_old_one_and_no_other(void **state)
{
    (void)state;
    const char *const scripts[] = {"echo 'no such codec' >&2; echo last >&2; exit 1",
                                   "head -c 5000 >\"$output\"; echo 'no such codec' >&2; exit 1",
                                   "cat >\"$output\"; echo 'no such codec' >&2; exit 1"};
    for (int i = 0; i < 3; i++) {
        struct error err = {0};
        struct frames *frames;
        struct image image = a_picture(100, 100);
        pretend_ffmpeg(scripts[i]);
        write_text("m.webm", "old", 0644);
        assert_ok(frames_open(&(struct frames_options){.movie = "m.webm"}, &frames, &err), &err);
        for (int n = 0; n < 50; n++)
            frames_add(frames, &image, n, &err);
        assert_refused(frames_close(frames, &err), STATUS_FILE, "m.webm: ffmpeg failed: no such codec", &err);
        assert_contents("m.webm", "old");
        assert_int_equal(names_like("m*"), 1);
        image_clear(&image);
    }
}

static void a_missing_ffmpeg_is_named_with_its_package(void **state)
{
    (void)state;
    struct error err;
    struct frames *frames;
    setenv("PATH", folder, 1);
    struct frames_options options = {.movie = "m.mp4", .folder = "f"};
    assert_refused(frames_open(&options, &frames, &err), STATUS_RESOURCE, "apt install ffmpeg", &err);
    assert_int_equal(names_like("*"), 0);
}

/* ffmpeg tells by the extension what to write, so the link itself is replaced. */
static void a_link_to_a_file_that_is_no_movie_is_not_followed(void **state)
{
    (void)state;
    pretend_ffmpeg("exec cat >\"$output\"");
    write_text("notes.txt", "notes", 0644);
    assert_int_equal(symlink("notes.txt", "m.gif"), 0);
    run(&(struct frames_options){.movie = "m.gif"}, 10, 10, 2);
    struct stat info;
    assert_contents("notes.txt", "notes");
    assert_int_equal(lstat("m.gif", &info), 0);
    assert_true(S_ISREG(info.st_mode));
    assert_int_equal(info.st_size, 2 * 300);
}

/* What `ffprobe` says about a movie's first stream. */
static void probe(const char *path, char *text, size_t size)
{
    char command[256];
    snprintf(command, sizeof command,
             "ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 %s",
             path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    if (!fgets(text, (int)size, pipe))
        text[0] = '\0';
    pclose(pipe);
    text[strcspn(text, "\n")] = '\0';
}

static void real_movies_have_every_picture_and_even_sides(void **state)
{
    (void)state;
    if (system("command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null")) {
        print_message("# skipped, no real movie is made: ffmpeg and ffprobe are not installed\n");
        return;
    }
    const char *const names[] = {"m.mp4", "m.webm", "m.gif"};
    const char *const wanted[] = {"96,64,25", "96,64,25", "97,65,25"};
    for (int i = 0; i < 3; i++) {
        char text[256];
        run(&(struct frames_options){.movie = names[i]}, 97, 65, 25);
        probe(names[i], text, sizeof text);
        assert_string_equal(text, wanted[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_png_holds_the_picture_and_its_texts, empty_folder),
        cmocka_unit_test_setup(a_png_that_cannot_be_written_says_why, empty_folder),
        cmocka_unit_test_setup(frames_are_numbered_in_order_and_carry_their_time, empty_folder),
        cmocka_unit_test_setup(a_folder_that_cannot_be_is_refused_at_once, empty_folder),
        cmocka_unit_test_setup(a_failure_while_writing_comes_back_and_ends_the_writing, empty_folder),
        cmocka_unit_test_setup(frames_of_another_size_are_refused, empty_folder),
        cmocka_unit_test_setup(nothing_asked_for_and_nothing_added_is_fine, empty_folder),
        cmocka_unit_test_setup(ffmpeg_gets_every_picture_in_order, empty_folder),
        cmocka_unit_test_setup(a_movie_that_fails_leaves_the_old_one_and_no_other, empty_folder),
        cmocka_unit_test_setup(a_missing_ffmpeg_is_named_with_its_package, empty_folder),
        cmocka_unit_test_setup(a_link_to_a_file_that_is_no_movie_is_not_followed, empty_folder),
        cmocka_unit_test_setup(real_movies_have_every_picture_and_even_sides, empty_folder),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
