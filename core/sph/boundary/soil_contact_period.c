/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Boundaries in space that repeats itself: images of walls, and rocks that have none. */
#include "core/sph/boundary/soil_contact_internal.h"

#include <math.h>
#include <string.h>

enum { RECORD = MOR_BOUNDARY_RECORD };

static void follow_images(mor_context *context, mor_soil_contact *contact)
{
    mor_images_follow(context, &contact->images, contact->boundary->records, RECORD, MOR_BOUNDARY_POSITION);
    if (contact->normals != NULL && contact->is_wall) {
        mor_images_follow(context, &contact->images, contact->normals, 3, -1);
        mor_images_follow(context, &contact->images, contact->depths, 1, -1);
    }
}

void mor_soil_contact_approach_lists(mor_context *context, mor_soil_contact *contact)
{
    for (int64_t i = 0; i < contact->n_points && contact->images.n_own > 0; ++i) {
        double *record = contact->boundary->records + RECORD * i;
        mor_period_round_places(contact->period, 1, RECORD, record);
        mor_period_approach(contact->period, record, contact->built + 3 * i);
    }
    follow_images(context, contact);
}

mor_status mor_soil_contact_find_images(mor_context *context, mor_soil_contact *contact,
                                        const mor_relation_points *soil, double reach)
{
    mor_images *images = &contact->images;
    const mor_images_array arrays[] = {
        {&contact->boundary->records, RECORD}, {&contact->normals, 3}, {&contact->depths, 1}};
    MOR_TRY(context, mor_images_find(context, images, contact->boundary->records, contact->n_points, RECORD,
                                     soil->tree->boxes, reach));
    MOR_TRY(context, mor_images_make_room(context, images, &contact->image_room, arrays, 3));
    for (int64_t i = 0; i < contact->n_points; ++i) {
        memcpy(contact->boundary->records + RECORD * i, images->places + 3 * i, 3 * sizeof *images->places);
    }
    follow_images(context, contact);
    return MOR_OK;
}

mor_status mor_soil_contact_check_period(mor_context *context, const mor_soil_contact *contact,
                                         const mor_period *period, const double *clearance, mor_status refusal,
                                         double time)
{
    const mor_boundary *boundary = contact->boundary;
    for (int p = 0; p < boundary->n_patches; ++p) {
        const mor_boundary_patch *patch = &boundary->patches[p];
        const int64_t n = patch->is_removed ? 0 : patch->n_points;
        for (int64_t k = 0; k < 3 * n; ++k) {
            const int a = (int)(k % 3);
            const double length = period->length[a];
            const double above = boundary->records[(patch->first + k / 3) * RECORD + a] - period->minimum[a];
            const double least = clearance[a];
            MOR_CHECK(context, !(length > 0.0) || (above >= least && above <= length - least), refusal,
                      "body %d of '%s' comes to %.4g m from the periodic face %c = %g m at t = %.6g s; bodies are not "
                      "continued beyond periodic faces and must stay %.4g m away from them, the reach of the neighbor "
                      "lists and what clusters of soil reach through the face; move or hold it, make the domain longer "
                      "along %c, or take %c out of domain.periodic",
                      p, boundary->name, fmin(above, length - above), "xyz"[a],
                      period -> minimum[a] + (above < 0.5 * length ? 0.0 : length), time, least, "xyz"[a], "xyz"[a]);
        }
    }
    return MOR_OK;
}
