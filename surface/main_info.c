#include "surface/main_info.h"

#include <stdio.h>

static void print_shape(const struct surface_info *info)
{
    const struct surface_shape *shape = &info->shape;
    printf("triangles        %u\n", info->mesh->triangle_count);
    printf("points           %u\n", info->mesh->point_count);
    printf("components       %zu\n", shape->components);
    printf("euler            %ld\n", shape->euler);
    printf("volume           %.9g\n", shape->volume);
    printf("area             %.9g\n", shape->area);
    printf("cube_size        %.9g\n", info->stats->cube_size);
    printf("mean_edge        %.6g\n", shape->mean_edge);
    printf("shortest_edge    %.4f of the mean\n", shape->shortest_edge / shape->mean_edge);
    printf("longest_edge     %.4f of the mean\n", shape->longest_edge / shape->mean_edge);
    printf("smallest_angle   %.2f degrees\n", shape->smallest_angle_deg);
}

static void print_cost(const struct surface_info *info)
{
    const struct surface_stats *stats = info->stats;
    double triangles = info->mesh->triangle_count;
    printf("worst_residual   %.2e of |f - T| at a point\n", info->distance.worst_residual);
    printf("mean_residual    %.2e\n", info->distance.mean_residual);
    printf("flatness         %.3g from the surface to the triangles, %.3g at most\n", info->distance.rms,
           info->distance.largest);
    printf("evaluations      %.2f a triangle at points, %.2f on the grid\n",
           (double)stats->evaluations / triangles, (double)stats->samples / triangles);
    printf("memory           %.0f bytes a triangle\n", (double)stats->bytes / triangles);
    if (info->options->seeds == SURFACE_RANDOM)
        printf("seeds            %zu of %zu parts found by random points alone\n", stats->seeds_random,
               stats->seeds);
    else
        printf("seeds            %zu parts found by descent\n", stats->seeds);
}

/* A bin of a histogram: its share as a number and as a bar. */
static void print_bin(const char *name, double low, double high, double count, double all)
{
    static const char bar[] = "########################################";
    if (count > 0)
        printf("%-9s %4g-%-4g %9.0f  %5.1f %%  %.*s\n", name, low, high, count, 100 * count / all,
               (int)(40 * count / all + 0.5), bar);
}

static void print_bins(const struct surface_info *info)
{
    const struct surface_census *c = &info->census;
    for (int i = 0; i < CENSUS_ANGLES; i++)
        print_bin("angles", 10 * i, 10 * (i + 1), (double)c->angles[i], 3.0 * info->mesh->triangle_count);
    for (int i = 0; i < CENSUS_EDGES; i++)
        print_bin("edges", 0.1 * i,
                  i + 1 < CENSUS_EDGES ? 0.1 * (i + 1) : info->shape.longest_edge / info->shape.mean_edge,
                  c->edges[i], info->mesh->edge_count);
    for (int i = 0; i < CENSUS_VALENCES; i++)
        if (c->valences[i])
            printf("valence   %d%-8s %9u  %5.1f %%\n", i, i + 1 < CENSUS_VALENCES ? "" : "+", c->valences[i],
                   100.0 * c->valences[i] / info->mesh->point_count);
}

void info_print_text(const struct surface_info *info)
{
    print_shape(info);
    print_cost(info);
    for (size_t i = 0; i < info->census.part_count; i++) {
        const struct surface_part *part = &info->census.parts[i];
        printf("part %-11zu %u triangles, euler %ld, genus %ld, volume %.9g%s, area %.9g\n", i + 1,
               part->triangles, part->euler, part->genus, part->volume, part->volume < 0 ? " (a cavity)" : "",
               part->area);
    }
    print_bins(info);
}

static void print_list(const char *name, const uint64_t *counts, int count, const char *end)
{
    printf("  \"%s\": [", name);
    for (int i = 0; i < count; i++)
        printf("%s%llu", i ? ", " : "", (unsigned long long)counts[i]);
    printf("]%s\n", end);
}

static void print_histograms(const struct surface_census *c)
{
    uint64_t edges[CENSUS_EDGES], valences[CENSUS_VALENCES];
    for (int i = 0; i < CENSUS_EDGES; i++)
        edges[i] = c->edges[i];
    for (int i = 0; i < CENSUS_VALENCES; i++)
        valences[i] = c->valences[i];
    print_list("angles_by_10_degrees", c->angles, CENSUS_ANGLES, ",");
    print_list("edges_by_tenths_of_the_mean", edges, CENSUS_EDGES, ",");
    print_list("valences", valences, CENSUS_VALENCES, ",");
}

void info_print_json(const struct surface_info *info)
{
    const struct surface_shape *s = &info->shape;
    const struct surface_stats *stats = info->stats;
    const struct surface_distance *d = &info->distance;
    printf("{\n  \"triangles\": %u,\n  \"points\": %u,\n  \"edges\": %u,\n", info->mesh->triangle_count,
           info->mesh->point_count, info->mesh->edge_count);
    printf("  \"components\": %zu,\n  \"euler\": %ld,\n  \"volume\": %.17g,\n  \"area\": %.17g,\n",
           s->components, s->euler, s->volume, s->area);
    printf("  \"cube_size\": %.17g,\n  \"mean_edge\": %.17g,\n  \"shortest_edge_over_mean\": %.9g,\n",
           stats->cube_size, s->mean_edge, s->shortest_edge / s->mean_edge);
    printf("  \"longest_edge_over_mean\": %.9g,\n  \"smallest_angle_deg\": %.9g,\n",
           s->longest_edge / s->mean_edge, s->smallest_angle_deg);
    printf("  \"worst_residual\": %.6g,\n  \"mean_residual\": %.6g,\n  \"rms_distance\": %.9g,\n"
           "  \"largest_distance\": %.9g,\n",
           d->worst_residual, d->mean_residual, d->rms, d->largest);
    printf("  \"evaluations\": %llu,\n  \"samples\": %llu,\n  \"bytes\": %zu,\n",
           (unsigned long long)stats->evaluations, (unsigned long long)stats->samples, stats->bytes);
    print_histograms(&info->census);
    printf("  \"parts\": [\n");
    for (size_t i = 0; i < info->census.part_count; i++) {
        const struct surface_part *part = &info->census.parts[i];
        printf(
            "    {\"triangles\": %u, \"euler\": %ld, \"genus\": %ld, \"volume\": %.17g, \"area\": %.17g}%s\n",
            part->triangles, part->euler, part->genus, part->volume, part->area,
            i + 1 < info->census.part_count ? "," : "");
    }
    printf("  ]\n}\n");
}
