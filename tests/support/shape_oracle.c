/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/shape_oracle.h"

#include <math.h>

static number scalar(const type_arguments *arguments, const char *name)
{
    return argument_at(arguments, name, 0);
}

static void add_center(const type_arguments *arguments, number x[3])
{
    for (size_t i = 0; i < 3; ++i) x[i] = num_add(x[i], argument_at(arguments, "center", i));
}

static void scale_by(const type_arguments *arguments, const char *name, number x[3])
{
    for (size_t i = 0; i < 3; ++i) x[i] = num_mul(x[i], argument_at(arguments, name, i));
}

/* --- Round ------------------------------------------------------------------------------------ */

void ellipsoid_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    x[0] = num_mul(num_cos(p[1]), num_cos(p[0]));
    x[1] = num_mul(num_cos(p[1]), num_sin(p[0]));
    x[2] = num_sin(p[1]);
    scale_by(arguments, "radii", x);
    add_center(arguments, x);
}

static void ring(number radius, number height, number angle, number x[3])
{
    x[0] = num_mul(radius, num_cos(angle));
    x[1] = num_mul(radius, num_sin(angle));
    x[2] = height;
}

void cylinder_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    ring(scalar(arguments, "radius"), num_mul(scalar(arguments, "height"), p[1]), p[0], x);
    add_center(arguments, x);
}

void cone_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number radius = num_mul(scalar(arguments, "radius"), num_sub(num(1), p[1]));
    ring(radius, num_mul(scalar(arguments, "height"), p[1]), p[0], x);
    add_center(arguments, x);
}

/* Unit vectors a and b across an axis, and their product k along it: those of the plugins, which
 * stand on the coordinate axis that k is farthest from. */
static void frame_of(const number axis[3], number a[3], number b[3], number k[3])
{
    const number length = num_hypot(num_hypot(axis[0], axis[1]), axis[2]);
    size_t least = 0, zeros = 0, along = 0;
    number size = num(0);
    for (size_t i = 0; i < 3; ++i) {
        k[i] = num_div(axis[i], length);
        zeros += num_near(k[i]) == 0;
        if (num_near(k[i]) != 0) along = i;
        if (fabs(num_near(k[i])) < fabs(num_near(k[least]))) least = i;
    }
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, l = (i + 2) % 3;
        a[i] = num_sub(num_mul(k[j], num(l == least)), num_mul(k[l], num(j == least)));
        if (zeros == 2) a[i] = num(i == (along + 1) % 3);
        size = num_hypot(size, a[i]);
    }
    for (size_t i = 0; i < 3; ++i) a[i] = num_div(a[i], size);
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, l = (i + 2) % 3;
        b[i] = num_sub(num_mul(k[j], a[l]), num_mul(k[l], a[j]));
    }
}

/* radius (a cos u + b sin u) */
static void turned_ring(const number a[3], const number b[3], number radius, number u, number x[3])
{
    for (size_t i = 0; i < 3; ++i)
        x[i] = num_mul(radius, num_add(num_mul(a[i], num_cos(u)), num_mul(b[i], num_sin(u))));
}

void disc_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number axis[3], a[3], b[3], k[3];
    for (size_t i = 0; i < 3; ++i) axis[i] = argument_at(arguments, "axis", i);
    frame_of(axis, a, b, k);
    turned_ring(a, b, num_mul(scalar(arguments, "radius"), num_sub(num(1), p[1])), p[0], x);
    add_center(arguments, x);
}

void capsule_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number axis[3], a[3], b[3], k[3];
    bool is_point = true;
    for (size_t i = 0; i < 3; ++i) {
        axis[i] = num_sub(argument_at(arguments, "to", i), argument_at(arguments, "from", i));
        is_point = is_point && num_near(axis[i]) == 0;
    }
    if (is_point) axis[2] = num(1);
    frame_of(axis, a, b, k);
    turned_ring(a, b, scalar(arguments, "radius"), p[0], x);
    for (size_t i = 0; i < 3; ++i) {
        x[i] = num_add(x[i], argument_at(arguments, "from", i));
        if (!is_point) x[i] = num_add(x[i], num_mul(p[1], axis[i]));
    }
}

/* The lower face across x: v along y, u along z. */
void box_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number lo[3], hi[3];
    for (size_t i = 0; i < 3; ++i) {
        const double size = argument(arguments, "size")->number[i];
        const double center = argument(arguments, "center")->number[i];
        lo[i] = num(center - size / 2);
        hi[i] = num(center + size / 2);
    }
    x[0] = lo[0];
    x[1] = num_add(lo[1], num_mul(p[1], num_sub(hi[1], lo[1])));
    x[2] = num_add(lo[2], num_mul(p[0], num_sub(hi[2], lo[2])));
}

void thread_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    const imp_value *profile = argument(arguments, "profile");
    number radius = scalar(arguments, "radius"), z = num_mul(scalar(arguments, "height"), p[1]);
    number turns = num_div(z, scalar(arguments, "pitch"));
    number phase = num_sub(num_mul(scalar(arguments, "starts"), p[0]),
                           num_mul(num_mul(num(2), num_pi()), turns));
    for (size_t k = 0; k < profile->count; ++k) {
        number wave = num_cos(num_mul(num((double)(k + 1)), phase));
        radius = num_add(radius, num_mul(num(profile->number[k]), wave));
    }
    ring(radius, z, p[0], x);
    add_center(arguments, x);
}

void ripple_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number dx = argument_at(arguments, "direction", 0), dy = argument_at(arguments, "direction", 1);
    number length = num_sqrt(num_add(num_sqr(dx), num_sqr(dy)));
    number way = num_div(num_add(num_mul(dx, p[0]), num_mul(dy, p[1])), length);
    number ahead = num_sub(way, num_mul(scalar(arguments, "speed"), p[2]));
    number turns = num_div(ahead, scalar(arguments, "wavelength"));
    x[0] = p[0];
    x[1] = p[1];
    x[2] =
        num_mul(scalar(arguments, "amplitude"), num_sin(num_mul(num_mul(num(2), num_pi()), turns)));
    add_center(arguments, x);
}

/* --- Straight --------------------------------------------------------------------------------- */

void plane_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    for (size_t i = 0; i < 3; ++i) {
        number along_u = num_mul(p[0], argument_at(arguments, "edge_u", i));
        number along_v = num_mul(p[1], argument_at(arguments, "edge_v", i));
        x[i] = num_add(argument_at(arguments, "origin", i), num_add(along_u, along_v));
    }
}

void point_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    for (size_t i = 0; i < 3; ++i)
        x[i] = num_add(argument_at(arguments, "position", i),
                       num_mul(p[2], argument_at(arguments, "velocity", i)));
}

/* Coordinate i of corner k at time t. */
static number corner(const type_arguments *arguments, size_t k, size_t i, number t)
{
    number still = argument_at(arguments, "points", 3 * k + i);
    if (!argument(arguments, "velocities")->count) return still;
    return num_add(still, num_mul(t, argument_at(arguments, "velocities", 3 * k + i)));
}

static number between(number x, number y, number s)
{
    return num_add(num_mul(num_sub(num(1), s), x), num_mul(s, y));
}

void segment_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    for (size_t i = 0; i < 3; ++i)
        x[i] = between(corner(arguments, 0, i, p[2]), corner(arguments, 1, i, p[2]), p[0]);
}

static void triangle_of(const type_arguments *arguments, const size_t k[3], const number p[3],
                        number x[3])
{
    for (size_t i = 0; i < 3; ++i) {
        number opposite =
            between(corner(arguments, k[1], i, p[2]), corner(arguments, k[2], i, p[2]), p[1]);
        x[i] = between(corner(arguments, k[0], i, p[2]), opposite, p[0]);
    }
}

void triangle_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    triangle_of(arguments, (const size_t[3]){0, 1, 2}, p, x);
}

void mesh_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    size_t k[3];
    for (size_t j = 0; j < 3; ++j) k[j] = (size_t)num_near(argument_at(arguments, "faces", j));
    triangle_of(arguments, k, p, x);
}

/* n! / (i! j! k!), i + j + k = n: products of binomials, exact up to n = 20. */
static double multinomial(unsigned n, unsigned j, unsigned k)
{
    double ways = 1;
    for (unsigned l = 0; l < j; ++l) ways = ways * (n - l) / (l + 1);
    for (unsigned l = 0; l < k; ++l) ways = ways * (n - j - l) / (l + 1);
    return ways;
}

/* x^0 to x^n. */
static void powers(number x, size_t n, number *to)
{
    to[0] = num(1);
    for (size_t k = 1; k <= n; ++k) to[k] = num_mul(to[k - 1], x);
}

/* All (n-k, k-j, j) in the order of the control points, k outside. */
void bezier_triangle_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    const size_t n = (size_t)argument(arguments, "degree")->number[0];
    const imp_value *faces = argument(arguments, "faces"), *heavy = argument(arguments, "weights");
    number a[11], b[11], c[11];
    powers(num_sub(num(1), p[0]), n, a);
    powers(num_mul(p[0], num_sub(num(1), p[1])), n, b);
    powers(num_mul(p[0], p[1]), n, c);
    number sum[3] = {num(0), num(0), num(0)}, total = num(0);
    size_t count = 0;
    for (size_t k = 0; k <= n; ++k)
        for (size_t j = 0; j <= k; ++j, ++count) {
            const size_t from = faces->count ? (size_t)faces->number[count] : count;
            number weight = num(multinomial((unsigned)n, (unsigned)(k - j), (unsigned)j));
            weight = num_mul(weight, num_mul(a[n - k], num_mul(b[k - j], c[j])));
            if (heavy->count) weight = num_mul(weight, num(heavy->number[from]));
            total = num_add(total, weight);
            for (size_t axis = 0; axis < 3; ++axis)
                sum[axis] =
                    num_add(sum[axis], num_mul(weight, corner(arguments, from, axis, p[2])));
        }
    for (int axis = 0; axis < 3; ++axis) x[axis] = num_div(sum[axis], total);
}

/* --- Superquadric ----------------------------------------------------------------------------- */

/* |s|^p with |s| <= 1, p = 2 / exponent. */
static number magnitude_power(number s, number exponent)
{
    if (num_near(s) == 0) return num(0);
    number fall = num_mul(num_div(num(2), exponent), num_log(num_abs(s)));
    return num_is_less(fall, num(-5000)) ? num(0) : num_exp(fall); /* 10^-2171 at most */
}

/* (cos a, sin a) / (|cos a|^p + |sin a|^p)^(1/p), the greater of the two taken out of the sum. */
static void superellipse(number exponent, number angle, number *x, number *y)
{
    number c = num_cos(angle), s = num_sin(angle);
    bool steep = fabs(num_near(s)) > fabs(num_near(c));
    number great = num_abs(steep ? s : c), ratio = num_div(steep ? c : s, great);
    number sum = num_add(num(1), magnitude_power(ratio, exponent));
    number root = num_exp(num_mul(num_div(exponent, num(2)), num_log(sum)));
    number size = num_mul(great, root);
    *x = num_div(c, size);
    *y = num_div(s, size);
}

void superellipsoid_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number width, height;
    superellipse(argument_at(arguments, "exponents", 1), p[0], &x[0], &x[1]);
    superellipse(argument_at(arguments, "exponents", 0), p[1], &width, &height);
    x[0] = num_mul(width, x[0]);
    x[1] = num_mul(width, x[1]);
    x[2] = height;
    scale_by(arguments, "radii", x);
    add_center(arguments, x);
}

void supertoroid_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number width, height, tube = scalar(arguments, "minor_radius");
    superellipse(argument_at(arguments, "exponents", 1), p[0], &x[0], &x[1]);
    superellipse(argument_at(arguments, "exponents", 0), p[1], &width, &height);
    number radius = num_add(scalar(arguments, "major_radius"), num_mul(tube, width));
    x[0] = num_mul(radius, x[0]);
    x[1] = num_mul(radius, x[1]);
    x[2] = num_mul(tube, height);
    add_center(arguments, x);
}

/* --- Swept ------------------------------------------------------------------------------------ */

static number bernstein(unsigned n, unsigned i, number u)
{
    double choose = 1;
    for (unsigned k = 0; k < i; ++k) choose = choose * (n - k) / (k + 1);
    return num_mul(num(choose), num_mul(num_power(u, i), num_power(num_sub(num(1), u), n - i)));
}

/* A Bezier curve by the names of its points and weights. */
static void curve(const type_arguments *arguments, const char *points, const char *weights,
                  number s, number x[3])
{
    const imp_value *value = argument(arguments, points), *heavy = argument(arguments, weights);
    const size_t count = value->extent[0], width = value->extent[1];
    number sum[3] = {num(0), num(0), num(0)}, total = num(0);
    for (size_t k = 0; k < count; ++k) {
        number weight = bernstein((unsigned)count - 1, (unsigned)k, s);
        if (heavy->count) weight = num_mul(weight, num(heavy->number[k]));
        total = num_add(total, weight);
        for (size_t i = 0; i < width; ++i)
            sum[i] = num_add(sum[i], num_mul(weight, num(value->number[width * k + i])));
    }
    for (size_t i = 0; i < 3; ++i) x[i] = num_div(sum[i], total);
}

void revolution_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number profile[3];
    curve(arguments, "profile", "weights", p[1], profile);
    ring(profile[0], profile[1], p[0], x);
    add_center(arguments, x);
}

void sweep_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number profile[3], path[3];
    curve(arguments, "profile", "profile_weights", p[0], profile);
    curve(arguments, "path", "path_weights", p[1], path);
    for (int i = 0; i < 3; ++i) x[i] = num_add(profile[i], path[i]);
}

void product_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    number c[3], d[3];
    curve(arguments, "c", "c_weights", p[0], c);
    curve(arguments, "d", "d_weights", p[1], d);
    x[0] = num_mul(c[0], d[0]);
    x[1] = num_mul(c[0], d[1]);
    x[2] = c[1];
    scale_by(arguments, "k", x);
    add_center(arguments, x);
}

/* --- NURBS ------------------------------------------------------------------------------------ */

/* One direction's knots. */
typedef struct knot_list {
    const double *at;
    size_t length, degree, count;
} knot_list;

static knot_list knots_along(const type_arguments *arguments, size_t side)
{
    const imp_value *own = argument(arguments, side ? "knots_v" : "knots_u");
    const imp_value *both = argument(arguments, "knots");
    knot_list k = {own->number, own->count, 0, 0};
    if (!own->count) k = (knot_list){both->number + side * both->extent[1], both->extent[1], 0, 0};
    k.degree = (size_t)argument(arguments, "degree")->number[side];
    k.count = k.length - k.degree - 1;
    return k;
}

/* Whether u lies between knots i and i + 1; the domain's end belongs to the span before it. */
static bool is_in_span(const knot_list *k, size_t i, double u)
{
    const double end = k->at[k->count];
    if (k->at[i] >= k->at[i + 1]) return false;
    return (k->at[i] <= u && u < k->at[i + 1]) || (u == end && k->at[i + 1] == end);
}

/* (u - a) / (b - a) n, 0/0 counting as 0. */
static number ramp(double a, double b, number u, number n)
{
    if (a == b || num_near(n) == 0) return num(0);
    return num_mul(num_div(num_sub(u, num(a)), num_sub(num(b), num(a))), n);
}

/* All N_(i,p)(u), p = degree, by their definition from degree 0 on. */
static void b_splines(const knot_list *k, number u, number *n)
{
    for (size_t i = 0; i + 1 < k->length; ++i) n[i] = num(is_in_span(k, i, num_near(u)));
    for (size_t p = 1; p <= k->degree; ++p)
        for (size_t i = 0; i + p + 1 < k->length; ++i) {
            const double *at = k->at + i;
            n[i] = num_add(ramp(at[0], at[p], u, n[i]), ramp(at[p + 1], at[1], u, n[i + 1]));
        }
}

void patch_oracle(const type_arguments *arguments, const weighting along[2], number t, number x[3])
{
    const double *points = argument(arguments, "points")->number;
    const double *velocities = argument(arguments, "velocities")->number;
    const double *weights = argument(arguments, "weights")->number;
    number sum[3] = {num(0), num(0), num(0)}, total = num(0);
    for (size_t k = 0; k < along[0].count * along[1].count; ++k) {
        const number u = along[0].of[k / along[1].count], v = along[1].of[k % along[1].count];
        if (num_near(u) == 0 || num_near(v) == 0) continue;
        number weight = num_mul(u, v);
        if (weights != NULL) weight = num_mul(weight, num(weights[k]));
        total = num_add(total, weight);
        for (size_t axis = 0; axis < 3; ++axis) {
            number at = num(points[3 * k + axis]);
            if (velocities != NULL) at = num_add(at, num_mul(t, num(velocities[3 * k + axis])));
            sum[axis] = num_add(sum[axis], num_mul(weight, at));
        }
    }
    for (int axis = 0; axis < 3; ++axis) x[axis] = num_div(sum[axis], total);
}

void nurbs_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    weighting along[2];
    for (size_t side = 0; side < 2; ++side) {
        const knot_list k = knots_along(arguments, side);
        along[side].count = k.count;
        b_splines(&k, p[side], along[side].of);
    }
    patch_oracle(arguments, along, p[2], x);
}

/* p + u (q - p) + v vector, of the first two points. */
static void side_oracle(const double *p, const double *vector, const number at[2], number x[3])
{
    for (size_t axis = 0; axis < 3; ++axis) {
        const number along = num_mul(at[1], num(vector[axis]));
        const number edge = axis < 2 ? num_sub(num(p[2 + axis]), num(p[axis])) : num(0);
        x[axis] = num_add(num(axis < 2 ? p[axis] : 0), num_add(num_mul(at[0], edge), along));
    }
}

/* Points of the curve and, at v = 1, these plus the vector, each rounded to doubles; of degree 1
 * the first side. */
void extrusion_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    enum { KNOTS_MOST = 64 };
    const imp_value *profile = argument(arguments, "profile");
    const imp_value *degree = argument(arguments, "degree"), *knots = argument(arguments, "knots");
    const double *weights = argument(arguments, "weights")->number;
    const double *vector = argument(arguments, "vector")->number;
    weighting along;
    double made[KNOTS_MOST];
    knot_list k = {.at = knots->count > 0 ? knots->number : made, .count = profile->extent[0]};
    k.degree = degree->count > 0 ? (size_t)degree->number[0] : k.count - 1;
    if (k.degree == 1) {
        side_oracle(profile->number, vector, p, x);
        return;
    }
    k.length = k.count + k.degree + 1;
    for (size_t i = 0; i < k.length; ++i)
        made[i] = i <= k.degree ? 0 : (double)((i < k.count ? i : k.count) - k.degree);
    b_splines(&k, p[0], along.of);
    number sum[3] = {num(0), num(0), num(0)}, total = num(0);
    for (size_t i = 0; i < k.count; ++i) {
        const number weight = num_mul(along.of[i], num(weights != NULL ? weights[i] : 1));
        total = num_add(total, weight);
        for (size_t axis = 0; axis < 3; ++axis) {
            const double from = axis < 2 ? profile->number[2 * i + axis] : 0;
            const double to = from + vector[axis];
            const number at =
                num_add(num_mul(num_sub(num(1), p[1]), num(from)), num_mul(p[1], num(to)));
            sum[axis] = num_add(sum[axis], num_mul(weight, at));
        }
    }
    for (int axis = 0; axis < 3; ++axis) x[axis] = num_div(sum[axis], total);
}
