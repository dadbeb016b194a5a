/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/simulation.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/progress.h"

static const char speaker[] = "simulate";

/* --- Sums ------------------------------------------------------------------------------------- */

static sums sums_at(const simulation *s, const mover_state *state)
{
    sums all = {0};
    for (size_t i = 0; i < s->setup->count; ++i) {
        const actor *a = &s->setup->actors[i];
        if (!a->moves) continue;
        const vec p = vec_scale(a->mass, state[i].velocity);
        all.energy += mover_kinetic_energy(&s->movers[i], &state[i]) -
                      a->mass * vec_dot(s->setup->gravity, state[i].position);
        all.momentum = vec_add(all.momentum, p);
        all.angular =
            vec_add(all.angular, vec_add(state[i].momentum, vec_cross(state[i].position, p)));
    }
    return all;
}

static void states_at(const simulation *s, double t, mover_state *state)
{
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) state[i] = mover_at(&s->movers[i], t);
}

/* --- Meetings ---------------------------------------------------------------------------------- */

/* Neither of the two moves before it is hit. */
static bool is_asleep(const simulation *s, const meeting *m)
{
    for (int k = 0; k < 2; ++k) {
        const actor *a = &s->setup->actors[m->body[k]];
        if (a->moves ? !s->rests[m->body[k]] : a->varies) return false;
    }
    return true;
}

static exit_status complain_of_search(const simulation *s)
{
    return complain_of(&s->search.error, speaker);
}

/* Two bodies that no level parts. */
static exit_status refuse_overlap(const simulation *s, const meeting *m)
{
    return complain(
        EXIT_DATA, speaker,
        "%.300s: the bodies '%s' and '%s' are nearer than the clearance %g at the start; "
        "move them apart, or make gamma smaller",
        s->setup->name, s->setup->actors[m->body[0]].name, s->setup->actors[m->body[1]].name,
        s->setup->options.clearance);
}

static void set_undecided(meeting *m, double t, imp_reason reason)
{
    m->kind = MEETING_UNDECIDED;
    m->reason = reason;
    m->t = t;
}

/* The next meeting from t on, at `least` or a level above. */
static exit_status predict(simulation *s, meeting *m, double t, int least)
{
    meeting now;
    int level;
    m->kind = MEETING_NEVER;
    m->t = s->search.end;
    if (is_asleep(s, m)) return EXIT_ANSWERED;
    const imp_reason end = searching_end(&s->search);
    if (end != IMP_REASON_NONE) {
        set_undecided(m, t, end);
        return EXIT_ANSWERED;
    }
    imp_code code = meeting_make_scene(&s->search, m);
    if (code == IMP_SUCCESS) code = meeting_level(&s->search, m, t, least, &level, &now);
    if (code != IMP_SUCCESS) return complain_of_search(s);
    if (now.kind == MEETING_UNDECIDED) {
        *m = now;
    } else if (level == LEVEL_NONE) {
        set_undecided(m, t, IMP_REASON_RESOLUTION);
        m->level = level;
    } else if (meeting_find(&s->search, m, t, level) != IMP_SUCCESS) {
        return complain_of_search(s);
    }
    return EXIT_ANSWERED;
}

static meeting *earliest(const simulation *s)
{
    meeting *first = NULL;
    for (size_t i = 0; i < s->meeting_count; ++i) {
        meeting *m = &s->meetings[i];
        if (m->kind != MEETING_NEVER && (first == NULL || m->t < first->t)) first = m;
    }
    return first;
}

/* --- One event ---------------------------------------------------------------------------------- */

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
    if (touching_find(&s->search, m, at, &c.at) != IMP_SUCCESS) return complain_of_search(s);
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
    if (code != IMP_SUCCESS) return complain_of_search(s);
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
static bool turn_movers(simulation *s, const event *e, double t)
{
    for (size_t i = 0; i < s->setup->count; ++i) {
        if (!e->now.changed[i]) continue;
        const vec pull = s->rests[i] ? (vec){{0, 0, 0}} : s->setup->gravity;
        if (!mover_turn(&s->movers[i], t, &e->now.state[i], pull, s->search.end)) return false;
        for (size_t k = 0; k < s->meeting_count; ++k)
            if (s->meetings[k].body[0] == i || s->meetings[k].body[1] == i)
                s->meetings[k].stale = true;
    }
    return true;
}

/* What the bodies got from gravity up to t. */
static void fall(simulation *s, double t)
{
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves)
            s->from_gravity = vec_along(s->from_gravity, s->setup->actors[i].mass * (t - s->t),
                                        s->movers[i].acceleration);
    s->t = t;
}

static exit_status predict_again(simulation *s, const event *e, double t)
{
    exit_status status = EXIT_ANSWERED;
    for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
        meeting *m = &s->meetings[i];
        const bool due = is_gathered(e, i) && m->kind == MEETING_CONTACT && m->t <= same_time(s, t);
        if (due)
            status = predict(s, m, t, m->t <= t ? m->level + 1 : 0);
        else if (m->stale)
            status = predict(s, m, t, 0);
    }
    return status;
}

static const char *name_of(imp_reason reason)
{
    switch (reason) {
    case IMP_REASON_PAIRS:
        return "max-pairs";
    case IMP_REASON_SECONDS:
        return "max-seconds";
    case IMP_REASON_MEMORY:
        return "max-bytes";
    case IMP_REASON_RESOLUTION:
        return "resolution";
    default:
        return "cancelled";
    }
}

static exit_status respond(simulation *s, event *e, double t)
{
    states_at(s, t, e->now.state);
    exit_status status = gather(s, e, t);
    if (status != EXIT_ANSWERED) return status;
    if (e->cut != IMP_REASON_NONE) {
        s->reason = name_of(e->cut);
        fall(s, t);
        return status;
    }
    const double before = sums_at(s, e->now.state).energy;
    memcpy(e->now.rests, s->rests, s->setup->count * sizeof *s->rests);
    response_resolve(&e->now, e->contacts, e->count);
    s->energy_lost += before - sums_at(s, e->now.state).energy;
    s->from_fixed = vec_sub(s->from_fixed, e->now.to_fixed);
    fall(s, t);
    for (size_t i = 0; i < s->setup->count; ++i) {
        s->held_now[i] = e->now.rests[i] && !s->rests[i];
        s->held += s->held_now[i];
        s->rests[i] = e->now.rests[i];
    }
    for (size_t i = 0; i < e->count; ++i)
        if (!log_contact(s, &e->contacts[i], t)) return complain_of_memory(speaker);
    if (!turn_movers(s, e, t)) return complain_of_memory(speaker);
    return predict_again(s, e, t);
}

static exit_status handle(simulation *s, double t)
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

/* --- From the start to the end ------------------------------------------------------------------ */

static uint64_t count_or(const arguments *args, const char *name, uint64_t otherwise)
{
    const option_value *value = arguments_option(args, name);
    return value != NULL ? value->count : otherwise;
}

static bool begin(simulation *s, const setup *what, const arguments *args)
{
    const size_t n = what->count;
    const imp_options *o = &what->options;
    *s = (simulation){.setup = what,
                      .movers = calloc(n, sizeof *s->movers),
                      .meetings = calloc(n * (n - 1) / 2 + 1, sizeof *s->meetings),
                      .rests = calloc(n, sizeof *s->rests),
                      .held_now = calloc(n, sizeof *s->held_now),
                      .max_events = count_or(args, "max-events", 10000),
                      .t = o->t_start,
                      .log = json_array()};
    s->search =
        (searching){.setup = what,
                    .movers = s->movers,
                    .end = o->t_end,
                    .deadline = o->max_seconds > 0 ? searching_clock() + o->max_seconds : INFINITY,
                    .max_pairs = o->max_pairs};
    if (s->movers == NULL || s->meetings == NULL || s->rests == NULL || s->held_now == NULL ||
        s->log == NULL)
        return false;
    for (size_t i = 0; i < n; ++i)
        if (what->actors[i].moves &&
            !mover_begin(&s->movers[i], &what->actors[i], what->gravity, o->t_start, o->t_end))
            return false;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 1; j < n; ++j) {
            if (!what->actors[i].moves && !what->actors[j].moves) continue;
            if (imp_scene_ignores(what->still, i, j)) continue;
            s->meetings[s->meeting_count++] = (meeting){.body = {i, j}};
        }
    return true;
}

static exit_status predict_all(simulation *s)
{
    const double start = s->setup->options.t_start;
    for (size_t i = 0; i < s->meeting_count; ++i) {
        meeting *m = &s->meetings[i];
        const exit_status status = predict(s, m, start, 0);
        if (status != EXIT_ANSWERED) return status;
        if (m->level == LEVEL_NONE) return refuse_overlap(s, m);
    }
    return EXIT_ANSWERED;
}

static exit_status run(simulation *s)
{
    exit_status status = predict_all(s);
    while (status == EXIT_ANSWERED && s->reason == NULL) {
        const meeting *first = earliest(s);
        const double t = first != NULL ? first->t : s->search.end;
        if (first == NULL || first->kind == MEETING_UNDECIDED || s->events >= s->max_events) {
            if (first != NULL)
                s->reason = first->kind == MEETING_UNDECIDED ? name_of(first->reason) : "max-events";
            fall(s, t);
            break;
        }
        progress_show("t = %.6g, %zu events", t, s->events);
        status = handle(s, t);
    }
    progress_wipe();
    return status;
}

exit_status simulation_run(simulation *s, const setup *what, const arguments *args)
{
    if (!begin(s, what, args)) return complain_of_memory(speaker);
    mover_state *state = calloc(what->count, sizeof *state);
    if (state == NULL) return complain_of_memory(speaker);
    states_at(s, s->t, state);
    s->start = sums_at(s, state);
    const exit_status status = run(s);
    states_at(s, s->t, state);
    s->end = sums_at(s, state);
    free(state);
    return status;
}

void simulation_free(simulation *s)
{
    for (size_t i = 0; i < s->meeting_count; ++i) imp_scene_free(s->meetings[i].scene);
    for (size_t i = 0; s->movers != NULL && i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) mover_free(&s->movers[i]);
    free(s->movers);
    free(s->meetings);
    free(s->rests);
    free(s->held_now);
    json_decref(s->log);
}

double simulation_substep_error(const simulation *s)
{
    double most = 0;
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) most = fmax(most, s->movers[i].substep_error);
    return most;
}
