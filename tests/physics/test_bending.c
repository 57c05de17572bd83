/* Hinges against the theory of thin plates and shells: tubes, spheres, rings that swing. */
#include "common/vec3.h"
#include "sim/ledger.h"
#include "unit/balloon.h"

#define STIFFNESS 2.0
#define HINGES(...)                                                                              \
    SETTINGS("balloons[0].radius=0", "balloons[0].pressure=0", "balloons[0].threshold=1e300",    \
             "balloons[0].spring=0", "balloons[0].damping=0", "balloons[0].bending.stiffness=2", \
             "time.integrator=symplectic-euler", "time.end=1e6" __VA_OPT__(, ) __VA_ARGS__)

/* A tube along z of radius 1: rings of `around` points, each turned by half a step against the
 * last, so that triangles are equilateral when it is unrolled. Turned: its triangles' sides run
 * along z instead of around. */
static void make_tube(struct mesh *mesh, uint32_t around, uint32_t along, bool turned)
{
    const double side = 2 * M_PI / around / (turned ? sqrt(3) / 2 : 1),
                 rise = side * (turned ? 0.5 : sqrt(3) / 2);
    if (mesh_init(mesh, (size_t)around * (along + 1), (size_t)2 * around * along, false, NULL))
        abort();
    for (uint32_t j = 0; j <= along; j++)
        for (uint32_t i = 0; i < around; i++) {
            const double angle = 2 * M_PI / around * (i + (turned ? 0 : j % 2 / 2.0));
            double *x = mesh->position[j * around + i];
            x[0] = cos(angle);
            x[1] = sin(angle);
            x[2] = turned ? side * (j + i % 2 / 2.0) : rise * j;
        }
    for (uint32_t j = 0, t = 0; j < along; j++)
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t a = j * around + i, b = j * around + (i + 1) % around, c = a + around,
                           d = b + around;
            const bool other = turned ? i % 2 == 0 : j % 2 == 1;
            const uint32_t first[2][3] = {{a, b, c}, {a, b, d}}, second[2][3] = {{b, d, c}, {a, d, c}};
            memcpy(mesh->triangle[t++], first[other], sizeof first[other]);
            memcpy(mesh->triangle[t++], second[other], sizeof second[other]);
        }
    if (mesh_connect(mesh, NULL))
        abort();
}

static void open_tube(struct balloon *b, uint32_t around, uint32_t along, bool turned,
                      const char *const *changes)
{
    struct error err = {0};
    open_balloon(b, 0, changes);
    sim_clear(&b->sim);
    mesh_clear(&b->mesh);
    make_tube(&b->mesh, around, along, turned);
    assert_ok(sim_open(&b->sim, &b->scene, &b->mesh, 1, &err), &err);
}

/* Energy of a tube whose skin is flat at rest, over k/2 curvature^2 area. Rims have no hinges: the difference
 * of two lengths has none. */
static double tube_energy(uint32_t around, bool turned)
{
    double energy[2], area[2];
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_tube(&b, around, i ? 8 : 4, turned, HINGES("balloons[0].bending.rest=flat"));
        energy[i] = effects_energy(&b.sim);
        area[i] = sim_measure(&b.sim).area;
        close_balloon(&b);
    }
    return (energy[1] - energy[0]) / (STIFFNESS / 2 * (area[1] - area[0]));
}

/* Bent around any side of its triangles or across, a sheet holds k/2 curvature^2 area; the angles are off by
 * the squares of the sides, (2 pi/around)^2 = 7 % and 2 %, most of which goes out in the sum: at least four
 * times less with half the sides. */
static void a_tube_holds_what_a_bent_plate_does(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        const double coarse = tube_energy(24, turned) - 1, fine = tube_energy(48, turned) - 1;
        print_message("# 24 around: %+.3f %%, 48: %+.3f %%, order %.2f\n", 100 * coarse, 100 * fine,
                      log2(coarse / fine));
        assert_near(coarse, 0, 0.005);
        assert_true(fabs(fine) < fabs(coarse) / 3.8 + 1e-9);
    }
}

/* A sphere, flat at rest: k/2 (1 + 1 - 2/3) 4 pi = 8/3 pi k, whatever its radius. An icosphere's triangles
 * are within some 10 % of equilateral, and their sum is right within the square of that. */
static void a_sphere_holds_the_same_at_any_size(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct balloon b;
        open_balloon(
            &b, 4,
            HINGES("balloons[0].bending.rest=flat", i ? "balloons[0].radius=1" : "balloons[0].radius=50"));
        const double energy = effects_energy(&b.sim) / (8 * M_PI / 3 * STIFFNESS) - 1;
        print_message("# %+.2f %%\n", 100 * energy);
        assert_near(energy, 0, 0.02);
        close_balloon(&b);
    }
}

/* A ring that nothing stretches swings as x = (1 + e cos 2a) does: w^2 = k n^2 (n^2 - 1)^2/((n^2 + 1) m), n =
 * 2, of a skin with the mass m an area and radius 1 (Rayleigh, Theory of Sound, 233). Springs 1000 times as
 * stiff keep its length. Of a tube with rims, hinges along z alone count: bent as a plate, but for the edges
 * that rims lack, which the area of the hinges leaves out too. */
static void a_ring_swings_as_rayleigh_says(void **state)
{
    (void)state;
    enum { AROUND = 48, ALONG = 8, N = 2 };
    struct balloon b;
    open_tube(&b, AROUND, ALONG, false,
              HINGES("balloons[0].spring=2e5", "balloons[0].point_mass=1", "time.guard=substep",
                     "time.step=0.002"));
    struct sim *sim = &b.sim;
    const double side = 2 * M_PI / AROUND,
                 cell = side * side * sqrt(3) / 2; /* area of a point, but at rims */
    for (uint32_t p = 0; p < sim->point_count; p++) {
        double *x = sim->position[p];
        const double a = atan2(x[1], x[0]), e = 1e-4;
        x[0] += e *
                (cos(N * a) * cos(a) + sin(N * a) / N * sin(a)); /* inextensional: tangential -sin(n a)/n */
        x[1] += e * (cos(N * a) * sin(a) - sin(N * a) / N * cos(a));
        if (fabs(x[2]) > side * (ALONG - 0.5) * sqrt(3) / 4)
            sim->mass[p] /= 2;
    }
    const double expected = 2 * M_PI /
                            sqrt(STIFFNESS * N * N * (N * N - 1) * (N * N - 1) / (N * N + 1.) / (1 / cell));
    double before = 1, crossings[3] = {0};
    int found = 0;
    while (found < 3) {
        steps(&b, 1);
        double swing = 0;
        for (uint32_t p = 0; p < sim->point_count; p++) {
            const double *x = sim->position[p];
            swing += hypot(x[0], x[1]) * cos(N * atan2(x[1], x[0]));
        }
        if (swing * before < 0)
            crossings[found++] = sim->time - sim->whole_step * swing / (swing - before);
        before = swing;
    }
    const double period = crossings[2] - crossings[0];
    print_message("# period %.5f, Rayleigh's %.5f: %+.2f %%\n", period, expected,
                  100 * (period / expected - 1));
    assert_near(period / expected, 1, 0.02);
    close_balloon(&b);
}

/* Nothing pushes, but much is held at the start: that it becomes motion is no divergence. */
static void a_ball_that_would_be_flat_moves_by_what_its_skin_holds(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 2,
                 SETTINGS("balloons[0].pressure=0", "balloons[0].threshold=1e300",
                          "balloons[0].bending.stiffness=300", "balloons[0].bending.rest=flat"));
    const double held = effects_energy(&b.sim);
    steps(&b, 40);
    const struct sim_measures m = sim_measure(&b.sim);
    assert_true(m.kinetic_energy > 0 && m.kinetic_energy + m.elastic_energy < held);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tube_holds_what_a_bent_plate_does),
        cmocka_unit_test(a_sphere_holds_the_same_at_any_size),
        cmocka_unit_test(a_ring_swings_as_rayleigh_says),
        cmocka_unit_test(a_ball_that_would_be_flat_moves_by_what_its_skin_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
