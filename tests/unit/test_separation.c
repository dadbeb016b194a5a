/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/meeting_nodes.h"

/* The window of two nodes: no cut loses the moment at which made-up nodes meet. */

START_TEST(the_moment_of_a_meeting_is_never_cut_away)
{
    uint64_t state = suite_seed();
    int near = 0;
    for (int k = 0; k < suite_times(150000); ++k) {
        meeting m;
        random_meeting(&state, &m, (posture)(k % POSTURES));
        if (!is_near(&m)) continue;
        ++near;
        time_window left = m.window;
        vec3 axis = random_axis(&state);
        const bool some = separation_window(&m.a, &m.b, m.gamma_clear, &left, &axis, NULL);
        check_window_left(&m.window, m.t, some, &left, k);
    }
    ck_assert_int_gt(near, suite_times(150000) / 2);
}
END_TEST

/* Lets all terms lead up, or down for sign -1, at parameters 1 and at the end `w` of the window. */
static void lead(node *n, double sign, double w)
{
    quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        double *still[6] = {&f->bu[i], &f->bv[i], &f->quu[i], &f->quv[i], &f->qvv[i], &f->qtt[i]};
        for (int k = 0; k < 6; ++k) *still[k] = sign * fabs(*still[k]);
        f->qut[i] = sign * w * fabs(f->qut[i]);
        f->qvt[i] = sign * w * fabs(f->qvt[i]);
    }
}

/* Two corners as far out as their boxes, at an end of the window, and a gap along one coordinate
 * alone. Both may be carried along so fast that the rounding of that motion counts. */
static void meet_with_corners(uint64_t *state, meeting *m)
{
    const double corner[2] = {1, 1}, w = random_bits(state) % 2 ? 1 : -1;
    const double fast = random_bits(state) % 2 ? random_power(state, 0, 30) : 0;
    const int along = (int)(random_bits(state) % 3);
    for (int i = 0; i < 3; ++i) {
        m->a.f.bt[i] += fast * m->a.region.d[2];
        m->b.f.bt[i] += fast * m->b.region.d[2];
    }
    lead(&m->a, 1, w);
    lead(&m->b, -1, w);
    m->t = w > 0 ? m->window.hi : m->window.lo;
    for (int i = 0; i < 3; ++i) {
        const long double x = point(&m->a, i, corner, m->t, 1);
        m->b.f.a[i] = 0;
        m->b.f.a[i] =
            (double)(x - point(&m->b, i, corner, m->t, -1)) + (i == along ? m->gamma_clear : 0);
        m->gap[i] = point(&m->b, i, corner, m->t, -1) - point(&m->a, i, corner, m->t, 1);
    }
    m->gamma_clear = nextafter((double)m->gap[along], INFINITY);
}

START_TEST(no_glance_cuts_the_moment_of_a_meeting_away)
{
    uint64_t state = suite_seed() + 5;
    int near = 0;
    for (int k = 0; k < suite_times(100000); ++k) {
        meeting m;
        random_meeting(&state, &m, (posture)(k % POSTURES));
        if (k % 2 == 0) meet_with_corners(&state, &m);
        if (!is_near(&m)) continue;
        ++near;
        time_window left = m.window;
        const bool some = moving_boxes_cut(&m.a, &m.b, m.gamma_clear, &left);
        check_window_left(&m.window, m.t, some, &left, k);
    }
    ck_assert_int_gt(near, suite_times(100000) / 2);
}
END_TEST

START_TEST(a_glance_leaves_when_boxes_pass_each_other)
{
    meeting m = two_caps(0.1, 1.1, 0);
    m.b.f.bt[0] = -10;
    ck_assert(moving_boxes_cut(&m.a, &m.b, 1e-6, &m.window));
    ck_assert(m.window.lo > 0.48 && m.window.lo < 0.5 && m.window.hi > 0.5 && m.window.hi < 0.52);
    m.window = (time_window){0, 1};
    m.b.f.a[1] += 1;
    ck_assert(!moving_boxes_cut(&m.a, &m.b, 1e-6, &m.window));
}
END_TEST

START_TEST(a_window_shrinks_to_the_moment_of_contact)
{
    meeting m = two_caps(1e-9, -1, 1);
    for (int i = 0; i < 3; ++i) m.b.f.bt[i] = -2 * m.b.f.a[i];
    vec3 axis = {{0, 0, 0}};
    ck_assert(separation_window(&m.a, &m.b, 1e-3, &m.window, &axis, NULL));
    /* the gap is 1 - 2 (2 t - 1) = 3 - 4 t: 1e-3 at t = 0.74975 and at 0.75025 */
    ck_assert_double_le(fabs(m.window.lo - 0.74975), 1e-8);
    ck_assert_double_le(fabs(m.window.hi - 0.75025), 1e-8);
}
END_TEST

START_TEST(boxes_and_balls_are_apart_only_beyond_the_clearance)
{
    node a, b;
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    a.bounded = b.bounded = true;
    for (int mirrored = 0; mirrored < 8; ++mirrored) {
        const double far[3] = {3, 4, 12}; /* 13 away */
        for (int i = 0; i < 3; ++i)
            b.lo[i] = b.hi[i] = b.f.a[i] = mirrored >> i & 1 ? -far[i] : far[i];
        ck_assert(!separation_of_boxes(&a, &b, 13) && !separation_of_balls(&a, &b, 13));
        ck_assert(separation_of_boxes(&a, &b, 13 * (1 - 0x1p-46)));
        ck_assert(separation_of_balls(&a, &b, 13 * (1 - 0x1p-46)));
    }
    a.radius = 1, b.radius = 2;
    ck_assert(!separation_of_balls(&a, &b, 10));
    ck_assert(separation_of_balls(&a, &b, 10 * (1 - 0x1p-45)));
}
END_TEST

/* Such squares are rounded to a multiple of 2^-1074, and their roots may come out larger. */
START_TEST(gaps_whose_squares_underflow_are_no_reason_to_be_apart)
{
    node a, b;
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    a.bounded = b.bounded = true;
    for (double gap = 0x1p-540; gap < 0x1p-500; gap *= 1.03) {
        b.lo[0] = b.hi[0] = gap;
        ck_assert(!(separation_boxes_lower(&a, &b) > gap));
    }
}
END_TEST

START_TEST(chances_are_taken_while_they_pay_and_now_and_then_else)
{
    enum { WAIT = 7, TRIES = 8000 };
    trial_rate c = {0};
    int taken = 0;
    for (int k = 0; k < TRIES; ++k) taken += trial_rate_take(&c, 4, WAIT);
    ck_assert_int_eq(taken, TRIES / (WAIT + 1));
    for (int k = 0; k < TRIALS_KEPT * WAIT; ++k) trial_rate_note(&c, trial_rate_take(&c, 4, WAIT));
    for (int k = 0; k < TRIES; ++k) {
        ck_assert(trial_rate_take(&c, 4, WAIT));
        trial_rate_note(&c, k % 3 == 0);
    }
}
END_TEST

START_TEST(nodes_without_bounds_keep_their_window)
{
    meeting m = two_caps(0.1, 1.1, 50);
    m.b.bounded = false;
    vec3 axis = {{0, 0, 0}};
    ck_assert(separation_window(&m.a, &m.b, 1e-6, &m.window, &axis, NULL));
    ck_assert(m.window.lo == 0 && m.window.hi == 1);
}
END_TEST

SUITE_MAIN("separation", the_moment_of_a_meeting_is_never_cut_away,
           no_glance_cuts_the_moment_of_a_meeting_away, a_glance_leaves_when_boxes_pass_each_other,
           a_window_shrinks_to_the_moment_of_contact,
           boxes_and_balls_are_apart_only_beyond_the_clearance,
           gaps_whose_squares_underflow_are_no_reason_to_be_apart,
           chances_are_taken_while_they_pay_and_now_and_then_else,
           nodes_without_bounds_keep_their_window)
