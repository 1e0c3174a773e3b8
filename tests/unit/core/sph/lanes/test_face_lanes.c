/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/eigen.h"
#include "core/base/random.h"
#include "core/particle/relation.h"
#include "core/sph/lanes/soil_lanes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { STRIDE = 7, ROUNDS = 2000 };

static const char *const sets[] = {"baseline", "avx2", "avx512"};

/* Eight sums of n (x) n of up to four faces within an angle of one another, in the units of a small particle. */
static void draw_faces(uint64_t round, double (*faces)[STRIDE])
{
    memset(faces, 0, MOR_CLUSTER * sizeof *faces);
    for (uint64_t lane = 0; lane < MOR_CLUSTER; ++lane) {
        const double spread = mor_random_uniform(3, round, 1000 + lane) * 1.2;
        for (uint64_t k = 0; k < 1 + (round + lane) % 4; ++k) {
            double n[3];
            for (uint64_t a = 0; a < 3; ++a) {
                const double common = mor_random_uniform(4, round, 8 * lane + a) - 0.5;
                const double own = mor_random_uniform(5, 8 * round + lane, 3 * k + a) - 0.5;
                n[a] = common + spread * own;
            }
            if (lane == 7) {
                n[2] = 0.0; /* as in plane strain */
            }
            const double weight = 1e-9 * (0.1 + mor_random_uniform(6, round, 8 * lane + k)) / mor_vector_dot(n, n);
            for (int a = 0; a < 3; ++a) {
                faces[lane][a] += weight * n[a] * n[a];
                faces[lane][3 + a] += weight * n[a] * n[(a + 1) % 3];
            }
        }
    }
}

/* Where faces count as one, the direction is the one whose principal value is largest. The tensor's power leaves 0.02^9
 * of the others, and values apart by less than the sum of them turn directions by rounding times 1 / 0.98. */
static void check_one(const double *faces, const mor_face_normals *found, int lane, const double *values,
                      const double *axes)
{
    const int largest = values[0] > values[1] ? (values[0] > values[2] ? 0 : 2) : (values[1] > values[2] ? 1 : 2);
    double along = 0.0;
    for (int a = 0; a < 3; ++a) {
        along += found->normal[a][lane] * axes[3 * a + largest];
    }
    assert_true(fabs(fabs(along) - 1.0) < 1e-14);
    if (found->is_plane[lane] == 0) {
        assert_true(fabs(found->value[lane] - values[largest]) < 1e-14 * mor_symmetric_trace(faces));
    }
}

static void directions_of_faces_are_their_principal_ones(void **state)
{
    (void)state;
    int n_several = 0, n_one = 0, n_plane = 0;
    for (size_t set = 0; set < sizeof sets / sizeof *sets; ++set) {
        const mor_soil_lanes *lanes = mor_soil_lanes_select(sets[set]);
        for (uint64_t round = 0; round < ROUNDS && lanes != NULL; ++round) {
            double faces[MOR_CLUSTER][STRIDE];
            mor_face_normals found;
            draw_faces(round, faces);
            lanes->find_normals(faces[0], STRIDE, &found);
            for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
                double values[3];
                double axes[9];
                mor_symmetric_eigen(faces[lane], values, axes);
                const double smaller = mor_symmetric_trace(faces[lane]) - fmax(fmax(values[0], values[1]), values[2]);
                /* The invariant bounds the smaller values together from above. */
                assert_true(found.is_one[lane] == 0 ||
                            smaller <= 1.0001 * MOR_FACES_ALIKE * mor_symmetric_trace(faces[lane]));
                assert_true(found.is_plane[lane] == 0 || found.is_one[lane] != 0);
                if (found.is_one[lane] != 0) {
                    check_one(faces[lane], &found, lane, values, axes);
                }
                assert_int_equal(found.has_axes[lane] != 0, found.is_one[lane] == 0 && lane != 7);
                for (int k = 0; k < 9 && found.has_axes[lane] != 0; ++k) {
                    assert_true(found.axes[k][lane] == axes[k]); /* to the last bit */
                    assert_true(found.values[k / 3][lane] == values[k / 3]);
                }
                n_several += found.has_axes[lane] != 0;
                n_one += found.is_one[lane] != 0 && found.is_plane[lane] == 0;
                n_plane += found.is_plane[lane] != 0;
            }
        }
    }
    assert_true(n_several > ROUNDS && n_one > ROUNDS && n_plane > ROUNDS);
}

/* Particles that see no face have numbers that nobody reads, and do not disturb the others. */
static void lanes_do_not_depend_on_their_neighbors(void **state)
{
    (void)state;
    const mor_soil_lanes *lanes = mor_soil_lanes_select(NULL);
    double faces[MOR_CLUSTER][STRIDE];
    double one[MOR_CLUSTER][STRIDE] = {{0.0}};
    mor_face_normals all, alone;
    draw_faces(1, faces);
    lanes->find_normals(faces[0], STRIDE, &all);
    for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
        memset(one, 0, sizeof one);
        memcpy(one[lane], faces[lane], sizeof one[lane]);
        lanes->find_normals(one[0], STRIDE, &alone);
        assert_true((alone.is_one[lane] != 0) == (all.is_one[lane] != 0));
        for (int a = 0; a < 3; ++a) {
            assert_true(all.is_one[lane] == 0 || alone.normal[a][lane] == all.normal[a][lane]);
            assert_true(all.has_axes[lane] == 0 || alone.values[a][lane] == all.values[a][lane]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_of_faces_are_their_principal_ones),
        cmocka_unit_test(lanes_do_not_depend_on_their_neighbors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
