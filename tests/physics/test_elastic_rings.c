/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/elastic/elastic.h"
#include "core/base/math.h"
#include "tests/common/scene.h"

/* The rings of cases/rings-2d, with and without the Kelvin-Voigt damping of the source: they flatten, bulge inward,
 * and part again, with strains of 40 %. */

typedef struct impact {
    double energy;     /* largest change of the energy that is not in the ledger, over the energy at the start, 1 */
    double left;       /* energy left at the end, 1 */
    double asymmetry;  /* largest distance of a particle from the mirror image of its partner, m */
    double stretch;    /* largest of a distance of neighbors over that at the start, 1 */
    double rebound[2]; /* speeds away from the contact, m/s */
    double momentum;   /* of both, kg/s */
} impact;

/* The particle of the other ring that starts at the mirror image of each particle of the first. */
static void find_partners(const mor_body_group *group, double spacing, int64_t *partners)
{
    const mor_body *left = &group->bodies[0];
    for (int64_t i = 0; i < left->n_particles; ++i) {
        const double *x = group->reference + 3 * i;
        partners[i] = -1;
        for (int64_t j = left->n_particles; j < group->set.n_particles; ++j) {
            const double *y = group->reference + 3 * j;
            partners[i] = fabs(x[0] + y[0]) + fabs(x[1] - y[1]) < 1e-6 * spacing ? j : partners[i];
        }
        assert_true(partners[i] >= 0);
    }
}

static double find_energy(const scene *it)
{
    double energies[3];
    mor_simulation_energies(&it->simulation, 1, energies);
    return energies[0] + energies[1] + energies[2];
}

static void observe(const scene *it, const int64_t *partners, double first, impact *found)
{
    const mor_elastic *elastic = it->simulation.bodies.groups[0]->owner;
    const mor_body_group *group = &elastic->group;
    const double *x = group->set.data[MOR_FIELD_POSITION];
    const double spacing = it->the_case.spacing;
    const int64_t n = group->bodies[0].n_particles;
    const double energy = find_energy(it);
    found->left = energy / first;
    found->energy = fmax(found->energy, fabs((energy + elastic->damped_energy) / first - 1.0));
    for (int64_t i = 0; i < n; ++i) {
        const double *y = x + 3 * partners[i];
        found->asymmetry = fmax(found->asymmetry, fabs(x[3 * i] + y[0]) + fabs(x[3 * i + 1] - y[1]));
        for (int64_t j = 0; j < i; ++j) {
            const double before = hypot(group->reference[3 * i] - group->reference[3 * j],
                                        group->reference[3 * i + 1] - group->reference[3 * j + 1]);
            if (before < 2.3 * spacing) {
                const double now = hypot(x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1]);
                found->stretch = fmax(found->stretch, now / before);
            }
        }
    }
}

static impact collide(const char *damping)
{
    enum { LOOKS = 10 };
    const char *const settings[] = {damping, NULL};
    const char *const *const lists[] = {settings};
    const scene_request request = {.text = "cases/rings-2d/case.cfg", .settings = lists, .n_lists = 1};
    impact found = {0};
    scene *it = scene_new(&request);
    const mor_body_group *group = it->simulation.bodies.groups[0];
    int64_t *partners = malloc((size_t)group->bodies[0].n_particles * sizeof *partners);
    double momenta[2][3];
    double angular[3];
    assert_non_null(partners);
    find_partners(group, it->the_case.spacing, partners);
    const double first = find_energy(it);
    for (int k = 1; k <= LOOKS; ++k) {
        scene_advance(it, 1e-2 * k / LOOKS);
        observe(it, partners, first, &found);
    }
    for (int b = 0; b < 2; ++b) {
        mor_body_group_momentum(group, b, momenta[b], angular);
        found.rebound[b] = (b == 0 ? -1.0 : 1.0) * momenta[b][0] / group->bodies[b].mass;
    }
    found.momentum = hypot(momenta[0][0] + momenta[1][0], momenta[0][1] + momenta[1][1]);
    free(partners);
    scene_free(it);
    print_message(
        "%s: energy %.4f, missing %.1e; rebound %.4f m/s; asymmetry %.1e m; stretch %.3f; momentum %.1e kg/s\n",
        damping, found.left, found.energy, found.rebound[0], found.asymmetry, found.stretch, found.momentum);
    return found;
}

static void check_impact(const impact *found)
{
    const double one = 24.88;                   /* momentum of a ring at the start, kg/s */
    assert_true(found->energy < 2e-3);          /* contact by nodes: the springs are not quite a potential */
    assert_true(found->momentum < 1e-10 * one); /* rounding of 3000 steps */
    assert_true(found->asymmetry < 1e-12);      /* 1e-9 of a spacing: rounding, which large strains amplify */
    assert_true(found->stretch < 1.5);          /* nothing tears */
    assert_true(found->rebound[0] > 7.0);       /* m/s, they part */
    scene_expect_near("rebound", found->rebound[0], found->rebound[1], 1e-9); /* mirror images */
}

static void rings_without_damping_keep_their_energy(void **state)
{
    (void)state;
    const impact found = collide("numerics.body_damping=0");
    check_impact(&found);
    assert_true(fabs(found.left - 1.0) < 2e-3); /* as above */
}

static void damping_accounts_for_all_that_rings_lose(void **state)
{
    (void)state;
    const impact found = collide("numerics.body_damping=1");
    check_impact(&found);
    assert_true(found.left < 0.9); /* the damper works */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_without_damping_keep_their_energy),
        cmocka_unit_test(damping_accounts_for_all_that_rings_lose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
