/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_LOG_STRAIN_H
#define MOR_MATERIALS_FRAME_LOG_STRAIN_H

#include "core/base/eigen.h"
#include "materials/frame/hooke.h"
#include "materials/frame/invariants.h"

#include <float.h>
#include <math.h>

/** @file
 *  Hencky elasticity of laws in rate form: the logarithmic elastic strain e = ln(b)/2 is carried as state, follows the
 *  motion exactly, and gives the Kirchhoff stress by Hooke's law. It is kept instead of the elastic left Cauchy-Green
 *  tensor b = exp(2e), which holds strains only to the rounding of 1. docs/theory/flow.md. */

/** Squared norm up to which series are used, 1; they are summed until what is left is below rounding. */
#define MOR_LOG_STRAIN_SERIES 0.04
#define MOR_LOG_STRAIN_REST (0.01 * DBL_EPSILON)

/** Returns a y + y a^T, unit 1. */
static inline mor_symmetric mor_log_strain_drive(mor_gradient a, mor_symmetric y)
{
    const double xx = a.xx * y.xx + a.xy * y.xy + a.xz * y.zx;
    const double xy = a.xx * y.xy + a.xy * y.yy + a.xz * y.yz;
    const double xz = a.xx * y.zx + a.xy * y.yz + a.xz * y.zz;
    const double yx = a.yx * y.xx + a.yy * y.xy + a.yz * y.zx;
    const double yy = a.yx * y.xy + a.yy * y.yy + a.yz * y.yz;
    const double yz = a.yx * y.zx + a.yy * y.yz + a.yz * y.zz;
    const double zx = a.zx * y.xx + a.zy * y.xy + a.zz * y.zx;
    const double zy = a.zx * y.xy + a.zy * y.yy + a.zz * y.yz;
    const double zz = a.zx * y.zx + a.zy * y.yz + a.zz * y.zz;
    return (mor_symmetric){2.0 * xx, 2.0 * yy, 2.0 * zz, xy + yx, yz + zy, zx + xz};
}

/** Returns a b for symmetric tensors that have the same principal directions, unit 1. */
static inline mor_symmetric mor_log_strain_multiply(mor_symmetric a, mor_symmetric b)
{
    return (mor_symmetric){a.xx * b.xx + a.xy * b.xy + a.zx * b.zx, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
                           a.zx * b.zx + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.zx * b.yz,
                           a.xy * b.zx + a.yy * b.yz + a.yz * b.zz, a.zx * b.xx + a.yz * b.xy + a.zz * b.zx};
}

/** Returns function(a) for a symmetric tensor of any size, by its principal values; unit 1. */
static inline mor_symmetric mor_log_strain_apply(mor_symmetric a, double (*function)(double))
{
    double tensor[6];
    double values[3];
    double n[9];
    mor_symmetric_write(a, tensor);
    mor_symmetric_eigen(tensor, values, n);
    mor_symmetric sum = {0};
    for (int k = 0; k < 3; ++k) {
        const double x = n[k];
        const double y = n[3 + k];
        const double z = n[6 + k];
        sum = mor_symmetric_add(sum, function(values[k]), (mor_symmetric){x * x, y * y, z * z, x * y, y * z, z * x});
    }
    return sum;
}

/** Returns ln(b)/2 from b - 1, unit 1. */
static inline double mor_log_strain_half_logarithm(double b_minus_1)
{
    return 0.5 * log1p(b_minus_1);
}

/** Returns b - I = exp(2e) - I, unit 1: by its series where the strain is small, as it nearly always is. */
static inline mor_symmetric mor_log_strain_stretch_of(mor_symmetric strain)
{
    const mor_symmetric x = mor_symmetric_add(strain, 1.0, strain);
    const double norm2 = mor_symmetric_product(x, x);
    if (!(norm2 <= MOR_LOG_STRAIN_SERIES)) {
        return mor_log_strain_apply(x, expm1);
    }
    const double norm = sqrt(norm2);
    mor_symmetric term = x;
    mor_symmetric sum = x;
    double bound = 0.5 * norm; /* of the next term over the first */
    for (int k = 2; bound > MOR_LOG_STRAIN_REST; ++k) {
        term = mor_symmetric_add((mor_symmetric){0}, 1.0 / k, mor_log_strain_multiply(term, x));
        sum = mor_symmetric_add(sum, 1.0, term);
        bound *= norm / (k + 1);
    }
    return sum;
}

/** Returns e = ln(b)/2 = artanh(x), x = (b - I)(b + I)^-1, from b - I, unit 1: likewise. */
static inline mor_symmetric mor_log_strain_of_stretch(mor_symmetric b_minus_1)
{
    const double norm2 = mor_symmetric_product(b_minus_1, b_minus_1);
    if (!(norm2 <= MOR_LOG_STRAIN_SERIES)) {
        return mor_log_strain_apply(b_minus_1, mor_log_strain_half_logarithm);
    }
    const double plus[6] = {2.0 + b_minus_1.xx, 2.0 + b_minus_1.yy, 2.0 + b_minus_1.zz,
                            b_minus_1.xy,       b_minus_1.yz,       b_minus_1.zx};
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(plus, cofactors);
    const mor_symmetric product = mor_log_strain_multiply(b_minus_1, mor_symmetric_read(cofactors));
    const mor_symmetric x = mor_symmetric_add((mor_symmetric){0}, 1.0 / determinant, product);
    const mor_symmetric x2 = mor_log_strain_multiply(x, x);
    const double ratio = mor_symmetric_product(x, x);
    mor_symmetric power = x;
    mor_symmetric sum = x;
    double bound = ratio; /* of the next power over the first */
    for (int k = 3; bound > MOR_LOG_STRAIN_REST; k += 2) {
        power = mor_log_strain_multiply(power, x2);
        sum = mor_symmetric_add(sum, 1.0 / k, power);
        bound *= ratio;
    }
    return sum;
}

/** Returns the logarithmic strain after a step without plastic flow, unit 1: b becomes f b f^T with the matrix
 * exponential f = exp(L dt). That is the solution of db/dt = L b + b L^T, of which b - I is summed as a series: a
 * rotation then adds nothing but rounding of the strain itself. Without motion the strain is untouched.
 *  @param strain [in]  at the start; unit 1
 *  @param motion [in]  velocity gradient times the step, norm at most 1; unit 1 */
static inline mor_symmetric mor_log_strain_advance(mor_symmetric strain, mor_gradient motion)
{
    const double norm2 = mor_gradient_norm2(motion);
    if (norm2 == 0.0) {
        return strain;
    }
    const double norm = sqrt(norm2); /* at most 1 */
    const mor_symmetric start = mor_log_strain_stretch_of(strain);
    mor_symmetric term = mor_symmetric_add(mor_log_strain_drive(motion, start), 2.0, mor_gradient_strain(motion));
    mor_symmetric sum = mor_symmetric_add(start, 1.0, term);
    double bound = 1.0; /* of a term over the first */
    for (int k = 2; bound > MOR_LOG_STRAIN_REST; ++k) {
        term = mor_symmetric_add((mor_symmetric){0}, 1.0 / k, mor_log_strain_drive(motion, term));
        sum = mor_symmetric_add(sum, 1.0, term);
        bound *= 2.0 * norm / k;
    }
    return mor_log_strain_of_stretch(sum);
}

/** Returns the logarithmic strain after a step that flows, unit 1: the more the stretch of the step exceeds the strain
 * at its start, the more of it comes after the rotation, (D6) of docs/theory/drucker_prager.md, for flow keeps nothing
 * of how the step began. exp(L dt) has half of it before. The volume is that of both.
 *  @param strain [in]  at the start; unit 1
 *  @param motion [in]  velocity gradient times the step, norm at most 1; unit 1
 *  @param exact  [in]  strain after the step without plastic flow; unit 1 */
static inline mor_symmetric mor_log_strain_flow(mor_symmetric strain, mor_gradient motion, mor_symmetric exact)
{
    const mor_symmetric stretch = mor_gradient_strain(motion);
    const double share = mor_invariant_turning(mor_invariant_j2(strain), mor_invariant_j2(stretch));
    const mor_gradient spin = {.xy = 0.5 * (motion.xy - motion.yx),
                               .yx = 0.5 * (motion.yx - motion.xy),
                               .yz = 0.5 * (motion.yz - motion.zy),
                               .zy = 0.5 * (motion.zy - motion.yz),
                               .zx = 0.5 * (motion.zx - motion.xz),
                               .xz = 0.5 * (motion.xz - motion.zx)};
    const mor_gradient only = {.xx = stretch.xx,
                               .yy = stretch.yy,
                               .zz = stretch.zz,
                               .xy = stretch.xy,
                               .yx = stretch.xy,
                               .yz = stretch.yz,
                               .zy = stretch.yz,
                               .zx = stretch.zx,
                               .xz = stretch.zx};
    const mor_symmetric after = mor_log_strain_advance(mor_log_strain_advance(strain, spin), only);
    return mor_symmetric_add(mor_symmetric_rescale(after, 1.0 - share, (1.0 - share) * mor_invariant_i1(after) / 3.0),
                             share, exact);
}

/** Returns the Kirchhoff stress of a logarithmic strain by Hooke's law, unit Pa. */
static inline mor_symmetric mor_log_strain_stress(const mor_hooke *c, mor_symmetric strain)
{
    const double mean = c->bulk * mor_invariant_i1(strain);
    return mor_symmetric_rescale(strain, c->two_shear, mean);
}

/** Returns the strain of a Kirchhoff stress [Pa], unit 1. */
static inline mor_symmetric mor_log_strain_of_stress(const mor_hooke *c, mor_symmetric stress)
{
    const double mean = mor_invariant_i1(stress) / (9.0 * c->bulk);
    return mor_symmetric_rescale(stress, 1.0 / c->two_shear, mean);
}

/** Returns the strain of a Cauchy stress, unit 1.
 *  @param volume [in]  J, current over reference volume, 1
 *  @param stress [in]  shape [6]; Pa */
static inline mor_symmetric mor_log_strain_of_cauchy(const mor_hooke *c, double volume, const double *stress)
{
    return mor_symmetric_add((mor_symmetric){0}, volume, mor_log_strain_of_stress(c, mor_symmetric_read(stress)));
}

/** Returns the stored energy per reference volume, unit J/m3. */
static inline double mor_log_strain_energy(const mor_hooke *c, mor_symmetric strain)
{
    const double volume = mor_invariant_i1(strain);
    return 0.5 * c->bulk * volume * volume + c->two_shear * mor_invariant_j2(strain);
}

/** Returns the stored energy per current volume, sigma : e/2, unit J/m3.
 *  @param s [in]  shape [6]; Cauchy stress, Pa
 *  @param e [in]  shape [6]; logarithmic elastic strain, 1 */
static inline double mor_log_strain_stored(const double *s, const double *e)
{
    return 0.5 * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]) + (s[3] * e[3] + s[4] * e[4] + s[5] * e[5]);
}

#endif
