/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_soils.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { N = 6 };

static void soils_are_listed_by_name_each_with_its_particles_in_order(void **state)
{
    (void)state;
    const double region[N] = {2.0, 0.0, 2.0, 0.0, 0.0, 2.0};
    double position[3 * N];
    static mor_case the_case;
    mor_picture_soils soils = {.n_soils = 3};
    mor_picture_group groups[3];
    mor_context context;
    mor_context_init(&context);
    strcpy(the_case.soils[0].name, "sand");
    strcpy(the_case.soils[2].name, "clay");
    for (int k = 0; k < 3 * N; ++k) {
        position[k] = k / 3;
    }
    assert_int_equal(mor_picture_soils_sort(&context, region, N, position, &soils), MOR_OK);
    const mor_picture_group all = {.position = position, .n_particles = N, .radius = 0.5};
    assert_int_equal(mor_picture_soils_list(&soils, &the_case, &all, groups), 2); /* the second one has no particles */
    assert_string_equal(groups[0].name, "sand");
    assert_string_equal(groups[1].name, "clay");
    const double expected[N] = {1.0, 3.0, 4.0, 0.0, 2.0, 5.0};
    for (int k = 0; k < N; ++k) {
        const mor_picture_group *group = &groups[k / 3];
        assert_int_equal(group->n_particles, 3);
        assert_true(group->position[3 * (k % 3)] == expected[k]); /* exact: copied */
        assert_true(group->radius == 0.5 && group->value == NULL);
    }
    assert_true(memcmp(groups[0].color, groups[1].color, sizeof groups[0].color) != 0);
    assert_int_equal(context.memory_bytes, 0);
}

static void snapshot_of_another_case_is_refused(void **state)
{
    (void)state;
    const double region[2] = {0.0, 3.0};
    double position[6] = {0.0};
    mor_picture_soils soils = {.n_soils = 3};
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_picture_soils_sort(&context, region, 2, position, &soils), MOR_ERROR_IO);
    assert_non_null(strstr(context.message, "soil number 3 in a snapshot of a case with 3 soils"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soils_are_listed_by_name_each_with_its_particles_in_order),
        cmocka_unit_test(snapshot_of_another_case_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
