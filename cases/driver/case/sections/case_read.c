/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_read.h"

#include "cases/driver/case/sections/case_sections.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SCALE_POWER_MAX = 64 };

/* ---- Groups of the top level ------------------------------------------------------------------------------------- */

static mor_status read_settings_group(const mor_case_reader *reader, const mor_case_node *root,
                                      const mor_case_group *group, mor_case *the_case)
{
    const mor_case_node *node = mor_case_node_find(root, group->name);
    const bool is_needed = strcmp(group->name, "domain") == 0;
    if (node != NULL || is_needed) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, root, group->name, MOR_CASE_NODE_GROUP, &node));
    }
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, group, NULL, NULL));
    return mor_case_reader_group(reader, node, group, the_case);
}

static const mor_case_group *find_settings(const char *name)
{
    const mor_case_group *group = mor_case_settings_groups;
    while (strcmp(group->name, name) != 0) {
        ++group;
    }
    return group;
}

/* The square root of an even power of two is exact, too, so that a scaled case follows the same path bit for bit. */
static mor_status read_power(const mor_case_reader *reader, const mor_case_node *root, const char *key, double value,
                             int *power)
{
    int exponent = 0;
    const double fraction = frexp(value, &exponent);
    *power = exponent - 1;
    if (fraction == 0.5 && *power % 2 == 0 && *power >= -SCALE_POWER_MAX && *power <= SCALE_POWER_MAX) {
        return MOR_OK;
    }
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "scale"), key);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found scale.%s = %.17g; allowed: even powers of two such as 0.25, 1, "
                              "4, 16, from 2^-%d to 2^%d; choose one of them",
                              key, value, SCALE_POWER_MAX, SCALE_POWER_MAX);
}

static mor_status read_scale(mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    int length = 0;
    int time = 0;
    int mass = 0;
    MOR_TRY(reader->context, read_settings_group(reader, root, find_settings("scale"), the_case));
    MOR_TRY(reader->context, read_power(reader, root, "length", the_case->scale_length, &length));
    MOR_TRY(reader->context, read_power(reader, root, "time", the_case->scale_time, &time));
    MOR_TRY(reader->context, read_power(reader, root, "mass", the_case->scale_mass, &mass));
    reader->length_power = length;
    reader->time_power = time;
    reader->mass_power = mass;
    return MOR_OK;
}

/* The number of components of vectors depends on it; a wrong one is reported when the key itself is read. */
static int peek_dimension(const mor_case_node *root)
{
    const mor_case_node *node = mor_case_node_find(root, "dimension");
    return node != NULL && node->kind == MOR_CASE_NODE_INTEGER && node->integer == 2 ? 2 : 3;
}

/* Settings have the values of the scheme where they are not given; a wrong word is reported when the key is read. */
static int peek_scheme(const mor_case_node *root)
{
    const mor_case_key *key = find_settings("numerics")->keys;
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "numerics"), key->schema.key);
    const int word =
        node != NULL && node->kind == MOR_CASE_NODE_TEXT ? mor_params_choice(key->schema.choices, node->text) : -1;
    return word < 0 ? (int)key->schema.default_value : word;
}

static mor_status check_domain(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    static const char axes[] = "xyz";
    const mor_case_node *node = mor_case_node_find(root, "domain");
    const mor_case_node *corners[2] = {mor_case_node_find(node, "min"), mor_case_node_find(node, "max")};
    for (int k = 0; k < 2; ++k) {
        if (corners[k]->n_children == 2) {
            /* Plane strain: the plane with a spacing on both sides. */
            (k == 0 ? the_case->domain_minimum : the_case->domain_maximum)[2] =
                (k == 0 ? -1.0 : 1.0) * the_case->spacing;
        }
    }
    for (int a = 0; a < 3; ++a) {
        if (!(the_case->domain_minimum[a] < the_case->domain_maximum[a])) {
            return MOR_CASE_NODE_FAIL(reader->context, corners[1],
                                      "found domain.max that is not above domain.min along %c "
                                      "(%g and %g m, scale included); allowed: max > min; exchange or correct them",
                                      axes[a], the_case->domain_maximum[a], the_case->domain_minimum[a]);
        }
    }
    if (reader->dimension == 2 && !(the_case->domain_minimum[2] < 0.0 && the_case->domain_maximum[2] > 0.0)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a domain without the plane z = 0; allowed in plane strain: "
                                  "z from below to above 0; correct z or leave it out");
    }
    return MOR_OK;
}

static mor_status check_plane(const mor_case_reader *reader, const mor_case_node *root, const mor_case *the_case)
{
    if (reader->dimension == 3) {
        return MOR_OK;
    }
    if (the_case->gravity[2] != 0.0) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(root, "gravity"),
                                  "found gravity along z in plane "
                                  "strain; allowed: x and y; give gravity as (\"0\", \"-9.81 m/s2\")");
    }
    const double *axis = the_case->placement_axis;
    if (axis[0] != 0.0 || axis[1] != 0.0 || the_case->translation[2] != 0.0) {
        return MOR_CASE_NODE_FAIL(
            reader->context, mor_case_node_find(root, "placement"),
            "found a placement that leaves "
            "the plane; allowed in plane strain: axis (0, 0, 1) and a translation in x and y; correct it");
    }
    return MOR_OK;
}

static void make_rotation(mor_case *the_case)
{
    const double *given = the_case->placement_axis;
    const double largest = fmax(fabs(given[0]), fmax(fabs(given[1]), fabs(given[2])));
    double axis[3] = {given[0] / largest, given[1] / largest, given[2] / largest};
    const double length = mor_vector_length(axis);
    for (int a = 0; a < 3; ++a) {
        axis[a] /= length;
    }
    mor_matrix_rotation(axis, the_case->placement_angle, the_case->rotation);
}

static void complete_settings(mor_case *the_case)
{
    const mor_case_group *placement = find_settings("placement");
    const mor_case_group *numerics = find_settings("numerics");
    const mor_case_group *output = find_settings("output");
    if (!mor_case_reader_has(placement, the_case->written_placement, "axis")) {
        memcpy(the_case->placement_axis, (double[]){0.0, 0.0, 1.0}, sizeof the_case->placement_axis);
    }
    if (!mor_case_reader_has(numerics, the_case->written_numerics, "dissipation_factor")) {
        the_case->numerics.dissipation_factor = 20.0 * the_case->dimension;
    }
    if (!mor_case_reader_has(numerics, the_case->written_numerics, "barrier_radius")) {
        the_case->numerics.barrier_radius = the_case->spacing;
    }
    if (!mor_case_reader_has(output, the_case->written_output, "series_interval")) {
        the_case->output.series_interval = the_case->end / 200.0;
    }
    if (!mor_case_reader_has(output, the_case->written_output, "color")) {
        snprintf(the_case->output.color_field, sizeof the_case->output.color_field, "speed");
    }
    make_rotation(the_case);
}

static mor_status read_root(mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    reader->dimension = peek_dimension(root);
    reader->scheme = peek_scheme(root);
    snprintf(the_case->path, sizeof the_case->path, "%s", root->origin);
    const mor_case_node *vary = mor_case_node_find(root, "vary");
    if (vary != NULL && mor_case_node_find(root, "case") != NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, vary,
                                  "found 'vary', which a sweep file has; allowed: a case; run it as a sweep");
    }
    MOR_TRY(reader->context, mor_case_reader_names(reader, root, &mor_case_root_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_plugins(reader, root, the_case));
    MOR_TRY(reader->context, read_scale(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_group(reader, root, &mor_case_root_group, the_case));
    reader->spacing = the_case->spacing;
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        if (strcmp(group->name, "scale") != 0) {
            MOR_TRY(reader->context, read_settings_group(reader, root, group, the_case));
        }
    }
    complete_settings(the_case);
    MOR_TRY(reader->context, check_domain(reader, root, the_case));
    memcpy(reader->domain.minimum, the_case->domain_minimum, sizeof reader->domain.minimum);
    memcpy(reader->domain.maximum, the_case->domain_maximum, sizeof reader->domain.maximum);
    MOR_TRY(reader->context, check_plane(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_scene(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_stage(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_check(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_results(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_maps(reader, root, the_case));
    return mor_case_reader_periodic(reader, root, the_case);
}

static mor_status read_file(mor_context *context, mor_case_file *file, const mor_case_text *text, mor_case *out_case)
{
    for (int k = 0; k < text->n_settings; ++k) {
        MOR_TRY(context, mor_case_file_set(context, file, text->settings[k]));
    }
    mor_units *loaded = NULL;
    if (text->units == NULL) {
        MOR_TRY(context, mor_units_new(context, &loaded));
    }
    mor_case_mistakes mistakes = {.n = 0};
    mor_case_reader reader = {.context = context,
                              .mistakes = &mistakes,
                              .units = text->units == NULL ? loaded : text->units,
                              .registry = text->registry,
                              .probe_types = text->probe_types};
    out_case->probe_types = text->probe_types;
    const mor_status status = mor_case_reader_finish(&reader, read_root(&reader, mor_case_file_root(file), out_case));
    mor_units_free(context, &loaded);
    if (status != MOR_OK) {
        mor_case_clear(context, out_case);
    }
    return status;
}

mor_status mor_case_read_text(mor_context *context, const mor_case_text *text, mor_case *out_case)
{
    mor_case_file *file = NULL;
    memset(out_case, 0, sizeof *out_case);
    MOR_TRY(context, mor_case_file_parse(context, text->name, text->text, text->n_bytes, &file));
    const mor_status status = read_file(context, file, text, out_case);
    mor_case_file_free(context, &file);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_case_read(mor_context *context, const char *path, const char *const *settings, int n_settings,
                         const mor_registry *registry, mor_case_probe_catalog probe_types, mor_case *out_case)
{
    mor_case_file *file = NULL;
    memset(out_case, 0, sizeof *out_case);
    MOR_TRY(context, mor_case_file_load(context, path, &file));
    const mor_case_text text = {
        .settings = settings, .n_settings = n_settings, .registry = registry, .probe_types = probe_types};
    const mor_status status = read_file(context, file, &text, out_case);
    mor_case_file_free(context, &file);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
