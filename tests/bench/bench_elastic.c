/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/clock.h"
#include "core/base/parallel.h"
#include "tests/common/elastic_bodies.h"

/* The speed of elastic bodies: whole sub-steps of one spinning ball (disc, box), no soil, no contact. A sub-step of one
 * particle counts one. Without arguments all sizes are timed; with arguments those that are named. */

enum { STAGES_MAX = 8, REPETITIONS = 9 };

/* One row of the table. */
typedef struct size {
    const char *name;
    int dimension;
    bool is_ball;
    double across; /* spacings */
    int n_steps;   /* per repetition */
} size;

static const size sizes[] = {
    {"2d-230", 2, false, 15.0, 2000}, {"2d-4k", 2, true, 71.0, 200}, {"2d-70k", 2, true, 299.0, 20},
    {"3d-500", 3, true, 10.0, 1000},  {"3d-4k", 3, true, 20.0, 100}, {"3d-50k", 3, true, 46.0, 10},
    {"3d-310k", 3, true, 84.0, 3},
};

static double run_steps(elastic_bodies *it, int n_steps, double *stage_seconds)
{
    const double start = mor_clock_now();
    const mor_stepper *stepper = &it->stepper;
    double length = 0.0;
    const char *limit = "";
    for (int n = 0; n < n_steps; ++n) {
        elastic_require(it, stepper->operations->propose(&it->context, stepper->owner, &length, &limit));
        const mor_step step = {.length = length, .number = (uint64_t)n, .n_parts = 2};
        double before = mor_clock_now();
        for (int k = 0; k < stepper->n_stages; ++k) {
            elastic_require(it, stepper->stages[k].run(&it->context, stepper->owner, &step));
            const double now = mor_clock_now();
            stage_seconds[k] += now - before;
            before = now;
        }
    }
    return mor_clock_now() - start;
}

static int compare_seconds(const void *a, const void *b)
{
    const double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

static void time_threads(elastic_bodies *it, const size *row, int n_threads)
{
    double seconds[REPETITIONS];
    double stages[STAGES_MAX] = {0.0};
    double sum = 0.0;
    it->context.n_threads = n_threads;
    for (int k = 0; k < REPETITIONS; ++k) {
        seconds[k] = run_steps(it, row->n_steps, stages);
    }
    qsort(seconds, REPETITIONS, sizeof *seconds, compare_seconds);
    const double millions = 1e-6 * (double)it->elastic.group.set.n_particles * row->n_steps;
    printf("  %d threads: %.2f million particle-steps/s (lowest %.2f, highest %.2f)\n   ", n_threads,
           millions / seconds[REPETITIONS / 2], millions / seconds[REPETITIONS - 1], millions / seconds[0]);
    for (int k = 0; k < it->stepper.n_stages; ++k) {
        sum += stages[k];
    }
    for (int k = 0; k < it->stepper.n_stages; ++k) {
        printf(" %s %.0f %%,", it->stepper.stages[k].name, 100.0 * stages[k] / sum);
    }
    printf("\n");
}

static void bench(const size *row)
{
    const double across = row->across;
    const elastic_piece piece = {.is_ball = row->is_ball,
                                 .side = {across, across, across},
                                 .axis = {0.0, 0.0, 1.0},
                                 .angle = 0.3,
                                 .angular_velocity = {0.0, 0.0, 0.01 / across}};
    const elastic_request request = {.dimension = row->dimension,
                                     .spacing = 1.0,
                                     .pieces = &piece,
                                     .n_pieces = 1,
                                     .youngs = 1e4,
                                     .poisson = 0.25,
                                     .density = 1.0,
                                     .settings = {1.15, 0.4, 1.0, 0.1},
                                     .n_threads = mor_parallel_cores()};
    elastic_bodies it;
    elastic_open(&it, &request);
    elastic_steps(&it, 2);
    printf("%s: %lld particles in %s\n", row->name, (long long)it.elastic.group.set.n_particles,
           row->dimension == 2 ? "plane strain" : "space");
    time_threads(&it, row, mor_parallel_cores());
    time_threads(&it, row, 1);
    elastic_close(&it);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        bool is_wanted = argc == 1;
        for (int a = 1; a < argc; ++a) {
            is_wanted = is_wanted || strcmp(argv[a], sizes[k].name) == 0;
        }
        if (is_wanted) {
            bench(&sizes[k]);
        }
    }
    return 0;
}
