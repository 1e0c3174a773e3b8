/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Whether a sweep that goes on is the one that its folder was started with. All of it is compared before any member
 * runs: results of two studies in one table would look like those of one. */
#include "cases/driver/library/session_sweep_internal.h"

#include <stdlib.h>
#include <string.h>

#define ADVICE "resume with the same program, case and values, or start a new sweep in another folder"

enum { DIFFERENCE_BYTES = 1024 };

/* ---- Lines of a design ------------------------------------------------------------------------------------------- */

/* A design as text, line by line. */
typedef struct lines {
    FILE *stream;
    char *text; /* the present line, without its end; "" behind the last one */
    size_t n_bytes;
} lines;

static bool read_line(lines *it)
{
    const ssize_t n = getline(&it->text, &it->n_bytes, it->stream);
    if (n > 0 && it->text[n - 1] == '\n') {
        it->text[n - 1] = '\0';
    }
    return n > 0;
}

/* What follows the number of a member and the hash of its case: the case file and what is set. */
static const char *find_settings(const char *line)
{
    for (int k = 0; k < 2 && *line != '\0'; ++k) {
        line += strcspn(line, " ");
        line += strspn(line, " ");
    }
    return line;
}

/* ---- Comparing --------------------------------------------------------------------------------------------------- */

static mor_status check_program(mor_session_sweeper *it, lines *held, lines *wanted)
{
    mor_context *context = &it->session->context;
    const bool has_held = read_line(held);
    const bool has_wanted = read_line(wanted);
    MOR_CHECK(context, has_held && has_wanted && strcmp(held->text, wanted->text) == 0, MOR_ERROR_CONFIG,
              "the sweep in '%s' was started with another program: '%.200s', and this is '%s'; results of two programs "
              "would be mixed; " ADVICE,
              it->folder, has_held ? held->text : "", has_wanted ? wanted->text : "");
    return MOR_OK;
}

/* Settings of each member; counts members whose case differs all the same, and finds the first. */
static mor_status check_members(mor_session_sweeper *it, lines *held, lines *wanted, int *n_changed, int *first)
{
    mor_context *context = &it->session->context;
    int n_held = 0;
    for (int m = 0; m < it->design.n_members && read_line(held); ++m, ++n_held) {
        char number[16];
        MOR_CHECK(context, read_line(wanted), MOR_ERROR_MEMORY, "no memory for the members of a sweep");
        const char *was = find_settings(held->text);
        const char *now = find_settings(wanted->text);
        mor_sweep_write_number(m, number);
        MOR_CHECK(context, strcmp(was, now) == 0, MOR_ERROR_CONFIG,
                  "the sweep '%s' with its overrides is not the one that '%s' was started with: member %s is '%.500s', "
                  "was '%.500s'; " ADVICE,
                  it->sweep.path, it->folder, number, now, was);
        if (strcmp(held->text, wanted->text) != 0) {
            *first = *n_changed == 0 ? m : *first;
            *n_changed += 1;
        }
    }
    while (read_line(held)) {
        ++n_held;
    }
    MOR_CHECK(context, n_held == it->design.n_members, MOR_ERROR_CONFIG,
              "the sweep '%s' with its overrides is not the one that '%s' was started with: it has %d members, and had "
              "%d; " ADVICE,
              it->sweep.path, it->folder, it->design.n_members, n_held);
    return MOR_OK;
}

static mor_status refuse_cases(mor_session_sweeper *it, int n_changed, int first)
{
    mor_context *context = &it->session->context;
    char difference[DIFFERENCE_BYTES] = "";
    char number[16];
    char more[32] = "";
    mor_sweep_write_number(first, number);
    if (it->case_hashes[first] != 0) {
        MOR_TRY(context, mor_session_sweep_explain(it, first, difference, sizeof difference));
    }
    if (n_changed > 1) {
        snprintf(more, sizeof more, " and %d more", n_changed - 1);
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "the case%s of member %s%s %s that '%s' was started with%s; results of two studies would be mixed; "
                    "nothing was run; " ADVICE,
                    n_changed > 1 ? "s" : "", number, more, n_changed > 1 ? "are not those" : "is not the one",
                    it->folder, difference);
}

static mor_status compare_lines(mor_session_sweeper *it, lines *held, lines *wanted)
{
    mor_context *context = &it->session->context;
    int n_changed = 0;
    int first = 0;
    MOR_TRY(context, check_program(it, held, wanted));
    MOR_TRY(context, check_members(it, held, wanted, &n_changed, &first));
    return n_changed == 0 ? MOR_OK : refuse_cases(it, n_changed, first);
}

/* A folder that went on with another case by hand holds other results than those of the sweep. */
static mor_status check_folders(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    for (int m = 0; m < it->design.n_members; ++m) {
        char folder[MOR_PATH_BYTES];
        char difference[DIFFERENCE_BYTES];
        uint64_t hash = 0;
        MOR_TRY(context, mor_sweep_write_find_folder(context, it->folder, m, folder));
        MOR_TRY(context, mor_run_files_hash_folder(context, folder, &hash));
        if (hash != 0 && it->case_hashes[m] != 0 && hash != it->case_hashes[m]) {
            MOR_TRY(context, mor_session_sweep_explain(it, m, difference, sizeof difference));
            return MOR_FAIL(
                context, MOR_ERROR_CONFIG,
                "'%s' holds another case than the sweep gives to it%s; nothing was run; remove that folder, "
                "which lets the member run anew, or start a new sweep in another folder",
                folder, difference);
        }
    }
    return MOR_OK;
}

mor_status mor_session_sweep_compare(mor_session_sweeper *it, const char *path)
{
    mor_context *context = &it->session->context;
    char *text = NULL;
    size_t n_bytes = 0;
    lines held = {.stream = fopen(path, "r")};
    lines wanted = {.stream = NULL};
    mor_status status = MOR_OK;
    FILE *stream = open_memstream(&text, &n_bytes);
    if (stream != NULL) {
        mor_sweep_write_design(&it->design, &it->provenance, it->case_hashes, stream);
        wanted.stream = fclose(stream) == 0 ? fmemopen(text, n_bytes, "r") : NULL;
    }
    if (held.stream == NULL) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "'%s' cannot be read; check the folder's permissions", path);
    } else if (wanted.stream == NULL) {
        status = MOR_FAIL(context, MOR_ERROR_MEMORY, "no memory for the members of a sweep");
    } else {
        status = compare_lines(it, &held, &wanted);
    }
    if (held.stream != NULL) {
        fclose(held.stream);
    }
    if (wanted.stream != NULL) {
        fclose(wanted.stream);
    }
    free(held.text);
    free(wanted.text);
    free(text);
    return status == MOR_OK ? check_folders(it) : status;
}
