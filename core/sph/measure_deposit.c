/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/sph/measure_sum.h"

#include <string.h>

/* More bins than this mean a wrong width, or a particle gone astray. */
static const double bins_limit = 16777216.0;

/* Least and greatest of a coordinate. */
typedef struct value_range {
    double least;
    double greatest;
} value_range;

/* Sums of one least-squares line. */
typedef struct line_sums {
    double mean_x;
    double mean_y;
    double xx;
    double xy;
} line_sums;

static void widen(value_range *range, double value)
{
    range->least = fmin(range->least, value);
    range->greatest = fmax(range->greatest, value);
}

/* Ranges of the run-out distance and of the place across it. */
static mor_status find_ranges(mor_context *context, const mor_measure_points *points, const mor_measure_frame *frame,
                              value_range *distances, value_range *sides)
{
    double side[3];
    mor_vector_cross(frame->up, frame->direction, side);
    *distances = (value_range){INFINITY, -INFINITY};
    *sides = (value_range){INFINITY, -INFINITY};
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *position = points->position + 3 * i;
        MOR_CHECK(context, isfinite(position[0]) && isfinite(position[1]) && isfinite(position[2]), MOR_ERROR_NUMERIC,
                  "particle %lld of %lld lies at (%g, %g, %g) m: a profile needs finite positions", (long long)i,
                  (long long)points->n_points, position[0], position[1], position[2]);
        widen(distances, mor_measure_frame_distance(frame, position));
        widen(sides, mor_vector_dot(side, position));
    }
    return MOR_OK;
}

static mor_status check_profile(mor_context *context, const mor_measure_points *points, const mor_measure_frame *frame,
                                double bin_width, double breadth)
{
    MOR_TRY(context, mor_measure_check_points(context, points));
    MOR_TRY(context, mor_measure_check_frame(context, frame));
    MOR_CHECK(context, isfinite(bin_width) && bin_width > 0.0, MOR_ERROR_ARGUMENT,
              "the bins of the profile are %g m wide: give a finite width above zero", bin_width);
    MOR_CHECK(context, isfinite(breadth) && breadth >= 0.0, MOR_ERROR_ARGUMENT,
              "the deposit is %g m broad: give a finite breadth above zero, or 0 to take it from the particles",
              breadth);
    const double slant = mor_vector_dot(frame->up, frame->direction);
    MOR_CHECK(context, frame->is_radial || fabs(slant) <= 1e-9, MOR_ERROR_ARGUMENT,
              "the run-out direction is not across the up direction (their product is %g): a thickness needs them at "
              "right angles",
              slant);
    return MOR_OK;
}

/* Area of the floor between two distances; a breadth of 1 m stands for the meter of depth in 2D. */
static double floor_area(const mor_measure_points *points, bool is_radial, double breadth, double inner, double outer)
{
    if (!is_radial) {
        return (outer - inner) * (points->dimension == 3 ? breadth : 1.0);
    }
    return points->dimension == 3 ? MOR_PI * (outer - inner) * (outer + inner) : 2.0 * (outer - inner);
}

/* Adds the part of a volume spread evenly over [low, low + spacing] that falls in [low, high], bin by bin. */
static void spread_volume(const mor_measure_profile *profile, double volume, double low, double high, mor_sum *volumes)
{
    const double width = profile->bin_width;
    int64_t bin = (int64_t)floor((low - profile->start) / width);
    bin = bin < 0 ? 0 : bin;
    for (; bin < profile->n_bins; ++bin) {
        const double inner = profile->start + (double)bin * width;
        const double part = fmin(high, inner + width) - fmax(low, inner);
        if (inner >= high) {
            break;
        }
        if (part > 0.0) {
            mor_sum_add(&volumes[bin], volume * (part / profile->spacing));
        }
    }
}

static void fill_profile(const mor_measure_points *points, const mor_measure_frame *frame, double breadth,
                         mor_measure_profile *profile, mor_sum *volumes)
{
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        profile->center[k] = profile->start + ((double)k + 0.5) * profile->bin_width;
        profile->top[k] = NAN;
    }
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *position = points->position + 3 * i;
        const double volume = mor_measure_volume(points, i);
        const double distance = mor_measure_frame_distance(frame, position);
        const double low = distance - 0.5 * points->spacing;
        const double high = distance + 0.5 * points->spacing;
        spread_volume(profile, volume, low, high, volumes);
        /* What reaches past the axis of a radial profile, before its first bin, comes back on the other side. */
        if (profile->is_radial && low < 0.0) {
            spread_volume(profile, volume, 0.0, -low, volumes);
        }
        const int64_t bin = (int64_t)floor((distance - profile->start) / profile->bin_width);
        profile->top[bin] = fmax(profile->top[bin], mor_measure_frame_height(frame, position) + 0.5 * points->spacing);
    }
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        const double inner = profile->start + (double)k * profile->bin_width;
        profile->thickness[k] = mor_sum_value(volumes[k]) /
                                floor_area(points, profile->is_radial, breadth, inner, inner + profile->bin_width);
    }
}

static mor_status allocate_profile(mor_context *context, mor_measure_profile *profile)
{
    MOR_TRY(context, MOR_NEW(context, &profile->center, profile->n_bins, "bin centers of a profile"));
    MOR_TRY(context, MOR_NEW(context, &profile->thickness, profile->n_bins, "thickness of a profile"));
    MOR_TRY(context, MOR_NEW(context, &profile->top, profile->n_bins, "tops of a profile"));
    return MOR_OK;
}

mor_status mor_measure_profile_new(mor_context *context, const mor_measure_points *points,
                                   const mor_measure_frame *frame, double bin_width, double breadth,
                                   mor_measure_profile *profile)
{
    memset(profile, 0, sizeof *profile);
    value_range distances;
    value_range sides;
    MOR_TRY(context, check_profile(context, points, frame, bin_width, breadth));
    MOR_TRY(context, find_ranges(context, points, frame, &distances, &sides));
    const double reach = distances.greatest + 0.5 * points->spacing;
    const double start =
        frame->is_radial ? 0.0 : bin_width * floor((distances.least - 0.5 * points->spacing) / bin_width);
    /* One more for rounding at the far edge, and one that stays empty. */
    const double n_bins = floor((reach - start) / bin_width) + 3.0;
    MOR_CHECK(context, n_bins <= bins_limit, MOR_ERROR_ARGUMENT,
              "the particles lie between %g m and %g m, which is %g bins of %g m: use wider bins, or look for a "
              "particle far from the others",
              distances.least, distances.greatest, n_bins, bin_width);
    const double width = breadth > 0.0 ? breadth : sides.greatest - sides.least + points->spacing;
    mor_sum *volumes = NULL;
    mor_measure_profile made = {.is_radial = frame->is_radial,
                                .n_bins = (int64_t)n_bins,
                                .start = start,
                                .bin_width = bin_width,
                                .spacing = points->spacing};
    mor_status status = allocate_profile(context, &made);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &volumes, made.n_bins, "volumes of a profile");
    }
    if (status != MOR_OK) {
        mor_measure_profile_clear(context, &made);
        return mor_context_pass(context, status, MOR_HERE);
    }
    fill_profile(points, frame, width, &made, volumes);
    MOR_FREE(context, &volumes);
    *profile = made;
    return MOR_OK;
}

void mor_measure_profile_clear(mor_context *context, mor_measure_profile *profile)
{
    MOR_FREE(context, &profile->center);
    MOR_FREE(context, &profile->thickness);
    MOR_FREE(context, &profile->top);
    profile->n_bins = 0;
}

/* Where the line between the centers of a bin and the next one, which is thinner, meets the threshold. */
static double interpolate_edge(const mor_measure_profile *profile, int64_t bin, double threshold)
{
    const double here = profile->thickness[bin];
    const double next = profile->thickness[bin + 1];
    return profile->center[bin] + profile->bin_width * ((here - threshold) / (here - next));
}

mor_status mor_measure_find_front(mor_context *context, const mor_measure_points *points,
                                  const mor_measure_frame *frame, const mor_measure_profile *profile, double threshold,
                                  mor_measure_front *front)
{
    MOR_CHECK(context, isfinite(threshold) && threshold > 0.0, MOR_ERROR_ARGUMENT,
              "the thickness threshold is %g m: give a finite length above zero", threshold);
    MOR_TRY(context, mor_measure_check_points(context, points));
    MOR_TRY(context, mor_measure_check_frame(context, frame));
    MOR_CHECK(context, profile->n_bins > 0, MOR_ERROR_ARGUMENT, "the profile is empty: make it first");
    const double *thickness = profile->thickness;
    int64_t thickest = 0;
    for (int64_t k = 1; k < profile->n_bins; ++k) {
        thickest = thickness[k] > thickness[thickest] ? k : thickest;
    }
    *front = (mor_measure_front){NAN, NAN, -INFINITY, 1.0, thickness[thickest]};
    const bool has_edge = front->thickest >= threshold;
    if (has_edge) {
        /* The outermost bin is empty, so both walks find an edge. */
        int64_t connected = thickest;
        int64_t outermost = profile->n_bins - 1;
        while (thickness[connected + 1] >= threshold) {
            ++connected;
        }
        while (thickness[outermost] < threshold) {
            --outermost;
        }
        front->connected_thick = interpolate_edge(profile, connected, threshold);
        front->outermost_thick = interpolate_edge(profile, outermost, threshold);
    }
    mor_sum beyond = {0.0, 0.0};
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double distance = mor_measure_frame_distance(frame, points->position + 3 * i);
        front->outermost_grain = fmax(front->outermost_grain, distance + 0.5 * points->spacing);
        if (!has_edge || distance > front->outermost_thick) {
            mor_sum_add(&beyond, points->mass[i]);
        }
    }
    front->stray_share = mor_sum_value(beyond) / mor_measure_mass(points);
    return MOR_OK;
}

/* Angle under the horizontal of the line through the bins that take part; NaN for fewer than three. */
static double fit_angle(const mor_measure_profile *profile, const double *heights, const bool *takes_part,
                        int64_t n_taking)
{
    line_sums line = {0.0, 0.0, 0.0, 0.0};
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (takes_part[k]) {
            line.mean_x += profile->center[k] / (double)n_taking;
            line.mean_y += heights[k] / (double)n_taking;
        }
    }
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (takes_part[k]) {
            const double run = profile->center[k] - line.mean_x;
            line.xx += run * run;
            line.xy += run * (heights[k] - line.mean_y);
        }
    }
    return n_taking >= 3 ? atan(-line.xy / line.xx) : NAN;
}

mor_status mor_measure_find_repose(mor_context *context, const mor_measure_profile *profile, double low, double high,
                                   mor_measure_repose *repose)
{
    MOR_CHECK(context, low >= 0.0 && low < high && high <= 1.0, MOR_ERROR_ARGUMENT,
              "the slope is to be fitted between %g and %g of the height: give 0 <= low < high <= 1", low, high);
    MOR_CHECK(context, profile->n_bins > 0, MOR_ERROR_ARGUMENT, "the profile is empty: make it first");
    bool *takes_part = NULL;
    MOR_TRY(context, MOR_NEW(context, &takes_part, profile->n_bins, "bins of a slope"));
    int64_t peak = -1;
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (isfinite(profile->top[k]) && (peak < 0 || profile->top[k] >= profile->top[peak])) {
            peak = k;
        }
    }
    repose->n_bins = 0;
    for (int64_t k = peak + 1; k < profile->n_bins && peak >= 0 && profile->top[peak] > 0.0; ++k) {
        const double share = profile->top[k] / profile->top[peak];
        takes_part[k] = isfinite(share) && share >= low && share <= high;
        repose->n_bins += takes_part[k];
    }
    repose->angle = fit_angle(profile, profile->top, takes_part, repose->n_bins);
    repose->angle_by_thickness = fit_angle(profile, profile->thickness, takes_part, repose->n_bins);
    MOR_FREE(context, &takes_part);
    return MOR_OK;
}
