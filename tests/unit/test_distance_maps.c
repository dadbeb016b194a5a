/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/formula.h>

#include "core/surface/region.h"
#include "core/surface/surface.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Distances of random moving points from a ball under chains of rigid maps, some as far from rigid
 * as they may be: no more is claimed than a point of the ball under the maps shows, found in long
 * double. */

enum { CASES = 4000, POINTS = 6, MAPS = 3 };

/* --- A ball ----------------------------------------------------------------------------------- */

static const double center[3] = {1, 0.5, -0.25}, radius = 2;

static imp_model gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)self, (void)t;
    const imp_model to[3] = {imp_shift(x, -center[0]), imp_shift(y, -center[1]),
                             imp_shift(z, -center[2])};
    return imp_shift(imp_sqrt(imp_dot3(to, to)), -radius);
}
IMP_DISTANCE_FORMULA(gap)

static void whole(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 3; ++j) lo[j] = j < 2 ? 0 : -INFINITY, hi[j] = j < 2 ? 1 : INFINITY;
}

static void keep(void *self) { (void)self; }

static const imp_surface_type ball = {.struct_size = sizeof(imp_surface_type),
                                      .name = "ball",
                                      .domain = whole,
                                      .destroy = keep,
                                      .distance = gap_distance};

/* --- Maps ------------------------------------------------------------------------------------- */

/* x -> shift + rise t^2 + turn (x - pivot), where a pose knows the turn within `error` only. */
typedef struct motion {
    double turn[3][3], known[3][3], error;
    double shift[3], rise[3], pivot[3];
    bool spins; /* it says that the turn may depend on time */
} motion;

static imp_status place(const void *self, const imp_model *t, imp_pose *pose)
{
    const motion *m = self;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) pose->turn[i][j] = imp_known(m->known[i][j], m->error);
        pose->shift[i] = imp_shift(imp_scale(imp_sqr(*t), m->rise[i]), m->shift[i]);
        pose->pivot[i] = m->pivot[i];
    }
    if (m->spins) pose->turn[0][0] = imp_add(pose->turn[0][0], imp_sub(*t, *t));
    return IMP_STATUS_OK;
}

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static const imp_map_type moves = {.struct_size = sizeof(imp_map_type),
                                   .name = "moves",
                                   .time_domain = always,
                                   .destroy = keep,
                                   .rigid = place};
static const imp_map_type bends = {
    .struct_size = sizeof(imp_map_type), .name = "bends", .time_domain = always, .destroy = keep};

/* Draws the turn of a quaternion that is lengthened or shortened by as much as the slack permits,
 * or hardly at all. */
static void draw_turn(uint64_t *random, motion *m)
{
    double q[4], square = 0;
    for (int k = 0; k < 4; ++k) {
        q[k] = random_between(random, -1, 1);
        square += q[k] * q[k];
    }
    const double stretch = random_bits(random) % 2 ? 1 : 1 + random_between(random, -7e-6, 7e-6);
    m->error = random_bits(random) % 2 ? 0 : random_power(random, -50, -25);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        m->turn[i][i] = 1 - 2 * (q[j + 1] * q[j + 1] + q[k + 1] * q[k + 1]) / square;
        m->turn[i][j] = 2 * (q[i + 1] * q[j + 1] - q[0] * q[k + 1]) / square;
        m->turn[j][i] = 2 * (q[i + 1] * q[j + 1] + q[0] * q[k + 1]) / square;
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            m->turn[i][j] *= stretch;
            m->known[i][j] = m->turn[i][j] + 0.9 * m->error * random_between(random, -1, 1);
        }
}

static void draw_motion(uint64_t *random, double far, motion *m)
{
    draw_turn(random, m);
    m->spins = false;
    for (int i = 0; i < 3; ++i) {
        m->shift[i] = far * random_between(random, -1, 1);
        m->rise[i] = random_bits(random) % 2 ? 0 : random_between(random, -1, 1);
        m->pivot[i] = far * random_between(random, -1, 1);
    }
}

static void apply(const motion *m, double t, long double x[3])
{
    long double y[3];
    for (int i = 0; i < 3; ++i) {
        y[i] = m->shift[i] + m->rise[i] * (long double)t * t;
        for (int j = 0; j < 3; ++j) y[i] += m->turn[i][j] * (x[j] - m->pivot[j]);
    }
    for (int i = 0; i < 3; ++i) x[i] = y[i];
}

/* The point that the turn takes to x: its transpose is nearly its inverse, and the rest shrinks in
 * each step. */
static void undo(const motion *m, double t, long double x[3])
{
    long double aim[3], found[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) aim[i] = x[i] - m->shift[i] - m->rise[i] * (long double)t * t;
    for (int step = 0; step < 8; ++step) {
        long double rest[3];
        for (int i = 0; i < 3; ++i) {
            rest[i] = aim[i];
            for (int j = 0; j < 3; ++j) rest[i] -= m->turn[i][j] * found[j];
        }
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) found[j] += m->turn[i][j] * rest[i];
    }
    for (int j = 0; j < 3; ++j) x[j] = m->pivot[j] + found[j];
}

/* --- Points ----------------------------------------------------------------------------------- */

typedef struct trial {
    motion motion[MAPS];
    size_t count, own; /* maps; those before the point */
    imp_region region;
    imp_model point[3];
    double size; /* of numbers in between */
} trial;

/* Passes near the ball under its own maps. */
static void draw_point(uint64_t *random, trial *y)
{
    const double t = y->region.c[2], width = random_power(random, -20, 0);
    long double x[3];
    for (int i = 0; i < 3; ++i) x[i] = center[i] + 1.5 * radius * random_between(random, -1, 1);
    for (size_t k = 0; k < y->own; ++k) apply(&y->motion[k], t, x);
    for (int i = 0; i < 3; ++i) {
        imp_model *m = &y->point[i];
        *m = (imp_model){
            .a = (double)x[i], .e = width * random_power(random, -12, -2), .depends = 7};
        double reach = m->e;
        for (int j = 0; j < 3; ++j) {
            m->b[j] = width * random_between(random, -1, 1);
            m->rate[j] = INFINITY;
            reach += fabs(m->b[j]);
        }
        m->lo = m->a - reach - 0x1p-50 * (fabs(m->a) + reach);
        m->hi = m->a + reach + 0x1p-50 * (fabs(m->a) + reach);
    }
}

static trial draw_trial(uint64_t *random)
{
    const double lo[3] = {0, 0, random_between(random, -1, 0)};
    const double hi[3] = {1, 1, lo[2] + random_power(random, -10, 0)};
    const double far = random_bits(random) % 2 ? random_power(random, 0, 16) : 1;
    trial y = {.region = region_make(lo, hi), .size = 64 * far};
    y.count = 1 + random_bits(random) % MAPS;
    y.own = random_bits(random) % (y.count + 1);
    for (size_t k = 0; k < y.count; ++k) draw_motion(random, far, &y.motion[k]);
    draw_point(random, &y);
    return y;
}

/* How far the point is from a point of the ball, or a little more, once all maps have moved
 * both. */
static long double shown(const trial *y, double t, const long double at[3])
{
    long double x[3], on[3], length = 0, apart = 0;
    for (int i = 0; i < 3; ++i) on[i] = x[i] = at[i];
    for (size_t k = y->own; k-- > 0;) undo(&y->motion[k], t, on);
    for (int i = 0; i < 3; ++i) length += (on[i] - center[i]) * (on[i] - center[i]);
    for (int i = 0; i < 3; ++i) on[i] = center[i] + radius * (on[i] - center[i]) / sqrtl(length);
    for (size_t k = 0; k < y->count; ++k) {
        apply(&y->motion[k], t, on);
        if (k >= y->own) apply(&y->motion[k], t, x);
    }
    for (int i = 0; i < 3; ++i) apart += (x[i] - on[i]) * (x[i] - on[i]);
    return sqrtl(apart);
}

static long double claimed(const imp_model *g, const double s[3])
{
    long double value = g->a;
    for (int j = 0, k = 0; j < 3; ++j) {
        value += (long double)g->b[j] * s[j];
        for (int l = j; l < 3; ++l, ++k) value += (long double)g->q[k] * s[j] * s[l];
    }
    const long double by_polynomial = fabsl(value) - g->e;
    const long double by_range = g->lo > 0 ? g->lo : -g->hi;
    return by_polynomial > by_range ? by_polynomial : by_range;
}

/* --- Judging ---------------------------------------------------------------------------------- */

typedef struct tally {
    int judged, refuted;
    double sharpest; /* the greatest part that is claimed */
} tally;

static void judge(const trial *y, const imp_model *g, uint64_t *random, tally *of)
{
    for (int k = 0; k < POINTS; ++k) {
        double s[3];
        long double x[3];
        for (int j = 0; j < 3; ++j) s[j] = random_between(random, -0.999, 0.999);
        const double t = y->region.c[2] + y->region.d[2] * s[2];
        for (int i = 0; i < 3; ++i) {
            const imp_model *m = &y->point[i];
            x[i] = m->a + 0.999 * m->e * random_between(random, -1, 1);
            for (int j = 0; j < 3; ++j) x[i] += (long double)m->b[j] * s[j];
        }
        const long double most = shown(y, t, x), least = claimed(g, s), slack = 0x1p-58 * y->size;
        of->judged += 1;
        of->refuted += least > most + slack;
        if (most > 0.1 && least / most > of->sharpest) of->sharpest = (double)(least / most);
    }
}

static surface *compose(trial *y)
{
    surface *s = surface_new(&ball, y);
    ck_assert_ptr_nonnull(s);
    for (size_t k = 0; k < y->count; ++k)
        ck_assert_int_eq(surface_add_map(s, &moves, &y->motion[k]), IMP_SUCCESS);
    return s;
}

/* Claims times `factor`. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    tally of = {0, 0, 0};
    for (int k = 0; k < suite_times(CASES); ++k) {
        trial y = draw_trial(&random);
        surface *s = compose(&y);
        imp_model g;
        ck_assert(surface_has_distance(s));
        ck_assert_int_eq(surface_distance(s, &y.region, y.own, y.point, &g), IMP_STATUS_OK);
        g = imp_scale(g, factor);
        judge(&y, &g, &random, &of);
        surface_free(s);
    }
    return of;
}

START_TEST(no_distance_under_maps_is_claimed_that_a_point_refutes)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "%d of %d refuted", of.refuted, of.judged);
    ck_assert_msg(of.sharpest > 0.99, "%g of the distance is claimed at most", of.sharpest);
}
END_TEST

/* The test above must be able to fail: a part of the slack of one map more is too much. */
START_TEST(distances_that_forget_how_maps_shorten_are_found)
{
    ck_assert_int_gt(try_all(1 + 2 * IMP_RIGID_SLACK).refuted, 0);
}
END_TEST

START_TEST(maps_are_still_until_one_spins)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < 50; ++k) {
        trial y = draw_trial(&random);
        const size_t spins = random_bits(&random) % (y.count + 1);
        size_t still;
        if (spins < y.count) y.motion[spins].spins = true;
        surface *s = compose(&y);
        ck_assert_int_eq(surface_still_maps(s, &y.region, &still), IMP_STATUS_OK);
        ck_assert_uint_eq(still, spins);
        surface_free(s);
    }
}
END_TEST

START_TEST(maps_that_bend_leave_no_distance)
{
    uint64_t random = suite_seed();
    trial y = draw_trial(&random);
    surface *s = compose(&y);
    ck_assert(surface_has_distance(s));
    ck_assert_int_eq(surface_add_map(s, &bends, &y), IMP_SUCCESS);
    ck_assert(!surface_has_distance(s));
    surface_free(s);
}
END_TEST

/* Only the outer of the two maps is the same instance. */
START_TEST(maps_are_common_that_are_the_same_instances_at_the_end)
{
    motion m = {.error = 0};
    shared_instance *parts[3];
    surface *s[3];
    for (int k = 0; k < 3; ++k) parts[k] = instance_of_map(&moves, &m);
    for (int k = 0; k < 3; ++k) s[k] = surface_new(&ball, &m);
    for (int k = 0; k < 2; ++k) {
        ck_assert_int_eq(surface_add_instance(s[k], parts[k]), IMP_SUCCESS);
        ck_assert_int_eq(surface_add_instance(s[k], parts[2]), IMP_SUCCESS);
    }
    ck_assert_uint_eq(surface_common_maps(s[0], s[1]), 1);
    ck_assert_uint_eq(surface_common_maps(s[0], s[0]), 2);
    ck_assert_uint_eq(surface_common_maps(s[0], s[2]), 0);
    for (int k = 0; k < 3; ++k) surface_free(s[k]);
    for (int k = 0; k < 3; ++k) instance_release(parts[k]);
}
END_TEST

SUITE_MAIN("distance maps", no_distance_under_maps_is_claimed_that_a_point_refutes,
           distances_that_forget_how_maps_shorten_are_found, maps_are_still_until_one_spins,
           maps_that_bend_leave_no_distance, maps_are_common_that_are_the_same_instances_at_the_end)
