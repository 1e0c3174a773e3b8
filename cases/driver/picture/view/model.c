/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/model.h"

#include "cases/driver/picture/draw/ticks.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { JACOBI_SWEEPS = 30 };

static const double outer_share = 0.01;     /* left out at each end of an automatic range */
static const double plane_j_minus_1 = 1.55; /* discs of a disturbed lattice leave no gap */
static const double piece_j_minus_1 = 1.5;  /* in space: bumps remain, gaps do not */
static const double space_j_minus_1 = 1.22; /* single particles remain visible on a closed surface */
static const double magnitude_limit = 1e12; /* m; keeps view space inside single precision */

static bool is_finite_vector(const double *a)
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

static const char *name_group(const mor_picture_group *group)
{
    return group->name != NULL ? group->name : "without name";
}

static double radius_of(const mor_picture_group *group, int64_t i)
{
    return group->radii != NULL ? group->radii[i] : group->radius;
}

double mor_model_radius(const mor_picture *picture, const mor_picture_group *group, int64_t i)
{
    const double in_space = group->is_piece ? piece_j_minus_1 : space_j_minus_1;
    const double usual = picture->dimension == 2 ? plane_j_minus_1 : in_space;
    return (picture->j_minus_1 > 0.0 ? picture->j_minus_1 : usual) * radius_of(group, i);
}

static mor_status check_group(mor_context *context, const mor_picture_group *group)
{
    MOR_CHECK(context, group->n_particles >= 0 && (group->n_particles == 0 || group->position != NULL),
              MOR_ERROR_ARGUMENT, "group '%s' has %lld particles and %s positions; give an array of positions",
              name_group(group), (long long)group->n_particles, group->position == NULL ? "no" : "some");
    for (int64_t i = 0; i < group->n_particles; ++i) {
        const double *x = group->position + 3 * i;
        MOR_CHECK(context, is_finite_vector(x) && fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2]))) < magnitude_limit,
                  MOR_ERROR_ARGUMENT,
                  "group '%s': particle %lld is at (%g, %g, %g) m; only finite positions below %g m can be drawn",
                  name_group(group), (long long)i, x[0], x[1], x[2], magnitude_limit);
        const double radius = radius_of(group, i);
        MOR_CHECK(context, isfinite(radius) && radius > 0.0, MOR_ERROR_ARGUMENT,
                  "group '%s': particle %lld has radius %g m; it must be positive, such as half the particle spacing",
                  name_group(group), (long long)i, radius);
        MOR_CHECK(context, group->light == NULL || (group->light[i] >= 0.0 && isfinite(group->light[i])),
                  MOR_ERROR_ARGUMENT, "group '%s': particle %lld has light %g; it must be finite and not negative",
                  name_group(group), (long long)i, group->light == NULL ? 1.0 : group->light[i]);
        MOR_CHECK(context, group->value == NULL || fabs(group->value[i]) < MOR_TICKS_LARGEST, MOR_ERROR_ARGUMENT,
                  "group '%s': particle %lld has value %g; only finite values below %g have a color", name_group(group),
                  (long long)i, group->value == NULL ? 0.0 : group->value[i], MOR_TICKS_LARGEST);
    }
    for (int64_t i = 0; group->part != NULL && i < group->n_particles; ++i) {
        const double part = group->part[i];
        MOR_CHECK(context, part >= 0.0 && part <= MOR_PICTURE_PART_MAX && part == floor(part), MOR_ERROR_ARGUMENT,
                  "group '%s': particle %lld belongs to part %g; parts are whole numbers from 0 to %d",
                  name_group(group), (long long)i, part, MOR_PICTURE_PART_MAX);
    }
    for (int c = 0; c < 3; ++c) {
        MOR_CHECK(context, group->color[c] >= 0.0 && group->color[c] <= 1.0, MOR_ERROR_ARGUMENT,
                  "group '%s': color component %d is %g; screen values run from 0 to 1", name_group(group), c,
                  group->color[c]);
    }
    return MOR_OK;
}

static mor_status check_frame(mor_context *context, const mor_picture *picture)
{
    for (int a = 0; picture->has_frame && a < picture->dimension; ++a) {
        const double low = picture->frame.minimum[a];
        const double high = picture->frame.maximum[a];
        MOR_CHECK(context, isfinite(low) && isfinite(high) && low < high, MOR_ERROR_ARGUMENT,
                  "the frame runs from %g m to %g m along axis %d; give a finite box of positive size", low, high, a);
    }
    const double size = fmax(fabs(picture->range[0]), fabs(picture->range[1]));
    const bool is_range = isfinite(picture->range[0]) && isfinite(picture->range[1]) && size < MOR_TICKS_LARGEST &&
                          size > 1.0 / MOR_TICKS_LARGEST && picture->range[1] - picture->range[0] > 1e-9 * size;
    MOR_CHECK(context, !picture->has_range || is_range, MOR_ERROR_ARGUMENT,
              "the color range runs from %g to %g; the second number must be clearly larger than the first",
              picture->range[0], picture->range[1]);
    return MOR_OK;
}

mor_status mor_model_check(mor_context *context, const mor_picture *picture)
{
    MOR_CHECK(context, picture->dimension == 2 || picture->dimension == 3, MOR_ERROR_ARGUMENT,
              "the picture has dimension %d; it must be 2 or 3", picture->dimension);
    MOR_CHECK(context, picture->n_groups >= 1 && picture->n_groups <= MOR_PICTURE_GROUPS_MAX && picture->groups != NULL,
              MOR_ERROR_ARGUMENT, "the picture has %d groups of particles; it needs 1 to %d", picture->n_groups,
              MOR_PICTURE_GROUPS_MAX);
    MOR_TRY(context, mor_canvas_check_size(context, picture->width, picture->height));
    MOR_CHECK(context, is_finite_vector(picture->gravity) && is_finite_vector(picture->view), MOR_ERROR_ARGUMENT,
              "gravity (%g, %g, %g) and view (%g, %g, %g) must be finite", picture->gravity[0], picture->gravity[1],
              picture->gravity[2], picture->view[0], picture->view[1], picture->view[2]);
    MOR_CHECK(context, picture->j_minus_1 >= 0.0 && picture->j_minus_1 <= 4.0, MOR_ERROR_ARGUMENT,
              "the radius factor of the particles is %g; it must lie between 0 (the default) and 4",
              picture->j_minus_1);
    int64_t n_shown = 0;
    for (int g = 0; g < picture->n_groups; ++g) {
        MOR_TRY(context, check_group(context, picture->groups + g));
        const bool is_framed = picture->dimension == 2 || picture->groups[g].style != MOR_PICTURE_GROUND;
        n_shown += is_framed ? picture->groups[g].n_particles : 0;
    }
    MOR_CHECK(context, n_shown > 0, MOR_ERROR_ARGUMENT,
              "there is nothing to draw: the %d groups hold no particle other than ground", picture->n_groups);
    return check_frame(context, picture);
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static int64_t collect_values(const mor_picture *picture, double *values)
{
    int64_t n = 0;
    for (int g = 0; g < picture->n_groups; ++g) {
        const mor_picture_group *group = picture->groups + g;
        const bool is_colored = picture->dimension == 2 || group->style != MOR_PICTURE_GROUND;
        if (group->value == NULL || group->n_particles == 0 || !is_colored) {
            continue;
        }
        if (values != NULL) {
            memcpy(values + n, group->value, (size_t)group->n_particles * sizeof *values);
        }
        n += group->n_particles;
    }
    return n;
}

static mor_status find_range(mor_context *context, const mor_picture *picture, mor_model_range *range)
{
    const int64_t n = collect_values(picture, NULL);
    range->is_shown = false;
    if (n == 0) {
        return MOR_OK;
    }
    double *values = NULL;
    MOR_TRY(context, MOR_NEW(context, &values, n, "values of a picture"));
    collect_values(picture, values);
    qsort(values, (size_t)n, sizeof *values, compare_numbers);
    const int64_t skipped = (int64_t)(outer_share * (double)(n - 1));
    range->low = picture->has_range ? picture->range[0] : values[skipped];
    range->high = picture->has_range ? picture->range[1] : values[n - 1 - skipped];
    if (!picture->has_range) {
        mor_ticks_round_out(&range->low, &range->high, MOR_MODEL_COLOR_TICKS);
    }
    /* Zero everywhere, as before the first step, is no range. */
    range->is_shown = picture->has_range || values[0] != 0.0 || values[n - 1] != 0.0;
    const double slack = 1e-6 * (range->high - range->low);
    range->has_below = values[0] < range->low - slack;
    range->has_above = values[n - 1] > range->high + slack;
    MOR_FREE(context, &values);
    return MOR_OK;
}

static void find_extent(const mor_picture *picture, mor_model *model)
{
    mor_camera_extent_init(&model->extent);
    for (int corner = 0; picture->has_frame && corner < 8; ++corner) {
        double point[3];
        for (int a = 0; a < 3; ++a) {
            const bool is_upper = (corner >> a & 1) != 0;
            point[a] = is_upper ? picture->frame.maximum[a] : picture->frame.minimum[a];
        }
        if (picture->dimension == 2) {
            point[2] = 0.0;
        }
        mor_camera_extent_add(&model->camera, &model->extent, point, 0.0);
    }
    for (int g = 0; g < picture->n_groups; ++g) {
        const mor_picture_group *group = picture->groups + g;
        const bool is_plane = picture->dimension == 3 && group->style == MOR_PICTURE_GROUND;
        if (picture->has_frame ? !group->is_framed : is_plane) {
            continue;
        }
        for (int64_t i = 0; i < group->n_particles; ++i) {
            const double *x = group->position + 3 * i;
            const double point[3] = {x[0], x[1], picture->dimension == 3 ? x[2] : 0.0};
            mor_camera_extent_add(&model->camera, &model->extent, point, mor_model_radius(picture, group, i));
        }
    }
}

mor_status mor_model_survey(mor_context *context, const mor_picture *picture, mor_model *model)
{
    memset(model, 0, sizeof *model);
    const double front[3] = {0.0, 0.0, 1.0};
    const double level[3] = {0.0, 1.0, 0.0};
    const bool is_plane = picture->dimension == 2;
    const double largest = fmax(fabs(picture->gravity[0]), fmax(fabs(picture->gravity[1]), fabs(picture->gravity[2])));
    for (int a = 0; a < 3; ++a) {
        model->up[a] = largest == 0.0 ? (is_plane ? level[a] : front[a]) : -picture->gravity[a] / largest;
    }
    const double length = mor_vector_length(model->up);
    for (int a = 0; a < 3; ++a) {
        model->up[a] /= length;
    }
    mor_camera_orient(&model->camera, is_plane ? front : picture->view, is_plane ? level : model->up);
    find_extent(picture, model);
    double farthest = 0.0;
    double widest = 0.0;
    for (int a = 0; a < 2; ++a) {
        farthest = fmax(farthest, fmax(fabs(model->extent.minimum[a]), fabs(model->extent.maximum[a])));
        widest = fmax(widest, model->extent.maximum[a] - model->extent.minimum[a]);
    }
    MOR_CHECK(context, widest > 1e-9 * farthest, MOR_ERROR_ARGUMENT,
              "what is to be drawn is %g m wide and lies %g m from the origin: too small to be resolved there; "
              "draw larger particles or translate them to the origin",
              widest, farthest);
    MOR_TRY(context, find_range(context, picture, &model->range));
    return MOR_OK;
}

/* Eigenvector of the smallest eigenvalue of a symmetric matrix, by Jacobi rotations. */
static void find_thin_direction(double matrix[3][3], double *direction)
{
    double vectors[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int rotation = 0; rotation < 3 * JACOBI_SWEEPS; ++rotation) {
        const int p = rotation % 3 == 2 ? 1 : 0;
        const int q = rotation % 3 == 0 ? 1 : 2;
        if (matrix[p][q] == 0.0) {
            continue;
        }
        const double angle = 0.5 * atan2(2.0 * matrix[p][q], matrix[q][q] - matrix[p][p]);
        const double c = cos(angle);
        const double s = sin(angle);
        for (int k = 0; k < 3; ++k) {
            const double row_p = matrix[p][k];
            matrix[p][k] = c * row_p - s * matrix[q][k];
            matrix[q][k] = s * row_p + c * matrix[q][k];
        }
        for (int k = 0; k < 3; ++k) {
            const double column_p = matrix[k][p];
            matrix[k][p] = c * column_p - s * matrix[k][q];
            matrix[k][q] = s * column_p + c * matrix[k][q];
            const double vector_p = vectors[k][p];
            vectors[k][p] = c * vector_p - s * vectors[k][q];
            vectors[k][q] = s * vector_p + c * vectors[k][q];
        }
    }
    int thin = 0;
    for (int a = 1; a < 3; ++a) {
        thin = matrix[a][a] < matrix[thin][thin] ? a : thin;
    }
    for (int a = 0; a < 3; ++a) {
        direction[a] = vectors[a][thin];
    }
}

/* True when the two larger spreads are clear of zero, so that the third has a direction. */
static bool spans_plane(double matrix[3][3])
{
    const double trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
    double minors = 0.0;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        minors += matrix[a][a] * matrix[b][b] - matrix[a][b] * matrix[b][a];
    }
    return minors > 1e-6 * trace * trace;
}

double mor_model_plane(const mor_picture_group *group, const double *up, double *normal)
{
    double mean[3] = {0.0, 0.0, 0.0};
    double spread[3][3] = {{0.0}};
    for (int64_t i = 0; i < group->n_particles; ++i) {
        for (int a = 0; a < 3; ++a) {
            mean[a] += group->position[3 * i + a] / (double)group->n_particles;
        }
    }
    for (int64_t i = 0; i < group->n_particles; ++i) {
        const double *x = group->position + 3 * i;
        for (int a = 0; a < 9; ++a) {
            spread[a / 3][a % 3] += (x[a / 3] - mean[a / 3]) * (x[a % 3] - mean[a % 3]);
        }
    }
    memcpy(normal, up, 3 * sizeof *normal);
    if (spans_plane(spread)) {
        find_thin_direction(spread, normal);
    }
    const double sign = mor_vector_dot(normal, up) < 0.0 ? -1.0 : 1.0;
    double level = -INFINITY;
    for (int a = 0; a < 3; ++a) {
        normal[a] *= sign;
    }
    for (int64_t i = 0; i < group->n_particles; ++i) {
        level = fmax(level, mor_vector_dot(normal, group->position + 3 * i) + radius_of(group, i));
    }
    return level;
}
