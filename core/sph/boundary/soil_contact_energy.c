/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What boundaries take from the motion of the soil, and what they strain of it: (E7) of docs/theory/energy.md. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

/* Adds the powers of one particle and one patch; lane counts from the first slot. */
typedef void (*audit_lane)(const mor_soil_contact *contact, const mor_contact_audit *audit, int64_t lane,
                           int64_t particle);

/* Slot by slot in fixed order, so that the sums of a particle do not depend on the number of threads. */
static void audit_lanes(mor_context *context, const mor_soil_contact *contact, const mor_contact_audit *audit,
                        audit_lane add)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, MOR_CONTACT_GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], audit->n_particles); ++k) {
                add(contact, audit, slot * MOR_CLUSTER + k, first + k);
            }
        }
    }
}

/* Force times the velocity in the middle of the kick: the change of kinetic energy exactly. */
static void add_force(const mor_soil_contact *contact, const mor_contact_audit *audit, int64_t lane, int64_t particle)
{
    const double *record = audit->records + particle * MOR_RECORD_SIZE;
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
    double *powers = audit->powers + MOR_CONTACT_POWERS * particle;
    for (int64_t a = 0; a < 3; ++a) {
        const double middle =
            audit->velocity[3 * particle + a] - 0.5 * audit->length * audit->acceleration[3 * particle + a];
        double force = mass * contact->acceleration[3 * lane + a];
        force += contact->barrier.is_on ? contact->repulsion[3 * lane + a] : 0.0;
        powers[MOR_CONTACT_LOST] -= force * (contact->is_wall ? middle - velocity[a] : middle);
        powers[MOR_CONTACT_GIVEN] -= contact->is_wall ? force * velocity[a] : 0.0;
    }
}

/* The stress in the middle of the step on the strain rates that the mirrored velocity gave, as in the boundary
 * gradient. Where the boundary slips it is friction that strains along it. */
static void add_strain(const mor_soil_contact *contact, const mor_contact_audit *audit, int64_t lane, int64_t particle)
{
    const double *record = audit->records + particle * MOR_RECORD_SIZE;
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[lane / MOR_CLUSTER].patch];
    const double length2 = mor_vector_dot(gradient, gradient);
    const double stick = contact->stick[lane];
    const bool slips =
        mor_soil_contact_friction(patch, audit->region, particle).kind == MOR_WALL_COULOMB && stick < 1.0;
    double *powers = audit->powers + MOR_CONTACT_POWERS * particle;
    double middle[6];
    double relative[3];
    double traction[3];
    for (int a = 0; a < 6; ++a) {
        middle[a] = 0.5 * (record[MOR_RECORD_STRESS + a] + audit->stress[6 * particle + a]);
    }
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - velocity[a];
    }
    mor_symmetric_apply(middle, gradient, traction);
    const double normal = length2 > 0.0 ? mor_vector_dot(relative, gradient) / length2 : 0.0;
    for (int a = 0; a < 3; ++a) {
        const double across = normal * gradient[a];
        powers[MOR_CONTACT_STUCK] -= 2.0 * contact->closure[lane] * across * traction[a];
        powers[slips ? MOR_CONTACT_SLIPPED : MOR_CONTACT_STUCK] -= 2.0 * stick * (relative[a] - across) * traction[a];
    }
}

void mor_soil_contact_audit_forces(mor_context *context, const mor_soil_contact *contact,
                                   const mor_contact_audit *audit)
{
    audit_lanes(context, contact, audit, add_force);
}

void mor_soil_contact_audit_strain(mor_context *context, const mor_soil_contact *contact,
                                   const mor_contact_audit *audit)
{
    audit_lanes(context, contact, audit, add_strain);
}
