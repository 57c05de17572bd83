/* The table of pieces: what it says of each, and that its sums are the state's. */
#include "balloon.h"
#include "burst/inflated.h"
#include "folder.h"
#include "sim/piece_table.h"

static struct piece_table table_of(struct sim *sim)
{
    struct piece_table table = {0};
    struct error err = {0};
    assert_ok(piece_table_make(sim, &table, &err), &err);
    return table;
}

/* v = V + w x (x - c) */
static void set_moving(struct sim *sim, const double velocity[3], const double spin[3],
                       const double centre[3])
{
    for (uint32_t p = 0; p < sim->balloons->point_end; p++) {
        double arm[3], turning[3];
        vec3_sub(sim->position[p], centre, arm);
        vec3_cross(spin, arm, turning);
        for (int i = 0; i < 3; i++)
            sim->velocity[p][i] = velocity[i] + turning[i];
    }
}

/* Some 10^4 terms are added up, each rounded to 2^-53 of at most the largest: 1e-12 of it. */
static void a_whole_balloon_is_one_piece_and_moves_as_it_was_told(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 3, SETTINGS("balloons[0].position=[7, -3, 100]"));
    struct sim *sim = &b.sim;
    for (uint32_t p = 0; p < sim->point_count; p++)
        sim->position[p][0] *= 1.5; /* three different moments of inertia */
    const double velocity[3] = {3, -2, 1}, spin[3] = {0.3, 0.2, -0.7};
    struct piece_table table = table_of(sim);
    assert_int_equal(table.count, 1);
    const struct piece first = table.items[0];
    piece_table_clear(&table);
    set_moving(sim, velocity, spin, first.centre);
    table = table_of(sim);
    const struct piece *piece = table.items;
    const struct sim_measures m = sim_measure(sim);
    assert_int_equal(piece->number, 0);
    assert_int_equal(piece->triangles, sim->triangle_count);
    assert_near(piece->area, m.area, 1e-12 * m.area);
    assert_near(piece->mass, 0.11 * sim->point_count, 1e-12 * piece->mass);
    assert_near(piece->centre[2], 100, 1e-10);
    for (int i = 0; i < 3; i++) {
        assert_near(piece->velocity[i], velocity[i], 1e-11);
        assert_near(piece->spin[i], spin[i], 1e-12);
    }
    piece_table_clear(&table);
    close_balloon(&b);
}

/* Around the line that it lies on nothing turns, and across it all does. */
static void what_lies_on_a_line_spins_across_it_only(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=0"));
    for (uint32_t p = 0; p < b.sim.point_count; p++)
        b.sim.position[p][1] = b.sim.position[p][2] = 0;
    struct piece_table table = table_of(&b.sim);
    const struct piece first = table.items[0];
    piece_table_clear(&table);
    set_moving(&b.sim, (const double[3]){0}, (const double[3]){5, 2, 3}, first.centre);
    table = table_of(&b.sim);
    assert_near(table.items[0].spin[0], 0, 1e-12);
    assert_near(table.items[0].spin[1], 2, 1e-12);
    assert_near(table.items[0].spin[2], 3, 1e-12);
    piece_table_clear(&table);
    close_balloon(&b);
}

struct totals {
    uint32_t triangles;
    double rest_area, area, mass, momentum[3];
};

static struct totals add_up(const struct piece_table *table)
{
    struct totals sum = {0};
    for (uint32_t i = 0; i < table->count; i++) {
        const struct piece *piece = &table->items[i];
        sum.triangles += piece->triangles;
        sum.rest_area += piece->rest_area;
        sum.area += piece->area;
        sum.mass += piece->mass;
        for (int k = 0; k < 3; k++)
            sum.momentum[k] += piece->mass * piece->velocity[k];
        assert_true(i == 0 || piece->rest_area <= piece[-1].rest_area);
        assert_true(i == 0 || piece->number != piece[-1].number);
    }
    return sum;
}

/* Over the points that carry skin: all of them where the skin tears. Rounding as above. */
static void check_totals(struct sim *sim)
{
    struct piece_table table = table_of(sim);
    const struct totals sum = add_up(&table);
    const struct sim_measures m = sim_measure(sim);
    unsigned char *carries = calloc(sim->point_count, 1);
    double mass = 0, momentum[3] = {0}, most = 0;
    for (uint32_t t = 0; t < sim->triangle_count; t++)
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            carries[sim->triangle_point[t][k]] = 1;
    for (uint32_t p = 0; p < sim->point_count; p++)
        for (int i = 0; i < 3 && carries[p]; i++) {
            mass += i == 0 ? sim->mass[p] : 0;
            momentum[i] += sim->mass[p] * sim->velocity[p][i];
            most += sim->mass[p] * fabs(sim->velocity[p][i]);
        }
    assert_int_equal(table.count, m.pieces);
    assert_int_equal(sum.triangles, m.triangles_active);
    assert_near(sum.area, m.area, 1e-12 * m.area);
    assert_near(sum.mass, mass, 1e-12 * mass);
    for (int i = 0; i < 3; i++)
        assert_near(sum.momentum[i], momentum[i], 1e-12 * most);
    free(carries);
    piece_table_clear(&table);
}

static void torn_skin_adds_up_to_all_that_there_is(void **state)
{
    (void)state;
    struct inflated it;
    inflate(&it, &(struct inflation){.level = 4, .stretch = 2.2});
    prick(&it);
    run_until(&it, 2.5);
    struct piece_table table = table_of(&it.sim);
    const struct totals sum = add_up(&table);
    assert_true(table.count > 4);
    assert_int_equal(sum.triangles, it.sim.triangle_count);
    const double area = it.balloon->topology->area;
    assert_near(sum.rest_area, area, 1e-12 * area);
    assert_near(sum.mass, area, 1e-12 * area); /* density and thickness are 1 */
    piece_table_clear(&table);
    check_totals(&it.sim);
    deflate(&it);
}

static void the_papers_pieces_share_the_points_that_they_touch_at(void **state)
{
    (void)state;
    struct balloon b;
    open_balloon(&b, 4, SETTINGS("balloons[0].threshold=1.3"));
    while (b.sim.time < 1)
        steps(&b, 1);
    struct piece_table table = table_of(&b.sim);
    assert_true(table.count > 4 && b.sim.broken > 100);
    piece_table_clear(&table);
    check_totals(&b.sim);
    close_balloon(&b);
}

static void the_file_has_a_line_a_piece(void **state)
{
    (void)state;
    struct balloon b;
    struct error err = {0};
    open_balloon(&b, 1, SETTINGS("balloons[0].pressure=0"));
    struct piece_table table = table_of(&b.sim);
    assert_ok(piece_table_save(&table, "pieces.tsv", &err), &err);
    FILE *file = fopen("pieces.tsv", "r");
    char line[512];
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line,
                        "piece\tballoon\ttriangles\trest_area\tarea\tmass\tcentre_x\tcentre_y\tcentre_z\t"
                        "velocity_x\tvelocity_y\tvelocity_z\tspin_x\tspin_y\tspin_z\n");
    assert_non_null(fgets(line, sizeof line, file));
    assert_memory_equal(line, "0\t0\t80\t", 7);
    assert_null(fgets(line, sizeof line, file));
    fclose(file);
    assert_refused(piece_table_save(&table, "no/such/pieces.tsv", &err), STATUS_FILE, "cannot create", &err);
    piece_table_clear(&table);
    close_balloon(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_balloon_is_one_piece_and_moves_as_it_was_told),
        cmocka_unit_test(what_lies_on_a_line_spins_across_it_only),
        cmocka_unit_test(torn_skin_adds_up_to_all_that_there_is),
        cmocka_unit_test(the_papers_pieces_share_the_points_that_they_touch_at),
        cmocka_unit_test(the_file_has_a_line_a_piece),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
