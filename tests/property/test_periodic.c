/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/scene_variant.h"

/* The soil of scene_variant.h in a domain that repeats itself. Where the faces lie is then of no meaning: put through
 * the middle of the soil they must change nothing. */

static const char *const plane_period[] = {"domain.periodic=x", NULL};
static const char *const space_period[] = {"domain.periodic=xy", "domain.min=(-0.072, -0.12, -0.05)",
                                           "domain.max=(0.168, 0.12, 0.15)", NULL};
static const char *const space_box[] = {"domain.min=(-0.072, -0.12, -0.05)", "domain.max=(0.168, 0.12, 0.15)", NULL};

/* The order of the particles, and with it that of all sums, then is the same wherever the faces lie. */
static const char *const one_order[] = {"numerics.sort_interval=1000000", NULL};

static const char *const nothing[] = {NULL};

static scene *open_scene(const char *text, const char *const *period, const char *const *variant,
                         const char *const *more)
{
    const scene_request request = {text, (const char *const *[]){period, variant, more}, 3, 1};
    return scene_new(&request);
}

/* Moves the faces along all periodic axes by a share of the period, before the first step. */
static void move_faces(scene *it, double share)
{
    mor_soil *soil = &it->simulation.soil;
    for (int a = 0; a < 3; ++a) {
        const double way =
            soil->period.length[a] > 0.0 ? mor_period_round(&soil->period, share * soil->period.length[a]) : 0.0;
        soil->period.minimum[a] += way;
        soil->settings.domain_minimum[a] += way;
        soil->settings.domain_maximum[a] += way;
    }
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        mor_period_wrap(&soil->period, x, x);
    }
    mor_soil_forget_lists(soil);
}

/* Particles of which lists hold an image. */
static int64_t count_images(const scene *it)
{
    return it->simulation.soil.images.n;
}

/* Largest difference of a field, by the numbers of the particles, over its largest value. */
static double find_difference(scene *one, scene *other, int field)
{
    const mor_set *set = &one->simulation.soil.set;
    const mor_set *with = &other->simulation.soil.set;
    const mor_period *period = &other->simulation.soil.period;
    const int32_t *place = scene_find_places(other);
    const int n = set->fields[field].n_components;
    double largest = 0.0;
    double difference = 0.0;
    assert_int_equal(set->n_particles, with->n_particles);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        for (int a = 0; a < n; ++a) {
            const double x = set->data[field][n * i + a];
            double d = x - with->data[field][n * (int64_t)place[set->id[i]] + a];
            if ((field == MOR_FIELD_POSITION || field == MOR_FIELD_QUIET_PLACE) && period->length[a] > 0.0) {
                d -= period->length[a] * rint(d / period->length[a]);
            }
            largest = fmax(largest, fabs(x));
            difference = fmax(difference, fabs(d));
        }
    }
    return difference == 0.0 ? 0.0 : difference / largest;
}

/* Fails where any evolving field differs by more than a part of its largest value. */
static void expect_same(scene *one, scene *other, double tolerance, const char *name)
{
    const mor_set *set = &one->simulation.soil.set;
    for (int f = 0; f < set->n_fields; ++f) {
        if (set->data[f] != NULL && (set->fields[f].flags & MOR_FIELD_EVOLVES) != 0 && f != MOR_FIELD_CROSSINGS) {
            const double difference = find_difference(one, other, f);
            if (!(difference <= tolerance)) {
                fail_msg("'%s': field '%s' differs by %.3g of its largest value, more than %.3g", name,
                         set->fields[f].name, difference, tolerance);
            }
        }
    }
}

static const char *const moraine[] = {"numerics.scheme=moraine", NULL};
static const char *const moraine_normals[] = {"numerics.scheme=moraine", "numerics.wall_normals=geometry",
                                              "numerics.xsph=0.2", NULL};

enum { FACE_STEPS = 20, VARIANTS = SCENE_VARIANTS + 2 };

static scene_variant variant_at(int k)
{
    scene_variant it = {.name = "none"};
    if (k < SCENE_VARIANTS) {
        return scene_variants[k];
    }
    it.name = k == SCENE_VARIANTS ? "moraine" : "moraine with normals";
    const char *const *from = k == SCENE_VARIANTS ? moraine : moraine_normals;
    for (int s = 0; from[s] != NULL; ++s) {
        it.settings[s] = from[s];
    }
    return it;
}

/* Exact: an image lies at exactly one period, and sums go by the order of the owners. */
static void check_faces(const char *text, const char *const *period)
{
    int64_t n_images = 0;
    for (int k = 0; k < VARIANTS; ++k) {
        const scene_variant it = variant_at(k);
        scene *usual = open_scene(text, period, it.settings, one_order);
        scene *moved = open_scene(text, period, it.settings, one_order);
        move_faces(moved, k % 2 == 0 ? 0.5 : 0.37);
        scene_step(usual, FACE_STEPS);
        scene_step(moved, FACE_STEPS);
        n_images += count_images(moved);
        expect_same(usual, moved, 0.0, it.name);
        scene_free(usual);
        scene_free(moved);
    }
    assert_true(n_images > 30 * VARIANTS); /* soil there was at the faces */
}

static void faces_through_plane_soil_change_nothing(void **state)
{
    (void)state;
    check_faces(scene_plane, plane_period);
}

static void faces_through_soil_in_space_change_nothing(void **state)
{
    (void)state;
    check_faces(scene_space, space_period);
}

/* Sorted through the faces, sums are in another order: their rounding differs, and grows. */
static void faces_change_no_more_than_rounding_where_soil_is_sorted(void **state)
{
    (void)state;
    scene *usual = open_scene(scene_plane, plane_period, moraine, nothing);
    scene *moved = open_scene(scene_plane, plane_period, moraine, nothing);
    move_faces(moved, 0.5);
    scene_step(usual, FACE_STEPS);
    scene_step(moved, FACE_STEPS);
    expect_same(usual, moved, 1.0e-7, "sorted");
    scene_free(usual);
    scene_free(moved);
}

/* The oracle of all that is above: with the faces far from the soil, whose places are rounded to 4e-15 m, it moves as
 * in a domain that does not repeat itself. Rounding grows over the steps by less than a million. */
static void soil_far_from_the_faces_moves_as_without_them(void **state)
{
    (void)state;
    for (int k = 0; k < VARIANTS; k += 3) {
        const scene_variant it = variant_at(k);
        scene *without = open_scene(scene_plane, nothing, it.settings, one_order);
        scene *with = open_scene(scene_plane, plane_period, it.settings, one_order);
        scene_step(without, FACE_STEPS);
        scene_step(with, FACE_STEPS);
        expect_same(without, with, 1.0e-7, it.name);
        scene_free(without);
        scene_free(with);
        if (k == 0) {
            without = open_scene(scene_space, space_box, it.settings, one_order);
            with = open_scene(scene_space, space_period, it.settings, one_order);
            scene_step(without, FACE_STEPS);
            scene_step(with, FACE_STEPS);
            expect_same(without, with, 1.0e-7, it.name);
            scene_free(without);
            scene_free(with);
        }
    }
}

/* ---- Soil that fills the domain and goes on through its faces ---------------------------------------------------- */

static const char flow[] =
    "dimension = 2; spacing = '10 mm'; gravity = ('3 m/s2', '-6 m/s2', 0); end = '1 s'; lattice = { jitter = 0.2; };"
    "domain = { min = ('-0.07 m', '-0.05 m', '-1 m'); max = ('0.13 m', '0.3 m', '1 m'); periodic = 'x'; };"
    "soil = ( { name = 'sand'; velocity = ('1.5 m/s', 0, 0);"
    "  shape = { type = 'box'; min = ('-0.07 m', '0 m'); max = ('0.13 m', '0.1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '0.2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; cohesion = '0.1 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"
    "numerics = { sort_interval = 37; };";

static const char *const sliding_floor[] = {"walls[0].velocity=('-0.8 m/s', 0, 0)", NULL};
static const char *const summed[] = {"numerics.density_reinitialization=9", "numerics.artificial_stress=true", NULL};
static const char *const shifted[] = {"numerics.xsph=0.3", "numerics.shifting=true", NULL};

enum { FLOW_STEPS = 180 };

static uint64_t find_flow(const char *const *variant, const char *const *more, int n_threads, double *crossings)
{
    const scene_request request = {flow, (const char *const *[]){variant, more}, 2, n_threads};
    scene *it = scene_new(&request);
    scene_step(it, FLOW_STEPS);
    const mor_set *set = &it->simulation.soil.set;
    const uint64_t checksum = mor_set_checksum(set);
    *crossings = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double inside[3];
        *crossings += set->data[MOR_FIELD_CROSSINGS][3 * i];
        mor_period_wrap(&it->simulation.soil.period, set->data[MOR_FIELD_POSITION] + 3 * i, inside);
        assert_memory_equal(inside, set->data[MOR_FIELD_POSITION] + 3 * i, sizeof inside); /* it is inside */
    }
    scene_free(it);
    return checksum;
}

/* Exact, though lists are built at other times, before and after particles go through a face. */
static void flow_depends_neither_on_threads_nor_on_the_skin(void **state)
{
    static const char *const mixed[] = {"numerics.scheme=moraine", "numerics.precision=mixed", NULL};
    static const char *const *const variants[] = {nothing, sliding_floor, summed, shifted, mixed};
    static const char *const skins[][2] = {{"numerics.skin_ratio=0", NULL}, {"numerics.skin_ratio=0.9", NULL}};
    (void)state;
    for (int k = 0; k < (int)(sizeof variants / sizeof *variants); ++k) {
        double crossings = 0.0;
        const uint64_t one = find_flow(variants[k], nothing, 1, &crossings);
        assert_true(crossings > 60.0); /* of 200 particles, or the test were none */
        if (find_flow(variants[k], nothing, 3, &crossings) != one) {
            fail_msg("variant %d: threads change the result", k);
        }
        for (int skin = 0; skin < 2; ++skin) {
            if (find_flow(variants[k], skins[skin], 2, &crossings) != one) {
                fail_msg("variant %d: %s changes the result", k, skins[skin][0]);
            }
        }
    }
}

/* ---- Uniform motion ---------------------------------------------------------------------------------------------- */

static const char block_plane[] =
    "dimension = 2; spacing = '10 mm'; gravity = (0, 0, 0); end = '1 s'; lattice = { jitter = 0.2; };"
    "domain = { min = (0, 0, -1); max = (0.12, 0.11, 1); periodic = 'xy'; };"
    "soil = ( { name = 'sand'; velocity = ('3 m/s', '-2 m/s', 0);"
    "  shape = { type = 'box'; min = (0, 0); max = (0.12, 0.11); };"
    "  material = { model = 'hypoelastic'; density = '2000 kg/m3'; youngs_modulus = '0.5 MPa'; poissons_ratio = 0.3; "
    "}; } ); numerics = { density_reinitialization = 0; };";

static const char block_space[] =
    "dimension = 3; spacing = '10 mm'; gravity = (0, 0, 0); end = '1 s'; lattice = { jitter = 0.2; };"
    "domain = { min = (0, 0, 0); max = (0.12, 0.11, 0.1); periodic = 'xyz'; };"
    "soil = ( { name = 'sand'; velocity = ('3 m/s', '-2 m/s', '1 m/s');"
    "  shape = { type = 'box'; min = (0, 0, 0); max = (0.12, 0.11, 0.1); };"
    "  material = { model = 'hypoelastic'; density = '2000 kg/m3'; youngs_modulus = '0.5 MPa'; poissons_ratio = 0.3; "
    "}; } ); numerics = { density_reinitialization = 0; };";

/* Momentum of the soil along an axis, kg/s or kg m/s. */
static double find_momentum(const scene *it, int axis)
{
    const mor_set *set = &it->simulation.soil.set;
    double sum = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        sum += set->data[MOR_FIELD_MASS][i] * set->data[MOR_FIELD_VELOCITY][3 * i + axis];
    }
    return sum;
}

/* Soil that fills all of space and moves as a whole, off any lattice and without stress, meets no force: its velocity
 * stays to the last bit but for the rounding of the fit, and so does its momentum. It goes round more than once. */
static void soil_without_end_moves_on_unchanged(void **state)
{
    static const char *const texts[] = {block_plane, block_space};
    static const double velocities[2][3] = {{3.0, -2.0, 0.0}, {3.0, -2.0, 1.0}};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        scene *it = open_scene(texts[k], nothing, nothing, nothing);
        mor_set *set = &it->simulation.soil.set;
        const double momentum = find_momentum(it, 0);
        double crossings = 0.0;
        scene_step(it, k == 0 ? 600 : 60);
        for (int64_t i = 0; i < set->n_particles; ++i) {
            crossings += set->data[MOR_FIELD_CROSSINGS][3 * i];
            for (int a = 0; a < 3; ++a) {
                scene_expect_near("velocity", set->data[MOR_FIELD_VELOCITY][3 * i + a], velocities[k][a], 1.0e-11);
            }
            scene_expect_near("density", set->data[MOR_FIELD_DENSITY][i], 2000.0, 1.0e-7);
            for (int a = 0; a < 6; ++a) { /* 1e-12 of the stiffness */
                scene_expect_near("stress", set->data[MOR_FIELD_STRESS][6 * i + a], 0.0, 5.0e-7);
            }
        }
        assert_true(crossings > (k == 0 ? 1.0 : 0.1) * (double)set->n_particles);
        scene_expect_near("momentum", find_momentum(it, 0), momentum, 1.0e-12 * momentum);
        scene_free(it);
    }
}

/* With stress it does not stay as it is, but its momentum does: forces of pairs through a face cancel like others. */
static void momentum_is_kept_through_the_faces(void **state)
{
    (void)state;
    scene *it = open_scene(block_plane, nothing, nothing, nothing);
    mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        for (int a = 0; a < 4; ++a) {
            set->data[MOR_FIELD_STRESS][6 * i + a] =
                2.0e3 * (mor_random_uniform(5, (uint64_t)set->id[i], (uint64_t)a) - 0.7);
        }
    }
    const double before[2] = {find_momentum(it, 0), find_momentum(it, 1)};
    double fastest = 0.0;
    scene_step(it, 5);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        fastest = fmax(fastest, fabs(set->data[MOR_FIELD_VELOCITY][3 * i] - 3.0));
    }
    assert_true(fastest > 1.0e-3); /* before it has come to rest, it does move */
    scene_step(it, 300);
    for (int a = 0; a < 2; ++a) { /* rounding of 300 steps */
        scene_expect_near("momentum", find_momentum(it, a), before[a], 1.0e-11 * fabs(before[a]));
    }
    scene_free(it);
}

/* ---- Closed forms ------------------------------------------------------------------------------------------------ */

static const char layer[] =
    "dimension = 2; spacing = '10 mm'; gravity = (0, '-9.81 m/s2', 0); end = '2 s';"
    "domain = { min = ('0 m', '-0.05 m', '-1 m'); max = ('0.1 m', '0.3 m', '1 m'); periodic = 'x'; };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.1 m', '0.1 m'); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"
    "probes = ( { name = 'left'; type = 'energy_left'; },"
    "  { name = 'center'; type = 'center_of_mass'; origin = ('0.05 m', '0 m'); direction = (1, 0); },"
    "  { name = 'passed'; type = 'mass_passed'; origin = ('0.03 m', '0 m'); direction = (1, 0); },"
    "  { name = 'flow'; type = 'mass_flow'; origin = ('0.002 m', '0 m'); direction = (1, 0); },"
    "  { name = 'displacement'; type = 'displacement'; percentile = 50.0; } );"
    "numerics = { gravity_ramp = '0.1 s'; };";

/* Soil that is held by nothing but itself on both sides: each column carries its own weight, nothing moves sideways,
 * and elastic soil that cannot spread presses sideways with nu / (1 - nu) of its weight. */
static void layer_at_rest_stays_at_rest(void **state)
{
    (void)state;
    static const char *const elastic[] = {"soil[0].material.friction_angle='50 deg'", "numerics.damping='30 1/s'",
                                          NULL};
    scene *it = open_scene(layer, elastic, nothing, nothing);
    scene_advance(it, 0.5);
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double depth = 0.1 - set->data[MOR_FIELD_POSITION][3 * i + 1];
        const double *stress = set->data[MOR_FIELD_STRESS] + 6 * i;
        const double weight = 1600.0 * 9.81 * depth;
        assert_true(mor_vector_length(set->data[MOR_FIELD_VELOCITY] + 3 * i) < 1.0e-5); /* settling decays */
        assert_true(set->data[MOR_FIELD_CROSSINGS][3 * i] == 0.0);      /* exact: nothing went through */
        scene_expect_near("shear stress", stress[MOR_XY], 0.0, 1.0e-6); /* all columns are alike */
        if (depth > 0.02) { /* the kernel smears the surface over two spacings; at the floor rows alternate by 7 % */
            scene_expect_near("vertical stress", -stress[MOR_YY], weight, 0.08 * weight);
            scene_expect_near("lateral stress", stress[MOR_XX] / stress[MOR_YY], 0.3 / 0.7, 0.02);
        }
    }
    scene_free(it);
}

/* On 32 degrees the layer slides as a whole, with what gravity has beyond the strength of the cone in plane strain,
 * 3 alpha = 0.41061 of the pressure; where it has gone, and what has passed a plane, tell the same. */
static void layer_slides_with_what_friction_leaves_of_gravity(void **state)
{
    (void)state;
    static const char *const steep[] = {"gravity=('5.198508 m/s2', '-8.319352 m/s2', 0)", NULL};
    const double mass = 1600.0 * 0.01;
    scene *it = open_scene(layer, steep, nothing, nothing);
    scene_advance(it, 0.25);
    const double early = find_momentum(it, 0) / mass;
    scene_advance(it, 0.42);
    const double late = find_momentum(it, 0) / mass;
    scene_expect_near("acceleration", (late - early) / 0.17, 1.7828, 0.03 * 1.7828);
    const double center = scene_probe(it, "center");
    assert_true(center > 0.08); /* nearly a period */
    /* A column of particles passes at once. */
    scene_expect_near("mass passed", scene_probe(it, "passed"), mass / 0.1 * center, mass / 10.0);
    scene_expect_near("mass flow", scene_probe(it, "flow"), mass / 0.1 * late, 0.02 * mass / 0.1 * late);
    scene_expect_near("displacement", scene_probe(it, "displacement"), center, 0.02 * center);
    scene_free(it);
}

/* Undrained soil between rough plates, of which one goes round the domain, carries its strength, 1 kPa, and passes it
 * on from plate to plate. */
static void soil_between_plates_carries_its_strength(void **state)
{
    (void)state;
    static const char cell[] =
        "dimension = 2; spacing = '10 mm'; gravity = (0, 0, 0); end = '1 s';"
        "domain = { min = ('0 m', '-0.05 m'); max = ('0.1 m', '0.15 m'); periodic = 'x'; };"
        "soil = ( { name = 'clay'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.1 m', '0.1 m'); };"
        "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '0.5 MPa';"
        "    poissons_ratio = 0.3; friction_angle = 0; cohesion = '1 kPa'; }; } );"
        "walls = ( { name = 'floor'; friction = 'rough';"
        "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
        "  { name = 'plate'; velocity = ('0.5 m/s', 0); friction = 'rough';"
        "    shape = { type = 'half_space'; point = ('0 m', '0.1 m'); normal = (0, -1); }; } );"
        "probes = ( { name = 'floor'; type = 'wall_force'; wall = 'floor'; direction = (1, 0); },"
        "  { name = 'plate'; type = 'wall_force'; wall = 'plate'; direction = (1, 0); } );";
    scene *it = open_scene(cell, nothing, nothing, nothing);
    scene_advance(it, 0.25); /* the plate is at 1.25 periods */
    scene_expect_near("force on the floor", scene_probe(it, "floor"), 100.0, 2.0);
    scene_expect_near("force on the plate", scene_probe(it, "plate"), -100.0, 2.0);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_through_plane_soil_change_nothing),
        cmocka_unit_test(faces_through_soil_in_space_change_nothing),
        cmocka_unit_test(faces_change_no_more_than_rounding_where_soil_is_sorted),
        cmocka_unit_test(soil_far_from_the_faces_moves_as_without_them),
        cmocka_unit_test(flow_depends_neither_on_threads_nor_on_the_skin),
        cmocka_unit_test(soil_without_end_moves_on_unchanged),
        cmocka_unit_test(momentum_is_kept_through_the_faces),
        cmocka_unit_test(layer_at_rest_stays_at_rest),
        cmocka_unit_test(soil_between_plates_carries_its_strength),
        cmocka_unit_test(layer_slides_with_what_friction_leaves_of_gravity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
