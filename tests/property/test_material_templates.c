/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/conformance.h"
#include "tests/common/template.h"

static void template_plugins_build_as_their_readmes_say_and_obey_all_laws(void **state)
{
    (void)state;
    static const struct {
        const char *project, *law, *may_skip;
    } templates[] = {
        {"template", "undrained_clay", ""},
        {"template_rates", "viscoplastic_soil", CONFORMANCE_NO_DISSIPATION "; " CONFORMANCE_NO_YIELD_SURFACE}};
    for (size_t k = 0; k < sizeof templates / sizeof *templates; ++k) {
        mor_context context;
        template_law it = {0};
        mor_context_init(&context);
        template_open(&context, MOR_SOURCE_DIR, templates[k].project, templates[k].law, &it);
        conformance_check(it.material, templates[k].may_skip);
        template_close(&context, &it);
        assert_int_equal(context.memory_bytes, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(template_plugins_build_as_their_readmes_say_and_obey_all_laws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
