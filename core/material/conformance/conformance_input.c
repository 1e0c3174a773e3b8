/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a failure was found with, so that it can be found again. */
#include "core/material/conformance/conformance_bench.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES };

static void append(char *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void append(char *text, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, MOR_CONFORMANCE_INPUT_BYTES - used, format, arguments);
    va_end(arguments);
}

/* "key = 1 Pa", "key = (1, 2) Pa". Twelve digits tell a number well enough to find the failure again. */
static void append_numbers(char *text, const char *key, const double *values, int n, const char *unit)
{
    append(text, "%s = %s", key, n > 1 ? "(" : "");
    for (int k = 0; k < n; ++k) {
        append(text, "%s%.12g", k > 0 ? ", " : "", values[k]);
    }
    append(text, "%s%s%s", n > 1 ? ")" : "", strcmp(unit, "1") == 0 ? "" : " ", strcmp(unit, "1") == 0 ? "" : unit);
}

static void append_particle(const mor_bench *bench, char *text, int i)
{
    const mor_bench_tried *tried = &bench->tried;
    const int is_rate = bench->material->form == MOR_MATERIAL_RATE;
    int64_t offset = 0;
    if (is_rate) {
        append(text, "\nstart: ");
        append_numbers(text, "stress", tried->stress + 6 * i, 6, "Pa (xx, yy, zz, xy, yz, zx; tension positive)");
    }
    for (int k = 0; k < bench->instance->n_state; ++k) {
        const mor_schema *schema = &bench->material->state[k];
        append(text, is_rate || k > 0 ? "; " : "\nstart: ");
        append_numbers(text, schema->key, tried->state + offset + (int64_t)schema->n_components * i,
                       schema->n_components, schema->unit);
        offset += (int64_t)schema->n_components * N;
    }
    append(text, "\nstep: ");
    append_numbers(text, is_rate ? "velocity gradient" : "deformation gradient", tried->motion + 9 * i, 9,
                   is_rate ? "1/s (row by row)" : "1 (row by row)");
    append(text, "; ");
    append_numbers(text, "time step", &bench->time_step, 1, "s");
    if (is_rate && mor_bench_largest(tried->extra + 6 * i, 6) > 0.0) {
        append(text, "; ");
        append_numbers(text, "extra stress rate", tried->extra + 6 * i, 6, "Pa/s");
    }
}

void mor_bench_record(const mor_bench *bench, mor_conformance_row *row, int particle)
{
    if (row->input[0] != '\0') {
        return;
    }
    const double *values = bench->parameters;
    append(row->input, "found with: ");
    for (const mor_schema *entry = bench->material->parameters; entry->key != NULL; ++entry) {
        append_numbers(row->input, entry->key, values, entry->n_components, entry->unit);
        append(row->input, "; ");
        values += entry->n_components;
    }
    append_numbers(row->input, "density", &bench->density, 1, "kg/m3");
    if (particle >= 0) {
        append_particle(bench, row->input, particle);
    }
}

void mor_bench_take_at(const mor_bench *bench, mor_conformance_row *row, int particle, double figure)
{
    mor_bench_take(row, figure);
    if (!(figure <= row->tolerance)) {
        mor_bench_record(bench, row, particle);
    }
}
