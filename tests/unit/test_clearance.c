/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_variants.h"

#include <impinge/baseline.h>

/* Minimum distances: closed forms, points sampled, and what the search for contact says. */

/* --- Asking ----------------------------------------------------------------------------------- */

static imp_clearance read_answer(const imp_query *query, size_t index)
{
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    ck_assert_int_eq(imp_clearance_get(query, index, &answer, NULL), IMP_SUCCESS);
    return answer;
}

static void check_point(const imp_scene *scene, const imp_side *side, double t)
{
    const double p[3] = {side->u, side->v, t};
    double x[3], inexact[3];
    ck_assert_int_eq(imp_scene_eval(scene, side->body, side->surface, 1, p, x, inexact, NULL),
                     IMP_SUCCESS);
    ck_assert_double_eq(query_distance(x, side->point), 0);
}

/* What every answer promises by itself. */
static void check_answer_itself(const imp_scene *scene, const imp_clearance *a, double tolerance,
                                double gamma)
{
    ck_assert(a->lower >= 0 && a->lower <= a->upper);
    if (a->reason == IMP_REASON_NONE)
        ck_assert(a->upper - a->lower <= tolerance * a->upper || a->upper <= gamma);
    if (a->reason == IMP_REASON_DECIDED)
        ck_assert(a->has_witness &&
                  a->verdict == (a->lower >= a->required * (1 - 1e-6) ? IMP_REQUIREMENT_HOLDS
                                                                      : IMP_REQUIREMENT_VIOLATED));
    if (!a->has_witness) return;
    ck_assert(a->t >= a->t_start && a->t <= a->t_end && a->a.body < a->b.body);
    check_point(scene, &a->a, a->t);
    check_point(scene, &a->b, a->t);
    ck_assert_double_le(query_distance(a->a.point, a->b.point), a->upper * (1 + 1e-15));
    if (isnan(a->t_violated)) return;
    ck_assert(a->t_violated >= a->t_start && a->t_violated <= a->t_end);
    check_point(scene, &a->a_violated, a->t_violated);
    check_point(scene, &a->b_violated, a->t_violated);
    ck_assert(a->gap_violated <= a->required);
}

static imp_query *begin(imp_scene *scene, const imp_options *options,
                        const imp_clearance_options *asked)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_clearance_new(scene, options, asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static imp_reason step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_query_step(query, pairs, &error) == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query).reason;
}

/* The first answer, checked. */
static imp_clearance measure(imp_scene *scene, const imp_options *options,
                             const imp_clearance_options *asked)
{
    imp_query *query = begin(scene, options, asked);
    step(query, 0);
    const imp_clearance answer = read_answer(query, 0);
    check_answer_itself(scene, &answer, asked->tolerance, options->gamma);
    imp_query_free(query);
    return answer;
}

static imp_scene *scene_of(imp_registry *registry, const char *a, const char *b)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static imp_clearance measure_pair(imp_registry *registry, const char *a, const char *b,
                                  double tolerance, double required)
{
    imp_scene *scene = scene_of(registry, a, b);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = tolerance;
    asked.required = required;
    const imp_clearance answer = measure(scene, &options, &asked);
    imp_scene_free(scene);
    return answer;
}

/* --- Closed forms ----------------------------------------------------------------------------- */

typedef struct closed_form {
    const char *a, *b;
    double distance, t; /* t < 0: at any time */
    double finest;      /* tolerance */
} closed_form;

static const closed_form closed_forms[] = {
    {"sphere", "sphere radius=0.5 center=3,4,0", 3.5, -1, 1e-9},
    {"sphere", "sphere radius=0.5 center=-3,2,0 ! translate velocity=6,0,0", 0.5, 0.5, 1e-9},
    {"sphere", "sphere radius=0.5 center=3,0,0 ! translate velocity=-1,0,0", 0.5, 1, 1e-9},
    {"sphere", "sphere radius=0.5 center=1.75,0,0 ! translate velocity=1,0,0", 0.25, 0, 1e-9},
    {"sphere radius=2", "sphere radius=0.25 center=0.5,0,0", 1.25, -1, 1e-9},
    {"sphere radius=0.5 center=0,0,-3 ! translate velocity=0,0,6", /* least along a circle */
     "torus major_radius=1 minor_radius=0.25", 0.25, 0.5, 1e-3},
    {"plane origin=-2,-2,0 edge_u=4,0,0 edge_v=0,4,0",
     "sphere radius=0.5 center=0.3,0.1,2 ! translate offset=[[0,0,0],[0,0,-4],[0,0,4]]", 0.5, 0.5,
     1e-9},
    {"segment points=[[-1,0,0],[1,0,0]]", "segment points=[[0,-1,0.125],[0,1,0.125]]", 0.125, -1,
     1e-9},
    {"point position=0,0,2", "cylinder radius=0.5 height=6", 0.5, -1, 1e-6},
    /* along areas: a shaft in its bore, one off its axis, a piston, a ball in its socket and one in
     * a race */
    {"cylinder radius=0.99 ! rotate rate=3", "cylinder", 0.01, -1, 1e-2},
    {"cylinder radius=0.98 center=0.01,0,0 ! rotate rate=3", "cylinder", 0.01, -1, 1e-4},
    {"cylinder radius=0.99 height=1 ! translate velocity=0,0,0.5",
     "cylinder height=4 center=3,0,0 ! translate offset=[[-3,0,0]]", 0.01, -1, 1e-6},
    {"sphere radius=0.75 center=0.03125,0,0 ! rotate axis=1,2,3 rate=2", "sphere", 0.21875, -1,
     1e-2},
    {"sphere radius=0.125 center=1,0,0 ! rotate rate=1", "torus", 0.125, -1, 1e-2},
    {"point position=3,0,0 ! rotate axis=0,0,1 rate=1.5707963267948966", "point position=0,4,0", 1,
     1, 1e-9},
};

static void check_closed_form(imp_registry *registry, const closed_form *c, double tolerance)
{
    const imp_clearance r = measure_pair(registry, c->a, c->b, tolerance, 0);
    ck_assert_msg(r.reason == IMP_REASON_NONE && r.verdict == IMP_REQUIREMENT_NONE &&
                      r.lower <= c->distance * (1 + 1e-15) && c->distance * (1 - 1e-15) <= r.upper,
                  "%s | %s: [%.17g, %.17g], reason %d", c->a, c->b, r.lower, r.upper,
                  (int)r.reason);
    /* the gap may grow like the square of the time from the least */
    if (c->t >= 0) ck_assert_double_le(fabs(r.t - c->t), sqrt(tolerance));
}

START_TEST(closed_forms_lie_within_the_bracket)
{
    imp_registry *registry = query_registry();
    for (size_t k = 0; k < sizeof closed_forms / sizeof *closed_forms; ++k) {
        check_closed_form(registry, &closed_forms[k], 1e-3);
        check_closed_form(registry, &closed_forms[k], closed_forms[k].finest);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(what_meets_is_no_farther_apart_than_gamma)
{
    imp_registry *registry = query_registry();
    const char *const other[] = {"sphere center=3,0,0 ! translate velocity=-2,0,0",
                                 "torus major_radius=1 minor_radius=0.3",
                                 ("plane origin=-2,-2,-3 edge_u=4,0,0 edge_v=0,4,0 ! translate "
                                  "velocity=0,0,4")};
    for (int k = 0; k < 3; ++k) {
        const imp_clearance r = measure_pair(registry, "sphere", other[k], 1e-3, 0);
        ck_assert(r.reason == IMP_REASON_NONE && r.lower <= r.upper && r.upper <= 1e-6);
    }
    imp_registry_free(registry);
}
END_TEST

/* --- Points sampled, and contact -------------------------------------------------------------- */

enum { SIDE = 10, TIMES = 7 };

static void sample_surface(const imp_scene *scene, size_t body, double t, double x[][3])
{
    double lo[3], hi[3], p[SIDE * SIDE][3];
    imp_scene_domain(scene, body, 0, lo, hi);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        p[k][0] = lo[0] + (hi[0] - lo[0]) * (k / SIDE) / (SIDE - 1);
        p[k][1] = lo[1] + (hi[1] - lo[1]) * (k % SIDE) / (SIDE - 1);
        p[k][2] = t;
    }
    ck_assert_int_eq(imp_scene_eval(scene, body, 0, SIDE * SIDE, p[0], x[0], NULL, NULL),
                     IMP_SUCCESS);
}

static double sampled_distance(const imp_scene *scene, double t_start, double t_end)
{
    double least = INFINITY, x[2][SIDE * SIDE][3];
    for (int n = 0; n < TIMES; ++n) {
        const double share = (double)n / (TIMES - 1);
        for (size_t body = 0; body < 2; ++body)
            sample_surface(scene, body, (1 - share) * t_start + share * t_end, x[body]);
        for (int k = 0; k < SIDE * SIDE; ++k)
            for (int l = 0; l < SIDE * SIDE; ++l)
                least = fmin(least, query_distance(x[0][k], x[1][l]));
    }
    return least;
}

/* The scene until shortly before its bodies meet. */
static imp_options before_contact(const imp_scene *scene, const ladder *l)
{
    imp_options options = imp_options_default(scene);
    options.gamma = rung_gamma(l->about, &plain, 2);
    if (l->rung[1].verdict == IMP_VERDICT_CONTACT) options.t_end = 0.9 * l->rung[0].t_lower;
    return options;
}

/* No sample is nearer than lower, and upper is not much above the nearest. */
static void compare_with_samples(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    const imp_options options = before_contact(scene, l);
    imp_clearance_options asked = imp_clearance_options_default();
    for (asked.tolerance = 0.25; asked.tolerance > 1e-5; asked.tolerance *= 0.125) {
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert_int_eq(r.reason, IMP_REASON_NONE);
        const double sampled = sampled_distance(scene, options.t_start, options.t_end);
        ck_assert_msg(r.lower <= sampled && r.upper * (1 - asked.tolerance) <= sampled,
                      "%s: [%g, %g], a sample at %g", l->about->name, r.lower, r.upper, sampled);
    }
    imp_scene_free(scene);
}

START_TEST(no_sample_is_nearer_than_the_lower_bound) { for_each_setting(compare_with_samples); }
END_TEST

/* Clear at 0.99 of what was found, contact at 1.01. */
static void compare_with_contact(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    imp_options options = before_contact(scene, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance r = measure(scene, &options, &asked);
    imp_result contact = {.struct_size = sizeof contact};
    options.gamma = 0.995 * r.lower;
    options.gamma_clear = 0.99 * r.lower;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &contact, NULL), IMP_SUCCESS);
    ck_assert_int_eq(contact.verdict, IMP_VERDICT_CLEAR);
    options.gamma = 1.01 * r.upper;
    options.gamma_clear = 1.005 * r.upper;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &contact, NULL), IMP_SUCCESS);
    ck_assert_int_eq(contact.verdict, IMP_VERDICT_CONTACT);
    ck_assert(contact.t <= r.t);
    imp_scene_free(scene);
}

START_TEST(contact_at_other_distances_agrees) { for_each_setting(compare_with_contact); }
END_TEST

/* --- Something is required -------------------------------------------------------------------- */

/* Centres (3 - 6 t, 2): the gap is sqrt((3 - 6 t)^2 + 4) - 1.5, at least 0.5. */
static const char *const still = "sphere",
                         *passing = "sphere radius=0.5 center=-3,2,0 ! translate velocity=6,0,0";

START_TEST(a_distance_that_is_kept_holds)
{
    imp_registry *registry = query_registry();
    const double kept[] = {1e-9, 0.1, 0.4999, 0.5 * (1 - 1e-7)};
    for (int k = 0; k < 4; ++k) {
        const imp_clearance r = measure_pair(registry, still, passing, 1e-3, kept[k]);
        ck_assert_msg(r.verdict == IMP_REQUIREMENT_HOLDS && isnan(r.t_violated) &&
                          r.lower >= kept[k] * (1 - 1e-6),
                      "%.17g: verdict %d, [%g, %g]", kept[k], (int)r.verdict, r.lower, r.upper);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_violation_is_the_earliest)
{
    imp_registry *registry = query_registry();
    const double required[] = {0.5001, 0.6, 1, 1.5};
    for (int k = 0; k < 4; ++k) {
        const double d = required[k];
        const imp_clearance r = measure_pair(registry, still, passing, 1e-3, d);
        const double t = (3 - sqrt((d + 1.5) * (d + 1.5) - 4)) / 6;
        ck_assert_int_eq(r.verdict, IMP_REQUIREMENT_VIOLATED);
        ck_assert_msg(r.t_violated <= t + 1e-4 && r.t_violated >= t - 1e-12,
                      "%g: at %.17g, not %.17g", d, r.t_violated, t);
        ck_assert(r.gap_violated > d * (1 - 1e-3) && r.upper - r.lower <= 1e-3 * r.upper);
    }
    imp_registry_free(registry);
}
END_TEST

/* Asks one question with and without a bracket as narrow as the tolerance. */
static void decide(imp_scene *scene, const imp_options *options, double required,
                   imp_clearance *narrow, imp_clearance *decided)
{
    imp_clearance_options asked = imp_clearance_options_default();
    ck_assert(!asked.decide);
    asked.required = required;
    *narrow = measure(scene, options, &asked);
    asked.decide = true;
    *decided = measure(scene, options, &asked);
}

START_TEST(in_the_band_both_answers_are_right)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    for (int k = 0; k <= 10; ++k) {
        const double d = 0.5 * (1 + 1e-7 * k);
        imp_clearance r[2];
        decide(scene, &options, d, &r[0], &r[1]);
        for (int n = 0; n < 2; ++n)
            if (r[n].verdict == IMP_REQUIREMENT_VIOLATED)
                ck_assert(r[n].upper <= d && r[n].t_violated <= r[n].t);
            else
                ck_assert(r[n].verdict == IMP_REQUIREMENT_HOLDS && r[n].lower >= d * (1 - 1e-6) &&
                          r[n].lower <= 0.5);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(contact_violates_what_is_smaller_than_gamma)
{
    imp_registry *registry = query_registry();
    const imp_clearance r = measure_pair(
        registry, "sphere", "sphere center=3,0,0 ! translate velocity=-2,0,0", 1e-3, 1e-7);
    ck_assert(r.verdict == IMP_REQUIREMENT_VIOLATED && r.upper <= 1e-7);
    ck_assert_double_le(fabs(r.t_violated - 0.5), 1e-6);
    imp_registry_free(registry);
}
END_TEST

/* --- The search ends as soon as it is decided ------------------------------------------------- */

START_TEST(what_is_decided_is_what_a_narrow_bracket_decides)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    const double required[] = {1e-9, 0.1, 0.25, 0.45, 0.4999, 0.5001, 0.6, 1, 1.5, 3};
    for (int k = 0; k < 10; ++k) {
        const double d = required[k];
        imp_clearance narrow, decided;
        decide(scene, &options, d, &narrow, &decided);
        ck_assert_int_eq(decided.verdict,
                         d < 0.5 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_VIOLATED);
        ck_assert_int_eq(narrow.verdict, decided.verdict);
        ck_assert(decided.lower <= 0.5 && decided.upper >= 0.5 * (1 - 1e-15));
        if (d < 0.5)
            ck_assert(decided.lower >= d * (1 - 1e-6) && isnan(decided.t_violated));
        else
            ck_assert(decided.upper <= d && decided.t_violated == narrow.t_violated);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* Close to what the scene keeps: decided the same way, by as many pairs, about. */
static void decide_beside(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    const imp_options options = before_contact(scene, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(scene, &options, &asked);
    const double part[] = {0.5, 0.9, 0.99, 1.01, 1.1, 2};
    for (int k = 0; k < 6; ++k) {
        imp_clearance narrow, decided;
        const double required = part[k] * (part[k] < 1 ? known.lower : known.upper);
        decide(scene, &options, required, &narrow, &decided);
        ck_assert_msg(decided.verdict == narrow.verdict &&
                          narrow.verdict ==
                              (part[k] < 1 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_VIOLATED),
                      "%s: %g", l->about->name, required);
        ck_assert(decided.lower <= known.upper && decided.upper >= known.lower);
        ck_assert_uint_le(decided.stats.pairs, 2 * narrow.stats.pairs + 64);
    }
    imp_scene_free(scene);
}

START_TEST(every_shape_is_decided_the_same_way) { for_each_setting(decide_beside); }
END_TEST

/* Where surfaces slide close to what is required the earliest time takes long, the verdict does
 * not. */
START_TEST(a_budget_that_a_narrow_bracket_fits_in_is_enough_to_decide)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, "cylinder radius=1 height=2 ! translate velocity=0,0,0.5",
                                "cylinder radius=1.01 height=2 ! taper start=1 end=[1,-0.0003]");
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(scene, &options, &asked);
    options.max_pairs = 20000;
    ck_assert_uint_lt(known.stats.pairs, options.max_pairs / 4);
    asked.decide = true;
    asked.required = 1.0001 * known.upper;
    const imp_clearance decided = measure(scene, &options, &asked);
    ck_assert_int_eq(decided.verdict, IMP_REQUIREMENT_VIOLATED);
    ck_assert_double_le(decided.upper, asked.required);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* A millionth of it is less than double precision tells apart: no earliest time, but the same
 * verdict. */
START_TEST(contact_decides_what_is_too_small_to_be_timed)
{
    static const char through[] = "sphere center=3,0,0 ! translate velocity=-4,0,0";
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, "sphere", through);
    const imp_options options = imp_options_default(scene);
    const double required[] = {1e-8, 1e-9, 1e-12};
    for (int k = 0; k < 3; ++k) {
        imp_clearance narrow, decided;
        decide(scene, &options, required[k], &narrow, &decided);
        ck_assert(narrow.verdict == IMP_REQUIREMENT_VIOLATED && isnan(narrow.t_violated));
        ck_assert(decided.verdict == IMP_REQUIREMENT_VIOLATED && isnan(decided.t_violated));
        ck_assert(decided.reason == IMP_REASON_RESOLUTION && decided.upper <= required[k]);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(programs_that_know_nothing_of_deciding_get_a_narrow_bracket)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.struct_size = (uint32_t)offsetof(imp_clearance_options, decide);
    asked.required = 0.1;
    asked.decide = true; /* beyond its size */
    const imp_clearance r = measure(scene, &options, &asked);
    ck_assert(r.reason == IMP_REASON_NONE && r.verdict == IMP_REQUIREMENT_HOLDS);
    asked.decide = false;
    ck_assert_int_eq(imp_clearance_options_get_default(&asked, NULL), IMP_SUCCESS);
    ck_assert(asked.required == 0 && !asked.decide);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* --- Slices, and each pair of bodies ---------------------------------------------------------- */

/* --- What was asked before -------------------------------------------------------------------- */

enum { TEXT = 4000 };

/* Nine vectors near (x, y, z), x and y 0, `spread` or twice that. */
static size_t add_vectors(uint64_t *state, char *text, double spread, double z, double by)
{
    size_t used = 0;
    for (int k = 0; k < 9; ++k)
        used += (size_t)snprintf(
            text + used, TEXT / 2 - used, "%s[%.3f,%.3f,%.3f]", k > 0 ? "," : "",
            spread * (k / 3) + random_between(state, -by, by),
            spread * (k % 3) + random_between(state, -by, by), z + random_between(state, -by, by));
    return used;
}

/* A patch of degrees 2 and 2 that bends and deforms. */
static void draw_deforming(uint64_t *state, double z, char text[TEXT])
{
    size_t used = (size_t)snprintf(text, TEXT, "bezier degree=2,2 points=[");
    used += add_vectors(state, text + used, 0.75, z, 0.3);
    used += (size_t)snprintf(text + used, TEXT - used, "] velocities=[");
    used += add_vectors(state, text + used, 0, 0, 2);
    snprintf(text + used, TEXT - used, "]");
}

/* A search for contact makes nets, which a minimum distance does not ask for. */
START_TEST(nets_that_others_made_change_no_minimum_distance)
{
    imp_registry *registry = query_registry();
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(100); ++k) {
        char a[TEXT], b[TEXT];
        imp_result met = {.struct_size = sizeof met};
        draw_deforming(&state, 0, a);
        draw_deforming(&state, 2.5, b);
        imp_scene *scene = scene_of(registry, a, b);
        const imp_options options = imp_options_default(scene);
        ck_assert_int_eq(imp_scene_solve(scene, &options, &met, NULL), IMP_SUCCESS);
        const imp_clearance_options asked = imp_clearance_options_default();
        const imp_clearance after = measure(scene, &options, &asked);
        const imp_clearance alone = measure_pair(registry, a, b, asked.tolerance, 0);
        ck_assert_uint_eq(after.stats.pairs, alone.stats.pairs);
        ck_assert_double_eq(after.lower, alone.lower);
        ck_assert_double_eq(after.upper, alone.upper);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(slices_have_brackets_of_their_own)
{
    enum { SLICES = 12 };
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = SLICES;
    asked.required = 1;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_uint_eq(imp_clearance_count(query), SLICES);
    while (step(query, 10) == IMP_REASON_RUNNING) {
    }
    for (size_t k = 0; k < SLICES; ++k) {
        const imp_clearance r = read_answer(query, k);
        check_answer_itself(scene, &r, asked.tolerance, options.gamma);
        ck_assert(r.t_start == (k == 0 ? 0 : read_answer(query, k - 1).t_end));
        const double t = r.t_end <= 0.5 ? r.t_end : r.t_start;
        const double x = 3 - 6 * t, d = sqrt(x * x + 4) - 1.5;
        ck_assert_msg(r.lower <= d * (1 + 1e-15) && r.upper >= d * (1 - 1e-15) &&
                          r.upper <= r.lower / (1 - 1e-3) * (1 + 1e-15),
                      "slice %zu: [%g, %g], not %g", k, r.lower, r.upper, d);
        ck_assert(isnan(r.t_violated));
        ck_assert_int_eq(r.verdict, d < 1 ? IMP_REQUIREMENT_VIOLATED : IMP_REQUIREMENT_HOLDS);
    }
    ck_assert(read_answer(query, SLICES - 1).t_end == 1);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

static const char three_bodies[] =
    "{\"bodies\":["
    "{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]},"
    "{\"name\":\"b\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[3,0,0]},"
    "{\"type\":\"sphere\",\"center\":[0,5,0]}]},"
    "{\"name\":\"c\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[8,0,0]}],"
    "\"maps\":[{\"type\":\"translate\",\"velocity\":[-2,0,0]}]},"
    "{\"name\":\"d\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[0,0,0.5]}]}],"
    "\"ignore\":[[\"a\",\"d\"]]}";

static imp_scene *scene_of_three(imp_registry *registry)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene =
        imp_scene_from_json(registry, three_bodies, sizeof three_bodies - 1, "three", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

START_TEST(each_two_bodies_have_a_bracket_of_their_own)
{
    const double distance[] = {1, 4, 1, sqrt(9.25) - 2, sqrt(36.25) - 2};
    const size_t body[][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of_three(registry);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.each = true;
    asked.slices = 2;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_uint_eq(imp_clearance_count(query), 10);
    for (size_t k = 0; k < 10; ++k) {
        const imp_clearance r = read_answer(query, k);
        check_answer_itself(scene, &r, asked.tolerance, options.gamma);
        ck_assert(r.body[0] == body[k / 2][0] && r.body[1] == body[k / 2][1]);
        ck_assert(r.a.body == r.body[0] && r.b.body == r.body[1]);
        if (k % 2 == 0) continue;
        ck_assert(r.lower <= distance[k / 2] * (1 + 1e-15) &&
                  r.upper >= distance[k / 2] * (1 - 1e-15));
    }
    asked = imp_clearance_options_default();
    const imp_clearance all = measure(scene, &options, &asked);
    ck_assert(all.body[0] == SIZE_MAX && all.lower <= 1 && all.upper >= 1);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(where_nobody_meets_anybody_the_distance_is_infinite)
{
    imp_registry *registry = query_registry();
    const char one[] = "{\"bodies\":[{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]}]}";
    const char ignored[] =
        "{\"bodies\":[{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]},{\"name\":\"b\","
        "\"surfaces\":[{\"type\":\"sphere\"}]}],\"ignore\":[[\"a\",\"b\"]]}";
    const char *const text[] = {one, ignored};
    for (int k = 0; k < 2; ++k) {
        imp_scene *scene = imp_scene_from_json(registry, text[k], strlen(text[k]), "one", NULL);
        const imp_options options = imp_options_default(scene);
        imp_clearance_options asked = imp_clearance_options_default();
        asked.required = 2;
        asked.decide = k == 1;
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert(r.lower == INFINITY && r.upper == INFINITY && !r.has_witness);
        ck_assert(r.reason == IMP_REASON_NO_PAIRS && r.verdict == IMP_REQUIREMENT_HOLDS);
        asked.each = true;
        imp_query *query = begin(scene, &options, &asked);
        ck_assert(step(query, 0) == IMP_REASON_NONE && imp_clearance_count(query) == 0);
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

/* --- Steps and budgets ------------------------------------------------------------------------ */

static void check_same(const imp_clearance *x, const imp_clearance *y)
{
    ck_assert(x->reason == y->reason && x->lower == y->lower && x->upper == y->upper &&
              x->t == y->t && x->a.u == y->a.u && x->b.v == y->b.v);
    ck_assert_uint_eq(x->stats.pairs, y->stats.pairs);
    ck_assert_uint_eq(x->stats.witness_searches, y->stats.witness_searches);
}

/* Whatever the steps, the bracket narrows to the same bits. */
static void step_any_size(imp_registry *registry, const ladder *l)
{
    imp_scene *whole = scene_told(registry, l->about);
    const imp_options options = before_contact(whole, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(whole, &options, &asked);
    const uint64_t sizes[] = {1, 7, 64};
    for (int k = 0; k < 3; ++k) {
        imp_scene *scene = scene_told(registry, l->about);
        imp_query *query = begin(scene, &options, &asked);
        imp_clearance now = read_answer(query, 0);
        ck_assert(now.lower == 0 && now.upper == INFINITY && now.reason == IMP_REASON_RUNNING);
        while (now.reason == IMP_REASON_RUNNING) {
            const imp_clearance before = now;
            step(query, sizes[k]);
            now = read_answer(query, 0);
            check_answer_itself(scene, &now, asked.tolerance, options.gamma);
            ck_assert(now.upper <= before.upper && now.lower <= known.upper &&
                      now.upper >= known.lower);
        }
        check_same(&now, &known);
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_scene_free(whole);
}

START_TEST(steps_of_any_size_lead_to_the_same_bits) { for_each_setting(step_any_size); }
END_TEST

START_TEST(a_budget_that_ends_leaves_a_true_bracket)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_clearance_options asked = imp_clearance_options_default();
    int ended = 0;
    for (uint64_t pairs = 1; pairs < 40; ++pairs) {
        imp_options options = imp_options_default(scene);
        options.max_pairs = pairs;
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert(r.lower <= 0.5 && r.upper >= 0.5 * (1 - 1e-15));
        ck_assert(r.reason == IMP_REASON_PAIRS || r.reason == IMP_REASON_NONE);
        ended += r.reason == IMP_REASON_PAIRS;
    }
    ck_assert(ended > 0 && ended < 39);
    imp_options options = imp_options_default(scene);
    options.max_seconds = 1e-9;
    ck_assert_int_eq(measure(scene, &options, &asked).reason, IMP_REASON_SECONDS);
    options = imp_options_default(scene);
    options.max_bytes = 1;
    ck_assert_int_eq(measure(scene, &options, &asked).reason, IMP_REASON_MEMORY);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

static bool never_on(void *context, const imp_progress *progress)
{
    imp_progress *kept = context;
    *kept = *progress;
    return false;
}

START_TEST(cancelled_or_ended_by_progress_it_goes_on_when_asked)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_options options = imp_options_default(scene);
    imp_query *query = begin(scene, &options, &asked);
    imp_query_cancel(query);
    ck_assert_int_eq(step(query, 0), IMP_REASON_CANCELLED);
    ck_assert_int_eq(read_answer(query, 0).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    const imp_clearance done = read_answer(query, 0);
    imp_query_free(query);
    imp_progress progress = {.reason = IMP_REASON_NONE};
    options.progress = never_on;
    options.progress_context = &progress;
    query = begin(scene, &options, &asked);
    ck_assert_int_eq(step(query, 0), IMP_REASON_CANCELLED);
    ck_assert(progress.reason == IMP_REASON_RUNNING && isnan(progress.t_lower));
    while (step(query, 0) != IMP_REASON_NONE) {
    }
    const imp_clearance again = read_answer(query, 0);
    ck_assert(again.lower == done.lower && again.upper == done.upper);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* Bodies a and b, b and c, and b and d come as near as 1, 1 and sqrt(9.25) - 2, which is
 * 1.04. */
START_TEST(what_never_comes_within_a_distance_is_not_measured)
{
    const size_t body[][2] = {{0, 1}, {1, 2}, {1, 3}};
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of_three(registry);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.each = true;
    asked.within = 1.5;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_uint_eq(imp_clearance_count(query), 0);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_uint_eq(imp_clearance_count(query), 3);
    for (size_t k = 0; k < 3; ++k) {
        const imp_clearance r = read_answer(query, k);
        ck_assert(r.body[0] == body[k][0] && r.body[1] == body[k][1]);
        ck_assert(r.reason == IMP_REASON_NONE && r.lower > 0.999 && r.upper < 1.05);
    }
    imp_query_free(query);
    asked.each = false;
    const double within[] = {0.5, 0.9999, 1.0001, 9};
    for (int k = 0; k < 4; ++k) {
        asked.within = within[k];
        asked.required = asked.within < 1 ? within[k] : 0;
        query = begin(scene, &options, &asked);
        step(query, 0);
        const imp_clearance r = read_answer(query, 0);
        ck_assert_int_eq(r.reason, within[k] < 1 ? IMP_REASON_DECIDED : IMP_REASON_NONE);
        ck_assert(within[k] < 1 ? r.lower == within[k] : r.lower > 0.999 && r.lower <= 1);
        if (within[k] < 1) ck_assert_int_eq(r.verdict, IMP_REQUIREMENT_HOLDS);
        imp_query_free(query);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* --- What cannot be asked --------------------------------------------------------------------- */

START_TEST(wrong_questions_are_refused_by_name)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const struct {
        double tolerance, required;
        uint64_t slices;
        const char *name;
        double within;
    } wrong[] = {{0, 0, 1, "tolerance", 0},       {1e-10, 0, 1, "tolerance", 0},
                 {1, 0, 1, "tolerance", 0},       {NAN, 0, 1, "tolerance", 0},
                 {1e-3, -1, 1, "required", 0},    {1e-3, INFINITY, 1, "required", 0},
                 {1e-3, NAN, 1, "required", 0},   {1e-3, 0, 0, "slices", 0},
                 {1e-3, 0, 1000001, "slices", 0}, {1e-3, 0, 1, "within", -1},
                 {1e-3, 0, 1, "within", NAN},     {1e-3, 0, 1, "within", INFINITY},
                 {1e-3, 2, 1, "within", 1}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        imp_clearance_options asked = imp_clearance_options_default();
        imp_options options = imp_options_default(scene);
        imp_error error = {IMP_SUCCESS, ""};
        asked.tolerance = wrong[k].tolerance;
        asked.required = wrong[k].required;
        asked.slices = wrong[k].slices;
        asked.within = wrong[k].within;
        ck_assert_ptr_null(imp_clearance_new(scene, &options, &asked, &error));
        ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, wrong[k].name));
    }
    imp_options options = imp_options_default(scene);
    options.baseline = IMP_BASELINE_BOXES;
    ck_assert_ptr_null(imp_clearance_new(scene, &options, NULL, NULL));
    options = imp_options_default(scene);
    imp_query *query = begin(scene, &options, NULL);
    imp_clearance answer = {.struct_size = 4};
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_ERROR_USAGE);
    answer.struct_size = (uint32_t)sizeof answer;
    ck_assert_int_eq(imp_clearance_get(query, 1, &answer, NULL), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_query_refine(query, 1e-9, -1, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    query = imp_query_new(scene, &options, NULL);
    ck_assert_uint_eq(imp_clearance_count(query), 0);
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("clearance", closed_forms_lie_within_the_bracket,
           what_meets_is_no_farther_apart_than_gamma, no_sample_is_nearer_than_the_lower_bound,
           contact_at_other_distances_agrees, a_distance_that_is_kept_holds,
           a_violation_is_the_earliest, in_the_band_both_answers_are_right,
           contact_violates_what_is_smaller_than_gamma,
           what_is_decided_is_what_a_narrow_bracket_decides, every_shape_is_decided_the_same_way,
           a_budget_that_a_narrow_bracket_fits_in_is_enough_to_decide,
           contact_decides_what_is_too_small_to_be_timed,
           programs_that_know_nothing_of_deciding_get_a_narrow_bracket,
           nets_that_others_made_change_no_minimum_distance, slices_have_brackets_of_their_own,
           each_two_bodies_have_a_bracket_of_their_own,
           where_nobody_meets_anybody_the_distance_is_infinite,
           steps_of_any_size_lead_to_the_same_bits, a_budget_that_ends_leaves_a_true_bracket,
           cancelled_or_ended_by_progress_it_goes_on_when_asked,
           what_never_comes_within_a_distance_is_not_measured, wrong_questions_are_refused_by_name)
