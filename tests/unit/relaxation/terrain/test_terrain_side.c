/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What lies beside a raster and states its reference system, its units or its place. */
#include "core/base/hash.h"
#include "relaxation/terrain/terrain.h"
#include "tests/common/run_folder.h"

static const char plane[] = "ncols 4\nnrows 3\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n"
                            "31 32 33 34\n21 22 23 24\n11 12 13 14\n";

/* Reads the plane with a text beside it in the file of this name, NULL: without. */
static mor_status read_beside(run_folder *folder, const char *name, const char *text, mor_terrain *terrain)
{
    char path[MOR_PATH_BYTES];
    char beside[MOR_PATH_BYTES];
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.path = run_folder_file(folder, path, "raster.asc");
    run_folder_store(path, plane, sizeof plane - 1);
    if (name != NULL) {
        run_folder_store(run_folder_file(folder, beside, name), text, strlen(text));
    }
    const mor_status status = mor_terrain_read(&folder->context, &request, terrain);
    if (name != NULL) {
        assert_int_equal(remove(beside), 0);
    }
    return status;
}

#define DEGREES                                                                                                        \
    "GEOGCS[\"W\",DATUM[\"W\",SPHEROID[\"W\",6378137,298.257223563]],PRIMEM[\"G\",0],UNIT[\"degree\",0.0174532925]]"
#define GRID(unit)                                                                                                     \
    "PROJCS[\"grid\"," DEGREES ",PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"             \
    "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"        \
    "PARAMETER[\"false_northing\",0],UNIT[" unit "]]"
#define METER "\"metre\",1"
#define FOOT "\"US survey foot\",0.304800609601219"
#define HEIGHTS(unit) "VERT_CS[\"NAVD88\",VERT_DATUM[\"NAVD 1988\",2005],UNIT[" unit "]]"
#define ESRI_HEIGHTS                                                                                                   \
    "VERTCS[\"NAVD88\",VDATUM[\"NAVD_1988\"],PARAMETER[\"Vertical_Shift\",0.0],PARAMETER[\"Direction\",1.0],"          \
    "UNIT[\"Foot_US\",0.3048006096012192]]"
#define OLD "Projection    UTM\nZone 32\nDatum         WGS84\n"

/* Whatever lies beside a raster and states its place or unit is looked at; meters are taken. */
static void systems_beside_a_raster_are_judged(void **state)
{
    run_folder *folder = *state;
    mor_context *context = &folder->context;
    static const struct {
        const char *name, *text, *words; /* words NULL: taken */
    } all[] = {
        {"raster.prj", GRID(METER), NULL},
        {"raster.prj", "\xef\xbb\xbf" GRID(METER) "\r\n", NULL},
        {"raster.prj", "COMPD_CS[\"both\"," GRID(METER) "," HEIGHTS(METER) "]", NULL},
        {"raster.prj", GRID(METER) HEIGHTS(METER), NULL},
        {"raster.prj", OLD "Zunits        METERS\nUnits         METERS\nParameters\n", NULL},
        {"raster.prj", OLD "Zunits        NO\nUnits         METERS\nParameters\n", NULL},
        {"raster.asc.aux.xml",
         "<PAMDataset><PAMRasterBand band=\"1\"><UnitType>m</UnitType></PAMRasterBand></PAMDataset>", NULL},
        {"raster.prj", "\xef\xbb\xbf" GRID(FOOT), "raster.prj: its coordinates are in units of 0.304801 m"},
        {"raster.PRJ", GRID(FOOT), "its coordinates are in units of 0.304801 m"},
        {"raster.prj", "\xef\xbb\xbf" DEGREES, "raster.prj: its coordinates are degrees"},
        {"raster.prj", "COMPD_CS[\"both\"," GRID(METER) "," HEIGHTS(FOOT) "]",
         "its heights are in units of 0.304801 m"},
        {"raster.prj", GRID(METER) "," ESRI_HEIGHTS, "its heights are in units of 0.304801 m"},
        {"raster.prj", GRID(METER) ESRI_HEIGHTS, "raster.prj: its heights are in units of 0.304801 m"},
        {"raster.prj", OLD "Zunits        FEET\nUnits         METERS\nParameters\n", "heights are in 'FEET' (Zunits)"},
        {"raster.prj", "EPSG:2277\n", "raster.prj: found 'EPSG:2277', which is not understood"},
        {"raster.prj", "garbage", "raster.prj: found 'garbage', which is not understood"},
        {"raster.prj", "", "raster.prj: found '', which is not understood"},
        {"raster.prj", "PROJCS[\"grid\"," DEGREES ",PROJECTION[\"Transverse", "raster.prj: found 'PROJCS[\"grid\""},
        {"raster.prj", GRID(METER) "rest", "raster.prj: found 'rest', which is not understood"},
        {"raster.asc.aux.xml",
         "<PAMDataset><PAMRasterBand band=\"1\"><UnitType>ft</UnitType></PAMRasterBand></PAMDataset>",
         "heights are in 'ft'"},
    };
    const size_t memory_bytes = context->memory_bytes;
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        mor_terrain terrain;
        mor_context_clear_error(context);
        const mor_status status = read_beside(folder, all[k].name, all[k].text, &terrain);
        const bool is_expected = all[k].words == NULL
                                     ? status == MOR_OK
                                     : status == MOR_ERROR_ARGUMENT && strstr(context->message, all[k].words) != NULL;
        if (!is_expected) {
            fail_msg("file %d: %d, %s", (int)k, status, context->message);
        }
        if (status == MOR_OK) {
            assert_true(strcmp(all[k].name, "raster.prj") != 0 || strstr(terrain.datum, "heights:") != NULL);
            mor_terrain_clear(context, &terrain);
        }
        assert_int_equal(context->memory_bytes, memory_bytes);
    }
}

/* The identity of a raster covers what lies beside it and says where it lies, not statistics. */
static void identity_covers_the_files_beside_a_raster(void **state)
{
    run_folder *folder = *state;
    mor_context *context = &folder->context;
    static const char *const texts[][2] = {{"raster.prj", GRID(METER)},
                                           {"raster.prj", GRID(METER) " "},
                                           {"raster.asc.aux.xml", "<PAMDataset><Metadata/></PAMDataset>"},
                                           {"raster.asc.aux.xml",
                                            "<PAMDataset><PAMRasterBand band=\"1\"><Scale>2</Scale>"
                                            "</PAMRasterBand></PAMDataset>"}};
    uint64_t hashes[5];
    mor_terrain terrain;
    assert_int_equal(read_beside(folder, NULL, NULL, &terrain), MOR_OK);
    hashes[4] = terrain.hash;
    assert_true(hashes[4] == mor_hash_bytes(plane, sizeof plane - 1));
    mor_terrain_clear(context, &terrain);
    for (int k = 0; k < 4; ++k) {
        assert_int_equal(read_beside(folder, texts[k][0], texts[k][1], &terrain), MOR_OK);
        hashes[k] = terrain.hash;
        mor_terrain_clear(context, &terrain);
    }
    assert_true(hashes[0] != hashes[4] && hashes[1] != hashes[4] && hashes[0] != hashes[1]);
    assert_true(hashes[2] == hashes[4] && hashes[3] != hashes[4]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(systems_beside_a_raster_are_judged, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(identity_covers_the_files_beside_a_raster, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
