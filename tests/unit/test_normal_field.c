/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/edge_nodes.h"

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
        check_share_left(&r, m.t, normal_field_cut(&r, axis, m.gamma_clear, &field, NULL), &field,
                         k);
    }
}
END_TEST

/* Axes cut nothing off the window, the field of normals all of it. `along`: where it begins. */
static void check_only_field_parts(const meeting *m, vec3 along, int number)
{
    difference r;
    w_range axes = {-1, 1}, field = {-1, 1};
    vec3 axis = {{0, 0, 0}};
    difference_at(&m->a, &m->b, &m->window, &r);
    ck_assert(fixed_axes_cut(&r, 1e-6, &axes, &axis, NULL));
    ck_assert(axes.lo == -1 && axes.hi == 1);
    ck_assert_msg(!normal_field_cut(&r, along, 1e-6, &field, NULL), "case %d: [%g, %g]", number,
                  field.lo, field.hi);
}

START_TEST(the_field_of_normals_parts_caps_that_no_axis_does)
{
    /* A in B's hollow, both curved the same way, 1 and 1.1 in radius: any axis sees both bends */
    const meeting m = two_caps(0.1, 1.1, 1e-3);
    check_only_field_parts(&m, NO_AXIS, 0);
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
    }
}

START_TEST(the_field_of_normals_turns_with_time)
{
    /* a shaft in its bore, which the turn moves along by as much as they are wide */
    for (int side = 0; side < 3; ++side) {
        meeting m = two_caps(0.1, 1, 1e-4);
        if (side != 1) turn_cap(&m.a, 0.1, 0.1);
        if (side != 0) turn_cap(&m.b, 0.1, side == 1 ? 0.1 : -0.1);
        check_only_field_parts(&m, NO_AXIS, side);
    }
}
END_TEST

/* Moves B within the plane, so that what is nearest is not in the middle. */
static void move_aside(meeting *m)
{
    const double u[3] = {0.8, 0, -0.6}, v[3] = {-0.36, 0.8, -0.48};
    for (int i = 0; i < 3; ++i) m->b.f.a[i] += 0.03 * u[i] + 0.02 * v[i];
}

START_TEST(the_field_of_normals_parts_edges_that_bend_towards_each_other)
{
    for (int number = 0; number < 4; ++number) {
        meeting m = two_caps(0.1, 1, 1e-3);
        swap_parameters(&m.b);
        make_edge(&m, 0, 0.003, false);
        make_edge(&m, 1, -0.003, false);
        if (number % 2 == 1) swap_parameters(&m.a);
        if (number / 2 == 1) swap_parameters(&m.b);
        move_aside(&m);
        check_only_field_parts(&m, ACROSS, number);
    }
}
END_TEST

START_TEST(the_field_of_normals_parts_an_edge_or_a_corner_from_a_hollow_face)
{
    for (int number = 0; number < 4; ++number) {
        const int side = number % 2;
        const double up = side == 0 ? -1 : 1;
        meeting m = two_caps(0.1, 1, 2e-3);
        node *face = side == 0 ? &m.b : &m.a;
        for (int i = 0; i < 3; ++i) face->f.quu[i] = face->f.qvv[i] = 0.005 * up * NORMAL[i];
        make_edge(&m, side, 0.008 * up, number / 2 == 1);
        move_aside(&m);
        check_only_field_parts(&m, ACROSS, number);
    }
}
END_TEST

/* Places a corner of B, its least s_u and s_v, g from the place x of a hollow face of A, or of what
 * continues the face: (s_u, b s_v, c s_u^2). */
static meeting corner_over_hollow(uint64_t *state, double c, double x, double g)
{
    const double slope = 2 * c, length = sqrt(1 + slope * slope),
                 eps = random_power(state, -12, -2);
    meeting m = two_caps(1, 1, 0);
    quadratic3 *a = &m.a.f, *b = &m.b.f;
    memset(a, 0, sizeof *a);
    memset(b, 0, sizeof *b);
    a->bu[0] = 1;
    a->bv[1] = random_power(state, -12, 0);
    a->quu[2] = c;
    b->bu[2] = b->bv[2] = eps;
    b->bv[1] = random_bits(state) % 2 ? 0.1 * eps : 0;
    b->a[0] = x - slope * g / length;
    b->a[2] = c * x * x + g / length + 2 * eps;
    m.t = 1;
    return m;
}

/* Makes the term s_u^2 of B move with w along x, as posed nodes do. At the end of the window the
 * corner is where it was, at its start 2 q before that. */
static void move_bend(difference *r, double q)
{
    slice *both[2] = {&r->a, &r->b};
    for (int k = 0; k < 2; ++k) {
        memset(both[k]->uuw, 0, sizeof both[k]->uuw);
        memset(both[k]->uvw, 0, sizeof both[k]->uvw);
        memset(both[k]->vvw, 0, sizeof both[k]->vvw);
    }
    memset(r->edge, 0, sizeof r->edge);
    memset(r->swing, 0, sizeof r->swing);
    r->posed = 1;
    r->delta[0] -= q;
    r->b.uuw[0] = q;
    r->magnitude[0] += 2 * q;
}

static double sampled_from_corner(const meeting *m)
{
    double s[4] = {-1, 0, -1, -1}, least = INFINITY;
    long double gap[3];
    for (int k = 0; k <= 200; ++k) {
        s[0] = -1 + 0.01 * k;
        least = fmin(least, (double)nearest_gap(m, s, gap));
    }
    return least;
}

START_TEST(a_corner_off_the_middle_of_a_hollow_face_is_no_farther_than_its_samples)
{
    uint64_t state = suite_seed() + 3;
    int proved[2] = {0, 0};
    for (int n = 0; n < suite_times(6000); ++n) {
        const double c = random_between(&state, 0.05, 1.2), g = random_power(&state, -3, 0.5);
        const double x = n % 4 < 2 ? 1 : random_between(&state, 0.5, 1.5);
        const double q = n % 2 == 1 ? random_between(&state, 0, 0.5) : 0;
        const meeting m = corner_over_hollow(&state, c, x, g);
        difference r;
        w_range all = {-1, 1};
        gap_lines lines;
        gap_lines_begin(&lines);
        difference_at(&m.a, &m.b, &m.window, &r);
        if (q > 0) move_bend(&r, q);
        normal_field_cut(&r, (vec3){{0, 0, 1}}, 0, &all, &lines);
        if (lines.count == 1) continue;
        const double lower = lines.line[1].low + lines.line[1].drift;
        const double d = sampled_from_corner(&m);
        proved[q > 0] += lower > 0.5 * d;
        ck_assert_msg(lower <= d, "case %d: hollow %g, moved by %g: %g of %g at x = %g", n, c, q,
                      lower, d, x);
        /* a field that would have to tilt by 45 degrees is none */
        ck_assert_msg(c * fabs(r.delta[0]) < 1 + 1e-9, "case %d: tilted by %g", n,
                      c * fabs(r.delta[0]));
    }
    for (int k = 0; k < 2; ++k) ck_assert_int_gt(proved[k], suite_times(6000) / 10);
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
 * much as they are wide. At s and m->t they are g apart, nearly across. Bits of `edges`: sides that
 * have only an edge there, since they leave the plane along v; two edges cross. Some of two faces
 * have remainders of a tenth of g, which bring them nearer, and beside which terms of third order
 * are not what hides the gap: there a turning axis is tried first, elsewhere a dividing surface. */
static meeting warped(uint64_t *state, double s[4], double g, int edges)
{
    meeting m = two_caps(1, 1, 0);
    double apart[3] = {0.48 * g, 0.6 * g, 0.64 * g};
    if (edges == 3) swap_parameters(&m.b);
    node *both[2] = {&m.a, &m.b};
    for (int side = 0; side < 2; ++side) {
        quadratic3 *f = &both[side]->f;
        double *const all[] = {f->quu, f->quv, f->qvv, f->qut, f->qvt, f->bt, f->qtt};
        memset(f->quu, 0, sizeof f->quu);
        memset(f->qvv, 0, sizeof f->qvv);
        for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
            add_across(state, all[k], random_bits(state) % 2 ? random_power(state, -8, 1) : 0);
    }
    for (int k = 0; k < 4; ++k) s[k] = suite_end_or_inside(state);
    for (int side = 0; side < 2; ++side) {
        if ((edges >> side & 1) == 0) continue;
        s[2 * side + 1] = -1;
        for (int i = 0; i < 3; ++i) both[side]->f.bv[i] += (side == 0 ? -4 : 4) * NORMAL[i];
    }
    const double e = edges == 0 && random_bits(state) % 2 ? 0.1 * g : 0;
    m.t = 0.5 + 0.5 * suite_end_or_inside(state);
    add_across(state, apart, g * random_power(state, -8, -3));
    for (int i = 0; i < 3; ++i) {
        m.a.e[i] = m.b.e[i] = e;
        m.gap[i] = apart[i] - copysign(2 * e, apart[i]);
        m.b.f.a[i] = (double)(apart[i] + point(&m.a, i, s, m.t, 0) - point(&m.b, i, s + 2, m.t, 0));
    }
    return m;
}

static double gap_of(const meeting *m)
{
    return (double)sqrtl(m->gap[0] * m->gap[0] + m->gap[1] * m->gap[1] + m->gap[2] * m->gap[2]);
}

/* The lines that the field finds, whatever the gap; *r becomes the difference. */
static gap_lines lines_of(const meeting *m, vec3 axis, difference *r)
{
    w_range all = {-1, 1};
    gap_lines lines;
    gap_lines_begin(&lines);
    difference_at(&m->a, &m->b, &m->window, r);
    normal_field_cut(r, axis, 0, &all, &lines);
    return lines;
}

START_TEST(the_field_of_normals_proves_no_more_than_the_distance)
{
    uint64_t state = suite_seed() + 5;
    int proved[5] = {0, 0, 0, 0, 0}; /* by edges; [4]: with remainders */
    for (int k = 0; k < suite_times(400000); ++k) {
        double s[4];
        const meeting m = warped(&state, s, random_power(&state, -12, 1), k % 4);
        const double gap = gap_of(&m);
        difference r;
        const gap_lines lines = lines_of(&m, k % 4 == 0 ? NO_AXIS : ACROSS, &r);
        if (lines.count == 1) continue;
        const double w = (m.t - r.mid) / r.half;
        const double lower = lines.line[1].low + lines.line[1].drift * w;
        proved[m.a.e[0] > 0 ? 4 : k % 4] += lower > 0.25 * gap;
        ck_assert_msg(lower <= gap * (1 + 1e-9), "case %d: %g apart at w = %g, proved %g", k, gap,
                      w, lower);
    }
    for (int k = 0; k < 5; ++k) ck_assert_int_gt(proved[k], suite_times(100000) / 100);
}
END_TEST

/* Adds random terms of second order, in place at most `size`, with time at most `turn`. */
static void add_bends(uint64_t *state, node *x, double size, double turn)
{
    double *const all[] = {x->f.quu, x->f.quv, x->f.qvv, x->f.qut, x->f.qvt};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        for (int i = 0; i < 3; ++i)
            all[k][i] += (k < 3 ? size : turn) * random_between(state, -1, 1);
}

/* Lets it drift, along its plane but for a little. */
static void add_drift(uint64_t *state, node *x, double h)
{
    add_across(state, x->f.bt, h * random_power(state, -4, 2));
    add_across(state, x->f.qtt, h * random_power(state, -6, 1));
}

/* Moves the centre of a surface by u and v, in half-widths. */
static void move_centre(quadratic3 *f, double u, double v)
{
    for (int i = 0; i < 3; ++i) {
        f->bt[i] += f->qut[i] * u + f->qvt[i] * v;
        f->bu[i] += 2 * f->quu[i] * u + f->quv[i] * v;
        f->bv[i] += 2 * f->qvv[i] * v + f->quv[i] * u;
    }
}

/* Two surfaces of one shape, but for a little, that bend and are warped: at s and m->t they are g
 * apart, nearly across. They drift along each other; centres may lie anywhere. */
static meeting nested(uint64_t *state, double s[4], double g)
{
    const double h = random_power(state, -6, -1), little = h * random_power(state, -30, -6);
    meeting m = two_caps(h, random_bits(state) % 2 ? 1 : 1 + random_power(state, -20, -3), 0);
    double toward[3], norm = 0;
    const bool is_fast = random_bits(state) % 4 == 0;
    add_bends(state, &m.a, h * random_power(state, -6, -1),
              h * random_power(state, -6, is_fast ? 1 : -1));
    for (int k = 0; k < 4; ++k) s[k] = suite_end_or_inside(state);
    if (random_bits(state) % 2)
        for (int k = 0; k < 2; ++k) s[2 + k] = s[k];
    m.b.f = m.a.f;
    move_centre(&m.b.f, s[0] - s[2], s[1] - s[3]);
    double *const b = (double *)&m.b.f;
    for (size_t k = 0; k < sizeof m.b.f / sizeof *b; ++k)
        b[k] += little * random_between(state, -1, 1);
    node *both[2] = {&m.a, &m.b};
    for (int side = 0; side < 2; ++side) {
        add_drift(state, both[side], h * (is_fast ? 1 : 0x1p-5));
    }
    m.t = 0.5 + 0.5 * suite_end_or_inside(state);
    across(state, &m.a, s, m.t, toward);
    for (int i = 0; i < 3; ++i) norm += toward[i] * toward[i];
    for (int i = 0; i < 3; ++i) {
        m.gap[i] = g * h * toward[i] / sqrt(norm);
        m.b.f.a[i] = 0;
        m.b.f.a[i] = (double)(m.gap[i] + point(&m.a, i, s, m.t, 0) - point(&m.b, i, s + 2, m.t, 0));
    }
    return m;
}

START_TEST(a_dividing_surface_proves_no_more_than_the_distance)
{
    uint64_t state = suite_seed() + 6;
    int proved = 0;
    for (int k = 0; k < suite_times(400000); ++k) {
        double s[4];
        const meeting m = nested(&state, s, random_power(&state, -20, -2));
        const double gap = gap_of(&m);
        difference r;
        const gap_lines lines = lines_of(&m, NO_AXIS, &r);
        const double w = (m.t - r.mid) / r.half;
        for (int line = 1; line < lines.count; ++line) {
            const double lower = lines.line[line].low + lines.line[line].drift * w;
            proved += lower > 0.25 * gap;
            ck_assert_msg(lower <= gap * (1 + 1e-9), "case %d: %g apart at w = %g, line %d %g", k,
                          gap, w, line, lower);
        }
    }
    ck_assert_int_gt(proved, suite_times(400000) / 200);
}
END_TEST

/* Every length times 2^k. */
static void enlarge(node *n, int k)
{
    double *const all[] = {(double *)&n->f, n->e};
    const size_t counts[] = {sizeof n->f / sizeof(double), 3};
    for (int part = 0; part < 2; ++part)
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
           a_dividing_surface_proves_no_more_than_the_distance,
           the_field_of_normals_parts_caps_that_no_axis_does,
           the_field_of_normals_parts_edges_that_bend_towards_each_other,
           the_field_of_normals_parts_an_edge_or_a_corner_from_a_hollow_face,
           a_corner_off_the_middle_of_a_hollow_face_is_no_farther_than_its_samples,
           caps_that_touch_with_their_tops_are_not_parted_at_any_size)
