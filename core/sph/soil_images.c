/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil in space that repeats itself: particles beyond a face are images of those at the other one. */
#include "core/sph/soil_internal.h"

#include "core/base/memory.h"
#include "core/particle/kernel.h"

#include <math.h>
#include <string.h>

/* Of the lists, m. */
static double find_reach(const mor_soil *soil)
{
    const mor_scheme *scheme = &soil->settings.scheme;
    return (MOR_KERNEL_SUPPORT * scheme->smoothing_ratio + scheme->skin_ratio) * soil->settings.spacing;
}

mor_status mor_soil_allocate_images(mor_context *context, mor_soil *soil)
{
    const mor_soil_settings *s = &soil->settings;
    const double least = 2.0 * find_reach(soil);
    mor_period_init(&soil->period, s->domain_minimum, s->domain_maximum, s->is_periodic);
    if (!soil->period.is_any) {
        return MOR_OK;
    }
    for (int a = 0; a < 3; ++a) {
        MOR_CHECK(context, !s->is_periodic[a] || soil->period.length[a] >= least, MOR_ERROR_CONFIG,
                  "found a period of %g m along %c; allowed are at least %.4g m, twice the reach of the neighbor lists",
                  soil->period.length[a], "xyz"[a], least);
    }
    MOR_CHECK(context, s->placement == NULL, MOR_ERROR_CONFIG,
              "found a periodic domain that is rotated or translated by a placement; allowed is one of both; leave the "
              "period or the placement out");
    const int64_t n = soil->set.n_particles;
    MOR_TRY(context, MOR_NEW(context, &soil->image_stress, s->scheme.artificial_stress ? 6 * n : 0, "images"));
    MOR_TRY(context, MOR_NEW(context, &soil->image_strains, s->scheme.reconstruction == 1 ? 6 * n : 0, "images"));
    return mor_images_init(context, &soil->images, &soil->period, n);
}

mor_status mor_soil_build_inner(mor_context *context, mor_soil *soil, const double *position, double reach,
                                mor_relation_points *points)
{
    mor_images *images = &soil->images;
    const mor_images_array arrays[] = {{&soil->records, MOR_RECORD_SIZE}, {&soil->of_soil, MOR_PAIR_OF_SOIL_SIZE},
                                       {&soil->extra, soil->extra_width}, {&soil->field_records, MOR_PAIR_FIELD_SIZE},
                                       {&soil->image_stress, 6},          {&soil->image_strains, 6}};
    *points = (mor_relation_points){&soil->tree, position, 3};
    if (!mor_images_are_used(images)) {
        mor_tree_fit(&soil->tree, position, 3);
        return mor_relation_build(context, &soil->inner, points, points, reach);
    }
    MOR_TRY(context, mor_images_find(context, images, position, soil->set.n_particles, 3, NULL, reach));
    const mor_status status = mor_images_make_room(context, images, &soil->image_room, arrays, 6);
    mor_soil_place_late(context, soil);
    MOR_TRY(context, status);
    points->records = images->places;
    mor_tree_fit(&soil->tree, points->records, 3);
    const mor_relation_points targets = mor_images_targets(images);
    MOR_TRY(context, mor_relation_build(context, &soil->inner, points, &targets, reach));
    mor_images_sort(context, images, &soil->inner);
    return MOR_OK;
}

void mor_soil_follow_records(mor_context *context, const mor_soil *soil)
{
    mor_images_follow(context, &soil->images, soil->records, MOR_RECORD_SIZE, MOR_RECORD_POSITION);
}

void mor_soil_find_unwrapped(const mor_soil *soil, int64_t particle, double *place)
{
    const double *crossings = soil->set.data[MOR_FIELD_CROSSINGS];
    memcpy(place, soil->set.data[MOR_FIELD_POSITION] + 3 * particle, 3 * sizeof *place);
    for (int a = 0; a < 3 && crossings != NULL; ++a) {
        place[a] += crossings[3 * particle + a] * soil->period.length[a];
    }
}

mor_status mor_soil_check_images(mor_context *context, const mor_soil *soil, bool is_start, double time)
{
    double clearance[3] = {0.0, 0.0, 0.0};
    if (soil->period.is_any && !is_start) {
        mor_images_find_overhang(&soil->images, clearance);
    }
    for (int a = 0; a < 3; ++a) {
        clearance[a] += find_reach(soil);
    }
    for (int k = 0; k < soil->n_boundaries && soil->period.is_any; ++k) {
        MOR_TRY(context, mor_soil_contact_check_period(context, &soil->boundaries[k], &soil->period, clearance,
                                                       is_start ? MOR_ERROR_CONFIG : MOR_ERROR_NUMERIC, time));
    }
    return MOR_OK;
}
