/*
 * The body of a PLY file. Text and binary differ only in next_value(): an element is read value by value as
 * doubles, which hold every PLY type exactly.
 */
#include "common/array.h"
#include "common/mesh_files.h"
#include "common/ply.h"
#include "common/vec3.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

struct ply_body {
    struct text text; /* in a binary file only its `at` moves */
    struct ply_header header;
    const struct ply_element *element; /* now being read, and its number, from 0 */
    uint64_t number;
    struct mesh mesh;
    struct triangle_list triangles;
};

/* "PATH:LINE: face 7: ..." in a text, "PATH: face 7: ..." in a binary file. */
__attribute__((format(printf, 3, 4))) static enum status body_fail(const struct ply_body *body,
                                                                   struct error *err, const char *format, ...)
{
    char what[ERROR_TEXT_SIZE / 2], name[WORD_SHOWN_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    word_show(body->element->name, name);
    if (body->header.format == PLY_ASCII)
        return text_fail(&body->text, err, "%s %llu: %s", name, (unsigned long long)body->number, what);
    return error_set(err, STATUS_INPUT, "%s: %s %llu: %s", body->text.path, name,
                     (unsigned long long)body->number, what);
}

static double binary_value(const unsigned char *bytes, enum ply_type type, bool big_endian)
{
    uint64_t bits = 0;
    size_t size = ply_type_size(type);
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)bytes[big_endian ? size - 1 - i : i] << 8 * i;
    uint32_t word = (uint32_t)bits;
    float single;
    double value;
    switch (type) {
    case PLY_INT8:
        return (int8_t)word;
    case PLY_INT16:
        return (int16_t)word;
    case PLY_INT32:
        return (int32_t)word;
    case PLY_FLOAT:
        memcpy(&single, &word, sizeof single);
        return (double)single;
    case PLY_DOUBLE:
        memcpy(&value, &bits, sizeof value);
        return value;
    default:
        return word;
    }
}

static enum status next_text_value(struct ply_body *body, double *value, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (text_ended(&body->text))
        return body_fail(body, err, "the file ends here; the header promises %llu of them",
                         (unsigned long long)body->element->count);
    if (!text_word(&body->text, &word))
        return body_fail(body, err, "a number is missing at the end of its line");
    if (!word_number(word, value))
        return body_fail(body, err, "'%s' is no number", word_show(word, shown));
    return STATUS_OK;
}

static enum status next_value(struct ply_body *body, enum ply_type type, double *value, struct error *err)
{
    if (body->header.format == PLY_ASCII)
        return next_text_value(body, value, err);
    size_t size = ply_type_size(type);
    if ((size_t)(body->text.end - body->text.at) < size)
        return body_fail(body, err, "the file ends here; the header promises %llu of them",
                         (unsigned long long)body->element->count);
    *value = binary_value((const unsigned char *)body->text.at, type, body->header.format == PLY_BIG_ENDIAN);
    body->text.at += size;
    return STATUS_OK;
}

/* The length of a list, which the values left in the file bound. */
static enum status list_length(struct ply_body *body, const struct ply_property *property, size_t *length,
                               struct error *err)
{
    double value;
    enum status status = next_value(body, property->count_type, &value, err);
    if (status)
        return status;
    size_t size = body->header.format == PLY_ASCII ? 1 : ply_type_size(property->type);
    size_t most = (size_t)(body->text.end - body->text.at) / size;
    if (!(value >= 0) || value > (double)most || value != (double)(size_t)value)
        return body_fail(body, err, "a list of %g values; the file has room for 0 to %zu", value, most);
    *length = (size_t)value;
    return STATUS_OK;
}

static enum status skip_list(struct ply_body *body, const struct ply_property *property, struct error *err)
{
    size_t length = 0;
    double ignored;
    enum status status = list_length(body, property, &length, err);
    if (!status && body->header.format != PLY_ASCII) {
        body->text.at += length * ply_type_size(property->type);
        return STATUS_OK;
    }
    for (size_t i = 0; i < length && !status; i++)
        status = next_text_value(body, &ignored, err);
    return status;
}

/* A face's corners a, b, c, d ... become the triangles abc, acd ... */
static enum status read_corners(struct ply_body *body, const struct ply_property *property, struct error *err)
{
    size_t length = 0;
    uint32_t corner[3]; /* the first, the one before, this one */
    double value;
    enum status status = list_length(body, property, &length, err);
    if (!status && length < 3)
        status = body_fail(body, err, "%zu corners; a face needs at least 3", length);
    for (size_t i = 0; i < length && !status; i++) {
        status = next_value(body, property->type, &value, err);
        if (status)
            break;
        if (!(value >= 0 && value < body->mesh.point_count) || value != (double)(uint32_t)value)
            return body_fail(body, err, "corner %zu is vertex %.17g; there are %u, from 0 on", i, value,
                             body->mesh.point_count);
        corner[i < 2 ? i : 2] = (uint32_t)value;
        if (i >= 2) {
            status = triangle_list_add(&body->triangles, corner[0], corner[1], corner[2], err);
            corner[1] = corner[2];
        }
    }
    return status;
}

/* Where the value of each role goes: value[role], with a place for what is skipped. */
static enum status read_element(struct ply_body *body, double value[PLY_OTHER + 1], struct error *err)
{
    enum status status = STATUS_OK;
    const struct ply_property *property = &body->header.properties.items[body->element->first_property];
    for (size_t i = 0; i < body->element->property_count && !status; i++, property++) {
        if (!property->is_list)
            status = next_value(body, property->type, &value[property->role], err);
        else if (property->role == PLY_CORNERS)
            status = read_corners(body, property, err);
        else
            status = skip_list(body, property, err);
    }
    return status;
}

static enum status keep_vertex(struct ply_body *body, const double value[PLY_OTHER + 1], struct error *err)
{
    static const char axis[] = "xyz";
    for (int i = 0; i < 3; i++) {
        if (!isfinite(value[PLY_X + i]))
            return body_fail(body, err, "%c is %g; must be a finite number", axis[i], value[PLY_X + i]);
        body->mesh.position[body->number][i] = value[PLY_X + i];
        if (body->mesh.normal)
            body->mesh.normal[body->number][i] = value[PLY_NX + i];
    }
    return STATUS_OK;
}

/* Text elements have a line each; blank lines do not count. */
static void to_line_of_element(struct text *text)
{
    struct word word;
    struct text ahead = *text;
    while (!text_ended(text) && !text_word(&ahead, &word)) {
        text_next_line(text);
        ahead = *text;
    }
}

static enum status end_line_of_element(struct ply_body *body, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (text_word(&body->text, &word))
        return body_fail(body, err, "'%s' is more than the header's properties ask for",
                         word_show(word, shown));
    text_next_line(&body->text);
    return STATUS_OK;
}

static enum status read_elements(struct ply_body *body, struct error *err)
{
    enum status status = STATUS_OK;
    bool is_text = body->header.format == PLY_ASCII;
    uint64_t count = body->element->property_count > 0 ? body->element->count : 0;
    for (body->number = 0; body->number < count && !status; body->number++) {
        double value[PLY_OTHER + 1];
        if (is_text)
            to_line_of_element(&body->text);
        status = read_element(body, value, err);
        if (!status && body->element->kind == PLY_VERTEX)
            status = keep_vertex(body, value, err);
        if (!status && is_text)
            status = end_line_of_element(body, err);
    }
    return status;
}

/* Room for the points of the header, whose number the header's reader has checked. */
static enum status make_room(struct ply_body *body, struct error *err)
{
    const unsigned normal_roles = 1 << PLY_NX | 1 << PLY_NY | 1 << PLY_NZ;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < body->header.elements.count && !status; i++) {
        const struct ply_element *element = &body->header.elements.items[i];
        bool normals = (element->roles & normal_roles) == normal_roles;
        if (element->kind == PLY_VERTEX)
            status = mesh_init(&body->mesh, element->count, 0, normals, err);
        else if (element->kind == PLY_FACE && !ARRAY_RESERVE(&body->triangles, element->count))
            status = error_no_memory(err, body->text.path);
    }
    return status;
}

/* What is behind the last element must be blank: else the header's counts are not the file's. */
static enum status check_end(struct ply_body *body, struct error *err)
{
    struct word word;
    if (!text_any_word(&body->text, &word))
        return STATUS_OK;
    size_t left = (size_t)(body->text.end - word.start);
    if (body->header.format == PLY_ASCII)
        return text_fail(&body->text, err,
                         "the file goes on behind the last element; the header counts fewer");
    return error_set(err, STATUS_INPUT, "%s: %zu bytes behind the last element; the header counts fewer",
                     body->text.path, left);
}

/* Makes normals unit length, leaving those alone that are but for a float's rounding. If some have no
 * direction there are none. */
static void tidy_normals(struct mesh *mesh)
{
    for (uint32_t p = 0; mesh->normal && p < mesh->point_count; p++) {
        double *normal = mesh->normal[p], length = vec3_length(normal);
        if (!(length > 0 && length < HUGE_VAL)) {
            free(mesh->normal);
            mesh->normal = NULL;
        } else if (fabs(length - 1) > 1e-6) {
            for (int i = 0; i < 3; i++)
                normal[i] /= length;
        }
    }
}

static enum status read_body(struct ply_body *body, struct error *err)
{
    enum status status = make_room(body, err);
    for (size_t i = 0; i < body->header.elements.count && !status; i++) {
        body->element = &body->header.elements.items[i];
        status = read_elements(body, err);
    }
    if (!status)
        status = check_end(body, err);
    return status;
}

enum status mesh_read_ply(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err)
{
    struct ply_body body = {.text = text_of(path, bytes->data, bytes->size)};
    enum status status = ply_header_read(&body.text, &body.header, err);
    if (!status)
        status = read_body(&body, err);
    if (!status) {
        triangle_list_give(&body.triangles, &body.mesh);
        tidy_normals(&body.mesh);
        *mesh = body.mesh;
        body.mesh = (struct mesh){0};
    }
    ply_header_clear(&body.header);
    mesh_clear(&body.mesh);
    free(body.triangles.items);
    return status;
}
