/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/net_halves.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/bounds/net_hull.h"
#include "core/tree/net_rows.h"

IMP_QUAD_INLINE window_ends least_heights(const net *f, const double *x)
{
    imp_quad early = imp_quad_load(x), late = imp_quad_load(x + f->stride);
    for (int k = IMP_QUAD; k < f->stride; k += IMP_QUAD) {
        early = imp_quad_min(imp_quad_load(x + k), early);
        late = imp_quad_min(imp_quad_load(x + f->stride + k), late);
    }
    return (window_ends){least_of(early), least_of(late)};
}

IMP_QUAD_INLINE void heights_take(const node *of, const time_window *w, vec3 axis, double sign,
                                  net_heights *h)
{
    const net *f = node_net_made(of);
    const imp_quad n[3] = {imp_quad_all(sign * axis.x[0]), imp_quad_all(sign * axis.x[1]),
                           imp_quad_all(sign * axis.x[2])};
    const imp_quad t0 = imp_quad_all(w->lo - f->time), t1 = imp_quad_all(w->hi - f->time);
    h->net = f;
    h->region = of->region;
    int k = 0;
    do {
        const imp_quad p = heights_along(f->numbers + k, f->stride, n);
        imp_quad v = imp_quad_all(0);
        if (f->is_moving) v = heights_along(f->numbers + 3 * f->stride + k, f->stride, n);
        imp_quad_store(h->x + k, p + t0 * v);
        imp_quad_store(h->x + f->stride + k, p + t1 * v);
    } while ((k += IMP_QUAD) < f->stride);
    if (f->is_weighted)
        memcpy(h->x + 2 * f->stride, f->numbers + (f->is_moving ? 6 : 3) * f->stride,
               (size_t)f->stride * sizeof(double));
    h->low = least_heights(f, h->x);
    const imp_quad size = imp_quad_abs((imp_quad){axis.x[0], axis.x[1], axis.x[2], 0});
    h->most = sum_of(size * imp_quad_load(f->most));
    h->off = 0;
}

/* --- Halves ----------------------------------------------------------------------------------- */

/* Lemma. Over the window n.(y - x) of points of a half and of the other node is no less than the
 * least difference of heights of their control points, and that is concave in time: heights are
 * linear, and halving takes fixed means of them. So where it is above the limit at both ends of the
 * window, the half is separated. Heights halved k times are those of a patch that is off by the sum
 * of k net_halving_upper: each bounds the rounding of one halving. In units of u R (net_hull.h):
 * heights, their places and R itself are GAP_ROUNDING; the limit less the rest rounds twice, both
 * nodes' heights less what halving moved them by once each: slack is counted twice. A NaN excludes
 * nothing. */
_Static_assert(2 + 2 <= GAP_ROUNDING, "rounding of a half's limit");
PAD_COVERS(64,
           3 + 3 + NET_HALVES_MOST); /* h->most: products and two sums; its own product, the sums */

/* Returns bits of the halves along j whose least heights, less `off`, are not all above `most`. */
IMP_QUAD_INLINE int near_bits(double lower, double upper, double most, double off)
{
    return (int)!(lower - off > most) | (int)!(upper - off > most) << 1;
}

/* Bounds how far halving once more moves heights; the sum is rounded up where it is used. */
static double halved_off(const net_heights *h, parameter j)
{
    return h->off + net_halving_upper(h->net, j, h->most);
}

enum { NONE_LEFT = 0, BOTH_LEFT = 3 };

/* Replaces the region by its half, with these least heights. */
static void keep(net_heights *h, parameter j, int half, double off, double early, double late)
{
    const double by = padded_upper(off, 64);
    h->off = off;
    h->low = (window_ends){early - by, late - by};
    region_set_half(&h->region, &h->region, j, half);
}

/* Heights of both halves of any patch, and the least of them. */
typedef struct any_halves {
    double x[2][3 * IMP_QUAD * QUADS_MAX];
    window_ends low[2];
} any_halves;

static void halve_any(const net_heights *h, parameter j, any_halves *both)
{
    const size_t columns = h->net->is_weighted ? 3 : 2;
    for (int half = 0; half < 2; ++half) {
        memcpy(both->x[half], h->x, columns * (size_t)h->net->stride * sizeof(double));
        net_halve_columns(h->net, j, half, both->x[half], 2);
        both->low[half] = least_heights(h->net, both->x[half]);
    }
}

/* Returns bits of the halves along j that may be near, that is, whose least height is at most
 * `most` at one end of the window. If it is one half alone its heights are kept. */
static int halve_any_heights(net_heights *h, parameter j, window_ends most)
{
    const double off = halved_off(h, j), by = padded_upper(off, 64);
    any_halves both;
    halve_any(h, j, &both);
    const window_ends *low = both.low;
    const int left =
        near_bits(low[0].lo, low[1].lo, most.lo, by) | near_bits(low[0].hi, low[1].hi, most.hi, by);
    if (left == NONE_LEFT || left == BOTH_LEFT) return left;
    memcpy(h->x, both.x[left - 1], sizeof h->x);
    keep(h, j, left - 1, off, low[left - 1].lo, low[left - 1].hi);
    return left;
}

/* Computes heights of both halves of a bicubic patch. Lemma. If it is rational, heights times
 * weights and weights are halved like any numbers; their quotients are the heights. In units of u
 * most: the products and their halving n + 1 in all, weights n, quotients 1, less than
 * halving_units (net.c). */
IMP_QUAD_INLINE halved_rows halve_heights(const double *x, parameter j, const rows *weights,
                                          const halved_rows *by)
{
    rows r = rows_along(rows_at(x), j);
    for (int k = 0; k < 4 && weights != NULL; ++k) r.row[k] = r.row[k] * weights->row[k];
    halved_rows both = rows_halved(r);
    for (int k = 0; k < 7 && weights != NULL; ++k) both.row[k] = both.row[k] / by->row[k];
    return both;
}

IMP_QUAD_INLINE void least_of_halves(const halved_rows *x, double least[2])
{
    const imp_quad *y = x->row;
    const imp_quad lower = imp_quad_min(imp_quad_min(y[0], y[1]), imp_quad_min(y[2], y[3]));
    const imp_quad upper = imp_quad_min(imp_quad_min(y[3], y[4]), imp_quad_min(y[5], y[6]));
    least[0] = least_of(lower);
    least[1] = least_of(upper);
}

/* Does what halve_any_heights does, for bicubic nets. Usually more is near at the window's end than
 * at its start: if both halves are near at the end, the start is not computed. */
IMP_QUAD_INLINE int halve_bicubic_heights(net_heights *h, parameter j, window_ends most,
                                          bool is_weighted)
{
    const double off = halved_off(h, j), by = padded_upper(off, 64);
    rows w;
    halved_rows x[3];
    double early[2], late[2];
    if (is_weighted) {
        w = rows_along(rows_at(h->x + 2 * 16), j);
        x[2] = rows_halved(w);
    }
    x[1] = halve_heights(h->x + 16, j, is_weighted ? &w : NULL, &x[2]);
    least_of_halves(&x[1], late);
    int left = near_bits(late[0], late[1], most.hi, by);
    if (left == BOTH_LEFT) return left;
    x[0] = halve_heights(h->x, j, is_weighted ? &w : NULL, &x[2]);
    least_of_halves(&x[0], early);
    left |= near_bits(early[0], early[1], most.lo, by);
    if (left == NONE_LEFT || left == BOTH_LEFT) return left;
    for (int c = 0; c < 2 + is_weighted; ++c)
        rows_store(h->x + 16 * c, rows_along(rows_of_half(&x[c], left - 1), j));
    keep(h, j, left - 1, off, early[left - 1], late[left - 1]);
    return left;
}

/* --- The search ------------------------------------------------------------------------------- */

/* Returns bits of the parameters along which a half may be excluded: two corners of the half are
 * above `most` at the window's end. */
static int parameters_to_try(const net_heights *h, double most)
{
    const int end = h->net->degree[1], last = h->net->degree[0] * (end + 1);
    const double *x = h->x + h->net->stride;
    const int first = (x[0] > most) | (x[end] > most) << 1;
    const int second = (x[last] > most) | (x[last + end] > most) << 1;
    return (first == 3 || second == 3) | ((first & second) != 0) << 1;
}

/* Excludes halves along u, then along v. */
IMP_QUAD_INLINE bool find_of_side(net_heights *h, window_ends most, net_half *found)
{
    const net *f = h->net;
    const int may = parameters_to_try(h, most.hi);
    for (parameter j = PARAMETER_U; j <= PARAMETER_V; ++j) {
        if (!(may >> j & 1) || !region_can_split(&h->region, j) || !net_can_halve(&h->region, j))
            continue;
        const int left = f->degree[0] != 3 || f->degree[1] != 3 ? halve_any_heights(h, j, most)
                         : f->is_weighted ? halve_bicubic_heights(h, j, most, true)
                                          : halve_bicubic_heights(h, j, most, false);
        if (left == BOTH_LEFT) continue;
        found->along = j;
        found->half = left == NONE_LEFT ? -1 : left - 1;
        return true;
    }
    return false;
}

/* Excludes A's halves, then B's. The nets' places are `at` apart along the axis at the window's
 * ends. */
IMP_QUAD_INLINE bool find_half(net_heights of[2], double limit, window_ends at, net_half *found)
{
    for (found->side = 0; found->side < 2; ++found->side) {
        const window_ends other = of[!found->side].low;
        const window_ends most = {limit - (other.lo + at.lo), limit - (other.hi + at.hi)};
        if (find_of_side(&of[found->side], most, found)) return true;
    }
    return false;
}

IMP_QUAD_INLINE void find(const node *a, const node *b, vec3 axis, double gamma_clear,
                          const time_window *w, net_halves *halves)
{
    const net *p = node_net_made(a), *q = node_net_made(b);
    vec3 n;
    if (p == NULL || q == NULL || !axis_scaled(axis, &n)) return;
    halves->limit = net_limit_upper(n, gamma_clear, 2 * slack_upper(p, q, n, w));
    halves->at = places_along(p, q, n, w);
    if (!(halves->limit < INFINITY && fabs(halves->at.lo) < INFINITY &&
          fabs(halves->at.hi) < INFINITY))
        return;
    heights_take(a, w, n, -1, &halves->of[0]);
    heights_take(b, w, n, 1, &halves->of[1]);
    halves->has_heights = true;
    halves->window = *w;
    net_half *found = halves->found;
    while (halves->count < NET_HALVES_MOST &&
           find_half(halves->of, halves->limit, halves->at, &found[halves->count]))
        if (found[halves->count++].half < 0) break;
}

IMP_QUAD_WIDE static void find_wide(const node *a, const node *b, vec3 axis, double gamma_clear,
                                    const time_window *w, net_halves *halves)
{
    find(a, b, axis, gamma_clear, w, halves);
}

void net_halves_find(const node *a, const node *b, vec3 axis, double gamma_clear,
                     const time_window *window, net_halves *halves)
{
    halves->count = 0;
    halves->has_heights = false;
    if (imp_quad_is_wide())
        find_wide(a, b, axis, gamma_clear, window, halves);
    else
        find(a, b, axis, gamma_clear, window, halves);
}

/* --- Windows of halves ------------------------------------------------------------------------ */

IMP_QUAD_INLINE void bicubic_lows(const net_heights *h, parameter j, bool is_weighted,
                                  window_ends low[2])
{
    rows w;
    halved_rows by;
    double early[2], late[2];
    if (is_weighted) {
        w = rows_along(rows_at(h->x + 2 * 16), j);
        by = rows_halved(w);
    }
    const halved_rows start = halve_heights(h->x, j, is_weighted ? &w : NULL, &by);
    const halved_rows end = halve_heights(h->x + 16, j, is_weighted ? &w : NULL, &by);
    least_of_halves(&start, early);
    least_of_halves(&end, late);
    for (int k = 0; k < 2; ++k) low[k] = (window_ends){early[k], late[k]};
}

static void any_lows(const net_heights *h, parameter j, window_ends low[2])
{
    any_halves both;
    halve_any(h, j, &both);
    memcpy(low, both.low, sizeof both.low);
}

/* Lemma. The least difference of heights is concave in time, so that it lies above the line between
 * its values at the window's ends; where that is above the limit the half is separated. A value
 * sums three numbers more than the limit. */
_Static_assert(3 + 2 <= GAP_ROUNDING, "rounding of a half's line");

IMP_QUAD_INLINE void cut_halves(const net_halves *halves, int side, parameter j,
                                time_window left[2], bool near[2])
{
    const net_heights *h = &halves->of[side];
    const net *f = h->net;
    const window_ends other = halves->of[!side].low, at = halves->at;
    const double by = padded_upper(halved_off(h, j), 64);
    window_ends low[2];
    if (f->degree[0] != 3 || f->degree[1] != 3)
        any_lows(h, j, low);
    else if (f->is_weighted)
        bicubic_lows(h, j, true, low);
    else
        bicubic_lows(h, j, false, low);
    for (int k = 0; k < 2; ++k) {
        const double g0 = low[k].lo - by + (other.lo + at.lo);
        const double g1 = low[k].hi - by + (other.hi + at.hi);
        if (g0 < INFINITY && g1 < INFINITY) near[k] = line_cut(g0, g1, halves->limit, &left[k]);
    }
}

IMP_QUAD_WIDE static void cut_halves_wide(const net_halves *halves, int side, parameter j,
                                          time_window left[2], bool near[2])
{
    cut_halves(halves, side, j, left, near);
}

bool net_halves_cut(const net_halves *halves, int side, parameter j, const time_window *window,
                    time_window left[2], bool near[2])
{
    if (!halves->has_heights || j == PARAMETER_T) return false;
    if (window->lo != halves->window.lo || window->hi != halves->window.hi) return false;
    if (!net_can_halve(&halves->of[side].region, j)) return false;
    for (int k = 0; k < 2; ++k) left[k] = *window, near[k] = true;
    if (imp_quad_is_wide())
        cut_halves_wide(halves, side, j, left, near);
    else
        cut_halves(halves, side, j, left, near);
    return true;
}
