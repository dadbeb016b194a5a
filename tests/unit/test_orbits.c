/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/chain_helpers.h"

/* Motions of centres, and points that stand for their orbits under a symmetry. */

/* The greatest |g| that is claimed at a time. */
static long double claimed_at(const imp_model *g, const imp_region *times, long double t)
{
    const long double w = (t - times->c[2]) / times->d[2];
    const long double value = g->a + (g->b[2] + g->q[IMP_TT] * w) * w;
    const long double by_range = g->lo > -g->hi ? g->lo : -g->hi;
    return fabsl(value) - g->e > by_range ? fabsl(value) - g->e : by_range;
}

/* A point that moves uniformly beside a surface that moves; the way of its center times `factor`.
 */
static void try_carry(uint64_t *random, double factor, tally *of)
{
    imp_symmetry symmetry = draw_symmetry(random);
    const imp_region times = draw_times(random);
    const carry_base base = {times.lo[2], random_bits(random) % 2};
    double start[3], speed[3], lo[3], hi[3], slip;
    chain c;
    imp_model way[3], point[3], g;
    draw_chain(random, symmetry.center, &c);
    draw_vector(random, 4, start);
    draw_vector(random, 2, speed);
    for (int i = 0; i < 3; ++i) lo[i] = -8, hi[i] = 8;
    surface *b = compose_exactly(&symmetry, &c);
    ck_assert_int_eq(surface_carry_slip(b, lo, hi, &times, &base, &slip), IMP_STATUS_OK);
    of->exact += slip < 0x1p-40;
    if (slip < 1 && surface_carry_way(b, &times, &base, way) == IMP_STATUS_OK) {
        for (int i = 0; i < 3; ++i) {
            const imp_model at = imp_shift(imp_scale(imp_param(&times, 2), speed[i]), start[i]);
            point[i] = imp_sub(at, imp_scale(way[i], factor));
        }
        const size_t maps = base.is_bare ? 0 : c.count;
        const imp_status status =
            surface_distance_within(b, &times, maps, point, base.moment, slip, &g);
        of->known += status == IMP_STATUS_OK;
        for (int k = 0; k < POINTS && status == IMP_STATUS_OK; ++k) {
            const long double t =
                times.lo[2] + (times.hi[2] - times.lo[2]) * (long double)random_fraction(random);
            long double x[3];
            for (int i = 0; i < 3; ++i) x[i] = start[i] + speed[i] * t;
            undo_all(&c, t, x);
            const orbit at = orbit_of(&symmetry, x);
            of->judged += 1;
            of->refuted += claimed_at(&g, &times, t) > off(&symmetry, &at) + 0x1p-46L;
        }
    }
    surface_free(b);
}

START_TEST(what_moves_as_its_center_does_is_as_far_as_is_claimed)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_carry(&random, 1, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES / 4), "%d are known", of.known);
    ck_assert_msg(4 * of.exact > suite_times(CASES / 4), "%d are exact", of.exact);
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_carry(&random, 0.95, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

enum { BOX = 24 }; /* half of the box in which the first surface is; length */

/* Moves x by that length, in some direction. */
static void push_aside(uint64_t *random, double length, long double x[3])
{
    double way[3], square = 0;
    draw_vector(random, 1, way);
    for (int i = 0; i < 3; ++i) square += way[i] * way[i];
    for (int i = 0; i < 3 && square > 0; ++i) x[i] += length / sqrt(square) * way[i];
}

/* Two surfaces under one chain of maps, the first beside the other by as much as comes out; points
 * of one orbit of it, which are off by the slack if it is loose, of which a part is left out of the
 * slip. */
static void try_orbit(uint64_t *random, bool is_loose, double left_out, tally *of)
{
    imp_symmetry own = draw_symmetry(random), other = draw_symmetry(random);
    const imp_region times = draw_times(random);
    const double aside = random_bits(random) % 4 ? random_power(random, -40, -1) : 0;
    double lo[3], hi[3], slip;
    unsigned held;
    chain c;
    motion spin;
    own.is_closed = IMP_SYMMETRY_ORBIT_U;
    if (own.kind == IMP_SYMMETRY_ABOUT_POINT && random_bits(random) % 2)
        own.is_closed = IMP_SYMMETRY_ORBIT_ALL;
    if (is_loose) own.is_closed |= IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_NEARLY;
    const double slack = is_loose ? IMP_NEARLY_SLACK * 2 * BOX * sqrt(3) : 0;
    for (int i = 0; i < 3; ++i) own.center[i] = other.center[i] + aside * (i - 1);
    if (random_bits(random) % 4 == 0) own.center[2] += 3;
    if (random_bits(random) % 4 == 0) own.axis[2] = -own.axis[2];
    draw_chain(random, other.center, &c);
    for (int i = 0; i < 3; ++i) lo[i] = -BOX, hi[i] = BOX;
    chain of_b = {.map = {spin_about(other.center, 2)}, .count = c.count + 1};
    for (size_t k = 0; k < c.count; ++k) of_b.map[k + 1] = c.map[k];
    surface *a = compose_exactly(&own, &c), *b = compose_exactly(&other, &of_b);
    ck_assert_int_eq(surface_orbit_slip(a, b, lo, hi, &times, &held, &slip), IMP_STATUS_OK);
    of->known += slip < INFINITY;
    of->exact += slip - slack < 0x1p-36;
    slip -= left_out * slack;
    spin = spin_about(own.center, 1);
    for (int k = 0; k < POINTS && slip < INFINITY; ++k) {
        const double t = random_between(random, times.lo[2], times.hi[2]);
        long double x[3], y[3];
        for (int i = 0; i < 3; ++i) x[i] = own.center[i] + random_between(random, -2, 2);
        memcpy(y, x, sizeof y);
        apply(&spin, random_between(random, -3, 3), y);
        if (held == 3)
            for (int i = 0; i < 3; ++i) y[i] = 2 * own.center[i] - y[i];
        push_aside(random, slack, y);
        for (size_t j = 0; j < c.count; ++j) apply(&c.map[j], t, x), apply(&c.map[j], t, y);
        undo_all(&of_b, t, x);
        undo_all(&of_b, t, y);
        const orbit at = orbit_of(&other, x), was = orbit_of(&other, y);
        const long double shown = apart(&at, &was);
        of->judged += 1;
        of->refuted += shown > slip + 0x1p-44L;
        if (slip > 0x1p-30 && shown / slip > of->sharpest) of->sharpest = (double)(shown / slip);
    }
    surface_free(a);
    surface_free(b);
}

START_TEST(one_point_stands_for_its_orbit)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_orbit(&random, false, 0, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES / 4), "%d are known", of.known);
    ck_assert_msg(20 * of.exact > suite_times(CASES / 4), "%d are exact", of.exact);
    ck_assert_msg(of.sharpest > 0.5, "%g of the slip is shown at most", of.sharpest);
}
END_TEST

START_TEST(one_point_stands_for_its_orbit_but_for_the_slack)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 8); ++k) try_orbit(&random, true, 0, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(20 * of.exact > suite_times(CASES / 8), "%d are exact", of.exact);
    for (int k = 0; k < suite_times(CASES / 8); ++k) try_orbit(&random, true, 0.25, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

/* --- Balls ------------------------------------------------------------------------------------ */

static void point_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 2; ++j) lo[j] = 0, hi[j] = 1;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

static void point_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self, (void)u, (void)v, (void)t;
    out[0] = imp_num(1);
    out[1] = out[2] = imp_num(0);
}
IMP_SURFACE_FORMULA(point_formula)

static imp_status point_distance(const void *self, const imp_model at[4], imp_model *distance)
{
    (void)self, (void)at;
    *distance = imp_num(0);
    return IMP_STATUS_OK;
}

static imp_status point_symmetry(const void *self, imp_symmetry *symmetry)
{
    symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = *(const uint32_t *)self;
    return IMP_STATUS_OK;
}

static const imp_surface_type point = {.struct_size = sizeof(imp_surface_type),
                                       .name = "point",
                                       .domain = point_domain,
                                       .destroy = keep,
                                       .eval = point_formula_eval,
                                       .rate = point_formula_rate,
                                       .include = point_formula_include,
                                       .distance = point_distance,
                                       .symmetry = point_symmetry};

static double radius_of(uint32_t closed)
{
    const imp_region at = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 0});
    surface *s = surface_new(&point, &closed);
    double center[3], radius;
    ck_assert_int_eq(surface_bare_ball(s, &at, center, &radius), IMP_STATUS_OK);
    surface_free(s);
    return radius;
}

START_TEST(a_ball_that_is_round_but_for_the_slack_is_larger_by_it)
{
    const uint32_t exact = IMP_SYMMETRY_ORBIT_ALL | IMP_SYMMETRY_CLOSED;
    ck_assert_double_le(radius_of(exact), 1 + 0x1p-44);
    ck_assert_double_ge(radius_of(exact | IMP_SYMMETRY_NEARLY), 1 + 4 * IMP_NEARLY_SLACK);
}
END_TEST

SUITE_MAIN("orbits", what_moves_as_its_center_does_is_as_far_as_is_claimed,
           one_point_stands_for_its_orbit, one_point_stands_for_its_orbit_but_for_the_slack,
           a_ball_that_is_round_but_for_the_slack_is_larger_by_it)
