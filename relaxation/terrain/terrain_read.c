/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/terrain/terrain_internal.h"
#include "relaxation/terrain/terrain_raster.h"

#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/base/process_lock.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* The only file that calls GDAL. Only the drivers named here are registered: none of them accesses a network. */

/* A share of a cell by which a crop may miss a node and still keep it. */
#define ON_NODE 1e-9

/* Formats whose files GDAL can list: their hash then covers all that was read. */
static const char *const drivers[] = {"GTiff", "AAIGrid", "GRASSASCIIGrid", "SRTMHGT", "GSAG", "GSBG", "GS7BG", NULL};

/* An open raster and its header. */
typedef struct raster {
    const char *path;
    GDALDatasetH dataset;
    GDALRasterBandH band;
    double corner[2]; /* x of the left and y of the upper edge, m */
    double first[2];  /* of the first node along x and of the one with least y, m */
    double cell[2];   /* m */
    int n[2];         /* nodes */
    int window[2][2]; /* first and last node kept, along x and upwards */
    mor_terrain_format format;
    mor_terrain_prj prj;
    bool is_downward; /* row 0 of the file has the largest y */
} raster;

/* They belong to the process; each is added once. */
static void register_drivers(void)
{
    mor_process_lock();
    GDALRegister_GTiff();
    GDALRegister_AAIGrid();
    GDALRegister_GRASSASCIIGrid();
    GDALRegister_SRTMHGT();
    GDALRegister_GSAG();
    GDALRegister_GSBG();
    GDALRegister_GS7BG();
    mor_process_unlock();
}

/* Nothing is printed or downloaded. For a file open for reading only, without statistics, no side files are
 * written; existing ones (.aux.xml) are read: they may state units, scales and missing data. */
static void enter_gdal(void)
{
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLSetThreadLocalConfigOption("AAIGRID_DATATYPE", "Float64");  /* else nan among whole numbers reads as zero */
    CPLSetThreadLocalConfigOption("GTIFF_REPORT_COMPD_CS", "YES"); /* else GeoTIFF hides the datum of heights */
    OSRSetPROJEnableNetwork(0);
    register_drivers();
}

static void leave_gdal(void)
{
    CPLErrorReset();
    CPLPopErrorHandler();
}

/* A file of this machine, not one of GDAL's names for archives, memory or the network. */
static mor_status check_file(mor_context *context, const char *path)
{
    struct stat status;
    MOR_CHECK(context, strncmp(path, "/vsi", 4) != 0 && strstr(path, "://") == NULL, MOR_ERROR_IO,
              "%s: found the name of a virtual or remote file; allowed are files of this machine: fetch or unpack it",
              path);
    MOR_CHECK(context, stat(path, &status) == 0, MOR_ERROR_IO,
              "%s: no such file; give the path of a raster (GeoTIFF, ESRI ASCII, ...)", path);
    MOR_CHECK(context, S_ISREG(status.st_mode), MOR_ERROR_IO, "%s: is no file; give the path of a raster", path);
    MOR_CHECK(context, status.st_size > 0, MOR_ERROR_IO, "%s: is empty; give a raster (GeoTIFF, ESRI ASCII, ...)",
              path);
    return MOR_OK;
}

static mor_terrain_format find_format(const char *driver)
{
    return strcmp(driver, "AAIGrid") == 0          ? MOR_TERRAIN_ESRI
           : strcmp(driver, "GRASSASCIIGrid") == 0 ? MOR_TERRAIN_GRASS
           : strcmp(driver, "GSAG") == 0           ? MOR_TERRAIN_SURFER
                                                   : MOR_TERRAIN_BINARY;
}

static mor_status open_raster(mor_context *context, raster *it)
{
    CPLErrorReset();
    it->dataset = GDALOpenEx(it->path, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, NULL, NULL);
    MOR_CHECK(context, it->dataset != NULL, MOR_ERROR_IO,
              "%s: cannot be read as a raster (%s); allowed are GeoTIFF, ESRI and GRASS ASCII, SRTM (.hgt) "
              "and Surfer grids: convert it with gdal_translate",
              it->path, CPLGetLastErrorMsg()[0] != '\0' ? CPLGetLastErrorMsg() : "no known format");
    MOR_CHECK(context, GDALGetRasterCount(it->dataset) >= 1, MOR_ERROR_IO, "%s: the raster holds no band", it->path);
    it->format = find_format(GDALGetDriverShortName(GDALGetDatasetDriver(it->dataset)));
    it->band = GDALGetRasterBand(it->dataset, 1);
    it->n[0] = GDALGetRasterXSize(it->dataset);
    it->n[1] = GDALGetRasterYSize(it->dataset);
    const GDALColorInterp color = GDALGetRasterColorInterpretation(it->band);
    MOR_CHECK(
        context,
        color != GCI_RedBand && color != GCI_PaletteIndex && !GDALDataTypeIsComplex(GDALGetRasterDataType(it->band)),
        MOR_ERROR_ARGUMENT, "%s: holds a picture or complex numbers, not heights; give an elevation raster", it->path);
    if (GDALGetRasterCount(it->dataset) > 1) {
        mor_context_log(context, MOR_LOG_WARNING, "%s: %d bands found; heights are taken from the first", it->path,
                        GDALGetRasterCount(it->dataset));
    }
    return MOR_OK;
}

/* Where the nodes lie; squares along x and y only. */
static mor_status place_raster(mor_context *context, raster *it)
{
    double map[6];
    MOR_CHECK(context, GDALGetGeoTransform(it->dataset, map) == CE_None, MOR_ERROR_ARGUMENT,
              "%s: has no georeference of its cells; add it with gdal_translate -a_ullr left top right bottom",
              it->path);
    for (int k = 0; k < 6; ++k) {
        MOR_CHECK(context, isfinite(map[k]), MOR_ERROR_ARGUMENT, "%s: its georeference is not finite", it->path);
    }
    MOR_CHECK(
        context, map[2] == 0.0 && map[4] == 0.0 && map[1] > 0.0 && map[5] != 0.0, MOR_ERROR_ARGUMENT,
        "%s: is rotated, mirrored or has cells without size (cell steps (%g, %g) and (%g, %g)); allowed are rasters "
        "along the axes: rotate it with gdalwarp",
        it->path, map[1], map[4], map[2], map[5]);
    it->is_downward = map[5] < 0.0;
    it->cell[0] = map[1];
    it->cell[1] = fabs(map[5]);
    it->corner[0] = map[0];
    it->corner[1] = it->is_downward ? map[3] : map[3] + it->n[1] * map[5];
    it->first[0] = map[0] + 0.5 * it->cell[0];
    it->first[1] = (it->is_downward ? map[3] + it->n[1] * map[5] : map[3]) + 0.5 * it->cell[1];
    return MOR_OK;
}

/* Coordinates and heights must be in meters. place: of the file that states the system. */
static mor_status check_system(mor_context *context, const char *place, OGRSpatialReferenceH system)
{
    const char *name = OSRGetName(system);
    name = name != NULL ? name : "unnamed";
    MOR_CHECK(context, !OSRIsGeographic(system), MOR_ERROR_ARGUMENT,
              "%s: its coordinates are degrees (%s); allowed are meters: project it with gdalwarp -t_srs EPSG:<code of "
              "the local map grid>",
              place, name);
    const bool has_heights = OSRIsVertical(system);
    const double meters = has_heights && !OSRIsCompound(system) ? 1.0 : OSRGetLinearUnits(system, NULL);
    MOR_CHECK(context, meters == 1.0, MOR_ERROR_ARGUMENT,
              "%s: its coordinates are in units of %g m (%s); allowed are meters: project it with gdalwarp -t_srs",
              place, meters, name);
    const double height = has_heights ? OSRGetTargetLinearUnits(system, "VERT_CS", NULL) : 1.0;
    MOR_CHECK(context, height == 1.0, MOR_ERROR_ARGUMENT,
              "%s: its heights are in units of %g m (%s); allowed are meters: convert them with gdal_calc.py, and "
              "correct their unit",
              place, height, name);
    return MOR_OK;
}

/* The system that maps are given later; one that has no well-known text is left out. */
static mor_status keep_system(mor_context *context, OGRSpatialReferenceH system, mor_terrain *terrain)
{
    char *text = NULL;
    mor_status status = MOR_OK;
    if (OSRExportToWkt(system, &text) == OGRERR_NONE && text != NULL && text[0] != '\0') {
        status = mor_terrain_copy_text(context, text, &terrain->system);
    }
    CPLFree(text);
    return status;
}

static mor_status describe_system(mor_context *context, OGRSpatialReferenceH system, mor_terrain *terrain)
{
    const char *name = OSRGetName(system);
    const char *vertical = OSRGetAttrValue(system, "VERT_CS", 0);
    snprintf(terrain->datum, sizeof terrain->datum, "%s; heights: %s", name != NULL ? name : "unnamed",
             vertical != NULL ? vertical : "datum not given");
    return keep_system(context, system, terrain);
}

/* Parses a reference system. */
static OGRErr parse_system(OGRSpatialReferenceH system, char *text, bool is_keywords)
{
    if (!is_keywords) {
        return OSRImportFromWkt(system, &(char *){text});
    }
    char **lines = CSLTokenizeString2(text, "\r\n", 0);
    const OGRErr error = OSRImportFromESRI(system, lines);
    CSLDestroy(lines);
    return error;
}

/* One statement of a .prj; the first one is reported as text if the raster itself has no system. */
static mor_status check_statement(mor_context *context, const mor_terrain_prj *prj, char *text, mor_terrain *terrain)
{
    enum { SHOWN = 40 };
    OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
    const bool is_bad = system == NULL || parse_system(system, text, prj->is_keywords) != OGRERR_NONE;
    mor_status status = MOR_OK;
    if (!is_bad) {
        status = check_system(context, prj->path, system);
        if (status == MOR_OK && terrain->datum[0] == '\0') {
            status = describe_system(context, system, terrain);
        }
    }
    OSRDestroySpatialReference(system);
    const int n_shown = (int)strcspn(text, "\r\n");
    MOR_CHECK(
        context, !is_bad, MOR_ERROR_ARGUMENT,
        "%s: found '%.*s%s', which is not understood as a reference system; allowed is one in full, as gdalsrsinfo "
        "-o wkt1 EPSG:<code> prints it: replace the file, or remove it if the raster is in meters",
        prj->path, n_shown < SHOWN ? n_shown : SHOWN, text, strlen(text) > SHOWN ? "..." : "");
    return status;
}

static mor_status read_prj(mor_context *context, const mor_terrain_prj *prj, mor_terrain *terrain)
{
    if (prj->path[0] == '\0') {
        return MOR_OK;
    }
    MOR_TRY(context, check_statement(context, prj, prj->first, terrain));
    if (prj->rest[0] != '\0') {
        MOR_TRY(context, check_statement(context, prj, prj->rest, terrain));
    }
    return MOR_OK;
}

/* Text of the reference system, which must be in meters. */
static mor_status read_datum(mor_context *context, const raster *it, mor_terrain *terrain)
{
    const char *unit = GDALGetRasterUnitType(it->band);
    OGRSpatialReferenceH system = GDALGetSpatialRef(it->dataset);
    MOR_CHECK(context, unit == NULL || unit[0] == '\0' || strcmp(unit, "m") == 0 || EQUALN(unit, "met", 3),
              MOR_ERROR_ARGUMENT, "%s: heights are in '%s'; allowed are meters: convert them with gdal_calc.py",
              it->path, unit);
    terrain->datum[0] = '\0';
    if (system != NULL) {
        MOR_TRY(context, check_system(context, it->path, system));
        MOR_TRY(context, describe_system(context, system, terrain));
    }
    MOR_TRY(context, read_prj(context, &it->prj, terrain));
    if (terrain->datum[0] == '\0') {
        mor_context_log(context, MOR_LOG_INFO, "%s: names no reference system; coordinates and heights taken as meters",
                        it->path);
    }
    return MOR_OK;
}

/* The hash of a single file; of several, of their hashes in order. */
static mor_status hash_files(mor_context *context, const raster *it, uint64_t *value)
{
    mor_hash all;
    uint64_t one = 0;
    int n_files = 1;
    mor_hash_init(&all);
    MOR_TRY(context, mor_hash_file(context, it->path, value));
    mor_hash_add(&all, value, sizeof *value);
    char **files = GDALGetFileList(it->dataset);
    mor_status status = MOR_OK;
    for (int k = 0; files != NULL && files[k] != NULL && status == MOR_OK; ++k) {
        if (strcmp(files[k], it->path) == 0 || strcmp(files[k], it->prj.path) == 0 ||
            !mor_terrain_side_is_relevant(files[k])) {
            continue;
        }
        status = mor_hash_file(context, files[k], &one);
        mor_hash_add(&all, &one, sizeof one);
        n_files += 1;
    }
    CSLDestroy(files);
    MOR_TRY(context, status);
    if (it->prj.path[0] != '\0') {
        MOR_TRY(context, mor_hash_file(context, it->prj.path, &one));
        mor_hash_add(&all, &one, sizeof one);
        n_files += 1;
    }
    *value = n_files > 1 ? mor_hash_value(&all) : *value;
    return MOR_OK;
}

/* Nodes inside the crop. */
static mor_status find_window(mor_context *context, const mor_terrain_request *request, raster *it)
{
    for (int a = 0; a < 2; ++a) {
        const double low = ceil((request->crop_minimum[a] - it->first[a]) / it->cell[a] - ON_NODE);
        const double high = floor((request->crop_maximum[a] - it->first[a]) / it->cell[a] + ON_NODE);
        const double from = fmax(low, 0.0);
        const double to = fmin(high, it->n[a] - 1.0);
        MOR_CHECK(
            context, to - from >= 1.0, MOR_ERROR_ARGUMENT,
            "%s: %g of its %d nodes along %c are kept; allowed are two or more: the raster reaches from %g m to %g "
            "m; widen the crop",
            it->path, fmax(to - from + 1.0, 0.0), it->n[a], "xy"[a], it -> first[a],
            it -> first[a] + (it->n[a] - 1) * it -> cell[a]);
        it->window[a][0] = (int)from;
        it->window[a][1] = (int)to;
    }
    const double n[2] = {it->window[0][1] - it->window[0][0] + 1.0, it->window[1][1] - it->window[1][0] + 1.0};
    MOR_CHECK(context, n[0] * n[1] <= MOR_TERRAIN_NODES_MAX, MOR_ERROR_ARGUMENT,
              "%s: has %g x %g nodes; allowed are %g in all: crop it, or resample it with gdalwarp -tr", it->path, n[0],
              n[1], MOR_TERRAIN_NODES_MAX);
    return MOR_OK;
}

/* One row of the file into one row of the terrain, in meters, NaN where there is no data. */
static mor_status read_row(mor_context *context, const raster *it, int file_row, double *heights)
{
    int has_mark = 0;
    int has_scale = 0;
    int has_shift = 0;
    const double mark = GDALGetRasterNoDataValue(it->band, &has_mark);
    const double scale = GDALGetRasterScale(it->band, &has_scale);
    const double shift = GDALGetRasterOffset(it->band, &has_shift);
    const int n = it->window[0][1] - it->window[0][0] + 1;
    CPLErrorReset();
    const CPLErr error =
        GDALRasterIO(it->band, GF_Read, it->window[0][0], file_row, n, 1, heights, n, 1, GDT_Float64, 0, 0);
    MOR_CHECK(context, error == CE_None, MOR_ERROR_IO,
              "%s: row %d of %d cannot be read (%s); the file is truncated or damaged: get it again", it->path,
              file_row + 1, it->n[1], CPLGetLastErrorMsg());
    for (int k = 0; k < n; ++k) {
        /* Rasters in single precision have the missing-data value rounded to it. */
        const bool is_mark = has_mark && (heights[k] == mark || (float)heights[k] == (float)mark);
        const double height = heights[k] * (has_scale ? scale : 1.0) + (has_shift ? shift : 0.0);
        MOR_CHECK(context, is_mark || !isinf(height), MOR_ERROR_ARGUMENT,
                  "%s: row %d, column %d: found an infinite height; allowed are finite ones: correct it, or declare "
                  "infinity as the missing-data value with gdal_edit.py -a_nodata",
                  it->path, file_row + 1, it->window[0][0] + k + 1);
        heights[k] = is_mark ? NAN : height;
    }
    return MOR_OK;
}

/* In the order of the file, and text from its first row on: GDAL seeks a row of text by recursion over those before. */
static mor_status read_heights(mor_context *context, const raster *it, mor_terrain *terrain)
{
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    MOR_TRY(context, MOR_NEW(context, &terrain->heights, n_nodes, "terrain heights"));
    const int first = it->is_downward ? it->n[1] - 1 - it->window[1][1] : it->window[1][0];
    for (int file_row = it->format != MOR_TERRAIN_BINARY ? 0 : first; file_row < first + terrain->n_y; ++file_row) {
        /* A row before the window is read into the place of the first one of the window, which comes later. */
        const int place = file_row > first ? file_row - first : 0;
        const int row = it->is_downward ? terrain->n_y - 1 - place : place;
        MOR_TRY(context, read_row(context, it, file_row, terrain->heights + (int64_t)row * terrain->n_x));
    }
    return MOR_OK;
}

static mor_status fill_holes(mor_context *context, const mor_terrain_request *request, const raster *it,
                             mor_terrain *terrain)
{
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    int64_t n_holes = 0;
    int64_t first = -1;
    for (int64_t n = 0; n < n_nodes; ++n) {
        if (isnan(terrain->heights[n]) && n_holes++ == 0) {
            first = n;
        }
    }
    const int row = it->window[1][0] + (int)(first / terrain->n_x); /* upwards; of no meaning without holes */
    MOR_CHECK(context, n_holes < n_nodes, MOR_ERROR_ARGUMENT,
              "%s: none of the %lld nodes kept has data; move the crop, or correct the raster's NoData value",
              request->path, (long long)n_nodes);
    MOR_CHECK(context, n_holes == 0 || request->fills_no_data, MOR_ERROR_ARGUMENT,
              "%s: %lld of %lld nodes have no data, the first at (%g, %g) m (row %d, column %d of the file); allowed "
              "are none: crop them off, or have holes filled from their boundaries: fill_no_data = true",
              request->path, (long long)n_holes, (long long)n_nodes,
              terrain->origin[0] + (double)(first % terrain->n_x) * terrain->cell[0],
              terrain->origin[1] + (double)(first / terrain->n_x) * terrain->cell[1],
              it->is_downward ? it->n[1] - row : row + 1, it->window[0][0] + (int)(first % terrain->n_x) + 1);
    MOR_TRY(context, mor_terrain_fill_holes(context, terrain));
    return MOR_OK;
}

/* Into the frame of the case. */
static void subtract_offset(mor_context *context, const mor_terrain_request *request, mor_terrain *terrain)
{
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    double lowest;
    double highest;
    mor_terrain_range(terrain, &lowest, &highest);
    const double chosen[3] = {terrain->origin[0], terrain->origin[1], lowest};
    for (int a = 0; a < 3; ++a) {
        terrain->offset[a] = isnan(request->offset[a]) ? chosen[a] : request->offset[a];
    }
    for (int a = 0; a < 2; ++a) {
        terrain->origin[a] -= terrain->offset[a];
    }
    for (int64_t n = 0; n < n_nodes; ++n) {
        terrain->heights[n] -= terrain->offset[2];
    }
    mor_context_log(context, MOR_LOG_INFO,
                    "%s: %d x %d nodes %g m apart, heights %g m to %g m; offset (%.10g, %.10g, %.10g) m subtracted%s%s",
                    request->path, terrain->n_x, terrain->n_y, terrain->cell[0], lowest, highest, terrain->offset[0],
                    terrain->offset[1], terrain->offset[2], terrain->datum[0] != '\0' ? "; " : "", terrain->datum);
}

static mor_status read_terrain(mor_context *context, const mor_terrain_request *request, raster *it,
                               mor_terrain *terrain)
{
    MOR_TRY(context, open_raster(context, it));
    MOR_TRY(context, mor_terrain_prj_load(context, it->path, &it->prj));
    MOR_TRY(context, hash_files(context, it, &terrain->hash));
    if (it->format != MOR_TERRAIN_BINARY) {
        MOR_TRY(context, mor_terrain_check_text(context, it->path, it->format, it->n));
    }
    MOR_TRY(context, place_raster(context, it));
    MOR_TRY(context, read_datum(context, it, terrain));
    MOR_TRY(context, find_window(context, request, it));
    terrain->n_x = it->window[0][1] - it->window[0][0] + 1;
    terrain->n_y = it->window[1][1] - it->window[1][0] + 1;
    for (int a = 0; a < 2; ++a) {
        terrain->cell[a] = it->cell[a];
        terrain->raster_cell[a] = it->cell[a];
        terrain->raster_corner[a] = it->corner[a];
        terrain->origin[a] = it->first[a] + it->window[a][0] * it->cell[a];
    }
    MOR_TRY(context, read_heights(context, it, terrain));
    MOR_TRY(context, fill_holes(context, request, it, terrain));
    MOR_TRY(context, mor_terrain_check_steps(context, request, terrain));
    if (!isnan(request->cell)) {
        MOR_TRY(context, mor_terrain_resample(context, terrain, request->cell));
    }
    subtract_offset(context, request, terrain);
    return MOR_OK;
}

mor_status mor_terrain_read(mor_context *context, const mor_terrain_request *request, mor_terrain *terrain)
{
    *terrain = (mor_terrain){0};
    MOR_TRY(context, mor_terrain_check_request(context, request));
    MOR_TRY(context, check_file(context, request->path));
    raster it = {.path = request->path};
    enter_gdal();
    const mor_status status = read_terrain(context, request, &it, terrain);
    if (it.dataset != NULL) {
        GDALClose(it.dataset);
    }
    mor_terrain_prj_clear(context, &it.prj);
    leave_gdal();
    if (status != MOR_OK) {
        mor_terrain_clear(context, terrain);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

/* ---- Rasters of results ------------------------------------------------------------------------------------------ */

/* Item of the file's metadata that holds the settings. */
#define SETTINGS "MORAINE_SETTINGS"

/* Number in the file where there is no data: quantities of maps are not negative, and no ground lies there. */
#define NO_DATA (-9999.0)

void mor_terrain_raster_clear(mor_context *context, mor_terrain_raster *it)
{
    MOR_FREE(context, &it->values);
    MOR_FREE(context, &it->system);
    *it = (mor_terrain_raster){0};
}

static mor_status describe_raster(mor_context *context, GDALDatasetH dataset, const mor_terrain_raster *it,
                                  const char *path)
{
    GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    double map[6] = {it->corner[0], it->cell[0], 0.0, it->corner[1], 0.0, -it->cell[1]};
    CPLErr error = GDALSetGeoTransform(dataset, map);
    if (it->system != NULL && error == CE_None) {
        error = GDALSetProjection(dataset, it->system);
    }
    GDALSetDescription(band, it->name);
    if (error == CE_None) {
        error = GDALSetRasterUnitType(band, it->unit);
    }
    if (error == CE_None) {
        error = GDALSetMetadataItem(dataset, "TIFFTAG_IMAGEDESCRIPTION", it->text, NULL);
    }
    if (error == CE_None && it->settings[0] != '\0') {
        error = GDALSetMetadataItem(dataset, SETTINGS, it->settings, NULL);
    }
    if (error == CE_None) {
        error = GDALSetRasterNoDataValue(band, NO_DATA);
    }
    MOR_CHECK(context, error == CE_None, MOR_ERROR_IO, "%s: georeference, unit or text cannot be written (%s)", path,
              CPLGetLastErrorMsg());
    return MOR_OK;
}

static mor_status write_rows(mor_context *context, GDALDatasetH dataset, const mor_terrain_raster *it, const char *path)
{
    GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    double *row = NULL;
    MOR_TRY(context, MOR_NEW(context, &row, it->n[0], "a row of a map"));
    CPLErr error = CE_None;
    for (int y = 0; y < it->n[1] && error == CE_None; ++y) {
        for (int x = 0; x < it->n[0]; ++x) {
            const double value = it->values[(int64_t)y * it->n[0] + x];
            row[x] = isnan(value) ? NO_DATA : value;
        }
        error = GDALRasterIO(band, GF_Write, 0, y, it->n[0], 1, row, it->n[0], 1, GDT_Float64, 0, 0);
    }
    MOR_FREE(context, &row);
    MOR_CHECK(context, error == CE_None, MOR_ERROR_IO,
              "%s: cannot be written (%s); free space or choose another folder", path, CPLGetLastErrorMsg());
    return MOR_OK;
}

static mor_status write_raster(mor_context *context, const char *path, const mor_terrain_raster *it)
{
    char **options = CSLSetNameValue(NULL, "COMPRESS", "DEFLATE");
    CPLErrorReset();
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, it->n[0], it->n[1], 1, GDT_Float64, options);
    CSLDestroy(options);
    MOR_CHECK(context, dataset != NULL, MOR_ERROR_IO, "%s: cannot be made (%s); free space or choose another folder",
              path, CPLGetLastErrorMsg());
    mor_status status = describe_raster(context, dataset, it, path);
    if (status == MOR_OK) {
        status = write_rows(context, dataset, it, path);
    }
    CPLErrorReset();
    GDALClose(dataset); /* writes what is left, and reports by its last error alone */
    MOR_CHECK(context, status != MOR_OK || CPLGetLastErrorType() < CE_Failure, MOR_ERROR_IO,
              "%s: cannot be written (%s); free space or choose another folder", path, CPLGetLastErrorMsg());
    return status;
}

mor_status mor_terrain_raster_write(mor_context *context, const char *path, const mor_terrain_raster *it)
{
    enter_gdal();
    const mor_status status = write_raster(context, path, it);
    leave_gdal();
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

static mor_status read_raster(mor_context *context, raster *from, mor_terrain_raster *it)
{
    double map[6];
    MOR_TRY(context, open_raster(context, from));
    MOR_TRY(context, place_raster(context, from));
    MOR_CHECK(context, from->is_downward && (double)from->n[0] * from->n[1] <= MOR_TERRAIN_NODES_MAX, MOR_ERROR_IO,
              "%s: is no map of a run: it has %d x %d cells, allowed are %g in all, the first row upmost", from->path,
              from->n[0], from->n[1], MOR_TERRAIN_NODES_MAX);
    GDALGetGeoTransform(from->dataset, map);
    const char *text = GDALGetMetadataItem(from->dataset, "TIFFTAG_IMAGEDESCRIPTION", NULL);
    const char *settings = GDALGetMetadataItem(from->dataset, SETTINGS, NULL);
    const char *system = GDALGetProjectionRef(from->dataset);
    snprintf(it->settings, sizeof it->settings, "%s", settings != NULL ? settings : "");
    snprintf(it->name, sizeof it->name, "%s", GDALGetDescription(from->band));
    snprintf(it->unit, sizeof it->unit, "%s", GDALGetRasterUnitType(from->band));
    snprintf(it->text, sizeof it->text, "%s", text != NULL ? text : "");
    MOR_TRY(context, mor_terrain_copy_text(context, system[0] != '\0' ? system : NULL, &it->system));
    for (int a = 0; a < 2; ++a) {
        it->n[a] = from->n[a];
        it->cell[a] = from->cell[a];
        it->corner[a] = map[3 * a];
        from->window[a][0] = 0;
        from->window[a][1] = from->n[a] - 1;
    }
    MOR_TRY(context, MOR_NEW(context, &it->values, (int64_t)it->n[0] * it->n[1], "a map"));
    for (int row = 0; row < it->n[1]; ++row) {
        MOR_TRY(context, read_row(context, from, row, it->values + (int64_t)row * it->n[0]));
    }
    return MOR_OK;
}

mor_status mor_terrain_raster_read(mor_context *context, const char *path, mor_terrain_raster *it)
{
    raster from = {.path = path};
    *it = (mor_terrain_raster){0};
    MOR_TRY(context, check_file(context, path));
    enter_gdal();
    const mor_status status = read_raster(context, &from, it);
    if (from.dataset != NULL) {
        GDALClose(from.dataset);
    }
    leave_gdal();
    if (status != MOR_OK) {
        mor_terrain_raster_clear(context, it);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}
