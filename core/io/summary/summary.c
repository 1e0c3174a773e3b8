/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/summary/summary.h"

#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"
#include "core/io/summary/summary_consistency.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#define FINISHED "finished"
#define FAILED "failed"

static json_t *make_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/* A copy with question marks for all bytes that are not ASCII; the caller frees it. */
static mor_status copy_clean(mor_context *context, const char *text, char **copy)
{
    const size_t n_bytes = strlen(text) + 1;
    MOR_TRY(context, MOR_NEW(context, copy, (int64_t)n_bytes, "a text of the summary"));
    for (size_t k = 0; k < n_bytes; ++k) {
        (*copy)[k] = (unsigned char)text[k] >= 0x80 ? '?' : text[k];
    }
    return MOR_OK;
}

/* A text as it is when it is UTF-8, else cleaned; NULL when memory runs out. */
static json_t *make_text(mor_context *context, const char *text)
{
    json_t *value = json_string(text);
    char *clean = NULL;
    if (value == NULL && copy_clean(context, text, &clean) == MOR_OK) {
        value = json_string(clean);
    }
    MOR_FREE(context, &clean);
    return value;
}

static json_t *make_hash(uint64_t hash)
{
    char text[MOR_HASH_TEXT_BYTES];
    mor_hash_format(hash, text);
    return json_string(text);
}

static json_t *make_seed(uint64_t seed)
{
    return seed <= INT64_MAX ? json_integer((json_int_t)seed) : json_sprintf("%" PRIu64, seed);
}

/* Adds a member and takes the value; 0 on success. A name taken already is a failure. */
static int add_member(json_t *object, const char *name, json_t *value)
{
    if (json_object_get(object, name) != NULL) {
        json_decref(value);
        return -1;
    }
    return json_object_set_new(object, name, value);
}

/* Likewise under a name of any bytes. */
static int add_named(mor_context *context, json_t *object, const char *name, json_t *value)
{
    json_t *clean = make_text(context, name);
    if (clean == NULL) {
        json_decref(value);
        return -1;
    }
    const int error = add_member(object, json_string_value(clean), value);
    json_decref(clean);
    return error;
}

/* An object or list whose members were added; NULL when one could not be. */
static json_t *finish(json_t *object, int error)
{
    if (error != 0) {
        json_decref(object);
        return NULL;
    }
    return object;
}

static int fill_statistics(mor_context *context, json_t *result, const mor_summary_statistics *it)
{
    int error = add_member(result, "maximum", make_number(it->maximum));
    error |= add_member(result, "time_of_maximum", make_number(it->time_of_maximum));
    error |= add_member(result, "minimum", make_number(it->minimum));
    error |= add_member(result, "time_of_minimum", make_number(it->time_of_minimum));
    error |= add_member(result, "mean", make_number(it->mean));
    if (it->impulse_unit != NULL) {
        error |= add_member(result, "impulse", make_number(it->impulse));
        error |= add_member(result, "impulse_unit", make_text(context, it->impulse_unit));
    }
    json_t *window = json_array();
    error |= json_array_append_new(window, make_number(it->window[0]));
    error |= json_array_append_new(window, make_number(it->window[1]));
    error |= add_member(result, "window", window);
    error |= add_member(result, "interval", json_integer(it->interval));
    error |= add_member(result, "measured", json_integer((json_int_t)it->n_measured));
    error |= add_member(result, "skipped", json_integer((json_int_t)it->n_skipped));
    return error;
}

static json_t *make_results(mor_context *context, const mor_summary *summary)
{
    json_t *results = json_object();
    int error = 0;
    for (int k = 0; k < summary->n_results; ++k) {
        json_t *result = json_object();
        error |= add_member(result, "value", make_number(summary->results[k].value));
        error |= add_member(result, "unit", make_text(context, summary->results[k].unit));
        if (summary->results[k].statistics != NULL) {
            error |= fill_statistics(context, result, summary->results[k].statistics);
        }
        if (summary->results[k].remark != NULL) {
            error |= add_member(result, "remark", make_text(context, summary->results[k].remark));
        }
        error |= add_named(context, results, summary->results[k].probe, result);
    }
    return finish(results, error);
}

static int fill_expectation(mor_context *context, json_t *item, const mor_summary_expectation *expectation,
                            const char *unit)
{
    int error = add_member(item, "probe", make_text(context, expectation->probe));
    error |= add_member(item, "statistic", make_text(context, expectation->statistic));
    error |= add_member(item, "measured", make_number(expectation->measured));
    error |= add_member(item, "reference", make_number(expectation->reference));
    error |= add_member(item, "tolerance", make_number(expectation->tolerance));
    error |= add_member(item, "tolerance_low", make_number(expectation->tolerance_low));
    error |= add_member(item, "tolerance_kind", json_string(expectation->is_absolute ? "absolute" : "relative"));
    error |= add_member(item, "unit", make_text(context, unit));
    error |= add_member(item, "pass", json_boolean(expectation->passes));
    error |= add_member(item, "source", make_text(context, expectation->source == NULL ? "" : expectation->source));
    return error;
}

static json_t *make_expectations(mor_context *context, const mor_summary *summary)
{
    json_t *list = json_array();
    int error = 0;
    for (int k = 0; k < summary->n_expectations; ++k) {
        const mor_summary_expectation *expectation = &summary->expectations[k];
        json_t *item = json_object();
        error |= fill_expectation(
            context, item, expectation,
            mor_summary_find_unit(mor_summary_find_result(summary, expectation->probe), expectation->statistic));
        error |= json_array_append_new(list, item);
    }
    return finish(list, error);
}

static json_t *make_warnings(mor_context *context, const mor_summary *summary)
{
    json_t *list = json_array();
    for (int k = 0; k < summary->n_warnings; ++k) {
        if (json_array_append_new(list, make_text(context, summary->warnings[k])) != 0) {
            json_decref(list);
            return NULL;
        }
    }
    return list;
}

static json_t *make_plugins(mor_context *context, const mor_summary *summary)
{
    json_t *list = json_array();
    int error = 0;
    for (int k = 0; k < summary->n_plugins; ++k) {
        json_t *item = json_object();
        error |= add_member(item, "path", make_text(context, summary->plugins[k].path));
        error |= add_member(item, "models", make_text(context, summary->plugins[k].models));
        error |= add_member(item, "hash", make_hash(summary->plugins[k].hash));
        error |= json_array_append_new(list, item);
    }
    return finish(list, error);
}

static json_t *make_provenance(mor_context *context, const mor_summary *summary)
{
    json_t *provenance = json_object();
    json_t *inputs = json_object();
    int error = add_member(provenance, "version", make_text(context, summary->version));
    error |= add_member(provenance, "commit", make_text(context, summary->commit));
    error |= add_member(provenance, "seed", make_seed(summary->seed));
    error |= add_member(provenance, "command", make_text(context, summary->command));
    error |= add_member(provenance, "threads", json_integer(summary->n_threads));
    for (int k = 0; k < summary->n_inputs; ++k) {
        error |= add_named(context, inputs, summary->inputs[k].path, make_hash(summary->inputs[k].hash));
    }
    error |= add_member(provenance, "inputs", inputs);
    error |= add_member(provenance, "plugins", make_plugins(context, summary));
    return finish(provenance, error);
}

static json_t *make_failure(mor_context *context, const mor_summary_failure *failure)
{
    if (failure == NULL) {
        return json_null();
    }
    const bool has_particle = failure->set[0] != '\0';
    json_t *object = json_object();
    int error = add_member(object, "reason", make_text(context, failure->reason));
    error |= add_member(object, "time", make_number(failure->time));
    error |= add_member(object, "end", make_number(failure->end));
    error |= add_member(object, "step", json_integer(failure->step));
    error |= add_member(object, "set", has_particle ? make_text(context, failure->set) : json_null());
    error |= add_member(object, "particle", has_particle ? json_integer(failure->particle) : json_null());
    return finish(object, error);
}

static const char *const COUNTS[] = {"updates", "sub_steps", "rejected", "rates", "failures"};
enum { N_COUNTS = sizeof COUNTS / sizeof *COUNTS };

static json_t *make_integration(const mor_summary_integration *it)
{
    const int64_t counts[N_COUNTS] = {it->n_updates, it->n_sub_steps, it->n_rejected, it->n_rates, it->n_failures};
    json_t *object = json_object();
    int error = 0;
    for (int k = 0; k < N_COUNTS; ++k) {
        error |= add_member(object, COUNTS[k], json_integer(counts[k]));
    }
    return finish(object, error);
}

static json_t *make_settling(const mor_summary_settling *it)
{
    json_t *object = json_object();
    int error = add_member(object, "method", json_string(it->method));
    error |= add_member(object, "time", make_number(it->time));
    error |= add_member(object, "steps", make_number(it->n_steps));
    error |= add_member(object, "unbalanced_force", make_number(it->unbalanced_force));
    error |= add_member(object, "unbalanced_force_largest", make_number(it->unbalanced_force_largest));
    error |= add_member(object, "displacement", make_number(it->displacement));
    return finish(object, error);
}

/* The whole document, NULL when memory runs out or two names are the same. */
static json_t *make_document(mor_context *context, const mor_summary *summary)
{
    json_t *document = json_object();
    json_t *speed = json_pack("{so}", "particle_steps_per_second", make_number(summary->particle_steps_per_second));
    json_t *memory = json_pack("{so}", "bytes_per_fine_particle", make_number(summary->bytes_per_fine_particle));
    int error = add_member(document, "version", json_integer(MOR_SUMMARY_VERSION));
    error |= add_member(document, "status", json_string(summary->failure != NULL ? FAILED : FINISHED));
    error |= add_member(document, "failure", make_failure(context, summary->failure));
    error |= add_member(document, "results", make_results(context, summary));
    error |= add_member(document, "expect", make_expectations(context, summary));
    if (summary->integration != NULL) {
        error |= add_member(document, "integration", make_integration(summary->integration));
    }
    if (summary->settling != NULL) {
        error |= add_member(document, "settling", make_settling(summary->settling));
    }
    error |= add_member(document, "warnings", make_warnings(context, summary));
    error |= add_member(document, "state_hash", make_hash(summary->state_hash));
    error |= add_member(document, "speed", speed);
    error |= add_member(document, "memory", memory);
    error |= add_member(document, "provenance", make_provenance(context, summary));
    return finish(document, error);
}

mor_status mor_summary_write(mor_context *context, const char *path, const mor_summary *summary)
{
    MOR_TRY(context, mor_summary_check_consistency(context, summary));
    json_t *document = make_document(context, summary);
    MOR_CHECK(context, document != NULL, MOR_ERROR_ARGUMENT,
              "the summary '%s' cannot be made: two probes or two inputs have the same name, or memory ran out", path);
    mor_durable_file file;
    mor_status status = mor_durable_file_open(context, &file, path);
    if (status == MOR_OK) {
        /* A failed write sets the error flag of the stream, which the commit checks. */
        json_dumpf(document, file.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        fputc('\n', file.stream);
        status = mor_durable_file_commit(context, &file);
    }
    json_decref(document);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

/* ---- checking and reading ---------------------------------------------------------------------------------------- */

static mor_status fail_member(mor_context *context, const char *path, const char *member, const char *expected)
{
    return MOR_FAIL(context, MOR_ERROR_IO, "'%s' is not a complete summary: '%s' must be %s", path, member, expected);
}

static bool is_number_or_null(const json_t *value)
{
    return json_is_number(value) || json_is_null(value);
}

static bool is_hash(const json_t *value)
{
    const char *text = json_string_value(value);
    return text != NULL && strlen(text) == MOR_HASH_TEXT_BYTES - 1 &&
           strspn(text, "0123456789abcdef") == MOR_HASH_TEXT_BYTES - 1;
}

/* A result may have no statistics; one that has any has all of them. */
static bool is_statistics(const json_t *result)
{
    static const char *const numbers[] = {"maximum", "time_of_maximum", "minimum", "time_of_minimum", "mean"};
    static const char *const counts[] = {"interval", "measured", "skipped"};
    const json_t *window = json_object_get(result, "window");
    const json_t *impulse = json_object_get(result, "impulse");
    const json_t *remark = json_object_get(result, "remark");
    bool is_good = json_array_size(window) == 2 && is_number_or_null(json_array_get(window, 0)) &&
                   is_number_or_null(json_array_get(window, 1));
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        is_good = is_good && is_number_or_null(json_object_get(result, numbers[k]));
    }
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k) {
        is_good = is_good && json_is_integer(json_object_get(result, counts[k]));
    }
    is_good = is_good && (impulse == NULL ||
                          (is_number_or_null(impulse) && json_is_string(json_object_get(result, "impulse_unit"))));
    return is_good && (remark == NULL || json_is_string(remark));
}

static mor_status check_results(mor_context *context, const char *path, json_t *results)
{
    if (!json_is_object(results)) {
        return fail_member(context, path, "results", "an object");
    }
    const char *name = NULL;
    json_t *result = NULL;
    json_object_foreach(results, name, result)
    {
        if (!is_number_or_null(json_object_get(result, "value")) || !json_is_string(json_object_get(result, "unit"))) {
            return fail_member(context, path, name, "an object with a number or null as value and a text as unit");
        }
        if (json_object_get(result, "maximum") != NULL && !is_statistics(result)) {
            return fail_member(context, path, name, "an object with all of the statistics or none");
        }
    }
    return MOR_OK;
}

static mor_status check_expectation(mor_context *context, const char *path, const json_t *item, const json_t *results)
{
    static const char *const numbers[] = {"measured", "reference", "tolerance", "tolerance_low"};
    static const char *const texts[] = {"probe", "statistic", "tolerance_kind", "unit", "source"};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        if (!is_number_or_null(json_object_get(item, numbers[k]))) {
            return fail_member(context, path, numbers[k], "a number or null in each expectation");
        }
    }
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        if (!json_is_string(json_object_get(item, texts[k]))) {
            return fail_member(context, path, texts[k], "a text in each expectation");
        }
    }
    if (!json_is_boolean(json_object_get(item, "pass"))) {
        return fail_member(context, path, "pass", "true or false in each expectation");
    }
    const json_t *result = json_object_get(results, json_string_value(json_object_get(item, "probe")));
    const char *statistic = json_string_value(json_object_get(item, "statistic"));
    if (result == NULL || !json_equal(json_object_get(result, statistic), json_object_get(item, "measured"))) {
        return fail_member(context, path, json_string_value(json_object_get(item, "probe")),
                           "among the results with the number that its expectation calls measured");
    }
    return MOR_OK;
}

static mor_status check_warnings(mor_context *context, const char *path, const json_t *warnings)
{
    bool is_good = json_is_array(warnings);
    for (size_t k = 0; k < json_array_size(warnings); ++k) {
        is_good = is_good && json_is_string(json_array_get(warnings, k));
    }
    return is_good ? MOR_OK : fail_member(context, path, "warnings", "an array of texts");
}

/* Summaries of earlier versions have no such list. */
static mor_status check_plugins(mor_context *context, const char *path, const json_t *plugins)
{
    bool is_good = plugins == NULL || json_is_array(plugins);
    for (size_t k = 0; k < json_array_size(plugins); ++k) {
        const json_t *item = json_array_get(plugins, k);
        is_good = is_good && json_is_string(json_object_get(item, "path")) &&
                  json_is_string(json_object_get(item, "models")) && is_hash(json_object_get(item, "hash"));
    }
    return is_good ? MOR_OK : fail_member(context, path, "plugins", "an array of paths, models and hashes");
}

static mor_status check_provenance(mor_context *context, const char *path, const json_t *provenance)
{
    static const char *const texts[] = {"version", "commit", "command"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        if (!json_is_string(json_object_get(provenance, texts[k]))) {
            return fail_member(context, path, texts[k], "a text in the provenance");
        }
    }
    const json_t *seed = json_object_get(provenance, "seed");
    if (!json_is_integer(seed) && !json_is_string(seed)) {
        return fail_member(context, path, "seed", "a whole number or a text in the provenance");
    }
    if (!json_is_integer(json_object_get(provenance, "threads"))) {
        return fail_member(context, path, "threads", "a whole number in the provenance");
    }
    json_t *inputs = json_object_get(provenance, "inputs");
    if (!json_is_object(inputs)) {
        return fail_member(context, path, "inputs", "an object in the provenance");
    }
    const char *name = NULL;
    json_t *hash = NULL;
    json_object_foreach(inputs, name, hash)
    {
        if (!is_hash(hash)) {
            return fail_member(context, path, name, "16 hexadecimal digits");
        }
    }
    return check_plugins(context, path, json_object_get(provenance, "plugins"));
}

static mor_status check_outcome(mor_context *context, const char *path, const json_t *document)
{
    const char *status = json_string_value(json_object_get(document, "status"));
    if (status == NULL || (strcmp(status, FINISHED) != 0 && strcmp(status, FAILED) != 0)) {
        return fail_member(context, path, "status", "finished or failed");
    }
    const json_t *failure = json_object_get(document, "failure");
    const bool fits = strcmp(status, FINISHED) == 0 ? json_is_null(failure)
                                                    : json_is_string(json_object_get(failure, "reason")) &&
                                                          is_number_or_null(json_object_get(failure, "time")) &&
                                                          is_number_or_null(json_object_get(failure, "end")) &&
                                                          json_is_integer(json_object_get(failure, "step"));
    return fits ? MOR_OK : fail_member(context, path, "failure", "null of a run that finished, else why it failed");
}

static mor_status check_integration(mor_context *context, const char *path, const json_t *integration)
{
    for (int k = 0; k < N_COUNTS && integration != NULL; ++k) {
        if (!json_is_integer(json_object_get(integration, COUNTS[k]))) {
            return fail_member(context, path, "integration", "whole numbers of updates, sub_steps and so on");
        }
    }
    return MOR_OK;
}

static mor_status check_document(mor_context *context, const char *path, const json_t *document)
{
    const json_t *version = json_object_get(document, "version");
    if (!json_is_integer(version) || json_integer_value(version) != MOR_SUMMARY_VERSION) {
        return fail_member(context, path, "version", "1");
    }
    MOR_TRY(context, check_outcome(context, path, document));
    json_t *results = json_object_get(document, "results");
    MOR_TRY(context, check_results(context, path, results));
    const json_t *expectations = json_object_get(document, "expect");
    if (!json_is_array(expectations)) {
        return fail_member(context, path, "expect", "an array");
    }
    for (size_t k = 0; k < json_array_size(expectations); ++k) {
        MOR_TRY(context, check_expectation(context, path, json_array_get(expectations, k), results));
    }
    MOR_TRY(context, check_integration(context, path, json_object_get(document, "integration")));
    MOR_TRY(context, check_warnings(context, path, json_object_get(document, "warnings")));
    if (!is_hash(json_object_get(document, "state_hash"))) {
        return fail_member(context, path, "state_hash", "16 hexadecimal digits");
    }
    const json_t *speed = json_object_get(document, "speed");
    if (!is_number_or_null(json_object_get(speed, "particle_steps_per_second"))) {
        return fail_member(context, path, "speed.particle_steps_per_second", "a number or null");
    }
    const json_t *memory = json_object_get(document, "memory");
    if (!is_number_or_null(json_object_get(memory, "bytes_per_fine_particle"))) {
        return fail_member(context, path, "memory.bytes_per_fine_particle", "a number or null");
    }
    MOR_TRY(context, check_provenance(context, path, json_object_get(document, "provenance")));
    return MOR_OK;
}

static mor_status load_document(mor_context *context, const char *path, json_t **document)
{
    json_error_t error;
    *document = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    MOR_CHECK(context, *document != NULL, MOR_ERROR_IO, "cannot read '%s' as JSON: line %d: %s", path, error.line,
              error.text);
    const mor_status status = check_document(context, path, *document);
    if (status != MOR_OK) {
        json_decref(*document);
        *document = NULL;
    }
    return status;
}

mor_status mor_summary_check(mor_context *context, const char *path)
{
    json_t *document = NULL;
    MOR_TRY(context, load_document(context, path, &document));
    json_decref(document);
    return MOR_OK;
}

static double read_number(const json_t *number)
{
    return json_is_number(number) ? json_number_value(number) : NAN;
}

mor_status mor_summary_read_outcome(mor_context *context, const char *path, mor_summary_outcome *outcome)
{
    *outcome = (mor_summary_outcome){.is_failed = false};
    json_t *document = NULL;
    MOR_TRY(context, load_document(context, path, &document));
    const json_t *expectations = json_object_get(document, "expect");
    outcome->is_failed = strcmp(json_string_value(json_object_get(document, "status")), FAILED) == 0;
    outcome->n_warnings = (int)json_array_size(json_object_get(document, "warnings"));
    for (size_t k = 0; k < json_array_size(expectations); ++k) {
        outcome->n_missed += !json_is_true(json_object_get(json_array_get(expectations, k), "pass"));
    }
    json_decref(document);
    return MOR_OK;
}

mor_status mor_summary_visit_warnings(mor_context *context, const char *path, mor_summary_visitor visit, void *user)
{
    json_t *document = NULL;
    MOR_TRY(context, load_document(context, path, &document));
    const json_t *warnings = json_object_get(document, "warnings");
    for (size_t k = 0; k < json_array_size(warnings); ++k) {
        visit(user, json_string_value(json_array_get(warnings, k)));
    }
    json_decref(document);
    return MOR_OK;
}

mor_status mor_summary_read_speed(mor_context *context, const char *path, double *speed)
{
    *speed = NAN;
    json_t *document = NULL;
    MOR_TRY(context, load_document(context, path, &document));
    *speed = read_number(json_object_get(json_object_get(document, "speed"), "particle_steps_per_second"));
    json_decref(document);
    return MOR_OK;
}

mor_status mor_summary_read_statistics(mor_context *context, const char *path, const char *probe,
                                       mor_summary_statistics *statistics, char *remark, size_t n_bytes)
{
    json_t *document = NULL;
    *statistics = (mor_summary_statistics){NAN, NAN, NAN, NAN, NAN, NAN, NULL, {NAN, NAN}, 0.0, 0.0, 0};
    remark[0] = '\0';
    MOR_TRY(context, load_document(context, path, &document));
    const json_t *result = json_object_get(json_object_get(document, "results"), probe);
    mor_status status = MOR_OK;
    if (json_object_get(result, "maximum") == NULL) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "'%s' has no statistics of a result named '%s'", path, probe);
    } else {
        const json_t *window = json_object_get(result, "window");
        const json_t *text = json_object_get(result, "remark");
        statistics->maximum = read_number(json_object_get(result, "maximum"));
        statistics->minimum = read_number(json_object_get(result, "minimum"));
        statistics->time_of_maximum = read_number(json_object_get(result, "time_of_maximum"));
        statistics->time_of_minimum = read_number(json_object_get(result, "time_of_minimum"));
        statistics->mean = read_number(json_object_get(result, "mean"));
        statistics->impulse = read_number(json_object_get(result, "impulse"));
        statistics->window[0] = read_number(json_array_get(window, 0));
        statistics->window[1] = read_number(json_array_get(window, 1));
        statistics->interval = (int)json_integer_value(json_object_get(result, "interval"));
        statistics->n_measured = (double)json_integer_value(json_object_get(result, "measured"));
        statistics->n_skipped = (double)json_integer_value(json_object_get(result, "skipped"));
        snprintf(remark, n_bytes, "%s", text == NULL ? "" : json_string_value(text));
    }
    json_decref(document);
    return status;
}

mor_status mor_summary_read_result(mor_context *context, const char *path, const char *probe, double *value, char *unit,
                                   size_t n_bytes)
{
    *value = NAN;
    unit[0] = '\0';
    json_t *document = NULL;
    MOR_TRY(context, load_document(context, path, &document));
    const json_t *result = json_object_get(json_object_get(document, "results"), probe);
    const char *found = json_string_value(json_object_get(result, "unit"));
    mor_status status = MOR_OK;
    if (result == NULL) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "'%s' has no result named '%s'", path, probe);
    } else if (strlen(found) >= n_bytes) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "the unit '%s' of result '%s' in '%s' is longer than %zu bytes", found,
                          probe, path, n_bytes - 1);
    } else {
        *value = read_number(json_object_get(result, "value"));
        memcpy(unit, found, strlen(found) + 1);
    }
    json_decref(document);
    return status;
}
