/* Where assimp is not there: when the programs were built (no_assimp.c), or when they run (mesh_assimp.c,
 * with the name of a library that nobody has). */
#include "check.h"
#include "common/mesh_files.h"

#include <string.h>

static void a_missing_library_is_named_with_its_package_and_what_to_do_instead(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    assert_refused(mesh_read_foreign("cat.gltf", &mesh, &err), STATUS_RESOURCE, "cat.gltf: ", &err);
    assert_non_null(strstr(err.text, "assimp"));
    assert_true(strstr(err.text, "install") || strstr(err.text, "libassimp-dev"));
    assert_non_null(strstr(err.text, "convert the mesh to .ply, .stl or .obj"));
    assert_int_equal(mesh.triangle_count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_library_is_named_with_its_package_and_what_to_do_instead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
