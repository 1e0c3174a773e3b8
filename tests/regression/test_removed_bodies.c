/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_run.h"

#include <string.h>

/* A body that was removed counts in no result: sand that collapses far from a block, which falls until it is removed,
 * against the same sand alone. */

#define CASE_OF(start, bodies, more)                                                                                   \
    start "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '0.2 s';"                                     \
          "domain = { min = (-1, -1); max = (6, 3); };"                                                                \
          "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 0.5); };"                         \
          "  initial_stress = { type = 'k0'; }; material = { model = 'drucker_prager'; density = 1900;"                \
          "    youngs_modulus = '1 MPa'; poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"                     \
          "walls = ( { name = 'floor'; friction = 'rough';"                                                            \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; },"                                  \
          "  { name = 'left'; friction = 'smooth';"                                                                    \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; } );" bodies                         \
          "probes = ( { name = 'toe'; type = 'toe'; }, { name = 'potential'; type = 'potential_energy';"               \
          "    origin = (0, -10); }, { name = 'total'; type = 'total_energy'; origin = (0, -10); },"                   \
          "  { name = 'dissipated'; type = 'dissipated_energy'; },"                                                    \
          "  { name = 'unbalanced'; type = 'unbalanced_force'; }, { name = 'balance'; type = 'energy_balance'; }" more \
          " );"                                                                                                        \
          "output = { snapshots = 2; pictures = false; };"
#define TRAVEL                                                                                                         \
    ", { type = 'boulder_travel'; },"                                                                                  \
    "  { name = 'height'; type = 'body_position'; body = 'block'; direction = (0, 1); }"
#define BLOCK(more)                                                                                                    \
    "bodies = ( { name = 'block'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"                    \
    "  position = (4, 1); material = { model = 'rigid'; density = 2500; }; " more " } );"

static void a_removed_body_counts_in_no_result(void **state)
{
    static const char *const names[] = {"toe", "potential", "total", "dissipated", "unbalanced", "balance"};
    run_folder *folder = *state;
    session_run_text(folder, CASE_OF("", "", ""), "alone");
    session_run_text(folder, CASE_OF("", BLOCK("removed_at = 0.1;"), TRAVEL), "with");
    /* The block is there at first: 400 kg at 11 m above the origin, to rounding. */
    const double weight = finished_run_read_value(folder, "with", "potential", 0) -
                          finished_run_read_value(folder, "alone", "potential", 0);
    assert_near(weight, 400.0 * 9.81 * 11.0, 1e-6 * weight);
    assert_near(finished_run_read_value(folder, "with", "height", 0), 1.0, 1e-9);
    assert_true(isnan(finished_run_read_value(folder, "with", "height", -1)));
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        const double alone = finished_run_read_value(folder, "alone", names[k], -1);
        /* Steps end where it is removed and so are others: a thousandth, of net forces, which change from step to step,
         * a hundredth. Counted in, the block is 42 % of the mass and 43 of 138 kJ/m. */
        const double share = strcmp(names[k], "unbalanced") == 0 ? 1e-2 : 1e-3;
        assert_near(finished_run_read_value(folder, "with", names[k], -1), alone, share * fabs(alone));
    }
}

static void what_was_removed_before_a_run_is_not_listed_in_it(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    session_run_text(folder, CASE_OF("", BLOCK("removed_at = 0.1;"), TRAVEL), "before");
    session_run_text(folder, CASE_OF("start_from = 'before';", BLOCK(""), TRAVEL), "after");
    char *text = (char *)run_folder_load(finished_run_file(folder, path, "after", "boulders.csv"), &n_bytes);
    assert_non_null(memmem(text, n_bytes, "boulder,", 8));
    assert_null(memmem(text, n_bytes, "\nblock", 6));
    free(text);
    /* By this mark pictures leave it out. */
    mor_snapshot_list list;
    mor_snapshot snapshot;
    mor_context *context = &folder->context;
    assert_int_equal(mor_snapshot_list_init(context, &list, run_folder_file(folder, path, "after")), MOR_OK);
    assert_int_equal(mor_snapshot_open(context, &snapshot, path, list.items[0].step), MOR_OK);
    const mor_snapshot_set *set = mor_snapshot_find_set(&snapshot, "rigid");
    assert_non_null(set);
    const mor_snapshot_field *field = mor_snapshot_find_field(set, "removed");
    assert_non_null(field);
    double *removed = malloc((size_t)set->n_particles * sizeof *removed);
    assert_non_null(removed);
    assert_int_equal(mor_snapshot_read_field(context, &snapshot, set, field, removed), MOR_OK);
    assert_true(set->n_particles > 0);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        assert_true(removed[i] == 1.0);
    }
    free(removed);
    mor_snapshot_close(context, &snapshot);
    mor_snapshot_list_clear(context, &list);
}

/* Two blocks fall freely, one of them until it is removed: nothing is lost, and both are where they began, beyond the
 * line. */
static void the_energy_of_a_removed_body_is_not_lost_and_its_side_is_known(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    session_run_text(folder,
                     "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '0.2 s';"
                     "domain = { min = (-1, -1); max = (6, 3); };"
                     "bodies = ( { name = 'stays'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"
                     "    position = (2, 1); material = { model = 'rigid'; density = 2500; }; },"
                     "  { name = 'goes'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"
                     "    position = (4, 1); material = { model = 'rigid'; density = 2500; }; removed_at = 0.1; } );"
                     "probes = ( { name = 'balance'; type = 'bodies_energy_balance'; }, { type = 'boulder_travel'; },"
                     "  { name = 'line'; type = 'passages'; origin = (1, 0); direction = (1, 0); } );"
                     "output = { snapshots = 2; pictures = false; };",
                     "run");
    assert_near(finished_run_read_value(folder, "run", "balance", -1), 1.0, 1e-9); /* to rounding */
    assert_true(finished_run_read_value(folder, "run", "line", -1) == 0.0);
    char *text = (char *)run_folder_load(finished_run_file(folder, path, "run", "boulders.csv"), &n_bytes);
    assert_non_null(memmem(text, n_bytes, "line_beyond [1]", 15));
    /* Of the one that is there: rest 0, no removal, beyond, no passage. */
    assert_non_null(memmem(text, n_bytes, ",0,,1,,\n", 8));
    assert_non_null(memmem(text, n_bytes, ",,0.1,1,,\n", 10));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_removed_body_counts_in_no_result, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_energy_of_a_removed_body_is_not_lost_and_its_side_is_known,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_was_removed_before_a_run_is_not_listed_in_it, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
