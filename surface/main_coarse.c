#include "surface/main_coarse.h"

#include "surface/largest.h"

#include <math.h>
#include <stdio.h>

/* Over sigma: how wide one Gaussian is at half its height. Nothing in the field is finer. */
static double width_of_one(void)
{
    return 2 * sqrt(2 * log(2));
}

/* Over sigma: the diameter of a long round rod in whose middle the exact field, 1 - exp(-d^2 / (8 sigma^2)),
 * is as high as the threshold; 0: there is none. */
static double thinnest_rod(double threshold)
{
    return threshold < 1 ? sqrt(-8 * log(1 - threshold)) : 0;
}

/* Whether anything is left of the sculpture with that sigma, in cells. */
static bool leaves_something(const struct octree *tree, const struct surface_options *options, double sigma)
{
    struct field_settings settings = options->field;
    struct field field;
    double value, point[3];
    settings.sigma = sigma;
    return !field_init(&field, tree, &settings, NULL) &&
           !field_largest(&field, options->threshold, &value, point, NULL) && value >= options->threshold;
}

/* Whether there is more room within its walls than material in them, as in models of which only the outside
 * was made: such walls are too thin to be smoothed. */
static bool is_shell(struct octree *tree, const struct octree_info *info)
{
    uint64_t hollow;
    return !octree_fill_hollows(tree, 0, &hollow, NULL) && hollow > info->cells;
}

bool coarse_tell(struct octree *tree, const char *file, const struct surface_options *options,
                 const struct mesh *mesh, double cube, char text[COARSE_TEXT])
{
    const double cell = ldexp(1, -(int)tree->depth), detail = cell * width_of_one() * options->field.sigma;
    /* where a Gaussian is one half wider than such cubes need, what is left of cells' steps is smooth too */
    const double sigma = ceil(10 * 1.5 * cube / cell / width_of_one()) / 10;
    const double lost = thinnest_rod(options->threshold) * sigma * cell;
    const struct octree_info info = octree_measure(tree);
    const double kept = mesh_volume(mesh) / ((double)info.cells * cell * cell * cell);
    if (cube <= detail && kept >= 0.5)
        return false;
    const bool shell = is_shell(tree, &info);
    char help[512] = "";
    if (shell)
        snprintf(help, sizeof help,
                 ", or fill the hollow within its thin walls: balloon-sculpt %.400s --solid -o FILE.oct",
                 file);
    else if (lost > 0 && leaves_something(tree, options, sigma))
        snprintf(help, sizeof help,
                 ", or smooth it more: --sigma %.2g, which loses what is thinner than %.2g", sigma, lost);
    if (cube > detail)
        snprintf(
            text, COARSE_TEXT,
            "cubes of %.4g are larger than the sculpture's detail, %.4g: the mesh may be rough, and lack "
            "what is thinner; take more triangles%s",
            cube, detail, help);
    else if (shell)
        snprintf(
            text, COARSE_TEXT,
            "the mesh holds %.2g %% of what the sculpture's material does: walls are lost that are thin for "
            "a sigma of %g; take a smaller one%s",
            100 * kept, options->field.sigma, help);
    return cube > detail || shell;
}
