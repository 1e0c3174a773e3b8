/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A lump of soil flies against free rocks, without gravity and walls: what mechanics says of the whole, through case,
 * schedule and probes. */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

/* An elastic ball that spins, hit off its center; a rigid block behind it, which it is thrown against. */
static const char plane[] =
    "title = 'plane'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '0 m/s2'); end = '50 ms';"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('1 m', '1 m', '1 m'); };"
    "soil = ( { name = 'lump'; velocity = ('1.5 m/s', '0.2 m/s');"
    "  shape = { type = 'box'; min = ('-120 mm', '-50 mm'); max = ('-20 mm', '50 mm'); };"
    "  material = { model = 'drucker_prager'; density = '1800 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );"
    "bodies = ( { name = 'ball'; shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '30 mm'; };"
    "    position = ('35 mm', '20 mm'); angular_velocity = ('0 rad/s', '0 rad/s', '20 rad/s');"
    "    material = { model = 'neo_hookean'; density = '2400 kg/m3'; youngs_modulus = '100 MPa';"
    "      poissons_ratio = 0.25; }; },"
    "  { name = 'block'; shape = { type = 'box'; min = ('-20 mm', '-30 mm'); max = ('20 mm', '30 mm'); };"
    "    position = ('95 mm', '-10 mm'); angle = '30 deg'; friction = 'coulomb'; friction_coefficient = 0.3;"
    "    contact_modulus = '20 MPa';"
    "    material = { model = 'rigid'; density = '2600 kg/m3'; }; },"
    "  { name = 'cube'; shape = { type = 'box'; min = ('-20 mm', '-20 mm'); max = ('20 mm', '20 mm'); };"
    "    position = ('25 mm', '-45 mm'); friction = 'smooth';"
    "    contact_modulus = '20 MPa';"
    "    material = { model = 'rigid'; density = '1900 kg/m3'; }; } );"
    "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
    "probes = ( { name = 'p0'; type = 'momentum'; direction = (1, 0, 0); },"
    "  { name = 'p1'; type = 'momentum'; direction = (0, 1, 0); },"
    "  { name = 'l2'; type = 'angular_momentum'; origin = ('10 mm', '-20 mm'); },"
    "  { name = 'energy'; type = 'total_energy'; } );";

static const char space[] =
    "title = 'space'; dimension = 3; spacing = '12 mm'; gravity = ('0 m/s2', '0 m/s2', '0 m/s2'); end = '50 ms';"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('1 m', '1 m', '1 m'); };"
    "soil = ( { name = 'lump'; velocity = ('1.5 m/s', '0.2 m/s', '-0.3 m/s');"
    "  shape = { type = 'box'; min = ('-120 mm', '-48 mm', '-48 mm'); max = ('-24 mm', '48 mm', '48 mm'); };"
    "  material = { model = 'drucker_prager'; density = '1800 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );"
    "bodies = ( { name = 'ball'; shape = { type = 'sphere'; center = ('0 m', '0 m', '0 m'); radius = '30 mm'; };"
    "    position = ('37 mm', '20 mm', '10 mm'); angular_velocity = ('5 rad/s', '-10 rad/s', '20 rad/s');"
    "    material = { model = 'neo_hookean'; density = '2400 kg/m3'; youngs_modulus = '100 MPa';"
    "      poissons_ratio = 0.25; }; },"
    "  { name = 'block';"
    "    shape = { type = 'box'; min = ('-24 mm', '-30 mm', '-24 mm'); max = ('24 mm', '30 mm', '24 mm'); };"
    "    position = ('105 mm', '-10 mm', '0 mm'); axis = (1, 2, 3); angle = '40 deg';"
    "    friction = 'coulomb'; friction_coefficient = 0.3;"
    "    contact_modulus = '20 MPa';"
    "    material = { model = 'rigid'; density = '2600 kg/m3'; }; },"
    "  { name = 'cube';"
    "    shape = { type = 'box'; min = ('-24 mm', '-24 mm', '-24 mm'); max = ('24 mm', '24 mm', '24 mm'); };"
    "    position = ('29 mm', '-45 mm', '-20 mm'); friction = 'smooth';"
    "    contact_modulus = '20 MPa';"
    "    material = { model = 'rigid'; density = '1900 kg/m3'; }; } );"
    "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
    "probes = ( { name = 'p0'; type = 'momentum'; direction = (1, 0, 0); },"
    "  { name = 'p1'; type = 'momentum'; direction = (0, 1, 0); },"
    "  { name = 'p2'; type = 'momentum'; direction = (0, 0, 1); },"
    "  { name = 'l0'; type = 'angular_momentum'; origin = ('10 mm', '-20 mm', '5 mm'); direction = (1, 0, 0); },"
    "  { name = 'l1'; type = 'angular_momentum'; origin = ('10 mm', '-20 mm', '5 mm'); direction = (0, 1, 0); },"
    "  { name = 'l2'; type = 'angular_momentum'; origin = ('10 mm', '-20 mm', '5 mm'); direction = (0, 0, 1); },"
    "  { name = 'energy'; type = 'total_energy'; } );";

static const char *const nothing[] = {NULL};
static const char *const zhang[] = {"numerics.scheme=zhang2024", NULL};
static const char *const keeps_angular[] = {"numerics.scheme=zhang2024", "numerics.angular_momentum=true", NULL};
static const char *const moraine[] = {"numerics.scheme=moraine", NULL};
static const char *const adjoint[] = {"numerics.velocity_gradient=sum", NULL};
static const char *const one_clock[] = {"numerics.single_rate=true", NULL};
static const char *const half_steps[] = {"numerics.courant=0.2", NULL};
static const char *const rigid_ball[] = {"bodies[0].material={model='rigid'; density='2400 kg/m3';}", NULL};

static const char *const momenta[] = {"p0", "p1", "p2"};
static const char *const angular_momenta[] = {"l0", "l1", "l2"};

/* Largest departures from the start. */
typedef struct departures {
    double momentum, angular; /* over the sums of magnitudes at the start */
    double gain;              /* of energy over its least value so far, as a share of the first */
    double lost;              /* share of the energy at the end */
    double impulse;           /* difference of what soil gave and rocks received, as a share of the momentum */
    double pushed[3];         /* impulse of the soil on each rock, as a share of the momentum */
    double touch;             /* largest force of contact between rocks, N (N/m) */
    int ratio;                /* most sub-steps of a rock in a step of the soil */
} departures;

/* Sums of magnitudes over soil and rocks: of momentum [0], kg m/s (kg/s), of its moment [1], kg m2/s (kg m/s). */
static void find_sizes(const scene *it, const double *origin, double *sizes)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    scene *writable = (scene *)it;
    const int n_sets = mor_simulation_sets(&writable->simulation, false, sets);
    sizes[0] = sizes[1] = 0.0;
    for (int s = 0; s < n_sets; ++s) {
        for (int64_t i = 0; i < sets[s]->n_particles; ++i) {
            const double *x = sets[s]->data[MOR_FIELD_POSITION] + 3 * i;
            const double arm[3] = {x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]};
            const double momentum =
                sets[s]->data[MOR_FIELD_MASS][i] * mor_vector_length(sets[s]->data[MOR_FIELD_VELOCITY] + 3 * i);
            sizes[0] += momentum;
            sizes[1] += momentum * mor_vector_length(arm);
        }
    }
}

/* Probes of momentum by component; z alone turns in plane strain. */
static void read_sums(scene *it, double *momentum, double *angular)
{
    const bool is_plane = it->the_case.dimension == 2;
    for (int a = 0; a < 3; ++a) {
        momentum[a] = is_plane && a == 2 ? 0.0 : scene_probe(it, momenta[a]);
        angular[a] = is_plane && a < 2 ? 0.0 : scene_probe(it, angular_momenta[a]);
    }
}

static void watch_impulses(const scene *it, double size, departures *d)
{
    for (int b = 0; b < it->the_case.n_bodies; ++b) {
        const mor_simulation_body *rock = &it->simulation.bodies.of[b];
        const mor_body *body = &rock->group->bodies[rock->index];
        const double *given = rock->group->boundary.patches[rock->index].impulse;
        for (int a = 0; a < 3; ++a) {
            d->impulse = fmax(d->impulse, fabs(given[a] - body->soil_impulse[a]) / size);
        }
        d->touch = fmax(d->touch, mor_vector_length(body->contact_force));
        d->pushed[b] = mor_vector_length(given) / size;
    }
}

static void show(const char *name, const departures *d)
{
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%-28s momentum %.1e, angular momentum %.1e, energy gain %.1e, lost %.3f, impulses %.1e, pushed %.3f "
               "%.3f %.3f, "
               "touch %.3g, ratio %d\n",
               name, d->momentum, d->angular, d->gain, d->lost, d->impulse, d->pushed[0], d->pushed[1], d->pushed[2],
               d->touch, d->ratio);
    }
}

/* Runs a collision to its end. */
static departures collide(const char *name, const char *text, const char *const *first, const char *const *second)
{
    const char *const *lists[] = {first, second};
    const scene_request request = {text, lists, 2, 1};
    scene *it = scene_new(&request);
    mor_schedule *schedule = &it->simulation.schedule;
    departures d = {0};
    double start[2][3];
    double sizes[2];
    read_sums(it, start[0], start[1]);
    find_sizes(it, it->the_case.probes[it->the_case.dimension == 2 ? 2 : 3].origin, sizes);
    const double energy = scene_probe(it, "energy");
    double least = energy;
    while (schedule->now < schedule->end) {
        double now[2][3];
        scene_step(it, 1);
        read_sums(it, now[0], now[1]);
        for (int a = 0; a < 3; ++a) {
            d.momentum = fmax(d.momentum, fabs(now[0][a] - start[0][a]) / sizes[0]);
            d.angular = fmax(d.angular, fabs(now[1][a] - start[1][a]) / sizes[1]);
        }
        const double energy_now = scene_probe(it, "energy");
        d.gain = fmax(d.gain, (energy_now - least) / energy);
        least = fmin(least, energy_now);
        d.ratio = (int)fmax(d.ratio, mor_schedule_rate_ratio(schedule));
        watch_impulses(it, sizes[0], &d);
    }
    d.lost = 1.0 - scene_probe(it, "energy") / energy;
    show(name, &d);
    scene_free(it);
    return d;
}

enum {
    PLAIN,
    PLAIN_ONE_CLOCK,
    ANGULAR,
    ANGULAR_ONE_CLOCK,
    ANGULAR_HALF_STEPS,
    ANGULAR_RIGID,
    MORAINE,
    MORAINE_HALF_STEPS,
    MORAINE_ADJOINT,
    N_WAYS,
    N_SCENES = 2
};

/* All collisions run once, before the tests, which only look at what they found. */
typedef struct results {
    departures of[N_SCENES][N_WAYS];
} results;

static int run_all(void **state)
{
    static const char *const texts[N_SCENES] = {plane, space};
    static const char *const names[N_WAYS] = {"plain",
                                              "plain, one clock",
                                              "angular momentum",
                                              "angular momentum, one clock",
                                              "angular momentum, half steps",
                                              "angular momentum, rigid",
                                              "moraine",
                                              "moraine, half steps",
                                              "moraine, adjoint"};
    static const char *const *const settings[N_WAYS][2] = {
        {zhang, nothing},           {zhang, one_clock},          {keeps_angular, nothing},
        {keeps_angular, one_clock}, {keeps_angular, half_steps}, {keeps_angular, rigid_ball},
        {moraine, nothing},         {moraine, half_steps},       {moraine, adjoint}};
    results *found = calloc(1, sizeof *found);
    assert_non_null(found);
    for (int s = 0; s < N_SCENES; ++s) {
        for (int way = 0; way < N_WAYS; ++way) {
            found->of[s][way] = collide(names[way], texts[s], settings[way][0], settings[way][1]);
        }
    }
    *state = found;
    return 0;
}

static int free_all(void **state)
{
    free(*state);
    return 0;
}

static void rocks_are_hit_by_soil_and_by_each_other_at_their_own_clock(void **state)
{
    const results *found = *state;
    for (int s = 0; s < N_SCENES; ++s) {
        for (int way = 0; way < N_WAYS; ++way) {
            const departures *d = &found->of[s][way];
            const bool is_single = way == PLAIN_ONE_CLOCK || way == ANGULAR_ONE_CLOCK;
            assert_true(d->lost > 0.1);
            assert_true(d->pushed[0] > 0.02 && d->pushed[2] > 0.02); /* ball and cube stand in the way of the soil */
            assert_true(d->touch > 0.0);
            assert_true(is_single ? d->ratio == 1 : d->ratio > 1);
        }
    }
}

static void momentum_is_kept_to_rounding(void **state)
{
    const results *found = *state;
    for (int s = 0; s < N_SCENES; ++s) {
        for (int way = 0; way < N_WAYS; ++way) {
            assert_true(found->of[s][way].momentum <= 1e-12); /* rounding of thousands of steps */
        }
    }
}

static void rocks_receive_the_impulse_that_the_soil_gives(void **state)
{
    const results *found = *state;
    for (int s = 0; s < N_SCENES; ++s) {
        for (int way = 0; way < N_WAYS; ++way) {
            assert_true(found->of[s][way].impulse <= 1e-12); /* rounding of thousands of sub-steps */
        }
    }
}

/* Where force and gradient are adjoint. A fitted gradient is not: with moraine 4e-8 of the energy were gained in the
 * plane and 7e-7 in space, 9e-9 and 3e-7 with half the steps; docs/theory/soil.md says what that needs. */
static void energy_never_grows_where_forces_and_gradient_are_adjoint(void **state)
{
    const results *found = *state;
    for (int s = 0; s < N_SCENES; ++s) {
        for (int way = 0; way < N_WAYS; ++way) {
            const bool is_fitted = way == MORAINE || way == MORAINE_HALF_STEPS;
            /* Stress and velocity: half a step apart. Fitted: golden, three times what was measured. */
            assert_true(found->of[s][way].gain <= (is_fitted ? 2e-6 : 1e-8));
        }
    }
}

static void angular_momentum_is_kept_where_the_case_asks_for_it(void **state)
{
    const results *found = *state;
    for (int s = 0; s < N_SCENES; ++s) {
        const departures *of = found->of[s];
        assert_true(of[ANGULAR_RIGID].angular <= 1e-12);     /* rounding: moments are taken where the soil saw them */
        assert_true(of[ANGULAR_ONE_CLOCK].angular <= 1e-12); /* rounding: rocks stand where the soil saw them */
        assert_true(of[ANGULAR].angular <= 1e-6);            /* forces are held while the points of the ball move on */
        assert_true(of[ANGULAR_HALF_STEPS].angular <= 0.35 * of[ANGULAR].angular); /* second order: a quarter */
        assert_true(of[PLAIN].angular > 100.0 * of[ANGULAR].angular);
        assert_true(of[PLAIN].angular <= 1e-2); /* statistical: 0.1 % were measured */
        /* Moments of the last step: exact to the change in a step, so of first order; a ninetieth was measured. */
        assert_true(of[PLAIN].angular > 50.0 * of[MORAINE].angular);
        assert_true(of[MORAINE_HALF_STEPS].angular <= 0.6 * of[MORAINE].angular);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rocks_are_hit_by_soil_and_by_each_other_at_their_own_clock),
        cmocka_unit_test(momentum_is_kept_to_rounding),
        cmocka_unit_test(rocks_receive_the_impulse_that_the_soil_gives),
        cmocka_unit_test(energy_never_grows_where_forces_and_gradient_are_adjoint),
        cmocka_unit_test(angular_momentum_is_kept_where_the_case_asks_for_it),
    };
    return cmocka_run_group_tests(tests, run_all, free_all);
}
