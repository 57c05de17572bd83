/* Journals where memory ends and files fail: what was appended before is recovered, whatever failed. */
#include "../unit/trees.h"
#include "faulty.h"
#include "sculpt/journal.h"

#define SCULPTURE "a.oct"

static const char *const lines[] = {
    "chip sphere 0.25 0.25 0.25 0.2\n",
    "mirror x\nheat 0.5 0.5 0.5 0.5\n",
    "material 7\nfill box 0.5 0.5 0.5 0.9 0.8 0.7\n",
};
enum { LINES = 3, DEPTH = 4 };

/* What the first `count` appends make of the start. */
static struct octree carved(const struct octree *start, int count)
{
    struct error err = {0};
    struct octree tree = {0};
    struct chips chips = {0};
    char text[400] = "step\n"; /* an empty script would be refused */
    for (int i = 0; i < count; i++)
        strcat(text, lines[i]);
    assert_ok(octree_copy(&tree, start, &err), &err);
    assert_ok(chips_parse("lines", text, strlen(text), &chips, &err), &err);
    assert_ok(chips_run(&tree, &chips, &err), &err);
    chips_clear(&chips);
    return tree;
}

static void remove_files(void)
{
    unlink(SCULPTURE);
    unlink(SCULPTURE ".journal");
    unlink(SCULPTURE ".journal-base");
}

/* The journal that is left leads to the first `count` appends. */
static void assert_recovers(const struct octree *start, int count)
{
    struct error err = {0};
    struct journal_report report;
    struct octree tree = {0}, wanted = carved(start, count);
    assert_ok(journal_recover(SCULPTURE, &tree, NULL, &report, &err), &err);
    assert_true(octree_equal(&tree, &wanted));
    octree_clear(&tree);
    octree_clear(&wanted);
}

/* Begins a journal and appends, with a call failing; after a failure no more is appended. */
static enum status write_journal(const struct octree *start, struct journal **journal, int *count,
                                 struct error *err)
{
    enum status status = journal_open(SCULPTURE, start, journal, err);
    for (*count = 0; *count < LINES && !status; *count += !status)
        status = journal_append(*journal, lines[*count], err);
    return status;
}

/* From a new cube, from a file, and from a sculpture that has no file yet. */
static void what_was_appended_before_a_failure_is_recovered(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree starts[] = {new_tree(DEPTH, 1), random_sculpture(DEPTH, 10, 3),
                              random_sculpture(DEPTH, 10, 5)};
    for (int i = 0; i < 6; i++) {
        const struct octree *start = &starts[i / 2];
        for (struct fault fault = {.kinds = fault_kinds[i & 1]}; fault_next(&fault);) {
            struct journal *journal = NULL;
            int count;
            remove_files();
            if (i / 2 == 1)
                assert_ok(octree_save(start, SCULPTURE, &err), &err);
            fault_begin(&fault);
            enum status status = write_journal(start, &journal, &count, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            for (; journal && count < LINES; count++) /* a second try succeeds */
                assert_ok(journal_append(journal, lines[count], &err), &err);
            journal_close(journal, false);
            if (journal)
                assert_recovers(start, count);
            else
                assert_int_equal(files_here(), i / 2 == 1);
        }
    }
    for (int i = 0; i < 3; i++)
        octree_clear(&starts[i]);
    remove_files();
}

/* A journal of so many appends that is left is read, and gone on with, or says why not and stays. */
static void check_left(int appends)
{
    struct error err = {0};
    struct octree start = random_sculpture(DEPTH, 10, 3), wanted = carved(&start, appends);
    struct journal *journal = NULL;
    assert_ok(octree_save(&start, SCULPTURE, &err), &err);
    assert_ok(journal_open(SCULPTURE, &start, &journal, &err), &err);
    for (int i = 0; i < appends; i++)
        assert_ok(journal_append(journal, lines[i], &err), &err);
    journal_close(journal, false);
    for (int i = 0; i < 4; i++)
        for (struct fault fault = {.kinds = fault_kinds[i & 1]}; fault_next(&fault);) {
            struct octree tree = new_tree(2, 7);
            struct journal_report report;
            struct bytes log = {0};
            journal = NULL;
            fault_begin(&fault);
            enum status status = i < 2 ? journal_recover(SCULPTURE, &tree, &log, &report, &err)
                                       : journal_open(SCULPTURE, &start, &journal, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            if (i < 2)
                assert_true(status ? tree.root == 7 && tree.depth == 2 : octree_equal(&tree, &wanted));
            journal_close(journal, false);
            assert_recovers(&start, appends);
            bytes_clear(&log);
            octree_clear(&tree);
        }
    octree_clear(&start);
    octree_clear(&wanted);
    remove_files();
}

static void a_journal_that_is_left_stays_until_it_can_be_read(void **state)
{
    (void)state;
    check_left(0);
    check_left(LINES);
}

/* To another file system, where one is at hand: a copy, after a failure of which it is where it was. */
static void a_journal_that_cannot_go_along_stays_where_it_is(void **state)
{
    (void)state;
    char other[] = "/dev/shm/balloon-journal-XXXXXX", path[64], there[80];
    struct error err = {0};
    struct octree start = random_sculpture(DEPTH, 10, 3);
    assert_non_null(mkdtemp(other));
    snprintf(path, sizeof path, "%s/" SCULPTURE, other);
    snprintf(there, sizeof there, "%s.journal", path);
    for (int i = 0; i < 2; i++)
        for (struct fault fault = {.kinds = fault_kinds[i]}; fault_next(&fault);) {
            struct journal *journal = NULL;
            assert_ok(octree_save(&start, SCULPTURE, &err), &err);
            assert_ok(journal_open(SCULPTURE, &start, &journal, &err), &err);
            assert_ok(journal_append(journal, lines[0], &err), &err);
            fault_begin(&fault);
            const enum status status = journal_move(journal, path, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_int_equal(access(there, F_OK), status ? -1 : 0);
            assert_int_equal(access(SCULPTURE ".journal", F_OK), status ? 0 : -1);
            assert_ok(journal_append(journal, lines[1], &err), &err);
            if (status) {
                journal_close(journal, false);
                assert_recovers(&start, 2);
            } else {
                journal_close(journal, true);
            }
            remove_files();
        }
    assert_int_equal(rmdir(other), 0);
    octree_clear(&start);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_appended_before_a_failure_is_recovered),
        cmocka_unit_test(a_journal_that_is_left_stays_until_it_can_be_read),
        cmocka_unit_test(a_journal_that_cannot_go_along_stays_where_it_is),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
