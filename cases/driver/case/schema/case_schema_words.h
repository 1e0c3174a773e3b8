/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SCHEMA_CASE_SCHEMA_WORDS_H
#define MOR_CASES_DRIVER_CASE_SCHEMA_CASE_SCHEMA_WORDS_H

/** @file
 *  Short words for the tables of keys, so that a key fits on a line. Only for the files that hold tables. Entries
 *  follow mor_schema: key, kind, components, unit, required, default, range, choices, text. */

#define ANY -INFINITY, INFINITY, 0, 0, MOR_ROLE_NONE
#define POSITIVE ABOVE(0.0, INFINITY)
#define NOT_NEGATIVE BETWEEN(0.0, INFINITY)
#define BETWEEN(least, largest) (least), (largest), 0, 0, MOR_ROLE_NONE
#define ABOVE(least, largest) (least), (largest), 1, 0, MOR_ROLE_NONE
#define BELOW(least, largest) (least), (largest), 0, 1, MOR_ROLE_NONE
#define INSIDE(least, largest) (least), (largest), 1, 1, MOR_ROLE_NONE
#define REQUIRED 1, 0.0
#define DEFAULT(value) 0, (value)
#define SCALAR MOR_SCHEMA_REAL, 1
#define VECTOR MOR_SCHEMA_VECTOR, 3
#define WHOLE MOR_SCHEMA_INTEGER, 1
#define SWITCH MOR_SCHEMA_BOOLEAN, 1
#define WORDS MOR_SCHEMA_TEXT, 1
#define CHOICE MOR_SCHEMA_CHOICE, 1
#define SHAPE(member) MOR_CASE_STORE_REALS, AT(mor_case_shape, member)
#define AT(record, member) .offset = offsetof(record, member), .size = sizeof(((record *)0)->member)
#define END                                                                                                            \
    {                                                                                                                  \
        .schema = {.key = NULL }                                                                                       \
    }

#endif
