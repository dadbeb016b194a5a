/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stdarg.h>

#include "core/scene/scene.h"
#include "core/surface/aside.h"
#include "core/surface/commute.h"
#include "core/surface/region.h"
#include "tests/support/failing_query.h"

/* Maps that are exchanged, and surfaces some of whose maps are set aside, at random: points move no
 * farther than the bounds say. */

enum { SPANS = 16384, SCENES = 200, POINTS = 30, TEXT = 800, WORDS = 4 };

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *scene_of(const char *a, const char *b)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s | %s: %s", a, b, error.text);
    return scene;
}

/* --- Maps ------------------------------------------------------------------------------------- */

typedef struct word {
    char text[TEXT];
} word;

__attribute__((format(printf, 1, 2))) static word word_of(const char *format, ...)
{
    word w;
    va_list of;
    va_start(of, format);
    vsnprintf(w.text, sizeof w.text, format, of);
    va_end(of);
    return w;
}

/* A line whose coordinates are small multiples of 1/4, so that points of it are exact. */
typedef struct line {
    int direction[3], point[3];
} line;

static line draw_line(uint64_t *random)
{
    line l = {{0, 0, 1}, {0, 0, 0}};
    const bool is_plain = random_bits(random) % 2 == 0;
    for (int i = 0; i < 3; ++i) {
        if (!is_plain) l.direction[i] = (int)(random_bits(random) % 9) - 4;
        l.point[i] = (int)(random_bits(random) % 9) - 4;
    }
    l.direction[2] += l.direction[0] == 0 && l.direction[1] == 0 && l.direction[2] == 0;
    return l;
}

/* A turn about the line, given by another point of it and another length of its direction. */
static word turn_about(uint64_t *random, const line *l, double rate)
{
    const int n = (int)(random_bits(random) % 5) - 2, m = random_bits(random) % 2 ? 1 : 3;
    return word_of(
        " ! rotate axis=%d,%d,%d center=%.17g,%.17g,%.17g rate=%.17g", m * l->direction[0],
        m * l->direction[1], m * l->direction[2], 0.25 * l->point[0] + n * l->direction[0],
        0.25 * l->point[1] + n * l->direction[1], 0.25 * l->point[2] + n * l->direction[2], rate);
}

static word shift_along(const line *l, double rate)
{
    return word_of(" ! translate velocity=%.17g,%.17g,%.17g", rate * l->direction[0],
                   rate * l->direction[1], rate * l->direction[2]);
}

static word draw_word(uint64_t *random, const line *l)
{
    const line other = draw_line(random);
    switch (random_bits(random) % 6) {
    case 0:
        return turn_about(random, l, 3 * random_part(random));
    case 1:
        return shift_along(l, random_part(random));
    case 2:
        return turn_about(random, &other, 3 * random_part(random));
    case 3:
        return shift_along(&other, random_part(random));
    case 4:
        return word_of(" ! screw axis=%d,%d,%d pitch=0.5 rate=%.17g", l->direction[0],
                       l->direction[1], l->direction[2], random_part(random));
    default:
        return word_of(" ! rotate axis=%d,%d,%d angle=%.17g,%.17g,%.17g", l->direction[0],
                       l->direction[1], l->direction[2], random_part(random), random_part(random),
                       random_part(random));
    }
}

/* --- Exchanges -------------------------------------------------------------------------------- */

static map_law law_of(const surface *s, size_t k)
{
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    imp_pose pose;
    ck_assert_int_eq(surface_pose_of_maps(s, k, k + 1, &times, &pose), IMP_STATUS_OK);
    return map_law_of(&pose);
}

START_TEST(maps_that_are_exchanged_move_points_no_farther_than_is_said)
{
    uint64_t random = suite_seed();
    int commute = 0, differ = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const line l = draw_line(&random);
        const word x = draw_word(&random, &l), y = draw_word(&random, &l);
        char a[3 * TEXT], b[3 * TEXT];
        snprintf(a, sizeof a, "sphere%s%s", x.text, y.text);
        snprintf(b, sizeof b, "sphere%s%s", y.text, x.text);
        imp_scene *scene = scene_of(a, b);
        const surface *s = scene_surface(scene, 0, 0), *t = scene_surface(scene, 1, 0);
        const map_law law[2] = {law_of(s, 0), law_of(s, 1)};
        const double most = map_laws_exchange_upper(&law[0], &law[1]);
        ck_assert_double_eq(most, map_laws_exchange_upper(&law[1], &law[0]));
        for (int k = 0; k < POINTS; ++k) {
            const double at = random_fraction(&random), far = random_power(&random, -3, 6);
            double p[3], q[3];
            for (int i = 0; i < 3; ++i) p[i] = q[i] = far * random_part(&random);
            ck_assert_int_eq(surface_move_outward(s, 0, at, 1, p), IMP_STATUS_OK);
            ck_assert_int_eq(surface_move_outward(t, 0, at, 1, q), IMP_STATUS_OK);
            ck_assert_msg(query_distance(p, q) <= most + 1e-13 * (30 + far), "%s: %g > %g", a,
                          query_distance(p, q), most);
            differ += query_distance(p, q) > 1e-3;
        }
        commute += most < 1e-12;
        imp_scene_free(scene);
    }
    ck_assert_msg(commute > SCENES / 20 && differ > SCENES, "%d commute, %d differ", commute,
                  differ);
}
END_TEST

/* --- Maps set aside --------------------------------------------------------------------------- */

/* Two surfaces whose motions share much, in an order that hides it. */
typedef struct twins {
    char a[8 * TEXT], b[8 * TEXT];
} twins;

static void add(char *text, const word *w) { strcat(text, w->text); }

static twins draw_twins(uint64_t *random)
{
    twins y = {"box size=1,0.7,0.4", ""};
    snprintf(y.b, sizeof y.b, "sphere radius=0.4 center=0,0,%.17g",
             random_between(random, 0.61, 1));
    const line l = draw_line(random);
    const double rate = 3 * random_part(random), share = random_part(random),
                 way = random_part(random);
    const double most = random_power(random, -40, -3);
    const word both = turn_about(random, &l, rate), alike = turn_about(random, &l, rate + most),
               one = turn_about(random, &l, share * rate),
               other = turn_about(random, &l, rate - share * rate),
               back = turn_about(random, &l, -rate), slide = shift_along(&l, way),
               off = shift_along(&l, -way), own = draw_word(random, &l);
    const word *const forms[][2][WORDS] = {{{&both, &slide}, {&both}},
                                           {{&slide, &both, &off}, {&both}},
                                           {{&both, &own}, {&both}},
                                           {{&own, &one, &other}, {&both}},
                                           {{&one, &slide, &other}, {&off, &both, &slide}},
                                           {{&both, &slide, &back}, {&own}},
                                           {{&both}, {&alike}},
                                           {{&slide, &own, &off}, {&own}},
                                           {{&one, &own, &other}, {&both, &own}}};
    const size_t form = random_bits(random) % (sizeof forms / sizeof *forms);
    const bool swaps = random_bits(random) % 2 == 0;
    for (int k = 0; k < WORDS; ++k) {
        if (forms[form][0][k] != NULL) add(swaps ? y.b : y.a, forms[form][0][k]);
        if (forms[form][1][k] != NULL) add(swaps ? y.a : y.b, forms[form][1][k]);
    }
    return y;
}

static void draw_point(uint64_t *random, const surface *s, double t, size_t *piece, double p[3])
{
    const size_t count = surface_part_count(s);
    double lo[3], hi[3];
    *piece = count > 1 ? random_bits(random) % count : 0;
    surface_domain(surface_part(s, *piece), lo, hi);
    for (int j = 0; j < 2; ++j) p[j] = lo[j] + random_fraction(random) * (hi[j] - lo[j]);
    p[2] = t;
}

static void point_of(const surface *s, size_t piece, const double p[3], double x[3])
{
    ck_assert_int_eq(surface_eval(surface_part(s, piece), 1, p, x, NULL), IMP_STATUS_OK);
}

/* Asks what the surfaces of both bodies share over times [0, 1], their points before maps being
 * within `size` of 0 along each coordinate. *spans falls. */
static shared_aside shared_of(const imp_scene *scene, double size, double enough, size_t *spans)
{
    const surface *const s[2] = {scene_surface(scene, 0, 0), scene_surface(scene, 1, 0)};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    imp_model bare[2][3];
    aside_look look[2] = {{.from = INFINITY}, {.from = INFINITY}};
    aside_look *const looks[2] = {&look[0], &look[1]};
    shared_aside shared, again;
    int asked;
    for (int k = 0; k < 6; ++k) bare[k / 3][k % 3] = imp_between(-size, size);
    ck_assert_int_eq(surface_shared_aside(s, bare, &times, enough, spans, looks, &shared, &asked),
                     IMP_STATUS_OK);
    if (shared.which[0] != 0 || shared.which[1] != 0)
        ck_assert(surface_may_set_aside(s, &times, enough, looks));
    size_t rest = *spans;
    ck_assert_int_eq(surface_shared_aside(s, bare, &times, enough, &rest, looks, &again, &asked),
                     IMP_STATUS_OK);
    if (rest == *spans) /* else there may be too few spans left */
        ck_assert(again.which[0] == shared.which[0] && again.which[1] == shared.which[1]);
    return shared;
}

START_TEST(surfaces_without_maps_set_aside_are_as_far_from_each_other)
{
    uint64_t random = suite_seed();
    int found = 0, slips = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const twins y = draw_twins(&random);
        imp_scene *scene = scene_of(y.a, y.b);
        const surface *const s[2] = {scene_surface(scene, 0, 0), scene_surface(scene, 1, 0)};
        const double enough = random_power(&random, -20, -3);
        size_t spans = SPANS;
        const shared_aside shared = shared_of(scene, 2.5, enough, &spans);
        surface *made[2];
        ck_assert_double_le(shared.slip, enough);
        found += (shared.which[0] | shared.which[1]) != 0;
        slips += shared.slip > 1e-12;
        for (int side = 0; side < 2; ++side) {
            const maps_aside aside = {shared.which[side], shared.slip};
            made[side] = surface_new_aside(s[side], surface_map_count(s[side]), aside);
            ck_assert_ptr_nonnull(made[side]);
        }
        for (int k = 0; k < POINTS; ++k) {
            const double t = random_fraction(&random);
            double all[2][3], kept[2][3];
            for (int side = 0; side < 2; ++side) {
                size_t piece;
                double p[3];
                draw_point(&random, s[side], t, &piece, p);
                point_of(s[side], piece, p, all[side]);
                point_of(made[side], piece, p, kept[side]);
            }
            const double far = query_distance(all[0], all[1]),
                         near = query_distance(kept[0], kept[1]);
            ck_assert_msg(fabs(far - near) <= shared.slip + 1e-11, "%s | %s: %.17g, %.17g > %g",
                          y.a, y.b, far, near, shared.slip);
        }
        for (int side = 0; side < 2; ++side) surface_free(made[side]);
        imp_scene_free(scene);
    }
    ck_assert_msg(2 * found > SCENES && slips > 5, "%d found, %d slip", found, slips);
}
END_TEST

/* Motions that nearly commute, cancel or are alike. */
START_TEST(maps_that_differ_by_more_than_is_allowed_are_not_set_aside)
{
    static const char *const moving[][2] = {
        {"box ! rotate rate=2 ! rotate rate=-2.00001", "box"},
        {"box ! rotate rate=2 ! rotate rate=-2 center=1e-5,0,0", "box"},
        {"box ! rotate rate=2 ! rotate rate=-2 axis=1e-5,0,1", "box"},
        {"box ! rotate rate=2 ! translate velocity=1e-5,0,0.5", "box ! rotate rate=2"},
        {"box ! rotate rate=2 ! translate velocity=0,0,1 ! rotate axis=1,0,0 rate=1",
         "box ! rotate axis=1,0,0 rate=1 ! rotate rate=2"},
        {"box ! translate velocity=1,2,3 ! translate velocity=-1,-2,-3.00001", "box"},
        {"box ! rotate rate=1 ! rotate rate=0.5", "box ! rotate rate=1.50001"},
        /* at rest at the three times that are looked at first */
        {"box ! rotate angle=-0.146466,1.001466,-1.855,1 ! rotate "
         "angle=0.073233,-0.500733,0.9275,-0.5",
         "box"}};
    for (size_t n = 0; n < sizeof moving / sizeof *moving; ++n) {
        imp_scene *scene = scene_of(moving[n][0], moving[n][1]);
        size_t spans = SPANS;
        const shared_aside shared = shared_of(scene, 1, 1e-6, &spans);
        ck_assert_msg(shared.which[0] == 0 && shared.which[1] == 0, "%s | %s", moving[n][0],
                      moving[n][1]);
        imp_scene_free(scene);
    }
}
END_TEST

/* Turns that cancel at rate 2 need many parts of time, and faster ones more than there may be: that
 * is seen at once. */
START_TEST(parts_of_time_are_looked_at_only_where_they_suffice)
{
    static const char *const turning[] = {"box ! rotate rate=2 ! rotate rate=-2",
                                          "box ! rotate rate=100 ! rotate rate=-100"};
    for (int few = 0; few < 2; ++few)
        for (int n = 0; n < 2; ++n) {
            imp_scene *scene = scene_of(turning[n], "box");
            const size_t all = few ? 64 : SPANS;
            size_t spans = all;
            const shared_aside shared = shared_of(scene, 1, 1e-9, &spans);
            ck_assert_int_eq(shared.which[0] != 0, !few && n == 0);
            if (few || n == 1)
                ck_assert_uint_ge(spans, all - 8);
            else
                ck_assert_uint_lt(spans, all - 64);
            imp_scene_free(scene);
        }
}
END_TEST

/* --- Answers ---------------------------------------------------------------------------------- */

/* The point is where its parameters are. */
static void check_side(const imp_scene *scene, const imp_side *side, double t)
{
    const imp_place at = {side->body, side->surface, side->piece};
    double x[3], inexact[3];
    ck_assert_int_eq(
        imp_piece_eval(scene, at, 1, (double[3]){side->u, side->v, t}, x, inexact, NULL),
        IMP_SUCCESS);
    ck_assert_double_eq(query_distance(x, side->point), 0);
}

START_TEST(answers_are_those_of_the_surfaces_under_all_maps)
{
    uint64_t random = suite_seed();
    int touches = 0, clear = 0;
    for (int n = 0; n < suite_times_at_least(SCENES / 4); ++n) {
        const twins y = draw_twins(&random);
        imp_scene *scene = scene_of(y.a, y.b);
        imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        imp_error error;
        options.gamma = random_power(&random, -16, -2);
        options.max_pairs = 20000;
        ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s",
                      error.text);
        touches += r.verdict == IMP_VERDICT_CONTACT;
        clear += r.verdict == IMP_VERDICT_CLEAR;
        if (r.verdict == IMP_VERDICT_CONTACT) {
            check_side(scene, &r.a, r.t);
            check_side(scene, &r.b, r.t);
            const double gap = query_distance(r.a.point, r.b.point);
            ck_assert_double_le(gap, r.gamma * (1 + 1e-9));
            for (int i = 0; i < 3 && r.has_normal && gap > 1e-6; ++i)
                ck_assert_double_le(fabs(r.normal[i] * gap - (r.b.point[i] - r.a.point[i])),
                                    1e-2 * gap);
        }
        for (int k = 0; k < 20 * POINTS; ++k) {
            const double t = random_fraction(&random) * r.t_lower;
            double x[2][3];
            for (int side = 0; side < 2; ++side) {
                const surface *s = scene_surface(scene, (size_t)side, 0);
                size_t piece;
                double p[3];
                draw_point(&random, s, t, &piece, p);
                point_of(s, piece, p, x[side]);
            }
            ck_assert_msg(t == r.t_lower || query_distance(x[0], x[1]) >= 0.5 * r.gamma - 1e-12,
                          "%s | %s at %.17g", y.a, y.b, t);
        }
        imp_scene_free(scene);
    }
    ck_assert_msg(touches > 2 && clear > 2, "%d touch, %d are clear", touches, clear);
}
END_TEST

/* One motion, given by other numbers, other parameters or another type. */
START_TEST(surfaces_carried_by_one_motion_in_other_words_are_told_apart_at_once)
{
    static const char *const words[] = {"rotate axis=2,4,6 rate=7",
                                        "rotate axis=-1,-2,-3 rate=-7",
                                        "rotate axis=1,2,3 angle=0,7",
                                        "rotate axis=1,2,3 rate=7 center=1,2,3",
                                        "rotate axis=1,2,3 times=0,1 angles=0,7",
                                        "motion-formula axis=1,2,3 angle=7*t",
                                        "screw axis=1,2,3 pitch=0 rate=7"};
    for (size_t n = 0; n < sizeof words / sizeof *words; ++n) {
        char b[TEXT];
        snprintf(b, sizeof b, "box center=1.001,0,0 ! %s", words[n]);
        imp_scene *scene = scene_of("box ! rotate axis=1,2,3 rate=7", b);
        imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        imp_error error;
        options.gamma = 1e-4;
        options.max_pairs = 100;
        ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s",
                      error.text);
        ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR, "%s: %llu pairs", b,
                      (unsigned long long)r.stats.pairs);
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Memory ----------------------------------------------------------------------------------- */

START_TEST(a_query_that_sets_maps_aside_and_runs_out_of_memory_can_go_on)
{
    const failing_query q = {.registry = registry,
                             .a = "box ! rotate rate=2 ! translate velocity=0,0,0.5",
                             .b = "box size=1,1,3 center=1.01,0,0 ! rotate rate=2",
                             .verdict = IMP_VERDICT_CLEAR,
                             .pairs_most = 10};
    failing_query_try_all(&q);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        maps_that_are_exchanged_move_points_no_farther_than_is_said,
        surfaces_without_maps_set_aside_are_as_far_from_each_other,
        maps_that_differ_by_more_than_is_allowed_are_not_set_aside,
        parts_of_time_are_looked_at_only_where_they_suffice,
        answers_are_those_of_the_surfaces_under_all_maps,
        surfaces_carried_by_one_motion_in_other_words_are_told_apart_at_once,
        a_query_that_sets_maps_aside_and_runs_out_of_memory_can_go_on};
    return suite_main_with("aside", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
