/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_CLASSES_H
#define MOR_CASES_DRIVER_MAP_MAP_CLASSES_H

#include "cases/driver/map/map_list.h"
#include "cases/driver/picture/draw/ticks.h"

/** @file
 *  Classes of the values of a map and their colors, the same in its picture and in its style for QGIS: from zero on in
 *  equal round steps, up to the first step that no value exceeds. */

enum { MOR_MAP_CLASSES_MAX = 16 };

/** The classes. Class k holds values up to limits[k + 1], the first one those from limits[0] on. */
typedef struct mor_map_classes {
    int n;                                  /* >= 1 */
    double step;                            /* unit of the map, [1] */
    double limits[MOR_MAP_CLASSES_MAX + 1]; /* shape [n + 1]; unit of the map, [1] */
    double colors[MOR_MAP_CLASSES_MAX][3];  /* shape [n, 3]; screen values, 1 */
} mor_map_classes;

/** Makes the classes.
 *  @param largest [in]   of the values, unit of the map, [1]; NaN: there are none */
void mor_map_classes_init(const mor_map_kind *kind, double largest, mor_map_classes *classes);

/** Returns the class of a value.
 *  @param value [in]  finite; unit of the map, [1] */
int mor_map_classes_find(const mor_map_classes *classes, double value);

/** Writes the values of a class, as "2 – 4"; of counts the whole numbers in it, as "3" or "3 – 4".
 *  @param k      [in]   the class
 *  @param factor [in]   that the values are shown times, 1
 *  @param text   [out]  shape [MOR_TICKS_LABEL_BYTES]; zero-terminated UTF-8 */
void mor_map_classes_label(const mor_map_kind *kind, const mor_map_classes *classes, int k, double factor, char *text);

#endif
