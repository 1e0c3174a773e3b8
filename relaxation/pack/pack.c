/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/pack/pack_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_check.h"
#include "core/geometry/shape_moments.h"

#include <string.h>

static const int rocks_limit = 1000000;
static const int displacements_limit = 3; /* failed attempts before rocks are no longer displaced to make space */
static const int evaluations_limit = 500; /* for each rock placed, or for each of this many: then no more, either */
static const int evaluations_rocks = 64;
static const int fewest_share = 64;     /* of most_tries: what is drawn at least */
static const double cap_step = 0.9;     /* of the diameter: next size to try after one found no place */
static const double sure_points = 0.5;  /* of the resolution: distance between points on a surface */
static const double same_size = 1e-9;   /* relative difference of diameters that is rounding */
static const double share_slack = 1e-9; /* of the last share to 1 */
static const int cells_limit = 512;     /* along each axis */

/* State of the placement. */
typedef struct placing {
    int n_tries;     /* positions to draw for the next rock */
    int n_displaced; /* rocks displaced without success */
} placing;

void mor_pack_request_init(mor_pack_request *request)
{
    *request = (mor_pack_request){.dimension = 3, .region_volume = NAN, .most_tries = 20000, .seed = 1};
}

void mor_pack_clear(mor_context *context, mor_pack_result *result)
{
    MOR_FREE(context, &result->rocks);
    *result = (mor_pack_result){.n_rocks = 0};
}

static mor_status check_sizes(mor_context *context, const mor_pack_request *request)
{
    const int n = request->n_sizes;
    MOR_CHECK(context, n >= 1 && n <= MOR_PACK_SIZES_MAX, MOR_ERROR_ARGUMENT,
              "the size distribution has %d points: give 1 to %d", n, MOR_PACK_SIZES_MAX);
    for (int k = 0; k < n; ++k) {
        MOR_TRY(context, mor_shape_check_length(context, request->diameters[k], "a diameter of the size distribution"));
        MOR_CHECK(context, request->passing[k] >= 0.0 && request->passing[k] <= 1.0 + share_slack, MOR_ERROR_ARGUMENT,
                  "the share passing %g m is %g: give a number from 0 to 1", request->diameters[k],
                  request->passing[k]);
        MOR_CHECK(context,
                  k == 0 || (request->diameters[k] > request->diameters[k - 1] &&
                             request->passing[k] >= request->passing[k - 1]),
                  MOR_ERROR_ARGUMENT,
                  "the size distribution falls from (%g m, %g) to (%g m, %g): diameters and shares must rise",
                  request->diameters[k - 1], request->passing[k - 1], request->diameters[k], request->passing[k]);
    }
    MOR_CHECK(context, fabs(request->passing[n - 1] - 1.0) <= share_slack, MOR_ERROR_ARGUMENT,
              "the share passing the largest diameter, %g m, is %g: it must be 1", request->diameters[n - 1],
              request->passing[n - 1]);
    return MOR_OK;
}

static mor_status check_request(mor_context *context, const mor_pack_request *request)
{
    MOR_CHECK(context, request->dimension == 2 || request->dimension == 3, MOR_ERROR_ARGUMENT,
              "the dimension of the packing is %d: give 2 or 3", request->dimension);
    MOR_CHECK(context, request->region != NULL, MOR_ERROR_ARGUMENT, "the packing has no region: give a shape");
    MOR_CHECK(context, request->n_forms >= 1 && request->forms != NULL, MOR_ERROR_ARGUMENT,
              "the packing has no forms of rocks: give at least one");
    for (int k = 0; k < request->n_forms; ++k) {
        MOR_CHECK(context, request->forms[k] != NULL, MOR_ERROR_ARGUMENT, "form %d of %d is missing: give a shape",
                  k + 1, request->n_forms);
    }
    MOR_CHECK(context, request->count >= 0 && request->count <= rocks_limit, MOR_ERROR_ARGUMENT,
              "%d rocks are requested: give 1 to %d, or 0 and a content", request->count, rocks_limit);
    MOR_CHECK(context, request->count > 0 || (request->content > 0.0 && request->content < 1.0), MOR_ERROR_ARGUMENT,
              "the content of rocks is %g: give a number above 0 and below 1", request->content);
    MOR_CHECK(context, isfinite(request->gap) && request->gap >= 0.0, MOR_ERROR_ARGUMENT,
              "the gap between rocks is %g m: give a length of zero or more", request->gap);
    MOR_CHECK(context, isfinite(request->margin), MOR_ERROR_ARGUMENT,
              "the margin of the rocks to the surface is %g m: give a finite length", request->margin);
    MOR_TRY(context, mor_shape_check_length(context, request->resolution, "the resolution of the packing"));
    MOR_CHECK(context, request->most_tries >= 1, MOR_ERROR_ARGUMENT,
              "%d positions are to be tried for a rock: give at least 1", request->most_tries);
    MOR_TRY(context, check_sizes(context, request));
    return MOR_OK;
}

/* Volume (area) of a rock. */
static double rock_volume(int dimension, double diameter)
{
    return dimension == 2 ? 0.25 * MOR_PI * diameter * diameter : MOR_PI / 6.0 * diameter * diameter * diameter;
}

/* Diameter up to which rocks have a given share of the volume. */
static double invert_curve(const mor_pack_request *request, double share)
{
    const double *passing = request->passing;
    if (share <= passing[0]) {
        return request->diameters[0];
    }
    for (int k = 1; k < request->n_sizes; ++k) {
        if (share < passing[k]) {
            const double place = (share - passing[k - 1]) / (passing[k] - passing[k - 1]);
            return request->diameters[k - 1] + place * (request->diameters[k] - request->diameters[k - 1]);
        }
    }
    return request->diameters[request->n_sizes - 1];
}

/* Diameter of the next rock, from the size distribution at `placed` of `target` plus half of that rock. */
static double choose_diameter(const mor_pack_request *request, double placed, double target)
{
    double low = request->diameters[0];
    double high = request->diameters[request->n_sizes - 1];
    for (int step = 0; step < 60 && low < high; ++step) {
        const double middle = 0.5 * (low + high);
        const double share = 1.0 - (placed + 0.5 * rock_volume(request->dimension, middle)) / target;
        if (invert_curve(request, share) > middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/* How many rocks of the size distribution fill a volume, to one more than `most`. */
static int count_rocks(const mor_pack_request *request, double target, int most)
{
    double placed = 0.0;
    int n = 0;
    for (; n <= most; ++n) {
        const double volume = rock_volume(request->dimension, choose_diameter(request, placed, target));
        if (placed + 0.5 * volume > target) {
            break;
        }
        placed += volume;
    }
    return n;
}

/* The least volume that at least so many rocks of the curve make up. */
static double find_target(const mor_pack_request *request, int count)
{
    double low = 0.0;
    double high = 2.0 * count * rock_volume(request->dimension, request->diameters[request->n_sizes - 1]);
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        if (count_rocks(request, middle, count) >= count) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

static void clear_state(mor_pack_state *state)
{
    mor_context *context = state->context;
    for (int k = 0; k < state->request->n_forms && state->forms != NULL; ++k) {
        MOR_FREE(context, &state->forms[k].points);
        MOR_FREE(context, &state->forms[k].blocks);
    }
    MOR_FREE(context, &state->forms);
    MOR_FREE(context, &state->items);
    MOR_FREE(context, &state->heads);
    MOR_FREE(context, &state->next);
    MOR_FREE(context, &state->kept);
    MOR_FREE(context, &state->is_awake);
}

static mor_status set_bounds(mor_context *context, mor_pack_state *state)
{
    const mor_pack_request *request = state->request;
    const double outward = fmax(0.0, -request->margin);
    mor_shape_bounds(request->region, &state->bounds);
    for (int a = 0; a < 3; ++a) {
        if (a >= request->dimension) {
            state->bounds.minimum[a] = state->bounds.maximum[a] = 0.0;
            continue;
        }
        MOR_CHECK(context, isfinite(state->bounds.minimum[a]) && isfinite(state->bounds.maximum[a]), MOR_ERROR_ARGUMENT,
                  "the region of the packing (%s) is unbounded along %c: bound it", request->region->operations->kind,
                  'x' + a);
        state->bounds.minimum[a] -= outward;
        state->bounds.maximum[a] += outward;
    }
    return MOR_OK;
}

static mor_status sample_forms(mor_context *context, mor_pack_state *state, double largest)
{
    const mor_pack_request *request = state->request;
    const double spacing = sure_points * request->resolution / largest;
    MOR_TRY(context, MOR_NEW(context, &state->forms, request->n_forms, "forms of rocks"));
    for (int k = 0; k < request->n_forms; ++k) {
        MOR_TRY(context,
                mor_pack_form_sample(context, request->forms[k], request->dimension, spacing, state->forms + k));
    }
    return MOR_OK;
}

static mor_status prepare(mor_context *context, mor_pack_state *state, double target)
{
    const mor_pack_request *request = state->request;
    const double largest = request->diameters[request->n_sizes - 1];
    const double most =
        request->count > 0 ? request->count : target / rock_volume(request->dimension, request->diameters[0]) + 2.0;
    MOR_CHECK(context, most <= rocks_limit, MOR_ERROR_ARGUMENT,
              "up to %.0f rocks are requested, more than %d: raise the smallest diameter, %g m", most, rocks_limit,
              request->diameters[0]);
    MOR_TRY(context, sample_forms(context, state, largest));
    double reach = 0.0;
    for (int k = 0; k < request->n_forms; ++k) {
        reach = fmax(reach, state->forms[k].reach);
    }
    /* Between points a surface is not looked at: half of their distance keeps rocks without a gap apart. */
    state->least_gap = fmax(request->gap, sure_points * request->resolution);
    state->cell = 2.0 * reach * largest + state->least_gap;
    for (int a = 0; a < 3; ++a) {
        const double extent = state->bounds.maximum[a] - state->bounds.minimum[a];
        state->cell = fmax(state->cell, extent / cells_limit);
    }
    int64_t n_cells = 1;
    for (int a = 0; a < 3; ++a) {
        const double extent = state->bounds.maximum[a] - state->bounds.minimum[a];
        state->n_cells[a] = 1 + (int)(extent / state->cell);
        n_cells *= state->n_cells[a];
    }
    state->n_items_max = (int)most;
    MOR_TRY(context, MOR_NEW(context, &state->items, state->n_items_max, "rocks"));
    MOR_TRY(context, MOR_NEW(context, &state->heads, n_cells, "cells of rocks"));
    MOR_TRY(context, MOR_NEW(context, &state->next, state->n_items_max, "lists of rocks"));
    MOR_TRY(context, MOR_NEW(context, &state->kept, state->n_items_max, "rocks to go back to"));
    MOR_TRY(context, MOR_NEW(context, &state->is_awake, 2 * (int64_t)state->n_items_max, "rocks that move"));
    mor_pack_list(state);
    return MOR_OK;
}

/* Whether displacing is still worthwhile: where it takes long for each rock there is hardly any space left. */
static bool can_displace(const mor_pack_state *state, const placing *work)
{
    const int64_t n_rocks = state->n_items > evaluations_rocks ? state->n_items : evaluations_rocks;
    return work->n_displaced < displacements_limit && state->n_evaluations < evaluations_limit * n_rocks;
}

/* Places a rock at random, or by displacing others. Where free positions are rare fewer are drawn the next time. */
static bool place_rock(mor_pack_state *state, int n_before, placing *work, mor_pack_item *item)
{
    const int most = state->request->most_tries;
    if (mor_pack_drop(state, n_before, work->n_tries, item)) {
        work->n_tries = work->n_tries < most / 2 ? 2 * work->n_tries : most;
        state->items[state->n_items] = *item;
        mor_pack_list_item(state, state->n_items++);
        return true;
    }
    work->n_tries = work->n_tries > most / fewest_share ? (work->n_tries + 1) / 2 : work->n_tries;
    if (can_displace(state, work) && mor_pack_displace(state, n_before, item)) {
        return true;
    }
    work->n_displaced += 1;
    return false;
}

/* Places rocks from the largest to the smallest; returns the number without a position, and their largest diameter. */
static int place_rocks(mor_pack_state *state, double target, double *largest_given_up)
{
    const mor_pack_request *request = state->request;
    const double smallest = request->diameters[0];
    placing work = {.n_tries = request->most_tries};
    double cap = request->diameters[request->n_sizes - 1];
    double placed = 0.0;
    int n_given_up = 0;
    for (int n_before = 0; state->n_items < state->n_items_max; ++n_before) {
        mor_pack_item item = {.diameter = fmin(cap, choose_diameter(request, placed, target))};
        const double volume = rock_volume(request->dimension, item.diameter);
        if (placed + 0.5 * volume > target) {
            break;
        }
        if (place_rock(state, n_before, &work, &item)) {
            placed += volume;
            continue;
        }
        *largest_given_up = fmax(*largest_given_up, item.diameter);
        if (item.diameter > smallest * (1.0 + same_size)) {
            n_given_up += 1;
            cap = fmax(smallest, cap_step * item.diameter);
        } else {
            return n_given_up + (int)fmax(1.0, floor((target - placed) / volume + 0.5));
        }
    }
    return n_given_up;
}

/* Places a number of rocks of the curve; rocks without a position are not replaced by others. Returns their number. */
static int place_count(mor_pack_state *state, double target, double *largest_given_up)
{
    const mor_pack_request *request = state->request;
    placing work = {.n_tries = request->most_tries};
    double drawn = 0.0;
    int n_given_up = 0;
    for (int n_before = 0; n_before < request->count; ++n_before) {
        mor_pack_item item = {.diameter = choose_diameter(request, drawn, target)};
        drawn += rock_volume(request->dimension, item.diameter);
        if (!place_rock(state, n_before, &work, &item)) {
            *largest_given_up = fmax(*largest_given_up, item.diameter);
            n_given_up += 1;
        }
    }
    return n_given_up;
}

/* Finds the smallest gap so far of a rock to those before it. */
typedef struct gap_work {
    int self;
    mor_pack_contact contact;
} gap_work;

static bool note_gap(void *user, const mor_pack_state *state, const mor_pack_item *item, int index)
{
    gap_work *work = user;
    const mor_pack_item *other = state->items + index;
    const double offset[3] = {item->position[0] - other->position[0], item->position[1] - other->position[1],
                              item->position[2] - other->position[2]};
    const double reaches =
        state->forms[item->form].reach * item->diameter + state->forms[other->form].reach * other->diameter;
    if (index < work->self && mor_vector_length(offset) - reaches < work->contact.gap) {
        mor_pack_probe(state, item, other, -INFINITY, &work->contact);
        mor_pack_probe(state, other, item, -INFINITY, &work->contact);
    }
    return true;
}

static double find_smallest_gap(const mor_pack_state *state)
{
    gap_work work = {.contact = {.gap = INFINITY}};
    if (state->n_items < 2) {
        return INFINITY;
    }
    /* No two that are not visited are nearer than `within`. */
    for (double within = 2.0 * state->least_gap; !(work.contact.gap <= within); within *= 2.0) {
        for (work.self = 0; work.self < state->n_items; ++work.self) {
            (void)mor_pack_visit(state, state->items + work.self, within, note_gap, &work);
        }
    }
    return work.contact.gap;
}

static void write_rock(const mor_pack_item *item, int dimension, mor_pack_rock *rock)
{
    const double sine = mor_vector_length(item->spin + 1);
    *rock = (mor_pack_rock){.form = item->form, .diameter = item->diameter, .axis = {0.0, 0.0, 1.0}};
    memcpy(rock->position, item->position, sizeof rock->position);
    if (dimension == 2) {
        rock->angle = 2.0 * atan2(item->spin[3], item->spin[0]);
    } else if (sine > 0.0) {
        rock->angle = 2.0 * atan2(sine, item->spin[0]);
        for (int a = 0; a < 3; ++a) {
            rock->axis[a] = item->spin[1 + a] / sine;
        }
    }
}

static mor_status write_result(mor_context *context, const mor_pack_state *state, double region_volume,
                               mor_pack_result *result)
{
    const mor_pack_request *request = state->request;
    double total = 0.0;
    MOR_TRY(context, MOR_NEW(context, &result->rocks, state->n_items, "packed rocks"));
    for (int i = 0; i < state->n_items; ++i) {
        const double volume = rock_volume(request->dimension, state->items[i].diameter);
        write_rock(state->items + i, request->dimension, result->rocks + i);
        total += volume;
        for (int k = 0; k < request->n_sizes; ++k) {
            if (state->items[i].diameter <= request->diameters[k] * (1.0 + same_size)) {
                result->passing[k] += volume;
            }
        }
    }
    for (int k = 0; k < request->n_sizes && total > 0.0; ++k) {
        result->passing[k] /= total;
    }
    result->n_rocks = state->n_items;
    result->content = total / region_volume;
    result->smallest_gap = find_smallest_gap(state);
    const double largest = result->n_rocks > 0 ? result->rocks[0].diameter : 0.0;
    if (largest > 0.0 && result->largest_given_up > largest * (1.0 + same_size)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "no rock larger than %.4g m found a position; the size distribution asks for some of %.4g m: "
                        "sizes above are cut off; enlarge the region, lower margin or gap, or ask for smaller rocks",
                        largest, result->largest_given_up);
    }
    if (result->n_given_up > 0 && request->count == 0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "rocks fill %.2f %% of their region, %.2f %% was requested: no position was found for %d "
                        "of them; use a smaller content, gap or margin, or add smaller rocks to the size distribution",
                        100.0 * result->content, 100.0 * request->content, result->n_given_up);
    }
    return MOR_OK;
}

static mor_status find_region_volume(mor_context *context, const mor_pack_request *request, double *volume)
{
    *volume = request->region_volume;
    if (isnan(*volume)) {
        mor_shape_moments moments;
        MOR_TRY(context, mor_shape_find_moments(context, request->region, request->dimension, &moments));
        *volume = moments.volume;
    }
    MOR_CHECK(context, isfinite(*volume) && *volume > 0.0, MOR_ERROR_ARGUMENT,
              "the volume of the packing's region is %g %s: give a number above zero, or NaN for a bounded shape",
              *volume, request->dimension == 2 ? "m2" : "m3");
    return MOR_OK;
}

mor_status mor_pack(mor_context *context, const mor_pack_request *request, mor_pack_result *result)
{
    *result = (mor_pack_result){.n_rocks = 0};
    MOR_TRY(context, check_request(context, request));
    mor_pack_state state = {.context = context, .request = request};
    MOR_TRY(context, set_bounds(context, &state));
    double region_volume = 0.0;
    MOR_TRY(context, find_region_volume(context, request, &region_volume));
    const double target = request->count > 0 ? find_target(request, request->count) : request->content * region_volume;
    mor_status status = prepare(context, &state, target);
    if (status == MOR_OK) {
        result->n_given_up = request->count > 0 ? place_count(&state, target, &result->largest_given_up)
                                                : place_rocks(&state, target, &result->largest_given_up);
        status = write_result(context, &state, region_volume, result);
    }
    clear_state(&state);
    if (status != MOR_OK) {
        mor_pack_clear(context, result);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}
