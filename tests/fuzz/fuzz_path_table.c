/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/column_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Any bytes as a table of a motion; the first decides on the dimension. Whatever they are, the reader must refuse them
 * with a place, or give rows of finite numbers, each with a time. */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

/* UDUNITS itself loses the word that its scanner was reading when it gives up. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libudunits2\n";
}

static void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

/* As those of cases/driver/case/sections/case_read_path.c: an angle must tell its unit. */
static const mor_column columns[] = {{"time", "s", false, true, false},
                                     {"x", "m", false, false, false},
                                     {"y", "m", false, false, false},
                                     {"angle", "rad", false, false, true},
                                     {"z", "m", false, false, false}};

enum { N_COLUMNS = 5, ROWS_MAX = 1000 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    /* The table of units takes a quarter of a second to read: once. */
    static mor_context units_context;
    static mor_units *units;
    mor_context context;
    mor_column_table table;
    if (units == NULL) {
        mor_context_init(&units_context);
        require(mor_units_new(&units_context, &units) == MOR_OK);
    }
    mor_context_init(&context);
    const bool is_plane = n_bytes > 0 && data[0] % 2 == 0;
    const mor_column_spec spec = {.columns = columns,
                                  .n_columns = is_plane ? N_COLUMNS - 1 : N_COLUMNS,
                                  .rows_max = ROWS_MAX,
                                  .what = "a table of a motion",
                                  .row = "time",
                                  .remark = ""};
    const mor_status status =
        mor_column_table_parse(&context, units, "a.csv", (const char *)data, (int64_t)n_bytes, &spec, &table);
    if (status == MOR_OK) {
        require(table.n_rows >= 1 && table.n_rows <= ROWS_MAX);
        for (int k = 0; k < table.n_rows * spec.n_columns; ++k) {
            require(isfinite(table.values[k]) || (k % spec.n_columns > 0 && isnan(table.values[k])));
        }
    } else {
        require(status == MOR_ERROR_CONFIG && strncmp(context.message, "a.csv:", 6) == 0);
    }
    mor_column_table_clear(&context, &table);
    require(context.memory_bytes == 0);
    return 0;
}
