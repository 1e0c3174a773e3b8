/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_CHECKPOINT_H
#define MOR_CORE_IO_CHECKPOINT_H

#include "core/io/hdf5_file.h"
#include "core/particle/state.h"

/** @file
 *  The complete state of a run in one sealed file, restored bit for bit. It decides neither when to save nor what
 *  belongs to the state: that is what the list names, core/particle/state.h.
 *
 *  Files of a run's folder: checkpoint.h5 is the newest, checkpoint.previous.h5 the one before. A new one is written to
 *  checkpoint.h5.tmp, sealed and synced; then the newest, if it is intact, is kept as the previous one, and one rename
 *  makes the new one valid. A process killed at any moment leaves at least one intact checkpoint once there was one.
 *
 *  Layout (version 3): /sets/<set> with attribute n_particles and arrays id [n] and <field> [n, components], in current
 *  particle order, each field with attributes unit and text; /values/<owner>.<member> [rows, columns]. */

#define MOR_CHECKPOINT_FILE "checkpoint.h5"
#define MOR_CHECKPOINT_PREVIOUS_FILE "checkpoint.previous.h5"
#define MOR_CHECKPOINT_WHAT "checkpoint" /* what its seal says it holds */

enum { MOR_CHECKPOINT_VERSION = 4 };

/** What is saved and restored; everything in it is borrowed. */
typedef struct mor_checkpoint {
    const mor_state_list *state;
    const char *identity; /* zero-terminated; what the state belongs to, such as the case; NULL: none */
} mor_checkpoint;

/** Saves the state as checkpoint.h5 of a folder and keeps the one before.
 *  @param context [in,out]  a damaged checkpoint.h5 that is not kept is logged as a warning
 *  @param folder  [in]      zero-terminated path of an existing folder
 *  @param state   [in]      unchanged
 *  Returns: MOR_OK; MOR_ERROR_IO, then an intact checkpoint.h5 is still in the folder if there was one;
 *           MOR_ERROR_ARGUMENT for a name that cannot be used; MOR_ERROR_MEMORY.
 *  Cost: writes and reads the state once; allocates. */
mor_status mor_checkpoint_write(mor_context *context, const char *folder, const mor_checkpoint *state);

/** Restores the state from one file, bit for bit. The sets and arrays must be those that were saved: same names,
 *  numbers of particles at creation, fields, components, units, kinds and lengths. A set gets the number of particles
 *  that were left when it was saved. Everything is checked before anything changes. The identity is not looked at.
 *  @param path    [in]      zero-terminated path of the file
 *  @param state   [in]      the arrays it points to are overwritten
 *  Gives: set->generation + 1 for each set, since particles may stand in another order.
 *  Returns: MOR_OK; MOR_ERROR_IO when the file is missing or damaged; MOR_ERROR_UNSUPPORTED when it is of another
 *           version; MOR_ERROR_CONFIG when it holds the state of another case; MOR_ERROR_MEMORY.
 *  Cost: reads the file twice; allocates. */
mor_status mor_checkpoint_read(mor_context *context, const char *path, const mor_checkpoint *state);

/** Reads the identity that the newest intact checkpoint of a folder was saved with, so that a state can be refused
 *  before anything is made for it.
 *  @param folder   [in]      zero-terminated path of the folder
 *  @param identity [out]     the address of one pointer; zero-terminated text; owned by the caller, who frees it with
 *                            MOR_FREE; "" when it was saved without one
 *  Returns: as mor_checkpoint_read_latest.
 *  Cost: reads the file twice; allocates. */
mor_status mor_checkpoint_read_identity(mor_context *context, const char *folder, char **identity);

/** Restores the newest intact state of a folder: checkpoint.h5, or checkpoint.previous.h5 when the former is missing or
 *  damaged, which is logged as a warning.
 *  @param folder  [in]      zero-terminated path of the folder
 *  @param state   [in]      the arrays it points to are overwritten
 *  Gives: as mor_checkpoint_read.
 *  Returns: MOR_OK; MOR_ERROR_IO naming both files when neither can be used; otherwise as mor_checkpoint_read. */
mor_status mor_checkpoint_read_latest(mor_context *context, const char *folder, const mor_checkpoint *state);

#endif
