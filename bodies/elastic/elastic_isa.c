/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "bodies/elastic/elastic_internal.h"

#include "core/particle/lanes.h"

typedef double unaligned_vec __attribute__((vector_size(LANES * sizeof(double)), aligned(8)));

typedef float single __attribute__((vector_size(LANES * sizeof(float)), aligned(4), may_alias));

INLINE vec zero(void)
{
    return (vec){0.0};
}

/* LANES numbers one after another. */
INLINE vec row(const double *a)
{
    return *(const unaligned_vec *)a;
}

/* One part of a cluster: its first slot and particle, particles in use, neighbors. */
typedef struct part {
    const mor_elastic_cluster *cluster;
    int64_t slot, particle;
    int n_lanes;
    const mor_elastic_entry *entries;
    const float *weights;        /* this part's columns of [n_rows, 8] */
    const double *inverse, *sum; /* this part's columns of [6, 8] and [3, 8] */
} part;

INLINE part part_of(const mor_elastic_work *work, int64_t c, int p)
{
    const mor_elastic_cluster *cluster = &work->clusters[c];
    const int left = cluster->n_lanes - p * LANES;
    return (part){cluster,
                  c * MOR_CLUSTER + p * LANES,
                  cluster->first + p * LANES,
                  left < LANES ? (left > 0 ? left : 0) : LANES,
                  work->entries + cluster->first_entry,
                  work->weights + p * LANES,
                  work->inverses + c * 6 * MOR_CLUSTER + p * LANES,
                  work->sums + c * 3 * MOR_CLUSTER + p * LANES};
}

INLINE vec weight_of(const part *p, const mor_elastic_entry *entry)
{
    const single weights = *(const single *)(p->weights + (int64_t)entry->weights * MOR_CLUSTER);
#if LANES == 8 && !defined(__clang__)
    /* Spelled out because gcc widens in halves and goes through memory; 4 stands for the current rounding. */
    return (vec)__builtin_ia32_cvtps2pd512_mask(weights, (vec){0.0}, (unsigned char)-1, 4);
#else
    return __builtin_convertvector(weights, vec);
#endif
}

/* The symmetric matrix m^-1 as d x d. */
INLINE void load_inverse(const part *p, vec *m, const int d)
{
    for (int a = 0; a < d; ++a) {
        m[a * d + a] = row(p->inverse + a * MOR_CLUSTER);
    }
    m[1] = m[d] = row(p->inverse + MOR_XY * MOR_CLUSTER);
    if (d == 3) {
        m[5] = m[7] = row(p->inverse + MOR_YZ * MOR_CLUSTER);
        m[2] = m[6] = row(p->inverse + MOR_ZX * MOR_CLUSTER);
    }
}

INLINE void forces_part(const mor_elastic_job *job, const part *p, const int d)
{
    const int size = 2 * d + d * d;
    const double *own = job->work->stressed + p->slot * size;
    vec x[3];
    vec y[3];
    vec f[3];
    for (int a = 0; a < d; ++a) {
        x[a] = load(own, size, a);
        y[a] = load(own, size, d + a);
        f[a] = zero();
    }
    for (const mor_elastic_entry *entry = p->entries; entry < p->entries + p->cluster->n_entries; ++entry) {
        const double *other = job->work->stressed + (int64_t)entry->slot * size;
        const double *t = other + 2 * d;
        const vec k = weight_of(p, entry);
        vec r[3];
        for (int a = 0; a < d; ++a) {
            r[a] = x[a] - other[a];
        }
        for (int a = 0; a < d; ++a) {
            vec sum = other[d + a] - y[a];
            for (int b = 0; b < d; ++b) {
                sum += r[b] * t[a * d + b];
            }
            f[a] += k * sum;
        }
    }
    for (int a = 0; a < 3; ++a) {
        vec sum = a < d ? f[a < d ? a : 0] : zero();
        for (int b = 0; b < d && a < d; ++b) {
            sum += load(own, size, (2 + a) * d + b) * row(p->sum + b * MOR_CLUSTER);
        }
        store(job->acceleration + 3 * p->particle, 3, a, p->n_lanes, sum);
    }
}

/* Sum of k |F R - r|^2 over the neighbors of all lanes, m2. */
INLINE double hourglass_part(const mor_elastic_job *job, const part *p, const int d)
{
    const int size = 2 * d + d * d;
    const double *own = job->work->stressed + p->slot * size;
    vec reference[3];
    vec x[3];
    vec map[9];
    vec sum = zero();
    for (int a = 0; a < d; ++a) {
        reference[a] = load(own, size, a);
        x[a] = load(job->position + 3 * p->particle, 3, a);
        for (int b = 0; b < d; ++b) {
            map[a * d + b] = load(job->gradient + 9 * p->particle, 9, 3 * a + b);
        }
    }
    for (const mor_elastic_entry *entry = p->entries; entry < p->entries + p->cluster->n_entries; ++entry) {
        const double *other = job->work->stressed + (int64_t)entry->slot * size;
        const int64_t j = job->work->clusters[entry->slot / MOR_CLUSTER].first + entry->slot % MOR_CLUSTER;
        vec miss2 = zero();
        for (int a = 0; a < d; ++a) {
            vec miss = job->position[3 * j + a] - x[a];
            for (int b = 0; b < d; ++b) {
                miss += map[a * d + b] * (reference[b] - other[b]);
            }
            miss2 += miss * miss;
        }
        sum += weight_of(p, entry) * miss2;
    }
    double total = 0.0;
    for (int lane = 0; lane < p->n_lanes; ++lane) {
        total += sum[lane];
    }
    return total;
}

INLINE void rate_part(const mor_elastic_job *job, const part *p, const int d)
{
    const int size = 2 * d;
    const double *own = job->work->moving + p->slot * size;
    vec x[3];
    vec v[3];
    vec sum[9];
    vec m[9];
    for (int a = 0; a < d; ++a) {
        x[a] = load(own, size, a);
        v[a] = load(own, size, d + a);
    }
    for (int k = 0; k < d * d; ++k) {
        sum[k] = zero();
    }
    for (const mor_elastic_entry *entry = p->entries; entry < p->entries + p->cluster->n_entries; ++entry) {
        const double *other = job->work->moving + (int64_t)entry->slot * size;
        const vec k = weight_of(p, entry);
        vec kr[3];
        for (int b = 0; b < d; ++b) {
            kr[b] = k * (x[b] - other[b]);
        }
        for (int a = 0; a < d; ++a) {
            const vec w = v[a] - other[d + a];
            for (int b = 0; b < d; ++b) {
                sum[a * d + b] += w * kr[b];
            }
        }
    }
    load_inverse(p, m, d);
    for (int a = 0; a < d; ++a) {
        for (int b = 0; b < d; ++b) {
            vec rate = sum[a * d] * m[b];
            for (int c = 1; c < d; ++c) {
                rate += sum[a * d + c] * m[c * d + b];
            }
            store(job->rate_out + 9 * p->particle, 9, 3 * a + b, p->n_lanes, rate);
        }
    }
}

/* Adds F S_D to P, eqs. 46 and 47, where S_D = Pi sym(F^T dF/dt) / J is objective: it takes F at the time of dF/dt,
 * half a sub-step ago, so that a steady spin makes no stress. Returns S_D : sym(F^T dF/dt), power per reference
 * volume. */
INLINE vec add_damping(const vec *f, const vec *rate, vec viscosity, double half_step, vec *piola, const int d)
{
    vec s[9];
    vec power = zero();
    for (int a = 0; a < d; ++a) {
        for (int b = a; b < d; ++b) {
            vec sum = zero();
            for (int c = 0; c < d; ++c) {
                const vec ra = rate[3 * c + a];
                const vec rb = rate[3 * c + b];
                sum += ra * (f[3 * c + b] - half_step * rb) + (f[3 * c + a] - half_step * ra) * rb;
            }
            sum *= 0.5;
            power += (a == b ? 1.0 : 2.0) * sum * sum;
            s[3 * a + b] = s[3 * b + a] = viscosity * sum;
        }
    }
    for (int a = 0; a < d; ++a) {
        for (int b = 0; b < d; ++b) {
            for (int c = 0; c < d; ++c) {
                piola[3 * a + b] += f[3 * a + c] * s[3 * c + b];
            }
        }
    }
    return viscosity * power;
}

INLINE vec determinant_of(const vec *f)
{
    return f[0] * (f[4] * f[8] - f[5] * f[7]) + f[1] * (f[5] * f[6] - f[3] * f[8]) + f[2] * (f[3] * f[7] - f[4] * f[6]);
}

/* P F^T / J. */
INLINE void store_cauchy(const vec *piola, const vec *f, vec inverse_j, double *out, int n_lanes)
{
    static const int rows[6] = {0, 1, 2, 0, 1, 2};
    static const int columns[6] = {0, 1, 2, 1, 2, 0};
    for (int k = 0; k < 6; ++k) {
        const vec *a = piola + 3 * rows[k];
        const vec *b = f + 3 * columns[k];
        store(out, 6, k, n_lanes, (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * inverse_j);
    }
}

INLINE double stress_part(const mor_elastic_job *job, const part *p, int64_t first_particle, const int d)
{
    const int size = 2 * d + d * d;
    const mor_elastic_constants *body = &job->work->constants[p->cluster->body];
    double *own = job->work->stressed + p->slot * size;
    vec f[9];
    vec piola[9];
    vec m[9];
    vec power = zero();
    for (int k = 0; k < 9; ++k) {
        f[k] = load(job->gradient + 9 * p->particle, 9, k);
        piola[k] = load(job->piola + 9 * (p->particle - first_particle), 9, k);
    }
    const vec inverse_j = 1.0 / determinant_of(f);
    if (job->stress != NULL) {
        store_cauchy(piola, f, inverse_j, job->stress + 6 * p->particle, p->n_lanes);
    }
    if (job->damping_per_mass > 0.0) {
        vec rate[9];
        for (int k = 0; k < 9; ++k) {
            rate[k] = load(job->rate + 9 * p->particle, 9, k);
        }
        power = add_damping(f, rate, (job->damping_per_mass * body->density) * inverse_j, job->half_step, piola, d);
    }
    load_inverse(p, m, d);
    for (int a = 0; a < d; ++a) {
        for (int b = 0; b < d; ++b) {
            vec t = piola[3 * a] * m[b];
            for (int c = 1; c < d; ++c) {
                t += piola[3 * a + c] * m[c * d + b];
            }
            store(own, size, (2 + a) * d + b, p->n_lanes,
                  (0.5 * body->hourglass) * f[3 * a + b] - body->inverse_density * t);
        }
    }
    double sum = 0.0;
    for (int lane = 0; lane < p->n_lanes; ++lane) {
        sum += power[lane];
        for (int a = 0; a < d; ++a) {
            own[lane * size + d + a] = body->hourglass * job->position[3 * (p->particle + lane) + a];
        }
    }
    return sum;
}

INLINE double stress_range(const mor_elastic_job *job, int64_t first, int64_t last, const int d)
{
    const int64_t first_particle = job->work->clusters[first].first;
    double power = 0.0;
    for (int64_t c = first; c < last; ++c) {
        double sum = 0.0;
        for (int k = 0; k < PARTS; ++k) {
            const part p = part_of(job->work, c, k);
            sum += stress_part(job, &p, first_particle, d);
        }
        power += sum * job->work->constants[job->work->clusters[c].body].particle_volume;
    }
    return power;
}

INLINE double hourglass_range(const mor_elastic_job *job, int64_t first, int64_t last, const int d)
{
    double energy = 0.0;
    for (int64_t c = first; c < last; ++c) {
        const mor_elastic_constants *body = &job->work->constants[job->work->clusters[c].body];
        double sum = 0.0;
        for (int k = 0; k < PARTS; ++k) {
            const part p = part_of(job->work, c, k);
            sum += hourglass_part(job, &p, d);
        }
        energy += (0.25 * body->hourglass) * (body->density * body->particle_volume) * sum;
    }
    return energy;
}

/* A sum over clusters for each number of dimensions. */
#define MOR_ELASTIC_SUMS(name)                                                                                         \
    static double name##_2d(const mor_elastic_job *job, int64_t first, int64_t last)                                   \
    {                                                                                                                  \
        return name##_range(job, first, last, 2);                                                                      \
    }                                                                                                                  \
    static double name##_3d(const mor_elastic_job *job, int64_t first, int64_t last)                                   \
    {                                                                                                                  \
        return name##_range(job, first, last, 3);                                                                      \
    }
MOR_ELASTIC_SUMS(stress)
MOR_ELASTIC_SUMS(hourglass)

/* A loop over clusters for each number of dimensions. */
#define MOR_ELASTIC_LOOPS(name)                                                                                        \
    static void name##_2d(const mor_elastic_job *job, int64_t first, int64_t last)                                     \
    {                                                                                                                  \
        for (int64_t c = first * PARTS; c < last * PARTS; ++c) {                                                       \
            const part p = part_of(job->work, c / PARTS, (int)(c % PARTS));                                            \
            name##_part(job, &p, 2);                                                                                   \
        }                                                                                                              \
    }                                                                                                                  \
    static void name##_3d(const mor_elastic_job *job, int64_t first, int64_t last)                                     \
    {                                                                                                                  \
        for (int64_t c = first * PARTS; c < last * PARTS; ++c) {                                                       \
            const part p = part_of(job->work, c / PARTS, (int)(c % PARTS));                                            \
            name##_part(job, &p, 3);                                                                                   \
        }                                                                                                              \
    }
MOR_ELASTIC_LOOPS(forces)
MOR_ELASTIC_LOOPS(rate)

static void stretch(const mor_elastic_job *job, int64_t first, int64_t last)
{
    double *restrict gradient = job->gradient;
    const double *restrict rate = job->rate;
    const int64_t end = 9 * job->work->clusters[last].first;
    for (int64_t k = 9 * job->work->clusters[first].first; k < end; ++k) {
        gradient[k] += job->half_step * rate[k];
    }
}

static void density(const mor_elastic_job *job, int64_t first, int64_t last)
{
    for (int64_t c = first * PARTS; c < last * PARTS; ++c) {
        const part p = part_of(job->work, c / PARTS, (int)(c % PARTS));
        vec f[9];
        for (int k = 0; k < 9; ++k) {
            f[k] = load(job->gradient + 9 * p.particle, 9, k);
        }
        store(job->density + p.particle, 1, 0, p.n_lanes,
              job->work->constants[p.cluster->body].density / determinant_of(f));
    }
}

const mor_elastic_table *MOR_ISA_NAME(mor_elastic_table)(void);

const mor_elastic_table *MOR_ISA_NAME(mor_elastic_table)(void)
{
    static const mor_elastic_table table = {
        MOR_ISA_TEXT(MOR_ISA),  {forces_2d, forces_3d},      {rate_2d, rate_3d}, stretch, density,
        {stress_2d, stress_3d}, {hourglass_2d, hourglass_3d}};
    return &table;
}
