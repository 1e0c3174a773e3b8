/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/settings/soil_settings.h"

#include "core/base/math.h"
#include "core/material/composite.h"
#include "core/material/piece.h"
#include "core/material/varied.h"
#include "core/particle/kernel.h"

#include <math.h>

/* Times of a fall up to the speed of soil at rest that soil must have been quiet at least. */
enum { FALLS = 4 };

void mor_soil_sum_lattice(const mor_soil_settings *settings, double smoothing_length, double *value, double *moment)
{
    const double spacing = settings->spacing;
    const int reach = (int)(MOR_KERNEL_SUPPORT * smoothing_length / spacing) + 1;
    const int reach_z = settings->dimension == 3 ? reach : 0;
    *value = 0.0;
    *moment = 0.0;
    for (int x = -reach; x <= reach; ++x) {
        for (int y = -reach; y <= reach; ++y) {
            for (int z = -reach_z; z <= reach_z; ++z) {
                const double r = spacing * sqrt((double)(x * x + y * y + z * z));
                *value += mor_kernel_value(r, smoothing_length, settings->dimension);
                *moment -= r > 0.0 ? mor_kernel_derivative(r, smoothing_length, settings->dimension) * spacing *
                                         spacing * (double)(x * x) / r
                                   : 0.0;
            }
        }
    }
    const double volume = settings->dimension == 3 ? spacing * spacing * spacing : spacing * spacing;
    *value *= volume;
    *moment *= volume;
}

mor_status mor_soil_kind_find_speed(mor_context *context, const mor_material_instance *material, int index,
                                    mor_soil_kind *kind)
{
    double speed = 0.0;
    const mor_status status = mor_material_find_speed(material, index, kind->reference_density, &speed);
    MOR_CHECK(context, status == MOR_OK && speed > 0.0 && isfinite(speed), MOR_ERROR_NUMERIC,
              "material '%s' gives a wave speed of %g m/s; it must be positive and finite", material->material->name,
              speed);
    kind->sound_speed = speed;
    return MOR_OK;
}

void mor_soil_kind_find_rest(const mor_soil_kind *kind, double gravity, const double *direction, double *rest_gradient)
{
    const double weight = kind->reference_density * gravity;
    const double lateral = kind->lateral_ratio;
    for (int a = 0; a < 3; ++a) {
        rest_gradient[a] = weight * (lateral + (1.0 - lateral) * direction[a] * direction[a]);
        rest_gradient[3 + a] = weight * (1.0 - lateral) * direction[a] * direction[(a + 1) % 3];
    }
}

/* Small expansions of one particle. */
typedef struct expansion {
    const mor_material_instance *material;
    int index;
    double density; /* kg/m3 */
    double across;  /* 1 */
    mor_status status;
} expansion;

static void expand(void *job)
{
    expansion *it = job;
    it->status = mor_material_find_tension(it->material, it->index, it->density, &it->across);
}

double mor_soil_kind_find_across(mor_guard guard, const mor_material_instance *material, int index,
                                 const mor_soil_kind *kind)
{
    expansion job = {material, index, kind->reference_density, 0.0, MOR_OK};
    if (mor_varied_is(mor_composite_part(material, index)) || mor_guard_run(guard, expand, &job) != 0 ||
        job.status != MOR_OK) {
        return 1.0; /* of a crash the first step tells */
    }
    return job.across;
}

double mor_soil_find_release(const mor_soil_settings *settings)
{
    double latest = settings->released[0];
    for (int k = 1; k < settings->n_regions && k < MOR_HOLD_REGIONS_MAX; ++k) {
        latest = fmax(latest, settings->released[k]);
    }
    return latest;
}

/* Lists of clusters that sleep are of clusters of the soil, not of images of it. */
static mor_status check_period(mor_context *context, const mor_soil_settings *settings)
{
    const double after = settings->scheme.sleep_after;
    const double released = mor_soil_find_release(settings);
    if (!settings->is_periodic[0] && !settings->is_periodic[1] && !settings->is_periodic[2]) {
        return MOR_OK;
    }
    MOR_CHECK(context, after == 0.0, MOR_ERROR_CONFIG,
              "found a periodic domain with soil that may sleep, sleep_after = %g s; allowed is one of both, for soil "
              "that sleeps is not continued beyond a periodic face; leave sleep_after or the period out",
              after);
    MOR_CHECK(context, !(released > 0.0), MOR_ERROR_CONFIG,
              "found a periodic domain with soil that is released at %g s; allowed is one of both, for soil that "
              "stands is not continued beyond a periodic face; release it at the start, or leave the period out",
              released);
    return MOR_OK;
}

/* XSPH and shifting move particles by their neighbors, whether or not they stand still. */
static mor_status check_regularization(mor_context *context, const mor_soil_settings *settings)
{
    const mor_scheme *scheme = &settings->scheme;
    const char *name = scheme->shifting ? "shifting" : "xsph";
    const double released = mor_soil_find_release(settings);
    if (!scheme->shifting && !(scheme->xsph > 0.0)) {
        return MOR_OK;
    }
    MOR_CHECK(context, scheme->sleep_after == 0.0, MOR_ERROR_CONFIG,
              "found %s with soil that may sleep, sleep_after = %g s; allowed is one of both, for %s moves soil that "
              "sleeps; leave sleep_after or %s out",
              name, scheme->sleep_after, name, name);
    MOR_CHECK(context, !(released > 0.0), MOR_ERROR_CONFIG,
              "found %s with soil that is released at %g s; allowed is one of both, for %s moves soil that stands; "
              "release it at the start, or leave %s out",
              name, released, name, name);
    return MOR_OK;
}

mor_status mor_soil_check_sleep(mor_context *context, const mor_soil_settings *settings)
{
    const mor_scheme *scheme = &settings->scheme;
    const double gravity = mor_vector_length(settings->gravity);
    const double least = gravity > 0.0 ? FALLS * scheme->sleep_speed * sqrt(settings->spacing / gravity) : 0.0;
    MOR_CHECK(
        context, scheme->sleep_after == 0.0 || scheme->sleep_after >= least, MOR_ERROR_CONFIG,
        "found numerics.sleep_after = %g s; allowed: 0, or at least %.3g s, %d times as long as soil that begins to "
        "fall stays slower than sleep_speed: it would fall asleep in the air; give a longer time",
        scheme->sleep_after, least, FALLS);
    MOR_TRY(context, check_regularization(context, settings));
    return check_period(context, settings);
}
