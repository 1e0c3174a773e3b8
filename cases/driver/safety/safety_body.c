/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_body.h"

#include "cases/driver/safety/safety_parts.h"
#include "cases/driver/scene/soil_columns.h"
#include "core/base/math.h"
#include "core/base/memory.h"

/* Half of what moves most: inside a body that slides as a whole displacements hardly differ, outside they vanish. */
static const double usual_share = 0.5;

/* Particles nearer than this at the start are connected, spacings: across a diagonal, and where they are relaxed. What
 * is smaller than this share of the largest connected part is none: grains that rolled, chips of the surface. */
static const double connected = 1.5;
static const double small_share = 0.1;

static mor_status find_parts(mor_context *context, const mor_simulation *simulation,
                             const mor_safety_reference *reference, mor_safety_body *body)
{
    const mor_set *set = &simulation->soil.set;
    double rest = 0.0; /* compensated sum, in the order of the numbers */
    for (int64_t i = 0; i < set->n_particles; ++i) {
        body->is_part[set->id[i]] = mor_safety_displacement(reference, set, i) > body->limit;
        reference->values[set->id[i]] = set->data[MOR_FIELD_MASS][i] / set->data[MOR_FIELD_DENSITY][i];
    }
    if (!simulation->soil.period.is_any) { /* a part may go on beyond a face */
        MOR_TRY(context, mor_safety_parts_keep(context, reference->position, reference->n,
                                               connected * simulation->the_case->spacing, small_share, body->is_part));
    }
    for (int64_t id = 0; id < reference->n; ++id) {
        const double term = (body->is_part[id] ? reference->values[id] : 0.0) - rest;
        const double sum = body->volume + term;
        rest = (sum - body->volume) - term;
        body->volume = sum;
        body->n += body->is_part[id];
    }
    return MOR_OK;
}

/* The longest row of neighboring columns that begins and ends with one whose highest particle is part of the body, and
 * in between has none without such a particle: cells of the surface that moved less do not end it. Places are sorted by
 * column, from above. */
static bool find_row(const mor_safety_body *body, const mor_set *set, const mor_soil_place *places, int64_t *first,
                     int64_t *last)
{
    int64_t length = 0;
    int64_t begin = -1; /* the highest particle at its begin; -1: there is no row */
    int64_t end = 0;
    for (int64_t k = 0; k < set->n_particles; k = end) {
        const bool is_part = body->is_part[set->id[places[k].particle]];
        const bool is_beside = k == 0 || places[k].column == places[k - 1].column + 1;
        bool holds_part = false;
        for (end = k; end < set->n_particles && places[end].column == places[k].column; ++end) {
            holds_part = holds_part || body->is_part[set->id[places[end].particle]];
        }
        begin = begin >= 0 && is_beside && holds_part ? begin : is_part ? k : -1;
        if (is_part && places[k].column - places[begin].column + 1 > length) {
            length = places[k].column - places[begin].column + 1;
            *first = begin;
            *last = k;
        }
    }
    return length > 0;
}

static void tell_end(const mor_simulation *simulation, const mor_safety_reference *reference, int64_t particle,
                     double *end)
{
    const double *start = reference->position + 3 * simulation->soil.set.id[particle];
    double surface[3];
    double place[3];
    for (int a = 0; a < 3; ++a) {
        surface[a] = start[a] + 0.5 * simulation->the_case->spacing * simulation->up[a];
    }
    mor_simulation_take_point_back(simulation->the_case, surface, place);
    end[0] = place[0];
    end[1] = place[1];
}

static mor_status find_ends(mor_context *context, const mor_simulation *simulation,
                            const mor_safety_reference *reference, mor_safety_body *body)
{
    mor_soil_columns columns;
    mor_soil_place *places = NULL;
    int64_t row[2] = {0, 0};
    MOR_TRY(context, MOR_NEW(context, &places, simulation->soil.set.n_particles, "surface of a slope that failed"));
    mor_soil_columns_find(simulation, &columns);
    mor_soil_columns_sort(simulation, &columns, places);
    body->has_ends = find_row(body, &simulation->soil.set, places, &row[0], &row[1]);
    if (body->has_ends) {
        const int upper = places[row[0]].height > places[row[1]].height ? 0 : 1;
        tell_end(simulation, reference, places[row[upper]].particle, body->top);
        tell_end(simulation, reference, places[row[1 - upper]].particle, body->toe);
    }
    MOR_FREE(context, &places);
    return MOR_OK;
}

mor_status mor_safety_body_find(mor_context *context, const mor_simulation *simulation,
                                const mor_safety_reference *reference, double largest, mor_safety_body *body)
{
    *body =
        (mor_safety_body){.share = usual_share, .limit = usual_share * largest, .top = {NAN, NAN}, .toe = {NAN, NAN}};
    MOR_TRY(context, MOR_NEW(context, &body->is_part, reference->n, "the critical body"));
    const bool may_end = simulation->the_case->dimension == 2 && !simulation->soil.period.is_any;
    mor_status status = find_parts(context, simulation, reference, body);
    if (status == MOR_OK && may_end) {
        status = find_ends(context, simulation, reference, body);
    }
    if (status != MOR_OK) {
        mor_safety_body_clear(context, body);
    }
    return status;
}

void mor_safety_body_clear(mor_context *context, mor_safety_body *body)
{
    MOR_FREE(context, &body->is_part);
    *body = (mor_safety_body){.n = 0};
}
