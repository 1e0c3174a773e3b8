/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/probe/probe.h"
#include "materials/builtin.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#ifndef MOR_SOURCE_DIR
#define MOR_SOURCE_DIR "."
#endif

/* Each file in bad_cases/ is base.cfg or base_rocks.cfg with one defect. The message must name the file, the line, what
 * was found there, and what to write instead. */

#define FOLDER MOR_SOURCE_DIR "/tests/regression/bad_cases"

enum { PATH_BYTES = 1024 };

typedef struct bad_case {
    const char *name;
    int line;
    const char *found;
    const char *allowed;
} bad_case;

static const bad_case bad_cases[] = {
    {"unknown_top_level", 3, "unknown name 'spcing'", "did you mean 'spacing'?"},
    {"unknown_in_group", 23, "unknown name 'corant' in numerics", "did you mean 'courant'?"},
    {"parameter_by_symbol", 13, "unknown name 'E'", "did you mean 'youngs_modulus'?"},
    {"unknown_parameter", 15, "unknown name 'frction_angle'", "did you mean 'friction_angle'?"},
    {"unknown_in_soil", 8, "unknown name 'nam' in soil[0]", "allowed: name, velocity, released, particles, shape"},
    {"unknown_in_shape", 9, "unknown name 'radius' in soil[0].shape", "allowed: type, min, max"},
    {"released_with_velocity", 8, "'released' = 1 s and a velocity", "allowed: one of the two"},
    {"released_with_shifting", 7, "released = 1 s of the soil 'heap' with shifting", "allowed: one of the two"},
    {"unknown_model", 11, "\"druker_prager\"", "did you mean 'drucker_prager'?"},
    {"unknown_shape", 9, "\"bocks\"", "allowed: box, cylinder, cone, sphere, ellipsoid, half_space, polygon"},
    {"unknown_probe_type", 24, "\"runout\"", "did you mean 'run_out'?"},
    {"unknown_probe", 25, "\"height\"", "allowed: run_out"},
    {"unknown_word", 21, "\"ruff\"", "allowed: rough, smooth, coulomb"},
    {"unknown_wall", 24, "\"flor\"", "did you mean 'floor'?"},
    {"wrong_type_number", 3, "spacing = true", "allowed: > 0 m"},
    {"wrong_type_text", 1, "title = 5", "allowed: a text in quotes"},
    {"wrong_type_whole", 2, "dimension = 3,", "allowed: a whole number in [2, 3]"},
    {"wrong_type_switch", 23, "numerics.shifting = \"yes\"", "allowed: true or false"},
    {"wrong_type_vector", 5, "gravity = \"-9.81 m/s2\"", "allowed: 3 numbers in ( )"},
    {"wrong_type_group", 23, "numerics = 5", "allowed: a group"},
    {"wrong_type_list", 23, "probes = a group", "allowed: a list of 1 to 64 groups"},
    {"wrong_type_entry", 24, "probes[0] = \"run_out\"", "allowed: a group"},
    {"wrong_type_shape", 9, "soil[0].shape = \"box\"", "allowed: a group"},
    {"wrong_unit", 3, "spacing = \"5 kg\"", "converts to m"},
    {"wrong_unit_in_vector", 5, "gravity[2] = \"-9.81 m/s\"", "converts to m/s2"},
    {"wrong_unit_of_angle", 14, "poissons_ratio = \"30 deg\"", "allowed: in (-1, 0.5)"},
    {"wrong_unit_of_value", 25, "value = \"0.2 J\"", "converts to m"},
    {"unknown_unit", 4, "'parsec_s' is not a unit", "allowed: > 0 s"},
    {"shifted_unit", 4, "'degC' is a unit with a shifted zero", "allowed: > 0 s"},
    {"no_number", 4, "end = \"soon\"", "does not start with a number"},
    {"two_numbers", 3, "'10 mm' cannot be a unit", "allowed: > 0 m"},
    {"not_a_number_text", 4, "end = \"nan\"", "does not start with a number"},
    {"infinite_text", 4, "end = \"inf s\"", "does not start with a number"},
    {"infinite_number", 4, "end = inf", "not finite or above 1e30"},
    {"huge_number", 6, "domain.max[2] = 1e+31", "not finite or above 1e30"},
    {"tiny_number", 3, "spacing = \"1e-40 m\"", "neither zero nor above 1e-30"},
    {"out_of_range_low", 3, "spacing = \"-10 mm\", out of range", "allowed: > 0 m"},
    {"out_of_range_zero", 4, "end = 0", "allowed: > 0 s"},
    {"out_of_range_high", 23, "numerics.courant = 1.5", "allowed: in (0, 1]"},
    {"out_of_range_dimension", 2, "dimension = 4", "allowed: a whole number in [2, 3]"},
    {"out_of_range_parameter", 14, "poissons_ratio = 0.5", "allowed: in (-1, 0.5)"},
    {"angle_in_bare_degrees", 15, "friction_angle = 30", "with their unit, as \"30 deg\""},
    {"angle_beyond_a_turn", 23, "placement.angle = -35, an angle of more than a full revolution", "write \"-35 deg\""},
    {"angle_beyond_a_turn_quoted", 9, "an angle of more than a full revolution, 2 pi, without its unit",
     "\"35 deg\", or"},
    {"angle_expected_in_bare_degrees", 25, "expect[0].value = 33, an angle of more than", "write \"33 deg\""},
    {"ramp_beyond_the_end", 23, "numerics.gravity_ramp = 0.2 s in a run of 0.1 s", "shorten the ramp"},
    {"series_beyond_the_end", 23, "output.series_interval = 1 s in a run of 0.1 s", "allowed: up to end"},
    {"k0_without_gravity", 17, "type \"k0\" in a case without gravity", "correct 'gravity' or the type"},
    {"settled_without_gravity", 17, "type \"settled\" in a case without gravity", "or \"none\""},
    {"parameters_at_odds", 10, "found parameters that 'drucker_prager' refuses",
     "dilation_angle is 40 deg, more than friction_angle 30 deg: such flow would create energy; allowed: at most "
     "the friction angle; lower it"},
    {"long_name", 8, "soil[0].name = \"aaaa", "shorten it"},
    {"bad_name", 8, "soil[0].name = \"a heap\"", "letters, digits, '_' and '-' only"},
    {"duplicate_key", 4, "found 'spacing' again, which this group has in line 3", "allowed: each name once"},
    {"duplicate_key_of_line", 9, "found 'cohesion' again, which this group has in line 9", "remove one"},
    {"duplicate_wall", 22, "the name 'floor' again", "taken by line 18"},
    {"duplicate_probe", 24, "the probe name 'run_out' again", "allowed: each name once"},
    {"duplicate_expectation", 26, "a second expectation of 'run_out'", "line 25 has it"},
    {"missing_spacing", 1, "found no 'spacing' in the file", "allowed: > 0 m"},
    {"missing_domain", 1, "found no 'domain' in the file", "allowed: a group"},
    {"missing_soil", 1, "found neither 'soil' nor 'bodies'", "allowed: at least one soil region or one body"},
    {"missing_shape", 18, "found no 'shape' in walls[0]", "allowed: a group"},
    {"missing_parameter", 10, "found no 'youngs_modulus'", "allowed: > 0 Pa"},
    {"missing_radius", 9, "found no 'radius' in soil[0].shape", "allowed: > 0 m"},
    {"missing_coefficient", 18, "found no 'friction_coefficient'", "allowed: >= 0"},
    {"idle_coefficient", 22, "'friction_coefficient', which has no effect", "with friction = \"coulomb\""},
    {"idle_probe_key", 24, "'wall', which has no effect on a probe of type 'run_out'", "allowed: name, type, measure"},
    {"idle_thickness", 24, "'thickness', which has no effect here", "with measure = \"thickness\""},
    {"missing_pressure", 17, "found no 'pressure' in an initial stress of type \"uniform\"",
     "allowed: >= 0 Pa; add it"},
    {"idle_settle_key", 17, "found 'settle_force_ratio', which has no effect with this way of settling",
     "with settle_method = \"relaxation\""},
    {"idle_stress_key", 17, "'settle_time', which has no effect", "\"settled\""},
    {"direction_of_zero", 20, "normal = a list of 3, a direction of length zero", "give it a length"},
    {"empty_list", 23, "found probes = an empty list", "allowed: a list of 1 to 64 groups"},
    {"empty_union", 9, "found soil[0].shape.parts with 0 shapes", "allowed: 1 to 255"},
    {"empty_box", 9, "found a box that cannot be made", "correct its numbers"},
    {"few_corners", 9, "found a polygon of 2 corners", "allowed: 3 to 4096"},
    {"crossed_polygon", 9, "found a polygon that cannot be made", "correct its numbers"},
    {"short_vector", 5, "found gravity = a list of 2", "allowed: 3 numbers in ( )"},
    {"domain_inside_out", 6, "domain.max that is not above domain.min along y", "allowed: max > min"},
    {"odd_scale", 23, "found scale.length = 8", "allowed: even powers of two"},
    {"relative_to_zero", 25, "found value = 0 with a tolerance that is a share of it", "add absolute = true"},
    {"gravity_out_of_plane", 5, "found gravity along z in plane strain", "allowed: x and y"},
    {"include", 23, "found '@' of an @include", "allowed: one file"},
    {"unquoted_unit", 3, "found '10mm'", "put a value with a unit into quotes"},
    {"misplaced_text", 4, "found a text where none can stand", "look for a missing '='"},
    {"syntax_error", 4, "found 'end 0.1;', which does not parse", "allowed: 'name = value;'"},
    {"mixed_array", 6, "array [ ] of different types", "write ( )"},
    {"open_text", 1, "a text whose closing quote is not on its line", "add the quote"},
    {"open_comment", 3, "a comment that is still open", "add the closing mark"},
    {"open_bracket", 7, "'(' that is still open at the end of the file", "add ')'"},
    {"wrong_bracket", 6, "found ')'; allowed: '}' to close the '{' of line 6", "put that first"},
    {"spare_bracket", 23, "'}' without its opening bracket", "remove it"},
    {"large_whole_number", 2, "found the whole number 30000000000", "allowed: -2147483648 to 2147483647"},
    {"control_byte", 1, "control byte 0x07", "allowed: plain text"},
    {"zero_byte", 4, "control byte 0x00", "allowed: plain text"},
    {"deep_nesting", 1, "brackets nested more than 64 deep", "allowed: at most 64"},
    {"empty_file", 1, "found no 'dimension' in the file", "allowed: a whole number"},
    {"binary_file", 1, "control byte", "is this a case file?"},
    {"rock_mesh_missing", 13, "found a mesh that cannot be read", "a path from the folder of the case file"},
    {"rock_mesh_open", 13, "the surface is open: 20 edges", "larger ones must be closed by hand"},
    {"rock_mesh_crossing", 13, "the surface intersects itself", "repair the mesh there"},
    {"rock_mesh_of_text", 13, "found the extension 'txt'", "a mesh is read from .stl"},
    {"rock_mesh_cut_off", 13, "no STL file", "truncated"},
    {"rock_mesh_without_file", 13, "found no 'file' in bodies[0].shape", "allowed: a text"},
    {"rock_mesh_of_two_sizes", 13, "found 2 sizes of one shape", "one of scale, length, volume and diameter"},
    {"rock_outline_in_space", 13, "an outline in a case of dimension 3", "meshes in three dimensions"},
    {"rock_form_too_long", 13, "elongation = 0.2, out of range", "allowed: in [0.3, 1]"},
    {"rock_without_density", 18, "found no 'density' in bodies[0].material", "allowed: > 0 kg/m3"},
    {"rock_without_shape", 11, "found no 'shape' in bodies[0]", "allowed: a group"},
    {"rock_of_unknown_model", 18, "model = \"neo_hooke\"", "did you mean 'neo_hookean'?"},
    {"rock_of_soil", 18, "\"drucker_prager\"", "allowed: rigid, neo_hookean"},
    {"rock_unknown_name", 16, "unknown name 'velocty' in bodies[0]", "did you mean 'velocity'?"},
    {"rock_of_zero_axis", 15, "a direction of length zero", "give it a length"},
    {"rock_of_no_contact_modulus", 14, "bodies[0].contact_modulus = 0", "allowed: > 0 Pa"},
    {"rock_friction_negative", 14, "friction_coefficient = -0.1", "allowed: >= 0"},
    {"rock_friction_idle", 14, "'friction_coefficient', which has no effect", "with friction = \"coulomb\""},
    {"rock_friction_missing", 11, "found no 'friction_coefficient'", "allowed: >= 0"},
    {"rock_rigid_parameter", 23, "unknown name 'youngs_modulus' in bodies[1].material", "allowed: model, density"},
    {"rock_rigid_clamp", 24, "found 'clamp', which has no effect on the body 'block'",
     "with the model of an elastic material"},
    {"rock_rigid_start", 24, "found 'start', which has no effect on the body 'block'",
     "with the model of an elastic material"},
    {"rock_elastic_prescribed", 14, "found 'motion', which has no effect on the body 'ball'", "with model = \"rigid\""},
    {"rock_elastic_locked", 14, "found 'locked', which has no effect on the body 'ball'",
     "with model = \"rigid\" and motion = \"free\""},
    {"rock_prescribed_spring", 25, "found 'spring', which has no effect on the body 'block'", "motion = \"free\""},
    {"rock_spring_without_stiffness", 25, "found no 'stiffness' in bodies[1].spring", "allowed: >= 0 N/m"},
    {"rock_spring_without_effect", 25, "a spring of stiffness 0 and damping 0", "one of them above 0"},
    {"rock_spring_wrong_unit", 25, "stiffness = \"2 kN\"", "converts to N/m"},
    {"rock_lock_unknown", 24, "bodies[1].locked[1] = \"ra\"", "allowed: x, y, z, rx, ry, rz"},
    {"rock_velocity_locked", 24, "velocity with a component that 'y' in locked removes", "zero in locked directions"},
    {"rock_lock_turned", 24, "'x' in locked, which the rotation of placement moves away",
     "change the locks or the rotation"},
    {"rock_start_incomplete", 14, "found no 'direction' in this type of start", "add it"},
    {"rock_start_idle", 14, "found 'speed', which has no effect with this type of start", "with type = \"cantilever\""},
    {"rock_start_askew", 14, "not at right angles to axis", "across the bar"},
    {"rock_without_end", 22, "a body whose shape is unbounded along x", "make it a wall"},
    {"rock_named_as_rock", 21, "the name 'ball' again", "taken by line 11"},
    {"rock_named_as_wall", 21, "the name 'gate' again", "taken by line 9"},
    {"rock_name_too_long", 21, "bodies[1].name = \"bbbb", "shorten it"},
    {"rock_out_of_plane", 14, "found position with a component along z in plane strain", "allowed: x and y"},
    {"rock_turning_out_of_plane", 17, "found angular_velocity with a component in the plane", "(0, 0, z)"},
    {"rocks_too_many", 27, "rocks[0].content = 1.2", "allowed: in (0, 1)"},
    {"rocks_curve_open", 28, "ends with a share passing of 0.9", "allowed: 1"},
    {"rocks_form_unknown", 28, "rocks[0].forms[0].type = \"cube\"", "allowed: rock, sphere, ellipsoid, outline, mesh"},
    {"contact_friction_negative", 28, "contact.friction_coefficient = -0.5", "allowed: >= 0"},
    {"contact_restitution_zero", 29, "contact.pairs[0].restitution = 0", "allowed: in [0.01, 1]"},
    {"contact_restitution_high", 28, "contact.restitution = 1.5", "allowed: in [0.01, 1]"},
    {"contact_unknown_body", 29, "pairs[0].first = \"bal\"", "did you mean 'ball'?"},
    {"contact_of_walls", 29, "a pair of two walls, 'gate' and 'floor'", "name a body"},
    {"contact_with_itself", 29, "a pair of 'ball' with itself", "name another"},
    {"contact_pair_twice", 30, "the pair of 'floor' and 'ball' again", "line 29 has it"},
    {"probe_of_unknown_rock", 31, "probes[0].body = \"boll\"", "did you mean 'ball'?"},
    {"probe_without_rock", 31,
     "found no 'body' in probes[0]; allowed: a value, which a probe of type 'body_velocity' must have", "add it"},
    {"probe_without_soil", 31, "found the probe 'ball_speed' of type 'repose_angle' in a case without soil",
     "remove the probe or add soil"},
    {"probe_without_rocks", 24, "found the probe 'contact_depth' of type 'contact_depth' in a case without bodies",
     "add bodies"},
    {"gauge_without_structure", 23, "found neither 'wall' nor 'body' in a gauge", "add it"},
    {"gauge_on_two_structures", 23, "found 'body' beside 'wall' in a gauge", "one of them"},
    {"gauge_on_unknown_wall", 23, "\"flor\"", "did you mean 'floor'?"},
    {"gauge_of_two_filters", 23, "found 'cutoff' beside 'filter' in a gauge", "one of them"},
    {"gauge_of_small_cells", 23, "found cells of 0.001 m in a gauge", "no smaller than the spacing, 0.01 m"},
    {"gauge_named_twice", 23, "'g'", "name"},
    {"gauge_without_direction", 23, "direction", "add"},
    {"probe_of_unknown_gauge", 25, "\"h\"", "allowed: g"},
    {"path_of_one_point", 24, "found a path of 1 points", "2 to 256"},
    {"path_that_stands", 24, "found the same point of a path twice in a row", "points apart"},
    {"path_beside_direction", 24, "found 'direction', which has no effect beside 'path'", "one of both"},
    {"path_beside_radial", 24, "found 'radial', which has no effect beside 'path'", "one of both"},
    {"path_beside_origin", 24, "found 'origin', which has no effect beside 'path'", "one of both"},
    {"region_beside_origin", 24, "found 'origin', which has no effect beside 'region'", "one of both"},
    {"region_of_unknown_shape", 24, "\"bocks\"", "allowed: box, cylinder"},
    {"region_without_effect", 24, "found 'region', which has no effect on a probe of type 'toe'",
     "allowed: name, type"},
    {"contact_without_rocks", 23, "found 'contact', which has no effect in a case without bodies", "with bodies"},
};

static const char *const bases[] = {"base.cfg", "base_rocks.cfg"};

enum { N_BAD_CASES = sizeof bad_cases / sizeof bad_cases[0], N_BASES = sizeof bases / sizeof bases[0] };

typedef struct fixture {
    mor_context context;
    mor_registry *registry;
    mor_case the_case;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    if (f == NULL) {
        return 1;
    }
    *state = f;
    mor_context_init(&f->context);
    return mor_registry_new(&f->context, &f->registry) != MOR_OK ||
           mor_registry_add_list(&f->context, f->registry, mor_materials_builtin(NULL)) != MOR_OK;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    mor_registry_free(&f->context, &f->registry);
    const int is_leaking = f->context.memory_bytes != 0;
    free(f);
    return is_leaking;
}

/* Returns what is wrong with the answer to one bad case, NULL when nothing is. */
static const char *judge(const fixture *f, const bad_case *bad, mor_status status, const char *path)
{
    char start[PATH_BYTES];
    snprintf(start, sizeof start, "%s:%d: found ", path, bad->line);
    if (status != MOR_ERROR_CONFIG || f->context.status != MOR_ERROR_CONFIG) {
        return "the status is not MOR_ERROR_CONFIG";
    }
    if (strncmp(f->context.message, start, strlen(start)) != 0) {
        return "the message does not start with file, line and 'found'";
    }
    const char *found = strstr(f->context.message, bad->found);
    if (found == NULL) {
        return "the message does not say what was found";
    }
    if (strstr(f->context.message, bad->allowed) == NULL) {
        return "the message does not say what is allowed";
    }
    return strchr(f->context.message, ';') == NULL ? "the message has no advice" : NULL;
}

static void every_bad_case_is_refused_with_place_finding_and_advice(void **state)
{
    fixture *f = *state;
    int n_wrong = 0;
    for (int k = 0; k < N_BAD_CASES; ++k) {
        char path[PATH_BYTES];
        snprintf(path, sizeof path, "%s/%s.cfg", FOLDER, bad_cases[k].name);
        mor_context_clear_error(&f->context);
        const mor_status status =
            mor_case_read(&f->context, path, NULL, 0, f->registry, mor_probe_type_at, &f->the_case);
        const char *fault = judge(f, &bad_cases[k], status, path);
        if (fault != NULL) {
            print_error("%s: %s\n  message: %s\n", bad_cases[k].name, fault, f->context.message);
            ++n_wrong;
        }
        mor_case_clear(&f->context, &f->the_case);
    }
    assert_int_equal(n_wrong, 0);
}

static void the_bases_of_the_bad_cases_are_good(void **state)
{
    fixture *f = *state;
    for (int k = 0; k < N_BASES; ++k) {
        char path[PATH_BYTES];
        snprintf(path, sizeof path, "%s/%s", FOLDER, bases[k]);
        const mor_status status =
            mor_case_read(&f->context, path, NULL, 0, f->registry, mor_probe_type_at, &f->the_case);
        if (status != MOR_OK) {
            fail_msg("%s", f->context.message);
        }
        mor_case_clear(&f->context, &f->the_case);
    }
}

static int is_listed(const char *file)
{
    for (int k = 0; k < N_BAD_CASES; ++k) {
        char name[PATH_BYTES];
        snprintf(name, sizeof name, "%s.cfg", bad_cases[k].name);
        if (strcmp(name, file) == 0) {
            return 1;
        }
    }
    for (int k = 0; k < N_BASES; ++k) {
        if (strcmp(file, bases[k]) == 0) {
            return 1;
        }
    }
    return 0;
}

static void every_file_of_the_folder_is_listed(void **state)
{
    (void)state;
    DIR *folder = opendir(FOLDER);
    assert_non_null(folder);
    int n_files = 0;
    int n_unlisted = 0;
    for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        if (entry->d_name[0] == '.') {
            continue;
        }
        ++n_files;
        if (!is_listed(entry->d_name)) {
            print_error("%s is not in the list of this test\n", entry->d_name);
            ++n_unlisted;
        }
    }
    closedir(folder);
    assert_int_equal(n_unlisted, 0);
    assert_int_equal(n_files, N_BAD_CASES + N_BASES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bases_of_the_bad_cases_are_good),
        cmocka_unit_test(every_bad_case_is_refused_with_place_finding_and_advice),
        cmocka_unit_test(every_file_of_the_folder_is_listed),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
