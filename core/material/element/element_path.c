/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/element/element_path.h"

#include "core/base/eigen.h"
#include "core/base/math.h"

#include <math.h>

/* Strain rate and spin by rate of the measure: the axis shortens; volume is kept; planes across z slide along x; the
 * specimen turns about y. */
#define SHORTEN .measure = MOR_ELEMENT_AXIAL, .strain = {[MOR_ZZ] = -1.0}
#define KEEP_VOLUME .measure = MOR_ELEMENT_AXIAL, .strain = {[MOR_XX] = 0.5, [MOR_YY] = 0.5, [MOR_ZZ] = -1.0}
#define SLIDE .measure = MOR_ELEMENT_SHEAR, .strain = {[MOR_ZX] = 0.5}, .spin = {0.0, 0.0, -0.5}
#define TURN .measure = MOR_ELEMENT_ROTATION, .spin = {0.0, 0.0, 1.0}

#define LATERAL (1u << MOR_XX | 1u << MOR_YY)

static const mor_element_path paths[] = {
    {.name = "isotropic",
     .text = "equal compression from all sides: the differences of the normal stresses are kept",
     SHORTEN,
     .stress = LATERAL,
     .is_even = true},
    {.name = "oedometer", .text = "compression along the axis without lateral strain", SHORTEN},
    {.name = "triaxial-compression",
     .text = "drained: compression along the axis at constant lateral stress",
     SHORTEN,
     .stress = LATERAL},
    {.name = "triaxial-extension",
     .text = "drained: extension along the axis at constant lateral stress",
     SHORTEN,
     .stress = LATERAL,
     .is_backward = true},
    {.name = "undrained-compression", .text = "compression along the axis at constant volume", KEEP_VOLUME},
    {.name = "undrained-extension",
     .text = "extension along the axis at constant volume",
     KEEP_VOLUME,
     .is_backward = true},
    {.name = "true-triaxial",
     .text = "drained: compression along z at constant stress along x; that along y lies between by the share b",
     SHORTEN,
     .stress = LATERAL,
     .has_b = true},
    {.name = "simple-shear",
     .text = "drained: shear along x at constant stress along z, without lateral strain",
     SLIDE,
     .stress = 1u << MOR_ZZ},
    {.name = "undrained-shear", .text = "shear along x at constant volume", SLIDE},
    {.name = "cyclic-triaxial",
     .text = "drained: compression and extension in turns at constant lateral stress",
     SHORTEN,
     .stress = LATERAL,
     .is_cyclic = true},
    {.name = "cyclic-undrained-triaxial",
     .text = "compression and extension in turns at constant volume",
     KEEP_VOLUME,
     .is_cyclic = true},
    {.name = "cyclic-shear",
     .text = "drained: shear to and fro at constant stress along z",
     SLIDE,
     .stress = 1u << MOR_ZZ,
     .is_cyclic = true},
    {.name = "cyclic-undrained-shear", .text = "shear to and fro at constant volume", SLIDE, .is_cyclic = true},
    {.name = "spin", .text = "rotation about y without strain", TURN},
};

enum { N_PATHS = sizeof paths / sizeof *paths };

const mor_element_path *mor_element_path_at(int index)
{
    return index >= 0 && index < N_PATHS ? &paths[index] : NULL;
}

void mor_element_path_control(const mor_element_path *path, double rate, double b, mor_element_control *control)
{
    const double signed_rate = path->is_backward ? -rate : rate;
    *control = (mor_element_control){0};
    for (int k = 0; k < 3; ++k) {
        control->spin[k] = signed_rate * path->spin[k];
    }
    for (int k = 0; k < 6; ++k) {
        control->strain_rate[k] = signed_rate * path->strain[k];
        if ((path->stress >> k & 1u) != 0) {
            mor_element_control_stress(control, k, 0.0);
            control->condition[k][MOR_ZZ] -= path->is_even ? 1.0 : 0.0;
        }
    }
    if (path->has_b) {
        control->condition[MOR_YY][MOR_XX] = b - 1.0;
        control->condition[MOR_YY][MOR_ZZ] = -b;
    }
}

int mor_element_path_keeps_volume(const mor_element_path *path)
{
    return path->stress == 0 && path->measure != MOR_ELEMENT_ROTATION &&
           path->strain[0] + path->strain[1] + path->strain[2] == 0.0;
}

/* sum of squares of a tensor, shape [6] */
static double square_tensor(const double *t)
{
    return t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + 2.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
}

static void remove_mean(const double *tensor, double *deviator)
{
    const double mean = (tensor[0] + tensor[1] + tensor[2]) / 3.0;
    for (int k = 0; k < 6; ++k) {
        deviator[k] = tensor[k] - (k < 3 ? mean : 0.0);
    }
}

void mor_element_measure_all(const mor_element *element, bool is_signed, mor_element_measures *measures)
{
    const double *strain = element->strain;
    const double *stress = element->stress;
    double deviator[6];
    double principal[3];
    double directions[9];
    mor_element_measures m = {.axial_strain = 0.0 - strain[MOR_ZZ], /* no negative zero */
                              .shear_strain = 2.0 * strain[MOR_ZX],
                              .eps_v = 0.0 - (strain[0] + strain[1] + strain[2]),
                              .p = -(stress[0] + stress[1] + stress[2]) / 3.0,
                              .shear_stress = stress[MOR_ZX]};
    remove_mean(strain, deviator);
    m.eps_q = sqrt(square_tensor(deviator) * 2.0 / 3.0) * (is_signed && deviator[MOR_ZZ] > 0.0 ? -1.0 : 1.0);
    remove_mean(stress, deviator);
    m.q = sqrt(square_tensor(deviator) * 1.5) * (is_signed && deviator[MOR_ZZ] > 0.0 ? -1.0 : 1.0);
    mor_symmetric_eigen(stress, principal, directions);
    m.major = -fmin(principal[0], fmin(principal[1], principal[2]));
    m.minor = -fmax(principal[0], fmax(principal[1], principal[2]));
    m.friction = m.minor < 0.0 || m.major <= 0.0 ? NAN : asin((m.major - m.minor) / (m.major + m.minor));
    *measures = m;
}
