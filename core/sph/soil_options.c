/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages a case may switch on: density by summation, kernel-gradient correction, strain rates for the next step, XSPH
 * and shifting; and the kernel sums of the first two. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/stress/separation.h"

#include <math.h>
#include <string.h>

/* CLUSTERS: clusters a thread takes at once. */
enum { CLUSTERS = 16 };

/* A moment matrix with a smaller determinant belongs to a particle with too few neighbors to be corrected. */
#define SMALLEST_DETERMINANT 0.1

void mor_soil_sum_kernels(mor_context *context, mor_soil *soil, mor_view *view, const double *records,
                          mor_soil_kernel_use use, void *job)
{
    const int64_t n_particles = soil->set.n_particles;
    const int64_t n = soil->tree.n_clusters;
    const mor_relation *inner = mor_view_read_shared(view, MOR_RESOURCE_LISTS, &soil->inner);
    mor_view_compare(view, MOR_RESOURCE_LISTS, inner->generation);
    MOR_PARALLEL_FOR (context, chunk, (n + CLUSTERS - 1) / CLUSTERS, 1) {
        double sums[CLUSTERS * MOR_CLUSTER * MOR_KERNEL_SUMS];
        const int64_t first = chunk * CLUSTERS;
        const int64_t last = first + CLUSTERS < n ? first + CLUSTERS : n;
        const mor_pair_kernel_job sum = {records, records, MOR_RECORD_SIZE, inner, sums, NULL};
        soil->table->kernel(&soil->constants, &sum, first, last);
        for (int64_t i = first * MOR_CLUSTER; i < last * MOR_CLUSTER && i < n_particles; ++i) {
            use(job, i, sums + (i - first * MOR_CLUSTER) * MOR_KERNEL_SUMS);
        }
    }
}

void mor_soil_add_wall_sums(mor_context *context, mor_soil *soil, mor_view *view, const mor_soil_wall_sums *what,
                            double *out)
{
    const int n_sums = what->n_sums;
    const double *scale = what->scale;
    const int64_t n_particles = soil->set.n_particles;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact =
            mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        if (what->of_walls_only && !contact->is_wall) {
            continue;
        }
        MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, CLUSTERS) {
            const int32_t cluster = contact->relation.occupied[place];
            const bool is_left = what->of_awake_only && mor_sleep_is(contact->sleep, cluster, MOR_SLEEP_ASLEEP);
            for (int64_t slot = contact->first_slot[place]; !is_left && slot < contact->first_slot[place + 1]; ++slot) {
                const int64_t first = (int64_t)cluster * MOR_CLUSTER;
                double *to = out + mor_wall_clusters_first(what->places, cluster) * n_sums;
                for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n_particles; ++lane) {
                    const double *sums =
                        contact->sums + (slot * MOR_CLUSTER + lane) * MOR_KERNEL_SUMS + what->first_sum;
                    const double factor = scale != NULL ? scale[first + lane] : 1.0;
                    for (int a = 0; a < n_sums; ++a) {
                        to[lane * n_sums + a] += factor * sums[a];
                    }
                }
            }
        }
    }
}

static void keep_density(void *job, int64_t i, const double *sums)
{
    ((double *)job)[i] = sums[MOR_KERNEL_SUM_VALUE];
}

bool mor_soil_has_density_sums(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.density_reinitialization > 0;
}

/* Density by summation over soil and walls, in units of the lattice's own sum. Where the sum falls short of the
 * particle's density there is a free surface, and the missing part is taken as being at the reference density. */
mor_status mor_soil_reinitialize_density(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const int interval = soil->settings.scheme.density_reinitialization;
    if (step->number % (uint64_t)interval != 0) {
        return MOR_OK;
    }
    const double *mass = mor_view_read(view, MOR_FIELD_MASS);
    double *density = mor_view_write(view, MOR_FIELD_DENSITY);
    double *records = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records);
    double *separation = mor_view_write(view, MOR_FIELD_SEPARATION);
    double *sum = soil->density_sums;
    const int64_t n = soil->set.n_particles;
    for (int64_t i = 0; i < n; ++i) {
        /* Where soils meet, volumes are summed, for masses would smear the jump of the density. */
        const double divisor = soil->of_soil != NULL ? mor_soil_kind_of(soil, i)->reference_density : 1.0;
        records[i * MOR_RECORD_SIZE + MOR_RECORD_VOLUME] = mass[i] / divisor;
    }
    mor_soil_follow_records(context, soil);
    mor_soil_sum_kernels(context, soil, view, records, keep_density, soil->density_sums);
    for (int64_t i = 0; i < n && soil->of_soil != NULL; ++i) {
        sum[i] *= mor_soil_kind_of(soil, i)->reference_density;
    }
    mor_soil_add_wall_sums(context, soil, view,
                           &(mor_soil_wall_sums){.first_sum = MOR_KERNEL_SUM_VALUE, .n_sums = 1, .scale = density},
                           sum);
    MOR_PARALLEL_FOR (context, i, n, MOR_BLOCK) {
        const double reference = mor_soil_kind_of(soil, i)->reference_density;
        if (mor_soil_is_asleep(soil, i)) {
            records[i * MOR_RECORD_SIZE + MOR_RECORD_VOLUME] = mass[i] / density[i];
            continue;
        }
        const double summed = sum[i] / soil->lattice_sum;
        const double missing = density[i] - summed;
        double around = reference; /* beyond a free surface: as dense as here */
        if (separation != NULL && separation[i] > 0.0) {
            separation[i] = mor_separation_bound(separation[i], summed / reference);
            around *= exp(-separation[i]);
        }
        const double found = missing > 0.0 ? summed + missing * around / density[i] : summed;
        if (separation != NULL && separation[i] <= 0.0) {
            separation[i] = mor_separation_correct(separation[i], found / density[i], summed / reference);
        }
        density[i] = found;
        double *record = records + i * MOR_RECORD_SIZE;
        record[MOR_RECORD_VOLUME] = mass[i] / density[i];
        record[MOR_RECORD_IMPEDANCE] = density[i] * mor_soil_kind_of(soil, i)->sound_speed;
        record[MOR_RECORD_DENSITY] = density[i];
    }
    mor_soil_follow_records(context, soil);
    return MOR_OK;
}

static void keep_moments(void *job, int64_t i, const double *sums)
{
    memcpy((double *)job + 6 * i, sums + MOR_KERNEL_SUM_MOMENT, 6 * sizeof *sums);
}

/* Hu et al. (2021), the correction matrix before their eq. 8, applied to the finished sums. */
static void correct_particle(const mor_soil *soil, double density, int64_t i, double *gradient, double *density_rate)
{
    double inverse[6];
    double corrected[9];
    const double determinant = mor_soil_moment_cofactors(soil->closed + 6 * i, soil->settings.dimension, inverse);
    if (!(determinant > SMALLEST_DETERMINANT)) {
        return;
    }
    for (int a = 0; a < 6; ++a) {
        inverse[a] /= determinant;
    }
    for (int a = 0; a < 3; ++a) {
        mor_symmetric_apply(inverse, gradient + 3 * a, corrected + 3 * a);
    }
    const double change = corrected[0] + corrected[4] + corrected[8] - gradient[0] - gradient[4] - gradient[8];
    *density_rate -= density * change;
    memcpy(gradient, corrected, sizeof corrected);
}

mor_status mor_soil_correct_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    const double *density = mor_view_read(view, MOR_FIELD_DENSITY);
    double *gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT);
    double *rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE);
    double *closed = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->closed);
    mor_soil_sum_kernels(context, soil, view, mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records),
                         keep_moments, closed);
    mor_soil_add_wall_sums(context, soil, view, &(mor_soil_wall_sums){.first_sum = MOR_KERNEL_SUM_MOMENT, .n_sums = 6},
                           closed);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        correct_particle(soil, density[i], i, gradient + 9 * i, rate + i);
    }
    return MOR_OK;
}

mor_status mor_soil_store_strain_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    double *kept = mor_view_write(view, MOR_FIELD_STRAIN_RATE);
    const double *gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        const double *l = gradient + 9 * i;
        double *d = kept + 6 * i;
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            /* Adding zero clears the sign of a zero, which could depend on whether a wall is listed. */
            d[a] = l[4 * a] + 0.0;
            d[3 + a] = 0.5 * (l[3 * a + b] + l[3 * b + a]) + 0.0;
        }
    }
    return MOR_OK;
}

/* What XSPH and shifting read and write. */
typedef struct regularization {
    double xsph, shifting; /* parts of the sums, times the length of the step where they are velocities */
    const double *sums, *velocity_gradient;
    const mor_period *period; /* NULL: none */
    double *position, *velocity;
} regularization;

enum { FARTHEST, FASTEST };

/* Hu et al. (2021) eqs. 13 and 16; the velocity follows a shifted particle to first order. Finds the largest squared
 * displacement and speed. */
static void regularize_block(void *job, int64_t first, int64_t last, double *values)
{
    const regularization *it = job;
    for (int64_t i = first; i < last; ++i) {
        const double *sums = it->sums + 6 * i;
        const double *gradient = it->velocity_gradient + 9 * i;
        double *velocity = it->velocity + 3 * i;
        const double speed = mor_vector_length(velocity);
        double shift[3];
        double translation[3];
        for (int a = 0; a < 3; ++a) {
            shift[a] = it->shifting * speed * sums[3 + a];
            translation[a] = mor_period_round_way(it->period, a, it->xsph * sums[a] + shift[a]);
            it->position[3 * i + a] += translation[a];
        }
        for (int a = 0; a < 3; ++a) {
            velocity[a] += mor_vector_dot(gradient + 3 * a, shift);
        }
        values[FARTHEST] = mor_larger(values[FARTHEST], mor_vector_dot(translation, translation));
        values[FASTEST] = mor_larger(values[FASTEST], mor_vector_dot(velocity, velocity));
    }
}

mor_status mor_soil_regularize(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_SHORT_LISTS);
    arrays.regularization = mor_view_write_shared(view, MOR_RESOURCE_REGULARIZATION, soil->regularization);
    const int64_t n = soil->tree.n_clusters;
    MOR_PARALLEL_FOR (context, chunk, (n + CLUSTERS - 1) / CLUSTERS, 1) {
        const int64_t last = (chunk + 1) * CLUSTERS;
        soil->table->regularize(&soil->constants, &arrays, chunk * CLUSTERS, last < n ? last : n);
    }
    regularization job = {.xsph = step->length * soil->settings.scheme.xsph,
                          .shifting = soil->settings.scheme.shifting ? step->length : 0.0,
                          .sums = arrays.regularization,
                          .period = soil->images.period,
                          .velocity_gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT),
                          .position = mor_view_write(view, MOR_FIELD_POSITION),
                          .velocity = mor_view_write(view, MOR_FIELD_VELOCITY)};
    double largest[2] = {0.0, 0.0};
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_LARGEST, 2, regularize_block, &job, soil->room.values, largest);
    mor_soil *bounds = mor_view_write_shared(view, MOR_RESOURCE_BOUNDS, soil);
    bounds->list_places.drift += sqrt(largest[FARTHEST]);
    bounds->boundary_places.drift += sqrt(largest[FARTHEST]);
    soil->largest_speed = sqrt(largest[FASTEST]);
    return MOR_OK;
}
