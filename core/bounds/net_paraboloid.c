/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/net_paraboloid.h"

#include "core/bounds/divided_heights.h"
#include "core/bounds/paraboloid_frame.h"

/* --- What has to be exceeded ------------------------------------------------------------------ */

/* Sizes of what is divided, over both nets and both ends of the window. */
typedef struct sizes {
    double most;         /* of all coordinates computed */
    double change[2][2]; /* how far those across move over the window, for each side */
} sizes;

IMP_QUAD_INLINE double greatest(imp_quad x)
{
    const double p = x[0] > x[1] ? x[0] : x[1], q = x[2] > x[3] ? x[2] : x[3];
    return p > q ? p : q;
}

IMP_QUAD_INLINE double greatest_of(const imp_quad row[4])
{
    imp_quad most = imp_quad_abs(row[0]);
    for (int k = 1; k < 4; ++k) most = imp_quad_max(imp_quad_abs(row[k]), most);
    return greatest(most);
}

IMP_QUAD_INLINE void sizes_take(sizes *s, const placed *p, bool is_flat)
{
    const double z = greatest_of(p->z);
    if (z > s->most) s->most = z;
    for (int i = 0; i < 2 && !is_flat; ++i) {
        const double x = greatest_of(p->x[i]);
        if (x > s->most) s->most = x;
    }
}

IMP_QUAD_INLINE void sizes_take_change(sizes *s, int side, const placed *early, const placed *late)
{
    for (int i = 0; i < 2; ++i) {
        imp_quad by[4];
        for (int k = 0; k < 4; ++k) by[k] = late->x[i][k] - early->x[i][k];
        s->change[side][i] = greatest_of(by);
    }
}

/* Bounds the greatest sum of a row of the Gram matrix of the paraboloid's vectors: no linear
 * combination is longer than its root times the root of the sum of the squared coefficients. */
static double gram_upper(const net_paraboloid *d)
{
    const vec3 *v[3] = {&d->normal, &d->across[0], &d->across[1]};
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        double row = 0;
        for (int j = 0; j < 3; ++j) row += fabs(vec3_dot(*v[i], *v[j]));
        if (row > most) most = row;
    }
    return most + 0x1p-45; /* 3 + 2 roundings of 9 * 1.125^2 < 12 at most: < 2^-46 */
}

/* The greatest numbers of a paraboloid. */
#define PARABOLOID_LARGE 0x1p200

static bool is_usable(const net_paraboloid *d)
{
    bool fine = fabs(d->time) < PARABOLOID_LARGE;
    for (int i = 0; i < 3; ++i)
        fine = fine && fabs(d->normal.x[i]) <= 1.125 && fabs(d->across[0].x[i]) <= 1.125 &&
               fabs(d->across[1].x[i]) <= 1.125 && fabs(d->at.x[i]) < PARABOLOID_LARGE &&
               fabs(d->velocity.x[i]) < PARABOLOID_LARGE;
    return fine && fabs(d->bend[0]) < PARABOLOID_LARGE && fabs(d->bend[1]) < PARABOLOID_LARGE;
}

static bool serves(const net *f)
{
    return f != NULL && !f->is_weighted && f->degree[0] <= 3 && f->degree[1] <= 3;
}

/* The heights of a side are +-z - sum_i by_i x_i^2; the sum of both sides' least ones has to exceed
 * `limit`. */
typedef struct heights_rule {
    double by[2][2]; /* of A, of B */
    double limit;
} heights_rule;

/* Half of how a side's squares count in its heights, which are negative for A. */
IMP_QUAD_INLINE double half_sign(int side) { return side == 0 ? -0.5 : 0.5; }

/* Lemma (paraboloid). Let f(x) be normal.X - sum_i bend_i (across_i.X)^2 / 2. grad f is a
 * combination of normal and across_i with the coefficients 1 and -bend_i across_i.X, so that
 * |grad f| is at most g(x) = R (1 + sum_i (bend_i across_i.X)^2 / 2), R the root of gram_upper or
 * 1, if that is more, since the root of 1 + z is at most 1 + z / 2. grad f is linear, so its length
 * between x and y is at most the greater of g(x) and g(y), which are at least 1: at most g(x) +
 * g(y) - 1. Hence for points x and y within `near` of each other f(y) - f(x) <= near (g(x) + g(y) -
 * 1), that is
 *
 *   h_B(y) + h_A(x) <= near (2 R - 1),   h = +-f - near R sum_i (bend_i across_i.X)^2 / 2.
 *
 * Surfaces are within their nets' errors of the patches: `near` is gamma_clear and both errors.
 * Roundings of by_i are 4 u (|bend_i| + near R bend_i^2) / 2 at most (DIVIDED_ROUNDING). */
IMP_QUAD_INLINE heights_rule rule_of(const net_paraboloid *d, double near, double root)
{
    heights_rule r = {.limit = near * (2 * root - 1)};
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 2; ++i)
            r.by[side][i] =
                half_sign(side) * d->bend[i] + 0.5 * (near * root) * (d->bend[i] * d->bend[i]);
    return r;
}

/* What the sum has to exceed at the window's end, and beyond that at its start. */
typedef struct limits {
    double end, more_at_start;
} limits;

/* Lemma (window). For fixed (u, v) h is of second order in time: it is (1 - r) h_0 + r h_1 -
 * c r (1 - r) / 2 at the part r of the window. c is its second derivative by r, at most the sum of
 * the -2 by_i change_i^2 that are above 0. Let a and b be by how much the least of both sides' h
 * exceed the limit, together, at start and end, and C the sum of both sides' c. With a, b > 0 and
 * a + b >= C / 2 the limit is exceeded at all r, by at least
 *
 *   (1 - r) a + r b - C r (1 - r) / 2 >= (1 - r)^2 a + r^2 b + r (1 - r) (a + b - C / 2) > 0.
 *
 * At one time h is a polynomial of order (6, 6), whose least value is no less than the least of its
 * Bernstein coefficients, or of those of its parts. Rounding of these, for each side, with E =
 * PLACE_ROUNDING u S, V = most, B = sum_i (|bend_i| + near R bend_i^2) >= 2 sum_i |by_i|;
 * DIVIDED_ROUNDING (divided_heights.h) is that of coefficients, of V + B V^2:
 *
 *   places          E along the normal, |by_i| (2 V E + E^2) of each square
 *   coefficients    DIVIDED_ROUNDING u (V + B V^2) */
IMP_QUAD_INLINE limits limits_upper(const net_paraboloid *d, const heights_rule *rule,
                                    const sizes *s, double size, double near_by_root)
{
    const double off = PLACE_ROUNDING * UNIT_ROUNDOFF * size;
    double bends = 0, curved = 0;
    for (int i = 0; i < 2; ++i) {
        bends += fabs(d->bend[i]) + near_by_root * d->bend[i] * d->bend[i];
        for (int side = 0; side < 2; ++side) {
            const double change = s->change[side][i] + 2 * off, by = rule->by[side][i];
            if (by < 0) curved -= by * change * change;
        }
    }
    bends = padded_upper(bends, 16);
    const double slack = off * (1 + bends * (s->most + off)) +
                         DIVIDED_ROUNDING * UNIT_ROUNDOFF * (s->most + bends * s->most * s->most);
    return (limits){padded_upper(rule->limit + 2 * slack, 32) + 0x1p-490,
                    padded_upper(curved, 32) + slack};
}

PAD_COVERS(16, 6); /* bends: products 3, sums 3 */
PAD_COVERS(32,
           15); /* the slack 8, the rule's limit 3, their sum; `curved`: changes, products, sums */

/* --- The proof -------------------------------------------------------------------------------- */

/* Both nets at one time. */
typedef struct placed_nets {
    placed of[2];
} placed_nets;

/* Whether the corners of the patches, which are on them, permit that the limit is exceeded. */
IMP_QUAD_INLINE bool corners_exceed(const placed_nets *p, const heights_rule *rule, bool is_flat,
                                    double limit)
{
    double sum = 0;
    for (int side = 0; side < 2; ++side)
        sum +=
            divided_top(p->of[side].z, p->of[side].x, 2 * half_sign(side), rule->by[side], is_flat);
    return sum > limit;
}

IMP_QUAD_INLINE void divide_both(const placed_nets *p, const heights_rule *rule, bool is_flat,
                                 divided_heights h[2])
{
    for (int side = 0; side < 2; ++side)
        divided_begin(&h[side], p->of[side].z, p->of[side].x, 2 * half_sign(side), rule->by[side],
                      is_flat);
}

IMP_QUAD_INLINE void place_both(const net *const nets[2], const net_paraboloid *d, double t,
                                bool is_flat, int first, placed_nets *p)
{
    for (int side = 0; side < 2; ++side) place_rows(nets[side], d, t, is_flat, first, &p->of[side]);
}

/* What fails fails at the window's end, mostly: there the heights have to exceed the least limit,
 * without rounding, before the start is looked at. */
IMP_QUAD_INLINE bool parts_by(const node *a, const node *b, const net_paraboloid *d,
                              double gamma_clear, const time_window *w, bool is_flat)
{
    const net *const nets[2] = {node_net_made(a), node_net_made(b)};
    const double near = padded_upper(gamma_clear + (net_off(nets[0]) + net_off(nets[1])), 8);
    heights_rule rule = rule_of(d, near, 1);
    placed_nets early, late;
    divided_heights h[2];
    sizes s = {.most = 0};
    place_both(nets, d, w->hi, is_flat, 0, &late);
    if (!corners_exceed(&late, &rule, is_flat, near)) return false;
    place_both(nets, d, w->hi, is_flat, 1, &late);
    const double gram = gram_upper(d), root = gram > 1 ? padded_upper(sqrt(gram), 4) : 1;
    rule = rule_of(d, near, root);
    if (!corners_exceed(&late, &rule, is_flat, rule.limit)) return false;
    divide_both(&late, &rule, is_flat, h);
    if (!divided_exceed(h, rule.limit, is_flat)) return false;
    for (int first = 0; first < 2; ++first) place_both(nets, d, w->lo, is_flat, first, &early);
    for (int side = 0; side < 2; ++side) {
        sizes_take(&s, &late.of[side], is_flat);
        sizes_take(&s, &early.of[side], is_flat);
    }
    for (int side = 0; side < 2 && !is_flat; ++side)
        sizes_take_change(&s, side, &early.of[side], &late.of[side]);
    const double size = size_of(nets[0], d, w) + size_of(nets[1], d, w);
    const limits over = limits_upper(d, &rule, &s, size, near * root);
    const double at_start = over.end + over.more_at_start;
    if (!(size < PARABOLOID_LARGE && at_start < INFINITY)) return false;
    if (!corners_exceed(&early, &rule, is_flat, at_start)) return false;
    if (!divided_exceed(h, over.end, is_flat)) return false;
    divide_both(&early, &rule, is_flat, h);
    return divided_exceed(h, at_start, is_flat);
}

IMP_QUAD_INLINE bool parts(const node *a, const node *b, const net_paraboloid *d,
                           double gamma_clear, const time_window *w)
{
    return d->bend[0] == 0 && d->bend[1] == 0 ? parts_by(a, b, d, gamma_clear, w, true)
                                              : parts_by(a, b, d, gamma_clear, w, false);
}

IMP_QUAD_NARROW static bool parts_narrow(const node *a, const node *b, const net_paraboloid *d,
                                         double gamma_clear, const time_window *w)
{
    return parts(a, b, d, gamma_clear, w);
}

IMP_QUAD_WIDE static bool parts_wide(const node *a, const node *b, const net_paraboloid *d,
                                     double gamma_clear, const time_window *w)
{
    return parts(a, b, d, gamma_clear, w);
}

bool net_paraboloid_parts(const node *a, const node *b, const net_paraboloid *d, double gamma_clear,
                          const time_window *window)
{
    if (!serves(node_net_made(a)) || !serves(node_net_made(b)) || !is_usable(d)) return false;
    return imp_quad_is_wide() ? parts_wide(a, b, d, gamma_clear, window)
                              : parts_narrow(a, b, d, gamma_clear, window);
}
