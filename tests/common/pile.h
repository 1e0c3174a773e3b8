/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_PILE_H
#define MOR_TESTS_COMMON_PILE_H

#include "cases/driver/picture/view/picture.h"

/** @file
 *  A small block of particles and a picture of it, for tests of drawing only. */

enum { PILE = 14 * 14 * 6 };

/** What the leak sanitizer is to ignore: Fontconfig, behind Cairo, keeps what it knows of fonts until the process ends.
 *  Returns: zero-terminated rules of the sanitizer's run-time library, which asks for them by this name. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

/** A block of particles on a lattice; values, in Pa, grow with height. */
typedef struct pile {
    double position[3 * PILE]; /* shape [PILE,3], m */
    double value[PILE];        /* shape [PILE], Pa */
} pile;

/** Places the particles on a lattice of 0.02 m about the z axis. */
static inline void pile_fill(pile *p)
{
    const double pile_spacing = 0.02;
    for (int i = 0; i < PILE; ++i) {
        p->position[3 * i] = pile_spacing * (i % 14 - 6.5);
        p->position[3 * i + 1] = pile_spacing * (i / 14 % 14 - 6.5);
        p->position[3 * i + 2] = pile_spacing * (i / 196 + 0.5);
        p->value[i] = 1000.0 * p->position[3 * i + 2];
    }
}

/** The pile as one solid group colored by its values; borrows the pile. */
static inline mor_picture_group pile_group(const pile *p)
{
    return (mor_picture_group){
        .name = "soil", .position = p->position, .n_particles = PILE, .radius = 0.01, .value = p->value};
}

/** A small picture with all texts; borrows the groups, shape [n_groups]. */
static inline mor_picture pile_picture(const mor_picture_group *groups, int n_groups, int dimension)
{
    return (mor_picture){.dimension = dimension,
                         .groups = groups,
                         .n_groups = n_groups,
                         .gravity = {0.0, dimension == 2 ? -9.81 : 0.0, dimension == 2 ? 0.0 : -9.81},
                         .title = "A pile",
                         .time_text = "t = 0.10 s",
                         .value_name = "pressure",
                         .value_unit = "Pa",
                         .width = 180,
                         .height = 160};
}

#endif
