#include "fuzz.h"
#include "limits.h"
#include "sculpt/chip_log.h"

#include <string.h>

/* Larger cubes and longer scripts only take longer. */
enum { DEPTH = 4, CHIPS_MAX = 200 };

/* A script that was read can be carved, and its log makes the same. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error err = {0};
    struct chips chips = {0};
    struct octree tree = {0};
    struct bytes log = {0};
    bool holds;
    char *text = malloc(size + 1);
    must(text != NULL);
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    limits_begin();
    enum status status = chips_parse("fuzz", text, size, &chips, &err);
    limits_end(size);
    free(text);
    must_say(status, &err);
    if (status) {
        must(chips.items == NULL);
        return 0;
    }
    chips.depth = DEPTH;
    chips.depth_line = 1;
    if (chips.count <= CHIPS_MAX) {
        must(chips_begin(&chips, DEPTH, &tree, &err) == STATUS_OK);
        must(chips_run(&tree, &chips, &err) == STATUS_OK);
        must(chip_log_write(NULL, &chips, DEPTH, &log, &err) == STATUS_OK);
        must(chip_log_holds(&log, &tree, &holds, &err) == STATUS_OK && holds);
    }
    bytes_clear(&log);
    octree_clear(&tree);
    chips_clear(&chips);
    return 0;
}
