/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Walls that hold particles where soil is near alone give the results of walls that are filled from the start. */
#include "cases/driver/library/session_internal.h"
#include "tests/common/session_case.h"

/* A clod of soil that is thrown far over ground at the speed of a fast flow, and lands where no wall particle was. */
#define THROWN                                                                                                         \
    "title = 'thrown clod'; dimension = 3; spacing = '50 mm'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2');"           \
    "end = '0.25 s'; domain = { min = ('0 m', '0 m', '-0.6 m'); max = ('4 m', '2 m', '1.5 m'); };"                     \
    "soil = ( { name = 'clod'; shape = { type = 'box'; min = ('0.3 m', '0.9 m', '0.35 m');"                            \
    "    max = ('0.5 m', '1.1 m', '0.5 m'); }; velocity = ('8 m/s', '0 m/s', '-1 m/s');"                               \
    "  material = { model = 'drucker_prager'; density = '1800 kg/m3'; youngs_modulus = '1 MPa';"                       \
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; cohesion = '0.2 kPa'; }; } );"                               \
    "output = { snapshots = 2; pictures = false; };"

#define SLEEP "numerics = { sleep_after = '0.1 s'; sort_interval = 17; };"
#define AWAKE "numerics = { sort_interval = 17; };"

static const char on_terrain[] =
    THROWN SLEEP "walls = ( { name = 'ground'; friction = 'rough'; shape = { type = 'terrain'; file = 'ground.asc';"
                 "    offset = ('0 m', '0 m', '0 m'); }; },"
                 "  { name = 'back'; friction = 'smooth'; shape = { type = 'box'; min = ('3.2 m', '-0.1 m', '-0.6 m');"
                 "    max = ('3.6 m', '2.1 m', '1.2 m'); }; } );"
                 "probes = ( { type = 'wall_force'; wall = 'ground'; direction = (0, 0, 1); window = (0, 0.1); } );";

/* Its lattice is turned against the scene, and an inclined face cuts cells. */
static const char on_mesh[] =
    THROWN AWAKE "walls = ( { name = 'wedge'; friction = 'rough'; shape = { type = 'mesh'; file = 'wedge.obj'; }; } );"
                 "placement = { axis = (0, 0, 1); angle = '20 deg'; };";

static const char on_belt[] = THROWN SLEEP
    "walls = ( { name = 'belt'; friction = 'rough'; velocity = ('-2 m/s', '0 m/s', '0 m/s');"
    "    shape = { type = 'box'; min = ('-1 m', '-0.2 m', '-0.2 m'); max = ('5 m', '2.2 m', '0.1 m'); }; } );";

static const char on_lifted_table[] = THROWN SLEEP
    "walls = ( { name = 'table'; friction = 'rough';"
    "    path = { table = ( { time = 0; }, { time = 0.1; translation = (0.1, 0, 0.05); },"
    "      { time = 0.25; translation = (0.1, 0, -0.05); } ); };"
    "    shape = { type = 'box'; min = ('-1 m', '-0.2 m', '-0.2 m'); max = ('5 m', '2.2 m', '0.1 m'); }; } );";

static const char on_flap[] = THROWN AWAKE
    "walls = ( { name = 'flap'; friction = 'rough';"
    "    path = { axis = (0, 1, 0); point = (0, 0, 0); table = ( { time = 0; },"
    "      { time = 0.25; angle = '-3 deg'; } ); };"
    "    shape = { type = 'box'; min = ('-1 m', '-0.2 m', '-0.2 m'); max = ('5 m', '2.2 m', '0.1 m'); }; } );";

static void store_ground(run_folder *folder)
{
    enum { COLUMNS = 25, ROWS = 13 };
    char path[MOR_PATH_BYTES];
    char text[8192];
    int n = snprintf(text, sizeof text, "ncols %d\nnrows %d\nxllcenter -0.4\nyllcenter -0.4\ncellsize 0.25\n", COLUMNS,
                     ROWS);
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            n += snprintf(text + n, sizeof text - (size_t)n, "%.3f ",
                          0.05 * sin(0.9 * column) * cos(0.7 * row) - 0.012 * column);
        }
        n += snprintf(text + n, sizeof text - (size_t)n, "\n");
    }
    run_folder_store(run_folder_file(folder, path, "ground.asc"), text, (size_t)n);
}

static void store_wedge(run_folder *folder)
{
    static const char text[] = "v -0.5 -0.2 -0.5\nv 5 -0.2 -0.5\nv 5 2.2 -0.5\nv -0.5 2.2 -0.5\n"
                               "v -0.5 -0.2 0.13\nv 5 -0.2 -0.11\nv 5 2.2 -0.11\nv -0.5 2.2 0.13\n"
                               "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, "wedge.obj"), text, sizeof text - 1);
}

/* How a case is to be run. */
typedef struct way {
    const char *setting; /* zero-terminated; NULL: none */
    int n_threads;
    bool is_checked;
} way;

static mor_session *load(run_folder *folder, const char *text, const way *how)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    finished_run_store_text(folder, text, path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, how->n_threads), MOR_OK);
    session->context.is_checked = how->is_checked;
    if (how->setting != NULL) {
        assert_int_equal(mor_session_override(session, how->setting), MOR_OK);
    }
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    return session;
}

static int64_t count_filled(const mor_session *session)
{
    int64_t n = 0;
    for (int w = 0; w < session->simulation.soil.n_walls; ++w) {
        n += session->simulation.soil.walls[w].n_points;
    }
    return n;
}

static int64_t count_all(const mor_session *session)
{
    int64_t n = 0;
    for (int w = 0; w < session->simulation.soil.n_walls; ++w) {
        n += mor_soil_contact_points(&session->simulation.soil.walls[w]);
    }
    return n;
}

/* What a run ends with. */
typedef struct ending {
    uint64_t hash;
    double wall_impulse[3];
    int64_t n_steps;
    int64_t n_first, n_last, n_most; /* wall particles at the start, at the end, and of whole walls */
} ending;

static ending run(run_folder *folder, const char *text, const way *how)
{
    mor_session *session = load(folder, text, how);
    ending end = {0};
    session_make_ready(session);
    end.n_first = count_filled(session);
    session_expect(session, mor_session_step_to(session, mor_session_end(session)), MOR_OK, "");
    end.hash = mor_session_state_hash(session);
    memcpy(end.wall_impulse, session->simulation.soil.wall_impulse[0], sizeof end.wall_impulse);
    end.n_steps = mor_session_n_steps(session);
    end.n_last = count_filled(session);
    end.n_most = count_all(session);
    mor_session_free(&session);
    return end;
}

static void assert_same(const ending *a, const ending *b)
{
    assert_true(a->hash == b->hash);
    assert_int_equal(a->n_steps, b->n_steps);
    assert_memory_equal(a->wall_impulse, b->wall_impulse, sizeof a->wall_impulse);
}

/* A checked run sees to it that no soil is in reach of a part of a wall without particles. */
static void compare(run_folder *folder, const char *text)
{
    const ending whole = run(folder, text, &(way){"numerics.wall_particles=everywhere", 1, false});
    const ending near = run(folder, text, &(way){NULL, 3, false});
    const ending checked = run(folder, text, &(way){NULL, 1, true});
    assert_same(&whole, &near);
    assert_same(&whole, &checked);
    assert_int_equal(whole.n_first, whole.n_most);
    assert_int_equal(near.n_most, whole.n_most);
    /* It says something only where walls are filled on the way, and not all of them. */
    assert_true(near.n_first < near.n_last && near.n_last < near.n_most);
    assert_true(near.wall_impulse[2] < 0.0); /* the clod has landed */
}

static void soil_thrown_over_terrain_meets_a_whole_wall(void **state)
{
    store_ground(*state);
    compare(*state, on_terrain);
}

static void soil_thrown_over_a_mesh_meets_a_whole_wall(void **state)
{
    store_wedge(*state);
    compare(*state, on_mesh);
}

static void soil_thrown_on_a_wall_with_a_velocity_meets_a_whole_wall(void **state)
{
    compare(*state, on_belt);
}

static void soil_thrown_on_a_wall_on_a_path_meets_a_whole_wall(void **state)
{
    compare(*state, on_lifted_table);
}

static void soil_thrown_on_a_wall_that_turns_meets_a_whole_wall(void **state)
{
    compare(*state, on_flap);
}

static void run_that_is_resumed_while_walls_are_filled_ends_alike(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    store_ground(folder);
    mor_session *session = load(folder, on_terrain, &(way){NULL, 1, false});
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.2), MOR_OK, "");
    const int64_t n_filled = count_filled(session);
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "half")), MOR_OK, "");
    session_expect(session, mor_session_step_to(session, mor_session_end(session)), MOR_OK, "");
    const uint64_t hash = mor_session_state_hash(session);
    const int64_t n_steps = mor_session_n_steps(session);
    mor_session_free(&session);
    session = load(folder, on_terrain, &(way){NULL, 3, false});
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_resume(session, path), MOR_OK, "");
    assert_true(count_filled(session) < n_filled); /* it begins with fewer */
    session_expect(session, mor_session_step_to(session, mor_session_end(session)), MOR_OK, "");
    assert_true(mor_session_state_hash(session) == hash);
    assert_int_equal(mor_session_n_steps(session), n_steps);
    mor_session_free(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_thrown_over_terrain_meets_a_whole_wall),
        cmocka_unit_test(soil_thrown_over_a_mesh_meets_a_whole_wall),
        cmocka_unit_test(soil_thrown_on_a_wall_with_a_velocity_meets_a_whole_wall),
        cmocka_unit_test(soil_thrown_on_a_wall_on_a_path_meets_a_whole_wall),
        cmocka_unit_test(soil_thrown_on_a_wall_that_turns_meets_a_whole_wall),
        cmocka_unit_test(run_that_is_resumed_while_walls_are_filled_ends_alike),
    };
    return cmocka_run_group_tests(tests, run_folder_setup, run_folder_teardown);
}
