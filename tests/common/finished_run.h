/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FINISHED_RUN_H
#define MOR_TESTS_COMMON_FINISHED_RUN_H

#include "core/io/snapshot.h"
#include "core/io/summary/summary.h"
#include "core/io/table.h"
#include "tests/common/run_folder.h"

/** @file
 *  A small case, and the comparison of the folders that two runs of it leave behind. */

/** The case, with ' in place of ". Its probes are those that could remember something between steps. */
static const char finished_run_case[] =
    "title = 'heap'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');"
    "end = '60 ms'; domain = { min = ('-0.1 m', '-0.05 m', '-1 m'); max = ('0.4 m', '0.3 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.15 m', '0.12 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; cohesion = '0.1 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'box'; min = ('-0.06 m', '0 m'); max = ('0 m', '0.3 m'); }; } );"
    "probes = ( { type = 'run_out'; }, { type = 'front_speed'; }, { type = 'height'; },"
    "  { type = 'kinetic_energy'; }, { type = 'energy_left'; }, { type = 'dissipated_energy'; },"
    "  { type = 'wall_force'; wall = 'floor'; direction = (0, 1, 0); window = (0.015, 0.0333); },"
    "  { type = 'density_drift'; }, { type = 'toe'; window = (0, 0.02); },"
    "  { type = 'stress_noise'; } );"
    "numerics = { density_reinitialization = 7; sort_interval = 11; };"
    "output = { snapshots = 6; pictures = false; };";

/** Writes a case, zero-terminated with ' in place of ", as case.cfg of the scratch folder; path, shape
 *  [MOR_PATH_BYTES], receives where. */
static inline void finished_run_store_text(run_folder *folder, const char *source, char *path)
{
    const size_t n_bytes = strlen(source);
    char *text = malloc(n_bytes + 1);
    assert_non_null(text);
    for (size_t k = 0; k < n_bytes; ++k) {
        text[k] = source[k] == '\'' ? '"' : source[k];
    }
    run_folder_store(run_folder_file(folder, path, "case.cfg"), text, n_bytes);
    free(text);
}

/** Writes the case above as case.cfg of the scratch folder; path, shape [MOR_PATH_BYTES], receives where. */
static inline void finished_run_store_case(run_folder *folder, char *path)
{
    finished_run_store_text(folder, finished_run_case, path);
}

/** Puts the path of a file of a run into path, shape [MOR_PATH_BYTES]; names are zero-terminated. */
static inline const char *finished_run_file(run_folder *folder, char *path, const char *run, const char *name)
{
    char in_folder[MOR_PATH_BYTES];
    assert_int_equal(mor_durable_file_join(&folder->context, in_folder, run, name), MOR_OK);
    return run_folder_file(folder, path, in_folder);
}

/** The value of a column of the series that begins with a name, at a row; of the last row where that is negative. */
static inline double finished_run_read_value(run_folder *folder, const char *run, const char *name, int64_t row)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    int column = 0;
    assert_int_equal(
        mor_table_data_read(&folder->context, &data, finished_run_file(folder, path, run, MOR_TABLE_SERIES_FILE)),
        MOR_OK);
    const char *at = data.header;
    while (strncmp(at, name, strlen(name)) != 0 || at[strlen(name)] != ' ') {
        at = strchr(at, ',');
        assert_non_null(at);
        at += 1;
        column += 1;
    }
    const double value = data.values[(row < 0 ? data.n_rows - 1 : row) * data.n_columns + column];
    mor_table_data_clear(&folder->context, &data);
    return value;
}

/** Fails unless a file, zero-terminated name, has the same bytes in both runs. */
static inline void finished_run_compare_bytes(run_folder *folder, const char *a, const char *b, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_a = 0;
    size_t n_b = 0;
    unsigned char *bytes_a = run_folder_load(finished_run_file(folder, path, a, name), &n_a);
    unsigned char *bytes_b = run_folder_load(finished_run_file(folder, path, b, name), &n_b);
    assert_non_null(bytes_a);
    assert_non_null(bytes_b);
    if (n_a != n_b || memcmp(bytes_a, bytes_b, n_a) != 0) {
        fail_msg("%s of the runs '%s' and '%s' differ", name, a, b);
    }
    free(bytes_a);
    free(bytes_b);
}

/** Puts the hash of the final state, as summary.json tells it, into hash, shape [32]. */
static inline void finished_run_read_hash(run_folder *folder, const char *run, char *hash)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
    char *text = (char *)run_folder_load(path, &n_bytes);
    const char *at = strstr(text, "\"state_hash\": \"");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "\"state_hash\": \"%16[0-9a-f]\"", hash), 1);
    free(text);
}

/** Fails unless a field of a set, number `at`, has the same bits in both snapshots. */
static inline void finished_run_compare_field(run_folder *folder, const mor_snapshot *a, const mor_snapshot *b, int at,
                                              int field)
{
    const mor_snapshot_set *set = &a->sets[at];
    const size_t n_bytes = (size_t)(set->n_particles * set->fields[field].n_components) * sizeof(double);
    double *values_a = malloc(n_bytes);
    double *values_b = malloc(n_bytes);
    assert_non_null(values_a);
    assert_non_null(values_b);
    assert_string_equal(set->fields[field].name, b->sets[at].fields[field].name);
    assert_int_equal(mor_snapshot_read_field(&folder->context, a, set, &set->fields[field], values_a), MOR_OK);
    assert_int_equal(mor_snapshot_read_field(&folder->context, b, &b->sets[at], &b->sets[at].fields[field], values_b),
                     MOR_OK);
    assert_memory_equal(values_a, values_b, n_bytes);
    free(values_a);
    free(values_b);
}

/** Fails unless both runs have the same snapshots: steps, times and fields. */
static inline void finished_run_compare_snapshots(run_folder *folder, const char *run_a, const char *run_b)
{
    char path_a[MOR_PATH_BYTES];
    char path_b[MOR_PATH_BYTES];
    mor_snapshot_list a;
    mor_snapshot_list b;
    run_folder_file(folder, path_a, run_a);
    run_folder_file(folder, path_b, run_b);
    assert_int_equal(mor_snapshot_list_init(&folder->context, &a, path_a), MOR_OK);
    assert_int_equal(mor_snapshot_list_init(&folder->context, &b, path_b), MOR_OK);
    assert_int_equal(a.n, 7); /* the first and those that the case asks for */
    assert_int_equal(a.n, b.n);
    for (int64_t k = 0; k < a.n; ++k) {
        mor_snapshot one;
        mor_snapshot other;
        assert_int_equal(a.items[k].step, b.items[k].step);
        assert_memory_equal(&a.items[k].time, &b.items[k].time, sizeof(double));
        assert_int_equal(mor_snapshot_open(&folder->context, &one, path_a, a.items[k].step), MOR_OK);
        assert_int_equal(mor_snapshot_open(&folder->context, &other, path_b, b.items[k].step), MOR_OK);
        assert_int_equal(one.n_sets, other.n_sets);
        for (int set = 0; set < one.n_sets; ++set) {
            assert_int_equal(one.sets[set].n_particles, other.sets[set].n_particles);
            assert_int_equal(one.sets[set].n_fields, other.sets[set].n_fields);
            for (int field = 0; field < one.sets[set].n_fields; ++field) {
                finished_run_compare_field(folder, &one, &other, set, field);
            }
        }
        mor_snapshot_close(&folder->context, &one);
        mor_snapshot_close(&folder->context, &other);
    }
    mor_snapshot_list_clear(&folder->context, &a);
    mor_snapshot_list_clear(&folder->context, &b);
}

/** Fails unless the summaries of both runs have the same results: values and statistics, digit by digit. */
static inline void finished_run_compare_results(run_folder *folder, const char *run_a, const char *run_b)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *texts[2];
    for (int k = 0; k < 2; ++k) {
        texts[k] = (char *)run_folder_load(finished_run_file(folder, path, k == 0 ? run_a : run_b, MOR_SUMMARY_FILE),
                                           &n_bytes);
        assert_non_null(texts[k]);
        assert_non_null(strstr(texts[k], "\"time_of_maximum\""));
        char *end = strstr(texts[k], "\"expect\": [");
        assert_non_null(end);
        *end = '\0';
    }
    if (strcmp(texts[0], texts[1]) != 0) {
        fail_msg("the runs '%s' and '%s' have the results\n%s\nand\n%s", run_a, run_b, texts[0], texts[1]);
    }
    free(texts[0]);
    free(texts[1]);
}

/** Fails unless two runs, zero-terminated names in the scratch folder, left the same results behind, bit by bit. */
static inline void finished_run_compare(run_folder *folder, const char *run_a, const char *run_b)
{
    char hash_a[32];
    char hash_b[32];
    finished_run_read_hash(folder, run_a, hash_a);
    finished_run_read_hash(folder, run_b, hash_b);
    if (strcmp(hash_a, hash_b) != 0) {
        fail_msg("the runs '%s' and '%s' end in the states %s and %s", run_a, run_b, hash_a, hash_b);
    }
    finished_run_compare_bytes(folder, run_a, run_b, MOR_TABLE_SERIES_FILE);
    finished_run_compare_results(folder, run_a, run_b);
    finished_run_compare_snapshots(folder, run_a, run_b);
}

#endif
