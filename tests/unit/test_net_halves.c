/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/net_distance.h"

/* Halves of nets that an axis excludes, against exact distances. */

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

/* Draws b, which is bicubic, and a, which is so in half of all cases and else of any degree. */
static void draw_beside_bicubic(uint64_t *state, netted *a, netted *b)
{
    const bool bicubic = random_bits(state) % 2;
    draw_net(state, bicubic ? 3 : (uint32_t)(random_bits(state) % 4),
             bicubic ? 3 : (uint32_t)(random_bits(state) % 4), 1, a);
    draw_net(state, 3, 3, 1, b);
    take(a, zero, one);
    take(b, zero, one);
}

START_TEST(nothing_of_a_half_that_an_axis_excludes_is_near)
{
    uint64_t state = suite_seed();
    int found = 0, deep = 0, all = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a, b;
        const netted *const both[2] = {&a, &b};
        draw_beside_bicubic(&state, &a, &b);
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
        draw_beside_bicubic(&state, &a, &b);
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

SUITE_MAIN("net_halves", nothing_of_a_half_that_an_axis_excludes_is_near,
           a_half_is_excluded_where_it_is_out_of_reach_all_the_time,
           nothing_of_a_half_is_near_outside_of_its_window,
           windows_of_halves_are_those_that_their_hulls_leave)
