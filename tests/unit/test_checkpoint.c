/* Checkpoints: a run that is resumed is equal to the bit to one that never stopped, and damage is found. */
#include "balloon.h"
#include "common/crc.h"
#include "common/file.h"
#include "folder.h"
#include "sim/checkpoint.h"
#include "sim/ledger.h"
#include "sim/log.h"

static enum status save(struct sim *sim, const char *path, struct error *err)
{
    const struct checkpoint_run run = {
        .first_break = -1, .seconds = 2.5, .shown = 7, .rows = "row\n", .row_bytes = 4};
    return checkpoint_save(sim, &run, path, err);
}

static enum status load(struct sim *sim, const char *path, struct error *err)
{
    struct checkpoint_run run = {0};
    enum status status = checkpoint_load(path, sim, &run, err);
    free(run.rows);
    return status;
}

enum { STEPS = 30, AHEAD = 5 };

/* A run that bursts on the way: saved and resumed after each of its steps, it goes on as it did, every sixth time to the end. */
static void check_resuming(const char *const *changes, unsigned workers)
{
    struct error err = {0};
    struct balloon b;
    uint64_t hash[STEPS + 1];
    open_balloon(&b, 1, changes);
    for (int i = 0; i <= STEPS; i++) {
        char name[32];
        snprintf(name, sizeof name, "%d.ck", i);
        hash[i] = sim_hash(&b.sim);
        assert_ok(save(&b.sim, name, &err), &err);
        if (i < STEPS)
            steps(&b, 1);
    }
    assert_true(b.sim.broken > 0);
    for (int i = 0; i <= STEPS; i++) {
        char name[32];
        struct sim sim;
        snprintf(name, sizeof name, "%d.ck", i);
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers, &err), &err);
        assert_ok(load(&sim, name, &err), &err);
        const int last = i % 6 == 0 || i + AHEAD > STEPS ? STEPS : i + AHEAD;
        for (int at = i; at <= last; at++) {
            if (sim_hash(&sim) != hash[at])
                fail_msg("%s: resumed after step %d, it is another run at step %d", b.sim.integrator->name, i,
                         at);
            if (at < last)
                assert_ok(sim_step(&sim, &err), &err);
        }
        sim_clear(&sim);
        unlink(name);
    }
    close_balloon(&b);
}

static void a_resumed_run_is_equal_to_the_bit_to_one_that_never_stopped(void **state)
{
    (void)state;
    for (size_t i = 0; integrators[i]; i++) {
        char name[64];
        snprintf(name, sizeof name, "time.integrator=%s", integrators[i]->name);
        check_resuming(SETTINGS(name, "balloons[0].pressure=40", "balloons[0].threshold=1.1",
                                "schedule[0].at=0.2", "schedule[0].pressure=50", "schedule[1].at=0.3",
                                "schedule[1].step=0.02", "balloons[0].rip.at=0.35"),
                       (unsigned)i % 3 + 1);
    }
}

static void a_checkpoint_carries_what_the_program_knows_of_the_run(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    struct checkpoint_run run = {0};
    assert_ok(checkpoint_load("a.ck", &b.sim, &run, &err), &err);
    assert_near(run.first_break, -1, 0);
    assert_near(run.seconds, 2.5, 0);
    assert_int_equal(run.shown, 7);
    assert_int_equal(run.row_bytes, 4);
    assert_string_equal(run.rows, "row\n");
    free(run.rows);
    unlink("a.ck");
    close_balloon(&b);
}

/* The accounts go along where they are kept, begin where they were not, and are left behind where nobody wants them. */
static void the_ledger_goes_along(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b, with, without;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    open_balloon(&with, 1, SETTINGS("balloons[0].pressure=10"));
    open_balloon(&without, 1, SETTINGS("balloons[0].pressure=10"));
    assert_ok(ledger_open(&b.sim, &err), &err);
    assert_ok(ledger_open(&with.sim, &err), &err);
    steps(&b, 5);
    assert_ok(save(&b.sim, "with.ck", &err), &err);
    assert_ok(load(&without.sim, "with.ck", &err), &err);
    assert_ok(save(&without.sim, "without.ck", &err), &err);
    assert_ok(load(&with.sim, "with.ck", &err), &err);
    steps(&b, 5);
    steps(&with, 5);
    steps(&without, 5);
    assert_true(sim_hash(&with.sim) == sim_hash(&without.sim));
    struct sim_measures m = sim_measure(&b.sim);
    const struct ledger_balance wanted = ledger_balance(&b.sim, &m), got = ledger_balance(&with.sim, &m);
    assert_memory_equal(&got, &wanted, sizeof got);

    assert_ok(load(&with.sim, "without.ck", &err), &err);
    m = sim_measure(&with.sim);
    assert_near(ledger_balance(&with.sim, &m).pressure_work, 0, 0);
    assert_near(ledger_balance(&with.sim, &m).error, 0, 1e-12 * m.kinetic_energy);
    unlink("with.ck");
    unlink("without.ck");
    close_balloon(&b);
    close_balloon(&with);
    close_balloon(&without);
}

static void another_scene_is_refused_with_the_key_that_differs(void **state)
{
    (void)state;
    static const struct {
        const char *change, *message;
    } cases[] = {
        {"balloons[0].pressure=12", "a.ck: is of another scene: balloons[0].pressure is 12, and was 10"},
        {"time.integrator=explicit-euler", "time.integrator is explicit-euler, and was symplectic-euler"},
        {"balloons[0].rip.at=1", "balloons[0].rip.at is 1, and was not there"},
        {"balloons[0].radius=44", "balloons[0].radius is 44, and was 45"},
        {"schedule[0].pressure=1", "schedule[0].at is 0, and was not there"},
    };
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=10"));
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct balloon other;
        open_balloon(&other, 1, SETTINGS(cases[i].change));
        assert_refused(load(&other.sim, "a.ck", &err), STATUS_INPUT, cases[i].message, &err);
        close_balloon(&other);
    }
    struct balloon finer;
    open_balloon(&finer, 2, SETTINGS("balloons[0].pressure=10"));
    assert_refused(load(&finer.sim, "a.ck", &err), STATUS_INPUT, "other points, edges or triangles", &err);
    close_balloon(&finer);
    b.mesh.position[3][1] += 1e-9; /* as many points, and one of them elsewhere */
    sim_clear(&b.sim);
    assert_ok(sim_open(&b.sim, &b.scene, &b.mesh, 1, &err), &err);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "other points, edges or triangles", &err);
    unlink("a.ck");
    close_balloon(&b);
}

static void a_file_that_is_no_checkpoint_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    assert_refused(load(&b.sim, "none.ck", &err), STATUS_FILE, "none.ck: cannot open", &err);
    write_bytes("a.ck", "", 0);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "a.ck: not a checkpoint", &err);
    write_bytes("a.ck", "time = { };", 11);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "not a checkpoint", &err);
    unlink("a.ck");
    close_balloon(&b);
}

/* Every byte flipped, and every length: a message each time, that names the chunk where there is one. */
static void damage_anywhere_is_found(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    struct bytes good = {0};
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    steps(&b, 2);
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    assert_ok(file_read("a.ck", &good, &err), &err);
    for (size_t at = 0; at < good.size; at++) {
        good.data[at] ^= 0x20;
        write_bytes("a.ck", good.data, good.size);
        assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, at < 8 ? "not a checkpoint" : "chunk ",
                       &err);
        good.data[at] ^= 0x20;
        write_bytes("a.ck", good.data, at);
        assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, at < 8 ? "not a checkpoint" : "cut short",
                       &err);
    }
    write_bytes("a.ck", good.data, good.size + 1);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "1 bytes follow chunk END", &err);
    bytes_clear(&good);
    unlink("a.ck");
    close_balloon(&b);
}

/* Finds the block of this name in the file's bytes, flips a bit of its first byte, and makes the checksum match. */
static void spoil(struct bytes *file, const char *block, unsigned char bit)
{
    unsigned char *name = memmem(file->data, file->size, block, strlen(block));
    assert_non_null(name);
    unsigned char *head = name - 4 - 12;
    uint64_t size;
    memcpy(&size, head + 4, sizeof size);
    name[strlen(block)] ^= bit;
    const uint32_t crc = crc32_bytes(0, head, 12 + size);
    memcpy(head + 12 + size, &crc, sizeof crc);
}

static void what_is_sound_and_yet_no_state_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *block;
        unsigned char bit;
    } cases[] = {{"edge active", 2}, {"triangle active", 0x80}, {"edges broke", 4}, {"substeps", 1}};
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bytes file = {0};
        steps(&b, 1);
        assert_ok(save(&b.sim, "a.ck", &err), &err);
        assert_ok(file_read("a.ck", &file, &err), &err);
        spoil(&file, cases[i].block, cases[i].bit);
        write_bytes("a.ck", file.data, file.size);
        struct sim sim;
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, 1, &err), &err);
        assert_refused(load(&sim, "a.ck", &err), STATUS_INPUT, "are no state", &err);
        sim_clear(&sim);
        bytes_clear(&file);
    }
    unlink("a.ck");
    close_balloon(&b);
}

/* Reads a.ck; returns where its first chunk of this name is, or what begins with that, and the size of what is in it. */
static unsigned char *read_chunk(const char *name, struct bytes *file, uint64_t *size)
{
    struct error err = {0};
    assert_ok(file_read("a.ck", file, &err), &err);
    unsigned char *head = memmem(file->data, file->size, name, strlen(name));
    assert_non_null(head);
    memcpy(size, head + 4, sizeof *size);
    return head;
}

/* Writes a.ck anew with the chunk whose bytes begin with `block` behind its head changed: its name, or its size (the rest of the
 * file follows), with the checksum that it then must have. */
static void change_chunk(const char *block, const char *name, size_t shorter)
{
    struct bytes file = {0};
    uint64_t size;
    unsigned char *head = read_chunk(block, &file, &size);
    unsigned char *end = head + 12 + size, *new_end = end - shorter;
    size -= shorter;
    memcpy(head, name, 4);
    memcpy(head + 4, &size, sizeof size);
    const uint32_t crc = crc32_bytes(0, head, 12 + size);
    memmove(new_end + 4, end + 4, (size_t)(file.data + file.size - end - 4));
    memcpy(new_end, &crc, sizeof crc);
    write_bytes("a.ck", file.data, file.size - shorter);
    bytes_clear(&file);
}

static void chunks_that_are_others_than_they_must_be_are_named(void **state)
{
    (void)state;
    static const struct {
        const char *block, *name;
        size_t shorter;
        const char *message;
    } cases[] = {
        {"KEYS", "KEYZ", 0, "chunk KEYZ at byte 40: here chunk KEYS must be"},
        {"HEAD", "HEAD", 4, "chunk HEAD at byte 8: was written by a machine with another order of bytes"},
        {"RUN ", "RUN ", 8, ": has another size than it must have"},
        {"ROWS", "ROWZ", 0, "here chunk ROWS must be"},
        {"END ", "END?", 0, "here chunk END  must be"},
    };
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_ok(save(&b.sim, "a.ck", &err), &err);
        change_chunk(cases[i].block, cases[i].name, cases[i].shorter);
        assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, cases[i].message, &err);
    }
    unlink("a.ck");
    close_balloon(&b);
}

/* Sets a byte of what is in the first chunk of this name in a.ck, with the checksum that it then must have. */
static void set_byte(const char *chunk, size_t at, unsigned char value)
{
    struct bytes file = {0};
    uint64_t size;
    unsigned char *head = read_chunk(chunk, &file, &size);
    assert_true(at < size);
    head[12 + at] = value;
    const uint32_t crc = crc32_bytes(0, head, 12 + size);
    memcpy(head + 12 + size, &crc, sizeof crc);
    write_bytes("a.ck", file.data, file.size);
    bytes_clear(&file);
}

static void what_another_version_wrote_is_refused_with_what_differs(void **state)
{
    (void)state;
    enum { NAME = 4 }; /* behind the name's length */
    static const struct {
        const char *chunk;
        size_t at;
        unsigned char value;
        const char *message;
    } cases[] = {
        {"HEAD", 0, 200, "chunk HEAD: version 200 of the format; this program reads version "},
        {"RUN ", 15, 0xff, ": its times are none"}, /* the sign of the seconds */
        {"DATA", 0, 65, ": has no name"},
        {"DATA", 1, 1, ": has no name"},
        {"DATA", NAME, '?', "must be; was it written by another version?"},
    };
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_ok(save(&b.sim, "a.ck", &err), &err);
        set_byte(cases[i].chunk, cases[i].at, cases[i].value);
        assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, cases[i].message, &err);
    }
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    change_chunk("DATA", "DATA", 1);
    assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, " here", &err);
    assert_non_null(strstr(err.text, " bytes, and must have "));
    unlink("a.ck");
    close_balloon(&b);
}

static void points_that_are_nowhere_are_no_state(void **state)
{
    (void)state;
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 0, SETTINGS("balloons[0].pressure=10"));
    double *const numbers[] = {&b.sim.position[0][2], &b.sim.velocity[b.sim.point_count - 1][0]};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const double was = *numbers[i];
        *numbers[i] = i ? INFINITY : NAN;
        assert_ok(save(&b.sim, "a.ck", &err), &err);
        assert_refused(load(&b.sim, "a.ck", &err), STATUS_INPUT, "are no state: a flag, a time or a point",
                       &err);
        *numbers[i] = was;
    }
    assert_ok(save(&b.sim, "a.ck", &err), &err);
    assert_ok(load(&b.sim, "a.ck", &err), &err);
    unlink("a.ck");
    close_balloon(&b);
}

/* As another version would have written it. */
static void a_log_of_other_columns_is_not_gone_on_with(void **state)
{
    (void)state;
    struct error err = {0};
    struct sim_log *log = NULL;
    const struct sim_log_options options = {.rows = "time\tvolume\n", .row_bytes = 12};
    assert_refused(sim_log_open("log.tsv", &options, &log, &err), STATUS_INPUT, "has other columns", &err);
    assert_null(log);
    assert_int_equal(access("log.tsv", F_OK), -1);
}

/* Hundreds of files that are synced: in memory, where the machine has room there. */
static int enter_memory(void **state)
{
    if (!access("/dev/shm", W_OK))
        strcpy(test_folder, "/dev/shm/balloon-XXXXXX");
    return enter_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resumed_run_is_equal_to_the_bit_to_one_that_never_stopped),
        cmocka_unit_test(a_checkpoint_carries_what_the_program_knows_of_the_run),
        cmocka_unit_test(the_ledger_goes_along),
        cmocka_unit_test(another_scene_is_refused_with_the_key_that_differs),
        cmocka_unit_test(a_file_that_is_no_checkpoint_is_refused),
        cmocka_unit_test(damage_anywhere_is_found),
        cmocka_unit_test(what_is_sound_and_yet_no_state_is_refused),
        cmocka_unit_test(points_that_are_nowhere_are_no_state),
        cmocka_unit_test(a_log_of_other_columns_is_not_gone_on_with),
        cmocka_unit_test(chunks_that_are_others_than_they_must_be_are_named),
        cmocka_unit_test(what_another_version_wrote_is_refused_with_what_differs),
    };
    return cmocka_run_group_tests(tests, enter_memory, leave_folder);
}
