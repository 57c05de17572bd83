/* MagicaVoxel files that are wrong. */
#include "common/random.h"
#include "vox_models.h"

static void assert_rejected(const unsigned char *data, size_t size, const char *part)
{
    struct error err = {0};
    struct octree tree = {.root = 7, .depth = 2};
    write_model(data, size);
    enum status status = vox_load("a.vox", &tree, &err);
    if (status != STATUS_INPUT && status != STATUS_RANGE)
        fail_msg("status %d", (int)status);
    if (!strstr(err.text, part) || strncmp(err.text, "a.vox: ", 7) != 0)
        fail_msg("message: %s; wanted: %s", err.text, part);
    assert_int_equal(tree.root, 7);
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

/* A model of a third of a million voxels, in 400 places: refused before any is visited. */
static void a_scene_of_too_many_voxels_is_refused(void **state)
{
    (void)state;
    enum { PLACES = 400, VOXELS = (1 << 27) / PLACES + 1 };
    static uint32_t shapes[PLACES];
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    const size_t contents = begin_chunk(&model, "XYZI");
    add_number(&model, VOXELS);
    set_number(&model, contents - 8, 4 + 4 * VOXELS);
    const size_t before = model.size;
    for (uint32_t i = 0; i < PLACES; i++)
        shapes[i] = i + 1;
    add_group(&model, 0, shapes, PLACES);
    for (uint32_t i = 0; i < PLACES; i++)
        add_shape(&model, shapes[i], 0);
    const size_t size = model.size + 4 * VOXELS;
    set_number(&model, MAIN_CHILDREN, (uint32_t)(size - FIRST_CHUNK));
    unsigned char *file = calloc(size, 1);
    memcpy(file, model.data, before);
    for (size_t i = 0; i < VOXELS; i++)
        file[before + 4 * i + 3] = 1; /* colour, at the corner */
    memcpy(file + before + 4 * VOXELS, model.data + before, model.size - before);
    assert_rejected(file, size, "the scene has more than 134217728 voxels");
    free(file);
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
    add_transform(&model, 0, 1, NULL, NULL, false);
    add_shape(&model, 1, 0);
    add_layer(&model, 0, true);
    add_layer(&model, 0, false);
    assert_rejected(model.data, model.size, "layer 0 is there twice, at bytes");
    model = voxels;
    add_transform(&model, 0, 1, NULL, NULL, false);
    add_shape(&model, 1, 0);
    size_t layer = begin_chunk(&model, "LAYR");
    add_number(&model, 0);
    add_number(&model, 1);
    end_chunk(&model, layer);
    assert_rejected(model.data, model.size, "layer 0 at byte 169: LAYR is cut short");
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

static void a_scene_graph_that_is_too_deep_is_refused(void **state)
{
    (void)state;
    struct model model = new_model();
    add_size(&model, 2, 2, 3);
    add_voxels(&model, letter, 5);
    for (uint32_t id = 0; id <= 256; id++)
        add_group(&model, id, &(uint32_t){id + 1}, 1);
    add_shape(&model, 257, 0);
    assert_rejected(model.data, model.size, "the scene graph is nested more than 256 deep");
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
        write_model(model.data, model.size);
        if (vox_load("a.vox", &tree, &err))
            assert_int_not_equal(err.text[0], '\0');
        octree_clear(&tree);
        model.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(chunks_that_are_too_short_are_refused),
        cmocka_unit_test(a_billion_claimed_voxels_are_refused),
        cmocka_unit_test(a_scene_of_too_many_voxels_is_refused),
        cmocka_unit_test(sizes_out_of_range_are_refused),
        cmocka_unit_test(chunks_out_of_order_are_refused),
        cmocka_unit_test(foreign_files_and_versions_are_refused),
        cmocka_unit_test(scene_graphs_that_are_no_trees_are_refused),
        cmocka_unit_test(a_scene_graph_that_is_too_deep_is_refused),
        cmocka_unit_test(models_too_far_apart_and_empty_ones_are_refused),
        cmocka_unit_test(a_flipped_bit_never_does_harm),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
