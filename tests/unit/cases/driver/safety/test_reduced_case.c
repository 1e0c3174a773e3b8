/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The case of a trial: strength and friction of soil over the factor, everything else as it was, nothing that moves. */
#include "cases/driver/safety/reduced_case.h"

#include "cases/driver/library/session_internal.h"
#include "core/base/memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define HEAD                                                                                                           \
    "title = \"reduced\"; dimension = 2; spacing = 0.1; end = 3; gravity = (0, -9.81);\n"                              \
    "domain = { min = (-1, -1); max = (5, 5); };\n"                                                                    \
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); };\n"             \
    "  friction = \"coulomb\"; friction_coefficient = 0.5; velocity = (0.1, 0);\n"                                     \
    "  friction_with = ( { soil = \"sand\"; friction = \"coulomb\"; friction_coefficient = 0.25; } ); } );\n"          \
    "bodies = ( { name = \"rock\"; shape = { type = \"box\"; min = (-0.3, -0.3); max = (0.3, 0.3); };\n"               \
    "  position = (1, 0.6); velocity = (1, 0); friction = \"coulomb\"; friction_coefficient = 0.4;\n"                  \
    "  material = { model = \"rigid\"; density = 2500; }; } );\n"
#define SOIL(more)                                                                                                     \
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0, 0); max = (2, 2); }; velocity = (0.5, 0);\n"      \
    "  material = { model = \"mohr_coulomb\"; density = 2000; youngs_modulus = 1e7; poissons_ratio = 0.3;\n"           \
    "    cohesion = 1000; friction_angle = 0.5; }; " more " } );\n"

/* A session with a case, and the case of its trials; both to be ended by the caller. */
typedef struct loaded {
    mor_session *session;
    mor_reduced_case *it;
} loaded;

static loaded load(const char *text)
{
    loaded l = {NULL, NULL};
    assert_int_equal(mor_session_new(&l.session), MOR_OK);
    if (mor_session_load_text(l.session, "reduced.cfg", text) != MOR_OK) {
        fail_msg("%s", mor_session_message(l.session));
    }
    assert_int_equal(mor_reduced_case_new(&l.session->context, &l.session->the_case, &l.it), MOR_OK);
    return l;
}

static void end(loaded *l)
{
    mor_reduced_case_free(&l->session->context, &l->it);
    mor_session_free(&l->session);
}

static void friction_of_soil_is_reduced_and_rocks_stay(void **state)
{
    (void)state;
    loaded l = load(HEAD SOIL(""));
    const mor_case *c = &l.it->the_case;
    const mor_case *original = &l.session->the_case;
    mor_reduced_case_set_factor(l.it, 0.5);
    mor_reduced_case_set_factor(l.it, 2.0);                /* of the original, not of what was reduced before */
    assert_true(c->walls[0].friction_coefficient == 0.25); /* exact: powers of two */
    assert_true(c->walls[0].friction_with.of[0].coefficient == 0.125);
    assert_true(c->bodies[0].soil_friction_coefficient == 0.2);
    assert_true(c->bodies[0].density == 2500.0);
    assert_memory_equal(&c->contact, &original->contact, sizeof c->contact);
    assert_true(original->bodies[0].soil_friction_coefficient == 0.4); /* the case itself is left alone */
    assert_true(original->walls[0].friction_coefficient == 0.5);
    end(&l);
}

static void nothing_moves_and_lateral_stress_is_that_of_the_whole_strength(void **state)
{
    (void)state;
    loaded l = load(HEAD SOIL("initial_stress = { type = \"k0\"; };"));
    const mor_case *c = &l.it->the_case;
    const double none[3] = {0.0, 0.0, 0.0};
    mor_reduced_case_set_factor(l.it, 3.0);
    assert_memory_equal(c->walls[0].velocity, none, sizeof none);
    assert_memory_equal(c->bodies[0].velocity, none, sizeof none);
    assert_memory_equal(c->soils[0].velocity, none, sizeof none);
    assert_true(fabs(c->soils[0].lateral_ratio - (1.0 - sin(0.5))) < 1.0e-15); /* rounding */
    end(&l);
}

static void the_start_follows_what_the_case_asks_for(void **state)
{
    (void)state;
    loaded settled = load(HEAD SOIL("initial_stress = { type = \"settled\"; };"));
    assert_int_equal(settled.it->start, MOR_REDUCED_SETTLED);
    end(&settled);
    loaded ramped = load(HEAD SOIL("") "numerics = { gravity_ramp = 0.5; damping = 1.0; damping_time = 0.75; };");
    assert_int_equal(ramped.it->start, MOR_REDUCED_RAMPED);
    assert_true(ramped.it->loaded == 0.75); /* exact: copied */
    mor_reduced_case_begin_trial(ramped.it, 2.0);
    assert_true(ramped.it->the_case.numerics.damping == 0.0);
    assert_true(ramped.it->the_case.numerics.local_damping > 0.0);
    assert_true(ramped.it->the_case.numerics.damping_time == 2.0);
    mor_reduced_case_begin_loading(ramped.it);
    assert_true(ramped.it->the_case.numerics.damping == 1.0);
    assert_true(ramped.it->the_case.numerics.local_damping == 0.0);
    end(&ramped);
    loaded plain = load(HEAD SOIL(""));
    assert_int_equal(plain.it->start, MOR_REDUCED_RELAXED);
    assert_int_equal(plain.it->the_case.soils[0].initial_stress, MOR_CASE_STRESS_SETTLED);
    assert_int_equal(plain.it->the_case.soils[0].settle_from, 1); /* it had no stress */
    assert_true(plain.it->the_case.soils[0].settle_time == 3.0);
    end(&plain);
}

/* Packed rocks stay for ever, as bodies do that are listed. */
static void slopes_with_packed_rocks_have_a_factor(void **state)
{
    (void)state;
    loaded l =
        load(HEAD SOIL("") "rocks = ( { name = \"stone\"; count = 2; seed = 1;\n"
                           "  region = { type = \"box\"; min = (0, 0); max = (2, 2); };\n"
                           "  sizes = ( { diameter = 0.5; passing = 1.0; } ); forms = ( { type = \"sphere\"; } );\n"
                           "  material = { model = \"rigid\"; density = 2500; }; } );");
    assert_int_equal(l.it->the_case.n_bodies, 3);
    for (int k = 0; k < 3; ++k) {
        assert_true(isnan(l.it->the_case.bodies[k].removed_at));
    }
    end(&l);
}

static void keep_warning(void *user, mor_log_level level, const char *text)
{
    char *kept = user;
    if (level == MOR_LOG_WARNING && strstr(text, "in plane strain") != NULL) {
        snprintf(kept, MOR_CONTEXT_MESSAGE_BYTES, "%s", text);
    }
}

/* Makes the case of trials of a soil; gives what is warned of and printed about its strength. */
static void describe_strength(const char *law, char *warning, char *line)
{
    char text[4096];
    mor_session *session = NULL;
    mor_reduced_case *it = NULL;
    snprintf(text, sizeof text,
             HEAD "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0, 0); max = (2, 2); };\n"
                  "  material = { density = 2000; youngs_modulus = 1e7; poissons_ratio = 0.3; %s }; } );\n",
             law);
    warning[0] = '\0';
    assert_int_equal(mor_session_new(&session), MOR_OK);
    if (mor_session_load_text(session, "reduced.cfg", text) != MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    session->context.log_sink = keep_warning;
    session->context.log_user = warning;
    assert_int_equal(mor_reduced_case_new(&session->context, &session->the_case, &it), MOR_OK);
    FILE *out = fmemopen(line, MOR_CONTEXT_MESSAGE_BYTES, "w");
    assert_non_null(out);
    mor_reduced_case_describe(it, out);
    fclose(out);
    mor_reduced_case_free(&session->context, &it);
    mor_session_free(&session);
}

static void strength_in_plane_strain_is_compared_with_mohr_and_coulomb(void **state)
{
    (void)state;
    char warning[MOR_CONTEXT_MESSAGE_BYTES];
    char line[MOR_CONTEXT_MESSAGE_BYTES];
    describe_strength("model = \"mohr_coulomb\"; friction_angle = 0.5; cohesion = 20e3; tension_ratio = 0;", warning,
                      line);
    assert_string_equal(warning, "");
    assert_non_null(strstr(line, "strength in plane strain 1.000 times"));
    describe_strength("model = \"drucker_prager\"; cone = \"matched\"; friction_angle = 0.5;", warning, line);
    assert_string_equal(warning, "");
    describe_strength("model = \"drucker_prager\"; cone = \"compression\"; friction_angle = 0.5;", warning, line);
    assert_non_null(strstr(warning, "on the unsafe side"));
    describe_strength("model = \"drucker_prager\"; friction_angle = 0.5;", warning, line);
    assert_non_null(strstr(warning, "smaller"));
    describe_strength("model = \"matsuoka_nakai\"; friction_angle = 0.5;", warning, line);
    assert_non_null(strstr(warning, "on the unsafe side"));
}

static void expect_refusal(const char *text, const char *part)
{
    mor_session *session = NULL;
    mor_reduced_case *it = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    if (mor_session_load_text(session, "reduced.cfg", text) != MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    assert_int_equal(mor_reduced_case_new(&session->context, &session->the_case, &it), MOR_ERROR_CONFIG);
    assert_non_null(strstr(session->context.message, "reduced.cfg"));
    if (strstr(session->context.message, part) == NULL) {
        fail_msg("the message is '%s'; it does not hold '%s'", session->context.message, part);
    }
    assert_null(it);
    mor_session_free(&session);
}

static void a_stress_that_is_not_of_its_weight_is_no_start(void **state)
{
    (void)state;
    expect_refusal(HEAD SOIL("initial_stress = { type = \"uniform\"; pressure = 1000; };"), "uniform");
}

/* Soil that slept would not feel that its strength was reduced, and stand with any factor. */
static void no_soil_sleeps(void **state)
{
    (void)state;
    loaded l = load(HEAD SOIL("") "numerics = { sleep_after = 0.1; };");
    assert_true(l.session->the_case.numerics.sleep_after == 0.1);
    assert_true(l.it->the_case.numerics.sleep_after == 0.0);
    end(&l);
}

static void what_is_removed_in_the_course_of_a_run_is_refused(void **state)
{
    (void)state;
    expect_refusal("dimension = 2; spacing = 0.1; end = 3; gravity = (0, -9.81); title = \"gate\";\n"
                   "domain = { min = (-1, -1); max = (5, 5); };\n"
                   "walls = ( { name = \"gate\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); };\n"
                   "  removed_at = 1.0; } );\n" SOIL(""),
                   "removed_at of wall 'gate'");
}

/* What has left is in no percentile of speed or displacement: the slope would seem to rest once it has slid away. */
static void soil_that_may_leave_is_refused(void **state)
{
    (void)state;
    expect_refusal("dimension = 2; spacing = 0.1; end = 3; gravity = (0, -9.81); title = \"chute\";\n"
                   "domain = { min = (-1, -1); max = (5, 5); outflow = \"remove\"; };\n" SOIL(""),
                   "domain.outflow = \"remove\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strength_in_plane_strain_is_compared_with_mohr_and_coulomb),
        cmocka_unit_test(slopes_with_packed_rocks_have_a_factor),
        cmocka_unit_test(friction_of_soil_is_reduced_and_rocks_stay),
        cmocka_unit_test(nothing_moves_and_lateral_stress_is_that_of_the_whole_strength),
        cmocka_unit_test(the_start_follows_what_the_case_asks_for),
        cmocka_unit_test(a_stress_that_is_not_of_its_weight_is_no_start),
        cmocka_unit_test(no_soil_sleeps),
        cmocka_unit_test(soil_that_may_leave_is_refused),
        cmocka_unit_test(what_is_removed_in_the_course_of_a_run_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
