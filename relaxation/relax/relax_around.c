/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Several shapes that are filled together, and what lies around them. */
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

/* Least distance from a solid, spacings: about half of that of a layer beside a wall. */
#define CLEARANCE 0.25

/* A clearance above this is not looked for, spacings. */
#define CLEARANCE_SEEN 2.0

/* Half the width of the differences for a normal, spacings. */
#define NORMAL_STEP 0.05

/* A face is covered where a shape or a solid lies within this behind it, spacings: no particle fits in between. */
#define GAP_MOST 0.5

static const mor_shape *find_part(const mor_relax_frame *frame, int part)
{
    return part == 0 ? frame->shape : frame->around->adjoining[part - 1];
}

double mor_relax_frame_part_depth(const mor_relax_frame *frame, int part, const double *place)
{
    double point[3];
    mor_relax_frame_point(frame, place, point);
    return -mor_shape_distance(find_part(frame, part), point) / frame->spacing;
}

double mor_relax_frame_depth(const mor_relax_frame *frame, const double *place)
{
    double depth = mor_relax_frame_part_depth(frame, 0, place);
    for (int k = 1; k < mor_relax_frame_parts(frame); ++k) {
        depth = fmax(depth, mor_relax_frame_part_depth(frame, k, place));
    }
    return depth;
}

/* Whether a point, m, lies within a length, m, of a box. */
static bool is_near(const mor_bounds *box, const double *point, double length, int dimension)
{
    bool is = true;
    for (int a = 0; a < dimension; ++a) {
        is = is && point[a] >= box->minimum[a] - length && point[a] <= box->maximum[a] + length;
    }
    return is;
}

double mor_relax_frame_clearance(const mor_relax_frame *frame, const double *place, double most)
{
    double least = most;
    double point[3];
    mor_relax_frame_point(frame, place, point);
    for (int k = 0; frame->around != NULL && k < frame->around->n_solids; ++k) {
        if (is_near(&frame->boxes[k], point, most * frame->spacing, frame->dimension)) {
            least = fmin(least, mor_shape_distance(frame->around->solids[k], point) / frame->spacing);
        }
    }
    return least;
}

double mor_relax_frame_clear(const mor_relax_frame *frame, double *place)
{
    double point[3];
    double rest = CLEARANCE_SEEN - CLEARANCE;
    mor_relax_frame_point(frame, place, point);
    for (int k = 0; k < frame->around->n_solids; ++k) {
        const mor_shape *solid = frame->around->solids[k];
        if (!is_near(&frame->boxes[k], point, CLEARANCE_SEEN * frame->spacing, frame->dimension)) {
            continue;
        }
        const double lack = CLEARANCE - mor_shape_distance(solid, point) / frame->spacing;
        rest = fmin(rest, fmax(-lack, 0.0));
        if (lack > 0.0) {
            double normal[3];
            mor_shape_normal(solid, point, NORMAL_STEP * frame->spacing, normal);
            for (int a = 0; a < frame->dimension; ++a) {
                place[a] += lack * normal[a];
            }
            mor_relax_frame_point(frame, place, point);
        }
    }
    return rest;
}

static double limit_part(double part)
{
    return fmin(1.0, fmax(0.0, part));
}

void mor_relax_frame_divide(const mor_relax_frame *frame, const double *place, double cell, double *empty,
                            double *solid)
{
    double point[3];
    mor_relax_frame_point(frame, place, point);
    *empty = 1.0;
    *solid = 0.0;
    for (int k = 0; k < mor_relax_frame_parts(frame); ++k) {
        *empty -= limit_part(0.5 + mor_relax_frame_part_depth(frame, k, place) / cell);
    }
    *empty = limit_part(*empty);
    for (int k = 0; frame->around != NULL && k<frame->around->n_solids && * empty> 0.0; ++k) {
        if (is_near(&frame->boxes[k], point, cell * frame->spacing, frame->dimension)) {
            const double distance = mor_shape_distance(frame->around->solids[k], point) / frame->spacing;
            const double part = fmin(limit_part(0.5 - distance / cell), *empty);
            *empty -= part;
            *solid += part;
        }
    }
}

bool mor_relax_frame_is_alone(const mor_relax_frame *frame, const double *place)
{
    int n_near = 0;
    for (int k = 0; k < mor_relax_frame_parts(frame); ++k) {
        const bool is_near = mor_relax_frame_part_depth(frame, k, place) > -MOR_RELAX_SUPPORT;
        n_near += is_near ? (mor_shape_has_seams(find_part(frame, k)) ? 2 : 1) : 0;
    }
    return n_near <= 1 && !(mor_relax_frame_clearance(frame, place, MOR_RELAX_SUPPORT) < MOR_RELAX_SUPPORT);
}

bool mor_relax_frame_is_covered(const mor_relax_frame *frame, int part, const double *place, const double *slope,
                                double depth)
{
    const double length = mor_vector_length(slope);
    double beyond[3];
    if (frame->around == NULL || depth < -GAP_MOST || !(length > 0.0)) {
        return false;
    }
    for (int a = 0; a < 3; ++a) {
        beyond[a] = place[a] - (depth + GAP_MOST) * slope[a] / length;
    }
    for (int k = 0; k < mor_relax_frame_parts(frame); ++k) {
        if (k != part && mor_relax_frame_part_depth(frame, k, beyond) > 0.0) {
            return true;
        }
    }
    return mor_relax_frame_clearance(frame, beyond, GAP_MOST) < 0.0;
}

mor_status mor_relax_frame_surround(mor_context *context, mor_relax_frame *frame)
{
    const mor_relax_around *around = frame->around;
    if (around == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &frame->boxes, around->n_solids, "boxes about solids"));
    for (int k = 0; k < around->n_solids; ++k) {
        mor_shape_bounds(around->solids[k], &frame->boxes[k]);
    }
    return MOR_OK;
}

void mor_relax_frame_free(mor_context *context, mor_relax_frame *frame)
{
    MOR_FREE(context, &frame->boxes);
}

int64_t mor_relax_frame_count_wanted(const mor_relax_frame *frame, int64_t n)
{
    int64_t wanted = 0;
    if (frame->around == NULL) {
        return n;
    }
    for (int k = 0; k < mor_relax_frame_parts(frame); ++k) {
        wanted += frame->around->counts[k];
    }
    return wanted;
}

int64_t mor_relax_frame_count_fixed(const mor_relax_frame *frame)
{
    return frame->around != NULL ? frame->around->n_points : 0;
}

void mor_relax_frame_place_fixed(const mor_relax_frame *frame, int64_t n_before, int64_t n, double *x)
{
    const mor_relax_around *around = frame->around;
    for (int64_t i = 0; around != NULL && i < around->n_points; ++i) {
        for (int a = 0; a < frame->dimension; ++a) {
            x[a * n + n_before + i] = (around->positions[3 * i + a] - frame->middle[a]) / frame->spacing;
        }
    }
}
