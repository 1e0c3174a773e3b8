/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_color.h"

#include "core/base/math.h"
#include "core/base/nearest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double length_of(const double *field, const double *up)
{
    (void)up;
    return mor_vector_length(field);
}

static double pressure_of(const double *field, const double *up)
{
    (void)up;
    return -mor_symmetric_trace(field) / 3.0;
}

static double vertical_of(const double *field, const double *up)
{
    double traction[3];
    mor_symmetric_apply(field, up, traction);
    return mor_vector_dot(traction, up);
}

/* Square root of three times the second invariant of the deviator: the stress of a bar as close to yield. */
static double von_mises_of(const double *field, const double *up)
{
    (void)up;
    double squares = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double difference = field[a] - field[(a + 1) % 3];
        squares += 0.5 * difference * difference + 3.0 * field[3 + a] * field[3 + a];
    }
    return sqrt(squares);
}

static const mor_picture_color derived[] = {{"speed", "velocity", "m/s", length_of},
                                            {"pressure", "stress", "Pa", pressure_of},
                                            {"vertical_stress", "stress", "Pa", vertical_of},
                                            {"von_mises", "stress", "Pa", von_mises_of}};
enum { N_DERIVED = sizeof derived / sizeof *derived };

mor_picture_color mor_picture_color_find(const char *name)
{
    for (int k = 0; k < N_DERIVED; ++k) {
        if (strcmp(derived[k].name, name) == 0) {
            return derived[k];
        }
    }
    return (mor_picture_color){.name = name, .field = name};
}

double mor_picture_color_value(const mor_picture_color *color, const double *field, int n_components, const double *up)
{
    if (color->value != NULL) {
        return color->value(field, up);
    }
    return n_components == 3 ? mor_vector_length(field) : field[0];
}

bool mor_picture_color_fits(const mor_picture_color *color, int n_components)
{
    return color->value != NULL || n_components == 1 || n_components == 3;
}

void mor_picture_color_names(char *text)
{
    int n = 0;
    for (int k = 0; k < N_DERIVED; ++k) {
        n +=
            snprintf(text + n, (size_t)(MOR_PICTURE_COLOR_NAMES_BYTES - n), "%s%s", k > 0 ? ", " : "", derived[k].name);
    }
}

static void add_word(const char *word, mor_picture_color_words *words)
{
    for (int k = 0; k < words->n; ++k) {
        if (strcmp(words->of[k], word) == 0) { /* several soils have states of the same name */
            return;
        }
    }
    if (words->n < MOR_PICTURE_COLOR_WORDS_MAX) {
        words->of[words->n++] = word;
    }
}

void mor_picture_color_offer(const char *field, int n_components, mor_picture_color_words *words)
{
    const mor_picture_color plain = {.name = field, .field = field};
    if (mor_picture_color_fits(&plain, n_components)) {
        add_word(field, words);
    }
    for (int k = 0; k < N_DERIVED; ++k) {
        if (strcmp(derived[k].field, field) == 0) {
            add_word(derived[k].name, words);
        }
    }
}

void mor_picture_color_advise(const mor_picture_color_words *words, const char *name, char *text)
{
    const int nearest = mor_nearest_find(name, words->of, words->n);
    const char *found = nearest < 0 ? "" : words->of[nearest];
    snprintf(text, MOR_PICTURE_COLOR_NAMES_BYTES, nearest < 0 ? "use one of these%s" : "did you mean '%s'?", found);
}

bool mor_picture_color_is_for(const char *set, bool has_soil)
{
    return !has_soil || strcmp(set, MOR_PICTURE_SOIL_SET) == 0;
}
