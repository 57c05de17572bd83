/* PLY: what is read, what is refused and how it is named, and that positions come back to the bit. */
#include "common/mesh.h"
#include "common/random.h"
#include "folder.h"
#include "solids.h"

#define POINTS "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES  "element face 1\nproperty list uchar int vertex_indices\n"
#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
#define HEAD   "ply\nformat ascii 1.0\n" POINTS FACES "end_header\n"

/* A unit square of two triangles, whatever way it was written. */
static void assert_square(const struct mesh *mesh)
{
    const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
    struct mesh wanted = mesh_of(position, 4, triangle, 2);
    assert_same_mesh(mesh, &wanted);
    mesh_clear(&wanted);
}

static struct mesh loaded(const char *path)
{
    struct error err = {0};
    struct mesh mesh = {0};
    assert_ok(mesh_load(path, &mesh, &err), &err);
    return mesh;
}

static void assert_reads_as_square(const void *bytes, size_t size)
{
    write_bytes("a.ply", bytes, size);
    struct mesh mesh = loaded("a.ply");
    assert_square(&mesh);
    mesh_clear(&mesh);
}

static void assert_text_refused(const char *text, const char *message)
{
    struct error err = {0};
    struct mesh mesh = {0};
    write_text("a.ply", text);
    assert_refused(mesh_load("a.ply", &mesh, &err), STATUS_INPUT, message, &err);
    assert_null(mesh.position);
}

static void polygons_are_cut_into_fans(void **state)
{
    (void)state;
    static const char text[] = HEAD SQUARE "4 0 1 2 3\n";
    assert_reads_as_square(text, strlen(text));
}

static void line_ends_blank_lines_and_comments_do_not_matter(void **state)
{
    (void)state;
    static const char text[] = "ply\r\ncomment made by hand\r\nformat ascii 1.0\r\nobj_info 7 8\r\n\r\n"
                               "element vertex 4\r\nproperty double x\r\nproperty double y\r\ncomment\r\n"
                               "property double z\r\nelement face 1\r\n"
                               "property list uint8 uint32 vertex_index\r\nend_header\r\n"
                               "0 0 0\r\n\r\n1 0 0 \r\n\t1 1 0\r\n0 1e0 -0x0\r\n4 0 1 2 3";
    write_text("a.ply", text);
    struct mesh mesh = loaded("a.ply");
    mesh.position[3][2] += 0.0; /* -0 is kept */
    assert_square(&mesh);
    mesh_clear(&mesh);
}

static void unknown_elements_and_properties_are_skipped_in_any_order(void **state)
{
    (void)state;
    static const char text[] =
        "ply\nformat ascii 1.0\n"
        "element material 2\nproperty list char float weights\nproperty uchar red\n"
        "element nothing 3\n"
        "element face 1\nproperty int flags\n"
        "property list uchar short vertex_indices\nproperty list uint double texcoord\n"
        "element vertex 4\nproperty short z\nproperty list int int tags\n"
        "property uint x\nproperty float quality\nproperty int8 y\n"
        "end_header\n"
        "0 255\n2 .5 .25 0\n"
        "-1 4 0 1 2 3 2 0.5 0.5\n"
        "0 0 0 1.5 0\n0 1 7 1 nan 0\n0 2 8 9 1 1 1\n0 0 0 1 1\n";
    assert_reads_as_square(text, strlen(text));
}

/* The same file in either byte order, put together value by value. */
struct writer {
    unsigned char bytes[1000];
    size_t size;
    bool big_endian;
};

static void put(struct writer *writer, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; i++)
        writer->bytes[writer->size++] = (unsigned char)(bits >> 8 * (writer->big_endian ? size - 1 - i : i));
}

static void put_float(struct writer *writer, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(writer, bits, 4);
}

static void put_double(struct writer *writer, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(writer, bits, 8);
}

static void put_text(struct writer *writer, const char *text)
{
    memcpy(writer->bytes + writer->size, text, strlen(text));
    writer->size += strlen(text);
}

static void both_byte_orders_and_every_type_are_read(void **state)
{
    (void)state;
    for (int big_endian = 0; big_endian < 2; big_endian++) {
        struct writer writer = {.big_endian = big_endian};
        put_text(&writer, big_endian ? "ply\nformat binary_big_endian 1.0\n"
                                     : "ply\nformat binary_little_endian 1.0\n");
        put_text(&writer, "element vertex 4\nproperty double x\nproperty list ushort short tags\n"
                          "property float y\nproperty char z\n"
                          "element face 1\nproperty uint id\nproperty list int ushort vertex_indices\n"
                          "end_header\n");
        for (unsigned p = 0; p < 4; p++) {
            put_double(&writer, p == 1 || p == 2);
            put(&writer, p, 2);
            for (unsigned i = 0; i < p; i++)
                put(&writer, 0xffff, 2);
            put_float(&writer, p >= 2);
            put(&writer, 0, 1);
        }
        put(&writer, 0xdeadbeef, 4);
        put(&writer, 4, 4);
        for (unsigned k = 0; k < 4; k++)
            put(&writer, k, 2);
        assert_reads_as_square(writer.bytes, writer.size);
    }
}

static void whole_number_types_keep_their_sign(void **state)
{
    (void)state;
    static const char *const types[][3] = {
        {"char", "short", "int"}, {"uchar", "ushort", "uint"}, {"int8", "int16", "int32"}};
    for (int i = 0; i < 3; i++) {
        struct writer writer = {0};
        char head[300];
        snprintf(head, sizeof head,
                 "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty %s x\nproperty %s y\n"
                 "property %s z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n",
                 types[i][0], types[i][1], types[i][2]);
        put_text(&writer, head);
        for (unsigned p = 0; p < 3; p++) {
            put(&writer, 0xf0 + p, 1);
            put(&writer, 0xfff0, 2);
            put(&writer, 0xfffffff0, 4);
        }
        put(&writer, 0x02010003, 4);
        write_bytes("a.ply", writer.bytes, writer.size);
        struct mesh mesh = loaded("a.ply");
        bool is_signed = i != 1;
        assert_near(mesh.position[1][0], is_signed ? -15.0 : 241.0, 0);
        assert_near(mesh.position[1][1], is_signed ? -16.0 : 65520.0, 0);
        assert_near(mesh.position[1][2], is_signed ? -16.0 : 4294967280.0, 0);
        mesh_clear(&mesh);
    }
}

/* A mesh of n random points, every bit of a finite coordinate possible. */
static struct mesh random_mesh(uint32_t n, bool normals)
{
    struct mesh mesh;
    uint64_t seed = 42;
    assert_int_equal(mesh_init(&mesh, n, 2 * n, normals, NULL), STATUS_OK);
    for (uint32_t p = 0; p < n; p++) {
        for (int i = 0; i < 3; i++) {
            uint64_t bits;
            do {
                bits = random_bits(&seed);
                memcpy(&mesh.position[p][i], &bits, sizeof bits);
            } while (!isfinite(mesh.position[p][i]));
            if (normals)
                mesh.normal[p][i] = (i == (int)p % 3) ? 1 : 0;
        }
    }
    for (uint32_t t = 0; t < 2 * n; t++) {
        for (int k = 0; k < 3; k++)
            mesh.triangle[t][k] = (uint32_t)(random_bits(&seed) % n);
    }
    return mesh;
}

static void positions_and_triangles_come_back_to_the_bit(void **state)
{
    (void)state;
    struct error err = {0};
    for (int normals = 0; normals < 2; normals++) {
        struct mesh mesh = random_mesh(500, normals);
        assert_ok(mesh_save(&mesh, "a.ply", &err), &err);
        struct mesh back = loaded("a.ply");
        assert_same_mesh(&mesh, &back);
        assert_int_equal(back.normal != NULL, normals);
        if (normals)
            assert_memory_equal(mesh.normal, back.normal, 500 * sizeof *mesh.normal);
        mesh_clear(&mesh);
        mesh_clear(&back);
    }
}

static void normals_are_made_unit_length_or_left_out(void **state)
{
    (void)state;
    static const char head[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                               "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    char text[500];
    snprintf(text, sizeof text, "%s0 0 0 0 0 2\n1 0 0 0 3 4\n0 1 0 1 0 0\n3 0 1 2\n", head);
    write_text("a.ply", text);
    struct mesh mesh = loaded("a.ply");
    assert_near(mesh.normal[0][2], 1, 0);
    assert_near(mesh.normal[1][1], 0.6, 1e-16);
    assert_near(mesh.normal[1][2], 0.8, 1e-16);
    mesh_clear(&mesh);
    snprintf(text, sizeof text, "%s0 0 0 0 0 0\n1 0 0 0 3 4\n0 1 0 nan 0 0\n3 0 1 2\n", head);
    write_text("a.ply", text);
    mesh = loaded("a.ply");
    assert_null(mesh.normal);
    mesh_clear(&mesh);
}

static void a_header_that_is_wrong_is_named_by_its_line(void **state)
{
    (void)state;
    assert_text_refused("", "a.ply:1: no PLY file: the first line must be 'ply'");
    assert_text_refused("plyx\n", "a.ply:1: no PLY file");
    assert_text_refused("ply\nformat ascii 1.0\n", "the header does not end");
    assert_text_refused("ply\n" POINTS FACES "end_header\n", "the header has no line 'format'");
    assert_text_refused("ply\nformat binary 1.0\n" POINTS, "a.ply:2: format 'binary'; must be ascii,");
    assert_text_refused("ply\nformat ascii 2.0\n" POINTS, "a.ply:2: version '2.0' of PLY; must be 1.0");
    assert_text_refused("ply\nelement vertex -1\nx", "a.ply:2: the number of elements is '-1'");
    assert_text_refused("ply\nelement vertex 99999999999999999999\nx", "'99999999999999999999'");
    assert_text_refused("ply\nelement vertex 1\nelement vertex 1\nx", "a.ply:3: a second element vertex");
    assert_text_refused("ply\nproperty int x\nx", "a.ply:2: a property before the first element");
    assert_text_refused("ply\nelement vertex 1\nproperty long x\nx", "a.ply:3: type 'long'; must be char,");
    assert_text_refused("ply\nelement vertex 1\nproperty float\nx", "a.ply:3: the property has no name");
    assert_text_refused("ply\nelement vertex 1\nproperty float x\nproperty int x\nx",
                        "a.ply:4: a second property x");
    assert_text_refused("ply\nelement vertex 1\nproperty list uchar float x\nx",
                        "a.ply:3: x is a list; must be a single number");
    assert_text_refused("ply\nelement face 1\nproperty int vertex_index\nx",
                        "a.ply:3: vertex_index is no list; must be a list");
    assert_text_refused("ply\nelement face 1\nproperty list float int vertex_index\nx",
                        "a.ply:3: a list's length is a float");
    assert_text_refused("ply\nbad \x1b[31m words\nx", "a.ply:2: 'bad' in the header; must be format,");
    assert_text_refused("ply\n\x1b[31m\nx", "a.ply:2: '?[31m' in the header");
    assert_text_refused("ply\nformat ascii 1.0\n" FACES "end_header\n3 0 1 2\n", "no element vertex");
    assert_text_refused("ply\nformat ascii 1.0\n" POINTS "end_header\n" SQUARE, "no element face");
}

static void a_text_body_that_is_wrong_is_named_by_line_and_element(void **state)
{
    (void)state;
    assert_text_refused(HEAD "0 0 0\n1 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
                        "a.ply:11: vertex 1: a number is missing");
    assert_text_refused(HEAD "0 0 0\n1 0 0 5\n1 1 0\n0 1 0\n4 0 1 2 3\n", "a.ply:11: vertex 1: '5' is more");
    assert_text_refused(HEAD "0 0 0\n1 0 O\n1 1 0\n0 1 0\n4 0 1 2 3\n",
                        "a.ply:11: vertex 1: 'O' is no number");
    assert_text_refused(HEAD "0 0 0\n1 nan 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "a.ply:11: vertex 1: y is nan");
    assert_text_refused(HEAD "0 0 0\n1 1e999 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "vertex 1: y is inf");
    assert_text_refused(HEAD SQUARE "4 0 1 2 4\n",
                        "a.ply:14: face 0: corner 3 is vertex 4; there are 4, from 0 on");
    assert_text_refused(
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nproperty int z\n" FACES
        "end_header\n3 0 1 2\n",
        "corner 0 is vertex 0; there are 0, from 0 on");
    assert_text_refused(HEAD SQUARE "4 0 1 2 -1\n", "corner 3 is vertex -1");
    assert_text_refused(HEAD SQUARE "4 0 1 2 1.5\n", "corner 3 is vertex 1.5");
    assert_text_refused(HEAD SQUARE "2 0 1\n", "a.ply:14: face 0: 2 corners; a face needs at least 3");
    assert_text_refused(HEAD SQUARE "-3 0 1 2\n", "face 0: a list of -3 values");
    assert_text_refused(HEAD SQUARE "4000000000 0 1 2\n", "face 0: a list of 4e+09 values");
    assert_text_refused(HEAD SQUARE "nan 0 1 2\n", "a list of nan values");
    assert_text_refused(HEAD SQUARE "\n",
                        "a.ply:15: face 0: the file ends here; the header promises 1 of them");
    assert_text_refused(HEAD SQUARE "4 0 1 2 3\n3 0 1 2\n", "a.ply:15: the file goes on behind the last");
}

static void a_binary_body_that_is_wrong_is_named_by_its_element(void **state)
{
    (void)state;
    static const unsigned char corners[] = {4, 0, 1, 2, 9};
    struct error err = {0};
    struct mesh mesh = {0};
    struct writer writer = {0};
    put_text(&writer, "ply\nformat binary_little_endian 1.0\n" POINTS
                      "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n");
    for (int i = 0; i < 12; i++)
        put_float(&writer, i == 7 ? NAN : 0);
    size_t seventh = writer.size - 5 * 4;
    memcpy(writer.bytes + writer.size, corners, sizeof corners);
    writer.size += sizeof corners;
    write_bytes("a.ply", writer.bytes, writer.size);
    assert_refused(mesh_load("a.ply", &mesh, &err), STATUS_INPUT, "a.ply: vertex 2: y is nan", &err);
    memset(writer.bytes + seventh, 0, 4);
    write_bytes("a.ply", writer.bytes, writer.size);
    assert_refused(mesh_load("a.ply", &mesh, &err), STATUS_INPUT, "a.ply: face 0: corner 3 is vertex 9",
                   &err);
    write_bytes("a.ply", writer.bytes, writer.size - 1);
    assert_refused(mesh_load("a.ply", &mesh, &err), STATUS_INPUT, "a.ply: face 0: a list of 4 values", &err);
    writer.bytes[writer.size - 1] = 3;
    put_text(&writer, "abc");
    write_bytes("a.ply", writer.bytes, writer.size);
    assert_refused(mesh_load("a.ply", &mesh, &err), STATUS_INPUT, "a.ply: 3 bytes behind the last", &err);
}

static void counts_that_cannot_be_in_the_file_are_refused_before_memory_is_asked_for(void **state)
{
    (void)state;
    assert_text_refused("ply\nformat ascii 1.0\n" POINTS "element face 4000000000\n"
                        "property list uchar int vertex_indices\nend_header\n" SQUARE,
                        "a.ply: 4000000000 elements face cannot be in the 24 bytes behind the header");
    assert_text_refused("ply\nformat binary_big_endian 1.0\nelement vertex 9223372036854775807\n"
                        "property char x\nproperty char y\nproperty char z\n" FACES "end_header\n",
                        "9223372036854775807 elements vertex cannot be in the 0 bytes behind the header");
}

static void a_failed_load_leaves_the_mesh_as_it_was(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0}, before = {0};
    add_cube(&mesh, 0, 0, 0);
    add_cube(&before, 0, 0, 0);
    write_text("a.ply", HEAD SQUARE "4 0 1 2 4\n");
    assert_int_equal(mesh_load("a.ply", &mesh, &err), STATUS_INPUT);
    assert_same_mesh(&mesh, &before);
    write_text("a.ply", HEAD SQUARE "4 0 1 2 3\n");
    assert_int_equal(mesh_load("a.ply", &mesh, &err), STATUS_OK);
    assert_square(&mesh);
    mesh_clear(&mesh);
    mesh_clear(&before);
}

static void a_mesh_without_triangles_and_files_of_other_kinds_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    assert_text_refused("ply\nformat ascii 1.0\n" POINTS
                        "element face 0\nproperty list uchar int vertex_indices\nend_header\n" SQUARE,
                        "a.ply: the mesh has no triangles");
    assert_refused(mesh_load("a.txt", &mesh, &err), STATUS_INPUT, "a.txt: no known mesh file; must be .ply",
                   &err);
    assert_refused(mesh_load("ply", &mesh, &err), STATUS_INPUT, "ply: no known mesh file", &err);
    assert_refused(mesh_load("none.ply", &mesh, &err), STATUS_FILE, "none.ply: cannot open", &err);
    add_cube(&mesh, 0, 0, 0);
    assert_refused(mesh_save(&mesh, "a.off", &err), STATUS_USAGE, "a.off: no known mesh format", &err);
    assert_refused(mesh_save(&mesh, "no/a.ply", &err), STATUS_FILE, "no/a.ply: cannot create", &err);
    mesh_clear(&mesh);
}

static void extensions_may_be_upper_case(void **state)
{
    (void)state;
    write_text("A.PLY", HEAD SQUARE "4 0 1 2 3\n");
    struct mesh mesh = loaded("A.PLY");
    assert_square(&mesh);
    mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_are_cut_into_fans),
        cmocka_unit_test(line_ends_blank_lines_and_comments_do_not_matter),
        cmocka_unit_test(unknown_elements_and_properties_are_skipped_in_any_order),
        cmocka_unit_test(both_byte_orders_and_every_type_are_read),
        cmocka_unit_test(whole_number_types_keep_their_sign),
        cmocka_unit_test(positions_and_triangles_come_back_to_the_bit),
        cmocka_unit_test(normals_are_made_unit_length_or_left_out),
        cmocka_unit_test(a_header_that_is_wrong_is_named_by_its_line),
        cmocka_unit_test(a_text_body_that_is_wrong_is_named_by_line_and_element),
        cmocka_unit_test(a_binary_body_that_is_wrong_is_named_by_its_element),
        cmocka_unit_test(counts_that_cannot_be_in_the_file_are_refused_before_memory_is_asked_for),
        cmocka_unit_test(a_failed_load_leaves_the_mesh_as_it_was),
        cmocka_unit_test(a_mesh_without_triangles_and_files_of_other_kinds_are_refused),
        cmocka_unit_test(extensions_may_be_upper_case),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
