/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/parallel.h"
#include "tests/common/body_variant.h"

#include <unistd.h>

/* Checksums are compared bit by bit: all of them exact. */
enum { N_STEPS = 25, N_SETS = MOR_BODY_GROUPS_MAX + 2 };

/* Checksums of all sets after some steps, what contact remembers included. */
typedef struct state {
    uint64_t sums[N_SETS];
    int n;
} state;

static state find_state(const char *text, const char *const *variant, int n_threads)
{
    const scene_request request = {text, (const char *const *[]){variant}, 1, n_threads};
    scene *it = scene_new(&request);
    mor_set *sets[N_SETS];
    state found = {{0}, 0};
    scene_step(it, N_STEPS);
    found.n = mor_simulation_sets(&it->simulation, true, sets);
    for (int k = 0; k < found.n; ++k) {
        found.sums[k] = mor_set_checksum(sets[k]);
    }
    scene_free(it);
    return found;
}

static void check_threads(const char *text)
{
    static const char *const nothing[] = {NULL};
    const state plain = find_state(text, nothing, 1);
    for (int k = 0; k < BODY_VARIANTS; ++k) {
        const state one = find_state(text, body_variants[k].settings, 1);
        if (k > 0 && memcmp(&one, &plain, sizeof one) == 0) {
            fail_msg("'%s' changes nothing", body_variants[k].name);
        }
        for (int n_threads = 2; n_threads <= 3; ++n_threads) {
            const state more = find_state(text, body_variants[k].settings, n_threads);
            if (memcmp(&one, &more, sizeof one) != 0) {
                fail_msg("'%s': %d threads give another result than one", body_variants[k].name, n_threads);
            }
        }
    }
}

/* Every so many variants are tried, from a first one on, so that both texts together try all. */
enum { SKIN_STRIDE = 2 };

/* A search with more margin finds more pairs that do nothing, and is done more rarely. */
static void check_skin(const char *text, int first)
{
    static const char *const skins[3] = {"numerics.skin_ratio=0", "numerics.skin_ratio=0.1", "numerics.skin_ratio=1.5"};
    for (int k = first; k < BODY_VARIANTS; k += SKIN_STRIDE) {
        const state usual = find_state(text, body_variants[k].settings, 1);
        for (int skin = 0; skin < 3; ++skin) {
            const char *list[SCENE_VARIANT_SETTINGS + 2] = {NULL};
            int n = 0;
            for (; body_variants[k].settings[n] != NULL; ++n) {
                list[n] = body_variants[k].settings[n];
            }
            list[n] = skins[skin];
            const state found = find_state(text, list, 1);
            if (memcmp(&found, &usual, sizeof found) != 0) {
                fail_msg("'%s': %s gives another result", body_variants[k].name, skins[skin]);
            }
        }
    }
}

static void rocks_in_plane_strain_do_not_depend_on_the_number_of_threads(void **unused)
{
    (void)unused;
    check_threads(body_plane);
}

static void rocks_in_space_do_not_depend_on_the_number_of_threads(void **unused)
{
    (void)unused;
    check_threads(body_space);
}

static void rocks_do_not_depend_on_the_margin_of_the_neighbor_search(void **unused)
{
    (void)unused;
    check_skin(body_plane, 0);
    check_skin(body_space, 1);
}

int main(int argc, char **argv)
{
    (void)argc;
    /* Threads that wait by spinning crawl where others need the cores. OpenMP looks at this once, before main. */
    if (getenv("OMP_WAIT_POLICY") == NULL && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rocks_in_plane_strain_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(rocks_in_space_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(rocks_do_not_depend_on_the_margin_of_the_neighbor_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
