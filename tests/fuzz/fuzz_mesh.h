/* What holds for any bytes that a mesh reader is given. */
#ifndef TESTS_FUZZ_FUZZ_MESH_H
#define TESTS_FUZZ_FUZZ_MESH_H

#include "common/mesh_files.h"
#include "fuzz.h"
#include "limits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum status mesh_reader(const struct bytes *bytes, const char *path, struct mesh *mesh,
                                struct error *err);

/* A mesh that was read has finite positions and corners that are points, and can be repaired or is refused
 * with a message. */
static inline void fuzz_read_mesh(mesh_reader *read, const uint8_t *data, size_t size)
{
    struct error err = {0};
    struct mesh mesh = {0};
    struct mesh_report report;
    struct bytes bytes = {malloc(size + 1), size};
    must(bytes.data != NULL);
    if (size > 0)
        memcpy(bytes.data, data, size);
    bytes.data[size] = '\0';
    limits_begin();
    enum status status = read(&bytes, "fuzz", &mesh, &err);
    limits_end(size);
    bytes_clear(&bytes);
    must_say(status, &err);
    if (status) {
        must(mesh.position == NULL && mesh.triangle == NULL);
        return;
    }
    for (uint32_t p = 0; p < mesh.point_count; p++)
        must(isfinite(mesh.position[p][0]) && isfinite(mesh.position[p][1]) && isfinite(mesh.position[p][2]));
    must(mesh_connect(&mesh, &err) == STATUS_OK);
    status = mesh_repair(&mesh, &report, &err);
    must(status == STATUS_OK || (status == STATUS_INPUT && err.text[0] != '\0'));
    must(status != STATUS_OK || isfinite(report.volume));
    mesh_clear(&mesh);
}

#endif
