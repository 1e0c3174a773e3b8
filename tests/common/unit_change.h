/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_UNIT_CHANGE_H
#define MOR_TESTS_COMMON_UNIT_CHANGE_H

#include "core/base/units.h"
#include "tests/common/scene.h"

/** @file
 *  A case in other units of length, time and mass, all even powers of two: what each number of the result must then be
 *  multiplied by. A term with a wrong dimension, an absolute threshold or a constant with a hidden unit breaks that. */

/** Powers of two of the units, and the settings that make the change. */
typedef struct unit_change {
    int length, mass, time;
    const char *settings[4]; /* "key=value", ends with NULL */
} unit_change;

static const unit_change unit_changes[] = {
    {6, 2, 4, {"scale.length=64", "scale.mass=4", "scale.time=16", NULL}},
    {-2, 4, -4, {"scale.length=0.25", "scale.mass=16", "scale.time=0.0625", NULL}},
};

enum { UNIT_CHANGES = sizeof unit_changes / sizeof *unit_changes };

/** Power of two that a number of this unit, zero-terminated, gets. */
static inline int unit_change_power(scene *it, const mor_units *units, const unit_change *by, const char *unit)
{
    mor_dimension dimension;
    scene_require(it, mor_units_dimension(&it->context, units, unit, &dimension));
    return mor_dimension_scale(&dimension, by->length, by->mass, by->time);
}

/** Unit of a field of a set, zero-terminated; in plane strain a particle's mass is per meter of thickness. */
static inline const char *unit_change_field(const scene *it, const mor_set *set, int field)
{
    return field == MOR_FIELD_MASS && it->the_case.dimension == 2 ? "kg/m" : set->fields[field].unit;
}

/** Fails the running test unless two numbers of one unit have the same bits, or are both not numbers. Where: variant
 *  and what are zero-terminated. */
static inline void unit_change_expect(double found, double expected, const unit_change *by, const char *variant,
                                      const char *what, long long place)
{
    if (memcmp(&found, &expected, sizeof found) != 0 && !(isnan(found) && isnan(expected))) {
        fail_msg("'%s', %s %s %s: %s %lld is %.17g, not %.17g", variant, by->settings[0], by->settings[1],
                 by->settings[2], what, place, found, expected);
    }
}

/** Fails unless all probes of two scenes agree. */
static inline void unit_change_compare_probes(scene *plain, scene *scaled, const mor_units *units,
                                              const unit_change *by, const char *variant)
{
    for (int k = 0; k < plain->the_case.n_probes; ++k) {
        const char *probe = plain->the_case.probes[k].name;
        const int power = unit_change_power(plain, units, by, mor_probe_unit(&plain->the_case, k));
        unit_change_expect(scene_probe(scaled, probe), ldexp(scene_probe(plain, probe), power), by, variant, probe, 0);
    }
}

/** Fails unless the clocks of two scenes agree: steps are as long as speeds and accelerations allow, the first thing to
 *  go wrong. */
static inline void unit_change_compare_time(const scene *plain, const scene *scaled, const unit_change *by,
                                            const char *variant)
{
    unit_change_expect(mor_schedule_time(&scaled->simulation.schedule),
                       ldexp(mor_schedule_time(&plain->simulation.schedule), by->time), by, variant, "time", 0);
}

#endif
