/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FREE_BLOCK_H
#define MOR_TESTS_COMMON_FREE_BLOCK_H

#include "core/base/random.h"
#include "tests/common/scene.h"

#include <stdarg.h>

/** @file
 *  A free square block, 0.3 m wide, of one hypoelastic soil or of two, one over the other, in plane strain without
 *  gravity. */

enum { FREE_BLOCK_TEXT_BYTES = 4096 };

/** A layer of the block between two heights in m, with density in kg/m3 and Young's modulus; all of them texts. */
#define FREE_BLOCK_LAYER(name, low, high, density, modulus)                                                            \
    "{ name = '" name "'; shape = { type = 'box'; min = (0, " low "); max = (0.3, " high "); };"                       \
    "  material = { model = 'hypoelastic'; density = " density "; youngs_modulus = '" modulus                          \
    "'; poissons_ratio = 0.3; }; }"

/** Makes the scene of a case that is printed as by printf. The caller frees it. */
__attribute__((format(printf, 1, 2))) static inline scene *free_block_print(const char *format, ...)
{
    char text[FREE_BLOCK_TEXT_BYTES];
    va_list arguments;
    va_start(arguments, format);
    assert_true(vsnprintf(text, sizeof text, format, arguments) < FREE_BLOCK_TEXT_BYTES);
    va_end(arguments);
    return scene_new(&(scene_request){.text = text});
}

/** Makes the block of layers, with settings of numerics; both zero-terminated. The caller frees the scene. */
static inline scene *free_block_new(const char *layers, const char *numerics)
{
    return free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0);"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; soil = ( %s ); output = { pictures = false; };"
        "numerics = { scheme = 'zhang2024'; %s };",
        layers, numerics);
}

/** Number of particles of the soil, 1. */
static inline int64_t free_block_count(const scene *it)
{
    return it->simulation.soil.set.n_particles;
}

/** Data of a field of the soil, shape [n_particles, components of the field]; unit: that of the field. */
static inline double *free_block_field(scene *it, mor_field_id id)
{
    return it->simulation.soil.set.data[id];
}

/** Moves particles off the lattice by up to a tenth of the spacing, so that nothing cancels by symmetry. */
static inline void free_block_disorder(scene *it)
{
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        for (int a = 0; a < it->the_case.dimension; ++a) {
            free_block_field(it, MOR_FIELD_POSITION)[3 * k + a] +=
                2e-3 * (mor_random_uniform(7, (uint64_t)k, (uint64_t)a) - 0.5);
        }
    }
}

#endif
