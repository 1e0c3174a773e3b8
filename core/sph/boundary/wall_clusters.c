/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/boundary/wall_clusters.h"

#include "core/base/memory.h"
#include "core/sph/boundary/soil_contact.h"

#include <string.h>

/* Room beyond what is needed, so that few lists need more: 1/n of it, and some clusters. */
enum { SPARE = 8, LEAST = 16 };

mor_status mor_wall_clusters_init(mor_context *context, mor_wall_clusters *at, int64_t n_clusters)
{
    MOR_TRY(context, MOR_NEW(context, &at->n_patches, n_clusters, "clusters at walls"));
    MOR_TRY(context, MOR_NEW(context, &at->places, n_clusters, "clusters at walls"));
    for (int64_t cluster = 0; cluster < n_clusters; ++cluster) {
        at->places[cluster] = -1;
    }
    return MOR_OK;
}

static void clear_room(mor_context *context, mor_wall_clusters *at)
{
    MOR_FREE(context, &at->corners);
    MOR_FREE(context, &at->continued);
    MOR_FREE(context, &at->closed);
    at->room = 0;
}

void mor_wall_clusters_clear(mor_context *context, mor_wall_clusters *at)
{
    clear_room(context, at);
    MOR_FREE(context, &at->places);
    MOR_FREE(context, &at->n_patches);
}

void mor_wall_clusters_begin(mor_wall_clusters *at, int64_t n_clusters)
{
    memset(at->n_patches, 0, (size_t)n_clusters);
}

void mor_wall_clusters_count(mor_wall_clusters *at, const mor_soil_contact *contact)
{
    for (int64_t place = 0; place < contact->relation.n_occupied; ++place) {
        int8_t *count = at->n_patches + contact->relation.occupied[place];
        const int64_t n = *count + contact->first_slot[place + 1] - contact->first_slot[place];
        *count = n < 2 ? (int8_t)n : 2;
    }
}

static mor_status make_room(mor_context *context, mor_wall_clusters *at)
{
    const int64_t room = at->n + at->n / SPARE + LEAST;
    clear_room(context, at);
    if (at->has_closed) {
        MOR_TRY(context, MOR_NEW(context, &at->closed, room * MOR_CLUSTER * 6, "moments closed by walls"));
    }
    if (at->has_continued) {
        MOR_TRY(context, MOR_NEW(context, &at->continued, room * MOR_CLUSTER * 6, "moments continued into walls"));
    }
    if (at->has_corners) {
        MOR_TRY(context, MOR_NEW(context, &at->corners, room * MOR_CLUSTER, "faces that particles see"));
    }
    at->room = room;
    return MOR_OK;
}

mor_status mor_wall_clusters_end(mor_context *context, mor_wall_clusters *at, int64_t n_clusters)
{
    at->n = 0;
    for (int64_t cluster = 0; cluster < n_clusters; ++cluster) {
        at->places[cluster] = at->n_patches[cluster] > 0 ? (int32_t)at->n++ : -1;
    }
    const bool lacks_corners = at->has_corners && at->corners == NULL; /* a boundary with normals was added */
    return at->n > at->room || lacks_corners ? make_room(context, at) : MOR_OK;
}

double mor_wall_clusters_bytes(const mor_wall_clusters *at, int64_t n_clusters)
{
    const double n_tensors = (at->closed != NULL) + (at->continued != NULL);
    const double of_particle =
        n_tensors * 6.0 * sizeof(double) + (at->corners != NULL ? (double)sizeof *at->corners : 0.0);
    return (double)n_clusters * (sizeof *at->n_patches + sizeof *at->places) +
           (double)(at->room * MOR_CLUSTER) * of_particle;
}
