/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/units.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct fixture {
    mor_context context;
    mor_units *units;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    if (f == NULL) {
        return 1;
    }
    mor_context_init(&f->context);
    *state = f;
    return mor_units_new(&f->context, &f->units) == MOR_OK ? 0 : 1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    mor_units_free(&f->context, &f->units);
    const int is_leaking = f->context.memory_bytes != 0 || f->units != NULL;
    free(f);
    return is_leaking;
}

static double convert(fixture *f, const char *text, const char *unit)
{
    double value = NAN;
    const mor_status status = mor_units_convert(&f->context, f->units, text, unit, &value);
    if (status != MOR_OK) {
        fail_msg("\"%s\" to %s: %s", text, unit, f->context.message);
    }
    return value;
}

static void values_with_units_become_si(void **state)
{
    static const struct {
        const char *text;
        const char *unit;
        double value;
    } rows[] = {{"5.98 MPa", "Pa", 5.98e6},
                {"2600 kg/m3", "kg/m3", 2600.0},
                {"2.5 g/cm3", "kg/m3", 2500.0},
                {"-9.81 m/s2", "m/s2", -9.81},
                {"9.81 m s-2", "m/s2", 9.81},
                {"9.81 m/s^2", "m/s2", 9.81},
                {"5 mm", "m", 0.005},
                {"35mm", "m", 0.035},
                {"  12.5 cm ", "m", 0.125},
                {"1 in", "m", 0.0254},
                {"1.5 min", "s", 90.0},
                {"2 h", "s", 7200.0},
                {"50 %", "1", 0.5},
                {"99.5 %", "%", 99.5},
                {"3", "m", 3.0},
                {"1e-3", "s", 1e-3},
                {"3 1/s", "1/s", 3.0},
                {"2 t/m3", "kg/m3", 2000.0},
                {"4 kN/m", "N/m", 4000.0},
                {"1 kJ/m", "J/m", 1000.0},
                {"2 kg m/s", "kg m/s", 2.0},
                {"10 kg.m-3", "kg/m3", 10.0},
                {"7 kg/(m s2)", "Pa", 7.0},
                {"1 mPa s", "Pa s", 0.001},
                {".5 m", "m", 0.5},
                {"+2 m", "m", 2.0},
                {"3 rad", "rad", 3.0}};
    fixture *f = *state;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const double value = convert(f, rows[k].text, rows[k].unit);
        if (value != rows[k].value) { /* exact: decimal factors round once, as the compiler's own constant does */
            fail_msg("\"%s\" is %.17g %s, expected %.17g", rows[k].text, value, rows[k].unit, rows[k].value);
        }
    }
}

static void degrees_are_angles_by_every_name(void **state)
{
    static const char *const names[] = {"30 deg", "30 degree", "30 degrees", "30 arc_degree", "30 \xc2\xb0"};
    fixture *f = *state;
    const double expected = 30.0 * 3.14159265358979323846 / 180.0;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        assert_true(fabs(convert(f, names[k], "rad") - expected) <= 2.3e-16); /* two ulp: two roundings */
    }
}

static void wrong_values_are_refused_with_the_reason(void **state)
{
    static const struct {
        const char *text;
        const char *unit;
        const char *fragment;
    } rows[] = {{"5 kg", "m", "'kg' is a unit of another kind (kg)"},
                {"5 m", "1", "another kind (m)"},
                {"30 deg", "1", "another kind (rad)"},
                {"0.5 %", "rad", "another kind (a plain number)"},
                {"5 Pa", "J", "another kind (kg m-1 s-2)"},
                {"", "m", "does not start with a number"},
                {"m", "m", "does not start with a number"},
                {"nan", "m", "does not start with a number"},
                {"inf m", "m", "does not start with a number"},
                {"-inf", "m", "does not start with a number"},
                {"0x10 m", "m", "does not start with a number"},
                {"--5 m", "m", "does not start with a number"},
                {"5 quux", "m", "'quux' is not a unit"},
                {"5 Mpa", "Pa", "'Mpa' is not a unit; did you mean 'MPa'?"},
                {"5 KG/M3", "kg/m3", "did you mean 'kg/m3'?"},
                {"5 m/", "m", "is not a unit"},
                {"5 degC", "K", "shifted zero"},
                {"5 lg(re mm)", "m", "cannot be used"},
                {"5 s since 1970-01-01", "s", "cannot be a unit"},
                {"5 10 mm", "m", "cannot be a unit"},
                {"5 m 2", "m", "cannot be a unit"},
                {"5 (10 m)", "m", "cannot be a unit"},
                {"5 -3 m", "m", "cannot be a unit"},
                {"5 m @ 2", "m", "cannot be a unit"},
                {"5 m.2", "m", "cannot be a unit"},
                {"5 m999", "m", "cannot be a unit"},
                {"5 (m", "m", "is not a unit"}};
    fixture *f = *state;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        double value = 0.0;
        const mor_status status = mor_units_convert(&f->context, f->units, rows[k].text, rows[k].unit, &value);
        if (status != MOR_ERROR_ARGUMENT || strstr(f->context.message, rows[k].fragment) == NULL) {
            fail_msg("\"%s\" to %s: status %d, message '%s' lacks '%s'", rows[k].text, rows[k].unit, (int)status,
                     f->context.message, rows[k].fragment);
        }
    }
}

static void a_long_unit_is_refused(void **state)
{
    fixture *f = *state;
    char text[400] = "1 ";
    double value = 0.0;
    memset(text + 2, 'm', sizeof text - 3);
    assert_int_equal(mor_units_convert(&f->context, f->units, text, "m", &value), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(f->context.message, "too long"));
}

static void a_number_beyond_double_is_infinite(void **state)
{
    fixture *f = *state;
    assert_true(isinf(convert(f, "1e999 m", "m")));
    assert_true(convert(f, "1e-999 m", "m") == 0.0); /* exact: underflow */
}

static void dimensions_count_powers(void **state)
{
    fixture *f = *state;
    mor_dimension pressure;
    mor_dimension none;
    char text[MOR_UNITS_TEXT_BYTES];
    assert_int_equal(mor_units_dimension(&f->context, f->units, "MPa", &pressure), MOR_OK);
    assert_int_equal(pressure.power[MOR_BASE_LENGTH], -1);
    assert_int_equal(pressure.power[MOR_BASE_MASS], 1);
    assert_int_equal(pressure.power[MOR_BASE_TIME], -2);
    assert_int_equal(pressure.power[MOR_BASE_ANGLE], 0);
    mor_dimension_format(&pressure, text, sizeof text);
    assert_string_equal(text, "kg m-1 s-2");
    assert_int_equal(mor_dimension_scale(&pressure, 2, 4, 6), -2 + 4 - 12);
    assert_int_equal(mor_units_dimension(&f->context, f->units, "1", &none), MOR_OK);
    assert_false(mor_dimension_equal(&none, &pressure));
    mor_dimension_format(&none, text, sizeof text);
    assert_string_equal(text, "1");
    assert_int_equal(mor_units_dimension(&f->context, f->units, "bad unit", &none), MOR_ERROR_ARGUMENT);
}

static void a_wanted_unit_that_is_none_is_an_internal_error(void **state)
{
    fixture *f = *state;
    double value = 0.0;
    assert_int_equal(mor_units_convert(&f->context, f->units, "5 m", "quux", &value), MOR_ERROR_INTERNAL);
}

static void printed_numbers_read_back_to_the_same_bits(void **state)
{
    static const double values[] = {0.0,   -0.0,  1.0,  0.1,    1.0 / 3.0,          1e10, 123456789012345680.0,
                                    1e300, 5e-30, -2.5, 5.98e6, 0.30000000000000004};
    fixture *f = *state;
    for (size_t k = 0; k < sizeof values / sizeof values[0]; ++k) {
        char text[64];
        double again = NAN;
        mor_units_format(f->units, values[k], text, sizeof text);
        const char *rest = mor_units_number(f->units, text, &again);
        assert_non_null(rest);
        assert_string_equal(rest, "");
        assert_memory_equal(&again, &values[k], sizeof again);
        assert_non_null(strpbrk(text, ".e"));
    }
}

static void a_decimal_comma_of_the_locale_changes_nothing(void **state)
{
    fixture *f = *state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    locale_t comma = (locale_t)0;
    for (size_t k = 0; k < sizeof names / sizeof names[0] && comma == (locale_t)0; ++k) {
        comma = newlocale(LC_ALL_MASK, names[k], (locale_t)0);
    }
    if (comma == (locale_t)0) {
        skip(); /* this machine has no such locale */
    }
    const locale_t previous = uselocale(comma);
    mor_units *loaded = NULL;
    double value = 0.0;
    char text[64];
    const mor_status made = mor_units_new(&f->context, &loaded);
    const mor_status converted = made == MOR_OK ? mor_units_convert(&f->context, loaded, "1.5 in", "m", &value) : made;
    if (made == MOR_OK) {
        mor_units_format(loaded, 0.25, text, sizeof text);
    }
    mor_units_free(&f->context, &loaded);
    uselocale(previous);
    freelocale(comma);
    assert_int_equal(converted, MOR_OK);
    assert_true(fabs(value - 0.0381) <= 1e-17); /* one unit in the last place */
    assert_string_equal(text, "0.25");
}

static void the_locale_of_the_caller_is_left_as_it_was(void **state)
{
    fixture *f = *state;
    locale_t own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t previous = uselocale(own);
    double value = 0.0;
    (void)mor_units_convert(&f->context, f->units, "5 quux", "m", &value);
    (void)mor_units_convert(&f->context, f->units, "5 cm", "m", &value);
    const locale_t after = uselocale(previous);
    freelocale(own);
    assert_ptr_equal(after, own);
}

/* ---- Threads ----------------------------------------------------------------------------------------------------- */

enum { THREADS = 4, ROUNDS = 2000 };

/* Conversions by one thread with tables and a context of its own. */
typedef struct crew_member {
    const char *text;
    const char *unit;
    double value;
    int n_wrong;
} crew_member;

static void *convert_again_and_again(void *argument)
{
    crew_member *it = argument;
    mor_context context;
    mor_units *units = NULL;
    mor_context_init(&context);
    for (int k = 0; k < ROUNDS; ++k) {
        double value = NAN;
        if (k % (ROUNDS / 4) == 0) {
            mor_units_free(&context, &units);
            it->n_wrong += mor_units_new(&context, &units) != MOR_OK;
        }
        it->n_wrong += mor_units_convert(&context, units, it->text, it->unit, &value) != MOR_OK || value != it->value;
        it->n_wrong += mor_units_convert(&context, units, "1 no_such_unit", it->unit, &value) != MOR_ERROR_ARGUMENT;
    }
    mor_units_free(&context, &units);
    it->n_wrong += context.memory_bytes != 0;
    return NULL;
}

/* UDUNITS keeps one state per process: without its lock these threads crash or read the units of one another. */
static void threads_convert_at_the_same_time(void **state)
{
    (void)state;
    crew_member crew[THREADS] = {{"5.98 MPa", "Pa", 5.98e6, 0},
                                 {"2.5 g/cm3", "kg/m3", 2500.0, 0},
                                 {"35 mm", "m", 0.035, 0},
                                 {"72 km/h", "m/s", 20.0, 0}};
    pthread_t threads[THREADS];
    for (int k = 0; k < THREADS; ++k) {
        assert_int_equal(pthread_create(&threads[k], NULL, convert_again_and_again, &crew[k]), 0);
    }
    for (int k = 0; k < THREADS; ++k) {
        assert_int_equal(pthread_join(threads[k], NULL), 0);
    }
    for (int k = 0; k < THREADS; ++k) {
        assert_int_equal(crew[k].n_wrong, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_with_units_become_si),
        cmocka_unit_test(degrees_are_angles_by_every_name),
        cmocka_unit_test(wrong_values_are_refused_with_the_reason),
        cmocka_unit_test(a_long_unit_is_refused),
        cmocka_unit_test(a_number_beyond_double_is_infinite),
        cmocka_unit_test(dimensions_count_powers),
        cmocka_unit_test(a_wanted_unit_that_is_none_is_an_internal_error),
        cmocka_unit_test(printed_numbers_read_back_to_the_same_bits),
        cmocka_unit_test(a_decimal_comma_of_the_locale_changes_nothing),
        cmocka_unit_test(the_locale_of_the_caller_is_left_as_it_was),
        cmocka_unit_test(threads_convert_at_the_same_time),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
