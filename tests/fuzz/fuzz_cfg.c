/* What holds for any bytes that are taken for a scene. */
#include "common/scene.h"
#include "fuzz.h"
#include "limits.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* libconfig forgets the string that it was reading when a file ends within it. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libconfig\n";
}

const char *__lsan_default_options(void);
const char *__lsan_default_options(void)
{
    return "print_suppressions=0";
}

static void write_file(char *path, size_t room, int *file, const uint8_t *data, size_t size)
{
    *file = memfd_create("fuzz", 0);
    must(*file >= 0 && write(*file, data, size) == (ssize_t)size);
    snprintf(path, room, "/proc/self/fd/%d", *file);
}

static void must_be_a_line(const char *text, void *context)
{
    (void)context;
    must(strlen(text) > 0 && !strchr(text, '\n'));
}

/* A scene that was read can be checked and told again, and told again is the same. One that includes others
 * is more than its bytes, and left out. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error err = {0};
    struct scene scene = {0};
    char path[40], *text = NULL;
    size_t length = 0;
    int file;
    if (size > 0 && memmem(data, size, "@include", 8))
        return 0;
    write_file(path, sizeof path, &file, data, size);
    limits_begin();
    enum status status = scene_load(path, &scene, &err);
    limits_end(size);
    close(file);
    must_say(status, &err);
    if (status) {
        must(scene.balloons == NULL && scene.path == NULL);
        return 0;
    }
    status = scene_check(&scene, &err);
    must_say(status, &err);
    if (!status)
        scene_tell_idle(&scene, must_be_a_line, NULL);
    FILE *stream = open_memstream(&text, &length);
    must(stream != NULL);
    scene_write_keys(&scene, stream);
    must(!fclose(stream) && strlen(text) == length);
    must(!scene_keys_differ(text, text, (char[256]){0}, 256));
    free(text);
    scene_clear(&scene);
    return 0;
}
