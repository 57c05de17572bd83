/* Effects do not disturb others: what is off is not there, what has no magnitude changes no bit, and what
 * wakes or sleeps says so. */
#include "../unit/balloon.h"
#include "scene_of_all.h"

/* The list of calls is the whole table: a new effect must be in it, and is then held to
 * all that is asked here. */
static void every_effect_is_under_test(void **state)
{
    (void)state;
    size_t count = 0;
    for (; effects[count]; count++) {
        bool found = false;
        for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++)
            found |= !strcmp(calls[i].name, effects[count]->name);
        if (!found)
            fail_msg("%s is not in tests/effects/scene_of_all.h", effects[count]->name);
    }
    assert_int_equal(count, sizeof calls / sizeof calls[0]);
}

static void each_is_called_for_by_its_block_and_by_no_other(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++) {
        struct scene_of_all s;
        struct error err = {0};
        assert_ok(scene_of_all_open(&s, 1, calls[i].name, &err), &err);
        for (const struct effect *const *effect = effects; *effect; effect++) {
            bool wanted = strcmp((*effect)->name, calls[i].name) != 0, hooked = false;
            for (size_t k = 0; k < sizeof calls / sizeof calls[0]; k++)
                if (!strcmp((*effect)->name, calls[k].name) && calls[k].needs)
                    wanted &= strcmp(calls[k].needs, calls[i].name) != 0;
            for (size_t k = 0; k < s.sim.hook_count[(*effect)->phase]; k++)
                hooked |= s.sim.hooks[(*effect)->phase][k].effect == *effect;
            assert_int_equal(hooked, wanted);
        }
        scene_of_all_close(&s);
    }
}

/* Blocks that are there and do nothing: no magnitude, or nothing that they touch. */
static const struct idle {
    const char *name, *keys[3];
    bool springs; /* a membrane has none of it */
} idle[] = {
    {"spring_by_height", {"balloons[0].spring_by_height.profile=((0.0, 1.0), (1.0, 1.0))"}, true},
    {"rip", {"balloons[0].rip.at=1e9"}, false},
    {"rip without a length", {"balloons[0].rip.length=0"}, false},
    {"bending", {"balloons[0].bending.stiffness=0", "balloons[0].bending.damping=1"}, false},
    {"viscosity", {"balloons[0].viscosity.ratio=0"}, true},
    {"plasticity", {"balloons[0].plasticity.yield=1e9"}, true},
    {"needles", {"needles[0].from=[0, 1000, 0]"}, false},
    {"ground", {"ground.height=-1000"}, false},
    {"obstacles", {"obstacles[0].place=[1000, 0, 0]"}, false},
    {"contact", {"contact.friction=0.3"}, false},
    {"gravity", {"gravity.acceleration=[0, 0, 0]", "gravity.air_density=1"}, false},
    {"drag", {"drag.air_density=0", "drag.wind=[9, 0, 0]"}, false},
    {"drag without a coefficient", {"drag.coefficient=0"}, false},
    {"string", {"balloons[0].string.slack=100"}, false},
    {"string of nothing",
     {"balloons[0].string.stiffness=0", "balloons[0].string.damping=0", "balloons[0].string.weight=1"},
     false},
    {"pins", {"balloons[0].pins.until=0"}, false},
    {"fracture", {"balloons[0].fracture.mode=paper"}, false},
};

/* Past the first break, where there is one. */
static void run_idle(struct balloon *b, bool membrane, const char *method, const struct idle *block)
{
    const char *keys[16] = {method, "time.step=0.0125", "balloons[0].threshold=1.03"};
    size_t count = 3;
    static const char *const rubber[] = {
        "balloons[0].membrane.thickness=0.45", "balloons[0].gas.ambient=6", "balloons[0].gas.fill=1.3",
        "balloons[0].gas.density=2e-5",        "balloons[0].gas.neck=30",   "balloons[0].pressure=0"};
    for (size_t i = 0; membrane && i < sizeof rubber / sizeof rubber[0]; i++)
        keys[count++] = rubber[i];
    for (size_t i = 0; block && i < sizeof block->keys / sizeof block->keys[0]; i++)
        keys[count++] = block->keys[i];
    open_balloon(b, 2, keys);
    steps(b, 80);
}

static void check_idle(bool membrane, const char *method)
{
    struct balloon plain;
    run_idle(&plain, membrane, method, NULL);
    assert_true(membrane || plain.sim.broken > 0);
    const bool xpbd = !strcmp(method, "time.integrator=xpbd");
    for (const struct idle *block = idle; block < idle + sizeof idle / sizeof idle[0]; block++) {
        struct balloon with;
        if ((membrane && block->springs) || (xpbd && !strcmp(block->name, "bending")))
            continue;
        run_idle(&with, membrane, method, block);
        const size_t rows = plain.sim.point_count * sizeof *plain.sim.position;
        if (memcmp(with.sim.position, plain.sim.position, rows) ||
            memcmp(with.sim.velocity, plain.sim.velocity, rows) ||
            memcmp(with.sim.edge_active, plain.sim.edge_active, plain.sim.edge_count))
            fail_msg("%s disturbs, %s", block->name, method);
        close_balloon(&with);
    }
    close_balloon(&plain);
}

static void a_block_without_magnitude_changes_no_bit(void **state)
{
    (void)state;
    for (size_t i = 0; integrators[i]; i++) {
        char method[64];
        snprintf(method, sizeof method, "time.integrator=%s", integrators[i]->name);
        check_idle(false, method);
        if (strcmp(integrators[i]->name, "xpbd"))
            check_idle(true, method);
    }
}

static bool told(struct sim *sim, const char *effect, const char *text)
{
    bool found = false;
    for (size_t i = 0; i < sim->news_count; i++)
        found |= !strcmp(sim->news[i].effect, effect) && strstr(sim->news[i].text, text);
    return found;
}

static void send(struct sim *sim, double speed)
{
    for (uint32_t p = 0; p < sim->point_count; p++)
        sim->velocity[p][0] = p < sim->balloons[1].point_begin ? speed : -speed;
}

/* Two balloons that meet and part: contact wakes, and sleeps when they are apart again. */
static void what_wakes_and_goes_to_sleep_says_so(void **state)
{
    (void)state;
    struct scene_of_all s;
    struct error err = {0};
    static const char *const keys[] = {"contact.friction=0",        "balloons[0].pressure=0",
                                       "balloons[1].mesh=sphere",   "balloons[1].position=[100, 2, 1]",
                                       "balloons[1].pressure=0",    "balloons[0].threshold=100",
                                       "balloons[1].threshold=100", "time.step=0.0125"};
    s = (struct scene_of_all){0};
    assert_ok(scene_from_mesh("sphere", &s.scene, &err), &err);
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        assert_ok(scene_set(&s.scene, keys[i], &err), &err);
    assert_ok(scene_check(&s.scene, &err), &err);
    for (int i = 0; i < 2; i++)
        shape_icosphere(2, &s.mesh[i]);
    assert_ok(sim_open(&s.sim, &s.scene, s.mesh, 1, &err), &err);
    send(&s.sim, 40);
    int i = 0;
    for (; i < 80 && !told(&s.sim, "contact", "wakes"); i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    assert_true(i > 1 && i < 80);
    assert_false(told(&s.sim, "contact", "sleeps"));
    send(&s.sim, -40);
    for (; i < 800 && !told(&s.sim, "contact", "sleeps"); i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    assert_true(i < 800);
    scene_of_all_close(&s);
}

/* Of several balloons each goes its own way: what one calls for leaves the other as if it were alone. */
static void effects_on_one_balloon_leave_the_other_as_if_it_were_alone(void **state)
{
    (void)state;
    struct scene_of_all s;
    struct balloon alone;
    struct error err = {0};
    assert_ok(scene_of_all_open(&s, 2, "contact", &err), &err);
    open_balloon(
        &alone, 2,
        SETTINGS("time.step=0.0125", "balloons[0].threshold=1.4", "balloons[0].pressure_on=areas",
                 "balloons[0].pressure=0.5", "balloons[0].rip.at=0.1", "balloons[0].viscosity.ratio=0.5",
                 "balloons[0].spring_by_height.profile=((0.0, 1.0), (1.0, 2.0))",
                 "balloons[0].plasticity.yield=1", "balloons[0].pins.reach=20",
                 "gravity.acceleration=[0, -20, 0]", "drag.air_density=1e-6", "ground.height=-46",
                 "obstacles[0].shape=sphere", "obstacles[0].place=[0, 60, 0]", "needles[0].from=[0, 200, 0]",
                 "needles[0].velocity=[0, -2000, 0]", "time.guard=off"));
    s.scene.time.guard = SCENE_GUARD_OFF; /* which goes by the stiffest of all balloons */
    steps(&alone, 60);
    for (int i = 0; i < 60; i++)
        assert_ok(sim_step(&s.sim, &err), &err);
    assert_true(alone.sim.broken > 0);
    assert_memory_equal(s.sim.position, alone.sim.position,
                        alone.sim.point_count * sizeof *alone.sim.position);
    assert_memory_equal(s.sim.velocity, alone.sim.velocity,
                        alone.sim.point_count * sizeof *alone.sim.velocity);
    scene_of_all_close(&s);
    close_balloon(&alone);
}

static uint64_t hash_of_crowd(unsigned workers)
{
    enum { CROWD = 40 };
    static const char *const keys[] = {"mesh=sphere",    "membrane.thickness=0.45", "gas.ambient=10",
                                       "gas.fill=1.5",   "fracture.strength=1.1",   "string.weight=1",
                                       "pins.until=0.1", "bending.stiffness=1",     "pressure=0",
                                       "rip.at=0.02"};
    struct scene scene = {0};
    struct mesh meshes[CROWD];
    struct sim sim = {0};
    struct error err = {0};
    assert_ok(scene_from_mesh("sphere", &scene, &err), &err);
    for (int b = 0; b < CROWD; b++) {
        char key[80];
        for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
            snprintf(key, sizeof key, "balloons[%d].%s", b, keys[i]);
            assert_ok(scene_set(&scene, key, &err), &err);
        }
        snprintf(key, sizeof key, "balloons[%d].position=[%d, 0, 0]", b, 200 * b);
        assert_ok(scene_set(&scene, key, &err), &err);
        shape_icosphere(1, &meshes[b]);
    }
    assert_ok(scene_check(&scene, &err), &err);
    assert_ok(sim_open(&sim, &scene, meshes, workers, &err), &err);
    for (int i = 0; i < 8; i++)
        assert_ok(sim_step(&sim, &err), &err);
    const uint64_t hash = sim_hash(&sim);
    sim_clear(&sim);
    for (int b = 0; b < CROWD; b++)
        mesh_clear(&meshes[b]);
    scene_clear(&scene);
    return hash;
}

/* Each with blocks of its own, and its share of the state. */
static void as_many_balloons_as_one_likes_have_a_state(void **state)
{
    (void)state;
    assert_true(hash_of_crowd(1) == hash_of_crowd(3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_effect_is_under_test),
        cmocka_unit_test(each_is_called_for_by_its_block_and_by_no_other),
        cmocka_unit_test(a_block_without_magnitude_changes_no_bit),
        cmocka_unit_test(what_wakes_and_goes_to_sleep_says_so),
        cmocka_unit_test(effects_on_one_balloon_leave_the_other_as_if_it_were_alone),
        cmocka_unit_test(as_many_balloons_as_one_likes_have_a_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
