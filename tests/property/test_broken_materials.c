/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/* The template of a law, broken in one way at a time: what check-material says of it. Not with sanitizers, which keep
 * account of memory themselves. */

#define TEMPLATE MOR_SOURCE_DIR "/materials/template/undrained_clay.c"

enum { COMMAND_BYTES = 4 * MOR_PATH_BYTES };

/* A command of sed that breaks the law, the exit code, and what is to be said. */
static const struct {
    const char *change;
    int exit_code;
    const char *part;
} variants[] = {
    {"s/x/x/", 0, "pass  it takes memory from the services"},
    {"s/\"undrained_clay\"/\"tresca\"/", 1, "FAIL  a case can load it beside the models that are there: plug-in '"},
    {"s/\"plastic_strain\"/\"velocity\"/", 1,
     "FAIL  a case can load it beside the models that are there: material 'un"},
    {"s/\"plastic_strain\"/\"soil\"/", 1, "'soil', but that is the name of a field of the soil: rename it"},
    {"s/\"undrained_clay\"/\"umat\"/", 1, "the name of an interface to laws of other programs: rename it"},
    {"s/host_abi == MOR_MATERIAL_ABI/host_abi == 77/", 1, "does not serve interface"},
    {"s/abi = MOR_MATERIAL_ABI, .n/abi = 77, .n/", 1, "was built for interface 77"},
    {"s/sizeof(mor_material)/64/", 1, "64 bytes"},
    {"s/batch->stress_out\\[6 \\* i + a\\] = stress\\[a\\]/batch->stress_out[6 * i + a] = sqrt(-1.0 - stress[a] * "
     "0.0)/",
     1, "FAIL  wave speed is usable and ordinary paths can be followed"},
    {"s/const double w\\[3\\] = {0.25/const double w[3] = {0.1/", 1,
     "FAIL  a superposed rotation turns the stress with it"},
    {"s|double sum = 0.0;|double sum = 0.0; *(double *volatile *)\\&kept = malloc(64); |; s|#include "
     "\"core/base/math.h\"|#include \"core/base/math.h\"\\n#include <stdlib.h>\\nstatic void *kept;|",
     1, "FAIL  an update keeps no memory"},
    {"s|double sum = 0.0;|void *volatile used = malloc(64); free(used); double sum = 0.0;|; s|#include "
     "\"core/base/math.h\"|#include \"core/base/math.h\"\\n#include <stdlib.h>|",
     1, "it calls malloc"},
    {"s/batch->state_out\\[0\\]\\[i\\] = /batch->state_out[0][i + 1] = batch->state_out[0][i] = /", 1,
     "wrote outside a state_out variable plastic_strain"},
    {"s/double sum = 0.0;/double sum = *(volatile double *)8;/", 1,
     "crashed (Segmentation fault) while this was tried"},
    /* In the first of the strains that are timed, whose norm no law is tried with. */
    {"s|double sum = 0.0;|double sum = 0.0; { double e = 0.0; for (int q = 0; q < 9; ++q) { const double *g = "
     "batch->velocity_gradient + 9 * i; const double h = 0.5 * (g[q] + g[q % 3 * 3 + q / 3]); e += h * h; } sum = "
     "fabs(1e6 * sqrt(e) * batch->time_step - 1.0) < 1e-9 ? *(volatile double *)8 : 0.0; }|",
     1, "crashed (Segmentation fault) while this was tried: timing an update"},
    {"s/{stress\\[0\\], stress\\[3\\], stress\\[5\\], stress\\[3\\]/{stress[0], stress[4], stress[5], stress[3]/", 1,
     "FAIL  a rigid spin keeps the invariants"},
    {"s/batch->dissipation\\[i\\] = /batch->dissipation[i] = 0.0 * /", 1, "FAIL  work is stored or dissipated"},
    {"s/batch->dissipation\\[i\\] = /batch->dissipation[i] = 3.0 * /", 1, "found with: shear_modulus = "},
    {"s/speed\\[i\\] = sqrt/speed[i] = 0.3 * sqrt/", 1, "FAIL  the wave speed is not below sqrt(K/density): 2.3"},
    {"s/+= (1.0 - before)/-= (1.0 - before)/", 1, "FAIL  a small strain from no stress is resisted"},
};

static void broken_laws_are_caught_and_named(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char command[COMMAND_BYTES];
    for (size_t k = 0; k < sizeof variants / sizeof *variants; ++k) {
        run_folder_file(folder, path, "law.so");
        snprintf(command, sizeof command, "sed '%s' '%s' | cc -std=c11 -w -O1 -shared -fPIC -I'%s' -x c - -lm -o '%s'",
                 variants[k].change, TEMPLATE, MOR_SOURCE_DIR, path);
        assert_int_equal(system(command), 0);
        program_outcome outcome =
            program_run(folder, (const char *const[]){"check-material", "./law.so", NULL}, variants[k].exit_code);
        if (strstr(outcome.output, variants[k].part) == NULL && strstr(outcome.errors, variants[k].part) == NULL) {
            fail_msg("variant %zu: found no \"%s\" in \"%s%s\"", k, variants[k].part, outcome.output, outcome.errors);
        }
        program_clear(&outcome);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(broken_laws_are_caught_and_named, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
