/* Which triangles meet: down the tree of contact_tree.c, shared out among the workers. */
#include "common/threads.h"
#include "sim/contact_tree.h"

#include <string.h>

struct search {
    struct contact_tree *tree;
    void (*take)(void *context, uint32_t t, uint32_t u);
    void *context;
};

static void take_leaves(const struct search *s, const struct contact_node *a, const struct contact_node *b)
{
    const uint32_t *order = s->tree->order;
    const struct contact_box *box = s->tree->box;
    for (uint32_t i = a->begin; i < a->end; i++)
        for (uint32_t j = a == b ? i + 1 : b->begin; j < b->end; j++) {
            const uint32_t t = order[i], u = order[j];
            if (contact_boxes_meet(&box[t], &box[u]))
                s->take(s->context, t < u ? t : u, t < u ? u : t);
        }
}

/* What two nodes, or one and itself, come to: up to three smaller jobs. 0: leaves, or nothing. */
static int divide(const struct contact_tree *tree, struct contact_job job, struct contact_job parts[3])
{
    const struct contact_node *a = &tree->nodes[job.a], *b = &tree->nodes[job.b];
    if (job.a == job.b) {
        if (!a->right)
            return 0;
        parts[0] = (struct contact_job){job.a + 1, job.a + 1};
        parts[1] = (struct contact_job){a->right, a->right};
        parts[2] = (struct contact_job){job.a + 1, a->right};
        return 3;
    }
    const bool first = a->right && (!b->right || a->end - a->begin >= b->end - b->begin);
    if (!first && !b->right)
        return 0;
    parts[0] = first ? (struct contact_job){job.a + 1, job.b} : (struct contact_job){job.a, job.b + 1};
    parts[1] = first ? (struct contact_job){a->right, job.b} : (struct contact_job){job.a, b->right};
    return 2;
}

static bool is_empty(const struct contact_tree *tree, struct contact_job job)
{
    const struct contact_node *a = &tree->nodes[job.a], *b = &tree->nodes[job.b];
    return job.a == job.b ? a->sides && a->connected : !contact_boxes_meet(&a->box, &b->box);
}

static void search(const struct search *s, struct contact_job job)
{
    struct contact_job parts[3];
    if (is_empty(s->tree, job))
        return;
    const int count = divide(s->tree, job, parts);
    if (count == 0)
        take_leaves(s, &s->tree->nodes[job.a], &s->tree->nodes[job.b]);
    for (int i = 0; i < count; i++)
        search(s, parts[i]);
}

static void search_one(void *context, size_t index, unsigned worker)
{
    (void)worker;
    const struct search *s = context;
    search(s, s->tree->jobs[index]);
}

/* Divides the jobs at hand until there are enough to share out; what comes to nothing is dropped. */
static void share_out(struct contact_tree *tree)
{
    enum { ENOUGH = 128 };
    uint32_t begin = 0, end = tree->job_count;
    while (begin < end && end - begin < ENOUGH && end + 3 < CONTACT_JOBS) {
        struct contact_job parts[3];
        const struct contact_job job = tree->jobs[begin];
        if (is_empty(tree, job)) {
            begin++;
            continue;
        }
        const int count = divide(tree, job, parts);
        if (count == 0)
            break;
        begin++;
        for (int i = 0; i < count; i++)
            tree->jobs[end++] = parts[i];
    }
    memmove(tree->jobs, tree->jobs + begin, (end - begin) * sizeof *tree->jobs);
    tree->job_count = end - begin;
}

void contact_tree_pairs(struct contact_tree *tree, struct sim *sim,
                        void (*take)(void *context, uint32_t t, uint32_t u), void *context)
{
    struct search s = {tree, take, context};
    for (size_t i = 0; i < sim->balloon_count; i++)
        for (size_t j = i; j < sim->balloon_count; j++) {
            tree->jobs[0] = (struct contact_job){tree->root[i], tree->root[j]};
            tree->job_count = 1;
            share_out(tree);
            threads_run(sim->pool, tree->job_count, search_one, &s);
        }
}
