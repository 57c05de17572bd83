#include "fuzz.h"
#include "limits.h"
#include "sculpt/journal.h"
#include "sculpt/journal_text.h"

#include <inttypes.h>
#include <string.h>
#include <unistd.h>

/* Puts the right checksum behind every line that has the room, for else hardly any
 * damage gets past the first. */
static void mend_checksums(char *text, size_t size)
{
    uint32_t sum = 0;
    for (char *line = text, *end; (end = memchr(line, '\n', size - (size_t)(line - text))); line = end + 1) {
        char tail[JOURNAL_SUM_SIZE + 1];
        if (end + 1 - line < JOURNAL_SUM_SIZE)
            continue;
        size_t length = (size_t)(end + 1 - line) - JOURNAL_SUM_SIZE;
        sum = journal_sum(sum, line, length);
        snprintf(tail, sizeof tail, " #%08" PRIx32 "\n", sum);
        memcpy(line + length, tail, JOURNAL_SUM_SIZE);
    }
}

enum { DEPTH_MAX = 6 }; /* larger cubes only take longer to carve */

/* False: a large cube. What reading takes is limited, what carving takes is not:
 * somebody has done it before. */
static bool read_text(char *text, size_t size)
{
    struct error err = {0};
    struct journal_text lines = {0};
    limits_begin();
    enum status status = journal_text_read(&(struct bytes){(unsigned char *)text, size}, &lines, &err);
    limits_end(size);
    must_say(status, &err);
    return status || !lines.start.is_cube || lines.start.depth <= DEPTH_MAX;
}

/* A journal that was recovered can be gone on with, and then leads to the same. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char folder[] = "/dev/shm/balloon-fuzz-XXXXXX", path[64], name[80];
    struct error err = {0};
    struct octree tree = {0}, again = {0};
    struct journal *journal = NULL;
    struct journal_report report;
    char *text = malloc(size + 1);
    must(text != NULL);
    if (size > 0)
        memcpy(text, data, size);
    mend_checksums(text, size);
    text[size] = '\0';
    if (!read_text(text, size)) {
        free(text);
        return 0;
    }
    must(mkdtemp(folder) != NULL);
    snprintf(path, sizeof path, "%s/a.oct", folder);
    snprintf(name, sizeof name, "%s" JOURNAL_SUFFIX, path);
    FILE *stream = fopen(name, "wb");
    must(stream && fwrite(text, 1, size, stream) == size && !fclose(stream));
    free(text);
    enum status status = journal_recover(path, &tree, NULL, &report, &err);
    must_say(status, &err);
    if (status) {
        must(tree.blocks == NULL);
    } else {
        must(journal_open(path, NULL, &journal, &err) == STATUS_OK);
        must(journal_mark(journal, &err) == STATUS_OK);
        journal_close(journal, false);
        must(journal_recover(path, &again, NULL, &report, &err) == STATUS_OK && report.lost_bytes == 0);
        must(octree_equal(&tree, &again));
    }
    octree_clear(&tree);
    octree_clear(&again);
    unlink(name);
    rmdir(folder);
    return 0;
}
