/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/sleep/sleep.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* Blocks a thread takes at once. */
enum { GRAIN = 8 };

static int64_t count_blocks(int64_t n_particles)
{
    return (n_particles + MOR_SLEEP_PARTICLES - 1) / MOR_SLEEP_PARTICLES;
}

mor_status mor_sleep_init(mor_context *context, mor_sleep *sleep, int64_t n_particles)
{
    const int64_t n = count_blocks(n_particles);
    memset(sleep, 0, sizeof *sleep);
    sleep->n_blocks = n;
    MOR_TRY(context, MOR_NEW(context, &sleep->states, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->calm, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->deep, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->at_bodies, n, "states of sleep"));
    MOR_TRY(context, MOR_NEW(context, &sleep->first, n + 1, "neighbors of blocks"));
    MOR_TRY(context, MOR_NEW(context, &sleep->cluster_boxes, 6 * n * MOR_SLEEP_CLUSTERS, "boxes of blocks"));
    return MOR_NEW(context, &sleep->boxes, 6 * n, "boxes of blocks");
}

void mor_sleep_clear(mor_context *context, mor_sleep *sleep)
{
    MOR_FREE(context, &sleep->rests);
    MOR_FREE(context, &sleep->neighbors);
    MOR_FREE(context, &sleep->boxes);
    MOR_FREE(context, &sleep->cluster_boxes);
    MOR_FREE(context, &sleep->first);
    MOR_FREE(context, &sleep->at_bodies);
    MOR_FREE(context, &sleep->deep);
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

bool mor_sleep_body_rests(double *rest, const double *const places[3], double length, double displacement, double after)
{
    double farthest2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        double moved[3];
        for (int a = 0; a < 3; ++a) {
            moved[a] = places[k][a] - rest[3 * k + a];
        }
        farthest2 = mor_max(farthest2, mor_vector_dot(moved, moved));
    }
    rest[MOR_SLEEP_REST_TIME] += length;
    if (!(farthest2 < displacement * displacement)) {
        rest[MOR_SLEEP_REST_TIME] = 0.0;
        for (int k = 0; k < 3; ++k) {
            memcpy(rest + 3 * k, places[k], 3 * sizeof *rest);
        }
    }
    return rest[MOR_SLEEP_REST_TIME] >= after;
}

void mor_sleep_forget_bodies(mor_sleep *sleep)
{
    memset(sleep->deep, 0, (size_t)sleep->n_blocks);
    memset(sleep->at_bodies, 0, (size_t)sleep->n_blocks);
}

void mor_sleep_mark_bodies(mor_sleep *sleep, const mor_relation *bodies)
{
    for (int64_t place = 0; place < bodies->n_occupied; ++place) {
        sleep->at_bodies[bodies->occupied[place] / MOR_SLEEP_CLUSTERS] = 1;
    }
}

/* Squared distance of two boxes given by their corners, m2. */
static double find_distance2(const double *minimum, const double *maximum, const double *other_minimum,
                             const double *other_maximum)
{
    double distance2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double gap = mor_max(0.0, mor_max(other_minimum[a] - maximum[a], minimum[a] - other_maximum[a]));
        distance2 += gap * gap;
    }
    return distance2;
}

static void empty_box(double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = INFINITY;
        box[3 + a] = -INFINITY;
    }
}

static void widen_box(double *box, const double *minimum, const double *maximum)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = mor_min(box[a], minimum[a]);
        box[3 + a] = mor_max(box[3 + a], maximum[a]);
    }
}

/* The box of a block, and those of its clusters; one without particles is empty, and far from all. */
static void find_boxes(const mor_sleep *sleep, const mor_sleep_job *job, int64_t block)
{
    double *box = sleep->boxes + 6 * block;
    empty_box(box);
    for (int64_t c = block * MOR_SLEEP_CLUSTERS; c < (block + 1) * MOR_SLEEP_CLUSTERS; ++c) {
        double *own = sleep->cluster_boxes + 6 * c;
        empty_box(own);
        for (int64_t i = c * MOR_CLUSTER; i < (c + 1) * MOR_CLUSTER && i < job->n_particles; ++i) {
            widen_box(own, job->position + 3 * i, job->position + 3 * i);
        }
        widen_box(box, own, own + 3);
    }
}

/* Whether any box of the clusters of a block is within reach of a box. */
static bool clusters_reach(const mor_sleep *sleep, double reach, int64_t block, const double *minimum,
                           const double *maximum)
{
    bool does = false;
    for (int64_t c = block * MOR_SLEEP_CLUSTERS; c < (block + 1) * MOR_SLEEP_CLUSTERS && !does; ++c) {
        const double *own = sleep->cluster_boxes + 6 * c;
        does = find_distance2(own, own + 3, minimum, maximum) <= reach * reach;
    }
    return does;
}

/* Whether particles of two blocks may be within reach. Blocks are no boxes: theirs overlap where they do not touch. */
static bool blocks_reach(const mor_sleep *sleep, double reach, int64_t block, int64_t other)
{
    const double *box = sleep->boxes + 6 * block;
    const double *beside = sleep->boxes + 6 * other;
    bool do_reach = false;
    if (find_distance2(box, box + 3, beside, beside + 3) > reach * reach) {
        return false;
    }
    for (int64_t c = other * MOR_SLEEP_CLUSTERS; c < (other + 1) * MOR_SLEEP_CLUSTERS && !do_reach; ++c) {
        const double *its = sleep->cluster_boxes + 6 * c;
        do_reach = find_distance2(box, box + 3, its, its + 3) <= reach * reach &&
                   clusters_reach(sleep, reach, block, its, its + 3);
    }
    return do_reach;
}

/* Whether all particles of a block have been quiet for long enough. */
static bool is_quiet(const mor_sleep_job *job, int64_t block)
{
    const int64_t end = (block + 1) * MOR_SLEEP_PARTICLES;
    bool is = job->quiet_time != NULL;
    for (int64_t i = block * MOR_SLEEP_PARTICLES; is && i < end && i < job->n_particles; ++i) {
        is = is && job->quiet_time[i] >= job->after;
    }
    return is;
}

/* Counts the blocks whose boxes are within reach of that of a block; notes them where there is room. */
static int64_t walk_boxes(const mor_sleep *sleep, double reach, int64_t block, int32_t *found)
{
    const double *box = sleep->boxes + 6 * block;
    int64_t n = 0;
    for (int64_t other = 0; other < sleep->n_blocks; ++other) {
        const double *beside = sleep->boxes + 6 * other;
        if (other != block && find_distance2(box, box + 3, beside, beside + 3) <= reach * reach) {
            if (found != NULL) {
                found[n] = (int32_t)other;
            }
            n += 1;
        }
    }
    return n;
}

mor_status mor_sleep_find_neighbors(mor_context *context, mor_sleep *sleep, const double *position, int64_t n_particles,
                                    double reach)
{
    const mor_sleep_job job = {.n_particles = n_particles, .position = position};
    sleep->n_blocks = count_blocks(n_particles);
    mor_sleep_forget_bodies(sleep);
    MOR_PARALLEL_FOR (context, block, sleep->n_blocks, GRAIN) {
        find_boxes(sleep, &job, block);
    }
    MOR_PARALLEL_FOR (context, block, sleep->n_blocks, GRAIN) {
        sleep->first[block + 1] = walk_boxes(sleep, reach, block, NULL);
    }
    sleep->first[0] = 0;
    for (int64_t block = 0; block < sleep->n_blocks; ++block) {
        sleep->first[block + 1] += sleep->first[block];
    }
    const int64_t needed = sleep->first[sleep->n_blocks];
    if (needed > sleep->capacity) {
        MOR_FREE(context, &sleep->neighbors);
        sleep->capacity = 0;
        MOR_TRY(context, MOR_NEW(context, &sleep->neighbors, needed + needed / 4, "neighbors of blocks"));
        sleep->capacity = needed + needed / 4;
    }
    MOR_PARALLEL_FOR (context, block, sleep->n_blocks, GRAIN) {
        walk_boxes(sleep, reach, block, sleep->neighbors + sleep->first[block]);
    }
    return MOR_OK;
}

static bool sees_motion(const mor_sleep *sleep, const mor_sleep_job *job, int64_t block)
{
    const double *box = sleep->boxes + 6 * block;
    for (int k = 0; k < job->n_moving; ++k) {
        const mor_sleep_box *it = &job->moving[k];
        if (find_distance2(box, box + 3, it->minimum, it->maximum) <= job->reach * job->reach &&
            clusters_reach(sleep, job->reach, block, it->minimum, it->maximum)) {
            return true;
        }
    }
    return false;
}

/* Whether all blocks within reach have a mark. The lists hold what was within more than that, so that distances of now
 * decide. */
static bool have_all(const mor_sleep *sleep, double reach, int64_t block, const int8_t *marks, int8_t least)
{
    for (int64_t k = sleep->first[block]; k < sleep->first[block + 1]; ++k) {
        if (marks[sleep->neighbors[k]] < least && blocks_reach(sleep, reach, block, sleep->neighbors[k])) {
            return false;
        }
    }
    return true;
}

/* Whether a block sleeps whatever moves. */
static bool is_held(const mor_sleep_job *job, int64_t block)
{
    return job->held != NULL && job->held[block];
}

void mor_sleep_decide(mor_context *context, mor_sleep *sleep, const mor_sleep_job *job)
{
    const int64_t n = sleep->n_blocks;
    MOR_PARALLEL_FOR (context, block, n, GRAIN) {
        find_boxes(sleep, job, block);
        sleep->calm[block] = (int8_t)(is_held(job, block) || (is_quiet(job, block) && !sees_motion(sleep, job, block)));
    }
    MOR_PARALLEL_FOR (context, block, n, GRAIN) {
        const bool sleeps =
            is_held(job, block) || (sleep->calm[block] && have_all(sleep, job->reach, block, sleep->calm, 1));
        sleep->states[block] = sleeps ? MOR_SLEEP_ASLEEP : MOR_SLEEP_AWAKE;
    }
    /* Held is more than asleep, so that marking some does not hide others. */
    MOR_PARALLEL_FOR (context, block, n, GRAIN) {
        const bool is_deep = sleep->states[block] != MOR_SLEEP_AWAKE && !sleep->at_bodies[block] &&
                             !(is_held(job, block) && sees_motion(sleep, job, block)) &&
                             have_all(sleep, job->reach, block, sleep->states, MOR_SLEEP_ASLEEP);
        sleep->calm[block] = (int8_t)is_deep;
    }
    sleep->n_asleep = 0;
    for (int64_t block = 0; block < n; ++block) {
        sleep->n_asleep += sleep->states[block] != MOR_SLEEP_AWAKE;
        if (sleep->calm[block] && sleep->deep[block]) {
            sleep->states[block] = MOR_SLEEP_HELD;
        }
        sleep->deep[block] = sleep->calm[block];
    }
}

void mor_sleep_wake(mor_sleep *sleep)
{
    memset(sleep->states, 0, (size_t)sleep->n_blocks);
    memset(sleep->deep, 0, (size_t)sleep->n_blocks);
    sleep->n_asleep = 0;
}
