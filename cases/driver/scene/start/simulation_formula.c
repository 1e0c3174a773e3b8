/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Initial velocity and stress of soil by formulas of the place. */
#include "cases/driver/scene/start/simulation_formula.h"

#include "core/base/math.h"
#include "core/formula/formula.h"

#include <stdio.h>
#include <string.h>

enum { COMPONENTS_MAX = 6 };

/* The formulas of one field of a region, made; NULL where there is none, which stands for zero. */
typedef struct formula_set {
    mor_formula *formulas[COMPONENTS_MAX];
    int n;
} formula_set;

static void clear_set(mor_context *context, formula_set *set)
{
    for (int k = 0; k < COMPONENTS_MAX; ++k) {
        mor_formula_free(context, &set->formulas[k]);
    }
}

static mor_status make_set(mor_context *context, const char (*texts)[MOR_CASE_TEXT_BYTES], int n, formula_set *set)
{
    memset(set, 0, sizeof *set);
    for (int k = 0; k < n && texts[k][0] != '\0'; ++k) {
        const mor_status status = mor_formula_new(context, texts[k], &set->formulas[k]);
        if (status != MOR_OK) {
            clear_set(context, set);
            return status;
        }
        set->n = k + 1;
    }
    return MOR_OK;
}

/* Values at a place of the run, in the units of the run; those of the formulas are before the scale. */
static mor_status evaluate(mor_context *context, const mor_case *c, const mor_case_soil *it, const formula_set *set,
                           const double *placed, double unit, double *values)
{
    double place[3];
    mor_simulation_take_point_back(c, placed, place);
    for (int a = 0; a < 3; ++a) {
        place[a] /= c->scale_length;
    }
    for (int k = 0; k < set->n; ++k) {
        const mor_status status = mor_formula_evaluate(context, set->formulas[k], place, &values[k]);
        if (status != MOR_OK) {
            char why[MOR_CONTEXT_MESSAGE_BYTES];
            snprintf(why, sizeof why, "%s", context->message);
            return MOR_FAIL(context, status, "%s:%d: soil '%s': %s", it->place.file, it->place.line, it->name, why);
        }
        values[k] *= unit;
    }
    return MOR_OK;
}

static mor_status set_velocities(mor_context *context, mor_simulation *simulation, const mor_case_soil *it,
                                 int64_t first, int64_t n, const formula_set *set)
{
    const mor_case *c = simulation->the_case;
    mor_soil *soil = &simulation->soil;
    const double unit = c->scale_length / c->scale_time;
    for (int64_t i = first; i < first + n; ++i) {
        double values[COMPONENTS_MAX] = {0.0};
        double *velocity = soil->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        MOR_TRY(context, evaluate(context, c, it, set, x, unit, values));
        mor_matrix_apply(c->rotation, values, velocity);
        const double speed = mor_vector_length(velocity);
        MOR_CHECK(context, speed < soil->sound_speed, MOR_ERROR_CONFIG,
                  "%s:%d: found soil '%s' with a velocity of %g m/s by its velocity_formula at (%.6g, %.6g, %.6g) m, "
                  "beyond the speed of sound in the soil, %.4g m/s; allowed is less, advisable is less than a tenth of "
                  "it; correct the formula or raise the stiffness of the soil",
                  it->place.file, it->place.line, it->name, speed, x[0], x[1], x[2], soil->sound_speed);
        soil->largest_speed = fmax(soil->largest_speed, speed);
    }
    return MOR_OK;
}

/* Rotates a stress from the frame of the case into that of the run, R s R^T. */
static void rotate_stress(const double *rotation, const double *given, double *stress)
{
    const double full[9] = {given[MOR_XX], given[MOR_XY], given[MOR_ZX], given[MOR_XY], given[MOR_YY],
                            given[MOR_YZ], given[MOR_ZX], given[MOR_YZ], given[MOR_ZZ]};
    for (int k = 0; k < 6; ++k) {
        const int row = k % 3;
        const int column = k < 3 ? k : (k - 2) % 3;
        stress[k] = 0.0;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                stress[k] += rotation[3 * row + a] * full[3 * a + b] * rotation[3 * column + b];
            }
        }
    }
}

static mor_status set_stresses(mor_context *context, mor_simulation *simulation, const mor_case_soil *it, int64_t first,
                               int64_t n, const formula_set *set)
{
    const mor_case *c = simulation->the_case;
    mor_soil *soil = &simulation->soil;
    const double unit = c->scale_mass / (c->scale_length * c->scale_time * c->scale_time);
    for (int64_t i = first; i < first + n; ++i) {
        double values[COMPONENTS_MAX] = {0.0};
        MOR_TRY(context, evaluate(context, c, it, set, soil->set.data[MOR_FIELD_POSITION] + 3 * i, unit, values));
        rotate_stress(c->rotation, values, soil->set.data[MOR_FIELD_STRESS] + 6 * i);
    }
    return MOR_OK;
}

mor_status mor_simulation_set_by_formulas(mor_context *context, mor_simulation *simulation,
                                          const mor_lattice_points *regions)
{
    int64_t first = 0;
    for (int k = 0; k < simulation->the_case->n_soils; ++k) {
        const mor_case_soil *it = &simulation->the_case->soils[k];
        formula_set velocity;
        formula_set stress;
        MOR_TRY(context, make_set(context, it->velocity_formula, 3, &velocity));
        mor_status status = make_set(context, it->stress_formula, 6, &stress);
        if (status == MOR_OK && velocity.n > 0) {
            status = set_velocities(context, simulation, it, first, regions[k].n_points, &velocity);
        }
        if (status == MOR_OK && stress.n > 0) {
            status = set_stresses(context, simulation, it, first, regions[k].n_points, &stress);
        }
        clear_set(context, &velocity);
        clear_set(context, &stress);
        MOR_TRY(context, status);
        first += regions[k].n_points;
    }
    return MOR_OK;
}
