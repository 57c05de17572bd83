/* Boxes around the ways of the points, triangles and patches of contact_tree.c, and to which sides the patches look. */
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/contact_tree.h"
#include "sim/topology.h"

enum { SIDES = 13 };

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

static double reach_of(const struct contact_ways *ways, uint32_t point)
{
    return ways->reach ? (double)ways->reach[point] : 0;
}

static struct contact_box box_of(const struct contact_ways *ways, uint32_t point)
{
    return contact_box_point(ways->from[point], ways->to[point], reach_of(ways, point) + ways->room / 2);
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
    double n[3][3], perimeter, stray = 0;
    const int count = normals_of(ways, p, n, &perimeter);
    for (int k = 0; k < 3; k++)
        stray = fmax(stray, reach_of(ways, p[k]));
    const float slack = (float)(stray * perimeter + 2.6 * stray * stray + 1e-6 * perimeter * perimeter);
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

static void box_triangle(const struct contact_tree *tree, const uint32_t p[3], struct contact_box *box)
{
    *box = tree->point[p[0]];
    contact_box_join(box, &tree->point[p[1]]);
    contact_box_join(box, &tree->point[p[2]]);
}

/* The boxes of the triangles that a leaf lists, of the edges that it stands for, and its own. */
static void box_leaf(const struct contact_tree *tree, const struct sim *sim, struct contact_node *node)
{
    const struct contact_leaf *leaf = &tree->leaves[node->number];
    for (uint32_t i = node->begin; i < node->end; i++) {
        const uint32_t t = tree->order[i];
        tree->box[i] = contact_box_empty();
        if (sim->triangle_active[t])
            box_triangle(tree, sim->triangle_point[t], &tree->box[i]);
        contact_box_join(&node->box, &tree->box[i]);
    }
    for (uint32_t i = leaf->edge_begin; i < leaf->edge_end; i++) {
        const uint32_t *ends = sim->edge_point[tree->leaf_edge[i]];
        tree->edge_box[i] = tree->point[ends[0]];
        contact_box_join(&tree->edge_box[i], &tree->point[ends[1]]);
    }
}

static void fit_leaf(const struct contact_tree *tree, const struct sim *sim, const struct contact_ways *ways,
                     struct contact_node *node)
{
    box_leaf(tree, sim, node);
    for (uint32_t i = node->begin; i < node->end; i++) {
        const uint32_t t = tree->order[i];
        if (sim->triangle_active[t])
            node->sides &= is_whole(sim, t) ? sides_of(ways, sim->triangle_point[t]) : 0;
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
        job->tree->point[p] = box_of(ways, p);
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

/* A patch of which a triangle no longer looks to where all others do: false, there is no room to remember it. */
static bool open_patch(struct contact_tree *tree, uint32_t node)
{
    const struct contact_node *n = &tree->nodes[node];
    if (tree->job_count == CONTACT_JOBS)
        return false;
    tree->jobs[tree->job_count++] = n->right ? (struct contact_job){node + 1, n->right}
                                             : (struct contact_job){node, node};
    return true;
}

/* All that a triangle is in, up to the root. */
static bool widen(struct contact_tree *tree, uint32_t t, uint32_t sides)
{
    const struct contact_box *box = &tree->nodes[tree->leaf[t]].box;
    for (uint32_t node = tree->leaf[t];; node = tree->nodes[node].parent) {
        struct contact_node *n = &tree->nodes[node];
        contact_box_join(&n->box, box);
        if (n->connected && n->sides && !(n->sides & sides) && !open_patch(tree, node))
            return false;
        n->sides &= sides;
        if (n->parent == node)
            return true;
    }
}

bool contact_tree_refit(struct contact_tree *tree, struct sim *sim, const struct contact_ways *ways,
                        const uint32_t *points, uint32_t point_count, const uint32_t *triangles,
                        uint32_t triangle_count)
{
    tree->job_count = 0;
    for (uint32_t i = 0; i < point_count; i++)
        tree->point[points[i]] = box_of(ways, points[i]);
    for (uint32_t i = 0; i < triangle_count; i++) {
        const uint32_t t = triangles[i], *p = sim->triangle_point[t];
        if (!sim->triangle_active[t])
            continue;
        box_leaf(tree, sim, &tree->nodes[tree->leaf[t]]);
        if (!widen(tree, t, is_whole(sim, t) ? sides_of(ways, p) : 0))
            return false;
    }
    return true;
}
