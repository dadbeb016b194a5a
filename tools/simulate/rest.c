/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/rest.h"

#include "tools/simulate/balance.h"

static const vec zero = {{0, 0, 0}};

/* --- Slow bodies ------------------------------------------------------------------------------ */

double rest_speed(const instant *now, const impact_body *bodies, size_t body)
{
    const impact_body *b = &bodies[body];
    double arm = 0;
    for (size_t i = 0; i < now->count; ++i) {
        const impact_contact *c = &now->contacts[i];
        if (c->body[0] != body && c->body[1] != body) continue;
        for (size_t k = 0; k < c->count; ++k)
            arm = fmax(arm, vec_length(vec_sub(c->point[k].at, b->position)));
    }
    return fmax(vec_length(b->velocity), arm * vec_length(b->spin));
}

static bool is_struck(const instant *now, size_t body)
{
    for (size_t i = 0; i < now->count; ++i)
        for (int k = 0; k < 2; ++k)
            if (now->about[i].struck && now->contacts[i].body[k] == body) return true;
    return false;
}

static bool is_slow(const instant *now, const impact_body *settled, size_t body)
{
    const double least = YIELDING * now->slow;
    const double most = is_struck(now, body) ? least : now->who[body].memory->speed + least;
    return rest_speed(now, settled, body) <= fmin(now->slow, most);
}

/* --- What stands on what ---------------------------------------------------------------------- */

/* Both bodies are fixed, or may rest. */
static bool counts(const instant *now, const impact_contact *c)
{
    for (int k = 0; k < 2; ++k)
        if (!now->who[c->body[k]].rests && !now->who[c->body[k]].fixed) return false;
    return true;
}

/* Takes out those that no row of contacts joins to something fixed, and returns whether there were
 * any. */
static bool drop_floating(instant *now)
{
    participant *who = now->who;
    bool more = true, any = false;
    for (size_t b = 0; b < now->body_count; ++b) who[b].joined = who[b].fixed;
    while (more) {
        more = false;
        for (size_t i = 0; i < now->count; ++i) {
            const size_t *body = now->contacts[i].body;
            if (!counts(now, &now->contacts[i]) || who[body[0]].joined == who[body[1]].joined)
                continue;
            who[body[0]].joined = who[body[1]].joined = more = true;
        }
    }
    for (size_t b = 0; b < now->body_count; ++b) {
        if (!who[b].rests || who[b].joined) continue;
        who[b].rests = false;
        any = true;
    }
    return any;
}

/* --- Balance ---------------------------------------------------------------------------------- */

vec rest_pull(const instant *now)
{
    const double size = vec_length(now->gravity);
    return size > 0 ? vec_scale(now->slow / size, now->gravity) : zero;
}

/* Lets gravity pull at those that may rest, for as long as gives V to what falls. Takes out what
 * moves then, and returns whether there was any. */
static bool drop_falling(instant *now)
{
    const vec pull = rest_pull(now);
    impact_body *bodies = now->spare[2];
    size_t count = 0;
    bool any = false;
    for (size_t i = 0; i < now->count; ++i) {
        if (!counts(now, &now->contacts[i])) continue;
        impact_contact *c = &now->kept[count++];
        *c = now->contacts[i];
        for (size_t k = 0; k < c->count; ++k) c->point[k].drift = zero;
    }
    for (size_t b = 0; b < now->body_count; ++b) {
        bodies[b] = now->bodies[b];
        bodies[b].yields = now->who[b].rests;
        bodies[b].velocity = bodies[b].yields ? pull : zero;
        bodies[b].momentum = bodies[b].spin = zero;
    }
    balance_find(bodies, now->body_count, now->kept, count, RESIDUE * now->slow);
    for (size_t b = 0; b < now->body_count; ++b) {
        if (!now->who[b].rests || rest_speed(now, bodies, b) <= RESIDUE * now->slow) continue;
        now->who[b].rests = false;
        any = true;
    }
    return any;
}

void rest_find(instant *now, const impact_body *settled)
{
    for (size_t b = 0; b < now->body_count; ++b)
        now->who[b].rests = now->who[b].moves && is_slow(now, settled, b);
    while (drop_floating(now) || drop_falling(now)) continue;
}
