#include "common/crc.h"
#include "common/file.h"
#include "fuzz.h"
#include "limits.h"
#include "sim/checkpoint.h"

#include <string.h>
#include <unistd.h>

enum { SIGNATURE_SIZE = 8, CHUNK_HEAD = 12, CHUNK_TAIL = 4, EDIT_SIZE = 3 };

/* Puts the right checksum behind every chunk, for else hardly any damage gets past it. */
static void mend_checksums(uint8_t *bytes, size_t size)
{
    size_t at = SIGNATURE_SIZE;
    while (at < size && size - at >= CHUNK_HEAD + CHUNK_TAIL) {
        uint64_t length = 0;
        for (int i = 0; i < 8; i++)
            length |= (uint64_t)bytes[at + 4 + (size_t)i] << 8 * i;
        if (length > size - at - CHUNK_HEAD - CHUNK_TAIL)
            return;
        const uint32_t crc = crc32_bytes(0, bytes + at, CHUNK_HEAD + (size_t)length);
        at += CHUNK_HEAD + (size_t)length;
        for (int i = 0; i < CHUNK_TAIL; i++)
            bytes[at++] = (uint8_t)(crc >> 8 * i);
    }
}

static void make_tetrahedron(struct mesh *mesh)
{
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint32_t triangle[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    must(mesh_init(mesh, 4, 4, false, NULL) == STATUS_OK);
    memcpy(mesh->position, corner, sizeof corner);
    memcpy(mesh->triangle, triangle, sizeof triangle);
    must(mesh_connect(mesh, NULL) == STATUS_OK);
}

/* Effects that remember something, each called for by a bit. */
static const struct {
    unsigned bit;
    const char *assignment;
} remembering[] = {
    {2, "balloons[0].gas.ambient=1"},
    {4, "balloons[0].plasticity.yield=0.1"},
    {8, "balloons[0].membrane.thickness=0.01"},
    {8, "balloons[0].fracture.strength=1.1"},
    {16, "contact.friction=0.3"},
    {32, "balloons[0].pins.reach=30"},
};

/* False: the method cannot do that. */
static bool open_sim(struct sim *sim, struct scene *scene, uint8_t method, unsigned bits)
{
    struct mesh mesh = {0};
    char assignment[64];
    size_t count = 0;
    while (integrators[count])
        count++;
    snprintf(assignment, sizeof assignment, "time.integrator=%s", integrators[method % count]->name);
    must(scene_from_mesh("tetrahedron", scene, NULL) == STATUS_OK);
    must(scene_set(scene, assignment, NULL) == STATUS_OK);
    for (size_t i = 0; i < sizeof remembering / sizeof *remembering; i++)
        if (bits & remembering[i].bit)
            must(scene_set(scene, remembering[i].assignment, NULL) == STATUS_OK);
    make_tetrahedron(&mesh);
    const bool opened = !scene_check(scene, NULL) && !sim_open(sim, scene, &mesh, 1, NULL);
    mesh_clear(&mesh);
    return opened;
}

/* The file that is to be read: the input itself, or a sound checkpoint with bytes
 * changed as the input says. */
static struct bytes make_file(struct sim *sim, const char *path, bool whole, const uint8_t *data, size_t size)
{
    struct bytes file = {0};
    struct checkpoint_run run = {.first_break = -1};
    if (whole) {
        file = (struct bytes){malloc(size + 1), size};
        must(file.data != NULL);
        memcpy(file.data, data, size);
        return file;
    }
    (void)sim_step(sim, NULL); /* where that ends in nothing, it is a state */
    must(checkpoint_save(sim, &run, path, NULL) == STATUS_OK && file_read(path, &file, NULL) == STATUS_OK);
    for (; size >= EDIT_SIZE; data += EDIT_SIZE, size -= EDIT_SIZE)
        file.data[(data[0] | (size_t)data[1] << 8) % file.size] ^= data[2];
    return file;
}

/* What was read can be stepped, and ends in numbers or in a message. Input: a method; bits for effects and,
 * the first, for a whole file that follows; or else edits: two bytes place, one byte to change it by. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    char folder[] = "/dev/shm/balloon-fuzz-XXXXXX", path[64];
    struct scene scene = {0};
    struct sim sim = {0};
    struct checkpoint_run run = {0};
    struct error err = {0};
    if (!open_sim(&sim, &scene, data[0], data[1])) {
        sim_clear(&sim);
        scene_clear(&scene);
        return 0;
    }
    must(mkdtemp(folder) != NULL);
    snprintf(path, sizeof path, "%s/a.ck", folder);
    struct bytes file = make_file(&sim, path, data[1] & 1, data + 2, size - 2);
    mend_checksums(file.data, file.size);
    FILE *stream = fopen(path, "wb");
    must(stream && fwrite(file.data, 1, file.size, stream) == file.size && !fclose(stream));
    size = file.size;
    bytes_clear(&file);
    limits_begin();
    enum status status = checkpoint_load(path, &sim, &run, &err);
    limits_end(size);
    must_say(status, &err);
    for (int i = 0; i < 3 && !status; i++)
        status = sim_step(&sim, &err);
    must(status == err.status);
    free(run.rows);
    unlink(path);
    rmdir(folder);
    sim_clear(&sim);
    scene_clear(&scene);
    return 0;
}
