/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"

#include <math.h>

/* Parameters of a soil that vary in space. */

#define FIELD(member) AT(mor_case_field, member)

static const mor_case_key field_keys[] = {
    {{"parameter", WORDS, "1", REQUIRED, ANY, NULL,
      "key of the law's parameter that varies: a friction angle, a cohesion or undrained strength, a dilation angle, a "
      "limit of tension, an elastic modulus"},
     MOR_CASE_STORE_NAME,
     FIELD(parameter)},
    {{"formula", WORDS, "1", DEFAULT(NAN), ANY, NULL,
      "its value, or mean where it is random, as a formula of x, y, z (m) in the frame of the case, in the SI unit of "
      "the parameter (angles in rad)"},
     MOR_CASE_STORE_TEXT,
     FIELD(formula),
     .computed = "the value in material"},
    {{"distribution", CHOICE, "1", DEFAULT(0.0), ANY, "none|normal|lognormal",
      "of a random field at a place; none: the formula alone"},
     MOR_CASE_STORE_CHOICE,
     FIELD(distribution)},
    {{"coefficient_of_variation", SCALAR, "1", DEFAULT(NAN), NOT_NEGATIVE, NULL,
      "standard deviation over mean; this or standard_deviation is required with a distribution"},
     MOR_CASE_STORE_REALS,
     FIELD(coefficient_of_variation),
     .computed = "follows from standard_deviation"},
    {{"correlation", CHOICE, "1", DEFAULT(0.0), ANY, "exponential|squared_exponential",
      "fall of the correlation with the distance r in correlation lengths; exponential: exp(-2 r), rough; "
      "squared_exponential: exp(-pi r^2), smooth"},
     MOR_CASE_STORE_CHOICE,
     FIELD(correlation)},
    {{"correlation_length", VECTOR, "m", DEFAULT(NAN), POSITIVE, NULL,
      "scale of fluctuation along x, y and z, in plane strain x and y; required with a distribution, but for a field "
      "that is correlated_with another"},
     MOR_CASE_STORE_REALS,
     FIELD(correlation_length),
     .computed = "that of the other field"},
    {{"correlated_with", WORDS, "1", DEFAULT(NAN), ANY, NULL,
      "parameter of an earlier entry of the list, whose correlation, length and seed this one shares"},
     MOR_CASE_STORE_NAME,
     FIELD(correlated_with),
     .computed = "none"},
    {{"cross_correlation", SCALAR, "1", DEFAULT(0.0), BETWEEN(-1.0, 1.0), NULL,
      "with that parameter at a place, between the underlying normal variables; required with correlated_with"},
     MOR_CASE_STORE_REALS,
     FIELD(cross_correlation)},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL,
      "seed of the random field; soils with the same seed share one field, which goes on across their border"},
     MOR_CASE_STORE_SEED,
     FIELD(seed)},
    END};

static const mor_case_part field_parts[] = {
    {"standard_deviation", false, "number with the unit of the parameter", "in place of coefficient_of_variation"},
    {"minimum", false, "number with the unit of the parameter",
     "smaller values are set to it, counted and reported; default: least value that the law allows"},
    {"maximum", false, "number with the unit of the parameter", "likewise larger values"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_field_group = {"fields", "A parameter of a soil that varies in space (list)", field_keys,
                                             field_parts, offsetof(mor_case_field, written)};
