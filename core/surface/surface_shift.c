/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface_shift.h"

#include <assert.h>
#include <math.h>

#include "core/base/rounding.h"
#include "core/surface/clocked.h"
#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

/* >= |x|, of three numbers of any sign. Roundings: square, two sums; halved by the root, root. */
PAD_COVERS(8, 1 + 2 + 1);
static double length_upper(const double x[3])
{
    return padded_upper(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), 8) + ROOT_UNDERFLOW;
}

/* A range of t: what a stage follows, and where it is in the middle. */
typedef struct stage_times {
    double lo, hi, middle, half; /* half >= the distance of the ends from the middle */
} stage_times;

static stage_times times_of(shared_instance *p, const value_box *box)
{
    const stage_range range = stage_range_of(p, box);
    stage_times t = {.lo = range.lo, .hi = range.hi};
    const shared_instance *own = clocked_own(p);
    if (!(t.lo >= own->lo[2])) t.lo = own->lo[2];
    if (!(t.hi <= own->hi[2])) t.hi = own->hi[2];
    if (!(t.lo <= t.hi)) { /* it does not exist at these times: the nearest at which it does */
        if (t.lo > own->hi[2])
            t.lo = t.hi;
        else
            t.hi = t.lo;
    }
    t.middle = 0.5 * t.lo + 0.5 * t.hi;
    if (!(t.middle >= t.lo)) t.middle = t.lo;
    if (!(t.middle <= t.hi)) t.middle = t.hi;
    const double below = sum_upper(t.middle, -t.lo), above = sum_upper(t.hi, -t.middle);
    t.half = below > above ? below : above;
    return t;
}

/* How far the clock of the stage is from where the surface stands, at most. */
static double clock_reach_upper(const shared_instance *p, const value_box *box)
{
    const size_t k = p->clock;
    const double below = sum_upper(box->at[k], -box->lo[k]);
    const double above = sum_upper(box->hi[k], -box->at[k]);
    return below > above ? below : above;
}

/* --- Before the maps -------------------------------------------------------------------------- */

static void add_unbounded(surface_extent *extent)
{
    for (int i = 0; i < 3; ++i) extent->lo[i] = -INFINITY, extent->hi[i] = INFINITY;
    extent->speed = INFINITY;
}

static imp_status add_piece(const surface *s, const stage_times *times, surface_extent *extent)
{
    double lo[3], hi[3], rate[3];
    imp_model model[3];
    surface_domain(s, lo, hi);
    lo[2] = times->lo, hi[2] = times->hi;
    const imp_region region = region_make(lo, hi);
    const imp_status status = surface_include_bare(s, &region, model);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        if (!(model[i].lo >= extent->lo[i])) extent->lo[i] = model[i].lo;
        if (!(model[i].hi <= extent->hi[i])) extent->hi[i] = model[i].hi;
        rate[i] = model[i].rate[PARAMETER_T];
    }
    const double speed = rate[0] == 0 && rate[1] == 0 && rate[2] == 0 ? 0 : length_upper(rate);
    if (!(speed <= extent->speed)) extent->speed = speed;
    return status;
}

imp_status surface_extent_find(const surface *s, const value_box *box, surface_extent *extent)
{
    shared_instance *p = surface_stage(s, 0);
    const stage_times times = times_of(p, box);
    imp_status status = IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) extent->lo[i] = INFINITY, extent->hi[i] = -INFINITY;
    extent->speed = 0;
    extent->held = (held_maps){0, 0};
    surface *own = surface_new_of(clocked_own(p));
    if (own == NULL || surface_divide(own) != IMP_SUCCESS) {
        surface_free(own);
        add_unbounded(extent);
        return IMP_STATUS_OK;
    }
    const size_t pieces = surface_piece_count(own);
    for (size_t k = 0; k < (pieces > 0 ? pieces : 1) && status == IMP_STATUS_OK; ++k)
        status = add_piece(pieces > 0 ? surface_piece(own, k) : own, &times, extent);
    surface_free(own);
    if (status != IMP_STATUS_UNBOUNDED) return status;
    add_unbounded(extent);
    return IMP_STATUS_OK;
}

/* --- Through the maps ------------------------------------------------------------------------- */

/* Where the surface is under its first maps: in the box lo..hi, and within `radius` of a point. */
typedef struct reach {
    double lo[3], hi[3], centre[3], radius;
} reach;

static void ball_of_box(reach *r)
{
    double half[3];
    for (int i = 0; i < 3; ++i) {
        r->centre[i] = 0.5 * r->lo[i] + 0.5 * r->hi[i];
        const double below = sum_upper(r->centre[i], -r->lo[i]);
        const double above = sum_upper(r->hi[i], -r->centre[i]);
        half[i] = below > above ? below : above;
    }
    r->radius = length_upper(half);
}

/* What one map does: the map itself, whatever it follows. */
typedef struct step {
    mapping map;
    stage_times times;
    imp_map_rates rates; /* over the reach */
    double stretch;      /* >= |phi(x, t) - phi(y, t)| / |x - y| */
    double speed;        /* >= |phi(x, t) - phi(x, t')| / |t - t'| */
    bool is_rigid;
    bool moves; /* some rate in t is not 0 */
} step;

/* >= |x| of a 3x3 matrix of non-negative rates, as a factor of lengths (Frobenius' norm).
 * Roundings: square, eight sums; halved by the root, root. */
PAD_COVERS(16, 1 + 8 + 1);
static double norm_upper(const imp_map_rates *rates)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += rates->m[i][j] * rates->m[i][j];
    return padded_upper(sqrt(sum), 16) + ROOT_UNDERFLOW;
}

static double speed_of(const imp_map_rates *rates)
{
    const double speed[3] = {rates->m[0][3], rates->m[1][3], rates->m[2][3]};
    return length_upper(speed);
}

/* Lemma. A rate bounds difference quotients along a coordinate, so that over a convex box a map's
 * differences in t are at most its rates' column of t times the difference, and those in space
 * their matrix times the difference. A rigid map lengthens by the factor 1 + 2 IMP_RIGID_SLACK at
 * most (surface_pose_norm_upper), by none where it turns exactly. */
static imp_status step_begin(const mapping *map, const value_box *box, const reach *r, step *to)
{
    const shared_instance *p = map->origin;
    imp_box4 over;
    to->map = *map;
    if (p->inner != NULL) to->map = (mapping){p->inner->map, p->inner->self, p->inner};
    to->times = times_of(map->origin, box);
    for (int i = 0; i < 3; ++i) {
        over.lo[i] = r->lo[i], over.hi[i] = r->hi[i];
        if (!(r->lo[i] > -INFINITY && r->hi[i] < INFINITY)) return IMP_STATUS_UNBOUNDED;
    }
    over.lo[3] = to->times.lo, over.hi[3] = to->times.hi;
    const imp_status status = surface_map_rate(&to->map, &over, &to->rates);
    if (status != IMP_STATUS_OK) return status;
    to->is_rigid = IMP_OFFERS(to->map.type, rigid);
    to->speed = speed_of(&to->rates);
    to->moves = to->rates.m[0][3] != 0 || to->rates.m[1][3] != 0 || to->rates.m[2][3] != 0;
    to->stretch = norm_upper(&to->rates);
    const double rigid = map_turns_exactly(&to->map) ? 1 : 1 + 2 * IMP_RIGID_SLACK;
    if (to->is_rigid && !(to->stretch <= rigid)) to->stretch = rigid;
    return status;
}

static imp_status eval_middle(const step *s, const double at[3], double x[3], double error[3])
{
    const double p[4] = {at[0], at[1], at[2], s->times.middle};
    const surface_call call = surface_call_begin(s->map.type->name, "eval");
    return surface_call_end(call, s->map.type->eval(s->map.self, 1, p, x, error));
}

/* Lemma. The image of a box: as in include_box of surface_include.c, a point of it maps to within
 * sum_j P_ij h_j of the image of the centre in the middle of the times. Four products, each of
 * which goes through at most four sums. */
PAD_COVERS(16, 1 + 4);
static imp_status image_of_box(const step *s, const reach *r, reach *to)
{
    double centre[3], half[4], x[3], error[3];
    for (int j = 0; j < 3; ++j) {
        centre[j] = 0.5 * r->lo[j] + 0.5 * r->hi[j];
        const double below = sum_upper(centre[j], -r->lo[j]);
        const double above = sum_upper(r->hi[j], -centre[j]);
        half[j] = below > above ? below : above;
    }
    half[3] = s->times.half;
    const imp_status status = eval_middle(s, centre, x, error);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i) {
        double sum = error[i];
        for (int j = 0; j < 4; ++j) sum += s->rates.m[i][j] * half[j];
        sum = padded_upper(sum, 16) + PRODUCTS_UNDERFLOW;
        to->lo[i] = difference_lower(x[i], sum);
        to->hi[i] = sum_upper(x[i], sum);
    }
    return status;
}

/* Lemma. With c the ball's centre and m the middle of the times, |phi(x, t) - phi(c, m)| <=
 * |phi(x, t) - phi(c, t)| + |phi(c, t) - phi(c, m)|, of which the first is at most the stretch
 * times the radius, the second the speed of the point c times half of the times. c is no point of
 * the box, perhaps: its rates are asked for alone. Two products, three sums. */
PAD_COVERS(16, 2 + 3);
static imp_status image_of_ball(const step *s, const reach *r, reach *to)
{
    double error[3];
    imp_box4 point;
    imp_map_rates rates;
    for (int i = 0; i < 3; ++i) point.lo[i] = point.hi[i] = r->centre[i];
    point.lo[3] = s->times.lo, point.hi[3] = s->times.hi;
    imp_status status = surface_map_rate(&s->map, &point, &rates);
    if (status == IMP_STATUS_OK) status = eval_middle(s, r->centre, to->centre, error);
    if (status != IMP_STATUS_OK) return status;
    to->radius =
        padded_upper(
            s->stretch * r->radius + speed_of(&rates) * s->times.half + length_upper(error), 16) +
        PRODUCTS_UNDERFLOW;
    for (int i = 0; i < 3; ++i) {
        const double lo = difference_lower(to->centre[i], to->radius);
        const double hi = sum_upper(to->centre[i], to->radius);
        if (lo > to->lo[i]) to->lo[i] = lo;
        if (hi < to->hi[i]) to->hi[i] = hi;
    }
    return status;
}

static imp_status advance(const step *s, reach *r)
{
    reach to = *r;
    imp_status status = image_of_box(s, r, &to);
    if (status == IMP_STATUS_OK && s->is_rigid) status = image_of_ball(s, r, &to);
    if (status != IMP_STATUS_OK) return status;
    *r = to;
    if (!s->is_rigid) ball_of_box(r);
    return IMP_STATUS_OK;
}

/* Whether it exists at all times. */
static bool is_timeless(const shared_instance *p)
{
    return p->lo[2] == -INFINITY && p->hi[2] == INFINITY;
}

static void set_unbounded(const value_box *box, double *shift, surface_image *image)
{
    for (size_t k = 0; k < box->count; ++k) shift[k] = INFINITY;
    image->follows_time = true;
    image->drift = image->slip = INFINITY;
    for (int i = 0; i < 3; ++i) image->lo[i] = -INFINITY, image->hi[i] = INFINITY;
}

/* Lemma. Let x(p) be a point of the surface under its first maps at one u, v and time, c the values
 * `at`, and |x(p) - x(c)| <= sum_k shift_k. Under one map more, which follows q,
 *
 *   |phi(x(p), q(p)) - phi(x(c), q(c))| <= |phi(x(p), q(p)) - phi(x(p), q(c))|
 *                                        + |phi(x(p), q(c)) - phi(x(c), q(c))|,
 *
 * the first at most the speed times |q(p) - q(c)|, since x(p) lies in the reach, the second the
 * stretch times |x(p) - x(c)|, since the reach is convex. What the first adds is counted for the
 * parameter that the map follows. Two products and a sum for each map.
 *
 * Likewise for time: from one time in question to another, stages that follow it move points by at
 * most their speed times the length of the times; `drift` sums these as shifts are summed.
 *
 * Held maps. Under these the surface at p has, for each of its points, one within the slip at c
 * (surface_held_values): with that one for x(c), the above begins with a distance of the slip,
 * which later maps stretch, and goes on with the first map that is not held. */
PAD_COVERS(8, 2 + 1);
imp_status surface_shift_trace(const surface *s, const surface_extent *extent, size_t left_out,
                               const value_box *box, double *shift, surface_image *image,
                               map_reach *reaches)
{
    reach r;
    imp_status status = IMP_STATUS_OK;
    assert(left_out <= s->map_count);
    for (int i = 0; i < 3; ++i) r.lo[i] = extent->lo[i], r.hi[i] = extent->hi[i];
    ball_of_box(&r);
    for (size_t k = 0; k < box->count; ++k) shift[k] = 0;
    bool is_timed = s->origin->inner == NULL && !is_timeless(s->origin);
    const double span = sum_upper(box->t_end, -box->t_start);
    image->slip = extent->held.slip;
    image->drift = s->origin->inner == NULL && extent->speed != 0 ? extent->speed * span : 0;
    if (s->origin->inner != NULL)
        shift[s->origin->clock] =
            padded_upper(extent->speed * clock_reach_upper(s->origin, box), 8) + PRODUCTS_UNDERFLOW;
    for (size_t j = 0; j < s->map_count - left_out && status == IMP_STATUS_OK; ++j) {
        const shared_instance *p = s->maps[j].origin;
        step to;
        status = step_begin(&s->maps[j], box, &r, &to);
        if (reaches != NULL && status == IMP_STATUS_OK)
            reaches[j] = (map_reach){
                {r.centre[0], r.centre[1], r.centre[2]}, r.radius, to.stretch, to.speed};
        if (status == IMP_STATUS_OK) status = advance(&to, &r);
        if (status != IMP_STATUS_OK) break;
        is_timed = is_timed || (p->inner == NULL && !is_timeless(p));
        if (to.stretch != 1) image->drift = padded_upper(image->drift * to.stretch, 8);
        if (p->inner == NULL && to.moves)
            image->drift = padded_upper(image->drift + to.speed * span, 8) + PRODUCTS_UNDERFLOW;
        if (j < extent->held.count) continue;
        if (to.stretch != 1) image->slip = padded_upper(image->slip * to.stretch, 8);
        for (size_t k = 0; k < box->count; ++k) {
            if (to.stretch != 1) shift[k] = padded_upper(shift[k] * to.stretch, 8);
            if (p->inner != NULL && p->clock == k)
                shift[k] = padded_upper(shift[k] + to.speed * clock_reach_upper(p, box), 8) +
                           PRODUCTS_UNDERFLOW;
        }
    }
    for (int i = 0; i < 3; ++i) image->lo[i] = r.lo[i], image->hi[i] = r.hi[i];
    image->drift = padded_upper(image->drift, 8);
    image->follows_time = is_timed || !(image->drift <= SURFACE_STILL);
    if (status != IMP_STATUS_UNBOUNDED) return status;
    set_unbounded(box, shift, image);
    return IMP_STATUS_OK;
}

imp_status surface_shift_upper(const surface *s, const surface_extent *extent, size_t left_out,
                               const value_box *box, double *shift, surface_image *image)
{
    return surface_shift_trace(s, extent, left_out, box, shift, image, NULL);
}
