/* OBJ: points and faces in all their spellings. */
#include "common/mesh.h"
#include "folder.h"
#include "solids.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void assert_reads_as_square(const char *text)
{
    const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
    struct error err = {0};
    struct mesh wanted = mesh_of(position, 4, triangle, 2), mesh = {0};
    write_text("a.obj", text);
    assert_ok(mesh_load("a.obj", &mesh, &err), &err);
    assert_same_mesh(&mesh, &wanted);
    mesh_clear(&mesh);
    mesh_clear(&wanted);
}

static void assert_text_refused(const char *text, const char *message)
{
    struct error err = {0};
    struct mesh mesh = {0};
    write_text("a.obj", text);
    assert_refused(mesh_load("a.obj", &mesh, &err), STATUS_INPUT, message, &err);
    assert_null(mesh.position);
}

static void every_spelling_of_a_corner_is_read(void **state)
{
    (void)state;
    assert_reads_as_square(SQUARE "f 1 2 3 4\n");
    assert_reads_as_square(SQUARE "f 1 2 3\nf 1 3 4");
    assert_reads_as_square(SQUARE "f 1/1 2/2 3/3 4/9\n");
    assert_reads_as_square(SQUARE "f 1//1 2//1 3//1 4//1\n");
    assert_reads_as_square(SQUARE "f 1/1/1 2/2/1 3/3/1 4/4/1\r\n");
    assert_reads_as_square(SQUARE "f -4 -3 -2 -1\n");
    assert_reads_as_square("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf 1 -2 -1");
}

static void a_face_may_come_before_its_points(void **state)
{
    (void)state;
    assert_reads_as_square("f 1 2 3 4\n" SQUARE);
}

static void all_else_is_passed_over(void **state)
{
    (void)state;
    assert_reads_as_square("# a square\nmtllib a.mtl\no square\ng\n\nv 0 0 0 1\nv 1 0 0 1.0 .5 .5 .5\n"
                           "vn 0 0 1\nvt 0 0\nv 1 1 0 # the far one\nv 0 1 0\nusemtl red\ns off\n"
                           "f 1 2 3 4 # all\nl 1 2\nvp 1 2 3\nbevel on\n\xff\xfe\n");
}

static void a_backslash_continues_a_line(void **state)
{
    (void)state;
    assert_reads_as_square(
        "v 0 \\\n0 0\nv 1 0\\\r\n 0\nv 1 1 0\nv 0 1 0\n# a comment \\\nf 9 9 9\nf 1 2 \\\n\\\n3 4\n");
}

static void what_is_wrong_is_named_by_its_line(void **state)
{
    (void)state;
    assert_text_refused("v 0 0\n", "a.obj:1: a point of 2 coordinates; must be x y z");
    assert_text_refused("v 0 0 0\nv 1 x 0\n", "a.obj:2: y is 'x'; must be a finite number");
    assert_text_refused("v 0 nan 0\n", "a.obj:1: y is 'nan'; must be a finite number");
    assert_text_refused("v 0 0 1e999\n", "a.obj:1: z is '1e999'; must be a finite number");
    assert_text_refused(SQUARE "f 1 2\n", "a.obj:5: a face of 2 corners; must be at least 3");
    assert_text_refused(SQUARE "f 1 2 /3\n", "a.obj:5: corner '/3'; must be a point's number");
    assert_text_refused(SQUARE "f 1 2 3.0\n", "a.obj:5: corner '3.0'; must be a point's number");
    assert_text_refused(SQUARE "f 1 2 0\n", "a.obj:5: corner 0; must be 1 or more, or -1 to -4");
    assert_text_refused(SQUARE "f 1 2 -5\n", "a.obj:5: corner -5; must be 1 or more, or -1 to -4");
    assert_text_refused(SQUARE "f 1 2 9223372036854775808\n", "a.obj:5: corner '9223372036854775808'");
    assert_text_refused(SQUARE "f 1 2 4294967295\n", "a.obj:5: corner 4294967295");
    assert_text_refused(SQUARE "f 1 2 3\nf 1 2 \\\n 5\nf 1 2 4\n",
                        "a.obj:7: corner 5; the file has 4 points");
    assert_text_refused("f 1 1 1\n", "a.obj:1: corner 1; the file has 0 points");
    assert_text_refused(SQUARE, "a.obj: the mesh has no triangles");
    assert_text_refused("", "a.obj: the mesh has no triangles");
}

static void a_mesh_comes_back_to_the_bit(void **state)
{
    (void)state;
    struct error err = {0};
    for (int normals = 0; normals < 2; normals++) {
        struct mesh mesh = {0}, back = {0};
        add_cube(&mesh, 0.1, -1e-310, 1e300);
        if (normals)
            mesh.normal = calloc(8, sizeof *mesh.normal);
        assert_ok(mesh_save(&mesh, "a.obj", &err), &err);
        assert_ok(mesh_load("a.obj", &back, &err), &err);
        assert_same_mesh(&mesh, &back);
        mesh_clear(&mesh);
        mesh_clear(&back);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_spelling_of_a_corner_is_read),
        cmocka_unit_test(a_face_may_come_before_its_points),
        cmocka_unit_test(all_else_is_passed_over),
        cmocka_unit_test(a_backslash_continues_a_line),
        cmocka_unit_test(what_is_wrong_is_named_by_its_line),
        cmocka_unit_test(a_mesh_comes_back_to_the_bit),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
