/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

/* Probes of parts of space, along paths and of what passes planes, against sums over all particles. */

static const char text[] =
    "title = 'parts'; dimension = 3; spacing = '0.1 m'; end = '1 s'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-2 m', '-2 m', '-0.5 m'); max = ('4 m', '2 m', '3 m'); };"
    "soil = ( { name = 'low'; velocity = ('2 m/s', '1 m/s', 0);"
    "  shape = { type = 'box'; min = ('-0.5 m', '-0.4 m', '0 m'); max = ('0.5 m', '0.4 m', '0.5 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; },"
    "  { name = 'high'; velocity = ('2 m/s', '1 m/s', 0);"
    "  shape = { type = 'box'; min = ('-0.5 m', '-0.4 m', '0.5 m'); max = ('0.5 m', '0.4 m', '0.8 m'); };"
    "  material = { model = 'drucker_prager'; density = '1500 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; } );"
    "bodies = ( { name = 'ball'; position = ('1 m', '0 m', '2 m'); velocity = ('1 m/s', 0, 0); angular_velocity = (0, "
    "2, 0);"
    "  shape = { type = 'sphere'; center = (0, 0, 0); radius = '0.2 m'; };"
    "  material = { model = 'rigid'; density = '2500 kg/m3'; }; } );"
    "probes = ("
    "  { name = 'mass'; type = 'mass'; region = { type = 'box'; min = ('-2 m', '0 m', '0 m'); max = ('4 m', '2 m', '3 "
    "m'); }; },"
    "  { name = 'mass_high'; type = 'mass'; soil = 'high'; region = { type = 'half_space'; point = (0, 0, 0); normal = "
    "(0, -1, 0); }; },"
    "  { name = 'velocity'; type = 'soil_velocity'; direction = (0, 1, 0); region = { type = 'half_space'; point = (0, "
    "0, 0); normal = (0, -1, 0); }; },"
    "  { name = 'stress'; type = 'soil_stress'; direction = (0, 0, 1); region = { type = 'half_space'; point = (0, 0, "
    "0); normal = (0, -1, 0); }; },"
    "  { name = 'passed'; type = 'mass_passed'; origin = ('0.53 m', 0, 0); direction = (1, 0, 0); },"
    "  { name = 'passed_left'; type = 'mass_passed'; origin = ('0.53 m', 0, 0); direction = (1, 0, 0); region = { type "
    "= 'half_space'; point = (0, 0, 0); normal = (0, -1, 0); }; },"
    "  { name = 'passed_right'; type = 'mass_passed'; origin = ('0.53 m', 0, 0); direction = (1, 0, 0); region = { "
    "type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; },"
    "  { name = 'flow'; type = 'mass_flow'; origin = (0, 0, 0); direction = (1, 0, 0); },"
    "  { name = 'front'; type = 'run_out'; percentile = 100; path = ((-1, 0, 0), (0.2, 0, 0), (0.2, 3, 0)); },"
    "  { name = 'front_x'; type = 'run_out'; percentile = 100; path = ((-1, 0, 5), (3, 0, 1)); },"
    "  { name = 'along_x'; type = 'run_out'; percentile = 100; origin = (-1, 0, 0); direction = (1, 0, 0); },"
    "  { name = 'speed_x'; type = 'front_speed'; path = ((-1, 0, 5), (3, 0, 1)); },"
    "  { name = 'beyond'; type = 'volume_beyond'; origin = ('0.2 m', 0, 0); direction = (1, 0, 0); },"
    "  { name = 'volume'; type = 'volume'; region = { type = 'half_space'; point = (0.2, 0, 0); normal = (-1, 0, 0); "
    "}; },"
    "  { name = 'displacement'; type = 'displacement'; percentile = 100; },"
    "  { name = 'point'; type = 'body_point_velocity'; body = 'ball'; origin = ('1 m', '0 m', '2.2 m'); direction = "
    "(1, 0, 0); },"
    "  { name = 'moved'; type = 'body_point_position'; body = 'ball'; origin = ('1 m', '0 m', '2.2 m'); direction = "
    "(1, 0, 0); },"
    "  { name = 'passages'; type = 'passages'; origin = ('1.02 m', 0, 0); direction = (1, 0, 0); },"
    "  { name = 'energy'; type = 'passage_energy'; origin = ('1.02 m', 0, 0); direction = (1, 0, 0); },"
    "  { name = 'travel'; type = 'boulder_travel'; },"
    "  { name = 'spread'; type = 'spread'; direction = (0, 0, 1); soil = 'low'; },"
    "  { name = 'reach'; type = 'angle_of_reach'; direction = (1, 0, 0); percentile = 100; },"
    "  { name = 'centers'; type = 'angle_of_centers'; direction = (1, 0, 0); },"
    "  { name = 'deposit'; type = 'deposit_volume'; speed = '1e9 m/s'; } );"
    "numerics = { sort_interval = 3; };";

static scene *build(const char *const *settings)
{
    const char *const *const lists[] = {settings};
    const scene_request request = {.text = text, .settings = lists, .n_lists = settings != NULL ? 1 : 0};
    scene *it = scene_new(&request);
    scene_advance(it, 0.04);
    return it;
}

/* Whether a particle lies at y > 0, the region of most probes. */
static bool is_left(const double *place)
{
    return place[1] >= 0.0;
}

static void parts_of_space_hold_their_particles(void **state)
{
    (void)state;
    scene *it = build(NULL);
    const mor_soil *soil = &it->simulation.soil;
    double *const *data = soil->set.data;
    double mass = 0.0, high = 0.0, momentum = 0.0, stress = 0.0, volume = 0.0, beyond = 0.0, all = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *x = data[MOR_FIELD_POSITION] + 3 * i;
        const double m = data[MOR_FIELD_MASS][i];
        const double part = m / data[MOR_FIELD_DENSITY][i];
        all += part;
        beyond += x[0] > 0.2 ? part : 0.0;
        if (is_left(x)) {
            mass += m;
            high += data[soil->region_field][i] == 1.0 ? m : 0.0;
            momentum += m * data[MOR_FIELD_VELOCITY][3 * i + 1];
            stress += part * data[MOR_FIELD_STRESS][6 * i + 2];
            volume += part;
        }
    }
    assert_true(high > 0.1 * mass && high < 0.9 * mass);
    scene_expect_near("the mass", scene_probe(it, "mass"), mass, 1e-12 * mass); /* order of sums, here and below */
    scene_expect_near("the mass of one soil", scene_probe(it, "mass_high"), high, 1e-12 * mass);
    scene_expect_near("the velocity", scene_probe(it, "velocity"), momentum / mass, 1e-12);
    scene_expect_near("the stress", scene_probe(it, "stress"), stress / volume, 1e-9 * fabs(stress / volume));
    scene_expect_near("the volume beyond", scene_probe(it, "beyond"), beyond, 1e-12 * beyond);
    scene_expect_near("the volume in a region", scene_probe(it, "volume"), beyond, 1e-12 * beyond);
    scene_expect_near("the deposit", scene_probe(it, "deposit"), all, 1e-12 * all);
    scene_free(it);
}

static void what_has_passed_is_what_lies_beyond(void **state)
{
    (void)state;
    scene *it = build(NULL);
    double *const *data = it->simulation.soil.set.data;
    double mass = 0.0;
    for (int64_t i = 0; i < it->simulation.soil.set.n_particles; ++i) {
        mass += data[MOR_FIELD_POSITION][3 * i] > 0.53 ? data[MOR_FIELD_MASS][i] : 0.0; /* none did at the start */
    }
    const double passed = scene_probe(it, "passed");
    assert_true(mass > 0.0);
    scene_expect_near("the mass that passed", passed, mass, 1e-9 * mass);
    const double parts = scene_probe(it, "passed_left") + scene_probe(it, "passed_right");
    assert_true(scene_probe(it, "passed_left") > 0.0 && scene_probe(it, "passed_right") > 0.0);
    scene_expect_near("the mass that passed in two parts", parts, mass, 1e-9 * mass);
    /* A block of 0.8 m by 0.5 m and 0.3 m at about 2 m/s: the slab cuts across 16 or 24 layers of particles. */
    const double flow = 0.8 * (0.5 * 2000.0 + 0.3 * 1500.0) * 2.0;
    scene_expect_near("the flow", scene_probe(it, "flow"), flow, 0.15 * flow);
    scene_free(it);
}

static void paths_measure_along_themselves(void **state)
{
    (void)state;
    scene *it = build(NULL);
    const double *x = it->simulation.soil.set.data[MOR_FIELD_POSITION];
    double farthest = -INFINITY;
    for (int64_t i = 0; i < it->simulation.soil.set.n_particles; ++i) {
        /* Two legs with a right angle at (0.2, 0): the nearer one counts. */
        const double on_first = fmin(x[3 * i], 0.2);
        const double to_first = hypot(x[3 * i] - on_first, x[3 * i + 1]);
        const double on_second = fmax(x[3 * i + 1], 0.0);
        const double to_second = hypot(x[3 * i] - 0.2, x[3 * i + 1] - on_second);
        farthest = fmax(farthest, to_first <= to_second ? on_first + 1.0 : 1.2 + on_second);
    }
    scene_expect_near("the front along a bend", scene_probe(it, "front"), farthest + 0.05, 1e-12);
    scene_expect_near("the front along x", scene_probe(it, "front_x"), scene_probe(it, "along_x"), 1e-12);
    scene_expect_near("its speed", scene_probe(it, "speed_x"), 2.0, 0.2); /* it has hardly been braked */
    scene_free(it);
}

static void bodies_are_followed(void **state)
{
    (void)state;
    scene *it = build(NULL);
    /* Free fall from 2 m for 0.04 s, 1 m/s along x, 2 rad/s about y: the top moves by 0.2 m * 2 rad/s more. */
    const double fall = 9.81 * 0.04;
    const double energy = 0.5 * it->simulation.bodies.of[0].group->bodies[0].mass;
    scene_expect_near("the velocity of the top", scene_probe(it, "point"), 1.0 + 0.4 * cos(0.08), 1e-3);
    scene_expect_near("the way of the top", scene_probe(it, "moved"), 0.04 + 0.2 * sin(0.08), 1e-4);
    assert_true(scene_probe(it, "passages") == 1.0);
    const double rotation = 0.4 * 0.04 * 4.0; /* over mass / 2: 2/5 r2 w2; of the particles within a few percent */
    scene_expect_near("the energy at the line", scene_probe(it, "energy"),
                      energy * (1.0 + pow(9.81 * 0.02, 2) + rotation), 0.02 * energy);
    const double travel = 0.5 * (0.04 * hypot(1.0, fall) + asinh(fall) / 9.81); /* length of a parabola */
    scene_expect_near("the path", scene_probe(it, "travel"), travel, 1e-4);
    scene_free(it);
}

static void displacements_and_angles_count_from_the_start(void **state)
{
    (void)state;
    scene *it = build(NULL);
    const mor_set *set = &it->simulation.soil.set;
    const double *track = it->simulation.probes->memory[14];
    double largest = 0.0, front = -INFINITY, foot = INFINITY, mass = 0.0, center[2] = {0.0, 0.0};
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        const double *then = track + 3 * set->id[i];
        const double m = set->data[MOR_FIELD_MASS][i];
        largest = fmax(largest, sqrt(pow(x[0] - then[0], 2) + pow(x[1] - then[1], 2) + pow(x[2] - then[2], 2)));
        front = fmax(front, x[0] + 0.05);
        mass += m;
        center[0] += m * (x[0] - then[0]);
        center[1] += m * (x[2] - then[2]);
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        foot = x[0] >= front - 0.15 ? fmin(foot, x[2] - 0.05) : foot;
    }
    assert_true(largest > 0.05 && largest < 0.12); /* some 2.2 m/s for 0.04 s */
    scene_expect_near("the displacement", scene_probe(it, "displacement"), largest, 1e-12);
    const double reach = tan(scene_probe(it, "reach"));
    /* The highest particle at the start is one of the upper layer, the first in memory: between -0.5 and 0.5 m. */
    assert_true(reach > (0.8 - foot) / (front + 0.45) - 1e-9 && reach < (0.8 - foot) / (front - 0.45) + 1e-9);
    scene_expect_near("the angle of the centers", tan(scene_probe(it, "centers")), -center[1] / center[0], 1e-9);
    /* Layers of 0.5 m: 0.5 / sqrt(12), of five particles a little less. */
    scene_expect_near("the spread", scene_probe(it, "spread"), 0.1 * sqrt(2.0), 0.02);
    scene_free(it);
}

/* Else the angle would be that of a line from the origin of the case. */
static void reach_counts_from_nothing_where_a_region_was_empty(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){
        .text = "title = 'reach'; dimension = 3; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, -9.81);"
                "domain = { min = (-1, -1, -1); max = (3, 1, 2); };"
                "soil = ( { name = 'sand'; velocity = (2, 0, 0);"
                "  shape = { type = 'box'; min = (0, 0, 0); max = (0.3, 0.3, 0.3); };"
                "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '2 MPa';"
                "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );"
                "probes = ( { name = 'all'; type = 'angle_of_reach'; direction = (1, 0, 0); },"
                "  { name = 'reach'; type = 'angle_of_reach'; direction = (1, 0, 0);"
                "    region = { type = 'half_space'; point = (0.4, 0, 0); normal = (-1, 0, 0); }; },"
                "  { name = 'centers'; type = 'angle_of_centers'; direction = (1, 0, 0);"
                "    region = { type = 'half_space'; point = (0.4, 0, 0); normal = (-1, 0, 0); }; } );"});
    scene_advance(it, 0.2);
    assert_true(isfinite(scene_probe(it, "all")));
    assert_true(isnan(scene_probe(it, "reach")) && isnan(scene_probe(it, "centers")));
    scene_free(it);
}

static void placed_scenes_have_the_same_results(void **state)
{
    static const char *const placed[] = {"placement.axis=(0, 0, 1)", "placement.angle=40 deg",
                                         "placement.translation=(\"3 m\", \"-2 m\", \"1 m\")", NULL};
    (void)state;
    scene *one = build(NULL);
    scene *other = build(placed);
    for (int k = 0; k < one->the_case.n_probes; ++k) {
        const char *name = one->the_case.probes[k].name;
        const double value = scene_probe(one, name);
        /* Lattices lie otherwise in the run's frame, so that rounding is another; single particles at edges. */
        scene_expect_near(name, scene_probe(other, name), value, 0.02 * fabs(value) + 0.02);
    }
    scene_free(one);
    scene_free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_of_space_hold_their_particles),
        cmocka_unit_test(what_has_passed_is_what_lies_beyond),
        cmocka_unit_test(paths_measure_along_themselves),
        cmocka_unit_test(bodies_are_followed),
        cmocka_unit_test(displacements_and_angles_count_from_the_start),
        cmocka_unit_test(reach_counts_from_nothing_where_a_region_was_empty),
        cmocka_unit_test(placed_scenes_have_the_same_results),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
