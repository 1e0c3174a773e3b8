/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/wall_time.h"
#include "tests/bench/bench.h"
#include "tests/common/elastic_bodies.h"

/* The speed of an elastic body alone: sub-steps of one spinning ball (disc, box), no soil, no contact, nothing that is
 * done once in a common step. A sub-step of one particle counts one. */

enum { STAGES_MAX = 8, REPETITIONS = 9 };

/* One row of the table. */
typedef struct elastic_row {
    const char *name;
    int dimension;
    bool is_ball;
    double across; /* spacings */
    int n_steps;   /* per repetition */
} elastic_row;

static const elastic_row rows[] = {
    {"elastic-2d-230", 2, false, 15.0, 2000}, {"elastic-2d-4k", 2, true, 71.0, 200},
    {"elastic-2d-70k", 2, true, 299.0, 20},   {"elastic-3d-500", 3, true, 10.0, 1000},
    {"elastic-3d-4k", 3, true, 20.0, 100},    {"elastic-3d-50k", 3, true, 46.0, 10},
    {"elastic-3d-310k", 3, true, 84.0, 3},
};

static double run_steps(elastic_bodies *it, int n_steps, double *stage_seconds)
{
    const double start = mor_wall_time();
    const mor_stepper *stepper = &it->stepper;
    double length = 0.0;
    const char *limit = "";
    for (int n = 0; n < n_steps; ++n) {
        elastic_require(it, stepper->operations->propose(&it->context, stepper->owner, &length, &limit));
        /* The first of two sub-steps: only the last one has to find the stress for the output. */
        const mor_step step = {.length = length, .number = (uint64_t)n, .n_parts = 2};
        double before = mor_wall_time();
        for (int k = 0; k < stepper->n_stages; ++k) {
            elastic_require(it, mor_stepper_run_stage(&it->context, stepper, k, &step));
            const double now = mor_wall_time();
            stage_seconds[k] += now - before;
            before = now;
        }
    }
    return mor_wall_time() - start;
}

/* Returns million particle-steps per second. */
static double time_threads(elastic_bodies *it, const elastic_row *row, int n_threads)
{
    double seconds[REPETITIONS];
    double stages[STAGES_MAX] = {0.0};
    double sum = 0.0;
    it->context.n_threads = n_threads;
    assert_true(it->stepper.n_stages <= STAGES_MAX);
    for (int k = 0; k < REPETITIONS; ++k) {
        seconds[k] = run_steps(it, row->n_steps, stages);
    }
    const double n_particle_steps = (double)it->elastic.group.set.n_particles * row->n_steps;
    const double speed = bench_print_speed(n_threads, n_particle_steps, seconds, REPETITIONS);
    for (int k = 0; k < it->stepper.n_stages; ++k) {
        sum += stages[k];
    }
    printf("   ");
    for (int k = 0; k < it->stepper.n_stages; ++k) {
        printf(" %s %.0f %%%s", it->stepper.stages[k].name, 100.0 * stages[k] / sum,
               k + 1 < it->stepper.n_stages ? "," : "\n");
    }
    return speed;
}

static void run_row(bench *all, const void *chosen)
{
    const elastic_row *row = chosen;
    const double across = row->across;
    const elastic_piece piece = {.is_ball = row->is_ball,
                                 .side = {across, across, across},
                                 .axis = {0.0, 0.0, 1.0},
                                 .angle = 0.3,
                                 .angular_velocity = {0.0, 0.0, 0.01 / across}};
    const elastic_request request = {
        .dimension = row->dimension,
        .spacing = 1.0,
        .pieces = &piece,
        .n_pieces = 1,
        .youngs = 1e4,
        .poisson = 0.25,
        .density = 1.0,
        .settings = {.body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.1},
        .n_threads = mor_parallel_cores()};
    elastic_bodies it;
    elastic_open(&it, &request);
    elastic_steps(&it, 2);
    bench_result result = {.n_particles = it.elastic.group.set.n_particles, .rate_ratio = NAN, .gain = NAN};
    result.bytes = (double)it.context.memory_bytes / (double)result.n_particles;
    snprintf(result.name, sizeof result.name, "%s", row->name);
    printf("%s: %lld particles in %s, %.0f bytes per particle\n", row->name, (long long)result.n_particles,
           row->dimension == 2 ? "plane strain" : "space", result.bytes);
    result.speed = time_threads(&it, row, mor_parallel_cores());
    if (mor_parallel_cores() > 1) {
        time_threads(&it, row, 1);
    }
    bench_report(all, &result);
    elastic_close(&it);
}

int main(int argc, char **argv)
{
    const bench_program program = {rows, sizeof *rows, sizeof rows / sizeof *rows, run_row, BENCH_REFERENCE_PATH};
    return bench_main(argc, argv, &program);
}
