/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Walls that continue the soil's stress: a lattice of soil on a lattice of wall must feel a linear stress as if the
 * soil went on for ever. */
#include "tests/common/floor.h"

/* Along x and up, Pa/m, and at the origin, Pa. */
#define SLOPE 2e5
#define LEVEL -5e3

/* Stresses that vary: the normal one along the floor with the place along it, the vertical one with height, and the
 * shear stress with the place along the floor. */
typedef enum field { FIELD_ALONG, FIELD_UPWARD, FIELD_SHEAR, FIELDS } field;

static const mor_wall_stress stresses[] = {MOR_WALL_STRESS_UNIFORM, MOR_WALL_STRESS_ALONG, MOR_WALL_STRESS_LINEAR};

/* Moments of the kernel gradient over a lattice: of the part below the surface, where the floor is, or of all of it. */
static double lattice_moment(const assembly *a, int component, bool is_wall)
{
    const int dimension = a->constants.dimension;
    const int up = dimension - 1;
    double sum = 0.0;
    for (int place = 0; place < 7 * 7 * 7; ++place) {
        const double r[3] = {ASSEMBLY_SPACING * (place % 7 - 3), ASSEMBLY_SPACING * (place / 7 % 7 - 3),
                             dimension == 3 ? ASSEMBLY_SPACING * (place / 49 - 3) : 0.0};
        const double distance = mor_vector_length(r);
        const bool is_counted = (dimension == 3 || place < 49) && (!is_wall || r[up] < 0.0) && distance > 0.0;
        if (is_counted) {
            const double slope = mor_kernel_derivative(distance, a->constants.smoothing_length, dimension);
            sum -= floor_cell(dimension) * slope * r[component] * r[component] / distance;
        }
    }
    return sum;
}

/* Three layers of soil on the floor, in plane strain seven particles wide, else five, at rest under a linear stress. */
static void open_lattice(floor_case *f, int dimension, field kind)
{
    double points[3 * ASSEMBLY_MAX] = {0.0};
    const int side = dimension == 2 ? 7 : 5;
    const int up = dimension - 1;
    int n = 0;
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < (dimension == 3 ? side : 1); ++y) {
            for (int layer = 0; layer < 3; ++layer, ++n) {
                points[3 * n] = ASSEMBLY_SPACING * (x - side / 2);
                points[3 * n + 1] = dimension == 3 ? ASSEMBLY_SPACING * (y - side / 2) : 0.0;
                points[3 * n + up] = ASSEMBLY_SPACING * (layer + 0.5);
            }
        }
    }
    assembly_open(&f->soil, dimension, points, n);
    f->soil.constants.has_artificial_stress = false;
    for (int i = 0; i < n; ++i) {
        double *record = f->soil.records + i * MOR_RECORD_SIZE;
        memset(record + MOR_RECORD_VELOCITY, 0, 3 * sizeof *record);
        memset(record + MOR_RECORD_STRESS, 0, 6 * sizeof *record);
        record[MOR_RECORD_VOLUME] = floor_cell(dimension);
        record[MOR_RECORD_DENSITY] = ASSEMBLY_DENSITY;
        record[MOR_RECORD_IMPEDANCE] = ASSEMBLY_DENSITY * ASSEMBLY_SOUND;
        for (int a = 0; a < 3; ++a) {
            record[MOR_RECORD_STRESS + a] = LEVEL * (1.0 + 0.25 * a);
        }
        const int shear = dimension == 2 ? MOR_XY : MOR_ZX;
        const int component = kind == FIELD_ALONG ? 0 : kind == FIELD_UPWARD ? up : shear;
        record[MOR_RECORD_STRESS + component] += SLOPE * record[kind == FIELD_UPWARD ? up : 0];
        record[MOR_RECORD_PRESSURE] = -mor_symmetric_trace(record + MOR_RECORD_STRESS) / 3.0;
    }
    floor_open(f, MOR_WALL_ROUGH, 0.0);
}

/* The particle in the middle of the lowest layer. */
static int find_center(const floor_case *f)
{
    for (int i = 0; i < f->soil.n; ++i) {
        const double *record = f->soil.records + i * MOR_RECORD_SIZE;
        const int up = f->soil.constants.dimension - 1;
        const double across = up == 2 ? fabs(record[0]) + fabs(record[1]) : fabs(record[0]);
        if (across < 0.1 * ASSEMBLY_SPACING && record[up] < ASSEMBLY_SPACING) {
            return i;
        }
    }
    return -1;
}

/* The acceleration that the middle of the lowest layer should get. The soil carries what the wall leaves of the whole
 * lattice's moment, and the continued wall makes it up; a smooth wall's image has the opposite shear. */
static double expected_acceleration(const assembly *a, field kind, mor_wall_friction friction, mor_wall_stress stress)
{
    const int gradient_axis = kind == FIELD_UPWARD ? a->constants.dimension - 1 : 0;
    const double all = lattice_moment(a, gradient_axis, false);
    const double wall = lattice_moment(a, gradient_axis, true);
    assert_true(wall > 0.2 && wall < 0.5 && fabs(all - 1.0) < 0.05);
    const bool is_continued =
        stress == MOR_WALL_STRESS_LINEAR || (stress == MOR_WALL_STRESS_ALONG && kind != FIELD_UPWARD);
    const double sign = kind == FIELD_SHEAR && friction == MOR_WALL_SMOOTH ? -1.0 : 1.0;
    const double factor = is_continued ? 1.0 + sign * wall / (1.0 - wall) : 1.0;
    return SLOPE / ASSEMBLY_DENSITY * (all - wall) * factor;
}

static void linear_stress_is_felt_in_full_at_the_wall(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * FIELDS * 2 * 3; ++option) {
        const int dimension = 2 + option % 2;
        const field kind = (field)(option / 2 % FIELDS);
        const mor_wall_friction friction = option / 6 % 2 == 0 ? MOR_WALL_ROUGH : MOR_WALL_SMOOTH;
        floor_case f;
        assembly_sums sums;
        open_lattice(&f, dimension, kind);
        mor_wall_request request = floor_request(&f, friction, 0.0);
        request.stress = stresses[option / 12];
        floor_add(&f, &request);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        assembly_run(&f.soil, mor_pair_select(NULL), 1000, &sums);
        const int center = find_center(&f);
        assert_true(center >= 0);
        double expected[3] = {0.0, 0.0, 0.0};
        expected[kind == FIELD_ALONG ? 0 : dimension - 1] =
            expected_acceleration(&f.soil, kind, friction, request.stress);
        double total[3];
        for (int a = 0; a < 3; ++a) {
            total[a] = sums.acceleration[3 * center + a] + f.acceleration[3 * center + a];
        }
        /* Terms of the size 2 stress / density / spacing cancel. */
        floor_assert_vector(total, expected, 4e4 / ASSEMBLY_DENSITY / ASSEMBLY_SPACING);
        floor_close(&f);
    }
}

/* Random soil near the floor. */
static void open_layer(floor_case *f, int dimension, mor_wall_friction friction, mor_wall_stress stress)
{
    assembly_open_lattice(&f->soil, dimension, dimension == 2 ? 11 : 5, 3, 0.3);
    for (int i = 0; i < f->soil.n; ++i) {
        f->soil.records[i * MOR_RECORD_SIZE + dimension - 1] += 0.9 * ASSEMBLY_SPACING;
        f->soil.records[i * MOR_RECORD_SIZE] -= 1.5 * ASSEMBLY_SPACING;
    }
    assembly_list(&f->soil, 0.0);
    floor_open(f, friction, 0.3);
    mor_wall_request request = floor_request(f, friction, 0.3);
    request.stress = stress;
    floor_add(f, &request);
}

/* The sums of V_j (stress_j - stress_i) . grad_i W by a double loop: along, then across the direction of a gradient;
 * zero where there is none. */
static double divergence_of(const assembly *a, int i, const double *gradient, double *divergence)
{
    const double *own = a->records + i * MOR_RECORD_SIZE;
    const double length2 = mor_vector_dot(gradient, gradient);
    double size = 0.0;
    memset(divergence, 0, 6 * sizeof *divergence);
    for (int j = 0; j < a->n && length2 > 0.0; ++j) {
        const double *other = a->records + j * MOR_RECORD_SIZE;
        const double r[3] = {own[0] - other[0], own[1] - other[1], own[2] - other[2]};
        const double distance = mor_vector_length(r);
        if (j == i) {
            continue;
        }
        const double slope = mor_kernel_derivative(distance, a->constants.smoothing_length, a->constants.dimension);
        const double factor = other[MOR_RECORD_VOLUME] * slope / distance;
        double jump[6];
        for (int c = 0; c < 6; ++c) {
            jump[c] = other[MOR_RECORD_STRESS + c] - own[MOR_RECORD_STRESS + c];
            size += fabs(jump[c] * factor) * distance;
        }
        const double across = mor_vector_dot(r, gradient) / length2;
        double parts[2][3];
        for (int c = 0; c < 3; ++c) {
            parts[1][c] = factor * across * gradient[c];
            parts[0][c] = factor * r[c] - parts[1][c];
        }
        for (int part = 0; part < 2; ++part) {
            double term[3];
            mor_symmetric_apply(jump, parts[part], term);
            for (int c = 0; c < 3; ++c) {
                divergence[3 * part + c] += term[c];
            }
        }
    }
    return size;
}

static void divergence_of_every_table_is_that_of_a_double_loop(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * n_tables; ++option) {
        floor_case f;
        open_layer(&f, 2 + option % 2, MOR_WALL_ROUGH, MOR_WALL_STRESS_LINEAR);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        mor_soil_contact_sum_divergence(&f.soil.context, &f.wall, tables[option / 2], &f.soil.constants, f.soil.records,
                                        &f.soil.relation, NULL);
        int n_touching = 0;
        for (int64_t slot = 0; slot < MOR_CLUSTER * f.wall.relation.n_occupied; ++slot) {
            const int i = f.wall.relation.occupied[slot / MOR_CLUSTER] * MOR_CLUSTER + (int)(slot % MOR_CLUSTER);
            if (i >= f.soil.n) {
                continue;
            }
            const double *gradient = f.wall.sums + MOR_KERNEL_SUMS * slot + MOR_KERNEL_SUM_GRADIENT;
            double expected[6];
            const double size = divergence_of(&f.soil, i, gradient, expected);
            n_touching += mor_vector_length(gradient) > 0.0;
            floor_assert_vector(f.wall.divergence + 6 * slot, expected, size);
            floor_assert_vector(f.wall.divergence + 6 * slot + 3, expected + 3, size);
        }
        assert_true(n_touching > 5);
        floor_close(&f);
    }
}

/* Roundings of 2^-24 that a sum in single precision meets: of its terms, those of places among them, and of up to 64
 * additions. */
#define SINGLE_ROUNDING ((64 + 64) * 0x1p-24)

/* Of the products of a particle's sums, whose stresses are rounded before they are subtracted, Pa/m. */
static double largest_terms(const assembly *a, int i)
{
    const double *own = a->records + i * MOR_RECORD_SIZE;
    double stress = 0.0;
    double weight = 0.0;
    for (int j = 0; j < a->n; ++j) {
        const double *other = a->records + j * MOR_RECORD_SIZE;
        const double r[3] = {own[0] - other[0], own[1] - other[1], own[2] - other[2]};
        const double distance = mor_vector_length(r);
        stress = fmax(stress, assembly_largest(other + MOR_RECORD_STRESS, 6));
        if (j != i) {
            weight += other[MOR_RECORD_VOLUME] *
                      fabs(mor_kernel_derivative(distance, a->constants.smoothing_length, a->constants.dimension));
        }
    }
    return 6.0 * stress * weight;
}

/* Compares with the divergence as it was, shape [slots * 8, 6], Pa/m; returns the largest difference, Pa/m.
 * rounding: allowed over the largest terms */
static double compare_divergence(const floor_case *f, const double *before, double rounding)
{
    double error = 0.0;
    for (int64_t lane = 0; lane < f->wall.n_slots * MOR_CLUSTER; ++lane) {
        const int i = f->wall.slots[lane / MOR_CLUSTER].cluster * MOR_CLUSTER + (int)(lane % MOR_CLUSTER);
        for (int k = 0; i < f->soil.n && k < 6; ++k) {
            const double off = fabs(f->wall.divergence[6 * lane + k] - before[6 * lane + k]);
            assert_true(off <= rounding * largest_terms(&f->soil, i));
            error = fmax(error, off);
        }
    }
    return error;
}

static void divergence_in_mixed_precision_differs_by_roundings(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    const mor_images none = {0};
    for (int option = 0; option < 2 * n_tables; ++option) {
        floor_case f;
        open_layer(&f, 2 + option % 2, MOR_WALL_ROUGH, MOR_WALL_STRESS_LINEAR);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        mor_context *context = &f.soil.context;
        mor_pair_arrays arrays = {.n_particles = f.soil.n, .records = f.soil.records};
        mor_pair_singles singles = {0};
        double in_double[6 * ASSEMBLY_MAX];
        memcpy(in_double, f.wall.divergence, 6 * (size_t)f.wall.n_slots * MOR_CLUSTER * sizeof *in_double);
        assert_int_equal(mor_pair_singles_pack(context, &f.soil.constants, &none, &singles, &arrays), MOR_OK);
        mor_soil_contact_sum_divergence(context, &f.wall, tables[option / 2], &f.soil.constants, f.soil.records,
                                        &f.soil.relation, &singles);
        /* They were summed in single precision. */
        assert_true(compare_divergence(&f, in_double, SINGLE_ROUNDING) > 0.0);
        /* A cluster that is too wide for places modulo 2^32 is summed in double. */
        memset(singles.is_wide, 1, (size_t)f.soil.tree.n_clusters);
        mor_soil_contact_sum_divergence(context, &f.wall, tables[option / 2], &f.soil.constants, f.soil.records,
                                        &f.soil.relation, &singles);
        compare_divergence(&f, in_double, 256 * DBL_EPSILON); /* some ulp of each term */
        mor_pair_singles_clear(context, &singles);
        floor_close(&f);
    }
}

static void wide_registers_give_the_same_divergence_as_wider_ones(void **state)
{
    (void)state;
    const mor_pair_table *avx2 = mor_pair_select("avx2");
    const mor_pair_table *avx512 = mor_pair_select("avx512");
    if (avx2 == NULL || avx512 == NULL) {
        skip();
    }
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        open_layer(&f, dimension, MOR_WALL_ROUGH, MOR_WALL_STRESS_LINEAR);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        const size_t n_bytes = (size_t)f.wall.relation.n_occupied * MOR_CLUSTER * 6 * sizeof(double);
        double narrow[6 * ASSEMBLY_MAX];
        mor_soil_contact_sum_divergence(&f.soil.context, &f.wall, avx2, &f.soil.constants, f.soil.records,
                                        &f.soil.relation, NULL);
        memcpy(narrow, f.wall.divergence, n_bytes);
        mor_soil_contact_sum_divergence(&f.soil.context, &f.wall, avx512, &f.soil.constants, f.soil.records,
                                        &f.soil.relation, NULL);
        assert_memory_equal(narrow, f.wall.divergence, n_bytes);
        floor_close(&f);
    }
}

static void continued_wall_gives_back_what_it_takes(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * 3 * 3; ++option) {
        floor_case f;
        open_layer(&f, 2 + option % 2, (mor_wall_friction)(option / 2 % 3), stresses[option / 6]);
        floor_run(&f, MOR_DISSIPATION_BOTH);
        double force[3] = {0.0, 0.0, 0.0};
        double size = 0.0;
        for (int k = 0; k < 3 * f.soil.n; ++k) {
            const double *record = f.soil.records + k / 3 * MOR_RECORD_SIZE;
            const double part = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME] * f.acceleration[k];
            force[k % 3] -= part;
            size += fabs(part);
        }
        assert_true(size > 0.0);
        floor_assert_vector(f.wall.force, force, size);
        floor_close(&f);
    }
}

/* Acceleration along and across a Coulomb wall of the middle of the lowest layer, m/s2, when all soil slides along it
 * at a multiple of the speed of a wave as large as the pressure on the wall. */
static void slide_soil(floor_case *f, double multiple, double *along, double *across)
{
    const int up = f->soil.constants.dimension - 1;
    const double *middle = f->soil.records + find_center(f) * MOR_RECORD_SIZE;
    const double wave_speed = -middle[MOR_RECORD_STRESS + up] / middle[MOR_RECORD_IMPEDANCE];
    for (int i = 0; i < f->soil.n; ++i) {
        f->soil.records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY] = multiple * wave_speed;
    }
    floor_run(f, MOR_DISSIPATION_BOTH);
    *along = f->acceleration[3 * find_center(f)];
    *across = f->acceleration[3 * find_center(f) + up];
}

static void stress_continued_along_a_coulomb_wall_fades_where_soil_slides(void **state)
{
    (void)state;
    const double coefficient = 0.3;
    static const double multiples[] = {0.7, 1.0, 1.25, 1.5, 2.0, 3.0};
    static const double kept[] = {1.0, 1.0, 0.75, 0.5, 0.0, 0.0};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        floor_case f;
        open_lattice(&f, dimension, FIELD_ALONG);
        mor_wall_request request = floor_request(&f, MOR_WALL_COULOMB, coefficient);
        request.stress = MOR_WALL_STRESS_ALONG;
        floor_add(&f, &request);
        f.presses_only = true;
        const double wall = lattice_moment(&f.soil, 0, true);
        const double soil = lattice_moment(&f.soil, 0, false) - wall;
        const double continued = SLOPE / ASSEMBLY_DENSITY * soil * wall / (1.0 - wall);
        for (int k = 0; k < 6; ++k) {
            double along = 0.0;
            double across = 0.0;
            slide_soil(&f, multiples[k], &along, &across);
            assert_true(across > 0.0);
            /* Friction is the limit against the motion at all these speeds. Sums of some hundred terms. */
            const double expected = kept[k] * continued - coefficient * across;
            assert_true(fabs(along - expected) <= 1e-11 * (continued + across));
        }
        floor_close(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stress_continued_along_a_coulomb_wall_fades_where_soil_slides),
        cmocka_unit_test(linear_stress_is_felt_in_full_at_the_wall),
        cmocka_unit_test(divergence_of_every_table_is_that_of_a_double_loop),
        cmocka_unit_test(divergence_in_mixed_precision_differs_by_roundings),
        cmocka_unit_test(wide_registers_give_the_same_divergence_as_wider_ones),
        cmocka_unit_test(continued_wall_gives_back_what_it_takes),
    };
    return CLOUD_RUN(tests);
}
