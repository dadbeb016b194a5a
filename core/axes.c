/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "axes.h"

#include "nearest_axis.h"
#include "quadratic.h"

/* Four directions, coordinate by coordinate; and their absolute values. */
typedef struct bundle {
    lanes x[3], size[3];
} bundle;

LANES_INLINE bundle bundle_of(vec3 a, vec3 b, vec3 c, vec3 d)
{
    bundle n;
    for (int i = 0; i < 3; ++i) n.x[i] = (lanes){a.x[i], b.x[i], c.x[i], d.x[i]};
    return n;
}

LANES_INLINE lanes along(const bundle *n, const double *v)
{
    return n->x[0] * lanes_all(v[0]) + n->x[1] * lanes_all(v[1]) + n->x[2] * lanes_all(v[2]);
}

LANES_INLINE lanes weighted(const bundle *n, const double *v)
{
    return n->size[0] * lanes_all(v[0]) + n->size[1] * lanes_all(v[1]) +
           n->size[2] * lanes_all(v[2]);
}

/* The coefficients of a slice along each direction. */
typedef struct forms {
    lanes bu, bv, uu, uv, vv, uw, vw;
} forms;

LANES_INLINE forms project(const bundle *n, const slice *s)
{
    return (forms){along(n, s->bu),  along(n, s->bv),  along(n, s->quu), along(n, s->quv),
                   along(n, s->qvv), along(n, s->quw), along(n, s->qvw)};
}

LANES_INLINE forms negative(const forms *f)
{
    return (forms){-f->bu, -f->bv, -f->uu, -f->uv, -f->vv, -f->uw, -f->vw};
}

LANES_INLINE lanes turning(const forms *f) { return lanes_abs(f->uw) + lanes_abs(f->vw); }

/* The form with the slopes that it has at w. */
LANES_INLINE quadratics form_at(const forms *f, double w)
{
    const lanes to = lanes_all(w);
    return (quadratics){f->bu + to * f->uw, f->bv + to * f->vw, f->uu, f->uv, f->vv};
}

LANES_INLINE lanes lower(const forms *f, double w)
{
    const quadratics p = form_at(f, w);
    return quadratics_lower(&p);
}

/* At every w the form's least value is at most this. */
LANES_INLINE lanes glimpse(const forms *f)
{
    const quadratics p = {f->bu, f->bv, f->uu, f->uv, f->vv};
    return lanes_min(quadratics_corner(&p) + turning(f), lanes_all(0));
}

/* --- What four axes show --------------------------------------------------------------- */

/* The least upper and greatest lower bound of w that low + drift w <= limit leaves in each lane;
 * `gone` where it leaves nothing. */
typedef struct cuts {
    lanes lo, hi;
    lanes_mask gone;
} cuts;

/* share_cut, in lanes. */
LANES_INLINE void cut(cuts *c, lanes low, lanes drift, lanes limit)
{
    const lanes reach = lanes_abs(drift);
    c->gone |= low - reach > limit;
    const lanes_mask some = low + reach > limit;
    if (!lanes_any(some)) return;
    const lanes w = (limit - low) / drift, slack = lanes_all(0x1p-50);
    c->hi = lanes_pick(some & (drift > lanes_all(0)), lanes_min(w + slack, c->hi), c->hi);
    c->lo = lanes_pick(some & (drift < lanes_all(0)), lanes_max(w - slack, c->lo), c->lo);
}

LANES_INLINE bool share_take(share *s, const cuts *c)
{
    if (lanes_any(c->gone)) return false;
    for (int k = 0; k < LANES; ++k) {
        if (c->hi[k] < s->hi) s->hi = c->hi[k];
        if (c->lo[k] > s->lo) s->lo = c->lo[k];
    }
    return !(s->lo > s->hi);
}

/* Of length 1 to 2, pointing from A to B at the share's start. */
LANES_INLINE lanes bundle_orient(bundle *n, const relative *r, double start)
{
    const lanes longest =
        lanes_max(lanes_abs(n->x[0]), lanes_max(lanes_abs(n->x[1]), lanes_abs(n->x[2])));
    const lanes way = along(n, r->delta) + along(n, r->drift) * lanes_all(start);
    const lanes one = lanes_pick(way < lanes_all(0), lanes_all(-1), lanes_all(1));
    const lanes scale = one / longest;
    for (int i = 0; i < 3; ++i) {
        n->x[i] *= scale;
        n->size[i] = lanes_abs(n->x[i]);
    }
    return longest;
}

/* |n| clearance, rounded up. */
LANES_INLINE lanes limit_of(const bundle *n, double clearance)
{
    const lanes square = n->x[0] * n->x[0] + n->x[1] * n->x[1] + n->x[2] * n->x[2];
    lanes limit;
    for (int k = 0; k < LANES; ++k) limit[k] = sqrt(square[k]) * clearance * (1 + 0x1p-49);
    return limit;
}

/* The chord under the sum of both forms' least values: at w at least middle + tilt w. */
typedef struct chord {
    lanes middle, tilt;
} chord;

LANES_INLINE chord chord_under(const forms *f, const forms *g)
{
    const lanes half = lanes_all(0.5), start = lower(f, -1) + lower(g, -1);
    if (!lanes_any(turning(f) + turning(g) > lanes_all(0))) return (chord){start, lanes_all(0)};
    const lanes end = lower(f, 1) + lower(g, 1);
    return (chord){half * (start + end), half * (end - start)};
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
 * at the ends 2 R, the least values 128 R (2^-46 R), the sums 16 R, the slack's own sums 8 R: below
 * 2^-45 R = 256 u R. 2^-490 outweighs underflow, since every axis has a coordinate of 1. Lanes
 * whose axis or size is out of range are left out: they prove nothing. The far side is looked at
 * only where it may end below g. */
LANES_INLINE bool bundle_cut(const relative *r, bundle *n, double clearance, share *s)
{
    const lanes longest = bundle_orient(n, r, s->lo);
    const forms a = project(n, &r->a), b = project(n, &r->b);
    const forms minus_a = negative(&a), minus_b = negative(&b);
    const lanes offset = along(n, r->delta), drift = along(n, r->drift);
    const lanes size = weighted(n, r->magnitude);
    const lanes slack = weighted(n, r->slack) + size * lanes_all(0x1p-45) + lanes_all(0x1p-490);
    const lanes_mask sane = (longest > lanes_all(0x1p-400)) & (longest < lanes_all(0x1p400)) &
                            (size < lanes_all(0x1p400));
    const lanes limit = lanes_pick(sane, limit_of(n, clearance), lanes_all(INFINITY));
    const chord near = chord_under(&b, &minus_a);
    cuts c = {lanes_all(-1), lanes_all(1), (lanes_mask){0}};
    cut(&c, offset + near.middle - slack, drift + near.tilt, limit);
    const lanes seen = lanes_abs(drift) - offset + glimpse(&a) + glimpse(&minus_b);
    if (lanes_any(seen > lanes_all(0))) {
        const chord far = chord_under(&a, &minus_b);
        cut(&c, far.middle - offset - slack, far.tilt - drift, limit);
    }
    return share_take(s, &c);
}

/* Along the axis that is best at the window's start, since the start decides when the earliest
 * contact can be; both normals; and the line of centres at the window's end. Where no axis is any
 * good at the start, along the line of centres there. */
LANES_INLINE bool cut_along_axes(const relative *r, double clearance, share *s, vec3 *axis)
{
    const vec3 delta = vec3_from(r->delta), drift = vec3_from(r->drift);
    const vec3 start = vec3_sub(delta, drift), end = vec3_sub(delta, vec3_scale(drift, -1));
    vec3 best = vec3_norm1(*axis) > 0 ? *axis : start;
    const bool apart = nearest_axis(r, -1, &best);
    if (apart) *axis = best;
    bundle n = bundle_of(apart ? best : start, r->a.normal, r->b.normal, end);
    return bundle_cut(r, &n, clearance, s);
}

LANES_WIDE static bool cut_along_axes_wide(const relative *r, double clearance, share *s,
                                           vec3 *axis)
{
    return cut_along_axes(r, clearance, s, axis);
}

bool axes_cut(const relative *r, double clearance, share *s, vec3 *axis)
{
    return lanes_are_wide() ? cut_along_axes_wide(r, clearance, s, axis)
                            : cut_along_axes(r, clearance, s, axis);
}
