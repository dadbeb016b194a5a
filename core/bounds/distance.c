/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"

#include <impinge/model.h>
#include <string.h>

#include "core/bounds/claim_audit.h"
#include "core/bounds/convex_line.h"
#include "core/bounds/distance_halving.h"
#include "core/bounds/quadratic.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "core/tree/model_lanes.h"

/* --- The distance model ----------------------------------------------------------------------- */

bool distance_is_known(const node *a, const node *b)
{
    return b->many == NULL && surface_has_distance(b->surface) &&
           strategy_distance_pays(a, b, surface_common_maps(a->surface, b->surface));
}

/* Copies a node's Taylor models, with infinite rates: a node keeps none. */
static void point_models(const node *n, imp_model model[3])
{
    const quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i)
        model[i] =
            (imp_model){.a = f->a[i],
                        .b = {f->bu[i], f->bv[i], f->bt[i]},
                        .q = {f->quu[i], f->quv[i], f->qut[i], f->qvv[i], f->qvt[i], f->qtt[i]},
                        .e = n->e[i],
                        .lo = n->lo[i],
                        .hi = n->hi[i],
                        .rate = {INFINITY, INFINITY, INFINITY},
                        .depends = 7};
}

/* Models of the node's points before the maps that both surfaces end with. */
static imp_status points_before(const node *a, size_t common, imp_model model[3])
{
    const surface *s = a->surface;
    if (common > 0)
        return surface_include_inner(s, &a->region, surface_map_count(s) - common, model);
    point_models(a, model);
    return IMP_STATUS_OK;
}

/* Computes the nonlinear extents (node.nonlinear_extent) of models over the region. */
static void bend_of(const imp_model model[3], const imp_region *r, double bend[3])
{
    model_lanes m;
    lanes_gather(model, &m);
    const lanes_spread s = lanes_spread_of(&m, r->d);
    for (int j = 0; j < 3; ++j) bend[j] = lanes_sum(s.curved[j] + s.blame[j]);
}

/* Computes the nonlinear extents of a node's points less a way in time. Models made of a node have
 * infinite rates, by which u and v would share the remainder equally, however straight one of them
 * is: u and v keep the node's extents, and t takes the way's remainder. */
static void bend_beside_way(const node *a, const imp_model point[3], double bend[3])
{
    memcpy(bend, a->nonlinear_extent, sizeof a->nonlinear_extent);
    bend[PARAMETER_T] = a->time_remainder;
    for (int i = 0; i < 3; ++i) {
        const double *k = point[i].q;
        bend[PARAMETER_T] += point[i].e - a->e[i];
        bend[PARAMETER_T] += 2 * fabs(k[IMP_TT]) + 0.5 * fabs(k[IMP_UT]) + 0.5 * fabs(k[IMP_VT]);
    }
}

imp_code distance_fault(const surface *s, imp_status status, imp_error *error)
{
    surface_fault(s, error, ": %s", surface_status_message(s, status).text);
    return surface_set_code(status, error);
}

bool distance_slip_is_small(double slip, double gamma_clear)
{
    return slip < INFINITY && TUNING_DISTANCE_SLIP * slip <= gamma_clear;
}

double distance_slip_enough(double gamma_clear) { return 0.5 * gamma_clear / TUNING_DISTANCE_SLIP; }

bool distance_slides(const distance_question *q)
{
    return !q->is_carried && distance_slip_is_small(q->slip, q->gamma_clear);
}

/* Returns the region over which points are taken: at one moment where the node slides, and with the
 * parameters that are held in the middle. */
static imp_region region_of(const distance_question *q)
{
    const imp_region *r = &q->a->region;
    double lo[3], hi[3];
    memcpy(lo, r->lo, sizeof lo);
    memcpy(hi, r->hi, sizeof hi);
    for (int j = 0; j < 2; ++j)
        if ((q->held >> j & 1) != 0) lo[j] = hi[j] = r->c[j];
    if (distance_slides(q)) lo[2] = hi[2] = q->moment;
    return region_make(lo, hi);
}

/* Whether points_of begins with the node's own models. */
static bool is_of_node(const distance_question *q, size_t common)
{
    return !q->is_ball && !distance_slides(q) && q->held == 0 && common == 0;
}

/* Models of the node's points before the maps that both surfaces end with, over region_of; less
 * b's motion where that is carried. */
static imp_status points_of(const distance_question *q, size_t common, const imp_region *over,
                            imp_model point[3])
{
    const node *a = q->a;
    imp_model way[3];
    imp_status status;
    if (q->is_ball) {
        double radius;
        status = surface_ball(a->surface, over, point, &radius);
        if (status == IMP_STATUS_OK && !(radius <= q->radius)) return IMP_STATUS_UNBOUNDED;
    } else if (!distance_slides(q) && q->held == 0) {
        status = points_before(a, common, point);
    } else {
        /* A cluster's models include the common maps; pair_look requests none. */
        if (a->many != NULL) return IMP_STATUS_UNBOUNDED;
        const size_t maps = surface_map_count(a->surface) - common;
        status = surface_include_inner(a->surface, over, maps, point);
    }
    if (status != IMP_STATUS_OK || !q->is_carried) return status;
    const carry_base base = {q->moment, q->is_bare};
    status = surface_carry_way(q->b->surface, over, &base, way);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i) point[i] = imp_sub(point[i], way[i]);
    return status;
}

imp_status distance_of_points(const distance_question *q, const imp_region *r,
                              const imp_model point[3], imp_model *g)
{
    const surface *b = q->b->surface;
    const size_t common = surface_common_maps(q->a->surface, b);
    const size_t maps = q->is_bare ? 0 : surface_map_count(b) - common;
    if (q->plane != NULL)
        return surface_height_within(b, q->plane, r, point, q->moment, q->slip, g);
    return distance_slides(q) || q->is_carried
               ? surface_distance_within(b, r, maps, point, q->moment, q->slip, g)
               : surface_distance(b, r, maps, point, g);
}

/* Computes the Taylor models of points and *g of their distance. *known false: the type gives no
 * bound. */
static imp_code find_distance(const distance_question *q, imp_model point[3], imp_model *g,
                              double bend[3], bool *known, imp_error *error)
{
    const size_t common = surface_common_maps(q->a->surface, q->b->surface);
    const imp_region over = region_of(q);
    imp_status status = points_of(q, common, &over, point);
    *known = false;
    if (status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    if (status != IMP_STATUS_OK) return distance_fault(q->a->surface, status, error);
    if (!is_of_node(q, common))
        bend_of(point, &over, bend);
    else if (q->is_carried)
        bend_beside_way(q->a, point, bend);
    status = distance_of_points(q, &q->a->region, point, g);
    *known = status == IMP_STATUS_OK;
    if (status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    return distance_fault(q->b->surface, status, error);
}

/* --- Cutting the window ----------------------------------------------------------------------- */

/* Lower bounds of g and -g over a window: g >= low[0] + drift[0] w - e, and -g >= low[1] + drift[1]
 * w - e. */
typedef struct sides {
    double low[2], drift[2];
} sides;

/* The window is t = mid + half w, w in [-1, 1]; half is rounded up. */
typedef struct span {
    double mid, half;
} span;

PAD_COVERS(4, 1); /* half: one difference */
static span span_of(const time_window *window)
{
    const double mid = 0.5 * window->lo + 0.5 * window->hi;
    const double above = window->hi - mid, below = mid - window->lo;
    return (span){mid, padded_upper(above > below ? above : below, 4)};
}

/* Lemma. For fixed s_u, s_v the polynomial of g is q_tt s_t^2 plus terms linear in s_t. So between
 * two times, s - k and s + k, it lies above its chord, less q_tt k^2 where q_tt > 0. The least
 * value of the chords over s_u, s_v lies above the chord between the least values G0 and G1 at
 * either end. The same holds for -g. So
 *
 *   g >= (G0 + G1) / 2 + w (G1 - G0) / 2 - max(q_tt, 0) k^2 - e,
 *
 * or above a line in w below its polynomial as a whole (convex_line.h), less e;
 *
 * |g| <= |x - y| for each point x of the node and each y of the surface: where that exceeds
 * gamma_clear on either side, the node is farther away than gamma_clear.
 * Rounding, in units of u S, S = |a| + sum |b| + sum |q|, |s_t| <= 1 but for rounding:
 *
 *   s_t = s +- k at the ends  8: differences, quotients, sum: 4 of |b_t| + 2 |q_tt| + |q_ut| +
 *                                |q_vt|
 *   value in the middle       4: product, sum, product, sum
 *   slopes at the ends        2: product, sum
 *   least values              QUADRATIC_ROUNDING
 *   G                         2: sum, of 2 S
 *   their chord               6: sums of 2 S, and w_range_cut's
 *   q_tt k^2                  4: quotient twice, products
 *   low                       8: sums of at most 4 S
 *   low - e - |drift|         8: differences of at most 4 S
 */
enum { DISTANCE_ROUNDING = 128 };
_Static_assert(8 + 4 + 2 + QUADRATIC_ROUNDING + 2 + 6 + 4 + 8 + 8 <= DISTANCE_ROUNDING,
               "rounding along a distance");
PAD_COVERS(16, 10 + 3); /* S; e with it, and taken off low */

static double size_upper(const imp_model *g)
{
    double size = fabs(g->a);
    for (int j = 0; j < 3; ++j) size += fabs(g->b[j]);
    for (int k = 0; k < 6; ++k) size += fabs(g->q[k]);
    return padded_upper(size, 16);
}

static sides sides_of(const imp_model *g, const imp_region *r, const span *w, double size)
{
    const double d = r->d[PARAMETER_T], s = d > 0 ? (w->mid - r->c[PARAMETER_T]) / d : 0;
    const double reach = d > 0 ? w->half / d : 0;
    const imp_quad t = {s - reach, s + reach, s - reach, s + reach}, sign = {1, 1, -1, -1};
    const quadratics p = {sign * (imp_quad_all(g->b[0]) + imp_quad_all(g->q[IMP_UT]) * t),
                          sign * (imp_quad_all(g->b[1]) + imp_quad_all(g->q[IMP_VT]) * t),
                          sign * imp_quad_all(g->q[IMP_UU]), sign * imp_quad_all(g->q[IMP_UV]),
                          sign * imp_quad_all(g->q[IMP_VV])};
    const imp_quad middle =
        imp_quad_all(g->a) + (imp_quad_all(g->b[2]) + imp_quad_all(g->q[IMP_TT]) * t) * t;
    const imp_quad least = sign * middle + quadratics_lower(&p);
    sides both;
    for (int k = 0; k < 2; ++k) {
        const double start = least[2 * k], end = least[2 * k + 1];
        const double bend = k == 0 ? g->q[IMP_TT] : -g->q[IMP_TT];
        both.low[k] = 0.5 * (start + end) - (bend > 0 ? bend * (reach * reach) : 0);
        both.drift[k] = 0.5 * (end - start);
        if (!(bend > 0)) continue;
        const convex_line line = convex_line_below(g, k == 0 ? 1 : -1, s, reach, size);
        if (!(line.low - fabs(line.drift) > both.low[k] - fabs(both.drift[k]))) continue;
        both.low[k] = line.low;
        both.drift[k] = line.drift;
    }
    return both;
}

/* Returns a lower bound of |g| by its range, which may do where the remainder is too large. */
static double range_lower(const imp_model *g) { return g->lo > -g->hi ? g->lo : -g->hi; }

/* Returns a lower bound of the distance over the window: the better of both sides. */
static double sides_lower(const sides *both, double slack)
{
    double lower[2];
    for (int k = 0; k < 2; ++k) lower[k] = both->low[k] - slack - fabs(both->drift[k]);
    return lower[0] > lower[1] ? lower[0] : lower[1];
}

distance_view distance_view_none(const node *a)
{
    distance_view view = {.lower = 0};
    memcpy(view.bend, a->nonlinear_extent, sizeof view.bend);
    return view;
}

/* Returns what remainder and rounding take away. */
static double slack_of(const imp_model *g, double size)
{
    return padded_upper(g->e + size * (DISTANCE_ROUNDING * UNIT_ROUNDOFF), 16) +
           QUADRATIC_UNDERFLOW;
}

/* Cuts the window by g and returns what g shows over it: of a ball, of its center. */
static imp_code cut_by(const distance_question *q, const imp_model point[3], const imp_model *g,
                       time_window *window, distance_view *view, imp_error *error)
{
    const double gamma_clear = q->is_ball ? sum_upper(q->gamma_clear, q->radius) : q->gamma_clear;
    const double range = range_lower(g);
    if (range > 0) view->lower = range;
    view->is_apart = range > gamma_clear;
    const double size = size_upper(g);
    if (view->is_apart || !(size < 0x1p400)) return IMP_SUCCESS;
    const span whole = span_of(window);
    const sides both = sides_of(g, &q->a->region, &whole, size);
    const double slack = slack_of(g, size);
    const double lower = sides_lower(&both, slack);
    if (lower > view->lower) view->lower = lower;
    w_range s = {-1, 1};
    for (int k = 0; k < 2 && !view->is_apart; ++k)
        view->is_apart = !w_range_cut(&s, both.low[k] - slack, both.drift[k], gamma_clear);
    if (view->is_apart) return IMP_SUCCESS;
    window_cut(window, whole.mid, whole.half, &s);
    halving_signs of = {.point = point, .g = g, .size = size, .limit = gamma_clear};
    for (int k = 0; k < 2; ++k) of.least[k] = both.low[k] - fabs(both.drift[k]);
    return distance_judge_halving(q, &of, view, error);
}

bool distance_cut_heights(const imp_model *g, int count, const imp_region *r, double gamma_clear,
                          time_window *window, double *lower)
{
    const double size = size_upper(g), range = count > 1 ? range_lower(g) : g->lo;
    *lower = range > 0 ? range : 0;
    if (range > gamma_clear) return true;
    if (!(size < 0x1p400)) return false;
    const span whole = span_of(window);
    const sides both = sides_of(g, r, &whole, size);
    const double slack = slack_of(g, size);
    w_range s = {-1, 1};
    for (int k = 0; k < count; ++k) {
        const double least = both.low[k] - slack - fabs(both.drift[k]);
        if (least > *lower) *lower = least;
        if (!w_range_cut(&s, both.low[k] - slack, both.drift[k], gamma_clear)) return true;
    }
    window_cut(window, whole.mid, whole.half, &s);
    return false;
}

imp_code distance_cut(const distance_question *q, time_window *window, distance_view *view,
                      imp_error *error)
{
    const time_window before = *window;
    imp_model point[3], g;
    bool known;
    *view = distance_view_none(q->a);
    imp_code code = find_distance(q, point, &g, view->bend, &known, error);
    if (code == IMP_SUCCESS && known) code = cut_by(q, point, &g, window, view, error);
    if (code != IMP_SUCCESS || !known) return code;
    if (q->is_ball)
        view->lower = view->lower > q->radius ? difference_lower(view->lower, q->radius) : 0;
    const bool decides =
        view->is_apart || view->lower > 0 || window->lo > before.lo || window->hi < before.hi;
    const bool is_of_types = q->plane == NULL && q->a->many == NULL;
    return decides && is_of_types && q->is_audited ? claim_audit_run(q, &g, &before, error)
                                                   : IMP_SUCCESS;
}
