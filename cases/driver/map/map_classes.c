/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_classes.h"

#include "cases/driver/picture/draw/colormap.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Most steps: colors of more classes are hard to tell apart. */
enum { STEPS = 8 };

/* The part of the color map that is used: its ends are nearly black and nearly white. */
static const double color_ends[2] = {0.15, 0.95};

static bool is_count(const mor_map_kind *kind)
{
    return strcmp(kind->unit, "1") == 0;
}

void mor_map_classes_init(const mor_map_kind *kind, double largest, mor_map_classes *classes)
{
    const double top = largest > 0.0 ? largest : 1.0;
    const mor_ticks ticks = mor_ticks_choose(0.0, top, STEPS);
    mor_colormap map;
    mor_colormap_init(&map);
    classes->step = is_count(kind) ? fmax(ticks.step, 1.0) : ticks.step;
    classes->n = (int)fmin(fmax(ceil(top / classes->step - 1.0e-9), 1.0), MOR_MAP_CLASSES_MAX);
    for (int k = 0; k <= classes->n; ++k) {
        classes->limits[k] = k * classes->step;
    }
    for (int k = 0; k < classes->n; ++k) {
        const double share = classes->n > 1 ? k / (classes->n - 1.0) : 0.5;
        const double place = kind->is_early_dark ? share : 1.0 - share;
        double linear[3];
        mor_colormap_at(&map, color_ends[0] + place * (color_ends[1] - color_ends[0]), linear);
        for (int a = 0; a < 3; ++a) {
            classes->colors[k][a] = mor_colormap_encode(linear[a]);
        }
    }
}

int mor_map_classes_find(const mor_map_classes *classes, double value)
{
    int k = 0;
    while (k + 1 < classes->n && value > classes->limits[k + 1]) {
        ++k;
    }
    return k;
}

void mor_map_classes_label(const mor_map_kind *kind, const mor_map_classes *classes, int k, double factor, char *text)
{
    char low[MOR_TICKS_TEXT_BYTES];
    char high[MOR_TICKS_TEXT_BYTES];
    const double first = classes->limits[k] + (is_count(kind) ? 1.0 : 0.0);
    mor_ticks_format(factor * first, factor * classes->step, low);
    mor_ticks_format(factor * classes->limits[k + 1], factor * classes->step, high);
    const bool is_one = first == classes->limits[k + 1];
    snprintf(text, MOR_TICKS_LABEL_BYTES, "%s%s%s", is_one ? "" : low, is_one ? "" : " – ", high);
}
