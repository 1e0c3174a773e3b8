/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_measure.h"

#include "cases/driver/scene/simulation_balance.h"
#include "cases/driver/scene/soil_columns.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/sph/measure/measure.h"

#include <string.h>

/* The smallest body that counts as a failure of the slope has this area over H^2, in space this volume over H^3, or
 * over H^2 and the width of the soil where that is less than H. */
static const double smallest_body = 0.05;

/* No such body is more than this share of all soil. */
static const double largest_share = 0.5;

/* Soil this much deeper than its surface is uneven is no slope by its surface: a cut, a heap against a wall. */
static const double deep = 4.0;

/* Particles lie half a spacing below the surface of the soil, at its highest as at its lowest place, but half a spacing
 * above the lowest place of a toe that stands on a floor, where one particle is all there is. */
static mor_status find_height(mor_context *context, const mor_simulation *simulation, double *height)
{
    const double spacing = simulation->the_case->spacing;
    mor_soil_columns columns;
    double *tops = NULL;
    double bottom = INFINITY;
    double low = INFINITY;
    double high = -INFINITY;
    mor_soil_columns_find(simulation, &columns);
    const int64_t n = columns.n[0] * columns.n[1];
    MOR_TRY(context, MOR_NEW(context, &tops, n, "surface of a slope"));
    for (int64_t k = 0; k < n; ++k) {
        tops[k] = -INFINITY;
    }
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        const double *x = simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        double *top = &tops[mor_soil_columns_of(&columns, x)];
        *top = fmax(*top, mor_vector_dot(x, columns.up));
        bottom = fmin(bottom, mor_vector_dot(x, columns.up));
    }
    for (int64_t k = 0; k < n; ++k) {
        low = tops[k] > -INFINITY ? fmin(low, tops[k]) : low;
        high = fmax(high, tops[k]);
    }
    MOR_FREE(context, &tops);
    const double relief = high - low + (low - bottom < spacing ? spacing : 0.0);
    *height = deep * relief < simulation->soil_depth ? simulation->soil_depth : relief;
    return MOR_OK;
}

/* The normal of a layer without ends that is inclined: up without its parts along periodic axes, not normalized, whose
 * length is the cosine of the slope; false where no periodic axis is inclined, so that heights are what they are. */
static bool find_normal(const mor_simulation *simulation, double *normal)
{
    const double rounding = 1.0e-12; /* of directions */
    bool is_inclined = false;
    for (int a = 0; a < 3; ++a) {
        const bool is_periodic = simulation->soil.period.length[a] > 0.0;
        is_inclined = is_inclined || (is_periodic && fabs(simulation->up[a]) > rounding);
        normal[a] = is_periodic ? 0.0 : simulation->up[a];
    }
    return is_inclined;
}

/* Thickness of that layer, m; it is the same whatever the period, as heights against gravity are not. */
static double find_thickness(const mor_simulation *simulation, const double *normal)
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        const double at = mor_vector_dot(simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * i, normal);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    return (high - low) / mor_vector_length(normal) + simulation->the_case->spacing;
}

/* Height of the slope, where it is not given, and depth of its soil against gravity, m. */
static mor_status find_lengths(mor_context *context, const mor_simulation *simulation, double *height, double *depth)
{
    const double least = 1.0e-6; /* of the cosine of the slope */
    double normal[3];
    *depth = simulation->soil_depth;
    if (!find_normal(simulation, normal)) {
        return isnan(*height) ? find_height(context, simulation, height) : MOR_OK;
    }
    const double cosine = mor_vector_length(normal);
    if (cosine > least) {
        const double thickness = find_thickness(simulation, normal);
        *height = isnan(*height) ? thickness : *height;
        *depth = thickness / cosine;
    }
    MOR_CHECK(context, !isnan(*height), MOR_ERROR_CONFIG,
              "found a gravity along the periodic axes alone, across which the soil has no thickness that could count "
              "as the height of the slope; allowed: with a height of the slope; give one");
    return MOR_OK;
}

static double find_slowest_wave(const mor_soil *soil)
{
    double slowest = soil->sound_speed;
    for (int k = 0; k < soil->n_kinds; ++k) {
        slowest = fmin(slowest, soil->kinds[k].sound_speed);
    }
    return slowest;
}

/* The smaller of the two level extents of the soil, m. */
static double find_width(const mor_simulation *simulation)
{
    mor_soil_columns columns;
    mor_soil_columns_find(simulation, &columns);
    return mor_min((double)columns.n[0], (double)columns.n[1]) * columns.spacing;
}

static void set_scales(const mor_simulation *simulation, double height, double depth, mor_safety_reference *reference)
{
    const mor_case *c = simulation->the_case;
    const double wave = find_slowest_wave(&simulation->soil);
    const double across = c->dimension == 3 ? fmin(height, find_width(simulation)) : c->spacing;
    const double cells = smallest_body * pow(height / c->spacing, 2.0) * (across / c->spacing);
    const double n = (double)simulation->soil.set.n_particles;
    reference->height = height;
    reference->gravity = mor_vector_length(simulation->soil.settings.gravity);
    reference->settlement = 0.5 * reference->gravity * pow(depth / wave, 2.0);
    reference->period = 4.0 * depth / wave;
    reference->smallest = fmax(cells, 1.0) / n;
    reference->percent = 100.0 * (1.0 - fmin(reference->smallest, largest_share));
}

static mor_status copy_state(mor_context *context, const mor_simulation *simulation, mor_safety_reference *reference)
{
    const mor_set *set = &simulation->soil.set;
    const int field = mor_set_find_field(set, "plastic_strain");
    reference->n = set->n_created;
    memcpy(reference->repeat, simulation->soil.period.length, sizeof reference->repeat);
    MOR_TRY(context, MOR_NEW(context, &reference->position, 3 * reference->n, "positions at the start of trials"));
    MOR_TRY(context, MOR_NEW(context, &reference->values, reference->n, "displacements of a trial"));
    if (field >= 0 && set->data[field] != NULL) {
        MOR_TRY(context, MOR_NEW(context, &reference->plastic_strain, reference->n, "strains at the start of trials"));
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        mor_soil_find_unwrapped(&simulation->soil, i, reference->position + 3 * set->id[i]);
        if (reference->plastic_strain != NULL) {
            reference->plastic_strain[set->id[i]] = set->data[field][i];
        }
    }
    return MOR_OK;
}

mor_status mor_safety_reference_init(mor_context *context, const mor_simulation *simulation, double height,
                                     mor_safety_reference *reference)
{
    *reference = (mor_safety_reference){.n = 0};
    double depth = 0.0;
    MOR_TRY(context, find_lengths(context, simulation, &height, &depth));
    set_scales(simulation, height, depth, reference);
    const mor_status status = copy_state(context, simulation, reference);
    if (status != MOR_OK) {
        mor_safety_reference_clear(context, reference);
    }
    return status;
}

void mor_safety_reference_clear(mor_context *context, mor_safety_reference *reference)
{
    MOR_FREE(context, &reference->position);
    MOR_FREE(context, &reference->plastic_strain);
    MOR_FREE(context, &reference->values);
    *reference = (mor_safety_reference){.n = 0};
}

double mor_safety_reference_time(const mor_safety_reference *reference)
{
    return sqrt(reference->height / reference->gravity);
}

double mor_safety_reference_speed(const mor_safety_reference *reference)
{
    return sqrt(reference->height * reference->gravity);
}

double mor_safety_displacement(const mor_safety_reference *reference, const mor_set *set, int64_t particle)
{
    const double *start = reference->position + 3 * set->id[particle];
    const double *now = set->data[MOR_FIELD_POSITION] + 3 * particle;
    const double *crossings = set->data[MOR_FIELD_CROSSINGS];
    double way[3];
    for (int a = 0; a < 3; ++a) {
        way[a] = now[a] - start[a];
        way[a] += crossings != NULL ? crossings[3 * particle + a] * reference->repeat[a] : 0.0;
    }
    return mor_vector_length(way);
}

mor_status mor_safety_measure(mor_context *context, const mor_simulation *simulation, mor_safety_reference *reference,
                              mor_safety_sample *sample)
{
    const mor_set *set = &simulation->soil.set;
    mor_simulation_imbalance imbalance;
    double speed = 0.0;
    double moved = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        reference->values[i] = mor_vector_length(set->data[MOR_FIELD_VELOCITY] + 3 * i);
    }
    MOR_TRY(context,
            mor_measure_percentile(context, reference->values, NULL, set->n_particles, reference->percent, &speed));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        reference->values[i] = mor_safety_displacement(reference, set, i);
    }
    MOR_TRY(context,
            mor_measure_percentile(context, reference->values, NULL, set->n_particles, reference->percent, &moved));
    mor_simulation_find_imbalance(simulation, context->n_threads, &imbalance);
    sample->speed = speed / mor_safety_reference_speed(reference);
    sample->displacement = moved / reference->height;
    sample->force = imbalance.mean;
    return MOR_OK;
}
