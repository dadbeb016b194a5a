/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/pose_descent.h"

/* Surveys of random scenes against an adversary that samples poses densely and improves each by
 * descent in all values, time and both points at once: nothing that it finds may be nearer than
 * what is proved, of any box and of the whole. */

enum { TOLD = 48 }; /* boxes of a survey that are tried */

/* Writes a random scene whose bodies come near each other, mostly: it is written again, from the
 * random numbers drawn before, with bodies closer by most of the distance found. */
static imp_scene *write_near(scene_writer *w, uint64_t *r, double wide, bool is_rigid,
                             double *least)
{
    const uint64_t drawn = *r;
    double apart = 3;
    for (int round = 0;; ++round) {
        *r = drawn;
        imp_scene *scene = write_scene(w, r, wide, apart, is_rigid);
        const region_box all = whole_of(scene);
        *least = nearest_found(r, scene, NULL, &all, round < 2 ? 2 : 8);
        if (round == 2) return scene;
        imp_scene_free(scene);
        apart -= 0.9 * (*least - wide * random_between(r, 0.2, 2));
    }
}

/* --- Questions ------------------------------------------------------------------------------ */

/* Whether the values and points that an answer names are what it says. */
static void check_witness(const imp_scene *scene, const answer *found, const imp_side *a,
                          const imp_side *b, double t, double most, const char *text)
{
    const region_box all = whole_of(scene);
    const imp_side *side[2] = {a, b};
    placed p = {.t = t};
    for (size_t j = 0; j < imp_scene_parameter_count(scene); ++j) {
        ck_assert(found->values[j] >= all.lo[j] && found->values[j] <= all.hi[j]);
        p.value[j] = found->values[j];
    }
    for (int k = 0; k < 2; ++k) {
        p.at[k] = (imp_place){side[k]->body, side[k]->surface, side[k]->piece};
        p.uv[k][0] = side[k]->u, p.uv[k][1] = side[k]->v;
    }
    imp_scene *posed = pose(scene, p.value);
    const double d = distance_upper(posed, &p);
    imp_scene_free(posed);
    ck_assert_msg(d <= most * (1 + 1e-9) + 1e-12, "%.17g of the witness, not %.17g: %s", d, most,
                  text);
}

/* Kinds of questions: the earliest contact, a requirement, a bracket. Each is asked about a
 * distance near the least one that the adversary knows, where bounds are tried at their limit. */
enum { CONTACT, REQUIREMENT, BRACKET, KINDS };

static answer ask_survey(imp_scene *scene, int kind, double near, told_boxes *boxes)
{
    imp_survey_options how = imp_survey_options_default();
    imp_clearance_options asked = imp_clearance_options_default();
    const double least = near > 0.01 ? near : 0.01;
    how.sink = keep_box;
    how.sink_context = boxes;
    how.max_boxes = 40;
    asked.tolerance = 0.2;
    asked.decide = kind == REQUIREMENT;
    asked.required = kind == REQUIREMENT ? least : 0;
    return survey(scene, kind == CONTACT ? 2 * least : 0.02, kind == CONTACT ? NULL : &asked, &how);
}

/* The whole answer against the least distance found anywhere. */
static void check_answer(uint64_t *r, const imp_scene *scene, int kind, double least,
                         const answer *found, const char *text)
{
    const imp_clearance *near = &found->near;
    if (kind != CONTACT) {
        ck_assert_msg(least >= near->lower, "%.17g, but %.17g is proved: %s", least, near->lower,
                      text);
        if (near->has_witness && near->kind != IMP_CONTACT_INSIDE)
            check_witness(scene, found, &near->a, &near->b, near->t, near->upper, text);
        return;
    }
    region_box before = whole_of(scene);
    const imp_result *c = &found->contact;
    if (c->t_lower > 0) {
        before.time[1] = nextafter(c->t_lower, 0);
        const double d =
            c->verdict == IMP_VERDICT_CLEAR ? least : nearest_found(r, scene, NULL, &before, 2);
        ck_assert_msg(d >= c->gamma_clear, "%.17g before %.17g: %s", d, c->t_lower, text);
    }
    if (c->verdict == IMP_VERDICT_CONTACT && c->kind != IMP_CONTACT_INSIDE)
        check_witness(scene, found, &c->a, &c->b, c->t, c->gamma, text);
}

/* Scenes of each loop. With fewer, as in builds with sanitizers, nothing is asked of how much they
 * prove, which says something of many scenes only. */
enum { SCENES = 18, STRAINED_SCENES = 12 };

START_TEST(no_pose_that_a_descent_finds_is_nearer_than_a_proved_bound)
{
    uint64_t random = suite_seed() + 7919 * (uint64_t)_i;
    static told_boxes boxes;
    static scene_writer w;
    const int scenes = suite_times(SCENES);
    size_t proved = 0;
    for (int n = 0; n < scenes; ++n) {
        const int kind = n % KINDS;
        double least;
        imp_scene *scene = write_near(&w, &random, random_power(&random, -6, 0), false, &least);
        boxes = (told_boxes){.random = &random, .most = TOLD};
        const answer found =
            ask_survey(scene, kind, least * random_between(&random, 0.4, 1.02), &boxes);
        check_answer(&random, scene, kind, least, &found, w.text);
        for (size_t k = 0; k < boxes.count; ++k) {
            const told_box *box = &boxes.at[k];
            const double d = nearest_found(&random, scene, box->body, &box->in, 1);
            ck_assert_msg(d >= box->lower, "%.17g in a box of which %.17g is proved: %s", d,
                          box->lower, w.text);
        }
        proved += boxes.seen;
        imp_scene_free(scene);
    }
    if (scenes >= SCENES) ck_assert_uint_gt(proved, (size_t)scenes); /* the test tries something */
    if (getenv("IMPINGE_TEST_COUNT") != NULL)
        printf("%d scenes, %zu boxes proved\n", scenes, proved);
}
END_TEST

/* The distance that a survey of few boxes proves; 0: not what is required. */
static double proved_by(imp_scene *scene, double required, uint64_t boxes)
{
    imp_survey_options how = imp_survey_options_default();
    imp_clearance_options asked = imp_clearance_options_default();
    how.max_boxes = boxes;
    asked.decide = true;
    asked.required = required;
    return survey(scene, 1e-3, &asked, &how).near.lower;
}

enum { HALVINGS = 7, BOXES_EACH = 4 };

/* The bounds are strained most by the greatest distance that they prove: where a box has no room to
 * spare, an adversary has to come near to it. Gaps are about as wide as the values move bodies. */
START_TEST(the_most_that_few_boxes_prove_is_kept_by_all_poses)
{
    uint64_t random = suite_seed() + 104729 * (uint64_t)(_i + 1);
    static scene_writer w;
    const int scenes = suite_times(STRAINED_SCENES);
    int counted = 0, tight = 0;
    for (int n = 0; n < scenes; ++n) {
        double least;
        imp_scene *scene =
            write_near(&w, &random, random_power(&random, -6, -2), n % 3 != 0, &least);
        const uint64_t boxes = imp_scene_pair_count(scene) * (n % 2 == 0 ? 1 : BOXES_EACH);
        double lo = 0.7 * least, hi = 1.1 * least;
        for (int k = 0; k < HALVINGS && least > 1e-3; ++k) {
            const double mid = 0.5 * lo + 0.5 * hi;
            const double lower = proved_by(scene, mid, boxes);
            ck_assert_msg(least >= lower, "%.17g found, %.17g proved: %s", least, lower, w.text);
            *(lower > 0 ? &lo : &hi) = mid;
        }
        if (least > 1e-3) counted += 1, tight += lo > 0.8 * least;
        imp_scene_free(scene);
    }
    if (scenes >= STRAINED_SCENES) ck_assert_int_ge(3 * tight, counted);
    if (getenv("IMPINGE_TEST_COUNT") != NULL)
        printf("%d scenes, 0.8 of the least distance proved of %d\n", counted, tight);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {{no_pose_that_a_descent_finds_is_nearer_than_a_proved_bound, 4},
                                {the_most_that_few_boxes_prove_is_kept_by_all_poses, 4}};
    return suite_main_loops("survey_descent", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
