/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Cases that read well but cannot be built: each is refused with file, line, what was found and what to do. */
#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/probe/probe.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "materials/builtin.h"
#include "tests/common/program.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Lines 1 to 9; soil stands in line 7, its wall in line 8. */
static const char base[] =
    "title = \"scene\";\n"
    "dimension = 2;\n"
    "spacing = \"0.1 m\";\n"
    "end = \"1 s\";\n"
    "gravity = (\"0 m/s2\", \"-10 m/s2\");\n"
    "domain = { min = (\"-1 m\", \"-1 m\"); max = (\"3 m\", \"3 m\"); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (\"0 m\", \"0 m\"); max = (\"1 m\", \"1 m\"); }; "
    "material = { model = \"drucker_prager\"; density = \"2000 kg/m3\"; youngs_modulus = \"1 MPa\"; "
    "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; velocity = (0.0, 0.0); initial_stress = { type = \"none\"; "
    "}; }, "
    "{ name = \"cap\"; shape = { type = \"box\"; min = (\"0 m\", \"1 m\"); max = (\"1 m\", \"1.5 m\"); }; "
    "material = { model = \"drucker_prager\"; density = \"2000 kg/m3\"; youngs_modulus = \"1 MPa\"; "
    "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (\"0 m\", \"0 m\"); normal = (0, 1); }; "
    "friction = \"rough\"; } );\n"
    "output = { color = \"speed\"; };\n";

/* Lines 1 to 11; the ball stands in line 9, the block in line 10. */
static const char base_rocks[] =
    "title = \"rocks\";\n"
    "dimension = 2;\n"
    "spacing = \"0.1 m\";\n"
    "end = \"1 s\";\n"
    "gravity = (\"0 m/s2\", \"-10 m/s2\");\n"
    "domain = { min = (\"-1 m\", \"-1 m\"); max = (\"6 m\", \"3 m\"); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (\"0 m\", \"0 m\"); max = (\"1 m\", \"1 m\"); }; "
    "material = { model = \"drucker_prager\"; density = \"2000 kg/m3\"; youngs_modulus = \"1 MPa\"; "
    "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (\"0 m\", \"0 m\"); normal = (0, 1); }; }, "
    "{ name = \"post\"; shape = { type = \"box\"; min = (\"4 m\", \"0.5 m\"); max = (\"4.2 m\", \"0.7 m\"); }; } );\n"
    "bodies = ( { name = \"ball\"; position = (\"2 m\", \"0.5 m\"); shape = { type = \"sphere\"; center = (\"0 m\", "
    "\"0 "
    "m\"); radius = \"0.3 m\"; }; material = { model = \"neo_hookean\"; density = \"2400 kg/m3\"; youngs_modulus = "
    "\"10 MPa\"; poissons_ratio = 0.2; }; },\n"
    "{ name = \"block\"; position = (\"3 m\", \"0.3 m\"); shape = { type = \"box\"; min = (\"-0.3 m\", \"-0.3 m\"); "
    "max "
    "= (\"0.3 m\", \"0.3 m\"); }; material = { model = \"rigid\"; density = \"2400 kg/m3\"; }; } );\n"
    "output = { color = \"speed\"; };\n";

typedef struct bad_scene {
    const char *setting, *found, *remedy; /* setting NULL: the base itself, which is good */
    bool has_line;
} bad_scene;

#define NONLOCAL                                                                                                       \
    "material={model=\"nonlocal_fluidity\"; density=2000; youngs_modulus=1e6; poissons_ratio=0.3; "                    \
    "static_friction=0.38; limiting_friction=0.64; grain_diameter=1e-3; "
static const bad_scene scenes[] = {
    {NULL, NULL, NULL, false},
    {"walls[0].shape.point=(\"0 m\", \"0.25 m\")", "overlapping wall 'floor': 20 of its 100 particles", "move one",
     true},
    {"soil[1].shape.min=(\"0 m\", \"0.75 m\")", "overlapping soil 'sand'", "move one", true},
    {"soil[0].shape.min=(\"-1.5 m\", \"0 m\")", "reaching out of the domain: 50 of its 250", "enlarge 'domain'", true},
    {"soil[1].shape.max=(\"0.02 m\", \"1.02 m\")", "soil 'cap' without a single particle", "spacing smaller", true},
    {"walls[0].shape.point=(\"0 m\", \"-9 m\")", "wall 'floor' without a single particle", "thicker or move it", true},
    {"soil[1].material.dilation_angle=40 deg", "dilation", "friction", true},
    {"soil=({name=\"sand\"; shape={type=\"box\"; min=(0, 0); max=(0.5, 0.5);}; " NONLOCAL "};}, "
     "{name=\"cap\"; shape={type=\"box\"; min=(0, 0.5); max=(0.5, 1);}; " NONLOCAL "time_scale=1e-3;};})",
     "time scale of the field of 0.001 s in soil 'cap' and of 0.0001 s in soil 'sand'", "change one of them", false},
    {"soil[0].material.dilation_angle=40 deg", "dilation", "friction", true},
    {"soil[1].initial_stress={type=\"k0\"; surface_level=\"0.5 m\";}",
     "surface_level = 0.5 m of soil 'cap', whose highest point is at 1.5 m: 50 of its 50", "raise the level", true},
    {"soil[1].initial_stress={type=\"k0\"; surface_level=\"1.2 m\";}", "at 1.5 m: 30 of its 50", "raise the level",
     true},
    {"end=1e30", "end = 1e+30 s, which takes about", "shorten end", true},
    {"numerics.damping=1e12", "under which nothing can move", "lower the damping to", true},
    {"domain.max=(1e9, 3.0)", "found 'floor' 1e+09 m long along x", "or a smaller 'domain'", true},
    /* What leaves the plane was cut with it: a smaller disc, a wall farther away than it is, a result along nothing. */
    {"walls[0].shape.normal=(0, 1, 1)", "found normal with a component along z in plane strain", "set it to zero",
     false},
    {"soil[0].shape={type=\"sphere\"; center=(0.5, 0.5, 0.2); radius=0.4;}", "found center with a component along z",
     "set it to zero", false},
    {"soil[0].shape={type=\"rotate\"; axis=(0, 1, 1); angle=0.1; shape={type=\"box\"; min=(0, 0); max=(1, 1);};}",
     "found axis with a component in the plane", "set x and y to zero", false},
    {"soil[0].shape={type=\"cylinder\"; base=(0.5, 0.1, 0.1); axis=(0, 1, 0); radius=0.4; height=0.5;}",
     "found base with a component along z", "set it to zero", false},
    {"soil[0].shape={type=\"cone\"; base=(0.5, 0.1, -0.1); axis=(0, 0, 1); radius=0.4; height=0.5;}",
     "found axis with a component along z", "set it to zero", false},
    {"soil[0].shape={type=\"translate\"; translation=(0, 0, 1); shape={type=\"box\"; min=(0, 0); max=(1, 1);};}",
     "found translation with a component along z", "set it to zero", false},
    {"soil[0].shape={type=\"translate\"; move=(0, 0, 1); shape={type=\"box\"; min=(0, 0); max=(1, 1);};}",
     "found translation with a component along z", "set it to zero", false},
    {"probes=({type=\"run_out\"; direction=(1, 0, 1);})", "found direction with a component along z", "set it to zero",
     false},
    {"soil[0].velocity=(\"50 m/s\", 0.0)", "soil 'sand' with a velocity of 50 m/s, beyond the speed of sound",
     "raise the stiffness", true},
    {"walls[0].velocity=(\"50 m/s\", 0.0)", "wall 'floor' with a velocity of 50 m/s, beyond the speed of sound",
     "lower the velocity", true},
    {"soil[0].initial_stress={type=\"settled\"; settle_time=1e29;}", "settle_time = 1e+29 s, which takes about",
     "shorten settle_time", true},
    {"spacing=3e-5 m", "too large for the memory: 1.11e+09 particles", "larger spacing", true},
    {"output.color=sped", "output.color = \"sped\"", "did you mean 'speed'?", false},
    {"output.color=soils", "output.color = \"soils\"", "did you mean 'soil'?", false},
    {"output.color=plasticstrain", "output.color = \"plasticstrain\"", "did you mean 'plastic_strain'?", false},
    {"output.color=bottom", "output.color = \"bottom\"", "use one of these", false},
    {"output.color=stress", "no number or vector", "use one of these", false},
    {"spacing=1e-9 m", "particles along an axis", "larger spacing", true},
    {"spacing=1.1e-5 m", "lattice nodes", "larger spacing", true},
};

/* Rocks packed on the floor, away from the others. */
#define PACKED(margin, smallest, largest)                                                                              \
    "rocks=({name=\"r\"; content=0.3; margin=\"" margin "\"; particles=\"relaxed\"; "                                  \
    "region={type=\"box\"; min=(\"0 m\", \"0 m\"); max=(\"5.5 m\", \"2.5 m\");}; "                                     \
    "sizes=({diameter=\"" smallest "\"; passing=0;}, {diameter=\"" largest                                             \
    "\"; passing=1;}); forms=({type=\"rock\";}); "                                                                     \
    "material={model=\"rigid\"; density=2500;};})"

/* Whatever is wrong with a rock is told with its line. */
static const bad_scene rock_scenes[] = {
    {NULL, NULL, NULL, false},
    {"bodies[1].position=(\"2.55 m\", \"0.5 m\")", "body 'ball' overlapping body 'block' by at least 0.035 m",
     "move one of them", true},
    {"bodies[1].position=(\"2 m\", \"0.5 m\")", "body 'ball' overlapping body 'block'", "move one of them", true},
    {"bodies[1].position=(\"3 m\", \"0.25 m\")", "body 'block' overlapping wall 'floor' by at least 0.05 m",
     "move the body or the wall", true},
    {"bodies[1].position=(\"4.1 m\", \"0.6 m\")", "body 'block' overlapping wall 'post'", "move the body or the wall",
     true},
    {"bodies[1].position=(\"5.9 m\", \"0.5 m\")", "m; the domain is (-1, -1, ", "enlarge 'domain' or move", true},
    {"bodies[1].position=(\"3 m\", \"-40 m\")", "body 'block' reaching out of the domain", "enlarge 'domain' or move",
     true},
    {"bodies[1].shape.max=(\"0.3 m\", \"0 m\")", "0.3 m long along its own y, which is 3 particles",
     "use a spacing of at most 0.0853 m, or a larger body", true}, /* 0.3 m / 3.5, less half a percent */
    {"bodies[0].shape.radius=0.1 m", "0.2 m long along its own x, which is 2 particles", "at least 4 particles across",
     true},
    {"bodies[1].shape={type=\"half_space\"; point=(\"0 m\", \"0 m\"); normal=(0, 1);}", "unbounded along x",
     "make it a wall", false},
    {"bodies[1].shape={type=\"difference\"; from={type=\"sphere\"; center=(\"0 m\", \"0 m\"); radius=\"0.3 m\";}; "
     "minus={type=\"sphere\"; center=(\"0 m\", \"0 m\"); radius=\"0.299 m\";};}",
     "body 'block' without a single particle", "thicker body", true},
    /* A ring of one layer: in its straight parts no neighbor lies aside. */
    {"bodies[0].shape={type=\"difference\"; from={type=\"sphere\"; center=(\"0 m\", \"0 m\"); radius=\"0.3 m\";}; "
     "minus={type=\"sphere\"; center=(\"0 m\", \"0 m\"); radius=\"0.24 m\";};}",
     "body 'ball' is too thin at", "make the spacing (0.1 m) smaller, the tip or edge blunter, or the body rigid",
     true},
    {"bodies[0].shape={type=\"rotate\"; angle=\"45 deg\"; shape={type=\"box\"; min=(\"-0.5 m\", \"-0.03 m\"); "
     "max=(\"0.5 m\", \"0.03 m\");};}",
     "body 'ball' has too few particles near", "smaller spacing or make it rigid", true},
    {"bodies[0].clamp={type=\"box\"; min=(\"4 m\", \"0 m\"); max=(\"5 m\", \"1 m\");}",
     "a clamp of body 'ball' that holds none of its", "move the clamp", true},
    {PACKED("-0.3 m", "0.8 m", "0.9 m"), "overlapping wall '", "raise 'margin' or shrink 'region'", false},
    {PACKED("0.1 m", "0.45 m", "0.5 m"), "m thick at its thickest", "use a spacing of at most", false},
    /* Of many sizes the thinnest rock is told, and a spacing for all that may be drawn. */
    {PACKED("0.1 m", "0.45 m", "0.9 m"), "it is the thinnest of the rocks", "is fine enough for all sizes", false},
    {"soil[0].shape={type=\"box\"; min=(\"2.9 m\", \"0.2 m\"); max=(\"3.1 m\", \"0.4 m\");}",
     "soil 'sand' without a single particle", "make the region larger", true},
};

enum { N_SCENES = sizeof scenes / sizeof *scenes, N_ROCK_SCENES = sizeof rock_scenes / sizeof *rock_scenes };

/* A ball without soil: it meets the shapes of walls, which have no particles. */
static const char base_ball[] =
    "title = \"ball\";\n"
    "dimension = 2;\n"
    "spacing = \"0.1 m\";\n"
    "end = \"1 s\";\n"
    "gravity = (\"0 m/s2\", \"-10 m/s2\");\n"
    "domain = { min = (\"-1 m\", \"-1 m\"); max = (\"6 m\", \"3 m\"); };\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (\"0 m\", \"0 m\"); normal = (0, 1); }; } "
    ");\n"
    "bodies = ( { name = \"ball\"; position = (\"2 m\", \"0.5 m\"); shape = { type = \"sphere\"; center = (\"0 m\", "
    "\"0 m\"); "
    "radius = \"0.3 m\"; }; material = { model = \"rigid\"; density = \"2400 kg/m3\"; }; } );\n";

static const bad_scene ball_scenes[] = {
    {NULL, NULL, NULL, false},
    {"walls[0].shape.point=(\"0 m\", \"-20 m\")", "wall 'floor' outside the domain", "move the wall", true},
    {"numerics.damping=1e12", "under which nothing can move", "lower the damping to", true},
    {"end=1e29", "end = 1e+29 s, which takes about", "limited by the contact of a rigid body", true},
};

/* Two soils, of which the lower one moves. */
static const char base_layers[] =
    "title = \"layers\";\n"
    "dimension = 2;\n"
    "spacing = \"0.1 m\";\n"
    "end = \"1 s\";\n"
    "gravity = (\"0 m/s2\", \"-10 m/s2\");\n"
    "domain = { min = (\"-1 m\", \"-1 m\"); max = (\"3 m\", \"3 m\"); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (\"0 m\", \"0 m\"); max = (\"1 m\", \"1 m\"); }; "
    "material = { model = \"drucker_prager\"; density = \"2000 kg/m3\"; youngs_modulus = \"1 MPa\"; "
    "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; velocity = (0.0, -0.01); },\n"
    "{ name = \"cap\"; shape = { type = \"box\"; min = (\"0 m\", \"1 m\"); max = (\"1 m\", \"1.5 m\"); }; "
    "material = { model = \"drucker_prager\"; density = \"1500 kg/m3\"; youngs_modulus = \"1 MPa\"; "
    "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; initial_stress = { type = \"none\"; }; } );\n"
    "probes = ( { name = \"ratio\"; type = \"stress_ratio\"; } );\n";

static const bad_scene layer_scenes[] = {
    {NULL, NULL, NULL, false},
    {"probes[0].type=stress_error",
     "scene.cfg:9: probe 'ratio': found 2 soils, but it compares with the weight of one; allowed is one soil",
     "remove the probe", true},
    {"soil[1].initial_stress.type=settled",
     "scene.cfg:7: found soil 'sand' with a velocity of (0, -0.01, 0) m/s and soil 'cap' with a settled initial stress",
     "remove 'velocity'", true},
};

/* Reads and builds a scene; message receives what was said. */
static mor_status build_scene(const char *source, const char *setting, char *message, size_t room)
{
    static mor_case the_case; /* large, and empty again after each use */
    static mor_simulation simulation;
    mor_context context;
    mor_registry *registry = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const mor_case_text text = {"scene.cfg",     source,   (int64_t)strlen(source), &setting,
                                setting != NULL, registry, mor_probe_type_at,       NULL};
    mor_status status = mor_case_read_text(&context, &text, &the_case);
    if (status == MOR_OK) {
        status = mor_simulation_init(&context, &simulation, &the_case, registry);
    }
    if (status == MOR_OK) {
        mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
        const int n_sets = mor_simulation_sets(&simulation, false, sets);
        status = mor_pictures_check(&context, &the_case, sets, n_sets);
    }
    snprintf(message, room, "%s", status == MOR_OK ? "" : context.message);
    mor_simulation_clear(&context, &simulation);
    mor_case_clear(&context, &the_case);
    mor_registry_free(&context, &registry);
    assert_int_equal(context.memory_bytes, 0); /* exact: a refusal leaves nothing behind */
    return status;
}

static void expect_refusals(const char *source, const bad_scene *list, int n)
{
    for (int k = 0; k < n; ++k) {
        char message[MOR_CONTEXT_MESSAGE_BYTES];
        const mor_status status = build_scene(source, list[k].setting, message, sizeof message);
        if (list[k].setting == NULL) {
            assert_int_equal(status, MOR_OK);
            continue;
        }
        const bool is_told = strstr(message, list[k].found) != NULL && strstr(message, list[k].remedy) != NULL &&
                             (!list[k].has_line || strstr(message, "scene.cfg:") != NULL);
        if (status != MOR_ERROR_CONFIG || !is_told) {
            fail_msg("--set %s: status %d, message: %s", list[k].setting, (int)status, message);
        }
    }
}

static void scene_that_cannot_be_built_is_refused_with_place_and_remedy(void **state)
{
    (void)state;
    expect_refusals(base, scenes, N_SCENES);
}

static void rock_that_cannot_be_built_is_refused_with_place_and_remedy(void **state)
{
    (void)state;
    expect_refusals(base_rocks, rock_scenes, N_ROCK_SCENES);
}

static void ball_that_cannot_be_computed_is_refused_with_the_cause(void **state)
{
    (void)state;
    expect_refusals(base_ball, ball_scenes, sizeof ball_scenes / sizeof *ball_scenes);
}

static void layers_that_cannot_be_computed_are_refused_before_the_run(void **state)
{
    (void)state;
    expect_refusals(base_layers, layer_scenes, sizeof layer_scenes / sizeof *layer_scenes);
}

/* The program ends with the code of bad input and says where to look. */
static void program_refuses_a_scene_as_bad_input(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, "case.cfg"), base_rocks, strlen(base_rocks));
    const char *const arguments[] = {
        "run", "case.cfg", "-o", "out", "--set", "bodies[1].position=(\"3 m\", \"0.25 m\")", NULL};
    program_outcome outcome = program_run(folder, arguments, 2);
    program_expect_text(outcome.errors, "case.cfg:10: found body 'block' overlapping wall 'floor'");
    program_clear(&outcome);
}

/* Stacked regions share one surface: the lower one carries the weight of the upper one. */
static void geostatic_stress_counts_all_soil_straight_above(void **state)
{
    (void)state;
    static mor_case the_case;
    static mor_simulation simulation;
    mor_context context;
    mor_registry *registry = NULL;
    const char *settings[] = {"soil[0].initial_stress.type=k0"};
    mor_context_init(&context);
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const mor_case_text text = {"scene.cfg", base,     (int64_t)strlen(base), settings,
                                1,           registry, mor_probe_type_at,     NULL};
    assert_int_equal(mor_case_read_text(&context, &text, &the_case), MOR_OK);
    assert_int_equal(mor_simulation_init(&context, &simulation, &the_case, registry), MOR_OK);
    const mor_set *set = &simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double height = set->data[MOR_FIELD_POSITION][3 * i + 1];
        const double vertical = set->data[MOR_FIELD_STRESS][6 * i + 1];
        const double expected = height < 1.0 ? -2000.0 * 10.0 * (1.5 - height) : 0.0;
        assert_true(fabs(vertical - expected) <= 1e-9 * 30000.0); /* rounding of heights, against 30 kPa at the base */
    }
    mor_simulation_clear(&context, &simulation);
    mor_case_clear(&context, &the_case);
    mor_registry_free(&context, &registry);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_that_cannot_be_built_is_refused_with_place_and_remedy),
        cmocka_unit_test(rock_that_cannot_be_built_is_refused_with_place_and_remedy),
        cmocka_unit_test(ball_that_cannot_be_computed_is_refused_with_the_cause),
        cmocka_unit_test(layers_that_cannot_be_computed_are_refused_before_the_run),
        cmocka_unit_test_setup_teardown(program_refuses_a_scene_as_bad_input, run_folder_setup, run_folder_teardown),
        cmocka_unit_test(geostatic_stress_counts_all_soil_straight_above),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
