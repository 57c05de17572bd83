/* STL: both kinds, told apart by size; welded to a mesh. */
#include "common/mesh.h"
#include "folder.h"
#include "solids.h"

#include <ctype.h>

#define FACET(a, b, c) \
    "facet normal 0 0 1\n outer loop\n vertex " a "\n vertex " b "\n vertex " c "\n endloop\nendfacet\n"
#define TWO_FACETS FACET("0 0 0", "1 0 0", "1 1 0") FACET("0 0 0", "1 1 0", "0 1 0")

static void assert_square(const struct mesh *mesh)
{
    const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
    struct mesh wanted = mesh_of(position, 4, triangle, 2);
    assert_same_mesh(mesh, &wanted);
    mesh_clear(&wanted);
}

static void assert_text_is_square(const char *text)
{
    struct error err = {0};
    struct mesh mesh = {0};
    write_text("a.stl", text);
    assert_ok(mesh_load("a.stl", &mesh, &err), &err);
    assert_square(&mesh);
    mesh_clear(&mesh);
}

static void assert_text_refused(const char *text, const char *message)
{
    struct error err = {0};
    struct mesh mesh = {0};
    write_text("a.stl", text);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT, message, &err);
    assert_null(mesh.position);
}

static void text_is_read_whatever_its_spaces(void **state)
{
    (void)state;
    assert_text_is_square("solid a name of words\n" TWO_FACETS "endsolid a name of words\n");
    assert_text_is_square("\n\n  solid\r\n" TWO_FACETS "endsolid");
    assert_text_is_square("solid one\n" FACET("0 0 0", "1 0 0", "1 1 0") "endsolid one\nsolid two\n" FACET(
        "-0e5\n0\n0", "1.0 +1 .0", "0 1 0") "endsolid two\n\n");
    char loud[] = "solid x\n" TWO_FACETS "endsolid x\n";
    for (char *letter = loud; *letter; letter++)
        *letter = (char)toupper(*letter);
    assert_text_is_square(loud);
}

/* Head, count and facets of a binary file; every facet's normal and attribute are rubbish. */
static size_t binary_square(unsigned char bytes[184], const char *head)
{
    static const float corners[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};
    memset(bytes, 0xff, 184);
    memset(bytes, 0, 84);
    memcpy(bytes, head, strlen(head));
    bytes[80] = 2;
    for (size_t t = 0; t < 2; t++) {
        for (size_t i = 0; i < 9; i++) {
            uint32_t bits;
            memcpy(&bits, &corners[t][i], sizeof bits);
            for (size_t b = 0; b < 4; b++)
                bytes[84 + 50 * t + 12 + 4 * i + b] = (unsigned char)(bits >> 8 * b);
        }
    }
    return 184;
}

static void binary_is_known_by_its_size_even_if_it_says_solid(void **state)
{
    (void)state;
    static const char *const heads[] = {"solid facet", "", "COLOR=rgba"};
    struct error err = {0};
    for (int i = 0; i < 3; i++) {
        unsigned char bytes[184];
        struct mesh mesh = {0};
        write_bytes("a.stl", bytes, binary_square(bytes, heads[i]));
        assert_ok(mesh_load("a.stl", &mesh, &err), &err);
        assert_square(&mesh);
        mesh_clear(&mesh);
    }
}

static void a_binary_file_that_is_wrong_is_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    unsigned char bytes[184];
    size_t size = binary_square(bytes, "");
    write_bytes("a.stl", bytes, size - 1);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT,
                   "a.stl: 2 triangles in a binary STL take 184 bytes; the file has 183", &err);
    binary_square(bytes, "solid of another program\n");
    write_bytes("a.stl", bytes, 183);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT,
                   "a.stl: 2 triangles in a binary STL take 184 bytes; the file has 183", &err);
    binary_square(bytes, "binary");
    memset(bytes + 80, 0xff, 4);
    write_bytes("a.stl", bytes, size);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT,
                   "a.stl: 4294967295 triangles in a binary STL take 214748364834 bytes", &err);
    size = binary_square(bytes, "");
    memset(bytes + 84 + 50 + 12 + 16, 0xff, 4);
    write_bytes("a.stl", bytes, size);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT, "a.stl: triangle 1: y of corner 1 is",
                   &err);
    write_bytes("a.stl", bytes, 50);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT, "a.stl: no STL file", &err);
    memset(bytes, 0, 84);
    write_bytes("a.stl", bytes, 84);
    assert_refused(mesh_load("a.stl", &mesh, &err), STATUS_INPUT, "a.stl: the mesh has no triangles", &err);
}

static void text_that_is_wrong_is_named_by_its_line(void **state)
{
    (void)state;
    assert_text_refused("", "a.stl: no STL file");
    assert_text_refused("solid x\nfacet normal 0 0 1\nouter\n", "a.stl:4: the file ends here; 'loop' must");
    assert_text_refused("solid x\n" TWO_FACETS, "a.stl:16: the file ends here; 'endsolid' must follow");
    assert_text_refused("solid x\nfacet normal 0 zero 1\n", "a.stl:2: 'zero'; must be a number");
    assert_text_refused("solid x\n" FACET("0 0 0", "1 0 0", "1 inf 0"), "a.stl:6: y is inf; must be finite");
    assert_text_refused("solid x\n" FACET("0 0 0", "1 0 0", "1 1 0\nvertex 0 1 0"),
                        "a.stl:7: 'vertex'; must be 'endloop'");
    assert_text_refused("solid x\n" FACET("0 0 0", "1 0", "1 1 0"), "a.stl:6: 'vertex'; must be a number");
    assert_text_refused("solid x\ntriangle\n", "a.stl:2: 'triangle'; must be 'facet' or 'endsolid'");
    assert_text_refused("solid x\n" TWO_FACETS "endsolid\nfacet", "a.stl:17: 'facet'; must be 'solid'");
    assert_text_refused("solid x\nendsolid\n", "a.stl: the mesh has no triangles");
}

/* Coordinates that a float holds: half-integers. */
static void a_mesh_comes_back_with_floats_welded_as_it_was(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0}, back = {0}, again = {0};
    add_cube(&mesh, 0.5, -2, 8);
    add_cube(&mesh, 4, 4, 4);
    assert_ok(mesh_save(&mesh, "a.stl", &err), &err);
    assert_ok(mesh_load("a.stl", &back, &err), &err);
    assert_int_equal(back.point_count, 16);
    assert_int_equal(back.triangle_count, 24);
    for (int t = 0; t < 24; t++) {
        for (int k = 0; k < 3; k++)
            assert_memory_equal(back.position[back.triangle[t][k]], mesh.position[mesh.triangle[t][k]],
                                sizeof *mesh.position);
    }
    assert_ok(mesh_save(&back, "b.stl", &err), &err);
    assert_ok(mesh_load("b.stl", &again, &err), &err);
    assert_same_mesh(&back, &again);
    mesh_clear(&mesh);
    mesh_clear(&back);
    mesh_clear(&again);
}

static void facet_normals_are_written(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    unsigned char bytes[84 + 12 * 50];
    add_cube(&mesh, 0, 0, 0);
    assert_ok(mesh_save(&mesh, "a.stl", &err), &err);
    FILE *stream = fopen("a.stl", "rb");
    assert_int_equal(fread(bytes, 1, sizeof bytes, stream), sizeof bytes);
    assert_int_equal(fgetc(stream), EOF);
    fclose(stream);
    const unsigned char down[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 0xbf}; /* 0, 0, -1 */
    for (int i = 0; i < 12; i++)
        assert_int_equal(bytes[84 + i] & (i % 4 == 3 && i < 8 ? 0x7f : 0xff), down[i]); /* -0 is 0 too */
    assert_int_equal(bytes[80], 12);
    mesh_clear(&mesh);
}

static void what_a_float_cannot_hold_is_not_saved(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    mesh.position[7][0] = 1e39;
    assert_refused(mesh_save(&mesh, "c.stl", &err), STATUS_RANGE, "c.stl: point 7 has a coordinate 1e+39",
                   &err);
    assert_int_equal(access("c.stl", F_OK), -1);
    mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read_whatever_its_spaces),
        cmocka_unit_test(binary_is_known_by_its_size_even_if_it_says_solid),
        cmocka_unit_test(a_binary_file_that_is_wrong_is_refused),
        cmocka_unit_test(text_that_is_wrong_is_named_by_its_line),
        cmocka_unit_test(a_mesh_comes_back_with_floats_welded_as_it_was),
        cmocka_unit_test(facet_normals_are_written),
        cmocka_unit_test(what_a_float_cannot_hold_is_not_saved),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
