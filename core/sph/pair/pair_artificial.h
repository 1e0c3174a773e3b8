/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_ARTIFICIAL_H
#define MOR_CORE_SPH_PAIR_PAIR_ARTIFICIAL_H

#include "core/sph/pair/pair_momentum.h"

#include <stdbool.h>

/** @file
 *  The artificial stress in the momentum loop. For pair_momentum_isa.c only. */

/** Adds f^n (R_i + R_j) r, eq. 27 of Zhang et al. (2024), of a pair under tension.
 *  own: shape [6], other: shape [6, TARGETS], unit Pa */
INLINE void add_artificial(momentum_sums *m, const pair *p, const mor_pair_constants *c, vec k, const vec *own,
                           const real *other, const int dimension)
{
    vec s[6];
    for (int a = 0; a < 6; ++a) {
        s[a] = own[a] + of_target(other, a);
    }
    const vec power = artificial_factor(p->reach, s[MOR_XX] + s[MOR_YY] + s[MOR_ZZ], c);
    for (int a = 0; a < 6; ++a) {
        s[a] *= power;
    }
    m->force[0] += k * dot_r(p, s[MOR_XX], s[MOR_XY], s[MOR_ZX], dimension);
    m->force[1] += k * dot_r(p, s[MOR_XY], s[MOR_YY], s[MOR_YZ], dimension);
    if (dimension == 3) {
        m->force[2] += k * dot_r(p, s[MOR_ZX], s[MOR_YZ], s[MOR_ZZ], dimension);
    }
}

/** Adds the artificial stress of one turn of a chunk to the sums of the particles from first on. The power is
 *  expensive, and few pairs are under tension: an artificial stress has no tension of its own, so that those of two
 *  particles do not cancel. */
INLINE void add_artificial_chunk(momentum_part *part, const geometries *chunk, const momentum_rows *rows, int turn,
                                 const mor_pair_constants *c, const int dimension)
{
    const mor_pair_arrays *arrays = rows->arrays;
    vec own[6];
    vec size = broadcast(0.0);
    for (int a = 0; a < 6; ++a) {
        own[a] = load(READ(artificial_stress) + part->first * 6, 6, a);
        size -= magnitude(own[a]);
    }
    const bool has_own = any_less(size, 0.0);
    for (int q = turn; q < rows_of(&rows->targets); q += TURNS) {
        real other[6 * TARGETS];
        bool has_tension = has_own;
        for (int t = 0; t < TARGETS; ++t) {
            const int32_t j = t == 0 ? first_of_row(&rows->targets, q) : last_of_row(&rows->targets, q);
            const real *of_one = READ(artificial_stress) + (int64_t)j * 6;
            has_tension |= of_one[MOR_XX] != 0.0 || of_one[MOR_YY] != 0.0 || of_one[MOR_ZZ] != 0.0;
            for (int a = 0; a < 6; ++a) {
                other[a * TARGETS + t] = of_one[a];
            }
        }
        if (has_tension) {
            const geometry g = geometry_at(chunk, q, 0);
            pair p;
            separation_at(p.r, chunk, q, &part->frame, record_row(&rows->targets, q), dimension);
            p.reach = positive_part(1.0 - g.distance * part->frame.half_inverse_h);
            add_artificial(&part->sums, &p, c, g.k, own, other, dimension);
        }
    }
}

/* Out of the many copies of the momentum loop, which would all hold them. */
typedef void (*adder)(momentum_part *part, const geometries *chunk, const momentum_rows *rows, int turn,
                      const mor_pair_constants *c);
#define MOR_ARTIFICIAL_FUNCTION(name, dimension)                                                                       \
    OPAQUE void name(momentum_part *part, const geometries *chunk, const momentum_rows *rows, int turn,                \
                     const mor_pair_constants *c)                                                                      \
    {                                                                                                                  \
        add_artificial_chunk(part, chunk, rows, turn, c, (dimension));                                                 \
    }
MOR_ARTIFICIAL_FUNCTION(artificial_2d, 2)
MOR_ARTIFICIAL_FUNCTION(artificial_3d, 3)
static const adder artificial_adders[2] = {artificial_2d, artificial_3d};

#endif
