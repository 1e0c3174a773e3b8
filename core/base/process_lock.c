/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/process_lock.h"

#include <pthread.h>

static pthread_mutex_t process_mutex = PTHREAD_MUTEX_INITIALIZER;

/* Neither can fail: the mutex is an ordinary one, and who unlocks it has locked it. */
void mor_process_lock(void)
{
    (void)pthread_mutex_lock(&process_mutex);
}

void mor_process_unlock(void)
{
    (void)pthread_mutex_unlock(&process_mutex);
}
