/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scene_judge.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 48, STEPS = 240 };

static uint64_t random_state;

static double draw(double lo, double hi)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    const double s = (double)(random_state >> 11) * 0x1p-53, x = lo + s * (hi - lo);
    return x >= lo && x <= hi ? x : lo; /* also for infinite widths */
}

/* --- Points ----------------------------------------------------------------------------------- */

typedef struct point {
    double u, v, x[3], error; /* the exact point is no farther from x than error */
    size_t surface;
} point;

static bool evaluate(const imp_scene *scene, size_t body, double t, point *at)
{
    double e[3];
    const double p[3] = {at->u, at->v, t};
    if (imp_scene_eval(scene, body, at->surface, 1, p, at->x, e, NULL) != IMP_SUCCESS) return false;
    at->error = e[0] + e[1] + e[2];
    return true;
}

static double distance(const point *a, const point *b)
{
    return hypot(hypot(a->x[0] - b->x[0], a->x[1] - b->x[1]), a->x[2] - b->x[2]);
}

/* Bounds of the exact points' distance: 2^-48 covers the rounding of five operations. */
static double distance_lower(const point *a, const point *b)
{
    const double d = distance(a, b);
    return d - 0x1p-48 * d - a->error - b->error;
}

static double distance_upper(const point *a, const point *b)
{
    const double d = distance(a, b);
    return d + 0x1p-48 * d + a->error + b->error;
}

/* --- The witness ------------------------------------------------------------------------------ */

static point judge_side(const imp_scene *scene, const imp_side *side, double t)
{
    double lo[3], hi[3];
    point at = {.u = side->u, .v = side->v, .surface = side->surface};
    FUZZ_REQUIRE(side->body < imp_scene_body_count(scene));
    FUZZ_REQUIRE(side->surface < imp_scene_surface_count(scene, side->body));
    imp_scene_domain(scene, side->body, side->surface, lo, hi);
    FUZZ_REQUIRE(lo[0] <= at.u && at.u <= hi[0] && lo[1] <= at.v && at.v <= hi[1]);
    FUZZ_REQUIRE(lo[2] <= t && t <= hi[2]);
    FUZZ_REQUIRE(evaluate(scene, side->body, t, &at));
    for (int k = 0; k < 3; ++k) FUZZ_REQUIRE(fabs(at.x[k] - side->point[k]) <= 2 * at.error);
    return at;
}

static void judge_normal(const imp_result *r)
{
    double square = 0, along = 0;
    for (int k = 0; k < 3; ++k) {
        square += r->normal[k] * r->normal[k];
        along += r->normal[k] * (r->b.point[k] - r->a.point[k]);
    }
    FUZZ_REQUIRE(fabs(square - 1) <= 1e-12);
    FUZZ_REQUIRE(!(r->gap > 0) || along > 0);
}

static void judge_witness(const imp_scene *scene, const imp_result *r)
{
    FUZZ_REQUIRE(r->t == r->t_lower && r->a.body < r->b.body);
    FUZZ_REQUIRE(r->gap >= 0 && r->gap <= r->gamma);
    const point a = judge_side(scene, &r->a, r->t), b = judge_side(scene, &r->b, r->t);
    FUZZ_REQUIRE(distance_lower(&a, &b) <= r->gamma);
    FUZZ_REQUIRE(distance_lower(&a, &b) <= r->gap && r->gap <= distance_upper(&a, &b));
    if (r->has_normal) judge_normal(r);
}

/* --- Samples ---------------------------------------------------------------------------------- */

static bool sample(const imp_scene *scene, size_t body, double t, point *out)
{
    double lo[3], hi[3];
    const size_t count = imp_scene_surface_count(scene, body);
    if (count == 0) return false;
    out->surface = (size_t)draw(0, (double)count) % count;
    imp_scene_domain(scene, body, out->surface, lo, hi);
    if (!(lo[2] <= t && t <= hi[2])) return false;
    out->u = draw(lo[0], hi[0]), out->v = draw(lo[1], hi[1]);
    return evaluate(scene, body, t, out);
}

static double clamp(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

/* Another point of the same surface, `size` of its domain's width away at most. */
static bool move(const imp_scene *scene, size_t body, double t, double size, point *at)
{
    double lo[3], hi[3];
    imp_scene_domain(scene, body, at->surface, lo, hi);
    at->u = clamp(at->u + draw(-1, 1) * size * (hi[0] - lo[0]), lo[0], hi[0]);
    at->v = clamp(at->v + draw(-1, 1) * size * (hi[1] - lo[1]), lo[1], hi[1]);
    return evaluate(scene, body, t, at);
}

static void judge_distance(const point *a, const point *b, const imp_result *r)
{
    FUZZ_REQUIRE(!(distance_upper(a, b) < r->gamma_clear * (1 - 0x1p-40)));
}

/* Random search: the points move in turn, and the size of moves halves as it goes. */
static void approach(const imp_scene *scene, const imp_result *r, double t, point a, point b)
{
    double least = distance(&a, &b);
    for (int k = 0; k < STEPS && least > 0; ++k) {
        point x = a, y = b;
        const double size = ldexp(0.25, -k / 24);
        if (!move(scene, (size_t)k % 2, t, size, k % 2 == 0 ? &x : &y)) continue;
        if (!(distance(&x, &y) < least)) continue;
        a = x, b = y, least = distance(&a, &b);
    }
    judge_distance(&a, &b, r);
}

static void judge_samples(const imp_scene *scene, const imp_result *r)
{
    double nearest = INFINITY, t_nearest = 0;
    point best_a = {.surface = 0}, best_b = {.surface = 0};
    for (int k = 0; k < SAMPLES; ++k) {
        const double t = k == 0 ? r->t_start : draw(r->t_start, r->t_lower);
        point a, b;
        if (!(t < r->t_lower) || !sample(scene, 0, t, &a) || !sample(scene, 1, t, &b)) continue;
        judge_distance(&a, &b, r);
        if (!(distance(&a, &b) < nearest)) continue;
        nearest = distance(&a, &b), t_nearest = t;
        best_a = a, best_b = b;
    }
    if (nearest < INFINITY) approach(scene, r, t_nearest, best_a, best_b);
}

/* --- Answers ---------------------------------------------------------------------------------- */

static void judge_verdict(const imp_options *options, const imp_result *r)
{
    FUZZ_REQUIRE(r->t_start == options->t_start && r->t_end == options->t_end);
    FUZZ_REQUIRE(r->t_lower >= r->t_start && r->t_lower <= r->t_end);
    FUZZ_REQUIRE(r->reason != IMP_REASON_RUNNING);
    FUZZ_REQUIRE(r->verdict != IMP_VERDICT_CLEAR || r->t_lower == r->t_end);
    FUZZ_REQUIRE(r->verdict == IMP_VERDICT_CONTACT || (isnan(r->t) && isnan(r->gap)));
    FUZZ_REQUIRE((r->verdict == IMP_VERDICT_UNDECIDED) ==
                 (r->reason != IMP_REASON_NONE && r->reason != IMP_REASON_NO_TIME &&
                  r->reason != IMP_REASON_NO_PAIRS));
    FUZZ_REQUIRE(r->gamma_clear >= 0 && r->gamma_clear < r->gamma);
}

void scene_judge(const imp_scene *scene, const imp_options *options, const imp_result *r,
                 uint64_t seed)
{
    random_state = seed;
    judge_verdict(options, r);
    if (r->verdict == IMP_VERDICT_CONTACT) judge_witness(scene, r);
    if (imp_scene_ignores(scene, 0, 1))
        FUZZ_REQUIRE(r->verdict == IMP_VERDICT_CLEAR);
    else if (r->t_lower > r->t_start)
        judge_samples(scene, r);
}

void scene_judge_by_clearance(imp_scene *scene, const imp_options *options, const imp_result *r)
{
    imp_query *query = imp_clearance_new(scene, options, NULL, NULL);
    imp_clearance c;
    memset(&c, 0, sizeof c);
    c.struct_size = (uint32_t)sizeof c;
    if (query != NULL && imp_query_step(query, 0, NULL) == IMP_SUCCESS &&
        imp_clearance_get(query, 0, &c, NULL) == IMP_SUCCESS) {
        const double slack = r->verdict == IMP_VERDICT_CONTACT ? 0x1p-40 * r->gap : 0;
        if (r->verdict == IMP_VERDICT_CONTACT) FUZZ_REQUIRE(!(c.lower > r->gap + slack));
        if (r->verdict == IMP_VERDICT_CLEAR && c.has_witness)
            FUZZ_REQUIRE(!(c.upper < r->gamma_clear * (1 - 0x1p-40)));
        FUZZ_REQUIRE(!(c.lower > c.upper));
    }
    imp_query_free(query);
}
