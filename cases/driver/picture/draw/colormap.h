/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_COLORMAP_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_COLORMAP_H

/** @file
 *  Colors: the sequential color map of the pictures, a palette for lines and groups, and the step between linear light
 *  and screen values. The map is a curve in Oklab (Ottosson 2020): lightness is linear in the curve parameter, the two
 *  color axes are polynomials of degree four, and the curve is walked at constant speed, so that equal differences of
 *  the value are equal differences to the eye. Lightness rises throughout, which keeps the map legible in gray and for
 *  color-blind readers. The meaning of the values does not matter. */

enum { MOR_COLORMAP_SIZE = 512, MOR_COLORMAP_CATEGORIES = 8 };

/** The sampled map. A plain value without owned memory; safe to share once made. */
typedef struct mor_colormap {
    double color[MOR_COLORMAP_SIZE][3]; /* shape [MOR_COLORMAP_SIZE,3]; linear sRGB, 1, in [0, 1] */
} mor_colormap;

/** Fills the map.
 *  Theory: Oklab, Ottosson (2020). */
void mor_colormap_init(mor_colormap *map);

/** Looks up a color by linear interpolation.
 *  @param fraction [in]   place in the map, 1; values outside [0, 1] give the end colors
 *  @param linear   [out]  shape [3]; linear sRGB, 1 */
void mor_colormap_at(const mor_colormap *map, double fraction, double *linear);

/** Gives a color of the palette for lines and groups: hues that also differ in lightness, for color-blind readers.
 *  @param index  [in]   any number >= 0; the palette repeats after MOR_COLORMAP_CATEGORIES
 *  @param linear [out]  shape [3]; linear sRGB, 1 */
void mor_colormap_category(int index, double *linear);

/** Screen value of a linear light value, both 1; the input is clipped to [0, 1]. */
double mor_colormap_encode(double linear);

/** Linear light value of a screen value, both 1, in [0, 1]. */
double mor_colormap_decode(double screen);

#endif
