/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/tree/net_series.h"
#include "tests/support/compose.h"
#include "tests/support/judge.h"
#include "tests/support/netted.h"

/* Models that nodes take from their nets, against the exact patch. */

static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};

/* A square of u and v whose middle is exact, and times of the node within those of its net. */
typedef struct place {
    imp_region of_net, of_node;
} place;

static place draw_place(uint64_t *state)
{
    double lo[3], hi[3];
    for (int j = 0; j < 2; ++j) {
        const double parts = (double)(1 << random_bits(state) % 12);
        lo[j] = (double)(random_bits(state) % 4096) / 4096 * parts;
        lo[j] = floor(lo[j]) / parts, hi[j] = lo[j] + 1 / parts;
    }
    lo[2] = random_between(state, -2, 1);
    hi[2] = lo[2] + random_power(state, -10, 1);
    place at = {.of_net = region_make(lo, hi)};
    at.of_node = at.of_net;
    for (uint64_t k = random_bits(state) % 4; k > 0; --k)
        at.of_node = region_half(&at.of_node, PARAMETER_T, (int)(random_bits(state) % 2));
    return at;
}

/* Points that are quadratic along u and v, so that nothing but rounding is left out: of integers
 * that fill a double. */
static void make_quadratic(uint64_t *state, double column[16])
{
    int64_t by[3][3];
    for (int k = 0; k < 9; ++k)
        by[k / 3][k % 3] = (int64_t)(random_bits(state) >> 16) - ((int64_t)1 << 47);
    static const int binomial[4][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 1}, {1, 3, 3}};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            int64_t x = 0;
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) x += binomial[i][k] * binomial[j][l] * by[k][l];
            column[4 * i + j] = ldexp((double)x, -50);
        }
}

/* T_3 T_3, which takes its extremes at the corners. */
static void make_steep(double column[16])
{
    static const double sign[4] = {-1, 5, -5, 1};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) column[4 * i + j] = sign[i] * sign[j];
}

static void draw_bicubic(uint64_t *state, netted *a)
{
    const uint64_t kind = random_bits(state) % 4;
    draw_net(state, 3, 3, random_bits(state) % 2 ? 1e4 : 0, a);
    a->given.is_weighted = 0;
    for (int i = 0; i < 3; ++i) {
        if (kind == 1) make_quadratic(state, a->given.point[i]);
        if (kind == 2) make_steep(a->given.point[i]);
        if (random_bits(state) % 2) a->given.error[i] = random_power(state, -60, -4);
        if (kind == 1) a->given.is_moving = 0, a->given.drift[i] = 0;
        if (random_bits(state) % 8 == 0) a->given.drift[i] = 0;
    }
}

static void models_of(const node *n, imp_model model[3])
{
    const quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i)
        model[i] = (imp_model){
            .a = f->a[i],
            .b = {f->bu[i], f->bv[i], f->bt[i]},
            .q = {f->quu[i], f->quv[i], f->qut[i], f->qvv[i], f->qvt[i], f->qtt[i]},
            .e = n->e[i],
            .lo = n->lo[i],
            .hi = n->hi[i],
            .depends = 7,
        };
}

static double draw_end_or_inside(uint64_t *state, double lo, double hi)
{
    const uint64_t kind = random_bits(state) % 4;
    const double x = kind == 0 ? lo : kind == 1 ? hi : random_between(state, lo, hi);
    return x < lo ? lo : x > hi ? hi : x;
}

/* Whether the models hold for a surface that leaves the patch of `given` by its error, to one
 * side. */
static bool hold_at(const imp_model model[3], const imp_net *given, const place *at,
                    const double p[3], double side, fault *why)
{
    number s[3], exact[3];
    const imp_region *r = &at->of_node;
    net_value(given, &at->of_net, p, exact);
    for (int j = 0; j < 3; ++j) s[j] = num_div(num_sub(num(p[j]), num(r->c[j])), num(r->d[j]));
    for (int i = 0; i < 3; ++i) exact[i] = num_add(exact[i], num(side * given->error[i]));
    return judge_models(model, s, exact, why);
}

static void check_points(uint64_t *state, const netted *a, const place *at, const imp_net *given)
{
    imp_model model[3];
    models_of(&a->n, model);
    for (int k = 0; k < 16; ++k) {
        double p[3];
        fault why;
        num_forget();
        for (int j = 0; j < 3; ++j)
            p[j] = draw_end_or_inside(state, at->of_node.lo[j], at->of_node.hi[j]);
        ck_assert_msg(hold_at(model, given, at, p, k % 2 ? 1 : -1, &why), "%s", why.text);
    }
}

START_TEST(models_of_bicubic_nets_hold)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(4000); ++k) {
        netted a;
        const place at = draw_place(&state);
        draw_bicubic(&state, &a);
        take(&a, at.of_net.lo, at.of_net.hi);
        a.n.region = at.of_node;
        ck_assert(net_series_take(a.n.net, &a.n));
        ck_assert(a.n.bounded);
        check_points(&state, &a, &at, &a.given);
    }
}
END_TEST

/* Halves have numbers as rounded, and errors as they grow. */
START_TEST(models_of_nets_halved_hold)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(300); ++k) {
        netted a;
        place at = draw_place(&state);
        draw_bicubic(&state, &a);
        take(&a, at.of_net.lo, at.of_net.hi);
        for (int depth = 0; depth < 12; ++depth) {
            const parameter j = (parameter)(random_bits(&state) % 2);
            const int side = (int)(random_bits(&state) % 2);
            net_halve(net_in(&a.room), j, side, net_in(&a.room));
            at.of_net = region_half(&at.of_net, j, side);
            at.of_node = region_half(&at.of_node, j, side);
            a.n.region = at.of_node;
            ck_assert(net_series_take(a.n.net, &a.n));
            const imp_net now = given_by(a.n.net);
            check_points(&state, &a, &at, &now);
        }
    }
}
END_TEST

/* Velocities that underflow when they are divided, during times that make their losses count. */
START_TEST(models_hold_where_velocities_underflow)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(200); ++k) {
        netted a = {.given = {.degree = {3, 3}, .is_moving = 1}};
        place at = draw_place(&state);
        at.of_net.lo[2] = -0x1p298, at.of_net.hi[2] = 0x1p298;
        for (int i = 0; i < 3; ++i)
            for (int m = 0; m < 16; ++m)
                a.given.velocity[i][m] = ((double)(random_bits(&state) % 16) - 8) * 0x1p-1074;
        at.of_node = at.of_net = region_make(at.of_net.lo, at.of_net.hi);
        if (k % 2) at.of_node = region_half(&at.of_net, PARAMETER_T, 1);
        take(&a, at.of_net.lo, at.of_net.hi);
        a.n.region = at.of_node;
        ck_assert(net_series_take(a.n.net, &a.n));
        check_points(&state, &a, &at, &a.given);
    }
}
END_TEST

START_TEST(remainders_are_no_larger_than_what_is_left_out)
{
    netted a = {.given = {.degree = {3, 3}}};
    for (int i = 0; i < 3; ++i) make_steep(a.given.point[i]);
    take(&a, zero, one);
    ck_assert(net_series_take(a.n.net, &a.n));
    for (int i = 0; i < 3; ++i) {
        ck_assert_double_eq(a.n.f.a[i], 0);
        ck_assert_double_eq(a.n.f.bu[i], 0);
        ck_assert(1 <= a.n.e[i] && a.n.e[i] <= 1 + 0x1p-36);
        ck_assert(a.n.lo[i] >= -1 - 0x1p-36 && a.n.hi[i] <= 1 + 0x1p-36);
    }
}
END_TEST

START_TEST(other_nets_give_no_models)
{
    netted a = {.given = {.degree = {3, 3}}};
    take(&a, (double[3]){0.1, 0, 0}, (double[3]){0.7, 1, 1}); /* 0.1 + 0.7 is not a double */
    ck_assert(!net_series_take(a.n.net, &a.n));
    a.given.degree[1] = 2;
    take(&a, zero, one);
    ck_assert(!net_series_take(a.n.net, &a.n));
    a.given.degree[1] = 3, a.given.is_weighted = 1;
    for (int k = 0; k < 16; ++k) a.given.weight[k] = 1;
    take(&a, zero, one);
    ck_assert(!net_series_take(a.n.net, &a.n));
}
END_TEST

SUITE_MAIN("net series", models_of_bicubic_nets_hold, models_of_nets_halved_hold,
           models_hold_where_velocities_underflow, remainders_are_no_larger_than_what_is_left_out,
           other_nets_give_no_models)
