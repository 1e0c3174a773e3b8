/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What soil that may sleep, or is released later, does not go with. */
#include "core/sph/settings/soil_settings.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void expect_refusal(const mor_soil_settings *settings, const char *words)
{
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_soil_check_sleep(&context, settings), MOR_ERROR_CONFIG);
    if (strstr(context.message, words) == NULL) {
        fail_msg("no '%s' in: %s", words, context.message);
    }
}

static void expect_none(const mor_soil_settings *settings)
{
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_soil_check_sleep(&context, settings), MOR_OK);
}

/* Such soil has its neighbors in lists that know no images. */
static void soil_that_stands_still_is_refused_in_a_periodic_domain(void **state)
{
    (void)state;
    mor_soil_settings settings = {.spacing = 0.1, .gravity = {0.0, 0.0, -9.81}, .n_regions = 2};
    settings.is_periodic[1] = true;
    expect_none(&settings);
    settings.released[1] = 0.5;
    expect_refusal(&settings, "soil that is released at 0.5 s");
    settings.released[1] = 0.0;
    settings.scheme.sleep_after = 1.0;
    expect_refusal(&settings, "sleep_after = 1 s");
    settings.is_periodic[1] = false;
    settings.released[1] = 0.5;
    expect_none(&settings);
}

static void soil_that_stands_still_is_refused_with_what_moves_it(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        mor_soil_settings settings = {.spacing = 0.1, .gravity = {0.0, 0.0, -9.81}};
        settings.scheme.xsph = k == 0 ? 0.1 : 0.0;
        settings.scheme.shifting = k == 1;
        expect_none(&settings);
        settings.released[0] = 0.5;
        expect_refusal(&settings, k == 0 ? "found xsph with soil that is released at 0.5 s"
                                         : "found shifting with soil that is released at 0.5 s");
        settings.released[0] = 0.0;
        settings.scheme.sleep_after = 1.0;
        expect_refusal(&settings, k == 0 ? "found xsph with soil that may sleep, sleep_after = 1 s"
                                         : "found shifting with soil that may sleep, sleep_after = 1 s");
    }
}

static void release_is_that_of_the_last_region(void **state)
{
    (void)state;
    mor_soil_settings settings = {.released = {0.0, 2.0, 1.0, 9.0}};
    assert_true(mor_soil_find_release(&settings) == 0.0); /* no number of regions: there is one */
    settings.n_regions = 3;
    assert_true(mor_soil_find_release(&settings) == 2.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_that_stands_still_is_refused_in_a_periodic_domain),
        cmocka_unit_test(soil_that_stands_still_is_refused_with_what_moves_it),
        cmocka_unit_test(release_is_that_of_the_last_region),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
