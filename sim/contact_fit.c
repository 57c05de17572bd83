/* Boxes around the ways of the points, triangles and patches of contact_tree.c, and to which
 * sides the patches look. */
#include "common/threads.h"
#include "sim/contact_tree.h"
#include "sim/topology.h"

static struct contact_box box_of(const struct contact_ways *ways, uint32_t point)
{
    return contact_box_point(ways->from[point], ways->to[point], (double)ways->reach[point] + ways->room / 2);
}

/* A patch with a cut or a hole in it can cross itself there, whichever way it looks. */
static bool is_cut(const struct sim *sim, uint32_t t)
{
    const struct sim_balloon *b = sim_balloon_of(sim, t);
    if (!b->topology || b->topology->now.rims == 0)
        return false;
    const uint32_t *neighbour = b->topology->neighbour[t - b->triangle_begin];
    return neighbour[0] == MESH_NONE || neighbour[1] == MESH_NONE || neighbour[2] == MESH_NONE;
}

static bool is_whole(const struct sim *sim, uint32_t t)
{
    const uint32_t *e = sim->triangle_edge[t];
    if (!sim->triangle_active[t] || is_cut(sim, t))
        return false;
    return sim->edge_active[e[0]] && sim->edge_active[e[1]] && sim->edge_active[e[2]];
}

void contact_tree_cell(const struct contact_tree *tree, const struct sim *sim, uint32_t leaf,
                       struct contact_cell *cell)
{
    const struct contact_node *node = &tree->nodes[leaf];
    const struct contact_leaf *stands = &tree->leaves[node->number];
    cell->leaf = leaf;
    cell->triangles = (struct contact_group){cell->triangle, node->end - node->begin, &node->box};
    cell->points = (struct contact_group){cell->point, stands->point_end - stands->point_begin, &node->box};
    cell->edges = (struct contact_group){cell->edge, stands->edge_end - stands->edge_begin, &node->box};
    for (uint32_t i = 0; i < cell->triangles.count; i++) {
        const uint32_t t = tree->order[node->begin + i], *p = sim->triangle_point[t];
        cell->triangle[i] = sim->triangle_active[t] ? contact_box_triangle(tree->point, p)
                                                    : contact_box_empty();
    }
    for (uint32_t i = 0; i < cell->edges.count; i++)
        cell->edge[i] = contact_box_edge(tree->point,
                                         sim->edge_point[tree->leaf_edge[stands->edge_begin + i]]);
    for (uint32_t i = 0; i < cell->points.count; i++)
        cell->point[i] = tree->point[tree->leaf_point[stands->point_begin + i]];
}

static void fit_leaf(const struct contact_tree *tree, const struct sim *sim, struct contact_node *node)
{
    for (uint32_t i = node->begin; i < node->end; i++) {
        const uint32_t t = tree->order[i];
        node->sides &= is_whole(sim, t) ? tree->side[t] : 0;
        for (int k = 0; k < 3 && sim->triangle_active[t]; k++)
            contact_box_join(&node->box, &tree->point[sim->triangle_point[t][k]]);
    }
}

static void fit_nodes(const struct contact_tree *tree, const struct sim *sim, uint32_t begin, uint32_t end)
{
    for (uint32_t n = end; n-- > begin;) {
        struct contact_node *node = &tree->nodes[n];
        node->box = contact_box_empty();
        node->sides = UINT32_MAX;
        if (!node->right) {
            fit_leaf(tree, sim, node);
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
    const struct contact_tree *tree = job->tree;
    const struct contact_node *top = &tree->nodes[node];
    tree->kernels->sides(job->ways, job->sim->triangle_point, tree->order + top->begin, top->end - top->begin,
                         tree->side);
    fit_nodes(tree, job->sim, node, top->next);
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
        fit_nodes(tree, sim, tree->nodes[tree->fit[i]].next, end);
        end = tree->fit[i];
    }
    fit_nodes(tree, sim, 0, end);
}

/* A patch of which a triangle no longer looks to where all others do: false, there is
 * no room to remember it. */
static bool open_patch(struct contact_tree *tree, uint32_t node)
{
    const struct contact_node *n = &tree->nodes[node];
    if (tree->job_count == CONTACT_JOBS)
        return false;
    tree->jobs[tree->job_count++] = n->right ? (struct contact_job){node + 1, n->right}
                                             : (struct contact_job){node, node};
    return true;
}

/* All that a triangle is in, up to the root or to what has room for it already: so has all above. */
static bool widen(struct contact_tree *tree, uint32_t t, const struct contact_box *box, uint32_t sides)
{
    for (uint32_t node = tree->leaf[t];; node = tree->nodes[node].parent) {
        struct contact_node *n = &tree->nodes[node];
        if (!(n->sides & ~sides) && contact_box_has(&n->box, box))
            return true;
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
    tree->kernels->sides(ways, sim->triangle_point, triangles, triangle_count, tree->side);
    for (uint32_t i = 0; i < triangle_count; i++) {
        const uint32_t t = triangles[i];
        if (!sim->triangle_active[t])
            continue;
        const struct contact_box box = contact_box_triangle(tree->point, sim->triangle_point[t]);
        if (!widen(tree, t, &box, is_whole(sim, t) ? tree->side[t] : 0))
            return false;
    }
    return true;
}
