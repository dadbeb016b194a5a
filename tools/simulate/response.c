/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/response.h"

#include <stdint.h>
#include <string.h>

#include "tools/simulate/rest.h"

static const vec zero = {{0, 0, 0}};

static double energy_of(const instant *now, const impact_body *bodies)
{
    double sum = 0;
    for (size_t b = 0; b < now->body_count; ++b) sum += impact_energy(&bodies[b]);
    return sum;
}

double response_energy(const instant *now) { return energy_of(now, now->bodies); }

static void copy_bodies(const instant *now, impact_body *to, const impact_body *from)
{
    memcpy(to, from, now->body_count * sizeof *to);
}

/* --- Impacts ---------------------------------------------------------------------------------- */

static bool may_change(const instant *now, const impact_contact *c)
{
    return now->bodies[c->body[0]].yields || now->bodies[c->body[1]].yields;
}

/* Returns the contact that closes fastest, and faster than `slow`, of impacts or of all; SIZE_MAX:
 * none does. */
static size_t fastest(const instant *now, double slow, bool of_all)
{
    size_t found = SIZE_MAX;
    double most = slow;
    for (size_t i = 0; i < now->count; ++i) {
        if ((now->about[i].resting && !of_all) || !may_change(now, &now->contacts[i])) continue;
        const double speed = impact_closing(now->bodies, &now->contacts[i]);
        if (speed > most) most = speed, found = i;
    }
    return found;
}

/* Rounds without end are left to be settled. */
static void strike_all(instant *now)
{
    for (size_t round = 0; round < ROUNDS * now->count; ++round) {
        const size_t i = fastest(now, now->slow, false);
        if (i == SIZE_MAX) break;
        impact_strike(now->bodies, &now->contacts[i], now->contacts[i].restitution);
        now->about[i].struck = true;
    }
}

/* Without loss: bodies that only touch each other would otherwise meet again and again, ever
 * slower. */
static void bounce_all(instant *now)
{
    for (size_t round = 0; round < ROUNDS * now->count; ++round) {
        const size_t i = fastest(now, 1e-9 * now->slow, true);
        if (i == SIZE_MAX) break;
        impact_strike(now->bodies, &now->contacts[i], 1);
    }
}

/* --- Resting contacts ------------------------------------------------------------------------- */

static bool is_hopping(const instant *now, size_t i)
{
    return now->about[i].pressed && !now->about[i].struck;
}

static void clear_targets(instant *now)
{
    for (size_t i = 0; i < now->count; ++i)
        for (size_t k = 0; k < now->contacts[i].count; ++k) now->contacts[i].point[k].target = 0;
}

/* A hop begins at no more than this part of V, so that it does not end faster than V even if the
 * bodies meet at a smaller gap. */
#define HOP_MOST 0.75

/* Resting contacts open as fast as they close, within limits. */
static void set_targets(instant *now)
{
    for (size_t i = 0; i < now->count; ++i) {
        impact_contact *c = &now->contacts[i];
        const double least = now->lift * exp2(0.5 * now->about[i].level);
        for (size_t k = 0; k < c->count; ++k) {
            const double closing = -vec_dot(impact_velocity(now->bodies, c, k), c->normal);
            const double up = fmax(least, fmin(closing, HOP_MOST * now->slow));
            c->point[k].target = is_hopping(now, i) ? up : 0;
        }
    }
}

/* Solves for all contacts together; without friction if there is no solution with it, or if it
 * gains energy where none may be gained. */
static void solve_all(instant *now, impact_body *bodies, bool may_gain)
{
    double gain;
    impact_body *before = now->spare[1];
    copy_bodies(now, before, bodies);
    if (impact_solve(bodies, now->contacts, now->count, true, &gain) && (may_gain || gain <= 0))
        return;
    copy_bodies(now, bodies, before);
    impact_solve(bodies, now->contacts, now->count, false, &gain);
}

/* Returns whether a contact closes by more than rounding. */
static bool closes(const instant *now)
{
    for (size_t i = 0; i < now->count; ++i) {
        const impact_contact *c = &now->contacts[i];
        double size = now->slow;
        for (size_t k = 0; k < c->count; ++k)
            size += vec_length(impact_velocity(now->bodies, c, k));
        if (may_change(now, c) && impact_closing(now->bodies, c) > 1e-12 * size) return true;
    }
    return false;
}

/* Which contacts carry something in the last solution. */
static void note_pressed(instant *now)
{
    for (size_t i = 0; i < now->count; ++i) {
        const impact_contact *c = &now->contacts[i];
        double sum = 0;
        for (size_t k = 0; k < c->count; ++k) sum += vec_dot(c->point[k].solving.change, c->normal);
        now->about[i].pressed = sum > 0;
    }
}

/* How bodies would be after all contacts are settled. Those that rest have been pulled at by
 * gravity for as long as a hop takes, so that what they stand on holds them against what leans on
 * them. */
static void settle_on_trial(instant *now, impact_body *bodies)
{
    const vec pull = rest_pull(now);
    copy_bodies(now, bodies, now->bodies);
    for (size_t b = 0; b < now->body_count; ++b)
        if (now->who[b].rested) bodies[b].velocity = vec_add(bodies[b].velocity, pull);
    clear_targets(now);
    solve_all(now, bodies, false);
}

/* --- Rest ------------------------------------------------------------------------------------- */

static bool touches_support(const instant *now, size_t body)
{
    for (size_t i = 0; i < now->count; ++i)
        for (int k = 0; k < 2; ++k) {
            const size_t other = now->contacts[i].body[1 - k];
            if (now->contacts[i].body[k] == body &&
                (now->who[other].fixed || now->who[other].rests))
                return true;
        }
    return false;
}

/* What is slow again and again, without falling over or sliding away, comes to rest, too. */
static void lose_patience(instant *now, const impact_body *settled)
{
    for (size_t b = 0; b < now->body_count; ++b) {
        participant *p = &now->who[b];
        if (!p->moves) continue;
        p->memory->speed = rest_speed(now, settled, b);
        p->memory->times = p->memory->speed <= now->slow && !p->rests ? p->memory->times + 1 : 0;
        if (p->memory->times >= SLOW_MAX && touches_support(now, b)) p->rests = true;
        if (p->rests) *p->memory = (remembered){0, 0};
    }
}

static void stop(instant *now)
{
    for (size_t b = 0; b < now->body_count; ++b) {
        impact_body *one = &now->bodies[b];
        if (!now->who[b].rests) continue;
        one->velocity = one->momentum = one->spin = zero;
        one->yields = false;
    }
}

/* --- Hops ------------------------------------------------------------------------------------- */

/* Returns whether fixed things may take momentum from bodies without doing work. */
static bool has_support(const instant *now)
{
    bool fixed = false;
    for (size_t i = 0; i < now->count; ++i) {
        if (now->about[i].driven) return false;
        for (int k = 0; k < 2; ++k) {
            const participant *p = &now->who[now->contacts[i].body[k]];
            fixed |= p->fixed || p->rests;
        }
    }
    return fixed;
}

static void slow_down(instant *now, double factor)
{
    for (size_t b = 0; b < now->body_count; ++b) {
        impact_body *one = &now->bodies[b];
        if (!one->yields) continue;
        one->velocity = vec_scale(factor, one->velocity);
        one->momentum = vec_scale(factor, one->momentum);
        one->spin = vec_scale(factor, one->spin);
    }
}

/* Returns whether there is nothing to do after the impacts. */
static bool is_settled(const instant *now)
{
    for (size_t i = 0; i < now->count; ++i)
        if (is_hopping(now, i) && may_change(now, &now->contacts[i])) return false;
    return !closes(now);
}

/* `most`: the energy that may not be exceeded. */
static void hop(instant *now, double most)
{
    impact_body *plain = now->spare[0];
    copy_bodies(now, plain, now->bodies);
    if (has_support(now)) {
        set_targets(now);
        solve_all(now, now->bodies, true);
        const double energy = energy_of(now, now->bodies);
        if (energy > most) slow_down(now, sqrt(most / energy));
        if (isfinite(energy)) return;
        copy_bodies(now, now->bodies, plain);
    }
    bounce_all(now);
    clear_targets(now);
    solve_all(now, now->bodies, false);
}

/* --- All of them ------------------------------------------------------------------------------ */

/* Gives contacts between bodies that rest, and fixed ones, the impulses of the trial. */
static void keep_of_resting(instant *now)
{
    for (size_t i = 0; i < now->count; ++i)
        if (!may_change(now, &now->contacts[i])) impact_keep(&now->contacts[i], 1);
}

void response_resolve(instant *now)
{
    const double before = response_energy(now);
    impact_body *settled = now->spare[0];
    strike_all(now);
    settle_on_trial(now, settled);
    note_pressed(now);
    rest_find(now, settled);
    lose_patience(now, settled);
    stop(now);
    keep_of_resting(now);
    if (is_settled(now)) return;
    hop(now, before);
    impact_keep(now->contacts, now->count);
}
