/* Points, edges and triangles out of a soup, and what they enclose. */
#include "common/mesh_files.h"
#include "common/random.h"
#include "solids.h"
#include "support/shapes.h"

static int compare_triples(const void *a, const void *b)
{
    const double *one = a, *other = b;
    for (int i = 0; i < 3; i++) {
        if (one[i] != other[i])
            return one[i] < other[i] ? -1 : 1;
    }
    return 0;
}

static int compare_rows(const void *a, const void *b)
{
    return memcmp(a, b, 9 * sizeof(double));
}

/* What a mesh is made of, free of numbering: its points; its edges and triangles as sorted rows of
 * positions. */
struct content {
    double (*points)[3];
    double (*edges)[9];
    double (*triangles)[9];
};

static struct content content_of(const struct mesh *mesh)
{
    struct content content = {
        calloc(mesh->point_count, sizeof *content.points),
        calloc(mesh->edge_count, sizeof *content.edges),
        calloc(mesh->triangle_count, sizeof *content.triangles),
    };
    memcpy(content.points, mesh->position, mesh->point_count * sizeof *mesh->position);
    qsort(content.points, mesh->point_count, sizeof *content.points, compare_triples);
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        for (int i = 0; i < 2; i++)
            memcpy(content.edges[e] + 3 * i, mesh->position[mesh->edge[e][i]], 3 * sizeof(double));
        qsort(content.edges[e], 2, 3 * sizeof(double), compare_triples);
    }
    qsort(content.edges, mesh->edge_count, sizeof *content.edges, compare_rows);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (int k = 0; k < 3; k++)
            memcpy(content.triangles[t] + 3 * k, mesh->position[mesh->triangle[t][k]], 3 * sizeof(double));
    }
    qsort(content.triangles, mesh->triangle_count, sizeof *content.triangles, compare_rows);
    return content;
}

static void content_clear(struct content *content)
{
    free(content->points);
    free(content->edges);
    free(content->triangles);
}

enum { GRID = 12 };

/* A wavy sheet of GRID x GRID squares, each cut in two; corner[6 GRID GRID]. */
static void sheet_soup(double (*corner)[3])
{
    static const int step[6][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 6 * GRID * GRID; i++) {
        int x = i / 6 % GRID + step[i % 6][0], y = i / 6 / GRID + step[i % 6][1];
        corner[i][0] = 0.1 * x - 0.5;
        corner[i][1] = 0.1 * y - 0.5;
        corner[i][2] = sin(x) * cos(y);
    }
}

static void a_soup_in_any_order_holds_the_same_points_edges_and_triangles(void **state)
{
    (void)state;
    enum { TRIANGLES = 2 * GRID * GRID };
    static double soup[3 * TRIANGLES][3];
    struct mesh straight = {0}, shuffled = {0};
    uint64_t seed = 7;
    sheet_soup(soup);
    assert_int_equal(mesh_from_soup((const double(*)[3])soup, TRIANGLES, &straight, NULL), STATUS_OK);
    assert_int_equal(mesh_connect(&straight, NULL), STATUS_OK);
    for (size_t t = TRIANGLES - 1; t > 0; t--) {
        double kept[3][3];
        size_t other = random_bits(&seed) % (t + 1);
        memcpy(kept, soup[3 * t], sizeof kept);
        memmove(soup[3 * t], soup[3 * other], sizeof kept);
        memcpy(soup[3 * other], kept, sizeof kept);
    }
    assert_int_equal(mesh_from_soup((const double(*)[3])soup, TRIANGLES, &shuffled, NULL), STATUS_OK);
    assert_int_equal(mesh_connect(&shuffled, NULL), STATUS_OK);

    assert_int_equal(straight.point_count, (GRID + 1) * (GRID + 1));
    assert_int_equal(straight.edge_count, 2 * GRID * (GRID + 1) + GRID * GRID);
    assert_int_equal(shuffled.point_count, straight.point_count);
    assert_int_equal(shuffled.edge_count, straight.edge_count);
    struct content a = content_of(&straight), b = content_of(&shuffled);
    assert_memory_equal(a.points, b.points, straight.point_count * sizeof *a.points);
    assert_memory_equal(a.edges, b.edges, straight.edge_count * sizeof *a.edges);
    assert_memory_equal(a.triangles, b.triangles, TRIANGLES * sizeof *a.triangles);
    content_clear(&a);
    content_clear(&b);
    mesh_clear(&straight);
    mesh_clear(&shuffled);
}

static void only_corners_at_exactly_the_same_place_are_one_point(void **state)
{
    (void)state;
    const double soup[6][3] = {{0.0, 0, 0},     {1, 0, 0},           {0, 1, 0},
                               {-0.0, 0, -0.0}, {1 + 0x1p-52, 0, 0}, {0, 1, 0}};
    struct mesh mesh = {0};
    assert_int_equal(mesh_from_soup(soup, 2, &mesh, NULL), STATUS_OK);
    const uint32_t wanted[2][3] = {{0, 1, 2}, {0, 3, 2}};
    assert_int_equal(mesh.point_count, 4);
    assert_memory_equal(mesh.triangle, wanted, sizeof wanted);
    mesh_clear(&mesh);
}

static void an_empty_soup_is_an_empty_mesh(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    assert_int_equal(mesh_from_soup(NULL, 0, &mesh, NULL), STATUS_OK);
    assert_int_equal(mesh_connect(&mesh, NULL), STATUS_OK);
    assert_int_equal(mesh.point_count + mesh.edge_count + mesh.triangle_count, 0);
    assert_near(mesh_area(&mesh), 0, 0);
    mesh_clear(&mesh);
}

static void edges_are_numbered_as_they_first_appear_with_the_smaller_point_first(void **state)
{
    (void)state;
    const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const uint32_t triangle[2][3] = {{3, 2, 1}, {0, 1, 2}};
    struct mesh mesh = mesh_of(position, 4, triangle, 2);
    assert_int_equal(mesh_connect(&mesh, NULL), STATUS_OK);
    const uint32_t edge[5][2] = {{2, 3}, {1, 2}, {1, 3}, {0, 1}, {0, 2}};
    const uint32_t triangle_edge[2][3] = {{0, 1, 2}, {3, 1, 4}};
    assert_int_equal(mesh.edge_count, 5);
    assert_memory_equal(mesh.edge, edge, sizeof edge);
    assert_memory_equal(mesh.triangle_edge, triangle_edge, sizeof triangle_edge);
    assert_memory_equal(mesh.triangle, triangle, sizeof triangle);
    mesh_clear(&mesh);
}

static void each_side_of_a_closed_mesh_has_its_own_edge(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    for (int i = 0; i < 5; i++)
        add_cube(&mesh, 3 * i, 0, 0);
    for (int again = 0; again < 2; again++) {
        assert_int_equal(mesh_connect(&mesh, NULL), STATUS_OK);
        assert_int_equal(mesh.edge_count, 5 * 18);
        for (uint32_t side = 0; side < 3 * mesh.triangle_count; side++) {
            const uint32_t *corner = mesh.triangle[side / 3];
            const uint32_t *edge = mesh.edge[mesh.triangle_edge[side / 3][side % 3]];
            uint32_t a = corner[side % 3], b = corner[(side % 3 + 1) % 3];
            assert_true((edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a));
            assert_true(edge[0] < edge[1]);
        }
    }
    mesh_clear(&mesh);
}

/* Searching point 0's edges one by one would take hours here. */
static void a_point_with_a_million_edges_is_no_harder(void **state)
{
    (void)state;
    enum { SPOKES = 1 << 20 };
    struct mesh mesh;
    assert_int_equal(mesh_init(&mesh, SPOKES + 1, SPOKES, false, NULL), STATUS_OK);
    for (uint32_t t = 0; t < SPOKES; t++) {
        mesh.triangle[t][0] = 0;
        mesh.triangle[t][1] = t + 1;
        mesh.triangle[t][2] = (t + 1) % SPOKES + 1;
    }
    assert_int_equal(mesh_connect(&mesh, NULL), STATUS_OK);
    assert_int_equal(mesh.edge_count, 2 * SPOKES);
    mesh_clear(&mesh);
}

static void a_corner_that_is_no_point_has_no_edges(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    mesh.triangle[7][1] = 8;
    assert_refused(mesh_connect(&mesh, &err), STATUS_INPUT, "triangle 7 has point 8; the last one is 7",
                   &err);
    mesh_clear(&mesh);
}

static void more_points_than_32_bits_count_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    assert_refused(mesh_init(&mesh, UINT32_MAX, 1, false, &err), STATUS_RANGE, "too large", &err);
    assert_refused(mesh_init(&mesh, 1, SIZE_MAX, true, &err), STATUS_RANGE, "too large", &err);
    assert_null(mesh.position);
}

/* The counts alone say so, before any memory is asked for. */
static void more_triangles_than_32_bits_count_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    struct triangle_list list = {.count = UINT32_MAX - 1, .capacity = UINT32_MAX};
    assert_refused(triangle_list_add(&list, 0, 1, 2, &err), STATUS_RANGE, "more than 4294967294 triangles",
                   &err);
    struct mesh mesh = {.point_count = 3, .triangle_count = UINT32_MAX / 3 + 1};
    assert_refused(mesh_connect(&mesh, &err), STATUS_RANGE,
                   "1431655766 triangles are too many to find their edges; at most 1431655765", &err);
    const double corner[3][3] = {{0}};
    assert_refused(mesh_from_soup(corner, UINT32_MAX, &mesh, &err), STATUS_RANGE,
                   "0 points and 4294967295 triangles is too large", &err);
}

static void a_cube_has_volume_one_and_area_six(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0, 0, 0);
    assert_near(mesh_volume(&mesh), 1, 1e-15);
    assert_near(mesh_area(&mesh), 6, 0);
    mesh_clear(&mesh);
}

/* The coordinates are exact, 2^20 and 2^20 + 1, but their mean, 8 sums of about 2^20, errs by up to 8 x
 * 2^20 x 2^-53 = 1e-9. What that shifts cancels in a closed mesh, but for rounding terms of some 36 x
 * 2^-53. From the origin each term would be 2^60, and their sum wrong by 2^7. */
static void volume_does_not_suffer_from_being_far_away(void **state)
{
    (void)state;
    struct mesh mesh = {0};
    add_cube(&mesh, 0x1p20, -0x1p20, 0x1p20);
    assert_near(mesh_volume(&mesh), 1, 1e-14);
    mesh_clear(&mesh);
}

/* Gives the points other numbers, at random. */
static void shuffle_points(struct mesh *mesh)
{
    uint64_t random = 5;
    for (uint32_t p = mesh->point_count - 1; p > 0; p--) {
        const uint32_t q = (uint32_t)(random_bits(&random) % (p + 1));
        for (int i = 0; i < 3; i++) {
            const double swap = mesh->position[p][i];
            mesh->position[p][i] = mesh->position[q][i];
            mesh->position[q][i] = swap;
        }
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                uint32_t *corner = &mesh->triangle[t][k];
                *corner = *corner == p ? q : *corner == q ? p : *corner;
            }
    }
}

static void neighbours_get_near_numbers_and_the_shape_stays(void **state)
{
    (void)state;
    struct error err = {0};
    struct mesh mesh = {0};
    shape_icosphere(3, &mesh);
    const double volume = mesh_volume(&mesh), area = mesh_area(&mesh);
    shuffle_points(&mesh);
    assert_ok(mesh_connect(&mesh, &err), &err);
    assert_ok(mesh_order(&mesh, &err), &err);
    assert_near(mesh_volume(&mesh), volume, 1e-12);
    assert_near(mesh_area(&mesh), area, 1e-12);
    /* A front of the walk is at most about as long as the equator, 40 points here (642 points lie 12 to a
     * unit of angle), and an edge joins a front to the next: at random the mean would be 214. */
    for (uint32_t e = 0; e < mesh.edge_count; e++)
        assert_true(mesh.edge[e][1] - mesh.edge[e][0] < 100);
    for (uint32_t t = 1; t < mesh.triangle_count; t++) {
        const uint32_t *a = mesh.triangle[t - 1], *b = mesh.triangle[t];
        assert_true(fmin(fmin(a[0], a[1]), a[2]) <= fmin(fmin(b[0], b[1]), b[2]));
    }
    mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_soup_in_any_order_holds_the_same_points_edges_and_triangles),
        cmocka_unit_test(only_corners_at_exactly_the_same_place_are_one_point),
        cmocka_unit_test(an_empty_soup_is_an_empty_mesh),
        cmocka_unit_test(edges_are_numbered_as_they_first_appear_with_the_smaller_point_first),
        cmocka_unit_test(each_side_of_a_closed_mesh_has_its_own_edge),
        cmocka_unit_test(a_point_with_a_million_edges_is_no_harder),
        cmocka_unit_test(a_corner_that_is_no_point_has_no_edges),
        cmocka_unit_test(more_points_than_32_bits_count_are_refused),
        cmocka_unit_test(more_triangles_than_32_bits_count_are_refused),
        cmocka_unit_test(neighbours_get_near_numbers_and_the_shape_stays),
        cmocka_unit_test(a_cube_has_volume_one_and_area_six),
        cmocka_unit_test(volume_does_not_suffer_from_being_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
