/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "relaxation/terrain/terrain.h"
#include "relaxation/terrain/terrain_raster.h"
#include "tests/common/run_folder.h"

#include <math.h>

enum { COLUMNS = 5, ROWS = 3 };

static const char system_text[] = "PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[\"ETRS89\",DATUM[\"ETRS89\","
                                  "SPHEROID[\"GRS 1980\",6378137,298.257222101]],PRIMEM[\"Greenwich\",0],"
                                  "UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
                                  "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],"
                                  "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
                                  "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";

/* A raster with an odd corner and cell, and cells without data. */
static void make_raster(mor_terrain_raster *it, double *values, char *system)
{
    *it = (mor_terrain_raster){.corner = {691234.125 + 1.0 / 3.0, 5334567.3},
                               .cell = {0.7, 1.3},
                               .n = {COLUMNS, ROWS},
                               .system = system,
                               .values = values,
                               .name = "deposit",
                               .unit = "m",
                               .text = "Volume of soil at the end / area of the cell [m]"};
    for (int k = 0; k < COLUMNS * ROWS; ++k) {
        values[k] = k % 4 == 1 ? NAN : k / 7.0;
    }
}

static void a_raster_is_read_as_it_was_written(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char system[sizeof system_text];
    double values[COLUMNS * ROWS];
    mor_terrain_raster one;
    mor_terrain_raster other;
    memcpy(system, system_text, sizeof system);
    make_raster(&one, values, system);
    run_folder_file(folder, path, "map.tif");
    assert_int_equal(mor_terrain_raster_write(&folder->context, path, &one), MOR_OK);
    assert_int_equal(mor_terrain_raster_read(&folder->context, path, &other), MOR_OK);
    /* the corners of pixels coincide to the bit */
    assert_memory_equal(one.corner, other.corner, sizeof one.corner);
    assert_memory_equal(one.cell, other.cell, sizeof one.cell);
    assert_memory_equal(one.n, other.n, sizeof one.n);
    assert_string_equal(other.name, one.name);
    assert_string_equal(other.unit, one.unit);
    assert_string_equal(other.text, one.text);
    assert_non_null(strstr(other.system, "UTM zone 32N"));
    for (int k = 0; k < COLUMNS * ROWS; ++k) {
        assert_true(isnan(values[k]) ? isnan(other.values[k]) : other.values[k] == values[k]);
    }
    mor_terrain_raster_clear(&folder->context, &other);
}

static void the_same_raster_gives_the_same_bytes(void **state)
{
    run_folder *folder = *state;
    char path[2][MOR_PATH_BYTES];
    unsigned char *bytes[2];
    size_t n_bytes[2];
    double values[COLUMNS * ROWS];
    mor_terrain_raster it;
    make_raster(&it, values, NULL);
    for (int k = 0; k < 2; ++k) {
        run_folder_file(folder, path[k], k == 0 ? "one.tif" : "two.tif");
        assert_int_equal(mor_terrain_raster_write(&folder->context, path[k], &it), MOR_OK);
        bytes[k] = run_folder_load(path[k], &n_bytes[k]);
        assert_non_null(bytes[k]);
    }
    assert_int_equal(n_bytes[0], n_bytes[1]);
    assert_memory_equal(bytes[0], bytes[1], n_bytes[0]);
    free(bytes[0]);
    free(bytes[1]);
}

static void a_map_is_ground_again_at_the_same_place(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    double values[COLUMNS * ROWS];
    mor_terrain_raster it;
    mor_terrain terrain;
    mor_terrain_request request;
    make_raster(&it, values, NULL);
    for (int k = 0; k < COLUMNS * ROWS; ++k) {
        values[k] = k;
    }
    run_folder_file(folder, path, "ground.tif");
    assert_int_equal(mor_terrain_raster_write(&folder->context, path, &it), MOR_OK);
    mor_terrain_request_init(&request);
    request.path = path;
    assert_int_equal(mor_terrain_read(&folder->context, &request, &terrain), MOR_OK);
    assert_memory_equal(terrain.raster_corner, it.corner, sizeof it.corner);
    assert_memory_equal(terrain.raster_cell, it.cell, sizeof it.cell);
    /* the node nearest to the upper left corner has the first value */
    assert_true(terrain.heights[(ROWS - 1) * COLUMNS] == values[0] - terrain.offset[2]);
    mor_terrain_clear(&folder->context, &terrain);
}

static void what_is_no_raster_or_cannot_be_written_is_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    double values[COLUMNS * ROWS];
    mor_terrain_raster it;
    make_raster(&it, values, NULL);
    run_folder_file(folder, path, "nowhere/map.tif");
    assert_int_equal(mor_terrain_raster_write(&folder->context, path, &it), MOR_ERROR_IO);
    assert_int_equal(mor_terrain_raster_read(&folder->context, path, &it), MOR_ERROR_IO);
    run_folder_file(folder, path, "text.tif");
    run_folder_store(path, "no raster", 9);
    assert_int_equal(mor_terrain_raster_read(&folder->context, path, &it), MOR_ERROR_IO);
    assert_null(it.values);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_raster_is_read_as_it_was_written, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_same_raster_gives_the_same_bytes, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_map_is_ground_again_at_the_same_place, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_no_raster_or_cannot_be_written_is_refused, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
