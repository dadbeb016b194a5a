/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/net_distance.h"

/* The copy for narrow registers stands beside the library's own. */
bool narrow_paraboloid_parts(const node *a, const node *b, const net_paraboloid *d,
                             double gamma_clear, const time_window *window);
#define imp_quad_is_wide() false
#define net_paraboloid_parts narrow_paraboloid_parts
#include "core/bounds/net_paraboloid.c"
#undef imp_quad_is_wide
#undef net_paraboloid_parts

/* What paraboloids part, against points: sampled ones, moved to where they are nearest. */

static double random_sign(uint64_t *state) { return random_bits(state) % 2 ? 1 : -1; }

/* Three unit vectors at right angles; now and then, any three vectors that are not too long. */
static void draw_vectors(uint64_t *state, net_paraboloid *d)
{
    vec3 *const v[3] = {&d->normal, &d->across[0], &d->across[1]};
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) v[k]->x[i] = random_between(state, -1, 1);
    if (random_bits(state) % 8 == 0) return;
    *v[0] = vec3_scale(*v[0], 1 / vec3_norm(*v[0]));
    *v[1] = vec3_cross(*v[0], *v[1]);
    *v[1] = vec3_scale(*v[1], 1 / vec3_norm(*v[1]));
    *v[2] = vec3_cross(*v[0], *v[1]);
}

static void draw_paraboloid(uint64_t *state, net_paraboloid *d)
{
    draw_vectors(state, d);
    for (int i = 0; i < 2; ++i)
        d->bend[i] = random_bits(state) % 4 ? random_sign(state) * random_power(state, -4, 2) : 0;
    for (int i = 0; i < 3; ++i) {
        d->at.x[i] = random_between(state, -0.5, 0.5);
        d->velocity.x[i] = random_between(state, -1, 1);
    }
    d->time = random_between(state, -1, 2);
}

/* Moves a control point along the normal, so that it lies nearly on the paraboloid. */
static void press(const net_paraboloid *d, double flat, imp_net *g, int k)
{
    const vec3 p = {{g->point[0][k], g->point[1][k], g->point[2][k]}};
    double by = (flat - 1) * vec3_dot(p, d->normal);
    for (int i = 0; i < 2; ++i)
        by += 0.5 * d->bend[i] * vec3_dot(p, d->across[i]) * vec3_dot(p, d->across[i]);
    for (int i = 0; i < 3; ++i) g->point[i][k] += by * d->normal.x[i];
}

/* A net whose points lie near the paraboloid, on the side of `sign`. */
static void draw_beside(uint64_t *state, const net_paraboloid *d, double sign, netted *made)
{
    const double far = random_power(state, -4, 1), flat = random_power(state, -6, 0);
    imp_net *g = &made->given;
    draw_net(state, (uint32_t)(random_bits(state) % 4), (uint32_t)(random_bits(state) % 4), 0,
             made);
    g->is_weighted = 0;
    for (int i = 0; i < 3; ++i) {
        g->place[i] = d->at.x[i] + (0.5 - d->time) * d->velocity.x[i];
        g->place[i] += sign * far * d->normal.x[i];
        g->drift[i] = d->velocity.x[i] + random_power(state, -6, 0) * random_between(state, -1, 1);
        g->error[i] = random_bits(state) % 4 == 0 ? random_power(state, -10, -3) : 0;
        for (int k = 0; k < IMP_NET_POINTS; ++k) g->velocity[i][k] *= flat;
    }
    const double part = random_power(state, -6, 0);
    for (int k = 0; k < IMP_NET_POINTS; ++k) press(d, part, g, k);
    take(made, zero, one);
}

static double bernstein(int n, int k, double x)
{
    const double choose = n < 2 || k == 0 || k == n ? 1 : n;
    return choose * pow(x, k) * pow(1 - x, n - k);
}

static double coordinate(const netted *f, int i, const double p[2], double t)
{
    const imp_net *g = &f->given;
    const int n = (int)g->degree[0], m = (int)g->degree[1];
    const double tau = t - f->n.region.c[PARAMETER_T];
    double sum = g->place[i] + tau * g->drift[i];
    for (int k = 0; k <= n; ++k)
        for (int l = 0; l <= m; ++l) {
            const int at = k * (m + 1) + l;
            sum += bernstein(n, k, p[0]) * bernstein(m, l, p[1]) *
                   (g->point[i][at] + (g->is_moving ? tau * g->velocity[i][at] : 0));
        }
    return sum;
}

/* The distance of two points that are as near as the nets' errors permit. q holds u and v of both
 * and the time, as parts of the window. */
static double distance_at(const netted *const both[2], const double q[5], const time_window *w)
{
    const double t = w->lo + q[4] * (w->hi - w->lo);
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double room = both[0]->given.error[i] + both[1]->given.error[i];
        const double x = fabs(coordinate(both[0], i, q, t) - coordinate(both[1], i, q + 2, t));
        if (x > room) sum += (x - room) * (x - room);
    }
    return sqrt(sum);
}

/* Returns a distance that is nearly the least: of random points, of which the nearest are moved as
 * long as that brings them nearer. */
static double least_distance(uint64_t *state, const netted *const both[2], const time_window *w)
{
    double best[5], least = INFINITY;
    for (int k = 0; k < 600; ++k) {
        double q[5];
        const double reach = pow(0.5, (k - 100) / 25.0);
        for (int j = 0; j < 5; ++j) {
            q[j] = k < 100 ? random_between(state, -0.2, 1.2)
                           : best[j] + reach * random_between(state, -1, 1);
            q[j] = q[j] < 0 ? 0 : q[j] > 1 ? 1 : q[j];
        }
        const double distance = distance_at(both, q, w);
        if (!(distance < least)) continue;
        least = distance;
        memcpy(best, q, sizeof best);
    }
    return least;
}

/* Returns the greatest gamma_clear that is proved, to a tenth of a per cent; 0: none. */
static double parted_by(const netted *a, const netted *b, const net_paraboloid *d,
                        const time_window *w)
{
    double lo = 0, hi = 8;
    for (int k = 0; k < 24; ++k) {
        const double mid = lo > 0 ? 0.5 * (lo + hi) : hi * 0.125;
        const bool is_parted = net_paraboloid_parts(&a->n, &b->n, d, mid, w);
        ck_assert(narrow_paraboloid_parts(&a->n, &b->n, d, mid, w) == is_parted);
        *(is_parted ? &lo : &hi) = mid;
        if (hi - lo < 1e-3 * hi) break;
    }
    return lo;
}

START_TEST(no_two_points_of_what_is_parted_are_near)
{
    uint64_t state = suite_seed();
    int parted = 0, close = 0, curved = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        netted a, b;
        const netted *const both[2] = {&a, &b};
        net_paraboloid d;
        draw_paraboloid(&state, &d);
        draw_beside(&state, &d, -1, &a);
        draw_beside(&state, &d, 1, &b);
        const double start = random_fraction(&state);
        const time_window w = {start, start + (1 - start) * random_power(&state, -10, 0)};
        const double gamma_clear = parted_by(&a, &b, &d, &w);
        if (!(gamma_clear > 0)) continue;
        const double least = least_distance(&state, both, &w);
        ck_assert_double_ge(least, gamma_clear - 1e-12);
        parted += 1, close += least < 1.05 * gamma_clear;
        curved += d.bend[0] != 0 && d.bend[1] != 0;
    }
    ck_assert_int_gt(parted, suite_times(3000) / 10);
    ck_assert_int_gt(curved, suite_times(3000) / 20);
    ck_assert_int_gt(close, suite_times(3000) / 100);
}
END_TEST

/* Two points on either side of a paraboloid that bends towards them. */
static bool points_are_parted(double bend, double off, double gamma_clear, double error)
{
    netted a = {.given = {.degree = {0, 0}}}, b = {.given = {.degree = {0, 0}}};
    const net_paraboloid d = {
        .normal = {{0, 0, 1}}, .across = {{{1, 0, 0}}, {{0, 1, 0}}}, .bend = {bend, 0}};
    const time_window w = {0, 1};
    a.given.place[0] = b.given.place[0] = off;
    b.given.place[2] = 1;
    b.given.error[2] = error;
    take(&a, zero, one);
    take(&b, zero, one);
    return net_paraboloid_parts(&a.n, &b.n, &d, gamma_clear, &w);
}

START_TEST(the_slope_of_a_paraboloid_counts_and_the_errors_of_nets)
{
    ck_assert(points_are_parted(0, 0, 0.9999999, 0));
    ck_assert(!points_are_parted(0, 0, 1, 0)); /* rounding counts */
    ck_assert(points_are_parted(1, 0, 0.9999999, 0));
    /* The slope is 5/4 there. At each of the two it counts as 41/32, less 1 together. */
    ck_assert(!points_are_parted(1, 0.75, 0.641, 0));
    ck_assert(points_are_parted(1, 0.75, 0.639, 0));
    ck_assert(points_are_parted(-1, 0.75, 0.639, 0));
    ck_assert(points_are_parted(0, 0, 0.74, 0.25));
    ck_assert(!points_are_parted(0, 0, 0.76, 0.25));
}
END_TEST

/* Whether a point at the height z is parted from one at 1 that moves with the paraboloid, while it
 * moves along the curvature. */
static bool is_passed(double bend, double speed, double z)
{
    netted a = {.given = {.degree = {0, 0}}}, b = {.given = {.degree = {0, 0}}};
    const net_paraboloid d = {.normal = {{0, 0, 1}},
                              .across = {{{1, 0, 0}}, {{0, 1, 0}}},
                              .bend = {bend, 0},
                              .time = 0.5};
    const time_window w = {0, 1};
    a.given.drift[0] = speed;
    a.given.place[2] = z;
    b.given.place[2] = 1;
    take(&a, zero, one);
    take(&b, zero, one);
    return net_paraboloid_parts(&a.n, &b.n, &d, 0x1p-10, &w);
}

/* Below a paraboloid that bends up, the point is farthest from it at the ends of the window. */
START_TEST(a_paraboloid_is_crossed_between_the_ends_of_a_window)
{
    ck_assert(is_passed(0, 100, 0));
    ck_assert(is_passed(1, 1.6, 0));
    ck_assert(is_passed(-1, 1, 0));
    ck_assert(!is_passed(-1, 3, 0));   /* crosses it at the ends */
    ck_assert(!is_passed(1, 2, 1.2));  /* is above it in the middle, where it meets the other */
    ck_assert(!is_passed(1, 20, 1.2)); /* however far from there it begins */
}
END_TEST

START_TEST(numbers_that_mean_nothing_part_nothing)
{
    netted a = {.given = {.degree = {0, 0}}}, b = {.given = {.degree = {0, 0}}};
    const net_paraboloid good = {.normal = {{0, 0, 1}}, .across = {{{1, 0, 0}}, {{0, 1, 0}}}};
    const time_window w = {0, 1};
    b.given.place[2] = 1;
    take(&a, zero, one);
    take(&b, zero, one);
    ck_assert(net_paraboloid_parts(&a.n, &b.n, &good, 0.5, &w));
    ck_assert(!net_paraboloid_parts(&a.n, &b.n, &good, NAN, &w));
    const double bad[] = {NAN, INFINITY, -INFINITY, 0x1p300};
    for (int k = 0; k < 4; ++k) {
        net_paraboloid d[7];
        for (int i = 0; i < 7; ++i) d[i] = good;
        d[0].normal.x[0] = bad[k];
        d[1].across[0].x[1] = bad[k];
        d[2].across[1].x[2] = bad[k];
        d[3].bend[0] = bad[k];
        d[4].at.x[0] = bad[k];
        d[5].velocity.x[2] = bad[k];
        d[6].time = bad[k];
        for (int i = 0; i < 7; ++i) ck_assert(!net_paraboloid_parts(&a.n, &b.n, &d[i], 0.5, &w));
    }
    a.n.net = NULL;
    ck_assert(!net_paraboloid_parts(&a.n, &b.n, &good, 0.5, &w));
}
END_TEST

SUITE_MAIN("net_paraboloid", no_two_points_of_what_is_parted_are_near,
           the_slope_of_a_paraboloid_counts_and_the_errors_of_nets,
           a_paraboloid_is_crossed_between_the_ends_of_a_window,
           numbers_that_mean_nothing_part_nothing)
