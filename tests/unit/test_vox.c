/* MagicaVoxel models: made by hand byte by byte, wrong ones, and written and read back. */
#include "check.h"
#include "common/random.h"
#include "sculpt/sculpt.h"

#include <unistd.h>

static char folder[] = "/tmp/balloon-vox-XXXXXX";

static int enter_folder(void **state)
{
    (void)state;
    return !mkdtemp(folder) || chdir(folder);
}

static int leave_folder(void **state)
{
    (void)state;
    unlink("a.vox");
    return rmdir(folder);
}

/* A file being made. */
struct model {
    unsigned char data[4096];
    size_t size;
};

enum { MAIN_CHILDREN = 16, FIRST_CHUNK = 20 }; /* where they are in the file */

static void add_bytes(struct model *model, const void *bytes, size_t size)
{
    assert_true(size <= sizeof model->data - model->size);
    memcpy(model->data + model->size, bytes, size);
    model->size += size;
}

static void set_number(struct model *model, size_t at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        model->data[at + i] = (unsigned char)(value >> 8 * i);
}

static void add_number(struct model *model, uint32_t value)
{
    add_bytes(model, "\0\0\0", 4);
    set_number(model, model->size - 4, value);
}

static size_t begin_chunk(struct model *model, const char *name)
{
    add_bytes(model, name, 4);
    add_number(model, 0);
    add_number(model, 0);
    return model->size;
}

static void end_chunk(struct model *model, size_t contents)
{
    set_number(model, contents - 8, (uint32_t)(model->size - contents));
    set_number(model, MAIN_CHILDREN, (uint32_t)(model->size - FIRST_CHUNK));
}

static struct model new_model(void)
{
    struct model model = {.size = 0};
    add_bytes(&model, "VOX ", 4);
    add_number(&model, 150);
    begin_chunk(&model, "MAIN");
    return model;
}

static void add_size(struct model *model, uint32_t x, uint32_t y, uint32_t z)
{
    size_t contents = begin_chunk(model, "SIZE");
    add_number(model, x);
    add_number(model, y);
    add_number(model, z);
    end_chunk(model, contents);
}

static void add_voxels(struct model *model, const unsigned char (*voxels)[4], uint32_t count)
{
    size_t contents = begin_chunk(model, "XYZI");
    add_number(model, count);
    add_bytes(model, voxels, 4 * (size_t)count);
    end_chunk(model, contents);
}

static void add_string(struct model *model, const char *text)
{
    add_number(model, (uint32_t)strlen(text));
    add_bytes(model, text, strlen(text));
}

/* A transform node; texts that are NULL are left out. */
static void add_transform(struct model *model, uint32_t id, uint32_t child, const char *rotation,
                          const char *translation, bool hidden)
{
    size_t contents = begin_chunk(model, "nTRN");
    add_number(model, id);
    add_number(model, hidden ? 2 : 1);
    add_string(model, "_name");
    add_string(model, "part");
    if (hidden) {
        add_string(model, "_hidden");
        add_string(model, "1");
    }
    add_number(model, child);
    add_number(model, UINT32_MAX);
    add_number(model, 0);
    add_number(model, 1);
    add_number(model, (rotation != NULL) + (translation != NULL));
    if (rotation) {
        add_string(model, "_r");
        add_string(model, rotation);
    }
    if (translation) {
        add_string(model, "_t");
        add_string(model, translation);
    }
    end_chunk(model, contents);
}

static void add_group(struct model *model, uint32_t id, const uint32_t *children, uint32_t count)
{
    size_t contents = begin_chunk(model, "nGRP");
    add_number(model, id);
    add_number(model, 0);
    add_number(model, count);
    for (uint32_t i = 0; i < count; i++)
        add_number(model, children[i]);
    end_chunk(model, contents);
}

static void add_shape(struct model *model, uint32_t id, uint32_t of_model)
{
    size_t contents = begin_chunk(model, "nSHP");
    add_number(model, id);
    add_number(model, 0);
    add_number(model, 1);
    add_number(model, of_model);
    add_number(model, 0);
    end_chunk(model, contents);
}

static void write_file(const unsigned char *data, size_t size)
{
    unlink("a.vox"); /* a file that is cut to nothing and rewritten is flushed by some file systems */
    FILE *stream = fopen("a.vox", "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static struct octree load(const struct model *model)
{
    struct error err = {0};
    struct octree tree = {0};
    write_file(model->data, model->size);
    assert_ok(vox_load("a.vox", &tree, &err), &err);
    return tree;
}

static void assert_rejected(const unsigned char *data, size_t size, const char *part)
{
    struct error err = {0};
    struct octree tree = {.root = 7, .depth = 2};
    write_file(data, size);
    enum status status = vox_load("a.vox", &tree, &err);
    if (status != STATUS_INPUT && status != STATUS_RANGE)
        fail_msg("status %d", (int)status);
    if (!strstr(err.text, part) || strncmp(err.text, "a.vox: ", 7) != 0)
        fail_msg("message: %s; wanted: %s", err.text, part);
    assert_int_equal(tree.root, 7);
}

/* An L: a foot that points along the file's x, a hand along its y, a tall body along its z. */
static const unsigned char letter[][4] = {
    {0, 0, 0, 1}, {1, 0, 0, 2}, {0, 1, 0, 3}, {0, 0, 1, 4}, {0, 0, 2, 5}};

static void a_model_stands_upright_and_is_not_mirrored(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    const int x = info.low[0], y = info.low[1], z = info.high[2]; /* the file's y runs away from the viewer */
    assert_int_equal(info.cells, 5);
    assert_int_equal(octree_at(&tree, x, y, z), 1);
    assert_int_equal(octree_at(&tree, x + 1, y, z), 2);
    assert_int_equal(octree_at(&tree, x, y, z - 1), 3);
    assert_int_equal(octree_at(&tree, x, y + 1, z), 4);
    assert_int_equal(octree_at(&tree, x, y + 2, z), 5);
    octree_clear(&tree);
}

static void the_cube_is_the_smallest_with_a_free_cell_all_around(void **state)
{
    (void)state;
    static const int lengths[][2] = {{1, 2}, {2, 2}, {3, 3}, {6, 3}, {7, 4}, {254, 8}, {255, 9}};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        int length = lengths[i][0];
        const unsigned char ends[][4] = {{0, 0, 0, 1}, {(unsigned char)(length - 1), 0, 0, 1}};
        struct model model = new_model();
        add_size(&model, 256, 1, 1);
        add_voxels(&model, ends, 2);
        struct octree tree = load(&model);
        struct octree_info info = octree_measure(&tree);
        int side = 1 << tree.depth;
        assert_int_equal(tree.depth, lengths[i][1]);
        for (int k = 0; k < 3; k++) {
            int before = info.low[k], behind = side - 1 - info.high[k];
            assert_true(before >= 1 && behind >= 1 && abs(before - behind) <= 1);
        }
        octree_clear(&tree);
    }
}

static void several_models_without_a_scene_are_merged(void **state)
{
    (void)state;
    static const unsigned char one[][4] = {{0, 0, 0, 1}, {1, 0, 0, 1}},
                               other[][4] = {{1, 0, 0, 2}, {3, 0, 0, 2}};
    struct model model = new_model();
    add_size(&model, 2, 1, 1);
    add_voxels(&model, one, 2);
    add_size(&model, 4, 1, 1);
    add_voxels(&model, other, 2);
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.cells, 3);
    assert_int_equal(octree_at(&tree, info.low[0], info.low[1], info.low[2]), 1);
    assert_int_equal(octree_at(&tree, info.low[0] + 1, info.low[1], info.low[2]), 2);
    assert_int_equal(octree_at(&tree, info.low[0] + 3, info.low[1], info.low[2]), 2);
    octree_clear(&tree);
}

/* Where the letter's parts go when the scene turns it by these bits and moves it by (10, 20, 30). */
static struct octree turned(const char *rotation)
{
    static const unsigned char mark[][4] = {{0, 0, 0, 9}};
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    add_size(&model, 1, 1, 1);
    add_voxels(&model, mark, 1);
    add_transform(&model, 0, 1, NULL, NULL, false);
    add_group(&model, 1, (const uint32_t[]){2, 4}, 2);
    add_transform(&model, 2, 3, rotation, "10 20 30", false);
    add_shape(&model, 3, 0);
    add_transform(&model, 4, 5, NULL, "0 0 0", false);
    add_shape(&model, 5, 1);
    return load(&model);
}

/* The material at (x, y, z) of the file, measured from the mark at the scene's origin. */
static unsigned at_scene(const struct octree *tree, int x, int y, int z)
{
    struct octree_info info = octree_measure(tree);
    return octree_at(tree, info.low[0] + x, info.low[1] + z, info.high[2] - y);
}

static void a_scene_moves_models_by_their_middle(void **state)
{
    (void)state;
    struct octree tree = turned(NULL);
    /* a model of 2 x 2 x 3 turns about the corner 1 1 1 of its cells, which goes to 10 20 30 */
    assert_int_equal(at_scene(&tree, 0, 0, 0), 9);
    assert_int_equal(at_scene(&tree, 9, 19, 29), 1);
    assert_int_equal(at_scene(&tree, 10, 19, 29), 2);
    assert_int_equal(at_scene(&tree, 9, 20, 29), 3);
    assert_int_equal(at_scene(&tree, 9, 19, 30), 4);
    assert_int_equal(at_scene(&tree, 9, 19, 31), 5);
    octree_clear(&tree);
}

static void a_scene_turns_models(void **state)
{
    (void)state;
    /* rows (0 -1 0), (1 0 0), (0 0 1): a quarter turn about z, x to y and y to -x: columns 1 and 0 (1 | 0 << 2), the
     * first row's sign minus (1 << 4): 17. About the corner 1 1 1 the first cell, which spans -1 .. 0 along each
     * axis, then spans 0 .. 1 along x. */
    struct octree tree = turned("17");
    assert_int_equal(at_scene(&tree, 10, 19, 29), 1);
    assert_int_equal(at_scene(&tree, 10, 20, 29), 2);
    assert_int_equal(at_scene(&tree, 9, 19, 29), 3);
    assert_int_equal(at_scene(&tree, 10, 19, 31), 5);
    octree_clear(&tree);
    /* rows (0 1 0), (0 0 -1), (-1 0 0): the format's own example: 1 | 2 << 2 | 1 << 5 | 1 << 6 = 105 */
    tree = turned("105");
    assert_int_equal(at_scene(&tree, 9, 20, 30), 1);
    assert_int_equal(at_scene(&tree, 9, 20, 29), 2);
    assert_int_equal(at_scene(&tree, 10, 20, 30), 3);
    assert_int_equal(at_scene(&tree, 9, 18, 30), 5);
    octree_clear(&tree);
}

static void nested_moves_add_up_and_hidden_parts_are_left_out(void **state)
{
    (void)state;
    static const unsigned char one[][4] = {{0, 0, 0, 1}};
    struct model model = new_model();
    add_size(&model, 1, 1, 1);
    add_voxels(&model, one, 1);
    /* chunks of the scene in no order: they are found by number */
    add_shape(&model, 7, 0);
    add_shape(&model, 5, 0);
    add_shape(&model, 3, 0);
    add_transform(&model, 6, 7, NULL, "100 0 0", true);
    add_transform(&model, 4, 5, NULL, "2 1 0", false);
    add_transform(&model, 2, 3, NULL, NULL, false);
    add_group(&model, 1, (const uint32_t[]){2, 8, 6}, 3);
    add_group(&model, 9, (const uint32_t[]){4}, 1);
    add_transform(&model, 8, 9, "17", "5 0 0", false); /* 2 1 becomes -1 2 */
    add_transform(&model, 0, 1, NULL, NULL, false);
    struct octree tree = load(&model);
    struct octree_info info = octree_measure(&tree);
    assert_int_equal(info.cells, 2);
    /* the cell spans 0 .. 1; turned about the origin it spans -1 .. 0 along x: 5 - 1 - 1, and 2 along y */
    assert_int_equal(info.high[0] - info.low[0], 3);
    assert_int_equal(info.high[2] - info.low[2], 2);
    octree_clear(&tree);
}

static struct model sample(void)
{
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    add_transform(&model, 0, 1, NULL, NULL, false);
    add_group(&model, 1, (const uint32_t[]){2}, 1);
    add_transform(&model, 2, 3, "17", "10 20 30", false);
    add_shape(&model, 3, 0);
    return model;
}

static void every_truncation_is_refused(void **state)
{
    (void)state;
    struct model model = sample();
    assert_rejected(model.data, 0, "the file is empty");
    for (size_t size = 1; size < model.size; size++)
        assert_rejected(model.data, size, size < 4 ? "not a .vox file" : "cut short");
}

/* Truncated inside, with outer sizes that match: each chunk by itself. */
static void chunks_that_are_too_short_are_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    end_chunk(&model, begin_chunk(&model, "SIZE"));
    assert_rejected(model.data, model.size, "chunk SIZE at byte 20: must hold three numbers");
    model = new_model();
    add_size(&model, 1, 1, 1);
    end_chunk(&model, begin_chunk(&model, "XYZI"));
    assert_rejected(model.data, model.size, "chunk XYZI at byte 44: must begin with the number of voxels");
    static const char *const nodes[] = {"nTRN", "nGRP", "nSHP"};
    for (int i = 0; i < 3; i++) {
        model = new_model();
        add_size(&model, 2, 2, 3);
        add_voxels(&model, letter, 5);
        size_t contents = begin_chunk(&model, nodes[i]);
        end_chunk(&model, contents);
        assert_rejected(model.data, model.size, "must begin with the number of the node");
        add_number(&model, 0);
        end_chunk(&model, contents);
        assert_rejected(model.data, model.size, "scene graph node 0 at byte 80: n");
        add_number(&model, UINT32_MAX); /* attributes, claimed */
        add_number(&model, UINT32_MAX); /* letters, claimed */
        end_chunk(&model, contents);
        assert_rejected(model.data, model.size, "scene graph node 0 at byte 80: n");
    }
}

static void a_billion_claimed_voxels_are_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 256, 256, 256);
    add_voxels(&model, letter, 5);
    set_number(&model, 44 + 12, 1000000000);
    assert_rejected(model.data, model.size,
                    "chunk XYZI at byte 44: claims 1000000000 voxels but has room for 5");
}

static void sizes_out_of_range_are_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 1, 1000000000, 1);
    assert_rejected(model.data, model.size, "chunk SIZE at byte 20: a model of 1000000000 cells along y");
    model = new_model();
    add_size(&model, 1, 1, 0);
    assert_rejected(model.data, model.size, "chunk SIZE at byte 20: a model of 0 cells along z");
    model = new_model();
    add_size(&model, 2, 2, 2);
    add_voxels(&model, letter, 5);
    assert_rejected(model.data, model.size, "voxel 4 has z = 2 in a model of 2 cells along z");
}

static void chunks_out_of_order_are_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    add_voxels(&model, letter, 5);
    assert_rejected(model.data, model.size, "chunk XYZI at byte 20: has no chunk SIZE before it");
    model = new_model();
    add_size(&model, 2, 2, 3);
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    assert_rejected(model.data, model.size,
                    "chunk SIZE at byte 44: the chunk SIZE before it must be followed by");
    model = new_model();
    add_size(&model, 2, 2, 3);
    assert_rejected(model.data, model.size, "the last chunk SIZE must be followed by a chunk XYZI");
    model = new_model();
    add_shape(&model, 0, 0);
    assert_rejected(model.data, model.size, "there is no model");
    model = sample();
    memcpy(model.data + 8, "PACK", 4);
    assert_rejected(model.data, model.size, "chunk PACK at byte 8: the first chunk must be MAIN");
}

static void foreign_files_and_versions_are_refused(void **state)
{
    (void)state;
    struct model model = sample();
    set_number(&model, 4, 99);
    assert_rejected(model.data, model.size, "version 99 of the format; 150 to 200 are read");
    assert_rejected((const unsigned char *)"solid cube", 10, "not a .vox file");
}

static void scene_graphs_that_are_no_trees_are_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    const struct model voxels = model;
    add_transform(&model, 0, 0, NULL, NULL, false);
    assert_rejected(model.data, model.size, "scene graph node 0 at byte 80: is reached twice");
    model = voxels;
    add_transform(&model, 0, 5, NULL, NULL, false);
    assert_rejected(model.data, model.size, "scene graph node 5 is missing");
    model = voxels;
    add_shape(&model, 0, 1);
    assert_rejected(model.data, model.size, "nSHP names a model that is not in the file");
    add_shape(&model, 0, 0);
    assert_rejected(model.data, model.size, "scene graph node 0 is there twice");
    model = voxels;
    add_transform(&model, 0, 1, "15", NULL, false);
    assert_rejected(model.data, model.size, "_r is no rotation");
    model = voxels;
    add_transform(&model, 0, 1, NULL, "1 2", false);
    assert_rejected(model.data, model.size, "_t must be three whole numbers");
    model = voxels;
    add_transform(&model, 0, 1, NULL, "1 2 99999999999999999999", false);
    assert_rejected(model.data, model.size, "_t must be three whole numbers");
}

static void models_too_far_apart_and_empty_ones_are_refused(void **state)
{
    (void)state;
    static const unsigned char one[][4] = {{0, 0, 0, 1}}, colourless[][4] = {{0, 0, 0, 0}};
    struct model model = new_model();
    add_size(&model, 1, 1, 1);
    add_voxels(&model, one, 1);
    add_group(&model, 0, (const uint32_t[]){1, 3}, 2);
    add_shape(&model, 1, 0);
    add_transform(&model, 3, 4, NULL, "0 16777216 0", false);
    add_shape(&model, 4, 0);
    assert_rejected(model.data, model.size, "the model is 16777217 cells long; at most 1022 fit");
    model = new_model();
    add_size(&model, 1, 1, 1);
    add_voxels(&model, colourless, 1);
    assert_rejected(model.data, model.size, "the model is empty");
}

static void a_flipped_bit_never_does_harm(void **state)
{
    (void)state;
    struct model model = sample();
    for (size_t bit = 0; bit < 8 * model.size; bit++) {
        struct error err = {0};
        struct octree tree = {0};
        model.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        write_file(model.data, model.size);
        if (vox_load("a.vox", &tree, &err))
            assert_int_not_equal(err.text[0], '\0');
        octree_clear(&tree);
        model.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
}

/* The same cells with the same materials, wherever in the cube. */
static void assert_same_sculpture(const struct octree *a, const struct octree *b)
{
    struct octree_info one = octree_measure(a), other = octree_measure(b);
    assert_int_equal(one.cells, other.cells);
    for (int k = 0; k < 3; k++)
        assert_int_equal(one.high[k] - one.low[k], other.high[k] - other.low[k]);
    for (int z = 0; z <= one.high[2] - one.low[2]; z++)
        for (int y = 0; y <= one.high[1] - one.low[1]; y++)
            for (int x = 0; x <= one.high[0] - one.low[0]; x++)
                assert_int_equal(octree_at(a, one.low[0] + x, one.low[1] + y, one.low[2] + z),
                                 octree_at(b, other.low[0] + x, other.low[1] + y, other.low[2] + z));
}

static void assert_round_trip(const struct octree *tree)
{
    struct error err = {0};
    struct octree back = {0};
    assert_ok(vox_save(tree, "a.vox", &err), &err);
    assert_ok(vox_load("a.vox", &back, &err), &err);
    assert_same_sculpture(tree, &back);
    octree_clear(&back);
}

static void a_saved_sculpture_comes_back(void **state)
{
    (void)state;
    uint64_t seed = 3;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 5, 0, &err), &err);
    for (int i = 0; i < 2000; i++) {
        uint64_t bits = random_bits(&seed);
        assert_ok(octree_set(&tree, (int)(bits % 32), (int)(bits >> 8 & 31), (int)(bits >> 16 & 15),
                             (unsigned)(bits >> 24 & 0xff), &err),
                  &err);
    }
    assert_round_trip(&tree);
    octree_clear(&tree);
}

static void a_long_sculpture_is_saved_as_several_models(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 9, 0, &err), &err);
    struct chip rod = {CHIP_CAPSULE, 3, {0.05, 0.1, 0.9, 0.9, 0.95, 0.2, 0.004, 0.01}, CHIP_CARVE, 0};
    assert_ok(sculpt_chip(&tree, &rod, &err), &err);
    assert_round_trip(&tree);
    octree_clear(&tree);
}

static void an_empty_sculpture_is_not_saved(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = {0};
    assert_ok(octree_init(&tree, 3, 0, &err), &err);
    unlink("a.vox");
    assert_refused(vox_save(&tree, "a.vox", &err), STATUS_RANGE, "a.vox: the sculpture is empty", &err);
    assert_int_equal(access("a.vox", F_OK), -1);
    assert_ok(octree_init(&tree, 10, 1, &err), &err);
    assert_refused(vox_save(&tree, "a.vox", &err), STATUS_RANGE,
                   "1073741824 cells; a .vox file holds at most", &err);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_stands_upright_and_is_not_mirrored),
        cmocka_unit_test(the_cube_is_the_smallest_with_a_free_cell_all_around),
        cmocka_unit_test(several_models_without_a_scene_are_merged),
        cmocka_unit_test(a_scene_moves_models_by_their_middle),
        cmocka_unit_test(a_scene_turns_models),
        cmocka_unit_test(nested_moves_add_up_and_hidden_parts_are_left_out),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(chunks_that_are_too_short_are_refused),
        cmocka_unit_test(a_billion_claimed_voxels_are_refused),
        cmocka_unit_test(sizes_out_of_range_are_refused),
        cmocka_unit_test(chunks_out_of_order_are_refused),
        cmocka_unit_test(foreign_files_and_versions_are_refused),
        cmocka_unit_test(scene_graphs_that_are_no_trees_are_refused),
        cmocka_unit_test(models_too_far_apart_and_empty_ones_are_refused),
        cmocka_unit_test(a_flipped_bit_never_does_harm),
        cmocka_unit_test(a_saved_sculpture_comes_back),
        cmocka_unit_test(a_long_sculpture_is_saved_as_several_models),
        cmocka_unit_test(an_empty_sculpture_is_not_saved),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
