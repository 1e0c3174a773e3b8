/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_ensemble.h"

#include "cases/driver/map/map_picture.h"
#include "cases/driver/map/map_style.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <math.h>
#include <string.h>

/* Half of the width of the interval of 95 % of a normal distribution, in standard deviations. */
static const double quantile = 1.959963984540054;

enum { TITLE_BYTES = 160 };

void mor_map_ensemble_interval(int k, int n, double *low, double *high)
{
    const double share = (double)k / n;
    const double z2 = quantile * quantile / n;
    const double middle = (share + 0.5 * z2) / (1.0 + z2);
    const double half = sqrt(z2 * (share * (1.0 - share) + 0.25 * z2)) / (1.0 + z2);
    *low = k == 0 ? 0.0 : middle - half;
    *high = k == n ? 1.0 : middle + half;
}

static const mor_map_kind *find_kind(const char *name)
{
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL; ++kind) {
        if (kind->needs != MOR_MAP_NEEDS_GROUND && strcmp(kind->name, name) == 0) {
            return kind;
        }
    }
    return NULL;
}

const char *mor_map_ensemble_unit(const char *map)
{
    const mor_map_kind *kind = find_kind(map);
    return kind != NULL ? kind->unit : NULL;
}

void mor_map_ensemble_names(char *text, size_t n_bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL && used < n_bytes; ++kind) {
        if (kind->needs != MOR_MAP_NEEDS_GROUND) {
            used += (size_t)snprintf(text + used, n_bytes - used, "%s%s", used > 0 ? ", " : "", kind->name);
        }
    }
}

/* What is counted while the runs are read. */
typedef struct counting {
    const mor_map_ensemble *ensemble;
    const mor_map_kind *kind;
    mor_terrain_raster map;    /* of the first run; later the share and its interval */
    mor_terrain_raster ground; /* of the first run, where it has one */
    int *counts;               /* shape [cells]; runs that reach the value */
    int n, first;              /* runs with the map, and the first of them */
    bool *is_seen;             /* shape [cells]; a run has data there */
} counting;

/* A run that went on for longer reached more, and an arrival at another depth is another event. */
static mor_status check_settings(mor_context *context, const counting *it, const mor_terrain_raster *map, int run)
{
    MOR_CHECK(
        context, map->settings[0] != '\0', MOR_ERROR_CONFIG,
        "found a map in '%s' that does not tell its end, spacing and depths, as those of earlier versions; resume "
        "the run, which writes its maps anew, or leave it out",
        it->ensemble->folders[run]);
    MOR_CHECK(context, strcmp(map->settings, it->map.settings) == 0, MOR_ERROR_CONFIG,
              "found maps of runs that differ: '%s' has %s, '%s' has %s; allowed: runs of one end, spacing and depths; "
              "resume the shorter ones with the end of the others, or leave them out",
              it->ensemble->folders[it->first], it->map.settings, it->ensemble->folders[run], map->settings);
    return MOR_OK;
}

static mor_status check_grid(mor_context *context, const counting *it, const mor_terrain_raster *map, int run)
{
    const mor_terrain_raster *first = &it->map;
    bool is_same = true;
    for (int a = 0; a < 2; ++a) {
        is_same =
            is_same && map->n[a] == first->n[a] && map->cell[a] == first->cell[a] && map->corner[a] == first->corner[a];
    }
    MOR_CHECK(context, is_same, MOR_ERROR_CONFIG,
              "found maps on two grids: '%s' has %d x %d cells of %.9g m from (%.9g, %.9g) m on, '%s' %d x %d cells of "
              "%.9g m from (%.9g, %.9g) m on; allowed: runs whose maps have the same cells; leave one of them out",
              it->ensemble->folders[it->first], first->n[0], first->n[1], first->cell[0], first->corner[0],
              first->corner[1], it->ensemble->folders[run], map->n[0], map->n[1], map->cell[0], map->corner[0],
              map->corner[1]);
    const char *systems[] = {first->system != NULL ? first->system : "none",
                             map->system != NULL ? map->system : "none"};
    MOR_CHECK(
        context, strcmp(systems[0], systems[1]) == 0, MOR_ERROR_CONFIG,
        "found maps in two reference systems: '%s' has %.300s, '%s' has %.300s; allowed: runs whose maps have the "
        "same; leave one of them out",
        it->ensemble->folders[it->first], systems[0], it->ensemble->folders[run], systems[1]);
    return MOR_OK;
}

/* Where there is no data the value was not reached. */
static void count_cells(counting *it, const mor_terrain_raster *map)
{
    const double value = it->ensemble->value;
    for (int64_t k = 0; k < (int64_t)map->n[0] * map->n[1]; ++k) {
        const double found = map->values[k];
        it->is_seen[k] = it->is_seen[k] || !isnan(found);
        it->counts[k] += it->kind->is_early_dark ? found <= value : found >= value;
    }
}

/* Nothing is reached after the end of a run. */
static mor_status check_time(mor_context *context, const counting *it)
{
    double end = NAN;
    const double value = it->ensemble->value;
    if (!it->kind->is_early_dark || sscanf(it->map.settings, "end %lf s", &end) != 1) {
        return MOR_OK;
    }
    MOR_CHECK(context, value >= 0.0 && value <= end, MOR_ERROR_CONFIG,
              "found the value %g s of the map %s, of runs that end at %g s; allowed: 0 s up to that end, beyond which "
              "nothing is known",
              value, it->kind->name, end);
    return MOR_OK;
}

static mor_status take_first(mor_context *context, counting *it, int run, mor_terrain_raster *map)
{
    bool is_there = false;
    it->first = run;
    it->map = *map;
    *map = (mor_terrain_raster){.values = NULL};
    const int64_t n = (int64_t)it->map.n[0] * it->map.n[1];
    MOR_TRY(context, check_settings(context, it, &it->map, run));
    MOR_TRY(context, check_time(context, it));
    MOR_TRY(context, MOR_NEW(context, &it->counts, n, "counts of runs"));
    MOR_TRY(context, MOR_NEW(context, &it->is_seen, n, "counts of runs"));
    return mor_map_read(context, it->ensemble->folders[run], "ground", &it->ground, &is_there);
}

/* A run without the map, which has failed or goes on, is left out and named. */
static mor_status read_run(mor_context *context, counting *it, int run, FILE *output)
{
    const char *folder = it->ensemble->folders[run];
    mor_terrain_raster map;
    bool is_there = false;
    mor_status status = mor_map_read(context, folder, it->kind->name, &map, &is_there);
    if (status == MOR_OK && !is_there) {
        fprintf(output,
                "left out: %s, which has no " MOR_MAP_FOLDER "/%s.tif: it failed, has not ended, or makes none\n",
                folder, it->kind->name);
    } else if (status == MOR_OK && it->n == 0) {
        status = take_first(context, it, run, &map);
        map = status == MOR_OK ? it->map : map;
    } else if (status == MOR_OK) {
        status = check_grid(context, it, &map, run);
        status = status == MOR_OK ? check_settings(context, it, &map, run) : status;
    }
    if (status == MOR_OK && is_there) {
        count_cells(it, &map);
        it->n += 1;
    }
    if (map.values != it->map.values) {
        mor_terrain_raster_clear(context, &map);
    }
    return status;
}

/* part: 0: the share; -1 and 1: the ends of its interval. */
static void fill_values(counting *it, int part)
{
    const int n = it->n;
    for (int64_t k = 0; k < (int64_t)it->map.n[0] * it->map.n[1]; ++k) {
        double low = 0.0;
        double high = 0.0;
        mor_map_ensemble_interval(it->counts[k], n, &low, &high);
        const double share = part < 0 ? low : part > 0 ? high : (double)it->counts[k] / n;
        it->map.values[k] = it->is_seen[k] ? 100.0 * share : NAN;
    }
}

/* One file with its style; of the share the picture, too. */
static mor_status write_part(mor_context *context, counting *it, int part, const char *folder, FILE *output)
{
    static const char *const suffixes[] = {"-low", "", "-high"};
    static const char *const words[] = {"lower end, ", "", "upper end, "};
    char path[MOR_PATH_BYTES];
    char title[TITLE_BYTES];
    char text[MOR_TERRAIN_RASTER_TEXT_BYTES];
    const mor_map_ensemble *ensemble = it->ensemble;
    snprintf(title, sizeof title, "%s%s %s %g %s", words[part + 1], it->kind->title,
             it->kind->is_early_dark ? "up to" : "of at least", ensemble->value, it->kind->unit);
    const int n_left_out = ensemble->n - it->n;
    size_t used = (size_t)snprintf(text, sizeof text, "Of %d run%s", it->n, it->n == 1 ? "" : "s");
    if (n_left_out > 0) {
        used += (size_t)snprintf(text + used, sizeof text - used, ", %d more left out without a map", n_left_out);
    }
    snprintf(text + used, sizeof text - used,
             "; 95 %% interval (Wilson) in -low and -high; no data where no run had soil");
    const mor_map_kind kind = {.name = "exceed", .title = "share of runs", .unit = "%", .text = text};
    fill_values(it, part);
    snprintf(it->map.name, sizeof it->map.name, "%.*s", (int)sizeof it->map.name - 1, title);
    snprintf(it->map.unit, sizeof it->map.unit, "%%");
    snprintf(it->map.text, sizeof it->map.text, "%s", text);
    snprintf(path, sizeof path, "%s/" MOR_MAP_FOLDER "/exceed-%s%s.qml", folder, it->kind->name, suffixes[part + 1]);
    MOR_TRY(context, mor_map_style_write(context, &kind, 100.0, path));
    snprintf(path, sizeof path, "%s/" MOR_MAP_FOLDER "/exceed-%s%s.tif", folder, it->kind->name, suffixes[part + 1]);
    MOR_TRY(context, mor_terrain_raster_write(context, path, &it->map));
    fprintf(output, "map: %s\n", path);
    if (part != 0) {
        return MOR_OK;
    }
    const bool is_over_ground =
        it->ground.values != NULL && it->ground.n[0] == it->map.n[0] && it->ground.n[1] == it->map.n[1];
    const mor_map_picture picture = {.title = title,
                                     .subtitle = text,
                                     .note = "",
                                     .kind = &kind,
                                     .map = &it->map,
                                     .ground = is_over_ground ? &it->ground : NULL};
    snprintf(path, sizeof path, "%s/images/map-exceed-%s.png", folder, it->kind->name);
    MOR_TRY(context, mor_map_picture_write(context, &picture, path));
    fprintf(output, "map: %s\n", path);
    return MOR_OK;
}

static mor_status make_folders(mor_context *context, const char *folder)
{
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_make_folder(context, folder));
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "images"));
    MOR_TRY(context, mor_durable_file_make_folder(context, path));
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_MAP_FOLDER));
    return mor_durable_file_make_folder(context, path);
}

static mor_status write_all(mor_context *context, counting *it, const char *folder, FILE *output)
{
    for (int run = 0; run < it->ensemble->n; ++run) {
        MOR_TRY(context, read_run(context, it, run, output));
    }
    MOR_CHECK(context, it->n > 0, MOR_ERROR_CONFIG,
              "found no " MOR_MAP_FOLDER "/%s.tif in '%s'%s; allowed: folders of runs that have ended, of cases with "
              "maps; run it",
              it->kind->name, it->ensemble->folders[0], it->ensemble->n > 1 ? " nor in the others" : "");
    fprintf(output, "%d of %d run%s taken together\n", it->n, it->ensemble->n, it->ensemble->n == 1 ? "" : "s");
    MOR_TRY(context, make_folders(context, folder));
    for (int part = -1; part <= 1; ++part) {
        MOR_TRY(context, write_part(context, it, part, folder, output));
    }
    return MOR_OK;
}

mor_status mor_map_ensemble_write(mor_context *context, const mor_map_ensemble *ensemble, const char *folder,
                                  FILE *output)
{
    enum { FILE_NAME_BYTES = 128 };
    char names[MOR_PATH_BYTES];
    counting it = {.ensemble = ensemble, .kind = find_kind(ensemble->map)};
    mor_map_ensemble_names(names, sizeof names);
    MOR_CHECK(context, it.kind != NULL, MOR_ERROR_CONFIG, "found the map '%s'; allowed: %s; name one of them",
              ensemble->map, names);
    MOR_CHECK(context, ensemble->n >= 1 && isfinite(ensemble->value), MOR_ERROR_CONFIG,
              "found %d runs and a value of %g %s; allowed: one run or more, and a finite value", ensemble->n,
              ensemble->value, it.kind->unit);
    MOR_CHECK(context, strlen(folder) + FILE_NAME_BYTES < MOR_PATH_BYTES, MOR_ERROR_IO, "the path '%s' is too long",
              folder);
    const mor_status status = write_all(context, &it, folder, output);
    mor_terrain_raster_clear(context, &it.map);
    mor_terrain_raster_clear(context, &it.ground);
    MOR_FREE(context, &it.counts);
    MOR_FREE(context, &it.is_seen);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
