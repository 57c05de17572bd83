/* A balloon to test: an icosphere with the paper's settings, changed as a test wants. */
#ifndef TESTS_UNIT_BALLOON_H
#define TESTS_UNIT_BALLOON_H

#include "check.h"
#include "sim/sim.h"
#include "support/shapes.h"

struct balloon {
    struct scene scene;
    struct mesh mesh;
    struct sim sim;
};

/* An icosphere with the paper's settings and these changes ("KEY=VALUE", ends with NULL). */
static inline void open_balloon(struct balloon *b, unsigned level, const char *const *changes)
{
    struct error err = {0};
    *b = (struct balloon){0};
    assert_ok(scene_from_mesh("sphere", &b->scene, &err), &err);
    for (; *changes; changes++)
        assert_ok(scene_set(&b->scene, *changes, &err), &err);
    assert_ok(scene_check(&b->scene, &err), &err);
    shape_icosphere(level, &b->mesh);
    assert_ok(sim_open(&b->sim, &b->scene, &b->mesh, 1, &err), &err);
}
#define SETTINGS(...) ((const char *const[]){__VA_ARGS__ __VA_OPT__(, ) NULL})

static inline void close_balloon(struct balloon *b)
{
    sim_clear(&b->sim);
    mesh_clear(&b->mesh);
    scene_clear(&b->scene);
}

static inline void steps(struct balloon *b, int count)
{
    struct error err = {0};
    while (count--)
        assert_ok(sim_step(&b->sim, &err), &err);
}

#endif
