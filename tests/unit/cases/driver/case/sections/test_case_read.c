/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "tests/common/case_reading.h"
#include "tests/common/full_disk.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

/* Everything a case in three dimensions may have. */
static const char full_text[] =
    "title = \"Full \\\"case\\\" \\\\ 3D\";\n"
    "dimension = 3; spacing = \"5 mm\"; end = \"0.5 s\"; gravity = (\"0\", 0, \"-9.81 m/s2\"); seed = "
    "9007199254740993L;\n"
    "domain = { min = (\"-40 cm\", -0.4, -0.1); max = (0.4, 0.4, 0.3); };\n"
    "lattice = { origin = (0, \"1 mm\", 0); jitter = 0.1; };\n"
    "placement = { axis = (1, 2, 2); angle = \"30 deg\"; translation = (0, 0.5, 0); };\n"
    "soil = (\n"
    "  { name = \"column\"; velocity = (0.25, 0, \"-10 cm/s\");\n"
    "    shape = { type = \"difference\";\n"
    "      from = { type = \"cylinder\"; base = (0, 0, 0); axis = (0, 0, 2); radius = \"10 cm\"; height = 0.1; };\n"
    "      minus = ( { type = \"sphere\"; center = (0, 0, 0.05); radius = 0.01; },\n"
    "        { type = \"rotate\"; angle = \"45 deg\"; shape = { type = \"box\"; min = (0, 0, 0); max = (1, 1, 1); }; } "
    "); };\n"
    "    material = { model = \"drucker_prager\"; density = \"2.6 t/m3\"; youngs_modulus = \"5.98 MPa\";\n"
    "      poissons_ratio = 0.3; friction_angle = \"30 deg\"; cohesion = \"2 kPa\"; cone = \"extension\"; };\n"
    "    initial_stress = { type = \"settled\"; lateral_ratio = 0.5; surface_level = \"10 cm\"; settle_time = 2; }; "
    "},\n"
    "  { name = \"second\"; shape = { type = \"translate\"; translation = (0.1, 0, 0);\n"
    "      shape = { type = \"union\"; parts = ( { type = \"polygon\"; points = ((0, 0), (1, 0), (0, \"1 m\")); } ); "
    "}; };\n"
    "    material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"
    "      friction_angle = 0.5; };\n"
    "    initial_stress = { type = \"k0\"; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0, 0); normal = (0, 0, 3); }; },\n"
    "  { name = \"gate\"; shape = { type = \"box\"; min = (1, 1, 1); max = (2, 2, 2); }; friction = \"coulomb\";\n"
    "    friction_coefficient = 0.3; velocity = (0, 0, 1);\n"
    "    friction_with = ( { soil = \"second\"; friction = \"smooth\"; },\n"
    "      { soil = \"column\"; friction = \"coulomb\"; friction_coefficient = 0.7; } ); } );\n"
    "numerics = { dissipation = \"both\"; damping = \"2 1/s\"; gravity_ramp = \"10 ms\"; artificial_stress = true;\n"
    "  reconstruction = \"none\"; stress_diffusion_limiter = \"motion\";\n"
    "  density_reinitialization = 0; dissipation_factor = 50; };\n"
    "probes = ( { type = \"run_out\"; }, { name = \"front\"; type = \"run_out\"; measure = \"thickness\";\n"
    "    thickness = \"3 mm\"; direction = (3, 0, 4); origin = (0.1, 0, 0); },\n"
    "  { name = \"push\"; type = \"wall_force\"; wall = \"gate\"; direction = (1, 1, 1); },\n"
    "  { type = \"kinetic_energy\"; }, { type = \"density_drift\"; }, { type = \"height\"; percentile = \"99 %\"; } "
    ");\n"
    "expect = ( { probe = \"run_out\"; value = \"22.4 cm\"; tolerance = 0.05; source = \"Lube et al. 2004\"; },\n"
    "  { probe = \"kinetic_energy\"; value = 0; tolerance = \"1 mJ\"; tolerance_low = \"2 mJ\"; absolute = true; } );\n"
    "output = { snapshots = 5; checkpoint_seconds = \"1 min\"; color = \"pressure\"; view = (1, 1, 0.5); cut = true; "
    "};\n";

/* As little as a case may have. */
static const char least_text[] =
    "dimension = 2; spacing = 0.01; end = 1; gravity = (0, -9.81); domain = { min = (-1, -1); max = (1, 1); };\n"
    "soil = ( { name = \"heap\"; shape = { type = \"box\"; min = (0, 0); max = (0.5, 0.25); };\n"
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"
    "    friction_angle = 0.5; }; } );\n";

/* ---- What arrives ------------------------------------------------------------------------------------------------ */

static void values_arrive_in_si(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, full_text, NULL, &f->first);
    const mor_case *c = &f->first;
    assert_string_equal(c->title, "Full \"case\" \\ 3D");
    assert_string_equal(c->path, "t.cfg");
    assert_true(c->spacing == 0.005 && c->end == 0.5 && c->gravity[2] == -9.81); /* exact: decimal factors round once */
    assert_true(c->domain_minimum[0] == -0.4 && c->domain_maximum[2] == 0.3);    /* exact, as above */
    assert_true(c->seed == 9007199254740993u);                                   /* exact: not through double */
    assert_true(c->lattice_origin[1] == 0.001 && c->jitter_ratio == 0.1);        /* exact, as above */
    assert_int_equal(c->n_soils, 2);
    const mor_case_soil *soil = &c->soils[0];
    assert_true(soil->density == 2600.0 && soil->velocity[0] == 0.25 && soil->velocity[2] == -0.1); /* exact */
    const mor_schema *schema = mor_registry_find(f->registry, "drucker_prager")->parameters;
    assert_true(soil->parameters[mor_params_find(schema, "youngs_modulus")] == 5.98e6); /* exact */
    assert_true(soil->parameters[mor_params_find(schema, "cohesion")] == 2000.0);       /* exact */
    assert_true(soil->parameters[mor_params_find(schema, "cone")] == 2.0);              /* exact: index of a word */
    assert_int_equal(soil->initial_stress, MOR_CASE_STRESS_SETTLED);
    assert_true(soil->surface_level == 0.1 && soil->settle_time == 2.0); /* exact */
    assert_int_equal(soil->place.line, 7);
    assert_int_equal(c->walls[1].friction, MOR_CASE_FRICTION_COULOMB);
    assert_true(c->walls[1].friction_coefficient == 0.3 && c->walls[1].velocity[2] == 1.0); /* exact */
    const mor_case_frictions *frictions = &c->walls[1].friction_with;
    assert_int_equal(c->walls[0].friction_with.n, 0);
    assert_int_equal(frictions->n, 2);
    assert_string_equal(frictions->of[0].soil, "second");
    assert_int_equal(frictions->of[0].friction, MOR_CASE_FRICTION_SMOOTH);
    assert_int_equal(frictions->of[1].friction, MOR_CASE_FRICTION_COULOMB);
    assert_true(frictions->of[1].coefficient == 0.7); /* exact */
    assert_int_equal(c->numerics.dissipation, 2);
    assert_int_equal(c->numerics.wall_dissipation, 0);
    assert_true(c->numerics.dissipation_factor == 50.0 && c->numerics.damping == 2.0); /* exact */
    assert_true(c->numerics.artificial_stress);
    assert_int_equal(c->numerics.reconstruction, 0);
    assert_int_equal(c->numerics.stress_diffusion_limiter, 1);
    assert_int_equal(c->numerics.density_reinitialization, 0);
    assert_true(c->output.checkpoint_seconds == 60.0); /* exact */
    assert_true(c->output.has_cut && c->output.has_pictures);
    assert_string_equal(c->output.color_field, "pressure");
}

static void what_is_not_written_gets_its_default(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, least_text, NULL, &f->first);
    const mor_case *c = &f->first;
    assert_string_equal(c->title, "");
    assert_int_equal(c->seed, 1);
    assert_true(c->numerics.smoothing_ratio == 1.3 && c->numerics.courant == 0.6); /* exact */
    assert_true(c->numerics.dissipation_factor == 40.0);                           /* exact: 20 * dimension */
    assert_int_equal(c->numerics.dissipation, 0);
    assert_int_equal(c->numerics.wall_dissipation, 0);
    assert_int_equal(c->numerics.scheme, 0);                   /* moraine */
    assert_int_equal(c->numerics.reconstruction, 1);           /* linear */
    assert_int_equal(c->numerics.stress_diffusion_limiter, 2); /* transient */
    assert_int_equal(c->numerics.velocity_gradient, 2);        /* transient */
    assert_true(c->numerics.soil_hourglass == 0.25);           /* exact */
    assert_int_equal(c->numerics.density_reinitialization, 20);
    assert_int_equal(c->numerics.sort_interval, 100);
    assert_true(c->output.series_interval == 1.0 / 200.0); /* exact: the same operation */
    assert_int_equal(c->output.n_snapshots, 20);
    assert_string_equal(c->output.color_field, "speed");
    assert_int_equal(c->soils[0].initial_stress, MOR_CASE_STRESS_NONE);
    assert_true(isnan(c->soils[0].surface_level) && c->soils[0].lateral_ratio == -1.0); /* exact: marks of "chosen" */
    assert_true(c->soils[0].settle_time == 1.0 && c->scale_length == 1.0);              /* exact */
    assert_int_equal(c->n_walls + c->n_probes + c->n_expectations, 0);
    for (int k = 0; k < 9; ++k) {
        assert_true(c->rotation[k] == (k % 4 == 0 ? 1.0 : 0.0)); /* exact: no placement is no rounding */
    }
}

static void plane_strain_takes_vectors_of_two(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, least_text, NULL, &f->first);
    const mor_case *c = &f->first;
    assert_true(c->gravity[0] == 0.0 && c->gravity[1] == -9.81 && c->gravity[2] == 0.0); /* exact */
    assert_true(c->domain_minimum[2] == -0.01 && c->domain_maximum[2] == 0.01);          /* exact: a spacing */
    assert_true(mor_shape_distance(c->soils[0].shape, (double[]){0.25, 0.125, 0.0}) < 0.0);
    mor_bounds bounds;
    mor_shape_bounds(c->soils[0].shape, &bounds);
    assert_true(isinf(bounds.minimum[2]) && isinf(bounds.maximum[2]));
}

static void shapes_are_built_as_described(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, full_text, NULL, &f->first);
    const mor_shape *column = f->first.soils[0].shape;
    assert_true(mor_shape_distance(column, (double[]){-0.05, 0.0, 0.01}) < 0.0);  /* in the cylinder */
    assert_true(mor_shape_distance(column, (double[]){-0.005, 0.0, 0.05}) > 0.0); /* in the ball taken away */
    assert_true(mor_shape_distance(column, (double[]){0.0, 0.05, 0.01}) > 0.0);   /* in the turned box */
    assert_true(mor_shape_distance(column, (double[]){0.05, 0.0, 0.01}) < 0.0);   /* beside the turned box */
    const mor_shape *moved = f->first.soils[1].shape;
    assert_true(mor_shape_distance(moved, (double[]){0.2, 0.1, 7.0}) < 0.0); /* the polygon has no end in z */
    assert_true(mor_shape_distance(moved, (double[]){0.05, 0.1, 0.0}) > 0.0);
    assert_true(fabs(mor_shape_distance(f->first.walls[0].shape, (double[]){1.0, 2.0, 0.3}) - 0.3) < 1e-16); /* 1 ulp */
}

static void the_placement_becomes_a_rotation(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, full_text, NULL, &f->first);
    const double *rotation = f->first.rotation;
    const double axis[3] = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
    double turned[3];
    mor_matrix_apply(rotation, axis, turned);
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(turned[a] - axis[a]) < 4e-16); /* rounding of three products */
    }
    const double trace = rotation[0] + rotation[4] + rotation[8];
    assert_true(fabs(trace - (1.0 + sqrt(3.0))) < 1e-15); /* rounding: 1 + 2 cos 30 deg */
    assert_true(f->first.translation[1] == 0.5);          /* exact */
}

static void probes_are_completed_by_their_type(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, full_text, NULL, &f->first);
    const mor_case_probe *p = f->first.probes;
    assert_int_equal(f->first.n_probes, 6);
    assert_string_equal(p[0].name, "run_out");
    assert_string_equal(p[0].measure, "mass_percentile");
    assert_true(p[0].is_radial && p[0].percentile == 99.5); /* exact */
    assert_false(p[1].is_radial);
    assert_string_equal(p[1].measure, "thickness");
    assert_true(p[1].thickness == 0.003);                                               /* exact */
    assert_true(fabs(p[1].direction[0] - 0.6) + fabs(p[1].direction[2] - 0.8) < 2e-16); /* 1 ulp each */
    assert_string_equal(p[2].wall, "gate");
    assert_true(fabs(mor_vector_length(p[2].direction) - 1.0) < 4e-16); /* rounding */
    assert_true(p[4].percentile == 99.0 && p[5].percentile == 99.0);    /* exact: default of the type; written */
    assert_true(f->first.expectations[0].tolerance_low == 0.05);        /* exact: as tolerance */
    assert_true(f->first.expectations[1].tolerance_low == 0.002);       /* exact */
    assert_true(f->first.expectations[1].is_absolute);
}

static void settings_of_the_command_line_win(void **state)
{
    case_reading *f = *state;
    const char *settings[] = {"numerics.stress_diffusion=0", "soil[0].material.friction_angle=40 deg", "spacing=2 mm",
                              "spacing=4 mm", NULL};
    case_reading_read(f, full_text, settings, &f->first);
    assert_true(f->first.numerics.stress_diffusion == 0.0 && f->first.spacing == 0.004); /* exact: the last one */
    const mor_schema *schema = mor_registry_find(f->registry, "drucker_prager")->parameters;
    const double angle = f->first.soils[0].parameters[mor_params_find(schema, "friction_angle")];
    assert_true(fabs(angle - 40.0 * MOR_PI / 180.0) < 2e-16); /* two roundings */
    case_reading_refuse(f, full_text, (const char *[]){"spacing=5 kg", NULL},
                        "override 'spacing=5 kg': found spacing = \"5 kg\"", "allowed: > 0 m");
    case_reading_refuse(f, full_text, (const char *[]){"numerics.corant=1", NULL},
                        "override 'numerics.corant=1': found the unknown", "did you mean 'courant'?");
    case_reading_refuse(f, full_text, (const char *[]){"soil[7].name=x", NULL},
                        "override 'soil[7].name=x': found entry [7]", "allowed");
}

static void the_unit_of_an_energy_depends_on_the_dimension(void **state)
{
    case_reading *f = *state;
    const char *plane[] = {"probes=( { type = \"kinetic_energy\"; } )",
                           "expect=( { probe = \"kinetic_energy\"; value = \"2 kJ/m\"; tolerance = 0.1; } )", NULL};
    case_reading_read(f, least_text, plane, &f->first);
    assert_true(f->first.expectations[0].value == 2000.0); /* exact */
    plane[1] = "expect=( { probe = \"kinetic_energy\"; value = \"2 kJ\"; tolerance = 0.1; } )";
    case_reading_refuse(f, least_text, plane, "override 'expect=", "converts to J/m");
}

static void what_belongs_together_is_demanded_together(void **state)
{
    static const struct {
        const char *setting;
        const char *fragment;
    } rows[] = {{"probes[2].direction=(0, 0, 0)", "a direction of length zero"},
                {"probes=( { type = \"momentum\"; } )",
                 "found no 'direction' in probes[0]; allowed: a value, which a probe of type 'momentum' must have"},
                {"probes=( { type = \"run_out\"; radial = true; direction = (1, 0, 0); } )", "with radial = false"},
                {"probes=( { type = \"run_out\"; measure = \"thickness\"; percentile = 50; } )", "\"mass_percentile\""},
                {"probes=( { type = \"mass\"; percentile = 50; } )", "no effect on a probe of type 'mass'"},
                {"walls[1].friction=smooth", "'friction_coefficient', which has no effect"},
                {"walls[0].friction_with=( { soil = \"second\"; } )", "found no 'friction'"},
                {"walls[1].friction_with[0].soil=sand", "name of a soil"},
                {"walls[1].friction_with[0].soil=column", "the soil 'column' again"},
                {"walls[1].friction_with[0].friction=coulomb", "found no 'friction_coefficient'"},
                {"walls[1].friction_with[1].friction=rough", "'friction_coefficient', which has no effect"},
                {"walls[1].friction_with[1].colour=red", "unknown name 'colour'"},
                {"probes=( { type = \"mass\"; soil = \"sand\"; } )", "name of a soil"},
                {"probes=( { type = \"total_energy\"; soil = \"second\"; } )", "no effect on a probe of type"},
                {"soil[1].initial_stress.settle_time=1 s", "'settle_time', which has no effect"},
                {"soil[1].name=column", "the name 'column' again"},
                {"soil[0].material.dilation_angle=31 deg", "that 'drucker_prager' refuses"},
                {"expect[0].probe=mass", "name of a probe of this case"},
                {"expect[0].statistic=maximim", "maximum"},
                {"expect[0].statistic=impulse", "'run_out', which is no force; allowed: value, maximum, minimum, mean"},
                {"probes[0].window=(0.2, 0.2)", "found the window from 0.2 s to 0.2 s of probe 'run_out'"},
                {"probes[0].window=(0.3, 0.2)", "the first before the second"},
                {"probes[0].window=(\"0 s\", \"1 h\")", "two times of the run, which lasts from 0 to"},
                {"probes[0].window=(-0.1, 0.2)", "out of range"},
                {"probes[0].window=(0.1)", "probes[0].window"},
                {"expect[1].absolute=false", "a plain number"},
                {"scale.time=2.0", "even powers of two"},
                {"scale.mass=3", "even powers of two"},
                {"scale.length=0", "out of range"},
                {"placement.angle=-35", "write \"-35 deg\""},
                {"placement.angle=\"400\"", "more than a full revolution"},
                {"soil[0].material.density=19.62 kN/m3", "write \"2000 kg/m3\" for 9.81 m/s2"},
                {"soil[0].material.density=2000 Pa", "a unit that converts to kg/m3"},
                {"dimension=2", "in plane strain"}};
    case_reading *f = *state;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        case_reading_refuse(f, full_text, (const char *[]){rows[k].setting, NULL}, "", rows[k].fragment);
    }
}

/* All of them, each with its place; what ends the reading comes last. */
static void names_that_are_unknown_are_told_together(void **state)
{
    case_reading *f = *state;
    const char *settings[] = {"numerics.corant=0.4", "output.snapshts=3", "walls[1].colour=red", NULL, NULL};
    static const char *const parts[] = {
        "found the unknown name 'corant' in numerics; allowed: ",
        "\noverride 'output.snapshts=3': found 'snapshts' in output, unknown, too; did "
        "you mean 'snapshots'?",
        "\noverride 'walls[1].colour=red': found 'colour' in walls[1], unknown, too; 'list "
        "keys' tells what there is"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
        case_reading_refuse(f, full_text, settings, "override 'numerics.corant=0.4'", parts[k]);
    }
    settings[3] = "walls[1].name=5";
    case_reading_refuse(f, full_text, settings, "override 'numerics.corant=0.4'", parts[2]);
    case_reading_refuse(f, full_text, settings, "override 'numerics.corant=0.4'",
                        "\noverride 'walls[1].name=5': found walls[1].name = 5, which is no text");
}

#define START "dimension = 2; spacing = 0.1; end = 1.0; gravity = (0, -9.81, 0); "
#define DOMAIN "domain = { min = (0, 0, -1); max = (1, 1, 1); }; "
#define SOIL(parameters)                                                                                               \
    "soil = ( { name = \"s\"; shape = { type = \"box\"; min = (0, 0, -1); max = (0.5, 0.5, 1); }; material = { "       \
    "model = \"drucker_prager\"; density = 2000; youngs_modulus = 5e6; poissons_ratio = 0.3; " parameters " }; } ); "

/* A key that the case must have is not told again as missing when it is there under a name that is misspelled; what is
 * missing is. */
static void a_required_name_that_is_misspelled_is_told_once(void **state)
{
    static const struct {
        const char *text;
        bool is_told;
    } rows[] = {
        {"dimension = 2; spacng = 0.1;", false},
        {"dimension = 2; seed = 1; colour = 3;", true},
        {START "doman = { min = (0, 0, -1); max = (1, 1, 1); };", false}, /* a group */
        {START DOMAIN SOIL("friction_angle = 0.5;") "walls = ( { name = \"w\"; shpe = { type = \"sphere\"; }; } );",
         false},
        {START DOMAIN SOIL("friction_angl = 0.5;"), false}, /* of a law */
        {START DOMAIN SOIL("friction_angle = 0.5; colour = 3;"), false},
        {START DOMAIN SOIL("colour = 3;"), true},
        {START DOMAIN SOIL("friction_angle = 0.5;") "probes = ( { name = \"p\"; type = \"momentum\"; "
                                                    "directon = (1, 0, 0); } );",
         false}};
    case_reading *f = *state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        case_reading_refuse(f, rows[k].text, (const char *[]){NULL}, "t.cfg:1", "found the unknown name");
        const char *missing = strstr(f->context.message, "found no ");
        assert_true((missing != NULL) == rows[k].is_told);
    }
}

/* Those for which a message has no room are counted. */
static void many_names_that_are_unknown_are_counted(void **state)
{
    enum { MANY = 20 };
    case_reading *f = *state;
    char settings[MANY][32];
    const char *all[MANY + 1] = {NULL};
    for (int k = 0; k < MANY; ++k) {
        snprintf(settings[k], sizeof settings[k], "numerics.unknown_%d=1", k);
        all[k] = settings[k];
    }
    case_reading_refuse(f, full_text, all, "override 'numerics.unknown_0=1'",
                        "\noverride 'numerics.unknown_1=1': found");
    int n_told = 1;
    for (const char *line = f->context.message; (line = strchr(line, '\n')) != NULL; ++line) {
        n_told += strncmp(line, "\noverride", 9) == 0;
    }
    char end[64];
    snprintf(end, sizeof end, "\nand %d more unknown names", MANY - n_told);
    assert_true(n_told > 2 && n_told < MANY);
    assert_non_null(strstr(f->context.message, end));
}

/* One whose misspelled name there was no room to tell is told as missing. */
static void a_required_name_is_told_where_its_misspelling_is_not(void **state)
{
    enum { MANY = 20 };
    case_reading *f = *state;
    char text[MANY * 32 + 64] = "dimension = 2;";
    for (int k = 0; k < MANY; ++k) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, " unknown_name_%d = 1;", k);
    }
    strcat(text, " spacng = 0.1;");
    case_reading_refuse(f, text, (const char *[]){NULL}, "t.cfg:1", "more unknown names");
    assert_null(strstr(f->context.message, "spacng"));
    assert_non_null(strstr(f->context.message, "found no 'spacing'"));
}

static void a_cut_case_is_refused_or_whole_but_never_half_kept(void **state)
{
    case_reading *f = *state;
    mor_case_clear(&f->context, &f->first);
    const size_t before = f->context.memory_bytes;
    int n_refused = 0;
    for (size_t n_bytes = 0; n_bytes < strlen(full_text); n_bytes += 13) {
        if (case_reading_try(f, full_text, n_bytes, NULL, &f->first) != MOR_OK) {
            ++n_refused;
            assert_int_equal(f->context.status, MOR_ERROR_CONFIG);
            assert_non_null(strstr(f->context.message, "t.cfg:"));
            assert_int_equal(f->first.n_soils, 0);
        }
        mor_case_clear(&f->context, &f->first);
        assert_true(f->context.memory_bytes == before);
    }
    assert_true(n_refused > 100); /* nearly all of the prefixes lack something required */
}

/* ---- The scale --------------------------------------------------------------------------------------------------- */

static void the_scale_multiplies_every_dimensional_value_exactly(void **state)
{
    case_reading *f = *state;
    const char *settings[] = {"scale.length=4", "scale.mass=0.0625", "scale.time=64", NULL};
    case_reading_read(f, full_text, NULL, &f->first);
    case_reading_read(f, full_text, settings, &f->second);
    const mor_case *plain = &f->first;
    const mor_case *scaled = &f->second;
    case_reading_scaled_cases(f);
    const double point[3] = {0.03, 0.02, 0.04};
    const double far_point[3] = {0.12, 0.08, 0.16};
    const double distance = mor_shape_distance(plain->soils[0].shape, point);
    assert_true(mor_shape_distance(scaled->soils[0].shape, far_point) == 4.0 * distance); /* exact: powers of two */
    assert_true(scaled->expectations[0].value == 4.0 * plain->expectations[0].value);     /* exact: a length */
    assert_true(scaled->expectations[0].tolerance == plain->expectations[0].tolerance);   /* exact: a share */
    const double energy = 0.0625 * 16.0 / 4096.0;
    assert_true(scaled->expectations[1].tolerance == energy * plain->expectations[1].tolerance); /* exact: m l2 / t2 */
    assert_memory_equal(plain->rotation, scaled->rotation, sizeof plain->rotation);
}

/* ---- Writing and reading again ----------------------------------------------------------------------------------- */

static void a_written_case_reads_back_to_the_same_bits(void **state)
{
    case_reading_round_trip(*state, full_text, NULL);
    case_reading_round_trip(*state, least_text, NULL);
    case_reading_round_trip(*state, full_text,
                            (const char *[]){"scale.length=4", "scale.mass=0.0625", "scale.time=64",
                                             "placement.angle=7 deg", "probes[2].direction=(1, 2, 3)", "spacing=0.1 in",
                                             NULL});
    case_reading_round_trip(*state, least_text, (const char *[]){"scale.length=0.25", "scale.time=16", NULL});
    /* Keys that a path or a region leaves without effect are refused, so that they must not be written. */
    case_reading_round_trip(
        *state, least_text,
        (const char *[]){
            "probes=({type=\"run_out\"; path=((0, 0), (1, 0));},"
            "{type=\"energy_line\"; origin=(0, 1); path=((0, 0), (1, 0));},"
            "{type=\"soil_stress\"; direction=(0, 1); region={type=\"sphere\"; center=(0, 0); radius=1;};})",
            NULL});
}

static void a_written_case_marks_defaults_and_only_them(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, full_text, NULL, &f->first);
    char *text = case_reading_write(f, &f->first);
    assert_non_null(strstr(text, "smoothing_ratio = 1.3; # default\n"));
    assert_non_null(strstr(text, "damping = \"2.0 1/s\";\n"));
    assert_non_null(strstr(text, "spacing = \"0.005 m\";\n"));
    assert_non_null(strstr(text, "series_interval = \"0.0025 s\"; # default\n"));
    assert_non_null(strstr(text, "dilation_angle = \"0.0 rad\"; # default\n"));
    assert_non_null(strstr(text, "cone = \"extension\";\n"));
    assert_non_null(strstr(text, "# lateral_ratio: 1 - sin(friction angle) (default)\n"));
    case_reading_read(f, text, NULL, &f->second);
    free(text);
    text = case_reading_write(f, &f->second);
    assert_null(strstr(text, "; # default\n"));
    free(text);
}

/* A disk that is full after 64 bytes: the file of before stays, and nothing else is left. */
static void check_full_disk(case_reading *f, const char *path)
{
    char temporary[600];
    full_disk disk;
    struct stat old;
    struct stat now;
    snprintf(temporary, sizeof temporary, "%s.tmp", path);
    assert_int_equal(stat(path, &old), 0);
    full_disk_begin(&disk, 64);
    const mor_status status = mor_case_write(&f->context, &f->first, f->registry, path);
    full_disk_end(&disk);
    assert_int_equal(status, MOR_ERROR_IO);
    assert_non_null(strstr(f->context.message, path));
    assert_non_null(strstr(f->context.message, strerror(EFBIG)));
    assert_int_equal(stat(path, &now), 0);
    assert_true(now.st_ino == old.st_ino && now.st_size == old.st_size && old.st_size > 64);
    assert_int_not_equal(access(temporary, F_OK), 0);
}

static void a_case_is_written_to_a_file_or_not_with_a_reason(void **state)
{
    case_reading *f = *state;
    char path[512];
    const char *scratch = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/case_read_XXXXXX", scratch == NULL ? "/tmp" : scratch);
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    case_reading_read(f, least_text, NULL, &f->first);
    const mor_status written = mor_case_write(&f->context, &f->first, f->registry, path);
    mor_case_clear(&f->context, &f->second);
    const mor_status again = mor_case_read(&f->context, path, NULL, 0, f->registry, mor_probe_type_at, &f->second);
    assert_int_equal(written, MOR_OK);
    assert_int_equal(again, MOR_OK);
    assert_string_equal(f->second.path, path);
    assert_int_equal(mor_case_write(&f->context, &f->first, f->registry, "/nowhere/case.cfg"), MOR_ERROR_IO);
    assert_non_null(strstr(f->context.message, "/nowhere/case.cfg"));
    check_full_disk(f, path);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_arrive_in_si),
        cmocka_unit_test(what_is_not_written_gets_its_default),
        cmocka_unit_test(plane_strain_takes_vectors_of_two),
        cmocka_unit_test(shapes_are_built_as_described),
        cmocka_unit_test(the_placement_becomes_a_rotation),
        cmocka_unit_test(probes_are_completed_by_their_type),
        cmocka_unit_test(settings_of_the_command_line_win),
        cmocka_unit_test(the_unit_of_an_energy_depends_on_the_dimension),
        cmocka_unit_test(what_belongs_together_is_demanded_together),
        cmocka_unit_test(names_that_are_unknown_are_told_together),
        cmocka_unit_test(a_required_name_that_is_misspelled_is_told_once),
        cmocka_unit_test(many_names_that_are_unknown_are_counted),
        cmocka_unit_test(a_required_name_is_told_where_its_misspelling_is_not),
        cmocka_unit_test(a_cut_case_is_refused_or_whole_but_never_half_kept),
        cmocka_unit_test(the_scale_multiplies_every_dimensional_value_exactly),
        cmocka_unit_test(a_written_case_reads_back_to_the_same_bits),
        cmocka_unit_test(a_written_case_marks_defaults_and_only_them),
        cmocka_unit_test(a_case_is_written_to_a_file_or_not_with_a_reason),
    };
    return cmocka_run_group_tests(tests, case_reading_set_up, case_reading_tear_down);
}
