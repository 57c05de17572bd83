/* What closes a torn skin, and what gets out where it is open. */
#include "common/vec3.h"
#include "sim/gas.h"
#include "sim/gas_torn.h"

#include <string.h>

static uint32_t hole_of(const struct gas_rims *rims, uint32_t side)
{
    return rims->hole_count > GAS_HOLES_MAX ? 0 : rims->hole[side];
}

void gas_find_holes(const struct sim *sim, const struct sim_balloon *balloon)
{
    if (balloon->gas->torn)
        gas_torn_follow(sim, balloon);
    gas_measure_holes(sim, balloon->rims, &balloon->gas->holes);
}

void gas_measure_holes(const struct sim *sim, const struct gas_rims *rims, struct gas_holes *holes)
{
    holes->count = 0;
    if (!rims || rims->side_count == 0)
        return;
    memset(holes, 0, sizeof *holes);
    holes->count = rims->hole_count > GAS_HOLES_MAX ? 1 : rims->hole_count;
    for (uint32_t i = 0; i < rims->side_count; i++) {
        const uint32_t h = hole_of(rims, i);
        for (int k = 0; k < 3; k++)
            holes->middle[h][k] += sim->position[rims->side[i][0]][k];
        holes->sides[h]++;
    }
    for (uint32_t h = 0; h < holes->count; h++)
        for (int k = 0; k < 3 && holes->sides[h]; k++)
            holes->middle[h][k] /= holes->sides[h];
    for (uint32_t i = 0; i < rims->side_count; i++) {
        const uint32_t h = hole_of(rims, i);
        double twice[3];
        vec3_triangle(holes->middle[h], sim->position[rims->side[i][0]], sim->position[rims->side[i][1]],
                      twice);
        for (int k = 0; k < 3; k++)
            holes->area[h][k] += twice[k] / 2;
    }
}

double gas_fan_volume(const struct gas_holes *holes, const double origin[3])
{
    double volume = 0;
    for (uint32_t h = 0; h < holes->count; h++) {
        double middle[3];
        vec3_sub(holes->middle[h], origin, middle);
        volume -= vec3_dot(middle, holes->area[h]) / 3;
    }
    return volume;
}

static double squared_height(const double x[3], const double origin[3], const double down[3])
{
    double from[3];
    vec3_sub(x, origin, from);
    return vec3_dot(down, from) * vec3_dot(down, from);
}

double gas_fan_moment(const struct sim *sim, const struct sim_balloon *balloon, const double origin[3],
                      const double down[3])
{
    const struct gas_holes *holes = &balloon->gas->holes;
    const struct gas_rims *rims = balloon->rims;
    double sum = 0;
    for (uint32_t i = 0; holes->count && i < rims->side_count; i++) {
        const double *middle = holes->middle[hole_of(rims, i)], *a = sim->position[rims->side[i][0]],
                     *b = sim->position[rims->side[i][1]];
        double twice[3];
        vec3_triangle(middle, b, a, twice);
        sum += vec3_dot(down, twice) * (squared_height(middle, origin, down) +
                                        squared_height(a, origin, down) + squared_height(b, origin, down));
    }
    return sum / (12 * vec3_dot(down, down));
}

/* Of the fan's triangle (middle, b, a) as of any other of the closed surface: its twice area times the sum of
 * the ways of its corners, over 6. */
double gas_fan_change(const struct sim *sim, const struct sim_balloon *balloon, double (*dx)[4])
{
    const struct gas_holes *holes = &balloon->gas->holes;
    const struct gas_rims *rims = balloon->rims;
    double way[GAS_HOLES_MAX][3], change = 0;
    memset(way, 0, sizeof way);
    for (uint32_t i = 0; holes->count && i < rims->side_count; i++)
        for (int k = 0; k < 3; k++)
            way[hole_of(rims, i)][k] += dx[rims->side[i][0]][k] / holes->sides[hole_of(rims, i)];
    for (uint32_t i = 0; holes->count && i < rims->side_count; i++) {
        const uint32_t h = hole_of(rims, i), a = rims->side[i][0], b = rims->side[i][1];
        double twice[3];
        vec3_triangle(holes->middle[h], sim->position[b], sim->position[a], twice);
        for (int k = 0; k < 3; k++)
            change += twice[k] * (way[h][k] + dx[a][k] + dx[b][k]) / 6;
    }
    return change;
}

static double neck_area(const struct gas *gas)
{
    return gas->memory.neck_open ? gas->scene->neck : 0;
}

double gas_openings(const struct gas *gas)
{
    double area = neck_area(gas);
    for (uint32_t h = 0; h < gas->holes.count; h++)
        area += vec3_length(gas->holes.area[h]);
    return area;
}

/* to += factor x the thrust of the last jets on each point: at rims what is beyond the pressure that is
 * missing there, alike on all of the rim; at the neck against the way in which it looks. */
static void add_thrust(const struct sim *sim, const struct sim_balloon *balloon, void *context,
                       void (*add)(void *context, uint32_t point, const double force[3]))
{
    const struct gas *gas = balloon->gas;
    const struct gas_holes *holes = &gas->holes;
    double out[3] = {0}, force[3];
    for (uint32_t i = 0; holes->count && i < balloon->rims->side_count; i++) {
        const uint32_t h = hole_of(balloon->rims, i);
        for (int k = 0; k < 3; k++)
            force[k] = gas->rim_thrust * holes->area[h][k] / holes->sides[h];
        add(context, balloon->rims->side[i][0], force);
    }
    for (uint32_t i = 0; i < gas->neck.count; i++)
        for (int k = 0; k < 3; k++)
            out[k] += sim->normal[gas->neck.point[i]][k];
    const double length = vec3_length(out);
    for (uint32_t i = 0; i < gas->neck.count && length > 0; i++) {
        for (int k = 0; k < 3; k++)
            force[k] = -gas->neck_thrust * out[k] / length / gas->neck.first *
                       patch_share(sim, &gas->neck, i);
        add(context, gas->neck.point[i], force);
    }
}

static void add_force(void *context, uint32_t point, const double force[3])
{
    double(*rows)[4] = context;
    for (int k = 0; k < 3; k++)
        rows[point][k] += force[k];
}

struct power {
    const struct sim *sim;
    double sum;
};

static void add_power(void *context, uint32_t point, const double force[3])
{
    struct power *power = context;
    power->sum += vec3_dot(force, power->sim->velocity[point]);
}

double gas_thrust_power(const struct sim *sim, const struct sim_balloon *balloon)
{
    struct power power = {sim, 0};
    add_thrust(sim, balloon, &power, add_power);
    return power.sum;
}

/* Air that is drawn in pushes at nothing: its speed is lost inside. */
void gas_let_out(struct sim *sim, struct sim_balloon *balloon)
{
    struct gas *gas = balloon->gas;
    const struct scene_gas *scene = gas->scene;
    const double area = gas_openings(gas);
    gas->rim_thrust = gas->neck_thrust = 0;
    if (area == 0)
        return;
    const struct gas_drive in = gas_drive(sim, balloon);
    const double gauge = in.pressure - gas->outside, most = in.to_even * fabs(gauge);
    if (gauge > 0) {
        const double turbulent = fmax(gauge, GAS_LAMINAR * in.pressure);
        const struct gas_jet jet = gas_jet(in.pressure, in.density, in.pressure - turbulent, scene->gamma,
                                           scene->discharge);
        const double rate = jet.flux * area * in.amount_of_mass,
                     share = fmin(gauge / turbulent, rate > most ? most / rate : 1);
        gas->flow_held |= gauge == turbulent && rate > most;
        gas_stream(sim, balloon, -share * rate, in.warmth);
        sim->scalar_rate[gas->scalar + GAS_BROUGHT] -= share * rate;
        gas->rim_thrust = share * jet.thrust - gauge;
        gas->neck_thrust = share * jet.thrust * neck_area(gas);
        add_thrust(sim, balloon, sim->force, add_force);
    } else if (gauge < 0) {
        const double turbulent = fmax(-gauge, GAS_LAMINAR * gas->outside);
        const struct gas_jet jet = gas_jet(gas->outside, scene->density * (gas->outside / scene->ambient),
                                           gas->outside - turbulent, scene->gamma, scene->discharge);
        const double whole = jet.flux * area * in.amount_of_mass * (-gauge / turbulent),
                     rate = fmin(whole, most);
        gas->flow_held |= -gauge == turbulent && whole > most;
        gas_stream(sim, balloon, rate, 1);
        sim->scalar_rate[gas->scalar + GAS_BROUGHT] += rate;
    }
}

/* Those within a circle of the neck's area, at rest. */
enum status gas_find_neck(struct sim *sim, const struct sim_balloon *balloon, struct error *err)
{
    struct gas *gas = balloon->gas;
    const double reach = sqrt(gas->scene->neck / M_PI) / balloon->radius * 180 / M_PI;
    return patch_open(sim, balloon, gas->scene->neck_place, fmin(reach, 90), "the neck", &gas->neck, err);
}
