/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/parallel.h"
#include "tests/common/body_variant.h"

#include <unistd.h>

/* The audit of energy only looks: with every setting of the method, with rocks and without, it changes no bit of a run,
 * gives the same bits for any number of threads, and accounts for the energy. */

enum { N_SETS = MOR_BODY_GROUPS_MAX + 2, N_STEPS = 60, N_LONG = 250 };

static const char *const audited[] = {
    "probes=({type='plastic_energy';}, {type='numerical_dissipation';}, {type='riemann_energy';},"
    "{type='artificial_stress_energy';}, {type='stress_diffusion_energy';}, {type='boundary_dissipation';}, "
    "{type='friction_strain_energy';},"
    "{type='external_work';}, {type='energy_balance';})",
    NULL};
static const char *const silent[] = {"probes=({type='kinetic_energy';})", NULL};

static void step_and_follow(scene *it, int n_steps)
{
    for (int k = 0; k < n_steps && it->simulation.schedule.now < it->simulation.schedule.end; ++k) {
        scene_step(it, 1);
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    }
}

static void check_bits(const char *text, const scene_variant *variant)
{
    scene *with[2];
    uint64_t sums[3][N_SETS] = {{0}};
    int n_sets = 0;
    for (int run = 0; run < 3; ++run) {
        const char *const *probes = run == 0 ? silent : audited;
        const scene_request request = {text, (const char *const *[]){variant->settings, probes}, 2, run == 2 ? 3 : 1};
        mor_set *sets[N_SETS];
        scene *it = scene_new(&request);
        step_and_follow(it, N_STEPS);
        n_sets = mor_simulation_sets(&it->simulation, true, sets);
        for (int k = 0; k < n_sets; ++k) {
            sums[run][k] = mor_set_checksum(sets[k]);
        }
        if (run == 0) {
            scene_free(it);
        } else {
            with[run - 1] = it;
        }
    }
    for (int k = 0; k < n_sets; ++k) {
        if (sums[0][k] != sums[1][k]) {
            fail_msg("'%s': the audit changes set %d", variant->name, k);
        }
    }
    for (int k = 0; k < with[0]->the_case.n_probes; ++k) {
        const char *name = with[0]->the_case.probes[k].name;
        const double one = scene_probe(with[0], name);
        const double three = scene_probe(with[1], name);
        if (memcmp(&one, &three, sizeof one) != 0) {
            fail_msg("'%s': %s is %.17g with one thread and %.17g with three", variant->name, name, one, three);
        }
    }
    scene_free(with[0]);
    scene_free(with[1]);
}

static void check_balance(const char *text, const scene_variant *variant)
{
    const scene_request request = {text, (const char *const *[]){variant->settings, audited}, 2, 1};
    scene *it = scene_new(&request);
    step_and_follow(it, N_LONG);
    const double balance = scene_probe(it, "energy_balance");
    const double riemann = scene_probe(it, "riemann_energy");
    if (!(fabs(balance - 1.0) <= 0.02)) { /* the share of the energy that may go astray */
        fail_msg("'%s': the balance is %.5g", variant->name, balance);
    }
    if (!(riemann > 0.0)) {
        fail_msg("'%s': Riemann dissipation took %g J", variant->name, riemann);
    }
    scene_free(it);
}

typedef void (*check)(const char *text, const scene_variant *variant);

static void check_soil(check run)
{
    for (int k = 0; k < SCENE_VARIANTS; ++k) {
        run(scene_plane, &scene_variants[k]);
        run(scene_space, &scene_variants[k]);
    }
}

/* What the audit does not see: damping of rocks and the ramp of their weight; a barrier so stiff that particles cross
 * much of it in a step; rocks that shake themselves to pieces for want of viscosity. */
static bool is_audited(const char *name)
{
    static const char *const others[] = {"damping and ramp", "barrier that limits the step", "no viscous damping"};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
        if (strcmp(name, others[k]) == 0) {
            return false;
        }
    }
    return true;
}

static void check_rocks(check run)
{
    for (int k = 0; k < BODY_VARIANTS; ++k) {
        if (run == check_balance && !is_audited(body_variants[k].name)) {
            continue;
        }
        run(body_plane, &body_variants[k]);
        run(body_space, &body_variants[k]);
    }
}

static void audit_of_soil_changes_nothing_and_does_not_depend_on_threads(void **state)
{
    (void)state;
    check_soil(check_bits);
}

static void audit_of_soil_and_rocks_changes_nothing_and_does_not_depend_on_threads(void **state)
{
    (void)state;
    check_rocks(check_bits);
}

static void energy_of_soil_is_accounted_for(void **state)
{
    (void)state;
    check_soil(check_balance);
}

static void energy_of_soil_and_rocks_is_accounted_for(void **state)
{
    (void)state;
    check_rocks(check_balance);
}

int main(int argc, char **argv)
{
    (void)argc;
    /* Threads that wait by spinning crawl where others need the cores. OpenMP looks at this once, before main. */
    if (getenv("OMP_WAIT_POLICY") == NULL && setenv("OMP_WAIT_POLICY", "passive", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(audit_of_soil_changes_nothing_and_does_not_depend_on_threads),
        cmocka_unit_test(audit_of_soil_and_rocks_changes_nothing_and_does_not_depend_on_threads),
        cmocka_unit_test(energy_of_soil_is_accounted_for),
        cmocka_unit_test(energy_of_soil_and_rocks_is_accounted_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
