/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Order of the particles and lists of who sees whom: when they are made, and how long they hold. */
#include "core/sph/soil_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/reduce.h"
#include "core/particle/kernel.h"
#include "core/particle/skin.h"

#include <string.h>

static void sort_particles(mor_soil *soil, mor_view *view)
{
    int32_t *order = mor_view_write_shared(view, MOR_RESOURCE_ORDER, soil->order);
    mor_tree_order(mor_view_read(view, MOR_FIELD_POSITION), 3, soil->set.n_particles, order);
    mor_set_permute(&soil->set, order);
    mor_view_renew(view);
    mor_soil_forget_lists(soil);
}

void mor_soil_sort(mor_context *context, mor_soil *soil)
{
    mor_view view = mor_view_open(&soil->set, NULL);
    double *position = mor_view_write(&view, MOR_FIELD_POSITION);
    mor_period_round_places(&soil->period, soil->set.n_particles, 3, position);
    mor_images_put_inside(context, &soil->images, soil->set.n_particles, position, NULL);
    sort_particles(soil, &view);
}

/* What pair loops read of a particle among several soils; it changes with the order of the particles only. */
static void pack_soils(mor_context *context, const mor_soil *soil, const double *part)
{
    const int64_t n = soil->set.n_particles;
    for (int64_t i = 0; i < soil->tree.n_clusters * MOR_CLUSTER; ++i) {
        const int index = soil->kinds[(int)part[i < n ? i : n - 1]].same_as;
        double *of_soil = soil->of_soil + i * MOR_PAIR_OF_SOIL_SIZE;
        of_soil[MOR_PAIR_OF_SOIL_LIMITER] = 0.5 * soil->pair_soils[index].limiter_rate;
        of_soil[MOR_PAIR_OF_SOIL_INDEX] = index;
    }
    mor_images_follow(context, &soil->images, soil->of_soil, MOR_PAIR_OF_SOIL_SIZE, -1);
    MOR_PARALLEL_FOR (context, block, mor_block_count(soil->tree.n_clusters), 1) {
        mor_pair_find_one_soil(&soil->inner, soil->of_soil, block * MOR_BLOCK,
                               mor_block_end(block, soil->tree.n_clusters), soil->one_soil);
    }
}

mor_status mor_soil_allocate_places(mor_context *context, mor_soil *soil)
{
    MOR_TRY(context, mor_tree_init(context, &soil->boundary_tree, soil->tree.n_points));
    const bool is_shared = mor_soil_shares(soil);
    MOR_TRY(context,
            MOR_NEW(context, &soil->ranges, is_shared ? 0 : 6 * (2 * soil->tree.n_clusters - 1), "displacements"));
    double *ranges = is_shared ? soil->extra : soil->ranges;
    MOR_TRY(context, mor_skin_places_init(context, &soil->list_places, &soil->tree, ranges));
    return mor_skin_places_init(context, &soil->boundary_places, &soil->boundary_tree, ranges);
}

static mor_status build_lists(mor_context *context, mor_soil *soil, mor_view *view, mor_relation_points *points)
{
    const double *position = mor_view_read(view, MOR_FIELD_POSITION);
    mor_relation *inner = mor_view_write_shared(view, MOR_RESOURCE_LISTS, &soil->inner);
    MOR_TRY(context, mor_soil_build_inner(context, soil, position, mor_soil_reach(soil), points));
    inner->generation = soil->set.generation;
    const double *state[MOR_MATERIAL_STATES_MAX];
    mor_view_read_state(view, soil->state_fields, soil->material->n_state, state);
    if (soil->of_soil != NULL) {
        pack_soils(context, soil, state[0]);
    }
    if (soil->sleep.states != NULL) {
        MOR_TRY(context, mor_sleep_find_neighbors(context, &soil->sleep, inner));
    }
    mor_skin_places_keep(context, &soil->list_places, position);
    soil->has_lists = true;
    return MOR_OK;
}

/* Lists of walls and rocks, as particles at some points see them. */
static mor_status build_boundary_lists(mor_context *context, mor_soil *soil, mor_view *view,
                                       mor_relation_points *points)
{
    const double reach = mor_soil_reach(soil);
    const double *position = mor_view_read(view, MOR_FIELD_POSITION);
    const int n_regions = soil->settings.n_regions > 1 ? soil->settings.n_regions : 1;
    mor_view_write_shared(view, MOR_RESOURCE_LISTS, soil);
    mor_tree_resize(&soil->boundary_tree, points->tree->n_points);
    mor_tree_fit(&soil->boundary_tree, points->records, points->stride);
    points->tree = &soil->boundary_tree;
    mor_wall_clusters_begin(&soil->wall_clusters, soil->tree.n_clusters);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact *contact = mor_soil_contact_at(soil, k);
        MOR_TRY(context, mor_soil_contact_check_frictions(context, contact, n_regions));
        MOR_TRY(context, mor_soil_contact_build(context, contact, points, reach));
        contact->relation.generation = soil->set.generation;
        mor_wall_clusters_count(&soil->wall_clusters, contact);
    }
    MOR_TRY(context, mor_wall_clusters_end(context, &soil->wall_clusters, soil->tree.n_clusters));
    mor_skin_places_keep(context, &soil->boundary_places, position);
    soil->has_boundary_lists = true;
    return MOR_OK;
}

/* Motion since lists were built, smoothing lengths, beyond which places in single precision may be too far apart. */
#define FARTHEST 64.0

/* Whether no two particles that are not listed have come within the support. Behind periodic faces, where particles are
 * put back, bounds are all there is. */
static bool lists_hold(mor_context *context, const mor_soil *soil, const double *position, double support, double skin)
{
    const double drift = soil->list_places.drift;
    if (mor_skin_is_bounded(drift, drift, skin) || soil->period.is_any || drift > FARTHEST * soil->smoothing_length) {
        return mor_skin_is_bounded(drift, drift, skin);
    }
    const mor_skin_side own = mor_skin_places_measure(context, &soil->list_places, position);
    return mor_skin_holds(context, &own, &own, support, support + skin);
}

static bool boundary_lists_hold(mor_context *context, mor_soil *soil, const double *position, double support,
                                double skin)
{
    double displacements[MOR_SOIL_WALLS_MAX + MOR_SOIL_BOUNDARIES_MAX];
    double farthest = 0.0;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        displacements[k] = mor_soil_contact_drift(context, mor_soil_contact_at(soil, k));
        farthest = mor_larger(farthest, displacements[k]);
    }
    const bool is_bounded = mor_skin_is_bounded(soil->boundary_places.drift, farthest, skin);
    if (is_bounded || soil->period.is_any) {
        return is_bounded;
    }
    const mor_skin_side own = mor_skin_places_measure(context, &soil->boundary_places, position);
    bool do_hold = true;
    for (int k = 0; k < mor_soil_contact_count(soil) && do_hold; ++k) {
        do_hold = mor_soil_contact_lists_hold(context, mor_soil_contact_at(soil, k), &own, displacements[k], support,
                                              support + skin);
    }
    return do_hold;
}

/* In the checked build: that a cluster, another in each step, lists all that is near. Not through periodic faces. */
static mor_status check_lists(mor_context *context, mor_soil *soil, mor_relation_points own, const mor_step *step)
{
    if (!context->is_checked || soil->period.is_any || soil->tree.n_clusters == 0) {
        return MOR_OK;
    }
    const int64_t cluster = (int64_t)(step->number * 8191 % (uint64_t)soil->tree.n_clusters);
    const bool is_held = mor_sleep_is(soil->sleep.states, cluster, MOR_SLEEP_HELD); /* its lists are not read */
    const double support = is_held ? 0.0 : MOR_KERNEL_SUPPORT * soil->smoothing_length;
    const mor_relation_check check = {&soil->inner, own, own, soil->set.name, soil->set.name, support};
    mor_status status = mor_relation_check_cluster(context, &check, cluster);
    for (int k = 0; k < mor_soil_contact_count(soil) && status == MOR_OK; ++k) {
        status = mor_soil_contact_check_lists(context, mor_soil_contact_at(soil, k), &check, cluster);
    }
    return status;
}

mor_status mor_soil_find_neighbors(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const double support = MOR_KERNEL_SUPPORT * soil->smoothing_length;
    const double skin = soil->settings.scheme.skin_ratio * soil->settings.spacing;
    const double *position = mor_view_read(view, MOR_FIELD_POSITION);
    mor_relation_points points = {&soil->tree, position, 3};
    mor_view_write_shared(view, MOR_RESOURCE_BOUNDS, soil);
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    if (step->number > 0 && step->number % (uint64_t)soil->settings.scheme.sort_interval == 0) {
        sort_particles(soil, view);
        position = points.records = mor_view_read(view, MOR_FIELD_POSITION);
    }
    for (int k = 0; k < mor_soil_contact_count(soil) && soil->has_boundary_lists; ++k) {
        soil->has_boundary_lists = !mor_soil_contact_is_stale(mor_soil_contact_at(soil, k));
    }
    soil->has_lists = soil->has_lists && lists_hold(context, soil, position, support, skin);
    soil->has_boundary_lists = soil->has_boundary_lists && (soil->has_lists || !soil->period.is_any) &&
                               boundary_lists_hold(context, soil, position, support, skin);
    soil->has_lists = soil->has_lists && (soil->has_boundary_lists || !soil->period.is_any);
    const bool holds = soil->has_lists && soil->has_boundary_lists;
    if (!soil->has_lists) {
        MOR_TRY(context, build_lists(context, soil, view, &points));
        MOR_TRY(context, mor_soil_check_images(context, soil, false, step->time));
    }
    if (!soil->has_boundary_lists) {
        MOR_TRY(context, build_boundary_lists(context, soil, view, &points));
    }
    const bool is_done = holds || soil->sleep.states == NULL;
    return is_done ? check_lists(context, soil, points, step) : mor_soil_list_sleep_bodies(context, soil);
}
