/* Skins of springs that tear: waves, and cracks with them, go by the springs that there are. */
#include "burst/inflated.h"
#include "common/scene_fields.h"

#include <string.h>

static void turn_springs(struct inflated *it, double factor)
{
    struct scene_schedule change = {.balloon = -1, .change_count = 1};
    change.change[0].field = scene_find_field(scene_find_block("", "balloons"), "spring_factor");
    change.change[0].value = factor;
    sim_change(&it->sim, &change);
}

/* Pricked, with these springs; turned to `factor` before the first step. */
static uint64_t hash_of_burst(const char *spring, const char *other, double factor)
{
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 2.2, .springs = true, .keys = {spring, other}});
    turn_springs(&it, factor);
    prick(&it);
    run_until(&it, 1);
    assert_true(it.balloon->topology->now.edges > 10);
    const uint64_t hash = sim_hash(&it.sim);
    deflate(&it);
    return hash;
}

static void springs_by_height_tear_as_those_said_outright(void **unused)
{
    (void)unused;
    const char *by_height = "balloons[0].spring_by_height.profile=((0, 4), (1, 4))";
    assert_true(hash_of_burst("balloons[0].spring=0.5", by_height, 1) ==
                hash_of_burst("balloons[0].spring=2", NULL, 1));
}

/* Whatever they were at first: where that is nothing, waves stood still. */
static void springs_that_are_turned_tear_as_those_said_outright(void **unused)
{
    (void)unused;
    const char *spring = "balloons[0].spring=2";
    const uint64_t said = hash_of_burst(spring, "balloons[0].spring_factor=1", 1);
    assert_true(hash_of_burst(spring, "balloons[0].spring_factor=0.25", 1) == said);
    assert_true(hash_of_burst(spring, "balloons[0].spring_factor=0", 1) == said);
}

static void skin_tears_once_springs_are_turned_on(const char *before)
{
    struct inflated it;
    inflate(&it, &(struct inflation){
                     .level = 3, .stretch = 3, .springs = true, .keys = {before, "balloons[0].pressure=0"}});
    run_until(&it, 0.2);
    prick(&it);
    run_until(&it, 0.4);
    const uint32_t pricked = it.balloon->topology->now.edges;
    assert_true(pricked > 0);
    run_until(&it, 0.6);
    assert_int_equal(it.balloon->topology->now.edges, pricked);
    turn_springs(&it, 1);
    run_until(&it, 0.8);
    assert_true(it.balloon->topology->now.edges > pricked + 10);
    deflate(&it);
}

/* Skin that nothing holds is not torn by being stretched; what hardly holds waits long to be looked at. */
static void springs_of_nothing_tear_once_they_are_turned_on(void **unused)
{
    (void)unused;
    skin_tears_once_springs_are_turned_on("balloons[0].spring_factor=0");
    skin_tears_once_springs_are_turned_on("balloons[0].spring_factor=1e-8");
}

static void rubber_has_no_springs_to_be_turned(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 2, .stretch = 1.2});
    run_until(&it, 0.1);
    const double speed = fracture_wave_speed(it.balloon), look = it.balloon->fracture->now.next_look;
    turn_springs(&it, 4);
    assert_true(fracture_wave_speed(it.balloon) == speed && it.balloon->fracture->now.next_look == look);
    deflate(&it);
}

/* An icosphere one side of which has a third triangle between its two, `width` times as wide as they are. */
static void make_slivered(struct mesh *mesh, double width)
{
    struct mesh ball;
    struct error err = {0};
    shape_icosphere(3, &ball);
    const uint32_t points = ball.point_count, triangles = ball.triangle_count, *p = ball.triangle[0];
    assert_ok(mesh_init(mesh, points + 1, triangles + 2, false, &err), &err);
    memcpy(mesh->position, ball.position, points * sizeof *mesh->position);
    memcpy(mesh->triangle, ball.triangle, triangles * sizeof *mesh->triangle);
    for (int i = 0; i < 3; i++) {
        const double middle = (ball.position[p[0]][i] + ball.position[p[1]][i]) / 2;
        mesh->position[points][i] = middle + width * (ball.position[p[2]][i] - middle);
    }
    memcpy(mesh->triangle[0], (uint32_t[3]){p[0], points, p[2]}, sizeof *mesh->triangle);
    memcpy(mesh->triangle[triangles], (uint32_t[3]){points, p[1], p[2]}, sizeof *mesh->triangle);
    memcpy(mesh->triangle[triangles + 1], (uint32_t[3]){p[0], p[1], points}, sizeof *mesh->triangle);
    assert_ok(mesh_connect(mesh, &err), &err);
    mesh_clear(&ball);
}

/* Springs let it open as it may: hardly stretched skin tore there at once. */
static void what_is_next_to_a_line_tears_no_sooner(void **unused)
{
    (void)unused;
    static const double widths[] = {0, 1e-12, 1e-7, 1e-3, 1e-2};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        struct inflated it = {0};
        struct mesh mesh;
        struct error err = {0};
        make_slivered(&mesh, widths[i]);
        assert_ok(scene_from_mesh("balloon.ply", &it.scene, &err), &err);
        set_springs(&it.scene, 1.1, 0.15);
        assert_ok(scene_set(&it.scene, "time.guard=substep", &err), &err);
        assert_ok(scene_set(&it.scene, "balloons[0].fracture.mode=tear", &err), &err);
        assert_ok(sim_open(&it.sim, &it.scene, &mesh, 1, &err), &err);
        run_until(&it, 2);
        assert_int_equal(it.sim.broken, 0);
        double held, borne;
        assert_true(fracture_nearest(it.sim.balloons, &held, &borne));
        assert_true(fracture_equal_stretch(held) < 1.3);
        mesh_clear(&mesh);
        deflate(&it);
    }
}

/* Edges that a cut has made at a step's end hold their half in the log of a moment within it, too. */
static void a_look_at_a_step_that_ends_in_cuts_finds_all_that_skin_holds(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3,
                                     .stretch = 2.2,
                                     .springs = true,
                                     .keys = {"time.integrator=rk-adaptive", "balloons[0].pressure=0"}});
    prick(&it);
    for (int cuts = 0; cuts < 10;) {
        struct error err = {0};
        const uint32_t before = it.balloon->topology->now.edges;
        assert_ok(sim_step(&it.sim, &err), &err);
        if (it.balloon->topology->now.edges == before)
            continue;
        const double held = sim_measure(&it.sim).elastic_energy;
        sim_look(&it.sim, it.sim.time - 1e-9 * it.sim.taken);
        assert_near(sim_measure(&it.sim).elastic_energy, held, 1e-6 * held);
        sim_look_end(&it.sim);
        cuts++;
    }
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_by_height_tear_as_those_said_outright),
        cmocka_unit_test(springs_that_are_turned_tear_as_those_said_outright),
        cmocka_unit_test(springs_of_nothing_tear_once_they_are_turned_on),
        cmocka_unit_test(rubber_has_no_springs_to_be_turned),
        cmocka_unit_test(what_is_next_to_a_line_tears_no_sooner),
        cmocka_unit_test(a_look_at_a_step_that_ends_in_cuts_finds_all_that_skin_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
