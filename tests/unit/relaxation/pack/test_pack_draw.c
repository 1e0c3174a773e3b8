/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "relaxation/pack/pack_internal.h"
#include "tests/common/near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* What a packing draws for a rock, before it is asked whether there is room: moments of many draws against those of
 * even distributions. Tolerances are four standard deviations of the mean. */

enum { DRAWS = 20000, FORMS = 5 };

typedef struct draws {
    double rotation[9], square[9]; /* means of the entries of the turn, and of their squares */
    double place[3];               /* mean, over the bounds from 0 to 1 */
    double form[FORMS];            /* shares */
} draws;

static void draw_many(int dimension, uint64_t seed, draws *out)
{
    const mor_pack_request request = {.dimension = dimension, .n_forms = FORMS, .seed = seed};
    const mor_pack_state state = {.request = &request,
                                  .bounds = {{-1.0, 2.0, 0.0}, {3.0, 4.0, dimension == 3 ? 5.0 : 0.0}}};
    *out = (draws){.rotation = {0.0}};
    for (int k = 0; k < DRAWS; ++k) {
        mor_pack_item item = {.diameter = 1.0};
        mor_pack_draw(&state, mor_pack_draw_id(k % 100, k / 100), &item);
        assert_in_range(item.form, 0, FORMS - 1);
        out->form[item.form] += 1.0 / DRAWS;
        for (int a = 0; a < 9; ++a) {
            out->rotation[a] += item.rotation[a] / DRAWS;
            out->square[a] += item.rotation[a] * item.rotation[a] / DRAWS;
        }
        for (int a = 0; a < dimension; ++a) {
            const double low = state.bounds.minimum[a];
            out->place[a] += (item.position[a] - low) / (state.bounds.maximum[a] - low) / DRAWS;
        }
    }
}

static void expect_even_places_and_forms(const draws *it, int dimension)
{
    for (int a = 0; a < dimension; ++a) {
        assert_near(it->place[a], 0.5, 4.0 * sqrt(1.0 / 12.0 / DRAWS)); /* of an even share */
    }
    for (int k = 0; k < FORMS; ++k) {
        const double share = 1.0 / FORMS;
        assert_near(it->form[k], share, 4.0 * sqrt(share * (1.0 - share) / DRAWS)); /* of a choice */
    }
}

static void turns_in_space_are_all_equally_likely(void **state)
{
    (void)state;
    draws it;
    draw_many(3, 11, &it);
    for (int a = 0; a < 9; ++a) {
        assert_near(it.rotation[a], 0.0, 4.0 * sqrt(1.0 / 3.0 / DRAWS));      /* a component of an even direction */
        assert_near(it.square[a], 1.0 / 3.0, 4.0 * sqrt(4.0 / 45.0 / DRAWS)); /* of its square: 1/5 - 1/9 */
    }
    expect_even_places_and_forms(&it, 3);
}

static void turns_in_the_plane_are_all_equally_likely(void **state)
{
    (void)state;
    static const int in_plane[4] = {0, 1, 3, 4};
    draws it;
    draw_many(2, 12, &it);
    for (int k = 0; k < 4; ++k) {
        const int a = in_plane[k];
        assert_near(it.rotation[a], 0.0, 4.0 * sqrt(0.5 / DRAWS));     /* a cosine of an even angle */
        assert_near(it.square[a], 0.5, 4.0 * sqrt(1.0 / 8.0 / DRAWS)); /* of its square: 3/8 - 1/4 */
    }
    assert_near(it.rotation[8], 1.0, 1e-12); /* about z; rounding of a sum */
    expect_even_places_and_forms(&it, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_in_space_are_all_equally_likely),
        cmocka_unit_test(turns_in_the_plane_are_all_equally_likely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
