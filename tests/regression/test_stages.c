/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <stdio.h>

/* Motion, removal and stages: bits after a resume and for any number of threads, the sum of energies, and a cut in
 * stages against the same cut in one go. */

#define CASE_OF_GATE                                                                                                   \
    "title = 'gate'; dimension = 2; spacing = '20 mm'; gravity = (0, -9.81); end = '0.15 s';"                          \
    "domain = { min = (-0.1, -0.1); max = (1.6, 0.7); };"                                                              \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.3, 0.3); };"                             \
    "  material = { model = 'drucker_prager'; density = 1600; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"         \
    "    friction_angle = '30 deg'; }; initial_stress = { type = 'k0'; }; } );"                                        \
    "walls = ( { name = 'floor'; friction = 'rough'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); " \
    "}; },"                                                                                                            \
    "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; },"    \
    "  { name = 'gate'; friction = 'smooth'; removed_at = 0.05; shape = { type = 'box'; min = (0.3, 0); max = (0.4, "  \
    "0.6); }; },"                                                                                                      \
    "  { name = 'flap'; friction = 'coulomb'; friction_coefficient = 0.3;"                                             \
    "    shape = { type = 'box'; min = (0.6, 0); max = (0.7, 0.2); };"                                                 \
    "    path = { point = (0.7, 0); interpolation = 'smooth'; table = ( { time = 0.02; },"                             \
    "      { time = 0.12; translation = (-0.1, 0.02); angle = '40 deg'; }, { time = 0.14; angle = '10 deg'; } ); }; "  \
    "} "                                                                                                               \
    ");"                                                                                                               \
    "bodies = ( { name = 'block'; removed_at = 0.1; shape = { type = 'box'; min = (-0.1, -0.05); max = (0.1, 0.05); "  \
    "};"                                                                                                               \
    "    position = (0.15, 0.351); material = { model = 'rigid'; density = 2500; }; contact_modulus = '1 MPa'; },"     \
    "  { name = 'ball'; shape = { type = 'sphere'; center = (0, 0); radius = 0.06; }; position = (0.15, 0.461);"       \
    "    material = { model = 'rigid'; density = 2500; }; contact_modulus = '1 MPa'; },"                               \
    "  { name = 'tool'; motion = 'prescribed'; shape = { type = 'box'; min = (-0.1, -0.05); max = (0.1, 0.05); };"     \
    "    position = (1.2, 0.4); material = { model = 'rigid'; density = 2500; }; contact_modulus = '1 MPa';"           \
    "    path = { table = ( { time = 0; }, { time = 0.15; translation = (-0.4, 0); angle = '180 deg'; } ); }; } );"    \
    "probes = ( { name = 'gate_force'; type = 'wall_force'; wall = 'gate'; direction = (1, 0); },"                     \
    "  { name = 'balance'; type = 'energy_balance'; }, { name = 'work'; type = 'external_work'; },"                    \
    "  { name = 'ball'; type = 'body_position'; body = 'ball'; direction = (0, 1); },"                                 \
    "  { name = 'kinetic'; type = 'bodies_kinetic_energy'; } );"                                                       \
    "output = { snapshots = 6; pictures = false; };"

static void a_run_is_resumed_before_between_and_after_removals_with_the_same_bits(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char hashes[2][32];
    finished_run_store_text(folder, CASE_OF_GATE, path);
    const session_run whole = {.case_path = path, .name = "whole", .stop_at = NAN, .n_threads = 1};
    session_run_do(folder, &whole, "whole");
    const double stops[] = {0.03, 0.07, 0.12, NAN};
    for (int k = 0; k < 4; ++k) {
        const session_run part = {
            .case_path = path, .name = "part", .stop_at = stops[k], .is_resume = k > 0, .n_threads = 2 + k % 2};
        session_run_do(folder, &part, "part");
    }
    finished_run_read_hash(folder, "whole", hashes[0]);
    finished_run_read_hash(folder, "part", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    finished_run_compare_bytes(folder, "whole", "part", MOR_TABLE_SERIES_FILE);
    finished_run_compare_snapshots(folder, "whole", "part");
    /* The force on the gate is there before, and gone after it is removed. */
    assert_true(finished_run_read_value(folder, "whole", "gate_force", 40) > 100.0);
    assert_true(finished_run_read_value(folder, "whole", "gate_force", -1) == 0.0);
    /* As of moving walls, docs/theory/energy.md: half a percent at this resolution. */
    assert_near(finished_run_read_value(folder, "whole", "balance", -1), 1.0, 5e-3);
}

#define CASE_OF_CUT(start, width)                                                                                      \
    start "title = 'cut'; dimension = 2; spacing = '0.1 m'; gravity = (0, -9.81); end = '0.25 s';"                     \
          "domain = { min = (-0.5, -0.5); max = (4.5, 3); };"                                                          \
          "soil = ( { name = 'clay'; shape = { type = 'box'; min = (0, 0); max = (" width ", 2); };"                   \
          "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '20 MPa'; poissons_ratio = 0.3;"  \
          "    friction_angle = '20 deg'; cohesion = '50 kPa'; };"                                                     \
          "  initial_stress = { type = 'k0'; lateral_ratio = 0.5; }; } );"                                             \
          "walls = ( { name = 'floor'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = "  \
          "(0, 1); }; },"                                                                                              \
          "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); "   \
          "}; },"                                                                                                      \
          "  { name = 'right'; friction = 'smooth'; shape = { type = 'half_space'; point = (4, 0); normal = (-1, 0); " \
          "}; } );"                                                                                                    \
          "probes = ( { name = 'x'; type = 'center_of_mass'; direction = (1, 0); },"                                   \
          "  { name = 'y'; type = 'center_of_mass'; direction = (0, 1); }, { name = 'mass'; type = 'mass'; },"         \
          "  { name = 'sy'; type = 'soil_stress'; origin = (1, 0.5); direction = (0, 1); } );"                         \
          "output = { snapshots = 6; pictures = false; };"
#define DAMPED "numerics = { local_damping = 0.7; };"
#define EXCAVATED "start_from = 'before'; excavate = ( { type = 'box'; min = (2, 0); max = (4.1, 2.1); } );"

static void run_cut(run_folder *folder, const char *text, const char *name)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run it = {.case_path = path, .name = name, .stop_at = NAN, .n_threads = 2};
    session_run_do(folder, &it, name);
}

static void a_cut_in_stages_is_the_cut_in_one_go(void **state)
{
    run_folder *folder = *state;
    run_cut(folder, CASE_OF_CUT("", "4"), "before");
    run_cut(folder, CASE_OF_CUT(DAMPED EXCAVATED, "4"), "staged");
    run_cut(folder, CASE_OF_CUT(DAMPED, "2"), "at_once");
    assert_true(finished_run_read_value(folder, "staged", "mass", 0) ==
                finished_run_read_value(folder, "at_once", "mass", 0));
    /* The stress is taken over, not made anew: small waves of the run before are in it, 1 %. */
    assert_near(finished_run_read_value(folder, "staged", "sy", 0), finished_run_read_value(folder, "before", "sy", -1),
                1e-9);
    /* What the cut moves, 0.5 mm out and 0.3 mm down, is the same to 5 %: the run before has moved by 3 um. */
    const double moved[2] = {finished_run_read_value(folder, "at_once", "x", -1) - 1.0,
                             finished_run_read_value(folder, "at_once", "y", -1) - 1.0};
    assert_true(moved[0] > 4e-4 && moved[1] < -2e-4);
    assert_near(finished_run_read_value(folder, "staged", "x", -1) - 1.0, moved[0], 0.05 * moved[0]);
    assert_near(finished_run_read_value(folder, "staged", "y", -1) - 1.0, moved[1], -0.05 * moved[1]);
    const double stress = finished_run_read_value(folder, "at_once", "sy", -1);
    assert_near(finished_run_read_value(folder, "staged", "sy", -1), stress, -0.02 * stress);
}

/* Soil that has become wet: a quarter heavier at the same volume, at once. On a smooth floor between smooth walls it is
 * pressed by its weight alone. */
static void soil_of_another_density_is_taken_over_with_its_volume(void **state)
{
    run_folder *folder = *state;
    char text[6000];
    run_cut(folder, CASE_OF_CUT("", "4"), "before");
    snprintf(text, sizeof text, "%s", CASE_OF_CUT(DAMPED "start_from = 'before';", "4"));
    char *density = strstr(text, "density = 2000");
    assert_non_null(density);
    memcpy(density, "density = 2500", strlen("density = 2500"));
    run_cut(folder, text, "wet");
    const double mass = finished_run_read_value(folder, "before", "mass", -1);
    assert_near(finished_run_read_value(folder, "wet", "mass", 0), 1.25 * mass, 1e-12 * mass);
    /* The stress is taken over, and 1.5 m below the surface grows with the weight: rho g times 1.5 m, 2 %. */
    assert_near(finished_run_read_value(folder, "wet", "sy", 0), finished_run_read_value(folder, "before", "sy", -1),
                1e-9);
    const double weight = 2500.0 * 9.81 * 1.5;
    assert_near(finished_run_read_value(folder, "wet", "sy", -1), -weight, 0.02 * weight);
}

/* Sand of a law that keeps the density below which it bears no stress becomes a tenth lighter: it goes on bearing its
 * weight, to 4 % beside other soil that stays as heavy as it was and leans on it. */
static void densities_in_the_state_of_a_law_follow_the_soil(void **state)
{
#define CASE_OF_SAND(start, density)                                                                                   \
    start "title = 'sand'; dimension = 2; spacing = '0.1 m'; gravity = (0, -9.81); end = '0.25 s';"                    \
          "domain = { min = (-0.5, -0.5); max = (2.5, 3); };"                                                          \
          "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 2); };"                           \
          "  material = { model = 'hencky_drucker_prager'; density = " density "; youngs_modulus = '20 MPa';"          \
          "    poissons_ratio = 0.3; friction_angle = '30 deg'; }; initial_stress = { type = 'k0'; }; },"              \
          "  { name = 'other'; shape = { type = 'box'; min = (1, 0); max = (2, 2); };"                                 \
          "  material = { model = 'hencky_drucker_prager'; density = 2000; youngs_modulus = '20 MPa';"                 \
          "    poissons_ratio = 0.3; friction_angle = '30 deg'; }; initial_stress = { type = 'k0'; }; } );"            \
          "walls = ( { name = 'floor'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = "  \
          "(0, 1); }; },"                                                                                              \
          "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); "   \
          "}; },"                                                                                                      \
          "  { name = 'right'; friction = 'smooth'; shape = { type = 'half_space'; point = (2, 0); normal = (-1, 0); " \
          "}; } );"                                                                                                    \
          "probes = ( { name = 'mass'; type = 'mass'; },"                                                              \
          "  { name = 'sy'; type = 'soil_stress'; origin = (0.35, 0.5); direction = (0, 1); } );"                      \
          "numerics = { local_damping = 0.7; }; output = { snapshots = 6; pictures = false; };"
    run_folder *folder = *state;
    run_cut(folder, CASE_OF_SAND("", "2000"), "before");
    run_cut(folder, CASE_OF_SAND("start_from = 'before';", "1800"), "drained");
    assert_near(finished_run_read_value(folder, "drained", "mass", 0), 2.0 * 1800.0 + 2.0 * 2000.0, 1e-6);
    const double before = finished_run_read_value(folder, "before", "sy", -1);
    assert_near(finished_run_read_value(folder, "drained", "sy", 0), before, 1e-9);
    assert_near(finished_run_read_value(folder, "drained", "sy", -1), 0.9 * before, -0.04 * before);
#undef CASE_OF_SAND
}

/* A filling on what is left, in a third stage that is itself resumed. */
static void a_stage_fills_and_is_resumed_with_the_same_bits(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char hashes[2][32];
    static const char fill[] =
        "soil = ( { name = 'clay'; shape = { type = 'box'; min = (0, 0); max = (4, 2); };"
        "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '20 MPa'; poissons_ratio = 0.3;"
        "    friction_angle = '20 deg'; cohesion = '50 kPa'; }; },"
        "  { name = 'fill'; shape = { type = 'box'; min = (2, 0); max = (4, 1); };"
        "  material = { model = 'drucker_prager'; density = 1800; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
        "    friction_angle = '30 deg'; }; initial_stress = { type = 'k0'; }; } );";
    const char *whole =
        CASE_OF_CUT("start_from = 'before'; excavate = ( { type = 'box'; min = (2, 0); max = (4.1, 2.1); } );"
                    "@",
                    "4");
    char text[6000];
    run_cut(folder, CASE_OF_CUT("", "4"), "before");
    /* The list soil is another one. */
    const char *soil = strstr(whole, "soil = (");
    const char *walls = strstr(whole, "walls = (");
    const char *mark = strchr(whole, '@');
    snprintf(text, sizeof text, "%.*s%.*s%s%s", (int)(mark - whole), whole, (int)(soil - mark - 1), mark + 1, fill,
             walls);
    finished_run_store_text(folder, text, path);
    const session_run through = {.case_path = path, .name = "through", .stop_at = NAN, .n_threads = 1};
    const session_run part = {.case_path = path, .name = "part", .stop_at = 0.1, .n_threads = 2};
    const session_run rest = {.case_path = path, .name = "part", .stop_at = NAN, .is_resume = true, .n_threads = 3};
    session_run_do(folder, &through, "through");
    assert_int_equal(session_run_do(folder, &part, "part"), MOR_SESSION_STOPPED);
    session_run_do(folder, &rest, "rest");
    finished_run_read_hash(folder, "through", hashes[0]);
    finished_run_read_hash(folder, "part", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    finished_run_compare_bytes(folder, "through", "part", MOR_TABLE_SERIES_FILE);
    /* 400 particles of clay, and 200 of fill. */
    const double mass = finished_run_read_value(folder, "through", "mass", 0);
    assert_near(mass, 8000.0 + 3600.0, 1e-6);
}

/* Two columns that collapse, side by side: blocks of 256 particles hold one of them, or both. */
#define CASE_OF_COLUMNS(start)                                                                                         \
    start                                                                                                              \
        "title = 'columns'; dimension = 2; spacing = '20 mm'; gravity = (0, -9.81); end = '0.1 s';"                    \
        "domain = { min = (-1, -0.1); max = (2, 1); };"                                                                \
        "soil = ( { name = 'a'; shape = { type = 'box'; min = (0, 0); max = (0.3, 0.6); }; " SAND " },"                \
        "  { name = 'b'; shape = { type = 'box'; min = (0.3, 0); max = (0.6, 0.6); }; " SAND " } );"                   \
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"          \
        "probes = ( { name = 'balance'; type = 'energy_balance'; } ); output = { snapshots = 1; pictures = false; };"
#define SAND                                                                                                           \
    "material = { model = 'drucker_prager'; density = 1600; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"           \
    "  friction_angle = '20 deg'; };"

enum { COLUMNS = 2 * 450 };

static void read_columns(mor_session *session, double *position, double *velocity, double *soil)
{
    assert_int_equal(mor_session_n_particles(session, "soil"), COLUMNS);
    assert_int_equal(mor_session_read_field(session, "soil", "position", position, 3 * COLUMNS), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "velocity", velocity, 3 * COLUMNS), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "soil", soil, COLUMNS), MOR_OK);
}

static void note_stop(void *user, mor_log_level level, const char *text)
{
    if (level == MOR_LOG_WARNING && strstr(text, "is stopped at once, which takes a kinetic energy of") != NULL) {
        *(int *)user += 1;
    }
}

/* It moved in the run before at about g t, 1 m/s, and stands to the last bit until it is released. */
static void soil_taken_over_stands_until_it_is_released(void **state)
{
    static double place[2][3 * COLUMNS], velocity[3 * COLUMNS], soil[COLUMNS];
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    int n_warnings = 0;
    double moved = 0.0;
    run_cut(folder, CASE_OF_COLUMNS(""), "falling");
    finished_run_store_text(folder, CASE_OF_COLUMNS("start_from = 'falling';"), path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    mor_session_set_log(session, note_stop, &n_warnings);
    assert_int_equal(mor_session_override(session, "soil[0].released=1"), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    session_make_ready(session);
    assert_int_equal(n_warnings, 1);
    read_columns(session, place[0], velocity, soil);
    for (int k = 0; k < 100; ++k) {
        assert_int_equal(mor_session_step(session), MOR_OK);
    }
    read_columns(session, place[1], velocity, soil);
    for (int i = 0; i < COLUMNS; ++i) {
        const double *x = place[1] + 3 * i;
        const double way = hypot(x[0] - place[0][3 * i], x[1] - place[0][3 * i + 1]);
        const double speed = hypot(velocity[3 * i], velocity[3 * i + 1]);
        assert_true(soil[i] == 1.0 || (way == 0.0 && speed == 0.0));
        moved = fmax(moved, way);
    }
    assert_true(moved > 0.02); /* the other one goes on: a spacing */
    mor_session_free(&session);
}

#define CASE_OF_ROUND(start, from, to)                                                                                 \
    start "title = 'round'; dimension = 2; spacing = '10 mm'; gravity = (0, 0); end = '0.1 s';"                        \
          "domain = { min = (" from ", -0.1); max = (" to ", 0.2); periodic = 'x'; };"                                 \
          "soil = ( { name = 'block'; velocity = (3, 0); shape = { type = 'box'; min = (0, 0); max = (0.2, 0.1); };"   \
          "  material = { model = 'drucker_prager'; density = 1600; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"   \
          "    friction_angle = '20 deg'; cohesion = '10 kPa'; }; } );"                                                \
          "probes = ( { name = 'x'; type = 'center_of_mass'; direction = (1, 0); } );"                                 \
          "output = { snapshots = 1; pictures = false; };"

/* 3 m/s for 0.1 s in a domain of 0.2 m: all of it has gone round once, half of it twice. A stage with a longer domain
 * begins where the soil is in it, and goes on by 0.3 m. */
static void periodic_faces_are_crossed_anew_in_a_stage(void **state)
{
    run_folder *folder = *state;
    run_cut(folder, CASE_OF_ROUND("", "0", "0.2"), "round");
    run_cut(folder, CASE_OF_ROUND("start_from = 'round';", "-0.3", "0.3"), "longer");
    assert_near(finished_run_read_value(folder, "round", "x", -1), 0.4, 1e-9); /* rounding of some hundred steps */
    const double first = finished_run_read_value(folder, "longer", "x", 0);
    assert_near(first, 0.1, 1e-9); /* a full domain */
    assert_near(finished_run_read_value(folder, "longer", "x", -1) - first, 0.3, 1e-9);
}

/* A block that has gone on by 0.3 spacings loses its front half, and new soil fills the gap: across the periodic face,
 * too, it is left out where it would be nearer than 0.75 spacings to what is there. */
static void new_soil_does_not_overlap_across_a_periodic_face(void **state)
{
    enum { ROOM = 400 };
    static const char fill[] =
        "start_from = 'shifted'; excavate = ( { type = 'box'; min = (0.1, -1); max = (0.3, 1); } );"
        "title = 'fill'; dimension = 2; spacing = '10 mm'; gravity = (0, 0); end = '1 ms';"
        "domain = { min = (0, -0.1); max = (0.2, 0.2); periodic = 'x'; };"
        "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.1); };" SAND " },"
        "  { name = 'new'; shape = { type = 'box'; min = (0.1, 0); max = (0.2, 0.1); };" SAND " } );";
    static double x[3 * ROOM];
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    double nearest = INFINITY;
    finished_run_store_text(folder, CASE_OF_ROUND("", "0", "0.2"), path);
    const char *const slow[] = {"soil[0].velocity=(-0.06, 0)", "end=0.05"};
    const session_run it = {
        .case_path = path, .name = "shifted", .settings = slow, .n_settings = 2, .stop_at = NAN, .n_threads = 1};
    session_run_do(folder, &it, "shifted");
    finished_run_store_text(folder, fill, path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    session_expect(session, mor_session_build(session), MOR_OK, "");
    const int n = (int)mor_session_n_particles(session, "soil");
    assert_in_range(n, 150, ROOM);
    assert_int_equal(mor_session_read_field(session, "soil", "position", x, 3 * n), MOR_OK);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < i; ++j) {
            const double offset = x[3 * i] - x[3 * j];
            nearest = fmin(nearest, hypot(offset - 0.2 * rint(offset / 0.2), x[3 * i + 1] - x[3 * j + 1]));
        }
    }
    assert_true(nearest >= 0.75 * 0.01 - 1e-12); /* rounding */
    mor_session_free(&session);
}

#define CASE_OF_FIELDS(start, of_a, of_b)                                                                              \
    start "title = 'fields'; dimension = 2; spacing = 0.25; gravity = (0, -9.81); end = '20 ms';"                      \
          "domain = { min = (-1, -1); max = (5, 5); };"                                                                \
          "soil = ( { name = 'a'; shape = { type = 'box'; min = (0, 0); max = (4, 2); };" CLAY of_a " },"              \
          "  { name = 'b'; shape = { type = 'box'; min = (0, 2); max = (4, 4); };" CLAY of_b " } );"                   \
          "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"        \
          "output = { snapshots = 1; pictures = false; };"
#define CLAY                                                                                                           \
    "material = { model = 'mohr_coulomb'; density = 2000; youngs_modulus = 2e7; poissons_ratio = 0.3;"                 \
    "  friction_angle = 0.3; cohesion = 4e3; };"
#define FIELD(parameter, formula) "{ parameter = '" parameter "'; formula = '" formula "'; }"

/* Whether a soil brings its values is asked of this soil: what b varies for the first time is that of the stage though
 * a varied it before, and though b had a field of another parameter. */
static void what_another_soil_varied_is_not_kept(void **state)
{
    enum { N = 256 };
    static double x[3 * N], cohesion[N], friction[N], soil[N];
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    run_cut(folder,
            CASE_OF_FIELDS("", "fields = (" FIELD("cohesion", "1e3*(1 + x)") ");",
                           "fields = (" FIELD("friction_angle", "0.2 + 0.01*x") ");"),
            "two");
    finished_run_store_text(
        folder,
        CASE_OF_FIELDS("start_from = 'two';", "fields = (" FIELD("cohesion", "9e3") ");",
                       "fields = (" FIELD("friction_angle", "0.5") "," FIELD("cohesion", "3e3 + 10*x") ");"),
        path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    session_expect(session, mor_session_build(session), MOR_OK, "");
    assert_int_equal(mor_session_n_particles(session, "soil"), N);
    assert_int_equal(mor_session_read_field(session, "soil", "position", x, 3 * N), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "cohesion", cohesion, N), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "friction_angle", friction, N), MOR_OK);
    assert_int_equal(mor_session_read_field(session, "soil", "soil", soil, N), MOR_OK);
    for (int i = 0; i < N; ++i) {
        if (soil[i] == 0.0) { /* moved by less than 20 mm since; its friction angle is that of the material */
            assert_near(cohesion[i], 1e3 * (1.0 + x[3 * i]), 20.0);
            assert_true(friction[i] == 0.3);
        } else {
            assert_near(cohesion[i], 3e3 + 10.0 * x[3 * i], 1e-9); /* rounding */
            assert_near(friction[i], 0.2 + 0.01 * x[3 * i], 2e-4);
        }
    }
    mor_session_free(&session);
    /* Of b, the friction angles that it brings are below a dilation angle that the stage gives it. */
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_override(session, "soil[1].material.dilation_angle=0.28"), MOR_OK);
    assert_int_equal(mor_session_load_file(session, path), MOR_OK);
    session_expect(session, mor_session_build(session), MOR_ERROR_CONFIG,
                   "soil 'b', whose fields are taken over from the run");
    mor_session_free(&session);
}

static void runs_that_do_not_fit_are_refused(void **state)
{
    static const char *const wrong[][2] = {
        {"spacing=0.05", "found spacing [m] = 0.05 in this case, but 0.1"},
        {"placement={ angle = 0.1; }", "placement.angle"},
        {"scale={ length = 4; }", "scale.length = 4"},
        {"soil[0].name=sand", "found no soil of this case with the name of one"},
        {"soil[0].material={ model = \"tresca\"; density = 2000; youngs_modulus = 2e7; poissons_ratio = 0.3; "
         "undrained_strength = 50000; }",
         "found the model 'tresca' of the soil 'clay'"},
        {"soil[0].initial_stress={ type = \"settled\"; }", "found a settled initial stress of the soil 'clay'"},
        {"excavate=( { type = \"box\"; min = (-1, -1); max = (5, 5); } )", "none is left by the excavations"},
        {"walls[1].shape.point=(1, 0)", "found wall 'left' where soil 'clay' of the run"},
        {"domain.max=(3, 3)", "outside the domain of this case"},
        {"start_from=none", "found a run to start from"}};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_cut(folder, CASE_OF_CUT("", "4"), "before");
    finished_run_store_text(folder, CASE_OF_CUT("start_from = 'before';", "4"), path);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        mor_session *session = NULL;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_override(session, wrong[k][0]), MOR_OK);
        mor_status status = mor_session_load_file(session, path);
        status = status == MOR_OK ? mor_session_build(session) : status;
        session_expect(session, status, MOR_ERROR_CONFIG, wrong[k][1]);
        mor_session_free(&session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_run_is_resumed_before_between_and_after_removals_with_the_same_bits,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_cut_in_stages_is_the_cut_in_one_go, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_of_another_density_is_taken_over_with_its_volume, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(densities_in_the_state_of_a_law_follow_the_soil, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_stage_fills_and_is_resumed_with_the_same_bits, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_taken_over_stands_until_it_is_released, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(periodic_faces_are_crossed_anew_in_a_stage, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(new_soil_does_not_overlap_across_a_periodic_face, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_another_soil_varied_is_not_kept, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(runs_that_do_not_fit_are_refused, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
