/*
 * What mesh_load() and mesh_save() share with the formats behind them.
 *
 * A reader gets all bytes of a file (with the NUL behind them that file_read() promises) and its name for
 * messages. It writes *mesh, which is empty, when it succeeds; indices are then in range and positions
 * finite. A writer writes to a stream whose errors are found by whoever opened it.
 */
#ifndef COMMON_MESH_FILES_H
#define COMMON_MESH_FILES_H

#include "common/file.h"
#include "common/mesh.h"

enum status mesh_read_ply(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err);
enum status mesh_read_stl(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err);
enum status mesh_read_obj(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err);

/* Reads the file, and others that it names, through assimp, which knows it by its contents or extension.
 * *mesh, which must be {0} or a mesh, is replaced; after a failure it is as it was. Errors: STATUS_RESOURCE
 * where assimp is not there, STATUS_INPUT in its words, and those of mesh_from_soup(). */
enum status mesh_read_foreign(const char *path, struct mesh *mesh, struct error *err);

enum status mesh_write_ply(const struct mesh *mesh, FILE *stream, struct error *err);
void mesh_write_ply_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                           FILE *stream);
void mesh_write_vtp_values(const struct mesh *mesh, const struct mesh_value *values, size_t count,
                           FILE *stream);
enum status mesh_write_stl(const struct mesh *mesh, FILE *stream, struct error *err);
enum status mesh_write_obj(const struct mesh *mesh, FILE *stream, struct error *err);

/* Triangles as they are read, when their number is not known beforehand. */
struct triangle_list {
    uint32_t (*items)[3];
    size_t count, capacity;
};

/* Adds the triangle a b c. Errors: STATUS_NO_MEMORY, STATUS_RANGE when there are too many. */
enum status triangle_list_add(struct triangle_list *list, uint32_t a, uint32_t b, uint32_t c,
                              struct error *err);

/* Hands the triangles to a mesh that has none, and empties the list. */
void triangle_list_give(struct triangle_list *list, struct mesh *mesh);

/* Places as they are read, of points or, three a triangle, of corners. */
struct place_list {
    double (*items)[3];
    size_t count, capacity;
};

#endif
