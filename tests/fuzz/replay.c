/* Stands in for libFuzzer: replay FOLDER gives the target every file of a corpus, in turn. */
#include "common/file.h"

#include <dirent.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay(const char *path)
{
    struct error err = {0};
    struct bytes bytes = {0};
    if (file_read(path, &bytes, &err)) {
        fprintf(stderr, "%s\n", err.text);
        return 1;
    }
    printf("%s\n", path);
    fflush(stdout);
    LLVMFuzzerTestOneInput(bytes.data, bytes.size);
    bytes_clear(&bytes);
    return 0;
}

int main(int argc, char **argv)
{
    DIR *folder = argc == 2 && !chdir(argv[1]) ? opendir(".") : NULL;
    if (!folder) {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    int count = 0, failed = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (entry->d_name[0] == '.')
            continue;
        failed += replay(entry->d_name);
        count++;
    }
    closedir(folder);
    printf("%d files\n", count);
    return count == 0 || failed > 0;
}
