/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/memory_room.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Most that a set holds: its indices have 32 bits. */
#define PARTICLES_MOST 2147483584.0

/* Share of the free memory that may be used; the rest is left to the system. */
static const double usable_share = 0.95;

/* A number that a file of the system holds alone; INFINITY when it holds none. */
static double read_number(const char *path)
{
    double value = INFINITY;
    FILE *file = fopen(path, "r");
    if (file != NULL) {
        if (fscanf(file, "%lf", &value) != 1) {
            value = INFINITY; /* "max" */
        }
        fclose(file);
    }
    return value;
}

static double read_available(void)
{
    char line[256];
    double kibibytes = INFINITY;
    FILE *file = fopen("/proc/meminfo", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        if (sscanf(line, "MemAvailable: %lf", &kibibytes) == 1) {
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return 1024.0 * kibibytes;
}

/* Memory that is left of the limit of a container. */
static double read_left(const char *limit, const char *used)
{
    const double left = read_number(limit) - read_number(used);
    return isnan(left) ? INFINITY : fmax(left, 0.0); /* not a number where neither is told */
}

double mor_memory_room(void)
{
    const double of_system = read_available();
    const double of_group =
        fmin(read_left("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
             read_left("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"));
    return fmin(of_system, of_group);
}

int64_t mor_memory_room_particles(double bytes_each, double reserved)
{
    const double n = (usable_share * mor_memory_room() - reserved) / bytes_each;
    return (int64_t)fmax(1.0, fmin(n, PARTICLES_MOST));
}
