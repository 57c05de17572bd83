/* What a hand does in the sculpting window, without the window: it is the chip script that
 * one could have written. */
#include "check.h"
#include "folder.h"
#include "saving.h"
#include "sculpt/bricks.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

static struct session session;
static struct error err;

static void open_new(unsigned depth)
{
    unlink("new.oct");
    assert_ok(session_open(&session, "new.oct", depth, false, &err), &err);
}

/* Looks from the front at x, y. */
static void aim(double x, double y)
{
    session_aim(&session, (double[3]){x, y, 3}, (double[3]){0, 0, -1});
}

/* A window tells of the pointer's place once more when the button goes up. */
static void click(double x, double y)
{
    aim(x, y);
    assert_ok(session_press(&session, &err), &err);
    aim(x, y);
    assert_ok(session_drag(&session, &err), &err);
    assert_ok(session_release(&session, &err), &err);
}

static void assert_script(const char *script)
{
    struct chips chips = {0};
    struct octree tree = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_begin(&chips, 0, &tree, &err), &err);
    assert_ok(chips_run(&tree, &chips, &err), &err);
    assert_true(octree_equal(&tree, &session.tree));
    octree_clear(&tree);
    chips_clear(&chips);
}

static void each_tool_does_what_its_line_in_a_script_would(void **state)
{
    (void)state;
    open_new(5);
    session.radius = 0.15;
    click(0.5, 0.5);
    session.tool = TOOL_BOX;
    click(0.25, 0.75);
    session.tool = TOOL_CYLINDER;
    click(0.75, 0.25);
    assert_script("depth 5\nchip sphere 0.5 0.5 1 0.15\nchip box 0.1 0.6 0.85 0.4 0.9 1.15\n"
                  "chip cylinder 0.75 0.25 0.85 0.75 0.25 1.15 0.15\n");
    session.tool = TOOL_SANDPAPER;
    click(0.9, 0.9);
    session.tool = TOOL_HEAT;
    click(0.2, 0.2);
    session.fill = true;
    session.tool = TOOL_SPHERE;
    session.depth = 0.5;
    click(0.95, 0.5);
    assert_script(
        "depth 5\nchip sphere 0.5 0.5 1 0.15\nchip box 0.1 0.6 0.85 0.4 0.9 1.15\n"
        "chip cylinder 0.75 0.25 0.85 0.75 0.25 1.15 0.15\nsandpaper 0.9 0.9 1 0.15\nheat 0.2 0.2 1 0.15\n"
        "fill sphere 0.95 0.5 0.925 0.15\n");
    session_clear(&session);
}

static void a_stroke_is_one_step_of_capsules(void **state)
{
    (void)state;
    open_new(5);
    session.tool = TOOL_STROKE;
    session.radius = 0.1;
    aim(0.25, 0.5);
    assert_ok(session_press(&session, &err), &err);
    for (int i = 1; i <= 4; i++) {
        aim(0.25 + 0.125 * i, 0.5);
        assert_ok(session_drag(&session, &err), &err);
    }
    assert_ok(session_release(&session, &err), &err);
    assert_script("depth 5\nchip capsule 0.25 0.5 1 0.75 0.5 1 0.1 0.1\n");
    assert_true(session_undo(&session, &err));
    assert_script("depth 5\n");
    assert_false(session_undo(&session, &err));
    session_clear(&session);
}

static void a_cut_takes_what_lies_to_the_right_of_the_line(void **state)
{
    (void)state;
    open_new(4);
    session.tool = TOOL_CUT;
    const double eye[3] = {0.5, 0.5, 3}, left[3] = {-0.6, 0, -0.8}, right[3] = {0.6, 0, -0.8};
    session_aim(&session, eye, left);
    assert_ok(session_press(&session, &err), &err);
    session_aim(&session, eye, right);
    double line[32][2][3]; /* and strokes from it to the side that goes, here below */
    const size_t strokes = session_outline(&session, line, 32);
    assert_true(strokes > 2);
    for (size_t i = 1; i < strokes; i++)
        assert_true(line[i][1][1] < line[i][0][1]);
    assert_ok(session_drag(&session, &err), &err);
    assert_ok(session_release(&session, &err), &err);
    assert_script("depth 4\nchip half-space 0.5 0.5 0.5 0 -1 0\n"); /* drawn to the right: what is below */
    session_clear(&session);
}

static void mirror_makes_both_halves_one_step(void **state)
{
    (void)state;
    open_new(5);
    session.mirror = CHIP_MIRROR_X;
    click(0.2, 0.5);
    assert_script("depth 5\nchip sphere 0.2 0.5 1 0.08\nchip sphere 0.8 0.5 1 0.08\n");
    assert_true(session_undo(&session, &err));
    assert_script("depth 5\n");
    assert_true(session_redo(&session, &err));
    assert_script("depth 5\nmirror x\nchip sphere 0.2 0.5 1 0.08\n");
    session_clear(&session);
}

static void beside_the_sculpture_a_click_does_nothing(void **state)
{
    (void)state;
    open_new(4);
    click(1.5, 0.5);
    assert_false(session.unsaved);
    assert_false(session_undo(&session, &err));
    session_clear(&session);
}

static void the_brush_keeps_to_the_grid_and_to_its_limits(void **state)
{
    (void)state;
    open_new(3);
    session.snap = true;
    aim(0.3, 0.99);
    assert_near(session.middle[0], 0.3125, 1e-15); /* cells are 1/8 wide: the middle of the third */
    assert_near(session.middle[1], 0.9375, 1e-15);
    session_resize_brush(&session, 1000);
    assert_near(session.radius, 0.5, 0);
    session_resize_brush(&session, -1000);
    assert_near(session.radius, 1.0 / 16, 0);
    session_sink_brush(&session, -1000);
    assert_near(session.depth, -1, 0);
    session_clear(&session);
}

static void what_is_saved_is_what_is_opened_and_its_log_replays(void **state)
{
    (void)state;
    open_new(5);
    click(0.3, 0.3);
    click(0.7, 0.7);
    assert_true(session_undo(&session, &err));
    assert_true(session.unsaved);
    assert_ok(save_now(&session, NULL, &err), &err);
    assert_false(session.unsaved);
    session_clear(&session);
    assert_ok(session_open(&session, "new.oct", 9, false, &err), &err);
    assert_script("depth 5\nchip sphere 0.3 0.3 1 0.08\n");
    assert_non_null(session.log_before.data);
    click(0.6, 0.2);
    assert_ok(save_now(&session, "other.oct", &err), &err);
    assert_string_equal(session.path, "other.oct");
    session_clear(&session);
    assert_ok(session_open(&session, "other.oct", 9, false, &err), &err);
    assert_false(session.log_lost);
    assert_script((const char *)session.log_before.data);
    session_clear(&session);
}

/* As a kill leaves it: the journal stays, unlocked. */
static void kill_session(void)
{
    journal_close(session.journal, false);
    session.journal = NULL;
    session_clear(&session);
}

static void work_that_was_not_saved_is_taken_up_again(void **state)
{
    (void)state;
    open_new(5);
    click(0.3, 0.3);
    click(0.7, 0.7);
    assert_true(session_undo(&session, &err));
    kill_session();

    bool left = false;
    assert_ok(journal_is_left("new.oct", &left, &err), &err);
    assert_true(left);
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_script("depth 5\nchip sphere 0.3 0.3 1 0.08\n");
    assert_true(session.unsaved);
    assert_false(session.log_lost);
    session_clear(&session);
    assert_ok(journal_is_left("new.oct", &left, &err), &err);
    assert_false(left);
}

/* What the first hand's mirror and material were is nothing to the second. */
static void work_that_was_taken_up_can_be_taken_up_again(void **state)
{
    (void)state;
    struct octree seen = {0};
    open_new(5);
    session.mirror = CHIP_MIRROR_X;
    click(0.2, 0.5);
    session.fill = true;
    session.material = 3;
    click(0.2, 0.8);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    click(0.3, 0.3);
    session.fill = true;
    click(0.7, 0.3);
    assert_ok(octree_copy(&seen, &session.tree, &err), &err);
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_true(octree_equal(&session.tree, &seen));
    octree_clear(&seen);
    session_clear(&session);
}

static void limit_files(rlim_t bytes)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/* Nor can it be done again, or what was undone before it: the journal and the hand would part. */
static void what_the_journal_cannot_keep_is_taken_back(void **state)
{
    (void)state;
    signal(SIGXFSZ, SIG_IGN);
    open_new(5);
    click(0.3, 0.3);
    click(0.7, 0.7);
    assert_true(session_undo(&session, &err));
    aim(0.7, 0.3);
    assert_ok(session_press(&session, &err), &err);
    limit_files(1);
    const enum status status = session_release(&session, &err);
    limit_files(RLIM_INFINITY);
    assert_int_equal(status, STATUS_FILE);
    assert_script("depth 5\nchip sphere 0.3 0.3 1 0.08\n");
    assert_false(session_redo(&session, &err));
    assert_true(session_undo(&session, &err));
    assert_true(session_redo(&session, &err));
    kill_session();
    assert_ok(session_open(&session, "new.oct", 5, true, &err), &err);
    assert_script("depth 5\nchip sphere 0.3 0.3 1 0.08\n");
    session_clear(&session);
}

static void two_hands_cannot_carve_one_sculpture(void **state)
{
    (void)state;
    struct session other;
    open_new(4);
    click(0.5, 0.5);
    assert_int_equal(session_open(&other, "new.oct", 4, false, &err), STATUS_RESOURCE);
    session_clear(&session);
}

/* Every exposed face of a cell, told once, by the brick that has the cell. */
static uint64_t count_faces(const struct octree *tree)
{
    struct brick_faces faces = {0};
    uint64_t count = 0;
    int at[3];
    for (at[0] = 0; at[0] < bricks_along(tree); at[0]++)
        for (at[1] = 0; at[1] < bricks_along(tree); at[1]++)
            for (at[2] = 0; at[2] < bricks_along(tree); at[2]++) {
                assert_ok(brick_find_faces(tree, at, &faces, &err), &err);
                for (size_t i = 0; i < faces.count; i++)
                    count += (uint64_t)faces.items[i].size[0] * faces.items[i].size[1];
            }
    free(faces.items);
    return count;
}

static void bricks_have_all_faces_and_change_only_where_a_chip_fell(void **state)
{
    (void)state;
    struct octree_regions regions;
    open_new(7);
    session.radius = 0.05;
    session_take_changes(&session, &regions);
    assert_true(count_faces(&session.tree) == octree_measure(&session.tree).exposed_faces);
    click(0.37, 0.55);
    session.fill = true;
    session.material = 3;
    click(0.8, 0.1);
    assert_true(count_faces(&session.tree) == octree_measure(&session.tree).exposed_faces);
    session_take_changes(&session, &regions);
    for (int i = 0; i < regions.count; i++) {
        int first[3], last[3];
        bricks_of_region(&session.tree, &regions.items[i], first, last);
        assert_true((last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1) <= 12);
    }
    session_take_changes(&session, &regions);
    assert_int_equal(regions.count, 0);
    session_clear(&session);
}

/* An empty cube has nothing to begin at, for chips and fills alike; which step back there is, is said. */
static void a_press_that_begins_nothing_says_why(void **state)
{
    (void)state;
    open_new(3);
    aim(0.5, 0.5);
    assert_null(session_why_nothing(&session));
    aim(2, 0.5);
    assert_non_null(strstr(session_why_nothing(&session), "nothing under the pointer"));
    session.radius = 2;
    click(0.5, 0.5);
    session.fill = true;
    aim(0.5, 0.5);
    assert_non_null(strstr(session_why_nothing(&session), "cube is empty"));
    assert_non_null(strstr(session_why_nothing(&session), "ctrl+z"));
    click(0.5, 0.5);
    assert_int_equal(session.tree.root, 0);
    history_clear(&session.history);
    assert_non_null(strstr(session_why_nothing(&session), "fill half of it"));

    /* and so it does */
    session.tool = TOOL_CUT;
    assert_null(session_why_nothing(&session));
    const double eye[3] = {0.5, 0.5, 3};
    session_aim(&session, eye, (double[3]){0, -0.2, -1});
    assert_ok(session_press(&session, &err), &err);
    session_aim(&session, eye, (double[3]){0, 0.2, -1});
    assert_ok(session_release(&session, &err), &err);
    assert_int_equal(octree_measure(&session.tree).cells, 4 * 8 * 8);
    session_clear(&session);
}

static void a_drag_that_does_nothing_is_told(void **state)
{
    (void)state;
    open_new(4);
    session.radius = 0.1;
    for (int tool = 0; tool < TOOLS; tool++) {
        const bool once = tool == TOOL_SPHERE || tool == TOOL_BOX || tool == TOOL_CYLINDER;
        session.tool = (enum session_tool)tool;
        aim(0.3, 0.5);
        assert_ok(session_press(&session, &err), &err);
        aim(0.38, 0.5); /* a hand that trembles */
        assert_null(session_why_no_drag(&session));
        aim(0.6, 0.5);
        assert_int_equal(session_why_no_drag(&session) != NULL, once);
        assert_ok(session_release(&session, &err), &err);
        assert_null(session_why_no_drag(&session));
    }
    session_clear(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_tool_does_what_its_line_in_a_script_would),
        cmocka_unit_test(a_stroke_is_one_step_of_capsules),
        cmocka_unit_test(a_cut_takes_what_lies_to_the_right_of_the_line),
        cmocka_unit_test(mirror_makes_both_halves_one_step),
        cmocka_unit_test(beside_the_sculpture_a_click_does_nothing),
        cmocka_unit_test(a_press_that_begins_nothing_says_why),
        cmocka_unit_test(the_brush_keeps_to_the_grid_and_to_its_limits),
        cmocka_unit_test(what_is_saved_is_what_is_opened_and_its_log_replays),
        cmocka_unit_test(work_that_was_not_saved_is_taken_up_again),
        cmocka_unit_test(work_that_was_taken_up_can_be_taken_up_again),
        cmocka_unit_test(what_the_journal_cannot_keep_is_taken_back),
        cmocka_unit_test(two_hands_cannot_carve_one_sculpture),
        cmocka_unit_test(bricks_have_all_faces_and_change_only_where_a_chip_fell),
        cmocka_unit_test(a_drag_that_does_nothing_is_told),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
