/*
 * STL (3D Systems, 1989): a soup of triangles, as text or in records of 50 bytes. Many binary files begin
 * with "solid" like the text ones; what tells them apart is their size, 84 + 50 x the count at byte 80, or,
 * where they are cut short, that they have bytes of 0.
 */
#include "common/array.h"
#include "common/little_endian.h"
#include "common/mesh_files.h"
#include "common/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEAD_SIZE = 84, COUNT_AT = 80, FACET_SIZE = 50, CORNERS_AT = 12 };

static bool is_binary(const struct bytes *bytes)
{
    return bytes->size >= HEAD_SIZE &&
           bytes->size == HEAD_SIZE + (uint64_t)FACET_SIZE * get_bits(bytes->data + COUNT_AT, 4);
}

static enum status read_binary(const struct bytes *bytes, const char *path, struct place_list *soup,
                               struct error *err)
{
    size_t triangle_count = (bytes->size - HEAD_SIZE) / FACET_SIZE;
    if (!ARRAY_RESERVE(soup, 3 * triangle_count))
        return error_no_memory(err, path);
    for (size_t t = 0; t < triangle_count; t++) {
        const unsigned char *at = bytes->data + HEAD_SIZE + FACET_SIZE * t + CORNERS_AT;
        for (size_t i = 0; i < 9; i++, at += 4) {
            const uint32_t bits = (uint32_t)get_bits(at, 4);
            float value;
            memcpy(&value, &bits, sizeof value);
            if (!isfinite(value))
                return error_set(err, STATUS_INPUT,
                                 "%s: triangle %zu: %c of corner %zu is %g; must be finite", path, t,
                                 "xyz"[i % 3], i / 3, (double)value);
            soup->items[3 * t + i / 3][i % 3] = (double)value;
        }
    }
    soup->count = 3 * triangle_count;
    return STATUS_OK;
}

/* Some programs write the words in capitals. */
static bool is_keyword(struct word word, const char *name)
{
    return word.length == strlen(name) && !strncasecmp(word.start, name, word.length);
}

static enum status want_word(struct text *text, const char *wanted, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (!text_any_word(text, &word))
        return text_fail(text, err, "the file ends here; '%s' must follow", wanted);
    if (!is_keyword(word, wanted))
        return text_fail(text, err, "'%s'; must be '%s'", word_show(word, shown), wanted);
    return STATUS_OK;
}

static enum status want_numbers(struct text *text, double number[3], struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    for (int i = 0; i < 3; i++) {
        if (!text_any_word(text, &word))
            return text_fail(text, err, "the file ends here; a number must follow");
        if (!word_number(word, &number[i]))
            return text_fail(text, err, "'%s'; must be a number", word_show(word, shown));
    }
    return STATUS_OK;
}

static enum status want_corner(struct text *text, struct place_list *soup, struct error *err)
{
    enum status status = want_word(text, "vertex", err);
    if (!status && !ARRAY_RESERVE(soup, 1))
        status = error_no_memory(err, text->path);
    if (!status)
        status = want_numbers(text, soup->items[soup->count], err);
    for (int i = 0; i < 3 && !status; i++) {
        const double at = soup->items[soup->count][i];
        if (!isfinite(at))
            status = text_fail(text, err, "%c is %g; must be finite", "xyz"[i], at);
    }
    soup->count += !status;
    return status;
}

/* What follows the word "facet". The normal is not used: the winding says the same. */
static enum status want_facet(struct text *text, struct place_list *soup, struct error *err)
{
    double normal[3];
    enum status status = want_word(text, "normal", err);
    if (!status)
        status = want_numbers(text, normal, err);
    if (!status)
        status = want_word(text, "outer", err);
    if (!status)
        status = want_word(text, "loop", err);
    for (int k = 0; k < 3 && !status; k++)
        status = want_corner(text, soup, err);
    if (!status)
        status = want_word(text, "endloop", err);
    return status ? status : want_word(text, "endfacet", err);
}

/* One "solid NAME ... endsolid NAME" or several. */
static enum status read_text(struct text *text, struct place_list *soup, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    enum status status = STATUS_OK;
    bool inside = false;
    while (!status && text_any_word(text, &word)) {
        if (inside && is_keyword(word, "facet")) {
            status = want_facet(text, soup, err);
        } else if (is_keyword(word, inside ? "endsolid" : "solid")) {
            inside = !inside;
            text_next_line(text);
        } else {
            status = text_fail(text, err, "'%s'; must be %s", word_show(word, shown),
                               inside ? "'facet' or 'endsolid'" : "'solid'");
        }
    }
    if (!status && inside)
        status = text_fail(text, err, "the file ends here; 'endsolid' must follow");
    return status;
}

static enum status read_soup(const struct bytes *bytes, const char *path, struct place_list *soup,
                             struct error *err)
{
    struct text text = text_of(path, bytes->data, bytes->size);
    struct text begin = text;
    struct word word;
    if (is_binary(bytes))
        return read_binary(bytes, path, soup, err);
    bool is_text = bytes->size < HEAD_SIZE || !memchr(bytes->data, 0, bytes->size);
    if (is_text && text_any_word(&begin, &word) && is_keyword(word, "solid"))
        return read_text(&text, soup, err);
    if (bytes->size < HEAD_SIZE)
        return error_set(err, STATUS_INPUT,
                         "%s: no STL file: it neither begins with 'solid' nor has the %d bytes of a header",
                         path, HEAD_SIZE);
    const uint32_t count = (uint32_t)get_bits(bytes->data + COUNT_AT, 4);
    return error_set(err, STATUS_INPUT, "%s: %u triangles in a binary STL take %llu bytes; the file has %zu",
                     path, count, (unsigned long long)HEAD_SIZE + (unsigned long long)FACET_SIZE * count,
                     bytes->size);
}

enum status mesh_read_stl(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err)
{
    struct place_list soup = {0};
    enum status status = read_soup(bytes, path, &soup, err);
    if (!status)
        status = mesh_from_soup((const double(*)[3])soup.items, soup.count / 3, mesh, err);
    free(soup.items);
    return status;
}
