/* What an .oct file carries besides the octree comes back, and does not get in an older reader's way. */
#include "common/octree_chunks.h"
#include "folder.h"

static struct bytes copy_of(const char *text)
{
    return (struct bytes){(unsigned char *)strdup(text), strlen(text)};
}

static void put(struct octree_chunks *chunks, const char *name, const char *text)
{
    struct error err = {0};
    struct bytes data = copy_of(text);
    assert_ok(octree_chunks_put(chunks, name, &data, &err), &err);
    assert_null(data.data);
}

static void assert_chunk(const struct octree_chunks *chunks, const char *name, const char *text)
{
    const struct octree_chunk *chunk = octree_chunks_find(chunks, name);
    assert_non_null(chunk);
    assert_int_equal(chunk->data.size, strlen(text));
    assert_string_equal((const char *)chunk->data.data, text);
}

/* A half-full cube with a log, a chunk of nothing and one that nobody knows. */
static void save_example(const char *path)
{
    struct error err = {0};
    struct octree tree = {0};
    struct octree_chunks chunks = {0};
    put(&chunks, OCTREE_CHUNK_LOG, "depth 3\n");
    put(&chunks, "NONE", "");
    put(&chunks, "What", "ever");
    assert_ok(octree_init(&tree, 3, 1, &err), &err);
    assert_ok(octree_set(&tree, 1, 2, 3, 0, &err), &err);
    assert_ok(octree_save_with(&tree, &chunks, path, &err), &err);
    octree_chunks_clear(&chunks);
    octree_clear(&tree);
}

static void chunks_come_back_in_their_order(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct octree_chunks chunks = {0};
    save_example("a.oct");
    put(&chunks, "OLD ", "is replaced");
    assert_ok(octree_load_with("a.oct", &tree, &chunks, &err), &err);
    assert_int_equal(chunks.count, 3);
    assert_chunk(&chunks, OCTREE_CHUNK_LOG, "depth 3\n");
    assert_chunk(&chunks, "NONE", "");
    assert_chunk(&chunks, "What", "ever");
    assert_string_equal(chunks.items[2].name, "What");
    assert_null(octree_chunks_find(&chunks, OCTREE_CHUNK_PREVIEW));
    assert_int_equal(octree_at(&tree, 1, 2, 3), 0);
    octree_chunks_clear(&chunks);
    octree_clear(&tree);
}

static void who_does_not_ask_for_chunks_reads_the_same_octree(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree with = {0}, without = {0};
    struct octree_chunks chunks = {0};
    save_example("a.oct");
    assert_ok(octree_load_with("a.oct", &with, &chunks, &err), &err);
    assert_ok(octree_load("a.oct", &without, &err), &err);
    assert_true(octree_equal(&with, &without));
    octree_chunks_clear(&chunks);
    octree_clear(&with);
    octree_clear(&without);
}

static void a_chunk_of_the_same_name_is_replaced(void **state)
{
    (void)state;
    struct octree_chunks chunks = {0};
    put(&chunks, "ONE ", "first");
    put(&chunks, "TWO ", "other");
    put(&chunks, "ONE ", "second");
    assert_int_equal(chunks.count, 2);
    assert_chunk(&chunks, "ONE ", "second");
    octree_chunks_clear(&chunks);
}

/* Every bit counts: a damaged chunk is named, and what the caller had stays. */
static void a_flipped_bit_of_a_chunk_is_found_and_nothing_is_replaced(void **state)
{
    (void)state;
    struct error err = {0};
    struct bytes bytes = {0};
    struct octree tree = {0};
    struct octree_chunks chunks = {0};
    put(&chunks, "MINE", "kept");
    save_example("a.oct");
    assert_ok(file_read("a.oct", &bytes, &err), &err);
    unsigned char *log = memmem(bytes.data, bytes.size, "CHIP", 4);
    assert_non_null(log);
    for (size_t bit = 8 * 8; bit < 8 * (8 + strlen("depth 3\n") + 4); bit++) {
        log[bit / 8] ^= (unsigned char)(1u << bit % 8);
        write_bytes("b.oct", bytes.data, bytes.size);
        assert_refused(octree_load_with("b.oct", &tree, &chunks, &err), STATUS_INPUT, "b.oct: chunk CHIP",
                       &err);
        log[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    assert_int_equal(chunks.count, 1);
    assert_chunk(&chunks, "MINE", "kept");
    octree_chunks_clear(&chunks);
    bytes_clear(&bytes);
}

/* The size alone says so: nothing is there to be read, and no file is begun. */
static void a_chunk_whose_size_needs_more_than_32_bits_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    struct octree_chunk large = {.name = "LARG", .data = {NULL, (size_t)UINT32_MAX + 1}};
    const struct octree_chunks chunks = {.items = &large, .count = 1};
    assert_refused(octree_save_with(&tree, &chunks, "large.oct", &err), STATUS_RANGE,
                   "large.oct: chunk LARG has 4294967296 bytes; at most 4294967295 are possible", &err);
    assert_int_equal(access("large.oct", F_OK), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_chunk_whose_size_needs_more_than_32_bits_is_refused),
        cmocka_unit_test(chunks_come_back_in_their_order),
        cmocka_unit_test(who_does_not_ask_for_chunks_reads_the_same_octree),
        cmocka_unit_test(a_chunk_of_the_same_name_is_replaced),
        cmocka_unit_test(a_flipped_bit_of_a_chunk_is_found_and_nothing_is_replaced),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
