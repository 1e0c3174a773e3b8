/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/sleep/quiet.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/sleep/sleep.h"

#include <math.h>
#include <string.h>

/* The square of a symmetric tensor's length. */
static double find_square(const double *t)
{
    return mor_vector_dot(t, t) + 2.0 * mor_vector_dot(t + 3, t + 3);
}

/* Whether a stress is what it was, but for a part. */
static bool has_stress(const mor_quiet_limits *limits, const double *stress, const double *was)
{
    double change[6];
    for (int a = 0; a < 6; ++a) {
        change[a] = stress[a] - was[a];
    }
    const double allowed = limits->stress * (limits->least_stress + sqrt(find_square(was)));
    return find_square(change) < allowed * allowed;
}

/* Whether a particle is quiet in this step. */
static bool is_quiet(const mor_quiet_limits *limits, const mor_quiet_job *job, int64_t i)
{
    const double *v = job->velocity + 3 * i;
    double moved[3];
    for (int a = 0; a < 3; ++a) {
        moved[a] = job->position[3 * i + a] - job->place[3 * i + a];
    }
    return !job->is_none && mor_vector_dot(moved, moved) < limits->displacement * limits->displacement &&
           mor_vector_dot(v, v) < limits->speed * limits->speed &&
           has_stress(limits, job->stress + 6 * i, job->was + 6 * i);
}

void mor_quiet_find(mor_context *context, const mor_quiet_limits *limits, const mor_quiet_job *job)
{
    MOR_PARALLEL_FOR (context, i, job->n_particles, MOR_BLOCK) {
        if (mor_sleep_is(job->states, i / MOR_CLUSTER, MOR_SLEEP_ASLEEP)) {
            continue;
        }
        const bool is = is_quiet(limits, job, i);
        job->quiet[i] = is ? job->quiet[i] + job->length : 0.0;
        job->span[i] += job->length;
        if (!is || job->span[i] >= limits->after) {
            job->span[i] = 0.0;
            memcpy(job->place + 3 * i, job->position + 3 * i, 3 * sizeof *job->place);
            memcpy(job->was + 6 * i, job->stress + 6 * i, 6 * sizeof *job->was);
        }
    }
}
