/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Prescribed motion of walls and bodies: the tables, and what depends on it. */
#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/case/schema/case_schema_words.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>

#define PATH(member) AT(mor_case_path, member)

static const mor_case_key path_keys[] = {
    {{"point", VECTOR, "m", DEFAULT(NAN), ANY, NULL,
      "a point of the axis of rotation where it is at the start, in the frame of the case; translation moves it along"},
     MOR_CASE_STORE_REALS,
     PATH(point),
     .computed = "the origin; of a body its center of mass"},
    {{"axis", VECTOR, "1", DEFAULT(NAN), ANY, NULL, "axis of rotation"},
     MOR_CASE_STORE_REALS,
     PATH(axis),
     .computed = "(0, 0, 1)",
     .is_direction = true},
    {{"interpolation", CHOICE, "1", DEFAULT(0.0), ANY, "linear|smooth",
      "between rows; linear: constant velocity, which jumps at rows; smooth: a cubic whose velocity does not jump, "
      "overshoots no row, and begins and ends at rest"},
     MOR_CASE_STORE_BOOL,
     PATH(is_smooth)},
    {{"file", WORDS, "1", DEFAULT(0.0), ANY, NULL,
      "table of comma-separated values with the columns time, x, y, z, angle, each with its unit, as \"time [s]\"; "
      "time "
      "and one other are needed; path from the folder of the case file; in place of table"},
     MOR_CASE_STORE_TEXT,
     PATH(file)},
    END};

static const mor_case_part path_parts[] = {
    {"table", false, "list of groups", "times and poses; the motion is held before the first and after the last"},
    {NULL, false, NULL, NULL}};

static const mor_case_key row_keys[] = {
    {{"time", SCALAR, "s", REQUIRED, NOT_NEGATIVE, NULL, "since the start; rising from row to row"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_path_row, row.time)},
    {{"translation", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "since the start; zero in the first row"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_path_row, row.translation)},
    {{"angle", SCALAR, "rad", DEFAULT(0.0), ANY, NULL,
      "of the rotation since the start, right-handed, any number of revolutions; zero in the first row"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_path_row, row.angle)},
    END};

const mor_case_group mor_case_path_group = {"path", "Prescribed motion over time of a wall or a body", path_keys,
                                            path_parts, offsetof(mor_case_path, written)};
const mor_case_group mor_case_path_row_group = {"table", "Rows of a prescribed motion (list)", row_keys, NULL,
                                                offsetof(mor_case_path_row, written)};

double mor_case_path_speed(const mor_case *the_case, const mor_case_path *path, const mor_shape *shape)
{
    double fastest = 0.0;
    double radius = 0.0;
    mor_bounds bounds;
    if (path->n_rows == 0) {
        return 0.0;
    }
    mor_shape_bounds(shape, &bounds);
    for (int a = 0; a < the_case->dimension; ++a) {
        const double least = fmax(bounds.minimum[a], the_case->domain_minimum[a]);
        const double most = fmin(bounds.maximum[a], the_case->domain_maximum[a]);
        const double point = isnan(path->point[a]) ? 0.5 * (least + most) : path->point[a];
        const double arm = fmax(fabs(least - point), fabs(most - point));
        radius += arm * arm;
    }
    for (int k = 0; k + 1 < path->n_rows; ++k) {
        const mor_motion_row *row = &path->rows[k];
        double speed = fabs(row[1].angle - row[0].angle) * sqrt(radius);
        double way[3];
        for (int a = 0; a < 3; ++a) {
            way[a] = row[1].translation[a] - row[0].translation[a];
        }
        speed += mor_vector_length(way);
        fastest = fmax(fastest, speed / (row[1].time - row[0].time));
    }
    return path->is_smooth ? 1.5 * fastest : fastest; /* a cubic from rest to rest is this much faster in the middle */
}
