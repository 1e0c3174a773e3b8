/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/moraine.h"
#include "relaxation/terrain/terrain_raster.h"
#include "tests/common/session_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Maps of whole runs: a block of soil that moves on as it is, one that slides down a plane, and soil with a rock on a
 * raster. */

#define SAND(modulus)                                                                                                  \
    "material = { model = 'mohr_coulomb'; density = '2000 kg/m3'; youngs_modulus = '" modulus "';"                     \
    "  poissons_ratio = 0.2; friction_angle = '30 deg'; cohesion = '50 kPa'; }; "

/* ---- Runs and what they leave ------------------------------------------------------------------------------------ */

static void run_text(run_folder *folder, const char *text, const char *name, double stop_at, bool is_resume,
                     int n_threads)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run run = {
        .case_path = path, .name = name, .stop_at = stop_at, .is_resume = is_resume, .n_threads = n_threads};
    assert_int_equal(session_run_do(folder, &run, name), isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
}

static mor_terrain_raster read_map(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    char file[128];
    mor_terrain_raster map;
    snprintf(file, sizeof file, "maps/%s.tif", name);
    finished_run_file(folder, path, run, file);
    if (mor_terrain_raster_read(&folder->context, path, &map) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    assert_true(map.text[0] != '\0' && map.unit[0] != '\0');
    return map;
}

/* Sum over all cells with data times their area. */
static double find_volume(const mor_terrain_raster *map)
{
    double sum = 0.0;
    for (int k = 0; k < map->n[0] * map->n[1]; ++k) {
        sum += isnan(map->values[k]) ? 0.0 : map->values[k];
    }
    return sum * map->cell[0] * map->cell[1];
}

static double find_result(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    char unit[16];
    double value = NAN;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_result(&folder->context, path, name, &value, unit, sizeof unit), MOR_OK);
    return value;
}

/* Length of the longest step that the series tells. */
static double find_step(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    double longest = 0.0;
    finished_run_file(folder, path, run, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
    for (int64_t row = 0; row < data.n_rows; ++row) {
        longest = fmax(longest, data.values[row * data.n_columns + 2]);
    }
    mor_table_data_clear(&folder->context, &data);
    return longest;
}

/* ---- A block that moves on --------------------------------------------------------------------------------------- */

/* Nothing acts on it: 0.6 m by 0.6 m and 0.4 m high, from x = 0.3 m on, with 2 m/s along x. */
static const char moving[] =
    "title = 'block'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, 0); end = '0.6 s';"
    "domain = { min = (0, 0, -1); max = (3, 1.2, 1); };"
    "soil = ( { name = 'block'; velocity = (2, 0, 0); shape = { type = 'box'; min = (0.3, 0.3, 0); max = (0.9, 0.9, "
    "0.4); }; " SAND("1 MPa") "} );"
                              "maps = { cell = 0.15; interval = 1; threshold = 0.05; };"
                              "output = { snapshots = 1; pictures = false; series_interval = '1 us'; };";

static const double block_speed = 2.0;
static const double block_back = 0.3;
static const double block_front = 0.9;
static const double block_height = 0.4;
static const double block_end = 0.6; /* of the run, s */

/* Row 2 from above, y = 0.6 m to 0.75 m or the row below: in the middle of the block. */
enum { MIDDLE_ROW = 4 };

static void a_moving_block_has_its_speed_everywhere(void **state)
{
    run_folder *folder = *state;
    run_text(folder, moving, "run", NAN, false, 1);
    mor_terrain_raster speed = read_map(folder, "run", "speed_max");
    mor_terrain_raster pressure = read_map(folder, "run", "pressure_max");
    mor_terrain_raster flow = read_map(folder, "run", "flow_max");
    mor_terrain_raster depth = read_map(folder, "run", "depth_max");
    int n = 0;
    for (int k = 0; k < speed.n[0] * speed.n[1]; ++k) {
        assert_true(isnan(speed.values[k]) == !(depth.values[k] >= 0.05));
        if (!isnan(speed.values[k])) {
            /* rounding of sums of some ten particles */
            assert_true(fabs(speed.values[k] - block_speed) <= 1e-13 * block_speed);
            assert_true(fabs(pressure.values[k] - 2000.0 * 4.0) <= 1e-11 * 8000.0);
            assert_true(fabs(flow.values[k] - depth.values[k] * block_speed) <= 1e-12);
            n += 1;
        }
    }
    assert_in_range(n, 40, 200);
    mor_terrain_raster_clear(&folder->context, &speed);
    mor_terrain_raster_clear(&folder->context, &pressure);
    mor_terrain_raster_clear(&folder->context, &flow);
    mor_terrain_raster_clear(&folder->context, &depth);
}

/* The depth of a cell is the height of the block times the share that it covers: the threshold is reached an eighth of
 * the height into the cell, and left as much before its end. */
static void arrival_and_duration_of_a_moving_block_are_exact_to_a_step(void **state)
{
    run_folder *folder = *state;
    run_text(folder, moving, "run", NAN, false, 2);
    const double step = find_step(folder, "run");
    const double lead = 0.05 / block_height * 0.15;
    mor_terrain_raster arrival = read_map(folder, "run", "arrival");
    mor_terrain_raster duration = read_map(folder, "run", "duration");
    assert_true(step > 0.0 && step < 0.01);
    int n_arrivals = 0;
    int n_durations = 0;
    for (int column = 0; column < arrival.n[0]; ++column) {
        const int k = MIDDLE_ROW * arrival.n[0] + column;
        const double low = arrival.corner[0] + column * 0.15;
        const double reached = (low + lead - block_front) / block_speed;
        const double left = (low + 0.15 - lead - block_back) / block_speed;
        if (low >= block_front - 1e-9 && reached < block_end - step) {
            assert_true(arrival.values[k] >= reached - 1e-9 && arrival.values[k] <= reached + step + 1e-9);
            n_arrivals += 1;
        }
        if (low >= block_front - 1e-9 && left < block_end - step) {
            assert_true(fabs(duration.values[k] - (left - reached)) <= step + 1e-9);
            n_durations += 1;
        }
    }
    assert_true(n_arrivals >= 7 && n_durations >= 3);
    mor_terrain_raster_clear(&folder->context, &arrival);
    mor_terrain_raster_clear(&folder->context, &duration);
}

static void cells_never_reached_have_no_data_and_those_that_were_left_have_zero(void **state)
{
    run_folder *folder = *state;
    run_text(folder, moving, "run", NAN, false, 1);
    mor_terrain_raster deposit = read_map(folder, "run", "deposit");
    mor_terrain_raster erosion = read_map(folder, "run", "erosion");
    assert_int_equal(deposit.n[0], 20);
    assert_int_equal(deposit.n[1], 8);
    assert_true(isnan(deposit.values[0]) && isnan(erosion.values[0]));
    const int start = MIDDLE_ROW * deposit.n[0] + 3; /* x = 0.45 m to 0.6 m: in the block at the start only */
    assert_true(deposit.values[start] == 0.0);
    assert_true(fabs(erosion.values[start] - block_height) <= 1e-12);
    const int end = MIDDLE_ROW * deposit.n[0] + 12; /* x = 1.8 m to 1.95 m: in the block at the end only */
    assert_true(fabs(deposit.values[end] - block_height) <= 1e-12 && isnan(erosion.values[end]));
    /* all of it has moved: what was eroded is what is deposited, 0.144 m3 of density that never changed */
    assert_true(fabs(find_volume(&deposit) - 0.144) <= 1e-13);
    assert_true(fabs(find_volume(&erosion) - 0.144) <= 1e-13);
    assert_true(fabs(find_result(folder, "run", "map.deposit.volume") - 0.144) <= 1e-13);
    assert_true(fabs(find_result(folder, "run", "map.deposit.maximum") - block_height) <= 1e-12);
    assert_true(find_result(folder, "run", "map.speed_max.maximum") > 1.999);
    mor_terrain_raster_clear(&folder->context, &deposit);
    mor_terrain_raster_clear(&folder->context, &erosion);
}

/* A run that goes on has no maps until its new end: those of its earlier end are true no longer. */
static void maps_of_an_earlier_end_are_gone_when_a_run_goes_on(void **state)
{
    run_folder *folder = *state;
    static const char *const later[] = {"end=1 s"};
    char path[MOR_PATH_BYTES];
    run_text(folder, moving, "run", NAN, false, 1);
    finished_run_store_text(folder, moving, path);
    const session_run longer = {.case_path = path,
                                .name = "run",
                                .settings = later,
                                .n_settings = 1,
                                .stop_at = 0.8,
                                .is_resume = true,
                                .n_threads = 1};
    assert_int_equal(session_run_do(folder, &longer, "longer"), MOR_SESSION_STOPPED);
    assert_int_not_equal(access(finished_run_file(folder, path, "run", "maps/deposit.tif"), R_OK), 0);
}

/* A ball that falls beside a block that is held; the ball is taken away after 0.2 s. */
static const char two_bodies[] =
    "title = 'two'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, -9.81); end = '0.3 s';"
    "domain = { min = (0, 0, -1); max = (3, 1.2, 3); };"
    "bodies = ( { name = 'ball'; position = (0.6, 0.6, 2); shape = { type = 'sphere'; center = (0, 0, 0); radius = "
    "0.3; };"
    "    removed_at = '0.2 s'; material = { model = 'rigid'; density = '2600 kg/m3'; }; },"
    "  { name = 'house'; motion = 'prescribed'; position = (2, 0.6, 0); material = { model = 'rigid'; density = 2600; "
    "};"
    "    shape = { type = 'box'; min = (-0.3, -0.3, 0); max = (0.3, 0.3, 0.6); }; } );"
    "probes = ( { type = 'boulder_travel'; } ); maps = { cell = 0.15; interval = 1; };"
    "output = { snapshots = 1; pictures = false; };";

static void bodies_that_are_gone_or_held_are_no_rocks_of_a_map(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    run_text(folder, two_bodies, "run", NAN, false, 1);
    mor_terrain_raster volume = read_map(folder, "run", "rock_volume");
    mor_terrain_raster speed = read_map(folder, "run", "rock_speed_max");
    assert_true(find_volume(&volume) == 0.0);
    double fastest = NAN;
    for (int k = 0; k < speed.n[0] * speed.n[1]; ++k) {
        fastest = fmax(fastest, speed.values[k]);
        assert_true(k % speed.n[0] < 10 || isnan(speed.values[k])); /* the house is at 1.7 m to 2.3 m */
    }
    assert_true(fastest > 1.7 && fastest < 1.963); /* of a free fall of 0.2 s, and of the last step before */
    char *bytes = (char *)run_folder_load(finished_run_file(folder, path, "run", "boulders.csv"), &n_bytes);
    assert_non_null(strstr(bytes, "ball,"));
    assert_null(strstr(bytes, "house,"));
    /* without a place, a speed or rest at the end, but with the time of its removal */
    assert_non_null(strstr(bytes, ",0.6,0.6,2,,,,"));
    assert_non_null(strstr(bytes, ",,,0.2"));
    free(bytes);
    mor_terrain_raster_clear(&folder->context, &volume);
    mor_terrain_raster_clear(&folder->context, &speed);
}

/* ---- A block on a plane ------------------------------------------------------------------------------------------ */

/* A smooth plane inclined by 30 degrees: the block slides with 9.81 / 2 m/s2. */
static const char sliding[] =
    "title = 'slide'; dimension = 3; spacing = '0.1 m'; gravity = (4.905, 0, -8.4957); end = '0.6 s';"
    "domain = { min = (0, 0, -0.5); max = (3, 1.2, 1); };"
    "walls = ( { name = 'plane'; friction = 'smooth';"
    "  shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 0, 1); }; } );"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0.3, 0.3, 0); max = (0.9, 0.9, 0.4); };"
    "  initial_stress = { type = 'k0'; lateral_ratio = 0.0; }; " SAND(
        "20 MPa") "} );"
                  "maps = { interval = 2; };"
                  "output = { snapshots = 1; pictures = false; series_interval = '1 us'; };";

static void the_arrival_follows_the_front_of_a_sliding_block(void **state)
{
    run_folder *folder = *state;
    run_text(folder, sliding, "run", NAN, false, 2);
    const double interval = 2.0 * find_step(folder, "run");
    mor_terrain_raster arrival = read_map(folder, "run", "arrival");
    int n = 0;
    for (int column = 0; column < arrival.n[0]; ++column) {
        const double low = arrival.corner[0] + column * 0.1;
        const double time = arrival.values[6 * arrival.n[0] + column];
        if (low > block_front && !isnan(time)) {
            /* within a cell and an interval of where the front is */
            const double front = block_front + 0.5 * 4.905 * time * time;
            assert_true(front >= low - 1e-6 && front <= low + 0.1 + 4.905 * time * interval);
            n += 1;
        }
    }
    assert_in_range(n, 7, 10); /* it slides 0.88 m */
    mor_terrain_raster_clear(&folder->context, &arrival);
}

/* ---- Soil and a rock on a raster --------------------------------------------------------------------------------- */

static const char falling[] =
    "title = 'slope'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, -9.81); end = '0.5 s';"
    "domain = { min = (1, 0.5, -1); max = (4, 2.5, 3); };"
    "walls = ( { name = 'slope'; friction = 'rough'; shape = { type = 'terrain'; file = 'slope.asc';"
    "  crop_min = (691200.5, 5334002.1); }; } );"
    "soil = ( { name = 'heap'; shape = { type = 'release'; ground = 'slope'; thickness = 0.3;"
    "  points = ((1.6, 1.1), (2.3, 1.1), (2.3, 1.9), (1.6, 1.9)); }; " SAND(
        "2 MPa") "} );"
                 "bodies = ( { name = 'rock'; position = (2.9, 1.5, 2.2); velocity = (-3, 0, 0);"
                 "  shape = { type = 'sphere'; center = (0, 0, 0); radius = 0.2; };"
                 "  material = { model = 'rigid'; density = '2600 kg/m3'; }; contact_modulus = '10 MPa'; } );"
                 "maps = { cell = 0.125; };"
                 "output = { snapshots = 2; pictures = false; };";

/* Cells of 0.25 m at an odd corner, falling by 1 in 2 towards x = 0. */
static void store_raster(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    enum { COLUMNS = 24, ROWS = 20 };
    FILE *file = fopen(run_folder_file(folder, path, "slope.asc"), "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcorner 691200.3\nyllcorner 5334001.7\ncellsize 0.25\n", COLUMNS, ROWS);
    for (int k = 0; k < COLUMNS * ROWS; ++k) {
        fprintf(file, "%.3f%c", 400.0 + 0.125 * (k % COLUMNS), k % COLUMNS == COLUMNS - 1 ? '\n' : ' ');
    }
    fclose(file);
    file = fopen(run_folder_file(folder, path, "slope.prj"), "w");
    assert_non_null(file);
    fprintf(file, "PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[\"ETRS89\",DATUM[\"ETRS89\",SPHEROID[\"GRS 1980\",6378137,"
                  "298.257222101]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
                  "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
                  "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
                  "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
    fclose(file);
}

static void maps_lie_on_the_raster_of_the_ground(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_terrain_raster raster;
    store_raster(folder);
    run_text(folder, falling, "run", NAN, false, 2);
    mor_terrain_raster ground = read_map(folder, "run", "ground");
    assert_int_equal(mor_terrain_raster_read(&folder->context, run_folder_file(folder, path, "slope.asc"), &raster),
                     MOR_OK);
    assert_non_null(ground.system);
    assert_non_null(strstr(ground.system, "UTM zone 32N"));
    for (int a = 0; a < 2; ++a) {
        assert_true(ground.cell[a] == 0.5 * raster.cell[a]);
        const double steps = fabs(ground.corner[a] - raster.corner[a]) / ground.cell[a];
        assert_true(fabs(steps - round(steps)) <= 1e-7); /* a rounding of the coordinates: 1e-9 m */
    }
    for (int k = 0; k < ground.n[0] * ground.n[1]; ++k) {
        const double x = ground.corner[0] + (k % ground.n[0] + 0.5) * ground.cell[0];
        const double height = 400.0 + 0.5 * (x - raster.corner[0] - 0.125);
        assert_true(fabs(ground.values[k] - height) <= 1e-6); /* coordinates of 5e6 m and offsets: rounding */
    }
    mor_terrain_raster_clear(&folder->context, &ground);
    mor_terrain_raster_clear(&folder->context, &raster);
}

static void volumes_under_the_maps_are_those_of_the_particles(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    enum { PARTICLES_MAX = 4096 };
    static double mass[PARTICLES_MAX];
    static double density[PARTICLES_MAX];
    mor_session *session = NULL;
    mor_session_outcome outcome;
    double volume = 0.0;
    store_raster(folder);
    finished_run_store_text(folder, falling, path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    run_folder_file(folder, path, "run");
    assert_int_equal(mor_session_run(session, path, false, NAN, &outcome), MOR_OK);
    const int64_t n = mor_session_n_particles(session, "soil");
    assert_in_range(n, 100, PARTICLES_MAX);
    assert_int_equal(mor_session_read_field(session, "soil", "mass", mass, PARTICLES_MAX), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "density", density, PARTICLES_MAX), MOR_OK);
    mor_session_free(&session);
    for (int64_t i = 0; i < n; ++i) {
        volume += mass[i] / density[i];
    }
    mor_terrain_raster deposit = read_map(folder, "run", "deposit");
    mor_terrain_raster rocks = read_map(folder, "run", "rock_volume");
    assert_true(fabs(find_volume(&deposit) - volume) <= 1e-13 * volume);
    /* particles of a body hold its volume to the accuracy of the moments of its shape */
    const double ball = 4.0 / 3.0 * acos(-1.0) * 0.008;
    assert_true(fabs(find_volume(&rocks) / (rocks.cell[0] * rocks.cell[1]) - ball) <= 1e-5 * ball);
    mor_terrain_raster_clear(&folder->context, &deposit);
    mor_terrain_raster_clear(&folder->context, &rocks);
}

static void a_rock_passes_the_cells_of_its_way(void **state)
{
    run_folder *folder = *state;
    store_raster(folder);
    run_text(folder, falling, "run", NAN, false, 1);
    mor_terrain_raster passages = read_map(folder, "run", "rock_passages");
    mor_terrain_raster speed = read_map(folder, "run", "rock_speed_max");
    double n_passages = 0.0;
    double fastest = 0.0;
    for (int k = 0; k < passages.n[0] * passages.n[1]; ++k) {
        assert_true(isnan(passages.values[k]) == isnan(speed.values[k]));
        n_passages += isnan(passages.values[k]) ? 0.0 : passages.values[k];
        fastest = fmax(fastest, speed.values[k]);
    }
    /* it flies along x with 3 m/s for at least 0.2 s: from cell to cell of 0.125 m, then rolls or rests */
    assert_in_range((int)n_passages, 4, 16);
    assert_true(fastest >= 3.0 && fastest < 10.0);
    mor_terrain_raster_clear(&folder->context, &passages);
    mor_terrain_raster_clear(&folder->context, &speed);
}

static const char *const files[] = {"deposit.tif", "erosion.tif",       "depth_max.tif",      "speed_max.tif",
                                    "arrival.tif", "duration.tif",      "pressure_max.tif",   "flow_max.tif",
                                    "ground.tif",  "rock_passages.tif", "rock_speed_max.tif", "rock_volume.tif",
                                    "deposit.qml", "rock_passages.qml"};

static void compare_maps(run_folder *folder, const char *one, const char *other)
{
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        char name[64];
        snprintf(name, sizeof name, "maps/%s", files[k]);
        finished_run_compare_bytes(folder, one, other, name);
    }
}

static void maps_have_the_same_bytes_for_any_threads_and_after_a_stop(void **state)
{
    run_folder *folder = *state;
    store_raster(folder);
    run_text(folder, falling, "whole", NAN, false, 1);
    run_text(folder, falling, "threads", NAN, false, 3);
    compare_maps(folder, "whole", "threads");
    run_text(folder, falling, "stopped", 0.0, false, 1);
    run_text(folder, falling, "stopped", 0.2, true, 2);
    run_text(folder, falling, "stopped", NAN, true, 3);
    compare_maps(folder, "whole", "stopped");
    run_text(folder, falling, "stopped", NAN, true, 1); /* complete: the files are written anew */
    compare_maps(folder, "whole", "stopped");
}

static void a_run_does_not_go_on_with_other_maps(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char run[MOR_PATH_BYTES];
    mor_session *session = NULL;
    mor_session_outcome outcome;
    run_text(folder, moving, "run", 0.2, false, 1);
    run_folder_file(folder, path, "case.cfg");
    run_folder_file(folder, run, "run");
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_override(session, "maps.threshold=0.1"), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    assert_int_equal(mor_session_run(session, run, true, NAN, &outcome), MOR_ERROR_CONFIG);
    assert_non_null(strstr(mor_session_message(session), "maps.threshold"));
    mor_session_free(&session);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_moving_block_has_its_speed_everywhere),
        TEST(arrival_and_duration_of_a_moving_block_are_exact_to_a_step),
        TEST(maps_of_an_earlier_end_are_gone_when_a_run_goes_on),
        TEST(bodies_that_are_gone_or_held_are_no_rocks_of_a_map),
        TEST(cells_never_reached_have_no_data_and_those_that_were_left_have_zero),
        TEST(the_arrival_follows_the_front_of_a_sliding_block),
        TEST(maps_lie_on_the_raster_of_the_ground),
        TEST(volumes_under_the_maps_are_those_of_the_particles),
        TEST(a_rock_passes_the_cells_of_its_way),
        TEST(maps_have_the_same_bytes_for_any_threads_and_after_a_stop),
        TEST(a_run_does_not_go_on_with_other_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
