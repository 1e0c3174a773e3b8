/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/rock_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Any bytes as a table of rocks; the first decides on the dimension. Whatever they are, the reader must refuse them
 * with a place, or give rocks with a size. */

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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    /* The table of units takes a quarter of a second to read: once. */
    static mor_context units_context;
    static mor_units *units;
    mor_context context;
    mor_rock_list list;
    if (units == NULL) {
        mor_context_init(&units_context);
        require(mor_units_new(&units_context, &units) == MOR_OK);
    }
    mor_context_init(&context);
    const int dimension = n_bytes > 0 && data[0] % 2 == 0 ? 2 : 3;
    const mor_status status =
        mor_rock_list_parse(&context, units, "a.csv", (const char *)data, (int64_t)n_bytes, dimension, &list);
    if (status == MOR_OK) {
        require(list.n_rows >= 1 && list.n_rows <= MOR_ROCK_LIST_ROWS_MAX);
        for (int k = 0; k < list.n_rows; ++k) {
            const mor_rock_row *row = &list.rows[k];
            require(isfinite(row->position[0]) && isfinite(row->position[1]) && isfinite(row->position[2]));
            require(isfinite(row->diameter) && row->diameter > 0.0 && (isnan(row->density) || row->density > 0.0));
        }
    } else {
        require(status == MOR_ERROR_CONFIG && list.rows == NULL && strncmp(context.message, "a.csv:", 6) == 0);
    }
    mor_rock_list_clear(&context, &list);
    require(context.memory_bytes == 0);
    return 0;
}
