/* OBJ (Wavefront, Advanced Visualizer manual, appendix B1): its points and faces; all else is passed over. */
#include "common/array.h"
#include "common/mesh_files.h"
#include "common/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct obj {
    struct text text;
    struct place_list points;
    struct triangle_list triangles;
    uint32_t largest;    /* a face may name points that come later, so the largest */
    size_t largest_line; /* is checked at the end */
};

static enum status read_point(struct obj *obj, struct error *err)
{
    struct word word;
    char shown[WORD_SHOWN_SIZE];
    if (!ARRAY_RESERVE(&obj->points, 1))
        return error_no_memory(err, obj->text.path);
    double *point = obj->points.items[obj->points.count];
    for (int i = 0; i < 3; i++) {
        if (!text_word(&obj->text, &word))
            return text_fail(&obj->text, err, "a point of %d coordinates; must be x y z", i);
        if (!word_number(word, &point[i]) || !isfinite(point[i]))
            return text_fail(&obj->text, err, "%c is '%s'; must be a finite number", "xyz"[i],
                             word_show(word, shown));
    }
    obj->points.count++;
    return STATUS_OK;
}

/* A corner: "7", "7/2", "7//3" or "7/2/3", of which the 7 counts: from 1, or from the last point back when it
 * is negative. */
static enum status read_corner(struct obj *obj, struct word word, uint32_t *corner, struct error *err)
{
    const char *slash = memchr(word.start, '/', word.length);
    struct word index = {word.start, slash ? (size_t)(slash - word.start) : word.length};
    char shown[WORD_SHOWN_SIZE];
    long long number;
    if (!word_whole(index, &number))
        return text_fail(&obj->text, err,
                         "corner '%s'; must be a point's number, as in 7, 7/2, 7//3 or 7/2/3",
                         word_show(word, shown));
    if (number == 0 || number >= MESH_NONE || number < -(long long)obj->points.count)
        return text_fail(&obj->text, err, "corner %lld; must be 1 or more, or -1 to -%zu counting back",
                         number, obj->points.count);
    *corner = (uint32_t)(number > 0 ? number - 1 : (long long)obj->points.count + number);
    if (*corner > obj->largest || obj->largest_line == 0) {
        obj->largest = *corner;
        obj->largest_line = obj->text.line;
    }
    return STATUS_OK;
}

/* Corners a, b, c, d ... become the triangles abc, acd ... */
static enum status read_face(struct obj *obj, struct error *err)
{
    struct word word;
    uint32_t corner[3]; /* the first, the one before, this one */
    size_t count = 0;
    enum status status = STATUS_OK;
    for (; !status && text_word(&obj->text, &word) && *word.start != '#'; count++) {
        status = read_corner(obj, word, &corner[count < 2 ? count : 2], err);
        if (!status && count >= 2) {
            status = triangle_list_add(&obj->triangles, corner[0], corner[1], corner[2], err);
            corner[1] = corner[2];
        }
    }
    if (!status && count < 3)
        status = text_fail(&obj->text, err, "a face of %zu corners; must be at least 3", count);
    return status;
}

static enum status read_lines(struct obj *obj, struct error *err)
{
    enum status status = STATUS_OK;
    for (; !status && !text_ended(&obj->text); text_next_line(&obj->text)) {
        struct word word;
        if (!text_word(&obj->text, &word))
            continue;
        if (word_is(word, "v"))
            status = read_point(obj, err);
        else if (word_is(word, "f"))
            status = read_face(obj, err);
    }
    if (!status && obj->largest_line > 0 && obj->largest >= obj->points.count) {
        obj->text.line = obj->largest_line;
        status = text_fail(&obj->text, err, "corner %llu; the file has %zu points", obj->largest + 1ull,
                           obj->points.count);
    }
    return status;
}

enum status mesh_read_obj(const struct bytes *bytes, const char *path, struct mesh *mesh, struct error *err)
{
    struct obj obj = {.text = text_of(path, bytes->data, bytes->size)};
    struct mesh made = {0};
    obj.text.backslash_joins = true;
    enum status status = read_lines(&obj, err);
    if (!status)
        status = mesh_check_size(obj.points.count, obj.triangles.count, err);
    if (!status)
        status = mesh_init(&made, 0, 0, false, err);
    if (!status && obj.points.count > 0) {
        double(*fitting)[3] = realloc(obj.points.items, obj.points.count * sizeof *obj.points.items);
        free(made.position);
        made.position = fitting ? fitting : obj.points.items;
        made.point_count = (uint32_t)obj.points.count;
        obj.points.items = NULL;
    }
    if (!status) {
        triangle_list_give(&obj.triangles, &made);
        *mesh = made;
    }
    free(obj.points.items);
    free(obj.triangles.items);
    return status;
}
