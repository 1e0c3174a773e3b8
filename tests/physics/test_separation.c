/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/stress/separation.h"
#include "tests/common/scene.h"

/* Soil that comes apart: in free flight, and after a fall; and soil that loses compression: in a collapse, and where a
 * loss is given (docs/theory/separation.md). */

#define SAND(cohesion)                                                                                                 \
    "material = { model = 'mohr_coulomb'; density = '1600 kg/m3'; youngs_modulus = '4 MPa'; poissons_ratio = 0.3;"     \
    "  friction_angle = '32 deg'; cohesion = '" cohesion "'; }; "

/* A block that falls by half of its height into a bin of its own width. */
#define FALL(cohesion, numerics)                                                                                       \
    "title = 'fall'; dimension = 2; spacing = '10 mm'; end = '2 s'; gravity = ('0 m/s2', '-9.81 m/s2');"               \
    "domain = { min = ('-0.1 m', '-0.1 m'); max = ('0.4 m', '0.5 m'); };"                                              \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0.1 m'); max = ('0.2 m', '0.3 m'); };" SAND(     \
        cohesion) "} );"                                                                                               \
                  "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, "   \
                  "1); }; },"                                                                                          \
                  "  { name = 'left'; friction = 'smooth';"                                                            \
                  "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"                  \
                  "  { name = 'right'; friction = 'smooth';"                                                           \
                  "    shape = { type = 'half_space'; point = ('0.2 m', '0 m'); normal = (-1, 0); }; } );"             \
                  "numerics = { " numerics " };"                                                                       \
                  "probes = ( { name = 'height'; type = 'center_of_mass'; direction = (0, 1); },"                      \
                  "  { name = 'volume'; type = 'volume'; }, { name = 'speed'; type = 'largest_speed'; } );"

/* A block in free flight. */
/* courant: the volume that is compared grows by the sum over the steps, whose number the bound was measured with. */
#define FLIGHT(numerics)                                                                                               \
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0);"                                                 \
    "domain = { min = (-1, -1); max = (1, 1); };"                                                                      \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (-0.1, -0.1); max = (0.1, 0.1); };" SAND(                 \
        "0 Pa") "  velocity_formula = ('4*x', '4*y'); } );"                                                            \
                "numerics = { courant = 0.5; dissipation_factor = 0; soil_hourglass = 0; " numerics " };"              \
                "probes = ( { name = 'volume'; type = 'volume'; }, { name = 'drift'; type = 'density_drift'; } );"

/* Height of the center of mass at rest over that of the block; 1: as dense as before. */
static double settled_height(const char *text)
{
    scene *it = scene_new(&(scene_request){.text = text});
    scene_advance(it, 1.0);
    const double height = scene_probe(it, "height");
    scene_expect_near("speed", scene_probe(it, "speed"), 0.0, 0.02); /* m/s: it fell at 1.4 m/s */
    scene_free(it);
    return height / 0.1;
}

/* The lowest row stands up to half a spacing off the floor, 5 % of the height at this spacing, and the rows above keep
 * some disorder: 10 % together. A fall leaves a third and more without the memory. */
static void soil_that_has_fallen_is_as_dense_as_before(void **state)
{
    (void)state;
    const double sand = settled_height(FALL("0 Pa", ""));
    const double torn = settled_height(FALL("100 Pa", ""));
    const double loose = settled_height(FALL("0 Pa", "separation_memory = false;"));
    if (!(sand > 0.95 && sand < 1.1 && torn > 0.95 && torn < 1.1 && loose > 1.25)) {
        fail_msg("heights over that of the block: sand %.3f, with cohesion %.3f, without memory %.3f", sand, torn,
                 loose);
    }
}

/* Sand that flies apart, v = a x: it separates by the logarithm of its volume, (1 + a t)^2, but for the corners, where
 * no linear field can be fitted. */
static void sand_that_flies_apart_separates_by_its_volume(void **state)
{
    (void)state;
    double volume[2];
    for (int remembers = 0; remembers < 2; ++remembers) {
        scene *it = scene_new(&(scene_request){.text = remembers ? FLIGHT("") : FLIGHT("separation_memory = false;")});
        const double start = scene_probe(it, "volume");
        scene_advance(it, 0.05);
        volume[remembers] = scene_probe(it, "volume") / start;
        /* A density that lags behind the volume by rounding of the time steps is not astray. */
        assert_true(!remembers || scene_probe(it, "drift") < 1e-3);
        const double *separation = it->simulation.soil.set.data[MOR_FIELD_SEPARATION];
        const double *x = it->simulation.soil.set.data[MOR_FIELD_POSITION];
        for (int64_t k = 0; k < it->simulation.soil.set.n_particles && remembers; ++k) {
            if (fabs(x[3 * k]) + fabs(x[3 * k + 1]) < 0.2) {
                /* Second-order time steps: (a dt)^2 times their number, 1e-5. */
                scene_expect_near("separation", separation[k], 2.0 * log(1.2), 1e-4);
            }
        }
        scene_free(it);
    }
    /* Density by summation is off by 2 % for a lattice this far apart; without the memory it takes a third of the
     * expansion for free surface. */
    scene_expect_near("volume", volume[1], 1.44, 0.04);
    assert_true(volume[0] < 1.32);
}

/* Sand that flows over a rough floor. */
#define COLLAPSE(numerics)                                                                                             \
    "dimension = 2; spacing = '10 mm'; end = '0.4 s'; gravity = ('0 m/s2', '-9.81 m/s2');"                             \
    "domain = { min = ('-0.1 m', '-0.1 m'); max = ('1.5 m', '0.5 m'); };"                                              \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = ('0.2 m', '0.2 m'); };"                     \
    "  material = { model = 'drucker_prager'; density = 1600; youngs_modulus = '4 MPa'; poissons_ratio = 0.3;"         \
    "    friction_angle = '25 deg'; }; } );"                                                                           \
    "walls = ( { name = 'floor'; friction = 'rough';"                                                                  \
    "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; },"                                        \
    "  { name = 'back'; friction = 'smooth';"                                                                          \
    "    shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; } );"                                      \
    "numerics = { " numerics " };"                                                                                     \
    "probes = ( { name = 'drift'; type = 'density_drift'; percentile = 95.0; } );"

/* The mean of runs with steps of unlike lengths: single ones differ by a quarter. */
static double largest_drift(const char *text)
{
    static const char *const steps[][2] = {
        {"numerics.courant=0.4"}, {"numerics.courant=0.5"}, {"numerics.courant=0.6"}};
    enum { N_RUNS = sizeof steps / sizeof *steps };
    double drift = 0.0;
    for (int k = 0; k < N_RUNS; ++k) {
        scene *it = scene_new(&(scene_request){text, (const char *const *[]){steps[k]}, 1, 1});
        scene_advance(it, 0.4);
        drift += scene_probe(it, "drift") / N_RUNS;
        scene_free(it);
    }
    return drift;
}

/* Elastic soil without gravity that has lost compression: what is restored becomes elastic energy, and none of it
 * counts as plastic. */
static const char lossy[] =
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0);"
    "domain = { min = (-1, -1); max = (1, 1); };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (-0.1, -0.1); max = (0.1, 0.1); };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "numerics = { stress_diffusion = 0; reconstruction = 'none'; };"
    "probes = ( { type = 'elastic_energy'; }, { type = 'plastic_energy'; }, { type = 'numerical_dissipation'; },"
    "  { type = 'energy_balance'; } );";

static void restored_compression_is_energy_that_is_given(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = lossy});
    mor_set *set = &it->simulation.soil.set;
    scene_step(it, 1); /* densities are summed */
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->data[MOR_FIELD_SEPARATION][i] = -MOR_SEPARATION_LOST - 0.1;
    }
    scene_step(it, 4);
    const double elastic = scene_probe(it, "elastic_energy");
    assert_true(elastic > 0.0);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        /* The part that is left after four steps. */
        scene_expect_near("lost compression", set->data[MOR_FIELD_SEPARATION][i],
                          -MOR_SEPARATION_LOST - 0.1 * pow(1.0 - MOR_SEPARATION_RESTORED, 4.0), 1e-15); /* rounding */
    }
    /* A law of the step alone: rounding. What is given lacks what the pressure has already done. */
    scene_expect_near("plastic energy", scene_probe(it, "plastic_energy"), 0.0, 1e-12 * elastic);
    assert_true(scene_probe(it, "numerical_dissipation") < -elastic);
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0,
                      0.01); /* volumes are those of the step's start */
    scene_free(it);
}

/* A pressure of one particle that diffuses to its neighbors is lost there, and gained where there is none to lose. */
static void pressure_that_diffuses_is_lost_compression(void **state)
{
    (void)state;
    const char *const diffuses[] = {"numerics.stress_diffusion=0.1", NULL};
    scene *it = scene_new(&(scene_request){lossy, (const char *const *[]){diffuses}, 1, 1});
    const mor_soil *soil = &it->simulation.soil;
    double *const *data = soil->set.data;
    const int64_t middle = soil->set.n_particles / 2;
    const double stiffness = 2000.0 * soil->sound_speed * soil->sound_speed;
    scene_step(it, 1);
    for (int a = 0; a < 3; ++a) {
        data[MOR_FIELD_STRESS][6 * middle + a] = -1e4;
    }
    double expected[400] = {0.0};
    assert_true(soil->set.n_particles <= 400);
    for (int step = 0; step < 8; ++step) { /* not all of them diffuse */
        const double before = mor_schedule_time(&it->simulation.schedule);
        scene_step(it, 1);
        const double length = mor_schedule_time(&it->simulation.schedule) - before;
        for (int64_t i = 0; i < soil->set.n_particles; ++i) {
            const double came = length * mor_separation_mean(data[MOR_FIELD_STRESS_DIFFUSION] + 6 * i);
            expected[i] = fmin(expected[i] - came / stiffness, 0.0);
            scene_expect_near("lost compression", data[MOR_FIELD_SEPARATION][i], expected[i], 1e-15); /* rounding */
        }
    }
    assert_true(data[MOR_FIELD_SEPARATION][middle] < -1e-5); /* of 1e4 Pa over the stiffness, 1.5e-3 */
    scene_free(it);
}

/* Found: 0.013 and 0.039 of the density. Less than half is asked for. */
static void soil_that_flows_over_a_floor_keeps_its_density(void **state)
{
    (void)state;
    const double kept = largest_drift(COLLAPSE(""));
    const double lost = largest_drift(COLLAPSE("separation_memory = false;"));
    if (!(kept < 0.5 * lost)) {
        fail_msg("density of one particle in twenty off by %.3f and more, without the memory by %.3f", kept, lost);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_that_has_fallen_is_as_dense_as_before),
        cmocka_unit_test(sand_that_flies_apart_separates_by_its_volume),
        cmocka_unit_test(restored_compression_is_energy_that_is_given),
        cmocka_unit_test(pressure_that_diffuses_is_lost_compression),
        cmocka_unit_test(soil_that_flows_over_a_floor_keeps_its_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
