/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/net_distance.h"

/* Nets of nodes and their axes: halves against exact patches, windows against exact distances, the
 * axis that is found against many others. */

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

SUITE_MAIN("nets", halves_of_nets_follow_the_patch_within_their_errors,
           only_a_cut_in_the_exact_middle_halves_a_net, numbers_too_large_or_small_make_no_net,
           nothing_is_near_outside_of_the_window_that_an_axis_leaves,
           the_window_of_two_points_starts_when_they_are_near,
           an_error_of_the_nets_counts_along_the_axis,
           two_nets_followed_in_time_are_as_near_as_asked_for,
           the_axis_found_shows_most_of_what_any_axis_shows)
