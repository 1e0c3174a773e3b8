/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/sph/boundary/soil_contact_internal.h"

#include "tests/common/floor.h"

/* Gaps between a particle and faces that it leaves and meets again. */

#define DEPTH 0.5 /* of the first layer */

enum { FACE = 7, OTHER = 3 }; /* numbers of faces */

/* Gaps of a particle, and the numbers of their faces. */
typedef struct kept_gaps {
    double gap[MOR_CONTACT_GAPS], face[MOR_CONTACT_GAPS];
} kept_gaps;

/* Forgets gaps to faces that were not seen, as the end of a step does. */
static void end_steps(kept_gaps *kept, int64_t n, const int8_t *sleep)
{
    mor_context context;
    const mor_contact_soil soil = {.n_particles = n};
    double gap[ASSEMBLY_MAX][MOR_CONTACT_GAPS];
    double face[ASSEMBLY_MAX][MOR_CONTACT_GAPS];
    const mor_contact_rates rates = {.gap = gap[0], .gap_face = face[0]};
    for (int64_t i = 0; i < n; ++i) {
        memcpy(gap[i], kept[i].gap, sizeof gap[i]);
        memcpy(face[i], kept[i].face, sizeof face[i]);
    }
    mor_context_init(&context);
    mor_soil_contact_end_gaps(&context, &soil, sleep, &rates);
    for (int64_t i = 0; i < n; ++i) {
        memcpy(kept[i].gap, gap[i], sizeof gap[i]);
        memcpy(kept[i].face, face[i], sizeof face[i]);
    }
}

static void end_step(kept_gaps *kept)
{
    end_steps(kept, 1, NULL);
}

/* Moves a particle that sees a face; returns how much of that the face mirrors, m. */
static double see(kept_gaps *kept, double face, double distance, double leaves, double unloads)
{
    const mor_contact_leave it = {
        .face = face, .depth = DEPTH, .distance = distance, .leaves = leaves, .unloads = unloads};
    const double closure = mor_soil_contact_leave_face(&it, kept->gap, kept->face);
    assert_true(closure >= 0.0 && closure <= 1.0);
    return closure * leaves;
}

/* A step of a particle that sees one face; returns how much of the motion that mirrors, m. */
static double move(kept_gaps *kept, double face, double distance, double leaves, double unloads)
{
    const double mirrored = see(kept, face, distance, leaves, unloads);
    end_step(kept);
    return mirrored;
}

static double gap_to(const kept_gaps *kept, double face)
{
    return mor_soil_contact_gap(kept->gap, kept->face, face, DEPTH, INFINITY);
}

/* Without pressure a face mirrors what goes beyond the nearest place so far, and nothing else: brute force over a
 * random walk. */
static void face_mirrors_what_goes_beyond_the_nearest_place_so_far(void **state)
{
    kept_gaps kept = {{0.0}, {0.0}};
    double height = 0.0;
    double lowest = 0.0;
    double mirrored = 0.0;
    (void)state;
    for (int k = 0; k < 1000; ++k) {
        const double step = 1e-3 * (mor_random_uniform(7, 0, (uint64_t)k) - 0.5);
        height += step;
        lowest = fmin(lowest, height);
        mirrored += move(&kept, FACE, INFINITY, step, 0.0);
        assert_true(fabs(mirrored - lowest) < 1e-9); /* gaps below 5e-10 are rounding */
        assert_true(fabs(gap_to(&kept, FACE) - (height - lowest)) < 1e-9);
    }
    assert_true(lowest < -1e-3 && height - lowest > 1e-4); /* or the walk tells nothing */
}

/* Likewise between as many faces as gaps are kept of, at any angles, and in any order: none has a part in the gap to
 * another. */
static void faces_at_any_angles_have_gaps_of_their_own(void **state)
{
    kept_gaps kept = {{0.0}, {0.0}};
    double normals[MOR_CONTACT_GAPS][3];
    double place[3] = {0.0};
    double nearest[MOR_CONTACT_GAPS] = {0.0};
    double sums[MOR_CONTACT_GAPS] = {0.0};
    (void)state;
    for (int n = 0; n < MOR_CONTACT_GAPS; ++n) {
        for (int a = 0; a < 3; ++a) {
            normals[n][a] = mor_random_uniform(11, (uint64_t)n, (uint64_t)a) - 0.5;
        }
        const double length = mor_vector_length(normals[n]);
        for (int a = 0; a < 3; ++a) {
            normals[n][a] /= length;
        }
    }
    for (int k = 0; k < 1000; ++k) {
        double way[3];
        for (int a = 0; a < 3; ++a) {
            way[a] = 1e-3 * (mor_random_uniform(7, (uint64_t)a, (uint64_t)k) - 0.5);
            place[a] += way[a];
        }
        for (int m = 0; m < MOR_CONTACT_GAPS; ++m) {
            const int n = (k + m) % MOR_CONTACT_GAPS;
            nearest[n] = fmin(nearest[n], mor_vector_dot(place, normals[n]));
            sums[n] += see(&kept, n + 1.0, INFINITY, mor_vector_dot(way, normals[n]), 0.0);
            assert_true(fabs(sums[n] - nearest[n]) < 1e-9); /* gaps below 5e-10 are rounding */
        }
        end_step(&kept);
    }
    for (int n = 0; n < MOR_CONTACT_GAPS; ++n) {
        assert_true(nearest[n] < -1e-3); /* or the walk tells nothing */
    }
}

/* Motion that takes off pressure is mirrored, the rest opens the gap. */
static void pressure_is_taken_off_before_a_gap_opens(void **state)
{
    kept_gaps kept = {{0.0}, {0.0}};
    (void)state;
    assert_true(move(&kept, FACE, INFINITY, 0.002, 0.005) == 0.002);
    assert_true(gap_to(&kept, FACE) == 0.0);
    assert_true(fabs(move(&kept, FACE, INFINITY, 0.008, 0.003) - 0.003) < 1e-15);
    assert_true(fabs(gap_to(&kept, FACE) - 0.005) < 1e-15);
    assert_true(move(&kept, FACE, INFINITY, 0.001, 0.003) == 0.0); /* apart: whatever its stress */
    assert_true(fabs(gap_to(&kept, FACE) - 0.006) < 1e-15);
    assert_true(move(&kept, FACE, INFINITY, 0.0, 0.003) == 0.0);
    assert_true(fabs(gap_to(&kept, FACE) - 0.006) < 1e-15);
}

/* What a particle has left of a face is forgotten with the face, and what sleeps forgets nothing. */
static void gap_lasts_as_long_as_its_face_is_seen(void **state)
{
    static const int8_t sleep[3] = {0, MOR_SLEEP_ASLEEP, 0};
    kept_gaps many[2 * MOR_CLUSTER + 1] = {{{0.0}, {0.0}}};
    kept_gaps kept = {{0.0}, {0.0}};
    (void)state;
    for (int i = 0; i <= 2 * MOR_CLUSTER; ++i) {
        see(&many[i], FACE, INFINITY, 0.01, 0.0);
        end_step(&many[i]);
    }
    end_steps(many, 2 * MOR_CLUSTER + 1, sleep); /* no face is seen */
    for (int i = 0; i <= 2 * MOR_CLUSTER; ++i) {
        assert_true(gap_to(&many[i], FACE) == (i / MOR_CLUSTER == 1 ? 0.01 : 0.0));
        assert_true(many[i].face[0] == (i / MOR_CLUSTER == 1 ? FACE : 0.0));
    }
    move(&kept, FACE, INFINITY, 0.01, 0.0);
    move(&kept, OTHER, INFINITY, 0.002, 0.0);
    assert_true(gap_to(&kept, FACE) == 0.0 && gap_to(&kept, OTHER) == 0.002);
    assert_true(move(&kept, FACE, INFINITY, -0.003, 0.0) == -0.003);
}

/* Of more faces than gaps are kept of those that come last count as touched, until one of the others is closed. */
static void faces_beyond_those_that_are_kept_are_touched(void **state)
{
    kept_gaps kept = {{0.0}, {0.0}};
    (void)state;
    for (int step = 0; step < 2; ++step) {
        for (int n = 0; n <= MOR_CONTACT_GAPS; ++n) {
            assert_true(see(&kept, n + 1.0, INFINITY, 0.01, 0.0) == 0.0);
        }
        end_step(&kept);
        assert_true(gap_to(&kept, MOR_CONTACT_GAPS) == 0.01 * (step + 1));
        assert_true(gap_to(&kept, MOR_CONTACT_GAPS + 1.0) == 0.0);
    }
    assert_true(fabs(see(&kept, 1.0, INFINITY, -0.03, 0.0) + 0.01) < 1e-15);
    see(&kept, MOR_CONTACT_GAPS + 1.0, INFINITY, 0.005, 0.0);
    assert_true(gap_to(&kept, MOR_CONTACT_GAPS + 1.0) == 0.005);
}

/* Patches of a soil's boundaries have numbers of their own: walls in their order, and rocks behind one another. */
static void faces_are_numbered_one_after_the_other(void **state)
{
    mor_pair_slot slots[2] = {{.patch = 0}, {.patch = 2}};
    mor_boundary boundaries[2] = {{.n_patches = 3}, {.n_patches = 1}};
    mor_soil_contact contacts[2] = {{.boundary = &boundaries[0]}, {.boundary = &boundaries[1]}};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        contacts[k].slots = slots;
        mor_soil_contact_number(contacts, k, 10);
    }
    assert_true(mor_soil_contact_face(&contacts[0], MOR_CLUSTER - 1) == 11.0);
    assert_true(mor_soil_contact_face(&contacts[0], MOR_CLUSTER) == 13.0);
    assert_true(mor_soil_contact_face(&contacts[1], 0) == 14.0);
}

/* A gap is no wider than the particle is far: what is nearer than half the first layer's depth touches, and has no gap
 * from then on. */
static void what_is_near_a_face_touches_it(void **state)
{
    kept_gaps kept = {{0.4}, {FACE}};
    (void)state;
    assert_true(mor_soil_contact_gap(kept.gap, kept.face, FACE, DEPTH, INFINITY) == 0.4);
    assert_true(fabs(mor_soil_contact_gap(kept.gap, kept.face, FACE, DEPTH, 0.35) - 0.1) < 1e-15);
    assert_true(mor_soil_contact_gap(kept.gap, kept.face, FACE, DEPTH, 0.2) == 0.0);
    assert_true(mor_soil_contact_gap(kept.gap, kept.face, FACE, DEPTH, -0.1) == 0.0);
    assert_true(move(&kept, FACE, 0.2, -0.01, 0.0) == -0.01);
    assert_true(move(&kept, FACE, 0.255, 0.005, 0.01) == 0.005);
    assert_true(gap_to(&kept, FACE) == 0.0);
}

/* Soil as it is seen with the gaps before a step, and what is kept of it. */
typedef struct kept_soil {
    double gap[MOR_CONTACT_GAPS * ASSEMBLY_MAX], face[MOR_CONTACT_GAPS * ASSEMBLY_MAX],
        growth[MOR_CONTACT_GROWTHS * ASSEMBLY_MAX], mean[6 * ASSEMBLY_MAX];
} kept_soil;

/* One particle under a pressure over a floor that only presses, Pa; opens f. */
static mor_contact_soil open_pressed(floor_case *f, kept_soil *kept, int dimension, double pressure)
{
    static const double across[1] = {1.5};
    memset(kept, 0, sizeof *kept);
    floor_open_single(f, dimension, MOR_WALL_COULOMB, 0.3);
    mor_wall_request request = floor_request(f, MOR_WALL_COULOMB, 0.3);
    request.stress = MOR_WALL_STRESS_ALONG;
    floor_add(f, &request);
    f->presses_only = true;
    floor_set_stress(f, -pressure, 0.0);
    floor_run(f, MOR_DISSIPATION_BOTH);
    mor_contact_soil soil = floor_soil(f, MOR_DISSIPATION_BOTH);
    soil.gap = kept->gap;
    soil.gap_face = kept->face;
    soil.growth = kept->growth;
    soil.across = across;
    soil.depth = DEPTH;
    soil.length = 1e-3; /* s */
    return soil;
}

/* Acceleration across the floor of a particle whose stress diverges along it by what is given, Pa/m; m/s2. */
static double press_with(floor_case *f, const mor_contact_soil *soil, double divergence)
{
    const int axis = f->soil.constants.dimension - 1;
    memset(f->acceleration, 0, sizeof f->acceleration);
    f->wall.divergence[axis] = divergence; /* of the first lane of the only slot, along the face */
    mor_soil_contact_sum_forces(&f->soil.context, &f->wall, soil, f->acceleration);
    return f->acceleration[axis];
}

/* Makes the particle leave the floor at a speed; returns what of that the floor mirrors, 1. */
static double leave(floor_case *f, const mor_contact_soil *soil, double speed, kept_soil *kept)
{
    double face_growth[ASSEMBLY_MAX] = {0.0};
    const mor_contact_rates rates = {f->velocity_gradient, f->density_rate, kept->gap, kept->face, face_growth};
    floor_record(f)[MOR_RECORD_VELOCITY + f->soil.constants.dimension - 1] = speed;
    mor_soil_contact_add_growth(&f->soil.context, &f->wall, soil);
    mor_soil_contact_sum_gradient(&f->soil.context, &f->wall, soil, &rates);
    const double gradient = mor_vector_length(f->wall.sums + MOR_KERNEL_SUM_GRADIENT);
    assert_true(fabs(face_growth[0] - 2.0 * gradient * f->wall.closure[0] * speed) <= 1e-12 * gradient * speed);
    return f->wall.closure[0];
}

/* Strain by the mirrored part of motion away takes off the pressure, and no more: M times 2 grad W for each meter. */
static void mirrored_motion_takes_off_the_pressure(void **state)
{
    const double pressure = 4e3;
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        kept_soil kept;
        const mor_contact_soil soil = open_pressed(&f, &kept, dimension, pressure);
        const double mirrored = leave(&f, &soil, 10.0, &kept) * 10.0 * soil.length;
        const double *record = floor_record(&f);
        const double stiffness =
            1.5 * record[MOR_RECORD_IMPEDANCE] * record[MOR_RECORD_IMPEDANCE] / record[MOR_RECORD_DENSITY];
        const double gradient = mor_vector_length(f.wall.sums + MOR_KERNEL_SUM_GRADIENT);
        assert_true(mirrored < 10.0 * soil.length);                                       /* or nothing opens */
        assert_true(fabs(stiffness * 2.0 * gradient * mirrored / pressure - 1.0) < 1e-9); /* rounding */
        assert_true(fabs(kept.gap[0] + mirrored - 10.0 * soil.length) < 1e-12);
        floor_close(&f);
    }
}

/* Soil that is squeezed along a face moves away from it and stays pressed: where its volume does not grow nothing
 * opens, and the face presses on. */
static void soil_that_keeps_its_volume_keeps_in_touch(void **state)
{
    const double speed = 1e-4; /* m/s; waves of it are far below the pressure */
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        kept_soil kept;
        mor_contact_soil soil = open_pressed(&f, &kept, dimension, 4e3);
        soil.length = 10.0; /* s; or the motion is too small for the pressure */
        const double own = press_with(&f, &soil, 0.0);
        const double gradient = mor_vector_length(f.wall.sums + MOR_KERNEL_SUM_GRADIENT);
        kept.growth[MOR_CONTACT_GROWTH_REST] = -2.0 * gradient * speed; /* by the soil beside */
        assert_true(leave(&f, &soil, speed, &kept) == 1.0);
        assert_true(kept.gap[0] == 0.0);
        assert_true(fabs(press_with(&f, &soil, 0.0) - own) < 0.1 * own);
        kept.growth[MOR_CONTACT_GROWTH_REST] = 0.0;
        assert_true(press_with(&f, &soil, 0.0) < 0.2 * own); /* or the bound on the work tells nothing */
        floor_close(&f);
    }
}

/* What opens is shared by the faces that are left, or the pressure would be taken off by none: with another face that
 * the particle leaves as fast each mirrors half. */
static void faces_that_are_left_together_share_what_opens(void **state)
{
    const double pressure = 4e3;
    (void)state;
    for (int n_faces = 1; n_faces <= 3; ++n_faces) {
        floor_case f;
        kept_soil kept;
        double face_growth[ASSEMBLY_MAX] = {0.0};
        const mor_contact_soil soil = open_pressed(&f, &kept, 2, pressure);
        const mor_contact_rates rates = {f.velocity_gradient, f.density_rate, kept.gap, kept.face, face_growth};
        floor_record(&f)[MOR_RECORD_VELOCITY + 1] = 10.0;
        mor_soil_contact_add_growth(&f.soil.context, &f.wall, &soil);
        kept.growth[MOR_CONTACT_GROWTH_FACES] *= n_faces;
        kept.growth[MOR_CONTACT_GROWTH_LEFT] *= n_faces;
        mor_soil_contact_sum_gradient(&f.soil.context, &f.wall, &soil, &rates);
        const double *record = floor_record(&f);
        const double stiffness =
            1.5 * record[MOR_RECORD_IMPEDANCE] * record[MOR_RECORD_IMPEDANCE] / record[MOR_RECORD_DENSITY];
        assert_true(fabs(n_faces * stiffness * face_growth[0] * soil.length / pressure - 1.0) < 1e-9); /* rounding */
        floor_close(&f);
    }
}

/* A face that is left already has no part in the growth, and one that is met again that which closes no gap. */
static void open_face_takes_no_part_in_the_growth(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        kept_soil kept;
        const mor_contact_soil soil = open_pressed(&f, &kept, dimension, 4e3);
        double *velocity = floor_record(&f) + MOR_RECORD_VELOCITY + dimension - 1;
        const double gradient = mor_vector_length(f.wall.sums + MOR_KERNEL_SUM_GRADIENT);
        kept.gap[0] = 0.002; /* m */
        kept.face[0] = 1.0;  /* of the only patch of the first wall */
        *velocity = 10.0;
        mor_soil_contact_add_growth(&f.soil.context, &f.wall, &soil);
        assert_true(kept.growth[MOR_CONTACT_GROWTH_FACES] == 0.0 && kept.growth[MOR_CONTACT_GROWTH_LEFT] == 0.0);
        *velocity = -10.0;
        mor_soil_contact_add_growth(&f.soil.context, &f.wall, &soil);
        const double expected = -2.0 * gradient * (10.0 - 0.002 / soil.length);
        assert_true(fabs(kept.growth[MOR_CONTACT_GROWTH_FACES] - expected) < 1e-9 * gradient); /* rounding */
        assert_true(kept.growth[MOR_CONTACT_GROWTH_LEFT] == 0.0);
        floor_close(&f);
    }
}

/* Soil that is stretched across a face at a constant volume, until the face bears nothing more, leaves it. */
static void face_that_bears_nothing_more_opens(void **state)
{
    (void)state;
    floor_case f;
    kept_soil kept;
    mor_contact_soil soil = open_pressed(&f, &kept, 2, 4e3);
    kept.mean[1] = -2e3;
    soil.mean_stress = kept.mean;
    kept.growth[MOR_CONTACT_GROWTH_REST] = -1e6;
    floor_set_stress(&f, 1.9e3, 0.0);
    assert_true(leave(&f, &soil, 0.1, &kept) == 1.0);
    kept.growth[MOR_CONTACT_GROWTH_FACES] = kept.growth[MOR_CONTACT_GROWTH_LEFT] = 0.0;
    floor_set_stress(&f, 2.1e3, 0.0);
    assert_true(leave(&f, &soil, 0.1, &kept) == 0.0);
    floor_close(&f);
}

/* The force of a face that is left within a step: the mean of a pressure p that falls in proportion to the growth to -q
 * and is none from then on, where that comes within the step; and no more than at its beginning. What comes back to a
 * face is not bounded. */
static void face_that_is_left_presses_as_long_as_it_bears(void **state)
{
    static const double growths[] = {0.5, 1.0, 1.5, 2.0, 4.0, 100.0}; /* over (p + q) / (2 M) */
    const double p = 4e3;
    (void)state;
    for (int k = 0; k < 6; ++k) {
        for (int towards = 0; towards < 2; ++towards) {
            floor_case f;
            kept_soil kept;
            const double q = 1e3;
            mor_contact_soil soil = open_pressed(&f, &kept, 3, p);
            const double unit = press_with(&f, &soil, 0.0) / p;
            double *record = floor_record(&f);
            const double stiffness =
                1.5 * record[MOR_RECORD_IMPEDANCE] * record[MOR_RECORD_IMPEDANCE] / record[MOR_RECORD_DENSITY];
            kept.mean[MOR_ZZ] = -q;
            soil.mean_stress = kept.mean;
            record[MOR_RECORD_VELOCITY + 2] = towards ? -1e-12 : 1e-12; /* m/s; waves of it are rounding */
            kept.growth[MOR_CONTACT_GROWTH_REST] = growths[k] * (p + q) / (2.0 * stiffness) / soil.length;
            const double lasts = fmin(2.0 / growths[k], 1.0); /* part of the step */
            const double mean = growths[k] < 2.0 ? (p + q) / growths[k] - q : lasts * (p - q) / 2.0;
            const double expected = towards ? p : fmin(mean, p);
            assert_true(fabs(press_with(&f, &soil, 0.0) / unit - expected) < 1e-6 * p); /* the waves */
            floor_close(&f);
        }
    }
}

/* The growth of the last step is that of the density, less what faces mirrored. */
static void growth_of_the_soil_is_that_without_faces(void **state)
{
    (void)state;
    floor_case f;
    kept_soil kept;
    const mor_contact_soil soil = open_pressed(&f, &kept, 2, 4e3);
    const double rate[ASSEMBLY_MAX] = {-0.3 * floor_record(&f)[MOR_RECORD_DENSITY]};
    const double mirrored[ASSEMBLY_MAX] = {0.1};
    kept.growth[MOR_CONTACT_GROWTH_FACES] = kept.growth[MOR_CONTACT_GROWTH_LEFT] = 1.0;
    mor_soil_contact_find_growth(&f.soil.context, &soil, rate, mirrored);
    assert_true(fabs(kept.growth[MOR_CONTACT_GROWTH_REST] - 0.2) < 1e-15);
    assert_true(kept.growth[MOR_CONTACT_GROWTH_FACES] == 0.0 && kept.growth[MOR_CONTACT_GROWTH_LEFT] == 0.0);
    floor_close(&f);
}

/* A face bears as tension for a moment what it has borne as pressure, and no more. */
static void face_holds_as_much_as_it_has_borne(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        kept_soil kept;
        mor_contact_soil soil = open_pressed(&f, &kept, dimension, 4e3);
        const double unit = press_with(&f, &soil, 0.0) / 4e3;
        kept.mean[dimension - 1] = -2e3;
        soil.mean_stress = kept.mean;
        for (int k = 0; k < 5; ++k) {
            const double tension = 1e3 * k;
            floor_set_stress(&f, tension, 0.0);
            const double pull = -press_with(&f, &soil, 0.0) / unit;
            assert_true(fabs(pull - fmin(tension, 2e3)) < 1e-9 * 4e3); /* rounding */
        }
        floor_close(&f);
    }
}

/* What continues the stress adds no more than the force of the particle's own, and takes no more away. */
static void continued_stress_is_bounded_by_the_pressure(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        kept_soil kept;
        const mor_contact_soil soil = open_pressed(&f, &kept, dimension, 4e3);
        assert_int_equal(f.wall.n_slots, 1);
        const double own = press_with(&f, &soil, 0.0);
        const double unit = 1.0; /* Pa/m */
        const double rate = (press_with(&f, &soil, unit) - own) / unit;
        assert_true(own > 0.0 && rate > 0.0);
        for (int k = -8; k <= 8; ++k) { /* to four times the bound */
            const double continued = 0.5 * k * own;
            const double along = press_with(&f, &soil, continued / rate);
            const double bounded = fmax(fmin(continued, own), -own);
            assert_true(fabs(along - own - bounded) < 1e-9 * own); /* the rate is a difference, rounded */
        }
        floor_close(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(face_mirrors_what_goes_beyond_the_nearest_place_so_far),
        cmocka_unit_test(faces_at_any_angles_have_gaps_of_their_own),
        cmocka_unit_test(gap_lasts_as_long_as_its_face_is_seen),
        cmocka_unit_test(pressure_is_taken_off_before_a_gap_opens),
        cmocka_unit_test(faces_beyond_those_that_are_kept_are_touched),
        cmocka_unit_test(faces_are_numbered_one_after_the_other),
        cmocka_unit_test(what_is_near_a_face_touches_it),
        cmocka_unit_test(mirrored_motion_takes_off_the_pressure),
        cmocka_unit_test(soil_that_keeps_its_volume_keeps_in_touch),
        cmocka_unit_test(face_holds_as_much_as_it_has_borne),
        cmocka_unit_test(faces_that_are_left_together_share_what_opens),
        cmocka_unit_test(open_face_takes_no_part_in_the_growth),
        cmocka_unit_test(face_that_bears_nothing_more_opens),
        cmocka_unit_test(face_that_is_left_presses_as_long_as_it_bears),
        cmocka_unit_test(growth_of_the_soil_is_that_without_faces),
        cmocka_unit_test(continued_stress_is_bounded_by_the_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
