/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Neighbors in the reference configuration: found once, within each body. */
#include "bodies/elastic/elastic_internal.h"

#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"
#include "core/particle/relation.h"

#include <string.h>

/* The moment of a particle is singular when its determinant is less than this part of that of a multiple of I with the
 * same trace; corners of a lattice have about a third. A tip of a relaxed rock with 2e-3 was seen to break down in free
 * fall, one with 2e-2 not. */
#define SMALLEST_DETERMINANT 1e-2

/* Clusters of a body, and its particles in reach of one another. */
static mor_status relate_body(mor_context *context, const mor_elastic *elastic, int b, mor_relation *relation)
{
    const mor_body *body = &elastic->group.bodies[b];
    const int64_t n_clusters = (body->n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    double *points = NULL;
    mor_tree tree = {0};
    mor_status status = MOR_NEW(context, &points, 3 * n_clusters * MOR_CLUSTER, "reference positions of a body");
    if (status == MOR_OK) {
        memcpy(points, elastic->group.reference + 3 * body->first, (size_t)(3 * body->n_particles) * sizeof *points);
        for (int64_t i = body->n_particles; i < n_clusters * MOR_CLUSTER; ++i) {
            memcpy(points + 3 * i, points + 3 * (body->n_particles - 1), 3 * sizeof *points);
        }
        status = mor_tree_init(context, &tree, body->n_particles);
    }
    if (status == MOR_OK) {
        status = mor_relation_init(context, relation, MOR_CONFIGURATION_REFERENCE, n_clusters);
    }
    if (status == MOR_OK) {
        const mor_relation_points view = {&tree, points, 3};
        mor_tree_fit(&tree, points, 3);
        status = mor_relation_build(context, relation, &view, &view, MOR_KERNEL_SUPPORT * elastic->smoothing_length);
    }
    mor_tree_clear(context, &tree);
    MOR_FREE(context, &points);
    return status;
}

static mor_status allocate_work(mor_context *context, mor_elastic *elastic, int64_t n_entries)
{
    mor_elastic_work *work = elastic->work;
    const int64_t n_slots = work->n_clusters * MOR_CLUSTER;
    const int64_t n_chunks = (work->n_clusters + MOR_ELASTIC_CHUNK - 1) / MOR_ELASTIC_CHUNK;
    const int d = elastic->group.dimension;
    MOR_TRY(context, MOR_NEW(context, &work->clusters, work->n_clusters + 1, "clusters of bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->entries, n_entries, "neighbors in bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->weights, n_entries * MOR_CLUSTER, "kernel weights in bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->stressed, n_slots * (2 * d + d * d), "records of body particles"));
    MOR_TRY(context, MOR_NEW(context, &work->moving, n_slots * 2 * d, "records of body particles"));
    MOR_TRY(context, MOR_NEW(context, &work->inverses, n_slots * 6, "correction matrices of bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->sums, n_slots * 3, "kernel sums of bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->piece_kicks, elastic->group.n_pieces, "forces on bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->chunk_status, n_chunks, "results of chunks of bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->chunk_power, n_chunks, "results of chunks of bodies"));
    MOR_TRY(context, MOR_NEW(context, &work->chunk_failed, n_chunks, "results of chunks of bodies"));
    return MOR_OK;
}

/* Numbers the clusters of all bodies and copies their lists, body by body. */
static void fill_clusters(mor_elastic *elastic, const mor_relation *relations)
{
    mor_elastic_work *work = elastic->work;
    int64_t c = 0;
    int64_t entry = 0;
    for (int b = 0; b < elastic->group.n_bodies; ++b) {
        const mor_body *body = &elastic->group.bodies[b];
        const int64_t first_slot = c * MOR_CLUSTER;
        for (int64_t k = 0; k < relations[b].n_clusters; ++k, ++c) {
            const int64_t left = body->n_particles - k * MOR_CLUSTER;
            const int32_t count = relations[b].counts[k];
            const int32_t *list = mor_relation_entries(&relations[b], k);
            work->clusters[c] =
                (mor_elastic_cluster){.first = body->first + k * MOR_CLUSTER,
                                      .first_entry = entry,
                                      .n_entries = count,
                                      .n_lanes = left < MOR_CLUSTER ? (int32_t)left : (int32_t)MOR_CLUSTER,
                                      .body = b};
            for (int32_t e = 0; e < count; ++e) {
                work->entries[entry] = (mor_elastic_entry){(int32_t)(first_slot + list[e]), (int32_t)entry};
                ++entry;
            }
        }
    }
    work->clusters[c].first = elastic->group.set.n_particles;
}

/* Reference positions in the records; a slot behind the last particle of a body repeats that particle, and no list
 * names it. */
static void fill_positions(mor_elastic *elastic)
{
    mor_elastic_work *work = elastic->work;
    const int d = elastic->group.dimension;
    for (int64_t slot = 0; slot < work->n_clusters * MOR_CLUSTER; ++slot) {
        const mor_elastic_cluster *cluster = &work->clusters[slot / MOR_CLUSTER];
        const int64_t lane = slot % MOR_CLUSTER < cluster->n_lanes ? slot % MOR_CLUSTER : cluster->n_lanes - 1;
        const double *x = elastic->group.reference + 3 * (cluster->first + lane);
        memcpy(work->stressed + slot * (2 * d + d * d), x, (size_t)d * sizeof *x);
        memcpy(work->moving + slot * 2 * d, x, (size_t)d * sizeof *x);
    }
}

/* Weights, sum k r and moments m of one lane. The weight of a pair is the same seen from both ends. */
static void weigh_lane(const mor_elastic *elastic, int64_t c, int lane, double *moment)
{
    mor_elastic_work *work = elastic->work;
    const mor_elastic_cluster *cluster = &work->clusters[c];
    const int d = elastic->group.dimension;
    const int size = 2 * d;
    const double *x = work->moving + (c * MOR_CLUSTER + lane) * size;
    const double half_inverse_h = 0.5 / elastic->smoothing_length;
    double sum[3] = {0.0};
    memset(moment, 0, 6 * sizeof *moment);
    for (int32_t e = 0; e < cluster->n_entries; ++e) {
        const double *other = work->moving + (int64_t)work->entries[cluster->first_entry + e].slot * size;
        double r[3] = {0.0};
        for (int a = 0; a < d; ++a) {
            r[a] = x[a] - other[a];
        }
        const double distance2 = mor_vector_dot(r, r);
        const double reach = 1.0 - sqrt(distance2) * half_inverse_h;
        const bool is_seen = reach > 0.0 && distance2 > 0.0 && lane < cluster->n_lanes;
        const float weight = is_seen ? (float)(reach * reach * reach) : 0.0F;
        work->weights[(cluster->first_entry + e) * MOR_CLUSTER + lane] = weight;
        for (int a = 0; a < 3; ++a) {
            const double kr = (double)weight * r[a];
            sum[a] += kr;
            moment[a] += kr * r[a];
            moment[3 + a] += kr * r[(a + 1) % 3];
        }
    }
    for (int a = 0; a < 3; ++a) {
        work->sums[(3 * c + a) * MOR_CLUSTER + lane] = sum[a];
    }
}

/* Inverse of a moment; false when the neighbors lie (nearly) on a plane, or on a line. */
static bool invert_moment(int d, const double *m, double *inverse)
{
    const double mean = mor_symmetric_trace(m) / d;
    memset(inverse, 0, 6 * sizeof *inverse);
    if (d == 2) {
        const double determinant = m[MOR_XX] * m[MOR_YY] - m[MOR_XY] * m[MOR_XY];
        inverse[MOR_XX] = m[MOR_YY] / determinant;
        inverse[MOR_YY] = m[MOR_XX] / determinant;
        inverse[MOR_XY] = -m[MOR_XY] / determinant;
        return determinant > SMALLEST_DETERMINANT * (mean * mean);
    }
    const double determinant = mor_symmetric_cofactors(m, inverse);
    for (int a = 0; a < 6; ++a) {
        inverse[a] /= determinant;
    }
    return determinant > SMALLEST_DETERMINANT * (mean * mean * mean);
}

/* Weights and correction matrices of a cluster; returns a lane that cannot be corrected, or -1. */
static int weigh_cluster(const mor_elastic *elastic, int64_t c)
{
    mor_elastic_work *work = elastic->work;
    int failed = -1;
    for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
        double moment[6];
        double inverse[6] = {0.0};
        weigh_lane(elastic, c, lane, moment);
        if (lane < work->clusters[c].n_lanes && !invert_moment(elastic->group.dimension, moment, inverse)) {
            failed = lane;
        }
        for (int a = 0; a < 6; ++a) {
            work->inverses[(6 * c + a) * MOR_CLUSTER + lane] = inverse[a];
        }
    }
    return failed;
}

static mor_status weigh_all(mor_context *context, mor_elastic *elastic)
{
    mor_elastic_work *work = elastic->work;
    const int64_t n_chunks = (work->n_clusters + MOR_ELASTIC_CHUNK - 1) / MOR_ELASTIC_CHUNK;
    MOR_PARALLEL_FOR (context, chunk, n_chunks, 1) {
        const int64_t last = (chunk + 1) * MOR_ELASTIC_CHUNK;
        work->chunk_failed[chunk] = -1;
        for (int64_t c = chunk * MOR_ELASTIC_CHUNK; c < last && c < work->n_clusters; ++c) {
            const int lane = weigh_cluster(elastic, c);
            work->chunk_failed[chunk] = lane >= 0 ? work->clusters[c].first + lane : work->chunk_failed[chunk];
        }
    }
    for (int64_t chunk = 0; chunk < n_chunks; ++chunk) {
        const int64_t i = work->chunk_failed[chunk];
        if (i >= 0) {
            const mor_body_group *group = &elastic->group;
            const double *x = group->reference + 3 * i;
            const mor_status status = MOR_FAIL(
                context, MOR_ERROR_ARGUMENT,
                "body '%s' is too thin at (%.6g, %.6g, %.6g) m: the neighbors of a particle lie, or lie almost, on a "
                "%s, so that no deformation can be found. An elastic body needs two layers of particles "
                "everywhere: make the spacing (%.4g m) smaller, the tip or edge blunter, or the body rigid",
                group->bodies[group->body_of[i]].name, x[0], x[1], x[2], group->dimension == 3 ? "plane" : "line",
                group->spacing);
            return mor_context_name_item(context, status, group->body_of[i]);
        }
    }
    return MOR_OK;
}

/* Place of a row in the table of places, or of its first free place. */
static int64_t find_place(const mor_elastic_work *work, const int32_t *places, int64_t n_places, const float *weights)
{
    const uint64_t hash = mor_hash_bytes(weights, MOR_CLUSTER * sizeof *weights);
    int64_t place = (int64_t)(hash & (uint64_t)(n_places - 1));
    while (places[place] >= 0 &&
           memcmp(work->weights + (int64_t)places[place] * MOR_CLUSTER, weights, MOR_CLUSTER * sizeof *weights) != 0) {
        place = (place + 1) & (n_places - 1);
    }
    return place;
}

/* Keeps of each row of weights one copy: in the loops they then come from the nearest cache. */
static mor_status share_weights(mor_context *context, mor_elastic_work *work, int64_t n_entries)
{
    int32_t *places = NULL;
    float *rows = NULL;
    int64_t n_places = 1;
    while (n_places < 2 * n_entries) {
        n_places *= 2;
    }
    MOR_TRY(context, MOR_NEW(context, &places, n_places, "places of kernel weights"));
    for (int64_t k = 0; k < n_places; ++k) {
        places[k] = -1;
    }
    work->n_rows = 0;
    for (int64_t e = 0; e < n_entries; ++e) {
        float weights[MOR_CLUSTER];
        memcpy(weights, work->weights + e * MOR_CLUSTER, sizeof weights);
        const int64_t place = find_place(work, places, n_places, weights);
        if (places[place] < 0) {
            memcpy(work->weights + work->n_rows * MOR_CLUSTER, weights, sizeof weights);
            places[place] = (int32_t)work->n_rows++;
        }
        work->entries[e].weights = places[place];
    }
    MOR_FREE(context, &places);
    MOR_TRY(context, MOR_NEW(context, &rows, work->n_rows * MOR_CLUSTER, "kernel weights in bodies"));
    memcpy(rows, work->weights, (size_t)(work->n_rows * MOR_CLUSTER) * sizeof *rows);
    MOR_FREE(context, &work->weights);
    work->weights = rows;
    return MOR_OK;
}

mor_status mor_elastic_find_neighbors(mor_context *context, mor_elastic *elastic)
{
    mor_relation *relations = NULL;
    int64_t n_entries = 0;
    const int n_bodies = elastic->group.n_bodies;
    MOR_TRY(context, MOR_NEW(context, &relations, n_bodies, "neighbors in bodies"));
    mor_status status = MOR_OK;
    for (int b = 0; b < n_bodies && status == MOR_OK; ++b) {
        status = relate_body(context, elastic, b, &relations[b]);
        n_entries += relations[b].n_entries;
        elastic->work->n_clusters += relations[b].n_clusters;
    }
    if (status == MOR_OK) {
        status = allocate_work(context, elastic, n_entries);
    }
    if (status == MOR_OK) {
        fill_clusters(elastic, relations);
        fill_positions(elastic);
        status = weigh_all(context, elastic);
    }
    if (status == MOR_OK) {
        status = share_weights(context, elastic->work, n_entries);
    }
    for (int b = 0; b < n_bodies; ++b) {
        mor_relation_clear(context, &relations[b]);
    }
    MOR_FREE(context, &relations);
    return status;
}
