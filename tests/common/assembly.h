/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_ASSEMBLY_H
#define MOR_TESTS_COMMON_ASSEMBLY_H

#include "core/base/math.h"
#include "core/particle/kernel.h"
#include "core/sph/pair/pair_pack.h"
#include "core/sph/pair/pair_single.h"
#include "tests/common/cloud.h"

#include <math.h>

/** @file
 *  A few dozen soil particles in random states, everything the pair loops read of them, and everything they write. */

enum { ASSEMBLY_MAX = 640, ASSEMBLY_SIDE_MAX = 16, ASSEMBLY_RECORDS = ASSEMBLY_MAX * MOR_RECORD_SIZE };

/** Ways to damp and to diffuse: modes of dissipation, with and without reconstruction and limited diffusion. */
enum { ASSEMBLY_FORMS = 3 * 2 * 2 };

/** Parts of the scheme beside those, bits of a number, and how many numbers there are. */
enum { ASSEMBLY_TRANSIENT = 1, ASSEMBLY_HOURGLASS = 2, ASSEMBLY_SPIN = 4, ASSEMBLY_FIT = 8, ASSEMBLY_PARTS = 16 };

#define ASSEMBLY_SPACING 0.01
#define ASSEMBLY_SOUND 50.0
#define ASSEMBLY_ETA 40.0
#define ASSEMBLY_DENSITY 2000.0
#define ASSEMBLY_WEIGHT (ASSEMBLY_DENSITY * 9.81)
#define ASSEMBLY_LATERAL 0.45
#define ASSEMBLY_HOURGLASS_STIFFNESS 1.3e6
#define ASSEMBLY_CANARY 1.2345e67

/** Of a second soil, over the same of the first: sound speed, stiffness of the hourglass control, weight. */
#define ASSEMBLY_OTHER_SOUND 1.7
#define ASSEMBLY_OTHER_HOURGLASS 4.6
#define ASSEMBLY_OTHER_WEIGHT 0.6

typedef struct assembly {
    mor_context context;
    int n; /* particles */
    mor_pair_constants constants;
    mor_tree tree;
    mor_relation relation;
    double records[ASSEMBLY_RECORDS];                     /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    double artificial[6 * ASSEMBLY_MAX];                  /* shape [n padded to 8, 6], Pa */
    double strain_rate[6 * ASSEMBLY_MAX];                 /* shape [n padded to 8, 6], 1/s */
    bool has_reconstruction;                              /* strain_rate is handed to the loops */
    bool is_mixed;                                        /* forces and gradients by the loops in mixed precision */
    int parts;                                            /* bits of ASSEMBLY_TRANSIENT and so on */
    mor_pair_soil soils[2];                               /* see assembly_split */
    double extra[MOR_EXTRA_SIZE * ASSEMBLY_MAX];          /* shape [n padded to 8, 16]; units of MOR_EXTRA_... */
    double spin[3 * ASSEMBLY_MAX];                        /* shape [n padded to 8, 3]; of the skew stress, Pa */
    double of_soil[MOR_PAIR_OF_SOIL_SIZE * ASSEMBLY_MAX]; /* shape [n padded to 8, ...]; units of the enum */
    int8_t one_soil[ASSEMBLY_MAX / MOR_CLUSTER];          /* shape [n_clusters]; soil that each sees, or -1; 1 */
} assembly;

/** What the loops write; behind the last particle stands ASSEMBLY_CANARY. */
typedef struct assembly_sums {
    double acceleration[3 * ASSEMBLY_MAX];         /* m/s2 */
    double stress_diffusion[6 * ASSEMBLY_MAX];     /* Pa/s */
    double velocity_gradient[9 * ASSEMBLY_MAX];    /* 1/s */
    double density_rate[ASSEMBLY_MAX];             /* kg/m3/s */
    double regularization[6 * ASSEMBLY_MAX];       /* m/s and 1 */
    double hourglass_rate[3 * ASSEMBLY_MAX];       /* m/s */
    double hourglass_moment[3 * ASSEMBLY_MAX];     /* Pa */
    double moments[6 * ASSEMBLY_MAX];              /* 1 */
    double kernel[MOR_KERNEL_SUMS * ASSEMBLY_MAX]; /* units of MOR_KERNEL_SUM_... */
} assembly_sums;

enum { ASSEMBLY_SUMS = sizeof(assembly_sums) / sizeof(double) };

enum { ASSEMBLY_TABLES = 4 };

/** The routines this processor can run, shape [ASSEMBLY_TABLES]; returns how many. */
static inline int assembly_tables(const mor_pair_table **tables)
{
    static const char *const names[ASSEMBLY_TABLES] = {"baseline", "avx2", "avx512-halves", "avx512"};
    static const char *const sets[ASSEMBLY_TABLES] = {"baseline", "avx2", "avx512", "avx512"};
    int n = 0;
    for (int k = 0; k < ASSEMBLY_TABLES; ++k) {
        const mor_pair_table *table = mor_pair_select(names[k]);
        if (table != NULL) {
            assert_string_equal(table->instruction_set, sets[k]);
            tables[n++] = table;
        }
    }
    assert_true(n > 0);
    assert_string_equal(tables[0]->instruction_set, "baseline");
    return n;
}

/** Constants with every option on; gravity is oblique. */
static inline mor_pair_constants assembly_constants(int dimension)
{
    const double h = 1.3 * ASSEMBLY_SPACING;
    mor_pair_constants c = {.dimension = dimension,
                            .dissipation = MOR_DISSIPATION_BOTH,
                            .has_artificial_stress = true,
                            .has_limited_diffusion = true,
                            .has_pressure_term = true,
                            .smoothing_length = h,
                            .gradient_factor = mor_kernel_gradient_factor(h, dimension),
                            .limiter_rate = ASSEMBLY_ETA / ASSEMBLY_SOUND,
                            .diffusion_factor = 1.0,
                            .diffusion_rate = 2.0 * 0.1 * h * ASSEMBLY_SOUND,
                            .gravity_direction = {0.28, -0.96, 0.0},
                            .artificial_exponent = 2.55,
                            .hourglass = ASSEMBLY_HOURGLASS_STIFFNESS,
                            .spacing = ASSEMBLY_SPACING,
                            .spacing_kernel = mor_kernel_value(ASSEMBLY_SPACING, h, dimension),
                            .kernel_normalization = mor_kernel_normalization(h, dimension),
                            .shift_diameter = 1.1 * ASSEMBLY_SPACING};
    if (dimension == 3) {
        memcpy(c.gravity_direction, ((const double[3]){0.48, -0.64, -0.6}), sizeof c.gravity_direction);
    }
    const double *g = c.gravity_direction;
    for (int a = 0; a < 3; ++a) {
        c.rest_gradient[a] = ASSEMBLY_WEIGHT * (ASSEMBLY_LATERAL + (1.0 - ASSEMBLY_LATERAL) * g[a] * g[a]);
        c.rest_gradient[3 + a] = ASSEMBLY_WEIGHT * (1.0 - ASSEMBLY_LATERAL) * g[a] * g[(a + 1) % 3];
    }
    return c;
}

/** Gives particle i what the parts of the scheme read beside its record; id tells it from others. */
static inline void assembly_fill_extra(assembly *a, int i, uint64_t id)
{
    double *extra = a->extra + MOR_EXTRA_SIZE * i;
    const int dimension = a->constants.dimension;
    for (int k = 0; k < 6; ++k) {
        const bool is_out_of_plane = dimension == 2 && (k == MOR_YZ || k == MOR_ZX);
        extra[MOR_EXTRA_MEAN + k] = is_out_of_plane ? 0.0 : cloud_number(id, 80 + (uint64_t)k, -2e4, 1e4);
    }
    for (int k = 0; k < 3; ++k) {
        extra[MOR_EXTRA_HOURGLASS + k] = k < dimension ? cloud_number(id, 90 + (uint64_t)k, -1e-4, 1e-4) : 0.0;
        a->spin[3 * i + k] = dimension == 3 || k == 2 ? cloud_number(id, 95 + (uint64_t)k, -2e3, 2e3) : 0.0;
    }
    /* A third at rest, a third flows. */
    extra[MOR_EXTRA_FLOW] = fmin(fmax(cloud_number(id, 100, -1.0, 2.0), 0.0), 1.0);
    a->of_soil[MOR_PAIR_OF_SOIL_SIZE * i + MOR_PAIR_OF_SOIL_LIMITER] = 0.5 * a->constants.limiter_rate;
}

/** Finds what the loops read beside the records, shape [n padded to 8, 16], units of MOR_EXTRA_...: that of the
 *  assembly with the stresses as they are now. */
static inline void assembly_pack_extra(const assembly *a, double *extra)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    memcpy(extra, a->extra, sizeof a->extra);
    for (int i = 0; i < ASSEMBLY_MAX; ++i) {
        mor_pair_pack_shears(a->records + i * MOR_RECORD_SIZE + MOR_RECORD_STRESS,
                             a->constants.has_spin ? a->spin + 3 * i : none, extra + i * MOR_EXTRA_SIZE);
    }
}

/** Gives particle i, whose position is set, a random state; id tells it from others. */
static inline void assembly_fill(assembly *a, int i, uint64_t id)
{
    double *record = a->records + i * MOR_RECORD_SIZE;
    double *artificial = a->artificial + 6 * i;
    double *strain_rate = a->strain_rate + 6 * i;
    const int dimension = a->constants.dimension;
    const double cell =
        dimension == 2 ? ASSEMBLY_SPACING * ASSEMBLY_SPACING : ASSEMBLY_SPACING * ASSEMBLY_SPACING * ASSEMBLY_SPACING;
    record[MOR_RECORD_VOLUME] = cell * cloud_number(id, 11, 0.9, 1.1);
    record[MOR_RECORD_DENSITY] = ASSEMBLY_DENSITY * cloud_number(id, 12, 0.9, 1.1);
    record[MOR_RECORD_IMPEDANCE] = record[MOR_RECORD_DENSITY] * ASSEMBLY_SOUND;
    for (int k = 0; k < 6; ++k) {
        const bool is_out_of_plane = dimension == 2 && (k == MOR_YZ || k == MOR_ZX);
        record[MOR_RECORD_STRESS + k] = is_out_of_plane ? 0.0 : cloud_number(id, 20 + (uint64_t)k, -2e4, 1e4);
        artificial[k] = is_out_of_plane ? 0.0 : cloud_number(id, 30 + (uint64_t)k, -4e3, 4e3);
        /* Over a spacing these explain about as much as the velocities below differ: less, more, and its opposite. */
        strain_rate[k] = is_out_of_plane ? 0.0 : cloud_number(id, 60 + (uint64_t)k, -100.0, 100.0);
    }
    for (int k = 0; k < dimension; ++k) {
        record[MOR_RECORD_VELOCITY + k] = cloud_number(id, 40 + (uint64_t)k, -1.0, 1.0);
    }
    assembly_fill_extra(a, i, id);
    record[MOR_RECORD_PRESSURE] = -mor_symmetric_trace(record + MOR_RECORD_STRESS) / 3.0;
}

/** Fits tree and lists to the positions; strangers up to the skin are listed, too. The lanes behind the last particle
 *  repeat it, as the soil solver has it. */
static inline void assembly_list(assembly *a, double skin)
{
    const int padded = (int)a->tree.n_clusters * MOR_CLUSTER;
    for (int i = a->n; i < padded; ++i) {
        memcpy(a->records + i * MOR_RECORD_SIZE, a->records + (a->n - 1) * MOR_RECORD_SIZE,
               MOR_RECORD_SIZE * sizeof(double));
        memcpy(a->extra + i * MOR_EXTRA_SIZE, a->extra + (a->n - 1) * MOR_EXTRA_SIZE, MOR_EXTRA_SIZE * sizeof(double));
        memcpy(a->spin + i * 3, a->spin + (a->n - 1) * 3, 3 * sizeof(double));
        memcpy(a->of_soil + i * MOR_PAIR_OF_SOIL_SIZE, a->of_soil + (a->n - 1) * MOR_PAIR_OF_SOIL_SIZE,
               MOR_PAIR_OF_SOIL_SIZE * sizeof(double));
    }
    const mor_relation_points points = {&a->tree, a->records, MOR_RECORD_SIZE};
    mor_tree_fit(&a->tree, a->records, MOR_RECORD_SIZE);
    const double reach = MOR_KERNEL_SUPPORT * a->constants.smoothing_length + skin;
    assert_int_equal(mor_relation_build(&a->context, &a->relation, &points, &points, reach), MOR_OK);
    mor_pair_find_one_soil(&a->relation, a->of_soil, 0, a->tree.n_clusters, a->one_soil);
}

/** Makes an assembly of particles at given points, shape [n, 3], unit m, in tree order and random states. */
static inline void assembly_open(assembly *a, int dimension, const double *points, int n)
{
    int32_t order[ASSEMBLY_MAX];
    assert_true(n > 0 && n <= ASSEMBLY_MAX);
    memset(a, 0, sizeof *a);
    mor_context_init(&a->context);
    a->n = n;
    a->constants = assembly_constants(dimension);
    a->has_reconstruction = true;
    mor_tree_order(points, 3, n, order);
    for (int i = 0; i < n; ++i) {
        memcpy(a->records + i * MOR_RECORD_SIZE, points + 3 * order[i], 3 * sizeof *points);
        assembly_fill(a, i, (uint64_t)order[i]);
    }
    assert_int_equal(mor_tree_init(&a->context, &a->tree, n), MOR_OK);
    assert_int_equal(mor_relation_init(&a->context, &a->relation, MOR_CONFIGURATION_CURRENT, a->tree.n_clusters),
                     MOR_OK);
    if (dimension == 3) { /* lists in a plane stay lists of entries, so that both are read */
        assert_int_equal(mor_relation_use_runs(&a->context, &a->relation), MOR_OK);
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
}

/** As assembly_open, on a lattice of so many points a side, less the last few; each moved by jitter spacings. */
static inline void assembly_open_lattice(assembly *a, int dimension, int side, int n_left_out, double jitter)
{
    double points[3 * ASSEMBLY_MAX] = {0.0};
    const int n = (dimension == 2 ? side * side : side * side * side) - n_left_out;
    for (int i = 0; i < n; ++i) {
        const int place[3] = {i % side, i / side % side, i / (side * side)};
        for (int k = 0; k < dimension; ++k) {
            points[3 * i + k] =
                ASSEMBLY_SPACING * (place[k] + jitter * cloud_number((uint64_t)i, 50 + (uint64_t)k, -1.0, 1.0));
        }
    }
    assembly_open(a, dimension, points, n);
}

/** 118 or 122 particles, not a whole number of clusters and more than a chunk of a list, well mixed. */
static inline void assembly_open_mixed(assembly *a, int dimension)
{
    assembly_open_lattice(a, dimension, dimension == 2 ? 11 : 5, 3, 0.3);
}

/** So many particles in a dense cube that a hundred all see one another, and a cluster in the middle sees six hundred;
 *  twenty strangers come before them in all lists. Just above h / 4 apart, as mixed precision asks for. */
static inline void assembly_open_dense(assembly *a, int n_near)
{
    enum { STRANGERS = 20 };
    static const double spacing = 0.33 * ASSEMBLY_SPACING;
    double points[3 * ASSEMBLY_MAX] = {0.0};
    const int side = n_near > 125 ? 9 : 5;
    for (int i = 0; i < n_near + STRANGERS; ++i) {
        points[3 * i] = spacing * (i % side) - (i < n_near ? 0.0 : 20.0 * ASSEMBLY_SPACING);
        points[3 * i + 1] = spacing * (i / side % side);
        points[3 * i + 2] = spacing * (i / side / side);
    }
    assembly_open(a, 3, points, n_near + STRANGERS);
    assembly_list(a, 1000.0 * ASSEMBLY_SPACING);
}

static inline void assembly_close(assembly *a)
{
    mor_relation_clear(&a->context, &a->relation);
    mor_tree_clear(&a->context, &a->tree);
    assert_int_equal(a->context.memory_bytes, 0);
}

/** Sets what damps and diffuses by one of ASSEMBLY_FORMS numbers: dissipation, reconstruction, limited diffusion. */
static inline void assembly_choose(assembly *a, int form)
{
    a->constants.dissipation = (mor_dissipation)(form % 3);
    a->has_reconstruction = form / 3 % 2;
    a->constants.has_limited_diffusion = form / 6 % 2;
}

/** Switches parts of the scheme on, bits of ASSEMBLY_TRANSIENT and so on, and the others off. */
static inline void assembly_choose_parts(assembly *a, int parts)
{
    a->parts = parts;
    a->constants.has_transient = parts & ASSEMBLY_TRANSIENT;
    a->constants.has_hourglass = parts & ASSEMBLY_HOURGLASS;
    a->constants.has_spin = parts & ASSEMBLY_SPIN;
    a->constants.has_fit = parts & ASSEMBLY_FIT;
}

/** Sound speed of the soil of particle i, m/s. */
static inline double assembly_sound(const assembly *a, int i)
{
    const bool is_other = a->of_soil[MOR_PAIR_OF_SOIL_SIZE * i + MOR_PAIR_OF_SOIL_INDEX] > 0.0;
    return is_other ? ASSEMBLY_OTHER_SOUND * ASSEMBLY_SOUND : ASSEMBLY_SOUND;
}

/** Makes particles of a mixed assembly on one side of a plane those of a second soil. */
static inline void assembly_split(assembly *a)
{
    const double x = (a->constants.dimension == 2 ? 6.5 : 3.5) * ASSEMBLY_SPACING;
    const mor_pair_constants *c = &a->constants;
    for (int s = 0; s < 2; ++s) {
        const double sound = s == 0 ? 1.0 : ASSEMBLY_OTHER_SOUND;
        a->soils[s] = (mor_pair_soil){.limiter_rate = c->limiter_rate / sound,
                                      .hourglass = c->hourglass * (s == 0 ? 1.0 : ASSEMBLY_OTHER_HOURGLASS),
                                      .diffusion_rate = c->diffusion_rate * sound};
        for (int k = 0; k < 6; ++k) {
            a->soils[s].rest_gradient[k] = c->rest_gradient[k] * (s == 0 ? 1.0 : ASSEMBLY_OTHER_WEIGHT);
        }
    }
    for (int i = 0; i < a->n; ++i) {
        double *record = a->records + i * MOR_RECORD_SIZE;
        double *of_soil = a->of_soil + i * MOR_PAIR_OF_SOIL_SIZE;
        const int s = record[MOR_RECORD_POSITION] > x;
        of_soil[MOR_PAIR_OF_SOIL_INDEX] = s;
        of_soil[MOR_PAIR_OF_SOIL_LIMITER] = 0.5 * a->soils[s].limiter_rate;
        record[MOR_RECORD_IMPEDANCE] = record[MOR_RECORD_DENSITY] * assembly_sound(a, i);
    }
    a->constants.soils = a->soils;
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
}

/** Calls check(assembly, table) for mixed assemblies in two and three dimensions, each form and each table. */
static inline void assembly_for_mixed(void (*check)(assembly *a, const mor_pair_table *table))
{
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * ASSEMBLY_FORMS * n_tables; ++option) {
        assembly *a = malloc(sizeof *a);
        assert_non_null(a);
        assembly_open_mixed(a, 2 + option % 2);
        assembly_choose(a, option / 2);
        check(a, tables[option / (2 * ASSEMBLY_FORMS)]);
        assembly_close(a);
        free(a);
    }
}

/** As assembly_for_mixed, with all parts of the scheme, or all but one, in one soil and in two. */
static inline void assembly_for_parts(void (*check)(assembly *a, const mor_pair_table *table))
{
    static const int left_out[] = {0, ASSEMBLY_TRANSIENT, ASSEMBLY_FIT};
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * 2 * 3 * n_tables; ++option) {
        assembly *a = malloc(sizeof *a);
        assert_non_null(a);
        assembly_open_mixed(a, 2 + option % 2);
        assembly_choose_parts(a, (ASSEMBLY_PARTS - 1) & ~left_out[option / 4 % 3]);
        if (option / 2 % 2) {
            assembly_split(a);
        }
        check(a, tables[option / (2 * 2 * 3)]);
        assembly_close(a);
        free(a);
    }
}

/** Largest magnitude of n numbers, any unit. */
static inline double assembly_largest(const double *values, int n)
{
    double most = 0.0;
    for (int k = 0; k < n; ++k) {
        most = fmax(most, fabs(values[k]));
    }
    return most;
}

/** Runs every loop of a table over the clusters, so many at a time. */
static inline void assembly_run(const assembly *a, const mor_pair_table *table, int clusters, assembly_sums *sums)
{
    double *numbers = (double *)sums;
    for (int k = 0; k < ASSEMBLY_SUMS; ++k) {
        numbers[k] = ASSEMBLY_CANARY;
    }
    const bool diffuses = a->constants.diffusion_rate > 0.0;
    const bool has_two_soils = a->constants.soils != NULL;
    double extra[MOR_EXTRA_SIZE * ASSEMBLY_MAX];
    assembly_pack_extra(a, extra);
    const bool has_extra = a->parts & (ASSEMBLY_TRANSIENT | ASSEMBLY_HOURGLASS | ASSEMBLY_SPIN);
    const bool has_hourglass = a->constants.has_hourglass;
    const bool has_moments = a->parts & (ASSEMBLY_FIT | ASSEMBLY_SPIN);
    mor_pair_arrays arrays = {.n_particles = a->n,
                              .records = a->records,
                              .inner = &a->relation,
                              .artificial_stress = a->constants.has_artificial_stress ? a->artificial : NULL,
                              .acceleration = sums->acceleration,
                              .stress_diffusion = diffuses ? sums->stress_diffusion : NULL,
                              .velocity_gradient = sums->velocity_gradient,
                              .density_rate = sums->density_rate,
                              .regularization = sums->regularization,
                              .extra = has_extra ? extra : NULL,
                              .hourglass_rate = has_hourglass ? sums->hourglass_rate : NULL,
                              .hourglass_moment = has_hourglass ? sums->hourglass_moment : NULL,
                              .moments = has_moments ? sums->moments : NULL,
                              .of_soil = has_two_soils ? a->of_soil : NULL,
                              .one_soil = has_two_soils ? a->one_soil : NULL,
                              .strain_rate = a->has_reconstruction ? a->strain_rate : NULL};
    const int n_clusters = (int)a->tree.n_clusters;
    const int plane = a->constants.dimension - 2;
    const mor_images none = {0};
    mor_pair_singles singles = {0};
    mor_context context;
    mor_context_init(&context);
    if (a->is_mixed) {
        assert_int_equal(mor_pair_singles_pack(&context, &a->constants, &none, &singles, &arrays), MOR_OK);
    }
    const mor_pair_loop momentum = (a->is_mixed ? table->mixed_momentum : table->momentum)[plane];
    const mor_pair_loop gradient = (a->is_mixed ? table->mixed_gradient : table->gradient)[plane];
    for (int first = 0; first < n_clusters; first += clusters) {
        const int last = first + clusters < n_clusters ? first + clusters : n_clusters;
        momentum(&a->constants, &arrays, first, last);
        gradient(&a->constants, &arrays, first, last);
        table->regularize(&a->constants, &arrays, first, last);
        const mor_pair_kernel_job job = {.source = a->records,
                                         .target = a->records,
                                         .target_stride = MOR_RECORD_SIZE,
                                         .relation = &a->relation,
                                         .sums = sums->kernel + first * MOR_CLUSTER * MOR_KERNEL_SUMS};
        table->kernel(&a->constants, &job, first, last);
    }
    mor_pair_singles_clear(&context, &singles);
}

#endif
