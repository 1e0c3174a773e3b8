/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Where energy goes, part by part, where mechanics tells: free fall, an elastic bounce, friction of a sliding block, a
 * piston, a collapse, soil that hits a rock. */

#define AUDIT                                                                                                          \
    "{ type = 'kinetic_energy'; }, { type = 'potential_energy'; }, { type = 'elastic_energy'; },"                      \
    "{ type = 'plastic_energy'; }, { type = 'numerical_dissipation'; }, { type = 'riemann_energy'; },"                 \
    "{ type = 'stress_diffusion_energy'; }, { type = 'boundary_dissipation'; }, { type = 'external_work'; },"          \
    "{ type = 'friction_strain_energy'; },"                                                                            \
    "{ type = 'energy_balance'; }, { type = 'mass'; }"

static const double share_astray = 0.02; /* of the energy turned over, that may be lost sight of */

static scene *make(const char *text, const char *const *settings)
{
    const scene_request request = {text, (const char *const *[]){settings}, 1, 1};
    return scene_new(&request);
}

static const char block[] =
    "dimension = 2; spacing = '10 mm'; end = '0.4 s'; gravity = (0, 0, 0);"
    "domain = { min = (-0.5, -0.5, -1); max = (1.5, 1.5, 1); };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.1); };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "probes = ( " AUDIT " );";

static const char *const falling[] = {"gravity=(0, -9.81, 0)", "numerics.stress_diffusion=0", NULL};

static void free_fall_turns_height_into_speed_and_nothing_else(void **state)
{
    (void)state;
    scene *it = make(block, falling);
    const double before = scene_probe(it, "potential_energy");
    scene_advance(it, 0.2);
    const double released = before - scene_probe(it, "potential_energy");
    static const char *const others[] = {"plastic_energy", "numerical_dissipation", "boundary_dissipation",
                                         "external_work"};
    const double height = 0.5 * 9.81 * 0.2 * 0.2;
    scene_expect_near("released", released, 40.0 * 9.81 * height, 1e-9 * released); /* rounding of some hundred steps */
    for (int k = 0; k < 4; ++k) {
        scene_expect_near(others[k], scene_probe(it, others[k]), 0.0, 1e-9 * released); /* likewise */
    }
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, 1e-9); /* likewise */
    scene_free(it);
}

static const char *const thrown[] = {
    "soil[0].velocity=(0, -0.1, 0)",
    "numerics.dissipation_factor=0",
    "numerics.stress_diffusion=0",
    "numerics.courant=0.05",
    "walls=({name='floor'; friction='smooth'; shape={type='half_space'; point=(0, 0, 0); normal=(0, 1, 0);};})",
    NULL};

/* An elastic block bounces off a smooth wall: energy goes to and fro, but for a part that the scheme takes or adds. */
static void follow_bounce(const char *scheme, double least, double most)
{
    const char *const numerics[] = {scheme, NULL};
    const scene_request request = {block, (const char *const *[]){thrown, numerics}, 2, 1};
    scene *it = scene_new(&request);
    const double start = scene_probe(it, "kinetic_energy");
    double stored = 0.0;
    for (int k = 1; k <= 40; ++k) {
        scene_advance(it, 0.0005 * k);
        stored = fmax(stored, scene_probe(it, "elastic_energy"));
        scene_expect_near("plastic", scene_probe(it, "plastic_energy"), 0.0, 1e-12 * start); /* rounding */
        const double numerical = scene_probe(it, "numerical_dissipation");
        assert_true(numerical >= least * start && numerical <= most * start);
        /* Velocity and stress stand half a step apart, and the wall's mirror image gives and takes a part of the energy
         * of the first of ten layers: half of a layer's. */
        assert_true(scene_probe(it, "kinetic_energy") + scene_probe(it, "elastic_energy") < (1.0 + 0.05) * start);
        /* Velocity and stress stand half a step apart, which shows while next to nothing has changed hands. */
        if (stored > 0.25 * start) {
            scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
        }
    }
    assert_true(stored > 0.5 * start);
    scene_free(it);
}

static void elastic_bounce_gains_nothing(void **state)
{
    (void)state;
    /* Of (S7), what pressure and impedance do together is left: a part of density's change, here 1 %. */
    follow_bounce("numerics.scheme=zhang2024", -1e-3, 1e-3);
    /* Golden: at most 0.03 were given and 0.11 taken, by hourglass control at its limit and by the fit at surfaces. */
    follow_bounce("numerics.scheme=moraine", -0.05, 0.15);
    /* Later it does without any dissipation, see docs/theory/soil.md: not with the diffusion of the scheme. */
    static const char *const diffusing[] = {"numerics.scheme=moraine", "numerics.stress_diffusion=0.1", NULL};
    const scene_request request = {block, (const char *const *[]){thrown, diffusing}, 2, 1};
    scene *it = scene_new(&request);
    const double start = scene_probe(it, "kinetic_energy");
    for (int k = 1; k <= 20; ++k) {
        scene_advance(it, 0.02 * k);
        assert_true(scene_probe(it, "kinetic_energy") + scene_probe(it, "elastic_energy") < start);
    }
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
    scene_free(it);
}

static const char *const thrown_with_cohesion[] = {
    "soil[0].velocity=(0, -0.02, 0)",
    "numerics.artificial_stress=true",
    "end='1 s'",
    "soil[0].material={model='mohr_coulomb'; density=2000; youngs_modulus='5 MPa'; poissons_ratio=0.3;"
    " cohesion='10 kPa'; friction_angle='25 deg';}",
    "walls=({name='floor'; friction='smooth'; shape={type='half_space'; point=(0, 0, 0); normal=(0, 1, 0);};})",
    NULL};

/* Beside an elastic stress artificial stress has no potential: it brought a block that had come to rest to a thousand
 * times the energy it had left. It acts where soil flows, so that what rings dies away. */
static void artificial_stress_gives_a_block_that_rings_no_energy(void **state)
{
    (void)state;
    scene *it = make(block, thrown_with_cohesion);
    double before = scene_probe(it, "kinetic_energy");
    for (int k = 1; k <= 5; ++k) {
        scene_advance(it, 0.2 * k);
        const double now = scene_probe(it, "kinetic_energy") + scene_probe(it, "elastic_energy");
        assert_true(now < before);
        before = now;
    }
    scene_free(it);
}

static const char *const thrown_and_smoothed[] = {
    "soil[0].velocity=(0, -0.1, 0)", "numerics.stress_diffusion=0.2",
    "walls=({name='floor'; friction='smooth'; shape={type='half_space'; point=(0, 0, 0); normal=(0, 1, 0);};})", NULL};

/* What stress diffusion takes from an elastic soil is not plastic strain, whatever its share. */
static void stress_diffusion_of_elastic_soil_is_no_plastic_strain(void **state)
{
    (void)state;
    scene *it = make(block, thrown_and_smoothed);
    const double start = scene_probe(it, "kinetic_energy");
    scene_advance(it, 0.02);
    scene_expect_near("plastic", scene_probe(it, "plastic_energy"), 0.0, 1e-12 * start); /* rounding */
    assert_true(scene_probe(it, "stress_diffusion_energy") > 1e-4 * start);
    scene_free(it);
}

static const char *const sliding[] = {
    "gravity=(0, -9.81, 0)",
    "soil[0].velocity=(1, 0, 0)",
    "soil[0].material.model=drucker_prager",
    "soil[0].initial_stress={type='k0'; lateral_ratio=0.4;}",
    "walls=({name='floor'; friction='coulomb'; friction_coefficient=0.2; shape={type='half_space'; point=(0, 0, 0);"
    "normal=(0, 1, 0);};})",
    "soil[0].material.friction_angle=30 deg",
    "soil[0].material.cohesion=2 kPa",
    NULL};

/* A block that slides is slowed by the floor alone, at a constant rate. */
static void sliding_block_keeps_the_energy_that_friction_leaves(void **state)
{
    (void)state;
    const char *const calm[] = {"numerics.scheme=moraine", NULL};
    const scene_request request = {block, (const char *const *[]){sliding, calm}, 2, 1};
    scene *it = scene_new(&request);
    const double mass = scene_probe(it, "mass");
    const double speed = 1.0 - 0.2 * 9.81 * 0.3;
    scene_advance(it, 0.3);
    /* J: the block rattles. */
    scene_expect_near("kinetic", scene_probe(it, "kinetic_energy"), 0.5 * mass * speed * speed, 0.01 * 0.5 * mass);
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
    scene_free(it);
}

/* Lets a block slide; returns the energy that friction passes on to its stress over the work of friction by the law. */
static double slide_block(const char *scheme)
{
    const char *const numerics[] = {scheme, NULL};
    const scene_request request = {block, (const char *const *[]){sliding, numerics}, 2, 1};
    scene *it = scene_new(&request);
    const double mass = scene_probe(it, "mass");
    double center[2] = {0.0, 0.0};
    const double *x = it->simulation.soil.set.data[MOR_FIELD_POSITION];
    const int64_t n = it->simulation.soil.set.n_particles;
    for (int k = 0; k < 2; ++k) {
        for (int64_t i = 0; i < n; ++i) {
            center[k] += x[3 * i] / (double)n;
        }
        if (k == 0) {
            scene_advance(it, 0.3);
        }
    }
    const double work = 0.2 * mass * 9.81 * (center[1] - center[0]);
    const double passed_on = scene_probe(it, "friction_strain_energy") / work;
    /* The floor takes each grain by its own pressure and speed, the law the weight and the mean. */
    scene_expect_near("friction", scene_probe(it, "boundary_dissipation"), work, 0.05 * work);
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
    print_message("%s: friction over its law %.3f, of which strains the soil %.3f\n", scheme,
                  scene_probe(it, "boundary_dissipation") / work, passed_on);
    scene_free(it);
    return passed_on;
}

/* What friction takes is what the block loses. Where the friction of each grain is by its own stress the mirrored share
 * is the limit over that traction, and strained by it takes what the limit takes; but the traction changes much within
 * a step. What slips strains nothing otherwise, but for what loads the soil as pressures change. */
static void friction_of_a_sliding_block_is_lost_at_the_floor(void **state)
{
    (void)state;
    scene_expect_near("passed on", slide_block("numerics.scheme=zhang2024"), 1.0, 0.2);
    scene_expect_near("passed on", slide_block("numerics.scheme=moraine"), 0.0, 0.05);
}

static const char *const pushed[] = {
    "soil[0].material.model=drucker_prager", "soil[0].material.friction_angle=30 deg",
    "soil[0].material.cohesion=2 kPa",
    "walls=({name='piston'; friction='smooth'; velocity=(0.3, 0, 0); shape={type='box'; min=(-0.1, -0.1);"
    "max=(0, 0.3);};}, {name='end'; friction='smooth'; shape={type='half_space'; point=(0.2, 0, 0); normal=(-1, 0, "
    "0);};})",
    NULL};

/* A piston moves at constant speed, so its work is the impulse on it times its speed. */
static void piston_gives_what_its_force_does_along_its_way(void **state)
{
    (void)state;
    scene *it = make(block, pushed);
    scene_advance(it, 0.1);
    const double work = -0.3 * it->simulation.soil.wall_impulse[0][0];
    assert_true(work > 0.0);
    scene_expect_near("external work", scene_probe(it, "external_work"), work, 0.01 * work); /* sampling */
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
    assert_true(scene_probe(it, "plastic_energy") > 0.3 * work);
    scene_free(it);
}

static void check_case(const char *path, const char *const *settings, double until)
{
    scene *it = make(path, settings);
    for (int k = 1; k <= 4; ++k) {
        scene_advance(it, 0.25 * k * until);
        scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
        assert_true(scene_probe(it, "riemann_energy") > 0.0);
        assert_true(scene_probe(it, "stress_diffusion_energy") > 0.0);
    }
    assert_true(scene_probe(it, "plastic_energy") > scene_probe(it, "numerical_dissipation"));
    scene_free(it);
}

static const char collapse[] =
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, '-9.81 m/s2', 0);"
    "domain = { min = (-0.1, -0.1, -1); max = (1.5, 0.5, 1); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.2); };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = (0, 0, 0); normal = (1, 0, 0); }; } );"
    "probes = ( " AUDIT " );";

static const char *const nothing[] = {NULL};

static void energy_of_a_collapse_is_accounted_for(void **state)
{
    (void)state;
    check_case(collapse, nothing, 0.6);
}

/* A heap of sand that flows down a slope, at last a few particles thick. */
static const char slope[] =
    "dimension = 2; spacing = '10 mm'; gravity = ('5 m/s2', '-8.66 m/s2', 0); end = '0.6 s';"
    "domain = { min = ('-0.5 m', '-0.2 m', '-1 m'); max = ('4 m', '0.5 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.15 m'); };"
    "  material = { model = 'mohr_coulomb'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "probes = ( { type = 'plastic_energy'; }, { type = 'numerical_dissipation'; }, { type = 'energy_balance'; } );";

static const char *const fitted[] = {"numerics.velocity_gradient=fit", NULL};

/* What the law dissipates is what the motion loses, but for what the method takes: 7 % here. With the
 * strain of the fit everywhere the law dissipates more, and the method seems to give the difference: 7 %. */
static void flow_down_a_slope_is_given_no_energy(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        scene *it = make(slope, k == 0 ? nothing : fitted);
        scene_advance(it, 0.6);
        const double share = scene_probe(it, "numerical_dissipation") / scene_probe(it, "plastic_energy");
        print_message("taken by the method over plastic energy: %.4f\n", share);
        assert_true(k == 0 ? share > 0.0 && share < 0.1 : share < -0.04); /* or else the test tells nothing */
        scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
        scene_free(it);
    }
}

static const char impact[] =
    "dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '0 m/s2'); end = '50 ms';"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('1 m', '1 m', '1 m'); };"
    "soil = ( { name = 'lump'; velocity = ('1.5 m/s', '0.2 m/s');"
    "  shape = { type = 'box'; min = ('-120 mm', '-50 mm'); max = ('-20 mm', '50 mm'); };"
    "  material = { model = 'drucker_prager'; density = '1800 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );"
    "bodies = ( { name = 'rock'; shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '40 mm'; };"
    "    position = ('45 mm', '20 mm'); angular_velocity = ('0 rad/s', '0 rad/s', '10 rad/s');"
    "    material = { model = 'rigid'; density = '2400 kg/m3'; }; } );"
    "probes = ( { type = 'soil_work_on_bodies'; }, { type = 'bodies_kinetic_energy'; }, " AUDIT " );";

static const char *const elastic_rock[] = {
    "bodies[0].material={model='neo_hookean'; density='2400 kg/m3'; youngs_modulus='100 MPa'; poissons_ratio=0.25;}",
    NULL};

static const char *const barrier[] = {"numerics.barrier_stiffness=1e4", "numerics.barrier_radius='15 mm'", NULL};

/* Without gravity and contact all that a free rock has is what it began with and what the soil did on it. */
static void rock_that_soil_hits_gets_what_the_soil_did(void **state)
{
    const char *const *const kinds[] = {nothing, elastic_rock, barrier};
    (void)state;
    for (int k = 0; k < 3; ++k) {
        scene *it = make(impact, kinds[k]);
        const double start = scene_probe(it, "bodies_kinetic_energy");
        const double turned = scene_probe(it, "kinetic_energy");
        scene_advance(it, 0.05);
        double e[3];
        const double origin[3] = {0.0, 0.0, 0.0};
        mor_simulation_bodies_energy(&it->simulation.bodies, origin, &e[0], &e[1], &e[2]);
        const double damped = k == 1 ? mor_simulation_bodies_damped(&it->simulation.bodies) : 0.0;
        const double work = scene_probe(it, "soil_work_on_bodies");
        scene_expect_near("work on the rock", work, e[0] + e[2] + damped - start, 0.01 * turned); /* sampling */
        scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
        scene_free(it);
    }
}

static const char *const driven_rock[] = {"bodies[0].motion=prescribed",
                                          "bodies[0].velocity=(-1.5, 0, 0)",
                                          "bodies[0].angular_velocity=(0, 0, 0)",
                                          "soil[0].velocity=(0, 0, 0)",
                                          "probes=({type='body_impulse_soil_given'; body='rock'; direction=(1, 0, 0);},"
                                          "{type='external_work';}, {type='soil_work_on_bodies';},"
                                          "{type='energy_balance';})",
                                          NULL};

/* A rock that moves as prescribed is a piston of any shape: what it gives is the impulse on it times its speed, and no
 * soil works on it. */
static void driven_rock_gives_what_its_force_does_along_its_way(void **state)
{
    (void)state;
    scene *it = make(impact, driven_rock);
    scene_advance(it, 0.03);
    const double work = 1.5 * scene_probe(it, "body_impulse_soil_given");
    assert_true(work > 0.0);
    scene_expect_near("external work", scene_probe(it, "external_work"), work, 0.01 * work); /* sampling */
    assert_true(scene_probe(it, "soil_work_on_bodies") == 0.0);
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, share_astray);
    scene_free(it);
}

static const char rest[] =
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, '-9.81 m/s2', 0);"
    "domain = { min = (-0.1, -0.1, -1); max = (0.3, 0.5, 1); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.2); };"
    "  initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"
    "  material = { model = 'hypoplastic_sand'; density = 1700; critical_friction_angle = '33 deg';"
    "    granulate_hardness = '0.1 GPa'; exponent = 0.27; densest_void_ratio = 0.68; critical_void_ratio = 1.05;"
    "    loosest_void_ratio = 1.2; alpha = 0.14; beta = 2.5; void_ratio = 0.85; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; } );"
    "probes = ( { type = 'riemann_energy'; } );";

/* A law that does not tell its energy leaves parts without a number; the others are sampled as rarely as of any law. */
static void laws_without_an_energy_are_not_sampled_in_each_step(void **state)
{
    (void)state;
    scene *it = make(rest, nothing);
    scene_step(it, 200);
    const mor_soil_energy *energy = it->simulation.soil.energy;
    assert_false(isfinite(energy->power[MOR_SOIL_ENERGY_PLASTIC]));
    assert_true(isfinite(energy->turnover));
    assert_int_equal(energy->stride, 2); /* the most of so few particles */
    scene_free(it);
}

/* Samples are rare while soil flies, follow one another in each step of the impact, and are rare again afterwards: the
 * rock is within the kernel of the soil from the start and stops it within 30 ms; found: each step from 6 to 17 ms. */
static void powers_are_sampled_in_each_step_only_while_they_change_fast(void **state)
{
    (void)state;
    static const struct {
        double time;
        int64_t stride;
    } expected[] = {{0.004, 2}, {0.010, 1}, {0.015, 1}, {0.045, 2}}; /* s; steps, 2 at most of so few particles */
    scene *it = make(impact, nothing);
    for (int k = 0; k < 4; ++k) {
        scene_advance(it, expected[k].time);
        assert_int_equal(it->simulation.soil.energy->stride, expected[k].stride);
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_sampled_in_each_step_only_while_they_change_fast),
        cmocka_unit_test(laws_without_an_energy_are_not_sampled_in_each_step),
        cmocka_unit_test(free_fall_turns_height_into_speed_and_nothing_else),
        cmocka_unit_test(elastic_bounce_gains_nothing),
        cmocka_unit_test(artificial_stress_gives_a_block_that_rings_no_energy),
        cmocka_unit_test(stress_diffusion_of_elastic_soil_is_no_plastic_strain),
        cmocka_unit_test(sliding_block_keeps_the_energy_that_friction_leaves),
        cmocka_unit_test(friction_of_a_sliding_block_is_lost_at_the_floor),
        cmocka_unit_test(piston_gives_what_its_force_does_along_its_way),
        cmocka_unit_test(energy_of_a_collapse_is_accounted_for),
        cmocka_unit_test(flow_down_a_slope_is_given_no_energy),
        cmocka_unit_test(rock_that_soil_hits_gets_what_the_soil_did),
        cmocka_unit_test(driven_rock_gives_what_its_force_does_along_its_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
