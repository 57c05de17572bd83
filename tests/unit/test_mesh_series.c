/* Meshes for other programs: a frame each, and a cache of motion. */
#include "balloon.h"
#include "common/file.h"
#include "folder.h"
#include "sim/mesh_series.h"
#include "sim/motion_cache.h"
#include "sim/skin_mesh.h"

#include <fcntl.h>

/* A burst of the paper's kind: some triangles are gone, some points carry nothing. */
static void open_burst(struct balloon *b)
{
    open_balloon(b, 3, SETTINGS("balloons[0].threshold=1.3"));
    while (b->sim.time < 1)
        steps(b, 1);
    assert_true(b->sim.broken > 100 && sim_measure(&b->sim).triangles_active < b->sim.triangle_count);
}

static void add_frames(struct balloon *b, const struct mesh_series_options *options, int frames,
                       size_t removed)
{
    struct mesh_series *series = NULL;
    struct error err = {0};
    size_t gone;
    assert_ok(mesh_series_open(&b->sim, options, &series, &err), &err);
    for (int i = 0; i < frames; i++) {
        assert_ok(mesh_series_add(series, &err), &err);
        steps(b, 1);
    }
    assert_ok(mesh_series_close(series, &gone, &err), &err);
    assert_int_equal(gone, removed);
}

static bool is_there(const char *path)
{
    return access(path, F_OK) == 0;
}

static void own_reader_reads_the_skin_back(void **state)
{
    (void)state;
    struct balloon b;
    struct mesh mesh = {0};
    struct error err = {0};
    open_burst(&b);
    const struct sim_measures m = sim_measure(&b.sim);
    add_frames(&b, &(struct mesh_series_options){.folder = "."}, 1, 0);
    assert_ok(mesh_load("mesh_0000.ply", &mesh, &err), &err);
    assert_int_equal(mesh.triangle_count, m.triangles_active);
    assert_true(mesh.point_count < b.sim.point_count);     /* some carry no skin */
    assert_near(mesh_area(&mesh), m.area, 1e-12 * m.area); /* places are kept to the bit */
    mesh_clear(&mesh);
    close_balloon(&b);
}

/* Of a sphere that is blown up to twice its size as a whole: areas 4 times those at rest, one piece, and the
 * opacity of the film at a quarter of its thickness, 1 - (1 - .97)^(1/4); to a float's rounding. */
static void points_tell_stretch_opacity_and_piece(void **state)
{
    (void)state;
    struct balloon b;
    struct skin_mesh skin;
    struct error err = {0};
    open_balloon(&b, 2, SETTINGS("balloons[0].opacity=0.97"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        for (int i = 0; i < 3; i++)
            b.sim.position[p][i] *= 2;
    for (int apart = 0; apart < 2; apart++) {
        assert_ok(skin_mesh_init(&skin, &b.sim, apart, &err), &err);
        skin_mesh_take(&skin);
        assert_int_equal(skin.mesh.point_count, apart ? 3 * b.sim.triangle_count : b.sim.point_count);
        for (uint32_t p = 0; p < skin.mesh.point_count; p++) {
            assert_near((double)skin.stretch[p], 4, 1e-6);
            assert_near((double)skin.opacity[p], 1 - pow(0.03, 0.25), 1e-6);
            assert_int_equal(skin.piece[p], 0);
        }
        skin_mesh_clear(&skin);
    }
    close_balloon(&b);
}

static void constant_numbers_stay_while_triangles_go(void **state)
{
    (void)state;
    struct balloon b;
    struct skin_mesh skin;
    struct error err = {0};
    open_burst(&b);
    assert_ok(skin_mesh_init(&skin, &b.sim, true, &err), &err);
    skin_mesh_take(&skin);
    uint32_t gone = 0;
    for (uint32_t t = 0; t < b.sim.triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++)
            assert_int_equal(skin.mesh.triangle[t][k], 3 * t + k);
        for (uint32_t k = 0; k < 3 && b.sim.triangle_active[t]; k++)
            assert_memory_equal(skin.mesh.position[3 * t + k], b.sim.position[b.sim.triangle_point[t][k]],
                                3 * sizeof(double));
        if (b.sim.triangle_active[t])
            continue;
        gone++;
        assert_memory_equal(skin.mesh.position[3 * t], skin.mesh.position[3 * t + 2], 3 * sizeof(double));
        assert_int_equal(skin.piece[3 * t], -1);
    }
    assert_int_equal(gone, b.sim.triangle_count - sim_measure(&b.sim).triangles_active);
    skin_mesh_clear(&skin);
    close_balloon(&b);
}

/* A shorter run in the same folder leaves nothing of the longer one, and nothing else is touched. */
static void no_meshes_of_two_runs_are_ever_together(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    add_frames(&b, &(struct mesh_series_options){.folder = "series"}, 5, 0);
    write_text("series/mesh_0003.ply.bak", "mine");
    write_text("series/mesh_12.ply", "mine too");
    write_text("series/mesh_0003.vtp", "and mine");
    add_frames(&b, &(struct mesh_series_options){.folder = "series"}, 0, 0);
    assert_true(is_there("series/mesh_0004.ply") && is_there("series/mesh.ply.series"));
    add_frames(&b, &(struct mesh_series_options){.folder = "series"}, 2, 5);
    assert_true(is_there("series/mesh_0001.ply") && !is_there("series/mesh_0002.ply"));
    assert_true(is_there("series/mesh_0003.ply.bak") && is_there("series/mesh_12.ply"));
    add_frames(&b, &(struct mesh_series_options){.folder = "series", .vtp = true}, 1, 1);
    assert_int_equal(system("rm -r series"), 0);
    close_balloon(&b);
}

/* The first part is killed after its checkpoint, the second before its first one: neither is closed when the
 * next goes on. */
static void a_run_that_goes_on_keeps_the_list_of_its_first_part(void **state)
{
    (void)state;
    struct balloon b;
    struct mesh_series *part[2];
    struct error err = {0};
    char text[1024] = "";
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1", "time.step=0.25"));
    for (int i = 0; i < 2; i++) {
        const struct mesh_series_options options = {.folder = ".", .first = i ? 2 : 0};
        assert_ok(mesh_series_open(&b.sim, &options, &part[i], &err), &err);
        for (int frame = 0; frame < 4; frame++) {
            assert_ok(mesh_series_add(part[i], &err), &err);
            assert_ok(i ? STATUS_OK : mesh_series_list(part[i], &err), &err);
            steps(&b, 1);
        }
    }
    b.sim.time = 1;
    add_frames(&b, &(struct mesh_series_options){.folder = ".", .first = 2}, 1, 4);
    FILE *list = fopen("mesh.ply.series", "r");
    text[fread(text, 1, sizeof text - 1, list)] = '\0';
    fclose(list);
    assert_string_equal(text, "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
                              "    {\"name\": \"mesh_0000.ply\", \"time\": 0},\n"
                              "    {\"name\": \"mesh_0001.ply\", \"time\": 0.25},\n"
                              "    {\"name\": \"mesh_0002.ply\", \"time\": 1}\n  ]\n}\n");
    for (int i = 0; i < 2; i++)
        assert_ok(mesh_series_close(part[i], &(size_t){0}, &err), &err);
    close_balloon(&b);
}

/* The head is 32 bytes; then 3 floats for each point of each sample; the mesh beside
 * it has as many points. */
static void a_cache_holds_the_places_of_its_meshs_points(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct motion_cache *cache = NULL;
    struct mesh mesh = {0};
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    assert_ok(motion_cache_open(&b.sim, "motion.pc2", 7, &cache, &err), &err);
    for (int i = 0; i < 3; i++) {
        motion_cache_add(cache);
        steps(&b, i < 2);
    }
    assert_ok(motion_cache_close(cache, &err), &err);
    assert_ok(mesh_load("motion.ply", &mesh, &err), &err);
    assert_int_equal(mesh.point_count, 240);
    static unsigned char bytes[32 + 3 * 240 * 12 + 1];
    FILE *file = fopen("motion.pc2", "rb");
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes - 1);
    fclose(file);
    int32_t head[3];
    float frames[2], last[3];
    memcpy(head, bytes + 12, 8);
    memcpy(frames, bytes + 20, 8);
    memcpy(&head[2], bytes + 28, 4);
    assert_memory_equal(bytes, "POINTCACHE2\0", 12);
    assert_true(head[0] == 1 && head[1] == 240 && head[2] == 3);
    assert_near((double)frames[0], 7, 0);
    assert_near((double)frames[1], 1, 0);
    memcpy(last, bytes + sizeof bytes - 1 - 12, 12);
    for (int i = 0; i < 3; i++)
        assert_true(last[i] == (float)b.sim.position[b.sim.triangle_point[79][2]][i]);
    mesh_clear(&mesh);
    close_balloon(&b);
}

static void what_cannot_be_written_is_said(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct mesh_series *series = NULL;
    struct motion_cache *cache = NULL;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    write_text("file", "no folder");
    assert_refused(mesh_series_open(&b.sim, &(struct mesh_series_options){.folder = "file"}, &series, &err),
                   STATUS_FILE, "file: is a file; give the name of a folder", &err);
    assert_refused(motion_cache_open(&b.sim, "no/such.pc2", 0, &cache, &err), STATUS_FILE,
                   "no/such.pc2: cannot create", &err);
    assert_refused(mesh_save_values(&b.mesh, NULL, 0, "a.obj", &err), STATUS_USAGE,
                   "a.obj: no format for meshes with values; must be .ply or .vtp", &err);
    if (deny_writing())
        assert_refused(mesh_series_open(&b.sim, &(struct mesh_series_options){.folder = "."}, &series, &err),
                       STATUS_FILE, ".: cannot write into: ", &err);
    else
        print_message("# skipped: root cannot become somebody who may not write\n");
    allow_writing();
    close_balloon(&b);
}

static void a_folder_that_goes_away_before_the_first_mesh_is_named(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct mesh_series *series = NULL;
    size_t removed;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    assert_ok(mesh_series_open(&b.sim, &(struct mesh_series_options){.folder = "gone"}, &series, &err), &err);
    assert_int_equal(rmdir("gone"), 0);
    assert_refused(mesh_series_add(series, &err), STATUS_FILE, "gone: cannot read: No such file", &err);
    assert_ok(mesh_series_close(series, &removed, &err), &err);
    close_balloon(&b);
}

static void a_mesh_of_an_earlier_run_that_stays_is_named(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct mesh_series *series = NULL;
    size_t removed;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    write_text("mesh_0003.ply", "of an earlier run");
    assert_ok(mesh_series_open(&b.sim, &(struct mesh_series_options){.folder = "."}, &series, &err), &err);
    if (deny_writing())
        assert_refused(mesh_series_add(series, &err), STATUS_FILE,
                       ".ply: cannot remove the earlier run's: Permission denied", &err);
    else
        print_message("# skipped: root cannot become somebody who may not write\n");
    allow_writing();
    assert_ok(mesh_series_close(series, &removed, &err), &err);
    close_balloon(&b);
}

/* Its head is written last, which needs a place to go back to; and what is behind it may not have fitted. */
static void a_cache_of_motion_needs_a_file_with_room(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    struct motion_cache *cache = NULL;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=1"));
    assert_int_equal(mkfifo("pipe.pc2", 0600), 0);
    const int reader = open("pipe.pc2", O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    assert_refused(motion_cache_open(&b.sim, "pipe.pc2", 0, &cache, &err), STATUS_FILE,
                   "pipe.pc2: cannot go back in it", &err);
    close(reader);
    assert_int_equal(symlink("/dev/full", "full.pc2"), 0);
    write_text("full.ply", "old");
    assert_ok(motion_cache_open(&b.sim, "full.pc2", 0, &cache, &err), &err);
    motion_cache_add(cache);
    assert_refused(motion_cache_close(cache, &err), STATUS_FILE, "full.pc2: cannot write: No space left",
                   &err);
    struct bytes mesh = {0};
    assert_ok(file_read("full.ply", &mesh, &err), &err); /* that of the motion before */
    assert_string_equal(mesh.data, "old");
    bytes_clear(&mesh);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_reader_reads_the_skin_back),
        cmocka_unit_test(points_tell_stretch_opacity_and_piece),
        cmocka_unit_test(constant_numbers_stay_while_triangles_go),
        cmocka_unit_test(no_meshes_of_two_runs_are_ever_together),
        cmocka_unit_test(a_run_that_goes_on_keeps_the_list_of_its_first_part),
        cmocka_unit_test(a_cache_holds_the_places_of_its_meshs_points),
        cmocka_unit_test(what_cannot_be_written_is_said),
        cmocka_unit_test(a_folder_that_goes_away_before_the_first_mesh_is_named),
        cmocka_unit_test(a_mesh_of_an_earlier_run_that_stays_is_named),
        cmocka_unit_test(a_cache_of_motion_needs_a_file_with_room),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
