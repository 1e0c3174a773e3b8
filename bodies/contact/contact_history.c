/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What contacts keep from one sub-step to the next: friction springs and speeds of impact. */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"

#include <stdlib.h>
#include <string.h>

void mor_contact_list_history(mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const double *partners = contact->history.data[work->field_partners];
    if (work->is_warm) {
        return;
    }
    for (int64_t k = 0; k < MOR_CONTACT_SLOTS * contact->history.n_particles; ++k) {
        if (partners[k] != 0.0) {
            work->held_slots[work->n_held++] = k;
        }
    }
    for (int64_t k = 0; k < work->n_pairs; ++k) {
        if (contact->impacts[k] > 0.0) {
            work->hit_pairs[work->n_hit++] = k;
        }
    }
    work->is_warm = true;
}

/* The body whose node an entry of the history is. */
static int body_of_entry(const mor_contact *contact, int64_t entry)
{
    const mor_contact_work *work = contact->work;
    int b = work->n_bodies - 1;
    while (work->first_node[work->bodies[b].group_index] +
               work->bodies[b].group->bodies[work->bodies[b].body].first_node >
           entry) {
        --b;
    }
    return b;
}

/* Empties a slot whose contact ended; the energy left in its spring is lost. */
static void release_slot(mor_contact *contact, int64_t slot, int own)
{
    const mor_contact_work *work = contact->work;
    const int64_t entry = slot / MOR_CONTACT_SLOTS;
    double *partner = contact->history.data[work->field_partners] + slot;
    double *spring = contact->history.data[work->field_springs] + 3 * slot;
    if (*partner == 0.0) {
        return; /* cleared from outside, as at the end of a settling */
    }
    const int other = (int)*partner - 1;
    const mor_contact_near pair = {.first = own < other ? own : other, .second = own < other ? other : own};
    const double stiffness =
        MOR_CONTACT_TANGENTIAL_RATIO * mor_contact_stiffness(contact, &pair, own < other ? 0 : 1,
                                                             entry - work->first_node[work->bodies[own].group_index]);
    contact->friction_energy += 0.5 * stiffness * mor_vector_dot(spring, spring);
    *partner = 0.0;
    memset(spring, 0, 3 * sizeof *spring);
}

static int compare_slots(const void *a, const void *b)
{
    const int64_t first = *(const int64_t *)a;
    const int64_t second = *(const int64_t *)b;
    return (first > second) - (first < second);
}

/* Removes the springs of contacts that ended; those of other members' bodies stay. Energies are summed by rising slot:
 * the order in which slots came into use is not part of the state. */
static void release_slots(mor_contact *contact, uint64_t members)
{
    mor_contact_work *work = contact->work;
    int64_t n_ended = 0; /* at the front of held_slots */
    for (int64_t k = 0; k < work->n_held; ++k) {
        const int64_t slot = work->held_slots[k];
        if (work->slot_mark[slot] != 0) {
            continue;
        }
        const int own = body_of_entry(contact, slot / MOR_CONTACT_SLOTS);
        if ((contact->stepper_bits[work->bodies[own].group_index] & members) != 0) {
            work->held_slots[n_ended++] = slot;
        } else {
            work->kept_slots[work->n_kept++] = slot;
        }
    }
    if (n_ended > 1) {
        qsort(work->held_slots, (size_t)n_ended, sizeof *work->held_slots, compare_slots);
    }
    for (int64_t k = 0; k < n_ended; ++k) {
        const int64_t slot = work->held_slots[k];
        release_slot(contact, slot, body_of_entry(contact, slot / MOR_CONTACT_SLOTS));
    }
    for (int64_t k = 0; k < work->n_kept; ++k) {
        work->slot_mark[work->kept_slots[k]] = 0;
    }
    int64_t *slots = work->held_slots;
    work->held_slots = work->kept_slots;
    work->kept_slots = slots;
    work->n_held = work->n_kept;
}

static void release_impacts(mor_contact *contact, uint64_t members)
{
    mor_contact_work *work = contact->work;
    for (int64_t k = 0; k < work->n_hit; ++k) {
        const int64_t pair = work->hit_pairs[k];
        int first = 0;
        while (mor_contact_pair_index(contact, first + 1, first + 2) <= pair && first + 1 < work->n_bodies) {
            ++first;
        }
        if (work->pair_mark[pair] != 0) {
            continue;
        }
        if ((contact->stepper_bits[work->bodies[first].group_index] & members) != 0) {
            contact->impacts[pair] = 0.0;
        } else {
            work->kept_pairs[work->n_kept_pairs++] = pair;
        }
    }
    for (int64_t k = 0; k < work->n_kept_pairs; ++k) {
        work->pair_mark[work->kept_pairs[k]] = 0;
    }
    int64_t *pairs = work->hit_pairs;
    work->hit_pairs = work->kept_pairs;
    work->kept_pairs = pairs;
    work->n_hit = work->n_kept_pairs;
}

void mor_contact_release_history(mor_contact *contact, uint64_t members)
{
    release_slots(contact, members);
    release_impacts(contact, members);
}
