/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MEETING_NODES_H
#define TESTS_SUPPORT_MEETING_NODES_H

#include "core/bounds/separation.h"

#include <string.h>

#include "core/bounds/fixed_axes.h"
#include "core/bounds/gjk_axis.h"
#include "core/bounds/moving_boxes.h"
#include "core/bounds/normal_field.h"
#include "tests/support/meeting.h"

/* Pairs of made-up nodes that are brought together, exactly within gamma_clear, at a chosen moment
 * and chosen points. Where parts of the judgement need it, long double. */

/* How the two lie: anyhow; touching each other like a ball and a table; one along the other, as two
 * layers of one shell, which only the field of normals parts. */
typedef enum posture { ANYHOW, TANGENT, NESTED, POSTURES } posture;

typedef struct meeting {
    node a, b;
    time_window window;
    double t; /* when they are near */
    double gamma_clear;
    long double gap[3]; /* B - A then */
} meeting;

static inline void random_node(uint64_t *state, node *n, double size, double bend, double motion)
{
    memset(n, 0, sizeof *n);
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    n->region = region_make(lo, hi);
    n->bounded = true;
    quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        f->bu[i] = size * random_between(state, -1, 1);
        f->bv[i] = size * random_between(state, -1, 1);
        f->bt[i] = motion * random_between(state, -1, 1);
        double *q[5] = {&f->quu[i], &f->quv[i], &f->qvv[i], &f->qut[i], &f->qvt[i]};
        for (int k = 0; k < 5; ++k) *q[k] = bend * size * random_between(state, -1, 1);
        f->qtt[i] = bend * motion * random_between(state, -1, 1);
        n->e[i] = random_bits(state) % 2 ? bend * size * random_power(state, -8, 0) : 0;
        n->lo[i] = -INFINITY;
        n->hi[i] = INFINITY;
    }
}

/* The second surface of a tangent pair: the first, turned a little, and curved otherwise. */
static inline void make_tangent(uint64_t *state, meeting *m, double tilt, double bend)
{
    for (int i = 0; i < 3; ++i) {
        m->b.f.bu[i] = m->a.f.bu[i] * random_between(state, 0.9, 1.1);
        m->b.f.bv[i] = m->a.f.bv[i] + tilt * random_between(state, -1, 1) * m->a.f.bu[i];
        m->b.f.quu[i] = m->a.f.quu[i] + bend * random_between(state, -1, 1) * m->a.f.quu[i];
    }
}

/* Scales the part of x that lies in the plane across the unit vector n, and the part along it. */
static inline void scale_parts(double *x, vec3 n, double in_plane, double along)
{
    const double height = vec3_dot(vec3_from(x), n);
    for (int i = 0; i < 3; ++i)
        x[i] = in_plane * (x[i] - height * n.x[i]) + along * height * n.x[i];
}

/* Makes a surface lie across n and bend along it. */
static inline void make_shell(uint64_t *state, node *x)
{
    vec3 n = {{random_between(state, -1, 1), random_between(state, -1, 1), 1}};
    const double waver = random_power(state, -20, -2);
    quadratic3 *f = &x->f;
    n = vec3_scale(n, 1 / vec3_norm(n));
    scale_parts(f->bu, n, 1, waver);
    scale_parts(f->bv, n, 1, waver);
    double *bends[5] = {f->quu, f->quv, f->qvv, f->qut, f->qvt};
    for (int k = 0; k < 5; ++k) scale_parts(bends[k], n, waver, 1);
}

/* The second surface of a nested pair: the first, but for a little of everything; perhaps it turns
 * the other way. */
static inline void make_nested(uint64_t *state, meeting *m, double size)
{
    const double little = size * random_power(state, -20, -2);
    make_shell(state, &m->a);
    double *const a = (double *)&m->a.f, *const b = (double *)&m->b.f;
    for (size_t k = 0; k < sizeof m->a.f / sizeof *a; ++k)
        b[k] = a[k] + little * random_between(state, -1, 1);
    const double way = random_bits(state) % 2 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
        m->b.f.qut[i] *= way;
        m->b.f.qvt[i] *= way;
        m->a.e[i] = m->b.e[i] = random_bits(state) % 2 ? little : 0;
    }
}

/* Across the surface at parameters s, from it or into it. */
static inline void across(uint64_t *state, const node *n, const double s[2], double t,
                          double toward[3])
{
    const double st = (t - n->region.c[2]) / n->region.d[2];
    const quadratic3 *f = &n->f;
    vec3 u, v;
    for (int i = 0; i < 3; ++i) {
        u.x[i] = f->bu[i] + 2 * f->quu[i] * s[0] + f->quv[i] * s[1] + f->qut[i] * st;
        v.x[i] = f->bv[i] + 2 * f->qvv[i] * s[1] + f->quv[i] * s[0] + f->qvt[i] * st;
    }
    const vec3 normal = vec3_scale(vec3_cross(u, v), random_bits(state) % 2 ? 1 : -1);
    memcpy(toward, normal.x, sizeof normal.x);
}

static inline long double point(const node *n, int i, const double *s, double t, long double rest)
{
    const quadratic3 *f = &n->f;
    const long double st = ((long double)t - n->region.c[2]) / n->region.d[2];
    return f->a[i] + f->bu[i] * (long double)s[0] + f->bv[i] * (long double)s[1] + f->bt[i] * st +
           f->quu[i] * (long double)s[0] * s[0] + f->quv[i] * (long double)s[0] * s[1] +
           f->qut[i] * s[0] * st + f->qvv[i] * (long double)s[1] * s[1] + f->qvt[i] * s[1] * st +
           f->qtt[i] * st * st + rest * n->e[i];
}

/* Places B so that at m->t the points at random parameters are within gamma_clear. */
static inline void bring_together(uint64_t *state, meeting *m, posture how, double offset)
{
    double sa[2], sb[2], toward[3], norm = 0;
    for (int k = 0; k < 2; ++k) {
        sa[k] = suite_end_or_inside(state);
        sb[k] = how == NESTED ? sa[k] : suite_end_or_inside(state);
    }
    for (int i = 0; i < 3; ++i) toward[i] = random_between(state, -1, 1);
    if (how == NESTED) across(state, &m->a, sa, m->t, toward);
    for (int i = 0; i < 3; ++i) {
        norm += toward[i] * toward[i];
        m->a.f.a[i] = offset * random_between(state, -1, 1);
    }
    /* within gamma_clear also after b.a is rounded to a double */
    const double reach = m->gamma_clear * (random_bits(state) % 2 ? 1 - 1e-9 : 0.5);
    for (int i = 0; i < 3; ++i) {
        const long double ra = suite_end_or_inside(state), rb = suite_end_or_inside(state);
        const long double x = point(&m->a, i, sa, m->t, ra) + reach * toward[i] / sqrt(norm);
        m->b.f.a[i] = 0;
        m->b.f.a[i] = (double)(x - point(&m->b, i, sb, m->t, rb));
        m->gap[i] = point(&m->b, i, sb, m->t, rb) - point(&m->a, i, sa, m->t, ra);
    }
}

/* B - A at m->t and parameters s of A and B, the remainders making it as short as they can. */
static inline long double nearest_gap(const meeting *m, const double s[4], long double gap[3])
{
    long double square = 0;
    for (int i = 0; i < 3; ++i) {
        const long double apart = point(&m->b, i, s + 2, m->t, 0) - point(&m->a, i, s, m->t, 0);
        const long double rest = fmaxl(fabsl(apart) - m->a.e[i] - m->b.e[i], 0);
        gap[i] = copysignl(rest, apart);
        square += gap[i] * gap[i];
    }
    return sqrtl(square);
}

/* gamma_clear becomes the least gap that a search from random parameters finds: no more of the
 * window may be cut than that. */
static inline void tighten(uint64_t *state, meeting *m)
{
    double s[4];
    long double gap[3];
    s[0] = s[2] = suite_end_or_inside(state);
    s[1] = s[3] = suite_end_or_inside(state);
    long double least = nearest_gap(m, s, m->gap);
    for (double step = 0.25; step > 1e-4; step *= 0.5)
        for (int k = 0; k < 8; ++k) {
            const double was = s[k / 2];
            s[k / 2] = fmin(fmax(was + (k % 2 ? step : -step), -1), 1);
            const long double now = nearest_gap(m, s, gap);
            if (now < least) {
                least = now;
                memcpy(m->gap, gap, sizeof gap);
            } else {
                s[k / 2] = was;
            }
        }
    m->gamma_clear = (double)(least * (1 + 1e-12L));
}

static inline bool is_near(const meeting *m)
{
    const long double square =
        m->gap[0] * m->gap[0] + m->gap[1] * m->gap[1] + m->gap[2] * m->gap[2];
    return square <= (long double)m->gamma_clear * m->gamma_clear;
}

static inline void random_meeting(uint64_t *state, meeting *m, posture how)
{
    const bool close = how != ANYHOW;
    const double size = random_power(state, -30, 3),
                 bend = random_power(state, close ? -4 : -12, 1);
    const double motion = size * random_power(state, -6, close ? 0 : 6);
    random_node(state, &m->a, size, bend, motion);
    random_node(state, &m->b, size * (close ? 1 : random_power(state, -3, 3)), bend, motion);
    if (how == NESTED) make_nested(state, m, size);
    if (how == TANGENT) make_tangent(state, m, random_power(state, -20, -1), 0.1);
    m->gamma_clear = size * random_power(state, -20, 0);
    m->t = draw_moment(state, -10, &m->window);
    bring_together(state, m, how, random_bits(state) % 8 == 0 ? 100 * size : size);
    if (how == NESTED && random_bits(state) % 4 == 0) tighten(state, m);
}

/* What the parents may have left: any direction of any length, none, or no numbers at all. */
static inline vec3 random_axis(uint64_t *state)
{
    const double length = random_power(state, -1020, 1020);
    vec3 n = {{0, 0, 0}};
    const uint64_t kind = random_bits(state) % 16;
    for (int i = 0; kind > 3 && i < 3; ++i)
        n.x[i] = (kind == 4 ? length : 1) * random_between(state, -1, 1);
    if (kind == 1) n.x[random_bits(state) % 3] = NAN;
    if (kind == 2) n.x[random_bits(state) % 3] = -INFINITY;
    return n;
}

static const vec3 NO_AXIS = {{0, 0, 0}};

/* Two caps of radius 1 that bulge at each other along a tilted normal, h wide, `gap` apart. */
static inline meeting two_caps(double h, double radius_b, double gap)
{
    const double n[3] = {0.48, 0.6, 0.64}, u[3] = {0.8, 0, -0.6}, v[3] = {-0.36, 0.8, -0.48};
    meeting m;
    memset(&m, 0, sizeof m);
    node *both[2] = {&m.a, &m.b};
    for (int k = 0; k < 2; ++k) {
        node *x = both[k];
        x->region = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
        x->bounded = true;
        for (int i = 0; i < 3; ++i) {
            const double curve = k == 0 ? -0.5 : -0.5 / radius_b;
            x->f.a[i] = k * gap * n[i];
            x->f.bu[i] = h * u[i];
            x->f.bv[i] = h * v[i];
            x->f.quu[i] = x->f.qvv[i] = curve * h * h * n[i];
            x->lo[i] = -INFINITY;
            x->hi[i] = INFINITY;
        }
    }
    m.window = (time_window){0, 1};
    return m;
}

#endif
