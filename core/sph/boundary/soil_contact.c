/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Boundaries of the soil: how they are made, moved and listed. What they do to the soil: soil_contact_forces.c; what
 * the soil does to them: soil_contact_share.c. */
#include "core/sph/boundary/soil_contact_internal.h"
#include "core/sph/boundary/soil_wall.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/reduce.h"

#include <math.h>
#include <string.h>

enum { RECORD = MOR_BOUNDARY_RECORD };

/* What every contact has, once the boundary's points stand. */
static mor_status prepare_contact(mor_context *context, mor_soil_contact *contact, int64_t n_soil_clusters)
{
    const int64_t n = contact->blocks != NULL ? MOR_CLUSTER : contact->n_points; /* blocks make room as they come */
    contact->longest_step = INFINITY;
    MOR_TRY(context, mor_tree_init(context, &contact->tree, n));
    MOR_TRY(context, mor_relation_init(context, &contact->relation, MOR_CONFIGURATION_CURRENT, n_soil_clusters));
    MOR_TRY(context, MOR_NEW(context, &contact->first_slot, n_soil_clusters + 1, "slots of soil clusters"));
    MOR_TRY(context, MOR_NEW(context, &contact->first_of_patch, contact->boundary->n_patches + 1, "slots of patches"));
    MOR_TRY(context, MOR_NEW(context, &contact->farthest, mor_block_count(n) + 1, "blocks of boundary points"));
    if (!contact->is_wall || contact->base != NULL) {
        MOR_TRY(context, MOR_NEW(context, &contact->built, 3 * n, "boundary points of the lists"));
    }
    if (!contact->is_wall) {
        MOR_TRY(context, MOR_NEW(context, &contact->ranges, 6 * (2 * contact->tree.n_clusters + 1), "displacements"));
    }
    mor_tree_resize(&contact->tree, contact->n_points);
    mor_tree_fit(&contact->tree, contact->boundary->records, RECORD);
    return contact->is_wall ? mor_images_init(context, &contact->images, contact->period, n) : MOR_OK;
}

/* Of any point of a wall at any time, m/s. */
static double find_largest_speed(const mor_wall_request *request)
{
    double radius = 0.0;
    if (request->motion == NULL) {
        return mor_vector_length(request->velocity);
    }
    for (int64_t i = 0; i < request->n_points; ++i) {
        radius = fmax(radius, mor_motion_radius(request->motion, request->points + 3 * i));
    }
    return mor_motion_fastest(request->motion, radius);
}

static mor_status make_wall(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request)
{
    const bool has_normals = request->source != NULL ? request->source->has_normals : request->normals != NULL;
    const int64_t n = request->source != NULL ? MOR_CLUSTER : request->n_points;
    MOR_TRY(context, MOR_NEW(context, &contact->boundary, 1, "wall"));
    mor_boundary *boundary = contact->boundary;
    memcpy(boundary->name, contact->name, sizeof boundary->name);
    boundary->n_points = contact->n_points;
    boundary->n_patches = 1;
    contact->motion = request->motion;
    contact->rotates = request->motion != NULL && mor_motion_rotates(request->motion);
    contact->removed_at = request->removed_at;
    boundary->largest_speed = find_largest_speed(request);
    MOR_TRY(context, MOR_NEW(context, &boundary->records, (n + MOR_CLUSTER) * RECORD, "wall points"));
    MOR_TRY(context, MOR_NEW(context, &boundary->patches, 1, "patch of a wall"));
    boundary->patches[0] = (mor_boundary_patch){.n_points = contact->n_points,
                                                .friction = request->friction,
                                                .friction_coefficient = request->friction_coefficient};
    if (has_normals) {
        MOR_TRY(context, MOR_NEW(context, &contact->normals, 3 * n, "normals of a wall"));
        MOR_TRY(context, MOR_NEW(context, &contact->depths, n, "normals of a wall"));
    }
    if (boundary->largest_speed > 0.0) {
        MOR_TRY(context, MOR_NEW(context, &contact->base, 3 * n, "wall points at the start"));
    }
    if (contact->rotates && contact->normals != NULL) {
        MOR_TRY(context, MOR_NEW(context, &contact->base_normals, 3 * n, "normals of a wall at the start"));
    }
    return MOR_OK;
}

static mor_status copy_points(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request)
{
    int32_t *order = NULL;
    MOR_TRY(context, MOR_NEW(context, &order, request->n_points, "order of wall points"));
    mor_tree_order(request->points, 3, request->n_points, order);
    for (int64_t i = 0; i < request->n_points; ++i) {
        double *record = contact->boundary->records + RECORD * i;
        memcpy(record + MOR_BOUNDARY_POSITION, request->points + 3 * (int64_t)order[i], 3 * sizeof *record);
        record[MOR_BOUNDARY_VOLUME] =
            request->point_volume * (request->shares != NULL ? request->shares[order[i]] : 1.0);
        memcpy(record + MOR_BOUNDARY_VELOCITY, request->velocity, 3 * sizeof *record);
        if (contact->normals != NULL) {
            memcpy(contact->normals + 3 * i, request->normals + 3 * (int64_t)order[i], 3 * sizeof *record);
            contact->depths[i] = request->depths[order[i]];
        }
        if (contact->base_normals != NULL) {
            memcpy(contact->base_normals + 3 * i, contact->normals + 3 * i, 3 * sizeof *record);
        }
        if (contact->base != NULL) {
            memcpy(contact->base + 3 * i, record + MOR_BOUNDARY_POSITION, 3 * sizeof *record);
        }
    }
    if (contact->period != NULL) {
        mor_period_round_places(contact->period, request->n_points, RECORD, contact->boundary->records);
    }
    MOR_FREE(context, &order);
    return MOR_OK;
}

mor_status mor_soil_contact_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request,
                                 const mor_period *period, int64_t n_soil_clusters)
{
    memset(contact, 0, sizeof *contact);
    contact->period = period != NULL && period->is_any ? period : NULL;
    strncpy(contact->name, request->name, sizeof contact->name - 1);
    contact->n_points = request->source != NULL ? 0 : request->n_points;
    contact->is_wall = true;
    contact->stress = request->stress;
    contact->dimension = request->dimension;
    memcpy(contact->velocity, request->velocity, sizeof contact->velocity);
    mor_status status = make_wall(context, contact, request);
    if (status == MOR_OK) {
        status = request->source != NULL ? mor_wall_blocks_init(context, contact, request)
                                         : copy_points(context, contact, request);
    }
    if (status == MOR_OK) {
        status = prepare_contact(context, contact, n_soil_clusters);
    }
    if (status != MOR_OK) {
        mor_soil_contact_clear(context, contact);
    }
    return status;
}

/* Patches follow one another without gaps and cover all points. */
static mor_status check_patches(mor_context *context, const mor_boundary *boundary)
{
    int64_t next = 0;
    for (int p = 0; p < boundary->n_patches; ++p) {
        const mor_boundary_patch *patch = &boundary->patches[p];
        MOR_CHECK(context, patch->first == next && patch->n_points >= 0, MOR_ERROR_ARGUMENT,
                  "patch %d of boundary '%s' has points %lld to %lld; patches must follow one another without gaps, so "
                  "it must begin at %lld",
                  p, boundary->name, (long long)patch->first, (long long)(patch->first + patch->n_points - 1),
                  (long long)next);
        MOR_CHECK(context, patch->friction != MOR_WALL_COULOMB || patch->friction_coefficient >= 0.0,
                  MOR_ERROR_ARGUMENT, "patch %d of boundary '%s' has friction coefficient %g; it must not be negative",
                  p, boundary->name, patch->friction_coefficient);
        next += patch->n_points;
    }
    MOR_CHECK(context, next == boundary->n_points, MOR_ERROR_ARGUMENT,
              "the patches of boundary '%s' hold %lld points, the boundary %lld; the numbers must agree",
              boundary->name, (long long)next, (long long)boundary->n_points);
    return MOR_OK;
}

mor_status mor_soil_contact_check_frictions(mor_context *context, const mor_soil_contact *contact, int n_regions)
{
    for (int p = 0; p < contact->boundary->n_patches; ++p) {
        const mor_boundary_friction *of_soil = contact->boundary->patches[p].friction_of_soil;
        for (int k = 0; k < n_regions && of_soil != NULL; ++k) {
            MOR_CHECK(context, of_soil[k].kind != MOR_WALL_COULOMB || of_soil[k].coefficient >= 0.0, MOR_ERROR_ARGUMENT,
                      "patch %d of boundary '%s': found a friction coefficient of %g with soil %d; allowed are numbers "
                      ">= 0; correct entry %d of its friction_of_soil",
                      p, contact->name, of_soil[k].coefficient, k, k);
        }
    }
    return MOR_OK;
}

mor_status mor_soil_contact_borrow(mor_context *context, mor_soil_contact *contact, mor_boundary *boundary,
                                   mor_wall_stress stress, int dimension, int64_t n_soil_clusters)
{
    memset(contact, 0, sizeof *contact);
    MOR_TRY(context, check_patches(context, boundary));
    memcpy(contact->name, boundary->name, sizeof contact->name);
    contact->n_points = boundary->n_points;
    contact->boundary = boundary;
    contact->normals = boundary->normals;
    contact->depths = boundary->depths;
    contact->stress = stress;
    contact->dimension = dimension;
    const mor_status status = prepare_contact(context, contact, n_soil_clusters);
    if (status != MOR_OK) {
        mor_soil_contact_clear(context, contact);
    }
    return status;
}

static void free_slots(mor_context *context, mor_soil_contact *contact)
{
    contact->capacity = 0;
    MOR_FREE(context, &contact->slots);
    MOR_FREE(context, &contact->patch_slots);
    MOR_FREE(context, &contact->mean_velocity);
    MOR_FREE(context, &contact->seen_faces);
    MOR_FREE(context, &contact->hold);
    MOR_FREE(context, &contact->transfer);
    MOR_FREE(context, &contact->sums);
    MOR_FREE(context, &contact->stick);
    MOR_FREE(context, &contact->closure);
    MOR_FREE(context, &contact->acceleration);
    MOR_FREE(context, &contact->divergence);
    MOR_FREE(context, &contact->given);
    MOR_FREE(context, &contact->repulsion);
    MOR_FREE(context, &contact->barrier_steps);
}

void mor_soil_contact_clear(mor_context *context, mor_soil_contact *contact)
{
    free_slots(context, contact);
    MOR_FREE(context, &contact->near);
    mor_wall_blocks_clear(context, contact);
    if (contact->is_wall && contact->boundary != NULL) {
        MOR_FREE(context, &contact->boundary->records);
        MOR_FREE(context, &contact->boundary->patches);
        MOR_FREE(context, &contact->boundary);
        MOR_FREE(context, &contact->normals);
        MOR_FREE(context, &contact->depths);
    }
    MOR_FREE(context, &contact->base);
    MOR_FREE(context, &contact->base_normals);
    MOR_FREE(context, &contact->built);
    MOR_FREE(context, &contact->ranges);
    MOR_FREE(context, &contact->farthest);
    MOR_FREE(context, &contact->first_slot);
    MOR_FREE(context, &contact->first_of_patch);
    mor_images_clear(context, &contact->images);
    mor_tree_clear(context, &contact->tree);
    mor_relation_clear(context, &contact->relation);
    memset(contact, 0, sizeof *contact);
}

static void translate_points(mor_soil_contact *contact, const double *displacement)
{
    for (int64_t i = 0; i < contact->n_points; ++i) {
        for (int a = 0; a < 3; ++a) {
            contact->boundary->records[RECORD * i + a] = contact->base[3 * i + a] + displacement[a];
        }
    }
}

static void pose_points(mor_soil_contact *contact, const mor_pose *pose)
{
    for (int64_t i = 0; i < contact->n_points; ++i) {
        double *record = contact->boundary->records + RECORD * i;
        mor_pose_place(pose, contact->base + 3 * i, record + MOR_BOUNDARY_POSITION);
        mor_pose_velocity(pose, record + MOR_BOUNDARY_POSITION, record + MOR_BOUNDARY_VELOCITY);
        if (contact->base_normals != NULL) {
            mor_matrix_apply(pose->rotation, contact->base_normals + 3 * i, contact->normals + 3 * i);
        }
    }
}

void mor_soil_contact_move(mor_context *context, mor_soil_contact *contact, double time)
{
    contact->boundary->patches[0].is_removed = contact->removed_at > 0.0 && time >= contact->removed_at;
    if (contact->blocks != NULL) {
        contact->blocks->moved_to = time;
    }
    if (contact->motion != NULL && contact->base != NULL) {
        mor_pose pose;
        mor_motion_find(contact->motion, time, &pose);
        memcpy(contact->velocity, pose.velocity, sizeof contact->velocity);
        pose_points(contact, &pose);
    } else if (mor_vector_length(contact->velocity) > 0.0) {
        const double displacement[3] = {time * contact->velocity[0], time * contact->velocity[1],
                                        time * contact->velocity[2]};
        translate_points(contact, displacement);
    }
    if (contact->period != NULL && contact->base != NULL) {
        mor_soil_contact_approach_lists(context, contact);
    }
}

double mor_soil_contact_speed(const mor_soil_contact *contact)
{
    return contact->is_wall && contact->motion == NULL ? mor_vector_length(contact->velocity)
                                                       : contact->boundary->largest_speed;
}

/* Patches that are not there any more, 1. */
static int count_removed(const mor_boundary *boundary)
{
    int n_removed = 0;
    for (int p = 0; p < boundary->n_patches; ++p) {
        n_removed += boundary->patches[p].is_removed;
    }
    return n_removed;
}

bool mor_soil_contact_is_stale(const mor_soil_contact *contact)
{
    return count_removed(contact->boundary) != contact->n_removed;
}

static void find_farthest(void *job, int64_t first, int64_t last, double *values)
{
    const mor_soil_contact *contact = job;
    const double *records = contact->boundary->records;
    for (int64_t i = first; i < last; ++i) {
        double translation[3];
        for (int a = 0; a < 3; ++a) {
            translation[a] = records[RECORD * i + a] - contact->built[3 * i + a];
        }
        values[0] = mor_larger(values[0], mor_vector_dot(translation, translation));
    }
}

mor_status mor_soil_contact_check_lists(mor_context *context, const mor_soil_contact *contact,
                                        const mor_relation_check *soil, int64_t cluster)
{
    mor_relation_check check = *soil;
    check.relation = &contact->relation;
    check.target = (mor_relation_points){&contact->tree, contact->boundary->records, RECORD};
    check.target_name = contact->name;
    return contact->n_removed > 0 ? MOR_OK : mor_relation_check_cluster(context, &check, cluster);
}

double mor_soil_contact_drift(mor_context *context, mor_soil_contact *contact)
{
    const mor_blocks blocks = {.n_items = contact->n_points, .block_items = MOR_BLOCK, .grain = 1};
    double farthest = 0.0;
    if (contact->built == NULL) {
        return 0.0;
    }
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_LARGEST, 1, find_farthest, contact, contact->farthest,
               &farthest);
    return mor_larger(sqrt(farthest), mor_wall_blocks_drift(contact));
}

bool mor_soil_contact_lists_hold(mor_context *context, const mor_soil_contact *contact, const mor_skin_side *soil,
                                 double displacement, double support, double reach)
{
    const mor_skin_side own = {.tree = &contact->tree,
                               .records = contact->boundary->records,
                               .stride = RECORD,
                               .built = contact->built,
                               .ranges = contact->ranges,
                               .displacement = displacement};
    if (contact->n_removed == contact->boundary->n_patches) {
        return true;
    }
    mor_skin_measure(context, &own);
    return mor_skin_holds(context, soil, &own, support, reach) &&
           mor_wall_blocks_hold(context, contact, soil, displacement, support, reach);
}

/* The patch of a point. */
static int find_patch(const mor_boundary *boundary, int64_t point)
{
    int first = 0;
    int last = boundary->n_patches;
    while (last - first > 1) {
        const int middle = first + (last - first) / 2;
        if (boundary->patches[middle].first <= point) {
            first = middle;
        } else {
            last = middle;
        }
    }
    return first;
}

/* Makes room for a short list beside each list. */
static mor_status grow_near(mor_context *context, mor_soil_contact *contact)
{
    const int64_t needed = contact->relation.n_entries;
    if (needed > contact->near_room) {
        MOR_FREE(context, &contact->near);
        contact->near_room = 0;
        MOR_TRY(context, MOR_NEW(context, &contact->near, needed + needed / 4, "short lists of slots"));
        contact->near_room = needed + needed / 4;
    }
    return MOR_OK;
}

/* Cuts the lists into runs of one patch each; returns how many there are, of which at most capacity are kept. */
static int64_t cut_lists(mor_soil_contact *contact)
{
    const mor_relation *relation = &contact->relation;
    int32_t *near = contact->near;
    int64_t n_slots = 0;
    for (int64_t place = 0; place < relation->n_occupied; ++place) {
        const int32_t cluster = relation->occupied[place];
        const int32_t *list = mor_relation_entries(relation, cluster);
        const int32_t count = relation->counts[cluster];
        contact->first_slot[place] = (int32_t)n_slots;
        for (int32_t k = 0; k < count; ++n_slots) {
            const int patch = find_patch(contact->boundary, list[k]);
            /* Images follow the last patch. */
            const int64_t end =
                patch + 1 < contact->boundary->n_patches ? contact->boundary->patches[patch + 1].first : INT64_MAX;
            const int32_t first = k;
            /* Usually all remaining points belong to one patch. */
            k = list[count - 1] < end ? count : k + 1;
            while (k < count && list[k] < end) {
                ++k;
            }
            if (contact->boundary->patches[patch].is_removed) {
                --n_slots;
            } else if (n_slots < contact->capacity) {
                contact->slots[n_slots] = (mor_pair_slot){.list = list + first,
                                                          .near = near + first,
                                                          .count = k - first,
                                                          .cluster = cluster,
                                                          .patch = patch};
            }
        }
        near += count;
    }
    contact->first_slot[relation->n_occupied] = (int32_t)n_slots;
    return n_slots;
}

static mor_status grow_slots(mor_context *context, mor_soil_contact *contact, int64_t needed)
{
    const int64_t capacity = needed + needed / 4;
    const int64_t n_lanes = capacity * MOR_CLUSTER;
    const int64_t n_borrowed = contact->is_wall ? 0 : n_lanes;
    const int64_t n_own_velocities = contact->is_wall && !contact->rotates ? 0 : n_lanes;
    const int64_t n_directed = contact->normals != NULL ? n_lanes : 0;
    const int64_t n_barrier = contact->barrier.is_on ? n_lanes : 0;
    const int64_t n_continued = contact->stress != MOR_WALL_STRESS_UNIFORM ? n_lanes : 0;
    free_slots(context, contact);
    MOR_TRY(context, MOR_NEW(context, &contact->slots, capacity, "slots"));
    MOR_TRY(context, MOR_NEW(context, &contact->patch_slots, capacity, "slots by patch"));
    MOR_TRY(context, MOR_NEW(context, &contact->sums, n_lanes * MOR_KERNEL_SUMS, "wall sums"));
    MOR_TRY(context, MOR_NEW(context, &contact->stick, n_lanes, "wall stick"));
    MOR_TRY(context, MOR_NEW(context, &contact->closure, n_lanes, "wall closure"));
    MOR_TRY(context, MOR_NEW(context, &contact->acceleration, n_lanes * 3, "boundary forces"));
    MOR_TRY(context, MOR_NEW(context, &contact->divergence, n_continued * 6, "stress divergence at walls"));
    MOR_TRY(context, MOR_NEW(context, &contact->mean_velocity, n_own_velocities * 3, "velocity of a boundary"));
    MOR_TRY(context, MOR_NEW(context, &contact->seen_faces, n_directed * MOR_FACE_SUMS, "faces of a wall"));
    MOR_TRY(context, MOR_NEW(context, &contact->hold, n_directed / MOR_CLUSTER, "faces of a wall"));
    MOR_TRY(context, MOR_NEW(context, &contact->transfer, n_directed * 3, "corners of a wall"));
    MOR_TRY(context, MOR_NEW(context, &contact->given, n_borrowed * MOR_SHARES, "force given to a boundary"));
    MOR_TRY(context, MOR_NEW(context, &contact->repulsion, n_barrier * 3, "barrier force"));
    MOR_TRY(context, MOR_NEW(context, &contact->barrier_steps, n_barrier / MOR_CLUSTER, "steps of the barrier"));
    contact->capacity = capacity;
    return MOR_OK;
}

/* Slots by patch, in their order. */
static void sort_slots(mor_soil_contact *contact)
{
    const int n_patches = contact->boundary->n_patches;
    int32_t *first = contact->first_of_patch;
    memset(first, 0, (size_t)(n_patches + 1) * sizeof *first);
    for (int64_t slot = 0; slot < contact->n_slots; ++slot) {
        first[contact->slots[slot].patch + 1] += 1;
    }
    for (int p = 0; p < n_patches; ++p) {
        first[p + 1] += first[p];
    }
    for (int64_t slot = 0; slot < contact->n_slots; ++slot) {
        contact->patch_slots[first[contact->slots[slot].patch]++] = (int32_t)slot;
    }
    /* Each start has become that of the next patch. */
    for (int p = n_patches; p > 0; --p) {
        first[p] = first[p - 1];
    }
    first[0] = 0;
}

int64_t mor_soil_contact_points(const mor_soil_contact *contact)
{
    return contact->blocks != NULL ? contact->blocks->n_points : contact->n_points;
}

const double *mor_soil_contact_start(const mor_soil_contact *contact, int *stride)
{
    *stride = contact->blocks != NULL ? 3 : RECORD;
    return contact->blocks != NULL ? contact->blocks->start : contact->boundary->records + MOR_BOUNDARY_POSITION;
}

void mor_soil_contact_forget_start(mor_context *context, mor_soil_contact *contact)
{
    if (contact->blocks != NULL) {
        MOR_FREE(context, &contact->blocks->start);
    }
}

mor_status mor_soil_contact_fill(mor_context *context, mor_soil_contact *contact, const mor_tree *soil, double reach)
{
    bool has_grown = false;
    MOR_TRY(context, mor_wall_blocks_fill(context, contact, soil, reach, &has_grown));
    if (has_grown && !isnan(contact->blocks->moved_to)) {
        mor_soil_contact_move(context, contact, contact->blocks->moved_to);
    }
    if (has_grown) {
        mor_tree_fit(&contact->tree, contact->boundary->records, RECORD);
    }
    return MOR_OK;
}

mor_status mor_soil_contact_build(mor_context *context, mor_soil_contact *contact, const mor_relation_points *soil,
                                  double reach)
{
    mor_boundary *boundary = contact->boundary;
    MOR_TRY(context, mor_soil_contact_fill(context, contact, soil->tree, reach));
    if (mor_images_are_used(&contact->images)) {
        MOR_TRY(context, mor_soil_contact_find_images(context, contact, soil, reach));
    }
    if (contact->blocks != NULL) {
        contact->blocks->built_at = contact->blocks->moved_to;
    }
    if (contact->built != NULL) {
        mor_tree_fit(&contact->tree, boundary->records, RECORD);
        for (int64_t i = 0; i < contact->n_points; ++i) {
            memcpy(contact->built + 3 * i, boundary->records + RECORD * i, 3 * sizeof *contact->built);
        }
    }
    const bool has_images = mor_images_are_used(&contact->images);
    const mor_relation_points points = has_images ? mor_images_targets(&contact->images)
                                                  : (mor_relation_points){&contact->tree, boundary->records, RECORD};
    MOR_TRY(context, mor_relation_build(context, &contact->relation, soil, &points, reach));
    if (has_images) {
        mor_images_sort(context, &contact->images, &contact->relation);
    }
    contact->n_removed = count_removed(boundary);
    MOR_TRY(context, grow_near(context, contact));
    const int64_t needed = cut_lists(contact);
    if (needed > contact->capacity) {
        MOR_TRY(context, grow_slots(context, contact, needed));
        cut_lists(contact);
    }
    contact->n_slots = needed;
    sort_slots(contact);
    /* Points out of reach get no force until the next build. */
    if (!contact->is_wall) {
        memset(boundary->force, 0, (size_t)(3 * contact->n_points) * sizeof *boundary->force);
    }
    for (int p = 0; p < boundary->n_patches; ++p) {
        memset(boundary->patches[p].force, 0, sizeof boundary->patches[p].force);
        memset(boundary->patches[p].moment, 0, sizeof boundary->patches[p].moment);
    }
    return MOR_OK;
}
