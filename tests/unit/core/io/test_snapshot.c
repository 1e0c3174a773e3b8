/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/snapshot.h"
#include "tests/common/run_folder.h"

#include <math.h>
#include <sys/stat.h>

enum { N_SOIL = 11, N_ROCK = 3 };

static const mor_snapshot_fact facts[] = {{"version", "0.1.0"}, {"commit", "abc"}, {"command", "moraine run <\"x\">"}};
static const mor_snapshot_options in_double = {false, facts, 3};
static const mor_snapshot_options in_single = {true, facts, 3};

/* Two sets and a set without particles. */
typedef struct sample {
    mor_set soil;
    mor_set rock;
    mor_set empty;
    mor_set *sets[3];
} sample;

static double sample_value(int64_t step, int field, int64_t k)
{
    return sin((double)(step * 1000 + field * 100 + k)) * 1e3; /* irrational: every bit of the fraction matters */
}

static void fill_set(mor_set *set, int64_t step)
{
    for (int field = 0; field < set->n_fields; ++field) {
        for (int64_t k = 0; set->data[field] != NULL && k < set->n_particles * set->fields[field].n_components; ++k) {
            set->data[field][k] = sample_value(step, field, k);
        }
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->id[i] = set->n_particles - 1 - i;
    }
}

static void make_sample(mor_context *context, sample *state)
{
    memset(state, 0, sizeof *state);
    const uint64_t mask = 1u << MOR_FIELD_POSITION | 1u << MOR_FIELD_VELOCITY | 1u << MOR_FIELD_STRESS |
                          1u << MOR_FIELD_MASS | 1u << MOR_FIELD_DENSITY | 1u << MOR_FIELD_DENSITY_RATE;
    assert_int_equal(mor_set_init(context, &state->soil, "clay & <sand>", N_SOIL, mask), MOR_OK);
    assert_int_equal(mor_set_init(context, &state->rock, "rock", N_ROCK, mask), MOR_OK);
    assert_int_equal(mor_set_init(context, &state->empty, "empty", 0, mask), MOR_OK);
    const mor_field_info matrix = {"deformation", 9, "1", MOR_FIELD_OUTPUT, "deformation gradient"};
    const mor_field_info odd = {"odd", 4, "K", MOR_FIELD_OUTPUT, "four numbers"};
    int index = 0;
    assert_int_equal(mor_set_add_field(context, &state->rock, &matrix, &index), MOR_OK);
    assert_int_equal(mor_set_add_field(context, &state->rock, &odd, &index), MOR_OK);
    state->sets[0] = &state->soil;
    state->sets[1] = &state->rock;
    state->sets[2] = &state->empty;
}

static void clear_sample(mor_context *context, sample *state)
{
    for (int set = 0; set < 3; ++set) {
        mor_set_clear(context, state->sets[set]);
    }
}

static void add_step(mor_context *context, mor_snapshot_writer *writer, sample *state, int64_t step)
{
    fill_set(&state->soil, step);
    fill_set(&state->rock, step);
    assert_int_equal(mor_snapshot_writer_add(context, writer, state->sets, 3, step, 0.1 * (double)step), MOR_OK);
}

/* Compares everything in one snapshot with what add_step wrote, after rounding to single precision or not. */
static void check_step(run_folder *folder, const sample *state, int64_t step, bool is_single)
{
    mor_context *context = &folder->context;
    mor_snapshot snapshot;
    assert_int_equal(mor_snapshot_open(context, &snapshot, folder->path, step), MOR_OK);
    assert_int_equal(snapshot.step, step);
    assert_true(snapshot.time == 0.1 * (double)step); /* exact: stored in double */
    assert_int_equal(snapshot.n_sets, 3);
    for (int s = 0; s < 3; ++s) {
        const mor_set *set = state->sets[s];
        const mor_snapshot_set *found = mor_snapshot_find_set(&snapshot, set->name);
        int64_t ids[N_SOIL];
        assert_non_null(found);
        assert_int_equal(found->n_particles, set->n_particles);
        assert_int_equal(mor_snapshot_read_ids(context, &snapshot, found, ids), MOR_OK);
        for (int64_t i = 0; i < set->n_particles; ++i) {
            assert_int_equal(ids[i], set->n_particles - 1 - i);
        }
        int n_expected = 0;
        for (int field = 0; field < set->n_fields; ++field) {
            const mor_field_info *info = &set->fields[field];
            const mor_snapshot_field *read = mor_snapshot_find_field(found, info->name);
            if (set->data[field] == NULL || (info->flags & MOR_FIELD_OUTPUT) == 0) {
                assert_null(read);
                continue;
            }
            double values[9 * N_SOIL];
            n_expected += 1;
            assert_non_null(read);
            assert_string_equal(read->unit, info->unit);
            assert_string_equal(read->text, info->text);
            assert_int_equal(read->n_components, info->n_components);
            assert_int_equal(read->is_single, is_single);
            assert_int_equal(mor_snapshot_read_field(context, &snapshot, found, read, values), MOR_OK);
            for (int64_t k = 0; k < set->n_particles * info->n_components; ++k) {
                const double written = sample_value(step, field, k);
                assert_true(values[k] == (is_single ? (double)(float)written : written)); /* exact */
            }
        }
        assert_int_equal(found->n_fields, n_expected);
    }
    mor_snapshot_close(context, &snapshot);
}

static void expect_steps(run_folder *folder, const int64_t *steps, int64_t n_steps)
{
    mor_snapshot_list list;
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, folder->path), MOR_OK);
    assert_int_equal(list.n, n_steps);
    for (int64_t k = 0; k < n_steps; ++k) {
        assert_int_equal(list.items[k].step, steps[k]);
        assert_int_equal(list.items[k].n_sets, 3);
    }
    mor_snapshot_list_clear(&folder->context, &list);
}

static void round_trip_keeps_fields_ids_units_and_texts(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    sample source;
    make_sample(&folder->context, &source);
    for (int is_single = 0; is_single < 2; ++is_single) {
        assert_int_equal(
            mor_snapshot_writer_init(&folder->context, &writer, folder->path, is_single ? &in_single : &in_double, -1),
            MOR_OK);
        add_step(&folder->context, &writer, &source, 0);
        add_step(&folder->context, &writer, &source, 1234567);
        mor_snapshot_writer_clear(&folder->context, &writer);
        expect_steps(folder, (const int64_t[]){0, 1234567}, 2);
        check_step(folder, &source, 0, is_single);
        check_step(folder, &source, 1234567, is_single);
    }
    clear_sample(&folder->context, &source);
}

static void resume_drops_later_snapshots_and_goes_on(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    sample source;
    char path[MOR_PATH_BYTES];
    struct stat status[2];
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    for (int64_t step = 0; step <= 30; step += 10) {
        add_step(&folder->context, &writer, &source, step);
    }
    mor_snapshot_writer_clear(&folder->context, &writer);
    run_folder_store(run_folder_file(folder, path, "snapshots/step_000040.h5.tmp"), "torn", 4);
    assert_int_equal(stat(run_folder_file(folder, path, "snapshots/step_000010.h5"), &status[0]), 0);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, 15), MOR_OK);
    assert_int_not_equal(access(run_folder_file(folder, path, "snapshots/step_000040.h5.tmp"), F_OK), 0);
    expect_steps(folder, (const int64_t[]){0, 10}, 2);
    add_step(&folder->context, &writer, &source, 17);
    mor_snapshot_writer_clear(&folder->context, &writer);
    expect_steps(folder, (const int64_t[]){0, 10, 17}, 3);
    check_step(folder, &source, 10, false);
    check_step(folder, &source, 17, false);
    assert_int_equal(stat(run_folder_file(folder, path, "snapshots/step_000010.h5"), &status[1]), 0);
    assert_true(status[0].st_ino == status[1].st_ino); /* the earlier file was not written again */
    assert_int_equal(folder->n_logged, 0);
    clear_sample(&folder->context, &source);
}

static void new_run_leaves_no_old_snapshot(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    sample source;
    char path[MOR_PATH_BYTES];
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    add_step(&folder->context, &writer, &source, 0);
    mor_snapshot_writer_clear(&folder->context, &writer);
    assert_int_equal(access(run_folder_file(folder, path, MOR_SNAPSHOT_INDEX_FILE), F_OK), 0);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    mor_snapshot_writer_clear(&folder->context, &writer);
    expect_steps(folder, NULL, 0);
    assert_int_not_equal(access(run_folder_file(folder, path, MOR_SNAPSHOT_INDEX_FILE), F_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, MOR_SNAPSHOT_XDMF_FILE), F_OK), 0);
    clear_sample(&folder->context, &source);
}

static void index_file_leads_to_every_snapshot(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    mor_hdf5_file *file = NULL;
    sample source;
    char path[MOR_PATH_BYTES];
    char text[64];
    double density[N_SOIL];
    const mor_hdf5_shape shape = {MOR_HDF5_DOUBLE, N_SOIL, 1};
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    add_step(&folder->context, &writer, &source, 3);
    add_step(&folder->context, &writer, &source, 12);
    run_folder_file(folder, path, MOR_SNAPSHOT_INDEX_FILE);
    assert_int_equal(mor_hdf5_file_open(&folder->context, &file, path, "snapshot-index", 1, MOR_SEAL_CHECK_ALL),
                     MOR_OK);
    assert_int_equal(mor_hdf5_file_read(&folder->context, file, "/step_000012/clay & <sand>/density", &shape, density),
                     MOR_OK);
    assert_memory_equal(density, source.soil.data[MOR_FIELD_DENSITY], sizeof density);
    assert_int_equal(mor_hdf5_file_get_text(&folder->context, file, "/step_000003", "time_unit", text, sizeof text),
                     MOR_OK);
    assert_string_equal(text, "s");
    assert_int_equal(mor_hdf5_file_get_text(&folder->context, file, "/step_000003/rock/stress", "component_names", text,
                                            sizeof text),
                     MOR_OK);
    assert_string_equal(text, "xx yy zz xy yz zx");
    for (int k = 0; k < 3; ++k) {
        assert_int_equal(mor_hdf5_file_get_text(&folder->context, file, "/provenance", facts[k].key, text, sizeof text),
                         MOR_OK);
        assert_string_equal(text, facts[k].value);
    }
    mor_hdf5_file_discard(&folder->context, &file);
    mor_snapshot_writer_clear(&folder->context, &writer);
    clear_sample(&folder->context, &source);
}

static int count_text(const char *text, const char *wanted)
{
    int n_found = 0;
    for (const char *place = strstr(text, wanted); place != NULL; place = strstr(place + 1, wanted)) {
        n_found += 1;
    }
    return n_found;
}

static void description_for_paraview_names_every_array_once(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    sample source;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    add_step(&folder->context, &writer, &source, 1);
    add_step(&folder->context, &writer, &source, 2);
    mor_snapshot_writer_clear(&folder->context, &writer);
    char *text = (char *)run_folder_load(run_folder_file(folder, path, MOR_SNAPSHOT_XDMF_FILE), &n_bytes);
    assert_non_null(text);
    assert_int_equal(count_text(text, "CollectionType=\"Temporal\""), 2); /* the empty set has no grid */
    assert_int_equal(count_text(text, "GridType=\"Uniform\""), 4);
    assert_int_equal(count_text(text, "<Time Value=\"0.10000000000000001\"/>"), 2);
    assert_int_equal(count_text(text, "Grid Name=\"clay &amp; &lt;sand&gt;\""), 3);
    assert_int_equal(count_text(text, "Dimensions=\"11 6\">snapshots/step_000002.h5:/step_000002/clay &amp; "
                                      "&lt;sand&gt;/stress</DataItem>"),
                     1);
    assert_int_equal(count_text(text, "Name=\"stress\" AttributeType=\"Matrix\""), 4);
    assert_int_equal(count_text(text, "Name=\"velocity\" AttributeType=\"Vector\""), 4);
    assert_int_equal(count_text(text, "Name=\"deformation\" AttributeType=\"Tensor\""), 2);
    assert_int_equal(count_text(text, "/rock/position</DataItem>"), 2);
    assert_int_equal(count_text(text, "density_rate"), 0); /* not an output field */
    free(text);
    clear_sample(&folder->context, &source);
}

static void damaged_snapshot_is_refused_and_left_out_with_a_warning(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    mor_snapshot snapshot;
    sample source;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    add_step(&folder->context, &writer, &source, 1);
    add_step(&folder->context, &writer, &source, 2);
    mor_snapshot_writer_clear(&folder->context, &writer);
    unsigned char *bytes = run_folder_load(run_folder_file(folder, path, "snapshots/step_000001.h5"), &n_bytes);
    bytes[n_bytes - 5] ^= 1u;
    run_folder_store(path, bytes, n_bytes);
    assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, folder->path, 1), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "step_000001.h5' is damaged"));
    run_folder_store(path, bytes, n_bytes / 2);
    assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, folder->path, 1), MOR_ERROR_IO);
    expect_steps(folder, (const int64_t[]){2}, 1);
    assert_int_equal(folder->n_logged, 1);
    assert_non_null(strstr(folder->log, "step_000001.h5"));
    assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, folder->path, 7), MOR_ERROR_IO);
    free(bytes);
    clear_sample(&folder->context, &source);
}

static void steps_must_rise_and_names_must_fit(void **state)
{
    run_folder *folder = *state;
    mor_snapshot_writer writer;
    sample source;
    make_sample(&folder->context, &source);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &in_double, -1), MOR_OK);
    add_step(&folder->context, &writer, &source, 5);
    assert_int_equal(mor_snapshot_writer_add(&folder->context, &writer, source.sets, 3, 5, 1.0), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_snapshot_writer_add(&folder->context, &writer, source.sets, 3, 6, NAN), MOR_ERROR_ARGUMENT);
    strcpy(source.rock.name, "a/b");
    assert_int_equal(mor_snapshot_writer_add(&folder->context, &writer, source.sets, 3, 6, 1.0), MOR_ERROR_ARGUMENT);
    mor_snapshot_writer_clear(&folder->context, &writer);
    expect_steps(folder, (const int64_t[]){5}, 1); /* what failed left nothing */
    clear_sample(&folder->context, &source);
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(round_trip_keeps_fields_ids_units_and_texts),
        FOLDER_TEST(resume_drops_later_snapshots_and_goes_on),
        FOLDER_TEST(new_run_leaves_no_old_snapshot),
        FOLDER_TEST(index_file_leads_to_every_snapshot),
        FOLDER_TEST(description_for_paraview_names_every_array_once),
        FOLDER_TEST(damaged_snapshot_is_refused_and_left_out_with_a_warning),
        FOLDER_TEST(steps_must_rise_and_names_must_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
