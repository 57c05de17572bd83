/* Which leaves meet: down the tree of contact_tree.c, shared out among the workers. */
#include "sim/contact_shares.h"
#include "sim/contact_tree.h"

#include <string.h>

struct search {
    struct contact_tree *tree;
    void (*take)(void *context, unsigned worker, uint32_t a, uint32_t b);
    void *context;
};

/* Two leaves that hang together, and look to one side. */
static bool are_one_patch(const struct contact_tree *tree, struct contact_job job)
{
    const struct contact_node *a = &tree->nodes[job.a], *b = &tree->nodes[job.b];
    const uint32_t *beside = tree->beside[a->number];
    uint32_t found = 0;
    for (int i = 0; i < CONTACT_BESIDE; i++)
        found |= beside[i] == job.b;
    return found && a->sides & b->sides && a->connected && b->connected;
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

static void search(const struct search *s, unsigned worker, struct contact_job job)
{
    struct contact_job parts[3];
    if (is_empty(s->tree, job))
        return;
    const int count = divide(s->tree, job, parts);
    if (count == 0 && (job.a == job.b || !are_one_patch(s->tree, job)))
        s->take(s->context, worker, job.a, job.b);
    for (int i = 0; i < count; i++)
        search(s, worker, parts[i]);
}

static void search_one(void *context, size_t index, unsigned worker)
{
    const struct search *s = context;
    search(s, worker, s->tree->jobs[index]);
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
                        void (*take)(void *context, unsigned worker, uint32_t a, uint32_t b), void *context)
{
    struct search s = {.tree = tree, .take = take, .context = context};
    for (size_t i = 0; i < sim->balloon_count; i++)
        for (size_t j = i; j < sim->balloon_count; j++) {
            tree->jobs[0] = (struct contact_job){tree->root[i], tree->root[j]};
            tree->job_count = 1;
            share_out(tree);
            contact_share_out(sim->pool, tree->job_count, search_one, &s);
        }
}

void contact_tree_pairs_opened(struct contact_tree *tree, struct sim *sim,
                               void (*take)(void *context, unsigned worker, uint32_t a, uint32_t b),
                               void *context)
{
    struct search s = {.tree = tree, .take = take, .context = context};
    contact_share_out(sim->pool, tree->job_count, search_one, &s);
}

void contact_tree_near(const struct contact_tree *tree, const struct contact_box *box,
                       void (*take)(void *context, uint32_t leaf), void *context)
{
    for (uint32_t n = 0; n < tree->node_count;) {
        const struct contact_node *node = &tree->nodes[n];
        const bool meets = contact_boxes_meet(&node->box, box);
        if (meets && !node->right)
            take(context, n);
        n = meets ? n + 1 : node->next;
    }
}
