/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/pack/pack_internal.h"

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"

static const double normal_step = 1e-3; /* of differences, relative to the size of a rock */

enum purpose {
    FORM_PURPOSE = 0x5041434B, /* keeps these numbers apart from other uses of the seed */
    PLACE_PURPOSE,
    TURN_PURPOSE = PLACE_PURPOSE + 3
};

void mor_pack_item_rotate(mor_pack_item *item)
{
    double length = 0.0;
    for (int k = 0; k < 4; ++k) {
        length += item->spin[k] * item->spin[k];
    }
    length = sqrt(length);
    for (int k = 0; k < 4; ++k) {
        item->spin[k] /= length;
    }
    const double w = item->spin[0];
    const double x = item->spin[1];
    const double y = item->spin[2];
    const double z = item->spin[3];
    const double rotation[9] = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z),       2.0 * (x * z + w * y),
                                2.0 * (x * y + w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
                                2.0 * (x * z - w * y),       2.0 * (y * z + w * x),       1.0 - 2.0 * (x * x + y * y)};
    for (int k = 0; k < 9; ++k) {
        item->rotation[k] = rotation[k];
    }
}

void mor_pack_draw(const mor_pack_state *state, uint64_t id, mor_pack_item *item)
{
    const mor_pack_request *request = state->request;
    const uint64_t seed = request->seed;
    double u[3];
    item->form = (int)(mor_random_uniform(seed, id, FORM_PURPOSE) * request->n_forms);
    for (uint64_t a = 0; a < 3; ++a) {
        const double low = state->bounds.minimum[a];
        const double high = state->bounds.maximum[a];
        item->position[a] = low + mor_random_uniform(seed, id, PLACE_PURPOSE + a) * (high - low);
        u[a] = mor_random_uniform(seed, id, TURN_PURPOSE + a);
    }
    if (request->dimension == 2) {
        item->spin[0] = cos(MOR_PI * u[0]);
        item->spin[1] = item->spin[2] = 0.0;
        item->spin[3] = sin(MOR_PI * u[0]);
    } else { /* uniform random rotations (Shoemake 1992) */
        item->spin[0] = sqrt(u[0]) * cos(2.0 * MOR_PI * u[2]);
        item->spin[1] = sqrt(1.0 - u[0]) * sin(2.0 * MOR_PI * u[1]);
        item->spin[2] = sqrt(1.0 - u[0]) * cos(2.0 * MOR_PI * u[1]);
        item->spin[3] = sqrt(u[0]) * sin(2.0 * MOR_PI * u[2]);
    }
    mor_pack_item_rotate(item);
}

static void place_point(const mor_pack_item *item, const double *local, double *point)
{
    mor_matrix_apply(item->rotation, local, point);
    for (int a = 0; a < 3; ++a) {
        point[a] = item->position[a] + item->diameter * point[a];
    }
}

static double find_offset(const mor_pack_item *item, const double *point, double *offset)
{
    for (int a = 0; a < 3; ++a) {
        offset[a] = point[a] - item->position[a];
    }
    return mor_vector_length(offset);
}

/* An object with a distance at any point: another rock, or a shape inside or outside of which rocks must be. */
typedef struct probe_target {
    const mor_pack_state *state;
    const mor_pack_item *other; /* NULL: the shape */
    const mor_shape *shape;
    double sign;
} probe_target;

/* Distance of a point; local receives it in the frame of the other rock. */
static double find_distance(const probe_target *target, const double *point, double *local)
{
    if (target->other == NULL) {
        return target->sign * mor_shape_distance(target->shape, point);
    }
    double offset[3];
    find_offset(target->other, point, offset);
    mor_matrix_apply_transposed(target->other->rotation, offset, local);
    for (int a = 0; a < 3; ++a) {
        local[a] /= target->other->diameter;
    }
    return target->other->diameter * mor_shape_distance(target->shape, local);
}

static void find_normal(const probe_target *target, const mor_pack_item *owner, const double *nearest,
                        mor_pack_contact *contact)
{
    double normal[3];
    if (target->other != NULL) {
        mor_shape_normal(target->shape, nearest, normal_step, normal);
        mor_matrix_apply(target->other->rotation, normal, contact->normal);
        return;
    }
    mor_shape_normal(target->shape, contact->point, normal_step * owner->diameter, normal);
    for (int a = 0; a < 3; ++a) {
        contact->normal[a] = target->sign * normal[a];
    }
}

/* Whether a point is farther than a gap from the ball that holds the other rock. */
static bool is_out_of_reach(const probe_target *target, const double *point, double gap)
{
    double offset[3];
    return target->other != NULL && find_offset(target->other, point, offset) -
                                            target->state->forms[target->other->form].reach * target->other->diameter >=
                                        gap;
}

/* Whether a point of a form is so near to the last one tested, whose distance is known, that it cannot be nearer than a
 * gap. */
static bool is_surely_far(const double *point, const double *last, double diameter, double distance, double gap)
{
    const double way[3] = {point[0] - last[0], point[1] - last[1], point[2] - last[2]};
    return distance - MOR_SHAPE_SLOPE_MOST * diameter * mor_vector_length(way) >= gap;
}

/* Tests the points of a rock, skipping blocks that are certainly far. */
static bool probe(const probe_target *target, const mor_pack_item *owner, double enough, mor_pack_contact *contact)
{
    const mor_pack_form *form = target->state->forms + owner->form;
    double nearest[3] = {0.0};
    double local[3] = {0.0};
    double point[3];
    const double *last = NULL; /* tested last, and its distance */
    double distance = 0.0;
    bool is_found = false;
    for (int64_t i = 0; i < form->n_points; ++i) {
        const double *source = form->points + 3 * i;
        if (i % MOR_PACK_BLOCK == 0) {
            last = form->blocks + 4 * (i / MOR_PACK_BLOCK);
            place_point(owner, last, point);
            distance = is_out_of_reach(target, point, contact->gap + MOR_SHAPE_SLOPE_MOST * owner->diameter * last[3])
                           ? INFINITY
                           : find_distance(target, point, local);
            if (distance - MOR_SHAPE_SLOPE_MOST * owner->diameter * last[3] >= contact->gap) {
                i += MOR_PACK_BLOCK - 1;
                continue;
            }
        }
        if (is_surely_far(source, last, owner->diameter, distance, contact->gap)) {
            continue;
        }
        place_point(owner, source, point);
        if (is_out_of_reach(target, point, contact->gap)) {
            continue;
        }
        last = source;
        distance = find_distance(target, point, local);
        if (distance < contact->gap) {
            is_found = true;
            contact->gap = distance;
            for (int a = 0; a < 3; ++a) {
                contact->point[a] = point[a];
                nearest[a] = local[a];
            }
            if (distance < enough) {
                return true;
            }
        }
    }
    if (is_found) {
        find_normal(target, owner, nearest, contact);
    }
    return is_found;
}

bool mor_pack_probe(const mor_pack_state *state, const mor_pack_item *owner, const mor_pack_item *other, double enough,
                    mor_pack_contact *contact)
{
    const probe_target target = {.state = state, .other = other, .shape = state->forms[other->form].shape};
    return probe(&target, owner, enough, contact);
}

bool mor_pack_probe_shape(const mor_pack_state *state, const mor_pack_item *owner, const mor_shape *shape, double sign,
                          double enough, mor_pack_contact *contact)
{
    const double center = sign * mor_shape_distance(shape, owner->position);
    const probe_target target = {.state = state, .shape = shape, .sign = sign};
    return center - MOR_SHAPE_SLOPE_MOST * state->forms[owner->form].reach * owner->diameter < contact->gap &&
           probe(&target, owner, enough, contact);
}

/* Whether the obstacle keeps the gap to the part of a rock in a cell of the rock's frame. */
static bool clears_cell(const mor_pack_state *state, const mor_pack_item *item, const double *center, double half)
{
    const mor_pack_request *request = state->request;
    const int d = request->dimension;
    const double reach = MOR_SHAPE_SLOPE_MOST * half * sqrt((double)d);
    double point[3];
    place_point(item, center, point);
    const double distance = mor_shape_distance(request->obstacle, point) - request->gap;
    if (distance >= reach * item->diameter || mor_shape_distance(state->forms[item->form].shape, center) > reach) {
        return true;
    }
    if (4.0 * half * item->diameter < request->resolution) {
        return false;
    }
    for (int k = 0; k < 1 << d; ++k) {
        double child[3];
        for (int a = 0; a < 3; ++a) {
            const double side = (k >> a & 1) != 0 ? 0.5 * half : -0.5 * half;
            child[a] = center[a] + (a < d ? side : 0.0);
        }
        if (!clears_cell(state, item, child, 0.5 * half)) {
            return false;
        }
    }
    return true;
}

bool mor_pack_clears_obstacle(const mor_pack_state *state, const mor_pack_item *item)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    return state->request->obstacle == NULL || clears_cell(state, item, origin, state->forms[item->form].reach);
}

static void find_cell(const mor_pack_state *state, const double *position, int *index)
{
    for (int a = 0; a < 3; ++a) {
        const double place = floor((position[a] - state->bounds.minimum[a]) / state->cell);
        index[a] = (int)fmin(state->n_cells[a] - 1.0, fmax(0.0, place));
    }
}

static int64_t join_index(const mor_pack_state *state, int x, int y, int z)
{
    return ((int64_t)z * state->n_cells[1] + y) * state->n_cells[0] + x;
}

void mor_pack_list(mor_pack_state *state)
{
    const int64_t n_cells = (int64_t)state->n_cells[0] * state->n_cells[1] * state->n_cells[2];
    for (int64_t c = 0; c < n_cells; ++c) {
        state->heads[c] = -1;
    }
    for (int i = 0; i < state->n_items; ++i) {
        mor_pack_list_item(state, i);
    }
}

void mor_pack_list_item(mor_pack_state *state, int index)
{
    int cell[3];
    find_cell(state, state->items[index].position, cell);
    int32_t *head = state->heads + join_index(state, cell[0], cell[1], cell[2]);
    state->next[index] = *head;
    *head = index;
}

bool mor_pack_visit(const mor_pack_state *state, const mor_pack_item *item, double within,
                    bool (*visit)(void *user, const mor_pack_state *state, const mor_pack_item *item, int index),
                    void *user)
{
    const double reach = state->forms[item->form].reach * item->diameter + within;
    const double n_around = 1.0 + ceil(fmax(0.0, within - state->least_gap) / state->cell);
    int first[3];
    int last[3];
    find_cell(state, item->position, first);
    for (int a = 0; a < 3; ++a) {
        last[a] = (int)fmin(first[a] + n_around, state->n_cells[a] - 1);
        first[a] = (int)fmax(first[a] - n_around, 0.0);
    }
    for (int z = first[2]; z <= last[2]; ++z) {
        for (int y = first[1]; y <= last[1]; ++y) {
            for (int x = first[0]; x <= last[0]; ++x) {
                for (int32_t i = state->heads[join_index(state, x, y, z)]; i >= 0; i = state->next[i]) {
                    const mor_pack_item *other = state->items + i;
                    double offset[3];
                    const double distance = find_offset(other, item->position, offset);
                    if (distance < reach + state->forms[other->form].reach * other->diameter &&
                        !visit(user, state, item, i)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

static bool is_clear_of(void *user, const mor_pack_state *state, const mor_pack_item *item, int index)
{
    (void)user;
    const mor_pack_item *other = state->items + index;
    double offset[3];
    const double cores =
        state->forms[item->form].core * item->diameter + state->forms[other->form].core * other->diameter;
    if (find_offset(other, item->position, offset) < cores + state->least_gap) {
        return false;
    }
    mor_pack_contact contact = {.gap = state->least_gap};
    return !mor_pack_probe(state, item, other, state->least_gap, &contact) &&
           !mor_pack_probe(state, other, item, state->least_gap, &contact);
}

static bool is_free(const mor_pack_state *state, const mor_pack_item *item)
{
    const mor_pack_request *request = state->request;
    mor_pack_contact contact = {.gap = request->margin};
    return mor_shape_distance(request->region, item->position) < -request->margin &&
           !mor_pack_probe_shape(state, item, request->region, -1.0, request->margin, &contact) &&
           mor_pack_visit(state, item, state->least_gap, is_clear_of, NULL) && mor_pack_clears_obstacle(state, item);
}

bool mor_pack_drop(const mor_pack_state *state, int n_before, int n_tries, mor_pack_item *item)
{
    for (int attempt = 0; attempt < n_tries; ++attempt) {
        mor_pack_draw(state, mor_pack_draw_id(n_before, attempt), item);
        if (is_free(state, item)) {
            return true;
        }
    }
    return false;
}
