/* Files that are no checkpoints, damaged ones, and those of another version: each is
 * refused with what is wrong. */
#include "checkpoints.h"
#include "common/crc.h"
#include "common/file.h"

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

/* Finds the block of this name in the file's bytes, flips a bit of its first byte, and
 * makes the checksum match. */
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

/* Reads a.ck; returns where its first chunk of this name is, or what begins with that, and the
 * size of what is in it. */
static unsigned char *read_chunk(const char *name, struct bytes *file, uint64_t *size)
{
    struct error err = {0};
    assert_ok(file_read("a.ck", file, &err), &err);
    unsigned char *head = memmem(file->data, file->size, name, strlen(name));
    assert_non_null(head);
    memcpy(size, head + 4, sizeof *size);
    return head;
}

/* Writes a.ck anew with the chunk whose bytes begin with `block` behind its head changed: its name, or its
 * size (the rest of the file follows), with the checksum that it then must have. */
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

/* Sets a byte of what is in the first chunk of this name in a.ck, with the checksum
 * that it then must have. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_that_is_no_checkpoint_is_refused),
        cmocka_unit_test(damage_anywhere_is_found),
        cmocka_unit_test(what_is_sound_and_yet_no_state_is_refused),
        cmocka_unit_test(points_that_are_nowhere_are_no_state),
        cmocka_unit_test(chunks_that_are_others_than_they_must_be_are_named),
        cmocka_unit_test(what_another_version_wrote_is_refused_with_what_differs),
    };
    return cmocka_run_group_tests(tests, enter_memory, leave_folder);
}
