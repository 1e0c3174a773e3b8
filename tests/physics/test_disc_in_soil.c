/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A rigid disc in soil that is squeezed between smooth walls, beside finite elements of the same cell: of a viscous
 * fluid, and of limit analysis for clay. A disc that clay slips along makes it weaker, one that it sticks to does not.
 * docs/validation/srm-slope.md tells what follows for slopes with rocks. */
#include "tests/common/disc_cell.h"
#include "tests/common/scene.h"

#define WIDTH 0.6     /* of the clay, m; as in the scene */
#define SPEED 0.3     /* of two walls, m/s */
#define RADIUS 0.1    /* m */
#define STRENGTH 10e3 /* of the clay, Pa */
#define VISCOSITY 1e3 /* of the fluid, Pa s */
#define RATE 0.5      /* of the strain, 1/s */

static const char squeezed[] =
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0);"
    "domain = { min = (-0.1, -0.1, -1); max = (0.75, 0.7, 1); };"
    "soil = ( { name = 'clay'; particles = 'relaxed'; shape = { type = 'box'; min = (0, 0); max = (0.6, 0.6); };"
    "  velocity_formula = ('0.5 * x', '-0.5 * y');"
    "  initial_stress = { type = 'formula'; formula = ('-4e4', '-4e4', '-4e4', '0'); };"
    "  material = { model = 'tresca'; density = 2000; youngs_modulus = '15 MPa'; poissons_ratio = 0.45;"
    "    undrained_strength = '10 kPa'; }; } );"
    "walls = ( { name = 'low'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; "
    "},"
    "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; },"
    "  { name = 'right'; friction = 'smooth'; velocity = (0.3, 0);"
    "    shape = { type = 'half_space'; point = (0.6, 0); normal = (-1, 0); }; },"
    "  { name = 'top'; friction = 'smooth'; velocity = (0, -0.3);"
    "    shape = { type = 'half_space'; point = (0, 0.6); normal = (0, -1); }; } );"
    "probes = ( { name = 'low'; type = 'wall_force'; wall = 'low'; direction = (0, -1); },"
    "  { name = 'left'; type = 'wall_force'; wall = 'left'; direction = (-1, 0); },"
    "  { name = 'right'; type = 'wall_force'; wall = 'right'; direction = (1, 0); },"
    "  { name = 'top'; type = 'wall_force'; wall = 'top'; direction = (0, 1); } );";

static const char rigid_disc[] =
    "bodies=({name='disc';position=(0.3,0.3);velocity=(0.15,-0.15);friction='rough';"
    "shape={type='sphere';center=(0,0);radius=0.1;};material={model='rigid';density=2000;};})";
static const char *const none[] = {NULL};
static const char *const rough[] = {rigid_disc, NULL};
static const char *const smooth[] = {rigid_disc, "bodies[0].friction=smooth", NULL};
static const char *const coulomb[] = {rigid_disc, "bodies[0].friction=coulomb", "bodies[0].friction_coefficient=0",
                                      NULL};
static const char *const clay[] = {NULL};
static const char *const fluid[] = {
    "soil[0].material={model='bingham';density=1000;bulk_modulus='5 MPa';shear_modulus='2 MPa';"
    "yield_stress='0 Pa';viscosity='1 kPa s';}",
    "soil[0].initial_stress.formula=('-8e3', '-8e3', '-8e3', '0')", NULL};

/* Half the difference of the pressures on the walls, Pa: mean over strains of 0.6 to 1.5 % along either axis, when all
 * clay yields and its particles are still spaced alike. */
static double find_strength(const char *const *soil, const char *const *disc)
{
    enum { SAMPLES = 19 };
    scene *it = scene_new(&(scene_request){squeezed, (const char *const *[]){disc, soil}, 2, 1});
    double sum = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        const double time = 0.012 + 0.001 * k;
        scene_advance(it, time);
        const double across = (scene_probe(it, "top") + scene_probe(it, "low")) / (WIDTH + SPEED * time);
        const double along = (scene_probe(it, "left") + scene_probe(it, "right")) / (WIDTH - SPEED * time);
        sum += 0.25 * (across - along);
    }
    scene_free(it);
    return sum / SAMPLES;
}

/* Ratios of soil with a disc to soil without. A radius that is off by a tenth of a spacing, a hundredth of it, changes
 * them by 2 % of what the disc changes at all. The finite elements are off by 0.004 for clay (30 fluids in turn, from
 * above), by less for a fluid. Where particles are spaced unlike along the axes, here by up to 3 %, the pressures on
 * the walls differ by 0.1 % of themselves, which is 0.4 % of the stress that squeezes the clay, and 0.8 % of that in
 * the fluid. Together 0.010 for clay and 0.013 for the fluid. */
static void expect_strengths(const char *const *soil, bool is_plastic)
{
    const double tolerance = 0.015;
    const double alone = find_strength(soil, none);
    const double stuck = disc_cell_strength(&(disc_cell){0.5 * WIDTH, RADIUS, true, is_plastic});
    const double slips = disc_cell_strength(&(disc_cell){0.5 * WIDTH, RADIUS, false, is_plastic});
    const double found[3] = {find_strength(soil, rough) / alone, find_strength(soil, smooth) / alone,
                             find_strength(soil, coulomb) / alone};
    print_message("%s: rough disc %.4f (finite elements %.4f); smooth %.4f, Coulomb without friction %.4f (%.4f)\n",
                  is_plastic ? "clay" : "fluid", found[0], stuck, found[1], found[2], slips);
    const double expected = is_plastic ? STRENGTH : 2.0 * VISCOSITY * RATE;
    scene_expect_near("strength of soil without a disc", alone, expected, 0.01 * expected);
    scene_expect_near("ratio with a rough disc", found[0], stuck, tolerance);
    scene_expect_near("ratio with a smooth disc", found[1], slips, tolerance);
    scene_expect_near("ratio with a disc without friction", found[2], slips, tolerance);
}

static void disc_in_clay_changes_its_strength_as_limit_analysis_says(void **state)
{
    (void)state;
    expect_strengths(clay, true);
}

static void disc_in_a_viscous_fluid_makes_it_stiffer(void **state)
{
    (void)state;
    expect_strengths(fluid, false);
}

/* The closed form: a few discs raise the viscosity by twice their share of the area where the fluid sticks to them, by
 * the share itself where it slips (Einstein's coefficients in the plane). And what limit analysis says exactly: clay
 * that sticks to a rigid disc is as strong as without it, for bands of shear pass by, and the stress may be uniform. */
static void finite_elements_agree_with_closed_forms(void **state)
{
    const double share = 0.25 * MOR_PI * 0.01; /* radius a tenth of half the side */
    const double next = 4.0 * share * share;   /* the order beyond is its square, a few times */
    (void)state;
    scene_expect_near("viscosity, sticks", disc_cell_strength(&(disc_cell){1.0, 0.1, true, false}), 1.0 + 2.0 * share,
                      2.0 * next);
    scene_expect_near("viscosity, slips", disc_cell_strength(&(disc_cell){1.0, 0.1, false, false}), 1.0 + share, next);
    scene_expect_near("strength, sticks", disc_cell_strength(&(disc_cell){1.0, 0.3, true, true}), 1.0,
                      0.001); /* 30 fluids in turn come down to 1.0006 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finite_elements_agree_with_closed_forms),
        cmocka_unit_test(disc_in_clay_changes_its_strength_as_limit_analysis_says),
        cmocka_unit_test(disc_in_a_viscous_fluid_makes_it_stiffer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
