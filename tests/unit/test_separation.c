/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/separation.h"

#include <string.h>

#include "core/bounds/fixed_axes.h"
#include "core/bounds/gjk_axis.h"
#include "core/bounds/moving_boxes.h"
#include "core/bounds/normal_field.h"
#include "tests/support/meeting.h"

/* Pairs of made-up nodes that are brought together, exactly within gamma_clear, at a chosen
 * moment and chosen points: no cut may lose that moment. Where parts of the judgement need it, long
 * double. */

/* How the two lie: anyhow; touching each other like a ball and a table; one along the other, as two
 * layers of one shell, which only the field of normals parts. */
typedef enum posture { ANYHOW, TANGENT, NESTED, POSTURES } posture;

typedef struct meeting {
    node a, b;
    time_window window;
    double t; /* when they are near */
    double gamma_clear;
    long double gap[3]; /* B - A then */
} meeting;

static void random_node(uint64_t *state, node *n, double size, double bend, double motion)
{
    memset(n, 0, sizeof *n);
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    n->region = region_make(lo, hi);
    n->bounded = true;
    quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        f->bu[i] = size * random_between(state, -1, 1);
        f->bv[i] = size * random_between(state, -1, 1);
        f->bt[i] = motion * random_between(state, -1, 1);
        double *q[5] = {&f->quu[i], &f->quv[i], &f->qvv[i], &f->qut[i], &f->qvt[i]};
        for (int k = 0; k < 5; ++k) *q[k] = bend * size * random_between(state, -1, 1);
        f->qtt[i] = bend * motion * random_between(state, -1, 1);
        n->e[i] = random_bits(state) % 2 ? bend * size * random_power(state, -8, 0) : 0;
        n->motion[i] = (fabs(f->bt[i]) + 2 * fabs(f->qtt[i]) + fabs(f->qut[i]) + fabs(f->qvt[i])) *
                       (1 + 0x1p-50);
        n->lo[i] = -INFINITY;
        n->hi[i] = INFINITY;
    }
}

/* The second surface of a tangent pair: the first, turned a little, and curved otherwise. */
static void make_tangent(uint64_t *state, meeting *m, double tilt, double bend)
{
    for (int i = 0; i < 3; ++i) {
        m->b.f.bu[i] = m->a.f.bu[i] * random_between(state, 0.9, 1.1);
        m->b.f.bv[i] = m->a.f.bv[i] + tilt * random_between(state, -1, 1) * m->a.f.bu[i];
        m->b.f.quu[i] = m->a.f.quu[i] + bend * random_between(state, -1, 1) * m->a.f.quu[i];
    }
}

/* Scales the part of x that lies in the plane across the unit vector n, and the part along it. */
static void scale_parts(double *x, vec3 n, double in_plane, double along)
{
    const double height = vec3_dot(vec3_from(x), n);
    for (int i = 0; i < 3; ++i)
        x[i] = in_plane * (x[i] - height * n.x[i]) + along * height * n.x[i];
}

/* Makes a surface lie across n and bend along it. */
static void make_shell(uint64_t *state, node *x)
{
    vec3 n = {{random_between(state, -1, 1), random_between(state, -1, 1), 1}};
    const double waver = random_power(state, -20, -2);
    quadratic3 *f = &x->f;
    n = vec3_scale(n, 1 / vec3_norm(n));
    scale_parts(f->bu, n, 1, waver);
    scale_parts(f->bv, n, 1, waver);
    double *bends[5] = {f->quu, f->quv, f->qvv, f->qut, f->qvt};
    for (int k = 0; k < 5; ++k) scale_parts(bends[k], n, waver, 1);
}

/* The second surface of a nested pair: the first, but for a little of everything; perhaps it turns
 * the other way. */
static void make_nested(uint64_t *state, meeting *m, double size)
{
    const double little = size * random_power(state, -20, -2);
    make_shell(state, &m->a);
    double *const a = (double *)&m->a.f, *const b = (double *)&m->b.f;
    for (size_t k = 0; k < sizeof m->a.f / sizeof *a; ++k)
        b[k] = k % 4 < 3 ? a[k] + little * random_between(state, -1, 1) : 0;
    const double way = random_bits(state) % 2 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
        m->b.f.qut[i] *= way;
        m->b.f.qvt[i] *= way;
        m->a.e[i] = m->b.e[i] = random_bits(state) % 2 ? little : 0;
        m->a.motion[i] = 2 * (fabs(m->a.f.bt[i]) + fabs(m->a.f.qtt[i]) + 4 * size);
        m->b.motion[i] = m->a.motion[i] + 5 * little;
    }
}

/* Across the surface at parameters s, from it or into it. */
static void across(uint64_t *state, const node *n, const double s[2], double t, double toward[3])
{
    const double st = (t - n->region.c[2]) / n->region.d[2];
    const quadratic3 *f = &n->f;
    vec3 u, v;
    for (int i = 0; i < 3; ++i) {
        u.x[i] = f->bu[i] + 2 * f->quu[i] * s[0] + f->quv[i] * s[1] + f->qut[i] * st;
        v.x[i] = f->bv[i] + 2 * f->qvv[i] * s[1] + f->quv[i] * s[0] + f->qvt[i] * st;
    }
    const vec3 normal = vec3_scale(vec3_cross(u, v), random_bits(state) % 2 ? 1 : -1);
    memcpy(toward, normal.x, sizeof normal.x);
}

static long double point(const node *n, int i, const double *s, double t, long double rest)
{
    const quadratic3 *f = &n->f;
    const long double st = ((long double)t - n->region.c[2]) / n->region.d[2];
    return f->a[i] + f->bu[i] * (long double)s[0] + f->bv[i] * (long double)s[1] + f->bt[i] * st +
           f->quu[i] * (long double)s[0] * s[0] + f->quv[i] * (long double)s[0] * s[1] +
           f->qut[i] * s[0] * st + f->qvv[i] * (long double)s[1] * s[1] + f->qvt[i] * s[1] * st +
           f->qtt[i] * st * st + rest * n->e[i];
}

/* Places B so that at m->t the points at random parameters are within gamma_clear. */
static void bring_together(uint64_t *state, meeting *m, posture how, double offset)
{
    double sa[2], sb[2], toward[3], norm = 0;
    for (int k = 0; k < 2; ++k) {
        sa[k] = suite_end_or_inside(state);
        sb[k] = how == NESTED ? sa[k] : suite_end_or_inside(state);
    }
    for (int i = 0; i < 3; ++i) toward[i] = random_between(state, -1, 1);
    if (how == NESTED) across(state, &m->a, sa, m->t, toward);
    for (int i = 0; i < 3; ++i) {
        norm += toward[i] * toward[i];
        m->a.f.a[i] = offset * random_between(state, -1, 1);
    }
    /* within gamma_clear also after b.a is rounded to a double */
    const double reach = m->gamma_clear * (random_bits(state) % 2 ? 1 - 1e-9 : 0.5);
    for (int i = 0; i < 3; ++i) {
        const long double ra = suite_end_or_inside(state), rb = suite_end_or_inside(state);
        const long double x = point(&m->a, i, sa, m->t, ra) + reach * toward[i] / sqrt(norm);
        m->b.f.a[i] = 0;
        m->b.f.a[i] = (double)(x - point(&m->b, i, sb, m->t, rb));
        m->gap[i] = point(&m->b, i, sb, m->t, rb) - point(&m->a, i, sa, m->t, ra);
    }
}

/* B - A at m->t and parameters s of A and B, the remainders making it as short as they can. */
static long double nearest_gap(const meeting *m, const double s[4], long double gap[3])
{
    long double square = 0;
    for (int i = 0; i < 3; ++i) {
        const long double apart = point(&m->b, i, s + 2, m->t, 0) - point(&m->a, i, s, m->t, 0);
        const long double rest = fmaxl(fabsl(apart) - m->a.e[i] - m->b.e[i], 0);
        gap[i] = copysignl(rest, apart);
        square += gap[i] * gap[i];
    }
    return sqrtl(square);
}

/* gamma_clear becomes the least gap that a search from random parameters finds: no more of the
 * window may be cut than that. */
static void tighten(uint64_t *state, meeting *m)
{
    double s[4];
    long double gap[3];
    s[0] = s[2] = suite_end_or_inside(state);
    s[1] = s[3] = suite_end_or_inside(state);
    long double least = nearest_gap(m, s, m->gap);
    for (double step = 0.25; step > 1e-4; step *= 0.5)
        for (int k = 0; k < 8; ++k) {
            const double was = s[k / 2];
            s[k / 2] = fmin(fmax(was + (k % 2 ? step : -step), -1), 1);
            const long double now = nearest_gap(m, s, gap);
            if (now < least) {
                least = now;
                memcpy(m->gap, gap, sizeof gap);
            } else {
                s[k / 2] = was;
            }
        }
    m->gamma_clear = (double)(least * (1 + 1e-12L));
}

static bool is_near(const meeting *m)
{
    const long double square =
        m->gap[0] * m->gap[0] + m->gap[1] * m->gap[1] + m->gap[2] * m->gap[2];
    return square <= (long double)m->gamma_clear * m->gamma_clear;
}

static void random_meeting(uint64_t *state, meeting *m, posture how)
{
    const bool close = how != ANYHOW;
    const double size = random_power(state, -30, 3),
                 bend = random_power(state, close ? -4 : -12, 1);
    const double motion = size * random_power(state, -6, close ? 0 : 6);
    random_node(state, &m->a, size, bend, motion);
    random_node(state, &m->b, size * (close ? 1 : random_power(state, -3, 3)), bend, motion);
    if (how == NESTED) make_nested(state, m, size);
    if (how == TANGENT) make_tangent(state, m, random_power(state, -20, -1), 0.1);
    m->gamma_clear = size * random_power(state, -20, 0);
    m->t = draw_moment(state, -10, &m->window);
    bring_together(state, m, how, random_bits(state) % 8 == 0 ? 100 * size : size);
    if (how == NESTED && random_bits(state) % 4 == 0) tighten(state, m);
}

/* What the parents may have left: any direction of any length, none, or no numbers at all. */
static vec3 random_axis(uint64_t *state)
{
    const double length = random_power(state, -1020, 1020);
    vec3 n = {{0, 0, 0}};
    const uint64_t kind = random_bits(state) % 16;
    for (int i = 0; kind > 3 && i < 3; ++i)
        n.x[i] = (kind == 4 ? length : 1) * random_between(state, -1, 1);
    if (kind == 1) n.x[random_bits(state) % 3] = NAN;
    if (kind == 2) n.x[random_bits(state) % 3] = -INFINITY;
    return n;
}

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

/* Two caps of radius 1 that bulge at each other along a tilted normal, h wide, `gap` apart. */
static meeting two_caps(double h, double radius_b, double gap)
{
    const double n[3] = {0.48, 0.6, 0.64}, u[3] = {0.8, 0, -0.6}, v[3] = {-0.36, 0.8, -0.48};
    meeting m;
    memset(&m, 0, sizeof m);
    node *both[2] = {&m.a, &m.b};
    for (int k = 0; k < 2; ++k) {
        node *x = both[k];
        x->region = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
        x->bounded = true;
        for (int i = 0; i < 3; ++i) {
            const double curve = k == 0 ? -0.5 : -0.5 / radius_b;
            x->f.a[i] = k * gap * n[i];
            x->f.bu[i] = h * u[i];
            x->f.bv[i] = h * v[i];
            x->f.quu[i] = x->f.qvv[i] = curve * h * h * n[i];
            x->lo[i] = -INFINITY;
            x->hi[i] = INFINITY;
        }
    }
    m.window = (time_window){0, 1};
    return m;
}

START_TEST(a_glance_leaves_when_boxes_pass_each_other)
{
    meeting m = two_caps(0.1, 1.1, 0);
    m.b.f.bt[0] = -10;
    m.b.motion[0] = 10;
    ck_assert(moving_boxes_cut(&m.a, &m.b, 1e-6, &m.window));
    ck_assert(m.window.lo > 0.48 && m.window.lo < 0.5 && m.window.hi > 0.5 && m.window.hi < 0.52);
    m.window = (time_window){0, 1};
    m.b.f.a[1] += 1;
    ck_assert(!moving_boxes_cut(&m.a, &m.b, 1e-6, &m.window));
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
        m.b.motion[i] = fabs(m.b.f.bt[i]);
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

START_TEST(a_window_shrinks_to_the_moment_of_contact)
{
    meeting m = two_caps(1e-9, -1, 1);
    for (int i = 0; i < 3; ++i) m.b.f.bt[i] = -2 * m.b.f.a[i], m.b.motion[i] = 4;
    vec3 axis = {{0, 0, 0}};
    ck_assert(separation_window(&m.a, &m.b, 1e-3, &m.window, &axis, NULL));
    /* the gap is 1 - 2 (2 t - 1) = 3 - 4 t: 1e-3 at t = 0.74975 and at 0.75025 */
    ck_assert_double_le(fabs(m.window.lo - 0.74975), 1e-8);
    ck_assert_double_le(fabs(m.window.hi - 0.75025), 1e-8);
}
END_TEST

/* Coefficient k of all three coordinates; 10: the remainders. Motions follow, as in any node. */
static void spoil(node *n, int k, double value)
{
    double *coordinates = k < 10 ? (double *)&n->f + 4 * k : n->e;
    for (int i = 0; i < 3; ++i) {
        coordinates[i] = value;
        n->motion[i] +=
            fabs(n->f.bt[i]) + fabs(n->f.qtt[i]) + fabs(n->f.qut[i]) + fabs(n->f.qvt[i]);
    }
}

START_TEST(infinities_and_nans_never_part_anything)
{
    const double odd[3] = {INFINITY, -INFINITY, NAN};
    for (int k = 0; k < 11; ++k)
        for (int o = 0; o < 3; ++o) {
            meeting m = two_caps(0.1, 1.1, 50);
            spoil(&m.b, k, k < 10 ? odd[o] : fabs(odd[o]));
            difference r;
            w_range axes = {-1, 1}, field = {-1, 1};
            vec3 axis = {{0, 0, 0}};
            difference_at(&m.a, &m.b, &m.window, &r);
            ck_assert_msg(fixed_axes_cut(&r, 1e-6, &axes, &axis, NULL), "axes: coefficient %d, %g",
                          k, odd[o]);
            ck_assert_msg(normal_field_cut(&r, 1e-6, &field, NULL), "field: coefficient %d, %g", k,
                          odd[o]);
            ck_assert(axes.lo == -1 && axes.hi == 1 && field.lo == -1 && field.hi == 1);
        }
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
           no_gap_is_below_the_lower_bound_of_the_distance,
           neither_axes_nor_field_of_normals_lose_a_meeting_alone,
           a_share_keeps_every_moment_within_the_limit,
           no_axis_shows_much_more_than_twice_the_gap_of_the_nearest,
           where_hulls_meet_there_is_no_gjk_axis,
           edges_that_slide_past_each_other_are_parted_at_once,
           the_field_of_normals_turns_with_time,
           the_field_of_normals_proves_no_more_than_the_distance,
           the_field_of_normals_parts_caps_that_no_axis_does,
           caps_that_touch_with_their_tops_are_not_parted_at_any_size,
           a_window_shrinks_to_the_moment_of_contact, infinities_and_nans_never_part_anything,
           boxes_and_balls_are_apart_only_beyond_the_clearance,
           chances_are_taken_while_they_pay_and_now_and_then_else,
           nodes_without_bounds_keep_their_window)
