/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/stage.h"

#include <stdio.h>
#include <string.h>

static const char *const resource_names[] = {
#define NAME(identifier, name) "(" name ")",
    MOR_RESOURCE_LIST(NAME)
#undef NAME
};

_Static_assert(MOR_STAGE_BITS <= 64, "fields and resources share the bits of one number");

int mor_stage_bit_of(const mor_set *set, int field)
{
    return (set->fields[field].flags & MOR_FIELD_STATE) != 0 ? MOR_RESOURCE_STATE : field;
}

const char *mor_stage_bit_name(const mor_set *set, int bit)
{
    if (bit >= MOR_RESOURCE_FIRST && bit < MOR_STAGE_BITS) {
        return resource_names[bit - MOR_RESOURCE_FIRST];
    }
    if (bit >= 0 && bit < MOR_FIELD_CORE_COUNT) {
        return mor_field_core_info((mor_field_id)bit)->name;
    }
    return set != NULL && bit >= 0 && bit < set->n_fields ? set->fields[bit].name : "unknown";
}

/* Adds a word and, before all but the first, a separator. */
static void append(char *text, size_t text_bytes, const char *separator, const char *word)
{
    const size_t used = strlen(text);
    snprintf(text + used, text_bytes - used, "%s%s", used > 0 ? separator : "", word);
}

void mor_stage_list_bits(const mor_set *set, uint64_t bits, const char *separator, char *text, size_t text_bytes)
{
    text[0] = '\0';
    for (int bit = 0; bit < 64; ++bit) {
        if ((bits >> bit & 1u) != 0) {
            append(text, text_bytes, separator, mor_stage_bit_name(set, bit));
        }
    }
    if (text[0] == '\0') {
        append(text, text_bytes, "", "nothing");
    }
}

void mor_stage_list_writers(const mor_stage *stages, int n_stages, int bit, char *text, size_t text_bytes)
{
    text[0] = '\0';
    for (int k = 0; k < n_stages; ++k) {
        if (((stages[k].writes | stages[k].accumulates) >> bit & 1u) != 0) {
            append(text, text_bytes, ", ", stages[k].name);
        }
    }
    if (text[0] == '\0') {
        append(text, text_bytes, "", "set-up");
    }
}

mor_status mor_stage_verify(mor_context *context, const mor_stage *stages, int n_stages, uint64_t evolving,
                            const mor_set *set)
{
    uint64_t valid = evolving;
    for (int s = 0; s < n_stages; ++s) {
        char names[256];
        const uint64_t stale = stages[s].reads & ~valid;
        mor_stage_list_bits(set, stale, ", ", names, sizeof names);
        MOR_CHECK(context, stale == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' reads %s before any stage of the step has written it; what does not evolve must be "
                  "written first: put a stage that writes it before this one",
                  stages[s].name, names);
        const uint64_t orphan = stages[s].accumulates & ~valid;
        mor_stage_list_bits(set, orphan, ", ", names, sizeof names);
        MOR_CHECK(context, orphan == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' adds to %s, which no earlier stage of the step has written; what does not evolve must "
                  "be written first: put a stage that writes it before this one",
                  stages[s].name, names);
        valid |= stages[s].writes;
    }
    return MOR_OK;
}

mor_status mor_stage_verify_shared(mor_context *context, const mor_stage *stages, int n_stages, uint64_t earlier,
                                   uint64_t later, const mor_set *set)
{
    bool is_late = false;
    for (int s = 0; s < n_stages; ++s) {
        char names[256];
        const uint64_t touched = stages[s].reads | stages[s].writes | stages[s].accumulates;
        is_late = is_late || (touched & later) != 0;
        mor_stage_list_bits(set, touched & earlier, ", ", names, sizeof names);
        MOR_CHECK(context, !is_late || (touched & earlier) == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' needs %s, whose memory holds what is found later in the step by then; give that memory "
                  "of its own",
                  stages[s].name, names);
    }
    return MOR_OK;
}
