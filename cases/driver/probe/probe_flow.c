/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of volumes, of what passes a plane, and of how far soil has come. */
#include "cases/driver/probe/probe_boulder.h"
#include "cases/driver/probe/probe_row_internal.h"

#include "core/base/math.h"

#include <string.h>

typedef mor_probe_view view;

/* ---- Volumes ----------------------------------------------------------------------------------------------------- */

static mor_status volume(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = 0.0;
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        *value += v->points.mass[i] / v->points.density[i];
    }
    return MOR_OK;
}

/* Distance of a place from the plane through the origin of a probe, along its direction or path, m. */
static double find_distance(const view *v, const double *place)
{
    const double offset[3] = {place[0] - v->frame.origin[0], place[1] - v->frame.origin[1],
                              place[2] - v->frame.origin[2]};
    return mor_vector_dot(offset, v->frame.direction);
}

static mor_status volume_beyond(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = 0.0;
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        const bool is_beyond = find_distance(v, v->points.position + 3 * i) > 0.0;
        *value += is_beyond ? v->points.mass[i] / v->points.density[i] : 0.0;
    }
    return MOR_OK;
}

static mor_status deposit_volume(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = 0.0;
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        const bool is_at_rest = mor_vector_length(v->velocity + 3 * i) <= v->probe->speed;
        *value += is_at_rest ? v->points.mass[i] / v->points.density[i] : 0.0;
    }
    return MOR_OK;
}

/* ---- Through a plane --------------------------------------------------------------------------------------------- */

/* The period of the domain along the direction of a probe, m; 0: there is none. */
static double find_period(const view *v)
{
    const double *length = v->simulation->soil.period.length;
    double period = 0.0;
    for (int a = 0; a < 3; ++a) {
        period = v->frame.direction[a] != 0.0 ? fmax(period, length[a]) : period;
    }
    return period;
}

/* Mass times velocity over the slab of two spacings around the plane, by its thickness. */
static mor_status mass_flow(mor_context *context, const view *v, double *value)
{
    const double reach = v->points.spacing;
    const double period = find_period(v);
    double sum = 0.0;
    (void)context;
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        const double distance = find_distance(v, v->points.position + 3 * i);
        if (fabs(period > 0.0 ? distance - period * rint(distance / period) : distance) <= reach) {
            sum += v->points.mass[i] * mor_vector_dot(v->velocity + 3 * i, v->frame.direction);
        }
    }
    *value = sum / (2.0 * reach);
    return MOR_OK;
}

/* The net mass, then the side of each particle by its number: 1 beyond the plane, or beyond how many planes it has come
 * that are a period apart. */
static int64_t count_sides(const view *v)
{
    return 1 + v->simulation->soil.set.n_created;
}

static double find_side(const view *v, int64_t i, double period)
{
    double place[3];
    mor_soil_find_unwrapped(&v->simulation->soil, i, place);
    const double distance = find_distance(v, place);
    return period > 0.0 ? ceil(distance / period) : (distance > 0.0 ? 1.0 : 0.0);
}

/* Counts a particle where it is found inside the region after a change of side. */
static void look_at_side(const view *v, int64_t i, double period, double *memory)
{
    const mor_soil *soil = &v->simulation->soil;
    double *const *data = soil->set.data;
    double *side = &memory[1 + soil->set.id[i]];
    const double now = find_side(v, i, period);
    const bool is_counted = v->soil < 0 || soil->region_field < 0 || (int)data[soil->region_field][i] == v->soil;
    if (now != *side && is_counted && mor_probe_is_inside(v, data[MOR_FIELD_POSITION] + 3 * i)) {
        memory[0] += (now - *side) * data[MOR_FIELD_MASS][i];
    }
    *side = now;
}

/* All particles are followed. */
static void remember_sides(const view *v, bool is_start, double *memory)
{
    const mor_set *set = &v->simulation->soil.set;
    const double period = find_period(v);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        if (is_start) {
            memory[1 + set->id[i]] = find_side(v, i, period);
        } else {
            look_at_side(v, i, period, memory);
        }
    }
    memory[0] = is_start ? 0.0 : memory[0];
}

/* Also those that pass in the step in which they leave the domain. */
static void remember_leaving(const view *v, int64_t particle, double *memory)
{
    look_at_side(v, particle, find_period(v), memory);
}

static mor_status mass_passed(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->memory[0];
    return MOR_OK;
}

/* ---- Since the start --------------------------------------------------------------------------------------------- */

/* Positions at the start by the numbers of the particles, m. */
static int64_t count_starts(const view *v)
{
    return 3 * v->simulation->soil.set.n_created;
}

static void remember_starts(const view *v, bool is_start, double *memory)
{
    const mor_set *set = &v->simulation->soil.set;
    for (int64_t i = 0; is_start && i < set->n_particles; ++i) {
        mor_soil_find_unwrapped(&v->simulation->soil, i, memory + 3 * set->id[i]);
    }
}

/* What a percentile of displacements looks at. */
typedef struct displacement_job {
    const view *v;
} displacement_job;

static void fill_displacements(const void *argument, int64_t first, int64_t n, double *values)
{
    const view *v = ((const displacement_job *)argument)->v;
    const mor_set *set = &v->simulation->soil.set;
    for (int64_t k = 0; k < n; ++k) {
        const int64_t i = v->index != NULL ? v->index[first + k] : first + k;
        double now[3];
        mor_soil_find_unwrapped(&v->simulation->soil, i, now);
        const double *then = v->memory + 3 * set->id[i];
        const double offset[3] = {now[0] - then[0], now[1] - then[1], now[2] - then[2]};
        values[k] = mor_vector_length(offset);
    }
}

static mor_status displacement(mor_context *context, const view *v, double *value)
{
    const displacement_job job = {v};
    return mor_measure_share(context, &v->points, fill_displacements, &job, v->probe->percentile, value);
}

/* Standard deviation of the places along direction, by mass. */
static mor_status spread(mor_context *context, const view *v, double *value)
{
    double center[3];
    double sum = 0.0;
    double mass = 0.0;
    (void)context;
    *value = NAN;
    if (v->points.n_points == 0) {
        return MOR_OK;
    }
    mor_probe_find_center(v, center);
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        double place[3];
        mor_probe_find_place(v, i, place);
        const double offset[3] = {place[0] - center[0], place[1] - center[1], place[2] - center[2]};
        const double along = mor_vector_dot(offset, v->frame.direction);
        sum += v->points.mass[i] * along * along;
        mass += v->points.mass[i];
    }
    *value = sqrt(sum / mass);
    return MOR_OK;
}

/* ---- Where soil has yielded -------------------------------------------------------------------------------------- */

/* Volume, first and second moments of the soil that has yielded, about its first particle. */
typedef struct plastic_zone {
    double volume;
    double first[3];
    double second[6]; /* symmetric tensor */
} plastic_zone;

static mor_status find_zone(mor_context *context, const view *v, plastic_zone *zone)
{
    const mor_set *set = &v->simulation->soil.set;
    const int field = mor_set_find_field(set, "plastic_strain");
    const double *origin = NULL;
    MOR_CHECK(context, field >= 0, MOR_ERROR_CONFIG,
              "found soil whose law keeps no plastic strain; allowed: laws with the state plastic_strain, as "
              "drucker_prager; remove the probe or choose such a law");
    *zone = (plastic_zone){.volume = 0.0};
    for (int64_t k = 0; k < v->points.n_points; ++k) {
        const int64_t i = v->index != NULL ? v->index[k] : k;
        const double part = v->points.mass[k] / v->points.density[k];
        const double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
        if (!(set->data[field][i] >= v->probe->strain)) {
            continue;
        }
        origin = origin == NULL ? place : origin;
        const double s[3] = {place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]};
        zone->volume += part;
        for (int a = 0; a < 3; ++a) {
            zone->first[a] += part * s[a];
            zone->second[a] += part * s[a] * s[a];
            zone->second[3 + a] += part * s[a] * s[(a + 1) % 3];
        }
    }
    return MOR_OK;
}

static mor_status plastic_volume(mor_context *context, const view *v, double *value)
{
    plastic_zone zone;
    MOR_TRY(context, find_zone(context, v, &zone));
    *value = zone.volume;
    return MOR_OK;
}

/* Largest eigenvalue of a symmetric tensor that has none below zero, by the power method. */
static double find_largest(const double *tensor)
{
    double vector[3] = {0.6, 0.5, 0.62}; /* along none of the axes */
    double largest = 0.0;
    for (int k = 0; k < 200; ++k) {
        double next[3];
        mor_symmetric_apply(tensor, vector, next);
        largest = mor_vector_length(next);
        if (!(largest > 0.0)) {
            return 0.0;
        }
        for (int a = 0; a < 3; ++a) {
            vector[a] = next[a] / largest;
        }
    }
    return largest;
}

/* Volume over the length (area) of a bar (plate) with the same second moments: sqrt(12) times the deviation. */
static mor_status plastic_width(mor_context *context, const view *v, double *value)
{
    plastic_zone zone;
    double spread_of[6];
    MOR_TRY(context, find_zone(context, v, &zone));
    *value = NAN;
    if (!(zone.volume > 0.0)) {
        return MOR_OK; /* none has yielded */
    }
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        spread_of[a] = zone.second[a] / zone.volume - zone.first[a] * zone.first[a] / (zone.volume * zone.volume);
        spread_of[3 + a] =
            zone.second[3 + a] / zone.volume - zone.first[a] * zone.first[b] / (zone.volume * zone.volume);
    }
    const double trace = mor_symmetric_trace(spread_of);
    const double largest = find_largest(spread_of);
    double extent = sqrt(12.0 * largest);
    if (v->points.dimension == 3) { /* the middle one by the sum of the products of pairs, least one first */
        double cofactors[6];
        const double determinant = mor_symmetric_cofactors(spread_of, cofactors);
        const double rest = trace - largest;
        const double product = largest > 0.0 ? determinant / largest : 0.0;
        const double middle = 0.5 * (rest + sqrt(fmax(rest * rest - 4.0 * product, 0.0)));
        extent *= sqrt(12.0 * middle);
    }
    *value = extent > 0.0 ? zone.volume / extent : NAN;
    return MOR_OK;
}

const mor_probe_measure mor_probe_flow_measures[] = {
    {.type = {"volume", "m3", "m2", SOIL | REGION, 0, OF_SOIL, 100.0, "bulk volume of the soil"},
     .run = volume,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"volume_beyond", "m3", "m2", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL, 100.0,
              "bulk volume of the soil beyond the plane through origin, along direction"},
     .run = volume_beyond,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"deposit_volume", "m3", "m2", SOIL | REGION | SPEED, 0, OF_SOIL, 100.0,
              "bulk volume of the soil that is no faster than speed"},
     .run = deposit_volume,
     .cost = MOR_PROBE_COST_SUM},
    {.type =
         {"mass_flow", "kg/s", "kg/m/s", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL | PLANE, 100.0,
          "mass of soil per time through the plane through origin, along direction: that of a slab of two spacings"},
     .run = mass_flow,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"mass_passed", "kg", "kg/m", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL | PAST | PLANE, 100.0,
              "net mass of soil that has crossed the plane through origin since the start, along direction: exact, by "
              "the side of each particle"},
     .run = mass_passed,
     .count = count_sides,
     .remember = remember_sides,
     .leave = remember_leaving,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {MOR_PROBE_DISPLACEMENT, "m", "m", REGION | PERCENTILE, 0, OF_SOIL | PAST, 50.0,
              "distance of soil particles from where they were at the start; a percentile of those that are now in the "
              "region; the run writes displacements.csv"},
     .run = displacement,
     .count = count_starts,
     .remember = remember_starts,
     .cost = MOR_PROBE_COST_PERCENTILE},
    {.type = {"spread", "m", "m", SOIL | REGION | DIRECTION, DIRECTION, OF_SOIL, 100.0,
              "standard deviation of the places of the soil along direction, by mass"},
     .run = spread,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"plastic_volume", "m3", "m2", SOIL | REGION | STRAIN, 0, OF_SOIL, 100.0,
              "volume of the soil whose plastic_strain is at least strain"},
     .run = plastic_volume,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"plastic_width", "m", "m", SOIL | REGION | STRAIN, 0, OF_SOIL, 100.0,
              "width of that zone: its volume over the length (area) of the bar (plate) with its second moments; NaN "
              "where nothing has yielded"},
     .run = plastic_width,
     .cost = MOR_PROBE_COST_SUM},
    {.run = NULL}};
