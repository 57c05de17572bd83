#include "sim/clash.h"
#include "common/array.h"
#include "common/file.h"
#include "common/plot.h"
#include "render/frame_files.h"
#include "sim/mesh_series.h"
#include "sim/motion_cache.h"

#include <stdlib.h>

enum { WRITTEN_MAX = 16 };

struct names {
    const char **read; /* [read_count] what is read; a NULL is none, here and below */
    size_t read_count;
    const char *written[WRITTEN_MAX];
    size_t written_count;
    char *derived[WRITTEN_MAX]; /* those of them that are made here */
    size_t derived_count;
};

static void add(struct names *names, const char *path)
{
    names->written[names->written_count++] = path;
}

/* A name that goes with another output's; takes it over. False: no memory for it. */
static bool add_derived(struct names *names, char *path)
{
    names->derived[names->derived_count++] = path;
    add(names, path);
    return path;
}

/* Of a movie or a sheet: in stereo "separate" one for each eye. */
static bool add_picture(struct names *names, const struct scene *scene, const char *path)
{
    if (!path || scene->view.stereo != SCENE_SEPARATE) {
        add(names, path);
        return true;
    }
    return add_derived(names, frame_eye_file(path, "left")) &&
           add_derived(names, frame_eye_file(path, "right"));
}

static bool add_run(struct names *names, const struct options *options, const struct scene *scene)
{
    const char *const plain[] = {options->log,    options->plot,  options->mesh,
                                 options->pieces, options->cache, options->checkpoint};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        add(names, plain[i]);
    return add_picture(names, scene, options->movie) && add_picture(names, scene, options->sheet) &&
           (!options->cache || add_derived(names, motion_cache_mesh_name(options->cache)));
}

static bool add_price(struct names *names, const char *price)
{
    add(names, plot_is_file_name(price) ? price : NULL);
    return add_derived(names, plot_table_name(price));
}

static bool add_read(struct names *names, const struct options *options, const struct scene *scene)
{
    const bool goes_on = options->resume && options->checkpoint &&
                         file_same(options->resume, options->checkpoint);
    names->read = array_new(scene->balloon_count + 2, sizeof *names->read);
    if (!names->read)
        return false;
    for (size_t i = 0; i < scene->balloon_count; i++)
        names->read[i] = scene->balloons[i].mesh;
    names->read[scene->balloon_count] = options->scene;
    names->read[scene->balloon_count + 1] = goes_on ? NULL : options->resume;
    names->read_count = scene->balloon_count + 2;
    return true;
}

/* Files that are written into a folder, and those of an earlier run that they take the place of. */
static enum status check_folder(const struct names *names, const char *folder,
                                bool (*is_ours)(const char *name), struct error *err)
{
    for (size_t i = 0; i < names->read_count; i++)
        if (names->read[i] && file_lies_in(names->read[i], folder, is_ours))
            return error_set(err, STATUS_FILE,
                             "%s: is read here, and would be replaced or removed by what goes into %s; give "
                             "another folder",
                             names->read[i], folder);
    for (size_t i = 0; i < names->written_count; i++)
        if (names->written[i] && file_lies_in(names->written[i], folder, is_ours))
            return error_set(err, STATUS_USAGE,
                             "%s: two outputs would go there, and one be lost; give each a file",
                             names->written[i]);
    return STATUS_OK;
}

static enum status check(const struct names *names, const struct options *run, struct error *err)
{
    enum status status = file_check_clash(names->read, names->read_count, names->written,
                                          names->written_count, err);
    if (!status && run && run->frames)
        status = check_folder(names, run->frames, frame_file_is_name, err);
    if (!status && run && run->series)
        status = check_folder(names, run->series,
                              run->series_vtp ? mesh_series_is_vtp_name : mesh_series_is_ply_name, err);
    return status;
}

enum status clash_check(const struct options *options, const struct scene *scene, struct error *err)
{
    const char *price = options->accuracy_cost ? options->accuracy_cost : options->effect_cost;
    const struct options no_run = {.scene = options->scene};
    struct names names = {0};
    const bool named = add_read(&names, price ? &no_run : options, scene) &&
                       (price ? add_price(&names, price) : add_run(&names, options, scene));
    enum status status = named ? check(&names, price ? NULL : options, err)
                               : error_no_memory(err, "the names of files");
    for (size_t i = 0; i < names.derived_count; i++)
        free(names.derived[i]);
    free(names.read);
    return status;
}
