/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/contact/contact.h"

#include "bodies/contact/contact_work.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <string.h>

/* The surface protrudes from the box of its nodes by less, in spacings. */
#define BOX_RIM 0.3

enum { BISECTIONS = 60, TOUCHES_PER_CHUNK = 16 };

/* Solves y (1 + e) = ln((1 + y) / (1 - e y)), 0 < y < 1/e: the force factor 1 + (y / v0) v gives back e v0. */
static double solve_rebound(double restitution)
{
    const double e = restitution;
    if (e >= 1.0) {
        return 0.0;
    }
    /* The left side is larger for small y, the right one near 1/e. */
    double low = 0.0;
    double high = 1.0 / e;
    for (int k = 0; k < BISECTIONS; ++k) {
        const double y = 0.5 * (low + high);
        if (y * (1.0 + e) > log((1.0 + y) / (1.0 - e * y))) {
            low = y;
        } else {
            high = y;
        }
    }
    return low;
}

/* Index of a body or n_bodies plus that of a wall; -1: unknown. */
static int find_name(const mor_contact *contact, const char *name)
{
    const mor_contact_work *work = contact->work;
    for (int b = 0; b < work->n_bodies; ++b) {
        if (strcmp(work->bodies[b].group->bodies[work->bodies[b].body].name, name) == 0) {
            return b;
        }
    }
    for (int w = 0; w < contact->n_walls; ++w) {
        if (strcmp(contact->walls[w].name, name) == 0) {
            return work->n_bodies + w;
        }
    }
    return -1;
}

static mor_status check_law(mor_context *context, const mor_contact_law *law)
{
    MOR_CHECK(context, law->friction_coefficient >= 0.0 && isfinite(law->friction_coefficient), MOR_ERROR_ARGUMENT,
              "the friction coefficient of a contact is %g; it must be a number >= 0", law->friction_coefficient);
    MOR_CHECK(context, law->restitution > 0.0 && law->restitution <= 1.0, MOR_ERROR_ARGUMENT,
              "the restitution of a contact is %g; it must be above 0 and at most 1", law->restitution);
    return MOR_OK;
}

static mor_status assign_laws(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const mor_contact_settings *settings = &contact->settings;
    MOR_CHECK(context, settings->n_pairs <= MOR_CONTACT_PAIRS_MAX, MOR_ERROR_ARGUMENT,
              "%d pairs have a contact law of their own; at most %d are allowed", settings->n_pairs,
              MOR_CONTACT_PAIRS_MAX);
    MOR_CHECK(context, settings->slowest_impact >= 0.0, MOR_ERROR_ARGUMENT,
              "the slowest impact is %g m/s; it must not be negative", settings->slowest_impact);
    MOR_TRY(context, check_law(context, &settings->law));
    work->rebound[0] = solve_rebound(settings->law.restitution);
    for (int k = 0; k < settings->n_pairs; ++k) {
        const mor_contact_pair *pair = &settings->pairs[k];
        const int a = find_name(contact, pair->first);
        const int b = find_name(contact, pair->second);
        MOR_CHECK(context, a >= 0 && b >= 0, MOR_ERROR_ARGUMENT,
                  "a contact law is given for '%s' and '%s', but there is no body or wall '%s'", pair->first,
                  pair->second, a < 0 ? pair->first : pair->second);
        MOR_CHECK(context, a != b && (a < work->n_bodies || b < work->n_bodies), MOR_ERROR_ARGUMENT,
                  "a contact law is given for '%s' and '%s'; it must be for two bodies, or a body and a wall",
                  pair->first, pair->second);
        MOR_TRY(context, check_law(context, &pair->law));
        work->rebound[k + 1] = solve_rebound(pair->law.restitution);
        work->law_of[mor_contact_pair_index(contact, a < b ? a : b, a < b ? b : a)] = (unsigned char)(k + 1);
    }
    return MOR_OK;
}

/* Largest face of the box around a body in the frame of its shape: no contact is wider. */
static double largest_face(const mor_body_group *group, const mor_body *body)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t k = body->first_node; k < body->first_node + body->n_nodes; ++k) {
        double place[3];
        mor_matrix_apply_transposed(body->shape_rotation, group->node_reference + 3 * k, place);
        for (int a = 0; a < 3; ++a) {
            low[a] = fmin(low[a], place[a]);
            high[a] = fmax(high[a], place[a]);
        }
    }
    const double side[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    if (group->dimension == 2) {
        return fmax(side[0], side[1]);
    }
    return fmax(side[0] * side[1], fmax(side[1] * side[2], side[2] * side[0]));
}

static void measure_body(mor_contact_body *c)
{
    const mor_body_group *group = c->group;
    const mor_body *body = &group->bodies[c->body];
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t k = body->first_node; k < body->first_node + body->n_nodes; ++k) {
        for (int a = 0; a < 3; ++a) {
            low[a] = fmin(low[a], group->node_reference[3 * k + a]);
            high[a] = fmax(high[a], group->node_reference[3 * k + a]);
        }
    }
    for (int a = 0; a < 3; ++a) {
        c->half[a] = 0.5 * (high[a] - low[a]) + (a < group->dimension ? BOX_RIM * group->spacing : 0.0);
        c->middle[a] = 0.5 * (high[a] + low[a]) - body->geometry.center[a];
    }
    c->radius = mor_vector_length(c->half) + mor_vector_length(c->middle);
    c->face = largest_face(group, body);
    c->tree_travel = -1.0;
}

/* Bound of the squared frequency of particles under nodes with one unit of stiffness per area, by Gershgorin: the
 * largest row of sum over nodes of area w w^T / mass. Scratch, shape [n_particles of the body]. */
static double find_softness(const mor_contact_body *c, double *scratch)
{
    const mor_body_group *group = c->group;
    const mor_body *body = &group->bodies[c->body];
    const double *mass = group->set.data[MOR_FIELD_MASS];
    double softness = 0.0;
    for (int64_t node = body->first_node; node < body->first_node + body->n_nodes; ++node) {
        const mor_body_support support = mor_body_node_support(group, node);
        double sum = 0.0;
        for (int k = 0; k < support.count; ++k) {
            sum += fabs(support.weights[k]);
        }
        for (int k = 0; k < support.count; ++k) {
            scratch[support.particles[k] - body->first] += group->node_area[node] * sum * fabs(support.weights[k]);
        }
    }
    for (int64_t i = 0; i < body->n_particles; ++i) {
        softness = fmax(softness, scratch[i] / mass[body->first + i]);
        scratch[i] = 0.0;
    }
    return softness;
}

static mor_status list_bodies(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    int64_t n_nodes = 0;
    for (int g = 0; g < contact->n_groups; ++g) {
        work->first_body[g] = work->n_bodies;
        work->first_node[g] = n_nodes;
        work->n_bodies += contact->groups[g]->n_bodies;
        n_nodes += contact->groups[g]->n_nodes;
    }
    MOR_TRY(context, MOR_NEW(context, &work->bodies, work->n_bodies, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->boxes, 6 * (int64_t)work->n_bodies, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->speeds, work->n_bodies, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->longest, work->n_bodies, "contact"));
    for (int g = 0; g < contact->n_groups; ++g) {
        mor_body_group *group = contact->groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            mor_contact_body *c = &work->bodies[work->first_body[g] + b];
            const bool is_rigid = !group->operations->is_deformable;
            c->group = group;
            c->group_index = g;
            c->body = b;
            measure_body(c);
            if (is_rigid) {
                mor_contact_measure_inertia(c);
            }
            const int64_t n = is_rigid ? 12 : 3 * group->bodies[b].n_particles;
            MOR_TRY(context, MOR_NEW(context, &c->previous, n, "contact"));
            if (!is_rigid) {
                c->softness = find_softness(c, c->previous);
                MOR_TRY(context, mor_tree_init(context, &c->tree, group->bodies[b].n_particles));
            }
        }
    }
    return MOR_OK;
}

static mor_status make_history(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const mor_field_info partners = {"friction_partners", MOR_CONTACT_SLOTS, "1", MOR_FIELD_EVOLVES,
                                     "partners of the tangential springs of each surface node; 0: none"};
    const mor_field_info springs = {"friction_springs", 3 * MOR_CONTACT_SLOTS, "m", MOR_FIELD_EVOLVES,
                                    "tangential springs of each surface node"};
    int64_t n_nodes = 0;
    for (int g = 0; g < contact->n_groups; ++g) {
        n_nodes += contact->groups[g]->n_nodes;
    }
    MOR_TRY(context, mor_set_init(context, &contact->history, "contact", n_nodes, 0));
    MOR_TRY(context, mor_set_add_field(context, &contact->history, &partners, &work->field_partners));
    MOR_TRY(context, mor_set_add_field(context, &contact->history, &springs, &work->field_springs));
    const int64_t n_slots = MOR_CONTACT_SLOTS * n_nodes;
    MOR_TRY(context, MOR_NEW(context, &work->held_slots, n_slots, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->kept_slots, n_slots, "contact"));
    return MOR_NEW(context, &work->slot_mark, n_slots, "contact");
}

static mor_status make_lists(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const int64_t n = work->n_bodies;
    work->n_pairs = n * (n - 1) / 2 + n * contact->n_walls;
    contact->n_impacts = work->n_pairs;
    MOR_TRY(context, MOR_NEW(context, &contact->impacts, work->n_pairs, "contact"));
    MOR_TRY(context,
            MOR_NEW(context, &contact->pair_spring, contact->settings.has_removals ? work->n_pairs : 0, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->free_until, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->near_of, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->law_of, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->hit_pairs, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->kept_pairs, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->pair_mark, work->n_pairs, "contact"));
    MOR_TRY(context, MOR_NEW(context, &contact->group_spring, contact->n_groups, "contact"));
    MOR_TRY(context, MOR_NEW(context, &contact->group_deepest, contact->n_groups, "contact"));
    MOR_TRY(context,
            MOR_NEW(context, &contact->wall_force, 3 * (int64_t)contact->n_groups * contact->n_walls, "contact"));
    MOR_TRY(context,
            MOR_NEW(context, &contact->wall_moment, 3 * (int64_t)contact->n_groups * contact->n_walls, "contact"));
    return MOR_OK;
}

static mor_status make_all(mor_context *context, mor_contact *contact, const mor_contact_wall *walls)
{
    MOR_TRY(context, MOR_NEW(context, &contact->work, 1, "contact"));
    MOR_TRY(context, MOR_NEW(context, &contact->walls, contact->n_walls, "contact"));
    for (int w = 0; w < contact->n_walls; ++w) {
        contact->walls[w] = walls[w];
    }
    mor_contact_move_walls(contact, 0.0);
    MOR_TRY(context, list_bodies(context, contact));
    MOR_TRY(context, make_lists(context, contact));
    MOR_TRY(context, make_history(context, contact));
    MOR_TRY(context, mor_contact_measure_curvatures(context, contact));
    MOR_TRY(context, mor_contact_list_neighbors(context, contact));
    return assign_laws(context, contact);
}

mor_status mor_contact_init(mor_context *context, mor_contact *contact, const mor_contact_settings *settings,
                            mor_body_group *const *groups, const uint64_t *stepper_bits, int n_groups,
                            const mor_contact_wall *walls, int n_walls)
{
    memset(contact, 0, sizeof *contact);
    MOR_CHECK(context, n_groups >= 0 && n_groups <= MOR_BODY_GROUPS_MAX, MOR_ERROR_ARGUMENT,
              "%d groups of bodies are given; at most %d are allowed", n_groups, MOR_BODY_GROUPS_MAX);
    MOR_CHECK(context, n_walls >= 0 && n_walls <= MOR_CONTACT_WALLS_MAX, MOR_ERROR_ARGUMENT,
              "%d walls are given; at most %d are allowed", n_walls, MOR_CONTACT_WALLS_MAX);
    contact->settings = *settings;
    contact->n_groups = n_groups;
    contact->n_walls = n_walls;
    for (int g = 0; g < n_groups; ++g) {
        contact->groups[g] = groups[g];
        contact->stepper_bits[g] = stepper_bits[g];
    }
    const mor_status status = make_all(context, contact, walls);
    if (status != MOR_OK) {
        mor_contact_clear(context, contact);
        return mor_context_pass(context, status, MOR_HERE);
    }
    for (int g = 0; g < n_groups; ++g) {
        groups[g]->longest_contact_step = mor_contact_longest_step;
        groups[g]->visit_contact = mor_contact_visit;
        groups[g]->contact = contact;
    }
    return MOR_OK;
}

static void clear_work(mor_context *context, mor_contact_work *work)
{
    for (int b = 0; work->bodies != NULL && b < work->n_bodies; ++b) {
        MOR_FREE(context, &work->bodies[b].previous);
        mor_tree_clear(context, &work->bodies[b].tree);
    }
    for (int k = 0; k < work->n_near; ++k) {
        mor_contact_free_lanes(context, &work->near[k]);
    }
    MOR_FREE(context, &work->bodies);
    MOR_FREE(context, &work->boxes);
    MOR_FREE(context, &work->speeds);
    MOR_FREE(context, &work->longest);
    MOR_FREE(context, &work->near);
    MOR_FREE(context, &work->active);
    MOR_FREE(context, &work->first_touch);
    MOR_FREE(context, &work->touches);
    MOR_FREE(context, &work->support_particles);
    MOR_FREE(context, &work->support_weights);
    MOR_FREE(context, &work->curvatures);
    MOR_FREE(context, &work->normals);
    MOR_FREE(context, &work->node_distances);
    MOR_FREE(context, &work->is_smooth);
    MOR_FREE(context, &work->first_neighbor);
    MOR_FREE(context, &work->neighbors);
    MOR_FREE(context, &work->free_until);
    MOR_FREE(context, &work->near_of);
    MOR_FREE(context, &work->law_of);
    MOR_FREE(context, &work->hit_pairs);
    MOR_FREE(context, &work->kept_pairs);
    MOR_FREE(context, &work->pair_mark);
    MOR_FREE(context, &work->held_slots);
    MOR_FREE(context, &work->kept_slots);
    MOR_FREE(context, &work->slot_mark);
}

void mor_contact_clear(mor_context *context, mor_contact *contact)
{
    for (int g = 0; g < contact->n_groups; ++g) {
        if (contact->groups[g]->contact == contact) {
            contact->groups[g]->longest_contact_step = NULL;
            contact->groups[g]->visit_contact = NULL;
            contact->groups[g]->contact = NULL;
        }
    }
    if (contact->work != NULL) {
        clear_work(context, contact->work);
    }
    MOR_FREE(context, &contact->work);
    MOR_FREE(context, &contact->walls);
    MOR_FREE(context, &contact->impacts);
    MOR_FREE(context, &contact->group_spring);
    MOR_FREE(context, &contact->group_deepest);
    MOR_FREE(context, &contact->wall_force);
    MOR_FREE(context, &contact->wall_moment);
    MOR_FREE(context, &contact->pair_spring);
    mor_set_clear(context, &contact->history);
    memset(contact, 0, sizeof *contact);
}

static int bit_index(uint64_t bit)
{
    int index = 0;
    while (bit > 1) {
        bit >>= 1;
        ++index;
    }
    return index;
}

static mor_status find_partners(mor_context *context, void *owner, double length, uint64_t *partners, int n_steppers)
{
    const mor_contact *contact = owner;
    const mor_contact_work *work = contact->work;
    mor_contact_find_boxes(context, contact, work->speeds);
    for (int a = 0; a < work->n_bodies; ++a) {
        const mor_contact_body *p = &work->bodies[a];
        for (int b = a + 1; b < work->n_bodies; ++b) {
            const mor_contact_body *q = &work->bodies[b];
            if (p->group_index == q->group_index) {
                continue;
            }
            const double fall = (mor_contact_gravity(p) + mor_contact_gravity(q)) * length;
            const double path = (work->speeds[a] + work->speeds[b] + fall) * length;
            const double rim = 2.0 * fmax(p->group->spacing, q->group->spacing);
            if (mor_contact_apart(contact, a, b, work->boxes) <= path + rim) {
                const int s = bit_index(contact->stepper_bits[p->group_index]);
                const int t = bit_index(contact->stepper_bits[q->group_index]);
                const int last = s > t ? s : t;
                MOR_CHECK(context, last < n_steppers, MOR_ERROR_INTERNAL,
                          "contact refers to stepper %d, but there are only %d", last, n_steppers);
                partners[s] |= contact->stepper_bits[q->group_index];
                partners[t] |= contact->stepper_bits[p->group_index];
            }
        }
    }
    return MOR_OK;
}

/* Sets the forces of the members' bodies to zero. */
static void clear_forces(mor_contact *contact, uint64_t members)
{
    for (int g = 0; g < contact->n_groups; ++g) {
        mor_body_group *group = contact->groups[g];
        if ((contact->stepper_bits[g] & members) == 0) {
            continue;
        }
        for (int b = 0; b < group->n_bodies; ++b) {
            memset(group->bodies[b].contact_force, 0, sizeof group->bodies[b].contact_force);
            memset(group->bodies[b].contact_moment, 0, sizeof group->bodies[b].contact_moment);
        }
        if (group->contact_force != NULL) {
            memset(group->contact_force, 0, (size_t)(3 * group->set.n_particles) * sizeof *group->contact_force);
        }
    }
}

void mor_contact_resume(mor_contact *contact, double time)
{
    mor_contact_work *work = contact->work;
    mor_contact_move_walls(contact, time);
    work->is_warm = false;
    work->n_held = 0;
    work->n_hit = 0;
    memset(work->group_worst, 0, sizeof work->group_worst);
    mor_contact_add_sums(contact);
}

static mor_status run_contact(mor_context *context, void *owner, uint64_t members, const mor_step *step)
{
    mor_contact *contact = owner;
    mor_contact_work *work = contact->work;
    clear_forces(contact, members);
    mor_contact_move_walls(contact, step->time + 0.5 * step->length);
    mor_contact_observe(context, contact, members);
    MOR_TRY(context, mor_contact_search(context, contact, members));
    MOR_PARALLEL_FOR (context, k, work->n_touches, TOUCHES_PER_CHUNK) {
        mor_contact_touch *touch = &work->touches[k];
        const mor_contact_near *near = &work->near[touch->near];
        mor_contact_find_touch(contact, near, touch, true, work->support_particles + MOR_CONTACT_SUPPORT * k,
                               work->support_weights + MOR_CONTACT_SUPPORT * k);
        near->lanes[touch->side].clear[touch->entry] = near->travel + touch->clearance;
    }
    mor_contact_apply_forces(contact, members, step->length);
    MOR_TRY(context, mor_contact_check_depth(context, contact));
    mor_contact_move_walls(contact, step->time + step->length);
    return MOR_OK;
}

void mor_contact_exchange(mor_contact *contact, mor_exchange *exchange)
{
    *exchange = (mor_exchange){.owner = contact,
                               .find_partners = find_partners,
                               .run = run_contact,
                               .name = "contact",
                               .accumulates = MOR_BIT(MOR_RESOURCE_BODIES),
                               .remembers = MOR_BIT(MOR_RESOURCE_CONTACT)};
}
