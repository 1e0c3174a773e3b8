/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_HEXAGON_H
#define MOR_MATERIALS_FRAME_HEXAGON_H

#include "materials/frame/principal_lanes.h"

/** @file
 *  The return to a pyramid (Mohr-Coulomb) or prism (Tresca) of six planes in principal stresses: backward Euler, exact
 *  because planes are flat; to a plane, an edge of two planes, or the apex. Koiter (1953); de Souza Neto, Peric and
 *  Owen (2008), section 8.2. docs/theory/mohr_coulomb.md.
 *
 *  f = (1 + sin phi) first - (1 - sin phi) third - strength; the potential has the dilation angle in place of phi. */

/** Constants of the planes. */
typedef struct mor_hexagon {
    double major;             /* 1 + sin(phi), 1 */
    double minor;             /* 1 - sin(phi), 1 */
    double inverse_major;     /* 1/(1 + sin(phi)), 1 */
    double sine_dilation;     /* sin(psi), 1 */
    double drop[3];           /* what the principal stresses lose by unit multiplier of a plane, Pa */
    double drop_extension;    /* what the mean of the lower two loses at the edge second = third, Pa */
    double stiffness;         /* loss of f by unit multiplier of its plane, Pa */
    double inverse_stiffness; /* 1/Pa */
    double inverse_edge[2];   /* sum of both multipliers by sum of both f, 1/Pa: edge first = second, second = third */
} mor_hexagon;

/** What a return gives. */
typedef struct mor_hexagon_end {
    mor_principal stress; /* Pa; the start where f is not positive */
    double multiplier;    /* sum of the plastic multipliers, negative inside, no meaning at the apex; 1 */
    double softening;     /* loss of the multiplier by unit strength, 1/Pa */
} mor_hexagon_end;

/** Makes the constants.
 *  @param sine          [in]  sin(phi), 0 <= sine < 1; unit 1
 *  @param sine_dilation [in]  sin(psi), 0 <= sin(psi) <= sin(phi); unit 1 */
static inline mor_hexagon mor_hexagon_constants(const mor_hooke *elastic, double sine, double sine_dilation)
{
    const double mean = 2.0 * elastic->lame * sine_dilation;
    const double first = elastic->two_shear * (1.0 + sine_dilation);
    const double third = elastic->two_shear * (1.0 - sine_dilation);
    mor_hexagon h = {.major = 1.0 + sine,
                     .minor = 1.0 - sine,
                     .inverse_major = 1.0 / (1.0 + sine),
                     .sine_dilation = sine_dilation,
                     .drop = {mean + first, mean, mean - third},
                     .drop_extension = mean - 0.5 * third};
    h.stiffness = h.major * h.drop[0] - h.minor * h.drop[2];
    h.inverse_stiffness = 1.0 / h.stiffness;
    /* A multiplier of the one plane lowers the f of the other through the components both share. */
    h.inverse_edge[0] = 1.0 / (h.stiffness + (h.major * h.drop[1] - h.minor * h.drop[2]));
    h.inverse_edge[1] = 1.0 / (h.stiffness + (h.major * h.drop[0] - h.minor * h.drop[1]));
    return h;
}

/** The yield function; strength, stress and result in Pa. */
static MOR_LANES_INLINE double mor_hexagon_yield(const mor_hexagon *h, double strength, mor_principal t)
{
    return h->major * t.first - h->minor * t.third - strength;
}

/** Whether the yield function f [Pa] of a trial is above rounding: 1 or 0. */
static MOR_LANES_INLINE int mor_hexagon_is_outside(double f, double strength, mor_principal t)
{
    return f > MOR_PRINCIPAL_ROUNDING * (fabs(t.first) + fabs(t.third) + strength);
}

/** Returns a trial to the surface. The plane holds where the order of the stresses stays; else the side of the plane
 *  through axis and flow direction tells the edge; and where an edge would be left beyond its end, it is the apex.
 *  Selections instead of branches, so that all lanes run the same instructions.
 *  @param strength [in]  2 c cos(phi) or 2 s_u; unit Pa
 *  @param apex     [in]  c / tan(phi), INFINITY without friction; unit Pa
 *  @param t        [in]  trial; Pa */
static MOR_LANES_INLINE mor_hexagon_end mor_hexagon_return(const mor_hexagon *h, double strength, double apex,
                                                           mor_principal t)
{
    const double f = mor_hexagon_yield(h, strength, t);
    const double on_plane = f * h->inverse_stiffness;
    const double p1 = t.first - on_plane * h->drop[0];
    const double p2 = t.second - on_plane * h->drop[1];
    const double p3 = t.third - on_plane * h->drop[2];
    const int is_plane = (p1 >= p2) & (p2 >= p3);

    const double side = (t.first - t.second) + (t.third - t.second) - h->sine_dilation * (t.first - t.third);
    const int is_extension = side > 0.0;
    const double neighbor = is_extension ? h->major * t.first - h->minor * t.second - strength
                                         : h->major * t.second - h->minor * t.third - strength;
    const double inverse_edge = is_extension ? h->inverse_edge[1] : h->inverse_edge[0];
    const double on_edge = (f + neighbor) * inverse_edge;
    const double lowest =
        is_extension ? 0.5 * (t.second + t.third) - on_edge * h->drop_extension : t.third - on_edge * h->drop[2];
    const int is_apex = !is_plane & (lowest > apex);

    /* The largest from the lowest through f = 0, so that the end lies on the surface to its own rounding. */
    const double third = is_plane ? p3 : lowest;
    const double first = (strength + h->minor * third) * h->inverse_major;
    const double second = is_plane ? p2 : (is_extension ? third : first);
    const int is_plastic = mor_hexagon_is_outside(f, strength, t);
    return (mor_hexagon_end){
        .stress = {is_plastic ? (is_apex ? apex : first) : t.first, is_plastic ? (is_apex ? apex : second) : t.second,
                   is_plastic ? (is_apex ? apex : third) : t.third},
        .multiplier = is_plane ? on_plane : on_edge,
        .softening = is_plane ? h->inverse_stiffness : 2.0 * inverse_edge,
    };
}

#endif
