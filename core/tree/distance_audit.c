/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/distance_audit.h"

#include <float.h>

#include "core/base/rounding.h"
#include "core/common/random.h"

/* Points near the surface under its first `maps` maps: each point f(p) of a part of the node, moved
 * by (h + k s_j) n for some vector n and s = (p - c) / d of the part. */
typedef struct passage {
    imp_region region;
    size_t maps;
    int along;       /* j; k is 0 where the part has no width along it */
    double way[3];   /* h n; length */
    double drift[3]; /* k n; length */
    imp_model point[3];
} passage;

/* --- Drawing ---------------------------------------------------------------------------------- */

enum { SHRINK = 8 }; /* a part's widths are down to 2^-8 of the node's */

static imp_region draw_part(const imp_region *of, uint64_t *state)
{
    double lo[3], hi[3];
    for (int j = 0; j < 3; ++j) {
        const double width = (of->hi[j] - of->lo[j]) * random_power(state, -SHRINK, 0);
        const double room = (of->hi[j] - of->lo[j]) - width;
        lo[j] = of->lo[j] + room * random_fraction(state);
        hi[j] = lo[j] + width;
        if (!(lo[j] <= of->hi[j])) lo[j] = of->hi[j];
        if (!(hi[j] <= of->hi[j])) hi[j] = of->hi[j];
    }
    return region_make(lo, hi);
}

/* Draws a direction that is nearly normal to the part, or any direction. */
static vec3 draw_direction(const imp_model model[3], uint64_t *state)
{
    vec3 by[2], n;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) by[j].x[i] = model[i].b[j];
    n = vec3_cross(by[0], by[1]);
    const double length = vec3_norm(n);
    if (length > 0 && length < INFINITY) return vec3_scale(n, 1 / length);
    for (int i = 0; i < 3; ++i) n.x[i] = random_between(state, -1, 1);
    return n;
}

/* Makes models of the moved points. In units of u: a and b are rounded once, ends of the range
 * three times. */
static void move(passage *w, const vec3 *n, double h, double k)
{
    for (int i = 0; i < 3; ++i) {
        imp_model *x = &w->point[i];
        const double way = h * n->x[i], drift = k * n->x[i], reach = fabs(way) + fabs(drift);
        const double size = fabs(x->a) + fabs(x->b[w->along]) + fabs(x->lo) + fabs(x->hi) + reach;
        const double slack = 8 * UNIT_ROUNDOFF * size;
        w->way[i] = way;
        w->drift[i] = drift;
        x->a += way;
        x->b[w->along] += drift;
        x->e = sum_upper(x->e, slack);
        x->lo = difference_lower(x->lo + way, fabs(drift) + slack);
        x->hi = sum_upper(x->hi + way, fabs(drift) + slack);
        x->depends = 7;
        for (int j = 0; j < 3; ++j) x->rate[j] = INFINITY;
    }
}

/* Draws a part and its moved points. False: the part has no bounds, or is so small that its
 * parameters are too coarse. */
static bool draw_passage(const node *n, uint64_t *state, passage *w)
{
    w->region = draw_part(&n->region, state);
    w->along = (int)(random_bits(state) % 2);
    for (int j = 0; j < 3; ++j) {
        const double d = w->region.d[j];
        if (d > 0 && !(d > 0x1p-30 * fabs(w->region.c[j]))) return false;
    }
    size_t still; /* as in the solver */
    if (surface_still_maps(n->surface, &w->region, &still) != IMP_STATUS_OK) return false;
    w->maps = random_bits(state) % (still + 1);
    if (surface_include_inner(n->surface, &w->region, w->maps, w->point) != IMP_STATUS_OK)
        return false;
    double extent = 0;
    for (int i = 0; i < 3; ++i)
        extent += fabs(w->point[i].b[0]) + fabs(w->point[i].b[1]) + w->point[i].e;
    const vec3 direction = draw_direction(w->point, state);
    const double off = extent * random_power(state, -10, 1);
    const bool slides = random_bits(state) % 2 && w->region.d[w->along] > 0;
    move(w, &direction, random_bits(state) % 2 ? off : -off, slides ? off : 0);
    return true;
}

/* --- Checking --------------------------------------------------------------------------------- */

/* Rounding of the polynomial, in units of u of the sum of the terms' sizes: s 2 roundings, twice;
 * products 2; sums 9. */
enum { CLAIM_ROUNDING = 32 };
_Static_assert(2 * 2 + 2 + 9 <= CLAIM_ROUNDING, "rounding of a claim");

double distance_claim_lower(const imp_model *g, const double s[3])
{
    double value = g->a, size = fabs(g->a) + g->e;
    for (int j = 0, k = 0; j < 3; ++j) {
        value += g->b[j] * s[j];
        size += fabs(g->b[j]);
        for (int l = j; l < 3; ++l, ++k) {
            value += g->q[k] * s[j] * s[l];
            size += fabs(g->q[k]);
        }
    }
    const double by_polynomial = fabs(value) - g->e - CLAIM_ROUNDING * UNIT_ROUNDOFF * size;
    const double by_range = g->lo > -g->hi ? g->lo : -g->hi;
    return by_polynomial > by_range ? by_polynomial : by_range;
}

static imp_code distance_fault(const surface *s, const imp_region *r, double claimed, double off,
                               imp_error *error)
{
    return surface_fault(s, error,
                         "claims too large a distance over u [%.17g, %.17g], v [%.17g, %.17g], t "
                         "[%.17g, %.17g]: at least %.17g of a point that is %.17g off it",
                         r->lo[0], r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], claimed, off);
}

enum { PASSAGES = 8, STEPS = 4 };

/* Lemma. A point of the surface that is moved by a vector is no farther from the surface than the
 * vector's length, also after maps that bring points nearer to each other. s is from -1 + 2^-20 to
 * 1 - 2^-20, or 0 where the region has no width, and so stands for a point of it; the vector's
 * length has fewer than 2^10 roundings. */
static imp_code judge_passage(const node *n, const passage *w, uint64_t *state, imp_error *error)
{
    imp_model g;
    if (surface_distance(n->surface, &w->region, w->maps, w->point, &g) != IMP_STATUS_OK)
        return IMP_SUCCESS;
    for (int k = 0; k < STEPS; ++k) {
        const double end = 1 - 0x1p-20;
        double s[3];
        vec3 moved;
        for (int j = 0; j < 3; ++j) {
            const uint64_t bits = random_bits(state) % 4;
            s[j] = bits == 0 ? -end : bits == 1 ? end : random_between(state, -end, end);
            if (!(w->region.d[j] > 0)) s[j] = 0;
        }
        for (int i = 0; i < 3; ++i) moved.x[i] = w->way[i] + w->drift[i] * s[w->along];
        const double size = vec3_norm1((vec3){{w->way[0], w->way[1], w->way[2]}});
        const double off = vec3_norm(moved) + 0x1p-40 * size + DBL_MIN;
        const double claimed = distance_claim_lower(&g, s);
        if (claimed > off) return distance_fault(n->surface, &w->region, claimed, off, error);
    }
    return IMP_SUCCESS;
}

imp_code distance_audit_run(const node *n, uint64_t *state, imp_error *error)
{
    if (!surface_has_distance(n->surface)) return IMP_SUCCESS;
    for (int k = 0; k < PASSAGES; ++k) {
        passage w;
        if (!draw_passage(n, state, &w)) continue;
        const imp_code code = judge_passage(n, &w, state, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}
