/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages a case may switch on: density by summation, kernel-gradient correction, XSPH and shifting. */
#include "core/sph/soil_internal.h"

#include "core/base/eigen.h"
#include "core/base/math.h"
#include "core/base/parallel.h"

#include <string.h>

/* CLUSTERS: clusters a thread takes at once. */
enum { CLUSTERS = 16 };

/* A moment matrix with a smaller determinant belongs to a particle with too few neighbors to be corrected. */
#define SMALLEST_DETERMINANT 0.1

/* Calls use(soil, particle, sums of that particle) for the kernel sums over the soil itself. */
typedef void (*kernel_use)(mor_soil *soil, int64_t i, const double *sums);

static void sum_kernels(mor_context *context, mor_soil *soil, kernel_use use)
{
    const int64_t n_particles = soil->set.n_particles;
    const int64_t n = soil->tree.n_clusters;
    MOR_PARALLEL_FOR (context, chunk, (n + CLUSTERS - 1) / CLUSTERS, 1) {
        double sums[CLUSTERS * MOR_CLUSTER * MOR_KERNEL_SUMS];
        const int64_t first = chunk * CLUSTERS;
        const int64_t last = first + CLUSTERS < n ? first + CLUSTERS : n;
        const mor_pair_kernel_job job = {soil->records, soil->records, MOR_RECORD_SIZE, &soil->inner, sums, NULL};
        soil->table->kernel(&soil->constants, &job, first, last);
        for (int64_t i = first * MOR_CLUSTER; i < last * MOR_CLUSTER && i < n_particles; ++i) {
            use(soil, i, sums + (i - first * MOR_CLUSTER) * MOR_KERNEL_SUMS);
        }
    }
}

/* Adds a run of the sums over walls and rocks to a field: out[i * n + a] += scale(i) * sums[first_sum + a]. */
static void add_wall_sums(mor_context *context, mor_soil *soil, int first_sum, int n_sums, const double *scale,
                          double *out)
{
    const int64_t n_particles = soil->set.n_particles;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact = mor_soil_contact_at(soil, k);
        MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, CLUSTERS) {
            for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
                const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
                for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n_particles; ++lane) {
                    const double *sums = contact->sums + (slot * MOR_CLUSTER + lane) * MOR_KERNEL_SUMS + first_sum;
                    const double factor = scale != NULL ? scale[first + lane] : 1.0;
                    for (int a = 0; a < n_sums; ++a) {
                        out[(first + lane) * n_sums + a] += factor * sums[a];
                    }
                }
            }
        }
    }
}

static void keep_density(mor_soil *soil, int64_t i, const double *sums)
{
    soil->set.data[MOR_FIELD_DENSITY_RATE][i] = sums[MOR_KERNEL_SUM_VALUE];
}

/* Density by summation over soil and walls, in units of the lattice's own sum. Where the sum falls short of the
 * particle's density there is a free surface, and the missing part is taken as being at the reference density. */
mor_status mor_soil_reinitialize_density(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    const int interval = soil->settings.scheme.density_reinitialization;
    if (interval == 0 || step->number == 0 || step->number % (uint64_t)interval != 0) {
        return MOR_OK;
    }
    const double *mass = soil->set.data[MOR_FIELD_MASS];
    double *density = soil->set.data[MOR_FIELD_DENSITY];
    /* The density rate is written anew later in the step and serves as scratch here. */
    double *sum = soil->set.data[MOR_FIELD_DENSITY_RATE];
    const int64_t n = soil->set.n_particles;
    for (int64_t i = 0; i < n; ++i) {
        soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_VOLUME] = mass[i];
    }
    sum_kernels(context, soil, keep_density);
    add_wall_sums(context, soil, MOR_KERNEL_SUM_VALUE, 1, density, sum);
    const double reference = soil->settings.reference_density;
    MOR_PARALLEL_FOR (context, i, n, MOR_BLOCK) {
        const double summed = sum[i] / soil->lattice_sum;
        const double missing = density[i] - summed;
        density[i] = missing > 0.0 ? summed + missing * reference / density[i] : summed;
        double *record = soil->records + i * MOR_RECORD_SIZE;
        record[MOR_RECORD_VOLUME] = mass[i] / density[i];
        record[MOR_RECORD_IMPEDANCE] = density[i] * soil->sound_speed;
        record[MOR_RECORD_DENSITY] = density[i];
    }
    return MOR_OK;
}

static void keep_moments(mor_soil *soil, int64_t i, const double *sums)
{
    memcpy(soil->moments + 6 * i, sums + MOR_KERNEL_SUM_MOMENT, 6 * sizeof *sums);
}

/* Inverse of a symmetric matrix, [3,3] out; false when it is close to singular. In plane strain the out-of-plane
 * entry is set to one first. */
static bool invert_moments(const double *m, int dimension, double *inverse)
{
    const double zz = dimension == 3 ? m[MOR_ZZ] : 1.0;
    const double cxx = m[MOR_YY] * zz - m[MOR_YZ] * m[MOR_YZ];
    const double cxy = m[MOR_ZX] * m[MOR_YZ] - m[MOR_XY] * zz;
    const double czx = m[MOR_XY] * m[MOR_YZ] - m[MOR_YY] * m[MOR_ZX];
    const double determinant = m[MOR_XX] * cxx + m[MOR_XY] * cxy + m[MOR_ZX] * czx;
    if (!(determinant > SMALLEST_DETERMINANT)) {
        return false;
    }
    const double d = 1.0 / determinant;
    inverse[0] = d * cxx;
    inverse[1] = inverse[3] = d * cxy;
    inverse[2] = inverse[6] = d * czx;
    inverse[4] = d * (m[MOR_XX] * zz - m[MOR_ZX] * m[MOR_ZX]);
    inverse[5] = inverse[7] = d * (m[MOR_XY] * m[MOR_ZX] - m[MOR_XX] * m[MOR_YZ]);
    inverse[8] = d * (m[MOR_XX] * m[MOR_YY] - m[MOR_XY] * m[MOR_XY]);
    return true;
}

/* Hu et al. (2021), the correction matrix before their eq. 8, applied to the finished sums. */
static void correct_particle(mor_soil *soil, int64_t i)
{
    double inverse[9];
    double *gradient = soil->set.data[MOR_FIELD_VELOCITY_GRADIENT] + 9 * i;
    if (!invert_moments(soil->moments + 6 * i, soil->settings.dimension, inverse)) {
        return;
    }
    double corrected[9];
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            corrected[3 * a + b] = gradient[3 * a] * inverse[b] + gradient[3 * a + 1] * inverse[3 + b] +
                                   gradient[3 * a + 2] * inverse[6 + b];
        }
    }
    const double change = corrected[0] + corrected[4] + corrected[8] - gradient[0] - gradient[4] - gradient[8];
    soil->set.data[MOR_FIELD_DENSITY_RATE][i] -= soil->set.data[MOR_FIELD_DENSITY][i] * change;
    memcpy(gradient, corrected, sizeof corrected);
}

mor_status mor_soil_correct_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    (void)step;
    if (!soil->settings.scheme.gradient_correction) {
        return MOR_OK;
    }
    sum_kernels(context, soil, keep_moments);
    add_wall_sums(context, soil, MOR_KERNEL_SUM_MOMENT, 6, NULL, soil->moments);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        correct_particle(soil, i);
    }
    return MOR_OK;
}

mor_status mor_soil_store_strain_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    (void)step;
    double *kept = soil->set.data[MOR_FIELD_STRAIN_RATE];
    const double *gradient = soil->set.data[MOR_FIELD_VELOCITY_GRADIENT];
    if (kept == NULL) {
        return MOR_OK;
    }
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        const double *l = gradient + 9 * i;
        double *d = kept + 6 * i;
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            /* A zero's sign may tell whether a wall is listed; adding zero takes it away. */
            d[a] = l[4 * a] + 0.0;
            d[3 + a] = 0.5 * (l[3 * a + b] + l[3 * b + a]) + 0.0;
        }
    }
    return MOR_OK;
}

/* The pair forces sigma_i . grad W of particle i exert the moment of the skew part of M sigma_i about it, M being the
 * kernel's moment over the soil. A skew stress A beside sigma_i takes that away: M A + A M = M sigma - sigma M, which
 * for the axial vector a of A reads (tr M - M) a = axial vector of the right side. In the frame of M its components
 * are sigma_ab (m_a - m_b) / (m_a + m_b): never larger than the stress, and none where the kernel is full. */
static void find_spin_stress(mor_soil *soil, int64_t i)
{
    const double *m = soil->moments + 6 * i;
    const double *s = soil->records + i * MOR_RECORD_SIZE + MOR_RECORD_STRESS;
    double *spin = soil->spin_stress + 3 * i;
    double values[3];
    double axes[9];
    mor_symmetric_eigen(m, values, axes);
    spin[0] = spin[1] = spin[2] = 0.0;
    for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3;
        const int b = (c + 2) % 3;
        const double u[3] = {axes[a], axes[3 + a], axes[6 + a]};
        const double v[3] = {axes[b], axes[3 + b], axes[6 + b]};
        const double sum = values[a] + values[b];
        double turned[3];
        mor_symmetric_apply(s, v, turned);
        /* Without neighbors in this plane there is no moment either. */
        const double part = sum > 0.0 ? mor_vector_dot(u, turned) * (values[b] - values[a]) / sum : 0.0;
        mor_vector_cross_add(part, u, v, spin);
    }
}

mor_status mor_soil_keep_angular_momentum(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    (void)step;
    if (!soil->settings.scheme.angular_momentum) {
        return MOR_OK;
    }
    sum_kernels(context, soil, keep_moments);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        find_spin_stress(soil, i);
    }
    const mor_pair_arrays arrays = mor_soil_pair_arrays(soil);
    const int64_t n = soil->tree.n_clusters;
    MOR_PARALLEL_FOR (context, chunk, (n + CLUSTERS - 1) / CLUSTERS, 1) {
        const int64_t last = (chunk + 1) * CLUSTERS;
        soil->table->spin(&soil->constants, &arrays, chunk * CLUSTERS, last < n ? last : n);
    }
    return MOR_OK;
}

/* Largest of a pair of values over the blocks of a loop. */
static void find_largest(const mor_soil *soil, int64_t n_blocks, double *first, double *second)
{
    *first = 0.0;
    *second = 0.0;
    for (int64_t block = 0; block < n_blocks; ++block) {
        *first = fmax(*first, soil->block_values[2 * block]);
        *second = fmax(*second, soil->block_values[2 * block + 1]);
    }
}

/* Hu et al. (2021) eqs. 13 and 16; the velocity follows a shifted particle to first order. Returns through
 * block_values the largest squared displacement and speed. */
static void regularize_block(mor_soil *soil, int64_t block, double xsph, double shifting)
{
    double farthest = 0.0;
    double fastest = 0.0;
    for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, soil->set.n_particles); ++i) {
        const double *sums = soil->regularization + 6 * i;
        const double *gradient = soil->set.data[MOR_FIELD_VELOCITY_GRADIENT] + 9 * i;
        double *velocity = soil->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        const double speed = mor_vector_length(velocity);
        double shift[3];
        double translation[3];
        for (int a = 0; a < 3; ++a) {
            shift[a] = shifting * speed * sums[3 + a];
            translation[a] = xsph * sums[a] + shift[a];
            soil->set.data[MOR_FIELD_POSITION][3 * i + a] += translation[a];
        }
        for (int a = 0; a < 3; ++a) {
            velocity[a] += mor_vector_dot(gradient + 3 * a, shift);
        }
        farthest = fmax(farthest, mor_vector_dot(translation, translation));
        fastest = fmax(fastest, mor_vector_dot(velocity, velocity));
    }
    soil->block_values[2 * block] = farthest;
    soil->block_values[2 * block + 1] = fastest;
}

mor_status mor_soil_regularize(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    if (soil->regularization == NULL) {
        return MOR_OK;
    }
    const mor_pair_arrays arrays = mor_soil_pair_arrays(soil);
    const int64_t n = soil->tree.n_clusters;
    MOR_PARALLEL_FOR (context, chunk, (n + CLUSTERS - 1) / CLUSTERS, 1) {
        const int64_t last = (chunk + 1) * CLUSTERS;
        soil->table->regularize(&soil->constants, &arrays, chunk * CLUSTERS, last < n ? last : n);
    }
    const int64_t n_blocks = mor_block_count(soil->set.n_particles);
    const double xsph = step->length * soil->settings.scheme.xsph;
    const double shifting = soil->settings.scheme.shifting ? step->length : 0.0;
    MOR_PARALLEL_FOR (context, block, n_blocks, 1) {
        regularize_block(soil, block, xsph, shifting);
    }
    double farthest = 0.0;
    double fastest = 0.0;
    find_largest(soil, n_blocks, &farthest, &fastest);
    soil->drift += sqrt(farthest);
    soil->largest_speed = sqrt(fastest);
    return MOR_OK;
}
