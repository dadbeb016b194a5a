/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "axes.h"

#include "quadratic.h"

#define INLINE static inline __attribute__((always_inline))

enum { LANES = 4 };

typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef long long mask __attribute__((vector_size(8 * LANES)));

INLINE lanes all(double x) { return (lanes){x, x, x, x}; }

INLINE lanes pick(mask m, lanes yes, lanes no)
{
    return (lanes)((m & (mask)yes) | (~m & (mask)no));
}

INLINE lanes magnitude(lanes x)
{
    const long long most = 0x7fffffffffffffff;
    return (lanes)((mask)x & (mask){most, most, most, most});
}

INLINE lanes greater(lanes x, lanes y) { return pick(x > y, x, y); }

INLINE lanes lesser(lanes x, lanes y) { return pick(x < y, x, y); }

INLINE bool any(mask m) { return (m[0] | m[1] | m[2] | m[3]) != 0; }

/* Four directions, coordinate by coordinate; and their absolute values. */
typedef struct bundle {
    lanes x[3], size[3];
} bundle;

INLINE lanes along(const bundle *n, const double *v)
{
    return n->x[0] * all(v[0]) + n->x[1] * all(v[1]) + n->x[2] * all(v[2]);
}

INLINE lanes weighted(const bundle *n, const double *v)
{
    return n->size[0] * all(v[0]) + n->size[1] * all(v[1]) + n->size[2] * all(v[2]);
}

typedef struct spans {
    lanes lo, hi;
} spans;

/* quadratic.c's edge_hull, in lanes. */
INLINE void edge_hull(spans *range, lanes c, lanes b, lanes q)
{
    const lanes reach = magnitude(b);
    range->hi = greater(range->hi, c + (q + reach));
    range->lo = lesser(range->lo, c + (q - reach));
    const mask inside = reach < magnitude(q + q);
    if (!any(inside)) return;
    const lanes vertex = pick(inside, c - b * b / (q * all(4)), c + (q + reach));
    range->hi = greater(range->hi, vertex);
    range->lo = lesser(range->lo, vertex);
}

/* The coefficients of a slice, in lanes. */
typedef struct forms {
    lanes bu, bv, uu, uv, vv, uw, vw;
} forms;

INLINE forms project(const bundle *n, const slice *s)
{
    return (forms){along(n, s->bu),  along(n, s->bv),  along(n, s->quu), along(n, s->quv),
                   along(n, s->qvv), along(n, s->quw), along(n, s->qvw)};
}

INLINE lanes turning(const forms *f) { return magnitude(f->uw) + magnitude(f->vw); }

/* Values that do occur at every w, at the middle and a corner, or are passed: no bound can be
 * better than these. */
INLINE spans glimpse(const forms *f)
{
    const lanes slopes = magnitude(f->bu) + magnitude(f->bv) - magnitude(f->uv) - turning(f);
    const lanes curved = f->uu + f->vv;
    return (spans){lesser(curved - slopes, all(0)), greater(curved + slopes, all(0))};
}

/* quadratic_span, in lanes; extrema inside the square, which are rare, are left to it. Lemma: where
 * 4 uu vv is below uv^2 by a part in 2^28, the form is indefinite beyond rounding. Where abs(bu)
 * reaches 2 abs(uu) + abs(uv), the slope along u keeps its sign over the square, up to 3 * 2^-53
 * of it, and so the edges hold the extrema up to 12 * 2^-53 of the coefficients' sum; v alike. */
INLINE spans span_of(const forms *f)
{
    spans range = {all(INFINITY), all(-INFINITY)};
    edge_hull(&range, f->vv + f->bv, f->bu + f->uv, f->uu);
    edge_hull(&range, f->vv - f->bv, f->bu - f->uv, f->uu);
    edge_hull(&range, f->uu + f->bu, f->bv + f->uv, f->vv);
    edge_hull(&range, f->uu - f->bu, f->bv - f->uv, f->vv);
    const mask curved = f->uu * f->vv > f->uv * f->uv * all(0.25 - 0x1p-30);
    const mask near = (magnitude(f->bu) < magnitude(f->uu) * all(2) + magnitude(f->uv)) &
                      (magnitude(f->bv) < magnitude(f->vv) * all(2) + magnitude(f->uv));
    const mask inner = curved & near;
    if (!any(inner)) return range;
    for (int k = 0; k < LANES; ++k) {
        if (!inner[k]) continue;
        const quadratic p = {f->bu[k], f->bv[k], f->uu[k], f->uv[k], f->vv[k]};
        const span exact = quadratic_span(&p);
        range.lo[k] = exact.lo;
        range.hi[k] = exact.hi;
    }
    return range;
}

/* The range of form b less that of form a at the window's start (w = -1) or end (w = 1). */
INLINE spans between_at(const forms *a, const forms *b, double w)
{
    forms fa = *a, fb = *b;
    fa.bu += all(w) * a->uw, fa.bv += all(w) * a->vw;
    fb.bu += all(w) * b->uw, fb.bv += all(w) * b->vw;
    const spans ra = span_of(&fa), rb = span_of(&fb);
    return (spans){rb.lo - ra.hi, rb.hi - ra.lo};
}

/* share_cut in lanes: the least upper and greatest lower bound of w that low + drift w <= limit
 * leaves in each; `gone` where it leaves nothing. */
typedef struct cuts {
    lanes lo, hi;
    mask gone;
} cuts;

INLINE void cut(cuts *c, lanes low, lanes drift, lanes limit)
{
    const lanes reach = magnitude(drift);
    c->gone |= low - reach > limit;
    const mask some = low + reach > limit;
    if (!any(some)) return;
    const lanes w = (limit - low) / drift;
    c->hi = pick(some & (drift > all(0)), lesser(w + all(0x1p-50), c->hi), c->hi);
    c->lo = pick(some & (drift < all(0)), greater(w - all(0x1p-50), c->lo), c->lo);
}

INLINE bool share_take(share *s, const cuts *c)
{
    if (any(c->gone)) return false;
    for (int k = 0; k < LANES; ++k) {
        if (c->hi[k] < s->hi) s->hi = c->hi[k];
        if (c->lo[k] > s->lo) s->lo = c->lo[k];
    }
    return !(s->lo > s->hi);
}

/* Lemma (one axis). Let x of A and y of B have fixed parameters s_a, s_b. But for the slack,
 * n.(y - x) is then linear in w. The least of it over all s_a, s_b is concave in w, being a
 * minimum of linear functions, and so lies above its chord; the greatest lies below its own.
 * At either end of the window, w = -1 and w = 1, they are
 *
 *   n.delta + n.drift w + [min Qb - max Qa, max Qb - min Qa],   the forms with their slopes at w,
 *
 * and |n.(y - x)| <= |n| |y - x|. So where the chords less or more sum_i |n_i| slack_i leave
 * [-g, g], g = |n| clearance, the nodes are farther apart than the clearance. Rounding, in units
 * of u = 2^-53 and R = sum_i |n_i| magnitude_i: what re-centring left 4 R, the dots 6 R, slopes
 * at the ends 2 R, the two spans 128 R (2^-46 R), the sums 16 R, the slack's own sums 8 R: below
 * 2^-45 R = 256 u R. 2^-490 outweighs underflow, since every axis has a coordinate of 1. Lanes
 * whose axis or size is out of range are left out: they prove nothing. */
INLINE bool bundle_cut(const relative *r, bundle *n, double clearance, share *s)
{
    for (int i = 0; i < 3; ++i) n->size[i] = magnitude(n->x[i]);
    const lanes longest = greater(n->size[0], greater(n->size[1], n->size[2]));
    const lanes scale = all(1) / longest;
    for (int i = 0; i < 3; ++i) {
        n->x[i] *= scale;
        n->size[i] = magnitude(n->x[i]);
    }
    const forms fa = project(n, &r->a), fb = project(n, &r->b);
    const lanes offset = along(n, r->delta), drift = along(n, r->drift);
    const spans ga = glimpse(&fa), gb = glimpse(&fb);
    const mask above = offset + (gb.lo - ga.hi) + magnitude(drift) > all(0);
    const mask below = offset + (gb.hi - ga.lo) - magnitude(drift) < all(0);
    if (!any(above | below)) return true; /* no w to cut */
    const spans first = between_at(&fa, &fb, -1);
    const bool turns = any(turning(&fa) + turning(&fb) > all(0));
    const spans last = turns ? between_at(&fa, &fb, 1) : first;
    const lanes size = weighted(n, r->magnitude);
    const lanes slack = weighted(n, r->slack) + size * all(0x1p-45) + all(0x1p-490);
    const lanes square = n->x[0] * n->x[0] + n->x[1] * n->x[1] + n->x[2] * n->x[2];
    lanes limit;
    for (int k = 0; k < LANES; ++k) limit[k] = sqrt(square[k]) * clearance * (1 + 0x1p-49);
    const mask sane = (longest > all(0x1p-400)) & (longest < all(0x1p400)) & (size < all(0x1p400));
    limit = pick(sane, limit, all(INFINITY));
    cuts c = {all(-1), all(1), (mask){0}};
    const lanes half = all(0.5);
    cut(&c, offset + half * (first.lo + last.lo) - slack, drift + half * (last.lo - first.lo),
        limit);
    cut(&c, -offset - half * (first.hi + last.hi) - slack, half * (first.hi - last.hi) - drift,
        limit);
    return share_take(s, &c);
}

INLINE void bundle_set(bundle *n, int lane, vec3 axis)
{
    for (int i = 0; i < 3; ++i) n->x[i][lane] = axis.x[i];
}

/* First the line of centres at the window's start (it decides when the earliest contact can be),
 * both normals, and what is square to them; then in each tangent plane the directions across u and
 * v; then the coordinate axes and the line of centres in the middle. */
INLINE bool bundles_cut(const relative *r, double clearance, share *s)
{
    const vec3 na = r->a.normal, nb = r->b.normal;
    const vec3 delta = vec3_from(r->delta);
    bundle n;
    bundle_set(&n, 0, vec3_sub(delta, vec3_from(r->drift)));
    bundle_set(&n, 1, na);
    bundle_set(&n, 2, nb);
    bundle_set(&n, 3, vec3_cross(na, nb));
    if (!bundle_cut(r, &n, clearance, s)) return false;
    bundle_set(&n, 0, vec3_cross(na, vec3_from(r->a.bu)));
    bundle_set(&n, 1, vec3_cross(na, vec3_from(r->a.bv)));
    bundle_set(&n, 2, vec3_cross(nb, vec3_from(r->b.bu)));
    bundle_set(&n, 3, vec3_cross(nb, vec3_from(r->b.bv)));
    if (!bundle_cut(r, &n, clearance, s)) return false;
    bundle_set(&n, 0, (vec3){{1, 0, 0}});
    bundle_set(&n, 1, (vec3){{0, 1, 0}});
    bundle_set(&n, 2, (vec3){{0, 0, 1}});
    bundle_set(&n, 3, delta);
    return bundle_cut(r, &n, clearance, s);
}

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) static bool bundles_cut_wide(const relative *r, double clearance,
                                                             share *s)
{
    return bundles_cut(r, clearance, s);
}

bool axes_cut(const relative *r, double clearance, share *s)
{
    if (__builtin_cpu_supports("avx2")) return bundles_cut_wide(r, clearance, s);
    return bundles_cut(r, clearance, s);
}
#else
bool axes_cut(const relative *r, double clearance, share *s)
{
    return bundles_cut(r, clearance, s);
}
#endif
