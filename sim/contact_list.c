/* For which lines the list of pairs is made, and how long it holds. */
#include "common/vec3.h"
#include "sim/contact.h"
#include "sim/rows.h"
#include "sim/sweep.h"

/* A tenth of the mean edge as it is now: more, and neighbours in a sheet come onto the list; less, and it is made more often. Of a sample. */
static double choose_stray(const struct sim *sim)
{
    enum { SAMPLE = 512 };
    double least = INFINITY;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++) {
        const uint32_t stride = (b->edge_end - b->edge_begin) / SAMPLE + 1;
        double sum = 0, count = 0;
        for (uint32_t e = b->edge_begin; e < b->edge_end; e += stride, count++)
            sum += vec3_distance(sim->position[sim->edge_point[e][0]], sim->position[sim->edge_point[e][1]]);
        least = fmin(least, fmin(sum / count, 4 * b->mean_rest_length));
    }
    return least / 10;
}

/* As many steps as the last list held for; more where it came to its end with room to spare. What is strayed grows with their square. */
static uint64_t choose_horizon(const struct sim *sim)
{
    enum { HORIZON_MAX = 1024 };
    const struct contact_memory *memory = &sim->contact->memory;
    const uint64_t held = sim->steps - memory->made_in, horizon = memory->horizon;
    if (memory->made == 0 || held == 0)
        return 1;
    if (held < horizon || memory->used > 0.5)
        return held < horizon ? held : horizon;
    const uint64_t more = memory->used < 0.2 ? 2 * horizon : horizon + (horizon + 3) / 4;
    return more < HORIZON_MAX ? more : HORIZON_MAX;
}

static void lay_lines(struct sim *sim, const struct sim_part *part, void *context)
{
    const double steps = *(const double *)context;
    const row *position = (const row *)sim->position, *before = (const row *)sim->before;
    row *from = (row *)sim->contact->from, *to = (row *)sim->contact->to;
    double longest = 0;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        const row way = position[p] - before[p], squares = way * way;
        from[p] = before[p];
        to[p] = before[p] + steps * way;
        longest = fmax(longest, squares[0] + squares[1] + squares[2]);
    }
    sim->contact->strayed[part - sim->parts] = longest;
}

static enum status make(struct sim *sim, uint64_t horizon, struct error *err)
{
    struct contact *c = sim->contact;
    c->memory.horizon = horizon;
    c->memory.made_in = sim->steps;
    c->memory.made++;
    c->memory.stray = choose_stray(sim);
    c->memory.began = c->now = (struct contact_drift){.growth = 1};
    c->used = 0;
    double steps = (double)horizon;
    sim_each_part(sim, lay_lines, &steps);
    c->memory.pace = 0;
    for (size_t i = 0; i < sim->part_count; i++)
        c->memory.pace = fmax(c->memory.pace, sqrt(c->strayed[i]));
    return contact_list_find(sim, err);
}

/* Where too much would come near in many steps, for one. */
enum status contact_list_make(struct sim *sim, struct error *err)
{
    const uint64_t horizon = choose_horizon(sim);
    enum status status = make(sim, horizon, err);
    return status && horizon > 1 ? make(sim, 1, err) : status;
}

double contact_list_gone(const struct sim *sim)
{
    const struct contact_memory *memory = &sim->contact->memory;
    return (double)(sim->steps - memory->made_in + 1) / (double)memory->horizon;
}

/* A balloon that moves and grows as a whole brings nothing nearer to itself: x = middle + growth (its place on its line - their middle). Of
 * a sample of points, since any such motion will do. */
struct motion {
    double middle[3], from[3], growth;
    double gone;
};

static inline void on_line(const struct contact *c, uint32_t p, double gone, row *place)
{
    const row from = *(const row *)c->from[p];
    *place = from + gone * (*(const row *)c->to[p] - from);
}

static struct motion motion_of(const struct sim *sim, const struct sim_balloon *b, double gone)
{
    enum { SAMPLE = 256 };
    const row *x = (const row *)sim->position;
    struct motion m = {.growth = 1, .gone = gone};
    const uint32_t count = b->point_end - b->point_begin, stride = count / SAMPLE + 1;
    double sampled = 0, along = 0, square = 0;
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride, sampled++) {
        row at;
        on_line(sim->contact, p, gone, &at);
        for (int i = 0; i < 3; i++) {
            m.middle[i] += x[p][i];
            m.from[i] += at[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        m.middle[i] /= sampled;
        m.from[i] /= sampled;
    }
    for (uint32_t p = b->point_begin; p < b->point_end; p += stride) {
        row at;
        on_line(sim->contact, p, gone, &at);
        for (int i = 0; i < 3; i++) {
            along += (x[p][i] - m.middle[i]) * (at[i] - m.from[i]);
            square += (at[i] - m.from[i]) * (at[i] - m.from[i]);
        }
    }
    if (square > 0 && along > 0)
        m.growth = along / square;
    return m;
}

struct stray_job {
    struct motion *motion; /* of the balloon that the part is of; the same for all its parts */
    const struct sim_balloon *balloon;
};

static void stray_part(struct sim *sim, const struct sim_part *part, void *context)
{
    const struct stray_job *job = context;
    const struct motion *m = job->motion;
    const row *position = (const row *)sim->position;
    const row shift = {m->middle[0] - m->growth * m->from[0], m->middle[1] - m->growth * m->from[1],
                       m->middle[2] - m->growth * m->from[2], 0};
    double largest = 0;
    if (part->balloon != job->balloon)
        return;
    for (uint32_t p = part->point_begin; p < part->point_end; p++) {
        row at;
        on_line(sim->contact, p, m->gone, &at);
        const row off = position[p] - m->growth * at - shift, squares = off * off;
        const double square = squares[0] + squares[1] + squares[2];
        largest = square > largest ? square : largest;
    }
    sim->contact->strayed[part - sim->parts] = largest;
}

/* Another balloon near it is brought nearer by such a motion. */
static bool is_alone(const struct sim *sim)
{
    return sim->balloon_count == 1;
}

/* Distances between images of points under a motion grow with it, but the room that is wanted does not: what shrinks has less to stray. */
static bool balloon_holds(struct sim *sim, const struct sim_balloon *b)
{
    struct contact *c = sim->contact;
    struct motion motion = {.growth = 1, .gone = contact_list_gone(sim)};
    if (is_alone(sim) && c->memory.made_in != sim->steps)
        motion = motion_of(sim, b, motion.gone);
    const double growth = motion.growth < 1 ? motion.growth : 1,
                 allowed = growth * c->memory.stray - (1 - growth) * c->thickness / 2;
    double largest = 0;
    sim_each_part(sim, stray_part, &(struct stray_job){&motion, b});
    for (size_t i = 0; i < sim->part_count; i++)
        if (sim->parts[i].balloon == b)
            largest = fmax(largest, c->strayed[i]);
    c->now.growth = fmin(c->now.growth, growth);
    c->now.stray = fmax(c->now.stray, sqrt(largest));
    c->used = fmax(c->used, sqrt(largest) / allowed);
    return allowed > 0 && largest <= allowed * allowed;
}

/* Where nothing is near, the point that has strayed most may since have gone a step's longest way to one side, and its line to the other,
 * which growth makes no more than twice as long. */
static bool surely_holds(struct sim *sim)
{
    struct contact *c = sim->contact;
    if (c->memory.is_awake || sim->changed)
        return false;
    const double allowed = c->memory.began.growth * c->memory.stray -
                           (1 - c->memory.began.growth) * c->thickness / 2,
                 most = c->memory.began.stray + sweep_saw_farthest(sim) + 2 * c->memory.pace;
    if (!(most < allowed / 2))
        return false;
    c->now = (struct contact_drift){c->memory.began.growth, most};
    c->used = most / allowed;
    return true;
}

bool contact_list_holds(struct sim *sim)
{
    if (sim->steps - sim->contact->memory.made_in >= sim->contact->memory.horizon)
        return false;
    if (surely_holds(sim))
        return true;
    sim->contact->now = (struct contact_drift){.growth = 1};
    sim->contact->used = 0;
    for (const struct sim_balloon *b = sim->balloons; b < sim->balloons + sim->balloon_count; b++)
        if (!balloon_holds(sim, b))
            return false;
    return true;
}
