/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Particles that are held in a gap for fewer of them, between solids: some are moved to where there is more room. */
#include "core/base/random.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

enum { PLACES = 64, TRIES_MOST = 100 * PLACES, PLACE_PURPOSE = 0x524C5450 };

/* Least distance of a new place from faces and solids, spacings: no gap again. */
#define AWAY 1.0

static double nearest_distance(const double *x, int64_t n, int64_t except, const double *place)
{
    double nearest2 = INFINITY;
    for (int64_t j = 0; j < n; ++j) {
        const double separation[3] = {place[0] - x[j], place[1] - x[n + j], place[2] - x[2 * n + j]};
        nearest2 = j == except ? nearest2 : fmin(nearest2, mor_vector_dot(separation, separation));
    }
    return sqrt(nearest2);
}

static int part_of(const mor_relax_frame *frame, int64_t i)
{
    int part = 0;
    for (int64_t end = frame->around->counts[0]; i >= end && part + 1 < mor_relax_frame_parts(frame);
         end += frame->around->counts[part]) {
        ++part;
    }
    return part;
}

bool mor_relax_frame_make_room(const mor_relax_frame *frame, uint64_t round, int64_t i, double *x, int64_t n)
{
    const int part = part_of(frame, i);
    double widest = 0.0;
    double best[3];
    int n_found = 0;
    for (uint64_t k = 0; n_found < PLACES && k < TRIES_MOST; ++k) {
        double place[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < frame->dimension; ++a) {
            const double number = mor_random_uniform(round, (uint64_t)i * TRIES_MOST + k, PLACE_PURPOSE + (uint64_t)a);
            place[a] = (2.0 * number - 1.0) * frame->half[a];
        }
        if (!(mor_relax_frame_part_depth(frame, part, place) > AWAY) ||
            mor_relax_frame_clearance(frame, place, AWAY) < AWAY) {
            continue;
        }
        const double room = nearest_distance(x, n, i, place);
        ++n_found;
        if (room > widest) {
            widest = room;
            memcpy(best, place, sizeof best);
        }
    }
    for (int a = 0; a < 3 && widest > 0.0; ++a) {
        x[a * n + i] = best[a];
    }
    return widest > 0.0;
}
