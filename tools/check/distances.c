/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/distances.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>
#include <string.h>

enum { PASSAGES = 2000, OTHERS = 4 };

/* --- A point that moves ------------------------------------------------------------------------ */

/* Polynomial of a model at s, in long double: 20 roundings at most, each of a partial sum below the size. */
static long double value_at(const imp_model *m, const double s[3])
{
    const long double u = s[0], v = s[1], t = s[2];
    return (long double)m->a + (m->b[0] * u + m->b[1] * v + m->b[2] * t) +
           (m->q[IMP_UU] * u * u + m->q[IMP_UV] * u * v + m->q[IMP_UT] * u * t) +
           (m->q[IMP_VV] * v * v + m->q[IMP_VT] * v * t + m->q[IMP_TT] * t * t);
}

/* Of a polynomial through `x` at s, at any scale; the point is up to `off` from it there. */
static imp_model draw_model(uint64_t *random, double x, const double s[3])
{
    imp_model m = {.rate = {INFINITY, INFINITY, INFINITY}, .depends = 7};
    const double scale = draw_index(random, 4) > 0 ? random_power(random, -30, 1) : 0;
    const double bend = draw_index(random, 2) > 0 ? random_power(random, -12, 0) : 0;
    for (int j = 0; j < 3; ++j) m.b[j] = scale * draw_normalized(random);
    for (int k = 0; k < 6; ++k) m.q[k] = scale * bend * draw_normalized(random);
    const double off = draw_index(random, 2) > 0 ? scale * bend * draw_normalized(random) : 0;
    m.a = x - (double)value_at(&m, s) + off;
    m.e = fabs(off) + 0x1p-50 * (fabs(x) + imp_model_size(&m));
    const imp_interval range = imp_model_poly_range(&m);
    m.lo = range.lo;
    m.hi = range.hi;
    return m;
}

/* --- Points of the surface ----------------------------------------------------------------------- */

typedef struct spot {
    double x[3], error; /* error: of all coordinates together, at most */
} spot;

static bool spot_at(const subject *s, const double p[3], spot *at)
{
    double error[3];
    if (!subject_eval_sane(s, 1, p, at->x, error)) return false;
    at->error = error[0] + error[1] + error[2];
    return true;
}

/* A direction, about normal to the surface at p where it has one. */
static bool draw_direction(const subject *s, uint64_t *random, const double p[3], double n[3])
{
    double difference[2][3];
    for (int j = 0; j < 2; ++j) {
        const double step = 0x1p-16 * (s->domain.hi[j] - s->domain.lo[j]);
        double from[3] = {p[0], p[1], p[2]}, to[3] = {p[0], p[1], p[2]};
        spot ends[2];
        from[j] = p[j] - step > s->domain.lo[j] ? p[j] - step : p[j];
        to[j] = p[j] + step < s->domain.hi[j] ? p[j] + step : p[j];
        if (!spot_at(s, from, &ends[0]) || !spot_at(s, to, &ends[1])) return false;
        for (int i = 0; i < 3; ++i) difference[j][i] = ends[1].x[i] - ends[0].x[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = difference[0][j] * difference[1][k] - difference[0][k] * difference[1][j];
    }
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0)) {
        for (int i = 0; i < 3; ++i) n[i] = random_between(random, -1, 1);
        length = 1;
    }
    const double sign = draw_index(random, 2) > 0 ? 1 : -1;
    for (int i = 0; i < 3; ++i) n[i] *= sign / length;
    return true;
}

/* --- Motions of its symmetry --------------------------------------------------------------------- */

static bool judge_symmetry(const subject *s, const imp_symmetry *found)
{
    bool sane = found->kind >= IMP_SYMMETRIC_ABOUT_POINT && found->kind <= IMP_SYMMETRIC_ACROSS_LINE;
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        sane = sane && isfinite(found->center[i]) && isfinite(found->axis[i]);
        most = fmax(most, fabs(found->axis[i]));
    }
    sane = sane && (found->kind == IMP_SYMMETRIC_ABOUT_POINT || (most >= 1e-100 && most <= 1e100));
    return sane || answer_fail(s->answer, "the symmetry has an unknown kind, a center or an axis that is "
                                          "not finite, or an axis without length");
}

/* x turned about the unit vector n (Rodrigues). */
static void turn(const long double n[3], long double angle, long double x[3])
{
    const long double c = cosl(angle), s = sinl(angle), along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
    const long double w[3] = {x[0], x[1], x[2]};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = c * w[i] + s * (n[j] * w[k] - n[k] * w[j]) + (1 - c) * along * n[i];
    }
}

static void draw_unit(uint64_t *random, const double axis[3], long double n[3])
{
    long double square = 0, most = 0;
    for (int i = 0; i < 3; ++i) {
        n[i] = axis != NULL ? axis[i] : random_between(random, 0.1, 1);
        most = fmaxl(most, fabsl(n[i]));
    }
    for (int i = 0; i < 3; ++i) square += (n[i] / most) * (n[i] / most);
    for (int i = 0; i < 3; ++i) n[i] /= most * sqrtl(square);
}

/* Moves x by some motion of it; by 0x1p-55 of the size more, at most. */
static void draw_moved(uint64_t *random, const imp_symmetry *of, double x[3])
{
    long double n[3], w[3], shift[3] = {0, 0, 0};
    const bool is_ball = of->kind == IMP_SYMMETRIC_ABOUT_POINT;
    const double size = random_power(random, -8, 4);
    draw_unit(random, is_ball ? NULL : of->axis, n);
    for (int i = 0; i < 3; ++i) w[i] = (long double)x[i] - of->center[i];
    turn(n, random_between(random, -4, 4), w);
    if (of->kind == IMP_SYMMETRIC_ALONG_LINE)
        for (int i = 0; i < 3; ++i) shift[i] = size * n[i];
    if (of->kind == IMP_SYMMETRIC_ACROSS_LINE) {
        const long double way[3] = {random_between(random, -1, 1), random_between(random, -1, 1),
                                    random_between(random, -1, 1)};
        const long double along = n[0] * way[0] + n[1] * way[1] + n[2] * way[2];
        for (int i = 0; i < 3; ++i) shift[i] = size * (way[i] - along * n[i]);
    }
    for (int i = 0; i < 3; ++i) x[i] = (double)(of->center[i] + w[i] + shift[i]);
}

/* --- Judging ----------------------------------------------------------------------------------- */

static bool judge_form(const subject *s, const imp_model *g)
{
    bool sane = g->e >= 0 && g->lo <= g->hi && !isnan(g->a);
    for (int j = 0; j < 3; ++j) sane = sane && !isnan(g->b[j]);
    for (int k = 0; k < 6; ++k) sane = sane && !isnan(g->q[k]);
    return sane || answer_fail(s->answer, "the distance has a NaN, a remainder that is negative, or a "
                                          "range that is inverted");
}

/* What is claimed of the distance at s: the least |g| that polynomial and range leave, or an empty range. */
static long double claimed_at(const imp_model *g, const double s[3])
{
    const long double value = value_at(g, s);
    const long double slack = 32 * LDBL_EPSILON * (imp_model_size(g) + fabs(g->lo) + fabs(g->hi));
    long double lo = value - g->e - slack, hi = value + g->e + slack;
    if (lo < g->lo) lo = g->lo;
    if (hi > g->hi) hi = g->hi;
    if (lo > hi) return (long double)INFINITY;
    return lo > 0 ? lo - slack : hi < 0 ? -hi - slack : 0;
}

typedef struct passage {
    imp_region region; /* of the point's parameters */
    imp_model in[4];
    imp_model g;
} passage;

/* That the point with polynomial values at s, or `x` where that is given, is as far from the surface's point at
 * u, v as is claimed. */
static bool judge_claim(const subject *s, const passage *way, const double at[3], const double p[3],
                        const spot *on, const double x[3])
{
    long double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const long double d = (x != NULL ? x[i] : value_at(&way->in[i], at)) - on->x[i];
        sum += d * d;
    }
    const long double apart = sqrtl(sum) * (1 + 16 * LDBL_EPSILON) + on->error;
    const long double claimed = claimed_at(&way->g, at);
    ++s->answer->tests;
    if (!(claimed > apart)) return true;
    return answer_fail_for(s->answer, FAULT_ERROR,
                           "a distance of at least %.17Lg is claimed of a point that is %.17Lg from the "
                           "surface's point at %s, where its model is %.17g + ... +- %.9g in [%.17g, %.17g]",
                           claimed, apart, subject_point_text(3, p).text, way->g.a, way->g.e, way->g.lo,
                           way->g.hi);
}

/* Points of the surface at the same time, anywhere. */
static bool judge_others(const subject *s, uint64_t *random, const passage *way, const double steps[3])
{
    for (int k = 0; k < OTHERS; ++k) {
        double p[3], at[3] = {draw_normalized(random), draw_normalized(random), steps[2]};
        spot on;
        draw_point(random, &s->domain, 2, p);
        p[2] = way->region.c[2] + way->region.d[2] * steps[2];
        if (!spot_at(s, p, &on)) return false;
        if (!judge_claim(s, way, at, p, &on, NULL)) return false;
    }
    return true;
}

/* Times of sixteenths, so that those of the steps -1, -1/2 ... 1 are exact; or one moment. */
static imp_region draw_region(const subject *s, uint64_t *random)
{
    const double from = ceil(16 * s->domain.lo[2]) / 16, to = floor(16 * s->domain.hi[2]) / 16;
    const double t = s->domain.lo[2], way = random_power(random, -8, 0);
    const double end = from + ceil(16 * way * (to - from)) / 16;
    return from < to ? imp_region_between((double[3]){-1, -1, from}, (double[3]){1, 1, end < to ? end : to})
                     : imp_region_between((double[3]){-1, -1, t}, (double[3]){1, 1, t});
}

/* Also of a point moved by the symmetry, if there is one: as far away as it was before. */
static bool judge_passage(const subject *s, uint64_t *random, const imp_symmetry *symmetry)
{
    passage way = {.region = draw_region(s, random)};
    const double step = (double)draw_index(random, 5) / 2 - 1;
    const double at[3] = {draw_normalized(random), draw_normalized(random),
                          way.region.d[2] > 0 ? step : 0};
    double p[3], n[3], x[3], moved[3];
    spot on;
    draw_point(random, &s->domain, 2, p);
    p[2] = way.region.c[2] + way.region.d[2] * at[2];
    if (!spot_at(s, p, &on) || !draw_direction(s, random, p, n)) return false;
    const double off = draw_index(random, 3) > 0 ? random_power(random, -30, 2) : 0;
    for (int i = 0; i < 3; ++i) moved[i] = x[i] = on.x[i] + off * n[i];
    if (symmetry != NULL && draw_index(random, 2) > 0) draw_moved(random, symmetry, moved);
    for (int i = 0; i < 3; ++i) way.in[i] = draw_model(random, moved[i], at);
    way.in[3] = imp_param(&way.region, 2);
    const imp_status status = subject_distance(s, way.in, &way.g);
    if (status == IMP_UNBOUNDED) return true;
    if (status != IMP_OK)
        return answer_fail(s->answer, "distance returned '%s'", subject_status_name(status));
    return judge_form(s, &way.g) && judge_claim(s, &way, at, p, &on, x) &&
           judge_others(s, random, &way, at);
}

void distances_check(const subject *s, uint64_t *random, double effort)
{
    if (!subject_has_distance(s)) {
        answer_skip(s->answer, "the type has no distance");
        return;
    }
    const double count = PASSAGES * effort;
    imp_symmetry found;
    const imp_status status = subject_symmetry(s, &found);
    if (status != IMP_OK && status != IMP_UNBOUNDED) {
        answer_fail(s->answer, "symmetry returned '%s'", subject_status_name(status));
        return;
    }
    if (status == IMP_OK && !judge_symmetry(s, &found)) return;
    for (int k = 0; (k < count || k == 0) && s->answer->verdict != CHECK_FAIL; ++k)
        judge_passage(s, random, status == IMP_OK ? &found : NULL);
    if (s->answer->verdict == CHECK_PASS && s->answer->tests == 0)
        answer_skip(s->answer, "it has no distance with these parameters");
}
