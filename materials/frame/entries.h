/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_ENTRIES_H
#define MOR_MATERIALS_FRAME_ENTRIES_H

#include "core/material/kit/material.h"

#include <math.h>

/** @file
 *  Schema entries that several laws have: written once, so that none lacks the role by which others find it. */

/** Members of an entry that is one real number: key; unit; least and most, both allowed; words: what it is. */
#define MOR_REAL_ENTRY(name, dimension, least, most, words)                                                            \
    .key = (name), .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = (dimension), .minimum = (least),                \
    .maximum = (most), .text = (words)

/** The same of a number above zero. */
#define MOR_POSITIVE_ENTRY(name, dimension, most, words)                                                               \
    MOR_REAL_ENTRY(name, dimension, 0.0, most, words), .excludes_minimum = 1

/** State variable: accumulated plastic strain. */
#define MOR_PLASTIC_STRAIN_SCHEMA                                                                                      \
    {                                                                                                                  \
        .key = "plastic_strain", .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "1", .minimum = 0.0,              \
        .maximum = INFINITY, .text = "accumulated deviatoric plastic strain, sum of sqrt(2/3 de:de)"                   \
    }

/** Parameter: density below which there is no stress, over another one; fallback: its default, 1; words: what it is. */
#define MOR_GAS_DENSITY_RATIO_SCHEMA(fallback, words)                                                                  \
    {                                                                                                                  \
        .key = "gas_density_ratio", .role = MOR_ROLE_GAS_DENSITY_RATIO, .kind = MOR_SCHEMA_REAL, .n_components = 1,    \
        .unit = "1", .default_value = (fallback), .minimum = 0.0, .maximum = 1.0, .text = (words)                      \
    }

#endif
