/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/field.h"
#include "core/sph/soil.h"
#include "core/time/stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define POSITION MOR_BIT(MOR_FIELD_POSITION)
#define VELOCITY MOR_BIT(MOR_FIELD_VELOCITY)
#define ACCELERATION MOR_BIT(MOR_FIELD_ACCELERATION)
#define RECORDS MOR_BIT(MOR_RESOURCE_RECORDS)

enum { STAGES_MAX = 32 };

static const uint64_t evolving = POSITION | VELOCITY;

static mor_status verify(mor_context *context, const mor_stage *stages, int n_stages)
{
    mor_context_init(context);
    return mor_stage_verify(context, stages, n_stages, evolving, NULL);
}

static void step_that_writes_before_it_reads_is_accepted(void **state)
{
    (void)state;
    mor_context context;
    const mor_stage stages[] = {
        {"drift", NULL, VELOCITY, 0, POSITION, "positions", NULL},
        {"pack", NULL, POSITION | VELOCITY, RECORDS, 0, "records", NULL},
        {"momentum", NULL, RECORDS, ACCELERATION, 0, "acceleration", NULL},
        {"walls", NULL, RECORDS, 0, ACCELERATION, "acceleration by walls", NULL},
        {"kick", NULL, ACCELERATION, 0, VELOCITY, "velocities", NULL},
    };
    assert_int_equal(verify(&context, stages, 5), MOR_OK);
    assert_int_equal(verify(&context, stages, 0), MOR_OK);
    assert_int_equal(context.status, MOR_OK);
}

static void reading_scratch_before_it_is_written_is_refused(void **state)
{
    (void)state;
    mor_context context;
    const mor_stage stages[] = {
        {"kick", NULL, ACCELERATION | VELOCITY, 0, VELOCITY, "velocities", NULL},
        {"momentum", NULL, POSITION, ACCELERATION, 0, "acceleration, too late", NULL},
    };
    assert_int_equal(verify(&context, stages, 2), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "stage 'kick' reads acceleration before"));
}

static void adding_to_scratch_before_it_is_written_is_refused(void **state)
{
    (void)state;
    mor_context context;
    const mor_stage stages[] = {
        {"walls", NULL, POSITION, 0, ACCELERATION, "adds to nothing", NULL},
        {"momentum", NULL, POSITION, ACCELERATION, 0, "acceleration, too late", NULL},
    };
    assert_int_equal(verify(&context, stages, 2), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "stage 'walls' adds to acceleration,"));
}

static void stage_may_not_read_what_only_it_writes(void **state)
{
    (void)state;
    mor_context context;
    const mor_stage stages[] = {{"momentum", NULL, ACCELERATION, ACCELERATION, 0, "reads its own output", NULL}};
    assert_int_equal(verify(&context, stages, 1), MOR_ERROR_INTERNAL);
}

static void shared_data_is_checked_like_fields(void **state)
{
    (void)state;
    mor_context context;
    for (int bit = MOR_RESOURCE_FIRST; bit < MOR_STAGE_BITS; ++bit) {
        const mor_stage stages[] = {{"make", NULL, 0, MOR_BIT(bit), 0, "makes it", NULL},
                                    {"use", NULL, MOR_BIT(bit), 0, 0, "uses it", NULL}};
        assert_int_equal(verify(&context, stages, 2), MOR_OK);
        assert_int_equal(verify(&context, stages + 1, 1), MOR_ERROR_INTERNAL);
        char expected[64];
        snprintf(expected, sizeof expected, "stage 'use' reads %s before", mor_stage_bit_name(NULL, bit));
        assert_non_null(strstr(context.message, expected));
    }
    assert_in_range(MOR_RESOURCE_RECORDS, MOR_FIELDS_MAX, 63); /* no field of a material shares a bit with them */
}

static void data_in_one_memory_may_not_be_needed_at_once(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const mor_stage stages[] = {
        {"pack", NULL, POSITION | VELOCITY, RECORDS, 0, "records", NULL},
        {"momentum", NULL, RECORDS, VELOCITY, 0, "velocities", NULL},
        {"drift", NULL, VELOCITY, ACCELERATION, 0, "what is found late", NULL},
        {"use", NULL, ACCELERATION, 0, POSITION, "and is needed to the end", NULL},
        {"audit", NULL, RECORDS, 0, 0, "records that are not there any more", NULL},
    };
    assert_int_equal(mor_stage_verify_shared(&context, stages, 4, RECORDS, ACCELERATION, NULL), MOR_OK);
    assert_int_equal(mor_stage_verify_shared(&context, stages, 5, RECORDS, POSITION, NULL), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "stage 'pack' needs (records)"));
    mor_context_init(&context);
    assert_int_equal(mor_stage_verify_shared(&context, stages, 5, RECORDS, ACCELERATION, NULL), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "stage 'audit' needs (records), whose memory holds"));
}

static void soil_can_do_without_no_stage_that_writes(void **state)
{
    (void)state;
    /* Only what mor_soil_stepper reads of a soil is needed. */
    mor_soil soil;
    memset(&soil, 0, sizeof soil);
    mor_stepper stepper;
    uint64_t carried = 0;
    mor_soil_stepper(&soil, &stepper, &carried);
    assert_true(stepper.n_stages > 5 && stepper.n_stages <= STAGES_MAX);
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_stage_verify(&context, stepper.stages, stepper.n_stages, carried, NULL), MOR_OK);
    int n_writers = 0;
    for (int left_out = 0; left_out < stepper.n_stages; ++left_out) {
        mor_stage stages[STAGES_MAX];
        int n = 0;
        uint64_t needed = 0; /* by later stages; what a stage writes for itself is not */
        for (int k = 0; k < stepper.n_stages; ++k) {
            if (k != left_out) {
                stages[n++] = stepper.stages[k];
            }
            needed |= k > left_out ? stepper.stages[k].reads | stepper.stages[k].accumulates : 0;
        }
        const bool writes = (stepper.stages[left_out].writes & needed & ~carried) != 0;
        n_writers += writes;
        const mor_status status = mor_stage_verify(&context, stages, n, carried, NULL);
        assert_int_equal(status, writes ? MOR_ERROR_INTERNAL : MOR_OK);
    }
    assert_true(n_writers > 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(step_that_writes_before_it_reads_is_accepted),
        cmocka_unit_test(reading_scratch_before_it_is_written_is_refused),
        cmocka_unit_test(adding_to_scratch_before_it_is_written_is_refused),
        cmocka_unit_test(stage_may_not_read_what_only_it_writes),
        cmocka_unit_test(shared_data_is_checked_like_fields),
        cmocka_unit_test(data_in_one_memory_may_not_be_needed_at_once),
        cmocka_unit_test(soil_can_do_without_no_stage_that_writes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
