/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

/* Statistics of probes against closed forms of a collision and against what solvers add up themselves. */

static const double density = 2400.0;
static const double radius = 0.2;
static const double speed = 1.0;

#define SCENE                                                                                                          \
    "dimension = 2; spacing = '0.025 m'; end = '0.2 s'; gravity = (0, 0, 0);"                                          \
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); };"                                                               \
    "contact = { friction_coefficient = 0; restitution = 1; };"

#define BOX(name, place)                                                                                               \
    "{ name = '" name "'; shape = { type = 'sphere'; center = (0, 0); radius = 0.2; }; " place                         \
    "  contact_modulus = '10 MPa'; material = { model = 'rigid'; density = 2400; }; }"

#define FLOOR "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"

static const char bouncing[] = SCENE FLOOR "bodies = (" BOX(
    "box", "position = (0, 0.25); velocity = (0, -1);") ");"
                                                        "probes = ( { name = 'box'; type = 'body_force_contact'; body "
                                                        "= 'box'; direction = (0, 1); },"
                                                        "  { name = 'floor'; type = 'wall_contact_force'; wall = "
                                                        "'floor'; direction = (0, 1); },"
                                                        "  { name = 'half'; type = 'body_force_contact'; body = 'box'; "
                                                        "direction = (0, 1);"
                                                        "    window = (0, '0.0594248 s'); },"
                                                        "  { name = 'after'; type = 'wall_contact_force'; wall = "
                                                        "'floor'; direction = (0, 1);"
                                                        "    window = ('0.15 s', '0.2 s'); },"
                                                        "  { name = 'depth'; type = 'contact_depth'; },"
                                                        "  { name = 'v'; type = 'body_velocity'; body = 'box'; "
                                                        "direction = (0, 1); },"
                                                        "  { name = 'y'; type = 'body_position'; body = 'box'; "
                                                        "direction = (0, 1); } );";

static scene *make(const char *text)
{
    const scene_request request = {text, NULL, 0, 1};
    return scene_new(&request);
}

static mor_probe_statistics find(const scene *it, const char *name)
{
    mor_probe_statistics found = {.maximum = NAN};
    for (int k = 0; k < it->the_case.n_probes; ++k) {
        if (strcmp(it->the_case.probes[k].name, name) == 0) {
            mor_probe_statistics_find(&it->simulation, k, &found);
            return found;
        }
    }
    fail_msg("the scene has no probe '%s'", name);
    return found;
}

static double find_mass(void)
{
    return density * MOR_PI * radius * radius;
}

/* Stiffness of a disc on a floor, docs/theory/contact.md: pi/4 of the modulus over 1 - nu^2. */
static double find_stiffness(void)
{
    return 0.25 * MOR_PI * 1.0e7 / (1.0 - 0.25 * 0.25);
}

/* Half a swing on a linear spring: from t = 0.05 s on for pi sqrt(m / k), the peak v sqrt(k m) in its middle. */
static void peak_of_a_bounce_is_that_of_a_linear_spring(void **state)
{
    (void)state;
    const double mass = find_mass();
    const double peak = speed * sqrt(find_stiffness() * mass);
    const double middle = 0.05 / speed + 0.5 * MOR_PI * sqrt(mass / find_stiffness());
    const double change = 2.0 * mass * speed;
    scene *it = make(bouncing);
    scene_advance(it, 0.2);
    const mor_probe_statistics box = find(it, "box");
    const mor_probe_statistics wall = find(it, "floor");
    scene_expect_near("peak", box.maximum, peak, 0.02 * peak); /* steps of a thirtieth of the swing, sums over nodes */
    /* Half a step, which is a twentieth of the way to the peak, and 2 % as for the peak. */
    scene_expect_near("time of the peak", box.time_of_maximum, middle, 0.045 * (middle - 0.05));
    scene_expect_near("minimum", box.minimum, 0.0, 1e-12 * peak);
    scene_expect_near("wall", wall.minimum, -box.maximum, 1e-12 * peak);
    assert_true(wall.time_of_minimum == box.time_of_maximum);
    scene_expect_near("depth", find(it, "depth").maximum, peak / find_stiffness(), 0.02 * peak / find_stiffness());
    assert_true(scene_probe(it, "box") == 0.0);                     /* all over at the end */
    scene_expect_near("speed", find(it, "v").maximum, speed, 1e-3); /* restitution 1: error of the step */
    scene_expect_near("lowest", find(it, "y").minimum, radius - peak / find_stiffness(), 1e-3 * radius);
    /* Exact but for rounding: an impulse is the change of a momentum. */
    const double given = it->simulation.bodies.groups[0]->bodies[0].mass * (scene_probe(it, "v") + speed);
    scene_expect_near("impulse", box.impulse, given, 1e-12 * change);
    scene_expect_near("impulse of the wall", wall.impulse, -given, 1e-12 * change);
    scene_expect_near("mean", box.mean, given / 0.2, 1e-12 * change / 0.2);
    scene_expect_near("solver", box.impulse, it->simulation.bodies.groups[0]->bodies[0].contact_impulse[1],
                      1e-12 * change);
    scene_free(it);
}

static void window_cuts_statistics(void **state)
{
    (void)state;
    const double change = 2.0 * find_mass() * speed;
    scene *it = make(bouncing);
    scene_advance(it, 0.2);
    const mor_probe_statistics half = find(it, "half");
    const mor_probe_statistics after = find(it, "after");
    scene_expect_near("half", half.impulse, 0.5 * change, 0.04 * change); /* up to the middle, within half a step */
    assert_true(after.impulse == 0.0 && after.maximum == 0.0 && after.minimum == 0.0 && after.mean == 0.0);
    assert_true(after.n_measured > 1.0 && after.n_measured < find(it, "floor").n_measured);
    scene_free(it);
}

/* Soil takes long steps, the boxes short ones within them: their hit is over before the soil has taken two. */
static const char sub_steps[] =
    "dimension = 2; spacing = '0.05 m'; end = '0.2 s'; gravity = (0, 0, 0);"
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); };"
    "contact = { friction_coefficient = 0; restitution = 1; };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (-4, 2); max = (-3, 3); };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '10 kPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );" FLOOR
    "bodies = ( { name = 'box'; shape = { type = 'sphere'; center = (0, 0); radius = 0.2; };"
    "  position = (0, 0.255); velocity = (0, -1); contact_modulus = '300 MPa';"
    "  material = { model = 'rigid'; density = 2400; }; } );"
    "probes = ( { name = 'box'; type = 'body_force_contact'; body = 'box'; direction = (0, 1); },"
    "  { name = 'floor'; type = 'wall_contact_force'; wall = 'floor'; direction = (0, 1); },"
    "  { name = 'depth'; type = 'contact_depth'; },"
    "  { name = 'v'; type = 'body_velocity'; body = 'box'; direction = (0, 1); } );";

static void peak_within_one_step_of_the_soil_is_found(void **state)
{
    (void)state;
    const double mass = find_mass();
    const double stiffness = 30.0 * find_stiffness();
    const double peak = speed * sqrt(stiffness * mass);
    scene *it = make(sub_steps);
    mor_schedule *schedule = &it->simulation.schedule;
    double seen = 0.0;
    int ratio = 1;
    while (schedule->now < schedule->end) {
        scene_require(it, mor_schedule_step(&it->context, schedule, schedule->end));
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
        seen = fmax(seen, scene_probe(it, "box"));
        ratio = mor_schedule_rate_ratio(schedule) > ratio ? mor_schedule_rate_ratio(schedule) : ratio;
    }
    const mor_probe_statistics box = find(it, "box");
    const double given = it->simulation.bodies.groups[0]->bodies[0].mass * (scene_probe(it, "v") + speed);
    assert_true(ratio > 10);
    assert_true(seen < 0.9 * peak); /* at the ends of the soil's steps, that is all there is to see */
    scene_expect_near("peak", box.maximum, peak, 0.04 * peak); /* four nodes a radius */
    scene_expect_near("wall", find(it, "floor").minimum, -box.maximum, 1e-12 * peak);
    scene_expect_near("impulse", box.impulse, given, 1e-11 * given);
    scene_expect_near("impulse of the wall", find(it, "floor").impulse, -given, 1e-11 * given);
    /* The contact is narrower than half a spacing: nodes off the middle of the disc see it deeper or shallower. */
    scene_expect_near("depth", find(it, "depth").maximum, peak / stiffness, 0.15 * peak / stiffness);
    assert_true(mor_probe_remark(&it->simulation, 1) == NULL); /* one clock of bodies */
    scene_free(it);
}

static const char driven[] =
    "dimension = 2; spacing = '20 mm'; end = '40 ms'; gravity = (0, -10, 0);"
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.4, 0.4); };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );" FLOOR
    "bodies = ( { name = 'ram'; shape = { type = 'box'; min = (-0.1, -0.1); max = (0.1, 0.1); };"
    "    position = (0.51, 0.35); velocity = (-1, 0); motion = 'prescribed';"
    "    material = { model = 'rigid'; density = 2400; }; } );"
    "probes = ( { name = 'ram'; type = 'body_force_soil'; body = 'ram'; direction = (1, 0); },"
    "  { name = 'given'; type = 'body_impulse_soil_given'; body = 'ram'; direction = (1, 0); },"
    "  { name = 'floor'; type = 'wall_force'; wall = 'floor'; direction = (0, 1); },"
    "  { name = 'impulse'; type = 'wall_impulse'; wall = 'floor'; direction = (0, 1); },"
    "  { name = 'late'; type = 'wall_force'; wall = 'floor'; direction = (0, 1); window = ('20 ms', '40 ms'); },"
    "  { name = 'energy'; type = 'kinetic_energy'; } );";

/* Each step counted by hand. */
static void statistics_are_those_of_all_steps(void **state)
{
    (void)state;
    double largest = -INFINITY;
    double time = NAN;
    double sum = 0.0;
    double trapezoids = 0.0;
    scene *it = make(driven);
    mor_schedule *schedule = &it->simulation.schedule;
    double before = scene_probe(it, "energy");
    while (schedule->now < schedule->end) {
        scene_require(it, mor_schedule_step(&it->context, schedule, schedule->end));
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
        const double force = scene_probe(it, "floor");
        const double energy = scene_probe(it, "energy");
        const double now = mor_schedule_time(schedule);
        time = force > largest ? now : time;
        largest = fmax(largest, force);
        sum += now > 0.02 ? force * fmin(schedule->step_length, now - 0.02) : 0.0;
        trapezoids += 0.5 * (energy + before) * schedule->step_length;
        before = energy;
    }
    const mor_probe_statistics wall = find(it, "floor");
    assert_true(wall.maximum == largest && wall.time_of_maximum == time);
    scene_expect_near("late", find(it, "late").impulse, sum, 1e-12 * fabs(sum));
    scene_expect_near("impulse", wall.impulse, scene_probe(it, "impulse"), 1e-12 * fabs(wall.impulse));
    const double pushed = find(it, "ram").impulse;
    assert_true(pushed > 0.0);
    scene_expect_near("ram", pushed, scene_probe(it, "given"), 1e-12 * pushed);
    const double mean = find(it, "energy").mean;
    scene_expect_near("energy", mean, trapezoids / 0.04, 1e-12 * mean);
    assert_true(isnan(find(it, "energy").impulse));                                /* it is no force */
    assert_true(find(it, "energy").n_measured == (double)schedule->n_steps + 1.0); /* and the start */
    assert_true(wall.n_measured == (double)schedule->n_steps);
    scene_free(it);
}

/* Soil below the origin of a probe has no slope to measure; many looks at all particles take turns, and say so. */
static const char *const many[] = {
    "probes=( { name='angle'; type='repose_angle'; direction=(1, 0); origin=(0, 9); }, { type='stress_noise'; },"
    "  { type='height'; }, { type='wall_force'; wall='floor'; direction=(0, 1); } )",
    NULL};

static void what_is_not_measured_in_each_step_says_so(void **state)
{
    (void)state;
    const scene_request request = {driven, (const char *const *[]){many}, 1, 1};
    scene *it = scene_new(&request);
    scene_advance(it, 0.02);
    const mor_probe_statistics angle = find(it, "angle");
    const mor_probe_statistics height = find(it, "height");
    const mor_probe_statistics force = find(it, "wall_force");
    const uint64_t n_steps = it->simulation.schedule.n_steps;
    assert_true(isnan(angle.maximum) && isnan(angle.mean) && angle.n_skipped == angle.n_measured);
    assert_true(angle.interval > 1 && height.interval == angle.interval);
    assert_true(height.n_measured == 1.0 + (double)(n_steps / (uint64_t)height.interval));
    assert_true(height.n_skipped == 0.0 && height.maximum >= height.mean && height.mean >= height.minimum);
    assert_true(force.interval == 1 && force.n_measured == (double)n_steps);
    /* Whoever looks in between adds to the statistics, so that no row of a series exceeds them. */
    while (it->simulation.schedule.n_steps % (uint64_t)height.interval == 0) {
        scene_step(it, 1);
    }
    double *position = it->simulation.soil.set.data[MOR_FIELD_POSITION];
    double value = 0.0;
    position[1] = 0.9;
    scene_require(it, mor_probe_value(&it->context, &it->simulation, 2, &value));
    assert_true(value > 0.9 && find(it, "height").maximum == value);
    scene_free(it);
}

/* A value that is measured again is that of the step, and steps allocate nothing for it. */
static void following_probes_allocates_nothing(void **state)
{
    (void)state;
    scene *it = make(driven);
    scene_step(it, 1);
    scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    const uint64_t before = it->context.n_allocations;
    for (int k = 0; k < 10; ++k) {
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    }
    assert_true(it->context.n_allocations == before);
    for (int k = 0; k < it->the_case.n_probes; ++k) {
        double again = 0.0;
        double kept = 0.0;
        scene_require(it, mor_probe_evaluate(&it->context, &it->simulation, k, &again));
        scene_require(it, mor_probe_value(&it->context, &it->simulation, k, &kept));
        assert_true(again == kept || (isnan(again) && isnan(kept)));
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peak_of_a_bounce_is_that_of_a_linear_spring),
        cmocka_unit_test(window_cuts_statistics),
        cmocka_unit_test(peak_within_one_step_of_the_soil_is_found),
        cmocka_unit_test(statistics_are_those_of_all_steps),
        cmocka_unit_test(what_is_not_measured_in_each_step_says_so),
        cmocka_unit_test(following_probes_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
