/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/rigid/rigid.h"
#include "tests/common/elastic_bodies.h"
#include "tests/common/near.h"

static const elastic_piece two[2] = {{.side = {0.5, 0.4, 0.6},
                                      .axis = {0.48, 0.6, 0.64},
                                      .angle = 0.9,
                                      .middle = {5.0, -3.0, 2.0},
                                      .velocity = {1.0, 2.0, 3.0},
                                      .angular_velocity = {0.3, -0.5, 0.9}},
                                     {.is_ball = true, .side = {0.6, 0.6, 0.6}, .angular_velocity = {0.0, 0.0, 2.0}}};

static elastic_request request_of(int dimension)
{
    return (elastic_request){
        .dimension = dimension,
        .spacing = 0.1,
        .pieces = two,
        .n_pieces = 2,
        .youngs = 1e6,
        .poisson = 0.3,
        .density = 1000.0,
        .settings = {.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 0.0, .hourglass = 0.0}};
}

static void test_particles_share_volume_and_mass_of_their_body(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    elastic_open(&it, &request);
    const mor_body_group *group = &it.elastic.group;
    for (int b = 0; b < 2; ++b) {
        const mor_body *body = &group->bodies[b];
        double volume = 0.0;
        double mass = 0.0;
        for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
            volume += group->volume[i];
            mass += group->set.data[MOR_FIELD_MASS][i];
            assert_int_equal(group->body_of[i], b);
        }
        assert_near(volume, body->geometry.volume, 1e-13); /* rounding of the sum */
        assert_near(mass, body->mass, 1e-10);              /* likewise */
        assert_int_equal(group->boundary.patches[b].first, body->first);
        assert_int_equal(group->boundary.patches[b].n_points, body->n_particles);
        assert_true(body->n_nodes > 0);
    }
    assert_int_equal(group->bodies[1].first, group->bodies[0].n_particles);
    elastic_close(&it);
}

/* Turned anyhow, a box of 4 x 6 x 8 (4 x 6) places is made of blocks of 2 x 2 x 2 (4 x 2). */
static void test_clusters_of_a_lattice_are_its_blocks(void **state)
{
    (void)state;
    static const elastic_piece box = {
        .side = {0.4, 0.6, 0.8}, .axis = {0.48, 0.6, 0.64}, .angle = 0.9, .middle = {5.0, -3.0, 2.0}};
    static const elastic_piece plate = {
        .side = {0.4, 0.6}, .axis = {0.0, 0.0, 1.0}, .angle = 0.9, .middle = {5.0, -3.0}};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        elastic_request request = request_of(dimension);
        request.pieces = dimension == 3 ? &box : &plate;
        request.n_pieces = 1;
        elastic_bodies it;
        double widest = 0.0;
        elastic_open(&it, &request);
        const mor_body_group *group = &it.elastic.group;
        for (int64_t i = 0; i < group->set.n_particles; ++i) {
            const double *x = group->reference + 3 * i;
            const double *y = group->reference + 3 * (i / 8 * 8);
            const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
            widest = fmax(widest, mor_vector_length(d));
        }
        /* The diagonal of a block, for lane 0 is a corner of it; rounding of places of order 5 m. */
        assert_near(widest, 0.1 * sqrt(dimension == 3 ? 3.0 : 10.0), 1e-12);
        elastic_close(&it);
    }
}

static void test_ids_name_every_place_of_the_request_once(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    bool is_seen[1000] = {false};
    elastic_open(&it, &request);
    const mor_set *set = &it.elastic.group.set;
    assert_true(set->n_particles <= 1000);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        assert_in_range(set->id[i], 0, set->n_particles - 1);
        assert_false(is_seen[set->id[i]]);
        is_seen[set->id[i]] = true;
        /* Ids count body by body. */
        assert_int_equal(set->id[i] >= it.elastic.group.bodies[1].first, it.elastic.group.body_of[i]);
    }
    elastic_close(&it);
}

static void test_observation_finds_the_motion_at_the_start(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    elastic_open(&it, &request);
    for (int b = 0; b < 2; ++b) {
        const mor_body *body = &it.elastic.group.bodies[b];
        for (int a = 0; a < 3; ++a) {
            assert_near(body->center[a], two[b].middle[a], 1e-14);                     /* rounding at 5 m */
            assert_near(body->velocity[a], two[b].velocity[a], 1e-14);                 /* rounding */
            assert_near(body->angular_velocity[a], two[b].angular_velocity[a], 1e-12); /* of arms at 5 m */
            assert_near(body->rotation[4 * a], 1.0, 1e-13);                            /* likewise */
            assert_true(body->rotation_angle[a] == 0.0);
        }
    }
    elastic_close(&it);
}

/* Turns the bodies by hand about a fixed axis, exactly, in a few steps, and looks at them. */
static void test_observation_follows_a_rotation_over_a_whole_turn(void **state)
{
    (void)state;
    enum { STEPS = 10 };
    const double axis[3] = {0.48, 0.6, 0.64};
    const double rate = 7.0;
    const double step = 0.1;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    elastic_open(&it, &request);
    mor_body_group *group = &it.elastic.group;
    double rotation[9];
    for (int k = 0; k <= STEPS; ++k) {
        mor_matrix_rotation(axis, rate * step * k, rotation);
        for (int64_t i = 0; i < group->set.n_particles; ++i) {
            double *x = group->set.data[MOR_FIELD_POSITION] + 3 * i;
            double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
            mor_matrix_apply(rotation, group->reference + 3 * i, x);
            for (int a = 0; a < 3; ++a) {
                const int b = (a + 1) % 3;
                const int c = (a + 2) % 3;
                v[a] = rate * (axis[b] * x[c] - axis[c] * x[b]);
            }
        }
        mor_body_group_observe(&it.context, group, k == 0 ? 0.0 : step);
    }
    for (int b = 0; b < 2; ++b) {
        for (int a = 0; a < 3; ++a) {
            assert_near(group->bodies[b].rotation_angle[a], rate * STEPS * step * axis[a], 1e-10); /* rounding */
            assert_near(group->bodies[b].angular_velocity[a], rate * axis[a], 1e-11);              /* of arms at 6 m */
        }
        for (int k = 0; k < 9; ++k) {
            assert_near(group->bodies[b].rotation[k], rotation[k], 1e-12); /* rounding */
        }
    }
    elastic_close(&it);
}

static void test_disc_in_plane_strain_turns_about_z(void **state)
{
    (void)state;
    elastic_request request = request_of(2);
    elastic_piece disc = two[1];
    request.pieces = &disc;
    request.n_pieces = 1;
    elastic_bodies it;
    elastic_open(&it, &request);
    elastic_run(&it, 0.5);
    const mor_body *body = &it.elastic.group.bodies[0];
    /* The spin of 2 rad/s stretches the disc by (omega R / c)^2 = 5e-4 / 2, and as much slower it turns. */
    assert_near(body->rotation_angle[2], 1.0, 1e-3);
    assert_near(atan2(body->rotation[3], body->rotation[0]), body->rotation_angle[2], 1e-3); /* likewise */
    assert_true(body->rotation_angle[0] == 0.0 && body->rotation[8] == 1.0);
    elastic_close(&it);
}

/* A particle that gains speed evenly is seen as it is at the end; one that has its velocity again after the step, as
 * after a whole number of periods, is seen half with that and half with its mean. */
static void soil_sees_steady_gains_without_lag_and_fast_motion_by_half(void **state)
{
    (void)state;
    const double length = 0.25;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    elastic_open(&it, &request);
    mor_body_group *group = &it.elastic.group;
    double *x = group->set.data[MOR_FIELD_POSITION] + 9;
    double *v = group->set.data[MOR_FIELD_VELOCITY] + 9;
    const double *record = group->boundary.records + 3 * MOR_BOUNDARY_RECORD;
    const double before[3] = {x[0], x[1], x[2]};
    for (int a = 0; a < 3; ++a) {
        assert_true(record[MOR_BOUNDARY_VELOCITY + a] == v[a]);
    }
    mor_body_group_begin(&it.context, group, length);
    for (int a = 0; a < 3; ++a) {
        assert_true(record[MOR_BOUNDARY_POSITION + a] == before[a] + 0.5 * length * v[a]);
        x[a] += a + 1.0;
    }
    mor_body_group_finish(&it.context, group, length);
    double fastest = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double seen = record[MOR_BOUNDARY_VELOCITY + a];
        assert_near(seen, 0.5 * (v[a] + (a + 1.0) / length), 1e-13); /* rounding at 5 m */
        fastest += seen * seen;
    }
    assert_near(group->boundary.largest_speed, sqrt(fastest), 1e-12); /* that point is the fastest */
    assert_true(record[MOR_BOUNDARY_VOLUME] == group->volume[3]);
    for (int a = 0; a < 3; ++a) {
        const double gain = 30.0 * (a + 1.0);
        x[a] = before[a] + length * (v[a] + 0.5 * gain);
        v[a] += gain;
    }
    mor_body_group_finish(&it.context, group, length);
    for (int a = 0; a < 3; ++a) {
        assert_near(record[MOR_BOUNDARY_VELOCITY + a], v[a], 1e-12); /* rounding at 100 m/s */
    }
    elastic_close(&it);
}

static void test_momentum_and_energy_are_those_of_a_rigid_motion(void **state)
{
    (void)state;
    const elastic_request request = request_of(3);
    elastic_bodies it;
    double p[3];
    double l[3];
    elastic_open(&it, &request);
    const mor_body *body = &it.elastic.group.bodies[1];
    const double *x = it.elastic.group.set.data[MOR_FIELD_POSITION];
    double inertia = 0.0;
    for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
        inertia += body->mass / (double)body->n_particles * (x[3 * i] * x[3 * i] + x[3 * i + 1] * x[3 * i + 1]);
    }
    const double energy = mor_body_group_momentum(&it.elastic.group, 1, p, l);
    assert_near(energy, 0.5 * inertia * 4.0, 1e-12); /* rounding of sums of order 10 */
    assert_near(l[2], inertia * 2.0, 1e-12);         /* likewise */
    assert_near(mor_vector_length(p), 0.0, 1e-12);   /* likewise */
    elastic_close(&it);
}

static void test_body_without_particles_or_volume_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_body_group group;
    const double point[3] = {0.0};
    mor_body_request request = {.name = "pebble", .positions = point, .density = 1.0, .geometry.volume = 1.0};
    mor_context_init(&context);
    assert_int_equal(
        mor_body_group_init(&context, &group, "rocks", &mor_rigid_operations, NULL, 3, 0.1, &request, 1, 0),
        MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "pebble"));
    request.n_particles = 1;
    request.geometry.volume = 0.0;
    assert_int_equal(
        mor_body_group_init(&context, &group, "rocks", &mor_rigid_operations, NULL, 3, 0.1, &request, 1, 0),
        MOR_ERROR_ARGUMENT);
    assert_int_equal(
        mor_body_group_init(&context, &group, "rocks", &mor_rigid_operations, NULL, 3, 0.1, &request, 0, 0),
        MOR_ERROR_ARGUMENT);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_particles_share_volume_and_mass_of_their_body),
        cmocka_unit_test(test_clusters_of_a_lattice_are_its_blocks),
        cmocka_unit_test(test_ids_name_every_place_of_the_request_once),
        cmocka_unit_test(test_observation_finds_the_motion_at_the_start),
        cmocka_unit_test(test_observation_follows_a_rotation_over_a_whole_turn),
        cmocka_unit_test(test_disc_in_plane_strain_turns_about_z),
        cmocka_unit_test(soil_sees_steady_gains_without_lag_and_fast_motion_by_half),
        cmocka_unit_test(test_momentum_and_energy_are_those_of_a_rigid_motion),
        cmocka_unit_test(test_body_without_particles_or_volume_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
