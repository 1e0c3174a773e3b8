/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SETTINGS_SOIL_SETTINGS_H
#define MOR_CORE_SPH_SETTINGS_SOIL_SETTINGS_H

#include "core/base/guard.h"
#include "core/geometry/domain.h"
#include "core/material/kit/material.h"
#include "core/scheme/scheme.h"
#include "core/sph/sleep/hold.h"

/** @file
 *  What soil is built from, and what follows from it before there is a particle. */

/** What the scheme takes of one of several soils. */
typedef struct mor_soil_kind {
    double reference_density; /* rho_0, kg/m3 */
    double lateral_ratio;     /* K0 of the stress-diffusion operator, 1 */
    int same_as;              /* first of the soils with the same material, which it is one soil with */
    double sound_speed;       /* c0, m/s; found by mor_soil_init */
} mor_soil_kind;

/** What a soil is built from, beside its material. Plain data. */
typedef struct mor_soil_settings {
    mor_scheme scheme;                 /* settings of the scheme */
    int dimension;                     /* 2 (plane strain in x, y) or 3 */
    double spacing;                    /* initial particle spacing, m */
    double lateral_ratio;              /* K0 of the stress-diffusion operator, 1; of one soil */
    double gravity[3];                 /* m/s2 */
    double domain_minimum[3];          /* m, before the placement */
    double domain_maximum[3];          /* likewise */
    bool is_periodic[3];               /* space repeats itself along the axis, by the extent of the domain */
    const mor_domain_frame *placement; /* of the domain; borrowed; NULL: neither rotated nor translated */
    mor_guard guard;                   /* around updates of a material whose code may crash; NULL: none */
    bool removes_outflow;              /* what leaves the domain is removed; else it stops the run */
    double reference_density;          /* rho_0, kg/m3; of one soil */
    const mor_soil_kind *kinds;        /* shape [n_kinds]; of the parts of a composite, borrowed by mor_soil_init; NULL:
                                          one soil, of the two above */
    int n_kinds;
    int n_regions; /* parts that the state variable MOR_COMPOSITE_INDEX_KEY tells apart, whether or not their
                      materials differ; of a composite the number of its parts; 0 or 1: one */
    double released[MOR_HOLD_REGIONS_MAX]; /* shape [regions]; time until which each stands as placed, s; 0: none */
    bool shares_memory; /* what is found late in a step lies where something is that is needed early in it; not for
                           checked runs, which look at all of it around each stage */
} mor_soil_settings;

/** Sums over the lattice the soil starts from.
 *  @param settings         [in]   dimension and spacing are read
 *  @param smoothing_length [in]   unit m
 *  @param value            [out]  one number; of V W, unit 1
 *  @param moment           [out]  one number; of V (r_j - r_i) (x) grad_i W, one diagonal entry, unit 1 */
void mor_soil_sum_lattice(const mor_soil_settings *settings, double smoothing_length, double *value, double *moment);

/** Finds the wave speed of an unstressed soil; it sets the step and the impedance, Zhang et al. (2024) eq. 22.
 *  @param material [in]      of the soil, a composite with several
 *  @param index    [in]      of the part of a composite
 *  @param kind     [in,out]  its sound_speed is written
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC for a law without a finite speed above zero. */
mor_status mor_soil_kind_find_speed(mor_context *context, const mor_material_instance *material, int index,
                                    mor_soil_kind *kind);

/** Stress per height of soil at rest, Zhang et al. (2024) eq. 26 for any direction of gravity.
 *  @param gravity       [in]   strength, unit m/s2
 *  @param direction     [in]   shape [3]; unit 1
 *  @param rest_gradient [out]  shape [6]; unit Pa/m */
void mor_soil_kind_find_rest(const mor_soil_kind *kind, double gravity, const double *direction, double *rest_gradient);

/** Finds how stiff a soil is across a face that it can leave, by small expansions.
 *  @param guard    [in]  around the updates; NULL: none
 *  @param material [in]  of the soil, a composite with several
 *  @param index    [in]  of the part of a composite
 *  @param kind     [in]  its density
 *  Returns: rise of the stress across over the strain, over rho_0 c_0^2, 1; 0 for soil that bears no tension, 1 for
 *  soil that may bear some: whose parameters vary from place to place, or whose law fails without stress. */
double mor_soil_kind_find_across(mor_guard guard, const mor_material_instance *material, int index,
                                 const mor_soil_kind *kind);

/** Returns the latest time at which a region of the soil is released, unit s; 0: all is from the start.
 *  @param settings [in]  of the soil */
double mor_soil_find_release(const mor_soil_settings *settings);

/** Checks that soil which begins to fall does not fall asleep before it moves, and that soil that may sleep or is
 *  released later is in no scheme or domain that does not go with it.
 *  @param settings [in]  of the soil
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_soil_check_sleep(mor_context *context, const mor_soil_settings *settings);

#endif
