/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_DISC_CELL_H
#define MOR_TESTS_COMMON_DISC_CELL_H

#include "core/base/math.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  How much a rigid disc in the middle of a square changes the stress that it takes to squeeze the square between walls
 *  without friction, by finite elements: a quarter of it with 9-node elements, in plane strain without change of volume
 *  (a penalty with 2 x 2 points). The material is a viscous fluid, or perfectly plastic with a shear strength of one:
 *  then the motion is that which dissipates least, whose power gives the collapse load of limit analysis (Hill (1951)).
 *  It is approached from above by fluids whose viscosity is the strength over the rate of shear of the one before. */

/** One cell. */
typedef struct disc_cell {
    double half;     /* of the side of the square, 1 */
    double radius;   /* of the disc, < half, 1 */
    bool sticks;     /* soil to the disc; else it slips without friction */
    bool is_plastic; /* else a fluid */
} disc_cell;

enum {
    CELL_ELEMENTS = 12,                      /* along either direction of the quarter */
    CELL_LINE = 2 * CELL_ELEMENTS + 1,       /* nodes along it */
    CELL_NODES = CELL_LINE * CELL_LINE,      /* of the quarter */
    CELL_UNKNOWNS = 2 * CELL_NODES,          /* velocities */
    CELL_BAND = 2 * (2 * CELL_LINE + 2) + 2, /* one more than the largest difference of two unknowns of an element */
    CELL_SHAPES = 9,                         /* nodes of an element */
    CELL_LOCAL = 2 * CELL_SHAPES,
    CELL_POINTS = 9 * CELL_ELEMENTS * CELL_ELEMENTS, /* where strain rates are found */
    CELL_PASSES = 30                                 /* fluids in turn */
};

/** What is solved for one cell after the other; one object on the heap, for it is large. */
typedef struct cell_work {
    double place[CELL_NODES][2];
    double velocity[CELL_UNKNOWNS];
    double matrix[CELL_UNKNOWNS][CELL_BAND]; /* row r: its diagonal, then columns r + 1, r + 2 ... */
    double load[CELL_UNKNOWNS];
    bool is_given[CELL_UNKNOWNS];
    double viscosity[CELL_POINTS];
} cell_work;

/** Gradients of the shape functions of an element. */
typedef struct cell_point {
    double gradient[2][CELL_SHAPES];
    double area;
    int nodes[CELL_SHAPES];
} cell_point;

/** Finds shape functions at a place of element (i, j), both coordinates from -1 to 1, with the weight of that place. */
static inline cell_point cell_find_point(const cell_work *work, int i, int j, double a, double b, double weight)
{
    const double value[2][3] = {{0.5 * a * (a - 1.0), 1.0 - a * a, 0.5 * a * (a + 1.0)},
                                {0.5 * b * (b - 1.0), 1.0 - b * b, 0.5 * b * (b + 1.0)}};
    const double slope[2][3] = {{a - 0.5, -2.0 * a, a + 0.5}, {b - 0.5, -2.0 * b, b + 0.5}};
    double local[2][CELL_SHAPES];
    double map[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
    cell_point it;
    for (int k = 0; k < CELL_SHAPES; ++k) {
        it.nodes[k] = (2 * i + k / 3) * CELL_LINE + 2 * j + k % 3;
        local[0][k] = slope[0][k / 3] * value[1][k % 3];
        local[1][k] = value[0][k / 3] * slope[1][k % 3];
        for (int c = 0; c < 4; ++c) {
            map[c / 2][c % 2] += local[c / 2][k] * work->place[it.nodes[k]][c % 2];
        }
    }
    const double determinant = map[0][0] * map[1][1] - map[0][1] * map[1][0];
    for (int k = 0; k < CELL_SHAPES; ++k) {
        it.gradient[0][k] = (map[1][1] * local[0][k] - map[0][1] * local[1][k]) / determinant;
        it.gradient[1][k] = (map[0][0] * local[1][k] - map[1][0] * local[0][k]) / determinant;
    }
    it.area = fabs(determinant) * weight;
    return it;
}

/** Adds factor * row (x) row to the matrix; row: shape [CELL_LOCAL], by the unknowns of the nodes of a point. */
static inline void cell_add(cell_work *work, const cell_point *point, const double *row, double factor)
{
    for (int p = 0; p < CELL_LOCAL; ++p) {
        for (int q = 0; q < CELL_LOCAL; ++q) {
            const int r = 2 * point->nodes[p / 2] + p % 2;
            const int c = 2 * point->nodes[q / 2] + q % 2;
            if (c >= r) {
                work->matrix[r][c - r] += factor * row[p] * row[q];
            }
        }
    }
}

/** Places the nodes: along angles from the disc to the walls, by the square of the part of the way, so that rates may
 *  grow without bound at the disc, as in bands of shear along it; gives the motion of walls, planes of symmetry and of
 *  a disc that soil sticks to, at a strain rate of one. */
static inline void cell_set_up(const disc_cell *cell, cell_work *work)
{
    for (int k = 0; k < CELL_NODES; ++k) {
        const int i = k / CELL_LINE;
        const double part = (double)(k % CELL_LINE) / (CELL_LINE - 1);
        const double angle = 0.5 * MOR_PI * i / (CELL_LINE - 1);
        const double x = cos(angle);
        const double y = sin(angle);
        const double radius = cell->radius + (cell->half / fmax(x, y) - cell->radius) * part * part;
        const bool is_wall = k % CELL_LINE == CELL_LINE - 1;
        const bool sticks = cell->sticks && k % CELL_LINE == 0;
        const bool is_side = is_wall && 2 * i <= CELL_LINE - 1;
        const bool is_top = is_wall && 2 * i >= CELL_LINE - 1;
        work->place[k][0] = radius * x;
        work->place[k][1] = radius * y;
        work->is_given[2 * k] = is_side || i == CELL_LINE - 1 || sticks;
        work->is_given[2 * k + 1] = is_top || i == 0 || sticks;
        work->velocity[2 * k] = is_side ? cell->half : 0.0;
        work->velocity[2 * k + 1] = is_top ? -cell->half : 0.0;
    }
    for (int k = 0; k < CELL_POINTS; ++k) {
        work->viscosity[k] = 1.0;
    }
}

static const double cell_places[3] = {-0.7745966692414834, 0.0, 0.7745966692414834}; /* of Gauss, sqrt(3 / 5) */
static const double cell_weights[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

/** Adds the penalties on a change of volume in element (i, j), as stiff as its largest viscosity asks for. */
static inline void cell_keep_volume(cell_work *work, int i, int j)
{
    double largest = 1.0;
    for (int k = 0; k < 9; ++k) {
        largest = fmax(largest, work->viscosity[9 * (i * CELL_ELEMENTS + j) + k]);
    }
    for (int k = 0; k < 4; ++k) {
        const double place = 1.0 / sqrt(3.0);
        const cell_point point =
            cell_find_point(work, i, j, k / 2 == 0 ? -place : place, k % 2 == 0 ? -place : place, 1.0);
        double row[CELL_LOCAL];
        for (int p = 0; p < CELL_LOCAL; ++p) {
            row[p] = point.gradient[p % 2][p / 2];
        }
        cell_add(work, &point, row, 1e6 * largest * point.area);
    }
}

/** Fills the matrix of the present viscosities. */
static inline void cell_assemble(const disc_cell *cell, cell_work *work)
{
    memset(work->matrix, 0, sizeof work->matrix);
    for (int e = 0; e < CELL_ELEMENTS * CELL_ELEMENTS; ++e) {
        const int i = e / CELL_ELEMENTS;
        const int j = e % CELL_ELEMENTS;
        for (int k = 0; k < 9; ++k) {
            const cell_point point = cell_find_point(work, i, j, cell_places[k / 3], cell_places[k % 3],
                                                     cell_weights[k / 3] * cell_weights[k % 3]);
            double stretch[CELL_LOCAL];
            double shear[CELL_LOCAL];
            for (int p = 0; p < CELL_LOCAL; ++p) {
                stretch[p] = (p % 2 == 0 ? 1.0 : -1.0) * point.gradient[p % 2][p / 2];
                shear[p] = point.gradient[1 - p % 2][p / 2];
            }
            cell_add(work, &point, stretch, work->viscosity[9 * e + k] * point.area);
            cell_add(work, &point, shear, work->viscosity[9 * e + k] * point.area);
        }
        cell_keep_volume(work, i, j);
    }
    for (int i = 0; i < CELL_LINE && !cell->sticks; ++i) { /* nothing goes through the disc */
        const int r = 2 * i * CELL_LINE;
        const double angle = 0.5 * MOR_PI * i / (CELL_LINE - 1);
        const double stiffness = 1e10;
        work->matrix[r][0] += stiffness * cos(angle) * cos(angle);
        work->matrix[r][1] += stiffness * cos(angle) * sin(angle);
        work->matrix[r + 1][0] += stiffness * sin(angle) * sin(angle);
    }
}

/** Takes what is given out of the equations. */
static inline void cell_eliminate(cell_work *work)
{
    memset(work->load, 0, sizeof work->load);
    for (int r = 0; r < CELL_UNKNOWNS; ++r) {
        for (int k = 1; k < CELL_BAND && r + k < CELL_UNKNOWNS; ++k) {
            const int c = r + k;
            work->load[r] -= work->is_given[c] ? work->matrix[r][k] * work->velocity[c] : 0.0;
            work->load[c] -= work->is_given[r] ? work->matrix[r][k] * work->velocity[r] : 0.0;
            work->matrix[r][k] = work->is_given[r] || work->is_given[c] ? 0.0 : work->matrix[r][k];
        }
    }
    for (int r = 0; r < CELL_UNKNOWNS; ++r) {
        work->matrix[r][0] = work->is_given[r] ? 1.0 : work->matrix[r][0];
        work->load[r] = work->is_given[r] ? work->velocity[r] : work->load[r];
    }
}

/** Solves for the velocities: Cholesky's method within the band. */
static inline void cell_solve(cell_work *work)
{
    for (int r = 0; r < CELL_UNKNOWNS; ++r) {
        const int last = r + CELL_BAND < CELL_UNKNOWNS ? CELL_BAND : CELL_UNKNOWNS - r;
        const double root = sqrt(work->matrix[r][0]);
        assert_true(root > 0.0);
        work->load[r] /= root;
        for (int k = 0; k < last; ++k) {
            work->matrix[r][k] /= root;
        }
        for (int k = 1; k < last; ++k) {
            const double factor = work->matrix[r][k];
            work->load[r + k] -= factor * work->load[r];
            for (int m = k; m < last && factor != 0.0; ++m) {
                work->matrix[r + k][m - k] -= factor * work->matrix[r][m];
            }
        }
    }
    for (int r = CELL_UNKNOWNS - 1; r >= 0; --r) {
        double sum = work->load[r];
        for (int k = 1; k < CELL_BAND && r + k < CELL_UNKNOWNS; ++k) {
            sum -= work->matrix[r][k] * work->velocity[r + k];
        }
        work->velocity[r] = sum / work->matrix[r][0];
    }
}

/** Returns the power of the stress, of a viscosity or a strength of one; sets viscosities from the rates of shear, none
 *  of which counts as less than the floor. */
static inline double cell_find_power(const disc_cell *cell, cell_work *work, double floor)
{
    double power = 0.0;
    for (int k = 0; k < CELL_POINTS; ++k) {
        const int e = k / 9;
        const cell_point point = cell_find_point(work, e / CELL_ELEMENTS, e % CELL_ELEMENTS, cell_places[k % 9 / 3],
                                                 cell_places[k % 3], cell_weights[k % 9 / 3] * cell_weights[k % 3]);
        double stretch = 0.0;
        double shear = 0.0;
        for (int p = 0; p < CELL_LOCAL; ++p) {
            const double v = work->velocity[2 * point.nodes[p / 2] + p % 2];
            stretch += (p % 2 == 0 ? 1.0 : -1.0) * point.gradient[p % 2][p / 2] * v;
            shear += point.gradient[1 - p % 2][p / 2] * v;
        }
        const double square = stretch * stretch + shear * shear;
        power += (cell->is_plastic ? sqrt(square) : square) * point.area;
        work->viscosity[k] = cell->is_plastic ? 1.0 / sqrt(square + floor * floor) : 1.0;
    }
    return power;
}

/** Returns the stress difference that squeezes a cell over that which squeezes a square without a disc, 1. */
static inline double disc_cell_strength(const disc_cell *cell)
{
    cell_work *work = calloc(1, sizeof *work);
    double power = 0.0;
    assert_non_null(work);
    cell_set_up(cell, work);
    for (int pass = 0; pass < (cell->is_plastic ? CELL_PASSES : 1); ++pass) {
        cell_assemble(cell, work);
        cell_eliminate(work);
        cell_solve(work);
        power = cell_find_power(cell, work, 0.03 * pow(0.8, pass) + 1e-4);
    }
    free(work);
    return power / ((cell->is_plastic ? 2.0 : 4.0) * cell->half * cell->half);
}

#endif
