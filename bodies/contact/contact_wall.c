/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Walls that move as prescribed or are removed, and the energy that bodies exchange with them. */
#include "bodies/contact/contact_work.h"

void mor_contact_wall_force(const mor_contact *contact, int wall, uint64_t members, double *force)
{
    memset(force, 0, 3 * sizeof *force);
    for (int g = 0; g < contact->n_groups; ++g) {
        for (int a = 0; a < 3 && (contact->stepper_bits[g] & members) != 0; ++a) {
            force[a] += contact->wall_force[3 * ((int64_t)g * contact->n_walls + wall) + a];
        }
    }
}

void mor_contact_move_walls(mor_contact *contact, double time)
{
    double fastest = 0.0;
    for (int w = 0; w < contact->n_walls; ++w) {
        mor_contact_wall *wall = &contact->walls[w];
        fastest = fmax(fastest, mor_contact_wall_speed(wall));
        wall->is_removed = wall->removed_at > 0.0 && time >= wall->removed_at;
        if (wall->motion != NULL) {
            mor_motion_find(wall->motion, time, &wall->pose);
        }
    }
    contact->work->wall_travel += fastest * fabs(time - contact->time);
    contact->time = time;
}

/* Power of the members' bodies on a wall with a motion, W (W/m). */
static double find_motion_power(const mor_contact *contact, int w, uint64_t members)
{
    const mor_pose *pose = &contact->walls[w].pose;
    double power = 0.0;
    for (int g = 0; g < contact->n_groups; ++g) {
        const int64_t entry = 3 * ((int64_t)g * contact->n_walls + w);
        if ((contact->stepper_bits[g] & members) != 0) {
            power += mor_vector_dot(contact->wall_force + entry, pose->velocity) +
                     mor_vector_dot(contact->wall_moment + entry, pose->angular_velocity);
        }
    }
    return power;
}

void mor_contact_add_wall_energy(mor_contact *contact, uint64_t members, double length)
{
    for (int w = 0; w < contact->n_walls; ++w) {
        double force[3];
        mor_contact_wall_force(contact, w, members, force);
        contact->wall_energy += contact->walls[w].motion != NULL
                                    ? find_motion_power(contact, w, members) * length
                                    : mor_vector_dot(force, contact->walls[w].velocity) * length;
    }
}

void mor_contact_release_removed(mor_contact *contact, uint64_t members)
{
    const mor_contact_work *work = contact->work;
    int64_t pair = 0;
    for (int first = 0; first < work->n_bodies && contact->pair_spring != NULL; ++first) {
        const bool is_member = (contact->stepper_bits[work->bodies[first].group_index] & members) != 0;
        for (int second = first + 1; second < work->n_bodies + contact->n_walls; ++second, ++pair) {
            const bool is_wall = second >= work->n_bodies;
            if (!is_member || (!is_wall && (contact->stepper_bits[work->bodies[second].group_index] & members) == 0)) {
                continue;
            }
            if (!mor_contact_is_side(contact, first) || !mor_contact_is_side(contact, second)) {
                contact->damping_energy += contact->pair_spring[pair];
            }
            contact->pair_spring[pair] = 0.0;
        }
    }
}
