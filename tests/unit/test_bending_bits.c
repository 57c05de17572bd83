/* Hinges give the same bits on any number of threads and by any set of instructions, and leave
 * those of normals alone. */
#include "hinges.h"
#include "sim/bending_kernels.h"

/* Through crumpling and cuts, to the bit. */
static void torn_hinges_are_equal_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {1, 2, 3, 7};
    struct error err = {0};
    struct balloon b;
    open_balloon(&b, 3,
                 HINGES("balloons[0].spring=1", "balloons[0].bending.damping=0.02", "time.step=0.02",
                        "balloons[0].fracture.mode=tear", "balloons[0].fracture.strength=50"));
    uint64_t first = 0;
    for (size_t w = 0; w < sizeof workers / sizeof workers[0]; w++) {
        struct sim sim;
        uint64_t random = 8;
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers[w], &err), &err);
        fill(sim.position, sim.balloons->point_end, 0.05, &random);
        for (int s = 0; s < 10; s++) {
            cut_some(&sim, 7);
            assert_ok(sim_step(&sim, &err), &err);
        }
        assert_true(sim.broken >= 70);
        if (w == 0)
            first = sim_hash(&sim);
        assert_true(sim_hash(&sim) == first);
        sim_clear(&sim);
    }
    close_balloon(&b);
}

/* Corner 0 of a triangle goes most of the `way` to the side across. */
static void squash(struct sim *sim, uint32_t triangle, double way)
{
    const uint32_t *p = sim->triangle_point[triangle];
    for (int i = 0; i < 3; i++)
        sim->position[p[0]][i] += way * ((sim->position[p[1]][i] + sim->position[p[2]][i]) / 2 -
                                         sim->position[p[0]][i]);
}

static void set_neighbours(struct sim *sim, uint32_t triangle, unsigned char active)
{
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 9 && t != triangle; k++)
            if (sim->triangle_edge[t][k / 3] == sim->triangle_edge[triangle][k % 3])
                sim->triangle_active[t] = active;
}

/* What watch() gives to the guard, with one triangle squashed. */
static double steepest(struct sim *sim, uint32_t triangle, double way, bool alone)
{
    const uint32_t corner = sim->triangle_point[triangle][0];
    double kept[3], most = 0;
    memcpy(kept, sim->position[corner], sizeof kept);
    squash(sim, triangle, way);
    set_neighbours(sim, triangle, !alone);
    sim_forces(sim);
    for (size_t i = 0; i < sim->part_count; i++)
        most = fmax(most, sim->balloons->bending->range[i]);
    set_neighbours(sim, triangle, 1);
    memcpy(sim->position[corner], kept, sizeof kept);
    return most;
}

/* Crushed, or with neighbours that are gone and edges that are not: wherever a part ends. */
static void the_guard_goes_by_the_same_slopes_for_any_number_of_threads(void **state)
{
    (void)state;
    static const unsigned workers[] = {2, 3, 7};
    for (size_t w = 0; w < sizeof workers / sizeof workers[0]; w++) {
        struct error err = {0};
        struct balloon b;
        struct sim sim;
        open_balloon(&b, 1, HINGES());
        assert_ok(sim_open(&sim, &b.scene, &b.mesh, workers[w], &err), &err);
        for (uint32_t t = 0; t < sim.triangle_count; t++) {
            assert_true(steepest(&sim, t, 0.95, false) == steepest(&b.sim, t, 0.95, false));
            assert_true(steepest(&sim, t, 0.6, true) == steepest(&b.sim, t, 0.6, true));
        }
        sim_clear(&sim);
        close_balloon(&b);
    }
}

/* The step's normals are added up on the way through the triangles that hinges need too: the same to the bit,
 * in whole fours and in others. */
static void normals_are_what_they_are_without_hinges(void **state)
{
    (void)state;
    static const char *const pressures[] = {"balloons[0].pressure_on=points",
                                            "balloons[0].pressure_on=areas"};
    static const char *const hinges[] = {"balloons[0].bending.stiffness=0", "balloons[0].bending.stiffness=2",
                                         "balloons[0].bending.damping=0.02"};
    for (int i = 0; i < 6; i++) {
        struct balloon b[2];
        for (int k = 0; k < 2; k++) {
            uint64_t random = 3;
            open_balloon(&b[k], 3, HINGES(pressures[i / 3], k == 0 ? hinges[0] : hinges[i % 3]));
            fill(b[k].sim.position, b[k].sim.point_count, 0.1, &random);
            for (uint32_t t = 7; t < b[k].sim.triangle_count; t += 29)
                b[k].sim.triangle_active[t] = 0;
            sim_forces(&b[k].sim);
        }
        assert_memory_equal(b[0].sim.normal, b[1].sim.normal, b[0].sim.point_count * sizeof *b[0].sim.normal);
        close_balloon(&b[0]);
        close_balloon(&b[1]);
    }
}

/* Crumpled, crushed and torn: what is compiled for this machine gives what is compiled for any gives. */
static void all_sets_of_instructions_give_the_same_bits(void **state)
{
    (void)state;
    extern const struct bending_kernels bending_plain;
    for (int k = 0; k < 2 * SHAPES; k++) {
        struct balloon b[2];
        uint64_t hash[2];
        for (int plain = 0; plain < 2; plain++) {
            open_balloon(&b[plain], 3, k < SHAPES ? HINGES() : HINGES("balloons[0].bending.damping=0.02"));
            deform(&b[plain].sim, shapes[k % SHAPES].factor, shapes[k % SHAPES].size);
            if (plain)
                b[plain].sim.balloons->bending->kernels = &bending_plain;
            steps(&b[plain], 3);
            hash[plain] = sim_hash(&b[plain].sim);
            close_balloon(&b[plain]);
        }
        assert_true(hash[0] == hash[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torn_hinges_are_equal_for_any_number_of_threads),
        cmocka_unit_test(the_guard_goes_by_the_same_slopes_for_any_number_of_threads),
        cmocka_unit_test(normals_are_what_they_are_without_hinges),
        cmocka_unit_test(all_sets_of_instructions_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
