/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/frame/rate_lanes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { N = 21 };

/* A law that keeps the stress, adds 1 and 2 to its states, and does not solve where the stress xx is 7 Pa. */
static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    (void)constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        b->state[0][lane] += 1.0;
        b->state[1][lane] += 2.0;
        b->is_unsolved[lane] = b->stress[0][lane] == 7.0;
        b->n_unsolved += b->is_unsolved[lane];
    }
}

typedef struct particles {
    double stress[6 * N], gradient[9 * N], first[N], second[N];
    int64_t failed;
} particles;

static mor_status run(particles *p)
{
    const double *state_in[2] = {p->first, p->second};
    double *state_out[2] = {p->first, p->second};
    const mor_batch batch = {.n = N,
                             .time_step = 1.0,
                             .velocity_gradient = p->gradient,
                             .stress_in = p->stress,
                             .stress_out = p->stress,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &p->failed};
    return mor_rate_run(NULL, &batch, advance_lanes, 2);
}

static void all_state_variables_are_advanced(void **state)
{
    (void)state;
    particles p = {.failed = -1};
    for (int i = 0; i < N; ++i) {
        p.first[i] = i;
        p.second[i] = -i;
    }
    assert_int_equal(run(&p), MOR_OK);
    for (int i = 0; i < N; ++i) {
        assert_true(p.first[i] == i + 1.0 && p.second[i] == 2.0 - i); /* exact: small whole numbers */
    }
    assert_int_equal(p.failed, -1);
}

static void an_unsolved_particle_asks_for_a_smaller_step(void **state)
{
    (void)state;
    for (int64_t place = 0; place < N; ++place) {
        particles p = {.failed = -1};
        p.stress[6 * place] = 7.0;
        assert_int_equal(run(&p), MOR_RETRY_SMALLER_STEP);
        assert_int_equal(p.failed, place);
        p.gradient[9 * place] = NAN; /* what is worse goes first */
        assert_int_equal(run(&p), MOR_ERROR_NUMERIC);
        assert_int_equal(p.failed, place);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_state_variables_are_advanced),
        cmocka_unit_test(an_unsolved_particle_asks_for_a_smaller_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
