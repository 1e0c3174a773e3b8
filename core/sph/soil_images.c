/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil in space that repeats itself: particles beyond a face are images of those at the other one. */
#include "core/sph/soil_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
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
        MOR_CHECK(
            context, !s->is_periodic[a] || soil->period.length[a] >= least, MOR_ERROR_CONFIG,
            "found domain.periodic with a domain of %g m along %c; allowed are at least %.4g m, twice the reach of "
            "the neighbor lists, so that no particle sees another twice; make the domain longer along %c or the "
            "spacing smaller",
            soil->period.length[a], "xyz"[a], least, "xyz"[a]);
    }
    MOR_CHECK(context, s->placement == NULL, MOR_ERROR_CONFIG,
              "found domain.periodic with a placement; allowed is a domain that is neither rotated nor translated; "
              "incline gravity in place of the scene");
    MOR_CHECK(context, s->scheme.sleep_after == 0.0, MOR_ERROR_CONFIG,
              "found numerics.sleep_after = %g s with domain.periodic; allowed: 0, for soil that sleeps does not see "
              "what moves beyond a periodic face; leave it out",
              s->scheme.sleep_after);
    return mor_images_init(context, &soil->images, &soil->period, soil->set.n_particles);
}

void mor_soil_clear_images(mor_context *context, mor_soil *soil)
{
    mor_images_clear(context, &soil->images);
    MOR_FREE(context, &soil->image_stress);
    MOR_FREE(context, &soil->image_strains);
}

/* Room for images behind the particles; what was in it is lost, and packed anew after a build. */
static mor_status make_room(mor_context *context, mor_soil *soil)
{
    const int64_t n = soil->images.n_most + soil->images.capacity + 2 * MOR_CLUSTER;
    const struct {
        double **array;
        int width;
        bool is_new;
    } arrays[] = {{&soil->records, MOR_RECORD_SIZE, false},
                  {&soil->of_soil, MOR_PAIR_OF_SOIL_SIZE, false},
                  {&soil->extra, MOR_EXTRA_SIZE, false},
                  {&soil->field_records, MOR_PAIR_FIELD_SIZE, false},
                  {&soil->image_stress, 6, soil->set.data[MOR_FIELD_ARTIFICIAL_STRESS] != NULL},
                  {&soil->image_strains, 6, soil->set.data[MOR_FIELD_STRAIN_RATE] != NULL}};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k) {
        if (*arrays[k].array != NULL || arrays[k].is_new) {
            MOR_FREE(context, arrays[k].array);
            MOR_TRY(context, MOR_NEW(context, arrays[k].array, n * arrays[k].width, "records of images"));
        }
    }
    soil->image_room = soil->images.capacity;
    return MOR_OK;
}

mor_status mor_soil_build_inner(mor_context *context, mor_soil *soil, const double *position, double reach,
                                mor_relation_points *points)
{
    mor_images *images = &soil->images;
    *points = (mor_relation_points){&soil->tree, position, 3};
    if (!mor_images_are_used(images)) {
        mor_tree_fit(&soil->tree, position, 3);
        return mor_relation_build(context, &soil->inner, points, points, reach);
    }
    MOR_TRY(context, mor_images_find(context, images, position, soil->set.n_particles, 3, NULL, reach));
    if (images->capacity > soil->image_room) {
        MOR_TRY(context, make_room(context, soil));
    }
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
    if (soil->extra != NULL) {
        mor_images_follow(context, &soil->images, soil->extra, MOR_EXTRA_SIZE, -1);
    }
}

const double *mor_soil_extend(mor_context *context, const mor_soil *soil, const double *field, double *room)
{
    if (field == NULL || !mor_images_are_used(&soil->images)) {
        return field;
    }
    memcpy(room, field, (size_t)(6 * soil->set.n_particles) * sizeof *room);
    mor_images_follow(context, &soil->images, room, 6, -1);
    return room;
}

void mor_soil_put_inside(mor_context *context, mor_soil *soil, double *position, double *crossings)
{
    const mor_period *period = &soil->period;
    MOR_PARALLEL_FOR (context, i, period->is_any ? soil->set.n_particles : 0, MOR_BLOCK) {
        double *x = position + 3 * i;
        double shift[3];
        mor_period_find_shift(period, x, shift);
        for (int a = 0; a < 3; ++a) {
            x[a] += shift[a];
            /* Where the lists see it does not change. */
            soil->images.wrap[3 * i + a] -= shift[a];
            if (crossings != NULL && shift[a] != 0.0) {
                crossings[3 * i + a] -= rint(shift[a] / period->length[a]);
            }
        }
    }
}

void mor_soil_find_unwrapped(const mor_soil *soil, int64_t particle, double *place)
{
    const double *crossings = soil->set.data[MOR_FIELD_CROSSINGS];
    memcpy(place, soil->set.data[MOR_FIELD_POSITION] + 3 * particle, 3 * sizeof *place);
    for (int a = 0; a < 3 && crossings != NULL; ++a) {
        place[a] += crossings[3 * particle + a] * soil->period.length[a];
    }
}

static mor_status check_patch(mor_context *context, const mor_soil *soil, const mor_boundary *boundary, int p,
                              bool is_start, double time)
{
    const mor_boundary_patch *patch = &boundary->patches[p];
    const double reach = find_reach(soil);
    for (int64_t j = patch->first; j < patch->first + patch->n_points; ++j) {
        for (int a = 0; a < 3; ++a) {
            const double length = soil->period.length[a];
            const double above = boundary->records[j * MOR_BOUNDARY_RECORD + a] - soil->period.minimum[a];
            MOR_CHECK(context, !(length > 0.0) || (above >= reach && above <= length - reach),
                      is_start ? MOR_ERROR_CONFIG : MOR_ERROR_NUMERIC,
                      "body %d of '%s' comes to %.4g m from the periodic face %c = %g m at t = %.6g s; bodies are not "
                      "continued beyond periodic faces and must stay %.4g m away from them, the reach of the neighbor "
                      "lists; move or hold it, make the domain longer along %c, or take %c out of domain.periodic",
                      p, boundary->name, fmin(above, length - above), "xyz"[a],
                      soil -> period.minimum[a] + (above < 0.5 * length ? 0.0 : length), time, reach, "xyz"[a],
                      "xyz"[a]);
        }
    }
    return MOR_OK;
}

mor_status mor_soil_check_images(mor_context *context, const mor_soil *soil, bool is_start, double time)
{
    for (int k = 0; k < soil->n_boundaries && soil->period.is_any; ++k) {
        const mor_boundary *boundary = soil->boundaries[k].boundary;
        for (int p = 0; p < boundary->n_patches; ++p) {
            if (!boundary->patches[p].is_removed) {
                MOR_TRY(context, check_patch(context, soil, boundary, p, is_start, time));
            }
        }
    }
    return MOR_OK;
}
