/* .oct files: what is saved is loaded, and nothing else is. */
#include "check.h"
#include "common/crc.h"
#include "common/file.h"
#include "common/octree.h"
#include "common/octree_code.h"
#include "common/random.h"

#include <unistd.h>

static char folder[] = "/tmp/balloon-oct-XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(folder) || chdir(folder);
}

static int leave_folder(void **state)
{
    (void)state;
    unlink("a.oct");
    unlink("b.oct");
    return rmdir(folder);
}

static struct octree random_tree(unsigned depth, int materials, uint64_t seed)
{
    struct octree tree = {0};
    struct error err = {0};
    assert_ok(octree_init(&tree, depth, 1, &err), &err);
    for (int i = 0; i < 300; i++) {
        uint64_t bits = random_bits(&seed);
        int mask = (1 << depth) - 1;
        assert_ok(octree_set(&tree, (int)(bits & mask), (int)(bits >> 10 & mask), (int)(bits >> 20 & mask),
                             (unsigned)((bits >> 32) % (unsigned)materials), &err),
                  &err);
    }
    return tree;
}

static void assert_round_trip(const struct octree *tree)
{
    struct octree back = {0};
    struct error err = {0};
    assert_ok(octree_save(tree, "a.oct", &err), &err);
    assert_ok(octree_load("a.oct", &back, &err), &err);
    assert_true(octree_equal(tree, &back));
    assert_memory_equal(tree->coefficient, back.coefficient, sizeof back.coefficient);
    octree_clear(&back);
}

static void trees_of_every_depth_and_many_materials_come_back(void **state)
{
    (void)state;
    static const int materials[] = {1, 2, 3, 4, 5, 17, 256};
    for (unsigned i = 0; i < sizeof materials / sizeof *materials; i++)
        for (unsigned depth = i % 2; depth <= OCTREE_DEPTH_MAX; depth += 2) {
            struct octree tree = random_tree(depth, materials[i], depth + 100 * i);
            tree.coefficient[2] = i % 3 ? 1 : -0.375f;
            assert_round_trip(&tree);
            octree_clear(&tree);
        }
}

static struct bytes contents(const char *path)
{
    struct error err = {0};
    struct bytes bytes = {0};
    assert_ok(file_read(path, &bytes, &err), &err);
    return bytes;
}

static void equal_sculptures_are_equal_files(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = random_tree(5, 3, 1), again = random_tree(5, 3, 1);
    for (int i = 0; i < 2; i++) /* other blocks, same cells */
        assert_ok(octree_set(&again, 4, 4, 4, i ? octree_at(&tree, 4, 4, 4) : 9, &err), &err);
    assert_ok(octree_save(&tree, "a.oct", &err), &err);
    assert_ok(octree_save(&again, "b.oct", &err), &err);
    struct bytes a = contents("a.oct"), b = contents("b.oct");
    assert_int_equal(a.size, b.size);
    assert_memory_equal(a.data, b.data, a.size);
    bytes_clear(&a);
    bytes_clear(&b);
    octree_clear(&tree);
    octree_clear(&again);
}

/* Without the care for the disk that file_out takes, which would cost seconds here. */
static void write_file(const unsigned char *data, size_t size)
{
    unlink("b.oct"); /* a file that is cut to nothing and rewritten is flushed by some file systems */
    FILE *stream = fopen("b.oct", "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

/* Loading these bytes must fail with `part` in the message, and leave the tree that was there. */
static void assert_rejected(const unsigned char *data, size_t size, const char *part)
{
    struct error err = {0};
    struct octree tree = {.root = 7, .depth = 2};
    write_file(data, size);
    assert_refused(octree_load("b.oct", &tree, &err), STATUS_INPUT, part, &err);
    assert_non_null(strstr(err.text, "b.oct: "));
    assert_int_equal(tree.root, 7);
    assert_int_equal(tree.depth, 2);
}

static struct bytes sample(void)
{
    struct error err = {0};
    struct octree tree = random_tree(3, 3, 5);
    tree.coefficient[1] = 2;
    assert_ok(octree_save(&tree, "a.oct", &err), &err);
    octree_clear(&tree);
    return contents("a.oct");
}

static void every_truncation_is_refused(void **state)
{
    (void)state;
    struct bytes file = sample();
    assert_rejected(file.data, 0, "the file is empty");
    for (size_t size = 1; size < file.size; size++)
        assert_rejected(file.data, size, size < 8 ? "signature" : "cut short");
    bytes_clear(&file);
}

static void every_flipped_bit_is_found(void **state)
{
    (void)state;
    struct bytes file = sample();
    for (size_t bit = 0; bit < 8 * file.size; bit++) {
        file.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        assert_rejected(file.data, file.size, bit < 64 ? "signature" : "chunk");
        file.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    bytes_clear(&file);
}

/* A file being made by hand, with sound checksums. */
struct forgery {
    unsigned char data[512];
    size_t size;
};

static struct forgery forge(void)
{
    return (struct forgery){{0x89, 'o', 'c', 't', '\r', '\n', 0x1a, '\n'}, 8};
}

static void add_number(struct forgery *file, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        file->data[file->size++] = (unsigned char)(value >> 8 * i);
}

static void add_chunk(struct forgery *file, const char *name, const void *data, size_t size)
{
    size_t start = file->size;
    memcpy(file->data + start, name, 4);
    file->size += 4;
    add_number(file, size, 4);
    if (size > 0)
        memcpy(file->data + file->size, data, size);
    file->size += size;
    add_number(file, crc32_bytes(0, file->data + start, 8 + size), 4);
}

static void add_head(struct forgery *file, unsigned version, unsigned depth, uint64_t leaves)
{
    struct forgery head = {.size = 0};
    add_number(&head, version, 4);
    add_number(&head, depth, 4);
    add_number(&head, leaves, 8);
    add_chunk(file, "HEAD", head.data, head.size);
}

/* Refused with this message when the cells are these bytes. */
static void assert_cells_rejected(unsigned depth, uint64_t leaves, const char *cells, size_t size,
                                  const char *part)
{
    struct forgery file = forge();
    add_head(&file, 1, depth, leaves);
    add_chunk(&file, "TREE", cells, size);
    add_chunk(&file, "END ", NULL, 0);
    assert_rejected(file.data, file.size, part);
}

static void a_file_made_by_hand_is_read(void **state)
{
    (void)state;
    struct forgery file = forge();
    struct error err = {0};
    struct octree tree = {0};
    add_head(&file, 1, 1, 8);
    add_chunk(&file, "Prvw", "unknown chunks are skipped", 26);
    /* two materials, 0 and 5; a split node, then cells 0 0 0 0 5 0 0 5 */
    add_chunk(&file, "TREE", "\1\0\5\x21\1", 5);
    add_chunk(&file, "END ", NULL, 0);
    write_file(file.data, file.size);
    assert_ok(octree_load("b.oct", &tree, &err), &err);
    assert_int_equal(octree_leaf_count(&tree), 8);
    assert_int_equal(octree_at(&tree, 0, 0, 1), 5);
    assert_int_equal(octree_at(&tree, 1, 1, 1), 5);
    assert_int_equal(octree_at(&tree, 1, 0, 1), 0);
    octree_clear(&tree);
}

static void cells_that_no_octree_has_are_refused(void **state)
{
    (void)state;
    assert_cells_rejected(1, 8, "\1\0\5\1\0", 5, "chunk TREE: a node is split into eight equal leaves");
    assert_cells_rejected(1, 8, "\1\0\5\x21", 4, "chunk TREE: the cells end early");
    assert_cells_rejected(1, 8, "\1\0\5\x21\1\0", 6, "chunk TREE: there are bytes left over");
    assert_cells_rejected(1, 8, "\1\0\5\x21\3", 5, "chunk TREE: the bits after the last cell are not zero");
    assert_cells_rejected(0, 1, "\1\0\5\0", 4, "chunk TREE: a material is listed but not in use");
    assert_cells_rejected(0, 1, "\2\0\5\6\3", 5, "chunk TREE: a leaf has a material that is not among");
    assert_cells_rejected(0, 1, "\1\5\5\0", 4, "chunk TREE: the list of materials is not in ascending order");
    assert_cells_rejected(0, 1, "\7\5\6", 3, "chunk TREE: the list of materials is cut short");
    assert_cells_rejected(0, 1, "", 0, "chunk TREE: the list of materials is cut short");
}

static void a_depth_or_count_that_lies_is_refused(void **state)
{
    (void)state;
    assert_cells_rejected(11, 8, "\1\0\5\x21\1", 5, "chunk HEAD: depth 11; at most 10");
    assert_cells_rejected(2, 8, "\1\0\5\x21\1", 5, "chunk TREE: ");
    assert_cells_rejected(0, 8, "\1\0\5\x21\1", 5, "chunk TREE: there are bytes left over");
    assert_cells_rejected(1, 7, "\1\0\5\x21\1", 5, "chunk HEAD: claims 7 leaves, chunk TREE has 8");
    assert_cells_rejected(1, UINT64_MAX, "\1\0\5\x21\1", 5, "chunk HEAD: claims 18446744073709551615 leaves");
}

static void a_newer_version_is_named(void **state)
{
    (void)state;
    struct forgery file = forge();
    add_head(&file, 2, 0, 1);
    assert_rejected(file.data, file.size,
                    "chunk HEAD: version 2 of the format; this program reads version 1");
}

static void missing_repeated_and_misplaced_chunks_are_refused(void **state)
{
    (void)state;
    struct forgery file = forge();
    add_chunk(&file, "TREE", "\0\1\0", 3);
    assert_rejected(file.data, file.size, "chunk TREE: comes before the chunk HEAD");
    file = forge();
    add_head(&file, 1, 0, 1);
    add_head(&file, 1, 0, 1);
    assert_rejected(file.data, file.size, "chunk HEAD: is there twice");
    file = forge();
    add_head(&file, 1, 0, 1);
    add_chunk(&file, "TREE", "\0\1", 2);
    add_chunk(&file, "TREE", "\0\1", 2);
    assert_rejected(file.data, file.size, "chunk TREE: is there twice");
    file = forge();
    add_head(&file, 1, 0, 1);
    add_chunk(&file, "END ", NULL, 0);
    assert_rejected(file.data, file.size, "the chunk TREE is missing");
    file = forge();
    add_head(&file, 1, 0, 1);
    add_chunk(&file, "TREE", "\0\1", 2);
    add_chunk(&file, "END ", NULL, 0);
    add_chunk(&file, "END ", NULL, 0);
    assert_rejected(file.data, file.size, "chunk END: 12 bytes follow it");
    file = forge();
    add_chunk(&file, "HEAD", "\1\0\0\0\1", 5);
    assert_rejected(file.data, file.size, "chunk HEAD: has 5 bytes, must have 16");
}

static void coefficients_out_of_order_or_range_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *data;
        size_t size;
        const char *part;
    } cases[] = {
        {"\1\0\0\x80\x7f", 5, "chunk COEF: coefficient inf of material 1"},
        {"\1\0\0\xc0\x7f", 5, "chunk COEF: coefficient nan of material 1"},
        {"\1\0\0\x7a\x45", 5, "chunk COEF: coefficient 4000 of material 1; must be within +-1000"},
        {"\0\0\0\0\0", 5, "ascending order from 1"},
        {"\2\0\0\0\0\2\0\0\0\0", 10, "ascending order from 1"},
        {"\2\0\0\0", 4, "no multiple of 5"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct forgery file = forge();
        add_head(&file, 1, 0, 1);
        add_chunk(&file, "COEF", cases[i].data, cases[i].size);
        assert_rejected(file.data, file.size, cases[i].part);
    }
}

static void random_bytes_as_cells_never_do_harm(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 20000; i++) {
        unsigned char bytes[64];
        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (unsigned char)random_bits(&seed);
        bytes[0] &= 3;
        for (unsigned char k = 0; k <= bytes[0]; k++)
            bytes[1 + k] = k;
        struct octree tree = {.depth = (unsigned)(i % (OCTREE_DEPTH_MAX + 1))};
        octree_decode(bytes, 5 + (size_t)i % 60, &tree, NULL);
        octree_clear(&tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_of_every_depth_and_many_materials_come_back),
        cmocka_unit_test(equal_sculptures_are_equal_files),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_flipped_bit_is_found),
        cmocka_unit_test(a_file_made_by_hand_is_read),
        cmocka_unit_test(cells_that_no_octree_has_are_refused),
        cmocka_unit_test(a_depth_or_count_that_lies_is_refused),
        cmocka_unit_test(a_newer_version_is_named),
        cmocka_unit_test(missing_repeated_and_misplaced_chunks_are_refused),
        cmocka_unit_test(coefficients_out_of_order_or_range_are_refused),
        cmocka_unit_test(random_bytes_as_cells_never_do_harm),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
