/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/cloud.h"

#include <math.h>

enum { DRAWS = 40000, BINS = 32 };

static void mixer_gives_the_published_sequence(void **state)
{
    (void)state;
    /* SplitMix64 started at 1234567: the mixer of the k-th state is the k-th output. */
    static const uint64_t outputs[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                       4593380528125082431u, 16408922859458223821u};
    for (size_t k = 0; k < sizeof outputs / sizeof *outputs; ++k) {
        assert_true(mor_random_mix(1234567u + k * 0x9E3779B97F4A7C15u) == outputs[k]); /* exact: whole numbers */
    }
    assert_true(mor_random_mix(0) == 0xE220A8397B1DCDAFu); /* exact: first output for the seed 0 */
}

static int compare(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a;
    const uint64_t y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

static void mixer_maps_no_two_numbers_to_one(void **state)
{
    (void)state;
    static const uint64_t steps[] = {1, 1u << 20, (uint64_t)1 << 52, 0x9E3779B97F4A7C15u};
    for (size_t s = 0; s < sizeof steps / sizeof *steps; ++s) {
        uint64_t outputs[4096];
        for (uint64_t k = 0; k < 4096; ++k) {
            outputs[k] = mor_random_mix(k * steps[s]);
        }
        qsort(outputs, 4096, sizeof *outputs, compare);
        for (int k = 1; k < 4096; ++k) {
            assert_true(outputs[k] != outputs[k - 1]); /* exact: the mixer can be undone */
        }
    }
}

static void one_bit_in_turns_half_the_bits_out(void **state)
{
    (void)state;
    int turned = 0;
    for (uint64_t k = 0; k < 64; ++k) {
        for (int bit = 0; bit < 64; ++bit) {
            const uint64_t difference = mor_random_mix(k) ^ mor_random_mix(k ^ (uint64_t)1 << bit);
            const int n = __builtin_popcountll(difference);
            assert_true(n > 8 && n < 56); /* six standard deviations of 64 fair coins, 4 each */
            turned += n;
        }
    }
    assert_true(fabs(turned / (64.0 * 64.0) - 32.0) < 0.4); /* six standard deviations of the mean, 4 / 64 */
}

/* A stream of numbers over ids, purposes or seeds. */
static double draw(int stream, uint64_t k)
{
    const uint64_t seed = cloud_seed();
    switch (stream) {
    case 0:
        return mor_random_uniform(seed, k, 3);
    case 1:
        return mor_random_uniform(seed, 3, k);
    default:
        return mor_random_uniform(seed + k, 3, 3);
    }
}

static void numbers_are_even_in_zero_to_one(void **state)
{
    (void)state;
    for (int stream = 0; stream < 3; ++stream) {
        int bins[BINS] = {0};
        double sum = 0.0;
        double squares = 0.0;
        for (uint64_t k = 0; k < DRAWS; ++k) {
            const double x = draw(stream, k);
            assert_true(x >= 0.0 && x < 1.0); /* exact: the interval promised */
            ++bins[(int)(x * BINS)];
            sum += x;
            squares += x * x;
        }
        double chi2 = 0.0;
        for (int b = 0; b < BINS; ++b) {
            chi2 += (bins[b] - (double)DRAWS / BINS) * (bins[b] - (double)DRAWS / BINS) / ((double)DRAWS / BINS);
        }
        assert_true(chi2 < 80.0);                                   /* 31 degrees of freedom: once in 300 000 */
        assert_true(fabs(sum / DRAWS - 0.5) < 5.0 * 0.289 / 200.0); /* five standard deviations, sqrt(1/12/n) */
        assert_true(fabs(squares / DRAWS - 1.0 / 3.0) < 5.0 * 0.299 / 200.0); /* five, sqrt(4/45/n) */
    }
}

static void neighbors_in_a_stream_are_independent(void **state)
{
    (void)state;
    for (int stream = 0; stream < 3; ++stream) {
        double sum = 0.0;
        for (uint64_t k = 0; k < DRAWS; ++k) {
            sum += (draw(stream, k) - 0.5) * (draw(stream, k + 1) - 0.5);
        }
        assert_true(fabs(sum / DRAWS) < 5.0 / 12.0 / 200.0); /* five standard deviations of a mean of products */
    }
}

static void number_is_a_function_of_seed_id_and_purpose(void **state)
{
    (void)state;
    const double x = mor_random_uniform(1, 2, 3);
    assert_true(mor_random_uniform(1, 2, 3) == x); /* exact: the same call */
    assert_true(mor_random_uniform(2, 2, 3) != x); /* one in 2^53 by chance, and none here */
    assert_true(mor_random_uniform(1, 3, 3) != x); /* likewise */
    assert_true(mor_random_uniform(1, 2, 4) != x); /* likewise */
    assert_true(mor_random_uniform(1, 3, 2) != x); /* id and purpose may not be swapped */
    assert_true(mor_random_uniform(2, 1, 3) != x); /* nor seed and id */
    assert_true(mor_random_uniform(UINT64_MAX, UINT64_MAX, UINT64_MAX) < 1.0); /* exact: the ends are allowed */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mixer_gives_the_published_sequence),
        cmocka_unit_test(mixer_maps_no_two_numbers_to_one),
        cmocka_unit_test(one_bit_in_turns_half_the_bits_out),
        cmocka_unit_test(numbers_are_even_in_zero_to_one),
        cmocka_unit_test(neighbors_in_a_stream_are_independent),
        cmocka_unit_test(number_is_a_function_of_seed_id_and_purpose),
    };
    return CLOUD_RUN(tests);
}
