/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/params.h"
#include "core/material/rate_integration.h"
#include "tests/common/laws.h"
#include "tests/common/template.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

/* The viscoplastic template without viscosity is Drucker and Prager's soil: integrated rates against return mapping. */

enum { STEPS = 200 };

static void set(const mor_material *law, double *values, const char *key, double value)
{
    const int entry = mor_params_find(law->parameters, key);
    if (entry >= 0) {
        values[mor_params_offset(law->parameters, entry)] = value;
    }
}

typedef struct outcome {
    double stress[6]; /* Pa */
    double plastic_strain;
    double outside; /* largest distance from the cone after any update, Pa */
    double seconds; /* of processor time per update */
    mor_integration_statistics taken;
} outcome;

/* Distance from the cone of the soil without viscosity, Pa. */
static double find_distance(const mor_material_instance *cone, const double *stress)
{
    double distance = 0.0;
    const mor_batch batch = {.n = 1, .stress_in = stress};
    assert_int_equal(cone->operations.admissible(cone, &batch, &distance), MOR_OK);
    return distance;
}

/* Shears a sample from 20 kPa of pressure at a rate of 10 per second by 2 %, well into plastic flow. */
static void fill(const mor_material *law, double viscosity, int method, double dilation, double *values)
{
    mor_params_defaults(law->parameters, values);
    set(law, values, "youngs_modulus", 10e6);
    set(law, values, "poissons_ratio", 0.3);
    set(law, values, "friction_angle", 0.5);
    set(law, values, "cohesion", 1e3);
    set(law, values, "dilation_angle", dilation);
    set(law, values, "viscosity", viscosity);
    set(law, values, "integration_method", method);
    set(law, values, "relative_tolerance", 1e-6);
    set(law, values, "absolute_tolerance", 1e-3);
}

static void drive(const mor_material *law, double viscosity, int method, double dilation, double pressure, outcome *out)
{
    static const double gradient[9] = {-2.0, 6.0, 0.0, 4.0, 1.0, 0.0, 0.0, 0.0, 0.5};
    const double density = 1600.0;
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    mor_context context;
    mor_material_instance *instance = NULL;
    mor_material_instance *cone = NULL;
    mor_context_init(&context);
    fill(law_named("drucker_prager"), 0.0, 0, dilation, values);
    assert_int_equal(mor_material_create(&context, law_named("drucker_prager"), density, values, &cone), MOR_OK);
    fill(law, viscosity, method, dilation, values);
    assert_int_equal(mor_material_create(&context, law, density, values, &instance), MOR_OK);
    memset(out, 0, sizeof *out);
    for (int a = 0; a < 3; ++a) {
        out->stress[a] = -pressure;
    }
    const double *state_in[] = {&out->plastic_strain};
    double *state_out[] = {&out->plastic_strain};
    const mor_batch batch = {.n = 1,
                             .time_step = 2e-3 / STEPS,
                             .density = &density,
                             .velocity_gradient = gradient,
                             .stress_in = out->stress,
                             .stress_out = out->stress,
                             .state_in = state_in,
                             .state_out = state_out};
    const clock_t start = clock();
    for (int k = 0; k < STEPS; ++k) {
        assert_int_equal(instance->operations.advance_rate(instance, &batch), MOR_OK);
        out->outside = fmax(out->outside, find_distance(cone, out->stress));
    }
    out->seconds = (double)(clock() - start) / CLOCKS_PER_SEC / STEPS;
    mor_rate_integration_add(instance, &out->taken);
    mor_material_destroy(&context, &instance);
    mor_material_destroy(&context, &cone);
}

/* Largest difference of a component, Pa. */
static double compare(const outcome *a, const outcome *b)
{
    double largest = 0.0;
    for (int k = 0; k < 6; ++k) {
        largest = fmax(largest, fabs(a->stress[k] - b->stress[k]));
    }
    return largest;
}

static void without_viscosity_integrated_rates_are_the_return_mapping(void **state)
{
    (void)state;
    mor_context context;
    template_law it = {0};
    mor_context_init(&context);
    template_open(&context, MOR_SOURCE_DIR, "template_rates", "viscoplastic_soil", &it);
    for (int is_dilatant = 0; is_dilatant < 2; ++is_dilatant) {
        const double dilation = is_dilatant ? 0.2 : 0.0;
        outcome mapped;
        drive(law_named("drucker_prager"), 0.0, 0, dilation, 20e3, &mapped);
        assert_true(mapped.plastic_strain > 1e-3);
        for (int method = 0; method < 2; ++method) { /* implicit, bdf */
            double last = INFINITY;
            for (int k = 0; k < 5; ++k) {
                outcome integrated;
                drive(it.material, 1e2 * pow(10.0, -k), method, dilation, 20e3, &integrated);
                const double difference = compare(&integrated, &mapped);
                print_message("dilation %.1f, %s, viscosity %g Pa s: differs by %.3g Pa; %.1f sub-steps, %.1f rates, "
                              "%.3g us an update (return mapping %.3g us)\n",
                              dilation, method == 0 ? "implicit" : "bdf", 1e2 * pow(10.0, -k), difference,
                              (double)integrated.taken.n_sub_steps / STEPS, (double)integrated.taken.n_rates / STEPS,
                              1e6 * integrated.seconds, 1e6 * mapped.seconds);
                /* First order in the viscosity, down to the tolerance of 1e-6 of 2e4 Pa per sub-step. */
                assert_true(difference < 0.15 * last || difference < 1.0);
                last = difference;
            }
            assert_true(last < 0.2); /* 1e-5 of the pressure */
        }
    }
    template_close(&context, &it);
}

/* Wherever in an update flow begins, in its second half, too, the update is not taken for an elastic one: that would
 * end up to 300 Pa outside the cone. */
static void update_in_which_flow_begins_ends_on_the_cone(void **state)
{
    (void)state;
    mor_context context;
    template_law it = {0};
    mor_context_init(&context);
    template_open(&context, MOR_SOURCE_DIR, "template_rates", "viscoplastic_soil", &it);
    for (int k = 0; k < 16; ++k) {
        outcome integrated;
        drive(it.material, 0.01, k % 2, 0.0, 20e3 + 100.0 * k, &integrated);
        assert_true(integrated.plastic_strain > 1e-3);
        assert_true(integrated.outside < 0.5); /* Pa: viscosity times rate, 0.1, and the tolerance */
    }
    template_close(&context, &it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_viscosity_integrated_rates_are_the_return_mapping),
        cmocka_unit_test(update_in_which_flow_begins_ends_on_the_cone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
