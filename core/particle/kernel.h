/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_KERNEL_H
#define MOR_CORE_PARTICLE_KERNEL_H

#include "core/base/math.h"

/** @file
 *  The Wendland C2 kernel, Zhang et al. (2024) eq. 61: W(q) = alpha_d (1 - q/2)^4 (2 q + 1), q = r / h <= 2.
 *  Its gradient is -(5 alpha_d / h^2) (1 - q/2)^3 (r_i - r_j): the pair loops use this form, which needs no
 *  division. */

/** Kernel support over smoothing length, 1. */
#define MOR_KERNEL_SUPPORT 2.0

/** Normalization alpha_d [1/m^d] for a smoothing length [m] in 1, 2 or 3 dimensions. */
static inline double mor_kernel_normalization(double smoothing_length, int dimension)
{
    const double h = smoothing_length;
    if (dimension == 1) {
        return 3.0 / (4.0 * h);
    }
    return dimension == 2 ? 7.0 / (4.0 * MOR_PI * h * h) : 21.0 / (16.0 * MOR_PI * h * h * h);
}

/** Value [1/m^d] at a distance [m]. */
static inline double mor_kernel_value(double distance, double smoothing_length, int dimension)
{
    const double q = distance / smoothing_length;
    const double u = q < 2.0 ? 1.0 - 0.5 * q : 0.0;
    return mor_kernel_normalization(smoothing_length, dimension) * (u * u) * (u * u) * (2.0 * q + 1.0);
}

/** Derivative dW/dr [1/m^(d+1)] at a distance [m]; never positive. */
static inline double mor_kernel_derivative(double distance, double smoothing_length, int dimension)
{
    const double q = distance / smoothing_length;
    const double u = q < 2.0 ? 1.0 - 0.5 * q : 0.0;
    return -5.0 * mor_kernel_normalization(smoothing_length, dimension) / smoothing_length * q * (u * u * u);
}

/** Integral of the kernel in space over a plane at a distance [smoothing lengths], over that of a plane through its
 *  center, 1. In the plane that over a line is within 0.01 of it. */
static inline double mor_kernel_plane_share(double distance)
{
    const double u = distance < 2.0 ? 1.0 - 0.5 * distance : 0.0;
    const double u2 = u * u;
    return 14.0 * u2 * u2 * u * (1.0 - 1.5 * u + (4.0 / 7.0) * u2);
}

/** The factor [1/m^(d+2)] in grad_i W = -factor * (1 - q/2)^3 * (r_i - r_j). */
static inline double mor_kernel_gradient_factor(double smoothing_length, int dimension)
{
    return 5.0 * mor_kernel_normalization(smoothing_length, dimension) / (smoothing_length * smoothing_length);
}

#endif
