/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The forces of the soil on a boundary one by one. */
#include "core/sph/boundary/soil_contact_internal.h"

/* What one slot gives, as the sums of the patches count it: reactions to the boundary forces and to the barrier. */
static void visit_slot(const mor_soil_contact *contact, int64_t slot, const double *records, int64_t n_particles,
                       mor_soil_contact_take take, void *job)
{
    const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
    mor_soil_contact_load load = {.patch = contact->slots[slot].patch};
    for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
        const int64_t lane = slot * MOR_CLUSTER + k;
        const double *record = records + (first + k) * MOR_RECORD_SIZE;
        const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
        bool is_any = false;
        for (int a = 0; a < 3; ++a) {
            const double repulsion = contact->barrier.is_on ? contact->repulsion[3 * lane + a] : 0.0;
            load.force[a] = -(mass * contact->acceleration[3 * lane + a] + repulsion);
            is_any = is_any || load.force[a] != 0.0;
        }
        if (is_any) {
            mor_period_wrap(contact->period, record, load.place);
            load.gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
            take(job, &load);
        }
    }
}

/* First slot of a cluster or of a later one; slots are sorted by cluster. */
static int64_t find_slot(const mor_soil_contact *contact, int64_t cluster)
{
    int64_t low = 0;
    int64_t high = contact->n_slots;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if ((int64_t)contact->slots[middle].cluster < cluster) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

void mor_soil_contact_visit(const mor_soil_contact *contact, const double *records, int64_t n_particles, int64_t first,
                            int64_t last, mor_soil_contact_take take, void *job)
{
    const int64_t end = find_slot(contact, last);
    for (int64_t slot = find_slot(contact, first); slot < end; ++slot) {
        visit_slot(contact, slot, records, n_particles, take, job);
    }
}
