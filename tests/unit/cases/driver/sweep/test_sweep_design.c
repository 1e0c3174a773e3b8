/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_design.h"

#include "tests/common/near.h"

#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What a test works with. */
typedef struct bench {
    mor_context context;
    mor_units *units;
    mor_sweep sweep;
    mor_sweep_design design;
    mor_sweep_settings settings;
} bench;

static int set_up(void **state)
{
    bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    mor_context_init(&b->context);
    assert_int_equal(mor_units_new(&b->context, &b->units), MOR_OK);
    *state = b;
    return 0;
}

static int tear_down(void **state)
{
    bench *b = *state;
    mor_sweep_design_clear(&b->context, &b->design);
    mor_sweep_clear(&b->context, &b->sweep);
    mor_units_free(&b->context, &b->units);
    const size_t n_bytes_left = b->context.memory_bytes;
    free(b);
    return n_bytes_left == 0 ? 0 : -1;
}

/* Reads a sweep, with ' in place of ". */
static mor_status read_text(bench *b, const char *source)
{
    char text[4096];
    const size_t n = strlen(source);
    assert_true(n < sizeof text);
    for (size_t k = 0; k < n; ++k) {
        text[k] = source[k] == '\'' ? '"' : source[k];
    }
    const mor_sweep_text given = {.name = "a/sweep.cfg", .text = text, .n_bytes = (int64_t)n, .units = b->units};
    return mor_sweep_read_text(&b->context, &given, &b->sweep);
}

static void make(bench *b, const char *source)
{
    if (read_text(b, source) != MOR_OK || mor_sweep_design_make(&b->context, &b->sweep, &b->design) != MOR_OK) {
        fail_msg("%s", b->context.message);
    }
}

/* The settings of a member as one text. */
static void expect_settings(bench *b, int member, const char *expected)
{
    char text[1024] = "";
    mor_sweep_design_settings(&b->design, b->units, member, &b->settings);
    for (int k = 0; k < b->settings.n; ++k) {
        strcat(text, k > 0 ? " | " : "");
        strcat(text, b->settings.texts[k]);
    }
    assert_string_equal(text, expected);
}

/* All combinations, the first variable slowest; values keep their units; each setting is what a command would take. */
static void members_are_all_combinations(void **state)
{
    bench *b = *state;
    make(b, "case = 'case.cfg'; set = ( 'spacing=1 m' );"
            "vary = ( { key = 'rocks[0].content'; values = ( 0.1, '20 %', 0.3 ); },"
            "         { key = 'rocks[0].seed'; from = 1; to = 2; replicates = true; },"
            "         { key = 'gravity'; values = ( ('0 m/s2', '-9.81 m/s2'), (0, -5) ); } );");
    assert_int_equal(b->design.n_members, 12);
    assert_int_equal(b->design.n_groups, 6);
    expect_settings(b, 0,
                    "spacing=1 m | rocks[0].content=0.1 | rocks[0].seed=1 | gravity=(\"0 m/s2\", \"-9.81 m/s2\")");
    expect_settings(b, 1, "spacing=1 m | rocks[0].content=0.1 | rocks[0].seed=1 | gravity=(0, -5)");
    expect_settings(b, 2,
                    "spacing=1 m | rocks[0].content=0.1 | rocks[0].seed=2 | gravity=(\"0 m/s2\", \"-9.81 m/s2\")");
    expect_settings(b, 11, "spacing=1 m | rocks[0].content=0.3 | rocks[0].seed=2 | gravity=(0, -5)");
    for (int m = 0; m < 12; ++m) {
        assert_int_equal(b->design.groups[m], 2 * (m / 4) + m % 2);
    }
    /* Numbers are told in the unit of the first that has one. */
    assert_string_equal(b->sweep.variables[0].unit, "%");
    assert_near(mor_sweep_design_value(&b->design, 0, 0), 10.0, 1e-14); /* a rounding error */
    assert_near(mor_sweep_design_value(&b->design, 4, 0), 20.0, 0.0);
    assert_true(isnan(mor_sweep_design_value(&b->design, 0, 2)));
}

static void ranges_end_at_their_end(void **state)
{
    bench *b = *state;
    make(b, "case = 'case.cfg'; vary = ( { key = 'a'; from = '10 deg'; to = '0.523598775598 rad'; step = '5 deg'; },"
            "                            { key = 'b'; from = 0.1; to = 0.5; step = 0.1; } );");
    assert_int_equal(b->sweep.variables[0].n_choices, 5); /* 30 degrees, to twelve digits */
    assert_int_equal(b->sweep.variables[1].n_choices, 5); /* rounding of 0.1 loses none */
    expect_settings(b, 2, "a=10 deg | b=0.3");
    expect_settings(b, 24, "a=30 deg | b=0.5");
}

/* Numbers of more than 32 bits carry the L that a case needs, and all their digits. */
static void large_whole_numbers_keep_their_digits(void **state)
{
    bench *b = *state;
    make(b, "case = 'c.cfg'; vary = ( { name = 'a'; key = 'x'; values = ( 2147483647, 3000000000L ); },"
            "  { name = 'b'; key = 'y'; from = 20261128000001L; to = 20261128000003L; step = 2; } );");
    expect_settings(b, 0, "x=2147483647 | y=20261128000001L");
    expect_settings(b, 3, "x=3000000000L | y=20261128000003L");
}

/* A choice takes other variables away, sets several keys, and may have a case of its own. */
static void choices_leave_out_what_has_no_meaning_with_them(void **state)
{
    bench *b = *state;
    char label[MOR_SWEEP_LABEL_BYTES];
    make(b, "case = 'case.cfg'; vary = ("
            "{ name = 'content'; choices = ("
            "    { label = 'none'; value = '0 %'; case = 'soil.cfg'; without = ('friction', 'seed'); },"
            "    { label = 'some'; value = 0.2; set = ( 'a=1', 'b=\\\"2 m\\\"' ); } ); },"
            "{ name = 'friction'; choices = ( { label = 'rough'; set = ( 'f=rough' ); },"
            "                                 { label = '1'; set = ( 'f=coulomb', 'c=1' ); } ); },"
            "{ key = 'rocks[0].seed'; from = 1; to = 3; replicates = true; } );");
    assert_int_equal(b->design.n_members, 7);
    assert_int_equal(b->design.n_groups, 3);
    expect_settings(b, 0, "");
    expect_settings(b, 6, "a=1 | b=\"2 m\" | f=coulomb | c=1 | rocks[0].seed=3");
    assert_string_equal(mor_sweep_design_case(&b->design, 0), "soil.cfg");
    assert_string_equal(mor_sweep_design_case(&b->design, 1), "case.cfg");
    mor_sweep_design_label(&b->design, 0, 1, label);
    assert_string_equal(label, "");
    mor_sweep_design_describe(&b->design, 2, 0u, label, sizeof label);
    assert_string_equal(label, "content some, friction 1");
    assert_near(mor_sweep_design_value(&b->design, 1, 0), 20.0, 1e-14);
}

/* Every combination has the same samples, each stratum one; the sample that a setting tells is the one tabulated. */
static void combinations_share_their_latin_hypercube(void **state)
{
    enum { N = 10 };
    bench *b = *state;
    make(b, "case = 'case.cfg'; members = 10; seed = 5; vary = ("
            "{ key = 'phi'; distribution = 'normal'; mean = '25 deg'; deviation = '2 deg'; min = '20 deg'; },"
            "{ key = 'n'; values = ( 1, 2 ); },"
            "{ key = 'c'; distribution = 'uniform'; min = 1; max = 3; } );");
    assert_int_equal(b->design.n_members, 2 * N);
    assert_int_equal(b->design.n_groups, 2);
    int strata[N] = {0};
    for (int m = 0; m < N; ++m) {
        double written = NAN;
        const double c = mor_sweep_design_value(&b->design, m, 2);
        assert_true(mor_sweep_design_value(&b->design, m, 0) == mor_sweep_design_value(&b->design, m + N, 0));
        assert_true(c == mor_sweep_design_value(&b->design, m + N, 2));
        strata[(int)((c - 1.0) / 2.0 * N)] += 1;
        mor_sweep_design_settings(&b->design, b->units, m, &b->settings);
        assert_int_equal(b->settings.n, 3);
        assert_int_equal(sscanf(b->settings.texts[0], "phi=%lf deg", &written), 1);
        assert_true(written == mor_sweep_design_value(&b->design, m, 0) && written >= 20.0);
    }
    for (int k = 0; k < N; ++k) {
        assert_int_equal(strata[k], 1);
    }
}

/* Each of the strata of a group, as many as it has members, has one value: no two members repeat a draw. */
static void expect_strata(const bench *b, int group, int variable, int n)
{
    int strata[64] = {0};
    int n_found = 0;
    for (int m = 0; m < b->design.n_members; ++m) {
        if (b->design.groups[m] == group) {
            strata[(int)((mor_sweep_design_value(&b->design, m, variable) - 1.0) / 2.0 * n)] += 1;
            ++n_found;
        }
    }
    assert_int_equal(n_found, n);
    for (int k = 0; k < n; ++k) {
        assert_int_equal(strata[k], 1);
    }
}

/* Members of a group are independent draws, as the intervals take them for: replicates repeat none. */
static void replicates_have_draws_of_their_own(void **state)
{
    enum { N = 5, N_SEEDS = 4 };
    bench *b = *state;
    make(b, "case = 'case.cfg'; members = 5; vary = ("
            "{ key = 'seed'; from = 1; to = 4; replicates = true; },"
            "{ key = 'c'; distribution = 'uniform'; min = 1; max = 3; },"
            "{ name = 'x'; choices = ( { label = 'k'; }, { label = 'l'; } ); },"
            "{ key = 'd'; distribution = 'uniform'; min = 1; max = 3; } );");
    assert_int_equal(b->design.n_members, 2 * N * N_SEEDS);
    assert_int_equal(b->design.n_groups, 2);
    for (int group = 0; group < 2; ++group) {
        expect_strata(b, group, 1, N * N_SEEDS);
        expect_strata(b, group, 3, N * N_SEEDS);
    }
    for (int m = 0; m < b->design.n_members; ++m) { /* and the other group has the same ones */
        const int other = m / N % 2 == 0 ? m + N : m - N;
        assert_true(mor_sweep_design_value(&b->design, m, 1) == mor_sweep_design_value(&b->design, other, 1));
    }
}

/* A group without the replicates has a hypercube of its own size; a member without the distribution has no draw. */
static void draws_are_over_the_members_that_have_them(void **state)
{
    bench *b = *state;
    make(b, "case = 'case.cfg'; members = 5; vary = ("
            "{ name = 'x'; choices = ( { label = 'k'; }, { label = 'l'; without = ('seed'); } ); },"
            "{ name = 'seed'; choices = ( { label = '1'; }, { label = '2'; }, { label = '3'; without = ('c'); } );"
            "  replicates = true; },"
            "{ key = 'c'; distribution = 'uniform'; min = 1; max = 3; } );");
    assert_int_equal(b->design.n_members, 2 * 5 + 1 + 5);
    assert_int_equal(b->design.n_groups, 2);
    assert_true(isnan(mor_sweep_design_value(&b->design, 10, 2)));
    b->design.groups[10] = -1; /* the others of its group have ten strata */
    expect_strata(b, 0, 2, 10);
    expect_strata(b, 1, 2, 5);
}

/* What never came is not above a threshold; whether it is below is for the user to say. */
static void absent_is_a_miss_above_and_unknown_below(void **state)
{
    bench *b = *state;
    assert_int_equal(read_text(b, "case = 'c'; vary = ( { key = 'a'; values = (1); } );"
                                  "exceed = ( { probe = 'p'; above = 1; absent = 'hits'; } );"),
                     MOR_ERROR_CONFIG);
    assert_non_null(strstr(b->context.message, "did you mean 'hit'?"));
    make(b, "case = 'c'; vary = ( { key = 'a'; values = (1); } );"
            "exceed = ( { probe = 'p'; above = 1; }, { probe = 'p'; below = 1; },"
            "  { probe = 'p'; above = 1; absent = 'left_out'; }, { probe = 'p'; below = 1; absent = 'miss'; },"
            "  { probe = 'p'; statistic = 'maximum'; below = 1; absent = 'hit'; } );");
    static const mor_sweep_absent expected[] = {MOR_SWEEP_ABSENT_MISS, MOR_SWEEP_ABSENT_UNKNOWN,
                                                MOR_SWEEP_ABSENT_LEFT_OUT, MOR_SWEEP_ABSENT_MISS, MOR_SWEEP_ABSENT_HIT};
    assert_int_equal(b->sweep.n_exceed, 5);
    for (int k = 0; k < 5; ++k) {
        assert_int_equal(b->sweep.exceed[k].absent, expected[k]);
        assert_string_equal(b->sweep.exceed[k].measure.probe, "p");
    }
    assert_int_equal(b->sweep.exceed[4].measure.statistic, MOR_CASE_STATISTIC_MAXIMUM);
}

/* What is wrong is told with file and line, and with what is allowed. */
static void wrong_files_are_refused_with_a_reason(void **state)
{
    static const struct {
        const char *text, *part;
    } wrong[] = {
        {"vary = ( { key = 'a'; values = (1); } );", "found no 'case'"},
        {"case = 'c';\nvary = ();", "sweep.cfg:2: found vary ="},
        {"case = 'c';\nvari = ( { key = 'a'; values = (1); } );", "did you mean 'vary'?"},
        {"case = 'c'; vary = ( { key = 'a'; } );", "takes no values"},
        {"case = 'c'; vary = ( { values = (1); } );", "without a 'name'"},
        {"case = 'c'; vary = ( { name = 'x'; values = (1); } );", "no 'key'"},
        {"case = 'c'; vary = ( { key = 'a=1'; values = (1); } );", "without '='"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); to = 3; } );", "found 'to' beside values"},
        {"case = 'c'; vary = ( { key = 'a'; values = ( '1 m', '2 s' ); } );", "units of one kind"},
        {"case = 'c'; vary = ( { key = 'a'; values = ( { b = 1; } ); } );", "found a group"},
        {"case = 'c'; vary = ( { key = 'a'; from = 3; to = 1; } );", "from <= to"},
        {"case = 'c'; vary = ( { key = 'a'; from = 1; to = 3000; } );", "found 3000 values"},
        {"case = 'c'; vary = ( { key = 'a'; from = '1 m'; to = 3; } );", "beside a number in m"},
        {"case = 'c'; vary = ( { key = 'a'; from = 'x'; to = 3; } );", "no number with a unit"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); }, { key = 'a'; name = 'b'; values = (1); } );",
         "varies already"},
        {"case = 'c'; vary = ( { key = 'x.a'; values = (1); }, { key = 'y.a'; values = (1); } );", "another 'name'"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'a'; }, { label = 'a'; } ); } );",
         "the label 'a' twice"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'a'; without = ('x'); } ); } );", "stands later"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'a'; set = ('b'); } ); } );", "\"key=value\""},
        {"case = 'c'; vary = ( { key = 'a'; values = ('1 kPa', 4); } );", "a bare number in the values of 'a'"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; values = (1); } );", "no distribution"},
        {"case = 'c'; vary = ( { key = 'a'; distribution = 'uniform'; min = 1; max = 2; } );", "no 'members'"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'gauss'; } );", "triangular"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'normal'; mean = 1; } );", "no 'deviation'"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'normal'; mean = 1; deviation = 0; } );",
         "not above zero"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'normal'; mean = 1; deviation = 1;"
         " min = 20; } );",
         "a millionth"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'uniform'; min = 2; max = 1; } );",
         "not below its max"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'triangular'; min = 1; max = 2; mode = 3; } );",
         "mode lies outside"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'uniform'; min = 1; max = 2; mode = 1; } );",
         "also 'mode'"},
        {"case = 'c'; members = 3; vary = ( { key = 'a'; distribution = 'lognormal'; mean = -1; deviation = 1; } );",
         "lognormal variable"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); } ); exceed = ( { probe = 'p'; } );", "neither above"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); } ); exceed = ( { probe = 'p'; above = 1; below = 2; } );",
         "both above"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); } ); results = ( { probe = 'p'; }, { probe = 'p'; } );",
         "twice"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1); } ); results = ( { probe = 'p'; statistic = 'largest'; } );",
         "maximum"}};
    bench *b = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        assert_int_equal(read_text(b, wrong[k].text), MOR_ERROR_CONFIG);
        if (strstr(b->context.message, wrong[k].part) == NULL || strncmp(b->context.message, "a/sweep.cfg:", 12) != 0) {
            fail_msg("'%s' is refused with '%s', which does not hold '%s'", wrong[k].text, b->context.message,
                     wrong[k].part);
        }
    }
}

/* Of two settings of one key the later would count, unseen. */
static void keys_that_are_set_twice_are_refused(void **state)
{
    static const struct {
        const char *text, *override, *part;
    } wrong[] = {
        {"case = 'c'; set = ( 'a = 1' ); vary = ( { key = 'a'; values = (1, 2); } );", NULL, "'a = 1' for all members"},
        {"case = 'c'; vary = ( { key = 'a'; values = (1, 2); } );", "a=3", "'a=3' as an override"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; set = ('a=1'); } ); } );", "a=3",
         "'a=3' as an override"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; set = ('a=1'); } ); },"
         "                     { key = 'a'; values = (1); } );",
         NULL, "'a=1' of another variable"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; set = ('a=1'); } ); },"
         "                     { name = 'y'; choices = ( { label = 'l'; set = ('b=1', 'a=2'); } ); } );",
         NULL, "'a=1' of another variable"},
        /* A key holds those below it, and its entries, whichever comes first; [0] and [00] are one entry. */
        {"case = 'c'; vary = ( { key = 's[0].m.d'; values = (1); },"
         "  { name = 'y'; choices = ( { label = 'l'; set = ('s[0].m={ d=2; }'); } ); } );",
         NULL, "'y' that sets 's[0].m', which is also set by 's[0].m.d' of another variable"},
        {"case = 'c'; vary = ( { key = 'g'; values = ((0, 1)); }, { key = 'g[1]'; name = 'y'; values = (2); } );", NULL,
         "'y' that sets 'g[1]', which is also set by 'g' of another variable"},
        {"case = 'c'; vary = ( { key = 's[0].a'; values = (1); }, { key = 's[00].a'; name = 'y'; values = (2); } );",
         NULL, "'y' that sets 's[00].a', which is also set by 's[0].a' of another variable"},
        {"case = 'c'; vary = ( { key = 's[0].m'; values = (1); } );", "s[0].m.d=3",
         "'m' that sets 's[0].m', which is also set by 's[0].m.d=3' as an override"},
        {"case = 'c'; vary = ( { key = 's[0].m.d'; values = (1); } );", "s[0].m={ d=3; }",
         "'d' that sets 's[0].m.d', which is also set by 's[0].m={ d=3; }' as an override"},
        {"case = 'c'; set = ('s[0].m.d=3'); vary = ( { key = 's[0].m'; values = (1); } );", NULL,
         "'m' that sets 's[0].m', which is also set by 's[0].m.d=3' for all members"},
        {"case = 'c'; set = ('s[0].m.d=3'); vary = ( { name = 'x'; choices = ("
         "  { label = 'l'; set = ('s[0].m={ e=2; }'); } ); } );",
         NULL, "'x' that sets 's[0].m', which is also set by 's[0].m.d=3' for all members"},
        /* Within one list. */
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; set = ('a=1', 'b=1', 'a=2'); } ); } );", NULL,
         "'x' that sets 'a', which is also set by 'a=1' of the same choice 'l'"},
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; set = ('m.d=1', 'm={ e=1; }'); } ); } );", NULL,
         "'x' that sets 'm', which is also set by 'm.d=1' of the same choice 'l'"},
        {"case = 'c'; set = ('m.d=1', 'm.d=2'); vary = ( { key = 'a'; values = (1); } );", NULL,
         "a/sweep.cfg: found 'm.d', which is set twice for all members, by 'm.d=1', too"},
        /* Of two cases the later would be run. */
        {"case = 'c'; vary = ( { name = 'x'; choices = ( { label = 'l'; }, { label = 'm'; case = 'd'; } ); },"
         "                     { name = 'y'; choices = ( { label = 'n'; case = 'e'; } ); } );",
         NULL, "'y' with the case 'e' beside the case 'd' of the variable 'x'"}};
    bench *b = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        assert_int_equal(read_text(b, wrong[k].text), MOR_OK);
        b->sweep.overrides = &wrong[k].override;
        b->sweep.n_overrides = wrong[k].override != NULL;
        assert_int_equal(mor_sweep_design_make(&b->context, &b->sweep, &b->design), MOR_ERROR_CONFIG);
        if (strstr(b->context.message, wrong[k].part) == NULL) {
            fail_msg("'%s' does not hold '%s'", b->context.message, wrong[k].part);
        }
        mor_sweep_design_clear(&b->context, &b->design);
        mor_sweep_clear(&b->context, &b->sweep);
    }
}

/* A choice may differ from what is set for all; overrides come between the two. */
static void choice_may_set_anew_what_is_set_for_all(void **state)
{
    bench *b = *state;
    assert_int_equal(
        read_text(b, "case = 'c'; set = ( 'a=1', 'd=1' ); vary = ( { name = 'x'; choices = ("
                     "{ label = 'l'; }, { label = 'm'; set = ('a=2'); } ); }, { key = 'c.a'; values = (1); } );"),
        MOR_OK);
    b->sweep.overrides = (const char *const[]){"d=2"};
    b->sweep.n_overrides = 1;
    assert_int_equal(mor_sweep_design_make(&b->context, &b->sweep, &b->design), MOR_OK);
    expect_settings(b, 1, "a=1 | d=1 | d=2 | a=2 | c.a=1");
}

/* Names that begin alike are two keys; a part of what is set for all may vary; cases that exclude each other may. */
static void keys_that_have_an_effect_each_are_taken(void **state)
{
    bench *b = *state;
    make(b, "case = 'c'; set = ( 'soil[0].m={ d=1; e=2; }' );"
            "vary = ( { key = 'soil[0].m.d'; values = (1); }, { key = 'soil[0].md'; values = (1); },"
            "  { key = 'soil[1].m'; values = (1); }, { key = 'soil[10].m'; name = 'n'; values = (1); },"
            "  { name = 'x'; choices = ( { label = 'k'; set = ('b=1', 'bc=1'); },"
            "                            { label = 'l'; case = 'd'; without = ('y'); } ); },"
            "  { name = 'y'; choices = ( { label = 'm'; case = 'e'; } ); } );");
    assert_int_equal(b->design.n_members, 2);
    assert_string_equal(mor_sweep_design_case(&b->design, 0), "e");
    assert_string_equal(mor_sweep_design_case(&b->design, 1), "d");
}

static void too_many_members_are_refused(void **state)
{
    bench *b = *state;
    assert_int_equal(read_text(b, "case = 'c'; vary = ( { key = 'a'; from = 1; to = 200; },"
                                  "{ key = 'b'; from = 1; to = 100; } );"),
                     MOR_OK);
    assert_int_equal(mor_sweep_design_make(&b->context, &b->sweep, &b->design), MOR_ERROR_CONFIG);
    assert_non_null(strstr(b->context.message, "more than 10000 members"));
}

#define WITH_BENCH(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_BENCH(members_are_all_combinations),
        WITH_BENCH(large_whole_numbers_keep_their_digits),
        WITH_BENCH(ranges_end_at_their_end),
        WITH_BENCH(choices_leave_out_what_has_no_meaning_with_them),
        WITH_BENCH(combinations_share_their_latin_hypercube),
        WITH_BENCH(replicates_have_draws_of_their_own),
        WITH_BENCH(draws_are_over_the_members_that_have_them),
        WITH_BENCH(absent_is_a_miss_above_and_unknown_below),
        WITH_BENCH(wrong_files_are_refused_with_a_reason),
        WITH_BENCH(keys_that_are_set_twice_are_refused),
        WITH_BENCH(choice_may_set_anew_what_is_set_for_all),
        WITH_BENCH(keys_that_have_an_effect_each_are_taken),
        WITH_BENCH(too_many_members_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
