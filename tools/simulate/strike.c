/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/impact.h"
#include "tools/simulate/smooth.h"

/* The two bodies of a contact after a solution, its impulses, and what it gained. */
typedef struct solution {
    impact_body body[2];
    vec impulse[CONTACT_POINTS];
    double gain;
    bool solved;
} solution;

/* Returns the contact as one of bodies 0 and 1, with Newton's targets. */
static impact_contact pair_of(const impact_body *bodies, const impact_contact *c,
                              double restitution)
{
    impact_contact pair = *c;
    pair.body[0] = 0, pair.body[1] = 1;
    for (size_t i = 0; i < c->count; ++i) {
        const double speed = vec_dot(impact_velocity(bodies, c, i), c->normal);
        pair.point[i].target = fmax(0, -restitution * speed);
    }
    return pair;
}

static solution solve_rough(const impact_body *bodies, const impact_contact *c, double restitution)
{
    solution s = {.body = {bodies[c->body[0]], bodies[c->body[1]]}};
    impact_contact pair = pair_of(bodies, c, restitution);
    s.solved = impact_solve(s.body, &pair, 1, true, &s.gain);
    for (size_t i = 0; i < c->count; ++i) s.impulse[i] = pair.point[i].solving.change;
    return s;
}

/* Returns the sum of J.(u- + u+) / 2. */
static double gain_of(const impact_body *bodies, const impact_contact *c, const solution *s)
{
    double sum = 0;
    impact_contact pair = *c;
    pair.body[0] = 0, pair.body[1] = 1;
    for (size_t i = 0; i < c->count; ++i)
        sum += vec_dot(s->impulse[i],
                       vec_add(impact_velocity(bodies, c, i), impact_velocity(s->body, &pair, i)));
    return sum / 2;
}

/* Without friction. */
static solution solve_smooth(const impact_body *bodies, const impact_contact *c, double restitution)
{
    solution s = {.body = {bodies[c->body[0]], bodies[c->body[1]]}, .solved = true};
    const impact_contact pair = pair_of(bodies, c, restitution);
    double size[CONTACT_POINTS];
    smooth_impulses(s.body, &pair, size);
    for (size_t i = 0; i < c->count; ++i) {
        s.impulse[i] = vec_scale(size[i], c->normal);
        impact_exchange(&s.body[0], &s.body[1], c->point[i].at, s.impulse[i]);
    }
    s.gain = gain_of(bodies, c, &s);
    return s;
}

/* a + s (b - a) */
static vec mixed(vec a, vec b, double s) { return vec_along(a, s, vec_sub(b, a)); }

static solution mix(const solution *p, const solution *n, double s)
{
    solution m = *p;
    for (int k = 0; k < 2; ++k) {
        impact_body *b = &m.body[k];
        b->velocity = mixed(b->velocity, n->body[k].velocity, s);
        b->momentum = mixed(b->momentum, n->body[k].momentum, s);
        b->spin = mixed(b->spin, n->body[k].spin, s);
    }
    for (int i = 0; i < CONTACT_POINTS; ++i) m.impulse[i] = mixed(p->impulse[i], n->impulse[i], s);
    return m;
}

/* Returns the greatest s <= 1 at which the mix of P and N gains no more than `most`, by bisection:
 * the gain is convex in s, and not above `most` at 0. */
static solution mix_below(const impact_body *bodies, const impact_contact *c, const solution *p,
                          const solution *n, double most)
{
    if (n->gain <= most) return *n;
    double lo = 0, hi = 1;
    for (int k = 0; k < 60; ++k) {
        const double middle = lo + (hi - lo) / 2;
        const solution m = mix(p, n, middle);
        if (gain_of(bodies, c, &m) <= most)
            lo = middle;
        else
            hi = middle;
    }
    return mix(p, n, lo);
}

/* Without friction if there is no solution with it, or if rounding gained energy. */
static solution plastic(const impact_body *bodies, const impact_contact *c)
{
    const solution p = c->friction > 0 ? solve_rough(bodies, c, 0) : solve_smooth(bodies, c, 0);
    return p.solved && p.gain <= 0 ? p : solve_smooth(bodies, c, 0);
}

void impact_strike(impact_body *bodies, impact_contact *c, double restitution)
{
    solution taken = plastic(bodies, c);
    if (restitution > 0) {
        const solution smooth = solve_smooth(bodies, c, restitution);
        const solution rough = c->friction > 0 ? solve_rough(bodies, c, restitution) : smooth;
        const solution *newton = rough.solved ? &rough : &smooth;
        const double most = fmax(taken.gain, fmin(0, smooth.gain));
        taken = mix_below(bodies, c, &taken, newton, most);
    }
    for (int k = 0; k < 2; ++k) bodies[c->body[k]] = taken.body[k];
    for (size_t i = 0; i < c->count; ++i)
        c->point[i].impulse = vec_add(c->point[i].impulse, taken.impulse[i]);
}
