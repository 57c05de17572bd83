#include "common/array.h"
#include "common/ply.h"

#include <stdlib.h>

static const struct {
    const char *name, *other_name;
    size_t size;
} types[] = {
    [PLY_INT8] = {"char", "int8", 1},      [PLY_UINT8] = {"uchar", "uint8", 1},
    [PLY_INT16] = {"short", "int16", 2},   [PLY_UINT16] = {"ushort", "uint16", 2},
    [PLY_INT32] = {"int", "int32", 4},     [PLY_UINT32] = {"uint", "uint32", 4},
    [PLY_FLOAT] = {"float", "float32", 4}, [PLY_DOUBLE] = {"double", "float64", 8},
};

static const char *const format_names[] = {"ascii", "binary_little_endian", "binary_big_endian"};

static const char *const vertex_roles[] = {"x", "y", "z", "nx", "ny", "nz"};

enum { POSITION_ROLES = 1 << PLY_X | 1 << PLY_Y | 1 << PLY_Z };

size_t ply_type_size(enum ply_type type)
{
    return types[type].size;
}

void ply_header_clear(struct ply_header *header)
{
    free(header->elements.items);
    free(header->properties.items);
    *header = (struct ply_header){0};
}

static enum status read_format(struct text *text, struct ply_header *header, struct error *err)
{
    struct word format, version;
    char shown[WORD_SHOWN_SIZE];
    text_word(text, &format);
    text_word(text, &version);
    for (unsigned i = 0; i < sizeof format_names / sizeof *format_names; i++) {
        if (word_is(format, format_names[i])) {
            header->format = (enum ply_format)i;
            if (!word_is(version, "1.0"))
                return text_fail(text, err, "version '%s' of PLY; must be 1.0", word_show(version, shown));
            return STATUS_OK;
        }
    }
    return text_fail(text, err, "format '%s'; must be ascii, binary_little_endian or binary_big_endian",
                     word_show(format, shown));
}

static enum status read_element(struct text *text, struct ply_header *header, struct error *err)
{
    struct ply_element element = {.kind = PLY_UNKNOWN, .first_property = header->properties.count};
    struct word count;
    long long value;
    char shown[WORD_SHOWN_SIZE];
    text_word(text, &element.name);
    text_word(text, &count);
    if (!word_whole(count, &value) || value < 0)
        return text_fail(text, err, "the number of elements is '%s'; must be a whole number",
                         word_show(count, shown));
    element.count = (uint64_t)value;
    if (word_is(element.name, "vertex"))
        element.kind = PLY_VERTEX;
    else if (word_is(element.name, "face"))
        element.kind = PLY_FACE;
    for (size_t i = 0; i < header->elements.count; i++) {
        if (element.kind != PLY_UNKNOWN && header->elements.items[i].kind == element.kind)
            return text_fail(text, err, "a second element %s; there must be one",
                             word_show(element.name, shown));
    }
    if (!ARRAY_RESERVE(&header->elements, 1))
        return error_no_memory(err, text->path);
    header->elements.items[header->elements.count++] = element;
    return STATUS_OK;
}

static enum status read_type(struct text *text, struct word word, enum ply_type *type, struct error *err)
{
    char shown[WORD_SHOWN_SIZE];
    for (unsigned i = 0; i < sizeof types / sizeof *types; i++) {
        if (word_is(word, types[i].name) || word_is(word, types[i].other_name)) {
            *type = (enum ply_type)i;
            return STATUS_OK;
        }
    }
    return text_fail(text, err, "type '%s'; must be char, uchar, short, ushort, int, uint, float or double",
                     word_show(word, shown));
}

static enum ply_role role_of(enum ply_kind kind, struct word name)
{
    if (kind == PLY_FACE && (word_is(name, "vertex_indices") || word_is(name, "vertex_index")))
        return PLY_CORNERS;
    for (unsigned i = 0; kind == PLY_VERTEX && i < sizeof vertex_roles / sizeof *vertex_roles; i++) {
        if (word_is(name, vertex_roles[i]))
            return (enum ply_role)i;
    }
    return PLY_OTHER;
}

/* The types and the name of a property: what follows the word "property". */
static enum status read_property_line(struct text *text, struct ply_property *property, struct word *name,
                                      struct error *err)
{
    struct word word;
    enum status status = STATUS_OK;
    text_word(text, &word);
    property->is_list = word_is(word, "list");
    if (property->is_list) {
        text_word(text, &word);
        status = read_type(text, word, &property->count_type, err);
        if (!status && property->count_type >= PLY_FLOAT)
            status = text_fail(text, err, "a list's length is a float; must be a type of whole numbers");
        text_word(text, &word);
    }
    if (!status)
        status = read_type(text, word, &property->type, err);
    if (!status && !text_word(text, name))
        status = text_fail(text, err, "the property has no name");
    return status;
}

static enum status read_property(struct text *text, struct ply_header *header, struct error *err)
{
    struct ply_property property = {0};
    struct word name;
    char shown[WORD_SHOWN_SIZE];
    if (header->elements.count == 0)
        return text_fail(text, err, "a property before the first element");
    enum status status = read_property_line(text, &property, &name, err);
    if (status)
        return status;
    struct ply_element *element = &header->elements.items[header->elements.count - 1];
    property.role = role_of(element->kind, name);
    unsigned bit = 1u << property.role;
    if (property.role != PLY_OTHER && element->roles & bit)
        return text_fail(text, err, "a second property %s", word_show(name, shown));
    if (property.role != PLY_OTHER && property.is_list != (property.role == PLY_CORNERS))
        return text_fail(text, err, "%s is %s; must be %s", word_show(name, shown),
                         property.is_list ? "a list" : "no list",
                         property.is_list ? "a single number" : "a list");
    if (!ARRAY_RESERVE(&header->properties, 1))
        return error_no_memory(err, text->path);
    header->properties.items[header->properties.count++] = property;
    element->property_count++;
    element->roles |= bit;
    return STATUS_OK;
}

/* The least number of bytes that one element takes: in a text every value is a digit and a space. */
static size_t least_size(const struct ply_header *header, const struct ply_element *element)
{
    size_t size = 0;
    for (size_t i = 0; i < element->property_count; i++) {
        const struct ply_property *property = &header->properties.items[element->first_property + i];
        size += header->format == PLY_ASCII
                    ? 2
                    : types[property->is_list ? property->count_type : property->type].size;
    }
    return size;
}

static enum status check_elements(const struct text *text, const struct ply_header *header, struct error *err)
{
    size_t left = (size_t)(text->end - text->at);
    unsigned roles = 0;
    char shown[WORD_SHOWN_SIZE];
    for (size_t i = 0; i < header->elements.count; i++) {
        const struct ply_element *element = &header->elements.items[i];
        size_t size = least_size(header, element);
        roles |= element->roles;
        /* a text's last line need not end */
        if (size > 0 && element->count > (left + (header->format == PLY_ASCII)) / size)
            return error_set(err, STATUS_INPUT,
                             "%s: %llu elements %s cannot be in the %zu bytes behind the header; the file is "
                             "cut short, or its header is wrong",
                             text->path, (unsigned long long)element->count, word_show(element->name, shown),
                             left);
    }
    if ((roles & POSITION_ROLES) != POSITION_ROLES)
        return error_set(err, STATUS_INPUT, "%s: no element vertex with properties x, y and z", text->path);
    if (!(roles & 1 << PLY_CORNERS))
        return error_set(err, STATUS_INPUT,
                         "%s: no element face with a list vertex_indices; only meshes of faces can be read",
                         text->path);
    return STATUS_OK;
}

enum status ply_header_read(struct text *text, struct ply_header *header, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    enum status status = STATUS_OK;
    bool format_known = false, ended = false;
    text_word(text, &word);
    if (!word_is(word, "ply"))
        return text_fail(text, err, "no PLY file: the first line must be 'ply'");
    while (!ended && !status) {
        text_next_line(text);
        if (text_ended(text))
            return text_fail(text, err, "the header does not end; there must be a line 'end_header'");
        if (!text_word(text, &word) || word_is(word, "comment") || word_is(word, "obj_info"))
            continue;
        if (word_is(word, "format")) {
            status = read_format(text, header, err);
            format_known = true;
        } else if (word_is(word, "element")) {
            status = read_element(text, header, err);
        } else if (word_is(word, "property")) {
            status = read_property(text, header, err);
        } else if (word_is(word, "end_header")) {
            ended = true;
        } else {
            status = text_fail(text, err,
                               "'%s' in the header; must be format, element, property, comment, "
                               "obj_info or end_header",
                               word_show(word, shown));
        }
    }
    if (!status && !format_known)
        status = text_fail(text, err, "the header has no line 'format'");
    text_next_line(text);
    return status ? status : check_elements(text, header, err);
}
