/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/sleep/sleep.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* Clusters a thread takes at once, to decide and to compute. */
enum { GRAIN = 256, CLUSTERS = 32 };

/* Of a cluster that is awake. It changes in the first two steps in which it sleeps, too: its strain rate is set to zero
 * after it was packed in the first. */
enum { CHANGING = 3 };

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

mor_status mor_sleep_init(mor_context *context, mor_sleep *sleep, int64_t n_particles)
{
    const int64_t n = (n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    memset(sleep, 0, sizeof *sleep);
    sleep->n_clusters = n;
    MOR_TRY(context, MOR_NEW(context, &sleep->states, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->calm, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->restless, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->deep, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->at_bodies, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->changing, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->first, n + 1, "neighbors of clusters"));
    MOR_TRY(context, MOR_NEW(context, &sleep->boxes, 6 * n, "boxes of clusters"));
    memset(sleep->changing, CHANGING, (size_t)n);
    return MOR_OK;
}

void mor_sleep_clear(mor_context *context, mor_sleep *sleep)
{
    MOR_FREE(context, &sleep->rests);
    MOR_FREE(context, &sleep->neighbors);
    MOR_FREE(context, &sleep->boxes);
    MOR_FREE(context, &sleep->first);
    MOR_FREE(context, &sleep->changing);
    MOR_FREE(context, &sleep->at_bodies);
    MOR_FREE(context, &sleep->deep);
    MOR_FREE(context, &sleep->restless);
    MOR_FREE(context, &sleep->calm);
    MOR_FREE(context, &sleep->states);
    memset(sleep, 0, sizeof *sleep);
}

mor_status mor_sleep_add_bodies(mor_context *context, mor_sleep *sleep, int n_bodies)
{
    double *rests = NULL;
    MOR_TRY(context, MOR_NEW(context, &rests, (sleep->n_rests + n_bodies) * (int64_t)MOR_SLEEP_REST, "bodies at rest"));
    MOR_FREE(context, &sleep->rests);
    sleep->rests = rests;
    sleep->n_rests += n_bodies;
    return MOR_OK;
}

int mor_sleep_pick_points(int64_t n_points, bool is_deformable, int64_t *points)
{
    const int n = n_points == 0 ? 0 : is_deformable ? MOR_SLEEP_SAMPLES : 3;
    for (int k = 0; k < n; ++k) {
        points[k] = smaller(k * n_points / (n - 1), n_points - 1);
    }
    return n;
}

bool mor_sleep_body_rests(double *rest, const double *const *places, int n_places, double length, double displacement,
                          double after)
{
    double farthest2 = 0.0;
    for (int k = 0; k < n_places; ++k) {
        double moved[3];
        for (int a = 0; a < 3; ++a) {
            moved[a] = places[k][a] - rest[3 * k + a];
        }
        farthest2 = mor_max(farthest2, mor_vector_dot(moved, moved));
    }
    rest[MOR_SLEEP_REST_TIME] += length;
    if (!(farthest2 < displacement * displacement)) {
        rest[MOR_SLEEP_REST_TIME] = 0.0;
        for (int k = 0; k < n_places; ++k) {
            memcpy(rest + 3 * k, places[k], 3 * sizeof *rest);
        }
    }
    return rest[MOR_SLEEP_REST_TIME] >= after;
}

void mor_sleep_forget_bodies(mor_sleep *sleep)
{
    memset(sleep->deep, 0, (size_t)sleep->n_clusters);
    memset(sleep->at_bodies, 0, (size_t)sleep->n_clusters);
}

void mor_sleep_mark_bodies(mor_sleep *sleep, const mor_relation *bodies)
{
    for (int64_t place = 0; place < bodies->n_occupied; ++place) {
        sleep->at_bodies[bodies->occupied[place]] = 1;
    }
}

/* The box of a cluster. */
static void find_box(const mor_sleep *sleep, const mor_sleep_job *job, int64_t cluster)
{
    const mor_tree points = {.n_points = job->n_particles};
    mor_tree_bound_cluster(&points, job->position, 3, cluster, sleep->boxes + 6 * cluster);
}

/* Whether particles of two clusters may be within reach. */
static bool clusters_reach(const mor_sleep *sleep, double reach, int64_t cluster, int64_t other)
{
    return mor_tree_box_gap2(sleep->boxes + 6 * cluster, sleep->boxes + 6 * other) <= reach * reach;
}

/* The particles of a cluster that have not been quiet for long enough. */
static uint8_t find_restless(const mor_sleep_job *job, int64_t cluster)
{
    const int64_t first = cluster * MOR_CLUSTER;
    unsigned found = 0;
    for (int64_t i = first; i < first + MOR_CLUSTER && i < job->n_particles; ++i) {
        const bool is_quiet = job->quiet_time != NULL && job->quiet_time[i] >= job->after;
        found |= is_quiet ? 0U : 1U << (i - first);
    }
    return (uint8_t)found;
}

/* Whether a particle is within reach of one of a cluster. */
static bool particle_reaches(const mor_sleep *sleep, const mor_sleep_job *job, int64_t particle, int64_t cluster)
{
    const double *x = job->position + 3 * particle;
    const double point[6] = {x[0], x[1], x[2], x[0], x[1], x[2]};
    const int64_t end = smaller((cluster + 1) * MOR_CLUSTER, job->n_particles);
    bool does = false;
    if (mor_tree_box_gap2(sleep->boxes + 6 * cluster, point) > job->reach * job->reach) {
        return false;
    }
    for (int64_t i = cluster * MOR_CLUSTER; i < end && !does; ++i) {
        const double *y = job->position + 3 * i;
        const double r[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
        does = mor_vector_dot(r, r) < job->reach * job->reach; /* as lists are complete */
    }
    return does;
}

/* Whether a particle beside a cluster that is not quiet is within reach of one of it. */
static bool sees_restless(const mor_sleep *sleep, const mor_sleep_job *job, int64_t cluster)
{
    bool does = false;
    for (int64_t k = sleep->first[cluster]; k < sleep->first[cluster + 1] && !does; ++k) {
        const int64_t other = sleep->neighbors[k];
        unsigned restless = sleep->restless[other] != 0 && clusters_reach(sleep, job->reach, cluster, other)
                                ? sleep->restless[other]
                                : 0U;
        for (; restless != 0 && !does; restless &= restless - 1) { /* the lowest bit each time */
            does = particle_reaches(sleep, job, other * MOR_CLUSTER + __builtin_ctz(restless), cluster);
        }
    }
    return does;
}

/* Counts the other clusters whose particles a cluster lists; notes them, rising, where there is room. Images, which
 * have no cluster, are on no list: soil does not sleep in periodic domains. */
static int64_t list_clusters(const mor_relation *relation, int64_t cluster, int32_t *found)
{
    mor_relation_cursor cursor = mor_relation_begin(relation, cluster);
    int64_t n = 0;
    int64_t before = -1;
    for (int64_t k = mor_relation_next(&cursor); k >= 0; k = mor_relation_next(&cursor)) {
        const int64_t other = k / MOR_CLUSTER;
        const bool is_new = other != before && other != cluster;
        before = other;
        if (is_new && found != NULL) {
            found[n] = (int32_t)other;
        }
        n += is_new;
    }
    return n;
}

mor_status mor_sleep_find_neighbors(mor_context *context, mor_sleep *sleep, const mor_relation *relation)
{
    const int64_t n = relation->n_clusters;
    sleep->n_clusters = n;
    mor_sleep_forget_bodies(sleep);
    memset(sleep->changing, CHANGING, (size_t)n);
    MOR_PARALLEL_FOR (context, cluster, n, GRAIN) {
        sleep->first[cluster + 1] = list_clusters(relation, cluster, NULL);
    }
    sleep->first[0] = 0;
    for (int64_t cluster = 0; cluster < n; ++cluster) {
        sleep->first[cluster + 1] += sleep->first[cluster];
    }
    const int64_t needed = sleep->first[n];
    if (needed > sleep->capacity) {
        MOR_FREE(context, &sleep->neighbors);
        sleep->capacity = 0;
        MOR_TRY(context, MOR_NEW(context, &sleep->neighbors, needed + needed / 4, "neighbors of clusters"));
        sleep->capacity = needed + needed / 4;
    }
    MOR_PARALLEL_FOR (context, cluster, n, GRAIN) {
        list_clusters(relation, cluster, sleep->neighbors + sleep->first[cluster]);
    }
    return MOR_OK;
}

static bool sees_motion(const mor_sleep *sleep, const mor_sleep_job *job, int64_t cluster)
{
    bool does = false;
    for (int k = 0; k < job->n_moving && !does; ++k) {
        double box[6];
        memcpy(box, job->moving[k].minimum, sizeof job->moving[k].minimum);
        memcpy(box + 3, job->moving[k].maximum, sizeof job->moving[k].maximum);
        does = mor_tree_box_gap2(sleep->boxes + 6 * cluster, box) <= job->reach * job->reach;
    }
    return does;
}

/* Whether all clusters with a particle within reach of one of a cluster have a mark. Lists hold some that are just out
 * of reach, too, and which ones depends on when they were built: that decides how many clusters are held, and what is
 * held is what would be found anew. */
static bool have_all(const mor_sleep *sleep, double reach, int64_t cluster, const int8_t *marks, int8_t least)
{
    for (int64_t k = sleep->first[cluster]; k < sleep->first[cluster + 1]; ++k) {
        if (marks[sleep->neighbors[k]] < least && clusters_reach(sleep, reach, cluster, sleep->neighbors[k])) {
            return false;
        }
    }
    return true;
}

/* Whether a cluster sleeps whatever moves. */
static bool is_held(const mor_sleep_job *job, int64_t cluster)
{
    return job->held != NULL && job->held[cluster];
}

void mor_sleep_decide(mor_context *context, mor_sleep *sleep, const mor_sleep_job *job)
{
    const int64_t n = sleep->n_clusters;
    MOR_PARALLEL_FOR (context, cluster, n, GRAIN) {
        find_box(sleep, job, cluster);
        sleep->restless[cluster] = is_held(job, cluster) ? 0 : find_restless(job, cluster);
        sleep->calm[cluster] =
            (int8_t)(is_held(job, cluster) || (sleep->restless[cluster] == 0 && !sees_motion(sleep, job, cluster)));
    }
    MOR_PARALLEL_FOR (context, cluster, n, GRAIN) {
        const bool sleeps = is_held(job, cluster) || (sleep->calm[cluster] && !sees_restless(sleep, job, cluster));
        sleep->states[cluster] = sleeps ? MOR_SLEEP_ASLEEP : MOR_SLEEP_AWAKE;
    }
    /* Held is more than asleep, so that marking some does not hide others. */
    MOR_PARALLEL_FOR (context, cluster, n, GRAIN) {
        const bool is_deep = sleep->states[cluster] != MOR_SLEEP_AWAKE && !sleep->at_bodies[cluster] &&
                             !(is_held(job, cluster) && sees_motion(sleep, job, cluster)) &&
                             have_all(sleep, job->reach, cluster, sleep->states, MOR_SLEEP_ASLEEP);
        sleep->calm[cluster] = (int8_t)is_deep;
    }
    sleep->n_asleep = 0;
    sleep->n_sleepers = 0;
    for (int64_t cluster = 0; cluster < n; ++cluster) {
        if (sleep->states[cluster] != MOR_SLEEP_AWAKE) {
            sleep->n_asleep += 1;
            sleep->n_sleepers += smaller(MOR_CLUSTER, job->n_particles - cluster * MOR_CLUSTER);
        }
        if (sleep->calm[cluster] && sleep->deep[cluster]) {
            sleep->states[cluster] = MOR_SLEEP_HELD;
        }
        sleep->deep[cluster] = sleep->calm[cluster];
        sleep->changing[cluster] -= sleep->changing[cluster] > 0;
        if (sleep->states[cluster] == MOR_SLEEP_AWAKE || context->is_checked) { /* checks pack all, and change no bit */
            sleep->changing[cluster] = CHANGING;
        }
    }
}

double mor_sleep_bytes(const mor_sleep *sleep)
{
    const double of_cluster = 6.0 + (double)sizeof *sleep->first + 6.0 * (double)sizeof *sleep->boxes;
    return of_cluster * (double)sleep->n_clusters + (double)sleep->capacity * (double)sizeof *sleep->neighbors;
}

void mor_sleep_wake(mor_sleep *sleep)
{
    memset(sleep->states, 0, (size_t)sleep->n_clusters);
    memset(sleep->deep, 0, (size_t)sleep->n_clusters);
    memset(sleep->changing, CHANGING, (size_t)sleep->n_clusters);
    sleep->n_asleep = 0;
    sleep->n_sleepers = 0;
}

/* One past the last cluster from first on that sleeps, or is awake, as first does. */
static int64_t find_run_end(const int8_t *states, int64_t first, int64_t last)
{
    const bool sleeps = mor_sleep_is(states, first, MOR_SLEEP_ASLEEP);
    int64_t end = states == NULL ? last : first;
    while (end < last && mor_sleep_is(states, end, MOR_SLEEP_ASLEEP) == sleeps) {
        ++end;
    }
    return end;
}

int64_t mor_sleep_particles_end(const int8_t *flags, int64_t first, int64_t last)
{
    const int64_t n_clusters = (last + MOR_CLUSTER - 1) / MOR_CLUSTER;
    return smaller(MOR_CLUSTER * find_run_end(flags, first / MOR_CLUSTER, n_clusters), last);
}

void mor_sleep_run(mor_context *context, const int8_t *states, int64_t n_clusters, mor_sleep_work work,
                   const void *owner, const void *job)
{
    MOR_PARALLEL_FOR (context, chunk, (n_clusters + CLUSTERS - 1) / CLUSTERS, 1) {
        const int64_t last = smaller((chunk + 1) * CLUSTERS, n_clusters);
        for (int64_t first = chunk * CLUSTERS, end = 0; first < last; first = end) {
            end = find_run_end(states, first, last);
            work(owner, job, first, end, mor_sleep_is(states, first, MOR_SLEEP_ASLEEP));
        }
    }
}
