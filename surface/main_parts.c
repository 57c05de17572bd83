#include "surface/main_parts.h"

#include "surface/census.h"

#include <math.h>
#include <stdio.h>

/* How many enclose no material, and the largest one's share of all area. */
static size_t find_hollows(const struct surface_census *census, double *largest)
{
    size_t hollows = 0;
    double all = 0, most = 0;
    for (size_t i = 0; i < census->part_count; i++) {
        all += census->parts[i].area;
        most = fmax(most, census->parts[i].area);
        hollows += census->parts[i].volume < 0;
    }
    *largest = most / all;
    return hollows;
}

enum status parts_tell(const struct mesh *mesh, const char *file, bool *several, char text[PARTS_TEXT],
                       struct error *err)
{
    struct surface_census census;
    double largest;
    const enum status status = surface_count_parts(mesh, &census, err);
    if (status)
        return status;
    const size_t count = census.part_count, hollows = find_hollows(&census, &largest);
    surface_census_clear(&census);
    *several = count > 1;
    char fill[640] = "";
    if (hollows > 0)
        snprintf(fill, sizeof fill, "; %zu %s: balloon-sculpt %.400s --solid -o FILE.oct fills %s", hollows,
                 hollows == 1 ? "is the wall of a hollow within" : "are walls of hollows within", file,
                 hollows == 1 ? "it" : "them");
    snprintf(text, PARTS_TEXT,
             "the mesh is no single balloon but %zu parts that do not hang together, the largest with %.3g "
             "%% of the area%s%s",
             count, 100 * largest,
             count - hollows > 1 ? "; a larger --sigma or a smaller --threshold joins what is near" : "",
             fill);
    return STATUS_OK;
}
