/*
 * The header of a PLY file (G. Turk, "The PLY polygon file format", Stanford 1994): which elements follow,
 * how many, and of what properties each is made.
 */
#ifndef COMMON_PLY_H
#define COMMON_PLY_H

#include "common/text.h"

#include <stdint.h>

enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN };

enum ply_type { PLY_INT8, PLY_UINT8, PLY_INT16, PLY_UINT16, PLY_INT32, PLY_UINT32, PLY_FLOAT, PLY_DOUBLE };

/* What a property is to a mesh. */
enum ply_role {
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_NX,
    PLY_NY,
    PLY_NZ,
    PLY_OTHER,   /* skipped */
    PLY_CORNERS, /* a face's list of points */
};

struct ply_property {
    enum ply_role role;
    bool is_list;
    enum ply_type type, count_type; /* of the value or each item; of a list's length */
};

enum ply_kind { PLY_VERTEX, PLY_FACE, PLY_UNKNOWN };

struct ply_element {
    enum ply_kind kind;
    struct word name;
    uint64_t count;
    size_t first_property, property_count;
    unsigned roles; /* bit `1 << role` is set for each role that a property has */
};

struct ply_header {
    enum ply_format format;
    struct {
        struct ply_element *items;
        size_t count, capacity;
    } elements;
    struct {
        struct ply_property *items;
        size_t count, capacity;
    } properties;
};

/* Reads the header; *text then stands at the first byte behind it. Names point into the text. Refuses a
 * header without x, y, z or faces, and counts that cannot be in what is left of the text. Clear *header,
 * whatever is returned. */
enum status ply_header_read(struct text *text, struct ply_header *header, struct error *err);
void ply_header_clear(struct ply_header *header);

/* Bytes of one value in a binary file. */
size_t ply_type_size(enum ply_type type);

#endif
