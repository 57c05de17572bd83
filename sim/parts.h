/* How points, edges and triangles are shared out among workers and in what order (parts.c). */
#ifndef SIM_PARTS_H
#define SIM_PARTS_H

#include "common/mesh.h"
#include "common/status.h"

#include <stdbool.h>
#include <stdint.h>

struct sim;
struct sim_balloon;

/* A share of one balloon's points: whoever works on it writes to these alone, and adds up what
 * acts on a point in the order of edges and triangles, so that sums are equal to the bit
 * however many parts there are. */
struct sim_part {
    struct sim_balloon *balloon;
    uint32_t point_begin, point_end;
    uint32_t inner_begin, inner_end;       /* of them no other part reads these */
    uint32_t edge_begin, edge_end;         /* the edges whose lower point is here */
    uint32_t triangle_begin, triangle_end; /* the triangles whose lowest point is here */
    uint32_t *edge_in, edge_in_count; /* edges of lower parts that end here, in order, new ones before them */
    uint32_t *triangle_in, triangle_in_count; /* owned */
    uint32_t *edge_in_own;                    /* what edge_in lies in; owned */
    uint32_t edge_in_new, edge_in_room, triangle_in_room;
    struct sim_chunk *chunks; /* [chunk_count] owned */
    uint32_t chunk_count;
};

/* A stretch of a part that stays in a core's cache while all its forces are worked out; after it the forces
 * on its points are complete, since edges and triangles stand in the order of their lowest points. */
struct sim_chunk {
    uint32_t point_begin, point_end;
    uint32_t clear_begin, clear_end;       /* points that are touched here for the first time */
    uint32_t edge_begin, edge_end;         /* whose lower point is here */
    uint32_t edge_inner_end;               /* up to this one all their points are the part's */
    uint32_t triangle_begin, triangle_end; /* likewise */
    uint32_t triangle_inner_end;
    /* The same while nothing has got points of the last part. */
    uint32_t edge_inner_most, triangle_inner_most;
};

/* Runs function on every part, each on its worker, and returns when all are done. */
void sim_each_part(struct sim *sim,
                   void (*function)(struct sim *sim, const struct sim_part *part, void *context),
                   void *context);

/* Orders edges and triangles by their points and shares out the points among the workers (parts.c).
 * edge_place[i] becomes where edge i of the mesh goes, from 0 on; triangle_place likewise. */
void parts_order(const struct mesh *mesh, uint32_t *edge_place, uint32_t *triangle_place, uint32_t *count);
enum status parts_open(struct sim *sim, struct error *err);
void parts_close(struct sim *sim);

/* For cuts (topology.h; parts_torn.c). Makes the part of new points, a balloon's last; false: no memory. */
bool parts_make_tail(struct sim *sim, struct sim_part *tail);
/* None of these allocates. The part of new points reaches this far; a new edge comes into the parts of its
 * points; an edge or a triangle has got points that another part works on. */
void parts_extend(struct sim_part *tail, uint32_t point_end, uint32_t edge_end);
void parts_new_edge(struct sim *sim, const struct sim_balloon *balloon, uint32_t edge);
void parts_loosen_edge(struct sim *sim, const struct sim_balloon *balloon, uint32_t edge);
void parts_loosen_triangle(struct sim *sim, const struct sim_balloon *balloon, uint32_t triangle);
/* The balloon's points have other numbers, place[number less the balloon's first] (reorder.h): each part has
 * the new points of its old ones, and from tail_begin on the last part has them. Edges know theirs. */
void parts_renumber(struct sim *sim, const struct sim_balloon *balloon, const uint32_t *place,
                    uint32_t tail_begin);

#endif
