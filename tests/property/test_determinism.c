/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/parallel.h"
#include "tests/common/scene_variant.h"

#include <unistd.h>

/* Checksums are compared bit by bit: all of them exact. The scenes are finer here than elsewhere, so that each loop has
 * work for three threads and each reduction more than one block. */
enum { N_STEPS = 40 };

#define SAND_BLOCK                                                                                                     \
    "material = { model = 'mohr_coulomb'; density = 1600; youngs_modulus = '4 MPa'; poissons_ratio = 0.3;"             \
    "  friction_angle = '32 deg'; }; "

static const char *const fine_plane[] = {"spacing=4.5 mm", NULL};
static const char *const fine_space[] = {"spacing=7 mm", NULL};

static uint64_t find_checksum(const char *text, const char *const *fine, const char *const *variant,
                              const char *const *more, int n_threads)
{
    const scene_request request = {text, (const char *const *[]){fine, variant, more}, 3, n_threads};
    scene *it = scene_new(&request);
    assert_true(it->simulation.soil.set.n_particles > MOR_BLOCK);
    scene_step(it, N_STEPS);
    const uint64_t checksum = mor_set_checksum(&it->simulation.soil.set);
    scene_free(it);
    return checksum;
}

static const char *const nothing[] = {NULL};

/* Variants of which other tests ask more than single precision gives. */
static const scene_variant in_mixed_precision[] = {
    {"mixed precision", {"numerics.precision=mixed", "numerics.artificial_stress=true", NULL}},
    {"moraine in mixed precision", {"numerics.scheme=moraine", "numerics.precision=mixed", NULL}},
};

enum { VARIANTS = SCENE_VARIANTS + sizeof in_mixed_precision / sizeof *in_mixed_precision };

static const scene_variant *variant_at(int k)
{
    return k < SCENE_VARIANTS ? &scene_variants[k] : &in_mixed_precision[k - SCENE_VARIANTS];
}

/* A variant that changed nothing would be no test, hence the comparison with the plain scene. */
static void check_threads(const char *text, const char *const *fine)
{
    const uint64_t plain = find_checksum(text, fine, nothing, nothing, 1);
    for (int k = 0; k < VARIANTS; ++k) {
        const char *const *variant = variant_at(k)->settings;
        const uint64_t one = find_checksum(text, fine, variant, nothing, 1);
        if (k > 0 && one == plain) {
            fail_msg("'%s' changes nothing", variant_at(k)->name);
        }
        for (int n_threads = 2; n_threads <= 3; ++n_threads) {
            if (find_checksum(text, fine, variant, nothing, n_threads) != one) {
                fail_msg("'%s': %d threads give another result than one", variant_at(k)->name, n_threads);
            }
        }
    }
}

static void plane_soil_does_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    check_threads(scene_plane, fine_plane);
}

static void space_soil_does_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    check_threads(scene_space, fine_space);
}

/* Lists hold more than the kernel reaches, and are rebuilt sooner or later: neither may show. With no skin they are
 * rebuilt in each step. */
static void soil_does_not_depend_on_the_skin_of_its_neighbor_lists(void **state)
{
    static const char *const skins[][2] = {
        {"numerics.skin_ratio=0", NULL}, {"numerics.skin_ratio=0.1", NULL}, {"numerics.skin_ratio=1.5", NULL}};
    (void)state;
    for (int k = 0; k < VARIANTS; ++k) {
        const char *const *variant = variant_at(k)->settings;
        const uint64_t usual = find_checksum(scene_plane, fine_plane, variant, nothing, 1);
        for (int skin = 0; skin < 3; ++skin) {
            if (find_checksum(scene_plane, fine_plane, variant, skins[skin], 1) != usual) {
                fail_msg("'%s' with %s gives another result", variant_at(k)->name, skins[skin][0]);
            }
        }
    }
}

/* A checksum that did not look at the state would pass all of the above. */
static void checksum_tells_one_step_from_the_next(void **state)
{
    (void)state;
    const scene_request request = {scene_plane, NULL, 0, 1};
    scene *it = scene_new(&request);
    const uint64_t before = mor_set_checksum(&it->simulation.soil.set);
    scene_step(it, 1);
    assert_true(mor_set_checksum(&it->simulation.soil.set) != before);
    scene_free(it);
}

/* Two heaps of four grains, 2^32 units of places apart, so that in single precision, where places are kept modulo that,
 * they are at the same place. One cluster holds both, so that each sees what is listed for the other. */
static const char far_apart[] =
    "dimension = 2; spacing = '5 mm'; gravity = (0, 0, 0); end = '20 ms';"
    "domain = { min = (-0.1, -0.1, -1); max = (4.2, 0.1, 1); };"
    "soil = ( { name = 'here'; shape = { type = 'box'; min = (0, 0); max = (0.01, 0.01); }; " SAND_BLOCK "},"
    "  { name = 'there'; shape = { type = 'box'; min = (4, 0.02); max = (4.01, 0.03); };"
    "    velocity = (0, '-1 m/s', 0); " SAND_BLOCK "} );"
    "probes = ( { type = 'largest_speed'; soil = 'here'; } );";

/* Soil moves past as far away as no list reaches: nothing is felt of it. */
static void soil_sees_none_that_is_far_away(void **state)
{
    static const char *const precisions[][2] = {{"numerics.precision=double", NULL},
                                                {"numerics.precision=mixed", NULL}};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const scene_request request = {far_apart, (const char *const *[]){precisions[k]}, 1, 1};
        scene *it = scene_new(&request);
        const double unit = mor_pair_length_unit(it->simulation.soil.constants.smoothing_length);
        assert_true(fmod(4.0 / unit, 0x1p32) == 0.0);
        scene_advance(it, 0.02);
        assert_true(scene_probe(it, "largest_speed") == 0.0);
        scene_free(it);
    }
}

int main(int argc, char **argv)
{
    (void)argc;
    /* Threads that wait by spinning crawl where others need the cores. OpenMP looks at this once, before main. */
    if (getenv("OMP_WAIT_POLICY") == NULL && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_soil_does_not_depend_on_the_number_of_threads),
        cmocka_unit_test(space_soil_does_not_depend_on_the_number_of_threads),
        cmocka_unit_test(soil_does_not_depend_on_the_skin_of_its_neighbor_lists),
        cmocka_unit_test(checksum_tells_one_step_from_the_next),
        cmocka_unit_test(soil_sees_none_that_is_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
