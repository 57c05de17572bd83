/* Journals of the sculpture a.oct, in the folder of a test. */
#ifndef TESTS_UNIT_JOURNALS_H
#define TESTS_UNIT_JOURNALS_H

#include "folder.h"
#include "sculpt/journal.h"
#include "trees.h"

#define JOURNAL "a.oct.journal"
#define BASE    "a.oct.journal-base"

static inline void leave_nothing(void)
{
    unlink("a.oct");
    unlink(JOURNAL);
    unlink(BASE);
}

/* What a script makes of a cube of depth 4. */
static inline struct octree carved(const char *script)
{
    struct error err = {0};
    struct octree tree = new_tree(4, 1);
    struct chips chips = {0};
    assert_ok(chips_parse("script", script, strlen(script), &chips, &err), &err);
    assert_ok(chips_run(&tree, &chips, &err), &err);
    chips_clear(&chips);
    return tree;
}

static inline void save_carved(const char *script, const char *path)
{
    struct error err = {0};
    struct octree tree = carved(script);
    assert_ok(octree_save(&tree, path, &err), &err);
    octree_clear(&tree);
}

static inline struct journal *begin(void)
{
    struct error err = {0};
    struct journal *journal = NULL;
    struct octree start = new_tree(4, 1);
    assert_ok(journal_open("a.oct", &start, &journal, &err), &err);
    return journal;
}

static inline void append(struct journal *journal, const char *lines)
{
    struct error err = {0};
    assert_ok(journal_append(journal, lines, &err), &err);
}

/* The journal leads to what this script makes of a full cube. */
static inline struct journal_report assert_recovers(const char *script)
{
    struct error err = {0};
    struct octree tree = {0}, wanted = carved(script);
    struct journal_report report;
    assert_ok(journal_recover("a.oct", &tree, NULL, &report, &err), &err);
    assert_true(octree_equal(&tree, &wanted));
    octree_clear(&tree);
    octree_clear(&wanted);
    return report;
}

#define ONE   "chip sphere 0.25 0.25 0.25 0.2\n"
#define TWO   "mirror x\nheat 0.5 0.5 0.5 0.5\n"
#define THREE "material 7\nfill box 0.5 0.5 0.5 0.9 0.8 0.7\n"

#endif
