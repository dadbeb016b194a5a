/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/response.h"

/* --- Two bodies ------------------------------------------------------------------------------- */

static bool yields(const instant *now, size_t body)
{
    return now->setup->actors[body].moves && !now->rests[body];
}

static vec arm_of(const instant *now, const contact *c, int k)
{
    return vec_sub(c->at.point, now->state[c->body[k]].position);
}

static vec velocity_of(const instant *now, const contact *c, int k)
{
    const size_t body = c->body[k];
    if (!yields(now, body)) return c->at.drift[k];
    const mover_state *s = &now->state[body];
    return vec_add(vec_add(s->velocity, c->at.drift[k]), vec_cross(s->spin, arm_of(now, c, k)));
}

/* Velocity of the second body against the first, at the contact. */
static vec relative_velocity(const instant *now, const contact *c)
{
    return vec_sub(velocity_of(now, c, 1), velocity_of(now, c, 0));
}

double contact_speed(const instant *now, const contact *c)
{
    return vec_dot(relative_velocity(now, c), c->at.normal);
}

/* K with (change of the relative velocity) = K impulse: for each body that yields
 * 1/m - [r] I^-1 [r]. */
static mat3 compliance(const instant *now, const contact *c)
{
    mat3 k = mat3_diagonal(0);
    for (int i = 0; i < 2; ++i) {
        const size_t body = c->body[i];
        if (!yields(now, body)) continue;
        const mover *m = &now->movers[body];
        const mat3 inverse = mover_inverse_inertia(m, &now->state[body]);
        const vec r = arm_of(now, c, i);
        for (int j = 0; j < 3; ++j) {
            vec unit = {{j == 0, j == 1, j == 2}};
            const vec turned = vec_cross(mat3_apply(&inverse, vec_cross(r, unit)), r);
            for (int l = 0; l < 3; ++l) k.m[l][j] += turned.x[l];
        }
        const mat3 straight = mat3_diagonal(1 / m->actor->mass);
        k = mat3_add(&k, 1, &straight);
    }
    return k;
}

static void push(instant *now, contact *c, vec impulse)
{
    for (int i = 0; i < 2; ++i) {
        const size_t body = c->body[i];
        const vec one = vec_scale(i == 0 ? -1 : 1, impulse);
        if (!yields(now, body)) {
            now->to_fixed = vec_add(now->to_fixed, one);
            continue;
        }
        mover_state *s = &now->state[body];
        s->momentum = vec_add(s->momentum, vec_cross(arm_of(now, c, i), one));
        s->velocity = vec_along(s->velocity, 1 / now->movers[body].actor->mass, one);
        mover_spin_update(&now->movers[body], s);
        now->changed[body] = true;
    }
    c->impulse = vec_add(c->impulse, impulse);
}

/* --- One impulse ------------------------------------------------------------------------------ */

/* Kinetic energy that an impulse J adds to the two: J.u + J.K J / 2, for bodies without drift. */
static double energy_gain(const mat3 *k, vec u, vec impulse)
{
    return vec_dot(impulse, u) + 0.5 * vec_dot(impulse, mat3_apply(k, impulse));
}

/* The impulse after which the normal speed is `target`, with friction. */
static vec impulse_for(const contact *c, const mat3 *k, vec u, double target)
{
    const vec n = c->at.normal;
    const double speed = vec_dot(u, n), wanted = target - speed;
    const vec smooth = vec_scale(wanted / vec_dot(n, mat3_apply(k, n)), n);
    const vec sliding = vec_along(u, -speed, n);
    if (!(c->friction > 0)) return smooth;
    const mat3 inverse = mat3_inverse(k);
    const vec sticking = mat3_apply(&inverse, vec_sub(vec_scale(wanted, n), sliding));
    const double normal = vec_dot(sticking, n);
    const double across = vec_length(vec_along(sticking, -normal, n));
    vec chosen = sticking;
    if (!(normal > 0 && across <= c->friction * normal)) {
        const vec way = vec_along(n, -c->friction, vec_unit(sliding));
        const double yield = vec_dot(n, mat3_apply(k, way));
        if (!(yield > 0)) return smooth;
        chosen = vec_scale(wanted / yield, way);
    }
    const double slack = 1e-12 * fabs(vec_dot(chosen, u));
    return energy_gain(k, u, chosen) <= slack || target > 0 ? chosen : smooth;
}

/* How fast the contact must open, at least. */
static double wanted_speed(const instant *now, const contact *c)
{
    return c->lasting ? now->lift : 0;
}

static void strike(instant *now, contact *c, double restitution)
{
    const mat3 k = compliance(now, c);
    const vec u = relative_velocity(now, c);
    const double back = -restitution * vec_dot(u, c->at.normal);
    push(now, c, impulse_for(c, &k, u, fmax(back, wanted_speed(now, c))));
}

/* --- Contacts that last ----------------------------------------------------------------------- */

/* Whether the body stands on something that does not move. */
static bool is_support(const instant *now, size_t body)
{
    const actor *a = &now->setup->actors[body];
    return a->moves ? now->rests[body] : !a->varies;
}

static bool is_slow(const instant *now, const contact *c, int k)
{
    const mover_state *s = &now->state[c->body[k]];
    return vec_length(s->velocity) <= now->slow &&
           vec_length(s->spin) * vec_length(arm_of(now, c, k)) <= now->slow;
}

static void stop(instant *now, size_t body)
{
    mover_state *s = &now->state[body];
    now->to_fixed = vec_along(now->to_fixed, now->movers[body].actor->mass, s->velocity);
    s->velocity = s->momentum = s->spin = (vec){{0, 0, 0}};
    now->rests[body] = now->changed[body] = true;
}

/* Counts slow lasting contacts; the last one holds the body. */
static void judge_rest(instant *now, const contact *c)
{
    for (int k = 0; k < 2; ++k) {
        const size_t body = c->body[k];
        if (!yields(now, body) || !is_support(now, c->body[1 - k])) continue;
        mover *m = &now->movers[body];
        m->slow = is_slow(now, c, k) ? m->slow + 1 : 0;
        if (m->slow >= SLOW_MAX) stop(now, body);
    }
}

/* --- All of them ------------------------------------------------------------------------------ */

/* The contact that lacks most of the speed it must open with, and more than rounding; NULL:
 * none. */
static contact *fastest(const instant *now, contact *contacts, size_t count)
{
    contact *found = NULL;
    double most = 0;
    for (size_t i = 0; i < count; ++i) {
        contact *c = &contacts[i];
        if (!yields(now, c->body[0]) && !yields(now, c->body[1])) continue;
        const double lack = wanted_speed(now, c) - contact_speed(now, c);
        const double size = vec_length(velocity_of(now, c, 0)) + vec_length(velocity_of(now, c, 1));
        if (lack > 1e-12 * (size + now->lift) && lack > most) most = lack, found = c;
    }
    return found;
}

void response_resolve(instant *now, contact *contacts, size_t count)
{
    for (size_t i = 0; i < count; ++i) /* what is hit hard rests no longer */
        for (int k = 0; k < 2; ++k)
            if (!contacts[i].lasting && contact_speed(now, &contacts[i]) < -now->slow) {
                const size_t body = contacts[i].body[k];
                if (!now->setup->actors[body].moves) continue;
                now->changed[body] |= now->rests[body];
                now->rests[body] = false;
            }
    contact *c;
    for (size_t round = 0; (c = fastest(now, contacts, count)) != NULL; ++round) {
        if (round >= (ROUNDS + 1024) * count) break;
        strike(now, c, c->lasting || round >= ROUNDS * count ? 0 : c->restitution);
    }
    for (size_t i = 0; i < count; ++i)
        if (contacts[i].lasting) judge_rest(now, &contacts[i]);
}
