/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/snapshot.h"
#include "tests/common/finished_run.h"
#include "tests/common/near.h"
#include "tests/common/program.h"

#include <math.h>

/* The commands that show what there is before a run: relax and preview. */

static const char cube_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
static const char square_txt[] = "# a square\n0 0\n2 0\n2 2\n0 2\n";

static void store_inputs(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, "cube.obj"), cube_obj, sizeof cube_obj - 1);
    run_folder_store(run_folder_file(folder, path, "square.txt"), square_txt, sizeof square_txt - 1);
    run_folder_store(run_folder_file(folder, path, "open.obj"), cube_obj, 48);
    run_folder_store(run_folder_file(folder, path, "cube.csv"), cube_obj, 48);
}

static void expect_picture(run_folder *folder, const char *name)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(run_folder_file(folder, path, name), &n_bytes);
    assert_non_null(bytes);
    assert_true(n_bytes > sizeof signature);
    assert_memory_equal(bytes, signature, sizeof signature);
    free(bytes);
}

/* Reads a table of particles: their number, the sum of their volumes and the largest coordinate from the origin. */
static int64_t read_table(run_folder *folder, const char *name, const char *header, double *volume, double *reach)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(run_folder_file(folder, path, name), &n_bytes);
    assert_non_null(text);
    assert_memory_equal(text, header, strlen(header));
    int64_t n = 0;
    *volume = 0.0;
    *reach = 0.0;
    for (char *line = strchr(text, '\n') + 1; *line != '\0'; line = strchr(line, '\n') + 1) {
        double row[4];
        assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf", &row[0], &row[1], &row[2], &row[3]), 4);
        for (int a = 0; a < 3; ++a) {
            *reach = fmax(*reach, fabs(row[a]));
        }
        *volume += row[3];
        n += 1;
    }
    free(text);
    return n;
}

static void relax_fills_a_mesh_with_its_volume_and_repeats_itself(void **state)
{
    run_folder *folder = *state;
    const char *const first[] = {"relax", "cube.obj", "--spacing", "20 cm", "--length", "2", NULL};
    const char *const second[] = {"relax", "cube.obj", "--spacing", "0.2",   "--volume", "8",
                                  "-t",    "1",        "-o",        "again", NULL};
    char path[MOR_PATH_BYTES];
    double volume = 0.0;
    double reach = 0.0;
    size_t n_bytes[2];
    store_inputs(folder);
    program_outcome outcome = program_run(folder, first, 0);
    program_expect_text(outcome.output, "1 connected part");
    program_expect_text(outcome.output, "particles                     1000 of 0.008 m3");
    program_expect_text(outcome.output, "nearest neighbor");
    program_expect_text(outcome.output, "picture: runs/relax-cube/images/particles.png");
    assert_string_equal(outcome.errors, "");
    program_clear(&outcome);
    assert_int_equal(
        read_table(folder, "runs/relax-cube/particles.csv", "x [m],y [m],z [m],volume [m3]\n", &volume, &reach), 1000);
    assert_near(volume, 8.0, 1e-12); /* a thousand roundings */
    assert_true(reach > 1.8 && reach < 2.0);
    expect_picture(folder, "runs/relax-cube/images/particles.png");
    outcome = program_run(folder, second, 0);
    program_clear(&outcome);
    unsigned char *a = run_folder_load(run_folder_file(folder, path, "runs/relax-cube/particles.csv"), &n_bytes[0]);
    unsigned char *b = run_folder_load(run_folder_file(folder, path, "again/particles.csv"), &n_bytes[1]);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(n_bytes[0], n_bytes[1]);
    assert_memory_equal(a, b, n_bytes[0]); /* whatever the number of threads and the way to say the size */
    free(a);
    free(b);
    mor_snapshot snapshot;
    assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, run_folder_file(folder, path, "again"), 0), MOR_OK);
    assert_int_equal(snapshot.sets[0].n_particles, 1000);
    assert_non_null(mor_snapshot_find_field(&snapshot.sets[0], "depth"));
    mor_snapshot_close(&folder->context, &snapshot);
}

static void relax_fills_an_outline_with_its_area(void **state)
{
    run_folder *folder = *state;
    const char *const arguments[] = {"relax", "square.txt", "--spacing", "5 cm", "--length", "1", "-o", "flat", NULL};
    double area = 0.0;
    double reach = 0.0;
    store_inputs(folder);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "\narea                          1 m2\n");
    program_clear(&outcome);
    assert_int_equal(read_table(folder, "flat/particles.csv", "x [m],y [m],z [m],volume [m2]\n", &area, &reach), 400);
    assert_near(area, 1.0, 1e-13); /* four hundred roundings */
    assert_true(reach > 0.45 && reach < 0.5);
    expect_picture(folder, "flat/images/particles.png");
}

static void relax_refuses_what_it_cannot_fill(void **state)
{
    static const struct {
        const char *arguments[10];
        const char *message;
    } refusals[] = {
        {{"relax", "cube.obj", NULL}, "needs the spacing"},
        {{"relax", "none.obj", "--spacing", "1", NULL},
         "none.obj: cannot be read: No such file or directory; check the path"},
        {{"relax", "open.obj", "--spacing", "1", NULL}, "open.obj: is no mesh"},
        {{"relax", "cube.obj", "--spacing", "-1", NULL},
         "found --spacing '-1'; allowed: > 0 m, such as 0.05 or '5 cm'"},
        {{"relax", "cube.obj", "--spacing", "1 kg", NULL}, "(kg); allowed: > 0 m, such as 0.05 or '5 cm'"},
        {{"relax", "cube.obj", "--spacing", "1", "--length", "1", "--diameter", "1", NULL},
         "more than one of --length"},
        /* The same advice at any spacing: a quarter of the cube's side, less a thousandth for the digits. */
        {{"relax", "cube.obj", "--spacing", "0.3", NULL}, "cube.obj: the shape (level set) is 1 m thick"},
        {{"relax", "cube.obj", "--spacing", "0.3", NULL}, "use a spacing of at most 0.2497 m, or make it larger"},
        {{"relax", "cube.obj", "--spacing", "300", NULL}, "use a spacing of at most 0.2497 m, or make it larger"},
        {{"relax", "cube.csv", "--spacing", "1", NULL}, "an outline from .txt"},
        {{"relax", "cube.obj", "--spacing", "0.001", NULL}, "as its file is read in meters"},
        {{"check", "cube.obj", "--spacing", "1", NULL}, "belongs to moraine relax"},
        {{"preview", "none.cfg", NULL}, "none.cfg"},
    };
    run_folder *folder = *state;
    store_inputs(folder);
    for (size_t k = 0; k < sizeof refusals / sizeof *refusals; ++k) {
        program_outcome outcome = program_run(folder, refusals[k].arguments, 2);
        program_expect_text(outcome.errors, refusals[k].message);
        program_clear(&outcome);
    }
}

static void what_was_read_is_said_before_what_is_wrong_with_it(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char command[2 * MOR_PATH_BYTES];
    char text[4096];
    store_inputs(folder);
    snprintf(command, sizeof command, "'%s' relax '%s' --spacing 3 2>&1", PROGRAM_PATH,
             run_folder_file(folder, path, "cube.obj"));
    FILE *both = popen(command, "r");
    assert_non_null(both);
    text[fread(text, 1, sizeof text - 1, both)] = '\0';
    assert_int_equal(WEXITSTATUS(pclose(both)), 2);
    const char *read = strstr(text, "triangles read");
    const char *refusal = strstr(text, "moraine: ");
    assert_non_null(read);
    assert_non_null(refusal);
    assert_true(read < refusal);
}

static void preview_draws_the_first_state_and_spares_runs(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const preview[] = {"preview", path, "-t", "1", "-o", "seen", NULL};
    const char *const run[] = {"run", path, "-t", "1", "-o", "done", "--set", "output.pictures=false", NULL};
    const char *const over[] = {"preview", path, "-o", "done", NULL};
    finished_run_store_case(folder, path);
    for (int k = 0; k < 2; ++k) { /* a second time replaces the first */
        program_outcome outcome = program_run(folder, preview, 0);
        program_expect_text(outcome.output, "picture: seen/images/step_000000_");
        assert_string_equal(outcome.errors, "");
        char *name = strchr(outcome.output, ':') + 2;
        *strchr(name, '\n') = '\0';
        expect_picture(folder, name);
        program_clear(&outcome);
    }
    program_outcome outcome = program_run(folder, run, 0);
    program_clear(&outcome);
    outcome = program_run(folder, over, 2);
    program_expect_text(outcome.errors, "already holds a run; choose another folder");
    program_clear(&outcome);
}

static void the_log_of_a_run_holds_what_was_said_before_there_was_a_folder(void **state)
{
    static const char text[] =
        "dimension = 3; spacing = 0.2; gravity = (0, 0, 0); end = \"1 ms\";\n"
        "domain = { min = (-3, -3, -3); max = (3, 3, 3); }; output = { pictures = false; };\n"
        "bodies = ( { name = \"b\"; position = (0, 0, 0); shape = { type = \"mesh\"; file = \"torn.obj\"; };\n"
        "  material = { model = \"rigid\"; density = 2600; }; } );\n";
    static const char *const said[] = {"info: moraine ", "torn.obj: repaired: 1 hole filled\n", "info: body 'b': "};
    const char *const run[] = {"run", "torn.cfg", "-t", "1", "-o", "out", NULL};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    run_folder_store(run_folder_file(folder, path, "torn.cfg"), text, sizeof text - 1);
    run_folder_store(run_folder_file(folder, path, "torn.obj"), cube_obj, sizeof cube_obj - 1 - strlen("f 4 1 5 8\n"));
    program_outcome outcome = program_run(folder, run, 0);
    const char *once = strstr(outcome.errors, "repaired");
    assert_non_null(once);
    assert_null(strstr(once + 1, "repaired")); /* the terminal was told at once */
    program_clear(&outcome);
    char *log = (char *)run_folder_load(run_folder_file(folder, path, "out/log.txt"), &n_bytes);
    assert_non_null(log);
    const char *place = log;
    for (size_t k = 0; k < sizeof said / sizeof *said; ++k) { /* in this order */
        place = strstr(place, said[k]);
        assert_non_null(place);
    }
    free(log);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(relax_fills_a_mesh_with_its_volume_and_repeats_itself),
        TEST(relax_fills_an_outline_with_its_area),
        TEST(relax_refuses_what_it_cannot_fill),
        TEST(what_was_read_is_said_before_what_is_wrong_with_it),
        TEST(preview_draws_the_first_state_and_spares_runs),
        TEST(the_log_of_a_run_holds_what_was_said_before_there_was_a_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
