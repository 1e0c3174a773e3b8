/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Prescribed motions, formulas, and the hashes of files. */
#include "cases/driver/case/write/case_writer.h"

#include "core/base/hash.h"

#include <math.h>
#include <string.h>

void mor_case_writer_hash(const mor_case_writer *w, uint64_t file_hash)
{
    if (file_hash != 0) {
        char hash[MOR_HASH_TEXT_BYTES];
        mor_hash_format(file_hash, hash);
        fprintf(w->stream, "%*s# content of the file: xxh64 %s\n", w->depth * MOR_CASE_INDENT, "", hash);
    }
}

void mor_case_writer_formulas(const mor_case_writer *w, const char *key, const char (*formulas)[MOR_CASE_TEXT_BYTES],
                              int n_max)
{
    if (formulas[0][0] == '\0') {
        return;
    }
    fprintf(w->stream, "%*s%s = (", w->depth * MOR_CASE_INDENT, "", key);
    for (int k = 0; k < n_max && formulas[k][0] != '\0'; ++k) {
        char value[MOR_CASE_VALUE_BYTES];
        mor_case_writer_text(formulas[k], value, sizeof value);
        fprintf(w->stream, "%s%s", k > 0 ? ", " : "", value);
    }
    fprintf(w->stream, ");\n");
}

static mor_case_presence presence_of_path_key(const mor_case_key *key, const void *record)
{
    const mor_case_path *path = record;
    const char *name = key->schema.key;
    if (strcmp(name, "file") == 0) {
        return path->file[0] == '\0' ? MOR_CASE_OMIT : MOR_CASE_WRITE;
    }
    return strcmp(name, "point") == 0 && isnan(path->point[0]) ? MOR_CASE_MENTION : MOR_CASE_WRITE;
}

mor_status mor_case_writer_path(mor_case_writer *w, const mor_case_path *path)
{
    if (path->n_rows == 0) {
        return MOR_OK;
    }
    mor_case_writer_open(w, "path", "{");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_path_group, path, presence_of_path_key));
    mor_case_writer_hash(w, path->file_hash);
    if (path->file[0] == '\0') {
        mor_case_writer_open(w, "table", "(");
        for (int k = 0; k < path->n_rows; ++k) {
            const mor_case_path_row row = {path->rows[k], UINT64_MAX};
            mor_case_writer_open(w, "", "{");
            MOR_TRY(w->reader.context,
                    mor_case_writer_keys(w, &mor_case_path_row_group, &row, mor_case_presence_always));
            mor_case_writer_close(w, k + 1 < path->n_rows ? "}," : "}");
        }
        mor_case_writer_close(w, ");");
    }
    mor_case_writer_close(w, "};");
    return MOR_OK;
}
