/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_inputs.h"
#include "cases/driver/probe/probe.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "tests/common/case_reading.h"
#include "tests/common/near.h"

#include <unistd.h>

/* A cube of 2 m away from the origin, its faces quadrangles; and the same turned inside out. */
#define CUBE_CORNERS "v 4 4 4\nv 6 4 4\nv 6 6 4\nv 4 6 4\nv 4 4 6\nv 6 4 6\nv 6 6 6\nv 4 6 6\n"
static const char cube[] = CUBE_CORNERS "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n";
static const char cube_inside_out[] = CUBE_CORNERS "f 2 3 4 1\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\nf 8 7 6 5\n";
static const char triangle[] = "# profile\n0 0\n3 0\n0 3\n";

/* A case of one rigid body; %s: dimension, gravity, then the shape. */
#define CASE_HEAD(dimension, gravity)                                                                                  \
    "dimension = " dimension "; spacing = 0.125; end = 1; gravity = " gravity ";\n"                                    \
    "domain = { min = (-8, -8, -8); max = (8, 8, 8); };\n"                                                             \
    "bodies = ( { name = \"rock\"; material = { model = \"rigid\"; density = 2600; };\n"
static const char space_head[] = CASE_HEAD("3", "(0, 0, -10)");
static const char plane_head[] = CASE_HEAD("2", "(0, -10)");

typedef struct form_fixture {
    case_reading reading; /* first, so that it is one */
    char folder[256];
    char log[4096]; /* what was logged */
} form_fixture;

static void keep_log(void *user, mor_log_level level, const char *text)
{
    form_fixture *f = user;
    (void)level;
    strncat(f->log, text, sizeof f->log - strlen(f->log) - 1);
}

static void store_file(const form_fixture *f, const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
}

static int set_up(void **state)
{
    form_fixture *f = calloc(1, sizeof *f);
    void *plain = NULL;
    if (f == NULL || case_reading_set_up(&plain) != 0) {
        return 1;
    }
    memcpy(&f->reading, plain, sizeof f->reading);
    free(plain);
    const char *parent = getenv("TMPDIR");
    snprintf(f->folder, sizeof f->folder, "%.200s/form_XXXXXX", parent != NULL ? parent : "/tmp");
    f->reading.context.log_sink = keep_log;
    f->reading.context.log_user = f;
    *state = f;
    if (mkdtemp(f->folder) == NULL) {
        return 1;
    }
    store_file(f, "cube.obj", cube);
    store_file(f, "inside_out.obj", cube_inside_out);
    store_file(f, "profile.txt", triangle);
    store_file(f, "bow.txt", "0 0\n1 1\n1 0\n0 1\n");
    return 0;
}

static int tear_down(void **state)
{
    form_fixture *f = *state;
    static const char *const files[] = {"cube.obj", "inside_out.obj", "profile.txt", "bow.txt", "case.cfg"};
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", f->folder, files[k]);
        unlink(path);
    }
    rmdir(f->folder);
    return case_reading_tear_down(state);
}

/* Reads a case whose body has a shape; "@/" in it stands for the folder. The caller frees the text. */
static char *make_case(const form_fixture *f, const char *head, const char *shape)
{
    char *text = calloc(1, 4096);
    assert_non_null(text);
    const char *mark = strstr(shape, "@/");
    const int n_before = mark == NULL ? (int)strlen(shape) : (int)(mark - shape);
    snprintf(text, 4096, "%sshape = { %.*s%s%s }; } );\n", head, n_before, shape, mark == NULL ? "" : f->folder,
             mark == NULL ? "" : mark + 1);
    return text;
}

static const mor_shape *read_shape(form_fixture *f, const char *head, const char *shape)
{
    char *text = make_case(f, head, shape);
    case_reading_read(&f->reading, text, NULL, &f->reading.first);
    free(text);
    return f->reading.first.bodies[0].shape;
}

static void refuse_shape(form_fixture *f, const char *head, const char *shape, const char *fragment)
{
    char *text = make_case(f, head, shape);
    case_reading_refuse(&f->reading, text, NULL, "t.cfg:4: found ", fragment);
    free(text);
}

static void mesh_has_the_size_asked_for_and_its_center_at_the_origin(void **state)
{
    form_fixture *f = *state;
    static const struct {
        const char *shape;
        double volume;
    } sizes[] = {
        {"type = \"mesh\"; file = \"@/cube.obj\";", 8.0},
        {"type = \"mesh\"; file = \"@/cube.obj\"; scale = 0.5;", 1.0},
        {"type = \"mesh\"; file = \"@/cube.obj\"; length = \"300 cm\";", 27.0},
        {"type = \"mesh\"; file = \"@/cube.obj\"; volume = 2;", 2.0},
        {"type = \"mesh\"; file = \"@/cube.obj\"; diameter = 3;", 4.5 * MOR_PI},
    };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        const mor_shape *shape = read_shape(f, space_head, sizes[k].shape);
        const double half = 0.5 * cbrt(sizes[k].volume);
        mor_shape_moments moments;
        assert_true(mor_shape_moments_known(shape, 3, &moments));
        assert_near(moments.volume, sizes[k].volume, 1e-14 * sizes[k].volume);                          /* rounding */
        assert_near(mor_vector_length(moments.center), 0.0, 1e-14);                                     /* rounding */
        assert_near(mor_shape_distance(shape, (const double[3]){half + 0.25, 0.0, 0.0}), 0.25, 1e-14);  /* rounding */
        assert_near(mor_shape_distance(shape, (const double[3]){0.0, 0.25 - half, 0.0}), -0.25, 1e-14); /* rounding */
    }
}

static void report_on_the_mesh_is_logged(void **state)
{
    form_fixture *f = *state;
    read_shape(f, space_head, "type = \"mesh\"; file = \"@/cube.obj\";");
    assert_non_null(strstr(f->log, "cube.obj"));
    assert_non_null(strstr(f->log, "12 triangles"));
}

static void mesh_turned_inside_out_is_repaired_and_reported(void **state)
{
    form_fixture *f = *state;
    const mor_shape *shape = read_shape(f, space_head, "type = \"mesh\"; file = \"@/inside_out.obj\";");
    assert_true(mor_shape_distance(shape, (const double[3]){0.0, 0.0, 0.0}) < 0.0);
    assert_non_null(strstr(f->log, "reversed"));
}

static void outline_has_the_size_asked_for_and_its_center_at_the_origin(void **state)
{
    form_fixture *f = *state;
    mor_shape_moments moments;
    const mor_shape *shape = read_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\";");
    assert_true(mor_shape_moments_known(shape, 2, &moments));
    assert_near(moments.volume, 4.5, 1e-14);                                                     /* rounding */
    assert_near(mor_shape_distance(shape, (const double[3]){0.0, 0.0, 0.0}), -sqrt(0.5), 1e-14); /* the long side */
    shape = read_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\"; diameter = 4;");
    assert_true(mor_shape_moments_known(shape, 2, &moments));
    assert_near(moments.volume, 4.0 * MOR_PI, 1e-13); /* rounding */
    shape = read_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\"; scale = 2;");
    assert_true(mor_shape_moments_known(shape, 2, &moments));
    assert_near(moments.volume, 18.0, 1e-13); /* rounding */
}

static void rock_has_its_diameter_and_follows_its_seed(void **state)
{
    form_fixture *f = *state;
    mor_shape_moments moments;
    const mor_shape *shape = read_shape(f, space_head, "type = \"rock\"; diameter = 3; flatness = 0.6;");
    assert_true(mor_shape_moments_known(shape, 3, &moments));
    assert_near(moments.volume, 4.5 * MOR_PI, 1e-10);           /* by rescaling: rounding */
    assert_near(mor_vector_length(moments.center), 0.0, 1e-10); /* by moving: rounding */
    const double place[3] = {1.0, 0.7, 0.0};
    double distances[3];
    static const char *const seeds[3] = {"seed = 7;", "seed = 7;", "seed = 8;"};
    for (int k = 0; k < 3; ++k) {
        char text[256];
        snprintf(text, sizeof text, "type = \"rock\"; diameter = 4; elongation = 0.6; angularity = 0.9; %s", seeds[k]);
        shape = read_shape(f, plane_head, text);
        assert_true(mor_shape_moments_known(shape, 2, &moments));
        assert_near(moments.volume, 4.0 * MOR_PI, 1e-12); /* rounding */
        distances[k] = mor_shape_distance(shape, place);
    }
    assert_true(distances[0] == distances[1]); /* exact: the same rock */
    assert_true(distances[0] != distances[2]);
}

static void scale_of_the_case_changes_no_bit(void **state)
{
    form_fixture *f = *state;
    static const char *const scales[] = {"scale.length=4.0", "scale.mass=0.0625", NULL};
    static const char *const shapes[] = {"type = \"mesh\"; file = \"@/cube.obj\"; diameter = 3;",
                                         "type = \"mesh\"; file = \"@/cube.obj\"; volume = 2.5;",
                                         "type = \"rock\"; diameter = 3;",
                                         "type = \"outline\"; file = \"@/profile.txt\"; diameter = 3;",
                                         "type = \"outline\"; file = \"@/profile.txt\"; scale = 1.1;",
                                         "type = \"rock\"; diameter = 3;"};
    for (int k = 0; k < 6; ++k) {
        char *text = make_case(f, k < 3 ? space_head : plane_head, shapes[k]);
        case_reading_read(&f->reading, text, NULL, &f->reading.first);
        case_reading_read(&f->reading, text, scales, &f->reading.second);
        free(text);
        const mor_shape *plain = f->reading.first.bodies[0].shape;
        const mor_shape *scaled = f->reading.second.bodies[0].shape;
        for (int i = 0; i < 1000; ++i) {
            const double point[3] = {0.4 * (i % 10) - 2.0, 0.4 * (i / 10 % 10) - 2.0,
                                     k < 3 ? 0.04 * (i / 10) - 2.0 : 0.0};
            const double there[3] = {4.0 * point[0], 4.0 * point[1], 4.0 * point[2]};
            assert_true(4.0 * mor_shape_distance(plain, point) == mor_shape_distance(scaled, there)); /* exact */
        }
    }
}

static void case_written_and_read_again_is_the_same(void **state)
{
    form_fixture *f = *state;
    static const char *const scales[] = {"scale.length=4.0", NULL};
    static const char *const shapes[] = {
        "type = \"mesh\"; file = \"@/cube.obj\"; length = 3;", "type = \"mesh\"; file = \"@/cube.obj\"; scale = 0.7;",
        "type = \"rock\"; diameter = 3; roughness = 0.5; seed = 5;", "type = \"outline\"; file = \"@/profile.txt\";",
        "type = \"rock\"; diameter = 3;"};
    for (int k = 0; k < 5; ++k) {
        char *text = make_case(f, k < 3 ? space_head : plane_head, shapes[k]);
        case_reading_round_trip(&f->reading, text, scales);
        free(text);
    }
}

/* What resuming compares tells another content of the file. */
static void written_case_names_the_content_of_the_file(void **state)
{
    form_fixture *f = *state;
    char *texts[2];
    for (int k = 0; k < 2; ++k) {
        read_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\";");
        texts[k] = case_reading_write(&f->reading, &f->reading.first);
        assert_non_null(strstr(texts[k], "content of the file: xxh64"));
        store_file(f, "profile.txt", "0 0\n3 0\n0 3.5\n");
    }
    assert_string_not_equal(texts[0], texts[1]);
    free(texts[0]);
    free(texts[1]);
}

static void path_is_taken_from_the_folder_of_the_case(void **state)
{
    form_fixture *f = *state;
    char path[512];
    char *text = make_case(f, space_head,
                           "type = \"union\"; parts = ( { type = \"mesh\"; file = \"cube.obj\"; }, "
                           "{ type = \"mesh\"; file = \"./cube.obj\"; scale = 0.5; } );");
    store_file(f, "case.cfg", text);
    free(text);
    snprintf(path, sizeof path, "%s/case.cfg", f->folder);
    const mor_status status =
        mor_case_read(&f->reading.context, path, NULL, 0, f->reading.registry, mor_probe_type_at, &f->reading.first);
    if (status != MOR_OK) {
        fail_msg("%s", f->reading.context.message);
    }
    mor_case_input inputs[4];
    assert_int_equal(mor_case_inputs(&f->reading.first, inputs, 4), 1); /* each file once */
    assert_true(inputs[0].path[0] == '/' && inputs[0].hash != 0);
    assert_non_null(strstr(inputs[0].path, "/cube.obj"));
}

static void what_is_no_rock_is_refused_with_the_reason(void **state)
{
    form_fixture *f = *state;
    refuse_shape(f, space_head, "type = \"mesh\"; file = \"@/none.obj\";", "a mesh that cannot be read");
    refuse_shape(f, space_head, "type = \"mesh\"; file = \"@/profile.txt\";", "found the extension 'txt'");
    refuse_shape(f, space_head, "type = \"mesh\"; file = \"@/cube.obj\"; length = 1; volume = 1;", "found 2 sizes");
    refuse_shape(f, space_head, "type = \"outline\"; file = \"@/profile.txt\";", "an outline in a case of dimension 3");
    refuse_shape(f, plane_head, "type = \"mesh\"; file = \"@/cube.obj\";", "a mesh in a case of dimension 2");
    refuse_shape(f, plane_head, "type = \"outline\"; file = \"@/bow.txt\";",
                 "the edge from line 1 to line 2 and the edge from line 3 to line 4");
    refuse_shape(f, plane_head, "type = \"outline\"; file = \"@/cube.obj\";", "line 1, column 1: \"v\" is no number");
    refuse_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\"; scale = 1; diameter = 1;", "2 sizes");
    refuse_shape(f, plane_head, "type = \"rock\"; diameter = 1; angularity = 2;", "angularity = 2, out of range");
    refuse_shape(f, plane_head, "type = \"rock\"; diameter = 1; angularty = 0.2;", "did you mean 'angularity'?");
    refuse_shape(f, plane_head, "type = \"outline\"; file = \"@/profile.txt\"; length = 1;", "unknown name 'length'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(mesh_has_the_size_asked_for_and_its_center_at_the_origin, set_up, tear_down),
        cmocka_unit_test_setup_teardown(report_on_the_mesh_is_logged, set_up, tear_down),
        cmocka_unit_test_setup_teardown(mesh_turned_inside_out_is_repaired_and_reported, set_up, tear_down),
        cmocka_unit_test_setup_teardown(outline_has_the_size_asked_for_and_its_center_at_the_origin, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rock_has_its_diameter_and_follows_its_seed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(scale_of_the_case_changes_no_bit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(case_written_and_read_again_is_the_same, set_up, tear_down),
        cmocka_unit_test_setup_teardown(written_case_names_the_content_of_the_file, set_up, tear_down),
        cmocka_unit_test_setup_teardown(path_is_taken_from_the_folder_of_the_case, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_no_rock_is_refused_with_the_reason, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
