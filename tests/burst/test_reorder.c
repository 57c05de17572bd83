/* New points of torn skin come to their places among the old ones, and nothing else changes. */
#include "burst/ordered.h"
#include "sim/guard_bound.h"
#include "sim/jacobian.h"
#include "sim/skin_mesh.h"

#include <string.h>

typedef double (*rows)[4];

/* A copy of one row a point, by names. */
static rows by_name(const struct inflated *it, double (*of)[4])
{
    const uint32_t count = it->balloon->point_end;
    rows copy = malloc(count * sizeof *copy);
    for (uint32_t name = 0; name < count; name++)
        memcpy(copy[name], of[reorder_point(it->balloon, name)], sizeof *copy);
    return copy;
}

/* K dx + D dv along the speeds, by names. */
static rows product_by_name(struct inflated *it)
{
    struct error err = {0};
    rows df = sim_table(&it->sim, it->sim.point_count, sizeof *df);
    assert_ok(sim_jacobian_open(&it->sim, &err), &err);
    sim_linearise(&it->sim);
    sim_force_product(&it->sim, 1, it->sim.velocity, 1, it->sim.velocity, df);
    sim_jacobian_close(&it->sim);
    rows copy = by_name(it, df);
    free(df);
    return copy;
}

static double largest(rows x, uint32_t count)
{
    double most = 0;
    for (uint32_t p = 0; p < count; p++)
        for (int i = 0; i < 3; i++)
            most = fmax(most, fabs(x[p][i]));
    return most;
}

static void disturb(struct inflated *it)
{
    struct error err = {0};
    give_speeds(it);
    for (int i = 0; i < 3; i++)
        assert_ok(sim_step(&it->sim, &err), &err);
    tear(it, 11, 300);
    sim_forces(&it->sim);
}

/* Some twenty numbers of the forces' size are added up at each point, in another order: a few 2^-53 of
 * them; 1e-12 is what cancels among them with room to spare. */
static const double rounding = 1e-12;

static void forces_and_their_derivatives_stay_the_same(void **unused)
{
    (void)unused;
    static const struct inflation *const scenes[] = {&all_of_rubber, &all_of_springs};
    for (int s = 0; s < 2; s++) {
        struct inflated it;
        inflate(&it, scenes[s]);
        disturb(&it);
        const uint32_t count = it.balloon->point_end;
        rows x = by_name(&it, it.sim.position), v = by_name(&it, it.sim.velocity),
             f = by_name(&it, it.sim.force), df = product_by_name(&it);
        const double size = largest(f, count), slope = largest(df, count);
        put_in_order(&it);
        assert_true(it.balloon->topology->now.points > 100);
        sim_forces(&it.sim);
        rows x_then = by_name(&it, it.sim.position), v_then = by_name(&it, it.sim.velocity),
             f_then = by_name(&it, it.sim.force), df_then = product_by_name(&it);
        assert_memory_equal(x, x_then, count * sizeof *x);
        assert_memory_equal(v, v_then, count * sizeof *v);
        for (uint32_t p = 0; p < count; p++)
            for (int i = 0; i < 3; i++) {
                assert_near(f_then[p][i], f[p][i], rounding * size);
                assert_near(df_then[p][i], df[p][i], rounding * slope);
            }
        rows all[] = {x, v, f, df, x_then, v_then, f_then, df_then};
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
            free(all[i]);
        deflate(&it);
    }
}

/* Of one balloon: blocks with a row a point, whatever keeps them, but for what goes by names itself. */
static bool is_of_points(const struct inflated *it, const struct sim_block *block)
{
    return block->size > 0 && block->size % it->sim.point_count == 0 && strcmp(block->name, "names") &&
           strcmp(block->name, "families") && strcmp(block->name, "tips");
}

static void all_that_is_kept_of_points_goes_along(void **unused)
{
    (void)unused;
    static const struct inflation *const scenes[] = {&all_of_rubber, &all_of_springs, &touching};
    for (int s = 0; s < 3; s++) {
        struct inflated it;
        struct kept kept;
        size_t count, compared = 0;
        inflate(&it, scenes[s]);
        disturb(&it);
        let_wait(&it);
        steps(&it, 1);
        const uint32_t points = it.balloon->point_end,
                       tightest = reorder_name(it.balloon, it.sim.guard->memory.point);
        keep(&it, &kept);
        put_in_order(&it);
        const struct sim_block *blocks = sim_blocks(&it.sim, &count);
        for (size_t i = 0; i < count; i++) {
            const size_t size = blocks[i].size / it.sim.point_count;
            for (uint32_t p = 0; p < points && is_of_points(&it, &blocks[i]); p++, compared++)
                if (memcmp((char *)blocks[i].data + size * reorder_point(it.balloon, p),
                           (char *)kept.block[i].data + size * p, size))
                    fail_msg("%s: the row of point %u is another", blocks[i].name, p);
        }
        assert_true(compared >= 8 * points);
        assert_int_equal(reorder_name(it.balloon, it.sim.guard->memory.point), tightest);
        forget(&kept);
        deflate(&it);
    }
}

/* By the methods that can follow a tear. Of the places' 1, rounding is 1e-16; ten steps make no more of it
 * than the adaptive method's tolerance. */
static void every_method_goes_on_as_it_would_have(void **unused)
{
    (void)unused;
    static const char *const methods[] = {
        "symplectic-euler", "explicit-euler",    "verlet", "rk4", "rkn4", "rk-adaptive", "auto",
        "backward-euler",   "implicit-midpoint", "bdf2"};
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
        struct inflated it, other;
        char method[64];
        snprintf(method, sizeof method, "time.integrator=%s", methods[m]);
        const struct inflation how = {.level = 3,
                                      .stretch = 1.5,
                                      .springs = true,
                                      .step = 0.2,
                                      .keys = {method, "time.tolerance=1e-9"}};
        inflate(&it, &how);
        inflate(&other, &how);
        cut_anywhere(&it, 11, 100);
        cut_anywhere(&other, 11, 100);
        let_wait(&it);
        let_wait(&other);
        steps(&it, 5);
        steps(&other, 5);
        put_in_order(&it);
        other.sim.changed = true;
        steps(&it, 5);
        steps(&other, 5);
        assert_near(it.sim.time, other.sim.time, 1e-6 * other.sim.time);
        rows x = by_name(&it, it.sim.position), y = by_name(&other, other.sim.position);
        double off = 0;
        for (uint32_t p = 0; p < it.balloon->point_end; p++)
            off = fmax(off, vec3_distance(x[p], y[p]));
        if (!(off < 1e-9))
            fail_msg("%s: a point is %g off", methods[m], off);
        free(x);
        free(y);
        deflate(&it);
        deflate(&other);
    }
}

/* So that they take no longer over it. */
static void parts_work_on_it_as_on_whole_skin(void **unused)
{
    (void)unused;
    struct inflated it, whole;
    const struct inflation how = {.level = 5, .stretch = 1.5, .springs = true, .workers = 2};
    inflate(&it, &how);
    inflate(&whole, &how);
    cut_anywhere(&it, 11, 500);
    put_in_order(&it);
    const struct sim_part *tail = it.balloon->topology->tail;
    assert_int_equal(tail - it.sim.parts, 2);
    assert_int_equal(tail->point_end - tail->point_begin + tail->edge_in_count + tail->triangle_in_count, 0);
    for (int i = 0; i < 2; i++) {
        const struct sim_part *part = &it.sim.parts[i], *like = &whole.sim.parts[i];
        assert_int_equal(part->triangle_in_count, like->triangle_in_count);
        assert_int_equal(part->chunk_count, like->chunk_count);
        for (uint32_t c = 0; c < part->chunk_count; c++) {
            assert_int_equal(part->chunks[c].edge_inner_end, like->chunks[c].edge_inner_end);
            assert_int_equal(part->chunks[c].triangle_inner_end, like->chunks[c].triangle_inner_end);
        }
    }
    deflate(&it);
    deflate(&whole);
}

static bool was_told(const struct sim *sim, const char *begin)
{
    for (size_t i = 0; i < sim->news_count; i++)
        if (!strcmp(sim->news[i].effect, "reordering") && !strncmp(sim->news[i].text, begin, strlen(begin)))
            return true;
    return false;
}

static void it_wakes_with_a_tear_and_sleeps_when_all_are_in_their_places(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.3});
    const struct topology_counts *now = &it.balloon->topology->now;
    steps(&it, 3);
    assert_false(now->awake || was_told(&it.sim, ""));
    prick(&it);
    steps(&it, 1);
    assert_true(now->awake && was_told(&it.sim, "wakes"));
    it.sim.news_count = 0;
    while (now->awake && it.sim.time < 20) /* it takes a wave 1 to go a radius */
        steps(&it, 1);
    assert_false(now->awake);
    assert_true(!was_told(&it.sim, "wakes") && was_told(&it.sim, "sleeps") && now->orders > 0 &&
                now->settled == now->points);
    assert_int_equal(now->late_triangles + now->late_edges + now->slowed, 0);
    deflate(&it);
}

static void files_have_the_points_in_the_order_in_which_they_were_made(void **unused)
{
    (void)unused;
    struct inflated it;
    struct error err = {0};
    struct skin_mesh before = {0}, after = {0};
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5});
    cut_anywhere(&it, 11, 200);
    assert_ok(skin_mesh_init(&before, &it.sim, false, &err), &err);
    assert_ok(skin_mesh_init(&after, &it.sim, false, &err), &err);
    skin_mesh_take(&before);
    put_in_order(&it);
    skin_mesh_take(&after);
    assert_int_equal(after.mesh.point_count, before.mesh.point_count);
    assert_memory_equal(after.mesh.position, before.mesh.position,
                        before.mesh.point_count * sizeof *before.mesh.position);
    assert_memory_equal(after.mesh.triangle, before.mesh.triangle,
                        before.mesh.triangle_count * sizeof *before.mesh.triangle);
    skin_mesh_clear(&before);
    skin_mesh_clear(&after);
    struct mesh skin = {0};
    assert_ok(sim_skin(&it.sim, &skin, &err), &err);
    for (uint32_t t = 0; t < it.sim.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            assert_memory_equal(skin.position[skin.triangle[t][k]],
                                it.sim.position[it.sim.triangle_point[t][k]], sizeof *skin.position);
    mesh_clear(&skin);
    deflate(&it);
}

/* A rip opens where the scene has it, also if that is at a point whose number has moved up past those that
 * there were before anything tore. */
static void a_rip_knows_the_points_that_have_moved_up(void **unused)
{
    (void)unused;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 3, .stretch = 1.5, .keys = {"balloons[0].rip.length=0.3"}});
    cut_anywhere(&it, 11, 200);
    put_in_order(&it);
    uint32_t point = it.balloon->point_end - 1;
    while (fracture_is_rim(&it.sim, it.balloon, point))
        point--;
    assert_true(point >= it.balloon->topology->old_points);
    memcpy(it.scene.balloons[0].rip.place, crack_rest(it.balloon, point), 3 * sizeof(double));
    assert_true(fracture_rip(&it.sim, it.balloon) > 0);
    assert_true(fracture_is_rim(&it.sim, it.balloon, point));
    deflate(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_and_their_derivatives_stay_the_same),
        cmocka_unit_test(all_that_is_kept_of_points_goes_along),
        cmocka_unit_test(every_method_goes_on_as_it_would_have),
        cmocka_unit_test(parts_work_on_it_as_on_whole_skin),
        cmocka_unit_test(it_wakes_with_a_tear_and_sleeps_when_all_are_in_their_places),
        cmocka_unit_test(files_have_the_points_in_the_order_in_which_they_were_made),
        cmocka_unit_test(a_rip_knows_the_points_that_have_moved_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
