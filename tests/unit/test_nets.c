/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/net_axis.h"
#include "core/bounds/net_halves.h"
#include "core/witness/contact_estimate.h"
#include "tests/support/compose.h"
#include "tests/support/judge.h"
#include "tests/support/netted.h"
#include "tests/support/sphere_scenes.h"
#include "tests/support/suite.h"

/* Nets of nodes and their axes: halves against exact patches, windows against exact distances, the
 * axis that is found against many others. */

static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};

/* --- Halves ----------------------------------------------------------------------------------- */

/* So that products of numbers and weights underflow. */
static void make_tiny(uint64_t *state, imp_net *g)
{
    g->is_weighted = 1;
    for (int k = 0; k < IMP_NET_POINTS; ++k) g->weight[k] = 0x1p-299 * random_between(state, 1, 2);
    for (int i = 0; i < 3; ++i) {
        g->place[i] = g->drift[i] = 0;
        for (int k = 0; k < IMP_NET_POINTS; ++k)
            g->point[i][k] *= 0x1p-776, g->velocity[i][k] *= 0x1p-776;
    }
}

/* How many of the points of nets halved again and again are surely farther off the first patch than
 * `share` of the errors says. */
static int off_after_halving(uint64_t *state, double share, bool is_tiny)
{
    netted a;
    int off = 0;
    const uint32_t n = (uint32_t)(random_bits(state) % 4), m = (uint32_t)(random_bits(state) % 6);
    const bool bicubic = random_bits(state) % 2;
    draw_net(state, bicubic ? 3 : n, bicubic ? 3 : m, 0, &a);
    if (is_tiny) make_tiny(state, &a.given);
    take(&a, zero, one);
    const imp_region whole = a.n.region;
    imp_region region = whole;
    for (int depth = 0; depth < 24; ++depth) {
        const parameter j = (parameter)(random_bits(state) % 2);
        const int side = (int)(random_bits(state) % 2);
        const net_buffer parent = a.room;
        ck_assert(net_can_halve(&region, j));
        region = region_half(&region, j, side);
        net_halve((const net *)(const void *)parent.memory, j, side, net_in(&a.room));
        imp_net now = given_by(a.n.net);
        for (int i = 0; i < 3; ++i) now.error[i] *= share;
        const double p[3] = {random_between(state, region.lo[0], region.hi[0]),
                             random_between(state, region.lo[1], region.hi[1]),
                             random_between(state, 0, 1)};
        number exact[3];
        fault why;
        num_forget();
        net_value(&a.given, &whole, p, exact);
        off += !judge_net(&now, &region, p, exact, &why);
    }
    return off;
}

START_TEST(halves_of_nets_follow_the_patch_within_their_errors)
{
    uint64_t state = suite_seed();
    int low = 0;
    for (int k = 0; k < suite_times(150); ++k) {
        ck_assert_int_eq(off_after_halving(&state, 1, k % 4 == 0), 0);
        low += off_after_halving(&state, 0.001, false);
    }
    ck_assert_int_gt(low, 0);
}
END_TEST

START_TEST(only_a_cut_in_the_exact_middle_halves_a_net)
{
    const double tenth = 0.1, lo[3] = {0.1, -1, 0}, hi[3] = {0.7, 3, 1};
    imp_region r = region_make(lo, hi);
    ck_assert(net_can_halve(&r, PARAMETER_V) && net_can_halve(&r, PARAMETER_T));
    ck_assert(!net_can_halve(&r, PARAMETER_U)); /* 0.1 + 0.7 is not a double */
    r = region_make((double[3]){-tenth, 0, 0}, (double[3]){tenth, 0x1p-1074, 1});
    ck_assert(net_can_halve(&r, PARAMETER_U));
    ck_assert(!net_can_halve(&r, PARAMETER_V));
}
END_TEST

START_TEST(numbers_too_large_or_small_make_no_net)
{
    uint64_t state = suite_seed();
    netted a;
    draw_net(&state, 2, 2, 1, &a);
    a.n.region = region_make(zero, one);
    a.given.point[1][4] = 1e200;
    ck_assert(!net_take(net_in(&a.room), &a.given, &a.n.region));
    a.given.point[1][4] = 0;
    a.given.is_weighted = 1;
    a.given.weight[8] = 1e-200;
    ck_assert(!net_take(net_in(&a.room), &a.given, &a.n.region));
    a.given.weight[8] = 1;
    ck_assert(net_take(net_in(&a.room), &a.given, &a.n.region));
    a.given.is_moving = 1;
    a.given.velocity[2][8] =
        1e300; /* at a single time: infinite along an axis, times a time of 0 */
    a.n.region = region_make(zero, (const double[3]){1, 1, 0});
    ck_assert(!net_take(net_in(&a.room), &a.given, &a.n.region));
    a.given.velocity[2][8] = 0;
    a.n.region =
        region_make(zero, (const double[3]){1, 1, 1e300}); /* what underflows is multiplied */
    ck_assert(!net_take(net_in(&a.room), &a.given, &a.n.region));
}
END_TEST

/* --- Windows ---------------------------------------------------------------------------------- */

/* The squared distance of points of two nets. */
static number square_between(const netted *const both[2], const double p[2][3])
{
    number x[2][3], sum = num(0);
    for (int side = 0; side < 2; ++side)
        net_value(&both[side]->given, &both[side]->n.region, p[side], x[side]);
    for (int i = 0; i < 3; ++i) sum = num_add(sum, num_sqr(num_sub(x[0][i], x[1][i])));
    return sum;
}

/* A surely smaller distance than gamma_clear, at random parameters and time t. */
static bool surely_near(uint64_t *state, const netted *a, const netted *b, double t,
                        double gamma_clear)
{
    const netted *const both[2] = {a, b};
    double p[2][3];
    num_forget();
    for (int side = 0; side < 2; ++side) {
        for (int j = 0; j < 2; ++j) p[side][j] = random_fraction(state);
        p[side][2] = t;
    }
    return num_is_less(square_between(both, p), num_sqr(num(gamma_clear)));
}

START_TEST(nothing_is_near_outside_of_the_window_that_an_axis_leaves)
{
    uint64_t state = suite_seed();
    int cuts = 0, apart = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a, b;
        const double far = random_bits(&state) % 2 ? 2 : 0.5;
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), (uint32_t)(random_bits(&state) % 4),
                 far, &a);
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), 3, far, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{random_between(&state, -1, 1), random_between(&state, -1, 1), 1}};
        time_window w = {0, 1};
        const double gamma_clear = random_power(&state, -6, 1);
        net_axis_seek(&a.n, &b.n, 0, &axis);
        const bool some = net_axis_cut(&a.n, &b.n, axis, gamma_clear, &w);
        apart += !some;
        cuts += some && (w.lo > 0 || w.hi < 1);
        for (int l = 0; l < 4 && (!some || w.lo > 0); ++l) {
            const double t = some ? random_between(&state, 0, w.lo) : random_fraction(&state);
            ck_assert(!surely_near(&state, &a, &b, t, gamma_clear));
        }
        if (some && w.hi < 1)
            ck_assert(!surely_near(&state, &a, &b, random_between(&state, w.hi, 1), gamma_clear));
    }
    ck_assert_int_gt(cuts, suite_times(3000) / 20);
    ck_assert_int_gt(apart, suite_times(3000) / 20);
}
END_TEST

/* Two points on a line, from 1 apart to 0: nearer than gamma_clear c from t = 1 - c on, to the last
 * bits, however far from the origin; and never later. */
START_TEST(the_window_of_two_points_starts_when_they_are_near)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(2000); ++k) {
        netted a = {.given = {.degree = {0, 0}}}, b = a;
        const double far = ldexp(1, (int)random_between(&state, -8, 20));
        const double gamma_clear = random_power(&state, -30, -1);
        const int i = (int)random_between(&state, 0, 3);
        a.given.place[i] = far, b.given.place[i] = far + 1;
        b.given.drift[i] = -1;
        b.given.point[i][0] = -0.5; /* at t = 1/2 */
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{0, 0, 0}};
        axis.x[i] = random_power(&state, -20, 20);
        time_window w = {0, 1};
        ck_assert(net_axis_cut(&a.n, &b.n, axis, gamma_clear, &w));
        ck_assert(w.lo <= 1 - gamma_clear && w.hi == 1);
        ck_assert(w.lo >= 1 - gamma_clear - 64 * 0x1p-53 * (far + 4));
    }
}
END_TEST

START_TEST(an_error_of_the_nets_counts_along_the_axis)
{
    netted a = {.given = {.degree = {0, 0}}}, b = a;
    b.given.point[2][0] = 1;
    a.given.error[2] = 0.25, b.given.error[2] = 0.5;
    a.given.error[0] = 100;
    take(&a, zero, one);
    take(&b, zero, one);
    time_window w = {0, 1};
    ck_assert(net_axis_cut(&a.n, &b.n, (vec3){{0, 0, 1}}, 0.2500001, &w));
    ck_assert(!net_axis_cut(&a.n, &b.n, (vec3){{0, 0, 1}}, 0.2499999, &w));
}
END_TEST

/* --- Halves that an axis excludes ------------------------------------------------------------- */

/* A random point of what was excluded last, of what the halves before it had left; of any where
 * nothing is left. */
static void draw_excluded(uint64_t *state, const net_half *halves, int count, double p[2][3])
{
    double lo[2][2] = {{0, 0}, {0, 0}}, hi[2][2] = {{1, 1}, {1, 1}};
    for (int k = 0; k < count; ++k) {
        const net_half *h = &halves[k];
        const double middle = 0.5 * (lo[h->side][h->along] + hi[h->side][h->along]);
        const int taken = k < count - 1 ? h->half : !h->half;
        if (h->half >= 0) (*(taken == 0 ? &hi : &lo))[h->side][h->along] = middle;
    }
    for (int side = 0; side < 2; ++side)
        for (int j = 0; j < 2; ++j) p[side][j] = random_between(state, lo[side][j], hi[side][j]);
}

START_TEST(nothing_of_a_half_that_an_axis_excludes_is_near)
{
    uint64_t state = suite_seed();
    int found = 0, deep = 0, all = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a, b;
        const netted *const both[2] = {&a, &b};
        const bool bicubic = random_bits(&state) % 2;
        draw_net(&state, bicubic ? 3 : (uint32_t)(random_bits(&state) % 4),
                 bicubic ? 3 : (uint32_t)(random_bits(&state) % 4), 1, &a);
        draw_net(&state, 3, 3, 1, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{random_between(&state, -1, 1), random_between(&state, -1, 1), 1}};
        const double start = random_fraction(&state);
        const time_window w = {start, start + (1 - start) * random_power(&state, -10, 0)};
        const double gamma_clear = random_power(&state, -6, 1);
        net_halves halves;
        net_axis_seek(&a.n, &b.n, w.lo, &axis);
        net_halves_find(&a.n, &b.n, axis, gamma_clear, &w, &halves);
        const int count = halves.count;
        if (count == 0) continue;
        found += 1, deep += count > 3, all += halves.found[count - 1].half < 0;
        for (int l = 0; l < 4 * count; ++l) {
            const double t = random_between(&state, w.lo, w.hi);
            double p[2][3] = {{0, 0, t}, {0, 0, t}};
            draw_excluded(&state, halves.found, 1 + l % count, p);
            num_forget();
            ck_assert(!num_is_less(square_between(both, p), num_sqr(num(gamma_clear))));
        }
    }
    ck_assert_int_gt(found, suite_times(3000) / 20);
    ck_assert_int_gt(deep, suite_times(3000) / 40);
    ck_assert_int_gt(all, suite_times(3000) / 20);
}
END_TEST

/* A point, and a line of which the upper half lies from 1 on at the start, from `end` at the
 * end. */
static bool upper_half_is_excluded(double gamma_clear, double end, double error)
{
    netted a = {.given = {.degree = {0, 0}}}, b = {.given = {.degree = {1, 0}}};
    const time_window w = {0, 1};
    net_halves left;
    b.given.point[2][1] = 2;
    b.given.place[2] = 0.5 * (end - 1); /* at t = 1/2 */
    b.given.drift[2] = end - 1;
    b.given.error[2] = error;
    take(&a, zero, one);
    take(&b, zero, one);
    net_halves_find(&a.n, &b.n, (vec3){{0, 0, 1}}, gamma_clear, &w, &left);
    if (left.count == 0) return false;
    const net_half first = left.found[0];
    ck_assert(first.side == 1 && first.along == PARAMETER_U && first.half == 0);
    return true;
}

START_TEST(a_half_is_excluded_where_it_is_out_of_reach_all_the_time)
{
    ck_assert(upper_half_is_excluded(0.9999999, 1, 0));
    ck_assert(!upper_half_is_excluded(1.0000001, 1, 0));
    ck_assert(!upper_half_is_excluded(1, 1, 0)); /* rounding counts */
    ck_assert(!upper_half_is_excluded(1.0000001, 1.5, 0));
    ck_assert(!upper_half_is_excluded(0.9999999, 0.9, 0));
    ck_assert(upper_half_is_excluded(0.8999999, 0.9, 0));
    ck_assert(upper_half_is_excluded(0.7499999, 1, 0.25 / 2));
    ck_assert(!upper_half_is_excluded(0.9, 1, 0.25));
}
END_TEST

/* Whether no point of the half is near outside of the window that is left of it. */
static bool is_window_of_half(uint64_t *state, const netted *const both[2],
                              const net_halves *halves, int side, const imp_region *half, bool near,
                              const time_window *left, double gamma_clear)
{
    const time_window *w = &halves->window;
    double p[2][3], t = random_between(state, w->lo, w->hi);
    if (near && random_bits(state) % 2) t = random_between(state, w->lo, left->lo);
    if (near && t > left->lo) t = random_between(state, left->hi, w->hi);
    if (near && t >= left->lo && t <= left->hi) return true;
    for (int k = 0; k < 2; ++k) {
        const imp_region *r = k == side ? half : &halves->of[k].region;
        for (int j = 0; j < 2; ++j) p[k][j] = random_between(state, r->lo[j], r->hi[j]);
        p[k][2] = t;
    }
    num_forget();
    return !num_is_less(square_between(both, p), num_sqr(num(gamma_clear)));
}

START_TEST(nothing_of_a_half_is_near_outside_of_its_window)
{
    uint64_t state = suite_seed();
    int cuts = 0;
    for (int k = 0; k < suite_times(6000); ++k) {
        netted a, b;
        const netted *const both[2] = {&a, &b};
        const bool bicubic = random_bits(&state) % 2;
        draw_net(&state, bicubic ? 3 : (uint32_t)(random_bits(&state) % 4),
                 bicubic ? 3 : (uint32_t)(random_bits(&state) % 4), 1, &a);
        draw_net(&state, 3, 3, 1, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{random_between(&state, -1, 1), random_between(&state, -1, 1), 1}};
        const double gamma_clear = random_power(&state, -6, 1);
        const time_window w = {0, random_power(&state, -6, 0)}, longer = {0, 2 * w.hi};
        const int side = (int)(random_bits(&state) % 2);
        const parameter j = random_bits(&state) % 2 ? PARAMETER_U : PARAMETER_V;
        net_halves halves;
        time_window left[2];
        bool near[2];
        net_axis_seek(&a.n, &b.n, w.lo, &axis);
        net_halves_find(&a.n, &b.n, axis, gamma_clear, &w, &halves);
        if (halves.count > 0 && halves.found[halves.count - 1].half < 0) continue;
        ck_assert(!net_halves_cut(&halves, side, PARAMETER_T, &w, left, near));
        ck_assert(!net_halves_cut(&halves, side, j, &longer, left, near));
        ck_assert(net_halves_cut(&halves, side, j, &w, left, near));
        for (int l = 0; l < 8; ++l) {
            const imp_region half = region_half(&halves.of[side].region, j, l % 2);
            cuts += near[l % 2] && (left[l % 2].lo > w.lo || left[l % 2].hi < w.hi);
            ck_assert(is_window_of_half(&state, both, &halves, side, &half, near[l % 2],
                                        &left[l % 2], gamma_clear));
        }
    }
    ck_assert_int_gt(cuts, suite_times(6000) / 20);
}
END_TEST

/* The hulls of the halves, made, show the same. */
START_TEST(windows_of_halves_are_those_that_their_hulls_leave)
{
    uint64_t state = suite_seed();
    int cuts = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a, b;
        draw_net(&state, 3, 3, 1, &a);
        draw_net(&state, 3, 3, 1, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{random_between(&state, -1, 1), random_between(&state, -1, 1), 1}};
        const double gamma_clear = random_power(&state, -6, 1);
        const time_window w = {0, 1};
        const parameter j = random_bits(&state) % 2 ? PARAMETER_U : PARAMETER_V;
        net_halves halves;
        time_window left[2], hull = w;
        bool near[2];
        net_axis_seek(&a.n, &b.n, w.lo, &axis);
        net_halves_find(&a.n, &b.n, axis, gamma_clear, &w, &halves);
        if (halves.count > 0) continue;
        ck_assert(net_halves_cut(&halves, 0, j, &w, left, near));
        net_halve(a.n.net, j, 1, net_in(&a.room));
        if (!net_axis_cut(&a.n, &b.n, axis, gamma_clear, &hull) || !near[1]) continue;
        cuts += hull.lo > 0 || hull.hi < 1;
        ck_assert_double_eq_tol(left[1].lo, hull.lo, 1e-9);
        ck_assert_double_eq_tol(left[1].hi, hull.hi, 1e-9);
    }
    ck_assert_int_gt(cuts, suite_times(3000) / 100);
}
END_TEST

/* --- Upper times ------------------------------------------------------------------------------ */

START_TEST(two_nets_followed_in_time_are_as_near_as_asked_for)
{
    uint64_t state = suite_seed();
    int met = 0;
    for (int k = 0; k < suite_times(1000); ++k) {
        netted a, b;
        const netted *const both[2] = {&a, &b};
        const time_window w = {0.25, 1};
        const double gap = random_power(&state, -30, -10);
        contact_estimate found;
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), 3, 1, &a);
        draw_net(&state, 3, (uint32_t)(random_bits(&state) % 4), 1, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        vec3 axis = {{0, 0, 1}};
        net_axis_seek(&a.n, &b.n, w.lo, &axis);
        if (!contact_estimate_find(&a.n, &b.n, axis, &w, gap, &found)) continue;
        met += 1;
        ck_assert(w.lo <= found.t && found.t <= w.hi);
        double p[2][3];
        for (int side = 0; side < 2; ++side) {
            for (int j = 0; j < 2; ++j) {
                const double s = found.y[2 * side + j];
                ck_assert(-1 <= s && s <= 1);
                p[side][j] = 0.5 + 0.5 * s;
            }
            p[side][2] = found.t;
        }
        num_forget();
        ck_assert(num_is_less(square_between(both, p), num_sqr(num(1.25 * gap + 1e-12))));
    }
    ck_assert_int_gt(met, suite_times(1000) / 10);
}
END_TEST

/* --- Axes ------------------------------------------------------------------------------------- */

/* The least of n.(y - x) over all pairs of control points at time t, for n of length 1. */
static double brute_gap(const netted *a, const netted *b, double t, vec3 n)
{
    double least = INFINITY;
    const imp_net *f = &a->given, *g = &b->given;
    for (uint32_t k = 0; k < (f->degree[0] + 1) * (f->degree[1] + 1); ++k)
        for (uint32_t l = 0; l < (g->degree[0] + 1) * (g->degree[1] + 1); ++l) {
            double gap = 0;
            for (int i = 0; i < 3; ++i) {
                const double tau = t - 0.5;
                const double x = f->place[i] + f->point[i][k] +
                                 tau * (f->drift[i] + (f->is_moving ? f->velocity[i][k] : 0));
                const double y = g->place[i] + g->point[i][l] +
                                 tau * (g->drift[i] + (g->is_moving ? g->velocity[i][l] : 0));
                gap += n.x[i] * (y - x);
            }
            if (gap < least) least = gap;
        }
    return least / vec3_norm(n);
}

START_TEST(the_axis_found_shows_most_of_what_any_axis_shows)
{
    enum { AXES = 300 };
    uint64_t state = suite_seed();
    int found = 0, met = 0;
    for (int k = 0; k < suite_times(200); ++k) {
        netted a, b;
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), 3, 2, &a);
        draw_net(&state, 3, (uint32_t)(random_bits(&state) % 4), 2, &b);
        take(&a, zero, one);
        take(&b, zero, one);
        const double t = random_fraction(&state);
        vec3 axis = {{1, 0, 0}};
        const bool some = net_axis_seek(&a.n, &b.n, t, &axis);
        const double shown = some ? brute_gap(&a, &b, t, axis) : 0;
        found += some, met += !some;
        for (int l = 0; l < AXES; ++l) {
            const vec3 n = {{random_between(&state, -1, 1), random_between(&state, -1, 1),
                             random_between(&state, -1, 1)}};
            const double other = brute_gap(&a, &b, t, n);
            ck_assert_msg(shown >= 0.69 * other || other < 1e-9, "%g, another axis %g", shown,
                          other);
        }
    }
    ck_assert_int_gt(found, suite_times(200) / 5);
    ck_assert_int_ge(met, suite_times(200) / 20);
}
END_TEST

/* --- Who is asked for one --------------------------------------------------------------------- */

static int asked;

static imp_status counting_net(const void *self, const imp_region *region, imp_net *to)
{
    (void)self, (void)region, (void)to;
    asked += 1;
    return IMP_STATUS_UNBOUNDED;
}

/* A square in the way of the ball. */
static void tile_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const ball *b = self;
    out[0] = imp_shift(imp_scale(t, b->velocity[0]), 0.5 * b->centre[0]);
    out[1] = imp_scale(u, 0.5);
    out[2] = imp_scale(v, 0.5);
}
IMP_SURFACE_FORMULA(tile_formula)

/* Models that bend, that are remainders alone, as there are no inclusions, and that are flat. */
typedef enum model_kind { BENT, BLURRED, FLAT } model_kind;

/* How often types of which the first `offering` of two have the callback are asked for nets, by a
 * query for the first contact or the minimum distance. */
static int times_asked(int offering, model_kind kind, bool minimum)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0, 0}, .velocity = {-2, 0, 0}};
    imp_surface_type plain = ball_type;
    if (kind == BLURRED) plain.include = NULL;
    if (kind == FLAT) {
        plain.eval = tile_formula_eval;
        plain.rate = tile_formula_rate;
        plain.include = tile_formula_include;
    }
    imp_surface_type type = plain;
    type.net = counting_net;
    imp_scene *scene =
        spheres_scene(offering > 0 ? &type : &plain, &a, offering > 1 ? &type : &plain, &b);
    imp_options options = imp_options_default(scene);
    options.max_pairs = 1000;
    imp_query *query = minimum ? imp_clearance_new(scene, &options, NULL, NULL)
                               : imp_query_new(scene, &options, NULL);
    asked = 0;
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_uint_gt(imp_query_result(query).stats.pairs, kind == FLAT ? 0 : 10);
    imp_query_free(query);
    imp_scene_free(scene);
    return asked;
}

START_TEST(a_net_is_asked_for_where_it_may_say_more_than_a_model_of_the_pair)
{
    ck_assert_int_eq(times_asked(0, BENT, false), 0);
    ck_assert_int_gt(times_asked(1, BENT, false), 2);
    ck_assert_int_gt(times_asked(2, BENT, false), 2);
    ck_assert_int_gt(times_asked(1, BLURRED, false), 2);
    ck_assert_int_gt(times_asked(2, BLURRED, false), 2);
    ck_assert_int_eq(times_asked(1, FLAT, false), 0);
    ck_assert_int_eq(times_asked(2, FLAT, false), 0);
    ck_assert_int_eq(times_asked(2, BENT, true), 0);
}
END_TEST

/* --- Nets that are rough ---------------------------------------------------------------------- */

/* The quadratic of a region of the ball's that is not too large, with its remainder; halves of it
 * have the same. */
static imp_status rough_net(const void *self, const imp_region *region, imp_net *to)
{
    static const double s[3] = {-1, 0, 1},
                        ss[3] = {1, -1, 1}; /* Bernstein coefficients of s and s^2 */
    const ball *b = self;
    imp_model f[3];
    if (ball_formula_include(self, region, f) != IMP_STATUS_OK) return IMP_STATUS_UNBOUNDED;
    to->degree[0] = to->degree[1] = 2;
    for (int i = 0; i < 3; ++i) {
        if (!(f[i].e < 0.02)) return IMP_STATUS_UNBOUNDED;
        for (int k = 0; k < 9; ++k) {
            const int u = k / 3, v = k % 3;
            to->point[i][k] = f[i].a + f[i].b[0] * s[u] + f[i].b[1] * s[v] +
                              f[i].q[IMP_UU] * ss[u] + f[i].q[IMP_UV] * s[u] * s[v] +
                              f[i].q[IMP_VV] * ss[v];
        }
        to->drift[i] = b->velocity[i];
        to->error[i] = f[i].e + 1e-12;
    }
    return IMP_STATUS_OK;
}

static double contact_of_balls(const imp_surface_type *type)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0.3, 0.2}, .velocity = {-2, 0, 0}};
    imp_scene *scene = spheres_scene(type, &a, type, &b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-6;
    options.max_pairs = 100000;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    imp_query_free(query);
    imp_scene_free(scene);
    return r.t;
}

START_TEST(a_contact_is_found_where_nets_leave_their_surfaces_by_more_than_gamma)
{
    imp_surface_type rough = ball_type;
    rough.net = rough_net;
    ck_assert_double_eq_tol(contact_of_balls(&rough), contact_of_balls(&ball_type), 1e-6);
}
END_TEST

SUITE_MAIN("nets", a_net_is_asked_for_where_it_may_say_more_than_a_model_of_the_pair,
           halves_of_nets_follow_the_patch_within_their_errors,
           only_a_cut_in_the_exact_middle_halves_a_net, numbers_too_large_or_small_make_no_net,
           nothing_is_near_outside_of_the_window_that_an_axis_leaves,
           the_window_of_two_points_starts_when_they_are_near,
           an_error_of_the_nets_counts_along_the_axis,
           nothing_of_a_half_that_an_axis_excludes_is_near,
           a_half_is_excluded_where_it_is_out_of_reach_all_the_time,
           nothing_of_a_half_is_near_outside_of_its_window,
           windows_of_halves_are_those_that_their_hulls_leave,
           two_nets_followed_in_time_are_as_near_as_asked_for,
           the_axis_found_shows_most_of_what_any_axis_shows,
           a_contact_is_found_where_nets_leave_their_surfaces_by_more_than_gamma)
