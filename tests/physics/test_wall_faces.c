/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/sph/soil_internal.h"
#include "tests/common/free_block.h"

/* Walls seen through the normals of their faces (docs/theory/walls.md): corners, edges, and soil that leaves a wall. */

#define SPACING 0.01                           /* m */
#define PRESSURE 1e4                           /* Pa */
#define DENSITY 2000.0                         /* kg/m3 */
#define SCALE (PRESSURE / (DENSITY * SPACING)) /* m/s2, what a pressure does to one spacing of soil */

/* Soil of one shape among walls, with what is to follow numerics. */
static scene *soil_among(const char *soil, const char *walls, const char *rest)
{
    static const char form[] =
        "dimension = 2; spacing = '10 mm'; end = '1 s'; output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; soil = ( { name = 'soil'; shape = { type = %s; };"
        "material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
        "friction_angle = '30 deg'; cohesion = 0; }; } ); walls = ( %s ); %s";
    char text[FREE_BLOCK_TEXT_BYTES];
    snprintf(text, sizeof text, form, soil, walls, rest);
    return scene_new(&(scene_request){.text = text});
}

#define STILL "gravity = (0, 0, 0); "
#define PLAIN "dissipation_factor = 0; stress_diffusion = 0; "
#define WALL(name, shape) "{ name = '" name "'; friction = 'smooth'; shape = { type = " shape "; }; }"

/* Acceleration of all particles, at rest under uniform pressure and as if nothing had been before; shape
 * [n_particles, 3], unit m/s2. */
static const double *press(scene *it)
{
    const int64_t n = it->simulation.soil.set.n_particles;
    memset(free_block_field(it, MOR_FIELD_VELOCITY), 0, (size_t)(3 * n) * sizeof(double));
    for (int64_t k = 0; k < n; ++k) {
        free_block_field(it, MOR_FIELD_DENSITY)[k] = DENSITY;
        free_block_field(it, MOR_FIELD_SEPARATION)[k] = 0.0;
        for (int a = 0; a < 6; ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = a < 3 ? -PRESSURE : 0.0;
        }
    }
    mor_soil_forget_lists(&it->simulation.soil); /* particles may have been put elsewhere */
    scene_step(it, 1);
    return free_block_field(it, MOR_FIELD_ACCELERATION);
}

/* Largest change of the acceleration, in SCALE, from one of n equal stretches of a way along a slope of 17 degrees into
 * the corner with an upright wall to the next. */
static double find_largest_change(int n)
{
    static const double along[2] = {0.9563048, 0.2923717};
    scene *it = soil_among("'box'; min = (0.1, 0.1); max = (0.11, 0.11)",
                           WALL("slope", "'half_space'; point = (0, 0); normal = (-0.2923717, 0.9563048)") ", " WALL(
                               "side", "'half_space'; point = (0, 0); normal = (1, 0)"),
                           STILL "numerics = { " PLAIN "wall_normals = 'geometry'; };");
    assert_int_equal(it->simulation.soil.set.n_particles, 1);
    double largest = 0.0;
    double last[2] = {0.0, 0.0};
    for (int k = 0; k <= n; ++k) {
        const double far = (4.0 - 3.0 * k / n) * SPACING;
        double *place = free_block_field(it, MOR_FIELD_POSITION);
        place[0] = far * along[0] - 0.5 * SPACING * along[1];
        place[1] = far * along[1] + 0.5 * SPACING * along[0];
        const double *a = press(it);
        if (k > 0) {
            largest = fmax(largest, hypot(a[0] - last[0], a[1] - last[1]));
        }
        last[0] = a[0];
        last[1] = a[1];
    }
    scene_free(it);
    return largest / SCALE;
}

static void force_is_continuous_on_the_way_into_a_corner(void **state)
{
    (void)state;
    const double coarse = find_largest_change(300);
    const double fine = find_largest_change(1200);
    assert_true(coarse > 1e-3); /* or there is no force */
    /* A quarter of the way, a quarter of the change, but for its curvature; a jump would stay as large. */
    assert_true(fine <= 0.3 * coarse);
}

/* Sums over soil and walls cancel all around a post, at its edges too. Whole cells, so that the kernel's sums do. */
static void pressure_around_a_post_accelerates_nothing(void **state)
{
    (void)state;
    scene *it = soil_among("'difference'; from = { type = 'box'; min = (0, 0); max = (0.4, 0.4); };"
                           "minus = { type = 'box'; min = (0.15, 0.15); max = (0.25, 0.25); }",
                           WALL("post", "'box'; min = (0.15, 0.15); max = (0.25, 0.25)"),
                           STILL "numerics = { " PLAIN "wall_normals = 'geometry'; };");
    const int64_t n = it->simulation.soil.set.n_particles;
    assert_int_equal(n, 40 * 40 - 10 * 10);
    const double *a = press(it);
    const double *x = free_block_field(it, MOR_FIELD_POSITION);
    for (int64_t k = 0; k < n; ++k) {
        if (fmax(fabs(x[3 * k] - 0.2), fabs(x[3 * k + 1] - 0.2)) < 0.1) {
            /* What a face's lattice has along it is 0.2 % of a sum of 0.45 / dp, twice by (W2); more where the second
             * face is only just seen. */
            assert_true(hypot(a[3 * k], a[3 * k + 1]) <= 0.01 * SCALE);
        }
    }
    scene_free(it);
}

/* Distance from the boundaries that soil sees, the smallest of all of them, m. */
static double find_distance(const scene *it, int64_t particle)
{
    const mor_soil *soil = &it->simulation.soil;
    double smallest = INFINITY;
    for (int b = 0; b < soil->n_walls + soil->n_boundaries; ++b) {
        const mor_soil_contact *contact = b < soil->n_walls ? &soil->walls[b] : &soil->boundaries[b - soil->n_walls];
        for (int64_t slot = 0; slot < contact->n_slots; ++slot) {
            const int64_t lane = particle - (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            if (lane >= 0 && lane < MOR_CLUSTER) {
                const double *faces = contact->seen_faces + MOR_FACE_SUMS * (slot * MOR_CLUSTER + lane);
                smallest = fmin(smallest, faces[MOR_FACE_DISTANCE]);
            }
        }
    }
    return smallest;
}

#define POST "'polygon'; points = ((-0.03320, -0.06243), (0.06243, -0.03320), (0.03320, 0.06243), (-0.06243, 0.03320))"

/* Around a post of 0.1 m turned by an angle, at its edges too, soil that is outside is not taken to be inside, and what
 * is inside by a third of a spacing is. */
static void check_distances(scene *it, double turn)
{
    static const double half = 0.05;
    double *place = free_block_field(it, MOR_FIELD_POSITION);
    for (int k = 0; k < 360; ++k) {
        for (int side = -1; side <= 1; side += 2) {
            const double angle = k * MOR_PI / 180.0;
            const double reach = half / fmax(fabs(cos(angle)), fabs(sin(angle))) + side * 0.3 * SPACING;
            place[0] = reach * cos(angle + turn);
            place[1] = reach * sin(angle + turn);
            press(it);
            const double found = find_distance(it, 0);
            const double deepest = side * 0.3 * SPACING * fmax(fabs(cos(angle)), fabs(sin(angle)));
            assert_true(side > 0 ? found >= 0.0 : fabs(found - deepest) <= 0.05 * SPACING); /* the points given */
        }
    }
}

static const double post_angle = 0.296706; /* of its sides, by the points above */

static void soil_beside_edges_of_a_wall_is_outside(void **state)
{
    (void)state;
    scene *it = soil_among("'box'; min = (0.3, 0.3); max = (0.31, 0.31)", WALL("post", POST),
                           STILL "numerics = { " PLAIN "wall_normals = 'geometry'; };");
    check_distances(it, post_angle);
    scene_free(it);
}

/* The same of a body that has turned: its normals turn, depths stay. */
static void soil_beside_edges_of_a_body_is_outside(void **state)
{
    (void)state;
    scene *it = soil_among("'box'; min = (0.3, 0.3); max = (0.31, 0.31)",
                           WALL("far", "'half_space'; point = (0, -0.9); normal = (0, 1)"),
                           STILL "bodies = ( { name = 'post'; motion = 'prescribed'; angle = '25 deg';"
                                 "  shape = { type = " POST "; }; material = { model = 'rigid'; density = 2400; }; } );"
                                 "numerics = { " PLAIN "wall_normals = 'geometry'; };");
    check_distances(it, post_angle + 25.0 * MOR_PI / 180.0);
    scene_free(it);
}

/* A plate driven down on a thin layer leaves it no room: soil is squeezed out aside or pressed together, but not
 * through the floor. */
static void soil_pressed_by_a_plate_does_not_pass_the_floor(void **state)
{
    (void)state;
    static const char *const ratios[][2] = {{"numerics.smoothing_ratio=1.3", NULL},
                                            {"numerics.smoothing_ratio=1.1", NULL}};
    for (size_t r = 0; r < sizeof ratios / sizeof *ratios; ++r) {
        const char *const *const lists[] = {ratios[r]};
        scene *it = scene_new(&(scene_request){
            .text = "dimension = 2; spacing = '10 mm'; end = '1 s'; output = { pictures = false; };"
                    "gravity = (0, -9.81, 0); domain = { min = (-1, -1, -1); max = (2, 2, 1); };"
                    "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.6, 0.02); };"
                    "material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa';"
                    "poissons_ratio = 0.3; friction_angle = '30 deg'; cohesion = 0; }; } );"
                    "walls = ( { name = 'floor'; friction = 'rough';"
                    "shape = { type = 'box'; min = (-0.4, -0.1); max = (1, 0); }; } );"
                    "bodies = ( { name = 'plate'; motion = 'prescribed'; velocity = (0, -0.5, 0);"
                    "shape = { type = 'box'; min = (0.1, 0.02); max = (0.5, 0.12); };"
                    "material = { model = 'rigid'; density = 2400; }; } );",
            .settings = lists,
            .n_lists = 1});
        scene_advance(it, 0.05); /* the plate is then 5 mm under the floor's face, half a spacing */
        const int64_t n = it->simulation.soil.set.n_particles;
        const double *x = free_block_field(it, MOR_FIELD_POSITION);
        double lowest = INFINITY;
        for (int64_t k = 0; k < n; ++k) {
            lowest = fmin(lowest, x[3 * k + 1]);
        }
        assert_true(n == 120);
        /* In the middle between the two faces, 2.5 mm deep. Without (W8) soil is shot through the floor. */
        assert_true(lowest > -0.35 * SPACING);
        scene_free(it);
    }
}

/* Cohesionless soil under a rough ceiling: nothing holds it. */
static void soil_that_is_not_pressed_against_a_wall_falls_free(void **state)
{
    (void)state;
    for (int way = 0; way < 2; ++way) {
        char rest[256];
        snprintf(rest, sizeof rest,
                 "gravity = (0, -9.81, 0); numerics = { stress_diffusion = 0; wall_normals = '%s'; };",
                 way == 0 ? "geometry" : "kernel");
        scene *it = soil_among("'box'; min = (0, 0); max = (0.2, 0.05)",
                               "{ name = 'ceiling'; friction = 'rough'; shape = { type = 'box'; min = (-0.1, 0.05);"
                               "max = (0.3, 0.1); }; }",
                               rest);
        scene_advance(it, 0.05);
        double fastest = -INFINITY;
        for (int64_t k = 0; k < it->simulation.soil.set.n_particles; ++k) {
            fastest = fmax(fastest, free_block_field(it, MOR_FIELD_VELOCITY)[3 * k + 1]);
        }
        if (way == 0) {
            /* m/s: rounding of the sum of 9.81 dt. */
            scene_expect_near("slowest", fastest, -9.81 * 0.05, 1e-9);
        } else {
            assert_true(fastest > -0.9 * 9.81 * 0.05); /* or the test sees nothing: the dissipation holds it */
        }
        scene_free(it);
    }
}

/* Component of the force of the soil on a wall or a body, N/m. */
static double find_force(scene *it, const char *name, int component)
{
    for (int k = 0; k < mor_soil_contact_count(&it->simulation.soil); ++k) {
        const mor_soil_contact *contact = mor_soil_contact_at(&it->simulation.soil, k);
        if (strcmp(contact->name, name) == 0) {
            return contact->force[component];
        }
    }
    fail_msg("no boundary is named %s", name);
    return NAN;
}

/* The vertical one over the weight of the soil, downward. */
static double find_load(scene *it, const char *name, double soil_weight)
{
    return -find_force(it, name, 1) / soil_weight;
}

/* Column of 20 by 40 particles on a rough floor, between a smooth body and a wall of some friction. */
static scene *column_between(const char *friction)
{
    static const char form[] =
        "{ name = 'floor'; friction = 'rough'; shape = { type = 'box'; min = (-0.2, -0.1); max = (0.4, 0); }; },"
        "{ name = 'right'; friction = %s; shape = { type = 'box'; min = (0.2, -0.1); max = (0.3, 0.5); }; }";
    char walls[512];
    snprintf(walls, sizeof walls, form, friction);
    return soil_among("'box'; min = (0, 0); max = (0.2, 0.4); }; initial_stress = { type = 'k0'", walls,
                      "gravity = (0, -9.81, 0); bodies = ( { name = 'left'; friction = 'smooth'; motion = 'prescribed';"
                      "material = { model = 'rigid'; density = 2000; };"
                      "shape = { type = 'box'; min = (-0.1, 0); max = (0, 0.5); }; } );");
}

static const double weight = DENSITY * 9.81 * 0.2 * 0.4; /* of the column, N/m */

/* What is smooth carries no weight, be it a wall or a body, though their sums are cut off where they meet the floor. */
static void smooth_sides_carry_no_weight(void **state)
{
    (void)state;
    scene *it = column_between("'smooth'");
    scene_advance(it, 0.1);
    /* Rows of one of 40 at surface and floor; 0.011 if what the sums give along the wall goes to the floor. */
    scene_expect_near("right", find_load(it, "right", weight), 0.0, 0.001);
    /* The body ends at the floor. A particle in the corner sees its lower face, too, and a smooth edge bears the normal
     * part of a stress that is half as large sideways: a tenth of one of 20 particles in a row. */
    scene_expect_near("left", find_load(it, "rigid", weight), 0.0, 0.005);
    scene_expect_near("floor", find_load(it, "floor", weight), 1.0, 0.006);
    scene_free(it);
}

/* Fastest particle, m/s. */
static double find_fastest(scene *it)
{
    double fastest = 0.0;
    for (int64_t k = 0; k < it->simulation.soil.set.n_particles; ++k) {
        fastest = fmax(fastest, mor_vector_length(free_block_field(it, MOR_FIELD_VELOCITY) + 3 * k));
    }
    return fastest;
}

/* The limit of friction is for the traction, not for what the soil's stress does along the wall. */
static void coulomb_wall_without_friction_is_smooth(void **state)
{
    (void)state;
    double fastest[2];
    double load[2];
    for (int k = 0; k < 2; ++k) {
        scene *it = column_between(k == 0 ? "'smooth'" : "'coulomb'; friction_coefficient = 0");
        scene_advance(it, 0.4);
        fastest[k] = find_fastest(it);
        load[k] = find_load(it, "right", weight);
        scene_expect_near("floor", find_load(it, "floor", weight), 1.0, 0.006); /* as above */
        scene_free(it);
    }
    /* Both ring alike; with the stress limited as well the column moved seven times as fast. */
    assert_true(fastest[1] < 2.0 * fastest[0]);
    scene_expect_near("right", load[1], load[0], 0.001); /* as above */
}

/* What slides along Coulomb walls has their friction: the probe tells the coefficient times the force across. */
static void force_on_a_coulomb_wall_is_its_friction(void **state)
{
    (void)state;
    static const char wall[] = "{ name = 'floor'; friction = 'rough'; shape = { type = 'box'; min = (-0.2, -0.1);"
                               "max = (0.4, 0); }; },"
                               "{ name = 'left'; friction = 'smooth'; shape = { type = 'box'; min = (-0.1, -0.1);"
                               "max = (0, 0.5); }; },"
                               "{ name = 'right'; friction = 'coulomb'; friction_coefficient = 0.02;"
                               "shape = { type = 'box'; min = (0.2, -0.1); max = (0.3, 0.5); }; }";
    scene *it = soil_among("'box'; min = (0, 0); max = (0.2, 0.4)", wall,
                           "gravity = (0, -9.81, 0); numerics = { gravity_ramp = 0.2; };");
    scene_advance(it, 0.1);
    const double across = find_force(it, "right", 0) / weight;
    /* The soil is compressed, and slides but for its lowest rows, which carry less. A smooth side is told as much. */
    scene_expect_near("friction", find_load(it, "right", weight), 0.02 * across, 0.001);
    assert_true(across > 0.2);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_is_continuous_on_the_way_into_a_corner),
        cmocka_unit_test(pressure_around_a_post_accelerates_nothing),
        cmocka_unit_test(soil_beside_edges_of_a_wall_is_outside),
        cmocka_unit_test(soil_beside_edges_of_a_body_is_outside),
        cmocka_unit_test(soil_pressed_by_a_plate_does_not_pass_the_floor),
        cmocka_unit_test(soil_that_is_not_pressed_against_a_wall_falls_free),
        cmocka_unit_test(smooth_sides_carry_no_weight),
        cmocka_unit_test(coulomb_wall_without_friction_is_smooth),
        cmocka_unit_test(force_on_a_coulomb_wall_is_its_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
