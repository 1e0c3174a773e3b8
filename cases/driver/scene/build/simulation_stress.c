/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The stress soil starts with. */
#include "cases/driver/scene/build/simulation_build.h"

#include "cases/driver/scene/build/simulation_relax.h"
#include "cases/driver/scene/build/soil_above.h"
#include "cases/driver/scene/soil_columns.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

/* The surface of the soil over its columns. */
typedef struct surface {
    mor_soil_columns columns;
    double *top; /* shape [columns]; height of the highest particle over the origin of space, m */
} surface;

static mor_status find_surface(mor_context *context, const mor_simulation *simulation, surface *s)
{
    const double *position = simulation->soil.set.data[MOR_FIELD_POSITION];
    mor_soil_columns_find(simulation, &s->columns);
    const int64_t n_columns = s->columns.n[0] * s->columns.n[1];
    MOR_TRY(context, MOR_NEW(context, &s->top, n_columns, "surface of the soil"));
    for (int64_t k = 0; k < n_columns; ++k) {
        s->top[k] = -INFINITY;
    }
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        double *top = &s->top[mor_soil_columns_of(&s->columns, position + 3 * i)];
        *top = fmax(*top, mor_vector_dot(position + 3 * i, simulation->up));
    }
    return MOR_OK;
}

/* Soil above the level that is to be its surface would start free of stress, and soil far below it would be pressed by
 * a weight that is not there. */
static mor_status check_level(mor_context *context, const mor_simulation *simulation, const mor_case_soil *it,
                              int64_t first, int64_t n)
{
    const double spacing = simulation->the_case->spacing;
    const double *position = simulation->soil.set.data[MOR_FIELD_POSITION];
    double origin[3];
    double highest = -INFINITY; /* center of a particle above the origin of the case, along up */
    int64_t n_above = 0;
    if (it->initial_stress == MOR_CASE_STRESS_NONE || isnan(it->surface_level)) {
        return MOR_OK;
    }
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    for (int64_t i = first; i < first + n; ++i) {
        const double height = mor_vector_dot(position + 3 * i, simulation->up) - mor_vector_dot(origin, simulation->up);
        highest = fmax(highest, height);
        n_above += height > it->surface_level;
    }
    MOR_CHECK(
        context, n_above == 0, MOR_ERROR_CONFIG,
        "%s:%d: found surface_level = %g m of soil '%s', whose highest point is at %g m: %lld of its %lld particles "
        "lie above the level and would start without stress; allowed: at or above the highest point of the soil; "
        "raise the level, or leave it out for the surface of the soil as it is",
        it->place.file, it->place.line, it->surface_level, it->name, highest + 0.5 * spacing, (long long)n_above,
        (long long)n);
    if (it->surface_level > highest + 1.5 * spacing) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: surface_level = %g m of soil '%s' is %g m above its highest point, so that even there it "
            "starts with a vertical stress of %.3g Pa, which nothing in the case holds",
            it->place.file, it->place.line, it->surface_level, it->name, it->surface_level - highest - 0.5 * spacing,
            it->density * mor_vector_length(simulation->soil.settings.gravity) * (it->surface_level - highest));
    }
    return MOR_OK;
}

/* Particles of other regions in the columns of this one that begin within a spacing above its level; covered: shape
 * [columns]. Writes the highest center of such a column. */
static int64_t find_cover(const mor_simulation *simulation, const surface *s, double level, int64_t first, int64_t n,
                          const bool *covered, double *highest)
{
    const double *position = simulation->soil.set.data[MOR_FIELD_POSITION];
    int64_t n_cover = 0;
    *highest = -INFINITY;
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        const int64_t column = mor_soil_columns_of(&s->columns, position + 3 * i);
        const double above = mor_vector_dot(position + 3 * i, simulation->up) - level;
        if ((i < first || i >= first + n) && covered[column] && above > 0.0 && above <= s->columns.spacing) {
            n_cover += 1;
            *highest = fmax(*highest, s->top[column]);
        }
    }
    return n_cover;
}

/* Soil of another region that lies on the level is no part of the weight that the level stands for. */
static mor_status warn_of_cover(mor_context *context, const mor_simulation *simulation, const surface *s,
                                const mor_case_soil *it, int64_t first, int64_t n)
{
    const double *position = simulation->soil.set.data[MOR_FIELD_POSITION];
    double origin[3];
    double highest = 0.0;
    bool *covered = NULL;
    if (it->initial_stress == MOR_CASE_STRESS_NONE || isnan(it->surface_level)) {
        return MOR_OK;
    }
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    const double level = it->surface_level + mor_vector_dot(origin, simulation->up);
    MOR_TRY(context, MOR_NEW(context, &covered, s->columns.n[0] * s->columns.n[1], "columns of a region of soil"));
    for (int64_t i = first; i < first + n; ++i) {
        covered[mor_soil_columns_of(&s->columns, position + 3 * i)] = true;
    }
    const int64_t n_cover = find_cover(simulation, s, level, first, n, covered, &highest);
    MOR_FREE(context, &covered);
    if (n_cover > 0) {
        const double missing = highest + 0.5 * s->columns.spacing - level;
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: surface_level = %g m of soil '%s' has other soil on it, up to %.4g m above: that "
                        "weight, up to %.3g Pa, is missing in its initial stress, and the soil below yields as the run "
                        "begins; leave surface_level out for the weight of all soil straight above, or raise it",
                        it->place.file, it->place.line, it->surface_level, it->name, missing,
                        it->density * mor_vector_length(simulation->soil.settings.gravity) * missing);
    }
    return MOR_OK;
}

static void sum_overburden(const mor_simulation *simulation, double spacing, const mor_soil_place *sorted,
                           double *excess)
{
    const mor_case *c = simulation->the_case;
    const double gravity = mor_vector_length(simulation->soil.settings.gravity);
    int64_t above[MOR_CASE_SOILS_MAX] = {0};
    for (int64_t k = 0; k < simulation->soil.set.n_particles; ++k) {
        if (k > 0 && sorted[k].column != sorted[k - 1].column) {
            memset(above, 0, sizeof above);
        }
        double *mine = &excess[sorted[k].particle];
        *mine = 0.0;
        for (int other = 0; other < c->n_soils; ++other) {
            *mine += (c->soils[other].density - c->soils[sorted[k].region].density) * gravity * spacing *
                     (double)above[other];
        }
        above[sorted[k].region] += 1;
    }
}

/* Weight per area of what lies above each particle beyond the weight of as much of its own soil; excess: shape
 * [n_particles], Pa. Zero where all soil has one density. */
static mor_status find_overburden(mor_context *context, const mor_simulation *simulation, const surface *s,
                                  double *excess)
{
    mor_soil_place *sorted = NULL;
    MOR_TRY(context, MOR_NEW(context, &sorted, simulation->soil.set.n_particles, "soil above soil"));
    mor_soil_columns_sort(simulation, &s->columns, sorted);
    sum_overburden(simulation, s->columns.spacing, sorted, excess);
    MOR_FREE(context, &sorted);
    return MOR_OK;
}

/* The height of the surface above each particle, m, and the weight of soil of other density above it, Pa; shape
 * [n_particles] each. */
static mor_status find_above(mor_context *context, const mor_simulation *simulation, const surface *s, double *tops,
                             double *excess)
{
    if (mor_simulation_has_relaxed_soil(simulation->the_case)) {
        mor_soil_above_find(context, simulation, tops, excess);
        return MOR_OK;
    }
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        const double *x = simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        tops[i] = s->top[mor_soil_columns_of(&s->columns, x)] + 0.5 * s->columns.spacing;
    }
    return find_overburden(context, simulation, s, excess);
}

/* Geostatic stress of one region; tops and excess as of find_above. */
static void set_region(mor_simulation *simulation, const surface *s, int region, const double *tops,
                       const double *excess, int64_t first)
{
    const mor_case_soil *it = &simulation->the_case->soils[region];
    const int64_t n = simulation->region_particles[region];
    mor_soil *soil = &simulation->soil;
    const double *up = simulation->up;
    const double *position = soil->set.data[MOR_FIELD_POSITION];
    const double weight = it->density * mor_vector_length(soil->settings.gravity);
    const double lateral = mor_simulation_lateral_ratio(simulation, region);
    double origin[3];
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    const double level = it->surface_level + mor_vector_dot(origin, up); /* NaN when not given */
    for (int64_t i = first; i < first + n; ++i) {
        const double *x = position + 3 * i;
        const double top = isnan(level) ? tops[i] : level;
        simulation->surface_height = fmax(simulation->surface_height, top);
        /* Both halves of a spacing: above the highest center and below the lowest. */
        simulation->soil_depth = fmax(simulation->soil_depth, s->top[mor_soil_columns_of(&s->columns, x)] -
                                                                  mor_vector_dot(x, up) + s->columns.spacing);
        if (it->initial_stress == MOR_CASE_STRESS_NONE || it->initial_stress == MOR_CASE_STRESS_FORMULA ||
            (it->initial_stress == MOR_CASE_STRESS_SETTLED && it->settle_from == 1)) {
            continue;
        }
        if (it->initial_stress == MOR_CASE_STRESS_UNIFORM) {
            for (int a = 0; a < 3; ++a) {
                soil->set.data[MOR_FIELD_STRESS][6 * i + a] = -it->pressure;
            }
            continue;
        }
        const double vertical = -weight * fmax(top - mor_vector_dot(x, up), 0.0) - (isnan(level) ? excess[i] : 0.0);
        double *stress = soil->set.data[MOR_FIELD_STRESS] + 6 * i;
        for (int a = 0; a < 3; ++a) {
            stress[a] = vertical * (lateral + (1.0 - lateral) * up[a] * up[a]);
            stress[3 + a] = vertical * (1.0 - lateral) * up[a] * up[(a + 1) % 3];
        }
    }
}

mor_status mor_simulation_set_stress(mor_context *context, mor_simulation *simulation,
                                     const mor_lattice_points *regions)
{
    surface s = {.top = NULL};
    double *excess = NULL;
    double *tops = NULL;
    MOR_TRY(context, find_surface(context, simulation, &s));
    int64_t first = 0;
    simulation->surface_height = -INFINITY;
    mor_status status = MOR_NEW(context, &excess, simulation->soil.set.n_particles, "weight of soil above soil");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tops, simulation->soil.set.n_particles, "surface above soil");
    }
    if (status == MOR_OK) {
        status = find_above(context, simulation, &s, tops, excess);
    }
    for (int k = 0; k < simulation->the_case->n_soils && status == MOR_OK; ++k) {
        const mor_case_soil *it = &simulation->the_case->soils[k];
        status = check_level(context, simulation, it, first, regions[k].n_points);
        if (status == MOR_OK) {
            status = warn_of_cover(context, simulation, &s, it, first, regions[k].n_points);
        }
        if (status == MOR_OK) {
            set_region(simulation, &s, k, tops, excess, first);
        }
        first += regions[k].n_points;
    }
    MOR_FREE(context, &excess);
    MOR_FREE(context, &tops);
    MOR_FREE(context, &s.top);
    return status;
}
