/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/io/checkpoint.h"
#include "core/io/snapshot.h"
#include "core/io/table.h"
#include "tests/common/run_folder.h"

#include <signal.h>
#include <sys/wait.h>

enum { N_PARTICLES = 2000, N_KILLS = 25, KILL_AFTER_MICROSECONDS_MAX = 30000 };

static const mor_table_column columns[] = {{"time", "s"}, {"step", "1"}};
static const mor_snapshot_options options = {false, NULL, 0};

/* A state that says everywhere which step it is of. */
typedef struct run {
    mor_set set;
    mor_set *sets[1];
    int64_t step;
    mor_state_list list;
    mor_checkpoint view;
} run;

static void make_run(mor_context *context, run *state)
{
    memset(state, 0, sizeof *state);
    assert_int_equal(mor_set_init(context, &state->set, "soil", N_PARTICLES, 1u << MOR_FIELD_POSITION), MOR_OK);
    state->sets[0] = &state->set;
    assert_int_equal(mor_state_add_set(context, &state->list, &state->set), MOR_OK);
    assert_int_equal(mor_state_add(context, &state->list, "run", "step", MOR_STATE_INT64, 1, &state->step), MOR_OK);
    state->view = (mor_checkpoint){&state->list, NULL};
}

static void set_step(run *state, int64_t step)
{
    state->step = step;
    for (int k = 0; k < 3 * N_PARTICLES; ++k) {
        state->set.data[MOR_FIELD_POSITION][k] = (double)step + 0.001 * k;
    }
}

static bool is_of_step(const double *position, int64_t step)
{
    for (int k = 0; k < 3 * N_PARTICLES; ++k) {
        if (position[k] != (double)step + 0.001 * k) {
            return false;
        }
    }
    return true;
}

/* Goes on from a step and writes row, snapshot and checkpoint of every step until n_steps or a signal ends it. */
static mor_status write_steps(run_folder *folder, run *state, int64_t last_step, int64_t n_steps)
{
    mor_context *context = &folder->context;
    mor_snapshot_writer writer;
    mor_table table;
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, folder->path, MOR_TABLE_SERIES_FILE));
    MOR_TRY(context, mor_table_resume(context, &table, path, columns, 2, (double)last_step));
    MOR_TRY(context, mor_snapshot_writer_init(context, &writer, folder->path, &options, last_step));
    for (int64_t step = last_step + 1; step <= last_step + n_steps; ++step) {
        set_step(state, step);
        MOR_TRY(context, mor_table_append(context, &table, (const double[]){(double)step, (double)step}));
        MOR_TRY(context, mor_snapshot_writer_add(context, &writer, state->sets, 1, step, (double)step));
        MOR_TRY(context, mor_checkpoint_write(context, folder->path, &state->view));
    }
    mor_snapshot_writer_clear(context, &writer);
    MOR_TRY(context, mor_table_close(context, &table));
    return MOR_OK;
}

/* Writes in another process and kills that after a while. */
static void write_until_killed(run_folder *folder, run *state, int64_t last_step, useconds_t microseconds)
{
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        _exit(write_steps(folder, state, last_step, INT32_MAX) == MOR_OK ? 0 : 1);
    }
    usleep(microseconds);
    assert_int_equal(kill(child, SIGKILL), 0);
    int ending = 0;
    assert_int_equal(waitpid(child, &ending, 0), child);
    assert_true(WIFSIGNALED(ending)); /* it wrote without an error until then */
}

/* All snapshots are there and whole; returns the number of the last. */
static int64_t check_snapshots(run_folder *folder)
{
    mor_snapshot_list list;
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, folder->path), MOR_OK);
    for (int64_t k = 0; k < list.n; ++k) {
        double position[3 * N_PARTICLES];
        mor_snapshot snapshot;
        assert_int_equal(list.items[k].step, k);
        assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, folder->path, k), MOR_OK);
        assert_int_equal(mor_snapshot_read_field(&folder->context, &snapshot, &snapshot.sets[0],
                                                 &snapshot.sets[0].fields[0], position),
                         MOR_OK);
        assert_true(is_of_step(position, k));
        mor_snapshot_close(&folder->context, &snapshot);
    }
    const int64_t last_step = list.n - 1;
    mor_snapshot_list_clear(&folder->context, &list);
    return last_step;
}

static void a_writer_killed_at_any_moment_loses_nothing_finished(void **state)
{
    run_folder *folder = *state;
    run current;
    make_run(&folder->context, &current);
    assert_int_equal(write_steps(folder, &current, -1, 2), MOR_OK);
    folder->n_logged = 0; /* the series was new */
    int64_t last_step = 1;
    double longest = KILL_AFTER_MICROSECONDS_MAX;
    for (uint64_t k = 0; k < N_KILLS; ++k) {
        const double share = mor_random_uniform(1, k, 0);
        write_until_killed(folder, &current, last_step, (useconds_t)(share * longest));
        assert_int_equal(mor_checkpoint_read_latest(&folder->context, folder->path, &current.view), MOR_OK);
        assert_true(is_of_step(current.set.data[MOR_FIELD_POSITION], current.step));
        assert_true(current.step >= last_step);
        assert_true(check_snapshots(folder) >= current.step);
        /* On a busy machine a writer that got nothing done is given more time: no clock decides this test. */
        longest *= current.step == last_step && longest < 1.0e6 ? 2.0 : 1.0;
        last_step = current.step;
    }
    assert_true(last_step > 1); /* some of the writers got something done */
    assert_int_equal(folder->n_logged, 0);
    assert_int_equal(write_steps(folder, &current, last_step, 1), MOR_OK);
    assert_int_equal(check_snapshots(folder), last_step + 1);
    mor_table_data series;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &series, path), MOR_OK);
    assert_int_equal(series.n_rows, last_step + 2);
    for (int64_t k = 0; k < series.n_rows; ++k) {
        assert_true(series.values[2 * k] == (double)k); /* exact: whole numbers, each once */
    }
    mor_table_data_clear(&folder->context, &series);
    mor_set_clear(&folder->context, &current.set);
    mor_state_clear(&folder->context, &current.list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_writer_killed_at_any_moment_loses_nothing_finished, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
