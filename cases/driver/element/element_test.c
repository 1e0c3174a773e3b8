/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_test.h"

#include "core/base/math.h"

#include <math.h>
#include <string.h>

/* Of the measure of a path, from there to here: +1, then -2, +2, ..., +1 strains of a cyclic path; +1 of others. */
static int count_phases(const mor_element_settings *settings)
{
    const bool is_cyclic = settings->path != NULL && settings->path->is_cyclic;
    return is_cyclic ? 2 * settings->n_cycles + 1 : 1;
}

static double find_phase(const mor_element_settings *settings, int phase)
{
    const int n_phases = count_phases(settings);
    const double size = phase == 0 || phase == n_phases - 1 ? 1.0 : 2.0;
    return phase % 2 == 0 ? size : -size;
}

/* What is wrong with parameters or the start is bad input. */
static mor_status annotate_error(mor_context *context, mor_status status)
{
    if (status != MOR_ERROR_ARGUMENT) {
        return status;
    }
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    memcpy(message, context->message, sizeof message);
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "%.1900s", message);
}

static mor_status start_specimen(mor_context *context, const mor_element_settings *settings,
                                 const mor_element_driver *driver, double axial, mor_element *element)
{
    const double lateral = settings->k0 * axial;
    const double stress[6] = {-lateral, -lateral, -axial, 0.0, 0.0, 0.0};
    MOR_TRY(context, mor_element_init(context, driver, settings->density, stress, element));
    for (int k = 0; k < MOR_ELEMENT_STATE_MAX; ++k) {
        element->state[k] = isnan(settings->state[k]) ? element->state[k] : settings->state[k];
    }
    return mor_element_check(context, driver, element);
}

/* Deviator stress, positive where the axis is compressed more, or shear stress, as the path drives it; Pa. */
static double measure_stress(const mor_element_settings *settings, const mor_element *element)
{
    return settings->path->measure == MOR_ELEMENT_AXIAL ? element->stress[MOR_XX] - element->stress[MOR_ZZ]
                                                        : element->stress[MOR_ZX];
}

/* A turn of a cyclic path at a stress: where that is, and the sign of the way there. */
typedef struct turn {
    double stress; /* Pa */
    double sign;
} turn;

/* How far the specimen is beyond it, Pa. */
static double pass_turn(const mor_element_settings *settings, const turn *it, const mor_element *element)
{
    return it->sign * (measure_stress(settings, element) - it->stress);
}

/* Puts a specimen that has passed a turn within a step back onto it: the part of the step by the false position. */
static mor_status stop_at_turn(mor_context *context, const mor_element_settings *settings, mor_element_driver *driver,
                               const turn *it, const mor_element *before, double length, mor_element *element)
{
    enum { ITERATIONS = 60 };
    const double allowed = settings->tolerance * settings->amplitude;
    double part[2] = {0.0, 1.0};
    double miss[2] = {pass_turn(settings, it, before), pass_turn(settings, it, element)};
    double last = miss[1];
    for (int k = 0; k < ITERATIONS && fabs(last) > allowed; ++k) {
        const double next =
            k % 3 < 2 ? part[0] - miss[0] * (part[1] - part[0]) / (miss[1] - miss[0]) : 0.5 * (part[0] + part[1]);
        *element = *before;
        MOR_TRY(context, mor_element_advance(context, driver, next * length, element));
        last = pass_turn(settings, it, element);
        part[last > 0.0] = next;
        miss[last > 0.0] = last;
    }
    MOR_CHECK(
        context, fabs(last) <= allowed, MOR_NOT_CONVERGED,
        "the stress at a turn is %.6g kPa, not %.6g kPa within %.3g kPa, after %d trials; the law may jump there: "
        "raise test.tolerance or test.steps",
        1e-3 * measure_stress(settings, element), 1e-3 * it->stress, 1e-3 * allowed, ITERATIONS);
    return MOR_OK;
}

/* One phase of a cyclic path with an amplitude of the stress, a row after each step and at its turn. */
static mor_status follow_to_stress(mor_context *context, const mor_element_settings *settings,
                                   mor_element_driver *driver, const turn *it, int n_steps, mor_element *element,
                                   mor_element_record *record)
{
    const bool is_signed = settings->path->measure == MOR_ELEMENT_AXIAL;
    const double length = settings->strain / settings->rate / settings->n_steps;
    for (int k = 0; k < n_steps; ++k) {
        const mor_element before = *element;
        MOR_TRY(context, mor_element_advance(context, driver, length, element));
        const bool is_there = pass_turn(settings, it, element) >= 0.0;
        if (is_there) {
            MOR_TRY(context, stop_at_turn(context, settings, driver, it, &before, length, element));
        }
        mor_element_record_add(record, element, is_signed);
        if (is_there) {
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_NOT_CONVERGED,
                    "the stress has come to %.6g kPa, not to %.6g kPa, within a strain of %.4g; an amplitude may lie "
                    "beyond the strength; lower test.amplitude, or raise %s",
                    1e-3 * measure_stress(settings, element), 1e-3 * it->stress,
                    (double)n_steps / settings->n_steps * settings->strain,
                    mor_element_names_find(settings->names, "test.strain"));
}

/* One phase, a row after each step. */
static mor_status follow_phase(mor_context *context, const mor_element_settings *settings, mor_element_driver *driver,
                               double phase, const turn *it, mor_element *element, mor_element_record *record)
{
    mor_element_control control = settings->control;
    const bool is_signed = settings->path != NULL && settings->path->measure == MOR_ELEMENT_AXIAL;
    const int n_steps = (int)fabs(phase) * settings->n_steps;
    const double length = settings->strain / settings->rate / settings->n_steps;
    if (settings->path != NULL) {
        mor_element_path_control(settings->path, copysign(settings->rate, phase), settings->b, &control);
    }
    MOR_TRY(context, mor_element_begin(context, driver, element, &control));
    if (it != NULL) {
        return follow_to_stress(context, settings, driver, it, n_steps, element, record);
    }
    for (int k = 0; k < n_steps; ++k) {
        MOR_TRY(context, mor_element_advance(context, driver, length, element));
        mor_element_record_add(record, element, is_signed);
    }
    return MOR_OK;
}

static mor_status run_specimen(mor_context *context, const mor_material *material, const mor_element_settings *settings,
                               mor_element_driver *driver, double axial, mor_element_record *record)
{
    char name[MOR_ELEMENT_NAME_BYTES];
    mor_element element;
    const int n_phases = count_phases(settings);
    int64_t n_rows = 1;
    for (int k = 0; k < n_phases; ++k) {
        n_rows += (int64_t)fabs(find_phase(settings, k)) * settings->n_steps;
    }
    snprintf(name, sizeof name, "%.4g kPa", 1e-3 * axial);
    MOR_TRY(context, mor_element_record_init(context, material, name, settings->void_ratio, n_rows, record));
    MOR_TRY(context, annotate_error(context, start_specimen(context, settings, driver, axial, &element)));
    mor_element_record_add(record, &element, settings->path != NULL && settings->path->measure == MOR_ELEMENT_AXIAL);
    const double middle = isnan(settings->amplitude) ? 0.0 : measure_stress(settings, &element);
    for (int k = 0; k < n_phases && record->status == MOR_OK; ++k) {
        const double phase = find_phase(settings, k);
        const turn at = {.stress = middle + (k == n_phases - 1 ? 0.0 : copysign(settings->amplitude, phase)),
                         .sign = copysign(1.0, phase)};
        record->status =
            follow_phase(context, settings, driver, phase, isnan(settings->amplitude) ? NULL : &at, &element, record);
    }
    if (record->status != MOR_OK) {
        mor_context_log(context, MOR_LOG_WARNING, "specimen of %s: %s", record->name, context->message);
        mor_context_clear_error(context);
    }
    return MOR_OK;
}

mor_status mor_element_test_run(mor_context *context, const mor_material *material,
                                const mor_element_settings *settings, mor_element_record *records)
{
    mor_material_instance *instance = NULL;
    mor_element_driver *driver = NULL;
    mor_status status = annotate_error(
        context, mor_material_create(context, material, settings->density, settings->parameters, &instance));
    if (status == MOR_OK) {
        status = annotate_error(context, mor_element_driver_new(context, instance, settings->tolerance, &driver));
    }
    for (int k = 0; k < settings->n_specimens && status == MOR_OK; ++k) {
        status = run_specimen(context, material, settings, driver, settings->stress[k], &records[k]);
    }
    mor_element_driver_free(context, &driver);
    mor_material_destroy(context, &instance);
    return status;
}

/* ---- Summary ----------------------------------------------------------------------------------------------------- */

/* A plateau begins where a larger value would be larger by no more than this part of it. */
static const double plateau = 1e-6;

/* The row with the largest size of a column; the first one of a plateau. */
static const double *find_peak(const mor_element_record *record, int column)
{
    const double *peak = record->values;
    for (int64_t i = 0; i < record->n_rows; ++i) {
        const double *row = record->values + i * record->n_columns;
        peak = fabs(row[column]) > fabs(peak[column]) * (1.0 + plateau) || isnan(peak[column]) ? row : peak;
    }
    return peak;
}

static void print_row(FILE *out, const char *when, const double *row)
{
    fprintf(out,
            "    %-10s q %.6g kPa, p %.6g kPa, eps_q %.4g %%, eps_v %.4g %%, shear stress %.6g kPa, mobilized friction "
            "%.4g deg",
            when, 1e-3 * row[MOR_ELEMENT_Q], 1e-3 * row[MOR_ELEMENT_P], 100.0 * row[MOR_ELEMENT_EPS_Q],
            100.0 * row[MOR_ELEMENT_EPS_V], 1e-3 * row[MOR_ELEMENT_SHEAR_STRESS],
            row[MOR_ELEMENT_FRICTION_ANGLE] * 180.0 / MOR_PI);
    if (!isnan(row[MOR_ELEMENT_VOID_RATIO])) {
        fprintf(out, ", e %.4g", row[MOR_ELEMENT_VOID_RATIO]);
    }
    fputc('\n', out);
}

void mor_element_test_print(const mor_material *material, const mor_element_settings *settings,
                            const mor_element_record *records, FILE *out)
{
    fprintf(out, "%s %s, %s%s%s\n", material->name, material->version, settings->name,
            settings->path != NULL ? ": " : "", settings->path != NULL ? settings->path->text : "");
    for (int k = 0; k < settings->n_specimens; ++k) {
        const mor_element_record *record = &records[k];
        fprintf(out, "  specimen of %s, %lld updates, %lld repeated, %lld iterations%s\n", record->name,
                (long long)record->n_updates, (long long)record->n_rejected, (long long)record->n_iterations,
                record->status != MOR_OK ? "; stopped before the end" : "");
        print_row(out, "peak q", find_peak(record, MOR_ELEMENT_Q));
        print_row(out, "end", record->values + (record->n_rows - 1) * record->n_columns);
    }
}
