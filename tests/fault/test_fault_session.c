/* Sculpting by hand where memory ends, files fail and no thread can be had. */
#include "../unit/saving.h"
#include "../unit/trees.h"
#include "faulty.h"

/* A sculpture with a log, and with a chunk that is not known here. */
static void save_begun(void)
{
    struct error err = {0};
    struct octree tree = new_tree(4, 1);
    struct octree_chunks chunks = {0};
    struct bytes log = {(unsigned char *)strdup("depth 4\n"), 8},
                 next = {(unsigned char *)strdup("a note"), 6};
    assert_ok(octree_chunks_put(&chunks, OCTREE_CHUNK_LOG, &log, &err), &err);
    assert_ok(octree_chunks_put(&chunks, "NEXT", &next, &err), &err);
    assert_ok(octree_save_with(&tree, &chunks, "a.oct", &err), &err);
    octree_chunks_clear(&chunks);
    octree_clear(&tree);
}

static enum status click(struct session *session, struct error *err)
{
    session_aim(session, (double[3]){0.3, 0.3, 3}, (double[3]){0, 0, -1});
    const enum status status = session_press(session, err);
    return status ? status : session_release(session, err);
}

/* Opens it, carves a hole and saves. */
static enum status carve(struct session *session, struct error *err)
{
    enum status status = session_open(session, "a.oct", 4, true, err);
    if (!status)
        status = click(session, err);
    return status ? status : save_now(session, NULL, err);
}

/* The file is what it was or what was carved, with its log and the chunk. */
static void assert_file(bool carved)
{
    struct error err = {0};
    struct octree tree = {0};
    struct octree_chunks chunks = {0};
    assert_ok(octree_load_with("a.oct", &tree, &chunks, &err), &err);
    assert_int_equal(octree_at(&tree, 4, 4, 15), carved ? 0 : 1);
    assert_non_null(octree_chunks_find(&chunks, OCTREE_CHUNK_LOG));
    assert_non_null(octree_chunks_find(&chunks, "NEXT"));
    octree_chunks_clear(&chunks);
    octree_clear(&tree);
}

/* Where the journal's file fails there is none, which is no failure; without a thread it is saved at once. */
static void what_is_carved_is_saved_whole_or_the_old_file_stays(void **state)
{
    (void)state;
    static const unsigned kinds[] = {FAULT_MEMORY, FAULT_FILES, FAULT_STARTS};
    for (int i = 0; i < 3; i++)
        for (struct fault fault = {.kinds = kinds[i]}; fault_next(&fault);) {
            struct error err = {0};
            struct session session = {0};
            save_begun();
            fault_begin(&fault);
            const enum status status = carve(&session, &err);
            fault_end(&fault);
            assert_true(!status || (fault.failed && kinds[i] != FAULT_STARTS));
            assert_says(status, &err, fault.kinds);
            session_clear(&session);
            assert_file(!status);
            assert_int_equal(files_here(), 1);
        }
}

/* Heat carves in several goes. Where there is no memory for what was there before, that is known too: no
 * script is said to make what there is now. */
static void a_step_that_fails_is_taken_back_whole(void **state)
{
    (void)state;
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        struct error err = {0};
        struct session session = {0};
        struct octree before = {0};
        assert_ok(session_open(&session, "b.oct", 6, false, &err), &err);
        assert_ok(click(&session, &err), &err);
        assert_ok(octree_copy(&before, &session.tree, &err), &err);
        session.tool = TOOL_HEAT;
        session.mirror = CHIP_MIRROR_X;
        session.radius = 0.3;
        fault_begin(&fault);
        const enum status status = click(&session, &err);
        fault_end(&fault);
        if (status)
            (void)session_release(&session, &err);
        if (status && !session.log_lost)
            assert_true(octree_equal(&session.tree, &before));
        if (status)
            assert_int_equal(session.log.count, 2);
        octree_clear(&before);
        session_clear(&session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_carved_is_saved_whole_or_the_old_file_stays),
        cmocka_unit_test(a_step_that_fails_is_taken_back_whole),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
