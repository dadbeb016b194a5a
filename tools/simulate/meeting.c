/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/json_memory.h"
#include "tools/simulate/meeting.h"

#include <stdlib.h>
#include <string.h>

/* --- The scene of two bodies ------------------------------------------------------------------ */

/* Returns a copy of the body under its path. NULL: no memory. Bodies that begin outside of each
 * other stay so, as they never come nearer than gamma_clear: only the `first` scene of a meeting
 * has solid ones. */
static json_t *body_json(const searching *s, size_t body, bool first)
{
    const actor *a = &s->setup->actors[body];
    json_t *copy = json_copy(a->json), *maps = json_array();
    int failed =
        copy == NULL || maps == NULL || json_object_set_new(copy, "name", json_string(a->name));
    json_object_del(copy, "group");
    if (!first) json_object_del(copy, "solid");
    failed |= json_array_extend(maps, json_object_get(copy, "maps")) &&
              json_object_get(copy, "maps") != NULL;
    if (a->moves) failed |= json_array_append(maps, s->movers[body].map);
    failed |= json_object_set(copy, "maps", maps);
    json_decref(maps);
    if (!failed) return copy;
    json_decref(copy);
    return NULL;
}

/* A body's parents come too, and are not tested with anything. */
static int add_parents(const searching *s, size_t body, json_t *bodies, json_t *ignore)
{
    const json_t *parent = json_object_get(s->setup->actors[body].json, "parent");
    int failed = 0;
    while (parent != NULL && !failed) {
        const size_t up = setup_find(s->setup, json_string_value(parent));
        const char *name = s->setup->actors[up].name;
        for (size_t i = 0; i < json_array_size(bodies); ++i) {
            const char *other =
                json_string_value(json_object_get(json_array_get(bodies, i), "name"));
            if (strcmp(other, name) == 0) return failed;
            failed |= json_array_append_new(ignore, json_pack("[s,s]", other, name));
        }
        failed |= json_array_append_new(bodies, body_json(s, up, false));
        parent = json_object_get(s->setup->actors[up].json, "parent");
    }
    return failed;
}

static char *scene_text(const searching *s, const meeting *m, bool first)
{
    json_t *bodies = json_array(), *ignore = json_array(), *root = json_object();
    json_t *define = json_object_get(s->setup->stripped, "define");
    int failed = 0;
    for (int k = 0; k < 2; ++k)
        failed |= json_array_append_new(bodies, body_json(s, m->body[k], first));
    for (int k = 0; k < 2; ++k) failed |= add_parents(s, m->body[k], bodies, ignore);
    failed |= json_object_set_new(root, "bodies", bodies);
    failed |= json_object_set_new(root, "ignore", ignore);
    if (define != NULL) failed |= json_object_set(root, "define", define);
    char *text = failed ? NULL : json_memory_text(root, JSON_COMPACT | JSON_REAL_PRECISION(17));
    json_decref(root);
    return text;
}

imp_code meeting_make_scene(searching *s, meeting *m)
{
    if (m->scene != NULL && !m->stale) return IMP_SUCCESS;
    const bool first = m->scene == NULL;
    imp_scene_free(m->scene);
    m->scene = NULL;
    char *text = scene_text(s, m, first);
    if (text == NULL) {
        s->error = (imp_error){.code = IMP_ERROR_MEMORY};
        return IMP_ERROR_MEMORY;
    }
    m->scene =
        imp_scene_from_json(s->setup->registry, text, strlen(text), s->setup->name, &s->error);
    free(text);
    m->stale = false;
    return m->scene != NULL ? IMP_SUCCESS : s->error.code;
}

/* --- Searches --------------------------------------------------------------------------------- */

/* What is left of the budgets goes to each search. */
static imp_code solve(searching *s, const meeting *m, double from, double to, double gamma,
                      double gamma_clear, imp_result *result)
{
    imp_options o = s->setup->options;
    o.t_start = from, o.t_end = to;
    o.gamma = gamma, o.gamma_clear = gamma_clear;
    limits_apply(&s->limits, &o);
    result->struct_size = (uint32_t)sizeof *result;
    const imp_code code = imp_scene_solve(m->scene, &o, result, &s->error);
    if (code != IMP_SUCCESS) return code;
    s->limits.pairs += result->stats.pairs;
    s->searches += 1;
    return code;
}

typedef struct step {
    double gamma, gamma_clear;
} step;

static step step_of(const searching *s, int level)
{
    const double least = s->setup->options.gamma_clear;
    const double h = ldexp(s->setup->options.gamma - least, -level);
    return (step){least + h, least + 0.75 * h};
}

static void set_undecided(meeting *m, const imp_result *r)
{
    m->kind = MEETING_UNDECIDED;
    m->reason = r->reason;
    m->t = r->t_lower;
}

static void set_contact(meeting *m, const imp_result *r)
{
    m->kind = MEETING_CONTACT;
    m->t = r->t;
    m->side[0] = r->a;
    m->side[1] = r->b;
}

imp_code meeting_level(searching *s, const meeting *m, double t, int least, int *level,
                       meeting *now)
{
    imp_result r;
    *now = *m;
    now->kind = MEETING_NEVER;
    for (*level = least; *level < LEVEL_NONE; ++*level) {
        const step at = step_of(s, *level);
        const double gamma_clear = at.gamma * (1 + 1e-12);
        const double gamma = at.gamma + (at.gamma - s->setup->options.gamma_clear) / 4;
        const imp_code code = solve(s, m, t, t, gamma, gamma_clear, &r);
        if (code != IMP_SUCCESS || r.verdict == IMP_VERDICT_CLEAR) return code;
        if (r.verdict == IMP_VERDICT_CONTACT) set_contact(now, &r);
        if (r.verdict == IMP_VERDICT_UNDECIDED && r.reason != IMP_REASON_RESOLUTION) {
            set_undecided(now, &r);
            now->t = t;
            return IMP_SUCCESS;
        }
    }
    return IMP_SUCCESS;
}

/* Each window in time is this much longer than the one before. */
#define WINDOW_GROWTH 8

/* Searches at one level over one window. */
static imp_code find_at(searching *s, meeting *m, double t, int level, double window)
{
    const step at = step_of(s, level);
    imp_result r;
    const double to = t + window > t && t + window < s->end ? t + window : s->end;
    const imp_code code = solve(s, m, t, to, at.gamma, at.gamma_clear, &r);
    if (code != IMP_SUCCESS) return code;
    m->level = level;
    m->kind = to < s->end ? MEETING_OPEN : MEETING_NEVER;
    m->t = to;
    m->window = window * WINDOW_GROWTH;
    if (r.verdict == IMP_VERDICT_CONTACT) set_contact(m, &r);
    if (r.verdict == IMP_VERDICT_UNDECIDED) set_undecided(m, &r);
    return IMP_SUCCESS;
}

/* The search at a level below, if the bodies are apart enough for that at t. */
static imp_code restart_lower(searching *s, meeting *m, double t, double window)
{
    meeting now;
    int apart;
    const imp_code code = meeting_level(s, m, t, 0, &apart, &now);
    if (code != IMP_SUCCESS) return code;
    if (now.kind == MEETING_UNDECIDED) *m = now;
    return now.kind != MEETING_UNDECIDED && apart < m->level ? find_at(s, m, t, apart, window)
                                                             : code;
}

imp_code meeting_find(searching *s, meeting *m, double t, int level)
{
    const double window = m->place_count > 0 || level > 0 ? s->window : INFINITY;
    const imp_code code = find_at(s, m, t, level, window);
    if (code != IMP_SUCCESS || level == 0 || m->kind != MEETING_CONTACT) return code;
    const double middle = t + 0.5 * (m->t - t);
    return middle > t ? restart_lower(s, m, middle, window) : code;
}

imp_code meeting_continue(searching *s, meeting *m)
{
    const double t = m->t, window = m->window;
    imp_code code = meeting_make_scene(s, m);
    if (code == IMP_SUCCESS && m->level > 0) {
        code = restart_lower(s, m, t, window);
        if (code != IMP_SUCCESS || m->kind != MEETING_OPEN || m->t > t) return code;
    }
    return code == IMP_SUCCESS ? find_at(s, m, t, m->level, window) : code;
}
