/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/bounds/net_model_axis.h"
#include "tests/support/judge.h"
#include "tests/support/netted.h"

/* Axes of a net and a model: windows against exact distances, and the axis that is found against
 * many others. */

static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};

static double random_coefficient(uint64_t *state, double most)
{
    return most * random_between(state, -1, 1);
}

/* A random quadratic with remainders over u, v and t in [0, 1], that a type without a net might
 * answer. */
static node draw_model(uint64_t *state, double far)
{
    node n = {.region = region_make(zero, one), .bounded = true};
    const bool is_accelerated = random_bits(state) % 2;
    for (int i = 0; i < 3; ++i) {
        quadratic3 *f = &n.f;
        f->a[i] = far * random_between(state, -1, 1);
        f->bu[i] = random_coefficient(state, 1), f->bv[i] = random_coefficient(state, 1);
        f->bt[i] = random_coefficient(state, 1);
        f->quu[i] = random_coefficient(state, 0.5), f->quv[i] = random_coefficient(state, 0.5);
        f->qvv[i] = random_coefficient(state, 0.5);
        f->qut[i] = random_coefficient(state, 0.3), f->qvt[i] = random_coefficient(state, 0.3);
        if (is_accelerated) f->qtt[i] = random_coefficient(state, 0.5);
        n.e[i] = random_power(state, -20, -3);
    }
    return n;
}

/* The quadratic's coordinates at (u, v, t), exactly. */
static void model_value(const node *n, const double p[3], number x[3])
{
    number s[3];
    for (int j = 0; j < 3; ++j)
        s[j] = num_div(num_sub(num(p[j]), num(n->region.c[j])), num(n->region.d[j]));
    for (int i = 0; i < 3; ++i) {
        const quadratic3 *f = &n->f;
        const double linear[3] = {f->bu[i], f->bv[i], f->bt[i]};
        const double square[3][3] = {
            {f->quu[i], f->quv[i], f->qut[i]}, {0, f->qvv[i], f->qvt[i]}, {0, 0, f->qtt[i]}};
        x[i] = num(f->a[i]);
        for (int j = 0; j < 3; ++j) {
            x[i] = num_add(x[i], num_mul(num(linear[j]), s[j]));
            for (int k = j; k < 3; ++k)
                x[i] = num_add(x[i], num_mul(num(square[j][k]), num_mul(s[j], s[k])));
        }
    }
}

/* A surely smaller distance than gamma_clear at time t: the model's point moved towards the net's
 * as far as its remainder allows. */
static bool surely_near(uint64_t *state, const netted *a, const node *b, double t,
                        double gamma_clear)
{
    number x[3], y[3], sum = num(0);
    const double p[3] = {random_fraction(state), random_fraction(state), t};
    const double q[3] = {random_fraction(state), random_fraction(state), t};
    net_value(&a->given, &a->n.region, p, x);
    model_value(b, q, y);
    for (int i = 0; i < 3; ++i) {
        const number apart = num_sub(num_abs(num_sub(y[i], x[i])), num(b->e[i]));
        if (!num_is_less(apart, num(0))) sum = num_add(sum, num_sqr(apart));
    }
    return num_is_less(sum, num_sqr(num(gamma_clear)));
}

/* Cuts with the net as A, or as B. */
static bool cut(bool turned, const netted *a, const node *b, vec3 axis, double gamma_clear,
                time_window *w)
{
    return turned ? net_model_axis_cut(b, &a->n, axis, gamma_clear, w)
                  : net_model_axis_cut(&a->n, b, axis, gamma_clear, w);
}

static bool seek(bool turned, const netted *a, const node *b, double t, vec3 *axis)
{
    return turned ? net_model_axis_seek(b, &a->n, t, axis) : net_model_axis_seek(&a->n, b, t, axis);
}

START_TEST(nothing_is_near_outside_of_the_window_that_an_axis_leaves)
{
    uint64_t state = suite_seed();
    int cuts = 0, apart = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a;
        const bool turned = random_bits(&state) % 2;
        const double far = random_bits(&state) % 2 ? 2.5 : 1;
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), (uint32_t)(random_bits(&state) % 4),
                 far, &a);
        take(&a, zero, one);
        const node b = draw_model(&state, far);
        vec3 axis = {{random_between(&state, -1, 1), random_between(&state, -1, 1), 1}};
        time_window w = {0, 1};
        const double gamma_clear = random_power(&state, -6, 1);
        seek(turned, &a, &b, random_fraction(&state), &axis);
        const bool some = cut(turned, &a, &b, axis, gamma_clear, &w);
        apart += !some;
        cuts += some && (w.lo > 0 || w.hi < 1);
        for (int l = 0; l < 8; ++l) {
            num_forget();
            const double t = random_fraction(&state);
            if (some && t >= w.lo && t <= w.hi) continue;
            ck_assert(!surely_near(&state, &a, &b, t, gamma_clear));
        }
    }
    ck_assert_int_gt(cuts, suite_times(3000) / 20);
    ck_assert_int_gt(apart, suite_times(3000) / 20);
}
END_TEST

/* A point of a net at rest and one of a model, which falls along a parabola from 1 to `end` with a
 * bow: windows start when the chord says, and never later than the parabola itself. */
START_TEST(acceleration_is_seen_along_the_axis)
{
    for (int k = -4; k <= 4; ++k) {
        netted a = {.given = {.degree = {0, 0}}};
        take(&a, zero, one);
        const double bend = k / 16.; /* height: 1/2 - s / 2 + bend (s^2 - 1), 1 at -1 and 0 at 1 */
        node b = {.region = region_make(zero, one), .bounded = true};
        b.f.a[2] = 0.5 - bend, b.f.bt[2] = -0.5, b.f.qtt[2] = bend;
        for (int i = 0; i < 3; ++i) b.region.d[i] = 0.5;
        time_window w = {0, 1};
        const double gamma_clear = 0.25, chord = 0.75 - fmax(bend, 0);
        ck_assert(net_model_axis_cut(&a.n, &b, (vec3){{0, 0, 1}}, gamma_clear, &w));
        ck_assert_double_eq_tol(w.lo, chord, 1e-13);
        const double s = 2 * w.lo - 1;
        ck_assert_double_ge(0.5 - 0.5 * s + bend * (s * s - 1), gamma_clear);
    }
}
END_TEST

START_TEST(errors_and_remainders_count_along_the_axis)
{
    netted a = {.given = {.degree = {0, 0}}};
    node b = {.region = region_make(zero, one), .bounded = true};
    a.given.error[2] = 0.25, a.given.error[0] = 100;
    take(&a, zero, one);
    b.f.a[2] = 1, b.e[2] = 0.5, b.e[1] = 100;
    time_window w = {0, 1};
    ck_assert(net_model_axis_cut(&a.n, &b, (vec3){{0, 0, 1}}, 0.2500001, &w));
    ck_assert(net_model_axis_cut(&b, &a.n, (vec3){{0, 0, -1}}, 0.2500001, &w));
    ck_assert(!net_model_axis_cut(&a.n, &b, (vec3){{0, 0, 1}}, 0.2499999, &w));
    w = (time_window){0, 1};
    ck_assert(!net_model_axis_cut(&b, &a.n, (vec3){{0, 0, -1}}, 0.2499999, &w));
}
END_TEST

/* The widest gamma_clear along an axis at a moment, to a thousandth. */
static double gap_along(bool turned, const netted *a, const node *b, double t, vec3 n)
{
    double below = 0, above = 16;
    while (above - below > 1e-3) {
        const double middle = 0.5 * (below + above);
        time_window w = {t, t};
        if (cut(turned, a, b, n, middle, &w))
            above = middle;
        else
            below = middle;
    }
    return below;
}

START_TEST(the_axis_found_shows_most_of_what_any_axis_shows)
{
    enum { AXES = 100 };
    uint64_t state = suite_seed();
    int found = 0, met = 0, poor = 0;
    for (int k = 0; k < suite_times(100); ++k) {
        netted a;
        const bool turned = random_bits(&state) % 2;
        draw_net(&state, (uint32_t)(random_bits(&state) % 4), 3, 2.5, &a);
        take(&a, zero, one);
        const node b = draw_model(&state, 2.5);
        const double t = random_fraction(&state);
        vec3 axis = {{1, 0, 0}};
        const bool some = seek(turned, &a, &b, t, &axis);
        const double shown = some ? gap_along(turned, &a, &b, t, axis) : 0;
        double most = shown;
        found += some, met += !some;
        for (int l = 0; l < AXES; ++l) {
            const vec3 n = {{random_between(&state, -1, 1), random_between(&state, -1, 1),
                             random_between(&state, -1, 1)}};
            most = fmax(most, gap_along(turned, &a, &b, t, n));
        }
        poor += shown < 0.6 * most - 2e-3;
    }
    /* The search ends early where it converges slowly. */
    ck_assert_int_le(poor, suite_times(100) / 25);
    ck_assert_int_gt(found, suite_times(100) / 5);
    ck_assert_int_gt(met, suite_times(100) / 40);
}
END_TEST

START_TEST(numbers_out_of_range_cut_nothing)
{
    netted a = {.given = {.degree = {0, 0}}};
    node b = {.region = region_make(zero, one), .bounded = true};
    const vec3 up = {{0, 0, 1}};
    take(&a, zero, one);
    const double bad[] = {INFINITY, NAN, 1e200};
    for (int k = 0; k < 3; ++k) {
        time_window w = {0, 1};
        b.f.a[2] = 1, b.f.bu[2] = bad[k];
        ck_assert(net_model_axis_cut(&a.n, &b, up, 0.5, &w) && w.lo == 0 && w.hi == 1);
        b.f.bu[2] = 0;
        ck_assert(net_model_axis_cut(&a.n, &b, (vec3){{0, bad[k], 0}}, 0.5, &w) && w.lo == 0);
        ck_assert(!net_model_axis_cut(&a.n, &b, up, 0.5, &w));
    }
}
END_TEST

SUITE_MAIN("net models", nothing_is_near_outside_of_the_window_that_an_axis_leaves,
           acceleration_is_seen_along_the_axis, errors_and_remainders_count_along_the_axis,
           the_axis_found_shows_most_of_what_any_axis_shows, numbers_out_of_range_cut_nothing)
