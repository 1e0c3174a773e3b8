/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws of the audit of pair forces: the power of each part is that of the accelerations which the momentum loop finds
 * of it. */
#include "core/sph/pair/pair_audit.h"
#include "tests/common/assembly.h"

#include <float.h>

enum { POWERS = MOR_PAIR_POWERS * ASSEMBLY_MAX };

/* Velocities at the end of the kick, shape [n, 3], m/s: others than those of the records. */
static void find_velocities(const assembly *a, double *velocity)
{
    for (int k = 0; k < 3 * a->n; ++k) {
        const bool is_in_space = k % 3 < a->constants.dimension;
        velocity[k] = is_in_space ? cloud_number((uint64_t)k, 300, -1.0, 1.0) : 0.0;
    }
}

/* What the audit of an instruction set finds over all clusters, shape [n, MOR_PAIR_POWERS]; a canary behind. */
static void run_audit(const assembly *a, const char *name, bool has_stress, double *powers)
{
    double velocity[3 * ASSEMBLY_MAX];
    double hourglass[3 * ASSEMBLY_MAX];
    const mor_images none = {0};
    const bool has_two_soils = a->constants.soils != NULL;
    find_velocities(a, velocity);
    for (int i = 0; i < ASSEMBLY_MAX; ++i) {
        memcpy(hourglass + 3 * i, a->extra + MOR_EXTRA_SIZE * i + MOR_EXTRA_HOURGLASS, 3 * sizeof *hourglass);
    }
    const mor_pair_arrays arrays = {.n_particles = a->n,
                                    .records = a->records,
                                    .inner = &a->relation,
                                    .artificial_stress = a->artificial,
                                    .of_soil = has_two_soils ? a->of_soil : NULL,
                                    .one_soil = has_two_soils ? a->one_soil : NULL,
                                    .strain_rate = a->has_reconstruction ? a->strain_rate : NULL};
    const mor_pair_audit_job job = {.constants = &a->constants,
                                    .arrays = &arrays,
                                    .images = &none,
                                    .velocity = velocity,
                                    .hourglass = hourglass,
                                    .spin = a->spin,
                                    .has_stress = has_stress,
                                    .powers = powers};
    for (int k = 0; k < POWERS; ++k) {
        powers[k] = ASSEMBLY_CANARY;
    }
    mor_pair_audit_select(name)(&job, 0, a->tree.n_clusters);
    for (int k = MOR_PAIR_POWERS * a->n; k < POWERS; ++k) {
        assert_true(powers[k] == ASSEMBLY_CANARY); /* exact: not written */
    }
}

/* What the accelerations of the momentum loop take from each particle with the velocity in the middle of the kick,
 * shape [n], W (W/m). Returns the largest size of the parts of one. */
static double find_loss(const assembly *a, const mor_pair_table *table, double *loss)
{
    double velocity[3 * ASSEMBLY_MAX];
    assembly_sums sums;
    double size = 0.0;
    find_velocities(a, velocity);
    assembly_run(a, table, 1000, &sums);
    for (int i = 0; i < a->n; ++i) {
        const double *record = a->records + i * MOR_RECORD_SIZE;
        const double mass = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME];
        loss[i] = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double middle = 0.5 * (record[MOR_RECORD_VELOCITY + k] + velocity[3 * i + k]);
            loss[i] -= mass * sums.acceleration[3 * i + k] * middle;
            size = fmax(size, fabs(mass * sums.acceleration[3 * i + k] * middle));
        }
    }
    return size;
}

/* Some ulp of each term; terms are about ten times as large as the sum, and differences are those of whole forces. */
#define ROUNDING (256 * DBL_EPSILON)

static void check_sum(assembly *a, const mor_pair_table *table)
{
    double powers[POWERS];
    double loss[ASSEMBLY_MAX];
    a->constants.diffusion_rate = 0.0;
    run_audit(a, table->instruction_set, true, powers);
    const double size = find_loss(a, table, loss);
    for (int i = 0; i < a->n; ++i) {
        double sum = 0.0;
        for (int k = 0; k < MOR_PAIR_POWERS; ++k) {
            sum += powers[MOR_PAIR_POWERS * i + k];
        }
        assert_true(fabs(sum - loss[i]) <= ROUNDING * size);
    }
}

static void parts_add_up_to_the_power_of_the_momentum_loop(void **state)
{
    (void)state;
    assembly_for_mixed(check_sum);
    assembly_for_parts(check_sum);
}

/* Switches a part of the forces on or off. */
static void switch_part(assembly *a, int part, bool is_on)
{
    bool *const switches[MOR_PAIR_POWERS] = {[MOR_PAIR_POWER_ARTIFICIAL] = &a->constants.has_artificial_stress,
                                             [MOR_PAIR_POWER_HOURGLASS] = &a->constants.has_hourglass,
                                             [MOR_PAIR_POWER_STRESS] = &a->constants.has_spin};
    *switches[part] = is_on;
}

static void check_parts(assembly *a, const mor_pair_table *table)
{
    double with[ASSEMBLY_MAX];
    double without[ASSEMBLY_MAX];
    double powers[POWERS];
    a->constants.diffusion_rate = 0.0;
    for (int part = MOR_PAIR_POWER_RIEMANN + 1; part < MOR_PAIR_POWERS; ++part) {
        double most = 0.0;
        run_audit(a, table->instruction_set, false, powers);
        const double size = find_loss(a, table, with);
        switch_part(a, part, false);
        find_loss(a, table, without);
        switch_part(a, part, true);
        for (int i = 0; i < a->n; ++i) {
            const double power = powers[MOR_PAIR_POWERS * i + part];
            assert_true(fabs(power - (with[i] - without[i])) <= ROUNDING * size);
            most = fmax(most, fabs(power));
        }
        assert_true(most > 1e6 * ROUNDING * size); /* the part is not hidden among the rounding */
    }
}

static void each_part_is_what_its_switch_adds(void **state)
{
    (void)state;
    assembly_for_parts(check_parts);
}

/* Riemann terms and sums do not depend on what else is asked for, nor on clusters at a time. */
static void check_independence(assembly *a, const mor_pair_table *table)
{
    double all[POWERS];
    double some[POWERS];
    run_audit(a, table->instruction_set, true, all);
    a->constants.has_artificial_stress = a->constants.has_hourglass = a->constants.has_spin = false;
    run_audit(a, table->instruction_set, false, some);
    for (int i = 0; i < a->n; ++i) {
        const double *power = some + (ptrdiff_t)MOR_PAIR_POWERS * i;
        assert_true(power[MOR_PAIR_POWER_RIEMANN] == all[MOR_PAIR_POWERS * i + MOR_PAIR_POWER_RIEMANN]); /* bits */
        assert_true(power[MOR_PAIR_POWER_ARTIFICIAL] == 0.0 && power[MOR_PAIR_POWER_HOURGLASS] == 0.0);  /* exact */
        assert_true(power[MOR_PAIR_POWER_STRESS] == 0.0);                                                /* likewise */
    }
}

static void parts_do_not_depend_on_each_other(void **state)
{
    (void)state;
    assembly_for_parts(check_independence);
}

static void check_wide_registers(assembly *a, const mor_pair_table *table)
{
    double narrow[POWERS];
    double wide[POWERS];
    (void)table;
    run_audit(a, "avx2", true, narrow);
    run_audit(a, "avx512", true, wide);
    assert_memory_equal(narrow, wide, sizeof wide);
}

static void wide_registers_give_the_same_bits_as_wider_ones(void **state)
{
    (void)state;
    assert_null(mor_pair_audit_select("unknown"));
    if (mor_pair_audit_select("avx2") == NULL || mor_pair_audit_select("avx512") == NULL) {
        skip();
    }
    assembly_for_mixed(check_wide_registers);
    assembly_for_parts(check_wide_registers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_add_up_to_the_power_of_the_momentum_loop),
        cmocka_unit_test(each_part_is_what_its_switch_adds),
        cmocka_unit_test(parts_do_not_depend_on_each_other),
        cmocka_unit_test(wide_registers_give_the_same_bits_as_wider_ones),
    };
    return CLOUD_RUN(tests);
}
