/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <fenv.h>

#include "core/base/fp_mode.h"
#include "tests/support/compose.h"
#include "tests/support/sphere_scenes.h"

#include <impinge/baseline.h>

/* Types that break promises of the ABI: each ends the query with an error that names the type, the
 * region or point, and what is wrong. And types that have no bounds in places, as they may: a query
 * ends all the same. All are balls that behave until the search has come to small regions. */

/* A ball, and the number that it writes into its answers. */
typedef struct liar {
    ball b;      /* first: callbacks of balls see a ball */
    size_t slot; /* which number of the answer, as doubles from its start; NONE: none */
    double value;
    imp_status status; /* answered instead of IMP_STATUS_OK */
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
static imp_error error_of(const imp_surface_type *type, const liar *l, uint32_t baseline)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, type, &l->b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-3;
    options.baseline = baseline;
    options.max_pairs = 100000;
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    const imp_code code = imp_query_step(query, 0, &error);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(code, error.code);
    ck_assert_msg(r.verdict == IMP_VERDICT_UNDECIDED && r.t_lower <= 0.43,
                  "verdict %d, t_lower %g: %s", (int)r.verdict, r.t_lower, error.text);
    if (code != IMP_SUCCESS) /* for good */
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    imp_scene_free(scene);
    return error;
}

static void is_caught(const imp_surface_type *type, const liar *l, uint32_t baseline,
                      const char *what)
{
    const imp_error error = error_of(type, l, baseline);
    ck_assert_msg(error.code == IMP_ERROR_PLUGIN && strstr(error.text, what) != NULL,
                  "slot %zd, value %g, status %d: code %d, '%s', expected '%s'", (ssize_t)l->slot,
                  l->value, (int)l->status, (int)error.code, error.text, what);
    ck_assert_ptr_nonnull(strstr(error.text, "type 'liar'"));
    ck_assert_ptr_nonnull(strstr(error.text, "u "));
}

/* --- Models ----------------------------------------------------------------------------------- */

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
        const liar l = {FLIGHT, sins[k].slot, sins[k].value, IMP_STATUS_OK};
        is_caught(&model_liar, &l, IMP_BASELINE_NONE, sins[k].what);
    }
}
END_TEST

START_TEST(rates_that_are_no_bounds_are_caught_under_both_methods)
{
    const double wrong[] = {NAN, -1, INFINITY, -INFINITY};
    for (size_t slot = 0; slot < 9; ++slot)
        for (int k = 0; k < 4; ++k) {
            const liar l = {FLIGHT, slot, wrong[k], IMP_STATUS_OK};
            is_caught(&rate_liar, &l, IMP_BASELINE_BOXES, "a rate is negative, infinite or NaN");
            is_caught(&rate_liar, &l, IMP_BASELINE_NONE, "");
        }
}
END_TEST

START_TEST(statuses_that_are_none_end_the_query)
{
    const struct {
        imp_status status;
        const char *what;
    } sins[] = {{IMP_STATUS_INTERNAL, "reports an internal error"},
                {IMP_STATUS_DOMAIN, "is undefined there"},
                {IMP_STATUS_PARAMETER, "returned an unknown status"},
                {77, "returned an unknown status"},
                {-1, "returned an unknown status"}};
    for (size_t k = 0; k < sizeof sins / sizeof *sins; ++k) {
        const liar l = {FLIGHT, NONE, 0, sins[k].status};
        is_caught(&model_liar, &l, IMP_BASELINE_NONE, sins[k].what);
        is_caught(&rate_liar, &l, IMP_BASELINE_NONE, sins[k].what);
        is_caught(&rate_liar, &l, IMP_BASELINE_BOXES, sins[k].what);
        is_caught(&point_liar, &l, IMP_BASELINE_NONE, sins[k].what);
    }
}
END_TEST

START_TEST(points_that_are_none_are_caught)
{
    const double wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t slot = 0; slot < 3; ++slot)
        for (int k = 0; k < 3; ++k) {
            const liar l = {FLIGHT, slot, wrong[k], IMP_STATUS_OK};
            is_caught(&point_liar, &l, IMP_BASELINE_NONE, "infinite or NaN");
            is_caught(&point_liar, &l, IMP_BASELINE_BOXES, "not a number");
        }
    for (size_t slot = 3; slot < 6; ++slot)
        for (int k = 0; k < 2; ++k) {
            const liar l = {FLIGHT, slot, k == 0 ? NAN : -1e-3, IMP_STATUS_OK};
            is_caught(&point_liar, &l, IMP_BASELINE_NONE, "error bound is negative or NaN");
            is_caught(&point_liar, &l, IMP_BASELINE_BOXES, "not a number");
        }
}
END_TEST

/* --- The floating-point mode ------------------------------------------------------------------ */

static void round_upward(void) { fesetround(FE_UPWARD); }

/* Exceptions that trap: without a hand that puts the mode back at once, the host's next inexact sum
 * raises SIGFPE. */
static void let_exceptions_trap(void)
{
#if defined(__GLIBC__)
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
#endif
}

#if defined(__x86_64__)
static void set_x87(unsigned short word) { __asm__ volatile("fldcw %0" : : "m"(word)); }
static void x87_single(void) { set_x87(0x007F); }
static void x87_upward(void) { set_x87(0x0B7F); }

/* Leaves an exception pending, too, which the next x87 instruction would raise. */
static void x87_trapping(void)
{
    volatile long double third = 3;
    third = 1 / third;
    set_x87(0x0340);
}
#endif

static const struct {
    const char *name;
    void (*set)(void);
} modes[] = {
    {"upward", round_upward},       {"trapping", let_exceptions_trap},
#if defined(__x86_64__)
    {"x87 of 24 bits", x87_single}, {"x87 upward", x87_upward},
    {"x87 trapping", x87_trapping},
#endif
};
enum { MODES = sizeof modes / sizeof *modes };

/* A ball, or a map that is the identity, whose callback leaves a mode behind. */
typedef struct vandal {
    ball b;
    const char *callback;
    int mode;
} vandal;

static imp_status leave_mode(const void *self, const char *callback, imp_status status)
{
    const vandal *l = self;
    if (strcmp(l->callback, callback) == 0) modes[l->mode].set();
    return status;
}

static imp_status vandal_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    return leave_mode(self, "eval", ball_formula_eval(self, n, p, x, error));
}
static imp_status vandal_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return leave_mode(self, "rate", ball_formula_rate(self, region, rates));
}
static imp_status vandal_include(const void *self, const imp_region *region, imp_model model[3])
{
    return leave_mode(self, "include", ball_formula_include(self, region, model));
}
static const imp_surface_type vandal_type = {.name = "vandal",
                                             .flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES,
                                             .destroy = ball_destroy,
                                             .domain = ball_domain,
                                             .eval = vandal_eval,
                                             .rate = vandal_rate,
                                             .include = vandal_include};

static void third_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    (void)self, (void)t;
    out[0] = imp_scale(x, 1.0 / 3);
    out[1] = imp_scale(y, 1.0 / 3);
    out[2] = imp_scale(z, 1.0 / 3);
}
IMP_MAP_FORMULA(third_formula)

static imp_status map_vandal_eval(const void *self, size_t n, const double *p, double *x,
                                  double *error)
{
    return leave_mode(self, "eval", third_formula_eval(self, n, p, x, error));
}
static imp_status map_vandal_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    return leave_mode(self, "rate", third_formula_rate(self, box, rates));
}
static imp_status map_vandal_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    return leave_mode(self, "apply", third_formula_apply(self, in, out));
}
static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}
static const imp_map_type honest_map = {.name = "third",
                                        .destroy = ball_destroy,
                                        .time_domain = always,
                                        .eval = third_formula_eval,
                                        .rate = third_formula_rate,
                                        .apply = third_formula_apply},
                          vandal_map = {.name = "vandal",
                                        .destroy = ball_destroy,
                                        .time_domain = always,
                                        .eval = map_vandal_eval,
                                        .rate = map_vandal_rate,
                                        .apply = map_vandal_apply};

/* The vandal, as the ball or as the map, among honest parts: found, named, and its mode put
 * back. */
static void is_found(const vandal *l, bool as_map, uint32_t baseline)
{
    const ball still = {.radius = 1};
    imp_scene *scene = scene_new();
    ck_assert_ptr_nonnull(scene);
    ck_assert_int_eq(spheres_add(scene, &ball_type, &still), IMP_SUCCESS);
    ck_assert_int_eq(scene_add_body(scene, "two"), IMP_SUCCESS);
    surface *s = surface_new(as_map ? &ball_type : &vandal_type, (void *)(uintptr_t)&l->b);
    ck_assert_ptr_nonnull(s);
    ck_assert_int_eq(surface_add_map(s, &honest_map, (void *)(uintptr_t)l), IMP_SUCCESS);
    if (as_map)
        ck_assert_int_eq(surface_add_map(s, &vandal_map, (void *)(uintptr_t)l), IMP_SUCCESS);
    ck_assert_int_eq(surface_add_map(s, &honest_map, (void *)(uintptr_t)l), IMP_SUCCESS);
    ck_assert_int_eq(scene_add_surface(scene, 1, s), IMP_SUCCESS);
    imp_options options = imp_options_default(scene);
    options.baseline = baseline;
    options.max_pairs = 1000;
    const fp_mode before = fp_mode_read();
    char culprit[80];
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    const imp_code code = query != NULL ? imp_query_step(query, 0, &error) : error.code;
    snprintf(culprit, sizeof culprit, "(%s of 'vandal')", l->callback);
    ck_assert_msg(code == IMP_ERROR_PLUGIN && strstr(error.text, "floating-point mode") != NULL &&
                      strstr(error.text, culprit) != NULL,
                  "%s, %s of a %s: code %d, '%s'", modes[l->mode].name, l->callback,
                  as_map ? "map" : "ball", (int)code, error.text);
    ck_assert_msg(fp_mode_read() == before, "%s", modes[l->mode].name);
    imp_query_free(query);
    imp_scene_free(scene);
}

START_TEST(a_changed_mode_is_put_back_at_once_and_its_callback_named)
{
    static const char *const callbacks[] = {"eval", "rate", "include"};
    for (int mode = 0; mode < MODES; ++mode)
        for (int k = 0; k < 3; ++k) {
            const uint32_t baseline = k == 1 ? IMP_BASELINE_BOXES : IMP_BASELINE_NONE;
            vandal l = {FLIGHT, callbacks[k], mode};
            is_found(&l, false, baseline);
            if (k == 2) l.callback = "apply";
            is_found(&l, true, baseline);
        }
}
END_TEST

/* --- No bounds -------------------------------------------------------------------------------- */

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
    return IMP_STATUS_UNBOUNDED;
}

static imp_status gap_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = ball_formula_rate(self, region, rates);
    if (!holds(self, region)) return status;
    for (int i = 0; i < 3; ++i) rates->m[i][0] = INFINITY;
    return IMP_STATUS_UNBOUNDED;
}

/* Like a root at its branch point: infinitely steep in u, and within bounds all the same. */
static imp_status steep_include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = ball_formula_include(self, region, model);
    if (!holds(self, region)) return status;
    for (int i = 0; i < 3; ++i) model[i].rate[0] = INFINITY;
    return IMP_STATUS_UNBOUNDED;
}

static const imp_surface_type gap_of_models = LIAR(ball_formula_eval, gap_rate, gap_include),
                              gap_of_rates = LIAR(ball_formula_eval, gap_rate, NULL),
                              steep = LIAR(ball_formula_eval, gap_rate, steep_include);

static imp_code ask_gap(const imp_surface_type *type, const gap *g, uint32_t baseline,
                        imp_result *r, imp_error *error)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, type, &g->b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-3;
    options.baseline = baseline;
    options.max_bytes = (uint64_t)1 << 24;
    imp_query *query = imp_query_new(scene, &options, error);
    ck_assert_ptr_nonnull(query);
    const imp_code code = imp_query_step(query, 0, error);
    *r = imp_query_result(query);
    imp_query_free(query);
    imp_scene_free(scene);
    return code;
}

static imp_result answer(const imp_surface_type *type, const gap *g, uint32_t baseline)
{
    imp_result r;
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(ask_gap(type, g, baseline, &r, &error) == IMP_SUCCESS, "%s", error.text);
    return r;
}

enum { U = 1, V = 2, T = 4 };

/* Never passed, soon found, and told by type and region. */
static void expect_told(const imp_surface_type *type, const gap *g, uint32_t baseline, int which)
{
    imp_result r;
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = ask_gap(type, g, baseline, &r, &error);
    ck_assert_msg(code == IMP_ERROR_PLUGIN && r.verdict == IMP_VERDICT_UNDECIDED &&
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
        expect_told(types[k / 2 % 2], &g, k % 2 ? IMP_BASELINE_BOXES : IMP_BASELINE_NONE, k);
    }
}
END_TEST

START_TEST(a_moment_without_bounds_is_told_and_never_passed)
{
    const unsigned places[] = {T, U | T, V | T};
    for (int k = 0; k < 6; ++k) {
        const gap g = {FLIGHT, places[k / 2], {1, 0.3, 0.2}};
        expect_told(&gap_of_models, &g, k % 2 ? IMP_BASELINE_BOXES : IMP_BASELINE_NONE, k);
    }
}
END_TEST

START_TEST(infinite_rates_do_not_matter_where_the_models_are_finite)
{
    const gap good = {FLIGHT, U, {-1, 0, 0}}, bad = {FLIGHT, U, {1, 0, 0}};
    const imp_result expected = answer(&steep, &good, IMP_BASELINE_NONE),
                     r = answer(&steep, &bad, IMP_BASELINE_NONE);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.gap <= r.gamma);
    ck_assert_double_le(fabs(r.t - expected.t), 1e-3);
    ck_assert_uint_lt(r.stats.pairs, 2 * expected.stats.pairs);
}
END_TEST

START_TEST(points_with_unknown_errors_are_no_witnesses)
{
    for (size_t slot = 3; slot < 6; ++slot) {
        const liar l = {FLIGHT, slot, INFINITY, IMP_STATUS_OK};
        ck_assert_int_eq(error_of(&point_liar, &l, IMP_BASELINE_NONE).code, IMP_SUCCESS);
    }
}
END_TEST

SUITE_MAIN("faulty_types", models_that_are_no_bounds_are_caught,
           rates_that_are_no_bounds_are_caught_under_both_methods,
           statuses_that_are_none_end_the_query, points_that_are_none_are_caught,
           a_changed_mode_is_put_back_at_once_and_its_callback_named,
           a_place_without_bounds_at_any_size_is_told,
           a_moment_without_bounds_is_told_and_never_passed,
           infinite_rates_do_not_matter_where_the_models_are_finite,
           points_with_unknown_errors_are_no_witnesses)
