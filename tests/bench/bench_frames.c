/* What frames cost: a sphere whose skin thins, drawn in each style and order, what sorting is of it, and 400
 * stereo frames of 3000 triangles written. */
#include "render/cells.h"
#include "render/frames.h"
#include "render/render.h"

#include "support/bench.h"
#include "unit/sphere.h"

#include <ftw.h>
#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { FRAMES = 400, SAMPLES = 40 };

struct scene {
    struct mesh mesh;
    float *opacity, *shininess, *stretch;
    struct render_view view;
    struct render *render;
    struct image image;
};

static struct render_skin skin_of(const struct scene *scene)
{
    return (struct render_skin){.mesh = &scene->mesh,
                                .opacity = scene->opacity,
                                .shininess = scene->shininess,
                                .stretch = scene->stretch,
                                .rest_opacity = 0.97f,
                                .rest_shininess = 12,
                                .colour = {0.7f, 0.035f, 0.04f}};
}

/* Frame i of the run: the sphere swells, its skin thins from opaque to 0.4 and begins to shine. */
static void pose(struct scene *scene, int i)
{
    double part = (double)i / (FRAMES - 1);
    for (uint32_t p = 0; p < scene->mesh.point_count; p++)
        for (int k = 0; k < 3; k++)
            scene->mesh.position[p][k] = scene->mesh.normal[p][k] * (0.6 + 0.4 * part);
    for (uint32_t t = 0; t < scene->mesh.triangle_count; t++) {
        scene->opacity[t] = (float)(1 - 0.6 * part);
        scene->shininess[t] = (float)(100 * part);
        scene->stretch[t] = (float)(1 + 4 * part);
    }
}

static void draw(struct scene *scene, int i)
{
    struct error err;
    pose(scene, i);
    const struct render_skin skin = skin_of(scene);
    bench_check(render_draw(scene->render, &scene->view, &skin, 1, &scene->image, &err), &err);
}

static void open_scene(struct scene *scene, int rings, int sectors)
{
    struct error err;
    const double lower[3] = {-1, -1, -1}, upper[3] = {1, 1, 1}, from[3] = {0.3, 0.25, 1};
    *scene = (struct scene){.mesh = sphere_new(rings, sectors)};
    scene->opacity = calloc(scene->mesh.triangle_count, sizeof *scene->opacity);
    scene->shininess = calloc(scene->mesh.triangle_count, sizeof *scene->shininess);
    scene->stretch = calloc(scene->mesh.triangle_count, sizeof *scene->stretch);
    scene->view = (struct render_view){.width = 1280,
                                       .height = 480,
                                       .stereo = RENDER_PARALLEL,
                                       .order = RENDER_SORT,
                                       .floor = true,
                                       .floor_height = -1};
    bench_check(render_fit_camera(&scene->view, lower, upper, from, 0.1, &err), &err);
    bench_check(render_open(1280, 480, &scene->render, &err), &err);
}

static void close_scene(struct scene *scene)
{
    render_close(scene->render);
    image_clear(&scene->image);
    free(scene->opacity);
    free(scene->shininess);
    free(scene->stretch);
    sphere_free(&scene->mesh);
}

/* By the clock, by this thread's own time, and by all threads'. Where nothing else runs, two cores draw a
 * frame in about the second and half of what the third is more. */
struct cost {
    double clock, thread, process; /* ms a frame */
};

static struct cost draw_ms(struct scene *scene)
{
    const double clock = bench_seconds(), thread = bench_thread_seconds(), process = bench_process_seconds();
    for (int i = 0; i < SAMPLES; i++)
        draw(scene, i * FRAMES / SAMPLES);
    const double each = 1e3 / SAMPLES;
    return (struct cost){(bench_seconds() - clock) * each, (bench_thread_seconds() - thread) * each,
                         (bench_process_seconds() - process) * each};
}

static double encode_ms(struct scene *scene)
{
    struct error err;
    double spent = 0;
    for (int i = 0; i < SAMPLES; i++) {
        draw(scene, i * FRAMES / SAMPLES);
        double start = bench_seconds();
        bench_check(image_save_png(&scene->image, "one.png", NULL, 0, &err), &err);
        spent += bench_seconds() - start;
    }
    return spent / SAMPLES * 1e3;
}

/* Drawing alone, encoding alone, and both: what is more than the larger of the two is what they keep each
 * other from. Two cores have no less to do than half of all threads' time. */
static void measure(struct scene *scene, const char *name, int asked, struct frames_options options)
{
    struct error err;
    struct frames *frames;
    const double drawing = draw_ms(scene).clock, encoding = encode_ms(scene);
    const double start = bench_seconds(), busy = bench_process_seconds();
    bench_check(frames_open(&options, &frames, &err), &err);
    for (int i = 0; i < FRAMES; i++) {
        draw(scene, i);
        bench_check(frames_add(frames, &scene->image, i / 30.0, &err), &err);
    }
    bench_check(frames_close(frames, &err), &err);
    const double all = bench_seconds() - start, each = 1e3 / FRAMES;
    printf("%s\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\t", name, drawing, encoding, all * each,
           all * each / fmax(drawing, encoding), (bench_process_seconds() - busy) * each / 2, all);
    printf(asked ? "%d\n" : "-\n", asked);
    fflush(stdout);
}

static const char *const outlines[] = {
    [RENDER_ROUGH] = "rough", [RENDER_FILTERED] = "filtered", [RENDER_SAMPLED] = "sampled"};

/* Every style and order, as live (with each kind of outlines) and as final frames (2 x 2 samples). */
static void draw_all_ways(void)
{
    static const char *const styles[] = {"paper", "latex"}, *const orders[] = {"none", "sort", "peel",
                                                                               "list"};
    static const int sizes[][2] = {{39, 40}, {100, 101}};
    printf("style\torder\tsamples\toutlines\ttriangles\tclock ms\tthread ms\tprocessor ms\n");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct scene scene;
        open_scene(&scene, sizes[i][0], sizes[i][1]);
        for (int way = 0; way < 2 * 4 * 4; way++) {
            const bool final = way / 8 == 3;
            scene.view.style = way & 1 ? RENDER_LATEX : RENDER_PAPER;
            scene.view.order = (enum render_order)(way >> 1 & 3);
            scene.view.samples = final ? 2 : 1;
            scene.view.outlines = final ? RENDER_ROUGH : (enum render_outlines)(way / 8);
            if (scene.view.outlines == RENDER_SAMPLED && scene.view.order > RENDER_SORT)
                continue;
            draw(&scene, 0);
            const struct cost cost = draw_ms(&scene);
            printf("%s\t%s\t%d\t%s\t%u\t%.2f\t%.2f\t%.2f\n", styles[way & 1], orders[way >> 1 & 3],
                   scene.view.samples, outlines[scene.view.outlines], scene.mesh.triangle_count, cost.clock,
                   cost.thread, cost.process);
            fflush(stdout);
        }
        close_scene(&scene);
    }
}

/* Of one frame, in this thread: the order itself, and the cells that bring neighbours together again in each
 * eye's picture; and what the order changes in drawing, of all threads' time. */
static void share_of_sorting(struct scene *scene, const char *style)
{
    struct error err;
    struct geometry geometry = {0};
    struct cells cells[2] = {0};
    struct camera_eye eyes[2];
    struct render_skin skin = skin_of(scene);
    double sorting = 0, celling = 0;
    scene->view.order = RENDER_NONE;
    const double plain = draw_ms(scene).process;
    scene->view.order = RENDER_SORT;
    const double sorted = draw_ms(scene).process;
    const int count = camera_eyes(&scene->view, eyes);
    for (int i = 0; i < SAMPLES; i++) {
        pose(scene, i * FRAMES / SAMPLES);
        scene->view.order = RENDER_NONE; /* sorted below */
        bench_check(geometry_build(&geometry, &scene->view, &skin, 1, NULL, 0, &err), &err);
        scene->view.order = RENDER_SORT;
        const double begun = bench_thread_seconds();
        order_sort(geometry.translucent.items, geometry.spare.items, geometry.translucent.count);
        const double ordered = bench_thread_seconds();
        for (int eye = 0; eye < count && cells_are_worth_it(&geometry, &scene->view); eye++)
            bench_check(cells_build(&cells[eye], &geometry, &eyes[eye], &err), &err);
        sorting += ordered - begun;
        celling += bench_thread_seconds() - ordered;
    }
    const double each = 1e3 / SAMPLES;
    printf("%s\t%u\t%d\t%.2f\t%.2f\t%.2f\t%.2f\t%.1f %%\t%.1f %%\n", style, scene->mesh.triangle_count,
           scene->view.outlines == RENDER_SAMPLED, plain, sorted, sorting * each, celling * each,
           100 * sorting * each / sorted, 100 * (sorted - plain) / sorted);
    fflush(stdout);
    geometry_clear(&geometry);
    for (int eye = 0; eye < 2; eye++)
        cells_clear(&cells[eye]);
}

static void sort_all_sizes(void)
{
    static const int sizes[][2] = {{39, 40}, {100, 101}, {224, 225}};
    printf("style\ttriangles\tsmooth\tas they come\tsorted ms\torder ms\tcells ms\torder\tall it costs\n");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct scene scene;
        open_scene(&scene, sizes[i][0], sizes[i][1]);
        for (int way = 0; way < 4; way++) {
            scene.view.style = way & 1 ? RENDER_LATEX : RENDER_PAPER;
            scene.view.outlines = way & 2 ? RENDER_SAMPLED : RENDER_ROUGH;
            share_of_sorting(&scene, way & 1 ? "latex" : "paper");
        }
        close_scene(&scene);
    }
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info, (void)kind, (void)walk;
    return remove(path);
}

int main(void)
{
    char folder[] = "bench-frames-XXXXXX";
    if (!mkdtemp(folder) || chdir(folder))
        return 1;
    struct scene scene;
    draw_all_ways();
    sort_all_sizes();
    open_scene(&scene, 39, 40);
    printf("400 stereo frames of 1280 x 480, %u triangles\n", scene.mesh.triangle_count);
    printf("written\tdraw ms\tencode ms\tframe ms\tratio\tprocessor ms/2\tall s\tasked s\n");
    measure(&scene, "PNG, paper", 0, (struct frames_options){.folder = "f"});
    scene.view.style = RENDER_LATEX;
    scene.view.outlines = RENDER_SAMPLED;
    measure(&scene, "PNG, sorted, smooth", 12, (struct frames_options){.folder = "f"});
    measure(&scene, "and a sheet", 0, (struct frames_options){.folder = "f", .sheet = "sheet.png"});
    if (!system("command -v ffmpeg >/dev/null"))
        measure(&scene, "and mp4", 0,
                (struct frames_options){.folder = "f", .sheet = "sheet.png", .movie = "m.mp4"});
    scene.view.order = RENDER_LIST;
    scene.view.samples = 2;
    measure(&scene, "PNG, final: 2 x 2, lists", 60, (struct frames_options){.folder = "f"});
    close_scene(&scene);
    if (chdir(".."))
        return 1;
    return nftw(folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS) != 0;
}
