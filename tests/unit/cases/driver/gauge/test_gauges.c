/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

/* Gauges on walls and bodies, against the sums that soil and contact keep themselves. */

/* Soil falls against a wall in halves, and a ball into it. */
static const char text[] =
    "title = 'gauges'; dimension = 3; spacing = '0.05 m'; end = '1 s'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-1 m', '-0.3 m'); max = ('1 m', '1 m', '1 m'); };"
    "soil = ( { name = 'sand'; velocity = ('2 m/s', 0, 0);"
    "  shape = { type = 'box'; min = ('-0.4 m', '-0.2 m', '0 m'); max = ('0 m', '0.2 m', '0.4 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; },"
    "  { name = 'stop'; friction = 'coulomb'; friction_coefficient = 0.4;"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (-1, 0, 0); }; } );"
    "bodies = ( { name = 'ball'; position = ('-0.11 m', '0 m', '0.51 m'); velocity = ('1.5 m/s', 0, '-1 m/s');"
    "  shape = { type = 'sphere'; center = (0, 0, 0); radius = '0.1 m'; }; contact_modulus = '10 MPa';"
    "  material = { model = 'rigid'; density = '2500 kg/m3'; }; } );"
    "gauges = ("
    "  { name = 'all'; wall = 'stop'; direction = (1, 0, 0); origin = ('0 m', '0 m', '0.1 m'); cell = '0.1 m';"
    "    region = { type = 'box'; min = ('-1 m', '-0.5 m', '-0.3 m'); max = ('1 m', '0.5 m', '0.9 m'); }; },"
    "  { name = 'left'; wall = 'stop'; direction = (1, 0, 0); origin = ('0 m', '0 m', '0.1 m');"
    "    region = { type = 'half_space'; point = (0, '0.013 m', 0); normal = (0, 1, 0); }; },"
    "  { name = 'right'; wall = 'stop'; direction = (1, 0, 0); origin = ('0 m', '0 m', '0.1 m');"
    "    region = { type = 'half_space'; point = (0, '0.013 m', 0); normal = (0, -1, 0); }; },"
    "  { name = 'ball'; body = 'ball'; direction = (0, 0, 1); } );"
    "probes = ( { name = 'wall'; type = 'wall_force'; wall = 'stop'; direction = (1, 0, 0); },"
    "  { name = 'on_ball'; type = 'body_force_soil'; body = 'ball'; direction = (0, 0, 1); },"
    "  { name = 'all'; type = 'gauge_normal'; gauge = 'all'; } );";

static const char *const placed[] = {"placement.axis=(1, 2, 3)", "placement.angle=40 deg",
                                     "placement.translation=(\"3 m\", \"-2 m\", \"1 m\")", NULL};

static scene *build(const char *const *settings, int n_threads)
{
    const char *const *const lists[] = {settings};
    const scene_request request = {
        .text = text, .settings = lists, .n_lists = settings != NULL ? 1 : 0, .n_threads = n_threads};
    scene *it = scene_new(&request);
    scene_advance(it, 0.03); /* soil presses, the ball touches */
    return it;
}

static void read(const scene *it, int gauge, mor_gauge_reading *reading)
{
    const mor_gauge *g = &it->simulation.probes->gauges.of[gauge];
    mor_gauge_read(g, g->numbers + MOR_GAUGE_NOW, reading);
}

static void check_forces(scene *it)
{
    mor_gauge_reading all;
    mor_gauge_reading ball;
    read(it, 0, &all);
    read(it, 3, &ball);
    const double wall = scene_probe(it, "wall");
    assert_true(wall > 10.0 && scene_probe(it, "on_ball") > 10.0); /* there is something to compare */
    scene_expect_near("the soil's force", all.of_source[MOR_GAUGE_SOIL], wall, 1e-11 * wall); /* order of sums */
    scene_expect_near("the probe", scene_probe(it, "all"), all.normal, 0.0);
    for (int a = 0; a < 3; ++a) {
        const double component = it->simulation.probes->gauges.of[0].numbers[MOR_GAUGE_NOW + a];
        scene_expect_near("a component", component, it->simulation.soil.wall_force[1][a], 1e-11 * wall);
    }
    const double on_ball = scene_probe(it, "on_ball");
    scene_expect_near("the force on the ball", ball.of_source[MOR_GAUGE_SOIL], on_ball, 1e-11 * fabs(on_ball));
}

static void whole_structures_carry_what_soil_and_bodies_give(void **state)
{
    (void)state;
    scene *it = build(NULL, 1);
    check_forces(it);
    scene_free(it);
    it = build(placed, 1);
    check_forces(it);
    scene_free(it);
}

static void parts_add_up_to_the_whole(void **state)
{
    (void)state;
    scene *it = build(NULL, 1);
    const mor_gauge *g = it->simulation.probes->gauges.of;
    for (int k = 0; k < MOR_GAUGE_SIGNALS; ++k) {
        const double whole = g[0].numbers[MOR_GAUGE_SUM + k];
        const double size = fmax(fabs(g[1].numbers[MOR_GAUGE_SUM + k]), fabs(g[2].numbers[MOR_GAUGE_SUM + k]));
        const double parts = g[1].numbers[MOR_GAUGE_SUM + k] + g[2].numbers[MOR_GAUGE_SUM + k];
        scene_expect_near("the sum of the parts", parts, whole, 1e-11 * size); /* order of sums */
    }
    /* Neither is all of it. */
    assert_true(fmin(g[1].numbers[MOR_GAUGE_SUM], g[2].numbers[MOR_GAUGE_SUM]) > 0.2 * g[0].numbers[MOR_GAUGE_SUM]);
    scene_free(it);
}

/* Also where particles lie exactly on the face between the parts, as on any face along the lattice: here the soil is 8
 * particles wide, and moves along the faces. */
static void parts_that_share_a_face_of_the_lattice_add_up(void **state)
{
    (void)state;
    static const char *const sides[] = {
        "gauges[1].region={type=\"half_space\"; point=(0, 0.03125, 0); normal=(0, 1, 0);}",
        "gauges[2].region={type=\"half_space\"; point=(0, 0.03125, 0); normal=(0, -1, 0);}",
        "spacing=0.0625",
        "soil[0].shape={type=\"box\"; min=(-0.5, -0.25, 0); max=(0, 0.25, 0.5);}",
        "bodies[0].position=(-0.3, 0, 0.7)",
        "bodies[0].shape.radius=0.15",
        NULL};
    const char *const *const lists[] = {sides};
    scene *it = scene_new(&(scene_request){.text = text, .settings = lists, .n_lists = 1});
    scene_advance(it, 0.02);
    double *x = it->simulation.soil.set.data[MOR_FIELD_POSITION];
    int64_t n_on_face = 0;
    for (int64_t i = 0; i < it->simulation.soil.set.n_particles; ++i) { /* it moved by some of its 17th digits */
        x[3 * i + 1] = 0.0625 * floor(x[3 * i + 1] / 0.0625) + 0.03125;
        it->simulation.soil.set.data[MOR_FIELD_VELOCITY][3 * i + 1] = 0.0;
        n_on_face += x[3 * i + 1] == 0.03125;
    }
    mor_soil_forget_lists(&it->simulation.soil);
    scene_step(it, 1);
    const mor_gauge *g = it->simulation.probes->gauges.of;
    const double whole = g[0].numbers[MOR_GAUGE_NOW];
    assert_true(whole != 0.0 && n_on_face > 0);
    scene_expect_near("the sum of the parts", g[1].numbers[MOR_GAUGE_NOW] + g[2].numbers[MOR_GAUGE_NOW], whole,
                      1e-11 * fabs(whole)); /* order of sums */
    scene_free(it);
}

/* Moments of forces by hand: about the origin of the gauge, and the normal force times its height. */
typedef struct by_hand {
    double wall; /* x of its face, m */
    double moment[3], raised;
} by_hand;

/* Each force acts where its line along x meets the wall. */
static void add_by_hand(void *job, const mor_soil_contact_load *load)
{
    by_hand *it = job;
    const double arm[3] = {it->wall, load->place[1], load->place[2] - 0.1};
    mor_vector_cross_add(1.0, arm, load->force, it->moment);
    it->raised += load->force[0] * arm[2];
}

/* The wall is where its velocity has taken it, 1 m/s or none. */
static void check_moments(const char *const *settings, double speed)
{
    scene *it = build(settings, 1);
    const mor_soil *soil = &it->simulation.soil;
    const mor_gauge *g = &it->simulation.probes->gauges.of[0];
    mor_schedule *schedule = &it->simulation.schedule;
    by_hand sums = {.wall = speed * mor_schedule_time(schedule)};
    scene_require(it, mor_schedule_step(&it->context, schedule, schedule->end));
    mor_soil_contact_visit(&soil->walls[1], soil->records, soil->set.n_particles, 0, soil->set.n_particles / 8 + 1,
                           add_by_hand, &sums);
    for (int a = 0; a < 3; ++a) {
        /* Particles have moved by half a step at 2 m/s since the forces acted: 0.2 mm of some 0.1 m. */
        scene_expect_near("a moment", g->numbers[MOR_GAUGE_NOW + MOR_GAUGE_MOMENT + a], sums.moment[a],
                          0.01 * fabs(sums.moment[1]));
    }
    scene_expect_near("raised", g->numbers[MOR_GAUGE_NOW + MOR_GAUGE_RAISED], sums.raised, 0.01 * fabs(sums.raised));
    scene_free(it);
}

static void moments_are_taken_on_the_surface(void **state)
{
    static const char *const moving[] = {"walls[1].velocity=(\"-1 m/s\", 0, 0)", "bodies[0].velocity=(0, 0, 0)",
                                         "bodies[0].position=(\"-0.3 m\", \"0 m\", \"0.51 m\")", NULL};
    (void)state;
    check_moments(NULL, 0.0);
    check_moments(moving, -1.0);
}

/* A ball of 0.2 m in cells of 0.05 m: the margin of the box around it takes no cells of its own. */
static void maps_of_bodies_have_no_cells_beside_them(void **state)
{
    static const char *const with_map[] = {"gauges[3].cell=0.05 m", NULL};
    (void)state;
    scene *it = build(with_map, 1);
    const mor_gauge *g = &it->simulation.probes->gauges.of[3];
    double plane[2];
    assert_true(g->map.n_across == 4 && g->map.n_up == 4);
    mor_gauge_map_place(&g->map, 0, plane);
    /* Seen from below, x is to the right or the left, and the ball began at x = -0.11 m, y = 0. */
    double place[3];
    for (int a = 0; a < 3; ++a) {
        place[a] = g->origin[a] + plane[0] * g->map.across[a] + plane[1] * g->map.up[a];
    }
    scene_expect_near("a corner cell", fabs(place[0] + 0.11), 0.075, 1e-9);
    scene_expect_near("a corner cell", fabs(place[1]), 0.075, 1e-9);
    scene_free(it);
}

static void maps_hold_the_whole_force(void **state)
{
    (void)state;
    scene *it = build(NULL, 1);
    const mor_gauge *g = &it->simulation.probes->gauges.of[0];
    const int64_t cells = mor_gauge_map_cells(&g->map);
    double sum = 0.0;
    mor_gauge_reading all;
    read(it, 0, &all);
    assert_int_equal(cells, 10 * 12);
    for (int64_t k = 0; k < cells; ++k) {
        sum += g->map.filtered[k];
        double plane[2];
        mor_gauge_map_place(&g->map, k, plane);
        /* The soil is 0.4 m wide and fills the lower 0.4 m, from 0.1 m under the origin; it is smeared by a spacing. */
        assert_true(g->map.filtered[k] == 0.0 || (fabs(plane[0]) < 0.3 && plane[1] < 0.4));
    }
    scene_expect_near("the sum of the cells", sum, all.of_source[MOR_GAUGE_SOIL], 1e-11 * sum); /* order of sums */
    scene_free(it);
}

/* A gauge told the other direction has the same moment about the other axis, also at its peak: a peak is the largest to
 * either side. */
static void peak_of_the_moment_turns_its_sign_with_the_direction(void **state)
{
    static const char *const reversed[] = {"gauges[1].direction=(-1, 0, 0)", NULL};
    (void)state;
    double peaks[2][2];
    for (int k = 0; k < 2; ++k) {
        scene *it = build(k == 0 ? NULL : reversed, 1);
        const double *numbers = it->simulation.probes->gauges.of[1].numbers + MOR_GAUGE_PEAK;
        peaks[k][0] = numbers[MOR_GAUGE_PEAK_MOMENT];
        peaks[k][1] = numbers[MOR_GAUGE_PEAK_MOMENT_TIME];
        scene_free(it);
    }
    assert_true(fabs(peaks[0][0]) > 1.0);                                   /* N m; there is something to compare */
    assert_true(peaks[0][0] == -peaks[1][0] && peaks[0][1] == peaks[1][1]); /* exact: signs alone */
}

static void impulse_of_contact_is_what_the_ball_lost(void **state)
{
    (void)state;
    scene *it = build(NULL, 1);
    const mor_gauge *g = &it->simulation.probes->gauges.of[0];
    const mor_simulation_body *ball = &it->simulation.bodies.of[0];
    const mor_body *body = &ball->group->bodies[ball->index];
    const double impulse = g->numbers[MOR_GAUGE_SUM + MOR_GAUGE_LOADS];
    assert_true(impulse > 1.0);
    /* All contact of the ball is with walls; those on the floor act upwards. */
    scene_expect_near("the impulse", impulse, -body->contact_impulse[0], 1e-10 * impulse);
    scene_free(it);
}

static void numbers_do_not_depend_on_threads_and_change_no_state(void **state)
{
    const char *const without[] = {"gauges[0].region.max=(\"1 m\", \"0.1 m\", \"0.9 m\")", NULL};
    (void)state;
    scene *one = build(NULL, 1);
    scene *two = build(NULL, 2);
    scene *other = build(without, 1);
    for (int k = 0; k < one->simulation.probes->gauges.n; ++k) {
        assert_memory_equal(one->simulation.probes->gauges.of[k].numbers, two->simulation.probes->gauges.of[k].numbers,
                            sizeof one->simulation.probes->gauges.of[k].numbers);
    }
    assert_int_equal(mor_set_checksum(&one->simulation.soil.set), mor_set_checksum(&other->simulation.soil.set));
    assert_true(one->simulation.probes->gauges.of[0].numbers[0] != other->simulation.probes->gauges.of[0].numbers[0]);
    scene_free(one);
    scene_free(two);
    scene_free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_structures_carry_what_soil_and_bodies_give),
        cmocka_unit_test(parts_add_up_to_the_whole),
        cmocka_unit_test(parts_that_share_a_face_of_the_lattice_add_up),
        cmocka_unit_test(moments_are_taken_on_the_surface),
        cmocka_unit_test(maps_hold_the_whole_force),
        cmocka_unit_test(maps_of_bodies_have_no_cells_beside_them),
        cmocka_unit_test(peak_of_the_moment_turns_its_sign_with_the_direction),
        cmocka_unit_test(impulse_of_contact_is_what_the_ball_lost),
        cmocka_unit_test(numbers_do_not_depend_on_threads_and_change_no_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
