/* What is asked of every reader and writer of files whose calls fail. */
#ifndef TESTS_FAULT_FAULTY_H
#define TESTS_FAULT_FAULTY_H

#include "../unit/folder.h"
#include "common/file.h"
#include "support/fault.h"

static const unsigned fault_kinds[] = {FAULT_MEMORY, FAULT_FILES};

/* A call in which something failed says so as it should, or did without it. */
static inline void assert_says(enum status status, const struct error *err, unsigned kinds)
{
    if (!status)
        return;
    if (status != (kinds == FAULT_MEMORY ? STATUS_NO_MEMORY : STATUS_FILE) || err->status != status ||
        !err->text[0])
        fail_msg("status %d (%d in the message): %s", (int)status, (int)err->status, err->text);
}

static inline int files_here(void)
{
    int count = 0;
    DIR *entries = opendir(".");
    for (struct dirent *entry; (entry = readdir(entries));)
        count += entry->d_name[0] != '.';
    closedir(entries);
    return count;
}

static inline void assert_holds(const char *path, const struct bytes *wanted)
{
    struct bytes bytes = {0};
    struct error err = {0};
    assert_ok(file_read(path, &bytes, &err), &err);
    assert_int_equal(bytes.size, wanted->size);
    assert_memory_equal(bytes.data, wanted->data, wanted->size);
    bytes_clear(&bytes);
}

typedef enum status faulty_save(const void *thing, const char *path, struct error *err);

/* Each call of a writer fails in turn, over an old file and without one: there is the new file, whole, or a
 * message that names it and what was there before, and nothing beside it. */
static inline void check_save(faulty_save *save, const void *thing, const char *path)
{
    struct error err = {0};
    struct bytes good = {0}, old = {(unsigned char *)"old", 3};
    assert_ok(save(thing, path, &err), &err);
    assert_ok(file_read(path, &good, &err), &err);
    for (int i = 0; i < 4; i++) {
        const bool exists = i & 1;
        for (struct fault fault = {.kinds = fault_kinds[i / 2]}; fault_next(&fault);) {
            unlink(path);
            const int others = files_here();
            if (exists)
                write_bytes(path, old.data, old.size);
            fault_begin(&fault);
            enum status status = save(thing, path, &err);
            fault_end(&fault);
            assert_true(fault.failed || !status);
            assert_says(status, &err, fault.kinds);
            assert_int_equal(files_here(), others + (exists || !status));
            if (fault.kinds == FAULT_FILES && status)
                assert_non_null(strstr(err.text, path));
            if (exists || !status)
                assert_holds(path, status ? &old : &good);
        }
    }
    bytes_clear(&good);
    unlink(path);
}

#endif
