/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SCHEME_SCHEME_H
#define MOR_CORE_SCHEME_SCHEME_H

#include <stdbool.h>

/** @file
 *  What the user may choose about the numerical scheme, of soil and of bodies. Each setting is one row of
 *  core/scheme/scheme.def and one member here, with the same name; a case reads them into this record, and whoever
 *  carries out the scheme gets the whole of it. */

/** The schemes, in the order of the words of the setting `scheme`. */
typedef enum mor_scheme_kind { MOR_SCHEME_MORAINE, MOR_SCHEME_ZHANG2024 } mor_scheme_kind;

/** Least stress_diffusion with a fitted velocity gradient, 1: an elastic cube gained energy with 0.01 and lost it with
 *  0.1, blocks in plane strain with 0.02 (docs/theory/soil.md). */
#define MOR_SCHEME_LEAST_DIFFUSION 0.03

/** All settings. Plain data in SI; meaning, unit, range and default of each: its row in scheme.def. A choice is the
 *  index of its word. */
typedef struct mor_scheme {
#define MOR_SETTING(type, storage, key, kind, unit, fallback, paper, words, needs, computed, unit_plane, text, ...)    \
    type key;
#include "core/scheme/scheme.def"
#undef MOR_SETTING
} mor_scheme;

#endif
