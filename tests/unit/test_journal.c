/* Whatever happens to a program that keeps a journal, the work up to the last whole operation is there. */
#include "common/octree_chunks.h"
#include "common/random.h"
#include "folder.h"
#include "sculpt/chip_log.h"
#include "sculpt/journal.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

#define JOURNAL "a.oct.journal"
#define BASE    "a.oct.journal-base"

static void leave_nothing(void)
{
    unlink("a.oct");
    unlink(JOURNAL);
    unlink(BASE);
}

static struct octree cube(unsigned depth, unsigned material)
{
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, depth, material, &err), &err);
    return tree;
}

/* What a script makes of a cube of depth 4. */
static struct octree carved(const char *script)
{
    struct error err = {0};
    struct octree tree = cube(4, 1);
    struct chips chips = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_run(&tree, &chips, NULL, &err), &err);
    chips_clear(&chips);
    return tree;
}

static void save_carved(const char *script, const char *path)
{
    struct error err = {0};
    struct octree tree = carved(script);
    assert_ok(octree_save(&tree, path, &err), &err);
    octree_clear(&tree);
}

static struct journal *begin(void)
{
    struct error err = {0};
    struct journal *journal = NULL;
    struct octree start = cube(4, 1);
    assert_ok(journal_open("a.oct", &start, &journal, &err), &err);
    return journal;
}

static void append(struct journal *journal, const char *lines)
{
    struct error err = {0};
    assert_ok(journal_append(journal, lines, &err), &err);
}

/* The journal leads to what this script makes of a full cube. */
static struct journal_report assert_recovers(const char *script)
{
    struct error err = {0};
    struct octree tree = {0}, wanted = carved(script);
    struct journal_report report;
    assert_ok(journal_recover("a.oct", &tree, NULL, &report, &err), &err);
    assert_true(octree_equal(&tree, &wanted));
    octree_clear(&tree);
    octree_clear(&wanted);
    return report;
}

#define ONE   "chip sphere 0.25 0.25 0.25 0.2\n"
#define TWO   "mirror x\nheat 0.5 0.5 0.5 0.5\n"
#define THREE "material 7\nfill box 0.5 0.5 0.5 0.9 0.8 0.7\n"

static void a_new_cube_and_what_was_done_to_it_are_recovered(void **state)
{
    (void)state;
    leave_nothing();
    struct journal *journal = begin();
    append(journal, ONE);
    append(journal, TWO);
    append(journal, THREE);
    journal_close(journal, false);
    struct journal_report report = assert_recovers(ONE TWO THREE);
    assert_int_equal(report.operations, 5);
    assert_int_equal(report.lost_bytes, 0);
    assert_true(report.unsaved);
}

static void work_on_a_file_is_recovered_from_that_file(void **state)
{
    (void)state;
    leave_nothing();
    save_carved(ONE, "a.oct");
    struct journal *journal = begin();
    append(journal, TWO);
    journal_close(journal, false);
    assert_true(assert_recovers(ONE TWO).unsaved);
}

static void undo_of_steps_before_a_save_is_recovered(void **state)
{
    (void)state;
    leave_nothing();
    save_carved(ONE, "a.oct");
    struct error err = {0};
    struct journal *journal = begin();
    append(journal, TWO "step\n" THREE "step\n");
    assert_ok(journal_mark(journal, &err), &err);
    save_carved(ONE TWO THREE, "a.oct");
    append(journal, "undo\nundo\n");
    journal_close(journal, false);
    assert_true(assert_recovers(ONE).unsaved);
}

static void after_a_save_nothing_is_unsaved(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    struct journal *journal = begin();
    append(journal, ONE);
    assert_ok(journal_mark(journal, &err), &err);
    save_carved(ONE, "a.oct");
    journal_close(journal, false);
    assert_false(assert_recovers(ONE).unsaved);
}

static void the_chip_log_goes_on_through_a_recovery(void **state)
{
    (void)state;
    for (int with_file = 0; with_file < 2; with_file++) {
        leave_nothing();
        struct error err = {0};
        struct octree tree = carved(ONE);
        struct bytes log = {0};
        struct journal_report report;
        struct octree_chunks chunks = {0};
        bool holds;
        if (with_file) {
            log = (struct bytes){(unsigned char *)strdup("depth 4\n" ONE), strlen("depth 4\n" ONE)};
            assert_ok(octree_chunks_put(&chunks, OCTREE_CHUNK_LOG, &log, &err), &err);
            assert_ok(octree_save_with(&tree, &chunks, "a.oct", &err), &err);
        }
        struct journal *journal = begin();
        append(journal, TWO "step\n" THREE "undo\n");
        journal_close(journal, false);
        assert_ok(journal_recover("a.oct", &tree, &log, &report, &err), &err);
        assert_ok(chip_log_holds(&log, &tree, &holds, &err), &err);
        assert_true(holds);
        assert_true(strstr((const char *)log.data, "heat") && !strstr((const char *)log.data, "fill"));
        bytes_clear(&log);
        octree_chunks_clear(&chunks);
        octree_clear(&tree);
    }
}

static void a_save_that_did_not_happen_loses_nothing(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    save_carved("depth 4\n", "a.oct");
    struct journal *journal = begin();
    append(journal, ONE);
    assert_ok(journal_mark(journal, &err), &err);
    append(journal, TWO);
    journal_close(journal, false);
    assert_true(assert_recovers(ONE TWO).unsaved);
}

static void the_sculpture_may_be_damaged_or_gone(void **state)
{
    (void)state;
    leave_nothing();
    save_carved(ONE, "a.oct");
    journal_close(begin(), false);
    unlink("a.oct");
    assert_true(assert_recovers(ONE).unsaved);
    write_text("a.oct", "a bad disk");
    assert_true(assert_recovers(ONE).unsaved);
}

static void another_version_of_the_sculpture_is_refused(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    struct octree tree = cube(2, 5);
    struct journal_report report;
    save_carved(ONE, "a.oct");
    struct journal *journal = begin();
    append(journal, TWO);
    assert_ok(journal_mark(journal, &err), &err);
    append(journal, THREE);
    journal_close(journal, false);
    save_carved(THREE, "a.oct");
    assert_refused(journal_recover("a.oct", &tree, NULL, &report, &err), STATUS_INPUT,
                   "a.oct.journal: belongs to another version of a.oct", &err);
    unlink(BASE);
    assert_refused(journal_recover("a.oct", &tree, NULL, &report, &err), STATUS_INPUT,
                   "belongs to another version of a.oct", &err);
    assert_int_equal(octree_at(&tree, 0, 0, 0), 5);
    octree_clear(&tree);
}

static void only_one_program_writes(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    struct octree tree = {0};
    struct journal *journal = begin(), *other = NULL;
    struct journal_report report;
    bool left;
    const char *said = "a.oct: another balloon-sculpt is carving this sculpture";
    assert_refused(journal_open("a.oct", &tree, &other, &err), STATUS_RESOURCE, said, &err);
    assert_refused(journal_is_left("a.oct", &left, &err), STATUS_RESOURCE, said, &err);
    assert_refused(journal_recover("a.oct", &tree, NULL, &report, &err), STATUS_RESOURCE, said, &err);
    assert_refused(journal_remove("a.oct", &err), STATUS_RESOURCE, said, &err);
    journal_close(journal, true);
    assert_ok(journal_is_left("a.oct", &left, &err), &err);
    assert_false(left);
    journal_close(begin(), true);
}

static void a_journal_that_is_closed_for_good_leaves_no_file(void **state)
{
    (void)state;
    leave_nothing();
    save_carved(ONE, "a.oct");
    struct journal *journal = begin();
    append(journal, TWO);
    assert_int_equal(access(JOURNAL, F_OK) | access(BASE, F_OK), 0);
    journal_close(journal, true);
    assert_int_not_equal(access(JOURNAL, F_OK), 0);
    assert_int_not_equal(access(BASE, F_OK), 0);
    struct error err = {0};
    journal_close(begin(), false);
    assert_ok(journal_remove("a.oct", &err), &err);
    assert_int_not_equal(access(JOURNAL, F_OK), 0);
    assert_int_not_equal(access(BASE, F_OK), 0);
}

static void a_journal_that_is_left_is_gone_on_with(void **state)
{
    (void)state;
    leave_nothing();
    struct journal *journal = begin();
    append(journal, ONE "step\n");
    append(journal, TWO);
    journal_close(journal, false);
    FILE *stream = fopen(JOURNAL, "ab");
    fputs("chip sphere 0.1 0.", stream); /* a line cut off */
    fclose(stream);
    assert_int_equal(assert_recovers(ONE TWO).lost_bytes, strlen("chip sphere 0.1 0."));
    journal = begin();
    append(journal, THREE "undo\n");
    journal_close(journal, false);
    assert_int_equal(assert_recovers(ONE TWO).lost_bytes, 0);
}

/* A journal of this many chips, each of one cell, and a header; each line's end is an operation's boundary. */
enum { CHIPS = 12, LINE_SIZE = 128 };

static void chip_line(int i, char line[LINE_SIZE])
{
    snprintf(line, LINE_SIZE, "chip box %g %g 0 %g %g 0.0625\n", (i % 4) / 16.0, (i / 4 % 16) / 16.0,
             (i % 4 + 1) / 16.0, (i / 4 % 16 + 1) / 16.0);
}

static void append_chips(struct journal *journal, int count)
{
    for (int i = 0; i < count; i++) {
        char line[LINE_SIZE];
        chip_line(i, line);
        append(journal, line);
    }
}

/* The tree is a cube without its first `count` cells. */
static void assert_chips(const struct octree *tree, size_t count)
{
    for (size_t i = 0; i < 16 * 4; i++)
        assert_int_equal(octree_at(tree, (int)(i % 4), (int)(i / 4), 0), i >= count);
}

static struct bytes journal_bytes(void)
{
    struct error err = {0};
    struct bytes bytes = {0};
    assert_ok(file_read(JOURNAL, &bytes, &err), &err);
    return bytes;
}

static size_t lines_in(const struct bytes *bytes, size_t end)
{
    size_t lines = 0;
    for (size_t i = 0; i < end; i++)
        lines += bytes->data[i] == '\n';
    return lines;
}

/* The `step` that is put behind work left over must not change what the undo before it took back. */
static void going_on_with_a_journal_changes_nothing_about_it(void **state)
{
    (void)state;
    leave_nothing();
    struct journal *journal = begin();
    append(journal, ONE ONE "undo\n" THREE);
    journal_close(journal, false);
    assert_recovers(THREE);
    journal_close(begin(), false);
    assert_recovers(THREE);
}

static void a_journal_cut_at_any_byte_recovers_to_an_operation(void **state)
{
    (void)state;
    for (int with_file = 0; with_file < 2; with_file++) {
        leave_nothing();
        if (with_file)
            save_carved("depth 4\n", "a.oct");
        struct journal *journal = begin();
        append_chips(journal, CHIPS);
        journal_close(journal, false);
        struct bytes bytes = journal_bytes();
        for (size_t end = 0; end <= bytes.size; end++) {
            struct error err = {0};
            struct octree tree = {0};
            struct journal_report report;
            size_t lines = lines_in(&bytes, end);
            write_bytes(JOURNAL, bytes.data, end);
            if (lines == 0 && !with_file) { /* what the cube was is not known yet, and nothing was done */
                assert_refused(journal_recover("a.oct", &tree, NULL, &report, &err), STATUS_INPUT,
                               "nothing was written to it yet", &err);
                continue;
            }
            assert_ok(journal_recover("a.oct", &tree, NULL, &report, &err), &err);
            assert_int_equal(report.operations, lines ? lines - 1 : 0);
            assert_chips(&tree, report.operations);
            octree_clear(&tree);
        }
        bytes_clear(&bytes);
    }
}

/* A flipped bit is found: what is before its line is recovered, or, in the first line, nothing. */
static void a_journal_with_any_bit_flipped_recovers_what_is_before(void **state)
{
    (void)state;
    leave_nothing();
    struct journal *journal = begin();
    append_chips(journal, CHIPS);
    journal_close(journal, false);
    struct bytes bytes = journal_bytes();
    for (size_t bit = 0; bit < 8 * bytes.size; bit++) {
        struct error err = {0};
        struct octree tree = {0};
        struct journal_report report;
        size_t line = lines_in(&bytes, bit / 8);
        bytes.data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        write_bytes(JOURNAL, bytes.data, bytes.size);
        bytes.data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        enum status status = journal_recover("a.oct", &tree, NULL, &report, &err);
        assert_int_equal(status, line == 0 ? STATUS_INPUT : STATUS_OK);
        if (status)
            continue;
        assert_int_equal(report.operations, line - 1);
        assert_chips(&tree, line - 1);
        octree_clear(&tree);
    }
    bytes_clear(&bytes);
}

/* In a process of its own: appends until it is killed, counting what was appended. */
static void append_until_killed(volatile size_t *appended)
{
    struct error err = {0};
    struct journal *journal = NULL;
    struct octree start = {0};
    if (octree_init(&start, 4, 1, &err) || journal_open("a.oct", &start, &journal, &err))
        _exit(1);
    for (int i = 0; i < 64; i++) {
        char line[LINE_SIZE];
        chip_line(i, line);
        if (journal_append(journal, line, &err))
            _exit(1);
        ++*appended;
    }
    for (;;)
        pause();
}

static void a_program_killed_at_any_moment_loses_nothing_that_was_appended(void **state)
{
    (void)state;
    uint64_t seed = 9;
    volatile size_t *appended = mmap(NULL, sizeof *appended, PROT_READ | PROT_WRITE,
                                     MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(appended != MAP_FAILED);
    for (int moment = 0; moment < 20; moment++) {
        struct error err = {0};
        struct octree tree = {0};
        struct journal_report report;
        size_t wanted = 1 + random_bits(&seed) % 60;
        leave_nothing();
        *appended = 0;
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0)
            append_until_killed(appended);
        int ended = 0;
        while (*appended < wanted && waitpid(child, &ended, WNOHANG) == 0)
            ;
        kill(child, SIGKILL);
        waitpid(child, &ended, 0);
        assert_true(*appended >= wanted);
        assert_ok(journal_recover("a.oct", &tree, NULL, &report, &err), &err);
        assert_true(report.operations == *appended || report.operations == *appended + 1);
        assert_chips(&tree, report.operations);
        octree_clear(&tree);
    }
    munmap((void *)appended, sizeof *appended);
}

static void a_foreign_file_is_no_journal(void **state)
{
    (void)state;
    static const char *const foreign[] = {"chip sphere 0 0 0 1\n", "x",
                                          "# balloon-sculpt journal 2, file of hash 0 #00000000\n"};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        leave_nothing();
        struct error err = {0};
        struct octree tree = {0};
        struct journal *journal = NULL;
        struct journal_report report;
        write_text(JOURNAL, foreign[i]);
        assert_refused(journal_recover("a.oct", &tree, NULL, &report, &err), STATUS_INPUT,
                       "a.oct.journal: ", &err);
        assert_refused(journal_open("a.oct", &tree, &journal, &err), STATUS_INPUT, "a.oct.journal: ", &err);
        assert_int_equal(access(JOURNAL, F_OK), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_cube_and_what_was_done_to_it_are_recovered),
        cmocka_unit_test(work_on_a_file_is_recovered_from_that_file),
        cmocka_unit_test(undo_of_steps_before_a_save_is_recovered),
        cmocka_unit_test(after_a_save_nothing_is_unsaved),
        cmocka_unit_test(the_chip_log_goes_on_through_a_recovery),
        cmocka_unit_test(a_save_that_did_not_happen_loses_nothing),
        cmocka_unit_test(the_sculpture_may_be_damaged_or_gone),
        cmocka_unit_test(another_version_of_the_sculpture_is_refused),
        cmocka_unit_test(only_one_program_writes),
        cmocka_unit_test(a_journal_that_is_closed_for_good_leaves_no_file),
        cmocka_unit_test(a_journal_that_is_left_is_gone_on_with),
        cmocka_unit_test(going_on_with_a_journal_changes_nothing_about_it),
        cmocka_unit_test(a_journal_cut_at_any_byte_recovers_to_an_operation),
        cmocka_unit_test(a_journal_with_any_bit_flipped_recovers_what_is_before),
        cmocka_unit_test(a_program_killed_at_any_moment_loses_nothing_that_was_appended),
        cmocka_unit_test(a_foreign_file_is_no_journal),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
