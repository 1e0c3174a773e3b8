/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_charts.h"
#include "cases/driver/sweep/result/sweep_write.h"
#include "tests/common/near.h"
#include "tests/common/run_folder.h"

#include <ctype.h>
#include <sys/stat.h>

/* Tables and sweep.json of a sweep whose members were made up. */

/* What a test works with. */
typedef struct bench {
    run_folder *folder;
    mor_units *units;
    mor_sweep sweep;
    mor_sweep_design design;
    mor_sweep_table table;
    mor_sweep_provenance provenance;
} bench;

/** What the leak sanitizer is to ignore, as in pile.h: Fontconfig keeps what it knows of fonts until the process ends.
 *  Returns: zero-terminated rules of the sanitizer's run-time library, which asks for them by this name. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

/* Texts that a table or JSON must not take as they are. */
#define ODD_TITLE "a \\\"title\\\", with \\\\ and \xff and \xc3\xa9"
#define ODD_REASON "x.cfg:3: found \"a\", or b\nand\tc"

/* Nine members warn alike. */
static const mor_sweep_warnings warned = {
    .n = 1, .items = {{.text = (char[]){"soil \"a\" moves"}, .members = {0, 1, 2, 3, 4, 5, 6, 7}, .n_members = 9}}};

/* Two groups of three: content 10 % and 20 %, packings 1 to 3. */
static void make(bench *b, run_folder *folder)
{
    static const char text[] =
        "title = \"" ODD_TITLE "\"; case = \"case.cfg\";"
        "vary = ( { key = \"content\"; values = (\"10 %\", \"20 %\"); },"
        "{ name = \"packing\"; key = \"rocks[0].seed\"; from = 1; to = 3; replicates = true; } );"
        "results = ( { probe = \"run_out\"; } ); exceed = ( { probe = \"run_out\"; above = 3; } );";
    mor_context *context = &folder->context;
    const mor_sweep_text given = {.name = "sweep.cfg", .text = text, .n_bytes = sizeof text - 1};
    mor_sweep_text with_units = given;
    memset(b, 0, sizeof *b);
    b->folder = folder;
    assert_int_equal(mor_units_new(context, &b->units), MOR_OK);
    with_units.units = b->units;
    if (mor_sweep_read_text(context, &with_units, &b->sweep) != MOR_OK) {
        fail_msg("%s", context->message);
    }
    assert_int_equal(mor_sweep_design_make(context, &b->sweep, &b->design), MOR_OK);
    assert_int_equal(mor_sweep_table_make(context, &b->design, &b->table), MOR_OK);
    b->table.columns[0] = (mor_sweep_column){.probe = "run_out", .unit = "m"};
    b->table.n_results = b->table.n_columns = 1;
    b->table.thresholds[0] = (mor_sweep_threshold){0, 3.0};
    assert_int_equal(mor_sweep_table_add_values(context, &b->table), MOR_OK);
    b->provenance = (mor_sweep_provenance){.run_word = "run",
                                           .set_word = "set",
                                           .units = b->units,
                                           .version = "1",
                                           .commit = "2",
                                           .command = "'quoted \"command\"'",
                                           .n_threads = 2};
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, "case.cfg"), "x", 1);
    snprintf(b->sweep.path, sizeof b->sweep.path, "%s/sweep.cfg", folder->path);
}

/* Run-outs 1, 2, 3 in the first group; 4, failed, and without a result in the second. */
static void fill(bench *b)
{
    static const double values[] = {1.0, 2.0, 3.0, 4.0, NAN, NAN};
    for (int m = 0; m < 6; ++m) {
        b->table.values[m] = values[m];
        b->table.has_probe[m] = true;
        b->table.outcomes[m].state = m == 4   ? MOR_SWEEP_STATE_FAILED
                                     : m == 2 ? MOR_SWEEP_STATE_MISSED
                                              : MOR_SWEEP_STATE_FINISHED;
    }
    snprintf(b->table.outcomes[4].reason, MOR_SWEEP_REASON_BYTES, "%s", ODD_REASON);
}

static void clear(bench *b)
{
    mor_context *context = &b->folder->context;
    mor_sweep_table_clear(context, &b->table);
    mor_sweep_design_clear(context, &b->design);
    mor_sweep_clear(context, &b->sweep);
    mor_units_free(context, &b->units);
}

static char *load(bench *b, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(run_folder_file(b->folder, path, name), &n_bytes);
    assert_non_null(text);
    return text;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static const char *skip_value(const char *at);

static const char *skip_blanks(const char *at)
{
    return at + strspn(at, " \n");
}

static const char *skip_text(const char *at)
{
    assert_int_equal(*at, '"');
    for (++at; *at != '"'; ++at) {
        assert_true((unsigned char)*at >= 0x20);
        if (*at == '\\') {
            ++at;
            assert_non_null(strchr("\"\\u", *at));
            at += *at == 'u' ? 4 : 0;
        }
    }
    return at + 1;
}

static const char *skip_members(const char *at, char end, bool has_names)
{
    at = skip_blanks(at + 1);
    while (*at != end) {
        if (has_names) {
            at = skip_blanks(skip_text(at));
            assert_int_equal(*at, ':');
            ++at;
        }
        at = skip_blanks(skip_value(skip_blanks(at)));
        assert_true(*at == ',' || *at == end);
        if (*at == ',') {
            at = skip_blanks(at + 1);
            assert_int_not_equal(*at, end);
        }
    }
    return at + 1;
}

/* The grammar of RFC 8259, as far as sweep.json uses it. */
static const char *skip_value(const char *at)
{
    if (*at == '{') {
        return skip_members(at, '}', true);
    }
    if (*at == '[') {
        return skip_members(at, ']', false);
    }
    if (*at == '"') {
        return skip_text(at);
    }
    if (strncmp(at, "null", 4) == 0) {
        return at + 4;
    }
    char *end = NULL;
    assert_true(isdigit((unsigned char)*at) || (*at == '-' && isdigit((unsigned char)at[1])));
    assert_true(isfinite(strtod(at, &end)));
    return end;
}

static void summary_is_json_and_tells_who_failed(void **state)
{
    bench b;
    make(&b, *state);
    fill(&b);
    assert_int_equal(mor_sweep_write_summary(&b.folder->context, &b.table, &b.provenance, &warned, b.folder->path),
                     MOR_OK);
    char *text = load(&b, MOR_SWEEP_SUMMARY_FILE);
    assert_string_equal(skip_blanks(skip_value(skip_blanks(text))), "");
    assert_non_null(strstr(text, "\"members\": 6, \"used\": 5, \"failed\": 1, \"missed_expectations\": 1"));
    assert_non_null(
        strstr(text, "\"member\": \"005\", \"reason\": \"x.cfg:3: found \\\"a\\\", or b\\u000aand\\u0009c\""));
    assert_non_null(strstr(text, "a \\\"title\\\", with \\\\ and ? and \xc3\xa9"));
    assert_non_null(strstr(text, "\"standard_deviation\": null")); /* one value */
    assert_non_null(strstr(text, "{\"text\": \"soil \\\"a\\\" moves\", \"members\": 9, \"first\": \"001\"}"));
    free(text);
    clear(&b);
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static void statistics_use_members_with_a_result_alone(void **state)
{
    bench b;
    make(&b, *state);
    fill(&b);
    mor_sweep_statistics it;
    mor_sweep_probability found;
    mor_sweep_table_evaluate(&b.table, 0, 0, &it);
    assert_true(it.n == 3 && it.mean == 2.0 && it.deviation == 1.0 && it.quantiles[1] == 2.0);
    mor_sweep_table_evaluate(&b.table, 1, 0, &it);
    assert_true(it.n == 1 && it.mean == 4.0 && isnan(it.deviation));
    mor_sweep_table_exceed(&b.table, 0, 0, &found);
    assert_true(found.n == 3 && found.n_hits == 0 && found.share == 0.0); /* 3 is not above 3 */
    mor_sweep_table_exceed(&b.table, 1, 0, &found);
    assert_true(found.n == 2 && found.n_hits == 1 && found.n_absent == 1);
    /* A result that stands in a table is used only if its member has ended well. */
    b.table.outcomes[3].state = MOR_SWEEP_STATE_INTERRUPTED;
    mor_sweep_table_evaluate(&b.table, 1, 0, &it);
    assert_true(it.n == 0 && isnan(it.mean));
    mor_sweep_table_exceed(&b.table, 1, 0, &found);
    assert_true(found.n == 1 && found.n_hits == 0 && found.share == 0.0);
    /* A case without the probe says nothing of the question. */
    b.table.has_probe[5] = false;
    mor_sweep_table_exceed(&b.table, 1, 0, &found);
    assert_true(found.n == 0 && found.n_absent == 0 && isnan(found.share) && isnan(found.low));
    clear(&b);
}

/* Of the members of a group, some of which had nothing to measure, each counts as the sweep says. */
static void absent_members_count_as_it_is_said(void **state)
{
    static const struct {
        mor_sweep_absent absent;
        bool is_below;
        int n, n_hits;
        double share;
    } ways[] = {{MOR_SWEEP_ABSENT_MISS, false, 2, 1, 0.5},     {MOR_SWEEP_ABSENT_HIT, false, 2, 2, 1.0},
                {MOR_SWEEP_ABSENT_LEFT_OUT, false, 1, 1, 1.0}, {MOR_SWEEP_ABSENT_MISS, true, 2, 0, 0.0},
                {MOR_SWEEP_ABSENT_HIT, true, 2, 1, 0.5},       {MOR_SWEEP_ABSENT_LEFT_OUT, true, 1, 0, 0.0},
                {MOR_SWEEP_ABSENT_UNKNOWN, true, 1, 0, NAN}};
    bench b;
    mor_sweep_probability it;
    make(&b, *state);
    fill(&b);
    assert_true(b.sweep.exceed[0].absent == MOR_SWEEP_ABSENT_MISS); /* what never came is not above */
    assert_int_equal(mor_sweep_table_count_absent(&b.table, 0, 0), 0);
    assert_int_equal(mor_sweep_table_count_absent(&b.table, 1, 0), 1);
    for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
        b.sweep.exceed[0].absent = ways[k].absent;
        b.sweep.exceed[0].is_below = ways[k].is_below;
        mor_sweep_table_exceed(&b.table, 1, 0, &it); /* 4, failed, and absent; against 3 */
        assert_int_equal(it.n, ways[k].n);
        assert_int_equal(it.n_hits, ways[k].n_hits);
        assert_int_equal(it.n_absent, 1);
        assert_true(isnan(ways[k].share) ? isnan(it.share) && isnan(it.low) && isnan(it.high)
                                         : it.share == ways[k].share && it.low <= it.share && it.high >= it.share);
        mor_sweep_table_exceed(&b.table, 0, 0, &it); /* nothing is absent, so that nothing need be said */
        assert_true(it.n == 3 && it.n_absent == 0 && isfinite(it.share));
    }
    clear(&b);
}

/* Lines of a table outside of quotes, and the separators of each, which must be as many in all. */
static int count_lines(const char *text, int *n_separators)
{
    bool is_quoted = false;
    int n_lines = 0;
    int n = 0;
    *n_separators = -1;
    for (; *text != '\0'; ++text) {
        is_quoted = *text == '"' ? !is_quoted : is_quoted;
        n += *text == ',' && !is_quoted;
        if (*text == '\n') {
            assert_false(is_quoted); /* one line for each member, for tools that read by lines */
            assert_true(*n_separators < 0 || *n_separators == n);
            *n_separators = n;
            n = 0;
            ++n_lines;
        }
    }
    return n_lines;
}

static void tables_have_a_cell_for_each_head(void **state)
{
    bench b;
    int n = 0;
    make(&b, *state);
    fill(&b);
    assert_int_equal(mor_sweep_write_members(&b.folder->context, &b.table, &b.provenance, b.folder->path), MOR_OK);
    assert_int_equal(mor_sweep_write_statistics(&b.folder->context, &b.table, b.folder->path), MOR_OK);
    char *text = load(&b, MOR_SWEEP_MEMBERS_FILE);
    assert_int_equal(count_lines(text, &n), 7);
    assert_non_null(
        strstr(text, "member,content [%],packing,state,missed_expectations,warnings,run_out [m],reason,command"));
    assert_non_null(strstr(text, ",failed,0,0,,\"x.cfg:3: found \"\"a\"\", or b and\tc\","));
    free(text);
    text = load(&b, MOR_SWEEP_STATISTICS_FILE);
    assert_int_equal(count_lines(text, &n), 3);
    assert_non_null(strstr(text, "\n10,run_out,m,3,0,1,3,0,2,1,"));
    assert_non_null(strstr(text, "\n20,run_out,m,3,1,0,1,1,4,,,,,,,4,4\n"));
    free(text);
    text = load(&b, MOR_SWEEP_EXCEED_FILE);
    assert_int_equal(count_lines(text, &n), 3);
    assert_non_null(strstr(text, "\n20,run_out,above,3,m,3,1,2,1,miss,1,0.5,"));
    free(text);
    clear(&b);
}

/* What is printed, to be freed. */
static char *report(bench *b)
{
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    assert_int_equal(mor_sweep_write_report(&b->folder->context, &b->table, &b->provenance, &warned, stream), MOR_OK);
    fclose(stream);
    return text;
}

/* An interval of no width looks like certainty; replicates that change nothing are told. */
static void report_tells_groups_whose_members_are_all_alike(void **state)
{
    bench b;
    make(&b, *state);
    fill(&b);
    char *text = report(&b);
    assert_null(strstr(text, "the same number")); /* one value alone is no repetition */
    free(text);
    b.table.values[1] = b.table.values[2] = b.table.values[0];
    text = report(&b);
    assert_non_null(strstr(text, "in 1 group all members gave the same number: what varies within has no effect on"));
    free(text);
    clear(&b);
}

static void report_tells_that_nothing_is_random(void **state)
{
    bench b;
    make(&b, *state);
    fill(&b);
    char *text = report(&b);
    assert_null(strstr(text, "nothing in this sweep is random"));
    free(text);
    b.sweep.variables[1].is_replicate = false;
    text = report(&b);
    assert_non_null(strstr(text, "nothing in this sweep is random"));
    free(text);
    clear(&b);
}

static void report_tells_what_members_warned_of(void **state)
{
    bench b;
    make(&b, *state);
    fill(&b);
    char *text = report(&b);
    assert_non_null(strstr(text, "\n9 members (001, 002, 003, 004, 005, 006, 007, 008, ...): soil \"a\" moves\n"));
    free(text);
    clear(&b);
}

/* Words of a command are quoted as a shell needs it. */
static void commands_are_quoted_for_a_shell(void **state)
{
    bench b;
    char *text = NULL;
    size_t n_bytes = 0;
    make(&b, *state);
    b.sweep.overrides = (const char *const[]){"title=it's", "a=1"};
    b.sweep.n_overrides = 2;
    snprintf(b.sweep.path, sizeof b.sweep.path, "my cases/sweep.cfg");
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_int_equal(mor_sweep_write_command(&b.folder->context, &b.design, &b.provenance, 5, stream), MOR_OK);
    fclose(stream);
    assert_string_equal(text, "run 'my cases/case.cfg' set 'title=it'\\''s' set a=1 set 'content=20 %' set "
                              "'rocks[0].seed=3'");
    free(text);
    clear(&b);
}

/* Charts hold members and means; without two places on the axis there is none. */
static void charts_are_drawn_where_there_is_something_to_show(void **state)
{
    bench b;
    char path[MOR_PATH_BYTES];
    make(&b, *state);
    fill(&b);
    FILE *output = fopen(run_folder_file(b.folder, path, "printed.txt"), "w");
    assert_non_null(output);
    assert_int_equal(mkdir(run_folder_file(b.folder, path, "images"), 0700), 0);
    assert_int_equal(mor_sweep_charts_draw(&b.folder->context, &b.table, b.folder->path, output), MOR_OK);
    assert_int_equal(access(run_folder_file(b.folder, path, "images/run_out-over-content.png"), R_OK), 0);
    assert_int_not_equal(access(run_folder_file(b.folder, path, "images/run_out-over-packing.png"), F_OK), 0);
    assert_int_equal(remove(run_folder_file(b.folder, path, "images/run_out-over-content.png")), 0);
    b.table.values[3] = NAN; /* nothing is left in the second group */
    assert_int_equal(mor_sweep_charts_draw(&b.folder->context, &b.table, b.folder->path, output), MOR_OK);
    assert_int_not_equal(access(run_folder_file(b.folder, path, "images/run_out-over-content.png"), F_OK), 0);
    fclose(output);
    clear(&b);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(summary_is_json_and_tells_who_failed),
        WITH_FOLDER(statistics_use_members_with_a_result_alone),
        WITH_FOLDER(absent_members_count_as_it_is_said),
        WITH_FOLDER(tables_have_a_cell_for_each_head),
        WITH_FOLDER(report_tells_groups_whose_members_are_all_alike),
        WITH_FOLDER(report_tells_that_nothing_is_random),
        WITH_FOLDER(report_tells_what_members_warned_of),
        WITH_FOLDER(commands_are_quoted_for_a_shell),
        WITH_FOLDER(charts_are_drawn_where_there_is_something_to_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
