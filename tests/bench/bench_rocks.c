/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/bench/bench.h"
#include "tests/bench/meter.h"
#include "tests/common/scene.h"

/* The speed of rocks in the cases of cases/: whole steps, output excluded.
 *
 * Craters: steps of soil and ball, each at its own rate; counted are the soil's particle-steps, in the time of both.
 * Then the same run goes on with one clock for both, in steps as short as the ball's: I_CE is its time per simulated
 * second over that of several clocks, in percent, as Zhang et al. (2024) have it.
 * Rings, balls: without soil a common step is one sub-step of the rocks; they are timed while they touch. */

/* One row of the table. */
typedef struct rocks_row {
    const char *name;
    const char *case_path;
    const char *settings[2];
    double start;      /* simulated time at which the clock starts, s; 0: after n_first_steps */
    int n_first_steps; /* before the clock starts, when start is 0 */
    int n_steps;       /* of a repetition */
    int n_repetitions;
    int n_single_steps; /* of a repetition with one clock; 0: there is one clock only */
} rocks_row;

#define CASES MOR_SOURCE_DIR "/cases/"
#define CRATER CASES "crater/case.cfg"
#define RINGS CASES "rings-2d/case.cfg"
#define BALLS CASES "balls-3d/case.cfg"

/* The bed of the crater, 150 mm, is 37 or 75 spacings wide. Rings and balls meet after 0.1 ms and part after 2 ms. */
static const rocks_row rows[] = {
    {"crater-51k", CRATER, {"spacing=4.054054 mm", NULL}, 0.0, 10, 20, 7, 100},
    {"crater-426k", CRATER, {"spacing=2 mm", NULL}, 0.0, 10, 20, 3, 60},
    {"rings-1mm", RINGS, {"spacing=1 mm", NULL}, 0.4e-3, 0, 100, 7, 0},
    {"rings-0.5mm", RINGS, {"spacing=0.5 mm", NULL}, 0.4e-3, 0, 100, 7, 0},
    {"rings-0.25mm", RINGS, {"spacing=0.25 mm", NULL}, 0.4e-3, 0, 50, 7, 0},
    {"balls-2mm", BALLS, {"spacing=2 mm", NULL}, 0.4e-3, 0, 40, 7, 0},
    {"balls-1.5mm", BALLS, {"spacing=1.5 mm", NULL}, 0.4e-3, 0, 20, 7, 0},
    {"balls-1mm", BALLS, {"spacing=1 mm", NULL}, 0.4e-3, 0, 20, 5, 0},
};

/* What was measured of one way to step. */
typedef struct rocks_timing {
    double speed;      /* million particle-steps per second */
    double cost;       /* time per simulated time, 1 */
    double rate_ratio; /* mean over the steps */
} rocks_timing;

/* Particles whose steps are counted: the soil's, or all where there is none. */
static int64_t count_particles(const scene *it)
{
    return it->simulation.has_soil ? it->simulation.soil.set.n_particles : mor_simulation_particles(&it->simulation);
}

static void print_shares(const meter *m, double seconds)
{
    double known = m->exchange_seconds;
    double handed = 0.0;
    printf("    share of the time:");
    for (int s = 0; s < m->n_steppers; ++s) {
        const double own = meter_stepper_seconds(&m->steppers[s]);
        printf(" %s %.1f %%,", m->steppers[s].plain.name, 100.0 * own / seconds);
        handed += m->steppers[s].begin_seconds;
        known += own;
    }
    printf(" once in a common step %.1f %%,", 100.0 * handed / seconds);
    if (m->plain_exchange != NULL) {
        printf(" contact %.1f %%,", 100.0 * m->exchange_seconds / seconds);
    }
    printf(" rest %.1f %%\n", 100.0 * (seconds - known - handed) / seconds);
}

static rocks_timing time_steps(scene *it, meter *m, int n_repetitions, int n_steps)
{
    const mor_schedule *schedule = &it->simulation.schedule;
    double seconds[BENCH_REPETITIONS_MAX];
    const double first = mor_schedule_time(schedule);
    double sum = 0.0;
    rocks_timing timing = {0};
    meter_reset(m);
    for (int k = 0; k < n_repetitions; ++k) {
        const double start = mor_wall_time();
        for (int n = 0; n < n_steps; ++n) {
            scene_step(it, 1);
            timing.rate_ratio += (double)mor_schedule_rate_ratio(schedule) / (n_steps * n_repetitions);
        }
        seconds[k] = mor_wall_time() - start;
        sum += seconds[k];
    }
    timing.speed =
        bench_print_speed(it->context.n_threads, (double)count_particles(it) * n_steps, seconds, n_repetitions);
    timing.cost = sum / (mor_schedule_time(schedule) - first); /* not a median: few repetitions build as many lists */
    printf("    %d steps each, %.4g h per simulated second\n", n_steps, timing.cost / 3600.0);
    print_shares(m, sum);
    return timing;
}

/* Times one clock after several, in the same run, and fills in kappa and I_CE. */
static void compare_clocks(scene *it, meter *m, const rocks_row *row, const rocks_timing *several, bench_result *result)
{
    it->simulation.schedule.is_single_rate = true;
    printf("  one clock:\n");
    const rocks_timing one = time_steps(it, m, row->n_repetitions, row->n_single_steps);
    result->rate_ratio = several->rate_ratio;
    result->gain = 100.0 * one.cost / several->cost;
    printf("  kappa %.1f, I_CE %.0f %%\n", result->rate_ratio, result->gain);
}

static void run_row(bench *all, const void *chosen)
{
    const rocks_row *row = chosen;
    const scene_request request = {row->case_path, (const char *const *[]){row->settings}, 1, mor_parallel_cores()};
    scene *it = scene_new(&request);
    meter clocks;
    bench_result result = {.n_particles = mor_simulation_particles(&it->simulation), .rate_ratio = NAN, .gain = NAN};
    meter_attach(&clocks, &it->simulation.schedule);
    scene_step(it, row->n_first_steps);
    scene_advance(it, row->start);
    result.bytes = it->simulation.has_soil ? mor_soil_bytes_per_particle(&it->simulation.soil)
                                           : (double)it->context.memory_bytes / (double)result.n_particles;
    snprintf(result.name, sizeof result.name, "%s", row->name);
    printf("%s: %lld particles, %lld of them soil, in %s, %.0f bytes per particle\n", row->name,
           (long long)result.n_particles, (long long)it->simulation.soil.set.n_particles,
           it->the_case.dimension == 2 ? "plane strain" : "space", result.bytes);
    const rocks_timing timing = time_steps(it, &clocks, row->n_repetitions, row->n_steps);
    result.speed = timing.speed;
    if (row->n_single_steps > 0) {
        compare_clocks(it, &clocks, row, &timing, &result);
    }
    bench_report(all, &result);
    scene_free(it);
}

int main(int argc, char **argv)
{
    const bench_program program = {rows, sizeof *rows, sizeof rows / sizeof *rows, run_row, BENCH_REFERENCE_PATH};
    return bench_main(argc, argv, &program);
}
