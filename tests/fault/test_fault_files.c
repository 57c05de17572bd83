/* Pipes and plots where memory ends and files fail. */
#include "common/plot.h"
#include "faulty.h"

#include <sys/stat.h>
#include <sys/wait.h>

/* A pipe does not tell its length: what was read so far has to grow. */
static void a_pipe_is_read_whole_or_not_at_all(void **state)
{
    (void)state;
    enum { SIZE = 300000 };
    static char text[SIZE];
    assert_int_equal(mkfifo("pipe", 0600), 0);
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        struct error err = {0};
        struct bytes bytes = {0};
        const pid_t writer = fork();
        if (writer == 0) { /* ends by a signal where nobody reads on */
            FILE *stream = fopen("pipe", "w");
            fwrite(text, 1, SIZE, stream);
            fclose(stream);
            _exit(0);
        }
        fault_begin(&fault);
        const enum status status = file_read("pipe", &bytes, &err);
        fault_end(&fault);
        assert_int_equal(waitpid(writer, NULL, 0), writer);
        assert_true(fault.failed || !status);
        assert_says(status, &err, fault.kinds);
        assert_int_equal(bytes.size, status ? 0 : SIZE);
        bytes_clear(&bytes);
    }
    unlink("pipe");
}

/* By a script that stands in for gnuplot. */
static enum status save_plot(struct error *err)
{
    static const double values[] = {1, 2, 3};
    const struct plot_series series = {.name = "s", .style = PLOT_LINE, .x = values, .y = values, .count = 3};
    const struct plot_panel panel = {.series = &series, .series_count = 1};
    return plot_save(&(struct plot){.panels = &panel, .panel_count = 1, .columns = 1}, "a.svg", err);
}

/* The script for gnuplot is kept in memory, so that a failure there says that memory ended. What
 * is written has no name at first, or a temporary one where the file system knows no others. */
static void a_plot_is_saved_whole_or_the_old_one_stays(void **state)
{
    (void)state;
    const struct bytes old = {(unsigned char *)"old", 3}, drawn = {(unsigned char *)"drawn\n", 6};
    char *usual = strdup(getenv("PATH"));
    write_text("gnuplot", "#!/bin/sh\necho drawn\n");
    assert_int_equal(chmod("gnuplot", 0755), 0);
    setenv("PATH", test_folder, 1);
    for (int i = 0; i < 4; i++)
        for (struct fault fault = {.kinds = fault_kinds[i % 2], .all_named = i >= 2}; fault_next(&fault);) {
            struct error err = {0};
            write_bytes("a.svg", old.data, old.size);
            fault_begin(&fault);
            const enum status status = save_plot(&err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_true(!status || status == STATUS_NO_MEMORY || (i % 2 == 1 && status == STATUS_FILE));
            assert_true(!status || strstr(err.text, "a.svg"));
            assert_holds("a.svg", status ? &old : &drawn);
            assert_int_equal(files_here(), 2);
        }
    setenv("PATH", usual, 1);
    free(usual);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pipe_is_read_whole_or_not_at_all),
        cmocka_unit_test(a_plot_is_saved_whole_or_the_old_one_stays),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
