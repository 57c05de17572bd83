/* Saving beside carving: what is written is a snapshot, and no kill at any moment loses what a hand did. */
#include "check.h"
#include "folder.h"
#include "saving.h"

#include <unistd.h>

static struct session session;
static struct error err;

static void open_new(void)
{
    unlink("new.oct");
    assert_ok(session_open(&session, "new.oct", 5, false, &err), &err);
}

/* From the front, at x, y. */
static void click(double x, double y)
{
    session_aim(&session, (double[3]){x, y, 3}, (double[3]){0, 0, -1});
    assert_ok(session_press(&session, &err), &err);
    assert_ok(session_release(&session, &err), &err);
}

/* As a kill leaves the files: the journal stays, unlocked. */
static void kill_session(void)
{
    journal_close(session.journal, false);
    session.journal = NULL;
    session_clear(&session);
}

static void make(const char *script, struct octree *tree)
{
    struct chips chips = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_begin(&chips, 0, tree, &err), &err);
    assert_ok(chips_run(tree, &chips, &err), &err);
    chips_clear(&chips);
}

static void assert_tree(const struct octree *tree, const char *script)
{
    struct octree want = {0};
    make(script, &want);
    assert_true(octree_equal(tree, &want));
    octree_clear(&want);
}

static void assert_file(const char *path, const char *script)
{
    struct octree tree = {0};
    assert_ok(octree_load(path, &tree, &err), &err);
    assert_tree(&tree, script);
    octree_clear(&tree);
}

#define FIRST  "depth 5\nchip sphere 0.3 0.3 1 0.08\n"
#define SECOND "chip sphere 0.7 0.7 1 0.08\n"
#define THIRD  "chip sphere 0.5 0.2 1 0.08\n"

static void what_is_carved_while_it_saves_is_not_in_the_file_and_unsaved(void **state)
{
    (void)state;
    enum status status;
    open_new();
    click(0.3, 0.3);
    assert_ok(session_save_begin(&session, NULL, NULL, &err), &err);
    click(0.7, 0.7);
    assert_int_equal(session_save_begin(&session, NULL, NULL, &err), STATUS_RESOURCE); /* one at a time */
    assert_true(session_write_ended(&session, true, &status, &err));
    assert_int_equal(status, STATUS_OK);
    assert_false(session_write_ended(&session, true, &status, &err));
    assert_file("new.oct", FIRST);
    assert_true(session.unsaved);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST SECOND);
    session_clear(&session);
}

static void undo_of_steps_before_a_new_name_survives_a_kill(void **state)
{
    (void)state;
    unlink("other.oct");
    open_new();
    click(0.3, 0.3);
    click(0.7, 0.7);
    assert_ok(save_now(&session, "other.oct", &err), &err);
    assert_false(session.unsaved);
    assert_int_equal(access("new.oct.journal", F_OK), -1);
    assert_true(session_undo(&session, &err));
    click(0.5, 0.2);
    kill_session();
    assert_file("other.oct", FIRST SECOND);
    assert_ok(session_open(&session, "other.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST THIRD);
    assert_true(session.unsaved);
    session_clear(&session);
}

static void a_save_that_fails_leaves_the_name_the_journal_and_the_work_as_they_were(void **state)
{
    (void)state;
    open_new();
    click(0.3, 0.3);
    assert_int_equal(save_now(&session, "nowhere/other.oct", &err), STATUS_FILE);
    assert_string_equal(session.path, "new.oct");
    assert_true(session.unsaved);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST);
    session_clear(&session);
}

static void an_export_is_written_beside_carving_and_is_no_save(void **state)
{
    (void)state;
    enum status status;
    open_new();
    click(0.3, 0.3);
    unlink("out.chips");
    assert_ok(session_export_begin(&session, "out.chips", &err), &err);
    click(0.7, 0.7);
    assert_refused(session_export_begin(&session, "more.chips", &err), STATUS_RESOURCE,
                   "out.chips is being written; wait a moment", &err);
    assert_refused(save_now(&session, NULL, &err), STATUS_RESOURCE, "out.chips is being written", &err);
    assert_true(session_write_ended(&session, true, &status, &err));
    assert_int_equal(status, STATUS_OK);
    struct chips chips = {0};
    struct octree tree = {0};
    assert_ok(chips_load("out.chips", &chips, &err), &err);
    assert_ok(chips_begin(&chips, 0, &tree, &err), &err);
    assert_ok(chips_run(&tree, &chips, &err), &err);
    assert_tree(&tree, FIRST);
    assert_string_equal(session.path, "new.oct");
    assert_true(session.unsaved);
    octree_clear(&tree);
    chips_clear(&chips);
    session_clear(&session);
}

static void an_export_that_fails_says_why_when_it_has_ended(void **state)
{
    (void)state;
    enum status status;
    open_new();
    click(0.3, 0.3);
    assert_ok(session_export_begin(&session, "nowhere/out.vox", &err), &err);
    assert_true(session_write_ended(&session, true, &status, &err));
    assert_refused(status, STATUS_FILE, "nowhere/out.vox: cannot create", &err);
    assert_true(session.unsaved);
    session_clear(&session);
}

static void a_name_that_another_program_carves_under_is_not_taken(void **state)
{
    (void)state;
    struct journal *others = NULL;
    open_new();
    click(0.3, 0.3);
    unlink("other.oct");
    unlink("other.oct.journal");
    assert_ok(journal_open("other.oct", &session.tree, &others, &err), &err);
    assert_refused(save_now(&session, "other.oct", &err), STATUS_RESOURCE, "other.oct", &err);
    assert_int_equal(access("other.oct", F_OK), -1);
    assert_string_equal(session.path, "new.oct");
    assert_true(session.unsaved);
    journal_close(others, true);
    assert_ok(save_now(&session, "other.oct", &err), &err); /* it has gone away */
    assert_file("other.oct", FIRST);
    session_clear(&session);
}

/* Where no journal can be kept the user is told, carves, and goes on under a name that can have one. */
static void without_a_journal_work_is_kept_from_the_first_save_on(void **state)
{
    (void)state;
    unlink("other.oct");
    assert_ok(session_open(&session, "nowhere/new.oct", 5, false, &err), &err);
    assert_null(session.journal);
    assert_non_null(strstr(session.warning, "nothing is kept until you save: nowhere/new.oct.journal"));
    click(0.3, 0.3);
    assert_ok(save_now(&session, "other.oct", &err), &err);
    assert_non_null(session.journal);
    assert_string_equal(session.warning, "");
    click(0.7, 0.7);
    kill_session();
    assert_file("other.oct", FIRST);
    assert_ok(session_open(&session, "other.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST SECOND);
    session_clear(&session);
}

static void chunks_that_are_not_known_are_kept(void **state)
{
    (void)state;
    struct octree tree = {0};
    struct octree_chunks chunks = {0};
    struct bytes data = {(unsigned char *)strdup("of tomorrow"), 11};
    make(FIRST, &tree);
    assert_ok(octree_chunks_put(&chunks, "NEXT", &data, &err), &err);
    assert_ok(octree_save_with(&tree, &chunks, "new.oct", &err), &err);
    octree_chunks_clear(&chunks);
    octree_clear(&tree);

    assert_ok(session_open(&session, "new.oct", 5, false, &err), &err);
    click(0.7, 0.7);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err); /* recovered work keeps them too */
    assert_ok(save_now(&session, NULL, &err), &err);
    session_clear(&session);
    assert_ok(octree_load_with("new.oct", &tree, &chunks, &err), &err);
    const struct octree_chunk *next = octree_chunks_find(&chunks, "NEXT");
    assert_non_null(next);
    assert_int_equal(next->data.size, 11);
    assert_memory_equal(next->data.data, "of tomorrow", 11);
    assert_tree(&tree, FIRST SECOND);
    octree_chunks_clear(&chunks);
    octree_clear(&tree);
}

static void work_that_is_not_wanted_is_forgotten(void **state)
{
    (void)state;
    open_new();
    click(0.3, 0.3);
    kill_session();
    assert_int_equal(session_open(&session, "new.oct", 5, false, &err), STATUS_OK);
    assert_tree(&session.tree, "depth 5\nstep\n");
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_tree(&session.tree, "depth 5\nstep\n");
    session_clear(&session);
}

/* Nobody knows whose it is, and it is all that there is of it. */
static void a_name_with_a_journal_that_is_left_is_not_taken(void **state)
{
    (void)state;
    struct octree tree = {0};
    open_new();
    click(0.3, 0.3);
    kill_session();
    make(FIRST, &tree);
    assert_refused(session_begin(&session, "new.oct", &tree, &err), STATUS_FILE,
                   "new.oct.journal holds work that was not saved; give another name", &err);
    octree_clear(&tree);
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST);
    session_clear(&session);
}

static void what_has_no_file_yet_is_unsaved_work_that_survives_a_kill(void **state)
{
    (void)state;
    struct octree tree = {0};
    unlink("new.oct");
    make(FIRST, &tree);
    assert_ok(session_begin(&session, "new.oct", &tree, &err), &err);
    assert_null(tree.blocks);
    assert_true(session.unsaved && session.log_lost);
    click(0.7, 0.7);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_tree(&session.tree, FIRST SECOND);
    assert_ok(save_now(&session, NULL, &err), &err);
    session_clear(&session);

    make(FIRST, &tree); /* a name that is taken is refused, and the tree is the caller's still */
    assert_int_equal(session_begin(&session, "new.oct", &tree, &err), STATUS_FILE);
    assert_tree(&tree, FIRST);
    octree_clear(&tree);
}

static void steps_beyond_the_undo_memory_are_counted(void **state)
{
    (void)state;
    open_new();
    session_limit_undo(&session, 4096);
    size_t steps = 0;
    while (session.forgotten == 0 && steps < 100) {
        click(0.1 + 0.008 * (double)steps, 0.5);
        steps++;
    }
    assert_in_range(session.forgotten, 1, steps);
    size_t undone = 0;
    while (session_undo(&session, &err))
        undone++;
    assert_int_equal(undone + session.forgotten, steps);
    session_clear(&session);
}

static void a_cube_that_goes_as_a_whole_is_a_step(void **state)
{
    (void)state;
    unlink("new.oct");
    assert_ok(session_open(&session, "new.oct", 0, false, &err), &err);
    session.radius = 0.5;
    session.depth = 1;
    click(0.5, 0.5);
    assert_int_equal(session.tree.root, 0);
    assert_true(session.unsaved);
    assert_true(session_undo(&session, &err));
    assert_int_equal(session.tree.root, 1);
    session_clear(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_carved_while_it_saves_is_not_in_the_file_and_unsaved),
        cmocka_unit_test(undo_of_steps_before_a_new_name_survives_a_kill),
        cmocka_unit_test(a_save_that_fails_leaves_the_name_the_journal_and_the_work_as_they_were),
        cmocka_unit_test(an_export_is_written_beside_carving_and_is_no_save),
        cmocka_unit_test(an_export_that_fails_says_why_when_it_has_ended),
        cmocka_unit_test(a_name_that_another_program_carves_under_is_not_taken),
        cmocka_unit_test(without_a_journal_work_is_kept_from_the_first_save_on),
        cmocka_unit_test(chunks_that_are_not_known_are_kept),
        cmocka_unit_test(work_that_is_not_wanted_is_forgotten),
        cmocka_unit_test(a_name_with_a_journal_that_is_left_is_not_taken),
        cmocka_unit_test(what_has_no_file_yet_is_unsaved_work_that_survives_a_kill),
        cmocka_unit_test(steps_beyond_the_undo_memory_are_counted),
        cmocka_unit_test(a_cube_that_goes_as_a_whole_is_a_step),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
