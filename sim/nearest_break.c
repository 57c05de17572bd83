#include "sim/nearest_break.h"
#include "sim/fracture.h"

#include <math.h>

/* What is hardly stretched waits for no burst; and what bears more than a thousandfold is to have none. */
static const double hardly = 1.1, far_beyond = 1000;

static void keep_nearer(const struct sim *sim, const struct sim_balloon *b, double stretch, double most,
                        struct nearest_break *nearest)
{
    if (!(stretch / most > nearest->share) || stretch < hardly || most > far_beyond)
        return;
    *nearest = (struct nearest_break){.share = stretch / most,
                                      .time = sim->time,
                                      .stretch = stretch,
                                      .most = most,
                                      .balloon = (size_t)(b - sim->balloons),
                                      .tears = b->fracture};
}

/* The edge that is longest over what it bears. */
static void look_at_edges(const struct sim *sim, const struct sim_balloon *b, struct nearest_break *nearest)
{
    double most = 0;
    uint32_t found = b->edge_begin;
    for (uint32_t e = b->edge_begin; e < b->edge_end; e++) {
        const double share = sim->edge_active[e] ? sim_edge_length(sim, e) / sim_threshold(sim, b, e) : 0;
        if (share > most) {
            most = share;
            found = e;
        }
    }
    if (most > 0)
        keep_nearer(sim, b, sim_edge_length(sim, found) / sim->rest_length[found],
                    sim_threshold(sim, b, found) / sim->rest_length[found], nearest);
}

void nearest_break_look(const struct sim *sim, struct nearest_break *nearest)
{
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        double held, borne;
        if (!b->fracture)
            look_at_edges(sim, b, nearest);
        else if (fracture_nearest(b, &held, &borne))
            keep_nearer(sim, b, fracture_equal_stretch(held), fracture_equal_stretch(borne), nearest);
    }
}
