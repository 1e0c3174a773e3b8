/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What is left of the faces that particles see. Compiled once per instruction set; MOR_ISA is its name. Principal
 * values and directions are those of core/base/eigen.h to the last bit. */
#include "core/base/eigen.h"
#include "core/particle/lane_math.h"
#include "core/sph/lanes/soil_lanes.h"

#include <string.h>

/* Principal values of normals that are equal but for rounding. */
#define FLAT_FACES 1e-12

/* Squares of a tensor, of a trace of 1, whose smaller principal values are below MOR_FACES_ALIKE that leave one
 * direction: its ninth power, with the row that is taken, 0.02^9. */
enum { SQUARES = 3 };

INLINE vec dot(const vec *a, const vec *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Products of symmetric tensors, shape [6], and vectors, shape [3]. */
INLINE void apply_symmetric(const vec *t, const vec *a, vec *out)
{
    out[0] = t[MOR_XX] * a[0] + t[MOR_XY] * a[1] + t[MOR_ZX] * a[2];
    out[1] = t[MOR_XY] * a[0] + t[MOR_YY] * a[1] + t[MOR_YZ] * a[2];
    out[2] = t[MOR_ZX] * a[0] + t[MOR_YZ] * a[1] + t[MOR_ZZ] * a[2];
}

INLINE vec absolute(vec a)
{
    return larger(a, -a);
}

/* Largest root of x^3 - 3 x = 2 half, as mor_eigen_root. */
INLINE vec find_root(vec half)
{
    vec x = 1.73205 + half * (0.32138 - 0.05343 * half);
    for (int k = 0; k < 3; ++k) {
        x -= ((x * x - 3.0) * x - 2.0 * half) / (3.0 * (x * x - 1.0));
    }
    return x;
}

/* Whether faces differ so little that one direction is left: the second invariant of a tensor with trace 1 bounds the
 * smaller principal values. */
INLINE mask are_alike(const vec *f, vec trace, double limit)
{
    const vec plane = f[MOR_XX] * f[MOR_YY] - f[MOR_XY] * f[MOR_XY];
    const vec side = f[MOR_YY] * f[MOR_ZZ] - f[MOR_YZ] * f[MOR_YZ];
    const vec front = f[MOR_ZZ] * f[MOR_XX] - f[MOR_ZX] * f[MOR_ZX];
    return plane + side + front <= limit * (1.0 - limit) * trace * trace;
}

/* The one normal of a plane: the row of n (x) n with the largest diagonal. */
INLINE void take_row(const vec *f, vec *normal)
{
    const mask first = f[MOR_XX] > f[MOR_YY];
    const mask half = select_lanes(first, f[MOR_XX], f[MOR_YY]) > f[MOR_ZZ];
    normal[0] = select_lanes(half, select_lanes(first, f[MOR_XX], f[MOR_XY]), f[MOR_ZX]);
    normal[1] = select_lanes(half, select_lanes(first, f[MOR_XY], f[MOR_YY]), f[MOR_YZ]);
    normal[2] = select_lanes(half, select_lanes(first, f[MOR_ZX], f[MOR_YZ]), f[MOR_ZZ]);
}

INLINE void make_unit(vec *a)
{
    const vec inverse = 1.0 / square_root(dot(a, a));
    for (int k = 0; k < 3; ++k) {
        a[k] *= inverse;
    }
}

INLINE void square_tensor(vec *t)
{
    const vec xx = t[MOR_XX], yy = t[MOR_YY], zz = t[MOR_ZZ];
    const vec xy = t[MOR_XY], yz = t[MOR_YZ], zx = t[MOR_ZX];
    t[MOR_XX] = xx * xx + (xy * xy + zx * zx);
    t[MOR_YY] = yy * yy + (xy * xy + yz * yz);
    t[MOR_ZZ] = zz * zz + (yz * yz + zx * zx);
    t[MOR_XY] = xy * (xx + yy) + zx * yz;
    t[MOR_YZ] = yz * (yy + zz) + xy * zx;
    t[MOR_ZX] = zx * (zz + xx) + xy * yz;
}

/* The direction that is left where faces count as one; returns its principal value. Costs less than all three. */
INLINE vec find_one_normal(const vec *f, vec trace, vec *normal)
{
    const vec scale = 1.0 / select_lanes(trace > 0.0, trace, broadcast(1.0));
    vec power[6];
    vec next[3];
    for (int a = 0; a < 6; ++a) {
        power[a] = scale * f[a];
    }
    for (int k = 0; k < SQUARES; ++k) {
        square_tensor(power); /* its largest principal value: 0.98^8 to 1 */
    }
    take_row(power, next);
    make_unit(next);
    apply_symmetric(f, next, normal);
    make_unit(normal);
    apply_symmetric(f, normal, next);
    return dot(next, normal);
}

/* The direction of a deviator, shape [6], whose value is apart from the other two, and two across it. */
INLINE void find_frame(const vec *b, vec *n, vec *u, vec *v)
{
    vec c[6], t[6];
    const vec off2 = b[MOR_XY] * b[MOR_XY] + b[MOR_YZ] * b[MOR_YZ] + b[MOR_ZX] * b[MOR_ZX];
    const vec p2 = (b[MOR_XX] * b[MOR_XX] + b[MOR_YY] * b[MOR_YY] + b[MOR_ZZ] * b[MOR_ZZ] + 2.0 * off2) / 6.0;
    const vec p = square_root(p2);
    const vec half = 0.5 * symmetric_cofactors(b, c, 3) / (p2 * p);
    const vec root = find_root(smaller(absolute(half), broadcast(1.0)));
    const vec apart = root * select_lanes(half < 0.0, -p, p);
    for (int a = 0; a < 6; ++a) {
        t[a] = b[a] - (a < 3 ? apart : broadcast(0.0));
    }
    symmetric_cofactors(t, c, 3);
    const mask is_first = c[MOR_XX] >= c[MOR_YY];
    const mask is_third = c[MOR_ZZ] > select_lanes(is_first, c[MOR_XX], c[MOR_YY]);
    n[0] = select_lanes(is_third, c[MOR_ZX], select_lanes(is_first, c[MOR_XX], c[MOR_XY]));
    n[1] = select_lanes(is_third, c[MOR_YZ], select_lanes(is_first, c[MOR_XY], c[MOR_YY]));
    n[2] = select_lanes(is_third, c[MOR_ZZ], select_lanes(is_first, c[MOR_ZX], c[MOR_YZ]));
    make_unit(n);
    const mask is_wide = absolute(n[0]) > absolute(n[1]);
    const vec across = 1.0 / square_root(n[2] * n[2] + select_lanes(is_wide, n[0] * n[0], n[1] * n[1]));
    u[0] = select_lanes(is_wide, -n[2] * across, broadcast(0.0));
    u[1] = select_lanes(is_wide, broadcast(0.0), n[2] * across);
    u[2] = select_lanes(is_wide, n[0] * across, -n[1] * across);
    v[0] = n[1] * u[2] - n[2] * u[1];
    v[1] = n[2] * u[0] - n[0] * u[2];
    v[2] = n[0] * u[1] - n[1] * u[0];
}

/* Diagonalizes deviators, as mor_eigen_deviator. */
INLINE void split_deviator(const vec *b, vec *values, vec *axes)
{
    vec n[3], u[3], v[3], image[3];
    find_frame(b, n, u, v);
    apply_symmetric(b, n, image);
    values[0] = dot(n, image);
    apply_symmetric(b, u, image);
    const vec uu = dot(u, image);
    const vec uv = dot(v, image);
    apply_symmetric(b, v, image);
    const vec vv = dot(v, image);
    const mask rotates = absolute(uv) > MOR_EIGEN_NOTHING * (absolute(uu) + absolute(vv));
    const vec ratio = (vv - uu) / (2.0 * uv);
    const vec t = select_lanes(ratio >= 0.0, broadcast(1.0), broadcast(-1.0)) /
                  (absolute(ratio) + square_root(ratio * ratio + 1.0));
    const vec cosine = 1.0 / square_root(t * t + 1.0);
    const vec c = select_lanes(rotates, cosine, broadcast(1.0));
    const vec s = select_lanes(rotates, t * cosine, broadcast(0.0));
    values[1] = select_lanes(rotates, c * (c * uu - s * uv) - s * (c * uv - s * vv), uu);
    values[2] = select_lanes(rotates, s * (s * uu + c * uv) + c * (s * uv + c * vv), vv);
    for (int a = 0; a < 3; ++a) {
        axes[3 * a] = n[a];
        axes[3 * a + 1] = c * u[a] + select_lanes(rotates, -s, broadcast(0.0)) * v[a];
        axes[3 * a + 2] = s * u[a] + c * v[a];
    }
}

/* Principal values, shape [3], and axes in columns, shape [3, 3]; returns where they are not found: an axis lies across
 * the third, or all values are equal. */
INLINE mask split_faces(const vec *f, vec *values, vec *axes)
{
    const vec mean = (f[MOR_XX] + f[MOR_YY] + f[MOR_ZZ]) / 3.0;
    vec size = broadcast(0.0);
    vec b[6];
    for (int a = 0; a < 6; ++a) {
        b[a] = f[a] - (a < 3 ? mean : broadcast(0.0));
        size = larger(size, absolute(b[a]));
    }
    const vec divisor = select_lanes(size > 0.0, size, broadcast(1.0));
    for (int a = 0; a < 6; ++a) {
        b[a] /= divisor;
    }
    split_deviator(b, values, axes);
    for (int k = 0; k < 3; ++k) {
        values[k] = mean + size * values[k];
    }
    return ((f[MOR_YZ] == 0.0) & (f[MOR_ZX] == 0.0)) | ~(size > 0.0);
}

INLINE bool is_any(mask where)
{
    bits all = 0;
    for (int lane = 0; lane < LANES; ++lane) {
        all |= where[lane];
    }
    return all != 0;
}

INLINE void keep(double (*rows)[8], int first, const vec *columns, int n)
{
    for (int a = 0; a < n; ++a) {
        memcpy(rows[a] + first, &columns[a], sizeof columns[a]);
    }
}

void MOR_ISA_NAME(mor_face_normals_find)(const double *faces, int stride, mor_face_normals *found);

void MOR_ISA_NAME(mor_face_normals_find)(const double *faces, int stride, mor_face_normals *found)
{
    for (int part = 0; part < PARTS; ++part) {
        const int first = part * LANES;
        vec f[6], flat[3], normal[3], values[3], axes[9];
        load_first(faces + (int64_t)first * stride, stride, 6, f);
        const vec trace = f[MOR_XX] + f[MOR_YY] + f[MOR_ZZ];
        const mask is_one = are_alike(f, trace, MOR_FACES_ALIKE);
        const mask is_plane = are_alike(f, trace, FLAT_FACES);
        mask has_axes = ~is_one;
        const vec value = find_one_normal(f, trace, normal);
        take_row(f, flat);
        make_unit(flat);
        for (int a = 0; a < 3; ++a) {
            normal[a] = select_lanes(is_plane, flat[a], normal[a]);
        }
        keep(found->normal, first, normal, 3);
        memcpy(found->value + first, &value, sizeof value);
        memcpy(found->is_one + first, &is_one, sizeof is_one);
        memcpy(found->is_plane + first, &is_plane, sizeof is_plane);
        if (is_any(has_axes)) {
            has_axes &= ~split_faces(f, values, axes);
            keep(found->values, first, values, 3);
            keep(found->axes, first, axes, 9);
        }
        memcpy(found->has_axes + first, &has_axes, sizeof has_axes);
    }
}
