/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/net_series.h"

#include "core/tree/model_lanes.h"
#include "core/tree/net_rows.h"

#define SERIES_UNROLL _Pragma("GCC unroll 4")

/* --- The series ------------------------------------------------------------------------------- */

/* The Chebyshev coefficients of four cubics side by side, of control points p over s in [-1, 1].
 * With A = p0 + p3, B = p1 + p2, C = p3 - p0, D = p2 - p1:
 *
 *   c2 = 3 (A - B) / 16,  c0 = A / 2 - c2,  c3 = (C - 3 D) / 32,  c1 = C / 2 - c3,
 *
 * since the even and the odd part at s = 1 are c0 + c2 = A / 2 and c1 + c3 = C / 2. */
IMP_QUAD_INLINE rows series_of(rows p)
{
    const imp_quad half = imp_quad_all(0.5), three = imp_quad_all(3), *const r = p.row;
    const imp_quad a = r[0] + r[3], b = r[1] + r[2], c = r[3] - r[0], d = r[2] - r[1];
    const imp_quad even = imp_quad_all(3.0 / 16) * (a - b);
    const imp_quad odd = imp_quad_all(1.0 / 32) * (c - three * d);
    return (rows){{half * a - even, half * c - odd, even, odd}};
}

/* The series along u of three columns of a net: x, y and z. */
typedef struct columns {
    rows of[3];
} columns;

IMP_QUAD_INLINE columns columns_along_u(const double *x)
{
    columns c;
    SERIES_UNROLL
    for (int i = 0; i < 3; ++i) c.of[i] = series_of(rows_at(x + 16 * i));
    return c;
}

/* Coefficients of T_k(s_u) T_l(s_v), l from 0 to 3; each of x, y, z and a 0 side by side. */
IMP_QUAD_INLINE rows row_of_series(const columns *c, int k)
{
    return series_of(
        rows_turned((rows){{c->of[0].row[k], c->of[1].row[k], c->of[2].row[k], imp_quad_all(0)}}));
}

/* --- The models ------------------------------------------------------------------------------- */

/* Sums over a series of X + t Y: x holds X at the region's middle time, y holds Y times half the
 * region's duration; the size of a coefficient is |X| + |Y|. */
typedef struct series_sums {
    imp_quad x[3][3];   /* X_kl, k + l <= 2 */
    imp_quad y[2][2];   /* Y_kl, k + l <= 1 */
    imp_quad rest;      /* sum of sizes, where k + l >= 3, and of |Y|, where k + l = 2 */
    imp_quad along_u;   /* sum of k^2 size */
    imp_quad column[4]; /* sum of sizes, for each l */
    imp_quad speed;     /* sum of |Y| */
} series_sums;

/* Adds x to a sum that it begins if `first`. */
IMP_QUAD_INLINE void add_to(imp_quad *sum, imp_quad x, bool first)
{
    if (first)
        *sum = x;
    else
        *sum += x;
}

/* Adds the coefficients of T_k(s_u), from k = 0 on. */
IMP_QUAD_INLINE void sums_add(series_sums *sum, int k, const rows *x, const rows *y)
{
    imp_quad row = imp_quad_all(0);
    SERIES_UNROLL
    for (int l = 0; l < 4; ++l) {
        imp_quad size = imp_quad_abs(x->row[l]);
        if (y != NULL) {
            const imp_quad change = imp_quad_abs(y->row[l]);
            size += change;
            add_to(&sum->speed, change, k + l == 0);
            if (k + l <= 1) sum->y[k][l] = y->row[l];
            if (k + l == 2) add_to(&sum->rest, change, k == 0);
        }
        if (k + l <= 2) sum->x[k][l] = x->row[l];
        if (k + l >= 3) add_to(&sum->rest, size, y == NULL && k == 0);
        add_to(&row, size, l == 0);
        add_to(&sum->column[l], size, k == 0);
    }
    if (k > 0) add_to(&sum->along_u, imp_quad_all(k * k) * row, k == 1);
}

IMP_QUAD_INLINE void sums_take(const net *p, double middle, double half, bool is_moving,
                               series_sums *sum)
{
    const imp_quad none = imp_quad_all(0), late = imp_quad_all(middle), by = imp_quad_all(half);
    const columns still = columns_along_u(p->numbers);
    columns moving;
    if (is_moving) moving = columns_along_u(p->numbers + 3 * 16);
    sum->speed = sum->y[0][0] = sum->y[0][1] = sum->y[1][0] = none;
    SERIES_UNROLL
    for (int k = 0; k < 4; ++k) {
        rows x = row_of_series(&still, k), y;
        if (is_moving) y = row_of_series(&moving, k);
        SERIES_UNROLL
        for (int l = 0; l < 4 && is_moving; ++l) {
            x.row[l] += late * y.row[l];
            y.row[l] = by * y.row[l];
        }
        sums_add(sum, k, &x, is_moving ? &y : NULL);
    }
}

/* Returns an upper bound of b s + q s^2 on [-1, 1], from its ends and the vertex -b^2 / 4q, which
 * is inside only if |b| < 2 |q| and then at most |b| / 2 from 0. */
IMP_QUAD_INLINE imp_quad bow_upper(imp_quad b, imp_quad q)
{
    return imp_quad_max(q + imp_quad_abs(b), imp_quad_all(0.5) * imp_quad_abs(b));
}

/* Lemma. T_2 = 2 s^2 - 1, so X_20 T_2 is 2 X_20 s^2 and -X_20 of the constant. The terms left out
 * are at most the sum of their sizes, as |T_k| <= 1, and the patch is within the net's error of the
 * surface. Rounding, in units of u M, M = `most` >= |X| + |t - time| |Y| of each control point:
 *
 *   series     each direction: c0 takes 4 roundings, c1 as many, of |A| / 2 + 3 (|A| + |B|) / 16
 *              and so on: of 4 M for all four; both directions 16 M, of which each term has 8
 *              roundings; X + middle Y, whose middle is rounded, has 3 more, half Y one:
 *              (8 + 3 + 1) 16
 *   constant   two sums of 3.25 at most, and one with the place: 7 + 4
 *   middle     lo + hi is 2 c, so only d is rounded, up by 7 units at most: s differs from the
 *              net's by at most 7 u |s|; a cubic within M has a slope of 3 M: both directions
 *              2 * 21
 *
 * Numbers of a net that was halved are within 2 `most` (net.c). Of |place| + |t - time| |drift|:
 * products and sums 8, twice for the range. Each of 16 coefficients passes at most 8 products,
 * which underflow by 2^-1075 each, those of velocities times less than 2^301 (NET_LARGE): 2^-767 in
 * all. */
enum { SERIES_ROUNDING = 512, PLACE_ROUNDING = 16 };
_Static_assert(2 * ((8 + 3 + 1) * 16 + 7 + 4 + 2 * 21) <= SERIES_ROUNDING, "rounding of a series");
_Static_assert(2 * 8 <= PLACE_ROUNDING, "rounding of its place");
#define SERIES_UNDERFLOW 0x1p-700

IMP_QUAD_INLINE imp_quad rounding_upper(const net *p, imp_quad far)
{
    const imp_quad tiny = {SERIES_UNDERFLOW, SERIES_UNDERFLOW, SERIES_UNDERFLOW, 0};
    return imp_quad_all(SERIES_ROUNDING * UNIT_ROUNDOFF) * imp_quad_load(p->most) +
           imp_quad_all(PLACE_ROUNDING * UNIT_ROUNDOFF) * far + tiny;
}

PAD_COVERS(64, 13 + 16 + 2); /* rest: thirteen sums, sums of sizes; the net's error, and rounding */
PAD_COVERS(16, 1 + 1 + 3 + 1 + 1 +
                   1); /* range: a bow, both bows, mixed terms, their sum, rounding, the end */

IMP_QUAD_INLINE void models_of(const net *p, const imp_region *region, bool is_moving,
                               model_lanes *m)
{
    const double middle = region->c[2] - p->time, half = region->d[2];
    const imp_quad place = imp_quad_load(p->place), drift = imp_quad_load(p->drift);
    series_sums sum;
    sums_take(p, middle, half, is_moving, &sum);
    const imp_quad far =
        imp_quad_abs(place) + imp_quad_all(fabs(middle) + half) * imp_quad_abs(drift);
    const imp_quad rounding = rounding_upper(p, far), two = imp_quad_all(2);
    const imp_quad travel = imp_quad_all(half) * drift + sum.y[0][0];
    m->a = place + imp_quad_all(middle) * drift + (sum.x[0][0] - sum.x[2][0] - sum.x[0][2]);
    m->b[0] = sum.x[1][0], m->b[1] = sum.x[0][1], m->b[2] = travel;
    m->q[IMP_UU] = two * sum.x[2][0], m->q[IMP_VV] = two * sum.x[0][2];
    m->q[IMP_UV] = sum.x[1][1], m->q[IMP_TT] = imp_quad_all(0);
    m->q[IMP_UT] = sum.y[1][0], m->q[IMP_VT] = sum.y[0][1];
    m->e = quad_padded_upper(sum.rest + imp_quad_load(p->error), 64) + rounding;
    const imp_quad uu = m->q[IMP_UU], vv = m->q[IMP_VV];
    const imp_quad mixed = imp_quad_abs(travel) + imp_quad_abs(m->q[IMP_UV]) +
                           imp_quad_abs(m->q[IMP_UT]) + imp_quad_abs(m->q[IMP_VT]) + m->e;
    const imp_quad up = bow_upper(m->b[0], uu) + bow_upper(m->b[1], vv) + mixed;
    const imp_quad down = bow_upper(m->b[0], -uu) + bow_upper(m->b[1], -vv) + mixed;
    m->lo = m->a - (quad_padded_upper(down, 16) + rounding);
    m->hi = m->a + (quad_padded_upper(up, 16) + rounding);
    const imp_quad along_v =
        sum.column[1] + imp_quad_all(4) * sum.column[2] + imp_quad_all(9) * sum.column[3];
    m->rate[0] = sum.along_u / imp_quad_all(region->d[0]);
    m->rate[1] = along_v / imp_quad_all(region->d[1]);
    m->rate[2] = imp_quad_all(0);
    if (half > 0)
        m->rate[2] =
            (imp_quad_abs(travel) - imp_quad_abs(sum.y[0][0]) + sum.speed) / imp_quad_all(half);
}

IMP_QUAD_INLINE void take(const net *p, node *n)
{
    model_lanes m;
    if (p->is_moving)
        models_of(p, &n->region, true, &m);
    else
        models_of(p, &n->region, false, &m);
    lanes_take(n, &m);
}

IMP_QUAD_WIDE static void take_wide(const net *p, node *n) { take(p, n); }

bool net_series_take(const net *p, node *n)
{
    if (p->degree[0] != 3 || p->degree[1] != 3 || p->is_weighted) return false;
    for (parameter j = PARAMETER_U; j <= PARAMETER_V; ++j)
        if (!net_can_halve(&n->region, j) || !(n->region.d[j] > 0)) return false;
    if (imp_quad_is_wide())
        take_wide(p, n);
    else
        take(p, n);
    return true;
}
