/* Damaged files: cut at every byte, and with every byte of the head changed to every other value. A reader
 * may take them or refuse them with a message; the sanitizers see to it that it does nothing else. */
#include "common/mesh_files.h"
#include "folder.h"
#include "solids.h"

typedef enum status reader(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err);

static const char ascii_ply[] = "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty float x\n"
                                "property float y\nproperty float z\nproperty list uchar int w\n"
                                "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                "0 0 0 0\n1 0 0 2 3 4\n0 1 0 1 5\n3 0 1 2\n";
/* Lists come before numbers, so that a cut falls into a number that the header's counts do not foresee. */
static const char binary_ply[] = "ply\nformat binary_big_endian 1.0\nelement vertex 3\n"
                                 "property list uchar short w\nproperty double x\nproperty ushort y\n"
                                 "property int z\nelement face 1\nproperty list uchar uchar vertex_index\n"
                                 "property list uchar uchar v\nproperty float f\nend_header\n";
static const unsigned char binary_ply_body[3 * (1 + 2 * 3 + 8 + 2 + 4) + (1 + 3) + (1 + 1) + 4] = {
    [0] = 3, [21] = 3, [42] = 3, [63] = 3, [65] = 1, [66] = 2, [67] = 1,
};
static const char ascii_stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
static const char obj[] = "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2/1/1 -1\nf 3 2 1 3\n";

/* Reads the first `size` bytes from a block of its own, with the NUL that file_read() puts behind them.
 * True when they are a mesh. */
static bool read_some(reader *read, const void *data, size_t size)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct bytes bytes = {malloc(size + 1), size};
    memcpy(bytes.data, data, size);
    bytes.data[size] = '\0';
    enum status status = read(&bytes, "damaged", &mesh, &err);
    if (status) {
        assert_int_equal(err.status, status);
        assert_true(strlen(err.text) > 0);
        assert_null(mesh.position);
    } else {
        assert_int_equal(mesh_connect(&mesh, &err), STATUS_OK); /* so all corners are points */
    }
    mesh_clear(&mesh);
    bytes_clear(&bytes);
    return !status;
}

static void damage(reader *read, const void *whole, size_t size, size_t head)
{
    assert_true(read_some(read, whole, size)); /* as it is nothing is wrong with it */
    unsigned char *bytes = malloc(size);
    memcpy(bytes, whole, size);
    for (size_t cut = 0; cut <= size; cut++)
        read_some(read, bytes, cut);
    for (size_t i = 0; i < head; i++) {
        unsigned char right = bytes[i];
        for (int value = 0; value < 256; value++) {
            bytes[i] = (unsigned char)value;
            read_some(read, bytes, size);
        }
        bytes[i] = right;
    }
    free(bytes);
}

/* What mesh_save() makes of a cube. */
static void damage_saved(reader *read, const char *path, size_t head)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct bytes bytes = {0};
    add_cube(&mesh, 0, 0, 0);
    assert_ok(mesh_save(&mesh, path, &err), &err);
    assert_ok(file_read(path, &bytes, &err), &err);
    damage(read, bytes.data, bytes.size, head < bytes.size ? head : bytes.size);
    bytes_clear(&bytes);
    mesh_clear(&mesh);
}

static void damaged_ply_is_read_or_refused(void **state)
{
    (void)state;
    damage(mesh_read_ply, ascii_ply, strlen(ascii_ply), strlen(ascii_ply));
    damage_saved(mesh_read_ply, "a.ply", 400);
    enum { HEAD = sizeof binary_ply - 1 };
    char binary[HEAD + sizeof binary_ply_body];
    memcpy(binary, binary_ply, HEAD);
    memcpy(binary + HEAD, binary_ply_body, sizeof binary_ply_body);
    damage(mesh_read_ply, binary, sizeof binary, sizeof binary);
}

static void damaged_stl_is_read_or_refused(void **state)
{
    (void)state;
    damage(mesh_read_stl, ascii_stl, strlen(ascii_stl), strlen(ascii_stl));
    damage_saved(mesh_read_stl, "a.stl", 200);
}

static void damaged_obj_is_read_or_refused(void **state)
{
    (void)state;
    damage(mesh_read_obj, obj, strlen(obj), strlen(obj));
    damage_saved(mesh_read_obj, "a.obj", 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_ply_is_read_or_refused),
        cmocka_unit_test(damaged_stl_is_read_or_refused),
        cmocka_unit_test(damaged_obj_is_read_or_refused),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
