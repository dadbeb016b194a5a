/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_scenes.h"

/* Surveys of random scenes against an adversary that samples poses densely and improves each by
 * descent in all values, time and both points at once: nothing that it finds may be nearer than
 * what is proved, of any box and of the whole. */

enum { TOLD_MAX = 48, COARSE = 5, PIECES_MAX = 8, STEPS = 90, POLISH = 600 };

/* Where the adversary may look. */
typedef struct region_box {
    double lo[VALUES_MAX], hi[VALUES_MAX], time[2];
} region_box;

typedef struct told_box {
    region_box in;
    double lower;
    size_t body[2];
} told_box;

typedef struct told_boxes {
    told_box at[TOLD_MAX];
    size_t count, seen;
    uint64_t *random;
} told_boxes;

/* Two points at some values: what the descent moves. */
typedef struct placed {
    double value[VALUES_MAX], t;
    imp_place at[2];
    double uv[2][2];
} placed;

/* Keeps some of the boxes, each with the same chance. */
static void keep_box(void *context, const imp_survey_box *box)
{
    told_boxes *all = context;
    if (box->verdict != IMP_VERDICT_CLEAR) return;
    const size_t seen = all->seen++;
    const size_t k =
        seen < TOLD_MAX ? seen : (size_t)(random_fraction(all->random) * (double)(seen + 1));
    if (k >= TOLD_MAX) return;
    told_box *to = &all->at[k];
    if (k == all->count) all->count += 1;
    ck_assert_uint_le(box->count, VALUES_MAX);
    memcpy(to->in.lo, box->lo, box->count * sizeof *box->lo);
    memcpy(to->in.hi, box->hi, box->count * sizeof *box->hi);
    memcpy(to->body, box->body, sizeof to->body);
    to->in.time[0] = box->t_start, to->in.time[1] = box->t_end;
    to->lower = box->lower;
}

/* --- Two points ----------------------------------------------------------------------------- */

static imp_scene *pose(const imp_scene *scene, const double *values)
{
    imp_error error;
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    return at;
}

/* Evaluates a point; its error is added to *inexact. */
static void point_of(const imp_scene *posed, imp_place at, const double uv[2], double t,
                     double x[3], double *inexact)
{
    const double p[3] = {uv[0], uv[1], t};
    double error[3];
    ck_assert_int_eq(imp_piece_eval(posed, at, 1, p, x, error, NULL), IMP_SUCCESS);
    *inexact += error[0] + error[1] + error[2];
}

/* Returns a distance that the two points certainly do not exceed. */
static double distance_upper(const imp_scene *posed, const placed *p)
{
    double x[2][3], inexact = 0;
    for (int k = 0; k < 2; ++k) point_of(posed, p->at[k], p->uv[k], p->t, x[k], &inexact);
    return (query_distance(x[0], x[1]) + inexact) * (1 + 1e-15);
}

/* --- Samples -------------------------------------------------------------------------------- */

typedef struct sample {
    double x[3], uv[2];
    size_t piece;
} sample;

static int sample_body(const imp_scene *posed, size_t body, double t, sample *to)
{
    int count = 0;
    for (size_t k = 0; k < imp_scene_piece_count(posed, body, 0) && k < PIECES_MAX; ++k) {
        double lo[3], hi[3], inexact = 0;
        imp_piece_domain(posed, (imp_place){body, 0, k}, lo, hi);
        for (int i = 0; i < COARSE * COARSE; ++i) {
            sample *s = &to[count++];
            s->piece = k;
            s->uv[0] = lo[0] + (hi[0] - lo[0]) * (i / COARSE) / (COARSE - 1);
            s->uv[1] = lo[1] + (hi[1] - lo[1]) * (i % COARSE) / (COARSE - 1);
            point_of(posed, (imp_place){body, 0, k}, s->uv, t, s->x, &inexact);
        }
    }
    return count;
}

/* Places two points where grids over both bodies are nearest. */
static void place_points(const imp_scene *posed, const size_t body[2], placed *p)
{
    static sample all[2][COARSE * COARSE * PIECES_MAX];
    double least = INFINITY;
    const int count[2] = {sample_body(posed, body[0], p->t, all[0]),
                          sample_body(posed, body[1], p->t, all[1])};
    for (int i = 0; i < count[0]; ++i)
        for (int j = 0; j < count[1]; ++j) {
            const sample *of[2] = {&all[0][i], &all[1][j]};
            const double d = query_distance(of[0]->x, of[1]->x);
            if (!(d < least)) continue;
            least = d;
            for (int k = 0; k < 2; ++k) {
                p->at[k] = (imp_place){body[k], 0, of[k]->piece};
                memcpy(p->uv[k], of[k]->uv, sizeof p->uv[k]);
            }
        }
}

/* --- Descent -------------------------------------------------------------------------------- */

static double moved(uint64_t *r, double x, double lo, double hi, double step)
{
    const double to = x + step * (hi - lo) * within(r, 1);
    return to < lo ? lo : to > hi ? hi : to;
}

/* Moves points, or values and time as well, or one value alone. */
static placed move_some(uint64_t *r, const imp_scene *posed, const placed *from, size_t count,
                        const region_box *in, double step, bool *turns)
{
    placed to = *from;
    const int kind = one_of(r, 4);
    const size_t alone = (size_t)one_of(r, (int)count + 1);
    *turns = kind < 2;
    for (size_t j = 0; *turns && j < count; ++j)
        if (kind == 0 || j == alone)
            to.value[j] = moved(r, to.value[j], in->lo[j], in->hi[j], step);
    if (*turns && (kind == 0 || alone == count))
        to.t = moved(r, to.t, in->time[0], in->time[1], step);
    for (int k = 0; k < 2 && kind != 1; ++k) {
        double lo[3], hi[3];
        imp_piece_domain(posed, to.at[k], lo, hi);
        for (int i = 0; i < 2; ++i) to.uv[k][i] = moved(r, to.uv[k][i], lo[i], hi[i], 0.5 * step);
    }
    return to;
}

/* Improves the points by random steps, which grow where they help and shrink where they do not. */
static double descend(uint64_t *r, const imp_scene *scene, placed *p, const region_box *in,
                      int steps)
{
    const size_t count = imp_scene_parameter_count(scene);
    imp_scene *posed = pose(scene, p->value);
    double least = distance_upper(posed, p), step = 0.5;
    for (int k = 0; k < steps; ++k) {
        bool turns;
        const placed to = move_some(r, posed, p, count, in, step, &turns);
        imp_scene *at = turns ? pose(scene, to.value) : posed;
        const double d = distance_upper(at, &to);
        const bool better = d < least;
        if (turns) imp_scene_free(better ? posed : at);
        step *= better ? 1.6 : 0.9;
        if (step < 1e-9) step = 0.1;
        if (!better) continue;
        least = d;
        *p = to;
        posed = at;
    }
    imp_scene_free(posed);
    return least;
}

/* Returns the nearest found from one random start; the worst values of a box are mostly at a
 * corner. */
static double attack(uint64_t *r, const imp_scene *scene, const size_t body[2],
                     const region_box *in, placed *p)
{
    const bool at_corner = random_fraction(r) < 0.5;
    for (size_t j = 0; j < imp_scene_parameter_count(scene); ++j)
        p->value[j] = at_corner ? (random_fraction(r) < 0.5 ? in->lo[j] : in->hi[j])
                                : random_between(r, in->lo[j], in->hi[j]);
    p->t = random_between(r, in->time[0], in->time[1]);
    imp_scene *posed = pose(scene, p->value);
    place_points(posed, body, p);
    imp_scene_free(posed);
    return descend(r, scene, p, in, STEPS);
}

/* --- All pairs of bodies -------------------------------------------------------------------- */

static bool follows_any(const imp_scene *scene, size_t body)
{
    for (size_t j = 0; j < imp_scene_parameter_count(scene); ++j)
        if (imp_scene_follows(scene, body, j)) return true;
    return false;
}

/* Whether a box of these bodies is about a and b. */
static bool is_about(const imp_scene *scene, const size_t body[2], size_t a, size_t b)
{
    if (imp_scene_surface_count(scene, a) == 0 || imp_scene_surface_count(scene, b) == 0)
        return false;
    if (body[0] != SIZE_MAX) return body[0] == a && body[1] == b;
    return !follows_any(scene, a) && !follows_any(scene, b);
}

static region_box whole_of(const imp_scene *scene)
{
    region_box all = {.time = {0, 1}};
    imp_scene_parameter_info info;
    for (size_t j = 0; imp_scene_parameter(scene, j, &info); ++j)
        all.lo[j] = info.lo, all.hi[j] = info.hi;
    return all;
}

/* Returns the nearest found of the bodies that a box is about; `all`: of all bodies. */
static double nearest_found(uint64_t *r, const imp_scene *scene, const size_t *body,
                            const region_box *in, int starts)
{
    double least = INFINITY;
    placed best;
    for (size_t a = 0; a < imp_scene_body_count(scene); ++a)
        for (size_t b = a + 1; b < imp_scene_body_count(scene); ++b) {
            const size_t both[2] = {a, b};
            if (!is_about(scene, body != NULL ? body : both, a, b)) continue;
            for (int k = 0; k < starts; ++k) {
                placed p;
                const double d = attack(r, scene, both, in, &p);
                if (d < least) least = d, best = p;
            }
        }
    return starts > 1 && least < INFINITY ? descend(r, scene, &best, in, POLISH) : least;
}

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

START_TEST(no_pose_that_a_descent_finds_is_nearer_than_a_proved_bound)
{
    uint64_t random = suite_seed() + 7919 * (uint64_t)_i;
    static told_boxes boxes;
    static scene_writer w;
    const int scenes = suite_times(18);
    size_t proved = 0;
    for (int n = 0; n < scenes; ++n) {
        const int kind = n % KINDS;
        double least;
        imp_scene *scene = write_near(&w, &random, random_power(&random, -6, 0), false, &least);
        boxes = (told_boxes){.random = &random};
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
    ck_assert_uint_gt(proved, (size_t)scenes); /* the test tries something */
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
    const int scenes = suite_times(12);
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
    ck_assert_int_ge(3 * tight, counted);
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
