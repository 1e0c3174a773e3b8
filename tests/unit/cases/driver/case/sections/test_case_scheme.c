/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/case_reading.h"

/* The setting `scheme`, from which the other settings of the scheme have their values where they are not given. */

#define CASE(numerics)                                                                                                 \
    "dimension = 2; spacing = 0.01; end = 1; gravity = (0, -9.81); domain = { min = (-1, -1); max = (1, 1); };\n"      \
    "soil = ( { name = \"heap\"; shape = { type = \"box\"; min = (0, 0); max = (0.5, 0.25); };\n"                      \
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"         \
    "    friction_angle = 0.5; }; } );\n" numerics "\n"

static const mor_case_group *numerics_group(void)
{
    const mor_case_group *group = mor_case_settings_groups;
    while (strcmp(group->name, "numerics") != 0) {
        ++group;
    }
    return group;
}

static double value_of(const mor_case *it, const mor_case_key *key)
{
    const char *member = (const char *)it + key->offset;
    if (key->storage == MOR_CASE_STORE_BOOL) {
        return *(const bool *)member;
    }
    if (key->storage == MOR_CASE_STORE_REALS) {
        return *(const double *)member;
    }
    return *(const int *)member;
}

/* Number of settings that differ between two cases. */
static int count_unlike(const mor_case *a, const mor_case *b)
{
    int n = 0;
    for (const mor_case_key *key = numerics_group()->keys; key->schema.key != NULL; ++key) {
        n += value_of(a, key) != value_of(b, key);
    }
    return n;
}

static void each_scheme_gives_the_settings_their_values(void **state)
{
    case_reading *f = *state;
    static const char *const texts[2] = {CASE("numerics = { scheme = \"moraine\"; };"),
                                         CASE("numerics = { scheme = \"zhang2024\"; };")};
    for (int scheme = 0; scheme < 2; ++scheme) {
        case_reading_read(f, texts[scheme], NULL, &f->first);
        assert_int_equal(f->first.numerics.scheme, scheme);
        for (const mor_case_key *key = numerics_group()->keys; key->schema.key != NULL; ++key) {
            if (key->computed == NULL && strcmp(key->schema.key, "scheme") != 0) {
                /* exact: the number of the table */
                assert_true(value_of(&f->first, key) == mor_case_key_default(key, scheme));
            }
        }
    }
}

static void the_scheme_of_the_source_has_none_of_our_terms(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, CASE("numerics = { scheme = \"zhang2024\"; };"), NULL, &f->first);
    const mor_scheme *n = &f->first.numerics;
    assert_true(n->soil_hourglass == 0.0); /* exact: off */
    assert_false(n->lattice_normalization || n->angular_momentum || n->separation_memory);
    assert_true(n->wall_normals == 0 && n->reconstruction == 0 && n->stress_diffusion_limiter == 0);
    assert_true(n->velocity_gradient == 0 && n->gravity_ramp_form == 0 && n->coulomb_tension == 0);
    assert_true(n->courant == 0.4 && n->body_courant == 0.4); /* exact: Zhang et al. (2024) eq. 51 */
    case_reading_read(f, CASE("numerics = { scheme = \"moraine\"; };"), NULL, &f->second);
    n = &f->second.numerics;
    assert_true(n->soil_hourglass > 0.0 && n->lattice_normalization && n->angular_momentum && n->separation_memory);
    assert_true(n->wall_normals == 1 && n->reconstruction == 1 && n->stress_diffusion_limiter == 2);
    assert_true(n->velocity_gradient == 2 && n->gravity_ramp_form == 1 && n->angular_momentum_by == 1);
    assert_true(n->coulomb_tension == 1 && n->courant == 0.6 && n->body_courant == 0.5);
    assert_int_equal(count_unlike(&f->first, &f->second), 14); /* those above, and the scheme itself */
}

/* Wherever the scheme is written: before, after, or on the command line. */
static void a_setting_that_is_given_overrides_the_scheme(void **state)
{
    case_reading *f = *state;
    const char *const settings[] = {"numerics.scheme=zhang2024", NULL};
    case_reading_read(f, CASE("numerics = { scheme = \"zhang2024\"; soil_hourglass = 0.5; };"), NULL, &f->first);
    case_reading_read(f, CASE("numerics = { soil_hourglass = 0.5; scheme = \"zhang2024\"; };"), NULL, &f->second);
    assert_true(f->first.numerics.soil_hourglass == 0.5); /* exact: as given */
    assert_false(f->first.numerics.lattice_normalization);
    assert_int_equal(count_unlike(&f->first, &f->second), 0);
    case_reading_read(f, CASE("numerics = { scheme = \"moraine\"; soil_hourglass = 0.5; };"), settings, &f->second);
    assert_int_equal(count_unlike(&f->first, &f->second), 0);
}

static void a_written_case_reads_the_same_with_either_scheme(void **state)
{
    case_reading_round_trip(*state, CASE("numerics = { scheme = \"moraine\"; };"), NULL);
    case_reading_round_trip(*state, CASE("numerics = { scheme = \"zhang2024\"; wall_normals = \"geometry\"; };"), NULL);
}

static void an_unknown_scheme_is_refused(void **state)
{
    case_reading_refuse(*state, CASE("numerics = { scheme = \"zhang2042\"; };"), NULL, "t.cfg:", "zhang2024");
    case_reading_refuse(*state, CASE("numerics = { scheme = 1; };"), NULL, "t.cfg:", "moraine, zhang2024");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_scheme_gives_the_settings_their_values, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(the_scheme_of_the_source_has_none_of_our_terms, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_setting_that_is_given_overrides_the_scheme, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_written_case_reads_the_same_with_either_scheme, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(an_unknown_scheme_is_refused, case_reading_set_up, case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
