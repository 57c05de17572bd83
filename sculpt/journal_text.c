#include "sculpt/journal_text.h"

#include "common/crc.h"
#include "common/hash.h"
#include "common/octree.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char magic[] = "# balloon-sculpt journal ";

#define CUBE_FORMAT "# balloon-sculpt journal 1, cube of depth %u, material %u"
#define FILE_FORMAT "# balloon-sculpt journal 1, file of hash %016" PRIx64

char *journal_path(const char *path, const char *suffix)
{
    size_t length = strlen(path), more = strlen(suffix) + 1;
    char *joined = malloc(length + more);
    if (joined) {
        memcpy(joined, path, length);
        memcpy(joined + length, suffix, more);
    }
    return joined;
}

uint64_t journal_hash(const struct bytes *file)
{
    return hash_bytes(HASH_START, file->data, file->size);
}

void journal_first_line(const struct journal_start *start, char line[JOURNAL_FIRST_SIZE])
{
    if (start->is_cube)
        snprintf(line, JOURNAL_FIRST_SIZE, CUBE_FORMAT, start->depth, start->material);
    else
        snprintf(line, JOURNAL_FIRST_SIZE, FILE_FORMAT, start->hash);
}

uint32_t journal_sum(uint32_t before, const char *line, size_t length)
{
    return crc32_bytes(before, line, length);
}

/* Whether a whole and undamaged line begins at `at`; *sum is that of the line before, then its own. */
static bool line_is_whole(const struct bytes *file, size_t at, size_t *next, uint32_t *sum)
{
    const char *line = (const char *)file->data + at;
    const char *end = memchr(line, '\n', file->size - at);
    if (!end || end + 1 - line < JOURNAL_SUM_SIZE)
        return false;
    size_t length = (size_t)(end + 1 - line) - JOURNAL_SUM_SIZE;
    char wanted[JOURNAL_SUM_SIZE + 1];
    uint32_t own = journal_sum(*sum, line, length);
    snprintf(wanted, sizeof wanted, " #%08" PRIx32 "\n", own);
    if (memcmp(line + length, wanted, JOURNAL_SUM_SIZE) != 0)
        return false;
    *sum = own;
    *next = at + length + JOURNAL_SUM_SIZE;
    return true;
}

size_t journal_next_line(const struct bytes *file, size_t *at, const char **line)
{
    *line = (const char *)file->data + *at;
    const char *end = memchr(*line, '\n', file->size - *at);
    *at += (size_t)(end + 1 - *line);
    return (size_t)(end + 1 - *line) - JOURNAL_SUM_SIZE;
}

static bool parse_first_line(const char *line, size_t length, struct journal_start *start)
{
    char text[JOURNAL_FIRST_SIZE], again[JOURNAL_FIRST_SIZE];
    if (length >= sizeof text)
        return false;
    memcpy(text, line, length);
    text[length] = '\0';
    *start = (struct journal_start){0};
    if (sscanf(text, CUBE_FORMAT, &start->depth, &start->material) == 2)
        start->is_cube = true;
    else if (sscanf(text, "# balloon-sculpt journal 1, file of hash %16" SCNx64, &start->hash) != 1)
        return false;
    journal_first_line(start, again);
    return !strcmp(text, again) && start->depth <= OCTREE_DEPTH_MAX && start->material < OCTREE_MATERIALS;
}

enum status journal_text_read(const struct bytes *file, struct journal_text *text, struct error *err)
{
    *text = (struct journal_text){0};
    size_t known = file->size < sizeof magic - 1 ? file->size : sizeof magic - 1;
    const char *line = (const char *)file->data;
    if (memcmp(line, magic, known) != 0)
        return error_set(err, STATUS_INPUT,
                         "not a journal: it does not begin with \"%s\"; move it out of the way", magic);
    if (!memchr(line, '\n', file->size))
        return STATUS_OK;
    if (!line_is_whole(file, 0, &text->end, &text->sum))
        return error_set(err, STATUS_INPUT,
                         "line 1: the checksum does not match; what the journal began from is lost");
    text->first_end = text->end;
    if (!parse_first_line(line, text->end - JOURNAL_SUM_SIZE, &text->start))
        return error_set(err, STATUS_INPUT, "line 1: a journal of another version; this program reads 1");
    text->begun = true;
    for (size_t at = text->end; line_is_whole(file, at, &text->end, &text->sum); at = text->end)
        text->operations += file->data[at] != '#';
    return STATUS_OK;
}
