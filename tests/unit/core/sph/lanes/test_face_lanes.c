/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/eigen.h"
#include "core/base/isa.h"
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
 * of the others, and rounding turns directions of values this far apart by a few units in the last place. */
static void check_one(const double *faces, const mor_face_normals *found, int lane, const double *values,
                      const double *axes)
{
    const int largest = values[0] > values[1] ? (values[0] > values[2] ? 0 : 2) : (values[1] > values[2] ? 1 : 2);
    const double axis[3] = {axes[largest], axes[3 + largest], axes[6 + largest]};
    const double normal[3] = {found->normal[0][lane], found->normal[1][lane], found->normal[2][lane]};
    double across[3];
    mor_vector_cross(axis, normal, across);
    assert_true(mor_vector_length(across) < 1e-14);
    assert_true(fabs(mor_vector_length(normal) - 1.0) < 1e-15);
    if (found->is_plane[lane] == 0) {
        assert_true(fabs(found->value[lane] - values[largest]) < 1e-14 * mor_symmetric_trace(faces));
    }
}

static void directions_of_faces_are_their_principal_ones(void **state)
{
    (void)state;
    int n_several = 0, n_one = 0, n_plane = 0;
    for (int set = 0; set < MOR_ISA_COUNT; ++set) {
        const mor_soil_lanes *lanes = mor_soil_lanes_select(mor_isa_name(set));
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

/* The others see no face: what is found of them nobody reads. */
static void check_alone(const mor_soil_lanes *lanes, const double *faces, const mor_face_normals *all, int lane)
{
    double one[MOR_CLUSTER][STRIDE] = {{0.0}};
    mor_face_normals alone;
    memcpy(one[lane], faces, sizeof one[lane]);
    lanes->find_normals(one[0], STRIDE, &alone);
    assert_int_equal(alone.is_one[lane], all->is_one[lane]);
    assert_int_equal(alone.is_plane[lane], all->is_plane[lane]);
    assert_int_equal(alone.has_axes[lane], all->has_axes[lane]);
    assert_true(all->is_one[lane] == 0 || alone.value[lane] == all->value[lane]);
    for (int k = 0; k < 9; ++k) {
        assert_true(all->is_one[lane] == 0 || alone.normal[k / 3][lane] == all->normal[k / 3][lane]);
        assert_true(all->has_axes[lane] == 0 || alone.values[k / 3][lane] == all->values[k / 3][lane]);
        assert_true(all->has_axes[lane] == 0 || alone.axes[k][lane] == all->axes[k][lane]);
    }
}

static void lanes_do_not_depend_on_their_neighbors(void **state)
{
    (void)state;
    for (int set = 0; set < MOR_ISA_COUNT; ++set) {
        const mor_soil_lanes *lanes = mor_soil_lanes_select(mor_isa_name(set));
        for (uint64_t round = 0; round < 8 && lanes != NULL; ++round) {
            double faces[MOR_CLUSTER][STRIDE];
            mor_face_normals all;
            draw_faces(round, faces);
            lanes->find_normals(faces[0], STRIDE, &all);
            for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
                check_alone(lanes, faces[lane], &all, lane);
            }
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
