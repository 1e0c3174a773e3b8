/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Gaps between soil that bears tension and faces that only press, (W3b) of docs/theory/walls.md. A gap is a vector:
 * along the normal of a face it tells how far the particle has left that one. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <string.h>

/* LEAST: a gap up to this part of the depth of the first layer is rounding. NEAREST: what is nearer to a face than
 * this part of that depth touches it whatever its gap, so that soil does not pass through a face that counts as left.
 * SLANT: a gap counts for faces whose normal has more than this part of its direction, so that what was left along a
 * face opens none while that face turns. FARTHEST: no gap is wider than this many such depths, three spacings, behind
 * which soil of the usual smoothing length sees no face. */
#define LEAST 1.0e-9
#define NEAREST 0.5
#define SLANT 0.01
#define FARTHEST 6.0

/* Faces that stand at any angles are put together one after the other, by which a gap between three or more of them can
 * grow without any motion. */
static void keep_gap(const double *gap, double longest, double *kept)
{
    const double length = mor_vector_length(gap);
    const double part = length > longest ? longest / length : 1.0;
    for (int a = 0; a < 3; ++a) {
        kept[a] = part * gap[a];
    }
}

void mor_soil_contact_begin_gaps(mor_context *context, const mor_contact_soil *soil, const int8_t *sleep,
                                 const mor_contact_rates *rates, double *before)
{
    const int64_t n_clusters = (soil->n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    MOR_PARALLEL_FOR (context, cluster, rates->gap != NULL ? n_clusters : 0, MOR_CONTACT_GRAIN) {
        const int64_t first = cluster * MOR_CLUSTER;
        const int64_t n = soil->n_particles - first < MOR_CLUSTER ? soil->n_particles - first : MOR_CLUSTER;
        for (int64_t i = first; i < first + n; ++i) {
            keep_gap(rates->gap + 3 * i, FARTHEST * soil->depth, before + 3 * i);
        }
        if (!mor_sleep_is(sleep, cluster, MOR_SLEEP_ASLEEP)) {
            memset(rates->gap + 3 * first, 0, (size_t)(3 * n) * sizeof(double));
        }
        memset(rates->face_growth + first, 0, (size_t)n * sizeof(double));
        for (int64_t i = first; i < first + n; ++i) {
            double *growth = soil->growth + MOR_CONTACT_GROWTHS * i;
            growth[MOR_CONTACT_GROWTH_FACES] = growth[MOR_CONTACT_GROWTH_LEFT] = 0.0;
        }
    }
}

void mor_soil_contact_find_growth(mor_context *context, const mor_contact_soil *soil, const double *density_rate,
                                  const double *face_growth)
{
    MOR_PARALLEL_FOR (context, i, soil->growth != NULL ? soil->n_particles : 0, MOR_BLOCK) {
        const double density = soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_DENSITY];
        double *growth = soil->growth + MOR_CONTACT_GROWTHS * i;
        growth[MOR_CONTACT_GROWTH_REST] = -density_rate[i] / density - face_growth[i];
        growth[MOR_CONTACT_GROWTH_FACES] = growth[MOR_CONTACT_GROWTH_LEFT] = 0.0;
    }
}

/* A face that only presses, as a particle sees it. */
typedef struct face_view {
    double normal[3]; /* into the soil, 1 */
    double length;    /* of the kernel gradient over it, 1/m */
    double leaves;    /* motion of the particle away from it in the step, m */
    double open;      /* gap to it, m; 0: it touches */
} face_view;

/* False where the particle sees nothing of it. */
static bool view_face(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane, int64_t i,
                      face_view *face)
{
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    double relative[3];
    face->length = mor_vector_length(gradient);
    if (!(face->length > 0.0)) {
        return false;
    }
    mor_soil_contact_normal(gradient, face->normal);
    for (int a = 0; a < 3; ++a) {
        relative[a] = soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + a] - velocity[a];
    }
    face->leaves = mor_vector_dot(relative, face->normal) * soil->length;
    face->open =
        mor_soil_contact_gap(soil->gap + 3 * i, soil->depth, face->normal, mor_soil_contact_distance(contact, lane));
    return true;
}

/* Adds the growth of a particle by a face that mirrors its motion, but for what closes or widens a gap. */
static void add_face_growth(const mor_contact_soil *soil, const face_view *face, double *growth)
{
    const double mirrored = face->open == 0.0 ? face->leaves : mor_min(face->leaves + face->open, 0.0);
    const double rate = 2.0 * face->length * mirrored / soil->length;
    growth[MOR_CONTACT_GROWTH_FACES] += rate;
    growth[MOR_CONTACT_GROWTH_LEFT] += mor_max(rate, 0.0);
}

void mor_soil_contact_add_growth(mor_context *context, const mor_soil_contact *contact, const mor_contact_soil *soil)
{
    MOR_PARALLEL_FOR (context, place, soil->growth != NULL ? contact->relation.n_occupied : 0, MOR_CONTACT_GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[slot].patch];
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], soil->n_particles); ++k) {
                const int64_t i = first + k;
                const mor_wall_friction friction = mor_soil_contact_friction(patch, soil->region, i).kind;
                face_view face;
                if (mor_soil_contact_across(soil, friction, i) > 0.0 &&
                    view_face(contact, soil, slot * MOR_CLUSTER + k, i, &face)) {
                    add_face_growth(soil, &face, soil->growth + MOR_CONTACT_GROWTHS * i);
                }
            }
        }
    }
}

double mor_soil_contact_gap(const double *gap, double depth, const double *normal, double distance)
{
    const double along = mor_vector_dot(gap, normal);
    const double open = mor_min(along, distance - NEAREST * depth);
    return open > LEAST * depth && along > SLANT * mor_vector_length(gap) ? open : 0.0;
}

double mor_soil_contact_leave_face(const mor_contact_leave *it, double *after)
{
    const double open = mor_soil_contact_gap(it->gap, it->depth, it->normal, it->distance);
    double follows = 0.0; /* of the motion, what goes with the face, m */
    if (it->leaves > 0.0) {
        follows = open > 0.0 ? 0.0 : mor_min(it->leaves, it->unloads);
    } else {
        follows = mor_min(it->leaves + open, 0.0);
    }
    /* A particle that has left another face on the other side first comes back to that one. */
    const double along = mor_vector_dot(it->gap, it->normal);
    const bool is_behind = along < -SLANT * mor_vector_length(it->gap) && along < -LEAST * it->depth;
    const double left = is_behind ? 0.0 : mor_max(open + it->leaves - follows, 0.0);
    const double sum = mor_vector_dot(after, it->normal);
    for (int a = 0; a < 3 && (left > 0.0 || sum > 0.0); ++a) {
        after[a] += (left - sum) * it->normal[a];
    }
    return it->leaves != 0.0 ? follows / it->leaves : open > 0.0 ? 0.0 : 1.0;
}

/* What a face bears is taken off by what the strain of the mirrored motion, 2 grad W for each meter, needs for it: what
 * the volume would grow beyond that opens the gaps to all faces that are left, each by its part. A face that bears
 * nothing more opens whatever the volume does. */
double mor_soil_contact_find_closure(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane,
                                     int64_t particle, double across, double *gap)
{
    const double *record = soil->records + particle * MOR_RECORD_SIZE;
    const double *growth = soil->growth + MOR_CONTACT_GROWTHS * particle;
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double modulus = across * impedance * impedance / record[MOR_RECORD_DENSITY];
    face_view face;
    double traction[3];
    if (!view_face(contact, soil, lane, particle, &face)) {
        return 1.0;
    }
    mor_symmetric_apply(record + MOR_RECORD_STRESS, face.normal, traction);
    const double bears = mor_soil_contact_held(soil, particle, face.normal) - mor_vector_dot(traction, face.normal);
    const double beyond = mor_max(mor_soil_contact_growth(soil, particle) - bears / modulus, 0.0);
    const double left = growth[MOR_CONTACT_GROWTH_LEFT] * soil->length;
    const double part = bears > 0.0 && left > 0.0 ? 1.0 - mor_min(beyond / left, 1.0) : 0.0;
    const mor_contact_leave leave = {.gap = soil->gap + 3 * particle,
                                     .depth = soil->depth,
                                     .normal = face.normal,
                                     .distance = mor_soil_contact_distance(contact, lane),
                                     .leaves = face.leaves,
                                     .unloads = face.leaves * part};
    return mor_soil_contact_leave_face(&leave, gap + 3 * particle);
}
