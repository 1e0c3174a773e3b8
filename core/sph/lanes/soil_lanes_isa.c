/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. In plane strain what is exactly zero is left out: velocity
 * gradients and moments have no part out of the plane. */
#include "core/sph/lanes/soil_lanes.h"

#include "core/particle/lane_math.h"
#include "core/sph/pair/pair.h"

#include <stdbool.h>

/* SPARSE: mean of the moment below which neighbors are too few for a fit; FEW: from where on it is taken as it is.
 * ALONE, AMONG: likewise over the soil alone, of a particle at a boundary; it is 0.3 in the corner of a block. CLOSE:
 * mean of the moment over boundaries from where on a particle is at one.
 * FLAT, THIN: determinant of the moment over the cube (square) of its mean below which there is no fit, and from where
 * on it is taken as it is. */
#define SPARSE 0.1
#define FEW 0.2
#define ALONE 0.15
#define AMONG 0.3
#define CLOSE 0.1
#define FLAT 0.02
#define THIN 0.1
/* Least part of the moment that the change of volume is taken to see: about that of a particle on an edge. */
#define LEAST_CLOSED 0.5
/* Mean of the kernel's moment: of a layer of single particles, and about that at the surface of a half-space. */
#define SINGLE 0.4
#define HALF 0.6
/* Added to the moments, over their trace: particles on a line turn about it without a moment. */
#define LEAST_MOMENT 1.0e-12

/* Rises from 0 to 1 between two values. */
INLINE vec fade(vec value, double from, double to)
{
    return larger(smaller((value - from) / (to - from), broadcast(1.0)), broadcast(0.0));
}

INLINE vec trace_of(const vec *m, const int dimension)
{
    return dimension == 3 ? m[MOR_XX] + m[MOR_YY] + m[MOR_ZZ] : m[MOR_XX] + m[MOR_YY];
}

/* Reads moments, of which plane strain has three. */
INLINE void load_moments(const double *moments, const int dimension, vec *m)
{
    load_first(moments, 6, 6, m);
    for (int a = 0; a < 6 && dimension == 2; ++a) {
        m[a] = a == MOR_XX || a == MOR_YY || a == MOR_XY ? m[a] : broadcast(0.0);
    }
}

/* Reads gradients, of which plane strain has four. */
INLINE void load_gradient(const double *gradient, const int dimension, vec *g)
{
    load_first(gradient, 9, 8, g);
    g[8] = dimension == 3 ? load(gradient, 9, 8) : broadcast(0.0);
    for (int a = 0; a < 8 && dimension == 2; ++a) {
        g[a] = a / 3 < dimension && a % 3 < dimension ? g[a] : broadcast(0.0);
    }
}

/* Product of symmetric tensors, shape [6], and vectors, shape [3]. */
INLINE void apply_symmetric(const vec *t, const vec *a, vec *out, const int dimension)
{
    out[0] = t[MOR_XX] * a[0] + t[MOR_XY] * a[1];
    out[1] = t[MOR_XY] * a[0] + t[MOR_YY] * a[1];
    out[2] = broadcast(0.0);
    if (dimension == 3) {
        out[0] += t[MOR_ZX] * a[2];
        out[1] += t[MOR_YZ] * a[2];
        out[2] = t[MOR_ZX] * a[0] + t[MOR_YZ] * a[1] + t[MOR_ZZ] * a[2];
    }
}

/* Inverse of a moment, symmetric, blended with the unit tensor as far as it is not trusted, and where neighbors lie in
 * a plane; in plane strain its out-of-plane entry counts as one. */
INLINE void invert_moment(const vec *m, vec trust, const int dimension, vec *inverse)
{
    const vec trace = trace_of(m, dimension);
    const vec mean = dimension == 3 ? trace / 3.0 : 0.5 * trace;
    const vec solid[6] = {m[MOR_XX], m[MOR_YY], dimension == 3 ? m[MOR_ZZ] : broadcast(1.0),
                          m[MOR_XY], m[MOR_YZ], m[MOR_ZX]};
    vec c[6];
    const vec determinant = symmetric_cofactors(solid, c, dimension);
    const vec cube = dimension == 3 ? mean * mean * mean : mean * mean;
    const vec few = fade(mean, SPARSE, FEW);
    const vec share = select_lanes(mean > SPARSE, trust * few * fade(determinant / cube, FLAT, THIN), broadcast(0.0));
    const vec part = select_lanes(share > 0.0, share / determinant, broadcast(0.0));
    for (int a = 0; a < 6; ++a) {
        inverse[a] = a < 3 ? (1.0 - share) + part * c[a] : part * c[a];
    }
}

/* What the fitted gradient, shape [9], makes of moments that boundaries continue, shape [6]. */
INLINE vec continue_volume(const vec *c, const vec *f, const int dimension)
{
    const vec plane = c[MOR_XX] * f[0] + c[MOR_YY] * f[4];
    const vec shear = c[MOR_XY] * (f[1] + f[3]);
    return dimension == 3 ? plane + c[MOR_ZZ] * f[8] + shear + c[MOR_YZ] * (f[5] + f[7]) + c[MOR_ZX] * (f[2] + f[6])
                          : plane + shear;
}

/* Replaces the summed gradient, shape [9], 1/s, by the fit, but for its trace; returns the rate of change of the
 * volume, 1/s. Where neighbors are few it leaves the sum: the fit of a particle alone at a boundary would be that of
 * the boundary, twice the rate that its force is the counterpart of, and a contact stiffer than the step allows.
 * moment: over the soil; closed, continued: with what boundaries close and continue of it, shape [6], 1; continued:
 * NULL for none. */
INLINE vec fit_gradient(const vec *moment, const vec *closed, const vec *continued, vec *gradient, const int dimension)
{
    vec inverse[6];
    vec f[9];
    vec trust = broadcast(1.0);
    if (continued != NULL) {
        const vec own = trace_of(moment, dimension) / (double)dimension;
        const vec all = (trace_of(closed, dimension) + trace_of(continued, dimension)) / (double)dimension;
        trust -= fade(all - own, 0.0, CLOSE) * (1.0 - fade(own, ALONE, AMONG));
    }
    invert_moment(closed, trust, dimension, inverse);
    for (int a = 0; a < dimension; ++a) {
        apply_symmetric(inverse, gradient + 3 * a, f + 3 * a, dimension);
    }
    vec volume = gradient[0] + gradient[4];
    vec sum = trace_of(closed, dimension);
    if (dimension == 3) {
        volume += gradient[8];
    }
    if (continued != NULL) {
        volume += continue_volume(continued, f, dimension);
        sum += trace_of(continued, dimension);
    }
    const vec fitted = 1.0 / larger(sum / (double)dimension, broadcast(LEAST_CLOSED));
    const vec scale = 1.0 + trust * (fitted - 1.0);
    const vec excess = scale * volume - f[0] - f[4];
    const vec change = (dimension == 3 ? excess - f[8] : excess) / (double)dimension;
    for (int a = 0; a < 3 * dimension; ++a) {
        gradient[a] = a % 4 == 0 ? f[a] + change : f[a];
    }
    return volume;
}

/* How far a gradient may stand for the motion around a particle, from its moments over the soil: as it is where at
 * least half of the kernel is filled, as below the surface of a half-space; not at all for a layer of grains. */
INLINE void store_strain_rate(const vec *moment, const vec *gradient, double *out, int n_lanes, const int dimension)
{
    const vec trust = fade(trace_of(moment, dimension) / (double)dimension, SINGLE, HALF);
    vec rate[6];
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const vec shear = 0.5 * (gradient[3 * a + b] + gradient[3 * b + a]);
        /* Adding zero clears the sign of a zero, which could depend on whether a wall is listed. */
        rate[a] = (gradient[4 * a] + 0.0) * trust;
        rate[3 + a] = (shear + 0.0) * trust;
    }
    store_first(out, 6, 6, n_lanes, rate);
}

/* Takes from the sum, shape [9], 1/s, what it makes of the rotation of a fitted gradient, W M with the moments of both,
 * shape [6], 1: its symmetric part is no strain. */
INLINE void remove_rotation(const vec *gradient, const vec *moment, vec *sum, const int dimension)
{
    for (int a = 0; a < dimension; ++a) {
        vec spin[3];
        vec turned[3];
        for (int b = 0; b < 3; ++b) {
            spin[b] = b < dimension ? 0.5 * (gradient[3 * a + b] - gradient[3 * b + a]) : broadcast(0.0);
        }
        apply_symmetric(moment, spin, turned, dimension);
        for (int b = 0; b < dimension; ++b) {
            sum[3 * a + b] -= turned[b];
        }
    }
}

/* Fades the rate of shear, the symmetric part of a gradient but for its trace, to that of the sum, both of shape [9],
 * 1/s, where soil flows. Forces do the work of the sum: the fit does more in thin and loose flows. */
INLINE void fade_shear(vec flow, const vec *sum, vec *gradient, const int dimension)
{
    vec volume = broadcast(0.0);
    for (int a = 0; a < dimension; ++a) {
        volume += (sum[4 * a] - gradient[4 * a]) / (double)dimension;
    }
    for (int a = 0; a < dimension; ++a) {
        gradient[4 * a] += flow * ((sum[4 * a] - gradient[4 * a]) - volume);
        for (int b = a + 1; b < dimension; ++b) {
            const int ab = 3 * a + b;
            const int ba = 3 * b + a;
            const vec change = flow * (0.5 * ((sum[ab] - gradient[ab]) + (sum[ba] - gradient[ba])));
            gradient[ab] += change;
            gradient[ba] += change;
        }
    }
}

INLINE void fit_part(const mor_soil_fit_job *job, int64_t first, const int dimension)
{
    const int n_lanes = lanes_of(first, job->n_particles);
    vec moment[6];
    vec closed[6];
    vec continued[6];
    vec sum[9];
    vec gradient[9];
    vec volume;
    load_moments(job->moments + 6 * first, dimension, moment);
    load_gradient(job->gradient + 9 * first, dimension, gradient);
    for (int a = 0; a < 9; ++a) {
        sum[a] = gradient[a];
    }
    const int64_t place = job->wall_places[first / MOR_CLUSTER];
    if (place >= 0) {
        const int64_t row = 6 * (place * MOR_CLUSTER + first % MOR_CLUSTER);
        load_moments(job->closed + row, dimension, closed);
        load_moments(job->continued + row, dimension, continued);
        volume = fit_gradient(moment, closed, continued, gradient, dimension);
    } else {
        volume = fit_gradient(moment, moment, NULL, gradient, dimension);
    }
    if (job->strain_rate != NULL) {
        store_strain_rate(moment, gradient, job->strain_rate + 6 * first, n_lanes, dimension);
    }
    if (job->flow != NULL) {
        remove_rotation(gradient, place >= 0 ? closed : moment, sum, dimension);
        fade_shear(load(job->flow + first, 1, 0), sum, gradient, dimension);
    }
    store_first(job->gradient + 9 * first, 9, dimension == 3 ? 8 : 5, n_lanes, gradient);
    if (dimension == 3) {
        store(job->gradient + 9 * first, 9, 8, n_lanes, gradient[8]);
    }
    store(job->density_rate + first, 1, 0, n_lanes, -load(job->density + first, 1, 0) * job->volume_factor * volume);
}

static void fit_clusters(const mor_soil_fit_job *job, int64_t first, int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        if (job->dimension == 3) {
            fit_part(job, part * LANES, 3);
        } else {
            fit_part(job, part * LANES, 2);
        }
    }
}

/* What is read of particles once for all that is remembered. */
typedef struct present {
    int64_t first; /* particle */
    int n_lanes;   /* particles of the set among the lanes */
    vec gradient[9], stress[6];
    vec fade, kept, part, limit2; /* of their soils, see mor_soil_memory_kind */
} present;

/* The pair forces sigma_i . grad W of particle i exert the moment of the skew part of M sigma_i about it, M being the
 * kernel's moment over the soil. A skew stress A beside sigma_i takes that away: M A + A M = M sigma - sigma M, which
 * for the axial vector a of A reads (tr M - M) a = axial vector of the right side. The moment that other pair forces
 * leave per volume, if any, is added to the right side. M runs over walls, too: they take moments as they take forces,
 * and without them soil at a wall would seem to have a surface there, whose skew stress disturbs its shear. */
INLINE void find_spin_stress(const vec *m, const vec *s, const vec *left, vec *spin, const int dimension)
{
    const vec trace = trace_of(m, dimension) * (1.0 + LEAST_MOMENT);
    const vec t[6] = {trace - m[MOR_XX], trace - m[MOR_YY], trace - m[MOR_ZZ], -m[MOR_XY], -m[MOR_YZ], -m[MOR_ZX]};
    vec c[6];
    const vec determinant = symmetric_cofactors(t, c, dimension);
    const mask is_solid = determinant > 0.0;
    const vec inverse = 1.0 / select_lanes(is_solid, determinant, broadcast(1.0));
    if (dimension == 2) {
        const vec side =
            left[2] + m[MOR_XY] * s[MOR_XX] + m[MOR_YY] * s[MOR_XY] - s[MOR_XY] * m[MOR_XX] - s[MOR_YY] * m[MOR_XY];
        spin[2] = c[MOR_ZZ] * side;
    } else {
        const vec side[3] = {left[0] + m[MOR_ZX] * s[MOR_XY] + m[MOR_YZ] * s[MOR_YY] + m[MOR_ZZ] * s[MOR_YZ] -
                                 s[MOR_ZX] * m[MOR_XY] - s[MOR_YZ] * m[MOR_YY] - s[MOR_ZZ] * m[MOR_YZ],
                             left[1] + m[MOR_XX] * s[MOR_ZX] + m[MOR_XY] * s[MOR_YZ] + m[MOR_ZX] * s[MOR_ZZ] -
                                 s[MOR_XX] * m[MOR_ZX] - s[MOR_XY] * m[MOR_YZ] - s[MOR_ZX] * m[MOR_ZZ],
                             left[2] + m[MOR_XY] * s[MOR_XX] + m[MOR_YY] * s[MOR_XY] + m[MOR_YZ] * s[MOR_ZX] -
                                 s[MOR_XY] * m[MOR_XX] - s[MOR_YY] * m[MOR_XY] - s[MOR_YZ] * m[MOR_ZX]};
        apply_symmetric(c, side, spin, 3);
    }
    for (int a = dimension == 2 ? 2 : 0; a < 3; ++a) {
        spin[a] = (vec)((mask)(spin[a] * inverse) & is_solid);
    }
}

INLINE void remember_spin(const mor_soil_memory_job *job, const present *now, const int dimension)
{
    const int64_t place = job->wall_places != NULL ? job->wall_places[now->first / MOR_CLUSTER] : -1;
    const double *moments =
        place >= 0 ? job->closed + 6 * (place * MOR_CLUSTER + now->first % MOR_CLUSTER) : job->moments + 6 * now->first;
    vec m[6];
    vec left[3] = {broadcast(0.0), broadcast(0.0), broadcast(0.0)};
    vec spin[3] = {broadcast(0.0), broadcast(0.0), broadcast(0.0)};
    load_moments(moments, dimension, m);
    if (job->left != NULL) {
        load_first(job->left + 3 * now->first, 3, 3, left);
    }
    find_spin_stress(m, now->stress, left, spin, dimension);
    store_first(job->spin + 3 * now->first, 3, 3, now->n_lanes, spin);
}

/* Rate of shear, the root of 2 e : e with the deviator e of the strain rate, 1/s. */
INLINE vec find_shear_rate(const vec *gradient, const int dimension)
{
    const vec trace = gradient[0] + gradient[4];
    const vec third = (dimension == 3 ? trace + gradient[8] : trace) / 3.0;
    vec sum = broadcast(0.0);
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < dimension; ++b) {
            const vec half = 0.5 * (gradient[3 * a + b] + gradient[3 * b + a]);
            const vec rate = a == b ? half - third : half;
            sum += 2.0 * rate * rate;
        }
    }
    return square_root(dimension == 3 ? sum : sum + 2.0 * third * third);
}

/* Adds what a turn by W, the skew part of the gradient times the step, adds to a tensor m, shape [6]: W m - m W. */
INLINE void turn_tensor(const vec *gradient, double length, vec *m, const int dimension)
{
    const double half = 0.5 * length;
    const vec xy = half * (gradient[1] - gradient[3]);
    if (dimension == 2) {
        const vec turned[5] = {2.0 * (xy * m[MOR_XY]), 2.0 * (-xy * m[MOR_XY]), xy * (m[MOR_YY] - m[MOR_XX]),
                               -xy * m[MOR_ZX], xy * m[MOR_YZ]};
        m[MOR_XX] += turned[0];
        m[MOR_YY] += turned[1];
        m[MOR_XY] += turned[2];
        m[MOR_YZ] += turned[3];
        m[MOR_ZX] += turned[4];
        return;
    }
    const vec yz = half * (gradient[5] - gradient[7]);
    const vec zx = half * (gradient[6] - gradient[2]);
    const vec turned[6] = {2.0 * (xy * m[MOR_XY] - zx * m[MOR_ZX]),
                           2.0 * (yz * m[MOR_YZ] - xy * m[MOR_XY]),
                           2.0 * (zx * m[MOR_ZX] - yz * m[MOR_YZ]),
                           xy * (m[MOR_YY] - m[MOR_XX]) - zx * m[MOR_YZ] + yz * m[MOR_ZX],
                           yz * (m[MOR_ZZ] - m[MOR_YY]) - xy * m[MOR_ZX] + zx * m[MOR_XY],
                           zx * (m[MOR_XX] - m[MOR_ZZ]) - yz * m[MOR_XY] + xy * m[MOR_YZ]};
    for (int a = 0; a < 6; ++a) {
        m[a] += turned[a];
    }
}

/* Turns the mean stress with the soil and lets it follow the stress by a part of their difference. */
INLINE void remember_mean(const mor_soil_memory_job *job, const present *now, const int dimension)
{
    vec m[6];
    load_first(job->mean + 6 * now->first, 6, 6, m);
    turn_tensor(now->gradient, job->length, m, dimension);
    for (int a = 0; a < 6; ++a) {
        m[a] += now->part * (now->stress[a] - m[a]);
    }
    store_first(job->mean + 6 * now->first, 6, 6, now->n_lanes, m);
    const vec moves = smaller(now->fade * find_shear_rate(now->gradient, dimension), broadcast(1.0));
    const vec left = now->kept * load(job->flow + now->first, 1, 0);
    store(job->flow + now->first, 1, 0, now->n_lanes, larger(moves, left));
}

/* Turns the hourglass displacement with the soil, moves it on, and limits its length. */
INLINE void remember_hourglass(const mor_soil_memory_job *job, const present *now, const int dimension)
{
    const vec *l = now->gradient;
    const vec *s = now->stress;
    const vec spin = 0.5 * (l[3] - l[1]); /* about z */
    vec d[3];
    vec turned[3];
    vec rate[3];
    load_first(job->hourglass + 3 * now->first, 3, dimension, d);
    load_first(job->hourglass_rate + 3 * now->first, 3, dimension, rate);
    if (dimension == 2) {
        turned[0] = d[0] + job->length * (rate[0] - spin * d[1]);
        turned[1] = d[1] + job->length * (rate[1] + spin * d[0]);
    } else {
        const vec spin_x = 0.5 * (l[7] - l[5]);
        const vec spin_y = 0.5 * (l[2] - l[6]);
        turned[0] = d[0] + job->length * (rate[0] + spin_y * d[2] - spin * d[1]);
        turned[1] = d[1] + job->length * (rate[1] + spin * d[0] - spin_x * d[2]);
        turned[2] = d[2] + job->length * (rate[2] + spin_x * d[1] - spin_y * d[0]);
    }
    const vec limit2 = now->limit2 * ((s[MOR_XX] * s[MOR_XX] + s[MOR_YY] * s[MOR_YY] + s[MOR_ZZ] * s[MOR_ZZ] +
                                       2.0 * (s[MOR_XY] * s[MOR_XY] + s[MOR_YZ] * s[MOR_YZ] + s[MOR_ZX] * s[MOR_ZX])) *
                                      (1.0 / 3.0));
    const vec plane2 = turned[0] * turned[0] + turned[1] * turned[1];
    const vec size2 = dimension == 3 ? plane2 + turned[2] * turned[2] : plane2;
    const mask is_large = size2 > limit2;
    const vec factor =
        select_lanes(is_large, square_root(limit2 / select_lanes(is_large, size2, broadcast(1.0))), broadcast(1.0));
    for (int a = 0; a < dimension; ++a) {
        turned[a] *= factor;
    }
    store_first(job->hourglass + 3 * now->first, 3, dimension, now->n_lanes, turned);
}

INLINE void load_kinds(const mor_soil_memory_job *job, present *now)
{
    const mor_soil_memory_kind *kind = job->kinds;
    now->fade = broadcast(kind->fade);
    now->kept = broadcast(kind->kept);
    now->part = broadcast(kind->part);
    now->limit2 = broadcast(kind->limit2);
    for (int lane = 0; lane < LANES && job->of_soil != NULL; ++lane) {
        kind = job->kinds + (int)job->of_soil[(now->first + lane) * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_INDEX];
        now->fade[lane] = kind->fade;
        now->kept[lane] = kind->kept;
        now->part[lane] = kind->part;
        now->limit2[lane] = kind->limit2;
    }
}

INLINE void remember_part(const mor_soil_memory_job *job, int64_t first, const int dimension)
{
    present now = {.first = first, .n_lanes = lanes_of(first, job->n_particles)};
    if (job->gradient != NULL) {
        load_gradient(job->gradient + 9 * first, dimension, now.gradient);
    }
    load_first(job->stress + 6 * first, 6, 6, now.stress);
    load_kinds(job, &now);
    if (job->spin != NULL) {
        remember_spin(job, &now, dimension);
    }
    if (job->mean != NULL) {
        remember_mean(job, &now, dimension);
    }
    if (job->hourglass != NULL) {
        remember_hourglass(job, &now, dimension);
    }
}

static void remember_clusters(const mor_soil_memory_job *job, int64_t first, int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        if (job->dimension == 3) {
            remember_part(job, part * LANES, 3);
        } else {
            remember_part(job, part * LANES, 2);
        }
    }
}

/* In face_lanes_isa.c. */
void MOR_ISA_NAME(mor_face_normals_find)(const double *faces, int stride, mor_face_normals *found);

extern const mor_soil_lanes MOR_ISA_NAME(mor_soil_lanes);

const mor_soil_lanes MOR_ISA_NAME(mor_soil_lanes) = {fit_clusters, remember_clusters,
                                                     MOR_ISA_NAME(mor_face_normals_find)};
