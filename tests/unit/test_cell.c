/* Every way in which the surface can pass through a cell. */
#include "check.h"
#include "surface/cell.h"

static struct cell_table table;

/* Calls check for each of the 256 masks with each way to join its ambiguous faces. */
static void for_each_case(void (*check)(unsigned inside, unsigned joined, const struct cell_loops *loops))
{
    cell_table_make(&table);
    for (unsigned inside = 0; inside < 256; inside++)
        for (unsigned joined = 0; joined < 64; joined++) {
            if (joined & ~(unsigned)table.ambiguous[inside])
                continue;
            struct cell_loops loops;
            cell_find_loops(&table, inside, joined, &loops);
            check(inside, joined, &loops);
        }
}

static bool is_crossed(unsigned inside, int edge)
{
    return (inside >> table.ends[edge][0] & 1) != (inside >> table.ends[edge][1] & 1);
}

static void check_cover(unsigned inside, unsigned joined, const struct cell_loops *loops)
{
    (void)joined;
    unsigned seen = 0;
    for (int i = 0; i < loops->count; i++) {
        assert_true(loops->length[i] >= 3);
        for (int k = 0; k < loops->length[i]; k++) {
            int edge = loops->edge[i][k], next = loops->edge[i][(k + 1) % loops->length[i]];
            assert_false(seen >> edge & 1);
            seen |= 1u << edge;
            assert_true(table.faces[edge] & table.faces[next]);
        }
    }
    for (int edge = 0; edge < CELL_EDGES; edge++)
        assert_int_equal(seen >> edge & 1, is_crossed(inside, edge));
}

static void loops_pass_each_crossed_edge_once_from_face_to_face(void **state)
{
    (void)state;
    for_each_case(check_cover);
}

/* The arcs of a cell on a face: successor of each edge along it, or -1. Arcs between the same two edges on
 * another face cannot be: two faces share only one edge. */
static void arcs_on_face(const struct cell_loops *loops, int face, int successor[CELL_EDGES])
{
    for (int edge = 0; edge < CELL_EDGES; edge++)
        successor[edge] = -1;
    for (int i = 0; i < loops->count; i++)
        for (int k = 0; k < loops->length[i]; k++) {
            int edge = loops->edge[i][k], next = loops->edge[i][(k + 1) % loops->length[i]];
            if (table.faces[edge] & table.faces[next] & 1 << face)
                successor[edge] = next;
        }
}

/* The neighbour across the upper face of an axis sees that face's corners as its lower ones; whatever its
 * other corners are. */
static void check_neighbours(unsigned inside, unsigned joined, const struct cell_loops *loops)
{
    for (int axis = 0; axis < 3; axis++) {
        int upper = 2 * axis + 1, lower = 2 * axis, mine[CELL_EDGES], theirs[CELL_EDGES];
        unsigned shared = 0;
        for (int corner = 0; corner < 8; corner++)
            if (!(corner >> axis & 1))
                shared |= (inside >> (corner | 1 << axis) & 1) << corner;
        struct cell_loops other;
        cell_find_loops(&table, shared, (joined >> upper & 1) << lower, &other);
        arcs_on_face(loops, upper, mine);
        arcs_on_face(&other, lower, theirs);
        for (int edge = 0; edge < CELL_EDGES; edge++) {
            if (mine[edge] < 0)
                continue;
            /* The same edges as the neighbour numbers them: on the lower side of the face's axis. */
            int from = -1, to = -1;
            for (int e = 0; e < CELL_EDGES; e++) {
                if (table.ends[e][0] == (table.ends[edge][0] ^ 1 << axis) && e / 4 == edge / 4)
                    from = e;
                if (table.ends[e][0] == (table.ends[mine[edge]][0] ^ 1 << axis) && e / 4 == mine[edge] / 4)
                    to = e;
            }
            assert_int_equal(theirs[to], from);
        }
    }
}

static void neighbours_run_along_the_arcs_of_a_face_in_opposite_senses(void **state)
{
    (void)state;
    for_each_case(check_neighbours);
}

static int chords_within_faces, loops_with_a_middle;

static void check_triangles(unsigned inside, unsigned joined, const struct cell_loops *loops)
{
    (void)inside;
    (void)joined;
    for (int i = 0; i < loops->count; i++) {
        double place[CELL_EDGES][3];
        uint8_t triangles[CELL_EDGES][3];
        int length = loops->length[i];
        for (int k = 0; k < length; k++)
            for (int axis = 0; axis < 3; axis++) {
                int edge = loops->edge[i][k], end = table.ends[edge][0] >> axis & 1;
                place[k][axis] = edge / 4 == axis ? 0.3 + 0.01 * edge : end;
            }
        int count = cell_triangulate(&table, loops->edge[i], length, place, triangles);
        loops_with_a_middle += count == 0;
        assert_true(count == length - 2 || (count == 0 && length >= 8));
        for (int t = 0; t < count; t++)
            for (int k = 0; k < 3; k++) {
                int p = triangles[t][k], q = triangles[t][(k + 1) % 3];
                bool arc = q == (p + 1) % length || p == (q + 1) % length;
                chords_within_faces += !arc &&
                                       (table.faces[loops->edge[i][p]] & table.faces[loops->edge[i][q]]);
            }
    }
}

static void no_triangle_has_a_side_within_a_face_other_than_an_arc(void **state)
{
    (void)state;
    for_each_case(check_triangles);
    assert_int_equal(chords_within_faces, 0);
    /* Counted over all cases by a separate exhaustive search: 96 of 9 arcs, 12 of 8, 8 of 12. */
    assert_int_equal(loops_with_a_middle, 116);
}

static void a_lone_corner_is_seen_counter_clockwise_from_outside(void **state)
{
    (void)state;
    struct cell_loops loops;
    cell_table_make(&table);
    cell_find_loops(&table, 1, 0, &loops);
    assert_int_equal(loops.count, 1);
    assert_int_equal(loops.length[0], 3);
    /* x, y, z edges from the corner: their crossings turn right-handed about (1, 1, 1). */
    assert_int_equal(loops.edge[0][0], 0);
    assert_int_equal(loops.edge[0][1], 4);
    assert_int_equal(loops.edge[0][2], 8);
}

static void the_middle_of_an_ambiguous_face_decides_what_belongs_together(void **state)
{
    (void)state;
    struct cell_loops loops;
    cell_table_make(&table);
    /* Corners (0,0,0) and (1,1,0): diagonal on the lower face across z, number 4. */
    cell_find_loops(&table, 1 | 8, 0, &loops);
    assert_int_equal(loops.count, 2);
    cell_find_loops(&table, 1 | 8, 1 << 4, &loops);
    assert_int_equal(loops.count, 1);
    assert_int_equal(loops.length[0], 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loops_pass_each_crossed_edge_once_from_face_to_face),
        cmocka_unit_test(neighbours_run_along_the_arcs_of_a_face_in_opposite_senses),
        cmocka_unit_test(no_triangle_has_a_side_within_a_face_other_than_an_arc),
        cmocka_unit_test(the_middle_of_an_ambiguous_face_decides_what_belongs_together),
        cmocka_unit_test(a_lone_corner_is_seen_counter_clockwise_from_outside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
