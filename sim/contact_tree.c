#include "sim/contact_tree.h"
#include "common/array.h"
#include "common/threads.h"
#include "common/vec3.h"
#include "sim/topology.h"

#include <stdlib.h>
#include <string.h>

enum { FITS = 64, CONNECTED_MOST = 4096 };

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
    const box_row size = box.at[0].low + box.at[0].high;
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

static void make(struct maker *m, uint32_t parent, uint32_t begin, uint32_t end)
{
    struct contact_tree *tree = m->tree;
    const uint32_t node = tree->node_count++;
    struct contact_node *n = &tree->nodes[node];
    *n = (struct contact_node){.begin = begin, .end = end, .parent = parent};
    n->connected = is_connected(m, node);
    if (end - begin > CONTACT_LEAF) {
        const uint32_t middle = begin + (end - begin) / 2;
        select_middle(m, begin, end, middle, longest_axis(m, begin, end));
        make(m, node, begin, middle);
        n->right = tree->node_count;
        make(m, node, middle, end);
    }
    if (!n->right)
        n->number = tree->leaf_count++;
    for (uint32_t i = begin; i < end && !n->right; i++)
        tree->leaf[tree->order[i]] = node;
    n->next = tree->node_count;
}

/* Of every leaf, those that its triangles' sides lead to. */
static void find_beside(const struct maker *m)
{
    const struct contact_tree *tree = m->tree;
    for (uint32_t n = 0; n < tree->node_count; n++) {
        const struct contact_node *node = &tree->nodes[n];
        for (uint32_t i = 0; i < CONTACT_BESIDE && !node->right; i++)
            tree->beside[node->number][i] = n;
        for (uint32_t i = node->begin; i < node->end && !node->right; i++)
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t t = tree->order[i], *two = m->of_edge[m->sim->triangle_edge[t][k]];
                tree->beside[node->number][3 * (i - node->begin) + k] = tree->leaf[two[two[0] == t]];
            }
    }
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
    memset(m->of_edge, 0xff, sim->edge_count * sizeof *m->of_edge);
    for (uint32_t t = sim->triangle_count; t-- > 0;)
        for (int k = 0; k < 3; k++) {
            uint32_t *two = m->of_edge[sim->triangle_edge[t][k]];
            two[1] = two[0] == MESH_NONE ? t : two[0]; /* at a rim both are the one */
            two[0] = t;
        }
    for (size_t b = 0; b < sim->balloon_count; b++) {
        m->tree->root[b] = m->tree->node_count;
        make(m, m->tree->node_count, sim->balloons[b].triangle_begin, sim->balloons[b].triangle_end);
    }
    find_beside(m);
}

/* The nodes with at most this share of all triangles whose parents have more. */
static void find_fits(struct contact_tree *tree, uint32_t triangles)
{
    const uint32_t most = triangles / (FITS / 4) + CONTACT_LEAF;
    for (uint32_t n = 0; n < tree->node_count;) {
        const struct contact_node *node = &tree->nodes[n];
        const bool small = node->end - node->begin <= most || !node->right;
        if (small)
            tree->fit[tree->fit_count++] = n;
        n = small ? node->next : n + 1;
    }
}

/* How many leaves so many triangles come to: they are halved as make() does. */
static size_t leaves_of(size_t triangles)
{
    return triangles <= CONTACT_LEAF ? 1 : leaves_of(triangles / 2) + leaves_of(triangles - triangles / 2);
}

enum status contact_tree_open(struct contact_tree *tree, struct sim *sim, struct error *err)
{
    const size_t triangles = sim->triangle_count;
    struct maker m = {.tree = tree, .sim = sim};
    size_t leaves = 0;
    for (size_t b = 0; b < sim->balloon_count; b++)
        leaves += leaves_of(sim->balloons[b].triangle_end - sim->balloons[b].triangle_begin);
    tree->nodes = sim_table(sim, 2 * leaves, sizeof *tree->nodes);
    tree->order = sim_table(sim, triangles, sizeof *tree->order);
    tree->leaf = sim_table(sim, triangles, sizeof *tree->leaf);
    tree->beside = sim_table(sim, leaves, sizeof *tree->beside);
    tree->leaves = sim_table(sim, leaves, sizeof *tree->leaves);
    tree->leaf_point = sim_table(sim, sim->point_count, sizeof *tree->leaf_point);
    tree->leaf_edge = sim_table(sim, sim->edge_count, sizeof *tree->leaf_edge);
    tree->point_taken = sim_table(sim, sim->point_count, 1);
    tree->edge_taken = sim_table(sim, sim->edge_count, 1);
    tree->side = sim_table(sim, triangles, sizeof *tree->side);
    tree->point = sim_table(sim, sim->point_count, sizeof *tree->point);
    tree->root = sim_table(sim, sim->balloon_count, sizeof *tree->root);
    tree->jobs = sim_table(sim, CONTACT_JOBS, sizeof *tree->jobs);
    tree->fit = sim_table(sim, FITS + 2 * sim->balloon_count, sizeof *tree->fit);
    m.middle = array_new(triangles, sizeof *m.middle);
    m.of_edge = array_new(sim->edge_count, sizeof *m.of_edge);
    m.parent = array_new(triangles, sizeof *m.parent);
    m.inside = array_new(triangles, sizeof *m.inside);
    const bool room = tree->nodes && tree->order && tree->leaf && tree->beside && tree->leaves &&
                      tree->leaf_point && tree->leaf_edge && tree->point_taken && tree->edge_taken &&
                      tree->side && tree->point && tree->root && tree->jobs && tree->fit && m.middle &&
                      m.of_edge && m.parent && m.inside;
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
    free(tree->leaf);
    free(tree->beside);
    free(tree->leaves);
    free(tree->leaf_point);
    free(tree->leaf_edge);
    free(tree->point_taken);
    free(tree->edge_taken);
    free(tree->side);
    free(tree->root);
    free(tree->point);
    free(tree->jobs);
    free(tree->fit);
    *tree = (struct contact_tree){0};
}

/* Those of its triangles' points and edges that no leaf before it stands for. */
static void share_leaf(struct contact_tree *tree, const struct sim *sim, const struct contact_node *node,
                       struct contact_leaf *leaf)
{
    for (uint32_t i = node->begin; i < node->end; i++)
        for (int k = 0; k < 3 && sim->triangle_active[tree->order[i]]; k++) {
            const uint32_t point = sim->triangle_point[tree->order[i]][k],
                           edge = sim->triangle_edge[tree->order[i]][k];
            if (!tree->point_taken[point])
                tree->leaf_point[leaf->point_end++] = point;
            if (!tree->edge_taken[edge])
                tree->leaf_edge[leaf->edge_end++] = edge;
            tree->point_taken[point] = tree->edge_taken[edge] = 1;
        }
}

void contact_tree_share(struct contact_tree *tree, const struct sim *sim)
{
    memset(tree->point_taken, 0, sim->point_count);
    memset(tree->edge_taken, 0, sim->edge_count);
    uint32_t point = 0, edge = 0;
    for (uint32_t n = 0; n < tree->node_count; n++) {
        if (tree->nodes[n].right)
            continue;
        struct contact_leaf *leaf = &tree->leaves[tree->nodes[n].number];
        *leaf = (struct contact_leaf){point, point, edge, edge};
        share_leaf(tree, sim, &tree->nodes[n], leaf);
        point = leaf->point_end;
        edge = leaf->edge_end;
    }
}
