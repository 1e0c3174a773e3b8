/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/bench/bench.h"
#include "tests/bench/meter.h"
#include "tests/common/scene.h"

/* The speed of soil: whole steps, neighbor search included, output excluded. The columns of cases/ are made soft, so
 * that few steps deform them, and start from a disturbed lattice. A repetition holds one sort.
 *
 * The small rows take as many steps in a repetition as there are between two sorts of a run. The large rows take fewer
 * and sort as often as that; of the time by which finding neighbors in the sorting step exceeds the mean of the
 * others, they count the part that falls to so many steps. They have too few steps to get into motion, so their
 * soil starts with a speed at which lists are built as often as in the small rows: see "steps between lists". */

/* One row of the table. */
typedef struct soil_row {
    const char *name;
    const char *case_path;
    const char *settings[6];
    int n_first_steps; /* before the clock starts */
    int n_steps;       /* of a repetition, a multiple of the steps between summations of density; 0: between sorts */
    int n_repetitions;
    bool has_one_thread; /* whether one thread is timed too */
} soil_row;

#define CASES MOR_SOURCE_DIR "/cases/"
#define SOFT "soil[0].material.youngs_modulus=0.24 MPa"
#define UNEVEN "lattice.jitter=0.2"
#define MIXED "numerics.precision=mixed"
#define MOVING "soil[0].velocity=('0.4 m/s', '0 m/s', '0 m/s')"
#define LONG "end=10 s" /* repetitions may go on beyond the end of the case */

static const soil_row rows[] = {
    {"soil-2d-16k", CASES "column-2d/case.cfg", {"spacing=1.118 mm", SOFT, UNEVEN, LONG, NULL}, 1000, 0, 7, true},
    {"soil-3d-25k", CASES "column-3d/case.cfg", {"spacing=5 mm", SOFT, UNEVEN, LONG, NULL}, 300, 0, 7, true},
    {"soil-3d-200k", CASES "column-3d/case.cfg", {"spacing=2.505 mm", SOFT, UNEVEN, LONG, NULL}, 150, 0, 3, true},
    {"soil-2d-mixed",
     CASES "column-2d/case.cfg",
     {"spacing=1.118 mm", SOFT, UNEVEN, MIXED, LONG, NULL},
     1000,
     0,
     7,
     true},
    {"soil-3d-25k-mixed",
     CASES "column-3d/case.cfg",
     {"spacing=5 mm", SOFT, UNEVEN, MIXED, LONG, NULL},
     300,
     0,
     7,
     true},
    {"soil-3d-200k-mixed",
     CASES "column-3d/case.cfg",
     {"spacing=2.505 mm", SOFT, UNEVEN, MIXED, LONG, NULL},
     150,
     0,
     3,
     true},
    {"soil-3d-1m",
     CASES "column-3d/case.cfg",
     {"spacing=1.465 mm", SOFT, UNEVEN, MOVING, LONG, NULL},
     20,
     20,
     3,
     false},
    {"soil-3d-2m",
     CASES "column-3d/case.cfg",
     {"spacing=1.163 mm", SOFT, UNEVEN, MOVING, LONG, NULL},
     20,
     20,
     3,
     false},
};

/* What a loop over pairs must compute in one lane for one target with the default scheme, by dimension less 2, counted
 * from the source: a fused multiply-add as two operations, a root or a division as one, what is computed again from
 * pass to pass once. A test of distance, its comparison not counted, is made for all of a list, the rest for those in
 * reach. */
typedef struct pair_work {
    const char *stage;
    int test[2];
    int rest[2];
    int n_roots, n_divisions; /* among the rest */
} pair_work;

static const pair_work works[] = {
    {"momentum", {6, 9}, {113, 146}, 1, 2},
    {"velocity gradient", {0, 0}, {38, 62}, 1, 0},
};

/* What was measured with one number of threads. */
typedef struct soil_timing {
    int n_threads;
    double seconds[BENCH_REPETITIONS_MAX];  /* of each repetition, s */
    double stage_seconds[METER_STAGES_MAX]; /* of all repetitions, s */
    int n_lists;                            /* lists built in all repetitions */
} soil_timing;

/* A run with its clocks. */
typedef struct soil_bench {
    scene *scene;
    meter meter;
    int neighbors;     /* number of the stage that finds neighbors */
    int sort_interval; /* of a run, steps */
    int n_steps;       /* of a repetition */
    soil_timing timings[2];
    int n_timings;
} soil_bench;

static void find_neighbor_stage(soil_bench *it)
{
    const mor_stepper *stepper = &it->meter.steppers[0].plain;
    for (it->neighbors = 0; strcmp(stepper->stages[it->neighbors].name, "neighbors") != 0; ++it->neighbors) {
        assert_true(it->neighbors + 1 < stepper->n_stages);
    }
}

/* Returns the time of a repetition, in s, with its fair share of a sort. */
static double time_repetition(soil_bench *it, soil_timing *timing)
{
    const mor_schedule *schedule = &it->scene->simulation.schedule;
    const mor_soil *soil = &it->scene->simulation.soil;
    meter_stepper *stepper = &it->meter.steppers[0];
    double sorting = 0.0;
    double others = 0.0;
    const double start = mor_wall_time();
    for (int n = 0; n < it->n_steps; ++n) {
        const bool is_sorting = schedule->n_steps % (uint64_t)it->n_steps == 0;
        const uint64_t n_before = soil->inner.n_builds;
        scene_step(it->scene, 1);
        *(is_sorting ? &sorting : &others) += stepper->last_seconds[it->neighbors];
        timing->n_lists += soil->inner.n_builds > n_before;
    }
    const double excess = sorting - others / (it->n_steps - 1);
    const double surplus = excess * (1.0 - (double)it->n_steps / it->sort_interval);
    stepper->stage_seconds[it->neighbors] -= surplus;
    return mor_wall_time() - start - surplus;
}

static void print_stages(const mor_stepper *stepper, const double *stage_seconds)
{
    double sum = 0.0;
    for (int k = 0; k < stepper->n_stages; ++k) {
        sum += stage_seconds[k];
    }
    printf("   ");
    for (int k = 0; k < stepper->n_stages; ++k) {
        const double share = 100.0 * stage_seconds[k] / sum;
        if (share >= 0.05) {
            printf(" %s %.1f %%%s", stepper->stages[k].name, share, k + 1 < stepper->n_stages ? "," : "");
        }
    }
    printf("\n");
}

/* Repetitions with all threads and with one take turns, so that both meet the soil in the same motion. */
static void time_repetitions(soil_bench *it, int n_repetitions)
{
    for (int k = 0; k < n_repetitions * it->n_timings; ++k) {
        soil_timing *timing = &it->timings[k % it->n_timings];
        it->scene->context.n_threads = timing->n_threads;
        meter_reset(&it->meter);
        timing->seconds[k / it->n_timings] = time_repetition(it, timing);
        for (int stage = 0; stage < METER_STAGES_MAX; ++stage) {
            timing->stage_seconds[stage] += it->meter.steppers[0].stage_seconds[stage];
        }
    }
}

/* Targets of all clusters. */
typedef struct target_counts {
    double listed, near;
} target_counts;

static target_counts count_targets(const mor_soil *soil, int64_t n_clusters)
{
    target_counts counts = {0.0, 0.0};
    for (int64_t cluster = 0; cluster < n_clusters; ++cluster) {
        counts.listed += soil->inner.counts[cluster];
        for (int32_t k = 0; k < mor_relation_words(soil->inner.counts[cluster]); ++k) {
            counts.near += __builtin_popcount(mor_relation_near(&soil->inner, cluster)[k]);
        }
    }
    return counts;
}

/* What a loop over pairs reaches of the peak of a core; seconds: of it in one step. */
static void print_share(const pair_work *work, const mor_soil *soil, const target_counts *counts,
                        const bench_peak *peak, double seconds)
{
    const int space = soil->settings.dimension - 2;
    const bool is_mixed = soil->settings.scheme.precision == 1;
    const double operations = MOR_CLUSTER * (counts->listed * work->test[space] + counts->near * work->rest[space]);
    const double gflops = 1.0e-9 * operations / seconds;
    printf("    %s: %.0f ns a particle, %.0f GFlop/s, %.0f %% of the peak", work->stage,
           1.0e9 * seconds / (double)soil->set.n_particles, gflops,
           100.0 * gflops / (is_mixed ? peak->single_gflops : peak->double_gflops));
    if (!is_mixed) {
        const double registers = counts->near * MOR_CLUSTER * 64.0 / peak->register_bits;
        const double slow = 1.0e-9 * (work->n_roots * peak->root_ns + work->n_divisions * peak->division_ns);
        printf("; roots and divisions alone would take %.0f %% of its time", 100.0 * registers * slow / seconds);
    }
    printf("\n");
}

static void print_shares(const soil_bench *it, const soil_timing *timing, int n_repetitions)
{
    const mor_soil *soil = &it->scene->simulation.soil;
    const mor_stepper *stepper = &it->meter.steppers[0].plain;
    const bench_peak peak = bench_measure_peak();
    const int64_t n_clusters = (soil->set.n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    const target_counts counts = count_targets(soil, n_clusters);
    printf("    ");
    bench_print_peak(stdout, &peak);
    printf("    targets of a cluster: %.1f listed, %.1f in reach\n", counts.listed / (double)n_clusters,
           counts.near / (double)n_clusters);
    for (int k = 0; k < stepper->n_stages && peak.register_bits > 0; ++k) {
        for (size_t w = 0; w < sizeof works / sizeof *works; ++w) {
            if (strcmp(stepper->stages[k].name, works[w].stage) == 0) {
                print_share(&works[w], soil, &counts, &peak,
                            timing->stage_seconds[k] / ((double)it->n_steps * n_repetitions));
            }
        }
    }
}

/* Returns million particle-steps per second. */
static double print_timing(const soil_bench *it, soil_timing *timing, int n_repetitions)
{
    const double n_particle_steps = (double)it->scene->simulation.soil.set.n_particles * it->n_steps;
    const double speed = bench_print_speed(timing->n_threads, n_particle_steps, timing->seconds, n_repetitions);
    printf("    %d steps each, %.1f steps between lists\n", it->n_steps,
           (double)it->n_steps * n_repetitions / (timing->n_lists > 0 ? timing->n_lists : 1));
    print_stages(&it->meter.steppers[0].plain, timing->stage_seconds);
    if (timing->n_threads == 1) {
        print_shares(it, timing, n_repetitions);
    }
    return speed;
}

static void run_row(bench *all, const void *chosen)
{
    const soil_row *row = chosen;
    const scene_request request = {row->case_path, (const char *const *[]){row->settings}, 1, mor_parallel_cores()};
    soil_bench it = {.scene = scene_new(&request), .timings = {{.n_threads = mor_parallel_cores()}, {.n_threads = 1}}};
    mor_soil *soil = &it.scene->simulation.soil;
    it.n_timings = row->has_one_thread && mor_parallel_cores() > 1 ? 2 : 1;
    it.sort_interval = soil->settings.scheme.sort_interval;
    it.n_steps = row->n_steps > 0 ? row->n_steps : it.sort_interval;
    soil->settings.scheme.sort_interval = it.n_steps;
    meter_attach(&it.meter, &it.scene->simulation.schedule);
    find_neighbor_stage(&it);
    assert_true(row->n_repetitions <= BENCH_REPETITIONS_MAX);
    scene_step(it.scene, row->n_first_steps);
    bench_result result = {.n_particles = soil->set.n_particles, .rate_ratio = NAN, .gain = NAN};
    result.bytes = mor_soil_bytes_per_particle(soil);
    snprintf(result.name, sizeof result.name, "%s", row->name);
    printf("%s: %lld particles in %s, %s, %.0f bytes per particle\n", row->name, (long long)result.n_particles,
           soil->settings.dimension == 2 ? "plane strain" : "space", soil->table->instruction_set, result.bytes);
    time_repetitions(&it, row->n_repetitions);
    result.speed = print_timing(&it, &it.timings[0], row->n_repetitions);
    if (it.n_timings > 1) {
        print_timing(&it, &it.timings[1], row->n_repetitions);
    }
    bench_report(all, &result);
    scene_free(it.scene);
}

int main(int argc, char **argv)
{
    const bench_program program = {rows, sizeof *rows, sizeof rows / sizeof *rows, run_row, BENCH_REFERENCE_PATH};
    return bench_main(argc, argv, &program);
}
