/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SLEEP_SLEEP_H
#define MOR_CORE_SPH_SLEEP_SLEEP_H

#include "core/particle/relation.h"

/** @file
 *  Soil that has come to rest sleeps: it is left out of the steps until something moves beside it. Particles are taken
 *  in the clusters of eight that they are computed in. A cluster is calm when all its particles have stayed below the
 *  limits for a time and no body or wall moves within its reach; it sleeps while it is calm and all particles within
 *  reach of its own have stayed below the limits, so that soil that is computed never loses a neighbor that moves. What
 *  is decided is a function of positions, times of calm and order alone, whenever the lists were built, so that a
 *  resumed run decides alike. Theory: docs/theory/sleep.md. */

/** What a cluster does in a step. */
enum {
    MOR_SLEEP_AWAKE,  /* it is computed */
    MOR_SLEEP_ASLEEP, /* it stands still, but what walls do to it is found, for its neighbors may move */
    MOR_SLEEP_HELD    /* it and all its neighbors slept in the last step, too: what walls do to it is known */
};

/** What is kept of a body to tell whether it rests. */
enum {
    MOR_SLEEP_SAMPLES = 16,    /* points of a body that are followed, at most */
    MOR_SLEEP_REST_PLACES = 0, /* shape [MOR_SLEEP_SAMPLES, 3]; where those were when it last moved on, m */
    MOR_SLEEP_REST_TIME = 3 * MOR_SLEEP_SAMPLES, /* since then, s */
    MOR_SLEEP_REST
};

/** Clusters of particles, and which of them sleep. Owner: the soil. */
typedef struct mor_sleep {
    int8_t *states;      /* shape [clusters]; as above; NULL: none ever sleeps */
    int8_t *calm;        /* shape [clusters]; scratch, 1: no particle and nothing beside it moves */
    uint8_t *restless;   /* shape [clusters]; scratch, bit k: particle k of it is not quiet */
    int8_t *deep;        /* shape [clusters]; 1: it and all its neighbors slept in the last step */
    int8_t *at_bodies;   /* shape [clusters]; 1: points of bodies are on its lists */
    int8_t *changing;    /* shape [clusters]; 3: it is awake, or lists were built; 2, 1: it sleeps, but is packed; 0:
                          * nothing of it has changed since it was packed */
    double *boxes;       /* shape [clusters, 6]; minimum and maximum corner of the particles, m */
    int64_t *first;      /* shape [clusters + 1]; of each cluster's neighbors, and one past the last */
    int32_t *neighbors;  /* shape [capacity]; clusters beside each cluster, without itself */
    double *rests;       /* shape [n_rests, MOR_SLEEP_REST]; of bodies, units of the enum; NULL: there are none */
    int64_t n_rests;     /* patches of bodies */
    int64_t capacity;    /* neighbors there is room for */
    int64_t n_clusters;  /* in use */
    int64_t n_asleep;    /* clusters that sleep in this step */
    int64_t n_sleepers;  /* their particles, which stay, whoever leaves at the end of the step */
    double momentum[3];  /* taken from particles that fell asleep, kg m/s (kg/s) */
    double kinetic;      /* energy taken likewise, J (J/m) */
    double impulse[3];   /* given by soil that was computed to soil that slept, N s (N s/m) */
    uint64_t n_left_out; /* particle-steps that were not computed */
} mor_sleep;

/** Something that moves: what is near does not sleep. */
typedef struct mor_sleep_box {
    double minimum[3], maximum[3]; /* corners, m */
} mor_sleep_box;

/** What is decided by. Borrowed. */
typedef struct mor_sleep_job {
    int64_t n_particles;
    const double *position;   /* shape [n_particles, 3], m */
    const double *quiet_time; /* shape [n_particles]; for which each has stayed below the limits, s; NULL: for none */
    const int8_t *held;       /* shape [clusters]; 1: it sleeps whatever moves; NULL: none does */
    double after;             /* time of calm after which a particle may sleep, s */
    double reach;             /* support of the kernel, m */
    const mor_sleep_box *moving; /* shape [n_moving] */
    int n_moving;
} mor_sleep_job;

/** Makes room for a number of particles; all are awake.
 *  @param sleep       [out]  cleared with mor_sleep_clear, also after a failure
 *  @param n_particles [in]   largest number of particles there will be, >= 1
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_sleep_init(mor_context *context, mor_sleep *sleep, int64_t n_particles);

/** Frees what it owns; accepts a zeroed one. */
void mor_sleep_clear(mor_context *context, mor_sleep *sleep);

/** Finds which clusters list particles of one another, after each build of the lists.
 *  @param relation [in]  built, of the particles with themselves, not through periodic faces; complete within the
 *                        support of the kernel until the next build
 *  Gives: no cluster is held, none is at bodies, and all change.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: O(entries); allocates only for more neighbors than ever before. */
mor_status mor_sleep_find_neighbors(mor_context *context, mor_sleep *sleep, const mor_relation *relation);

/** Makes room for more bodies, before the first step.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_sleep_add_bodies(mor_context *context, mor_sleep *sleep, int n_bodies);

/** Picks the points of a body that are followed to tell whether it rests: three of a rigid one, of one that deforms
 *  MOR_SLEEP_SAMPLES spread over all of it.
 *  @param n_points      [in]   of the body, in tree order, >= 0
 *  @param is_deformable [in]   they may move against each other
 *  @param points        [out]  shape [MOR_SLEEP_SAMPLES]; indices, rising
 *  Returns: how many; 0: the body has none. */
int mor_sleep_pick_points(int64_t n_points, bool is_deformable, int64_t *points);

/** Whether a body rests: it has not moved on for a time, however slowly it does. Where it counts from is moved with it
 *  only when it has moved on, so that a body that creeps moves on in the end.
 *  @param rest         [in,out]  shape [MOR_SLEEP_REST], of the body, units of the enum
 *  @param places       [in]      shape [n_places] of 3 numbers each, of the points that are followed, unit m
 *  @param n_places     [in]      1 to MOR_SLEEP_SAMPLES, the same in all calls
 *  @param length       [in]      of the step, unit s
 *  @param displacement [in]      by which it moves on, unit m
 *  @param after        [in]      time after which it rests, unit s */
bool mor_sleep_body_rests(double *rest, const double *const *places, int n_places, double length, double displacement,
                          double after);

/** Takes no cluster for held, and none for one at bodies: their lists are built anew. */
void mor_sleep_forget_bodies(mor_sleep *sleep);

/** Keeps clusters that list points of bodies from being held: forces on bodies are found in every step.
 *  @param bodies [in]      particle -> points of bodies, current */
void mor_sleep_mark_bodies(mor_sleep *sleep, const mor_relation *bodies);

/** Decides which clusters sleep in this step.
 *  @param sleep [in,out]  states, changing, n_asleep and n_sleepers are set */
void mor_sleep_decide(mor_context *context, mor_sleep *sleep, const mor_sleep_job *job);

/** Returns the memory of clusters and of the lists of their neighbors, bytes. */
double mor_sleep_bytes(const mor_sleep *sleep);

/** Wakes all clusters for this step. */
void mor_sleep_wake(mor_sleep *sleep);

/** Whether a cluster is at least in a state.
 *  @param states  [in]  shape [clusters]; NULL: all are awake
 *  @param cluster [in]  of the soil
 *  @param state   [in]  MOR_SLEEP_ASLEEP or MOR_SLEEP_HELD */
static inline bool mor_sleep_is(const int8_t *states, int64_t cluster, int state)
{
    return states != NULL && states[cluster] >= state;
}

/** Returns one past the last particle from first on, at most last, whose cluster has a flag, or none, as first does.
 *  @param flags  [in]  shape [clusters]; of states: not 0 where it sleeps; NULL: none has
 *  @param first  [in]  first of the particles of a cluster, below last
 *  @param last   [in]  one past the last particle that is asked for */
int64_t mor_sleep_particles_end(const int8_t *flags, int64_t first, int64_t last);

/** Does something for clusters [first, last), all of which sleep or all of which are awake. */
typedef void (*mor_sleep_work)(const void *owner, const void *job, int64_t first, int64_t last, bool sleeps);

/** Runs over clusters, those that sleep apart from those that are awake, by ranges that one thread takes at once.
 *  @param states     [in]  shape [clusters]; NULL: all are awake
 *  @param n_clusters [in]  of the soil
 *  @param work       [in]  writes what belongs to its own clusters only
 *  @param owner      [in]  passed on to it
 *  @param job        [in]  passed on to it */
void mor_sleep_run(mor_context *context, const int8_t *states, int64_t n_clusters, mor_sleep_work work,
                   const void *owner, const void *job);

#endif
