/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/case_reading.h"
#include "tests/common/near.h"

#include "core/base/math.h"

/* Prescribed motions, times of removal and formulas in a case: what is read, refused, and written back. */

#define MATERIAL                                                                                                       \
    "material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.3; "            \
    "friction_angle = \"30 deg\"; }; "
#define TABLE                                                                                                          \
    "table = ( { time = 0; }, { time = \"0.5 s\"; translation = (\"10 cm\", 0); angle = \"30 deg\"; }, "               \
    "{ time = 2; angle = \"-1080 deg\"; } ); "

static const char text[] =
    "dimension = 2; spacing = 0.05; end = 1; gravity = (0, -10); domain = { min = (-1, -1); max = (5, 5); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0, 0); max = (1, 1); }; " MATERIAL
    "initial_stress = { type = \"formula\"; formula = (\"-100*(1-y)\", -2e2, \"-x\", \"0\"); };\n"
    "velocity_formula = (\"0.1*y\", \"0\"); } );\n"
    "walls = ( { name = \"drum\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); };\n"
    "  removed_at = \"300 ms\"; path = { point = (1, 2); interpolation = \"smooth\"; " TABLE "}; } );\n"
    "bodies = ( { name = \"tool\"; position = (3, 3); shape = { type = \"box\"; min = (-0.5, -0.5); max = (0.5, 0.5); "
    "};\n"
    "  material = { model = \"rigid\"; density = 2000; }; motion = \"prescribed\"; removed_at = 0.75;\n"
    "  path = { table = ( { time = 0; }, { time = 1; translation = (0, -1); } ); }; } );\n";

static void a_path_is_read_in_si(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, text, NULL, &f->first);
    const mor_case_wall *wall = &f->first.walls[0];
    assert_int_equal(wall->path.n_rows, 3);
    assert_true(wall->path.is_smooth && wall->removed_at == 0.3);
    assert_near(wall->path.rows[1].translation[0], 0.1, 1e-16);
    assert_near(wall->path.rows[2].angle, -6.0 * MOR_PI, 1e-14); /* rounding of degrees */
    assert_true(wall->path.axis[2] == 1.0 && wall->path.point[0] == 1.0 && wall->path.point[1] == 2.0);
    const mor_case_body *body = &f->first.bodies[0];
    assert_int_equal(body->path.n_rows, 2);
    assert_true(!body->path.is_smooth && isnan(body->path.point[0]) && body->removed_at == 0.75);
    assert_string_equal(f->first.soils[0].velocity_formula[0], "0.1*y");
    assert_string_equal(f->first.soils[0].stress_formula[1], "-200");
    assert_int_equal(f->first.soils[0].initial_stress, MOR_CASE_STRESS_FORMULA);
}

/* The case as it was used, read again, is the same text. */
static void a_case_is_written_back(void **state)
{
    case_reading *f = *state;
    char *texts[2] = {NULL, NULL};
    size_t n_bytes[2] = {0, 0};
    const char *source = text;
    for (int k = 0; k < 2; ++k) {
        FILE *stream = open_memstream(&texts[k], &n_bytes[k]);
        assert_non_null(stream);
        case_reading_read(f, source, NULL, &f->first);
        assert_int_equal(mor_case_write_stream(&f->context, &f->first, f->registry, stream), MOR_OK);
        fclose(stream);
        source = texts[k];
    }
    assert_non_null(strstr(texts[0], "velocity_formula = (\"0.1*y\", \"0\");"));
    assert_non_null(strstr(texts[0], "removed_at = "));
    assert_int_equal(f->first.walls[0].path.n_rows, 3);
    assert_int_equal(f->first.bodies[0].path.n_rows, 2);
    /* Only what was a default is told otherwise the second time. */
    for (int k = 0; k < 2; ++k) {
        char *to = texts[k];
        for (const char *from = texts[k]; *from != '\0'; ++from) {
            const char *mark = "# default";
            if (strncmp(from, mark, strlen(mark)) == 0) {
                from += strlen(mark) - 1;
            } else if (*from != ' ') {
                *to++ = *from;
            }
        }
        *to = '\0';
    }
    assert_string_equal(texts[0], texts[1]);
    free(texts[0]);
    free(texts[1]);
}

static void contradictions_are_refused(void **state)
{
    static const char *const wrong[][2] = {
        {"walls[0].velocity=(\"1 m/s\", 0)", "found both 'velocity' and 'path'"},
        {"bodies[0].velocity=(\"1 m/s\", 0)", "found both 'velocity' and 'path'"},
        {"bodies[0].angular_velocity=(0, 0, 1)", "found both 'angular_velocity' and 'path'"},
        {"bodies[0].motion=free", "found 'path', which has no effect on the body 'tool'"},
        {"walls[0].path.file=a.csv", "with both of 'table' and 'file'"},
        {"walls[0].path={ point = (0, 0); }", "with none of 'table' and 'file'"},
        {"walls[0].path={ file = \"nowhere.csv\"; }", "found a table of a motion that cannot be read"},
        {"walls[0].path.table[0].angle=1", "allowed: zero for both"},
        {"walls[0].path.table[2].time=0.5", "allowed: times that rise"},
        {"walls[0].path.table[1].time=-1", "path.table[1].time = -1"},
        {"walls[0].path={ table = ( { time = 0; } ); }", "on which nothing moves"},
        {"walls[0].path.axis=(0, 1, 0)", "axis"},
        {"walls[0].path.table[1].translation=(0, 0, 1)", "translation"},
        {"walls[0].path.interpolation=cubic", "linear, smooth"},
        {"walls[0].removed_at=0", "removed_at = 0"},
        {"soil[0].velocity_formula=(\"0.1*q\", \"0\")", "unknown at letter 5"},
        {"soil[0].velocity_formula=(\"0\", \"0\", \"0\")", "found 3 formulas"},
        {"soil[0].velocity=(\"1 m/s\", 0)", "found both 'velocity' and 'velocity_formula'"},
        {"soil[0].initial_stress.formula=(\"0\")", "found 1 formulas"},
        {"soil[0].initial_stress.type=k0", "found 'formula', which has no effect"},
        {"soil[0].initial_stress={ type = \"formula\"; }", "found no 'formula'"},
        {"excavate=( { type = \"box\"; min = (0, 0); max = (1, 1); } )", "found 'excavate' without 'start_from'"},
        {"start_from=nowhere", "found a run to start from"},
    };
    case_reading *f = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        const char *const settings[] = {wrong[k][0], NULL};
        case_reading_refuse(f, text, settings, "", wrong[k][1]);
    }
}

static void a_table_of_a_file_has_units_in_its_headings(void **state)
{
    static const char *const wrong[][2] = {{"time,x\n0,0\n0,1\n", "found the time 0 s in row 2"},
                                           {"time,x\n-1,0\n0,1\n", "found the time -1 s in row 1"},
                                           {"x\n1\n", "found no column 'time'"},
                                           {"time,z\n0,0\n", "found the column 'z'"},
                                           {"time [m],x\n0,0\n", "found the unit [m] of time"},
                                           {"time,x\n", "found a table without a time"},
                                           {"time,angle\n0,0\n1,90\n", "found the heading angle without a unit"},
                                           {"time,x\n0,1\n", "allowed: zero for both"}};
    case_reading *f = *state;
    char path[600];
    char setting[700];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/path.csv", folder == NULL ? "/tmp" : folder);
    snprintf(setting, sizeof setting, "walls[0].path={ file = \"%s\"; }", path);
    const char *const settings[] = {setting, NULL};
    for (size_t k = 0; k <= sizeof wrong / sizeof *wrong; ++k) {
        const bool is_good = k == sizeof wrong / sizeof *wrong;
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fputs(is_good ? "angle [deg], time [ms], y [mm]\n0, 0, 0\n90, 250, -20\n" : wrong[k][0], file);
        fclose(file);
        if (!is_good) {
            case_reading_refuse(f, text, settings, "", wrong[k][1]);
        }
    }
    case_reading_read(f, text, settings, &f->first);
    const mor_case_path *it = &f->first.walls[0].path;
    assert_int_equal(it->n_rows, 2);
    assert_true(it->file_hash != 0);
    assert_near(it->rows[1].time, 0.25, 1e-16);
    assert_near(it->rows[1].angle, 0.5 * MOR_PI, 1e-15);
    assert_near(it->rows[1].translation[1], -0.02, 1e-17);
    assert_true(it->rows[1].translation[0] == 0.0);
    /* Scaled as the rest of the case is. */
    const char *const scaled[] = {setting, "scale.length=4", "scale.time=16", NULL};
    case_reading_read(f, text, scaled, &f->second);
    assert_true(f->second.walls[0].path.rows[1].time == 16.0 * it->rows[1].time);
    assert_true(f->second.walls[0].path.rows[1].translation[1] == 4.0 * it->rows[1].translation[1]);
    assert_true(f->second.walls[0].path.rows[1].angle == it->rows[1].angle);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_path_is_read_in_si, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_case_is_written_back, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(contradictions_are_refused, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_table_of_a_file_has_units_in_its_headings, case_reading_set_up,
                                        case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
