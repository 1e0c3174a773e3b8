/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Bodies lighter than the soil they lie in: they make no energy, and what comes out does not depend on the step. */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

#define RADIUS 0.05
#define SPACING 0.01
#define SOIL_DENSITY 1600.0

/* A disc in the middle of a column of sand that is set free. */
static const char column[] =
    "title = 'disc'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '120 ms';"
    "domain = { min = ('-1 m', '-1 m'); max = ('3 m', '3 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.2 m'); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ("
    "  { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; friction = "
    "'rough'; },"
    "  { name = 'back'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; friction = "
    "'smooth'; }"
    ");"
    "bodies = ( { name = 'disc'; position = ('0.1 m', '0.1 m');"
    "  shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '50 mm'; };"
    "  material = { model = 'rigid'; density = '50 kg/m3'; }; } );"
    "probes = ( { name = 'run_out'; type = 'run_out'; percentile = 99.0; },"
    "  { name = 'x'; type = 'body_position'; body = 'disc'; direction = (1, 0, 0); },"
    "  { name = 'y'; type = 'body_position'; body = 'disc'; direction = (0, 1, 0); },"
    "  { name = 'boundary'; type = 'boundary_dissipation'; },"
    "  { name = 'balance'; type = 'energy_balance'; } );";

static const char *const nothing[] = {NULL};
static const char *const tenth[] = {"numerics.courant=0.04", NULL};
static const char *const one_clock[] = {"numerics.single_rate=true", NULL};

/* What is looked at when a run is over. */
typedef struct outcome {
    double run_out;  /* m */
    double place[2]; /* of the disc, m */
    double boundary; /* energy that walls and the disc took beside work, J/m */
    double balance;  /* 1 */
    double ratio;    /* added mass ratio of the disc, 1 */
    int64_t n_steps;
} outcome;

static outcome run(const char *const *body, const char *const *numerics)
{
    const char *const *lists[] = {body, numerics};
    const scene_request request = {column, lists, 2, 1};
    scene *it = scene_new(&request);
    const mor_schedule *schedule = &it->simulation.schedule;
    while (schedule->now < schedule->end) {
        scene_step(it, 1);
    }
    const outcome found = {.run_out = scene_probe(it, "run_out"),
                           .place = {scene_probe(it, "x"), scene_probe(it, "y")},
                           .boundary = scene_probe(it, "boundary"),
                           .balance = scene_probe(it, "balance"),
                           .ratio = it->simulation.bodies.groups[0]->bodies[0].added_mass_ratio,
                           .n_steps = (int64_t)schedule->n_steps};
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%-70s run-out %.5f, at (%.5f, %.5f), boundary %.4f, balance %.5f, ratio %.3f, %lld steps\n",
               body[0] != NULL ? body[0] : "50 kg/m3", found.run_out, found.place[0], found.place[1], found.boundary,
               found.balance, found.ratio, (long long)found.n_steps);
    }
    scene_free(it);
    return found;
}

#define ELASTIC(density, modulus)                                                                                      \
    "bodies[0].material={model='neo_hookean'; density='" density "'; youngs_modulus='" modulus                         \
    "'; poissons_ratio=0.25;}"

/* Rigid and elastic ones, stiffer than the soil and as soft. */
static const char *const light[][2] = {
    {"bodies[0].material.density=20 kg/m3", NULL},  {"bodies[0].material.density=100 kg/m3", NULL},
    {"bodies[0].material.density=500 kg/m3", NULL}, {ELASTIC("50 kg/m3", "20 MPa"), NULL},
    {ELASTIC("100 kg/m3", "2 MPa"), NULL},          {ELASTIC("500 kg/m3", "20 MPa"), NULL}};

static void light_body_makes_no_energy(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof light / sizeof *light; ++k) {
        const outcome found = run(light[k], nothing);
        assert_true(found.boundary > 0.0);             /* what is lost is lost, not gained */
        assert_true(fabs(found.balance - 1.0) < 0.01); /* first order in the step: 3e-3 was measured, soft and light */
        assert_true(found.place[1] > 0.0 && found.place[1] < 0.2);
    }
}

static void run_with_a_light_body_does_not_hang_on_the_step(void **state)
{
    (void)state;
    const outcome full = run(nothing, nothing);
    const outcome fine = run(nothing, tenth);
    const outcome single = run(nothing, one_clock);
    /* First order in the step; less than 1e-5 m was measured here. */
    scene_expect_near("run-out", full.run_out, fine.run_out, 0.01 * fine.run_out);
    for (int a = 0; a < 2; ++a) {
        scene_expect_near("place of the disc", full.place[a], fine.place[a], 0.1 * SPACING);
        scene_expect_near("place of the disc, one clock", single.place[a], fine.place[a], 0.1 * SPACING);
    }
}

/* The layer around a disc: rho dp pi R (1 + 1/3) moves with it, and a third of 2 rho dp pi R^3 turns with it. */
static void step_is_shortened_by_the_root_of_the_added_mass(void **state)
{
    (void)state;
    static const char *const heavy[] = {"bodies[0].material.density=2000 kg/m3", NULL};
    static const char *const held[] = {"bodies[0].motion=prescribed", NULL};
    const double layers = 4.0 / 3.0 * SPACING / RADIUS;
    const outcome of_light = run(nothing, nothing);
    const outcome of_heavy = run(heavy, nothing);
    const outcome of_held = run(held, nothing);
    scene_expect_near("ratio", of_light.ratio, layers * SOIL_DENSITY / 50.0, 0.01 * of_light.ratio);   /* nodes */
    scene_expect_near("ratio", of_heavy.ratio, layers * SOIL_DENSITY / 2000.0, 0.01 * of_heavy.ratio); /* likewise */
    assert_true(of_held.ratio == 0.0);
    /* Speeds of some percent of sound shorten the steps, too. */
    scene_expect_near("steps", (double)of_light.n_steps / (double)of_heavy.n_steps, sqrt(of_light.ratio), 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_body_makes_no_energy),
        cmocka_unit_test(run_with_a_light_body_does_not_hang_on_the_step),
        cmocka_unit_test(step_is_shortened_by_the_root_of_the_added_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
