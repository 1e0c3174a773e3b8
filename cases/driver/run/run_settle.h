/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_SETTLE_H
#define MOR_CASES_DRIVER_RUN_RUN_SETTLE_H

#include "cases/driver/run/run_files.h"

/** @file
 *  The settling of a run's initial stress, and what is written where the soil does not come to rest. */

/** Settles as mor_simulation_settle. Soil that does not come to rest is kept as a snapshot in the folder `settling` of
 *  the run and drawn by its speed and its plastic strain, images/settling-velocity.png and
 *  images/settling-plastic-strain.png.
 *  @param files   [in,out]  open
 *  Returns: as mor_simulation_settle; the message then tells of the pictures. */
mor_status mor_run_settle(mor_context *context, mor_run_files *files);

#endif
