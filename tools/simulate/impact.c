/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/impact.h"

#include "tools/simulate/coulomb.h"

/* --- Bodies ----------------------------------------------------------------------------------- */

static vec velocity_of(const impact_body *b, vec at)
{
    return vec_add(b->velocity, vec_cross(b->spin, vec_sub(at, b->position)));
}

vec impact_velocity(const impact_body *bodies, const impact_contact *c, size_t point)
{
    const impact_point *p = &c->point[point];
    const vec a = velocity_of(&bodies[c->body[0]], p->at);
    const vec b = velocity_of(&bodies[c->body[1]], p->at);
    return vec_add(vec_sub(b, a), p->drift);
}

double impact_closing(const impact_body *bodies, const impact_contact *c)
{
    double most = -INFINITY;
    for (size_t i = 0; i < c->count; ++i)
        most = fmax(most, -vec_dot(impact_velocity(bodies, c, i), c->normal));
    return most;
}

double impact_energy(const impact_body *b)
{
    if (!b->yields) return 0;
    return 0.5 * (b->mass * vec_dot(b->velocity, b->velocity) + vec_dot(b->spin, b->momentum));
}

/* Gives an impulse at a point to a body, if it yields. */
static void push(impact_body *b, vec at, vec impulse)
{
    if (!b->yields) return;
    b->velocity = vec_along(b->velocity, 1 / b->mass, impulse);
    b->momentum = vec_add(b->momentum, vec_cross(vec_sub(at, b->position), impulse));
    b->spin = mat3_apply(&b->inverse, b->momentum);
}

void impact_exchange(impact_body *a, impact_body *b, vec at, vec impulse)
{
    push(a, at, vec_scale(-1, impulse));
    push(b, at, impulse);
}

static void apply(impact_body *bodies, impact_contact *c, size_t point, vec impulse)
{
    impact_point *p = &c->point[point];
    impact_exchange(&bodies[c->body[0]], &bodies[c->body[1]], p->at, impulse);
    p->solving.change = vec_add(p->solving.change, impulse);
}

/* --- One point -------------------------------------------------------------------------------- */

/* K with (change of the relative velocity at a point) = K (impulse there): for each body that
 * yields 1/m - [r] I^-1 [r]. */
static mat3 compliance(const impact_body *bodies, const impact_contact *c, size_t point)
{
    mat3 k = mat3_diagonal(0);
    for (int i = 0; i < 2; ++i) {
        const impact_body *b = &bodies[c->body[i]];
        if (!b->yields) continue;
        const vec r = vec_sub(c->point[point].at, b->position);
        for (int j = 0; j < 3; ++j) {
            const vec unit = {{j == 0, j == 1, j == 2}};
            const vec turned = vec_cross(mat3_apply(&b->inverse, vec_cross(r, unit)), r);
            for (int l = 0; l < 3; ++l) k.m[l][j] += turned.x[l] + (l == j ? 1 / b->mass : 0);
        }
    }
    return k;
}

/* Nothing is solved yet at a point. */
static void begin_point(const impact_body *bodies, impact_contact *c, size_t point)
{
    const mat3 k = compliance(bodies, c, point);
    const vec tangent = vec_normal_to(c->normal), other = vec_cross(c->normal, tangent);
    struct solving *s = &c->point[point].solving;
    s->before = impact_velocity(bodies, c, point);
    s->change = (vec){{0, 0, 0}};
    for (int i = 0; i < 3; ++i) {
        s->axes.m[0][i] = c->normal.x[i];
        s->axes.m[1][i] = tangent.x[i];
        s->axes.m[2][i] = other.x[i];
    }
    s->k = mat3_turned(&s->axes, &k);
    if (mat3_greatest(&k) > 0) s->inverse = mat3_inverse(&s->k);
}

/* Gives one point the impulse it takes beside those of all others. Returns how much that changed
 * its velocity, at most. */
static double step_point(impact_body *bodies, impact_contact *c, size_t i, bool friction)
{
    const impact_point *p = &c->point[i];
    const struct solving *s = &p->solving;
    const vec u = mat3_apply(&s->axes, impact_velocity(bodies, c, i));
    const vec now = mat3_apply(&s->axes, s->change);
    vec free = vec_sub(u, mat3_apply(&s->k, now));
    free.x[0] -= p->target;
    const double mu = friction ? c->friction : 0;
    const vec next = coulomb_impulse(&s->k, &s->inverse, free, mu, now);
    const vec step = vec_sub(next, now);
    apply(bodies, c, i, mat3_apply_transposed(&s->axes, step));
    return vec_length(mat3_apply(&s->k, step));
}

/* --- Solutions -------------------------------------------------------------------------------- */

/* Sweeps over all points end when one changes no velocity by more than this part of the velocities.
 * A row of n bodies takes some n^2 sweeps. */
#define SWEEP_SLACK 1e-14
#define SOLVED_SLACK 1e-7 /* up to here what the last sweep allowed left is a solution */
enum { SWEEPS_MAX = 2000 };

/* Returns whether one of the two yields: else impulses change nothing. */
static bool is_open(const impact_body *bodies, const impact_contact *c)
{
    return bodies[c->body[0]].yields || bodies[c->body[1]].yields;
}

/* Returns the scale of velocities, for rounding. */
static double begin(const impact_body *bodies, impact_contact *contacts, size_t count)
{
    double scale = 0;
    for (size_t k = 0; k < count; ++k)
        for (size_t i = 0; i < contacts[k].count; ++i) {
            begin_point(bodies, &contacts[k], i);
            scale = fmax(scale, vec_length(contacts[k].point[i].solving.before));
            scale = fmax(scale, contacts[k].point[i].target);
        }
    return scale;
}

static double sweep(impact_body *bodies, impact_contact *c, bool friction)
{
    double most = 0;
    for (size_t i = 0; i < c->count && is_open(bodies, c); ++i)
        most = fmax(most, step_point(bodies, c, i, friction));
    return most;
}

/* Returns the sum of J.(u- + u+) / 2. */
static double gain_of(const impact_body *bodies, const impact_contact *contacts, size_t count)
{
    double sum = 0;
    for (size_t k = 0; k < count; ++k)
        for (size_t i = 0; i < contacts[k].count; ++i) {
            const struct solving *s = &contacts[k].point[i].solving;
            sum += vec_dot(s->change, vec_add(s->before, impact_velocity(bodies, &contacts[k], i)));
        }
    return sum / 2;
}

bool impact_solve(impact_body *bodies, impact_contact *contacts, size_t count, bool friction,
                  double *gain)
{
    const double scale = begin(bodies, contacts, count);
    double most = INFINITY;
    for (int n = 0; n < SWEEPS_MAX && most > SWEEP_SLACK * scale; ++n) {
        most = 0;
        for (size_t k = 0; k < count; ++k) most = fmax(most, sweep(bodies, &contacts[k], friction));
    }
    *gain = gain_of(bodies, contacts, count);
    return most <= SOLVED_SLACK * scale && isfinite(*gain);
}

void impact_keep(impact_contact *contacts, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        for (size_t i = 0; i < contacts[k].count; ++i) {
            impact_point *p = &contacts[k].point[i];
            p->impulse = vec_add(p->impulse, p->solving.change);
        }
}
