/* What the blocks about the skin must say, and must not say together. */
#include "common/scene_checks.h"

#include <math.h>
#include <string.h>

static enum status check_ogden(const struct scene *scene, size_t number, struct error *err)
{
    enum { TERMS_MAX = 6 };
    const struct scene_membrane *m = &scene->balloons[number].membrane;
    double modulus = 0;
    for (size_t i = 0; i < m->ogden.count; i++) {
        const double alpha = m->ogden.row[i][1];
        if (!(fabs(alpha) >= 0.01 && fabs(alpha) <= 20))
            return scene_contradiction(
                scene, number, "membrane.ogden", m->line, err,
                "alpha of row %zu is %g; it must be from 0.01 to 20, or from -20 to -0.01", i + 1, alpha);
        modulus += m->ogden.row[i][0] * alpha / 2;
    }
    if (m->ogden.count > TERMS_MAX)
        return scene_contradiction(scene, number, "membrane.ogden", m->line, err,
                                   "there are %zu rows; at most %d are taken", m->ogden.count, TERMS_MAX);
    if (!(modulus > 0))
        return scene_contradiction(scene, number, "membrane.ogden", m->line, err,
                                   "the sum of m alpha is %g; of rubber, which resists, it is above 0",
                                   2 * modulus);
    return STATUS_OK;
}

/* Methods that go by what hangs together at the start: CVODE's vectors and xpbd's
 * constraints are made once. */
enum status scene_check_fracture(const struct scene *scene, size_t number, struct error *err)
{
    static const char *const fixed[] = {"xpbd", "cvode-bdf", "cvode-adams"};
    const struct scene_balloon *b = &scene->balloons[number];
    if (!b->fracture.on || b->fracture.mode != SCENE_FRACTURE_TEAR)
        return STATUS_OK;
    for (size_t i = 0; i < sizeof fixed / sizeof fixed[0]; i++)
        if (!strcmp(scene_integrator_names[scene->time.integrator], fixed[i]))
            return scene_contradiction(
                scene, number, "fracture", b->fracture.line, err,
                "time.integrator \"%s\" cannot follow a skin that tears; take another, as "
                "\"symplectic-euler\" or \"bdf2\", or mode = \"paper\"",
                fixed[i]);
    if (b->viscosity.on || b->plasticity.on)
        return scene_contradiction(
            scene, number, "fracture", b->fracture.line, err,
            "springs with %s do not come apart; leave it out, or take mode = \"paper\"",
            b->viscosity.on ? "viscosity" : "plasticity");
    return STATUS_OK;
}

/* Hinges are no constraints of its kind, and as forces from outside they would be moved with
 * steps that suit nobody. */
static enum status check_bending(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_bending *block = &scene->balloons[number].bending;
    if (!block->on || strcmp(scene_integrator_names[scene->time.integrator], "xpbd"))
        return STATUS_OK;
    return scene_contradiction(scene, number, "bending", block->line, err,
                               "time.integrator \"xpbd\" moves springs only; take \"auto\"");
}

static enum status check_membrane(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_balloon *b = &scene->balloons[number];
    if (!(b->membrane.thickness > 0))
        return scene_contradiction(scene, number, "membrane", b->membrane.line, err,
                                   "give thickness; that of a toy balloon is about a hundredth of its "
                                   "radius (%g)",
                                   b->radius / 100);
    if (b->spring_by_height.on)
        return scene_contradiction(scene, number, "membrane", b->membrane.line, err,
                                   "it has no springs for spring_by_height; leave out one of the two");
    if (b->viscosity.on || b->plasticity.on)
        return scene_contradiction(scene, number, "membrane", b->membrane.line, err,
                                   "it has no springs for %s; leave out one of the two",
                                   b->viscosity.on ? "viscosity" : "plasticity");
    if (!strcmp(scene_integrator_names[scene->time.integrator], "xpbd"))
        return scene_contradiction(scene, number, "membrane", b->membrane.line, err,
                                   "time.integrator \"xpbd\" moves springs only; take \"auto\"");
    return check_ogden(scene, number, err);
}

enum status scene_check_skin(const struct scene *scene, size_t number, struct error *err)
{
    const enum status status = check_bending(scene, number, err);
    if (status)
        return status;
    return scene->balloons[number].membrane.on ? check_membrane(scene, number, err) : STATUS_OK;
}
