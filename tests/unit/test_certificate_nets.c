/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/read_statement.h"
#include "tools/verify/look.h"

/* The control points of impinge-verify: what they bound is held against points of the formulas,
 * which are enclosed without them. */

static const char shapes[] =
    "impinge certificate 2\nprogram impinge 0\nverdict clear\napart 1\nfrom -1\nto 3\n"
    "parameter -2 1 p\nparameter -0.02 0.03 q\nbody a\n"
    "shape 1 patch\nu in [0, 1]; v in [-1, 2]; a = (1 - u)^3; b = 3*u*(1 - u)^2; c = u^3;"
    "a*(v^3 - 2) + b*(v + t) + c*(1 - v)^2/3; a*t + b*v*(1 - v) - c; a*v^2*1000 + (2 - v)*c*t\n"
    "shape 1 triangle\nu in [0, 1]; v in [0, 1]; u; u*v; 0.25 - u + 3*(u*v)\n"
    "shape 1 torus\nu in [0, 2*pi]; v in [0, 2*pi]; (2 + cos(v)/2)*cos(u); (2 + cos(v)/2)*sin(u); "
    "sin(v)/2\n"
    "shape 1 kink\nu in [-1, 1]; v in [-1, 1]; u; v; max(abs(u - v/2), 0.25) + sqrt(1 + u^2)\n"
    "shape 1 wave\nu in [-1, 1]; v in [-1, 1]; u + 1e6; v; sin(3*u + t)*exp(v)\n"
    "map 1 rotate\nA = 0.7 + 2*t + 0.1*t^3; x*cos(A) - y*sin(A); x*sin(A) + y*cos(A); z\n"
    "map 1 drift\nx + 5*t; y - t^2; z + sin(4*t)\n"
    "map 1 tilt\n0.6*x + 0.8*(z - 100); y; 0.6*(z - 100) - 0.8*x\n"
    "map 1 bend\nx + 0.1*y^2; y; z - 0.1*x*y*t\n"
    "map 1 rotate clock 1\nx*cos(t) - y*sin(t); x*sin(t) + y*cos(t); z\n"
    "map 1 lever clock 2\nc = cos(t); s = sin(t); x; 70 + (y - 70)*c - (z + 90)*s; "
    "(y - 70)*s + (z + 90)*c - 90\n"
    "map 1 slide clock 1\nx + 2*t; y - t^3; z\n"
    "shape 1 fan clock 2\nu in [-1, 1]; v in [-1, 1]; u + t*v; v - t^2; 100*t*u*v\n"
    "surface 0 0\nsurface 0 0 5\nsurface 0 0 5 6 7\nsurface 0 1\nsurface 0 1 6 5 7\nsurface 0 2\n"
    "surface 0 2 5 7 6 5\nsurface 0 3\nsurface 0 3 6 5\nsurface 0 4\nsurface 0 4 5 6\n"
    "surface 0 2 5 8 6\nsurface 0 0 8\nsurface 0 0 9\nsurface 0 2 10 5\nsurface 0 1 9 10 5 11\n"
    "surface 0 2 5 11 7 10 9\nsurface 0 12\nsurface 0 12 9 10\nsurface 0 3 8 9\ntrees\n";

/* A box of any size down to a few ulps, or a point. */
static box3 draw_box(uint64_t *seed, const place *of, double from, double to)
{
    box3 whole = {{0, 0, from}, {0, 0, to}}, b;
    piece_box(of, &whole);
    whole.lo[T] = from, whole.hi[T] = to;
    for (int j = 0; j < VARIABLES; ++j) {
        const double width = (whole.hi[j] - whole.lo[j]) * exp2(-random_between(seed, -1, 50));
        const double at = random_between(seed, whole.lo[j], whole.hi[j]);
        b.lo[j] = fmax(at - width / 2, whole.lo[j]);
        b.hi[j] = random_bits(seed) % 16 == 0 ? b.lo[j] : fmin(at + width / 2, whole.hi[j]);
    }
    return b;
}

static double draw_axis(uint64_t *seed)
{
    return ldexp(random_between(seed, -1, 1), (int)random_between(seed, 0, 16));
}

/* Ranges of all clocks, of any size, for which the one that is T counts nothing. */
static void draw_values(uint64_t *seed, const statement *s, size_t main, values *when)
{
    static uint64_t stamp;
    *when = (values){.count = s->clock_count, .main = main, .stamp = ++stamp};
    for (size_t k = 0; k < s->clock_count; ++k) {
        const double lo = s->clocks[k].lo, hi = s->clocks[k].hi, at = random_between(seed, lo, hi);
        const double width = (hi - lo) * exp2(-random_between(seed, -1, 30));
        when->lo[k] = fmax(at - width / 2, lo);
        when->hi[k] = random_bits(seed) % 16 == 0 ? when->lo[k] : fmin(at + width / 2, hi);
    }
}

/* One value of each, at their ends or between. */
static values draw_value(uint64_t *seed, const values *all)
{
    values one = *all;
    for (size_t k = 0; k < all->count; ++k) {
        const double s = 0.5 + 0.5 * suite_end_or_inside(seed);
        const double x = all->lo[k] + s * (all->hi[k] - all->lo[k]);
        one.lo[k] = one.hi[k] = s == 1 ? all->hi[k] : fmin(fmax(x, all->lo[k]), all->hi[k]);
    }
    return one;
}

static values middle_value(const values *all)
{
    values one = *all;
    for (size_t k = 0; k < all->count; ++k) one.lo[k] = one.hi[k] = middle(all->lo[k], all->hi[k]);
    return one;
}

/* The bound at a time, a little above it. */
static long double bound_at(const reach *r, const box3 *b, double t)
{
    static const int binomial[NET_TIMES] = {1, 4, 6, 4, 1};
    const long double width = (long double)b->hi[T] - b->lo[T];
    const long double s = width > 0 ? ((long double)t - b->lo[T]) / width : 0;
    long double sum = 0, size = 0;
    for (int k = 0; k < NET_TIMES; ++k) {
        const long double here = binomial[k] * powl(s, k) * powl(1 - s, 4 - k);
        sum += here * r->upper[k];
        size += here * fabsl(r->upper[k]);
    }
    return sum + size * 0x1p-58L;
}

/* n.x, at least. */
static double along_lower(const double n[3], const jet x[3])
{
    ld_interval sum = ld_interval_of(0);
    for (int i = 0; i < 3; ++i)
        sum = ld_interval_add(sum, ld_interval_mul(ld_interval_of(n[i]), x[i].v));
    return sum.lo;
}

static void draw_point(uint64_t *seed, const box3 *b, box3 *at)
{
    for (int j = 0; j < VARIABLES; ++j) {
        const double s = 0.5 + 0.5 * suite_end_or_inside(seed);
        const double x = b->lo[j] + s * (b->hi[j] - b->lo[j]);
        at->lo[j] = at->hi[j] = s == 1 ? b->hi[j] : fmin(fmax(x, b->lo[j]), b->hi[j]);
    }
}

static void check_points(scene *s, uint64_t *seed, const place *of, const box3 *b, const form *x)
{
    const double n[3] = {draw_axis(seed), draw_axis(seed), draw_axis(seed)};
    double corner[8][3], centre[3];
    reach r;
    net_along(x, n, &r, NULL);
    const double off = net_points(x, corner, centre);
    values when;
    const values mean = middle_value(of->when);
    const place apart = {of->of, of->chain, of->piece, of->maps, s->room, NULL, &when};
    const place between = {of->of, of->chain, of->piece, of->maps, s->room, NULL, &mean};
    for (int k = 0; k < 12; ++k) {
        box3 at;
        jet x_at[3], same[3];
        split unused;
        draw_point(seed, b, &at);
        for (int j = 0; j < VARIABLES && k < 8; ++j)
            at.lo[j] = at.hi[j] = (k >> j & 1) != 0 ? b->hi[j] : b->lo[j];
        when = draw_value(seed, of->when);
        ck_assert_int_eq(enclose(&apart, &at, at.lo, x_at, same, &unused), ENCLOSED);
        ck_assert_msg(
            along_lower(n, x_at) <= bound_at(&r, b, at.lo[T]),
            "surface %td, u [%a, %a], v [%a, %a], t [%a, %a], point %a %a %a: %a above %La",
            of->chain - s->says.chains, b->lo[0], b->hi[0], b->lo[1], b->hi[1], b->lo[2], b->hi[2],
            at.lo[0], at.lo[1], at.lo[2], along_lower(n, x_at), bound_at(&r, b, at.lo[T]));
        ck_assert_int_eq(enclose(&between, &at, at.lo, x_at, same, &unused), ENCLOSED);
        for (int i = 0; i < 3 && k < 8; ++i)
            ck_assert(corner[k][i] - off <= x_at[i].v.hi && corner[k][i] + off >= x_at[i].v.lo);
    }
}

START_TEST(control_points_contain_the_points_of_a_box)
{
    uint64_t seed = suite_seed();
    scene s = scene_made(shapes);
    int nets = 0, moved = 0, tight = 0, swayed = 0;
    const int times = suite_times(20000);
    for (int k = 0; k < times; ++k) {
        const chain *c = &s.says.chains[random_bits(&seed) % s.says.chain_count];
        values when;
        const size_t main = (size_t)(random_between(&seed, 0, 1) * (double)s.says.clock_count);
        draw_values(&seed, &s.says, main, &when);
        const place of = {&s.says, c, 0, c->count - 1, s.room, s.memos, &when};
        const box3 b =
            draw_box(&seed, &of, s.says.clocks[when.main].lo, s.says.clocks[when.main].hi);
        form x;
        split unused;
        ck_assert_int_eq(look_net(s.known, &of, &b, &x, &unused), ENCLOSED);
        if (x.net == NULL) continue;
        nets += 1;
        moved += x.motion != NULL;
        swayed += x.motion != NULL && x.motion->way_count > 0;
        tight += x.net->error[0] < 1e-12;
        check_points(&s, &seed, &of, &b, &x);
        draw_values(&seed, &s.says, main, &when); /* others, for which nothing may be kept */
        ck_assert_int_eq(look_net(s.known, &of, &b, &x, &unused), ENCLOSED);
        if (x.net != NULL) check_points(&s, &seed, &of, &b, &x);
    }
    ck_assert_int_gt(nets, times * 9 / 10);
    ck_assert_int_gt(moved, times / 4);
    ck_assert_int_gt(tight, times / 5);
    ck_assert_int_gt(swayed, times / 8);
    scene_free(&s);
}
END_TEST

START_TEST(polynomials_and_affine_maps_are_known_as_such)
{
    scene s = scene_made(shapes);
    for (size_t k = 0; k < s.says.stage_count; ++k) {
        const part *p = &s.says.stages[k].pieces[0].parts[0];
        ck_assert_int_eq(p->net != NULL, k < 2 || k == 12);
        ck_assert_int_eq(p->is_affine, (k >= 5 && k < 8) || (k > 8 && k < 12));
        ck_assert_int_eq(p->is_moving, k == 0 || k == 4 || k == 12);
    }
    const net *patch = s.says.stages[0].pieces[0].parts[0].net;
    ck_assert(patch->n[0] == 4 && patch->n[1] == 4 && patch->n[2] == 2);
    scene_free(&s);
}
END_TEST

SUITE_MAIN("certificate nets", control_points_contain_the_points_of_a_box,
           polynomials_and_affine_maps_are_known_as_such)
