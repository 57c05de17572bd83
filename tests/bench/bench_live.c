/* The live window while a balloon swells and swings in it: how many pictures a second, and where a picture's
 * time goes. It is balloon-sim's own window, on whatever display there is, whose calls are watched on their
 * way (the linker's --wrap). bench_live BALLOON-SURFACE SPHERE.oct SPHERE.ply */
#include "common/command.h"
#include "render/geometry.h"
#include "sim/window_app.h"
#include "support/bench_program.h"

#include <sys/mman.h>

/* s: until the window knows how it draws; then what counts. */
static const double warm_up = 4, measured = 8;

enum stage { STEPS, SKINS, ORDER, SHOW, PRESENT, STAGES };

struct tally {
    double seconds[STAGES];      /* by the clock, in the window's own thread */
    double opened, began, clock; /* s */
    double thread, process;      /* s on processors: of that thread, of all */
    int pictures, filtered;
};

/* Both processes see it: the window runs in a child, since a process can have but one. */
static struct tally *tally;

static void add(enum stage stage, double began)
{
    tally->seconds[stage] += tally->began > 0 ? bench_seconds() - began : 0;
}

/* The linker puts these in front of the calls that they are named after. */
enum status __real_live_run(struct live *live, double seconds, double budget, struct error *err);
enum status __wrap_live_run(struct live *live, double seconds, double budget, struct error *err);
enum status __wrap_live_run(struct live *live, double seconds, double budget, struct error *err)
{
    const double began = bench_seconds();
    const enum status status = __real_live_run(live, seconds, budget, err);
    add(STEPS, began);
    return status;
}

void __real_skins_update(struct skins *skins);
void __wrap_skins_update(struct skins *skins);
void __wrap_skins_update(struct skins *skins)
{
    const double began = bench_seconds();
    __real_skins_update(skins);
    add(SKINS, began);
}

enum status __real_geometry_build(struct geometry *geometry, const struct render_view *view,
                                  const struct render_skin *skins, size_t skin_count,
                                  const double (*others)[3], size_t other_count, struct error *err);
enum status __wrap_geometry_build(struct geometry *geometry, const struct render_view *view,
                                  const struct render_skin *skins, size_t skin_count,
                                  const double (*others)[3], size_t other_count, struct error *err);
enum status __wrap_geometry_build(struct geometry *geometry, const struct render_view *view,
                                  const struct render_skin *skins, size_t skin_count,
                                  const double (*others)[3], size_t other_count, struct error *err)
{
    const double began = bench_seconds();
    const enum status status = __real_geometry_build(geometry, view, skins, skin_count, others, other_count,
                                                     err);
    add(ORDER, began);
    return status;
}

enum status __real_render_show(struct render *render, const struct render_view *view,
                               const struct render_scene *scene, struct error *err);
enum status __wrap_render_show(struct render *render, const struct render_view *view,
                               const struct render_scene *scene, struct error *err);
enum status __wrap_render_show(struct render *render, const struct render_view *view,
                               const struct render_scene *scene, struct error *err)
{
    const double began = bench_seconds();
    const enum status status = __real_render_show(render, view, scene, err);
    add(SHOW, began);
    return status;
}

void __real_glutSwapBuffers(void);
void __wrap_glutSwapBuffers(void);
void __wrap_glutSwapBuffers(void)
{
    const double began = bench_seconds();
    __real_glutSwapBuffers();
    add(PRESENT, began);
}

static void begin(double now)
{
    tally->began = now;
    tally->thread = -bench_thread_seconds();
    tally->process = -bench_process_seconds();
}

static void end(struct app *app, double now)
{
    tally->clock = now - tally->began;
    tally->thread += bench_thread_seconds();
    tally->process += bench_process_seconds();
    window_close(app->window);
}

void __real_app_draw(struct app *app);
void __wrap_app_draw(struct app *app);
void __wrap_app_draw(struct app *app)
{
    const double now = bench_seconds();
    if (tally->opened == 0)
        tally->opened = now;
    if (tally->began == 0 && now - tally->opened > warm_up)
        begin(now);
    if (tally->began > 0 && now - tally->began > measured && tally->clock == 0)
        end(app, now);
    __real_app_draw(app);
    tally->pictures += tally->began > 0 && tally->clock == 0;
    tally->filtered += tally->began > 0 && tally->clock == 0 && app->filtered.on;
}

/* A skin that all can be seen through, swelling as long as the window is open. */
static void show(const char *mesh_name, const char *style)
{
    const char *const settings[] = {"balloons[0].pressure=4", "balloons[0].threshold=100",
                                    "balloons[0].opacity=0.6"};
    struct scene scene = {0};
    struct mesh mesh = {0};
    struct mesh_report report;
    struct sim sim = {0};
    struct error err;
    char style_setting[32];
    snprintf(style_setting, sizeof style_setting, "view.style=%s", style);
    bench_check(scene_from_mesh(mesh_name, &scene, &err), &err);
    bench_check(scene_set(&scene, style_setting, &err), &err);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        bench_check(scene_set(&scene, settings[i], &err), &err);
    bench_check(scene_check(&scene, &err), &err);
    bench_check(sim_load_meshes(&scene, &mesh, &report, &err), &err);
    bench_check(sim_open(&sim, &scene, &mesh, 0, &err), &err);
    bench_check(sim_window(&(struct sim_window_options){NULL, WINDOW_PAST_BYTES}, &sim, NULL, &err), &err);
    _exit(0);
}

static void measure(const char *mesh_name, const char *style, const char *triangles, int asked)
{
    int status = 1;
    *tally = (struct tally){0};
    const pid_t child = fork();
    if (child == 0)
        show(mesh_name, style);
    if (child < 0 || waitpid(child, &status, 0) != child || status || !tally->pictures)
        exit(1);
    const double each = 1e3 / tally->pictures, *s = tally->seconds;
    printf("%s\t%s\t%.1f\t%d\t%.0f %%\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\n", style, triangles,
           tally->pictures / tally->clock, asked, 100.0 * tally->filtered / tally->pictures, s[STEPS] * each,
           s[SKINS] * each, s[ORDER] * each, (s[SHOW] - s[ORDER]) * each, s[PRESENT] * each,
           tally->thread * each, tally->process * each);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    char large[] = "/tmp/balloon-bench-XXXXXX", path[64];
    command_keep_memory();
    tally = mmap(NULL, sizeof *tally, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (argc != 4 || tally == MAP_FAILED || !mkdtemp(large))
        return 2;
    snprintf(path, sizeof path, "%s/large.ply", large);
    bench_run(large, (char *[]){argv[1], "-q", argv[2], "--fields-per-cube", "1", "--sigma", "0.4",
                                "--triangles", "100000", "-o", path, NULL});
    printf(
        "1280 x 480 stereo, sorted, running; ms a picture\n"
        "style\ttriangles\tframes/s\tasked\tfiltered\tsteps\tskins\torder\tdraw\tpresent\tthread\tprocessor\n");
    measure(argv[3], "latex", "3 thousand", 40);
    measure(argv[3], "paper", "3 thousand", 60);
    measure(path, "latex", "100 thousand", 8);
    bench_remove_folder(large);
    return 0;
}
