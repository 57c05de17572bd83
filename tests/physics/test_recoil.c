/*
 * A band that is stretched, held at both ends, and cut off one of them: it flies back, unloaded behind a
 * shock that runs into it.
 *
 * Units: shear modulus, density and thickness are 1, lengths are the band's at rest. At the stretch L it
 * pulls with the nominal stress s = L - L^-2. A shock at the speed c, in lengths at rest, leaves rubber at
 * rest in itself behind that moves at v: its momentum grows by s = c v, and its stretch changes from L to 1
 * by c (L - 1) = v. So v = sqrt((L - L^-2) (L - 1)).
 */
#include "common/vec3.h"
#include "sim/topology.h"
#include "unit/balloon.h"

/* One cell high: a square of two triangles each, diagonals in turn. */
static void make_band(struct mesh *mesh, uint32_t cells)
{
    if (mesh_init(mesh, 2 * (size_t)(cells + 1), 2 * (size_t)cells, false, NULL))
        abort();
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        mesh->position[p][0] = (double)(p / 2) / cells;
        mesh->position[p][1] = (double)(p % 2) / cells;
        mesh->position[p][2] = 0;
    }
    for (uint32_t i = 0; i < cells; i++) {
        const uint32_t a = 2 * i, b = a + 2, c = a + 3, d = a + 1;
        const uint32_t one[2][3] = {{a, b, c}, {a, c, d}}, other[2][3] = {{a, b, d}, {b, c, d}};
        memcpy(mesh->triangle[2 * i], i % 2 ? one : other, sizeof one);
    }
    if (mesh_connect(mesh, NULL))
        abort();
}

static void set(struct balloon *b, const char *key, double value)
{
    char text[96];
    struct error err = {0};
    snprintf(text, sizeof text, "%s=%.17g", key, value);
    assert_ok(scene_set(&b->scene, text, &err), &err);
}

/* A dashpot of .05 of a cell's impedance and a step well below the cell's own: both shrink with the cells. */
static void open_band(struct balloon *b, uint32_t cells)
{
    struct error err = {0};
    open_balloon(b, 0,
                 SETTINGS("balloons[0].radius=0", "balloons[0].pressure=0", "balloons[0].threshold=1e300",
                          "balloons[0].membrane.shear_modulus=1", "balloons[0].membrane.thickness=1",
                          "balloons[0].membrane.density=1", "time.guard=off", "time.end=1e6",
                          "time.integrator=symplectic-euler", "balloons[0].fracture.mode=tear",
                          "balloons[0].fracture.strength=100", "balloons[0].fracture.toughness=1e6"));
    sim_clear(&b->sim);
    mesh_clear(&b->mesh);
    set(b, "balloons[0].membrane.viscosity", 0.3 / cells);
    set(b, "time.step", 0.02 / cells);
    make_band(&b->mesh, cells);
    assert_ok(sim_open(&b->sim, &b->scene, &b->mesh, 1, &err), &err);
}

/* Pulled along x alone, so that it is narrower across by L^-1/2, and held at its first end. The
 * band's middle is at 0. */
static void stretch(struct balloon *b, double by)
{
    struct sim *sim = &b->sim;
    for (uint32_t p = 0; p < sim->balloons->point_end; p++) {
        if (sim->position[p][0] < -0.5 + 1e-9)
            sim->mass[p] = 1e12;
        sim->position[p][0] *= by;
        sim->position[p][1] /= sqrt(by);
    }
}

/* Cuts off the last cell, which holds the other end: along the edge across, at x at rest. */
static void cut(struct balloon *b, double x)
{
    struct sim *sim = &b->sim;
    const struct topology *top = sim->balloons->topology;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *p = sim->triangle_point[t];
            if (top->neighbour[t][k] != MESH_NONE && fabs(top->rest[p[k]][0] - x) < 1e-9 &&
                fabs(top->rest[p[(k + 1) % 3]][0] - x) < 1e-9)
                topology_cut(sim, sim->balloons, t, k);
        }
}

/* Where the loose end is: the points of the cut that the band has kept, those of
 * triangles to the left of it. */
static double loose_end(const struct balloon *b, double x)
{
    const struct sim *sim = &b->sim;
    const struct topology *top = sim->balloons->topology;
    double sum = 0;
    int count = 0;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *p = sim->triangle_point[t];
            const bool left = top->rest[p[0]][0] + top->rest[p[1]][0] + top->rest[p[2]][0] < 3 * x;
            if (!left || fabs(top->rest[p[k]][0] - x) > 1e-9)
                continue;
            sum += sim->position[p[k]][0];
            count++;
        }
    return sum / count;
}

static void run_until(struct balloon *b, double time)
{
    while (b->sim.time < time)
        steps(b, 1);
}

/* Speed of the loose end while the shock is in the band's middle, over what theory says. */
static double recoil(uint32_t cells, double by)
{
    struct balloon b;
    const double stress = by - 1 / (by * by), speed = sqrt(stress * (by - 1)), x = 0.5 - 1.0 / cells;
    const double crossing = (by - 1) / speed; /* of the band, by the shock */
    open_band(&b, cells);
    stretch(&b, by);
    cut(&b, x);
    assert_int_equal(b.sim.balloons->topology->now.edges, 1);
    run_until(&b, 0.3 * crossing);
    const double from = loose_end(&b, x), begun = b.sim.time;
    run_until(&b, 0.7 * crossing);
    const double ratio = (from - loose_end(&b, x)) / (b.sim.time - begun) / speed;
    close_balloon(&b);
    return ratio;
}

static void a_cut_band_recoils_at_the_speed_of_its_unloading_shock(void **state)
{
    (void)state;
    static const double stretches[] = {1.3, 2, 3, 4};
    for (int i = 0; i < 4; i++) {
        double error[3];
        for (int k = 0; k < 3; k++)
            error[k] = recoil(50u << k, stretches[i]) - 1;
        print_message("# L %.1f: %+.2f, %+.2f, %+.2f %% with 50, 100, 200 cells\n", stretches[i],
                      100 * error[0], 100 * error[1], 100 * error[2]);
        assert_near(error[2], 0, 0.02);
        assert_true(fabs(error[2]) < fabs(error[1]) && fabs(error[1]) < fabs(error[0]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cut_band_recoils_at_the_speed_of_its_unloading_shock),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
