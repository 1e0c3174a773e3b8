/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A small run with its pictures once took seven seconds, nearly all of them for pixels on the inside of large discs. */
#include "tests/common/program.h"

#include <math.h>
#include <sys/resource.h>

static const double bound = 1.5; /* s of processor time, of all threads: a small run should feel instant */

enum { TRIES = 3 }; /* the least of them counts: others compute on the machine as well */

static const char column[] =
    "title = \"100 particles\"; dimension = 2; spacing = \"20 mm\"; gravity = (0.0, -9.8); end = 0.3;\n"
    "domain = { min = (-0.2, -0.2); max = (2.0, 1.0); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0.0, 0.0); max = (0.2, 0.2); };\n"
    "  material = { model = \"drucker_prager\"; density = 2040.0; youngs_modulus = \"0.84 MPa\"; poissons_ratio = "
    "0.3;\n"
    "               friction_angle = \"22 deg\"; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0.0, 0.0); normal = (0.0, 1.0); }; } );\n"
    "probes = ( { name = \"run_out\"; type = \"run_out\"; } ); output = { snapshots = 2; };\n";

static double seconds_of_children(void)
{
    struct rusage used;
    assert_int_equal(getrusage(RUSAGE_CHILDREN, &used), 0);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

static void a_run_of_a_hundred_particles_with_three_pictures_feels_instant(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    double least = INFINITY;
    run_folder_store(run_folder_file(folder, path, "case.cfg"), column, sizeof column - 1);
    for (int k = 0; k < TRIES && least > bound; ++k) {
        char name[] = "run_0";
        name[4] = (char)('0' + k);
        const double before = seconds_of_children();
        const char *const words[] = {"run", "case.cfg", "-o", name, NULL};
        program_outcome outcome = program_run(folder, words, 0);
        least = fmin(least, seconds_of_children() - before);
        program_expect_text(outcome.output, "100 particles");
        program_expect_text(outcome.output, "step_000000_speed.png");
        program_clear(&outcome);
    }
    if (least > bound) {
        fail_msg("a run of 100 particles with three pictures took %.2f s of processor time; at most %.1f s are allowed",
                 least, bound);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_run_of_a_hundred_particles_with_three_pictures_feels_instant,
                                        run_folder_setup, run_folder_teardown),
    };
#if defined(__SANITIZE_ADDRESS__)
    return 77; /* sanitized programs are slow by nature */
#else
    return cmocka_run_group_tests(tests, NULL, NULL);
#endif
}
