/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

/* Grains that fly apart, hit rough ground and bounce: docs/theory/soil.md#grains-that-are-alone. */

/* A block thrown at level ground, that opens on its way. */
#define BLOCK(size, velocity)                                                                                          \
    "dimension = 3; spacing = '0.5 m'; end = '4 s'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2');"                     \
    "domain = { min = ('-60 m', '-60 m', '-6 m'); max = ('90 m', '60 m', '60 m'); };"                                  \
    "soil = ( { name = 'sand'; shape = { type = 'box'; " size " }; velocity_formula = " velocity ";"                   \
    "  material = { model = 'mohr_coulomb'; density = '2000 kg/m3'; youngs_modulus = '5.98 MPa'; poissons_ratio = "    \
    "0.3;"                                                                                                             \
    "    friction_angle = '30 deg'; }; } );"                                                                           \
    "walls = ( { name = 'ground'; friction = 'rough';"                                                                 \
    "  shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 0, 1); }; } );"                                  \
    "probes = ( { type = 'mass'; } );"

static const char *const blocks[] = {
    BLOCK("min = (0, 0, 1); max = (2, 2, 3);", "('10 + 2.5*(x-2)', '1.5*(y-1.5)', '2*(z-2) - 8')"),
    BLOCK("min = (0, 0, 0.5); max = (4, 4, 1.5);", "('6 + 2.5*(x-2)', '1.5*(y-1.5)', '2*(z-1) - 2')"),
};

/* Largest kinetic and potential energy of a grain over its mass, J/kg. */
static double largest_energy(const scene *it)
{
    const mor_set *set = &it->simulation.soil.set;
    double largest = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *v = set->data[MOR_FIELD_VELOCITY] + 3 * i;
        const double height = set->data[MOR_FIELD_POSITION][3 * i + 2];
        largest = fmax(largest, 0.5 * mor_vector_dot(v, v) + 9.81 * height);
    }
    return largest;
}

/* On level ground nothing gives a grain energy but its neighbors, which have no more. A hundredth is for what they
 * hand on. Where the contact of a grain that is alone was twice as stiff, energies grew 2.3 times with 0.6, 15
 * times with 0.7, and not with 0.3. */
static void grains_gain_no_energy_from_the_ground(void **state)
{
    (void)state;
    static const char *const steps[][2] = {
        {"numerics.courant=0.3"}, {"numerics.courant=0.6"}, {"numerics.courant=0.7"}};
    for (size_t k = 0; k < 3 * sizeof blocks / sizeof *blocks; ++k) {
        scene *it = scene_new(&(scene_request){blocks[k / 3], (const char *const *[]){steps[k % 3]}, 1, 1});
        double before = largest_energy(it);
        for (int tenth = 1; tenth <= 40; ++tenth) {
            scene_advance(it, 0.1 * tenth);
            const double energy = largest_energy(it);
            if (!(energy <= 1.01 * before)) {
                fail_msg("block %d, %s: the largest energy of a grain grows from %.3f to %.3f J/kg before %.1f s",
                         (int)(k / 3), steps[k % 3][0], before, energy, 0.1 * tenth);
            }
            before = fmin(before, energy); /* or one percent a tenth of a second would pass */
        }
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grains_gain_no_energy_from_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
