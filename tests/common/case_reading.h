/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_CASE_READING_H
#define MOR_TESTS_COMMON_CASE_READING_H

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/case/write/case_write.h"
#include "cases/driver/probe/probe.h"
#include "core/material/params.h"
#include "materials/builtin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What tests of reading and writing cases share: two cases, a scale, and a round trip that compare everything. */

typedef struct case_reading {
    mor_context context;
    mor_context units_context;
    mor_units *units;
    mor_registry *registry;
    mor_case first;
    mor_case second;
} case_reading;

static inline int case_reading_set_up(void **state)
{
    case_reading *f = calloc(1, sizeof *f);
    if (f == NULL) {
        return 1;
    }
    *state = f;
    mor_context_init(&f->context);
    mor_context_init(&f->units_context);
    return mor_units_new(&f->units_context, &f->units) != MOR_OK ||
           mor_registry_new(&f->context, &f->registry) != MOR_OK ||
           mor_registry_add_list(&f->context, f->registry, mor_materials_builtin(NULL)) != MOR_OK;
}

static inline int case_reading_tear_down(void **state)
{
    case_reading *f = *state;
    mor_case_clear(&f->context, &f->first);
    mor_case_clear(&f->context, &f->second);
    mor_registry_free(&f->context, &f->registry);
    mor_units_free(&f->units_context, &f->units);
    const int is_leaking = f->context.memory_bytes != 0;
    free(f);
    return is_leaking;
}

static inline mor_status case_reading_try(case_reading *f, const char *text, size_t n_bytes,
                                          const char *const *settings, mor_case *out)
{
    int n_settings = 0;
    while (settings != NULL && settings[n_settings] != NULL) {
        ++n_settings;
    }
    const mor_case_text given = {.name = "t.cfg",
                                 .text = text,
                                 .n_bytes = (int64_t)n_bytes,
                                 .settings = settings,
                                 .n_settings = n_settings,
                                 .registry = f->registry,
                                 .probe_types = mor_probe_type_at,
                                 .units = f->units};
    mor_case_clear(&f->context, out);
    return mor_case_read_text(&f->context, &given, out);
}

static inline void case_reading_read(case_reading *f, const char *text, const char *const *settings, mor_case *out)
{
    if (case_reading_try(f, text, strlen(text), settings, out) != MOR_OK) {
        fail_msg("%s", f->context.message);
    }
}

static inline void case_reading_refuse(case_reading *f, const char *text, const char *const *settings,
                                       const char *start, const char *fragment)
{
    const mor_status status = case_reading_try(f, text, strlen(text), settings, &f->first);
    if (status != MOR_ERROR_CONFIG || strncmp(f->context.message, start, strlen(start)) != 0 ||
        strstr(f->context.message, fragment) == NULL) {
        fail_msg("status %d, message '%s'; expected '%s ... %s'", (int)status, f->context.message, start, fragment);
    }
}

/* ---- The scale --------------------------------------------------------------------------------------------------- */

static inline void case_reading_scaled(case_reading *f, const mor_schema *schema, bool keeps_scale, const double *plain,
                                       const double *scaled)
{
    mor_dimension dimension;
    assert_int_equal(mor_units_dimension(&f->context, f->units, schema->unit, &dimension), MOR_OK);
    const int power = keeps_scale ? 0
                                  : 2 * dimension.power[MOR_BASE_LENGTH] - 4 * dimension.power[MOR_BASE_MASS] +
                                        6 * dimension.power[MOR_BASE_TIME];
    for (int a = 0; a < schema->n_components; ++a) {
        const double expected = ldexp(plain[a], power);
        if (memcmp(&expected, &scaled[a], sizeof expected) != 0 && !(isnan(plain[a]) && isnan(scaled[a]))) {
            fail_msg("%s: %g becomes %g, expected %g", schema->key, plain[a], scaled[a], expected);
        }
    }
}

static inline void case_reading_scaled_key(case_reading *f, const mor_case_key *key, const void *plain,
                                           const void *scaled)
{
    const mor_schema schema = mor_case_key_schema(key, f->first.dimension);
    if (key->storage == MOR_CASE_STORE_REALS) {
        case_reading_scaled(f, &schema, key->keeps_scale, (const double *)((const char *)plain + key->offset),
                            (const double *)((const char *)scaled + key->offset));
    }
}

static inline void case_reading_scaled_group(case_reading *f, const mor_case_group *group, const void *plain,
                                             const void *scaled)
{
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        case_reading_scaled_key(f, key, plain, scaled);
    }
}

static inline void case_reading_scaled_parameters(case_reading *f, const char *model, const double *plain,
                                                  const double *scaled)
{
    const mor_schema *schema = mor_registry_find(f->registry, model)->parameters;
    for (int p = 0; schema[p].key != NULL; ++p) {
        const int at = mor_params_offset(schema, p);
        case_reading_scaled(f, &schema[p], false, &plain[at], &scaled[at]);
    }
}

static inline void case_reading_scaled_body(case_reading *f, const mor_case_body *plain, const mor_case_body *scaled)
{
    case_reading_scaled_group(f, &mor_case_body_group, plain, scaled);
    case_reading_scaled_group(f, &mor_case_body_material_group, plain, scaled);
    if (!mor_case_body_is_rigid(plain)) {
        case_reading_scaled_parameters(f, plain->model, plain->parameters, scaled->parameters);
    }
    if (plain->has_spring) {
        case_reading_scaled_group(f, &mor_case_spring_group, plain, scaled);
    }
    for (const mor_case_key *key = mor_case_start_group.keys; key->schema.key != NULL; ++key) {
        if (mor_case_start_condition(plain->motion, key->schema.key) == NULL) {
            case_reading_scaled_key(f, key, plain, scaled);
        }
    }
}

/* The second case is the first with scale.length = 4, scale.mass = 1/16, scale.time = 64. */
static inline void case_reading_scaled_cases(case_reading *f)
{
    const mor_case *plain = &f->first;
    const mor_case *scaled = &f->second;
    case_reading_scaled_group(f, &mor_case_root_group, plain, scaled);
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        if (strcmp(group->name, "scale") != 0) {
            case_reading_scaled_group(f, group, plain, scaled);
        }
    }
    for (int k = 0; k < plain->n_soils; ++k) {
        const mor_case_soil *soil = &plain->soils[k];
        case_reading_scaled_group(f, &mor_case_soil_group, soil, &scaled->soils[k]);
        case_reading_scaled_group(f, &mor_case_material_group, soil, &scaled->soils[k]);
        case_reading_scaled_group(f, &mor_case_stress_group, soil, &scaled->soils[k]);
        case_reading_scaled_parameters(f, soil->model, soil->parameters, scaled->soils[k].parameters);
    }
    for (int k = 0; k < plain->n_walls; ++k) {
        case_reading_scaled_group(f, &mor_case_wall_group, &plain->walls[k], &scaled->walls[k]);
    }
    assert_int_equal(plain->n_bodies, scaled->n_bodies);
    for (int k = 0; k < plain->n_bodies; ++k) {
        case_reading_scaled_body(f, &plain->bodies[k], &scaled->bodies[k]);
    }
    case_reading_scaled_group(f, &mor_case_contact_group, &plain->contact, &scaled->contact);
    case_reading_scaled_group(f, &mor_case_maps_group, &plain->maps, &scaled->maps);
    for (int k = 0; k < plain->n_probes; ++k) {
        case_reading_scaled_group(f, &mor_case_probe_group, &plain->probes[k], &scaled->probes[k]);
    }
}

/* ---- Writing and reading again ----------------------------------------------------------------------------------- */

static inline char *case_reading_write(case_reading *f, const mor_case *the_case)
{
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    const mor_status status = mor_case_write_stream(&f->context, the_case, f->registry, stream);
    fclose(stream);
    if (status != MOR_OK) {
        fail_msg("%s", f->context.message);
    }
    return text;
}

static inline void case_reading_outlines(const mor_case_shape *a, const mor_case_shape *b)
{
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->is_flat, b->is_flat);
    assert_memory_equal(a->first, b->first, sizeof a->first);
    assert_memory_equal(a->second, b->second, sizeof a->second);
    assert_true(a->radius == b->radius && a->height == b->height && a->angle == b->angle); /* exact: the same bits */
    assert_memory_equal(&a->form, &b->form, sizeof a->form);       /* exact: the same bits, NaN included */
    assert_memory_equal(&a->ground, &b->ground, sizeof a->ground); /* exact: likewise */
    assert_true(a->file_hash == b->file_hash);                     /* exact: of the same file */
    assert_int_equal(a->n_points, b->n_points);
    for (int k = 0; k < 2 * a->n_points; ++k) {
        assert_true(a->points[k] == b->points[k]); /* exact: the same bits */
    }
    assert_int_equal(a->n_children, b->n_children);
    for (int k = 0; k < a->n_children; ++k) {
        case_reading_outlines(&a->children[k], &b->children[k]);
    }
}

/* Takes away what may differ: pointers, places, and what was written. */
static inline void case_reading_strip_body(mor_case_body *body)
{
    memset(&body->place, 0, sizeof body->place);
    memset(&body->outline, 0, sizeof body->outline);
    memset(&body->clamp_outline, 0, sizeof body->clamp_outline);
    body->shape = body->clamp = NULL;
    body->written = body->written_material = body->written_parameters = 0;
    body->written_spring = body->written_motion = 0;
}

static inline void case_reading_strip_rocks(mor_case_rocks *rocks)
{
    case_reading_strip_body(&rocks->body);
    memset(&rocks->region_outline, 0, sizeof rocks->region_outline);
    memset(rocks->shapes, 0, sizeof rocks->shapes);
    rocks->region = NULL;
    rocks->written = 0;
    for (int k = 0; k < rocks->n_forms; ++k) {
        rocks->forms[k].written = 0;
    }
    for (int k = 0; k < rocks->n_sizes; ++k) {
        rocks->sizes[k].written = 0;
    }
}

static inline mor_case *case_reading_strip(const mor_case *the_case)
{
    mor_case *copy = malloc(sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, the_case, sizeof *copy);
    memset(copy->path, 0, sizeof copy->path);
    copy->registry = NULL;
    copy->written = copy->written_domain = copy->written_lattice = copy->written_placement = 0;
    copy->written_scale = copy->written_numerics = copy->written_output = 0;
    for (int k = 0; k < copy->n_soils; ++k) {
        mor_case_soil *soil = &copy->soils[k];
        memset(&soil->place, 0, sizeof soil->place);
        memset(&soil->outline, 0, sizeof soil->outline);
        soil->shape = NULL;
        soil->law = NULL;
        soil->written = soil->written_stress = soil->written_material = soil->written_parameters = 0;
    }
    for (int k = 0; k < copy->n_walls; ++k) {
        memset(&copy->walls[k].place, 0, sizeof copy->walls[k].place);
        memset(&copy->walls[k].outline, 0, sizeof copy->walls[k].outline);
        copy->walls[k].shape = NULL;
        copy->walls[k].written = 0;
    }
    copy->bodies = NULL; /* compared one by one */
    for (int k = 0; k < copy->n_rocks; ++k) {
        case_reading_strip_rocks(&copy->rocks[k]);
    }
    copy->contact.written = 0;
    for (int k = 0; k < copy->contact.n_pairs; ++k) {
        memset(&copy->contact.pairs[k].place, 0, sizeof copy->contact.pairs[k].place);
        copy->contact.pairs[k].written = 0;
    }
    for (int k = 0; k < copy->n_probes; ++k) {
        memset(&copy->probes[k].place, 0, sizeof copy->probes[k].place);
        memset(&copy->probes[k].region_outline, 0, sizeof copy->probes[k].region_outline);
        copy->probes[k].region = NULL;
        copy->probes[k].path = NULL;
        copy->probes[k].written = 0;
    }
    for (int k = 0; k < copy->n_expectations; ++k) {
        memset(&copy->expectations[k].place, 0, sizeof copy->expectations[k].place);
        copy->expectations[k].written = 0;
    }
    return copy;
}

static inline void case_reading_round_trip(case_reading *f, const char *text, const char *const *settings)
{
    case_reading_read(f, text, settings, &f->first);
    char *written = case_reading_write(f, &f->first);
    case_reading_read(f, written, NULL, &f->second);
    free(written);
    mor_case *first = case_reading_strip(&f->first);
    mor_case *second = case_reading_strip(&f->second);
    const int difference = memcmp(first, second, sizeof *first);
    free(first);
    free(second);
    assert_int_equal(difference, 0);
    for (int k = 0; k < f->first.n_soils; ++k) {
        case_reading_outlines(&f->first.soils[k].outline, &f->second.soils[k].outline);
    }
    for (int k = 0; k < f->first.n_walls; ++k) {
        case_reading_outlines(&f->first.walls[k].outline, &f->second.walls[k].outline);
    }
    for (int k = 0; k < f->first.n_probes; ++k) {
        const mor_case_probe *probe = &f->first.probes[k];
        case_reading_outlines(&probe->region_outline, &f->second.probes[k].region_outline);
        for (int i = 0; i < 3 * probe->n_path; ++i) {
            assert_true(probe->path[i] == f->second.probes[k].path[i]); /* exact: the same bits */
        }
    }
    for (int k = 0; k < f->first.n_bodies; ++k) {
        const mor_case_body *body = &f->first.bodies[k];
        mor_case_body bodies[2] = {*body, f->second.bodies[k]};
        case_reading_strip_body(&bodies[0]);
        case_reading_strip_body(&bodies[1]);
        assert_memory_equal(&bodies[0], &bodies[1], sizeof bodies[0]); /* exact: the same bits */
        case_reading_outlines(&body->outline, &f->second.bodies[k].outline);
        case_reading_outlines(&body->clamp_outline, &f->second.bodies[k].clamp_outline);
        assert_int_equal(body->clamp == NULL, f->second.bodies[k].clamp == NULL);
    }
}

#endif
