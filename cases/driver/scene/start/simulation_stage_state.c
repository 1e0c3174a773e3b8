/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What the particles of soil that is taken over bring along. */
#include "cases/driver/scene/start/simulation_stage.h"

#include "cases/driver/scene/simulation_fields.h"
#include "cases/driver/scene/start/simulation_field.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/params.h"

#include <string.h>

/* ---- Fields ------------------------------------------------------------------------------------------------------ */

static bool is_state_of_law(const mor_soil *soil, int field)
{
    bool is = false;
    for (int k = 0; k < soil->material->n_state; ++k) {
        is = is || (soil->state_fields[k] == field && field != soil->region_field);
    }
    return is;
}

static bool is_brought(const mor_case *c, const char *key)
{
    bool is = false;
    for (int k = 0; k < c->n_soils; ++k) {
        is = is || mor_simulation_brings(c, k, key);
    }
    return is;
}

/* Soil of another density than in the run before is heavier or lighter at the same volume: its mass, and all that is a
 * density, also of the state of a law. */
static double find_density_factor(const mor_case *c, int soil, const mor_field_info *info)
{
    static const char *const units[] = {"kg", "kg/m3", "kg/m3/s"};
    bool grows = false;
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k) {
        grows = grows || strcmp(info->unit, units[k]) == 0;
    }
    return grows ? c->stage.density_ratio[soil] : 1.0;
}

static void tell_density(mor_context *context, const mor_taken_soil *taken)
{
    const mor_case *c = taken->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        if (mor_taken_soil_has(taken, k) && c->stage.density_ratio[k] != 1.0) {
            mor_context_log(context, MOR_LOG_PROGRESS,
                            "soil '%s': its density is %.6g times that in '%s'; the mass of its particles changes "
                            "with it, their volumes and stresses stay: write the density of that run to keep it",
                            c->soils[k].name, c->stage.density_ratio[k], c->stage.run);
        }
    }
}

static mor_status apply_field(mor_context *context, const mor_taken_soil *taken, mor_simulation *simulation, int field,
                              double *values)
{
    mor_soil *soil = &simulation->soil;
    const mor_case *c = taken->the_case;
    const mor_field_info *info = &soil->set.fields[field];
    const int width = info->n_components;
    int64_t to = 0;
    bool is_there = false;
    MOR_TRY(context,
            mor_checkpoint_view_field(context, taken->view, MOR_TAKEN_SOIL_SET, info->name, width, values, &is_there));
    /* Of what varies each soil keeps what it brings: its own fields of the run before. Any other value there is that of
     * its material then; and a field that is new has the value of the place where a particle is now. */
    const bool is_parameter = mor_simulation_is_parameter(simulation, field);
    const bool is_needed = is_parameter ? is_brought(c, info->name) : is_state_of_law(soil, field);
    MOR_CHECK(context, is_there || !is_needed, MOR_ERROR_CONFIG,
              "%s:%d: found no state variable '%s' of the soil in the run '%s', which a law of this case needs; "
              "allowed: the laws of the run; give soils that are new other names",
              c->stage.place.file, c->stage.place.line, info->name, c->stage.run);
    for (int k = 0; k < c->n_soils && is_there; ++k) {
        const int64_t n = mor_taken_soil_has(taken, k) ? taken->count[k] : 0;
        const bool is_state = mor_params_find(c->soils[k].law->state, info->name) >= 0;
        const bool is_kept = !is_parameter || is_state || mor_simulation_brings(c, k, info->name);
        const double factor = is_parameter ? 1.0 : find_density_factor(c, k, info);
        for (int64_t i = 0; i < n && is_kept; ++i) {
            for (int a = 0; a < width; ++a) {
                soil->set.data[field][width * (to + i) + a] =
                    factor * values[width * taken->sources[taken->first[k] + i] + a];
            }
        }
        to += simulation->region_particles[k];
    }
    return MOR_OK;
}

/* An excavation that holds no soil of the run is misplaced, or was done before. */
static void warn_of_empty_excavations(mor_context *context, const mor_taken_soil *taken)
{
    const mor_case *c = taken->the_case;
    for (int k = 0; k < c->stage.n_excavations; ++k) {
        bool is_empty = true;
        for (int64_t i = 0; i < taken->n && is_empty; ++i) {
            double place[3];
            mor_simulation_take_point_back(c, taken->positions + 3 * i, place);
            is_empty = !(mor_shape_distance(c->stage.excavations[k], place) < 0.0);
        }
        if (is_empty) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: excavate[%d] removes nothing: no soil of the run '%s' is in it; correct its place, "
                            "or remove it",
                            c->stage.place.file, c->stage.place.line, k, c->stage.run);
        }
    }
}

/* Says where a parameter of a soil varied in the run before, but does not any more. */
static mor_status warn_of_lost_field(mor_context *context, const mor_taken_soil *taken, int soil, int entry,
                                     double *values)
{
    const mor_case *c = taken->the_case;
    const mor_case_soil *it = &c->soils[soil];
    const mor_schema *parameter = &it->law->parameters[entry];
    const int64_t *sources = taken->sources + taken->first[soil];
    bool is_there = false;
    bool is_varied = false;
    if (parameter->kind != MOR_SCHEMA_REAL || mor_simulation_varies(c, soil, parameter->key) ||
        mor_params_find(it->law->state, parameter->key) >= 0) {
        return MOR_OK;
    }
    MOR_TRY(context,
            mor_checkpoint_view_field(context, taken->view, MOR_TAKEN_SOIL_SET, parameter->key, 1, values, &is_there));
    for (int64_t i = 1; i < taken->count[soil] && is_there; ++i) {
        is_varied = is_varied || values[sources[i]] != values[sources[0]];
    }
    if (is_varied) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s': '%s' varied in the run that this case starts from, but is the same everywhere from "
                        "here on, because the soil has no field of it; list it in 'fields' to keep its values",
                        it->name, parameter->key);
    }
    return MOR_OK;
}

static mor_status warn_of_lost_fields(mor_context *context, const mor_taken_soil *taken, double *values)
{
    const mor_case *c = taken->the_case;
    for (int soil = 0; soil < c->n_soils; ++soil) {
        for (int k = 0; mor_taken_soil_has(taken, soil) && c->soils[soil].law->parameters[k].key != NULL; ++k) {
            MOR_TRY(context, warn_of_lost_field(context, taken, soil, k, values));
        }
    }
    return MOR_OK;
}

/* Says of each field whether it is that of the run before or of this case. */
static void tell_fields(mor_context *context, const mor_taken_soil *taken)
{
    const mor_case *c = taken->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        for (int f = 0; f < it->n_fields && mor_taken_soil_has(taken, k); ++f) {
            mor_context_log(context, MOR_LOG_INFO,
                            it->fields[f].is_taken
                                ? "soil '%s': its particles keep the values of '%s' of the run '%s', where it varied, "
                                  "too; what this case says of the field has no effect"
                                : "soil '%s': the values of '%s' are those of this case where the particles are now, "
                                  "because it did not vary in this soil of the run '%s'",
                            it->name, it->fields[f].parameter, c->stage.run);
        }
    }
}

/* Stops the particles of a region that is not released; what moves it again is computed from its release on. */
static double stop_region(mor_set *set, int64_t first, int64_t n, double *fastest)
{
    double energy = 0.0;
    for (int64_t i = first; i < first + n; ++i) {
        const double speed = mor_vector_length(set->data[MOR_FIELD_VELOCITY] + 3 * i);
        energy += 0.5 * set->data[MOR_FIELD_MASS][i] * speed * speed;
        *fastest = fmax(*fastest, speed);
    }
    mor_set_stop(set, first, n);
    return energy;
}

/* Soil that is not released stands, also where it moved in the run before. */
static void stop_held_soil(mor_context *context, const mor_taken_soil *taken, mor_simulation *simulation)
{
    const mor_case *c = taken->the_case;
    const double rest = simulation->soil.settings.scheme.sleep_speed * sqrt(mor_vector_length(c->gravity) * c->spacing);
    int64_t first = 0;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const int64_t n = simulation->region_particles[k];
        double fastest = 0.0;
        if (it->released > 0.0 && mor_taken_soil_has(taken, k)) {
            const double energy = stop_region(&simulation->soil.set, first, n, &fastest);
            mor_context_log(
                context, fastest > rest ? MOR_LOG_WARNING : MOR_LOG_INFO,
                "%s:%d: soil '%s' stands until %g s: it moved at up to %.3g m/s at the end of the run '%s', "
                "and is stopped at once, which takes a kinetic energy of %.4g %s; let that run end at "
                "rest, or remove released",
                it->place.file, it->place.line, it->name, it->released, fastest, c->stage.run, energy,
                c->dimension == 2 ? "J/m" : "J");
        }
        first += n;
    }
}

/* What the stage changes does not move, so that no soil may sleep on from the run before. Faces are crossed where they
 * are in this case, and gaps to faces go by the numbers of walls and bodies in it: soil touches what it sees. */
static bool begins_anew(int field)
{
    return field == MOR_FIELD_QUIET || field == MOR_FIELD_CROSSINGS || field == MOR_FIELD_GAP ||
           field == MOR_FIELD_GAP_FACE;
}

mor_status mor_taken_soil_apply(mor_context *context, const mor_taken_soil *taken, mor_simulation *simulation)
{
    enum { WIDTH_MAX = 9 };
    mor_soil *soil = &simulation->soil;
    double *values = NULL;
    warn_of_empty_excavations(context, taken);
    mor_status status = MOR_NEW(context, &values, WIDTH_MAX * taken->n, "a field of the run before");
    for (int field = 0; field < soil->set.n_fields && status == MOR_OK; ++field) {
        const bool is_placed = field == MOR_FIELD_POSITION || field == soil->region_field;
        if (mor_state_has_field(&soil->set, field) && !is_placed && !begins_anew(field)) {
            status = apply_field(context, taken, simulation, field, values);
        }
    }
    status = status == MOR_OK ? warn_of_lost_fields(context, taken, values) : status;
    MOR_FREE(context, &values);
    status = status == MOR_OK ? mor_simulation_check_fields(context, simulation) : status;
    tell_fields(context, taken);
    tell_density(context, taken);
    stop_held_soil(context, taken, simulation);
    for (int64_t i = 0; i < soil->set.n_particles && status == MOR_OK; ++i) {
        const double speed = mor_vector_length(soil->set.data[MOR_FIELD_VELOCITY] + 3 * i);
        soil->largest_speed = fmax(soil->largest_speed, speed);
    }
    return status;
}
