/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/boundary/soil_contact.h"
#include "core/sph/boundary/wall_clusters.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { CLUSTERS = 60 };

/* Counts two boundaries. Of the first, cluster 1 lists one patch, cluster 4 two, and with_all every other from 10 on;
 * of the second, cluster 4 lists one and cluster 6 none, for all it saw is removed. */
static void count(mor_context *context, mor_wall_clusters *at, bool with_all)
{
    int32_t occupied[CLUSTERS] = {1, 4};
    int32_t first_slot[CLUSTERS + 1] = {0, 1, 3};
    mor_soil_contact first = {.first_slot = first_slot};
    first.relation.occupied = occupied;
    first.relation.n_occupied = 2;
    for (int32_t cluster = 10; with_all && cluster < CLUSTERS; cluster += 2) {
        const int64_t k = first.relation.n_occupied++;
        occupied[k] = cluster;
        first_slot[k + 1] = first_slot[k] + 1;
    }
    int32_t others[2] = {4, 6};
    int32_t other_slots[3] = {0, 1, 1};
    mor_soil_contact second = {.first_slot = other_slots};
    second.relation.occupied = others;
    second.relation.n_occupied = 2;
    mor_wall_clusters_begin(at, CLUSTERS);
    mor_wall_clusters_count(at, &first);
    mor_wall_clusters_count(at, &second);
    assert_int_equal(mor_wall_clusters_end(context, at, CLUSTERS), MOR_OK);
}

static void clusters_that_list_boundaries_have_places_of_their_own(void **state)
{
    (void)state;
    mor_context context;
    mor_wall_clusters at = {.has_closed = true};
    mor_context_init(&context);
    assert_int_equal(mor_wall_clusters_init(&context, &at, CLUSTERS), MOR_OK);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        assert_int_equal(at.places[cluster], -1); /* before the first lists */
    }
    count(&context, &at, false);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        const int expected = cluster == 1 ? 0 : cluster == 4 ? 1 : -1;
        assert_int_equal(at.places[cluster], expected);
        assert_int_equal(at.n_patches[cluster], expected + 1);
        assert_int_equal(mor_wall_clusters_first(at.places, cluster), expected * MOR_CLUSTER);
        assert_int_equal(mor_wall_clusters_first(NULL, cluster), cluster * MOR_CLUSTER);
    }
    assert_int_equal(at.n, 2);
    assert_non_null(at.closed);
    assert_null(at.corners);
    assert_null(at.continued); /* not wanted */
    at.has_corners = true;     /* a boundary with normals was added */
    count(&context, &at, false);
    assert_non_null(at.corners);
    mor_wall_clusters_clear(&context, &at);
    assert_int_equal(context.memory_bytes, 0);
}

/* What is told is what is held, and room that suffices is kept. */
static void room_grows_with_the_clusters_at_boundaries(void **state)
{
    (void)state;
    mor_context context;
    mor_wall_clusters at = {.has_closed = true, .has_continued = true, .has_corners = true};
    mor_context_init(&context);
    assert_int_equal(mor_wall_clusters_init(&context, &at, CLUSTERS), MOR_OK);
    count(&context, &at, false);
    const double *closed = at.closed;
    count(&context, &at, false);
    assert_ptr_equal(at.closed, closed);
    const int64_t room = at.room;
    count(&context, &at, true);
    assert_int_equal(at.n, 2 + (CLUSTERS - 10) / 2);
    assert_true(at.room >= at.n && at.room > room);
    for (int64_t k = 0; k < at.n * MOR_CLUSTER; ++k) {
        at.closed[6 * k + 5] = at.continued[6 * k + 5] = 1.0; /* sanitizers see it where there is no room */
        at.corners[k].is_solved = true;
    }
    const double counted = mor_wall_clusters_bytes(&at, CLUSTERS);
    const double held = (double)context.memory_bytes; /* with what each of five arrays is rounded up by */
    assert_true(counted <= held && held <= counted + 5.0 * 128.0);
    mor_wall_clusters_clear(&context, &at);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clusters_that_list_boundaries_have_places_of_their_own),
        cmocka_unit_test(room_grows_with_the_clusters_at_boundaries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
