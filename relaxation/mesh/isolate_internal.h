/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_ISOLATE_INTERNAL_H
#define MOR_RELAXATION_MESH_ISOLATE_INTERNAL_H

#include "core/base/context.h"

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

/* Work with code that may crash, hang, print or take all memory on damaged input: it runs in a child process, writes
 * its result into a pipe and ends. The parent continues in any case. */

/* Runs in the child. What it writes to the stream is what the parent reads. */
typedef void (*mor_isolate_work)(const void *user, FILE *result);

typedef struct mor_isolate {
    FILE *result; /* to be read */
    pid_t child;
} mor_isolate;

/* Starts the work in a child that may take so many seconds and so many bytes more than it starts with. */
mor_status mor_isolate_start(mor_context *context, mor_isolate *it, mor_isolate_work work, const void *user,
                             unsigned seconds, size_t extra_bytes);

/* Reads n bytes of the result; false when the child ended before it wrote them. */
bool mor_isolate_read(mor_isolate *it, void *bytes, size_t n);

/* Ends the child if it is still running, frees all, and describes, shape [room], how it ended. */
void mor_isolate_finish(mor_isolate *it, char *ending, size_t room);

#endif
