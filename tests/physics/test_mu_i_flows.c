/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

/* The shipped cases of dense granular flow with mu(I), coarser than shipped: a gate that is withdrawn slowly leaves a
 * heap whose slope is the static friction; a silo loses mass at a rate that grows with the slot to the power of three
 * halves, whatever its filling (Beverloo's law in plane strain; without a length of grains the local law has no offset
 * of the width). */

static const double degree = 0.017453292519943295;
static const double gravity = 9.81;   /* m/s2 */
static const double density = 1550.0; /* of the soil in the silo, kg/m3 */

static void withdrawn_gate_leaves_the_slope_of_the_static_friction(void **state)
{
    (void)state;
    static const char *const coarse[] = {"spacing=10 mm", "soil[0].material.youngs_modulus=0.5 MPa", "end=3.5 s", NULL};
    const scene_request request = {MOR_SOURCE_DIR "/cases/repose-mu-i/case.cfg", (const char *const *[]){coarse}, 1, 1};
    scene *it = scene_new(&request);
    scene_advance(it, 3.5);
    const double angle = scene_probe(it, "repose_angle");
    const double kinetic_energy = scene_probe(it, "kinetic_energy");
    scene_free(it);
    scene_expect_near("slope of the heap, degrees", angle / degree, atan(0.3819) / degree,
                      1.5);                                              /* top and foot of a coarse heap */
    scene_expect_near("kinetic energy, J/m", kinetic_energy, 0.0, 1e-3); /* at rest; 0.25 while the gate moves */
}

/* Least-squares slope of the mass that has left over the time, kg/(m s), while it is between two limits, kg/m. */
static double find_rate(scene *it, double low, double high)
{
    double n = 0.0, sum_t = 0.0, sum_m = 0.0, sum_tt = 0.0, sum_tm = 0.0;
    double mass = scene_probe(it, "outflow_mass");
    while (mass < high) {
        scene_step(it, 5);
        const double time = mor_schedule_time(&it->simulation.schedule);
        mass = scene_probe(it, "outflow_mass");
        if (mass >= low) {
            n += 1.0;
            sum_t += time;
            sum_m += mass;
            sum_tt += time * time;
            sum_tm += time * mass;
        }
    }
    assert_true(n > 10.0);
    return (n * sum_tm - sum_t * sum_m) / (n * sum_tt - sum_t * sum_t);
}

static scene *open_silo(const char *scheme, double width)
{
    char left[160], right[160];
    snprintf(left, sizeof left, "walls[0].shape.points=((-0.15,0),(%.17g,0),(%.17g,-0.02),(-0.15,-0.02))", -0.5 * width,
             -0.5 * width - 0.02);
    snprintf(right, sizeof right, "walls[1].shape.points=((0.15,0),(%.17g,0),(%.17g,-0.02),(0.15,-0.02))", 0.5 * width,
             0.5 * width + 0.02);
    const char *const settings[] = {scheme,
                                    "spacing=4 mm",
                                    "soil[0].material.youngs_modulus=0.2 MPa",
                                    "soil[0].shape.min=(-0.124,0)",
                                    "soil[0].shape.max=(0.124,0.16)",
                                    "walls[2].shape.point=(-0.124,0)",
                                    "walls[3].shape.point=(0.124,0)",
                                    left,
                                    right,
                                    NULL};
    return scene_new(&(scene_request){MOR_SOURCE_DIR "/cases/silo/case.cfg", (const char *const *[]){settings}, 1, 1});
}

/* Rates through slots of 8 and 16 spacings, kg/(m s); the first also later, which must make no difference. */
static void find_rates(const char *scheme, const double *widths, double *rates)
{
    const double filling = density * 0.248 * 0.16; /* kg/m */
    for (int k = 0; k < 2; ++k) {
        scene *it = open_silo(scheme, widths[k]);
        rates[k] = find_rate(it, 0.05 * filling, 0.2 * filling);
        if (k == 0) {
            const double later = find_rate(it, 0.2 * filling, 0.35 * filling);
            scene_expect_near("rate later over rate", later / rates[0], 1.0, 0.05); /* scatter of single particles */
        }
        scene_free(it);
        if (getenv("MOR_TEST_SHOW") != NULL) {
            printf("%s, %g m: %g kg/(m s), %g of density root g width^1.5\n", scheme, widths[k], rates[k],
                   rates[k] / (density * sqrt(gravity) * pow(widths[k], 1.5)));
        }
    }
}

static void silo_discharges_at_a_rate_of_the_slot_to_three_halves(void **state)
{
    (void)state;
    static const double widths[2] = {0.032, 0.064}; /* m */
    double rates[2];
    find_rates("numerics.scheme=zhang2024", widths, rates);
    scene_expect_near("exponent of the width", log(rates[1] / rates[0]) / log(widths[1] / widths[0]), 1.5,
                      0.1); /* slots of few particles */
}

/* The wider slot takes a quarter of this silo's width and starts more slowly: with little numerical viscosity its rate
 * has not come to that of the law when a fifth of the soil has left. It is the same at half the spacing. */
static void faster_silo_discharges_no_faster_than_the_law(void **state)
{
    (void)state;
    static const double widths[2] = {0.032, 0.064}; /* m */
    double rates[2];
    find_rates("numerics.scheme=moraine", widths, rates);
    const double exponent = log(rates[1] / rates[0]) / log(widths[1] / widths[0]);
    assert_true(exponent < 1.5 && exponent > 1.3); /* golden: 1.37 at 4 mm, 1.40 at 2 mm */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(withdrawn_gate_leaves_the_slope_of_the_static_friction),
        cmocka_unit_test(silo_discharges_at_a_rate_of_the_slot_to_three_halves),
        cmocka_unit_test(faster_silo_discharges_no_faster_than_the_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
