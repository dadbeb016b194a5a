/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/distances.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/check/closed.h"
#include "tools/check/motions.h"
#include "tools/check/moving_point.h"
#include "tools/check/nearest.h"

/* Near the surface, spread evenly over it: a spot of 0.03 % of it is met; and far from it. */
enum { NEAR = 16000, FAR = 2500, OTHERS = 2 };

/* How far, in radii of the surface: distances up to 2^20. */
enum { DECADES_DOWN = -30, DECADES_UP = 20 };

/* Times of a surface without end: up to 2^14 after its first ones, or before its last. */
enum { LATE = 14 };

/* --- Where points are drawn ------------------------------------------------------------------- */

typedef struct hunt {
    const subject *s;
    uint64_t *random;
    imp_symmetry symmetry;
    bool has_symmetry;
    double shift[BOX_DIMS]; /* begins the even spread of points near the surface */
    double radius;          /* of the surface, at first; length */
} hunt;

/* About normal to the surface at p, or any direction where it has no normal. */
static void draw_normal(const hunt *h, const double p[3], double n[3])
{
    const subject *s = h->s;
    double difference[2][3], length = 0;
    for (int j = 0; j < 2; ++j) {
        const double step = 0x1p-16 * (s->domain.hi[j] - s->domain.lo[j]);
        spot ends[2];
        memcpy(ends[0].p, p, sizeof ends[0].p);
        memcpy(ends[1].p, p, sizeof ends[1].p);
        ends[0].p[j] = p[j] - step > s->domain.lo[j] ? p[j] - step : p[j];
        ends[1].p[j] = p[j] + step < s->domain.hi[j] ? p[j] + step : p[j];
        const bool known = spot_evaluate(s, &ends[0]) && spot_evaluate(s, &ends[1]);
        for (int i = 0; i < 3; ++i) difference[j][i] = known ? ends[1].x[i] - ends[0].x[i] : 0;
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = difference[0][j] * difference[1][k] - difference[0][k] * difference[1][j];
        length += n[i] * n[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3; ++i)
        n[i] = length > 0 ? n[i] / length : random_between(h->random, -1, 1);
}

/* Any direction, or along or across the axis of the symmetry, or along an axis of space. */
static void draw_direction(const hunt *h, double n[3])
{
    const size_t kind = draw_index(h->random, h->has_symmetry ? 4 : 2);
    const double *axis = h->symmetry.axis;
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        n[i] = random_between(h->random, -1, 1);
        most = fmax(most, fabs(axis[i]));
    }
    if (kind == 1) {
        const size_t along = draw_index(h->random, 3);
        for (size_t i = 0; i < 3; ++i) n[i] = i == along;
    }
    if (kind < 2 || !(most > 0)) return;
    double square = 0, dot = 0;
    for (int i = 0; i < 3; ++i) {
        square += (axis[i] / most) * (axis[i] / most);
        dot += n[i] * (axis[i] / most);
    }
    for (int i = 0; i < 3; ++i)
        n[i] = kind == 2 ? axis[i] / most : n[i] - dot / square * (axis[i] / most);
}

/* Times of sixteenths, so that those of the steps -1, -1/2 ... 1 are exact; or one moment. Early
 * ones, or late ones where the surface lasts. */
static imp_region draw_region(const hunt *h)
{
    const subject *s = h->s;
    double from = ceil(16 * s->domain.lo[2]) / 16, to = floor(16 * s->domain.hi[2]) / 16;
    const double t = s->domain.lo[2], width = random_power(h->random, -8, 0);
    const double late = floor(random_power(h->random, 0, LATE));
    const bool is_late = draw_index(h->random, 2) > 0;
    if (!(from < to)) return imp_region_between((double[3]){-1, -1, t}, (double[3]){1, 1, t});
    const bool lasts = s->ends[1] == INFINITY, has_begun = s->ends[0] == -INFINITY;
    const bool is_after = lasts && (!has_begun || draw_index(h->random, 2) > 0);
    if (is_late && (lasts || has_begun)) {
        from += is_after ? late : -late;
        to += is_after ? late : -late;
    }
    const double end = from + ceil(16 * width * (to - from)) / 16;
    return imp_region_between((double[3]){-1, -1, from}, (double[3]){1, 1, end < to ? end : to});
}

/* --- Judging ---------------------------------------------------------------------------------- */

static bool judge_symmetry(const subject *s, const imp_symmetry *found)
{
    const uint32_t of_axis = IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_V | IMP_SYMMETRY_ZONE,
                   of_ball = IMP_SYMMETRY_ORBIT_ALL | IMP_SYMMETRY_ZONE,
                   closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ZONE,
                   flags = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_NEARLY | of_axis | of_ball;
    const bool is_nearly = (found->is_closed & IMP_SYMMETRY_NEARLY) != 0;
    const bool is_ball = found->kind == IMP_SYMMETRY_ABOUT_POINT;
    bool sane = found->kind >= IMP_SYMMETRY_ABOUT_POINT && found->kind <= IMP_SYMMETRY_SCREW_LEFT;
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        sane = sane && isfinite(found->center[i]) && isfinite(found->axis[i]);
        most = fmax(most, fabs(found->axis[i]));
    }
    sane = sane && found->is_closed <= flags && (is_ball || (found->is_closed & of_ball) == 0) &&
           (found->kind <= IMP_SYMMETRY_ACROSS_LINE || found->is_closed <= IMP_SYMMETRY_CLOSED);
    sane = sane && (!is_nearly || (found->is_closed & closed) != 0);
    const bool has_axis = !is_ball || (found->is_closed & of_axis) != 0;
    sane = sane && (!has_axis || (most >= 1e-100 && most <= 1e100));
    return sane ||
           answer_fail(s->answer, "the symmetry has an unknown kind or flag, a center or an axis "
                                  "that is not finite, or an axis without length");
}

typedef struct passage {
    imp_region region; /* of the point's parameters */
    double at[3];      /* a place of it, in [-1, 1] */
    double t;          /* the time there */
    double x[3];       /* the point there */
    double size;       /* of what surrounds the point; length */
    spot nearest;      /* of the surface, to x */
    imp_model in[4];   /* of x, moved perhaps */
    imp_model g;
} passage;

static subject_text place_text(const double x[3])
{
    subject_text t;
    snprintf(t.text, sizeof t.text, "(%.17g, %.17g, %.17g)", x[0], x[1], x[2]);
    return t;
}

static bool refute_distance(const subject *s, const passage *way, long double claimed,
                            const double x[3], const spot *on)
{
    return answer_fail_for(
        s->answer, FAULT_ERROR,
        "distance claims at least %.17Lg for the point %s, which is %.17Lg from the "
        "surface's point at %s: its model is %.17g + ... +- %.9g in [%.17g, %.17g]",
        claimed, place_text(x).text, spot_apart_upper(on, x), subject_point_text(3, on->p).text,
        way->g.a, way->g.e, way->g.lo, way->g.hi);
}

/* A distance holds for x and all surface points. */
static bool judge_distance(const subject *s, const passage *way, const double at[3],
                           const double x[3], const spot *on)
{
    const long double claimed = distance_claimed(&way->g, at);
    ++s->answer->tests;
    return !(claimed > spot_apart_upper(on, x)) || refute_distance(s, way, claimed, x, on);
}

/* A distance of `moved`, which is where the motion takes way->x, holds for that, too. */
static bool judge_motion(const subject *s, const passage *way, const motion *m,
                         const double moved[3])
{
    const long double claimed = distance_claimed(&way->g, way->at);
    long double size = 0;
    for (int i = 0; i < 3; ++i)
        size += fabsl((long double)way->x[i] - m->center[i]) + fabsl((long double)m->center[i]) +
                fabsl((long double)m->shift[i]) + fabsl((long double)way->x[i]);
    ++s->answer->tests;
    if (!(claimed > spot_apart_upper(&way->nearest, way->x) + 0x1p-48L * size)) return true;
    return answer_fail_for(
        s->answer, FAULT_ERROR,
        "symmetry allows %s, which takes the point %s to %s; there distance claims "
        "at least %.17Lg, but before it is %.17Lg from the surface's point at %s",
        motion_text(m).text, place_text(way->x).text, place_text(moved).text, claimed,
        spot_apart_upper(&way->nearest, way->x), subject_point_text(3, way->nearest.p).text);
}

/* Some of the surface's points at the time of `at`, and places of the region that differ in u and
 * v. */
static bool judge_others(const hunt *h, const passage *way)
{
    for (int k = 0; k < OTHERS; ++k) {
        const double at[3] = {draw_normalized(h->random), draw_normalized(h->random), way->at[2]};
        double x[3];
        spot on;
        draw_point(h->random, &h->s->domain, 2, on.p);
        on.p[2] = way->t;
        for (int i = 0; i < 3; ++i) x[i] = (double)model_value(&way->in[i], at);
        if (!spot_evaluate(h->s, &on)) continue;
        for (int i = 0; i < 3; ++i) on.error += 0x1p-52 * fabs(x[i]);
        if (!judge_distance(h->s, way, at, x, &on)) return false;
    }
    return true;
}

/* A point beside the k-th of points spread evenly over the surface. False: there is none. */
static bool draw_near(const hunt *h, uint64_t k, passage *way)
{
    const subject *s = h->s;
    double place[BOX_DIMS], n[3];
    draw_spread(h->shift, k, 3, place);
    for (int j = 0; j < 2; ++j)
        way->nearest.p[j] = s->domain.lo[j] + place[j] * (s->domain.hi[j] - s->domain.lo[j]);
    way->nearest.p[2] = way->t;
    if (!spot_evaluate(s, &way->nearest)) return false;
    draw_normal(h, way->nearest.p, n);
    const double side = draw_index(h->random, 2) > 0 ? 1 : -1;
    way->size = h->radius * random_power(h->random, -12, 1);
    const double off =
        draw_index(h->random, 3) > 0 ? way->size * random_power(h->random, DECADES_DOWN, 0) : 0;
    for (int i = 0; i < 3; ++i) way->x[i] = way->nearest.x[i] + side * off * n[i];
    return true;
}

/* A point at any distance from the surface's middle, the symmetry's center, or a point of it. */
static bool draw_far(const hunt *h, passage *way)
{
    double from[3], n[3], radius;
    if (!spot_extent(h->s, way->t, from, &radius)) return false;
    const size_t origin = draw_index(h->random, 3);
    draw_direction(h, n);
    if (origin == 1 && h->has_symmetry) memcpy(from, h->symmetry.center, sizeof from);
    if (origin == 2) {
        spot on;
        draw_point(h->random, &h->s->domain, 2, on.p);
        on.p[2] = way->t;
        if (!spot_evaluate(h->s, &on)) return false;
        memcpy(from, on.x, sizeof from);
        if (draw_index(h->random, 2) > 0) draw_normal(h, on.p, n);
    }
    const double side = draw_index(h->random, 2) > 0 ? 1 : -1;
    const double scale = radius > 0 ? radius : 1;
    const double off = scale * random_power(h->random, DECADES_DOWN / 3, DECADES_UP);
    for (int i = 0; i < 3; ++i) way->x[i] = from[i] + side * off * n[i];
    way->size = radius + off;
    return spot_nearest(h->s, way->x, way->t, &way->nearest);
}

static bool ask(const subject *s, passage *way)
{
    const imp_status status = subject_distance(s, way->in, &way->g);
    if (status == IMP_STATUS_UNBOUNDED) return false;
    if (status != IMP_STATUS_OK)
        return answer_fail(s->answer, "distance returned '%s'", subject_status_name(status));
    return distance_has_form(s, &way->g);
}

/* Judges the claim about one point, or about a point that a motion of the symmetry has moved: a
 * fault there is the distance's own, if the moved point is nearer than claimed, and else the
 * symmetry's. */
static bool judge_passage(const hunt *h, bool is_near, uint64_t k)
{
    const subject *s = h->s;
    passage way = {.region = draw_region(h)};
    const double step = way.region.d[2] > 0 ? (double)draw_index(h->random, 5) / 2 - 1 : 0;
    way.at[0] = draw_normalized(h->random);
    way.at[1] = draw_normalized(h->random);
    way.at[2] = step;
    way.t = way.region.c[2] + way.region.d[2] * step;
    if (is_near ? !draw_near(h, k, &way) : !draw_far(h, &way)) return true;
    double moved[3] = {way.x[0], way.x[1], way.x[2]};
    motion m;
    const bool moves = h->has_symmetry && draw_index(h->random, is_near ? 8 : 2) == 0;
    if (moves) {
        m = motion_draw(h->random, &h->symmetry, way.size);
        motion_apply(&m, moved);
    }
    for (int i = 0; i < 3; ++i) way.in[i] = model_through(h->random, moved[i], way.size, way.at);
    way.in[3] = imp_param(&way.region, 2);
    if (!ask(s, &way)) return s->answer->verdict != CHECK_FAIL;
    spot on = way.nearest;
    if (moves && !spot_nearest(s, moved, way.t, &on)) return true;
    return judge_distance(s, &way, way.at, moved, &on) &&
           (!moves || judge_motion(s, &way, &m, moved)) && judge_others(h, &way);
}

void distances_check(const subject *s, uint64_t *random, double effort)
{
    hunt h = {.s = s, .random = random};
    if (!subject_has_distance(s)) {
        answer_skip(s->answer, "the type has no distance");
        return;
    }
    for (int j = 0; j < BOX_DIMS; ++j) h.shift[j] = random_between(random, 0, 1);
    const imp_status status = subject_symmetry(s, &h.symmetry);
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) {
        answer_fail(s->answer, "symmetry returned '%s'", subject_status_name(status));
        return;
    }
    h.has_symmetry = status == IMP_STATUS_OK;
    if (h.has_symmetry && !judge_symmetry(s, &h.symmetry)) return;
    const uint32_t closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ZONE;
    const bool is_closed = h.has_symmetry && (h.symmetry.is_closed & closed) != 0;
    if (is_closed && !closed_check(s, random, &h.symmetry)) return;
    if (h.has_symmetry && !orbit_check(s, random, &h.symmetry)) return;
    double middle[3];
    if (!spot_extent(s, s->domain.lo[2], middle, &h.radius) || !(h.radius > 0)) h.radius = 1;
    uint64_t k = 0;
    while ((double)k < NEAR * effort && judge_passage(&h, true, k)) ++k;
    while (s->answer->verdict != CHECK_FAIL && (double)k < (NEAR + FAR) * effort &&
           judge_passage(&h, false, k))
        ++k;
    if (s->answer->verdict == CHECK_PASS && s->answer->tests == 0)
        answer_skip(s->answer, "it has no distance with these parameters");
}
