/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/smooth.h"

#include "tools/simulate/eliminate.h"

/* Find x >= 0 with w = a x + f >= 0, and x_i = 0 or w_i = 0 for each i. */
typedef struct problem {
    size_t count;
    double a[CONTACT_POINTS][CONTACT_POINTS], f[CONTACT_POINTS];
} problem;

/* a: speeds along the normal that a unit impulse at one point gives to another. */
static void set_problem(problem *p, const impact_body *bodies, const impact_contact *c)
{
    *p = (problem){.count = c->count};
    for (size_t i = 0; i < c->count; ++i)
        p->f[i] = vec_dot(impact_velocity(bodies, c, i), c->normal) - c->point[i].target;
    for (int k = 0; k < 2; ++k) {
        const impact_body *b = &bodies[c->body[k]];
        vec lever[CONTACT_POINTS];
        if (!b->yields) continue;
        for (size_t i = 0; i < c->count; ++i)
            lever[i] = vec_cross(vec_sub(c->point[i].at, b->position), c->normal);
        for (size_t i = 0; i < c->count; ++i)
            for (size_t j = 0; j < c->count; ++j)
                p->a[i][j] += 1 / b->mass + vec_dot(lever[i], mat3_apply(&b->inverse, lever[j]));
    }
}

enum { CARRIERS_MAX = 3 };

/* A set of points that carry, and their impulses. */
typedef struct carriers {
    size_t count, at[CARRIERS_MAX];
    double x[EQUATIONS_MAX];
} carriers;

/* The impulses with which the speeds of the carriers meet their targets. The matrix is positive
 * semidefinite. False: it is singular. */
static bool solve_carriers(const problem *p, carriers *s)
{
    double m[EQUATIONS_MAX][EQUATIONS_MAX + 1], least[EQUATIONS_MAX];
    for (size_t i = 0; i < s->count; ++i) {
        for (size_t j = 0; j < s->count; ++j) m[i][j] = p->a[s->at[i]][s->at[j]];
        m[i][s->count] = -p->f[s->at[i]];
        least[i] = 1e-12 * m[i][i];
    }
    return eliminate_solve(s->count, m, least, s->x);
}

/* By how much speed the law is broken, at most. */
static double violation(const problem *p, const carriers *s)
{
    double most = 0;
    for (size_t i = 0; i < s->count; ++i) most = fmax(most, -s->x[i] * p->a[s->at[i]][s->at[i]]);
    for (size_t i = 0; i < p->count; ++i) {
        double speed = p->f[i];
        for (size_t j = 0; j < s->count; ++j) speed += p->a[i][s->at[j]] * s->x[j];
        most = fmax(most, -speed);
    }
    return most;
}

/* Goes on to the next set of up to three points; begins with none. */
static bool next_set(const problem *p, carriers *s)
{
    for (size_t i = s->count; i-- > 0;) /* the last that can go up, and all behind it after it */
        if (s->at[i] + (s->count - i) < p->count) {
            s->at[i] += 1;
            for (size_t j = i + 1; j < s->count; ++j) s->at[j] = s->at[j - 1] + 1;
            return true;
        }
    if (s->count == CARRIERS_MAX || s->count == p->count) return false;
    s->count += 1;
    for (size_t i = 0; i < s->count; ++i) s->at[i] = i;
    return true;
}

void smooth_impulses(const impact_body *bodies, const impact_contact *c,
                     double impulse[CONTACT_POINTS])
{
    problem p;
    carriers s = {0}, best = {0};
    set_problem(&p, bodies, c);
    double least = violation(&p, &best);
    while (least > 0 && next_set(&p, &s)) {
        if (!solve_carriers(&p, &s)) continue;
        const double v = violation(&p, &s);
        if (v < least) best = s, least = v;
    }
    for (size_t i = 0; i < CONTACT_POINTS; ++i) impulse[i] = 0;
    for (size_t i = 0; i < best.count; ++i) impulse[best.at[i]] = fmax(0, best.x[i]);
}
