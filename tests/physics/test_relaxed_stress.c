/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure.h"
#include "tests/common/scene.h"

#include <stdatomic.h>

/* Settling by relaxation: what it ends with is equilibrium, and what has none is told (docs/theory/settling.md). */

#define CALM                                                                                                           \
    "soil_hourglass = 0.25; stress_diffusion_limiter = 'transient'; wall_normals = 'geometry';"                        \
    "lattice_normalization = true;"
#define FLOOR                                                                                                          \
    "{ name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"                  \
    "{ name = 'left'; friction = 'smooth';"                                                                            \
    "  shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"

/* A column of 0.4 m by 1 m of 2100 kg/m3 between smooth walls, which starts without stress. */
static const char column[] =
    "title = 'column'; dimension = 2; spacing = '40 mm'; end = '1 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-0.5 m', '-0.5 m'); max = ('1 m', '2 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2100 kg/m3'; youngs_modulus = '15 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '38 deg'; };"
    "  initial_stress = { type = 'settled'; settle_from = 'none'; }; } );"
    "walls = ( " FLOOR "{ name = 'right'; friction = 'smooth';"
    "  shape = { type = 'half_space'; point = ('0.4 m', '0 m'); normal = (-1, 0); }; } );"
    "numerics = { " CALM " };"
    "probes = ( { name = 'ratio'; type = 'stress_ratio'; }, { name = 'speed'; type = 'largest_speed'; },"
    "  { name = 'unbalanced'; type = 'unbalanced_force'; } );";

/* A cohesive slope of 60 degrees; its critical height is 5.84 m, Taylor (1937): N = c / (gamma H) = 0.097. */
static const char slope[] =
    "title = 'slope'; dimension = 2; spacing = '0.4 m'; end = '10 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('40 m', '20 m'); };"
    "soil = ( { name = 'clay'; shape = { type = 'polygon'; points = (%s); };"
    "  material = { model = 'drucker_prager'; density = '1800 kg/m3'; youngs_modulus = '%s';"
    "    poissons_ratio = 0.3; friction_angle = '20 deg'; cohesion = '10 kPa'; };"
    "  initial_stress = { type = 'settled'; }; } );"
    "walls = ( " FLOOR "{ name = 'right'; friction = 'smooth';"
    "  shape = { type = 'half_space'; point = ('%.6g m', '0 m'); normal = (-1, 0); }; } );"
    "numerics = { " CALM " };"
    "probes = ( { name = 'speed'; type = 'largest_speed'; }, { name = 'unbalanced'; type = 'unbalanced_force'; } );";

static const double critical_height = 5.84;

static scene *build_slope_of(double height, const char *modulus, int n_threads)
{
    char points[512];
    char text[4096];
    const double end = 4.0 * height + height / tan(60.0 * MOR_PI / 180.0);
    snprintf(points, sizeof points,
             "('0 m', '0 m'), ('%.6g m', '0 m'), ('%.6g m', '%.6g m'), ('%.6g m', '%.6g m'), ('%.6g m', '%.6g m'),"
             "('0 m', '%.6g m')",
             end, end, 2.0 * height, end - 2.0 * height, 2.0 * height, 2.0 * height, height, height);
    snprintf(text, sizeof text, slope, points, modulus, end);
    return scene_build(&(scene_request){.text = text, .n_threads = n_threads});
}

static scene *build_slope(double height, int n_threads)
{
    return build_slope_of(height, "20 MPa", n_threads);
}

static mor_measure_stress measure_column(scene *it)
{
    double *const *data = it->simulation.soil.set.data;
    const mor_measure_points points = {.n_points = it->simulation.soil.set.n_particles,
                                       .dimension = 2,
                                       .spacing = 0.04,
                                       .position = data[MOR_FIELD_POSITION],
                                       .mass = data[MOR_FIELD_MASS],
                                       .density = data[MOR_FIELD_DENSITY]};
    const mor_measure_column frame = {.up = {0.0, 1.0, 0.0},
                                      .surface_height = 1.0,
                                      .density = 2100.0,
                                      .gravity = 9.81,
                                      .lowest = -INFINITY,
                                      .highest = INFINITY};
    mor_measure_stress stress;
    scene_require(it, mor_measure_column_stress(&it->context, &points, data[MOR_FIELD_STRESS], &frame, &stress));
    return stress;
}

/* Elastic soil that is strained upright alone has a lateral stress of nu / (1 - nu) of the vertical; where it yields,
 * the cone of plane strain, alpha = tan phi / sqrt(9 + 12 tan^2 phi), leaves (1 - a) / (1 + 2 a), a = sqrt(3) alpha. */
static void settled_column_carries_its_weight(void **state)
{
    (void)state;
    static const char *const yielding[] = {"soil[0].material.friction_angle=20 deg", NULL};
    static const char *const elastic[] = {NULL};
    const double slope_of_cone = tan(20.0 * MOR_PI / 180.0);
    const double a = sqrt(3.0) * slope_of_cone / sqrt(9.0 + 12.0 * slope_of_cone * slope_of_cone);
    const struct {
        const char *const *settings;
        double ratio;
    } laws[] = {{elastic, 0.3 / 0.7}, {yielding, (1.0 - a) / (1.0 + 2.0 * a)}};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; ++k) {
        scene *it = scene_new(&(scene_request){.text = column, .settings = &laws[k].settings, .n_lists = 1});
        const mor_measure_stress stress = measure_column(it);
        /* The kernel gradient on the lattice is exact inside; the outermost spacing at floor and surface is not. */
        scene_expect_near("slope of the vertical stress", stress.slope, 2100.0 * 9.81, 0.01 * 2100.0 * 9.81);
        scene_expect_near("lateral ratio", stress.lateral_ratio, laws[k].ratio, 0.01);
        scene_free(it);
    }
}

/* After the release nothing moves, and nothing begins to. */
static void settling_leaves_no_motion_behind(void **state)
{
    (void)state;
    scene *it = build_slope(0.8 * critical_height, 1);
    scene_require(it, mor_simulation_settle(&it->context, &it->simulation, NULL));
    const int64_t n = 3 * it->simulation.soil.set.n_particles;
    double *start = malloc((size_t)n * sizeof *start);
    const int32_t *place = scene_find_places(it);
    const double *position = it->simulation.soil.set.data[MOR_FIELD_POSITION];
    for (int64_t i = 0; i < n; ++i) {
        start[i] = position[3 * (int64_t)place[i / 3] + i % 3];
    }
    scene_advance(it, 1.0); /* two and a half periods of the longest wave */
    place = scene_find_places(it);
    for (int64_t i = 0; i < n; ++i) {
        /* m: the speed below over the second; settling itself made 12 mm */
        scene_expect_near("position", position[3 * (int64_t)place[i / 3] + i % 3], start[i], 1e-4);
    }
    /* m/s: bar of 0.1 mm/s; forces of 1e-4 of the weight swing at 1e-4 g / (2 pi / 0.4 s) = 0.06 mm/s */
    assert_true(scene_probe(it, "speed") < 1e-4);
    assert_true(scene_probe(it, "unbalanced") < 1e-3);
    free(start);
    scene_free(it);
}

static void settling_tells_a_slope_that_cannot_stand(void **state)
{
    (void)state;
    scene *it = build_slope(1.2 * critical_height, 1);
    assert_int_equal(mor_simulation_settle(&it->context, &it->simulation, NULL), MOR_NOT_CONVERGED);
    assert_non_null(strstr(it->context.message, "the soil does not stand under its own weight"));
    assert_non_null(strstr(it->context.message, "the soil that moved farthest, by "));
    assert_non_null(strstr(it->context.message, "A longer 'settle_time' does not help"));
    scene_free(it);
}

/* The verdict depends on yield, not on stiffness: soft soil that slides would come to rest within a few elastic
 * settlements. */
static void verdict_does_not_hang_on_the_stiffness(void **state)
{
    (void)state;
    static const char *const moduli[] = {"5 MPa", "100 MPa"};
    static const double heights[] = {0.8, 1.2};
    for (int k = 0; k < 4; ++k) {
        scene *it = build_slope_of(heights[k / 2] * critical_height, moduli[k % 2], 1);
        const mor_status expected = k / 2 == 0 ? MOR_OK : MOR_NOT_CONVERGED;
        assert_int_equal(mor_simulation_settle(&it->context, &it->simulation, NULL), expected);
        scene_free(it);
    }
}

/* Relaxation that is cut short says so, and that it converges; not that the soil falls. */
static void settling_tells_soil_that_needs_longer(void **state)
{
    (void)state;
    scene *it = build_slope(0.8 * critical_height, 1);
    it->the_case.soils[0].settle_time = 0.4;
    assert_int_equal(mor_simulation_settle(&it->context, &it->simulation, NULL), MOR_NOT_CONVERGED);
    assert_null(strstr(it->context.message, "does not stand"));
    assert_non_null(strstr(it->context.message, "settle_time"));
    scene_free(it);
}

/* Where stress diffusion acts on standing soil, a column creeps on: nobody is told that it falls. */
static void soil_that_creeps_by_diffusion_is_told_from_soil_that_falls(void **state)
{
    (void)state;
    static const char *const creeping[] = {"numerics.stress_diffusion_limiter=none",
                                           "soil[0].initial_stress.settle_method=relaxation",
                                           "soil[0].initial_stress.settle_time=0.5 s", NULL};
    static const char *const *const lists[] = {creeping};
    scene *it = scene_build(&(scene_request){.text = column, .settings = lists, .n_lists = 1});
    assert_int_equal(mor_simulation_settle(&it->context, &it->simulation, NULL), MOR_NOT_CONVERGED);
    assert_null(strstr(it->context.message, "does not stand"));
    assert_non_null(strstr(it->context.message, "stress diffusion drains"));
    assert_non_null(strstr(it->context.message, "stress_diffusion_limiter = \"transient\""));
    scene_free(it);
}

static void expect_same_bits(scene *one, scene *other)
{
    static const mor_field_id fields[] = {MOR_FIELD_POSITION, MOR_FIELD_STRESS};
    static const int64_t widths[] = {3, 6};
    for (size_t k = 0; k < sizeof fields / sizeof *fields; ++k) {
        assert_memory_equal(one->simulation.soil.set.data[fields[k]], other->simulation.soil.set.data[fields[k]],
                            (size_t)(widths[k] * one->simulation.soil.set.n_particles) * sizeof(double));
    }
}

static void relaxation_has_the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    scene *one = build_slope(0.8 * critical_height, 1);
    scene *three = build_slope(0.8 * critical_height, 3);
    scene_require(one, mor_simulation_settle(&one->context, &one->simulation, NULL));
    scene_require(three, mor_simulation_settle(&three->context, &three->simulation, NULL));
    expect_same_bits(one, three);
    scene_free(one);
    scene_free(three);
}

/* What the observer does: requests a stop at a time. */
typedef struct stopping {
    atomic_int stop;
    double at;       /* s */
    double time;     /* the last one, s */
    double residual; /* likewise, 1 */
    double ratio;    /* its limit, 1 */
} stopping;

static void request_stop(void *user, const mor_settle_course *course)
{
    stopping *it = user;
    assert_true(course->is_relaxed);
    it->time = course->time;
    it->residual = course->force;
    it->ratio = course->ratio;
    if (course->time >= it->at) {
        atomic_store(&it->stop, 1);
    }
}

/* Also where the clock was made for times far beyond the run: the state is drawn with its time. */
static void time_of_a_failed_settling_is_that_of_its_last_step(void **state)
{
    (void)state;
    stopping last = {.at = INFINITY};
    const mor_settle_observer watching = {.stop = &last.stop, .report = request_stop, .user = &last};
    scene *it = build_slope(1.2 * critical_height, 1);
    it->the_case.soils[0].settle_time = 1e5;
    assert_int_equal(mor_simulation_settle(&it->context, &it->simulation, &watching), MOR_NOT_CONVERGED);
    assert_true(last.time > 0.0);
    assert_true(mor_schedule_time(&it->simulation.schedule) == last.time);
    scene_free(it);
}

/* A settling that was stopped in its middle starts over, as the program does, to the same bits. */
static void relaxation_that_was_stopped_starts_over_to_the_same_bits(void **state)
{
    (void)state;
    stopping early = {.at = 0.2};
    stopping never = {.at = INFINITY};
    const mor_settle_observer watching = {.stop = &early.stop, .report = request_stop, .user = &early};
    const mor_settle_observer waiting = {.stop = &never.stop, .report = request_stop, .user = &never};
    scene *stopped = build_slope(0.8 * critical_height, 1);
    scene_require(stopped, mor_simulation_settle(&stopped->context, &stopped->simulation, &watching));
    assert_true(early.residual > early.ratio); /* it had not come to rest */
    scene_free(stopped);
    scene *again = build_slope(0.8 * critical_height, 1);
    scene *once = build_slope(0.8 * critical_height, 1);
    scene_require(again, mor_simulation_settle(&again->context, &again->simulation, &waiting));
    scene_require(once, mor_simulation_settle(&once->context, &once->simulation, NULL));
    assert_true(never.residual < never.ratio);
    expect_same_bits(again, once);
    scene_free(again);
    scene_free(once);
}

/* A rock on sand: it bears on the soil with its weight, and stays. */
static const char rock[] =
    "title = 'rock'; dimension = 2; spacing = '50 mm'; end = '1 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-0.5 m', '-0.5 m'); max = ('1.5 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1 m', '0.4 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '35 deg'; }; initial_stress = { type = 'settled'; }; } );"
    "walls = ( " FLOOR "{ name = 'right'; friction = 'smooth';"
    "  shape = { type = 'half_space'; point = ('1 m', '0 m'); normal = (-1, 0); }; } );"
    "bodies = ( { name = 'rock'; position = ('0.5 m', '0.55 m');"
    "  shape = { type = 'box'; min = ('-0.2 m', '-0.15 m'); max = ('0.2 m', '0.15 m'); };"
    "  friction = 'coulomb'; friction_coefficient = 0.5; material = { model = 'rigid'; density = '2400 kg/m3'; }; } );"
    "numerics = { " CALM " };"
    "probes = ( { name = 'height'; type = 'body_position'; body = 'rock'; direction = (0, 1); },"
    "  { name = 'force'; type = 'body_force_soil'; body = 'rock'; direction = (0, 1); } );";

static void settled_rock_stays_and_bears_on_the_soil(void **state)
{
    (void)state;
    static const char *const elastic[] = {"bodies[0].material.model=neo_hookean",
                                          "bodies[0].material.youngs_modulus=300 MPa",
                                          "bodies[0].material.poissons_ratio=0.25", NULL};
    static const char *const rigid[] = {NULL};
    const char *const *const kinds[] = {rigid, elastic};
    const double weight = 2400.0 * 0.4 * 0.3 * 9.81; /* N/m */
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        scene *it = scene_new(&(scene_request){.text = rock, .settings = &kinds[k], .n_lists = 1});
        const double height = scene_probe(it, "height");
        scene_advance(it, 0.3);
        scene_expect_near("force", scene_probe(it, "force"), weight, 1e-3 * weight); /* bodies: to ten times 1e-4 */
        /* m: 0.001 spacings a second */
        scene_expect_near("height", scene_probe(it, "height"), height, 0.3 * 0.001 * 0.05);
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settled_column_carries_its_weight),
        cmocka_unit_test(settling_leaves_no_motion_behind),
        cmocka_unit_test(settling_tells_a_slope_that_cannot_stand),
        cmocka_unit_test(verdict_does_not_hang_on_the_stiffness),
        cmocka_unit_test(settling_tells_soil_that_needs_longer),
        cmocka_unit_test(soil_that_creeps_by_diffusion_is_told_from_soil_that_falls),
        cmocka_unit_test(relaxation_has_the_same_bits_for_any_number_of_threads),
        cmocka_unit_test(time_of_a_failed_settling_is_that_of_its_last_step),
        cmocka_unit_test(relaxation_that_was_stopped_starts_over_to_the_same_bits),
        cmocka_unit_test(settled_rock_stays_and_bears_on_the_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
