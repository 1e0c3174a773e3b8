/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_SNAPSHOT_H
#define MOR_CORE_IO_SNAPSHOT_H

#include "core/io/durable_file.h"
#include "core/io/hdf5_file.h"
#include "core/particle/set.h"

/** @file
 *  Snapshots of the state for post-processing: written during a run, continued after a resume, and read back. They hold
 *  the output fields only; the complete state is in checkpoints.
 *
 *  Files of a run's folder:
 *
 *      snapshots/step_000012.h5   one snapshot, sealed, written once, never changed
 *      snapshots.h5               one link per snapshot: /step_000012 leads into snapshots/step_000012.h5
 *      snapshots.xdmf             description for ParaView: for each set a series in time
 *
 *  Why one file per snapshot: HDF5 changes old parts of a file when it adds to it, so a process killed while adding may
 *  lose all earlier snapshots, and a program reading the file may read invalid data. Here nothing written is changed
 *  again, snapshots are removed by deleting files, and the cost of adding one does not grow except for a line per
 *  earlier snapshot in the two small index files, which are replaced by renaming. The index files can always be made
 *  again from the snapshots, and this code never reads them.
 *
 *  Layout (version 1): /step_000012 with attributes step, time, time_unit and, where there is one, note;
 *  /step_000012/<set> with attribute n_particles; /step_000012/<set>/id [n] and <field> [n, components], each with
 *  attributes unit, text, components and component_names; /provenance with one text attribute per pair. Six components
 *  are a symmetric tensor in the order xx yy zz xy yz zx, nine a matrix by rows. */

#define MOR_SNAPSHOT_FOLDER "snapshots"
#define MOR_SNAPSHOT_INDEX_FILE "snapshots.h5"
#define MOR_SNAPSHOT_XDMF_FILE "snapshots.xdmf"

enum { MOR_SNAPSHOT_VERSION = 1, MOR_SNAPSHOT_UNIT_BYTES = 32, MOR_SNAPSHOT_TEXT_BYTES = 192 };

/** One field of one set in a snapshot. */
typedef struct mor_snapshot_field {
    char name[MOR_FIELD_NAME_BYTES];
    char unit[MOR_SNAPSHOT_UNIT_BYTES]; /* "1" for dimensionless */
    char text[MOR_SNAPSHOT_TEXT_BYTES]; /* one line of description */
    int n_components;                   /* numbers per particle, 1 to 9 */
    bool is_single;                     /* stored in single precision */
} mor_snapshot_field;

/** One set in a snapshot. */
typedef struct mor_snapshot_set {
    char name[MOR_FIELD_NAME_BYTES];
    int64_t n_particles;
    int n_fields;
    mor_snapshot_field *fields; /* shape [n_fields]; without the ids; owned by the snapshot */
} mor_snapshot_set;

/** One snapshot. Owner: the caller, who ends it with mor_snapshot_close. */
typedef struct mor_snapshot {
    int64_t step;
    double time;                        /* s */
    char note[MOR_SNAPSHOT_UNIT_BYTES]; /* a note, such as "run stopped"; "": nothing */
    int n_sets;
    mor_snapshot_set *sets; /* shape [n_sets]; owned by the snapshot */
    mor_hdf5_file *file;    /* NULL when only the description was read; owned by the snapshot */
} mor_snapshot;

/** All snapshots of a run. Owner: the caller, who ends it with mor_snapshot_list_clear. */
typedef struct mor_snapshot_list {
    int64_t n;           /* number of snapshots */
    mor_snapshot *items; /* shape [n]; descriptions without open files, by rising step */
    int64_t capacity;    /* room in items */
} mor_snapshot_list;

/** One item of provenance: program version, commit, seed, hash of the case, command, ... */
typedef struct mor_snapshot_fact {
    const char *key;   /* zero-terminated, unique */
    const char *value; /* zero-terminated */
} mor_snapshot_fact;

/** Settings of the writer. Everything in it is borrowed and must outlive the writer. */
typedef struct mor_snapshot_options {
    bool is_single;                 /* store fields in single precision; ids are always 64-bit */
    const mor_snapshot_fact *facts; /* shape [n_facts]; the provenance */
    int n_facts;
} mor_snapshot_options;

/** Writes the snapshots of one run. Owner: the caller, who ends it with mor_snapshot_writer_clear. */
typedef struct mor_snapshot_writer {
    char folder[MOR_PATH_BYTES]; /* the run's folder */
    mor_snapshot_options options;
    const char *note;       /* zero-terminated; of the snapshots added from now on; borrowed; NULL: none */
    mor_snapshot_list list; /* the snapshots on the disk */
} mor_snapshot_writer;

/** Makes a writer ready. Snapshots later than last_step are deleted, earlier ones stay and belong to the series.
 *  @param writer    [out]     storage supplied by the caller; empty on failure
 *  @param folder    [in]      zero-terminated path of the run's folder, which must exist; copied
 *  @param options   [in]      copied, what it points to is borrowed
 *  @param last_step [in]      step of the state the run goes on from; -1 for a new run, which deletes all
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. A damaged snapshot is left where it is, left out of the series
 *           and logged as a warning.
 *  Cost: opens every snapshot that stays; allocates. */
mor_status mor_snapshot_writer_init(mor_context *context, mor_snapshot_writer *writer, const char *folder,
                                    const mor_snapshot_options *options, int64_t last_step);

/** Adds a snapshot: the ids and all fields with MOR_FIELD_OUTPUT of the sets, in current particle order. On return it
 *  is on the disk and in both index files.
 *  @param sets    [in]      shape [n_sets]; names unique
 *  @param n_sets  [in]      number of sets
 *  @param step    [in]      number of the step, above that of the last snapshot
 *  @param time    [in]      simulated time, s, finite
 *  Returns: MOR_OK; MOR_ERROR_IO, the earlier snapshots are intact; MOR_ERROR_ARGUMENT for a step out of order or a
 *           name that cannot be used; MOR_ERROR_MEMORY.
 *  Cost: writes and reads the fields once; allocates. */
mor_status mor_snapshot_writer_add(mor_context *context, mor_snapshot_writer *writer, mor_set *const *sets, int n_sets,
                                   int64_t step, double time);

/** Frees what the writer owns; accepts a zeroed writer. The files are finished already. */
void mor_snapshot_writer_clear(mor_context *context, mor_snapshot_writer *writer);

/** Lists the snapshots of a run's folder with their sets and fields. Damaged ones are left out and logged as warnings.
 *  @param list    [out]     storage supplied by the caller; empty on failure
 *  @param folder  [in]      zero-terminated path of the run's folder
 *  Returns: MOR_OK, also when there are none; MOR_ERROR_IO; MOR_ERROR_MEMORY.
 *  Cost: opens every snapshot; allocates. */
mor_status mor_snapshot_list_init(mor_context *context, mor_snapshot_list *list, const char *folder);

/** Frees a list; accepts a zeroed one. */
void mor_snapshot_list_clear(mor_context *context, mor_snapshot_list *list);

/** Opens one snapshot for reading after checking every byte of it.
 *  @param snapshot [out]     storage supplied by the caller; empty on failure
 *  @param folder   [in]      zero-terminated path of the run's folder
 *  @param step     [in]      step of the snapshot
 *  Returns: MOR_OK; MOR_ERROR_IO when it is missing or damaged; MOR_ERROR_UNSUPPORTED for another version of the
 *           layout; MOR_ERROR_MEMORY.
 *  Cost: reads the file once; allocates. */
mor_status mor_snapshot_open(mor_context *context, mor_snapshot *snapshot, const char *folder, int64_t step);

/** Closes a snapshot; accepts a zeroed or closed one. */
void mor_snapshot_close(mor_context *context, mor_snapshot *snapshot);

/** Returns a set of a snapshot by name, or NULL.
 *  @param name     [in]  zero-terminated
 *  Returns: a view into the snapshot, valid until it is closed. */
const mor_snapshot_set *mor_snapshot_find_set(const mor_snapshot *snapshot, const char *name);

/** Returns a field of a set of a snapshot by name, or NULL.
 *  @param name [in]  zero-terminated
 *  Returns: a view into the snapshot, valid until it is closed. */
const mor_snapshot_field *mor_snapshot_find_field(const mor_snapshot_set *set, const char *name);

/** Reads one field.
 *  @param snapshot [in]      open
 *  @param set      [in]      a set of this snapshot
 *  @param field    [in]      a field of that set
 *  @param values   [out]     shape [n_particles, n_components] of the set and the field; unit: field->unit
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_snapshot_read_field(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                                   const mor_snapshot_field *field, double *values);

/** Reads the particle numbers of a set.
 *  @param snapshot [in]      open
 *  @param set      [in]      a set of this snapshot
 *  @param ids      [out]     shape [n_particles]
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_snapshot_read_ids(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                                 int64_t *ids);

#endif
