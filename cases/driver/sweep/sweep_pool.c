/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_pool.h"

#include "core/base/memory.h"

#include <pthread.h>
#include <time.h>

/* What the threads share. */
typedef struct pool {
    const mor_sweep_jobs *jobs;
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t ended; /* a thread has come to its end */
    int next;             /* job */
    int n_working;        /* threads */
} pool;

static int take_job(pool *p)
{
    (void)pthread_mutex_lock(&p->lock);
    const int job = p->next < p->jobs->n ? p->next++ : -1;
    (void)pthread_mutex_unlock(&p->lock);
    return job;
}

static void *work(void *user)
{
    pool *p = user;
    for (int job = take_job(p); job >= 0; job = take_job(p)) {
        p->jobs->work(p->jobs->user, job);
    }
    (void)pthread_mutex_lock(&p->lock);
    p->n_working -= 1;
    (void)pthread_cond_signal(&p->ended);
    (void)pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* Looks after the jobs while they are done. */
static void wait_for_all(pool *p)
{
    enum { NANOSECONDS = 100000000, SECOND = 1000000000 };
    bool is_working = true;
    while (is_working) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += NANOSECONDS;
        until.tv_sec += until.tv_nsec / SECOND;
        until.tv_nsec %= SECOND;
        (void)pthread_mutex_lock(&p->lock);
        if (p->n_working > 0) {
            (void)pthread_cond_timedwait(&p->ended, &p->lock, &until);
        }
        is_working = p->n_working > 0;
        (void)pthread_mutex_unlock(&p->lock);
        p->jobs->watch(p->jobs->user);
    }
}

/* As much stack as a program has for its first thread; the default may be less. */
static int start_thread(pthread_t *thread, pool *p)
{
    enum { STACK_BYTES = 1 << 23 };
    pthread_attr_t attributes;
    (void)pthread_attr_init(&attributes);
    (void)pthread_attr_setstacksize(&attributes, STACK_BYTES);
    const int error = pthread_create(thread, &attributes, work, p);
    (void)pthread_attr_destroy(&attributes);
    return error;
}

mor_status mor_sweep_pool_run(mor_context *context, const mor_sweep_jobs *jobs)
{
    const int n_wanted = jobs->n_threads < jobs->n ? jobs->n_threads : jobs->n;
    pthread_t *threads = NULL;
    int n = 0;
    pool p = {.jobs = jobs, .lock = PTHREAD_MUTEX_INITIALIZER, .ended = PTHREAD_COND_INITIALIZER};
    MOR_TRY(context, MOR_NEW(context, &threads, n_wanted, "threads of a sweep"));
    for (; n < n_wanted; ++n) {
        (void)pthread_mutex_lock(&p.lock);
        p.n_working += 1;
        (void)pthread_mutex_unlock(&p.lock);
        if (start_thread(&threads[n], &p) != 0) { /* those that there are do the work */
            (void)pthread_mutex_lock(&p.lock);
            p.n_working -= 1;
            (void)pthread_mutex_unlock(&p.lock);
            break;
        }
    }
    if (n > 0) {
        wait_for_all(&p);
    }
    for (int k = 0; k < n; ++k) {
        (void)pthread_join(threads[k], NULL);
    }
    MOR_FREE(context, &threads);
    (void)pthread_cond_destroy(&p.ended);
    (void)pthread_mutex_destroy(&p.lock);
    MOR_CHECK(context, n > 0 || jobs->n == 0, MOR_ERROR_MEMORY, "no memory for a thread of the sweep");
    return MOR_OK;
}
