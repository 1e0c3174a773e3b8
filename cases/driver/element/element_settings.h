/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_SETTINGS_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_SETTINGS_H

#include "cases/driver/element/element_names.h"
#include "core/material/element/element_path.h"

#include <stdio.h>

/** @file
 *  What an element test is told, as "key=value" with units as in a case: "test." settings of the test, "state." values
 *  that the state starts from, and, without a prefix, "density" and the parameters of the law. */

enum { MOR_ELEMENT_SPECIMENS_MAX = 16, MOR_ELEMENT_NAME_BYTES = 64, MOR_ELEMENT_TEXT_BYTES = 1024 };

/** The words of an element test that are read before its law is known. */
typedef struct mor_element_words {
    const char *path;      /* "test.path"; NULL: not given */
    const char *case_file; /* "test.case"; likewise */
    const char *soil;      /* "test.soil"; likewise */
    const char *data;      /* "test.data"; likewise */
    const char *replay;    /* "test.replay"; likewise */
} mor_element_words;

/** An element test. */
typedef struct mor_element_settings {
    const mor_element_names *names;           /* of keys in messages; borrowed; NULL: the keys themselves */
    const mor_element_path *path;             /* NULL: control is given */
    mor_element_control control;              /* of a test without a path, at the rate of the test */
    char name[MOR_ELEMENT_NAME_BYTES];        /* of the path, for people */
    double stress[MOR_ELEMENT_SPECIMENS_MAX]; /* shape [n_specimens]; along the axis at the start, positive in
                                                  compression, Pa */
    int n_specimens;                          /* 1 to MOR_ELEMENT_SPECIMENS_MAX */
    double k0;                                /* lateral over axial stress at the start, 1 */
    double strain;                            /* of the measure of the path, > 0, 1 or rad */
    double rate;                              /* of the measure, 1/s */
    double b;                                 /* of a path that has_b, 1 */
    double void_ratio;                        /* at the start, 1; NaN: not known */
    double tolerance;                         /* of the stress, relative, 1 */
    double amplitude;                         /* of the stress of a cyclic path, Pa; NaN: the strain is the amplitude */
    int n_steps;                              /* for the strain, once */
    int n_cycles;                             /* of a cyclic path */
    double density;                           /* at the start, kg/m3 */
    double parameters[MOR_ELEMENT_STATE_MAX]; /* shape [n_values]; units of the law's schema */
    double state[MOR_ELEMENT_STATE_MAX];      /* shape [n_values]; units of the law's schema; NaN: as the law has it */
} mor_element_settings;

/** Finds the words in a list of settings; the last one of a key counts.
 *  @param list  [in]   shape [n] of zero-terminated "key=value"
 *  @param n     [in]   number of settings
 *  @param words [out]  borrowed from the list */
void mor_element_words_find(const char *const *list, int n, mor_element_words *words);

/** Reads the settings of a test.
 *  @param material [in]      the law
 *  @param list     [in]      shape [n] of zero-terminated "key=value"
 *  @param n        [in]      number of settings
 *  @param settings [in,out]  names, and density and parameters as they are without settings (NaN: there is none); the
 *                            rest is filled in
 *  Returns: MOR_OK; MOR_ERROR_CONFIG saying what was found, what is allowed and what to do; MOR_ERROR_IO when the
 *  tables of units are missing; MOR_ERROR_MEMORY. */
mor_status mor_element_settings_read(mor_context *context, const mor_material *material, const char *const *list, int n,
                                     mor_element_settings *settings);

/** Writes the keys of a test with units, ranges and defaults, and the paths, a line each.
 *  @param out [in,out]  an open file */
void mor_element_settings_print(FILE *out);

#endif
