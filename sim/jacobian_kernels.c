/*
 * Derivatives of springs, dampers and pressure. Compiled once for each set of instructions: SIM_JACOBIAN is
 * the name of the table at the end. All give the same bits, as forces.c does.
 */
#include "sim/jacobian_kernels.h"
#include "sim/forces_math.h"

/*
 * An edge, l = a - b = |l| u, pulls at a with f = -T u, T = k (|l| - r) + d (u . v). As its ends move,
 *     du = (dl - u (u . dl)) / |l|,    dT = k u . dl + d (u . dv + v . du),
 * and since v . du is (v - u (u . v)) . dl / |l|, the force at a changes by
 *     df = -[u (g . dl + d u . dv) + t dl],    t = T / |l|,    g = (k - t) u + d (v - u (u . v)) / |l|.
 * u and t make the first row of what is kept, g and d the second.
 */
static void edges(struct sim *sim, const struct sim_part *part)
{
    const row *position = (row *)sim->position, *velocity = (row *)sim->velocity;
    row(*kept)[2] = (row(*)[2])sim->jacobian->edge;
    const double damping = part->balloon->now->damping;
    for (uint32_t e = part->edge_begin; e < part->edge_end; e++) {
        const uint32_t a = sim->edge_point[e][0], b = sim->edge_point[e][1];
        const row l = position[a] - position[b], v = velocity[a] - velocity[b];
        const double length = sqrt(dot(l, l)), inverse_length = inverse(length);
        if (!sim->edge_active[e] || length == 0) {
            kept[e][0] = kept[e][1] = (row){0};
            continue;
        }
        const double k = sim->current_spring_const[e];
        const row u = inverse_length * l;
        const double speed = dot(u, v);
        const double t = (k * (length - sim->rest_length[e]) + damping * speed) * inverse_length;
        const row g = (k - t) * u + damping * inverse_length * (v - speed * u);
        kept[e][0] = u;
        kept[e][1] = g;
        kept[e][0][3] = t;
        kept[e][1][3] = damping;
    }
}

static void triangles(struct sim *sim, const struct sim_part *part)
{
    const row *x = (row *)sim->position;
    row *kept = (row *)sim->jacobian->triangle;
    for (uint32_t t = part->triangle_begin; t < part->triangle_end; t++) {
        const uint32_t *p = sim->triangle_point[t];
        const row twice_area = cross(x[p[1]] - x[p[0]], x[p[2]] - x[p[0]]);
        const double i = sim->triangle_active[t] ? inverse(sqrt(dot(twice_area, twice_area))) : 0;
        kept[t] = i * twice_area;
        kept[t][3] = i;
    }
}

/* A part's triangle number i: first those of lower parts that reach into it, in order, then its own. */
static inline uint32_t triangle_of(const struct sim_part *part, uint32_t i)
{
    return i < part->triangle_in_count ? part->triangle_in[i]
                                       : part->triangle_begin + i - part->triangle_in_count;
}

static inline uint32_t triangles_of(const struct sim_part *part)
{
    return part->triangle_in_count + part->triangle_end - part->triangle_begin;
}

static inline uint32_t edge_of(const struct sim_part *part, uint32_t i)
{
    return i < part->edge_in_count ? part->edge_in[i] : part->edge_begin + i - part->edge_in_count;
}

static inline uint32_t edges_of(const struct sim_part *part)
{
    return part->edge_in_count + part->edge_end - part->edge_begin;
}

/* The paper's pressure pushes along n = N / |N|, N the sum of the triangles' unit normals. */
static void points(struct sim *sim, const struct sim_part *part)
{
    const row *normal = (row *)sim->jacobian->triangle;
    row *kept = (row *)sim->jacobian->point;
    const uint32_t begin = part->point_begin, own = part->point_end - begin;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        kept[p] = (row){0};
    for (uint32_t i = 0; i < triangles_of(part); i++) {
        const uint32_t t = triangle_of(part, i);
        for (int k = 0; k < 3; k++)
            if (sim->triangle_point[t][k] - begin < own)
                kept[sim->triangle_point[t][k]] += normal[t];
    }
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const double i = inverse(sqrt(dot(kept[p], kept[p])));
        kept[p] *= i;
        kept[p][3] = sim_point_pressure(part->balloon) * i;
    }
}

static void product_edges(struct sim *sim, const struct sim_part *part,
                          const struct jacobian_product *product)
{
    const row(*kept)[2] = (const row(*)[2])sim->jacobian->edge;
    const row *dx = (row *)product->dx, *dv = (row *)product->dv;
    const uint32_t(*point)[2] = (const uint32_t(*)[2])sim->edge_point;
    row *out = (row *)product->out;
    const double a = product->a, b = product->b;
    const uint32_t begin = part->point_begin, own = part->point_end - begin, count = edges_of(part);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t e = edge_of(part, i), p = point[e][0], q = point[e][1];
        const row u = kept[e][0], g = kept[e][1];
        const row dl = a * (dx[p] - dx[q]), ds = b * (dv[p] - dv[q]);
        row f = (dot(g, dl) + g[3] * dot(u, ds)) * u + u[3] * dl;
        f[3] = 0;
        if (p - begin < own)
            out[p] -= f;
        if (q - begin < own)
            out[q] += f;
    }
}

/*
 * As its corners move by dx, a triangle's unit normal n, with the sides s1 and s2 from its
 * first corner, turns by
 *     dn = n x (s2 (n . d1) - s1 (n . d2)) / (2 area),    dk = dx of corner k - dx of corner 0,
 * since only what lifts a corner out of its plane turns it; and the point's by (dN - n (n . dN)) / |N|.
 */
static void product_triangles(struct sim *sim, const struct sim_part *part,
                              const struct jacobian_product *product)
{
    const row *normal = (row *)sim->jacobian->triangle, *x = (row *)sim->position, *dx = (row *)product->dx;
    row *turn = (row *)sim->jacobian->turn;
    const uint32_t(*point)[3] = (const uint32_t(*)[3])sim->triangle_point;
    const uint32_t begin = part->point_begin, own = part->point_end - begin, count = triangles_of(part);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *p = point[triangle_of(part, i)];
        const row n = normal[triangle_of(part, i)];
        const double lift1 = dot(n, dx[p[1]] - dx[p[0]]), lift2 = dot(n, dx[p[2]] - dx[p[0]]);
        const row dn = n[3] * cross(n, lift1 * (x[p[2]] - x[p[0]]) - lift2 * (x[p[1]] - x[p[0]]));
        for (int k = 0; k < 3; k++)
            if (p[k] - begin < own)
                turn[p[k]] += dn;
    }
}

static void product(struct sim *sim, const struct sim_part *part, const struct jacobian_product *product)
{
    row *out = (row *)product->out, *turn = (row *)sim->jacobian->turn;
    const row *normal = (row *)sim->jacobian->point;
    const bool pressed = sim_point_pressure(part->balloon) != 0 && product->a != 0;
    for (uint32_t p = part->point_begin; p < part->point_end; p++)
        out[p] = turn[p] = (row){0};
    if (pressed)
        product_triangles(sim, part, product);
    for (uint32_t p = part->point_begin; pressed && p < part->point_end; p++) {
        const row n = {normal[p][0], normal[p][1], normal[p][2], 0};
        out[p] = product->a * normal[p][3] * (turn[p] - dot(n, turn[p]) * n);
    }
    if (!part->balloon->membrane)
        product_edges(sim, part, product);
}

/* Of a triangle whose corners' rows are x and dx: twice its vector area, and how much it turns. */
struct turned {
    row twice, turn;
};

/* N = s1 x s2, dN = d1 x s2 + s1 x d2. */
static inline struct turned turn_of(const row *x, const row *dx, const uint32_t p[3])
{
    const row s1 = x[p[1]] - x[p[0]], s2 = x[p[2]] - x[p[0]];
    const row d1 = dx[p[1]] - dx[p[0]], d2 = dx[p[2]] - dx[p[0]];
    return (struct turned){cross(s1, s2), cross(d1, s2) + cross(s1, d2)};
}

static inline void add_to_own(const struct sim_part *part, row *out, uint32_t point, row what)
{
    if (point - part->point_begin < part->point_end - part->point_begin)
        out[point] += what;
}

/* F = q N/6 with q = c + d . x: dF = (q dN + dq N)/6. */
static void add_areas(const struct areas_product *product, const struct sim_part *part, const row *x,
                      const uint32_t p[3], bool alike)
{
    const double *d = product->pressure.gradient, *change = product->change.gradient;
    const row *dx = (row *)product->dx, slope = {d[0], d[1], d[2], 0},
              slope_change = {change[0], change[1], change[2], 0};
    const struct turned n = turn_of(x, dx, p);
    const double sixth = product->a / 6, c = product->pressure.constant, dc = product->change.constant;
    const row same = sixth * (c * n.turn + dc * n.twice);
    for (int k = 0; k < 3; k++) {
        row what = same;
        if (!alike)
            what += sixth * (dot(slope, x[p[k]]) * n.turn +
                             (dot(slope_change, x[p[k]]) + dot(slope, dx[p[k]])) * n.twice);
        add_to_own(part, (row *)product->df, p[k], what);
    }
}

static bool is_zero(const double x[4])
{
    return x[0] == 0 && x[1] == 0 && x[2] == 0;
}

static void areas(struct sim *sim, const struct sim_part *part, const struct areas_product *product)
{
    const bool alike = is_zero(product->pressure.gradient) && is_zero(product->change.gradient);
    const uint32_t first = part->balloon->point_begin;
    for (uint32_t i = 0; i < triangles_of(part); i++) {
        const uint32_t t = triangle_of(part, i), *p = sim->triangle_point[t];
        if (sim->triangle_active[t] && (!product->held || product->held[p[0] - first]))
            add_areas(product, part, (row *)sim->position, p, alike);
    }
}

/* block += factor u g^T. */
static inline void add_outer(row block[3], double factor, row u, row g)
{
    for (int i = 0; i < 3; i++)
        block[i] += factor * u[i] * g;
}

/* The share of a triangle in how its corner's normal turns when that corner alone moves: dn = -h (n . dx),
 * with h the gradient of the corner's barycentric coordinate, n x (the side across) / (2 area). */
static row gradient(const row *x, const uint32_t *p, int corner, row n)
{
    return n[3] * cross(n, x[p[(corner + 2) % 3]] - x[p[(corner + 1) % 3]]);
}

static void diagonal_of_pressure(struct sim *sim, const struct sim_part *part, double a, row (*block)[3])
{
    const row *normal = (row *)sim->jacobian->triangle, *point = (row *)sim->jacobian->point;
    const row *x = (row *)sim->position;
    const uint32_t begin = part->point_begin, own = part->point_end - begin;
    for (uint32_t i = 0; i < triangles_of(part); i++) {
        const uint32_t t = triangle_of(part, i), *p = sim->triangle_point[t];
        const row n = {normal[t][0], normal[t][1], normal[t][2], 0};
        for (int k = 0; k < 3; k++)
            if (p[k] - begin < own) {
                const row m = {point[p[k]][0], point[p[k]][1], point[p[k]][2], 0};
                const row h = gradient(x, p, k, normal[t]);
                add_outer(block[p[k]], a * point[p[k]][3], h - dot(m, h) * m, n);
            }
    }
}

static void diagonal(struct sim *sim, const struct sim_part *part, double a, double b, double (*blocks)[3][4])
{
    row(*block)[3] = (row(*)[3])blocks;
    const row(*kept)[2] = (const row(*)[2])sim->jacobian->edge;
    const uint32_t begin = part->point_begin, own = part->point_end - begin;
    for (uint32_t p = begin; p < part->point_end; p++)
        for (int i = 0; i < 3; i++) {
            block[p][i] = (row){0};
            block[p][i][i] = sim->mass[p];
        }
    for (uint32_t i = 0; i < edges_of(part); i++) {
        const uint32_t e = edge_of(part, i);
        const double t = a * kept[e][0][3], d = b * kept[e][1][3];
        const row u = {kept[e][0][0], kept[e][0][1], kept[e][0][2], 0};
        const row g = {kept[e][1][0], kept[e][1][1], kept[e][1][2], 0};
        for (int k = 0; k < 2; k++) {
            const uint32_t p = sim->edge_point[e][k];
            if (p - begin >= own)
                continue;
            add_outer(block[p], 1, u, a * g + d * u);
            for (int j = 0; j < 3; j++)
                block[p][j][j] += t;
        }
    }
    if (sim_point_pressure(part->balloon) != 0)
        diagonal_of_pressure(sim, part, a, block);
}

extern const struct jacobian_kernels SIM_JACOBIAN;
const struct jacobian_kernels SIM_JACOBIAN = {edges, triangles, points, product, areas, diagonal};
