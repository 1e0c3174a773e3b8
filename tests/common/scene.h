/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SCENE_H
#define MOR_TESTS_COMMON_SCENE_H

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/probe/probe.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "core/base/memory.h"
#include "materials/builtin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  A simulation from the text of a case or a shipped case file, for tests of whole steps; it writes no file. Whatever
 *  goes wrong fails the running test with the library's message. */

/** One simulation with everything it borrows. Owner: the test, which ends it with scene_free. */
typedef struct scene {
    mor_context context;
    mor_registry *registry;
    mor_case the_case;
    mor_simulation simulation;
    int32_t *place; /* shape [n_particles]; where the particle of an id stands now, see scene_find_places */
} scene;

/** What a scene is made from. Borrowed. */
typedef struct scene_request {
    const char *text; /* zero-terminated; the case, with ' in place of "; or the path of a .cfg file */
    const char *const *const *settings; /* shape [n_lists] of lists of "key=value", each ended by NULL, ' for " too */
    int n_lists;                        /* number of lists, 0 to SCENE_LISTS_MAX */
    int n_threads;                      /* 0: one */
} scene_request;

enum { SCENE_LISTS_MAX = 4, SCENE_SETTINGS_MAX = 24 };

/** Copies a text, zero-terminated, with " for '; the caller frees it. */
static inline char *scene_quote(const char *text)
{
    char *copy = strdup(text);
    assert_non_null(copy);
    for (char *mark = strchr(copy, '\''); mark != NULL; mark = strchr(mark, '\'')) {
        *mark = '"';
    }
    return copy;
}

/** Fails the running test unless found is within tolerance of expected, all in one unit; what is zero-terminated. */
static inline void scene_expect_near(const char *what, double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s is %.9g, not %.9g within %.3g", what, found, expected, tolerance);
    }
}

/** Fails the running test unless a call of the library went well. */
static inline void scene_require(const scene *it, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

/** Reads the case of a scene; settings stand in lists as in the request. */
static inline void scene_read(scene *it, const scene_request *request)
{
    char *settings[SCENE_SETTINGS_MAX];
    char *text = scene_quote(request->text);
    int n_settings = 0;
    for (int list = 0; list < request->n_lists; ++list) {
        for (const char *const *setting = request->settings[list]; *setting != NULL; ++setting) {
            assert_true(n_settings < SCENE_SETTINGS_MAX);
            settings[n_settings++] = scene_quote(*setting);
        }
    }
    const size_t length = strlen(text);
    if (length > 4 && strcmp(text + length - 4, ".cfg") == 0) {
        scene_require(it, mor_case_read(&it->context, text, (const char *const *)settings, n_settings, it->registry,
                                        mor_probe_type_at, &it->the_case));
    } else {
        const mor_case_text source = {.name = "scene",
                                      .text = text,
                                      .n_bytes = (int64_t)length,
                                      .settings = (const char *const *)settings,
                                      .n_settings = n_settings,
                                      .registry = it->registry,
                                      .probe_types = mor_probe_type_at};
        scene_require(it, mor_case_read_text(&it->context, &source, &it->the_case));
    }
    for (int k = 0; k < n_settings; ++k) {
        free(settings[k]);
    }
    free(text);
}

/** Builds a scene that has not settled, checked in any build where that is asked for; one object, owned by the
 *  caller. */
static inline scene *scene_build_checked(const scene_request *request, bool is_checked)
{
    scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    mor_context_init(&it->context);
    it->context.n_threads = request->n_threads > 0 ? request->n_threads : 1;
    it->context.is_checked = it->context.is_checked || is_checked;
    scene_require(it, mor_registry_new(&it->context, &it->registry));
    scene_require(it, mor_registry_add_list(&it->context, it->registry, mor_materials_builtin(NULL)));
    scene_read(it, request);
    scene_require(it, mor_simulation_init(&it->context, &it->simulation, &it->the_case, it->registry));
    scene_require(it, MOR_NEW(&it->context, &it->place, it->simulation.soil.set.n_particles, "places of particles"));
    return it;
}

/** The same, checked in the checked build alone. */
static inline scene *scene_build(const scene_request *request)
{
    return scene_build_checked(request, false);
}

/** Builds a scene and lets it settle where its case asks for that; one object, owned by the caller. */
static inline scene *scene_new(const scene_request *request)
{
    scene *it = scene_build(request);
    scene_require(it, mor_simulation_settle(&it->context, &it->simulation, NULL));
    return it;
}

/** Ends a scene; fails when it left memory behind. */
static inline void scene_free(scene *it)
{
    MOR_FREE(&it->context, &it->place);
    mor_simulation_clear(&it->context, &it->simulation);
    mor_case_clear(&it->context, &it->the_case);
    mor_registry_free(&it->context, &it->registry);
    const size_t n_bytes_left = it->context.memory_bytes;
    free(it);
    assert_int_equal(n_bytes_left, 0);
}

/** Takes a number of whole steps. */
static inline void scene_step(scene *it, int n_steps)
{
    mor_schedule *schedule = &it->simulation.schedule;
    for (int k = 0; k < n_steps; ++k) {
        scene_require(it, mor_schedule_step(&it->context, schedule, schedule->end));
    }
}

/** Steps until a time, unit s, is reached exactly; as in a run, probes that remember are asked after each step. */
static inline void scene_advance(scene *it, double time)
{
    mor_schedule *schedule = &it->simulation.schedule;
    const int64_t until = mor_schedule_ticks(schedule, time);
    while (schedule->now < until) {
        scene_require(it, mor_schedule_step(&it->context, schedule, until));
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    }
}

/** Evaluates a probe of the case by its name, zero-terminated; in the unit of mor_probe_unit. */
static inline double scene_probe(scene *it, const char *name)
{
    double value = 0.0;
    for (int k = 0; k < it->the_case.n_probes; ++k) {
        if (strcmp(it->the_case.probes[k].name, name) == 0) {
            scene_require(it, mor_probe_evaluate(&it->context, &it->simulation, k, &value));
            return value;
        }
    }
    fail_msg("the scene has no probe '%s'", name);
    return value;
}

/** Finds where each particle stands now, by its id: shape [n_particles], valid until the next step. */
static inline const int32_t *scene_find_places(scene *it)
{
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        it->place[set->id[i]] = (int32_t)i;
    }
    return it->place;
}

#endif
