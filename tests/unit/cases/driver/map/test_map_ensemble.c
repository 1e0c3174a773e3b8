/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_ensemble.h"
#include "relaxation/terrain/terrain_raster.h"
#include "tests/common/run_folder.h"

#include <math.h>

/* What the leak sanitizer is to ignore: Fontconfig keeps what it knows of fonts until the process ends. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

enum { RUNS = 4, CELLS = 6 };

/* Four runs on three by two cells: in cell k, k of them reach 2 m; the last two are nodes of their own. */
static const double depths[RUNS][CELLS] = {{NAN, 2.5, 2.0, 3.0, 9.0, NAN},
                                           {0.5, 1.0, 2.0, 3.0, 9.0, NAN},
                                           {0.5, NAN, 1.9, 3.0, 9.0, NAN},
                                           {0.5, 1.0, NAN, 1.0, 9.0, NAN}};

static void store_map_of(run_folder *folder, const char *run, const char *name, const double *values, double corner,
                         const char *settings, char *system)
{
    char path[MOR_PATH_BYTES];
    char file[64];
    double copy[CELLS];
    memcpy(copy, values, sizeof copy);
    mor_terrain_raster map = {
        .corner = {corner, 7.0}, .cell = {2.0, 2.0}, .n = {3, 2}, .system = system, .values = copy};
    snprintf(map.settings, sizeof map.settings, "%s", settings);
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, run)), MOR_OK);
    snprintf(file, sizeof file, "%s/maps", run);
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, file)), MOR_OK);
    snprintf(file, sizeof file, "%s/maps/%s.tif", run, name);
    assert_int_equal(mor_terrain_raster_write(&folder->context, run_folder_file(folder, path, file), &map), MOR_OK);
}

static void store_map(run_folder *folder, const char *run, const char *name, const double *values, double corner)
{
    store_map_of(folder, run, name, values, corner, "end 10 s", NULL);
}

/* Paths of the runs, with maps of that name. */
static void store_runs(run_folder *folder, const char *name, char paths[RUNS][MOR_PATH_BYTES], const char **folders)
{
    for (int k = 0; k < RUNS; ++k) {
        char run[16];
        snprintf(run, sizeof run, "run%d", k);
        store_map(folder, run, name, depths[k], 3.0);
        folders[k] = run_folder_file(folder, paths[k], run);
    }
}

static void the_interval_is_that_of_wilson(void **state)
{
    (void)state;
    static const struct {
        int k, n;
        double low, high;
    } known[] = {{0, 10, 0.0, 0.27753}, {1, 10, 0.01788, 0.40415}, {5, 10, 0.23659, 0.76341}, {10, 10, 0.72247, 1.0}};
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        double low = NAN;
        double high = NAN;
        mor_map_ensemble_interval(known[i].k, known[i].n, &low, &high);
        assert_true(fabs(low - known[i].low) <= 1e-5 && fabs(high - known[i].high) <= 1e-5); /* digits of the table */
    }
    /* the ends solve (share - p)^2 = z^2 p (1 - p) / n */
    for (int n = 1; n < 60; ++n) {
        for (int k = 0; k <= n; ++k) {
            double ends[2];
            mor_map_ensemble_interval(k, n, &ends[0], &ends[1]);
            for (int e = 0; e < 2; ++e) {
                const double p = ends[e];
                const double share = (double)k / n;
                const double z2 = 3.841458820694124; /* 95 % point of chi squared with one degree of freedom */
                assert_true(fabs((share - p) * (share - p) - z2 * p * (1.0 - p) / n) <= 1e-14);
            }
        }
    }
}

static void shares_are_counted_cell_by_cell(void **state)
{
    run_folder *folder = *state;
    static const char *const names[] = {"exceed-depth_max-low", "exceed-depth_max", "exceed-depth_max-high"};
    char paths[RUNS][MOR_PATH_BYTES];
    const char *folders[RUNS];
    char out[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    FILE *output = tmpfile();
    store_runs(folder, "depth_max", paths, folders);
    const mor_map_ensemble ensemble = {folders, RUNS, "depth_max", 2.0};
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, run_folder_file(folder, out, "out"), output),
                     MOR_OK);
    fclose(output);
    for (int part = 0; part < 3; ++part) {
        mor_terrain_raster map;
        char file[64];
        snprintf(file, sizeof file, "out/maps/%s.tif", names[part]);
        assert_int_equal(mor_terrain_raster_read(&folder->context, run_folder_file(folder, path, file), &map), MOR_OK);
        assert_true(map.corner[0] == 3.0 && map.corner[1] == 7.0 && map.cell[0] == 2.0);
        assert_string_equal(map.unit, "%");
        for (int k = 0; k < CELLS - 1; ++k) {
            double ends[2];
            mor_map_ensemble_interval(k, RUNS, &ends[0], &ends[1]);
            const double wanted = 100.0 * (part == 0 ? ends[0] : part == 2 ? ends[1] : (double)k / RUNS);
            assert_true(map.values[k] == wanted);
        }
        assert_true(isnan(map.values[CELLS - 1]));
        mor_terrain_raster_clear(&folder->context, &map);
    }
    assert_int_equal(access(run_folder_file(folder, path, "out/images/map-exceed-depth_max.png"), R_OK), 0);
}

static void arrivals_count_up_to_the_value(void **state)
{
    run_folder *folder = *state;
    char paths[RUNS][MOR_PATH_BYTES];
    const char *folders[RUNS];
    char path[MOR_PATH_BYTES];
    char out[MOR_PATH_BYTES];
    FILE *output = tmpfile();
    mor_terrain_raster map;
    store_runs(folder, "arrival", paths, folders);
    const mor_map_ensemble ensemble = {folders, RUNS, "arrival", 1.0};
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, run_folder_file(folder, out, "out"), output),
                     MOR_OK);
    fclose(output);
    run_folder_file(folder, path, "out/maps/exceed-arrival.tif");
    assert_int_equal(mor_terrain_raster_read(&folder->context, path, &map), MOR_OK);
    assert_true(map.values[0] == 75.0 && map.values[1] == 50.0 && map.values[2] == 0.0 && map.values[3] == 25.0);
    mor_terrain_raster_clear(&folder->context, &map);
}

static void runs_that_do_not_go_together_are_refused(void **state)
{
    run_folder *folder = *state;
    char paths[RUNS][MOR_PATH_BYTES];
    const char *folders[RUNS];
    char out[MOR_PATH_BYTES];
    FILE *output = tmpfile();
    store_runs(folder, "depth_max", paths, folders);
    run_folder_file(folder, out, "out");
    mor_map_ensemble ensemble = {folders, RUNS, "depht_max", 2.0};
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "allowed: deposit, erosion"));
    ensemble.map = "speed_max";
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "found no maps/speed_max.tif"));
    ensemble.map = "depth_max";
    ensemble.value = NAN;
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    ensemble.value = 2.0;
    store_map_of(folder, "run2", "depth_max", depths[2], 3.0, "end 20 s", NULL);
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "has end 10 s"));
    assert_non_null(strstr(folder->context.message, "has end 20 s; allowed"));
    store_map(folder, "run2", "depth_max", depths[2], 4.0);
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "maps on two grids"));
    char system[] = "LOCAL_CS[\"grid of a mine\",UNIT[\"metre\",1]]";
    store_map_of(folder, "run2", "depth_max", depths[2], 3.0, "end 10 s", system);
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "two reference systems"));
    assert_non_null(strstr(folder->context.message, "grid of a mine"));
    for (int k = 0; k < RUNS; ++k) { /* as earlier versions wrote them: of which end they are is not known */
        char run[16];
        snprintf(run, sizeof run, "run%d", k);
        store_map_of(folder, run, "depth_max", depths[k], 3.0, "", NULL);
    }
    assert_int_equal(mor_map_ensemble_write(&folder->context, &ensemble, out, output), MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "run0"));
    assert_non_null(strstr(folder->context.message, "resume the run"));
    fclose(output);
    assert_int_not_equal(access(out, F_OK), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_interval_is_that_of_wilson),
        cmocka_unit_test_setup_teardown(shares_are_counted_cell_by_cell, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(arrivals_count_up_to_the_value, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(runs_that_do_not_go_together_are_refused, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
