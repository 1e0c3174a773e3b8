/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/elastic_bodies.h"

static const mor_scheme undamped = {
    .body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 0.0, .hourglass = 0.0};

/* A tumbling box, or a spinning plate, far from the origin and stretched by its spin. */
static elastic_request tumbler(int dimension, const elastic_piece *piece)
{
    return (elastic_request){.dimension = dimension,
                             .spacing = 0.1,
                             .pieces = piece,
                             .n_pieces = 1,
                             .youngs = 1e6,
                             .poisson = 0.3,
                             .density = 1000.0,
                             .settings = undamped,
                             .end = 1000.0};
}

static const elastic_piece brick = {.side = {0.4, 0.6, 0.8},
                                    .axis = {0.6, 0.0, 0.8},
                                    .angle = 1.1,
                                    .middle = {2.0, -1.0, 3.0},
                                    .velocity = {0.5, 1.0, -0.2},
                                    .angular_velocity = {3.0, 2.0, -4.0}};
static const elastic_piece plate = {.side = {1.0, 0.6},
                                    .axis = {0.0, 0.0, 1.0},
                                    .angle = 0.7,
                                    .middle = {2.0, -1.0},
                                    .velocity = {0.5, 1.0},
                                    .angular_velocity = {0.0, 0.0, 6.0}};

static void tumble(int dimension, const elastic_piece *piece, double hourglass, double turns)
{
    elastic_request request = tumbler(dimension, piece);
    request.settings.hourglass = hourglass;
    elastic_bodies it;
    double p0[3];
    double l0[3];
    double p[3];
    double l[3];
    elastic_open(&it, &request);
    const double rate = mor_vector_length(piece->angular_velocity);
    const double kinetic = elastic_momenta(&it, p0, l0);
    elastic_run(&it, 2.0 * MOR_PI * turns / rate);
    const double total = elastic_momenta(&it, p, l) + mor_elastic_energy(&it.elastic, -1);
    double drift_p = 0.0;
    double drift_l = 0.0;
    for (int a = 0; a < 3; ++a) {
        drift_p = fmax(drift_p, fabs(p[a] - p0[a]) / mor_vector_length(p0));
        drift_l = fmax(drift_l, fabs(l[a] - l0[a]) / mor_vector_length(l0));
    }
    print_message("%dD, hourglass %g: %llu steps, drift of momentum %.1e, of angular momentum %.1e, of energy %.1e\n",
                  dimension, hourglass, (unsigned long long)it.schedule.n_steps, drift_p, drift_l,
                  fabs(total - kinetic) / kinetic);
    assert_true(drift_p < 1e-12); /* pair forces are exactly opposite: rounding alone */
    assert_true(drift_l < 1e-10); /* stress is conjugate to F and F the exact gradient: rounding alone */
    assert_true(fabs(total - kinetic) < 1e-3 * kinetic); /* order (omega dt)^2 of the vibration the spin starts */
    elastic_close(&it);
}

static void test_free_body_keeps_momenta_and_energy_over_twenty_turns(void **state)
{
    (void)state;
    tumble(2, &plate, 0.0, 20.0);
    tumble(3, &brick, 0.0, 20.0);
}

static void test_hourglass_control_keeps_momenta(void **state)
{
    (void)state;
    tumble(2, &plate, 0.1, 2.0);
    tumble(3, &brick, 0.1, 2.0);
}

/* Vibrating and tumbling with the damper on: what is lost shows in damped_energy. */
static void test_damping_only_takes_energy(void **state)
{
    (void)state;
    elastic_request request = tumbler(3, &brick);
    request.settings.body_damping = 1.0;
    elastic_bodies it;
    elastic_open(&it, &request);
    double *v = it.elastic.group.set.data[MOR_FIELD_VELOCITY];
    for (int64_t i = 0; i < it.elastic.group.set.n_particles; ++i) {
        v[3 * i] += 2.0 * sin(7.0 * it.elastic.group.reference[3 * i + 2]);
    }
    elastic_require(&it, mor_elastic_prepare(&it.context, &it.elastic));
    double p[3];
    double l[3];
    const double first = elastic_momenta(&it, p, l) + mor_elastic_energy(&it.elastic, -1);
    double before = first;
    double growth = 0.0;
    for (int k = 0; k < 40; ++k) {
        elastic_steps(&it, 10);
        const double now = elastic_momenta(&it, p, l) + mor_elastic_energy(&it.elastic, -1);
        growth = fmax(growth, now - before);
        before = now;
    }
    const double balance = (before + it.elastic.damped_energy) / first - 1.0;
    print_message("damped: energy %.4f of the first, growth %.1e, balance %.1e\n", before / first, growth / first,
                  balance);
    assert_true(before < 0.99 * first); /* the damper works */
    assert_true(growth < 1e-4 * first); /* the kinetic energy is seen half a step off the strain energy */
    assert_true(fabs(balance) < 0.02);  /* the power lost is taken at the start of each step */
    elastic_close(&it);
}

static const elastic_piece pair[2] = {{.is_ball = true,
                                       .side = {0.8, 0.8, 0.8},
                                       .axis = {0.0, 0.6, 0.8},
                                       .angle = 0.5,
                                       .velocity = {1.0, 0.0, 0.5},
                                       .angular_velocity = {3.0, 20.0, 5.0}},
                                      {.side = {0.5, 0.7, 1.3},
                                       .middle = {0.75, 0.0, 0.0},
                                       .velocity = {-1.0, 0.3, 0.0},
                                       .angular_velocity = {0.0, 15.0, 9.0}}};

static uint64_t checksum_after(const elastic_request *request, int n_steps, int n_threads)
{
    elastic_bodies it;
    elastic_request own = *request;
    own.n_threads = n_threads;
    elastic_open(&it, &own);
    elastic_steps(&it, n_steps);
    const uint64_t sum = mor_set_checksum(&it.elastic.group.set);
    elastic_close(&it);
    return sum;
}

static void test_any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    elastic_request request = tumbler(3, pair);
    request.n_pieces = 2;
    request.spacing = 0.05; /* enough particles for a team */
    request.jitter = 0.2;
    request.settings =
        (mor_scheme){.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.05};
    const uint64_t expected = checksum_after(&request, 10, 1);
    for (int n_threads = 2; n_threads <= 3; ++n_threads) {
        assert_true(checksum_after(&request, 10, n_threads) == expected);
    }
}

/* The same body in units in which every length is 4 times, every time 16 times and every mass 64 times the number. */
static void test_units_changed_by_powers_of_two_change_no_bit(void **state)
{
    (void)state;
    enum { STEPS = 20 };
    const double length = 4.0;
    const double time = 16.0;
    const double mass = 64.0;
    elastic_piece scaled = brick;
    elastic_request request = tumbler(3, &brick);
    request.jitter = 0.2;
    request.settings =
        (mor_scheme){.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.05};
    elastic_request other = request;
    other.pieces = &scaled;
    other.spacing *= length;
    other.youngs *= mass / length / (time * time);
    other.density *= mass / (length * length * length);
    other.end *= time;
    for (int a = 0; a < 3; ++a) {
        scaled.side[a] *= length;
        scaled.middle[a] *= length;
        scaled.velocity[a] *= length / time;
        scaled.angular_velocity[a] /= time;
    }
    elastic_bodies one;
    elastic_bodies two;
    elastic_open(&one, &request);
    elastic_open(&two, &other);
    elastic_steps(&one, STEPS);
    elastic_steps(&two, STEPS);
    const mor_set *a = &one.elastic.group.set;
    const mor_set *b = &two.elastic.group.set;
    for (int64_t k = 0; k < 3 * a->n_particles; ++k) {
        assert_true(a->data[MOR_FIELD_POSITION][k] * length == b->data[MOR_FIELD_POSITION][k]);
        assert_true(a->data[MOR_FIELD_VELOCITY][k] * (length / time) == b->data[MOR_FIELD_VELOCITY][k]);
    }
    assert_true(one.elastic.group.bodies[0].rotation_angle[2] == two.elastic.group.bodies[0].rotation_angle[2]);
    elastic_close(&one);
    elastic_close(&two);
}

/* A body beside another within the reach of the kernel moves as it does alone. */
static void test_bodies_of_a_group_do_not_see_one_another(void **state)
{
    (void)state;
    elastic_request both = tumbler(3, pair);
    elastic_request alone = tumbler(3, pair);
    both.n_pieces = 2;
    elastic_bodies it;
    elastic_bodies first;
    elastic_open(&it, &both);
    elastic_open(&first, &alone);
    const mor_step step = {.length = 2e-4, .n_parts = 1};
    for (int k = 0; k < 50; ++k) {
        for (int s = 0; s < it.stepper.n_stages; ++s) {
            elastic_require(&it, mor_stepper_run_stage(&it.context, &it.stepper, s, &step));
            elastic_require(&first, mor_stepper_run_stage(&first.context, &first.stepper, s, &step));
        }
    }
    const int64_t n = first.elastic.group.set.n_particles;
    assert_memory_equal(it.elastic.group.set.data[MOR_FIELD_POSITION], first.elastic.group.set.data[MOR_FIELD_POSITION],
                        3 * (size_t)n * sizeof(double));
    elastic_close(&it);
    elastic_close(&first);
}

/* A run taken up again from the evolving fields and the few numbers beside them. */
static void test_resumed_body_goes_on_bit_by_bit(void **state)
{
    (void)state;
    elastic_request request = tumbler(3, &brick);
    request.settings =
        (mor_scheme){.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.05};
    elastic_bodies it;
    elastic_bodies other;
    elastic_open(&it, &request);
    elastic_open(&other, &request);
    elastic_steps(&it, 15);
    for (int field = 0; field < it.elastic.group.set.n_fields; ++field) {
        const mor_field_info *info = &it.elastic.group.set.fields[field];
        if (it.elastic.group.set.data[field] != NULL && (info->flags & MOR_FIELD_EVOLVES) != 0) {
            memcpy(other.elastic.group.set.data[field], it.elastic.group.set.data[field],
                   (size_t)(it.elastic.group.set.n_particles * info->n_components) * sizeof(double));
        }
    }
    other.elastic.largest_acceleration = it.elastic.largest_acceleration;
    other.schedule.now = it.schedule.now;
    other.schedule.n_steps = it.schedule.n_steps;
    elastic_require(&other, mor_elastic_prepare(&other.context, &other.elastic));
    elastic_steps(&it, 15);
    elastic_steps(&other, 15);
    assert_true(mor_set_checksum(&it.elastic.group.set) == mor_set_checksum(&other.elastic.group.set));
    assert_memory_equal(it.elastic.group.bodies[0].rotation, other.elastic.group.bodies[0].rotation,
                        9 * sizeof(double));
    elastic_close(&it);
    elastic_close(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_body_keeps_momenta_and_energy_over_twenty_turns),
        cmocka_unit_test(test_hourglass_control_keeps_momenta),
        cmocka_unit_test(test_damping_only_takes_energy),
        cmocka_unit_test(test_any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(test_units_changed_by_powers_of_two_change_no_bit),
        cmocka_unit_test(test_bodies_of_a_group_do_not_see_one_another),
        cmocka_unit_test(test_resumed_body_goes_on_bit_by_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
