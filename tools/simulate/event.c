/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/event.h"

#include <stdlib.h>
#include <string.h>

#include "tools/simulate/gather.h"
#include "tools/simulate/response.h"
#include "tools/simulate/timeline.h"

static const char speaker[] = "simulate";

/* --- The instant ------------------------------------------------------------------------------ */

/* The bodies and contacts as the laws of impact take them, and the states the bodies come with. */
typedef struct event {
    instant now;
    mover_state *state; /* of each body of the instant */
    double energy;      /* kinetic, of these before */
} event;

static bool make_room(event *e, const gathered *g)
{
    const size_t bodies = 2 * g->count + 1, contacts = g->count + 1;
    instant *now = &e->now;
    now->who = calloc(bodies, sizeof *now->who);
    now->bodies = calloc(bodies, sizeof *now->bodies);
    for (int k = 0; k < 3; ++k) now->spare[k] = calloc(bodies, sizeof *now->spare[k]);
    now->contacts = calloc(contacts, sizeof *now->contacts);
    now->kept = calloc(contacts, sizeof *now->kept);
    now->about = calloc(contacts, sizeof *now->about);
    e->state = calloc(bodies, sizeof *e->state);
    return now->who != NULL && now->bodies != NULL && now->spare[0] != NULL &&
           now->spare[1] != NULL && now->spare[2] != NULL && now->contacts != NULL &&
           now->kept != NULL && now->about != NULL && e->state != NULL;
}

static void event_free(event *e)
{
    free(e->now.who);
    free(e->now.bodies);
    for (int k = 0; k < 3; ++k) free(e->now.spare[k]);
    free(e->now.contacts);
    free(e->now.kept);
    free(e->now.about);
    free(e->state);
}

/* Returns the number of a body in the instant, which it joins. */
static size_t join(simulation *s, event *e, size_t body, double t)
{
    instant *now = &e->now;
    for (size_t b = 0; b < now->body_count; ++b)
        if (now->who[b].body == body) return b;
    const actor *a = &s->setup->actors[body];
    const size_t b = now->body_count++;
    now->who[b] = (participant){.body = body,
                                .moves = a->moves,
                                .fixed = !a->moves && !a->outline.varies,
                                .rested = s->rests[body],
                                .memory = &s->memory[body]};
    if (!a->moves) return b;
    const mover_state state = mover_at(&s->movers[body], t);
    e->state[b] = state;
    now->bodies[b] = (impact_body){.yields = true,
                                   .mass = a->mass,
                                   .inverse = mover_inverse_inertia(&s->movers[body], &state),
                                   .position = state.position,
                                   .velocity = state.velocity,
                                   .momentum = state.momentum,
                                   .spin = state.spin};
    return b;
}

static void add_contact(simulation *s, event *e, const gathered *g, const gathered_contact *from)
{
    instant *now = &e->now;
    const size_t *body = s->meetings[from->meeting].body;
    const actor *a = &s->setup->actors[body[0]], *b = &s->setup->actors[body[1]];
    impact_contact *c = &now->contacts[now->count];
    *c = (impact_contact){.body = {join(s, e, body[0], g->t), join(s, e, body[1], g->t)},
                          .normal = from->at.normal,
                          .restitution = fmin(a->restitution, b->restitution),
                          .friction = fmax(a->friction, b->friction),
                          .count = from->at.count};
    for (size_t i = 0; i < c->count; ++i) {
        c->point[i].at = from->at.corner[i];
        c->point[i].drift = from->at.drift[i];
    }
    const double closing = impact_closing(now->bodies, c);
    now->about[now->count++] =
        (contact){.meeting = from->meeting,
                  .level = from->level,
                  .middle = from->at.point,
                  .driven = a->outline.varies || b->outline.varies,
                  .resting = from->level >= LEVEL_LASTING || (closing > 0 && closing <= now->slow)};
}

/* --- The log ---------------------------------------------------------------------------------- */

static json_t *vector_json(vec v) { return json_pack("[f,f,f]", v.x[0], v.x[1], v.x[2]); }

/* Returns the sum of a contact's impulses, and the mean of its points with their normal parts as
 * weights. */
static vec impulse_of(const impact_contact *c, vec *point)
{
    vec sum = {{0, 0, 0}}, moment = {{0, 0, 0}};
    double weight = 0;
    for (size_t i = 0; i < c->count; ++i) {
        const double part = fmax(0, vec_dot(c->point[i].impulse, c->normal));
        sum = vec_add(sum, c->point[i].impulse);
        moment = vec_along(moment, part, c->point[i].at);
        weight += part;
    }
    if (c->count > 1 && weight > 0) *point = vec_scale(1 / weight, moment);
    return sum;
}

static json_t *manifold_json(const impact_contact *c)
{
    json_t *list = json_array();
    for (size_t i = 0; i < c->count; ++i) json_array_append_new(list, vector_json(c->point[i].at));
    return list;
}

/* Contacts without an impulse are no events. */
static bool log_contact(simulation *s, const event *e, size_t index, double t)
{
    const impact_contact *c = &e->now.contacts[index];
    const contact *about = &e->now.about[index];
    vec point = about->middle;
    const vec impulse = impulse_of(c, &point);
    if (!(vec_length(impulse) > 0)) return true;
    const participant *who[2] = {&e->now.who[c->body[0]], &e->now.who[c->body[1]]};
    json_t *entry =
        json_pack("{s:f, s:s, s:s, s:o, s:o, s:o, s:s, s:[f,f], s:o}", "t", t, "a",
                  s->setup->actors[who[0]->body].name, "b", s->setup->actors[who[1]->body].name,
                  "point", vector_json(point), "normal", vector_json(c->normal), "impulse",
                  vector_json(impulse), "kind", about->struck ? "impact" : "resting", "energy",
                  e->energy, response_energy(&e->now), "manifold", manifold_json(c));
    s->events += 1;
    s->impacts += about->struck;
    if (entry == NULL) return false;
    for (int k = 0; k < 2; ++k) {
        if (!s->held_now[who[k]->body]) continue;
        json_object_set_new(entry, "held", json_string(s->setup->actors[who[k]->body].name));
        s->held_now[who[k]->body] = false;
        break;
    }
    return json_array_append_new(s->log, entry) == 0;
}

/* --- What follows ----------------------------------------------------------------------------- */

static bool has_changed(const event *e, size_t b)
{
    const participant *p = &e->now.who[b];
    const impact_body *body = &e->now.bodies[b];
    if (!p->moves || (p->rested && p->rests)) return false;
    return p->rested != p->rests ||
           memcmp(&body->velocity, &e->state[b].velocity, sizeof body->velocity) != 0 ||
           memcmp(&body->momentum, &e->state[b].momentum, sizeof body->momentum) != 0;
}

/* New paths for all that changed. */
static exit_status turn_movers(simulation *s, event *e, double t)
{
    for (size_t b = 0; b < e->now.body_count; ++b) {
        const size_t i = e->now.who[b].body;
        if (!has_changed(e, b)) continue;
        const impact_body *body = &e->now.bodies[b];
        mover_state state = e->state[b];
        state.velocity = body->velocity, state.momentum = body->momentum, state.spin = body->spin;
        const vec pull = s->rests[i] ? (vec){{0, 0, 0}} : s->setup->gravity;
        if (!mover_turn(&s->movers[i], t, &state, pull, s->search.end))
            return complain_of_memory(speaker);
        const exit_status status = timeline_check(s, i);
        if (status != EXIT_ANSWERED) return status;
        for (size_t k = 0; k < s->meeting_count; ++k)
            if (s->meetings[k].body[0] == i || s->meetings[k].body[1] == i)
                s->meetings[k].stale = true;
    }
    return EXIT_ANSWERED;
}

static exit_status predict_again(simulation *s, const gathered *g)
{
    exit_status status = EXIT_ANSWERED;
    const double t = g->t;
    for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
        meeting *m = &s->meetings[i];
        const bool due =
            gather_has(g, i) && m->kind == MEETING_CONTACT && m->t <= gather_limit(s, t);
        if (due)
            status = timeline_predict(s, m, t, m->t <= t ? m->level + 1 : 0);
        else if (m->stale)
            status = timeline_predict(s, m, t, 0);
    }
    return status;
}

/* Momentum that fixed bodies gave, and which bodies rest from now on. */
static void take_over(simulation *s, const event *e)
{
    for (size_t b = 0; b < e->now.body_count; ++b) {
        const participant *p = &e->now.who[b];
        if (!p->moves) continue;
        const vec change = vec_sub(e->now.bodies[b].velocity, e->state[b].velocity);
        s->from_fixed = vec_along(s->from_fixed, e->now.bodies[b].mass, change);
        s->held_now[p->body] = p->rests && !p->rested;
        s->held += s->held_now[p->body];
        s->rests[p->body] = p->rests;
    }
}

static exit_status respond(simulation *s, event *e, const gathered *g)
{
    e->now.gravity = s->setup->gravity;
    e->now.lift = s->lift;
    e->now.slow = 2 * s->lift;
    for (size_t i = 0; i < g->count; ++i) add_contact(s, e, g, &g->contact[i]);
    e->energy = response_energy(&e->now);
    response_resolve(&e->now);
    s->energy_lost += e->energy - response_energy(&e->now);
    timeline_advance(s, g->t);
    take_over(s, e);
    for (size_t i = 0; i < e->now.count; ++i)
        if (!log_contact(s, e, i, g->t)) return complain_of_memory(speaker);
    const exit_status status = turn_movers(s, e, g->t);
    return status == EXIT_ANSWERED ? predict_again(s, g) : status;
}

exit_status event_handle(simulation *s, double t)
{
    gathered g;
    event e = {.energy = 0};
    exit_status status = gather_all(s, t, &g);
    if (status == EXIT_ANSWERED && g.cut != IMP_REASON_NONE) {
        timeline_cut(s, t, g.cut, NULL);
    } else if (status == EXIT_ANSWERED) {
        status = make_room(&e, &g) ? respond(s, &e, &g) : complain_of_memory(speaker);
    }
    event_free(&e);
    gather_free(&g);
    return status;
}
