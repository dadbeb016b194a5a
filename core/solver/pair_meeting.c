/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_meeting.h"

#include <string.h>

#include "core/bounds/linear_contact.h"
#include "core/bounds/strategy.h"
#include "core/solver/pair_test.h"

/* The gap at which roots are taken to meet: gamma_clear, and this part of what is left up to gamma.
 * Less would leave no margin for the rounding of times, more makes contacts earlier. */
static const double ABOVE_CLEAR = 0.125;

static bool lacks_tighter_net(const node *n)
{
    return !node_net_is_asked(n) && strategy_wants_net(n);
}

/* Seeks the meeting; where a remainder hides how corners move, makes nets if the pair meets without
 * it, and goes on from there. */
static imp_code find(const impact *im, pair_test *t, linear_contact *met, bool *found,
                     imp_error *error)
{
    const pair *p = &t->p;
    const double gap = im->gamma_clear + ABOVE_CLEAR * (im->gamma - im->gamma_clear);
    const bool lacks[2] = {lacks_tighter_net(p->a), lacks_tighter_net(p->b)};
    const bool lacks_any = lacks[0] || lacks[1];
    *found = linear_contact_find(p->a, p->b, &p->window, lacks_any ? 0 : gap, NULL, met);
    if (!*found || !lacks_any) return IMP_SUCCESS;
    const imp_code code = pair_test_make_nets(im, p, lacks, &t->bytes, error);
    if (code == IMP_SUCCESS) *found = linear_contact_find(p->a, p->b, &p->window, gap, met, met);
    return code;
}

imp_code pair_meeting_seek(const impact *im, pair_test *t, bool *found, imp_error *error)
{
    pair *p = &t->p;
    linear_contact met;
    *found = false;
    if (im->baseline != IMP_BASELINE_NONE || im->spread != NULL || im->proof != NULL)
        return IMP_SUCCESS;
    if (!linear_contact_is_of(p->a, p->b)) return IMP_SUCCESS;
    const imp_code code = find(im, t, &met, found, error);
    if (code != IMP_SUCCESS || !*found) return code;
    const time_window before = {p->window.lo, met.t};
    *found = separation_along(p->a, p->b, met.axis, im->gamma_clear, &before);
    if (!*found) return IMP_SUCCESS;
    p->window.lo = met.t;
    p->axis = met.axis;
    p->is_seen_only = true;
    p->lacks_nets = !(node_net_is_asked(p->a) && node_net_is_asked(p->b));
    t->near = t->meets = true;
    memcpy(t->meeting, met.y, sizeof t->meeting);
    return IMP_SUCCESS;
}

imp_code pair_meeting_try(impact *im, const pair_test *t, imp_error *error)
{
    const node *const nodes[2] = {t->p.a, t->p.b};
    const double start = t->p.window.lo;
    upper_time *up = &im->upper;
    if (!t->meets || (up->is_known && up->t <= start)) return IMP_SUCCESS;
    witness seen;
    im->stats->witness_searches += 1;
    const imp_code code = witness_at(nodes, start, t->meeting, &seen, error);
    if (code != IMP_SUCCESS) return code;
    impact_note_gap(im, &seen);
    upper_time_note(up, &t->p, start, im->gamma, &seen);
    return IMP_SUCCESS;
}
