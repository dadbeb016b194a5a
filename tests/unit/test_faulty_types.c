/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/sphere_scenes.h"

/* Types that break promises of the ABI: each ends the query with an error that names the type, the
 * region or point, and what is wrong. And types that have no bounds in places, as they may: a query
 * ends all the same. All are balls that behave until the search has come to small regions. */

/* A ball, and the number that it writes into its answers. */
typedef struct liar {
    ball b;      /* first: callbacks of balls see a ball */
    size_t slot; /* which number of the answer, as doubles from its start; NONE: none */
    double value;
    imp_status status; /* answered instead of IMP_OK */
} liar;

#define NONE ((size_t)-1)
#define SLOT(MEMBER) (offsetof(imp_model, MEMBER) / sizeof(double))

static bool is_small(const imp_region *region) { return region->d[0] < 0.5 && region->lo[0] > 0.5; }

static void lie(const liar *l, double *numbers, imp_status *status)
{
    if (l->slot != NONE) numbers[l->slot] = l->value;
    *status = l->status;
}

static imp_status lying_include(const void *self, const imp_region *region, imp_model model[3])
{
    imp_status status = ball_formula_include(self, region, model);
    if (is_small(region)) lie(self, (double *)&model[1], &status);
    return status;
}

static imp_status lying_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    imp_status status = ball_formula_rate(self, region, rates);
    if (is_small(region)) lie(self, &rates->m[0][0], &status);
    return status;
}

/* True in the middle of the domain, where a query looks when it begins. */
static imp_status lying_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    imp_status status = ball_formula_eval(self, n, p, x, error);
    const liar *l = self;
    double numbers[6] = {x[0], x[1], x[2], 0, 0, 0};
    if (p[0] == 3.15) return status;
    if (error != NULL) memcpy(numbers + 3, error, 3 * sizeof *error);
    lie(l, numbers, &status);
    memcpy(x, numbers, 3 * sizeof *x);
    if (error != NULL) memcpy(error, numbers + 3, 3 * sizeof *error);
    return status;
}

static const ball at_rest = {.radius = 1};
#define FLIGHT                                                                                     \
    {                                                                                              \
        .radius = 0.5, .centre = {2, 1.5, -1}, .velocity = { -2, -2, 1.2 }                         \
    }

/* What the query says that pairs the liar, of the type, with an honest ball. */
static imp_error error_of(const imp_surface_type *type, const liar *l, imp_method method)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, type, &l->b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-3;
    options.method = method;
    options.max_pairs = 100000;
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    const imp_code code = imp_query_step(query, 0, &error);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(code, error.code);
    ck_assert_msg(r.verdict == IMP_UNDECIDED && r.t_lower <= 0.43, "verdict %d, t_lower %g: %s",
                  (int)r.verdict, r.t_lower, error.text);
    if (code != IMP_SUCCESS) /* for good */
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    imp_scene_free(scene);
    return error;
}

static void is_caught(const imp_surface_type *type, const liar *l, imp_method method,
                      const char *what)
{
    const imp_error error = error_of(type, l, method);
    ck_assert_msg(error.code == IMP_ERROR_PLUGIN && strstr(error.text, what) != NULL,
                  "slot %zd, value %g, status %d: code %d, '%s', expected '%s'", (ssize_t)l->slot,
                  l->value, (int)l->status, (int)error.code, error.text, what);
    ck_assert_ptr_nonnull(strstr(error.text, "type 'liar'"));
    ck_assert_ptr_nonnull(strstr(error.text, "u "));
}

/* --- Models ------------------------------------------------------------------------------- */

#define LIAR(EVAL, RATE, INCLUDE)                                                                  \
    {                                                                                              \
        .name = "liar", .destroy = ball_destroy, .domain = ball_domain, .eval = EVAL,              \
        .rate = RATE, .include = INCLUDE                                                           \
    }

static const imp_surface_type model_liar =
    LIAR(ball_formula_eval, ball_formula_rate, lying_include);
static const imp_surface_type rate_liar = LIAR(ball_formula_eval, lying_rate, NULL);
static const imp_surface_type point_liar =
    LIAR(lying_eval, ball_formula_rate, ball_formula_include);

START_TEST(models_that_are_no_bounds_are_caught)
{
    static const struct {
        size_t slot;
        double value;
        const char *what;
    } sins[] = {
        {SLOT(a), NAN, "a coefficient is infinite or NaN"},
        {SLOT(a), INFINITY, "a coefficient is infinite or NaN"},
        {SLOT(b) + 1, NAN, "a coefficient is infinite or NaN"},
        {SLOT(b) + 2, -INFINITY, "a coefficient is infinite or NaN"},
        {SLOT(q), NAN, "a coefficient is infinite or NaN"},
        {SLOT(q) + IMP_TT, INFINITY, "a coefficient is infinite or NaN"},
        {SLOT(e), NAN, "the remainder is negative or NaN"},
        {SLOT(e), -1e-300, "the remainder is negative or NaN"},
        {SLOT(e), INFINITY, "a bound is infinite"},
        {SLOT(lo), 1e6, "the range is inverted or NaN"},
        {SLOT(lo), NAN, "the range is inverted or NaN"},
        {SLOT(hi), -1e6, "the range is inverted or NaN"},
        {SLOT(hi), NAN, "the range is inverted or NaN"},
        {SLOT(lo), -INFINITY, "a bound is infinite"},
        {SLOT(hi), INFINITY, "a bound is infinite"},
        {SLOT(rate), NAN, "a rate is negative, infinite or NaN"},
        {SLOT(rate) + 1, -1, "a rate is negative, infinite or NaN"},
        {SLOT(rate) + 2, INFINITY, "a rate is negative, infinite or NaN"},
    };
    for (size_t k = 0; k < sizeof sins / sizeof *sins; ++k) {
        const liar l = {FLIGHT, sins[k].slot, sins[k].value, IMP_OK};
        is_caught(&model_liar, &l, IMP_METHOD_MODELS, sins[k].what);
    }
}
END_TEST

START_TEST(rates_that_are_no_bounds_are_caught_under_both_methods)
{
    const double wrong[] = {NAN, -1, INFINITY, -INFINITY};
    for (size_t slot = 0; slot < 9; ++slot)
        for (int k = 0; k < 4; ++k) {
            const liar l = {FLIGHT, slot, wrong[k], IMP_OK};
            is_caught(&rate_liar, &l, IMP_METHOD_PAPER, "a rate is negative, infinite or NaN");
            is_caught(&rate_liar, &l, IMP_METHOD_MODELS, "");
        }
}
END_TEST

START_TEST(statuses_that_are_none_end_the_query)
{
    const struct {
        imp_status status;
        const char *what;
    } sins[] = {{IMP_INTERNAL, "reports an internal error"},
                {IMP_DOMAIN, "is undefined there"},
                {IMP_PARAMETER, "returned an unknown status"},
                {77, "returned an unknown status"},
                {-1, "returned an unknown status"}};
    for (size_t k = 0; k < sizeof sins / sizeof *sins; ++k) {
        const liar l = {FLIGHT, NONE, 0, sins[k].status};
        is_caught(&model_liar, &l, IMP_METHOD_MODELS, sins[k].what);
        is_caught(&rate_liar, &l, IMP_METHOD_MODELS, sins[k].what);
        is_caught(&rate_liar, &l, IMP_METHOD_PAPER, sins[k].what);
        is_caught(&point_liar, &l, IMP_METHOD_MODELS, sins[k].what);
    }
}
END_TEST

START_TEST(points_that_are_none_are_caught)
{
    const double wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t slot = 0; slot < 3; ++slot)
        for (int k = 0; k < 3; ++k) {
            const liar l = {FLIGHT, slot, wrong[k], IMP_OK};
            is_caught(&point_liar, &l, IMP_METHOD_MODELS, "infinite or NaN");
            is_caught(&point_liar, &l, IMP_METHOD_PAPER, "not a number");
        }
    for (size_t slot = 3; slot < 6; ++slot)
        for (int k = 0; k < 2; ++k) {
            const liar l = {FLIGHT, slot, k == 0 ? NAN : -1e-3, IMP_OK};
            is_caught(&point_liar, &l, IMP_METHOD_MODELS, "error bound is negative or NaN");
            is_caught(&point_liar, &l, IMP_METHOD_PAPER, "not a number");
        }
}
END_TEST

/* --- No bounds ---------------------------------------------------------------------------- */

/* A ball without bounds over every region that holds `at` in the parameters of the set. */
typedef struct gap {
    ball b;
    unsigned in; /* bit j: parameter j matters */
    double at[3];
} gap;

static bool holds(const gap *g, const imp_region *r)
{
    for (int j = 0; j < 3; ++j)
        if ((g->in >> j & 1) && !(r->lo[j] <= g->at[j] && g->at[j] <= r->hi[j])) return false;
    return true;
}

static imp_status gap_include(const void *self, const imp_region *region, imp_model model[3])
{
    if (!holds(self, region)) return ball_formula_include(self, region, model);
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        model[i] = (imp_model){.e = INFINITY, .lo = -INFINITY, .hi = INFINITY, .depends = 7};
        for (int j = 0; j < 3; ++j) model[i].rate[j] = INFINITY;
    }
    return IMP_UNBOUNDED;
}

static imp_status gap_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = ball_formula_rate(self, region, rates);
    if (!holds(self, region)) return status;
    for (int i = 0; i < 3; ++i) rates->m[i][0] = INFINITY;
    return IMP_UNBOUNDED;
}

/* Like a root at its branch point: infinitely steep in u, and within bounds all the same. */
static imp_status steep_include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = ball_formula_include(self, region, model);
    if (!holds(self, region)) return status;
    for (int i = 0; i < 3; ++i) model[i].rate[0] = INFINITY;
    return IMP_UNBOUNDED;
}

static const imp_surface_type gap_of_models = LIAR(ball_formula_eval, gap_rate, gap_include),
                              gap_of_rates = LIAR(ball_formula_eval, gap_rate, NULL),
                              steep = LIAR(ball_formula_eval, gap_rate, steep_include);

static imp_code ask_gap(const imp_surface_type *type, const gap *g, imp_method method,
                        imp_result *r, imp_error *error)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, type, &g->b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-3;
    options.method = method;
    options.max_bytes = (uint64_t)1 << 24;
    imp_query *query = imp_query_new(scene, &options, error);
    ck_assert_ptr_nonnull(query);
    const imp_code code = imp_query_step(query, 0, error);
    *r = imp_query_result(query);
    imp_query_free(query);
    imp_scene_free(scene);
    return code;
}

static imp_result answer(const imp_surface_type *type, const gap *g, imp_method method)
{
    imp_result r;
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(ask_gap(type, g, method, &r, &error) == IMP_SUCCESS, "%s", error.text);
    return r;
}

enum { U = 1, V = 2, T = 4 };

/* Never passed, soon found, and told by type and region. */
static void expect_told(const imp_surface_type *type, const gap *g, imp_method method, int which)
{
    imp_result r;
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = ask_gap(type, g, method, &r, &error);
    ck_assert_msg(code == IMP_ERROR_PLUGIN && r.verdict == IMP_UNDECIDED &&
                      r.t_lower <= (g->in & T ? 0.2 : 0) && r.stats.pairs < 20000,
                  "case %d: code %d, verdict %d, reason %d, t_lower %g, %llu pairs", which,
                  (int)code, (int)r.verdict, (int)r.reason, r.t_lower,
                  (unsigned long long)r.stats.pairs);
    ck_assert_msg(strstr(error.text, "type 'liar' over u [") != NULL &&
                      strstr(error.text, "however small") != NULL,
                  "%s", error.text);
}

START_TEST(a_place_without_bounds_at_any_size_is_told)
{
    const imp_surface_type *const types[] = {&gap_of_models, &gap_of_rates};
    const unsigned places[] = {U, V, U | V, U | V | T};
    for (int k = 0; k < 16; ++k) {
        const gap g = {FLIGHT, places[k / 4], {1, 0.3, 0.2}};
        expect_told(types[k / 2 % 2], &g, k % 2 ? IMP_METHOD_PAPER : IMP_METHOD_MODELS, k);
    }
}
END_TEST

START_TEST(a_moment_without_bounds_is_told_and_never_passed)
{
    const unsigned places[] = {T, U | T, V | T};
    for (int k = 0; k < 6; ++k) {
        const gap g = {FLIGHT, places[k / 2], {1, 0.3, 0.2}};
        expect_told(&gap_of_models, &g, k % 2 ? IMP_METHOD_PAPER : IMP_METHOD_MODELS, k);
    }
}
END_TEST

START_TEST(infinite_rates_do_not_matter_where_the_models_are_finite)
{
    const gap good = {FLIGHT, U, {-1, 0, 0}}, bad = {FLIGHT, U, {1, 0, 0}};
    const imp_result expected = answer(&steep, &good, IMP_METHOD_MODELS),
                     r = answer(&steep, &bad, IMP_METHOD_MODELS);
    ck_assert(r.verdict == IMP_CONTACT && r.gap <= r.gamma);
    ck_assert_double_le(fabs(r.t - expected.t), 1e-3);
    ck_assert_uint_lt(r.stats.pairs, 2 * expected.stats.pairs);
}
END_TEST

START_TEST(points_with_unknown_errors_are_no_witnesses)
{
    for (size_t slot = 3; slot < 6; ++slot) {
        const liar l = {FLIGHT, slot, INFINITY, IMP_OK};
        ck_assert_int_eq(error_of(&point_liar, &l, IMP_METHOD_MODELS).code, IMP_SUCCESS);
    }
}
END_TEST

SUITE_MAIN("faulty_types", models_that_are_no_bounds_are_caught,
           rates_that_are_no_bounds_are_caught_under_both_methods,
           statuses_that_are_none_end_the_query, points_that_are_none_are_caught,
           a_place_without_bounds_at_any_size_is_told,
           a_moment_without_bounds_is_told_and_never_passed,
           infinite_rates_do_not_matter_where_the_models_are_finite,
           points_with_unknown_errors_are_no_witnesses)
