/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes that read a gauge, so that its numbers can be expected and stand in the series. */
#include "cases/driver/probe/probe_row_internal.h"

#include <stddef.h>
#include <string.h>

typedef mor_probe_view view;

/* Loads of the gauge after the last step, from MOR_GAUGE_NOW or MOR_GAUGE_FILTERED on; false before the first one. */
static bool read_gauge(const view *v, int loads, mor_gauge_reading *reading)
{
    const mor_gauges *gauges = &v->simulation->probes->gauges;
    for (int k = 0; k < gauges->n; ++k) {
        const mor_gauge *gauge = &gauges->of[k];
        if (strcmp(gauge->asked->name, v->probe->gauge) == 0 && gauge->numbers[MOR_GAUGE_STEPS] > 0.0) {
            mor_gauge_read(gauge, gauge->numbers + loads, reading);
            return true;
        }
    }
    return false;
}

static double find_number(const view *v, int loads)
{
    mor_gauge_reading it;
    return read_gauge(v, loads, &it) ? *(const double *)((const char *)&it + v->measure->offset) : NAN;
}

static mor_status read_number(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = find_number(v, MOR_GAUGE_FILTERED);
    return MOR_OK;
}

/* A filter spreads a force over time: of what is over only later, its impulse would not be that of the force. */
static double find_unfiltered(const view *v)
{
    return find_number(v, MOR_GAUGE_NOW);
}

const mor_probe_measure mor_probe_gauge_measures[] = {
    {.type = {"gauge_normal", "N", "N/m", GAUGE, GAUGE, FORCE, 100.0,
              "normal force on a gauge by soil and bodies, along its direction, filtered as the gauge says; mean and "
              "impulse are of what is not filtered"},
     .run = read_number,
     .integrand = find_unfiltered,
     .offset = offsetof(mor_gauge_reading, normal)},
    {.type = {"gauge_normal_soil", "N", "N/m", GAUGE, GAUGE, FORCE, 100.0, "the soil's share of gauge_normal"},
     .run = read_number,
     .integrand = find_unfiltered,
     .offset = offsetof(mor_gauge_reading, of_source[MOR_GAUGE_SOIL])},
    {.type = {"gauge_normal_bodies", "N", "N/m", GAUGE, GAUGE, FORCE, 100.0, "the bodies' share of gauge_normal"},
     .run = read_number,
     .integrand = find_unfiltered,
     .offset = offsetof(mor_gauge_reading, of_source[MOR_GAUGE_BODIES])},
    {.type = {"gauge_shear", "N", "N/m", GAUGE, GAUGE, STEP, 100.0,
              "size of the force on a gauge across its direction, filtered likewise"},
     .run = read_number,
     .offset = offsetof(mor_gauge_reading, shear)},
    {.type = {"gauge_moment", "N m", "N", GAUGE, GAUGE, STEP, 100.0,
              "overturning moment on a gauge about the level axis through its origin, filtered likewise"},
     .run = read_number,
     .offset = offsetof(mor_gauge_reading, moment)},
    {.type = {"gauge_height", "m", "m", GAUGE, GAUGE, STEP, 100.0,
              "height over the origin of a gauge at which the normal force acts, filtered likewise; NaN without force"},
     .run = read_number,
     .offset = offsetof(mor_gauge_reading, height)},
    {.run = NULL}};
