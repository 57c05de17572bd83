/* Scripts, voxel models and meshes where memory ends and files fail. */
#include "../unit/trees.h"
#include "../unit/vox_models.h"
#include "common/mesh.h"
#include "faulty.h"
#include "sculpt/voxelise.h"
#include "support/shapes.h"

static const char script[] =
    "depth 5\nchip sphere .5 .5 .5 .3\nmirror xy\nfill box .1 .1 .1 .3 .2 .25\nstep\n"
    "sandpaper .5 .5 .5 .5\nstep\nheat .4 .4 .4 .3\nstep\nundo\nundo\nredo\n"
    "material 4\ncoefficient 4 .5\nfill cone .1 .2 .3 .8 .7 .6 .1 .2\n";

/* Reads a script and does it; what is begun with is a leaf of material 7, which stays
 * in place of what fails. */
static enum status run_script(struct octree *tree, struct error *err)
{
    struct chips chips = {0};
    struct octree made = {0};
    enum status status = chips_load("a.chips", &chips, err);
    if (!status)
        status = chips_begin(&chips, 6, &made, err);
    if (!status)
        status = chips_run(&made, &chips, err);
    if (made.depth > 0)
        assert_sound(&made);
    chips_clear(&chips);
    if (status)
        octree_clear(&made);
    else
        *tree = made;
    return status;
}

static void a_script_is_replayed_or_says_why_not(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree good = {0};
    write_text("a.chips", script);
    assert_ok(run_script(&good, &err), &err);
    for (int i = 0; i < 2; i++)
        for (struct fault fault = {.kinds = fault_kinds[i]}; fault_next(&fault);) {
            struct octree tree = {0};
            fault_begin(&fault);
            enum status status = run_script(&tree, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_true(status || octree_equal(&tree, &good));
            octree_clear(&tree);
        }
    octree_clear(&good);
    unlink("a.chips");
}

static enum status save_chips(const void *thing, const char *path, struct error *err)
{
    return chips_save(thing, path, err);
}

static enum status save_vox(const void *thing, const char *path, struct error *err)
{
    return vox_save(thing, path, err);
}

static void scripts_and_models_are_saved_whole_or_not_at_all(void **state)
{
    (void)state;
    struct octree tree = random_sculpture(4, 20, 8);
    check_save(save_chips, &tree, "a.chips");
    check_save(save_vox, &tree, "a.vox");
    octree_clear(&tree);
}

static enum status save_mesh(const void *thing, const char *path, struct error *err)
{
    return mesh_save(thing, path, err);
}

static void meshes_are_saved_whole_or_not_at_all(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    shape_icosphere(1, &mesh);
    check_save(save_mesh, &mesh, "a.ply");
    check_save(save_mesh, &mesh, "a.stl");
    check_save(save_mesh, &mesh, "a.obj");
    mesh_clear(&mesh);
}

typedef enum status load_tree(const char *path, struct octree *tree, struct error *err);

/* Each call of a reader fails in turn: the tree is the file's, or as it was. */
static void check_load(load_tree *load_it, const char *path)
{
    struct error err = {0};
    struct octree good = {0};
    assert_ok(load_it(path, &good, &err), &err);
    for (int i = 0; i < 2; i++)
        for (struct fault fault = {.kinds = fault_kinds[i]}; fault_next(&fault);) {
            struct octree tree = new_tree(2, 7);
            fault_begin(&fault);
            enum status status = load_it(path, &tree, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_true(status ? tree.root == 7 && tree.depth == 2 : octree_equal(&tree, &good));
            octree_clear(&tree);
        }
    octree_clear(&good);
    unlink(path);
}

static void a_model_that_cannot_be_loaded_leaves_the_old_tree(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree tree = random_sculpture(4, 20, 8);
    assert_ok(vox_save(&tree, "a.vox", &err), &err);
    check_load(vox_load, "a.vox");
    octree_clear(&tree);
    struct model scene = new_model();
    add_size(&scene, 2, 2, 3);
    add_voxels(&scene, letter, 5);
    add_group(&scene, 0, (const uint32_t[]){1, 3}, 2);
    add_shape(&scene, 1, 0);
    add_transform(&scene, 3, 4, NULL, "10 0 0", false);
    add_shape(&scene, 4, 0);
    write_model(scene.data, scene.size);
    check_load(vox_load, "a.vox");
}

static enum status load_mesh(const char *path, struct octree *tree, struct error *err)
{
    struct voxelise_report report;
    return voxelise_load(path, 4, tree, &report, err);
}

/* Edges that are there belong to the points as they are numbered. */
static void a_mesh_that_cannot_be_put_in_order_has_no_wrong_edges(void **state)
{
    (void)state;
    for (struct fault fault = {.kinds = FAULT_MEMORY}; fault_next(&fault);) {
        struct error err = {0};
        struct mesh mesh = {0}, before = {0};
        shape_icosphere(1, &mesh);
        shape_icosphere(1, &before);
        assert_ok(mesh_connect(&mesh, &err), &err);
        fault_begin(&fault);
        const enum status status = mesh_order(&mesh, &err);
        fault_end(&fault);
        assert_says(status, &err, fault.kinds);
        if (status && mesh.edge)
            assert_memory_equal(mesh.position, before.position, mesh.point_count * sizeof *mesh.position);
        mesh_clear(&before);
        mesh_clear(&mesh);
    }
}

/* An open mesh, so that the solid angles are asked too. */
static void a_mesh_that_cannot_be_voxelised_leaves_the_old_tree(void **state)
{
    (void)state;
    static const char *const names[] = {"a.ply", "a.stl", "a.obj"};
    struct error err = {0};
    struct mesh mesh = {0};
    shape_icosphere(2, &mesh);
    mesh.triangle_count -= 9;
    for (int i = 0; i < 3; i++) {
        assert_ok(mesh_save(&mesh, names[i], &err), &err);
        check_load(load_mesh, names[i]);
    }
    mesh_clear(&mesh);
    write_text(
        "a.stl",
        "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet\n"
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 0 1 vertex 1 0 0 endloop endfacet\n"
        "facet normal 0 0 1 outer loop vertex 1 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet\n"
        "endsolid a\n");
    check_load(load_mesh, "a.stl");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_script_is_replayed_or_says_why_not),
        cmocka_unit_test(scripts_and_models_are_saved_whole_or_not_at_all),
        cmocka_unit_test(meshes_are_saved_whole_or_not_at_all),
        cmocka_unit_test(a_model_that_cannot_be_loaded_leaves_the_old_tree),
        cmocka_unit_test(a_mesh_that_cannot_be_put_in_order_has_no_wrong_edges),
        cmocka_unit_test(a_mesh_that_cannot_be_voxelised_leaves_the_old_tree),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
