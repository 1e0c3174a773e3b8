/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Parameters of soil that vary in space: constant fields give the bits of soil without fields, layers by a formula
 * those of regions; values belong to places, whatever spacing and order; statistics are those prescribed; a resumed run
 * and a next stage keep them. */
#include "cases/moraine.h"
#include "tests/common/near.h"
#include "tests/common/run_folder.h"

#include <math.h>

enum { TEXT_BYTES = 4096, STEPS = 60 };

#define HEAD                                                                                                           \
    "title = \"fields\"; dimension = 2; gravity = (0, -9.81); end = 1;\n"                                              \
    "domain = { min = (-1, -1); max = (50, 20); };\n"                                                                  \
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; } );\n"
#define CLAY                                                                                                           \
    "material = { model = \"mohr_coulomb\"; density = 2000; youngs_modulus = 2e7; poissons_ratio = 0.3;\n"             \
    "             friction_angle = 0.3; cohesion = 4e3; };\n"

/* ---- Sessions ---------------------------------------------------------------------------------------------------- */

/* The particles of a soil, in the order of their numbers. */
typedef struct soil {
    int64_t n;
    double *position, *velocity, *stress; /* shape [n, 3], [n, 3], [n, 6] */
    double *cohesion, *friction;          /* shape [n]; NULL: it does not vary */
} soil;

static mor_session *open_session(void)
{
    mor_session *session = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, 1), MOR_OK);
    return session;
}

static mor_session *build(const char *text)
{
    mor_session *session = open_session();
    if (mor_session_load_text(session, "fields.cfg", text) != MOR_OK || mor_session_build(session) != MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    return session;
}

/* In the order of the particles' numbers; NULL where there is no such field. */
static double *read_field(mor_session *session, const char *name, int width, int64_t n)
{
    double *values = calloc((size_t)(n * width), sizeof *values);
    assert_non_null(values);
    if (mor_session_read_field(session, "soil", name, values, n * width) != MOR_OK) {
        free(values);
        return NULL;
    }
    return values;
}

static soil read_soil(mor_session *session)
{
    soil it = {.n = mor_session_n_particles(session, "soil")};
    it.position = read_field(session, "position", 3, it.n);
    it.velocity = read_field(session, "velocity", 3, it.n);
    it.stress = read_field(session, "stress", 6, it.n);
    it.cohesion = read_field(session, "cohesion", 1, it.n);
    it.friction = read_field(session, "friction_angle", 1, it.n);
    return it;
}

static void free_soil(soil *it)
{
    free(it->position);
    free(it->velocity);
    free(it->stress);
    free(it->cohesion);
    free(it->friction);
}

static soil start(const char *text)
{
    mor_session *session = build(text);
    const soil it = read_soil(session);
    mor_session_free(&session);
    return it;
}

static void take_steps(mor_session *session, int n)
{
    for (int k = 0; k < n; ++k) {
        if (mor_session_step(session) != MOR_OK) {
            fail_msg("%s", mor_session_message(session));
        }
    }
}

static soil step(const char *text)
{
    mor_session *session = build(text);
    assert_int_equal(mor_session_settle(session), MOR_OK);
    take_steps(session, STEPS);
    const soil it = read_soil(session);
    mor_session_free(&session);
    return it;
}

static void expect_same_motion(const soil *a, const soil *b)
{
    assert_int_equal(a->n, b->n);
    assert_memory_equal(a->position, b->position, (size_t)(3 * a->n) * sizeof(double));
    assert_memory_equal(a->velocity, b->velocity, (size_t)(3 * a->n) * sizeof(double));
    assert_memory_equal(a->stress, b->stress, (size_t)(6 * a->n) * sizeof(double));
}

/* ---- Bits -------------------------------------------------------------------------------------------------------- */

/* A column that yields: one region with some fields. */
static const char *column(const char *fields, char *text)
{
    snprintf(text, TEXT_BYTES,
             HEAD "spacing = 0.25;\n"
                  "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (4, 4); };\n" CLAY
                  "%s } );\n",
             fields);
    return text;
}

static void constant_fields_give_the_bits_of_soil_without_fields(void **state)
{
    static const char *const fields[] = {
        "fields = ( { parameter = \"cohesion\"; distribution = \"lognormal\"; coefficient_of_variation = 0;\n"
        "             correlation_length = (1, 1); },\n"
        "           { parameter = \"friction_angle\"; distribution = \"normal\"; standard_deviation = 0;\n"
        "             correlated_with = \"cohesion\"; cross_correlation = 0.5; } );",
        "fields = ( { parameter = \"friction_angle\"; formula = \"0.3\"; } );"};
    char text[TEXT_BYTES];
    (void)state;
    soil plain = step(column("", text));
    assert_null(plain.cohesion);
    for (int k = 0; k < 2; ++k) {
        soil constant = step(column(fields[k], text));
        expect_same_motion(&plain, &constant);
        free_soil(&constant);
    }
    soil other = step(column("fields = ( { parameter = \"friction_angle\"; formula = \"0.25\"; } );", text));
    assert_memory_not_equal(plain.stress, other.stress, (size_t)(6 * plain.n) * sizeof(double));
    free_soil(&other);
    free_soil(&plain);
}

static void layers_by_a_formula_are_regions_with_a_value_each(void **state)
{
    char text[TEXT_BYTES];
    (void)state;
    soil layers = step(column("fields = ( { parameter = \"cohesion\"; formula = \"y < 2 ? 5e3 : 1e3\"; } );", text));
    snprintf(text, sizeof text,
             HEAD "spacing = 0.25;\n"
                  "soil = ( { name = \"top\"; shape = { type = \"box\"; min = (0, 2); max = (4, 4); };\n" CLAY
                  "           fields = ( { parameter = \"cohesion\"; formula = \"1e3\"; } ); },\n"
                  "         { name = \"base\"; shape = { type = \"box\"; min = (0, 0); max = (4, 2); };\n" CLAY
                  "           fields = ( { parameter = \"cohesion\"; formula = \"5e3\"; } ); } );\n");
    soil regions = step(text);
    expect_same_motion(&layers, &regions);
    assert_memory_equal(layers.cohesion, regions.cohesion, (size_t)layers.n * sizeof(double));
    free_soil(&layers);
    free_soil(&regions);
}

static void soil_without_a_field_shows_its_constant_beside_one_with(void **state)
{
    char text[TEXT_BYTES];
    (void)state;
    snprintf(text, sizeof text,
             HEAD "spacing = 0.25;\n"
                  "soil = ( { name = \"top\"; shape = { type = \"box\"; min = (0, 2); max = (4, 4); };\n" CLAY " },\n"
                  "         { name = \"base\"; shape = { type = \"box\"; min = (0, 0); max = (4, 2); };\n" CLAY
                  "           fields = ( { parameter = \"cohesion\"; formula = \"5e3 + 100*x\"; } ); } );\n");
    soil both = step(text);
    for (int64_t i = 0; i < both.n; ++i) {
        const bool is_constant = both.cohesion[i] == 4e3; /* exact: copied */
        assert_true(is_constant || (both.cohesion[i] > 5e3 && both.cohesion[i] < 5.4e3));
    }
    free_soil(&both);
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

static const char *varied(double spacing, const char *shapes, char *text)
{
    snprintf(text, TEXT_BYTES, HEAD "spacing = %.17g; %s", spacing, shapes);
    return text;
}

#define RANDOM                                                                                                         \
    "fields = ( { parameter = \"cohesion\"; distribution = \"lognormal\"; coefficient_of_variation = 0.4;\n"           \
    "             correlation = \"squared_exponential\"; correlation_length = (1.5, 0.75); seed = 5; } );\n"

/* Of the particle nearest to a place. */
static double value_at(const soil *it, const double *place, double *distance)
{
    int64_t nearest = 0;
    *distance = INFINITY;
    for (int64_t i = 0; i < it->n; ++i) {
        const double d = hypot(it->position[3 * i] - place[0], it->position[3 * i + 1] - place[1]);
        nearest = d < *distance ? i : nearest;
        *distance = fmin(*distance, d);
    }
    return it->cohesion[nearest];
}

static void expect_same_values(const soil *coarse, const soil *fine, double tolerance)
{
    for (int64_t i = 0; i < coarse->n; ++i) {
        double distance = 0.0;
        const double value = value_at(fine, coarse->position + 3 * i, &distance);
        assert_true(distance < 1e-12);
        assert_near(value, coarse->cohesion[i], tolerance);
    }
}

static void values_belong_to_places_whatever_spacing_and_order(void **state)
{
    static const char whole[] =
        "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (3, 3); };\n" CLAY RANDOM " } );\n";
    static const char halves[] =
        "soil = ( { name = \"b\"; shape = { type = \"box\"; min = (1.5, 0); max = (3, 3); };\n" CLAY RANDOM " },\n"
        "         { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (1.5, 3); };\n" CLAY RANDOM " } );\n";
    char text[TEXT_BYTES];
    (void)state;
    soil coarse = start(varied(0.3, whole, text));
    soil fine = start(varied(0.1, whole, text)); /* every third particle of a row lies where a coarse one does */
    soil parts = start(varied(0.3, halves, text));
    assert_int_equal(fine.n, 9 * coarse.n);
    expect_same_values(&coarse, &fine, 1e-9 * 4e3); /* places differ by rounding, times the longest wave numbers */
    expect_same_values(&coarse, &parts, 1e-9 * 4e3);
    free_soil(&coarse);
    free_soil(&fine);
    free_soil(&parts);
}

/* ---- Stiffness --------------------------------------------------------------------------------------------------- */

/* Mean fall under its own weight of soil that cannot give way: the strain of a depth over all soil above it. */
static double find_settlement(double weight, double height, double below, double above)
{
    enum { PARTS = 1000 };
    const double confined = (1.0 - 0.3) / ((1.0 + 0.3) * (1.0 - 2.0 * 0.3)); /* oedometric over Young's modulus */
    double sum = 0.0;
    for (int k = 0; k < PARTS; ++k) {
        const double y = height * (k + 0.5) / PARTS;
        const double strain = weight * (height - y) / (confined * (y < 0.5 * height ? below : above));
        sum += strain * (height - y) / PARTS; /* it lowers all that is above */
    }
    return sum;
}

static double mean_height(mor_session *session)
{
    const int64_t n = mor_session_n_particles(session, "soil");
    double *position = read_field(session, "position", 3, n);
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        sum += position[3 * i + 1] / (double)n;
    }
    free(position);
    return sum;
}

static void a_column_of_two_stiffnesses_settles_by_both(void **state)
{
    static const char text[] =
        "title = \"column\"; dimension = 2; spacing = 0.2; gravity = (0, -9.81); end = 1;\n"
        "domain = { min = (-1, -1); max = (6, 8); };\n"
        "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (2, 4); };\n"
        "  material = { model = \"mohr_coulomb\"; density = 2000; youngs_modulus = 4e6; poissons_ratio = 0.3;\n"
        "               friction_angle = 0.3; cohesion = 1e6; };\n"
        "  fields = ( { parameter = \"youngs_modulus\"; formula = \"y < 2 ? 4e6 : 1e6\"; } );\n"
        "  initial_stress = { type = \"settled\"; settle_from = \"none\"; settle_time = 5; }; } );\n"
        "walls = ( { name = \"f\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); };\n"
        "            friction = \"smooth\"; },\n"
        "          { name = \"l\"; shape = { type = \"half_space\"; point = (0, 0); normal = (1, 0); };\n"
        "            friction = \"smooth\"; },\n"
        "          { name = \"r\"; shape = { type = \"half_space\"; point = (2, 0); normal = (-1, 0); };\n"
        "            friction = \"smooth\"; } );\n";
    (void)state;
    mor_session *session = build(text);
    const double before = mean_height(session);
    assert_int_equal(mor_session_settle(session), MOR_OK);
    const double found = before - mean_height(session);
    const double expected = find_settlement(2000.0 * 9.81, 4.0, 4e6, 1e6);
    assert_near(found, expected, 0.04 * expected); /* 2 % less were measured: strains reach 1.5 %, spacing of H / 20 */
    assert_true(found > 1.2 * find_settlement(2000.0 * 9.81, 4.0, 4e6, 4e6));
    mor_session_free(&session);
}

/* ---- Statistics -------------------------------------------------------------------------------------------------- */

/* 40 m by 10 m with correlation lengths of half a meter: 1600 independent samples. */
static const double sure = 4.0; /* standard errors */

static void the_particles_have_the_statistics_prescribed(void **state)
{
    enum { SAMPLES = 1600 };
    static const char shapes[] =
        "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (40, 10); };\n" CLAY
        "fields = ( { parameter = \"cohesion\"; distribution = \"lognormal\"; coefficient_of_variation = 0.3;\n"
        "             correlation = \"squared_exponential\"; correlation_length = (0.5, 0.5); seed = 2; },\n"
        "           { parameter = \"friction_angle\"; distribution = \"normal\"; standard_deviation = 0.02;\n"
        "             correlated_with = \"cohesion\"; cross_correlation = -0.5; } ); } );\n";
    char text[TEXT_BYTES];
    double sums[5] = {0.0};
    (void)state;
    soil it = start(varied(0.25, shapes, text));
    const double variance = log1p(0.09);
    for (int64_t i = 0; i < it.n; ++i) {
        const double normal = (log(it.cohesion[i] / 4e3) + 0.5 * variance) / sqrt(variance);
        const double other = (it.friction[i] - 0.3) / 0.02;
        sums[0] += it.cohesion[i] / 4e3 / (double)it.n;
        sums[1] += normal * normal / (double)it.n;
        sums[2] += other / (double)it.n;
        sums[3] += other * other / (double)it.n;
        sums[4] += normal * other / (double)it.n;
    }
    assert_near(sums[0], 1.0, sure * 0.3 / sqrt(SAMPLES));
    assert_near(sums[1], 1.0, sure * sqrt(2.0 / SAMPLES));
    assert_near(sums[2], 0.0, sure / sqrt(SAMPLES));
    assert_near(sums[3], 1.0, sure * sqrt(2.0 / SAMPLES));
    assert_near(sums[4], -0.5, sure * sqrt(1.25 / SAMPLES));
    free_soil(&it);
}

/* What the log said last. */
static void note_warning(void *user, mor_log_level level, const char *text)
{
    if (level == MOR_LOG_WARNING && strstr(text, "'cohesion'") != NULL) {
        snprintf(user, MOR_CONTEXT_MESSAGE_BYTES, "%s", text);
    }
}

/* A normal field of a coefficient of 1 is negative at 16 % of all places: none is kept, each is counted. */
static void clipped_values_are_counted_and_reported(void **state)
{
    static const char shapes[] =
        "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (20, 5); };\n" CLAY
        "fields = ( { parameter = \"cohesion\"; distribution = \"normal\"; coefficient_of_variation = 1.0;\n"
        "             correlation_length = (0.5, 0.5); maximum = 1e4; } ); } );\n";
    char text[TEXT_BYTES];
    char path[MOR_PATH_BYTES];
    char warning[MOR_CONTEXT_MESSAGE_BYTES] = "";
    run_folder *folder = *state;
    soil it = start(varied(0.25, shapes, text));
    int64_t n_low = 0;
    int64_t n_high = 0;
    for (int64_t i = 0; i < it.n; ++i) {
        assert_true(it.cohesion[i] >= 0.0 && it.cohesion[i] <= 1e4);
        n_low += it.cohesion[i] == 0.0;
        n_high += it.cohesion[i] == 1e4;
    }
    assert_near((double)n_low / (double)it.n, 0.1587, sure * sqrt(0.16 * 0.84 / 400.0)); /* 400 samples */
    FILE *nowhere = fopen("/dev/null", "w");
    mor_session_outcome outcome = MOR_SESSION_INTERRUPTED;
    mor_session *session = open_session();
    assert_non_null(nowhere);
    mor_session_set_output(session, nowhere);
    mor_session_set_log(session, note_warning, warning);
    run_folder_store(run_folder_file(folder, path, "clip.cfg"), text, strlen(text));
    assert_int_equal(mor_session_override(session, "end=1e-3"), MOR_OK);
    assert_int_equal(mor_session_override(session, "output.pictures=false"), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    assert_int_equal(mor_session_run(session, run_folder_file(folder, path, "clip"), false, NAN, &outcome), MOR_OK);
    assert_int_equal(outcome, MOR_SESSION_FINISHED);
    mor_session_free(&session);
    fclose(nowhere);
    char expected[64];
    snprintf(expected, sizeof expected, "of %lld values %lld (", (long long)it.n, (long long)n_low);
    assert_non_null(strstr(warning, expected));
    snprintf(expected, sizeof expected, "and %lld (", (long long)n_high);
    assert_non_null(strstr(warning, expected));
    free_soil(&it);
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static void a_resumed_session_has_the_same_bits(void **state)
{
    char text[TEXT_BYTES];
    char path[MOR_PATH_BYTES];
    run_folder *folder = *state;
    run_folder_file(folder, path, "saved");
    mor_session *whole = build(column(RANDOM, text));
    assert_int_equal(mor_session_settle(whole), MOR_OK);
    take_steps(whole, STEPS);
    assert_int_equal(mor_session_save(whole, path), MOR_OK);
    take_steps(whole, STEPS);
    mor_session *resumed = build(text);
    assert_int_equal(mor_session_resume(resumed, path), MOR_OK);
    take_steps(resumed, STEPS);
    assert_true(mor_session_state_hash(resumed) == mor_session_state_hash(whole));
    mor_session_free(&whole);
    mor_session_free(&resumed);
}

static void threads_change_no_bit(void **state)
{
    char text[TEXT_BYTES];
    uint64_t hashes[2];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        mor_session *session = open_session();
        assert_int_equal(mor_session_set_threads(session, 1 + k), MOR_OK);
        assert_int_equal(mor_session_load_text(session, "fields.cfg", column(RANDOM, text)), MOR_OK);
        assert_int_equal(mor_session_build(session), MOR_OK);
        assert_int_equal(mor_session_settle(session), MOR_OK);
        take_steps(session, STEPS);
        hashes[k] = mor_session_state_hash(session);
        mor_session_free(&session);
    }
    assert_true(hashes[0] == hashes[1]);
}

static void run(run_folder *folder, const char *name, const char *text)
{
    char path[MOR_PATH_BYTES];
    char file[64];
    FILE *nowhere = fopen("/dev/null", "w");
    mor_session_outcome outcome = MOR_SESSION_INTERRUPTED;
    mor_session *session = open_session();
    assert_non_null(nowhere);
    snprintf(file, sizeof file, "%s.cfg", name);
    run_folder_store(run_folder_file(folder, path, file), text, strlen(text));
    mor_session_set_output(session, nowhere);
    assert_int_equal(mor_session_override(session, "output.pictures=false"), MOR_OK);
    assert_int_equal(mor_session_override(session, "end=0.05"), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    assert_int_equal(mor_session_run(session, run_folder_file(folder, path, name), false, NAN, &outcome), MOR_OK);
    assert_int_equal(outcome, MOR_SESSION_FINISHED);
    mor_session_free(&session);
    fclose(nowhere);
}

static int compare_numbers(const void *a, const void *b)
{
    const double left = *(const double *)a;
    const double right = *(const double *)b;
    return (left > right) - (left < right);
}

/* Places of particles change, what they are made of does not, though the next stage asks for another seed. */
static void the_next_stage_keeps_what_particles_are_made_of(void **state)
{
    static const char other[] =
        "fields = ( { parameter = \"cohesion\"; distribution = \"lognormal\";\n"
        "             coefficient_of_variation = 0.1; correlation_length = (1, 1); seed = 9; } );";
    char text[TEXT_BYTES];
    char stage[2 * TEXT_BYTES];
    char path[MOR_PATH_BYTES];
    run_folder *folder = *state;
    soil before = start(column(RANDOM, text));
    run(folder, "ground", text);
    snprintf(stage, sizeof stage, "start_from = \"%s\";\n%s", run_folder_file(folder, path, "ground"),
             column(other, text));
    soil after = start(stage);
    assert_int_equal(after.n, before.n);
    qsort(before.cohesion, (size_t)before.n, sizeof(double), compare_numbers);
    qsort(after.cohesion, (size_t)after.n, sizeof(double), compare_numbers);
    assert_memory_equal(after.cohesion, before.cohesion, (size_t)before.n * sizeof(double)); /* exact: copied */
    /* Without a field they are lost, which is said. */
    char warning[MOR_CONTEXT_MESSAGE_BYTES] = "";
    mor_session *session = open_session();
    mor_session_set_log(session, note_warning, warning);
    snprintf(stage, sizeof stage, "start_from = \"%s\";\n%s", path, column("", text));
    assert_int_equal(mor_session_load_text(session, "fields.cfg", stage), MOR_OK);
    assert_int_equal(mor_session_build(session), MOR_OK);
    assert_non_null(strstr(warning, "'cohesion' varied in the run"));
    mor_session_free(&session);
    free_soil(&before);
    free_soil(&after);
}

/* A stage may also begin to vary a parameter that was the same everywhere. */
static void a_stage_gives_fields_to_soil_that_had_none(void **state)
{
    char text[TEXT_BYTES];
    char stage[2 * TEXT_BYTES];
    char path[MOR_PATH_BYTES];
    run_folder *folder = *state;
    run(folder, "plain", column("", text));
    snprintf(stage, sizeof stage, "start_from = \"%s\";\n%s", run_folder_file(folder, path, "plain"),
             column("fields = ( { parameter = \"cohesion\"; formula = \"1e3*x\"; } );", text));
    soil it = start(stage);
    for (int64_t i = 0; i < it.n; ++i) {
        assert_near(it.cohesion[i], 1e3 * it.position[3 * i], 1e-9); /* rounding */
    }
    free_soil(&it);
}

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

static void what_has_no_sense_is_refused_with_its_line(void **state)
{
    static const struct {
        const char *fields, *part;
    } faults[] = {
        {"{ parameter = \"cohesin\"; formula = \"1\"; }", "did you mean 'cohesion'"},
        {"{ parameter = \"poissons_ratio\"; formula = \"0.2\"; }", "parameter of the law that may vary in space"},
        {"{ parameter = \"cohesion\"; }", "found no 'formula'"},
        {"{ parameter = \"cohesion\"; formula = \"1 +\"; }", "the formula ends too early"},
        {"{ parameter = \"cohesion\"; formula = \"\"; }", "found the formula ''"},
        {"{ parameter = \"cohesion\"; formula = \"1e3\"; seed = 3; }", "found 'seed', which has no effect"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; correlation_length = (1, 1); }",
         "found no 'coefficient_of_variation'"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; coefficient_of_variation = 1; }",
         "found no 'correlation_length'"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; coefficient_of_variation = 1;\n"
         "standard_deviation = \"2 kPa\"; correlation_length = (1, 1); }",
         "found 'coefficient_of_variation', which has no effect"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; standard_deviation = \"2 deg\";\n"
         "correlation_length = (1, 1); }",
         "standard_deviation"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; coefficient_of_variation = 1;\n"
         "correlation_length = (1, 0); }",
         "correlation_length"},
        {"{ parameter = \"cohesion\"; formula = \"1e3\"; minimum = 5; maximum = 4; }", "below the minimum"},
        {"{ parameter = \"cohesion\"; formula = \"1e3\"; }, { parameter = \"cohesion\"; formula = \"1\"; }",
         "found 'cohesion' again"},
        {"{ parameter = \"cohesion\"; distribution = \"normal\"; coefficient_of_variation = 1;\n"
         "correlated_with = \"friction_angle\"; cross_correlation = 0.5; }",
         "earlier in the list"},
        {"{ parameter = \"cohesion\"; formula = \"1e3*(x - 2)\"; }", "soil 'a', field of 'cohesion' at ("},
        {"{ parameter = \"friction_angle\"; formula = \"30\"; }", "friction_angle"},
        {"{ parameter = \"youngs_modulus\"; formula = \"1e7*(1 + y)\"; }", "waves run at"},
        {"{ parameter = \"cohesion\"; formula = \"x - 2\"; distribution = \"lognormal\"; coefficient_of_variation = "
         "1;\n"
         "correlation_length = (1, 1); }",
         "not above zero in a lognormal field"},
        {"{ parameter = \"cohesion\"; formula = \"ln(x - 2)\"; }", "allowed: finite values"}};
    (void)state;
    for (size_t k = 0; k < sizeof faults / sizeof *faults; ++k) {
        char fields[1024];
        char text[TEXT_BYTES];
        mor_session *session = open_session();
        snprintf(fields, sizeof fields, "fields = ( %s );", faults[k].fields);
        mor_status status = mor_session_load_text(session, "fields.cfg", column(fields, text));
        status = status == MOR_OK ? mor_session_build(session) : status;
        assert_int_equal(status, MOR_ERROR_CONFIG);
        const char *message = mor_session_message(session);
        if (strstr(message, faults[k].part) == NULL || strstr(message, "fields.cfg:") == NULL) {
            fail_msg("the message is '%s'; it does not hold '%s' and the line", message, faults[k].part);
        }
        mor_session_free(&session);
    }
}

static void a_parameter_without_a_role_is_refused(void **state)
{
    static const char text[] =
        HEAD "spacing = 0.25;\n"
             "soil = ( { name = \"a\"; shape = { type = \"box\"; min = (0, 0); max = (4, 4); };\n"
             "material = { model = \"mu_i\"; density = 2000; youngs_modulus = 5e7; poissons_ratio = 0.3;\n"
             "  static_friction = 0.4; limiting_friction = 0.6; inertial_number = 0.3; grain_diameter = 0.001; };\n"
             "fields = ( { parameter = \"static_friction\"; formula = \"0.4\"; } ); } );\n";
    mor_session *session = open_session();
    (void)state;
    assert_int_equal(mor_session_load_text(session, "fields.cfg", text), MOR_ERROR_CONFIG);
    const char *message = mor_session_message(session);
    if (strstr(message, "fields.cfg:8") == NULL || strstr(message, "parameter of the law that may vary") == NULL) {
        fail_msg("%s", message);
    }
    mor_session_free(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_fields_give_the_bits_of_soil_without_fields),
        cmocka_unit_test(layers_by_a_formula_are_regions_with_a_value_each),
        cmocka_unit_test(soil_without_a_field_shows_its_constant_beside_one_with),
        cmocka_unit_test(values_belong_to_places_whatever_spacing_and_order),
        cmocka_unit_test(a_column_of_two_stiffnesses_settles_by_both),
        cmocka_unit_test(the_particles_have_the_statistics_prescribed),
        cmocka_unit_test_setup_teardown(clipped_values_are_counted_and_reported, run_folder_setup, run_folder_teardown),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test_setup_teardown(a_resumed_session_has_the_same_bits, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_next_stage_keeps_what_particles_are_made_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_stage_gives_fields_to_soil_that_had_none, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test(what_has_no_sense_is_refused_with_its_line),
        cmocka_unit_test(a_parameter_without_a_role_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
