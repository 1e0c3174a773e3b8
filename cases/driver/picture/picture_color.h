/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_PICTURE_COLOR_H
#define MOR_CASES_DRIVER_PICTURE_PICTURE_COLOR_H

#include <stdbool.h>

/** @file
 *  Colors of pictures: fields of the snapshots, and values derived from them such as the speed. It neither reads
 *  snapshots nor draws. */

/** Name of the soil's set; all others are bodies. */
#define MOR_PICTURE_SOIL_SET "soil"

/** How a color is derived from a field. */
typedef struct mor_picture_color {
    const char *name;  /* of the color, zero-terminated */
    const char *field; /* it is made from, zero-terminated */
    const char *unit;  /* of the color; NULL: that of the field */
    /** Value of one particle, in the unit of the color, from its components of the field, shape [n_components], in
     *  the unit of the field, and the direction against gravity, shape [3], 1. */
    double (*value)(const double *field, const double *up);
} mor_picture_color;

enum { MOR_PICTURE_COLOR_NAMES_BYTES = 128, MOR_PICTURE_COLOR_WORDS_MAX = 128 };

/** The colors that some sets of particles offer. Zeroed: none. */
typedef struct mor_picture_color_words {
    const char *of[MOR_PICTURE_COLOR_WORDS_MAX]; /* zero-terminated; borrowed from the fields */
    int n;
} mor_picture_color_words;

/** Finds the derived color of a name, or else the field of that name.
 *  @param name [in]  zero-terminated; borrowed by the result
 *  Returns: the color; value is NULL for a field as it is. */
mor_picture_color mor_picture_color_find(const char *name);

/** Value of a particle, in the unit of the color.
 *  @param field        [in]  shape [n_components]; in the unit of the field
 *  @param n_components [in]  1, or 3 for the length of a vector; what the field has, for a derived color
 *  @param up           [in]  shape [3], 1, unit vector against gravity */
double mor_picture_color_value(const mor_picture_color *color, const double *field, int n_components, const double *up);

/** Returns whether a field of so many components can be shown by this color.
 *  @param n_components [in]  of the field */
bool mor_picture_color_fits(const mor_picture_color *color, int n_components);

/** Adds the colors that a field offers: itself, where it can be shown, and those derived from it.
 *  @param field        [in]      zero-terminated; borrowed by the words
 *  @param n_components [in]      of the field
 *  @param words        [in,out]  what does not fit is left out */
void mor_picture_color_offer(const char *field, int n_components, mor_picture_color_words *words);

/** Writes what to do about a color that is not offered: the nearest one, where one is near.
 *  @param name [in]   zero-terminated
 *  @param text [out]  shape [MOR_PICTURE_COLOR_NAMES_BYTES]; zero-terminated */
void mor_picture_color_advise(const mor_picture_color_words *words, const char *name, char *text);

/** Whether a set of particles is colored: the soil, or everything where there is none.
 *  @param set [in]  zero-terminated; name of the set */
bool mor_picture_color_is_for(const char *set, bool has_soil);

/** Writes the names of the derived colors, with commas.
 *  @param text [out]  shape [MOR_PICTURE_COLOR_NAMES_BYTES]; zero-terminated */
void mor_picture_color_names(char *text);

#endif
