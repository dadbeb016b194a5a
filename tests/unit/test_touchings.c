/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

/* Touchings that have a closed form: pairs of surfaces that are apart before t = 1 and touch then,
 * in a point, along a line or a ring, or all over, at corners, edges, poles, apexes and kinks. Each
 * is asked at several gamma and clearances, over intervals that hold the touch inside, at their
 * start, at their end, or alone. */

/* slowest (1 - t) <= distance at t <= fastest (1 - t) for t in [0, 1]; slowest = 0: not known. */
typedef struct touching {
    const char *a, *b;
    double slowest, fastest;
    double finest; /* gamma */
} touching;

#define FLOOR "plane origin=-4,-4,0 edge_u=8,0,0 edge_v=0,8,0"
#define FALLING(Z) " ! translate offset=[[0,0," Z "],[0,0,-1]]"
#define COMING_FROM(X) " ! translate offset=[[" X ",0,0],[-1,0,0]]"
#define CORNER "plane edge_u=-2,0,0 edge_v=0,-2,0" /* edges along x and y, the body below them */

static const touching touchings[] = {
    /* --- Corners and edges -------------------------------------------------------------------- */
    {"point", "point position=3,4,0 velocity=-3,-4,0", 5, 5, 1e-6},
    {"plane", "point position=0.25,0.75,1 velocity=0,0,-1", 1, 1, 1e-6},
    {"plane", "point position=-1,0.5,0 velocity=1,0,0", 1, 1, 1e-6}, /* in the plane, to an edge */
    {CORNER, "point position=3,4,0 velocity=-3,-4,0", 5, 5, 1e-6},
    {"segment points=[[-1,0,0],[1,0,0]]", "segment points=[[0,-1,0],[0,1,0]]" FALLING("1"), 1, 1,
     1e-6},
    {"segment points=[[-1,0,0],[0,0,0]]", "segment points=[[0,0,0],[1,0,0]]" COMING_FROM("1"), 1, 1,
     1e-6},
    {"segment points=[[-1,0,0],[1,0,0]]", "segment points=[[-0.5,0,0],[2,0,0]]" FALLING("1"), 1, 1,
     1e-4}, /* along a line */
    {FLOOR, "triangle points=[[0.2,0.2,0],[1,0.3,1],[0.3,1,1]]" FALLING("1"), 1, 1, 1e-6},
    {CORNER, "triangle points=[[0,0,0],[1,0.5,0],[0.5,1,0]] ! translate offset=[[1,0,0],[-1,0,0]]",
     1, 1, 1e-6},
    {FLOOR, "triangle points=[[0,0,0],[1,0.25,0],[0,1,1]]" FALLING("1"), 1, 1, 1e-3},
    {"plane", "plane origin=0.25,0.25,0" FALLING("1"), 1, 1, 1e-2},        /* all over */
    {"plane", "plane origin=1,0.25,0" COMING_FROM("1"), 1, 1, 1e-3},       /* edge to edge */
    {FLOOR, "plane edge_u=1,0.5,0 edge_v=0,0,1" FALLING("1"), 1, 1, 1e-3}, /* edge on face */
    {"segment points=[[0,0,0],[2,0,0]] ! rotate axis=0,0,1 rate=1",        /* sin(1 - t) */
     "point position=0.54030230586813977,0.8414709848078965,0", 0.84, 1, 1e-6},

    /* --- Round -------------------------------------------------------------------------------- */
    {"sphere", "sphere" FALLING("3"), 1, 1, 1e-6}, /* pole to pole */
    {"sphere", "sphere" COMING_FROM("3"), 1, 1, 1e-6},
    {"sphere", "sphere radius=12 center=3,4,12 ! translate offset=[[3,4,12],[-3,-4,-12]]", 13, 13,
     1e-5},
    {FLOOR, "sphere center=0.3,0.1,0" FALLING("2"), 1, 1, 1e-6},
    {CORNER, "sphere center=0,-1,0" COMING_FROM("2"), 1, 1, 1e-6}, /* tangent to an edge */
    {CORNER, "sphere radius=5 center=3,4,0 ! translate offset=[[3,4,0],[-3,-4,0]]", 5, 5, 1e-6},
    {"sphere radius=2", "sphere ! translate velocity=0.6,0,0.8", 1, 1, 1e-6}, /* from inside */
    {"sphere radius=2", "sphere ! scale factors=[[1],[1]]", 1, 1, 1e-2},      /* all over */
    {"torus major_radius=2 minor_radius=0.5", "sphere ! scale factors=[[1],[0.5]]", 0.5, 0.5, 1e-3},
    {FLOOR, "torus major_radius=1 minor_radius=0.5" FALLING("1.5"), 1, 1, 1e-3}, /* on a ring */
    {"cylinder height=4", "cylinder height=4" COMING_FROM("3"), 1, 1, 1e-3},
    {FLOOR, "cylinder height=2" FALLING("2"), 1, 1, 1e-3}, /* on its rim */
    {"cone", "plane origin=-1,-1,1 edge_u=2,0,0 edge_v=0,2,0" FALLING("1"), 1, 1, 1e-6},
    {"cone", "cone ! scale factor=[1,1,-1]" FALLING("3"), 1, 1, 1e-6}, /* apex to apex */
    {"cone", "cone" FALLING("1"), 0.7071, 0.7072, 1e-2},               /* all over */
    {FLOOR, "ellipsoid radii=3,2,1" FALLING("2"), 1, 1, 1e-5},
    {FLOOR, "superellipsoid radii=1,1,1 exponents=2,2" FALLING("2"), 1, 1, 1e-5},

    /* --- Kinks -------------------------------------------------------------------------------- */
    {FLOOR, "formula x=u y=v z=abs(u)+abs(v)+1-t domain=[[-1,1],[-1,1]]", 1, 1, 1e-6},
    {FLOOR, "formula x=u y=v z=abs(u)+1-t domain=[[-1,1],[-1,1]]", 1, 1, 1e-3}, /* a ridge */
    {FLOOR, "sphere ! translate times=0,1,2 positions=[[0,0,2],[0,0,1],[0,0,3]]", 1, 1, 1e-6},

    /* --- Only at one time --------------------------------------------------------------------- */
    {"sphere", "sphere center=-2,0,2 ! translate velocity=2,0,0", 0, 2, 1e-5},
    {FLOOR, "formula x=u y=v z=(t-1)^2+u^2+v^2 domain=[[-1,1],[-1,1]]", 0, 1, 1e-5},
};
enum { TOUCHINGS = sizeof touchings / sizeof *touchings };

/* --- Asking ----------------------------------------------------------------------------------- */

/* Coordinates are below 32, and evaluated to some of their ulps. */
static const double rounding = 1e-13;

static void check_touch(const touching *k, const question *q, const imp_result *r, const char *how)
{
    /* Distances are below gamma_clear soon after this time: no t_lower is greater. */
    const double latest = fmax(q->t_start, 1 - (q->gamma_clear - rounding) / k->fastest);
    /* They are above gamma before this one: no contact is reported earlier. */
    const double earliest = k->slowest > 0 ? 1 - (q->gamma + rounding) / k->slowest : 0;
    ck_assert_msg(r->verdict == IMP_VERDICT_CONTACT && r->t <= latest && r->t >= earliest,
                  "%s | %s, %s, gamma %g, gamma_clear %g, times [%g, %g]: verdict %d (reason %d), "
                  "t_lower %.17g, expected contact in [%.17g, %.17g]",
                  q->a, q->b, how, q->gamma, q->gamma_clear, q->t_start, q->t_end, (int)r->verdict,
                  (int)r->reason, r->t_lower, earliest, latest);
}

/* A witness says that at its time the surfaces are no farther apart than its gap. Asked again with
 * a gamma_clear just above that, t_lower is no later, and clear no answer. */
static void ask_sharper(imp_registry *registry, const question *q, const imp_result *seen)
{
    question sharper = *q;
    sharper.gamma_clear = seen->gap + rounding;
    sharper.gamma = 2 * sharper.gamma_clear;
    const imp_result r = ask_in(registry, &sharper);
    ck_assert_msg(
        r.verdict != IMP_VERDICT_CLEAR && r.t_lower <= seen->t,
        "%s | %s, gamma_clear %.17g, times [%g, %g]: verdict %d, t_lower %.17g, but a gap "
        "of %.17g was seen at %.17g",
        q->a, q->b, sharper.gamma_clear, q->t_start, q->t_end, (int)r.verdict, r.t_lower, seen->gap,
        seen->t);
}

static void ask_touch(imp_registry *registry, const touching *k, const question *q)
{
    const imp_result r = ask_in(registry, q);
    check_touch(k, q, &r, "plain");
    ask_sharper(registry, q, &r);
}

static const double intervals[][2] = {{0, 2}, {0.3, 1}, {1, 1.7}, {1, 1}};

/* Over all intervals; and until distances come down to gamma, which is clear. */
static void ask_everywhen(imp_registry *registry, const touching *k, question q)
{
    for (size_t n = 0; n < sizeof intervals / sizeof *intervals; ++n) {
        q.t_start = intervals[n][0];
        q.t_end = intervals[n][1];
        ask_touch(registry, k, &q);
    }
    if (k->slowest == 0) return;
    q.t_start = 0;
    q.t_end = 1 - (q.gamma + rounding) / k->slowest;
    const imp_result r = ask_in(registry, &q);
    ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR, "%s | %s until %.17g: verdict %d (reason %d)",
                  q.a, q.b, q.t_end, (int)r.verdict, (int)r.reason);
}

static void for_each_touching(void (*judge)(imp_registry *registry, const touching *k))
{
    imp_registry *registry = query_registry();
    for (int k = 0; k < TOUCHINGS; ++k) judge(registry, &touchings[k]);
    imp_registry_free(registry);
}

static void ask_everyhow(imp_registry *registry, const touching *k)
{
    static const double shares[] = {0.5, 0.03, 0.9}; /* of gamma, as gamma_clear */
    enum { SHARES = sizeof shares / sizeof *shares };
    const int asked = suite_times(2 * SHARES); /* sanitized builds ask for one */
    for (double gamma = k->finest; gamma < 0.2; gamma *= 64)
        for (int n = 0; n < SHARES && n < asked; ++n)
            ask_everywhen(
                registry, k,
                (question){.a = k->a, .b = k->b, .gamma = gamma, .gamma_clear = shares[n] * gamma});
}

START_TEST(a_touch_is_found_when_it_happens_and_no_sharper_question_denies_it)
{
    for_each_touching(ask_everyhow);
}
END_TEST

/* --- The same touch, asked otherwise ---------------------------------------------------------- */

static question question_of_touch(const touching *k)
{
    return (question){
        .a = k->a, .b = k->b, .t_end = 2, .gamma = 4 * k->finest, .gamma_clear = 2 * k->finest};
}

static void ask_swapped(imp_registry *registry, const touching *k)
{
    question q = question_of_touch(k);
    q.a = k->b;
    q.b = k->a;
    const imp_result r = ask_in(registry, &q);
    check_touch(k, &q, &r, "swapped");
}

START_TEST(which_body_comes_first_does_not_matter) { for_each_touching(ask_swapped); }
END_TEST

static void ask_moved(imp_registry *registry, const touching *k)
{
    const char *const moves[] = {"translate velocity=[3,-1,2]",
                                 "rotate axis=[1,-1,4] rate=0.7 center=[1,0,2]",
                                 "scale factor=[1,-1,1] ! rotate axis=[-1,2,0.5] angle=[-2.3]"};
    for (size_t n = 0; n < sizeof moves / sizeof *moves; ++n) {
        question q = question_of_touch(k);
        char a[300], b[300];
        snprintf(a, sizeof a, "%s ! %s", k->a, moves[n]);
        snprintf(b, sizeof b, "%s ! %s", k->b, moves[n]);
        q.a = a;
        q.b = b;
        const imp_result r = ask_in(registry, &q);
        check_touch(k, &q, &r, "moved");
    }
}

START_TEST(moving_and_mirroring_both_bodies_does_not_matter) { for_each_touching(ask_moved); }
END_TEST

/* What distances between slowest (1 - t) and fastest (1 - t) decide at the end of the interval,
 * where they are least. */
static void check_before(const touching *k, const question *q, const imp_result *r)
{
    const double left = 1 - q->t_end;
    ck_assert(left >= 0);
    const bool apart = k->slowest * left > q->gamma + rounding,
               near = k->fastest * left < q->gamma_clear - rounding;
    ck_assert_msg(!(apart && r->verdict != IMP_VERDICT_CLEAR) &&
                      !(near && r->verdict == IMP_VERDICT_CLEAR),
                  "%s | %s, times [%.17g, %.17g]: verdict %d (reason %d)", q->a, q->b, q->t_start,
                  q->t_end, (int)r->verdict, (int)r->reason);
    if (near) check_touch(k, q, r, "just before");
}

static void ask_instants(imp_registry *registry, const touching *k)
{
    question q = question_of_touch(k);
    const double before[] = {0.25, 8 * k->finest, k->finest};
    for (size_t n = 0; n < sizeof before / sizeof *before; ++n) {
        q.t_start = q.t_end = 1 - before[n] / k->fastest;
        const imp_result r = ask_in(registry, &q);
        check_before(k, &q, &r);
    }
}

START_TEST(an_instant_is_judged_by_the_distance_then) { for_each_touching(ask_instants); }
END_TEST

/* The two halves of an interval: a contact in the whole is one in the first half that is not clear,
 * within the same bounds. */
static void ask_halves(imp_registry *registry, const touching *k)
{
    const double cuts[] = {0.4, 1 - 0.5 * k->finest / k->fastest, 1};
    for (size_t n = 0; n < sizeof cuts / sizeof *cuts; ++n) {
        question q = question_of_touch(k);
        q.t_end = cuts[n];
        const imp_result first = ask_in(registry, &q);
        check_before(k, &q, &first);
        if (first.verdict != IMP_VERDICT_CLEAR) continue;
        q.t_start = cuts[n];
        q.t_end = 2;
        const imp_result second = ask_in(registry, &q);
        check_touch(k, &q, &second, "second half");
    }
}

START_TEST(two_halves_of_an_interval_tell_the_whole) { for_each_touching(ask_halves); }
END_TEST

static imp_query *begin(imp_scene *scene, const question *q)
{
    const imp_options options = query_options(scene, q);
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

/* To the end, in steps of some pairs; t_lower never falls. */
static imp_result step_to_end(imp_query *query)
{
    imp_result r = imp_query_result(query);
    while (r.reason == IMP_REASON_RUNNING) {
        const double t_lower = r.t_lower;
        ck_assert_int_eq(imp_query_step(query, 300, NULL), IMP_SUCCESS);
        r = imp_query_result(query);
        ck_assert_double_ge(r.t_lower, t_lower);
    }
    return r;
}

static void ask_finer_and_finer(imp_registry *registry, const touching *k)
{
    question q = question_of_touch(k);
    q.gamma *= 16;
    q.gamma_clear *= 16;
    imp_scene *scene = imp_scene_from_pair(registry, q.a, q.b, NULL);
    imp_query *query = begin(scene, &q);
    for (double t_lower = 0; q.gamma >= k->finest;) {
        const imp_result r = step_to_end(query);
        check_touch(k, &q, &r, "refined");
        ck_assert_double_ge(r.t_lower, t_lower);
        t_lower = r.t_lower;
        q.gamma /= 4;
        q.gamma_clear /= 4;
        ck_assert_int_eq(imp_query_refine(query, q.gamma, q.gamma_clear, NULL), IMP_SUCCESS);
    }
    imp_query_free(query);
    imp_scene_free(scene);
}

START_TEST(a_coarse_answer_refined_in_steps_stays_right) { for_each_touching(ask_finer_and_finer); }
END_TEST

SUITE_MAIN("touchings", a_touch_is_found_when_it_happens_and_no_sharper_question_denies_it,
           which_body_comes_first_does_not_matter, moving_and_mirroring_both_bodies_does_not_matter,
           an_instant_is_judged_by_the_distance_then, two_halves_of_an_interval_tell_the_whole,
           a_coarse_answer_refined_in_steps_stays_right)
