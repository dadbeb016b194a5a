/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface.h"

#include <impinge/formula.h>
#include <string.h>

#include "core/surface/region.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Compositions of an egg and a swirl, each in two builds: with inclusions, and with rates alone.
 * Counters tell whether instances are given back. */

static int alive;

static void counted_destroy(void *self)
{
    (void)self;
    --alive;
}

static void egg_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self;
    imp_model su, cu, sv, cv;
    imp_sincos(u, &su, &cu);
    imp_sincos(v, &sv, &cv);
    out[0] = imp_add(imp_mul(cv, cu), imp_scale(t, 0.25));
    out[1] = imp_mul(cv, su);
    out[2] = imp_scale(imp_add(sv, imp_scale(imp_sqr(sv), 0.125)), 1.5);
}
IMP_SURFACE_FORMULA(egg_formula)

static void swirl_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    (void)self;
    imp_model s, c;
    imp_sincos(imp_add(imp_scale(z, 0.5), t), &s, &c);
    out[0] = imp_sub(imp_mul(c, x), imp_mul(s, y));
    out[1] = imp_add(imp_mul(s, x), imp_mul(c, y));
    out[2] = imp_add(z, imp_scale(imp_mul(x, t), 0.5));
}
IMP_MAP_FORMULA(swirl_formula)

static void egg_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    memcpy(lo, (double[3]){0, -1.5, -INFINITY}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){6, 1.5, 2}, 3 * sizeof *hi);
}

static void swirl_times(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -1;
    *hi = 3;
}

static const imp_surface_type egg = {.name = "egg",
                                     .destroy = counted_destroy,
                                     .domain = egg_domain,
                                     .eval = egg_formula_eval,
                                     .rate = egg_formula_rate,
                                     .include = egg_formula_include};
static const imp_surface_type rate_egg = {.name = "egg",
                                          .destroy = counted_destroy,
                                          .domain = egg_domain,
                                          .eval = egg_formula_eval,
                                          .rate = egg_formula_rate};
static const imp_map_type swirl = {.name = "swirl",
                                   .destroy = counted_destroy,
                                   .time_domain = swirl_times,
                                   .eval = swirl_formula_eval,
                                   .rate = swirl_formula_rate,
                                   .apply = swirl_formula_apply};
static const imp_map_type rate_swirl = {.name = "swirl",
                                        .destroy = counted_destroy,
                                        .time_domain = swirl_times,
                                        .eval = swirl_formula_eval,
                                        .rate = swirl_formula_rate};

static surface *compose(const imp_surface_type *type, const imp_map_type *first,
                        const imp_map_type *second)
{
    surface *s = surface_new(type, &alive);
    ++alive;
    const imp_map_type *maps[2] = {first, second};
    for (int k = 0; k < 2; ++k)
        if (maps[k] != NULL) {
            ++alive;
            ck_assert_int_eq(surface_add_map(s, maps[k], &alive), IMP_SUCCESS);
        }
    return s;
}

/* The four mixtures of parts with and without inclusions. */
static surface *mixture(int k)
{
    return compose(k & 1 ? &rate_egg : &egg, k & 2 ? &rate_swirl : &swirl, &swirl);
}

static imp_region random_region(uint64_t *state)
{
    const double whole_lo[3] = {0, -1.5, -1}, whole_hi[3] = {6, 1.5, 2};
    double lo[3], hi[3];
    for (int j = 0; j < 3; ++j) {
        const double width = random_power(state, -20, 0) * (whole_hi[j] - whole_lo[j]);
        lo[j] = random_between(state, whole_lo[j], whole_hi[j] - width);
        hi[j] = random_bits(state) % 8 == 0 ? lo[j] : lo[j] + width;
    }
    return region_make(lo, hi);
}

static void random_point(uint64_t *state, const imp_region *r, double p[3])
{
    for (int j = 0; j < 3; ++j) {
        p[j] = random_between(state, r->lo[j], r->hi[j]);
        if (random_bits(state) % 4 == 0) p[j] = random_bits(state) % 2 ? r->lo[j] : r->hi[j];
    }
}

static double polynomial(const imp_model *m, const imp_region *r, const double *p)
{
    double s[3], x = m->a;
    for (int j = 0; j < 3; ++j) {
        s[j] = r->d[j] > 0 ? (p[j] - r->c[j]) / r->d[j] : 0;
        x += m->b[j] * s[j];
    }
    return x + m->q[IMP_UU] * s[0] * s[0] + m->q[IMP_UV] * s[0] * s[1] +
           m->q[IMP_UT] * s[0] * s[2] + m->q[IMP_VV] * s[1] * s[1] + m->q[IMP_VT] * s[1] * s[2] +
           m->q[IMP_TT] * s[2] * s[2];
}

START_TEST(points_of_a_composition_lie_in_its_inclusion)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(4000); ++k) {
        surface *s = mixture(k % 4);
        const imp_region r = random_region(&state);
        imp_model model[3];
        ck_assert_int_eq(surface_include(s, &r, model), IMP_STATUS_OK);
        for (int n = 0; n < 6; ++n) {
            double p[3], x[3], e[3];
            random_point(&state, &r, p);
            ck_assert_int_eq(surface_eval(s, 1, p, x, e), IMP_STATUS_OK);
            for (int i = 0; i < 3; ++i) {
                const double slack = e[i] + 1e-14;
                ck_assert(e[i] < 1e-13);
                ck_assert(fabs(x[i] - polynomial(&model[i], &r, p)) <= model[i].e + slack);
                ck_assert(x[i] >= model[i].lo - slack && x[i] <= model[i].hi + slack);
            }
        }
        surface_free(s);
    }
}
END_TEST

START_TEST(a_composition_moves_no_faster_than_its_rates)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(4000); ++k) {
        surface *s = mixture(k % 4);
        const imp_region r = random_region(&state);
        imp_rate_matrix rates;
        ck_assert_int_eq(surface_rate(s, &r, &rates), IMP_STATUS_OK);
        double p[6], x[6], e[6];
        random_point(&state, &r, p);
        random_point(&state, &r, p + 3);
        ck_assert_int_eq(surface_eval(s, 2, p, x, e), IMP_STATUS_OK);
        for (int i = 0; i < 3; ++i) {
            double reach = e[i] + e[3 + i];
            for (int j = 0; j < 3; ++j) reach += rates.m[i][j] * fabs(p[j] - p[3 + j]);
            ck_assert(fabs(x[i] - x[3 + i]) <= reach * (1 + 1e-12));
        }
        surface_free(s);
    }
}
END_TEST

START_TEST(inclusions_through_maps_shrink_like_the_cube_of_the_region)
{
    surface *s = compose(&egg, &swirl, &swirl);
    double e[2];
    for (int k = 0; k < 2; ++k) {
        const double h = k == 0 ? 0x1p-5 : 0x1p-8;
        const imp_region r =
            region_make((double[3]){1 - h, 0.5 - h, 0.5 - h}, (double[3]){1 + h, 0.5 + h, 0.5 + h});
        imp_model model[3];
        ck_assert_int_eq(surface_include(s, &r, model), IMP_STATUS_OK);
        e[k] = model[0].e + model[1].e + model[2].e;
    }
    ck_assert_double_lt(e[1], e[0] / 400); /* (2^3)^3 = 512 */
    surface_free(s);
}
END_TEST

START_TEST(times_are_those_the_type_and_all_maps_have_in_common)
{
    surface *s = compose(&egg, &swirl, NULL);
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    ck_assert(lo[2] == -1 && hi[2] == 2);
    surface_free(s);
}
END_TEST

START_TEST(a_batch_gives_what_single_points_give)
{
    surface *s = mixture(0);
    uint64_t state = suite_seed();
    double p[3 * 50], x[3 * 50], e[3 * 50];
    for (int k = 0; k < 150; ++k) p[k] = random_between(&state, 0, 1.4);
    ck_assert_int_eq(surface_eval(s, 50, p, x, e), IMP_STATUS_OK);
    for (int k = 0; k < 50; ++k) {
        double one[3], error[3];
        ck_assert_int_eq(surface_eval(s, 1, p + 3 * k, one, error), IMP_STATUS_OK);
        ck_assert(memcmp(one, x + 3 * k, sizeof one) == 0);
        ck_assert(memcmp(error, e + 3 * k, sizeof error) == 0);
    }
    surface_free(s);
}
END_TEST

START_TEST(every_instance_is_given_back_once)
{
    alive = 0;
    surface *s = compose(&egg, &swirl, &rate_swirl);
    ck_assert_int_eq(alive, 3);
    surface_free(s);
    ck_assert_int_eq(alive, 0);
}
END_TEST

SUITE_MAIN("surface", points_of_a_composition_lie_in_its_inclusion,
           a_composition_moves_no_faster_than_its_rates,
           inclusions_through_maps_shrink_like_the_cube_of_the_region,
           times_are_those_the_type_and_all_maps_have_in_common,
           a_batch_gives_what_single_points_give, every_instance_is_given_back_once)
