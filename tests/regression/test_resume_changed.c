/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

#include <math.h>

/* A run that goes on with a case that is not quite its own: what may differ and is used, what may not and is refused,
 * whether the folder still has its case file or not. */

#define CASE_FILE "case.resolved.cfg"

/* The case above, with an end and snapshots on a grid of 2^-7 s, which every end that is a whole number of them has. */
static const char *const grid[] = {"end=39.0625 ms", "output.snapshots=5"};
static const char *const longer_grid[] = {"end=54.6875 ms", "output.snapshots=7"};

/* Runs case.cfg into a folder with settings, ended by a NULL, and an exit code. */
static program_outcome run_with(run_folder *folder, const char *run, int exit_code, const char *const *options)
{
    const char *arguments[PROGRAM_ARGUMENTS_MAX] = {"run", "case.cfg", "-t", "1", "-o", run};
    int n = 6;
    for (; *options != NULL; ++options) {
        arguments[n++] = *options;
    }
    return program_run(folder, arguments, exit_code);
}

/* At least one option; NULL for none. */
#define RUN(folder, run, exit_code, ...)                                                                               \
    run_with((folder), (run), (exit_code), (const char *const[]){__VA_ARGS__, NULL})
#define RUN_QUIETLY(folder, run, ...) run_quietly((folder), (run), (const char *const[]){__VA_ARGS__, NULL})

static void run_quietly(run_folder *folder, const char *run, const char *const *options)
{
    program_outcome outcome = run_with(folder, run, 0, options);
    program_clear(&outcome);
}

static void remove_file(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    assert_int_equal(remove(finished_run_file(folder, path, run, name)), 0);
}

static void prepare_stopped(run_folder *folder)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    RUN_QUIETLY(folder, "run", "--stop-at", "20 ms");
}

static void expect_refusal(run_folder *folder, const char *setting, const char *difference)
{
    program_outcome outcome = RUN(folder, "run", 2, "--resume", "--set", setting);
    program_expect_text(outcome.errors, "is not the one that 'run' was started with; first difference: ");
    program_expect_text(outcome.errors, difference);
    program_clear(&outcome);
}

static void other_case_is_refused_without_the_case_file(void **state)
{
    run_folder *folder = *state;
    prepare_stopped(folder);
    remove_file(folder, "run", CASE_FILE);
    expect_refusal(folder, "soil[0].material.friction_angle=30 deg", "friction_angle");
    expect_refusal(folder, "numerics.courant=0.2", "numerics.courant = 0.2, was numerics.courant = 0.6");
    expect_refusal(folder, "seed=2", "seed = 2, was seed = 1");
    expect_refusal(folder, "walls[1].velocity=(\"0.5 m/s\", 0, 0)", "walls[1].velocity");
}

static void same_case_gets_its_missing_or_damaged_file_back(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_before = 0;
    size_t n_after = 0;
    prepare_stopped(folder);
    RUN_QUIETLY(folder, "whole", NULL);
    char *before = (char *)run_folder_load(finished_run_file(folder, path, "run", CASE_FILE), &n_before);
    remove_file(folder, "run", CASE_FILE);
    RUN_QUIETLY(folder, "run", "--resume", "--stop-at", "40 ms");
    char *after = (char *)run_folder_load(finished_run_file(folder, path, "run", CASE_FILE), &n_after);
    assert_non_null(after);
    assert_string_equal(before, after);
    free(after);
    run_folder_store(path, "nonsense {", 10);
    RUN_QUIETLY(folder, "run", "--resume");
    after = (char *)run_folder_load(path, &n_after);
    assert_string_equal(before, after);
    free(before);
    free(after);
    finished_run_compare(folder, "whole", "run");
}

/* 1 is the default of seed; the case is the same. */
static void value_given_as_its_default_is_the_same_case(void **state)
{
    run_folder *folder = *state;
    prepare_stopped(folder);
    RUN_QUIETLY(folder, "whole", NULL);
    RUN_QUIETLY(folder, "run", "--resume", "--set", "seed=1", "--set", "numerics.courant=0.6");
    finished_run_compare(folder, "whole", "run");
}

static void run_made_longer_is_the_run_that_was_longer_from_the_start(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    RUN_QUIETLY(folder, "whole", "--set", longer_grid[0], "--set", longer_grid[1], "--set",
                "output.series_interval=1e-3");
    RUN_QUIETLY(folder, "run", "--set", grid[0], "--set", grid[1], "--set", "output.series_interval=1e-3", "--stop-at",
                "20 ms");
    RUN_QUIETLY(folder, "run", "--set", longer_grid[0], "--set", longer_grid[1], "--set", "output.series_interval=1e-3",
                "--resume");
    char hash_a[32];
    char hash_b[32];
    finished_run_read_hash(folder, "whole", hash_a);
    finished_run_read_hash(folder, "run", hash_b);
    assert_string_equal(hash_a, hash_b);
    finished_run_compare_bytes(folder, "whole", "run", MOR_TABLE_SERIES_FILE);
}

/* A run that is over goes on, too, also beyond the power of two that its ticks were made for. */
static void finished_run_goes_on_to_a_later_end(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_table_data series;
    prepare_stopped(folder);
    RUN_QUIETLY(folder, "run", "--resume");
    RUN_QUIETLY(folder, "run", "--resume", "--set", "end=90 ms", "--set", "output.snapshots=9");
    finished_run_file(folder, path, "run", MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &series, path), MOR_OK);
    const double last = series.values[(series.n_rows - 1) * series.n_columns];
    assert_true(fabs(last - 0.09) < 1e-12); /* a whole number of ticks of 2^-56 s */
    mor_table_data_clear(&folder->context, &series);
    program_outcome outcome = RUN(folder, "run", 2, "--resume", "--set", "end=80 ms");
    program_expect_text(outcome.errors, "found end = 0.08 s, but the run stands at t = 0.09 s");
    program_clear(&outcome);
}

static void domain_may_become_larger_only(void **state)
{
    run_folder *folder = *state;
    prepare_stopped(folder);
    expect_refusal(folder, "domain.max=(\"0.39 m\", \"0.3 m\", \"1 m\")", "the domain can only become larger");
    expect_refusal(folder, "domain.min=(\"-0.1 m\", \"-0.04 m\", \"-1 m\")", "the domain can only become larger");
    RUN_QUIETLY(folder, "run", "--resume", "--set", "domain.max=(\"0.6 m\", \"0.5 m\", \"1 m\")");
}

/* The stiffness of contacts is that of the bodies, so that a larger domain changes nothing in the middle of a run. */
static void domain_may_grow_around_bodies(void **state)
{
    static const char text[] =
        "dimension = 3; spacing = 0.2; end = 0.02; gravity = (0, 0, -10);"
        "domain = { min = (-3, -3, -3); max = (3, 3, 3); };"
        "bodies = ( { name = 'ball'; shape = { type = 'sphere'; center = (0, 0, 0); radius = 1; };"
        "  material = { model = 'rigid'; density = 2500; }; } );"
        "output = { snapshots = 1; pictures = false; };";
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    RUN_QUIETLY(folder, "run", "--stop-at", "0.01");
    RUN_QUIETLY(folder, "run", "--resume", "--set", "domain.max=(4, 3, 3)");
}

/* The domain ends 0.2 of a cell, and 0.6 of one, later: the number of cells is the same, their places are not. */
static void maps_are_not_moved_by_a_larger_domain(void **state)
{
    static const char text[] =
        "dimension = 3; spacing = '0.1 m'; gravity = (0, 0, -9.81); end = '0.02 s';"
        "domain = { min = (-1, -1, -1); max = (1.6, 1.6, 2); };"
        "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0, 0); max = (0.5, 0.5, 0.5); };"
        "  initial_stress = { type = 'k0'; }; material = { model = 'drucker_prager'; density = 1900;"
        "    youngs_modulus = '1 MPa'; poissons_ratio = 0.3; friction_angle = '40 deg'; cohesion = '50 kPa'; }; } );"
        "walls = ( { name = 'floor'; friction = 'rough';"
        "    shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 0, 1); }; } );"
        "output = { pictures = false; snapshots = 2; };";
    static const char *const wishes[] = {
        "maps = { cell = '0.5 m'; };",
        "gauges = ( { name = 'floor'; wall = 'floor'; direction = (0, 0, -1); cell = '1 m'; } );"};
    static const char *const found[] = {"found maps that begin at (-1.3, -1) m, but at (-1, -1) m",
                                        "found a map of pressure of gauge 'floor' that begins"};
    run_folder *folder = *state;
    for (int k = 0; k < 2; ++k) {
        char path[MOR_PATH_BYTES];
        char whole[2048];
        const char *run = k == 0 ? "maps" : "gauge";
        snprintf(whole, sizeof whole, "%s%s", text, wishes[k]);
        finished_run_store_text(folder, whole, path);
        RUN_QUIETLY(folder, run, "--stop-at", "10 ms");
        program_outcome outcome = RUN(folder, run, 2, "--resume", "--set", "domain.min=(-1.3, -1, -1)");
        program_expect_text(outcome.errors, found[k]);
        program_clear(&outcome);
    }
}

/* Earlier rows have empty cells in the new column, and are otherwise as they were. */
static void probe_may_be_added(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_table_data before;
    mor_table_data after;
    prepare_stopped(folder);
    finished_run_file(folder, path, "run", MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &before, path), MOR_OK);
    char *text = strdup(finished_run_case);
    char *at = strstr(text, "{ type = 'stress_noise'; }");
    assert_non_null(at);
    char more[sizeof finished_run_case + 64];
    snprintf(more, sizeof more, "%.*s{ type = 'stress_noise'; }, { type = 'mass'; }%s", (int)(at - text), text,
             at + strlen("{ type = 'stress_noise'; }"));
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, more, case_path);
    RUN_QUIETLY(folder, "run", "--resume");
    assert_int_equal(mor_table_data_read(&folder->context, &after, path), MOR_OK);
    assert_int_equal(after.n_columns, before.n_columns + 1);
    assert_true(after.n_rows > before.n_rows);
    for (int64_t row = 0; row < after.n_rows; ++row) {
        const double mass = after.values[row * after.n_columns + after.n_columns - 1];
        if (row < before.n_rows) {
            assert_memory_equal(after.values + row * after.n_columns, before.values + row * before.n_columns,
                                (size_t)before.n_columns * sizeof(double));
            assert_true(isnan(mass));
        } else {
            assert_true(fabs(mass - 36.0) < 1e-9); /* 0.15 m x 0.12 m of 2000 kg/m3 */
        }
    }
    mor_table_data_clear(&folder->context, &before);
    mor_table_data_clear(&folder->context, &after);
    free(text);
}

static void energy_audit_cannot_begin_later(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char *text = strdup(finished_run_case);
    char *at = strstr(text, "'stress_noise'");
    char more[sizeof finished_run_case + 64];
    prepare_stopped(folder);
    snprintf(more, sizeof more, "%.*s'stress_noise'; }, { type = 'energy_balance'%s", (int)(at - text), text,
             at + strlen("'stress_noise'"));
    finished_run_store_text(folder, more, case_path);
    program_outcome outcome = RUN(folder, "run", 2, "--resume");
    program_expect_text(outcome.errors, "the audit of energy begins at the start of a run");
    program_clear(&outcome);
    free(text);
}

/* What looks back to the start has nothing to look back on, whether or not the audit of energy was there. */
static void probe_of_the_whole_run_cannot_begin_later(void **state)
{
    static const char text[] =
        "dimension = 2; spacing = '10 mm'; end = '20 ms'; gravity = (0, -9.81);"
        "domain = { min = (-0.1, -0.1); max = (0.4, 0.3); };"
        "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.1, 0.05); };"
        "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
        "    friction_angle = '25 deg'; cohesion = '0.1 kPa'; }; } );"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "bodies = ( { name = 'rock'; shape = { type = 'sphere'; center = (0.05, 0.1); radius = 0.03; };"
        "  material = { model = 'rigid'; density = 2600; }; } );"
        "probes = ( { type = 'plastic_energy'; }%s );"
        "output = { snapshots = 1; pictures = false; };";
    static const char *const added[] = {", { type = 'penetration_depth_largest'; body = 'rock'; }",
                                        ", { type = 'energy_balance'; }"};
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char whole[sizeof text + 64];
    snprintf(whole, sizeof whole, text, "");
    finished_run_store_text(folder, whole, case_path);
    RUN_QUIETLY(folder, "run", "--stop-at", "10 ms");
    for (int k = 0; k < 2; ++k) {
        snprintf(whole, sizeof whole, text, added[k]);
        finished_run_store_text(folder, whole, case_path);
        program_outcome outcome = RUN(folder, "run", 2, "--resume");
        program_expect_text(outcome.errors,
                            "first difference: a probe that looks back to the start among 2, was 1 probes");
        program_clear(&outcome);
    }
}

/* A cube of 1 m whose corners lie in cube.bin. */
static void store_cube(run_folder *folder, float size)
{
    static const unsigned char triangles[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":168,\"uri\":\"cube.bin\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":96},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,1]},{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],\"scene\":0}";
    char path[MOR_PATH_BYTES];
    char bytes[168];
    for (int k = 0; k < 8; ++k) {
        const float corner[3] = {(k + 1) % 4 < 2 ? 0.0f : size, k % 4 < 2 ? 0.0f : size, k < 4 ? 0.0f : size};
        memcpy(bytes + 12 * k, corner, sizeof corner);
    }
    for (int k = 0; k < 36; ++k) {
        const uint16_t index = triangles[k];
        memcpy(bytes + 96 + 2 * k, &index, sizeof index);
    }
    run_folder_store(run_folder_file(folder, path, "cube.bin"), bytes, sizeof bytes);
    run_folder_store(run_folder_file(folder, path, "cube.gltf"), json, sizeof json - 1);
}

static void changed_buffer_of_a_mesh_is_another_case(void **state)
{
    static const char text[] =
        "dimension = 3; spacing = 0.2; end = 0.02; gravity = (0, 0, -10);"
        "domain = { min = (-3, -3, -3); max = (3, 3, 3); };"
        "bodies = ( { name = 'cube'; shape = { type = 'mesh'; file = 'cube.gltf'; }; particles = 'lattice';"
        "  material = { model = 'rigid'; density = 2500; }; } );"
        "output = { snapshots = 1; pictures = false; };";
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    store_cube(folder, 1.0f);
    RUN_QUIETLY(folder, "run", "--stop-at", "0.01");
    store_cube(folder, 1.25f);
    program_outcome outcome = RUN(folder, "run", 2, "--resume");
    program_expect_text(outcome.errors, "bodies[0].shape.content of its file");
    program_expect_text(outcome.errors, "the file has changed since");
    program_clear(&outcome);
    store_cube(folder, 1.0f);
    RUN_QUIETLY(folder, "run", "--resume");
}

/* A file that says where the raster lies or in what belongs to it. */
static void changed_file_beside_a_raster_is_another_case(void **state)
{
    static const char text[] =
        "dimension = 3; spacing = 0.2; end = 0.02; gravity = (0, 0, -10);"
        "domain = { min = (1, 1, -1); max = (4, 4, 3); };"
        "walls = ( { name = 'ground'; shape = { type = 'terrain'; file = 'g.asc'; offset = (0, 0, 0); }; } );"
        "bodies = ( { name = 'cube'; shape = { type = 'box'; min = (2, 2, 1); max = (3, 3, 2); };"
        "  particles = 'lattice'; material = { model = 'rigid'; density = 2500; }; } );"
        "output = { snapshots = 1; pictures = false; };";
    static const char raster[] = "ncols 5\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                                 "0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n";
    static const char *const systems[] = {"LOCAL_CS[\"site\",UNIT[\"metre\",1]]",
                                          "LOCAL_CS[\"other\",UNIT[\"metre\",1]]"};
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    run_folder_store(run_folder_file(folder, path, "g.asc"), raster, sizeof raster - 1);
    run_folder_store(run_folder_file(folder, path, "g.prj"), systems[0], strlen(systems[0]));
    RUN_QUIETLY(folder, "run", "--stop-at", "0.01");
    run_folder_store(path, systems[1], strlen(systems[1]));
    program_outcome outcome = RUN(folder, "run", 2, "--resume");
    program_expect_text(outcome.errors, "walls[0].shape.content of its file");
    program_expect_text(outcome.errors, "the file has changed since");
    program_clear(&outcome);
    run_folder_store(path, systems[0], strlen(systems[0]));
    RUN_QUIETLY(folder, "run", "--resume");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(other_case_is_refused_without_the_case_file),
        TEST(same_case_gets_its_missing_or_damaged_file_back),
        TEST(value_given_as_its_default_is_the_same_case),
        TEST(run_made_longer_is_the_run_that_was_longer_from_the_start),
        TEST(finished_run_goes_on_to_a_later_end),
        TEST(domain_may_become_larger_only),
        TEST(domain_may_grow_around_bodies),
        TEST(maps_are_not_moved_by_a_larger_domain),
        TEST(probe_may_be_added),
        TEST(energy_audit_cannot_begin_later),
        TEST(probe_of_the_whole_run_cannot_begin_later),
        TEST(changed_buffer_of_a_mesh_is_another_case),
        TEST(changed_file_beside_a_raster_is_another_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
