/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <fenv.h>
#include <pthread.h>

#include "tests/support/query_helpers.h"

#include <impinge/examine.h>

/* Whatever floating-point mode the embedding program has set: the same answers, bit for bit, as
 * under the default, and the program's mode is its own again after every call. */

/* --- Modes ------------------------------------------------------------------------------------ */

static void set_control(unsigned sse, int rounding)
{
    fesetenv(FE_DFL_ENV);
    fesetround(rounding);
#if defined(__x86_64__)
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | sse);
#else
    (void)sse;
#endif
}

static void nearest(void) { set_control(0, FE_TONEAREST); }
static void upward(void) { set_control(0, FE_UPWARD); }
static void downward(void) { set_control(0, FE_DOWNWARD); }
static void toward_zero(void) { set_control(0, FE_TOWARDZERO); }
static void flushing(void) { set_control(0x8040, FE_TONEAREST); } /* FTZ and DAZ */
static void trapping(void)
{
    set_control(0, FE_TONEAREST);
#if defined(__GLIBC__)
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
#endif
}

static const struct mode {
    const char *name;
    void (*set)(void);
} modes[] = {{"nearest", nearest},         {"upward", upward},    {"downward", downward},
             {"toward zero", toward_zero}, {"FTZ+DAZ", flushing}, {"trapping", trapping}};

enum { MODES = sizeof modes / sizeof modes[0] };

/* All that steers arithmetic, and the sticky flags. */
typedef struct control {
    unsigned rounding, sse, x87;
    int flags;
} control;

static control control_now(void)
{
    control c = {(unsigned)fegetround(), 0, 0, fetestexcept(FE_ALL_EXCEPT)};
#if defined(__x86_64__)
    unsigned short word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    c.sse = __builtin_ia32_stmxcsr();
    c.x87 = word;
#endif
    return c;
}

/* The call is made in the mode, and leaves it as it is. */
#define IN_MODE(mode, call)                                                                        \
    do {                                                                                           \
        (mode)->set();                                                                             \
        const control before = control_now();                                                      \
        call;                                                                                      \
        const control after = control_now();                                                       \
        nearest();                                                                                 \
        ck_assert_msg(memcmp(&before, &after, sizeof before) == 0, "%s: %s changes the mode",      \
                      (mode)->name, #call);                                                        \
    } while (0)

/* --- Answers ---------------------------------------------------------------------------------- */

/* Tight ones: parameters that no double holds, touchings, kinks, values near the subnormals. */
static const question questions[] = {
    {.a = "sphere radius=0.1",
     .b = "sphere radius=0.3 center=0.7,0,0 ! translate velocity=-0.3,0,0"},
    {.a = "torus major_radius=1 minor_radius=.3 ! rotate axis=1,0.1,0 rate=2",
     .b = "sphere radius=.5 center=3,0,0 ! translate velocity=-3,0,0",
     .gamma = 1e-9},
    {.a = "spike spikes=[[1,0.3],[3.14,-0.2]]",
     .b = "sphere radius=0.2 center=2.1,0,0.1 ! translate velocity=-0.3,0.1,0"},
    {.a = "formula x=u y=v z=sin(3*u)*exp(v/3)-0.1*t domain=[[-1,1],[-1,1]]",
     .b = "point position=0.1,0.2,-0.7 velocity=0,0,1"},
    {.a = "superellipsoid ! scale factor=0.7 ! keyframes times=[0,0.3,1]"
          " positions=[[0,0,0],[0.1,0,0],[0.7,0.1,0]]",
     .b = "ripple ! translate velocity=0,0,-0.1"},
    {.a = "point position=1e-310,0,0",
     .b = "point position=3e-310,0,0 velocity=-2e-310,0,0",
     .gamma = 1e-311},
    {.a = "sphere ! rotate axis=1,2,3 rate=0.7",
     .b = "point position=1,0,0",
     .gamma = 1e-14,
     .max_pairs = 3000},
    {.a = "sphere",
     .b = "sphere center=2.3,0,0 ! translate velocity=-.1,0,0",
     .baseline = IMP_BASELINE_BOXES,
     .gamma = 0.1,
     .max_pairs = 3000},
};

enum { QUESTIONS = sizeof questions / sizeof questions[0] };

static imp_result result_of(imp_query *query)
{
    imp_result r = imp_query_result(query);
    r.stats.seconds = 0;
    return r;
}

static imp_scene *scene_in(const struct mode *mode, imp_registry *registry, const question *q)
{
    imp_scene *scene;
    imp_error error = {IMP_SUCCESS, ""};
    IN_MODE(mode, scene = imp_scene_from_pair(registry, q->a, q->b, &error));
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* Some steps, a refinement in between, the rest. */
static imp_result asked_in(const struct mode *mode, imp_scene *scene, const question *q)
{
    imp_options options = query_options(scene, q);
    imp_query *query;
    imp_code code;
    imp_error error = {IMP_SUCCESS, ""};
    const double gamma = options.gamma;
    options.gamma = 2 * gamma;
    IN_MODE(mode, query = imp_query_new(scene, &options, &error));
    ck_assert_msg(query != NULL, "%s", error.text);
    IN_MODE(mode, code = imp_query_step(query, 20, &error));
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    IN_MODE(mode, code = imp_query_refine(query, gamma, -1, &error));
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    IN_MODE(mode, code = imp_query_step(query, 0, &error));
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    const imp_result r = result_of(query);
    imp_query_free(query);
    return r;
}

static bool same(double x, double y) { return memcmp(&x, &y, sizeof x) == 0; }

static bool same_side(const imp_side *a, const imp_side *b)
{
    return same(a->u, b->u) && same(a->v, b->v) && memcmp(a->point, b->point, sizeof a->point) == 0;
}

static void expect_same(const imp_result *found, const imp_result *wanted, const char *how,
                        const struct mode *mode, const question *q)
{
    bool equal = found->verdict == wanted->verdict && found->reason == wanted->reason &&
                 same(found->t_lower, wanted->t_lower) && same(found->gamma, wanted->gamma) &&
                 same(found->gamma_clear, wanted->gamma_clear) &&
                 memcmp(&found->stats, &wanted->stats, sizeof found->stats) == 0;
    if (wanted->verdict == IMP_VERDICT_CONTACT)
        equal = equal && same(found->gap, wanted->gap) && same_side(&found->a, &wanted->a) &&
                same_side(&found->b, &wanted->b);
    ck_assert_msg(equal, "%s, %s: %s | %s: verdict %d at %.17g, not %d at %.17g", mode->name, how,
                  q->a, q->b, (int)found->verdict, found->t_lower, (int)wanted->verdict,
                  wanted->t_lower);
}

/* Built and asked in the mode; built in it and asked in the default; and the other way round. */
static void expect_mode_plays_no_part(imp_registry *registry, const struct mode *mode,
                                      const question *q)
{
    imp_scene *plain = scene_in(&modes[0], registry, q);
    const imp_result wanted = asked_in(&modes[0], plain, q);
    imp_scene_free(plain);
    const struct mode *builder[] = {mode, mode, &modes[0]}, *asker[] = {mode, &modes[0], mode};
    static const char *const how[] = {"throughout", "when the scene is built", "when it is asked"};
    for (int k = 0; k < 3; ++k) {
        imp_scene *scene = scene_in(builder[k], registry, q);
        const imp_result found = asked_in(asker[k], scene, q);
        imp_scene_free(scene);
        expect_same(&found, &wanted, how[k], mode, q);
    }
}

static void ask_all(imp_registry *registry)
{
    for (int m = 0; m < MODES; ++m)
        for (int k = 0; k < QUESTIONS; ++k)
            expect_mode_plays_no_part(registry, &modes[m], &questions[k]);
}

START_TEST(answers_do_not_depend_on_the_callers_mode)
{
    imp_registry *registry = query_registry();
    ask_all(registry);
    imp_registry_free(registry);
}
END_TEST

START_TEST(registries_loaded_in_any_mode_answer_alike)
{
    for (int m = 1; m < MODES; ++m) {
        imp_registry *registry;
        IN_MODE(&modes[m], registry = query_registry());
        expect_mode_plays_no_part(registry, &modes[m], &questions[m]);
        imp_registry_free(registry);
    }
}
END_TEST

START_TEST(isolated_instances_do_not_inherit_the_callers_mode)
{
    imp_registry *registry = query_registry();
    ck_assert_int_eq(imp_registry_isolate(registry, NULL, NULL), IMP_SUCCESS);
    for (int m = 1; m < MODES; ++m)
        for (int k = 0; k < 2; ++k) expect_mode_plays_no_part(registry, &modes[m], &questions[k]);
    imp_registry_free(registry);
}
END_TEST

static void *ask_in_thread(void *registry)
{
    ask_all(registry);
    return NULL;
}

START_TEST(threads_started_in_any_mode_answer_alike)
{
    imp_registry *registry = query_registry();
    pthread_t thread;
    upward();
    ck_assert_int_eq(pthread_create(&thread, NULL, ask_in_thread, registry), 0);
    nearest();
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
    imp_registry_free(registry);
}
END_TEST

/* --- Points ----------------------------------------------------------------------------------- */

START_TEST(points_and_their_errors_do_not_depend_on_the_callers_mode)
{
    enum { POINTS = 50 };
    imp_registry *registry = query_registry();
    uint64_t random = suite_seed();
    for (int k = 0; k < QUESTIONS; ++k) {
        double lo[3], hi[3], p[3 * POINTS], x[2][3 * POINTS], error[2][3 * POINTS];
        imp_scene *scene = scene_in(&modes[0], registry, &questions[k]);
        imp_scene_domain(scene, 0, 0, lo, hi);
        for (int i = 0; i < POINTS; ++i) {
            p[3 * i] = random_between(&random, lo[0], hi[0]);
            p[3 * i + 1] = random_between(&random, lo[1], hi[1]);
            p[3 * i + 2] = random_between(&random, 0, 1);
        }
        imp_scene_eval(scene, 0, 0, POINTS, p, x[0], error[0], NULL);
        for (int m = 1; m < MODES; ++m) {
            IN_MODE(&modes[m], imp_scene_eval(scene, 0, 0, POINTS, p, x[1], error[1], NULL));
            ck_assert_msg(memcmp(x[0], x[1], sizeof x[0]) == 0, "%s: %s", modes[m].name,
                          questions[k].a);
            ck_assert_msg(memcmp(error[0], error[1], sizeof error[0]) == 0, "%s: %s", modes[m].name,
                          questions[k].a);
        }
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

/* 0.1 is read as the nearest double, and what create makes of it does not depend on the mode. */
START_TEST(instances_do_not_depend_on_the_callers_mode)
{
    static const char text[] = "spike radius=0.1 width=0.3 spikes=[[83.05,0.1]]";
    const double p[3] = {1.3, 0.2, 0};
    imp_registry *registry = query_registry();
    imp_instance made;
    double wanted[3], x[3], error[2][3];
    ck_assert_int_eq(imp_instance_from_text(registry, IMP_TYPE_SURFACE, text, &made, NULL), 0);
    made.surface->eval(made.self, 1, p, wanted, error[0]);
    imp_instance_free(&made);
    for (int m = 1; m < MODES; ++m) {
        imp_code code;
        IN_MODE(&modes[m],
                code = imp_instance_from_text(registry, IMP_TYPE_SURFACE, text, &made, NULL));
        ck_assert_int_eq(code, IMP_SUCCESS);
        made.surface->eval(made.self, 1, p, x, error[1]);
        imp_instance_free(&made);
        ck_assert(memcmp(x, wanted, sizeof x) == 0);
        ck_assert(memcmp(error[0], error[1], sizeof error[0]) == 0);
    }
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("callers mode", answers_do_not_depend_on_the_callers_mode,
           registries_loaded_in_any_mode_answer_alike,
           isolated_instances_do_not_inherit_the_callers_mode,
           threads_started_in_any_mode_answer_alike,
           points_and_their_errors_do_not_depend_on_the_callers_mode,
           instances_do_not_depend_on_the_callers_mode)
