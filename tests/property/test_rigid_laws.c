/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/rigid_bodies.h"

#define SPACING 0.125

enum { TURNS = 20, STEPS_PER_TURN = 200 };

/* A box of sides 1 : 2 : 3 that turns about its middle axis, a little disturbed: it tumbles over and over. */
static rigid_box tumbling_box(double disturbance)
{
    return (rigid_box){.sides = {2, 4, 6}, .density = 2600.0, .spin = {disturbance, 2.0 * MOR_PI, 0.5 * disturbance}};
}

/* The way a body point may go in a sub-step would limit it here; the leader's step is wanted. */
static rigid_scene *open_free(const rigid_box *box, double steps_per_turn, double end)
{
    rigid_scene *it = rigid_open(box, 1, 3, SPACING, 1.0 / steps_per_turn, end);
    it->rigid.group.spacing *= 1024.0;
    return it;
}

static double find_drift(double steps_per_turn, double disturbance, double *tumbled)
{
    const rigid_box box = tumbling_box(disturbance);
    double momentum[3];
    double before[3];
    double after[3];
    double worst = 0.0;
    rigid_scene *it = open_free(&box, steps_per_turn, TURNS);
    const double energy = mor_rigid_energy(&it->rigid, 0, momentum, before);
    *tumbled = 1.0;
    while (it->schedule.now < it->schedule.end) {
        assert_int_equal(mor_schedule_step(&it->context, &it->schedule, it->schedule.end), MOR_OK);
        assert_int_equal(it->schedule.substeps[1], 1);
        worst = fmax(worst, fabs(mor_rigid_energy(&it->rigid, 0, momentum, after) / energy - 1.0));
        assert_memory_equal(after, before, sizeof before); /* exact: nothing touches the angular momentum */
        const double *q = it->rigid.states[0].quaternion;
        const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        assert_true(fabs(square - 1.0) <= 1e-15); /* rounding of one division, never of many steps */
        *tumbled = fmin(*tumbled, it->rigid.group.bodies[0].rotation[4]);
    }
    rigid_close(it);
    return worst;
}

static void tumbling_body_keeps_energy_and_angular_momentum(void **state)
{
    (void)state;
    double tumbled = 0.0;
    const double drift = find_drift(STEPS_PER_TURN, 0.1, &tumbled);
    print_message("  energy within %.2g over %d turns of %d steps\n", drift, TURNS, STEPS_PER_TURN);
    assert_true(tumbled < -0.9); /* the middle axis did turn over */
    assert_true(drift < 1e-8);   /* required; fourth order gives about 1e-10 */
}

static void energy_error_is_of_fourth_order_and_stays_bounded(void **state)
{
    (void)state;
    double tumbled = 0.0;
    const double coarse = find_drift(25.0, 1.0, &tumbled);
    const double fine = find_drift(50.0, 1.0, &tumbled);
    print_message("  energy within %.2g at 25 steps a turn, %.2g at 50\n", coarse, fine);
    assert_true(coarse < 1e-5);        /* bounded: no secular part even at 25 steps a turn */
    assert_true(fine < coarse / 11.0); /* 2^3.5: fourth order, not third */
}

/* Euler's equations for the angular momentum in the frame of the body, m' = m x (m / I). */
static void find_rate(const double *inertia, const double *m, double *rate)
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        rate[a] = m[b] * m[c] / inertia[c] - m[c] * m[b] / inertia[b];
    }
}

static void rotation_follows_the_equations_of_euler(void **state)
{
    (void)state;
    enum { FINE_STEPS = 20000 };
    static const double places[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weights[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    const rigid_box box = tumbling_box(1.0);
    const double h = 5.0 / FINE_STEPS;
    rigid_scene *it = open_free(&box, STEPS_PER_TURN, 5.0);
    const mor_body *body = &it->rigid.group.bodies[0];
    double inertia[3];
    double m[3];
    double found[3];
    for (int a = 0; a < 3; ++a) {
        inertia[a] = body->density * body->geometry.inertia[a];
        m[a] = inertia[a] * box.spin[a];
    }
    for (int step = 0; step < FINE_STEPS; ++step) {
        double rate[3] = {0.0};
        double sum[3] = {m[0], m[1], m[2]};
        for (int k = 0; k < 4; ++k) {
            const double at[3] = {m[0] + places[k] * h * rate[0], m[1] + places[k] * h * rate[1],
                                  m[2] + places[k] * h * rate[2]};
            find_rate(inertia, at, rate);
            for (int a = 0; a < 3; ++a) {
                sum[a] += weights[k] * h * rate[a];
            }
        }
        memcpy(m, sum, sizeof m);
    }
    rigid_run(it, 5.0);
    mor_matrix_apply_transposed(body->rotation, it->rigid.states[0].angular_momentum, found);
    for (int a = 0; a < 3; ++a) {
        /* both of fourth order: (2 pi / 20000)^4 = 1e-14 a step here, (pi / 200)^4 / 1000 = 1e-10 there */
        assert_true(fabs(found[a] - m[a]) < 1e-8 * mor_vector_length(m));
    }
    rigid_close(it);
}

/* The same path backwards: a body whose angular momentum is reversed returns to where it came from. */
static void rotation_is_reversible_in_time(void **state)
{
    (void)state;
    const rigid_box box = tumbling_box(1.0);
    rigid_scene *it = open_free(&box, 40.0, 10.0);
    rigid_run(it, 5.0);
    assert_true(fabs(it->rigid.states[0].quaternion[0]) < 0.99); /* somewhere else */
    for (int a = 0; a < 3; ++a) {
        it->rigid.states[0].angular_momentum[a] *= -1.0;
    }
    rigid_run(it, 10.0);
    assert_true(fabs(fabs(it->rigid.states[0].quaternion[0]) - 1.0) < 1e-12); /* rounding, growing along the path */
    for (int k = 1; k < 4; ++k) {
        assert_true(fabs(it->rigid.states[0].quaternion[k]) < 1e-10); /* likewise */
    }
    rigid_close(it);
}

/* Bodies of all kinds together: free, on a spring, locked, prescribed. */
static void fill_boxes(rigid_box *boxes, int dimension)
{
    for (int b = 0; b < RIGID_BODIES; ++b) {
        const uint64_t id = (uint64_t)b;
        boxes[b] =
            (rigid_box){.sides = {5 + 2 * b, 12, 9}, .place = {30.0 * b, 3.0 * b, 0.0}, .density = 1000.0 + 300.0 * b};
        for (int a = 0; a < 3; ++a) {
            boxes[b].velocity[a] = a < dimension ? cloud_number(id, 10 + (uint64_t)a, -1.0, 1.0) : 0.0;
            boxes[b].spin[a] = a == 2 || dimension == 3 ? cloud_number(id, 20 + (uint64_t)a, -3.0, 3.0) : 0.0;
        }
    }
    boxes[1].motion = (mor_rigid_motion){.has_spring = true,
                                         .spring_point = {31.0, 5.0, 0.0},
                                         .spring_anchor = {35.0, 12.0, dimension == 3 ? 3.0 : 0.0},
                                         .spring_length = 7.0,
                                         .spring_stiffness = 9000.0,
                                         .spring_damping = 40.0};
    boxes[2].motion.locked = 1u << 1 | 1u << 3;
    boxes[3].motion =
        (mor_rigid_motion){.is_prescribed = true, .velocity = {0.2, -0.3, 0.0}, .angular_velocity = {0.0, 0.0, 1.7}};
}

static rigid_scene *run_boxes(int dimension, int n_threads, const rigid_units *units)
{
    rigid_box boxes[RIGID_BODIES];
    fill_boxes(boxes, dimension);
    rigid_scene *it = rigid_open_in(boxes, RIGID_BODIES, dimension, SPACING, 0.02, 1.0, units);
    it->context.n_threads = n_threads;
    it->rigid.group.gravity[1] = -9.81 * units->length / (units->time * units->time);
    it->rigid.group.gravity_ramp = 0.3 * units->time;
    it->rigid.group.damping = 0.25 / units->time;
    it->pushed = 7;
    for (int a = 0; a < dimension; ++a) {
        it->push[a] =
            (100.0 - 70.0 * a) * rigid_mass_unit(units, dimension) * units->length / (units->time * units->time);
    }
    rigid_run(it, units->time);
    return it;
}

static void bits_do_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    const rigid_units units = {1.0, 1.0, 1.0};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        rigid_scene *one = run_boxes(dimension, 1, &units);
        assert_true(dimension == 2 || one->rigid.group.n_pieces > RIGID_BODIES); /* bodies of more than one piece */
        for (int n_threads = 2; n_threads <= 3; ++n_threads) {
            rigid_scene *more = run_boxes(dimension, n_threads, &units);
            assert_memory_equal(more->rigid.states, one->rigid.states, RIGID_BODIES * sizeof *one->rigid.states);
            /* exact: bits */
            assert_true(mor_set_checksum(&more->rigid.group.set) == mor_set_checksum(&one->rigid.group.set));
            rigid_close(more);
        }
        rigid_close(one);
    }
}

/* Compares n numbers after the change of their unit. */
static void assert_scaled(const double *scaled, const double *plain, int n, double unit)
{
    for (int k = 0; k < n; ++k) {
        assert_true(scaled[k] == unit * plain[k]); /* exact: a power of two */
    }
}

static void units_by_powers_of_two_change_no_bit(void **state)
{
    (void)state;
    const rigid_units plain_units = {1.0, 1.0, 1.0};
    static const rigid_units changes[] = {{64.0, 4.0, 16.0}, {0.25, 16.0, 0.0625}};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        rigid_scene *plain = run_boxes(dimension, 1, &plain_units);
        for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
            const rigid_units units = changes[k];
            rigid_scene *scaled = run_boxes(dimension, 1, &units);
            const double mass = rigid_mass_unit(&units, dimension);
            assert_true(scaled->schedule.n_steps == plain->schedule.n_steps); /* exact: a count */
            for (int b = 0; b < RIGID_BODIES; ++b) {
                const mor_rigid_state *p = &plain->rigid.states[b];
                const mor_rigid_state *s = &scaled->rigid.states[b];
                const double speed = units.length / units.time;
                assert_scaled(s->center, p->center, 3, units.length);
                assert_scaled(s->velocity, p->velocity, 3, speed);
                assert_scaled(s->quaternion, p->quaternion, 4, 1.0);
                assert_scaled(s->rotation_angle, p->rotation_angle, 3, 1.0);
                assert_scaled(s->angular_momentum, p->angular_momentum, 3, mass * units.length * speed);
                assert_scaled(s->soil_impulse, p->soil_impulse, 3, mass * speed);
            }
            rigid_close(scaled);
        }
        rigid_close(plain);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tumbling_body_keeps_energy_and_angular_momentum),
        cmocka_unit_test(energy_error_is_of_fourth_order_and_stays_bounded),
        cmocka_unit_test(rotation_follows_the_equations_of_euler),
        cmocka_unit_test(rotation_is_reversible_in_time),
        cmocka_unit_test(bits_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(units_by_powers_of_two_change_no_bit),
    };
    return CLOUD_RUN(tests);
}
