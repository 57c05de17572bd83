/* What a run leaves, its meshes, pieces, log and checkpoint, where memory ends and files fail. */
#include "../unit/balloon.h"
#include "faulty.h"
#include "sim/checkpoint.h"
#include "sim/log.h"
#include "sim/mesh_series.h"
#include "sim/motion_cache.h"
#include "sim/piece_table.h"

static struct balloon balloon;

static int enter(void **state)
{
    open_balloon(&balloon, 1, SETTINGS("balloons[0].pressure=1"));
    return enter_memory(state);
}

static int leave(void **state)
{
    close_balloon(&balloon);
    return leave_folder(state);
}

#define LIST "mesh.ply.series"

/* Does something with the balloon in a folder that holds this list of meshes (NULL: none), each call failing
 * in turn. Afterwards there are `good` files or, where a failure is told, no more. */
static void check_run(enum status (*act)(struct error *err), const char *list, int good)
{
    for (int i = 0; i < 2; i++)
        for (struct fault fault = {.kinds = fault_kinds[i]}; fault_next(&fault);) {
            struct error err = {0};
            if (list)
                write_text(LIST, list);
            fault_begin(&fault);
            const enum status status = act(&err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_true(status ? files_here() <= good : files_here() == good);
            clear_folder();
        }
}

/* Two meshes from this number on, and the list. */
static enum status add_meshes(uint64_t first, struct error *err)
{
    const struct mesh_series_options options = {.folder = ".", .first = first};
    struct mesh_series *series = NULL;
    size_t removed;
    enum status status = mesh_series_open(&balloon.sim, &options, &series, err);
    for (int i = 0; i < 2 && !status; i++)
        status = mesh_series_add(series, err);
    const enum status closed = mesh_series_close(series, &removed, status ? NULL : err);
    return status ? status : closed;
}

static enum status begin_series(struct error *err)
{
    return add_meshes(0, err);
}

static enum status go_on_with_series(struct error *err)
{
    return add_meshes(2, err);
}

static void a_series_of_meshes_is_written_or_it_is_said_why_not(void **state)
{
    (void)state;
    check_run(begin_series, NULL, 3);
    check_run(go_on_with_series,
              "{\"files\": [{\"name\": \"mesh_0000.ply\", \"time\": 0},\n"
              "{\"name\": \"mesh_0001.ply\", \"time\": 1}]}\n",
              3);
}

static enum status write_motion(struct error *err)
{
    struct motion_cache *cache = NULL;
    enum status status = motion_cache_open(&balloon.sim, "motion.pc2", 0, &cache, err);
    if (status)
        return status;
    motion_cache_add(cache);
    return motion_cache_close(cache, err);
}

static void a_cache_of_motion_is_written_or_it_is_said_why_not(void **state)
{
    (void)state;
    check_run(write_motion, NULL, 2);
}

static enum status write_pieces(struct error *err)
{
    struct piece_table table = {0};
    enum status status = piece_table_make(&balloon.sim, &table, err);
    assert_int_equal(table.count, status ? 0 : 1);
    if (!status)
        status = piece_table_save(&table, "pieces.tsv", err);
    piece_table_clear(&table);
    return status;
}

static void a_table_of_pieces_is_written_or_it_is_said_why_not(void **state)
{
    (void)state;
    check_run(write_pieces, NULL, 1);
}

/* The log's rows so far go into the checkpoint. */
static enum status write_checkpoint(struct error *err)
{
    const struct sim_log_options options = {.keep = true};
    struct checkpoint_run run = {.first_break = -1};
    struct sim_log *log = NULL;
    enum status status = sim_log_open("log.tsv", &options, &log, err);
    if (status)
        return status;
    sim_log_row(log, &balloon.sim, 0);
    run.rows = (char *)sim_log_rows(log, &run.row_bytes);
    status = run.rows ? checkpoint_save(&balloon.sim, &run, "run.ck", err) : error_no_memory(err, "the rows");
    if (!status)
        return sim_log_close(log, err);
    sim_log_abandon(log);
    return status;
}

static void a_checkpoint_with_its_log_is_written_or_it_is_said_why_not(void **state)
{
    (void)state;
    check_run(write_checkpoint, NULL, 2);
}

/* Keys cut short would be another scene's. */
static void a_scenes_keys_are_whole_or_not_there(void **state)
{
    (void)state;
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        fault_begin(&fault);
        char *keys = checkpoint_keys(&balloon.sim);
        fault_end(&fault);
        assert_true(fault.failed ? !keys : keys != NULL);
        free(keys);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_series_of_meshes_is_written_or_it_is_said_why_not),
        cmocka_unit_test(a_cache_of_motion_is_written_or_it_is_said_why_not),
        cmocka_unit_test(a_table_of_pieces_is_written_or_it_is_said_why_not),
        cmocka_unit_test(a_checkpoint_with_its_log_is_written_or_it_is_said_why_not),
        cmocka_unit_test(a_scenes_keys_are_whole_or_not_there),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
