/* Whatever happens to a program that keeps a journal, the work up to the last whole operation is there. */
#include "common/octree_chunks.h"
#include "journals.h"
#include "sculpt/chip_log.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

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

/* A look at a sculpture, then a kill: there is nothing to be recovered, and who looks again gets a journal
 * that begins from what is there then. */
static void a_journal_without_work_is_as_good_as_none(void **state)
{
    (void)state;
    struct error err = {0};
    bool left;
    for (int with_file = 0; with_file < 2; with_file++) {
        leave_nothing();
        if (with_file)
            save_carved(ONE, "a.oct");
        journal_close(begin(), false);
        assert_ok(journal_is_left("a.oct", &left, &err), &err);
        assert_false(left);
        struct octree tree = with_file ? (struct octree){0} : new_tree(2, 5);
        struct journal *journal = NULL;
        assert_ok(journal_open("a.oct", &tree, &journal, &err), &err);
        journal_close(journal, false);
        struct journal_report report;
        assert_ok(journal_recover("a.oct", &tree, NULL, &report, &err), &err);
        assert_int_equal(tree.depth, with_file ? 4 : 2);
        octree_clear(&tree);
        save_carved(TWO, "a.oct"); /* what it began from is in the journal alone */
        assert_ok(journal_is_left("a.oct", &left, &err), &err);
        assert_true(left);
    }
}

static void another_version_of_the_sculpture_is_refused(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    struct octree tree = new_tree(2, 5);
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

/* The linker sends the library's calls of flock() here (--wrap): what happens just before the next one. */
static void (*before_lock)(void);

int __real_flock(int file, int how);
int __wrap_flock(int file, int how);

int __wrap_flock(int file, int how)
{
    void (*happens)(void) = before_lock;
    before_lock = NULL;
    if (happens)
        happens();
    return __real_flock(file, how);
}

/* Its last owner removes it between our opening and our locking it: what is locked then has no name. */
static void a_journal_that_goes_away_while_it_is_opened_is_begun_anew(void **state)
{
    (void)state;
    leave_nothing();
    struct journal *journal = begin();
    append(journal, THREE);
    journal_close(journal, false);
    before_lock = leave_nothing;
    journal = begin();
    append(journal, ONE);
    journal_close(journal, false);
    assert_recovers(ONE);
}

static void a_journal_that_cannot_be_removed_is_named(void **state)
{
    (void)state;
    leave_nothing();
    struct error err = {0};
    journal_close(begin(), false);
    assert_int_equal(chmod(JOURNAL, 0644), 0);
    if (deny_writing())
        assert_refused(journal_remove("a.oct", &err), STATUS_FILE, "a.oct.journal: cannot remove: ", &err);
    else
        print_message("# skipped: root cannot become somebody who may not remove it\n");
    allow_writing();
    assert_int_equal(access(JOURNAL, F_OK), 0);
}

static char elsewhere[] = "/dev/shm/balloon-journal-XXXXXX";

/* Makes a folder on another file system, and a name for a sculpture in it. False where there is none. */
static bool go_elsewhere(char path[64])
{
    struct stat here, there;
    strcpy(elsewhere + sizeof elsewhere - 7, "XXXXXX");
    snprintf(path, 64, "%s/a.oct", mkdtemp(elsewhere));
    if (!stat(".", &here) && !stat(elsewhere, &there) && here.st_dev != there.st_dev)
        return true;
    rmdir(elsewhere);
    print_message("# skipped: /dev/shm is no other file system than the test's folder\n");
    return false;
}

static int others_file;

static void another_program_locks(void)
{
    char name[80];
    snprintf(name, sizeof name, "%s/" JOURNAL, elsewhere);
    others_file = open(name, O_RDWR | O_CLOEXEC);
    assert_int_equal(__real_flock(others_file, LOCK_EX | LOCK_NB), 0);
}

static void a_journal_that_another_program_takes_on_its_way_stays(void **state)
{
    (void)state;
    char path[64];
    if (!go_elsewhere(path))
        return;
    leave_nothing();
    struct error err = {0};
    struct journal *journal = begin();
    append(journal, ONE);
    before_lock = another_program_locks;
    assert_refused(journal_move(journal, path, &err), STATUS_RESOURCE, "another balloon-sculpt is carving",
                   &err);
    close(others_file);
    append(journal, TWO);
    journal_close(journal, false);
    assert_recovers(ONE TWO);
    assert_int_equal(rmdir(elsewhere), 0);
}

/* Neither a new name nor a link reaches there: journal and base are copied. */
static void a_journal_goes_along_to_another_file_system(void **state)
{
    (void)state;
    char path[64], name[80];
    if (!go_elsewhere(path))
        return;
    leave_nothing();
    struct error err = {0};
    struct octree tree = carved(ONE), wanted = carved(ONE TWO THREE);
    struct journal *journal = NULL;
    struct journal_report report;
    assert_ok(journal_open("a.oct", &tree, &journal, &err), &err); /* with a base: no file has this tree */
    append(journal, TWO);
    assert_int_equal(access(BASE, F_OK), 0);
    assert_ok(journal_move(journal, path, &err), &err);
    assert_int_equal(access(JOURNAL, F_OK), -1);
    assert_int_equal(access(BASE, F_OK), -1);
    append(journal, THREE);
    bool left;
    assert_refused(journal_is_left(path, &left, &err), STATUS_RESOURCE, path,
                   &err); /* it is locked there too */
    journal_close(journal, false);
    octree_clear(&tree);
    assert_ok(journal_recover(path, &tree, NULL, &report, &err), &err);
    assert_true(octree_equal(&tree, &wanted));
    octree_clear(&tree);
    octree_clear(&wanted);
    for (int i = 0; i < 2; i++) {
        snprintf(name, sizeof name, "%s%s", path, i ? ".journal-base" : ".journal");
        assert_int_equal(unlink(name), 0);
    }
    rmdir(elsewhere);
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
        cmocka_unit_test(a_journal_without_work_is_as_good_as_none),
        cmocka_unit_test(another_version_of_the_sculpture_is_refused),
        cmocka_unit_test(only_one_program_writes),
        cmocka_unit_test(a_journal_that_is_closed_for_good_leaves_no_file),
        cmocka_unit_test(a_journal_that_is_left_is_gone_on_with),
        cmocka_unit_test(going_on_with_a_journal_changes_nothing_about_it),
        cmocka_unit_test(a_journal_that_goes_away_while_it_is_opened_is_begun_anew),
        cmocka_unit_test(a_journal_that_cannot_be_removed_is_named),
        cmocka_unit_test(a_journal_that_another_program_takes_on_its_way_stays),
        cmocka_unit_test(a_journal_goes_along_to_another_file_system),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
