/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_PICTURES_H
#define MOR_CASES_DRIVER_PICTURE_PICTURES_H

#include "cases/driver/case/case.h"
#include "core/particle/set.h"

#include <stdio.h>

/** @file
 *  Pictures of a run's folder: the snapshots as particles with walls, the series as charts. The set named "soil" is
 *  colored by the case's field; all other sets are bodies, in tones of stone, or colored where there is no soil. */

/** Which snapshots become pictures. */
typedef enum mor_pictures_choice {
    MOR_PICTURES_KEY, /* first, middle and last */
    MOR_PICTURES_ALL,
    MOR_PICTURES_FIRST, /* the first, and no charts */
    MOR_PICTURES_LAST   /* the last, and no charts */
} mor_pictures_choice;

/** Checks before a run that its pictures can be colored as the case says: by a field of the soil, or of some group of
 *  bodies where there is no soil.
 *  @param sets     [in]      shape [n_sets]; what goes into the snapshots: "soil" and the groups of bodies
 *  @param n_sets   [in]      number of sets
 *  Returns: MOR_OK; MOR_ERROR_CONFIG naming the color and what is allowed. */
mor_status mor_pictures_check(mor_context *context, const mor_case *the_case, mor_set *const *sets, int n_sets);

/** Draws images/<snapshot>_<color>.png for snapshots, all with the same camera, and images/energy.png and
 *  images/<probe unit>.png charts of the series.
 *  @param the_case [in]      the case of the run
 *  @param folder   [in]      zero-terminated; the run's folder
 *  @param choice   [in]      which snapshots
 *  @param output   [in,out]  one open stream; the path of each picture is printed to it
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a color that is not a field; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_pictures_render(mor_context *context, const mor_case *the_case, const char *folder,
                               mor_pictures_choice choice, FILE *output);

/** Draws the last snapshot of a folder with any color.
 *  @param the_case [in]      the case of the snapshots
 *  @param folder   [in]      zero-terminated; holds the snapshots
 *  @param color    [in]      zero-terminated; as output.color
 *  @param when     [in]      zero-terminated; precedes the time, as "settled for"
 *  @param path     [in]      zero-terminated; of the picture
 *  @param output   [in,out]  one open stream; the path is printed to it
 *  Returns: as mor_pictures_render. */
mor_status mor_pictures_draw_last(mor_context *context, const mor_case *the_case, const char *folder, const char *color,
                                  const char *when, const char *path, FILE *output);

#endif
