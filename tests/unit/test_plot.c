/* Plots: what is drawn, what is left out, and what is said where it cannot be. */
#include "check.h"
#include "common/file.h"
#include "common/plot.h"
#include "common/plot_script.h"
#include "folder.h"
#include "support/slowdown.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

static const double x[] = {0.1, 0.01, 0.001, (double)NAN}, y[] = {1, 4, -2, 16};
static const char *const label[] = {"1/4", "it's", "a \"b\" \\c\n", "d"};

static enum status save(enum plot_style style, const char *path, struct error *err)
{
    const struct plot_series series[] = {
        {.name = "first's", .style = style, .x = x, .y = y, .label = label, .count = 4},
        {.style = style, .x = x, .y = y, .count = 4, .colour = PLOT_BLACK, .mark = PLOT_RING}};
    const struct plot_panel panels[] = {{.title = "one",
                                         .x_label = "error",
                                         .y_label = "seconds",
                                         .log_x = true,
                                         .log_y = true,
                                         .series = series,
                                         .series_count = 2},
                                        {.log_x = true, .log_y = true, .key_outside = true}};
    const struct plot plot = {.title = "it's a 'title'", .panels = panels, .panel_count = 2, .columns = 2};
    return plot_save(&plot, path, err);
}

static bool installed(void)
{
    struct error err = {0};
    if (plot_check("a.png", &err) == STATUS_OK)
        return true;
    print_message("# skipped, nothing was drawn: %s\n", err.text);
    return false;
}

static void every_style_is_drawn_as_png_and_svg_whatever_the_points_and_texts(void **state)
{
    (void)state;
    struct error err = {0};
    for (int style = PLOT_LINE; installed() && style <= PLOT_BARS; style++) {
        struct bytes bytes = {0};
        assert_ok(save((enum plot_style)style, "a.png", &err), &err);
        assert_ok(file_read("a.png", &bytes, &err), &err);
        assert_memory_equal(bytes.data, "\x89PNG", 4);
        bytes_clear(&bytes);
        assert_ok(save((enum plot_style)style, "a.svg", &err), &err);
        assert_ok(file_read("a.svg", &bytes, &err), &err);
        assert_non_null(strstr((const char *)bytes.data, "</svg>"));
        bytes_clear(&bytes);
    }
}

static void a_count_is_drawn_from_nothing_up_in_whole_steps(void **state)
{
    (void)state;
    if (!installed())
        return;
    struct error err = {0};
    struct bytes bytes = {0};
    const double time[] = {10, 20}, pieces[] = {1, 2};
    const struct plot_series series = {.style = PLOT_LINE, .x = time, .y = pieces, .count = 2};
    const struct plot_panel panel = {.from_zero = true, .whole = true, .series = &series, .series_count = 1};
    assert_ok(plot_save(&(struct plot){.panels = &panel, .panel_count = 1, .columns = 1}, "a.svg", &err),
              &err);
    assert_ok(file_read("a.svg", &bytes, &err), &err);
    assert_non_null(strstr((const char *)bytes.data, ">0<"));
    assert_non_null(strstr((const char *)bytes.data, ">1<"));
    assert_null(strstr((const char *)bytes.data, "1.5<"));
    bytes_clear(&bytes);
}

static bool script_has(const struct plot_panel *panel, const char *words)
{
    char *script = NULL;
    size_t size;
    FILE *file = open_memstream(&script, &size);
    assert_non_null(file);
    plot_write_script(&(struct plot){.panels = panel, .panel_count = 1, .columns = 1}, true, file);
    fclose(file);
    const bool found = strstr(script, words);
    free(script);
    return found;
}

/* An energy of -1e-12 at rest is none: no axis goes down to -20000 for it. */
static void round_off_below_nothing_is_nothing(void **state)
{
    (void)state;
    double energy[] = {-1e-12, 1e5};
    const struct plot_series series = {.style = PLOT_LINE, .x = x, .y = energy, .count = 2};
    const struct plot_panel panel = {.from_zero = true, .series = &series, .series_count = 1};
    assert_true(script_has(&panel, "set yrange [0:*]"));
    energy[0] = -1;
    assert_false(script_has(&panel, "set yrange [0:*]"));
}

/* A file's name may be of any bytes; an SVG with such is none. */
static void what_is_no_utf_8_is_shown_so(void **state)
{
    (void)state;
    const char *const names[] = {"caf\xE9 \xC3\xA9", "\xE2\x82", "\xE2\x82\xAC"};
    const struct plot_series series = {.style = PLOT_BARS, .y = y, .label = names, .count = 2};
    const struct plot_panel panel = {
        .title = names[0], .x_label = names[2], .series = &series, .series_count = 1};
    assert_true(script_has(&panel, "'caf? \xC3\xA9'"));
    assert_true(script_has(&panel, "\"caf? \xC3\xA9\""));
    assert_true(script_has(&panel, "\"??\""));
    assert_true(script_has(&panel, names[2]));
}

/* A key inside takes the upper right corner, where lines end that rise. */
static void no_key_and_no_label_covers_what_is_drawn(void **state)
{
    (void)state;
    struct plot_series series = {.name = "a", .style = PLOT_LINE, .x = x, .y = y, .count = 2};
    struct plot_panel panel = {.series = &series, .series_count = 1};
    const char *room = "set offsets 0, 0, graph 0.3, ", *below = "with labels right offset -0.8,-0.5 ";
    assert_true(script_has(&panel, room));
    panel.key_outside = true;
    assert_false(script_has(&panel, room));
    series.name = NULL;
    panel.key_outside = false;
    assert_false(script_has(&panel, room));

    series.style = PLOT_CURVE;
    series.label = label;
    assert_false(script_has(&panel, below));
    series.labels_below = true;
    assert_true(script_has(&panel, below));
}

/* Two powers of ten are on each, and no third that has nothing to show. */
static void logarithmic_axes_end_near_what_is_drawn(void **state)
{
    (void)state;
    const double error[] = {0.02, 0.03}, seconds[] = {0.002, 0.9};
    const struct plot_series series[] = {
        {.name = "a", .style = PLOT_CURVE, .x = error, .y = seconds, .label = label, .count = 2},
        {.name = "b", .style = PLOT_CURVE, .x = error, .y = seconds, .count = 2}};
    const struct plot_panel panel = {
        .log_x = true, .log_y = true, .series = series, .series_count = 2, .key_outside = true};
    char *script = NULL;
    size_t size;
    FILE *file = open_memstream(&script, &size);
    plot_write_script(&(struct plot){.panels = &panel, .panel_count = 1, .columns = 1}, true, file);
    fclose(file);
    double low, high;
    assert_int_equal(sscanf(strstr(script, "set xrange"), "set xrange [%lf:%lf]", &low, &high), 2);
    assert_near(low, 0.01, 1e-12);
    assert_near(high, 0.1, 1e-12);
    assert_int_equal(sscanf(strstr(script, "set yrange [0"), "set yrange [%lf:%lf]", &low, &high), 2);
    assert_true(low > 0.001 && low < 0.002 && high > 0.9 && high < 2);
    /* a label lies over the lines of all curves */
    assert_true(strstr(script, "with labels") > strstr(script, "$series1 using"));
    free(script);
}

/* Saves by a script that stands in for gnuplot; NULL: without one. */
static enum status save_by(const char *script, const char *path, struct error *err)
{
    char *usual = strdup(getenv("PATH"));
    if (script) {
        write_text("gnuplot", script);
        assert_int_equal(chmod("gnuplot", 0755), 0);
    }
    setenv("PATH", script ? test_folder : "/nowhere", 1);
    const enum status status = save(PLOT_CURVE, path, err);
    setenv("PATH", usual, 1);
    free(usual);
    return status;
}

static void without_gnuplot_the_message_says_how_to_get_it_and_the_old_file_stays(void **state)
{
    (void)state;
    struct error err = {0};
    write_text("old.png", "old");
    assert_refused(save_by(NULL, "old.png", &err), STATUS_RESOURCE, "apt install gnuplot", &err);
    assert_refused(
        save_by("#!/bin/sh\necho '     ^' >&2\necho 'line 1: bad weather' >&2\nexit 3\n", "old.png", &err),
        STATUS_RESOURCE, "gnuplot failed: line 1: bad weather", &err);
    if (slowdown() == 1) /* valgrind does not get over a program that cannot be started */
        assert_refused(save_by("#!/no/such/shell\n", "old.png", &err), STATUS_FILE,
                       "old.png: cannot start gnuplot for: No such file", &err);
    struct bytes bytes = {0};
    assert_ok(file_read("old.png", &bytes, &err), &err);
    assert_int_equal(bytes.size, 3);
    bytes_clear(&bytes);
}

/* Also in memory, where gnuplot's picture and its script are at first, and gnuplot says nothing of it. */
static void a_limit_on_the_size_of_files_is_told_as_the_reason(void **state)
{
    (void)state;
    struct error err = {0};
    struct rlimit usual;
    struct bytes bytes = {0};
    signal(SIGXFSZ, SIG_IGN);
    write_text("old.svg", "old");
    getrlimit(RLIMIT_FSIZE, &usual);
    for (rlim_t most = 100; most <= 20000; most *= 200) {
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){most, usual.rlim_max});
        const enum status status = save_by("#!/bin/sh\nprintf %30000d 1\nexit 0\n", "old.svg", &err);
        setrlimit(RLIMIT_FSIZE, &usual);
        assert_refused(status, STATUS_FILE, "old.svg: cannot write: File too large", &err);
    }
    assert_ok(file_read("old.svg", &bytes, &err), &err);
    assert_string_equal((const char *)bytes.data, "old");
    bytes_clear(&bytes);
}

static void note_signal(int number)
{
    (void)number;
}

/* As when the window's size changes, or a timer of the caller's own runs out. */
static void a_signal_while_gnuplot_draws_is_no_failure(void **state)
{
    (void)state;
    struct error err = {0};
    struct bytes bytes = {0};
    struct sigaction before, action = {.sa_handler = note_signal};
    sigaction(SIGALRM, &action, &before);
    assert_ok(
        save_by("#!/bin/sh\n/bin/sleep 0.1\nkill -ALRM $PPID\n/bin/sleep 0.1\necho drawn\n", "a.svg", &err),
        &err);
    sigaction(SIGALRM, &before, NULL);
    assert_ok(file_read("a.svg", &bytes, &err), &err);
    assert_string_equal((const char *)bytes.data, "drawn\n");
    bytes_clear(&bytes);
}

static void other_extensions_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    assert_refused(save(PLOT_CURVE, "a.pdf", &err), STATUS_USAGE, ".png or .svg", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_style_is_drawn_as_png_and_svg_whatever_the_points_and_texts),
        cmocka_unit_test(a_count_is_drawn_from_nothing_up_in_whole_steps),
        cmocka_unit_test(what_is_no_utf_8_is_shown_so),
        cmocka_unit_test(no_key_and_no_label_covers_what_is_drawn),
        cmocka_unit_test(round_off_below_nothing_is_nothing),
        cmocka_unit_test(logarithmic_axes_end_near_what_is_drawn),
        cmocka_unit_test(without_gnuplot_the_message_says_how_to_get_it_and_the_old_file_stays),
        cmocka_unit_test(a_limit_on_the_size_of_files_is_told_as_the_reason),
        cmocka_unit_test(a_signal_while_gnuplot_draws_is_no_failure),
        cmocka_unit_test(other_extensions_are_refused),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
