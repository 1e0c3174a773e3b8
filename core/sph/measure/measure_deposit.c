/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/sph/measure/measure_sum.h"

#include <string.h>

/* More bins than this indicate a wrong width, or a particle far from the others. */
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
    range->least = value < range->least ? value : range->least;
    range->greatest = value > range->greatest ? value : range->greatest;
}

/* Of which one may hold nothing. */
static void join(value_range *range, const value_range *other)
{
    range->least = fmin(range->least, other->least);
    range->greatest = fmax(range->greatest, other->greatest);
}

/* Names the first particle without a finite position. */
static mor_status refuse_positions(mor_context *context, const mor_measure_points *points)
{
    int64_t i = 0;
    while (i + 1 < points->n_points && isfinite(points->position[3 * i]) && isfinite(points->position[3 * i + 1]) &&
           isfinite(points->position[3 * i + 2])) {
        ++i;
    }
    const double *position = points->position + 3 * i;
    return MOR_FAIL(context, MOR_ERROR_NUMERIC,
                    "particle %lld of %lld lies at (%g, %g, %g) m: a profile needs finite positions", (long long)i,
                    (long long)points->n_points, position[0], position[1], position[2]);
}

/* Ranges of the run-out distances and, where it is asked for, of the place across them. */
static mor_status find_ranges(mor_context *context, const mor_measure_points *points, const mor_measure_frame *frame,
                              const double *distance, value_range *distances, value_range *sides)
{
    double side[3];
    value_range parts[MOR_MEASURE_PARTS][2];
    const int64_t n = points->n_points;
    const mor_measure_team team = mor_measure_team_for(n, points->n_threads);
    mor_vector_cross(frame->up, frame->direction, side);
    MOR_PARALLEL_FOR (&team, part, MOR_MEASURE_PARTS, 1) {
        value_range own[2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
        int64_t n_bad = 0;
        for (int64_t i = part * n / MOR_MEASURE_PARTS; i < (part + 1) * n / MOR_MEASURE_PARTS; ++i) {
            n_bad += !(distance[i] - distance[i] == 0.0);
            widen(&own[0], distance[i]);
            if (sides != NULL) {
                widen(&own[1], mor_vector_dot(side, points->position + 3 * i));
            }
        }
        own[0].least = n_bad == 0 ? own[0].least : NAN;
        memcpy(parts[part], own, sizeof own);
    }
    *distances = (value_range){INFINITY, -INFINITY};
    for (int part = 0; part < MOR_MEASURE_PARTS; ++part) {
        MOR_TRY(context, isnan(parts[part][0].least) ? refuse_positions(context, points) : MOR_OK);
        join(distances, &parts[part][0]);
        if (sides != NULL) {
            join(sides, &parts[part][1]);
        }
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
static void spread_volume(const mor_measure_profile *profile, double volume, double low, double high, double *volumes)
{
    const double width = profile->bin_width;
    const double first = (low - profile->start) / width;
    for (int64_t bin = first > 0.0 ? (int64_t)first : 0; bin < profile->n_bins; ++bin) {
        const double inner = profile->start + (double)bin * width;
        const double outer = inner + width;
        const double part = (high < outer ? high : outer) - (low > inner ? low : inner);
        if (inner >= high) {
            break;
        }
        if (part > 0.0) {
            volumes[bin] += volume * (part / profile->spacing);
        }
    }
}

/* Volumes and tops of the bins, shape [n_bins] each, from one part of the particles. */
static void fill_part(const mor_measure_points *points, const mor_measure_frame *frame,
                      const mor_measure_profile *profile, int64_t part, double *volumes, double *tops)
{
    const int64_t n = points->n_points;
    const double half = 0.5 * points->spacing;
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        volumes[k] = 0.0;
        tops[k] = NAN;
    }
    for (int64_t i = part * n / MOR_MEASURE_PARTS; i < (part + 1) * n / MOR_MEASURE_PARTS; ++i) {
        const double volume = mor_measure_volume(points, i);
        const double distance = profile->distances[i];
        const double low = distance - half;
        spread_volume(profile, volume, low, distance + half, volumes);
        /* What reaches past the axis of a radial profile, before its first bin, comes back on the other side. */
        if (profile->is_radial && low < 0.0) {
            spread_volume(profile, volume, 0.0, -low, volumes);
        }
        const int64_t bin = (int64_t)((distance - profile->start) / profile->bin_width);
        const double top = mor_measure_frame_height(frame, points->position + 3 * i) + half;
        tops[bin] = tops[bin] >= top ? tops[bin] : top;
    }
}

static void fill_profile(const mor_measure_points *points, const mor_measure_frame *frame, double breadth,
                         mor_measure_profile *profile)
{
    const mor_measure_team team = mor_measure_team_for(points->n_points, points->n_threads);
    const int64_t n = profile->n_bins;
    MOR_PARALLEL_FOR (&team, part, MOR_MEASURE_PARTS, 1) {
        fill_part(points, frame, profile, part, profile->parts + 2 * part * n, profile->parts + (2 * part + 1) * n);
    }
    for (int64_t k = 0; k < n; ++k) {
        const double inner = profile->start + (double)k * profile->bin_width;
        mor_sum volume = {0.0, 0.0};
        profile->center[k] = profile->start + ((double)k + 0.5) * profile->bin_width;
        profile->top[k] = NAN;
        for (int part = 0; part < MOR_MEASURE_PARTS; ++part) {
            mor_sum_add(&volume, profile->parts[2 * part * n + k]);
            profile->top[k] = fmax(profile->top[k], profile->parts[(2 * part + 1) * n + k]);
        }
        profile->thickness[k] =
            mor_sum_value(volume) / floor_area(points, profile->is_radial, breadth, inner, inner + profile->bin_width);
    }
}

static void clear_bins(mor_context *context, mor_measure_profile *profile)
{
    MOR_FREE(context, &profile->center);
    MOR_FREE(context, &profile->thickness);
    MOR_FREE(context, &profile->top);
    MOR_FREE(context, &profile->parts);
    profile->n_bins = 0;
    profile->capacity = 0;
}

static mor_status reserve_distances(mor_context *context, mor_measure_profile *profile, int64_t n)
{
    if (n > profile->n_distances) {
        profile->n_distances = 0;
        MOR_FREE(context, &profile->distances);
        MOR_TRY(context, MOR_NEW(context, &profile->distances, n, "distances of a profile"));
        profile->n_distances = n;
    }
    return MOR_OK;
}

/* Room for some bins more than are needed, so that a spreading deposit reallocates rarely. */
static mor_status reserve_bins(mor_context *context, mor_measure_profile *profile, int64_t n_bins)
{
    if (n_bins <= profile->capacity) {
        return MOR_OK;
    }
    clear_bins(context, profile);
    const int64_t n = 2 * n_bins;
    MOR_TRY(context, MOR_NEW(context, &profile->center, n, "bin centers of a profile"));
    MOR_TRY(context, MOR_NEW(context, &profile->thickness, n, "thickness of a profile"));
    MOR_TRY(context, MOR_NEW(context, &profile->top, n, "tops of a profile"));
    MOR_TRY(context, MOR_NEW(context, &profile->parts, 2 * MOR_MEASURE_PARTS * n, "parts of a profile"));
    profile->capacity = n;
    return MOR_OK;
}

mor_status mor_measure_profile_fill(mor_context *context, const mor_measure_points *points,
                                    const mor_measure_frame *frame, double bin_width, double breadth,
                                    mor_measure_profile *profile)
{
    value_range distances;
    value_range sides = {INFINITY, -INFINITY};
    const bool needs_sides = points->dimension == 3 && !frame->is_radial && !(breadth > 0.0);
    MOR_TRY(context, check_profile(context, points, frame, bin_width, breadth));
    MOR_TRY(context, reserve_distances(context, profile, points->n_points));
    mor_measure_distances(points, frame, profile->distances);
    MOR_TRY(context, find_ranges(context, points, frame, profile->distances, &distances, needs_sides ? &sides : NULL));
    const double reach = distances.greatest + 0.5 * points->spacing;
    const double start =
        frame->is_radial ? 0.0 : bin_width * floor((distances.least - 0.5 * points->spacing) / bin_width);
    /* One more for rounding at the far edge, and one that stays empty. */
    const double n_bins = floor((reach - start) / bin_width) + 3.0;
    MOR_CHECK(context, n_bins <= bins_limit, MOR_ERROR_ARGUMENT,
              "the particles lie between %g m and %g m, which is %g bins of %g m: use wider bins, or look for a "
              "particle far from the others",
              distances.least, distances.greatest, n_bins, bin_width);
    MOR_TRY(context, reserve_bins(context, profile, (int64_t)n_bins));
    profile->is_radial = frame->is_radial;
    profile->n_bins = (int64_t)n_bins;
    profile->start = start;
    profile->bin_width = bin_width;
    profile->spacing = points->spacing;
    fill_profile(points, frame, needs_sides ? sides.greatest - sides.least + points->spacing : breadth, profile);
    return MOR_OK;
}

mor_status mor_measure_profile_new(mor_context *context, const mor_measure_points *points,
                                   const mor_measure_frame *frame, double bin_width, double breadth,
                                   mor_measure_profile *profile)
{
    memset(profile, 0, sizeof *profile);
    const mor_status status = mor_measure_profile_fill(context, points, frame, bin_width, breadth, profile);
    if (status != MOR_OK) {
        mor_measure_profile_clear(context, profile);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_measure_profile_clear(mor_context *context, mor_measure_profile *profile)
{
    clear_bins(context, profile);
    MOR_FREE(context, &profile->distances);
    profile->n_distances = 0;
}

/* Where the line between the centers of a bin and the next one, which is thinner, meets the threshold. */
static double interpolate_edge(const mor_measure_profile *profile, int64_t bin, double threshold)
{
    const double here = profile->thickness[bin];
    const double next = profile->thickness[bin + 1];
    return profile->center[bin] + profile->bin_width * ((here - threshold) / (here - next));
}

/* The farthest particle, and the share of the mass beyond an edge. */
static void find_strays(const mor_measure_points *points, const mor_measure_profile *profile, double edge,
                        mor_measure_front *front)
{
    const int64_t n = points->n_points;
    const mor_measure_team team = mor_measure_team_for(n, points->n_threads);
    double farthest[MOR_MEASURE_PARTS];
    mor_sum beyond[MOR_MEASURE_PARTS];
    mor_sum sum = {0.0, 0.0};
    MOR_PARALLEL_FOR (&team, part, MOR_MEASURE_PARTS, 1) {
        farthest[part] = -INFINITY;
        beyond[part] = (mor_sum){0.0, 0.0};
        for (int64_t i = part * n / MOR_MEASURE_PARTS; i < (part + 1) * n / MOR_MEASURE_PARTS; ++i) {
            const double distance = profile->distances[i];
            farthest[part] = distance > farthest[part] ? distance : farthest[part];
            if (distance > edge) {
                mor_sum_add(&beyond[part], points->mass[i]);
            }
        }
    }
    for (int part = 0; part < MOR_MEASURE_PARTS; ++part) {
        front->outermost_grain = fmax(front->outermost_grain, farthest[part] + 0.5 * points->spacing);
        mor_sum_add(&sum, beyond[part].high);
        mor_sum_add(&sum, beyond[part].low);
    }
    front->stray_share = mor_sum_value(sum) / mor_measure_mass(points);
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
    find_strays(points, profile, has_edge ? front->outermost_thick : -INFINITY, front);
    return MOR_OK;
}

/* Bins beyond the highest one whose tops lie between two shares of it. */
typedef struct slope_bins {
    int64_t peak; /* -1: none */
    double low;
    double high;
} slope_bins;

static bool takes_part(const mor_measure_profile *profile, const slope_bins *bins, int64_t k)
{
    if (bins->peak < 0 || k <= bins->peak || !(profile->top[bins->peak] > 0.0)) {
        return false;
    }
    const double share = profile->top[k] / profile->top[bins->peak];
    return isfinite(share) && share >= bins->low && share <= bins->high;
}

/* Angle under the horizontal of the line through the bins that take part; NaN for fewer than three. */
static double fit_angle(const mor_measure_profile *profile, const double *heights, const slope_bins *bins,
                        int64_t n_taking)
{
    line_sums line = {0.0, 0.0, 0.0, 0.0};
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (takes_part(profile, bins, k)) {
            line.mean_x += profile->center[k] / (double)n_taking;
            line.mean_y += heights[k] / (double)n_taking;
        }
    }
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (takes_part(profile, bins, k)) {
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
    slope_bins bins = {-1, low, high};
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        if (isfinite(profile->top[k]) && (bins.peak < 0 || profile->top[k] >= profile->top[bins.peak])) {
            bins.peak = k;
        }
    }
    repose->n_bins = 0;
    for (int64_t k = 0; k < profile->n_bins; ++k) {
        repose->n_bins += takes_part(profile, &bins, k);
    }
    repose->angle = fit_angle(profile, profile->top, &bins, repose->n_bins);
    repose->angle_by_thickness = fit_angle(profile, profile->thickness, &bins, repose->n_bins);
    return MOR_OK;
}
