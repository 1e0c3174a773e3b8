/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

/* The program, not the library, reads from the environment where relaxed particles are kept. */

static void environment_names_the_folder(void **state)
{
    char folder[MOR_COMMAND_PATH_BYTES];
    (void)state;
    assert_int_equal(setenv("MORAINE_CACHE", "/somewhere", 1), 0);
    mor_command_find_cache(folder);
    assert_string_equal(folder, "/somewhere");
    assert_int_equal(setenv("MORAINE_CACHE", "", 1), 0);
    mor_command_find_cache(folder);
    assert_string_equal(folder, "");
    assert_int_equal(unsetenv("MORAINE_CACHE"), 0);
    assert_int_equal(setenv("XDG_CACHE_HOME", "/shared", 1), 0);
    mor_command_find_cache(folder);
    assert_string_equal(folder, "/shared/moraine");
    assert_int_equal(unsetenv("XDG_CACHE_HOME"), 0);
    assert_int_equal(setenv("HOME", "/me", 1), 0);
    mor_command_find_cache(folder);
    assert_string_equal(folder, "/me/.cache/moraine");
    assert_int_equal(unsetenv("HOME"), 0);
    mor_command_find_cache(folder);
    assert_string_equal(folder, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(environment_names_the_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
