/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/io/checkpoint.h"
#include "tests/common/full_disk.h"
#include "tests/common/run_folder.h"

enum { N_SOIL = 37, N_ROCK = 5, N_CLOCK = 4 };

/* One of several equal structs of which a member is state. */
typedef struct part {
    double scratch;
    double place[2];
} part;

/* A small state: two sets, arrays of each kind, a member of structs, and nothing. */
typedef struct sample {
    mor_set soil;
    mor_set rock;
    int64_t step;
    uint64_t ticks[2];
    double clock[N_CLOCK];
    part parts[3];
    mor_state_list list;
    mor_checkpoint view;
} sample;

static void set_bits(double *target, uint64_t bits)
{
    memcpy(target, &bits, sizeof bits);
}

/* Fills every array with bit patterns that depend on the salt: all kinds of numbers, NaN payloads included. */
static void fill_set(mor_set *set, uint64_t salt)
{
    for (int field = 0; field < set->n_fields; ++field) {
        for (int64_t k = 0; set->data[field] != NULL && k < set->n_particles * set->fields[field].n_components; ++k) {
            set_bits(&set->data[field][k], mor_random_mix(salt ^ (uint64_t)(k + 1000 * field)));
        }
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->id[i] = (i * 5 + (int64_t)salt) % set->n_particles;
    }
}

static void fill_sample(sample *state, uint64_t salt)
{
    fill_set(&state->soil, salt);
    fill_set(&state->rock, salt + 7);
    state->step = (int64_t)salt;
    state->ticks[0] = UINT64_MAX - salt;
    state->ticks[1] = salt;
    for (int k = 0; k < N_CLOCK; ++k) {
        state->clock[k] = 0.1 * (double)k + (double)salt;
    }
    for (int k = 0; k < 3; ++k) {
        state->parts[k] = (part){(double)salt, {0.3 * k + (double)salt, 0.7 * k - (double)salt}};
    }
}

static void make_sample(mor_context *context, sample *state, int64_t n_soil, uint64_t salt)
{
    memset(state, 0, sizeof *state);
    const uint64_t mask =
        1u << MOR_FIELD_POSITION | 1u << MOR_FIELD_STRESS | 1u << MOR_FIELD_MASS | 1u << MOR_FIELD_ACCELERATION;
    assert_int_equal(mor_set_init(context, &state->soil, "soil", n_soil, mask), MOR_OK);
    assert_int_equal(mor_set_init(context, &state->rock, "rock two", N_ROCK, 1u << MOR_FIELD_VELOCITY), MOR_OK);
    const mor_field_info strain = {"plastic_strain", 1, "1", MOR_FIELD_EVOLVES, "plastic strain"};
    int index = 0;
    assert_int_equal(mor_set_add_field(context, &state->soil, &strain, &index), MOR_OK);
    assert_int_equal(mor_state_add_set(context, &state->list, &state->soil), MOR_OK);
    assert_int_equal(mor_state_add_set(context, &state->list, &state->rock), MOR_OK);
    assert_int_equal(mor_state_add(context, &state->list, "clock", "step", MOR_STATE_INT64, 1, &state->step), MOR_OK);
    assert_int_equal(mor_state_add(context, &state->list, "clock", "ticks", MOR_STATE_UINT64, 2, state->ticks), MOR_OK);
    assert_int_equal(mor_state_add(context, &state->list, "clock", "times", MOR_STATE_DOUBLE, N_CLOCK, state->clock),
                     MOR_OK);
    assert_int_equal(mor_state_add(context, &state->list, "clock", "nothing", MOR_STATE_DOUBLE, 0, NULL), MOR_OK);
    assert_int_equal(mor_state_add_member(context, &state->list, "parts", "place", 3, 2, sizeof *state->parts,
                                          state->parts[0].place),
                     MOR_OK);
    state->view = (mor_checkpoint){&state->list, "case of a sample"};
    fill_sample(state, salt);
}

static void clear_sample(mor_context *context, sample *state)
{
    mor_set_clear(context, &state->soil);
    mor_set_clear(context, &state->rock);
    mor_state_clear(context, &state->list);
}

static bool same_set(const mor_set *a, const mor_set *b)
{
    bool same = memcmp(a->id, b->id, (size_t)a->n_particles * sizeof *a->id) == 0;
    for (int field = 0; field < a->n_fields; ++field) {
        if (a->data[field] != NULL && (a->fields[field].flags & MOR_FIELD_EVOLVES) != 0) {
            const size_t n_values = (size_t)a->n_particles * (size_t)a->fields[field].n_components;
            same = same && memcmp(a->data[field], b->data[field], n_values * sizeof(double)) == 0;
        }
    }
    return same;
}

static bool same_places(const sample *a, const sample *b)
{
    bool same = true;
    for (int k = 0; k < 3; ++k) {
        same = same && memcmp(a->parts[k].place, b->parts[k].place, sizeof a->parts[k].place) == 0;
    }
    return same;
}

static bool same_sample(const sample *a, const sample *b)
{
    return same_set(&a->soil, &b->soil) && same_set(&a->rock, &b->rock) && a->step == b->step &&
           memcmp(a->ticks, b->ticks, sizeof a->ticks) == 0 && memcmp(a->clock, b->clock, sizeof a->clock) == 0 &&
           same_places(a, b);
}

static void round_trip_keeps_every_bit(void **state)
{
    run_folder *folder = *state;
    sample saved;
    sample loaded;
    make_sample(&folder->context, &saved, N_SOIL, 3);
    make_sample(&folder->context, &loaded, N_SOIL, 4);
    set_bits(&saved.soil.data[MOR_FIELD_POSITION][0], 0x7FF0000000000001u); /* signaling NaN */
    set_bits(&saved.soil.data[MOR_FIELD_POSITION][1], 0xFFF8DEADBEEF1234u); /* NaN with payload and sign */
    set_bits(&saved.soil.data[MOR_FIELD_POSITION][2], 0x8000000000000000u); /* -0.0 */
    set_bits(&saved.soil.data[MOR_FIELD_POSITION][3], 0x0000000000000001u); /* smallest subnormal */
    set_bits(&saved.clock[0], 0x7FF8000000000123u);
    const uint64_t generation = loaded.soil.generation;
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view), MOR_OK);
    assert_true(same_sample(&saved, &loaded)); /* exact: bit patterns */
    char *identity = NULL;
    assert_int_equal(mor_checkpoint_read_identity(&folder->context, folder->path, &identity), MOR_OK);
    assert_string_equal(identity, saved.view.identity);
    MOR_FREE(&folder->context, &identity);
    assert_int_equal(loaded.soil.generation, generation + 1);
    assert_int_equal(folder->n_logged, 0);
    clear_sample(&folder->context, &saved);
    clear_sample(&folder->context, &loaded);
}

static void equal_states_make_equal_files(void **state)
{
    run_folder *folder = *state;
    sample saved;
    char path[MOR_PATH_BYTES];
    size_t n_bytes[2];
    unsigned char *bytes[2];
    make_sample(&folder->context, &saved, N_SOIL, 3);
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
        bytes[k] = run_folder_load(run_folder_file(folder, path, MOR_CHECKPOINT_FILE), &n_bytes[k]);
    }
    assert_int_equal(n_bytes[0], n_bytes[1]);
    assert_memory_equal(bytes[0], bytes[1], n_bytes[0]);
    free(bytes[0]);
    free(bytes[1]);
    clear_sample(&folder->context, &saved);
}

static void second_write_keeps_the_first_as_previous(void **state)
{
    run_folder *folder = *state;
    sample first;
    sample second;
    sample loaded;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &first, N_SOIL, 1);
    make_sample(&folder->context, &second, N_SOIL, 2);
    make_sample(&folder->context, &loaded, N_SOIL, 3);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &first.view), MOR_OK);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &second.view), MOR_OK);
    assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view), MOR_OK);
    assert_true(same_sample(&second, &loaded));
    run_folder_file(folder, path, MOR_CHECKPOINT_PREVIOUS_FILE);
    assert_int_equal(mor_checkpoint_read(&folder->context, path, &loaded.view), MOR_OK);
    assert_true(same_sample(&first, &loaded));
    run_folder_file(folder, path, MOR_CHECKPOINT_FILE ".tmp");
    assert_int_not_equal(access(path, F_OK), 0); /* nothing is left over */
    clear_sample(&folder->context, &first);
    clear_sample(&folder->context, &second);
    clear_sample(&folder->context, &loaded);
}

/* Reading altered bytes must be refused as damage, without changing the state. */
static void expect_refusal(run_folder *folder, const char *path, const sample *untouched, sample *loaded,
                           const void *bytes, size_t n_bytes)
{
    run_folder_store(path, bytes, n_bytes);
    assert_int_equal(mor_checkpoint_read(&folder->context, path, &loaded->view), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, path));
    assert_true(same_sample(untouched, loaded));
}

static void every_truncation_and_flipped_bit_is_refused(void **state)
{
    enum { N_TRUNCATIONS = 200, N_FLIPS = 500 };
    run_folder *folder = *state;
    sample saved;
    sample loaded;
    sample untouched;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    make_sample(&folder->context, &saved, N_SOIL, 1);
    make_sample(&folder->context, &loaded, N_SOIL, 2);
    make_sample(&folder->context, &untouched, N_SOIL, 2);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    unsigned char *bytes = run_folder_load(run_folder_file(folder, path, MOR_CHECKPOINT_FILE), &n_bytes);
    run_folder_file(folder, path, "damaged.h5");
    for (size_t k = 0; k < N_TRUNCATIONS; ++k) {
        expect_refusal(folder, path, &untouched, &loaded, bytes, n_bytes * k / N_TRUNCATIONS);
    }
    for (uint64_t k = 0; k < N_FLIPS; ++k) {
        /* Every byte of the seal's text, then places anywhere. */
        const size_t place = k < 128 ? (size_t)k : (size_t)(mor_random_mix(k) % n_bytes);
        const unsigned char flip = (unsigned char)(1u << (mor_random_mix(k + 77) % 8));
        bytes[place] ^= flip;
        expect_refusal(folder, path, &untouched, &loaded, bytes, n_bytes);
        bytes[place] ^= flip;
    }
    run_folder_store(path, bytes, n_bytes);
    assert_int_equal(mor_checkpoint_read(&folder->context, path, &loaded.view), MOR_OK);
    assert_true(same_sample(&saved, &loaded)); /* the unaltered bytes are still good */
    free(bytes);
    clear_sample(&folder->context, &saved);
    clear_sample(&folder->context, &loaded);
    clear_sample(&folder->context, &untouched);
}

static void damaged_newest_falls_back_to_previous_with_a_warning(void **state)
{
    run_folder *folder = *state;
    sample saved;
    sample loaded;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &saved, N_SOIL, 1);
    make_sample(&folder->context, &loaded, N_SOIL, 3);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    run_folder_store(run_folder_file(folder, path, MOR_CHECKPOINT_FILE), "moraine", 7);
    assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view), MOR_OK);
    assert_true(same_sample(&saved, &loaded));
    assert_int_equal(folder->n_logged, 1);
    assert_non_null(strstr(folder->log, MOR_CHECKPOINT_FILE));
    assert_non_null(strstr(folder->log, "damaged"));
    assert_non_null(strstr(folder->log, MOR_CHECKPOINT_PREVIOUS_FILE));
    assert_int_equal(folder->context.status, MOR_OK);
    clear_sample(&folder->context, &saved);
    clear_sample(&folder->context, &loaded);
}

static void damaged_newest_never_replaces_a_good_previous(void **state)
{
    run_folder *folder = *state;
    sample saved;
    sample loaded;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &saved, N_SOIL, 1);
    make_sample(&folder->context, &loaded, N_SOIL, 3);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    run_folder_store(run_folder_file(folder, path, MOR_CHECKPOINT_FILE), "x", 1);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &loaded.view), MOR_OK);
    assert_int_equal(folder->n_logged, 1);
    run_folder_file(folder, path, MOR_CHECKPOINT_PREVIOUS_FILE);
    assert_int_equal(mor_checkpoint_read(&folder->context, path, &loaded.view), MOR_OK);
    assert_true(same_sample(&saved, &loaded));
    clear_sample(&folder->context, &saved);
    clear_sample(&folder->context, &loaded);
}

static void no_usable_checkpoint_names_both_files(void **state)
{
    run_folder *folder = *state;
    sample loaded;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &loaded, N_SOIL, 3);
    for (int round = 0; round < 2; ++round) {
        assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view), MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, "/" MOR_CHECKPOINT_FILE));
        assert_non_null(strstr(folder->context.message, "/" MOR_CHECKPOINT_PREVIOUS_FILE));
        run_folder_store(run_folder_file(folder, path, MOR_CHECKPOINT_FILE), "x", 1);
        run_folder_store(run_folder_file(folder, path, MOR_CHECKPOINT_PREVIOUS_FILE), "y", 1);
    }
    clear_sample(&folder->context, &loaded);
}

static void state_of_another_case_is_refused_without_falling_back(void **state)
{
    run_folder *folder = *state;
    sample saved;
    sample other;
    make_sample(&folder->context, &saved, N_SOIL, 1);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    for (int difference = 0; difference < 8; ++difference) {
        make_sample(&folder->context, &other, difference == 0 ? N_SOIL + 1 : N_SOIL, 9);
        mor_field_info *strain = &other.soil.fields[mor_set_find_field(&other.soil, "plastic_strain")];
        strcpy(other.rock.name, difference == 1 ? "rocks" : "rock two");
        strcpy(strain->name, difference == 2 ? "damage" : "plastic_strain");
        strain->unit = difference == 3 ? "Pa" : "1";
        strain->flags = difference == 4 ? MOR_FIELD_SCRATCH : MOR_FIELD_EVOLVES;
        strcpy(other.list.arrays[0].name, difference == 5 ? "clock.steps" : "clock.step");
        other.list.arrays[2].n_rows = difference == 6 ? N_CLOCK - 1 : N_CLOCK;
        other.list.n_arrays = difference == 7 ? 4 : 5;
        const uint64_t before = mor_set_checksum(&other.soil);
        assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &other.view), MOR_ERROR_CONFIG);
        assert_non_null(strstr(folder->context.message, "another case"));
        assert_true(before == mor_set_checksum(&other.soil)); /* nothing was changed */
        assert_int_equal(other.step, 9);
        clear_sample(&folder->context, &other);
    }
    assert_int_equal(folder->n_logged, 0);
    clear_sample(&folder->context, &saved);
}

static void other_version_and_other_kind_of_file_are_refused(void **state)
{
    run_folder *folder = *state;
    sample loaded;
    char path[MOR_PATH_BYTES];
    mor_hdf5_file *file = NULL;
    make_sample(&folder->context, &loaded, N_SOIL, 3);
    run_folder_file(folder, path, MOR_CHECKPOINT_FILE);
    for (int off = -1; off <= 1; off += 2) {
        assert_int_equal(mor_hdf5_file_create(&folder->context, &file, path), MOR_OK);
        assert_int_equal(mor_hdf5_file_seal(&folder->context, &file, "checkpoint", MOR_CHECKPOINT_VERSION + off),
                         MOR_OK);
        assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view),
                         MOR_ERROR_UNSUPPORTED);
        char found[32];
        snprintf(found, sizeof found, "version %d", MOR_CHECKPOINT_VERSION + off);
        assert_non_null(strstr(folder->context.message, found));
    }
    assert_int_equal(mor_hdf5_file_create(&folder->context, &file, path), MOR_OK);
    assert_int_equal(mor_hdf5_file_seal(&folder->context, &file, "snapshot", MOR_CHECKPOINT_VERSION), MOR_OK);
    assert_int_equal(mor_checkpoint_read(&folder->context, path, &loaded.view), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "holds a snapshot"));
    clear_sample(&folder->context, &loaded);
}

static void full_disk_leaves_the_last_checkpoint_alone(void **state)
{
    run_folder *folder = *state;
    sample saved;
    sample loaded;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &saved, N_SOIL, 1);
    make_sample(&folder->context, &loaded, N_SOIL, 2);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_OK);
    for (rlim_t limit = 0; limit < 8000; limit += 1000) {
        full_disk disk;
        full_disk_begin(&disk, limit);
        const mor_status status = mor_checkpoint_write(&folder->context, folder->path, &loaded.view);
        full_disk_end(&disk);
        assert_int_equal(status, MOR_ERROR_IO);
        run_folder_file(folder, path, MOR_CHECKPOINT_FILE ".tmp");
        assert_int_not_equal(access(path, F_OK), 0);
    }
    assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &loaded.view), MOR_OK);
    assert_true(same_sample(&saved, &loaded));
    assert_int_equal(folder->n_logged, 0);
    clear_sample(&folder->context, &saved);
    clear_sample(&folder->context, &loaded);
}

static void names_that_hdf5_would_misread_are_refused(void **state)
{
    run_folder *folder = *state;
    sample saved;
    make_sample(&folder->context, &saved, N_SOIL, 1);
    strcpy(saved.soil.name, "a/b");
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_ERROR_ARGUMENT);
    strcpy(saved.soil.name, "soil");
    strcpy(saved.list.arrays[0].name, "");
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_ERROR_ARGUMENT);
    strcpy(saved.list.arrays[0].name, saved.list.arrays[1].name);
    assert_int_equal(mor_checkpoint_write(&folder->context, folder->path, &saved.view), MOR_ERROR_IO);
    clear_sample(&folder->context, &saved);
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(round_trip_keeps_every_bit),
        FOLDER_TEST(equal_states_make_equal_files),
        FOLDER_TEST(second_write_keeps_the_first_as_previous),
        FOLDER_TEST(every_truncation_and_flipped_bit_is_refused),
        FOLDER_TEST(damaged_newest_falls_back_to_previous_with_a_warning),
        FOLDER_TEST(damaged_newest_never_replaces_a_good_previous),
        FOLDER_TEST(no_usable_checkpoint_names_both_files),
        FOLDER_TEST(state_of_another_case_is_refused_without_falling_back),
        FOLDER_TEST(other_version_and_other_kind_of_file_are_refused),
        FOLDER_TEST(full_disk_leaves_the_last_checkpoint_alone),
        FOLDER_TEST(names_that_hdf5_would_misread_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
