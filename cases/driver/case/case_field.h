/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_CASE_FIELD_H
#define MOR_CASES_DRIVER_CASE_CASE_FIELD_H

#include "core/base/schema.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  Parameters of a soil that vary in space, as the case describes them, and the reduction of strength that a search for
 *  a factor of safety asks of them. Part of cases/driver/case/case.h. */

enum { MOR_CASE_FIELDS_MAX = 8, MOR_CASE_FIELD_NAME_BYTES = 64, MOR_CASE_FIELD_TEXT_BYTES = 256 };

/** How a parameter is distributed at a place. */
typedef enum mor_case_distribution {
    MOR_CASE_DISTRIBUTION_NONE, /* it has its mean */
    MOR_CASE_DISTRIBUTION_NORMAL,
    MOR_CASE_DISTRIBUTION_LOGNORMAL
} mor_case_distribution;

/** A parameter that varies in space. Values have the unit of the parameter. */
typedef struct mor_case_field {
    char parameter[MOR_CASE_FIELD_NAME_BYTES]; /* key of the law */
    int entry;                                 /* of the parameter in the law's schema */
    int line;                                  /* of the file of the soil, 1-based */
    char formula[MOR_CASE_FIELD_TEXT_BYTES];   /* its mean, in SI, of a place in m in the frame of the case, before the
                                                  scale; "": that of the material */
    double unit;                               /* what the scale of the case makes of one SI unit of it */
    mor_case_distribution distribution;
    double coefficient_of_variation; /* standard deviation over mean, 1; NaN: standard_deviation is given */
    double standard_deviation;       /* NaN: coefficient_of_variation is given */
    double minimum, maximum;         /* values beyond are set to them and counted; -INFINITY, INFINITY: none */
    int correlation;                 /* a mor_random_correlation */
    double correlation_length[3];    /* scale of fluctuation along x, y, z, m; INFINITY: no change along it */
    char correlated_with[MOR_CASE_FIELD_NAME_BYTES]; /* another parameter that varies; "": none */
    int other;                                       /* its place in the list; -1: none */
    double cross_correlation;                        /* of both normal variables, 1 */
    uint64_t seed;
    bool is_taken; /* particles bring their values from the run that the case starts from, where it varied, too */
    uint64_t written;
} mor_case_field;

struct mor_case;

/** Reduction of the strength of all soils of a case. Their parameters are reduced already, fields are when they are
 *  made. Zeroed: none. */
typedef struct mor_case_reduction {
    /** Reduces a set of parameters, in the order of a schema, by a factor. */
    void (*reduce)(const mor_schema *schema, const double *parameters, double factor, double *reduced);
    double factor;                  /* > 0, 1 */
    const struct mor_case *nominal; /* the case without reduction; borrowed */
} mor_case_reduction;

#endif
