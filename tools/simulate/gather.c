/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/gather.h"

#include <stdlib.h>

#include "core/common/array.h"
#include "tools/simulate/timeline.h"

static const char speaker[] = "simulate";

/* Points of a manifold are up to this many gammas from the plane of contact: a hop of what rests
 * raises a corner by one, and V (response.h) by four. */
#define MANIFOLD_SLACK 4

double gather_limit(const simulation *s, double t)
{
    return t + 1e-14 * fmax(fabs(t), s->search.end - s->setup->options.t_start);
}

bool gather_has(const gathered *g, size_t index)
{
    for (size_t i = 0; i < g->count; ++i)
        if (g->contact[i].meeting == index) return true;
    return false;
}

void gather_free(gathered *g) { free(g->contact); }

/* --- One pair of bodies ----------------------------------------------------------------------- */

static touch_pair pair_at(const simulation *s, const meeting *m, double t)
{
    touch_pair pair = {
        .setup = s->setup, .t = t, .slack = MANIFOLD_SLACK * s->setup->options.gamma};
    for (int k = 0; k < 2; ++k) {
        const size_t body = m->body[k];
        mover_state state = {0};
        if (s->setup->actors[body].moves) state = mover_at(&s->movers[body], t);
        pair.outline[k] = &s->setup->actors[body].outline;
        pair.at[k] = placed_at(s->setup, body, t, &state);
    }
    return pair;
}

static witness witness_of(const meeting *m, const imp_side side[2])
{
    witness w;
    for (int k = 0; k < 2; ++k) {
        w.place[k] = (imp_place){m->body[k], side[k].surface, side[k].piece};
        w.p[k][0] = side[k].u;
        w.p[k][1] = side[k].v;
    }
    return w;
}

static exit_status add(gathered *g, size_t index, int level, const touching *at)
{
    gathered_contact *grown = array_reserve(g->contact, g->count, &g->capacity, sizeof *grown);
    if (grown == NULL) return complain_of_memory(speaker);
    g->contact = grown;
    g->contact[g->count++] = (gathered_contact){index, level, *at};
    return EXIT_ANSWERED;
}

/* Returns whether a contact is at another place than those of the same meeting from `first` on:
 * with another normal, since one plane has all its contacts in one manifold. */
static bool is_other(const gathered *g, size_t first, const touching *at)
{
    for (size_t i = first; i < g->count; ++i)
        if (vec_dot(g->contact[i].at.normal, at->normal) > 0.999) return false;
    return true;
}

/* Remembers a place of contact, the latest first. */
static void remember(meeting *m, const witness *w)
{
    for (size_t i = MEETING_PLACES - 1; i > 0; --i) m->places[i] = m->places[i - 1];
    m->places[0] = *w;
    if (m->place_count < MEETING_PLACES) m->place_count += 1;
}

/* Adds the contact with the witness `side`, and those at places where the two touched before and do
 * so still: in a groove, say, or a corner. */
static exit_status add_contacts(simulation *s, gathered *g, size_t index, const imp_side side[2],
                                int level)
{
    meeting *m = &s->meetings[index];
    const touch_pair pair = pair_at(s, m, g->t);
    const size_t first = g->count;
    const witness from = witness_of(m, side);
    touching at;
    if (touching_find(&pair, &from, &at, &s->search.error) != IMP_SUCCESS)
        return timeline_complain(s);
    exit_status status = add(g, index, level, &at);
    for (size_t i = 0; i < m->place_count && status == EXIT_ANSWERED; ++i) {
        if (touching_find(&pair, &m->places[i], &at, &s->search.error) != IMP_SUCCESS)
            return timeline_complain(s);
        if (at.gap <= pair.slack && is_other(g, first, &at)) status = add(g, index, level, &at);
    }
    for (size_t i = first; i < g->count; ++i) remember(m, &g->contact[i].at.nearest);
    return status;
}

/* Adds the meeting if the two touch at t, or cuts the instant where that cannot be found out. */
static exit_status add_touching(simulation *s, gathered *g, size_t index)
{
    meeting *m = &s->meetings[index], now;
    int level;
    imp_code code = meeting_make_scene(&s->search, m);
    if (code == IMP_SUCCESS) code = meeting_level(&s->search, m, g->t, 0, &level, &now);
    if (code != IMP_SUCCESS) return timeline_complain(s);
    if (now.kind == MEETING_UNDECIDED) g->cut = now.reason;
    if (now.kind != MEETING_CONTACT) return EXIT_ANSWERED;
    return add_contacts(s, g, index, now.side, level - 1);
}

/* --- All -------------------------------------------------------------------------------------- */

/* Returns whether a body that moves is in both meetings. */
static bool share_mover(const simulation *s, const meeting *a, const meeting *b)
{
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            if (a->body[j] == b->body[k] && s->setup->actors[a->body[j]].moves) return true;
    return false;
}

exit_status gather_all(simulation *s, double t, gathered *g)
{
    exit_status status = EXIT_ANSWERED;
    *g = (gathered){.t = t};
    for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
        const meeting *m = &s->meetings[i];
        if (m->kind == MEETING_CONTACT && m->t <= gather_limit(s, t))
            status = add_contacts(s, g, i, m->side, m->level);
    }
    for (size_t done = 0; done < g->count && status == EXIT_ANSWERED; ++done)
        for (size_t i = 0; i < s->meeting_count && status == EXIT_ANSWERED; ++i) {
            const meeting *m = &s->meetings[g->contact[done].meeting];
            if (share_mover(s, &s->meetings[i], m) && !gather_has(g, i))
                status = add_touching(s, g, i);
        }
    return status;
}
