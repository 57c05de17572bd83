/* Journals that are cut off, damaged or foreign, and programs that are killed: what
 * was whole is recovered. */
#include "journals.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

/* A journal of this many chips, each of one cell, and a header; each line's end is
 * an operation's boundary. */
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
        cmocka_unit_test(a_journal_cut_at_any_byte_recovers_to_an_operation),
        cmocka_unit_test(a_journal_with_any_bit_flipped_recovers_what_is_before),
        cmocka_unit_test(a_program_killed_at_any_moment_loses_nothing_that_was_appended),
        cmocka_unit_test(a_foreign_file_is_no_journal),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
