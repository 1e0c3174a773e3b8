/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_design.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Any bytes as a sweep file. Whatever they are, the reader must refuse them with a place, or give members whose
 * settings have a key and a value, and samples within their limits. */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

/* libconfig loses the text that it was collecting when its parser gives up, UDUNITS the word of its scanner. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libconfig\nleak:libudunits2\n";
}

static void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

static void check_member(const mor_sweep_design *design, const mor_units *units, int member)
{
    static mor_sweep_settings settings;
    char label[MOR_SWEEP_LABEL_BYTES];
    mor_sweep_design_settings(design, units, member, &settings);
    for (int k = 0; k < settings.n; ++k) {
        const char *equals = strchr(settings.texts[k], '=');
        require(equals != NULL && equals > settings.texts[k] && equals[1] != '\0');
    }
    require(design->groups[member] >= 0 && design->groups[member] < design->n_groups);
    for (int v = 0; v < design->sweep->n_variables; ++v) {
        const mor_sweep_variable *it = &design->sweep->variables[v];
        const double value = mor_sweep_design_value(design, member, v);
        const bool is_out = design->choices[(int64_t)member * design->sweep->n_variables + v] < 0;
        require(it->n_choices > 0 || is_out ||
                (isfinite(value) && value >= it->distribution.minimum && value <= it->distribution.maximum));
        mor_sweep_design_label(design, member, v, label);
    }
    mor_sweep_design_describe(design, design->groups[member], 0u, label, sizeof label);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    /* The table of units takes a quarter of a second to read: once. */
    static mor_context units_context;
    static mor_units *units;
    static mor_sweep sweep;
    mor_context context;
    mor_sweep_design design;
    if (units == NULL) {
        mor_context_init(&units_context);
        require(mor_units_new(&units_context, &units) == MOR_OK);
    }
    mor_context_init(&context);
    const mor_sweep_text text = {
        .name = "a.cfg", .text = (const char *)data, .n_bytes = (int64_t)n_bytes, .units = units};
    mor_status status = mor_sweep_read_text(&context, &text, &sweep);
    if (status == MOR_OK) {
        status = mor_sweep_design_make(&context, &sweep, &design);
        for (int m = 0; status == MOR_OK && m < design.n_members; m += 1 + design.n_members / 64) {
            check_member(&design, units, m);
        }
        mor_sweep_design_clear(&context, &design);
    }
    require(status == MOR_OK || (status == MOR_ERROR_CONFIG && strncmp(context.message, "a.cfg:", 6) == 0));
    mor_sweep_clear(&context, &sweep);
    require(context.memory_bytes == 0);
    return 0;
}
