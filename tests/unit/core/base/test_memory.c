/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/sph/soil.h"
#include "core/time/schedule.h"
#include "materials/drucker_prager.h"
#include "tests/common/cloud.h"
#include "tests/common/laws.h"

enum { SIDE_X = 14, SIDE_Y = 9, LAYERS = 4, STEPS = 20 };

/** Lets the address sanitizer return NULL for a request that cannot be met, as the allocator does without it.
 *  Returns: zero-terminated options of the sanitizer's run-time library, which asks for them by this name. */
const char *__asan_default_options(void);

const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

static void memory_is_aligned_zeroed_and_all_usable(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const int64_t counts[] = {1, 7, 8, 9, 63, 64, 65, 1000, 100000};
    for (int round = 0; round < 3; ++round) {
        for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k) {
            unsigned char *bytes = NULL;
            assert_int_equal(MOR_NEW(&context, &bytes, counts[k], "bytes"), MOR_OK);
            assert_non_null(bytes);
            assert_int_equal((uintptr_t)bytes % MOR_MEMORY_ALIGNMENT_BYTES, 0);
            for (int64_t i = 0; i < counts[k]; ++i) {
                assert_int_equal(bytes[i], 0);
            }
            memset(bytes, 0xA5, (size_t)counts[k]); /* dirt that the next round must not find */
            MOR_FREE(&context, &bytes);
            assert_null(bytes);
        }
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void large_blocks_are_aligned_zeroed_and_all_usable(void **state)
{
    (void)state;
    /* Around the size from which on large pages are asked for, two of 2 MiB, and past a whole number of them. */
    static const int64_t sizes[] = {(4 << 20) - 128, (4 << 20) - 64, 4 << 20, (5 << 20) + 1};
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < 8; ++k) {
        char *bytes = NULL;
        context.n_threads = 1 + k % 2;
        assert_int_equal(MOR_NEW(&context, &bytes, sizes[k / 2], "bytes"), MOR_OK);
        assert_int_equal((uintptr_t)bytes % MOR_MEMORY_ALIGNMENT_BYTES, 0);
        for (int64_t b = 0; b < sizes[k / 2]; ++b) {
            assert_int_equal(bytes[b], 0);
        }
        memset(bytes, 1, (size_t)sizes[k / 2]);
        MOR_FREE(&context, &bytes);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void blocks_do_not_overlap(void **state)
{
    (void)state;
    enum { BLOCKS = 20 };
    mor_context context;
    mor_context_init(&context);
    int *blocks[BLOCKS];
    for (int b = 0; b < BLOCKS; ++b) {
        assert_int_equal(MOR_NEW(&context, &blocks[b], b + 1, "numbers"), MOR_OK);
        for (int i = 0; i <= b; ++i) {
            blocks[b][i] = b;
        }
    }
    for (int b = 0; b < BLOCKS; ++b) {
        for (int i = 0; i <= b; ++i) {
            assert_int_equal(blocks[b][i], b);
        }
        MOR_FREE(&context, &blocks[b]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void counters_follow_what_is_held(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double *first = NULL;
    double *second = NULL;
    assert_int_equal(MOR_NEW(&context, &first, 100, "first"), MOR_OK);
    const size_t one = context.memory_bytes;
    assert_in_range(one, 800, 800 + 2 * MOR_MEMORY_ALIGNMENT_BYTES);
    assert_int_equal(MOR_NEW(&context, &second, 100, "second"), MOR_OK);
    assert_int_equal(context.memory_bytes, 2 * one);
    assert_int_equal(context.n_allocations, 2);
    MOR_FREE(&context, &first);
    assert_int_equal(context.memory_bytes, one);
    assert_int_equal(context.memory_peak_bytes, 2 * one);
    assert_int_equal(MOR_NEW(&context, &first, 1, "again"), MOR_OK);
    assert_int_equal(context.memory_peak_bytes, 2 * one);
    assert_int_equal(context.n_allocations, 3);
    MOR_FREE(&context, &first);
    MOR_FREE(&context, &second);
    assert_int_equal(context.memory_bytes, 0);
    assert_int_equal(context.memory_peak_bytes, 2 * one);
}

static void nothing_is_allocated_for_no_items(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double *block = (double *)&context;
    assert_int_equal(MOR_NEW(&context, &block, 0, "nothing"), MOR_OK);
    assert_null(block);
    MOR_FREE(&context, &block); /* NULL is accepted */
    assert_null(block);
    assert_int_equal(context.n_allocations, 0);
    assert_int_equal(context.memory_bytes, 0);
}

static void sizes_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const struct {
        int64_t n_items;
        size_t item_bytes;
        const char *reason;
    } wrong[] = {{-1, 8, "out of range"},
                 {INT64_MIN, 8, "out of range"},
                 {3, 0, "out of range"},
                 {INT64_MAX, 8, "out of range"},
                 {INT64_MAX, SIZE_MAX, "out of range"},
                 {2, SIZE_MAX / 2 + 1, "out of range"},       /* the product is 2^64, which wraps to zero */
                 {(int64_t)1 << 61, 8, "out of range"},       /* likewise */
                 {(int64_t)1 << 58, 8, "not enough memory"}}; /* 2 EiB: possible, but nobody has them */
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        mor_context context;
        mor_context_init(&context);
        void *block = &context;
        assert_int_equal(mor_memory_new(&context, &block, wrong[k].n_items, wrong[k].item_bytes, "the moon"),
                         MOR_ERROR_MEMORY);
        assert_null(block);
        assert_non_null(strstr(context.message, "the moon"));
        assert_non_null(strstr(context.message, wrong[k].reason));
        assert_int_equal(context.memory_bytes, 0);
        assert_int_equal(context.memory_peak_bytes, 0);
        assert_int_equal(context.n_allocations, 0);
    }
}

/* A block of sand on a floor, falling a little; every optional stage of the soil is on. */
typedef struct sandbox {
    mor_context context;
    mor_material_instance *sand;
    mor_soil soil;
    mor_schedule schedule;
} sandbox;

static void fill_settings(mor_soil_settings *s)
{
    *s = (mor_soil_settings){.scheme = {.smoothing_ratio = 1.3,
                                        .courant = 0.2,
                                        .dissipation = MOR_DISSIPATION_SEPARATION,
                                        .wall_dissipation = MOR_DISSIPATION_BOTH,
                                        .dissipation_factor = 40.0,
                                        .reconstruction = 1,
                                        .stress_diffusion = 0.1,
                                        .stress_diffusion_limiter = 1,
                                        .artificial_stress = true,
                                        .artificial_stress_exponent = 2.55,
                                        .artificial_stress_factor = 0.5,
                                        .gradient_correction = true,
                                        .xsph = 0.1,
                                        .shifting = true,
                                        .density_reinitialization = 5,
                                        .skin_ratio = 0.2,
                                        .sort_interval = 8},
                             .reference_density = 1600.0,
                             .dimension = 2,
                             .spacing = 0.01,
                             .lateral_ratio = 0.5,
                             .gravity = {0.0, -9.81, 0.0},
                             .domain_minimum = {-1.0, -1.0, -1.0},
                             .domain_maximum = {1.0, 1.0, 1.0}};
}

static void add_floor(sandbox *box)
{
    double points[3 * (SIDE_X + 2 * LAYERS) * LAYERS];
    int n = 0;
    for (int x = -LAYERS; x < SIDE_X + LAYERS; ++x) {
        for (int y = 0; y < LAYERS; ++y) {
            points[3 * n] = 0.01 * (x + 0.5);
            points[3 * n + 1] = -0.01 * (y + 0.5);
            points[3 * n++ + 2] = 0.0;
        }
    }
    const mor_wall_request request = {
        .name = "floor", .points = points, .n_points = n, .point_volume = 1e-4, .friction = MOR_WALL_ROUGH};
    assert_int_equal(mor_soil_add_wall(&box->context, &box->soil, &request), MOR_OK);
}

static void open_sandbox(sandbox *box)
{
    mor_context_init(&box->context);
    const double parameters[MOR_DRUCKER_PRAGER_COUNT] = {1e6, 0.3, 0.5, 100.0, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN,
                                                         1.0};
    assert_int_equal(mor_material_create(&box->context, law_named("drucker_prager"), 1600.0, parameters, &box->sand),
                     MOR_OK);
    mor_soil_settings settings;
    fill_settings(&settings);
    assert_int_equal(mor_soil_init(&box->context, &box->soil, "sand", &settings, box->sand, (int64_t)SIDE_X * SIDE_Y),
                     MOR_OK);
    double *const *data = box->soil.set.data;
    for (int i = 0; i < SIDE_X * SIDE_Y; ++i) {
        data[MOR_FIELD_POSITION][3 * i] = 0.01 * (i % SIDE_X + 0.5);
        data[MOR_FIELD_POSITION][3 * i + 1] = 0.01 * (i / SIDE_X + 0.5);
        data[MOR_FIELD_VELOCITY][3 * i] = 0.4 * cloud_number((uint64_t)i, 1, -1.0, 1.0);
        data[MOR_FIELD_MASS][i] = 0.16;
        data[MOR_FIELD_DENSITY][i] = 1600.0;
    }
    add_floor(box);
    assert_int_equal(mor_soil_init_state(&box->context, &box->soil), MOR_OK);
    mor_soil_sort(&box->context, &box->soil);
    mor_stepper stepper;
    uint64_t evolving = 0;
    mor_soil_stepper(&box->soil, &stepper, &evolving);
    assert_int_equal(mor_schedule_init(&box->context, &box->schedule, 1.0), MOR_OK);
    assert_int_equal(mor_schedule_add(&box->context, &box->schedule, &stepper, evolving), MOR_OK);
}

/* Room of everything that grows when more soil touches more soil or wall. */
static int64_t room_of(const mor_soil *soil)
{
    return soil->inner.capacities[0] + soil->walls[0].relation.capacities[0] + soil->walls[0].capacity;
}

static void time_loop_allocates_only_when_lists_have_grown(void **state)
{
    (void)state;
    sandbox *box = calloc(1, sizeof *box);
    assert_non_null(box);
    open_sandbox(box);
    assert_int_equal(mor_schedule_step(&box->context, &box->schedule, box->schedule.end), MOR_OK);
    int n_steady = 0;
    int n_sorted = 0;
    for (int step = 0; step < STEPS; ++step) {
        const uint64_t n_builds = box->soil.inner.n_builds + box->soil.walls[0].relation.n_builds;
        const uint64_t n_allocations = box->context.n_allocations;
        const uint64_t generation = box->soil.set.generation;
        const int64_t room = room_of(&box->soil);
        assert_int_equal(mor_schedule_step(&box->context, &box->schedule, box->schedule.end), MOR_OK);
        const bool is_steady = box->soil.inner.n_builds + box->soil.walls[0].relation.n_builds == n_builds;
        n_steady += is_steady;
        n_sorted += box->soil.set.generation != generation;
        if (is_steady || room_of(&box->soil) == room) {
            assert_int_equal(box->context.n_allocations, n_allocations);
        }
    }
    assert_true(n_steady >= STEPS / 2 && n_steady < STEPS); /* most steps go without a rebuild, but not all */
    assert_int_equal(n_sorted, 2);                          /* steps 8 and 16 */
    mor_soil_clear(&box->context, &box->soil);
    mor_material_destroy(&box->context, &box->sand);
    assert_int_equal(box->context.memory_bytes, 0);
    free(box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_aligned_zeroed_and_all_usable),
        cmocka_unit_test(large_blocks_are_aligned_zeroed_and_all_usable),
        cmocka_unit_test(blocks_do_not_overlap),
        cmocka_unit_test(counters_follow_what_is_held),
        cmocka_unit_test(nothing_is_allocated_for_no_items),
        cmocka_unit_test(sizes_that_cannot_be_are_refused),
        cmocka_unit_test(time_loop_allocates_only_when_lists_have_grown),
    };
    return CLOUD_RUN(tests);
}
