/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Gaps between soil that bears tension and faces that only press, (W3b) of docs/theory/walls.md: of each particle up to
 * four, each with the number of its face. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>

/* LEAST: a gap up to this part of the depth of the first layer is rounding. NEAREST: what is nearer to a face than
 * this part of that depth touches it whatever its gap, so that soil does not pass through a face that counts as
 * left. */
#define LEAST 1.0e-9
#define NEAREST 0.5

enum { NO_FACE = 0, KEPT = MOR_CONTACT_GAPS };

/* Returns which of the gaps of a particle is to a face, KEPT if none. A face that has been seen in the step has the
 * negative of its number there. */
static int find_place(const double *faces, double face)
{
    int k = 0;
    while (k < KEPT && fabs(faces[k]) != face) {
        ++k;
    }
    return k;
}

/* Of a particle that has left more faces than are kept, those that come last count as touched.
 * is_open: the gap counts */
static void keep_gap(double gap, bool is_open, double face, double *gaps, double *faces)
{
    const int own = find_place(faces, face);
    const int k = own < KEPT || !is_open ? own : find_place(faces, NO_FACE);
    if (k < KEPT) {
        gaps[k] = is_open ? gap : 0.0;
        faces[k] = is_open ? -face : NO_FACE;
    }
}

void mor_soil_contact_begin_growth(mor_context *context, const mor_contact_soil *soil, const mor_contact_rates *rates)
{
    MOR_PARALLEL_FOR (context, i, soil->growth != NULL ? soil->n_particles : 0, MOR_BLOCK) {
        double *growth = soil->growth + MOR_CONTACT_GROWTHS * i;
        rates->face_growth[i] = growth[MOR_CONTACT_GROWTH_FACES] = growth[MOR_CONTACT_GROWTH_LEFT] = 0.0;
    }
}

void mor_soil_contact_end_gaps(mor_context *context, const mor_contact_soil *soil, const int8_t *sleep,
                               const mor_contact_rates *rates)
{
    MOR_PARALLEL_FOR (context, i, rates->gap != NULL ? soil->n_particles : 0, MOR_BLOCK) {
        double *gaps = rates->gap + KEPT * i;
        double *faces = rates->gap_face + KEPT * i;
        const bool sleeps = mor_sleep_is(sleep, i / MOR_CLUSTER, MOR_SLEEP_ASLEEP);
        for (int k = 0; k < KEPT; ++k) {
            if (!sleeps && faces[k] != NO_FACE) {
                gaps[k] = faces[k] < 0.0 ? gaps[k] : 0.0;
                faces[k] = faces[k] < 0.0 ? -faces[k] : NO_FACE;
            }
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
    face->open = mor_soil_contact_find_gap(contact, soil, lane, i);
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

double mor_soil_contact_gap(const double *gaps, const double *faces, double face, double depth, double distance)
{
    const int k = find_place(faces, face);
    const double open = mor_min(k < KEPT ? gaps[k] : 0.0, distance - NEAREST * depth);
    return open > LEAST * depth ? open : 0.0;
}

double mor_soil_contact_leave_face(const mor_contact_leave *it, double *gaps, double *faces)
{
    const double open = mor_soil_contact_gap(gaps, faces, it->face, it->depth, it->distance);
    double follows = 0.0; /* of the motion, what goes with the face, m */
    if (it->leaves > 0.0) {
        follows = open > 0.0 ? 0.0 : mor_min(it->leaves, it->unloads);
    } else {
        follows = mor_min(it->leaves + open, 0.0);
    }
    const double left = open + it->leaves - follows;
    keep_gap(left, left > LEAST * it->depth, it->face, gaps, faces);
    return it->leaves != 0.0 ? follows / it->leaves : open > 0.0 ? 0.0 : 1.0;
}

/* What a face bears is taken off by what the strain of the mirrored motion, 2 grad W for each meter, needs for it: what
 * the volume would grow beyond that opens the gaps to all faces that are left, each by its part. A face that bears
 * nothing more opens whatever the volume does. */
double mor_soil_contact_find_closure(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane,
                                     int64_t particle, double across, const mor_contact_rates *rates)
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
    const mor_contact_leave leave = {.face = mor_soil_contact_face(contact, lane),
                                     .depth = soil->depth,
                                     .distance = mor_soil_contact_distance(contact, lane),
                                     .leaves = face.leaves,
                                     .unloads = face.leaves * part};
    return mor_soil_contact_leave_face(&leave, rates->gap + KEPT * particle, rates->gap_face + KEPT * particle);
}
