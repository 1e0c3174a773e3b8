/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_warnings.h"

#include "cases/driver/sweep/result/sweep_write.h"
#include "core/base/memory.h"
#include "core/io/summary/summary.h"

#include <ctype.h>
#include <string.h>

/* Where a number at the start of a text ends: digits with a decimal point and an exponent, such as 2.5e-07. */
static const char *skip_number(const char *text)
{
    text += strspn(text, "0123456789");
    if (text[0] == '.' && isdigit((unsigned char)text[1])) {
        text += 1 + strspn(text + 1, "0123456789");
    }
    const char *exponent = text + 1 + (text[0] == 'e' && (text[1] == '+' || text[1] == '-'));
    return text[0] == 'e' && isdigit((unsigned char)exponent[0]) ? exponent + strspn(exponent, "0123456789") : text;
}

bool mor_sweep_warnings_are_alike(const char *a, const char *b)
{
    while (*a != '\0' || *b != '\0') {
        const bool is_number = isdigit((unsigned char)*a) && isdigit((unsigned char)*b);
        if (!is_number && *a != *b) {
            return false;
        }
        a = is_number ? skip_number(a) : a + 1;
        b = is_number ? skip_number(b) : b + 1;
    }
    return true;
}

/* A member whose warnings are read. */
typedef struct reading {
    mor_context *context;
    mor_sweep_warnings *warnings;
    int member;
    mor_status status;
} reading;

/* A member that warns twice alike counts once. */
static void add_member(mor_sweep_warning *it, int member)
{
    if (it->n_members > 0 && it->last == member) {
        return;
    }
    if (it->n_members < MOR_SWEEP_WARNING_MEMBERS) {
        it->members[it->n_members] = member;
    }
    it->n_members += 1;
    it->last = member;
}

static mor_status add_text(mor_context *context, mor_sweep_warning *it, const char *text)
{
    const int64_t n_bytes = (int64_t)strlen(text) + 1;
    MOR_TRY(context, MOR_NEW(context, &it->text, n_bytes, "warning of a member"));
    memcpy(it->text, text, (size_t)n_bytes);
    return MOR_OK;
}

static void read_one(void *user, const char *text)
{
    reading *it = user;
    mor_sweep_warnings *all = it->warnings;
    int k = 0;
    while (k < all->n && !mor_sweep_warnings_are_alike(all->items[k].text, text)) {
        ++k;
    }
    if (k == MOR_SWEEP_WARNINGS_MAX) {
        all->n_left_out += 1;
        return;
    }
    if (k == all->n) {
        const mor_status status = add_text(it->context, &all->items[k], text);
        if (status != MOR_OK) {
            it->status = status;
            return;
        }
        all->n += 1;
    }
    add_member(&all->items[k], it->member);
}

mor_status mor_sweep_warnings_add(mor_context *context, mor_sweep_warnings *warnings, int member, const char *path)
{
    reading it = {.context = context, .warnings = warnings, .member = member, .status = MOR_OK};
    MOR_TRY(context, mor_summary_visit_warnings(context, path, read_one, &it));
    return it.status;
}

mor_status mor_sweep_warnings_collect(mor_context *context, const mor_sweep_table *table, const char *folder,
                                      mor_sweep_warnings *warnings)
{
    for (int m = 0; m < table->design->n_members; ++m) {
        char of_member[MOR_PATH_BYTES];
        char path[MOR_PATH_BYTES];
        if (mor_sweep_table_is_used(table, m) && table->outcomes[m].n_warnings > 0) {
            MOR_TRY(context, mor_sweep_write_find_folder(context, folder, m, of_member));
            MOR_TRY(context, mor_durable_file_join(context, path, of_member, MOR_SUMMARY_FILE));
            MOR_TRY(context, mor_sweep_warnings_add(context, warnings, m, path));
        }
    }
    return MOR_OK;
}

void mor_sweep_warnings_clear(mor_context *context, mor_sweep_warnings *warnings)
{
    for (int k = 0; k < warnings->n; ++k) {
        MOR_FREE(context, &warnings->items[k].text);
    }
    memset(warnings, 0, sizeof *warnings);
}
