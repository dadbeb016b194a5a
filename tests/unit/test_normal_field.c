/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/meeting_nodes.h"

/* The turning axis (normal_field.h) on nodes that are nearly tangent. */

START_TEST(neither_axes_nor_field_of_normals_lose_a_meeting_alone)
{
    uint64_t state = suite_seed() + 1;
    for (int k = 0; k < suite_times(100000); ++k) {
        meeting m;
        random_meeting(&state, &m, k % 8 == 0 ? ANYHOW : k % 2 == 0 ? NESTED : TANGENT);
        if (!is_near(&m)) continue;
        difference r;
        w_range axes = {-1, 1}, field = {-1, 1};
        vec3 axis = random_axis(&state);
        difference_at(&m.a, &m.b, &m.window, &r);
        check_share_left(&r, m.t, fixed_axes_cut(&r, m.gamma_clear, &axes, &axis, NULL), &axes, k);
        check_share_left(&r, m.t, normal_field_cut(&r, m.gamma_clear, &field, NULL), &field, k);
    }
}
END_TEST

/* Axes cut nothing off the window, the field of normals all of it. */
static void check_only_field_parts(const meeting *m, int number)
{
    difference r;
    w_range axes = {-1, 1}, field = {-1, 1};
    vec3 axis = {{0, 0, 0}};
    difference_at(&m->a, &m->b, &m->window, &r);
    ck_assert(fixed_axes_cut(&r, 1e-6, &axes, &axis, NULL));
    ck_assert(axes.lo == -1 && axes.hi == 1);
    ck_assert_msg(!normal_field_cut(&r, 1e-6, &field, NULL), "case %d: [%g, %g]", number, field.lo,
                  field.hi);
}

START_TEST(the_field_of_normals_parts_caps_that_no_axis_does)
{
    /* A in B's hollow, both curved the same way, 1 and 1.1 in radius: any axis sees both bends */
    const meeting m = two_caps(0.1, 1.1, 1e-3);
    check_only_field_parts(&m, 0);
}
END_TEST

/* Turns the cap of radius 1 by -k to k about the other side's centre, along u. */
static void turn_cap(node *x, double h, double k)
{
    for (int i = 0; i < 3; ++i) {
        const double u = x->f.bu[i] / h, n = -2 * x->f.quu[i] / (h * h);
        x->f.bt[i] = k * u;
        x->f.qut[i] = -h * k * n;
        x->f.qtt[i] = -0.5 * k * k * n;
        x->motion[i] = fabs(x->f.bt[i]) + fabs(x->f.qut[i]) + 2 * fabs(x->f.qtt[i]);
    }
}

START_TEST(the_field_of_normals_turns_with_time)
{
    /* a shaft in its bore, which the turn moves along by as much as they are wide */
    for (int side = 0; side < 3; ++side) {
        meeting m = two_caps(0.1, 1, 1e-4);
        if (side != 1) turn_cap(&m.a, 0.1, 0.1);
        if (side != 0) turn_cap(&m.b, 0.1, side == 1 ? 0.1 : -0.1);
        check_only_field_parts(&m, side);
    }
}
END_TEST

/* Adds to x what lies along u and v, at most `size`, and a little along n. */
static void add_across(uint64_t *state, double *x, double size)
{
    const double n[3] = {0.48, 0.6, 0.64}, u[3] = {0.8, 0, -0.6}, v[3] = {-0.36, 0.8, -0.48};
    const double little = random_power(state, -12, -3);
    double c[3];
    for (int k = 0; k < 3; ++k) c[k] = (k == 0 ? little : size) * random_between(state, -1, 1);
    for (int i = 0; i < 3; ++i) x[i] += c[0] * n[i] + c[1] * u[i] + c[2] * v[i];
}

/* Two nearly parallel surfaces that bend little, but move and are warped within their planes as
 * much as they are wide. At s and m->t they are g apart, nearly across. */
static meeting warped(uint64_t *state, double s[4], double g)
{
    meeting m = two_caps(1, 1, 0);
    double apart[3] = {0.48 * g, 0.6 * g, 0.64 * g};
    node *both[2] = {&m.a, &m.b};
    for (int side = 0; side < 2; ++side) {
        quadratic3 *f = &both[side]->f;
        double *const all[] = {f->quu, f->quv, f->qvv, f->qut, f->qvt, f->bt, f->qtt};
        memset(f->quu, 0, sizeof f->quu);
        memset(f->qvv, 0, sizeof f->qvv);
        for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
            add_across(state, all[k], random_bits(state) % 2 ? random_power(state, -8, 1) : 0);
        for (int i = 0; i < 3; ++i)
            both[side]->motion[i] =
                fabs(f->bt[i]) + 2 * fabs(f->qtt[i]) + fabs(f->qut[i]) + fabs(f->qvt[i]);
    }
    for (int k = 0; k < 4; ++k) s[k] = suite_end_or_inside(state);
    m.t = 0.5 + 0.5 * suite_end_or_inside(state);
    add_across(state, apart, g * random_power(state, -8, -3));
    for (int i = 0; i < 3; ++i) {
        m.gap[i] = apart[i];
        m.b.f.a[i] = (double)(apart[i] + point(&m.a, i, s, m.t, 0) - point(&m.b, i, s + 2, m.t, 0));
    }
    return m;
}

START_TEST(the_field_of_normals_proves_no_more_than_the_distance)
{
    uint64_t state = suite_seed() + 5;
    int proved = 0;
    for (int k = 0; k < suite_times(400000); ++k) {
        double s[4];
        const meeting m = warped(&state, s, random_power(&state, -12, 1));
        const double gap =
            (double)sqrtl(m.gap[0] * m.gap[0] + m.gap[1] * m.gap[1] + m.gap[2] * m.gap[2]);
        difference r;
        w_range all = {-1, 1};
        gap_lines lines;
        gap_lines_begin(&lines);
        difference_at(&m.a, &m.b, &m.window, &r);
        normal_field_cut(&r, 0, &all, &lines);
        if (lines.count == 1) continue;
        const double w = (m.t - r.mid) / r.half;
        const double lower = lines.line[1].low + lines.line[1].drift * w;
        proved += lower > 0.25 * gap;
        ck_assert_msg(lower <= gap * (1 + 1e-9), "case %d: %g apart at w = %g, proved %g", k, gap,
                      w, lower);
    }
    ck_assert_int_gt(proved, suite_times(400000) / 100);
}
END_TEST

/* Every length times 2^k. */
static void enlarge(node *n, int k)
{
    double *const all[] = {(double *)&n->f, n->e, n->motion};
    const size_t counts[] = {sizeof n->f / sizeof(double), 4, 4};
    for (int part = 0; part < 3; ++part)
        for (size_t i = 0; i < counts[part]; ++i) all[part][i] = ldexp(all[part][i], k);
}

/* Where squares of lengths overflow or vanish, too. The caps are made oblique, so that all terms of
 * a quadratic's determinant do. */
START_TEST(caps_that_touch_with_their_tops_are_not_parted_at_any_size)
{
    for (int k = -1060; k <= 1020; k += 20) {
        meeting m = two_caps(0.1, -1, 0.999e-6);
        memcpy(m.a.f.quv, m.a.f.quu, sizeof m.a.f.quv);
        memcpy(m.b.f.quv, m.b.f.quu, sizeof m.b.f.quv);
        enlarge(&m.a, k);
        enlarge(&m.b, k);
        vec3 axis = {{0, 0, 0}};
        const bool some = separation_window(&m.a, &m.b, ldexp(1e-6, k), &m.window, &axis, NULL);
        ck_assert_msg(some && m.window.lo == 0 && m.window.hi == 1, "enlarged by 2^%d", k);
    }
}
END_TEST

SUITE_MAIN("normal_field", neither_axes_nor_field_of_normals_lose_a_meeting_alone,
           the_field_of_normals_turns_with_time,
           the_field_of_normals_proves_no_more_than_the_distance,
           the_field_of_normals_parts_caps_that_no_axis_does,
           caps_that_touch_with_their_tops_are_not_parted_at_any_size)
