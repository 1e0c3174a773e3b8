/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Nodes on faces between shapes that adjoin one another: as pixels on an edge that two triangles share, each belongs to
 * one of them. */
#include "relaxation/relax/lattice_internal.h"

#include "core/geometry/shape_analytic.h"

#include <math.h>

/* Distance from a node to the places beside it, in spacings: far above MOR_LATTICE_ON_FACE, far below what shapes
 * have. */
#define ASIDE 0x1p-8

/* Places looked at around a node. */
enum { AROUND_PLANE = 16, AROUND_SPACE = 64 };

/* 2 pi (1 - 1/golden ratio), and an angle at which no face is likely to lie. */
static const double golden_angle = 2.39996322972865332;
static const double odd_angle = 0.4;

static void step_aside(const mor_lattice_request *request, const double *node, const double *direction, double *place)
{
    for (int a = 0; a < 3; ++a) {
        place[a] = a < request->dimension ? node[a] + ASIDE * request->spacing * direction[a] : node[a];
    }
}

/* A direction of many that are spread evenly. */
static void choose_direction(int dimension, int k, double *direction)
{
    const double up = dimension == 3 ? 1.0 - (2.0 * k + 1.0) / AROUND_SPACE : 0.0;
    const double across = sqrt(1.0 - up * up);
    direction[0] = across * cos(odd_angle + golden_angle * k);
    direction[1] = across * sin(odd_angle + golden_angle * k);
    direction[2] = up;
}

static bool is_in_any(const mor_lattice_request *request, const double *place)
{
    bool is_inside = mor_shape_distance(request->shape, place) < 0.0;
    for (int k = 0; k < request->n_siblings && !is_inside; ++k) {
        is_inside = mor_shape_distance(request->siblings[k], place) < 0.0;
    }
    return is_inside;
}

/* Whether no sibling reaches as deep as the shape. */
static bool is_deepest(const mor_lattice_request *request, const double *place)
{
    const double distance = mor_shape_distance(request->shape, place);
    bool is = true;
    for (int k = 0; k < request->n_siblings && is; ++k) {
        is = distance < mor_shape_distance(request->siblings[k], place);
    }
    return is;
}

/* Whether a sibling holds a node that does not lie on its face. */
static bool is_of_sibling(const mor_lattice_request *request, const double *node)
{
    bool is = false;
    for (int k = 0; k < request->n_siblings && !is; ++k) {
        is = mor_shape_distance(request->siblings[k], node) < -MOR_LATTICE_ON_FACE * request->spacing;
    }
    return is;
}

bool mor_lattice_is_shared(const mor_lattice_request *request, const double *node)
{
    static const double side[3] = {-1.0, -0.61803398874989485, -0.38196601125010515};
    const int n = request->dimension == 3 ? AROUND_SPACE : AROUND_PLANE;
    double place[3];
    step_aside(request, node, side, place);
    bool is_shared = !is_of_sibling(request, node) && is_deepest(request, place);
    for (int k = 0; k < n && is_shared; ++k) {
        double direction[3];
        choose_direction(request->dimension, k, direction);
        step_aside(request, node, direction, place);
        is_shared = is_in_any(request, place);
    }
    return is_shared;
}
