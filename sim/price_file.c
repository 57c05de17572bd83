#include "sim/price_file.h"
#include "common/command.h"
#include "common/file.h"
#include "common/plot.h"
#include "sim/interrupt.h"

#include <stdlib.h>

enum status price_check(const char *path, struct error *err)
{
    char *table_path = plot_table_name(path);
    if (!table_path)
        return error_no_memory(err, "the table");
    enum status status = plot_is_file_name(path) ? plot_check(path, err) : STATUS_OK;
    if (!status)
        status = file_out_check(path, err);
    if (!status)
        status = file_out_check(table_path, err);
    free(table_path);
    return status;
}

static enum status save(const struct price_kind *kind, const void *table, const char *path, struct error *err)
{
    struct file_out *out;
    kind->print(table, stdout);
    if (file_out_open(path, &out, err))
        return err->status;
    kind->print(table, file_out_stream(out));
    return file_out_commit(out, err);
}

bool price_go_on(void *context, double done)
{
    const struct price_part *part = context;
    progress_update(100 * (part ? part->from + (part->to - part->from) * done : done));
    return !interrupt_caught();
}

bool price_goes_on(const struct sim *sim)
{
    (void)sim;
    return !interrupt_caught();
}

/* With a progress bar. */
static enum status measure(const struct price_kind *kind, const struct scene *scene,
                           const struct mesh *meshes, void *table, struct error *err)
{
    char size[96];
    size_t triangles = 0;
    for (size_t i = 0; i < scene->balloon_count; i++)
        triangles += meshes[i].triangle_count;
    snprintf(size, sizeof size, "many runs of %zu triangles, to %g s", triangles, scene->time.end);
    interrupt_watch();
    progress_begin("pricing", size, "%", 100);
    enum status status = kind->measure(scene, meshes, table, err);
    progress_end();
    if (status == STATUS_INTERRUPTED)
        err->status = status = interrupt_caught();
    return status;
}

enum status price_make(const struct price_kind *kind, const struct scene *scene, const struct mesh *meshes,
                       const char *path, struct error *err)
{
    void *table = calloc(1, kind->size);
    char *table_path = plot_table_name(path);
    enum status status = table && table_path ? price_check(path, err) : error_no_memory(err, "the table");
    if (!status)
        status = measure(kind, scene, meshes, table, err);
    if (!status)
        status = save(kind, table, table_path, err);
    if (!status && plot_is_file_name(path))
        status = kind->draw(table, scene->path, path, err);
    free(table_path);
    free(table);
    return status;
}
