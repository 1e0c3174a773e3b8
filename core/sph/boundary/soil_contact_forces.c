/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a boundary does to the soil, slot by slot: kernel sums, boundary forces and its part of the velocity
 * gradient. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = MOR_CONTACT_GRAIN };

/* Tractions below this part of the bulk modulus are rounding, and do not tell whether a particle slides. */
#define NOISE 1.0e-9

/* Shear modulus over rho c0^2, the bulk modulus, by which sliding loads soil, 1: that of Poisson's ratio 2/7. What is
 * stiffer in shear may be loaded by a multiple of what is missing, once: then it slips. */
#define SHEAR 0.5

/* Own traction over the limit of friction from which on soil that is sheared may be stronger than the contact, 1: a
 * traction that stays below is that of soil which yields. */
#define YIELDS 0.9

/* Rate of shear that yielding soil at a boundary may have in a step over what it had in the last, 1: the fit shows a
 * part of the shear of a thin layer. */
#define SPREAD 4.0

/* Largest share of the kernel that a wall is taken to fill: a particle pressed into a wall sees a little over half. */
#define LARGEST_SHARE 0.6

void mor_soil_contact_sum(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                          const mor_pair_constants *constants, const double *records)
{
    const int64_t n = contact->n_slots;
    const double *points = contact->boundary->records;
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 1) {
        const int64_t last = (chunk + 1) * GRAIN < n ? (chunk + 1) * GRAIN : n;
        int64_t first = chunk * GRAIN;
        for (int64_t end; end = mor_soil_contact_next_run(contact, &first, last), first < last; first = end) {
            double *sums = contact->sums + first * MOR_CLUSTER * MOR_KERNEL_SUMS;
            const mor_pair_kernel_job job = {records, points,        MOR_BOUNDARY_RECORD, &contact->relation,
                                             sums,    contact->slots};
            table->kernel(constants, &job, first, end);
            if (contact->normals != NULL) {
                const mor_pair_faces_job faces = {records,         points,         contact->normals,
                                                  contact->depths, contact->slots, contact->seen_faces};
                table->faces(constants, &faces, first, end);
            }
        }
    }
    mor_soil_contact_update_velocity(context, contact, table, constants, records);
}

void mor_soil_contact_update_velocity(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                      const mor_pair_constants *constants, const double *records)
{
    const int64_t n = contact->n_slots;
    if (contact->mean_velocity == NULL) {
        return;
    }
    const double *points = contact->boundary->records;
    const mor_pair_mean_job job = {
        records, points, points + MOR_BOUNDARY_VELOCITY, MOR_BOUNDARY_RECORD, contact->slots, contact->mean_velocity};
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 1) {
        const int64_t first = chunk * GRAIN;
        table->mean(constants, &job, first, first + GRAIN < n ? first + GRAIN : n);
    }
}

void mor_soil_contact_sum_divergence(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                     const mor_pair_constants *constants, const double *records,
                                     const mor_relation *inner, const mor_pair_singles *singles)
{
    const int64_t n = contact->n_slots;
    if (contact->stress == MOR_WALL_STRESS_UNIFORM) {
        return;
    }
    const mor_pair_tangent_job job = {.records = records,
                                      .singles = singles != NULL ? singles->records : NULL,
                                      .is_wide = singles != NULL ? singles->is_wide : NULL,
                                      .inner = inner,
                                      .slots = contact->slots,
                                      .sums = contact->sums,
                                      .out = contact->divergence};
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 1) {
        const int64_t last = (chunk + 1) * GRAIN < n ? (chunk + 1) * GRAIN : n;
        int64_t first = chunk * GRAIN;
        for (int64_t end; end = mor_soil_contact_next_run(contact, &first, last), first < last; first = end) {
            table->tangent(constants, &job, first, end);
        }
    }
}

/* Splits the moment of a boundary's kernel gradient, seen by one particle, into the parts across it and along it, 1;
 * false where it sees nothing. */
static bool split_moment(const double *sums, int dimension, double *across, double *along)
{
    const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
    const double *moment = sums + MOR_KERNEL_SUM_MOMENT;
    const double length2 = mor_vector_dot(gradient, gradient);
    double applied[3];
    if (!(length2 > 0.0)) {
        return false;
    }
    mor_symmetric_apply(moment, gradient, applied);
    *across = mor_vector_dot(applied, gradient) / length2;
    *along = (mor_symmetric_trace(moment) - *across) / (dimension - 1);
    return true;
}

/* What the wall adds to a divergence when it carries a share of the kernel's moment and the soil the rest. */
static double continuation(double share)
{
    const double limited = share < LARGEST_SHARE ? share : LARGEST_SHARE;
    return limited / (1.0 - limited);
}

/* Continues the soil's stress into the wall. At a smooth wall the mirror image's shear has the other sign. */
static void add_continuation(const mor_soil_contact *contact, mor_wall_friction friction, int64_t lane,
                             const double *record, double *acceleration)
{
    const double *sums = contact->sums + lane * MOR_KERNEL_SUMS;
    const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
    const double *divergence = contact->divergence + 6 * lane;
    double across = 0.0;
    double along = 0.0;
    if (!split_moment(sums, contact->dimension, &across, &along)) {
        return;
    }
    const double length2 = mor_vector_dot(gradient, gradient);
    const double factor_along = continuation(along) / record[MOR_RECORD_DENSITY];
    const double factor_across =
        contact->stress == MOR_WALL_STRESS_LINEAR ? continuation(across) / record[MOR_RECORD_DENSITY] : 0.0;
    const double flip = friction == MOR_WALL_SMOOTH ? 2.0 * mor_vector_dot(divergence, gradient) / length2 : 0.0;
    for (int a = 0; a < 3; ++a) {
        acceleration[a] += factor_along * (divergence[a] - flip * gradient[a]) + factor_across * divergence[3 + a];
    }
}

/* Closing speed as the limiter counts it, eq. 23 with the one-sided states of eqs. 32-34. */
static double limited_speed(double closing, mor_dissipation dissipation)
{
    if (dissipation == MOR_DISSIPATION_SEPARATION) {
        return closing < 0.0 ? -closing : 0.0;
    }
    return dissipation == MOR_DISSIPATION_APPROACH && closing < 0.0 ? 0.0 : fabs(closing);
}

/* What the boundary force on a particle depends on beside the particle. */
typedef struct boundary_terms {
    mor_dissipation dissipation;
    bool coulomb_pulls;             /* a boundary with Coulomb friction holds soil under tension */
    bool limits_all;                /* Coulomb friction limits the continued stress, too */
    double limiter_rate;            /* eta / c0 of the particle's soil, s/m */
    bool frees;                     /* dissipation does not pull at soil that is not pressed against the boundary */
    mor_boundary_friction friction; /* of that soil with the patch */
    const double *velocity;         /* of the boundary, m/s */
    const double *gradient;         /* sum V grad_i W, 1/m */
    const double *repulsion;        /* acceleration by the barrier, m/s2; NULL without */
    const double *strain_rate;      /* of the particle, 1/s; NULL: coulomb_pulls */
    double across;                  /* stiffness across the face over rho c0^2, 1; 0: no gap is kept */
    double gap;                     /* between the particle and the face, m */
    double held;                    /* tension that the face bears for a moment, Pa */
    double growth;                  /* of its volume in the step if the faces mirror all, 1 */
    double step;                    /* length of the step, s */
} boundary_terms;

/* The parts of the motion of a particle that a boundary mirrors, 1. */
typedef struct mirrored {
    double along, across;
} mirrored;

/* The part of the motion of a particle along a boundary that shears the soil between it and the face, 0 to 1; the rest
 * is slip, (W3a). A step may shear the soil until its traction is the limit of friction, as soil does that sticks, and
 * as fast as it was sheared in the last step if its traction has stayed below the limit: it yields there, before it
 * slips. All slip shears no soil: it would bear its strength, in place of the friction that acts on it.
 * used: own traction against the motion over the limit, 1; slip: motion along the boundary, m/s; limit: of friction,
 * m/s2 */
static double find_stick(const boundary_terms *p, const double *record, const double *normal, double used,
                         const double *slip, double limit)
{
    const double density = record[MOR_RECORD_DENSITY];
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double speed = mor_vector_length(slip);
    const double strain = 2.0 * mor_vector_length(p->gradient); /* by the unit of length that is mirrored, 1/m */
    const double modulus = SHEAR * impedance * impedance / density;
    const double yields = mor_max(mor_min((1.0 - used) / (1.0 - YIELDS), 1.0), 0.0);
    double shear[3];
    if (!(used < 1.0)) {
        return 0.0;
    }
    if (!(speed > 0.0)) {
        return 1.0;
    }
    mor_symmetric_apply(p->strain_rate, normal, shear);
    const double rate = mor_max(2.0 * mor_vector_dot(shear, slip) / speed, 0.0);
    const double loads = limit * (1.0 - used) / (strain / density * modulus * p->step);
    const double allowed = (loads + SPREAD * yields * rate) / strain;
    return allowed < speed ? allowed / speed : 1.0;
}

/* Friction of soil that slides faster than elastic waves explain: where its speed along the boundary exceeds that of a
 * wave as large as the limit of friction, friction becomes the limit against the motion, fully so at twice that speed.
 * The stress of the particle, which a strong soil keeps whatever its motion, then has no part in it. */
static void resist_sliding(const double *slip, double limit, double wave_speed, double *tangential)
{
    const double speed = mor_vector_length(slip);
    const double share = speed > wave_speed ? mor_min(speed / wave_speed - 1.0, 1.0) : 0.0;
    for (int a = 0; a < 3 && share > 0.0; ++a) {
        tangential[a] += share * (-limit * slip[a] / speed - tangential[a]);
    }
}

/* Adds what continues the stress along a Coulomb wall: all of it where soil slides up to the speed of a wave as large
 * as the pressure on the wall, none from twice that speed on, where friction alone is to resist.
 * slip: acceleration by a wave of the sliding speed, m/s2; along: normal acceleration, m/s2 */
static void add_along_wall(const double *continuation, double slip, double along, double *tangential)
{
    const double kept = slip >= 2.0 * along ? 0.0 : slip <= along ? 1.0 : 2.0 - slip / along;
    for (int a = 0; a < 3; ++a) {
        tangential[a] += kept * continuation[a];
    }
}

/* Acceleration along a Coulomb boundary that its friction allows, m/s2; the barrier contributes to the normal force.
 * along: normal acceleration, m/s2 */
static double friction_limit(const boundary_terms *p, double along)
{
    const double *gradient = p->gradient;
    double pressing = along;
    if (p->repulsion != NULL) {
        const double length = mor_vector_length(gradient);
        const double normal[3] = {-gradient[0] / length, -gradient[1] / length, -gradient[2] / length};
        pressing += mor_vector_dot(p->repulsion, normal);
    }
    return p->friction.coefficient * (pressing > 0.0 ? pressing : 0.0);
}

/* Brings a tangential acceleration down to its limit, m/s2; returns the part of the tangential motion that is mirrored.
 * area: acceleration by a unit of traction, 1/(m kg/m3) */
static double limit_friction(const double *record, double limit, double area, double *tangential)
{
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double trial = mor_vector_length(tangential);
    const double noise = area * NOISE * impedance * impedance / record[MOR_RECORD_DENSITY];
    const double hold = trial > limit ? limit / trial : 1.0;
    for (int a = 0; a < 3; ++a) {
        tangential[a] *= hold;
    }
    return trial > limit ? (limit + noise) / (trial + noise) : 1.0;
}

/* Pressure by the one-sided Riemann problem, eqs. 32 to 34, Pa.
 * closing: speed towards the boundary, m/s; pressed: pressure of the particle's stress on it, Pa */
static double find_riemann_pressure(const boundary_terms *p, const double *record, double closing, double pressed)
{
    const double slope = 2.0 * p->limiter_rate * limited_speed(closing, p->dissipation);
    const double pressure = (slope < 1.0 ? slope : 1.0) * record[MOR_RECORD_IMPEDANCE] * closing;
    return p->frees ? mor_max(pressure, -mor_max(pressed, 0.0)) : pressure;
}

/* The part of the step in which the particle touches the boundary, (W3c), 1: not before it has closed its gap. */
static double find_touch(const boundary_terms *p, double closing)
{
    const double comes = closing * p->step;
    return p->gap > 0.0 ? comes > p->gap ? 1.0 - p->gap / comes : 0.0 : 1.0;
}

/* Acceleration by a boundary that only presses, (W3c), m/s2: that of the particle's own stress, down to the tension
 * that the face bears for a moment, and what continues it, which is no larger. Where the particle leaves, the mean of
 * what falls to that tension within the step.
 * closing: speed towards the boundary, m/s */
static double press(const boundary_terms *p, const double *record, double closing, double own, double continued)
{
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double density = record[MOR_RECORD_DENSITY];
    const double touch = find_touch(p, closing);
    const double unit = 2.0 * mor_vector_length(p->gradient) / density; /* 1/(m kg/m3) */
    const double held = unit * p->held;
    const double pressing = mor_max(own, -held);
    const double bound = mor_max(pressing, held);
    const double along = mor_max(pressing + mor_max(mor_min(continued, bound), -bound), -held);
    /* The volume grows by (p + held) / M until the face lets go; half of that takes the mean of both pressures. */
    const double lasts = 0.5 * (pressing + held) / (unit * p->across * impedance * impedance / density);
    const double most = p->growth > lasts
                            ? (pressing + held) * lasts / p->growth - held * mor_min(1.0, 2.0 * lasts / p->growth)
                            : along;
    return touch * (closing < 0.0 ? mor_min(along, most) : along);
}

/* Brings the tangential acceleration by the stress of a particle at a Coulomb boundary, and at a body by what continues
 * it, to that by friction, m/s2; returns the part of the motion along the boundary that is mirrored. Where the boundary
 * holds soil under tension the traction alone tells whether it slips.
 * slip: motion along the boundary, m/s; on return what of it is slip */
static double find_friction(const boundary_terms *p, const double *record, const double *normal, double limit,
                            double *slip, double *tangential)
{
    const double area = 2.0 * mor_vector_length(p->gradient) / record[MOR_RECORD_DENSITY];
    const double resists = -mor_vector_dot(tangential, slip);
    const double used = !(limit > 0.0) ? INFINITY : resists != 0.0 ? resists / (limit * mor_vector_length(slip)) : 0.0;
    const double held = limit_friction(record, limit, area, tangential);
    if (p->coulomb_pulls) {
        return held;
    }
    const double stick = find_stick(p, record, normal, used, slip, limit);
    for (int a = 0; a < 3; ++a) {
        slip[a] *= 1.0 - stick;
    }
    resist_sliding(slip, limit, limit / (area * record[MOR_RECORD_IMPEDANCE]), tangential);
    return stick;
}

/* Adds the acceleration of one particle by the wall to what the continued stress gave. A boundary that only presses
 * does not pull, and does not press across a gap. Where no gap is kept it mirrors no motion across where it would have
 * to pull. */
static mirrored find_boundary_acceleration(const boundary_terms *p, const double *record, double *acceleration)
{
    const double *gradient = p->gradient;
    const double length = mor_vector_length(gradient);
    if (!(length > 0.0)) {
        return (mirrored){1.0, 1.0};
    }
    double normal[3];
    double relative[3];
    mor_soil_contact_normal(gradient, normal);
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - p->velocity[a];
    }
    const double closing = -mor_vector_dot(relative, normal);
    double traction[3];
    mor_symmetric_apply(record + MOR_RECORD_STRESS, normal, traction);
    const double pressure = find_riemann_pressure(p, record, closing, -mor_vector_dot(traction, normal));
    const double factor = -2.0 * length / record[MOR_RECORD_DENSITY];
    const double own = factor * (mor_vector_dot(traction, normal) - pressure);
    const double continued = mor_vector_dot(acceleration, normal);
    const bool is_coulomb = p->friction.kind == MOR_WALL_COULOMB;
    const bool only_presses = is_coulomb && !p->coulomb_pulls;
    const bool is_pulled = only_presses && own + continued < 0.0 && mor_vector_dot(traction, normal) > 0.0;
    const double along = p->across > 0.0 ? press(p, record, closing, own, continued)
                         : only_presses  ? mor_max(own + continued, 0.0)
                                         : own + continued;
    const bool continues_freely = is_coulomb && !p->limits_all;
    double stick = p->friction.kind == MOR_WALL_SMOOTH ? 0.0 : 1.0;
    double tangential[3];
    double continuation[3]; /* of the stress along a Coulomb wall, which is no friction */
    double slip[3];
    for (int a = 0; a < 3; ++a) {
        tangential[a] = stick * (factor * (traction[a] - pressure * normal[a]) - own * normal[a]);
        continuation[a] = acceleration[a] - continued * normal[a];
        if (!continues_freely) {
            tangential[a] = tangential[a] + acceleration[a] - continued * normal[a];
        }
        slip[a] = relative[a] + closing * normal[a];
    }
    if (is_coulomb) {
        const double limit = friction_limit(p, along);
        const double drag = -factor * record[MOR_RECORD_IMPEDANCE];
        const double speed = mor_vector_length(slip);
        stick = find_friction(p, record, normal, limit, slip, tangential);
        if (continues_freely) {
            add_along_wall(continuation, speed * drag, along, tangential);
        }
    }
    for (int a = 0; a < 3; ++a) {
        acceleration[a] = along * normal[a] + tangential[a];
    }
    return (mirrored){p->across > 0.0 && along == 0.0 ? 0.0 : stick, is_pulled ? 0.0 : 1.0};
}

/* In a corner the normals of all walls direct what the sums of one give along another. The stress acts on the wall
 * whose points these sums are of: what neighboring walls hand over adds up to nothing. */
static void attribute_corner(const double *transfer, const double *record, double *acceleration)
{
    double traction[3];
    mor_symmetric_apply(record + MOR_RECORD_STRESS, transfer, traction);
    for (int a = 0; a < 3; ++a) {
        acceleration[a] += 2.0 / record[MOR_RECORD_DENSITY] * traction[a];
    }
}

/* What is kept of the contact of a particle with a boundary that only presses. */
static void find_contact(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane, int64_t particle,
                         boundary_terms *p)
{
    double normal[3];
    p->gap = p->growth = p->held = 0.0;
    if (p->across > 0.0 && mor_vector_length(p->gradient) > 0.0) {
        mor_soil_contact_normal(p->gradient, normal);
        p->gap = mor_soil_contact_find_gap(contact, soil, lane, particle);
        p->growth = mor_soil_contact_growth(soil, particle);
        p->held = mor_soil_contact_held(soil, particle, normal);
    }
}

/* Finds the boundary forces of one slot and adds them to the acceleration of its particles. */
static void add_slot_acceleration(mor_soil_contact *contact, const mor_contact_soil *soil, int64_t slot,
                                  double *acceleration)
{
    const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
    const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[slot].patch];
    boundary_terms p = {.dissipation = soil->dissipation,
                        .coulomb_pulls = soil->coulomb_pulls,
                        .limits_all = mor_soil_contact_limits_all(contact, soil->coulomb_pulls),
                        .limiter_rate = soil->limiter_rate,
                        .frees = contact->normals != NULL,
                        .step = soil->length};
    for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], soil->n_particles); ++k) {
        const int64_t lane = slot * MOR_CLUSTER + k;
        const int64_t i = first + k;
        const double *record = soil->records + i * MOR_RECORD_SIZE;
        const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
        double *own = contact->acceleration + 3 * lane;
        double repulsion[3] = {0.0, 0.0, 0.0};
        own[0] = own[1] = own[2] = 0.0;
        p.friction = mor_soil_contact_friction(patch, soil->region, i);
        if (contact->stress != MOR_WALL_STRESS_UNIFORM) {
            add_continuation(contact, p.friction.kind, lane, record, own);
        }
        for (int a = 0; a < 3 && contact->barrier.is_on; ++a) {
            repulsion[a] = contact->repulsion[3 * lane + a] / mass;
        }
        if (soil->of_soil != NULL) {
            p.limiter_rate = 2.0 * soil->of_soil[i * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_LIMITER];
        }
        p.strain_rate = soil->strain_rate != NULL ? soil->strain_rate + 6 * i : NULL;
        p.velocity = mor_soil_contact_velocity(contact, lane);
        p.gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
        p.repulsion = contact->barrier.is_on ? repulsion : NULL;
        p.across = mor_soil_contact_across(soil, p.friction.kind, i);
        find_contact(contact, soil, lane, i, &p);
        const mirrored parts = find_boundary_acceleration(&p, record, own);
        contact->stick[lane] = parts.along;
        contact->closure[lane] = parts.across;
        for (int a = 0; a < 3; ++a) {
            acceleration[i * 3 + a] += contact->barrier.is_on ? own[a] + repulsion[a] : own[a];
        }
        if (contact->transfer != NULL) {
            attribute_corner(contact->transfer + 3 * lane, record, own);
        }
    }
}

/* Force and moment of one patch. Serial on purpose: the sums then do not depend on the number of threads. */
static void sum_patch(mor_soil_contact *contact, int patch, const double *records, int64_t n_particles)
{
    double force[3] = {0.0, 0.0, 0.0};
    double moment[3] = {0.0, 0.0, 0.0};
    for (int32_t k = contact->first_of_patch[patch]; k < contact->first_of_patch[patch + 1]; ++k) {
        const int64_t slot = contact->patch_slots[k];
        const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
        for (int64_t lane = 0; lane < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++lane) {
            const double *record = records + (first + lane) * MOR_RECORD_SIZE;
            const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
            const double *own = contact->acceleration + (slot * MOR_CLUSTER + lane) * 3;
            const double *repulsion =
                contact->barrier.is_on ? contact->repulsion + (slot * MOR_CLUSTER + lane) * 3 : NULL;
            double part[3];
            for (int a = 0; a < 3; ++a) {
                part[a] = repulsion != NULL ? mass * own[a] + repulsion[a] : mass * own[a];
                force[a] -= part[a];
            }
            double place[3];
            mor_period_wrap(contact->period, record, place);
            mor_vector_cross_add(-1.0, place, part, moment);
        }
    }
    memcpy(contact->boundary->patches[patch].force, force, sizeof force);
    memcpy(contact->boundary->patches[patch].moment, moment, sizeof moment);
}

void mor_soil_contact_sum_forces(mor_context *context, mor_soil_contact *contact, const mor_contact_soil *soil,
                                 double *acceleration)
{
    const int n_patches = contact->boundary->n_patches;
    if (contact->barrier.is_on) {
        mor_soil_contact_repel(context, contact, soil->records, soil->n_particles);
    }
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        const bool is_held = mor_sleep_is(contact->sleep, contact->relation.occupied[place], MOR_SLEEP_HELD);
        for (int64_t slot = contact->first_slot[place]; !is_held && slot < contact->first_slot[place + 1]; ++slot) {
            add_slot_acceleration(contact, soil, slot, acceleration);
        }
    }
    MOR_PARALLEL_FOR (context, patch, n_patches, 1) {
        sum_patch(contact, (int)patch, soil->records, soil->n_particles);
    }
    memset(contact->force, 0, sizeof contact->force);
    for (int p = 0; p < n_patches; ++p) {
        for (int a = 0; a < 3; ++a) {
            contact->force[a] += contact->boundary->patches[p].force[a];
        }
    }
}

/* Velocity that the wall's mirror image has beyond the particle's own, 2 (u - v) where it sticks. */
static void mirror_motion(mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane, int64_t particle,
                          const mor_contact_rates *rates, double *difference)
{
    const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[lane / MOR_CLUSTER].patch];
    const mor_wall_friction friction = mor_soil_contact_friction(patch, soil->region, particle).kind;
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const double *record = soil->records + particle * MOR_RECORD_SIZE;
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    const double length2 = mor_vector_dot(gradient, gradient);
    double relative[3];
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - velocity[a];
    }
    const double across = length2 > 0.0 ? mor_vector_dot(relative, gradient) / length2 : 0.0;
    const double stiffness = mor_soil_contact_across(soil, friction, particle);
    if (stiffness > 0.0) {
        contact->closure[lane] = mor_soil_contact_find_closure(contact, soil, lane, particle, stiffness, rates);
        rates->face_growth[particle] -= 2.0 * contact->closure[lane] * across * length2;
    }
    for (int a = 0; a < 3; ++a) {
        const double normal = across * gradient[a];
        difference[a] = -2.0 * (contact->closure[lane] * normal + contact->stick[lane] * (relative[a] - normal));
    }
}

static void add_slot_gradient(mor_soil_contact *contact, const mor_contact_soil *soil, int64_t slot,
                              const mor_contact_rates *rates)
{
    const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
    for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], soil->n_particles); ++k) {
        const int64_t lane = slot * MOR_CLUSTER + k;
        const int64_t i = first + k;
        const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
        const double *record = soil->records + i * MOR_RECORD_SIZE;
        double difference[3];
        mirror_motion(contact, soil, lane, i, rates, difference);
        for (int a = 0; a < 9; ++a) {
            rates->velocity_gradient[i * 9 + a] += difference[a / 3] * gradient[a % 3];
        }
        rates->density_rate[i] -= record[MOR_RECORD_DENSITY] * mor_vector_dot(difference, gradient);
    }
}

void mor_soil_contact_sum_gradient(mor_context *context, mor_soil_contact *contact, const mor_contact_soil *soil,
                                   const mor_contact_rates *rates)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        const bool sleeps = mor_sleep_is(contact->sleep, contact->relation.occupied[place], MOR_SLEEP_ASLEEP);
        for (int64_t slot = contact->first_slot[place]; !sleeps && slot < contact->first_slot[place + 1]; ++slot) {
            add_slot_gradient(contact, soil, slot, rates);
        }
    }
}

static void add_slot_moments(const mor_soil_contact *contact, int64_t slot, int64_t n_particles,
                             const mor_wall_clusters *at)
{
    const int64_t first = mor_wall_clusters_first(at->places, contact->slots[slot].cluster);
    for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
        const int64_t lane = slot * MOR_CLUSTER + k;
        const double *sums = contact->sums + lane * MOR_KERNEL_SUMS;
        const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
        const double stick = contact->stick[lane];
        const double closure = contact->closure[lane];
        double across = 0.0;
        double along = 0.0;
        if (!split_moment(sums, contact->dimension, &across, &along)) {
            continue;
        }
        const double length2 = mor_vector_dot(gradient, gradient);
        for (int a = 0; a < 6; ++a) {
            const double square = gradient[a % 3] * gradient[a < 3 ? a : (a - 2) % 3] / length2;
            const double flat = along * ((a < contact->dimension ? 1.0 : 0.0) - square);
            at->closed[6 * (first + k) + a] += closure * across * square + stick * flat;
            at->continued[6 * (first + k) + a] += closure * (1.0 - stick) * flat;
        }
    }
}

void mor_soil_contact_add_moments(mor_context *context, const mor_soil_contact *contact, int64_t n_particles,
                                  const mor_wall_clusters *at)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        const bool sleeps = mor_sleep_is(contact->sleep, contact->relation.occupied[place], MOR_SLEEP_ASLEEP);
        for (int64_t slot = contact->first_slot[place]; !sleeps && slot < contact->first_slot[place + 1]; ++slot) {
            add_slot_moments(contact, slot, n_particles, at);
        }
    }
}
