/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/event.h"

#include <stdlib.h>
#include <string.h>

#include "tools/simulate/timeline.h"

static const char speaker[] = "simulate";

/* Meetings as late as that count as one event: some roundings of the time. */
static double same_time(const simulation *s, double t)
{
    return t + 1e-14 * fmax(fabs(t), s->search.end - s->setup->options.t_start);
}

typedef struct event {
    instant now;
    contact *contacts;
    size_t *meeting; /* of each contact */
    size_t count;
    imp_reason cut; /* why not all contacts are known; NONE: they are */
} event;

static bool is_gathered(const event *e, size_t index)
{
    for (size_t i = 0; i < e->count; ++i)
        if (e->meeting[i] == index) return true;
    return false;
}

static exit_status add_contact(simulation *s, event *e, size_t index, const meeting *at, int level)
{
    const meeting *m = &s->meetings[index];
    contact c = {.body = {m->body[0], m->body[1]}};
    if (touching_find(&s->search, m, at, &c.at) != IMP_SUCCESS) return timeline_complain(s);
    const actor *a = &s->setup->actors[m->body[0]], *b = &s->setup->actors[m->body[1]];
    c.restitution = fmin(a->restitution, b->restitution);
    c.friction = fmax(a->friction, b->friction);
    const double speed = contact_speed(&e->now, &c);
    c.lasting = level >= LEVEL_LASTING || (speed < 0 && speed >= -e->now.slow);
    e->contacts[e->count] = c;
    e->meeting[e->count++] = index;
    return EXIT_ANSWERED;
}

/* Adds the meeting if the two touch at t, or cuts the event where that cannot be found out. */
static exit_status add_touching(simulation *s, event *e, size_t index, double t)
{
    meeting *m = &s->meetings[index], now;
    int level;
    imp_code code = meeting_make_scene(&s->search, m);
    if (code == IMP_SUCCESS) code = meeting_level(&s->search, m, t, 0, &level, &now);
    if (code != IMP_SUCCESS) return timeline_complain(s);
    if (now.kind == MEETING_UNDECIDED) e->cut = now.reason;
    return now.kind == MEETING_CONTACT ? add_contact(s, e, index, &now, level - 1) : EXIT_ANSWERED;
}

static bool has_mover_of(const simulation *s, const meeting *m, const contact *c)
{
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            if (m->body[j] == c->body[k] && s->setup->actors[c->body[k]].moves) return true;
    return false;
}

/* Contacts that are due; then what touches the bodies of these, and so on. */
static exit_status gather(simulation *s, event *e, double t)
{
    exit_status status = EXIT_ANSWERED;
    for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
        const meeting *m = &s->meetings[i];
        if (m->kind == MEETING_CONTACT && m->t <= same_time(s, t))
            status = add_contact(s, e, i, m, m->level);
    }
    for (size_t done = 0; done < e->count && status == EXIT_ANSWERED; ++done)
        for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i)
            if (has_mover_of(s, &s->meetings[i], &e->contacts[done]) && !is_gathered(e, i))
                status = add_touching(s, e, i, t);
    return status;
}

static json_t *vector_json(vec v) { return json_pack("[f,f,f]", v.x[0], v.x[1], v.x[2]); }

/* Contacts without an impulse are no events. */
static bool log_contact(simulation *s, const contact *c, double t)
{
    if (!(vec_length(c->impulse) > 0)) return true;
    json_t *entry =
        json_pack("{s:f, s:s, s:s, s:o, s:o, s:o, s:s}", "t", t, "a",
                  s->setup->actors[c->body[0]].name, "b", s->setup->actors[c->body[1]].name,
                  "point", vector_json(c->at.point), "normal", vector_json(c->at.normal), "impulse",
                  vector_json(c->impulse), "kind", c->lasting ? "resting" : "impact");
    s->events += 1;
    s->impacts += !c->lasting;
    if (entry == NULL) return false;
    for (int k = 0; k < 2; ++k)
        if (s->held_now[c->body[k]])
            json_object_set_new(entry, "held", json_string(s->setup->actors[c->body[k]].name));
    return json_array_append_new(s->log, entry) == 0;
}

/* New paths for all that changed. */
static exit_status turn_movers(simulation *s, const event *e, double t)
{
    for (size_t i = 0; i < s->setup->count; ++i) {
        if (!e->now.changed[i]) continue;
        const vec pull = s->rests[i] ? (vec){{0, 0, 0}} : s->setup->gravity;
        if (!mover_turn(&s->movers[i], t, &e->now.state[i], pull, s->search.end))
            return complain_of_memory(speaker);
        const exit_status status = timeline_check(s, i);
        if (status != EXIT_ANSWERED) return status;
        for (size_t k = 0; k < s->meeting_count; ++k)
            if (s->meetings[k].body[0] == i || s->meetings[k].body[1] == i)
                s->meetings[k].stale = true;
    }
    return EXIT_ANSWERED;
}

static exit_status predict_again(simulation *s, const event *e, double t)
{
    exit_status status = EXIT_ANSWERED;
    for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
        meeting *m = &s->meetings[i];
        const bool due = is_gathered(e, i) && m->kind == MEETING_CONTACT && m->t <= same_time(s, t);
        if (due)
            status = timeline_predict(s, m, t, m->t <= t ? m->level + 1 : 0);
        else if (m->stale)
            status = timeline_predict(s, m, t, 0);
    }
    return status;
}

static exit_status respond(simulation *s, event *e, double t)
{
    timeline_states(s, t, e->now.state);
    exit_status status = gather(s, e, t);
    if (status != EXIT_ANSWERED) return status;
    if (e->cut != IMP_REASON_NONE) {
        timeline_cut(s, t, e->cut);
        return status;
    }
    const double before = timeline_sums(s, e->now.state).energy;
    memcpy(e->now.rests, s->rests, s->setup->count * sizeof *s->rests);
    response_resolve(&e->now, e->contacts, e->count);
    s->energy_lost += before - timeline_sums(s, e->now.state).energy;
    s->from_fixed = vec_sub(s->from_fixed, e->now.to_fixed);
    timeline_advance(s, t);
    for (size_t i = 0; i < s->setup->count; ++i) {
        s->held_now[i] = e->now.rests[i] && !s->rests[i];
        s->held += s->held_now[i];
        s->rests[i] = e->now.rests[i];
    }
    for (size_t i = 0; i < e->count; ++i)
        if (!log_contact(s, &e->contacts[i], t)) return complain_of_memory(speaker);
    const exit_status turned = turn_movers(s, e, t);
    return turned == EXIT_ANSWERED ? predict_again(s, e, t) : turned;
}

exit_status event_handle(simulation *s, double t)
{
    const size_t bodies = s->setup->count, meetings = s->meeting_count;
    const imp_options *o = &s->setup->options;
    const double span = o->t_end - o->t_start;
    const double fall_rate = vec_length(s->setup->gravity) + o->gamma / (span * span);
    event e = {.contacts = calloc(meetings, sizeof *e.contacts),
               .meeting = calloc(meetings, sizeof *e.meeting)};
    e.now = (instant){.setup = s->setup,
                      .movers = s->movers,
                      .state = calloc(bodies, sizeof *e.now.state),
                      .changed = calloc(bodies, sizeof *e.now.changed),
                      .rests = calloc(bodies, sizeof *e.now.rests),
                      .lift = sqrt(8 * o->gamma * fall_rate),
                      .slow = 2 * sqrt(8 * o->gamma * fall_rate)};
    const bool room = e.contacts != NULL && e.meeting != NULL && e.now.state != NULL &&
                      e.now.changed != NULL && e.now.rests != NULL;
    const exit_status status = room ? respond(s, &e, t) : complain_of_memory(speaker);
    free(e.contacts);
    free(e.meeting);
    free(e.now.state);
    free(e.now.changed);
    free(e.now.rests);
    return status;
}
