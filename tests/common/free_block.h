/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FREE_BLOCK_H
#define MOR_TESTS_COMMON_FREE_BLOCK_H

#include "tests/common/scene.h"

/** @file
 *  A free square block, 0.3 m wide, of one hypoelastic soil or of two, one over the other, in plane strain without
 *  gravity. */

enum { FREE_BLOCK_TEXT_BYTES = 4096 };

/** A layer of the block between two heights in m, with density in kg/m3 and Young's modulus; all of them texts. */
#define FREE_BLOCK_LAYER(name, low, high, density, modulus)                                                            \
    "{ name = '" name "'; shape = { type = 'box'; min = (0, " low "); max = (0.3, " high "); };"                       \
    "  material = { model = 'hypoelastic'; density = " density "; youngs_modulus = '" modulus                          \
    "'; poissons_ratio = 0.3; }; }"

/** Makes the block of layers, with settings of numerics; both zero-terminated. The caller frees the scene. */
static inline scene *free_block_new(const char *layers, const char *numerics)
{
    static const char block[] =
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0);"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; soil = ( %s ); output = { pictures = false; };"
        "numerics = { %s };";
    char text[FREE_BLOCK_TEXT_BYTES];
    snprintf(text, sizeof text, block, layers, numerics);
    const scene_request request = {.text = text};
    return scene_new(&request);
}

/** Data of a field of the soil, shape [n_particles, components of the field]; unit: that of the field. */
static inline double *free_block_field(scene *it, mor_field_id id)
{
    return it->simulation.soil.set.data[id];
}

#endif
