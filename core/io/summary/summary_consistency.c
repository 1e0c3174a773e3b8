/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/summary/summary_consistency.h"

#include <math.h>
#include <string.h>

const mor_summary_result *mor_summary_find_result(const mor_summary *summary, const char *probe)
{
    for (int k = 0; k < summary->n_results; ++k) {
        if (strcmp(summary->results[k].probe, probe) == 0) {
            return &summary->results[k];
        }
    }
    return NULL;
}

static mor_status check_texts(mor_context *context, const mor_summary *summary)
{
    MOR_CHECK(context, summary->version != NULL && summary->commit != NULL && summary->command != NULL,
              MOR_ERROR_ARGUMENT, "a summary needs version, commit and command; \"\" stands for unknown");
    for (int k = 0; k < summary->n_results; ++k) {
        const mor_summary_result *result = &summary->results[k];
        MOR_CHECK(context, result->probe != NULL && result->probe[0] != '\0' && result->unit != NULL,
                  MOR_ERROR_ARGUMENT, "result %d of a summary has no name or no unit; \"1\" stands for no dimension",
                  k + 1);
        MOR_CHECK(context, mor_summary_find_result(summary, result->probe) == result, MOR_ERROR_ARGUMENT,
                  "two results of a summary are named '%s'; rename one probe", result->probe);
    }
    for (int k = 0; k < summary->n_warnings; ++k) {
        MOR_CHECK(context, summary->warnings[k] != NULL, MOR_ERROR_ARGUMENT, "warning %d of a summary has no text",
                  k + 1);
    }
    for (int k = 0; k < summary->n_inputs; ++k) {
        MOR_CHECK(context, summary->inputs[k].path != NULL, MOR_ERROR_ARGUMENT, "input %d of a summary has no path",
                  k + 1);
    }
    return MOR_OK;
}

/* The number of a result that an expectation is about, any unit; false when there is none of that name. */
static bool find_statistic(const mor_summary_result *result, const char *name, double *value)
{
    const mor_summary_statistics none = {.maximum = NAN, .minimum = NAN, .mean = NAN, .impulse = NAN};
    const mor_summary_statistics *it = result->statistics != NULL ? result->statistics : &none;
    const struct {
        const char *name;
        double value;
    } known[] = {{"value", result->value},
                 {"maximum", it->maximum},
                 {"minimum", it->minimum},
                 {"mean", it->mean},
                 {"impulse", it->impulse}};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        if (name != NULL && strcmp(known[k].name, name) == 0) {
            *value = known[k].value;
            return true;
        }
    }
    return false;
}

/* Of the statistic that an expectation is about. */
const char *mor_summary_find_unit(const mor_summary_result *result, const char *statistic)
{
    const bool is_impulse = strcmp(statistic, "impulse") == 0;
    const bool has_impulse = result->statistics != NULL && result->statistics->impulse_unit != NULL;
    return is_impulse && has_impulse ? result->statistics->impulse_unit : result->unit;
}

static mor_status check_expectations(mor_context *context, const mor_summary *summary)
{
    for (int k = 0; k < summary->n_expectations; ++k) {
        const mor_summary_expectation *expectation = &summary->expectations[k];
        MOR_CHECK(context, expectation->probe != NULL, MOR_ERROR_ARGUMENT, "expectation %d of a summary has no probe",
                  k + 1);
        const mor_summary_result *result = mor_summary_find_result(summary, expectation->probe);
        MOR_CHECK(context, result != NULL, MOR_ERROR_ARGUMENT,
                  "expectation %d of a summary is about '%s', which is not among the results", k + 1,
                  expectation->probe);
        double value = NAN;
        MOR_CHECK(context, find_statistic(result, expectation->statistic, &value), MOR_ERROR_ARGUMENT,
                  "expectation %d of a summary is about a statistic of '%s' that does not exist", k + 1,
                  expectation->probe);
        const bool is_same = value == expectation->measured || (isnan(value) && isnan(expectation->measured));
        MOR_CHECK(context, is_same, MOR_ERROR_ARGUMENT,
                  "expectation %d of a summary has measured %.17g for '%s', whose %s is %.17g", k + 1,
                  expectation->measured, expectation->probe, expectation->statistic, value);
        MOR_CHECK(context, !expectation->passes || isfinite(expectation->measured), MOR_ERROR_ARGUMENT,
                  "expectation %d of a summary passes with %g measured for '%s'", k + 1, expectation->measured,
                  expectation->probe);
    }
    return MOR_OK;
}

mor_status mor_summary_check_consistency(mor_context *context, const mor_summary *summary)
{
    MOR_TRY(context, check_texts(context, summary));
    MOR_TRY(context, check_expectations(context, summary));
    return MOR_OK;
}
