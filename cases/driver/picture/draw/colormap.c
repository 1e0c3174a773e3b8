/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/colormap.h"

#include "core/base/math.h"

#include <math.h>

enum { CURVE_STEPS = 4096 };

static double clip_unit(double value)
{
    return value < 0.0 ? 0.0 : (value > 1.0 ? 1.0 : value);
}

/* Ottosson's published matrices. */
static void convert_oklab_to_linear(const double *oklab, double *linear)
{
    const double l = oklab[0] + 0.3963377774 * oklab[1] + 0.2158037573 * oklab[2];
    const double m = oklab[0] - 0.1055613458 * oklab[1] - 0.0638541728 * oklab[2];
    const double s = oklab[0] - 0.0894841775 * oklab[1] - 1.2914855480 * oklab[2];
    const double l3 = l * l * l;
    const double m3 = m * m * m;
    const double s3 = s * s * s;
    linear[0] = clip_unit(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3);
    linear[1] = clip_unit(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3);
    linear[2] = clip_unit(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3);
}

static double evaluate_quartic(const double *c, double u)
{
    return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4])));
}

/* Indigo, blue, teal, green, yellow: a least-squares fit to six hand-picked colors, all inside the sRGB gamut. */
static void evaluate_curve(double u, double *oklab)
{
    static const double axis_a[5] = {0.039, 0.026, -1.388, 1.949, -0.665};
    static const double axis_b[5] = {-0.098, -0.237, 0.585, 0.576, -0.665};
    oklab[0] = 0.30 + 0.625 * u;
    oklab[1] = evaluate_quartic(axis_a, u);
    oklab[2] = evaluate_quartic(axis_b, u);
}

static double measure_step(int step)
{
    double from[3];
    double to[3];
    evaluate_curve((double)step / CURVE_STEPS, from);
    evaluate_curve((double)(step + 1) / CURVE_STEPS, to);
    const double difference[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    return mor_vector_length(difference);
}

void mor_colormap_init(mor_colormap *map)
{
    double total = 0.0;
    for (int step = 0; step < CURVE_STEPS; ++step) {
        total += measure_step(step);
    }
    double walked = 0.0;
    double length = measure_step(0);
    int step = 0;
    for (int entry = 0; entry < MOR_COLORMAP_SIZE; ++entry) {
        const double target = total * entry / (MOR_COLORMAP_SIZE - 1);
        while (walked + length < target && step + 1 < CURVE_STEPS) {
            walked += length;
            step += 1;
            length = measure_step(step);
        }
        double oklab[3];
        evaluate_curve((step + clip_unit((target - walked) / length)) / CURVE_STEPS, oklab);
        convert_oklab_to_linear(oklab, map->color[entry]);
    }
}

void mor_colormap_at(const mor_colormap *map, double fraction, double *linear)
{
    const double place = clip_unit(fraction) * (MOR_COLORMAP_SIZE - 1);
    const int below = place >= MOR_COLORMAP_SIZE - 1 ? MOR_COLORMAP_SIZE - 2 : (int)place;
    const double weight = place - below;
    for (int a = 0; a < 3; ++a) {
        linear[a] = (1.0 - weight) * map->color[below][a] + weight * map->color[below + 1][a];
    }
}

void mor_colormap_category(int index, double *linear)
{
    /* Lightness, chroma, hue in degrees: neighbors in the list differ in all three. */
    static const double palette[MOR_COLORMAP_CATEGORIES][3] = {
        {0.45, 0.13, 258.0}, {0.70, 0.16, 55.0},  {0.60, 0.11, 170.0}, {0.47, 0.16, 20.0},
        {0.72, 0.10, 225.0}, {0.40, 0.13, 320.0}, {0.76, 0.13, 95.0},  {0.38, 0.00, 0.0},
    };
    const double *entry = palette[index % MOR_COLORMAP_CATEGORIES];
    const double hue = entry[2] * MOR_PI / 180.0;
    const double oklab[3] = {entry[0], entry[1] * cos(hue), entry[1] * sin(hue)};
    convert_oklab_to_linear(oklab, linear);
}

double mor_colormap_encode(double linear)
{
    const double value = clip_unit(linear);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1.0 / 2.4) - 0.055;
}

double mor_colormap_decode(double screen)
{
    const double value = clip_unit(screen);
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}
