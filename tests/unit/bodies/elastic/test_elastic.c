/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/elastic_bodies.h"
#include "tests/common/near.h"

static const elastic_piece box_and_ball[2] = {
    {.side = {0.7, 0.5, 0.6}, .axis = {0.48, 0.6, 0.64}, .angle = 0.9, .middle = {5.0, -3.0, 2.0}},
    {.is_ball = true, .side = {0.9, 0.9, 0.9}, .axis = {0.0, 0.6, 0.8}, .angle = 2.0}};
static const elastic_piece plate_and_disc[2] = {
    {.side = {0.7, 0.5}, .axis = {0.0, 0.0, 1.0}, .angle = 0.9, .middle = {5.0, -3.0}},
    {.is_ball = true, .side = {0.9, 0.9}, .axis = {0.0, 0.0, 1.0}, .angle = 2.0}};

static elastic_request request_of(int dimension)
{
    return (elastic_request){
        .dimension = dimension,
        .spacing = 0.1,
        .jitter = 0.3,
        .pieces = dimension == 3 ? box_and_ball : plate_and_disc,
        .n_pieces = 2,
        .youngs = 1e6,
        .poisson = 0.3,
        .density = 1000.0,
        .settings = {.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.0}};
}

/* Velocities A X of all particles, where A is shape [3,3], 1/s; in plane strain without its last row and column. */
static void set_linear_velocity(elastic_bodies *it, const double *a)
{
    const mor_body_group *group = &it->elastic.group;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        mor_matrix_apply(a, group->reference + 3 * i, group->set.data[MOR_FIELD_VELOCITY] + 3 * i);
    }
    elastic_require(it, mor_elastic_prepare(&it->context, &it->elastic));
}

static const double gradients[2][9] = {{0.3, -1.2, 0.0, 0.8, 0.5, 0.0, 0.0, 0.0, 0.0},
                                       {0.3, -1.2, 0.7, 0.8, 0.5, -0.4, 1.1, 0.2, -0.6}};

static void test_gradient_of_a_linear_field_is_exact_at_surfaces_and_corners(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        const double *a = gradients[dimension - 2];
        const elastic_request request = request_of(dimension);
        elastic_bodies it;
        double error = 0.0;
        elastic_open(&it, &request);
        set_linear_velocity(&it, a);
        const double *rate = it.elastic.group.set.data[it.elastic.field_rate];
        for (int64_t k = 0; k < 9 * it.elastic.group.set.n_particles; ++k) {
            error = fmax(error, fabs(rate[k] - a[k % 9]));
        }
        print_message("%dD: error %.1e\n", dimension, error);
        assert_true(error < 1e-12); /* rounding: X is of order 5, the spacing 0.1 */
        elastic_close(&it);
    }
}

/* Deforms all bodies by x = F X. */
static void deform(elastic_bodies *it, const double *f)
{
    const mor_body_group *group = &it->elastic.group;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        mor_matrix_apply(f, group->reference + 3 * i, group->set.data[MOR_FIELD_POSITION] + 3 * i);
        memcpy(group->set.data[it->elastic.field_gradient] + 9 * i, f, 9 * sizeof *f);
    }
}

/* Makes the deformation gradients those of the positions, which are then no longer a linear map. */
static void fit_gradients(elastic_bodies *it)
{
    const mor_set *set = &it->elastic.group.set;
    const size_t n = (size_t)set->n_particles;
    memcpy(set->data[MOR_FIELD_VELOCITY], set->data[MOR_FIELD_POSITION], 3 * n * sizeof(double));
    elastic_require(it, mor_elastic_prepare(&it->context, &it->elastic));
    memcpy(set->data[it->elastic.field_gradient], set->data[it->elastic.field_rate], 9 * n * sizeof(double));
    for (size_t i = 0; i < n && it->elastic.group.dimension == 2; ++i) {
        set->data[it->elastic.field_gradient][9 * i + 8] = 1.0;
    }
    memset(set->data[MOR_FIELD_VELOCITY], 0, 3 * n * sizeof(double));
    elastic_require(it, mor_elastic_prepare(&it->context, &it->elastic));
}

/* Runs stress and forces without moving anything. */
static void find_acceleration(elastic_bodies *it)
{
    const mor_step step = {.n_parts = 1};
    for (int k = 1; k <= 2; ++k) {
        elastic_require(it, mor_stepper_run_stage(&it->context, &it->stepper, k, &step));
    }
}

static void test_uniform_stress_makes_no_force_inside_and_none_in_sum(void **state)
{
    (void)state;
    elastic_request request = request_of(3);
    static const elastic_piece cube = {.side = {1.2, 1.2, 1.2}};
    request.pieces = &cube;
    request.n_pieces = 1;
    request.jitter = 0.0;
    elastic_bodies it;
    elastic_open(&it, &request);
    deform(&it, (const double[9]){1.02, 0.01, 0.0, 0.0, 0.99, 0.0, 0.0, 0.0, 1.0});
    find_acceleration(&it);
    const double *a = it.elastic.group.set.data[MOR_FIELD_ACCELERATION];
    const double *x = it.elastic.group.reference;
    double inside = 0.0;
    double largest = 0.0;
    double sum[3] = {0.0};
    for (int64_t i = 0; i < it.elastic.group.set.n_particles; ++i) {
        const double depth = 0.6 - fmax(fabs(x[3 * i]), fmax(fabs(x[3 * i + 1]), fabs(x[3 * i + 2])));
        const double strength = mor_vector_length(a + 3 * i);
        inside = depth > 0.46 ? fmax(inside, strength) : inside;
        largest = fmax(largest, strength);
        for (int k = 0; k < 3; ++k) {
            sum[k] += a[3 * i + k];
        }
    }
    assert_true(largest > 1.0);            /* the free surface is pulled in */
    assert_true(inside < 1e-12 * largest); /* two supports of 0.23 m from the surface all neighbors are alike */
    assert_true(mor_vector_length(sum) < 1e-10 * largest); /* pairs cancel to rounding of some 1e5 terms */
    elastic_close(&it);
}

/* Cauchy stress of the set against Hooke's law for a small strain. */
static void test_stress_of_the_set_is_hookes_for_small_strain(void **state)
{
    (void)state;
    const elastic_request request = request_of(2);
    elastic_bodies it;
    elastic_open(&it, &request);
    const double strain = 1e-6;
    deform(&it, (const double[9]){1.0 + strain, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    find_acceleration(&it);
    const double lame = 1e6 * 0.3 / (1.3 * 0.4);
    const double shear = 1e6 / 2.6;
    const double *s = it.elastic.group.set.data[MOR_FIELD_STRESS];
    assert_near(s[MOR_XX] / strain, lame + 2.0 * shear, 1e-5 * lame * 10.0); /* second order in the strain */
    assert_near(s[MOR_YY] / strain, lame, 1e-5 * lame * 10.0);
    assert_near(s[MOR_ZZ] / strain, lame, 1e-5 * lame * 10.0); /* plane strain carries it */
    elastic_close(&it);
}

/* The part of the acceleration that hourglass control adds. */
static void find_hourglass(elastic_bodies *with, elastic_bodies *without, double *out)
{
    find_acceleration(with);
    find_acceleration(without);
    for (int64_t k = 0; k < 3 * with->elastic.group.set.n_particles; ++k) {
        out[k] = with->elastic.group.set.data[MOR_FIELD_ACCELERATION][k] -
                 without->elastic.group.set.data[MOR_FIELD_ACCELERATION][k];
    }
}

static double largest_of(const double *values, int64_t n)
{
    double largest = 0.0;
    for (int64_t k = 0; k < n; ++k) {
        largest = fmax(largest, fabs(values[k]));
    }
    return largest;
}

static void test_hourglass_control_sees_what_a_linear_map_does_not(void **state)
{
    (void)state;
    enum { ROOM = 2000 };
    for (int dimension = 2; dimension <= 3; ++dimension) {
        elastic_request request = request_of(dimension);
        elastic_bodies with;
        elastic_bodies without;
        static double force[3 * ROOM];
        elastic_open(&without, &request);
        request.settings.hourglass = 0.5;
        elastic_open(&with, &request);
        const mor_body_group *group = &with.elastic.group;
        const int64_t n = group->set.n_particles;
        assert_true(n <= ROOM);
        const double f[9] = {1.1, 0.3, 0.0, -0.2, 0.9, 0.0, 0.0, 0.0, dimension == 3 ? 1.05 : 1.0};
        deform(&with, f);
        deform(&without, f);
        find_hourglass(&with, &without, force);
        const double linear = largest_of(force, 3 * n);
        double *x = group->set.data[MOR_FIELD_POSITION];
        for (int64_t i = 0; i < n; ++i) {
            x[3 * i] += group->set.id[i] % 2 == 0 ? 1e-3 : -1e-3;
        }
        memcpy(without.elastic.group.set.data[MOR_FIELD_POSITION], x, 3 * (size_t)n * sizeof *x);
        fit_gradients(&with);
        fit_gradients(&without);
        find_hourglass(&with, &without, force);
        double sum[3] = {0.0};
        double moment[3] = {0.0};
        for (int64_t i = 0; i < group->bodies[0].n_particles; ++i) {
            const double *y = x + 3 * i;
            const double *a = force + 3 * i;
            for (int k = 0; k < 3; ++k) {
                sum[k] += a[k];
                moment[k] += y[(k + 1) % 3] * a[(k + 2) % 3] - y[(k + 2) % 3] * a[(k + 1) % 3];
            }
        }
        const double zigzag = largest_of(force, 3 * n);
        assert_true(zigzag > 10.0);                              /* c0^2 / spacing^2 * 1e-3 m is of order 100 m/s2 */
        assert_true(linear < 1e-11 * zigzag);                    /* rounding of positions of order 5 m */
        assert_true(mor_vector_length(sum) < 1e-11 * zigzag);    /* opposite pairs */
        assert_true(mor_vector_length(moment) < 1e-11 * zigzag); /* the energy does not change in a turn */
        elastic_close(&with);
        elastic_close(&without);
    }
}

/* The force is the slope of the energy: what a push of one particle changes. */
static void test_hourglass_force_is_the_slope_of_its_energy(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        elastic_request request = request_of(dimension);
        elastic_bodies it;
        elastic_bodies without;
        double energies[2][2];
        static double force[3 * 2000];
        elastic_open(&without, &request);
        request.settings.hourglass = 0.5;
        elastic_open(&it, &request);
        const mor_set *set = &it.elastic.group.set;
        double *x = set->data[MOR_FIELD_POSITION];
        const double push = 1e-4;
        for (int64_t k = 0; k < 3 * set->n_particles; ++k) {
            x[k] += k % 3 < dimension ? 1e-3 * mor_random_uniform(2, (uint64_t)k, 0) : 0.0;
        }
        for (int k = 0; k < 3; ++k) {
            static const double steps[3] = {1.0, -2.0, 1.0};
            x[3 * 17 + 1] += steps[k] * push;
            memcpy(without.elastic.group.set.data[MOR_FIELD_POSITION], x, 3 * (size_t)set->n_particles * sizeof *x);
            fit_gradients(&it);
            fit_gradients(&without);
            for (int w = 0; w < 2 && k < 2; ++w) {
                energies[k][w] = mor_elastic_energy(w == 0 ? &it.elastic : &without.elastic, 0);
            }
        }
        find_hourglass(&it, &without, force);
        const double slope = (energies[0][0] - energies[0][1] - energies[1][0] + energies[1][1]) / (2.0 * push);
        const double expected = -set->data[MOR_FIELD_MASS][17] * force[3 * 17 + 1];
        print_message("%dD: force %g N, slope %g N\n", dimension, expected, slope);
        assert_true(fabs(expected) > 1e-3);                          /* N, and not a zero by chance */
        assert_true(fabs(slope - expected) < 1e-6 * fabs(expected)); /* rounding: the energy is quadratic */
        assert_true(energies[0][0] > energies[0][1]);
        elastic_close(&it);
        elastic_close(&without);
    }
}

static void test_held_particles_do_not_move_and_the_rest_does(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    elastic_open(&it, &request);
    mor_body_group *group = &it.elastic.group;
    const int64_t n = group->set.n_particles;
    for (int64_t i = 0; i < n; ++i) {
        it.elastic.held[i] = i % 3 == 0;
    }
    group->gravity[1] = -9.81;
    set_linear_velocity(&it, gradients[1]);
    elastic_steps(&it, 20);
    for (int64_t i = 0; i < n; ++i) {
        const int is_still =
            memcmp(group->set.data[MOR_FIELD_POSITION] + 3 * i, group->reference + 3 * i, 3 * sizeof(double)) == 0;
        assert_int_equal(is_still, it.elastic.held[i]);
    }
    elastic_close(&it);
}

static void test_impulses_are_the_integrals_of_the_forces(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    double p[3];
    double l[3];
    elastic_open(&it, &request);
    mor_body_group *group = &it.elastic.group;
    for (int64_t i = 0; i < group->bodies[0].n_particles; ++i) {
        group->boundary.force[3 * i] = 2.0;
        group->contact_force[3 * i + 1] = -3.0;
    }
    elastic_steps(&it, 12);
    const double time = mor_schedule_time(&it.schedule);
    const double n = (double)group->bodies[0].n_particles;
    mor_body_group_momentum(group, 0, p, l);
    assert_near(group->bodies[0].soil_impulse[0], 2.0 * n * time, 1e-12 * n * time);     /* rounding of the sums */
    assert_near(group->bodies[0].contact_impulse[1], -3.0 * n * time, 1e-12 * n * time); /* likewise */
    assert_near(p[0], 2.0 * n * time, 1e-11 * n * time);  /* forces within the body cancel to rounding */
    assert_near(p[1], -3.0 * n * time, 1e-11 * n * time); /* likewise */
    assert_true(group->bodies[1].soil_impulse[0] == 0.0);
    elastic_close(&it);
}

static void test_free_fall_is_exact_and_gravity_grows_over_its_ramp(void **state)
{
    (void)state;
    const elastic_request request = request_of(2);
    elastic_bodies it;
    elastic_open(&it, &request);
    mor_body_group *group = &it.elastic.group;
    group->gravity[0] = 4.0;
    group->gravity_ramp = 0.02;
    elastic_run(&it, 0.02);
    mor_body_group_observe(&it.context, group, 0.0);
    assert_near(group->bodies[0].velocity[0], 0.04, 1e-12); /* midpoint rule is exact for a ramp: g ramp / 2 */
    elastic_run(&it, 0.05);
    assert_near(group->bodies[0].velocity[0], 0.04 + 0.12, 1e-12); /* rounding */
    assert_near(mor_elastic_energy(&it.elastic, -1), 0.0, 1e-12);  /* no strain in free fall: rounding, J/m */
    elastic_close(&it);
}

static void test_step_is_that_of_the_source_or_what_else_limits_it(void **state)
{
    (void)state;
    elastic_request request = request_of(3);
    elastic_bodies it;
    double step = 0.0;
    const char *limit = "";
    elastic_open(&it, &request);
    const mor_stepper *s = &it.stepper;
    elastic_require(&it, s->operations->propose(&it.context, s->owner, &step, &limit));
    const double c0 = sqrt(1e6 / (3.0 * 0.4) / 1000.0);
    assert_near(step, 0.4 * 0.115 / c0, 1e-14); /* eq. 52 at rest: rounding */
    it.elastic.largest_acceleration = 1e6;
    elastic_require(&it, s->operations->propose(&it.context, s->owner, &step, &limit));
    assert_near(step, 0.4 * sqrt(0.115 / 1e6), 1e-14); /* its second part: rounding */
    assert_string_equal(limit, "the acceleration of the bodies");
    it.elastic.group.damping = 1e5;
    elastic_require(&it, s->operations->propose(&it.context, s->owner, &step, &limit));
    assert_near(step, 0.5e-5, 1e-18); /* half a decay time: rounding */
    elastic_close(&it);
}

static void test_steps_allocate_nothing(void **state)
{
    (void)state;
    elastic_request request = request_of(3);
    request.settings.hourglass = 0.1;
    elastic_bodies it;
    elastic_open(&it, &request);
    const uint64_t before = it.context.n_allocations;
    elastic_steps(&it, 3);
    assert_true(it.context.n_allocations == before);
    elastic_close(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gradient_of_a_linear_field_is_exact_at_surfaces_and_corners),
        cmocka_unit_test(test_uniform_stress_makes_no_force_inside_and_none_in_sum),
        cmocka_unit_test(test_stress_of_the_set_is_hookes_for_small_strain),
        cmocka_unit_test(test_hourglass_control_sees_what_a_linear_map_does_not),
        cmocka_unit_test(test_hourglass_force_is_the_slope_of_its_energy),
        cmocka_unit_test(test_held_particles_do_not_move_and_the_rest_does),
        cmocka_unit_test(test_impulses_are_the_integrals_of_the_forces),
        cmocka_unit_test(test_free_fall_is_exact_and_gravity_grows_over_its_ramp),
        cmocka_unit_test(test_step_is_that_of_the_source_or_what_else_limits_it),
        cmocka_unit_test(test_steps_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
