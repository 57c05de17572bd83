/* What contact looks at: nothing that comes near is left out, and no meeting on the way is missed. */
#include "common/vec3.h"
#include "crossings.h"
#include "sim/contact_approach.h"
#include "sim/contact_links.h"
#include "two_skins.h"

static bool is_listed(const struct contact *c, enum ccd_kind kind, const uint32_t p[4])
{
    bool listed = false;
    struct contact_links links = contact_links_of(c, p[0]);
    for (uint32_t at; (at = contact_links_next(&links)) != UINT32_MAX;)
        listed |= c->pairs[at / 4].kind == kind && isfinite(c->pairs[at / 4].distance) &&
                  memcmp(c->pairs[at / 4].point, p, 4 * sizeof *p) == 0;
    return listed;
}

/* Points that an edge joins. */
static unsigned char *find_joined(const struct sim *sim)
{
    unsigned char *joined = calloc((size_t)sim->point_count * sim->point_count, 1);
    for (uint32_t e = 0; e < sim->edge_count; e++) {
        const uint32_t *p = sim->edge_point[e];
        joined[p[0] * sim->point_count + p[1]] = joined[p[1] * sim->point_count + p[0]] = 1;
    }
    for (uint32_t p = 0; p < sim->point_count; p++)
        joined[p * sim->point_count + p] = 1;
    return joined;
}

/* Whether two features end the step nearer to each other than skins are to come. Not those that share a point
 * or that an edge joins: they may be of a patch that looks to one side, and nothing more is asked of it. */
static bool is_near(const struct sim *sim, const unsigned char *joined, enum ccd_kind kind,
                    const uint32_t p[4])
{
    const int first = kind == CCD_EDGES ? 2 : 1;
    struct ccd_touch touch;
    double x[4][3];
    for (int i = 0; i < first; i++)
        for (int j = first; j < 4; j++)
            if (joined[p[i] * sim->point_count + p[j]])
                return false;
    contact_gather(sim->position, p, x);
    for (int k = 0; k < 3; k++) /* further than an edge is long, as nearly all are */
        if (fabs(x[0][k] - x[3][k]) > 20)
            return false;
    return ccd_distance(kind, x, &touch) < sim->contact->thickness;
}

/* Of all pairs that there are, those that are near and not on the list; near ones are counted. */
static size_t near_and_unlisted(struct sim *sim, size_t *near)
{
    const struct contact *c = sim->contact;
    size_t missing = 0;
    unsigned char *joined = find_joined(sim);
    contact_links_make(sim);
    for (uint32_t q = 0; q < sim->point_count; q++)
        for (uint32_t t = 0; t < sim->triangle_count; t++) {
            const uint32_t *k = sim->triangle_point[t], p[4] = {q, k[0], k[1], k[2]};
            const bool is = is_near(sim, joined, CCD_POINT_TRIANGLE, p);
            *near += is;
            missing += is && !is_listed(c, CCD_POINT_TRIANGLE, p);
        }
    for (uint32_t e = 0; e < sim->edge_count; e++)
        for (uint32_t g = e + 1; g < sim->edge_count; g++) {
            const uint32_t *a = sim->edge_point[e], *b = sim->edge_point[g], p[4] = {a[0], a[1], b[0], b[1]};
            const bool is = is_near(sim, joined, CCD_EDGES, p);
            *near += is;
            missing += is && !is_listed(c, CCD_EDGES, p);
        }
    free(joined);
    return missing;
}

/* Whatever lists, lines, strays and boxes say: all that is near is on the list, at the end of every step,
 * while lists are made and mended. */
static void test_the_list_has_all_that_is_near(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    size_t near = 0;
    uint64_t mended = 0;
    open_scene(&s, 3, 1, FOLDING);
    swirl(&s.sim, 3);
    for (int i = 0; i < 200; i++) {
        assert_ok(sim_step(&s.sim, &err), &err);
        mended += s.sim.contact->memory.again > 0;
        if (i % 10 == 9)
            assert_int_equal(near_and_unlisted(&s.sim, &near), 0);
    }
    assert_true(near > 100 && mended > 10);
    close_scene(&s);
}

/* Where more comes near than there is room for, nothing goes by the part of it that there was room for. */
static void test_a_list_that_is_full_is_refused(void **state)
{
    (void)state;
    struct scene_of_two s;
    struct error err = {0};
    open_scene(&s, 3, 1, FOLDING);
    swirl(&s.sim, 3);
    struct contact *c = s.sim.contact;
    enum status status = STATUS_OK;
    c->pair_capacity = c->pair_most = 200;
    for (int i = 0; i < 200 && !status; i++) {
        status = sim_step(&s.sim, &err);
        assert_true(c->pair_count <= 200);
    }
    assert_int_equal(status, STATUS_RANGE);
    assert_non_null(strstr(err.text, "are near each other, and there is room for 200"));
    close_scene(&s);
}

/* As shreds that are flung together ask for. Nothing depends on when. */
static void test_a_list_that_is_full_is_made_longer(void **state)
{
    (void)state;
    struct error err = {0};
    uint64_t hash[2];
    for (int small = 0; small < 2; small++) {
        struct scene_of_two s;
        open_scene(&s, 3, 1, FOLDING);
        swirl(&s.sim, 3);
        struct contact *c = s.sim.contact;
        const uint32_t room = c->pair_capacity;
        const size_t bytes = s.sim.bytes;
        if (small)
            assert_true(contact_make_room(&s.sim, c, 200));
        for (int i = 0; i < 200; i++)
            assert_ok(sim_step(&s.sim, &err), &err);
        assert_true(small ? c->pair_capacity > 200 : c->pair_capacity == room);
        assert_int_equal(s.sim.bytes, bytes + (c->pair_capacity - (size_t)room) * (sizeof *c->pairs + 20));
        hash[small] = sim_hash(&s.sim);
        close_scene(&s);
    }
    assert_int_equal(hash[0], hash[1]);
}

/* By a fine march along the way: the test of contact itself is on the safe side. */
static bool comes_too_near(double thickness, enum ccd_kind kind, const struct contact_approach *a)
{
    const double gap = fmin(a->distance, thickness) / 2;
    bool near = false;
    for (int step = 0; step <= 50; step++) {
        struct ccd_touch touch;
        double x[4][3];
        for (int k = 0; k < 12; k++)
            x[k / 3][k % 3] = a->from[k / 3][k % 3] +
                              step / 50.0 * (a->to[k / 3][k % 3] - a->from[k / 3][k % 3]);
        near |= ccd_distance(kind, x, &touch) < 0.999999 * gap;
    }
    return near;
}

static bool sleeps(const struct contact *c, const struct contact_pair *pair)
{
    const uint32_t *p = pair->point;
    return c->may_sleep && c->ahead[p[0]] + c->ahead[p[1]] + c->ahead[p[2]] + c->ahead[p[3]] <= pair->until;
}

/* Most pairs are not looked at again after a push, or not at all: when a step has ended none of those on the
 * list comes too near on its way, whether it was looked at or not. */
static void check_that_none_touches(struct sim *sim, int steps, uint32_t *slept, uint32_t *looked)
{
    struct error err = {0};
    for (int i = 0; i < steps; i++) {
        assert_ok(sim_step(sim, &err), &err);
        const struct contact *c = sim->contact;
        for (uint32_t p = 0; c->memory.is_awake && p < sim->point_count; p++)
            assert_true((double)(c->ahead[p] - c->path[p]) >=
                        0.99 * vec3_distance(sim->before[p], sim->position[p]));
        for (uint32_t pair = 0; pair < c->pair_count; pair++) {
            struct contact_approach a;
            if (!isfinite(c->pairs[pair].distance))
                continue;
            if (contact_approaches(sim, &c->pairs[pair], &a))
                assert_false(comes_too_near(c->thickness, (enum ccd_kind)c->pairs[pair].kind, &a));
            *slept += sleeps(c, &c->pairs[pair]);
            *looked += !sleeps(c, &c->pairs[pair]);
        }
    }
}

/* As fast as it falls together, when no pair sleeps for long, and in so short steps that most do. */
static void test_what_is_not_looked_at_does_not_touch(void **state)
{
    (void)state;
    struct scene_of_two s;
    uint32_t slept = 0, looked = 0;
    open_scene(&s, 3, 1,
               SETTINGS("contact.thickness=0.5", "balloons[0].pressure=-4", "balloons[0].threshold=100",
                        "time.guard=substep", "time.step=0.0125", "schedule[0].at=2",
                        "schedule[0].step=0.0002"));
    swirl(&s.sim, 3);
    check_that_none_touches(&s.sim, 160, &slept, &looked);
    assert_true(looked > 1000);
    slept = looked = 0;
    check_that_none_touches(&s.sim, 200, &slept, &looked);
    assert_true(slept > 1000 && looked > 1000);
    close_scene(&s);
}

/* One of the points goes straight towards the other feature. */
static void move_towards(enum ccd_kind kind, double x[4][3], uint32_t point, double length)
{
    struct ccd_touch touch;
    const int first = kind == CCD_EDGES ? 2 : 1;
    ccd_distance(kind, x, &touch);
    for (int i = 0; i < 3; i++)
        x[point][i] += ((int)point < first ? -length : length) * touch.normal[i];
}

/* Features that open() calls clear, one of whose points goes as far as it allows: pushed at the end of this
 * step, in which they come no nearer than the gap; and by the end of a later one, in which nothing is to
 * be looked at. Returns how many pushes there were. */
static uint32_t check_clear(enum ccd_kind kind, const struct contact_approach *a, double clear,
                            uint32_t round)
{
    struct contact_approach pushed = *a, next;
    const double share = (round % 5) / 4.0;
    double gone = 0;
    for (int i = 0; i < 4; i++)
        gone += vec3_distance(a->from[i], a->to[i]);
    if (gone < clear) {
        move_towards(kind, pushed.to, round % 4, (clear - gone) / 2);
        assert_false(comes_too_near(0.2, kind, &pushed));
    }
    memcpy(next.from, a->to, sizeof next.from);
    move_towards(kind, next.from, round % 4, share * clear);
    memcpy(next.to, next.from, sizeof next.to);
    move_towards(kind, next.to, round % 4, (1 - share) * clear / 2);
    next.distance = ccd_distance(kind, next.from, &next.touch);
    assert_true(next.distance - ccd_approach(kind, next.from, next.to) > fmin(next.distance, 0.2) / 2);
    return gone < clear;
}

/* Eight at a time and in single precision, near the place that all is seen from and far from it: no pair that
 * comes nearer than the gap in a fine march along its way is left out, and none is further apart than said;
 * most that do not come near are left out. */
static void check_kernels(const struct contact_kernels *kernels, double origin, enum ccd_kind kind)
{
    enum { PAIRS = 64 };
    static _Alignas(64) float ends[4 * PAIRS][8];
    static double from[4 * PAIRS][4], to[4 * PAIRS][4];
    uint64_t random = 5;
    size_t near = 0, left_out = 0, pushes = 0;
    for (uint32_t round = 0; round < 300; round++) {
        const double way = round % 3 ? 0.5 : 0.02;
        uint32_t points[PAIRS][4], open[PAIRS];
        float apart[PAIRS][2], clear[PAIRS];
        for (uint32_t p = 0; p < 4 * PAIRS; p++) {
            for (int i = 0; i < 3; i++) {
                from[p][i] = origin + random_unit(&random);
                to[p][i] = from[p][i] + way * random_unit(&random);
            }
            points[p / 4][p % 4] = p;
        }
        const struct contact_rounding job = {from, to, (double[]){0, 0, 0}, NULL, ends};
        kernels->round(&job, 0, 4 * PAIRS);
        const struct contact_flock flock = {kind, ends, 0};
        kernels->apart(&flock, points, PAIRS, apart);
        const uint32_t count = kernels->open(&flock, 0.2, points, PAIRS, open, clear);
        for (uint32_t i = 0, next = 0; i < PAIRS; i++) {
            struct contact_approach a;
            struct ccd_touch touch;
            contact_gather(from, points[i], a.from);
            contact_gather(to, points[i], a.to);
            a.distance = ccd_distance(kind, a.from, &touch);
            const bool is_open = next < count && open[next] == i, is_near = comes_too_near(0.2, kind, &a);
            next += is_open;
            near += is_near;
            left_out += !is_open;
            assert_true(is_open || !is_near);
            assert_true(!is_open || clear[i] <= 0);
            if (clear[i] > 0)
                pushes += check_clear(kind, &a, (double)clear[i], round + i);
            assert_true((double)apart[i][0] <= a.distance);
            assert_true((double)apart[i][1] <= ccd_distance(kind, a.to, &touch));
        }
    }
    assert_true(near > 200 && left_out > 6000 && pushes > 1000);
}

extern const struct contact_kernels contact_plain;

static void test_the_inner_loops_leave_nothing_out(void **state)
{
    (void)state;
    struct scene_of_two s;
    open_scene(&s, 1, 1, FOLDING);
    const struct contact_kernels *tables[] = {&contact_plain, s.sim.contact->tree.kernels};
    for (int i = 0; i < 2; i++)
        for (int kind = 0; kind < 2; kind++) {
            check_kernels(tables[i], 0, (enum ccd_kind)kind);
            check_kernels(tables[i], 3000, (enum ccd_kind)kind);
        }
    close_scene(&s);
}

/* A bit for each that does not sleep. */
static uint32_t awake_of(const struct contact_pair pairs[8], const float *ahead)
{
    uint32_t awake = 0;
    for (uint32_t i = 0; i < 8; i++)
        awake |= (uint32_t)!contact_sleeps(&pairs[i], ahead) << i;
    return awake;
}

/* Eight pairs of edges that stand a unit apart: they sleep until their points have gone so far together that
 * they could have met, and one wakes without the others. */
static void check_waking(const struct contact_kernels *kernels)
{
    enum { PAIRS = 8, POINTS = 4 * PAIRS };
    static const float place[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}};
    static _Alignas(64) float ends[POINTS][8];
    float path[POINTS] = {0}, clear[PAIRS];
    uint32_t points[PAIRS][4], near[PAIRS];
    struct contact_pair pairs[PAIRS];
    for (uint32_t p = 0; p < POINTS; p++) {
        points[p / 4][p % 4] = p;
        for (int k = 0; k < 3; k++)
            ends[p][k] = ends[p][k + 4] = place[p % 4][k];
    }
    for (uint32_t i = 0; i < PAIRS; i++)
        pairs[i] = (struct contact_pair){{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, CCD_EDGES, 1, 0, -1};
    assert_int_equal(awake_of(pairs, path), 0xff);
    const struct contact_flock flock = {CCD_EDGES, ends, 0};
    assert_int_equal(kernels->open(&flock, 0.5, points, PAIRS, near, clear), 0);
    for (uint32_t i = 0; i < PAIRS; i++)
        pairs[i].until = contact_until(0, clear[i]);
    path[13] = path[14] = 0.49F; /* 0.98 of 1 */
    assert_int_equal(awake_of(pairs, path), 0);
    path[15] = 0.03F;
    assert_int_equal(awake_of(pairs, path), 1 << 3);
    pairs[3].until = contact_until(1.01F, clear[3]); /* and falls asleep again */
    assert_int_equal(awake_of(pairs, path), 0);
    float off[POINTS] = {0};
    const struct contact_sieve sieve = {.off = off, .growth = 1, .gap = 0.25F};
    assert_int_equal(kernels->sift(&sieve, pairs, NULL, PAIRS, near), 0);
    off[12] = 1;
    assert_true(kernels->sift(&sieve, pairs, NULL, PAIRS, near) == 1 && near[0] == 3);
    assert_true(kernels->sift(&sieve, pairs, (uint32_t[PAIRS]){2, 3}, 2, near) == 1 && near[0] == 3);
}

static void test_a_pair_that_sleeps_wakes_when_its_points_come(void **state)
{
    (void)state;
    struct scene_of_two s;
    open_scene(&s, 1, 1, FOLDING);
    check_waking(&contact_plain);
    check_waking(s.sim.contact->tree.kernels);
    close_scene(&s);
}

/* A point through a triangle, edge over edge, by ways of every length and tilt: whenever a fine march along
 * the ways sees the distance fall under the gap, ccd_meet() says so, and before that time. */
static void test_a_meeting_is_never_missed(void **state)
{
    (void)state;
    uint64_t random = 3;
    int met = 0;
    for (int i = 0; i < 20000; i++) {
        double from[4][3], to[4][3], x[4][3];
        struct ccd_touch touch, other;
        const enum ccd_kind kind = i % 2 ? CCD_EDGES : CCD_POINT_TRIANGLE;
        for (int k = 0; k < 12; k++) {
            from[k / 3][k % 3] = random_unit(&random);
            to[k / 3][k % 3] = i % 3 ? random_unit(&random) : from[k / 3][k % 3] + 0.2 * random_unit(&random);
        }
        const double gap = ccd_distance(kind, from, &touch) / 2;
        const bool meets = ccd_meet(kind, from, to, gap, &touch);
        double first = INFINITY;
        for (int step = 0; step <= 200 && first > 1; step++) {
            for (int k = 0; k < 12; k++)
                x[k / 3][k % 3] = from[k / 3][k % 3] + step / 200.0 * (to[k / 3][k % 3] - from[k / 3][k % 3]);
            if (ccd_distance(kind, x, &other) <= gap)
                first = step / 200.0;
        }
        met += first <= 1;
        if (first <= 1)
            assert_true(meets && touch.time <= first);
    }
    assert_true(met > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_meeting_is_never_missed),
        cmocka_unit_test(test_the_list_has_all_that_is_near),
        cmocka_unit_test(test_a_list_that_is_full_is_refused),
        cmocka_unit_test(test_a_list_that_is_full_is_made_longer),
        cmocka_unit_test(test_what_is_not_looked_at_does_not_touch),
        cmocka_unit_test(test_the_inner_loops_leave_nothing_out),
        cmocka_unit_test(test_a_pair_that_sleeps_wakes_when_its_points_come),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
