/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Random strength of a layer without ends goes on through the periodic face: another cut through the same endless
 * layer has the same values, so that no face can be told from the soil beside it. */

static const char text[] =
    "title = 'varied'; dimension = 2; spacing = '50 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"
    "domain = { min = ('0 m', '-0.5 m'); max = ('4 m', '2 m'); periodic = 'x'; };"
    "soil = ( { name = 'layer'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('4 m', '0.5 m'); };"
    "  material = { model = 'mohr_coulomb'; density = '1600 kg/m3'; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '10 kPa'; };"
    "  fields = ( { parameter = 'cohesion'; distribution = 'lognormal'; coefficient_of_variation = 0.4;"
    "    correlation_length = ('1 m', '0.3 m'); seed = 4; },"
    "    { parameter = 'friction_angle'; distribution = 'normal'; standard_deviation = '2 deg';"
    "    correlated_with = 'cohesion'; cross_correlation = -0.4; } ); } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );";

/* The value of the particle at a place, or a period beside it. */
static double find_value(const scene *it, const char *parameter, double x, double y)
{
    const mor_set *set = &it->simulation.soil.set;
    const int field = mor_set_find_field(set, parameter);
    double value = NAN;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
        const double away = place[0] - x - 4.0 * rint((place[0] - x) / 4.0);
        value = fabs(away) < 1.0e-6 && fabs(place[1] - y) < 1.0e-6 ? set->data[field][i] : value;
    }
    return value;
}

static void values_are_those_of_another_cut_through_the_layer(void **state)
{
    static const char *const parameters[] = {"cohesion", "friction_angle"};
    const char *const moved[] = {"domain.min=(1.5, -0.5)", "domain.max=(5.5, 2)", "soil[0].shape.min=(1.5, 0)",
                                 "soil[0].shape.max=(5.5, 0.5)", NULL};
    const char *const *const lists[] = {moved};
    const scene_request requests[2] = {{.text = text}, {.text = text, .settings = lists, .n_lists = 1}};
    (void)state;
    scene *here = scene_new(&requests[0]);
    scene *there = scene_new(&requests[1]);
    const mor_set *set = &here->simulation.soil.set;
    for (int k = 0; k < 2; ++k) {
        const int field = mor_set_find_field(set, parameters[k]);
        for (int64_t i = 0; i < set->n_particles; ++i) {
            const double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
            const double value = set->data[field][i];
            /* the rounding of the angles of waves, the shortest of which are 1e-3 m */
            scene_expect_near(parameters[k], find_value(there, parameters[k], place[0], place[1]), value,
                              1.0e-6 * value);
        }
    }
    scene_free(here);
    scene_free(there);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_another_cut_through_the_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
