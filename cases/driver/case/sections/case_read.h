/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SECTIONS_CASE_READ_H
#define MOR_CASES_DRIVER_CASE_SECTIONS_CASE_READ_H

#include "cases/driver/case/case.h"
#include "core/base/units.h"
#include "core/material/registry.h"

#include <stdio.h>

/** @file
 *  From a case file to struct mor_case. The keys of a case file are listed in case_schema.c; whether the particles fit
 *  into memory is checked by the builder. */

/** The text of a case that is in no file. */
typedef struct mor_case_text {
    const char *name;             /* zero-terminated; the name of the file in messages */
    const char *text;             /* shape [n_bytes]; need not be zero-terminated */
    int64_t n_bytes;              /* length of text */
    const char *const *settings;  /* shape [n_settings] of zero-terminated "key=value"; NULL when there are none */
    int n_settings;               /* number of settings */
    const mor_registry *registry; /* the material models */
    mor_case_probe_catalog probe_types; /* the types of probes; NULL: none */
    const mor_units *units;             /* NULL: loaded for this call */
} mor_case_text;

/** Reads a case file, applies settings of the command line over it, checks everything that depends on the case alone,
 *  fills in the defaults, applies the scale, and builds the shapes.
 *  @param path       [in]      zero-terminated
 *  @param settings   [in]      shape [n_settings] of zero-terminated "key=value"; NULL when there are none
 *  @param n_settings [in]      number of settings, >= 0
 *  @param registry   [in]      the material models
 *  @param probe_types [in]     the types of probes; NULL: none
 *  @param out_case   [out]     clear it with mor_case_clear; cleared after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "file:line: found ...; allowed ...; do ..."; MOR_ERROR_IO when the
 *  unit tables are missing; MOR_ERROR_MEMORY.
 *  Cost: some milliseconds; allocates. Threads: neither. */
mor_status mor_case_read(mor_context *context, const char *path, const char *const *settings, int n_settings,
                         const mor_registry *registry, mor_case_probe_catalog probe_types, mor_case *out_case);

/** As mor_case_read, from memory.
 *  @param out_case [out]     clear it with mor_case_clear; cleared after a failure
 *  Returns: as mor_case_read. */
mor_status mor_case_read_text(mor_context *context, const mor_case_text *text, mor_case *out_case);

#endif
