/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/rigid/rigid_internal.h"
#include "tests/common/rigid_bodies.h"

#include <float.h>

#define SPACING 0.125

static const mor_body *first_body(const rigid_scene *it)
{
    return &it->rigid.group.bodies[0];
}

static void assert_near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g, expected %.17g, off by %.3g, allowed %.3g", found, expected, found - expected, tolerance);
    }
}

static void projectile_follows_its_parabola(void **state)
{
    (void)state;
    const rigid_box box = {
        .sides = {4, 3, 2}, .place = {1.0, 2.0, 3.0}, .density = 2500.0, .velocity = {3.0, 0.0, 5.0}, .spin = {1.0}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 1.0);
    const double gravity[3] = {0.5, -1.0, -9.81};
    memcpy(it->rigid.group.gravity, gravity, sizeof gravity);
    rigid_run(it, 1.0);
    for (int a = 0; a < 3; ++a) {
        const double place = SPACING * box.place[a] + box.velocity[a] + 0.5 * gravity[a];
        assert_near(first_body(it)->center[a], place, 1e-13 * 5.0); /* rounding of some hundred sub-steps */
        assert_near(first_body(it)->velocity[a], box.velocity[a] + gravity[a], 1e-13 * 10.0); /* likewise */
    }
    assert_true(it->schedule.substeps[1] > 1); /* the way in a step is limited, so there were sub-steps */
    rigid_close(it);
}

static void gravity_grows_over_its_ramp(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {2, 2, 2}, .density = 1000.0};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 1.0);
    it->rigid.group.gravity[1] = -2.0;
    it->rigid.group.gravity_ramp = 0.5;
    rigid_run(it, 0.5);
    assert_near(first_body(it)->velocity[1], -0.5, 1e-12); /* the middle of a step is exact for a linear ramp */
    rigid_run(it, 1.0);
    assert_near(first_body(it)->velocity[1], -1.5, 1e-12); /* likewise */
    rigid_close(it);
}

/* Two equal moments: the axis precesses about the angular momentum at L / I1, and the body turns about its axis at
 * (1/I3 - 1/I1) L3 besides. */
static void symmetric_top_precesses_as_in_closed_form(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {4, 4, 2}, .density = 2000.0, .spin = {1.5, 0.7, 4.0}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 2.0);
    const double side = 4 * SPACING;
    const double high = 2 * SPACING;
    const double mass = 2000.0 * side * side * high;
    const double across = mass * (side * side + high * high) / 12.0;
    const double along = mass * side * side / 6.0;
    const double momentum[3] = {across * 1.5, across * 0.7, along * 4.0};
    const double size = mor_vector_length(momentum);
    const double direction[3] = {momentum[0] / size, momentum[1] / size, momentum[2] / size};
    double precession[9];
    double own[9];
    const double axis[3] = {0.0, 0.0, 1.0};
    rigid_run(it, 2.0);
    mor_matrix_rotation(direction, 2.0 * size / across, precession);
    mor_matrix_rotation(axis, 2.0 * (1.0 / along - 1.0 / across) * momentum[2], own);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double column[3] = {own[b], own[3 + b], own[6 + b]};
            const double exact = mor_vector_dot(precession + 3 * a, column);
            assert_near(first_body(it)->rotation[3 * a + b], exact,
                        1e-10); /* inertia to 1e-12, over 10 rad; rounding */
        }
    }
    for (int a = 0; a < 3; ++a) {
        assert_near(it->rigid.states[0].angular_momentum[a], momentum[a], 1e-12 * size); /* inertia of the shape */
    }
    rigid_close(it);
}

/* A box on a spring of rest length 4 spacings whose anchor lies on the x axis. */
static rigid_box spring_box(double stiffness, double damping)
{
    return (rigid_box){.sides = {2, 2, 2},
                       .density = 1024.0, /* 16 kg */
                       .motion = {.has_spring = true,
                                  .spring_anchor = {-4.4, 0.0, 0.0},
                                  .spring_length = 4.0,
                                  .spring_stiffness = stiffness,
                                  .spring_damping = damping}};
}

/* Time of the n-th crossing of the rest position, and the largest way out after it. */
static double find_crossing(rigid_scene *it, int n, double step, double *largest)
{
    const double rest = -0.4 * SPACING;
    double before = first_body(it)->center[0] - rest;
    double found = 0.0;
    *largest = 0.0;
    for (int k = 1; n >= 0; ++k) {
        rigid_run(it, k * step);
        const double after = first_body(it)->center[0] - rest;
        if ((before > 0.0) != (after > 0.0)) {
            n -= 1;
            if (n == 0) {
                found = step * (k - after / (after - before));
            }
        }
        *largest = n == 0 ? fmax(*largest, fabs(after)) : *largest;
        before = after;
    }
    return found;
}

static void spring_swings_with_its_period(void **state)
{
    (void)state;
    const double period = 2.0 * MOR_PI * sqrt(16.0 / 400.0);
    const rigid_box box = spring_box(400.0, 0.0);
    double largest = 0.0;
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, period / 200.0, 4.0 * period);
    const double crossing = find_crossing(it, 5, period / 200.0, &largest);
    assert_near(crossing / period, 2.25, 2e-4);        /* the scheme is fast by (w h)^2/24 = 4e-5; interpolation */
    assert_near(largest / (0.4 * SPACING), 1.0, 3e-4); /* samples near the turning point miss (pi/200)^2/2 = 1.2e-4 */
    rigid_close(it);
}

static void damper_damps_with_its_ratio(void **state)
{
    (void)state;
    const double rate = sqrt(400.0 / 16.0);
    const double ratio = 0.05;
    const rigid_box box = spring_box(400.0, 2.0 * ratio * 16.0 * rate);
    const double period = 2.0 * MOR_PI / (rate * sqrt(1.0 - ratio * ratio));
    double first = 0.0;
    double second = 0.0;
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, period / 400.0, 6.0 * period);
    find_crossing(it, 1, period / 400.0, &first);
    rigid_close(it);
    it = rigid_open(&box, 1, 3, SPACING, period / 400.0, 6.0 * period);
    find_crossing(it, 5, period / 400.0, &second); /* two periods later */
    const double decrement = 2.0 * 2.0 * MOR_PI * ratio / sqrt(1.0 - ratio * ratio);
    assert_near(log(first / second) / decrement, 1.0, 1e-3); /* second order: (w h)^2 = 2.5e-4, and sampling */
    rigid_close(it);
}

/* However strong the damper, the mean of the velocities before and after is what it acts on. */
static void damper_of_any_strength_never_pushes_back(void **state)
{
    (void)state;
    rigid_box box = spring_box(0.0, 1e9);
    box.velocity[0] = 1.0;
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.001, 0.1);
    rigid_run(it, 0.1);
    assert_true(fabs(first_body(it)->velocity[0]) <= 1.0 + 1e-9); /* rounding of the quotient */
    rigid_close(it);
}

static void prescribed_motion_is_exact_and_counts_impulses(void **state)
{
    (void)state;
    const rigid_box box = {
        .sides = {2, 2, 2},
        .place = {0.5, 0.0, 0.0},
        .density = 1000.0,
        .motion = {.is_prescribed = true, .velocity = {0.3, -0.1, 0.7}, .angular_velocity = {0.2, 0.4, -0.4}}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.013, 3.0);
    it->rigid.group.gravity[2] = -10.0;
    it->rigid.group.damping = 1.0;
    it->pushed = 0;
    it->push[1] = 5.0;
    rigid_run(it, 3.0);
    double rotation[9];
    const double axis[3] = {0.2 / 0.6, 0.4 / 0.6, -0.4 / 0.6};
    mor_matrix_rotation(axis, 1.8, rotation);
    assert_true(first_body(it)->is_held);
    for (int a = 0; a < 3; ++a) {
        /* exact: a function of the time */
        assert_true(first_body(it)->center[a] == first_body(it)->geometry.center[a] + 3.0 * box.motion.velocity[a]);
        assert_true(first_body(it)->velocity[a] == box.motion.velocity[a]);                          /* exact: given */
        assert_near(first_body(it)->rotation_angle[a], 3.0 * box.motion.angular_velocity[a], 1e-15); /* rounding */
        for (int b = 0; b < 3; ++b) {
            assert_near(first_body(it)->rotation[3 * a + b], rotation[3 * a + b], 1e-15 * 4.0); /* rounding */
        }
    }
    assert_near(first_body(it)->soil_impulse[1], 15.0, 1e-13 * 15.0); /* rounding of some hundred sums */
    rigid_close(it);
}

static void locked_axes_do_not_move(void **state)
{
    (void)state;
    for (unsigned locked = 0; locked < 64; ++locked) {
        const rigid_box box = {.sides = {3, 2, 4},
                               .density = 500.0,
                               .velocity = {0.1, 0.2, 0.3},
                               .spin = {0.5, -0.4, 0.3},
                               .motion = {.locked = locked}};
        rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 0.1);
        it->rigid.group.gravity[0] = it->rigid.group.gravity[1] = it->rigid.group.gravity[2] = -3.0;
        it->pushed = 0;
        it->push[0] = 2.0;
        it->push[1] = -1.0;
        it->push[2] = 4.0;
        rigid_run(it, 0.1);
        const mor_body *body = first_body(it);
        for (int a = 0; a < 3; ++a) {
            if ((locked >> a & 1u) != 0) {
                assert_true(body->velocity[a] == 0.0);                    /* exact: taken out */
                assert_true(body->center[a] == body->geometry.center[a]); /* exact: likewise */
            } else {
                assert_near(body->velocity[a], box.velocity[a] - 0.3 + 0.1 * it->push[a] / body->mass, 1e-13); /* sum */
            }
            if ((locked >> (3 + a) & 1u) != 0) {
                assert_true(body->angular_velocity[a] == 0.0 && body->rotation_angle[a] == 0.0); /* exact: taken out */
            } else {
                assert_true(body->angular_velocity[a] != 0.0);
            }
        }
        assert_int_equal(body->is_held, locked == 63);
        rigid_close(it);
    }
}

/* Constraints do no work. */
static void turn_with_one_axis_locked_keeps_its_energy(void **state)
{
    (void)state;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const rigid_box box = {
            .sides = {1, 2, 3}, .density = 500.0, .spin = {3.0, 2.0, 2.5}, .motion = {.locked = 8u << axis}};
        rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 10.0);
        double momentum[3];
        double angular_momentum[3];
        const double before = mor_rigid_energy(&it->rigid, 0, momentum, angular_momentum);
        rigid_run(it, 10.0);
        const double after = mor_rigid_energy(&it->rigid, 0, momentum, angular_momentum);
        assert_near(after / before, 1.0, 1e-7); /* fourth order: (w h / 2)^4 = 2e-7 at w = 4.4, times 1/100 */
        rigid_close(it);
    }
}

/* The first step from rest: the angular momentum is moment times time, and the spin the true inertia's. */
static void force_on_a_point_turns_with_the_true_inertia(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {2, 3, 4}, .place = {7.0, -5.0, 3.0}, .density = 1000.0};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 1e-6, 1.0);
    const double sides[3] = {0.25, 0.375, 0.5};
    const double mass = 1000.0 * sides[0] * sides[1] * sides[2];
    it->pushed = 5;
    const double push[3] = {10.0, 20.0, -15.0};
    memcpy(it->push, push, sizeof push);
    const double *x = it->rigid.group.reference + 3 * it->pushed;
    double arm[3];
    for (int a = 0; a < 3; ++a) {
        arm[a] = x[a] - SPACING * box.place[a];
    }
    assert_int_equal(mor_schedule_step(&it->context, &it->schedule, it->schedule.end), MOR_OK);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        const double moment = arm[b] * push[c] - arm[c] * push[b];
        const double inertia = mass * (sides[b] * sides[b] + sides[c] * sides[c]) / 12.0;
        const double spin = it->schedule.step_length * moment / inertia;
        assert_near(first_body(it)->angular_velocity[a], spin, 1e-11 * 1e-5); /* inertia, arms far from the origin */
        assert_near(first_body(it)->velocity[a], it->schedule.step_length * push[a] / mass,
                    1e-13 * 1e-6); /* rounding */
    }
    rigid_close(it);
}

/* What the soil lost is what the body gets, though the force is held over sub-steps while the body moves. */
static void angular_momentum_given_is_received_at_any_rate(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {2, 3, 4},
                           .place = {1.0, 2.0, -1.0},
                           .density = 1000.0,
                           .velocity = {3.0, 1.0, 2.0},
                           .spin = {2.0, 3.0, 4.0}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.1, 1.0);
    double momentum[3];
    double before[3];
    double after[3];
    const double push[3] = {10.0, 20.0, -15.0};
    it->pushed = 3;
    memcpy(it->push, push, sizeof push);
    mor_rigid_energy(&it->rigid, 0, momentum, before);
    rigid_run(it, 1.0);
    mor_rigid_energy(&it->rigid, 0, momentum, after);
    assert_true(it->schedule.substeps[1] >= 7);
    for (int a = 0; a < 3; ++a) {
        assert_near(after[a] - before[a], it->given_moment[a], 1e-12 * 300.0); /* rounding, of about 300 N m s */
        assert_near(first_body(it)->soil_impulse[a], push[a], 1e-13 * 20.0);   /* 1 s; rounding */
    }
    rigid_close(it);
}

/* Contact writes force and moment in the exchange; here they stay. */
static void contact_moves_the_body_and_is_counted(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {4, 2, 1}, .density = 1000.0};
    rigid_scene *it = rigid_open(&box, 1, 2, SPACING, 0.01, 0.5);
    mor_body *body = it->rigid.group.bodies;
    body->contact_force[0] = 3.0;
    body->contact_moment[2] = 2.0;
    rigid_run(it, 0.5);
    const double inertia = 1000.0 * 0.5 * 0.25 * (0.25 + 0.0625) / 12.0;
    assert_near(body->velocity[0], 0.5 * 3.0 / (1000.0 * 0.125), 1e-13);     /* rounding */
    assert_near(body->angular_velocity[2], 0.5 * 2.0 / inertia, 1e-12);      /* rounding */
    assert_near(body->rotation_angle[2], 0.5 * 0.25 * 2.0 / inertia, 1e-12); /* rounding: constant acceleration */
    assert_near(body->rotation[3], sin(body->rotation_angle[2]), 1e-13);     /* rounding */
    assert_near(body->contact_impulse[0], 1.5, 1e-13);                       /* rounding */
    assert_true(body->center[2] == 0.0 && body->velocity[2] == 0.0);         /* exact: locked in the plane */
    assert_true(body->angular_velocity[0] == 0.0 && body->angular_velocity[1] == 0.0); /* exact: likewise */
    rigid_close(it);
}

static void damping_takes_velocity_and_spin_alike(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {3, 3, 3}, .density = 1000.0, .velocity = {1.0, 0.0, 0.0}, .spin = {0.0, 2.0, 0.0}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 1.0);
    it->rigid.group.damping = 2.0;
    rigid_run(it, 1.0);
    assert_near(first_body(it)->velocity[0] / exp(-2.0), 1.0, 1e-4);         /* second order: (d h)^3 / 12 a step */
    assert_near(first_body(it)->angular_velocity[1] / exp(-2.0), 2.0, 2e-4); /* likewise */
    rigid_close(it);
}

static void points_follow_their_body(void **state)
{
    (void)state;
    const rigid_box boxes[2] = {{.sides = {2, 3, 4},
                                 .place = {5.0, 1.0, 0.0},
                                 .density = 1000.0,
                                 .velocity = {1.0, 0.5, 0.2},
                                 .spin = {1.0, 2.0, 3.0}},
                                {.sides = {3, 2, 2},
                                 .place = {-5.0, 0.0, 2.0},
                                 .density = 700.0,
                                 .velocity = {-1.0, 0.0, 0.0},
                                 .spin = {0.0, 0.0, 5.0}}};
    rigid_scene *it = rigid_open(boxes, 2, 3, SPACING, 0.01, 1.0);
    rigid_run(it, 0.5);
    const mor_body_group *group = &it->rigid.group;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        const mor_body *body = &group->bodies[group->body_of[i]];
        const double *x = group->set.data[MOR_FIELD_POSITION] + 3 * i;
        const double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        const double *w = body->angular_velocity;
        double arm[3];
        double turned[3];
        for (int a = 0; a < 3; ++a) {
            arm[a] = group->reference[3 * i + a] - body->geometry.center[a];
        }
        mor_matrix_apply(body->rotation, arm, turned);
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            assert_near(x[a], body->center[a] + turned[a], 1e-15 * 4.0);                       /* rounding */
            assert_near(v[a], body->velocity[a] + w[b] * turned[c] - w[c] * turned[b], 1e-14); /* rounding */
        }
        assert_true(group->set.data[MOR_FIELD_DENSITY][i] == body->density); /* exact: never written */
        assert_true(mor_vector_length(v) <= group->boundary.largest_speed);
    }
    rigid_close(it);
}

/* A run that is stopped and continued from its states and its boundary is the same run. */
static void states_are_all_that_a_resume_needs(void **state)
{
    (void)state;
    rigid_box box = spring_box(300.0, 2.0);
    box.spin[0] = 3.0;
    box.spin[1] = 2.0;
    box.motion.spring_point[1] = 1.0;
    rigid_scene *whole = rigid_open(&box, 1, 3, SPACING, 0.01, 1.0);
    rigid_scene *resumed = rigid_open(&box, 1, 3, SPACING, 0.01, 1.0);
    rigid_run(whole, 0.5);
    memcpy(resumed->rigid.states, whole->rigid.states, sizeof *whole->rigid.states);
    resumed->schedule.now = whole->schedule.now;
    resumed->schedule.n_steps = whole->schedule.n_steps;
    mor_rigid_prepare(&resumed->context, &resumed->rigid);
    assert_true(mor_set_checksum(&resumed->rigid.group.set) == mor_set_checksum(&whole->rigid.group.set)); /* bits */
    rigid_run(whole, 1.0);
    rigid_run(resumed, 1.0);
    assert_memory_equal(resumed->rigid.states, whole->rigid.states, sizeof *whole->rigid.states);          /* bits */
    assert_true(mor_set_checksum(&resumed->rigid.group.set) == mor_set_checksum(&whole->rigid.group.set)); /* bits */
    rigid_close(resumed);
    rigid_close(whole);
}

static double find_proposal(rigid_scene *it, const char *limit)
{
    mor_stepper stepper;
    uint64_t evolving = 0;
    double length = 0.0;
    const char *found = NULL;
    mor_rigid_stepper(&it->rigid, &stepper, &evolving);
    assert_int_equal(stepper.n_before, 1);
    assert_false(stepper.is_leader);
    assert_int_equal(stepper.operations->propose(&it->context, &it->rigid, &length, &found), MOR_OK);
    assert_string_equal(found, limit);
    return length;
}

static double contact_step(mor_context *context, const void *contact, const mor_body_group *group)
{
    (void)context;
    (void)group;
    return *(const double *)contact;
}

static void step_is_limited_by_way_spring_and_contact(void **state)
{
    (void)state;
    rigid_box box = {.sides = {2, 2, 2}, .density = 1024.0};
    const double way = 0.2 * SPACING;
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 1.0, 1.0);
    assert_true(isinf(find_proposal(it, "nothing")));
    it->rigid.group.gravity[1] = -8.0; /* free fall */
    assert_near(find_proposal(it, "displacement per step of a rigid body"), sqrt(2.0 * way / 8.0),
                1e-15); /* rounding */
    const double contact = 1e-4;
    it->rigid.group.contact = &contact;
    it->rigid.group.longest_contact_step = contact_step;
    assert_true(find_proposal(it, "the contact of a rigid body") == contact); /* exact: a copy */
    rigid_close(it);
    box.velocity[0] = 2.0;
    box.spin[2] = 4.0;
    it = rigid_open(&box, 1, 3, SPACING, 1.0, 1.0);
    const double outermost = SPACING * (0.5 * sqrt(3.0) + 0.5); /* of a corner particle, and half a spacing */
    assert_near(find_proposal(it, "displacement per step of a rigid body"), way / (2.0 + 4.0 * outermost),
                1e-15); /* rounding */
    rigid_close(it);
    box = spring_box(1e8, 0.0);
    box.motion.spring_length = 4.4; /* at rest */
    it = rigid_open(&box, 1, 3, SPACING, 1.0, 1.0);
    const double period = 2.0 * MOR_PI * sqrt(16.0 / 1e8);
    assert_near(find_proposal(it, "the spring of a rigid body") / (0.1 * period), 1.0, 1e-12); /* rounding of mass */
    rigid_close(it);
}

/* A velocity that no step has limited yet stands for a force that throws the body: 10 km in 0.01 s. */
static void body_that_is_thrown_out_of_the_domain_is_told_from_one_that_leaves_it(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {2, 2, 2}, .density = 1e-3};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 10.0);
    const mor_step step = {0.01, 0.0, 7, 0, 1};
    it->rigid.group.domain_minimum[0] = -1.0;
    it->rigid.states[0].velocity[0] = -1e6;
    mor_view view = mor_view_open(&it->rigid.group.set, NULL);
    assert_int_equal(mor_rigid_drift_first(&it->context, &it->rigid, &view, &step), MOR_OK);
    assert_int_equal(mor_rigid_drift_second(&it->context, &it->rigid, &view, &step), MOR_ERROR_NUMERIC);
    assert_non_null(strstr(it->context.message, "was thrown out of the domain, to (-10000"));
    assert_non_null(strstr(it->context.message, "A larger domain does not help"));
    rigid_close(it);
}

static void body_that_leaves_the_domain_is_named(void **state)
{
    (void)state;
    const rigid_box boxes[2] = {{.sides = {2, 2, 2}, .density = 1000.0},
                                {.sides = {2, 2, 2}, .place = {4.0}, .density = 1000.0, .velocity = {1.0}}};
    rigid_scene *it = rigid_open(boxes, 2, 3, SPACING, 0.01, 10.0);
    it->rigid.group.domain_maximum[0] = 1.0;
    mor_status status = MOR_OK;
    while (status == MOR_OK && it->schedule.now < it->schedule.end) {
        status = mor_schedule_step(&it->context, &it->schedule, it->schedule.end);
    }
    assert_int_equal(status, MOR_ERROR_NUMERIC);
    assert_non_null(strstr(it->context.message, "of rigid body 'second' of group 'rocks' left the domain"));
    assert_near(mor_schedule_time(&it->schedule), 1.0 - 4.5 * SPACING, 0.011); /* one step */
    rigid_close(it);
}

static void motion_that_is_not_a_number_is_named(void **state)
{
    (void)state;
    const rigid_box boxes[2] = {{.sides = {2, 2, 2}, .density = 1000.0},
                                {.sides = {2, 2, 2}, .place = {4.0}, .density = 1000.0}};
    for (int kind = 0; kind < 2; ++kind) {
        rigid_scene *it = rigid_open(boxes, 2, 3, SPACING, 0.01, 10.0);
        (kind == 0 ? it->rigid.group.bodies[1].contact_force : it->rigid.group.bodies[1].contact_moment)[2] = NAN;
        assert_int_equal(mor_schedule_step(&it->context, &it->schedule, it->schedule.end), MOR_ERROR_NUMERIC);
        assert_non_null(strstr(it->context.message, "rigid body 'second' of group 'rocks' has a motion that is not a "
                                                    "number"));
        rigid_close(it);
    }
}

static void impossible_motions_are_refused(void **state)
{
    (void)state;
    static const struct {
        int dimension;
        mor_rigid_motion motion;
        const char *message;
    } wrong[] = {
        {3, {.locked = 64}, "locks axes 0x40"},
        {3, {.has_spring = true, .spring_stiffness = -1.0}, "none may be negative"},
        {3, {.has_spring = true, .spring_damping = NAN}, "none may be negative"},
        {3, {.has_spring = true, .spring_length = -0.5}, "none may be negative"},
        {2, {.is_prescribed = true, .velocity = {0.0, 0.0, 1.0}}, "moves out of the plane"},
        {2, {.is_prescribed = true, .angular_velocity = {1.0, 0.0, 0.0}}, "moves out of the plane"},
    };
    const rigid_units units = {1.0, 1.0, 1.0};
    rigid_scene *it = malloc(sizeof *it);
    assert_non_null(it);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        const rigid_box boxes[2] = {{.sides = {2, 2, 2}, .density = 1000.0, .motion = wrong[k].motion},
                                    {.sides = {2, 2, 2}, .place = {4.0}, .density = 1000.0}};
        assert_int_equal(rigid_make(it, boxes, 2, wrong[k].dimension, SPACING, &units), MOR_ERROR_ARGUMENT);
        assert_int_equal(it->context.item, 0);
        assert_non_null(strstr(it->context.message, "'first'"));
        assert_non_null(strstr(it->context.message, wrong[k].message));
        assert_null(it->rigid.states);
        rigid_drop(it);
    }
    free(it);
}

static void sub_steps_allocate_nothing(void **state)
{
    (void)state;
    const rigid_box box = {.sides = {4, 4, 4}, .density = 1000.0, .spin = {1.0, 2.0, 3.0}};
    rigid_scene *it = rigid_open(&box, 1, 3, SPACING, 0.01, 0.2);
    const uint64_t before = it->context.n_allocations;
    rigid_run(it, 0.2);
    assert_true(it->context.n_allocations == before); /* exact: a count */
    rigid_close(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projectile_follows_its_parabola),
        cmocka_unit_test(gravity_grows_over_its_ramp),
        cmocka_unit_test(symmetric_top_precesses_as_in_closed_form),
        cmocka_unit_test(spring_swings_with_its_period),
        cmocka_unit_test(damper_damps_with_its_ratio),
        cmocka_unit_test(damper_of_any_strength_never_pushes_back),
        cmocka_unit_test(prescribed_motion_is_exact_and_counts_impulses),
        cmocka_unit_test(locked_axes_do_not_move),
        cmocka_unit_test(turn_with_one_axis_locked_keeps_its_energy),
        cmocka_unit_test(force_on_a_point_turns_with_the_true_inertia),
        cmocka_unit_test(angular_momentum_given_is_received_at_any_rate),
        cmocka_unit_test(contact_moves_the_body_and_is_counted),
        cmocka_unit_test(damping_takes_velocity_and_spin_alike),
        cmocka_unit_test(points_follow_their_body),
        cmocka_unit_test(states_are_all_that_a_resume_needs),
        cmocka_unit_test(step_is_limited_by_way_spring_and_contact),
        cmocka_unit_test(body_that_leaves_the_domain_is_named),
        cmocka_unit_test(body_that_is_thrown_out_of_the_domain_is_told_from_one_that_leaves_it),
        cmocka_unit_test(motion_that_is_not_a_number_is_named),
        cmocka_unit_test(impossible_motions_are_refused),
        cmocka_unit_test(sub_steps_allocate_nothing),
    };
    return CLOUD_RUN(tests);
}
