#include "sim/price_file.h"
#include "common/command.h"
#include "common/file.h"
#include "common/plot.h"
#include "sim/interrupt.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>

enum status price_file_open(struct price_file *file, const char *path, struct error *err)
{
    struct file_out *out = NULL;
    file->table = strdup(path);
    if (!file->table)
        return error_no_memory(err, "the table");
    memcpy(file->table + strlen(path) - 3, "tsv", 3);
    enum status status = plot_is_file_name(path) ? plot_check(path, err) : STATUS_OK;
    if (!status)
        status = file_out_open(file->table, &out, err);
    file_out_abandon(out);
    return status;
}

enum status price_file_save(const struct price_file *file, void (*print)(const void *table, FILE *stream),
                            const void *table, struct error *err)
{
    struct file_out *out;
    print(table, stdout);
    if (file_out_open(file->table, &out, err))
        return err->status;
    print(table, file_out_stream(out));
    return file_out_commit(out, err);
}

void price_file_close(struct price_file *file)
{
    free(file->table);
    *file = (struct price_file){0};
}

bool price_go_on(void *context, double done)
{
    (void)context;
    progress_update(100 * done);
    return !interrupt_caught();
}

void price_watch(void)
{
    interrupt_watch();
    progress_begin("pricing", "%", 100);
}

enum status price_watched(enum status status, struct error *err)
{
    progress_end();
    if (status == STATUS_INTERRUPTED && interrupt_caught() == SIGTERM)
        err->status = status = STATUS_TERMINATED;
    return status;
}
