/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/formula/random_field.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"

#include <math.h>

/* Random numbers of a wave: two uniform ones to a normal one, of which a wave has up to four, and the phase. */
enum { NORMALS = 4, UNIFORMS = 2 * NORMALS + 1 };

/* Of a normal number, so that no wave is infinitely short: one in 1e12 is below it. */
static const double smallest = 1.0e-12;

struct mor_random_field {
    double waves[MOR_RANDOM_FIELD_WAVES][4]; /* wave vector, 1/length; phase, rad */
};

/* A standard normal number from two uniform ones (Box and Muller 1958), of which the first is not zero. */
static double find_normal(uint64_t seed, uint64_t id, uint64_t purpose)
{
    const double first = 1.0 - mor_random_uniform(seed, id, purpose);
    const double second = mor_random_uniform(seed, id + 1, purpose);
    return sqrt(-2.0 * log(first)) * cos(2.0 * MOR_PI * second);
}

/* The wave vector has the density that the spectrum of the correlation is, [RF3]: of exp(-pi r^2) a normal one of
 * deviation sqrt(2 pi), of exp(-2 r) that of Cauchy in as many dimensions, twice normal numbers over another one. */
static void set_wave(mor_random_field *field, int which, mor_random_correlation correlation, const double *lengths,
                     uint64_t seed, uint64_t purpose)
{
    const uint64_t id = (uint64_t)which * UNIFORMS;
    double scale = sqrt(2.0 * MOR_PI);
    if (correlation == MOR_RANDOM_EXPONENTIAL) {
        scale = 2.0 / fmax(fabs(find_normal(seed, id + 6, purpose)), smallest);
    }
    for (int a = 0; a < 3; ++a) {
        field->waves[which][a] = scale * find_normal(seed, id + 2 * (uint64_t)a, purpose) / lengths[a];
    }
    field->waves[which][3] = 2.0 * MOR_PI * mor_random_uniform(seed, id + 8, purpose);
}

/* [RF6]: a wave that has a whole number of lengths in each period. */
static void fit_wave(double *wave, const double *periods)
{
    for (int a = 0; a < 3; ++a) {
        if (periods[a] > 0.0) {
            const double unit = 2.0 * MOR_PI / periods[a];
            wave[a] = unit * rint(wave[a] / unit);
        }
    }
}

mor_status mor_random_field_new(mor_context *context, mor_random_correlation correlation, const double *lengths,
                                const double *periods, uint64_t seed, uint64_t purpose, mor_random_field **field)
{
    *field = NULL;
    MOR_TRY(context, MOR_NEW(context, field, 1, "random field"));
    for (int k = 0; k < MOR_RANDOM_FIELD_WAVES; ++k) {
        set_wave(*field, k, correlation, lengths, seed, purpose);
        if (periods != NULL) {
            fit_wave((*field)->waves[k], periods);
        }
    }
    return MOR_OK;
}

void mor_random_field_free(mor_context *context, mor_random_field **field)
{
    MOR_FREE(context, field);
}

double mor_random_field_value(const mor_random_field *field, const double *place)
{
    double sum = 0.0;
    for (int k = 0; k < MOR_RANDOM_FIELD_WAVES; ++k) {
        const double *wave = field->waves[k];
        sum += cos(wave[0] * place[0] + wave[1] * place[1] + wave[2] * place[2] + wave[3]);
    }
    return sqrt(2.0 / MOR_RANDOM_FIELD_WAVES) * sum;
}

double mor_random_correlation_at(mor_random_correlation correlation, const double *lengths, const double *lag)
{
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
        square += lag[a] / lengths[a] * (lag[a] / lengths[a]);
    }
    return correlation == MOR_RANDOM_EXPONENTIAL ? exp(-2.0 * sqrt(square)) : exp(-MOR_PI * square);
}
