/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The audit of the momentum loop. Compiled once per instruction set; MOR_ISA is its name. */
#include "core/sph/pair/pair_audit.h"
#include "core/sph/pair/pair_lanes.h"

/* Relative motion times distance below which nothing moves, m2/s: far below rounding, far above the smallest number. */
#define LEAST_MOTION 1.0e-200

/* What a copy of the loop over the Riemann terms does; constant in each copy. The other parts have no copies: their
 * loops are short, and each audit runs those it needs. */
typedef struct audit_form {
    int dimension;
    int linear;  /* velocities reconstructed at the middle of a pair */
    int several; /* soils of unlike constants */
} audit_form;

/* A part of a cluster. Sums lack the factor of the kernel gradient and the volume of the particle. */
typedef struct audit_part {
    int64_t first; /* particle */
    frame frame;
    mask counts_closing, counts_opening; /* all bits where the dissipation acts on a pair that closes, opens */
    vec v[3], middle[3]; /* own velocity that the momentum loop saw, and in the middle of the kick, m/s */
    vec impedance, pressure;
    vec strain_rate[6];           /* own, with reconstruction */
    vec limiter, soil, stiffness; /* own, with several soils */
    vec powers[MOR_PAIR_POWERS];
} audit_part;

/* Components of a stress with its skew part. */
enum { XX, XY, XZ, YX, YY, YZ, ZX, ZY, ZZ, TENSOR };

/* What a chunk of targets is to every part of the forces, and of what kind the stresses are that are asked for. */
typedef struct audit_chunk {
    const mor_pair_audit_job *job;
    const int32_t *near;  /* targets */
    int n;                /* of them, 1 */
    geometries *found;    /* of the present part of the cluster */
    const double *stress; /* shape [n, TENSOR], Pa; as find_tensor, NULL: not asked for */
} audit_chunk;

INLINE void start_part(audit_part *part, const mor_pair_audit_job *job, int64_t first, const audit_form form)
{
    const mor_pair_constants *c = job->constants;
    const mor_pair_arrays *arrays = job->arrays;
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    memset(part, 0, sizeof *part);
    part->first = first;
    part->frame = frame_of(c, own, MOR_RECORD_SIZE);
    part->counts_closing -= c->dissipation != MOR_DISSIPATION_SEPARATION;
    part->counts_opening -= c->dissipation != MOR_DISSIPATION_APPROACH;
    part->impedance = load(own, MOR_RECORD_SIZE, MOR_RECORD_IMPEDANCE);
    part->pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    const int n_lanes = lanes_of(first, arrays->n_particles);
    for (int a = 0; a < 3; ++a) {
        part->v[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_VELOCITY + a);
        for (int lane = 0; lane < n_lanes; ++lane) {
            part->middle[a][lane] = 0.5 * (part->v[a][lane] + job->velocity[3 * (first + lane) + a]);
        }
    }
    for (int a = 0; a < 6 && form.linear; ++a) {
        part->strain_rate[a] = load(arrays->strain_rate + first * 6, 6, a);
    }
    if (form.several) {
        const double *of_soil = arrays->of_soil + first * MOR_PAIR_OF_SOIL_SIZE;
        part->limiter = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_LIMITER);
        part->soil = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX);
    }
    part->stiffness = broadcast(c->hourglass);
    for (int lane = 0; lane < LANES && form.several; ++lane) {
        part->stiffness[lane] = c->soils[(int)part->soil[lane]].hourglass;
    }
}

/* r . (D_i + D_j) r of two strain rates. */
INLINE vec stretch(const pair *p, const vec *own, const double *other, const int dimension)
{
    vec d[6];
    for (int a = 0; a < 6; ++a) {
        d[a] = own[a] + other[a];
    }
    const vec *r = p->r;
    const vec x = multiply_add(r[0], d[MOR_XX], r[1] * (2.0 * d[MOR_XY]));
    const vec plane = multiply_add(r[0], x, r[1] * r[1] * d[MOR_YY]);
    if (dimension == 2) {
        return plane;
    }
    const vec shear = multiply_add(r[0], d[MOR_ZX], r[1] * d[MOR_YZ]);
    return multiply_add(r[2], multiply_add(r[2], d[MOR_ZZ], 2.0 * shear), plane);
}

/* Isotropic stress of the Riemann terms of a pair, (S7) with (S10b), Pa. */
INLINE vec riemann_stress(const audit_part *own, const pair *p, vec distance, const double *target,
                          const mor_pair_audit_job *job, int32_t j, const audit_form form)
{
    const mor_pair_constants *c = job->constants;
    const double *of_soil = of_soil_of(job->arrays, j, form.several);
    const vec *v = own->v;
    const vec impedances = own->impedance + target[MOR_RECORD_IMPEDANCE];
    const vec way = dot_r(p, target[4] - v[0], target[5] - v[1], target[6] - v[2], form.dimension);
    /* Division is slow: all quotients share one. */
    const vec moves = select_lanes(magnitude(way) > LEAST_MOTION, way, broadcast(1.0));
    const vec divisor = distance * impedances;
    const vec inverse_of_all = 1.0 / (form.linear ? divisor * moves : divisor);
    const vec inverse = form.linear ? inverse_of_all * moves : inverse_of_all;
    vec jump = way;
    vec share = broadcast(1.0);
    if (form.linear) {
        const vec half = 0.5 * stretch(p, own->strain_rate, job->arrays->strain_rate + (int64_t)j * 6, form.dimension);
        const vec rest = way + half;
        /* Never larger than the whole, never of its other sign. */
        jump = larger(smaller(rest, positive_part(way)), smaller(way, broadcast(0.0)));
        share = jump * (inverse_of_all * divisor);
    }
    const vec closing = jump * (inverse * impedances);
    const vec rate = form.several ? own->limiter + of_soil[MOR_PAIR_OF_SOIL_LIMITER] : broadcast(c->limiter_rate);
    const vec slope = closing * rate;
    const vec counted = larger((vec)((mask)slope & own->counts_closing), (vec)((mask)-slope & own->counts_opening));
    const vec limited = smaller(counted, broadcast(1.0)) * closing * share;
    vec pressures = (own->pressure - target[MOR_RECORD_PRESSURE]) * (own->impedance - target[MOR_RECORD_IMPEDANCE]);
    if (form.several) {
        pressures = (vec)((mask)pressures & (own->soil == of_soil[MOR_PAIR_OF_SOIL_INDEX]));
    }
    const vec dissipation = -2.0 * own->impedance * target[MOR_RECORD_IMPEDANCE];
    return multiply_add(dissipation, limited, pressures) * (inverse * distance);
}

INLINE void add_riemann(audit_part *part, const audit_chunk *it, const audit_form form)
{
    const vec *u = part->middle;
    vec sum = part->powers[MOR_PAIR_POWER_RIEMANN];
    for (int q = 0; q < it->n; ++q) {
        const double *target = target_of(it->job->arrays, it->near[q]);
        const geometry g = geometry_at(it->found, q, 0);
        pair p;
        separate(p.r, &part->frame, target, form.dimension);
        const vec stress = riemann_stress(part, &p, g.distance, target, it->job, it->near[q], form);
        sum += g.k * stress * dot_r(&p, u[0], u[1], u[2], form.dimension);
    }
    part->powers[MOR_PAIR_POWER_RIEMANN] = sum;
}

/* Stiffness between particle i and j over that of i, as in the momentum loop. */
INLINE vec stiffness_over(const audit_part *part, const mor_pair_audit_job *job, int32_t j)
{
    const double *of_soil = of_soil_of(job->arrays, j, 1);
    const double other = job->constants->soils[(int)of_soil[MOR_PAIR_OF_SOIL_INDEX]].hourglass;
    const vec sum = part->stiffness + other;
    return select_lanes(sum > 0.0, 2.0 * other / sum, broadcast(0.0));
}

INLINE void add_hourglass(audit_part *part, const audit_chunk *it, const audit_form form)
{
    const vec *u = part->middle;
    vec d[3];
    vec sum = part->powers[MOR_PAIR_POWER_HOURGLASS];
    for (int a = 0; a < 3; ++a) {
        d[a] = load(it->job->hourglass + 3 * part->first, 3, a);
    }
    for (int q = 0; q < it->n; ++q) {
        const double *other = it->job->hourglass + 3 * mor_images_owner(it->job->images, it->near[q]);
        vec work = multiply_add(d[0] - other[0], u[0], (d[1] - other[1]) * u[1]);
        work = form.dimension == 3 ? multiply_add(d[2] - other[2], u[2], work) : work;
        const vec k = form.several ? it->found->k[q] * stiffness_over(part, it->job, it->near[q]) : it->found->k[q];
        sum += k * part->stiffness * work;
    }
    part->powers[MOR_PAIR_POWER_HOURGLASS] = sum;
}

/* The stress of a particle of which the power is asked for, with or without its symmetric and its skew part, Pa. */
INLINE void find_tensor(const mor_pair_audit_job *job, int64_t j, double *t)
{
    const double *s = job->arrays->records + j * MOR_RECORD_SIZE + MOR_RECORD_STRESS;
    const double part = job->has_stress ? 1.0 : 0.0;
    double skew[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < 3 && job->constants->has_spin; ++a) {
        skew[a] = job->spin[3 * mor_images_owner(job->images, j) + (a + 2) % 3];
    }
    t[XX] = part * s[MOR_XX];
    t[YY] = part * s[MOR_YY];
    t[ZZ] = part * s[MOR_ZZ];
    t[YX] = part * s[MOR_XY] + skew[0];
    t[XY] = part * s[MOR_XY] - skew[0];
    t[ZY] = part * s[MOR_YZ] + skew[1];
    t[YZ] = part * s[MOR_YZ] - skew[1];
    t[XZ] = part * s[MOR_ZX] + skew[2];
    t[ZX] = part * s[MOR_ZX] - skew[2];
}

/* Stresses act by their divergence: the force on a particle has its own stress, too. */
INLINE void add_stress(audit_part *part, const audit_chunk *it, const audit_form form)
{
    double of_lanes[LANES * TENSOR];
    vec own[TENSOR];
    vec sum = part->powers[MOR_PAIR_POWER_STRESS];
    for (int lane = 0; lane < LANES; ++lane) {
        find_tensor(it->job, part->first + lane, of_lanes + TENSOR * lane);
    }
    for (int a = 0; a < TENSOR; ++a) {
        own[a] = load(of_lanes, TENSOR, a);
    }
    const vec *u = part->middle;
    for (int q = 0; q < it->n; ++q) {
        const double *t = it->stress + (ptrdiff_t)TENSOR * q;
        vec r[3];
        separate(r, &part->frame, target_of(it->job->arrays, it->near[q]), form.dimension);
        vec work[3];
        for (int a = 0; a < form.dimension; ++a) {
            work[a] = multiply_add(own[3 * a] + t[3 * a], r[0], (own[3 * a + 1] + t[3 * a + 1]) * r[1]);
            work[a] = form.dimension == 3 ? multiply_add(own[3 * a + 2] + t[3 * a + 2], r[2], work[a]) : work[a];
        }
        vec all = multiply_add(work[0], u[0], work[1] * u[1]);
        all = form.dimension == 3 ? multiply_add(work[2], u[2], all) : all;
        sum += it->found->k[q] * all;
    }
    part->powers[MOR_PAIR_POWER_STRESS] = sum;
}

/* f^n (R_i + R_j) of (S7) where a pair is under tension. */
INLINE void add_artificial(audit_part *part, const audit_chunk *it, const audit_form form)
{
    const mor_pair_constants *c = it->job->constants;
    const mor_pair_arrays *arrays = it->job->arrays;
    const vec *u = part->middle;
    vec own[6];
    vec size = broadcast(0.0);
    vec sum = part->powers[MOR_PAIR_POWER_ARTIFICIAL];
    for (int a = 0; a < 6; ++a) {
        own[a] = load(arrays->artificial_stress + part->first * 6, 6, a);
        size -= magnitude(own[a]);
    }
    const bool has_own = any_less(size, 0.0);
    for (int q = 0; q < it->n; ++q) {
        const double *other = arrays->artificial_stress + (int64_t)it->near[q] * 6;
        if (!has_own && other[MOR_XX] == 0.0 && other[MOR_YY] == 0.0 && other[MOR_ZZ] == 0.0) {
            continue;
        }
        pair p;
        separate(p.r, &part->frame, target_of(arrays, it->near[q]), form.dimension);
        const vec reach = positive_part(1.0 - it->found->distance[q] * part->frame.half_inverse_h);
        vec s[6];
        for (int a = 0; a < 6; ++a) {
            s[a] = own[a] + other[a];
        }
        const vec power = artificial_factor(reach, s[MOR_XX] + s[MOR_YY] + s[MOR_ZZ], c);
        for (int a = 0; a < 6; ++a) {
            s[a] *= power;
        }
        const vec force[3] = {dot_r(&p, s[MOR_XX], s[MOR_XY], s[MOR_ZX], form.dimension),
                              dot_r(&p, s[MOR_XY], s[MOR_YY], s[MOR_YZ], form.dimension),
                              dot_r(&p, s[MOR_ZX], s[MOR_YZ], s[MOR_ZZ], form.dimension)};
        const vec plane = multiply_add(force[0], u[0], force[1] * u[1]);
        sum += it->found->k[q] * (form.dimension == 3 ? multiply_add(force[2], u[2], plane) : plane);
    }
    part->powers[MOR_PAIR_POWER_ARTIFICIAL] = sum;
}

INLINE void find_chunk(const audit_chunk *it, const audit_part *part, const audit_form form)
{
    for (int q = 0; q < it->n; ++q) {
        const double *target = target_of(it->job->arrays, it->near[q]);
        __builtin_prefetch(target + MOR_RECORD_STRESS);
        if (form.linear) {
            __builtin_prefetch(it->job->arrays->strain_rate + (int64_t)it->near[q] * 6);
        }
        find_geometry(it->found, q, target, &part->frame, form.dimension, 0);
    }
}

INLINE void finish_part(const audit_part *part, const mor_pair_audit_job *job)
{
    const double *own = job->arrays->records + part->first * MOR_RECORD_SIZE;
    const vec factor = job->constants->gradient_factor * load(own, MOR_RECORD_SIZE, MOR_RECORD_VOLUME);
    for (int k = 0; k < MOR_PAIR_POWERS; ++k) {
        store(job->powers + part->first * MOR_PAIR_POWERS, MOR_PAIR_POWERS, k,
              lanes_of(part->first, job->arrays->n_particles), factor * part->powers[k]);
    }
}

INLINE void audit_chunk_of(audit_part *part, const audit_chunk *it, const audit_form form)
{
    const mor_pair_constants *c = it->job->constants;
    find_chunk(it, part, form);
    add_riemann(part, it, form);
    if (c->has_hourglass) {
        add_hourglass(part, it, form);
    }
    if (it->stress != NULL) {
        add_stress(part, it, form);
    }
    if (c->has_artificial_stress) {
        add_artificial(part, it, form);
    }
}

INLINE void audit_cluster(const mor_pair_audit_job *job, int64_t cluster, const audit_form form)
{
    mor_near_reader reader;
    mor_near_open(&reader, job->arrays->inner, cluster);
    const bool has_stress = job->has_stress || job->constants->has_spin;
    audit_part parts[PARTS];
    geometries found;
    double stress[CHUNK * TENSOR];
    for (int k = 0; k < PARTS; ++k) {
        start_part(parts + k, job, cluster * MOR_CLUSTER + k * LANES, form);
    }
    while (mor_near_next(&reader, CHUNK)) {
        for (int q = 0; q < reader.n && has_stress; ++q) {
            find_tensor(job, reader.targets[q], stress + (ptrdiff_t)TENSOR * q);
        }
        const audit_chunk it = {job, reader.targets, reader.n, &found, has_stress ? stress : NULL};
        for (int k = 0; k < PARTS; ++k) {
            audit_chunk_of(parts + k, &it, form);
        }
    }
    for (int k = 0; k < PARTS; ++k) {
        finish_part(parts + k, job);
    }
}

INLINE void audit_run(const mor_pair_audit_job *job, int64_t first, int64_t last, const audit_form form)
{
#define MOR_AUDIT_CASE(d, l, s)                                                                                        \
    if (form.dimension == (d) && form.linear == (l) && form.several == (s)) {                                          \
        for (int64_t cluster = first; cluster < last; ++cluster) {                                                     \
            audit_cluster(job, cluster, (audit_form){d, l, s});                                                        \
        }                                                                                                              \
    }
    MOR_AUDIT_CASE(2, 0, 0)
    MOR_AUDIT_CASE(2, 1, 0)
    MOR_AUDIT_CASE(2, 0, 1)
    MOR_AUDIT_CASE(2, 1, 1)
    MOR_AUDIT_CASE(3, 0, 0)
    MOR_AUDIT_CASE(3, 1, 0)
    MOR_AUDIT_CASE(3, 0, 1)
    MOR_AUDIT_CASE(3, 1, 1)
}

void MOR_ISA_NAME(mor_pair_audit)(const mor_pair_audit_job *job, int64_t first, int64_t last);

void MOR_ISA_NAME(mor_pair_audit)(const mor_pair_audit_job *job, int64_t first, int64_t last)
{
    const mor_pair_constants *c = job->constants;
    const int linear = job->arrays->strain_rate != NULL;
    mor_pair_constants of_run;
    int several = 0;
    mor_pair_audit_job run = *job;
    for (int64_t end = last; first < last; first = end) {
        end = last;
        if (c->soils != NULL) {
            end = find_run(job->arrays, c, first, last, &of_run, &several);
            run.constants = &of_run;
        }
        audit_run(&run, first, end, (audit_form){c->dimension, linear, several});
    }
}
