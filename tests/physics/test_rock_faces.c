/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "tests/common/free_block.h"

/* Rocks seen through the normals of their faces (docs/theory/walls.md), as they turn and bend. */

#define SPACING 0.01                      /* m */
#define SCALE (1e4 / (DENSITY * SPACING)) /* m/s2, what 10 kPa do to one spacing of soil */
#define DENSITY 2000.0                    /* kg/m3 */

/* Soil of one shape and a block of rock 0.4 m by 0.1 m, the middle of whose upper face is the origin. Its points are
 * relaxed at 17 degrees to its faces. */
static scene *soil_and_block(const char *soil, const char *material, const char *normals)
{
    static const char form[] =
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; soil = ( { name = 'soil'; shape = { type = %s; };"
        "material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
        "friction_angle = '30 deg'; cohesion = 0; }; } ); bodies = ( { name = 'rock'; particles = 'relaxed';"
        "angle = -0.29670597; angular_velocity = (0, 0, 2); material = { %s; density = 2400; };"
        "shape = { type = 'polygon'; points = ( (-0.19126095, -0.05847434), (-0.16202378, -0.15410482),"
        "(0.22049812, -0.03715614), (0.19126095, 0.05847434) ); }; } );"
        "numerics = { dissipation_factor = 0; stress_diffusion = 0; wall_normals = '%s'; };";
    char text[FREE_BLOCK_TEXT_BYTES];
    snprintf(text, sizeof text, form, soil, material, normals);
    return scene_new(&(scene_request){.text = text});
}

#define ONE_PARTICLE "'box'; min = (0.5, 0.5); max = (0.51, 0.51)"
#define RIGID "model = 'rigid'"
#define ELASTIC "model = 'neo_hookean'; youngs_modulus = '50 MPa'; poissons_ratio = 0.25"

/* Largest part of the force along the face, over that across it, of a particle pressed against the upper face of the
 * block at 21 places, after the block has turned for 0.1 s. */
static double find_largest_skew(const char *material, const char *normals)
{
    scene *it = soil_and_block(ONE_PARTICLE, material, normals);
    scene_advance(it, 0.1);
    double largest = 0.0;
    for (int k = 0; k < 21; ++k) {
        const double *center = it->simulation.bodies.groups[0]->bodies[0].center;
        const double *m = it->simulation.bodies.groups[0]->bodies[0].rotation;
        /* From the center of the block, which is half its height below the face. */
        const double place[3] = {-0.05 + 0.005 * k, 0.05 + 0.5 * SPACING, 0.0};
        double *x = free_block_field(it, MOR_FIELD_POSITION);
        double *stress = free_block_field(it, MOR_FIELD_STRESS);
        mor_matrix_apply(m, place, x);
        for (int a = 0; a < 3; ++a) {
            x[a] += center[a];
            free_block_field(it, MOR_FIELD_VELOCITY)[a] = 0.0;
            stress[a] = -1e4;
            stress[3 + a] = 0.0;
        }
        free_block_field(it, MOR_FIELD_DENSITY)[0] = DENSITY;
        mor_soil_forget_lists(&it->simulation.soil);
        const double along[3] = {m[0], m[3], m[6]};
        const double across[3] = {m[1], m[4], m[7]};
        scene_step(it, 1);
        const double *a = free_block_field(it, MOR_FIELD_ACCELERATION);
        assert_true(mor_vector_dot(a, across) > 0.5 * SCALE);
        largest = fmax(largest, fabs(mor_vector_dot(a, along)) / mor_vector_dot(a, across));
    }
    scene_free(it);
    return largest;
}

static void rocks_bear_along_the_normals_of_their_faces(void **state)
{
    (void)state;
    assert_true(find_largest_skew(RIGID, "geometry") <= 1e-7); /* its corners have 8 digits */
    /* Its center and rotation are means over the block, which the particle and its own spin strain by 1e-4. */
    assert_true(find_largest_skew(ELASTIC, "geometry") <= 1e-3);
    assert_true(find_largest_skew(RIGID, "kernel") >= 5e-3); /* or the test sees nothing */
}

/* The soil's momentum and moment about the origin change by what the points of the rock get. */
static void soil_and_points_of_a_rock_get_opposite_forces_and_moments(void **state)
{
    (void)state;
    scene *it = soil_and_block("'difference'; from = { type = 'box'; min = (-0.3, -0.2); max = (0.3, 0.1); };"
                               "minus = { type = 'box'; min = (-0.2, -0.1); max = (0.2, 0); }",
                               RIGID, "geometry");
    mor_soil *soil = &it->simulation.soil;
    for (int64_t k = 0; k < soil->set.n_particles; ++k) {
        for (int a = 0; a < 4; ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = -1e4 * mor_random_uniform(3, (uint64_t)k, (uint64_t)a);
        }
    }
    scene_step(it, 1);
    const mor_boundary *boundary = &it->simulation.bodies.groups[0]->boundary;
    double force[3] = {0.0, 0.0, 0.0};
    double moment[3] = {0.0, 0.0, 0.0};
    double size = 0.0;
    for (int64_t j = 0; j < boundary->n_points; ++j) {
        for (int a = 0; a < 3; ++a) {
            force[a] += boundary->force[3 * j + a];
        }
        size += mor_vector_length(boundary->force + 3 * j);
        mor_vector_cross_add(1.0, boundary->records + MOR_BOUNDARY_RECORD * j, boundary->force + 3 * j, moment);
    }
    assert_true(size > 100.0); /* N/m: or the test sees nothing */
    for (int a = 0; a < 3; ++a) {
        /* Rounding of sums of some hundred terms, at arms of 0.3 m. */
        scene_expect_near("force", force[a], boundary->patches[0].force[a], 1e-13 * size);
        scene_expect_near("moment", moment[a], boundary->patches[0].moment[a], 1e-13 * size);
        double given = 0.0;
        for (int64_t k = 0; k < soil->set.n_particles; ++k) {
            given += free_block_field(it, MOR_FIELD_MASS)[k] * free_block_field(it, MOR_FIELD_ACCELERATION)[3 * k + a];
        }
        scene_expect_near("momentum", given, -force[a], 1e-12 * size);
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rocks_bear_along_the_normals_of_their_faces),
        cmocka_unit_test(soil_and_points_of_a_rock_get_opposite_forces_and_moments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
