/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Probes and expectations. */

enum { WORDS_MAX = 2 * MOR_CASE_PROBES_MAX }; /* types of probes, or names of them */

/* ---- Probes ------------------------------------------------------------------------------------------------------ */

static mor_status read_type(const mor_case_reader *reader, const mor_case_node *node, const mor_case_probe_type **type)
{
    const mor_case_node *name = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "type", MOR_CASE_NODE_TEXT, &name));
    *type = mor_case_probe_type_find(reader->probe_types, name->text);
    if (*type != NULL) {
        return MOR_OK;
    }
    const char *words[WORDS_MAX];
    int n_words = 0;
    const mor_case_probe_type *known = NULL;
    while (reader->probe_types != NULL && n_words < WORDS_MAX && (known = reader->probe_types(n_words)) != NULL) {
        words[n_words++] = known->name;
    }
    return mor_case_reader_refuse(reader, name, "type of probe", words, n_words);
}

static mor_status check_special_keys(const mor_case_reader *reader, const mor_case_node *node,
                                     const mor_case_probe_type *type)
{
    const unsigned required = mor_case_probe_required(type, reader->dimension);
    const bool has_path = (type->allowed & MOR_CASE_PROBE_PATH) != 0 && mor_case_node_find(node, "path") != NULL;
    const bool has_region = mor_case_node_find(node, "region") != NULL;
    for (int k = 0; mor_case_probe_key_names[k] != NULL; ++k) {
        const char *key = mor_case_probe_key_names[k];
        const mor_case_node *child = mor_case_node_find(node, key);
        if (child != NULL && (type->allowed >> k & 1U) == 0) {
            char allowed[MOR_CASE_NODE_TEXT_BYTES];
            mor_case_probe_list_keys(type, allowed, sizeof allowed);
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect on a probe of type '%s'; "
                                      "allowed: %s; remove it",
                                      key, type->name, allowed);
        }
        const char *other = mor_case_probe_replacement(type, key, has_path, has_region);
        if (child != NULL && other != NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect beside '%s'; allowed: one of both; remove it",
                                      key, other);
        }
        if (child == NULL && (required >> k & 1U) != 0) {
            char allowed[MOR_CASE_NODE_TEXT_BYTES];
            snprintf(allowed, sizeof allowed, "a value, which a probe of type '%s' must have", type->name);
            return mor_case_reader_refuse_missing(reader, node, key, allowed);
        }
    }
    return MOR_OK;
}

/* Of two keys that exclude each other, the one that lost is refused. */
static mor_status refuse_idle(const mor_case_reader *reader, const mor_case_node *node, const char *key,
                              const char *needed)
{
    const mor_case_node *child = mor_case_node_find(node, key);
    if (child == NULL) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(reader->context, child,
                              "found '%s', which has no effect here; allowed: with %s; remove it", key, needed);
}

/* A share and a percentage are a factor of a hundred apart; a number with its unit is accepted as written. */
static void warn_of_share(const mor_case_reader *reader, const mor_case_node *node, const char *words)
{
    mor_context_log(reader->context, MOR_LOG_WARNING, "%s:%d: found %s = %g, %s", node->origin, node->line, node->name,
                    node->real, words);
}

static bool is_bare(const mor_case_node *node)
{
    return node != NULL && (node->kind == MOR_CASE_NODE_REAL || node->kind == MOR_CASE_NODE_INTEGER);
}

static void warn_of_percentile(const mor_case_reader *reader, const mor_case_node *node)
{
    const mor_case_node *given = mor_case_node_find(node, "percentile");
    if (is_bare(given) && given->real > 0.0 && given->real <= 1.0) {
        char words[160];
        snprintf(words, sizeof words,
                 "which is %g %%: percentiles are in percent; if %g %% is intended, write %g, else \"%g %%\"",
                 given->real, 100.0 * given->real, 100.0 * given->real, given->real);
        warn_of_share(reader, given, words);
    }
}

/* Relative tolerances only. */
static void warn_of_tolerance(const mor_case_reader *reader, const mor_case_node *node)
{
    static const char *const keys[] = {"tolerance", "tolerance_low"};
    for (int k = 0; k < 2; ++k) {
        const mor_case_node *given = mor_case_node_find(node, keys[k]);
        if (is_bare(given) && given->real >= 1.0) {
            char words[192];
            snprintf(
                words, sizeof words,
                "a share of the value, so that results off by %g %% pass: if %g %% is intended, write %g; a difference "
                "in the unit of the probe needs absolute = true",
                100.0 * given->real, given->real, 0.01 * given->real);
            warn_of_share(reader, given, words);
        }
    }
}

/* Corners of a polyline: neighbors must be apart, else they have no direction. */
static mor_status read_path(const mor_case_reader *reader, const mor_case_node *node, mor_case_probe *probe)
{
    static const mor_schema corner = {.key = "path",
                                      .kind = MOR_SCHEMA_VECTOR,
                                      .n_components = 3,
                                      .unit = "m",
                                      .minimum = -INFINITY,
                                      .maximum = INFINITY};
    const mor_case_node *list = mor_case_node_find(node, "path");
    if (list == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "path", MOR_CASE_NODE_LIST, &list));
    if (list->n_children < 2 || list->n_children > MOR_CASE_PATH_POINTS_MAX) {
        return MOR_CASE_NODE_FAIL(reader->context, list, "found a path of %d points; allowed: 2 to %d; correct it",
                                  list->n_children, MOR_CASE_PATH_POINTS_MAX);
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, &probe->path, 3 * (int64_t)list->n_children, "a path"));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        double *point = probe->path + 3 * (int64_t)probe->n_path;
        MOR_TRY(reader->context, mor_case_reader_numbers(reader, child, &corner, false, point));
        if (probe->n_path > 0 && memcmp(point - 3, point, 3 * sizeof *point) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found the same point of a path twice in a row; allowed: points apart; remove "
                                      "one of them");
        }
        probe->n_path += 1;
    }
    return MOR_OK;
}

static mor_status complete_probe(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                 const mor_case_probe_type *type, mor_case_probe *probe)
{
    const double spacing = the_case->spacing;
    const mor_case_group *group = &mor_case_probe_group;
    const bool has_direction = mor_case_reader_has(group, probe->written, "direction");
    if (!mor_case_reader_has(group, probe->written, "name")) {
        memcpy(probe->name, probe->type, sizeof probe->name);
    }
    if (!mor_case_reader_has(group, probe->written, "percentile")) {
        probe->percentile = type->percentile;
    }
    warn_of_percentile(reader, node);
    if (!mor_case_reader_has(group, probe->written, "thickness")) {
        probe->thickness = 0.5 * spacing;
    }
    if (!mor_case_reader_has(group, probe->written, "speed")) {
        probe->speed = 0.1 * sqrt(mor_vector_length(the_case->gravity) * spacing);
    }
    if (!has_direction) {
        const bool is_plane_rotation = reader->dimension == 2 && (type->traits & MOR_CASE_PROBE_OF_ROTATION) != 0;
        memset(probe->direction, 0, sizeof probe->direction);
        probe->direction[is_plane_rotation ? 2 : 0] = 1.0;
    } else if ((type->traits & MOR_CASE_PROBE_OF_ROTATION) != 0) {
        MOR_TRY(reader->context, mor_case_reader_out_of_plane(reader, node, "direction", probe->direction));
    } else {
        MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "direction", probe->direction));
    }
    mor_case_reader_unit_vector(probe->direction);
    if (!mor_case_reader_has(group, probe->written, "radial")) {
        const bool can_be_radial = (type->allowed & MOR_CASE_PROBE_RADIAL) != 0;
        probe->is_radial = can_be_radial && reader->dimension == 3 && !has_direction;
    }
    if (probe->is_radial) {
        MOR_TRY(reader->context, refuse_idle(reader, node, "direction", "radial = false"));
    }
    if ((type->allowed & MOR_CASE_PROBE_MEASURE) == 0) {
        return MOR_OK;
    }
    return strcmp(probe->measure, "thickness") == 0
               ? refuse_idle(reader, node, "percentile", "measure = \"mass_percentile\"")
               : refuse_idle(reader, node, "thickness", "measure = \"thickness\"");
}

static mor_status check_window(const mor_case_reader *reader, const mor_case_node *node, double end,
                               const mor_case_probe *probe)
{
    const mor_case_node *child = mor_case_node_find(node, "window");
    const double *window = probe->window;
    if (child == NULL || (window[0] < window[1] && window[1] <= end)) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(reader->context, child,
                              "found the window from %.9g s to %.9g s of probe '%s'; allowed: two times of the run, "
                              "which lasts from 0 to %.9g s, the first before the second; correct the window or 'end'",
                              window[0], window[1], probe->name, end);
}

/* A probe of what the case does not have would measure nothing for the whole of the run. */
static mor_status check_scene(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                              const mor_case_probe_type *type)
{
    const bool lacks_soil = (type->traits & MOR_CASE_PROBE_OF_SOIL) != 0 && the_case->n_soils == 0;
    const bool lacks_bodies = (type->traits & MOR_CASE_PROBE_OF_BODIES) != 0 && the_case->n_bodies == 0;
    if (!lacks_soil && !lacks_bodies) {
        return MOR_OK;
    }
    const mor_case_node *name = mor_case_node_find(node, "name");
    const char *missing = lacks_soil ? "soil" : "bodies";
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found the probe '%s' of type '%s' in a case without %s; allowed: with %s; remove the "
                              "probe or add %s",
                              name != NULL && name->kind == MOR_CASE_NODE_TEXT ? name->text : type->name, type->name,
                              missing, missing, missing);
}

/* The name becomes a column of the series, which has some of its own; the one of the ratio of rates is the same. */
static mor_status check_column(const mor_case_reader *reader, const mor_case_node *node, const mor_case_probe *probe)
{
    for (const mor_case_own_column *own = mor_case_own_columns; own->name != NULL; ++own) {
        if (strcmp(own->name, probe->name) == 0 && strcmp(own->name, probe->type) != 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the probe name '%s'; allowed: any but time, step, step_length and "
                                      "rate_ratio, which are columns of series.csv already; give it another name",
                                      probe->name);
        }
    }
    return MOR_OK;
}

static mor_status read_probe(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                             mor_case_probe *probe)
{
    const mor_case_probe_type *type = NULL;
    mor_case_reader_place(node, &probe->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_probe_group, NULL, NULL));
    MOR_TRY(reader->context, read_type(reader, node, &type));
    MOR_TRY(reader->context, check_scene(reader, node, the_case, type));
    MOR_TRY(reader->context, check_special_keys(reader, node, type));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_probe_group, probe));
    probe->kind = type;
    MOR_TRY(reader->context, complete_probe(reader, node, the_case, type, probe));
    MOR_TRY(reader->context, check_window(reader, node, the_case->end, probe));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "wall", probe->wall));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "soil", probe->soil));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "gauge", probe->gauge));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "body", probe->body));
    MOR_TRY(reader->context, mor_case_reader_region(reader, node, &probe->region_outline, &probe->region));
    MOR_TRY(reader->context, read_path(reader, node, probe));
    MOR_TRY(reader->context, check_column(reader, node, probe));
    for (const mor_case_probe *other = the_case->probes; other < probe; ++other) {
        if (strcmp(other->name, probe->name) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the probe name '%s' again; allowed: each name once (it "
                                      "is taken by line %d); give it a name of its own",
                                      probe->name, other->place.line);
        }
    }
    return MOR_OK;
}

/* ---- Expectations ------------------------------------------------------------------------------------------------ */

static const mor_case_probe *find_probe(const mor_case *the_case, const char *name)
{
    for (int k = 0; k < the_case->n_probes; ++k) {
        if (strcmp(the_case->probes[k].name, name) == 0) {
            return &the_case->probes[k];
        }
    }
    return NULL;
}

static mor_status read_reference(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                 const mor_case_probe **probe)
{
    const mor_case_node *name = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "probe", MOR_CASE_NODE_TEXT, &name));
    *probe = find_probe(the_case, name->text);
    if (*probe != NULL) {
        return MOR_OK;
    }
    const char *words[WORDS_MAX];
    for (int k = 0; k < the_case->n_probes; ++k) {
        words[k] = the_case->probes[k].name;
    }
    return mor_case_reader_refuse(reader, name, "name of a probe of this case", words, the_case->n_probes);
}

enum { EXPECTATION_KEYS_MAX = 12 };

/* The table of an expectation with the unit of its probe put in. */
static void adapt_keys(const char *unit, bool is_absolute, mor_case_key *keys)
{
    const mor_case_key *source = mor_case_expectation_group.keys;
    int k = 0;
    for (; source[k].schema.key != NULL && k < EXPECTATION_KEYS_MAX - 1; ++k) {
        memcpy(&keys[k], &source[k], sizeof keys[k]);
        const bool is_tolerance = strncmp(source[k].schema.key, "tolerance", strlen("tolerance")) == 0;
        if (strcmp(source[k].schema.key, "value") == 0 || (is_tolerance && is_absolute)) {
            keys[k].schema.unit = unit;
        }
    }
    keys[k].schema.key = NULL;
}

static mor_status check_expectation(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                    const mor_case_expectation *expectation)
{
    if (expectation->value == 0.0 && !expectation->is_absolute) {
        return MOR_CASE_NODE_FAIL(
            reader->context, mor_case_node_find(node, "value"),
            "found value = 0 with a tolerance "
            "that is a share of it; allowed: a tolerance in the unit of the probe; add absolute = "
            "true");
    }
    if (!expectation->is_absolute) {
        warn_of_tolerance(reader, node);
    }
    for (const mor_case_expectation *other = the_case->expectations; other < expectation; ++other) {
        if (strcmp(other->probe, expectation->probe) == 0 && other->statistic == expectation->statistic &&
            strcmp(other->source, expectation->source) == 0) {
            return MOR_CASE_NODE_FAIL(
                reader->context, node,
                "found a second expectation of '%s' from the same source; "
                "allowed: one for each source and statistic (line %d has it); remove one or name its "
                "source",
                expectation->probe, other->place.line);
        }
    }
    return MOR_OK;
}

/* The unit that value and tolerance of an expectation have. The statistic is looked at before the others are read,
 * whose unit it decides; a word that is none is refused when it is read itself. */
static mor_status find_unit(const mor_case_reader *reader, const mor_case_node *node, const mor_case_probe *probe,
                            const char **unit)
{
    const mor_case_probe_type *type = probe->kind;
    const mor_case_node *word = mor_case_node_find(node, "statistic");
    const bool is_word = word != NULL && word->kind == MOR_CASE_NODE_TEXT;
    const int index = is_word ? mor_params_choice(mor_case_statistic_words, word->text) : -1;
    const mor_case_statistic statistic = index >= 0 ? (mor_case_statistic)index : MOR_CASE_STATISTIC_VALUE;
    *unit = mor_case_statistic_unit(type, statistic, reader->dimension);
    if (*unit != NULL) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(
        reader->context, word,
        "found the impulse of probe '%s' of type '%s', which is no force; allowed: value, maximum, "
        "minimum, mean; name one of these or a probe of a force",
        probe->name, probe->type);
}

static mor_status read_expectation(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                   mor_case_expectation *expectation)
{
    const mor_case_probe *probe = NULL;
    mor_case_key keys[EXPECTATION_KEYS_MAX];
    mor_case_group adapted = mor_case_expectation_group;
    mor_case_reader_place(node, &expectation->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_expectation_group, NULL, NULL));
    MOR_TRY(reader->context, read_reference(reader, node, the_case, &probe));
    const mor_case_node *absolute = mor_case_node_find(node, "absolute");
    const char *unit = NULL;
    MOR_TRY(reader->context, find_unit(reader, node, probe, &unit));
    adapt_keys(unit, absolute != NULL && absolute->truth, keys);
    adapted.keys = keys;
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &adapted, expectation));
    if (!mor_case_reader_has(&adapted, expectation->written, "tolerance_low")) {
        expectation->tolerance_low = expectation->tolerance;
    }
    return check_expectation(reader, node, the_case, expectation);
}

mor_status mor_case_reader_results(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_gauges(reader, root, the_case));
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "probes", MOR_CASE_PROBES_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        /* Counted before it is read, so that a half-read one is freed, too. */
        mor_case_probe *probe = &the_case->probes[the_case->n_probes++];
        MOR_TRY(reader->context, read_probe(reader, node, the_case, probe));
    }
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "expect", MOR_CASE_EXPECTATIONS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        mor_case_expectation *expectation = &the_case->expectations[the_case->n_expectations];
        MOR_TRY(reader->context, read_expectation(reader, node, the_case, expectation));
        the_case->n_expectations += 1;
    }
    return MOR_OK;
}
