/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/motion.h"

#include "core/base/memory.h"

#include <string.h>

enum { COMPONENTS = 4 /* three of the translation, and the angle */ };

static double value_of(const mor_motion_row *row, int component)
{
    return component < 3 ? row->translation[component] : row->angle;
}

/* Mean slope between a row and the next. */
static double secant_of(const mor_motion *motion, int row, int component)
{
    const mor_motion_row *r = motion->rows + row;
    return (value_of(r + 1, component) - value_of(r, component)) / (r[1].time - r[0].time);
}

/* Slope at an inner row, Fritsch and Butland (1984): zero at extremes, else the weighted harmonic mean of the secants,
 * with which the cubic is monotone wherever the rows are. */
static double inner_slope(const mor_motion *motion, int row, int component)
{
    const double before = secant_of(motion, row - 1, component);
    const double after = secant_of(motion, row, component);
    const double h0 = motion->rows[row].time - motion->rows[row - 1].time;
    const double h1 = motion->rows[row + 1].time - motion->rows[row].time;
    if (!(before * after > 0.0)) {
        return 0.0;
    }
    const double w0 = 2.0 * h1 + h0;
    const double w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / before + w1 / after);
}

/* The motion is held outside the table, so that it begins and ends at rest where it is smooth. */
static void find_slopes(mor_motion *motion)
{
    for (int row = 1; row + 1 < motion->n_rows; ++row) {
        for (int k = 0; k < COMPONENTS; ++k) {
            motion->slopes[COMPONENTS * row + k] = inner_slope(motion, row, k);
        }
    }
}

static mor_status check_rows(mor_context *context, const mor_motion_row *rows, int n_rows)
{
    MOR_CHECK(context, n_rows >= 1 && n_rows <= MOR_MOTION_ROWS_MAX, MOR_ERROR_ARGUMENT,
              "found a motion of %d rows; allowed: 1 to %d", n_rows, MOR_MOTION_ROWS_MAX);
    for (int k = 0; k < n_rows; ++k) {
        const mor_motion_row *row = &rows[k];
        MOR_CHECK(context,
                  isfinite(row->time) && isfinite(row->translation[0]) && isfinite(row->translation[1]) &&
                      isfinite(row->translation[2]) && isfinite(row->angle),
                  MOR_ERROR_ARGUMENT, "row %d of a motion has a number that is not finite; correct it", k + 1);
        MOR_CHECK(context, k == 0 || row->time > row[-1].time, MOR_ERROR_ARGUMENT,
                  "row %d of a motion is at %.9g s, the row before at %.9g s; allowed: rising times; sort the rows",
                  k + 1, row->time, row[-1].time);
    }
    return MOR_OK;
}

mor_status mor_motion_init(mor_context *context, mor_motion *motion, const mor_motion_row *rows, int n_rows,
                           const double *point, const double *axis, bool is_smooth)
{
    memset(motion, 0, sizeof *motion);
    MOR_TRY(context, check_rows(context, rows, n_rows));
    const double length = mor_vector_length(axis);
    MOR_CHECK(context, length > 0.0 && isfinite(length), MOR_ERROR_ARGUMENT,
              "found (%g, %g, %g) as axis of a motion; allowed: any direction of a length above zero", axis[0], axis[1],
              axis[2]);
    mor_status status = MOR_NEW(context, &motion->rows, n_rows, "rows of a motion");
    if (status == MOR_OK && is_smooth) {
        status = MOR_NEW(context, &motion->slopes, COMPONENTS * (int64_t)n_rows, "slopes of a motion");
    }
    if (status != MOR_OK) {
        mor_motion_clear(context, motion);
        return status;
    }
    memcpy(motion->rows, rows, (size_t)n_rows * sizeof *rows);
    motion->n_rows = n_rows;
    for (int a = 0; a < 3; ++a) {
        motion->point[a] = point[a];
        motion->axis[a] = axis[a] / length;
    }
    if (is_smooth) {
        find_slopes(motion);
    }
    return MOR_OK;
}

void mor_motion_clear(mor_context *context, mor_motion *motion)
{
    MOR_FREE(context, &motion->rows);
    MOR_FREE(context, &motion->slopes);
    memset(motion, 0, sizeof *motion);
}

bool mor_motion_equals(const mor_motion *first, const mor_motion *second)
{
    const size_t n_bytes = (size_t)first->n_rows * sizeof *first->rows;
    return first->n_rows == second->n_rows && (first->slopes == NULL) == (second->slopes == NULL) &&
           memcmp(first->point, second->point, sizeof first->point) == 0 &&
           memcmp(first->axis, second->axis, sizeof first->axis) == 0 &&
           (n_bytes == 0 || memcmp(first->rows, second->rows, n_bytes) == 0);
}

bool mor_motion_rotates(const mor_motion *motion)
{
    bool rotates = false;
    for (int k = 0; k < motion->n_rows; ++k) {
        rotates = rotates || motion->rows[k].angle != 0.0;
    }
    return rotates;
}

double mor_motion_radius(const mor_motion *motion, const double *place)
{
    double across[3];
    const double arm[3] = {place[0] - motion->point[0], place[1] - motion->point[1], place[2] - motion->point[2]};
    mor_vector_cross(motion->axis, arm, across);
    return mor_vector_length(across);
}

/* Value and slope of a component at a part of the way from a row to the next, 0 to 1. */
static void interpolate(const mor_motion *motion, int row, int component, double part, double *value, double *slope)
{
    const double first = value_of(&motion->rows[row], component);
    const double secant = secant_of(motion, row, component);
    const double length = motion->rows[row + 1].time - motion->rows[row].time;
    *slope = secant;
    *value = first + part * length * secant;
    if (motion->slopes != NULL) { /* Hermite's cubic */
        const double m0 = motion->slopes[COMPONENTS * row + component];
        const double m1 = motion->slopes[COMPONENTS * (row + 1) + component];
        const double rest = 1.0 - part;
        *value += length * part * rest * (rest * (m0 - secant) - part * (m1 - secant));
        *slope += (rest * rest - 2.0 * part * rest) * (m0 - secant) + (part * part - 2.0 * part * rest) * (m1 - secant);
    }
}

/* Largest size of the slope of a component between a row and the next. */
static double steepest(const mor_motion *motion, int row, int component)
{
    const double secant = secant_of(motion, row, component);
    if (motion->slopes == NULL) {
        return fabs(secant);
    }
    const double m0 = motion->slopes[COMPONENTS * row + component];
    const double m1 = motion->slopes[COMPONENTS * (row + 1) + component];
    /* The slope is a parabola of the part: its vertex, or the ends. */
    const double square = m0 + m1 - 2.0 * secant;
    const double vertex = square != 0.0 ? (2.0 * m0 + m1 - 3.0 * secant) / (3.0 * square) : -1.0;
    double largest = fmax(fabs(m0), fabs(m1));
    if (vertex > 0.0 && vertex < 1.0) {
        double value = 0.0;
        double slope = 0.0;
        interpolate(motion, row, component, vertex, &value, &slope);
        largest = fmax(largest, fabs(slope));
    }
    return largest;
}

double mor_motion_fastest(const mor_motion *motion, double radius)
{
    double fastest = 0.0;
    for (int row = 0; row + 1 < motion->n_rows; ++row) {
        const double translation[3] = {steepest(motion, row, 0), steepest(motion, row, 1), steepest(motion, row, 2)};
        const double spin = steepest(motion, row, 3);
        const double speed = mor_vector_length(translation) + (spin > 0.0 ? spin * radius : 0.0);
        fastest = fmax(fastest, speed);
    }
    return fastest;
}

/* Last row at or before a time, by bisection; the first row of an interval. */
static int find_row(const mor_motion *motion, double time)
{
    int first = 0;
    int last = motion->n_rows - 1;
    while (last - first > 1) {
        const int middle = first + (last - first) / 2;
        if (motion->rows[middle].time <= time) {
            first = middle;
        } else {
            last = middle;
        }
    }
    return first;
}

void mor_motion_find(const mor_motion *motion, double time, mor_pose *pose)
{
    const mor_motion_row *rows = motion->rows;
    const int n = motion->n_rows;
    double values[COMPONENTS];
    double slopes[COMPONENTS] = {0.0};
    double pivot[3]; /* where the point of the axis is */
    double moved[3];
    if (n == 1 || time < rows[0].time || time >= rows[n - 1].time) {
        for (int k = 0; k < COMPONENTS; ++k) {
            values[k] = value_of(n == 1 || time < rows[0].time ? &rows[0] : &rows[n - 1], k);
        }
    } else {
        const int row = find_row(motion, time);
        const double part = (time - rows[row].time) / (rows[row + 1].time - rows[row].time);
        for (int k = 0; k < COMPONENTS; ++k) {
            interpolate(motion, row, k, part, &values[k], &slopes[k]);
        }
    }
    pose->angle = values[3];
    mor_matrix_rotation(motion->axis, values[3], pose->rotation);
    mor_matrix_apply(pose->rotation, motion->point, moved);
    for (int a = 0; a < 3; ++a) {
        pivot[a] = motion->point[a] + values[a];
        pose->translation[a] = values[a] + (motion->point[a] - moved[a]);
        pose->velocity[a] = slopes[a];
        pose->angular_velocity[a] = slopes[3] * motion->axis[a];
    }
    mor_vector_cross_add(-1.0, pose->angular_velocity, pivot, pose->velocity);
}

mor_pose mor_pose_uniform(const double *velocity, double time)
{
    mor_pose pose = {.rotation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}};
    for (int a = 0; a < 3; ++a) {
        pose.translation[a] = velocity[a] * time;
        pose.velocity[a] = velocity[a];
    }
    return pose;
}
