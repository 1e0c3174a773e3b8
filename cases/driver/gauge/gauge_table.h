/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_GAUGE_GAUGE_TABLE_H
#define MOR_CASES_DRIVER_GAUGE_GAUGE_TABLE_H

/** @file
 *  The files of gauges in the folder of a run, as those who write and those who draw them know them. */

#define MOR_GAUGE_TABLE_FILE "gauges.csv"
#define MOR_GAUGE_PEAKS_FILE "gauge_peaks.csv"

/** Columns of gauges.csv: the time, then these of each gauge. */
enum {
    MOR_GAUGE_COLUMN_NORMAL, /* mean since the row before, N (N/m), as those up to the moment */
    MOR_GAUGE_COLUMN_NORMAL_SOIL,
    MOR_GAUGE_COLUMN_NORMAL_BODIES,
    MOR_GAUGE_COLUMN_SHEAR,
    MOR_GAUGE_COLUMN_MOMENT,   /* N m (N) */
    MOR_GAUGE_COLUMN_HEIGHT,   /* of the means, m */
    MOR_GAUGE_COLUMN_FILTERED, /* normal force at the row, N (N/m) */
    MOR_GAUGE_COLUMN_LARGEST,  /* the largest of it since the row before, of every step, N (N/m) */
    MOR_GAUGE_COLUMNS
};

#endif
