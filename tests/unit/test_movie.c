/* One movie: its name, its pictures and its end. */
#include "films.h"
#include "render/movie.h"

static void movies_have_a_known_extension_and_are_no_folders(void **state)
{
    (void)state;
    struct error err;
    pretend_ffmpeg("exit 1");
    mkdir("d.mp4", 0777);
    assert_refused(movie_check("m.avi", &err), STATUS_USAGE, "m.avi: a movie's name must end in .mp4", &err);
    assert_refused(movie_check("mp4", &err), STATUS_USAGE, "must end in", &err);
    assert_refused(movie_check("d.mp4", &err), STATUS_FILE, "is a folder", &err);
    assert_ok(movie_check("M.GIF", &err), &err);
    struct movie *movie;
    assert_refused(movie_open("m.mp4", 1, 10, 30, &movie, &err), STATUS_RANGE, "not 1 x 10", &err);
    assert_refused(movie_open("m.mp4", 16384, 16129, 30, &movie, &err), STATUS_RANGE,
                   "m.mp4: ffmpeg takes pictures of 16384 x 16128 at most, not 16384 x 16129", &err);
    assert_ok(movie_check_size("m.mp4", 16384, 16128, &err), &err);
    assert_ok(movie_check_size("m.mp4", 16128, 16384, &err), &err);
    assert_refused(movie_open("m.mp4", 10, 10, 0, &movie, &err), STATUS_RANGE, "pictures a second", &err);
    assert_refused(movie_open("no/m.mp4", 10, 10, 9, &movie, &err), STATUS_FILE, "no/m.mp4: cannot create",
                   &err);
}

/* A caller whose signals are open, as those of the threads that write frames are not. */
static void ffmpegs_end_sends_no_signal_to_who_writes(void **state)
{
    (void)state;
    struct error err = {0};
    struct movie *movie;
    struct image image = a_picture(100, 100);
    /* the cause, with who says so in front, and then what comes of it */
    pretend_ffmpeg(
        "echo '[rawvideo @ 0x55] [IMGUTILS @ 0x7f] no such codec' >&2; echo 'pipe:0: Invalid argument' >&2; exit 1");
    assert_ok(movie_open("m.webm", 100, 100, 30, &movie, &err), &err);
    enum status status = STATUS_OK;
    for (int n = 0; n < 50 && !status; n++) /* a pipe holds two of these */
        status = movie_add(movie, &image, &err);
    assert_refused(status, STATUS_FILE, "m.webm: ffmpeg failed: no such codec", &err);
    movie_abandon(movie);
    image_clear(&image);
}

static void a_picture_of_another_size_is_not_for_the_movie(void **state)
{
    (void)state;
    struct error err = {0};
    struct movie *movie;
    struct image image = a_picture(10, 12);
    pretend_ffmpeg("exec cat >\"$output\"");
    assert_ok(movie_open("m.gif", 10, 10, 30, &movie, &err), &err);
    assert_refused(movie_add(movie, &image, &err), STATUS_RANGE,
                   "m.gif: a picture of 10 x 12 in a movie of 10 x 10", &err);
    movie_abandon(movie);
    image_clear(&image);
}

static void an_abandoned_movie_is_not_there(void **state)
{
    (void)state;
    struct error err;
    struct movie *movie;
    struct image image = a_picture(10, 10);
    pretend_ffmpeg("exec cat >\"$output\"");
    assert_ok(movie_open("m.gif", 10, 10, 30, &movie, &err), &err);
    assert_ok(movie_add(movie, &image, &err), &err);
    movie_abandon(movie);
    assert_int_equal(names_like("m*"), 0);
    image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(movies_have_a_known_extension_and_are_no_folders, empty_folder),
        cmocka_unit_test_setup(ffmpegs_end_sends_no_signal_to_who_writes, empty_folder),
        cmocka_unit_test_setup(a_picture_of_another_size_is_not_for_the_movie, empty_folder),
        cmocka_unit_test_setup(an_abandoned_movie_is_not_there, empty_folder),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
