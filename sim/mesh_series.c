#include "sim/mesh_series.h"
#include "common/array.h"
#include "common/file.h"
#include "sim/skin_mesh.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct mesh_series {
    struct skin_mesh skin;
    char *folder;
    const char *extension; /* "ply" or "vtp" */
    uint64_t next;         /* number of the next mesh */
    bool begun;
    size_t removed;
    struct listed {
        uint64_t number;
        double time; /* s */
    } * items;       /* [count] meshes that are there */
    size_t count, capacity;
};

/* "FOLDER/NAME"; free() it. NULL: not enough memory. */
static char *path_of(const struct mesh_series *series, const char *name)
{
    char *path = NULL;
    return asprintf(&path, "%s/%s", series->folder, name) < 0 ? NULL : path;
}

static char *list_path(const struct mesh_series *series)
{
    char name[32];
    snprintf(name, sizeof name, "mesh.%s.series", series->extension);
    return path_of(series, name);
}

static bool add_to_list(struct mesh_series *series, uint64_t number, double time)
{
    if (!ARRAY_RESERVE(series, 1))
        return false;
    series->items[series->count++] = (struct listed){number, time};
    return true;
}

/* Of a run that is gone on with: the meshes before the first, by the list that it has left. Without
 * one they are not listed. */
static enum status read_list(struct mesh_series *series, struct error *err)
{
    struct bytes bytes = {0};
    char *path = list_path(series), wanted[64];
    enum status status = path ? STATUS_OK : error_no_memory(err, series->folder);
    if (!status && file_read(path, &bytes, NULL) == STATUS_OK) {
        const char *at = (const char *)bytes.data;
        for (uint64_t i = 0; i < series->next && at && !status; i++) {
            snprintf(wanted, sizeof wanted, "\"mesh_%04" PRIu64 ".%s\", \"time\": ", i, series->extension);
            at = strstr(at, wanted);
            if (at && !add_to_list(series, i, strtod(at + strlen(wanted), NULL)))
                status = error_no_memory(err, series->folder);
        }
    }
    bytes_clear(&bytes);
    free(path);
    return status;
}

enum status mesh_series_open(struct sim *sim, const struct mesh_series_options *options,
                             struct mesh_series **result, struct error *err)
{
    struct mesh_series *series = calloc(1, sizeof *series);
    if (!series)
        return error_no_memory(err, options->folder);
    series->extension = options->vtp ? "vtp" : "ply";
    series->next = options->first;
    series->folder = strdup(options->folder);
    enum status status = series->folder ? file_make_folder(series->folder, err)
                                        : error_no_memory(err, options->folder);
    if (!status && access(series->folder, W_OK))
        status = error_set_errno(err, series->folder, "write into");
    if (!status && options->first > 0)
        status = read_list(series, err);
    if (!status)
        status = skin_mesh_init(&series->skin, sim, options->apart, err);
    if (status)
        mesh_series_close(series, &(size_t){0}, NULL);
    else
        *result = series;
    return status;
}

/* Whether a name is that of a mesh, exactly as it would be written here; its number. */
static bool is_mesh(const char *name, const char *extension, uint64_t *number)
{
    char again[64], *end;
    if (strncmp(name, "mesh_", 5) != 0 || name[5] < '0' || name[5] > '9')
        return false;
    *number = strtoull(name + 5, &end, 10);
    snprintf(again, sizeof again, "mesh_%04" PRIu64 ".%s", *number, extension);
    return !strcmp(name, again);
}

bool mesh_series_is_ply_name(const char *name)
{
    return is_mesh(name, "ply", &(uint64_t){0}) || !strcmp(name, "mesh.ply.series");
}

bool mesh_series_is_vtp_name(const char *name)
{
    return is_mesh(name, "vtp", &(uint64_t){0}) || !strcmp(name, "mesh.vtp.series");
}

/* Whether a mesh of that name is one of the series' from its next number on. */
static bool is_ours(const struct mesh_series *series, const char *name)
{
    uint64_t number;
    return is_mesh(name, series->extension, &number) && number >= series->next;
}

/* Of the series, in its open folder; a folder by that name stays. */
static enum status remove_one(struct mesh_series *series, DIR *folder, const char *name, struct error *err)
{
    if (unlinkat(dirfd(folder), name, 0) == 0) {
        series->removed++;
        return STATUS_OK;
    }
    if (errno == EISDIR || errno == ENOENT)
        return STATUS_OK;
    const int reason = errno;
    char *path = path_of(series, name);
    errno = reason;
    enum status status = path ? error_set_errno(err, path, "remove the earlier run's")
                              : error_no_memory(err, name);
    free(path);
    return status;
}

/* ParaView's own: file-series-version 1.0, names beside the list. */
static enum status write_list(const struct mesh_series *series, struct error *err)
{
    struct file_out *out = NULL;
    char *path = list_path(series);
    enum status status = path ? file_out_open(path, &out, err) : error_no_memory(err, series->folder);
    if (!status) {
        FILE *stream = file_out_stream(out);
        fputs("{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n", stream);
        for (size_t i = 0; i < series->count; i++)
            fprintf(stream, "    {\"name\": \"mesh_%04" PRIu64 ".%s\", \"time\": %.17g}%s\n",
                    series->items[i].number, series->extension, series->items[i].time,
                    i + 1 < series->count ? "," : "");
        fputs("  ]\n}\n", stream);
        status = file_out_commit(out, err);
    }
    free(path);
    return status;
}

/* The earlier run's list goes too, but for what this one goes on with. */
static enum status remove_earlier(struct mesh_series *series, struct error *err)
{
    enum status status = STATUS_OK;
    DIR *folder = opendir(series->folder);
    if (!folder)
        return error_set_errno(err, series->folder, "read");
    for (struct dirent *entry; !status && (entry = readdir(folder));)
        if (is_ours(series, entry->d_name))
            status = remove_one(series, folder, entry->d_name, err);
    closedir(folder);
    if (status || series->count > 0)
        return status ? status : write_list(series, err);
    char *list = list_path(series);
    if (!list)
        return error_no_memory(err, series->folder);
    unlink(list);
    free(list);
    return STATUS_OK;
}

enum status mesh_series_add(struct mesh_series *series, struct error *err)
{
    char name[64];
    snprintf(name, sizeof name, "mesh_%04" PRIu64 ".%s", series->next, series->extension);
    enum status status = series->begun ? STATUS_OK : remove_earlier(series, err);
    series->begun |= status == STATUS_OK;
    char *path = path_of(series, name);
    if (!path && !status)
        status = error_no_memory(err, name);
    if (!status) {
        skin_mesh_take(&series->skin);
        status = mesh_save_values(&series->skin.mesh, series->skin.values, SKIN_VALUES, path, err);
    }
    if (!status && !add_to_list(series, series->next++, series->skin.sim->time))
        status = error_no_memory(err, path);
    free(path);
    return status;
}

enum status mesh_series_list(const struct mesh_series *series, struct error *err)
{
    return series && series->begun ? write_list(series, err) : STATUS_OK;
}

enum status mesh_series_close(struct mesh_series *series, size_t *removed, struct error *err)
{
    *removed = 0;
    if (!series)
        return STATUS_OK;
    enum status status = mesh_series_list(series, err);
    *removed = series->removed;
    skin_mesh_clear(&series->skin);
    free(series->folder);
    free(series->items);
    free(series);
    return status;
}
