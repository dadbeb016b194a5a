/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/edge_nodes.h"

/* Lower bounds of the distance of two nodes, and the axes that show them. */

static long double gap_of(const meeting *m)
{
    return sqrtl(m->gap[0] * m->gap[0] + m->gap[1] * m->gap[1] + m->gap[2] * m->gap[2]);
}

/* Whatever is enough, and whatever moment the axes are chosen for. Where the whole window is kept,
 * the bound is now and then more than half of the gap. */
START_TEST(no_gap_is_below_the_lower_bound_of_the_distance)
{
    uint64_t state = suite_seed() + 4;
    int tight = 0;
    for (int k = 0; k < suite_times(60000); ++k) {
        meeting m;
        random_meeting(&state, &m, (posture)(k % POSTURES));
        const long double gap = gap_of(&m);
        const double enough = k % 3 == 0 ? INFINITY : (double)gap * random_power(&state, -1, 1);
        time_window left = m.window;
        vec3 axis = random_axis(&state);
        approach near = {NAN, k % 2 == 0 ? m.t : random_between(&state, -1, 2)};
        const bool some = separation_approach(&m.a, &m.b, enough, &left, &axis, &near);
        const bool kept = some && left.lo <= m.t && m.t <= left.hi;
        ck_assert_msg(kept || gap > enough, "case %d: %Lg apart, pruned at %g", k, gap, enough);
        ck_assert_msg(near.lower <= gap || (near.lower > enough && gap > enough),
                      "case %d: %Lg apart, lower bound %g", k, gap, near.lower);
        tight += near.lower > 0.5L * gap;
    }
    ck_assert_int_gt(tight, suite_times(60000) / 100);
}
END_TEST

START_TEST(a_share_keeps_every_moment_within_the_limit)
{
    uint64_t state = suite_seed() + 3;
    for (int k = 0; k < suite_times(100000); ++k) {
        const double low = random_between(&state, -1, 1), w = suite_end_or_inside(&state);
        const double drift = random_between(&state, -1, 1) * random_power(&state, -10, 10);
        double limit = low + drift * w;
        while (limit < low + (long double)drift * w) limit = nextafter(limit, INFINITY);
        w_range s = {-1, 1};
        ck_assert(w_range_cut(&s, low, drift, limit));
        ck_assert_msg(s.lo <= w && w <= s.hi, "%a + %a w is %a at w = %a, left [%a, %a]", low,
                      drift, limit, w, s.lo, s.hi);
    }
}
END_TEST

/* The least and the greatest of n.x over a grid on the slice as it is at w = -1. */
static void slice_extent(const slice *f, vec3 n, double *lo, double *hi)
{
    enum { SIDE = 17 };
    *lo = INFINITY, *hi = -INFINITY;
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const double u = -1 + 2.0 * (k / SIDE) / (SIDE - 1), v = -1 + 2.0 * (k % SIDE) / (SIDE - 1);
        double height = 0;
        for (int i = 0; i < 3; ++i)
            height += n.x[i] * ((f->bu[i] - f->quw[i] + f->quu[i] * u + f->quv[i] * v) * u +
                                (f->bv[i] - f->qvw[i] + f->qvv[i] * v) * v);
        *lo = fmin(*lo, height);
        *hi = fmax(*hi, height);
    }
}

/* The gap that an axis shows at the window's start. */
static double gap_along(const difference *r, vec3 n)
{
    double a[2], b[2], gap = 0;
    slice_extent(&r->a, n, &a[0], &a[1]);
    slice_extent(&r->b, n, &b[0], &b[1]);
    const vec3 offset = difference_offset(r, -1);
    for (int i = 0; i < 3; ++i) gap += n.x[i] * offset.x[i] - fabs(n.x[i]) * r->slack[i];
    return (gap + b[0] - a[1]) / vec3_norm(n);
}

START_TEST(no_axis_shows_much_more_than_twice_the_gap_of_the_nearest)
{
    uint64_t state = suite_seed() + 2;
    int apart = 0;
    for (int k = 0; k < suite_times(300); ++k) {
        meeting m;
        random_node(&state, &m.a, 1, 0.1, 1);
        random_node(&state, &m.b, random_power(&state, -6, 0), 0.1, 1);
        for (int i = 0; i < 3; ++i) m.b.f.a[i] = random_between(&state, -3, 3);
        difference r;
        double best = 0;
        difference_at(&m.a, &m.b, &(time_window){0, 1}, &r);
        for (int n = 0; n < 100; ++n) {
            vec3 axis;
            for (int i = 0; i < 3; ++i) axis.x[i] = random_between(&state, -1, 1);
            best = fmax(best, gap_along(&r, axis));
        }
        vec3 axis = difference_offset(&r, -1);
        const bool found = gjk_axis(&r, -1, &axis);
        if (best == 0) continue;
        ++apart;
        ck_assert_msg(found && gap_along(&r, axis) > 0.4 * best, "case %d: %g, %g", k,
                      found ? gap_along(&r, axis) : 0, best);
    }
    ck_assert_int_gt(apart, suite_times(300) / 4);
}
END_TEST

/* An edge along v that slides over one along u, `gap` above it, and over both of its ends. */
static meeting two_edges(double gap)
{
    const double n[3] = {0.48, 0.6, 0.64}, u[3] = {0.8, 0, -0.6}, v[3] = {-0.36, 0.8, -0.48};
    meeting m = two_caps(1, 1, gap);
    for (int i = 0; i < 3; ++i) {
        m.a.f.bv[i] = m.b.f.bv[i] = 0;
        m.a.f.quu[i] = m.a.f.qvv[i] = m.b.f.quu[i] = m.b.f.qvv[i] = 0;
        m.b.f.a[i] = gap * n[i] + 0.1 * u[i];
        m.b.f.bu[i] = v[i] + 0.3 * u[i];
        m.b.f.bt[i] = 2.5 * u[i];
    }
    m.a.extent[0] = m.b.extent[0] = 1;
    return m;
}

START_TEST(edges_that_slide_past_each_other_are_parted_at_once)
{
    for (int k = 5; k < 26; ++k) {
        meeting m = two_edges(ldexp(1, -k));
        vec3 axis = {{0, 0, 0}};
        ck_assert_msg(!separation_window(&m.a, &m.b, ldexp(0.25, -k), &m.window, &axis, NULL),
                      "2^-%d apart: [%g, %g] is left", k, m.window.lo, m.window.hi);
    }
}
END_TEST

START_TEST(where_hulls_meet_there_is_no_gjk_axis)
{
    meeting m = two_caps(0.1, -1, -0.001);
    difference r;
    vec3 axis = {{1, 2, 3}};
    difference_at(&m.a, &m.b, &m.window, &r);
    ck_assert(!gjk_axis(&r, -1, &axis));
    ck_assert(axis.x[0] == 1 && axis.x[1] == 2 && axis.x[2] == 3);
}
END_TEST

/* Coefficient k of all three coordinates; 10: the remainders. */
static void spoil(node *n, int k, double value)
{
    double *coordinates = k < 10 ? (double *)&n->f + 3 * k : n->e;
    for (int i = 0; i < 3; ++i) coordinates[i] = value;
}

/* What touches: two faces; edges that cross; an edge of one side on the other's face; a corner. */
enum { FACES, EDGES, EDGE_OF_A, EDGE_OF_B, CORNER_OF_A, CORNER_OF_B, TOUCHES };

static meeting far_apart(int touch)
{
    meeting m = two_caps(0.1, 1.1, 50);
    if (touch == EDGES) swap_parameters(&m.b);
    if (touch == EDGES || touch == EDGE_OF_A) make_edge(&m, 0, 0.003, false);
    if (touch == EDGES || touch == EDGE_OF_B) make_edge(&m, 1, -0.003, false);
    if (touch == CORNER_OF_A) make_edge(&m, 0, 0.003, true);
    if (touch == CORNER_OF_B) make_edge(&m, 1, -0.003, true);
    return m;
}

static void check_field_parts(const meeting *m, int touch, bool should, int k, double value)
{
    difference r;
    w_range all = {-1, 1};
    gap_lines lines;
    gap_lines_begin(&lines);
    difference_at(&m->a, &m->b, &m->window, &r);
    const bool some = normal_field_cut(&r, touch == FACES ? NO_AXIS : ACROSS, 1e-6, &all, &lines);
    const bool parts = !some || all.lo > -1 || all.hi < 1 || lines.count > 1;
    ck_assert_msg(parts == should, "field: touch %d, coefficient %d, %g", touch, k, value);
}

static void check_axes_part_nothing(const meeting *m, int touch, int k, double value)
{
    difference r;
    w_range axes = {-1, 1};
    vec3 axis = {{0, 0, 0}};
    difference_at(&m->a, &m->b, &m->window, &r);
    const bool some = fixed_axes_cut(&r, 1e-6, &axes, &axis, NULL);
    ck_assert_msg(some && axes.lo == -1 && axes.hi == 1, "axes: touch %d, coefficient %d, %g",
                  touch, k, value);
}

START_TEST(infinities_and_nans_never_part_anything)
{
    const double odd[3] = {INFINITY, -INFINITY, NAN};
    for (int touch = 0; touch < TOUCHES; ++touch) {
        const meeting whole = far_apart(touch);
        check_field_parts(&whole, touch, true, -1, 0);
        for (int k = 0; k < 2 * 11 * 3; ++k) {
            meeting m = whole;
            const int which = k / 2 % 11;
            const double value = which < 10 ? odd[k / 22] : fabs(odd[k / 22]);
            spoil(k % 2 == 0 ? &m.a : &m.b, which, value);
            check_axes_part_nothing(&m, touch, which, value);
            check_field_parts(&m, touch, false, which, value);
        }
    }
}
END_TEST

SUITE_MAIN("separation_distance", no_gap_is_below_the_lower_bound_of_the_distance,
           a_share_keeps_every_moment_within_the_limit,
           no_axis_shows_much_more_than_twice_the_gap_of_the_nearest,
           where_hulls_meet_there_is_no_gjk_axis,
           edges_that_slide_past_each_other_are_parted_at_once,
           infinities_and_nans_never_part_anything)
