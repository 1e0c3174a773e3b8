/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_files.h"

#include "core/io/durable_file.h"

#include <inttypes.h>
#include <math.h>

/* Trials in the order of their factors; order: shape [n_trials]. */
static void sort_trials(const mor_safety *it, int *order)
{
    for (int k = 0; k < it->n_trials; ++k) {
        int place = k;
        for (; place > 0 && it->trials[order[place - 1]].factor > it->trials[k].factor; --place) {
            order[place] = order[place - 1];
        }
        order[place] = k;
    }
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

void mor_safety_print_cells(const double *values, int n, FILE *out)
{
    for (int k = 0; k < n; ++k) {
        if (isfinite(values[k])) {
            fprintf(out, "%.17g", values[k]);
        }
        fputc(',', out);
    }
}

static void print_trials(const mor_safety *it, FILE *out)
{
    const mor_safety_reference *r = &it->setup.reference;
    int order[MOR_SAFETY_TRIALS_MAX];
    sort_trials(it, order);
    fprintf(out, "factor [1],verdict,by_speed,by_displacement,speed [m/s],speed_ratio [1],displacement [m],"
                 "displacement_over_height [1],growth [m],unbalanced_force [1],time [s],steps [1],reason\n");
    for (int k = 0; k < it->n_trials; ++k) {
        const mor_safety_trial *trial = &it->trials[order[k]];
        const mor_safety_sample last = mor_safety_trial_last(trial);
        const mor_safety_finding *found = &trial->finding;
        const double numbers[] = {found->speed * mor_safety_reference_speed(r),
                                  found->speed_ratio,
                                  last.displacement * r->height,
                                  last.displacement,
                                  found->growth * r->height,
                                  last.force,
                                  trial->seconds};
        fprintf(out, "%.17g,%s,%s,%s,", trial->factor, mor_safety_verdict_word(found->verdict),
                mor_safety_sign_word(found->by_speed), mor_safety_sign_word(found->by_displacement));
        mor_safety_print_cells(numbers, sizeof numbers / sizeof *numbers, out);
        fprintf(out, "%" PRIu64 ",\"%s\"\n", trial->n_steps, found->reason);
    }
}

static void print_history(const mor_safety *it, FILE *out)
{
    const mor_safety_reference *r = &it->setup.reference;
    int order[MOR_SAFETY_TRIALS_MAX];
    sort_trials(it, order);
    fprintf(out, "factor [1],time [s],speed [m/s],displacement [m],unbalanced_force [1]\n");
    for (int k = 0; k < it->n_trials; ++k) {
        const mor_safety_trial *trial = &it->trials[order[k]];
        for (int s = 0; s < trial->n_samples; ++s) {
            const mor_safety_sample *sample = &trial->samples[s];
            const double numbers[] = {trial->factor, sample->time * mor_safety_reference_time(r),
                                      sample->speed * mor_safety_reference_speed(r), sample->displacement * r->height};
            mor_safety_print_cells(numbers, sizeof numbers / sizeof *numbers, out);
            fprintf(out, isfinite(sample->force) ? "%.17g\n" : "\n", sample->force);
        }
    }
}

static mor_status write_file(mor_context *context, const mor_safety *it, const char *folder, const char *name,
                             void (*print)(const mor_safety *it, FILE *out))
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    print(it, file.stream);
    return mor_durable_file_commit(context, &file);
}

mor_status mor_safety_write_tables(mor_context *context, const mor_safety *it, const char *folder)
{
    MOR_TRY(context, write_file(context, it, folder, "trials.csv", print_trials));
    return write_file(context, it, folder, "history.csv", print_history);
}

/* ---- Summary ----------------------------------------------------------------------------------------------------- */

/* A number, or null where there is none. */
static void put_number(FILE *out, const char *name, double value, const char *end)
{
    fprintf(out, "\"%s\": ", name);
    if (isfinite(value)) {
        fprintf(out, "%.17g%s", value, end);
    } else {
        fprintf(out, "null%s", end);
    }
}

static void put_string(FILE *out, const char *text, const char *end)
{
    putc('"', out);
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; ++c) {
        if (*c < 0x20) {
            fprintf(out, "\\u%04x", *c);
        } else {
            fprintf(out, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
        }
    }
    fprintf(out, "\"%s", end);
}

static void put_text(FILE *out, const char *name, const char *text, const char *end)
{
    fprintf(out, "\"%s\": ", name);
    put_string(out, text, end);
}

static void put_rules(const mor_safety *it, FILE *out)
{
    const mor_safety_rules *rules = &it->setup.rules;
    const mor_safety_reference *r = &it->setup.reference;
    fprintf(out, "  \"criteria\": {");
    put_number(out, "height [m]", r->height, ", ");
    put_number(out, "unit_of_time [s]", mor_safety_reference_time(r), ", ");
    put_number(out, "unit_of_speed [m/s]", mor_safety_reference_speed(r), ", ");
    put_number(out, "elastic_settlement [m]", r->settlement, ", ");
    put_number(out, "damped [1]", rules->damped, ", ");
    put_number(out, "window [1]", rules->window, ", ");
    put_number(out, "longest [1]", rules->longest, ", ");
    put_number(out, "rest_speed [1]", rules->rest, ", ");
    put_number(out, "motion_speed [1]", rules->motion, ", ");
    put_number(out, "far_displacement [1]", rules->far, "},\n");
}

static void put_soils(const mor_safety *it, FILE *out)
{
    const mor_case *c = it->setup.reduced->original;
    fprintf(out, "  \"soils\": [");
    for (int k = 0; k < c->n_soils; ++k) {
        fprintf(out, "%s{", k > 0 ? ", " : "");
        put_text(out, "name", c->soils[k].name, ", ");
        put_text(out, "model", c->soils[k].model, ", ");
        put_number(out, "strength_over_mohr_coulomb [1]", it->setup.reduced->strengths[k].ratio, "}");
    }
    fprintf(out, "],\n");
}

static void put_body(const mor_safety *it, FILE *out)
{
    const mor_safety_body *body = &it->body;
    const bool is_plane = it->setup.reduced->original->dimension == 2;
    if (it->mechanism == NULL) {
        fprintf(out, "  \"critical_body\": null,\n");
        return;
    }
    fprintf(out, "  \"critical_body\": {");
    put_number(out, "factor [1]", it->trials[it->mechanism_trial].factor, ", ");
    put_number(out, "share_of_largest_displacement [1]", body->share, ", ");
    put_number(out, "displacement_limit [m]", body->limit, ", ");
    put_number(out, is_plane ? "area [m2]" : "volume [m3]", body->volume, ", ");
    fprintf(out, "\"particles [1]\": %" PRId64 ", ", body->n);
    put_number(out, "top_x [m]", body->top[0], ", ");
    put_number(out, "top_y [m]", body->top[1], ", ");
    put_number(out, "toe_x [m]", body->toe[0], ", ");
    put_number(out, "toe_y [m]", body->toe[1], "},\n");
}

static void put_trials(const mor_safety *it, FILE *out)
{
    const mor_safety_reference *r = &it->setup.reference;
    int order[MOR_SAFETY_TRIALS_MAX];
    sort_trials(it, order);
    fprintf(out, "  \"trials\": [");
    for (int k = 0; k < it->n_trials; ++k) {
        const mor_safety_trial *trial = &it->trials[order[k]];
        const mor_safety_sample last = mor_safety_trial_last(trial);
        fprintf(out, "%s\n    {", k > 0 ? "," : "");
        put_number(out, "factor [1]", trial->factor, ", ");
        put_text(out, "verdict", mor_safety_verdict_word(trial->finding.verdict), ", ");
        put_text(out, "by_speed", mor_safety_sign_word(trial->finding.by_speed), ", ");
        put_text(out, "by_displacement", mor_safety_sign_word(trial->finding.by_displacement), ", ");
        put_number(out, "speed [m/s]", trial->finding.speed * mor_safety_reference_speed(r), ", ");
        put_number(out, "displacement [m]", last.displacement * r->height, ", ");
        put_number(out, "time [s]", trial->seconds, ", ");
        put_text(out, "reason", trial->finding.reason, "}");
    }
    fprintf(out, "\n  ]\n");
}

static void put_warnings(const mor_safety *it, FILE *out)
{
    fprintf(out, "  \"warnings\": [");
    for (int k = 0; k < it->warnings.n; ++k) {
        fprintf(out, "\n    ");
        put_string(out, it->warnings.texts[k], k + 1 < it->warnings.n ? "," : "");
    }
    fprintf(out, it->warnings.n > 0 ? "\n  ],\n" : "],\n");
}

mor_status mor_safety_write_summary(mor_context *context, const mor_safety *it, const mor_safety_request *request,
                                    const mor_safety_provenance *provenance, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "fos.json"));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    FILE *out = file.stream;
    const mor_case *c = it->setup.reduced->original;
    fprintf(out, "{\n  ");
    put_text(out, "title", c->title, ",\n  ");
    put_text(out, "case", c->path, ",\n  ");
    put_text(out, "version", provenance->version, ",\n  ");
    put_text(out, "commit", provenance->commit, ",\n  ");
    put_text(out, "command", provenance->command, ",\n  ");
    put_number(out, "spacing [m]", c->spacing, ",\n  ");
    put_number(out, "largest_stable [1]", it->band.stable, ",\n  ");
    put_number(out, "smallest_failing [1]", it->band.fails, ",\n  ");
    put_number(out, "tolerance [1]", request->bracket.tolerance, ",\n  ");
    fprintf(out, "\"undecided\": %d,\n  \"contradicted\": %s,\n  \"stopped\": %s,\n", it->band.n_undecided,
            it->band.is_contradicted ? "true" : "false", it->is_stopped ? "true" : "false");
    put_soils(it, out);
    put_rules(it, out);
    put_body(it, out);
    put_warnings(it, out);
    put_trials(it, out);
    fprintf(out, "}\n");
    return mor_durable_file_commit(context, &file);
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

void mor_safety_format_band(const mor_safety_band *band, char *text, size_t text_bytes)
{
    if (isnan(band->stable)) {
        snprintf(text, text_bytes, isnan(band->fails) ? "none found" : "below %.4g", band->fails);
    } else if (isnan(band->fails)) {
        snprintf(text, text_bytes, "above %.4g", band->stable);
    } else {
        snprintf(text, text_bytes, "%.4g to %.4g", band->stable, band->fails);
    }
}

static void print_body(const mor_safety *it, FILE *out)
{
    const mor_safety_body *body = &it->body;
    const bool is_plane = it->setup.reduced->original->dimension == 2;
    fprintf(out,
            "critical body at F = %.5g: soil of %s %.4g %s, %" PRId64
            " particles that moved more than %.3g m (%.2g of the "
            "largest displacement)\n",
            it->trials[it->mechanism_trial].factor, is_plane ? "area" : "volume", body->volume, is_plane ? "m2" : "m3",
            body->n, body->limit, body->share);
    if (body->has_ends) {
        fprintf(out, "  its surface reaches from (%.4g, %.4g) m, the upper end, to (%.4g, %.4g) m, the lower end\n",
                body->top[0], body->top[1], body->toe[0], body->toe[1]);
    }
}

void mor_safety_print(const mor_safety *it, FILE *out)
{
    char text[64];
    const mor_safety_rules *rules = &it->setup.rules;
    const mor_safety_reference *r = &it->setup.reference;
    mor_safety_format_band(&it->band, text, sizeof text);
    fprintf(out, "\nfactor of safety: %s", text);
    fprintf(out,
            it->band.n_undecided > 0 ? " (largest that is stable to smallest that fails; %d undecided between)\n"
                                     : " (largest that is stable to smallest that fails)\n",
            it->band.n_undecided);
    if (it->is_stopped) {
        fprintf(out, "the search was stopped: the band is that of its %d trials so far; run it again for the whole\n",
                it->n_trials);
    }
    if (it->band.is_contradicted) {
        fprintf(out, "the verdicts do not follow the factor: a trial stands above one that does not; see trials.csv\n");
    }
    fprintf(out,
            "by speed: rests below %.3g m/s, moves above %.3g m/s while it has 0.9 of its speed one window before; by "
            "displacement: moves beyond %.3g m while it grows (slope of H = %.4g m)\n",
            rules->rest * mor_safety_reference_speed(r), rules->motion * mor_safety_reference_speed(r),
            rules->far * r->height, r->height);
    if (it->mechanism != NULL) {
        print_body(it, out);
    }
}
