/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Parameters of soil that vary in space. docs/theory/random_fields.md. */
#include "cases/driver/scene/start/simulation_field.h"

#include "cases/driver/scene/simulation_fields.h"
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/formula/formula.h"
#include "core/formula/random_field.h"
#include "core/material/params.h"
#include "core/material/varied.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Particles of which a thread finds random numbers at once. */
enum { CHUNK = 64 };

/* ---- Materials --------------------------------------------------------------------------------------------------- */

mor_status mor_simulation_vary_material(mor_context *context, const mor_case *the_case, int soil,
                                        mor_material_instance **instance)
{
    int entries[MOR_SIMULATION_ENTRIES_MAX];
    mor_material_instance *varied = NULL;
    const int n = mor_simulation_field_entries(the_case, soil, entries);
    if (n == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_varied_create(context, instance, entries, n, &varied));
    *instance = varied;
    return MOR_OK;
}

/* ---- The fields of a region -------------------------------------------------------------------------------------- */

/* What is needed of a region while its particles get their values. */
typedef struct region_fields {
    const mor_case *the_case;
    const mor_case_soil *soil;
    int64_t first, n;
    mor_formula *formulas[MOR_CASE_FIELDS_MAX];   /* NULL: the value of the material */
    mor_random_field *waves[MOR_CASE_FIELDS_MAX]; /* NULL: not random */
    double *normals;                              /* shape [n_fields, n]; standard normal numbers of the particles */
    double *places;                               /* shape [n, 3]; in the frame of the case, m */
    mor_simulation_field reports[MOR_CASE_FIELDS_MAX];
} region_fields;

static void clear_region(mor_context *context, region_fields *it)
{
    for (int k = 0; k < MOR_CASE_FIELDS_MAX; ++k) {
        mor_formula_free(context, &it->formulas[k]);
        mor_random_field_free(context, &it->waves[k]);
    }
    MOR_FREE(context, &it->normals);
    MOR_FREE(context, &it->places);
}

/* Fields of different parameters are independent though their seeds are equal. */
static mor_status make_field(mor_context *context, region_fields *it, int k)
{
    const mor_case_field *field = &it->soil->fields[k];
    if (field->formula[0] != '\0') {
        MOR_TRY(context, mor_formula_new(context, field->formula, &it->formulas[k]));
    }
    if (field->distribution == MOR_CASE_DISTRIBUTION_NONE) {
        return MOR_OK;
    }
    double periods[3];
    for (int a = 0; a < 3; ++a) {
        const mor_case *c = it->the_case;
        periods[a] = mor_case_is_periodic(c, a) ? c->domain_maximum[a] - c->domain_minimum[a] : 0.0;
    }
    const uint64_t purpose = mor_hash_bytes(field->parameter, strlen(field->parameter));
    return mor_random_field_new(context, (mor_random_correlation)field->correlation, field->correlation_length, periods,
                                field->seed, purpose, &it->waves[k]);
}

static mor_status make_region(mor_context *context, region_fields *it)
{
    for (int k = 0; k < it->soil->n_fields; ++k) {
        MOR_TRY(context, make_field(context, it, k));
        it->reports[k] = (mor_simulation_field){.least = INFINITY, .largest = -INFINITY};
    }
    MOR_TRY(context, MOR_NEW(context, &it->normals, it->soil->n_fields * it->n + 1, "random fields of soil"));
    return MOR_NEW(context, &it->places, 3 * it->n + 1, "places of soil");
}

static void find_normals(mor_context *context, const region_fields *it, const double *positions)
{
    const mor_case_field *fields = it->soil->fields;
    MOR_PARALLEL_FOR (context, i, it->n, CHUNK) {
        double *place = it->places + 3 * i;
        mor_simulation_take_point_back(it->the_case, positions + 3 * (it->first + i), place);
        for (int k = 0; k < it->soil->n_fields; ++k) {
            double *normal = &it->normals[k * it->n + i];
            *normal = it->waves[k] != NULL ? mor_random_field_value(it->waves[k], place) : 0.0;
            if (it->waves[k] != NULL && fields[k].other >= 0) {
                const double share = fields[k].cross_correlation;
                *normal = share * it->normals[fields[k].other * it->n + i] + sqrt(1.0 - share * share) * *normal;
            }
        }
    }
}

/* ---- Values of a particle ---------------------------------------------------------------------------------------- */

static mor_status fail_at(mor_context *context, const region_fields *it, int k, const double *place, const char *why)
{
    char copy[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(copy, sizeof copy, "%.1500s", why);
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: soil '%s', field of '%s' at (%.6g, %.6g, %.6g) m: %s",
                    it->soil->place.file, it->soil->fields[k].line, it->soil->name, it->soil->fields[k].parameter,
                    place[0], place[1], place[2], copy);
}

static mor_status find_mean(mor_context *context, const region_fields *it, int k, const double *place,
                            const double *parameters, double *mean)
{
    const mor_case_field *field = &it->soil->fields[k];
    *mean = parameters[mor_params_offset(it->soil->law->parameters, field->entry)];
    if (it->formulas[k] != NULL) {
        double unscaled[3];
        for (int a = 0; a < 3; ++a) {
            unscaled[a] = place[a] / it->the_case->scale_length;
        }
        const mor_status status = mor_formula_evaluate(context, it->formulas[k], unscaled, mean);
        if (status != MOR_OK) {
            return fail_at(context, it, k, place, context->message);
        }
        *mean *= field->unit;
    }
    if (field->distribution == MOR_CASE_DISTRIBUTION_LOGNORMAL && !(*mean > 0.0)) {
        return fail_at(context, it, k, place,
                       "found a mean that is not above zero in a lognormal field; allowed: above zero; correct it, or "
                       "use distribution = \"normal\" with a minimum");
    }
    return MOR_OK;
}

/* [RF1], [RF2]: normal and lognormal values of a mean, a deviation and a standard normal number. */
static double distribute(const mor_case_field *field, double mean, double normal)
{
    const bool has_deviation = !isnan(field->standard_deviation);
    if (field->distribution == MOR_CASE_DISTRIBUTION_NORMAL) {
        const double deviation =
            has_deviation ? field->standard_deviation : field->coefficient_of_variation * fabs(mean);
        return mean + deviation * normal;
    }
    if (field->distribution == MOR_CASE_DISTRIBUTION_LOGNORMAL) {
        const double ratio = has_deviation ? field->standard_deviation / mean : field->coefficient_of_variation;
        const double variance = log1p(ratio * ratio);
        return mean * exp(sqrt(variance) * normal - 0.5 * variance);
    }
    return mean;
}

/* Values beyond the limits of the case, and of random ones beyond the range of the law, are set to them and counted. */
static double limit(const mor_case_field *field, const mor_schema *parameter, double value,
                    mor_simulation_field *report)
{
    const bool is_random = field->distribution != MOR_CASE_DISTRIBUTION_NONE;
    const double least = is_random ? fmax(field->minimum, parameter->minimum) : field->minimum;
    const double largest = is_random ? fmin(field->maximum, parameter->maximum) : field->maximum;
    report->n_raised += value < least;
    report->n_lowered += value > largest;
    return fmin(fmax(value, least), largest);
}

static void add_to_report(mor_simulation_field *report, double value)
{
    report->n += 1;
    const double change = value - report->mean;
    report->mean += change / (double)report->n;
    report->squares += change * (value - report->mean);
    report->least = fmin(report->least, value);
    report->largest = fmax(report->largest, value);
}

/* The parameters of a particle as the fields give them, before any reduction. */
static mor_status find_parameters(mor_context *context, region_fields *it, int64_t i, const double *nominal,
                                  double *parameters)
{
    const mor_schema *schema = it->soil->law->parameters;
    memcpy(parameters, nominal, (size_t)mor_params_count(schema) * sizeof *parameters);
    for (int k = 0; k < it->soil->n_fields; ++k) {
        const mor_case_field *field = &it->soil->fields[k];
        double mean = 0.0;
        MOR_TRY(context, find_mean(context, it, k, it->places + 3 * i, nominal, &mean));
        const double value =
            limit(field, &schema[field->entry], distribute(field, mean, it->normals[k * it->n + i]), &it->reports[k]);
        parameters[mor_params_offset(schema, field->entry)] = value;
        add_to_report(&it->reports[k], value);
    }
    return MOR_OK;
}

/* ---- Values of all particles ------------------------------------------------------------------------------------- */

/* The instance of a region's material that knows the parameters which vary. */
static mor_material_instance *find_material(const mor_simulation *simulation, int soil)
{
    return simulation->parts[soil] != NULL ? simulation->parts[soil] : simulation->material;
}

/* Whether particles bring values, which are not known yet. */
static bool has_taken(const mor_case_soil *soil)
{
    bool has = false;
    for (int k = 0; k < soil->n_fields; ++k) {
        has = has || soil->fields[k].is_taken;
    }
    return has;
}

static mor_status set_particles(mor_context *context, mor_simulation *simulation, int soil, region_fields *it)
{
    const mor_case_reduction *reduction = &it->the_case->reduction;
    const mor_schema *schema = it->soil->law->parameters;
    const double *nominal =
        reduction->reduce != NULL ? reduction->nominal->soils[soil].parameters : it->soil->parameters;
    int entries[MOR_SIMULATION_ENTRIES_MAX];
    const int n_entries = mor_simulation_field_entries(it->the_case, soil, entries);
    for (int64_t i = 0; i < it->n; ++i) {
        double given[MOR_CASE_PARAMETERS_MAX];
        double used[MOR_CASE_PARAMETERS_MAX];
        MOR_TRY(context, find_parameters(context, it, i, nominal, given));
        if (reduction->reduce != NULL) {
            reduction->reduce(schema, given, reduction->factor, given);
        }
        memcpy(used, it->soil->parameters, sizeof used);
        for (int k = 0; k < n_entries; ++k) {
            const int offset = mor_params_offset(schema, entries[k]);
            used[offset] = given[offset];
            simulation->soil.set.data[mor_simulation_find_field(simulation, schema[entries[k]].key)][it->first + i] =
                given[offset];
        }
        if (!has_taken(it->soil) && mor_varied_check(context, find_material(simulation, soil), used) != MOR_OK) {
            char why[MOR_CONTEXT_MESSAGE_BYTES];
            snprintf(why, sizeof why, "%.1300s; change the formula or the mean, or give the field a minimum or maximum",
                     context->message);
            return fail_at(context, it, 0, it->places + 3 * i, why);
        }
    }
    return MOR_OK;
}

static mor_status set_region(mor_context *context, mor_simulation *simulation, int soil, int64_t first, int64_t n)
{
    region_fields it = {
        .the_case = simulation->the_case, .soil = &simulation->the_case->soils[soil], .first = first, .n = n};
    mor_status status = make_region(context, &it);
    if (status == MOR_OK) {
        find_normals(context, &it, simulation->soil.set.data[MOR_FIELD_POSITION]);
        status = set_particles(context, simulation, soil, &it);
    }
    for (int k = 0; k < it.soil->n_fields; ++k) {
        if (!it.soil->fields[k].is_taken) { /* else the particles bring their values */
            simulation->fields[soil][k] = it.reports[k];
        }
    }
    clear_region(context, &it);
    return status;
}

/* A field of another region is the parameter of this one's material, where its law has one of that name and unit; this
 * one's own come after it. */
static void set_constants(mor_simulation *simulation, int soil, int64_t first, int64_t n)
{
    const mor_case_soil *it = &simulation->the_case->soils[soil];
    const mor_schema *own = it->law->parameters;
    const mor_schema *state = simulation->soil.material->material->state;
    for (int k = 0; k < simulation->soil.material->n_state; ++k) {
        const int entry = mor_params_find(own, state[k].key);
        const bool is_parameter = mor_simulation_is_parameter(simulation, simulation->soil.state_fields[k]) &&
                                  mor_params_find(it->law->state, state[k].key) < 0;
        if (is_parameter && entry >= 0 && own[entry].kind == MOR_SCHEMA_REAL &&
            strcmp(own[entry].unit, state[k].unit) == 0) {
            for (int64_t i = first; i < first + n; ++i) {
                simulation->soil.set.data[simulation->soil.state_fields[k]][i] =
                    it->parameters[mor_params_offset(own, entry)];
            }
        }
    }
}

mor_status mor_simulation_set_fields(mor_context *context, mor_simulation *simulation,
                                     const mor_lattice_points *regions)
{
    const mor_case *c = simulation->the_case;
    bool has_fields = false;
    int64_t first = 0;
    for (int k = 0; k < c->n_soils; ++k) {
        has_fields = has_fields || c->soils[k].n_fields > 0;
    }
    for (int k = 0; k < c->n_soils && has_fields; ++k) {
        set_constants(simulation, k, first, regions[k].n_points);
        if (c->soils[k].n_fields > 0) {
            MOR_TRY(context, set_region(context, simulation, k, first, regions[k].n_points));
            mor_varied_set_assigned(find_material(simulation, k), 1);
        }
        first += regions[k].n_points;
    }
    return MOR_OK;
}

static mor_status check_particle(mor_context *context, const mor_simulation *simulation, int soil, int64_t particle)
{
    const mor_case *c = simulation->the_case;
    const mor_case_soil *it = &c->soils[soil];
    double used[MOR_CASE_PARAMETERS_MAX];
    memcpy(used, it->parameters, sizeof used);
    for (int k = 0; k < it->n_fields; ++k) {
        const int field = mor_simulation_find_field(simulation, it->fields[k].parameter);
        used[mor_params_offset(it->law->parameters, it->fields[k].entry)] = simulation->soil.set.data[field][particle];
    }
    if (mor_varied_check(context, find_material(simulation, soil), used) == MOR_OK) {
        return MOR_OK;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    double place[3];
    snprintf(why, sizeof why, "%.1300s", context->message);
    mor_simulation_take_point_back(c, simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * particle, place);
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: soil '%s', whose fields are taken over from the run '%s', at (%.6g, %.6g, %.6g) m: %s; "
                    "change the parameters of its material, or the fields that are new",
                    it->place.file, it->place.line, it->name, c->stage.run, place[0], place[1], place[2], why);
}

mor_status mor_simulation_check_fields(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    int64_t first = 0;
    for (int k = 0; k < c->n_soils; ++k) {
        const int64_t end = first + simulation->region_particles[k];
        for (int64_t i = first; i < end && has_taken(&c->soils[k]); ++i) {
            MOR_TRY(context, check_particle(context, simulation, k, i));
        }
        first = end;
    }
    return MOR_OK;
}
