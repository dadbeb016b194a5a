/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/winding.h"

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/surface/region.h"

/* Lemma. Let x be at a distance > m from a box that holds a part P of a patch, over a rectangle in
 * (u, v). The points within m of the box are a convex set K without x. Let Q be a polygon of points
 * of P's rim, in their order, each evaluated within m. For each stretch c(s), s in [-1, 1], of the
 * rim between two of them, and the chord p(s) between these, let the sliver be the ruled surface
 * (1 - l) c(s) + l p(s), 0 <= l <= 1. P, less triangles that fill Q, less the slivers, is a closed
 * surface within K, which x is outside of; so its solid angle seen from x is 0. A sliver's area is
 * at most h (L + 2 m): h >= |c - p|, L the length of c; so its solid angle is at most that over the
 * square of its distance from x.
 *
 * h: with a model of the stretch, |c_i - (a + b s + q s^2)| <= e, and the chord's ends are within
 * e + m' of the polynomial's, m' the error of the points. The polynomial is off its own chord by
 * |q (1 - s^2)| <= |q|: h_i = |q| + 2 e + m'. L = sum over the parameter's width of the models'
 * rate.
 *
 * Patches of a shell meet along their rims within `slack`: ribbons of that width, ruled between two
 * rims, close it. Half of each ribbon's area is at most slack L of one rim: the rims of whole
 * patches have h + slack instead of h, and are seen from `slack` nearer. */

typedef struct part {
    const winding_view *view;
    const patch *p;
    winding_sum *sum;
    int sign;
    unsigned work; /* regions of this patch examined so far */
    imp_error *error;
    /* of the current part: */
    double margin; /* points of its polygon are evaluated within this; length */
    bool begun;
    vec3 first, last; /* of the polygon */
} part;

enum { WORK_MAX = 1 << 14 };
#define MARGIN 0x1p-20 /* part of the distance from x within which points may be evaluated */

static void give_up(part *w)
{
    solid_angle_add_error(&w->sum->seen, FULL_ANGLE);
    w->sum->distance = 0;
}

/* --- Models ----------------------------------------------------------------------------------- */

/* Returns how far x is from the models' box at least. A NaN counts as inside. One difference, a
 * square each, two sums and a root: (2 + 1 + 2) / 2 + 1 < 4. */
PAD_COVERS(8, 4);
static double distance_lower(const part *w, const imp_model model[3])
{
    vec3 out;
    for (int i = 0; i < 3; ++i) {
        const double below = model[i].lo - w->view->x.x[i], above = w->view->x.x[i] - model[i].hi;
        out.x[i] = below > 0 ? below : above > 0 ? above : 0;
    }
    const double lower = padded_lower(vec3_norm(out), 8);
    return lower > 0 ? lower : 0;
}

/* Bounds h of the lemma and the length of a stretch along parameter j. Sums of four, a norm. */
PAD_COVERS(16, 4 + 4);
static void stretch_bounds(const imp_model model[3], const imp_region *region, int j, double margin,
                           double *off, double *length)
{
    vec3 h, rate;
    for (int i = 0; i < 3; ++i) {
        h.x[i] = fabs(model[i].q[j == PARAMETER_U ? IMP_UU : IMP_VV]) + 2 * model[i].e + margin;
        rate.x[i] = model[i].rate[j];
    }
    *off = padded_upper(vec3_norm(h), 16) + ROOT_UNDERFLOW;
    *length = padded_upper(vec3_norm(rate) * 2 * region->d[j], 16) + 2 * margin + ROOT_UNDERFLOW;
}

/* --- The rim of a part ------------------------------------------------------------------------ */

/* Adds the next point of the polygon. Triangles fan out from the first. */
static void add_corner(part *w, vec3 at)
{
    enclosed_angle one = {0, 0};
    if (!w->begun) w->first = w->last = at;
    w->begun = true;
    solid_angle_add_triangle(&one, w->view->x, w->first, w->last, at);
    w->last = at;
    w->sum->seen.angle += w->sign * one.angle;
    solid_angle_add_error(&w->sum->seen, one.error);
    solid_angle_add_error(&w->sum->seen, 2 * UNIT_ROUNDOFF * fabs(w->sum->seen.angle));
}

/* A stretch of a part's rim, along parameter j, from one end of the region to the other. */
typedef struct stretch {
    imp_region region; /* of no width but along j */
    int j;
    bool is_rim; /* of the whole patch */
    bool backward;
} stretch;

/* Bounds the sliver of a stretch that has these models. False: it should be divided. Roundings: a
 * sum, a difference, 2 products, a square, a quotient. */
PAD_COVERS(16, 8);
static bool take_stretch(part *w, const stretch *s, const imp_model model[3], bool must)
{
    const double slack = s->is_rim ? w->view->slack : 0;
    double off, length;
    stretch_bounds(model, &s->region, s->j, w->margin, &off, &length);
    const double away = padded_lower(distance_lower(w, model) - w->margin - slack, 4);
    const double sliver = padded_upper((off + slack) * length / (away * away), 16);
    const bool fine = off <= w->view->fineness * away && length < INFINITY;
    if (!fine && !must) return false;
    if (!(away > 0) || !(sliver < FULL_ANGLE))
        give_up(w);
    else
        solid_angle_add_error(&w->sum->seen, sliver);
    return true;
}

static imp_code follow(part *w, const stretch *s, vec3 end);

static imp_code divide_stretch(part *w, const stretch *s, vec3 end)
{
    double uv[1][2] = {{s->region.c[0], s->region.c[1]}}, off[1];
    vec3 middle;
    stretch half = *s;
    imp_code code = patch_eval(w->p, w->view->t, 1, (const double(*)[2])uv, &middle, off, w->error);
    if (code != IMP_SUCCESS) return code;
    if (!(off[0] <= w->margin)) {
        give_up(w);
        return IMP_SUCCESS;
    }
    region_set_half(&half.region, &s->region, (parameter)s->j, s->backward);
    code = follow(w, &half, middle);
    region_set_half(&half.region, &s->region, (parameter)s->j, !s->backward);
    return code == IMP_SUCCESS ? follow(w, &half, end) : code;
}

/* Adds the polygon's points along a stretch, but for its first. */
static imp_code follow(part *w, const stretch *s, vec3 end)
{
    imp_model model[3];
    const imp_code code = patch_include(w->p, &s->region, model, w->error);
    if (code != IMP_SUCCESS) return code;
    const bool must = !region_can_split(&s->region, (parameter)s->j) || ++w->work > WORK_MAX;
    if (!take_stretch(w, s, model, must)) return divide_stretch(w, s, end);
    add_corner(w, end);
    return IMP_SUCCESS;
}

/* Side k of a region, as patch_corner counts them. */
static stretch side_of(const part *w, const imp_region *region, int k)
{
    stretch s = {.j = k % 2 == 0 ? PARAMETER_U : PARAMETER_V, .backward = k >= 2};
    const int fixed = 1 - s.j;
    const bool high = k == 1 || k == 2;
    double lo[3], hi[3];
    for (int i = 0; i < 3; ++i) lo[i] = region->lo[i], hi[i] = region->hi[i];
    lo[fixed] = hi[fixed] = high ? region->hi[fixed] : region->lo[fixed];
    s.is_rim = lo[fixed] == (high ? w->p->hi[fixed] : w->p->lo[fixed]);
    s.region = region_make(lo, hi);
    return s;
}

/* Replaces a part whose box, with these models, is `away` from x, by triangles. */
static imp_code take_part(part *w, const imp_region *region, const imp_model model[3], double away)
{
    double uv[4][2], off[4];
    vec3 corner[4];
    const patch rectangle = {.lo = {region->lo[0], region->lo[1]},
                             .hi = {region->hi[0], region->hi[1]}};
    for (int k = 0; k < 4; ++k) patch_corner(&rectangle, k, uv[k]);
    imp_code code = patch_eval(w->p, w->view->t, 4, (const double(*)[2])uv, corner, off, w->error);
    if (code != IMP_SUCCESS) return code;
    w->margin = away * MARGIN;
    for (int k = 0; k < 4; ++k) /* points along the rim may be less exact than the corners */
        if (!(4 * off[k] <= w->margin)) w->margin = 4 * off[k];
    if (!(w->margin < away)) {
        give_up(w);
        return IMP_SUCCESS;
    }
    if (away < w->sum->distance) w->sum->distance = away;
    w->begun = false;
    add_corner(w, corner[0]);
    for (int k = 0; k < 4 && code == IMP_SUCCESS; ++k) {
        const stretch side = side_of(w, region, k);
        if (take_stretch(w, &side, model, false))
            add_corner(w, corner[(k + 1) % 4]);
        else
            code = follow(w, &side, corner[(k + 1) % 4]);
    }
    return code;
}

/* --- Parts ------------------------------------------------------------------------------------ */

/* Returns the parameter that moves points farther, as far as rates tell; PARAMETER_T: neither can
 * be split. */
static parameter parameter_to_split(const imp_region *region, const imp_model model[3])
{
    double extent[2] = {0, 0};
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) extent[j] += model[i].rate[j] * region->d[j];
    if (!(extent[0] + extent[1] < INFINITY)) extent[0] = region->d[0], extent[1] = region->d[1];
    const parameter first = extent[1] > extent[0] ? PARAMETER_V : PARAMETER_U;
    const parameter second = first == PARAMETER_U ? PARAMETER_V : PARAMETER_U;
    if (region_can_split(region, first)) return first;
    return region_can_split(region, second) ? second : PARAMETER_T;
}

/* Returns whether a part is far enough from x to be replaced as a whole. It has to be small against
 * its distance, or models and chords along it are of no use. */
#define PARTS_SIZE 8 /* of its distance */
static bool is_far(const imp_model model[3], double away)
{
    double size = 0;
    for (int i = 0; i < 3; ++i)
        if (!(model[i].hi - model[i].lo <= size)) size = model[i].hi - model[i].lo;
    return away > 0 && size <= PARTS_SIZE * away;
}

static imp_code add_region(part *w, const imp_region *region)
{
    imp_model model[3];
    if (++w->work > WORK_MAX) {
        give_up(w);
        return IMP_SUCCESS;
    }
    imp_code code = patch_include(w->p, region, model, w->error);
    if (code != IMP_SUCCESS) return code;
    const double away = distance_lower(w, model);
    if (is_far(model, away)) return take_part(w, region, model, away);
    const parameter j = parameter_to_split(region, model);
    if (j == PARAMETER_T) {
        give_up(w);
        return IMP_SUCCESS;
    }
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        imp_region half;
        region_set_half(&half, region, j, side);
        code = add_region(w, &half);
    }
    return code;
}

imp_code winding_add(const winding_view *view, const patch *p, int sign, winding_sum *sum,
                     imp_error *error)
{
    part w = {.view = view, .p = p, .sum = sum, .sign = sign, .error = error};
    const imp_region whole = region_make((double[3]){p->lo[0], p->lo[1], view->t},
                                         (double[3]){p->hi[0], p->hi[1], view->t});
    return add_region(&w, &whole);
}
