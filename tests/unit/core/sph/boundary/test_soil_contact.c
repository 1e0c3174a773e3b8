/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/floor.h"

/* 2 (stress . gradient) / density: what a wall that holds the particle's own stress gives, eq. 27 with sigma_w. */
static void mirrored_push(floor_case *f, const double *gradient, double *push)
{
    mor_symmetric_apply(floor_record(f) + MOR_RECORD_STRESS, gradient, push);
    for (int a = 0; a < 3; ++a) {
        push[a] *= 2.0 / floor_record(f)[MOR_RECORD_DENSITY];
    }
}

/* Parts of a vector along and across the normal of the floor, which points up. */
static void split(int dimension, const double *v, double *along_normal, double *tangential)
{
    const int up = dimension - 1;
    *along_normal = v[up];
    memcpy(tangential, v, 3 * sizeof *v);
    tangential[up] = 0.0;
}

static void wall_sums_are_those_of_the_kernel(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        double gradient[3];
        floor_open_single(&f, dimension, MOR_WALL_ROUGH, 0.0);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        floor_gradient(&f, floor_record(&f), gradient);
        const int up = dimension - 1;
        assert_true(gradient[up] < -0.1 / ASSEMBLY_SPACING); /* into the wall, and of the size expected there */
        assert_int_equal(f.wall.relation.n_occupied, 1);
        floor_assert_vector(f.wall.sums + MOR_KERNEL_SUM_GRADIENT, gradient, fabs(gradient[up]));
        floor_close(&f);
    }
}

static void wall_at_rest_gives_the_particle_its_own_stress(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * 3 * 3; ++option) {
        const int dimension = 2 + option % 2;
        const double normal = option / 2 % 3 == 0 ? -8e3 : option / 2 % 3 == 1 ? 5e3 : 0.0; /* tension holds, too */
        floor_case f;
        double gradient[3];
        double expected[3];
        floor_open_single(&f, dimension, MOR_WALL_ROUGH, 0.0);
        floor_set_stress(&f, normal, 1.5e3);
        floor_run(&f, (mor_dissipation)(option / 6));
        floor_gradient(&f, floor_record(&f), gradient);
        mirrored_push(&f, gradient, expected);
        floor_assert_vector(f.acceleration, expected, 1e4 * mor_vector_length(gradient) / ASSEMBLY_DENSITY);
        assert_true(f.wall.stick[0] == 1.0); /* exact: a rough wall always holds */
        floor_close(&f);
    }
}

static void smooth_wall_gives_the_normal_part_only(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        double gradient[3];
        double rough[3];
        double expected[3] = {0.0};
        floor_open_single(&f, dimension, MOR_WALL_SMOOTH, 0.0);
        floor_set_stress(&f, -8e3, 1.5e3);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        floor_gradient(&f, floor_record(&f), gradient);
        mirrored_push(&f, gradient, rough);
        expected[dimension - 1] = rough[dimension - 1];
        assert_true(expected[dimension - 1] > 0.0); /* compression pushes up */
        floor_assert_vector(f.acceleration, expected, mor_vector_length(rough));
        assert_true(f.wall.stick[0] == 0.0); /* exact: a smooth wall never holds */
        floor_close(&f);
    }
}

/* Part of the tangential motion that is mirrored, for tractions in Pa. A billionth of the bulk modulus, below which a
 * stress is rounding and decides nothing, is added to both. */
static double sticking_part(floor_case *f, double limit, double trial)
{
    const double noise = 1e-9 * floor_record(f)[MOR_RECORD_DENSITY] * ASSEMBLY_SOUND * ASSEMBLY_SOUND;
    return trial > limit ? (limit + noise) / (trial + noise) : 1.0;
}

static void coulomb_wall_caps_the_tangential_part(void **state)
{
    (void)state;
    static const double shears[] = {0.0, 1e3, 3.9e3, 4.1e3, 2e4, -2e4}; /* the cap is 0.5 times 8 kPa */
    for (int option = 0; option < 2 * 6; ++option) {
        const int dimension = 2 + option % 2;
        const double shear = shears[option / 2];
        floor_case f;
        double gradient[3];
        double rough[3];
        double normal = 0.0;
        double tangential[3];
        double got[3];
        double expected_normal = 0.0;
        double expected[3];
        floor_open_single(&f, dimension, MOR_WALL_COULOMB, 0.5);
        floor_set_stress(&f, -8e3, shear);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        floor_gradient(&f, floor_record(&f), gradient);
        mirrored_push(&f, gradient, rough);
        split(dimension, f.acceleration, &normal, got);
        split(dimension, rough, &expected_normal, tangential);
        const double scale = mor_vector_length(rough);
        assert_true(fabs(normal - expected_normal) <= 256 * DBL_EPSILON * scale); /* as floor_assert_vector */
        const double share = fabs(shear) > 4e3 ? 4e3 / fabs(shear) : 1.0;
        for (int a = 0; a < 3; ++a) {
            expected[a] = share * tangential[a];
        }
        floor_assert_vector(got, expected, scale);
        assert_true(mor_vector_length(got) <= 0.5 * normal * (1.0 + 16 * DBL_EPSILON)); /* the law; a dozen products */
        const double stick = sticking_part(&f, 4e3, fabs(shear));
        assert_true(fabs(f.wall.stick[0] - stick) <= 256 * DBL_EPSILON); /* as floor_assert_vector */
        floor_close(&f);
    }
}

static void coulomb_wall_holds_nothing_under_tension(void **state)
{
    (void)state;
    floor_case f;
    floor_open_single(&f, 3, MOR_WALL_COULOMB, 0.5);
    floor_set_stress(&f, 2e3, 1e3);
    floor_run(&f, MOR_DISSIPATION_BOTH);
    double normal = 0.0;
    double tangential[3];
    split(3, f.acceleration, &normal, tangential);
    assert_true(normal < 0.0);                                                /* the mirror still pulls */
    assert_true(mor_vector_length(tangential) <= 64 * DBL_EPSILON * -normal); /* the normal tilts by some ulp */
    f.presses_only = true;
    floor_run(&f, MOR_DISSIPATION_BOTH);
    assert_true(mor_vector_length(f.acceleration) == 0.0); /* exact: nothing pulls, and nothing rubs without pressure */
    assert_true(f.wall.stick[0] == 0.0);                   /* and nothing shears it */
    floor_close(&f);
}

static void infinite_and_no_friction_are_rough_and_smooth(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (int is_rough = 0; is_rough < 2; ++is_rough) {
            floor_case coulomb;
            floor_case plain;
            floor_open_single(&coulomb, dimension, MOR_WALL_COULOMB, is_rough ? INFINITY : 0.0);
            floor_open_single(&plain, dimension, is_rough ? MOR_WALL_ROUGH : MOR_WALL_SMOOTH, 0.0);
            floor_set_stress(&coulomb, -8e3, 5e3);
            floor_set_stress(&plain, -8e3, 5e3);
            floor_record(&coulomb)[MOR_RECORD_VELOCITY] = floor_record(&plain)[MOR_RECORD_VELOCITY] = 1.0;
            floor_run(&coulomb, MOR_DISSIPATION_BOTH);
            floor_run(&plain, MOR_DISSIPATION_BOTH);
            assert_memory_equal(coulomb.acceleration, plain.acceleration, sizeof plain.acceleration);
            double gradient[3];
            floor_gradient(&plain, floor_record(&plain), gradient);
            const double held = is_rough ? 0.0 : sticking_part(&coulomb, 0.0, 5e3);
            const double slack = 2.0 * held * (1.0 + 1e-12) * mor_vector_length(gradient); /* the part held anyway */
            for (int k = 0; k < 9; ++k) {
                assert_true(fabs(coulomb.velocity_gradient[k] - plain.velocity_gradient[k]) <= slack); /* see slack */
            }
            floor_close(&plain);
            floor_close(&coulomb);
        }
    }
}

static void rounding_does_not_decide_whether_a_particle_slides(void **state)
{
    (void)state;
    static const double shears[] = {0.0, 1e-11, -1e-10}; /* some ulp of a stress of kilopascals */
    for (int k = 0; k < 3; ++k) {
        floor_case f;
        floor_open_single(&f, 3, MOR_WALL_COULOMB, 0.3);
        floor_set_stress(&f, 0.0, shears[k]);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        assert_true(fabs(f.wall.stick[0] - 1.0) < 1e-6); /* 1e-10 Pa over a billionth of the bulk modulus, 5 mPa */
        floor_close(&f);
    }
}

/* The dissipation of eqs. 20, 23 for the states of eqs. 32, 34 and a closing speed. */
static double wall_pressure(const floor_case *f, mor_dissipation mode, double closing)
{
    const double *record = f->soil.records;
    const bool is_counted = mode == MOR_DISSIPATION_BOTH || (mode == MOR_DISSIPATION_APPROACH) == (closing > 0.0);
    /* U_L - U_R is twice the closing speed; impedances are equal. */
    const double limiter = is_counted ? fmin(ASSEMBLY_ETA * 2.0 * fabs(closing) / ASSEMBLY_SOUND, 1.0) : 0.0;
    return limiter * record[MOR_RECORD_DENSITY] * ASSEMBLY_SOUND * closing;
}

static void dissipation_follows_the_one_sided_riemann_problem(void **state)
{
    (void)state;
    static const double closings[] = {-20.0, -0.3, -1e-3, 0.0, 1e-3, 0.3, 20.0}; /* the limiter ends at 0.625 m/s */
    for (int option = 0; option < 2 * 3 * 7; ++option) {
        const int dimension = 2 + option % 2;
        const mor_dissipation mode = (mor_dissipation)(option / 2 % 3);
        const double closing = closings[option / 6];
        floor_case f;
        double gradient[3];
        double expected[3];
        floor_open_single(&f, dimension, MOR_WALL_ROUGH, 0.0);
        floor_set_stress(&f, -8e3, 1.5e3);
        double *v = floor_record(&f) + MOR_RECORD_VELOCITY;
        v[0] = 0.7; /* along the wall: gives no dissipation */
        v[dimension - 1] = -closing;
        floor_run(&f, mode);
        floor_gradient(&f, floor_record(&f), gradient);
        mirrored_push(&f, gradient, expected);
        const double pressure = wall_pressure(&f, mode, closing);
        for (int a = 0; a < 3; ++a) {
            expected[a] -= 2.0 / floor_record(&f)[MOR_RECORD_DENSITY] * pressure * gradient[a];
        }
        const double scale = (1e4 + 0.7 * ASSEMBLY_SOUND * ASSEMBLY_DENSITY + fabs(pressure)) / ASSEMBLY_DENSITY;
        floor_assert_vector(f.acceleration, expected, scale * mor_vector_length(gradient));
        floor_close(&f);
    }
}

static void drag_mirrors_the_velocity_about_that_of_the_wall(void **state)
{
    (void)state;
    static const double coefficients[] = {0.0, 0.0, 0.1}; /* of rough, smooth and Coulomb */
    for (int option = 0; option < 2 * 3; ++option) {
        const int dimension = 2 + option % 2;
        const mor_wall_friction friction = (mor_wall_friction)(option / 2);
        floor_case f;
        double gradient[3];
        floor_open_single(&f, dimension, friction, coefficients[friction]);
        floor_set_stress(&f, -8e3, 4e3);
        const double velocity[3] = {0.4, dimension == 3 ? -0.3 : -0.2, dimension == 3 ? -0.2 : 0.0};
        memcpy(floor_record(&f) + MOR_RECORD_VELOCITY, velocity, sizeof velocity);
        floor_run(&f, MOR_DISSIPATION_APPROACH);
        floor_gradient(&f, floor_record(&f), gradient);
        const double stick = f.wall.stick[0];
        assert_true(friction != MOR_WALL_COULOMB || (stick > 0.1 && stick < 0.9)); /* it slips, but not freely */
        double normal = 0.0;
        double tangential[3];
        split(dimension, velocity, &normal, tangential);
        for (int a = 0; a < 3; ++a) {
            double expected[3];
            const double image = -2.0 * (stick * tangential[a] + (a == dimension - 1 ? normal : 0.0));
            for (int b = 0; b < 3; ++b) {
                expected[b] = image * gradient[b];
            }
            floor_assert_vector(f.velocity_gradient + 3 * a, expected, mor_vector_length(gradient));
        }
        const double rate = 2.0 * floor_record(&f)[MOR_RECORD_DENSITY] * normal * gradient[dimension - 1];
        assert_true(rate > 0.0); /* what runs into the wall is compressed */
        assert_true(fabs(f.density_rate[0] - rate) <= 256 * DBL_EPSILON * rate / 0.2); /* as floor_assert_vector */
        floor_close(&f);
    }
}

static void motion_with_the_wall_is_rest(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * 3 * 3; ++option) {
        const int dimension = 2 + option % 2;
        floor_case still;
        floor_case moving;
        floor_open_single(&still, dimension, (mor_wall_friction)(option / 2 % 3), 0.3);
        floor_open_single(&moving, dimension, MOR_WALL_ROUGH, 0.0);
        mor_wall_request request = floor_request(&moving, (mor_wall_friction)(option / 2 % 3), 0.3);
        const double frame[3] = {16.0, -8.0, dimension == 3 ? 4.0 : 0.0};
        memcpy(request.velocity, frame, sizeof frame);
        floor_add(&moving, &request);
        floor_set_stress(&still, -8e3, 5e3);
        floor_set_stress(&moving, -8e3, 5e3);
        for (int a = 0; a < dimension; ++a) {
            const double own = ldexp(a - 0.5, -6); /* sums with the frame's velocity are exact */
            floor_record(&still)[MOR_RECORD_VELOCITY + a] = own;
            floor_record(&moving)[MOR_RECORD_VELOCITY + a] = own + frame[a];
        }
        floor_run(&still, (mor_dissipation)(option / 6));
        floor_run(&moving, (mor_dissipation)(option / 6));
        assert_memory_equal(still.acceleration, moving.acceleration, sizeof still.acceleration);
        assert_memory_equal(still.velocity_gradient, moving.velocity_gradient, sizeof still.velocity_gradient);
        assert_memory_equal(still.density_rate, moving.density_rate, sizeof still.density_rate);
        assert_memory_equal(still.wall.force, moving.wall.force, sizeof still.wall.force);
        floor_close(&moving);
        floor_close(&still);
    }
}

static void moved_wall_is_the_wall_made_there(void **state)
{
    (void)state;
    const double displacement[3] = {0.5 * ASSEMBLY_SPACING, 0.0, 0.25 * ASSEMBLY_SPACING};
    floor_case moved;
    floor_case made;
    floor_open_single(&moved, 3, MOR_WALL_ROUGH, 0.0);
    floor_open_single(&made, 3, MOR_WALL_ROUGH, 0.0);
    mor_wall_request request = floor_request(&moved, MOR_WALL_ROUGH, 0.0);
    memcpy(request.velocity, displacement, sizeof displacement); /* per second */
    floor_add(&moved, &request);
    for (int k = 0; k < 3 * made.n_points; ++k) {
        made.points[k] += displacement[k % 3];
    }
    request.points = made.points;
    floor_add(&made, &request);
    floor_set_stress(&moved, -8e3, 5e3);
    floor_set_stress(&made, -8e3, 5e3);
    mor_soil_contact_move(&moved.soil.context, &moved.wall, 7.0); /* the path there does not count */
    mor_soil_contact_move(&moved.soil.context, &moved.wall, 1.0);
    floor_run(&moved, MOR_DISSIPATION_BOTH);
    floor_run(&made, MOR_DISSIPATION_BOTH);
    /* Rounding may sort the points of the two otherwise, and so change the order of the sums. */
    const double size = mor_vector_length(made.acceleration);
    assert_true(size > 1.0);
    floor_assert_vector(moved.acceleration, made.acceleration, size);
    floor_close(&made);
    floor_close(&moved);
}

static void wall_out_of_reach_or_without_points_does_nothing(void **state)
{
    (void)state;
    for (int n_points = 0; n_points <= FLOOR_SIDE * FLOOR_LAYERS; n_points += FLOOR_SIDE * FLOOR_LAYERS) {
        floor_case f;
        floor_open_single(&f, 2, MOR_WALL_COULOMB, 0.5);
        f.n_points = n_points;
        const mor_wall_request request = floor_request(&f, MOR_WALL_COULOMB, 0.5);
        floor_add(&f, &request);
        floor_set_stress(&f, -8e3, 5e3);
        floor_record(&f)[1] = 2.2 * ASSEMBLY_SPACING; /* the nearest points are 2.7 spacings away, the support 2.6 */
        floor_run(&f, MOR_DISSIPATION_BOTH);
        assert_int_equal(f.wall.relation.n_occupied, 0);
        for (int a = 0; a < 9; ++a) {
            assert_true(f.velocity_gradient[a] == 0.0 && f.acceleration[a % 3] == 0.0); /* exact: nothing was added */
        }
        assert_true(f.density_rate[0] == 0.0);               /* exact: likewise */
        assert_true(mor_vector_length(f.wall.force) == 0.0); /* exact: likewise */
        floor_close(&f);
    }
}

/* A layer of soil in random states over the floor; its clusters are not all full. */
static void open_layer(floor_case *f, int dimension, mor_wall_friction friction)
{
    assembly_open_lattice(&f->soil, dimension, dimension == 2 ? 9 : 4, 3, 0.3);
    for (int i = 0; i < f->soil.n; ++i) {
        double *x = f->soil.records + i * MOR_RECORD_SIZE;
        x[dimension - 1] += 0.9 * ASSEMBLY_SPACING; /* the lattice's lowest row stands at zero */
        x[0] -= 1.5 * ASSEMBLY_SPACING;
    }
    assembly_list(&f->soil, 0.0);
    floor_open(f, friction, 0.3);
}

static void force_on_the_wall_is_minus_that_on_the_soil(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * 3; ++option) {
        floor_case f;
        open_layer(&f, 2 + option % 2, (mor_wall_friction)(option / 2));
        floor_run(&f, MOR_DISSIPATION_BOTH);
        assert_true(f.wall.relation.n_occupied > 1 && f.wall.relation.n_occupied < f.soil.tree.n_clusters);
        double force[3] = {0.0, 0.0, 0.0};
        double magnitude = 0.0;
        for (int i = 0; i < f.soil.n; ++i) {
            const double *record = f.soil.records + i * MOR_RECORD_SIZE;
            for (int a = 0; a < 3; ++a) {
                const double part = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME] * f.acceleration[3 * i + a];
                force[a] -= part;
                magnitude += fabs(part);
            }
        }
        assert_true(magnitude > 0.0);
        floor_assert_vector(f.wall.force, force, magnitude);
        for (int i = 3 * f.soil.n; i < 3 * ASSEMBLY_MAX; ++i) {
            assert_true(f.acceleration[i] == 0.0); /* exact: no particle stands there */
        }
        floor_close(&f);
    }
}

static void walls_add_to_what_is_there_and_any_number_of_threads_agrees(void **state)
{
    (void)state;
    floor_case alone;
    open_layer(&alone, 3, MOR_WALL_COULOMB);
    floor_run(&alone, MOR_DISSIPATION_BOTH);
    for (int threads = 2; threads <= 3; ++threads) {
        floor_case f;
        open_layer(&f, 3, MOR_WALL_COULOMB);
        f.soil.context.n_threads = threads;
        const mor_wall_request request = floor_request(&f, MOR_WALL_COULOMB, 0.3);
        floor_add(&f, &request);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        assert_memory_equal(alone.acceleration, f.acceleration, sizeof f.acceleration);
        assert_memory_equal(alone.velocity_gradient, f.velocity_gradient, sizeof f.velocity_gradient);
        assert_memory_equal(alone.density_rate, f.density_rate, sizeof f.density_rate);
        assert_memory_equal(alone.wall.force, f.wall.force, sizeof f.wall.force);
        const mor_contact_soil seen = floor_soil(&f, MOR_DISSIPATION_BOTH);
        mor_soil_contact_sum_forces(&f.soil.context, &f.wall, &seen, f.acceleration);
        for (int i = 0; i < 3 * f.soil.n; ++i) {
            assert_true(f.acceleration[i] == 2.0 * alone.acceleration[i]); /* exact: added once more */
        }
        floor_close(&f);
    }
    floor_close(&alone);
}

static void rebuilding_a_wall_allocates_only_for_more_soil(void **state)
{
    (void)state;
    floor_case f;
    open_layer(&f, 3, MOR_WALL_ROUGH);
    floor_run(&f, MOR_DISSIPATION_BOTH);
    const uint64_t n_allocations = f.soil.context.n_allocations;
    floor_run(&f, MOR_DISSIPATION_BOTH);
    assert_int_equal(f.soil.context.n_allocations, n_allocations);
    for (int i = 0; i < f.soil.n; ++i) {
        f.soil.records[i * MOR_RECORD_SIZE + 2] *= 0.4; /* the whole layer comes near */
    }
    floor_run(&f, MOR_DISSIPATION_BOTH);
    assert_true(f.wall.relation.n_occupied <= f.wall.capacity);
    assert_int_equal(f.wall.relation.n_occupied, f.soil.tree.n_clusters);
    floor_close(&f);
}

/* A particle half a spacing above a floor that only presses, and how it moves along it. */
typedef struct motion_along {
    double own;   /* traction against the motion over the limit of friction, 1 */
    double speed; /* over that of a wave as large as that limit, 1 */
    double rate;  /* of shear in the last step, over what all of the motion mirrored would shear, 1 */
} motion_along;

/* What the floor does about it. */
typedef struct met_along {
    double friction; /* over its limit, against the motion, 1 */
    double stick;    /* mirrored part of the motion, 1 */
    double load;     /* traction that it adds in the step over the limit, where Poisson's ratio is 2/7, 1 */
} met_along;

static met_along move_along(int dimension, const motion_along *motion)
{
    static const double coefficient = 0.3;
    static const double pressure = 4e3;
    static const double step = 1e-5;
    double rate[6 * ASSEMBLY_MAX] = {0.0};
    double point[3] = {0.0, 0.0, 0.0};
    double gradient[3];
    floor_case f;
    point[dimension - 1] = 0.5 * ASSEMBLY_SPACING;
    assembly_open(&f.soil, dimension, point, 1);
    floor_open(&f, MOR_WALL_COULOMB, coefficient);
    f.presses_only = true;
    floor_set_stress(&f, -pressure, 0.0);
    floor_run(&f, MOR_DISSIPATION_BOTH);
    double *record = floor_record(&f);
    const double limit = coefficient * pressure;
    const double speed = motion->speed * limit / record[MOR_RECORD_IMPEDANCE];
    floor_gradient(&f, record, gradient);
    const double strain = 2.0 * mor_vector_length(gradient) * speed; /* by all of the motion mirrored, 1/s */
    const int shear = dimension == 3 ? MOR_ZX : MOR_XY;
    record[MOR_RECORD_STRESS + shear] = motion->own * limit;
    record[MOR_RECORD_VELOCITY] = speed;
    rate[shear] = 0.5 * motion->rate * strain;
    mor_contact_soil soil = floor_soil(&f, MOR_DISSIPATION_BOTH);
    soil.strain_rate = rate;
    soil.length = step;
    memset(f.acceleration, 0, sizeof f.acceleration);
    mor_soil_contact_sum_forces(&f.soil.context, &f.wall, &soil, f.acceleration);
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double modulus = 0.5 * impedance * impedance / record[MOR_RECORD_DENSITY];
    const met_along met = {-f.acceleration[0] / (coefficient * f.acceleration[dimension - 1]), f.wall.stick[0],
                           modulus * strain * f.wall.stick[0] * step / limit};
    floor_close(&f);
    return met;
}

/* What bears the limit of friction slips, at whatever speed; the floor does not shear it. */
static void soil_that_bears_the_limit_of_friction_slips_without_shear(void **state)
{
    const double tolerance = 1e-9; /* rounding */
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (int k = 0; k < 4; ++k) {
            const motion_along motion = {k % 2 == 0 ? 1.0 + tolerance : 3.0, k < 2 ? 1e-3 : 100.0, 1.0};
            const met_along met = move_along(dimension, &motion);
            assert_true(met.stick == 0.0 && fabs(met.friction - 1.0) < tolerance);
        }
    }
}

/* Soil is sheared by the motion until it bears the limit, and no more: however fast it slides, a step loads elastic
 * soil by what is missing. */
static void sliding_loads_soil_up_to_the_limit_of_friction(void **state)
{
    const double tolerance = 1e-9; /* rounding */
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (int k = -1; k < 3; ++k) {
            const double own = 0.45 * k; /* negative: the traction drives the soil on, and is turned first */
            const met_along met = move_along(dimension, &(motion_along){own, 1e3, 0.0});
            assert_true(met.stick < 0.1 && fabs(own + met.load - 1.0) < tolerance);
            assert_true(fabs(met.friction - 1.0) < tolerance);
        }
        const met_along slow = move_along(dimension, &(motion_along){0.5, 1e-3, 0.0});
        assert_true(slow.stick == 1.0 && fabs(slow.friction - 0.5) < tolerance); /* it sticks, and bears its own */
    }
}

/* Soil that was sheared as fast as it moves and still bears less than friction allows yields: no part of its motion is
 * slip. From a tenth below the limit on it may be as strong as that, and slips. */
static void soil_that_yields_below_the_limit_of_friction_does_not_slip(void **state)
{
    const double tolerance = 1e-9; /* rounding */
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        const met_along weak = move_along(dimension, &(motion_along){0.6, 1e3, 0.5});
        assert_true(weak.stick == 1.0 && fabs(weak.friction - 0.6) < tolerance);
        const met_along strong = move_along(dimension, &(motion_along){0.999, 1e3, 0.5});
        assert_true(strong.stick < 0.1 && fabs(strong.friction - 1.0) < tolerance);
        const met_along against = move_along(dimension, &(motion_along){0.6, 1e3, -0.5});
        assert_true(against.stick < 0.1 && fabs(against.friction - 1.0) < tolerance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wall_sums_are_those_of_the_kernel),
        cmocka_unit_test(wall_at_rest_gives_the_particle_its_own_stress),
        cmocka_unit_test(smooth_wall_gives_the_normal_part_only),
        cmocka_unit_test(coulomb_wall_caps_the_tangential_part),
        cmocka_unit_test(coulomb_wall_holds_nothing_under_tension),
        cmocka_unit_test(infinite_and_no_friction_are_rough_and_smooth),
        cmocka_unit_test(rounding_does_not_decide_whether_a_particle_slides),
        cmocka_unit_test(dissipation_follows_the_one_sided_riemann_problem),
        cmocka_unit_test(drag_mirrors_the_velocity_about_that_of_the_wall),
        cmocka_unit_test(motion_with_the_wall_is_rest),
        cmocka_unit_test(moved_wall_is_the_wall_made_there),
        cmocka_unit_test(wall_out_of_reach_or_without_points_does_nothing),
        cmocka_unit_test(force_on_the_wall_is_minus_that_on_the_soil),
        cmocka_unit_test(walls_add_to_what_is_there_and_any_number_of_threads_agrees),
        cmocka_unit_test(rebuilding_a_wall_allocates_only_for_more_soil),
        cmocka_unit_test(soil_that_bears_the_limit_of_friction_slips_without_shear),
        cmocka_unit_test(sliding_loads_soil_up_to_the_limit_of_friction),
        cmocka_unit_test(soil_that_yields_below_the_limit_of_friction_does_not_slip),
    };
    return CLOUD_RUN(tests);
}
