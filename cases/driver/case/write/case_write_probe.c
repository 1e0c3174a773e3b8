/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes, expectations and maps of a case, as they were used. */
#include "cases/driver/case/write/case_writer.h"

#include <math.h>
#include <string.h>

static mor_case_presence presence_of_probe_key(const mor_case_key *key, const void *record)
{
    const mor_case_probe *probe = record;
    const mor_case_probe_type *type = probe->kind;
    const char *name = key->schema.key;
    for (int k = 0; mor_case_probe_key_names[k] != NULL; ++k) {
        if (strcmp(mor_case_probe_key_names[k], name) == 0 && (type->allowed >> k & 1U) == 0) {
            return MOR_CASE_OMIT;
        }
    }
    const bool has_measure = (type->allowed & MOR_CASE_PROBE_MEASURE) != 0;
    const bool is_by_thickness = strcmp(probe->measure, "thickness") == 0;
    const bool is_replaced = mor_case_probe_replacement(type, name, probe->n_path > 0, probe->region != NULL) != NULL;
    const bool is_idle = is_replaced || (strcmp(name, "gauge") == 0 && probe->gauge[0] == '\0') ||
                         (strcmp(name, "soil") == 0 && probe->soil[0] == '\0') ||
                         (strcmp(name, "window") == 0 && isnan(probe->window[0])) ||
                         (strcmp(name, "direction") == 0 && probe->is_radial) ||
                         (strcmp(name, "percentile") == 0 && has_measure && is_by_thickness) ||
                         (strcmp(name, "thickness") == 0 && has_measure && !is_by_thickness);
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

static mor_status write_path(mor_case_writer *w, const mor_case_probe *probe)
{
    static const mor_schema point = {.kind = MOR_SCHEMA_VECTOR, .unit = "m"};
    mor_case_writer_open(w, "path", "(");
    for (int k = 0; k < probe->n_path; ++k) {
        char value[MOR_CASE_VALUE_BYTES];
        MOR_TRY(w->reader.context,
                mor_case_writer_numbers(w, &point, false, &probe->path[3 * k], 3, value, sizeof value));
        fprintf(w->stream, "%*s%s%s\n", w->depth * MOR_CASE_INDENT, "", value, k + 1 < probe->n_path ? "," : "");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

mor_status mor_case_writer_probe(mor_case_writer *w, const mor_case_probe *probe)
{
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_probe_group, probe, presence_of_probe_key));
    if (probe->region != NULL) {
        MOR_TRY(w->reader.context, mor_case_writer_shape(w, "region", &probe->region_outline, "};"));
    }
    return probe->n_path > 0 ? write_path(w, probe) : MOR_OK;
}

static mor_case_presence presence_of_gauge_key(const mor_case_key *key, const void *record)
{
    const mor_case_gauge *gauge = record;
    const char *name = key->schema.key;
    const bool is_idle = (strcmp(name, "wall") == 0 && gauge->wall[0] == '\0') ||
                         (strcmp(name, "body") == 0 && gauge->body[0] == '\0') ||
                         (strcmp(name, "filter") == 0 && isnan(gauge->filter)) ||
                         (strcmp(name, "cutoff") == 0 && isnan(gauge->cutoff)) ||
                         (strcmp(name, "cell") == 0 && isnan(gauge->cell));
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

mor_status mor_case_writer_gauge(mor_case_writer *w, const mor_case_gauge *gauge)
{
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_gauge_group, gauge, presence_of_gauge_key));
    return gauge->region != NULL ? mor_case_writer_shape(w, "region", &gauge->region_outline, "};") : MOR_OK;
}

static const char *find_unit(const mor_case *the_case, const char *probe, mor_case_statistic statistic)
{
    for (int k = 0; k < the_case->n_probes; ++k) {
        if (strcmp(the_case->probes[k].name, probe) == 0) {
            return mor_case_statistic_unit(the_case->probes[k].kind, statistic, the_case->dimension);
        }
    }
    return "1";
}

mor_status mor_case_writer_expectation(const mor_case_writer *w, const mor_case *the_case,
                                       const mor_case_expectation *expectation)
{
    const mor_case_group *group = &mor_case_expectation_group;
    const char *unit = find_unit(the_case, expectation->probe, expectation->statistic);
    for (int k = 0; group->keys[k].schema.key != NULL; ++k) {
        mor_case_key key = group->keys[k];
        const bool is_tolerance = strncmp(key.schema.key, "tolerance", strlen("tolerance")) == 0;
        if (strcmp(key.schema.key, "value") == 0 || (is_tolerance && expectation->is_absolute)) {
            key.schema.unit = unit;
        }
        char value[MOR_CASE_VALUE_BYTES];
        MOR_TRY(w->reader.context,
                mor_case_writer_member(w, &key, (const char *)expectation + key.offset, value, sizeof value));
        mor_case_writer_line(w, key.schema.key, value, (expectation->written >> k & 1) == 0);
    }
    return MOR_OK;
}

static mor_case_presence presence_of_maps_key(const mor_case_key *key, const void *record)
{
    const mor_case_maps *maps = record;
    const bool is_open = (strcmp(key->schema.key, "ground") == 0 && maps->ground[0] == '\0') ||
                         (strcmp(key->schema.key, "cell") == 0 && isnan(maps->cell));
    return is_open ? MOR_CASE_MENTION : MOR_CASE_WRITE;
}

mor_status mor_case_writer_maps(mor_case_writer *w, const mor_case_maps *maps)
{
    if (!maps->is_wanted) {
        return MOR_OK;
    }
    mor_case_writer_open(w, mor_case_maps_group.name, "{");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_maps_group, maps, presence_of_maps_key));
    mor_case_writer_close(w, "};");
    return MOR_OK;
}
