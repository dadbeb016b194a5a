/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/map_oracle.h"

#include <stdlib.h>
#include <string.h>

/* --- Vectors ---------------------------------------------------------------------------------- */

static void vector(const type_arguments *arguments, const char *name, number v[3])
{
    for (size_t i = 0; i < 3; ++i) v[i] = argument_at(arguments, name, i);
}

static number dot(const number a[3], const number b[3])
{
    return num_add(num_add(num_mul(a[0], b[0]), num_mul(a[1], b[1])), num_mul(a[2], b[2]));
}

static void cross(const number a[3], const number b[3], number out[3])
{
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = num_sub(num_mul(a[j], b[k]), num_mul(a[k], b[j]));
    }
}

static void normalize(number v[3])
{
    number length = num_sqrt(dot(v, v));
    for (int i = 0; i < 3; ++i) v[i] = num_div(v[i], length);
}

static void unit(const type_arguments *arguments, const char *name, number v[3])
{
    vector(arguments, name, v);
    normalize(v);
}

static void from_center(const type_arguments *arguments, const number p[4], number w[3])
{
    for (size_t i = 0; i < 3; ++i) w[i] = num_sub(p[i], argument_at(arguments, "center", i));
}

static void add_center(const type_arguments *arguments, number x[3])
{
    for (size_t i = 0; i < 3; ++i) x[i] = num_add(x[i], argument_at(arguments, "center", i));
}

static void add_multiple(number x[3], number factor, const number v[3])
{
    for (int i = 0; i < 3; ++i) x[i] = num_add(x[i], num_mul(factor, v[i]));
}

/* Rodrigues: w cos A + (k x w) sin A + k (k.w) (1 - cos A). */
static void turn(const number k[3], number angle, const number w[3], number x[3])
{
    number along = num_mul(dot(k, w), num_sub(num(1), num_cos(angle))), across[3];
    cross(k, w, across);
    for (int i = 0; i < 3; ++i) x[i] = num_mul(w[i], num_cos(angle));
    add_multiple(x, num_sin(angle), across);
    add_multiple(x, along, k);
}

static number limit(number x, number lo, number hi)
{
    number half = num(0.5);
    x = num_mul(half, num_add(num_add(x, lo), num_abs(num_sub(x, lo))));
    return num_mul(half, num_sub(num_add(x, hi), num_abs(num_sub(x, hi))));
}

static number in_time(const type_arguments *arguments, const char *name, number t)
{
    const imp_value *all = argument(arguments, name);
    return num_poly(all->number, all->count, 1, t);
}

/* --- Maps by one formula ---------------------------------------------------------------------- */

void scale_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const imp_value *factor = argument(arguments, "factor");
    const imp_value *factors = argument(arguments, "factors");
    size_t rows = factor->count ? 1 : factors->extent[0];
    const imp_value *given = factor->count ? factor : factors;
    size_t width = given->count / rows;
    from_center(arguments, p, x);
    for (size_t i = 0; i < 3; ++i)
        x[i] = num_mul(x[i], num_poly(given->number + (width == 1 ? 0 : i), rows, width, p[3]));
    add_center(arguments, x);
}

void screw_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const imp_value *rate = argument(arguments, "rate");
    number k[3], w[3], angle;
    angle = rate->count ? num_mul(num(rate->number[0]), p[3]) : in_time(arguments, "angle", p[3]);
    unit(arguments, "axis", k);
    from_center(arguments, p, w);
    turn(k, angle, w, x);
    number way = num_mul(argument_at(arguments, "pitch", 0), angle);
    add_multiple(x, num_div(way, num_mul(num(2), num_pi())), k);
    add_center(arguments, x);
}

void taper_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    number lo = argument_at(arguments, "range", 0), hi = argument_at(arguments, "range", 1);
    number start = in_time(arguments, "start", p[3]), end = in_time(arguments, "end", p[3]);
    number k[3], w[3];
    unit(arguments, "axis", k);
    from_center(arguments, p, w);
    number h = dot(k, w), part = num_div(num_sub(limit(h, lo, hi), lo), num_sub(hi, lo));
    number factor = num_add(num_mul(start, num_sub(num(1), part)), num_mul(end, part));
    for (int i = 0; i < 3; ++i) x[i] = num_mul(factor, w[i]);
    add_multiple(x, num_mul(h, num_sub(num(1), factor)), k);
    add_center(arguments, x);
}

void twist_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    number k[3], w[3];
    unit(arguments, "axis", k);
    from_center(arguments, p, w);
    turn(k, num_mul(in_time(arguments, "rate", p[3]), dot(k, w)), w, x);
    add_center(arguments, x);
}

/* With no curvature at all nothing moves. */
void bend_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    number lo = argument_at(arguments, "range", 0), hi = argument_at(arguments, "range", 1);
    number c = in_time(arguments, "curvature", p[3]), k[3], a[3], n[3], w[3];
    unit(arguments, "axis", k);
    vector(arguments, "along", a);
    cross(k, a, n);
    normalize(n);
    cross(n, k, a);
    from_center(arguments, p, w);
    number y = dot(a, w), z = dot(n, w), bent = limit(y, lo, hi), beyond = num_sub(y, bent);
    number angle = num_mul(c, bent), sine = num_sin(angle), cosine = num_cos(angle);
    if (num_near(c) != 0) {
        number radius = num_div(num(1), c), rest = num_sub(z, radius);
        y = num_sub(num_mul(beyond, cosine), num_mul(sine, rest));
        z = num_add(radius, num_add(num_mul(cosine, rest), num_mul(beyond, sine)));
    }
    for (int i = 0; i < 3; ++i) x[i] = num_mul(k[i], dot(k, w));
    add_multiple(x, y, a);
    add_multiple(x, z, n);
    add_center(arguments, x);
}

void wave_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const imp_value *amplitude = argument(arguments, "amplitude");
    const imp_value *amplitudes = argument(arguments, "amplitudes");
    number k[3];
    vector(arguments, "wave_vector", k);
    number way = num_mul(num_mul(num_sqrt(dot(k, k)), argument_at(arguments, "speed", 0)), p[3]);
    number phase = num_add(num_sub(dot(k, p), way), argument_at(arguments, "phase", 0));
    for (size_t i = 0; i < 3; ++i) {
        number most = amplitude->count
                          ? num(amplitude->number[i])
                          : num_poly(amplitudes->number + i, amplitudes->extent[0], 3, p[3]);
        x[i] = num_add(p[i], num_mul(most, num_sin(phase)));
    }
}

/* --- Keyframes: Hermite's basis, quaternion products ------------------------------------------ */

typedef struct track {
    const double *time;
    size_t keys;
    number value[16];            /* of one lane */
    bool sloped, bent;           /* whether slopes, and second derivatives, are given: */
    number given[16], bends[16]; /* these */
} track;

static number step(const track *g, size_t i)
{
    return num_sub(num(g->time[i + 1]), num(g->time[i]));
}

static number secant(const track *g, size_t i)
{
    return num_div(num_sub(g->value[i + 1], g->value[i]), step(g, i));
}

/* From the key before to the key after. At an end so that the piece is a parabola: there the secant
 * is the mean of both slopes. */
static number slope(const track *g, size_t i)
{
    bool first = i == 0, last = i == g->keys - 1;
    if (g->sloped) return g->given[i];
    if (g->keys == 2) return secant(g, 0);
    if (first) return num_sub(num_mul(num(2), secant(g, 0)), slope(g, 1));
    if (last) return num_sub(num_mul(num(2), secant(g, i - 1)), slope(g, i - 1));
    return num_div(num_sub(g->value[i + 1], g->value[i - 1]),
                   num_sub(num(g->time[i + 1]), num(g->time[i - 1])));
}

static number track_at(const track *g, size_t i, number t)
{
    number h = step(g, i), s = num_div(num_sub(t, num(g->time[i])), h), r = num_sub(num(1), s);
    number ss = num_sqr(s), rr = num_sqr(r);
    number from = num_mul(rr, num_add(num(1), num_mul(num(2), s)));
    number to = num_mul(ss, num_add(num(1), num_mul(num(2), r)));
    number x = num_add(num_mul(from, g->value[i]), num_mul(to, g->value[i + 1]));
    x = num_add(x, num_mul(num_mul(h, num_mul(rr, s)), slope(g, i)));
    return num_sub(x, num_mul(num_mul(h, num_mul(ss, r)), slope(g, i + 1)));
}

/* s^3 (1 + 3 r + 6 r^2), s^3 (1 + 3 r), s^3: r = 1 - s. */
static void quintic_basis(number s, number basis[3])
{
    const number r = num_sub(num(1), s), cube = num_mul(s, num_sqr(s));
    const number line = num_add(num(1), num_mul(num(3), r));
    basis[0] = num_mul(cube, num_add(line, num_mul(num(6), num_sqr(r))));
    basis[1] = num_mul(cube, line);
    basis[2] = cube;
}

/* Hermite's quintic: values, h s r slopes and h^2/2 s^2 r^2 second derivatives, by the basis. */
static number quintic_at(const track *g, size_t i, number t)
{
    const number h = step(g, i), s = num_div(num_sub(t, num(g->time[i])), h);
    const number r = num_sub(num(1), s), half = num_mul(num(0.5), num_sqr(h));
    number from[3], to[3];
    quintic_basis(r, from);
    quintic_basis(s, to);
    number x = num_add(num_mul(from[0], g->value[i]), num_mul(to[0], g->value[i + 1]));
    x = num_add(x, num_mul(num_mul(h, num_mul(s, from[1])), slope(g, i)));
    x = num_sub(x, num_mul(num_mul(h, num_mul(r, to[1])), slope(g, i + 1)));
    x = num_add(x, num_mul(num_mul(half, num_mul(num_sqr(s), from[2])), g->bends[i]));
    return num_add(x, num_mul(num_mul(half, num_mul(num_sqr(r), to[2])), g->bends[i + 1]));
}

static size_t piece_at(const track *g, double t)
{
    size_t i = 0;
    while (i + 2 < g->keys && g->time[i + 1] <= t) ++i;
    return i;
}

static double sign_of_key(const double *q, size_t i)
{
    double sign = 1;
    for (size_t k = 1; k <= i; ++k) {
        const double *a = q + 4 * (k - 1), *b = q + 4 * k;
        if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0) sign = -sign;
    }
    return sign;
}

static void quaternion_track(const imp_value *rotations, size_t lane, track *g)
{
    for (size_t i = 0; i < g->keys; ++i) {
        const double *q = rotations->number + 4 * i;
        number square = num(0);
        for (int j = 0; j < 4; ++j) square = num_add(square, num_sqr(num(q[j])));
        g->value[i] = num_div(num(sign_of_key(rotations->number, i) * q[lane]), num_sqrt(square));
    }
}

static void quaternion_product(const number a[4], const number b[4], number c[4])
{
    number turned[3];
    cross(a + 1, b + 1, turned);
    c[0] = num_sub(num_mul(a[0], b[0]), dot(a + 1, b + 1));
    for (int i = 1; i < 4; ++i)
        c[i] = num_add(num_add(num_mul(a[0], b[i]), num_mul(b[0], a[i])), turned[i - 1]);
}

/* q x q* / |q|^2 */
static void turn_by_quaternion(const number q[4], number x[3])
{
    number reversed[4] = {q[0], num_neg(q[1]), num_neg(q[2]), num_neg(q[3])};
    number point[4] = {num(0), x[0], x[1], x[2]}, half[4], whole[4], square[4];
    quaternion_product(q, point, half);
    quaternion_product(half, reversed, whole);
    quaternion_product(q, reversed, square);
    for (int i = 0; i < 3; ++i) x[i] = num_div(whole[i + 1], square[0]);
}

static number held(const type_arguments *arguments, number t)
{
    const imp_value *times = argument(arguments, "times");
    if (argument(arguments, "hold")->number[0] == 0) return t;
    return limit(t, num(times->number[0]), num(times->number[times->count - 1]));
}

static number line_at(const track *g, size_t i, number t)
{
    const number passed = num_sub(t, num(g->time[i]));
    return num_add(g->value[i], num_mul(secant(g, i), passed));
}

/* Column i of rows, one for each key. False: there are none. */
static bool fill_lane(const imp_value *rows, size_t keys, size_t i, number *lane)
{
    for (size_t k = 0; k < keys && rows->count > 0; ++k)
        lane[k] = num(rows->number[k * (rows->count / keys) + i]);
    return rows->count > 0;
}

bool table_oracle(const type_arguments *arguments, const char *values, size_t i, number t,
                  number *x)
{
    const imp_value *times = argument(arguments, "times"), *rows = argument(arguments, values);
    if (times->count == 0) return false;
    track g = {.time = times->number, .keys = times->count};
    if (g.keys > 16) abort();
    fill_lane(rows, g.keys, i, g.value);
    g.sloped = fill_lane(argument(arguments, "velocities"), g.keys, i, g.given);
    g.bent = fill_lane(argument(arguments, "accelerations"), g.keys, i, g.bends);
    t = held(arguments, t);
    const size_t piece = piece_at(&g, num_near(t));
    const char *way = argument(arguments, "interpolation")->string[0];
    const bool straight = strcmp(way, "linear") == 0 && !g.sloped;
    if (g.bent)
        *x = quintic_at(&g, piece, t);
    else
        *x = straight ? line_at(&g, piece, t) : track_at(&g, piece, t);
    return true;
}

void keyframes_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const imp_value *times = argument(arguments, "times");
    const imp_value *positions = argument(arguments, "positions");
    const imp_value *rotations = argument(arguments, "rotations");
    track g = {.time = times->number, .keys = times->count};
    const number t = held(arguments, p[3]);
    const size_t piece = piece_at(&g, num_near(t));
    number q[4];
    if (g.keys > 16) abort();
    for (int i = 0; i < 3; ++i) x[i] = p[i];
    for (size_t lane = 0; lane < 4 && rotations->count; ++lane) {
        quaternion_track(rotations, lane, &g);
        q[lane] = track_at(&g, piece, t);
    }
    if (rotations->count) turn_by_quaternion(q, x);
    for (size_t lane = 0; lane < 3 && positions->count; ++lane) {
        for (size_t i = 0; i < g.keys; ++i) g.value[i] = num(positions->number[3 * i + lane]);
        x[lane] = num_add(x[lane], track_at(&g, piece, t));
    }
}

/* --- Trajectories ----------------------------------------------------------------------------- */

/* x turned by the unit quaternion of key i. */
static void turn_by_key(const imp_value *rotations, size_t i, number x[3])
{
    number q[4];
    for (size_t j = 0; j < 4; ++j) q[j] = num(rotations->number[4 * i + j]);
    turn_by_quaternion(q, x);
}

/* x turned by the spin of piece i for the time s. */
static void turn_by_spin(const imp_value *spins, size_t i, number s, number x[3])
{
    number k[3], w[3] = {x[0], x[1], x[2]};
    const double *spin = spins->number + 3 * i;
    for (int j = 0; j < 3; ++j) k[j] = num(spin[j]);
    if (spin[0] == 0 && spin[1] == 0 && spin[2] == 0) return;
    const number angle = num_mul(num_sqrt(dot(k, k)), s);
    normalize(k);
    turn(k, angle, w, x);
}

void trajectory_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const imp_value *times = argument(arguments, "times");
    const imp_value *positions = argument(arguments, "positions");
    const imp_value *accelerations = argument(arguments, "accelerations");
    const imp_value *rotations = argument(arguments, "rotations");
    const imp_value *spins = argument(arguments, "spins");
    track g = {.time = times->number, .keys = times->count};
    const size_t i = piece_at(&g, num_near(p[3]));
    const number h = step(&g, i), s = num_sub(p[3], num(g.time[i])), part = num_div(s, h);
    from_center(arguments, p, x);
    if (rotations->count) {
        number early[3] = {x[0], x[1], x[2]}, late[3] = {x[0], x[1], x[2]}, end[3];
        turn_by_key(rotations, i, early);
        turn_by_key(rotations, i + 1, late);
        for (int k = 0; k < 3; ++k) x[k] = end[k] = early[k];
        turn_by_spin(spins, i, s, x);
        turn_by_spin(spins, i, h, end);
        for (int k = 0; k < 3; ++k) x[k] = num_add(x[k], num_mul(part, num_sub(late[k], end[k])));
    }
    for (size_t k = 0; k < 3; ++k) {
        const number from = num(positions->number[3 * i + k]);
        const number to = num(positions->number[3 * i + 3 + k]);
        x[k] = num_add(x[k], num_add(from, num_mul(part, num_sub(to, from))));
        if (!accelerations->count) continue;
        const number a = num_div(num(accelerations->number[3 * i + k]), num(2));
        x[k] = num_sub(x[k], num_mul(a, num_mul(s, num_sub(h, s))));
    }
}

/* --- Free-form deformation: the control points themselves ------------------------------------- */

static number bernstein(unsigned n, unsigned i, number u)
{
    double choose = 1;
    for (unsigned k = 0; k < i; ++k) choose = choose * (n - k) / (k + 1);
    number rest = num_power(num_sub(num(1), u), n - i);
    return num_mul(num(choose), num_mul(num_power(u, i), rest));
}

void ffd_oracle(const type_arguments *arguments, const number p[4], number x[3])
{
    const double *points = argument(arguments, "points")->number;
    const double *velocities = argument(arguments, "velocities")->number;
    number along[3][16];
    unsigned side[3];
    for (size_t j = 0; j < 3; ++j) {
        number lo = argument_at(arguments, "lo", j), hi = argument_at(arguments, "hi", j);
        number inside = limit(p[j], lo, hi), a = num_div(num_sub(inside, lo), num_sub(hi, lo));
        side[j] = (unsigned)argument(arguments, "lattice")->number[j];
        for (unsigned i = 0; i < side[j]; ++i) along[j][i] = bernstein(side[j] - 1, i, a);
        x[j] = num_sub(p[j], inside);
    }
    for (unsigned i = 0; i < side[0] * side[1] * side[2]; ++i) {
        const unsigned at[3] = {i / side[2] / side[1], i / side[2] % side[1], i % side[2]};
        number weight = num_mul(num_mul(along[0][at[0]], along[1][at[1]]), along[2][at[2]]);
        for (unsigned axis = 0; axis < 3; ++axis) {
            number point = num(points[3 * i + axis]);
            if (velocities != NULL)
                point = num_add(point, num_mul(p[3], num(velocities[3 * i + axis])));
            x[axis] = num_add(x[axis], num_mul(weight, point));
        }
    }
}
