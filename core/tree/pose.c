/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/pose.h"

#include <impinge/interval.h>

#include "core/tree/model_lanes.h"
#include "core/tree/posed_terms.h"
#include "core/tree/triple.h"

/* --- Vector layout ---------------------------------------------------------------------------- */

void pose_take(pose_lanes *p, const imp_pose *given, double norm)
{
    *p = (pose_lanes){.norm = norm};
    for (int i = 0; i < 3; ++i) {
        const imp_model *t = &given->shift[i];
        const double shift[3] = {t->a, t->b[2], t->q[IMP_TT]};
        for (int j = 0; j < 3; ++j) {
            const imp_model *r = &given->turn[i][j];
            const double entry[3] = {r->a, r->b[2], r->q[IMP_TT]};
            for (int k = 0; k < 3; ++k) p->turn[k][j][i] = entry[k];
            p->turn_error[j][i] = r->e;
            p->turn_most[j][i] = imp_larger(fabs(r->lo), fabs(r->hi));
            p->turn_rate[j][i] = r->rate[2];
        }
        for (int k = 0; k < 3; ++k) p->shift[k][i] = shift[k];
        p->shift_error[i] = t->e;
        p->shift_lo[i] = t->lo;
        p->shift_hi[i] = t->hi;
        p->shift_rate[i] = t->rate[2];
        p->pivot[i] = given->pivot[i];
    }
}

bool shape_model_take(shape_model *s, const imp_model model[3])
{
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 3; ++i) {
        const imp_model *m = &model[i];
        if ((m->depends >> PARAMETER_T & 1) != 0 || m->b[2] != 0 || m->q[IMP_UT] != 0 ||
            m->q[IMP_VT] != 0 || m->q[IMP_TT] != 0)
            return false;
        s->a[i] = m->a;
        s->bu[i] = m->b[0];
        s->bv[i] = m->b[1];
        s->quu[i] = m->q[IMP_UU];
        s->quv[i] = m->q[IMP_UV];
        s->qvv[i] = m->q[IMP_VV];
        s->e[i] = m->e;
        s->lo[i] = m->lo;
        s->hi[i] = m->hi;
        s->rate_u[i] = m->rate[0];
        s->rate_v[i] = m->rate[1];
    }
    return true;
}

/* --- The product ------------------------------------------------------------------------------ */

/* Like pose_times, for columns of four numbers. */
IMP_QUAD_INLINE imp_quad sizes_times(const double column[3][4], const double y[3])
{
    return imp_quad_load(column[0]) * imp_quad_all(y[0]) +
           imp_quad_load(column[1]) * imp_quad_all(y[1]) +
           imp_quad_load(column[2]) * imp_quad_all(y[2]);
}

IMP_QUAD_INLINE imp_quad size_times(const double column[3][3], const double y[3])
{
    return imp_quad_abs(pose_times(column, y));
}

/* >= norm |x| for x >= 0; roundings: square 1, sums 2, halved by the root, root 1, product 1. */
static double turned_upper(double norm, const double x[3])
{
    PAD_COVERS(8, 2 + 1 + 1);
    const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    return padded_upper(norm * length, 8) + ROOT_UNDERFLOW;
}

/* Sums of the |coefficients| of a pose, off by 2 roundings. */
typedef struct pose_sizes {
    double turn[3][4]; /* by column and row; 1 */
    double shift[4];   /* length */
} pose_sizes;

IMP_QUAD_INLINE imp_quad size_of(const double *at, const double *by, const double *by_square)
{
    return imp_quad_abs(triple_load(at)) + imp_quad_abs(triple_load(by)) +
           imp_quad_abs(triple_load(by_square));
}

IMP_QUAD_INLINE pose_sizes sizes_of(const pose_lanes *p)
{
    pose_sizes sizes;
    for (int j = 0; j < 3; ++j)
        imp_quad_store(sizes.turn[j], size_of(p->turn[0][j], p->turn[1][j], p->turn[2][j]));
    imp_quad_store(sizes.shift, size_of(p->shift[0], p->shift[1], p->shift[2]));
    return sizes;
}

/* A shape relative to the pivot: z = y - p. */
typedef struct relative_shape {
    double a[4];      /* of its polynomial */
    double middle[4]; /* half the sum of the squares' coefficients */
    double both[4];   /* a + middle */
    double most[4];   /* >= |z| */
} relative_shape;

IMP_QUAD_INLINE relative_shape shape_about(const shape_model *s, const double pivot[3])
{
    relative_shape z;
    const imp_quad p = triple_load(pivot), half = imp_quad_all(0.5);
    const imp_quad a = triple_load(s->a) - p;
    const imp_quad middle = half * (triple_load(s->quu) + triple_load(s->qvv));
    const imp_quad below = imp_quad_abs(triple_load(s->lo) - p);
    const imp_quad above = imp_quad_abs(triple_load(s->hi) - p);
    PAD_COVERS(2, 1);
    imp_quad_store(z.a, a);
    imp_quad_store(z.middle, middle);
    imp_quad_store(z.both, a + middle);
    imp_quad_store(z.most, quad_padded_upper(imp_quad_max(below, above), 2));
    return z;
}

/* Lemma (polynomial). Let R = R0 + R1 s + R2 s^2 + rho and T likewise, |rho_ij| <= E_ij, and z = P
 * + delta, P = A + bu su + bv sv + cuu su^2 + cuv su sv + cvv sv^2, |delta_j| <= e_j. Then
 *
 *   x = T + R z = T + (R0 + R1 s + R2 s^2) P + R delta + rho P.
 *
 * Terms of third and fourth order go to the nearest polynomial of lower degree on [-1, 1]:
 *
 *   s su^2     = s / 2                      +- 1/2     (likewise s sv^2, s^2 su, s^2 sv)
 *   s su sv    = 0                          +- 1
 *   s^2 su^2   = s^2 / 2 + su^2 / 2 - 1/4   +- 1/4     since (s^2 - 1/2) (su^2 - 1/2) is that
 *   s^2 su sv  = su sv / 2                  +- 1/2
 *
 * With H = (cuu + cvv) / 2, G = A + H and S = R0 + R2 / 2 that leaves
 *
 *   a = R0 A + T0 - R2 H / 2,   bu = S bu,   bv = S bv,   bt = R1 G + T1,
 *   quu = S cuu, quv = S cuv, qvv = S cvv,   qut = R1 bu, qvt = R1 bv,   qtt = R2 G + T2. */
IMP_QUAD_INLINE void take_coefficients(const shape_model *s, const relative_shape *z,
                                       const pose_lanes *p, model_lanes *m)
{
    double near[3][4]; /* S */
    const imp_quad half = imp_quad_all(0.5);
    for (int j = 0; j < 3; ++j)
        imp_quad_store(near[j], triple_load(p->turn[0][j]) + half * triple_load(p->turn[2][j]));
    m->a = pose_times(p->turn[0], z->a) + triple_load(p->shift[0]) -
           half * pose_times(p->turn[2], z->middle);
    m->b[0] = sizes_times(near, s->bu);
    m->b[1] = sizes_times(near, s->bv);
    m->b[2] = pose_times(p->turn[1], z->both) + triple_load(p->shift[1]);
    m->q[IMP_UU] = sizes_times(near, s->quu);
    m->q[IMP_UV] = sizes_times(near, s->quv);
    m->q[IMP_VV] = sizes_times(near, s->qvv);
    m->q[IMP_UT] = pose_times(p->turn[1], s->bu);
    m->q[IMP_VT] = pose_times(p->turn[1], s->bv);
    m->q[IMP_TT] = pose_times(p->turn[2], z->both) + triple_load(p->shift[2]);
}

/* Bounds the terms of third order, and of fourth order, that the lemma (polynomial) folds. */
IMP_QUAD_INLINE imp_quad folded_third(const shape_model *s, const pose_lanes *p)
{
    const imp_quad halves = size_times(p->turn[1], s->quu) + size_times(p->turn[1], s->qvv) +
                            size_times(p->turn[2], s->bu) + size_times(p->turn[2], s->bv);
    return size_times(p->turn[1], s->quv) + imp_quad_all(0.5) * halves;
}

IMP_QUAD_INLINE imp_quad folded_fourth(const shape_model *s, const pose_lanes *p)
{
    const imp_quad quarters = size_times(p->turn[2], s->quu) + size_times(p->turn[2], s->qvv);
    return imp_quad_all(0.5) * size_times(p->turn[2], s->quv) + imp_quad_all(0.25) * quarters;
}

/* Lemma (rounding). Number of roundings of each product: of R_k A, in a, bt or qtt: A 1, G 1,
 * the product 1, its sums 2, T 1, the last 1: 6 at most of a, and of bt and qtt. Of others: in H 1,
 * G 1, S 1; product 1, sums 2, T 1: 6 at most; R2 cuu is in a, quu and qtt with the weights 1/4,
 * 1/2 and 1/2, others with less: 7.5. What is folded misses 3 of each, with weights of 1 at most:
 * 10.5 together. T passes through 2. In units of u, with |R| = |R0| + |R1| + |R2|:
 *
 *   |R| (TURNED |A| + OTHERS (|bu| + |bv| + |cuu| + |cuv| + |cvv|)) + MOVED (|T0| + |T1| + |T2|)
 */
enum { TURNED = 6, OTHERS = 11, MOVED = 2 };
_Static_assert(1 + 1 + 1 + 2 + 1 <= TURNED && 4 * 6 + 6 + 4 * 3 <= 4 * OTHERS,
               "rounding of a pose");

IMP_QUAD_INLINE imp_quad rounding(const shape_model *s, const relative_shape *z,
                                  const pose_sizes *of)
{
    double size[4];
    const imp_quad others = imp_quad_abs(triple_load(s->bu)) + imp_quad_abs(triple_load(s->bv)) +
                            imp_quad_abs(triple_load(s->quu)) + imp_quad_abs(triple_load(s->quv)) +
                            imp_quad_abs(triple_load(s->qvv));
    imp_quad_store(size, imp_quad_all(TURNED) * imp_quad_abs(imp_quad_load(z->a)) +
                             imp_quad_all(OTHERS) * others);
    return imp_quad_all(UNIT_ROUNDOFF) *
           (sizes_times(of->turn, size) + imp_quad_all(MOVED) * imp_quad_load(of->shift));
}

/* Lemma (remainder). |R delta| is at most |R| e, coordinate by coordinate, and norm |e| as a whole;
 * |rho P| <= E (|z| + e). All sums are non-negative; the longest chain is the rounding's: size 2 +
 * 5, factor 1, sums 1 + 1, product 1, sums 2, T 1, factor 1, and then 4 sums. Underflows lose less
 * than POSE_UNDERFLOW. */
#define POSE_UNDERFLOW imp_quad_of(0x1p-1000, 0x1p-1000, 0x1p-1000, 0)
PAD_COVERS(32, 7 + 1 + 2 + 3 + 2 + 5);

/* Bounds the remainder without the terms of third order and R delta. */
IMP_QUAD_INLINE imp_quad rest(const shape_model *s, const relative_shape *z, const pose_lanes *p,
                              const pose_sizes *sizes)
{
    double far[4];
    imp_quad_store(far, imp_quad_load(z->most) + triple_load(s->e));
    return folded_fourth(s, p) + pose_times(p->turn_error, far) + triple_load(p->shift_error) +
           rounding(s, z, sizes);
}

IMP_QUAD_INLINE imp_quad remainder_upper(const shape_model *s, const pose_lanes *p, imp_quad rest)
{
    const imp_quad as_one = imp_quad_all(turned_upper(p->norm, s->e));
    const imp_quad e = imp_quad_min(pose_times(p->turn_most, s->e), as_one);
    return quad_padded_upper(rest + folded_third(s, p) + e, 32) + POSE_UNDERFLOW;
}

/* Bounds posed_e: the rest, plus what the edges leave out, and their rounding. */
PAD_COVERS(32, 7 + 1 + 2 + 3 + 2 + 5 + 2);

IMP_QUAD_INLINE imp_quad posed_rest_upper(const shape_model *s, const pose_sizes *sizes,
                                          imp_quad rest)
{
    const imp_quad edges = sizes_times(sizes->turn, s->e);
    const imp_quad all = rest + imp_quad_all(EDGE_ROUNDING * UNIT_ROUNDOFF) * edges;
    return quad_padded_upper(all, 32) + POSE_UNDERFLOW;
}

/* --- The range -------------------------------------------------------------------------------- */

typedef struct range_lanes {
    imp_quad lo, hi;
} range_lanes;

/* Bounds of b s + q s^2 over [-1, 1]: q +- b at the ends, 0 at s = 0 and, where |b| < 2 |q|, the
 * vertex, which is nearer to 0 than |b| / 2 is. */
IMP_QUAD_INLINE range_lanes bow(imp_quad b, imp_quad q)
{
    const imp_quad size = imp_quad_abs(b), half = imp_quad_all(0.5) * size;
    return (range_lanes){imp_quad_min(q - size, -half), imp_quad_max(q + size, half)};
}

/* Returns the range of polynomial and remainder, like imp_model_poly_range: at most 16 roundings of
 * partial sums that `size` and e bound; 32 u of these cover them and the rounding of `size`. */
IMP_QUAD_INLINE range_lanes range_of_polynomial(const model_lanes *m)
{
    const range_lanes u = bow(m->b[0], m->q[IMP_UU]), v = bow(m->b[1], m->q[IMP_VV]),
                      t = bow(m->b[2], m->q[IMP_TT]);
    const imp_quad cross =
        imp_quad_abs(m->q[IMP_UV]) + imp_quad_abs(m->q[IMP_UT]) + imp_quad_abs(m->q[IMP_VT]) + m->e;
    imp_quad size = imp_quad_abs(m->a) + m->e;
    for (int j = 0; j < 3; ++j) size += imp_quad_abs(m->b[j]);
    for (int k = 0; k < 6; ++k) size += imp_quad_abs(m->q[k]);
    const imp_quad pad = imp_quad_all(32 * UNIT_ROUNDOFF) * size;
    return (range_lanes){m->a + (u.lo + v.lo + t.lo - cross) - pad,
                         m->a + (u.hi + v.hi + t.hi + cross) + pad};
}

/* Lemma (box). With any m and |y - m| <= w,
 *
 *   x = T + R (m - p) + R (y - m),   |R (y - m)| <= |R| w,
 *
 * where T + R (m - p) is a quadratic in s within E |m - p| + F. Roundings of it: m - p 1, product
 * 1, sums 2, T 1, bow 1, and three more: 9 < 16 - 2 of |R| |m - p| + |T|. */
PAD_COVERS(16, 9);
IMP_QUAD_INLINE range_lanes range_of_box(const shape_model *s, const pose_lanes *p,
                                         const pose_sizes *sizes)
{
    double z[4], size[4], w[4];
    const imp_quad lo = triple_load(s->lo), hi = triple_load(s->hi), half = imp_quad_all(0.5);
    const imp_quad m = half * lo + half * hi, at = m - triple_load(p->pivot);
    imp_quad_store(z, at);
    imp_quad_store(size, imp_quad_abs(at));
    imp_quad_store(w, imp_quad_max(imp_quad_abs(hi - m), imp_quad_abs(m - lo)));
    const imp_quad c0 = pose_times(p->turn[0], z) + triple_load(p->shift[0]);
    const range_lanes c = bow(pose_times(p->turn[1], z) + triple_load(p->shift[1]),
                              pose_times(p->turn[2], z) + triple_load(p->shift[2]));
    const imp_quad slip = imp_quad_all(16 * UNIT_ROUNDOFF) *
                          (sizes_times(sizes->turn, size) + imp_quad_load(sizes->shift));
    const imp_quad reach =
        quad_padded_upper(pose_times(p->turn_most, w) + pose_times(p->turn_error, size) +
                              triple_load(p->shift_error) + slip,
                          16) +
        POSE_UNDERFLOW;
    return (range_lanes){c0 + c.lo - reach, c0 + c.hi + reach};
}

/* Returns a range that holds for any rotation: |x - T| <= norm |z|. Two roundings each. */
IMP_QUAD_INLINE range_lanes range_of_ball(const relative_shape *z, const pose_lanes *p)
{
    const imp_quad reach = imp_quad_all(turned_upper(p->norm, z->most));
    const imp_quad lo = triple_load(p->shift_lo), hi = triple_load(p->shift_hi);
    const imp_quad pad = imp_quad_all(4 * UNIT_ROUNDOFF);
    return (range_lanes){lo - reach - pad * (imp_quad_abs(lo) + reach),
                         hi + reach + pad * (imp_quad_abs(hi) + reach)};
}

IMP_QUAD_INLINE void take_range(const shape_model *s, const relative_shape *z, const pose_lanes *p,
                                const pose_sizes *sizes, model_lanes *m)
{
    const range_lanes x = range_of_polynomial(m), y = range_of_box(s, p, sizes),
                      ball = range_of_ball(z, p);
    m->lo = imp_quad_max(imp_quad_max(x.lo, y.lo), ball.lo);
    m->hi = imp_quad_min(imp_quad_min(x.hi, y.hi), ball.hi);
}

/* --- The node --------------------------------------------------------------------------------- */

IMP_QUAD_INLINE bool take(node *n, const shape_model *s, const pose_lanes *p)
{
    model_lanes m;
    const relative_shape z = shape_about(s, p->pivot);
    const pose_sizes sizes = sizes_of(p);
    take_coefficients(s, &z, p, &m);
    const imp_quad left = rest(s, &z, p, &sizes);
    m.e = remainder_upper(s, p, left);
    take_range(s, &z, p, &sizes, &m);
    m.rate[0] = pose_times(p->turn_most, s->rate_u);
    m.rate[1] = pose_times(p->turn_most, s->rate_v);
    m.rate[2] = pose_times(p->turn_rate, z.most) + triple_load(p->shift_rate);
    if (!lanes_are_bounded(&m) || !lanes_are_sound(&m)) return false;
    lanes_take(n, &m);
    if (s->ball > 0) lanes_add_ball(n, s->ball);
    triple_store(n->posed_e, posed_rest_upper(s, &sizes, left));
    n->still = s;
    n->pose = p;
    return true;
}

IMP_QUAD_WIDE static bool take_wide(node *n, const shape_model *s, const pose_lanes *p)
{
    return take(n, s, p);
}

bool node_take_posed(node *n, const shape_model *s, const pose_lanes *p)
{
    return imp_quad_is_wide() ? take_wide(n, s, p) : take(n, s, p);
}
