/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/drucker_prager.h"

#include <math.h>

mor_drucker_prager_surface mor_drucker_prager_cone_fit(mor_drucker_prager_cone cone, double angle, double cohesion)
{
    if (cone == MOR_DRUCKER_PRAGER_PLANE_STRAIN) {
        const double tangent = tan(angle);
        const double root = sqrt(9.0 + 12.0 * tangent * tangent);
        return (mor_drucker_prager_surface){.slope = tangent / root, .strength = 3.0 * cohesion / root};
    }
    if (cone == MOR_DRUCKER_PRAGER_MATCHED) {
        return mor_drucker_prager_matched_fit(angle, cohesion, 0.0);
    }
    const double sine = sin(angle);
    const double corner = sqrt(3.0) * (cone == MOR_DRUCKER_PRAGER_COMPRESSION ? 3.0 - sine : 3.0 + sine);
    return (mor_drucker_prager_surface){.slope = 2.0 * sine / corner, .strength = 6.0 * cohesion * cos(angle) / corner};
}

/* Plane-strain flow holds the deviator across the plane at -2 d sqrt(J2), d the slope of the potential, so that half
 * the difference of the stresses in the plane is sqrt(J2 (1 - 3 d^2)), and half their sum I1/3 + d sqrt(J2). */
mor_drucker_prager_surface mor_drucker_prager_matched_fit(double angle, double cohesion, double dilation)
{
    const double slope = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, dilation, 0.0).slope;
    const double sine = sin(angle);
    const double divisor = sqrt(1.0 - 3.0 * slope * slope) + slope * sine;
    return (mor_drucker_prager_surface){.slope = sine / (3.0 * divisor), .strength = cohesion * cos(angle) / divisor};
}
