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
    const double sine = sin(angle);
    const double corner = sqrt(3.0) * (cone == MOR_DRUCKER_PRAGER_COMPRESSION ? 3.0 - sine : 3.0 + sine);
    return (mor_drucker_prager_surface){.slope = 2.0 * sine / corner, .strength = 6.0 * cohesion * cos(angle) / corner};
}
