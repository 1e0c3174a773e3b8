/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_write.h"

#include "cases/driver/map/map_style.h"
#include "cases/driver/scene/simulation.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"
#include "relaxation/terrain/terrain_raster.h"

#include <errno.h>
#include <math.h>
#include <string.h>

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static void fill_values(const mor_map_source *source, const mor_map_kind *kind, mor_terrain_raster *raster)
{
    for (int row = 0; row < raster->n[1]; ++row) {
        for (int column = 0; column < raster->n[0]; ++column) {
            const int64_t cell = (int64_t)(raster->n[1] - 1 - row) * raster->n[0] + column;
            raster->values[(int64_t)row * raster->n[0] + column] = kind->value(source, cell);
        }
    }
}

static double find_largest(const mor_terrain_raster *raster)
{
    double largest = NAN;
    for (int64_t k = 0; k < (int64_t)raster->n[0] * raster->n[1]; ++k) {
        largest = fmax(largest, raster->values[k]); /* of NaN and a number, the number */
    }
    return largest;
}

static mor_status write_map(mor_context *context, const mor_map_kind *kind, const char *folder,
                            const mor_terrain_raster *raster)
{
    char path[MOR_PATH_BYTES];
    char temporary[MOR_PATH_BYTES];
    char name[MOR_TERRAIN_RASTER_NAME_BYTES];
    snprintf(name, sizeof name, "%s.tif.tmp", kind->name);
    MOR_TRY(context, mor_durable_file_join(context, temporary, folder, name));
    snprintf(name, sizeof name, "%s.tif", kind->name);
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    MOR_TRY(context, mor_terrain_raster_write(context, temporary, raster));
    MOR_TRY(context, mor_durable_file_replace(context, temporary, path));
    snprintf(name, sizeof name, "%s.qml", kind->name);
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    return mor_map_style_write(context, kind, find_largest(raster), path);
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static void add_result(mor_map_results *results, const char *map, const char *what, double value, const char *unit)
{
    if (results->n < MOR_MAP_RESULTS_MAX) {
        mor_map_result *it = &results->of[results->n++];
        snprintf(it->name, sizeof it->name, "map.%s.%s", map, what);
        it->value = value;
        it->unit = unit;
    }
}

static void find_results(const mor_map_source *source, const mor_map_kind *kind, const mor_terrain_raster *raster,
                         mor_map_results *results)
{
    const mor_map_grid *grid = &source->track->grid;
    const double area = grid->cell[0] * grid->cell[1];
    const double threshold = source->track->simulation->the_case->maps.threshold;
    const double least = kind->is_depth ? threshold : -INFINITY;
    double n_cells = 0.0;
    double sum = 0.0;
    for (int64_t k = 0; k < mor_map_grid_cells(grid); ++k) {
        n_cells += raster->values[k] >= least ? 1.0 : 0.0;
        sum += isnan(raster->values[k]) ? 0.0 : raster->values[k];
    }
    add_result(results, kind->name, "maximum", find_largest(raster), kind->unit);
    add_result(results, kind->name, "area", n_cells * area, "m2");
    if (kind->has_volume) {
        add_result(results, kind->name, "volume", kind->is_depth ? sum * area : sum, "m3");
    }
}

/* What maps depend on and maps of several runs must share: cells of two ends or thresholds are not of one kind. */
static void fill_settings(const mor_simulation *s, mor_terrain_raster *raster)
{
    const mor_case *c = s->the_case;
    snprintf(raster->settings, sizeof raster->settings,
             "end %.9g s, spacing %.9g m, threshold %.9g m, duration_depth %.9g m", mor_schedule_time(&s->schedule),
             c->spacing, c->maps.threshold, c->maps.duration_depth);
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static mor_status write_maps(mor_context *context, const mor_map_source *source, const char *folder,
                             mor_terrain_raster *raster, mor_map_results *results)
{
    const mor_map_grid *grid = &source->track->grid;
    for (int a = 0; a < 2; ++a) {
        raster->corner[a] = grid->file_corner[a];
        raster->cell[a] = grid->file_cell[a];
        raster->n[a] = grid->n[a];
    }
    fill_settings(source->track->simulation, raster);
    raster->system = grid->terrain != NULL ? grid->terrain->system : NULL;
    MOR_TRY(context, MOR_NEW(context, &raster->values, mor_map_grid_cells(grid), "a map"));
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL; ++kind) {
        if (mor_map_is_made(source->track, kind)) {
            snprintf(raster->name, sizeof raster->name, "%s", kind->title);
            snprintf(raster->unit, sizeof raster->unit, "%s", kind->unit);
            snprintf(raster->text, sizeof raster->text, "%s [%s]", kind->text, kind->unit);
            fill_values(source, kind, raster);
            MOR_TRY(context, write_map(context, kind, folder, raster));
            if (kind->needs != MOR_MAP_NEEDS_GROUND) {
                find_results(source, kind, raster, results);
            }
        }
    }
    return MOR_OK;
}

/* Of a group of rocks. */
static int64_t find_most_particles(const mor_simulation *simulation)
{
    int64_t most = 0;
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        const int64_t n = simulation->bodies.groups[g]->set.n_particles;
        most = n > most ? n : most;
    }
    return most;
}

mor_status mor_map_remove(mor_context *context, const mor_map_track *track, const char *folder)
{
    static const char *const files[][2] = {
        {MOR_MAP_FOLDER "/", ".tif"}, {MOR_MAP_FOLDER "/", ".qml"}, {"images/map-", ".png"}};
    for (const mor_map_kind *kind = mor_map_kinds; track != NULL && kind->name != NULL; ++kind) {
        for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
            char path[MOR_PATH_BYTES];
            char name[MOR_TERRAIN_RASTER_NAME_BYTES];
            snprintf(name, sizeof name, "%s%s%s", files[k][0], kind->name, files[k][1]);
            MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
            MOR_CHECK(context, remove(path) == 0 || errno == ENOENT, MOR_ERROR_IO,
                      "the map '%s' of an earlier end cannot be removed (%s); remove it by hand", path,
                      strerror(errno));
        }
    }
    return MOR_OK;
}

mor_status mor_map_write(mor_context *context, mor_map_track *track, const char *folder, mor_map_results *results)
{
    char path[MOR_PATH_BYTES];
    results->n = 0;
    if (track == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_MAP_FOLDER));
    MOR_TRY(context, mor_durable_file_make_folder(context, path));
    mor_map_source source = {.track = track};
    mor_terrain_raster raster = {.values = NULL};
    mor_status status = mor_map_sums_init(context, &track->grid, find_most_particles(track->simulation), &source.rocks);
    if (status == MOR_OK) {
        if (track->simulation->has_soil) {
            mor_map_measure(context, track);
        }
        mor_map_measure_rocks(context, track, &source.rocks);
        status = write_maps(context, &source, path, &raster, results);
    }
    mor_map_sums_clear(context, &source.rocks);
    MOR_FREE(context, &raster.values);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

static void print_number(FILE *out, const mor_map_results *results, const char *map, const char *what)
{
    char name[MOR_MAP_RESULT_NAME_BYTES];
    double value = NAN;
    snprintf(name, sizeof name, "map.%s.%s", map, what);
    for (int k = 0; k < results->n; ++k) {
        value = strcmp(results->of[k].name, name) == 0 ? results->of[k].value : value;
    }
    if (isfinite(value)) {
        fprintf(out, " %12.6g", value);
    } else {
        fprintf(out, " %12s", "-");
    }
}

void mor_map_print(const mor_map_track *track, const mor_map_results *results, FILE *out)
{
    if (track == NULL || results->n == 0) {
        return;
    }
    const mor_case *c = track->simulation->the_case;
    fprintf(out, "\n%-22s %-6s %12s %12s %12s\n", "map", "unit", "maximum", "area [m2]", "volume [m3]");
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL; ++kind) {
        if (mor_map_is_made(track, kind) && kind->needs != MOR_MAP_NEEDS_GROUND) {
            fprintf(out, "%-22s %-6s", kind->name, strcmp(kind->unit, "1") == 0 ? "-" : kind->unit);
            print_number(out, results, kind->name, "maximum");
            print_number(out, results, kind->name, "area");
            print_number(out, results, kind->name, "volume");
            fprintf(out, "\n");
        }
    }
    fprintf(out,
            "area: of deposit, erosion and depth where they reach %.6g m, else of the cells with data; measured every "
            "%d step%s\n",
            c->maps.threshold, track->interval, track->interval > 1 ? "s" : "");
}
