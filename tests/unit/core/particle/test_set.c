/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/set.h"
#include "tests/common/cloud.h"

#include <math.h>

enum { N = 37, STATE_COMPONENTS = 4 };

static const uint64_t all_fields = ((uint64_t)1 << MOR_FIELD_CORE_COUNT) - 1;

static mor_field_info state_field(const char *name, int n_components)
{
    mor_field_info info = {.n_components = n_components,
                           .unit = "1",
                           .flags = MOR_FIELD_EVOLVES | MOR_FIELD_OUTPUT,
                           .text = "a material's state"};
    snprintf(info.name, sizeof info.name, "%s", name);
    return info;
}

/* What component a of a field holds for the particle with an id. */
static double value_of(int field, int64_t id, int a)
{
    return cloud_number((uint64_t)id, (uint64_t)(100 * field + a), -1.0, 1.0);
}

/* A set with all built-in fields and one of a material, each number telling particle, field and component. */
static void open_set(mor_context *context, mor_set *set)
{
    mor_context_init(context);
    assert_int_equal(mor_set_init(context, set, "soil", N, all_fields), MOR_OK);
    const mor_field_info info = state_field("void_ratio", STATE_COMPONENTS);
    int index = -1;
    assert_int_equal(mor_set_add_field(context, set, &info, &index), MOR_OK);
    assert_int_equal(index, MOR_FIELD_CORE_COUNT);
    for (int field = 0; field < set->n_fields; ++field) {
        for (int i = 0; i < N; ++i) {
            for (int a = 0; a < set->fields[field].n_components; ++a) {
                set->data[field][i * set->fields[field].n_components + a] = value_of(field, i, a);
            }
        }
    }
}

static void close_set(mor_context *context, mor_set *set)
{
    mor_set_clear(context, set);
    assert_int_equal(context->memory_bytes, 0);
}

/* A permutation that depends on the round. */
static void fill_order(int round, int32_t *order)
{
    for (int i = 0; i < N; ++i) {
        order[i] = i;
    }
    for (int i = N - 1; i > 0; --i) {
        const int other = (int)cloud_number((uint64_t)i, 9000 + (uint64_t)round, 0.0, i + 1.0);
        const int32_t kept = order[i];
        order[i] = order[other];
        order[other] = kept;
    }
}

static void new_set_is_zero_and_numbered(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    mor_context_init(&context);
    const uint64_t mask = (uint64_t)1 << MOR_FIELD_POSITION | (uint64_t)1 << MOR_FIELD_STRESS;
    assert_int_equal(mor_set_init(&context, &set, "soil", N, mask), MOR_OK);
    assert_string_equal(set.name, "soil");
    assert_int_equal(set.n_fields, MOR_FIELD_CORE_COUNT);
    for (int field = 0; field < set.n_fields; ++field) {
        assert_int_equal(set.data[field] != NULL, mask >> field & 1);
        assert_string_equal(set.fields[field].name, mor_field_core_info((mor_field_id)field)->name);
    }
    for (int i = 0; i < N; ++i) {
        assert_int_equal(set.id[i], i);
        for (int a = 0; a < 6; ++a) {
            assert_true(set.data[MOR_FIELD_STRESS][6 * i + a] == 0.0); /* exact: as promised */
        }
    }
    close_set(&context, &set);
    mor_set_clear(&context, &set);
}

static void core_fields_are_described_without_gaps(void **state)
{
    (void)state;
    for (int field = 0; field < MOR_FIELD_CORE_COUNT; ++field) {
        const mor_field_info *info = mor_field_core_info((mor_field_id)field);
        assert_in_range(info->n_components, 1, 9);
        assert_true(strlen(info->unit) > 0 && strlen(info->text) > 0);
        const bool evolves = (info->flags & MOR_FIELD_EVOLVES) != 0;
        const bool is_scratch = (info->flags & MOR_FIELD_SCRATCH) != 0;
        assert_true(evolves != is_scratch); /* a field is carried over or made anew, never both */
        for (int other = 0; other < field; ++other) {
            assert_string_not_equal(info->name, mor_field_core_info((mor_field_id)other)->name);
        }
    }
}

static void particles_that_are_stopped_keep_all_but_their_motion(void **state)
{
    static const int motion[] = {MOR_FIELD_VELOCITY, MOR_FIELD_DENSITY_RATE, MOR_FIELD_STRAIN_RATE,
                                 MOR_FIELD_FACE_GROWTH};
    const int64_t first = 2;
    const int64_t last = N - 1;
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    mor_set_stop(&set, first, last - first);
    for (int field = 0; field < set.n_fields; ++field) {
        bool is_motion = false;
        for (size_t k = 0; k < sizeof motion / sizeof *motion; ++k) {
            is_motion = is_motion || motion[k] == field;
        }
        const int n_components = set.fields[field].n_components;
        for (int k = 0; k < N * n_components; ++k) {
            const int64_t i = k / n_components;
            const bool stands = is_motion && i >= first && i < last;
            assert_true(set.data[field][k] == (stands ? 0.0 : value_of(field, i, k % n_components))); /* exact */
        }
    }
    close_set(&context, &set);
}

static void permute_moves_every_evolving_field_with_its_particle(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    int32_t order[N];
    for (int round = 0; round < 4; ++round) {
        int64_t ids[N];
        memcpy(ids, set.id, sizeof ids);
        fill_order(round, order);
        const uint64_t generation = set.generation;
        const uint64_t n_allocations = context.n_allocations;
        mor_set_permute(&set, order);
        assert_int_equal(set.generation, generation + 1);
        assert_int_equal(context.n_allocations, n_allocations);
        for (int i = 0; i < N; ++i) {
            assert_int_equal(set.id[i], ids[order[i]]);
        }
        for (int field = 0; field < set.n_fields; ++field) {
            const int n_components = set.fields[field].n_components;
            const bool evolves = (set.fields[field].flags & MOR_FIELD_EVOLVES) != 0;
            for (int k = 0; k < N * n_components; ++k) {
                const int64_t owner = evolves ? set.id[k / n_components] : k / n_components;
                assert_true(set.data[field][k] == value_of(field, owner, k % n_components)); /* exact: a copy */
            }
        }
    }
    close_set(&context, &set);
}

static void permute_goes_from_the_old_place_to_the_new(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    mor_context_init(&context);
    assert_int_equal(mor_set_init(&context, &set, "soil", 3, (uint64_t)1 << MOR_FIELD_MASS), MOR_OK);
    int32_t order[3] = {2, 0, 1};
    memcpy(set.data[MOR_FIELD_MASS], ((const double[3]){10.0, 11.0, 12.0}), 3 * sizeof(double));
    mor_set_permute(&set, order);
    assert_memory_equal(set.data[MOR_FIELD_MASS], ((const double[3]){12.0, 10.0, 11.0}), 3 * sizeof(double));
    assert_memory_equal(set.id, ((const int64_t[3]){2, 0, 1}), 3 * sizeof(int64_t));
    close_set(&context, &set);
}

/* Velocity gradients lie over records that are not needed any more, and nothing of the rest moves. */
static void scratch_that_is_placed_lies_in_the_memory_given(void **state)
{
    (void)state;
    enum { ROWS = 40, WIDTH = 9 + 6 };
    mor_context context;
    mor_set set;
    static double memory[ROWS * WIDTH];
    static double other[ROWS * WIDTH];
    open_set(&context, &set);
    const uint64_t late = (uint64_t)1 << MOR_FIELD_VELOCITY_GRADIENT | (uint64_t)1 << MOR_FIELD_MOMENTS;
    const uint64_t checksum = mor_set_checksum(&set);
    assert_int_equal(mor_set_width(&set, late), WIDTH);
    const size_t n_bytes = context.memory_bytes;
    mor_set_place(&context, &set, late, memory);
    assert_true(n_bytes - context.memory_bytes >= N * WIDTH * sizeof(double)); /* they had room of their own */
    assert_ptr_equal(set.data[MOR_FIELD_VELOCITY_GRADIENT], memory);
    assert_ptr_equal(set.data[MOR_FIELD_MOMENTS], memory + ROWS * 9);
    mor_set_place(&context, &set, late, other); /* it has moved */
    assert_ptr_equal(set.data[MOR_FIELD_MOMENTS], other + ROWS * 9);
    assert_true(mor_set_checksum(&set) == checksum); /* scratch is no part of it */
    mor_set_remove(&set, (const int32_t[]){3, N - 1}, 2);
    mor_set_place(&context, &set, late, memory);
    assert_ptr_equal(set.data[MOR_FIELD_MOMENTS], memory + ROWS * 9); /* for as many as there were */
    close_set(&context, &set);
    assert_int_equal(mor_set_width(&set, late), 0);
}

static void removed_particles_leave_the_others_in_order(void **state)
{
    static const int32_t removed[] = {0, 1, 5, 17, N - 1};
    enum { N_REMOVED = sizeof removed / sizeof *removed };
    mor_context context;
    mor_set set;
    (void)state;
    open_set(&context, &set);
    const uint64_t generation = set.generation;
    mor_set_remove(&set, removed, N_REMOVED);
    assert_int_equal(set.n_particles, N - N_REMOVED);
    assert_int_equal(set.n_created, N);
    assert_int_equal(set.generation, generation + 1);
    int at = 0;
    for (int i = 0, k = 0; i < N; ++i) {
        if (k < N_REMOVED && removed[k] == i) {
            ++k;
            continue;
        }
        assert_int_equal(set.id[at], i);
        for (int field = 0; field < set.n_fields; ++field) {
            for (int a = 0; a < set.fields[field].n_components; ++a) {
                assert_true(set.data[field][at * set.fields[field].n_components + a] ==
                            value_of(field, i, a)); /* exact */
            }
        }
        ++at;
    }
    close_set(&context, &set);
}

static void checksum_does_not_depend_on_the_order_of_particles(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    int32_t order[N];
    const uint64_t checksum = mor_set_checksum(&set);
    for (int round = 0; round < 5; ++round) {
        fill_order(round, order);
        mor_set_permute(&set, order);
        assert_true(mor_set_checksum(&set) == checksum); /* exact: wrapping sums commute */
    }
    close_set(&context, &set);
}

static void flip_bit(double *value, int bit)
{
    uint64_t bits = 0;
    memcpy(&bits, value, sizeof bits);
    bits ^= (uint64_t)1 << bit;
    memcpy(value, &bits, sizeof bits);
}

static void checksum_sees_each_bit_of_evolving_fields_and_no_other(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    const uint64_t checksum = mor_set_checksum(&set);
    for (int field = 0; field < set.n_fields; ++field) {
        const bool evolves = (set.fields[field].flags & MOR_FIELD_EVOLVES) != 0;
        const int n_values = N * set.fields[field].n_components;
        for (int k = 0; k < n_values; k += 1 + n_values / 50) {
            for (int bit = 0; bit < 64; bit += 9) {
                flip_bit(set.data[field] + k, bit);
                assert_int_equal(mor_set_checksum(&set) != checksum, evolves);
                flip_bit(set.data[field] + k, bit);
            }
        }
    }
    assert_true(mor_set_checksum(&set) == checksum); /* exact: every bit is back */
    close_set(&context, &set);
}

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

static void checksum_tells_particles_components_and_fields_apart(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    const uint64_t checksum = mor_set_checksum(&set);
    double *position = set.data[MOR_FIELD_POSITION];
    double *others[] = {position + 1, position + 3, set.data[MOR_FIELD_VELOCITY], set.data[MOR_FIELD_CORE_COUNT]};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
        swap(position, others[k]);
        assert_true(mor_set_checksum(&set) != checksum); /* one in 2^64 by chance, and none here */
        swap(position, others[k]);
    }
    const int64_t id = set.id[0];
    set.id[0] = N;
    assert_true(mor_set_checksum(&set) != checksum); /* likewise: the same numbers of another particle */
    set.id[0] = id;
    set.n_particles -= 1;
    assert_true(mor_set_checksum(&set) != checksum); /* likewise: a particle less */
    close_set(&context, &set);
}

static void field_is_found_by_name(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    assert_int_equal(mor_set_find_field(&set, "stress"), MOR_FIELD_STRESS);
    assert_int_equal(mor_set_find_field(&set, "void_ratio"), MOR_FIELD_CORE_COUNT);
    assert_int_equal(mor_set_find_field(&set, "Stress"), -1);
    assert_int_equal(mor_set_find_field(&set, ""), -1);
    close_set(&context, &set);
}

static void wrong_fields_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    const struct {
        const char *name;
        int n_components;
    } wrong[] = {{"void_ratio", 1}, {"stress", 6}, {"new", 0}, {"new", -1}, {"new", 10}};
    const int n_fields = set.n_fields;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        const mor_field_info info = state_field(wrong[k].name, wrong[k].n_components);
        int index = 5;
        assert_int_equal(mor_set_add_field(&context, &set, &info, &index), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, wrong[k].name));
        assert_int_equal(index, -1);
        assert_int_equal(set.n_fields, n_fields);
    }
    close_set(&context, &set);
    /* A built-in field that this set leaves out keeps its name, too. */
    assert_int_equal(mor_set_init(&context, &set, "soil", N, 0), MOR_OK);
    const mor_field_info info = state_field("stress", 6);
    int index = 5;
    assert_int_equal(mor_set_add_field(&context, &set, &info, &index), MOR_ERROR_ARGUMENT);
    close_set(&context, &set);
}

static void table_of_fields_is_never_overrun(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    open_set(&context, &set);
    mor_status status = MOR_OK;
    int n_added = 0;
    for (int k = 0; k < MOR_FIELDS_MAX && status == MOR_OK; ++k) {
        char name[16];
        snprintf(name, sizeof name, "state_%d", k);
        const mor_field_info info = state_field(name, 1);
        int index = -1;
        status = mor_set_add_field(&context, &set, &info, &index);
        n_added += status == MOR_OK;
    }
    assert_int_equal(status, MOR_ERROR_ARGUMENT);
    assert_int_equal(n_added, MOR_FIELDS_MAX - MOR_FIELD_CORE_COUNT - 1);
    assert_int_equal(set.n_fields, MOR_FIELDS_MAX);
    close_set(&context, &set);
}

static void impossible_sizes_are_refused_and_long_names_cut(void **state)
{
    (void)state;
    mor_context context;
    mor_set set;
    mor_context_init(&context);
    assert_int_equal(mor_set_init(&context, &set, "soil", -1, 0), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_set_init(&context, &set, "soil", INT32_MAX, 0), MOR_ERROR_ARGUMENT);
    assert_int_equal(context.memory_bytes, 0);
    char name[2 * MOR_FIELD_NAME_BYTES];
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_int_equal(mor_set_init(&context, &set, name, 0, all_fields), MOR_OK);
    assert_int_equal(strlen(set.name), MOR_FIELD_NAME_BYTES - 1);
    close_set(&context, &set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(new_set_is_zero_and_numbered),
        cmocka_unit_test(core_fields_are_described_without_gaps),
        cmocka_unit_test(particles_that_are_stopped_keep_all_but_their_motion),
        cmocka_unit_test(permute_moves_every_evolving_field_with_its_particle),
        cmocka_unit_test(permute_goes_from_the_old_place_to_the_new),
        cmocka_unit_test(scratch_that_is_placed_lies_in_the_memory_given),
        cmocka_unit_test(removed_particles_leave_the_others_in_order),
        cmocka_unit_test(checksum_does_not_depend_on_the_order_of_particles),
        cmocka_unit_test(checksum_sees_each_bit_of_evolving_fields_and_no_other),
        cmocka_unit_test(checksum_tells_particles_components_and_fields_apart),
        cmocka_unit_test(field_is_found_by_name),
        cmocka_unit_test(wrong_fields_are_refused),
        cmocka_unit_test(table_of_fields_is_never_overrun),
        cmocka_unit_test(impossible_sizes_are_refused_and_long_names_cut),
    };
    return CLOUD_RUN(tests);
}
