/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/hash.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/* Plug-ins that a case names: run, told in the results, guarded on resume, refused with the reason. */

#define TEMPLATE MOR_SOURCE_DIR "/materials/template/undrained_clay.c"
#define RATE_TEMPLATE MOR_SOURCE_DIR "/materials/template_rates/viscoplastic_soil.c"

enum { COMMAND_BYTES = 4 * MOR_PATH_BYTES };

static const char clay_case[] =
    "plugins = [ './clay.so' ];"
    "title = 'clay bank'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "end = '40 ms'; domain = { min = ('-0.2 m', '-0.1 m'); max = ('0.6 m', '0.4 m'); };"
    "soil = ( { name = 'bank'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.2 m'); };"
    "  material = { model = 'undrained_clay'; density = '1800 kg/m3'; shear_modulus = '0.5 MPa';"
    "    bulk_modulus = '5 MPa'; undrained_strength = '0.3 kPa'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "probes = ( { type = 'run_out'; } );"
    "output = { snapshots = 6; pictures = false; };";

static void write_case(run_folder *folder, const char *source)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, source, path);
}

/* Compiles a template of a law, changed by a command of sed, into the scratch folder. */
static void compile_template(run_folder *folder, const char *source, const char *name, const char *change)
{
    char command[COMMAND_BYTES];
    snprintf(command, sizeof command, "sed '%s' '%s' | cc -std=c11 -O1 -shared -fPIC -I'%s' -x c - -lm -o '%s/%s'",
             change, source, MOR_SOURCE_DIR, folder->path, name);
    assert_int_equal(system(command), 0);
}

static void compile(run_folder *folder, const char *name, const char *change)
{
    compile_template(folder, TEMPLATE, name, change);
}

static void run(run_folder *folder, const char *run_name, const char *option, const char *value)
{
    program_outcome outcome = program_run(
        folder, (const char *const[]){"run", "case.cfg", "-t", "1", "-o", run_name, option, value, NULL}, 0);
    program_clear(&outcome);
}

static void refuse(run_folder *folder, const char *part)
{
    program_outcome outcome = program_run(folder, (const char *const[]){"check", "case.cfg", NULL}, 2);
    program_expect_text(outcome.errors, part);
    program_clear(&outcome);
}

static void expect_in_file(run_folder *folder, const char *run_name, const char *name, const char *part)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(finished_run_file(folder, path, run_name, name), &n_bytes);
    assert_non_null(text);
    program_expect_text(text, part);
    free(text);
}

/* Texts lie in the file as they are. */
static void expect_in_first_snapshot(run_folder *folder, const char *part)
{
    char path[MOR_PATH_BYTES];
    char name[MOR_PATH_BYTES];
    mor_snapshot_list list;
    size_t n_bytes = 0;
    run_folder_file(folder, path, "run");
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, path), MOR_OK);
    snprintf(name, sizeof name, "snapshots/step_%06lld.h5", (long long)list.items[0].step);
    void *bytes = run_folder_load(finished_run_file(folder, path, "run", name), &n_bytes);
    assert_non_null(bytes);
    assert_non_null(memmem(bytes, n_bytes, part, strlen(part)));
    free(bytes);
    mor_snapshot_list_clear(&folder->context, &list);
}

static void find_hash(run_folder *folder, char *hash)
{
    char path[MOR_PATH_BYTES];
    uint64_t value = 0;
    assert_int_equal(mor_hash_file(&folder->context, run_folder_file(folder, path, "clay.so"), &value), MOR_OK);
    mor_hash_format(value, hash);
}

static void run_tells_path_version_and_content_of_its_plugins(void **state)
{
    run_folder *folder = *state;
    char hash[MOR_HASH_TEXT_BYTES];
    char part[MOR_PATH_BYTES + 64];
    write_case(folder, clay_case);
    compile(folder, "clay.so", "");
    find_hash(folder, hash);
    run(folder, "run", NULL, NULL);
    snprintf(part, sizeof part, "\"hash\": \"%s\"", hash);
    expect_in_file(folder, "run", MOR_SUMMARY_FILE, part);
    expect_in_file(folder, "run", MOR_SUMMARY_FILE, "\"models\": \"undrained_clay 1.0\"");
    expect_in_file(folder, "run", MOR_SUMMARY_FILE, "/clay.so\"");
    snprintf(part, sizeof part, "# content of the file: xxh64 %s", hash);
    expect_in_file(folder, "run", "case.resolved.cfg", part);
    snprintf(part, sizeof part, "/clay.so: undrained_clay 1.0; xxh64 %s", hash);
    expect_in_first_snapshot(folder, part);
    program_outcome outcome = program_run(folder, (const char *const[]){"explain", "case.cfg", NULL}, 0);
    program_expect_text(outcome.output, "/clay.so: undrained_clay 1.0; xxh64 ");
    program_expect_text(outcome.output, hash);
    program_clear(&outcome);
}

static void resolved_case_runs_to_the_same_bits(void **state)
{
    run_folder *folder = *state;
    write_case(folder, clay_case);
    compile(folder, "clay.so", "");
    run(folder, "whole", NULL, NULL);
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "whole/case.resolved.cfg", "-t", "1", "-o", "again", NULL}, 0);
    program_clear(&outcome);
    finished_run_compare(folder, "whole", "again");
}

static void resumed_run_has_the_bits_of_a_whole_one(void **state)
{
    run_folder *folder = *state;
    write_case(folder, clay_case);
    compile(folder, "clay.so", "");
    run(folder, "whole", NULL, NULL);
    run(folder, "part", "--stop-at", "15 ms");
    run(folder, "part", "--resume", NULL);
    finished_run_compare(folder, "whole", "part");
}

static void changed_plugin_is_refused_on_resume(void **state)
{
    run_folder *folder = *state;
    write_case(folder, clay_case);
    compile(folder, "clay.so", "");
    run(folder, "part", "--stop-at", "15 ms");
    compile(folder, "clay.so", "s/\"1.0\"/\"1.1\"/");
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "case.cfg", "-o", "part", "--resume", NULL}, 2);
    program_expect_text(outcome.errors, "plugins");
    program_expect_text(outcome.errors, "the file has changed since");
    program_clear(&outcome);
}

static void plugin_that_cannot_be_used_is_refused_with_its_place(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    write_case(folder, clay_case);
    refuse(folder, "case.cfg:1: found a plug-in that cannot be read");
    run_folder_store(run_folder_file(folder, path, "clay.so"), "no object", 9);
    refuse(folder, "case.cfg:1: found a plug-in that cannot be used");
    compile(folder, "clay.so", "s/host_abi == MOR_MATERIAL_ABI/host_abi == 77/");
    refuse(folder, "does not serve interface");
    compile(folder, "clay.so", "s/mor_plugin_materials/hidden/");
    refuse(folder, "does not export 'mor_plugin_materials'");
    refuse(folder, "as a UMAT, is no plug-in, but named by a case");
    write_case(folder, strstr(clay_case, "title"));
    refuse(folder, "that of a plug-in where the case has plugins = [ \"./FILE.so\" ]");
}

/* In the particles under the largest stress, by any number of threads. */
static void plugin_that_crashes_ends_the_run_with_the_particle_named(void **state)
{
    run_folder *folder = *state;
    write_case(folder, clay_case);
    compile(folder, "clay.so",
            "s/double sum = 0.0;/double sum = batch->stress_in[6 * i + 1] < -500.0 ? *(volatile double *)8 : 0.0;/");
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "case.cfg", "-t", "2", "-o", "run", NULL}, 1);
    program_expect_text(outcome.errors, "the stress update of material 'undrained_clay' failed for particle ");
    program_expect_text(outcome.errors, "the code of the material crashed");
    program_clear(&outcome);
    expect_in_file(folder, "run", MOR_SUMMARY_FILE, "\"status\": \"failed\"");
    expect_in_file(folder, "run", MOR_SUMMARY_FILE, "\"set\": \"soil\"");
}

/* No folder of results holds such a number: what the update started from is kept instead. */
static void plugin_that_leaves_nan_ends_the_run_with_the_update_kept(void **state)
{
    run_folder *folder = *state;
    write_case(folder, clay_case);
    compile(folder, "clay.so", "s/!isfinite(sum + slip)/stress[0] += stress[1] < -500.0 ? NAN : 0.0, 0/");
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "case.cfg", "-t", "2", "-o", "run", NULL}, 1);
    program_expect_text(outcome.errors, "the stress update of material 'undrained_clay' failed for particle ");
    program_expect_text(outcome.errors, "the law reported success, but left numbers that are not finite");
    program_expect_text(outcome.errors, "run/failed-point.cfg, to be repeated alone");
    program_clear(&outcome);
    expect_in_file(folder, "run", "failed-point.cfg", "undrained_clay");
    outcome = program_run(folder, (const char *const[]){"material", "--replay", "run/failed-point.cfg", NULL}, 2);
    program_expect_text(outcome.errors, "'undrained_clay' is not known");
    program_expect_text(outcome.errors, "by --plugin FILE.so");
    program_clear(&outcome);
}

/* Crashes in the particles under the largest stress, when the integrator asks for one of them. */
static void rates_that_crash_end_the_run_by_every_method(void **state)
{
    run_folder *folder = *state;
    static const char *const methods[] = {"explicit", "implicit", "bdf"};
    static const char law[] = "viscoplastic_soil'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3; cohesion = '50 Pa';"
                              "friction_angle = '25 deg'; viscosity = '10 Pa s'; density = '1800 kg/m3'; ";
    char text[2 * sizeof clay_case];
    compile_template(folder, RATE_TEMPLATE, "clay.so",
                     "s/double mean = mor/double mean = batch->n == 1 \\&\\& stress[1] < -500.0"
                     " ? *(volatile double *)8 : mor/");
    for (int k = 0; k < 3; ++k) {
        const char *start = strstr(clay_case, "undrained_clay");
        snprintf(text, sizeof text, "%.*s%sintegration_method = '%s'; %s", (int)(start - clay_case), clay_case, law,
                 methods[k], strstr(start, "}; } );"));
        write_case(folder, text);
        program_outcome outcome = program_run(
            folder, (const char *const[]){"run", "case.cfg", "-t", k == 0 ? "2" : "1", "-o", methods[k], NULL}, 1);
        program_expect_text(outcome.errors, "the stress update of material 'viscoplastic_soil' failed for particle ");
        program_expect_text(outcome.errors, "the code of the material crashed");
        program_clear(&outcome);
    }
}

static void list_of_plugins_is_checked(void **state)
{
    run_folder *folder = *state;
    char text[sizeof clay_case + 64];
    static const struct {
        const char *list, *part;
    } cases[] = {
        {"plugins = './clay.so';", "allowed: a list of up to 16 paths"},
        {"plugins = [ 3 ];", "allowed: a path of up to"},
        {"plugins = [ './clay.so', './clay.so' ];", "twice"},
        {"plugins = [ ];", "undrained_clay"},
    };
    compile(folder, "clay.so", "");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        snprintf(text, sizeof text, "%s%s", cases[k].list, strchr(clay_case, ';') + 1);
        write_case(folder, text);
        refuse(folder, cases[k].part);
    }
}

static void list_of_materials_shows_a_plugin(void **state)
{
    run_folder *folder = *state;
    compile(folder, "clay.so", "");
    program_outcome outcome =
        program_run(folder, (const char *const[]){"list", "materials", "--plugin", "./clay.so", NULL}, 0);
    program_expect_text(outcome.output, "undrained_clay 1.0");
    program_expect_text(outcome.output, "undrained_strength");
    program_clear(&outcome);
    outcome = program_run(folder, (const char *const[]){"list", "materials", "--plugin", "./none.so", NULL}, 2);
    program_expect_text(outcome.errors, "found --plugin './none.so'");
    program_clear(&outcome);
}

int main(void)
{
#define PLUGIN_TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        PLUGIN_TEST(run_tells_path_version_and_content_of_its_plugins),
        PLUGIN_TEST(resolved_case_runs_to_the_same_bits),
        PLUGIN_TEST(resumed_run_has_the_bits_of_a_whole_one),
        PLUGIN_TEST(changed_plugin_is_refused_on_resume),
        PLUGIN_TEST(plugin_that_cannot_be_used_is_refused_with_its_place),
        PLUGIN_TEST(plugin_that_crashes_ends_the_run_with_the_particle_named),
        PLUGIN_TEST(plugin_that_leaves_nan_ends_the_run_with_the_update_kept),
        PLUGIN_TEST(rates_that_crash_end_the_run_by_every_method),
        PLUGIN_TEST(list_of_plugins_is_checked),
        PLUGIN_TEST(list_of_materials_shows_a_plugin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
