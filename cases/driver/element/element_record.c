/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_record.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { START_BYTES = 1024 };

static const struct {
    const char *name, *unit;
} columns[MOR_ELEMENT_COLUMNS] = {
    [MOR_ELEMENT_TIME] = {"time", "s"},
    [MOR_ELEMENT_AXIAL_STRAIN] = {"axial_strain", "1"},
    [MOR_ELEMENT_SHEAR_STRAIN] = {"shear_strain", "1"},
    [MOR_ELEMENT_EPS_V] = {"eps_v", "1"},
    [MOR_ELEMENT_EPS_Q] = {"eps_q", "1"},
    [MOR_ELEMENT_P] = {"p", "Pa"},
    [MOR_ELEMENT_Q] = {"q", "Pa"},
    [MOR_ELEMENT_NORMAL_STRESS] = {"normal_stress", "Pa"},
    [MOR_ELEMENT_SHEAR_STRESS] = {"shear_stress", "Pa"},
    [MOR_ELEMENT_FRICTION_ANGLE] = {"mobilized_friction", "rad"},
    [MOR_ELEMENT_VOID_RATIO] = {"void_ratio", "1"},
    [MOR_ELEMENT_STRESS] = {"stress_xx", "Pa"},
    [MOR_ELEMENT_STRESS + 1] = {"stress_yy", "Pa"},
    [MOR_ELEMENT_STRESS + 2] = {"stress_zz", "Pa"},
    [MOR_ELEMENT_STRESS + 3] = {"stress_xy", "Pa"},
    [MOR_ELEMENT_STRESS + 4] = {"stress_yz", "Pa"},
    [MOR_ELEMENT_STRESS + 5] = {"stress_zx", "Pa"},
    [MOR_ELEMENT_STRAIN] = {"strain_xx", "1"},
    [MOR_ELEMENT_STRAIN + 1] = {"strain_yy", "1"},
    [MOR_ELEMENT_STRAIN + 2] = {"strain_zz", "1"},
    [MOR_ELEMENT_STRAIN + 3] = {"strain_xy", "1"},
    [MOR_ELEMENT_STRAIN + 4] = {"strain_yz", "1"},
    [MOR_ELEMENT_STRAIN + 5] = {"strain_zx", "1"},
};

const char *mor_element_column_name(int column, const char **unit)
{
    *unit = columns[column].unit;
    return columns[column].name;
}

mor_status mor_element_record_init(mor_context *context, const mor_material *material, const char *name,
                                   double void_ratio, int64_t capacity, mor_element_record *record)
{
    *record = (mor_element_record){.material = material, .start_void_ratio = void_ratio, .capacity = capacity};
    record->n_columns = MOR_ELEMENT_COLUMNS + (material != NULL ? mor_params_count(material->state) : 0);
    snprintf(record->name, sizeof record->name, "%.63s", name);
    return MOR_NEW(context, &record->values, capacity * record->n_columns, "rows of an element test");
}

void mor_element_record_clear(mor_context *context, mor_element_record *record)
{
    MOR_FREE(context, &record->values);
    memset(record, 0, sizeof *record);
}

/* The void ratio: a state of the law that is called so, else what the change of volume makes of the start: 1 + e is
 * proportional to the volume. */
static double find_void_ratio(const mor_element_record *record, const mor_element *element, double eps_v)
{
    const int entry = mor_params_find(record->material->state, "void_ratio");
    return entry >= 0 ? element->state[mor_params_offset(record->material->state, entry)]
                      : (1.0 + record->start_void_ratio) * exp(-eps_v) - 1.0;
}

void mor_element_record_add(mor_element_record *record, const mor_element *element, bool is_signed)
{
    if (record->n_rows >= record->capacity) {
        return;
    }
    double *row = record->values + record->n_rows * record->n_columns;
    mor_element_measures m;
    mor_element_measure_all(element, is_signed, &m);
    row[MOR_ELEMENT_TIME] = element->time;
    row[MOR_ELEMENT_AXIAL_STRAIN] = m.axial_strain;
    row[MOR_ELEMENT_SHEAR_STRAIN] = m.shear_strain;
    row[MOR_ELEMENT_EPS_V] = m.eps_v;
    row[MOR_ELEMENT_EPS_Q] = m.eps_q;
    row[MOR_ELEMENT_P] = m.p;
    row[MOR_ELEMENT_Q] = m.q;
    row[MOR_ELEMENT_NORMAL_STRESS] = 0.0 - element->stress[MOR_ZZ];
    row[MOR_ELEMENT_SHEAR_STRESS] = m.shear_stress;
    row[MOR_ELEMENT_FRICTION_ANGLE] = m.friction;
    row[MOR_ELEMENT_VOID_RATIO] = find_void_ratio(record, element, m.eps_v);
    memcpy(row + MOR_ELEMENT_STRESS, element->stress, sizeof element->stress);
    memcpy(row + MOR_ELEMENT_STRAIN, element->strain, sizeof element->strain);
    memcpy(row + MOR_ELEMENT_COLUMNS, element->state, (size_t)(record->n_columns - MOR_ELEMENT_COLUMNS) * sizeof *row);
    record->n_rows += 1;
    record->n_updates = element->n_steps;
    record->n_rejected = element->n_rejected;
    record->n_iterations = element->n_iterations;
}

/* The names of the columns that all laws have. */
static void format_start(char *text, size_t text_bytes)
{
    size_t used = 0;
    for (int k = 0; k < MOR_ELEMENT_COLUMNS && used < text_bytes; ++k) {
        used += (size_t)snprintf(text + used, text_bytes - used, "%s%s [%s]", k == 0 ? "" : ",", columns[k].name,
                                 columns[k].unit);
    }
}

bool mor_element_record_is_table(const char *path)
{
    char start[START_BYTES];
    char found[START_BYTES] = "";
    format_start(start, sizeof start);
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return false;
    }
    const size_t n_read = fread(found, 1, strlen(start), file);
    fclose(file);
    return n_read == strlen(start) && memcmp(found, start, n_read) == 0;
}

static void write_header(const mor_element_record *record, FILE *out)
{
    char start[START_BYTES];
    format_start(start, sizeof start);
    fputs(start, out);
    for (const mor_schema *state = record->material->state; state->key != NULL; ++state) {
        for (int a = 0; a < state->n_components; ++a) {
            fprintf(out, ",state.%s", state->key);
            if (state->n_components > 1) {
                fprintf(out, ".%d", a + 1);
            }
            fprintf(out, " [%s]", state->unit);
        }
    }
    fputc('\n', out);
}

mor_status mor_element_record_write(mor_context *context, const mor_element_record *record, const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    write_header(record, file.stream);
    for (int64_t i = 0; i < record->n_rows; ++i) {
        for (int k = 0; k < record->n_columns; ++k) {
            const double value = record->values[i * record->n_columns + k];
            fprintf(file.stream, "%s%.17g", k == 0 ? "" : ",", isnan(value) ? NAN : value); /* nan without a sign */
        }
        fputc('\n', file.stream);
    }
    return mor_durable_file_commit(context, &file);
}
