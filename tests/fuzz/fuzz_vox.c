#include "fuzz.h"
#include "limits.h"
#include "sculpt/sculpt.h"

#include <sys/mman.h>
#include <unistd.h>

/* A model that was read has cells; one that is refused leaves nothing behind. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error err = {0};
    struct octree tree = {0};
    char path[40];
    int file = memfd_create("fuzz", 0);
    must(file >= 0 && write(file, data, size) == (ssize_t)size);
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    limits_begin();
    enum status status = vox_load(path, &tree, &err);
    limits_end(size);
    close(file);
    must_say(status, &err);
    must(status ? tree.blocks == NULL : octree_measure(&tree).cells > 0);
    octree_clear(&tree);
    return 0;
}
