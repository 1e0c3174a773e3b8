/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The element test of a material. */
#include "cases/driver/library/session_internal.h"
#include "cases/driver/probe/probe.h"

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/element/element_figure.h"
#include "cases/driver/element/element_point.h"
#include "cases/driver/element/element_test.h"
#include "cases/driver/scene/check/plausible.h"
#include "core/base/memory.h"
#include "core/material/params.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const double usual_density = 2000.0; /* kg/m3, of a common soil */

/* What is made on the way. */
typedef struct bench {
    mor_session *session;
    const char *model;            /* that was asked for; NULL: that of the case */
    const char *const *list;      /* shape [n] of settings */
    int n;                        /* number of settings */
    mor_case *the_case;           /* whose soil is taken; NULL: none; owned */
    const mor_material *material; /* borrowed */
    const char *soil_name;        /* of the case; NULL: none; borrowed */
    mor_element_settings settings;
    mor_element_record records[MOR_ELEMENT_SPECIMENS_MAX];
    mor_element_record data; /* that was measured; empty: none */
} bench;

/* A setting as the user of the program writes it. */
static const char *name_of(const bench *it, const char *key)
{
    return mor_element_names_find(&it->session->names, key);
}

/* ---- The law ----------------------------------------------------------------------------------------------------- */

static mor_status find_soil(const bench *it, const char *name, const mor_case_soil **soil)
{
    mor_context *context = &it->session->context;
    const mor_case *the_case = it->the_case;
    char all[1024] = "";
    *soil = NULL;
    for (int k = 0; k < the_case->n_soils; ++k) {
        const size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s'%s'", k == 0 ? "" : ", ", the_case->soils[k].name);
        const bool is_it = name != NULL ? strcmp(name, the_case->soils[k].name) == 0 : the_case->n_soils == 1;
        *soil = is_it ? &the_case->soils[k] : *soil;
    }
    MOR_CHECK(context, the_case->n_soils > 0, MOR_ERROR_CONFIG, "'%s' has no soil to be tested", the_case->path);
    MOR_CHECK(context, *soil != NULL || name == NULL, MOR_ERROR_CONFIG, "found no soil '%s' in '%s'; allowed: %s", name,
              the_case->path, all);
    MOR_CHECK(context, *soil != NULL, MOR_ERROR_CONFIG, "'%s' has several soils; choose one by %s: %s", the_case->path,
              name_of(it, "test.soil"), all);
    return MOR_OK;
}

/* Law, density and parameters of a soil of a case. */
static mor_status take_soil(bench *it, const mor_element_words *words)
{
    mor_context *context = &it->session->context;
    const mor_case_soil *soil = NULL;
    MOR_TRY(context, MOR_NEW(context, &it->the_case, 1, "a case"));
    MOR_TRY(context,
            mor_case_read(context, words->case_file, NULL, 0, it->session->registry, mor_probe_type_at, it->the_case));
    MOR_TRY(context, find_soil(it, words->soil, &soil));
    MOR_CHECK(context, it->model == NULL || strcmp(it->model, soil->model) == 0, MOR_ERROR_CONFIG,
              "found the model '%s', but soil '%s' of '%s' has '%s'; leave the model out, or the case", it->model,
              soil->name, words->case_file, soil->model);
    it->material = soil->law;
    it->soil_name = soil->name;
    it->settings.density = soil->density;
    memcpy(it->settings.parameters, soil->parameters,
           (size_t)mor_params_count(it->material->parameters) * sizeof *soil->parameters);
    return MOR_OK;
}

/* Says how a model that is not known becomes known; the message that there is tells the rest. */
static mor_status explain_unknown(const bench *it, const char *name)
{
    mor_context *context = &it->session->context;
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    const char *loading = name_of(it, "plugins");
    MOR_CHECK(context, mor_registry_find_interface(it->session->registry, name) == NULL, MOR_ERROR_CONFIG,
              "found '%s', an interface to laws of other programs, in place of a model; allowed: a soil of a case that "
              "tells library and constants of such a law; give the case by %s",
              name, name_of(it, "test.case"));
    snprintf(why, sizeof why, "%.1500s", context->message);
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s; the law of a plug-in is known once that is loaded, by %s or by a case (%s) that has plugins = "
                    "[ \"./FILE.so\" ]",
                    why, strcmp(loading, "plugins") == 0 ? "mor_session_add_plugin" : loading,
                    name_of(it, "test.case"));
}

static mor_status take_model(bench *it, const mor_element_words *words)
{
    mor_context *context = &it->session->context;
    if (words->case_file != NULL) {
        return take_soil(it, words);
    }
    MOR_CHECK(context, it->model != NULL, MOR_ERROR_CONFIG,
              "found no model to be tested; give its name, or a case by %s", name_of(it, "test.case"));
    MOR_CHECK(context, words->soil == NULL, MOR_ERROR_CONFIG, "found %s without %s; give both",
              name_of(it, "test.soil"), name_of(it, "test.case"));
    const mor_status status = mor_registry_require(context, it->session->registry, it->model, &it->material);
    if (status != MOR_OK) {
        return explain_unknown(it, it->model);
    }
    it->settings.density = usual_density;
    mor_params_defaults(it->material->parameters, it->settings.parameters);
    return MOR_OK;
}

/* ---- Results ----------------------------------------------------------------------------------------------------- */

static mor_status join_table(mor_context *context, const char *folder, int specimen, char *path)
{
    char name[64];
    snprintf(name, sizeof name, "specimen-%d.csv", specimen + 1);
    return mor_durable_file_join(context, path, folder, name);
}

static bool is_same_file(const char *path, const char *other)
{
    struct stat of_path;
    struct stat of_other;
    return other != NULL && stat(path, &of_path) == 0 && stat(other, &of_other) == 0 &&
           of_path.st_dev == of_other.st_dev && of_path.st_ino == of_other.st_ino;
}

/* Measured values are not written over. */
static mor_status keep_data(const bench *it, const char *folder, const char *data)
{
    mor_context *context = &it->session->context;
    for (int k = 0; k < it->settings.n_specimens; ++k) {
        char path[MOR_PATH_BYTES];
        MOR_TRY(context, join_table(context, folder, k, path));
        MOR_CHECK(context, !is_same_file(path, data), MOR_ERROR_CONFIG,
                  "found %s = '%s', which a table of the test would replace; allowed is a file that stays; choose "
                  "another folder, or rename the file",
                  name_of(it, "test.data"), data);
    }
    return MOR_OK;
}

/* Tables of an earlier test with more specimens would be taken for those of this one. What was not written by a test,
 * and the measured values of this one, stay. */
static mor_status remove_earlier(bench *it, const char *folder, const char *data)
{
    mor_context *context = &it->session->context;
    for (int k = it->settings.n_specimens; k < MOR_ELEMENT_SPECIMENS_MAX; ++k) {
        char path[MOR_PATH_BYTES];
        MOR_TRY(context, join_table(context, folder, k, path));
        if (mor_element_record_is_table(path) && !is_same_file(path, data)) {
            MOR_CHECK(context, unlink(path) == 0, MOR_ERROR_IO,
                      "'%s', a table of an earlier test with more specimens, cannot be removed: %s; choose another "
                      "folder",
                      path, strerror(errno));
            fprintf(it->session->output, "removed: %s, of an earlier test with more specimens\n", path);
        }
    }
    return MOR_OK;
}

/* The folder where none is given: that of the soil, else of the model. What does not belong into the name of a folder
 * becomes '_'. */
static const char *name_folder(const bench *it, const char *folder, char *usual, size_t usual_bytes)
{
    static const char start[] = "runs/material-";
    if (folder != NULL) {
        return folder;
    }
    snprintf(usual, usual_bytes, "%s%.200s", start, it->soil_name != NULL ? it->soil_name : it->material->name);
    for (char *letter = usual + strlen(start); *letter != '\0'; ++letter) {
        const bool is_fit = (unsigned char)*letter > ' ' && strchr("/\\:*?\"<>|", *letter) == NULL;
        *letter = is_fit ? *letter : '_';
    }
    return usual;
}

static mor_status write_results(bench *it, const char *folder, const char *data)
{
    mor_context *context = &it->session->context;
    char path[MOR_PATH_BYTES];
    char usual[MOR_PATH_BYTES];
    folder = name_folder(it, folder, usual, sizeof usual);
    MOR_TRY(context, mor_run_folder_refuse_run(context, folder, "choose another folder"));
    MOR_TRY(context, mor_run_folder_make(context, folder));
    MOR_TRY(context, keep_data(it, folder, data));
    MOR_TRY(context, remove_earlier(it, folder, data));
    for (int k = 0; k < it->settings.n_specimens; ++k) {
        MOR_TRY(context, join_table(context, folder, k, path));
        MOR_TRY(context, mor_element_record_write(context, &it->records[k], path));
        fprintf(it->session->output, "table: %s\n", path);
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "element.png"));
    MOR_TRY(context, mor_element_figure_write(context, &it->settings, it->records, it->settings.n_specimens,
                                              it->data.n_rows > 0 ? &it->data : NULL, path));
    fprintf(it->session->output, "picture: %s\n", path);
    return MOR_OK;
}

/* The stress update that a run failed at, once more. A case gives a law that has no name of its own outside of it. */
static mor_status replay_point(bench *it, const mor_element_words *words)
{
    mor_context *context = &it->session->context;
    const int n_words = 1 + (words->case_file != NULL) + (words->soil != NULL);
    mor_element_point point = {.model = ""};
    MOR_CHECK(
        context, it->n == n_words, MOR_ERROR_CONFIG,
        "found %s with other settings than %s and %s; a failed update is repeated as it was: remove them, or change "
        "the file",
        name_of(it, "test.replay"), name_of(it, "test.case"), name_of(it, "test.soil"));
    if (words->case_file != NULL) {
        MOR_TRY(context, take_soil(it, words));
    }
    const mor_status status =
        mor_element_point_read(context, words->replay, it->session->registry, &it->material, &point);
    if (status == MOR_ERROR_CONFIG && it->material == NULL && point.model[0] != '\0') {
        return explain_unknown(it, point.model);
    }
    MOR_TRY(context, status);
    MOR_CHECK(context, it->model == NULL || strcmp(it->model, point.model) == 0, MOR_ERROR_CONFIG,
              "found the model '%s', but '%s' is of '%s'; leave the model out", it->model, words->replay, point.model);
    return mor_element_point_replay(context, it->material, &point, it->session->output);
}

/* The void ratio that all specimens start from; NaN: they have none, or not the same. */
static double find_start_void_ratio(const bench *it)
{
    const double first = it->records[0].values[MOR_ELEMENT_VOID_RATIO];
    bool is_common = true;
    for (int k = 0; k < it->settings.n_specimens; ++k) {
        is_common = is_common && it->records[k].values[MOR_ELEMENT_VOID_RATIO] == first;
    }
    return is_common ? first : NAN;
}

static mor_status test_material(bench *it, const char *folder)
{
    mor_context *context = &it->session->context;
    mor_element_words words;
    mor_element_words_find(it->list, it->n, &words);
    if (words.replay != NULL) {
        return replay_point(it, &words);
    }
    MOR_TRY(context, take_model(it, &words));
    MOR_TRY(context, mor_element_settings_read(context, it->material, it->list, it->n, &it->settings));
    mor_plausible_warn_of_soil_density(context, it->material->name, it->settings.density);
    if (words.data != NULL) {
        MOR_TRY(context, mor_element_record_read(context, words.data, &it->data));
    }
    MOR_TRY(context, mor_element_test_run(context, it->material, &it->settings, it->records));
    mor_element_test_print(it->material, &it->settings, it->records, it->session->output);
    mor_element_record_complete(it->settings.path, find_start_void_ratio(it), &it->data);
    MOR_TRY(context, write_results(it, folder, words.data));
    for (int k = 0; k < it->settings.n_specimens; ++k) {
        MOR_CHECK(context, it->records[k].status == MOR_OK, it->records[k].status,
                  "the specimen of %s did not reach the end of its path; its table ends where it stopped",
                  it->records[k].name);
    }
    return MOR_OK;
}

mor_status mor_session_test_material(mor_session *session, const char *model, const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    bench *it = NULL;
    MOR_TRY(context, MOR_NEW(context, &it, 1, "an element test"));
    it->session = session;
    it->model = model;
    it->list = (const char *const *)session->overrides;
    it->n = session->n_overrides;
    it->settings.names = &session->names;
    const mor_status status = test_material(it, folder);
    for (int k = 0; k < MOR_ELEMENT_SPECIMENS_MAX; ++k) {
        mor_element_record_clear(context, &it->records[k]);
    }
    mor_element_record_clear(context, &it->data);
    if (it->the_case != NULL) {
        mor_case_clear(context, it->the_case);
        MOR_FREE(context, &it->the_case);
    }
    MOR_FREE(context, &it);
    return status;
}
