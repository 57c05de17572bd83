/*
 * The paper's section 4, claim by claim, on the paper's own road: one cube, one Gaussian, marching cubes,
 * about 3000 triangles, springs of 20, dampers of 1, steps of 0.025 s, 400 of them.
 *
 * The paper gives neither mass nor size. With 0.11 and a radius of 45 all its claims hold at once; the
 * numbers below are what that set gives here, with room for another compiler's rounding, which moves single
 * pieces but not the story.
 */
#include "unit/check.h"

#include "sim/sim.h"
#include "support/shapes.h"
#include "surface/surface.h"

static struct mesh sphere;  /* figure 4: the surface of one Gaussian, 3032 triangles */
static struct mesh regular; /* the icosphere of 5120 triangles: as symmetrical as a sphere can be */

static int make_meshes(void **state)
{
    (void)state;
    struct error err = {0};
    struct octree cube = {0};
    struct surface_options options = surface_defaults();
    options.field.fields_per_cube = 1;
    options.field.sigma = 0.4;
    options.triangles = 3032;
    options.relax = 0; /* the paper had plain marching cubes, whose uneven edges are where a burst begins */
    struct surface_stats stats;
    shape_icosphere(4, &regular);
    bool made = !octree_init(&cube, 0, 1, &err) && !surface_make(&cube, &options, &sphere, &stats, &err) &&
                !mesh_connect(&sphere, &err);
    octree_clear(&cube);
    if (!made)
        print_error("%s\n", err.text);
    return !made;
}

static int clear_meshes(void **state)
{
    (void)state;
    mesh_clear(&sphere);
    mesh_clear(&regular);
    return 0;
}

/* What became of a balloon within 400 frames. */
struct story {
    int breaking;         /* frame by which 1 % of the edges had broken; 400: never */
    double radius;        /* mean radius then, over that at rest; at the end if it never broke */
    double broken;        /* share of the edges at the end */
    int broken_by;        /* frame by which 95 % of that breaking had happened */
    double area, largest; /* of all skin and of the largest piece at the end, over the area at rest */
    uint32_t pieces;
    double triangles; /* share left at the end */
};

enum { FRAMES = 400 };

static struct story tell(const struct mesh *mesh, const char *const *changes)
{
    struct error err = {0};
    struct scene scene = {0};
    struct sim sim = {0};
    static uint32_t broken[FRAMES + 1];
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    for (; *changes; changes++)
        assert_ok(scene_set(&scene, *changes, &err), &err);
    assert_ok(scene_check(&scene, &err), &err);
    assert_ok(sim_open(&sim, &scene, mesh, 1, &err), &err);

    const struct sim_measures rest = sim_measure(&sim);
    struct story story = {.breaking = FRAMES};
    for (int frame = 1; frame <= FRAMES; frame++) {
        assert_ok(sim_step(&sim, &err), &err);
        broken[frame] = sim.broken;
        if (story.breaking < FRAMES)
            continue;
        story.radius = fmax(story.radius, sim_measure(&sim).mean_radius / rest.mean_radius);
        if (sim.broken > sim.edge_count / 100)
            story.breaking = frame;
    }
    const struct sim_measures end = sim_measure(&sim);
    while (broken[story.broken_by] < 0.95 * broken[FRAMES])
        story.broken_by++;
    story.broken = (double)sim.broken / sim.edge_count;
    story.area = end.area / rest.area;
    story.largest = end.largest_piece_area / rest.area;
    story.pieces = end.pieces;
    story.triangles = (double)end.triangles_active / sim.triangle_count;
    sim_clear(&sim);
    scene_clear(&scene);
    return story;
}
#define TELL(mesh, ...) tell(&mesh, (const char *const[]){__VA_ARGS__ __VA_OPT__(, ) NULL})

/* "Simulations of a spherical surface [...] consisting of approximately 3000 polygons" */
static void the_sphere_has_about_3000_polygons(void **state)
{
    (void)state;
    assert_near(sphere.triangle_count, 3000, 150);
}

/* "a spring constant of 20.0 and an damping constant of 1.0 produced simulations that looked
 * realistic"; "the balloon must be allowed to expand before it explodes": seen, radius x 1.42 when the
 * first 1 % of the edges have gone. */
static void the_balloon_expands_visibly_before_it_bursts(void **state)
{
    (void)state;
    struct story story = TELL(sphere);
    assert_near(story.radius, 1.42, 0.05);
    assert_in_range(story.breaking, 20, 60);
}

/* "usually produced a complete explosion animation in approximately 400 frames": seen, 95 % of the breaking
 * by frame 251, 80 pieces, the largest 4 % of the skin. */
static void the_burst_is_complete_within_400_frames(void **state)
{
    (void)state;
    struct story story = TELL(sphere);
    assert_true(story.broken > 0.2);
    assert_true(story.broken_by < 350);
    assert_true(story.pieces >= 20);
    assert_true(story.largest < 0.2);
}

/* "Spring constants higher than 20 resulted in unstable surfaces due to abnormal stretching of the point mesh
 * which produced premature explosions": seen, radius x 1.26. */
static void stiffer_springs_burst_prematurely(void **state)
{
    (void)state;
    assert_true(TELL(sphere, "balloons[0].spring=40").radius < TELL(sphere).radius - 0.1);
}

/* "Damping constants greater than 1.0 resulted in an over compensation of the point velocities which produced
 * unstable surfaces as well": seen, radius x 1.17 at 1.5 and 1.08 at 2. */
static void stronger_damping_bursts_prematurely(void **state)
{
    (void)state;
    double paper = TELL(sphere).radius;
    double more = TELL(sphere, "balloons[0].damping=1.5").radius;
    double most = TELL(sphere, "balloons[0].damping=2").radius;
    assert_true(more < paper - 0.15);
    assert_true(most < more - 0.05);
    assert_true(most < 1.15);
}

/* "selecting a threshold that is approximately twice the average resting length of the edges produces a
 * realistic simulation": at 1.5 the longest edges of the mesh go on the first frame. */
static void a_low_threshold_bursts_prematurely(void **state)
{
    (void)state;
    struct story story = TELL(sphere, "balloons[0].threshold=1.5");
    assert_in_range(story.breaking, 1, 10);
    assert_true(story.radius < 1.1);
}

/* "if it expands too much, it will fill the viewing window": seen, radius x 1.7; this regular a
 * mesh may then even hold. */
static void a_high_threshold_lets_it_grow_larger(void **state)
{
    (void)state;
    assert_true(TELL(sphere, "balloons[0].threshold=2.5").radius > TELL(sphere).radius + 0.15);
}

/* "the pressure must be sufficiently large to cause the balloon to explode or else it will achieve a stable
 * equilibrium and remain inert": seen, nothing breaks at 4, .6 % at 5. */
static void too_little_pressure_leaves_it_inert(void **state)
{
    (void)state;
    struct story story = TELL(sphere, "balloons[0].pressure=4");
    assert_near(story.broken, 0, 0.001);
    assert_int_equal(story.pieces, 1);
    assert_in_range(story.radius * 100, 110, 160);
    assert_true(TELL(sphere, "balloons[0].pressure=5").broken < 0.01);
}

/* "if the internal pressure is set to a very high level, the balloon will simply disintegrate into many small
 * particles": seen at ten times the pressure, 261 pieces, the largest .3 % of the skin, within 60 frames. */
static void ten_times_the_pressure_leaves_small_particles(void **state)
{
    (void)state;
    struct story story = TELL(sphere, "balloons[0].pressure=100");
    assert_true(story.triangles < 0.2);
    assert_true(story.largest < 0.01);
    assert_true(story.pieces > 100);
    assert_true(story.broken_by < 100);
}

/* "If the interval was too large, then the Euler integration would create an unstable surface and polygons
 * would fly apart": seen, earlier already at .03; at .1 nothing is left after 5 frames. */
static void too_large_a_step_makes_polygons_fly_apart(void **state)
{
    (void)state;
    assert_true(TELL(sphere, "time.step=0.03").radius < TELL(sphere).radius - 0.04);
    struct story story = TELL(sphere, "time.step=0.1");
    assert_true(story.triangles < 0.02);
    assert_true(story.broken_by < 10);
}

/* "if the time interval were too small, then it would take many frames before anything
 * interesting would happen" */
static void too_small_a_step_takes_many_frames(void **state)
{
    (void)state;
    assert_true(TELL(sphere, "time.step=0.0025").breaking > 8 * TELL(sphere).breaking);
}

/* 4.1: "the surface is sufficiently symmetrical that the rips in the surface occur at many locations
 * simultaneously [...] the balloon resembles a disintegration rather than an explosion": seen, 192 pieces,
 * none over .8 % of the skin. */
static void the_regular_sphere_disintegrates(void **state)
{
    (void)state;
    struct story story = TELL(regular);
    assert_true(story.pieces > 100);
    assert_true(story.largest < 0.02);
}

/* 4.1: "The artificial rip allows the surface to break up into larger pieces, resulting in a more
 * realistic explosion": at a pressure of 6, below the one at which it bursts by itself; seen, 29 pieces,
 * the largest 33 % of the skin. */
static void an_artificial_rip_leaves_larger_pieces(void **state)
{
    (void)state;
    struct story whole = TELL(regular, "balloons[0].pressure=6");
    assert_int_equal(whole.pieces, 1);
    assert_near(whole.broken, 0, 0);
    struct story ripped = TELL(regular, "balloons[0].pressure=6", "balloons[0].rip.at=1");
    assert_true(ripped.broken > 0.05);
    assert_in_range(ripped.pieces, 5, 80);
    assert_true(ripped.largest > 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sphere_has_about_3000_polygons),
        cmocka_unit_test(the_balloon_expands_visibly_before_it_bursts),
        cmocka_unit_test(the_burst_is_complete_within_400_frames),
        cmocka_unit_test(stiffer_springs_burst_prematurely),
        cmocka_unit_test(stronger_damping_bursts_prematurely),
        cmocka_unit_test(a_low_threshold_bursts_prematurely),
        cmocka_unit_test(a_high_threshold_lets_it_grow_larger),
        cmocka_unit_test(too_little_pressure_leaves_it_inert),
        cmocka_unit_test(ten_times_the_pressure_leaves_small_particles),
        cmocka_unit_test(too_large_a_step_makes_polygons_fly_apart),
        cmocka_unit_test(too_small_a_step_takes_many_frames),
        cmocka_unit_test(the_regular_sphere_disintegrates),
        cmocka_unit_test(an_artificial_rip_leaves_larger_pieces),
    };
    return cmocka_run_group_tests(tests, make_meshes, clear_meshes);
}
