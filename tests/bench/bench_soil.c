/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/clock.h"
#include "core/base/parallel.h"
#include "tests/common/scene.h"

#include <stdio.h>
#include <unistd.h>

/* The speed of soil: whole steps, neighbor search included, output excluded. The columns of cases/ are made soft, so
 * that few steps deform them, and start from a disturbed lattice. A repetition is as long as the time between two
 * sorts, so that each holds one. Without arguments all sizes are timed; with arguments those that are named. */

enum { STAGES_MAX = 32, REPETITIONS_MAX = 9 };

/* One row of the table. */
typedef struct size {
    const char *name;
    const char *case_path;
    const char *settings[4];
    int n_first_steps; /* before the clock starts */
    int n_repetitions;
} size;

#define CASES MOR_SOURCE_DIR "/cases/"
#define SOFT "soil[0].material.youngs_modulus=0.24 MPa"
#define UNEVEN "lattice.jitter=0.2"

static const size sizes[] = {
    {"2d-16k", CASES "column-2d/case.cfg", {"spacing=1.118 mm", SOFT, UNEVEN, NULL}, 1000, 7},
    {"3d-25k", CASES "column-3d/case.cfg", {"spacing=5 mm", SOFT, UNEVEN, NULL}, 300, 7},
    {"3d-200k", CASES "column-3d/case.cfg", {"spacing=2.505 mm", SOFT, UNEVEN, NULL}, 150, 3},
    {"3d-1m", CASES "column-3d/case.cfg", {"spacing=1.465 mm", SOFT, UNEVEN, NULL}, 30, 1},
};

enum { N_SIZES = sizeof sizes / sizeof *sizes };

/* What was measured with one number of threads. */
typedef struct timing {
    int n_threads;
    double seconds[REPETITIONS_MAX];  /* of each repetition, s */
    double stage_seconds[STAGES_MAX]; /* of all repetitions, s */
} timing;

/* One step of the only stepper, as the schedule takes it, with a clock between the stages. */
static void time_step(scene *it, timing *t)
{
    mor_schedule *schedule = &it->simulation.schedule;
    const mor_stepper *stepper = &schedule->steppers[0];
    double length = 0.0;
    const char *limit = "";
    scene_require(it, stepper->operations->propose(&it->context, stepper->owner, &length, &limit));
    const int64_t ticks = mor_schedule_ticks(schedule, length);
    const mor_step step = {(double)ticks * schedule->tick, mor_schedule_time(schedule), schedule->n_steps, 0, 1};
    double before = mor_clock_now();
    for (int k = 0; k < stepper->n_stages; ++k) {
        scene_require(it, stepper->stages[k].run(&it->context, stepper->owner, &step));
        const double now = mor_clock_now();
        t->stage_seconds[k] += now - before;
        before = now;
    }
    schedule->now += ticks;
    schedule->n_steps += 1;
    schedule->step_length = step.length;
}

static void time_repetitions(scene *it, int n_repetitions, timing *t)
{
    it->context.n_threads = t->n_threads;
    for (int k = 0; k < n_repetitions; ++k) {
        const double before = mor_clock_now();
        for (int n = 0; n < it->the_case.numerics.sort_interval; ++n) {
            time_step(it, t);
        }
        t->seconds[k] = mor_clock_now() - before;
    }
}

static int compare_seconds(const void *a, const void *b)
{
    const double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

static void print_speed(const scene *it, int n_repetitions, timing *t)
{
    const int n_steps = it->the_case.numerics.sort_interval;
    const double millions = 1e-6 * (double)it->simulation.soil.set.n_particles * n_steps;
    qsort(t->seconds, (size_t)n_repetitions, sizeof *t->seconds, compare_seconds);
    printf("  %7d %13d x %d %20.3f %10.3f %10.3f\n", t->n_threads, n_repetitions, n_steps,
           millions / t->seconds[n_repetitions / 2], millions / t->seconds[n_repetitions - 1],
           millions / t->seconds[0]);
}

static void print_stages(const scene *it, const timing *timings, int n_timings)
{
    const mor_stepper *stepper = &it->simulation.schedule.steppers[0];
    printf("  %-22s", "share of the time, %");
    for (int k = 0; k < n_timings; ++k) {
        printf(" %3d thread%s", timings[k].n_threads, timings[k].n_threads == 1 ? " " : "s");
    }
    printf("\n");
    for (int stage = 0; stage < stepper->n_stages; ++stage) {
        printf("  %-22s", stepper->stages[stage].name);
        for (int k = 0; k < n_timings; ++k) {
            double sum = 0.0;
            for (int other = 0; other < stepper->n_stages; ++other) {
                sum += timings[k].stage_seconds[other];
            }
            printf(" %11.1f", 100.0 * timings[k].stage_seconds[stage] / sum);
        }
        printf("\n");
    }
}

static void bench(const size *row)
{
    const scene_request request = {row->case_path, (const char *const *[]){row->settings}, 1, mor_parallel_cores()};
    scene *it = scene_new(&request);
    const mor_stepper *stepper = &it->simulation.schedule.steppers[0];
    timing timings[2] = {{.n_threads = mor_parallel_cores()}, {.n_threads = 1}};
    const int n_timings = mor_parallel_cores() > 1 ? 2 : 1;
    assert_true(stepper->n_stages <= STAGES_MAX);
    assert_true(row->n_repetitions <= REPETITIONS_MAX);
    scene_step(it, row->n_first_steps);
    for (int k = 0; k < n_timings; ++k) {
        time_repetitions(it, row->n_repetitions, &timings[k]);
    }
    printf("%s: %lld particles in %s, %s, %.0f bytes per particle\n", row->name,
           (long long)it->simulation.soil.set.n_particles, it->the_case.dimension == 2 ? "plane strain" : "space",
           it->simulation.soil.table->instruction_set, mor_soil_bytes_per_particle(&it->simulation.soil));
    printf("  %7s %13s x %s %20s %10s %10s\n", "threads", "repetitions", "steps", "M particle-steps/s", "lowest",
           "highest");
    for (int k = 0; k < n_timings; ++k) {
        print_speed(it, row->n_repetitions, &timings[k]);
    }
    print_stages(it, timings, n_timings);
    printf("\n");
    fflush(stdout);
    scene_free(it);
}

/* Whether a size was asked for; all are when none is named. */
static bool is_wanted(const size *row, int argc, char **argv)
{
    for (int k = 1; k < argc; ++k) {
        if (strcmp(argv[k], row->name) == 0) {
            return true;
        }
    }
    return argc == 1;
}

/* Threads wait as they do in the program; OpenMP looks at this once, before main. */
static void wait_as_the_program_does(char **argv)
{
    if (getenv("GOMP_SPINCOUNT") == NULL && getenv("OMP_WAIT_POLICY") == NULL &&
        setenv("GOMP_SPINCOUNT", "1000", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
}

int main(int argc, char **argv)
{
    int n_done = 0;
    wait_as_the_program_does(argv);
    for (int k = 0; k < N_SIZES; ++k) {
        if (is_wanted(&sizes[k], argc, argv)) {
            bench(&sizes[k]);
            n_done += 1;
        }
    }
    if (n_done < argc - 1) {
        fprintf(stderr, "bench_soil: some of these sizes are not known; allowed are");
        for (int k = 0; k < N_SIZES; ++k) {
            fprintf(stderr, " %s", sizes[k].name);
        }
        fprintf(stderr, "\n");
        return 2;
    }
    return 0;
}
