/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_files.h"

#include "cases/driver/case/schema/case_compare.h"
#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/probe/probe.h"
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/io/summary.h"

#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LOG_FILE "log.txt"
#define IMAGES_FOLDER "images"

/* Everything goes into log.txt; warnings and errors reach the terminal as well. */
static void log_line(void *user, mor_log_level level, const char *text)
{
    static const char *const names[] = {"debug", "info", "warning", "error"};
    mor_run_files *files = user;
    fprintf(files->log, "%s: %s\n", names[level], text);
    fflush(files->log);
    if (level == MOR_LOG_WARNING) {
        mor_run_warnings_add(&files->warnings, text);
    }
    if (level >= MOR_LOG_WARNING && files->previous_sink != NULL) {
        files->previous_sink(files->previous_user, level, text);
    }
}

bool mor_run_files_has(mor_context *context, const char *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    return mor_durable_file_join(context, path, folder, name) == MOR_OK && access(path, F_OK) == 0;
}

/* The user chose the folder, so it is the user's input that is refused. */
static mor_status make_folder(mor_context *context, const char *path)
{
    const mor_status status = mor_durable_file_make_folder(context, path);
    return status != MOR_ERROR_IO
               ? status
               : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s; choose the folder with -o", context->message);
}

mor_status mor_run_files_make_folders(mor_context *context, const char *path)
{
    char part[MOR_PATH_BYTES];
    MOR_CHECK(context, strlen(path) < sizeof part, MOR_ERROR_CONFIG, "the name of the run's folder is too long: %s",
              path);
    strcpy(part, path);
    for (char *slash = strchr(part + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        MOR_TRY(context, make_folder(context, part));
        *slash = '/';
    }
    return make_folder(context, part);
}

mor_status mor_run_files_refuse_run(mor_context *context, const char *folder, const char *advice)
{
    const bool holds_run = mor_run_files_has(context, folder, MOR_CHECKPOINT_FILE) ||
                           mor_run_files_has(context, folder, MOR_CHECKPOINT_PREVIOUS_FILE) ||
                           mor_run_files_has(context, folder, MOR_SUMMARY_FILE);
    MOR_CHECK(context, !holds_run, MOR_ERROR_CONFIG, "the folder '%s' already holds a run; %s", folder, advice);
    return MOR_OK;
}

mor_status mor_run_files_listen(mor_context *context, mor_run_files *files)
{
    memset(files, 0, sizeof *files);
    files->log = open_memstream(&files->early_text, &files->n_early_bytes);
    MOR_CHECK(context, files->log != NULL, MOR_ERROR_MEMORY, "no memory for the log of a run");
    files->previous_sink = context->log_sink;
    files->previous_user = context->log_user;
    context->log_sink = log_line;
    context->log_user = files;
    return MOR_OK;
}

/* Makes a file the log: its first line says what was started, then follows what was logged before. */
static void begin_log(mor_context *context, mor_run_files *files, FILE *log)
{
    const mor_run_options *options = files->options;
    fclose(files->log);
    files->log = log;
    mor_context_log(context, MOR_LOG_INFO, "moraine %s, commit %s: %s", options->version, options->commit,
                    options->command);
    fwrite(files->early_text, 1, files->n_early_bytes, log);
    fflush(log);
    free(files->early_text);
    files->early_text = NULL;
}

mor_status mor_run_files_open(mor_context *context, mor_run_files *files, const mor_run_options *options)
{
    char path[MOR_PATH_BYTES];
    files->options = options;
    if (!options->is_resume) {
        MOR_TRY(context, mor_run_files_refuse_run(context, options->folder,
                                                  "add --resume to go on with it, or choose another folder with -o"));
    }
    files->is_folder_new = access(options->folder, F_OK) != 0;
    MOR_TRY(context, mor_run_files_make_folders(context, options->folder));
    MOR_TRY(context, mor_durable_file_join(context, path, options->folder, IMAGES_FOLDER));
    MOR_TRY(context, make_folder(context, path));
    MOR_TRY(context, mor_durable_file_join(context, path, options->folder, LOG_FILE));
    if (options->is_resume) {
        mor_run_warnings_load(&files->warnings, path);
    }
    FILE *log = fopen(path, "a");
    MOR_CHECK(context, log != NULL, MOR_ERROR_IO, "'%s' cannot be written; check the folder's permissions", path);
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(log), F_SETLK, &lock) != 0) {
        fclose(log);
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "another program is at work on the run in '%s'; wait for it, or choose another folder with -o",
                        options->folder);
    }
    begin_log(context, files, log);
    return MOR_OK;
}

static void add_column(mor_run_files *files, const char *name, const char *unit)
{
    files->columns[files->n_columns++] = (mor_table_column){name, unit};
}

static void add_fact(mor_run_files *files, const char *key, const char *value)
{
    files->facts[files->n_facts++] = (mor_snapshot_fact){key, value};
}

static void set_facts(mor_run_files *files)
{
    snprintf(files->seed_text, sizeof files->seed_text, "%" PRIu64, files->the_case->seed);
    mor_hash_print(files->case_hash, files->hash_text);
    add_fact(files, "version", files->options->version);
    add_fact(files, "commit", files->options->commit);
    add_fact(files, "command", files->options->command);
    add_fact(files, "seed", files->seed_text);
    add_fact(files, "case", files->the_case->path);
    add_fact(files, "case_xxh64", files->hash_text);
    add_fact(files, "instruction_set", mor_pair_select(NULL)->instruction_set);
}

mor_status mor_run_files_start(mor_context *context, mor_run_files *files, bool is_resume)
{
    char path[MOR_PATH_BYTES];
    const char *folder = files->options->folder;
    const mor_schedule *schedule = &files->simulation->schedule;
    set_facts(files);
    const mor_snapshot_options options = {.facts = files->facts, .n_facts = files->n_facts};
    MOR_TRY(context, mor_snapshot_writer_init(context, &files->snapshots, folder, &options,
                                              is_resume ? (int64_t)schedule->n_steps : -1));
    for (const mor_case_own_column *own = mor_case_own_columns; own->name != NULL; ++own) {
        add_column(files, own->name, own->unit);
    }
    files->first_probe = files->n_columns;
    for (int k = 0; k < files->the_case->n_probes; ++k) {
        add_column(files, files->the_case->probes[k].name, mor_probe_unit(files->the_case, k));
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_TABLE_SERIES_FILE));
    return is_resume ? mor_table_resume(context, &files->series, path, files->columns, files->n_columns,
                                        mor_schedule_time(schedule))
                     : mor_table_create(context, &files->series, path, files->columns, files->n_columns);
}

void mor_run_files_discard(mor_context *context, mor_run_files *files)
{
    static const char *const names[] = {LOG_FILE, MOR_RUN_CASE_FILE, IMAGES_FOLDER};
    char path[MOR_PATH_BYTES];
    for (size_t k = 0; k < sizeof names / sizeof *names && files->is_folder_new; ++k) {
        if (mor_durable_file_join(context, path, files->options->folder, names[k]) == MOR_OK) {
            remove(path);
        }
    }
    if (files->is_folder_new) {
        remove(files->options->folder); /* fails, as it should, when anything is left in it */
    }
}

void mor_run_files_close(mor_context *context, mor_run_files *files)
{
    if (files->series.stream != NULL) {
        mor_table_close(context, &files->series);
    }
    mor_snapshot_writer_clear(context, &files->snapshots);
    if (files->log != NULL) {
        context->log_sink = files->previous_sink;
        context->log_user = files->previous_user;
        fclose(files->log);
        files->log = NULL;
    }
    free(files->early_text);
    files->early_text = NULL;
    mor_run_warnings_clear(&files->warnings);
    free(files->case_text);
    files->case_text = NULL;
    MOR_FREE(context, &files->saved_text);
    MOR_FREE(context, &files->kept.bytes);
}

mor_status mor_run_files_add_row(mor_context *context, mor_run_files *files)
{
    double row[MOR_RUN_COLUMNS_MAX];
    const mor_schedule *schedule = &files->simulation->schedule;
    row[0] = mor_schedule_time(schedule);
    row[1] = (double)schedule->n_steps;
    row[2] = schedule->step_length;
    row[3] = (double)mor_schedule_rate_ratio(schedule);
    for (int k = 0; k < files->the_case->n_probes; ++k) {
        MOR_TRY(context, mor_probe_value(context, files->simulation, k, &row[files->first_probe + k]));
    }
    return mor_table_append(context, &files->series, row);
}

mor_status mor_run_files_add_snapshot(mor_context *context, mor_run_files *files)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(files->simulation, false, sets);
    const mor_schedule *schedule = &files->simulation->schedule;
    return mor_snapshot_writer_add(context, &files->snapshots, sets, n_sets, (int64_t)schedule->n_steps,
                                   mor_schedule_time(schedule));
}

/* Everything a checkpoint holds, as a view of the simulation. */
enum { VALUES_MAX = 24 + 6 * MOR_BODY_GROUPS_MAX, VALUE_NAME_BYTES = 80 };
typedef struct saved_state {
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    mor_checkpoint_value values[VALUES_MAX];
    char names[VALUES_MAX][VALUE_NAME_BYTES]; /* of the values that belong to a group */
    int n_values;
    mor_checkpoint checkpoint;
} saved_state;

static void add_value(saved_state *state, const char *owner, const char *name, int64_t n, double *data)
{
    char *full = state->names[state->n_values];
    snprintf(full, VALUE_NAME_BYTES, "%.47s_%s", owner, name);
    state->values[state->n_values++] = (mor_checkpoint_value){full, MOR_HDF5_DOUBLE, n, data};
}

static void add_group_values(mor_simulation *s, int g, saved_state *state)
{
    mor_simulation_bodies *bodies = &s->bodies;
    mor_body_group *group = bodies->groups[g];
    const char *name = group->set.name;
    if (g < bodies->n_elastics) {
        mor_elastic *elastic = &bodies->elastics[g];
        add_value(state, name, "largest_speed", 1, &elastic->largest_speed);
        add_value(state, name, "largest_acceleration", 1, &elastic->largest_acceleration);
        add_value(state, name, "damped_energy", 1, &elastic->damped_energy);
    } else {
        add_value(state, name, "states", group->n_bodies * (int64_t)(sizeof(mor_rigid_state) / sizeof(double)),
                  bodies->rigid.states->center);
    }
    /* The soil's next step depends on it. Boundaries stand in the order of groups. */
    if (s->has_soil) {
        add_value(state, name, "barrier_step", 1, &s->soil.boundaries[g].longest_step);
    }
}

/* What a run must remember. Everything else follows from the case. */
static void list_state(mor_simulation *s, saved_state *state)
{
    const mor_checkpoint_value list[] = {
        {"schedule_now", MOR_HDF5_INT64, 1, &s->schedule.now},
        {"schedule_tick", MOR_HDF5_DOUBLE, 1, &s->schedule.tick},
        {"schedule_steps", MOR_HDF5_UINT64, 1, &s->schedule.n_steps},
        {"schedule_particle_steps", MOR_HDF5_UINT64, 1, &s->schedule.n_particle_steps},
        {"schedule_step_length", MOR_HDF5_DOUBLE, 1, &s->schedule.step_length},
        {"soil_largest_speed", MOR_HDF5_DOUBLE, 1, &s->soil.largest_speed},
        {"soil_largest_acceleration", MOR_HDF5_DOUBLE, 1, &s->soil.largest_acceleration},
        {"soil_wall_force", MOR_HDF5_DOUBLE, MOR_SOIL_WALLS_MAX * 3, s->soil.wall_force},
        {"soil_wall_impulse", MOR_HDF5_DOUBLE, MOR_SOIL_WALLS_MAX * 3, s->soil.wall_impulse},
        {"initial_energies", MOR_HDF5_DOUBLE, 3, s->initial_energies},
        {"surface_height", MOR_HDF5_DOUBLE, 1, &s->surface_height},
        {"bodies", MOR_HDF5_DOUBLE, s->bodies.n_packed, s->bodies.packed},
        {"contact_impacts", MOR_HDF5_DOUBLE, s->bodies.contact.n_impacts, s->bodies.contact.impacts},
        {"contact_sums", MOR_HDF5_DOUBLE, s->bodies.contact.n_sums, s->bodies.contact.sums},
        {"contact_deepest_share", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.deepest_share},
        {"contact_driven_share", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.driven_share},
        {"contact_spring_energy", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.spring_energy},
        {"contact_friction_energy", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.friction_energy},
        {"contact_damping_energy", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.damping_energy},
        {"contact_wall_energy", MOR_HDF5_DOUBLE, 1, &s->bodies.contact.wall_energy},
    };
    memset(state, 0, sizeof *state);
    memcpy(state->values, list, sizeof list);
    state->n_values = (int)(sizeof list / sizeof *list);
    mor_probe_track_state(s->probes, state->values + state->n_values);
    state->n_values += MOR_PROBE_TRACK_VALUES;
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        add_group_values(s, g, state);
    }
    if (s->has_soil) {
        add_value(state, "soil", "outflow", MOR_SOIL_OUTFLOW_STATE, s->soil.outflow);
    }
    if (s->soil.energy != NULL) {
        add_value(state, "soil", "energy_audit", MOR_SOIL_ENERGY_STATE, s->soil.energy->state);
    }
    const int n_sets = mor_simulation_sets(s, true, state->sets);
    state->checkpoint = (mor_checkpoint){state->sets, n_sets, state->values, state->n_values, NULL};
}

mor_status mor_run_files_save(mor_context *context, mor_run_files *files)
{
    saved_state state;
    list_state(files->simulation, &state);
    state.checkpoint.identity = files->case_text;
    MOR_TRY(context, mor_simulation_bodies_pack(context, &files->simulation->bodies, true));
    MOR_TRY(context, mor_table_sync(context, &files->series));
    return mor_checkpoint_write(context, files->options->folder, &state.checkpoint);
}

/* What is done with every array of a state. */
typedef enum copy_way { MEASURE, STORE, LOAD } copy_way;

static int64_t copy_array(char *bytes, int64_t at, void *data, int64_t n_bytes, copy_way way)
{
    if (n_bytes == 0) {
        return at; /* an array of nothing has no place */
    }
    if (way == STORE) {
        memcpy(bytes + at, data, (size_t)n_bytes);
    } else if (way == LOAD) {
        memcpy(data, bytes + at, (size_t)n_bytes);
    }
    return at + n_bytes;
}

/* Walks over all that a checkpoint holds; returns its bytes. Room is measured with the sets as they were made. */
static int64_t copy_state(const saved_state *state, char *bytes, copy_way way)
{
    int64_t at = 0;
    for (int k = 0; k < state->checkpoint.n_sets; ++k) {
        const mor_set *set = state->sets[k];
        const int64_t n = way == MEASURE ? set->n_created : set->n_particles;
        at = copy_array(bytes, at, set->id, n * (int64_t)sizeof *set->id, way);
        for (int field = 0; field < set->n_fields; ++field) {
            if ((set->fields[field].flags & MOR_FIELD_EVOLVES) != 0 && set->data[field] != NULL) {
                const int64_t n_bytes = n * set->fields[field].n_components * (int64_t)sizeof(double);
                at = copy_array(bytes, at, set->data[field], n_bytes, way);
            }
        }
    }
    for (int k = 0; k < state->n_values; ++k) {
        at = copy_array(bytes, at, state->values[k].data, 8 * state->values[k].n, way); /* 64-bit numbers of any kind */
    }
    return at;
}

mor_status mor_run_files_keep(mor_context *context, mor_run_files *files, int64_t next_snapshot)
{
    saved_state state;
    mor_run_kept *kept = &files->kept;
    list_state(files->simulation, &state);
    if (kept->bytes == NULL) {
        kept->n_bytes = copy_state(&state, NULL, MEASURE);
        MOR_TRY(context, MOR_NEW(context, &kept->bytes, kept->n_bytes, "a state to go back to"));
    }
    MOR_TRY(context, mor_simulation_bodies_pack(context, &files->simulation->bodies, true));
    for (int k = 0; k < state.checkpoint.n_sets; ++k) {
        kept->n_particles[k] = state.sets[k]->n_particles;
    }
    copy_state(&state, kept->bytes, STORE);
    kept->next_snapshot = next_snapshot;
    kept->is_valid = true;
    return MOR_OK;
}

/* What follows from a state that was put back. */
static mor_status take_up(mor_context *context, mor_simulation *s)
{
    if (s->has_soil) {
        mor_soil_fit(&s->soil);
    }
    s->bodies.contact.time = mor_schedule_time(&s->schedule);
    if (s->bodies.has_contact) {
        mor_contact_add_sums(&s->bodies.contact);
    }
    return mor_simulation_bodies_pack(context, &s->bodies, false);
}

mor_status mor_run_files_recall(mor_context *context, mor_run_files *files)
{
    saved_state state;
    list_state(files->simulation, &state);
    for (int k = 0; k < state.checkpoint.n_sets; ++k) {
        state.sets[k]->n_particles = files->kept.n_particles[k];
        state.sets[k]->generation += 1;
    }
    copy_state(&state, files->kept.bytes, LOAD);
    return take_up(context, files->simulation);
}

/* Why a state cannot be taken up though the case may go on: what the domain cuts off became more. */
static mor_status explain_refusal(mor_context *context, const mor_run_files *files, mor_status status)
{
    if (status != MOR_ERROR_CONFIG || !mor_case_compare_domains(files->case_text, files->saved_text)) {
        return status;
    }
    return MOR_FAIL(
        context, status,
        "%s; or: the domain was enlarged, and soil without end on a side goes as far as the domain, so that "
        "it cannot be enlarged there",
        context->message);
}

/* The state stands at its time, counted in the ticks of the run that it comes from; the end may be another. */
static mor_status set_clock(mor_context *context, mor_simulation *s)
{
    mor_schedule *schedule = &s->schedule;
    MOR_TRY(context, mor_schedule_set_end(context, schedule, s->the_case->end));
    MOR_CHECK(context, schedule->end >= schedule->now, MOR_ERROR_CONFIG,
              "found end = %.9g s, but the run stands at t = %.9g s; allowed: an end at that time or later; give a "
              "later 'end'",
              s->the_case->end, mor_schedule_time(schedule));
    return MOR_OK;
}

mor_status mor_run_files_restore(mor_context *context, mor_run_files *files, bool *is_restored)
{
    saved_state state;
    const char *folder = files->options->folder;
    mor_simulation *s = files->simulation;
    *is_restored = mor_run_files_has(context, folder, MOR_CHECKPOINT_FILE) ||
                   mor_run_files_has(context, folder, MOR_CHECKPOINT_PREVIOUS_FILE);
    if (!*is_restored) {
        mor_context_log(context, MOR_LOG_WARNING, "'%s' holds no checkpoint yet; the run starts from the beginning",
                        folder);
        return MOR_OK;
    }
    list_state(s, &state);
    const mor_status status = mor_checkpoint_read_latest(context, folder, &state.checkpoint);
    MOR_TRY(context, status == MOR_OK ? status : explain_refusal(context, files, status));
    MOR_TRY(context, set_clock(context, s));
    mor_probe_track_resume(s->probes);
    MOR_TRY(context, take_up(context, s));
    mor_context_log(context, MOR_LOG_INFO, "resumed at t = %.9g s, step %llu", mor_schedule_time(&s->schedule),
                    (unsigned long long)s->schedule.n_steps);
    return MOR_OK;
}
