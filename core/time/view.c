/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/view.h"

mor_view mor_view_open(mor_set *set, const mor_stage *stage)
{
    return (mor_view){.set = set, .stage = stage, .generation = set != NULL ? set->generation : 0};
}

static void note_read(mor_view *view, int bit)
{
    const mor_stage *stage = view->stage;
    if (stage != NULL) {
        view->undeclared_reads |= MOR_BIT(bit) & ~(stage->reads | stage->writes | stage->accumulates);
    }
}

static void note_write(mor_view *view, int bit)
{
    if (view->stage != NULL) {
        view->undeclared_writes |= MOR_BIT(bit) & ~(view->stage->writes | view->stage->accumulates);
    }
}

void mor_view_renew(mor_view *view)
{
    note_write(view, MOR_RESOURCE_ORDER);
    view->generation = view->set->generation;
}

const double *mor_view_read(mor_view *view, int field)
{
    const int bit = mor_stage_bit_of(view->set, field);
    note_read(view, bit);
    mor_view_compare(view, bit, view->generation);
    return view->set->data[field];
}

double *mor_view_write(mor_view *view, int field)
{
    const int bit = mor_stage_bit_of(view->set, field);
    note_write(view, bit);
    mor_view_compare(view, bit, view->generation);
    return view->set->data[field];
}

void mor_view_read_state(mor_view *view, const int *fields, int n_state, const double **state)
{
    for (int k = 0; k < n_state; ++k) {
        state[k] = mor_view_read(view, fields[k]);
    }
}

void mor_view_write_state(mor_view *view, const int *fields, int n_state, double **state)
{
    for (int k = 0; k < n_state; ++k) {
        state[k] = mor_view_write(view, fields[k]);
    }
}

const void *mor_view_read_shared(mor_view *view, int resource, const void *data)
{
    note_read(view, resource);
    return data;
}

void *mor_view_write_shared(mor_view *view, int resource, void *data)
{
    note_write(view, resource);
    return data;
}

void mor_view_compare(mor_view *view, int resource, uint64_t generation)
{
    note_read(view, resource);
    view->stale |= generation != view->set->generation ? MOR_BIT(resource) : 0;
}

const double *mor_view_quote(const mor_view *view, int field, int64_t particle)
{
    return view->set->data[field] + particle * view->set->fields[field].n_components;
}

mor_status mor_view_close(mor_context *context, const mor_view *view)
{
    if ((view->undeclared_reads | view->undeclared_writes | view->stale) == 0 || view->stage == NULL) {
        return MOR_OK;
    }
    const mor_stage *stage = view->stage;
    const char *set = view->set != NULL ? view->set->name : "";
    char found[256];
    char allowed[1024];
    mor_stage_list_bits(view->set, view->undeclared_writes, ", ", found, sizeof found);
    mor_stage_list_bits(view->set, stage->writes | stage->accumulates, ", ", allowed, sizeof allowed);
    MOR_CHECK(context, view->undeclared_writes == 0, MOR_ERROR_INTERNAL,
              "stage '%s' of set '%s' writes %s, which it does not declare; it may write %s. Declare it in the row of "
              "the stage, or do without",
              stage->name, set, found, allowed);
    mor_stage_list_bits(view->set, view->undeclared_reads, ", ", found, sizeof found);
    mor_stage_list_bits(view->set, stage->reads | stage->writes | stage->accumulates, ", ", allowed, sizeof allowed);
    MOR_CHECK(context, view->undeclared_reads == 0, MOR_ERROR_INTERNAL,
              "stage '%s' of set '%s' reads %s, which it does not declare; it may read %s. Declare it in the row of "
              "the stage, or do without",
              stage->name, set, found, allowed);
    mor_stage_list_bits(view->set, view->stale, ", ", found, sizeof found);
    return MOR_FAIL(context, MOR_ERROR_INTERNAL,
                    "stage '%s' of set '%s' uses %s of an earlier order of the particles; they have been sorted or "
                    "removed since. Make it anew for the present order first",
                    stage->name, set, found);
}
