/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Forces of contacts that may be reported come from the bodies, and surfaces do not pass through each other without a
 * word. */
#include "core/base/math.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"
#include "tests/common/run_text.h"

#include <math.h>

/* A ball of 1.5 m that hits a post at 10 m/s; what follows the shape is left open. */
#define POST                                                                                                           \
    "title = 'ball on a post'; dimension = 3; spacing = '0.15 m'; end = '20 ms'; gravity = (0, 0, '-9.81 m/s2');"      \
    "domain = { min = (-3, -3, 0); max = (3, 3, 8); };"                                                                \
    "walls = ( { name = 'post'; shape = { type = 'box'; min = (0, -0.5, 0); max = (1, 0.5, 3); }; } );"                \
    "bodies = ( { name = 'ball'; shape = { type = 'sphere'; center = (0, 0, 0); radius = '0.75 m'; };"                 \
    "    position = ('-0.755 m', 0, 1.5); velocity = ('10 m/s', 0, 0); motion = 'free';"                               \
    "    material = { model = 'rigid'; density = '2600 kg/m3'; }; } );"                                                \
    "contact = { friction_coefficient = 0.0; restitution = 1.0; };"                                                    \
    "probes = ( { name = 'push'; type = 'wall_contact_force'; wall = 'post'; direction = (1, 0, 0); } );"              \
    "output = { snapshots = 1; series_interval = '1 us'; pictures = false; };"

static program_outcome run_post(run_folder *folder, const char *name, const char *const *settings, int exit_code)
{
    return run_text(folder, POST, name, settings, exit_code);
}

/* Largest value of the last column of the series of a run. */
static double find_peak(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    char line[1024];
    double peak = -INFINITY;
    FILE *file = fopen(finished_run_file(folder, path, name, "series.csv"), "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) != NULL) {
        const char *last = strrchr(line, ',');
        char *end = NULL;
        const double value = last != NULL ? strtod(last + 1, &end) : NAN;
        peak = end != last + 1 && value > peak ? value : peak;
    }
    fclose(file);
    return peak;
}

static void the_domain_does_not_change_the_force_of_an_impact(void **state)
{
    run_folder *folder = *state;
    static const char *const tops[] = {"domain.max=(3, 3, 3)", "domain.max=(3, 3, 8)", "domain.max=(3, 3, 50)",
                                       "domain.max=(30, 30, 200)"};
    double first = 0.0;
    for (int k = 0; k < 4; ++k) {
        char name[16];
        snprintf(name, sizeof name, "top%d", k);
        program_outcome outcome = run_post(folder, name, (const char *[]){tops[k], NULL}, 0);
        const double peak = find_peak(folder, name);
        first = k == 0 ? peak : first;
        assert_true(peak == first && peak > 0.0); /* exact: nothing that is computed changes */
        program_clear(&outcome);
    }
}

/* Johnson (1985) section 11.4: d = (15 m v^2 / (16 E sqrt R))^(2/5), F = 4/3 E sqrt(R) d^(3/2). */
static void the_force_of_an_impact_follows_from_the_moduli_of_both_sides(void **state)
{
    run_folder *folder = *state;
    /* The last wall is a ball of 1 m that bulges towards the one that comes: 1/R = 1/0.75 + 1/1. */
    static const char *const settings[][4] = {
        {"bodies[0].contact_modulus=50 GPa", NULL},
        {"bodies[0].contact_modulus=50 GPa", "walls[0].contact_modulus=30 GPa", NULL},
        {"bodies[0].contact_modulus=50 GPa", "bodies[0].contact_poissons_ratio=0.45", NULL},
        {"bodies[0].contact_modulus=50 GPa", "walls[0].shape={ type = \"sphere\"; center = (1, 0, 1.5); radius = 1; }",
         NULL},
    };
    enum { CASES = sizeof settings / sizeof *settings };
    const double mass = 2600.0 * 4.0 / 3.0 * 3.14159265358979 * 0.75 * 0.75 * 0.75;
    const double share = 1.0 - 0.25 * 0.25;
    const double compliances[CASES] = {share / 50e9, share / 50e9 + share / 30e9, (1.0 - 0.45 * 0.45) / 50e9,
                                       share / 50e9};
    const double radii[CASES] = {0.75, 0.75, 0.75, 0.75 / 1.75};
    for (int k = 0; k < CASES; ++k) {
        char name[16];
        snprintf(name, sizeof name, "moduli%d", k);
        program_outcome outcome = run_post(folder, name, settings[k], 0);
        const double modulus = 1.0 / compliances[k];
        const double depth = pow(15.0 * mass * 100.0 / (16.0 * modulus * sqrt(radii[k])), 0.4);
        const double force = 4.0 / 3.0 * modulus * sqrt(radii[k]) * pow(depth, 1.5);
        const double peak = find_peak(folder, name);
        if (!(fabs(peak / force - 1.0) < 0.05)) { /* five nodes a radius; under 2 % measured */
            fail_msg("case %d: peak %.4g N, Hertz %.4g N", k, peak, force);
        }
        program_clear(&outcome);
    }
}

static void surfaces_that_pass_through_each_other_stop_the_run(void **state)
{
    run_folder *folder = *state;
    program_outcome outcome =
        run_post(folder, "soft", (const char *[]){"bodies[0].contact_modulus=2 MPa", "end=0.1 s", NULL}, 1);
    program_expect_text(outcome.errors, "warning: body 'ball' lies");
    program_expect_text(outcome.errors, "deep in wall 'post'");
    program_expect_text(outcome.errors, "raise contact_modulus");
    program_clear(&outcome);
}

static void a_body_that_is_driven_into_a_wall_is_warned_of(void **state)
{
    run_folder *folder = *state;
    program_outcome outcome = run_post(folder, "driven", (const char *[]){"bodies[0].motion=\"prescribed\"", NULL}, 0);
    program_expect_text(outcome.errors, "body 'ball' is driven");
    assert_true(find_peak(folder, "driven") == 0.0); /* exact: no force moves either */
    program_clear(&outcome);
}

static void bodies_that_overlap_as_the_run_begins_are_warned_of(void **state)
{
    run_folder *folder = *state;
    program_outcome pressed = run_post(
        folder, "pressed",
        (const char *[]){"bodies[0].position=(-0.745, 0, 1.5)", "bodies[0].velocity=(0, 0, 0)", "end=1 ms", NULL}, 0);
    program_expect_text(pressed.errors, "bodies overlap one another or walls by up to 0.005 m");
    program_expect_text(pressed.errors,
                        "the energies of the bodies do not add up"); /* no one gave the springs theirs */
    program_clear(&pressed);
    program_outcome clear = run_post(
        folder, "clear",
        (const char *[]){"bodies[0].position=(-0.75, 0, 1.5)", "bodies[0].velocity=(0, 0, 0)", "end=1 ms", NULL}, 0);
    assert_null(strstr(clear.errors, "overlap"));
    assert_null(strstr(clear.errors, "do not add up"));
    program_clear(&clear);
}

/* A roller that turns as prescribed drives a slab that lies on it: its work is in the books. Damping of all velocities
 * is not, so that nothing is said. What is left unexplained is far below the 5 % that are warned of. */
static void energy_that_is_accounted_for_is_not_warned_of(void **state)
{
    static const char text[] =
        "title = 'roller'; dimension = 2; spacing = '0.05 m'; end = '0.2 s'; gravity = (0, '-9.81 m/s2', 0);"
        "domain = { min = (-3, -2, -1); max = (3, 2, 1); };"
        "walls = ( { name = 'side'; shape = { type = 'half_space'; point = (0, -1.5); normal = (0, 1); }; } );"
        "bodies = ( { name = 'left'; shape = { type = 'sphere'; center = (0, 0); radius = 0.3; };"
        "    position = (-0.6, 0); motion = 'prescribed'; angular_velocity = (0, 0, -5); contact_modulus = '50 MPa';"
        "    material = { model = 'rigid'; density = 2400; }; },"
        "  { name = 'right'; shape = { type = 'sphere'; center = (0, 0); radius = 0.3; };"
        "    position = (0.6, 0); motion = 'prescribed'; angular_velocity = (0, 0, -5); contact_modulus = '50 MPa';"
        "    material = { model = 'rigid'; density = 2400; }; },"
        "  { name = 'slab'; shape = { type = 'box'; min = (-1, 0); max = (1, 0.25); }; position = (0, 0.3);"
        "    contact_modulus = '50 MPa'; material = { model = 'rigid'; density = 2400; }; } );"
        "contact = { friction_coefficient = 0.5; restitution = 0.5; };"
        "probes = ( { name = 'speed'; type = 'body_velocity'; body = 'slab'; direction = (1, 0); } );"
        "output = { snapshots = 1; pictures = false; };";
    static const char *const settings[] = {"numerics.damping=0", "numerics.damping=5"};
    run_folder *folder = *state;
    for (int k = 0; k < 2; ++k) {
        program_outcome outcome =
            run_text(folder, text, k == 0 ? "driven" : "damped", (const char *[]){settings[k], NULL}, 0);
        assert_null(strstr(outcome.errors, "do not add up"));
        program_clear(&outcome);
    }
    assert_true(find_peak(folder, "driven") > 0.4); /* 0.5 g 0.2 s = 0.98 m/s, but for what bounces */
}

static void bodies_in_one_place_are_refused(void **state)
{
    run_folder *folder = *state;
    program_outcome outcome =
        run_post(folder, "twice",
                 (const char *[]){
                     "bodies=({name=\"a\"; shape={type=\"sphere\"; center=(0,0,0); radius=0.75;}; position=(-1,0,1.5);"
                     "material={model=\"rigid\"; density=2600;};}, {name=\"b\"; shape={type=\"sphere\"; "
                     "center=(0,0,0); radius=0.75;}; position=(-1,0,1.5); material={model=\"rigid\"; density=2600;};})",
                     NULL},
                 2);
    program_expect_text(outcome.errors, "overlapping body");
    program_clear(&outcome);
}

/* The shipped blocks on an incline have the stiffness that is chosen: one slides as Coulomb says, the other rests. With
 * rocking or slow swings undamped they rattle without end, and the one that should rest creeps. */
static void shipped_blocks_slide_and_rest_as_coulomb_says(void **state)
{
    static const char *const cases[] = {MOR_SOURCE_DIR "/cases/incline-block/case.cfg",
                                        MOR_SOURCE_DIR "/cases/incline-block/case-rests.cfg"};
    run_folder *folder = *state;
    for (int k = 0; k < 2; ++k) {
        char results[MOR_PATH_BYTES];
        run_folder_file(folder, results, k == 0 ? "slides" : "rests");
        const char *const words[] = {"run", cases[k], "-o", results, "-t", "1", "--set", "output.pictures=false", NULL};
        program_outcome outcome = program_run(folder, words, 0); /* 3 where an expectation is missed */
        program_clear(&outcome);
    }
}

/* A cube from a mesh lies as flat as a box: its nodes are on the faces of the mesh, not on the level set, which bulges
 * beside edges, or the floor would throw it up and it would slide without friction. The way is that of Coulomb,
 * found within 0.1 %; on the level set it was 3 % more, and the yaw 1e-3 rad in place of 1e-7. */
static void a_cube_from_a_mesh_slides_as_coulomb_says(void **state)
{
    static const char mesh[] = "v -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv 0.5 0.5 -0.5\nv -0.5 0.5 -0.5\n"
                               "v -0.5 -0.5 0.5\nv 0.5 -0.5 0.5\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\n"
                               "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    static const char text[] =
        "title = 'cube'; dimension = 3; spacing = '0.125 m'; gravity = (4.905, 0, -8.4957092); end = '0.2 s';"
        "domain = { min = (-1, -1, -1); max = (1, 1, 2); };"
        "bodies = ( { name = 'cube'; position = (0, 0, 0.5); shape = { type = 'mesh'; file = 'cube.obj'; };"
        "    material = { model = 'rigid'; density = 2000; }; } );"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 0, 1); }; } );"
        "contact = { friction_coefficient = 0.3; restitution = 0.5; };"
        "probes = ( { name = 'way'; type = 'body_position'; body = 'cube'; direction = (1, 0, 0); },"
        "  { name = 'yaw'; type = 'body_rotation_angle'; body = 'cube'; direction = (0, 0, 1); } );"
        "expect = ( { probe = 'way'; value = 0.0471256; tolerance = 0.01; source = 'Coulomb friction'; },"
        "  { probe = 'yaw'; value = 0.0; tolerance = 1e-5; absolute = true; source = 'symmetry'; } );"
        "output = { snapshots = 1; pictures = false; };";
    run_folder *folder = *state;
    char file[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, file, "cube.obj"), mesh, sizeof mesh - 1);
    program_outcome outcome = run_text(folder, text, "cube", as_it_is, 0);
    program_clear(&outcome);
}

/* A face that rises by 20 degrees behind an edge too shallow to be known as one: followed beyond it, it
 * would lie in the floor, and threw the rock up by 2 mm. It stands still on its base; its depth under 12 kN is some
 * 1e-6 m. */
static void a_rock_stands_on_its_base_beside_a_shallow_edge(void **state)
{
    static const char text[] =
        "title = 'bevel'; dimension = 2; spacing = '0.05 m'; end = '20 ms'; gravity = (0, '-9.81 m/s2');"
        "domain = { min = (-2, -1, -1); max = (2, 2, 1); };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "bodies = ( { name = 'rock'; material = { model = 'rigid'; density = 2400; };"
        "    shape = { type = 'polygon'; points = ((-0.5, 0), (0.2, 0), (0.5, 0.1), (0.5, 0.6), (-0.5, 0.6)); }; } );"
        "contact = { restitution = 0.3; };"
        "probes = ( { name = 'depth'; type = 'contact_depth'; },"
        "  { name = 'turn'; type = 'body_rotation_angle'; body = 'rock'; direction = (0, 0, 1); } );"
        "expect = ( { probe = 'depth'; statistic = 'maximum'; value = 0.0; tolerance = 1e-5; absolute = true; source = "
        "'Hertz'; },"
        "  { probe = 'turn'; value = 0.0; tolerance = 1e-5; absolute = true; source = 'rest'; } );"
        "output = { snapshots = 1; pictures = false; };";
    run_folder *folder = *state;
    program_outcome outcome = run_text(folder, text, "bevel", as_it_is, 0);
    assert_null(strstr(outcome.errors, "overlap"));
    program_clear(&outcome);
}

/* A box that falls flat on a floor rebounds with the restitution that was given, however stiff it is and however little
 * it is to leave. Within 1 %: the steps of an impact. */
static void a_flat_box_rebounds_as_it_is_told_to(void **state)
{
    static const char text[] =
        "title = 'flat'; dimension = 3; spacing = 0.05; end = 0.02; gravity = (0, 0, 0);"
        "domain = { min = (-1, -1, -0.5); max = (1, 1, 1); };"
        "walls = ( { name = 'w'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 0, 1); }; } );"
        "bodies = ( { name = 'b'; position = (0, 0, 0.21); velocity = (0, 0, -2.0); contact_modulus = '50 GPa';"
        "    shape = { type = 'box'; min = (-0.2, -0.2, -0.2); max = (0.2, 0.2, 0.2); };"
        "    material = { model = 'rigid'; density = 2600; }; } );"
        "contact = { restitution = 0.1; };"
        "probes = ( { name = 'v'; type = 'body_velocity'; body = 'b'; direction = (0, 0, 1); } );"
        "expect = ( { probe = 'v'; value = 0.2; tolerance = 0.01; source = 'restitution'; } );"
        "output = { snapshots = 1; pictures = false; };";
    static const char *const settings[][2] = {
        {"contact.restitution=0.05", "expect[0].value=0.1"},
        {"contact.restitution=0.1", "expect[0].value=0.2"},
        {"contact.restitution=0.3", "expect[0].value=0.6"},
        {"contact.restitution=0.1", "bodies[0].contact_modulus=100 MPa"},
    };
    run_folder *folder = *state;
    char name[16];
    for (size_t k = 0; k < sizeof settings / sizeof *settings; ++k) {
        snprintf(name, sizeof name, "flat%zu", k);
        program_outcome outcome =
            run_text(folder, text, name, (const char *[]){settings[k][0], settings[k][1], NULL}, 0);
        program_clear(&outcome);
    }
}

/* A smooth box that meets the floor with a corner leaves it, at the corner, with the restitution that was given: the
 * impulse (1 + e) m v / (1 + r^2 m / I) acts at the lever r of the corner. Within half a percent of the impact's 2 m/s
 * and of its 9.6 rad/s: the box turns by 5 degrees on the way. */
static void a_corner_rebounds_as_it_is_told_to(void **state)
{
    static const char text[] =
        "title = 'corner'; dimension = 2; spacing = 0.05; end = 0.02; gravity = (0, 0);"
        "domain = { min = (-2, -1); max = (2, 2); };"
        "walls = ( { name = 'w'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "bodies = ( { name = 'b'; angle = '20 deg'; position = (0, 0.293); velocity = (0, -2.0);"
        "    contact_modulus = '1 GPa'; shape = { type = 'box'; min = (-0.3, -0.2); max = (0.3, 0.2); };"
        "    material = { model = 'rigid'; density = 2600; }; } );"
        "contact = { restitution = 0.1; friction_coefficient = 0.0; };"
        "probes = ( { name = 'v'; type = 'body_velocity'; body = 'b'; direction = (0, 1); },"
        "  { name = 'w'; type = 'body_angular_velocity'; body = 'b'; direction = (0, 0, 1); } );"
        "expect = ( { probe = 'v'; value = 0.0; tolerance = 0.01; absolute = true; source = 'restitution'; },"
        "  { probe = 'w'; value = 0.0; tolerance = 0.05; absolute = true; source = 'restitution'; } );"
        "output = { snapshots = 1; pictures = false; };";
    static const double restitutions[] = {0.05, 0.3, 1.0};
    const double rotation = MOR_PI / 9.0; /* the lowest corner is that of (-0.3, -0.2) */
    const double lever = -0.3 * cos(rotation) + 0.2 * sin(rotation);
    const double inertia = (0.6 * 0.6 + 0.4 * 0.4) / 12.0; /* over the mass, m2 */
    run_folder *folder = *state;
    for (int k = 0; k < 3; ++k) {
        const double impulse = (1.0 + restitutions[k]) * 2.0 / (1.0 + lever * lever / inertia);
        char name[16], settings[3][64];
        snprintf(name, sizeof name, "corner%d", k);
        snprintf(settings[0], sizeof settings[0], "contact.restitution=%g", restitutions[k]);
        snprintf(settings[1], sizeof settings[1], "expect[0].value=%.9g", impulse - 2.0);
        snprintf(settings[2], sizeof settings[2], "expect[1].value=%.9g", impulse * lever / inertia);
        program_outcome outcome =
            run_text(folder, text, name, (const char *[]){settings[0], settings[1], settings[2], NULL}, 0);
        program_clear(&outcome);
    }
}

static void a_stiffness_that_was_chosen_is_told(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, POST, path);
    program_outcome chosen = program_run(folder, (const char *[]){"explain", path, "-t", "1", NULL}, 0);
    program_expect_text(chosen.output, "Young's modulus 2.6e+09 Pa, Poisson's ratio 0.25 (chosen for speed");
    program_clear(&chosen);
    program_outcome given = program_run(
        folder, (const char *[]){"explain", path, "-t", "1", "-s", "bodies[0].contact_modulus=50 GPa", NULL}, 0);
    program_expect_text(given.output, "Young's modulus 5e+10 Pa, Poisson's ratio 0.25 (as given)");
    program_clear(&given);
}

/* First number of the line of a table that begins with a name: a force per length. */
static double read_result(const char *table, const char *name)
{
    char start[64];
    snprintf(start, sizeof start, "\n%s", name);
    const char *line = strstr(table, start);
    assert_non_null(line);
    line = strstr(line, "N/m ");
    assert_non_null(line);
    return strtod(line + strlen("N/m "), NULL);
}

/* A rigid and an elastic block on one floor: what one group pressed with last is not found anew by a resume, which may
 * come between the sub-steps of the two. */
static void a_resume_keeps_the_forces_of_all_groups(void **state)
{
    static const char text[] =
        "title = 'two blocks'; dimension = 2; spacing = '0.05 m'; end = '20 ms'; gravity = (0, '-9.81 m/s2', 0);"
        "domain = { min = (-2, -1, -1); max = (2, 2, 1); };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "bodies = ( { name = 'hard'; shape = { type = 'box'; min = (-0.9, 0); max = (-0.4, 0.5); };"
        "    contact_modulus = '100 MPa'; material = { model = 'rigid'; density = 2400; }; },"
        "  { name = 'soft'; shape = { type = 'box'; min = (0.4, 0); max = (0.9, 0.5); };"
        "    material = { model = 'neo_hookean'; density = 2400; youngs_modulus = '20 MPa'; poissons_ratio = 0.25; }; "
        "} );"
        "probes = ( { name = 'w'; type = 'wall_contact_force'; wall = 'floor'; direction = (0, -1);"
        "    window = ('11 ms', '20 ms'); },"
        "  { name = 'd'; type = 'contact_depth'; window = ('11 ms', '20 ms'); } );"
        "output = { snapshots = 1; pictures = false; };";
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES], whole[MOR_PATH_BYTES], parts[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    run_folder_file(folder, whole, "whole");
    run_folder_file(folder, parts, "parts");
    const char *const runs[3][9] = {{"run", path, "-t", "1", "-o", whole, NULL},
                                    {"run", path, "-t", "1", "-o", parts, "--stop-at", "12 ms", NULL},
                                    {"run", path, "-t", "1", "-o", parts, "--resume", NULL}};
    for (int k = 0; k < 3; ++k) {
        program_outcome outcome = program_run(folder, runs[k], 0);
        program_clear(&outcome);
    }
    finished_run_compare_results(folder, "whole", "parts");
    /* A probe that is added when all is over reads what the old one of its kind does. */
    program_outcome again =
        program_run(folder,
                    (const char *[]){
                        "run", path, "-t", "1", "-o", parts, "--resume", "-s",
                        "probes=({name=\"w\"; type=\"wall_contact_force\"; wall=\"floor\"; direction=(0, -1); "
                        "window=(\"11 ms\", \"20 ms\");}, {name=\"d\"; type=\"contact_depth\"; window=(\"11 ms\", "
                        "\"20 ms\");}, {name=\"w2\"; type=\"wall_contact_force\"; wall=\"floor\"; direction=(0, -1);})",
                        NULL},
                    0);
    const double old = read_result(again.output, "w ");
    assert_true(old > 0.0);
    assert_true(read_result(again.output, "w2 ") == old);
    program_clear(&again);
    /* What it does from then on is not taken for what it did in the whole run. */
    again = program_run(folder,
                        (const char *[]){"run", path, "-t", "1", "-o", parts, "--resume", "-s", "end=25 ms", "-s",
                                         "probes=({name=\"w\"; type=\"wall_contact_force\"; wall=\"floor\"; "
                                         "direction=(0, -1); window=(\"11 ms\", \"20 ms\");}, {name=\"d\"; "
                                         "type=\"contact_depth\"; window=(\"11 ms\", \"20 ms\");}, {name=\"w2\"; "
                                         "type=\"wall_contact_force\"; wall=\"floor\"; direction=(0, -1);})",
                                         NULL},
                        0);
    program_expect_text(again.output, "are those from 0.02 s to 0.025 s");
    program_clear(&again);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_domain_does_not_change_the_force_of_an_impact, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_force_of_an_impact_follows_from_the_moduli_of_both_sides, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(surfaces_that_pass_through_each_other_stop_the_run, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_body_that_is_driven_into_a_wall_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(bodies_that_overlap_as_the_run_begins_are_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(energy_that_is_accounted_for_is_not_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(bodies_in_one_place_are_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_resume_keeps_the_forces_of_all_groups, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(shipped_blocks_slide_and_rest_as_coulomb_says, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_cube_from_a_mesh_slides_as_coulomb_says, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_rock_stands_on_its_base_beside_a_shallow_edge, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_corner_rebounds_as_it_is_told_to, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_flat_box_rebounds_as_it_is_told_to, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_stiffness_that_was_chosen_is_told, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
