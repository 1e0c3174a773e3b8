/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_H
#define MOR_CORE_SPH_MEASURE_MEASURE_H

#include "core/base/context.h"
#include "core/sph/measure/measure_order.h"

#include <stdbool.h>

/** @file
 *  Named results of a run: run-out, height, surface, angle of repose, energies, stress at rest. Every function
 *  reads arrays and changes nothing. Sums are compensated and percentiles sorted, so that a result depends neither on
 *  the number of threads nor, beyond the last bits, on the order of particles. No axis is special: "up" is a unit
 *  vector of the caller's, as a rule against gravity.
 *
 *  Masses and volumes are those of the particles: in 2D per meter of depth (kg/m and m2), and so are energies (J/m).
 *  Threads: safe to call concurrently with a context each. */

/** Writes the terms of particles first to first + n - 1, in any one unit.
 *  terms: shape [n]; at most 1024 at a time. */
typedef void (*mor_sum_fill)(const void *job, int64_t first, int64_t n, double *terms);

/** The particles measured. Everything is borrowed. */
typedef struct mor_measure_points {
    int64_t n_points;         /* number of particles, >= 1 */
    int dimension;            /* 2 (in x-y) or 3 */
    double spacing;           /* particle spacing, unit m, > 0 */
    const double *position;   /* shape [n_points,3]; unit m */
    const double *mass;       /* shape [n_points]; unit kg (2D: kg/m); > 0 */
    const double *density;    /* shape [n_points]; unit kg/m3; NULL: every volume is spacing to the power dimension */
    int n_threads;            /* that share the work; 0: one */
    mor_measure_order *order; /* memory of a percentile that is found repeatedly; NULL: none, its scratch is
                               * allocated for each call */
} mor_measure_points;

/** Where a distance is measured from, and which way. */
typedef struct mor_measure_frame {
    double origin[3];    /* shape [3]; unit m */
    double up[3];        /* shape [3]; unit vector, 1 */
    bool is_radial;      /* distance from the line through origin along up; else along direction */
    double direction[3]; /* shape [3]; unit vector, 1; not used when radial */
} mor_measure_frame;

/** Thickness and surface of a deposit over the run-out distance. Made by mor_measure_profile_new. Owner: the caller.
 *  Bin k covers start + [k, k + 1) * bin_width: an annulus when radial in 3D, both sides together when radial in 2D. */
typedef struct mor_measure_profile {
    bool is_radial;    /* as in the frame */
    int64_t n_bins;    /* number of bins; the outermost is empty */
    double start;      /* inner edge of bin 0, unit m; 0 when radial */
    double bin_width;  /* unit m */
    double spacing;    /* of the particles, unit m */
    double *center;    /* shape [n_bins]; middle of the bin, unit m */
    double *thickness; /* shape [n_bins]; volume over area of the bin, unit m; each particle's volume is spread evenly
                          * over one spacing of distance, so that thickness is continuous in the positions */
    double *top;       /* shape [n_bins]; height over origin of the highest particle centered in the bin, plus half a
                          * spacing, unit m; NaN where there is none */
    double *parts;     /* shape [capacity * MOR_MEASURE_PARTS * 2]; scratch; volumes [m3 (m2)] and tops [m] by parts */
    int64_t capacity;  /* bins that there is room for */
    double *distances; /* shape [n_points]; of the particles it was made from, unit m */
    int64_t n_distances; /* room for them */
} mor_measure_profile;

enum { MOR_MEASURE_PARTS = 16 };

/** Where a deposit ends. Edges, in contrast to centers of particles: half a spacing is included in each. */
typedef struct mor_measure_front {
    double outermost_thick; /* outermost place where the thickness, linear between the centers of bins, falls below the
                             * threshold, unit m; NaN when no bin is that thick */
    double connected_thick; /* the same, but the first such place outward from the thickest bin, unit m; or NaN */
    double outermost_grain; /* farthest particle plus half a spacing, unit m */
    double stray_share;     /* share of the mass centered beyond outermost_thick, 1; 1 when that is NaN */
    double thickest;        /* largest thickness of a bin, unit m */
} mor_measure_front;

/** Slope of a heap. */
typedef struct mor_measure_repose {
    double angle;              /* from the tops of the bins, unit rad; NaN when fewer than three bins take part */
    double angle_by_thickness; /* from the mean thickness of the same bins (flat floor), unit rad; or NaN */
    int64_t n_bins;            /* bins that take part */
} mor_measure_repose;

/** A column at rest to compare stresses with. */
typedef struct mor_measure_column {
    double origin[3];      /* shape [3]; unit m; heights count from here */
    double up[3];          /* shape [3]; unit vector, 1 */
    double surface_height; /* height of the free surface, unit m */
    double density;        /* unit kg/m3 */
    double gravity;        /* magnitude, unit m/s2 */
    double lowest;         /* particles below this height are left out, unit m; -INFINITY: none */
    double highest;        /* particles above this height are left out, unit m; INFINITY: none */
} mor_measure_column;

/** Statistics of the stress in a column at rest. Means are weighted by mass; s is the normal stress along up. */
typedef struct mor_measure_stress {
    double error_l2;      /* root of mean (s - r)^2 over root of mean r^2, 1, with r = -density * gravity *
                           * (surface_height - height), 0 above the surface; NaN when r vanishes everywhere */
    double lateral_ratio; /* mean lateral normal stress over mean s, 1; NaN when s vanishes. Lateral: the mean of the
                           * two directions across up in 3D, the one in the x-y plane in 2D */
    double noise;         /* standard deviation of s about its least-squares line over height, unit Pa */
    double slope;         /* of that line, unit Pa/m */
    double base_stress;   /* value of that line at height 0, unit Pa */
    int64_t n_used;       /* particles between lowest and highest */
} mor_measure_stress;

/** Finds a weighted percentile. Each value stands at the middle of its weight in the sorted row; between values the
 *  result is linear; before the first and after the last middle it is the smallest and the largest value.
 *  @param values   [in]      shape [n_values]; any unit
 *  @param weights  [in]      shape [n_values]; any unit, >= 0, not all 0; values of weight 0 are left out; NULL: all 1
 *  @param n_values [in]      >= 1
 *  @param percent  [in]      unit 1; 0 to 100
 *  @param result   [out]     one number; unit of values
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_NUMERIC for a value or weight that is not finite;
 *  MOR_ERROR_MEMORY.
 *  Cost: O(n log n), allocates. */
mor_status mor_measure_percentile(mor_context *context, const double *values, const double *weights, int64_t n_values,
                                  double percent, double *result);

/** Finds the run-out that holds a share of the mass: the percentile of the distance, plus half a spacing.
 *  @param percent [in]      unit 1; 0 to 100
 *  @param run_out [out]     one number; unit m
 *  Returns: as mor_measure_percentile. Cost: O(n) where all particles have one mass, else O(n log n); allocates nothing
 *  where points bring an order. */
mor_status mor_measure_run_out(mor_context *context, const mor_measure_points *points, const mor_measure_frame *frame,
                               double percent, double *run_out);

/** Finds the height over a point: the mass percentile along up, plus half a spacing. 100 gives the highest particle.
 *  @param origin  [in]      shape [3]; unit m
 *  @param up      [in]      shape [3]; unit vector, 1
 *  @param percent [in]      unit 1; 0 to 100
 *  @param height  [out]     one number; unit m
 *  Returns: as mor_measure_percentile. Cost: O(n) where all particles have one mass, else O(n log n); allocates nothing
 *  where points bring an order. */
mor_status mor_measure_height(mor_context *context, const mor_measure_points *points, const double *origin,
                              const double *up, double percent, double *height);

/** Finds a percentile of the speed, weighted by mass.
 *  @param velocity [in]      shape [n_points,3]; unit m/s
 *  @param percent  [in]      unit 1; 0 to 100
 *  @param speed    [out]     one number; unit m/s
 *  Returns: as mor_measure_percentile. Cost: O(n) where all particles have one mass, else O(n log n); allocates nothing
 *  where points bring an order. */
mor_status mor_measure_speed(mor_context *context, const mor_measure_points *points, const double *velocity,
                             double percent, double *speed);

/** Finds a percentile of values, one for each particle, that are made one by one. All particles count alike.
 *  @param fill    [in]      writes the values of particles first to first + n - 1, shape [n]; any unit
 *  @param job     [in]      first argument of fill
 *  @param percent [in]      unit 1; 0 to 100
 *  @param result  [out]     one number; unit of the values
 *  Returns: as mor_measure_percentile. Cost: O(n), allocates nothing where points bring an order. */
mor_status mor_measure_share(mor_context *context, const mor_measure_points *points, mor_sum_fill fill, const void *job,
                             double percent, double *result);

/** Makes the profile of a deposit.
 *  @param frame     [in]      direction, when used, lies across up
 *  @param bin_width [in]      unit m; > 0; as a rule the spacing
 *  @param breadth   [in]      unit m; width of the deposit across up and direction, used in 3D along a direction only;
 *                             0: from the outermost particles, plus one spacing
 *  @param profile   [out]     owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a wrong argument or too many bins; MOR_ERROR_NUMERIC for positions that are
 *  not finite; MOR_ERROR_MEMORY. On failure profile is empty.
 *  Cost: O(n + bins), allocates. */
mor_status mor_measure_profile_new(mor_context *context, const mor_measure_points *points,
                                   const mor_measure_frame *frame, double bin_width, double breadth,
                                   mor_measure_profile *profile);

/** Makes the profile anew in the memory of an earlier one; otherwise as mor_measure_profile_new.
 *  @param bin_width [in]      unit m; > 0
 *  @param breadth   [in]      unit m
 *  @param profile   [in,out]  zeroed at first; owned by the caller, after a failure, too
 *  Returns: as mor_measure_profile_new.
 *  Cost: O(n + bins), allocates when there are more bins than there is room for. */
mor_status mor_measure_profile_fill(mor_context *context, const mor_measure_points *points,
                                    const mor_measure_frame *frame, double bin_width, double breadth,
                                    mor_measure_profile *profile);

/** Frees what a profile owns; an empty profile is accepted. */
void mor_measure_profile_clear(mor_context *context, mor_measure_profile *profile);

/** Finds where a deposit ends by a thickness threshold, and what lies beyond. A threshold of half a spacing suits an
 *  axisymmetric deposit; in 2D take one that does not shrink with the spacing, such as 5 % of the initial height.
 *  @param points    [in]      the same as the profile was made from
 *  @param frame     [in]      likewise
 *  @param threshold [in]      unit m; > 0
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT.
 *  Cost: O(n + bins). */
mor_status mor_measure_find_front(mor_context *context, const mor_measure_points *points,
                                  const mor_measure_frame *frame, const mor_measure_profile *profile, double threshold,
                                  mor_measure_front *front);

/** Finds the angle of repose: that of the least-squares line through (center, top) of the bins beyond the highest one
 *  whose tops lie between two shares of the largest top.
 *  @param low     [in]      unit 1; lower share, as a rule 0.2
 *  @param high    [in]      unit 1; upper share, as a rule 0.8
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT unless 0 <= low < high <= 1.
 *  Cost: O(bins). */
mor_status mor_measure_find_repose(mor_context *context, const mor_measure_profile *profile, double low, double high,
                                   mor_measure_repose *repose);

/** Compares the stress in a column at rest with the weight above.
 *  @param stress  [in]      shape [n_points,6]; unit Pa; tension positive, order (xx, yy, zz, xy, yz, zx)
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a wrong argument, or particles at fewer than two heights in the column.
 *  Cost: O(n). */
mor_status mor_measure_column_stress(mor_context *context, const mor_measure_points *points, const double *stress,
                                     const mor_measure_column *column, mor_measure_stress *result);

/** Returns the total mass, unit kg (2D: kg/m). */
double mor_measure_mass(const mor_measure_points *points);

/** Writes the center of mass.
 *  @param center [out]  shape [3]; unit m */
void mor_measure_center_of_mass(const mor_measure_points *points, double *center);

/** Writes the linear momentum.
 *  @param velocity [in]   shape [n_points,3]; unit m/s
 *  @param momentum [out]  shape [3]; unit kg m/s (2D: kg/s) */
void mor_measure_momentum(const mor_measure_points *points, const double *velocity, double *momentum);

/** Returns the kinetic energy, the sum of mass * speed^2 / 2, unit J (2D: J/m).
 *  @param velocity [in]  shape [n_points,3]; unit m/s */
double mor_measure_kinetic_energy(const mor_measure_points *points, const double *velocity);

/** Returns the potential energy, the sum of -mass * gravity . (position - datum), unit J (2D: J/m).
 *  @param gravity [in]  shape [3]; unit m/s2
 *  @param datum   [in]  shape [3]; unit m; a place of zero potential */
double mor_measure_potential_energy(const mor_measure_points *points, const double *gravity, const double *datum);

#endif
