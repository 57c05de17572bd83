#include "sim/contact_tree.h"
#include "common/array.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/topology.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF = 4, FITS = 64, SIDES = 13, CONNECTED_MOST = 4096 };

/* Half of the directions to the middles of a cube's faces, edges and corners, by their coordinates; the others are their opposites. Four at a time,
 * the last of them 0: to that side nothing looks. Then lengths that are no less than theirs, 1, sqrt 2 and sqrt 3. */
enum { SIDE_ROWS = 4 };
static const box_row side[3][SIDE_ROWS] = {{{1, 0, 0, 1}, {1, 1, 1, 0}, {0, 1, 1, 1}, {1, 0, 0, 0}},
                                           {{0, 1, 0, 1}, {-1, 0, 0, 1}, {1, 1, 1, -1}, {-1, 0, 0, 0}},
                                           {{0, 0, 1, 0}, {0, 1, -1, 1}, {-1, 1, -1, 1}, {-1, 0, 0, 0}}};
static const box_row side_length[SIDE_ROWS] = {{1, 1, 1, 1.4143F},
                                               {1.4143F, 1.4143F, 1.4143F, 1.4143F},
                                               {1.4143F, 1.7321F, 1.7321F, 1.7321F},
                                               {1.7321F, 1, 1, 1}};
static const box_mask side_bit[SIDE_ROWS] = {{1, 1 << 1, 1 << 2, 1 << 3},
                                             {1 << 4, 1 << 5, 1 << 6, 1 << 7},
                                             {1 << 8, 1 << 9, 1 << 10, 1 << 11},
                                             {1 << 12, 0, 0, 0}};

/* What making the tree needs, and fitting does not. */
struct maker {
    struct contact_tree *tree;
    const struct sim *sim;
    double (*middle)[3];       /* [triangle_count] */
    uint32_t (*of_edge)[2];    /* [edge_count] the triangles at an edge */
    uint32_t *parent, *inside; /* [triangle_count] for pieces; the node that a triangle was last seen in */
};

static int longest_axis(const struct maker *m, uint32_t begin, uint32_t end)
{
    struct contact_box box = contact_box_empty();
    for (uint32_t i = begin; i < end; i++) {
        const double *x = m->middle[m->tree->order[i]];
        const struct contact_box point = contact_box_point(x, x, 0);
        contact_box_join(&box, &point);
    }
    const box_row size = box.high[0] - box.low[0];
    int axis = 0;
    for (int i = 1; i < 3; i++)
        axis = size[i] > size[axis] ? i : axis;
    return axis;
}

static bool is_before(const struct maker *m, uint32_t a, uint32_t b, int axis)
{
    return m->middle[a][axis] < m->middle[b][axis] || (m->middle[a][axis] == m->middle[b][axis] && a < b);
}

/* Hoare's FIND (CACM 4 (1961) 321): what is before the middle one in this axis comes to stand before it. */
static void select_middle(const struct maker *m, uint32_t begin, uint32_t end, uint32_t middle, int axis)
{
    uint32_t *order = m->tree->order;
    int64_t low = begin, high = (int64_t)end - 1;
    while (low < high) {
        const uint32_t pivot = order[middle];
        int64_t i = low, j = high;
        while (i <= j) {
            while (is_before(m, order[i], pivot, axis))
                i++;
            while (is_before(m, pivot, order[j], axis))
                j--;
            if (i > j)
                break;
            const uint32_t swap = order[i];
            order[i++] = order[j];
            order[j--] = swap;
        }
        if (j < middle)
            low = i;
        if (middle < i)
            high = j;
    }
}

static uint32_t find(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static bool is_connected(struct maker *m, uint32_t node)
{
    const struct contact_node *n = &m->tree->nodes[node];
    const uint32_t *order = m->tree->order;
    uint32_t pieces = n->end - n->begin;
    if (pieces > CONNECTED_MOST)
        return false;
    for (uint32_t i = n->begin; i < n->end; i++) {
        m->parent[order[i]] = order[i];
        m->inside[order[i]] = node;
    }
    for (uint32_t i = n->begin; i < n->end; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *two = m->of_edge[m->sim->triangle_edge[order[i]][k]];
            if (m->inside[two[0]] != node || m->inside[two[1]] != node)
                continue;
            const uint32_t a = find(m->parent, two[0]), b = find(m->parent, two[1]);
            pieces -= a != b;
            m->parent[a] = b;
        }
    return pieces == 1;
}

static void make(struct maker *m, uint32_t begin, uint32_t end)
{
    struct contact_tree *tree = m->tree;
    const uint32_t node = tree->node_count++;
    struct contact_node *n = &tree->nodes[node];
    *n = (struct contact_node){.begin = begin, .end = end};
    n->connected = is_connected(m, node);
    if (end - begin > LEAF) {
        const uint32_t middle = begin + (end - begin) / 2;
        select_middle(m, begin, end, middle, longest_axis(m, begin, end));
        make(m, begin, middle);
        n->right = tree->node_count;
        make(m, middle, end);
    }
    n->next = tree->node_count;
}

static void make_all(struct maker *m)
{
    const struct sim *sim = m->sim;
    for (uint32_t t = 0; t < sim->triangle_count; t++) {
        const uint32_t *p = sim->triangle_point[t];
        m->tree->order[t] = t;
        m->inside[t] = UINT32_MAX;
        for (int i = 0; i < 3; i++)
            m->middle[t][i] = sim->position[p[0]][i] + sim->position[p[1]][i] + sim->position[p[2]][i];
    }
    for (uint32_t t = sim->triangle_count; t-- > 0;)
        for (int k = 0; k < 3; k++) {
            uint32_t *two = m->of_edge[sim->triangle_edge[t][k]];
            two[1] = two[0];
            two[0] = t;
        }
    for (size_t b = 0; b < sim->balloon_count; b++) {
        m->tree->root[b] = m->tree->node_count;
        make(m, sim->balloons[b].triangle_begin, sim->balloons[b].triangle_end);
    }
}

/* The nodes with at most this share of all triangles whose parents have more. */
static void find_fits(struct contact_tree *tree, uint32_t triangles)
{
    const uint32_t most = triangles / (FITS / 4) + LEAF;
    for (uint32_t n = 0; n < tree->node_count;) {
        const struct contact_node *node = &tree->nodes[n];
        const bool small = node->end - node->begin <= most || !node->right;
        if (small)
            tree->fit[tree->fit_count++] = n;
        n = small ? node->next : n + 1;
    }
}

enum status contact_tree_open(struct contact_tree *tree, struct sim *sim, struct error *err)
{
    const size_t triangles = sim->triangle_count;
    struct maker m = {.tree = tree, .sim = sim};
    tree->nodes = sim_table(sim, 2 * triangles, sizeof *tree->nodes);
    tree->order = sim_table(sim, triangles, sizeof *tree->order);
    tree->box = sim_table(sim, triangles, sizeof *tree->box);
    tree->point = sim_table(sim, sim->point_count, sizeof *tree->point);
    tree->root = sim_table(sim, sim->balloon_count, sizeof *tree->root);
    tree->jobs = sim_table(sim, CONTACT_JOBS, sizeof *tree->jobs);
    tree->fit = sim_table(sim, FITS + 2 * sim->balloon_count, sizeof *tree->fit);
    m.middle = array_new(triangles, sizeof *m.middle);
    m.of_edge = calloc(sim->edge_count, sizeof *m.of_edge);
    m.parent = array_new(triangles, sizeof *m.parent);
    m.inside = array_new(triangles, sizeof *m.inside);
    const bool room = tree->nodes && tree->order && tree->box && tree->point && tree->root && tree->jobs &&
                      tree->fit && m.middle && m.of_edge && m.parent && m.inside;
    if (room) {
        make_all(&m);
        find_fits(tree, sim->triangle_count);
    }
    free(m.middle);
    free(m.of_edge);
    free(m.parent);
    free(m.inside);
    return room ? STATUS_OK : error_no_memory(err, "the tree for contact");
}

void contact_tree_close(struct contact_tree *tree)
{
    free(tree->nodes);
    free(tree->order);
    free(tree->root);
    free(tree->box);
    free(tree->point);
    free(tree->jobs);
    free(tree->fit);
    *tree = (struct contact_tree){0};
}

/* Twice the area along the normal, the longest two sides' sum in *sides. */
static void normal_of(double (*x)[4], const uint32_t *p, double normal[3], double *sides)
{
    double ab[3], ac[3];
    vec3_sub(x[p[1]], x[p[0]], ab);
    vec3_sub(x[p[2]], x[p[0]], ac);
    vec3_cross(ab, ac, normal);
    *sides = vec3_length(ab) + vec3_length(ac);
}

/* The three vectors that its normal is made of on the way; one of them where it stays. Returns how many. */
static int normals_of(const struct contact_ways *ways, const uint32_t *p, double n[3][3], double *perimeter)
{
    double rows[3][4] = {{0}}, turn[3], ignored;
    const uint32_t own[3] = {0, 1, 2};
    normal_of(ways->to, p, n[0], perimeter);
    *perimeter += vec3_distance(ways->to[p[1]], ways->to[p[2]]);
    if (ways->from == ways->to)
        return 1;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            rows[k][i] = ways->to[p[k]][i] - ways->from[p[k]][i];
    normal_of(ways->from, p, n[2], &ignored);
    normal_of(rows, own, turn, &ignored);
    for (int i = 0; i < 3; i++)
        n[1][i] = (n[0][i] + n[2][i] - turn[i]) / 2;
    return 3;
}

/* The normal is a x b + b x c + c x a. With the corners off by `stray` each it is off by up to stray times the sides' sum, and by twice the area
 * of a triangle in a sphere of that radius: no more than 3 sqrt(3)/2 stray^2. What single precision adds is below 1e-6 of that sum squared. */
static uint32_t sides_of(const struct contact_ways *ways, const uint32_t *p)
{
    double n[3][3], perimeter;
    const int count = normals_of(ways, p, n, &perimeter);
    const float slack = (float)(ways->stray * perimeter + 2.6 * ways->stray * ways->stray +
                                1e-6 * perimeter * perimeter);
    box_mask front = {0}, back = {0};
    for (int r = 0; r < SIDE_ROWS; r++) {
        const box_row least = slack * side_length[r];
        box_mask ahead = side_bit[r], behind = side_bit[r];
        for (int i = 0; i < count; i++) {
            const box_row along = (float)n[i][0] * side[0][r] + (float)n[i][1] * side[1][r] +
                                  (float)n[i][2] * side[2][r];
            ahead &= along > least;
            behind &= -along > least;
        }
        front |= ahead;
        back |= behind;
    }
    return (uint32_t)(front[0] | front[1] | front[2] | front[3]) |
           (uint32_t)(back[0] | back[1] | back[2] | back[3]) << SIDES;
}

/* A patch with a cut in it can cross itself there, whichever way it looks. */
static bool is_cut(const struct sim *sim, uint32_t t)
{
    const struct sim_balloon *b = sim->balloons;
    while (t >= b->triangle_end)
        b++;
    if (!b->topology || b->topology->now.rims == 0)
        return false;
    const uint32_t *neighbour = b->topology->neighbour[t - b->triangle_begin];
    return neighbour[0] == MESH_NONE || neighbour[1] == MESH_NONE || neighbour[2] == MESH_NONE;
}

static bool is_whole(const struct sim *sim, uint32_t t)
{
    const uint32_t *e = sim->triangle_edge[t];
    if (is_cut(sim, t))
        return false;
    return sim->edge_active[e[0]] && sim->edge_active[e[1]] && sim->edge_active[e[2]];
}

static void fit_leaf(const struct contact_tree *tree, const struct sim *sim, const struct contact_ways *ways,
                     struct contact_node *node)
{
    for (uint32_t i = node->begin; i < node->end; i++) {
        const uint32_t t = tree->order[i], *p = sim->triangle_point[t];
        tree->box[t] = contact_box_empty();
        if (!sim->triangle_active[t])
            continue;
        for (int k = 0; k < 3; k++)
            contact_box_join(&tree->box[t], &tree->point[p[k]]);
        contact_box_join(&node->box, &tree->box[t]);
        node->sides &= is_whole(sim, t) ? sides_of(ways, p) : 0;
    }
}

static void fit_nodes(const struct contact_tree *tree, const struct sim *sim, const struct contact_ways *ways,
                      uint32_t begin, uint32_t end)
{
    for (uint32_t n = end; n-- > begin;) {
        struct contact_node *node = &tree->nodes[n];
        node->box = contact_box_empty();
        node->sides = UINT32_MAX;
        if (!node->right) {
            fit_leaf(tree, sim, ways, node);
            continue;
        }
        const struct contact_node *left = &tree->nodes[n + 1], *right = &tree->nodes[node->right];
        node->box = left->box;
        contact_box_join(&node->box, &right->box);
        node->sides = left->sides & right->sides;
    }
}

struct fit_job {
    const struct contact_tree *tree;
    const struct sim *sim;
    const struct contact_ways *ways;
};

static void fit_one(void *context, size_t index, unsigned worker)
{
    (void)worker;
    const struct fit_job *job = context;
    const uint32_t node = job->tree->fit[index];
    fit_nodes(job->tree, job->sim, job->ways, node, job->tree->nodes[node].next);
}

static void box_points(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct fit_job *job = context;
    const struct contact_ways *ways = job->ways;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        job->tree->point[p] = contact_box_point(ways->from[p], ways->to[p], ways->stray + ways->room / 2);
    (void)sim;
}

void contact_tree_fit(struct contact_tree *tree, struct sim *sim, const struct contact_ways *ways)
{
    struct fit_job job = {tree, sim, ways};
    sim_each_part(sim, box_points, &job);
    threads_run(sim->pool, tree->fit_count, fit_one, &job);
    uint32_t end = tree->node_count; /* what is above those, from the last to the first */
    for (uint32_t i = tree->fit_count; i-- > 0;) {
        fit_nodes(tree, sim, ways, tree->nodes[tree->fit[i]].next, end);
        end = tree->fit[i];
    }
    fit_nodes(tree, sim, ways, 0, end);
}
