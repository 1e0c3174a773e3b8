/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil against boundaries of several patches, in one step, against plain loops over all pairs. */
#include "core/base/memory.h"
#include "core/sph/boundary/soil_contact.h"
#include "tests/common/assembly.h"

#include <float.h>

enum { PATCHES_MAX = 4, POINTS_MAX = 256 };

/* Soil and a boundary of boxes of points. */
typedef struct meeting {
    assembly soil;
    mor_boundary boundary;
    mor_boundary_patch patches[PATCHES_MAX];
    double records[(POINTS_MAX + 8) * MOR_BOUNDARY_RECORD];
    double force[3 * POINTS_MAX];
    mor_soil_contact contact;
    double acceleration[3 * ASSEMBLY_MAX];
} meeting;

/* Adds a patch: a box of points with its lowest corner at a place, in spacings, that moves and turns. */
static void add_patch(meeting *m, const double *corner, const int *sides, mor_wall_friction friction)
{
    mor_boundary *b = &m->boundary;
    const int dimension = m->soil.constants.dimension;
    const int p = b->n_patches++;
    const int n = sides[0] * sides[1] * (dimension == 3 ? sides[2] : 1);
    m->patches[p] =
        (mor_boundary_patch){.first = b->n_points, .n_points = n, .friction = friction, .friction_coefficient = 0.3};
    for (int j = 0; j < n; ++j) {
        double *record = m->records + MOR_BOUNDARY_RECORD * b->n_points;
        const int place[3] = {j % sides[0], j / sides[0] % sides[1], j / (sides[0] * sides[1])};
        const uint64_t id = (uint64_t)b->n_points++;
        for (int a = 0; a < dimension; ++a) {
            record[a] = ASSEMBLY_SPACING * (corner[a] + place[a] + 0.1 * cloud_number(id, 70 + (uint64_t)a, -1.0, 1.0));
            record[MOR_BOUNDARY_VELOCITY + a] = cloud_number(id, 80 + (uint64_t)a, -1.0, 1.0);
        }
        record[MOR_BOUNDARY_VOLUME] = pow(ASSEMBLY_SPACING, dimension) * cloud_number(id, 90, 0.9, 1.1);
    }
    assert_true(b->n_points <= POINTS_MAX);
}

static void begin(meeting *m)
{
    memset(&m->boundary, 0, sizeof m->boundary);
    memset(m->records, 0, sizeof m->records);
    memset(m->patches, 0, sizeof m->patches);
    strcpy(m->boundary.name, "rocks");
    m->boundary.records = m->records;
    m->boundary.patches = m->patches;
    m->boundary.force = m->force;
}

static void borrow(meeting *m, mor_wall_stress stress)
{
    assert_int_equal(mor_soil_contact_borrow(&m->soil.context, &m->contact, &m->boundary, stress,
                                             m->soil.constants.dimension, m->soil.tree.n_clusters),
                     MOR_OK);
}

/* Soil of some particles with a rock on two sides and one apart. */
static meeting *open_meeting(int dimension, mor_wall_stress stress)
{
    meeting *m = calloc(1, sizeof *m);
    assert_non_null(m);
    assembly_open_mixed(&m->soil, dimension);
    begin(m);
    const double below[3] = {-1.0, -4.0, -1.0};
    const double beside[3] = {dimension == 2 ? 7.8 : 3.8, 1.0, 0.0};
    const double far[3] = {50.0, 50.0, 50.0};
    add_patch(m, below, dimension == 2 ? (const int[3]){9, 3, 1} : (const int[3]){5, 3, 5}, MOR_WALL_ROUGH);
    add_patch(m, beside, (const int[3]){3, 4, 4}, MOR_WALL_COULOMB);
    add_patch(m, far, (const int[3]){3, 2, 2}, MOR_WALL_SMOOTH);
    borrow(m, stress);
    return m;
}

static void close_meeting(meeting *m)
{
    mor_soil_contact_clear(&m->soil.context, &m->contact);
    assembly_close(&m->soil);
    free(m);
}

static void run(meeting *m, const mor_pair_table *table)
{
    mor_context *context = &m->soil.context;
    const mor_pair_constants *c = &m->soil.constants;
    const mor_relation_points points = {&m->soil.tree, m->soil.records, MOR_RECORD_SIZE};
    const double reach = MOR_KERNEL_SUPPORT * c->smoothing_length + 0.2 * ASSEMBLY_SPACING;
    memset(m->acceleration, 0, sizeof m->acceleration);
    assert_int_equal(mor_soil_contact_build(context, &m->contact, &points, reach), MOR_OK);
    mor_soil_contact_sum(context, &m->contact, table, c, m->soil.records);
    mor_soil_contact_sum_divergence(context, &m->contact, table, c, m->soil.records, &m->soil.relation, NULL);
    /* Where tension is held, friction limits the same at walls and rocks. */
    const mor_contact_soil seen = {.dissipation = MOR_DISSIPATION_BOTH,
                                   .coulomb_pulls = true,
                                   .limiter_rate = c->limiter_rate,
                                   .records = m->soil.records,
                                   .n_particles = m->soil.n};
    mor_soil_contact_sum_forces(context, &m->contact, &seen, m->acceleration);
    mor_soil_contact_share_forces(context, &m->contact, table, c, m->soil.records, m->soil.n);
}

static void cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; ++k) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static void slots_are_the_runs_of_the_lists(void **state)
{
    (void)state;
    meeting *m = open_meeting(3, MOR_WALL_STRESS_UNIFORM);
    run(m, mor_pair_select(NULL));
    const mor_relation *relation = &m->contact.relation;
    int64_t n_entries = 0;
    assert_true(m->contact.n_slots > relation->n_occupied); /* some clusters see two rocks */
    for (int64_t s = 0; s < m->contact.n_slots; ++s) {
        const mor_pair_slot *slot = &m->contact.slots[s];
        n_entries += slot->count;
        assert_true(slot->count > 0 && slot->patch < 2);
        for (int k = 0; k < slot->count; ++k) {
            const int64_t inside = slot->list[k] - m->patches[slot->patch].first;
            assert_true(inside >= 0 && inside < m->patches[slot->patch].n_points);
        }
        assert_true(s == 0 || slot->cluster > slot[-1].cluster ||
                    (slot->cluster == slot[-1].cluster && slot->patch > slot[-1].patch));
    }
    assert_int_equal(n_entries, relation->n_entries);
    close_meeting(m);
}

/* Whether any particle of a slot reaches a point. */
static bool is_reached(const meeting *m, const mor_pair_slot *slot, int32_t point)
{
    const double *place = m->records + MOR_BOUNDARY_RECORD * (int64_t)point;
    bool is = false;
    for (int64_t i = (int64_t)slot->cluster * MOR_CLUSTER; i < (slot->cluster + 1) * (int64_t)MOR_CLUSTER; ++i) {
        const double *own = m->soil.records + i * MOR_RECORD_SIZE;
        const double r[3] = {own[0] - place[0], own[1] - place[1], own[2] - place[2]};
        is |= i < m->soil.n && mor_vector_length(r) < MOR_KERNEL_SUPPORT * m->soil.constants.smoothing_length;
    }
    return is;
}

static void short_lists_of_slots_hold_the_points_in_reach_alone(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * n_tables; ++option) {
        meeting *m = open_meeting(2 + option % 2, MOR_WALL_STRESS_UNIFORM);
        run(m, tables[option / 2]);
        int64_t n_left_out = 0;
        for (int64_t s = 0; s < m->contact.n_slots; ++s) {
            const mor_pair_slot *slot = &m->contact.slots[s];
            int32_t n_near = 0;
            for (int32_t k = 0; k < slot->count; ++k) {
                if (is_reached(m, slot, slot->list[k])) {
                    assert_true(n_near < slot->n_near);
                    assert_int_equal(slot->near[n_near++], slot->list[k]);
                }
            }
            assert_int_equal(slot->n_near, n_near);
            n_left_out += slot->count - n_near;
        }
        assert_true(n_left_out > 0);
        close_meeting(m);
    }
}

static void velocity_of_a_rock_is_the_mean_by_kernel_values(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * n_tables; ++option) {
        meeting *m = open_meeting(2 + option % 2, MOR_WALL_STRESS_UNIFORM);
        run(m, tables[option / 2]);
        const double h = m->soil.constants.smoothing_length;
        int n_seen = 0;
        for (int64_t lane = 0; lane < MOR_CLUSTER * m->contact.n_slots; ++lane) {
            const mor_pair_slot *slot = &m->contact.slots[lane / MOR_CLUSTER];
            const int64_t i = (int64_t)slot->cluster * MOR_CLUSTER + lane % MOR_CLUSTER;
            double sum[3] = {0.0, 0.0, 0.0};
            double total = 0.0;
            for (int64_t j = 0; j < m->patches[slot->patch].n_points && i < m->soil.n; ++j) {
                const double *point = m->records + MOR_BOUNDARY_RECORD * (m->patches[slot->patch].first + j);
                const double *own = m->soil.records + i * MOR_RECORD_SIZE;
                const double r[3] = {own[0] - point[0], own[1] - point[1], own[2] - point[2]};
                const double w =
                    point[MOR_BOUNDARY_VOLUME] * mor_kernel_value(mor_vector_length(r), h, m->soil.constants.dimension);
                total += w;
                for (int a = 0; a < 3; ++a) {
                    sum[a] += w * point[MOR_BOUNDARY_VELOCITY + a];
                }
            }
            n_seen += total > 0.0;
            for (int a = 0; a < 3 && i < m->soil.n; ++a) {
                const double expected = total > 0.0 ? sum[a] / total : 0.0;
                const double found = m->contact.mean_velocity[3 * lane + a];
                assert_true(fabs(found - expected) <= 1e-9); /* 1 m/s; near the rim of the kernel little is left */
            }
        }
        assert_true(n_seen > 10);
        close_meeting(m);
    }
}

/* Force and moment of every patch by points, as given by particles, and as reported. */
static void forces_on_points_have_force_and_moment_of_the_push(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * 2 * n_tables; ++option) {
        meeting *m =
            open_meeting(2 + option % 2, option / 2 % 2 == 0 ? MOR_WALL_STRESS_UNIFORM : MOR_WALL_STRESS_ALONG);
        run(m, tables[option / 4]);
        for (int p = 0; p < m->boundary.n_patches; ++p) {
            const mor_boundary_patch *patch = &m->patches[p];
            double force[3] = {0.0, 0.0, 0.0};
            double moment[3] = {0.0, 0.0, 0.0};
            double size = 0.0;
            for (int64_t j = patch->first; j < patch->first + patch->n_points; ++j) {
                double part[3];
                cross(m->records + MOR_BOUNDARY_RECORD * j, m->force + 3 * j, part);
                size += mor_vector_length(m->force + 3 * j);
                for (int a = 0; a < 3; ++a) {
                    force[a] += m->force[3 * j + a];
                    moment[a] += part[a];
                }
            }
            assert_true(p == 2 ? size == 0.0 : size > 0.0); /* the third is far away */
            for (int a = 0; a < 3; ++a) {
                const bool is_turn = m->soil.constants.dimension == 3 || a == 2;
                assert_true(fabs(force[a] - patch->force[a]) <= 1e-13 * size); /* a hundred roundings */
                assert_true(!is_turn || fabs(moment[a] - patch->moment[a]) <= 1e-13 * size * 10.0 * ASSEMBLY_SPACING);
            }
        }
        close_meeting(m);
    }
}

static void rocks_get_what_the_soil_loses(void **state)
{
    (void)state;
    meeting *m = open_meeting(3, MOR_WALL_STRESS_LINEAR);
    run(m, mor_pair_select(NULL));
    double sum[3] = {0.0, 0.0, 0.0};
    double moment[3] = {0.0, 0.0, 0.0};
    double size = 0.0;
    for (int i = 0; i < m->soil.n; ++i) {
        const double *record = m->soil.records + i * MOR_RECORD_SIZE;
        double force[3];
        double part[3];
        for (int a = 0; a < 3; ++a) {
            force[a] = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY] * m->acceleration[3 * i + a];
            sum[a] += force[a];
        }
        cross(record, force, part);
        size += mor_vector_length(force);
        for (int a = 0; a < 3; ++a) {
            moment[a] += part[a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        for (int p = 0; p < 3; ++p) {
            sum[a] += m->patches[p].force[a];
            moment[a] += m->patches[p].moment[a];
        }
        assert_true(fabs(sum[a]) <= 1e-14 * size); /* the same products in another order */
        assert_true(fabs(moment[a]) <= 1e-14 * size * 10.0 * ASSEMBLY_SPACING);
    }
    close_meeting(m);
}

/* A grain between two rocks feels each with its own normal: the two together are the sum of each alone. */
static void grain_between_two_rocks_feels_each_alone(void **state)
{
    (void)state;
    double acceleration[3][3];
    for (int which = 0; which < 3; ++which) {
        meeting *m = calloc(1, sizeof *m);
        const double point[3] = {0.0, 0.0, 0.0};
        assembly_open(&m->soil, 3, point, 1);
        double *stress = m->soil.records + MOR_RECORD_STRESS;
        memcpy(stress, ((const double[6]){-8e3, -5e3, -4e3, 1e3, 2e3, -1e3}), 6 * sizeof *stress);
        memset(m->soil.records + MOR_RECORD_VELOCITY, 0, 3 * sizeof *stress);
        assembly_list(&m->soil, 0.0);
        begin(m);
        if (which != 1) {
            add_patch(m, (const double[3]){-3.0, -1.0, -1.0}, (const int[3]){3, 3, 3}, MOR_WALL_SMOOTH);
        }
        if (which != 0) {
            /* Drawn anew from the same numbers, so that the rock alone is the rock of the pair. */
            const int64_t n = m->boundary.n_points;
            m->boundary.n_points = 27;
            add_patch(m, (const double[3]){0.9, -1.0, -1.0}, (const int[3]){3, 3, 3}, MOR_WALL_COULOMB);
            m->boundary.n_points = n + 27;
            m->patches[m->boundary.n_patches - 1].first = n;
            memmove(m->records + MOR_BOUNDARY_RECORD * n, m->records + MOR_BOUNDARY_RECORD * 27,
                    27 * MOR_BOUNDARY_RECORD * sizeof(double));
        }
        for (int64_t j = 0; j < m->boundary.n_points; ++j) {
            memset(m->records + MOR_BOUNDARY_RECORD * j + MOR_BOUNDARY_VELOCITY, 0, 3 * sizeof(double));
        }
        borrow(m, MOR_WALL_STRESS_UNIFORM);
        run(m, mor_pair_select(NULL));
        memcpy(acceleration[which], m->acceleration, sizeof acceleration[which]);
        const mor_boundary_patch *left = &m->patches[0];
        const mor_boundary_patch *right = &m->patches[1];
        assert_true(which != 2 || (left->force[0] < 0.0 && right->force[0] > 0.0)); /* pressed apart */
        close_meeting(m);
    }
    for (int a = 0; a < 3; ++a) {
        assert_true(acceleration[2][a] == acceleration[0][a] + acceleration[1][a]); /* exact: the same sums */
    }
}

/* A wall and a boundary of one patch are the same thing seen by the soil. */
static void rock_that_moves_as_one_is_a_wall(void **state)
{
    (void)state;
    for (int option = 0; option < 18; ++option) {
        meeting *m = calloc(1, sizeof *m);
        double points[3 * POINTS_MAX];
        double wall_acceleration[3 * ASSEMBLY_MAX];
        const double velocity[3] = {0.5, 0.25, 0.0};
        assembly_open_mixed(&m->soil, 2 + option % 2);
        begin(m);
        add_patch(m, (const double[3]){-1.0, -4.0, -1.0},
                  option % 2 == 0 ? (const int[3]){9, 3, 1} : (const int[3]){5, 3, 5},
                  (mor_wall_friction)(option / 2 % 3));
        int32_t order[POINTS_MAX];
        double sorted[POINTS_MAX * MOR_BOUNDARY_RECORD];
        const int64_t n = m->boundary.n_points;
        for (int64_t j = 0; j < n; ++j) {
            double *record = m->records + MOR_BOUNDARY_RECORD * j;
            memcpy(points + 3 * j, record, 3 * sizeof *points);
            record[MOR_BOUNDARY_VOLUME] = 1e-4;
            memcpy(record + MOR_BOUNDARY_VELOCITY, velocity, sizeof velocity);
        }
        mor_tree_order(points, 3, n, order);
        for (int64_t j = 0; j < n; ++j) {
            memcpy(sorted + MOR_BOUNDARY_RECORD * j, m->records + MOR_BOUNDARY_RECORD * order[j],
                   MOR_BOUNDARY_RECORD * sizeof *sorted);
        }
        memcpy(m->records, sorted, sizeof sorted);
        const mor_wall_stress stress = (mor_wall_stress)(option / 6);
        const mor_wall_request request = {.name = "wall",
                                          .points = points,
                                          .n_points = n,
                                          .point_volume = 1e-4,
                                          .friction = m->patches[0].friction,
                                          .friction_coefficient = 0.3,
                                          .velocity = {velocity[0], velocity[1], velocity[2]},
                                          .dimension = m->soil.constants.dimension,
                                          .stress = stress};
        assert_int_equal(mor_soil_contact_init(&m->soil.context, &m->contact, &request, NULL, m->soil.tree.n_clusters),
                         MOR_OK);
        run(m, mor_pair_select(NULL));
        memcpy(wall_acceleration, m->acceleration, sizeof wall_acceleration);
        mor_soil_contact_clear(&m->soil.context, &m->contact);
        borrow(m, stress);
        run(m, mor_pair_select(NULL));
        for (int k = 0; k < 3 * m->soil.n; ++k) {
            const double size = fabs(wall_acceleration[k]) + 1e3;
            /* m/s2; the mean of equal velocities is theirs up to some roundings */
            assert_true(fabs(m->acceleration[k] - wall_acceleration[k]) <= 1e-12 * size);
        }
        close_meeting(m);
    }
}

static void barrier_has_the_published_force_and_its_slope(void **state)
{
    (void)state;
    const mor_soil_barrier barrier = {true, 1e4, 2.5e-3};
    /* kappa (xi - r) (2 ln(xi / r) - r / xi + 1), by hand for r = 2.5 mm, kappa = 1e4. */
    assert_true(fabs(mor_soil_barrier_force(&barrier, 1.25e-3) - 29.829) < 5e-4); /* digits printed */
    assert_true(fabs(mor_soil_barrier_force(&barrier, 0.5e-3) - 144.378) < 5e-4); /* digits printed */
    assert_true(mor_soil_barrier_force(&barrier, 2.5e-3) == 0.0 && mor_soil_barrier_force(&barrier, 1.0) == 0.0);
    assert_true(mor_soil_barrier_slope(&barrier, 2.5e-3) == 0.0);
    assert_true(mor_soil_barrier_force(&barrier, 0.0) == INFINITY);
    for (double xi = 1e-4; xi < 2.4e-3; xi *= 1.3) {
        const double step = 1e-4 * xi;
        const double slope =
            (mor_soil_barrier_force(&barrier, xi - step) - mor_soil_barrier_force(&barrier, xi + step)) / (2.0 * step);
        assert_true(fabs(slope / mor_soil_barrier_slope(&barrier, xi) - 1.0) < 1e-5); /* error of the quotient: 1e-8 */
    }
}

/* Beside the push the barrier adds its pair forces and nothing else, to particles and to points. */
static void barrier_acts_between_pairs_along_their_line(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        meeting *m = open_meeting(dimension, MOR_WALL_STRESS_UNIFORM);
        const mor_soil_barrier barrier = {true, 1e5, 1.2 * ASSEMBLY_SPACING};
        double force[3 * POINTS_MAX];
        double acceleration[3 * ASSEMBLY_MAX];
        for (int p = 0; p < 3; ++p) {
            m->patches[p].friction = MOR_WALL_ROUGH; /* without a cap that the barrier would raise */
        }
        run(m, mor_pair_select(NULL));
        memcpy(force, m->force, sizeof force);
        memcpy(acceleration, m->acceleration, sizeof acceleration);
        assert_true(m->contact.longest_step == INFINITY);
        mor_soil_contact_clear(&m->soil.context, &m->contact);
        borrow(m, MOR_WALL_STRESS_UNIFORM);
        const double support = MOR_KERNEL_SUPPORT * m->soil.constants.smoothing_length;
        assert_int_equal(mor_soil_contact_set_barrier(&m->soil.context, &m->contact, &barrier, support), MOR_OK);
        run(m, mor_pair_select(NULL));
        double largest = 0.0;
        for (int i = 0; i < m->soil.n; ++i) {
            const double *own = m->soil.records + i * MOR_RECORD_SIZE;
            for (int64_t j = 0; j < m->boundary.n_points; ++j) {
                const double *point = m->records + MOR_BOUNDARY_RECORD * j;
                const double r[3] = {own[0] - point[0], own[1] - point[1], own[2] - point[2]};
                const double distance = mor_vector_length(r);
                const double strength = mor_soil_barrier_force(&barrier, distance);
                for (int a = 0; a < 3; ++a) {
                    const double part = strength * r[a] / distance;
                    acceleration[3 * i + a] += part / (own[MOR_RECORD_VOLUME] * own[MOR_RECORD_DENSITY]);
                    force[3 * j + a] -= part;
                }
                largest = fmax(largest, strength);
            }
        }
        assert_true(largest > 0.0 && m->contact.longest_step < INFINITY && m->contact.longest_step > 0.0);
        for (int64_t k = 0; k < 3 * m->boundary.n_points; ++k) {
            assert_true(fabs(m->force[k] - force[k]) <= 1e-12 * (largest + fabs(force[k]))); /* some roundings */
        }
        for (int k = 0; k < 3 * m->soil.n; ++k) {
            const double size = fabs(acceleration[k]) + largest / m->soil.records[MOR_RECORD_VOLUME] / ASSEMBLY_DENSITY;
            assert_true(fabs(m->acceleration[k] - acceleration[k]) <= 1e-12 * size); /* some roundings */
        }
        close_meeting(m);
    }
}

static void what_is_no_boundary_is_refused(void **state)
{
    (void)state;
    meeting *m = open_meeting(2, MOR_WALL_STRESS_UNIFORM);
    mor_soil_contact other;
    mor_context *context = &m->soil.context;
    const double support = MOR_KERNEL_SUPPORT * m->soil.constants.smoothing_length;
    m->patches[1].first += 1;
    assert_int_equal(mor_soil_contact_borrow(context, &other, &m->boundary, MOR_WALL_STRESS_UNIFORM, 2, 8),
                     MOR_ERROR_ARGUMENT);
    m->patches[1].first -= 1;
    m->boundary.n_points += 1;
    assert_int_equal(mor_soil_contact_borrow(context, &other, &m->boundary, MOR_WALL_STRESS_UNIFORM, 2, 8),
                     MOR_ERROR_ARGUMENT);
    m->boundary.n_points -= 1;
    m->patches[1].friction_coefficient = -0.1;
    assert_int_equal(mor_soil_contact_borrow(context, &other, &m->boundary, MOR_WALL_STRESS_UNIFORM, 2, 8),
                     MOR_ERROR_ARGUMENT);
    const mor_boundary_friction frictions[2] = {{MOR_WALL_SMOOTH, -1.0}, {MOR_WALL_COULOMB, -0.1}};
    m->patches[1].friction_of_soil = frictions;
    assert_int_equal(mor_soil_contact_check_frictions(context, &m->contact, 1), MOR_OK); /* smooth has none */
    assert_int_equal(mor_soil_contact_check_frictions(context, &m->contact, 2), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context->message, "patch 1 of boundary 'rocks': found a friction coefficient of -0.1 with "
                                             "soil 1; allowed are numbers >= 0"));
    const mor_soil_barrier wrong[3] = {{true, 0.0, 0.01}, {true, 1e4, 0.0}, {true, 1e4, 1.01 * support}};
    for (int k = 0; k < 3; ++k) {
        assert_int_equal(mor_soil_contact_set_barrier(context, &m->contact, &wrong[k], support), MOR_ERROR_ARGUMENT);
    }
    close_meeting(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slots_are_the_runs_of_the_lists),
        cmocka_unit_test(short_lists_of_slots_hold_the_points_in_reach_alone),
        cmocka_unit_test(velocity_of_a_rock_is_the_mean_by_kernel_values),
        cmocka_unit_test(forces_on_points_have_force_and_moment_of_the_push),
        cmocka_unit_test(rocks_get_what_the_soil_loses),
        cmocka_unit_test(grain_between_two_rocks_feels_each_alone),
        cmocka_unit_test(rock_that_moves_as_one_is_a_wall),
        cmocka_unit_test(barrier_has_the_published_force_and_its_slope),
        cmocka_unit_test(barrier_acts_between_pairs_along_their_line),
        cmocka_unit_test(what_is_no_boundary_is_refused),
    };
    return CLOUD_RUN(tests);
}
