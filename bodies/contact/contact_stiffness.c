/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How stiff two surfaces are in contact: docs/theory/contact.md, "Normal force". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <stdlib.h>

/* Radii of contacts count as at most so many times that of the largest face: what is flatter is flat. */
#define FLATTEST 64.0

/* Stiffness of a node whose area is as large as the contact, times spacing over the modulus: a rigid disc of the area
 * of the square of the spacing, 2 / sqrt(pi). */
#define NODE_STIFFNESS 1.1283791670955126

/* Coefficients B of the energy of a contact, (C3b): from Hertz's balls, and from a line contact whose load grows with
 * its depth as pi/4 of the modulus. */
#define ENERGY_SPACE 0.5132254840066531  /* 8/15 (3/pi)^(5/6) */
#define ENERGY_PLANE 0.49209494645110324 /* pi/8 (15/(8 sqrt 2))^(4/5) */

/* The surface around a node is followed only if no edge is near that bends by more than twice the arcsine of this. */
#define EDGE_DIFFERENCE 0.05

/* A surface of a smaller radius than the inverse of this, in spacings, counts as an edge. */
#define SHARP 0.7

/* How many times narrower than a node a contact may be. Around nodes of smooth surfaces, contact_window.c resolves any
 * width: what ends the rise of the stiffness there is the length of a step alone. Edges are points. */
#define FINENESS_SMOOTH 64.0
#define FINENESS_EDGED 4.0

/* What follows from the dimension: energy = B E s^-m W^n with weights (C s)^p. */
typedef struct exponents {
    double energy;    /* B */
    double power;     /* n */
    double curvature; /* p */
} exponents;

static exponents exponents_of(int dimension)
{
    return dimension == 3 ? (exponents){ENERGY_SPACE, 5.0 / 6.0, 0.4} : (exponents){ENERGY_PLANE, 0.8, 0.5};
}

static bool is_edged(const mor_contact *contact, int first, int second)
{
    const mor_contact_work *work = contact->work;
    return work->bodies[first].is_edged || (second < work->n_bodies && work->bodies[second].is_edged);
}

static double fineness(const mor_contact *contact, int first, int second)
{
    return is_edged(contact, first, second) ? FINENESS_EDGED : FINENESS_SMOOTH;
}

static const mor_body *body_of(const mor_contact_body *c)
{
    return &c->group->bodies[c->body];
}

double mor_contact_pair_modulus(const mor_contact *contact, int first, int second)
{
    const mor_body *own = body_of(&contact->work->bodies[first]);
    double compliance = (1.0 - own->contact_poisson * own->contact_poisson) / own->contact_modulus;
    if (second < contact->work->n_bodies) {
        const mor_body *other = body_of(&contact->work->bodies[second]);
        compliance += (1.0 - other->contact_poisson * other->contact_poisson) / other->contact_modulus;
    } else {
        const mor_contact_wall *wall = &contact->walls[second - contact->work->n_bodies];
        compliance += wall->modulus > 0.0 ? (1.0 - wall->poisson * wall->poisson) / wall->modulus : 0.0;
    }
    return 1.0 / compliance;
}

/* Radius of the largest contact that two bodies, or a body and a wall, can have, m. */
static double largest_radius(const mor_contact *contact, int first, int second)
{
    const mor_contact_body *c = &contact->work->bodies[first];
    const double face = second < contact->work->n_bodies ? fmin(c->face, contact->work->bodies[second].face) : c->face;
    return c->group->dimension == 3 ? sqrt(face / MOR_PI) : 0.5 * face;
}

/* Weight of a node by the sum of the curvatures of both surfaces there, 1. */
static double weigh(const mor_contact *contact, int first, int second, double curvature)
{
    const double spacing = mor_contact_spacing(contact, first, second);
    const double least = 1.0 / (FLATTEST * largest_radius(contact, first, second));
    const double bounded = fmin(fmax(curvature, least), 1.0 / spacing);
    return pow(bounded * spacing, exponents_of(contact->work->bodies[first].group->dimension).curvature);
}

/* Curvature of the other side as a node sees it, 1/m: that of most of its surface; walls are flat. */
static double usual_curvature(const mor_contact *contact, int second)
{
    return second < contact->work->n_bodies ? contact->work->bodies[second].curvature : 0.0;
}

/* Stiffness per area where the curvature is largest, Pa/m; other nodes have less, by their weights. */
static double node_area_stiffness(const mor_contact *contact, int first, int second, double *largest_weight)
{
    double sharpest = contact->work->bodies[first].sharpest + usual_curvature(contact, second);
    if (second < contact->work->n_bodies) {
        sharpest = fmax(sharpest, contact->work->bodies[second].sharpest + usual_curvature(contact, first));
    }
    *largest_weight = weigh(contact, first, second, sharpest);
    return NODE_STIFFNESS * mor_contact_pair_modulus(contact, first, second) /
           mor_contact_spacing(contact, first, second);
}

/* The energy at which a contact is as wide as its nodes, J (J/m): below, the sums over nodes do not resolve it. */
static double find_knee(const mor_contact *contact, int first, int second)
{
    const int dimension = contact->work->bodies[first].group->dimension;
    const exponents e = exponents_of(dimension);
    const double spacing = mor_contact_spacing(contact, first, second);
    double weight;
    const double fine = fineness(contact, first, second);
    const double area_stiffness = fine * node_area_stiffness(contact, first, second, &weight) / weight;
    /* There d(energy)/dW = n B E s^-m W^(n - 1) is the contact stiffness per area. Powers of dimensionless numbers
     * only, so that a change of units by powers of two changes no bit. */
    const double knee = pow(e.power * e.energy * weight / (fine * NODE_STIFFNESS), 1.0 / (1.0 - e.power));
    const double volume = spacing * spacing * spacing;
    return area_stiffness * knee * (dimension == 3 ? volume * spacing : volume);
}

/* Inverse of the mass that two rigid sides have together, whether or not they are held now, 1/kg (m/kg). */
static double pair_inverse(const mor_contact *contact, int first, int second)
{
    const mor_contact_work *work = contact->work;
    const double own = 1.0 / body_of(&work->bodies[first])->mass;
    return own + (second < work->n_bodies ? 1.0 / body_of(&work->bodies[second])->mass : 0.0);
}

/* Energy of an impact at the reference speed, or after a fall over the size of the body, J (J/m). */
static double reference_energy(const mor_contact *contact, int first, int second)
{
    const mor_contact_body *c = &contact->work->bodies[first];
    const bool is_wall = second >= contact->work->n_bodies;
    const double radius = is_wall ? c->radius : fmax(c->radius, contact->work->bodies[second].radius);
    const double fall2 = 4.0 * mor_contact_gravity(c) * radius;
    const double speed = contact->settings.reference_speed;
    return 0.5 * fmax(fall2, speed * speed) / pair_inverse(contact, first, second);
}

/* Softening at the energy of an impact at the reference speed, 1: tangential springs are as stiff as the normal ones
 * are then. They must not change while they are loaded, or they would release more energy than they stored. */
static double reference_softening(const mor_contact *contact, int first, int second)
{
    const mor_contact_body *c = &contact->work->bodies[first];
    const double energy = reference_energy(contact, first, second);
    const double knee = find_knee(contact, first, second);
    const double n = exponents_of(c->group->dimension).power;
    return n * energy > knee ? pow(n * energy / knee, (n - 1.0) / n) : 1.0;
}

double mor_contact_area_stiffness(const mor_contact *contact, int first, int second)
{
    const mor_contact_body *a = &contact->work->bodies[first];
    if (mor_contact_is_hertzian(contact, first, second)) {
        double weight;
        return fineness(contact, first, second) * reference_softening(contact, first, second) *
               node_area_stiffness(contact, first, second, &weight);
    }
    const double own = body_of(a)->contact_modulus / a->group->spacing;
    if (mor_contact_group(contact, second) == NULL) {
        return own;
    }
    const mor_contact_body *b = &contact->work->bodies[second];
    const double other = body_of(b)->contact_modulus / b->group->spacing;
    return 2.0 * own / (own + other) * other;
}

double mor_contact_stiffness(const mor_contact *contact, const mor_contact_near *near, int side, int64_t node)
{
    const mor_contact_work *work = contact->work;
    const bool is_wall = mor_contact_group(contact, near->second) == NULL;
    const mor_contact_body *owner = &work->bodies[side == 0 ? near->first : near->second];
    /* Both bodies' nodes carry the same surface, each half of it. */
    const double area = (is_wall ? 1.0 : 0.5) * owner->group->node_area[node];
    if (!mor_contact_is_hertzian(contact, near->first, near->second)) {
        return mor_contact_area_stiffness(contact, near->first, near->second) * area;
    }
    double largest;
    node_area_stiffness(contact, near->first, near->second, &largest);
    const double area_stiffness = mor_contact_area_stiffness(contact, near->first, near->second);
    const double own = work->curvatures[work->first_node[owner->group_index] + node];
    const double other = usual_curvature(contact, side == 0 ? near->second : near->first);
    return area_stiffness * weigh(contact, near->first, near->second, own + other) / largest * area;
}

void mor_contact_set_curvature(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch,
                               double curvature)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_body *c = &work->bodies[touch->side == 0 ? near->first : near->second];
    const int other = touch->side == 0 ? near->second : near->first;
    touch->share = 1.0;
    touch->curvature = touch->other_curvature = 0.0;
    if (!mor_contact_is_hertzian(contact, near->first, near->second)) {
        return;
    }
    const double own = work->curvatures[work->first_node[c->group_index] + touch->node];
    const double usual = own + usual_curvature(contact, other);
    /* Of a body the usual one: the stiffness must not change as nodes slide, or the normal forces would not be
     * conservative. */
    const double felt = other < work->n_bodies ? usual : own + curvature;
    touch->curvature = own;
    touch->other_curvature = curvature;
    touch->share = weigh(contact, near->first, near->second, felt) / weigh(contact, near->first, near->second, usual) /
                   reference_softening(contact, near->first, near->second);
}

double mor_contact_soften(const mor_contact *contact, const mor_contact_near *near, double energy, double *stored)
{
    *stored = energy;
    if (!mor_contact_is_hertzian(contact, near->first, near->second)) {
        return 1.0;
    }
    const double knee = find_knee(contact, near->first, near->second);
    if (!(energy > knee)) {
        return 1.0;
    }
    const double n = exponents_of(contact->work->bodies[near->first].group->dimension).power;
    const double factor = pow(energy / knee, n - 1.0);
    *stored = knee * (1.0 - 1.0 / n) + energy * factor / n;
    return factor;
}

/* Length of the smallest contact that nodes resolve, m. */
static double finest(const mor_contact *contact, int first, int second)
{
    return mor_contact_spacing(contact, first, second) /
           (is_edged(contact, first, second) ? 1.0 : fineness(contact, first, second));
}

/* Mean over the nodes of stiffness per area while a contact is narrow, Pa/m. */
static double narrow_area_stiffness(const mor_contact *contact, int first, int second)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_body *c = &work->bodies[first];
    const double weight =
        second < work->n_bodies ? fmax(c->mean_weight, work->bodies[second].mean_weight) : c->mean_weight;
    return fineness(contact, first, second) * NODE_STIFFNESS * weight *
           mor_contact_pair_modulus(contact, first, second) / mor_contact_spacing(contact, first, second);
}

double mor_contact_least_stiffness(const mor_contact *contact, int first, int second)
{
    const double fine = finest(contact, first, second);
    return narrow_area_stiffness(contact, first, second) *
           (contact->work->bodies[first].group->dimension == 3 ? fine * fine : fine);
}

/* How a pair touches once it has stored an energy: its normal stiffness, N/m (N/m2), and half its width, m. */
typedef struct touching {
    double stiffness, reach;
} touching;

static touching touch_by_energy(const mor_contact *contact, int first, int second, double energy)
{
    const mor_contact_body *c = &contact->work->bodies[first];
    const mor_contact_body *partner = second < contact->work->n_bodies ? &contact->work->bodies[second] : NULL;
    const double modulus = mor_contact_pair_modulus(contact, first, second);
    const double widest = largest_radius(contact, first, second);
    const double curvature = c->flattest + (partner != NULL ? partner->flattest : 0.0);
    const double radius = fmin(1.0 / fmax(curvature, 0.0), FLATTEST * widest);
    if (c->group->dimension == 3) {
        const double depth = radius * pow(15.0 * energy / (8.0 * modulus * radius * radius * radius), 0.4);
        const double reach = fmin(widest, sqrt(radius * depth));
        return (touching){2.0 * modulus * reach, reach};
    }
    const double depth = sqrt(8.0 * energy / (MOR_PI * modulus));
    return (touching){0.25 * MOR_PI * modulus, fmin(widest, sqrt(2.0 * radius * depth))};
}

double mor_contact_largest_stiffness(const mor_contact *contact, int first, int second, double energy)
{
    const mor_contact_body *c = &contact->work->bodies[first];
    const double spacing = mor_contact_spacing(contact, first, second);
    const double widest = largest_radius(contact, first, second);
    const double least = mor_contact_least_stiffness(contact, first, second);
    const double tangential =
        reference_softening(contact, first, second) * narrow_area_stiffness(contact, first, second);
    const touching it = touch_by_energy(contact, first, second, energy);
    const double area = c->group->dimension == 3 ? fmin(MOR_PI * widest * widest, 2.0 * MOR_PI * it.reach * it.reach) +
                                                       4.0 * spacing * spacing
                                                 : 2.0 * it.reach + 2.0 * spacing;
    return fmax(it.stiffness, fmax(least, tangential * area));
}

double mor_contact_frequency(const mor_contact *contact, const mor_contact_near *near, double speed)
{
    const double inverse = pair_inverse(contact, near->first, near->second);
    const double energy =
        speed > 0.0 ? 0.5 * speed * speed / inverse : reference_energy(contact, near->first, near->second);
    return sqrt(touch_by_energy(contact, near->first, near->second, energy).stiffness * inverse);
}

static int compare_numbers(const void *a, const void *b)
{
    const double first = *(const double *)a;
    const double second = *(const double *)b;
    return (first > second) - (first < second);
}

/* Curvatures of one rigid body: at each node, and what of them its pairs need. Scratch, shape [n_nodes]. */
static void measure_rigid(mor_contact *contact, mor_contact_body *c, double *scratch)
{
    const mor_body *body = body_of(c);
    const mor_body_group *group = c->group;
    const double sharpest = 1.0 / group->spacing;
    const double power = exponents_of(group->dimension).curvature;
    const double radius = group->dimension == 3 ? sqrt(c->face / MOR_PI) : 0.5 * c->face;
    const int64_t entry = contact->work->first_node[c->group_index] + body->first_node;
    double *curvatures = contact->work->curvatures + entry;
    double *normals = contact->work->normals + 3 * entry;
    unsigned char *is_smooth = contact->work->is_smooth + entry;
    double area = 0.0;
    c->sharpest = 0.0;
    c->flattest = sharpest;
    c->mean_weight = 0.0;
    for (int64_t k = 0; k < body->n_nodes; ++k) {
        const double *reference = group->node_reference + 3 * (body->first_node + k);
        double place[3];
        mor_contact_shape_place(body, reference, place);
        double normal[3];
        const bool goes_on =
            !mor_contact_has_edge(body->shape, group->dimension, place, group->spacing, EDGE_DIFFERENCE, normal);
        mor_matrix_apply(body->shape_rotation, normal, normals + 3 * k);
        const double found = mor_contact_curvature(body->shape, group->dimension, place, 0.0, normal, group->spacing);
        curvatures[k] = fmin(fmax(found, 0.0), sharpest);
        contact->work->node_distances[entry + k] = mor_shape_distance(body->shape, place);
        is_smooth[k] = goes_on && found < SHARP * sharpest;
        c->is_edged = c->is_edged || !is_smooth[k];
        scratch[k] = curvatures[k];
        c->sharpest = fmax(c->sharpest, curvatures[k]);
        c->flattest = fmin(c->flattest, curvatures[k]);
        area += group->node_area[body->first_node + k];
    }
    const double least = 1.0 / (FLATTEST * radius);
    for (int64_t k = 0; k < body->n_nodes; ++k) {
        c->mean_weight += group->node_area[body->first_node + k] / area *
                          pow(fmax(curvatures[k], least) / fmax(c->sharpest, least), power);
    }
    qsort(scratch, (size_t)body->n_nodes, sizeof *scratch, compare_numbers);
    c->curvature = body->n_nodes > 0 ? scratch[body->n_nodes / 2] : 0.0;
}

mor_status mor_contact_measure_curvatures(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    double *scratch = NULL;
    const int64_t n = contact->history.n_particles;
    mor_contact_window_weights(work->window);
    MOR_TRY(context, MOR_NEW(context, &work->curvatures, n, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->normals, 3 * n, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->node_distances, n, "contact"));
    MOR_TRY(context, MOR_NEW(context, &work->is_smooth, n, "contact"));
    MOR_TRY(context, MOR_NEW(context, &scratch, n, "contact"));
    for (int b = 0; b < work->n_bodies; ++b) {
        if (!work->bodies[b].group->operations->is_deformable) {
            measure_rigid(contact, &work->bodies[b], scratch);
        }
    }
    MOR_FREE(context, &scratch);
    return MOR_OK;
}
